"""A pencil as a function of spatial frequency, sampled on a uniform grid and summed by an FFT (handbook 5.8).

Phase and entrance-pupil point are polynomials over f = n'K/λ; the image of the unit circle is the edge and
|∂(ξ, η)/∂f| the amplitude (equal areas of the entrance pupil have equal weight, as in the reference). The
polynomials are Zernike's, so that a field in another direction is the same pupil with rotated coefficients.
"""

from collections.abc import Sequence
from dataclasses import fields, replace

import numpy as np

from p2sf.disc.basis import Kinds, Terms, at_nodes, determinant
from p2sf.disc.domain import HALF, ClearNodes, PupilDomain
from p2sf.disc.mask import PupilMask
from p2sf.disc.zernike import basis_by_powers
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, Surface, seen_from
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.pixel_kernels.pupil_stack import PixelPupil, PupilStack, frequency_basis, with_reach
from p2sf.pupil.clear_pieces import CLIPPED
from p2sf.pupil.fit import Level, PencilForms, fit, level_rays, pencil_forms
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.aiming import Sources, pupil_rays, start
from p2sf.raytrace.pencil import all_reaching, in_azimuth, on_sensor
from p2sf.raytrace.trace import lens_rims, run

ORDERS = 6, 18  # the smallest and the largest
FAR_OFF = 30.0  # times the allowed residual: then the next order but one is tried, since the next seldom suffices
NODES = 16, 44
FEWER_NODES, SPARSE = (10, 28), 8  # enough for terms up to this order where no rim clips
PHASE_RESIDUAL = 2e-4  # waves RMS: 2e-3 of relative L2 in the finest detail, less in a pixel
POINT_RESIDUAL = 5e-4  # of the pupil radius
NEARLY_CLEAR = -0.15  # of 1 − (height/rim)²: nodes up to here count as clear, since the rim lies between them
CLIPPED_SHARE, BESIDE = 0.03, 1.7  # the part that clipped nodes have in a fit, and up to which square of u


def pupil_map(lens: Lens, source: Source, method: str, numbers: int | None = None, clip: bool = False) -> PixelPupil:
    """Return the pupil of one source by the method "seidel" or "fitted"; ``clip`` lets the clear rims clip it.

    It is given in the axes of the source's field.

    Raises GeometryError if rays do not reach the sensor, rims clip all of them, or the image lies at infinity.
    """
    mask, turned = mask_seen(lens, source), seen_from(lens, source.azimuth_deg)
    source = replace(source, azimuth_deg=0.0)
    return replace(PUPILS[method](turned, source, numbers, clip).one(0), mask=mask)


def _by_six(lens: Lens, source: Source, numbers: int | None, clip: bool) -> PupilStack:
    return seidel_pupils(lens, [source], clip)


def _by_fit(lens: Lens, source: Source, numbers: int | None, clip: bool) -> PupilStack:
    found = fit(lens, source, numbers)
    if lens.sensor_surface.curvature:
        return pupils_of(lens, [source], fitted_forms(lens, [source], found.level)[0], found.level, clip)
    columns = (found.phase, found.fx, found.fy, found.amplitude, found.residual_waves)
    forms = PencilForms(*(np.array([v]) for v in (*columns, found.map_residual, found.amplitude_residual)))
    return pupils_of(lens, [source], forms, found.level, clip)


PUPILS = {"seidel": _by_six, "fitted": _by_fit}
"""By method, of one source."""


def of_azimuths(sources: Sequence[Source]) -> list[list[int]]:
    """Return the numbers of the sources of each azimuth, which are traced together."""
    groups: dict[float, list[int]] = {}
    for number, source in enumerate(sources):
        groups.setdefault(source.azimuth_deg, []).append(number)
    return list(groups.values())


def fitted_forms(lens: Lens, sources: Sequence[Source], level: Level) -> tuple[PencilForms, np.ndarray]:
    """Return the fits of one level to several sources in the axes of the sensor, and their landing points, (n, 2) mm.

    Raises GeometryError where rays do not reach the sensor.
    """
    groups = of_azimuths(sources)
    points = level_rays(level)[:2]
    rays = [all_reaching(on_sensor(lens, [sources[k] for k in group], *points)).along_axis(lens) for group in groups]
    forms, order = [pencil_forms(some, level) for some in rays], np.argsort(np.concatenate(groups))
    landed = [np.concatenate(np.broadcast_arrays(some.chief_x, some.chief_y), axis=1) for some in rays]
    columns = ([getattr(form, field.name) for form in forms] for field in fields(PencilForms))
    # The amplitude of unweighted rays is one for all.
    joined = (several[0] if len(forms) == 1 else np.concatenate(several)[order] for several in columns)
    return PencilForms(*joined), np.concatenate(landed)[order]


