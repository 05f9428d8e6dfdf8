"""Pages of A4 with texts, tables and axes of matplotlib as PDF, and pages of HTML that need nothing beside them."""

from base64 import b64encode
from collections.abc import Callable, Mapping, Sequence
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WIDE_MM, HIGH_MM, EDGE_MM = 210.0, 297.0, 16.0  # A4
INCH_MM = 25.4
LINE_MM = 4.4
ASCENT = 0.85  # of a letter's height above its baseline, as a share of the size of type
CSS = """body{font:14px/1.45 system-ui,sans-serif;color:#222;background:#fff;
max-width:60em;margin:2em auto;padding:0 1em}
h1{font-size:1.6em;margin:0}h2{font-size:1.1em;margin:1.8em 0 .4em}table{border-collapse:collapse}
td,th{padding:.15em .7em;text-align:right;border-bottom:1px solid #ddd;font-weight:normal}th{color:#666}
td:first-child,th:first-child{text-align:left;padding-left:0}img{max-width:100%}
.pair{display:flex;flex-wrap:wrap;gap:0 3em}
.link{font:11px monospace;word-break:break-all;color:#666}"""


class Sheet:
    """One page of A4, in mm from its left and upper edges; ``y`` is how far it is filled."""

    def __init__(self) -> None:
        from matplotlib.figure import Figure

        self.figure: Figure = Figure(figsize=(WIDE_MM / INCH_MM, HIGH_MM / INCH_MM))
        self.y = EDGE_MM

    def write(self, text: str, size: float = 8.5, bold: bool = False, x: float = EDGE_MM, grey: bool = False) -> None:
        """Write one line, and go on below it."""
        self.put(x, self.y, text, size, bold=bold, grey=grey)
        self.y += LINE_MM * size / 8.5

    def put(
        self,
        x: float,
        y: float,
        text: str,
        size: float = 8.0,
        side: str = "left",
        bold: bool = False,
        grey: bool = False,
    ) -> None:
        """Write a text whose upper corner is at a place."""
        self.figure.text(
            x / WIDE_MM,
            1 - (y if "\n" in text else y + ASCENT * size * INCH_MM / 72) / HIGH_MM,
            text,
            fontsize=size,
            ha=side,
            va="top" if "\n" in text else "baseline",
            color="#666666" if grey else "#222222",
            fontweight="bold" if bold else "normal",
            linespacing=1.15,
            parse_math=False,
        )

    def axes(self, x: float, y: float, wide: float, high: float) -> Any:
        """Return axes in a rectangle."""
        return self.figure.add_axes((x / WIDE_MM, 1 - (y + high) / HIGH_MM, wide / WIDE_MM, high / HIGH_MM))

    def rule(self, y: float, x: float = EDGE_MM, wide: float = WIDE_MM - 2 * EDGE_MM) -> None:
        """Draw a fine line."""
        from matplotlib.lines import Line2D

        ends = x / WIDE_MM, (x + wide) / WIDE_MM
        self.figure.add_artist(Line2D(ends, (1 - y / HIGH_MM,) * 2, color="#cccccc", linewidth=0.4))

    def table(
        self, heads: Sequence[str], rows: Sequence[Sequence[str]], ends: Sequence[float], size: float = 8.0
    ) -> None:
        """Write a table: the first column begins at the left edge, the others end at ``ends``, mm from there."""
        high = LINE_MM * max((head.count("\n") + 1 for head in heads), default=1)
        for row, grey in ((heads, True), *((each, False) for each in rows)):
            for column, text in enumerate(row):
                x = EDGE_MM + (ends[column] if column else 0.0)
                self.put(x, self.y, text, size, "right" if column else "left", grey=grey)
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
