"""The PSF beside that of a perfect lens of the same aperture, and beside what a sensor's pixels make of it."""

from dataclasses import dataclass

import numpy as np

from p2sf.figures.perfect import airy_curves
from p2sf.psf.result import Psf
from p2sf_explorer.compute.live import Live, View

RADII = 2048  # of the table that the pattern is drawn from: to 1e-5 of the peak
MOST_PIXELS = 201  # across the window; finer pixels are not told apart on screen


@dataclass(frozen=True)
class SampledLight:
    """Light per sample over (count, µm per sample): ``real`` and ``perfect``, each over its own peak.

    ``pixels``: share of the light of each pixel of ``pixel_um``, the middle one centred on the chief ray; of all light
    where that is known, else of the window's. ``perfect_share``: the middle pixel's of a perfect lens.
    """

    real: np.ndarray
    perfect: np.ndarray
    sample_um: float
    pixels: np.ndarray
    pixel_um: float
    perfect_share: float


def beside(live: Live) -> View[SampledLight]:
    """Return the three pictures of the present point."""
    psf, pixel = live.psf, live.state.display.pixel_um
    perfect = airy_picture(psf, live.airy_radius_um)
    shares = 1.0 if psf.energy is None else min(1.0, float(psf.energy))
    real = psf.values / (float(psf.values.max()) or 1.0)
    middle = airy_share(live.airy_radius_um, pixel)
    return View(SampledLight(real, perfect, psf.pixel_um, shares * over_pixels(psf, pixel), pixel, middle))


def airy_picture(psf: Psf, radius_um: float) -> np.ndarray:
    """Return the Airy pattern on a PSF's samples, over its peak."""
    distance = np.hypot(psf.x_um, psf.y_um[:, None])
    position, pattern, _ = airy_curves(2 * RADII + 1, float(distance.max()), radius_um)
    return np.interp(distance, position[RADII:], pattern[RADII:])


def over_pixels(psf: Psf, pixel_um: float) -> np.ndarray:
    """Return the PSF integrated over square pixels, (m, m) of odd m: samples shared out by the area they have there."""
    rows = pixel_weights(psf.y_um, psf.pixel_um, pixel_um)
    columns = pixel_weights(psf.x_um, psf.pixel_um, pixel_um)
    return rows @ psf.values @ columns.T


def pixel_weights(position_um: np.ndarray, step_um: float, pixel_um: float) -> np.ndarray:
    """Return the part of each sample's width that lies in each pixel, (pixels, samples); pixel m//2 is centred on 0."""
    reach_um = float(np.abs(position_um).max()) + step_um / 2
    half = min(MOST_PIXELS // 2, int(np.ceil(reach_um / pixel_um - 0.5)))
    low = (np.arange(-half, half + 1)[:, None] - 0.5) * pixel_um
    inside = np.minimum(low + pixel_um, position_um + step_um / 2) - np.maximum(low, position_um - step_um / 2)
    return np.maximum(inside, 0.0) / step_um


def airy_share(radius_um: float, pixel_um: float) -> float:
    """Return the share of a perfect lens's light that falls on a square pixel centred on it.

    The mean of the encircled energy over the pixel's edge as seen from its middle: E(w/(2 cos φ)), φ to 45°.
    """
    turn = (np.arange(64) + 0.5) / 64 * np.pi / 4
    reach = pixel_um / 2 / np.cos(turn)
    position, _, energy = airy_curves(4097, float(reach.max()), radius_um)
    return float(np.interp(reach, position[2048:], energy[2048:]).mean())
