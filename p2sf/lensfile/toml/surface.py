"""How a lens file in TOML states every property of a surface: an entry for each of `p2sf.lens.properties`."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from math import inf, isfinite
from typing import TYPE_CHECKING, Any

from p2sf.errors import LensFileError
from p2sf.glass.media import (
    AIR,
    CatalogueGlass,
    ConstantIndex,
    Medium,
    Mirror,
    ModelGlass,
    ShiftedIndex,
    TabulatedIndex,
)
from p2sf.lens.irregularity import Irregularity
from p2sf.lens.lens import Surface, scale_surface
from p2sf.lens.shapes import ODD, Diffraction, Shape
from p2sf.lens.transmission import Transmission
from p2sf.lensfile.source_text import digits
from p2sf.lensfile.toml.placement import placements_text, read_placements, read_rim, rim_text
from p2sf.lensfile.toml.table import Constraint, Table, list_text, text_of
from p2sf.messages import Message

if TYPE_CHECKING:
    from p2sf.glass.transmittance import InternalTransmittance
    from p2sf.lens.grating import Phase

RADIUS = Constraint(lambda x: x == x and x != 0, Message("write a number that is not 0, inf for a plane"))
THICKNESS = Constraint(isfinite, Message("write the distance to the next surface as a number"))
RIM = Constraint(lambda x: x > 0, Message("write a positive number"))
INNER = Constraint(lambda x: 0 <= x < inf, Message("write a number from 0"))
FINITE = Constraint(isfinite, Message("write a finite number"))
SHARE = Constraint(lambda x: 0 <= x <= 1, Message("write a share from 0 to 1"))
OPENING = Constraint(lambda x: 0 < x < inf, Message("write a positive number"))


@dataclass(frozen=True)
class Entry:
    """How one property is stated: its field and key, the text of a value, and the value, in units of the file.

    ``default`` is the text of a value that is left out.
    """

    name: str
    key: str
    text: Callable[[Any], str]
    read: Callable[[Table], Any]
    default: str = ""


def _number(key: str, rule: Constraint, default: float | None = None, name: str = "") -> Entry:
    text = "" if default is None else digits(default)
    return Entry(name or key, key, digits, lambda table: table.number(key, rule, default), text)


def _read_radius(table: Table) -> float:
    return table.number("radius", RADIUS, inf if table.number("ideal_focal_length", RADIUS, inf) != inf else None)


def medium_text(medium: Medium) -> str:
    """Return a medium as `Table.medium` reads it; LensFileError for one that no file can hold."""
    from p2sf.lensfile.agf import FormulaGlass

    if medium == AIR:
        return '"air"'
    if isinstance(medium, ConstantIndex):
        return digits(medium.value)
    if isinstance(medium, CatalogueGlass | Mirror):
        return text_of(medium.label)
    if isinstance(medium, ModelGlass):
        return f"{{ nd = {digits(medium.nd)}, vd = {digits(medium.vd)} }}"
    if isinstance(medium, TabulatedIndex):
        label = "" if medium.label == "table" else f", label = {text_of(medium.label)}"
        return f"{{ wavelengths_um = {list_text(medium.wavelengths_um)}, n = {list_text(medium.values)}{label} }}"
    if isinstance(medium, ShiftedIndex):
        return f"{{ glass = {medium_text(medium.medium)}, shift = {digits(medium.shift)} }}"
    if isinstance(medium, FormulaGlass):
        numbers = f"coefficients = {list_text(medium.coefficients)}, range_um = {list_text(medium.range_um)}"
        passed = "" if medium.transmittance is None else f", {_transmittance_text(medium.transmittance)}"
        return f"{{ agf_formula = {medium.formula}, {numbers}, name = {text_of(medium.name)}{passed} }}"
    raise LensFileError(
        "medium {name} cannot be written to a file; give an index, a glass name or nd and vd", name=medium.label
    )


def _transmittance_text(passed: "InternalTransmittance") -> str:
    return f"internal_transmittance = [{', '.join(map(list_text, passed.records))}]"


def _shape_text(shape: Shape | None) -> str:
    from p2sf.lens.shape_types import SHAPES

    if shape is None:
        return ""
    if keys := SHAPES[shape.kind].keys:
        stated = ((key, getattr(shape, key)) for key in keys)
        numbers = (f"{key} = {list_text(x) if isinstance(x, tuple) else digits(x)}" for key, x in stated if x)
        return f'{{ type = "{shape.kind}", {", ".join(numbers)} }}'
    radius = "" if shape.kind == ODD else f"normalisation_radius = {digits(shape.normalisation_mm)}, "
    return f'{{ type = "{shape.kind}", {radius}coefficients = {list_text(shape.stated)} }}'


def _read_shape(surface: Table) -> Shape | None:
    table = surface.inline("shape")
    if table is None:
        return None
    from p2sf.lens.shape_types import SHAPES  # which lenses of spheres do without

    kind = table.string("type")
    if kind not in SHAPES:
        table.fail('type "{kind}" of a shape is unknown; write one of {kinds}', kind=kind, kinds=tuple(SHAPES))
    keys = SHAPES[kind].keys
    table.check_keys(("type", *(keys or ("normalisation_radius", "coefficients"))))
    if keys:
        return SHAPES[kind].of(**{key: _named_number(table, key) for key in keys if key in table.values})
    if kind == ODD and "normalisation_radius" in table.values:
        table.fail('an odd asphere has no normalisation radius; write type = "extended odd asphere"')
    made = SHAPES[kind]
    numbers = _terms(table, made.most)
    return made.of(numbers, 1.0 if kind == ODD else table.number("normalisation_radius", OPENING))


def _named_number(table: Table, key: str) -> float | tuple[float, ...]:
    """Return a radius, which may be infinite, another number, or the list of coefficients of a shape."""
    if key == "coefficients":
        return _terms(table)
    return table.number(key, RADIUS if key.startswith("radius") else FINITE)


def _diffraction_text(diffraction: "Phase | None") -> str:
    from p2sf.lens.grating import Grating

    if diffraction is None:
        return ""
    order = digits(diffraction.order)
    if isinstance(diffraction, Grating):
        turned = f", turn_deg = {digits(diffraction.turn_deg)}" if diffraction.turn_deg else ""
        return f"{{ order = {order}, lines_per_length = {digits(diffraction.lines_per_mm)}{turned} }}"
    radius = digits(diffraction.normalisation_mm)
    numbers = list_text(diffraction.coefficients)
    return f"{{ order = {order}, normalisation_radius = {radius}, coefficients = {numbers} }}"


def _read_diffraction(surface: Table) -> "Phase | None":
    from p2sf.lens.grating import Grating

    table = surface.inline("diffraction")
    if table is None:
        return None
    if "lines_per_length" in table.values:
        table.check_keys(("order", "lines_per_length", "turn_deg"))
        order, turn = (table.number(key, FINITE, usual) for key, usual in (("order", 1.0), ("turn_deg", 0.0)))
        return Grating(table.number("lines_per_length", FINITE), order, turn)
    table.check_keys(("order", "normalisation_radius", "coefficients"))
    radius = table.number("normalisation_radius", OPENING)
    return Diffraction(_terms(table), radius, table.number("order", FINITE, 1.0))


def _irregularity_text(one: Irregularity | None) -> str:
    if one is None:
        return ""
    first, second, radius = map(digits, (one.fringes, one.fringes_45, one.normalisation_mm))
    return f"{{ fringes = {first}, fringes_45 = {second}, normalisation_radius = {radius} }}"


def _read_irregularity(surface: Table) -> Irregularity | None:
    table = surface.inline("irregularity")
    if table is None:
        return None
    table.check_keys(("fringes", "fringes_45", "normalisation_radius"))
    upright, turned = (table.number(key, FINITE, 0.0) for key in ("fringes", "fringes_45"))
    found = Irregularity(upright, turned, table.number("normalisation_radius", OPENING))
    return None if found.idle else found


def _transmission_text(passed: Transmission | None) -> str:
    return f"{{ vertex = {digits(passed.vertex)}, per_area = {digits(passed.per_mm2)} }}" if passed else ""


def _read_transmission(surface: Table) -> Transmission | None:
    table = surface.inline("transmission")
    if table is None:
        return None
    table.check_keys(("vertex", "per_area"))
    return Transmission(table.number("vertex", SHARE, 1.0), table.number("per_area", FINITE, 0.0))


def _terms(table: Table, most: int = 60) -> tuple[float, ...]:
    """Return the coefficients of a shape or a phase, at least one."""
    numbers = table.numbers("coefficients", FINITE, ())
    if not 1 <= len(numbers) <= most:
        table.fail("coefficients are {count} numbers; write 1 to {most}", count=len(numbers), most=most)
    return numbers


ENTRIES = (
    Entry("radius", "radius", digits, _read_radius),
    _number("thickness", THICKNESS),
    Entry("medium", "glass", medium_text, lambda table: table.medium("glass"), '"air"'),
    _number("semi_diameter", RIM, inf),
    _number("inner_radius", INNER, 0.0),
    Entry("rim", "rim", lambda rim: rim_text(rim) if rim else "", lambda table: read_rim(table, 1.0)),
    _number("conic", FINITE, 0.0),
    _number("ideal_focal_length", RADIUS, inf),
    Entry("aspheric", "aspheric", lambda terms: list_text(terms), lambda t: t.numbers("aspheric", FINITE, ()), "[]"),
    Entry("shape", "shape", _shape_text, _read_shape),
    Entry("diffraction", "diffraction", _diffraction_text, _read_diffraction),
    Entry("irregularity", "irregularity", _irregularity_text, _read_irregularity),
    Entry("transmission", "transmission", _transmission_text, _read_transmission),
    Entry("before", "before", placements_text, lambda table: read_placements(table, "before", 1.0), "[]"),
    Entry("after", "after", placements_text, lambda table: read_placements(table, "after", 1.0), "[]"),
)


def surface_lines(surface: Surface) -> Iterator[tuple[str, str, str]]:
    """Yield key, text and the text that is left out for every property of a surface."""
    for entry in ENTRIES:
        yield entry.key, entry.text(getattr(surface, entry.name)), entry.default


def read_surface(table: Table, scale: float, elsewhere: Iterable[str]) -> Surface:
    """Return a surface in mm, ``elsewhere`` the keys of the top of the file; LensFileError."""
    table.check_keys((entry.key for entry in ENTRIES), elsewhere)
    return scale_surface(Surface(**{entry.name: entry.read(table) for entry in ENTRIES}), scale)
