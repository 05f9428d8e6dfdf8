"""A wavefront as a surface in space, seen from one side and above, by array arithmetic alone. No Qt in here.

The surface is cut into slices across the line of sight. A pixel shows the first slice that passes its height: in rising
the upper side, in falling the under side. How many slices come before is counted for all pixels at once.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

HEIGHT = 0.6  # pupil radii that stand for the colour bar's end
HALF = 1.2  # pupil radii from the middle of the picture to its edge
MESH, LINE = 0.25, 0.012  # pupil radii between two lines of the net, and half a line's thickness
LIT, SLOPE, DARKEST = 0.82, 0.35, 0.45  # brightness of level ground, what a slope of one adds, the least
UNDER, NET = 0.72, 0.62  # brightness of the under side and of the net, of what would be there otherwise


@dataclass(frozen=True)
class View:
    """Where the eye stands, degrees (0 and 90 see ξ to the right and η up), and the picture's pixels across."""

    turn_deg: float
    tilt_deg: float
    count: int


@dataclass(frozen=True)
class Relief:
    """What the pixels of a picture show, (count, count), rows upwards: W in waves, NaN for nothing; brightness to 1."""

    waves: np.ndarray
    light: np.ndarray


@dataclass(frozen=True)
class Grid:
    """The slices from the front, (slices, columns): four map samples and weights for each place (4, …), the net.

    ``nearest``: a place's slice where W is known, else the last one before it, else the first; ``met``: the columns
    with any; ``depth``: how far behind the pupil's middle, in pupil radii.
    """

    samples: np.ndarray
    weights: np.ndarray
    net: np.ndarray
    nearest: np.ndarray
    met: np.ndarray
    depth: np.ndarray


def relief(waves: np.ndarray, limit: float, view: View) -> Relief:
    """Return the picture of W over the pupil, (n, n), NaN where there is none; ``limit`` waves stand `HEIGHT` high."""
    known, tilt = np.isfinite(waves), np.deg2rad(view.tilt_deg)
    grid = placed(known.tobytes(), len(waves), view)
    height = (grid.weights * np.where(known, waves, 0.0).ravel()[grid.samples]).sum(axis=0)
    level = grid.depth * np.sin(tilt) + height * (HEIGHT / limit * np.cos(tilt))
    slices, under = first_seen(np.take_along_axis(level, grid.nearest, 0), view.count)
    seen = (slices < len(level)) & grid.met[:, None]
    place = np.take_along_axis(grid.nearest, np.minimum(slices, len(level) - 1).T, 0), np.arange(view.count)
    light = np.where(under.T, UNDER, 1.0) * lighted(height * (HEIGHT / limit), grid)[place]
    return Relief(np.where(seen.T, height[place], np.nan), light)


def first_seen(level: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return for each pixel, (columns, rows), the first slice that passes its height, and whether in falling.

    ``level``: heights of the slices from the front, (slices, columns), in pupil radii. No slice: their number.
    """
    first = (count + 1) * np.arange(level.shape[1])
    passed = []
    for reach in (np.maximum, np.minimum):
        row = np.ceil((reach.accumulate(level, 0) + HALF) * (count / 2 / HALF) - 0.5)  # the lowest pixel not below
        place = np.clip(row, 0, count).astype(np.intp) + first
        counted = np.bincount(place.ravel(), minlength=first.size * (count + 1)).reshape(-1, count + 1)
        passed.append(np.cumsum(counted, axis=1)[:, :count])
    above = len(level) - passed[1]  # slices that have not yet fallen to this pixel
    return passed[0] + above, above > 0


def lighted(height: np.ndarray, grid: Grid) -> np.ndarray:
    """Return how bright the surface is: more where it faces front and left, less on the net."""
    step, column = np.maximum(grid.depth[1] - grid.depth[0], 1e-6), 2 * HALF / height.shape[1]
    back = np.gradient(height, axis=0) / step
    right = (np.gradient(height, axis=1) - back * np.gradient(grid.depth, axis=1)) / column  # at the same depth
    light = np.clip(LIT + SLOPE * (back + right) / np.sqrt(1 + back**2 + right**2), DARKEST, 1.0)
    return np.where(grid.net, NET * light, light)


@lru_cache(maxsize=4)
def placed(known: bytes, count: int, view: View) -> Grid:
    """Return the slices' places over a map of ``count``² samples, of which those ``known`` have a value."""
    across = (np.arange(view.count) + 0.5) * 2 * HALF / view.count - HALF
    rim, turn = np.sqrt(np.maximum(0.0, 1 - across**2)), np.deg2rad(view.turn_deg)
    depth = np.linspace(-1, 1, view.count // 2 + 1)[:, None] * rim  # each column from rim to rim
    xi = across * np.cos(turn) - depth * np.sin(turn)
    eta = across * np.sin(turn) + depth * np.cos(turn)
    samples, weights = neighbours(xi, eta, count)
    weights = weights * np.frombuffer(known, bool)[samples]
    total = weights.sum(axis=0)
    at_rim = (xi**2 + eta**2 > (1 - 2 / count) ** 2) & (total > 0)  # beyond the rim no neighbour is known
    found = (at_rim | (total > 0.5)) & (rim > 0)
    weights = np.divide(weights, total, out=np.zeros_like(weights), where=found)
    number = np.arange(len(depth))[:, None]
    nearest = np.maximum(np.maximum.accumulate(np.where(found, number, -1), axis=0), found.argmax(axis=0))
    net = np.minimum(*(np.abs((v / MESH + 0.5) % 1 - 0.5) for v in (xi, eta))) * MESH < max(LINE, 1 / view.count)
    return Grid(samples, weights, net, nearest, found.any(axis=0), depth)


def neighbours(xi: np.ndarray, eta: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the four samples around each place of a map of ``count``², and straight-line weights, (4, …) each."""
    places = [np.clip((v + 1) * count / 2 - 0.5, 0, count - 1.001) for v in (eta, xi)]
    (row, column), (up, right) = ([p.astype(int) for p in places], [p % 1 for p in places])
    both = [(j, i) for j in (0, 1) for i in (0, 1)]
    weights = [(up if j else 1 - up) * (right if i else 1 - right) for j, i in both]
    return np.array([(row + j) * count + column + i for j, i in both]), np.array(weights)
