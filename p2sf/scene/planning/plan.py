"""The plan: the cheapest model of a lens within a scene's tolerance, each decision with its reason (handbook 10.2)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from math import hypot
from os import PathLike

import numpy as np

from p2sf.arguments import check_arguments
from p2sf.choice import Tries, first_allowed, first_within
from p2sf.lens.lens import Lens
from p2sf.messages import Message
from p2sf.pixel_kernels.channel import Colour, Kernels, Recipe
from p2sf.pixel_kernels.pupil_table import PupilTable
from p2sf.pixel_kernels.sensor_points import SensorMap
from p2sf.raytrace.focusing import object_distance
from p2sf.scene.field_area import Point
from p2sf.scene.files import read_scene
from p2sf.scene.planning.adaptive_table import from_phase
from p2sf.scene.planning.bounds import check_blur, check_colours
from p2sf.scene.planning.cost import Cost, mirrored, naive_work, plan_work, predicted_cost
from p2sf.scene.planning.field_points import scene_maps
from p2sf.scene.planning.nodes import (
    DEPTH_COUNTS,
    FIRST_TRIED,
    NODE_COUNTS,
    between_depth_nodes,
    between_field_nodes,
    depth_places,
    field_counts,
    field_places,
    spans,
    worst_errors,
)
from p2sf.scene.planning.sharing import share_pupils
from p2sf.scene.planning.study import (
    FINE_SAMPLING,
    SAMPLING_ERRORS,
    SAMPLINGS,
    Place,
    Sampling,
    Study,
    distance,
    weighted_sum,
)
from p2sf.scene.scene import NOISE_PART, Channel, Scene
from p2sf.scene.spectrum import reduce_spectrum
from p2sf.threads import one_blas_thread

# The share of the tolerance that each kind of decision may use, see `predicted_error`.
SHARES = {"method": 0.1, "sampling": 0.2, "field": 0.43, "depth": 0.48, "colour": 0.3, "pupils": 0.14}
FIELD_ALONE = 0.5  # the share of the field in a scene of one depth
SHARPER = 1.1  # factor by which kernels between those examined may be sharper
SAFETY = 1.2  # for points between those where an error was measured


@dataclass(frozen=True)
class Decision:
    """A decision: subject, choice, reason as a sentence, and its relative error; ``kind`` is a key of SHARES."""

    what: Message
    choice: Message
    why: Message
    error: float
    kind: str = ""


@dataclass(frozen=True, eq=False)
class Plan:
    """Everything that determines the kernels of a scene.

    ``recipe``: how each kernel is computed; ``colours``: one per channel; ``counts``: kernel nodes along rows and
    columns; ``vergences`` of the depth nodes (1/mm), increasing. ``predicted_error``: that of all decisions together.
    ``naive``: the cost of the full grid (`pricing.naive_work`). ``norm``: the largest root sum of squares of the
    kernels, by which `allowed_error` follows from the tolerance. ``table``: the pupils from which all others are
    interpolated; None if each is fitted.
    """

    lens: Lens
    scene: Scene
    reference_um: float
    recipe: Recipe
    colours: tuple[Colour, ...]
    counts: tuple[int, int]
    vergences: tuple[float, ...]
    decisions: tuple[Decision, ...]
    predicted_error: float
    cost: Cost
    naive: Cost
    table: PupilTable | None = None
    norm: float = 1.0

    def __repr__(self) -> str:
        sensor, allowed = self.scene.sensor, self.allowed_error
        picture = f"{sensor.rows} × {sensor.columns} pixels, {len(self.colours)} channels"
        return (
            f"<Plan {self.lens.name}: {picture}, predicted error {self.predicted_error:.2g} of {allowed:.2g} allowed>"
        )

    @property
    def meets(self) -> bool:
        """Return whether the predicted error stays within the tolerance."""
        return self.predicted_error <= self.allowed_error

    @property
    def allowed_error(self) -> float:
        """Return the tolerance as a relative error of these kernels."""
        return self.scene.relative_error(self.norm)

    @property
    def mirrored(self) -> bool:
        """Return whether the quarters of the picture are mirror images of each other."""
        return mirrored(self.lens, self.scene)

    def kernels(self, channel: int, vergence: float) -> Kernels:
        """Return the kernels of one channel at one depth."""
        seen, colour = self.sensor_map(vergence), self.colours[channel]
        return Kernels(seen, colour, self.scene.sensor.pixel_um, self.recipe, self.table)

    def sensor_map(self, vergence: float) -> SensorMap:
        """Return the map from fields to the sensor at one depth."""
        return _sensor_map(self.lens, self.scene, vergence, self.reference_um)


@lru_cache(maxsize=32)
def _sensor_map(lens: Lens, scene: Scene, vergence: float, wavelength_um: float) -> SensorMap:
    return scene_maps(lens, scene, [vergence], wavelength_um)[0]


@one_blas_thread
@check_arguments
def plan(lens: Lens, scene: Scene | str | PathLike[str], check: Callable[[], None] | None = None) -> Plan:
    """Find the cheapest model of a lens that stays within the tolerance of a scene.

    Each decision takes the first entry of its list, cheapest first, within its share of the tolerance, else the last.

    Parameters
    ----------
    lens : Lens
        The lens, see `load_lens`.
    scene : Scene or path
        Sensor, depths, colours and tolerance, or a TOML file that states them (``p2sf plan --help``).
    check : callable, optional
        Called repeatedly during the work; an exception that it raises stops the work.

    Returns
    -------
    Plan
        The plan, for `form_image`. ``.decisions`` lists the decisions and their reasons, ``.predicted_error`` is the
        relative error, and ``.meets`` states whether it is within the tolerance.

    Raises
    ------
    RequestError
        If the scene is invalid.
    GeometryError, GlassError
        If the lens cannot form the image of the scene.

    Examples
    --------
    >>> import p2sf
    >>> scene = p2sf.Scene(p2sf.Sensor(rows=20, columns=30, pixel_um=60.0), rtol=0.2, f_number=8)
    >>> p2sf.plan(p2sf.load_lens("double_gauss_28"), scene).meets
    True
    """
    scene = scene if isinstance(scene, Scene) else read_scene(scene, object_distance(lens))
    camera = scene.camera(lens)
    check_colours(camera, scene)
    study = Study(camera, scene, check or (lambda: None))
    check_blur(study)
    share_pupils(study)
    norm = _norm(study)
    budget = scene.relative_error(norm)
    recipe, method = _method(study, budget)
    (fineness, margin), sampled = _sampling(study, budget)
    recipe = replace(recipe, fineness=fineness, margin=margin)
    colours, colour = _colours(study, budget)
    counts, field = _field(study, budget, colours)
    vergences, depth = _depths(study, budget, colours)
    decisions = (method, sampled, field, depth, *colour, _pupils(study), *_noise(scene))
    error = predicted_error(decisions)
    cost = predicted_cost(plan_work(study, recipe, colours, counts, len(vergences)))
    naive = predicted_cost(naive_work(study, recipe, counts, len(vergences)))
    return Plan(
        camera,
        scene,
        study.reference_um,
        recipe,
        colours,
        counts,
        vergences,
        decisions,
        error,
        cost,
        naive,
        study.table,
        norm,
    )


def predicted_error(decisions: Sequence[Decision]) -> float:
    """Return the error of all decisions together.

    The largest of each kind are nearly independent, so that their squares add; but for those of field and depth, which
    both defocus, and add up where both are largest.
    """
    largest = {kind: max((d.error for d in decisions if d.kind == kind), default=0.0) for kind in SHARES}
    return hypot(largest.pop("field") + largest.pop("depth"), *largest.values())


def _norm(study: Study) -> float:
    """Return the largest root sum of squares of the kernels, at most 1, if the tolerance depends on it."""
    if study.scene.measure not in ("mtf", "psnr"):
        return 1.0
    kernels = study.kernels([place for wave in study.waves_um for place in study.places(wave)])
    return min(1.0, SHARPER * max(float(np.linalg.norm(kernel)) for kernel in kernels))


def _first(
    sizes: Sequence[float], measure: Callable[[Tries], Sequence[float]], places: int, allowed: float, start: int = 0
) -> tuple[int, float]:
    """Return `first_allowed` with SAFETY."""
    number, error = first_allowed(sizes, measure, places, allowed / SAFETY, start)
    return number, SAFETY * error


def _method(study: Study, budget: float) -> tuple[Recipe, Decision]:
    """Return the fewest fitted numbers that describe a pupil; those of the table, if there is one, at no further cost.

    Six Seidel coefficients would make neither a kernel nor a table cheaper, only less accurate.
    """
    if study.table:
        like = study.table.like
        numbers, error = like.numbers, SAFETY * from_phase(float(like.residual_waves.max()))
    else:
        levels = study.levels[: study.levels.index(study.level) + 1]
        errors = ((level.numbers, SAFETY * from_phase(study.residual(level))) for level in levels)
        numbers, error = first_within(errors, SHARES["method"] * budget)
    why = Message("the phase that {numbers} numbers leave over is that small", numbers=numbers)
    choice = Message("{method}, {count} numbers", method="fitted", count=numbers)
    return Recipe("fitted", numbers), Decision(Message("method"), choice, why, error, "method")


def _colours(study: Study, budget: float) -> tuple[tuple[Colour, ...], list[Decision]]:
    """Return the wavelengths of every channel, and the decisions."""
    colours, decisions = [], []
    for channel in study.scene.channels:
        axis, _, corner = study.sharpest(float(channel.wavelengths_um @ channel.shares))
        places = [(study.area.far, v) for v in dict.fromkeys((corner, *study.ends))]
        places += [(study.area.near, v) for v in dict.fromkeys((axis, study.scan[-1]))]
        every, number, error = len(channel.wavelengths_nm), 0, 0.0
        if every > 1:
            measure = partial(_colour_errors, study, channel, places)
            number, error = _first(range(1, every + 1), measure, len(places), SHARES["colour"] * budget)
        colours.append(reduce_spectrum(channel, number + 1))
        choice = Message("{waves:.0f} nm", waves=tuple(1000 * w for w in colours[-1].wavelengths_um))
        why = Message(
            "{count} of {all} wavelengths keep the channel's lateral and axial colour", count=number + 1, all=every
        )
        what = Message("colour {channel}", channel=channel.label)
        decisions.append(Decision(what, choice, why, error, "colour"))
    return tuple(colours), decisions


def _colour_errors(study: Study, channel: Channel, places: Sequence[tuple[Point, float]], tries: Tries) -> list[float]:
    """Return the errors of fewer wavelengths, one more than each try's number, against all, at (point, vergence)."""
    every = reduce_spectrum(channel, len(channel.wavelengths_nm))
    pairs = [(reduce_spectrum(channel, number + 1), partial(study.place, *places[k])) for number, k in tries]
    asked = [place(wave) for few, place in pairs for colour in (few, every) for wave in colour.wavelengths_um]
    kernels = dict(zip(asked, study.kernels(asked, FINE_SAMPLING), strict=True))  # a coarser one would hide the change

    def mixed(colour: Colour, place: Callable[[float], Place]) -> np.ndarray:
        return weighted_sum([kernels[place(wave)] for wave in colour.wavelengths_um], colour.weights)

    return [distance(mixed(few, place), mixed(every, place)) for few, place in pairs]


