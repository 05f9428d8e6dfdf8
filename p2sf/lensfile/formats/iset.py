"""ISET and PBRT lens files: JSON with "surfaces", and the older .dat of four columns.

Lengths are mm. ``ior`` is the index behind a surface: a number, or [[nm …], [n …]]. A surface of radius 0 is the
stop where ior is 0 or the name says so, elsewhere a plane. A stop has the same medium on both sides.
"""

import re
from math import inf, isinf

from p2sf.conventions import NM_PER_UM
from p2sf.errors import GlassError
from p2sf.glass.media import measured_index
from p2sf.lens.lens import Lens
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.formats.json_parts import parse_json
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, is_infinite, number
from p2sf.messages import Message

STOP_NAMES = ("stop", "diaphragm", "aperture")
IDENTITY = ([1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0])
TOP_KEYS = "name", "description", "type", "surfaces", "microlens"
KEYS = (
    "radius",
    "thickness",
    "ior",
    "semi_aperture",
    "conic_constant",
    "aspheric_coefficients",
    "transform",
    "name",
    "type",
)


def read_iset_json(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of an ISET .json file; LensFileError with its line for what is missing or not centred."""
    top = parse_json(source)
    if not isinstance(top, dict) or not isinstance(top.get("surfaces"), list):
        older = isinstance(top, dict) and "surfaceArray" in top
        remedy = (
            Message("this is the older surfaceArray form, convert it in ISET")
            if older
            else Message('a lens lists its "surfaces"')
        )
        raise source.error("the file contains no list of surfaces; {remedy}", 1, remedy=remedy)
    for key in sorted(top.keys() - {*TOP_KEYS}):
        notes.add_unknown(key, 1)
    raw = RawLens(title=_text(top, "name"), source=_text(top, "description"), sensor_stated=False, object_stated=False)
    lines = _surface_lines(source)
    for place, values in enumerate(top["surfaces"]):
        line = lines[place] if place < len(lines) else len(source.lines)
        if not isinstance(values, dict):
            raise source.error(
                "surface {surface} is not an object with radius and thickness; correct it", line, surface=place + 1
            )
        _add(raw, _surface(values, place + 1, line, source, notes), _is_stop(values), notes, source)
    if top.get("microlens"):
        notes.add("caution", "the microlens array is left out; the picture is that of the lens before it")
    return _finish(raw, sources, notes, source)


def read_iset_dat(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a .dat file: rows of radius, thickness, index, aperture diameter; LensFileError."""
    raw = RawLens(sensor_stated=False, object_stated=False)
    for line, text in enumerate(source.lines, 1):
        words = text.split("#")[0].replace(",", " ").split()
        if text.strip().lower().startswith("# name:"):
            raw.title = text.split(":", 1)[1].strip()[:200]
        if not words or (len(words) == 1 and not raw.surfaces):
            continue  # the single number on top is the focal length, which the surfaces give exactly
        if len(words) != 4:
            raise source.error(
                "a row has {count} columns; write radius, thickness, index, diameter", line, count=len(words)
            )
        words[0] = "0" if is_infinite(words[0]) else words[0]
        radius, thickness, index, diameter = (number(word, Message("value"), source, line) for word in words)
        values = {"radius": radius, "thickness": thickness, "ior": index, "semi_aperture": diameter / 2}
        surface = _surface(values, len(raw.surfaces) + 1, line, source, notes)
        _add(raw, surface, _is_stop(values), notes, source)
    notes.add("read", "the fourth column as the rim's diameter")
    return _finish(raw, sources, notes, source)


def _text(values: dict, key: str) -> str:
    value = values.get(key, "")
    return " ".join(value.split())[:500] if isinstance(value, str) else ""


def _surface_lines(source: LensText) -> list[int]:
    """Return the line of every surface's radius, the key that each must have."""
    return [n for n, line in enumerate(source.lines, 1) for _ in re.finditer(r'"radius"\s*:', line)]


def _surface(values: dict, count: int, line: int, source: LensText, notes: Notebook) -> RawSurface:
    """Return one surface; LensFileError for one that is not rotationally symmetric."""

    def one(key: str, default: float | None = None) -> float:
        return _one(values, key, default, count, line, source)

    for key in values:
        if key not in KEYS:
            notes.add_unknown(key, line)
    if values.get("transform") is not None and values["transform"] != [list(row) for row in IDENTITY]:
        raise source.error(
            "surface {surface} is tilted or decentred (transform); only centred lenses are read", line, surface=count
        )
    radius = one("radius")
    surface = RawSurface(count, line, _text(values, "name"), 1 / radius if radius else 0.0, one("thickness"))
    surface.conic = one("conic_constant", 0.0)
    surface.semi_diameter = one("semi_aperture", inf) or inf
    surface.aspheric = dict(zip(range(4, 44, 2), _coefficients(values, count, line, source), strict=False))
    if radius and values.get("ior") == 0:
        notes.add("caution", "index 0 behind a curved surface is read as air, as PBRT does", count, line)
    surface.glass = _glass(values.get("ior", 1.0), count, line, source)
    return surface


def _one(values: dict, key: str, default: float | None, count: int, line: int, source: LensText) -> float:
    """Return a number; a pair for x and y is one number where both are the same."""
    value = values.get(key, default)
    value = default if value == [] else value  # MATLAB's for nothing
    if isinstance(value, list) and len(value) == 2 and value[0] != value[1]:
        raise source.error(
            "surface {surface}: {name} differs between x and y; only round lenses are read",
            line,
            surface=count,
            name=key,
        )
    value = value[0] if isinstance(value, list) and value else value
    infinite = is_infinite(value) if isinstance(value, str) else isinstance(value, float) and isinf(value)
    if infinite and (key == "radius" or default == inf):
        return 0.0 if key == "radius" else inf
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < 1e100:
        raise source.error(
            "surface {surface}: {name} is {found}; write a number",
            line,
            surface=count,
            name=key,
            found=str(value)[:40],
        )
    return float(value)


def _coefficients(values: dict, count: int, line: int, source: LensText) -> list[float]:
    """Return A4, A6, …; LensFileError for more than 20 of them and for anything but numbers."""
    listed = values.get("aspheric_coefficients") or []
    if not isinstance(listed, list) or len(listed) > 20:
        raise source.error(
            "surface {surface}: aspheric_coefficients is not a list of up to 20 numbers; correct it",
            line,
            surface=count,
        )
    return [
        _one({"aspheric_coefficients": item}, "aspheric_coefficients", None, count, line, source) for item in listed
    ]


def _glass(ior: object, count: int, line: int, source: LensText) -> RawGlass | None:
    if isinstance(ior, int | float) and not isinstance(ior, bool):
        return None if ior in (0, 1) else RawGlass(index=float(ior), line=line)
    lists = ior if isinstance(ior, list) and all(isinstance(part, list) for part in ior) else []
    if len(lists) != 2 or len(lists[0]) != len(lists[1]):
        raise source.error(
            "surface {surface}: ior is neither a number nor [[nm …], [n …]]; correct it", line, surface=count
        )
    try:
        pairs = sorted(zip(*lists, strict=True))
        table = measured_index([w / NM_PER_UM for w, _ in pairs], [n for _, n in pairs])
    except (GlassError, TypeError) as failure:
        reason = failure if isinstance(failure, GlassError) else str(failure)
        raise source.error(
            "surface {surface}: ior is not a table of wavelengths and indices ({reason})",
            line,
            surface=count,
            reason=reason,
        ) from failure
    return RawGlass(medium=table, line=line)


def _is_stop(values: dict) -> bool:
    named = isinstance(values.get("name"), str) and any(word in values["name"].lower() for word in STOP_NAMES)
    return values.get("radius") in (0, [0, 0]) and (values.get("ior") == 0 or named)


def _add(raw: RawLens, surface: RawSurface, is_stop: bool, notes: Notebook, source: LensText) -> None:
    """Append a surface; a stop has the same medium on both sides. LensFileError for a second stop."""
    if is_stop:
        if raw.stop is not None:
            raise source.error(
                "surfaces {first} and {second} both are the stop; keep one",
                surface.line,
                first=raw.stop,
                second=surface.number,
            )
        raw.stop = surface.number
        surface.keeps_medium, surface.glass = True, None
    elif not surface.curvature and surface.number > 1:
        notes.add("read", "a radius of 0 with an index is a plane", surface.number, surface.line)
    raw.surfaces.append(surface)


def _finish(raw: RawLens, sources: GlassSources, notes: Notebook, source: LensText) -> Lens:
    if raw.surfaces and raw.surfaces[-1].thickness:
        raw.sensor_stated = True
        notes.add("read", "the last thickness as the distance to the sensor")
    return assemble(raw, sources, notes, source)
