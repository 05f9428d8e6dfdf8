"""`p2sf explore`: open the window."""

from importlib.util import find_spec
from typing import Annotated

from cyclopts import Parameter

from p2sf.errors import P2SFError
from p2sf.messages import Message

What = Annotated[str | None, Parameter(help="A lens, or a STATE.json, a snapshot or a p2sf:… link of the explorer.")]


def explore(what: What = None, /) -> int:
    """Open the explorer on a lens, a saved state, a snapshot or a link, else as it was left; return its exit code."""
    missing = [name for name in ("PySide6", "pyqtgraph") if find_spec(name) is None]
    if missing:
        both = Message("{one} and {other}", one=missing[0], other=missing[-1])
        raise P2SFError(
            "the explorer needs {packages}, not installed here; run pip install 'p2sf[app]'",
            packages=both if len(missing) > 1 else missing[0],
        )
    from p2sf_explorer.application.main import main

    return int(main([what] if what else []))
