"""What menus, shortcuts and dropped files do."""

from pathlib import Path

from PySide6.QtCore import QBuffer, QIODevice, QObject
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QFileDialog, QMenu, QMessageBox, QWidget

from app.focus import best_shift_um
from app.opening import KINDS, REPORT_TAB, Refusal, opened, refusal
from app.panels import REGISTRY
from app.recent import recent_files, remember
from app.saving import ask_save_lens
from app.setting import with_lens
from app.snapshot import DATA_ENDINGS, side_car, write_data, write_picture, write_state
from app.watching import Watching
from p2sf.errors import P2SFError

STATE_FILES = "Explorer states (*.json)"
SNAPSHOT_FILES = "PSF as NumPy (*.npz);;PSF as TIFF (*.tiff);;PSF as CSV (*.csv);;Picture of the window (*.png)"
HELP = """<h3>P2SF Explorer</h3>
<p>Drag a slider: lens, pupil and PSF follow. Hover over a name for its definition.</p>
<table cellpadding="3">
<tr><td><b>← → ↑ ↓</b>, <b>Page Up/Down</b></td><td>move the slider that has the focus</td></tr>
<tr><td><b>double-click</b></td><td>back to the lens's own value</td></tr>
<tr><td><b>Ctrl+Z</b>, <b>Ctrl+Shift+Z</b></td><td>undo, redo</td></tr>
<tr><td><b>Ctrl+L</b></td><td>the gallery of shipped lenses</td></tr>
<tr><td><b>Ctrl+O</b></td><td>open a lens file or a saved state; dropping it on the window does the same: Zemax
.zmx (also zipped), CODE V .seq, ISET .json and .dat, Optical Bench .txt, .csv with named columns, .toml</td></tr>
<tr><td><b>Ctrl+F</b></td><td>autofocus</td></tr>
<tr><td><b>Ctrl+Shift+S</b></td><td>save the lens as it is now: .toml, .zmx or ISET .json</td></tr>
<tr><td><b>Ctrl+E</b></td><td>snapshot: PSF data or picture, with the state beside it</td></tr>
<tr><td><b>F1</b></td><td>this page</td></tr>
</table>"""


class Actions(QObject):
    """The window's commands; every refusal is one sentence in the banner."""

    def __init__(self, window):
        super().__init__(window)
        self.window, self.store = window, window.store
        for keys, action in (
            ("Ctrl+Z", self.store.undo),
            ("Ctrl+Shift+Z", self.store.redo),
            ("Ctrl+Y", self.store.redo),
            ("Ctrl+O", self.ask_open),
            ("Ctrl+L", window.top.lens.open_gallery),
            ("Ctrl+Shift+S", self.ask_save_lens),
            ("Ctrl+F", self.autofocus),
            ("Ctrl+E", self.ask_snapshot),
            ("F1", self.help),
            ("Ctrl+Q", window.close),
        ):
            QShortcut(QKeySequence(keys), window).activated.connect(action)
        window.top.lens_chosen.connect(self.open_lens)
        window.top.open_file.connect(self.ask_open)
        window.top.recent_chosen.connect(self.open_path)
        self._list_recent()
        self.watching = Watching(window)
        window.top.help_asked.connect(self.help)
        window.controls.autofocus.connect(self.autofocus)
        window.top.set_snapshot_menu(self._menu())
        self.store.said.connect(window.status.say)

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
            self._explain(refusal(path, str(error)))
            return False
        remember(path)
        self._list_recent()
        return True

    def _explain(self, refused: Refusal) -> None:
        """Show in the report why a file is not opened, and in the banner."""
        self.window.open_panel(REPORT_TAB)
        self.window.panels[REPORT_TAB].show_refusal(refused)
        self.window.refuse(refused.sentence)

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
            went = self.attempt(write_data, self.window.live, path)
        elif ending == ".json":
            went = self.attempt(write_state, self.store.state, path)
        else:
            went = self.attempt(write_picture, self.store.state, png_of(picture_of or self.window), path)
        if went:
            beside = "" if ending == ".json" else f", and its state as {side_car(path).name}"
            self.window.status.say(f"Saved {Path(path).name}{beside}")
        return went

    def ask_open(self) -> None:
        """Ask for a file and open it."""
        path, _ = QFileDialog.getOpenFileName(self.window, "Open a lens or a state", "", KINDS)
        if path:
            self.open_path(path)

    def ask_save_lens(self) -> None:
        """Ask for a name and save the lens as it is now."""
        ask_save_lens(self.window, self.store)

    def ask_snapshot(self, kinds: str = SNAPSHOT_FILES, picture_of: QWidget | None = None) -> None:
        """Ask for a name and save the snapshot."""
        ending = kinds.split("*")[1].split(")")[0]
        first = f"{Path(self.store.state.lens).stem}{ending}"
        path, chosen = QFileDialog.getSaveFileName(self.window, "Save a snapshot", first, kinds)
        if path:
            named = path if Path(path).suffix else path + chosen.split("*")[1].split(")")[0]
            self.save(named, picture_of)

    def help(self) -> None:
        """Show shortcuts and what they do."""
        box = QMessageBox(self.window)
        box.setWindowTitle("Help")
        box.setText(HELP)
        box.open()

    def _menu(self) -> QMenu:
        menu = QMenu(self.window)
        menu.addAction("PSF data or window…\tCtrl+E", self.ask_snapshot)
        pictures = menu.addMenu("Picture of one panel")
        for entry in REGISTRY:
            pictures.addAction(entry.title, lambda key=entry.key: self._ask_panel(key))
        menu.addAction("Lens…\tCtrl+Shift+S", self.ask_save_lens)
        menu.addAction("State only…", lambda: self.ask_snapshot(STATE_FILES))
        return menu

    def _ask_panel(self, key: str) -> None:
        self.window.open_panel(key)
        self.ask_snapshot("Picture (*.png)", self.window.panels[key].widget)


def png_of(widget: QWidget) -> bytes:
    """Return a widget's picture as PNG."""
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    widget.grab().save(buffer, "PNG")
    return bytes(buffer.data())
