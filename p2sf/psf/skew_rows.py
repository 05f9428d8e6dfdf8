"""Rows of equal frequency over a pupil without symmetry, for sums that separate into two products.

As `separable_sum`, but nothing is even in ξ. Between the largest and the smallest fy on the rim rows lie at
fy = m + h·cos ψ, ψ = jπ/(n + 1); each is a curve from rim to rim, with Gauss–Legendre nodes in ξ. A row's integral is
sin ψ times a smooth function of ψ, so that the trapezoid is Gauss–Chebyshev quadrature. Along a row the field at ±x is
Σ a·cos(2π fx·x) ± i·Σ a·sin(2π fx·x). Where a row has fewer nodes than columns, those follow as in `separable_sum`.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial.legendre import legvander
from numpy.typing import DTypeLike

from p2sf.conventions import protected
from p2sf.messages import Message
from p2sf.psf.plane_waves import pupil_amplitude
from p2sf.psf.separable_sum import (
    MOST_NODES,
    NEWTON_STEPS,
    SETTLED,
    enough_nodes,
    row_counts,
    side_by_side,
    sum_both_sides,
    sum_up,
    too_many,
)
from p2sf.pupil.quadrature import gauss_legendre
from p2sf.pupil.zernike import columns as power_columns
from p2sf.pupil.zernike import evaluate_in_eta, in_square
from p2sf.raytrace.fit import FittedPencil

RIM_POINTS = 512  # where fy is known on the rim; its series has no more harmonics than the fit has orders
RIM_GAP = np.pi / RIM_POINTS  # between an extremum on the rim and the next point by which rows' ends are guessed
IN_MEMORY = 2**13  # columns of rows at a time: where arrays are larger, getting memory takes longer than the sum


@dataclass(frozen=True)
class SkewRows:
    """Nodes over the whole disc in rows: ``fy`` (rows,), the rest (rows, nodes); the weights sum to 1.

    The sum takes ``columns`` columns of each row, by the polynomials through what is known at its nodes.
    """

    fy: np.ndarray
    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray
    columns: int

    @property
    def words(self) -> Message:
        """Return how many rows and columns there are."""
        return Message("{rows} rows × {columns} columns of equal frequency", rows=len(self.fy), columns=self.columns)

    def intensity(
        self, phase: np.ndarray, fx: np.ndarray, light: np.ndarray, pixels: int, pixel_um: float, dtype: DTypeLike
    ) -> np.ndarray:
        """Return the intensity (y, x) on a centred grid, of phases in waves, fx in cycles/µm and light per area."""
        weight = self.weight * light
        weight /= weight.sum()
        half, together = pixels // 2, max(1, IN_MEMORY // self.columns)
        sides = np.zeros((2, pixels, half + 1), np.result_type(dtype, np.complex64))
        for first in range(0, len(self.fy), together):
            some = slice(first, first + together)
            parts = self._on_columns(weight[some], phase[some], fx[some])
            amplitude = pupil_amplitude(*parts[:2], dtype)
            right, left = sum_both_sides(amplitude, amplitude, 2 * np.pi * pixel_um * parts[2], half + 1)
            sides[0] += sum_up(right, self.fy[some], pixels, pixel_um)
            sides[1] += sum_up(left, self.fy[some], pixels, pixel_um)
        field = side_by_side(sides, pixels)
        intensity: np.ndarray = field.real**2 + field.imag**2
        return intensity

    def _on_columns(
        self, weight: np.ndarray, phase: np.ndarray, fx: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return weights, phases and fx at all columns of some rows, (rows, columns), from those at the nodes."""
        few = weight.shape[1]
        if few == self.columns:
            return weight, phase, fx
        refine, share = _refining(few, self.columns), gauss_legendre(few)[1]
        on_columns = (weight / share) @ refine * gauss_legendre(self.columns)[1]
        return on_columns, phase @ refine, fx @ refine


@lru_cache(maxsize=16)
def _refining(few: int, columns: int) -> np.ndarray:
    """Return the matrix (few, columns) that takes a function from a rule's nodes to those of a finer one.

    f = Σ (2n + 1)/2·⟨f, Pₙ⟩·Pₙ, which the rule of ``few`` nodes integrates exactly (A&S 22.2.10).
    """
    (place, share), (wanted, _) = gauss_legendre(few), gauss_legendre(columns)
    here, there = (legvander(x, few - 1) for x in (place, wanted))
    return protected((here * share[:, None] * (np.arange(few) + 0.5)) @ there.T)


def skew_rows_for(found: FittedPencil, pixels: int, pixel_um: float, quality: str) -> SkewRows | None:
    """Return rows that carry the phase of a fit over a window; None where its map is too curved for rows.

    Raises SamplingError where too many nodes would be needed.
    """
    rows, columns = row_counts(found, pixels, pixel_um, quality)
    if rows * columns > MOST_NODES:
        raise too_many(rows, columns, pixels, pixel_um)
    few = enough_nodes(found, columns)
    return skew_rows(found, rows, columns, 2 * few if few else None)


