"""How much a plan computes, and how much the full grid without a plan would."""

from collections.abc import Sequence
from math import ceil

import numpy as np

from p2sf.pixel_kernels import Colour, Recipe
from p2sf.pixel_kernels.pixels import samples_across
from p2sf.scene.cost import Work, pupil_seconds
from p2sf.scene.sharing import node_heights
from p2sf.scene.study import Study

NAIVE_FINENESS, NAIVE_MARGIN = 2.0, 0.5  # every fringe of the light (λ/4NA), and half a window against aliasing

MethodZones = Sequence[tuple[float, int]]
"""Zones of the field from the axis outwards: (outer edge in mm, index into `Study.methods`)."""
RecipeZones = Sequence[tuple[float, Recipe]]
"""The same with the recipe of the zone's kernels."""


def costliest_method(zones: MethodZones) -> int:
    """Return the costliest method of any zone: the cheapest that holds at the worst place."""
    return max(method for _, method in zones)


def method_seconds(study: Study, method: int) -> float:
    """Return what one pupil of an entry of `Study.methods` costs, seconds."""
    name, numbers = study.methods[method]
    return pupil_seconds(name, numbers or 6)


def single_seconds(study: Study, zones: MethodZones, counts: tuple[int, int], layers: int, waves: int) -> float:
    """Return the seconds of fitting each height of each layer by its own zone's method."""
    edges = np.array([edge for edge, _ in zones])
    heights = node_heights(study.scene.sensor, counts)
    which = np.minimum(np.searchsorted(edges, heights), len(edges) - 1)
    return layers * waves * float(sum(method_seconds(study, zones[n][1]) for n in which))


def plan_work(
    study: Study,
    zones: RecipeZones,
    colours: Sequence[Colour],
    counts: tuple[int, int],
    layers: int,
    pupil_cost: float,
) -> Work:
    """Return the plan's work."""
    sensor = study.scene.sensor
    nodes = ceil(counts[0] / 2) * ceil(counts[1] / 2) if sensor.centred else counts[0] * counts[1]
    halves, sides = _widths(study, zones)
    kernels = nodes * layers * sum(len(colour.wavelengths_um) for colour in colours)
    side = float(np.sqrt(np.mean(np.square(sides))))
    return Work(kernels, side, pupil_cost, int(halves.max()), *_picture(study, len(colours), counts, layers))


def naive_work(study: Study, zones: RecipeZones, counts: tuple[int, int], layers: int) -> Work:
    """Return the work of the full grid, which without a plan would have to be computed for the same error.

    One method everywhere, the cheapest that holds at the worst place, its own rays for every PSF; depth × rows ×
    columns × every wavelength, everywhere as dense as the worst place needs; every fringe; one window, that of the
    widest blur; no use of symmetry.
    """
    scene, recipe = study.scene, naive_recipe(zones)
    halves, sides = _widths(study, [(edge, recipe) for edge, _ in zones])
    kernels = counts[0] * counts[1] * layers * sum(len(channel.wavelengths_nm) for channel in scene.channels)
    cost = kernels * pupil_seconds(recipe.method, recipe.numbers or 6)
    picture = _picture(study, len(scene.channels), counts, layers)
    return Work(kernels, float(sides.max()), cost, int(halves.max()), *picture)


def naive_recipe(zones: RecipeZones) -> Recipe:
    """Return the recipe of the full grid: the costliest method of any zone, all phase terms, every fringe."""
    costliest = max((recipe for _, recipe in zones), key=lambda recipe: recipe.numbers or 0)
    return Recipe(costliest.method, costliest.numbers, NAIVE_FINENESS, NAIVE_MARGIN)


def _picture(
    study: Study, channels: int, counts: tuple[int, int], layers: int
) -> tuple[int, int, int, tuple[int, int], int]:
    sensor = study.scene.sensor
    return sensor.rows, sensor.columns, channels, counts, layers


def _widths(study: Study, zones: RecipeZones) -> tuple[np.ndarray, np.ndarray]:
    """Return half widths (pixels) and transform sides (samples) at the zones' outer edges over all depths."""
    pixel, halves, sides = study.scene.sensor.pixel_um, [], []
    for vergence in study.depths(study.reference_um):
        kernels = study.kernels(study.recipe(), study.single, vergence)
        for edge, recipe in zones:
            half, (pupil, _) = kernels.half_width(edge), kernels.pupils(edge)[0]
            halves.append(half)
            sides.append((2 * (half + ceil(half * recipe.margin)) + 1) * samples_across(pupil, pixel, recipe.fineness))
    return np.array(halves), np.array(sides)
