"""A colour PSF as data, as colours of a screen, and as a record."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from p2sf.colour.colorimetry import displayable, linear_rgb
from p2sf.conventions import NM_PER_UM, FloatOrArray, centred_axis


@dataclass(frozen=True, eq=False)
class ColourPsf:
    """X, Y, Z of the image of a point, ``xyz`` (y, x, 3), rows +y; sample N//2 is the chief ray of the source's colour.

    Y sums to ``light_in_window``, the share of all light that falls into it; None if samples are too far apart to
    determine it, and then Y sums to an estimate. ``wavelengths_um`` were rendered by ``methods``; ``shift_um``: height
    of each chief ray above that of the source's colour, ``aside_um``: its distance to the right, 0 for a symmetric
    lens.
    """

    xyz: np.ndarray
    pixel_um: float
    spectrum: str
    wavelengths_um: np.ndarray
    shift_um: np.ndarray
    methods: tuple[str, ...]
    seconds: float
    light_in_window: float | None = None
    aside_um: FloatOrArray = 0.0

    @property
    def x_um(self) -> np.ndarray:
        """Column positions, µm."""
        return centred_axis(self.xyz.shape[1], self.pixel_um)

    @property
    def y_um(self) -> np.ndarray:
        """Row positions, µm."""
        return centred_axis(self.xyz.shape[0], self.pixel_um)


def screen_rgb(found: ColourPsf) -> np.ndarray:
    """Return linear sRGB, (y, x, 3), the brightest channel 1."""
    rgb = displayable(linear_rgb(found.xyz))
    scaled: np.ndarray = rgb / (float(rgb.max()) or 1.0)
    return scaled


def faint_rgb(found: ColourPsf, stretch: Callable[[np.ndarray], np.ndarray] = np.sqrt) -> np.ndarray:
    """Return linear sRGB as `screen_rgb` does, with the brightest channel of each sample stretched at constant hue."""
    rgb = screen_rgb(found)
    top = rgb.max(-1, keepdims=True)
    stretched: np.ndarray = rgb * np.divide(stretch(top), top, out=np.zeros_like(top), where=top > 0)
    return stretched


def record(found: ColourPsf) -> dict:
    """Return all data of a colour PSF except the samples, by name."""
    return {
        "spectrum": found.spectrum,
        "pixel_um": found.pixel_um,
        "wavelengths_nm": found.wavelengths_um * NM_PER_UM,
        "chief_ray_shift_um": found.shift_um,
        **({"chief_ray_aside_um": found.aside_um} if np.any(found.aside_um) else {}),
        "methods": list(found.methods),
        "light_in_window": found.light_in_window,
        "seconds": found.seconds,
    }
