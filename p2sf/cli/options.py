"""The words that several commands share: how a lens, a setup and an output are asked for."""

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from p2sf.errors import ExportError
from p2sf.files.writing import check_place
from p2sf.request import Request


def _whole(_, tokens) -> int:
    """Return a whole number; cyclopts itself would round 2.5 to 2 and say nothing."""
    try:
        return int(tokens[0].value)
    except ValueError as error:
        raise ValueError(f'"{tokens[0].value}" is no whole number') from error


Whole = Annotated[int, Parameter(converter=_whole)]
LensName = Annotated[str, Parameter(help="A lens file, or the name of a shipped lens (p2sf lenses lists them).")]
Asked = Annotated[Request, Parameter(name="*")]
Json = Annotated[bool, Parameter("--json", negative="", help="Print one JSON object, mm unless a name says otherwise.")]
Output = Annotated[Path | None, Parameter(["--output", "-o"], negative="", help="File to write, by its ending.")]

AS_IN_THE_FILE = Request()


def check_output(output: Path | None, endings: Iterable[str]) -> None:
    """Refuse an unknown ending or a missing folder before the work and not after it; ExportError."""
    if output is None:
        return
    if output.suffix.lower() not in endings:
        raise ExportError(f'--output is {output}, its ending "{output.suffix}" is unknown; choose {", ".join(endings)}')
    check_place(output)
