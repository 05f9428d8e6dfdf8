"""The six coefficients as numbers and bars, in waves."""

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import QWidget

from app.card import Card
from app.compute import Live
from app.ink import write
from app.pupil import FORMULAS, TERMS, WORDS
from app.readout import Readout
from app.scales import nice, signed
from app.store import Store
from app.theme import LIGHT, Tokens

TIP = "Wavefront coefficients: the peak value of each term of W(ρ, θ) at this field, in waves."
NAMES = {"w40": "W40", "w31": "W31", "w22": "W22", "w20": "W20", "wd": "Wd", "w11": "W11"}


class CoefficientsPanel:
    """Six rows: name, term, bar about zero, number."""

    def __init__(self, store: Store):
        self.widget = Card("Coefficients", TIP)
        self.bars = Bars(self.widget)
        self.widget.set_body(self.bars)
        self.note = Readout(self.widget)
        self.note.set_text("W11 only moves the image.")
        self.widget.add_footer(self.note)

    def show(self, live: Live) -> None:
        """Paint the coefficients."""
        values = {name: float(getattr(live.setting.coefficients, name)) for name in TERMS}
        self.bars.show_values(values)
        self.widget.set_readout(f"waves at {live.state.wavelength_nm:.1f} nm")

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.bars.restyle(theme)
        self.note.restyle(theme)


class Bars(QWidget):
    """The painted rows; ``limit`` is the value of a full bar, a round number of waves."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.values: dict[str, float] = dict.fromkeys(TERMS, 0.0)
        self.limit = 1.0
        self._theme = LIGHT
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setMinimumHeight(120)

    def sizeHint(self) -> QSize:
        """Return a size with room for six rows."""
        return QSize(260, 200)

    def show_values(self, values: dict[str, float]) -> None:
        """Show the coefficients, waves."""
        self.values = values
        self.limit = nice(max(0.1, *(abs(v) for name, v in values.items() if name != "w11")))
        self.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.update()

    def paintEvent(self, event) -> None:
        """Paint the rows and the scale under them."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(self._theme.card))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        bottom = 18.0
        height = (self.height() - bottom) / len(TERMS)
        left, right = 112.0, self.width() - 62.0
        self._paint_scale(painter, left, right, self.height() - bottom)
        for row, name in enumerate(TERMS):
            self._paint_row(painter, name, QRectF(0, row * height, self.width(), height), (left, right))

    def _paint_scale(self, painter: QPainter, left: float, right: float, bottom: float) -> None:
        for part in (-1.0, -0.5, 0.0, 0.5, 1.0):
            x = (left + right) / 2 + part * (right - left) / 2
            painter.setPen(QPen(QColor(self._theme.line if part == 0 else self._theme.faint), 1))
            painter.drawLine(QPointF(x, 0), QPointF(x, bottom))
            if part in (-1.0, 0.0, 1.0):
                painter.setPen(QColor(self._theme.muted))
                text = f"{self.limit * part:+g}".replace("-", "−") if part else "0"
                write(painter, QRectF(x - 40, bottom + 2, 80, 16), text)

    def _paint_row(self, painter: QPainter, name: str, row: QRectF, ends: tuple[float, float]) -> None:
        theme, value = self._theme, self.values[name]
        middle, half = (ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2
        thick = min(18.0, 0.5 * row.height())
        end = middle + half * max(-1.0, min(1.0, value / self.limit))
        painter.setPen(Qt.PenStyle.NoPen)
        colour = QColor(theme.positive if value >= 0 else theme.negative)
        colour.setAlpha(110 if name == "w11" else 255)
        painter.setBrush(colour)
        painter.drawRect(QRectF(min(middle, end), row.center().y() - thick / 2, abs(end - middle), thick))
        if abs(value) > self.limit:
            self._paint_overflow(painter, end, row.center().y(), thick, value > 0)
        self._paint_words(painter, name, row)

    def _paint_overflow(self, painter: QPainter, end: float, y: float, thick: float, right: bool) -> None:
        """Cut the bar's end with two slanted strokes: it goes on beyond the scale."""
        painter.setPen(QPen(QColor(self._theme.card), 2))
        for shift in (6.0, 11.0):
            x = end - shift if right else end + shift
            painter.drawLine(QPointF(x - 3, y + thick / 2 + 1), QPointF(x + 3, y - thick / 2 - 1))

    def _paint_words(self, painter: QPainter, name: str, row: QRectF) -> None:
        painter.setPen(QColor(self._theme.text))
        write(painter, QRectF(0, row.top(), 40, row.height()), NAMES[name], -1, 13)
        number = f"{signed(self.values[name], 2)} λ"
        write(painter, QRectF(row.right() - 62, row.top(), 62, row.height()), number, 1, 13)
        painter.setPen(QColor(self._theme.muted))
        write(painter, QRectF(38, row.top(), 76, row.height()), SHORT[name], -1)


SHORT = {
    "w40": "spherical",
    "w31": "coma",
    "w22": "astigmatism",
    "w20": "field curv.",
    "wd": "defocus",
    "w11": "distortion",
}
ROW_TIPS = {name: f"{NAMES[name]} {WORDS[name]}: {NAMES[name]}·{FORMULAS[name]}" for name in TERMS}
