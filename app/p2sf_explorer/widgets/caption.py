"""The caption above the stage: one line that a hall can read, with the value that moves in another colour."""

from math import ceil

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QAction, QColor, QContextMenuEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QMenu, QSizePolicy, QWidget

from p2sf_explorer.charts.painting import elide, width_of, write
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.caption import Parts
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.state.state import CAPTION

APART = "  ·  "
TYPE, LINE = 13, 1.7  # pixels of type at scale 1, and the height of the line in heights of type
HALL, READ = 0.026, 0.022  # of the screen's height: the size of type while presenting, and the least one
SMALLEST = 9
LEFT_OUT = "strehl", "rms", "depth", "wavelength"
SHORTEST = 4  # heights of type that are left of the name of the lens
NAMES = {
    "lens": "Lens",
    "field": "Field",
    "depth": "Depth",
    "f_number": "f-number",
    "wavelength": "Wavelength",
    "rms": "RMS wavefront",
    "strehl": "Strehl ratio",
}


class Caption(QWidget):
    """Shows the parts of a caption; its menu chooses them. ``chosen``: the names of the parts that are to be shown."""

    chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("caption")
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setToolTip(tr("What the stage shows; right-click to choose the parts of this line"))
        self._theme, self._size, self._least = LIGHT, TYPE, SMALLEST
        self._parts: Parts = {}
        self._rest: Parts = {}
        self._names: tuple[str, ...] = CAPTION

    @property
    def text(self) -> str:
        """Return the whole line."""
        return APART.join(self._parts.values())

    def sizeHint(self) -> QSize:
        """Return the height of the line; the width is that of the stage."""
        return QSize(0, round(LINE * self._size) if self._names else 0)

    def show_parts(self, parts: Parts, names: tuple[str, ...], moving: bool) -> None:
        """Show the parts; while something is ``moving``, those that differ from what was at rest stand out.

        The lens is named as far as the first comma of its title.
        """
        parts = {name: local(tr(text).partition(",")[0] if name == "lens" else text) for name, text in parts.items()}
        if not moving:
            self._rest = parts
        if names != self._names:
            self._names = names
            self.updateGeometry()
        if parts != self._parts or not moving:
            self._parts = parts
            self.update()
        if not moving:  # a reader is told of what is at rest
            self.setAccessibleName(self.text)

    def restyle(self, theme: Tokens, screen_height: int = 0) -> None:
        """Take the colours and the scale of a theme; ``screen_height`` of the screen that a hall looks at."""
        self._theme, self._size = theme, max(theme.px(TYPE), round(HALL * screen_height))
        self._least = max(SMALLEST, ceil(READ * screen_height))
        self.setFixedHeight(self.sizeHint().height())
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the parts in the middle of the line."""
        painter, (parts, size) = QPainter(self), self.fitted()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        left = max(0.0, (self.width() - _width(parts, size)) / 2)
        for number, (name, words) in enumerate(parts.items()):
            if number:
                left += self._write(painter, left, APART, "muted", size)
            moved = self._rest.get(name, self._parts[name]) != self._parts[name]
            left += self._write(painter, left, words, "emphasis" if moved else "text", size)

    def fitted(self) -> tuple[Parts, int]:
        """Return the parts as they are written and the size of their type.

        Where they do not fit, type is smaller, then the lens's name is cut, then `LEFT_OUT` goes, the first first.
        """
        parts, size, room = dict(self._parts), self._size, self.width() - 2 * self._theme.px(4)
        while size > self._least and _width(parts, size) > room:
            size -= 1
        if "lens" in parts and (over := _width(parts, size) - room) > 0:
            kept = max(width_of(parts["lens"], size) - over, SHORTEST * size)
            parts["lens"] = elide(parts["lens"], kept, size)
        for name in LEFT_OUT:
            if _width(parts, size) > room:
                parts.pop(name, None)
        return parts, size

    def _write(self, painter: QPainter, left: float, words: str, token: str, size: int) -> float:
        wide = width_of(words, size)
        painter.setPen(QColor(getattr(self._theme, token)))
        write(painter, QRectF(left, 0, wide, self.height()), words, -1, size)
        return wide

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Let a person choose the parts."""
        self.menu().popup(event.globalPos())

    def menu(self) -> QMenu:
        """Return the menu of the parts."""
        made = QMenu(self)
        made.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        for name, words in NAMES.items():
            action = QAction(tr(words), made, checkable=True, checked=name in self._names)
            action.triggered.connect(lambda on, name=name: self._turn(name, on))
            made.addAction(action)
        return made

    def _turn(self, name: str, on: bool) -> None:
        wanted = {*self._names, name} if on else {*self._names} - {name}
        self.chosen.emit(tuple(part for part in CAPTION if part in wanted))


def _width(parts: Parts, size: int) -> float:
    """Return the width of the line in pixels."""
    return (len(parts) - 1) * width_of(APART, size) + sum(width_of(words, size) for words in parts.values())
