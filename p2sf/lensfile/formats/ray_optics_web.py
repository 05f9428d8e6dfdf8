"""The JSON files of ray-optics-web: ``specs``, ``object``, ``image`` and ``surfaces`` with ``curvatureRadius``; mm.

Decentres have the kinds and signs of ray-optics, angles in degrees.
"""

from math import inf

from p2sf.conventions import NM_PER_UM
from p2sf.errors import GeometryError
from p2sf.glass.media import MIRROR
from p2sf.lens.grating import Grating
from p2sf.lens.lens import Lens
from p2sf.lens.tilts import Breaks, decentred_surface
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.formats.json_parts import JsonPart, read_json
from p2sf.lensfile.formats.ray_optics import APERTURES, CURVED, DECENTRES, FIELDS, grating
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, number
from p2sf.messages import Message

KEYS = (
    *("label", "curvatureRadius", "thickness", "medium", "manufacturer", "semiDiameter", "aspherical", "decenter"),
    *("diffractionGrating", "diffractiveElement"),
)
TOP_KEYS = "setAutoAperture", "specs", "object", "image", "surfaces"
STEPS = {"Conic": 0, "EvenAspherical": 2, "RadialPolynomial": 1}  # powers of r from one coefficient to the next


def read_ray_optics_web(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a ray-optics-web file; LensFileError for shapes that are not round."""
    top = read_json(source)
    top.note_unknown(notes, TOP_KEYS)
    raw = RawLens()
    raw.object_distance = top.part("object").number("distance", default=inf)
    if not abs(raw.object_distance) < FAR:
        raw.object_distance = inf
    raw.object_stated = "distance" in top.part("object").values
    raw.object_glass = _glass(top.part("object"))
    for part in top.parts("surfaces", "curvatureRadius"):
        part.note_unknown(notes, KEYS)
        raw.surfaces.append(_surface(part))
        if part.text("label").lower() == "stop":
            raw.stop = part.surface
    image = JsonPart(top.part("image").values, source, 1, len(raw.surfaces) + 1)
    raw.sensor_before, _ = _breaks(image)
    raw.image = RawSurface(len(raw.surfaces) + 1, curvature=image.curvature("curvatureRadius", default=0.0))
    _shape(image, raw.image)
    _conditions(top.part("specs"), raw, source)
    return assemble(raw, sources, notes, source)


def _surface(part: JsonPart) -> RawSurface:
    label = part.text("label")
    surface = RawSurface(part.surface or 1, part.line, "" if label in ("Default", "Stop") else label[:60])
    surface.curvature, surface.thickness = part.curvature("curvatureRadius"), part.thickness("thickness")
    surface.semi_diameter = part.number("semiDiameter", default=inf) or inf
    surface.before, surface.after = _breaks(part)
    _shape(part, surface)
    surface.glass = _glass(part)
    surface.diffraction = _grating(part, surface)
    return surface


def _shape(part: JsonPart, surface: RawSurface) -> None:
    shape = part.part("aspherical")
    if not shape.values:
        return
    kind = shape.text("kind")
    if kind not in STEPS:
        part.refuse(
            "surface {surface} has type {kind}, which is not read; only {known} are", kind=kind, known=tuple(STEPS)
        )
    surface.conic = shape.number("conicConstant", default=0.0)
    terms = shape.numbers("polynomialCoefficients")
    surface.aspheric = {STEPS[kind] * place: value for place, value in enumerate(terms, 1) if value}


def _grating(part: JsonPart, surface: RawSurface) -> Grating | None:
    """Return the grating of a plane, whose normal is that of ray-optics, y; LensFileError for other diffraction."""
    if part.values.get("diffractiveElement"):
        part.refuse("surface {surface} diffracts, which is not read of this format")
    stated = part.part("diffractionGrating")
    if not stated.values:
        return None
    if surface.curvature:
        raise part.source.error(CURVED, part.line, surface=surface.name)
    reflects = surface.glass is not None and surface.glass.medium == MIRROR
    return grating(stated.number("lpmm"), stated.number("order", default=1.0), (0.0, 1.0), reflects)


def _breaks(part: JsonPart) -> Breaks:
    tilt = part.part("decenter")
    if not tilt.values:
        return (), ()
    kind = tilt.text("coordinateSystemStrategy")
    if kind not in DECENTRES:
        told = "surface {surface} is tilted by {kind}, which is not read; only {known} are"
        part.refuse(told, kind=kind[:20], known=tuple(DECENTRES))
    dec = (tilt.number("offsetX", default=0.0), tilt.number("offsetY", default=0.0), 0.0)
    alpha, beta, gamma = (tilt.number(name, default=0.0) for name in ("alpha", "beta", "gamma"))
    try:
        return decentred_surface(DECENTRES[kind], dec, (alpha, beta, gamma))
    except GeometryError as failure:
        part.refuse("surface {surface}: {error}", error=failure)


def _glass(part: JsonPart) -> RawGlass | None:
    """Return the medium: air, REFL, an index, nd and vd, or a name with its maker."""
    name = part.text("medium")
    if name.lower() in ("", "air"):
        return None
    if name.upper() == "REFL":
        return RawGlass(medium=MIRROR, line=part.line)
    try:
        index = float(name)
    except ValueError:
        return RawGlass(name, tuple(part.text("manufacturer").upper().split())[:1], line=part.line)
    abbe = part.text("manufacturer")
    if abbe:
        model = index, number(abbe, Message("Abbe number"), part.source, part.line)
        return RawGlass(model=model, line=part.line)
    return None if index == 1 else RawGlass(index=index, line=part.line)


def _conditions(specs: JsonPart, raw: RawLens, source: LensText) -> None:
    pupil, view, light = specs.part("pupil"), specs.part("field"), specs.part("wavelengths")
    kind = pupil.text("space"), pupil.text("type")
    if kind not in APERTURES:
        raise source.error("the aperture is of type {kind}, which is not read", 1, kind=" ".join(kind))
    raw.aperture = APERTURES[kind], abs(pupil.number("value"))
    kind = view.text("space"), view.text("type")
    if kind not in FIELDS:
        raise source.error("the fields are of type {kind}, which is not read", 1, kind=" ".join(kind))
    raw.field_kind = FIELDS[kind]
    scale = view.number("maxField", default=1.0) if view.values.get("isRelative") else 1.0
    raw.fields = [(0.0, scale * y) for y in view.numbers("fields")]
    for place, row in enumerate(light.values.get("weights") or ()):
        pair = JsonPart({"weights": row}, source, 1, place + 1).numbers("weights")
        if len(pair) != 2:
            raise source.error("a wavelength is not a pair of nanometres and weight; correct it", 1)
        raw.wavelengths_um.append(pair[0] / NM_PER_UM)
        raw.weights.append(pair[1])
    if not all(0.05 <= value <= 50 for value in raw.wavelengths_um):
        raise source.error("a wavelength is not that of light; give nanometres", 1)
    raw.primary = int(light.number("referenceIndex", default=0.0))
