"""What the window says, in the language of whoever sits at it: write every sentence as ``tr("English")``.

With numbers in it: ``tr("object {height} mm", height=signed(h, 2))``. The English text is the key; the other languages
lie as Qt .ts files in ``i18n/languages``. No Qt in here: Qt's translation is asked only where Qt is loaded, so that
whatever computes without a window speaks English. Titles, tips, axis labels and choices handed to a Card, a Chart, a
chooser or the registry are translated there; only what a panel builds itself needs `tr`.
"""

import re
import sys
from functools import lru_cache

CONTEXT = "p2sf"
UNITS = "%|[kMGn]?m|[µm]m|cm|ms|s|dB|λ|kB|MiB|GiB|waves?|Wellen?|rays|Strahlen|numbers|Zahlen|PSFs"
GAP = re.compile(rf"(?<=[\d∞]) (?=(?:{UNITS})(?![^\W_]))|(?<=[≥≤≈]) (?=[−\d])")


_per_language: list = []


def cached_per_language(size: int):
    """Return `functools.lru_cache` of this size for a function of translated texts; a new language empties it."""

    def decorate(function):
        cached = lru_cache(maxsize=size)(function)
        _per_language.append(cached)
        return cached

    return decorate


def tr(text: str, **values) -> str:
    """Return a text in the present language, ``values`` put into its braces; English where there is no other."""
    said = _translated(text)
    return said.format(**values) if values else said


@cached_per_language(4096)
def _translated(text: str) -> str:
    core = sys.modules.get("PySide6.QtCore")
    return core.QCoreApplication.translate(CONTEXT, text) if core and text else text


@lru_cache(maxsize=512)
def unbroken(text: str) -> str:
    """Return a text that no line end parts from its unit or from its ≥ where a number stands: for labels that wrap."""
    return GAP.sub("\u00a0", text)


def forget() -> None:
    """Ask Qt anew from now on: the language has changed."""
    for cached in _per_language:
        cached.cache_clear()
