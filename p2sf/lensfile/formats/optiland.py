"""The JSON files of Optiland: ``surface_group`` with a geometry, a place and the material behind each surface.

Places are those of the vertices in one coordinate system, in mm; the first surface is the object, the last the image.
"""

from math import inf
from pathlib import PureWindowsPath

from p2sf.conventions import NM_PER_UM
from p2sf.glass.media import MIRROR
from p2sf.lens.anamorphic import Toroid
from p2sf.lens.lens import Lens
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.formats.json_parts import JsonPart, read_json
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import PupilEnds, RawApertureKind, RawFieldKind, RawGlass, RawLens, RawSurface, VignettingFactors
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText

APERTURES: dict[str, RawApertureKind] = {
    "EPD": "entrance_pupil_diameter",
    "imageFNO": "image_f_number",
    "objectNA": "object_na",
}
FIELDS: dict[str, RawFieldKind] = {
    "angle": "angle",
    "anglefield": "angle",
    "object_height": "object_height",
    "objectheightfield": "object_height",
    "paraxial_image_height": "image_height",
    "paraxialimageheightfield": "image_height",
    "real_image_height": "real_image_height",
    "realimageheightfield": "real_image_height",
}
POWERS = {"Plane": 0, "StandardGeometry": 0, "Standard": 0, "EvenAsphere": 2, "OddAsphere": 1}  # of r, a step
TOROID = "ToroidalGeometry"  # a biconic is the sum of two curves there, and refused
KEYS = (
    *("type", "geometry", "material_pre", "material_post", "is_stop", "is_reflective", "aperture", "comment"),
    *("interaction_model", "f", "thickness", "surface_type"),
)
UNITS_UM = {"um": 1.0, "nm": 1 / NM_PER_UM, "mm": 1e3}
PLACED = ("x", "y", "rx", "ry", "rz")


