"""`p2sf import --list`: of every lens file in a folder, whether it is read, and where and why not."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from p2sf.cli.screen import print_json, print_table
from p2sf.errors import GeometryError, LensFileError, P2SFError, RequestError
from p2sf.lens.lens import Lens
from p2sf.lens.meridians import meridians
from p2sf.lensfile.agf import Catalogue, read_agf
from p2sf.lensfile.importing import FORMATS, import_lens, recognise
from p2sf.lensfile.source_text import read_source
from p2sf.lensfile.stated import stated_in
from p2sf.messages import Message
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import f_number

# Endings of lens files only; other files are lenses where they bear a format's mark.
CERTAIN = (".zmx", ".zar", ".zos", ".seq", ".roa", ".len", ".fx")


@dataclass(frozen=True)
class FileVerdict:
    """What became of one file: first-order data where it is read, the refusal with its surface and line where not.

    ``focal_length`` in mm and ``f_number`` are those of the reference wavelength; None where the lens has none. Of
    cylinders, toroids and other shapes that are not of revolution they are those in yz, and ``focal_length_x`` is that
    in xz, None where it is the same. ``stated_focal_length``: what the file or a title in it states, mm.
    """

    file: str
    format: str
    opens: bool
    focal_length: float | None = None
    focal_length_x: float | None = None
    f_number: float | None = None
    stated_focal_length: float | None = None
    notes: int = 0
    surface: int | None = None
    line: int | None = None
    reason: Message | None = None


def list_folder(folder: Path, accept_substitutes: bool, catalogues: Sequence[Path], as_json: bool) -> None:
    """Print the verdicts on a folder and the folders in it, as a table with counts or as one JSON object."""
    paths, known = lens_files(folder), [read_agf(path) for path in catalogues]
    found = [verdict(path, str(path.relative_to(folder)), accept_substitutes, known) for path in paths]
    opened = sum(row.opens for row in found)
    if as_json:
        return print_json({"folder": str(folder), "files": [_record(row) for row in found], "opens": opened})
    title = f"{folder}: {opened} of {len(found)} lens files open"
    columns = (
        "file",
        "format",
        "opens",
        "focal length, mm",
        "stated",
        "f-number",
        "notes",
        "surface",
        "line",
        "why not",
    )
    rows = [
        (
            *(r.file, r.format, "yes" if r.opens else "no", _lengths(r), r.stated_focal_length),
            *(r.f_number, r.notes, r.surface, r.line, r.reason),
        )
        for r in found
    ]
    return print_table(title, columns, [tuple("" if cell is None else cell for cell in row) for row in rows])


def _lengths(row: FileVerdict) -> object:
    """Return the focal lengths of a row in one cell."""
    if row.focal_length_x is None:
        return row.focal_length
    return Message("{y:.6g} in y, {x:.6g} in x", y=row.focal_length, x=row.focal_length_x)


def lens_files(folder: Path) -> list[Path]:
    """Return the lens files of a folder and the folders in it, sorted; RequestError for what is no folder."""
    if not folder.is_dir():
        raise RequestError("{path} is not a folder; name one for {parameter}", path=str(folder), parameter="list")
    endings = {*CERTAIN, ".zip", *(known.ending for known in FORMATS)}
    found = (path for path in folder.rglob("*") if path.suffix.lower() in endings and path.is_file())
    return sorted((path for path in found if path.suffix.lower() in CERTAIN or _marked(path)), key=_alphabetical)


def _alphabetical(path: Path) -> str:
    return str(path).lower()


def _marked(path: Path) -> bool:
    """Return whether a file of an ending that is not only lenses' bears the mark of a format."""
    try:
        source = read_source(path)
    except LensFileError:
        return False
    ending = Path(source.path).suffix.lower()  # of the lens inside an archive
    return any(known.mark.search(source.text) for known in FORMATS if known.ending == ending)


def verdict(path: Path, name: str, accept_substitutes: bool, catalogues: Sequence[Catalogue]) -> FileVerdict:
    """Return what becomes of one file, which the list calls ``name``."""
    try:
        found = import_lens(path, accept_substitutes, catalogues)
    except P2SFError as refusal:
        line = refusal.line if isinstance(refusal, LensFileError) else None
        inside = refusal.message.values.get("message", refusal.message)  # without the path and the line
        reason = inside if isinstance(inside, Message) else refusal.message
        surface = next(_surfaces(reason), None)
        return FileVerdict(name, _format(path), False, surface=surface, line=line, reason=reason)
    lens, count = found.lens, len(found.report.notes)
    both = meridians(lens)
    along_y, along_x = (
        float(cardinal_points(each, lens.reference_wavelength_um).effective_focal_length) for each in both
    )
    stated, across = stated_in(found.report, "focal_length"), None if both.x == both.y else along_x
    return FileVerdict(name, found.report.format, True, along_y, across, _f_number(both.y), stated, count)


def _f_number(lens: Lens) -> float | None:
    """Return the focal length over the entrance pupil's diameter; None where the lens has no such pupil."""
    try:
        return float(f_number(lens, lens.reference_wavelength_um))
    except GeometryError:
        return None


def _format(path: Path) -> str:
    """Return the format of a file; nothing where it is not known."""
    try:
        return recognise(read_source(path)).name
    except LensFileError:
        return ""


def _surfaces(message: Message) -> Iterator[int]:
    """Yield every surface that a message or one inside it names."""
    for name, value in message.values.items():
        inside = getattr(value, "message", value)
        if isinstance(inside, Message):
            yield from _surfaces(inside)
        elif name == "surface" and isinstance(value, int):
            yield value


def _record(row: FileVerdict) -> dict[str, Any]:
    return {**asdict(row), "reason": str(row.reason) if row.reason else None}
