"""The plan: the least model of a lens that keeps a scene's error, each decision with its reason."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import pairwise
from math import hypot

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.pixel_kernels import Colour, Kernels, Recipe, SensorMap, sensor_map
from p2sf.pixel_kernels.channel import own_pupil
from p2sf.pixel_kernels.frequency_grid import dropped_terms
from p2sf.pixel_kernels.pupil_table import PupilTable, few_nodes, pupil_table
from p2sf.scene.bounds import refuse_colours, refuse_wide
from p2sf.scene.cost import Cost, predicted_cost
from p2sf.scene.nodes import depth_error, depth_places, field_counts, field_error, field_places
from p2sf.scene.pricing import dearest_method, method_seconds, naive_work, plan_work, single_seconds
from p2sf.scene.scene import Scene, depth_of
from p2sf.scene.sharing import few_depths, few_heights, node_heights, share_pupils
from p2sf.scene.spectrum import reduced
from p2sf.scene.study import DEPTH_COUNTS, NODE_COUNTS, RUNGS, SAMPLINGS, Study, from_phase, least

# What part of the tolerance each decision may use. The errors have nothing in common, so their squares add.
SHARES = {"method": 0.5, "terms": 0.1, "sampling": 0.25, "field": 0.5, "depth": 0.54, "colour": 0.35, "pupils": 0.1}
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
    the sum of squared errors, of the decisions and of the pupils that planning itself interpolated. ``naive`` is what
    the full grid would cost (`pricing.naive_work`).
    ``pupil_nodes``: heights in mm and vergences of the pupils that all others are interpolated from; None where
    each is fitted.
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
    pupil_nodes: tuple[tuple[float, ...], tuple[float, ...]] | None = None

    @property
    def meets(self) -> bool:
        """Return whether the predicted error stays within the tolerance."""
        return self.predicted_error <= self.scene.relative_tolerance

    def recipe_at(self, height_mm: float) -> Recipe:
        """Return the recipe of the ring that holds this height."""
        return next((recipe for rim, recipe in self.rings if height_mm <= rim), self.rings[-1][1])

    def kernels(self, channel: int, vergence: float) -> Kernels:
        """Return the kernels of one channel at one depth."""
        seen, colour, tables = self.sensor_map(vergence), self.colours[channel], {}
        if self.pupil_nodes:
            tables = {wave: pupils_between(self, wave) for wave in colour.wavelengths_um}
        return Kernels(seen, colour, self.scene.sensor.pixel_um, self.recipe_at, tables=tables)

    def sensor_map(self, vergence: float) -> SensorMap:
        """Return where the points of one depth land."""
        return _view(self.lens, depth_of(vergence), self.reference_um, self.scene.sensor.corners_mm()[1])


@lru_cache(maxsize=32)
def pupils_between(planned: Plan, wavelength_um: float) -> PupilTable:
    """Return the plan's pupils of one wavelength, made once."""
    heights, vergences = planned.pupil_nodes

    def own(height: float, vergence: float):
        return own_pupil(planned.sensor_map(vergence), height, wavelength_um, planned.recipe_at(height))

    return pupil_table(own, heights, vergences)


@lru_cache(maxsize=32)
def _view(lens: Lens, depth_mm: float, wavelength_um: float, height_mm: float) -> SensorMap:
    return sensor_map(lens, depth_mm, wavelength_um, height_mm)


def plan(lens: Lens, scene: Scene, check: Callable[[], None] | None = None) -> Plan:
    """Return the cheapest plan whose measured errors stay within the scene's tolerance.

    Each decision takes the first entry of its list, cheapest first, that keeps its share; where none does, the
    last, and `Plan.meets` is False. ``check`` is called now and then and may raise, to stop. Raises P2SFError where
    the lens cannot form the scene's image.
    """
    camera = scene.camera(lens)
    refuse_colours(camera, scene)
    study = Study(camera, scene, check or (lambda: None))
    refuse_wide(study)
    share_pupils(study)
    budget = scene.relative_tolerance
    rings, method = _rings(study, budget)
    colours, colour = _colours(study, budget)
    sampling, sampled = _sampling(study, budget)
    counts, field = _field(study, budget)
    vergences, depth = _depths(study, budget)
    terms, drop = _terms(study, budget)
    waves = sum(len(one.wavelengths_um) for one in colours)
    nodes, seconds, pupils = _pupils(study, budget, (rings, counts, vergences, waves))
    rings = tuple((rim, Recipe(*RUNGS[n], *SAMPLINGS[sampling], drop)) for rim, n in _shared(rings, nodes))
    decisions = (*method, terms, sampled, field, depth, *colour, pupils)
    errors = (max((d.error for d in decisions if d.what.startswith(what)), default=0.0) for what in SHARES)
    error = hypot(*errors, study.tables_error)
    work = plan_work(study, rings, colours, counts, len(vergences), seconds)
    costs = map(predicted_cost, (work, naive_work(study, rings, counts, len(vergences))))
    parts = scene, study.reference_um, rings, colours, counts, vergences, decisions, error
    return Plan(camera, *parts, *costs, nodes)


