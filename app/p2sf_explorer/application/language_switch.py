"""Opens the window, and opens another one when its language changes, since widgets take their texts when built."""

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer

from p2sf_explorer.i18n.language import current_language, language_of, set_language
from p2sf_explorer.state.state import State
from p2sf_explorer.window.window import MainWindow


class LanguageSwitch(QObject):
    """Holds the one window; ``make`` builds a window for a state, shown or not."""

    def __init__(self, state: State, make: Callable[[State], MainWindow], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._make = make
        set_language(state.display.language)
        self.window = self._new_window(state)

    def _new_window(self, state: State) -> MainWindow:
        window = self._make(state)
        window.store.changed.connect(self._listen)
        return window

    def _listen(self, state: State) -> None:
        if language_of(state.display.language) != current_language():
            QTimer.singleShot(0, self.reopen)

    def reopen(self) -> None:
        """Replace the window by one in the state's language, with all steps of undo."""
        old = self.window
        if language_of(old.store.state.display.language) == current_language():
            return
        set_language(old.store.state.display.language)
        self.window = self._new_window(old.store.state)
        self.window.store.take_over(old.store)
        self.window.restoreGeometry(old.saveGeometry())
        self.window.setVisible(old.isVisible())
        self.window.refresh(self.window.store.state)
        old.close()
        old.deleteLater()
