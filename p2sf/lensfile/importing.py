"""Read a lens from a file of any known format, recognised by its content, then by its ending."""

import os
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from math import isfinite
from pathlib import Path

from p2sf.errors import LensFileError
from p2sf.lens.lens import Lens
from p2sf.lensfile.agf import Catalogue, read_agf, read_agf_text
from p2sf.lensfile.formats.codev import read_codev
from p2sf.lensfile.formats.csv_table import read_table
from p2sf.lensfile.formats.deeplens import read_deeplens
from p2sf.lensfile.formats.fx import read_fx
from p2sf.lensfile.formats.iset import read_iset_dat, read_iset_json
from p2sf.lensfile.formats.optical_bench import read_optical_bench
from p2sf.lensfile.formats.optiland import read_optiland
from p2sf.lensfile.formats.oslo import read_oslo
from p2sf.lensfile.formats.patent import read_patent
from p2sf.lensfile.formats.ray_optics import read_ray_optics
from p2sf.lensfile.formats.ray_optics_web import read_ray_optics_web
from p2sf.lensfile.formats.zemax import read_zemax
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.report import ImportReport, Notebook
from p2sf.lensfile.source_text import LensText, read_source
from p2sf.lensfile.toml.lens import parse_toml
from p2sf.messages import Message
from p2sf.raytrace.focusing import object_distance


@dataclass(frozen=True)
class Import:
    """A lens read from a file, and what a user should know about the reading."""

    lens: Lens
    report: ImportReport


@dataclass(frozen=True)
class Format:
    """One format: its name, a pattern found in its files only, its file ending, and its reader."""

    name: str
    mark: re.Pattern[str]
    ending: str
    read: Callable[[LensText, GlassSources, Notebook], Lens]


def _read_toml(source: LensText, sources: GlassSources, notes: Notebook) -> Lens:
    notes.add("read", "a lens file of this program, exactly as written")
    return parse_toml(source.text.removeprefix("\ufeff"), source.path)


def _pattern(text: str) -> re.Pattern[str]:
    return re.compile(text, re.IGNORECASE | re.MULTILINE)


def _json(keys: str) -> re.Pattern[str]:
    """Return the mark of a JSON object with one of these keys."""
    return re.compile(rf'\A\s*\{{(?s:.*?)"(?:{keys})"\s*:')


GAP = r"[^\S\n]*+"  # blanks of one line: with \s, blank lines would cost the square of their number
INFINITY = Message("infinity")
STATED = "the file's object is at {depth}, where sources stand unless they are placed elsewhere"
UNSTATED = "the file does not say where its object is; sources stand at {depth} unless they are placed elsewhere"
IN_FOCUS = "the file does not say where its object is; sources stand in focus at {depth} unless placed elsewhere"

# The head of crayg's sections, or a row of an iris.
FX = rf"^{GAP}\[(elements|surfaces)\]|^{GAP}[-+.\deE]++[ \t](?>[-+.\deE/ \t]{{2,}})(?<=[ \t])iris\b"
JSON_ENDINGS = (".json", ".roa")
FORMATS = (
    Format("ray-optics model", re.compile(r'\A\s*\{\s*"optical_model"\s*:'), ".roa", read_ray_optics),
    Format("ray-optics-web (JSON)", _json("curvatureRadius"), ".json", read_ray_optics_web),
    Format("Optiland (JSON)", _json("surface_group"), ".json", read_optiland),
    Format("DeepLens (JSON)", _json("d_next|mat2|d_sensor"), ".json", read_deeplens),
    Format("patent prescription (JSON)", _json("radius_mm"), ".json", read_patent),
    Format("ISET lens (JSON)", _json("surfaces|surfaceArray"), ".json", read_iset_json),
    Format("renderer's lens (.fx)", _pattern(FX), ".fx", read_fx),
    Format("Optical Bench text", _pattern(rf"^{GAP}\[lens data\]"), ".txt", read_optical_bench),
    Format("P2SF lens (TOML)", _pattern(rf"^{GAP}\[\[{GAP}surface{GAP}\]\]"), ".toml", _read_toml),
    Format("Zemax", _pattern(rf"^{GAP}SURF\s{GAP}\d++{GAP}$"), ".zmx", read_zemax),
    Format("OSLO", _pattern(rf"\A\s*+//\s*+OSLO\b|^{GAP}LEN\s{GAP}NEW\b"), ".len", read_oslo),
    Format("CODE V", _pattern(rf"^{GAP}(SO|RDM|LEN|TIT(LE)?)\b[^=,\n]*+$"), ".seq", read_codev),
    Format("table with named columns", _pattern(r"^(?>[^#\n]*?\bradius\b)[^\n]*[,;\t]"), ".csv", read_table),
    Format("ISET lens (.dat)", _pattern(rf"^{GAP}([-+.\deE]++[ \t,]++){{3}}[-+.\deE]++{GAP}$"), ".dat", read_iset_dat),
)


