"""Numbers that change every frame, painted directly: a QLabel would lay out the window anew for each."""

from PySide6.QtCore import QEvent, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter
from PySide6.QtWidgets import QScrollArea, QSizePolicy, QToolTip, QVBoxLayout, QWidget

from p2sf.messages import Message
from p2sf_explorer.charts.painting import metrics, width_of, write
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.i18n.tr import tr

PAD = 7.0
SIZE = 12
BAR_AIR = 6


class Readout(QWidget):
    """One line of text; ``pill`` draws a rounded ground behind it, ``colour`` and ``ground`` name tokens."""

    ground = "card"

    def __init__(self, parent=None, pill: bool = False, colour: str = "muted", align=Qt.AlignmentFlag.AlignLeft):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self._pill, self._colour, self._align = pill, colour, align
        self._text, self._short, self._theme = "", "", LIGHT
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def text(self) -> str:
        """Return the text shown."""
        return self._text

    def set_text(self, text: str, colour: str | None = None, short: str = "") -> None:
        """Show a text, in the colour of another token if one is named; ``short`` stands in where it does not fit."""
        text, self._short = tr(text), tr(short)
        if (text, colour or self._colour) != (self._text, self._colour):
            self._text, self._colour = text, colour or self._colour
            self.setAccessibleName(text)
            self.update()

    def sizeHint(self) -> QSize:
        """Return the height of one line; the width is whatever there is."""
        return QSize(60, 20 if self._pill else 16)

    def minimumSizeHint(self) -> QSize:
        """Return the smallest size."""
        return self.sizeHint()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.update()

    def event(self, event) -> bool:
        """Show the whole text as a tooltip where it is cut off and no other tooltip is set."""
        if event.type() == QEvent.Type.ToolTip and not self.toolTip() and self._cut() != self._text:
            QToolTip.showText(event.globalPos(), self._text, self)
            return True
        return super().event(event)

    def _cut(self) -> str:
        room = self.width() - (2 * PAD if self._pill else 0)
        for text in filter(None, (self._text, self._short)):
            if width_of(text, SIZE) <= room:
                return text
        return metrics(SIZE).elidedText(self._short or self._text, Qt.TextElideMode.ElideRight, room)

    def paintEvent(self, event) -> None:
        """Paint ground and text."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(getattr(self._theme, self.ground)))
        text, pad = self._cut(), PAD if self._pill else 0.0
        if self._pill and text:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(self._theme.faint))
            wide = width_of(text, SIZE) + 2 * PAD
            painter.drawRoundedRect(QRectF(0, 0, wide, self.height()), 4, 4)
        painter.setPen(QColor(getattr(self._theme, self._colour)))
        room = QRectF(pad, 0, self.width() - 2 * pad, self.height())
        write(painter, room, text, 1 if self._align == Qt.AlignmentFlag.AlignRight else -1, SIZE)


class FactTable(QWidget):
    """Names at the left, values at the right; hovering a row defines it."""

    ROW = 17.0

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self._rows: tuple[tuple[str, Message, str], ...] = ()
        self._theme = LIGHT
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    @property
    def rows(self) -> tuple[tuple[str, Message, str], ...]:
        """Return the rows shown."""
        return self._rows

    def show_rows(self, rows: tuple[tuple[str, Message, str], ...]) -> None:
        """Show (name, value, definition) rows."""
        if len(rows) != len(self._rows):
            self.setFixedHeight(round(self.ROW * len(rows)))
            self.update()
        for k, (row, before) in enumerate(zip(rows, self._rows, strict=False)):
            if row != before:
                self.update(self._room(k).toAlignedRect())
        self._rows = rows

    def _room(self, number: int) -> QRectF:
        return QRectF(0, number * self.ROW, self.width(), self.ROW)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.update()

    def event(self, event) -> bool:
        """Define the row under the pointer."""
        if event.type() == QEvent.Type.ToolTip:
            row = int(event.pos().y() // self.ROW)
            if row < len(self._rows):
                QToolTip.showText(event.globalPos(), tr(self._rows[row][2]), self)
            return True
        return super().event(event)

    def paintEvent(self, event) -> None:
        """Paint the rows that have changed."""
        painter, changed = QPainter(self), event.region()
        painter.fillRect(event.rect(), QColor(self._theme.card))
        for k, (name, value, _) in enumerate(self._rows):
            line = self._room(k)
            if not changed.intersects(line.toRect()):
                continue
            painter.setPen(QColor(self._theme.muted))
            write(painter, line, tr(name), -1, SIZE)
            painter.setPen(QColor(self._theme.text))
            write(painter, line, value.text(WINDOW), 1, SIZE)


class Scrolling(QScrollArea):
    """An area that keeps what it holds clear of its scroll bar, where there is one."""

    def resizeEvent(self, event) -> None:
        """Leave air beside the bar, and none where there is no bar."""
        super().resizeEvent(event)
        self.widget().layout().setContentsMargins(0, 0, BAR_AIR if self.verticalScrollBar().isVisible() else 0, 0)


def scrolled(table: FactTable) -> QScrollArea:
    """Return a table at the foot of an area that scrolls where the room is short, so that no row is cut in two."""
    body, area = QWidget(), Scrolling()
    column = QVBoxLayout(body)
    column.setContentsMargins(0, 0, 0, 0)
    column.addStretch(1)
    column.addWidget(table)
    area.setWidgetResizable(True)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setAccessibleName(tr("Figures"))
    area.setMinimumHeight(3 * round(FactTable.ROW))
    area.setWidget(body)
    for part in (area, area.viewport(), body):
        part.setAutoFillBackground(False)
    return area
