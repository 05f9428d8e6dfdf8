"""Numbers that change with every frame, painted directly: a QLabel would lay out the window again for each."""

from math import ceil

from PySide6.QtCore import QEvent, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QHelpEvent, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QLabel, QScrollArea, QSizePolicy, QToolTip, QVBoxLayout, QWidget

from p2sf.messages import Message
from p2sf_explorer.charts.painting import elide, metrics, width_of, write
from p2sf_explorer.charts.theme import LIGHT, SPACE, Tokens
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.i18n.tr import local, tr

PAD = 7.0
SIZE = 12
BAR_AIR = 6  # pixels between a table and its scroll bar
NAME_AIR = 14.0  # pixels at scale 1 between the longest name of a table and its value


class Readout(QWidget):
    """One line of text; ``pill`` draws a rounded ground behind it, ``colour`` and ``ground`` name tokens."""

    ground = "card"

    def __init__(
        self,
        parent: QWidget | None = None,
        pill: bool = False,
        colour: str = "muted",
        align: Qt.AlignmentFlag = Qt.AlignmentFlag.AlignLeft,
    ):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self._pill, self._colour, self._align = pill, colour, align
        self._text, self._theme = "", LIGHT
        self._short: tuple[str, ...] = ()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def text(self) -> str:
        """Return the text shown."""
        return self._text

    def set_text(self, text: str, colour: str | None = None, short: str | tuple[str, ...] = ()) -> None:
        """Show a text as it is, in another token's colour if one is named; the first ``short`` one that fits if not."""
        text, self._short = local(text), (short,) if isinstance(short, str) else short
        if (text, colour or self._colour) != (self._text, self._colour):
            self._text, self._colour = text, colour or self._colour
            self.setAccessibleName(text)
            self.update()

    def sizeHint(self) -> QSize:
        """Return the height of one line; the width is whatever there is."""
        return QSize(self._theme.px(60), self._theme.px(20 if self._pill else 16))

    def minimumSizeHint(self) -> QSize:
        """Return the smallest size."""
        return self.sizeHint()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.updateGeometry()
        self.update()

    def event(self, event: QEvent) -> bool:
        """Show the whole text as a tooltip where it is cut off and no other tooltip is set."""
        if isinstance(event, QHelpEvent) and not self.toolTip() and self._cut() != self._text:
            QToolTip.showText(event.globalPos(), self._text, self)
            return True
        return super().event(event)

    def _cut(self) -> str:
        room = self.width() - (2 * PAD if self._pill else 0)
        texts = [self._text, *filter(None, self._short)]
        for text in texts:
            if width_of(text, self._theme.px(SIZE)) <= room:
                return text
        return metrics(self._theme.px(SIZE)).elidedText(texts[-1], Qt.TextElideMode.ElideRight, room)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint ground and text."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(getattr(self._theme, self.ground)))
        text, pad = self._cut(), PAD if self._pill else 0.0
        if self._pill and text:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(self._theme.faint))
            wide = width_of(text, self._theme.px(SIZE)) + 2 * PAD
            painter.drawRoundedRect(QRectF(0, 0, wide, self.height()), 4, 4)
        painter.setPen(QColor(getattr(self._theme, self._colour)))
        room = QRectF(pad, 0, self.width() - 2 * pad, self.height())
        write(painter, room, text, 1 if self._align == Qt.AlignmentFlag.AlignRight else -1, self._theme.px(SIZE))


