"""Pupils over their spatial frequencies, one or many at once: how far their light lands, and their rotation.

Many pupils of one order are handled together: the arrays of one are so small that calls would take longer than sums.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from p2sf.disc.basis import PupilBasis, Terms, at_nodes
from p2sf.disc.domain import PupilDomain
from p2sf.disc.mask import CLEAR, PupilMask, mask_slopes
from p2sf.disc.zernike import powers
from p2sf.errors import GeometryError

REACH_NODES = 24, 48
FOLDED = 0.1  # of the light: nodes that lie inside or not count it to some 3 % where the polynomials hold
SURELY_CLEAR = 0.05  # of 1 − (height/rim)²: a rim that stays above at nodes clips nothing between them
FORMS = "phase", "eta", "xi", "weight", "rims"
SIZES = "radius", "energy", "reach_um", "residual_waves", "wavelength_um"


@dataclass(frozen=True, eq=False)
class PupilStack:
    """One or several pupils of one order: Zernike coefficients over u = (f − centre)/``radius``, in terms of ``basis``.

    Every array has an axis of pupils first. Phase and η are even in u_x, ξ odd. ``radius`` cycles/µm; ``reach_um`` how
    far from the chief ray rays land; ``residual_waves`` RMS phase error left.
    ``weight``: of the light by entrance pupil area, as η; none for the even light of a paraxial pupil. ``rims``,
    (pupils, surfaces, terms of η): 1 − (height/rim)² on each surface whose rim may clip; none where none does.
    ``energy``: ∫(weight·|∂(ξ, η)/∂f|)² df over the part that no rim clips, which the polynomials must give too.
    ``mask``: what stands in the pupil besides, as the source sees it; its path makes waves by ``wavelength_um``, which
    is negative where the phase counts as W does.
    """

    basis: PupilBasis
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

    def some(self, chosen: np.ndarray | slice | list[int]) -> "PupilStack":
        """Return those of the pupils that an index array, a mask or a slice chooses."""
        values: dict[str, Any] = {name: getattr(self, name)[chosen] for name in (*FORMS, *SIZES)}
        return replace(self, **values)

    @property
    def order(self) -> int:
        """Return the order of all terms."""
        return self.basis.wave_order

    def of_order(self, order: int) -> "PupilStack":
        """Return the same pupils with zeros for the terms up to a higher order, which come last among their kind."""
        if order == self.order:
            return self
        own = {name: (terms_of(self.basis, name), getattr(self, name)) for name in FORMS}
        wider: dict[str, Any] = {name: of.widened(form, order) for name, (of, form) in own.items() if form.shape[-1]}
        return replace(self, basis=frequency_basis(order, self.basis.domain), **wider)


@lru_cache(maxsize=16)
def frequency_basis(order: int, domain: PupilDomain) -> PupilBasis:
    """Return the terms of a pupil over its frequencies, all up to one order: those of ξ are the basis's of fx."""
    return PupilBasis(order, order, domain)


def terms_of(basis: PupilBasis, form: str) -> Terms:
    """Return the terms of one of FORMS."""
    return basis.fx if form == "xi" else basis.phase


def stack_pupils(stacks: Sequence[PupilStack]) -> PupilStack:
    """Return stacks of pupils as one, of the highest order; all with a weight, or none; of one mask."""
    order = max(stack.order for stack in stacks)
    stacks = [stack.of_order(order) for stack in stacks]
    first = stacks[0]
    if len(stacks) == 1:
        return first
    joined: dict[str, Any] = {
        name: np.concatenate([getattr(stack, name) for stack in stacks]) for name in (*FORMS, *SIZES)
    }
    return replace(first, **joined)


