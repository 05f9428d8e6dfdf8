"""The JSON files of DeepLens: surfaces with ``roc``, ``d_next``, ``mat2``, ``k`` and ``ai``; lengths in mm.

``mat2`` is "nd/vd" or a name. ``ai`` begins with the coefficient of r², or with r⁴ where ``use_ai2`` is false; keys
such as ``ai4`` name the power themselves. Names in parentheses are comments of the program that writes the file; they
count where nothing else states the number.
"""

import re

from p2sf.lens.lens import Lens
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.formats.json_parts import JsonPart, read_json
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.stated import StatedKind
from p2sf.messages import Message

TERM = re.compile(r"ai[1-9]\d?")
STOPS, ROUND = ("stop", "aperture"), ("spheric", "spherical", "aspheric", "plane")
IDEAL = ("thinlens", "paraxial")
STATED: dict[str, StatedKind] = {"foclen": "focal_length", "fnum": "f_number"}
AIR = ("", "air", "vacuum", "occluder")
KEYS = (
    *("idx", "type", "r", "roc", "c", "k", "ai", "use_ai2", "mat1", "mat2", "d", "d_next", "is_square", "diffraction"),
    *("foclen", "f", "f0", "pos_xy", "vec_local"),
)
TOP_KEYS = (
    *("info", "foclen", "fnum", "r_sensor", "r_last", "d_sensor", "sensor_size", "sensor_res", "surfaces", "DOE"),
    *("hfov", "rfov", "imgh", "units"),
)
FIELD_SHARES = (0.0, 0.7, 1.0)
# nd and vd that DeepLens has for names that glass makers do not sell, or sell as something else.
PLASTICS = {
    "okp4": (1.6328, 23.34),
    "okp4ht": (1.6328, 23.34),
    "apl5014cl": (1.5445, 55.99),
    "coc": (1.5337, 56.22),
    "pmma": (1.4918, 57.44),
    "pc": (1.5855, 29.91),
    "polycarb": (1.5855, 29.91),
    "ps": (1.5904, 30.87),
    "polystyr": (1.5904, 30.87),
}


def read_deeplens(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a DeepLens file; LensFileError with its line for shapes that are not read."""
    top = read_json(source)
    top.note_unknown(notes, TOP_KEYS)
    _check_doe(top.part("DOE"), source)
    raw = RawLens(title=top.text("info").removeprefix("None"), object_stated=False)
    parts = top.parts("surfaces", "type")
    for part in parts:
        part.note_unknown(notes, (*KEYS, *filter(TERM.fullmatch, part.values)))
        raw.surfaces.append(_surface(part, notes))
        if _kind(part) in STOPS:
            raw.stop = raw.stop or part.surface
    _distances(parts, raw.surfaces, top)
    for name, kind in STATED.items():
        if top.values.get(name):
            raw.state(kind, top.number(name), _line_of(source, name))
    size = top.numbers("sensor_size") or top.numbers("(sensor_size)")
    height = top.number("r_sensor", "r_last", default=sum(side**2 for side in size) ** 0.5 / 2)
    if height:
        raw.field_kind, raw.fields = "image_height", [(0.0, -share * height) for share in FIELD_SHARES]  # upwards
    return assemble(raw, sources, notes, source)


def _check_doe(part: JsonPart, source: LensText) -> None:
    """Raise LensFileError for a diffractive element behind the lens, unless all orders of its phase are 0."""
    orders = [part.number(name) for name in part.values if re.fullmatch(r"order\d+", name)]
    if part.values and (any(orders) or not orders):
        raise source.error(
            "the lens has a diffractive element (DOE) of type {kind}, which is not read; take the block out to read "
            "the lens without it",
            _line_of(source, "DOE"),
            kind=part.text("type") or Message("nothing"),
        )


def _line_of(source: LensText, name: str) -> int:
    return next((n for n, text in enumerate(source.lines, 1) if f'"{name}"' in text), 1)


def _kind(part: JsonPart) -> str:
    return part.text("type").lower()


def _surface(part: JsonPart, notes: Notebook) -> RawSurface:
    kind = _kind(part)
    if kind not in (*STOPS, *ROUND, *IDEAL):
        part.refuse(
            "surface {surface} has type {kind}, which is not read; only {known} are",
            kind=part.text("type") or Message("nothing"),
            known=(*ROUND, *STOPS, *IDEAL),
        )
    if any(part.numbers("pos_xy")) or part.numbers("vec_local")[:2] not in ([], [0.0, 0.0]):
        part.refuse("surface {surface} is tilted or decentred (pos_xy, vec_local), which is not read; centre it")
    surface = RawSurface(part.surface or 1, part.line, semi_diameter=part.number("r", default=0.0))
    surface.semi_diameter = surface.semi_diameter or float("inf")
    if part.values.get("is_square"):
        told = "its rim is square; a round one of the same half-width is used instead"
        notes.add("caution", told, part.surface, part.line)
    if kind in ROUND and kind != "plane":
        stated = "roc" in part.values
        surface.curvature = part.curvature("roc") if stated else part.number("c", "(c)", default=0.0)
        surface.conic = part.number("k", "(k)", default=0.0)
        surface.aspheric = _terms(part)
    if kind in IDEAL:
        surface.ideal_focal_length = part.number("foclen", "f", "f0")
    if kind in STOPS:
        surface.keeps_medium = True
    else:
        surface.glass = _glass(part)
    return surface


def _terms(part: JsonPart) -> dict[int, float]:
    """Return the coefficient of each power of r."""
    named = {int(name[2:]): part.number(name) for name in part.values if TERM.fullmatch(name)}
    if named:
        return named
    listed = part.numbers("ai")
    first = 2 if part.values.get("use_ai2", True) else 4
    return {first + 2 * place: value for place, value in enumerate(listed) if value}


def _glass(part: JsonPart) -> RawGlass | None:
    name = part.text("mat2")
    if name.lower() in AIR:
        return None
    pair = re.fullmatch(r"(\d+(?:\.\d*)?)\s*/\s*(\d+(?:\.\d*)?)", name)
    model = (float(pair[1]), float(pair[2])) if pair else PLASTICS.get(name.lower())
    if model:
        return RawGlass(model=model, line=part.line)
    return RawGlass(name, line=part.line)


def _distances(parts: list[JsonPart], surfaces: list[RawSurface], top: JsonPart) -> None:
    """Give every surface its distance to the next: ``d_next``, else the difference of the places ``d``."""
    places = [part.number("d", "(d)", default=0.0) for part in parts]
    places.append(top.number("d_sensor", "(d_sensor)", default=places[-1] if places else 0.0))
    for number, (part, surface) in enumerate(zip(parts, surfaces, strict=True)):
        surface.thickness = part.thickness("d_next", default=places[number + 1] - places[number])
