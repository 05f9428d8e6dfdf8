"""Figures computed from the samples of a PSF alone: peak, centre, energy, profiles, contrast (handbook 6.3).

Every function takes a PSF of any stack shape and works on the light inside its window; ``psf.energy`` is its share,
and `resolved` tells whether samples are close enough. If the lens is known, `p2sf.psf.measures` needs neither
window nor samples.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM
from p2sf.disc.phasors import phasor_powers
from p2sf.errors import SamplingError
from p2sf.figures.enlarge import cubic
from p2sf.figures.pixel_light import ROUNDING, critical_pixel_um
from p2sf.figures.psf_data import PsfData

ROUND_OFF = 1e-5  # of a pixel: rounding of 32-bit samples of a symmetric line
NEAR, FINER = 6, 5  # for its energy a PSF is interpolated: within so many pixels of its centre, so much finer

Grid = tuple[np.ndarray, np.ndarray, np.ndarray, float]
"""Values (y, x), x, y and the pixel."""


class WindowEnergy(NamedTuple):
    """Encircled energy: radii (n,) in µm and the fraction of the window's light within each, (…, n)."""

    radius_um: np.ndarray
    fraction: np.ndarray


class Cuts(NamedTuple):
    """Cuts through one point: positions (n,) in µm from the chief ray and values (…, n), along x and along y."""

    x_um: np.ndarray
    along_x: np.ndarray
    y_um: np.ndarray
    along_y: np.ndarray


class WindowMtf(NamedTuple):
    """Contrast against cycles per mm on the sensor: (n,), and (…, n) tangential (along y) and sagittal (along x)."""

    frequency_per_mm: np.ndarray
    tangential: np.ndarray
    sagittal: np.ndarray


def resolved(psf: PsfData, na: float | np.ndarray) -> bool:
    """Return whether the pitch is at most λ/(4 NA), so that samples determine a PSF of this aperture completely."""
    return bool(np.all(psf.pixel_um <= critical_pixel_um(psf.wavelength_um, na) * (1 + ROUNDING)))


def centroid(psf: PsfData) -> tuple[np.ndarray, np.ndarray]:
    """Return x and y of the centroid of the window, µm from the chief ray, shape of the stack.

    The first row and column of an even window have no counterpart: their light would shift the centroid of a symmetric
    PSF away from its centre, and is ignored.
    """
    x, y = (line_centroid(psf.values.sum(axis, dtype=float), at) for axis, at in ((-2, psf.x_um), (-1, psf.y_um)))
    return x, y


def line_centroid(line: np.ndarray, position_um: np.ndarray) -> np.ndarray:
    """Return the centroid of lines, (…, n), at positions from their middle one, ⌊n/2⌋; the unpaired first left out.

    The common part of mirrored samples is subtracted first, so that a line that is symmetric about a sample has its
    centroid there exactly.
    """
    paired = line[..., 1 - line.shape[-1] % 2 :]
    odd = (paired - paired[..., ::-1]) / 2
    middle: np.ndarray = (odd * position_um[1 - line.shape[-1] % 2 :]).sum(-1) / paired.sum(-1)
    pitch = position_um[1] - position_um[0]
    sample = np.rint(middle / pitch) * pitch
    return np.where(np.abs(middle - sample) > ROUND_OFF * pitch, middle, sample)


def peak(psf: PsfData) -> tuple[np.ndarray, np.ndarray]:
    """Return x and y of the highest sample, µm from the chief ray, shape of the stack."""
    row, column = _peak_samples(psf)
    return psf.x_um[column], psf.y_um[row]


def _peak_samples(psf: PsfData) -> tuple[np.ndarray, np.ndarray]:
    values = psf.values
    highest = np.asarray(values.reshape(*values.shape[:-2], -1).argmax(-1))
    row, column = np.unravel_index(highest, values.shape[-2:])
    return row, column


