"""Tolerance files in TOML.

grade = "precision"              # tolerances not listed here: commercial, precision, high, or "none"

[[tolerance]]                    # replaces or extends those of the grade
kind = "decentre_y"              # decentre_x, decentre_y (mm), tilt_x, tilt_y (°), radius (%), thickness (mm), index,
                                 # irregularity, irregularity_45 (fringes of 273 nm from peak to valley)
first = 3                        # the surface; of decentres and tilts the first of a piece
last = 4                         # by default that surface alone
amount = 0.02                    # either way

[[compensator]]                  # adjusted at assembly; by default the back focus
kind = "thickness"
first = 11

[[compensator]]                  # the surface behind the last one is the sensor
kind = "tilt_x"
first = 12
"""

import os
from collections.abc import Sequence
from math import isfinite
from typing import Any, cast

from p2sf.errors import GeometryError, LensFileError
from p2sf.files.reading import toml_table
from p2sf.files.reasons import reason
from p2sf.lens.lens import Lens
from p2sf.lensfile.source_text import read_text
from p2sf.lensfile.toml.table import Constraint, Table
from p2sf.messages import Message
from p2sf.tolerance.errors_of_build import GRADES, MOVES, Grade, Kind, Tolerance, usual_tolerances

AMOUNT = Constraint(lambda x: isfinite(x) and x >= 0, Message("write a finite number, 0 or more"))
COMPENSATING_MM = 0.2  # change of the back focus by which its effect is measured


def back_focus(lens: Lens) -> Tolerance:
    """Return the distance from the last surface to the sensor, as a compensator."""
    return Tolerance("thickness", len(lens.surfaces), COMPENSATING_MM)


def with_compensators(
    tolerances: Sequence[Tolerance], compensators: Sequence[Tolerance]
) -> tuple[tuple[Tolerance, ...], tuple[int, ...]]:
    """Return the tolerances with the compensators appended, replacing their own, and the indices of these."""
    named = {(one.kind, one.piece) for one in compensators}
    kept = tuple(one for one in tolerances if (one.kind, one.piece) not in named)
    return (*kept, *compensators), tuple(range(len(kept), len(kept) + len(compensators)))


def read_tolerances(
    path: str | os.PathLike, lens: Lens, grade: Grade = "precision"
) -> tuple[tuple[Tolerance, ...], tuple[Tolerance, ...]]:
    """Return the tolerances and the compensators of a file; LensFileError states line, value and remedy."""
    text = read_text(path)
    try:
        top = Table(str(path), text, toml_table(text))
    except ValueError as error:
        raise LensFileError("this is not TOML ({reason}); correct the line", path, reason=reason(error)) from None
    top.check_keys(("grade", "tolerance", "compensator"))
    named = top.string("grade", grade)
    if named not in (*GRADES, "none"):
        top.fail('grade is "{grade}"; write one of {grades}', "grade", grade=named, grades=(*GRADES, "none"))
    usual = () if named == "none" else usual_tolerances(lens, cast(Grade, named))
    own = [_tolerance(table, lens, None) for table in _tables(top, "tolerance")]
    compensators = [_tolerance(table, lens, COMPENSATING_MM) for table in _tables(top, "compensator")]
    replaced = {(one.kind, one.piece) for one in own}
    kept = tuple(one for one in usual if (one.kind, one.piece) not in replaced)
    return (*kept, *own), tuple(compensators) or (back_focus(lens),)


def _tables(top: Table, key: str) -> list[Table]:
    rows = top.values.get(key, [])
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        top.fail("{name} is not a list of tables; head every one with [[{name}]]", key, name=key)
    return [Table(top.path, top.text, row, key) for row in rows]


def _tolerance(table: Table, lens: Lens, usual: float | None) -> Tolerance:
    table.check_keys(("kind", "first", "last", "amount"))
    numbers: dict[str, Any] = {key: table.count(key) for key in ("first", "last") if key in table.values}
    first = numbers.get("first") or 0
    last = numbers.get("last") or first
    kind = cast(Kind, table.string("kind"))
    count = len(lens.surfaces) + (kind in MOVES and first == last)
    if not 1 <= first <= last <= count:
        table.fail(
            "surfaces {first} to {last} do not exist; the lens has surfaces 1 to {count}",
            "first",
            first=first,
            last=last,
            count=len(lens.surfaces),
        )
    try:
        return Tolerance(kind, first, table.number("amount", AMOUNT, usual), last)
    except GeometryError as error:
        table.fail(error.message, "kind")