def with_reach(pupils: PupilStack, counts: tuple[int, int] = REACH_NODES) -> PupilStack:
    """Return the pupils with the radius in µm within which all rays land: at −∂w/∂f (Hamilton).

    Only frequencies of the pupil count, since its polynomials mean nothing beyond its rim. Raises GeometryError where
    they come back there, and would let light through that does not exist; fewer nodes, whose ``counts`` are given, do
    not tell that.
    """
    at = at_nodes(pupils.basis, counts)
    of_xi, of_eta = at.map_slopes  # the phase has the terms of η
    (phase_u, phase_v), (eta_u, eta_v), (xi_u, xi_v) = (
        (form @ across, form @ along)
        for form, (across, along) in ((pupils.phase, of_eta), (pupils.eta, of_eta), (pupils.xi, of_xi))
    )
    area = np.abs(xi_u * eta_v - xi_v * eta_u)
    inside = (pupils.eta @ at.values.fy) ** 2 + (pupils.xi @ at.values.fx) ** 2 <= 1
    light = np.where(inside & (pupils.rims @ at.values.fy > 0).all(1), at.nodes.weight * area**2, 0.0)
    if pupils.weight.size:
        light *= (pupils.weight @ at.values.fy) ** 2
    share = np.pi * light.sum(1) / pupils.radius**2 / pupils.energy
    worst = float(share[np.abs(share - 1).argmax()])
    if abs(worst - 1) > FOLDED and counts == REACH_NODES:
        raise GeometryError(
            "the pupil is too distorted for polynomials over its spatial frequencies, which give {share:.3g} times "
            "its light; stop the lens down or reduce the field",
            share=worst,
        )
    distance = np.hypot(phase_u, phase_v) / pupils.radius[:, None]
    mask = pupils.mask
    if not mask.clear:
        xi, eta = pupils.xi @ at.values.fx, pupils.eta @ at.values.fy
        round_part = mask.round_part
        light = np.where(round_part.opens(xi, eta), light * round_part.amplitude(xi * inside, eta * inside) ** 2, 0.0)
    if mask.phased:
        slopes = mask_slopes(mask)
        steepest = (
            np.sqrt(xi_u**2 + xi_v**2 + eta_u**2 + eta_v**2) / (pupils.radius * np.abs(pupils.wavelength_um))[:, None]
        )
        distance += np.hypot(slopes.path_radial_um, slopes.path_angular_um) * steepest
    return replace(pupils, reach_um=np.where(light > 0, distance, 0.0).max(1))


def cutting_rims(pupils: PupilStack) -> np.ndarray:
    """Return which surfaces' rims clip any part of any of the pupils, (surfaces,)."""
    if not pupils.rims.size:
        return np.zeros(pupils.rims.shape[1], bool)
    at = at_nodes(pupils.basis, REACH_NODES)
    inside = (pupils.eta @ at.values.fy) ** 2 + (pupils.xi @ at.values.fx) ** 2 <= 1
    nearest = np.where(inside[:, None], pupils.rims @ at.values.fy, np.inf).min(2)
    cutting: np.ndarray = (nearest < SURELY_CLEAR).any(0)
    return cutting


def turned_powers(pupils: PupilStack, angles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return phase, (pupils, i, j), and maps, (columns, pupils, i, j), as plain powers Σ c[i, j]·uⁱ·vʲ.

    Maps are ξ, η, the rims that clip, and the weight where there is one. Each pupil is that of a field ``angles``
    (pupils,) radians from +y towards +x: θ becomes θ − angle in every term. Rotation needs no interpolation: it turns
    cosine terms into sine terms of the same order, and the other way round.
    """
    basis, cutting = pupils.basis, pupils.rims[:, cutting_rims(pupils)].swapaxes(0, 1)
    even = (pupils.eta, *cutting, *[pupils.weight] * bool(pupils.weight.size))
    maps = [_plain(basis.fx, pupils.xi, angles), *(_plain(basis.fy, form, angles) for form in even)]
    return _plain(basis.phase, pupils.phase, angles), np.stack(maps)


def _plain(terms: Terms, form: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Return a form, (pupils, terms), turned by angles, as coefficients c[i, j] of uⁱvʲ, (pupils, i, j)."""
    forms, order = _all_powers(terms.order), terms.order
    even, odd = terms.turned(form, angles)
    plain: np.ndarray = (even @ forms[0] + odd @ forms[1]).reshape(-1, order + 1, order + 1)
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
