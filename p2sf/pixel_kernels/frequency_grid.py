"""A pencil over its own spatial frequencies, which a uniform grid samples and an FFT sums (handbook 5.8).

Phase and entrance-pupil point are polynomials over f = n'K/λ; the image of the unit circle is the edge and
|∂(ξ, η)/∂f| the amplitude (equal areas of the entrance pupil have equal weight, as in the reference). The
polynomials are Zernike's, so that a field in another direction is the same pupil with rotated coefficients:
rotation needs no interpolation.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.quadrature import disc_nodes
from p2sf.pupil.zernike import basis, basis_by_powers, gradient, powers, terms
from p2sf.raytrace.fit import FittedPencil, Gradient, fit

ORDERS = 6, 18  # the least and the greatest
FAR_OFF = 30.0  # times the allowed residual: then the next order but one is tried, since the next seldom suffices
NODES = 16, 44
REACH_NODES = 24, 48
FOLDED = 0.1  # of the pupil's area: nodes count that area to some 2 % where the polynomials hold
STRAY = 2e-3  # of the light may land outside the window: negligible in L2, and the rims of fast lenses scatter far
PHASE_RESIDUAL = 2e-4  # waves RMS: 2e-3 of relative L2 in the finest detail, less in a pixel
POINT_RESIDUAL = 5e-4  # of the pupil radius
Forms: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray]  # coefficients of phase, η and ξ


@dataclass(frozen=True, eq=False)
class FrequencyPupil:
    """Zernike coefficients over u = (f − centre)/``radius``: phase and η even in u_x, ξ odd.

    ``radius`` cycles/µm; ``reach_um`` how far from the chief ray rays land; ``residual_waves`` RMS phase error left.
    """

    order: int
    radius: float
    phase: np.ndarray
    eta: np.ndarray
    xi: np.ndarray
    reach_um: float
    residual_waves: float
    method: str
    numbers: int


def pupil_map(lens: Lens, source: Source, method: str, numbers: int | None = None) -> FrequencyPupil:
    """Return the pupil of one source by the method "seidel" or "fitted".

    Raises GeometryError where rays do not reach the sensor or the image lies at infinity.
    """
    if method == "seidel":
        return _from_seidel(lens, source)
    return _from_fit(fit(lens, source, numbers), source)


def _from_seidel(lens: Lens, source: Source) -> FrequencyPupil:
    six = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    scale = -float(six.reduced_slope) / source.wavelength_um
    if scale == 0:
        raise GeometryError("the image lies at infinity, so the sensor sees no blur of finite size; move the object")
    nodes, sign = disc_nodes(*NODES), np.sign(scale)
    phase = wavefront(six, nodes.xi, nodes.eta)
    columns = phase, nodes.eta, nodes.xi
    phase, eta, xi = _coefficients(*basis_by_powers(4, sign * nodes.xi, sign * nodes.eta), columns)
    reach = reach_of(4, (phase, eta, xi), abs(scale))
    return FrequencyPupil(4, abs(scale), phase, eta, xi, reach, 0.0, "seidel", 6)


def _from_fit(found: FittedPencil, source: Source) -> FrequencyPupil:
    nodes = disc_nodes(*NODES)
    even, odd = _at_nodes(found.level.wave_order, found.level.map_order)
    phase, fx, fy = found.on(even, odd)
    centre = (fy.max() + fy.min()) / 2
    radius = float(np.hypot(fx, fy - centre).max()) * 1.02
    u, v = fx / radius, (fy - centre) / radius
    order = ORDERS[0]
    while True:
        even_here, odd_here = basis_by_powers(order, u, v)
        waves_of, eta_of, xi_of = _coefficients(even_here, odd_here, (phase, nodes.eta, nodes.xi))
        waves, miss = waves_of @ even_here - phase, eta_of @ even_here - nodes.eta
        residual = float(np.sqrt(nodes.weight @ waves**2))
        excess = max(residual / PHASE_RESIDUAL, float(np.abs(miss).max()) / POINT_RESIDUAL)
        if excess < 1 or order == ORDERS[-1]:
            break
        order = min(order + (4 if excess > FAR_OFF else 2), ORDERS[-1])
    left = float(np.hypot(residual, found.residual_waves))
    reach = reach_of(order, (waves_of, eta_of, xi_of), radius)
    return FrequencyPupil(order, radius, waves_of, eta_of, xi_of, reach, left, "fitted", found.numbers)


@lru_cache(maxsize=8)
def _at_nodes(wave_order: int, map_order: int) -> tuple[np.ndarray, np.ndarray]:
    """Return even and odd terms at the fixed nodes."""
    nodes = disc_nodes(*NODES)
    return basis(max(wave_order, map_order), nodes.xi, nodes.eta), basis(map_order, nodes.xi, nodes.eta, odd=True)


def _coefficients(even: np.ndarray, odd: np.ndarray, columns: Sequence[np.ndarray]) -> Forms:
    """Return least-squares coefficients of phase and η over the even terms, and of ξ over the odd ones."""
    phase, eta, xi = columns
    both = _solve(even, np.stack([phase, eta], axis=1))
    return both[:, 0], both[:, 1], _solve(odd, xi)


def _solve(rows: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the least-squares solution by the normal equations, well conditioned for nearly orthogonal terms."""
    normal = rows @ rows.T
    normal[np.diag_indices_from(normal)] *= 1 + 1e-12
    return np.linalg.solve(normal, rows @ values)


def reach_of(order: int, forms: Forms, radius: float) -> float:
    """Return the radius in µm that holds all light but STRAY: rays land at −∂w/∂f (Hamilton).

    ``forms``: coefficients of phase, η and ξ. Only frequencies of the pupil count, since its polynomials mean nothing
    beyond its rim. Raises GeometryError where they come back there, and would let light through that does not exist.
    """
    (_, eta, xi), terms_at = forms, _terms_at(order)
    (phase_u, phase_v), (eta_u, eta_v), (xi_u, xi_v) = (
        (form @ across, form @ along) for form, (across, along) in zip(forms, terms_at.slopes, strict=True)
    )
    area = np.abs(xi_u * eta_v - xi_v * eta_u)
    inside = (eta @ terms_at.even) ** 2 + (xi @ terms_at.odd) ** 2 <= 1
    part = np.where(inside, terms_at.weight * area, 0.0)
    if abs(part.sum() - 1) > FOLDED:
        raise GeometryError(
            "the pupil is too distorted for polynomials over its spatial frequencies, which find {share:.3g} times its "
            "area; stop the lens down or reduce the field",
            share=float(part.sum()),
        )
    distance, light = np.hypot(phase_u, phase_v) / radius, part * area
    order_of = np.argsort(distance)
    within = np.cumsum(light[order_of]) <= (1 - STRAY) * light.sum()
    return float(distance[order_of][within].max(initial=0.0))


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
    """A frequency pupil as plain powers Σ c[i, j]·uⁱ·vʲ, rotated to the direction of its field."""

    radius: float
    phase: np.ndarray
    eta: np.ndarray
    xi: np.ndarray


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
    return Turned(pupil.radius, phase, eta, _plain(pupil.order, from_xi, pupil.xi * cosine_odd))


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
