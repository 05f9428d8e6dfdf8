"""The dialog that exports a set of PSFs: what it holds, its pixels, how far it is, and a button that stops it."""

from dataclasses import asdict
from math import prod
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import (
    QDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.files.asking import ask_path
from p2sf_explorer.files.snapshot import saved
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.state.state import State
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.typed import typed
from p2sf_explorer.widgets.value_edit import ShortField
from p2sf_explorer.window.commands.set_request import (
    SEPARATOR,
    SetRequest,
    SetTexts,
    first_texts,
    holds_state,
    read_request,
    work,
)

FILES = (
    "NumPy (*.npz);;TIFF stack for ImageJ (*.tif);;FITS (*.fits);;MATLAB and Octave (*.mat);;Table of figures (*.csv)"
)
ABOUT = (
    "Each PSF is the light of one point on the pixels of a sensor, with the chief ray on the middle pixel. The file "
    "also has the place of each chief ray on the sensor and the share of light captured. Coefficients altered by "
    "hand are ignored. Put semicolons between the values of a list; first : last : count is a range, evenly spaced, in "
    "1/distance for depths."
)
LABELS = {  # of the fields, in their order, and their tips
    "depths": (
        "Depths",
        "Distances with units, ∞ included: 500 mm; 2 m; ∞. A range, evenly spaced in 1/distance: 1 m:∞:4",
    ),
    "fields": ("Fields", "Field angles along y, in degrees: 0; 7; 14. A range: 0:14:5"),
    "wavelengths": ("Wavelengths", "Wavelengths in nm: 486.1; 587.6; 656.3. A range: 400:700:7"),
    "pixel": ("Pixel pitch", "The distance between pixels, µm"),
    "fill": ("Fill factor", "Share of a pixel's area that is sensitive: a square in its middle"),
    "pixels": ("Pixels a side", "Pixels along each side of every PSF; auto fits the widest one"),
}


class SetDialog(QDialog):
    """Asks what a set of PSFs holds and writes it in the background; ``ended`` tells of every end but a cancelled one.

    The set is of the lens as it is when Export is pressed.
    """

    ended = Signal(object)  # a Message or P2SFError

    def __init__(self, store: Store, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._store = store
        self.setWindowTitle(tr("Export a set of PSFs"))
        self.edits = {key: ShortField(self) for key in LABELS}
        self.count, self.note, self.bar = QLabel(self), QLabel(self), QProgressBar(self)
        self.export, self.stop_button = QPushButton(tr("Export…"), self), QPushButton(tr("Close"), self)
        self.worker = LateAnswers(self)
        self.worker.finished.connect(self._on_finished)
        self.worker.failed.connect(self._on_failed)
        self.worker.progressed.connect(self._on_progress)
        self._running: SetRequest | None = None
        self._offered: dict[str, str] = {}
        self._lay_out()
        store.changed.connect(self._offer)
        self.export.clicked.connect(self._ask_path)
        self.stop_button.clicked.connect(self._stop)

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        for key, (label, tip) in LABELS.items():
            edit = self.edits[key]
            edit.setToolTip(local(tr(tip)))
            edit.setAccessibleName(tr(label))
            edit.textChanged.connect(self._recount)
            edit.editingFinished.connect(self._check)
            form.addRow(tr(label), edit)
        about = QLabel(tr(ABOUT), self)
        for text in (about, self.note, self.count):
            text.setObjectName("muted")
            text.setWordWrap(True)
        self.bar.setVisible(False)
        self.export.setDefault(True)
        foot = QHBoxLayout()
        foot.addWidget(self.count, 1)
        foot.addWidget(self.stop_button)
        foot.addWidget(self.export)
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 14, 16, 14)
        column.setSpacing(12)
        column.addWidget(about)
        column.addLayout(form)
        column.addWidget(self.note)
        column.addWidget(self.bar)
        column.addLayout(foot)

    def open_for(self) -> None:
        """Show the dialog; the fields keep what was typed for the same lens."""
        self.note.clear()
        self.show()
        self._offer(self._store.state)
        self.raise_()
        self.activateWindow()

    def _offer(self, state: State) -> None:
        """Fill the fields with what suits the state: all of them for another lens, else those that nobody typed in."""
        if self._running or not self.isVisible():
            return
        try:
            offered = {key: local(text) for key, text in asdict(first_texts(state)).items()}
        except P2SFError as error:  # a lens file that is gone or broken
            self._say(said(error))
            return
        another = self.property("lens") != state.optics.lens
        self.setProperty("lens", state.optics.lens)
        for key, text in offered.items():
            if another or self.edits[key].text() == self._offered[key]:
                self.edits[key].setText(text)
        self._offered = offered

    def _say(self, text: str) -> None:
        """Show a note, in a dialog as high as all of its words need."""
        self.note.setText(text)
        layout = self.layout()
        if layout is not None:
            self.resize(self.width(), max(self.height(), layout.totalHeightForWidth(self.width())))

    def texts(self) -> SetTexts:
        """Return what stands in the fields."""
        return SetTexts(**{key: edit.text() for key, edit in self.edits.items()})

    def _typed(self) -> SetTexts:
        """Return what stands in the fields; P2SFError where a number has two readings."""
        for edit in self.edits.values():
            for part in edit.text().split(SEPARATOR):
                typed(part)
        return self.texts()

    def _recount(self) -> None:
        """Show how many PSFs the lists ask for; nothing while a field is wrong."""
        self.note.clear()
        try:
            shape = read_request(self._store.state, self._typed(), "set.npz").axes.shape
        except P2SFError:  # said when the field is left, since nobody has typed a whole number at once
            self.count.clear()
            return
        depths, fields, colours = shape
        known = {"depths": depths, "fields": fields, "wavelengths": colours, "count": prod(shape)}
        self.count.setText(tr("PSFs: {count} = depths {depths} × fields {fields} × wavelengths {wavelengths}", **known))

    def _check(self) -> bool:
        """Say what is wrong with a field; return whether nothing is."""
        try:
            read_request(self._store.state, self._typed(), "set.npz")
        except P2SFError as error:
            self._say(said(error))
            return False
        self.note.clear()
        return True

    def _ask_path(self) -> None:
        if not self._check():
            return
        first = f"{Path(self._store.state.optics.lens).stem}_psfs.npz"
        if path := ask_path(self, tr("Export a set of PSFs"), first, tr(FILES)):
            self.write(path)

    def write(self, path: str) -> bool:
        """Make the set and write it; return whether that has begun."""
        try:
            request = read_request(self._store.state, self._typed(), path)
        except P2SFError as error:
            self._say(said(error))
            return False
        self._show_running(request)
        self.note.clear()
        self.worker.submit(request, work(request))
        return True

    def _show_running(self, request: SetRequest | None) -> None:
        self._running, on = request, request is not None
        self.bar.setValue(0)
        self.bar.setVisible(on)
        self.export.setEnabled(not on)
        self.stop_button.setText(tr("Cancel") if on else tr("Close"))
        for edit in self.edits.values():
            edit.setEnabled(not on)

    def _stop(self) -> None:
        if not self._running:
            self.close()
            return
        self.worker.cancel()
        self._show_running(None)
        self._say(tr("Cancelled; nothing was written"))

    def _on_progress(self, request: SetRequest, part: float) -> None:
        if request is self._running:
            self.bar.setValue(round(100 * part))

    def _on_finished(self, request: SetRequest, found: tuple[Path, Message | None]) -> None:
        path, warning = found
        done = saved(path, holds_state(path))
        if request is self._running or self._running is None:  # one that was cancelled too late is written as well
            self._show_running(None)
            self._say("\n".join(said(each) for each in (done, warning) if each))
        self.ended.emit(done)

    def _on_failed(self, request: SetRequest, why: Message) -> None:
        if request is self._running:
            self._show_running(None)
            self._say(said(why))

    def stop(self) -> None:
        """End the worker's thread."""
        self.worker.stop()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Cancel what is running with the dialog."""
        if self._running:
            self._stop()
        super().closeEvent(event)
