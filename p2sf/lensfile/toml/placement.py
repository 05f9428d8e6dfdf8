"""Tilts and decentres in a lens file in TOML: ``before``, ``after`` and ``rim`` of a surface, [[misaligned]] pieces."""

from collections.abc import Iterable
from dataclasses import replace
from math import isfinite

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.rim import Rim
from p2sf.lensfile.source_text import digits
from p2sf.lensfile.toml.table import Constraint, Table, shorten
from p2sf.messages import Message

PLACEMENT = ("decentre", "tilt_deg", "tilt_first", "pivot")
PIECE = ("surfaces", *PLACEMENT)
FINITE = Constraint(isfinite, Message("write a finite number"))
WIDTH = Constraint(lambda x: x > 0, Message("write a positive number"))
ANGLE = Constraint(isfinite, Message("write an angle in degrees"))
NOWHERE = (0.0, 0.0, 0.0)


def read_placements(table: Table, key: str, scale: float) -> tuple[Placement, ...]:
    """Return the breaks under a key, a list of inline tables; LensFileError with the line of what cannot be."""
    rows = table.values.get(key, [])
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        table.fail(
            "{name} is {found}; write a list of tables, each with decentre or tilt_deg",
            key,
            name=key,
            found=shorten(rows),
        )
    return tuple(_placement(replace(table, values=row, within=key), scale, PLACEMENT) for row in rows)


def apply_misalignments(top: Table, lens: Lens, scale: float) -> Lens:
    """Return the lens with the pieces of its [[misaligned]] tables moved, the later ones on top of the earlier."""
    rows = top.values.get("misaligned", [])
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        top.fail("misaligned is not a list of tables; head every piece with [[misaligned]]", "misaligned")
    for row in rows:
        table = Table(top.path, top.text, row, "misaligned")
        placement = _placement(table, scale, PIECE)
        numbers = table.numbers("surfaces", FINITE, ())
        if not 1 <= len(numbers) <= 2 or not all(number == int(number) for number in numbers):
            table.fail(
                "surfaces is {found}; write the first and the last, as in [3, 4]",
                "surfaces",
                found=shorten(list(numbers)),
            )
        try:
            lens = displaced(lens, int(numbers[0]), int(numbers[-1]), placement)
        except GeometryError as error:
            table.fail(error.message, "surfaces")
    return lens


def _placement(table: Table, scale: float, known: tuple[str, ...]) -> Placement:
    table.check_keys(known)
    x, y, z = (scale * value for value in _three(table, "decentre", FINITE))
    across, up, along = (scale * value for value in _three(table, "pivot", FINITE))
    return Placement(x, y, z, *_three(table, "tilt_deg", ANGLE), table.flag("tilt_first"), (across, up, along))


def _three(table: Table, key: str, rule: Constraint) -> tuple[float, float, float]:
    """Return x, y and z under a key; z may be left out."""
    numbers = table.numbers(key, rule, NOWHERE)
    if len(numbers) not in (2, 3):
        table.fail("{name} are {count} numbers; write x, y and z", key, name=key, count=len(numbers))
    x, y, z = (*numbers, 0.0)[:3]
    return x, y, z


def placements_text(placements: Iterable[Placement]) -> str:
    """Return breaks as `read_placements` reads them, in mm."""
    return f"[{', '.join(map(_text, placements))}]"


def _text(placement: Placement) -> str:
    parts = [
        f"{key} = [{', '.join(map(digits, numbers))}]"
        for key, numbers in (
            ("decentre", placement.decentre),
            ("tilt_deg", placement.tilt_deg),
            ("pivot", placement.pivot),
        )
        if any(numbers)
    ]
    parts += ["tilt_first = true"] * placement.tilt_first
    return f"{{ {', '.join(parts)} }}" if parts else "{ }"


def read_rim(surface: Table, scale: float) -> Rim | None:
    """Return the rim of a surface that is decentred or a rectangle; LensFileError for what cannot be."""
    table = surface.inline("rim")
    if table is None:
        return None
    table.check_keys(("decentre", "half_widths", "turn_deg"))
    pairs = {key: table.numbers(key, rule, ()) for key, rule in (("decentre", FINITE), ("half_widths", WIDTH))}
    for key, numbers in pairs.items():
        if key in table.values and len(numbers) != 2:
            table.fail("{name} are {count} numbers; write x and y", key, name=key, count=len(numbers))
    (x, y), sides = pairs["decentre"] or (0.0, 0.0), pairs["half_widths"]
    turn = table.number("turn_deg", ANGLE, 0.0)
    return Rim((x, y), (sides[0], sides[1]) if sides else None, turn).scaled(scale)


def rim_text(rim: Rim) -> str:
    """Return a rim as `read_rim` reads it, in mm."""
    pairs = (("decentre", rim.decentre), ("half_widths", rim.half_widths))
    parts = [f"{key} = [{', '.join(digits(x) for x in pair)}]" for key, pair in pairs if pair]
    parts += [f"turn_deg = {digits(rim.turn_deg)}"] * bool(rim.turn_deg)
    return f"{{ {', '.join(parts)} }}"
