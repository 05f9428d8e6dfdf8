"""What a lecturer reads while a lesson is presented: the note, the question with its answer, what comes next."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QElapsedTimer, Qt, QTimer
from PySide6.QtWidgets import QLabel, QScrollArea, QVBoxLayout, QWidget

from p2sf_explorer.i18n.tr import local, tr

if TYPE_CHECKING:
    from p2sf_explorer.lessons.lesson import Lesson

SIZE = 520, 640
KEYS = "Page Down goes on, Page Up back, a full stop blanks the screen, T stops the countdown, letters count votes"


class NotesWindow(QWidget):
    """A window of its own, for the screen that the hall does not see."""

    def __init__(self, parent: QWidget) -> None:
        from p2sf_explorer.lessons.lesson_panel import wrapped_label

        super().__init__(parent, Qt.WindowType.Window)
        self.setObjectName("window")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setWindowTitle(tr("Notes"))
        self.clock, self.place = QLabel(self), wrapped_label("muted")
        self.clock.setObjectName("sentence")
        self.text, keys = wrapped_label("", Qt.TextFormat.RichText), wrapped_label("muted")
        self.text.setAlignment(Qt.AlignmentFlag.AlignTop)
        keys.setText(tr(KEYS))
        area = QScrollArea(self)
        area.setWidgetResizable(True)
        area.setFrameShape(QScrollArea.Shape.NoFrame)
        area.setWidget(self.text)
        area.setAccessibleName(tr("Notes"))
        column = QVBoxLayout(self)
        for part in (self.clock, self.place):
            column.addWidget(part)
        column.addWidget(area, 1)
        column.addWidget(keys)
        self._since = QElapsedTimer()
        self._timer = QTimer(self, interval=1000)
        self._timer.timeout.connect(self._tick)
        self.resize(*SIZE)

    def begin(self) -> None:
        """Show the window, and count the time from now."""
        self._since.start()
        self._timer.start()
        self._tick()
        self.show()

    def end(self) -> None:
        """Put the window away."""
        self._timer.stop()
        self.hide()

    def _tick(self) -> None:
        seconds = self._since.elapsed() // 1000
        self.clock.setText(f"{seconds // 60}:{seconds % 60:02d}")

    def show_step(self, lesson: "Lesson", number: int) -> None:
        """Show what belongs to a step."""
        from p2sf_explorer.lessons.lesson_panel import rich

        step, following = lesson.steps[number], lesson.steps[number + 1 : number + 2]
        self.place.setText(f"{lesson.title} · {tr('step {k} of {n}', k=number + 1, n=len(lesson.steps))}")
        parts = [f"**{step.title}**", step.note or step.text]
        parts += [f"**{step.question}**", step.answer] if step.question else []
        parts += [tr("Next: {title}", title=f"*{next_step.title}*") for next_step in following]
        self.text.setText(rich(local("\n\n".join(parts))))
