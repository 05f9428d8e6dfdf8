"""The report on the lens as it is set, computed and written in the background with progress and a way to stop it."""

from collections.abc import Callable
from pathlib import Path
from threading import Event

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QProgressDialog, QWidget

from p2sf.messages import Message
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.report.contents import report_of
from p2sf_explorer.report.writing import write_report
from p2sf_explorer.state.state import State
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store

PATIENCE_MS = 400  # before the progress is shown
COMPUTED = 0.4  # of the time is over when all is computed and pages are to be drawn


class ReportWriter(QObject):
    """Writes reports, one at a time; what became of each is said through the store."""

    def __init__(self, store: Store, window: QWidget):
        super().__init__(window)
        self._store, self._window = store, window
        self.worker = LateAnswers(self)
        self.worker.finished.connect(self._on_finished)
        self.worker.failed.connect(self._on_failed)
        self.worker.progressed.connect(self._on_progress)
        self.progress: QProgressDialog | None = None

    def write(self, state: State, path: str) -> None:
        """Begin the report on a state, as a file by the ending of its name."""
        self.progress = shown = QProgressDialog(tr("Writing the report"), tr("Cancel"), 0, 100, self._window)
        shown.setWindowModality(Qt.WindowModality.NonModal)
        shown.setMinimumDuration(PATIENCE_MS)
        shown.canceled.connect(self.worker.cancel)
        shown.setValue(0)

        def work(cancelled: Event, progress: Callable[[float], None]) -> object:
            report = report_of(state, lambda share: progress(COMPUTED * share), cancelled.is_set)
            write_report(report, path, WINDOW)
            return path

        self.worker.submit(path, work)

    def stop(self) -> None:
        """End the worker's thread."""
        self.worker.stop()

    def _close(self) -> None:
        if self.progress:
            self.progress.canceled.disconnect()
            self.progress.close()
            self.progress.deleteLater()
            self.progress = None

    def _on_progress(self, path: object, share: float) -> None:
        if self.progress:
            self.progress.setValue(min(99, int(100 * share)))

    def _on_finished(self, path: object, _: object) -> None:
        self._close()
        self._store.said.emit(Message("Saved {name}", name=Path(str(path)).name))

    def _on_failed(self, path: object, why: Message) -> None:
        self._close()
        self._store.refused.emit(why)