def encircled_energy(
    psf: PsfData, centre: tuple[ArrayLike, ArrayLike] | None = None, radius_um: ArrayLike | None = None
) -> WindowEnergy:
    """Return the fraction of the window's light within each radius of ``centre`` (x, y) in µm.

    By default the centre is the centroid and the radii run to the corner of the window. Near the centre the
    samples are interpolated five times finer; a sample counts by the share of its width that the circle has covered.
    """
    if radius_um is None:
        corner = np.hypot(np.abs(psf.x_um).max(), np.abs(psf.y_um).max()) + psf.pixel_um
        radius_um = np.linspace(0, corner, 2 * max(psf.values.shape[-2:]))
    radii = np.asarray(radius_um, dtype=float)
    curves = [_energy_curve(*rings, radii) for rings in _all_rings(psf, centre)]
    return WindowEnergy(radii, np.reshape(curves, (*psf.values.shape[:-2], len(radii))))


def radius_of_energy(
    psf: PsfData, fraction: float = 0.5, centre: tuple[ArrayLike, ArrayLike] | None = None
) -> np.ndarray:
    """Return the radius in µm that holds ``fraction`` (0 to 1) of the window's light, shape of the stack.

    Raises SamplingError for a fraction that is not between 0 and 1.
    """
    if not 0 < fraction <= 1:
        raise SamplingError("an energy fraction of {fraction}; give a number between 0 and 1", fraction=fraction)
    found = [_radius_within(*rings, fraction) for rings in _all_rings(psf, centre)]
    return np.reshape(found, psf.values.shape[:-2])


def _all_rings(
    psf: PsfData, centre: tuple[ArrayLike, ArrayLike] | None
) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Yield (inner radius, outer radius, share of the light) of the samples, about the centre of each PSF."""
    x0, y0 = (np.broadcast_to(c, psf.values.shape[:-2]).ravel() for c in (centroid(psf) if centre is None else centre))
    for values, x, y in zip(psf.values.reshape(-1, *psf.values.shape[-2:]), x0, y0, strict=True):
        coarse, fine = _split(values.astype(float), psf.x_um - x, psf.y_um - y, psf.pixel_um)
        inner, outer, value = (np.concatenate(both) for both in zip(_rings(*coarse), _rings(*fine), strict=True))
        yield inner, outer, value / value.sum()


def _split(values: np.ndarray, x: np.ndarray, y: np.ndarray, pixel: float) -> tuple[Grid, Grid]:
    """Return the samples far from the origin unchanged, and those near it FINER times finer."""
    near_x, near_y = (np.flatnonzero(np.abs(axis) <= NEAR * pixel) for axis in (x, y))
    fine_x, fine_y = (_finer(axis, near) for axis, near in ((x, near_x), (y, near_y)))
    fine = fine_y[1] @ values @ fine_x[1].T / FINER**2
    coarse = values.copy()
    coarse[np.ix_(near_y, near_x)] = 0
    return (coarse, x, y, pixel), (fine, fine_x[0], fine_y[0], pixel / FINER)


def _finer(axis: np.ndarray, near: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return positions FINER times finer than ``axis[near]`` and the matrix that interpolates to them."""
    step = axis[1] - axis[0] if len(axis) > 1 else 1.0
    offset = ((np.arange(FINER) + 0.5) / FINER - 0.5) * step
    position = (axis[near, None] + offset).ravel()
    weight = cubic(np.abs(position[:, None] - axis) / step)
    return position, weight / weight.sum(1, keepdims=True)


