"""The course in the window: its list, results to hand in, results of a class."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog, QInputDialog, QWidget

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.lessons.controller import LessonController
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.command import Command

if TYPE_CHECKING:
    from p2sf_explorer.course.course_list import CourseList
    from p2sf_explorer.course.results_window import ResultsWindow

NOTHING = Message("There are no answers yet; work through a lecture first")


class Course(QObject):
    """Opens lectures in the window through ``teaching``, which plays lessons."""

    def __init__(self, store: Store, teaching: LessonController, theme: Callable[[], Tokens], window: QWidget) -> None:
        super().__init__(window)
        self._store, self._teaching, self._theme, self._window = store, teaching, theme, window
        self.list: CourseList | None = None
        self.results: ResultsWindow | None = None

    def commands(self) -> tuple[Command, ...]:
        """Return what can be done with the course."""
        return (
            Command("Course…", self.open_list, ("Ctrl+F3",), "Lessons"),
            Command("Save my results of the course…", self.ask_save, (), "Lessons"),
            Command("Results of a class…", self.ask_folder, (), "Lessons"),
        )

    def open_list(self) -> None:
        """Open the list of lectures."""
        from p2sf_explorer.course.course_list import CourseList

        if self.list is None:
            self.list = CourseList(self._teaching.lectures, self._teaching.desk.result, self._window)
            self.list.chosen.connect(self._teaching.begin)
            self.list.save_asked.connect(self.ask_save)
            self.list.results_asked.connect(self.ask_folder)
            self.list.make_asked.connect(self._teaching.make)
        self.list.open_with(self._theme())

    def stop(self) -> None:
        """End what works for the list."""
        if self.list:
            self.list.stop()

    def ask_save(self) -> None:
        """Ask for name and file, and write the results."""
        from p2sf_explorer.files.asking import ask_path

        result = self._teaching.desk.result()
        if not result.tasks:
            self._store.said.emit(NOTHING)
            return
        words = tr("Your name, as your lecturer knows it")
        name, given = QInputDialog.getText(self._window, tr("Save my results of the course…"), words)
        if not (given and name.strip()):
            return
        first = f"{'_'.join(name.split())}.json"
        if path := ask_path(self._window, tr("Save my results of the course…"), first, "JSON (*.json)"):
            self.save(name, Path(path))

    def save(self, name: str, path: Path) -> None:
        """Write the results under a name."""
        from p2sf_explorer.course.lectures import course_version
        from p2sf_explorer.lessons.task_record import write_result

        result = replace(self._teaching.desk.result(), name=" ".join(name.split()), course=course_version())
        try:
            write_result(path, result)
        except P2SFError as error:
            self._store.refused.emit(error)
            return
        self._store.said.emit(Message("Saved {name}", name=path.name))

    def ask_folder(self) -> None:
        """Ask for a folder of results and open it."""
        folder = QFileDialog.getExistingDirectory(self._window, tr("Folder with the files of results"))
        if folder:
            self.open_folder(Path(folder))

    def open_folder(self, folder: Path) -> None:
        """Open a folder of results as a table."""
        from p2sf_explorer.course.lectures import course_version, task_keys
        from p2sf_explorer.course.results_table import read_folder
        from p2sf_explorer.course.results_window import ResultsWindow

        try:
            table = read_folder(folder, task_keys(self._teaching.lectures().values()))
        except P2SFError as error:
            self._store.refused.emit(error)
            return
        if self.results:
            self.results.deleteLater()
        self.results = ResultsWindow(table, course_version(), self._store.said.emit, self._window)
        self.results.restyle(self._theme())
        self.results.show()
