"""The handbook's pages as text: their headings, their formulas, and what a formula looks like. No Qt in here."""

import re
import unicodedata
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parent
PAGES = {
    "find": "Find it in two minutes",
    "install": "Install",
    "tutorial": "Tutorial",
    "first_lecture": "How to give the first lecture",
    "import": "Import a lens",
    "lens_files": "Write a lens file",
    "export": "Export",
    "measure": "Measure a lens",
    "camera": "A camera in Python",
    "build": "Build a lens in Python",
    "gallery": "Gallery",
    "notebook": "In a notebook",
    "theory": "Theory",
    "numerics": "Numerical accuracy",
    "speed": "Speed",
    "plans": "Plans",
    "window": "The window",
    "panels": "Panels",
}
# What is code has no formulas, whatever dollar signs it has.
CODE = r"^```.*?^```$|`[^`\n]+`"
FORMULA = re.compile(rf"{CODE}|\$\$(.+?)\$\$|\$([^$\n]+?)\$", re.DOTALL | re.MULTILINE)
COMMENT = re.compile(r"^<!--.*?-->\n+", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"^!\[[^]]*\]\((pictures|made)/([\w.]+)\)$", re.MULTILINE)
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


ENGLISH = "en"


@lru_cache(maxsize=16)
def page(name: str, language: str = ENGLISH) -> str:
    """Return a page's Markdown, in English where it is not `translated`; ``name`` is a key of `PAGES`."""
    folder = FOLDER / language if translated(name, language) else FOLDER
    return (folder / f"{name}.md").read_text(encoding="utf-8")


def translated(name: str, language: str) -> bool:
    """Return whether a page is there in a language other than English, as a file of a folder named after that."""
    return language != ENGLISH and (FOLDER / language / f"{name}.md").is_file()


def window_page(name: str, language: str = ENGLISH) -> str:
    """Return a page for the window: without marks for those who run its code, and without pictures of the window.

    Such pictures are made for the site, when it is built; in the window the thing itself is there to be seen.
    """
    return PICTURE.sub(lambda found: "" if found[1] == "made" else found[0], COMMENT.sub("", page(name, language)))


def pictures(text: str) -> tuple[str, ...]:
    """Return the names of a page's pictures, files in the folder ``pictures``."""
    return tuple(name for folder, name in PICTURE.findall(text) if folder == "pictures")


def anchor(heading: str) -> str:
    """Return what a link to a heading has behind ``#``, as Python-Markdown and GitHub make it of the heading's text."""
    plain = unicodedata.normalize("NFKD", heading).encode("ascii", "ignore").decode()
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", plain).strip().lower())


def headings(text: str) -> tuple[Heading, ...]:
    """Return the headings of a page in their order."""
    found = ((len(marks), words.strip()) for marks, words in HEADING.findall(text))
    return tuple(Heading(level, words, (NUMBER.match(words) or [""])[0]) for level, words in found)


def heading_in(name: str, heading: str, language: str) -> str:
    """Return the heading of a page in a language that stands where the English one does; another text as it is."""
    texts = [[one.text for one in headings(page(name, of))] for of in (ENGLISH, language)]
    return texts[1][texts[0].index(heading)] if heading in texts[0] else heading


def formulas(text: str) -> tuple[str, ...]:
    """Return the formulas of a page, each once, as they stand between dollar signs."""
    found: dict[str, None] = {}

    def note(formula: str, _block: bool) -> str:
        found[formula] = None
        return ""

    with_formulas(text, note)
    return tuple(found)


def with_formulas(text: str, replace: Callable[[str, bool], str]) -> str:
    """Return a page with what ``replace(formula, on a line of its own)`` returns in place of each formula."""

    def replaced(found: re.Match[str]) -> str:
        formula = found[1] or found[2]
        return replace(" ".join(formula.split()), bool(found[1])) if formula else found[0]

    return FORMULA.sub(replaced, text)


def with_pictures(text: str, link: str = "formula:") -> str:
    """Return a page with a picture in place of each formula; the n-th of `formulas` is named ``formula:n``."""
    known = {formula: number for number, formula in enumerate(formulas(text))}

    def picture(formula: str, block: bool) -> str:
        name = f"![formula]({link}{known[formula]})"
        return f"\n\n{name}\n\n" if block else name

    return with_formulas(text, picture)


@lru_cache(maxsize=512)
def render_formula(formula: str, size_px: float) -> Formula:
    """Return a formula by matplotlib's mathtext at a font size in pixels; ValueError for one it does not know."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.mathtext import MathTextParser

    # At 72 dots per inch a point is a pixel.
    drawn = MathTextParser("agg").parse(
        f"${formula}$", dpi=72, prop=FontProperties(size=size_px, math_fontfamily="dejavusans")
    )
    return Formula(np.asarray(drawn.image, dtype=float) / 255, float(drawn.depth))
