"""Rows of equal frequency over the pupil: those of the whole disc less those of an obscuration in it.

A disc of radius r in the pupil is a pupil of its own, whose phase, frequencies and weight are the same polynomials over
(rξ, rη); `separable_sum` puts its nodes in rows of their own. Amplitude and phase of the mask are factors at the nodes,
and need to be even in ξ. What vanes and blades cover is taken away node by node: it is a small part of the disc.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import DTypeLike

from p2sf.conventions import centred_axis, protected
from p2sf.psf.plane_waves import counts_for, pupil_amplitude
from p2sf.psf.separable_sum import FrequencyRows, mirrored_intensity, rows_for
from p2sf.pupil.mask import PupilMask
from p2sf.pupil.mask_nodes import ClearNodes, edge_nodes
from p2sf.pupil.quadrature import disc_nodes
from p2sf.pupil.transform import sum_plane_waves
from p2sf.pupil.zernike import basis
from p2sf.raytrace.fit import FittedPencil
from p2sf.raytrace.ray_field import Steepness


@dataclass(frozen=True)
class Disc:
    """A disc of the pupil, its radius, the fit over it as over a pupil of its own, and its rows."""

    radius: float
    found: FittedPencil
    rows: FrequencyRows


Values = Callable[[Disc], tuple[FrequencyRows, np.ndarray, np.ndarray]]
"""Gives rows with the light that falls there, phases in waves, and fx in cycles per µm."""


def takes_rows(mask: PupilMask) -> bool:
    """Return whether the disc that vanes and blades cover is even in ξ."""
    return mask.smoothly_even


def discs(found: FittedPencil, pixels: int, pixel_um: float, quality: str) -> tuple[Disc, ...] | None:
    """Return the disc and the obscuration in it, with rows; None where the pupil map is too curved for rows."""
    mask, made = found.mask, []
    every = mask.shaded or mask.phased
    for radius in (1.0, mask.obscuration) if mask.obscuration else (1.0,):
        part = scaled(found, radius)
        rows = rows_for(part, pixels, pixel_um, quality, every)
        if rows is None:
            return None
        made.append(Disc(radius, part, rows))
    return tuple(made)


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
    """The field of what vanes and blades cover, and its light, in shares of the disc's; both negative."""

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
    total: np.ndarray | float = 0.0
    light = 0.0
    for disc in parts:
        rows, phase, fx = values_of(disc)
        mask, place = disc.found.mask, (disc.radius * rows.xi, disc.radius * rows.eta)
        if mask.shaded:
            rows = rows.lit(mask.amplitude(*place))
        if mask.phased:
            phase = phase + mask.path_um(*place) / disc.found.wavelength_um
        share = (1 if disc is parts[0] else -1) * disc.radius**2 * rows.light
        total = total + rows.field(phase, fx, pixels, pixel_um, dtype) * share
        light += share
    field = np.asarray(total)
    if edges is None:
        return mirrored_intensity(field / light, pixels)
    whole = field[:, np.abs(np.arange(pixels) - pixels // 2)] + edges.values
    return plain_intensity(whole / (light + edges.light))


def plain_intensity(field: np.ndarray) -> np.ndarray:
    """Return |field|²."""
    intensity: np.ndarray = field.real**2 + field.imag**2
    return intensity


def of_fit(disc: Disc) -> tuple[FrequencyRows, np.ndarray, np.ndarray]:
    """Return the rows of a disc with the phase and fx of its fit."""
    return disc.rows, *disc.found.at_points(disc.rows.xi, disc.rows.eta)


def edges_of_fit(found: FittedPencil, pixels: int, pixel_um: float, dtype: DTypeLike) -> EdgeField | None:
    """Return the field of what vanes and blades cover, by a fit; None where there are none."""
    nodes = edge_nodes(found.mask, *counts_for(found.steepness, pixels, pixel_um))
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
