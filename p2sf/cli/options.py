"""The words that several commands share: how a lens, a setup and an output are asked for."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from p2sf.request import Request

LensName = Annotated[str, Parameter(help="A lens file, or the name of a shipped lens (p2sf lenses lists them).")]
Asked = Annotated[Request, Parameter(name="*")]
Json = Annotated[bool, Parameter("--json", negative="", help="Print one JSON object, mm unless a name says otherwise.")]
Output = Annotated[Path | None, Parameter(["--output", "-o"], negative="", help="File to write, by its ending.")]

AS_IN_THE_FILE = Request()
