"""Phase, image-space direction cosines and amplitude of a pencil as polynomials over the pupil (handbook 5.3).

The diffraction integral is a Fourier transform over direction cosines; with W, Kx and Ky all given over the pupil disc
it needs no edge and no Jacobian, the rays stay at fixed pupil points, and a fit is one small product with a constant
least-squares inverse. Rays that fill the real stop have varying weights, which are fitted by a polynomial too.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from math import prod
from typing import NamedTuple, TypeAlias

import numpy as np

from p2sf.conventions import write_protect
from p2sf.disc.basis import Gradient, PupilBasis, PupilValues, at_nodes
from p2sf.disc.disc_function import Counts, DiscFunction
from p2sf.disc.domain import HALF, HELD_OUT, WHOLE, ClearNodes, PupilDomain
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.disc.mask_nodes import mask_nodes
from p2sf.errors import GeometryError, SamplingError
from p2sf.lens.lens import Aim, Lens
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import Stop
from p2sf.pupil.plane_waves import Waves, counts_for, pupil_amplitude
from p2sf.pupil.pupil import Pupil, PupilWaves
from p2sf.pupil.seen_mask import mask_seen, with_slopes
from p2sf.pupil.watch import Watch
from p2sf.raytrace.pencil import Rays, reaching
from p2sf.raytrace.ray_field import Steepness, map_slopes, steepness, with_map

# RMS phase error in waves up to which an order is accepted: 1 − R² then stays below some (4πσ)² = 2e-3.
RESIDUAL_WAVES = 3.5e-3
# Weight s^a·(1 − s)^b of a ray at s = ρ², in addition to its area: the centre forms the core of the PSF, and at the rim
# a polynomial deviates first. Near Chebyshev's weight; chosen on the stored references among powers in steps of 1/4.
JUDGES = 6, 20  # radii and directions of the rays that check a fit where a mask is open
CENTRE_POWER, RIM_POWER = -0.75, -0.5
SLOPE_WEIGHT = 0.1  # relative to the phase: of 1/40, 1/20, 1/10 and 1/5 the best for the worst misaligned lenses
RayTerms: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""Coefficients of phase, fx, fy and amplitude in the terms of a level, each (…, terms)."""
NodesOf: TypeAlias = Callable[[Counts], ClearNodes]
MOST_NODES = 2**24  # radii × directions: some seconds of work
PREVIEW = 0.9  # of the settled counts: 1 − R² against the settled sum is below 1e-5
BLUR_NODES = 16, 40  # carry the weight and the area of a fit, which are smooth


@dataclass(frozen=True)
class Level:
    """The size of a fit: the terms of phase and maps, and the radii × directions of the rays it is made from.

    ``weighted``: the rays have weights, a polynomial of the maps' order. Over the whole disc there are as many rays on
    average on a ring as there are directions. ``by_slopes``: the phase is fitted to its slopes too, which follow from
    the landing points, so that the same rays determine more terms.
    """

    basis: PupilBasis
    radii: int
    directions: int
    weighted: bool = False
    by_slopes: bool = False

    @property
    def counts(self) -> Counts:
        """Return as many radii and directions as determine its polynomials, and integrate products of two of them."""
        order = max(self.basis.orders)
        return order // 2 + 1, 2 * order + 2

    def function(self, phase: np.ndarray, fx: np.ndarray, fy: np.ndarray, amplitude: np.ndarray) -> DiscFunction:
        """Return the polynomials of these coefficients, each (…, terms): phase, fx, fy and amplitude as channels."""
        there = at_nodes(self.basis, self.counts).values
        light = there.fy[: amplitude.shape[-1]]  # its terms are those of fy, or the first of them
        values = np.empty((*phase.shape[:-1], len(ODD), light.shape[-1]))
        pairs = (phase, there.phase), (fx, there.fx), (fy, there.fy), (amplitude, light)
        for channel, (coefficients, rows) in enumerate(pairs):
            values[..., channel, :] = coefficients @ rows
        return DiscFunction(values, self.counts, ODD, self.basis.domain)

    def coefficients(self, function: DiscFunction) -> RayTerms:
        """Return the coefficients that give a `function`: means of products, which are exact."""
        there = at_nodes(self.basis, self.counts)
        values, share = there.values, there.nodes.weight
        rows = values.phase, values.fx, values.fy, values.fy
        phase, fx, fy, light = (function.values[..., k, :] @ (share * row).T for k, row in enumerate(rows))
        return phase, fx, fy, light

    @property
    def numbers(self) -> int:
        """Return the number of coefficients of the level."""
        return self.unweighted_numbers + self.basis.fy.count * self.weighted

    @property
    def unweighted_numbers(self) -> int:
        """Return the number of coefficients of phase and maps, without those of the weights."""
        return self.basis.phase.count + self.basis.fx.count + self.basis.fy.count

    @property
    def rays(self) -> int:
        """Return the number of rays traced, including those held out."""
        return self.radii * self.directions + len(HELD_OUT[0])


