"""Zemax .zmx prescriptions: one keyword a line, surface lines indented under SURF n (OpticStudio manual, "ZMX").

Surface numbers are the file's: SURF 0 is the object, the last SURF the image, so SURF 1 is surface 1.
"""

from math import inf

from p2sf.lens.lens import Lens
from p2sf.lensfile import zemaxwords
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.conjugates import FAR
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawGlass, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText
from p2sf.lensfile.zemaxlines import IN_SYSTEM, ON_SURFACE, Reading, begin_surface


def read_zemax(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a .zmx file; LensFileError with its line for what P2SF does not trace.

    Refused by surface number and name: mirrors, gratings, coordinate breaks, toroids, gradients,
    non-sequential parts, black boxes, decentred or non-circular clear rims, and any unknown type.
    """
    reading = Reading(source, notes)
    for reading.line, text in enumerate(source.lines, 1):
        words = text.split()
        if words:
            _read_line(reading, words, text.strip())
    _finish(reading)
    return assemble(reading.raw, sources, notes, source)


def _read_line(reading: Reading, words: list[str], text: str) -> None:
    keyword = words[0].upper()
    if keyword == "SURF":
        begin_surface(reading, words)
    elif reading.surfaces and keyword in ON_SURFACE:
        ON_SURFACE[keyword](reading, words)
    elif keyword in IN_SYSTEM:
        IN_SYSTEM[keyword](reading, words)
    elif keyword == "NAME":
        reading.raw.title = text[4:].strip().strip('"')
    elif keyword == "COMM" and reading.surfaces:
        reading.surface.label = text[4:].strip()
    else:
        zemaxwords.note(reading.notes, words, reading.surface.number if reading.surfaces else None, reading.line)


def _finish(reading: Reading) -> None:
    """Put together what the order of lines left apart."""
    raw = reading.raw
    if len(reading.surfaces) < 3:
        raise reading.source.error("the file holds no surface between object and image", len(reading.source.lines))
    for surface in reading.surfaces:
        if surface.glass and surface.glass.name:
            surface.glass = RawGlass(
                surface.glass.name, reading.catalogues, beside=surface.glass.beside, line=surface.glass.line
            )
        _shape(reading, surface)
    first, *raw.surfaces, image = reading.surfaces
    raw.object_distance, raw.object_glass = first.thickness, first.glass
    if not abs(raw.object_distance) < FAR:
        raw.object_distance = inf
    if image.curvature:
        reading.notes.add(
            "caution", "the image surface is curved in the file; the sensor here is flat", None, image.line
        )
    if raw.stop in (0, image.number):
        raise reading.source.error("the stop is on the object or the image; put it on a surface between", image.line)
    if raw.aperture and raw.aperture[0] == "stop_semi_diameter":
        raw.aperture = None  # float by stop size: the stop's rim, which is what a lens without aperture gets
    if reading.wavelength_count:
        raw.wavelengths_um = raw.wavelengths_um[: reading.wavelength_count]
    longest = max(len(reading.x_fields), len(reading.y_fields))
    count = min(reading.field_count or longest, longest)
    padded = [[*values, *[0.0] * count][:count] for values in (reading.x_fields, reading.y_fields)]
    raw.fields = list(zip(*padded, strict=True))


def _shape(reading: Reading, surface: RawSurface) -> None:
    """Give an even asphere its terms, and let a coordinate break pass only where it breaks nothing."""
    parameters = reading.parameters.get(surface.number, {})
    kind = reading.kinds.get(surface.number, "STANDARD")
    if kind == "COORDBRK" and any(parameters.values()):
        why = "is a coordinate break (tilt or decentre); only centred lenses are read"
        raise reading.source.error(f"{surface.name} {why}", surface.line)
    if kind == "EVENASPH":
        surface.aspheric = {2 * place: value for place, value in parameters.items() if value}
