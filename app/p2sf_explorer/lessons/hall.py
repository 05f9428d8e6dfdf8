"""A lesson in the hall: keys of a presenter's remote, the question large, a black screen, notes in their own window."""

from functools import cached_property
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, QRect, Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QWidget

from p2sf_explorer.lessons.hall_card import HallCard
from p2sf_explorer.state.state import State
from p2sf_explorer.widgets.command import Command

if TYPE_CHECKING:
    from p2sf_explorer.lessons.controller import LessonController
    from p2sf_explorer.lessons.lesson import Lesson, Step
    from p2sf_explorer.lessons.notes import NotesWindow


class Hall(QObject):
    """While ``presenting``, Page Down goes from picture to question, answer and next step, and Page Up back."""

    def __init__(self, teaching: "LessonController", stage: QWidget, window: QWidget) -> None:
        super().__init__(window)
        self._teaching, self._store, self._window = teaching, teaching.store, window
        self.card = HallCard(stage)
        self.black = QWidget(window)
        self.black.setStyleSheet("background: black;")
        self.black.hide()
        window.installEventFilter(self)
        keys = (
            ("PgDown", lambda: self.go(1)),
            ("PgUp", lambda: self.go(-1)),
            ("B", self.blank),
            (".", self.blank),
            ("T", self.card.countdown.turn),
        )
        self.shortcuts = [self._shortcut(key, window) for key, _ in keys]
        for shortcut, (_, run) in zip(self.shortcuts, keys, strict=True):
            shortcut.activated.connect(run)
        self.presenting = False
        self._step: tuple[str, int] = "", 0
        self._store.changed.connect(self._follow)

    @cached_property
    def notes(self) -> "NotesWindow":
        """The window of the notes, made when it is first wanted."""
        from p2sf_explorer.lessons.notes import NotesWindow

        return NotesWindow(self._window)

    @property
    def _noted(self) -> bool:
        """Whether the notes are on show."""
        return "notes" in vars(self) and self.notes.isVisible()

    def commands(self) -> tuple[Command, ...]:
        """Return what can be done while teaching."""
        return (Command("Notes of the lesson in a window of their own", self.turn_notes, ("Ctrl+F5",), "Lessons"),)

    def _shortcut(self, key: str, window: QWidget) -> QShortcut:
        made = QShortcut(QKeySequence(key), window)
        made.setContext(Qt.ShortcutContext.ApplicationShortcut)  # also in the window of the notes
        made.setEnabled(False)
        return made

    def present(self, on: bool, room: QRect | None) -> None:
        """Begin or end presenting; ``room`` is where notes may stand on a second screen, None where there is none."""
        self.presenting = on
        self._follow(self._store.state)
        if on and room and self._lesson():
            self.notes.move(room.topLeft())
            self.notes.resize(self.notes.size().boundedTo(room.size()))
            if not self._noted:
                self.turn_notes()
        elif not on:
            if self._noted:
                self.notes.end()
            self.card.put_away()
            self.black.hide()

    def turn_notes(self) -> None:
        """Show the notes, or put them away."""
        if self._noted:
            self.notes.end()
        elif self._lesson():
            self.notes.begin()
            self._follow(self._store.state)

    def blank(self) -> None:
        """Make the screen black, or show it again."""
        self.black.setGeometry(self._window.rect())
        self.black.setVisible(not self.black.isVisible())
        self.black.raise_()

    def go(self, by: int) -> None:
        """Go a stage on, 1, or back, −1: the picture, the question, its answer, the next step."""
        if self.black.isVisible():
            self.blank()
            return
        if not (lesson := self._lesson()):
            return
        step = lesson.steps[self._step[1]]
        if by < 0 and self.card.isVisible():
            self.card.put_away()
        elif by > 0 and step.question and not self.card.isVisible():
            self.card.ask(step)
        elif by > 0 and self.card.isVisible() and not self.card.told:
            self._tell(step)
        else:
            self.card.put_away()
            self._teaching.move(by)

    def _tell(self, step: "Step") -> None:
        """Show the answer, and the state that the question had asked to predict."""
        from p2sf_explorer.lessons.changes import apply_changes

        self.card.tell(step)
        lesson, now = self._lesson(), self._store.state
        if lesson and step.task and step.task.see:
            self._store.replace(apply_changes(lesson.state(self._step[1], now), step.task.see))

    def _lesson(self) -> "Lesson | None":
        name = self._store.state.lesson.name
        return self._teaching.shelf(name).get(name) if name else None

    def _follow(self, state: State) -> None:
        """Follow the step of a state while it is presented or noted; another step puts the question away."""
        lesson = self._lesson() if self.presenting or self._noted else None
        for shortcut in self.shortcuts:
            shortcut.setEnabled(self.presenting and lesson is not None)
        number = min(state.lesson.step, len(lesson.steps) - 1) if lesson else 0
        if (state.lesson.name, number) != self._step:
            self._step = state.lesson.name, number
            self.card.put_away()
        if lesson and self._noted:
            self.notes.show_step(lesson, number)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep the whole window black."""
        if event.type() == QEvent.Type.Resize and self.black.isVisible():
            self.black.setGeometry(self._window.rect())
        return False
