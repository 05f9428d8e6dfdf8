"""Workspaces in the top bar: arrangements of the window by name, five that come with it and a person's own."""

from functools import partial
from typing import Protocol

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QButtonGroup, QHBoxLayout, QInputDialog, QMenu, QPushButton, QToolButton, QWidget

from p2sf.messages import Message
from p2sf_explorer.files.workspaces import LONGEST, MOST, keep_workspaces, kept_workspaces
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.state import State
from p2sf_explorer.state.workspaces import TEACH, WORKSPACES, Workspace, arrangement, with_workspace
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.command import Command
from p2sf_explorer.window.tabs import MenuButton

TITLES = {"explore": "Explore", "inspect": "Inspect", "lens": "Lens", "image": "Image", TEACH: "Teach"}
TIPS = {
    "explore": "The PSF on the stage; layout, coefficients and profiles beside it",
    "inspect": "PSFs over the field on the stage",
    "lens": "The layout on the stage; lens table and PSF below",
    "image": "A photograph through the lens on the stage",
    TEACH: "A lesson, with its subject on the stage (F3)",
}
TOO_MANY = Message("there are {count} workspaces already; delete one that is no longer needed", count=MOST)


class Teaching(Protocol):
    """What a workspace asks of the lessons."""

    def toggle(self) -> None:
        """Begin the first lesson, or leave the one under way."""

    def workspace(self) -> Workspace | None:
        """Return how the present step arranges the window, None without a lesson."""


class Workspaces(QObject):
    """Changes between workspaces; each is found again as it was left, and chosen once more as it comes with the window.

    ``changed`` tells that there are others than before.
    """

    changed = Signal()

    def __init__(self, store: Store, teaching: Teaching, window: QWidget) -> None:
        super().__init__(window)
        self._store, self._teaching, self._window = store, teaching, window
        self._left = kept_workspaces()
        store.changed.connect(self._on_state)
        self._on_state(store.state)

    def own(self) -> tuple[str, ...]:
        """Return the names of the person's own workspaces."""
        return tuple(name for name in self._left if name not in WORKSPACES)

    def choose(self, name: str) -> None:
        """Arrange the window as a workspace was left; the present one goes back to how it first was."""
        state = self._store.state
        again = name == state.display.workspace
        if not again:
            self._remember(state.display.workspace, arrangement(state.display))
        if name == TEACH:
            lesson = self._teaching.workspace()
            if lesson is None:
                self._teaching.toggle()
                return
            wanted = lesson
        else:
            wanted = WORKSPACES[name] if again and name in WORKSPACES else self._left.get(name) or WORKSPACES[name]
        self._store.replace(with_workspace(state, name, wanted))

    def _remember(self, name: str, workspace: Workspace) -> None:
        if name and name != TEACH and self._left.get(name) != workspace:
            new = name not in self._left
            self._left[name] = workspace
            keep_workspaces(self._left)
            if new:
                self.changed.emit()

    def ask_save(self) -> None:
        """Ask for a name and save the present arrangement under it."""
        name, went = QInputDialog.getText(self._window, tr("Save the workspace"), tr("Name of the workspace:"))
        if went:
            self.save(name)

    def save(self, name: str) -> None:
        """Save the present arrangement under a name; an empty one, or that of a shipped workspace, does nothing."""
        name = " ".join(name.split())[:LONGEST]
        if not name or name in WORKSPACES:
            return
        if name not in self._left and len(self.own()) >= MOST - len(WORKSPACES):
            self._store.refused.emit(TOO_MANY)
            return
        self._remember(name, arrangement(self._store.state.display))
        self._store.update(workspace=name)

    def delete(self) -> None:
        """Delete the person's own workspace that is on; the window stays as it is, as a changed first one."""
        name = self._store.state.display.workspace
        if name in self.own():
            del self._left[name]
            keep_workspaces(self._left)
            self._store.update(workspace="explore")
            self.changed.emit()

    def _on_state(self, state: State) -> None:
        """Take over the workspace of a link or a file that is not known here."""
        name = state.display.workspace
        if name not in WORKSPACES and name not in self._left and len(self.own()) < MOST:
            self._remember(name, arrangement(state.display))

    def commands(self) -> tuple[Command, ...]:
        """Return the commands of workspaces."""
        shipped = (
            Command(title, partial(self.choose, name), (f"Ctrl+{number}",), "Workspace")
            for number, (name, title) in enumerate(TITLES.items(), 1)
        )
        return (
            *shipped,
            Command("Save as…", self.ask_save, (), "Workspace"),
            Command("Delete this one", self.delete, (), "Workspace"),
        )


class WorkspaceBar(QWidget):
    """A row of buttons, one for each workspace, or where there is little room one button with a menu."""

    def __init__(self, workspaces: Workspaces, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAccessibleName(tr("Workspace"))
        self._workspaces, self._on, self._narrow = workspaces, "", False
        self._group = QButtonGroup(self)
        self.buttons: dict[str, QPushButton] = {}
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.setSpacing(2)
        self.menu = MenuButton(self)
        self.menu.setMenu(QMenu(self))
        self.menu.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.menu.setToolTip(tr("Workspaces: save this one, delete it, or choose another"))
        self._row.addWidget(self.menu)
        workspaces.changed.connect(self._fill)
        self._fill()

    def _fill(self) -> None:
        """Make a button and an entry of the menu for each workspace."""
        for button in self.buttons.values():
            self._group.removeButton(button)
            self._row.removeWidget(button)
            button.deleteLater()
        self.buttons = {}
        menu = self.menu.menu()
        menu.clear()
        for number, name in enumerate((*TITLES, *self._workspaces.own())):
            choose = partial(self._workspaces.choose, name)
            self.buttons[name] = button = self._button(name)
            button.clicked.connect(choose)
            self._row.insertWidget(number, button)
            menu.addAction(words(name), choose)
        menu.addSeparator()
        menu.addAction(tr("Save as…"), self._workspaces.ask_save)
        menu.addAction(tr("Delete this one"), self._workspaces.delete)
        self.make_narrow(self._narrow)
        self.mark(self._on)

    def _button(self, name: str) -> QPushButton:
        button = QPushButton(words(name), self)
        button.setObjectName("segment")
        button.setCheckable(True)
        button.setToolTip(tr(TIPS.get(name, "A workspace of your own; it stays as you leave it")))
        self._group.addButton(button)
        return button

    def make_narrow(self, narrow: bool) -> None:
        """Show only the button with the menu, which then names the workspace, or all."""
        self._narrow = narrow
        for button in self.buttons.values():
            button.setVisible(not narrow)
        self._name_menu()
        self.updateGeometry()  # at once: the bar around it may go to and fro

    def mark(self, name: str) -> None:
        """Show which workspace is on."""
        self._on = name
        if name in self.buttons:
            self.buttons[name].setChecked(True)
        self._name_menu()

    def _name_menu(self) -> None:
        """Name the button of the menu after the workspace where it stands alone."""
        text = words(self._on) if self._narrow else ""
        if self.menu.text() != text or self.menu.property("bare") is None:
            self.menu.setText(text)
            self.menu.setProperty("bare", not text)
            self.menu.style().unpolish(self.menu)
            self.menu.style().polish(self.menu)
        self.menu.setAccessibleName(tr("Workspaces: save this one, delete it, or choose another"))


def words(name: str) -> str:
    """Return how a workspace is called: its title, or the person's own words."""
    return tr(TITLES[name]) if name in TITLES else name