LEVELS = (
    Level(PupilBasis(6, 3), 6, 10),
    Level(PupilBasis(8, 5), 6, 10),
    Level(PupilBasis(10, 7), 7, 12),
    Level(PupilBasis(14, 9), 9, 16),
    Level(PupilBasis(18, 13), 12, 20),
    Level(PupilBasis(24, 18), 15, 26),
)
WEIGHTED = tuple(replace(level, weighted=True) for level in LEVELS)
NOT_SYMMETRIC = (
    Level(PupilBasis(6, 3, WHOLE), 6, 10, True),
    Level(PupilBasis(10, 6, WHOLE), 6, 10, True, True),
    Level(PupilBasis(10, 7, WHOLE), 7, 18, True),
    Level(PupilBasis(14, 9, WHOLE), 9, 26, True),
    Level(PupilBasis(18, 13, WHOLE), 12, 36, True),
    Level(PupilBasis(24, 18, WHOLE), 15, 50, True),
)
SIZES: dict[tuple[PupilDomain, Aim], tuple[Level, ...]] = {
    (HALF, "paraxial"): LEVELS,
    (HALF, "stop"): WEIGHTED,
    (WHOLE, "paraxial"): NOT_SYMMETRIC,
    (WHOLE, "stop"): NOT_SYMMETRIC,
}
UNIFORM = write_protect(np.ones(1))  # the first polynomial is 1
ODD = False, True, False, False  # in ξ, where the pupil is symmetric: phase, fx, fy and amplitude
PHASE, MAP, AMPLITUDE = slice(0, 1), slice(1, 3), slice(3, 4)  # of those channels


def levels(aim: Aim, domain: PupilDomain = HALF) -> tuple[Level, ...]:
    """Return the levels of fit for a pupil filled according to `Lens.aim` and known over a domain."""
    return SIZES[domain, aim]


def levels_for(lens: Lens) -> tuple[Level, ...]:
    """Return the levels of fit for a lens."""
    return levels(lens.aim, lens.pupil_domain)


