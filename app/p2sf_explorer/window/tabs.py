"""The tabs: five groups, of which one shows its panels, and the panels that stand in windows of their own."""

from functools import partial

from PySide6.QtCore import QEvent, QObject, QPoint, QRect, QSize, Qt, Signal
from PySide6.QtGui import QCloseEvent, QMouseEvent, QPaintEvent, QResizeEvent, QShortcut
from PySide6.QtWidgets import (
    QButtonGroup,
    QHBoxLayout,
    QMenu,
    QPushButton,
    QTabWidget,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from p2sf_explorer.charts.theme import SPACE
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.panels import GROUPS, PanelEntry
from p2sf_explorer.widgets.card import paint_chevron
from p2sf_explorer.widgets.command import Command
from p2sf_explorer.window.stage import PanelPlace

QWIDGETSIZE_MAX = (1 << 24) - 1  # Qt's own: no limit
OUT_PX = 40  # a tab dragged farther off the bar than this gets a window of its own
ALL = "Every panel by its group (Alt+0)"
SIZE = 720, 480
FRAME = 12  # px around a window, where its manager paints a frame


class Tabs(QTabWidget):
    """Every panel has a page; the bar shows those of one group, the buttons before it the groups, the menu all.

    ``stage_asked`` and ``detach_asked`` carry the panel that is to have the stage or a window of its own, ``dropped``
    one whose title was dropped here. Where there is little room one button stands for all groups, or for all panels.
    """

    detach_asked = Signal(str)
    stage_asked = Signal(str)
    chosen = Signal(str)
    dropped = Signal(str)

    def __init__(self, entries: tuple[PanelEntry, ...], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._groups = {entry.key: entry.group for entry in entries}
        self._last: dict[str, str] = {}
        self._out = self._narrow = False
        self._elsewhere: tuple[str, ...] = ()
        self._pages = {entry.key: PanelPlace(self) for entry in entries}
        for entry in entries:
            self._pages[entry.key].setObjectName(entry.key)
            self._pages[entry.key].dropped.connect(self.dropped)
            self.addTab(self._pages[entry.key], tr(entry.title))
        self.buttons = GroupButtons(tuple(g for g in GROUPS if g in self._groups.values()), self)
        self.buttons.chosen.connect(self.open_group)
        self.menu = self._all_panels(entries)
        self.buttons.all.setMenu(self.menu)
        self.setCornerWidget(self.buttons, Qt.Corner.TopLeftCorner)
        self.setUsesScrollButtons(True)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the bar alone takes the focus, or Tab would come to it twice
        self.tabBar().setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.tabBar().setAccessibleName(tr("Panels"))
        self.tabBar().setElideMode(Qt.TextElideMode.ElideNone)
        self.tabBarDoubleClicked.connect(lambda at: self.stage_asked.emit(self._key(at)))
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

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Have one button for all groups where the buttons and the longest row of tabs do not fit."""
        bar, sizes = self.tabBar(), dict.fromkeys(self._groups.values(), 0)
        for key, group in self._groups.items():
            if key not in self._elsewhere:
                sizes[group] += bar.tabSizeHint(self.indexOf(self._pages[key])).width()
        longest, room = max(sizes.values()), event.size().width()
        self.buttons.show_all(self.buttons.wide() + longest <= room)
        self._narrow = self.buttons.least() + longest > room
        bar.setMaximumWidth(0 if self._narrow else QWIDGETSIZE_MAX)
        bar.setFocusPolicy(Qt.FocusPolicy.NoFocus if self._narrow else Qt.FocusPolicy.TabFocus)
        self._name_front()
        super().resizeEvent(event)

    def _name_front(self) -> None:
        """Name the panel in front on the button for all where no tab does."""
        self.buttons.name_panel(self.tabText(self.currentIndex()) if self._narrow else "")

    def commands(self) -> tuple[Command, ...]:
        """Return a command for each group of panels."""
        return tuple(
            Command(group, partial(self.open_group, group), (f"Alt+{number}",), "Group of panels")
            for number, group in enumerate(self.buttons.named, 1)
        )

    def pages(self) -> dict[str, PanelPlace]:
        """Return the page of every panel."""
        return self._pages

    def current(self) -> str:
        """Return the key of the panel in front."""
        return self._key(self.currentIndex())

    def _key(self, number: int) -> str:
        page = self.widget(number)
        return page.objectName() if page else ""

    def bring_up(self, key: str, elsewhere: tuple[str, ...] = ()) -> None:
        """Bring a panel to the front, and its group with it, without a signal; no tab for those that are elsewhere."""
        if (self.current(), self._elsewhere) != (key, elsewhere):
            self._elsewhere = elsewhere
            self.blockSignals(True)
            self.setTabVisible(self.indexOf(self.pages()[key]), True)
            self.setCurrentWidget(self.pages()[key])
            self._show_group()
            self.blockSignals(False)

    def detach(self) -> None:
        """Ask for the panel in front in a window of its own, or back."""
        self.detach_asked.emit(self.current())

    def open_group(self, group: str) -> None:
        """Open the panel of a group that was last in front, else its first."""
        free = [key for key, own in self._groups.items() if own == group and key not in self._elsewhere]
        last = self._last.get(group, "")
        self.chosen.emit(last if last in free else free[0])

    def _show_group(self) -> None:
        """Show the tabs of the group in front and hide the others."""
        group = self._groups[self.current()]
        self._last[group] = self.current()
        self.buttons.mark(group)
        self._name_front()
        for k in range(self.count()):
            key = self._key(k)
            self.setTabVisible(k, self._groups[key] == group and key not in self._elsewhere)

    def _all_panels(self, entries: tuple[PanelEntry, ...]) -> QMenu:
        menu = QMenu(self)
        for group in GROUPS:
            menu.addSection(tr(group))
            for entry in (entry for entry in entries if entry.group == group):
                menu.addAction(tr(entry.title), partial(self.chosen.emit, entry.key))
        return menu


class MenuButton(QToolButton):
    """A small button that opens a menu, with a chevron."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("menu")

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the button, then the chevron."""
        super().paintEvent(event)
        paint_chevron(self)


class GroupButtons(QWidget):
    """One button for each group, one of them checked, or one for ``all``, which names the group in front."""

    chosen = Signal(str)

    def __init__(self, groups: tuple[str, ...], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._group = QButtonGroup(self)
        self.named: dict[str, QPushButton] = {}
        self._panel = ""
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(0, 1, SPACE, 3)
        self._row.setSpacing(2)
        for number, group in enumerate(groups, 1):
            button = QPushButton(tr(group), self)
            button.setObjectName("group")
            button.setCheckable(True)
            button.setToolTip(tr("Panels of the group {group} (Alt+{number})", group=tr(group), number=number))
            button.clicked.connect(lambda _, group=group: self.chosen.emit(group))
            self._group.addButton(button)
            self.named[group] = button
            self._row.addWidget(button)
        self.all = MenuButton(self)
        self.all.setToolTip(tr(ALL))
        self.all.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.all.setShortcut("Alt+0")
        self._row.addWidget(self.all)
        self.show_all(True)

    def wide(self) -> int:
        """Return the width that a button for each group takes."""
        parts = [*self.named.values(), self.all]
        return sum(part.sizeHint().width() + self._row.spacing() for part in parts) + SPACE

    def least(self) -> int:
        """Return the width that the button for all groups takes with the longest name of one."""
        words = max(self.fontMetrics().horizontalAdvance(button.text()) for button in self.named.values())
        own = self.fontMetrics().horizontalAdvance(self.all.text())
        return self.all.sizeHint().width() - own + words + SPACE

    def name_panel(self, title: str) -> None:
        """Name the button for all after the panel in front, translated already; "" for the group in front."""
        self._panel = title
        self._name_all()

    def show_all(self, shown: bool) -> None:
        """Show a button for each group, or only the one for all."""
        for button in self.named.values():
            button.setVisible(shown)
        self._all_only = not shown
        self._name_all()

    def mark(self, group: str) -> None:
        """Show which group is in front."""
        self.named[group].setChecked(True)
        self._name_all()

    def _name_all(self) -> None:
        """Name the button for all panels after the group in front where it stands alone."""
        group = next((name for name, button in self.named.items() if button.isChecked()), "")
        words = self._panel or tr(group if self._all_only and group else "All")
        if self.all.text() != words:
            self.all.setText(words)
            self.all.setAccessibleName(tr(ALL))
            self.adjustSize()


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
