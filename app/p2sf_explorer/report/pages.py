"""Pages with texts, tables and axes of matplotlib as PDF, and pages of HTML that need nothing beside them."""

import re
from base64 import b64encode
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure

EDGE_MM = 16.0
INCH_MM = 25.4
LINE_MM = 4.4
ASCENT = 0.85  # of a letter's height above its baseline, as a share of the size of type
LINE_SIZES = LINE_MM / 8.5  # the height of a line of type, mm for each point of its size
CSS = """body{font:14px/1.45 system-ui,sans-serif;color:#222;background:#fff;
max-width:60em;margin:2em auto;padding:0 1em}
h1{font-size:1.6em;margin:0}h2{font-size:1.1em;margin:1.8em 0 .4em}table{border-collapse:collapse}
td,th{padding:.15em .7em;text-align:right;border-bottom:1px solid #ddd;font-weight:normal}th{color:#666}
td:first-child,th:first-child{text-align:left;padding-left:0}img{max-width:100%}
.pair{display:flex;flex-wrap:wrap;gap:0 3em}
.link{font:11px monospace;word-break:break-all;color:#666}"""


@dataclass(frozen=True)
class Paper:
    """The size of a page, mm."""

    wide_mm: float
    high_mm: float


A4, LETTER = Paper(210.0, 297.0), Paper(215.9, 279.4)
PAPERS = {"a4": A4, "letter": LETTER}


@dataclass(frozen=True)
class Lettering:
    """How a text is written: the size in points, the side that its place is at, weight, slope and colour."""

    size: float = 8.5
    side: str = "left"
    bold: bool = False
    italic: bool = False
    grey: bool = False

    @property
    def line_mm(self) -> float:
        """Return the height of a line."""
        return LINE_SIZES * self.size

    def wide_mm(self, text: str) -> float:
        """Return how wide a text is, mm."""
        return _wide_at_100(text, self.bold, self.italic) * self.size / 100 * INCH_MM / 72


PLAIN_TEXT, HEADING = Lettering(), Lettering(10.5, bold=True)


