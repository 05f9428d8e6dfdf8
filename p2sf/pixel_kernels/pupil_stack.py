"""Pupils over their spatial frequencies, one or many at once: how far their light lands, and their rotation.

Many pupils of one order are handled together: the arrays of one are so small that calls would take longer than sums.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from p2sf.errors import GeometryError
from p2sf.pupil.mask import CLEAR, PupilMask, mask_slopes
from p2sf.pupil.quadrature import disc_nodes, whole_disc
from p2sf.pupil.zernike import basis, gradient, powers, terms
from p2sf.raytrace.fit import Gradient

REACH_NODES = 24, 48
FOLDED = 0.1  # of the light: nodes that lie inside or not count it to some 3 % where the polynomials hold
STRAY = 2e-3  # of the light may land outside the window: negligible in L2, and the rims of fast lenses scatter far
SURELY_CLEAR = 0.05  # of 1 − (height/rim)²: a rim that stays above at nodes clips nothing between them
FORMS = "phase", "eta", "xi", "weight", "rims"
SHARED = "order", "method", "numbers", "mask"
SIZES = "radius", "energy", "reach_um", "residual_waves", "wavelength_um"


@dataclass(frozen=True, eq=False)
class PixelPupil:
    """Zernike coefficients over u = (f − centre)/``radius``: phase and η even in u_x, ξ odd.

    ``radius`` cycles/µm; ``reach_um`` how far from the chief ray rays land; ``residual_waves`` RMS phase error left.
    ``weight``: of the light by entrance pupil area, even; none for the even light of a paraxial pupil. ``rims``,
    (surfaces, even terms): 1 − (height/rim)² on each surface whose rim may clip; none where none does.
    ``energy``: ∫(weight·|∂(ξ, η)/∂f|)² df over the part that no rim clips, which the polynomials must give too.
    ``mask``: what stands in the pupil besides, as the source sees it; its path makes waves by ``wavelength_um``, which
    is negative where the phase counts as W does. Of a lens without symmetry all forms have all even terms, and behind
    them all odd ones.
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
    wavelength_um: float
    method: str
    numbers: int
    mask: PupilMask = CLEAR


@dataclass(frozen=True, eq=False)
class PupilStack:
    """Several pupils of one order: every array of `PixelPupil` with an axis of pupils first, numbers (pupils,)."""

    order: int
    radius: np.ndarray
    phase: np.ndarray
    eta: np.ndarray
    xi: np.ndarray
    weight: np.ndarray
    rims: np.ndarray
    energy: np.ndarray
    reach_um: np.ndarray
    residual_waves: np.ndarray
    wavelength_um: np.ndarray
    method: str
    numbers: int
    mask: PupilMask = CLEAR

    def __len__(self) -> int:
        return len(self.radius)

    def one(self, k: int) -> PixelPupil:
        """Return one of the pupils."""
        values: dict[str, Any] = {name: getattr(self, name)[k] for name in FORMS}
        values |= {name: float(getattr(self, name)[k]) for name in SIZES}
        values |= {name: getattr(self, name) for name in SHARED}
        return PixelPupil(**values)

    def some(self, chosen: np.ndarray | slice) -> "PupilStack":
        """Return those of the pupils that an index array, a mask or a slice chooses."""
        values: dict[str, Any] = {name: getattr(self, name)[chosen] for name in (*FORMS, *SIZES)}
        return replace(self, **values)

    @property
    def symmetric(self) -> bool:
        """Return whether the forms have only the terms of their symmetry about the plane of the field."""
        return int(self.phase.shape[-1]) == len(terms(self.order))

    def of_order(self, order: int) -> "PupilStack":
        """Return the same pupils with zeros for the terms up to a higher order, which come last among their kind."""
        if order == self.order:
            return self
        wider: dict[str, Any] = {name: _widened(getattr(self, name), order, self.order) for name in FORMS}
        return replace(self, order=order, **wider)


