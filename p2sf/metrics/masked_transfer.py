"""Transfer function and cells of a pupil behind a mask, whose lines are several intervals (handbook 6.3).

The edges of the mask, curves over the stop, are mapped to spatial frequency. On a line of constant fy the open part is
a set of intervals; its autocorrelation at a lag is the integral over their overlaps with themselves moved by the lag,
each by Gauss–Legendre. Lines stand close at the ends of every edge, where the intervals change as a root does.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import ceil, hypot, pi

import numpy as np
from numpy.polynomial.chebyshev import chebval, chebval2d, chebvander

from p2sf.errors import Cancelled, SamplingError
from p2sf.metrics.frequency_pupil import FrequencyPupil, reach_of
from p2sf.pupil.mask import PupilMask, mask_slopes
from p2sf.pupil.mask_nodes import exit_distance, outline_radius
from p2sf.pupil.quadrature import gauss_legendre

CURVE = 1024  # points along an edge of the pupil: chords between them depart from it by 5e-6 of the radius
NEWTON_STEPS = 6
FEWEST_ROWS, ROWS_PER_WAVE, FEWEST_PER_PANEL = 160, 3.0, 8
FEWEST_NODES, NODES_PER_WAVE = 14, 7.0
MOST_SLOPE = 300.0  # waves: beyond, a table of contrasts takes minutes
CLOSE = 1e-8  # of the box: ends of edges no farther apart are one
NARROW = 0.35  # power of a ring's width by which it needs more lines
TABLE = 192  # frequencies of a table up to the cut-off, at least
SUBCELLS = 6  # along each side of a cell, by which the open part of cells on edges is found

Intervals = list[tuple[float, float]]


@dataclass(frozen=True, eq=False)
class MaskedSlice:
    """The optical transfer function along one axis behind a mask, as `transfer.OtfSlice` has it."""

    pupil: FrequencyPupil
    along_y: bool
    cancelled: Callable[[], bool]

    @property
    def cut_off(self) -> float:
        """Return the frequency from which on nothing is transferred, cycles per µm."""
        return self.pupil.cut_off_per_um[1 if self.along_y else 0]

    @property
    def step(self) -> float:
        """Return the step of frequency that follows the blur, cycles per µm."""
        reach = reach_of(self.pupil)
        return self.cut_off / (TABLE + 8 * ceil(reach.y if self.along_y else reach.x))

    def at(self, frequency: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the transfer function about the centroid along y, and that of the pupil without phase."""
        own, perfect = self._lines.at(2 * np.minimum(frequency / self.cut_off, 1.0))
        return (own.conj() if self.pupil.turned and not self.along_y else own), perfect

    @cached_property
    def _lines(self) -> "_MaskedLines":
        return _MaskedLines(self.pupil, self.along_y, self.cancelled)


