"""The RMS of a wavefront without piston and tilt, which do not blur, as stated throughout (handbook 3.4).

Where tilt is included, as in listings of other programs, the name says so (``rms_with_tilt``).
"""

import numpy as np

SINGULAR = 1e-12  # below this share of the largest eigenvalue, points lie on a line and determine only one tilt


def without_tilt(waves: np.ndarray, weight: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Return wavefronts, (…, points), minus piston and tilt fitted by weighted least squares.

    ``weight``: (points,), of positive sum; a few may be negative, as at nodes over a vane. ``axes``: (1 or 2, points),
    the coordinates in which a tilt is linear; η alone over the half pupil of a wavefront that is even in ξ.
    """
    flat = np.concatenate([np.ones((1, weight.size)), axes])
    weighted = flat * weight
    amounts = np.linalg.lstsq(weighted @ flat.T, weighted @ waves.T, rcond=SINGULAR)[0]
    rest: np.ndarray = waves - amounts.T @ flat
    return rest


def rms(waves: np.ndarray, weight: np.ndarray, axes: np.ndarray | None = None) -> float:
    """Return the RMS of a wavefront, (points,), without piston and tilt; with tilt if no ``axes`` are given."""
    rest = without_tilt(waves, weight, np.empty((0, weight.size)) if axes is None else axes)
    return float(np.sqrt(max(float(weight @ rest**2), 0.0) / weight.sum()))