@lru_cache(maxsize=10_000)
def _wide_at_100(text: str, bold: bool, italic: bool) -> float:
    """Return the width of a text of 100 points, points."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    face = FontProperties(weight="bold" if bold else "normal", style="italic" if italic else "normal", size=100)
    wide, _, _ = text_to_path.get_text_width_height_descent(text, face, ismath=False)
    return float(wide)


Line = list[tuple[str, Lettering]]
"""The parts of a line, each with its lettering."""
PART = re.compile(r"[^ \n]+")  # a space that keeps a number beside its unit parts no words
MARKED = re.compile(r"\*\*(\S(?:.*?\S)?)\*\*|\*(\S(?:.*?\S)?)\*")


def wrap_lines(text: str, lettering: Lettering, wide_mm: float) -> list[Line]:
    """Return a paragraph of Markdown as lines that are no wider than ``wide_mm``; a longer word has its own line."""
    lines: list[Line] = [[]]
    filled, space = 0.0, lettering.wide_mm(" ")
    for word in _words(text, lettering):
        wide = sum(look.wide_mm(part) for part, look in word)
        if lines[-1] and filled + space + wide > wide_mm:
            lines.append([])
            filled = 0.0
        elif lines[-1]:
            word[0] = " " + word[0][0], word[0][1]
            filled += space
        for part, look in word:
            if lines[-1] and lines[-1][-1][1] == look:
                lines[-1][-1] = lines[-1][-1][0] + part, look
            else:
                lines[-1].append((part, look))
        filled += wide
    return lines if lines[-1] else []


def _words(text: str, lettering: Lettering) -> list[Line]:
    """Return the words of Markdown, each as parts of one lettering: *Field*, with its comma has two."""
    words: list[Line] = []
    ended = True  # the piece before, with a space
    looks = lettering, replace(lettering, bold=True), replace(lettering, italic=True)
    for turn, piece in enumerate(MARKED.split(text)):  # plain, bold, italic, plain …
        for number, part in enumerate(PART.findall(piece or "")):
            if number or ended or piece[0].isspace():
                words.append([])
            words[-1].append((part, looks[turn % 3]))
        ended = piece[-1].isspace() if piece else ended
    return words


class Sheet:
    """One page, in mm from its left and upper edges; ``y`` is how far it is filled."""

    def __init__(self, paper: Paper = A4) -> None:
        from matplotlib.figure import Figure

        self.paper = paper
        self.figure: Figure = Figure(figsize=(paper.wide_mm / INCH_MM, paper.high_mm / INCH_MM))
        self.y = EDGE_MM

    @property
    def inner_mm(self) -> float:
        """Return the width between the edges."""
        return self.paper.wide_mm - 2 * EDGE_MM

    def write(self, text: str, lettering: Lettering = PLAIN_TEXT, x: float = EDGE_MM) -> None:
        """Write one line, and go on below it."""
        self.put(x, self.y, text, lettering)
        self.y += lettering.line_mm

    def put(self, x: float, y: float, text: str, lettering: Lettering = PLAIN_TEXT, url: str | None = None) -> None:
        """Write a text whose upper corner is at a place."""
        size = lettering.size
        self.figure.text(
            x / self.paper.wide_mm,
            1 - (y if "\n" in text else y + ASCENT * size * INCH_MM / 72) / self.paper.high_mm,
            text,
            fontsize=size,
            ha=lettering.side,
            va="top" if "\n" in text else "baseline",
            color="#666666" if lettering.grey else "#222222",
            fontweight="bold" if lettering.bold else "normal",
            fontstyle="italic" if lettering.italic else "normal",
            linespacing=1.15,
            parse_math=False,
            url=url,
        )

    def write_line(self, line: Line, x: float = EDGE_MM) -> None:
        """Write a line of parts, and go on below it."""
        for text, lettering in line:
            self.put(x, self.y, text, lettering)
            x += lettering.wide_mm(text)
        self.y += max(lettering.line_mm for _, lettering in line)

    def axes(self, x: float, y: float, wide: float, high: float) -> Any:
        """Return axes in a rectangle."""
        across, up = self.paper.wide_mm, self.paper.high_mm
        return self.figure.add_axes((x / across, 1 - (y + high) / up, wide / across, high / up))

    def rule(self, y: float, x: float = EDGE_MM, wide: float | None = None) -> None:
        """Draw a fine line, to the right edge where it is not said how wide."""
        from matplotlib.lines import Line2D

        across, end = self.paper.wide_mm, self.paper.wide_mm - EDGE_MM if wide is None else x + wide
        level = 1 - y / self.paper.high_mm
        self.figure.add_artist(Line2D((x / across, end / across), (level, level), color="#cccccc", linewidth=0.4))

    def table(
        self, heads: Sequence[str], rows: Sequence[Sequence[str]], ends: Sequence[float], size: float = 8.0
    ) -> None:
        """Write a table: the first column begins at the left edge, the others end at ``ends``, mm from there."""
        high = LINE_MM * max((head.count("\n") + 1 for head in heads), default=1)
        for row, grey in ((heads, True), *((each, False) for each in rows)):
            for column, text in enumerate(row):
                x = EDGE_MM + (ends[column] if column else 0.0)
                self.put(x, self.y, text, Lettering(size, "right" if column else "left", grey=grey))
            self.y += high if grey else LINE_MM
            self.rule(self.y - 0.9)


def pdf_of(pages: Sequence[Sheet], facts: Mapping[str, str]) -> bytes:
    """Return pages as a PDF document; ``facts``: Title, Creator and Subject."""
    from matplotlib import rc_context
    from matplotlib.backends.backend_pdf import PdfPages

    made = BytesIO()
    with rc_context({"pdf.fonttype": 42}):  # fonts as outlines that can be searched and copied
        with PdfPages(made, metadata=dict(facts)) as document:
            for page in pages:
                document.savefig(page.figure)
    return made.getvalue()


def svg_element(draw: "Callable[[Figure], object]", wide_mm: float, high_mm: float) -> str:
    """Return a drawing as an HTML element that holds it."""
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure

    figure = Figure(figsize=(wide_mm / INCH_MM, high_mm / INCH_MM), layout="constrained")
    draw(figure)
    made = BytesIO()
    canvas: Any = FigureCanvasSVG(figure)
    canvas.print_svg(made, metadata={"Date": None})
    return f'<img alt="" src="data:image/svg+xml;base64,{b64encode(made.getvalue()).decode()}">'


def html_table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return texts as a table; a heading may have two lines."""
    head = "".join(f"<th>{escape(text).replace(chr(10), '<br>')}</th>" for text in heads)
    body = "".join(f"<tr>{''.join(f'<td>{escape(text)}</td>' for text in row)}</tr>" for row in rows)
    return f"<table>{f'<thead><tr>{head}</tr></thead>' if heads else ''}<tbody>{body}</tbody></table>"


def html_page(title: str, body: str) -> str:
    """Return a page with its style."""
    return (
        f'<!DOCTYPE html><html><head><meta charset="utf-8"><title>{escape(title)}</title>'
        f"<style>{CSS}</style></head><body>\n{body}\n</body></html>\n"
    )
