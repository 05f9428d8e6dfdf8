"""What the window says, in the language of whoever sits at it: write every sentence as ``tr("English")``.

With numbers in it: ``tr("object {height} mm", height=signed(h, 2))``. The English text is the key; the other languages
lie as Qt .ts files in `app.languages`. No Qt in here: Qt's translation is asked only where Qt is loaded, so that
whatever computes without a window speaks English. Titles, tips, axis labels and choices handed to a Card, a Chart, a
chooser or the registry are translated there; only what a panel builds itself needs `tr`.
"""

import sys
from functools import lru_cache

CONTEXT = "p2sf"


def tr(text: str, **values) -> str:
    """Return a text in the present language, ``values`` put into its braces; English where there is no other."""
    said = _translated(text)
    return said.format(**values) if values else said


@lru_cache(maxsize=4096)
def _translated(text: str) -> str:
    core = sys.modules.get("PySide6.QtCore")
    return core.QCoreApplication.translate(CONTEXT, text) if core and text else text


def forget() -> None:
    """Ask Qt anew from now on: the language has changed."""
    _translated.cache_clear()
