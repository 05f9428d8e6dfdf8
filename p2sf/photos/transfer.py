"""Between linear light and what files hold."""

import numpy as np

from p2sf.errors import RequestError

ENCODINGS = ("srgb", "linear")


def linear_from_srgb(values) -> np.ndarray:
    """Return linear light of sRGB values, both 0…1, shape kept (IEC 61966-2-1); float32 stays float32."""
    values = np.asarray(values)
    low = np.maximum(values, 0) / 12.92 + np.minimum(values, 0)
    return np.where(values <= 0.04045, low, ((np.maximum(values, 0) + 0.055) / 1.055) ** 2.4).astype(values.dtype)


def srgb_from_linear(values) -> np.ndarray:
    """Return sRGB values of linear light, shape kept (IEC 61966-2-1); negative light stays as it is."""
    values = np.asarray(values)
    low = 12.92 * np.maximum(values, 0) + np.minimum(values, 0)
    return np.where(values <= 0.0031308, low, 1.055 * np.maximum(values, 0) ** (1 / 2.4) - 0.055).astype(values.dtype)


def check_encoding(encoding: str) -> None:
    """Raise RequestError unless the encoding is one of ENCODINGS."""
    if encoding not in ENCODINGS:
        raise RequestError(f'picture encoding "{encoding}" is unknown; choose {" or ".join(ENCODINGS)}')
