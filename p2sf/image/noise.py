"""Noise, kept apart from image formation: add it, or do not."""

import numpy as np

from p2sf.errors import RequestError


def with_noise(
    values: np.ndarray, full_well: float = 10000.0, read_electrons: float = 3.0, seed: int = 0
) -> np.ndarray:
    """Return the picture with shot noise of ``full_well`` electrons at white and Gaussian read noise, float32.

    Raises RequestError for a well that is not positive or a negative read noise.
    """
    if not full_well > 0 or not read_electrons >= 0:
        raise RequestError(
            f"a full well of {full_well:g} and read noise of {read_electrons:g} electrons; give positive ones"
        )
    random = np.random.default_rng(seed)
    electrons = random.poisson(np.maximum(values, 0) * full_well) + random.normal(0, read_electrons, values.shape)
    return (electrons / full_well).astype(np.float32)
