"""The lines of a pupil behind a mask, each open in several intervals (handbook 6.3).

The edges of the mask, curves over the stop, are mapped to spatial frequency, where those of the pupil itself are known.
"""

from itertools import pairwise
from math import ceil, pi

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebvander

from p2sf.errors import GeometryError
from p2sf.metrics.frequency_pupil import UNFOLLOWED, FrequencyPupil
from p2sf.pupil.mask import PupilMask
from p2sf.pupil.mask_nodes import exit_distance, outline_radius
from p2sf.pupil.quadrature import gauss_legendre

CURVE = 1024  # points along an edge of the pupil: chords between them depart from it by 5e-6 of the radius
NEWTON_STEPS, NEWTON_ENOUGH = 12, 1e-10  # of the rim's radius
NEWTON_LEAST = 1e-5  # and above which contrast is not as exact as the handbook says
FARTHEST = 1.05  # in the box's coordinates: farther out its polynomials are of no use
FEWEST_PER_PANEL = 8
CLOSE = 1e-8  # of the box: ends of edges no farther apart are one


def box_edges(pupil: FrequencyPupil) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Return the closed curves in the box, (2, points), whose insides are open, and those whose insides are dark."""
    inner, dark = edges_of(pupil.mask)
    return [pupil.edge, *(to_box(pupil, *edge) for edge in inner)], [to_box(pupil, *edge) for edge in dark]


def edges_of(mask: PupilMask) -> tuple[list[tuple[np.ndarray, np.ndarray]], list[tuple[np.ndarray, np.ndarray]]]:
    """Return the closed edges over the stop, ξ and η each: of the iris, if any, and of what is dark inside."""
    corners = [angle % (2 * pi) for angle in mask.corner_angles]
    theta = np.unique(np.concatenate([np.linspace(0, 2 * pi, CURVE, endpoint=False), corners]))
    sine, cosine, outer = np.sin(theta), np.cos(theta), outline_radius(mask, theta)
    middle = [mask.disc.outline(theta)] if mask.obscured else []
    iris = [(outer * sine, outer * cosine)] if mask.iris else []
    return iris, middle + [_vane_edge(mask, angle) for angle in mask.vane_angles]


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
    # The first guess is by the secants along the box's axes.
    three = np.array([-1.0, 0.0, 1.0])
    at = np.stack(pupil.stop_on_grid(three, three))
    left, right, low, high = at[:, 1, 0], at[:, 1, 2], at[:, 0, 1], at[:, 2, 1]
    secants, centre = np.stack([right - left, high - low], axis=1) / 2, (left + right + low + high) / 4
    x, y = np.clip(np.linalg.solve(secants, np.stack([xi, eta]) - centre[:, None]), -1, 1)
    for _ in range(NEWTON_STEPS):
        across, a, b = _with_slopes(pupil.xi, x, y)
        up, c, d = _with_slopes(pupil.eta, x, y)
        miss_x, miss_y, area = xi - across, eta - up, a * d - b * c
        miss = max(np.abs(miss_x).max(), np.abs(miss_y).max())
        if miss < NEWTON_ENOUGH:
            break
        x = np.clip(x + (d * miss_x - b * miss_y) / area, -FARTHEST, FARTHEST)
        y = np.clip(y + (a * miss_y - c * miss_x) / area, -FARTHEST, FARTHEST)
    if not miss < NEWTON_LEAST:  # NaN too
        raise GeometryError(UNFOLLOWED)
    return np.stack([x, y])


def _with_slopes(table: np.ndarray, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return Σ table[b, a]·T_b(y)·T_a(x) at points, and its derivatives with x and with y."""
    order = len(table) - 1
    along, across = chebvander(y, order), chebvander(x, order)
    derivative = chebder(np.eye(order + 1))
    rows = along @ table
    return (
        np.einsum("na,na->n", rows, across),
        np.einsum("na,na->n", rows @ derivative.T, across[:, :-1]),
        np.einsum("na,na->n", along[:, :-1] @ (derivative @ table), across),
    )


def places_between(curves: list[np.ndarray], count: int, even: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Return places of some ``count`` lines and weights; where all is ``even`` of those from 0 on, which count twice.

    Between the ends and corners of all edges they are those of Gauss–Legendre in an angle, which crowd there.
    """
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
    place, share = np.concatenate(places), np.concatenate(weights)
    if not even:
        return place, share
    half = place > -CLOSE  # a line in the middle is its own mirror image
    return place[half], (share * np.where(place > CLOSE, 2, 1))[half]


def open_intervals(
    light: list[np.ndarray], dark: list[np.ndarray], places: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the lower and upper ends of the open intervals of lines, (intervals, lines); both 0 where there are fewer.

    The curves, (2, points): across the lines, and along them. A point of a line is inside a curve where an odd number
    of its crossings lie below.
    """
    curves = [*light, *dark]
    found = [_crossings(curve, places) for curve in curves]
    ends = np.concatenate(found, axis=1)
    curve_of = np.repeat(np.arange(len(curves)), [one.shape[1] for one in found])
    order = np.argsort(ends, axis=1, kind="stable")
    ends = np.take_along_axis(ends, order, axis=1)
    wanted = np.arange(len(curves)) < len(light)
    inside = (np.cumsum(curve_of[order][:, :, None] == np.arange(len(curves)), axis=1) % 2).astype(bool)
    open_ = (inside == wanted).all(2)[:, :-1] & np.isfinite(ends[:, 1:])
    first = np.argsort(~open_, axis=1, kind="stable")[:, : max(1, int(open_.sum(1).max(initial=0)))]
    some = np.take_along_axis(open_, first, axis=1)
    low, high = (np.where(some, np.take_along_axis(ends[:, k:], first, axis=1), 0.0).T for k in (0, 1))
    return low, high


def _crossings(curve: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Return where lines cross a closed curve, (lines, crossings), infinite where there are fewer."""
    across, along = np.append(curve, curve[:, :1], axis=1)
    above = across > places[:, None]
    line, cut = np.divmod(np.flatnonzero(above[:, 1:] != above[:, :-1]), across.size - 1)  # faster than `nonzero`
    part = (places[line] - across[cut]) / (across[cut + 1] - across[cut])
    counts = np.bincount(line, minlength=places.size)
    table = np.full((places.size, max(1, int(counts.max(initial=0)))), np.inf)
    starts = np.cumsum(counts) - counts
    table[line, np.arange(line.size) - starts[line]] = along[cut] + part * (along[cut + 1] - along[cut])
    return table


def light_on_grid(
    pupil: FrequencyPupil, x: np.ndarray, y: np.ndarray, wanted: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return modulus and phase in waves, (y, x), behind a mask without its edges; the modulus 0 if not ``wanted``."""
    mask, (phase, density) = pupil.mask, pupil.on_grid(x, y)
    if mask.shaded or mask.phased:
        xi, eta = (wanted * values for values in pupil.stop_on_grid(x, y))
        density = density * mask.amplitude(xi, eta)
        if mask.phased:
            phase = phase + mask.path_um(xi, eta) / pupil.wavelength_um
    return np.where(wanted, np.abs(density), 0.0), phase
