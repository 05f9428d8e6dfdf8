"""The notebooks of the handbook as pages of the site, with what their cells show. No Qt in here."""

import ast
import json
from collections.abc import Iterator
from contextlib import chdir, redirect_stdout
from io import BytesIO, StringIO
from tempfile import TemporaryDirectory
from typing import Any

from p2sf_explorer.handbook.pages import FOLDER

NOTEBOOKS = FOLDER / "notebooks"
SHOWN = ("camera",)
"""Those that are pages: the others take minutes."""


def notebook_cells(name: str) -> list[tuple[str, str]]:
    """Return the cells of a notebook, ("markdown" or "code", text)."""
    cells = json.loads((NOTEBOOKS / f"{name}.ipynb").read_text(encoding="utf-8"))["cells"]
    return [(cell["cell_type"], "".join(cell["source"])) for cell in cells]


def notebook_text(name: str) -> str:
    """Return a notebook as Markdown, without what its cells show."""
    return _page(name, [[] for _ in notebook_cells(name)])


def notebook_page(name: str) -> tuple[str, dict[str, bytes]]:
    """Run a notebook and return it as Markdown, and the pictures that it shows by their names.

    Raises whatever a cell raises.
    """
    pictures: dict[str, bytes] = {}
    results: list[list[str]] = []
    names: dict[str, Any] = {"__name__": name}
    with TemporaryDirectory() as folder, chdir(folder):
        for number, (kind, text) in enumerate(notebook_cells(name)):
            printed, drawn = _run(text, names) if kind == "code" else ("", [])
            own = {f"{name}_{number}_{count}.png": picture for count, picture in enumerate(drawn)}
            pictures |= own
            shown = [f"![What the cell draws](../made/{path})" for path in own]
            results.append(shown + [f"<!-- not run: printed -->\n```text\n{printed}\n```"] * bool(printed))
    return _page(name, results), pictures


def _page(name: str, results: list[list[str]]) -> str:
    """Return a notebook as Markdown, behind every cell what it shows."""
    head = f"The file is [`{name}.ipynb`](../notebooks/{name}.ipynb)."
    parts: list[str] = []
    for (kind, text), shown in zip(notebook_cells(name), results, strict=True):
        parts.append(text if kind == "markdown" else f"<!-- not run: as a notebook -->\n```python\n{text}\n```")
        parts.extend(shown)
    return "\n\n".join([parts[0], head, *parts[1:]]) + "\n"


def _run(text: str, names: dict[str, Any]) -> tuple[str, list[bytes]]:
    """Run a cell and return what it prints and the pictures it draws; the value of its last line counts too."""
    from matplotlib import pyplot

    tree, printed, last = ast.parse(text), StringIO(), None
    tail = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    with redirect_stdout(printed):
        exec(compile(tree, names["__name__"], "exec"), names)
        if isinstance(tail, ast.Expr):
            last = eval(compile(ast.Expression(tail.value), names["__name__"], "eval"), names)
    pictures = [*_own_picture(last), *_figures(pyplot)]
    if last is not None and not pictures:
        printed.write(f"{last!r}\n")
    return printed.getvalue().rstrip(), pictures


def _own_picture(value: object) -> Iterator[bytes]:
    show = getattr(value, "_repr_png_", None)
    if show is not None and (picture := show()) is not None:
        yield picture


def _figures(pyplot: Any) -> Iterator[bytes]:
    """Yield the open figures as PNG, and close them."""
    for number in pyplot.get_fignums():
        written = BytesIO()
        pyplot.figure(number).savefig(written, format="png", dpi=90)
        pyplot.close(number)
        yield written.getvalue()
