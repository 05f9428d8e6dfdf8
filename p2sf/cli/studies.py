"""`p2sf paper`: the paper's two figures, redone on this machine."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from p2sf.cli.options import Json
from p2sf.cli.screen import print_json, print_table
from p2sf.errors import ExportError
from p2sf.export import write_beside, write_json

Folder = Annotated[Path, Parameter(["--output", "-o"], negative="", help="Folder for the figures, made if missing.")]


def paper(*, folder: Folder = Path("paper"), as_json: Json = False) -> None:
    """Redo the paper's figures: stage times against refracting elements, and R² against field; PNG and JSON."""
    from p2sf.paper import draw_accuracy, draw_timing, paper_figures

    _make(folder)
    figures = paper_figures()
    write_json(folder / "paper.json", figures)
    write_beside(folder / "paper_timing.png", lambda handle: draw_timing(handle, figures))
    write_beside(folder / "paper_accuracy.png", lambda handle: draw_accuracy(handle, figures))
    if as_json:
        return print_json(figures)
    title = f"R² against the Huygens sum, {figures['lens']}, {figures['wavelength_nm']} nm"
    fields = tuple(f"{row['field_deg']:g}°" for row in figures["accuracy"])
    methods = figures["accuracy"][0]["r_squared"]
    rows = [(name, *(f"{row['r_squared'][name]:.5f}" for row in figures["accuracy"])) for name in methods]
    print_table(title, ("method", *fields), rows)
    print(figures["finding"])
    return print(f"written: paper.json, paper_timing.png and paper_accuracy.png in {folder}")


def _make(folder: Path) -> None:
    """Make the folder; ExportError when there cannot be one."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ExportError(
            f"--output is {folder}, and that folder cannot be made ({error.strerror}); choose another"
        ) from error
