"""The plan: the least model of a lens that keeps a scene's error, each decision with its reason (handbook 10.2)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import pairwise
from math import hypot
from typing import Any

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.messages import Message
from p2sf.pixel_kernels import Colour, Kernels, Recipe, SensorMap, sensor_map
from p2sf.pixel_kernels.channel import own_pupil
from p2sf.pixel_kernels.frequency_grid import FrequencyPupil, dropped_terms
from p2sf.pixel_kernels.pupil_table import PupilTable, few_nodes, pupil_table
from p2sf.scene.bounds import check_blur, check_colours
from p2sf.scene.cost import Cost, predicted_cost
from p2sf.scene.nodes import depth_error, depth_places, field_counts, field_error, field_places
from p2sf.scene.pricing import MethodZones, costliest_method, method_seconds, naive_work, plan_work, single_seconds
from p2sf.scene.scene import Channel, Scene, depth_of
from p2sf.scene.sharing import few_depths, few_heights, node_heights, share_pupils
from p2sf.scene.spectrum import reduced
from p2sf.scene.study import DEPTH_COUNTS, NODE_COUNTS, SAMPLINGS, Study, first_allowed, from_phase
from p2sf.threads import one_blas_thread

# The share of the tolerance that each kind of decision may use. The errors are independent, so their squares add.
SHARES = {"method": 0.5, "terms": 0.1, "sampling": 0.25, "field": 0.5, "depth": 0.54, "colour": 0.35, "pupils": 0.1}
SAFETY = 1.3  # for places between those where an error was measured

PupilNodes = tuple[tuple[float, ...], tuple[float, ...]]


@dataclass(frozen=True)
class Decision:
    """What was decided, the choice, why in a sentence, and the relative error it costs; ``kind`` is a key of SHARES."""

    what: Message
    choice: Message
    why: Message
    error: float
    kind: str = ""


@dataclass(frozen=True, eq=False)
class Plan:
    """Everything that kernels of a scene are made of.

    ``zones`` of the field, from the axis outwards: (outer edge in mm, recipe); ``colours``: one per channel;
    ``counts``: kernel nodes along rows and columns; ``vergences`` of the depth nodes (1/mm), increasing.
    ``predicted_error``: the root of the sum of squared errors, of the decisions and of the pupils that planning itself
    interpolated. ``naive``: what the full grid would cost (`pricing.naive_work`).
    ``pupil_nodes``: heights in mm and vergences of the pupils that all others are interpolated from; None where
    each is fitted.
    """

    lens: Lens
    scene: Scene
    reference_um: float
    zones: tuple[tuple[float, Recipe], ...]
    colours: tuple[Colour, ...]
    counts: tuple[int, int]
    vergences: tuple[float, ...]
    decisions: tuple[Decision, ...]
    predicted_error: float
    cost: Cost
    naive: Cost
    pupil_nodes: PupilNodes | None = None

    def __repr__(self) -> str:
        sensor, allowed = self.scene.sensor, self.scene.relative_tolerance
        picture = f"{sensor.rows} × {sensor.columns} pixels, {len(self.colours)} channels"
        return (
            f"<Plan {self.lens.name}: {picture}, predicted error {self.predicted_error:.2g} of {allowed:.2g} allowed>"
        )

    @property
    def meets(self) -> bool:
        """Return whether the predicted error stays within the tolerance."""
        return self.predicted_error <= self.scene.relative_tolerance

    def recipe_at(self, height_mm: float) -> Recipe:
        """Return the recipe of the zone that holds this height."""
        return next((recipe for edge, recipe in self.zones if height_mm <= edge), self.zones[-1][1])

    def kernels(self, channel: int, vergence: float) -> Kernels:
        """Return the kernels of one channel at one depth."""
        seen, colour = self.sensor_map(vergence), self.colours[channel]
        tables: dict[float, PupilTable] = {}
        if self.pupil_nodes:
            tables = {wave: pupils_between(self, wave) for wave in colour.wavelengths_um}
        return Kernels(seen, colour, self.scene.sensor.pixel_um, self.recipe_at, tables=tables)

    def sensor_map(self, vergence: float) -> SensorMap:
        """Return where the points of one depth land."""
        corner = self.scene.sensor.corners_mm()[1]
        return _sensor_map(self.lens, depth_of(vergence), self.reference_um, corner, self.scene.clip)


@lru_cache(maxsize=32)
def pupils_between(planned: Plan, wavelength_um: float) -> PupilTable:
    """Return the table of one wavelength's pupils of a plan that has ``pupil_nodes``, computed once."""
    heights, vergences = planned.pupil_nodes or ((), ())

    def own(height: float, vergence: float) -> tuple[FrequencyPupil, float]:
        return own_pupil(planned.sensor_map(vergence), height, wavelength_um, planned.recipe_at(height))

    return pupil_table(own, heights, vergences)