@dataclass(frozen=True, eq=False)
class FittedPencil(Pupil):
    """Phase in waves, fx and fy in cycles per µm and `Rays.amplitude` over the pupil: the channels of ``function``.

    ``residual_waves`` is the RMS error of the phase where the rays land, ``map_residual`` that of (fx, fy) in cycles
    per µm, ``amplitude_residual`` that of the amplitude over its mean; ``rays`` counts all that were traced;
    ``blur_um2`` is ∫|field|²dx at unit unaberrated peak of the clear disc, NaN where its map folds. The amplitude, 1
    where the paraxial pupil is filled, excludes the ``mask``, which is given in the pupil coordinates of the source and
    whose phase scales with ``wavelength_um``. ``nodes_of``: the nodes of (radial, angular) counts where rims end the
    pupil, which no polynomial knows.
    """

    level: Level
    function: DiscFunction
    residual_waves: float
    steepness: Steepness
    blur_um2: float
    rays: int
    map_residual: float = np.nan
    amplitude_residual: float = 0.0
    mask: PupilMask = CLEAR
    wavelength_um: float = np.nan
    nodes_of: NodesOf | None = None
    method: str = "fitted"

    @property
    def numbers(self) -> int:
        """Return the number of coefficients of this pencil."""
        return self.level.numbers

    @property
    def edges(self) -> bool:
        """Return whether rims end it."""
        return self.nodes_of is not None

    @property
    def resolved(self) -> bool:
        """Return that one sum suffices: its steepness is known, and where it ends."""
        return True

    @property
    def error_waves(self) -> float:
        """Return the RMS phase error over all light; the error of the map is weighted by the spread due to diffraction.

        An amplitude error changes the field as much as a phase of 1/2π of it does.
        """
        phase = np.hypot(self.residual_waves, self.map_residual * self.steepness.light_um)
        return float(np.hypot(phase, self.amplitude_residual / (2 * np.pi)))

    def jacobian(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return ∂(fx, fy)/∂(ξ, η) at pupil points, (points,), (cycles/µm)²."""
        return area_of(self.function.channels(MAP).slopes_at(xi, eta))

    def nodes(self, counts: Counts) -> ClearNodes:
        """Return nodes over the open part, about as dense as ``counts`` are over the disc."""
        if self.nodes_of:
            return self.nodes_of(counts)
        return self.level.basis.domain.over(mask_nodes(self.mask, *counts))

    def counts(self, reach_um: float, quality: str = "settled") -> Counts:
        """Return the node counts that resolve it up to a distance from the chief ray; SamplingError for too many."""
        counts = counts_for(self.steepness, reach_um, 1.0 if quality == "settled" else PREVIEW)
        if prod(counts) > MOST_NODES:
            raise SamplingError(
                "this blur over a window {width:.3g} µm wide needs {radii} × {directions} pupil samples; bring the "
                "sensor nearer to the image, stop down, or show a smaller window",
                width=reach_um * np.sqrt(2),
                radii=counts[0],
                directions=counts[1],
            )
        return counts

    def sample(self, counts: Counts, reach_um: float = np.inf, watch: Watch | None = None) -> PupilWaves:
        """Return the plane waves of these nodes, with amplitudes of unit sum."""
        nodes, whole = self.nodes(counts), self.mask.clear and not self.nodes_of
        phase, fx, fy, amplitude = self.function.on(counts) if whole else self.function.at(nodes.xi, nodes.eta)
        if self.mask.phased:
            phase = phase + nodes.path_um / self.wavelength_um
        weight = nodes.weight * nodes.amplitude * amplitude
        weight /= weight.sum()
        blur = self.steepness.radial / self.steepness.spread
        fx, fy = fx.copy(), fy.copy()  # so that the array of all channels needs no memory during the sum
        waves = Waves(pupil_amplitude(weight, phase), fx, fy, nodes.domain, blur, reach_um)
        return PupilWaves(waves, counts, self.rays)

    def light_um2(self) -> float | None:
        """Return ∫|field|²dx in µm² at unit unaberrated peak of its own pupil, by Parseval; None where it folds."""
        if not self.nodes_of and self.mask.clear and np.isfinite(self.blur_um2):  # not known of a fit looked up
            return self.blur_um2
        nodes = self.nodes(BLUR_NODES)
        area = self.jacobian(nodes.xi, nodes.eta)
        if not area.min() * area.max() > 0:
            return None
        field = nodes.amplitude * self.function.at(nodes.xi, nodes.eta)[-1]
        field = field / ((nodes.weight * field).sum() / nodes.weight.sum())
        return float(nodes.weight @ (field * field / np.abs(area)) / (np.pi * nodes.share))


def area_of(slopes: Gradient) -> np.ndarray:
    """Return ∂(fx, fy)/∂(ξ, η), (…, points), from ∂/∂ξ and ∂/∂η of the channels of the map."""
    across, along = slopes
    area: np.ndarray = across[..., 0, :] * along[..., 1, :] - along[..., 0, :] * across[..., 1, :]
    return area


def fit(
    lens: Lens,
    source: Source,
    numbers: int | None = None,
    stop: Stop | None = None,
    residual_waves: float = RESIDUAL_WAVES,
    first: int = 0,
) -> FittedPencil:
    """Fit one source's pencil; the order is raised until the residual is small enough, or is fixed by ``numbers``.

    ``first``: the index of the first of `levels` to try.
    ``numbers``: those of a level, with or without those of its weight, so that one count serves every `Lens.aim`.
    Raises GeometryError if the chief ray or any ray required by the fit does not reach the sensor.
    """
    mask = mask_seen(lens, source)
    checks: CheckRays | None = None
    traced, rays, sampling, found = 0, None, None, None
    for place, level in enumerate(levels_for(lens)[first:], first):
        if numbers not in (None, level.numbers, *_counts_of(place)):
            continue
        if rays is None or sampling != (level.radii, level.directions):
            if checks is None and not mask.clear:
                rays, checks = _trace_both(lens, source, level, mask, stop)
                traced += checks.share.size
            else:
                rays = _trace(lens, source, level, stop)
            sampling = level.radii, level.directions
            traced += level.rays
        found = fit_rays(rays, level, traced)
        if checks is not None:
            found = behind_mask(found, checks)
        if numbers or found.error_waves < residual_waves:
            break
    if found is None:
        offered = tuple(level.numbers for level in levels_for(lens))
        raise GeometryError("no fit has {numbers} numbers; choose one of {offered}", numbers=numbers, offered=offered)
    return found


def _counts_of(place: int) -> tuple[int, int]:
    """Return the numbers of a level of a symmetric lens, without and with those of its weight."""
    return LEVELS[place].numbers, WEIGHTED[place].numbers


@dataclass(frozen=True, eq=False)
class CheckRays:
    """Rays through the open part of a mask that check a fit, and the share of light of each."""

    mask: PupilMask
    wavelength_um: float
    xi: np.ndarray
    eta: np.ndarray
    share: np.ndarray
    data: Rays


def trace_check_rays(lens: Lens, source: Source, mask: PupilMask, stop: Stop | None = None) -> CheckRays:
    """Return rays through the open part of the pupil; GeometryError if one does not reach the sensor."""
    xi, eta, share = _check_points(mask, lens.pupil_domain)
    return CheckRays(mask, float(source.wavelength_um), xi, eta, share, reaching(lens, source, xi, eta, stop))


@lru_cache(maxsize=16)
def _check_points(mask: PupilMask, domain: PupilDomain) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return points of the open part of a domain, and shares of the light."""
    nodes = domain.over(mask_nodes(mask.without_vanes, *JUDGES))
    share: np.ndarray = nodes.weight * np.square(nodes.amplitude)
    return nodes.xi, nodes.eta, write_protect(share / share.sum())


def behind_mask(found: FittedPencil, checks: CheckRays) -> FittedPencil:
    """Return the fit behind a mask: its slopes added to the steepness, and residuals over its open part if larger."""
    data, share = checks.data, checks.share
    phase, fx, fy, amplitude = found.function.at(checks.xi, checks.eta)
    miss_x, miss_y = fx - data.fx, fy - data.fy
    error = phase - data.phase + miss_x * data.x_um + miss_y * data.y_um
    off = (amplitude - data.amplitude) / float(share @ data.amplitude)
    squares = (share @ error**2, share @ (miss_x**2 + miss_y**2), share @ off**2)
    own = found.residual_waves, found.map_residual, found.amplitude_residual
    residual, map_residual, amplitude_residual = (
        max(known, float(np.sqrt(square))) for known, square in zip(own, squares, strict=True)
    )
    return replace(
        found,
        residual_waves=residual,
        map_residual=map_residual,
        amplitude_residual=amplitude_residual,
        steepness=with_slopes(found.steepness, checks.mask, checks.wavelength_um),
        mask=checks.mask,
        wavelength_um=checks.wavelength_um,
    )


def _trace(lens: Lens, source: Source, level: Level, stop: Stop | None) -> Rays:
    xi, eta, _ = level_rays(level)
    return reaching(lens, source, xi, eta, stop)


def _trace_both(lens: Lens, source: Source, level: Level, mask: PupilMask, stop: Stop | None) -> tuple[Rays, CheckRays]:
    """Return the rays of a level and those that check it, traced together, which takes as long as either."""
    (xi, eta, _), (own_xi, own_eta, share) = level_rays(level), _check_points(mask, lens.pupil_domain)
    data = reaching(lens, source, np.append(xi, own_xi), np.append(eta, own_eta), stop)
    rays, checking = data.part(slice(xi.size)), data.part(slice(xi.size, None))
    return rays, CheckRays(mask, float(source.wavelength_um), own_xi, own_eta, share, checking)


@lru_cache(maxsize=16)
def level_rays(level: Level) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the pupil points (ξ, η) of a level's rays, those held out last, and the area weights of the others."""
    return level.basis.domain.sampling_rays(level.radii, level.directions)


@dataclass(frozen=True, eq=False)
class Projection:
    """The terms of phase, fx and fy of a level at its rays, and their least-squares inverses.

    ``slopes``: the inverses for ∂phase/∂ξ and ∂phase/∂η, to be added to that of the phase; none unless `by_slopes`.
    """

    rows: PupilValues
    phase: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    slopes: tuple[np.ndarray, ...] = ()


@lru_cache(maxsize=16)
def _projection(level: Level) -> Projection:
    xi, eta, weight = level_rays(level)
    rows = level.basis.values(xi, eta)
    square = (xi * xi + eta * eta)[: weight.size]
    root = np.sqrt(weight * square**CENTRE_POWER * (1 - square) ** RIM_POWER)
    own = [part[:, : weight.size] * root for part in rows]
    fx, fy = (np.linalg.pinv(part.T) * root for part in own[1:])
    if not level.by_slopes:
        return Projection(rows, np.linalg.pinv(own[0].T) * root, fx, fy)
    roots = np.concatenate([root, SLOPE_WEIGHT * root, SLOPE_WEIGHT * root])
    every = np.concatenate([part[:, : weight.size] for part in (rows.phase, *phase_slopes(level))], axis=1)
    phase, *slopes = np.split(np.linalg.pinv((every * roots).T) * roots, 3, axis=1)
    return Projection(rows, phase, fx, fy, tuple(slopes))


def phase_slopes(level: Level) -> Gradient:
    """Return (∂/∂ξ, ∂/∂η) of the terms of the phase of a level at its rays, those held out included."""
    return level.basis.phase.gradient(*level_rays(level)[:2])


def _slopes_of_phase(rays: Rays, level: Level, fx: np.ndarray, fy: np.ndarray) -> Gradient:
    """Return ∂phase/∂ξ and ∂phase/∂η at a level's own rays, (…, ray), by dw = −x·df (Hamilton) and a fitted map."""
    used = slice(level_rays(level)[2].size)
    (fx_xi, fx_eta), (fy_xi, fy_eta) = _slope_basis(level)
    x, y = rays.x_um[..., used], rays.y_um[..., used]
    return -(x * (fx @ fx_xi) + y * (fy @ fy_xi)), -(x * (fx @ fx_eta) + y * (fy @ fy_eta))


class Residuals(NamedTuple):
    """RMS errors of fits, each (…): of the phase where rays land, of (fx, fy) and of the amplitude over its mean."""

    of_phase: np.ndarray
    of_map: np.ndarray
    of_amplitude: np.ndarray


def fit_terms(rays: Rays, level: Level) -> RayTerms:
    """Return the least-squares coefficients for a level's rays, (…, ray), of one or several pencils."""
    project, used = _projection(level), level_rays(level)[2].size
    phase, fx, fy = (
        column[..., :used] @ inverse.T
        for inverse, column in ((project.phase, rays.phase), (project.fx, rays.fx), (project.fy, rays.fy))
    )
    if level.by_slopes:
        slopes = zip(project.slopes, _slopes_of_phase(rays, level, fx, fy), strict=True)
        phase = phase + sum(column @ inverse.T for inverse, column in slopes)
    return phase, fx, fy, rays.amplitude[..., :used] @ project.fy.T if level.weighted else UNIFORM


def residuals(rays: Rays, level: Level, found: RayTerms) -> Residuals:
    """Return what coefficients leave of a level's rays, those held out included."""
    _, _, area = level_rays(level)
    (phase, fx, fy, amplitude), used = found, area.size
    phase_rows, fx_rows, fy_rows = _projection(level).rows
    miss_x, miss_y = fx @ fx_rows - rays.fx, fy @ fy_rows - rays.fy
    # At a ray's landing point x the phase of the integrand is w + f·x, so this is the relevant error there.
    error = phase @ phase_rows - rays.phase + miss_x * rays.x_um + miss_y * rays.y_um
    known = 3 if level.by_slopes else 1  # of each ray
    of_phase = _residual(error, area, phase.shape[-1] / known)
    of_map = np.hypot(_residual(miss_x, area, fx.shape[-1]), _residual(miss_y, area, fy.shape[-1]))
    if not level.weighted:
        return Residuals(of_phase, of_map, np.zeros(phase.shape[:-1]))
    missed = _residual(amplitude @ fy_rows - rays.amplitude, area, amplitude.shape[-1])
    return Residuals(of_phase, of_map, missed / (rays.amplitude[..., :used] @ area))


def fit_rays(rays: Rays, level: Level, traced: int, steep: Steepness | None = None) -> FittedPencil:
    """Return the fit of one level to its rays; their `steepness` is computed unless ``steep`` gives it."""
    xi, eta, weight = level_rays(level)
    found, share = fit_terms(rays, level), np.ones(1)
    if level.weighted:
        share = rays.amplitude[: weight.size] / float(weight @ rays.amplitude[: weight.size])
    _, fx, fy, _ = found
    (fx_xi, fx_eta), (fy_xi, fy_eta) = _slope_basis(level)
    slopes = by_xi, by_eta = np.stack([fx @ fx_xi, fy @ fy_xi]), np.stack([fx @ fx_eta, fy @ fy_eta])
    # Parseval: ∫|field|²dx is the area mean of (relative weight)²/|∂(fx, fy)/∂(ξ, η)| over π.
    area = area_of(slopes)
    blur = float(weight @ (share * share / np.abs(area)) / np.pi) if area.min() * area.max() > 0 else np.nan
    own = slice(weight.size)
    map_of = map_slopes(xi[own], eta[own], by_xi, by_eta)
    steep = with_map(steep or steepness(rays, xi, eta), map_of, rays.x_um[own], rays.y_um[own])
    left, of_map, of_light = map(float, residuals(rays, level, found))
    made = level, level.function(*found), left, steep, blur, traced, of_map, of_light
    return FittedPencil(*made, wavelength_um=float(rays.wavelength_um.item()))


def _residual(error: np.ndarray, weight: np.ndarray, unknowns: float) -> np.ndarray:
    """Return the larger RMS error: of the fit's own rays, corrected for its degrees of freedom, or of those held out.

    At the rim the error of a polynomial fit is four times its RMS; the held-out rays lie there, so their error counts
    half.
    """
    own, held = error[..., : weight.size], error[..., weight.size :]
    freedom = 1 - unknowns / weight.size
    of_held = np.square(held).mean(-1) / 4
    larger: np.ndarray = np.sqrt(np.maximum(np.square(own) @ weight / freedom, of_held))
    return larger


@lru_cache(maxsize=16)
def _slope_basis(level: Level) -> tuple[Gradient, Gradient]:
    """Return (∂/∂ξ, ∂/∂η) of the terms of fx and of fy at a level's own rays."""
    xi, eta, weight = level_rays(level)
    return level.basis.map_slopes(xi[: weight.size], eta[: weight.size])
