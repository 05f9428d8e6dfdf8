"""How few pupils need fitting: the others, over the field's radius and the depths, are interpolated."""

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np

from p2sf.pixel_kernels import Kernels
from p2sf.pixel_kernels.frequency_grid import FrequencyPupil
from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.pixel_kernels.pupil_table import chebyshev, pupil_table
from p2sf.scene.sensor import Sensor
from p2sf.scene.study import Study, distance, first_allowed, oblique

COUNTS = (2, 3, 4, 5, 6, 8, 10, 13, 18, 25)  # of fits over the radius or the depths
NESTED_COUNTS = (2, 3, 5, 9, 17)  # for planning itself: each one's nodes are among the next one's
TARGET_ERROR, LARGEST_ERROR = 1e-3, 3e-2  # relative error of a kernel that planning's own interpolation may cause

Error = Callable[[Study, int, float, float], float]  # (study, count, depth or height, wavelength)


def node_heights(sensor: Sensor, counts: tuple[int, int]) -> tuple[float, ...]:
    """Return the distances from the axis of a lattice's nodes, mm, increasing, each once."""
    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), counts, strict=True))
    heights = np.hypot(sensor.x_mm(columns), sensor.y_mm(rows)[:, None]).ravel()
    return tuple(np.unique(np.round(heights, 9)).tolist())


def share_pupils(study: Study) -> None:
    """Let a study interpolate its converged pupils unless kernels would change by more than LARGEST_ERROR.

    Tried in the bluest colour, which shows the most; at the sharpest depths and at both ends, since pixels wider than
    a sharp kernel hide errors there that a blurred kernel shows.
    """
    wave, scene = min(study.waves), study.scene
    low, high = map(float, scene.vergences(2))
    depths = [(v, wave) for v in dict.fromkeys((*study.sharpest(wave), low, high))]
    height_count, height_error = _first_count(_height_error, study, NESTED_COUNTS, TARGET_ERROR, depths)
    depth_count, depth_error = 1, 0.0
    if scene.near_mm < scene.far_mm:
        ends = [(height, wave) for height in (study.farthest_mm, study.nearest_mm)]
        depth_count, depth_error = _first_count(_depth_error, study, NESTED_COUNTS, TARGET_ERROR, ends)
    if max(height_error, depth_error) > LARGEST_ERROR:
        return
    heights = chebyshev(study.nearest_mm, study.farthest_mm, height_count)
    vergences = chebyshev(low, high, depth_count)
    study.tables.update({w: pupil_table(_fitted_pupils(study, w), heights, vergences) for w in study.waves})
    study.tables_error = height_error + depth_error


def few_heights(study: Study, needed: int, allowed: float) -> tuple[int, float]:
    """Return how many heights are fitted, all ``needed`` ones at most, and the error of interpolating between them."""
    places = [(v, wave) for wave in study.waves for v in study.depths(wave)]
    return _count_below(_height_error, study, needed, allowed, places)


def few_depths(study: Study, needed: int, allowed: float) -> tuple[int, float]:
    """Return how many depths are fitted, all ``needed`` ones at most, and the error of interpolating between them."""
    places = [(h, wave) for h in (study.farthest_mm, study.nearest_mm) for wave in study.waves]
    return _count_below(_depth_error, study, needed, allowed, places)


def _count_below(
    error: Error, study: Study, needed: int, allowed: float, places: list[tuple[float, float]]
) -> tuple[int, float]:
    """Return the first of COUNTS below ``needed`` whose error is allowed, else ``needed``; and the error."""
    counts = [n for n in COUNTS if n < needed]
    count, found = _first_count(error, study, counts, allowed, places) if counts else (needed, np.inf)
    return (count, found) if found <= allowed else (needed, 0.0)


def _first_count(
    error: Error, study: Study, counts: Sequence[int], allowed: float, places: list[tuple[float, float]]
) -> tuple[int, float]:
    """Return the first of some counts whose error is allowed at all places, else the last; and the error."""
    number, found = first_allowed(len(counts), lambda n, *place: error(study, counts[n], *place), places, allowed)
    return counts[number], found


def _height_error(study: Study, count: int, vergence: float, wave: float) -> float:
    """Return the worst error between ``count`` fitted heights at one depth."""
    ends = study.nearest_mm, study.farthest_mm
    places = [(height, vergence) for height in chebyshev(*ends, 2 * count - 1)[1::2]]
    return _error(study, chebyshev(*ends, count), [vergence], places, wave)


def _depth_error(study: Study, count: int, height: float, wave: float) -> float:
    """Return the worst error between ``count`` fitted depths at one height.

    An error of the wavefront shows the more the sharper its kernel is. So it is tried at the depths of every other
    decision, the sharpest among them, and midway between these and the fitted ones.
    """
    low, high = map(float, study.scene.vergences(2))
    vergences, depths = chebyshev(low, high, count), study.depths(wave)[1:-1]
    tried = *depths, *((a + b) / 2 for a, b in pairwise(sorted({*vergences.tolist(), *depths})))
    return _error(study, [height], vergences, [(height, v) for v in tried], wave)


def _error(
    study: Study,
    heights: Sequence[float] | np.ndarray,
    vergences: Sequence[float] | np.ndarray,
    places: list[tuple[float, float]],
    wave: float,
) -> float:
    """Return the worst error at (height, vergence) places of kernels interpolated between these nodes."""
    study.check()
    recipe, single, pixel = study.recipe(), study.colour_of(wave), study.scene.sensor.pixel_um
    table, errors = pupil_table(_fitted_pupils(study, wave), heights, vergences), []
    for height, vergence in places:
        x, y = oblique(float(height))
        seen = study.sensor_map(float(vergence))
        interpolated = Kernels(seen, single, pixel, lambda _: recipe, tables={wave: table})
        errors.append(distance(interpolated.at(x, y), study.kernel(float(vergence), x, y, wave)))
    return max(errors)


def _fitted_pupils(study: Study, wave: float) -> Callable[[float, float], tuple[FrequencyPupil, float]]:
    """Return the function of (height, vergence) that gives the study's converged pupil and its lateral colour."""
    return lambda height, vergence: study.kernels(study.recipe(), study.colour_of(wave), vergence).pupils(height)[0]
