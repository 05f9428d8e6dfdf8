"""Rows of equal frequency over the pupil: those of the disc or the iris less those of an obscuration in it.

A disc of radius r in the pupil is a pupil of its own, whose phase, frequencies and weight are the same polynomials over
(rξ, rη); `separable_sum` puts its nodes in rows of their own, and those of an iris up to its outline. Amplitude and
phase of the mask are factors at the nodes. What is not even in ξ has sines as well as cosines. What vanes cover is
taken away node by node: it is a small part of the disc.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import DTypeLike

from p2sf.conventions import centred_axis, protected
from p2sf.psf.plane_waves import counts_for, pupil_amplitude
from p2sf.psf.separable_sum import (
    MOST_NODES,
    FrequencyRows,
    iris_rows,
    mirrored_intensity,
    row_counts,
    rows_for,
    too_many,
)
from p2sf.pupil.mask import PupilMask
from p2sf.pupil.mask_nodes import ClearNodes, vane_nodes
from p2sf.pupil.quadrature import disc_nodes
from p2sf.pupil.transform import sum_plane_waves
from p2sf.pupil.zernike import basis
from p2sf.raytrace.fit import FittedPencil
from p2sf.raytrace.ray_field import Steepness


@dataclass(frozen=True)
class Disc:
    """A disc of the pupil or its iris: radius, the fit over it as over a pupil of its own, rows, share of the pupil.

    The share of what is taken away is negative. ``side``: of rows of one half of the pupil 1 where that is ξ > 0 and −1
    where it is ξ < 0, (rows,); None where rows stand for both.
    """

    radius: float
    found: FittedPencil
    rows: FrequencyRows
    share: float
    side: np.ndarray | None = None


Values = Callable[[Disc], tuple[FrequencyRows, np.ndarray, np.ndarray]]
"""Gives rows with the light that falls there, phases in waves, and fx in cycles per µm."""


def takes_rows(mask: PupilMask) -> bool:
    """Return whether the obscuration stands free of the blades."""
    return all(edge.crossing(mask.obscuration) is None for edge in mask.edges)


def discs(found: FittedPencil, pixels: int, pixel_um: float, quality: str) -> tuple[Disc, ...] | None:
    """Return the disc or iris and the obscuration in it, with rows; None where the pupil map is too curved for rows."""
    parts = [
        _iris(found, pixels, pixel_um, quality) if found.mask.iris else _disc(found, 1.0, pixels, pixel_um, quality)
    ]
    if found.mask.obscuration:
        parts.append(_disc(found, found.mask.obscuration, pixels, pixel_um, quality))
    return None if None in parts else tuple(disc for disc in parts if disc is not None)


def _disc(found: FittedPencil, radius: float, pixels: int, pixel_um: float, quality: str) -> Disc | None:
    part = scaled(found, radius)
    rows = rows_for(part, pixels, pixel_um, quality)
    return None if rows is None else Disc(radius, part, rows, 1.0 if radius == 1 else -(radius**2))


def _iris(found: FittedPencil, pixels: int, pixel_um: float, quality: str) -> Disc | None:
    counts = row_counts(found, pixels, pixel_um, quality)
    if counts[0] * counts[1] > MOST_NODES:
        raise too_many(*counts, pixels, pixel_um)
    made = iris_rows(found, *counts)
    return None if made is None else Disc(1.0, found, *made)


def scaled(found: FittedPencil, radius: float) -> FittedPencil:
    """Return the fit of a disc of this radius about the chief ray, its rim at 1."""
    if radius == 1:
        return found
    orders = found.level.wave_order, found.level.map_order
    steep = found.steepness
    return replace(
        found,
        phase=found.phase @ _scaling(orders[0], False, radius),
        fx=found.fx @ _scaling(orders[1], True, radius),
        fy=found.fy @ _scaling(orders[1], False, radius),
        weight=found.weight @ _scaling(orders[1], False, radius) if found.level.weighted else found.weight,
        steepness=Steepness(*(radius * slope for slope in vars(steep).values())),
    )


@lru_cache(maxsize=64)
def _scaling(order: int, odd: bool, radius: float) -> np.ndarray:
    """Return the matrix from coefficients over the disc to those over one of this radius, which the nodes integrate."""
    nodes = disc_nodes(order + 1, 2 * order + 2)
    here = basis(order, radius * nodes.xi, radius * nodes.eta, odd)
    return protected(here @ (basis(order, nodes.xi, nodes.eta, odd) * nodes.weight).T)


@dataclass(frozen=True)
class EdgeField:
    """The field of what vanes cover, and its light, in shares of the disc's; both negative."""

    values: np.ndarray
    light: float


