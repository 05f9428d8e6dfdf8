"""`p2sf import`: a lens from another program's file, with a report on what was read and how; or a whole folder's."""

from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from p2sf.cli.options import LENS_ENDINGS, Json, Output, check_output
from p2sf.cli.screen import print_json, text
from p2sf.cli.verdicts import list_folder
from p2sf.errors import RequestError
from p2sf.lensfile.importing import Import, import_lens

Consent = Annotated[bool, Parameter(negative="", help="Take the substitute glasses that are offered, and report them.")]
Glasses = Annotated[list[Path] | None, Parameter("--agf", negative="", help="AGF glass catalogue; may be repeated.")]


Whole = Annotated[
    bool,
    Parameter("--list", negative="", help="Take a folder, and say of every lens file in it whether it is read."),
]


def import_(
    file: Path,
    *,
    output: Output = None,
    accept_substitutes: Consent = False,
    agf: Glasses = None,
    whole_folder: Whole = False,
    as_json: Json = False,
) -> None:
    """Read a lens of Zemax, CODE V, OSLO, ray-optics, Optiland, DeepLens … or CSV; write .toml, .zmx, .seq or .json."""
    if whole_folder:
        if output is not None:
            raise RequestError("{parameter} is for one lens, not for the list of a folder", parameter="output")
        return list_folder(file, accept_substitutes, agf or (), as_json)
    found = import_lens(file, accept_substitutes, agf or ())
    if output is not None:
        check_output(output, LENS_ENDINGS, file)
        from p2sf.lensfile.writing import write_lens

        write_lens(found.lens, output)
    if as_json:
        return print_json(record(found, output))
    for line in found.report.lines():
        print(text(line))
    return print(f"written: {output}") if output else None


def record(found: Import, output: Path | None) -> dict[str, Any]:
    """Return the report of one import as plain values."""
    report = found.report
    notes = [{"kind": n.kind, "text": str(n.message), "surface": n.surface, "line": n.line} for n in report.notes]
    written = str(output) if output else None
    return {
        "path": report.path,
        "format": report.format,
        "encoding": report.encoding,
        "notes": notes,
        "output": written,
    }
