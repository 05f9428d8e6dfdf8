"""Tables with named columns: a header row, one row per surface, "# key: value" lines for the rest.

Columns: radius, thickness, and any of surface, glass, nd, vd, index, diameter, semi_diameter, conic, A4, A6, …, stop,
type, label; `NAMES` has their other names. A row whose surface is OBJ states the object, one of IMG the sensor. Keys:
title, unit, epd, f_number, stop_semi_diameter, wavelengths_nm, fields_deg, fields_x_deg. Cells are separated by comma,
semicolon or tab; with semicolons a decimal comma is understood.

A prescription may have sections, each named by a row of its own: Lens Data; Even Aspheres and Odd Aspheres, by the
names of surfaces; and Multiconfiguration Data, a column for every position, with the distances that the lens data name.
"""

import csv
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import zip_longest
from math import inf

from p2sf.lens.lens import Lens
from p2sf.lensfile.configurations import MOST_COLUMNS, Configuration, assemble_all
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.formats.glass_rows import glass_of_row
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawApertureKind, RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, curvature, is_infinite, number
from p2sf.messages import Message

UNITS_MM = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "inch": 25.4}
APERTURES: dict[str, RawApertureKind] = {
    "epd": "entrance_pupil_diameter",
    "f_number": "f_number",
    "stop_semi_diameter": "stop_semi_diameter",
}
COLUMNS = (
    *(
        "surface",
        "radius",
        "thickness",
        "glass",
        "nd",
        "vd",
        "index",
        "diameter",
        "semi_diameter",
        "conic",
        "stop",
        "label",
        "type",
    ),
)
NAMES = {
    **dict.fromkeys(("#", "no", "no.", "surf", "surface_number", "number"), "surface"),
    **dict.fromkeys(("r", "radius_mm", "radius_of_curvature", "curvature_radius", "roc"), "radius"),
    **dict.fromkeys(("d", "t", "thickness_mm", "distance", "spacing", "separation"), "thickness"),
    **dict.fromkeys(("material", "medium", "glass_name"), "glass"),
    **dict.fromkeys(("νd", "abbe", "abbe_number", "abbe_no", "v"), "vd"),
    **dict.fromkeys(("n", "ior", "refractive_index"), "index"),
    **dict.fromkeys(("k", "cc", "kappa", "conic_constant"), "conic"),
    **dict.fromkeys(("sd", "semi_aperture", "semi_diameter_mm", "semidiameter"), "semi_diameter"),
    **dict.fromkeys(("diameter_mm", "clear_aperture", "clear_diameter"), "diameter"),
    **dict.fromkeys(("comment", "name"), "label"),
}
# Columns that say nothing of the surfaces' shapes and media beyond the others.
HARMLESS = (
    *("note", "notes", "remark", "page", "source", "source_page", "element", "group", "pgf", "dpgf"),
    *("nd_offset", "vd_offset", "δnd", "δvd", "?nd", "?vd"),
)
NORMALISED = ("normalization", "normalization_radius")  # of the terms of an asphere
OBJECTS, IMAGES = ("obj", "object", "s0"), ("img", "image", "ima", "sensor")
ROUND = ("", "standard", "sphere", "spherical", "plane", "conic", "asphere", "aspheric", "even asphere", "evenasph")
STOPS = ("stop", "sto", "aperture")
YES = (*STOPS, "yes", "true", "1", "x", "*")
LENS = "lens data"
ASPHERES = ("even aspheres", "odd aspheres", "asphere data")
POSITIONS = ("multiconfiguration data",)
F_NUMBERS = ("aperture", "f-number", "fno")
SECTIONS = (LENS, *ASPHERES, *POSITIONS)


