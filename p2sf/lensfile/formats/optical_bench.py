"""Optical Bench text (photonstophotos.net): sections of tab-separated rows.

[lens data] rows are number, radius (or AS, CG, FS), distance, nd, diameter, vd, glass, maker; distances may
be names of [variable distances], which has a column for each zoom or focus position; [aspherical data] rows are
number, radius, conic constant, A4, A6, … (from A2 where [constants] says AsphericalA2).
"""

import re
from dataclasses import dataclass, field
from itertools import takewhile
from math import inf

from p2sf.lens.lens import Lens
from p2sf.lensfile.configurations import Configuration, assemble_all
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.formats.glass_rows import glass_of_row
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, curvature, is_infinite, number
from p2sf.messages import Message

KINDS = ("AS", "CG", "FS")  # in place of a radius: stop, cover glass, flare stop
FIELD_FRACTIONS = (0.0, 0.7, 1.0)
SAME_RADIUS, ROUNDED = 1e-6, 1e-3  # parts by which the two radii of an asphere differ: not at all, or by rounding


@dataclass
class BenchReading:
    """What has been read of one column; ``rows`` maps the file's own surface numbers to surfaces.

    ``variables`` has the cells of every row of [variable distances], ``distances`` the names used in the lens data.
    """

    source: LensText
    notes: Notebook
    sources: GlassSources
    column: int = 0
    raw: RawLens = field(default_factory=RawLens)
    section: str = ""
    constants: set[str] = field(default_factory=set)
    variables: dict[str, tuple[list[str], int]] = field(default_factory=dict)
    distances: set[str] = field(default_factory=lambda: {"d0", "bf"})
    rows: dict[str, RawSurface] = field(default_factory=dict)


