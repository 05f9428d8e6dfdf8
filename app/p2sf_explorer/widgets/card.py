"""The frame of every panel: a title, tools, a readout, and the picture."""

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QPointF, Qt, Signal
from PySide6.QtGui import (
    QContextMenuEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPalette,
    QPen,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import (
    QComboBox,
    QFrame,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from p2sf_explorer.charts.overlay import Overlay
from p2sf_explorer.i18n.tr import local, tr, unbroken
from p2sf_explorer.widgets.copying import copy_menu

LIST_AIR = 24  # pixels beside the longest line of an open list


class Card(QFrame):
    """A titled frame; ``readout`` is a line of numbers at the right of the title.

    ``apart_asked``: the panel is to have a window of its own, or to come back from it. ``theory_asked``: the handbook
    is to open at the panel's section.
    """

    apart_asked = Signal()
    theory_asked = Signal()

    def __init__(self, title: str, tip: str = "", parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("card")
        self.setMinimumSize(180, 120)
        self._title = tr(title)
        self.title, self.readout = QLabel(self._title, self), QLabel(self)
        self.note = QLabel(self)
        self.note.setObjectName("muted")
        self.note.setWordWrap(True)
        self.note.hide()
        self.title.setObjectName("title")
        self.title.setToolTip(tr(tip))
        self.readout.setObjectName("readout")
        self.readout.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.readout.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.head = QHBoxLayout()
        self.head.setSpacing(8)
        self.head.addWidget(self.title)
        self.head.addWidget(self.readout, 1)
        self.under = QHBoxLayout()  # for the tools where they do not fit beside the title
        self.tools: list[QWidget] = []
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(10, 7, 10, 8)
        self.column.setSpacing(5)
        self.column.addLayout(self.head)
        self.column.addLayout(self.under)
        self.column.addWidget(self.note)
        self.overlay = Overlay(self)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Move the tools to a line of their own where they do not fit beside the title, and back where they do."""
        super().resizeEvent(event)
        parts = [self.title, *(tool for tool in self.tools if not tool.isHidden())]
        needed = sum(part.sizeHint().width() + self.head.spacing() for part in parts)
        margins = self.column.contentsMargins()
        fits = needed <= self.width() - margins.left() - margins.right()
        before, after = (self.under, self.head) if fits else (self.head, self.under)
        for tool in self.tools:
            if before.indexOf(tool) >= 0:
                before.removeWidget(tool)
                after.addWidget(tool)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Offer the panel's picture, its data, and a window of its own."""
        menu = copy_menu(self)
        menu.addSeparator()
        menu.addAction(tr("Theory of this panel"), self.theory_asked.emit)
        menu.addAction(tr("In its own window, or back") + "\tCtrl+D", self.apart_asked.emit)
        menu.popup(event.globalPos())

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Ask for a window of its own, or to come back, on a double-click on the title line."""
        if event.position().y() < self.head.geometry().bottom():
            self.apart_asked.emit()

    def add_footer(self, *widgets: QWidget) -> None:
        """Put a line of small widgets under the picture, from the left."""
        line = QHBoxLayout()
        line.setSpacing(8)
        for widget in widgets:
            line.addWidget(widget)
        self.column.addLayout(line)

    def add_tool(self, widget: QWidget) -> None:
        """Put a small control at the right end of the title line."""
        self.tools.append(widget)
        self.head.addWidget(widget)

    def show_side(self, side: str, why: str = "") -> None:
        """Name the side of a comparison behind the title; say below, as it is, why no difference is shown."""
        words = " · ".join(filter(None, (self._title, tr(side))))
        note = unbroken(why)
        if (self.title.text(), self.note.text()) != (words, note):
            self.title.setText(words)
            self.note.setText(note)
            self.note.setVisible(bool(why))

    def show_overlay(self, sentence: str) -> None:
        """Cover everything but the title with a sentence, as it is, on why nothing is shown; uncover it for ""."""
        if unbroken(sentence) != self.overlay.text:
            self.readout.setVisible(not sentence)
            self.overlay.say(sentence, self.head.geometry().bottom() + 1)

    def set_body(self, widget: QWidget) -> None:
        """Put the picture under the title line."""
        self.column.addWidget(widget, 1)

    def set_readout(self, text: str) -> None:
        """Show a line of numbers, as it is; its tooltip has the whole of it where it does not fit."""
        text = local(text)
        if self.readout.text() != text:
            self.readout.setText(text)
            self.readout.setToolTip(text)


def paint_chevron(widget: QWidget) -> None:
    """Paint the arrow at the right end of a box that opens."""
    painter = QPainter(widget)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(widget.palette().color(QPalette.ColorRole.PlaceholderText), 1.6))
    x, y = widget.width() - 13.0, widget.height() / 2 - 1.5
    painter.drawPolyline(QPolygonF([QPointF(x - 3.5, y), QPointF(x, y + 3.5), QPointF(x + 3.5, y)]))


class Chooser(QComboBox):
    """A combo box with a chevron, since a style sheet takes the native arrow away."""

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the box, then the chevron."""
        super().paintEvent(event)
        paint_chevron(self)


def chooser(choices: tuple[tuple[str, str], ...], tip: str, parent: QWidget | None = None) -> QComboBox:
    """Return a small combo box of (value, label); labels and tip are English, translated here."""
    box = Chooser(parent)
    box.setObjectName("small")
    box.setToolTip(tr(tip))
    box.setAccessibleName(tr(tip))
    for value, words in choices:
        box.addItem(tr(words), value)
    return box


class Describing(QStyledItemDelegate):
    """Shows what a choice means in the open list; the closed box shows only its name."""

    def initStyleOption(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> None:
        """Put the meaning in place of the name."""
        super().initStyleOption(option, index)
        option.text = index.data(Qt.ItemDataRole.ToolTipRole) or option.text


def described(choices: dict[str, str], tip: str, parent: QWidget | None = None) -> QComboBox:
    """Return a combo box of names, with their explanations in the open list."""
    box = chooser(tuple((name, name) for name in choices), tip, parent)
    box.setItemDelegate(Describing(box))
    for k, words in enumerate(choices.values()):
        box.setItemData(k, tr(words), Qt.ItemDataRole.ToolTipRole)
    box.view().setMinimumWidth(box.view().sizeHintForColumn(0) + LIST_AIR)
    return box


def select(box: QComboBox, value: str) -> None:
    """Show a value without a signal."""
    if box.currentData() != value:
        box.blockSignals(True)
        box.setCurrentIndex(box.findData(value))
        box.blockSignals(False)


SIDE_PX = 196


class SideCard(Card):
    """A card with title, readout and controls in a column of ``SIDE_PX`` pixels, and the picture beside it."""

    def __init__(self, title: str, tip: str = "", parent: QWidget | None = None):
        super().__init__(title, tip, parent)
        self.side, self.whole = QVBoxLayout(), QHBoxLayout()
        self.side.addStrut(SIDE_PX)
        self.side.setSpacing(4)
        self.column.removeItem(self.head)
        self.head.setParent(None)
        self.side.addLayout(self.head)
        self.whole.setSpacing(10)
        self.whole.addLayout(self.side)
        self.column.addLayout(self.whole, 1)

    def add_line(self, *widgets: QWidget) -> None:
        """Add a line of small controls under the others, as wide as the column."""
        line = QHBoxLayout()
        line.setSpacing(4)
        for widget in widgets:
            choice = isinstance(widget, QComboBox)
            widget.setSizePolicy(_IGNORED if choice else _EXPANDING, QSizePolicy.Policy.Fixed)
            line.addWidget(widget, 1 if choice else 0)
        self.side.addLayout(line)

    def add_rest(self, widget: QWidget) -> None:
        """Give a widget the rest of the column's height."""
        widget.setSizePolicy(_IGNORED, QSizePolicy.Policy.Ignored)
        self.side.addWidget(widget, 1)
        self.side.addStretch()  # for when the widget is hidden

    def set_body(self, widget: QWidget) -> None:
        """Put the picture beside the column."""
        self.whole.addWidget(widget, 1)


_IGNORED, _EXPANDING = QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Expanding
