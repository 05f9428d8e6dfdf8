"""Short models of a PSF's shape: a Gaussian, a generalised Gaussian and a Moffat function, their numbers interpolated.

All are functions of q = (x/a)² + ((y − c)/b)²: exp(−q/2); exp(−(q/2)^β), which a β below 1 gives a core and skirts
(Claxton & Staunton 2008); (1 + q)^−β (Moffat 1969, eq. 7). Fields lie along y, so none is turned.
"""

from collections.abc import Iterator
from functools import partial
from itertools import product
from time import process_time

import numpy as np

from p2sf.conventions import centred_axis
from tests.benchmarks.representations.interpolation import Counts, Rule, node_weights
from tests.benchmarks.representations.pictures import used_counts
from tests.benchmarks.representations.representation import ExactPsfs, Representation, clipped_to_unit_sum
from tests.benchmarks.representations.space import LensSpace, SpacePoints

SHAPES = {"Gaussian": 3, "generalised Gaussian": 4, "Moffat": 4}  # numbers of each
GRIDS: tuple[tuple[Counts, Rule], ...] = ((1, 3, 1), "linear"), ((3, 3, 3), "linear"), ((3, 5, 3), "cubic")
NARROWEST, WIDEST = 0.2, 4.0  # in pixels and in windows
STEEPNESS = {"generalised Gaussian": (0.15, 6.0), "Moffat": (1.01, 60.0)}  # bounds of β
STARTS = 0.6, 1.0  # of the widths, in units of the light's RMS radius: a core with skirts, or all alike
VALUE_BYTES = 4
MOST_STEPS = 30


def shape_representations(space: LensSpace, exact: ExactPsfs, quick: bool = False) -> Iterator[Representation]:
    """Yield every shape with its numbers on grids of nodes."""
    for shape, (counts, rule) in product(SHAPES, GRIDS[1:2] if quick else GRIDS):
        yield _on_grid(space, exact, shape, used_counts(space, counts), rule)


def _on_grid(space: LensSpace, exact: ExactPsfs, shape: str, counts: Counts, rule: Rule) -> Representation:
    nodes = space.grid(counts)
    pictures = exact.at(nodes)
    started = process_time()
    table = np.array([fitted_shape(picture, shape) for picture in pictures], np.float32)
    seconds = len(nodes) * exact.seconds + process_time() - started
    words = f"{SHAPES[shape]} numbers, {' × '.join(map(str, counts))} nodes, {rule}"
    psf = partial(_psf, space, shape, counts, rule, table)
    return Representation(shape, words, table.size, VALUE_BYTES * table.size, seconds, psf)


def fitted_shape(picture: np.ndarray, shape: str) -> np.ndarray:
    """Return (log a, log b, c, log β where there is one), in pixels, of the shape nearest to a picture in L2."""
    from scipy.optimize import least_squares

    pixels = picture.shape[-1]
    axis, norm = centred_axis(pixels), float(np.linalg.norm(picture))
    low, high = np.log(NARROWEST), np.log(WIDEST * pixels)
    bounds = [[low, high], [low, high], [axis[0], axis[-1]]]
    if shape in STEEPNESS:
        bounds.append(list(np.log(STEEPNESS[shape])))
    limits = np.array(bounds, float).T

    def misfit(numbers: np.ndarray) -> np.ndarray:
        found: np.ndarray = (shape_values(numbers, shape, pixels) - picture) / norm
        return found.ravel()

    tries = [
        least_squares(
            misfit, np.clip(start, limits[0] + 1e-6, limits[1] - 1e-6), bounds=tuple(limits), max_nfev=MOST_STEPS
        )
        for start in _starts(picture, axis, shape)
    ]
    best: np.ndarray = min(tries, key=lambda found: found.cost).x
    return best


def _starts(picture: np.ndarray, axis: np.ndarray, shape: str) -> Iterator[list[float]]:
    """Yield starting numbers from the moments of a picture."""
    light = picture.sum()
    centre = float(picture.sum(1) @ axis / light)
    wide = float(np.sqrt(picture.sum(0) @ axis**2 / light))
    high = float(np.sqrt(picture.sum(1) @ (axis - centre) ** 2 / light))
    for share in STARTS:
        yield [np.log(share * wide), np.log(share * high), centre, *([np.log(1.5)] if shape in STEEPNESS else [])]


def shape_values(numbers: np.ndarray, shape: str, pixels: int) -> np.ndarray:
    """Return a shape of unit sum over the window, (pixels, pixels), from numbers as `fitted_shape` gives them."""
    axis = centred_axis(pixels)
    width, height, centre = np.exp(numbers[0]), np.exp(numbers[1]), numbers[2]
    q = (axis / width) ** 2 + (((axis - centre) / height) ** 2)[:, None]
    if shape == "Gaussian":
        values = np.exp(-(q - q.min()) / 2)
    elif shape == "Moffat":
        values = (1 + q) ** -np.exp(numbers[3])
    else:
        values = np.exp(-((q / 2) ** np.exp(numbers[3])))
    unit: np.ndarray = values / max(values.sum(), np.finfo(float).tiny)
    return unit


def _psf(
    space: LensSpace, shape: str, counts: Counts, rule: Rule, table: np.ndarray, points: SpacePoints
) -> np.ndarray:
    numbers = node_weights(counts, rule, points.cube) @ table
    return clipped_to_unit_sum(np.stack([shape_values(row, shape, space.window.pixels) for row in numbers]))
