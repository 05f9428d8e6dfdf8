"""Shot noise and read noise, separate from image formation."""

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
            "a full well of {well:g} and read noise of {noise:g} electrons; give positive ones",
            well=full_well,
            noise=read_electrons,
        )
    random = np.random.default_rng(seed)
    electrons = random.poisson(np.maximum(values, 0) * full_well) + random.normal(0, read_electrons, values.shape)
    noisy: np.ndarray = (electrons / full_well).astype(np.float32)
    return noisy
