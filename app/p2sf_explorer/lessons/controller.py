"""Lessons in the window: begin, go on, reveal, leave, make, list."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtWidgets import QLabel, QSplitter, QWidget

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.theme import SPACE, Tokens
from p2sf_explorer.files import recent
from p2sf_explorer.i18n.language import current_language
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.lessons.task_desk import TaskDesk
from p2sf_explorer.state.state import State, change, entry
from p2sf_explorer.state.workspaces import Workspace, arrangement
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.command import Command

if TYPE_CHECKING:
    from p2sf_explorer.lessons.lesson import Lesson
    from p2sf_explorer.lessons.lesson_list import LessonList
    from p2sf_explorer.lessons.lesson_panel import LessonPanel
    from p2sf_explorer.lessons.making.lesson_maker import LessonMaker
    from p2sf_explorer.lessons.making.lesson_test_window import LessonTestWindow

SLIDER_SHARE = 0.38  # of the column's height for the sliders below the page of a lesson, at least
PAGE_LINES = 29  # of text: a page that is higher leaves the sliders more, up to all that they need


Finder = Callable[[str], "tuple[dict[str, Lesson], tuple[P2SFError, ...]]"]
"""What finds lessons in a language: by name, and the errors of files that are none."""
OPEN = "First answer the question of this page."  # in place of what blurs most, which may be the answer
TO_VOTE = "Page Down: vote"  # while presenting
NO_LESSON = Message("There is no lesson under way; begin one, or press Test my lesson where you make one")
NOTHING_BEFORE = Message("The window began with this lesson, so there is nothing to restore; its lens stays")
UNTRANSLATED = Message("This lesson has not been translated; here is the original")


def no_lectures(language: str) -> "tuple[dict[str, Lesson], tuple[P2SFError, ...]]":
    """Return no lectures."""
    return {}, ()


def progress_path() -> Path:
    """Return where a person's answers are kept."""
    return recent.recent_path().with_name("course.json")


class SliderColumn(Protocol):
    """The column of sliders, of which a step may mark one."""

    @property
    def rows(self) -> Mapping[str, QWidget]:
        """The rows by the keys of their quantities."""

    def reveal(self, key: str) -> None:
        """Scroll to a row."""


@dataclass(frozen=True)
class LessonRoom:
    """The parts of the window that a lesson uses.

    The page of the lesson stands in the ``column`` above the ``sliders``; what is expected is marked on the ``stage``.
    ``tell`` says something under the stage in place of what blurs most, and RMS, Strehl ratio and
    what is altered stay untold until "" ends it.
    """

    column: QSplitter
    sliders: SliderColumn
    stage: QWidget
    tell: Callable[[str], None]


