"""Rows of equal frequency over a pupil without symmetry, for sums that separate into two products.

As `separable_sum`, but nothing is even in ξ. Between the largest and the smallest fy on the rim rows lie at
fy = m + h·cos ψ, ψ = jπ/(n + 1); each is a curve from rim to rim, with Gauss–Legendre nodes in ξ. A row's integral is
sin ψ times a smooth function of ψ, so that the trapezoid is Gauss–Chebyshev quadrature. Along a row the field at ±x is
Σ a·cos(2π fx·x) ± i·Σ a·sin(2π fx·x).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import DTypeLike

from p2sf.messages import Message
from p2sf.psf.plane_waves import pupil_amplitude
from p2sf.psf.separable_sum import (
    MOST_NODES,
    NEWTON_STEPS,
    SETTLED,
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
IN_MEMORY = 2**20  # nodes at a time
STRAIGHT = 1e-6  # of the steepest slope on the rim: where the slope between top and bottom is less, fy does not rise


@dataclass(frozen=True)
class SkewRows:
    """Nodes over the whole disc in rows: ``fy`` (rows,), the rest (rows, columns); the weights sum to 1."""

    fy: np.ndarray
    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray

    @property
    def words(self) -> Message:
        """Return how many rows and columns there are."""
        rows, columns = self.xi.shape
        return Message("{rows} rows × {columns} columns of equal frequency", rows=rows, columns=columns)

    def intensity(
        self, phase: np.ndarray, fx: np.ndarray, light: np.ndarray, pixels: int, pixel_um: float, dtype: DTypeLike
    ) -> np.ndarray:
        """Return the intensity (y, x) on a centred grid, of phases in waves, fx in cycles/µm and light per area."""
        weight = self.weight * light
        weight /= weight.sum()
        half, together = pixels // 2, max(1, IN_MEMORY // self.xi.shape[1])
        sides = np.zeros((2, pixels, half + 1), np.result_type(dtype, np.complex64))
        for first in range(0, len(self.fy), together):
            some = slice(first, first + together)
            amplitude = pupil_amplitude(weight[some], phase[some], dtype)
            right, left = sum_both_sides(amplitude, amplitude, 2 * np.pi * pixel_um * fx[some], half + 1)
            sides[0] += sum_up(right, self.fy[some], pixels, pixel_um)
            sides[1] += sum_up(left, self.fy[some], pixels, pixel_um)
        field = side_by_side(sides, pixels)
        intensity: np.ndarray = field.real**2 + field.imag**2
        return intensity


def skew_rows_for(found: FittedPencil, pixels: int, pixel_um: float, quality: str) -> SkewRows | None:
    """Return rows that carry the phase of a fit over a window; None where its map is too curved for rows.

    Raises SamplingError where too many nodes would be needed.
    """
    rows, columns = row_counts(found, pixels, pixel_um, quality)
    if rows * columns > MOST_NODES:
        raise too_many(rows, columns, pixels, pixel_um)
    return skew_rows(found, rows, columns)


def skew_rows(found: FittedPencil, rows: int, columns: int) -> SkewRows | None:
    """Return the nodes of a fit, or None where fy does not rise steadily along the rim and across the disc."""
    ends = _ends(found, rows)
    if ends is None:
        return None
    fy, step, left, right = ends
    node, share = gauss_legendre(columns)
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
    return SkewRows(fy, xi, eta, weight)


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
    angle, harmonics = _rim()
    series = np.fft.rfft(evaluate_in_eta(_in_eta(found, np.sin(angle)), np.cos(angle))) / RIM_POINTS
    series[1:] *= 2
    top, bottom = (_extreme(series, angle, harmonics, sign) for sign in (1, -1))
    high, low = (_on_rim(series, harmonics, np.array([at]))[0][0] for at in (top, bottom))
    middle, half = (high + low) / 2, (high - low) / 2
    psi = np.arange(1, rows + 1) * (np.pi / (rows + 1))
    fy = middle + half * np.cos(psi)
    arcs = []
    for turn in (1, -1):  # from the top clockwise on the right, the other way on the left
        reach = turn * (bottom - top) % (2 * np.pi)
        place = top + turn * np.linspace(0, reach, RIM_POINTS)
        value = _on_rim(series, harmonics, place)[0]
        known = np.arccos(np.clip((value - middle) / half, -1, 1))
        if not (np.diff(known) > 0).all():
            return None
        at = np.interp(psi, known, place)
        for _ in range(NEWTON_STEPS):
            value, slope, _ = _on_rim(series, harmonics, at)
            move = (value - fy) / slope
            at = at - move
        if not np.abs(move).max() < SETTLED:
            return None
        arcs.append(at)
    right, left = arcs
    return fy, np.abs(half) * np.sin(psi) * (np.pi / (rows + 1)), left, right


@lru_cache(maxsize=1)
def _rim() -> tuple[np.ndarray, np.ndarray]:
    """Return angles of evenly spaced points of the rim from +η towards +ξ, and the harmonics of a series there."""
    return np.arange(RIM_POINTS) * (2 * np.pi / RIM_POINTS), np.arange(RIM_POINTS // 2 + 1)


def _on_rim(series: np.ndarray, harmonics: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a Fourier series, its derivative and its second one at these angles."""
    kept = max(2, int(np.flatnonzero(np.abs(series) > 1e-15 * np.abs(series).max())[-1]) + 1)
    k, wave = harmonics[:kept], np.exp(1j * np.outer(angle, harmonics[:kept]))
    value, slope, bend = ((wave @ (series[:kept] * (1j * k) ** order)).real for order in (0, 1, 2))
    return value, slope, bend


def _extreme(series: np.ndarray, angle: np.ndarray, harmonics: np.ndarray, sign: int) -> float:
    """Return the angle where fy is largest on the rim, or smallest with ``sign`` −1."""
    at = angle[np.argmax(sign * _on_rim(series, harmonics, angle)[0])][None]
    for _ in range(NEWTON_STEPS):
        _, slope, bend = _on_rim(series, harmonics, at)
        at = at - slope / bend
    return float(at[0])