def _first(choices, measure, places, allowed: float) -> tuple[int, float]:
    """Return `least` of these choices with SAFETY."""
    number, error = least(len(choices), measure, places, allowed / SAFETY)
    return number, SAFETY * error


def _rings(study: Study, budget: float):
    """Return (rim, method) of every ring, and the decisions."""
    heights, found, decisions = study.heights(), [], []
    for inner, outer in pairwise(heights):
        number, error = _first(RUNGS, study.method_error, study.places((outer, inner)), SHARES["method"] * budget)
        found.append((float(outer), number))
        method, numbers = RUNGS[number]
        why = (
            "the six Seidel coefficients keep the pixels' error here"
            if method == "seidel"
            else (f"{numbers} fitted numbers are the fewest that keep it; the next cheaper method does not")
        )
        decisions.append(Decision(f"method {inner:.3g}–{outer:.3g} mm", method, why, error))
    return found, decisions


def _terms(study: Study, budget: float) -> tuple[Decision, float]:
    """Return the decision on phase terms too weak to be seen, and their bound in waves."""
    drop = float(SHARES["terms"] * budget / from_phase(1.0))
    kernels = study.kernels(study.recipe(), study.single, study.depths(study.reference_um)[0])
    pupil, _ = kernels.pupils(study.farthest_mm)[0]
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
        places = [(h, v) for h in (study.farthest_mm, study.nearest_mm) for v in depths]
        counts = range(1, len(channel.wavelengths_nm) + 1)
        measure = partial(_colour_error, study, channel)
        number, error = _first(counts, measure, places, SHARES["colour"] * budget)
        colours.append(reduced(channel, number + 1))
        waves = ", ".join(f"{1000 * w:.0f}" for w in colours[-1].wavelengths_um)
        why = f"{number + 1} of {len(counts)} wavelengths keep the channel's lateral and axial colour"
        decisions.append(Decision(f"colour {channel.name}", f"{waves} nm", why, error))
    return tuple(colours), decisions


def _colour_error(study: Study, channel, number: int, height: float, vergence: float) -> float:
    return study.colour_error(channel, number + 1, height, vergence)


def _sampling(study: Study, budget: float) -> tuple[int, Decision]:
    heights = study.nearest_mm, (study.nearest_mm + study.farthest_mm) / 2, study.farthest_mm
    places = study.places(heights)
    number, error = _first(SAMPLINGS, study.sampling_error, places, SHARES["sampling"] * budget)
    fineness, margin = SAMPLINGS[number]
    why = f"pixels of {study.scene.sensor.pixel_um:g} µm average finer fringes; the window has a margin of {margin:.0%}"
    return number, Decision("sampling", f"λ/2NA/{fineness:g}", why, error)


def _field(study: Study, budget: float):
    measure = partial(field_error, study)
    number, error = _first(NODE_COUNTS, measure, field_places(study), SHARES["field"] * budget)
    counts = field_counts(study, number)
    why = "kernels in the middle of a cell are then the mean of its corners"
    return counts, Decision("field", f"{counts[0]} × {counts[1]} nodes", why, error)


def _depths(study: Study, budget: float):
    scene = study.scene
    if scene.near_mm == scene.far_mm:
        vergence = float(scene.vergences(1)[0])
        return (vergence,), Decision("depth", "1 node", "the scene has one depth", 0.0)
    measure = partial(depth_error, study)
    number, error = _first(DEPTH_COUNTS, measure, depth_places(study), SHARES["depth"] * budget)
    nodes = scene.vergences(DEPTH_COUNTS[number])
    why = "defocus grows with 1/distance, so nodes stand at equal steps of it"
    plural = "s" if len(nodes) > 1 else ""
    return tuple(nodes.tolist()), Decision("depth", f"{len(nodes)} node{plural}", why, error)


def _pupils(study: Study, budget: float, asked):
    """Return the pupils that are fitted, None for all of them; their seconds; and the decision."""
    rings, counts, vergences, waves = asked
    alone = single_seconds(study, rings, counts, len(vergences), waves)
    heights, allowed = node_heights(study.scene.sensor, counts), SHARES["pupils"] * budget / SAFETY
    (high, across), (deep, along) = (
        few_heights(study, len(heights), allowed / 2),
        few_depths(study, len(vergences), allowed / 2),
    )
    shared, every = high * deep * waves, len(heights) * len(vergences) * waves
    seconds = shared * method_seconds(dearest_method(rings))
    if seconds >= alone:
        why = "fewer of the dearest method with the others in between would cost no less"
        return None, alone, Decision("pupils", f"{every} fits", why, 0.0)
    nodes = tuple(few_nodes(heights, high).tolist()), tuple(few_nodes(vergences, deep).tolist())
    why = f"heights × depths in each wavelength: {high} × {deep}; the others of {every} lie on polynomials through them"
    return nodes, seconds, Decision("pupils", f"{shared} fits", why, SAFETY * (across + along))


def _shared(rings, nodes):
    """Return (rim, method) of every ring: one method for all where their pupils are interpolated together."""
    return [(rim, dearest_method(rings)) for rim, _ in rings] if nodes else rings
