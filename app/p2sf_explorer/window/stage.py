"""The room of the panels: one large stage, and beside it a rail of satellites that ends in the tabs."""

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QDragEnterEvent, QDragLeaveEvent, QDropEvent, QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QFrame, QLabel, QScrollArea, QSplitter, QVBoxLayout, QWidget

from p2sf_explorer.charts.theme import SPACE
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.state import Display
from p2sf_explorer.widgets.card import PANEL_MIME

SETTLE_MS = 250  # after the last move of a handle, before its place goes into the state
UPRIGHT = 1.5  # height over width from which two cards stand one above the other
WHOLE = 10_000  # of the sizes of a splitter's parts, which are whole numbers


class PanelPlace(QFrame):
    """A place for one panel, with the note to show while the panel stands in a window of its own.

    ``dropped`` carries the key of a panel whose title was dropped here.
    """

    dropped = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("place")
        self.setAcceptDrops(True)
        self.column = column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        self.note = QLabel(tr("This panel stands in its own window; close that window to have it back here."), self)
        self.note.setObjectName("muted")
        self.note.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.note.setWordWrap(True)  # so that it fits a narrow place
        self.note.hide()
        column.addWidget(self.note)
        self.cards = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self.cards.setSpacing(SPACE)
        column.addLayout(self.cards, 1)

    def put(self, card: QWidget) -> None:
        """Take a card, beside the one that is there."""
        self.cards.addWidget(card, 1)
        card.show()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Have two cards beside each other, or one above the other where there is much more height than width."""
        super().resizeEvent(event)
        upright = self.height() > UPRIGHT * self.width()
        self.cards.setDirection(QBoxLayout.Direction.TopToBottom if upright else QBoxLayout.Direction.LeftToRight)

    def put_above(self, widget: QWidget) -> None:
        """Have a widget above the panel."""
        self.column.insertWidget(0, widget)

    def put_below(self, widget: QWidget) -> None:
        """Have a widget below the panel."""
        self.column.addWidget(widget)

    def show_note(self, shown: bool) -> None:
        """Say, or no longer say, where the panel is."""
        self.note.setVisible(shown)

    def _mark(self, target: bool) -> None:
        """Show or hide the frame of a place that would take what is dragged over it."""
        self.setProperty("target", target)
        self.style().unpolish(self)
        self.style().polish(self)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take panels; everything else is left to the window."""
        if event.mimeData().hasFormat(PANEL_MIME):
            event.acceptProposedAction()
            self._mark(True)
        else:
            event.ignore()

    def dragLeaveEvent(self, event: QDragLeaveEvent) -> None:
        """Hide the frame again."""
        self._mark(False)

    def dropEvent(self, event: QDropEvent) -> None:
        """Tell which panel was dropped."""
        self._mark(False)
        event.acceptProposedAction()
        self.dropped.emit(event.mimeData().data(PANEL_MIME).toStdString())


class ShareSplitter(QSplitter):
    """A splitter whose parts keep their shares of the length when it is resized; ``moved`` follows a person's hand.

    Qt alone keeps the present sizes in proportion, which a smallest size has perhaps pushed away from the shares.
    """

    moved = Signal()

    def __init__(self, orientation: Qt.Orientation, parent: QWidget | None = None) -> None:
        super().__init__(orientation, parent)
        self.setHandleWidth(SPACE)
        self.setChildrenCollapsible(False)
        self._shares: tuple[float, ...] = ()
        self._settling = QTimer(self)
        self._settling.setSingleShot(True)
        self._settling.setInterval(SETTLE_MS)
        self._settling.timeout.connect(self._settle)
        self.splitterMoved.connect(lambda: self._settling.start())

    def rescale(self, scale: float) -> None:
        """Take a scale of type, which the gaps between the parts follow."""
        self.setHandleWidth(round(SPACE * scale))

    def share(self, shares: tuple[float, ...]) -> None:
        """Give the parts these shares, 0 for one that is hidden."""
        self._settling.stop()
        self._shares = shares
        self.setSizes([round(WHOLE * share) for share in shares])

    def shares(self) -> tuple[float, ...]:
        """Return the shares of the parts on show as they are now."""
        found = [size for k, size in enumerate(self.sizes()) if (part := self.widget(k)) and not part.isHidden()]
        return tuple(round(size / max(1, sum(found)), 3) for size in found)

    def _settle(self) -> None:
        self._shares = tuple(size / WHOLE for size in self.sizes())
        self.moved.emit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the shares."""
        super().resizeEvent(event)
        if self._shares and not self._settling.isActive():
            self.setSizes([round(WHOLE * share) for share in self._shares])


class Rail(QScrollArea):
    """The satellites in a row, the tabs last; it scrolls where they do not fit."""

    def __init__(self, parts: ShareSplitter, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.parts = parts
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setWidget(parts)
        for part in (self, self.viewport(), parts):
            part.setAutoFillBackground(False)

    def minimumSizeHint(self) -> QSize:
        """Return room for the parts across the rail; along it they may scroll."""
        least = self.parts.minimumSizeHint()
        if self.parts.orientation() == Qt.Orientation.Vertical:
            return QSize(least.width(), min(least.height(), 200))
        return QSize(min(least.width(), 200), least.height())


class PanelRoom(ShareSplitter):
    """The stage and the rail.

    ``resized`` carries the changed entries of the state after a person has moved a handle; ``dropped`` the key of a
    panel and the number of the place that its title was dropped on: 0 the stage, 1 the first satellite.
    """

    resized = Signal(object)
    dropped = Signal(str, int)

    def __init__(self, tabs: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self.parts = ShareSplitter(Qt.Orientation.Vertical)
        self.parts.addWidget(tabs)
        self.rail = Rail(self.parts, self)
        self.satellites: list[PanelPlace] = []
        self.stage = self._place(0)
        self.addWidget(self.stage)
        self.addWidget(self.rail)
        self._arranged: tuple[object, ...] = ()
        self.moved.connect(lambda: self.resized.emit({"stage_share": min(0.95, max(0.1, self.shares()[0]))}))
        self.parts.moved.connect(lambda: self.resized.emit({"rail_shares": self.parts.shares()}))

    def _place(self, number: int) -> PanelPlace:
        made = PanelPlace(self)
        made.dropped.connect(lambda key: self.dropped.emit(key, number))
        return made

    def make_satellites(self, count: int) -> None:
        """Have at least so many places for satellites."""
        while len(self.satellites) < count:
            self.satellites.append(self._place(len(self.satellites) + 1))
            self.parts.insertWidget(len(self.satellites) - 1, self.satellites[-1])

    def arrange(self, display: Display) -> None:
        """Give the rail its side and a place for each satellite, and both their shares of the room."""
        count = len(display.rail) + 1
        wanted = display.rail_side, display.show_rail, display.stage_share, display.rail_shares, count
        if wanted == self._arranged:
            return
        self._arranged = wanted
        self.make_satellites(count - 1)
        for number, place in enumerate(self.satellites):
            place.setVisible(number < count - 1)
        right = display.rail_side == "right"
        self.setOrientation(Qt.Orientation.Horizontal if right else Qt.Orientation.Vertical)
        self.parts.setOrientation(Qt.Orientation.Vertical if right else Qt.Orientation.Horizontal)
        self.rail.setVisible(display.show_rail)
        self.share((display.stage_share, 1 - display.stage_share))
        shares = display.rail_shares if len(display.rail_shares) == count else (1 / count,) * count
        self.parts.share((*shares[:-1], *(0.0 for _ in self.satellites[count - 1 :]), shares[-1]))