@lru_cache(maxsize=32)
def _sensor_map(lens: Lens, depth_mm: float, wavelength_um: float, height_mm: float, clip: bool) -> SensorMap:
    return sensor_map(lens, depth_mm, wavelength_um, height_mm, clip)


@one_blas_thread
def plan(lens: Lens, scene: Scene, check: Callable[[], None] | None = None) -> Plan:
    """Return the cheapest plan whose measured errors stay within the scene's tolerance.

    Each decision takes the first entry of its list, cheapest first, that keeps its share; where none does, the
    last, and `Plan.meets` is False. ``check`` is called now and then and may raise, to stop. Raises P2SFError where
    the lens cannot form the scene's image.
    """
    camera = scene.camera(lens)
    check_colours(camera, scene)
    study = Study(camera, scene, check or (lambda: None))
    check_blur(study)
    share_pupils(study)
    budget = scene.relative_tolerance
    methods, method = _zones(study, budget)
    colours, colour = _colours(study, budget)
    sampling, sampled = _sampling(study, budget)
    counts, field = _field(study, budget)
    vergences, depth = _depths(study, budget)
    terms, drop = _terms(study, budget)
    waves = sum(len(one.wavelengths_um) for one in colours)
    nodes, seconds, pupils = _pupils(study, budget, methods, counts, vergences, waves)
    if nodes:  # pupils that are interpolated together share one method
        methods = [(edge, costliest_method(methods)) for edge, _ in methods]
    zones = tuple((edge, Recipe(*study.methods[n], *SAMPLINGS[sampling], drop)) for edge, n in methods)
    decisions = (*method, terms, sampled, field, depth, *colour, pupils)
    errors = (max((d.error for d in decisions if d.kind == kind), default=0.0) for kind in SHARES)
    error = hypot(*errors, study.tables_error)
    cost = predicted_cost(plan_work(study, zones, colours, counts, len(vergences), seconds))
    naive = predicted_cost(naive_work(study, zones, counts, len(vergences)))
    return Plan(
        camera, scene, study.reference_um, zones, colours, counts, vergences, decisions, error, cost, naive, nodes
    )


def _first(
    choices: Sequence[Any], measure: Callable[..., float], places: Sequence[tuple], allowed: float
) -> tuple[int, float]:
    """Return `first_allowed` of these choices with SAFETY."""
    number, error = first_allowed(len(choices), measure, places, allowed / SAFETY)
    return number, SAFETY * error


def _zones(study: Study, budget: float) -> tuple[MethodZones, list[Decision]]:
    """Return (outer edge, method) of every zone, and the decisions."""
    heights, found, decisions = study.heights(), [], []
    for inner, outer in pairwise(heights):
        number, error = _first(
            study.methods, study.method_error, study.places((outer, inner)), SHARES["method"] * budget
        )
        found.append((float(outer), number))
        method, numbers = study.methods[number]
        why = (
            Message("the six Seidel coefficients keep the pixels' error here")
            if method == "seidel"
            else Message(
                "{numbers} fitted numbers are the fewest that keep it; the next cheaper method does not",
                numbers=numbers,
            )
        )
        what = Message("method {inner:.3g}–{outer:.3g} mm", inner=inner, outer=outer)
        decisions.append(Decision(what, Message("{method}", method=method), why, error, "method"))
    return found, decisions


def _terms(study: Study, budget: float) -> tuple[Decision, float]:
    """Return the decision on phase terms too weak to be seen, and their bound in waves."""
    drop = float(SHARES["terms"] * budget / from_phase(1.0))
    kernels = study.kernels(study.recipe(), study.single, study.depths(study.reference_um)[0])
    pupil, _ = kernels.pupils(study.farthest_mm)[0]
    gone = dropped_terms(pupil, drop)
    kept = int(np.count_nonzero(pupil.phase)) - len(gone)
    if gone:
        n, m, strongest = gone[-1]
        why = Message(
            "at the corner {count} phase terms stay below {waves:.1e} waves RMS together, "
            "the strongest (n={n}, m={m}) has {most:.1e} waves",
            count=len(gone),
            waves=drop,
            n=n,
            m=m,
            most=strongest,
        )
    else:
        why = Message(
            "at the corner {count} phase terms stay below {waves:.1e} waves RMS together", count=0, waves=drop
        )
    error = from_phase(drop) if gone else 0.0
    return Decision(Message("terms"), Message("{count} kept", count=kept), why, error, "terms"), drop