def _sampling(study: Study, budget: float) -> tuple[Sampling, Decision]:
    """Return the coarsest entry of SAMPLINGS within its share of the tolerance, else the finest, and the decision.

    Errors of sampling hardly depend on the pupil, so that none are measured here.
    """
    chosen, error = first_within(zip(SAMPLINGS, SAMPLING_ERRORS, strict=True), SHARES["sampling"] * budget)
    fineness, margin = chosen
    why = Message(
        "pixels of {pixel:g} µm average finer fringes; the window has a margin of {margin:.0%}",
        pixel=study.scene.sensor.pixel_um,
        margin=margin,
    )
    choice = Message("λ/2NA/{fineness:g}", fineness=fineness)
    return chosen, Decision(Message("sampling"), choice, why, error, "sampling")


def _field(study: Study, budget: float, colours: Sequence[Colour]) -> tuple[tuple[int, int], Decision]:
    places = field_places(study, colours)

    def errors(tries: Tries) -> list[float]:
        return worst_errors(study, [between_field_nodes(study, n, places[k]) for n, k in tries])

    share = SHARES["field"] if len(study.ends) > 1 else FIELD_ALONE
    number, error = _first(spans(NODE_COUNTS), errors, len(places), share * budget, FIRST_TRIED)
    counts = field_counts(study, number)
    why = Message("kernels in the middle of a cell are then the mean of its corners")
    choice = Message("{rows} × {columns} nodes", rows=counts[0], columns=counts[1])
    return counts, Decision(Message("field"), choice, why, error, "field")


