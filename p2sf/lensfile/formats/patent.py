"""Prescriptions that patent-to-zemax makes of patents: JSON with ``radius_mm``, ``thickness_mm``, ``index_after``.

One wavelength, an index behind every surface, object heights and the numerical aperture at the image.
"""

from math import inf

from p2sf.lens.lens import Lens
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.formats.json_parts import JsonPart, read_json
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawGlass, RawLens, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText

KEYS = (
    *("number", "radius_mm", "thickness_mm", "index_after", "semi_diameter_mm", "asphere", "source_page"),
    *("material_key", "glass", "comment", "label"),
)


def read_patent(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a patent's prescription; LensFileError with its line."""
    top = read_json(source)
    raw = RawLens(title=f"{top.text('patent_id')} {top.values.get('embodiment', '')}".strip()[:200])
    raw.object_distance = top.number("object_distance_mm", default=inf)
    raw.object_stated = "object_distance_mm" in top.values
    raw.object_glass = _object_glass(top)
    for part in top.parts("surfaces", "radius_mm"):
        part.note_unknown(notes, KEYS)
        part.part("asphere").note_unknown(notes, ("conic", "even_coefficients"))
        raw.surfaces.append(_surface(part))
    stop = top.number("stop_surface", default=0.0)
    raw.stop = int(stop) or None
    if raw.stop and not 1 <= raw.stop <= len(raw.surfaces):
        raise source.error("the stop is on the object or the image; put it on a surface between", 1)
    if top.values.get("image_space_na"):
        raw.aperture = "image_na", top.number("image_space_na")
    raw.field_kind = "object_height"
    raw.fields = [(0.0, height) for height in top.part("field").numbers("object_heights_mm")]
    if top.values.get("wavelength_um"):
        raw.wavelengths_um = [top.number("wavelength_um")]
        if not 0.05 <= raw.wavelengths_um[0] <= 50:
            raise source.error("a wavelength is not that of light; give micrometres", 1)
    if top.values.get("total_track_mm") and raw.object_distance < inf:
        raw.state("track", top.number("total_track_mm") - raw.object_distance, 1)
    return assemble(raw, sources, notes, source)


def _object_glass(top: JsonPart) -> RawGlass | None:
    key = top.text("object_space_material_key")
    material = top.part("materials").part(key) if key else top.part("")
    index = material.number("patent_index", default=1.0)
    return None if index == 1 else RawGlass(index=index, line=1)


def _surface(part: JsonPart) -> RawSurface:
    surface = RawSurface(part.surface or 1, part.line)
    surface.curvature, surface.thickness = part.curvature("radius_mm"), part.thickness("thickness_mm")
    surface.semi_diameter = part.number("semi_diameter_mm", default=inf) or inf
    index = part.number("index_after")
    surface.glass = None if index == 1 else RawGlass(index=index, line=part.line)
    shape = part.part("asphere")
    surface.conic = shape.number("conic", default=0.0)
    surface.aspheric = dict(zip(range(4, 44, 2), shape.numbers("even_coefficients")[:20], strict=False))
    return surface
