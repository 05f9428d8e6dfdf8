"""One table of a lens file, read key by key; every error names the line, the value and the remedy."""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from json import dumps
from math import nan
from typing import TYPE_CHECKING, Any, NoReturn, TypeGuard

from p2sf.errors import GlassError, LensFileError
from p2sf.glass.media import Medium, parse_medium
from p2sf.lensfile.source_text import digits
from p2sf.messages import Message

if TYPE_CHECKING:
    from p2sf.glass.transmittance import InternalTransmittance
    from p2sf.lensfile.agf import FormulaGlass

KEYS, PASSED = {"agf_formula", "coefficients", "range_um", "name"}, "internal_transmittance"


def read_medium(value: object) -> Medium:
    """Return the medium of a lens file's value; GlassError.

    In addition to what `glass.parse_medium` reads, ``{agf_formula = 2, coefficients = […], range_um = [low, high],
    name = "…"}`` is a glass of an AGF catalogue with its dispersion formula, so that the file is self-contained;
    ``internal_transmittance = [[µm, share, mm], …]`` are its IT lines.
    """
    if isinstance(value, dict) and "agf_formula" in value:
        return _formula_glass(value)
    return parse_medium(value)


def _formula_glass(table: dict[str, Any]) -> "FormulaGlass":
    from p2sf.lensfile.agf import COEFFICIENTS, DIRECT, SQUARED, FormulaGlass

    if set(table) - {PASSED} != KEYS or not isinstance(table["name"], str):
        raise GlassError("glass has the keys {names}; write {known}", names=tuple(table), known=tuple(sorted(KEYS)))
    name, formula, coefficients, limits = (table[key] for key in ("name", "agf_formula", "coefficients", "range_um"))
    if type(formula) is not int or (formula not in DIRECT and formula not in SQUARED):
        raise GlassError("agf_formula is {formula}; write a number from 1 to 13", formula=str(formula))
    if not _numbers(coefficients) or len(coefficients) > COEFFICIENTS:
        raise GlassError(
            "coefficients of {name} are not up to {count} numbers; correct them", name=name, count=COEFFICIENTS
        )
    if not _numbers(limits) or len(limits) != 2 or not 0 < limits[0] < limits[1]:
        raise GlassError(
            "range_um of {name} is {limits}; write the shortest and the longest wavelength",
            name=name,
            limits=str(limits),
        )
    numbers, ends = tuple(map(float, coefficients)), (float(limits[0]), float(limits[1]))
    return FormulaGlass(name, formula, numbers, ends, transmittance=_transmittance(table))


def _transmittance(table: dict[str, Any]) -> "InternalTransmittance | None":
    from p2sf.glass.transmittance import InternalTransmittance

    records = table.get(PASSED)
    if records is None:
        return None
    if not (isinstance(records, list) and all(_numbers(record) and len(record) == 3 for record in records)):
        raise GlassError(
            "{key} of {name} is {records}; write a list of [wavelength in µm, share, thickness in mm]",
            key=PASSED,
            name=table["name"],
            records=str(records),
        )
    return InternalTransmittance(tuple((float(wave), float(share), float(mm)) for wave, share, mm in records))


def _numbers(values: object) -> TypeGuard[list[float]]:
    return isinstance(values, list) and all(
        isinstance(x, int | float) and not isinstance(x, bool) and abs(x) < 1e100 for x in values
    )


NUMBER = r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?|[-+]?inf"


@dataclass(frozen=True)
class Constraint:
    """A constraint on a number and the hint shown when it is violated."""

    holds: Callable[[float], bool]
    remedy: Message


