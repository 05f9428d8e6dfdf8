"""The frame of every panel: a title, tools, a readout, and the picture."""

from PySide6.QtCore import (
    QEvent,
    QMimeData,
    QModelIndex,
    QPersistentModelIndex,
    QPoint,
    QPointF,
    QRectF,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import (
    QAccessible,
    QContextMenuEvent,
    QDrag,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPalette,
    QPen,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import (
    QApplication,
    QBoxLayout,
    QComboBox,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.overlay import Overlay
from p2sf_explorer.i18n.tr import local, tr, unbroken
from p2sf_explorer.state.state import State, entry
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.quiet import QuietTools

LIST_AIR = 24  # pixels beside the longest line of an open list
PANEL_MIME = "application/x-p2sf-panel"  # of a panel's key while its title is dragged
TALLEST = 200  # pixels at scale 1: a panel that needs more than this is cut, or scrolls, where there is less
READOUT_LINES = 2  # at most, where it stands below the title
DRAGGED_PX = 240  # width of the small picture under the pointer
WIDEST_SIDE = " · A − B"
TO_STAGE = "Put this panel on the stage (double-click its title, or drag it there)"
APART = "Open this panel in its own window, or put it back (Ctrl+D)"


class CornerButton(QToolButton):
    """A small button that paints its sign: "stage", a frame that grows, or "window", one frame before another."""

    def __init__(self, sign: str, tip: str, parent: QWidget) -> None:
        super().__init__(parent)
        self._sign = sign
        self.setObjectName("flat")
        self.setToolTip(tr(tip))
        self.setAccessibleName(tr(tip))
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.rescale(1.0)

    def rescale(self, scale: float) -> None:
        """Take a scale of type."""
        self.setFixedSize(QSize(round(22 * scale), round(22 * scale)))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the frame of a flat button, then the sign, 10 pixels wide at scale 1."""
        super().paintEvent(event)
        painter, unit = QPainter(self), self.width() / 22
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        role = QPalette.ColorRole.WindowText if self.underMouse() else QPalette.ColorRole.PlaceholderText
        painter.translate(self.width() / 2, self.height() / 2)
        painter.scale(unit, unit)
        painter.setPen(QPen(self.palette().color(role), 1.3))
        if self._sign == "stage":
            painter.drawRoundedRect(QRectF(-5.5, -5, 11, 10), 1.5, 1.5)
            painter.fillRect(QRectF(-3.5, -3, 7, 6), self.palette().color(role))
        else:
            painter.drawRoundedRect(QRectF(-5.5, -1.5, 7.5, 6.5), 1, 1)
            painter.drawPolyline(
                QPolygonF([QPointF(*at) for at in ((-2.5, -1.5), (-2.5, -5), (5.5, -5), (5.5, 2), (2, 2))])
            )


class Card(QFrame):
    """A titled frame; ``readout`` is a line of numbers at the right of the title.

    ``place_asked``: the panel is to stand on the "stage", in the "rail" or under the "tabs". ``apart_asked``: it is to
    have a window of its own, or to come back from it. ``theory_asked``: the handbook is to open at the panel's section.
    ``quiet`` holds the tools that are seen only while the pointer or the focus is in the card.
    ``key`` is the panel's, which a drag of the title carries; ``smallest`` is the least size in pixels at scale 1.
    """

    accessible_role = QAccessible.Role.Grouping
    place_asked = Signal(str)
    apart_asked = Signal()
    theory_asked = Signal()
    key = ""
    smallest = 180, 120

    def __init__(self, title: str, tip: str = "", parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("card")
        self._title = tr(title)
        self.setAccessibleName(self._title)
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
        self.choosers: dict[str, QComboBox] = {}
        self.head = QHBoxLayout()
        self.head.addWidget(self.title)
        self.head.addWidget(self.readout, 1)
        self.corner = QHBoxLayout()
        self.corner.setSpacing(0)
        self.to_stage, self.apart = CornerButton("stage", TO_STAGE, self), CornerButton("window", APART, self)
        self.to_stage.clicked.connect(lambda: self.place_asked.emit("stage"))
        self.apart.clicked.connect(self.apart_asked)
        for button in (self.to_stage, self.apart):
            self.corner.addWidget(button)
        self.quiet = QuietTools(self)
        self.quiet.add(self.to_stage, self.apart)
        self.head.addLayout(self.corner)
        self.under = QHBoxLayout()  # for the tools where they do not fit beside the title
        self.tools: list[QWidget] = []
        self._fitted = 0  # pixels that the tools needed when the line was last fitted
        self._place, self._pressed = "tabs", QPointF(-1, -1)
        self.column = QVBoxLayout(self)
        self.column.setSizeConstraint(QVBoxLayout.SizeConstraint.SetNoConstraint)  # see `minimumSizeHint`
        self.lines = self.column  # of which the title's is one
        self.column.addLayout(self.head)
        self.column.addLayout(self.under)
        self.column.addWidget(self.note)
        self.overlay = Overlay(self)
        self.rescale(1.0)

    def rescale(self, scale: float) -> None:
        """Take a scale of type: margins, gaps and the least size follow it."""
        self._scale = scale
        self.updateGeometry()
        self.column.setContentsMargins(*(round(scale * margin) for margin in (10, 7, 8, 8)))
        self.column.setSpacing(round(5 * scale))
        self.head.setSpacing(round(8 * scale))
        for button in (self.to_stage, self.apart):
            button.rescale(scale)

    def minimumSizeHint(self) -> QSize:
        """Return the least size: as high as the contents need, within reason, and as wide as a narrow rail."""
        wide, high = (round(self._scale * side) for side in self.smallest)
        return QSize(wide, max(high, min(self.column.minimumSize().height(), round(TALLEST * self._scale))))

    def stand(self, place: str) -> None:
        """Take note of the place: "stage", "rail", "tabs", or a "window" of its own."""
        self._place = place
        self.to_stage.setVisible(place != "stage")

    def stand_beside(self) -> None:
        """Be a second panel of a kind: it stays where it is."""
        for button in (self.to_stage, self.apart):
            kept = button.sizePolicy()
            kept.setRetainSizeWhenHidden(button is self.apart)  # so that the titles are level
            button.setSizePolicy(kept)
            button.hide()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Move the tools to a line of their own where they do not fit beside the title, and back where they do."""
        super().resizeEvent(event)
        self._fit_head()

    def event(self, event: QEvent) -> bool:
        """Fit the title's line again where a tool needs more or less of it."""
        if event.type() == QEvent.Type.LayoutRequest and self._tools_px() != self._fitted:
            self._fit_head()
        return super().event(event)

    def _tools_px(self) -> int:
        """Return the width that the tools need."""
        return sum(tool.sizeHint().width() + self.head.spacing() for tool in self.tools if not tool.isHidden())

    def _fit_head(self) -> None:
        """Put tools, and then the readout, on lines of their own where they do not fit beside the title."""
        gap = self.head.spacing()
        title = self.title.fontMetrics().horizontalAdvance(f"{self._title}{WIDEST_SIDE}")  # tools stay with any side
        room = self._title_room() - self.corner.sizeHint().width() - title - 2 * gap
        self._fitted = tools = self._tools_px()
        fits = tools <= room
        for tool in self.tools:
            if (self.under if fits else self.head).indexOf(tool) >= 0:
                (self.under if fits else self.head).removeWidget(tool)
                self._put(tool, fits)
        self.readout.setWordWrap(False)  # so that its hint is the width of one line
        words = self.readout.sizeHint().width() if self.readout.text() else 0
        self._put_readout(not words or words + (tools if fits else 0) <= room)  # no words, no line

    def _title_room(self) -> int:
        """Return the width of the title's line."""
        margins = self.column.contentsMargins()
        return self.width() - margins.left() - margins.right()

    def _put_readout(self, beside_title: bool) -> None:
        """Put the readout at the end of the title's line, or below it on up to two lines."""
        self.readout.setWordWrap(not beside_title)
        self.readout.setMaximumHeight(READOUT_LINES * self.readout.fontMetrics().lineSpacing())
        if beside_title == (self.head.indexOf(self.readout) >= 0):
            return
        if beside_title:
            self.lines.removeWidget(self.readout)
            self.head.insertWidget(1, self.readout, 1)
        else:
            self.head.removeWidget(self.readout)
            self.lines.insertWidget(self.lines.indexOf(self.head) + 1, self.readout)
        self.head.setStretchFactor(self.title, 0 if beside_title else 1)
        side = Qt.AlignmentFlag.AlignRight if beside_title else Qt.AlignmentFlag.AlignLeft
        self.readout.setAlignment(side | Qt.AlignmentFlag.AlignVCenter)

    def _put(self, tool: QWidget, beside_title: bool) -> None:
        """Put a tool before the buttons of the corner, or on the line below."""
        if beside_title:
            self.head.insertWidget(self.head.indexOf(self.corner), tool)
        else:
            self.under.addWidget(tool)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Offer the panel's picture, its data, and its places."""
        from p2sf_explorer.widgets.copying import copy_menu

        menu = copy_menu(self)
        if chart := chart_at(self, event.pos()):
            chart.hand.fill(menu, chart.mapFrom(self, event.pos()))
        menu.addSeparator()
        menu.addAction(tr("Theory of this panel"), self.theory_asked.emit)
        menu.addSeparator()
        if self._place != "stage":
            menu.addAction(tr("On the stage"), lambda: self.place_asked.emit("stage"))
        if self._place in ("tabs", "window"):
            menu.addAction(tr("Keep beside the stage"), lambda: self.place_asked.emit("rail"))
        if self._place == "rail":
            menu.addAction(tr("Back to the tabs"), lambda: self.place_asked.emit("tabs"))
        menu.addAction(tr("In its own window, or back") + "\tCtrl+D", self.apart_asked.emit)
        menu.popup(event.globalPos())

    def _on_title(self, place: QPointF) -> bool:
        return self.head.geometry().contains(place.toPoint())

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Ask for the stage on a double-click on the title line."""
        if self._on_title(event.position()):
            self.place_asked.emit("stage")

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Note where the title is taken."""
        taken = event.button() == Qt.MouseButton.LeftButton and self._on_title(event.position())
        self._pressed = event.position() if taken else QPointF(-1, -1)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Drag the panel by its title."""
        far = (event.position() - self._pressed).manhattanLength() >= QApplication.startDragDistance()
        if self._pressed.x() >= 0 and far and event.buttons() & Qt.MouseButton.LeftButton:
            self._pressed = QPointF(-1, -1)
            self.drag_title()

    def drag_title(self) -> None:
        """Drag a small picture of the panel until it is dropped."""
        drag = QDrag(self)
        drag.setMimeData(self.mime_data())
        drag.setPixmap(self.grab().scaledToWidth(DRAGGED_PX, Qt.TransformationMode.SmoothTransformation))
        drag.exec(Qt.DropAction.MoveAction)

    def mime_data(self) -> QMimeData:
        """Return what a drag of the title carries: the panel's key."""
        data = QMimeData()
        data.setData(PANEL_MIME, self.key.encode())
        return data

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
        self._put(widget, True)

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

    def bind(self, store: Store, **choosers: QComboBox) -> None:
        """Let choosers choose entries of the state by these names, and show what a state has there (`show_state`)."""
        for name, box in choosers.items():
            box.activated.connect(lambda _, name=name, box=box: store.update(**{name: box.currentData()}))
        self.choosers |= choosers

    def show_state(self, state: State) -> None:
        """Follow a state with the choosers; no signal goes back."""
        for name, box in self.choosers.items():
            select(box, entry(state, name))

    def set_body(self, widget: QWidget) -> None:
        """Put the picture under the title line."""
        self.column.addWidget(widget, 1)

    def set_readout(self, text: str, details: str = "") -> None:
        """Show a line of numbers, as it is; its tooltip has the whole of it, and ``details``."""
        text = local(text)
        self.readout.setToolTip(f"{text}<br>{local(details)}" if details else text)
        if self.readout.text() != text:
            self.readout.setText(text)
            if self.head.indexOf(self.readout) >= 0:  # it goes back there when the card is resized
                self._fit_head()


def chart_at(widget: QWidget, point: QPoint) -> Chart | None:
    """Return the chart under a pixel."""
    found = widget.childAt(point)
    while found is not None and not isinstance(found, Chart):
        found = found.parentWidget()
    return found


CHEVRON_TYPE = 15.0  # pixels: the height of type beside which a chevron has its plain size


def paint_chevron(widget: QWidget) -> None:
    """Paint the arrow at the end of a box that opens: at the right, in a mirrored window at the left."""
    painter = QPainter(widget)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(widget.palette().color(QPalette.ColorRole.PlaceholderText), 1.6))
    unit = widget.fontMetrics().height() / CHEVRON_TYPE
    y, half, mirrored = widget.height() / 2 - 1.5 * unit, 3.5 * unit, widget.isRightToLeft()
    x = 13.0 * unit if mirrored else widget.width() - 13.0 * unit
    painter.drawPolyline(QPolygonF([QPointF(x - half, y), QPointF(x, y + half), QPointF(x + half, y)]))


class Chooser(QComboBox):
    """A combo box with a chevron, since a style sheet takes the native arrow away; digits are the window's."""

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave digits to the window, where Qt would choose the next item that begins with one."""
        if event.text().isdigit():
            event.ignore()
        else:
            super().keyPressEvent(event)

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


def combo_of(choices: dict[str, str], tip: str, parent: QWidget | None = None) -> QComboBox:
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


def select_or_add(box: QComboBox, value: str, words: str) -> None:
    """Show a value without a signal; one that is not offered joins the others under its ``words``."""
    if box.findData(value) < 0:
        box.addItem(words, value)
    select(box, value)


SIDE_PX = 196
LINE_SPACE = 4  # pixels between the controls of a line


class SideCard(Card):
    """A card with title, readout and controls in a column of ``SIDE_PX`` pixels at scale 1, and the picture beside."""

    _strut: QWidget | None = None

    def __init__(self, title: str, tip: str = "", parent: QWidget | None = None):
        super().__init__(title, tip, parent)
        self.side, self.whole = QVBoxLayout(), QHBoxLayout()
        self._strut = QWidget(self)
        self.side.addWidget(self._strut)
        self.side.setSpacing(4)
        self.column.removeItem(self.head)
        self.head.setParent(None)
        self.side.addLayout(self.head)
        self.lines = self.side
        self.whole.setSpacing(10)
        self.whole.addLayout(self.side)
        self.column.addLayout(self.whole, 1)

    def rescale(self, scale: float) -> None:
        """Take a scale of type, which widens the column too."""
        super().rescale(scale)
        if self._strut:
            self._strut.setFixedSize(self.side_px(), 0)

    def side_px(self) -> int:
        """Return the width of the column."""
        return round(SIDE_PX * self._scale)

    def _title_room(self) -> int:
        return self._strut.width() if self._strut else 0

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


class TurningCard(SideCard):
    """A side card whose controls stand in two or three rows above the picture where that leaves it more room."""

    _rows = 0  # of controls above the picture, 0 where they stand beside it

    def __init__(self, title: str, tip: str = "", parent: QWidget | None = None):
        super().__init__(title, tip, parent)
        self._groups: list[QWidget] = []
        self.grid = QGridLayout()
        self.grid.setSpacing(4)
        self.side.addLayout(self.grid)
        self._rest: QWidget | None = None

    def add_rest(self, widget: QWidget) -> None:
        """Give a widget the rest of the column's height, or above the picture a line of its own."""
        super().add_rest(widget)
        self._rest = widget

    def set_body(self, widget: QWidget) -> None:
        """Put the picture beside the column, or below the rows."""
        super().set_body(widget)
        if self._rest is None:
            self.side.addStretch(1)

    def add_group(self, *widgets: QWidget) -> None:
        """Add controls that stand beside each other, a line of the column or a cell of the rows."""
        group = QWidget(self)
        line = QHBoxLayout(group)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(LINE_SPACE)
        for widget in widgets:
            widget.setSizePolicy(_IGNORED if isinstance(widget, QComboBox) else _EXPANDING, QSizePolicy.Policy.Fixed)
            line.addWidget(widget, max(1, widget.sizeHint().width()))
        self.grid.addWidget(group, len(self._groups), 0)
        self._groups.append(group)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Turn the controls to where the picture has more room."""
        self._fit()
        super().resizeEvent(event)

    def event(self, event: QEvent) -> bool:
        """Divide the width again where a control needs more or less of it."""
        if event.type() == QEvent.Type.LayoutRequest:
            self._fit()
        return super().event(event)

    def side_px(self) -> int:
        """Return the width of the column, in which every control can be read."""
        return max(super().side_px(), *(needed_px(group) for group in self._groups), 0)

    def _fit(self) -> None:
        """Turn the controls, and give each as much of the width as it needs."""
        column = self.side_px()
        if self._strut and self._strut.width() != column:
            self._strut.setFixedSize(column, 0)
        margins = self.column.contentsMargins()
        rows = 2 if sum(self._columns_px(2)) <= self.width() - margins.left() - margins.right() else 3
        above = min(self.width(), self.height() - self._rows_px(rows)) > min(self.width() - column, self.height())
        self._turn(rows if above else 0)
        stretches = self._columns_px(rows) if above else []
        for number in range(len(self._groups)):
            self.grid.setColumnStretch(number, stretches[number] if number < len(stretches) else 0)

    def _columns_px(self, rows: int) -> list[int]:
        """Return the widths in which the controls can be read where so many stand above one another."""
        needed = [needed_px(group) if group.isVisibleTo(self) else 0 for group in self._groups]
        return [max(needed[first : first + rows]) for first in range(0, len(needed), rows)]

    def _rows_px(self, rows: int) -> int:
        """Return the height of title and rows of controls."""
        high = max((group.sizeHint().height() for group in self._groups), default=0)
        return self.head.sizeHint().height() + rows * high + 2 * rows * self.grid.spacing()

    def _title_room(self) -> int:
        return self.width() if self._rows else super()._title_room()

    def _turn(self, rows: int) -> None:
        if rows == self._rows:
            return
        self._rows, above = rows, bool(rows)
        self.whole.setDirection(QBoxLayout.Direction.TopToBottom if above else QBoxLayout.Direction.LeftToRight)
        if self._rest:
            self._rest.setSizePolicy(_IGNORED, QSizePolicy.Policy.Maximum if above else QSizePolicy.Policy.Ignored)
        for number, group in enumerate(self._groups):
            self.grid.removeWidget(group)
            self.grid.addWidget(group, *((number % rows, number // rows) if above else (number, 0)))


def needed_px(group: QWidget) -> int:
    """Return the width in which the controls of a line can be read."""
    parts = [part for part in group.findChildren(QWidget, options=DIRECT) if part.isVisibleTo(group)]
    return sum(part.sizeHint().width() + LINE_SPACE for part in parts)


DIRECT = Qt.FindChildOption.FindDirectChildrenOnly
_IGNORED, _EXPANDING = QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Expanding