class Sentence(QLabel):
    """Wrapped text that may change with every frame: the window is laid out again only for another number of lines."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWordWrap(True)
        self._words = ""

    def text(self) -> str:
        """Return the text shown."""
        return self._words

    def setText(self, text: str) -> None:
        """Show a text."""
        if text == self._words:
            return
        before, self._words = self.heightForWidth(self.width()), text
        self.setAccessibleName(text)
        if self.heightForWidth(self.width()) != before:
            self.updateGeometry()
        self.update()

    def clear(self) -> None:
        """Show nothing."""
        self.setText("")

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Ask for other room where the new width makes another number of lines."""
        super().resizeEvent(event)
        if self.heightForWidth(event.size().width()) != self.heightForWidth(event.oldSize().width()):
            self.updateGeometry()

    def heightForWidth(self, width: int) -> int:
        """Return the height of the lines that the text takes, at least of one."""
        metrics = self.fontMetrics()
        tall: int = metrics.boundingRect(QRect(0, 0, width, 1), Qt.TextFlag.TextWordWrap, self._words).height()
        return max(tall, metrics.lineSpacing())

    def sizeHint(self) -> QSize:
        """Return the height at the present width."""
        return QSize(self.minimumSizeHint().width(), self.heightForWidth(self.width()))

    def minimumSizeHint(self) -> QSize:
        """Return the smallest useful size: a line that is cut off says something else."""
        return QSize(10 * self.fontMetrics().averageCharWidth(), self.heightForWidth(self.width()))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the text."""
        flags = int(Qt.TextFlag.TextWordWrap | Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self.style().drawItemText(
            QPainter(self), self.rect(), flags, self.palette(), self.isEnabled(), self._words, self.foregroundRole()
        )


FactRow = tuple[str, Message, str]
"""Name, value and definition of a quantity."""


class FactTable(QWidget):
    """Names at the left, values at the right; the tooltip of a row defines it.

    Names, values and definitions are English, and translated here.
    """

    ROW = 17.0

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self._rows: tuple[FactRow, ...] = ()
        self._values: list[str] = []
        self._theme, self._widest = LIGHT, 0
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    @property
    def row(self) -> float:
        """Return the height of a row in pixels."""
        return self.ROW * self._theme.scale

    @property
    def rows(self) -> tuple[FactRow, ...]:
        """Return the rows shown."""
        return self._rows

    @property
    def values(self) -> tuple[str, ...]:
        """Return the rows' values in words."""
        return tuple(self._values)

    def sizeHint(self) -> QSize:
        """Return the size in which no name has been cut so far: it does not shrink while values change."""
        return QSize(self._widest, round(self.row * len(self._rows)))

    def _widen(self) -> None:
        """Ask for more width where a name and its value need it."""
        size = self._theme.px(SIZE)
        rows = zip(self._rows, self._values, strict=True)
        needed = max((width_of(tr(row[0]), size) + width_of(value, size) for row, value in rows), default=0.0)
        if needed + self._air > self._widest:
            self._widest = ceil(needed + self._air)
            self.updateGeometry()

    @property
    def _air(self) -> float:
        return NAME_AIR * self._theme.scale

    def show_rows(self, rows: tuple[FactRow, ...]) -> None:
        """Show (name, value, definition) rows."""
        if len(rows) != len(self._rows):
            self.setFixedHeight(round(self.row * len(rows)))
            self._values = [value.text(WINDOW) for _, value, _ in rows]
            self.update()
        else:
            for k, (row, before) in enumerate(zip(rows, self._rows, strict=True)):
                if row != before:
                    self._values[k] = row[1].text(WINDOW)
                    self.update(self._room(k).toAlignedRect())
        self._rows = rows
        self._widen()

    def _room(self, number: int) -> QRectF:
        return QRectF(0, number * self.row, self.width(), self.row)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme, self._widest = theme, 0
        self.setFixedHeight(round(self.row * len(self._rows)))
        self._widen()
        self.update()

    def event(self, event: QEvent) -> bool:
        """Define the row under the pointer."""
        if isinstance(event, QHelpEvent):
            row = int(event.pos().y() // self.row)
            if row < len(self._rows):
                QToolTip.showText(event.globalPos(), self._tip(row), self)
            return True
        return super().event(event)

    def _name(self, row: int) -> tuple[str, str]:
        """Return the name of a row, whole and as far as it fits beside its value."""
        name, size = tr(self._rows[row][0]), self._theme.px(SIZE)
        room = self.width() - width_of(self._values[row], size) - self._air
        return name, elide(name, room, size)

    def _tip(self, row: int) -> str:
        """Return the definition of a row, behind its name where that is cut."""
        name, shown = self._name(row)
        definition = tr(self._rows[row][2])
        return definition if shown == name else f"{name}: {definition}"

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the rows that have changed."""
        painter, changed = QPainter(self), event.region()
        painter.fillRect(event.rect(), QColor(self._theme.card))
        size = self._theme.px(SIZE)
        for k, value in enumerate(self._values):
            line = self._room(k)
            if not changed.intersects(line.toRect()):
                continue
            painter.setPen(QColor(self._theme.muted))
            write(painter, line, self._name(k)[1], -1, size)
            painter.setPen(QColor(self._theme.text))
            write(painter, line, value, 1, size)


class Columns(QWidget):
    """Tables side by side, or one above the other where that would cut their names."""

    GAP = 28

    def __init__(self, tables: tuple[FactTable, ...], parent: QWidget | None = None):
        super().__init__(parent)
        self._tables, self._theme = tables, LIGHT
        self._row = QBoxLayout(QBoxLayout.Direction.LeftToRight, self)
        for table in tables:
            self._row.addWidget(table, 1, Qt.AlignmentFlag.AlignTop)
        self._row.addStretch()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours and the scale of a theme."""
        self._theme = theme
        self._row.setContentsMargins(0, 0, theme.px(SPACE), 0)
        for table in self._tables:
            table.restyle(theme)
        self.fit()

    def fit(self) -> None:
        """Turn the tables to how they fit; call this when their rows have changed."""
        gap, count = self._theme.px(self.GAP), len(self._tables)
        needed = count * max(table.sizeHint().width() for table in self._tables) + (count - 1) * gap
        beside = needed <= self.width() - self._row.contentsMargins().right()
        self._row.setDirection(QBoxLayout.Direction.LeftToRight if beside else QBoxLayout.Direction.TopToBottom)
        self._row.setSpacing(gap if beside else gap // 2)
        for number in range(count):
            self._row.setStretch(number, int(beside))
        self._row.setStretch(count, int(not beside))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Turn the tables to how they fit."""
        super().resizeEvent(event)
        self.fit()


class Scrolling(QScrollArea):
    """A scroll area of a table that keeps its contents clear of the scroll bar, and shows whole rows."""

    def __init__(self, table: FactTable, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._table = table
        self.verticalScrollBar().rangeChanged.connect(self._make_room)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave out what has no room for a whole row."""
        super().resizeEvent(event)
        cut = self._table.sizeHint().height() > self.height()
        self.setViewportMargins(0, 0, 0, round(self.height() % self._table.row) if cut else 0)

    def _make_room(self, first: int, last: int) -> None:
        """Leave a margin beside the bar, and none where there is no bar."""
        body = self.widget()
        if body and (layout := body.layout()):
            layout.setContentsMargins(0, 0, BAR_AIR if last > first else 0, 0)


def in_scroll_area(table: FactTable, at_foot: bool = True) -> QScrollArea:
    """Return a table at the foot or top of an area that scrolls where room is little, so that no row is cut in two."""
    body = QWidget()
    column = QVBoxLayout(body)
    area = Scrolling(table)
    column.setContentsMargins(0, 0, 0, 0)
    column.addStretch(1 if at_foot else 0)
    column.addWidget(table)
    column.addStretch(0 if at_foot else 1)
    area.setWidgetResizable(True)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setAccessibleName(tr("Figures"))
    area.setMinimumHeight(3 * round(FactTable.ROW))
    area.setWidget(body)
    for part in (area, area.viewport(), body):
        part.setAutoFillBackground(False)
    return area
