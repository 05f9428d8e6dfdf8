"""Brightness scales of the PSF: linear, square root, logarithmic. No Qt in here."""

import numpy as np

SCALES = (("linear", "linear"), ("sqrt", "square root"), ("log", "log"))
UNITS = (("peak", "peak = 1"), ("sum", "sum = 1"), ("strehl", "Strehl"))
DECADES = 5  # shown by the logarithmic scale, below the peak


def stretch(values: np.ndarray, scale: str) -> np.ndarray:
    """Return brightness 0 to 1 of values 0 to 1 on a scale."""
    if scale == "linear":
        return values
    if scale == "sqrt":
        return np.sqrt(np.maximum(values, 0.0))
    return 1 + np.log10(np.maximum(values, 10.0**-DECADES)) / DECADES