def _rings(values: np.ndarray, x: np.ndarray, y: np.ndarray, pixel: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the radii at which a growing circle enters and leaves each square sample, and its value, all flat."""
    distance = np.hypot(x, y[:, None])
    width = pixel * (np.abs(x) + np.abs(y[:, None])) / np.maximum(distance, 1e-300)
    half = np.where(distance > ROUND_OFF * pixel, width, pixel) / 2
    return np.maximum(distance - half, 0).ravel(), (distance + half).ravel(), values.ravel()


def _energy_curve(inner: np.ndarray, outer: np.ndarray, value: np.ndarray, radius: np.ndarray) -> np.ndarray:
    """Return Σ value·(part of [inner, outer] below radius), a difference of two sums of ramps."""
    height = value / (outer - inner)
    energy: np.ndarray = _ramps(inner, height, radius) - _ramps(outer, height, radius)
    return energy


def _ramps(start: np.ndarray, height: np.ndarray, radius: np.ndarray) -> np.ndarray:
    """Return Σ height·max(0, radius − start) at every radius."""
    order = np.argsort(start)
    start, height = start[order], height[order]
    slope = np.concatenate([[0], np.cumsum(height)])
    offset = np.concatenate([[0], np.cumsum(height * start)])
    passed = np.searchsorted(start, radius)
    ramps: np.ndarray = slope[passed] * radius - offset[passed]
    return ramps


def _radius_within(inner: np.ndarray, outer: np.ndarray, value: np.ndarray, fraction: float) -> float:
    """Return where the energy curve, which is piecewise linear, reaches the fraction."""
    corners = np.unique(np.concatenate([inner, outer]))
    energy = np.maximum.accumulate(_energy_curve(inner, outer, value, corners))
    return float(np.interp(fraction * energy[-1], energy, corners))


def profiles(psf: PsfData, through: str = "chief") -> Cuts:
    """Return the row and column through the chief ray ("chief") or the highest sample ("peak").

    Raises SamplingError for any other point.
    """
    if through not in ("chief", "peak"):
        raise SamplingError('a profile through "{place}" is unknown; choose "chief" or "peak"', place=through)
    values = psf.values
    if through == "chief":
        row, column = (np.full(values.shape[:-2], n // 2) for n in values.shape[-2:])
    else:
        row, column = _peak_samples(psf)
    along_x = np.take_along_axis(values, row[..., None, None], -2)[..., 0, :]
    along_y = np.take_along_axis(values, column[..., None, None], -1)[..., 0]
    return Cuts(psf.x_um, along_x, psf.y_um, along_y)


def mtf(psf: PsfData, frequency_per_mm: ArrayLike | None = None, na: float | None = None) -> WindowMtf:
    """Return the contrast of sine patterns, |FT of the PSF| over its value at zero, along y and along x.

    Frequencies are in cycles per mm, by default from 0 to the Nyquist frequency of the pitch; beyond it is NaN.
    Tangential contrast is that of a pattern that varies along y, the direction of the field. Light outside the window
    is missing, which raises every contrast by up to its share. With the numerical aperture ``na``, samples that are not
    `resolved` raise SamplingError: what lies between them folds into every frequency.
    """
    if na is not None and not resolved(psf, na):
        raise SamplingError(
            "{count} samples {pixel_um:.3g} µm apart hold no contrast of a PSF of aperture {na:.3g}: λ/(4 NA) is "
            "{critical:.3g} µm; sample it so closely, or take the MTF of the lens",
            count=psf.values.shape[-1],
            pixel_um=psf.pixel_um,
            na=na,
            critical=float(np.max(critical_pixel_um(psf.wavelength_um, na))),
        )
    if frequency_per_mm is None:
        frequency_per_mm = np.linspace(0, UM_PER_MM / (2 * psf.pixel_um), max(psf.values.shape[-2:]) + 1)
    frequency = np.asarray(frequency_per_mm, dtype=float)
    line_y, line_x = (psf.values.sum(axis, dtype=float) for axis in (-1, -2))
    step = np.exp(-2j * np.pi * psf.pixel_um * frequency / UM_PER_MM)
    waves = phasor_powers(step, max(psf.values.shape[-2:]))  # a phase at the window's edge does not change the modulus
    known = np.where(np.abs(frequency) * psf.pixel_um <= UM_PER_MM / 2 * (1 + 1e-9), 1.0, np.nan)
    return WindowMtf(frequency, known * _contrast(line_y, waves), known * _contrast(line_x, waves))


def _contrast(line: np.ndarray, waves: np.ndarray) -> np.ndarray:
    contrast: np.ndarray = np.abs(line @ waves[: line.shape[-1]]) / line.sum(-1, keepdims=True)
    return contrast
