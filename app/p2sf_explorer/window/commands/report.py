"""A report of one page on a lens at the present source: drawing, first order, coefficients, PSFs over the field."""

from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QBuffer, QIODevice, QMarginsF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFont, QImage, QPageSize, QPainter, QPdfWriter, QPen, QPolygonF

from p2sf.files.writing import write_beside
from p2sf_explorer.charts.plots import as_indices, lookup
from p2sf_explorer.charts.theme import LIGHT, tokens
from p2sf_explorer.compute.brightness import stretch
from p2sf_explorer.compute.layout import Layout
from p2sf_explorer.compute.live import Live, live
from p2sf_explorer.compute.setup import prescription
from p2sf_explorer.compute.views.first_order import described_depth, rows
from p2sf_explorer.i18n.messages import WINDOW, said
from p2sf_explorer.i18n.tr import local, tr, unbroken
from p2sf_explorer.state.scales import significant, with_sign
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.terms import FORMULAS, TERMS, WORDS
from p2sf_explorer.widgets.thumbnail import glass
from p2sf_explorer.window.lens_cards import shown_title

PAGE = QSizeF(210.0, 297.0)  # A4, mm; everything below is in mm
MARGIN, DPI = 15.0, 300
SHARES = (0.0, 0.35, 0.7, 1.0)  # of the widest field
POINT = 25.4 / 72  # mm
NAMES = {"w40": "W40", "w31": "W31", "w22": "W22", "w20": "W20", "wd": "Wd", "w11": "W11"}
RAY_COLOURS = {"marginal": LIGHT.marginal, "chief": LIGHT.chief, "rim": LIGHT.chief}


@dataclass(frozen=True)
class ReportPage:
    """The painter of a page in mm."""

    painter: QPainter
    scale: float

    def write(self, room: QRectF, words: str, points: float = 9.0, bold: bool = False, side: int = -1) -> None:
        """Write words into a rectangle, at its left (−1), middle (0) or right (1)."""
        font = QFont("Sans Serif")
        font.setPixelSize(round(points * POINT * self.scale))
        font.setBold(bold)
        self.painter.setFont(font)
        flags = {-1: Qt.AlignmentFlag.AlignLeft, 0: Qt.AlignmentFlag.AlignHCenter, 1: Qt.AlignmentFlag.AlignRight}
        box = self.pixels(room)
        self.painter.setPen(QColor(LIGHT.text))
        how = flags[side] | Qt.AlignmentFlag.AlignVCenter | Qt.TextFlag.TextWordWrap
        self.painter.drawText(box, how, unbroken(local(tr(words))))

    def pixels(self, room: QRectF) -> QRectF:
        """Return a rectangle in the painter's own unit."""
        return QRectF(*(self.scale * v for v in (room.x(), room.y(), room.width(), room.height())))

    def pen(self, colour: str, mm: float) -> None:
        """Draw lines of a width from now on."""
        self.painter.setPen(QPen(QColor(colour), self.scale * mm))

    def lines(self, z: ArrayLike, y: ArrayLike, closed: bool = False) -> None:
        """Draw a line, or a filled region, through points."""
        places = zip(self.scale * np.asarray(z, float), self.scale * np.asarray(y, float), strict=True)
        points = QPolygonF([QPointF(a, b) for a, b in places])
        self.painter.drawPolygon(points) if closed else self.painter.drawPolyline(points)


def write_report(state: State, path: str) -> None:
    """Write the page as PDF, whole or not at all; P2SFError when it cannot be computed or written."""
    answers = [live(at) for at in (state, *fields(state))]
    document = pdf(answers[0], answers[1:])
    write_beside(path, lambda handle: handle.write(document))


def pdf(answer: Live, over_field: list[Live]) -> bytes:
    """Return the page as a PDF document, made in memory since Qt does not report a full disk."""
    made = QBuffer()
    made.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = QPdfWriter(made)
    writer.setPageSize(QPageSize(QPageSize.PageSizeId.A4))
    writer.setPageMargins(QMarginsF(0, 0, 0, 0))
    writer.setResolution(DPI)
    writer.setTitle(answer.setup.lens.name)
    painter = QPainter(writer)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    paint(ReportPage(painter, DPI / 25.4), answer, over_field)
    painter.end()
    return bytes(made.data().data())


def fields(state: State) -> tuple[State, ...]:
    """Return the state at the fields whose PSFs are printed: from the axis to the widest of the lens file."""
    widest = prescription(state).widest_field_deg
    return tuple(change(state, field_deg=share * widest) for share in SHARES)


def paint(page: ReportPage, answer: Live, over_field: list[Live]) -> None:
    """Paint the page, top to bottom."""
    state, wide = answer.state, PAGE.width() - 2 * MARGIN
    page.write(QRectF(MARGIN, 12, wide, 9), shown_title(state), 16, bold=True)
    source = tr("{depth}, field {field}°, {wavelength} nm", depth=described_depth(state.optics.depth_mm).text(WINDOW),
                field=with_sign(state.optics.field_deg, 2), wavelength=f"{state.optics.wavelength_nm:.1f}")  # fmt: skip
    page.write(QRectF(MARGIN, 21, wide, 6), f"{source} · {said(answer.dominant)}", 9)
    draw_layout(page, answer.layout, QRectF(MARGIN, 30, wide, 62))
    heading(page, 95, tr("First order"))
    figures = [(tr(name), value.text(WINDOW)) for name, value, _ in rows(answer)]
    pairs(page, figures, QRectF(MARGIN, 103, 0.46 * wide, 60))
    page.write(QRectF(MARGIN + 0.54 * wide, 95, 0.46 * wide, 6), tr("Coefficients"), 11, bold=True)
    pairs(page, _coefficients(answer), QRectF(MARGIN + 0.54 * wide, 103, 0.46 * wide, 36))
    heading(page, 170, tr("PSF over the field"))
    side = (wide - 3 * 5) / 4
    for number, one in enumerate(over_field):
        draw_psf(page, one, QRectF(MARGIN + number * (side + 5), 178, side, side))
    scale = tr(SCALE_WORDS[state.display.psf_scale])
    note = tr("Each PSF relative to its own peak, {scale}; W11 moves the image and is left out.", scale=scale)
    page.write(QRectF(MARGIN, 236, wide, 5), note, 8)
    page.write(QRectF(MARGIN, 242, wide, 10), answer.why.text(WINDOW), 8)
    page.write(QRectF(MARGIN, 281, wide, 5), "P2SF Explorer", 7, side=1)


