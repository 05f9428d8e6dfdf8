"""The `fitted` method: a PSF from some tens of numbers, fitted to some tens of rays (handbook 5.3)."""

from collections.abc import Iterator
from functools import lru_cache
from time import perf_counter

import numpy as np
from numpy.typing import DTypeLike

from p2sf.conventions import centred_axis
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.disc_rows import discs, edges_of_fit, intensity_over, of_fit, takes_rows
from p2sf.psf.plane_waves import Origin, counts_for, disc_words, psf_from_intensity, pupil_amplitude, resolved
from p2sf.psf.prediction import predicted_error
from p2sf.psf.result import Psf
from p2sf.psf.separable_sum import too_many
from p2sf.psf.skew_rows import skew_rows_for
from p2sf.pupil.mask import PupilMask
from p2sf.pupil.mask_nodes import ClearNodes, mask_nodes
from p2sf.pupil.quadrature import SETTLED_TOLERANCE
from p2sf.pupil.transform import sum_plane_waves
from p2sf.pupil.zernike import basis
from p2sf.raytrace.fit import FittedPencil, fit
from p2sf.raytrace.vignetting import masked_blur
from p2sf.threads import one_blas_thread

__all__ = ["FittedPencil", "fit", "fitted_intensity", "fitted_psf", "psf_of_fit", "summed"]

Values = tuple[np.ndarray, np.ndarray, np.ndarray]
MOST_KEPT = 2**14  # radii × directions: 8 MB at most, of a hundred polynomials
MOST_NODES = 2**22  # radii × directions, summed one by one: some ten seconds of work


@one_blas_thread
def fitted_psf(
    lens: Lens,
    source: Source,
    pixels: int,
    pixel_um: float,
    numbers: int | None = None,
    quality: str = "settled",
) -> Psf:
    """Return the PSF of the `fitted` method, with ``numbers`` coefficients or as many as the residual asks for.

    "settled" sums what the fit describes in float64, to a relative L2 error of 1e-4; "preview" sums fewer nodes in
    float32. The nodes lie in rows (`separable_sum`); a pupil map too curved for rows is summed node by node.
    Raises GeometryError where rays do not reach the sensor, SamplingError for a window no nodes can carry.
    """
    started = perf_counter()
    return psf_of_fit(fit(lens, source, numbers), source.wavelength_um, (pixels, pixel_um), quality, started)


def psf_of_fit(
    found: FittedPencil, wavelength_um: float, window: tuple[int, float], quality: str, started: float
) -> Psf:
    """Return the PSF that a fit describes in a window (pixels, pixel_um); ``started`` is a `perf_counter` reading."""
    intensity, sampling = summed(found, *window, quality)
    tolerance = SETTLED_TOLERANCE if quality == "settled" else None
    error = predicted_error(found.error_waves, "fitted")
    made = Origin("fitted", found.numbers, found.rays, sampling, started, tolerance, error)
    blur = masked_blur(found) if resolved(found.steepness.spread, window[1]) else None
    return psf_from_intensity(intensity, window[1], wavelength_um, blur, made)


def summed(
    found: FittedPencil, pixels: int, pixel_um: float, quality: str = "settled", dtype: DTypeLike | None = None
) -> tuple[np.ndarray, Message]:
    """Return the intensity of a fit, (pixels, pixels), in units of the unaberrated peak, and the nodes it took."""
    dtype = dtype or (np.float64 if quality == "settled" else np.float32)
    skew = skew_rows_for(found, pixels, pixel_um, quality) if found.level.skew and found.mask.clear else None
    if skew is not None:
        phase, fx = found.at_points(skew.xi, skew.eta)
        intensity = skew.intensity(phase, fx, found.weight_at(skew.xi, skew.eta), pixels, pixel_um, dtype)
        return intensity, Message("{nodes}, {precision}", nodes=skew.words, precision=intensity.dtype.name)
    in_rows = takes_rows(found.mask) and not found.level.skew
    parts = discs(found, pixels, pixel_um, quality) if in_rows else None
    if parts is None:
        counts = counts_for(found.steepness, pixels, pixel_um)
        if counts[0] * counts[1] > MOST_NODES:
            raise too_many(*counts, pixels, pixel_um)
        intensity, words = fitted_intensity(found, counts, pixels, pixel_um, dtype), disc_words(counts)
    else:
        edges = edges_of_fit(found, pixels, pixel_um, dtype)
        intensity, words = intensity_over(parts, of_fit, edges, pixels, pixel_um, dtype), parts[0].rows.words
    return intensity, Message("{nodes}, {precision}", nodes=words, precision=intensity.dtype.name)


def fitted_intensity(
    found: FittedPencil, counts: tuple[int, int], pixels: int, pixel_um: float, dtype: DTypeLike = np.float64
) -> np.ndarray:
    """Return |Σ weight·exp(2πi(w + f·x))|² of a fit over its open pupil, (pixels, pixels): the plain sum."""
    nodes, axis = _nodes(found.mask, *counts, bool(found.level.skew)), centred_axis(pixels, pixel_um)
    weight = nodes.weight * nodes.amplitude * found.weight_at(nodes.xi, nodes.eta)
    weight /= weight.sum() / nodes.weight.sum()
    field = np.zeros((pixels, pixels), np.result_type(dtype, np.complex64))
    for some, (phase, fx, fy) in _at_nodes(found, nodes, counts):
        phase = phase + nodes.part(some).path_um / found.wavelength_um if found.mask.phased else phase
        amplitude = pupil_amplitude(weight[some], phase, dtype)
        field += sum_plane_waves(amplitude, fx.astype(dtype), fy.astype(dtype), axis, axis, nodes.even)
    intensity: np.ndarray = field.real**2 + field.imag**2
    return intensity


def _at_nodes(found: FittedPencil, nodes: ClearNodes, counts: tuple[int, int]) -> Iterator[tuple[slice, Values]]:
    """Yield phase, fx and fy of a fit at its nodes, in blocks: of millions of nodes a basis takes gigabytes."""
    orders, skew = found.level.orders, bool(found.level.skew)
    if nodes.xi.size <= MOST_KEPT // 2:
        even, odd = (_kept_basis(orders[flag], *counts, flag, found.mask, skew) for flag in (False, True))
        yield slice(0, nodes.xi.size), found.on(even, odd)
        return
    for begin in range(0, nodes.xi.size, MOST_KEPT):
        some = slice(begin, begin + MOST_KEPT)
        at = nodes.xi[some], nodes.eta[some]
        yield some, found.on(basis(orders[0], *at, False), basis(orders[1], *at, True))


@lru_cache(maxsize=8)
def _kept_basis(order: int, radial: int, angular: int, odd: bool, mask: PupilMask, skew: bool) -> np.ndarray:
    nodes = _nodes(mask, radial, angular, skew)
    return basis(order, nodes.xi, nodes.eta, odd)


def _nodes(mask: PupilMask, radial: int, angular: int, skew: bool) -> ClearNodes:
    """Return nodes over the open pupil, for a fit without symmetry over all of it."""
    nodes = mask_nodes(mask, radial, angular)
    return nodes.unfolded() if skew else nodes