def _depths(study: Study, budget: float, colours: Sequence[Colour]) -> tuple[tuple[float, ...], Decision]:
    scene, places = study.scene, depth_places(study, colours)
    if scene.near_mm == scene.far_mm:
        vergence = float(scene.vergences(1)[0])
        why = Message("the scene has one depth")
        return (vergence,), Decision(Message("depth"), Message("1 node"), why, 0.0, "depth")

    def errors(tries: Tries) -> list[float]:
        return worst_errors(study, [between_depth_nodes(study, n, places[k]) for n, k in tries])

    number, error = _first(spans(DEPTH_COUNTS), errors, len(places), SHARES["depth"] * budget, FIRST_TRIED)
    parts = scene.depth_parts(DEPTH_COUNTS[number])
    nodes = np.concatenate(parts)
    why = _why_depths(parts)
    choice = Message("{count} nodes", count=len(nodes)) if len(nodes) > 1 else Message("1 node")
    return tuple(nodes.tolist()), Decision(Message("depth"), choice, why, error, "depth")


def _why_depths(parts: Sequence[np.ndarray]) -> Message:
    if len(parts) == 1:
        return Message("defocus grows with 1/distance, so nodes stand at equal steps of it")
    if all(len(part) == 1 for part in parts):
        return Message("the scene has these depths alone")
    return Message("nodes stand at equal steps of 1/distance, and none in {count} gaps", count=len(parts) - 1)


def _noise(scene: Scene) -> list[Decision]:
    """Return the decision to allow the error that the sensor's noise hides, if that is more than was asked for."""
    if not scene.noise_decides:
        return []
    why = Message(
        "a picture of light up to {light:g} has noise of {noise:.2g} there; errors up to {part:.0%} of the noise "
        "are hidden by it, and larger than what was asked for",
        light=scene.brightest,
        noise=float(scene.sensor.noise(scene.brightest)),
        part=NOISE_PART,
    )
    return [Decision(Message("noise"), Message("{error:.2g} allowed", error=scene.noise_floor), why, 0.0, "noise")]


def _pupils(study: Study) -> Decision:
    """Return the decision on how many pupils are fitted."""
    what = Message("pupils")
    if study.table is None:
        return Decision(
            what, Message("all"), Message("interpolation between a few of them does not give the others"), 0.0, "pupils"
        )
    x, y, depths, waves = map(len, study.table.axes)
    why = Message(
        "places × depths × wavelengths: {places} × {depths} × {waves}; all others lie on polynomials through them",
        places=x * y,
        depths=depths,
        waves=waves,
    )
    return Decision(what, Message("{count} fits", count=study.table.fits), why, study.table_error, "pupils")