def pupils_of(
    lens: Lens, sources: Sequence[Source], fits: PencilForms, level: Level, clip: bool = False, order: int = ORDERS[0]
) -> PupilStack:
    """Return the pupils of fits, (n, terms), all of the least order from ``order`` on that describes each of them.

    Raises GeometryError where rims clip all rays of a source.
    """
    rims, behind = _rims(lens, sources, clip, level.basis.domain), _mask_of(lens, sources)
    while True:
        found, excess = _of_order(order, fits, level, rims)
        if excess < 1 or order == ORDERS[-1]:
            waves = np.array([source.wavelength_um for source in sources])
            return with_reach(replace(found, mask=behind, wavelength_um=waves))
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
    limits = lens_rims(lens, keep_stop=False)
    rays, found = pupil_rays(lens, Sources.of(sources), *points), []
    beam = start(rays)

    def visit(number: int) -> None:
        if number <= len(lens.surfaces):
            found.extend(_clearances(lens.surfaces[number - 1], float(limits[number - 1]), beam.x, beam.y))

    run(lens, beam, rays.index, visit=visit)
    return np.stack(found, axis=1)


def _clearances(surface: Surface, limit: float, x: np.ndarray, y: np.ndarray) -> list[np.ndarray]:
    """Return what is positive where a surface is open: of its circle or both sides of its rectangle, and its hole."""
    rim = surface.rim
    across, up = rim.about_centre(x, y) if rim else (x, y)
    square, found = across * across + up * up, []
    if rim and rim.half_widths:
        found += [1 - (along / half) ** 2 for along, half in zip((across, up), rim.half_widths, strict=True)]
    elif np.isfinite(limit):
        found.append(1 - square / limit**2)
    if surface.inner_radius:
        found.append(square / surface.inner_radius**2 - 1)
    return found


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


def _of_order(order: int, fits: PencilForms, level: Level, rims: np.ndarray) -> tuple[PupilStack, float]:
    """Return the pupils of fits by terms up to an order, and the worst of their misses over what is allowed.

    What rims clip is described only as far as the clear part allows.
    """
    where = FEWER_NODES if order <= SPARSE and not rims.shape[1] else NODES
    at = at_nodes(level.basis, where)
    phase, fy = fits.phase @ at.values.phase, fits.fy @ at.values.fy
    amplitude = fits.amplitude @ at.values.fy[: fits.amplitude.shape[-1]]
    fx, eta = fits.fx @ at.values.fx, np.broadcast_to(at.nodes.eta, phase.shape)
    clear = np.asarray((rims > NEARLY_CLEAR).all(1)) if rims.shape[1] else np.ones(phase.shape, bool)
    fx, fy = _centre_frequencies(fx, clear, level.basis.fx), _centre_frequencies(fy, clear, level.basis.fy)
    radius = 1.02 * np.where(clear, np.hypot(fx, fy), 0.0).max(1)
    u, v = fx / radius[:, None], fy / radius[:, None]
    share = np.where(clear, 1.0, np.where(u * u + v * v <= BESIDE, CLIPPED_SHARE, 0.0))[:, None]
    columns = np.stack([phase, eta, *([amplitude] if level.weighted else [])], axis=1)
    if rims.shape[1]:
        columns = np.concatenate([columns, rims], axis=1)
    basis, kinds = frequency_basis(order, level.basis.domain), basis_kinds(order, u, v)
    rows = basis.phase.of(kinds)
    found = _solve(rows * share, columns * share)
    xi = _solve(basis.fx.of(kinds) * share, share * at.nodes.xi)[:, 0]
    waves, miss = ((found[:, k, None] @ rows)[:, 0] - true for k, true in enumerate((phase, eta)))
    area = np.where(clear, at.nodes.weight, 0.0)
    residual = np.sqrt((area * waves**2).sum(1) / area.sum(1))
    excess = max(float(residual.max()) / PHASE_RESIDUAL, float(np.abs(miss * clear).max()) / POINT_RESIDUAL)
    first = 2 + level.weighted  # of the rims
    amplitude_of = found[:, 2] if level.weighted else np.empty((len(found), 0))
    # By Parseval ∫|field|²dx = ∫amplitude²/|∂f/∂(ξ, η)| dξ dη.
    light = amplitude**2 / np.abs(determinant(fits.fx, fits.fy, *at.map_slopes))
    energy = np.pi * ((rims > 0).all(1) * light if rims.shape[1] else light) @ at.nodes.weight
    forms = found[:, 0], found[:, 1], xi, amplitude_of, found[:, first:]
    unknown, left = np.full(len(found), np.nan), np.hypot(residual, fits.residual_waves)
    sizes = energy, unknown, left, unknown
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