def skew_rows(found: FittedPencil, rows: int, columns: int, nodes: int | None = None) -> SkewRows | None:
    """Return the nodes of a fit, or None where fy does not rise steadily along the rim and across the disc.

    ``nodes``: how many of a row are solved for, from which the columns follow; by default one at each column.
    """
    ends = _ends(found, rows)
    if ends is None:
        return None
    fy, step, left, right = ends
    node, share = gauss_legendre(nodes or columns)
    (xi_left, xi_right), (eta_left, eta_right) = ((f(left)[:, None], f(right)[:, None]) for f in (np.sin, np.cos))
    part = (1 + node) / 2
    xi = xi_left + (xi_right - xi_left) * part
    eta = eta_left + (eta_right - eta_left) * part
    parts = _in_eta(found, xi)
    slopes = [b * part for b, part in enumerate(parts)][1:]
    for _ in range(NEWTON_STEPS):
        slope = evaluate_in_eta(slopes, eta)
        move = (evaluate_in_eta(parts, eta) - fy[:, None]) / slope
        eta -= move
        if np.abs(move).max() < SETTLED:
            break
    else:
        return None
    if not slope.min() * slope.max() > 0:
        return None
    weight = step[:, None] * share / 2 * np.abs(xi_right - xi_left) / np.abs(slope) / np.pi
    return SkewRows(fy, xi, eta, weight, columns)


def _in_eta(found: FittedPencil, xi: np.ndarray) -> list[np.ndarray]:
    """Return fy as a polynomial of η at these ξ: the coefficients of η⁰, η¹, …, arrays like ``xi``."""
    own, square = found.level.counts[2][0], xi * xi
    even = [in_square(column, square) for column in power_columns(found.fy[:own], found.level.map_order)]
    parts = [part + np.zeros_like(xi) for part in even]
    if found.level.skew is not None and len(found.fy) > own:
        odd = power_columns(found.fy[own:], found.level.skew[1], True)
        for place, column in enumerate(odd):
            part = xi * in_square(column, square)
            if place < len(parts):
                parts[place] += part
            else:
                parts.append(part)
    return parts


def _ends(found: FittedPencil, rows: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray] | None:
    """Return fy of every row, the dfy it stands for, and the angles from +η where it meets the rim, left and right."""
    angle, sine, cosine = _rim()
    value = evaluate_in_eta(_in_eta(found, sine), cosine)
    series = np.fft.rfft(value)[: max(found.level.orders) + 1] / RIM_POINTS
    series[1:] *= 2
    top, bottom = _stationary(series, angle[[value.argmax(), value.argmin()]])
    high, low = _on_rim(series, np.array([top, bottom]))[0]
    middle, half = (high + low) / 2, (high - low) / 2
    psi = np.arange(1, rows + 1) * (np.pi / (rows + 1))
    fy, guesses = middle + half * np.cos(psi), []
    for turn in (1, -1):  # from the top clockwise on the right, the other way on the left
        beyond, reach = turn * (angle - top) % (2 * np.pi), turn * (bottom - top) % (2 * np.pi)
        between = np.flatnonzero((beyond > RIM_GAP) & (beyond < reach - RIM_GAP))
        between = between[np.argsort(beyond[between])]
        known = np.arccos(np.clip((value[between] - middle) / half, -1, 1))
        if not (np.diff(known, prepend=0.0, append=np.pi) > 0).all():
            return None
        place = np.concatenate([[0.0], beyond[between], [reach]])
        guesses.append(top + turn * np.interp(psi, np.concatenate([[0.0], known, [np.pi]]), place))
    at = _solved(series, np.array(guesses), fy)
    return None if at is None else (fy, np.abs(half) * np.sin(psi) * (np.pi / (rows + 1)), at[1], at[0])


@lru_cache(maxsize=1)
def _rim() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return angles of evenly spaced points of the rim, from +η towards +ξ, and their ξ and η."""
    angle = np.arange(RIM_POINTS) * (2 * np.pi / RIM_POINTS)
    return angle, np.sin(angle), np.cos(angle)


def _on_rim(series: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return Re Σ series[k]·exp(ik·angle), its derivative and its second one at these angles."""
    k, wave = np.arange(len(series)), np.exp(1j * angle)[..., None] ** np.arange(len(series))
    value, slope, bend = ((wave @ (series * (1j * k) ** order)).real for order in (0, 1, 2))
    return value, slope, bend


def _stationary(series: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return the angles of the extrema of a series that are nearest to these, by Newton's method."""
    for _ in range(NEWTON_STEPS):
        _, slope, bend = _on_rim(series, at)
        at = at - slope / bend
    return at


def _solved(series: np.ndarray, at: np.ndarray, wanted: np.ndarray) -> np.ndarray | None:
    """Return the angles nearest to these where a series has the ``wanted`` values; None where none are found."""
    for _ in range(NEWTON_STEPS):
        value, slope, _ = _on_rim(series, at)
        move = (value - wanted) / slope
        at = at - move
        if np.abs(move).max() < SETTLED:
            return at
    return None
