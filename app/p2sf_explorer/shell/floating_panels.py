"""Panels in windows of their own: they follow the state's ``windows``, and closing one takes it out of there."""

from collections.abc import Callable, Mapping

from PySide6.QtCore import QByteArray, QObject, Qt
from PySide6.QtWidgets import QLabel, QWidget

from p2sf_explorer.panels import Panel, PanelEntry
from p2sf_explorer.shell.tabs import OwnWindow
from p2sf_explorer.store.store import Store


class FloatingPanels(QObject):
    """Moves panels between their page, in ``homes`` by their keys, and a window of their own.

    ``places`` keeps the geometry that each own window had last. A panel whose tab is not in front is taken out of the
    window: a new style sheet is computed for every widget inside, shown or not, and most are not shown.
    """

    def __init__(
        self, window: QWidget, store: Store, homes: dict[str, QWidget], entries: tuple[PanelEntry, ...]
    ) -> None:
        super().__init__(window)
        self._window, self._store, self._homes = window, store, homes
        self._titles = {entry.key: entry.title for entry in entries}
        self._tabbed = {entry.key for entry in entries if entry.place != "main"}
        self.open: dict[str, OwnWindow] = {}
        self.places: dict[str, QByteArray] = {}
        self._closing = False
        self._front = ""
        self._out_of_sight = QWidget()
        self.destroyed.connect(self._out_of_sight.deleteLater)  # it is no child of the window, and would outlive it

    def toggle(self, key: str) -> None:
        """Put a panel into a window of its own, or back."""
        now = self._store.state.display.windows
        self._store.update(windows=tuple(k for k in now if k != key) if key in now else (*now, key))

    def place(self, key: str, widget: QWidget) -> None:
        """Put a panel into its own window if it has one, else onto its page if that is in front, else out of sight."""
        if self._is_behind(key):
            widget.setParent(self._out_of_sight)
        else:
            layout = (self.open.get(key) or self._homes[key]).layout()
            if layout is not None:
                layout.addWidget(widget)
            widget.show()
        for note in self._homes[key].findChildren(QLabel, "muted", Qt.FindChildOption.FindDirectChildrenOnly):
            note.setVisible(key in self.open)

    def _is_behind(self, key: str) -> bool:
        return key in self._tabbed and key != self._front and key not in self.open

    def bring_up(self, key: str, panels: Mapping[str, Panel], turn: Callable[[str], None]) -> None:
        """Put the panel of a tab onto its page, ``turn`` to that page, and put the panel before it out of sight.

        In this order, since Qt hands the focus to a widget on the page it turns to, else to the next one anywhere.
        """
        before, self._front = self._front, key
        if before != key:
            self.place(key, panels[key].widget)
        turn(key)
        if before != key and before in panels:
            self.place(before, panels[before].widget)

    def follow(self, wanted: tuple[str, ...], panels: Mapping[str, Panel]) -> None:
        """Open and close windows until the open ones are those wanted."""
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
