"""Texts of the window in the language of the person at it: write every text as ``tr("English")``.

With numbers in it: ``tr("object {height} mm", height=signed(h, 2))``. The English text is the key; the other languages
lie as Qt .ts files in ``i18n/languages``. No Qt in here: Qt's translation is asked only where Qt is loaded, so that
whatever computes without a window speaks English. Titles, tips, axis labels and choices handed to a Card, a Chart, a
chooser or the registry are translated there; only what a panel builds itself needs `tr`.
"""

import re
import sys
from collections.abc import Callable
from functools import lru_cache
from typing import TypeVar

T = TypeVar("T")

CONTEXT = "p2sf"
UNITS = "%|[kMGn]?m|[µm]m|cm|ms|s|dB|λ|kB|MiB|GiB|waves?|Wellen?|rays|Strahlen|numbers|Zahlen|PSFs"
DECIMAL = re.compile(r"(?<![\w.])(\d+)\.(\d+)(?!\d*\.\w)")  # no part of a name, a version or a section
GAP = re.compile(rf"(?<=[\d∞]) (?=(?:{UNITS})(?![^\W_]))|(?<=[≥≤≈]) (?=[−\d])")


_cache_clears: list[Callable[[], None]] = []


def cached_per_language(size: int) -> Callable[[Callable[..., T]], Callable[..., T]]:
    """Return `functools.lru_cache` of this size for a function of translated texts; a new language empties it."""

    def decorate(function: Callable[..., T]) -> Callable[..., T]:
        cached = lru_cache(maxsize=size)(function)
        _cache_clears.append(cached.cache_clear)
        return cached

    return decorate


def tr(text: str, **values: object) -> str:
    """Return a text in the present language, ``values`` put into its braces; English where there is no other."""
    said = _translate(text)
    return local(said.format(**values)) if values else said


@cached_per_language(1)
def decimal_separator() -> str:
    """Return what stands before the decimals of a number in the present language."""
    found = _translate("decimal separator")
    return "." if found == "decimal separator" else found


def local(text: str) -> str:
    """Return a text with the decimal separator of the present language in its numbers, names such as "a1.5" kept.

    What is painted and what a readout, an axis, a value field or a table shows comes through here; what is copied or
    written to a file does not.
    """
    separator = decimal_separator()
    return text if separator == "." or "." not in text else DECIMAL.sub(rf"\1{separator}\2", text)


@cached_per_language(4096)
def _translate(text: str) -> str:
    core = sys.modules.get("PySide6.QtCore")
    if not core or not text:
        return text
    translated: str = core.QCoreApplication.translate(CONTEXT, text)
    return translated


@lru_cache(maxsize=512)
def unbroken(text: str) -> str:
    """Return a text in which no line breaks between a number and its unit, or ≥ and its number."""
    return GAP.sub("\u00a0", text)


def forget() -> None:
    """Clear the caches: the language has changed."""
    for clear in _cache_clears:
        clear()
