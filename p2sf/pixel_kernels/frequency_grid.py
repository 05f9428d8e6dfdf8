"""A pencil over its own spatial frequencies, which a uniform grid samples and an FFT sums (handbook 5.8).

Phase and entrance-pupil point are polynomials over f = n'K/λ; the image of the unit circle is the edge and
|∂(ξ, η)/∂f| the amplitude (equal areas of the entrance pupil have equal weight, as in the reference). The
polynomials are Zernike's, so that a field in another direction is the same pupil with rotated coefficients:
rotation needs no interpolation.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import nan

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.quadrature import disc_nodes
from p2sf.pupil.zernike import basis, basis_by_powers, gradient, powers, terms
from p2sf.raytrace.aiming import pupil_rays, start
from p2sf.raytrace.fit import FittedPencil, Gradient, fit
from p2sf.raytrace.trace import lens_rims, run
from p2sf.raytrace.vignetting import CLIPPED

ORDERS = 6, 18  # the least and the greatest
FAR_OFF = 30.0  # times the allowed residual: then the next order but one is tried, since the next seldom suffices
NODES = 16, 44
REACH_NODES = 24, 48
FOLDED = 0.1  # of the light: nodes that lie inside or not count it to some 3 % where the polynomials hold
STRAY = 2e-3  # of the light may land outside the window: negligible in L2, and the rims of fast lenses scatter far
PHASE_RESIDUAL = 2e-4  # waves RMS: 2e-3 of relative L2 in the finest detail, less in a pixel
POINT_RESIDUAL = 5e-4  # of the pupil radius
NEARLY_CLEAR = -0.15  # of 1 − (height/rim)²: nodes up to here count as clear, since the rim lies between them
SURELY_CLEAR = 0.05  # of the same: a rim that stays above at nodes clips nothing between them
CLIPPED_SHARE, BESIDE = 0.03, 1.7  # the part that clipped nodes have in a fit, and up to which square of u


@dataclass(frozen=True, eq=False)
class FrequencyPupil:
    """Zernike coefficients over u = (f − centre)/``radius``: phase and η even in u_x, ξ odd.

    ``radius`` cycles/µm; ``reach_um`` how far from the chief ray rays land; ``residual_waves`` RMS phase error left.
    ``weight``: of the light by entrance pupil area, even; none for the even light of a paraxial pupil. ``rims``,
    (surfaces, even terms): 1 − (height/rim)² on each surface whose rim may clip; none where none does.
    ``energy``: ∫(weight·|∂(ξ, η)/∂f|)² df over the part that no rim clips, which the polynomials must give too.
    """

    order: int
    radius: float
    phase: np.ndarray
    eta: np.ndarray
    xi: np.ndarray
    weight: np.ndarray
    rims: np.ndarray
    energy: float
    reach_um: float
    residual_waves: float
    method: str
    numbers: int


def pupil_map(
    lens: Lens, source: Source, method: str, numbers: int | None = None, clip: bool = False
) -> FrequencyPupil:
    """Return the pupil of one source by the method "seidel" or "fitted"; ``clip`` lets the clear rims clip it.

    Raises GeometryError where rays do not reach the sensor, rims clip all of them, or the image lies at infinity.
    """
    rims = _rims(lens, source) if clip else np.empty((0, disc_nodes(*NODES).xi.size))
    if not (rims > 0).all(0).any():
        raise GeometryError(CLIPPED, parameter="clip")
    made = _from_seidel(lens, source, rims) if method == "seidel" else _from_fit(fit(lens, source, numbers), rims)
    return replace(made, reach_um=reach_of(made))


def _rims(lens: Lens, source: Source) -> np.ndarray:
    """Return 1 − (height/rim)² where rays of the pupil's nodes meet each surface that has a rim, (surfaces, nodes)."""
    nodes, limits = disc_nodes(*NODES), lens_rims(lens, keep_stop=False)
    rays, heights = pupil_rays(lens, source, nodes.xi, nodes.eta), []
    beam = start(rays)
    run(lens, beam, rays.index, visit=lambda _: heights.append(np.hypot(beam.x, beam.y)))
    return np.array([1 - (height / rim) ** 2 for height, rim in zip(heights, limits, strict=False) if np.isfinite(rim)])


def _from_seidel(lens: Lens, source: Source, rims: np.ndarray) -> FrequencyPupil:
    six = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    scale = -float(six.reduced_slope) / source.wavelength_um
    if scale == 0:
        raise GeometryError("the image lies at infinity, so the sensor sees no blur of finite size; move the object")
    nodes, sign = disc_nodes(*NODES), np.sign(scale)
    order = ORDERS[0] if len(rims) else 4
    even, odd = basis_by_powers(order, sign * nodes.xi, sign * nodes.eta)
    phase = wavefront(six, nodes.xi, nodes.eta)
    (phase, eta, *forms), (xi,) = _solve(even, [phase, nodes.eta, *rims]), _solve(odd, [nodes.xi])
    edges = np.reshape(forms, (-1, phase.size))
    energy = np.pi * float(nodes.weight[(rims > 0).all(0)].sum()) / scale**2
    made = order, abs(scale), phase, eta, xi, np.empty(0), edges, energy
    return FrequencyPupil(*made, nan, 0.0, "seidel", 6)


