"""CODE V .seq files: commands of three letters.

Numbers after S are radius (or curvature, RDM N, which is what a file without RDM means), thickness, glass.
Surfaces count from 1; the object is SO, the image SI.
"""

import re
from math import inf

from p2sf.lens.lens import Lens
from p2sf.lensfile import codevwords as words_of
from p2sf.lensfile.assemble import assemble
from p2sf.lensfile.codevlines import (
    FIELD_KINDS,
    IN_SYSTEM,
    ON_SURFACE,
    ONE_LETTER,
    Reading,
    curved,
    distance,
    read_glass,
    read_private,
)
from p2sf.lensfile.codevtext import Command, commands
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.raw import RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText


def read_codev(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    """Return the lens of a .seq file; LensFileError with its line for what P2SF does not trace.

    Refused by surface number and name: reflections, tilts and decentres, diffractive, toric and other
    surfaces that are not spheres, conics or even aspheres.
    """
    reading = Reading(source, notes)
    for command in commands(source):
        _run(reading, command)
    _finish(reading)
    private = {**sources.private, **reading.private}
    return assemble(reading.raw, GlassSources(sources.catalogues, private, sources.accept_substitutes), notes, source)


def _run(reading: Reading, command: Command) -> None:
    if reading.in_private and command.name != "END":
        read_private(reading, command)
    elif re.fullmatch(r"S(O|I|S|\d+)?", command.name):
        _surface(reading, command)
    else:
        _dispatch(reading, command, command.name if command.name in ONE_LETTER else command.name[:3])


def _dispatch(reading: Reading, command: Command, name: str) -> None:
    command, surface = _addressed(reading, command)
    if name in words_of.REFUSED:
        _refuse_unless_nothing(reading, command, surface, words_of.REFUSED[name])
    elif name in ON_SURFACE:
        if surface is None:
            raise reading.source.error(f"{command.name} stands before any surface; put it after one", command.line)
        ON_SURFACE[name](reading, command, surface)
    elif name in IN_SYSTEM:
        IN_SYSTEM[name](reading, command)
    elif name[:1] in "XY" and name[1:] in FIELD_KINDS:
        reading.fields[name] = reading.numbers(command, "field")
        reading.raw.field_line = command.line
    else:
        words_of.note(reading.notes, name, command.words, surface.number if surface else None, command.line)


def _addressed(reading: Reading, command: Command) -> tuple[Command, RawSurface | None]:
    """Return the command without its surface qualifier (S3, SI, SO), and the surface it speaks of."""
    if command.words and re.fullmatch(r"S(O|I|S|\d+)", command.words[0], re.I):
        surface = _named(reading, command.words[0][1:].upper(), command)
        return Command(command.name, command.words[1:], command.line), surface
    return command, reading.current


def _named(reading: Reading, name: str, command: Command) -> RawSurface | None:
    if name in ("I", "S"):
        return reading.image if name == "I" else reading.current
    place = 0 if name == "O" else int(name[:6])
    if place >= len(reading.surfaces):
        raise reading.source.error(f"{command.name} speaks of surface {place}, which is not there yet", command.line)
    return reading.surfaces[place]


def _refuse_unless_nothing(reading: Reading, command: Command, surface: RawSurface | None, why: str) -> None:
    """Refuse a tilt, a decentre, a grating; a plain zero says that there is none."""
    if command.words and all(re.fullmatch(r"[+-]?0*\.?0*([eE][+-]?\d+)?", word) and word for word in command.words):
        return
    where = surface.name if surface and surface.number else "the lens"
    if reading.image is surface and surface is not None:
        where = "the image surface"
    raise reading.source.error(f"{where} {why} ({command.name}); only centred refracting lenses are read", command.line)


def _surface(reading: Reading, command: Command) -> None:
    """Read S radius thickness glass; SO is the object, SI the image, S3 the third surface."""
    name = command.name[1:]
    if name == "I":
        reading.image = surface = RawSurface(len(reading.surfaces), command.line)
    elif name == "O":
        reading.surfaces[0] = surface = RawSurface(0, command.line)
    elif name.isdigit() and int(name[:6]) < len(reading.surfaces):
        surface = reading.surfaces[int(name)]
        surface.glass = None
    else:
        if name.isdigit() and int(name[:6]) != len(reading.surfaces):
            raise reading.source.error(f"surface {name} stands where {len(reading.surfaces)} is due", command.line)
        surface = RawSurface(len(reading.surfaces), command.line)
        reading.surfaces.append(surface)
    reading.current = surface
    surface.curvature = curved(reading.number(command, 0, "radius", 0.0), reading.radii)
    surface.thickness = distance(reading, reading.number(command, 1, "thickness", 0.0), surface, command.line)
    for word in command.words[2:]:
        read_glass(reading, Command("GLA", (word,), command.line), surface)


def _finish(reading: Reading) -> None:
    """Put together what the order of commands left apart."""
    raw = reading.raw
    first, *raw.surfaces = reading.surfaces
    raw.object_distance, raw.object_glass = first.thickness, first.glass
    if first.line is None:
        raw.object_distance = inf
    if not raw.surfaces:
        raise reading.source.error("the file holds no surface (S) between object and image", len(reading.source.lines))
    if reading.image is not None:
        raw.surfaces[-1].thickness += reading.image.thickness  # defocus
        if reading.image.curvature:
            reading.notes.add("caution", "the image surface is curved in the file; the sensor here is flat")
    if raw.stop is None:
        raw.stop = 1
        reading.notes.add("read", "no stop (STO) is stated; surface 1 is the stop, which is what CODE V takes")
    if not 1 <= raw.stop <= len(raw.surfaces):
        raise reading.source.error("the stop is on the object or the image; put it on a surface between", first.line)
    _gather_fields(reading)


def _gather_fields(reading: Reading) -> None:
    kinds = dict.fromkeys(name[1:] for name in reading.fields)
    if not kinds:
        return
    kind = next((kind for kind in kinds if any(reading.fields.get(f"{axis}{kind}", [0.0])[0:] for axis in "XY")), "AN")
    columns = [reading.fields.get(f"{axis}{kind}", []) for axis in "XY"]
    count = max(map(len, columns))
    padded = [[*column, *[0.0] * count][:count] for column in columns]
    reading.raw.field_kind, reading.raw.fields = FIELD_KINDS[kind], list(zip(*padded, strict=True))
