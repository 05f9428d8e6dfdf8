"""Phase, image-space direction cosines and amplitude of a pencil as polynomials over the pupil (handbook 5.3).

The diffraction integral is a Fourier transform over direction cosines; with W, Kx and Ky all given over the
pupil disc it needs no edge and no Jacobian, the rays stay at fixed pupil points, and a fit is one small
product with a least-squares inverse that never changes. Rays that fill the real stop have uneven weights, which
are a polynomial too.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import protected
from p2sf.errors import GeometryError
from p2sf.lens.lens import Aim, Lens
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import Stop
from p2sf.pupil.mask import CLEAR, PupilMask
from p2sf.pupil.mask_nodes import mask_nodes
from p2sf.pupil.quadrature import disc_nodes, gauss_legendre
from p2sf.pupil.zernike import basis, columns, evaluate, gradient, terms
from p2sf.raytrace.pencil import Rays, reaching
from p2sf.raytrace.ray_field import Steepness, steepness
from p2sf.raytrace.seen_mask import mask_seen, with_slopes

# Rays held out of the fit to test it, on the rim, where a polynomial deviates first: (ξ, η).
HELD_OUT = np.array([[0.0, 0.0, 1.0, 0.6], [1.0, -1.0, 0.0, 0.8]])
SKEW_HELD_OUT_DEG = np.array([0.0, 80.0, 170.0, 260.0])  # of a lens without symmetry, from +η towards +ξ
# RMS phase error in waves up to which an order is kept: 1 − R² then stays below some (4πσ)² = 2e-3.
RESIDUAL_WAVES = 3.5e-3
# Weight s^a·(1 − s)^b of a ray at s = ρ², beside its area: the centre makes the core of the PSF, and at the rim a
# polynomial deviates first. Near Chebyshev's weight; chosen on the stored references among powers in steps of 1/4.
JUDGES = 6, 20  # radii and directions of the rays by which a fit is judged where a mask is open
CENTRE_POWER, RIM_POWER = -0.75, -0.5
RING_POWER = 1.3  # of a ring's radius: with 60 rays the terms of degree 8 have a condition number of 3

SLOPE_WEIGHT = 0.1  # of a slope beside the phase: of 1/40, 1/20, 1/10 and 1/5 the best for the worst misaligned lenses

Gradient: TypeAlias = tuple[np.ndarray, np.ndarray]  # ∂/∂ξ and ∂/∂η of some terms, each (terms, points)


@dataclass(frozen=True)
class Level:
    """The size of a fit: orders of W and of the maps, and the radii × directions of the rays it is made from.

    ``weighted``: the rays have weights, a polynomial of the maps' order. ``skew``: for a lens without symmetry, the
    orders, of phase and of maps and weight, up to which the fit also has the terms that symmetry about η forbids. The
    rays are then over the whole disc, as many on average on a ring as there are directions. ``by_slopes``: the phase
    is fitted to its slopes too, which are known from where the rays land, so that as many rays tell more terms.
    """

    wave_order: int
    map_order: int
    radii: int
    directions: int
    weighted: bool = False
    skew: tuple[int, int] | None = None
    by_slopes: bool = False

    @property
    def numbers(self) -> int:
        """Return how many coefficients the level has."""
        return self.unweighted_numbers + sum(self.counts[2]) * self.weighted

    @property
    def unweighted_numbers(self) -> int:
        """Return how many coefficients phase and maps have, without those of a weight."""
        return sum(map(sum, self.counts))

    @cached_property
    def counts(self) -> tuple[tuple[int, int], tuple[int, int], tuple[int, int]]:
        """Return how many terms phase, fx and fy have: those of their symmetry, and of the other, which come behind."""
        wave, maps = self.skew or (0, 0)  # no terms are odd at order 0
        others = len(terms(wave, True)), len(terms(maps)) if self.skew else 0, len(terms(maps, True))
        own = len(terms(self.wave_order)), len(terms(self.map_order, True)), len(terms(self.map_order))
        phase, fx, fy = zip(own, others, strict=True)
        return phase, fx, fy

    @property
    def orders(self) -> tuple[int, int]:
        """Return the orders of all terms that are even in ξ, and of all that are odd."""
        wave, maps = self.skew or (0, 0)
        return max(self.wave_order, self.map_order), max(self.map_order, wave, maps)

    @property
    def rays(self) -> int:
        """Return how many rays are traced, those held out included."""
        return self.radii * self.directions + len(HELD_OUT[0])


LEVELS = (
    Level(6, 3, 6, 10),
    Level(8, 5, 6, 10),
    Level(10, 7, 7, 12),
    Level(14, 9, 9, 16),
    Level(18, 13, 12, 20),
    Level(24, 18, 15, 26),
)
WEIGHTED = tuple(replace(level, weighted=True) for level in LEVELS)
SKEW = (
    Level(6, 3, 6, 10, True, (6, 3)),
    Level(10, 6, 6, 10, True, (10, 6), True),
    Level(10, 7, 7, 18, True, (10, 7)),
    Level(14, 9, 9, 26, True, (14, 9)),
    Level(18, 13, 12, 36, True, (18, 13)),
    Level(24, 18, 15, 50, True, (24, 18)),
)
UNIFORM = protected(np.ones(1))  # the first polynomial is 1


def levels(aim: Aim) -> tuple[Level, ...]:
    """Return the sizes of fit for a pupil that is filled as `Lens.aim` says."""
    return WEIGHTED if aim == "stop" else LEVELS


def levels_for(lens: Lens) -> tuple[Level, ...]:
    """Return the sizes of fit for a lens: those without symmetry if it is misaligned."""
    return SKEW if lens.misaligned else levels(lens.aim)


@dataclass(frozen=True)
class FittedPencil:
    """Coefficients of the orthonormal polynomials of `zernike`: phase in waves, fx and fy in cycles per µm.

    ``phase``, ``fy`` and ``amplitude`` belong to the even terms, ``fx`` to the odd; without symmetry (`Level.skew`)
    each goes on with terms of the other kind. ``residual_waves`` is the RMS error of the phase where the rays land,
    ``map_residual`` that of (fx, fy) in cycles per µm, ``amplitude_residual`` that of the amplitude over its mean;
    ``rays`` counts all that were traced; ``blur_um2`` is ∫|field|²dx at unit unaberrated peak of the clear disc.
    ``amplitude`` is without the ``mask``, which stands in the pupil as the source sees it, and whose phase
    ``wavelength_um`` scales.
    """

    level: Level
    phase: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    residual_waves: float
    steepness: Steepness
    blur_um2: float
    rays: int
    map_residual: float = np.nan
    amplitude: np.ndarray = field(default_factory=lambda: UNIFORM)
    amplitude_residual: float = 0.0
    mask: PupilMask = CLEAR
    wavelength_um: float = np.nan

    @property
    def numbers(self) -> int:
        """Return how many coefficients describe this pencil."""
        return self.level.numbers

    @property
    def error_waves(self) -> float:
        """Return the RMS phase error over all the light: the map's error counts as far as diffraction spreads light.

        An error of the amplitude changes the field as a phase of 1/2π of it does.
        """
        phase = np.hypot(self.residual_waves, self.map_residual * self.steepness.light_um)
        return float(np.hypot(phase, self.amplitude_residual / (2 * np.pi)))

    def at(self, xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return phase (waves), fx and fy (cycles/µm) at pupil points, each (points,)."""
        even, odd = self.level.orders
        return self.on(basis(even, xi, eta), basis(odd, xi, eta, odd=True))

    def on(self, even: np.ndarray, odd: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return phase, fx and fy where the even and odd terms have these values, (terms, points)."""
        if self.level.skew:
            phase, fx, fy = rows_of(self.level, even, odd)
            return self.phase @ phase, self.fx @ fx, self.fy @ fy
        return self.phase @ even[: len(self.phase)], self.fx @ odd, self.fy @ even[: len(self.fy)]

    def amplitude_at(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return `Rays.amplitude` without the mask at points of any shape: 1 where the paraxial pupil is filled."""
        order = self.level.map_order if self.level.weighted else 0
        if self.level.skew is None:
            return evaluate(columns(self.amplitude, order), xi * xi, eta)
        own, square = self.level.counts[2][0], xi * xi
        odd = evaluate(columns(self.amplitude[own:], self.level.skew[1], True), square, eta)
        both: np.ndarray = evaluate(columns(self.amplitude[:own], order), square, eta) + xi * odd
        return both

    def jacobian(self, xi: ArrayLike, eta: ArrayLike) -> np.ndarray:
        """Return ∂(fx, fy)/∂(ξ, η) at pupil points, (cycles/µm)²."""
        return determinant(self.fx, self.fy, *map_slopes(self.level, xi, eta))


def fit(
    lens: Lens,
    source: Source,
    numbers: int | None = None,
    stop: Stop | None = None,
    residual_waves: float = RESIDUAL_WAVES,
    first: int = 0,
) -> FittedPencil:
    """Fit one source's pencil; the order rises until the residual is small enough, or is fixed by ``numbers``.

    ``first``: the number of the first of `levels` that is tried.
    ``numbers``: those of a level, with or without those of its weight, so that one count serves every `Lens.aim`.
    Raises GeometryError where the chief ray, or any ray that the fit needs, does not reach the sensor.
    """
    mask = mask_seen(lens, source)
    judges: Judges | None = None
    traced, rays, sampling, found = 0, None, None, None
    for place, level in enumerate(levels_for(lens)[first:], first):
        if numbers not in (None, level.numbers, *_counts_of(place)):
            continue
        if rays is None or sampling != (level.radii, level.directions):
            if judges is None and not mask.clear:
                rays, judges = _trace_both(lens, source, level, mask, stop)
                traced += judges.share.size
            else:
                rays = _trace(lens, source, level, stop)
            sampling = level.radii, level.directions
            traced += level.rays
        found = fit_rays(rays, level, traced)
        if judges is not None:
            found = behind(found, judges)
        if numbers or found.error_waves < residual_waves:
            break
    if found is None:
        offered = tuple(level.numbers for level in levels_for(lens))
        raise GeometryError("no fit has {numbers} numbers; choose one of {offered}", numbers=numbers, offered=offered)
    return found


def _counts_of(place: int) -> tuple[int, int]:
    """Return the numbers of a level of a symmetric lens, without and with those of its weight."""
    return LEVELS[place].numbers, WEIGHTED[place].numbers


@dataclass(frozen=True)
class Judges:
    """Rays through what a mask leaves open, and the share of the light of each: errors count there too."""

    mask: PupilMask
    wavelength_um: float
    xi: np.ndarray
    eta: np.ndarray
    share: np.ndarray
    data: Rays


def judging_rays(lens: Lens, source: Source, mask: PupilMask, stop: Stop | None = None) -> Judges:
    """Return rays through the open part of the pupil; GeometryError where one does not reach the sensor."""
    xi, eta, share = _judges_of(mask, lens.misaligned)
    return Judges(mask, float(source.wavelength_um), xi, eta, share, reaching(lens, source, xi, eta, stop))


@lru_cache(maxsize=16)
def _judges_of(mask: PupilMask, whole: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return points of the open part, over the half ξ > 0 or the ``whole`` disc, and shares of the light."""
    nodes = mask_nodes(replace(mask, vanes=0), *JUDGES)
    nodes = nodes.unfolded() if whole else nodes
    share: np.ndarray = nodes.weight * np.square(nodes.amplitude)
    return nodes.xi, nodes.eta, protected(share / share.sum())


def behind(found: FittedPencil, judges: Judges) -> FittedPencil:
    """Return the fit of the pupil behind a mask: steeper by its slopes, with residuals where it is open if larger."""
    data, share = judges.data, judges.share
    phase, fx, fy = found.at(judges.xi, judges.eta)
    miss_x, miss_y = fx - data.fx, fy - data.fy
    error = phase - data.phase + miss_x * data.x_um + miss_y * data.y_um
    off = (found.amplitude_at(judges.xi, judges.eta) - data.amplitude) / float(share @ data.amplitude)
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
        steepness=with_slopes(found.steepness, judges.mask, judges.wavelength_um),
        mask=judges.mask,
        wavelength_um=judges.wavelength_um,
    )


def _trace(lens: Lens, source: Source, level: Level, stop: Stop | None) -> Rays:
    xi, eta, _ = level_rays(level)
    return reaching(lens, source, xi, eta, stop)


def _trace_both(lens: Lens, source: Source, level: Level, mask: PupilMask, stop: Stop | None) -> tuple[Rays, Judges]:
    """Return the rays of a level and those that judge it, traced together, which takes as long as either."""
    (xi, eta, _), (own_xi, own_eta, share) = level_rays(level), _judges_of(mask, lens.misaligned)
    data = reaching(lens, source, np.append(xi, own_xi), np.append(eta, own_eta), stop)
    rays, judging = data.part(slice(xi.size)), data.part(slice(xi.size, None))
    return rays, Judges(mask, float(source.wavelength_um), own_xi, own_eta, share, judging)


@lru_cache(maxsize=16)
def level_rays(level: Level) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the pupil points (ξ, η) of a level's rays, those held out last, and the area weights of the others."""
    if level.skew:
        return _skew_rays(level)
    nodes = disc_nodes(level.radii, 2 * level.directions)
    return np.append(nodes.xi, HELD_OUT[0]), np.append(nodes.eta, HELD_OUT[1]), nodes.weight


def _skew_rays(level: Level) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return rays over the whole disc: on every ring as many as the harmonics need that are not small there.

    A term ρⁿ·cos mθ has n ≥ m, so that near the middle few directions do, while on the rim a polynomial of degree n
    takes 2n + 1. With as many on all rings, the same number of rays tells some terms apart by rounding alone.
    """
    square, weight = gauss_legendre(level.radii)
    rho, held = np.sqrt((1 + square) / 2), np.deg2rad(SKEW_HELD_OUT_DEG)
    counts = ring_counts(rho, level.radii * level.directions)
    angle = np.concatenate([(np.arange(count) + 0.25) * (2 * np.pi / count) for count in counts])
    radius, share = np.repeat(rho, counts), np.repeat(weight / 2 / counts, counts)
    xi, eta = radius * np.sin(angle), radius * np.cos(angle)
    return np.append(xi, np.sin(held)), np.append(eta, np.cos(held)), share


def ring_counts(rho: np.ndarray, total: int) -> np.ndarray:
    """Return how many of all rays are on each ring, in proportion to a power of its radius."""
    part = rho**RING_POWER
    counts: np.ndarray = np.maximum(1, np.rint(total * part / part.sum())).astype(int)
    counts[-1] += total - int(counts.sum())
    return counts


@dataclass(frozen=True)
class Projection:
    """The terms of phase, fx and fy of a level on its rays, and the least-squares inverses for them.

    ``slopes``: the inverses for ∂phase/∂ξ and ∂phase/∂η, whose parts add to that of the phase; none if not `by_slopes`.
    """

    rows: tuple[np.ndarray, np.ndarray, np.ndarray]
    phase: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    slopes: tuple[np.ndarray, ...] = ()


def rows_of(level: Level, even: np.ndarray, odd: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the terms of phase, fx and fy, (terms, points), out of all even and all odd ones."""
    phase, fx, fy = level.counts
    if level.skew is None:
        return even[: phase[0]], odd[: fx[0]], even[: fy[0]]
    pairs = ((even, odd, phase), (odd, even, fx), (even, odd, fy))
    one, two, three = (np.concatenate([own[: count[0]], other[: count[1]]]) for own, other, count in pairs)
    return one, two, three


@lru_cache(maxsize=16)
def _projection(level: Level) -> Projection:
    xi, eta, weight = level_rays(level)
    even, odd = level.orders
    rows = rows_of(level, basis(even, xi, eta), basis(odd, xi, eta, odd=True))
    square = (xi * xi + eta * eta)[: weight.size]
    root = np.sqrt(weight * square**CENTRE_POWER * (1 - square) ** RIM_POWER)
    own = [part[:, : weight.size] * root for part in rows]
    fx, fy = (np.linalg.pinv(part.T) * root for part in own[1:])
    if not level.by_slopes:
        return Projection(rows, np.linalg.pinv(own[0].T) * root, fx, fy)
    roots = np.concatenate([root, SLOPE_WEIGHT * root, SLOPE_WEIGHT * root])
    every = np.concatenate([part[:, : weight.size] for part in (rows[0], *phase_slopes(level))], axis=1)
    phase, *slopes = np.split(np.linalg.pinv((every * roots).T) * roots, 3, axis=1)
    return Projection(rows, phase, fx, fy, tuple(slopes))


def phase_slopes(level: Level) -> Gradient:
    """Return (∂/∂ξ, ∂/∂η) of the terms of the phase of a level at its rays, those held out included."""
    (xi, eta, _), (even, odd) = level_rays(level), level.orders
    both = zip(gradient(even, xi, eta), gradient(odd, xi, eta, odd=True), strict=True)
    across, along = (rows_of(level, *pair)[0] for pair in both)
    return across, along


def _slopes_of_phase(rays: Rays, level: Level, fx: np.ndarray, fy: np.ndarray) -> Gradient:
    """Return ∂phase/∂ξ and ∂phase/∂η at a level's own rays, (…, ray), by dw = −x·df (Hamilton) and a fitted map."""
    used = slice(level_rays(level)[2].size)
    (fx_xi, fx_eta), (fy_xi, fy_eta) = _slope_basis(level)
    x, y = rays.x_um[..., used], rays.y_um[..., used]
    return -(x * (fx @ fx_xi) + y * (fy @ fy_xi)), -(x * (fx @ fx_eta) + y * (fy @ fy_eta))


@dataclass(frozen=True)
class PencilForms:
    """The coefficients of one pencil or several, (…, terms), as `FittedPencil` has them, and their residuals, (…)."""

    phase: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    amplitude: np.ndarray
    residual_waves: np.ndarray
    map_residual: np.ndarray
    amplitude_residual: np.ndarray


def pencil_forms(rays: Rays, level: Level) -> PencilForms:
    """Return the least-squares coefficients of a level's rays, (…, ray), of one pencil or several."""
    _, _, area = level_rays(level)
    project, used = _projection(level), area.size
    phase, fx, fy = (
        column[..., :used] @ inverse.T
        for inverse, column in ((project.phase, rays.phase), (project.fx, rays.fx), (project.fy, rays.fy))
    )
    if level.by_slopes:
        slopes = zip(project.slopes, _slopes_of_phase(rays, level, fx, fy), strict=True)
        phase = phase + sum(column @ inverse.T for inverse, column in slopes)
    phase_rows, fx_rows, fy_rows = project.rows
    amplitude, amplitude_residual = UNIFORM, np.zeros(phase.shape[:-1])
    if level.weighted:
        amplitude = rays.amplitude[..., :used] @ project.fy.T
        miss = amplitude @ fy_rows - rays.amplitude
        amplitude_residual = _residual(miss, area, amplitude.shape[-1]) / (rays.amplitude[..., :used] @ area)
    miss_x, miss_y = fx @ fx_rows - rays.fx, fy @ fy_rows - rays.fy
    # At a ray's landing point x the integrand's phase is w + f·x, so this is the error that matters there.
    error = phase @ phase_rows - rays.phase + miss_x * rays.x_um + miss_y * rays.y_um
    known = 3 if level.by_slopes else 1  # of each ray
    residual = _residual(error, area, phase.shape[-1] / known)
    map_residual = np.hypot(_residual(miss_x, area, fx.shape[-1]), _residual(miss_y, area, fy.shape[-1]))
    return PencilForms(phase, fx, fy, amplitude, residual, map_residual, amplitude_residual)


def fit_rays(rays: Rays, level: Level, traced: int, steep: Steepness | None = None) -> FittedPencil:
    """Return the fit of one level to its rays; their `steepness` is computed unless ``steep`` gives it."""
    xi, eta, weight = level_rays(level)
    found, share = pencil_forms(rays, level), np.ones(1)
    if level.weighted:
        share = rays.amplitude[: weight.size] / float(weight @ rays.amplitude[: weight.size])
    # Parseval: ∫|field|²dx is the area mean of (relative weight)²/|∂(fx, fy)/∂(ξ, η)| over π.
    blur = float(weight @ (share * share / np.abs(determinant(found.fx, found.fy, *_slope_basis(level)))) / np.pi)
    steep = steep or steepness(rays, xi, eta)
    made = level, found.phase, found.fx, found.fy, float(found.residual_waves), steep, blur, traced
    return FittedPencil(*made, float(found.map_residual), found.amplitude, float(found.amplitude_residual))


def _residual(error: np.ndarray, weight: np.ndarray, unknowns: float) -> np.ndarray:
    """Return the larger RMS error: of the fit's own rays, corrected for its degrees of freedom, or of those held out.

    At the rim the error of a polynomial fit is four times its RMS; the held-out rays lie there and count half.
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
    return map_slopes(level, xi[: weight.size], eta[: weight.size])


def map_slopes(level: Level, xi: ArrayLike, eta: ArrayLike) -> tuple[Gradient, Gradient]:
    """Return (∂/∂ξ, ∂/∂η) of the terms of fx and of fy at pupil points."""
    if level.skew is None:
        return gradient(level.map_order, xi, eta, odd=True), gradient(level.map_order, xi, eta)
    order = max(level.map_order, level.skew[1])
    even, odd = gradient(order, xi, eta), gradient(order, xi, eta, odd=True)
    _, (own_x, other_x), (own_y, other_y) = level.counts
    of_fx = [np.concatenate([one[:own_x], two[:other_x]]) for one, two in zip(odd, even, strict=True)]
    of_fy = [np.concatenate([one[:own_y], two[:other_y]]) for one, two in zip(even, odd, strict=True)]
    return (of_fx[0], of_fx[1]), (of_fy[0], of_fy[1])


def determinant(fx: np.ndarray, fy: np.ndarray, of_fx: Gradient, of_fy: Gradient) -> np.ndarray:
    """Return ∂(fx, fy)/∂(ξ, η) from the gradients of the terms of fx and of fy."""
    determinant: np.ndarray = (fx @ of_fx[0]) * (fy @ of_fy[1]) - (fx @ of_fx[1]) * (fy @ of_fy[0])
    return determinant
