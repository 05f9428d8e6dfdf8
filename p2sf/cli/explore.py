"""`p2sf explore`: open the window, or say in one sentence why not."""

from importlib.util import find_spec
from typing import Annotated

from cyclopts import Parameter

from p2sf.errors import P2SFError

What = Annotated[str | None, Parameter(help="A lens, or a STATE.json, a snapshot or a p2sf:… link of the explorer.")]


def explore(what: What = None, /) -> int:
    """Open the explorer on a lens, a saved state, a snapshot or a link, else as it was left; return its exit code."""
    missing = [name for name in ("PySide6", "pyqtgraph") if find_spec(name) is None]
    if missing:
        raise P2SFError(f"the explorer needs {' and '.join(missing)}, not installed here; run pip install 'p2sf[app]'")
    from p2sf_explorer.__main__ import main

    return main([what] if what else [])
