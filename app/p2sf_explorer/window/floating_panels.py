"""Where each panel stands. Panels in windows of their own follow the state's ``windows``; closing one takes it out."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from PySide6.QtCore import QByteArray, QObject
from PySide6.QtWidgets import QApplication, QWidget

from p2sf_explorer.panels import Panel
from p2sf_explorer.store.store import Store
from p2sf_explorer.window.stage import PanelPlace
from p2sf_explorer.window.tabs import OwnWindow


@dataclass(frozen=True)
class Home:
    """Where a panel stands inside the window: its widget, and what that is, "stage", "rail" or "tabs"."""

    widget: PanelPlace
    place: str


class FloatingPanels(QObject):
    """Moves panels to the place where the state has them: on the stage, in the rail, under a tab, in an own window.

    ``places`` keeps the geometry that each own window had last. A panel that is not on show is taken out of the
    window: a new style sheet is computed for every widget inside, shown or not, and most are not shown.
    """

    def __init__(self, window: QWidget, store: Store, titles: Mapping[str, str]) -> None:
        super().__init__(window)
        self._window, self._store, self._titles = window, store, titles
        self.open: dict[str, OwnWindow] = {}
        self.places: dict[str, QByteArray] = {}
        self._closing = False
        self._at: dict[str, QWidget] = {}
        self._out_of_sight = QWidget()
        self.destroyed.connect(self._out_of_sight.deleteLater)  # it is no child of the window, and would outlive it

    def toggle(self, key: str) -> None:
        """Put a panel into a window of its own, or back."""
        now = self._store.state.display.windows
        self._store.update(windows=tuple(k for k in now if k != key) if key in now else (*now, key))

    def follow(
        self, homes: Mapping[str, Home], wanted: tuple[str, ...], panels: Mapping[str, Panel], turn: Callable[[], None]
    ) -> None:
        """Put each panel into its window, if it is one of those ``wanted``, else to its home, else out of sight.

        ``turn`` brings the tab of the state to the front. What comes on show is placed before, and what goes out of
        sight after it, since Qt hands the focus to a widget on the page it turns to, else to the next one anywhere.
        """
        focused = QApplication.focusWidget()
        closed = [self._take_window(key) for key in [key for key in self.open if key not in wanted]]
        opened = [self._new_window(key) for key in wanted if key not in self.open]
        behind = [key for key in panels if key not in homes and key not in wanted]
        for key in (key for key in panels if key not in behind):
            self._put(key, panels[key].widget, self.open.get(key) or homes[key].widget)
            panels[key].widget.stand("window" if key in wanted else homes[key].place)
        for own in opened:
            own.show()
        turn()
        for key in behind:
            self._put(key, panels[key].widget, self._out_of_sight)
            panels[key].widget.stand("tabs")
        for key, home in homes.items():
            home.widget.show_note(key in self.open)
        for own in closed:
            own.close()
            own.deleteLater()
        if focused and focused.isVisible() and not focused.hasFocus():
            focused.setFocus()  # a widget that is moved to another parent loses it

    def _put(self, key: str, card: QWidget, place: QWidget) -> None:
        if self._at.get(key) is place:
            return
        self._at[key] = place
        layout = place.layout()
        if isinstance(place, PanelPlace):
            place.put(card)
        elif layout is None:
            card.setParent(place)
        else:
            layout.addWidget(card)
            card.show()

    def _new_window(self, key: str) -> OwnWindow:
        """Return a new window for a panel, not yet on show."""
        self.open[key] = made = OwnWindow(key, self._titles[key], self._window)
        made.closed.connect(self._on_closed)
        made.restoreGeometry(self.places.get(key, QByteArray()))
        return made

    def _take_window(self, key: str) -> OwnWindow:
        """Return the window of a panel, which is to be closed without asking for the panel to be put back."""
        self.places |= self.present_places()
        closed = self.open.pop(key)
        closed.blockSignals(True)
        return closed

    def present_places(self) -> dict[str, QByteArray]:
        """Return the geometry of the open windows."""
        return {key: own.saveGeometry() for key, own in self.open.items()}

    def stop(self) -> None:
        """Close every window with the main one; the state keeps them open for the next start."""
        self._closing = True
        for own in self.open.values():
            own.close()

    def _on_closed(self, key: str) -> None:
        if not self._closing and key in self._store.state.display.windows:
            self.toggle(key)
