"""JSON lens files: parsed once, with the line of every surface and errors that name both."""

import json
import re
from collections.abc import Collection
from dataclasses import dataclass
from math import inf
from typing import Any, NoReturn

from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText
from p2sf.messages import Message

INFINITE = ("inf", "infinity", "-inf", "-infinity")


def parse_json(source: LensText) -> Any:
    """Return what a JSON text holds; LensFileError with its line for another text."""
    try:
        return json.loads(source.text.removeprefix("\ufeff"))
    except json.JSONDecodeError as failure:
        raise source.error(
            "this is not JSON ({reason}); correct the line", failure.lineno, reason=failure.msg
        ) from failure
    except (RecursionError, ValueError) as failure:
        raise source.error("lists are nested too deep or a number is too long; this is not a lens file", 1) from failure


@dataclass(frozen=True)
class JsonPart:
    """One object of a JSON lens file with its line; ``surface`` counts from 1, None for what is no surface."""

    values: dict[str, Any]
    source: LensText
    line: int = 1
    surface: int | None = None

    def refuse(self, template: str, /, **values: object) -> NoReturn:
        """Raise LensFileError about this object, whose surface the template calls ``{surface}``."""
        raise self.source.error(template, self.line, surface=self.surface or 0, **values)

    def note_unknown(self, notes: Notebook, known: Collection[str]) -> None:
        """Note the keys of this object that a reader does not know; a name in parentheses is a comment."""
        for name in self.values:
            if name not in known and not name.startswith("("):
                notes.add_unknown(name, self.line)

    def number(self, *names: str, default: float | None = None) -> float:
        """Return the first of these numbers that is stated; infinity may be a word. LensFileError for anything else."""
        name = next((name for name in names if self.values.get(name) is not None), names[0])
        value = self.values.get(name)
        value = default if value is None else value
        if isinstance(value, str) and value.strip().lower() in INFINITE:
            value = -inf if value.strip().startswith("-") else inf
        if (
            isinstance(value, bool)
            or not isinstance(value, int | float)
            or not (abs(value) < 1e100 or abs(value) == inf)
        ):
            where = Message("surface {surface}: {name}", surface=self.surface, name=name) if self.surface else name
            raise self.source.error(
                "{name} is {found}; write a number", self.line, name=where, found=str(self.values.get(name))[:40]
            )
        return float(value)

    def curvature(self, *names: str, default: float | None = None) -> float:
        """Return the curvature of a radius, which is 0 or infinite for a plane."""
        radius = self.number(*names, default=default)
        return 1 / radius if radius and abs(radius) < FAR else 0.0

    def thickness(self, *names: str, default: float | None = None) -> float:
        """Return a finite distance to the next surface; LensFileError for another."""
        value = self.number(*names, default=default)
        if abs(value) >= FAR:
            self.refuse("surface {surface} has an infinite thickness; give a finite one")
        return value

    def numbers(self, name: str) -> list[float]:
        """Return a list of numbers, empty where there is none; LensFileError for anything else."""
        listed = self.values.get(name)
        listed = [] if listed is None else listed
        if not isinstance(listed, list) or len(listed) > 1000:
            self.refuse("surface {surface}: {name} is not a list of numbers; correct it", name=name)
        return [JsonPart({name: item}, self.source, self.line, self.surface).number(name) for item in listed]

    def text(self, *names: str) -> str:
        """Return the first of these texts that is stated, else an empty one, of at most 500 characters."""
        found = (self.values[name] for name in names if isinstance(self.values.get(name), str))
        return " ".join(next(found, "").split())[:500]

    def part(self, name: str) -> "JsonPart":
        """Return an object inside, empty where there is none; LensFileError for anything else."""
        inside = self.values.get(name)
        if inside is not None and not isinstance(inside, dict):
            self.refuse('"{name}" is not an object; correct it', name=name)
        return JsonPart(inside or {}, self.source, self.line, self.surface)

    def parts(self, name: str, mark: str = "", first: int = 1) -> list["JsonPart"]:
        """Return the objects of a list, counted from ``first``, each on the line where it has the key ``mark``."""
        listed = self.values.get(name)
        if not isinstance(listed, list) or not all(isinstance(item, dict) for item in listed):
            self.refuse('a lens lists its "{name}"; add them', name=name)
        lines = [n for n, text in enumerate(self.source.lines, 1) for _ in re.finditer(rf'"{mark}"\s*:', text)]
        lines += [len(self.source.lines)] * len(listed)
        return [JsonPart(item, self.source, lines[place], place + first) for place, item in enumerate(listed)]


def read_json(source: LensText) -> JsonPart:
    """Return the object that a JSON text is; LensFileError for another text."""
    top = parse_json(source)
    if not isinstance(top, dict):
        raise source.error("this JSON is a list and no lens; give one with surfaces", 1)
    return JsonPart(top, source)
