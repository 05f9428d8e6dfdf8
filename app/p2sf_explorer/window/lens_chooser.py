"""The lens chooser: a button with the present lens's title, and a gallery of the shipped ones under it."""

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QPoint, QRect, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import (
    QColor,
    QKeyEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
    QStandardItem,
    QStandardItemModel,
)
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QListView,
    QPushButton,
    QSizePolicy,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from p2sf_explorer.charts.painting import small_font
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.setup import shipped_names, title
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.widgets.card import paint_chevron
from p2sf_explorer.widgets.thumbnail import paint_lens
from p2sf_explorer.window.lens_cards import FILTERS, LensCard, lens_card, lens_tags

NAME = Qt.ItemDataRole.UserRole
WIDE, NARROW = 560, 110
CELL, PICTURE = QSize(254, 172), 74
COLUMNS, EDGES, HEIGHT = 4, 44, 4 * 172 + 48  # margins, frame and the scroll bar stand beside the columns
ModelIndex = QModelIndex | QPersistentModelIndex
TIP = "Choose a shipped lens (Ctrl+L); for files use Open (Ctrl+O)"
ALIGN = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop


class LensChooser(QPushButton):
    """Shows the present lens; clicked, it opens the gallery."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(tr("Lens"))
        self.setToolTip(tr(TIP))
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self.setObjectName("lens")
        self._name, self._title, self._theme = "", "", LIGHT
        self.gallery: Gallery | None = None
        self.clicked.connect(self.open_gallery)

    def currentData(self) -> str:
        """Return the name of the present lens, as a combo box returns its choice."""
        return self._name

    def show_lens(self, name: str, shown_title: str, theme: Tokens) -> None:
        """Show a lens by its title, as far as its first comma; the tooltip has the whole."""
        if theme.scale != self._theme.scale:
            self.updateGeometry()
        self._theme = theme
        if (name, shown_title) != (self._name, self._title):
            self._name, self._title = name, tr(shown_title)
            self._fit()
            self.setAccessibleDescription(shown_title)
            self.setToolTip(f"{self._title}\n{tr(TIP)}")

    def sizeHint(self) -> QSize:
        """Return a width that holds most titles."""
        return QSize(self._theme.px(WIDE), super().sizeHint().height())

    def minimumSizeHint(self) -> QSize:
        """Return a width that holds the beginning of a title, for a small window."""
        return QSize(self._theme.px(NARROW), super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show as much of the title as there is room for."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        room = self.width() - self._theme.px(34)
        self.setText(self.fontMetrics().elidedText(self._title.partition(",")[0], Qt.TextElideMode.ElideRight, room))

    def open_gallery(self) -> None:
        """Open the gallery under the button, the present lens chosen."""
        if self.gallery is None:
            self.gallery = Gallery(self)
            self.gallery.chosen.connect(self.chosen)
        self.gallery.open_at(self.mapToGlobal(QPoint(0, self.height() + 4)), self._name, self._theme)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Open the gallery with the keys that open a combo box."""
        if event.key() in (Qt.Key.Key_Down, Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.open_gallery()
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the button, then a chevron."""
        super().paintEvent(event)
        paint_chevron(self)


class Gallery(QFrame):
    """The shipped lenses as cards; a card is computed when it first comes into view, one at a time."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self.setObjectName("card")
        self.list, self.cards = QListView(self), CardPainter(self)
        self.list.setModel(self._model())
        self.list.setItemDelegate(self.cards)
        self.list.setViewMode(QListView.ViewMode.IconMode)
        self.list.setMovement(QListView.Movement.Static)
        self.list.setResizeMode(QListView.ResizeMode.Adjust)
        self.list.setFrameShape(QListView.Shape.NoFrame)
        self.list.setAccessibleName(tr("Shipped lenses"))
        self.list.setMouseTracking(True)
        self.list.clicked.connect(self._choose)
        self.list.activated.connect(self._choose)
        hint = QLabel(
            tr("Find a lens with the arrow keys or its first letters; Enter opens it. Your own files: Ctrl+O."), self
        )
        hint.setObjectName("muted")
        self.filters = {tag: self._filter(tag, words) for tag, words in FILTERS.items()}
        chosen = QHBoxLayout()
        for button in self.filters.values():
            chosen.addWidget(button)
        chosen.addStretch(1)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.addLayout(chosen)
        column.addWidget(self.list, 1)
        column.addWidget(hint)
        self.cards.arrived.connect(self.list.viewport().update)

    def _filter(self, tag: str, words: str) -> QPushButton:
        button = QPushButton(tr(words), self)
        button.setObjectName("segment")
        button.setCheckable(True)
        button.setToolTip(tr("Show only such lenses; press again for all"))
        button.clicked.connect(lambda on: self._show_only(tag if on else ""))
        return button

    def _show_only(self, tag: str) -> None:
        """Show the lenses that have a tag, all for ""."""
        model = self.list.model()
        for row in range(model.rowCount()):
            self.list.setRowHidden(row, bool(tag) and tag not in lens_tags(model.index(row, 0).data(NAME)))
        for name, button in self.filters.items():
            button.setChecked(name == tag)
        shown = [row for row in range(model.rowCount()) if not self.list.isRowHidden(row)]
        if shown and self.list.isRowHidden(self.list.currentIndex().row()):
            self.list.setCurrentIndex(model.index(shown[0], 0))
        self.list.doItemsLayout()

    @staticmethod
    def _model() -> QStandardItemModel:
        model = QStandardItemModel()
        for name in shipped_names():
            item = QStandardItem(tr(title(name)))
            item.setData(name, NAME)
            item.setEditable(False)
            model.appendRow(item)
        return model

    def open_at(self, place: QPoint, name: str, theme: Tokens) -> None:
        """Show the gallery at a place on the screen, a lens chosen."""
        self.cards.theme = theme
        self.list.setGridSize(CELL * theme.scale)
        self.list.setStyleSheet(f"QListView {{ background: {theme.card}; outline: none; }}")
        room = self.screen().availableGeometry()
        cell, edges = CELL.width() * theme.scale, EDGES * theme.scale
        columns = max(1, min(COLUMNS, int((room.width() - 16 - edges) // cell)))
        wide, high = round(columns * cell + edges), round(HEIGHT * theme.scale)
        size = QSize(wide, high).boundedTo(QSize(room.width() - 16, room.height() - 16))
        corner = QPoint(min(place.x(), room.right() - size.width()), min(place.y(), room.bottom() - size.height()))
        self.setGeometry(QRect(corner, size))
        self._show_only("")
        model = self.list.model()
        found = model.match(model.index(0, 0), NAME, name, 1, Qt.MatchFlag.MatchExactly)
        self.list.setCurrentIndex(found[0] if found else model.index(0, 0))
        self.show()
        self.list.doItemsLayout()  # for this width: the list was laid out before it had one
        self.list.scrollTo(self.list.currentIndex())
        self.list.setFocus()

    def _choose(self, index: QModelIndex) -> None:
        if self.isVisible():  # a click may also count as an activation
            self.hide()
            self.chosen.emit(index.data(NAME))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Close with Escape."""
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
        else:
            super().keyPressEvent(event)


class CardPainter(QStyledItemDelegate):
    """Paints cards; the figures of a card that is new are computed between two frames."""

    arrived = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.theme: Tokens = LIGHT
        self.known: dict[str, LensCard] = {}
        self._awaited: list[str] = []
        self._timer = QTimer(self, singleShot=True, interval=0)
        self._timer.timeout.connect(self._compute_next)

    def _compute_next(self) -> None:
        if self._awaited:
            name = self._awaited.pop(0)
            self.known[name] = lens_card(name)
            self.arrived.emit()
            self._timer.start()

    def sizeHint(self, option: QStyleOptionViewItem, index: ModelIndex) -> QSize:
        """Return the size of a card."""
        return CELL * self.theme.scale

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: ModelIndex) -> None:
        """Paint a card, or its title alone until its figures are there."""
        name, room = index.data(NAME), QRectF(option.rect).adjusted(4, 4, -4, -4)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint_ground(painter, room, option.state)
        inner = room.adjusted(10, 8, -10, -6)
        if name in self.known:
            self._paint_card(painter, self.known[name], inner)
        elif name not in self._awaited:
            self._awaited.append(name)
            self._timer.start()
        painter.setPen(QColor(self.theme.text))
        painter.setFont(small_font(self.theme.px(12)))
        words = painter.fontMetrics().elidedText(index.data(), Qt.TextElideMode.ElideRight, round(inner.width()))
        painter.drawText(inner.adjusted(0, self.theme.px(PICTURE + 4), 0, 0), ALIGN, words)
        painter.restore()

    def _paint_ground(self, painter: QPainter, room: QRectF, state: QStyle.StateFlag) -> None:
        chosen = bool(state & QStyle.StateFlag.State_Selected)
        under = bool(state & QStyle.StateFlag.State_MouseOver)
        painter.setPen(QPen(QColor(self.theme.accent if chosen else self.theme.line), 2 if chosen else 1))
        painter.setBrush(QColor(self.theme.raised if chosen or under else self.theme.card))
        painter.drawRoundedRect(room, 6, 6)

    def _paint_card(self, painter: QPainter, card: LensCard, room: QRectF) -> None:
        if card.drawing:
            paint_lens(
                painter,
                card.drawing,
                QRectF(room.left(), room.top(), room.width(), self.theme.px(PICTURE - 6)),
                self.theme,
            )
        painter.setPen(QColor(self.theme.muted))
        painter.setFont(small_font(self.theme.small))
        painter.drawText(room.adjusted(0, self.theme.px(PICTURE + 21), 0, 0), ALIGN, local(tr(card.facts)))
        words = said(card.problem) if card.problem else tr(card.character)
        painter.drawText(room.adjusted(0, self.theme.px(PICTURE + 37), 0, 0), ALIGN | Qt.TextFlag.TextWordWrap, words)
