"""What menus, shortcuts and dropped files do."""

from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QFileDialog, QMenu, QWidget

from p2sf.errors import P2SFError
from p2sf_explorer.compute.autofocus import best_shift_um
from p2sf_explorer.compute.setup import with_lens
from p2sf_explorer.files.file_watcher import Watching
from p2sf_explorer.files.opening import KINDS, REPORT_TAB, Refusal, opened, refusal
from p2sf_explorer.files.recent import recent_files, remember
from p2sf_explorer.files.saving import ask_save_lens
from p2sf_explorer.files.snapshot import DATA_ENDINGS, side_car, write_data, write_picture, write_state
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels import REGISTRY
from p2sf_explorer.shell.choices import everything, fill
from p2sf_explorer.shell.command_palette import Palette
from p2sf_explorer.shell.help import HelpPage, help_text
from p2sf_explorer.widgets.command import Command
from p2sf_explorer.widgets.copying import card_in_hand, copy_data, copy_picture, png_of

STATE_FILES = "Explorer states (*.json)"
SNAPSHOT_FILES = (
    "PSF as NumPy (*.npz);;PSF as TIFF (*.tiff);;PSF as FITS (*.fits);;PSF as CSV (*.csv);;"
    "Picture of the window (*.png)"
)


class Actions(QObject):
    """The window's commands; every refusal is one sentence in the banner."""

    def __init__(self, window):
        super().__init__(window)
        self.window, self.store = window, window.store
        self.commands: list[Command] = []
        self.palette: Palette | None = None
        for command in self._first():
            self.add(command)
        window.top.lens_chosen.connect(self.open_lens)
        window.top.open_file.connect(self.ask_open)
        window.top.recent_chosen.connect(self.open_path)
        self._list_recent()
        self.watching = Watching(window)
        window.top.help_asked.connect(self.help)
        window.controls.autofocus.connect(self.autofocus)
        window.top.set_snapshot_menu(self._menu())
        listed = ("Find a command…", "Report: one page as PDF…", "Shortcuts")
        fill(window.top.more.menu(), window, tuple(c for c in self.commands if c.title in listed))
        self.store.said.connect(window.status.say)
        window.tabs.tabBar().setAccessibleName(tr("Panels"))

    def _first(self) -> tuple[Command, ...]:
        """Return what can be done from the start; other parts of the window `add` theirs."""
        store, top = self.store, self.window.top
        return (
            Command("Undo", store.undo, ("Ctrl+Z",), "Steps"),
            Command("Redo", store.redo, ("Ctrl+Shift+Z", "Ctrl+Y"), "Steps"),
            Command("Open a lens file or a saved state…", self.ask_open, ("Ctrl+O",), "Files"),
            Command("Choose a shipped lens…", top.lens.open_gallery, ("Ctrl+L",), "Files"),
            Command("Save the lens as it is now…", self.ask_save_lens, ("Ctrl+Shift+S",), "Files"),
            Command("Snapshot: PSF data or picture, with the state…", self.ask_snapshot, ("Ctrl+E",), "Files"),
            Command("Autofocus: best RMS wavefront", self.autofocus, ("Ctrl+F",), "Lens"),
            Command("Copy the panel's data as CSV", self.copy_data, ("Ctrl+Shift+D",), "Files"),
            Command("Copy the panel's picture", self.copy_picture, ("Ctrl+Shift+P",), "Files"),
            Command("Report: one page as PDF…", self.ask_report, ("Ctrl+P",), "Files"),
            Command("Pop out", self.window.tabs.detach, ("Ctrl+D",), "Panel"),
            Command("Find a command…", self.find, ("Ctrl+K",)),
            Command("Shortcuts", self.help, ("F1", "?")),
            Command("Close the window", self.window.close, ("Ctrl+Q",)),
        )

    def add(self, command: Command) -> None:
        """Add something to do: its keys work from now on, and help and palette list it."""
        self.commands.append(command)
        for keys in command.keys:
            QShortcut(QKeySequence(keys), self.window).activated.connect(command.run)

    def attempt(self, action, *arguments) -> bool:
        """Run an action; say its refusal in the banner and return whether it went well."""
        try:
            action(*arguments)
        except P2SFError as error:
            self.window.refuse(str(error))
            return False
        return True

    def open_path(self, path: str) -> bool:
        """Open a lens file of any known format or a saved state, told by its content."""
        try:
            self.store.replace(opened(self.store.state, path))
        except P2SFError as error:
            self._explain(refusal(path, error))
            return False
        remember(path)
        self._list_recent()
        return True

    def _explain(self, refused: Refusal) -> None:
        """Show in the report why a file is not opened, and in the banner."""
        self.window.open_panel(REPORT_TAB)
        self.window.panels[REPORT_TAB].show_refusal(refused)
        self.window.refuse(refused.message)

    def _list_recent(self) -> None:
        self.window.top.show_recent(recent_files())

    def open_lens(self, name: str) -> bool:
        """Move to another lens, shipped or a file."""
        return self.attempt(lambda: self.store.replace(with_lens(self.store.state, name)))

    def autofocus(self) -> bool:
        """Move the sensor to the smallest RMS wavefront."""
        return self.attempt(lambda: self.store.update(sensor_shift_um=best_shift_um(self.store.state)))

    def save(self, path: str, picture_of: QWidget | None = None) -> bool:
        """Write a snapshot by the ending of its name, its state beside it."""
        ending = Path(path).suffix.lower()
        if ending in DATA_ENDINGS:
            went = self.attempt(write_data, self.window.live, path, self.store.state)
        elif ending == ".json":
            went = self.attempt(write_state, self.store.state, path)
        else:
            went = self.attempt(write_picture, self.store.state, png_of(picture_of or self.window), path)
        if went:
            text = "Saved {name}" if ending == ".json" else "Saved {name}, and its state as {beside}"
            self.window.status.say(tr(text, name=Path(path).name, beside=side_car(path).name))
        return went

    def ask_open(self) -> None:
        """Ask for a file and open it."""
        path, _ = QFileDialog.getOpenFileName(self.window, tr("Open a lens or a state"), "", tr(KINDS))
        if path:
            self.open_path(path)

    def ask_save_lens(self) -> None:
        """Ask for a name and save the lens as it is now."""
        ask_save_lens(self.window, self.store)

    def ask_snapshot(self, kinds: str = SNAPSHOT_FILES, picture_of: QWidget | None = None) -> None:
        """Ask for a name and save the snapshot."""
        ending = kinds.split("*")[1].split(")")[0]
        first = f"{Path(self.store.state.lens).stem}{ending}"
        path, chosen = QFileDialog.getSaveFileName(self.window, tr("Save a snapshot"), first, tr(kinds))
        if path:
            named = path if Path(path).suffix else path + chosen.split("*")[1].split(")")[0]
            self.save(named, picture_of)

    def help(self) -> None:
        """Show shortcuts and what they do."""
        page = self.window.findChild(HelpPage) or HelpPage(help_text(tuple(self.commands)), self.window)
        page.show()
        page.raise_()

    def find(self) -> None:
        """Open the command palette."""
        self.palette = self.palette or Palette(self.window)
        self.palette.open_with(everything(self.window))

    def copy_picture(self) -> None:
        """Put the picture of the panel in hand on the clipboard."""
        copy_picture(card_in_hand(self.window))
        self.store.said.emit(tr("The panel's picture is on the clipboard"))

    def copy_data(self) -> None:
        """Put the data of the panel in hand on the clipboard."""
        copied = copy_data(card_in_hand(self.window))
        self.store.said.emit(tr("The panel's data are on the clipboard" if copied else "This panel has no numbers"))

    def ask_report(self) -> None:
        """Ask for a name and write the report."""
        first = f"{Path(self.store.state.lens).stem}.pdf"
        path, _ = QFileDialog.getSaveFileName(self.window, tr("Save the report"), first, tr("Report (*.pdf)"))
        if path:
            self.write_report(path if Path(path).suffix else f"{path}.pdf")

    def write_report(self, path: str) -> bool:
        """Write one page about the lens at this source as PDF."""
        from p2sf_explorer.shell.report import write_report

        went = self.attempt(write_report, self.store.state, path)
        if went:
            self.store.said.emit(tr("Saved {name}", name=Path(path).name))
        return went

    def _menu(self) -> QMenu:
        menu = QMenu(self.window)
        menu.addAction(tr("PSF data or window…") + "\tCtrl+E", self.ask_snapshot)
        pictures = menu.addMenu(tr("Picture of one panel"))
        for entry in REGISTRY:
            pictures.addAction(tr(entry.title), lambda key=entry.key: self._ask_panel(key))
        menu.addAction(tr("Lens…") + "\tCtrl+Shift+S", self.ask_save_lens)
        menu.addAction(tr("State only…"), lambda: self.ask_snapshot(STATE_FILES))
        return menu

    def _ask_panel(self, key: str) -> None:
        self.window.open_panel(key)
        self.ask_snapshot("Picture (*.png)", self.window.panels[key].widget)
