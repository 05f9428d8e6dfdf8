"""Panels in windows of their own: they follow the state's ``windows``, and closing one takes it out of there."""

from collections.abc import Callable

from PySide6.QtCore import QByteArray, QObject
from PySide6.QtWidgets import QLabel, QWidget

from p2sf_explorer.panels import PanelEntry
from p2sf_explorer.shell.tabs import OwnWindow
from p2sf_explorer.store.store import Store


class Floating(QObject):
    """Moves panels between their page, at ``homes`` by their key, and a window of their own.

    ``places``: where each own window stood last, as Qt keeps it. A panel whose tab is not in front waits outside the
    window: a new style is worked out for every widget within, on show or not, and most are not.
    """

    def __init__(self, window: QWidget, store: Store, homes: dict[str, QWidget], entries: tuple[PanelEntry, ...]):
        super().__init__(window)
        self._window, self._store, self._homes = window, store, homes
        self._titles = {entry.key: entry.title for entry in entries}
        self._tabbed = {entry.key for entry in entries if entry.place != "main"}
        self.open: dict[str, OwnWindow] = {}
        self.places: dict[str, QByteArray] = {}
        self._closing = False
        self._front = ""
        self._attic = QWidget()
        self.destroyed.connect(self._attic.deleteLater)  # no child of the window, it would outlive it with its panels

    def toggle(self, key: str) -> None:
        """Put a panel into a window of its own, or back."""
        now = self._store.state.windows
        self._store.update(windows=tuple(k for k in now if k != key) if key in now else (*now, key))

    def place(self, key: str, widget: QWidget) -> None:
        """Put a panel where it belongs: into its window if it has one, else onto its page, or away behind its tab."""
        if self._is_behind(key):
            widget.setParent(self._attic)
        else:
            home = self.open.get(key) or self._homes[key]
            home.layout().addWidget(widget)
            widget.show()
        self._homes[key].findChild(QLabel, "muted").setVisible(key in self.open)

    def _is_behind(self, key: str) -> bool:
        return key in self._tabbed and key != self._front and key not in self.open

    def bring_up(self, key: str, panels: dict, turn: Callable[[str], None]) -> None:
        """Put the panel of a tab onto its page, ``turn`` to that, and put the one that was in front away.

        In this order: Qt hands the keys on to what stands on the page it turns to, else to whatever comes next.
        """
        before, self._front = self._front, key
        if before != key:
            self.place(key, panels[key].widget)
        turn(key)
        if before != key and before in panels:
            self.place(before, panels[before].widget)

    def follow(self, wanted: tuple[str, ...], panels: dict) -> None:
        """Open and close windows until they are those wanted."""
        for key in [key for key in self.open if key not in wanted]:
            self.places |= self.present_places()
            closed = self.open.pop(key)
            self.place(key, panels[key].widget)
            closed.blockSignals(True)
            closed.close()
            closed.deleteLater()
        for key in (key for key in wanted if key not in self.open):
            made = OwnWindow(key, self._titles[key], self._window)
            made.closed.connect(self._on_closed)
            self.open[key] = made
            self.place(key, panels[key].widget)
            made.restoreGeometry(self.places.get(key, QByteArray()))
            made.show()

    def present_places(self) -> dict[str, QByteArray]:
        """Return where the open windows stand."""
        return {key: own.saveGeometry() for key, own in self.open.items()}

    def stop(self) -> None:
        """Close every window with the main one; the state keeps them for the next start."""
        self._closing = True
        for own in self.open.values():
            own.close()

    def _on_closed(self, key: str) -> None:
        if not self._closing and key in self._store.state.windows:
            self.toggle(key)
