"""The `traced` method: exact rays, thousands of them, at the speed of a separable sum (handbook 5.4).

The rays go through pupil points that a fit puts in rows of equal spatial frequency (`separable_sum`). The true fy of a
ray differs from that of its row by the residual of the fit; since the phase over frequency has the gradient −x
(Hamilton), adding −y·(row − ray) to its phase is right to second order in that difference. Phase, fx and the area of
every node are exact.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from time import perf_counter

import numpy as np
from numpy.typing import DTypeLike

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.disc_rows import Disc, EdgeField, discs, edge_field, intensity_over, takes_rows
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.plane_waves import Origin, counts_for, psf_from_intensity, resolved
from p2sf.psf.prediction import EDGE_ERROR, TRACED_ERROR
from p2sf.psf.result import Psf
from p2sf.psf.separable_sum import FrequencyRows
from p2sf.psf.skew_rows import SkewRows, skew_rows_for
from p2sf.pupil.mask_nodes import vane_nodes
from p2sf.pupil.quadrature import SETTLED_TOLERANCE
from p2sf.raytrace.aiming import SUM_AIM_ERROR
from p2sf.raytrace.fit import FittedPencil, fit, levels_for
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.ray_field import RayData, ray_data
from p2sf.raytrace.seen_mask import mask_seen
from p2sf.raytrace.vignetting import masked_blur
from p2sf.threads import one_blas_thread

# A fifth-order pupil map at least: terms of second order in its error are then below 1e-5 of R² on every stored row.
FEWEST = 1  # of the levels, 46 numbers of an evenly filled pupil
RESIDUAL_WAVES = 1e-3  # most that the error of the map times the blur may be: the PSF's error is second order in it
FALLBACK_TOLERANCE = 3e-3  # relative L2 of node by node sums: R² to 1e-5


@one_blas_thread
def traced_psf(
    lens: Lens,
    source: Source,
    pixels: int,
    pixel_um: float,
    quality: str = "settled",
    clip: bool = False,
    cancelled: Callable[[], bool] | None = None,
) -> Psf:
    """Return the PSF of exact rays, one pass: "settled" in float64, "preview" fewer rays in float32.

    Where rays are lost or clipped, or no fit puts them in rows well enough, they are summed node by node as the
    reference is, to FALLBACK_TOLERANCE, which takes long: ``cancelled`` is called between blocks of them (`Cancelled`).
    Raises GeometryError where the chief ray does not reach the sensor, SamplingError for a window no rays can carry.
    """
    started = perf_counter()
    parts = None if clip else _parts(lens, source, (pixels, pixel_um), quality)
    if parts is None:
        tolerance = FALLBACK_TOLERANCE if quality == "settled" else None
        one_by_one = huygens_psf(lens, source, pixels, pixel_um, tolerance, None, cancelled, clip)
        return replace(one_by_one, method="traced", predicted_error=EDGE_ERROR)
    dtype = np.float64 if quality == "settled" else np.float32
    if isinstance(parts, SkewRows):
        return _skew_psf(lens, source, parts, (pixels, pixel_um), dtype, started)
    found, nodes = parts[0].found, parts[0].rows
    edges = _edges(lens, source, found, (pixels, pixel_um), dtype)
    intensity = intensity_over(parts, lambda disc: exact_rows(lens, source, disc), edges, pixels, pixel_um, dtype)
    tolerance = SETTLED_TOLERANCE if quality == "settled" else None
    sampling = Message("{nodes}, {precision}", nodes=nodes.words, precision=intensity.dtype.name)
    rays = found.rays + sum(disc.rows.xi.size for disc in parts)
    made = Origin("traced", 0, rays, sampling, started, tolerance, TRACED_ERROR)
    blur = masked_blur(found) if resolved(found.steepness.spread, pixel_um) else None
    return psf_from_intensity(intensity, pixel_um, source.wavelength_um, blur, made)


def in_rows(lens: Lens, source: Source) -> bool:
    """Return whether a fit puts the rays of the whole pupil in rows, so that `traced_psf` is fast."""
    mask = mask_seen(lens, source)
    return (mask.clear if lens.misaligned else takes_rows(mask)) and _fit(lens, source) is not None


def _parts(lens: Lens, source: Source, window: tuple[int, float], quality: str) -> tuple[Disc, ...] | SkewRows | None:
    """Return the pupil as discs in rows, or without symmetry as such rows; None where it is not to be put in rows."""
    found = _fit(lens, source)
    if lens.misaligned:
        return None if found is None or not found.mask.clear else skew_rows_for(found, *window, quality)
    return None if found is None or not takes_rows(found.mask) else discs(found, *window, quality)


@lru_cache(maxsize=2)
def _fit(lens: Lens, source: Source) -> FittedPencil | None:
    """Return the fit that puts rays in rows; None where rays are lost, or no polynomial is accurate enough."""
    try:
        found = fit(lens, source, levels_for(lens)[FEWEST].numbers)
        if found.error_waves >= RESIDUAL_WAVES:
            found = fit(lens, source, residual_waves=RESIDUAL_WAVES)
    except GeometryError:  # rays are lost
        return None
    return None if found.error_waves > RESIDUAL_WAVES else found


def _skew_psf(
    lens: Lens, source: Source, nodes: SkewRows, window: tuple[int, float], dtype: DTypeLike, started: float
) -> Psf:
    """Return the PSF of exact rays through rows of a pupil without symmetry."""
    shape, found = nodes.xi.shape, _fit(lens, source)
    rays = ray_data(pencil(lens, source, nodes.xi.ravel(), nodes.eta.ravel(), aim_error=SUM_AIM_ERROR))
    phase, fx, light = (x.reshape(shape) for x in (_on_row(rays, nodes.fy, shape[1]), rays.fx, rays.weight))
    intensity = nodes.intensity(phase, fx, light, *window, dtype)
    sampling = Message("{nodes}, {precision}", nodes=nodes.words, precision=intensity.dtype.name)
    tolerance = SETTLED_TOLERANCE if dtype == np.float64 else None
    blur = None if found is None or not resolved(found.steepness.spread, window[1]) else found.blur_um2
    made = Origin("traced", 0, (found.rays if found else 0) + nodes.xi.size, sampling, started, tolerance, TRACED_ERROR)
    return psf_from_intensity(intensity, window[1], source.wavelength_um, blur, made)


def _on_row(rays: RayData, fy: np.ndarray, columns: int) -> np.ndarray:
    """Return the phases that rays have at the frequency of their row, not at their own: w falls by y as fy rises."""
    miss = np.repeat(fy, columns)
    miss -= rays.fy
    miss *= rays.y_um
    phase: np.ndarray = rays.phase - miss
    return phase


def _edges(
    lens: Lens, source: Source, found: FittedPencil, window: tuple[int, float], dtype: DTypeLike
) -> EdgeField | None:
    """Return the field of what vanes and blades cover, by exact rays; None where there are none."""
    nodes = vane_nodes(found.mask, *counts_for(found.steepness, *window))
    if nodes is None:
        return None
    rays = ray_data(pencil(lens, source, nodes.xi, nodes.eta, aim_error=SUM_AIM_ERROR))
    return edge_field(nodes, rays.weight, (rays.phase, rays.fx, rays.fy), source.wavelength_um, window, dtype)


def exact_rows(lens: Lens, source: Source, disc: Disc) -> tuple[FrequencyRows, np.ndarray, np.ndarray]:
    """Return the rows of a disc with exact weights, and exact phase (waves) and fx (cycles/µm), (rows, nodes)."""
    found, nodes = disc.found, disc.rows
    shape = nodes.xi.shape
    xi, eta = (disc.radius * x.ravel() for x in (nodes.xi, nodes.eta))
    rays = ray_data(pencil(lens, source, xi, eta, aim_error=SUM_AIM_ERROR))
    if found.level.weighted:
        nodes = nodes.lit(rays.weight.reshape(shape) / found.weight_at(nodes.xi, nodes.eta))
    return nodes, _on_row(rays, nodes.fy, shape[1]).reshape(shape), rays.fx.reshape(shape)
