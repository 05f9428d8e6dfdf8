"""Frames of points through misaligned lenses by Huygens sums, with other rays and nodes than measuring takes."""

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.measure.frame import Frame, FrameGeometry
from p2sf.psf.huygens import huygens_psf
from p2sf.raytrace.pencil import pencil

SAMPLES = 9  # across a pixel: their mean errs by 5 % at the finest contrast there is, where hardly any is left
HALF = 12  # pixels
PEAK, BACKGROUND = 1000.0, 50.0


def cross_of_points(*radii_mm: float) -> np.ndarray:
    """Return places on the axis and on the sensor's x and y, where turning a PSF is exact, (points, 2) mm."""
    around = [(0.0, 1.0), (0.0, -1.0), (1.0, 0.0), (-1.0, 0.0)]
    return np.array([(0.0, 0.0)] + [(x * radius, y * radius) for radius in radii_mm for x, y in around])


def huygens_frame(
    built: Lens,
    slopes: np.ndarray,
    geometry: FrameGeometry,
    noise: float = 10.0,
    seed: int = 0,
    light: tuple[tuple[float, float], ...] = (),
) -> Frame:
    """Return the picture of points at infinity whose field slopes are (points, 2), through a lens as it is built.

    Each slope lies along x or y. Peaks are 1000 counts on 50. ``light``: wavelengths in µm and how much each brings.
    """
    values = np.zeros((geometry.rows, geometry.columns))
    for x, y in slopes.tolist():
        azimuth = float(np.rad2deg(np.arctan2(x, y)))
        colours = light or ((built.reference_wavelength_um, 1.0),)
        sources = [Source(np.inf, float(np.hypot(x, y)), wave, azimuth_deg=azimuth) for wave, _ in colours]
        row, column = geometry.pixel_at(*_landing(built, sources[0]))
        parts = (
            share * _on_pixels(built, source, geometry, (row, column))
            for source, (_, share) in zip(sources, colours, strict=True)
        )
        pixels = sum(parts, np.zeros(()))[::-1]
        around = slice(row - HALF, row + HALF + 1), slice(column - HALF, column + HALF + 1)
        values[around] += pixels * (PEAK / pixels.max())
    counts = values + BACKGROUND + np.random.default_rng(seed).normal(0, noise, values.shape)
    return Frame(counts, geometry)


def _quarters(source: Source) -> int:
    return round(source.azimuth_deg / 90)


def _landing(built: Lens, source: Source) -> tuple[float, float]:
    """Return where the chief ray lands, x and y in mm; a source's own axes are turned by its azimuth."""
    chief, turn = pencil(built, source, [0.0], [0.0]), np.pi / 2 * _quarters(source)
    across, along = float(np.ravel(chief.chief_x)[0]), float(np.ravel(chief.chief_y)[0])
    return across * np.cos(turn) + along * np.sin(turn), along * np.cos(turn) - across * np.sin(turn)


def _on_pixels(built: Lens, source: Source, geometry: FrameGeometry, pixel: tuple[int, int]) -> np.ndarray:
    """Return the share of all light on the pixels about one, rows towards +y."""
    fine, samples = geometry.pixel_um / SAMPLES, SAMPLES * (2 * HALF + 1)
    middle = geometry.place_of(*pixel)
    off = [round((a - b) * UM_PER_MM / fine) for a, b in zip(_landing(built, source), middle, strict=True)]
    psf = huygens_psf(built, source, samples + 2 * SAMPLES, fine)
    light = np.rot90(psf.values * psf.energy, _quarters(source))
    left, low = (SAMPLES - shift for shift in off)
    window = light[low : low + samples, left : left + samples]
    pixels: np.ndarray = window.reshape(2 * HALF + 1, SAMPLES, 2 * HALF + 1, SAMPLES).sum((1, 3))
    return pixels