def _from_fit(found: FittedPencil, rims: np.ndarray) -> FrequencyPupil:
    """Return the pupil of a fit; what rims clip is described only as far as the clear part allows."""
    nodes, clear = disc_nodes(*NODES), (rims > NEARLY_CLEAR).all(0)
    even, odd = _at_nodes(found.level.wave_order, found.level.map_order)
    phase, fx, fy = found.on(even, odd)
    light = [found.weight_at(nodes.xi, nodes.eta)] if found.level.weighted else []
    centre = (fy[clear].max() + fy[clear].min()) / 2
    radius = float(np.hypot(fx, fy - centre)[clear].max()) * 1.02
    u, v = fx / radius, (fy - centre) / radius
    share = np.where(clear, 1.0, np.where(u * u + v * v <= BESIDE, CLIPPED_SHARE, 0.0))
    columns = share * np.stack([phase, nodes.eta, *light, *rims])
    order = ORDERS[0]
    while True:
        even_here, odd_here = basis_by_powers(order, u, v)
        waves_of, eta_of, *others = _solve(even_here * share, columns)
        waves, miss = (waves_of @ even_here - phase)[clear], (eta_of @ even_here - nodes.eta)[clear]
        residual = float(np.sqrt(nodes.weight[clear] @ waves**2 / nodes.weight[clear].sum()))
        excess = max(residual / PHASE_RESIDUAL, float(np.abs(miss).max()) / POINT_RESIDUAL)
        if excess < 1 or order == ORDERS[-1]:
            break
        order = min(order + (4 if excess > FAR_OFF else 2), ORDERS[-1])
    (xi_of,), left = _solve(odd_here * share, [share * nodes.xi]), float(np.hypot(residual, found.residual_waves))
    weight_of, rims_of = (np.array(others[part]) for part in (slice(len(light)), slice(len(light), None)))
    forms = waves_of, eta_of, xi_of, weight_of.ravel(), rims_of.reshape(-1, waves_of.size)
    energy = _energy(found, np.asarray((rims > 0).all(0)))
    return FrequencyPupil(order, radius, *forms, energy, nan, left, "fitted", found.numbers)


def _energy(found: FittedPencil, clear: np.ndarray) -> float:
    """Return ∫weight²/|∂f/∂(ξ, η)| dξ dη over the clear nodes: by Parseval ∫|field|²dx."""
    nodes = disc_nodes(*NODES)
    light = found.weight_at(nodes.xi, nodes.eta) ** 2 / np.abs(found.jacobian(nodes.xi, nodes.eta))
    return float(np.pi * (nodes.weight * light)[clear].sum())


@lru_cache(maxsize=8)
def _at_nodes(wave_order: int, map_order: int) -> tuple[np.ndarray, np.ndarray]:
    """Return even and odd terms at the fixed nodes."""
    nodes = disc_nodes(*NODES)
    return basis(max(wave_order, map_order), nodes.xi, nodes.eta), basis(map_order, nodes.xi, nodes.eta, odd=True)


def _solve(rows: np.ndarray, values: Sequence[np.ndarray]) -> np.ndarray:
    """Return least-squares coefficients, (values, terms), by the normal equations of nearly orthogonal terms."""
    normal = rows @ rows.T
    normal[np.diag_indices_from(normal)] *= 1 + 1e-12
    found: np.ndarray = np.linalg.solve(normal, rows @ np.stack(values, axis=1)).T
    return found


def reach_of(pupil: FrequencyPupil) -> float:
    """Return the radius in µm that holds all light but STRAY: rays land at −∂w/∂f (Hamilton).

    Only frequencies of the pupil count, since its polynomials mean nothing beyond its rim. Raises GeometryError where
    they come back there, and would let light through that does not exist.
    """
    at = _terms_at(pupil.order)
    (phase_u, phase_v), (eta_u, eta_v), (xi_u, xi_v) = (
        (form @ across, form @ along)
        for form, (across, along) in zip((pupil.phase, pupil.eta, pupil.xi), at.slopes, strict=True)
    )
    area = np.abs(xi_u * eta_v - xi_v * eta_u)
    inside = (pupil.eta @ at.even) ** 2 + (pupil.xi @ at.odd) ** 2 <= 1
    light = np.where(inside & (pupil.rims @ at.even > 0).all(0), at.weight * area**2, 0.0)
    if pupil.weight.size:
        light *= (pupil.weight @ at.even) ** 2
    share = float(np.pi * light.sum() / pupil.radius**2 / pupil.energy)
    if abs(share - 1) > FOLDED:
        raise GeometryError(
            "the pupil is too distorted for polynomials over its spatial frequencies, which find {share:.3g} times its "
            "light; stop the lens down or reduce the field",
            share=share,
        )
    distance = np.hypot(phase_u, phase_v) / pupil.radius
    order_of = np.argsort(distance)
    within = np.cumsum(light[order_of]) <= (1 - STRAY) * light.sum()
    return float(distance[order_of][within].max(initial=0.0))