def _colours(study: Study, budget: float) -> tuple[tuple[Colour, ...], list[Decision]]:
    """Return the wavelengths of every channel, and the decisions."""
    colours, decisions = [], []
    for channel in study.scene.channels:
        depths = study.depths(study.reference_um)
        places = [(h, v) for h in (study.farthest_mm, study.nearest_mm) for v in depths]
        counts = range(1, len(channel.wavelengths_nm) + 1)
        measure = partial(_colour_error, study, channel)
        number, error = _first(counts, measure, places, SHARES["colour"] * budget)
        colours.append(reduced(channel, number + 1))
        choice = Message("{waves:.0f} nm", waves=tuple(1000 * w for w in colours[-1].wavelengths_um))
        why = Message(
            "{count} of {all} wavelengths keep the channel's lateral and axial colour",
            count=number + 1,
            all=len(counts),
        )
        what = Message("colour {channel}", channel=channel.label)
        decisions.append(Decision(what, choice, why, error, "colour"))
    return tuple(colours), decisions


def _colour_error(study: Study, channel: Channel, number: int, height: float, vergence: float) -> float:
    return study.colour_error(channel, number + 1, height, vergence)


def _sampling(study: Study, budget: float) -> tuple[int, Decision]:
    heights = study.nearest_mm, (study.nearest_mm + study.farthest_mm) / 2, study.farthest_mm
    places = study.places(heights)
    number, error = _first(SAMPLINGS, study.sampling_error, places, SHARES["sampling"] * budget)
    fineness, margin = SAMPLINGS[number]
    why = Message(
        "pixels of {pixel:g} µm average finer fringes; the window has a margin of {margin:.0%}",
        pixel=study.scene.sensor.pixel_um,
        margin=margin,
    )
    choice = Message("λ/2NA/{fineness:g}", fineness=fineness)
    return number, Decision(Message("sampling"), choice, why, error, "sampling")


def _field(study: Study, budget: float) -> tuple[tuple[int, int], Decision]:
    measure = partial(field_error, study)
    number, error = _first(NODE_COUNTS, measure, field_places(study), SHARES["field"] * budget)
    counts = field_counts(study, number)
    why = Message("kernels in the middle of a cell are then the mean of its corners")
    choice = Message("{rows} × {columns} nodes", rows=counts[0], columns=counts[1])
    return counts, Decision(Message("field"), choice, why, error, "field")


def _depths(study: Study, budget: float) -> tuple[tuple[float, ...], Decision]:
    scene = study.scene
    if scene.near_mm == scene.far_mm:
        vergence = float(scene.vergences(1)[0])
        why = Message("the scene has one depth")
        return (vergence,), Decision(Message("depth"), Message("1 node"), why, 0.0, "depth")
    measure = partial(depth_error, study)
    number, error = _first(DEPTH_COUNTS, measure, depth_places(study), SHARES["depth"] * budget)
    nodes = scene.vergences(DEPTH_COUNTS[number])
    why = Message("defocus grows with 1/distance, so nodes stand at equal steps of it")
    choice = Message("{count} nodes", count=len(nodes)) if len(nodes) > 1 else Message("1 node")
    return tuple(nodes.tolist()), Decision(Message("depth"), choice, why, error, "depth")


def _pupils(
    study: Study,
    budget: float,
    methods: MethodZones,
    counts: tuple[int, int],
    vergences: tuple[float, ...],
    waves: int,
) -> tuple[PupilNodes | None, float, Decision]:
    """Return the nodes of the pupils that are fitted, None for all of them; their seconds; and the decision."""
    alone = single_seconds(study, methods, counts, len(vergences), waves)
    heights, allowed = node_heights(study.scene.sensor, counts), SHARES["pupils"] * budget / SAFETY
    height_count, height_error = few_heights(study, len(heights), allowed / 2)
    depth_count, depth_error = few_depths(study, len(vergences), allowed / 2)
    shared, every = height_count * depth_count * waves, len(heights) * len(vergences) * waves
    seconds = shared * method_seconds(study, costliest_method(methods))
    what = Message("pupils")
    if seconds >= alone:
        why = Message("fewer fits, all of the costliest method, with the others interpolated would cost no less")
        return None, alone, Decision(what, Message("{count} fits", count=every), why, 0.0, "pupils")
    nodes = tuple(few_nodes(heights, height_count).tolist()), tuple(few_nodes(vergences, depth_count).tolist())
    why = Message(
        "heights × depths in each wavelength: {heights} × {depths}; "
        "the others of {count} lie on polynomials through them",
        heights=height_count,
        depths=depth_count,
        count=every,
    )
    error = SAFETY * (height_error + depth_error)
    return nodes, seconds, Decision(what, Message("{count} fits", count=shared), why, error, "pupils")
