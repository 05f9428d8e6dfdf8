"""*Test my lesson*: every claim measured, every control named as on screen, every task solved, one check at a time."""

from collections.abc import Iterator

from PySide6.QtCore import QTimer
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import QDialog, QLabel, QListWidget, QProgressBar, QVBoxLayout, QWidget

from p2sf_explorer.i18n.language import current_language, languages, texts
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.lessons.lesson import Lesson
from p2sf_explorer.lessons.making.lesson_checks import Check, checks, faults_of

SIZE = 560, 380


class LessonTestWindow(QDialog):
    """Lists what is wrong; closing it ends the test. ``found`` has the sentences."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Test my lesson"))
        self.verdict, self.list, self.progress = QLabel(self), QListWidget(self), QProgressBar(self)
        self.verdict.setWordWrap(True)
        self.list.setWordWrap(True)
        self.list.setAccessibleName(tr("What is wrong with the lesson"))
        column = QVBoxLayout(self)
        for part in (self.verdict, self.list, self.progress):
            column.addWidget(part)
        self._timer = QTimer(self, interval=0)
        self._timer.timeout.connect(self._check_next)
        self._left: Iterator[tuple[int, Check]] = iter(())
        self.found: list[str] = []
        self.resize(*SIZE)

    def begin(self, lesson: Lesson) -> None:
        """Test a lesson."""
        self._all = list(checks(lesson, names_on_screen()))
        self._left, self.found = iter(self._all), []
        self.list.clear()
        self.verdict.setText(lesson.title)
        self.progress.setRange(0, len(self._all))
        self.progress.setValue(0)
        self.progress.show()
        self.show()
        self.raise_()
        self._timer.start()

    @property
    def busy(self) -> bool:
        """Return whether checks are left."""
        return self._timer.isActive()

    def _check_next(self) -> None:
        """Do one check, so that the window answers between them."""
        following = next(self._left, None)
        if following is None:
            self._end()
            return
        number, check = following
        for message in faults_of(check):
            self.found.append(tr("Step {number}: {words}", number=number + 1, words=said(message)))
            self.list.addItem(self.found[-1])
        self.progress.setValue(self.progress.value() + 1)

    def _end(self) -> None:
        self._timer.stop()
        self.progress.hide()
        count = len(self._all)
        if self.found:
            self.verdict.setText(tr("{count} checks were made; this is wrong:", count=count))
        else:
            self.verdict.setText(tr("{count} checks were made, and nothing is wrong.", count=count))

    def show_failure(self, words: str) -> None:
        """Say why there is no lesson to test."""
        self.list.clear()
        self.found = [words]
        self.verdict.setText(words)
        self.progress.hide()
        self.show()

    def closeEvent(self, event: QCloseEvent) -> None:
        """End the test."""
        self._timer.stop()
        super().closeEvent(event)


def names_on_screen() -> frozenset[str]:
    """Return all texts of the window, in English and in its present language."""
    found: set[str] = set()
    for code in languages():
        translated = texts(code)
        found |= set(translated)
        if code == current_language():
            found |= set(translated.values())
    return frozenset(found)
