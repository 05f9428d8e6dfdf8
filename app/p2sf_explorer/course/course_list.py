"""The list of lectures with how far one is in each, and what to do with results."""

from collections.abc import Callable

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QPushButton, QWidget

from p2sf_explorer.course.lectures import tasks_of
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.lessons.lesson import Lesson
from p2sf_explorer.lessons.lesson_list import LessonList, lecture_heading
from p2sf_explorer.lessons.task_record import CourseResult

INTRO = "Work through the lectures alone, or give them with F5. Answers are kept on this computer, and sent nowhere."


class CourseList(LessonList):
    """Lectures by title and sentence. What its buttons ask for: ``save_asked``, ``results_asked``, ``make_asked``."""

    save_asked = Signal()
    results_asked = Signal()
    make_asked = Signal()
    title = "Course"

    def __init__(
        self, lectures: Callable[[], dict[str, Lesson]], result: Callable[[], CourseResult], parent: QWidget
    ) -> None:
        self._result = result
        super().__init__(lectures, parent)
        intro = QLabel(tr(INTRO), self)
        intro.setObjectName("muted")
        intro.setWordWrap(True)
        self.column.insertWidget(0, intro)
        self.buttons = {
            "save": self._button("Save my results…", "Write what you answered to a file for your lecturer"),
            "results": self._button("Results of a class…", "Open a folder of such files as a table"),
            "make": self._button("Make your own…", "Make a lesson with questions of what is on screen"),
        }
        asked = self.save_asked, self.results_asked, self.make_asked
        foot = QGridLayout()
        for place, (button, signal) in enumerate(zip(self.buttons.values(), asked, strict=True)):
            button.clicked.connect(self.hide)
            button.clicked.connect(signal)
            foot.addWidget(button, 0, place)
        self.column.addLayout(foot)

    def _button(self, words: str, tip: str) -> QPushButton:
        button = QPushButton(tr(words), self)
        button.setToolTip(tr(tip))
        button.setAutoDefault(False)
        return button

    def line(self, number: int, lesson: Lesson) -> str:
        """Return the lines of a lecture: title, sentence, tasks done."""
        result, tasks = self._result(), tasks_of(lesson)
        records = [result.record(lesson.name, task.name) for task in tasks]
        head = lecture_heading(lesson)
        if not tasks:
            return f"{head}\n{lesson.about}"
        answered, right = sum(bool(record.answers) for record in records), sum(record.right for record in records)
        if lesson.silent:
            done = tr("{count} of {all} questions answered", count=answered, all=len(tasks))
        else:
            done = tr("{count} of {all} tasks right", count=right, all=len(tasks))
        return f"{head}\n{lesson.about}\n{done}"
