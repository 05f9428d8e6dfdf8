"""Panels in windows of their own: they follow the state's ``windows``, and closing one takes it out of there."""

from PySide6.QtCore import QByteArray, QObject
from PySide6.QtWidgets import QLabel, QWidget

from app.store import Store
from app.tabs import OwnWindow


class Floating(QObject):
    """Moves panels between their page, at ``homes`` by their key, and a window of their own.

    ``places``: where each own window stood last, as Qt keeps it.
    """

    def __init__(self, window: QWidget, store: Store, homes: dict[str, QWidget], titles: dict[str, str]):
        super().__init__(window)
        self._window, self._store, self._homes, self._titles = window, store, homes, titles
        self.open: dict[str, OwnWindow] = {}
        self.places: dict[str, QByteArray] = {}
        self._closing = False

    def toggle(self, key: str) -> None:
        """Put a panel into a window of its own, or back."""
        now = self._store.state.windows
        self._store.update(windows=tuple(k for k in now if k != key) if key in now else (*now, key))

    def place(self, key: str, widget: QWidget) -> None:
        """Put a panel where it belongs: into its window if it has one, else onto its page."""
        home = self.open.get(key) or self._homes[key]
        home.layout().addWidget(widget)
        widget.show()
        self._homes[key].findChild(QLabel, "muted").setVisible(key in self.open)

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
