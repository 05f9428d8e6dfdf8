"""How few pupils are fitted: the others of the field's radial line and of the depths are interpolated."""

from itertools import pairwise

import numpy as np

from p2sf.pixel_kernels import Kernels
from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.pixel_kernels.pupil_table import chebyshev, pupil_table
from p2sf.scene.sensor import Sensor
from p2sf.scene.study import Study, distance, least, oblique

FITS = (2, 3, 4, 5, 6, 8, 10, 13, 18, 25)  # along the radial line or the depths
NESTED_FITS = (2, 3, 5, 9, 17)  # the same for planning itself: each one's nodes are among the next one's
FINE, ROUGH = 1e-3, 3e-2  # relative error of a kernel that planning itself aims at in this, and allows at most


def node_heights(sensor: Sensor, counts) -> tuple[float, ...]:
    """Return the distances from the axis at which the nodes of a field stand, mm, increasing, each once."""
    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), counts, strict=True))
    heights = np.hypot(sensor.x_mm(columns), sensor.y_mm(rows)[:, None]).ravel()
    return tuple(np.unique(np.round(heights, 9)).tolist())


def share_pupils(study: Study) -> None:
    """Let a study interpolate its converged pupils unless kernels would change by more than ROUGH.

    Tried in the bluest colour, which shows the most; at the sharpest depths and at both ends, as pixels wider than a
    sharp kernel hide there what they show of a blurred one.
    """
    wave, scene = min(study.waves), study.scene
    ends = tuple(map(float, scene.vergences(2)))
    depths = [(v, wave) for v in dict.fromkeys((*study.sharpest(wave), *ends))]
    high, across = _few(_error_across, study, (NESTED_FITS, FINE), depths)
    rims = [(height, wave) for height in (study.farthest_mm, study.nearest_mm)]
    deep, along = _few(_error_along, study, (NESTED_FITS, FINE), rims) if scene.near_mm < scene.far_mm else (1, 0.0)
    if max(across, along) > ROUGH:
        return
    heights = chebyshev(study.nearest_mm, study.farthest_mm, high)
    vergences = chebyshev(*ends, deep)
    study.tables.update({w: pupil_table(_own(study, w), heights, vergences) for w in study.waves})
    study.tables_error = across + along


def few_heights(study: Study, needed: int, allowed: float) -> tuple[int, float]:
    """Return how many heights are fitted, all ``needed`` ones at most, and the error of interpolating between them."""
    places = [(v, wave) for wave in study.waves for v in study.depths(wave)]
    return _fewer(_error_across, study, (needed, allowed), places)


def few_depths(study: Study, needed: int, allowed: float) -> tuple[int, float]:
    """Return how many depths are fitted, all ``needed`` ones at most, and the error of interpolating between them."""
    places = [(h, wave) for h in (study.farthest_mm, study.nearest_mm) for wave in study.waves]
    return _fewer(_error_along, study, (needed, allowed), places)


def _fewer(error, study: Study, limits, places) -> tuple[int, float]:
    needed, allowed = limits
    counts = [n for n in FITS if n < needed]
    count, found = _few(error, study, (counts, allowed), places) if counts else (needed, np.inf)
    return (count, found) if found <= allowed else (needed, 0.0)


def _few(error, study: Study, limits, places) -> tuple[int, float]:
    """Return the first of some counts whose error is allowed at all places, else the last; and the error."""
    counts, allowed = limits
    number, found = least(len(counts), lambda n, *place: error(study, counts[n], *place), places, allowed)
    return counts[number], found


def _error_across(study: Study, count: int, vergence: float, wave: float) -> float:
    """Return the worst error amid the heights that are fitted, at one depth."""
    ends = study.nearest_mm, study.farthest_mm
    places = [(height, vergence) for height in chebyshev(*ends, 2 * count - 1)[1::2]]
    return _error(study, (chebyshev(*ends, count), [vergence]), places, wave)


def _error_along(study: Study, count: int, height: float, wave: float) -> float:
    """Return the worst error between the depths that are fitted, at one height.

    The same error of a wavefront shows the more the sharper its kernel is: tried are the depths of every other
    decision, the sharpest among them, and midway between these and the fitted ones.
    """
    vergences, depths = chebyshev(*map(float, study.scene.vergences(2)), count), study.depths(wave)[1:-1]
    places = *depths, *((a + b) / 2 for a, b in pairwise(sorted({*vergences.tolist(), *depths})))
    return _error(study, ([height], vergences), [(height, v) for v in places], wave)


def _error(study: Study, nodes, places, wave: float) -> float:
    study.check()
    recipe, single, pixel = study.recipe(), study.colour_of(wave), study.scene.sensor.pixel_um
    table, errors = pupil_table(_own(study, wave), *nodes), []
    for height, vergence in places:
        x, y = oblique(float(height))
        mixed = Kernels(study.seen(float(vergence)), single, pixel, lambda _: recipe, tables={wave: table})
        errors.append(distance(mixed.at(x, y), study.plain(float(vergence), x, y, wave)))
    return max(errors)


def _own(study: Study, wave: float):
    """Return what gives the study's converged pupil and its lateral colour of a height and vergence."""
    return lambda height, vergence: study.kernels(study.recipe(), study.colour_of(wave), vergence).pupils(height)[0]
