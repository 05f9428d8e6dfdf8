"""Where the parts of the mixing desk of six coefficients lie, and how they are painted."""

from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from p2sf_explorer.charts.painting import set_text, write
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import signed
from p2sf_explorer.state.terms import TERMS

NAMES = {"w40": "W40", "w31": "W31", "w22": "W22", "w20": "W20", "wd": "Wd", "w11": "W11"}
SHORT = {
    "w40": "spherical",
    "w31": "coma",
    "w22": "astigmatism",
    "w20": "field curv.",
    "wd": "defocus",
    "w11": "distortion",
}
LEFT, NUMBER, BUTTON, GAP = 84.0, 60.0, 19.0, 4.0
SCALE_HEIGHT = 18.0
HANDLE = 5.0
LETTERS = (("muted", "M", "warning"), ("solo", "S", "accent"))


@dataclass(frozen=True)
class Places:
    """The desk's geometry for a size in pixels; rows in the order of `p2sf_explorer.state.terms.TERMS`."""

    width: float
    height: float

    @property
    def ends(self) -> tuple[float, float]:
        """Return where the bars and sliders begin and end."""
        return LEFT, self.width - NUMBER - 2 * BUTTON - 2 * GAP

    def row(self, number: int) -> QRectF:
        """Return a row's room."""
        tall = (self.height - SCALE_HEIGHT) / len(TERMS)
        return QRectF(0, number * tall, self.width, tall)

    def row_at(self, y: float) -> int:
        """Return the row at a height."""
        return min(len(TERMS) - 1, max(0, int(y * len(TERMS) / max(1.0, self.height - SCALE_HEIGHT))))

    def button(self, number: int, kind: str) -> QRectF:
        """Return the room of a row's "muted" or "solo" button."""
        place = [name for name, *_ in LETTERS].index(kind)
        left = self.width - (2 - place) * BUTTON - (1 - place) * GAP / 2
        return QRectF(left, self.row(number).center().y() - BUTTON / 2, BUTTON - 1, BUTTON)

    def number(self, number: int) -> QRectF:
        """Return the room of a row's number."""
        row = self.row(number)
        return QRectF(self.ends[1] + GAP / 2, row.top(), NUMBER - GAP / 2, row.height())

    def bar(self, number: int, part: float) -> QRectF:
        """Return a bar from the middle to a part (−1 to 1) of its half."""
        row, (left, right) = self.row(number), self.ends
        middle, end = (left + right) / 2, (left + right) / 2 + part * (right - left) / 2
        thick = min(16.0, 0.42 * row.height())
        return QRectF(min(middle, end), row.top() + 0.36 * row.height() - thick / 2, abs(end - middle), thick)

    def handle(self, number: int, part: float) -> QPointF:
        """Return where a row's slider stands for a part (−1 to 1) of its half."""
        row, (left, right) = self.row(number), self.ends
        return QPointF((left + right) / 2 + part * (right - left) / 2, row.top() + 0.80 * row.height())

    def part_at(self, x: float) -> float:
        """Return the part (−1 to 1) of the half travel at a pixel."""
        left, right = self.ends
        return min(1.0, max(-1.0, (2 * x - left - right) / max(1.0, right - left)))


def held(value: float, limit: float) -> float:
    """Return a value as a part of the limit, not beyond it."""
    return max(-1.0, min(1.0, value / limit))


def paint_scale(painter: QPainter, places: Places, theme: Tokens, limit: float) -> None:
    """Paint five lines and their numbers."""
    (left, right), bottom = places.ends, places.height - SCALE_HEIGHT
    for part in (-1.0, -0.5, 0.0, 0.5, 1.0):
        x = (left + right) / 2 + part * (right - left) / 2
        painter.setPen(QPen(QColor(theme.line if part == 0 else theme.faint), 1))
        painter.drawLine(QPointF(x, 0), QPointF(x, bottom))
        if part in (-1.0, 0.0, 1.0):
            painter.setPen(QColor(theme.muted))
            text = f"{limit * part:+g}".replace("-", "−") if part else "0"
            write(painter, QRectF(x - 40, bottom + 2, 80, 16), text)


def paint_names(painter: QPainter, places: Places, theme: Tokens, number: int) -> None:
    """Paint a row's symbol, and what it is called."""
    row, name = places.row(number), TERMS[number]
    two = row.height() >= 25
    painter.setPen(QColor(theme.text))
    symbol = QRectF(0, row.center().y() - 15, 60, 16) if two else row
    write(painter, symbol, NAMES[name], -1, 13)
    if two:
        painter.setPen(QColor(theme.muted))
        words = tr(SHORT[name])
        fits = set_text(words).size().width() <= LEFT - 2 * GAP
        write(painter, QRectF(0, row.center().y(), 66, 13), words, -1, 11 if fits else 10)


def paint_slider(painter: QPainter, places: Places, theme: Tokens, number: int, part: float, focused: bool) -> None:
    """Paint a row's slider: a groove, what is added, the handle."""
    handle, zero = places.handle(number, part), places.handle(number, 0.0)
    left, right = places.ends
    painter.setPen(QPen(QColor(theme.line), 2))
    painter.drawLine(QPointF(left, zero.y()), QPointF(right, zero.y()))
    painter.setPen(QPen(QColor(theme.accent), 2))
    painter.drawLine(zero, handle)
    if focused:
        halo = QColor(theme.accent)
        halo.setAlpha(80)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(halo)
        painter.drawEllipse(handle, HANDLE + 3, HANDLE + 3)
    painter.setPen(QPen(QColor(theme.accent if part else theme.muted), 1.6))
    painter.setBrush(QColor(theme.card))
    painter.drawEllipse(handle, HANDLE - 0.8, HANDLE - 0.8)


def paint_button(painter: QPainter, room: QRectF, theme: Tokens, letter: str, colour: str, on: bool) -> None:
    """Paint a mute or solo button."""
    painter.setPen(QPen(QColor(getattr(theme, colour) if on else theme.line), 1))
    painter.setBrush(QColor(getattr(theme, colour) if on else theme.raised))
    painter.drawRoundedRect(room.adjusted(0.5, 0.5, -0.5, -0.5), 4, 4)
    painter.setPen(QColor(theme.card if on else theme.muted))
    write(painter, room, letter, 0)


def paint_value(painter: QPainter, places: Places, theme: Tokens, number: int, part: float, words: str) -> None:
    """Paint a row's bar and number; W11 pale, since it only moves the image."""
    colour = QColor(theme.positive if part >= 0 else theme.negative)
    colour.setAlpha(110 if TERMS[number] == "w11" else 255)
    painter.fillRect(places.bar(number, part), colour)
    painter.setPen(QColor(theme.text))
    write(painter, places.number(number), words, 1, 13)


def paint_overflow(painter: QPainter, bar: QRectF, theme: Tokens, right: bool) -> None:
    """Cut the bar's end with two slanted strokes: it goes on beyond the scale."""
    painter.setPen(QPen(QColor(theme.card), 2))
    for shift in (6.0, 11.0):
        x = bar.right() - shift if right else bar.left() + shift
        painter.drawLine(QPointF(x - 3, bar.bottom() + 1), QPointF(x + 3, bar.top() - 1))


def waves(value: float) -> str:
    """Return a coefficient as the desk writes it, no longer than its column."""
    size = abs(value)
    return f"{signed(value, 2 if size < 10 else 1 if size < 100 else 0)} λ"
