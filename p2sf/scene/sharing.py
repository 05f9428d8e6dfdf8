"""How few pupils are fitted: the others of the field's radial line and of the depths are interpolated."""

from itertools import pairwise

import numpy as np

from p2sf.kernels import Kernels, Recipe
from p2sf.kernels.nodes import nodes_along
from p2sf.kernels.pupiltable import chebyshev, pupil_table
from p2sf.scene.sensor import Sensor
from p2sf.scene.study import RUNGS, SAMPLINGS, Study, distance, oblique

FITS = (2, 3, 4, 5, 6, 8, 10, 13)  # along the radial line or the depths


def node_heights(sensor: Sensor, counts) -> tuple[float, ...]:
    """Return the distances from the axis at which the nodes of a field stand, mm, increasing, each once."""
    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), counts, strict=True))
    heights = np.hypot(sensor.x_mm(columns), sensor.y_mm(rows)[:, None]).ravel()
    return tuple(np.unique(np.round(heights, 9)).tolist())


def few_heights(study: Study, needed: int, allowed: float) -> tuple[int, float]:
    """Return how many heights are fitted, all ``needed`` ones at most, and the error of interpolating between them."""
    tried = (
        (n, max(_error_across(study, n, v, wave) for wave in study.waves for v in study.depths(wave)))
        for n in FITS
        if n < needed
    )
    return next((found for found in tried if found[1] <= allowed), (needed, 0.0))


def few_depths(study: Study, needed: int, allowed: float) -> tuple[int, float]:
    """Return how many depths are fitted, all ``needed`` ones at most, and the error of interpolating between them."""
    ends = study.nearest_mm, study.farthest_mm
    tried = (
        (n, max(_error_along(study, n, h, wave) for h in ends for wave in study.waves)) for n in FITS if n < needed
    )
    return next((found for found in tried if found[1] <= allowed), (needed, 0.0))


def _error_across(study: Study, count: int, vergence: float, wave: float) -> float:
    """Return the worst error midway between the heights that are fitted, at one depth."""
    heights = chebyshev(study.nearest_mm, study.farthest_mm, count)
    return _error(study, (heights, [vergence]), [((a + b) / 2, vergence) for a, b in pairwise(heights)], wave)


def _error_along(study: Study, count: int, height: float, wave: float) -> float:
    """Return the worst error between the depths that are fitted, at one height.

    The same error of a wavefront shows the more the sharper its kernel is: tried are the depths of every other
    decision, the sharpest among them, and midway between these and the fitted ones.
    """
    vergences, depths = chebyshev(*map(float, study.scene.vergences(2)), count), study.depths(wave)[1:-1]
    places = *depths, *((a + b) / 2 for a, b in pairwise(sorted({*vergences.tolist(), *depths})))
    return _error(study, ([height], vergences), [(height, v) for v in places], wave)


def _error(study: Study, nodes, places, wave: float) -> float:
    recipe, single, pixel = _recipe(study, wave), study.colour_of(wave), study.scene.sensor.pixel_um

    def own(height: float, vergence: float):
        return study.kernels(recipe, single, vergence).pupils(height)[0]

    table, errors = pupil_table(own, *nodes), []
    for height, vergence in places:
        x, y = oblique(float(height))
        mixed = Kernels(study.seen(float(vergence)), single, pixel, lambda _: recipe, tables={wave: table})
        errors.append(distance(mixed.at(x, y), study.kernels(recipe, single, float(vergence)).at(x, y)))
    return max(errors)


def _recipe(study: Study, wave: float) -> Recipe:
    """Return the recipe that is converged at both ends of the field, since one rung makes a whole table."""
    study.check()
    far = float(study.scene.vergences(2)[0])
    best = max(study.best(height, far, wave) for height in (study.nearest_mm, study.farthest_mm))
    return Recipe(*RUNGS[best], *SAMPLINGS[1])