class LessonController(QObject):
    """Owns the page of the lesson, made when the first one begins; the state says which lesson and step are on."""

    def __init__(
        self,
        store: Store,
        window: QWidget,
        room: LessonRoom,
        theme: Callable[[], Tokens],
        find_lectures: Finder = no_lectures,
    ) -> None:
        super().__init__(window)
        self._find_lectures = find_lectures
        self._lectures: dict[str, Lesson] | None = None
        self._expected_for, self._told = ("", 0), ""
        self.desk = TaskDesk(store, progress_path, self._marked, self)
        self.store, self._window, self._room, self._theme = store, window, room, theme
        self.list: LessonList | None = None
        self.maker: LessonMaker | None = None
        self.tester: LessonTestWindow | None = None
        self.panel: LessonPanel | None = None
        self._lessons: dict[str, Lesson] = {}
        self._told_untranslated = False
        self._on_offer: tuple[Lesson, ...] = ()
        self.desk.answered.connect(lambda: self.follow(self.store.state))
        room.column.installEventFilter(self)
        room.column.splitterMoved.connect(self._keep_shares)
        self._pointed_at: tuple[str, int, str] = "", 0, ""
        self.presenting, self._shared_for = False, ("", 0)
        self.told_in_hall = "", 0  # the step whose question a hall has seen answered
        self.turn: Callable[[int], None] = self.move  # what *Back* and *Next* of the page do
        self._by_hand = False  # the shares of page and sliders are a person's
        self.store.changed.connect(self.follow)
        self.follow(self.store.state)

    def commands(self) -> tuple[Command, ...]:
        """Return what can be done with lessons."""
        return (
            Command("List of lessons…", self.open_list, ("Shift+F3",), "Lessons"),
            Command("Make a lesson of this…", self.make, (), "Lessons"),
            Command("Test my lesson", self.test, (), "Lessons"),
            Command("Begin or leave a lesson", self.toggle, ("F3",), "Lessons"),
            Command("Next step of the lesson", lambda: self.move(1), ("Alt+Right",), "Lessons"),
            Command("Previous step of the lesson", lambda: self.move(-1), ("Alt+Left",), "Lessons"),
            Command("Show the answer", self.reveal, ("Alt+Down",), "Lessons"),
        )

    def listed(self) -> tuple[Command, ...]:
        """Return a command for each lesson, found by all its words."""
        from p2sf_explorer.lessons.lesson_list import content

        return tuple(
            Command(lesson.title, partial(self.begin, name), (), "Lesson", content(lesson), worded=True)
            for name, lesson in (self.lessons() | self.lectures()).items()
        )

    def open_list(self) -> None:
        """Open the list of lessons with their pictures."""
        from p2sf_explorer.lessons.lesson_list import LessonList

        if self.list is None:
            self.list = LessonList(self.lessons, self._window)
            self.list.chosen.connect(self.begin)
        self.list.open_with(self._theme())

    def make(self) -> None:
        """Open the dialog that makes a lesson of what is on screen."""
        from p2sf_explorer.lessons.lesson import own_folder
        from p2sf_explorer.lessons.making.lesson_maker import LessonMaker

        if self.maker is None:
            self.maker = LessonMaker(self.store, own_folder, self._window)
            self.maker.made.connect(self.open_made)
        self.maker.begin()

    def test(self) -> None:
        """Test the lesson under way: its claims, the names of its controls, its tasks."""
        from p2sf_explorer.lessons.making.lesson_test_window import LessonTestWindow

        place = self.store.state.lesson
        if lesson := self.shelf(place.name).get(place.name):
            self.tester = self.tester or LessonTestWindow(self._window)
            self.tester.begin(lesson)
        else:
            self.store.said.emit(NO_LESSON)

    def open_made(self, path: str) -> None:
        """Begin a lesson that has just been written."""
        self._lessons = {}
        self.begin(Path(path).stem)
        self.store.said.emit(Message("Saved {name}", name=Path(path).name))

    def stop(self) -> None:
        """End what works for the lists."""
        if self.list:
            self.list.stop()
        if self.tester:
            self.tester.close()

    def lessons(self) -> "dict[str, Lesson]":
        """Return the lessons by name; the banner tells of a bad file, and the others open."""
        from p2sf_explorer.lessons.lesson import FOLDER, found_lessons, own_folder

        if not self._lessons:
            self._lessons = self._told_of(found_lessons((FOLDER, own_folder()), current_language()))
        return self._lessons

    def lectures(self) -> "dict[str, Lesson]":
        """Return the lectures and concept checks by name."""
        if self._lectures is None:
            self._lectures = self._told_of(self._find_lectures(current_language()))
        return self._lectures

    def _told_of(self, found: "tuple[dict[str, Lesson], tuple[P2SFError, ...]]") -> "dict[str, Lesson]":
        lessons, faults = found
        if faults:  # after the picture of the step, which takes the banner away
            QTimer.singleShot(0, lambda: self.store.refused.emit(faults[0]))
        return lessons

    def shelf(self, name: str) -> "dict[str, Lesson]":
        """Return the lessons or lectures among which one of this name stands, none where there is none."""
        if name in self.lessons():
            return self.lessons()
        return self.lectures() if name in self.lectures() else {}

    def workspace(self) -> Workspace | None:
        """Return how the step under way arranges the window, None without one."""
        place = self.store.state.lesson
        lesson = self.shelf(place.name).get(place.name)
        return arrangement(lesson.state(min(place.step, len(lesson.steps) - 1)).display) if lesson else None

    def toggle(self) -> None:
        """Begin the first lesson, or leave the one under way."""
        if self.store.state.lesson.name:
            self.leave()
        elif self.lessons():
            self.begin(next(iter(self.lessons())))

    def begin(self, name: str) -> None:
        """Begin a lesson; what was on screen before the first one comes back at the end."""
        self._go(name, 0)

    def move(self, step: int) -> None:
        """Go a step on or back; from the last one back to the lecture, on to the next lesson, or out after the last."""
        state, shelf = self.store.state, self.shelf(self.store.state.lesson.name)
        if not shelf:
            return
        number = state.lesson.step + step
        if 0 <= number < len(shelf[state.lesson.name].steps):
            self._go(state.lesson.name, number)
        elif number > 0 and (lecture := self._lecture_before()):
            self._go(lecture.lesson.name, lecture.lesson.step)
        elif number > 0:
            following = self._following(state.lesson.name)
            self._go(following, 0) if following else self.leave()

    def _following(self, name: str) -> str:
        """Return the name of the lesson after this one, "" after the last."""
        names = list(self.shelf(name))
        return next(iter(names[names.index(name) + 1 :]), "")

    def _lecture_before(self) -> State | None:
        """Return the state of the lecture that plays the present lesson, None where it was begun by itself."""
        name = self.store.state.lesson.name
        before = self.store.latest(lambda state: state.lesson.name != name)
        lecture = self.lectures().get(before.lesson.name) if before else None
        return before if lecture and name in lecture.lessons else None

    def _end(self, name: str) -> str:
        """Return where *Next* leads from the last step."""
        if self._lecture_before():
            return tr("Back to the lecture")
        if not self._following(name):
            return tr("End")
        return tr("Next lecture") if name in self.lectures() else tr("Next lesson")

    def reveal(self) -> None:
        """Show the answer of the present step."""
        if self.store.state.lesson.name:
            self.store.update(lesson_told=True)

    def leave(self) -> None:
        """End the lesson and go back to the state before it, which is among the steps of undo."""
        from p2sf_explorer.lessons.lesson import PERSONAL

        here = change(self.store.state, lesson_name="", lesson_step=0, lesson_told=False, held_scales=())
        kept = {name: entry(here, name) for name in PERSONAL}
        before = self.store.latest(lambda state: not state.lesson.name)
        self.store.replace(change(before, **kept) if before else here)
        if not before:
            self.store.said.emit(NOTHING_BEFORE)

    def _go(self, name: str, number: int) -> None:
        shelf = self.shelf(name)
        if name not in shelf:
            return  # a link of a text that leads elsewhere
        try:
            self.store.replace(shelf[name].state(number, self.store.state))
        except P2SFError as error:
            self.store.refused.emit(error)

    def follow(self, state: State) -> None:
        """Show the page of the state's lesson and point to the slider it is about; hide it where there is none."""
        shelf = self.shelf(state.lesson.name) if state.lesson.name else {}
        lesson = shelf.get(state.lesson.name)
        slider = form = ""
        if lesson:
            number = min(int(state.lesson.step), len(lesson.steps) - 1)
            step = lesson.steps[number]
            slider, form = step.move, step.task.mark.form if step.task and step.task.mark else ""
            self.panel = self.panel or self._new_panel()
            self._list(shelf)
            self._show_step(lesson, number, state.lesson.told)
            self._tell_untranslated(lesson)
        else:
            self._tell("")
        if self.panel:
            self.panel.setVisible(lesson is not None)
        self._point(slider)
        self._expect((state.lesson.name, state.lesson.step), form)
        if self.presenting and (state.lesson.name, state.lesson.step) != self._shared_for:
            self._shared_for = state.lesson.name, state.lesson.step
            QTimer.singleShot(0, self._share)

    def _show_step(self, lesson: "Lesson", number: int, told: bool) -> None:
        from p2sf_explorer.lessons.lesson_panel import StepFrame
        from p2sf_explorer.lessons.task import ChoiceAnswer, GoalAnswer

        if self.panel is None:
            return
        task = lesson.steps[number].task
        if told:
            self.desk.note_told(lesson, number)
        view = self.desk.view(lesson, task) if task else None
        by_hand = task is not None and isinstance(task.answer, GoalAnswer)
        to_vote = self.presenting and task is not None and isinstance(task.answer, ChoiceAnswer)
        told_in_hall = (lesson.name, number) == self.told_in_hall
        self._tell(tr(OPEN) if view and not (view.closed or by_hand or told_in_hall) else "")
        may_ask = view is None or (not view.silent and (view.remaining is None or view.closed))
        lessons = self.lessons()
        blocks = ((name, lessons[name].title) for name in lesson.lessons if name in lessons) if number == 0 else ()
        frame = StepFrame(
            told and may_ask, may_ask, self._end(lesson.name), tuple(blocks), tr(TO_VOTE) if to_vote else ""
        )
        self.panel.show_step(lesson, number, frame)
        self.desk.show(lesson, number)

    def _expect(self, place: tuple[str, int], form: str) -> None:
        """Let a click on the stage mark what the task of a step wants to be predicted, once the step is on show."""
        if place != self._expected_for:
            self._expected_for = place
            QTimer.singleShot(0, lambda: self._expect_on_stage(form))

    def _expect_on_stage(self, form: str) -> None:
        for chart in self._room.stage.findChildren(Chart):
            if form or chart.expects:
                chart.expect(form)

    def _marked(self) -> float | None:
        """Return what was marked on the stage."""
        return next(
            (found for chart in self._room.stage.findChildren(Chart) if (found := chart.expected) is not None), None
        )

    def _tell(self, words: str) -> None:
        """Say something under the stage, where that is news."""
        if words != self._told:
            self._told = words
            self._room.tell(words)

    def _list(self, shelf: "dict[str, Lesson]") -> None:
        """Offer the lessons of a shelf in the page's list."""
        if self.panel and self._on_offer != tuple(shelf.values()):
            self._on_offer = tuple(shelf.values())
            self.panel.list_lessons(self._on_offer, numbered=shelf is not self.lectures())

    @property
    def active(self) -> bool:
        """Return whether the page of a lesson is on show."""
        return self.panel is not None and not self.panel.isHidden()

    def _tell_untranslated(self, lesson: "Lesson") -> None:
        """Say once that a lesson is in another language than the window, after the picture of its step is there."""
        if not self._told_untranslated and lesson.language != current_language():
            self._told_untranslated = True
            QTimer.singleShot(0, lambda: self.store.said.emit(UNTRANSLATED))

    def _new_panel(self) -> "LessonPanel":
        from p2sf_explorer.lessons.lesson_panel import LessonPanel

        made = LessonPanel((), self._window)
        made.presenting = self.presenting
        self.desk.serve(made.task)
        made.chosen.connect(self.begin)
        made.moved.connect(lambda by: self.turn(by))
        made.asked.connect(self.reveal)
        made.left.connect(self.leave)
        self._room.column.insertWidget(0, made)
        QTimer.singleShot(0, self._share)  # when the page has its type
        return made

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Share the height of the column again when it changes."""
        if event.type() in (QEvent.Type.Resize, QEvent.Type.StyleChange):
            QTimer.singleShot(0, self._share)
        return False

    def _keep_shares(self) -> None:
        self._by_hand = True

    def present(self, on: bool) -> None:
        """Keep the question and one slider in view while presenting, or share the column as before."""
        self.presenting, self.told_in_hall = on, ("", 0)
        if self.panel:
            self.panel.presenting = on
            self.follow(self.store.state)
        QTimer.singleShot(0, self._share)

    def _share(self) -> None:
        """Give the page the height of a page of text, the sliders what is left, up to all that they need.

        While presenting the page takes what it needs, and leaves the sliders the height of one at least.
        """
        if self.panel is None or self._by_hand:
            return
        whole, page = self._room.column.height(), PAGE_LINES * self.panel.fontMetrics().lineSpacing()
        shown = [row for row in self._room.sliders.rows.values() if not row.isHidden()]
        if self.presenting:
            sliders = max(whole - self.panel.whole_height, max(row.height() for row in shown) + 2 * SPACE)
        else:
            wanted = max(row.geometry().bottom() for row in shown) + SPACE
            sliders = round(max(SLIDER_SHARE * whole, min(wanted, whole - page)))
        self._room.column.setSizes([whole - sliders, sliders])
        if self.presenting:
            QTimer.singleShot(0, self._show_question)

    def _show_question(self) -> None:
        """Scroll to the question, and to the slider that the step is about."""
        if self.panel:
            self.panel.show_question()
        if key := self._pointed_at[2]:
            self._room.sliders.reveal(key)

    def _point(self, key: str) -> None:
        """Mark the row of one slider, by a line at its left and a bold name."""
        for name, row in self._room.sliders.rows.items():
            wanted = name == key
            if bool(row.property("pointed")) != wanted:
                row.setProperty("pointed", wanted)
                for part in (row, *row.findChildren(QLabel)):
                    part.style().unpolish(part)
                    part.style().polish(part)
        place = self.store.state.lesson
        if key and (place.name, place.step, key) != self._pointed_at:
            self._room.sliders.reveal(key)
        self._pointed_at = place.name, place.step, key
