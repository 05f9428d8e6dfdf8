"""One table of what a surface has: how each property turns, scales and reads, and which files and sums know it.

`p2sf.lensfile.toml.surface` adds to each how a lens file in TOML states it. A test compares both with the fields of
`Surface` and with the columns of the table of surfaces, so that nothing of a new property is forgotten in silence.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite
from typing import Any

from p2sf.lens.placement import Placement
from p2sf.lens.shapes import EvenTerms, Shape
from p2sf.messages import Message

TOML, ZEMAX, CODE_V, ISET = ".toml", ".zmx", ".seq", ".json"
EVERY = frozenset((TOML, ZEMAX, CODE_V, ISET))
Endings = frozenset[str]


def _same(value: Any, number: float) -> Any:
    return value


def _length(value: float, factor: float) -> float:
    return value * factor


def _multiply(value: Any, factor: float) -> Any:
    return value.scaled(factor) if value is not None else None


def _turn(value: Any, angle_deg: float) -> Any:
    return value.turned(angle_deg) if value is not None else None


def _nothing(value: Any) -> None:
    return None


@dataclass(frozen=True)
class Property:
    """What holds for one field of `Surface`.

    Parameters
    ----------
    name : str
        The field.
    label : Message
        What messages call it, as in "its shape".
    column : str
        The column of the table of surfaces that shows it: that of the field itself, or one with words beside it.
    scaled : callable
        (value, factor): the value of a surface with lengths in units ``factor`` mm long, in mm.
    turned : callable
        (value, angle): that of the surface turned about its vertex, degrees from x towards y.
    endings : callable
        The endings of the lens files that have a line for a value.
    aligned : callable
        The value in a lens without tilts, decentres and anything that is not of revolution.
    unseen : callable
        What six coefficients do not describe, as the predicate of a sentence about the surface; None where they do, or
        where they are those of the aligned lens, as a warning says.
    short, words : callable
        A value in a word or two, and with numbers, where its column does not show it itself.
    operand : str
        What Zemax calls it where it differs between configurations; "" where it cannot.
    steps : bool
        Whether it is not interpolated between the columns of a zoom.
    """

    name: str
    label: Message
    column: str
    scaled: Callable[[Any, float], Any]
    turned: Callable[[Any, float], Any] = _same
    endings: Callable[[Any], Endings] = lambda _: EVERY
    aligned: Callable[[Any], Any] = lambda value: value
    unseen: Callable[[Any], Message | None] = _nothing
    short: Callable[[Any], Message | None] = _nothing
    words: Callable[[Any], Message | None] = _nothing
    operand: str = ""
    steps: bool = False


def turned_breaks(placements: tuple[Placement, ...], angle_deg: float) -> tuple[Placement, ...]:
    """Return breaks of coordinates that stand in axes turned about z by an angle, degrees, as all that follows does."""
    into, back = Placement(tilt_z_deg=angle_deg), Placement(tilt_z_deg=-angle_deg)
    return (into, *placements, back) if placements else ()


def _scaled_breaks(placements: tuple[Placement, ...], factor: float) -> tuple[Placement, ...]:
    return tuple(placement.scaled(factor) for placement in placements)


def _breaks_words(placements: tuple[Placement, ...]) -> Message | None:
    if all(placement.idle for placement in placements):
        return None
    numbers = [(*placement.decentre, *placement.tilt_deg) for placement in placements]
    x, y, z, a, b, c = (sum(column) for column in zip(*numbers, strict=True))
    return Message("axes decentred by ({decentre:g}) mm and tilted by ({tilt:g})°", decentre=(x, y, z), tilt=(a, b, c))


def _unseen_shape(shape: Shape | None) -> Message | None:
    if shape is None:
        return None
    if not shape.radial:
        return Message("has a shape that is not of revolution ({kind})", kind=shape.name)
    first, _, third, _ = shape.series(0.0)
    if first or third:
        return Message("has a term in {term}", term="r" if first else "r³")
    return None


def _ideal_words(focal: float) -> Message | None:
    return Message("ideal lens: focal length {focal:g} mm", focal=focal) if isfinite(focal) else None


def _hole_words(radius: float) -> Message | None:
    return Message("rays within a radius of {radius:g} mm are lost", radius=radius) if radius else None


def _only(*endings: str) -> Callable[[Any], Endings]:
    return lambda _: frozenset((TOML, *endings))


PROPERTIES = (
    Property("radius", Message("its radius"), "radius", _length, operand="CRVT"),
    Property("thickness", Message("the thickness behind it"), "thickness", _length, operand="THIC"),
    Property("medium", Message("the medium behind it"), "medium", _same, operand="GLSS", steps=True),
    Property("conic", Message("its conic constant"), "conic", _same, operand="CONN"),
    Property(
        "aspheric",
        Message("its aspheric terms"),
        "aspheric",
        lambda terms, factor: EvenTerms(terms).scaled(factor).coefficients,
    ),
    Property("semi_diameter", Message("its clear rim"), "semi_diameter", _length, operand="SDIA"),
    Property(
        "shape",
        Message("its shape"),
        "aspheric",
        _multiply,
        _turn,
        endings=lambda shape: shape.endings if shape else EVERY,
        aligned=lambda shape: shape and shape.mean,
        unseen=_unseen_shape,
        short=lambda shape: shape and shape.name,
        words=lambda shape: shape and shape.words,
        steps=True,
    ),
    Property(
        "diffraction",
        Message("its diffraction"),
        "aspheric",
        _multiply,
        endings=_only(ZEMAX, CODE_V),
        short=lambda phase: phase and Message("diffractive"),
        words=lambda phase: phase and phase.words,
        steps=True,
    ),
    *(
        Property(
            name,
            Message("its tilt or decentre"),
            "thickness",
            _scaled_breaks,
            turned_breaks,
            endings=_only(ZEMAX, CODE_V),
            aligned=lambda _: (),
            words=_breaks_words,
            steps=True,
        )
        for name in ("before", "after")
    ),
    Property(
        "inner_radius",
        Message("its hole or obscuration"),
        "semi_diameter",
        _length,
        endings=_only(ZEMAX, CODE_V),
        words=_hole_words,
    ),
    Property(
        "ideal_focal_length",
        Message("its ideal focal length"),
        "aspheric",
        _length,
        endings=_only(ZEMAX),
        short=lambda focal: Message("ideal lens") if isfinite(focal) else None,
        words=_ideal_words,
    ),
    Property(
        "rim",
        Message("its clear rim"),
        "semi_diameter",
        _multiply,
        _turn,
        endings=_only(ZEMAX, CODE_V),
        words=lambda rim: rim and rim.words,
        steps=True,
    ),
    Property(
        "irregularity",
        Message("its irregularity"),
        "aspheric",
        _multiply,
        _turn,
        endings=_only(),
        aligned=_nothing,
        short=lambda one: one and Message("irregular"),
        words=lambda one: one and one.words,
        steps=True,
    ),
    Property(
        "transmission",
        Message("its transmission"),
        "medium",
        _multiply,
        endings=_only(),
        unseen=lambda passed: (
            Message("passes a share of light that changes with the height") if passed and passed.per_mm2 else None
        ),
        words=lambda passed: passed and passed.words,
        steps=True,
    ),
)
BY_NAME = {each.name: each for each in PROPERTIES}


def words_of(surface: object, column: str) -> tuple[Message, ...]:
    """Return in numbers what a column of the table of surfaces does not show itself."""
    found = (each.words(getattr(surface, each.name)) for each in PROPERTIES if each.column == column)
    return tuple(words for words in found if words)


def short_words_of(surface: object, column: str) -> tuple[Message, ...]:
    """Return what a column names in a word or two beside its numbers."""
    found = (each.short(getattr(surface, each.name)) for each in PROPERTIES if each.column == column)
    return tuple(words for words in found if words)
