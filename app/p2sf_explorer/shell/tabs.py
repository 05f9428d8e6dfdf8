"""The tabs: five groups, of which one shows its panels, and the panels that stand in windows of their own."""

from functools import partial

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QSize, Qt, Signal
from PySide6.QtGui import QCloseEvent, QMouseEvent, QShortcut
from PySide6.QtWidgets import (
    QButtonGroup,
    QHBoxLayout,
    QLabel,
    QMenu,
    QPushButton,
    QTabWidget,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from p2sf_explorer.charts.theme import SPACE
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels import GROUPS, PanelEntry

OWN_WINDOW = "Open in its own window (double-click the tab or drag it out, or Ctrl+D)"
OUT_PX = 40  # a tab dragged farther off the bar than this gets a window of its own
APART = (("Pop out", OWN_WINDOW), ("Put back", "Close the panel's own window and have it back under its tab (Ctrl+D)"))
ALL = "Every panel by its group (Alt+0)"
SIZE = 720, 480
FRAME = 12  # px around a window, where its manager paints a frame


class Tabs(QTabWidget):
    """Every panel has a page; the bar shows those of one group, the buttons before it the groups, the menu all."""

    detach_asked = Signal(str)
    chosen = Signal(str)

    def __init__(self, entries: tuple[PanelEntry, ...], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._groups = {entry.key: entry.group for entry in entries}
        self._last: dict[str, str] = {}
        self._out, self._apart = False, APART[False]
        self._pages = {entry.key: page(entry.key) for entry in entries}
        for entry in entries:
            self.addTab(self._pages[entry.key], tr(entry.title))
        self.buttons = GroupButtons(tuple(g for g in GROUPS if g in self._groups.values()), self)
        self.buttons.chosen.connect(self.open_group)
        self.setCornerWidget(self.buttons, Qt.Corner.TopLeftCorner)
        self.menu = self._all_panels(entries)
        self.setCornerWidget(self._tools(), Qt.Corner.TopRightCorner)
        self.setUsesScrollButtons(True)
        self.tabBar().setAccessibleName(tr("Panels"))
        self.tabBar().setElideMode(Qt.TextElideMode.ElideNone)
        self.tabBarDoubleClicked.connect(lambda at: self.detach_asked.emit(self._key(at)))
        self.currentChanged.connect(self._show_group)
        self.tabBar().installEventFilter(self)
        self._show_group()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Detach a tab that is dragged off the bar."""
        if not isinstance(event, QMouseEvent):
            return super().eventFilter(watched, event)
        if event.type() == QEvent.Type.MouseMove and event.buttons() & Qt.MouseButton.LeftButton:
            bar, place = self.tabBar(), event.position().toPoint()
            if not bar.rect().adjusted(-OUT_PX, -OUT_PX, OUT_PX, OUT_PX).contains(place) and not self._out:
                self._out = True
                self.detach()
        elif event.type() == QEvent.Type.MouseButtonRelease:
            self._out = False
        return False

    def pages(self) -> dict[str, QWidget]:
        """Return the page of every panel."""
        return self._pages

    def current(self) -> str:
        """Return the key of the panel in front."""
        return self._key(self.currentIndex())

    def _key(self, number: int) -> str:
        page = self.widget(number)
        return page.objectName() if page else ""

    def bring_up(self, key: str) -> None:
        """Bring a panel to the front, and its group with it, without a signal."""
        if self.current() != key:
            self.blockSignals(True)
            self.setTabVisible(self.indexOf(self.pages()[key]), True)
            self.setCurrentWidget(self.pages()[key])
            self.blockSignals(False)
            self._show_group()

    def detach(self) -> None:
        """Ask for the panel in front in a window of its own, or back."""
        self.detach_asked.emit(self.current())

    def show_apart(self, keys: tuple[str, ...]) -> None:
        """Name what the button does to the panel in front; ``keys`` are the panels in windows of their own."""
        if (words := APART[self.current() in keys]) != self._apart:  # checked first: a slider calls this on every move
            self._apart = words
            _name(self.apart, *words)

    def open_group(self, group: str) -> None:
        """Open the panel of a group that was last in front, else its first."""
        first = next(key for key, own in self._groups.items() if own == group)
        self.chosen.emit(self._last.get(group, first))

    def _show_group(self) -> None:
        """Show the tabs of the group in front and hide the others."""
        group = self._groups[self.current()]
        self._last[group] = self.current()
        self.buttons.mark(group)
        for k in range(self.count()):
            self.setTabVisible(k, self._groups[self._key(k)] == group)

    def _all_panels(self, entries: tuple[PanelEntry, ...]) -> QMenu:
        menu = QMenu(self)
        for group in GROUPS:
            menu.addSection(tr(group))
            for entry in (entry for entry in entries if entry.group == group):
                menu.addAction(tr(entry.title), partial(self.chosen.emit, entry.key))
        return menu

    def _tools(self) -> QWidget:
        holder = QWidget(self)
        row = QHBoxLayout(holder)
        row.setContentsMargins(0, 1, 0, 3)
        row.setSpacing(SPACE // 2)
        self.apart, everything = QToolButton(holder), QToolButton(holder)
        for button, words in ((self.apart, APART[False]), (everything, ("All", ALL))):
            button.setObjectName("small")
            _name(button, *words)
            row.addWidget(button)
        everything.setShortcut("Alt+0")
        self.apart.clicked.connect(self.detach)
        everything.setMenu(self.menu)
        everything.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        return holder


def _name(button: QToolButton, text: str, tip: str) -> None:
    button.setText(tr(text))
    button.setToolTip(tr(tip))
    button.setAccessibleName(tr(tip))


class GroupButtons(QWidget):
    """One button for each group, one of them checked; Alt+1, Alt+2 … press them."""

    chosen = Signal(str)

    def __init__(self, groups: tuple[str, ...], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._group = QButtonGroup(self)
        self.named: dict[str, QPushButton] = {}
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 1, SPACE, 3)
        row.setSpacing(2)
        for number, group in enumerate(groups, 1):
            button = QPushButton(tr(group), self)
            button.setObjectName("group")
            button.setCheckable(True)
            button.setShortcut(f"Alt+{number}")
            button.setToolTip(tr("Panels of the group {group} (Alt+{number})", group=tr(group), number=number))
            button.clicked.connect(lambda _, group=group: self.chosen.emit(group))
            self._group.addButton(button)
            self.named[group] = button
            row.addWidget(button)

    def mark(self, group: str) -> None:
        """Show which group is in front."""
        self.named[group].setChecked(True)


class OwnWindow(QWidget):
    """A window of a panel's own; ``closed`` asks for the panel to be put back."""

    closed = Signal(str)

    def __init__(self, key: str, title: str, parent: QWidget) -> None:
        super().__init__(parent, Qt.WindowType.Window)
        self.setObjectName("window")
        self.setWindowTitle(f"{tr(title)} · P2SF Explorer")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.key = key
        QVBoxLayout(self).setContentsMargins(SPACE, SPACE, SPACE, SPACE)
        self.setGeometry(self._first_place(parent))
        for keys in ("Ctrl+D", "Ctrl+W"):
            QShortcut(keys, self, self.close)

    @staticmethod
    def _first_place(parent: QWidget) -> QRect:
        """Return where a window opens that has never been moved."""
        controls = parent.findChild(QWidget, "controls")
        covered = QRect(controls.mapToGlobal(QPoint()), controls.size()) if controls else QRect()
        covered.adjust(-FRAME, 0, FRAME, 0)
        return beside(QSize(*SIZE), parent.frameGeometry(), covered, parent.screen().availableGeometry())

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask for the panel to be put back under its tab."""
        self.closed.emit(self.key)
        event.accept()


def beside(size: QSize, window: QRect, controls: QRect, screen: QRect) -> QRect:
    """Return where a window of its own is put: beside the main window, else over it but not over its controls.

    All in global pixels. Where the screen has too little room the window is made smaller.
    """
    rooms = [side for keep in (window, controls) for side in (right_of(keep, screen), left_of(keep, screen))]
    fits = [room for room in rooms if room.width() >= size.width() and room.height() >= size.height()]
    room = fits[0] if fits else max(rooms[2:], key=QRect.width)
    place = QRect(room.topLeft(), size.boundedTo(room.size()))
    if room is rooms[1]:
        place.moveTopRight(room.topRight())
    elif room not in rooms[:2]:
        place.moveBottomRight(room.intersected(window).bottomRight() if room.intersects(window) else room.bottomRight())
        place.moveTop(max(place.top(), room.top()))
        place.moveLeft(max(place.left(), room.left()))
    return place


def right_of(keep: QRect, screen: QRect) -> QRect:
    """Return what the screen has at the right of a rectangle."""
    return QRect(QPoint(max(keep.right() + 1, screen.left()), screen.top()), screen.bottomRight())


def left_of(keep: QRect, screen: QRect) -> QRect:
    """Return what the screen has at the left of a rectangle."""
    return QRect(screen.topLeft(), QPoint(min(keep.left() - 1, screen.right()), screen.bottom()))


def page(key: str) -> QWidget:
    """Return the page of a tab, with the note to show while its panel stands elsewhere."""
    made = QWidget()
    made.setObjectName(key)
    column = QVBoxLayout(made)
    column.setContentsMargins(0, 0, 0, 0)
    note = QLabel(tr("This panel stands in its own window; close that window to have it back here."), made)
    note.setObjectName("muted")
    note.setAlignment(Qt.AlignmentFlag.AlignCenter)
    note.setWordWrap(True)  # so that it fits a narrow place of the grid
    note.hide()
    column.addWidget(note)
    return made