def _halves(form: np.ndarray, order: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the coefficients of a form's even and of its odd terms; none of those that its symmetry forbids."""
    even = len(terms(order)) if form.shape[-1] != len(terms(order, True)) else 0
    return form[..., :even], form[..., even:]


def _widened(form: np.ndarray, order: int, narrower: int) -> np.ndarray:
    """Return a form of a narrower order with zeros for the terms up to another."""
    wider: list[np.ndarray] = []
    for half, odd in zip(_halves(form, narrower), (False, True), strict=True):
        lacking = len(terms(order, odd)) - len(terms(narrower, odd)) if half.shape[-1] else 0
        wider.append(np.pad(half, [(0, 0)] * (half.ndim - 1) + [(0, lacking)]))
    return np.concatenate(wider, axis=-1)


def stacked(pupils: Sequence[PixelPupil | PupilStack]) -> PupilStack:
    """Return pupils and stacks of them as one stack, of the highest order; all with a weight, or none; of one mask."""
    stacks = [_as_stack(pupil) for pupil in pupils]
    order = max(stack.order for stack in stacks)
    stacks = [stack.of_order(order) for stack in stacks]
    first = stacks[0]
    if len(stacks) == 1:
        return first
    joined: dict[str, Any] = {
        name: np.concatenate([getattr(stack, name) for stack in stacks]) for name in (*FORMS, *SIZES)
    }
    return replace(first, **joined)


def _as_stack(pupil: PixelPupil | PupilStack) -> PupilStack:
    if isinstance(pupil, PupilStack):
        return pupil
    values: dict[str, Any] = {name: np.array([getattr(pupil, name)]) for name in (*FORMS, *SIZES)}
    values |= {name: getattr(pupil, name) for name in SHARED}
    return PupilStack(**values)


def with_reach(pupils: PupilStack) -> PupilStack:
    """Return the pupils with the radius in µm that holds all light but STRAY: rays land at −∂w/∂f (Hamilton).

    Only frequencies of the pupil count, since its polynomials mean nothing beyond its rim. Raises GeometryError where
    they come back there, and would let light through that does not exist.
    """
    at = _terms_at(pupils.order, pupils.symmetric)
    (phase_u, phase_v), (eta_u, eta_v), (xi_u, xi_v) = (
        (form @ across, form @ along)
        for form, (across, along) in zip((pupils.phase, pupils.eta, pupils.xi), at.slopes, strict=True)
    )
    area = np.abs(xi_u * eta_v - xi_v * eta_u)
    inside = (pupils.eta @ at.even) ** 2 + (pupils.xi @ at.odd) ** 2 <= 1
    light = np.where(inside & (pupils.rims @ at.even > 0).all(1), at.weight * area**2, 0.0)
    if pupils.weight.size:
        light *= (pupils.weight @ at.even) ** 2
    share = np.pi * light.sum(1) / pupils.radius**2 / pupils.energy
    worst = float(share[np.abs(share - 1).argmax()])
    if abs(worst - 1) > FOLDED:
        raise GeometryError(
            "the pupil is too distorted for polynomials over its spatial frequencies, which give {share:.3g} times "
            "its light; stop the lens down or reduce the field",
            share=worst,
        )
    distance = np.hypot(phase_u, phase_v) / pupils.radius[:, None]
    mask, stray = pupils.mask, STRAY
    if not mask.clear:
        xi, eta = pupils.xi @ at.odd, pupils.eta @ at.even
        round_part = mask.round_part
        light = np.where(round_part.opens(xi, eta), light * round_part.amplitude(xi * inside, eta * inside) ** 2, 0.0)
        stray *= mask.round  # what is dark in some directions only may be where most of the light is
    if mask.phased:
        slopes = mask_slopes(mask)
        steepest = (
            np.sqrt(xi_u**2 + xi_v**2 + eta_u**2 + eta_v**2) / (pupils.radius * np.abs(pupils.wavelength_um))[:, None]
        )
        distance += np.hypot(slopes.path_radial_um, slopes.path_angular_um) * steepest
    order_of = distance.argsort(1)
    near_first = np.take_along_axis(light, order_of, 1).cumsum(1)
    within = near_first <= (1 - stray) * light.sum(1, keepdims=True)
    reach = np.where(within, np.take_along_axis(distance, order_of, 1), 0.0).max(1)
    return replace(pupils, reach_um=reach)


def cutting_rims(pupils: PupilStack) -> np.ndarray:
    """Return which surfaces' rims clip any part of any of the pupils, (surfaces,)."""
    if not pupils.rims.size:
        return np.zeros(pupils.rims.shape[1], bool)
    at = _terms_at(pupils.order, pupils.symmetric)
    inside = (pupils.eta @ at.even) ** 2 + (pupils.xi @ at.odd) ** 2 <= 1
    nearest = np.where(inside[:, None], pupils.rims @ at.even, np.inf).min(2)
    cutting: np.ndarray = (nearest < SURELY_CLEAR).any(0)
    return cutting


@dataclass(frozen=True, eq=False)
class _TermsAt:
    """Even and odd terms at REACH_NODES over u, the nodes' weights, and gradients as phase, η and ξ take them.

    Without symmetry both are all terms, at nodes of the whole disc.
    """

    even: np.ndarray
    odd: np.ndarray
    weight: np.ndarray
    slopes: tuple[Gradient, Gradient, Gradient]


@lru_cache(maxsize=16)
def _terms_at(order: int, symmetric: bool) -> _TermsAt:
    half = disc_nodes(*REACH_NODES)
    xi, eta, weight = (half.xi, half.eta, half.weight) if symmetric else whole_disc(*REACH_NODES)
    even, odd = (basis(order, xi, eta, odd=flag) for flag in (False, True))
    of_even, of_odd = (gradient(order, xi, eta, odd=flag) for flag in (False, True))
    if symmetric:
        return _TermsAt(even, odd, weight, (of_even, of_even, of_odd))
    every, across, along = (np.concatenate(pair) for pair in ((even, odd), *zip(of_even, of_odd, strict=True)))
    return _TermsAt(every, every, weight, ((across, along),) * 3)


@dataclass(frozen=True, eq=False)
class Turned:
    """Pupils as plain powers Σ c[i, j]·uⁱ·vʲ, (pupils, i, j), each rotated to the direction of its field.

    ``weight`` None: 1 everywhere. ``rims``, (surfaces, pupils, i, j): only those that clip. ``angles`` of the fields,
    (pupils,), to which ``mask`` does not turn.
    """

    radius: np.ndarray
    phase: np.ndarray
    eta: np.ndarray
    xi: np.ndarray
    weight: np.ndarray | None
    rims: np.ndarray
    mask: PupilMask
    wavelength_um: np.ndarray
    angles: np.ndarray


def turned(pupils: PupilStack, angles: np.ndarray) -> Turned:
    """Return the pupils of fields ``angles`` (pupils,) radians from +y towards +x: θ becomes θ − angle in every term.

    Rotation needs no interpolation: it turns cosine terms into sine terms of the same order, and the other way round.
    """
    phase, eta, xi = (_rotated(pupils.order, form, angles) for form in (pupils.phase, pupils.eta, pupils.xi))
    weight = _rotated(pupils.order, pupils.weight, angles) if pupils.weight.size else None
    cutting = pupils.rims[:, cutting_rims(pupils)].swapaxes(0, 1)
    rims = np.array([_rotated(pupils.order, form, angles) for form in cutting])
    return Turned(pupils.radius, phase, eta, xi, weight, rims, pupils.mask, pupils.wavelength_um, angles)


def _rotated(order: int, form: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Return a form, (pupils, terms), rotated by angles, as coefficients c[i, j] of uⁱvʲ, (pupils, i, j)."""
    harmonic = _harmonics(order)
    paired = harmonic > 0  # the odd terms are the even ones without m = 0, in the same order
    phases = np.multiply.outer(angles, harmonic)
    (cosine, sine), (even, odd) = (np.cos(phases), np.sin(phases)), _halves(form, order)
    new_even, new_odd = np.zeros_like(cosine), np.zeros((len(angles), np.count_nonzero(paired)))
    if even.size:
        new_even += even * cosine
        new_odd += even[:, paired] * sine[:, paired]
    if odd.size:
        new_even[:, paired] -= odd * sine[:, paired]
        new_odd += odd * cosine[:, paired]
    return _plain(order, new_even, new_odd)


def _plain(order: int, even: np.ndarray, odd: np.ndarray) -> np.ndarray:
    """Return coefficients c[i, j] of uⁱvʲ, (pupils, order + 1, order + 1)."""
    forms = _all_powers(order)
    plain: np.ndarray = (even @ forms[0] + odd @ forms[1]).reshape(-1, order + 1, order + 1)
    return plain


@lru_cache(maxsize=16)
def _harmonics(order: int) -> np.ndarray:
    """Return m of every even term."""
    return np.array([m for _, m in terms(order)])


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