def cutting_rims(pupil: FrequencyPupil) -> np.ndarray:
    """Return those rims that clip any part of the pupil, (surfaces, even terms)."""
    at = _terms_at(pupil.order)
    inside = (pupil.eta @ at.even) ** 2 + (pupil.xi @ at.odd) ** 2 <= 1
    nearest = (pupil.rims @ at.even)[:, inside].min(1, initial=np.inf)
    cutting: np.ndarray = pupil.rims[nearest < SURELY_CLEAR]
    return cutting


@dataclass(frozen=True, eq=False)
class _TermsAt:
    """Even and odd terms at REACH_NODES over u, the nodes' weights, and gradients as phase, η and ξ take them."""

    even: np.ndarray
    odd: np.ndarray
    weight: np.ndarray
    slopes: tuple[Gradient, Gradient, Gradient]


@lru_cache(maxsize=16)
def _terms_at(order: int) -> _TermsAt:
    nodes = disc_nodes(*REACH_NODES)
    even, odd = (basis(order, nodes.xi, nodes.eta, odd=flag) for flag in (False, True))
    slopes, slopes_odd = (gradient(order, nodes.xi, nodes.eta, odd=flag) for flag in (False, True))
    return _TermsAt(even, odd, nodes.weight, (slopes, slopes, slopes_odd))


def dropped_terms(pupil: FrequencyPupil, waves: float) -> list[tuple[int, int, float]]:
    """Return (n, m, RMS waves) of the weakest phase terms that together stay below ``waves`` RMS, weakest first.

    The terms are orthonormal over the disc, so their squares add. Tilt, which moves the image, is never dropped.
    """
    named = [(abs(c), n, m) for c, (n, m) in zip(pupil.phase, terms(pupil.order), strict=True) if n > 1]
    out, total = [], 0.0
    for size, n, m in sorted(named):
        total += size * size
        if total > waves * waves:
            break
        out.append((n, m, float(size)))
    return out


def without(pupil: FrequencyPupil, waves: float) -> FrequencyPupil:
    """Return the pupil without the terms of `dropped_terms`."""
    gone = {(n, m) for n, m, _ in dropped_terms(pupil, waves)}
    if not gone:
        return pupil
    keep = np.array([name not in gone for name in terms(pupil.order)])
    return replace(pupil, phase=np.where(keep, pupil.phase, 0.0))


@dataclass(frozen=True, eq=False)
class Turned:
    """A frequency pupil as plain powers Σ c[i, j]·uⁱ·vʲ, rotated to the direction of its field.

    ``weight`` None: 1 everywhere. ``rims``: only those that clip.
    """

    radius: float
    phase: np.ndarray
    eta: np.ndarray
    xi: np.ndarray
    weight: np.ndarray | None
    rims: np.ndarray


def turned(pupil: FrequencyPupil, angle: float) -> Turned:
    """Return the pupil of a field ``angle`` radians from +y towards +x: θ becomes θ − angle in every term."""
    even, odd = (np.array([m for _, m in terms(pupil.order, flag)]) for flag in (False, True))
    keep = even > 0  # the odd terms are the even ones without m = 0, in the same order
    cosine, sine = np.cos(even * angle), np.sin(even * angle)[keep]
    cosine_odd, sine_odd = np.cos(odd * angle), np.sin(odd * angle)
    from_xi = np.zeros(even.size)
    from_xi[keep] = -pupil.xi * sine_odd
    phase = _plain(pupil.order, pupil.phase * cosine, pupil.phase[keep] * sine)
    eta = _plain(pupil.order, pupil.eta * cosine, pupil.eta[keep] * sine)
    xi = _plain(pupil.order, from_xi, pupil.xi * cosine_odd)
    weight, *rims = (
        _plain(pupil.order, form * cosine, form[keep] * sine) if form.size else None
        for form in (pupil.weight, *cutting_rims(pupil))
    )
    return Turned(pupil.radius, phase, eta, xi, weight, np.array(rims))


def _plain(order: int, even: np.ndarray, odd: np.ndarray) -> np.ndarray:
    """Return coefficients c[i, j] of uⁱvʲ, (order + 1, order + 1)."""
    forms = _all_powers(order)
    plain: np.ndarray = (even @ forms[0] + odd @ forms[1]).reshape(order + 1, order + 1)
    return plain


@lru_cache(maxsize=16)
def _all_powers(order: int) -> tuple[np.ndarray, np.ndarray]:
    """Return every even and every odd term as flat rows of c[i, j]."""
    out = []
    for odd in (False, True):
        form = powers(order, odd)
        full = np.zeros((len(form), order + 1, order + 1))
        full[:, (1 if odd else 0) :: 2] = form[:, : len(range(1 if odd else 0, order + 1, 2))]
        out.append(full.reshape(len(form), -1))
    return out[0], out[1]
