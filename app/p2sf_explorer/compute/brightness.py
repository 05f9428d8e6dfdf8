"""Brightness scales of the PSF: linear, square root, logarithmic. No Qt in here."""

import numpy as np

SCALES = (("linear", "linear"), ("sqrt", "square root"), ("log", "log"), ("log8", "log, 8 decades"))
UNITS = (("peak", "peak = 1"), ("sum", "sum = 1"), ("strehl", "Strehl"))
DECADES = {"log": 5, "log8": 8}  # shown by the logarithmic scales, below the peak


def stretch(values: np.ndarray, scale: str) -> np.ndarray:
    """Return brightness 0 to 1 of values 0 to 1 on a scale."""
    if scale == "linear":
        return values
    if scale == "sqrt":
        return np.sqrt(np.maximum(values, 0.0))
    decades = DECADES[scale]
    return 1 + np.log10(np.maximum(values, 10.0**-decades)) / decades