def read_optiland(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of an Optiland file; LensFileError with its line for shapes and tilts that are not read."""
    top = read_json(source)
    raw = RawLens(title=top.text("name").removeprefix("None"))
    parts = top.part("surface_group").parts("surfaces", "geometry", 0)
    if len(parts) < 3:
        raise source.error("the file contains no surface between object and image", len(source.lines))
    first, *inside, image = parts
    places = [part.part("geometry").part("cs").number("z", default=0.0) for part in parts]
    raw.object_distance = places[1] - places[0] if abs(places[0]) < FAR else inf
    raw.object_glass = _glass(first)
    for number, part in enumerate(inside, 1):
        part.note_unknown(notes, KEYS)
        raw.surfaces.append(_surface(part, places[number + 1] - places[number]))
        if part.values.get("is_stop"):
            raw.stop = number
    _refuse_tilt(image)
    raw.image = RawSurface(len(inside) + 1, image.line)
    _profile(image.part("geometry"), raw.image)
    _conditions(top, raw, source)
    return assemble(raw, sources, notes, source)


def _refuse_tilt(part: JsonPart) -> None:
    place = part.part("geometry").part("cs")
    if any(place.number(name, default=0.0) for name in PLACED) or place.values.get("reference_cs"):
        part.refuse("surface {surface} is tilted or decentred, which is not read of this format; centre it")


def _surface(part: JsonPart, thickness: float) -> RawSurface:
    _refuse_tilt(part)
    surface = RawSurface(part.surface or 1, part.line, part.text("comment")[:60], thickness=thickness)
    acts = part.part("interaction_model")
    if part.text("type") == "ParaxialSurface" or acts.text("type").startswith("ThinLens"):
        surface.ideal_focal_length = (part if "f" in part.values else acts).number("f", "focal_length")
    elif acts.text("type") not in ("", "RefractiveReflectiveModel"):
        part.refuse("surface {surface} has type {kind}, which is not read", kind=acts.text("type"))
    else:
        _profile(part.part("geometry"), surface)
    reflects = part.values.get("is_reflective") or acts.values.get("is_reflective")
    surface.glass = RawGlass(medium=MIRROR, line=part.line) if reflects else _glass(part)
    rim = part.part("aperture")
    if rim.values and rim.text("type") != "RadialAperture":
        part.refuse(
            "surface {surface} has a rim of type {kind}, which is not read; give a round one", kind=rim.text("type")
        )
    surface.semi_diameter = rim.number("r_max", default=inf) or inf
    surface.inner_radius = rim.number("r_min", default=0.0)
    return surface


def _profile(geometry: JsonPart, surface: RawSurface) -> None:
    kind = geometry.text("type")
    if kind not in (*POWERS, TOROID):
        geometry.refuse(
            "surface {surface} has type {kind}, which is not read; only {known} are", kind=kind, known=(*POWERS, TOROID)
        )
    if kind == TOROID:
        x, y = (1 / c if (c := geometry.curvature(name)) else inf for name in ("radius_x", "radius_y"))
        conic, alphas = geometry.number("conic_yz", default=0.0), tuple(geometry.numbers("coeffs_poly_y"))
        surface.shape = Toroid(radius_x=x, radius_y=y, conic_y=conic, coefficients=alphas)
    elif kind != "Plane":
        surface.curvature = geometry.curvature("radius")
        surface.conic = geometry.number("conic", default=0.0)
        terms = geometry.numbers("coefficients")
        surface.aspheric = {POWERS[kind] * place: value for place, value in enumerate(terms, 1) if value}


def _glass(part: JsonPart) -> RawGlass | None:
    """Return the medium behind a surface: an index, nd and vd, or a name with the maker as its reference or folder."""
    material = part.part("material_post")
    kind = material.text("type")
    if kind == "Mirror":
        return RawGlass(medium=MIRROR, line=part.line)
    if kind == "IdealMaterial" or not material.values:
        index = material.number("index", default=1.0)
        return None if index == 1 else RawGlass(index=index, line=part.line)
    if kind == "AbbeMaterial":
        return RawGlass(model=(material.number("index"), material.number("abbe")), line=part.line)
    if kind not in ("Material", "MaterialFile"):
        part.refuse("surface {surface} has a material of type {kind}, which is not read", kind=kind)
    folders = PureWindowsPath(material.text("filename")).parts
    name = material.text("name") or (folders[-1].rpartition(".")[0] if folders else "")
    stated = (material.text("reference"), material.text("catalog"), *reversed(folders[:-1]))
    return RawGlass(name, tuple(word.upper() for word in stated if word), line=part.line)


def _conditions(top: JsonPart, raw: RawLens, source: LensText) -> None:
    """Read aperture, fields and wavelengths."""
    aperture = top.part("aperture")
    kind = aperture.text("type", "ap_type")
    if kind in APERTURES:
        raw.aperture = APERTURES[kind], aperture.number("value")
    elif kind == "float_by_stop_size" and raw.stop:
        raw.aperture = "stop_semi_diameter", aperture.number("value") / 2
    elif aperture.values:
        raise source.error("the aperture is of type {kind}, which is not read", 1, kind=kind)
    fields = top.part("fields")
    listed = fields.parts("fields") if fields.values else []
    kind = fields.part("field_definition").text("field_type", "type") or fields.text("field_type")
    kind = kind or (listed[0].text("field_type") if listed else "")
    if listed and kind.lower() not in FIELDS:
        raise source.error("the fields are of type {kind}, which is not read", 1, kind=kind)
    raw.field_kind = FIELDS.get(kind.lower(), "angle")
    raw.fields = [(field.number("x", default=0.0), field.number("y", default=0.0)) for field in listed]
    factors = ((field.number("vx", default=0.0), field.number("vy", default=0.0)) for field in listed)
    raw.vignetting = VignettingFactors(tuple(PupilEnds(y, y, x) for x, y in factors))
    raw.telecentric = bool(fields.values.get("telecentric") or fields.values.get("object_space_telecentric"))
    for place, wave in enumerate(top.part("wavelengths").parts("wavelengths")):
        raw.wavelengths_um.append(
            wave.number("value", "_value") * UNITS_UM.get(wave.text("unit", "_unit") or "um", 1.0)
        )
        raw.weights.append(wave.number("weight", default=1.0))
        if wave.values.get("is_primary"):
            raw.primary = place
    if not all(0.05 <= value <= 50 for value in raw.wavelengths_um):
        raise source.error("a wavelength is not that of light; give micrometres", 1)
