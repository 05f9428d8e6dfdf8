"""Plain tables with named columns: one header row, one row per surface, "# key: value" lines for the rest.

Columns: radius, thickness, and any of glass, nd, vd, index, diameter, semi_diameter, conic, A4, A6, …, stop,
label. Keys: title, unit, epd, f_number, stop_semi_diameter, wavelengths_nm, fields_deg, fields_x_deg. Cells are
separated by comma, semicolon or tab; with semicolons a decimal comma is understood.
"""

import csv
import re
from collections.abc import Callable
from itertools import zip_longest
from math import inf

from p2sf.lens.lens import Lens
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawApertureKind, RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, number
from p2sf.messages import Message

UNITS_MM = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "inch": 25.4}
APERTURES: dict[str, RawApertureKind] = {
    "epd": "entrance_pupil_diameter",
    "f_number": "f_number",
    "stop_semi_diameter": "stop_semi_diameter",
}
COLUMNS = ("radius", "thickness", "glass", "nd", "vd", "index", "diameter", "semi_diameter", "conic", "stop", "label")
PLANES = ("", "inf", "infinity", "plano", "plane", "flat")
YES = ("stop", "yes", "true", "1", "x", "*")


def read_table(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a CSV file with named columns; LensFileError with its line."""
    raw, separator = RawLens(), ","
    header: list[str] = []
    for line, text in enumerate(source.lines, 1):
        if text.strip().startswith("#"):
            _key(raw, text.strip().lstrip("# "), line, source)
        elif text.strip() and not header:
            separator = max(",;\t", key=text.count)
            header = _header(_cells(text, separator, source, line), line, source)
        elif text.strip(" ,;\t"):
            cells = _cells(text, separator, source, line)
            row = dict(zip(header, cells, strict=False))
            _add(raw, {key: _decimal(cell, key, separator) for key, cell in row.items()}, line, source)
    return assemble(raw, sources, notes, source)


def _cells(text: str, separator: str, source: LensText, line: int) -> list[str]:
    try:
        return [cell.strip() for cell in next(csv.reader([text], delimiter=separator))]
    except csv.Error as failure:
        raise source.error(
            "the row cannot be cut into cells ({reason}); correct it", line, reason=str(failure)
        ) from failure


def _decimal(cell: str, key: str, separator: str) -> str:
    return cell.replace(",", ".") if separator == ";" and key not in ("glass", "label") else cell


def _header(cells: list[str], line: int, source: LensText) -> list[str]:
    """Return the column names; LensFileError for an unknown name or a missing radius or thickness."""
    names = [re.sub(r"\s*[\[(].*", "", cell).strip().lower().replace(" ", "_").replace("-", "_") for cell in cells]
    unknown = [name for name in names if name not in COLUMNS and not re.fullmatch(r"a([1-9]|[1-3]\d)|", name)]
    missing = [name for name in ("radius", "thickness") if name not in names]
    if missing or unknown:
        problem = (
            Message('column "{name}" is unknown', name=unknown[0][:30])
            if unknown
            else Message("column {name} is missing", name=missing[0])
        )
        raise source.error("{problem}; known are {columns}, A4, A6, …", line, problem=problem, columns=COLUMNS)
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


def _add(raw: RawLens, row: dict[str, str], line: int, source: LensText) -> None:
    def value(key: str, default: float = 0.0) -> float:
        return number(row[key], key, source, line) if row.get(key) else default

    surface = RawSurface(len(raw.surfaces) + 1, line, row.get("label", "")[:60])
    radius = 0.0 if row.get("radius", "").lower() in PLANES else value("radius")
    surface.curvature = 1 / radius if radius else 0.0
    surface.thickness, surface.conic = value("thickness"), value("conic")
    surface.semi_diameter = value("semi_diameter") or value("diameter") / 2 or inf
    surface.aspheric = {int(key[1:]): value(key) for key in row if re.fullmatch(r"a\d+", key) and value(key)}
    surface.glass = _glass(row, value, line)
    if row.get("stop", "").lower() in YES:
        if raw.stop:
            raise source.error(
                "surfaces {first} and {second} both are the stop; keep one",
                line,
                first=raw.stop,
                second=surface.number,
            )
        raw.stop = surface.number
    raw.surfaces.append(surface)


def _glass(row: dict[str, str], value: Callable[[str], float], line: int) -> RawGlass | None:
    """Return the medium: nd and vd, an index, or a name with its maker in front ("SCHOTT N-BK7")."""
    if row.get("nd"):
        return RawGlass(model=(value("nd"), value("vd")), line=line) if row.get("vd") else RawGlass(index=value("nd"))
    if row.get("index"):
        return RawGlass(index=value("index"), line=line)
    name = row.get("glass", "")
    if name.lower() in ("", "air"):
        return None
    if re.fullmatch(r"[\d.]+", name):
        return RawGlass(index=value("glass"), line=line)
    maker, _, rest = name.partition(" ")
    return RawGlass(rest, (maker.upper(),), line=line) if rest else RawGlass(name, line=line)
