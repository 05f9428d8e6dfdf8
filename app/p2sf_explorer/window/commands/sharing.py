"""The window as a line of text: copied, pasted, dropped."""

from PySide6.QtCore import QObject
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QMenu

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.link import is_link, link, state_of_link
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.command import Command

NO_LINK = Message("there is no link to paste; copy one that begins with p2sf:")


class Sharing(QObject):
    """Copies a link to what is on screen, and opens one."""

    def __init__(self, store: Store, parent: QObject) -> None:
        super().__init__(parent)
        self._store = store

    def commands(self) -> tuple[Command, ...]:
        """Return the commands for links."""
        return (
            Command("Copy a link to what is on screen", self.copy, ("Ctrl+Shift+C",), "Files"),
            Command("Paste a link", self.paste, ("Ctrl+V",), "Files"),
        )

    def fill(self, menu: QMenu) -> None:
        """Add copying to a menu."""
        menu.addAction(tr("Copy link") + "\tCtrl+Shift+C", self.copy)

    def copy(self) -> None:
        """Put a link to the present state on the clipboard."""
        text = link(self._store.state)
        QGuiApplication.clipboard().setText(text)
        done = "Copied a link of {count} characters; paste it into a window of the explorer"
        self._store.said.emit(Message(done, count=len(text)))

    def paste(self) -> bool:
        """Open the link on the clipboard; return whether that was possible."""
        return self.open(QGuiApplication.clipboard().text())

    def open(self, text: str) -> bool:
        """Open a link, or say why not; return whether that was possible."""
        if not is_link(text):
            self._store.refused.emit(NO_LINK)
            return False
        try:
            self._store.replace(state_of_link(text))
        except P2SFError as error:
            self._store.refused.emit(error)
            return False
        return True