class _MaskedLines:
    """The lines of a pupil along one axis, in the box's coordinates, and the intervals of each that are open."""

    def __init__(self, pupil: FrequencyPupil, along_y: bool, cancelled: Callable[[], bool]):
        reach = reach_of(pupil)
        slopes = mask_slopes(pupil.mask)
        more = 0.0
        if pupil.mask.phased:
            more = hypot(slopes.path_radial_um, slopes.path_angular_um) / abs(pupil.wavelength_um)
        along, across = (reach.y, reach.in_column) if along_y else (reach.x, reach.in_row)
        if along + more > MOST_SLOPE:
            raise SamplingError(
                "a blur of {waves:.0f} waves per pupil radius behind a mask; bring the sensor nearer to the image or "
                "stop down",
                waves=along + more,
            )
        self.pupil, self.along_y, self.cancelled = pupil, along_y, cancelled
        self.count = ceil(FEWEST_NODES + NODES_PER_WAVE * (along + more))
        curves = [
            curve if along_y else curve[::-1] for curve in (to_box(pupil, *edge) for edge in edges_of(pupil.mask))
        ]
        rows = FEWEST_ROWS / (1 - pupil.mask.obscuration) ** NARROW + ROWS_PER_WAVE * (across + more)
        self.places, self.weights = _places(curves, ceil(rows))
        self.open = [_open_intervals(curves, float(place)) for place in self.places]

    def at(self, lags: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return Σ P(x)·P*(x − lag) and the same of |P|, over those at lag 0."""
        lags = np.append(0.0, lags)
        own, perfect = np.zeros(lags.size, complex), np.zeros(lags.size)
        for place, weight, intervals in zip(self.places, self.weights, self.open, strict=True):
            if self.cancelled():
                raise Cancelled("the transfer function was stopped")
            one, other = self._line(float(place), intervals, lags)
            own += weight * one
            perfect += weight * other
        return own[1:] / perfect[0], perfect[1:] / perfect[0]

    def _line(self, place: float, intervals: Intervals, lags: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        own, perfect = np.zeros(lags.size, complex), np.zeros(lags.size)
        node, share = gauss_legendre(self.count)
        for low, high in intervals:
            for left, right in intervals:
                begin, end = np.maximum(low, left + lags), np.minimum(high, right + lags)
                some = np.flatnonzero(end > begin)
                if not some.size:
                    continue
                half = (end[some] - begin[some])[:, None] / 2
                x = (begin[some] + end[some])[:, None] / 2 + half * node
                here, phase = self._values(place, x)
                there, moved = self._values(place, x - lags[some, None])
                light = here * there * share * half
                own[some] += (light * np.exp(2j * pi * (phase - moved))).sum(1)
                perfect[some] += light.sum(1)
        return own, perfect

    def _values(self, place: float, along: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return modulus and phase, in waves about the centroid along y, on a line of the box."""
        pupil = self.pupil

        def on_line(table: np.ndarray) -> np.ndarray:
            across = chebvander(np.array([place]), len(table) - 1)[0]
            values: np.ndarray = chebval(along, table @ across if self.along_y else across @ table)
            return values

        x, y = (np.full_like(along, place), along) if self.along_y else (along, np.full_like(along, place))
        xi, eta = x * on_line(pupil.stretch), on_line(pupil.up)
        phase = on_line(pupil.phase) + pupil.centroid_um * pupil.half_y * y
        if pupil.mask.phased:
            phase = phase + pupil.mask.path_um(xi, eta) / pupil.wavelength_um
        return np.abs(on_line(pupil.density)) * pupil.mask.amplitude(xi, eta), phase


def masked_slices(pupil: FrequencyPupil, cancelled: Callable[[], bool]) -> tuple[MaskedSlice, MaskedSlice]:
    """Return the transfer function along x and along y behind a mask. Raises SamplingError for too large a blur."""
    return MaskedSlice(pupil, False, cancelled), MaskedSlice(pupil, True, cancelled)


def edges_of(mask: PupilMask) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return the closed edges over the stop, ξ and η each: of the iris, then of what is dark inside."""
    corners = [angle % (2 * pi) for angle in mask.corner_angles]
    theta = np.unique(np.concatenate([np.linspace(0, 2 * pi, CURVE, endpoint=False), corners]))
    outer = outline_radius(mask, theta)
    curves = [(outer * np.sin(theta), outer * np.cos(theta))]
    if mask.obscuration:
        curves.append((mask.obscuration * np.sin(theta), mask.obscuration * np.cos(theta)))
    return curves + [_vane_edge(mask, angle) for angle in mask.vane_angles]


def _vane_edge(mask: PupilMask, angle: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the edge of a vane from the middle to beyond the iris; where vanes meet they overlap."""
    half, sine, cosine = mask.vane_width, np.sin(angle), np.cos(angle)
    aside = np.linspace(-half, half, CURVE // 16)
    one = np.ones_like(aside)
    end = exit_distance(mask, aside * cosine, -aside * sine, sine * one, cosine * one)
    sides = np.linspace(0, 1, CURVE // 8)
    along = np.concatenate([end, sides[::-1] * end[-1], sides * end[0]])
    across = np.concatenate([aside, np.full(sides.size, half), np.full(sides.size, -half)])
    return across * cosine + along * sine, along * cosine - across * sine


def to_box(pupil: FrequencyPupil, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return the points of the box whose rays pass (ξ, η) of the pupil, (2, points), by Newton's method."""
    size = (
        float(chebval2d(0.0, 0.0, pupil.stretch)),
        float(chebval2d(1.0, 0.0, pupil.up) - chebval2d(-1.0, 0.0, pupil.up)) / 2,
    )
    x, y = np.clip(xi / size[0], -1, 1), np.clip(eta / size[1], -1, 1)
    step = 1e-6
    for _ in range(NEWTON_STEPS):
        here, right, above = (_stop_point(pupil, x + dx, y + dy) for dx, dy in ((0, 0), (step, 0), (0, step)))
        (a, c), (b, d) = (right - here) / step, (above - here) / step
        miss_x, miss_y, area = xi - here[0], eta - here[1], a * d - b * c
        x, y = x + (d * miss_x - b * miss_y) / area, y + (a * miss_y - c * miss_x) / area
    return np.stack([x, y])


def _stop_point(pupil: FrequencyPupil, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.stack([x * chebval2d(y, x, pupil.stretch), chebval2d(y, x, pupil.up)])


def _places(curves: list[np.ndarray], count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return lines and weights between the ends and corners of all edges, where Gauss–Legendre in an angle crowds."""
    breaks = set()
    for curve in curves:
        across = curve[0]
        turning = (across >= np.roll(across, 1)) != (np.roll(across, -1) >= across)
        breaks |= set(np.round(across[turning], 9).tolist())
    low, high = float(curves[0][0].min()), float(curves[0][0].max())
    inside = [low, *sorted(b for b in breaks if low + CLOSE < b < high - CLOSE), high]
    places, weights = [], []
    for low, high in pairwise(inside):
        node, weight = gauss_legendre(max(FEWEST_PER_PANEL, ceil(count * (high - low) / (inside[-1] - inside[0]))))
        angle = node * pi / 2
        places.append((low + high + (high - low) * np.sin(angle)) / 2)
        weights.append((high - low) / 2 * np.cos(angle) * weight * pi / 2)
    return np.concatenate(places), np.concatenate(weights)


def _open_intervals(curves: list[np.ndarray], place: float) -> Intervals:
    """Return the intervals of a line inside the first curve and outside all others."""
    found = _inside(curves[0], place)
    for curve in curves[1:]:
        for low, high in _inside(curve, place):
            parts = [((a, min(b, low)), (max(a, high), b)) for a, b in found]
            found = [(a, b) for pair in parts for a, b in pair if b > a]
    return found


def _inside(curve: np.ndarray, place: float) -> Intervals:
    """Return the intervals of a line inside a closed curve, (2, points): across the lines, and along them."""
    across, along = curve
    above = across > place
    cut = np.flatnonzero(above != np.roll(above, -1))
    following = (cut + 1) % across.size
    part = (place - across[cut]) / (across[following] - across[cut])
    crossings = np.sort(along[cut] + part * (along[following] - along[cut])).tolist()
    return list(zip(crossings[::2], crossings[1::2], strict=False))


def masked_cells(pupil: FrequencyPupil, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return amplitude with the open share of each cell, amplitude without, and the mask's phase, (y, x).

    The open share is counted on SUBCELLS² points of each cell.
    """
    wide, high = x[1] - x[0], y[1] - y[0]
    place = (np.arange(SUBCELLS) + 0.5) / SUBCELLS - 0.5
    fine = [(np.repeat(a, SUBCELLS), step) for a, step in ((x, wide), (y, high))]
    fine_x, fine_y = (a + np.tile(place, a.size // SUBCELLS) * step for a, step in fine)
    order = len(pupil.up) - 1
    along, across = chebvander(fine_y, order), chebvander(fine_x, order)
    xi, eta = fine_x * (along @ pupil.stretch @ across.T), along @ pupil.up @ across.T
    open_ = pupil.mask.opens(xi, eta) & (xi * xi + eta * eta <= 1)
    share = open_.reshape(y.size, SUBCELLS, x.size, SUBCELLS).mean((1, 3))
    along, across = chebvander(y, order), chebvander(x, order)
    xi, eta = x * (along @ pupil.stretch @ across.T), along @ pupil.up @ across.T
    inside = share > 0
    density = np.where(inside, np.abs(pupil.on_grid(x, y)[1]) * pupil.mask.amplitude(xi * inside, eta * inside), 0.0)
    phase = pupil.on_grid(x, y)[0]
    if pupil.mask.phased:
        phase = phase + pupil.mask.path_um(xi * inside, eta * inside) / pupil.wavelength_um
    return share * density, density, phase
