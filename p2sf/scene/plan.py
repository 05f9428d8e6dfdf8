"""The plan: the least model of a lens that keeps a scene's error, each decision with its reason."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import ceil, hypot

import numpy as np

from p2sf.kernels import Colour, Kernels, Recipe, View, view
from p2sf.kernels.pixels import samples_across
from p2sf.kernels.pupilmap import dropped_terms, pupil_map
from p2sf.lens import Lens
from p2sf.scene.cost import Cost, Work, predicted_cost
from p2sf.scene.nodes import depth_error, field_counts, field_error
from p2sf.scene.scene import Scene, depth_of
from p2sf.scene.spectrum import reduced
from p2sf.scene.study import DEPTH_COUNTS, NODE_COUNTS, RUNGS, SAMPLINGS, Study, from_phase

# What part of the tolerance each decision may use. The errors have nothing in common, so their squares add.
SHARES = {"rung": 0.5, "terms": 0.1, "sampling": 0.25, "field": 0.5, "depth": 0.55, "colour": 0.35}
SAFETY = 1.3  # between the places where an error was measured


@dataclass(frozen=True)
class Decision:
    """What was decided, the choice, why in a sentence, and the relative error it costs."""

    what: str
    choice: str
    why: str
    error: float


@dataclass(frozen=True, eq=False)
class Plan:
    """Everything that kernels of a scene are made of.

    ``rings``: (outer rim in mm, recipe) from the axis outwards; ``colours`` one per channel; ``counts`` kernel nodes
    along rows and columns; ``vergences`` of the depth nodes (1/mm), increasing. ``predicted_error`` is the root of
    the sum of the decisions' squared errors. ``naive`` is what the full grid would cost.
    """

    lens: Lens
    scene: Scene
    reference_um: float
    rings: tuple[tuple[float, Recipe], ...]
    colours: tuple[Colour, ...]
    counts: tuple[int, int]
    vergences: tuple[float, ...]
    decisions: tuple[Decision, ...]
    predicted_error: float
    cost: Cost
    naive: Cost

    @property
    def meets(self) -> bool:
        """Return whether the predicted error stays within the tolerance."""
        return self.predicted_error <= self.scene.relative_tolerance

    def recipe_at(self, height_mm: float) -> Recipe:
        """Return the recipe of the ring that holds this height."""
        return next((recipe for rim, recipe in self.rings if height_mm <= rim), self.rings[-1][1])

    def kernels(self, channel: int, vergence: float) -> Kernels:
        """Return the kernels of one channel at one depth."""
        seen = self.view(vergence)
        return Kernels(seen, self.colours[channel], self.scene.sensor.pixel_um, self.recipe_at)

    def view(self, vergence: float) -> View:
        """Return where the points of one depth land."""
        return _view(self.lens, depth_of(vergence), self.reference_um, self.scene.sensor.corners_mm()[1])


@lru_cache(maxsize=32)
def _view(lens: Lens, depth_mm: float, wavelength_um: float, height_mm: float) -> View:
    return view(lens, depth_mm, wavelength_um, height_mm)


def plan(lens: Lens, scene: Scene, check: Callable[[], None] | None = None) -> Plan:
    """Return the cheapest plan whose measured errors stay within the scene's tolerance.

    Each decision takes the first entry of its list, cheapest first, that keeps its share; where none does, the
    last, and `Plan.meets` is False. ``check`` is called now and then and may raise, to stop. Raises P2SFError where
    the lens cannot form the scene's image.
    """
    camera = scene.camera(lens)
    study = Study(camera, scene, check or (lambda: None))
    budget = scene.relative_tolerance
    rings, rung = _rings(study, budget)
    colours, colour = _colours(study, budget)
    sampling, sampled = _sampling(study, budget)
    counts, field = _field(study, budget)
    vergences, depth = _depths(study, budget)
    terms, drop = _terms(study, budget)
    rings = tuple((rim, Recipe(*RUNGS[n], *SAMPLINGS[sampling], drop)) for rim, n in rings)
    decisions = (*rung, terms, sampled, field, depth, *colour)
    error = hypot(*(max((d.error for d in decisions if d.what.startswith(what)), default=0.0) for what in SHARES))
    work, full = _work(study, rings, colours, counts, len(vergences))
    return Plan(
        *(camera, scene, study.reference_um, rings, colours, counts, vergences, decisions, error),
        *map(predicted_cost, (work, full)),
    )


def _first(errors, allowed: float) -> tuple[int, float]:
    """Return the first index whose error, found when asked for, is allowed, else the last; and the error."""
    tried = []
    for error in errors:
        tried.append(SAFETY * error)
        if tried[-1] <= allowed:
            break
    return len(tried) - 1, tried[-1]


def _rings(study: Study, budget: float):
    """Return (rim, rung) of every ring, and the decisions."""
    heights, found, decisions = study.heights(), [], []
    for inner, outer in pairwise(heights):
        places = study.places((inner, outer))
        errors = (max(study.rung_error(n, *place) for place in places) for n in range(len(RUNGS)))
        number, error = _first(errors, SHARES["rung"] * budget)
        found.append((float(outer), number))
        method, numbers = RUNGS[number]
        why = (
            "the six Seidel coefficients keep the pixels' error here"
            if method == "seidel"
            else (f"{numbers} fitted numbers are the fewest that keep it; the next cheaper rung does not")
        )
        decisions.append(Decision(f"rung {inner:.3g}–{outer:.3g} mm", method, why, error))
    return found, decisions


def _terms(study: Study, budget: float) -> tuple[Decision, float]:
    """Return the decision on phase terms too weak to be seen, and their bound in waves."""
    drop = float(SHARES["terms"] * budget / from_phase(1.0))
    height, wave = study.farthest_mm, study.reference_um
    vergence = study.depths(wave)[0]
    pupil = pupil_map(study.lens, study.seen(vergence).source(height, wave), *RUNGS[study.best(height, vergence, wave)])
    gone = dropped_terms(pupil, drop)
    kept = int(np.count_nonzero(pupil.phase)) - len(gone)
    strongest = f", the strongest (n={gone[-1][0]}, m={gone[-1][1]}) has {gone[-1][2]:.1e} waves" if gone else ""
    why = f"at the corner {len(gone)} phase terms stay below {drop:.1e} waves RMS together{strongest}"
    return Decision("terms", f"{kept} kept", why, from_phase(drop) if gone else 0.0), drop


def _colours(study: Study, budget: float):
    """Return the wavelengths of every channel, and the decisions."""
    colours, decisions = [], []
    for channel in study.scene.channels:
        depths = study.depths(study.reference_um)
        places = [(h, v) for h in (study.nearest_mm, study.farthest_mm) for v in depths]
        counts = range(1, len(channel.wavelengths_nm) + 1)
        errors = (max(study.colour_error(channel, n, *p) for p in places) for n in counts)
        number, error = _first(errors, SHARES["colour"] * budget)
        colours.append(reduced(channel, number + 1))
        waves = ", ".join(f"{1000 * w:.0f}" for w in colours[-1].wavelengths_um)
        why = f"{number + 1} of {len(counts)} wavelengths keep the channel's lateral and axial colour"
        decisions.append(Decision(f"colour {channel.name}", f"{waves} nm", why, error))
    return tuple(colours), decisions


def _sampling(study: Study, budget: float) -> tuple[int, Decision]:
    heights = study.nearest_mm, (study.nearest_mm + study.farthest_mm) / 2, study.farthest_mm
    places = study.places(heights)
    errors = (max(study.sampling_error(n, *p) for p in places) for n in range(len(SAMPLINGS)))
    number, error = _first(errors, SHARES["sampling"] * budget)
    fineness, margin = SAMPLINGS[number]
    why = f"pixels of {study.scene.sensor.pixel_um:g} µm average finer fringes; the window has a margin of {margin:.0%}"
    return number, Decision("sampling", f"λ/2NA/{fineness:g}", why, error)


def _field(study: Study, budget: float):
    number, error = _first((field_error(study, n) for n in range(len(NODE_COUNTS))), SHARES["field"] * budget)
    counts = field_counts(study, number)
    why = "kernels in the middle of a cell are then the mean of its corners"
    return counts, Decision("field", f"{counts[0]} × {counts[1]} nodes", why, error)


def _depths(study: Study, budget: float):
    scene = study.scene
    if scene.near_mm == scene.far_mm:
        vergence = float(scene.vergences(1)[0])
        return (vergence,), Decision("depth", "1 node", "the scene has one depth", 0.0)
    number, error = _first((depth_error(study, n) for n in range(len(DEPTH_COUNTS))), SHARES["depth"] * budget)
    nodes = scene.vergences(DEPTH_COUNTS[number])
    why = "defocus grows with 1/distance, so nodes stand at equal steps of it"
    plural = "s" if len(nodes) > 1 else ""
    return tuple(nodes.tolist()), Decision("depth", f"{len(nodes)} node{plural}", why, error)


def _work(study: Study, rings, colours, counts, layers: int) -> tuple[Work, Work]:
    """Return the plan's work, and the full grid's: every node, wavelength and fringe, the dearest rung all over."""
    sensor = study.scene.sensor
    dearest = max((recipe for _, recipe in rings), key=lambda r: r.numbers or 0)
    nodes = counts[0] * counts[1]
    once = ceil(counts[0] / 2) * ceil(counts[1] / 2) if sensor.centred else nodes
    halves, sides = _widths(study, rings)
    mean, largest = (float(np.sqrt(np.mean(np.square(sides[0])))), float(sides[1].max()))
    numbers = float(np.mean([recipe.numbers or 6 for _, recipe in rings]))
    seidel = all(recipe.method == "seidel" for _, recipe in rings)
    shared = (int(halves.max()), sensor.rows, sensor.columns, len(colours), counts, layers)
    kernels = once * layers * sum(len(c.wavelengths_um) for c in colours)
    every = nodes * layers * sum(len(c.wavelengths_nm) for c in study.scene.channels)
    return (
        Work(kernels, mean, "seidel" if seidel else "fitted", int(numbers), *shared),
        Work(every, largest, dearest.method, dearest.numbers or 6, *shared),
    )


def _widths(study: Study, rings):
    """Return half widths at the rings' rims over all depths, and transform sides: of the plan, and of every fringe."""
    pixel, halves, own, full = study.scene.sensor.pixel_um, [], [], []
    for vergence in study.depths(study.reference_um):
        for rim, recipe in rings:
            kernels = study.kernels(recipe, study.single, vergence)
            half, (pupil, _) = kernels.half_width(rim), kernels.pupils(rim)[0]
            halves.append(half)
            own.append((2 * half * (1 + recipe.margin) + 1) * samples_across(pupil, pixel, recipe.fineness))
            full.append((2 * half * 1.5 + 1) * samples_across(pupil, pixel, 2.0))
    return np.array(halves), (np.array(own), np.array(full))
