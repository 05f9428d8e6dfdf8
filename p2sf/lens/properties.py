"""Table of the properties of a surface: how each is rotated, scaled and described, and which files and sums support it.

`p2sf.lensfile.toml.surface` adds the TOML entry of each property. A test compares both tables with the fields of
`Surface` and the columns of the table of surfaces, so that a new property cannot be forgotten silently.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite
from typing import Any

from p2sf.lens.placement import Placement
from p2sf.lens.shapes import EvenTerms, Shape
from p2sf.lens.transmission import Transmission
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


def _is_stated(value: Any) -> bool:
    return value is not None


@dataclass(frozen=True)
class Property:
    """Description of one field of `Surface`.

    Parameters
    ----------
    name : str
        The field.
    label : Message
        Its name in messages, such as "its shape".
    column : str
        The column of the table of surfaces that shows it: its own column, or one with additional words.
    scaled : callable
        (value, factor): the value, in mm, of a surface whose lengths are in units of ``factor`` mm.
    turned : callable
        (value, angle): the value of the surface rotated about its vertex, degrees from x towards y.
    endings : callable
        The endings of the lens files that can express a value.
    symmetric : callable
        Whether a lens with a value is still symmetric about its axis.
    aligned : callable
        The value in an aligned lens, without tilts, decentres and parts that are not of revolution.
    acts : callable
        Whether a value curves a plane, or turns or dims rays on one between equal media.
    shades : callable
        What takes more light from some parts of the pupil than from others, as the predicate of a sentence about the
        surface; None where nothing does.
    averaged : callable
        The value that paraxial rays see: its mean over all azimuths, without what shades.
    unseen : callable
        What the six coefficients cannot describe, as the predicate of a sentence about the surface; None where they
        can, or where they describe the aligned lens and a warning says so.
    short, words : callable
        A value in a word or two, and with numbers, if it has no column of its own.
    operand : str
        Zemax's operand for a value that differs between configurations; "" if there is none.
    steps : bool
        Whether it changes in steps instead of being interpolated between the columns of a zoom.
    """

    name: str
    label: Message
    column: str
    scaled: Callable[[Any, float], Any]
    turned: Callable[[Any, float], Any] = _same
    endings: Callable[[Any], Endings] = lambda _: EVERY
    symmetric: Callable[[Any], bool] = lambda _: True
    aligned: Callable[[Any], Any] = lambda value: value
    acts: Callable[[Any], bool] = lambda _: False
    shades: Callable[[Any], Message | None] = _nothing
    averaged: Callable[[Any], Any] = lambda value: value
    unseen: Callable[[Any], Message | None] = _nothing
    short: Callable[[Any], Message | None] = _nothing
    words: Callable[[Any], Message | None] = _nothing
    operand: str = ""
    steps: bool = False


def turned_breaks(placements: tuple[Placement, ...], angle_deg: float) -> tuple[Placement, ...]:
    """Return coordinate breaks in axes rotated about z by an angle, degrees, as everything behind them is."""
    into, back = Placement(tilt_z_deg=angle_deg), Placement(tilt_z_deg=-angle_deg)
    return (into, *placements, back) if placements else ()


def _scaled_breaks(placements: tuple[Placement, ...], factor: float) -> tuple[Placement, ...]:
    return tuple(placement.scaled(factor) for placement in placements)


def breaks_words(placements: tuple[Placement, ...]) -> Message | None:
    """Return coordinate breaks in words, as the sum of their numbers; None where they do nothing."""
    if all(placement.idle for placement in placements):
        return None
    numbers = [(*placement.decentre, *placement.tilt_deg) for placement in placements]
    x, y, z, a, b, c = (sum(column) for column in zip(*numbers, strict=True))
    return Message("axes decentred by ({decentre:g}) mm and tilted by ({tilt:g})°", decentre=(x, y, z), tilt=(a, b, c))


def _symmetric_breaks(placements: tuple[Placement, ...]) -> bool:
    return all(placement.along_axis for placement in placements)


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


def _shading_words(passed: Transmission | None) -> Message | None:
    changes = passed is not None and passed.per_mm2
    return Message("passes a share of light that changes with the height") if changes else None


def _only(*endings: str) -> Callable[[Any], Endings]:
    return lambda _: frozenset((TOML, *endings))


PROPERTIES = (
    Property("radius", Message("its radius"), "radius", _length, acts=isfinite, operand="CRVT"),
    Property("thickness", Message("the thickness behind it"), "thickness", _length, operand="THIC"),
    Property("medium", Message("the medium behind it"), "medium", _same, operand="GLSS", steps=True),
    Property("conic", Message("its conic constant"), "conic", _same, operand="CONN"),
    Property(
        "aspheric",
        Message("its aspheric terms"),
        "aspheric",
        lambda terms, factor: EvenTerms(terms).scaled(factor).coefficients,
        acts=any,
    ),
    Property("semi_diameter", Message("its clear rim"), "semi_diameter", _length, operand="SDIA"),
    Property(
        "shape",
        Message("its shape"),
        "aspheric",
        _multiply,
        _turn,
        endings=lambda shape: shape.endings if shape else EVERY,
        symmetric=lambda shape: shape is None or shape.radial,
        aligned=lambda shape: shape and shape.mean,
        acts=_is_stated,
        averaged=lambda shape: shape and shape.mean,
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
        _turn,
        endings=_only(ZEMAX, CODE_V),
        symmetric=lambda phase: phase is None or phase.radial,
        aligned=lambda phase: phase and phase.mean,
        acts=_is_stated,
        averaged=lambda phase: phase and phase.mean,
        unseen=lambda phase: None if phase is None or phase.radial else Message("is a grating in lines"),
        short=lambda phase: phase and phase.name,
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
            symmetric=_symmetric_breaks,
            aligned=lambda _: (),
            words=breaks_words,
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
        acts=isfinite,
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
        symmetric=lambda rim: rim is None,
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
        symmetric=lambda one: one is None,
        aligned=_nothing,
        acts=_is_stated,
        averaged=_nothing,
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
        acts=_is_stated,
        shades=_shading_words,
        averaged=lambda passed: None if _shading_words(passed) else passed,
        unseen=_shading_words,
        words=lambda passed: passed and passed.words,
        steps=True,
    ),
)
BY_NAME = {each.name: each for each in PROPERTIES}


def words_of(surface: object, column: str) -> tuple[Message, ...]:
    """Return, with numbers, the properties that a column of the table of surfaces describes beside its own."""
    found = (each.words(getattr(surface, each.name)) for each in PROPERTIES if each.column == column)
    return tuple(words for words in found if words)


def short_words_of(surface: object, column: str) -> tuple[Message, ...]:
    """Return the properties that a column names in a word or two beside its numbers."""
    found = (each.short(getattr(surface, each.name)) for each in PROPERTIES if each.column == column)
    return tuple(words for words in found if words)
