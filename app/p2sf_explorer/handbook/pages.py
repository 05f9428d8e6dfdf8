"""The handbook's pages as text: their headings, their formulas, and what a formula looks like. No Qt in here."""

import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parent
PAGES = {
    "theory": "Theory",
    "numerics": "Numerical accuracy",
    "speed": "Speed",
    "plans": "Plans",
    "window": "The window",
}
FORMULA = re.compile(r"\$\$(.+?)\$\$|\$([^$\n]+?)\$", re.DOTALL)
HEADING = re.compile(r"^(#+) +(.*)$", re.MULTILINE)
NUMBER = re.compile(r"^(\d+(?:\.\d+)?)\b")


@dataclass(frozen=True)
class Heading:
    """One heading: its level from 1, its text, and the number it begins with, "" without one."""

    level: int
    text: str
    number: str


@dataclass(frozen=True, eq=False)
class Formula:
    """A rendered formula: opacity 0 to 1, (rows, columns), rows from the top, and how far it hangs below the line."""

    opacity: np.ndarray
    depth: float


@lru_cache(maxsize=8)
def page(name: str) -> str:
    """Return a page's Markdown; ``name`` is a key of `PAGES`."""
    return (FOLDER / f"{name}.md").read_text(encoding="utf-8")


def headings(text: str) -> tuple[Heading, ...]:
    """Return the headings of a page in their order."""
    found = ((len(marks), words.strip()) for marks, words in HEADING.findall(text))
    return tuple(Heading(level, words, (NUMBER.match(words) or [""])[0]) for level, words in found)


def formulas(text: str) -> tuple[str, ...]:
    """Return the formulas of a page, each once, as they stand between dollar signs."""
    return tuple(dict.fromkeys(" ".join((block or inline).split()) for block, inline in FORMULA.findall(text)))


def with_pictures(text: str, link: str = "formula:") -> str:
    """Return a page with a picture in place of each formula; the n-th of `formulas` is named ``formula:n``."""
    known = {formula: number for number, formula in enumerate(formulas(text))}

    def picture(found: re.Match[str]) -> str:
        name = f"![formula]({link}{known[' '.join((found[1] or found[2]).split())]})"
        return f"\n\n{name}\n\n" if found[1] else name

    return FORMULA.sub(picture, text)


@lru_cache(maxsize=512)
def rendered(formula: str, size_px: float) -> Formula:
    """Return a formula by matplotlib's mathtext at a font size in pixels; ValueError for one it does not know."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.mathtext import MathTextParser

    # At 72 dots per inch a point is a pixel.
    drawn = MathTextParser("agg").parse(
        f"${formula}$", dpi=72, prop=FontProperties(size=size_px, math_fontfamily="dejavusans")
    )
    return Formula(np.asarray(drawn.image, dtype=float) / 255, float(drawn.depth))
