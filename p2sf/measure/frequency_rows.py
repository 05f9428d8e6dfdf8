"""Pupil nodes in rows of equal spatial frequency fy, over which a sum of plane waves separates into two products.

A fit gives fy(ξ, η). Row j passes through the rim point (sin φ_j, cos φ_j), φ_j = jπ/(n + 1), and its nodes follow the
curve fy(ξ, η) = fy_j, with ξ at Gauss–Legendre fractions of sin φ_j. Then

    (1/π)∫∫ F dξ dη = (1/π)∫ |dfy/dφ| dφ ∫ F/|∂fy/∂η| dξ,

exact for any smooth fy that rises along the rim: the trapezoid in φ is Gauss–Chebyshev quadrature, so the edge of
the pupil does not slow the convergence.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from p2sf.conventions import protected
from p2sf.pupil.quadrature import disc_nodes, gauss_legendre
from p2sf.pupil.zernike import basis, evaluate, evaluate_in_eta, in_square
from p2sf.pupil.zernike import columns as power_columns
from p2sf.raytrace.fit import FittedPencil
from p2sf.raytrace.ray_field import Steepness

NEWTON_STEPS = 8
SETTLED = 1e-5  # a last step this small leaves its square, 1e-10 of the pupil: 1e-8 waves at a slope of 100


@dataclass(frozen=True)
class FrequencyRows:
    """Nodes on ξ > 0: ``fy`` (rows,), the rest (rows, nodes); weights of unit sum count the mirror images too.

    The weights are areas times the light of unit area there.
    """

    fy: np.ndarray
    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray


def frequency_rows(found: FittedPencil, rows: int, columns: int) -> FrequencyRows | None:
    """Return the nodes of a fit, or None where fy does not rise steadily along the rim and across the disc."""
    sine, cosine, xi, share = _rim(rows, columns)
    form = power_columns(found.fy, found.level.map_order)
    fy, rise = _along_rim(form, sine[:, 0], cosine[:, 0])
    if not rise.min() * rise.max() > 0:
        return None
    followed = _followed(form, fy, xi, cosine)
    if followed is None:
        return None
    eta, slope = followed
    weight = share * -rise[:, None] / slope
    if found.level.weighted:
        weight = weight * found.amplitude_at(xi, eta)
    return FrequencyRows(fy, xi, eta, weight / weight.sum())


def _followed(
    form: list[list[float]], fy: np.ndarray, xi: np.ndarray, edge: np.ndarray
) -> tuple[np.ndarray, np.ndarray] | None:
    """Return η and ∂fy/∂η at these ξ, from where η is ``edge``, (rows, 1), along curves of equal fy.

    None where they bend back. ``form``: fy as a polynomial (`zernike.columns`).
    """
    parts = [in_square(column, xi * xi) for column in form]
    slopes = [b * part for b, part in enumerate(parts)][1:]
    eta = np.repeat(edge, xi.shape[1], axis=1)
    for _ in range(NEWTON_STEPS):
        slope = evaluate_in_eta(slopes, eta)
        step = evaluate_in_eta(parts, eta)
        step -= fy[:, None]
        step /= slope
        eta -= step
        if np.abs(step).max() < SETTLED:
            break
    else:
        return None
    return (eta, slope) if slope.min() * slope.max() > 0 else None


def _along_rim(form: list[list[float]], sine: np.ndarray, cosine: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return fy at the rim points (sin φ, cos φ) and dfy/dφ there: Σ c[b][a]·ξ²ᵃ·ηᵇ with its slopes."""
    square = sine * sine
    by_square = [[a * c for a, c in enumerate(column)][1:] or [0.0] for column in form]
    by_eta = [[b * c for c in column] for b, column in enumerate(form)][1:]
    across, along = 2 * sine * evaluate(by_square, square, cosine), evaluate(by_eta, square, cosine)
    return evaluate(form, square, cosine), cosine * across - sine * along


@lru_cache(maxsize=16)
def _rim(rows: int, columns: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return sin φ and cos φ (rows, 1), ξ and the constant part of the weights (rows, columns/2)."""
    angle = (np.arange(1, rows + 1) * (np.pi / (rows + 1)))[:, None]
    node, weight = (x[columns // 2 :] for x in gauss_legendre(columns))
    sine = np.sin(angle)
    return sine, np.cos(angle), sine * node, 2 / (rows + 1) * sine * weight


def scaled(found: FittedPencil, radius: float) -> FittedPencil:
    """Return the fit of a disc of this radius about the chief ray, its rim at 1."""
    if radius == 1:
        return found
    orders = found.level.wave_order, found.level.map_order
    steep = found.steepness
    return replace(
        found,
        phase=found.phase @ _scaling(orders[0], False, radius),
        fx=found.fx @ _scaling(orders[1], True, radius),
        fy=found.fy @ _scaling(orders[1], False, radius),
        amplitude=found.amplitude @ _scaling(orders[1], False, radius) if found.level.weighted else found.amplitude,
        steepness=Steepness(*(radius * slope for slope in vars(steep).values())),
    )


@lru_cache(maxsize=64)
def _scaling(order: int, odd: bool, radius: float) -> np.ndarray:
    """Return the matrix from coefficients over the disc to those over one of this radius, which the nodes integrate."""
    nodes = disc_nodes(order + 1, 2 * order + 2)
    here = basis(order, radius * nodes.xi, radius * nodes.eta, odd)
    return protected(here @ (basis(order, nodes.xi, nodes.eta, odd) * nodes.weight).T)
