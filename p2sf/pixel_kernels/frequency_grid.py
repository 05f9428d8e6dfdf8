"""A pencil as a function of spatial frequency, sampled on a uniform grid and summed by an FFT (handbook 5.8).

Phase and entrance-pupil point are polynomials over f = n'K/λ; the image of the unit circle is the edge and
|∂(ξ, η)/∂f| the amplitude (equal areas of the entrance pupil have equal weight, as in the reference). The
polynomials are Zernike's, so that a field in another direction is the same pupil with rotated coefficients.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from p2sf.disc.basis import Kinds, Terms
from p2sf.disc.disc_function import Counts, DiscFunction
from p2sf.disc.domain import HALF, ClearNodes, PupilDomain
from p2sf.disc.mask import PupilMask
from p2sf.disc.zernike import basis_by_powers
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, seen_from
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.pixel_kernels.pupil_stack import PupilStack, frequency_basis, with_reach
from p2sf.pupil.clear_curves import CLIPPED, trace_rooms
from p2sf.pupil.fit import AMPLITUDE, MAP, Level, area_of, fit, fit_terms, level_rays, residuals
from p2sf.pupil.frequency_pupil import FOLDS
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.pencil import all_reaching, in_azimuth, on_sensor

ORDERS = 6, 18  # the smallest and the largest
FAR_OFF = 30.0  # times the allowed residual: then the next order but one is tried, since the next seldom suffices
NODES = 16, 44
FEWER_NODES, SPARSE = (10, 28), 8  # enough for terms up to this order where no rim clips
PHASE_RESIDUAL = 2e-4  # waves RMS: 2e-3 of relative L2 in the finest detail, less in a pixel
POINT_RESIDUAL = 5e-4  # of the pupil radius
NEARLY_CLEAR = -0.15  # of 1 − (height/rim)²: nodes up to here count as clear, since the rim lies between them
Fits: TypeAlias = tuple[DiscFunction, np.ndarray]
"""Fits of one level, the channels of `FittedPencil` with an axis of pupils first, and their RMS phase errors, waves."""
CLIPPED_SHARE, BESIDE = 0.03, 1.7  # the part that clipped nodes have in a fit, and up to which square of u


def pupil_map(lens: Lens, source: Source, method: str, numbers: int | None = None, clip: bool = False) -> PupilStack:
    """Return the pupil of one source by the method "seidel" or "fitted"; ``clip`` lets the clear rims clip it.

    It is given in the axes of the source's field.

    Raises GeometryError if rays do not reach the sensor, rims clip all of them, their map to frequencies folds, or the
    image lies at infinity.
    """
    mask, turned = mask_seen(lens, source), seen_from(lens, source.azimuth_deg)
    source = replace(source, azimuth_deg=0.0)
    return replace(PUPILS[method](turned, source, numbers, clip), mask=mask)


def _by_six(lens: Lens, source: Source, numbers: int | None, clip: bool) -> PupilStack:
    return seidel_pupils(lens, [source], clip)


def _by_fit(lens: Lens, source: Source, numbers: int | None, clip: bool) -> PupilStack:
    found = fit(lens, source, numbers)
    if lens.sensor_surface.curvature:
        return pupils_of(lens, [source], fits_of(lens, [source], found.level)[0], found.level, clip)
    one = replace(found.function, values=found.function.values[None])
    return pupils_of(lens, [source], (one, np.array([found.residual_waves])), found.level, clip)


PUPILS = {"seidel": _by_six, "fitted": _by_fit}
"""By method, of one source."""


def of_azimuths(sources: Sequence[Source]) -> list[list[int]]:
    """Return the numbers of the sources of each azimuth, which are traced together."""
    groups: dict[float, list[int]] = {}
    for number, source in enumerate(sources):
        groups.setdefault(source.azimuth_deg, []).append(number)
    return list(groups.values())


def fits_of(lens: Lens, sources: Sequence[Source], level: Level) -> tuple[Fits, np.ndarray]:
    """Return the fits of one level to several sources in the axes of the sensor, and their landing points, (n, 2) mm.

    Raises GeometryError where rays do not reach the sensor.
    """
    groups = of_azimuths(sources)
    points = level_rays(level)[:2]
    rays = [all_reaching(on_sensor(lens, [sources[k] for k in group], *points)).along_axis(lens) for group in groups]
    found, order = [fit_terms(some, level) for some in rays], np.argsort(np.concatenate(groups))
    landed = [np.concatenate(np.broadcast_arrays(some.chief_x, some.chief_y), axis=1) for some in rays]
    left = [residuals(some, level, terms).of_phase for some, terms in zip(rays, found, strict=True)]
    functions = [level.function(*terms) for terms in found]
    values = np.concatenate([one.values for one in functions])[order]
    return (replace(functions[0], values=values), np.concatenate(left)[order]), np.concatenate(landed)[order]


def pupils_of(
    lens: Lens, sources: Sequence[Source], fits: Fits, level: Level, clip: bool = False, order: int = ORDERS[0]
) -> PupilStack:
    """Return the pupils of fits, all of the least order from ``order`` on that describes each of them.

    Raises GeometryError where rims clip all rays of a source, or its map folds.
    """
    rims, behind = _rims(lens, sources, clip, level.basis.domain), _mask_of(lens, sources)
    (function, left), counts = fits, (0, 0)
    while True:
        where = FEWER_NODES if order <= SPARSE and not rims.shape[1] else NODES
        if counts != where:
            samples, xi, counts = _samples(function, level, rims, where), function.domain.nodes(where).xi, where
        found, excess = _of_order(order, samples, xi, level)
        if excess < 1 or order == ORDERS[-1]:
            residual, waves = np.hypot(found.residual_waves, left), [source.wavelength_um for source in sources]
            known = {"energy": _energy(function, rims, where), "residual_waves": residual}
            return with_reach(replace(found, mask=behind, wavelength_um=np.array(waves), **known))
        order = min(order + (4 if excess > FAR_OFF else 2), ORDERS[-1])


def _mask_of(lens: Lens, sources: Sequence[Source]) -> PupilMask:
    """Return the pupil mask in the axes of the sensor."""
    return mask_seen(lens, Source(wavelength_um=sources[0].wavelength_um))


def _rims(lens: Lens, sources: Sequence[Source], clip: bool, domain: PupilDomain) -> np.ndarray:
    """Return 1 − (height/rim)² where rays of the pupil's nodes meet each surface that has a rim.

    Of a hole or a shadow, (height/radius)² − 1. (Sources, rims, nodes); no rims unless ``clip``. Raises
    GeometryError where these clip all rays of a source.
    """
    nodes = domain.nodes(NODES)
    if not clip:
        return np.empty((len(sources), 0, nodes.xi.size))
    groups = of_azimuths(sources)
    rims = np.concatenate([_rims_of([sources[k] for k in group], lens, nodes) for group in groups])
    if np.any(np.max(np.min(rims, axis=1), axis=1) <= 0):
        raise GeometryError(CLIPPED, parameter="clip")
    return rims[np.argsort(np.concatenate(groups))]


def _rims_of(sources: Sequence[Source], lens: Lens, nodes: ClearNodes) -> np.ndarray:
    """Return the rims of sources of one azimuth at pupil nodes in the axes of the sensor."""
    lens, points = in_azimuth(lens, sources[0].azimuth_deg, nodes.xi, nodes.eta)
    return trace_rooms(lens, Sources.of(sources), *points).room


def seidel_pupils(lens: Lens, points: Sequence[Source], clip: bool = False) -> PupilStack:
    """Return the pupils of several sources, (n,), by their Seidel coefficients.

    Raises GeometryError where an image lies at infinity, or rims clip all rays.
    """
    rims, sources = _rims(lens, points, clip, HALF), Sources.of(points)
    six = coefficients(lens, sources.depth_mm, sources.field_slope, sources.wavelength_um)
    scale = -np.asarray(six.reduced_slope) / sources.wavelength_um
    _, slope = lens.sensor_surface.sag_and_slope(np.square(six.image_height))
    short = (
        1 / np.sqrt(1 + np.square(2 * slope * six.image_height))[:, None]
    )  # of a curved sensor along y, as pixels count
    if not scale.all():
        raise GeometryError("the image lies at infinity, so the sensor sees no blur of finite size; move the object")
    nodes, sign = HALF.nodes(NODES), np.sign(scale)[:, None]
    basis = frequency_basis(ORDERS[0] if rims.shape[1] else 4, HALF)
    kinds = basis_kinds(basis.wave_order, sign * short * nodes.xi, sign * nodes.eta)
    phase = wavefront(six, nodes.xi, nodes.eta)
    eta, across = (np.broadcast_to(v, phase.shape) for v in (nodes.eta, nodes.xi))
    found = _solve(basis.phase.of(kinds), np.concatenate([np.stack([phase, eta], axis=1), rims], axis=1))
    xi = _solve(basis.fx.of(kinds), across[:, None])[:, 0]
    energy = np.pi * np.where((rims > 0).all(1), nodes.weight, 0.0).sum(1) / scale**2 * short[:, 0]
    none, unknown = np.empty((len(scale), 0)), np.full(len(scale), np.nan)
    forms = found[:, 0], found[:, 1], xi, none, found[:, 2:]
    sizes = energy, unknown, 0 * scale, -np.asarray(sources.wavelength_um, float) + 0 * scale
    return with_reach(
        PupilStack(basis, np.abs(scale) / short[:, 0], *forms, *sizes, "seidel", 6, _mask_of(lens, points))
    )


def _energy(function: DiscFunction, rims: np.ndarray, where: Counts) -> np.ndarray:
    """Return the energy of fits as `PupilStack` has it: by Parseval ∫amplitude²/|∂f/∂(ξ, η)| dξ dη.

    Raises GeometryError where the map of one folds within its rims: there is no such energy.
    """
    nodes, amplitude = function.domain.nodes(where), function.channels(AMPLITUDE).on(where)[:, 0]
    area = area_of(function.channels(MAP).gradient(where))
    clear = (rims > 0).all(1) if rims.shape[1] else np.ones(area.shape, bool)
    if ((clear & (area > 0)).any(1) & (clear & (area < 0)).any(1)).any():
        raise GeometryError(FOLDS)
    energy: np.ndarray = np.pi * (clear * amplitude**2 / np.abs(area)) @ nodes.weight
    return energy


Samples: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def _samples(function: DiscFunction, level: Level, rims: np.ndarray, where: Counts) -> Samples:
    """Return fits at nodes of the pupil: columns, u and v, radius, area and share in the least squares of each.

    Columns are phase, η, amplitude if rays have weights, and rims, (n, columns, nodes). u and v, (2, n, nodes), are
    (f − centre)/radius.
    """
    nodes, values = function.domain.nodes(where), function.on(where)
    phase, fx, fy, amplitude = (values[:, channel] for channel in range(values.shape[1]))
    clear = np.asarray((rims > NEARLY_CLEAR).all(1)) if rims.shape[1] else np.ones(phase.shape, bool)
    fx, fy = _centre_frequencies(fx, clear, level.basis.fx), _centre_frequencies(fy, clear, level.basis.fy)
    radius = 1.02 * np.where(clear, np.hypot(fx, fy), 0.0).max(1)
    place = np.stack([fx, fy]) / radius[:, None]
    beside = np.where(np.square(place).sum(0) <= BESIDE, CLIPPED_SHARE, 0.0)
    columns = np.stack([phase, np.broadcast_to(nodes.eta, phase.shape), *[amplitude] * level.weighted], axis=1)
    columns = np.concatenate([columns, rims], axis=1) if rims.shape[1] else columns
    return columns, place, radius, np.where(clear, nodes.weight, 0.0), np.where(clear, 1.0, beside)[:, None]


def _of_order(order: int, samples: Samples, xi: np.ndarray, level: Level) -> tuple[PupilStack, float]:
    """Return the pupils of fits by terms up to an order, and the worst of their misses over what is allowed.

    ``xi``: of the nodes of the samples. What rims clip is described only as far as the clear part allows. The energy is
    not known.
    """
    columns, place, radius, area, share = samples
    basis, kinds = frequency_basis(order, level.basis.domain), basis_kinds(order, *place)
    rows = basis.phase.of(kinds)
    found = _solve(rows * share, columns * share)
    across = _solve(basis.fx.of(kinds) * share, share * xi)[:, 0]
    waves, miss = ((found[:, k, None] @ rows)[:, 0] - columns[:, k] for k in range(2))
    residual = np.sqrt((area * waves**2).sum(1) / area.sum(1))
    excess = max(float(residual.max()) / PHASE_RESIDUAL, float(np.abs(miss * (area > 0)).max()) / POINT_RESIDUAL)
    first = 2 + level.weighted  # of the rims
    weight = found[:, 2] if level.weighted else np.empty((len(found), 0))
    unknown = np.full(len(found), np.nan)
    forms, sizes = (found[:, 0], found[:, 1], across, weight, found[:, first:]), (unknown, unknown, residual, unknown)
    return PupilStack(basis, radius, *forms, *sizes, "fitted", level.numbers), excess


def _centre_frequencies(frequency: np.ndarray, clear: np.ndarray, terms: Terms) -> np.ndarray:
    """Return the frequencies of each pupil, (pupils, points), less the middle of the least and the greatest.

    Where the constant is none of their ``terms``, they are about 0 as they are.
    """
    if not terms.constant:
        return frequency
    ends = np.where(clear, frequency, -np.inf).max(1) + np.where(clear, frequency, np.inf).min(1)
    centred: np.ndarray = frequency - ends[:, None] / 2
    return centred


def basis_kinds(order: int, u: np.ndarray, v: np.ndarray) -> Kinds:
    """Return even and odd terms at points (n, points), each (n, terms, points)."""
    even, odd = (rows.reshape(-1, *u.shape).swapaxes(0, 1) for rows in basis_by_powers(order, u.ravel(), v.ravel()))
    return even, odd


def _solve(rows: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return least-squares coefficients, (n, values, terms), by the normal equations of nearly orthogonal terms."""
    normal = rows @ rows.swapaxes(1, 2)
    diagonal = np.arange(normal.shape[-1])
    normal[:, diagonal, diagonal] *= 1 + 1e-12
    found: np.ndarray = np.linalg.solve(normal, rows @ values.swapaxes(1, 2)).swapaxes(1, 2)
    return found
