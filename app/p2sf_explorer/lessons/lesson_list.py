"""The list of lessons with a picture of each, searched by title and content."""

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QIcon, QImage, QPixmap
from PySide6.QtWidgets import QDialog, QListWidget, QListWidgetItem, QVBoxLayout, QWidget

from p2sf.errors import P2SFError
from p2sf.figures.enlarge import enlarge
from p2sf_explorer.charts.plots import as_indices, lookup
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.framing import frame_of, light_circle
from p2sf_explorer.compute.live import live
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.lessons.lesson import Lesson
from p2sf_explorer.widgets.search_line import SearchLine

NAME = Qt.ItemDataRole.UserRole
PICTURE_PX, SIZE = 56, (520, 560)
SAMPLES = 256
LECTURE = "lecture_"  # with which the names of lectures' files begin


class LessonList(QDialog):
    """Lessons by title and sentence; ``chosen``: the name of one. Pictures come one by one."""

    chosen = Signal(str)
    title = "Lessons"

    def __init__(self, lessons: Callable[[], dict[str, Lesson]], parent: QWidget) -> None:
        super().__init__(parent)
        self._lessons = lessons
        self.setWindowTitle(tr(self.title))
        self.list = QListWidget(self)
        self.sought = SearchLine(self.list, self)
        self.sought.setPlaceholderText(tr("Search titles and texts"))
        self.sought.setAccessibleName(tr("Search titles and texts"))
        self.sought.setClearButtonEnabled(True)
        self.list.setAccessibleName(tr(self.title))
        self.list.setWordWrap(True)
        self.list.setIconSize(QSize(PICTURE_PX, PICTURE_PX))
        self.list.setSpacing(2)
        self.column = column = QVBoxLayout(self)
        column.addWidget(self.sought)
        column.addWidget(self.list, 1)
        self.sought.textChanged.connect(self._find)
        self.sought.returnPressed.connect(lambda: self._choose(self.list.currentItem()))
        self.list.itemActivated.connect(self._choose)
        self.list.itemClicked.connect(self._choose)
        self._pictures: dict[str, QIcon] = {}
        self._theme: Tokens | None = None
        self._timer = QTimer(self, singleShot=True, interval=0)
        self._timer.timeout.connect(self._draw_next)

    def open_with(self, theme: Tokens) -> None:
        """Show all lessons, ready to search."""
        if theme != self._theme:
            self._theme, self._pictures = theme, {}
        self.resize(*(theme.px(side) for side in SIZE))
        self.list.setIconSize(QSize(theme.px(PICTURE_PX), theme.px(PICTURE_PX)))
        self.sought.clear()
        self._find("")
        self.show()
        self.raise_()
        self.sought.setFocus()

    def stop(self) -> None:
        """Draw no more pictures."""
        self._timer.stop()

    def _find(self, sought: str) -> None:
        words = sought.casefold().split()
        self.list.clear()
        for number, (name, lesson) in enumerate(self._lessons().items(), 1):
            if all(word in content(lesson) for word in words):
                item = QListWidgetItem(self.line(number, lesson), self.list)
                item.setData(NAME, name)
                item.setIcon(self._pictures.get(name, self._blank()))
        if self.list.count():
            self.list.setCurrentRow(0)
        else:
            nothing = QListWidgetItem(tr("No lesson has these words; try fewer."), self.list)
            nothing.setFlags(Qt.ItemFlag.NoItemFlags)
        self._timer.start()

    def line(self, number: int, lesson: Lesson) -> str:
        """Return the lines of a lesson, the ``number``-th of all."""
        return f"{number}  {lesson.title}\n{lesson.about}"

    def _blank(self) -> QIcon:
        pixmap = QPixmap(self.list.iconSize())
        pixmap.fill(Qt.GlobalColor.transparent)
        return QIcon(pixmap)

    def _draw_next(self) -> None:
        """Draw the picture of one lesson that has none yet."""
        for row in range(self.list.count()):
            item = self.list.item(row)
            name = item.data(NAME)
            if name and name not in self._pictures and self.isVisible() and self._theme:
                self._pictures[name] = lesson_icon(self._lessons()[name], self._theme) or self._blank()
                item.setIcon(self._pictures[name])
                self._timer.start()
                return

    def _choose(self, item: QListWidgetItem | None) -> None:
        if item is not None and item.data(NAME) and self.isVisible():
            self.hide()
            self.chosen.emit(item.data(NAME))


def lecture_heading(lesson: Lesson) -> str:
    """Return the title of a lecture with the number that its name ends in; of anything else the title."""
    number = lesson.name.partition(LECTURE)[2]
    return tr("Lecture {number}: {title}", number=number, title=lesson.title) if number else lesson.title


def content(lesson: Lesson) -> str:
    """Return every word of a lesson in small letters."""
    parts = [lesson.title, lesson.about]
    for step in lesson.steps:
        parts += [step.title, step.text, step.attempt, step.question, step.answer]
    return " ".join(parts).casefold()


def lesson_icon(lesson: Lesson, theme: Tokens) -> QIcon | None:
    """Return the PSF that a lesson begins with, None where it has none."""
    try:
        found = live(lesson.state(0), "preview")
    except P2SFError:
        return None
    psf = found.psf
    frame = frame_of(light_circle(psf.values, psf.pixel_um, found.airy_radius_um))
    fine = enlarge(psf.values, SAMPLES)
    step = psf.values.shape[-1] * psf.pixel_um / fine.shape[-1]
    middle = (fine.shape[-1] - 1) / 2
    ends = [
        slice(max(0, round(middle + (at - frame.half_um) / step)), max(1, round(middle + (at + frame.half_um) / step)))
        for at in (frame.y_um, frame.x_um)
    ]
    bright = np.sqrt(np.clip(fine[ends[0], ends[1]][::-1] / fine.max(), 0, 1))
    pixels = np.ascontiguousarray(lookup(theme.brightness)[as_indices(bright, 0.0, 1.0)])
    image = QImage(pixels.data, pixels.shape[1], pixels.shape[0], 4 * pixels.shape[1], QImage.Format.Format_RGB32)
    return QIcon(QPixmap.fromImage(image.copy()))