def read_optical_bench(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of an Optical Bench text with all of its positions; LensFileError with its line."""
    first = _read(source, sources, notes, 0)
    count = _complete(first)
    others = [_read(source, sources, Notebook(), column) for column in range(1, count)]
    return assemble_all([_configuration(reading) for reading in (first, *others)], sources, notes, source)


def _read(source: LensText, sources: GlassSources, notes: Notebook, column: int) -> BenchReading:
    """Return what a text says of one column of its variable distances."""
    reading = BenchReading(source, notes, sources, column)
    for line, text in enumerate(source.lines, 1):
        words = _cells(text)
        if words[0].startswith("["):
            reading.section = text.strip().lower().partition("]")[0] + "]"
        elif any(words) and not words[0].startswith("#"):
            READERS.get(reading.section, _skip)(reading, words, line)
    _finish(reading)
    return reading


def _complete(reading: BenchReading) -> int:
    """Return how many columns have a value for every distance, from the first on; more are noted."""
    rows = [reading.variables[name][0] for name in reading.distances & set(reading.variables)]
    rows = [row for row in rows if len(row) > 1]
    stated = max(map(len, rows), default=1)
    whole = next((k for k in range(1, stated) if any(len(row) <= k or not _stated(row[k]) for row in rows)), stated)
    if whole < stated:
        reading.notes.add(
            "caution",
            "position {number} of {count} lacks a distance; those before it are read",
            number=whole + 1,
            count=stated,
        )
    return whole


def _stated(cell: str) -> bool:
    return bool(cell) and cell.lower() != "undefined"


def _configuration(reading: BenchReading) -> Configuration:
    cells, _ = reading.variables.get("f-number", ([], 0))
    unstated = reading.column > 0 and not (
        len(cells) == 1 or _stated("".join(cells[reading.column : reading.column + 1]))
    )
    return Configuration(reading.raw, focal_mm=_value(reading, "focal length"), keeps_stop=unstated)


def _cells(text: str) -> list[str]:
    """Return the cells of a row up to a remark (//); without tabs cut at spaces, with an empty cell for no index."""
    if "\t" in text:
        return list(takewhile(_no_remark, (cell.strip() for cell in text.split("\t")))) or [""]
    words = list(takewhile(_no_remark, text.split())) or [""]
    surface = re.fullmatch(r"\d+[A-Za-z]?", words[0]) and 3 <= len(words)
    return [*words[:3], "", *words[3:]] if surface and len(words) <= 4 else words


def _no_remark(cell: str) -> bool:
    return not cell.startswith("//")


def _skip(reading: BenchReading, words: list[str], line: int) -> None:
    """Ignore a row of a section that does not describe the lens."""


def _describe(reading: BenchReading, words: list[str], line: int) -> None:
    if words[0].lower() == "title":
        reading.raw.title = " ".join(words[1:]).strip()[:200]


def _constant(reading: BenchReading, words: list[str], line: int) -> None:
    reading.constants.add(words[0].lower())
    if words[0].lower() == "asphericaloddcount":
        raise reading.source.error("the aspheres have odd powers (AsphericalOddCount); only even ones are read", line)


def _variable(reading: BenchReading, words: list[str], line: int) -> None:
    cells = words[1:]
    while cells and not cells[-1]:
        cells.pop()
    reading.variables[words[0].lower()] = (cells, line)


def _value(reading: BenchReading, name: str) -> float | None:
    """Return a variable's value, None where there is none or it is infinite or undefined.

    A row of one cell holds for all columns; what a near distance leaves undefined is that of its zoom at infinity.
    """
    cells, line = reading.variables.get(name, ([], 0))
    far, _ = reading.variables.get("d0", ([], 0))
    zooms = next((k for k, cell in enumerate(far) if cell != far[0]), reading.column + 1)
    own = cells[reading.column : reading.column + 1] if len(cells) > 1 else cells
    word = own[0] if own and _stated(own[0]) else (cells[reading.column % zooms :] or [""])[0]
    if not _stated(word) or is_infinite(word):
        return None
    return number(word, name, reading.source, line)


def _surface(reading: BenchReading, words: list[str], line: int) -> None:
    if len(words) < 3:
        raise reading.source.error("a row of lens data needs number, radius and distance; complete it", line)
    surface = RawSurface(len(reading.raw.surfaces) + 1, line, words[0])
    words = [*words, *[""] * 8]
    kind = words[1].upper()
    if kind not in KINDS:
        surface.curvature = curvature(words[1], Message("radius"), reading.source, line)
    surface.thickness = _distance(reading, words[2], line)
    surface.semi_diameter = number(words[4], Message("diameter"), reading.source, line) / 2 if words[4] else inf
    surface.glass = _glass(reading, words, surface, line)
    if kind == "AS":
        if reading.raw.stop:
            raise reading.source.error(
                "surfaces {first} and {second} both are stops; keep one",
                line,
                first=reading.raw.stop,
                second=surface.number,
            )
        reading.raw.stop = surface.number
        surface.semi_diameter = (_value(reading, "aperture diameter") or 2 * surface.semi_diameter) / 2
        surface.keeps_medium = surface.glass is None
    reading.raw.surfaces.append(surface)
    reading.rows[words[0]] = surface


def _distance(reading: BenchReading, word: str, line: int) -> float:
    if not re.match(r"[A-Za-z]", word):
        return number(word, Message("distance"), reading.source, line) if word else 0.0
    reading.distances.add(word.lower())
    value = _value(reading, word.lower())
    if value is None:
        raise reading.source.error(
            'distance "{name}" has no value in [variable distances]; add it', line, name=word[:20]
        )
    return value


def _glass(reading: BenchReading, words: list[str], surface: RawSurface, line: int) -> RawGlass | None:
    """Return the medium: the named glass if it is found exactly and is what nd and vd of the row say, else these."""
    if not words[3]:
        return None
    number(words[3], "nd", reading.source, line)
    vd = number(words[5], "vd", reading.source, line) if words[5] else 0.0
    named = RawGlass(words[6], tuple(words[7].upper().split()), line=line)
    return glass_of_row(named, words[3], vd, surface, reading.sources, reading.notes)


def _asphere(reading: BenchReading, words: list[str], line: int) -> None:
    surface = reading.rows.get(words[0])
    if surface is None:
        raise reading.source.error(
            'aspherical data of "{name}", which is not a row of the lens data', line, name=words[0][:20]
        )
    values = [number(word, Message("aspherical value"), reading.source, line) for word in words[1:] if word]
    if len(values) < 2:
        raise reading.source.error("a row of aspherical data needs number, radius, conic; complete it", line)
    own = 1 / values[0] if values[0] else 0.0
    off = abs(own - surface.curvature) / (abs(surface.curvature) or 1.0)
    if off > ROUNDED:
        raise reading.source.error(
            "{surface}: radius {radius:g} differs from the lens data's; correct one",
            line,
            surface=surface.name,
            radius=values[0],
        )
    if off > SAME_RADIUS:
        told = "radius {radius:.7g} of the aspherical data is {off:.2g} off that of the lens data, which is taken"
        reading.notes.add("caution", told, surface.number, line, radius=values[0], off=off)
    surface.conic = values[1]
    first = 2 if "asphericala2" in reading.constants else 4
    surface.aspheric = dict(zip(range(first, 42, 2), values[2:], strict=False))


def _finish(reading: BenchReading) -> None:
    raw = reading.raw
    raw.object_distance, raw.object_stated = _value(reading, "d0") or inf, "d0" in reading.variables
    if not abs(raw.object_distance) < FAR:
        raw.object_distance = inf
    f_number = _value(reading, "f-number")
    if f_number:
        raw.aperture, raw.aperture_line = ("f_number", f_number), reading.variables["f-number"][1]
        raw.state("f_number", f_number, raw.aperture_line)  # whatever the title rounds it to
    angle = _value(reading, "angle of view")
    if angle:
        raw.field_line = reading.variables["angle of view"][1]
        raw.fields = [(0.0, fraction * angle / 2) for fraction in FIELD_FRACTIONS]
    cells, line = reading.variables.get("focal length", ([], 0))
    focal = _value(reading, "focal length") if _stated("".join(cells[reading.column : reading.column + 1])) else None
    if focal:
        raw.state("focal_length", focal, line)
    if raw.surfaces and not raw.surfaces[-1].thickness:
        back = _value(reading, "bf")
        raw.surfaces[-1].thickness = back or 0.0
        raw.sensor_stated = back is not None


READERS = {
    "[descriptive data]": _describe,
    "[constants]": _constant,
    "[variable distances]": _variable,
    "[lens data]": _surface,
    "[aspherical data]": _asphere,
}
