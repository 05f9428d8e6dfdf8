"""One table of a lens file, read key by key; every mistake names its line, its value and the remedy."""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from math import nan

from p2sf.errors import GlassError, LensFileError
from p2sf.glass.media import Medium, parse_medium
from p2sf.lensfile.agf import COEFFICIENTS, DIRECT, SQUARED, FormulaGlass

KEYS = {"agf_formula", "coefficients", "range_um", "name"}


def read_medium(value) -> Medium:
    """Return the medium of a lens file's value; GlassError.

    Beside what `glass.parse_medium` reads: ``{agf_formula = 2, coefficients = […], range_um = [low, high],
    name = "…"}``, a glass of an AGF catalogue with its dispersion formula, so that the file stands alone.
    """
    if isinstance(value, dict) and "agf_formula" in value:
        return _formula_glass(value)
    return parse_medium(value)


def _formula_glass(table: dict) -> FormulaGlass:
    if set(table) != KEYS or not isinstance(table["name"], str):
        raise GlassError(f"glass has the keys {', '.join(table)}; write {', '.join(sorted(KEYS))}")
    formula, coefficients, limits = table["agf_formula"], table["coefficients"], table["range_um"]
    if (formula not in DIRECT and formula not in SQUARED) or not isinstance(formula, int):
        raise GlassError(f"agf_formula is {formula}; write a number from 1 to 13")
    if not _numbers(coefficients) or len(coefficients) > COEFFICIENTS:
        raise GlassError(f"coefficients of {table['name']} are not up to {COEFFICIENTS} numbers; correct them")
    if not _numbers(limits) or len(limits) != 2 or not 0 < limits[0] < limits[1]:
        raise GlassError(f"range_um of {table['name']} is {limits}; write the shortest and the longest wavelength")
    return FormulaGlass(table["name"], formula, tuple(map(float, coefficients)), tuple(map(float, limits)))


def _numbers(values) -> bool:
    plain = isinstance(values, list) and all(isinstance(x, int | float) and not isinstance(x, bool) for x in values)
    return plain and all(abs(x) < 1e100 for x in values)


NUMBER = r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?|[-+]?inf"


@dataclass(frozen=True)
class Rule:
    """What a number must be: a test, and the remedy in words."""

    holds: Callable[[float], bool]
    remedy: str


@dataclass(frozen=True)
class Table:
    """The values under one heading of a lens file; ``surface`` (from 1) is set for a [[surface]]."""

    path: str
    text: str
    values: dict
    heading: str = ""
    surface: int | None = None

    def fail(self, problem: str, key: str = ""):
        """Raise LensFileError at the line of ``key``, or of this table's heading."""
        where = f"surface {self.surface}: " if self.surface else ""
        raise LensFileError(where + problem, self.path, find_line(self.text, self.heading, self.surface, key))

    def check_keys(self, known: Iterable[str], elsewhere: Iterable[str] = ()) -> None:
        """Raise LensFileError for the first key that is not ``known``."""
        known = tuple(known)
        for key in (key for key in self.values if key not in known):
            if key in elsewhere:
                self.fail(f'key "{key}" belongs to the top of the file; move it before the first [ heading', key)
            close = get_close_matches(key, known, 1)
            hint = f'did you mean "{close[0]}"?' if close else f"known here are {', '.join(known)}"
            self.fail(f'key "{key}" is unknown; {hint}', key)

    def string(self, key: str, default: str = "") -> str:
        """Return a text."""
        value = self.values.get(key, default)
        if not isinstance(value, str):
            self.fail(f"{key} is {shown(value)}; write a text in quotation marks", key)
        return value

    def number(self, key: str, rule: Rule, default: float | None = None) -> float:
        """Return a number that keeps the rule; without a default the key must be there."""
        if key not in self.values and default is not None:
            return default
        if key not in self.values:
            self.fail(f"{key} is missing; {rule.remedy}")
        return self._checked(key, self.values[key], rule)

    def numbers(self, key: str, rule: Rule, default: tuple[float, ...]) -> tuple[float, ...]:
        """Return a list of numbers that keep the rule."""
        value = self.values.get(key, default)
        if not isinstance(value, list | tuple):
            self.fail(f"{key} is {shown(value)}; write a list of numbers as in [1.0, 2.0]", key)
        return tuple(self._checked(key, item, rule) for item in value)

    def count(self, key: str) -> int | None:
        """Return a whole number, or None where the key is absent."""
        value = self.values.get(key)
        if value is not None and (isinstance(value, bool) or not isinstance(value, int)):
            self.fail(f"{key} is {shown(value)}; write a whole number", key)
        return value

    def medium(self, key: str) -> Medium:
        """Return the medium a key names; air where it is absent."""
        try:
            return read_medium(self.values.get(key, "air"))
        except GlassError as error:
            self.fail(str(error), key)

    def _checked(self, key: str, value, rule: Rule) -> float:
        number = as_float(value)
        if not rule.holds(number):
            self.fail(f"{key} is {shown(value)}; {quoted_number(value) or rule.remedy}", key)
        return number


def quoted_number(value) -> str:
    """Return the remedy for a number written as a text, "" for anything else."""
    if not isinstance(value, str):
        return ""
    plain = value.strip().replace(",", ".")
    return f"write the number {plain} without quotation marks" if re.fullmatch(NUMBER, plain) else ""


def as_float(value) -> float:
    """Return a TOML number as a float; NaN for anything else, which no rule lets pass."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return nan
    return float(value) if isinstance(value, float) or abs(value) < 1e300 else nan


def shown(value) -> str:
    """Return a value as the file shows it, shortened."""
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
