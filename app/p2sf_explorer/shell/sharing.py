"""The window as a line of text: copied, pasted, dropped."""

from PySide6.QtCore import QObject
from PySide6.QtGui import QGuiApplication

from p2sf.errors import P2SFError
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.link import is_link, link, state_of_link
from p2sf_explorer.widgets.command import Command


class Sharing(QObject):
    """Copies a link to what is on screen, and opens one."""

    def __init__(self, window):
        super().__init__(window)
        self._window, self._store = window, window.store
        copy = Command("Copy a link to what is on screen", self.copy, ("Ctrl+Shift+C",), "Files")
        window.actions.add(copy)
        window.actions.add(Command("Paste a link", self.paste, ("Ctrl+V",), "Files"))
        window.top.snapshot.menu().addAction(tr("Copy link") + "\tCtrl+Shift+C", self.copy)

    def copy(self) -> None:
        """Put a link to the present state on the clipboard."""
        text = link(self._store.state)
        QGuiApplication.clipboard().setText(text)
        said = tr("Copied a link of {count} letters; paste it into a window of the explorer", count=len(text))
        self._store.said.emit(said)

    def paste(self) -> bool:
        """Open the link on the clipboard; return whether it went well."""
        return self.open(QGuiApplication.clipboard().text())

    def open(self, text: str) -> bool:
        """Open a link, or say in the banner why not; return whether it went well."""
        if not is_link(text):
            self._window.refuse(tr("there is no link to paste; copy one that begins with p2sf:"))
            return False
        try:
            self._store.replace(state_of_link(text))
        except P2SFError as error:
            self._window.refuse(str(error))
            return False
        return True
