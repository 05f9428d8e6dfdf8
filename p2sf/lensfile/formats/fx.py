"""Lens files of renderers, .fx: rows from the scene to the sensor, in mm.

crayg has sections [Metadata], [Elements] or [Surfaces], and [Aspheric Coefficients], whose rows count from 0; a radius
of 0 is the stop. The older form, of polynomial optics and vkdt, has rows of radius, thickness (short/mid/long zoom),
material (air, iris, or a name with nd and vd), housing radius and #!aspheric=conic,A4,A6,A8,A10; #!scale scales all.
"""

import re
from dataclasses import dataclass, field
from math import inf

from p2sf.lens.anamorphic import Toroid
from p2sf.lens.lens import Lens
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.configurations import Configuration, assemble_all
from p2sf.lensfile.formats.glass_rows import glass_of_row
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, curvature, is_infinite, number
from p2sf.lensfile.stated import StatedKind
from p2sf.messages import Message

COLUMNS = ("radius", "thickness", "ior", "housing-radius", "abbe-no", "material", "geometry")
CYLINDERS = ("CYLINDER_X", "CYLINDER_Y")  # by the axis along which they are straight
GEOMETRIES = ("SPHERICAL", "ASPHERICAL", "PLANAR", *CYLINDERS)
STATED: dict[str, StatedKind] = {"focal length": "focal_length", "maximum f number": "f_number"}
MAKERS = ("SCHOTT", "OHARA", "HOYA", "HIKARI", "SUMITA", "CDGM", "CORNING", "LZOS")
ZOOMS = 3  # short, mid, long


@dataclass
class FxReading:
    """What has been read of a file with sections; ``stops`` are rows of radius 0, by the index behind them."""

    source: LensText
    sources: GlassSources
    notes: Notebook
    raw: RawLens = field(default_factory=lambda: RawLens(object_stated=False))
    header: tuple[str, ...] = COLUMNS
    stops: dict[int, float] = field(default_factory=dict)


