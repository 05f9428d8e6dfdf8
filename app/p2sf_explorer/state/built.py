"""The perturbed lens: tilted and decentred pieces, errors of surfaces, thicknesses and indices. Uses no Qt."""

from dataclasses import dataclass, replace
from functools import lru_cache

from p2sf.errors import GeometryError
from p2sf.glass.media import AIR
from p2sf.lens.lens import Lens
from p2sf.messages import Message
from p2sf.paraxial.bending import elements
from p2sf.tolerance.errors_of_build import IRREGULAR, MOVES, Kind, Tolerance, affects_light, build
from p2sf_explorer.state.build_errors import BuildErrors

STEEPEST_DEG = 60.0  # to which an exaggerated drawing tilts


@lru_cache(maxsize=64)
def with_errors(lens: Lens, errors: BuildErrors) -> Lens:
    """Return the lens with manufacturing errors; GeometryError, naming the surface, for an impossible one.

    Errors at surfaces that the lens does not have are ignored: the state may refer to an earlier lens in the same file.
    The rings of a built lens cannot be turned any more: its errors belong to their present position.
    """
    count = len(lens.surfaces)
    found = [one for one in errors if one[2] <= count or one[1] == one[2] == count + 1]
    tolerances = [Tolerance(kind, first, 0.0, last) for kind, first, last, _ in found]
    _check_thicknesses(lens, {first: amount for kind, first, _, amount in found if kind == "thickness"})
    made = build(lens, tolerances, [amount for *_, amount in found])
    return made if made.positions is None else replace(made, positions=None)


def _check_thicknesses(lens: Lens, errors: dict[int, float]) -> None:
    """Raise GeometryError for an error that would put a surface before the one in front of it."""
    for number, by in errors.items():
        thickness = lens.surfaces[number - 1].thickness
        if thickness * (thickness + by) < 0:
            raise GeometryError(
                "surface {surface}: a thickness of {thickness:g} mm that is off by {by:g} mm changes its sign; "
                "give a smaller error",
                surface=number,
                thickness=thickness,
                by=by,
            )


def exaggerate(errors: BuildErrors, factor: int) -> tuple[BuildErrors, int]:
    """Return tilts and decentres enlarged by a factor, reduced if it would tilt too far, and that factor.

    Other errors are unchanged.
    """
    steepest = max((abs(amount) for kind, *_, amount in errors if kind.startswith("tilt")), default=0.0)
    used = max(1, min(factor, int(STEEPEST_DEG / steepest))) if steepest else factor
    larger = tuple((kind, a, b, amount * (used if kind in MOVES else 1)) for kind, a, b, amount in errors)
    return larger, used


@dataclass(frozen=True)
class Piece:
    """A piece that moves as one: its first and last surface, from 1, and its name."""

    span: tuple[int, int]
    name: Message


@lru_cache(maxsize=16)
def pieces(lens: Lens) -> tuple[Piece, ...]:
    """Return the pieces that may move as one: elements, groups before and behind the stop, the whole lens, the sensor.

    Cemented elements are one; a mirror, and a surface that bounds no element in air, is a piece by itself.
    """
    single = _elements(lens)
    found = [Piece(span, _element_name(number, span)) for number, span in enumerate(single, 1)]
    stop = lens.stop_surface or 0
    groups = ([s for s in single if s[1] < stop], [s for s in single if s[0] > stop])
    names = Message("front group"), Message("rear group")
    for group, name in zip(groups, names, strict=True):
        if len(group) > 1 and stop:
            found.append(Piece((group[0][0], group[-1][1]), Message("{name}, {span}", name=name, span=_span(group))))
    count = len(lens.surfaces)
    if len(single) > 1:
        found.append(Piece((1, count), Message("whole lens")))
    return (*found, Piece((count + 1, count + 1), Message("sensor")))


def _elements(lens: Lens) -> tuple[tuple[int, int], ...]:
    """Return the elements, and of the other surfaces those that refract or reflect by themselves."""
    spans = list(elements(lens))
    inside = {number for first, last in spans for number in range(first, last + 1)}
    for number in range(1, len(lens.surfaces) + 1):
        if affects_light(lens, number) and number not in inside:
            spans.append((number, number))
    return tuple(sorted(spans))


def _element_name(number: int, span: tuple[int, int]) -> Message:
    if span[0] == span[1]:
        return Message("surface {surface}", surface=span[0])
    return Message("element {number}, surfaces {first} to {last}", number=number, first=span[0], last=span[1])


def _span(group: list[tuple[int, int]]) -> Message:
    return Message("surfaces {first} to {last}", first=group[0][0], last=group[-1][1])


@dataclass(frozen=True)
class Adjustment:
    """One possible error of a piece: its kind, its surfaces, and the range of its slider."""

    kind: Kind
    span: tuple[int, int]
    reach: float

    @property
    def key(self) -> tuple[str, int, int]:
        """Return its unique key."""
        return self.kind, *self.span


REACH: dict[Kind, float] = {
    **dict.fromkeys(("decentre_x", "decentre_y"), 0.5),
    **dict.fromkeys(("tilt_x", "tilt_y"), 1.0),
    "radius": 2.0,
    "thickness": 0.5,
    "index": 0.005,
    **dict.fromkeys(IRREGULAR, 5.0),
}
"""To which the sliders go, in the units of the kinds: some times what a careless workshop leaves."""
SENSOR_REACH_DEG = 10.0  # a sensor is tilted on purpose, too


@lru_cache(maxsize=64)
def adjustments(lens: Lens, span: tuple[int, int]) -> tuple[Adjustment, ...]:
    """Return the possible errors of a piece: its position as a whole, then radii, thicknesses, glasses and surfaces."""
    count = len(lens.surfaces)
    if span[0] > count:
        return tuple(Adjustment(kind, span, SENSOR_REACH_DEG) for kind in ("tilt_x", "tilt_y"))
    found = [Adjustment(kind, span, REACH[kind]) for kind in MOVES]
    for number in range(span[0], span[1] + 1):
        surface, one = lens.surfaces[number - 1], (number, number)
        if surface.curvature:
            found.append(Adjustment("radius", one, REACH["radius"]))
        if number < count:
            found.append(Adjustment("thickness", one, REACH["thickness"]))
        if not surface.reflects and surface.medium != AIR and number < count:
            found.append(Adjustment("index", one, REACH["index"]))
        if affects_light(lens, number) and not surface.ideal:
            found += [Adjustment(kind, one, REACH[kind]) for kind in IRREGULAR]
    return tuple(found)
