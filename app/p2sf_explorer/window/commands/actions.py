"""The commands of menus, shortcuts and dropped files."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QApplication, QFileDialog, QMenu, QWidget

from p2sf.errors import P2SFError
from p2sf.lens.lens import with_absorption
from p2sf.messages import Message
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.editing import edited_state
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.setup import prescription, with_lens
from p2sf_explorer.files.recent import recent_files, remember
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.limits import CLEAR_PUPIL, MASK
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.state import change
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.command import Command
from p2sf_explorer.window.bars import TopBar
from p2sf_explorer.window.commands.choices import choices, fill

if TYPE_CHECKING:
    from p2sf_explorer.files.opening import Refusal
    from p2sf_explorer.handbook.viewer import Handbook
    from p2sf_explorer.window.commands.command_palette import Palette
    from p2sf_explorer.window.commands.report import ReportWriter
    from p2sf_explorer.window.commands.set_dialog import SetDialog

COPIED, NO_DATA = Message("The panel's data are on the clipboard"), Message("This panel has no numbers")
HANDBOOK = "Handbook: the page of what has the focus"
BEGIN = "First picture, and where to begin"
COURSE, LESSONS, MAKE_LESSON = "Course…", "List of lessons…", "Make a lesson of this…"
FILM, PRESENT = "Film of the sweep…", "Present: the stage on the full screen, or back (Esc)"
REPORT = "Report as PDF, HTML or JSON…"
IN_MENU = "Find a command…", REPORT, COURSE, LESSONS, MAKE_LESSON, PRESENT, FILM, HANDBOOK, "Shortcuts", BEGIN
NO_MASK = "Clear pupil: no obscuration, blades, vanes, apodisation or cubic phase"
REPORT_FILES = "Report as PDF (*.pdf);;Report as HTML (*.html);;Report as JSON (*.json)"
STATE_FILES = "Explorer states (*.json)"
DATA_FILES = "PSF as NumPy (*.npz);;PSF as TIFF (*.tiff);;PSF as FITS (*.fits);;PSF as CSV (*.csv)"
PICTURE_FILES = "Picture of the window (*.png)"


# The sections of the handbook's page on the window that tell of its parts, by the names of their classes.
PARTS = {
    "TopBar": "Top bar",
    "PupilShape": "Pupil shape",
    "Controls": "Controls",
    "CompareBar": "A beside B",
    "PlayBar": "Play and film",
    "LessonPanel": "Lessons",
}


@dataclass(frozen=True)
class PanelAccess:
    """How the actions reach the panels and the answer on screen.

    ``open`` brings a panel on show, ``stage`` puts it on the stage, ``card`` returns its card, ``in_front`` that of the
    stage; ``explain`` says why a file was refused; ``detach`` gives the panel in hand a window of its own, or takes it
    back.
    """

    live: Callable[[], Live | None]
    theme: Callable[[], Tokens]
    open: Callable[[str], None]
    stage: Callable[[str], None]
    card: Callable[[str], Card]
    in_front: Callable[[], Card]
    explain: "Callable[[Refusal], None]"
    detach: Callable[[], None]


def handbook_place(widget: QWidget | None) -> tuple[str, str]:
    """Return page and heading of the handbook that tell of a widget: those of the nearest part around it."""
    from p2sf_explorer.handbook.pages import PAGES

    titles = {entry.key: entry.title for entry in REGISTRY}
    while widget is not None:
        if isinstance(widget, Card) and widget.key in titles:
            return "panels", titles[widget.key]
        if heading := PARTS.get(type(widget).__name__):
            return "window", heading
        widget = widget.parentWidget()
    return next(iter(PAGES)), ""


class Actions(QObject):
    """The commands of the window; what cannot be done is said in the banner, through the store."""

    def __init__(self, window: QWidget, store: Store, top: TopBar, panels: PanelAccess) -> None:
        super().__init__(window)
        self._window, self._store, self._top, self._panels = window, store, top, panels
        self.commands: list[Command] = []
        self.sources: list[Callable[[], tuple[Command, ...]]] = []  # of what the palette lists beside them
        self.palette: Palette | None = None
        self.handbook: Handbook | None = None
        self.set_dialog: SetDialog | None = None
        self.report_writer: ReportWriter | None = None
        for command in self._first():
            self.add(command)
        top.lens_chosen.connect(self.open_lens)
        top.open_file.connect(self.ask_open)
        top.recent_chosen.connect(self.open_path)
        top.help_asked.connect(self.help)
        top.set_snapshot_menu(self._menu())
        self._list_recent()

    def _first(self) -> tuple[Command, ...]:
        """Return the commands there are from the start; other parts of the window `add` theirs."""
        store = self._store
        return (
            Command("Undo", store.undo, ("Ctrl+Z",), "Steps"),
            Command("Redo", store.redo, ("Ctrl+Shift+Z", "Ctrl+Y"), "Steps"),
            Command("Open a lens file or a saved state…", self.ask_open, ("Ctrl+O",), "Files"),
            Command("Choose a shipped lens…", self._top.lens.open_gallery, ("Ctrl+L",), "Files"),
            Command("Save the lens as it is now…", self.ask_save_lens, ("Ctrl+Shift+S",), "Files"),
            Command("Snapshot: a picture with its state in it…", self.ask_snapshot, ("Ctrl+E",), "Files"),
            Command("Snapshot: PSF as data, with the state…", lambda: self.ask_snapshot(DATA_FILES), (), "Files"),
            Command("Export a set of PSFs…", self.ask_set, ("Ctrl+Alt+E",), "Files"),
            Command("Autofocus: best RMS wavefront", self.autofocus, ("Ctrl+F",), "Lens"),
            Command(NO_MASK, lambda: store.update(**CLEAR_PUPIL), (), "Lens"),
            Command("Absorption of the glasses: on or off", self.absorb, (), "Lens"),
            Command("Pupil as the lens file has it", lambda: store.update(**dict.fromkeys(MASK)), (), "Lens"),
            Command("Copy the panel's data as CSV", self.copy_data, ("Ctrl+Shift+D",), "Files"),
            Command("Copy the panel's picture", self.copy_picture, ("Ctrl+Shift+P",), "Files"),
            Command(REPORT, self.ask_report, ("Ctrl+P",), "Files"),
            Command("Pop out", self._panels.detach, ("Ctrl+D",), "Panel"),
            Command("Find a command…", self.find, ("Ctrl+K",)),
            Command(HANDBOOK, self.open_handbook, ("F1",)),
            Command("Theory: conventions, formulas, sources", self.theory),
            Command("Shortcuts", self.help, ("Shift+F1", "?")),
            Command("Close the window", self._window.close, ("Ctrl+Q",)),
        )

    def add(self, command: Command) -> None:
        """Add a command: its keys work from now on, and help and palette list it."""
        self.commands.append(command)
        for keys in command.keys:
            shortcut = QShortcut(QKeySequence(keys), self._window)
            shortcut.activated.connect(command.run)
            if keys == "F1":  # also in the windows of panels
                shortcut.setContext(Qt.ShortcutContext.ApplicationShortcut)

    def fill_menu(self) -> None:
        """Put what a person may look for into the menu of the bar, once all commands are there."""
        named = {command.title: command for command in self.commands}
        fill(self._top.more.menu(), self._store, tuple(named[title] for title in IN_MENU))

    def attempt(self, action: Callable[[], object]) -> bool:
        """Run an action, or say why it cannot be done; return whether it was."""
        try:
            action()
        except P2SFError as error:
            self._store.refused.emit(error)
            return False
        return True

    def open_path(self, path: str) -> bool:
        """Open a lens file of any known format or a saved state; its content decides."""
        from p2sf_explorer.files.opening import open_file, refusal

        try:
            self._store.replace(open_file(self._store.state, path))
        except P2SFError as error:
            self._panels.explain(refusal(path, error))
            return False
        remember(path)
        self._list_recent()
        return True

    def _list_recent(self) -> None:
        self._top.show_recent(recent_files())

    def open_lens(self, name: str) -> bool:
        """Move to another lens, shipped or a file."""
        return self.attempt(lambda: self._store.replace(change(with_lens(self._store.state, name), held_scales=())))

    def autofocus(self) -> bool:
        """Move the sensor to the smallest RMS wavefront."""
        from p2sf_explorer.compute.autofocus import best_shift_um

        return self.attempt(lambda: self._store.update(sensor_shift_um=best_shift_um(self._store.state)))

    def absorb(self) -> bool:
        """Take from the rays what glasses absorb, or leave it to them, as an edit of the lens."""
        state = self._store.state
        lens = prescription(state)
        other = with_absorption(lens, not lens.absorption)
        return self.attempt(lambda: self._store.replace(edited_state(state, other)))

    def save(self, path: str, picture_of: QWidget | None = None) -> bool:
        """Write a snapshot by the ending of its name, with its state in it."""
        from p2sf_explorer.files.snapshot import DATA_ENDINGS, saved, write_data, write_picture, write_state
        from p2sf_explorer.widgets.copying import png_of

        ending, state, done = Path(path).suffix.lower(), self._store.state, saved(path)
        if ending in DATA_ENDINGS:
            went = self.attempt(lambda: write_data(self._panels.live(), path, state))
        elif ending == ".json":
            went, done = self.attempt(lambda: write_state(state, path)), Message("Saved {name}", name=Path(path).name)
        else:
            went = self.attempt(lambda: write_picture(state, png_of(picture_of or self._window), path))
        if went:
            self._store.said.emit(done)
        return went

    def ask_open(self) -> None:
        """Ask for a file and open it."""
        from p2sf_explorer.files.opening import KINDS

        path, _ = QFileDialog.getOpenFileName(self._window, tr("Open a lens or a state"), "", tr(KINDS))
        if path:
            self.open_path(path)

    def ask_save_lens(self) -> None:
        """Ask for a name and save the lens as it is now."""
        from p2sf_explorer.files.saving import ask_save_lens

        ask_save_lens(self._window, self._store)

    def ask_snapshot(self, kinds: str = PICTURE_FILES, picture_of: QWidget | None = None) -> None:
        """Ask for a name and save the snapshot."""
        from p2sf_explorer.files.asking import ask_path

        ending = kinds.split("*")[1].split(")")[0]
        first = f"{Path(self._store.state.optics.lens).stem}{ending}"
        if path := ask_path(self._window, tr("Save a snapshot"), first, tr(kinds)):
            self.save(path, picture_of)

    def ask_set(self) -> None:
        """Ask what a set of PSFs is to hold."""
        if self.set_dialog is None:
            from p2sf_explorer.window.commands.set_dialog import SetDialog

            self.set_dialog = SetDialog(self._store, self._window)
            self.set_dialog.ended.connect(self._store.said)
        self.attempt(self.set_dialog.open_for)

    def stop(self) -> None:
        """End background work with the window."""
        for working in (self.set_dialog, self.report_writer):
            if working:
                working.stop()

    def help(self) -> None:
        """Show shortcuts and what they do."""
        from p2sf_explorer.window.commands.help import HelpPage, help_text

        page = self._window.findChild(HelpPage) or HelpPage(help_text(tuple(self.commands)), self._window)
        page.show()
        page.raise_()

    def theory(self, panel: str = "") -> None:
        """Open the theory, at the section of a panel where one is named."""
        section = next((entry.handbook for entry in REGISTRY if entry.key == panel), "")
        self._book().show_section("theory", section)

    def open_handbook(self) -> None:
        """Open the handbook at what has the focus: a panel, or another part of the window; else at its first page."""
        self._book().show_heading(*handbook_place(QApplication.focusWidget()))

    def _book(self) -> "Handbook":
        """Return the handbook in the window's colours."""
        from p2sf_explorer.handbook.viewer import Handbook

        theme = self._panels.theme()
        self.handbook = self.handbook or Handbook(theme, self._window)
        self.handbook.restyle(theme)
        return self.handbook

    def find(self) -> None:
        """Open the command palette."""
        from p2sf_explorer.window.commands.command_palette import Palette

        self.palette = self.palette or Palette(self._window)
        self.palette.open_with(self.everything())

    def everything(self) -> tuple[Command, ...]:
        """Return all commands of the palette."""
        chosen = choices(self._store, self._panels.open, self._panels.stage, self.open_lens)
        return (*self.commands, *chosen, *(command for listed in self.sources for command in listed()))

    def copy_picture(self) -> None:
        """Put the picture of the panel in hand on the clipboard."""
        from p2sf_explorer.widgets.copying import card_in_hand, copy_picture

        copy_picture(card_in_hand(self._window, self._panels.in_front()))
        self._store.said.emit(Message("The panel's picture is on the clipboard"))

    def copy_data(self) -> None:
        """Put the data of the panel in hand on the clipboard."""
        from p2sf_explorer.widgets.copying import card_in_hand, copy_data

        copied = copy_data(card_in_hand(self._window, self._panels.in_front()))
        self._store.said.emit(COPIED if copied else NO_DATA)

    def ask_report(self) -> None:
        """Ask for a name and write the report."""
        from p2sf_explorer.files.asking import ask_path

        first = f"{Path(self._store.state.optics.lens).stem}.pdf"
        if path := ask_path(self._window, tr("Save the report"), first, tr(REPORT_FILES)):
            self.write_report(path)

    def write_report(self, path: str) -> None:
        """Write the report on the lens as it is set in the background, by the ending of the name."""
        from p2sf_explorer.window.commands.report import ReportWriter

        self.report_writer = self.report_writer or ReportWriter(self._store, self._window)
        self.report_writer.write(self._store.state, path)

    def _menu(self) -> QMenu:
        menu = QMenu(self._window)
        menu.addAction(tr("Picture of the window…") + "\tCtrl+E", self.ask_snapshot)
        menu.addAction(tr("PSF as data…"), lambda: self.ask_snapshot(DATA_FILES))
        menu.addAction(tr("Set of PSFs…") + "\tCtrl+Alt+E", self.ask_set)
        pictures = menu.addMenu(tr("Picture of one panel"))
        for entry in REGISTRY:
            pictures.addAction(tr(entry.title), partial(self._ask_panel, entry.key))
        menu.addAction(tr("Lens…") + "\tCtrl+Shift+S", self.ask_save_lens)
        menu.addAction(tr("State only…"), lambda: self.ask_snapshot(STATE_FILES))
        return menu

    def _ask_panel(self, key: str) -> None:
        self._panels.open(key)
        self.ask_snapshot("Picture (*.png)", self._panels.card(key))
