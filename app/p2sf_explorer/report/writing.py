"""A report as a file: pages of PDF, one page of HTML that needs nothing beside it, or JSON."""

from collections.abc import Callable, Sequence
from functools import partial
from html import escape
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np

from p2sf.files.writing import check_known_ending, check_place, plain, write_beside, write_json
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.messages import Message, Style
from p2sf_explorer.compute.matrix.points import heading_texts
from p2sf_explorer.compute.matrix.tiles import figures
from p2sf_explorer.report.contents import LensReport
from p2sf_explorer.report.figures import curve_drawings, draw_lens, draw_matrix, matrix_scale
from p2sf_explorer.report.pages import (
    A4,
    EDGE_MM,
    HEADING,
    LINE_MM,
    Lettering,
    Sheet,
    html_page,
    html_table,
    pdf_of,
    svg_element,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLUMNS = ("surface", "radius, mm", "thickness, mm", "medium", "semi-diameter, mm", "conic", "aspheric terms")
REPORT_STYLE = Style(number=lambda text: text.replace("-", "−").replace("inf", "∞"))
"""English, with the signs of mathematics."""


def write_report(report: LensReport, path: str | Path, words: Style = REPORT_STYLE) -> None:
    """Write a report whole or not at all, by the ending of its name: .pdf, .html or .json.

    Raises ExportError for another ending and for a place that cannot be written.
    """
    output = Path(path)
    check_known_ending(output, WRITERS)
    check_place(output)
    WRITERS[output.suffix.lower()](report, output, words)


def prescription_rows(report: LensReport, words: Style) -> list[list[str]]:
    """Return a row of texts for each surface, its number and the stop first."""
    rows = []
    for number, texts in enumerate(report.prescription.texts, 1):
        mark = f"{number} {Message('stop').text(words)}" if number == report.prescription.stop else str(number)
        beside = report.prescription.beside[number - 1].values()
        notes = "; ".join(note.text(words) for cell in beside for note in cell.words)
        rows.append([mark, *texts[:-1], " ".join(filter(None, (texts[-1], notes)))])
    return rows


def column_heads(words: Style) -> list[str]:
    """Return the headings of the prescription."""
    return [Message(name).text(words) for name in COLUMNS]


def performance_heads(report: LensReport, words: Style) -> list[str]:
    """Return the headings of the table of figures, units in a second line."""
    return ["\n".join(head) for head in report.performance.headings(words)]


def closing_lines(report: LensReport, words: Style) -> list[str]:
    """Return date and versions, and then the data of glasses."""
    made = "P2SF {p2sf} · numpy {numpy} · Python {python}".format(**report.versions)
    return [f"{report.written} · {made}", f"{Message('glass data').text(words)}: {report.versions['glass data']}"]


def matrices(report: LensReport) -> list[tuple[Message, Any]]:
    """Return the headings and the contents of the small pictures."""
    found: list[tuple[Message, Any]] = []
    spots, psfs = report.spots, report.psfs
    side = None if isinstance(spots, Message) else matrix_scale(spots)
    found.append((Message("Spot diagrams, ±{side:.3g} µm", side=side) if side else Message("Spot diagrams"), spots))
    wide = None if isinstance(psfs, Message) else matrix_scale(psfs)
    name = "PSF, {wide:.3g} µm wide, square root of brightness, each relative to its own peak"
    found.append((Message(name, wide=wide) if wide else Message("PSF"), psfs))
    return found


def _pdf_pages(report: LensReport, words: Style) -> list[Sheet]:
    """Return the pages."""
    pages = [*_first_pages(report, words), _curve_page(report, words)]
    for number, (heading, found) in enumerate(matrices(report)):
        pages.append(_matrix_page(heading, found, words, report if number == 1 else None))
    for number, page in enumerate(pages, 1):
        for line, text in enumerate(closing_lines(report, words)):
            page.put(EDGE_MM, A4.high_mm - 13 + 3 * line, text, Lettering(6.0, grey=True))
        page.put(A4.wide_mm - EDGE_MM, A4.high_mm - 13, f"{number}/{len(pages)}", Lettering(6.5, "right", grey=True))
    return pages


TITLE_ROOM = 780.0  # points of type times letters that the width of the page has room for
REASON_LETTERS = 125  # of small type on a line
MOST_ROWS = 24  # of the prescription on the first page; a page of its own holds twice as many
ENDS = 0, 40, 66, 98, 126, 144, 178


def _first_pages(report: LensReport, words: Style) -> list[Sheet]:
    first = Sheet()
    first.write(report.title, Lettering(min(15.0, TITLE_ROOM / max(1, len(report.title))), bold=True))
    first.y += 1
    first.write(report.source.text(words), Lettering(grey=True))
    for line in wrap("; ".join(one.text(words) for one in report.misalignment), REASON_LETTERS):
        first.write(line, Lettering(7, grey=True))
    draw_lens(first.axes(EDGE_MM + 8, first.y + 3, first.inner_mm - 8, 62), report.layout)
    first.y += 78
    first.write(Message("First order").text(words), HEADING)
    top, wide = first.y + 1, (first.inner_mm - 12) / 3
    for column, rows in enumerate(report.first_order):
        x = EDGE_MM + column * (wide + 6)
        for row, (name, value, _) in enumerate(rows):
            y = top + row * LINE_MM
            first.put(x, y, Message(name).text(words), Lettering(7.2, grey=True))
            first.put(x + wide, y, value.text(words), Lettering(7.2, "right"))
            first.rule(y + LINE_MM - 0.9, x, wide)
    first.y = top + LINE_MM * max(map(len, report.first_order)) + 5
    pages, left = [first], prescription_rows(report, words)
    while left:
        page = pages[-1]
        page.write(Message("Prescription").text(words), HEADING)
        room = MOST_ROWS if page is first else 2 * MOST_ROWS
        page.table(column_heads(words), [_cut(row) for row in left[:room]], ENDS, 7.2)
        left = left[room:]
        if left:
            pages.append(Sheet())
    return pages


def _cut(row: Sequence[str]) -> list[str]:
    """Return a row whose last cell fits its column; HTML and JSON have it whole."""
    last = row[-1]
    return [*row[:-1], last if len(last) <= 24 else f"{last[:23]}…"]


def _curve_page(report: LensReport, words: Style) -> Sheet:
    page = Sheet()
    page.write(Message("Performance").text(words), HEADING)
    page.y += 1
    heads = performance_heads(report, words)
    lengths = np.cumsum([max(map(len, [*head.split("\n"), "−00.00"])) for head in heads])
    ends = (page.inner_mm * lengths / lengths[-1]).tolist()
    page.table(heads, report.performance.rows(words), ends, min(7.5, 640.0 / lengths[-1]))
    for line in (line for why in report.performance.reasons for line in wrap(why.text(words), REASON_LETTERS)):
        page.write(line, Lettering(7, grey=True))
    high = (A4.high_mm - 22 - page.y) / 3
    for heading, drawings in curve_drawings(report, words):
        page.put(EDGE_MM, page.y + 4, heading.text(words), HEADING)
        if isinstance(drawings, Message):
            page.put(EDGE_MM, page.y + 11, drawings.text(words))
        else:
            wide = page.inner_mm / len(drawings)
            for number, draw in enumerate(drawings):
                draw(page.axes(EDGE_MM + 12 + number * wide, page.y + 11, wide - 16, high - 24))
        page.y += high
    return page


def _matrix_page(heading: Message, found: Any, words: Style, last: LensReport | None) -> Sheet:
    page = Sheet()
    page.write(heading.text(words), HEADING)
    if isinstance(found, Message):
        page.write(found.text(words))
    else:
        from matplotlib.figure import Figure

        room = 0.08, 0.15 if last else 0.08, 0.96, 0.905
        assert isinstance(page.figure, Figure)
        draw_matrix(page.figure, found, words)
        page.figure.subplots_adjust(*room)
    if last:
        lines = [last.link[start : start + 150] for start in range(0, min(len(last.link), 1350), 150)]
        page.y = A4.high_mm - 34
        page.write(
            Message("Opens in P2SF Explorer: copy this link, then paste it into the window").text(words),
            Lettering(8, bold=True),
        )
        for line in (
            lines
            if len(last.link) <= 1350
            else [Message("the HTML report has the link, which is too long here").text(words)]
        ):
            page.write(line, Lettering(5, grey=True))
    return page


def _write_pdf(report: LensReport, output: Path, words: Style) -> None:
    facts = {"Title": report.title, "Creator": "P2SF Explorer", "Subject": report.source.text(words)}
    document = pdf_of(_pdf_pages(report, words), facts)
    write_beside(output, lambda handle: handle.write(document))


def html_report(report: LensReport, words: Style = REPORT_STYLE) -> str:
    """Return the report as one page of HTML, its pictures inside."""

    def heading(message: Message) -> str:
        return f"<h2>{escape(message.text(words))}</h2>"

    def beside(drawings: "list[Callable[[Any], None]]") -> "Callable[[Figure], None]":
        def draw(figure: "Figure") -> None:
            for one, axes in zip(drawings, np.atleast_1d(figure.subplots(1, len(drawings))), strict=True):
                one(axes)

        return draw

    columns = (html_table((), [(Message(n).text(words), v.text(words)) for n, v, _ in c]) for c in report.first_order)
    parts = [
        f"<h1>{escape(report.title)}</h1><p>{escape(report.source.text(words))}</p>",
        *(f"<p>{escape(one.text(words))}</p>" for one in report.misalignment),
        svg_element(lambda figure: draw_lens(figure.add_subplot(), report.layout), 180, 75),
        heading(Message("First order")),
        f'<div class="pair">{"".join(columns)}</div>',
        heading(Message("Prescription")),
        html_table(column_heads(words), prescription_rows(report, words)),
        heading(Message("Performance")),
        html_table(performance_heads(report, words), report.performance.rows(words)),
        *(f"<p>{escape(why.text(words))}</p>" for why in report.performance.reasons),
    ]
    for name, drawings in curve_drawings(report, words):
        if isinstance(drawings, Message):
            parts += [heading(name), f"<p>{escape(drawings.text(words))}</p>"]
        else:
            parts += [heading(name), svg_element(beside(drawings), 180, 80)]
    for name, found in matrices(report):
        if isinstance(found, Message):
            parts += [heading(name), f"<p>{escape(found.text(words))}</p>"]
        else:
            draw = partial(draw_matrix, found=found, words=words)
            parts += [heading(name), svg_element(draw, 140, 40 * len(found[1]))]
    parts.append(heading(Message("Opens in P2SF Explorer: copy this link, then paste it into the window")))
    parts.append(f'<p class="link">{escape(report.link)}</p>')
    parts += [f"<p>{escape(line)}</p>" for line in closing_lines(report, words)]
    body = "\n".join(parts)
    return html_page(report.title, body)


def _write_html(report: LensReport, output: Path, words: Style) -> None:
    write_beside(output, lambda handle: handle.write(html_report(report, words).encode()))


def report_record(report: LensReport) -> dict[str, Any]:
    """Return the report's numbers by name, mm unless a name says otherwise; null where there is none."""
    table = report.performance

    def curves(found: Any) -> Any:
        if isinstance(found, Message):
            return {"reason": str(found)}
        lines = [{"name": str(line.name), "tangential": line.width > 1, "values": line.values} for line in found.lines]
        return {"axes": list(found.axes), "x": found.x, "curves": lines}

    def cells(found: Any) -> Any:
        if isinstance(found, Message):
            return {"reason": str(found)}
        rows, columns = heading_texts(found[0])
        return {"rows": rows, "columns": columns, "figures": [[str(one) for one in row] for row in figures(found[1])]}

    fields = report.field_curves
    foci = (
        {"reason": str(fields)}
        if isinstance(fields, Message)
        else {
            "field_deg": fields.field_deg,
            "sagittal_mm": fields.real.sagittal,
            "tangential_mm": fields.real.tangential,
            "distortion": fields.heights.distortion,
        }
    )
    record: dict[str, Any] = plain(
        {
            "title": report.title,
            "source": str(report.source),
            "misalignment": [str(one) for one in report.misalignment],
            "date": report.written.isoformat(),
            "versions": report.versions,
            "link": report.link,
            "lens_toml": lens_to_toml(report.prescription.lens),
            "first_order": [{name: str(value) for name, value, _ in column} for column in report.first_order],
            "performance": {
                "field_deg": table.field_deg,
                "frequency_per_mm": table.frequency_per_mm,
                **{
                    name: [getattr(one, name) for one in table.found]
                    for name in vars(table.found[0])
                    if name not in ("frequency_per_mm", "reason")
                },
                "reasons": [str(why) for why in table.reasons],
            },
            "mtf": curves(report.contrast),
            "mtf_through_focus": curves(report.through_focus),
            "field_curves": foci,
            "spots": cells(report.spots),
            "psfs": cells(report.psfs),
        }
    )
    return record


def _write_json(report: LensReport, output: Path, words: Style) -> None:
    write_json(output, report_record(report))


WRITERS: dict[str, Callable[[LensReport, Path, Style], None]] = {
    ".pdf": _write_pdf,
    ".html": _write_html,
    ".json": _write_json,
}