def _coefficients(answer: Live) -> list[tuple[str, str]]:
    values = {term: float(getattr(answer.setup.coefficients, term)) for term in TERMS}
    return [(f"{NAMES[t]}  {tr(WORDS[t])}, {FORMULAS[t]}", f"{with_sign(values[t], 3)} λ") for t in TERMS]


SCALE_WORDS = {"linear": "linear brightness", "sqrt": "square root of brightness", "log": "logarithm of brightness"}


def heading(page: ReportPage, y: float, words: str) -> None:
    """Write a heading over a fine line."""
    page.write(QRectF(MARGIN, y, PAGE.width() - 2 * MARGIN, 6), words, 11, bold=True)


def pairs(page: ReportPage, rows_: list[tuple[str, str]], room: QRectF) -> None:
    """Write names and values, a line each."""
    step = room.height() / len(rows_)
    for number, (name, value) in enumerate(rows_):
        line = QRectF(room.left(), room.top() + number * step, room.width(), step)
        page.write(line, name, 8.5)
        page.write(line, value, 8.5, side=1)
        page.pen(LIGHT.line, 0.1)
        page.lines((line.left(), line.right()), (line.bottom(), line.bottom()))


def draw_layout(page: ReportPage, shown: Layout, room: QRectF) -> None:
    """Draw glass, stop, sensor and the five rays to scale, and a length to compare with."""
    drawn, half = shown.drawing, max(shown.drawing.half_height, shown.sensor_half) * 1.08
    left = drawn.left - 0.35 * (drawn.right - drawn.left)
    scale = min(room.width() / (drawn.right - left), room.height() / (2 * half))
    begin = room.center().x() - scale * (drawn.right + left) / 2

    def at(z: ArrayLike, y: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        return begin + scale * np.asarray(z, float), room.center().y() - scale * np.asarray(y, float)

    page.painter.save()
    page.painter.setClipRect(page.pixels(room))
    for outline in drawn.outlines:
        page.painter.setBrush(glass(outline.index, LIGHT))
        page.pen(LIGHT.glass_edge, 0.15)
        z, y = at(outline.z, outline.y)
        page.lines(z, y, closed=True)
    for mirror in drawn.glass.mirrors:
        page.pen(LIGHT.glass_edge, 0.5)
        page.lines(*at(mirror.z, mirror.y))
    page.pen(LIGHT.glass_edge, 0.3)
    for lens in drawn.glass.ideal:
        barb = 0.12 * lens.half * (1 if lens.gathers else -1)
        for side in (-1, 1):
            tip, back = side * lens.half, side * (lens.half - barb)
            page.lines(*at(lens.z + np.array([0, 0, -1, 0, 1]) * abs(barb), [0, tip, back, tip, back]))
    for ray in shown.rays:
        page.pen(RAY_COLOURS[ray.kind], 0.25 if ray.kind == "chief" else 0.15)
        page.lines(*at(ray.z, ray.y))
    page.pen(LIGHT.text, 0.6)
    for side in (-1, 1):
        ends = np.array([side * drawn.stop_rim, side * (drawn.stop_rim + 0.2 * drawn.half_height)])
        page.lines(*at(*drawn.stop.placed(0.0, ends)))
    page.lines(*at(*drawn.sensor.placed(0.0, np.array([-shown.sensor_half, shown.sensor_half]))))
    page.painter.restore()


def draw_psf(page: ReportPage, answer: Live, room: QRectF) -> None:
    """Draw a PSF with its field, its width and its Strehl ratio under it."""
    psf, peak = answer.psf, float(answer.psf.values.max()) or 1.0
    table = lookup(tokens("light", answer.state.display.colours).brightness)
    bright = stretch(psf.values[::-1] / peak, answer.state.display.psf_scale)
    pixels = np.ascontiguousarray(table[as_indices(np.asarray(bright, float), 0.0, 1.0)])
    image = QImage(pixels.data, pixels.shape[1], pixels.shape[0], 4 * pixels.shape[1], QImage.Format.Format_RGB32)
    page.painter.drawImage(page.pixels(room), image)
    width = psf.values.shape[-1] * psf.pixel_um
    ratio = float(np.asarray(psf.strehl, float))  # NaN for None
    strehl = f" · Strehl {significant(ratio, 2)}" if isfinite(ratio) else ""
    words = f"{with_sign(answer.state.optics.field_deg, 1)}° · {significant(width, 3)} µm"
    page.write(QRectF(room.x(), room.bottom() + 1, room.width(), 5), words, 7.5, side=0)
    page.write(QRectF(room.x(), room.bottom() + 6, room.width(), 5), f"{psf.method}{strehl}", 7.5, side=0)