@dataclass(frozen=True)
class Table:
    """The values under one heading of a lens file; ``surface`` (from 1) is set for a [[surface]].

    ``within`` names the key of an inline table, { … }, whose values these are.
    """

    path: str
    text: str
    values: dict[str, Any]
    heading: str = ""
    surface: int | None = None
    within: str = ""

    def fail(self, template: str | Message, /, key: str = "", **values: object) -> NoReturn:
        """Raise LensFileError at the line of ``key``, or of this table's heading, with its template's values."""
        message = template if isinstance(template, Message) else Message(template, **values)
        if self.surface:
            message = Message("surface {surface}: {message}", surface=self.surface, message=message)
        raise LensFileError(message, self.path, find_line(self.text, self.heading, self.surface, self.within or key))

    def inline(self, key: str) -> "Table | None":
        """Return the inline table of a key, None where it is absent."""
        value = self.values.get(key)
        if value is None:
            return None
        if not isinstance(value, dict):
            self.fail("{name} is {found}; write {{ key = value, … }}", key, name=key, found=shorten(value))
        return replace(self, values=value, within=key)

    def check_keys(self, known: Iterable[str], elsewhere: Iterable[str] = ()) -> None:
        """Raise LensFileError for the first key that is not ``known``."""
        known = tuple(known)
        for key in (key for key in self.values if key not in known):
            if key in elsewhere:
                self.fail(
                    'key "{name}" belongs to the top of the file; move it before the first [ heading', key, name=key
                )
            from difflib import get_close_matches

            close = get_close_matches(key, known, 1)
            if close:
                self.fail('key "{name}" is unknown; did you mean "{known}"?', key, name=key, known=close[0])
            self.fail('key "{name}" is unknown; known here are {known}', key, name=key, known=known)

    def string(self, key: str, default: str = "") -> str:
        """Return a text."""
        value = self.values.get(key, default)
        if not isinstance(value, str):
            self.fail("{name} is {found}; write a text in quotation marks", key, name=key, found=shorten(value))
        return value

    def number(self, key: str, rule: Constraint, default: float | None = None) -> float:
        """Return a number that keeps the rule; without a default the key must be there."""
        if key not in self.values and default is not None:
            return default
        if key not in self.values:
            self.fail("{name} is missing; {remedy}", name=key, remedy=rule.remedy)
        return self._check(key, self.values[key], rule)

    def numbers(self, key: str, rule: Constraint, default: tuple[float, ...]) -> tuple[float, ...]:
        """Return a list of numbers that keep the rule."""
        value = self.values.get(key, default)
        if not isinstance(value, list | tuple):
            self.fail(
                "{name} is {found}; write a list of numbers as in [1.0, 2.0]", key, name=key, found=shorten(value)
            )
        return tuple(self._check(key, item, rule) for item in value)

    def count(self, key: str) -> int | None:
        """Return a whole number, or None where the key is absent."""
        value = self.values.get(key)
        if value is not None and (isinstance(value, bool) or not isinstance(value, int)):
            self.fail("{name} is {found}; write a whole number", key, name=key, found=shorten(value))
        return value

    def flag(self, key: str) -> bool:
        """Return true or false; false where the key is absent."""
        value = self.values.get(key, False)
        if not isinstance(value, bool):
            self.fail("{name} is {found}; write true or false", key, name=key, found=shorten(value))
        return value

    def medium(self, key: str) -> Medium:
        """Return the medium a key names; air where it is absent."""
        try:
            return read_medium(self.values.get(key, "air"))
        except GlassError as error:
            self.fail(error.message, key)

    def _check(self, key: str, value: object, rule: Constraint) -> float:
        number = as_float(value)
        if not rule.holds(number):
            remedy = quoted_number(value) or rule.remedy
            self.fail("{name} is {found}; {remedy}", key, name=key, found=shorten(value), remedy=remedy)
        return number


def list_text(numbers: Iterable[float]) -> str:
    """Return a TOML list of numbers with all their digits."""
    return f"[{', '.join(map(digits, numbers))}]"


def text_of(text: str) -> str:
    """Return a TOML string; a text of several lines keeps them."""
    escaped = dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
    if "\n" not in text:
        return escaped
    return '"""\n' + escaped[1:-1].replace("\\n", "\n") + '"""'


def quoted_number(value: object) -> Message | None:
    """Return the remedy for a number written as a text, None for anything else."""
    plain = value.strip().replace(",", ".") if isinstance(value, str) else ""
    if not re.fullmatch(NUMBER, plain):
        return None
    return Message("write the number {number} without quotation marks", number=plain)


def as_float(value: object) -> float:
    """Return a TOML number as a float; NaN for anything else, which no rule accepts."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return nan
    return float(value) if isinstance(value, float) or abs(value) < 1e300 else nan


def shorten(value: object) -> str:
    """Return a value as the file writes it, shortened to 60 characters."""
    text = f'"{value}"' if isinstance(value, str) else str(value).lower() if isinstance(value, bool) else str(value)
    return text if len(text) <= 60 else text[:57] + "..."


def find_line(text: str, heading: str, surface: int | None, key: str) -> int | None:
    """Return the line (from 1) of a key under a heading, of the heading if the key is not there, else None.

    ``heading`` "" is the top of the file; ``surface`` counts the headings of that name from 1.
    """
    lines = _without_long_strings(text).splitlines()
    first, last = _section(lines, heading, surface or 1)
    assignment = re.compile(rf"""\s*["']?{re.escape(key)}["']?\s*(=|\.)""")
    for number in range(first, last):
        if key and assignment.match(lines[number]):
            return number + 1
    return first if heading and first else None


def _section(lines: list[str], heading: str, count: int) -> tuple[int, int]:
    """Return [first, last) of the lines under the ``count``-th heading of a name; all lines if there is none."""
    heads = [i for i, line in enumerate(lines) if re.match(r"\s*\[\[?\s*[\w\"']", line)]
    if not heading:
        return 0, heads[0] if heads else len(lines)
    named = [i for i in heads if re.match(rf"\s*\[\[?\s*{heading}\s*\]", lines[i])]
    if len(named) < count:
        return 0, 0
    first = named[count - 1]
    return first + 1, next((i for i in heads if i > first), len(lines))


def _without_long_strings(text: str) -> str:
    """Return the text with strings over several lines emptied, keeping its line count."""
    return re.sub(r'"""(.*?)"""|\'\'\'(.*?)\'\'\'', lambda m: "''" + "\n" * m.group().count("\n"), text, flags=re.S)