def intensity_over(
    parts: tuple[Disc, ...],
    values_of: Values,
    edges: EdgeField | None,
    pixels: int,
    pixel_um: float,
    dtype: DTypeLike,
) -> np.ndarray:
    """Return the intensity (y, x) of the disc less all that covers it, in units of the unaberrated peak."""
    half = np.zeros((pixels, pixels // 2 + 1), np.result_type(dtype, np.complex64))
    whole: np.ndarray | None = None
    light = 0.0
    for disc in parts:
        mask, (rows, phase, fx) = disc.found.mask, values_of(disc)
        if mask.even:
            rows, phase, fx = _masked(disc, rows, phase, fx)
            half += rows.field(phase, fx, pixels, pixel_um, dtype) * (disc.share * rows.light)
            light += disc.share * rows.light
        else:
            rows, phase, fx = rows.with_every_column(phase, fx)
            even, odd, mean = _halves(disc, rows, phase, dtype)
            field = rows.both_sides(even, odd, fx, pixels, pixel_um) * (disc.share * rows.light)
            whole = field if whole is None else whole + field
            light += disc.share * rows.light * mean
    if edges is None and whole is None:
        return mirrored_intensity(half / light, pixels)
    if whole is None:
        whole = half[:, np.abs(np.arange(pixels) - pixels // 2)]
    if edges is not None:
        whole, light = whole + edges.values, light + edges.light
    return plain_intensity(whole / light)


def _masked(
    disc: Disc, rows: FrequencyRows, phase: np.ndarray, fx: np.ndarray
) -> tuple[FrequencyRows, np.ndarray, np.ndarray]:
    """Return rows, phase and fx of a disc with amplitude and path of a mask that is even in ξ."""
    mask = disc.found.mask
    if not (mask.shaded or mask.phased):
        return rows, phase, fx
    rows, phase, fx = rows.with_every_column(phase, fx)
    place = disc.radius * rows.xi, disc.radius * rows.eta
    if mask.shaded:
        rows = rows.lit(mask.amplitude(*place))
    return rows, phase + mask.path_um(*place) / disc.found.wavelength_um if mask.phased else phase, fx


def _halves(
    disc: Disc, rows: FrequencyRows, phase: np.ndarray, dtype: DTypeLike
) -> tuple[np.ndarray, np.ndarray, float]:
    """Return the parts of a disc's weighted amplitudes even and odd in ξ behind any mask, and their mean modulus."""

    def at(side: float | np.ndarray, share: float) -> tuple[np.ndarray, float]:
        mask, place = disc.found.mask, (side * disc.radius * rows.xi, disc.radius * rows.eta)
        weight = share * rows.weight * mask.amplitude(*place) if mask.shaded else share * rows.weight
        waves = phase + mask.path_um(*place) / disc.found.wavelength_um if mask.phased else phase
        return pupil_amplitude(weight, waves, dtype), float(weight.sum())

    if disc.side is not None:
        side = disc.side[:, None]
        wave, mean = at(side, 1.0)
        return wave, wave * side.astype(wave.real.dtype), mean
    (right, light), (left, more) = at(1.0, 0.5), at(-1.0, 0.5)
    return right + left, right - left, light + more


def plain_intensity(field: np.ndarray) -> np.ndarray:
    """Return |field|²."""
    intensity: np.ndarray = field.real**2 + field.imag**2
    return intensity


def of_fit(disc: Disc) -> tuple[FrequencyRows, np.ndarray, np.ndarray]:
    """Return the rows of a disc with the phase and fx of its fit."""
    return disc.rows, *disc.found.at_points(disc.rows.xi, disc.rows.eta)


def edges_of_fit(found: FittedPencil, pixels: int, pixel_um: float, dtype: DTypeLike) -> EdgeField | None:
    """Return the field of what vanes cover, by a fit; None where there are none."""
    nodes = vane_nodes(found.mask, *counts_for(found.steepness, pixels, pixel_um))
    if nodes is None:
        return None
    light = found.weight_at(nodes.xi, nodes.eta)
    return edge_field(nodes, light, found.at(nodes.xi, nodes.eta), found.wavelength_um, (pixels, pixel_um), dtype)


def edge_field(
    nodes: ClearNodes,
    light: np.ndarray,
    values: tuple[np.ndarray, np.ndarray, np.ndarray],
    wavelength_um: float,
    window: tuple[int, float],
    dtype: DTypeLike,
) -> EdgeField:
    """Return the sum of plane waves over the nodes of edges; ``values``: phase in waves, fx and fy in cycles per µm."""
    phase, fx, fy = values
    axis, weight = centred_axis(*window), nodes.weight * nodes.amplitude * light
    amplitude = pupil_amplitude(weight, phase + nodes.path_um / wavelength_um, dtype)
    field = sum_plane_waves(amplitude, fx.astype(dtype), fy.astype(dtype), axis, axis, nodes.even)
    return EdgeField(field, float(weight.sum()))
