"""Panels in windows of their own: they follow the state's ``windows``, and closing one takes it out of there."""

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QLabel, QWidget

from app.store import Store
from app.tabs import OwnWindow, Tabs


class Floating(QObject):
    """Moves panels between their tab's page and a window of their own."""

    def __init__(self, window: QWidget, store: Store, tabs: Tabs, titles: dict[str, str]):
        super().__init__(window)
        self._window, self._store, self._tabs, self._titles = window, store, tabs, titles
        self.open: dict[str, OwnWindow] = {}
        self._closing = False
        tabs.detach_asked.connect(self.toggle)

    def toggle(self, key: str) -> None:
        """Put a panel into a window of its own, or back."""
        now = self._store.state.windows
        self._store.update(windows=tuple(k for k in now if k != key) if key in now else (*now, key))

    def place(self, key: str, widget: QWidget) -> None:
        """Put a panel where it belongs: into its window if it has one, else onto its page."""
        home = self.open.get(key) or self._tabs.pages()[key]
        home.layout().addWidget(widget)
        widget.show()
        self._tabs.pages()[key].findChild(QLabel, "muted").setVisible(key in self.open)

    def follow(self, wanted: tuple[str, ...], panels: dict) -> None:
        """Open and close windows until they are those wanted."""
        for key in [key for key in self.open if key not in wanted]:
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
            made.show()

    def stop(self) -> None:
        """Close every window with the main one; the state keeps them for the next start."""
        self._closing = True
        for own in self.open.values():
            own.close()

    def _on_closed(self, key: str) -> None:
        if not self._closing and key in self._store.state.windows:
            self.toggle(key)