@dataclass
class TableReading:
    """What has been read of one position; ``rows`` has the surfaces by the names that the table gives them."""

    source: LensText
    sources: GlassSources
    notes: Notebook
    column: int = 0
    raw: RawLens = field(default_factory=lambda: RawLens(object_stated=False))
    separator: str = ","
    section: str = LENS
    numbered: bool = False  # from the object, surface 0, on, so that the last row is the image
    header: list[str] = field(default_factory=list)
    rows: dict[str, RawSurface] = field(default_factory=dict)
    variables: dict[str, list[str]] = field(default_factory=dict)
    distances: dict[str, int] = field(default_factory=dict)  # the names used, each with its line


def read_table(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a table with all of its positions; LensFileError with its line."""
    variables = _variables(source)
    first = _read(source, sources, notes, 0, variables)
    used = [len(variables[name]) for name in first.distances if name in variables]
    count = min([MOST_COLUMNS, *used]) if used else 1
    others = [_read(source, sources, Notebook(), column, variables) for column in range(1, count)]
    return assemble_all([Configuration(each.raw) for each in (first, *others)], sources, notes, source)


def _variables(source: LensText) -> dict[str, list[str]]:
    """Return the cells of every row of the positions, by its name."""
    found, section = {}, ""
    separator = _separator(source)
    for line, text in enumerate(source.lines, 1):
        cells = _cells(text, separator, source, line)
        section = _section(cells) or section
        if section in POSITIONS and any(cells[:1]):
            found[cells[0].lower()] = [cell for cell in cells[1:] if cell]
    return found


def _separator(source: LensText) -> str:
    """Return what separates the cells of the first header row."""
    rows = (text for text in source.lines if text.strip(" ,;\t") and not text.strip().startswith("#"))
    header = next((text for text in rows if "radius" in text.lower()), next(iter(source.lines), ""))
    return max(",;\t", key=header.count)


def _section(cells: list[str]) -> str:
    """Return the name of the section that a row of one cell begins, nothing for any other row."""
    name = cells[0].lower() if cells and not any(cells[1:]) else ""
    return name if name in SECTIONS else ""


def _read(
    source: LensText, sources: GlassSources, notes: Notebook, column: int, variables: dict[str, list[str]]
) -> TableReading:
    reading = TableReading(source, sources, notes, column, separator=_separator(source), variables=variables)
    for line, text in enumerate(source.lines, 1):
        if text.strip().startswith("#") and not text.strip().startswith(f"#{reading.separator}"):
            _key(reading.raw, text.strip().lstrip("# "), line, source)
            continue
        cells = _cells(text, reading.separator, source, line)
        if _section(cells):
            reading.section, reading.header = _section(cells), []
        elif any(cells):
            _row(reading, cells, line)
    _leave_out_image(reading)
    _open(reading)
    return reading


def _leave_out_image(reading: TableReading) -> None:
    """Take the last row as the image where it can be nothing else; LensFileError for any other infinite thickness."""
    *others, last = reading.raw.surfaces or [RawSurface(0)]
    if others and last.glass is None and (abs(last.thickness) >= FAR or (reading.numbered and not last.thickness)):
        reading.raw.surfaces, reading.raw.image = others, last
        reading.notes.add("read", "the last row is the image", None, last.line)
    for surface in reading.raw.surfaces:
        if abs(surface.thickness) >= FAR:
            raise reading.source.error(
                "{surface} has an infinite thickness; give a finite one", surface.line, surface=surface.name
            )


def _open(reading: TableReading) -> None:
    """Take the f-number of this position."""
    cells = next((reading.variables[name] for name in F_NUMBERS if name in reading.variables), [])
    if cells and reading.raw.aperture is None:
        word = cells[min(reading.column, len(cells) - 1)]
        value = number(word, Message("f number"), reading.source, len(reading.source.lines))
        reading.raw.aperture = "f_number", value


def _row(reading: TableReading, cells: list[str], line: int) -> None:
    if reading.section in POSITIONS:
        return
    if not reading.header:
        reading.header = _header(cells, line, reading)
        return
    row = {
        name: _decimal(cell, name, reading.separator)
        for name, cell in zip(reading.header, cells, strict=False)
        if name not in HARMLESS
    }
    if reading.section == LENS:
        _add(reading, row, line)
    else:
        _asphere(reading, row, line)


def _cells(text: str, separator: str, source: LensText, line: int) -> list[str]:
    try:
        return [cell.strip() for cell in next(csv.reader([text], delimiter=separator))]
    except csv.Error as failure:
        raise source.error(
            "the row cannot be cut into cells ({reason}); correct it", line, reason=str(failure)
        ) from failure


def _decimal(cell: str, key: str, separator: str) -> str:
    return cell.replace(",", ".") if separator == ";" and key not in ("glass", "label", "type") else cell


def _header(cells: list[str], line: int, reading: TableReading) -> list[str]:
    """Return the column names; LensFileError for an unknown name or a missing radius or thickness."""
    plain = [re.split(r"[\[(]", cell)[0].strip().lower().replace(" ", "_").replace("-", "_") for cell in cells]
    names = [re.sub(r"^a_?0?(\d)", r"a\1", NAMES.get(name, name)) for name in plain]
    known = (*COLUMNS, *HARMLESS, *(NORMALISED if reading.section in ASPHERES else ()), "")
    unknown = [name for name in names if name not in known and not re.fullmatch(r"a([1-9]|[1-3]\d)", name)]
    wanted = ("radius", "thickness") if reading.section == LENS else ("surface",)
    missing = [name for name in wanted if name not in names]
    if missing or unknown:
        problem = (
            Message('column "{name}" is unknown', name=unknown[0][:30])
            if unknown
            else Message("column {name} is missing", name=missing[0])
        )
        raise reading.source.error("{problem}; known are {columns}, A4, A6, …", line, problem=problem, columns=COLUMNS)
    return names


def _key(raw: RawLens, text: str, line: int, source: LensText) -> None:
    """Read one "# key: value" line; other comments are ignored."""
    name, _, value = (part.strip() for part in text.partition(":"))
    name = name.lower().replace("-", "_").replace(" ", "_")
    if name == "title":
        raw.title = value[:200]
    elif name == "unit":
        if value.lower() not in UNITS_MM:
            raise source.error(
                'unit "{unit}" is none of {units}; correct it', line, unit=value[:20], units=tuple(UNITS_MM)
            )
        raw.unit_mm = UNITS_MM[value.lower()]
    elif name in APERTURES:
        raw.aperture, raw.aperture_line = (APERTURES[name], number(value, name, source, line)), line
    elif name == "wavelengths_nm":
        raw.wavelengths_um, raw.wavelength_line = [x / 1000 for x in _list(value, name, line, source)], line
        if not all(0.05 <= x <= 50 for x in raw.wavelengths_um):
            raise source.error("a wavelength is not that of light; give nanometres", line)
    elif name in ("fields_x_deg", "fields_deg"):
        raw.field_line, old = line, list(zip(*raw.fields, strict=True)) or [(), ()]
        old[name == "fields_deg"] = tuple(_list(value, name, line, source))
        raw.fields = list(zip_longest(*old, fillvalue=0.0))


def _list(text: str, name: str, line: int, source: LensText) -> list[float]:
    return [number(word, name, source, line) for word in re.split(r"[,;\s]+", text.strip("[] ")) if word][:1000]


def _add(reading: TableReading, row: dict[str, str], line: int) -> None:
    raw, place, kind = reading.raw, row.get("surface", "").lower(), row.get("type", "").lower()
    place = kind if kind in (*OBJECTS, *IMAGES, *STOPS) else place
    if kind not in (*ROUND, *OBJECTS, *IMAGES, *STOPS):
        raise reading.source.error(
            "surface {surface} has type {kind}, which is not read; only {known} are",
            line,
            surface=len(raw.surfaces) + 1,
            kind=kind,
            known=(*ROUND[1:], *STOPS),
        )
    if place in IMAGES:
        return
    value = _reader(row, line, reading.source)
    thickness = _distance(reading, row.get("thickness", ""), line)
    if place in OBJECTS or (place == "0" and not raw.surfaces and abs(thickness) >= FAR):
        reading.numbered = place == "0"
        raw.object_distance = thickness if 0 < abs(thickness) < FAR else inf
        raw.object_stated = True
        return
    label = row.get("label", "") or ("" if re.fullmatch(r"\d+", place) else row.get("surface", ""))
    surface = RawSurface(len(raw.surfaces) + 1, line, label[:60])
    surface.curvature = curvature(row.get("radius", ""), "radius", reading.source, line)
    surface.thickness, surface.conic = thickness, value("conic")
    surface.semi_diameter = value("semi_diameter") or value("diameter") / 2 or inf
    surface.aspheric = _terms(row, value)
    surface.glass = _glass(reading, row, value, surface)
    if row.get("stop", "").lower() in YES or (place in YES and place != "1" and not place.isdigit()):
        if raw.stop:
            raise reading.source.error(
                "surfaces {first} and {second} both are the stop; keep one",
                line,
                first=raw.stop,
                second=surface.number,
            )
        raw.stop = surface.number
    raw.surfaces.append(surface)
    reading.rows.setdefault(place, surface)


def _reader(row: dict[str, str], line: int, source: LensText) -> Callable[[str], float]:
    """Return what gives the number in a column of a row, 0 where there is none."""
    return lambda key: number(row[key], key, source, line) if row.get(key) else 0.0


def _terms(row: dict[str, str], value: Callable[[str], float]) -> dict[int, float]:
    return {int(key[1:]): value(key) for key in row if re.fullmatch(r"a\d+", key) and value(key)}


def _distance(reading: TableReading, cell: str, line: int) -> float:
    """Return a distance, or that of this position by its name."""
    if is_infinite(cell):
        return inf
    if not re.match(r"[A-Za-z]", cell):
        return number(cell, "thickness", reading.source, line) if cell else 0.0
    reading.distances[cell.lower()] = line
    cells = reading.variables.get(cell.lower(), [])
    if reading.column >= len(cells):
        raise reading.source.error(
            'distance "{name}" has no value in [variable distances]; add it', line, name=cell[:20]
        )
    found = cells[reading.column]
    return inf if is_infinite(found) else number(found, cell, reading.source, line)


def _asphere(reading: TableReading, row: dict[str, str], line: int) -> None:
    surface = reading.rows.get(row.get("surface", "").lower())
    if surface is None:
        raise reading.source.error(
            'aspherical data of "{name}", which is not a row of the lens data', line, name=row.get("surface", "")[:20]
        )
    value = _reader(row, line, reading.source)
    surface.conic = value("conic")
    scale = value("normalization_radius") if row.get("normalization", "").lower() == "normalized" else 1.0
    if not 1e-6 < scale < 1e6:
        raise reading.source.error(
            "normalization radius {radius:g} is not that of a lens; correct it", line, radius=scale
        )
    surface.aspheric = {power: term / scale**power for power, term in _terms(row, value).items()}


def _glass(
    reading: TableReading, row: dict[str, str], value: Callable[[str], float], surface: RawSurface
) -> RawGlass | None:
    """Return the medium: nd and vd, an index, or a name with its maker in front ("SCHOTT N-BK7")."""
    name, line = row.get("glass", ""), surface.line
    maker, _, rest = name.partition(" ")
    named = RawGlass(rest, (maker.upper(),), line=line) if rest else RawGlass(name, line=line)
    if name.lower() == "air" or (value("nd") or value("index")) == 1:
        return None
    if row.get("nd"):
        return glass_of_row(named, row["nd"], value("vd"), surface, reading.sources, reading.notes)
    if row.get("index"):
        return RawGlass(index=value("index"), line=line)
    if not name:
        return None
    return RawGlass(index=value("glass"), line=line) if re.fullmatch(r"[\d.]+", name) else named