def read_fx(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a renderer's .fx file, with its zooms; LensFileError with its line."""
    if re.search(r"^[^\S\n]*\[(elements|surfaces)\]", source.text, re.IGNORECASE | re.MULTILINE):
        return _sections(source, sources, notes)
    zooms = [_rows(source, sources, notes if zoom == 0 else Notebook(), zoom) for zoom in range(ZOOMS)]
    varied = any(zooms[0].surfaces != zoom.surfaces for zoom in zooms[1:])
    return assemble_all([Configuration(raw) for raw in (zooms if varied else zooms[:1])], sources, notes, source)


def _sections(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    reading, section = FxReading(source, sources, notes), ""
    for line, text in enumerate(source.lines, 1):
        code = text.partition("#")[0].strip()
        if code.startswith("["):
            section = code.lower()
        elif code and section == "[metadata]":
            _metadata(reading, code, line)
        elif code and section in ("[elements]", "[surfaces]"):
            _surface(reading, code, line)
        elif code and section == "[aspheric coefficients]":
            _asphere(reading, code, line)
    raw = reading.raw
    raw.stop = min(reading.stops, key=lambda number: (reading.stops[number] != 0, number), default=None)
    if len(reading.stops) > 1:
        notes.add(
            "caution",
            "{count} surfaces have radius 0; {number} is the stop",
            None,
            count=len(reading.stops),
            number=raw.stop,
        )
    if raw.stop:
        raw.surfaces[raw.stop - 1].keeps_medium = True
    return assemble(raw, sources, notes, source)


def _metadata(reading: FxReading, code: str, line: int) -> None:
    name, _, value = (part.strip() for part in code.partition(":"))
    found = re.fullmatch(r"(?:f/)?([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(?:mm|x|×)?", value, re.IGNORECASE)
    if name.lower() == "name":
        reading.raw.title = value[:200]
    elif name.lower() in STATED and found:
        reading.raw.state(STATED[name.lower()], float(found[1]), line)
    elif name.lower() == "squeeze" and value:
        if not found or float(found[1]) != 1:
            told = "the picture is squeezed by {factor}, which is left out"
            reading.notes.add("caution", told, None, line, factor=value[:20])
    elif value:
        reading.notes.add_unknown(name, line)


def _surface(reading: FxReading, code: str, line: int) -> None:
    words = code.split()
    if words[0].lower() == "radius":
        reading.header = tuple(word.lower() for word in words)
        return
    row = dict(zip(reading.header, words, strict=False))
    if len(words) < 4 or not {"radius", "thickness", "ior"} <= set(row):
        raise reading.source.error("a row needs radius, thickness, index and housing radius; complete it", line)
    words = [row.get(name, "0") for name in COLUMNS[:5]]
    words[0] = "0" if is_infinite(words[0]) else words[0]
    values = {name: number(word, name, reading.source, line) for name, word in zip(COLUMNS[:5], words, strict=True)}
    surface = RawSurface(len(reading.raw.surfaces) + 1, line)
    geometry = row.get("geometry", "SPHERICAL").upper()
    if geometry not in GEOMETRIES:
        raise reading.source.error(
            "{surface} has type {kind}, which is not read; only {known} are",
            line,
            surface=surface.name,
            kind=geometry,
            known=GEOMETRIES,
        )
    radius, index = values["radius"], values["ior"]
    if geometry in CYLINDERS:
        along_x = geometry == CYLINDERS[0]
        surface.shape = Toroid(radius_y=radius or inf) if along_x else Toroid(radius_x=radius or inf)
    elif radius and geometry != "PLANAR":
        surface.curvature = 1 / radius
    surface.thickness = values["thickness"]
    surface.semi_diameter = values["housing-radius"] if values["housing-radius"] > 0 else inf
    if not radius and geometry != "PLANAR" and index in (0, 1):
        reading.stops[surface.number] = index
    if index not in (0, 1):
        glass = _named(row.get("material", ""), line)
        surface.glass = glass_of_row(glass, row["ior"], values["abbe-no"], surface, reading.sources, reading.notes)
    reading.raw.surfaces.append(surface)


def _named(material: str, line: int) -> RawGlass:
    """Return the glass that SCHOTT_N_PK52A names; one without a name for UNKNOWN."""
    maker, _, name = material.upper().partition("_")
    if material.upper() in ("", "UNKNOWN", "AIR"):
        return RawGlass(line=line)
    return RawGlass(name.replace("_", "-"), (maker,), line=line) if maker in MAKERS else RawGlass(material, line=line)


def _asphere(reading: FxReading, code: str, line: int) -> None:
    place, _, rest = code.partition(":")
    row = number(place, Message("row"), reading.source, line)
    if not (0 <= row < len(reading.raw.surfaces) and row == int(row)):
        raise reading.source.error(
            'aspherical data of "{name}", which is not a row of the lens data', line, name=place[:20]
        )
    surface = reading.raw.surfaces[int(row)]
    for name, value in re.findall(r"\b(\w+)\s*=\s*(\S+)", rest):
        term = number(value, name, reading.source, line)
        if name.lower() == "k":
            surface.conic = term
        elif re.fullmatch(r"a\d{1,2}", name.lower()):
            surface.aspheric[int(name[1:])] = term


def _rows(source: LensText, sources: GlassSources, notes: Notebook, zoom: int) -> RawLens:
    """Return one zoom of a file of rows."""
    raw, scale = RawLens(object_stated=False), 1.0
    for line, text in enumerate(source.lines, 1):
        if text.startswith("#!scale"):
            scale = number((text.split()[1:] or [""])[0], Message("scale"), source, line)
            if not 1e-6 < scale < 1e6:
                raise source.error('{what} "{word}" is not a number; correct it', line, what="#!scale", word=text[8:40])
        elif text.strip() and not text.lstrip().startswith(("#", "//")):
            surface = _row(text, line, len(raw.surfaces) + 1, zoom, FxReading(source, sources, notes, raw))
            surface.thickness, surface.semi_diameter = scale * surface.thickness, scale * surface.semi_diameter
            surface.curvature /= scale
            surface.aspheric = {power: value * scale ** (1 - power) for power, value in surface.aspheric.items()}
            raw.surfaces.append(surface)
    return raw


def _row(text: str, line: int, count: int, zoom: int, reading: FxReading) -> RawSurface:
    code, _, asphere = text.partition("#")
    words = "/".join(part.strip() for part in code.split("/")).split()
    if len(words) < 4:
        raise reading.source.error("a row needs radius, thickness, material and housing radius; complete it", line)

    def value(word: str, what: str) -> float:
        return number(word, what, reading.source, line)

    surface = RawSurface(count, line)
    distances, material = words[1].split("/"), words[2]
    surface.curvature = curvature(words[0], "radius", reading.source, line)
    surface.thickness = value(distances[min(zoom, len(distances) - 1)], "thickness")
    if material.lower().startswith("cx_"):
        raise reading.source.error(
            "{surface} has type {kind}, which is not read; only {known} are",
            line,
            surface=surface.name,
            kind="cx_",
            known=GEOMETRIES,
        )
    if material.lower() == "iris":
        reading.raw.stop, surface.keeps_medium = count, True
    elif material.lower() != "air":
        if len(words) < 6:
            raise reading.source.error("a row of glass needs its name, nd, vd and a housing radius; complete it", line)
        value(words[3], "nd")
        named = RawGlass(material, line=line)
        surface.glass = glass_of_row(named, words[3], value(words[4], "vd"), surface, reading.sources, reading.notes)
    surface.semi_diameter = value(words[-1], "housing radius") or inf
    terms = re.match(r"!aspheric=(\S+)", asphere)
    if terms:
        surface.conic, *orders = (value(word, "aspherical value") for word in terms[1].split(",") if word)
        surface.aspheric = dict(zip(range(4, 12, 2), orders, strict=False))
    return surface