def import_lens(
    path: str | os.PathLike, accept_substitutes: bool = False, catalogues: Iterable[str | os.PathLike | Catalogue] = ()
) -> Import:
    """Return the lens of a file of any known format, and the report on reading it.

    ``catalogues`` are AGF glass catalogues, as paths or as read; those in the file's folder are used as well. Raises
    LensFileError, with its line, for what cannot be read exactly; a substitute glass needs consent.
    """
    source = read_source(path)
    inside = [_tolerant(each) for each in source.beside]
    return import_text(source, GlassSources(_catalogues(path, [*catalogues, *inside]), {}, accept_substitutes))


def import_text(source: LensText, sources: GlassSources) -> Import:
    """Return the lens of a text of any known format, and the report on reading it; LensFileError."""
    found = recognise(source)
    notes = Notebook()
    for catalogue in sources.catalogues:
        notes.add(
            "read",
            "glass catalogue {path} with {count} glasses was found",
            path=catalogue.path,
            count=len(catalogue.glasses),
        )
    lens = found.read(source, sources, notes)
    if lens.name == "lens":
        lens = replace(lens, name=_name(source.path))
    _note_object(lens, notes)
    return Import(lens, ImportReport(source.path, found.name, source.encoding, tuple(notes.notes)))


def _note_object(lens: Lens, notes: Notebook) -> None:
    """Note where a source stands that is not placed elsewhere."""
    depth = object_distance(lens)
    told = STATED if lens.object_distance is not None else IN_FOCUS if isfinite(depth) else UNSTATED
    notes.add("read", told, depth=Message("{value:.6g} mm", value=depth) if isfinite(depth) else INFINITY)


def recognise(source: LensText) -> Format:
    """Return the format of a text: TOML for .toml, else the first whose mark is in the text, else by its ending."""
    ending = Path(source.path).suffix.lower()
    by_ending = {known.ending: known for known in FORMATS}
    if ending == ".toml":
        return by_ending[ending]
    if ending == ".agf" or re.search(r"^NM \S+ \d+", source.text, re.MULTILINE):
        raise source.error("this is a glass catalogue, not a lens; give it beside a lens file", 1)
    is_json = re.match(r"\s*(\{\s*[\"}]|\[\s*[\"{\d])", source.text)
    kinds = [known for known in FORMATS if not is_json or known.ending in JSON_ENDINGS]
    marked = next((known for known in kinds if known.mark.search(source.text)), None)
    if is_json and marked is None:
        names = tuple(known.name for known in kinds)
        raise source.error("this JSON is a lens of none of the known kinds: {formats}", 1, formats=names)
    if marked or ending in by_ending:
        return marked or by_ending[ending]
    raise source.error(
        "the file is in none of the known formats: {formats}", 1, formats=tuple(known.name for known in FORMATS)
    )


def _name(path: str) -> str:
    """Return the name of a lens from its file's stem: lower-case letters, digits, dots and underscores."""
    stem = re.sub(r"[^A-Za-z0-9.]+", "_", Path(path).stem).strip("_.")
    return stem.lower() or "lens"


def _catalogues(path: str | os.PathLike, given: Iterable[str | os.PathLike | Catalogue]) -> tuple[Catalogue, ...]:
    """Return the user's catalogues, then those in the lens's folder, of which an unreadable one is left out."""
    listed = [item if isinstance(item, Catalogue) else read_agf(item) for item in given]
    folder = Path(path).parent
    beside = sorted(item for item in folder.glob("*") if item.suffix.lower() == ".agf")[:50]
    known = {Path(item.path).resolve() for item in listed}
    for item in beside:
        if item.resolve() not in known:
            listed.append(_tolerant(item))
    return tuple(item for item in listed if item.glasses)


def _tolerant(found: Path | LensText) -> Catalogue:
    try:
        return read_agf_text(found) if isinstance(found, LensText) else read_agf(found)
    except LensFileError:
        return Catalogue("", "", {})
