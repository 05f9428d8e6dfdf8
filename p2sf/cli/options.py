"""Options that several commands share: the lens, the request, the samples and the output."""

import re
from collections.abc import Iterable
from os.path import exists, samefile
from pathlib import Path
from types import NoneType
from typing import Annotated, Any, get_args

from cyclopts import App, ArgumentCollection, CoercionError, Parameter

from p2sf.errors import RequestError
from p2sf.files.writing import check_known_ending, check_place
from p2sf.setting import Request, Settings

WHOLE = re.compile(r"\s*[+-]?\d+\s*")


def check_whole_numbers(app: App, commands: tuple[str, ...], arguments: ArgumentCollection) -> None:
    """Raise CoercionError for a value of a whole number that is none; cyclopts itself would silently round 2.5 to 2."""
    for argument in arguments:
        for token in argument.tokens if _kinds(argument.hint) <= {int, NoneType} else ():
            if not WHOLE.fullmatch(token.value):
                words = f'"{token.value}" is no whole number'
                raise CoercionError(msg=words, argument=argument, token=token, target_type=int)


def _kinds(hint: Any) -> set[Any]:
    """Return the types of the values of a type, which may be a union, or a tuple or a list of others."""
    parts = get_args(hint)
    return set().union(*map(_kinds, parts)) if parts else {hint}


LensName = Annotated[str, Parameter(help="A lens file, or the name of a shipped lens (p2sf lenses lists them).")]
Asked = Annotated[Request, Parameter(name="*")]
CameraFlags = Annotated[Settings, Parameter(name="*")]
Json = Annotated[bool, Parameter("--json", negative="", help="Print one JSON object, mm unless a name says otherwise.")]
Output = Annotated[Path | None, Parameter(["--output", "-o"], negative="", help="File to write, by its ending.")]
Threads = Annotated[
    int | None,
    Parameter(help="How many threads share the work; P2SF_THREADS, else every core, when not given."),
]

LENS_ENDINGS = ".toml", ".zmx", ".seq", ".json"  # of lens files that are written
AS_IN_THE_FILE = Request()
AS_IN_ITS_FILE = Settings()


def check_output(output: Path | None, endings: Iterable[str], *inputs: str | Path | None) -> None:
    """Raise ExportError for an unknown ending or a missing folder, RequestError for an input; call before the work."""
    if output is None:
        return
    check_known_ending(output, endings)
    check_place(output)
    for path in inputs:
        if path is not None and exists(path) and exists(output) and samefile(path, output):
            raise RequestError(
                "{parameter} is {path}, which would overwrite the input {input}; choose another name",
                parameter="output",
                path=str(output),
                input=str(path),
            )
