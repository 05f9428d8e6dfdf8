"""A lesson in the hall: keys of a presenter's remote, the question large, two votes, a black screen, notes."""

from collections.abc import Callable
from dataclasses import replace
from functools import cached_property, partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, QRect, Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QWidget

from p2sf_explorer.lessons.hall_card import ASKED, HallCard, Phase, options_of, phases
from p2sf_explorer.lessons.votes import Votes
from p2sf_explorer.state.state import State
from p2sf_explorer.widgets.command import Command

if TYPE_CHECKING:
    from p2sf_explorer.lessons.controller import LessonController
    from p2sf_explorer.lessons.lesson import Lesson, Step
    from p2sf_explorer.lessons.notes import NotesWindow

LETTERS = "ABCDEF"  # of options that votes are counted for


class Hall(QObject):
    """While ``presenting``, Page Down goes from picture to question, votes, answer and next step, and Page Up back."""

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
            (".", self.blank),
            ("T", self.card.countdown.turn),
        )
        self.shortcuts = [self._shortcut(key, window, run) for key, run in keys]
        self.black_key = self._shortcut("B", window, self.blank)
        self.hands = [self._shortcut(key, window, partial(self.vote, k)) for k, key in enumerate(LETTERS)]
        self.take_back = self._shortcut("Backspace", window, self.unvote)
        self.reason = self._shortcut("Return", window, self._give_reason)
        self.presenting, self.votes = False, Votes()
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

    def _shortcut(self, key: str, window: QWidget, run: Callable[[], object]) -> QShortcut:
        made = QShortcut(QKeySequence(key), window)
        made.activated.connect(run)
        made.setContext(Qt.ShortcutContext.ApplicationShortcut)  # also in the window of the notes
        made.setEnabled(False)
        return made

    def present(self, on: bool, room: QRect | None) -> None:
        """Begin or end presenting; ``room`` is where notes may stand on a second screen, None where there is none."""
        self.presenting = on
        self._teaching.turn = self.go if on else self._teaching.move
        self._teaching.present(on)
        self._follow(self._store.state)
        if on and room and self._lesson():
            self.notes.move(room.topLeft())
            self.notes.resize(self.notes.size().boundedTo(room.size()))
            if not self._noted:
                self.turn_notes()
        elif not on:
            if self._noted:
                self.notes.end()
            self._put_away()
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
        """Go a stage on, 1, or back, −1: the picture, the question and its votes, the answer, the next step."""
        if self.black.isVisible():
            self.blank()
            return
        if not (lesson := self._lesson()):
            return
        step, shown = lesson.steps[self._step[1]], self.card.isVisible()
        order = phases(step) if step.question else ()
        later = order[order.index(self.card.phase) + 1 :] if shown else order
        if by < 0 and shown:
            self._put_away()
        elif by > 0 and later:
            self._show(step, later[0])
        else:
            self._put_away()
            self._teaching.move(by)

    def _show(self, step: "Step", phase: Phase) -> None:
        """Show a phase of the question; with the right option, the state that was to be predicted."""
        from p2sf_explorer.lessons.changes import apply_changes

        lesson = self._lesson()
        if phase is Phase.FIRST:
            self.votes = Votes()
        elif phase is Phase.SECOND:
            self.votes = replace(self.votes, again=True)
        marked = self._teaching.desk.mark_words(lesson, self._step[1]) if lesson and phase not in ASKED else ""
        self.card.show_phase(step, phase, self.votes, marked)
        self._free_keys()
        answers = [one for one in phases(step) if one not in ASKED]
        if phase is answers[0]:
            self._teaching.told_in_hall = self._step
            self._teaching.follow(self._store.state)
        if lesson and step.task and step.task.see and phase is answers[0]:
            self._store.replace(apply_changes(lesson.state(self._step[1], self._store.state), step.task.see))

    def vote(self, place: int) -> None:
        """Count a raised hand for the option at a place; the first one opens the vote."""
        if not self.card.isVisible() and place < self._options:
            self.go(1)
        if place < self.card.voting:
            self.votes = self.votes.with_counted((*self.votes.counted, place))
            self.card.show_votes(self.votes)

    def unvote(self) -> None:
        """Take back the vote that was counted last."""
        self.votes = self.votes.with_counted(self.votes.counted[:-1])
        self.card.show_votes(self.votes)

    def _give_reason(self) -> None:
        """Let a reason be typed, or end it."""
        line = self.card.because
        if line.hasFocus():
            line.clearFocus()
        else:
            line.setFocus()

    def _put_away(self) -> None:
        self.card.put_away()
        self._free_keys()

    def _free_keys(self) -> None:
        """Let letters count votes only while there is something to vote for, and Return type only a reason."""
        on, options = self.presenting and self._lesson() is not None, self._options
        for shortcut in self.shortcuts:
            shortcut.setEnabled(on)
        for place, shortcut in enumerate(self.hands):
            shortcut.setEnabled(on and place < options)
        self.black_key.setEnabled(on and not options)
        self.take_back.setEnabled(on and self.card.voting > 0)
        self.reason.setEnabled(on and self.card.isVisible() and not self.card.because.isHidden())

    @property
    def _options(self) -> int:
        """How many options of the step are voted for now, or as soon as a letter opens the vote."""
        lesson = self._lesson()
        if self.card.isVisible() or not lesson:
            return self.card.voting
        return len(options_of(lesson.steps[self._step[1]], False))

    def _lesson(self) -> "Lesson | None":
        name = self._store.state.lesson.name
        return self._teaching.shelf(name).get(name) if name else None

    def _follow(self, state: State) -> None:
        """Follow the step of a state while it is presented or noted; another step puts the question away."""
        lesson = self._lesson() if self.presenting or self._noted else None
        number = min(state.lesson.step, len(lesson.steps) - 1) if lesson else 0
        if (state.lesson.name, number) != self._step:
            self._step = state.lesson.name, number
            self.card.put_away()
        self._free_keys()
        if lesson and self._noted:
            self.notes.show_step(lesson, number)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep the whole window black."""
        if event.type() == QEvent.Type.Resize and self.black.isVisible():
            self.black.setGeometry(self._window.rect())
        return False
