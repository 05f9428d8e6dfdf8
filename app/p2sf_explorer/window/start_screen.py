"""The ways to begin, over the window at the very first start; they can be skipped, and never come again."""

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.files import recent
from p2sf_explorer.i18n.tr import tr

SIZE = 760, 400
WELCOME = "How the light of a point spreads, live"
INTRO = "Drag depth, field and wavelength; the picture follows. Where do you want to begin?"
WAYS = (
    ("Look at a lens", "Choose among lenses from the singlet to the zoom"),
    ("Course", "Six lectures with tasks, to work through or to give"),
    ("Teach", "Lessons with pictures, three minutes each"),
    ("Open my lens file", "Zemax, CODE V, OSLO, a table …"),
    ("Measure a photo", "Wavefronts from a photograph of points"),
)


@dataclass(frozen=True)
class Beginnings:
    """What the ways lead to, in the order of `WAYS`."""

    look: Callable[[], object]
    course: Callable[[], object]
    teach: Callable[[], object]
    open: Callable[[], object]
    measure: Callable[[], object]


class StartScreen(QFrame):
    """A card over the middle of the window with a button for each way to begin."""

    def __init__(self, beginnings: Beginnings, theme: Tokens, window: QWidget) -> None:
        super().__init__(window)
        self.setObjectName("card")
        self.setAccessibleName(tr(WELCOME))
        self._window = window
        heading, intro = QLabel(tr(WELCOME), self), QLabel(tr(INTRO), self)
        heading.setStyleSheet(f"font-size: {theme.px(20)}px; font-weight: 600; color: {theme.text};")
        intro.setWordWrap(True)
        intro.setStyleSheet(f"color: {theme.muted};")
        self.buttons = [self._way(*words, theme) for words in WAYS]
        runs = beginnings.look, beginnings.course, beginnings.teach, beginnings.open, beginnings.measure
        for button, run in zip(self.buttons, runs, strict=True):
            button.clicked.connect(lambda _=False, run=run: self._begin(run))
        self.skip = QPushButton(tr("Skip"), self)
        self.skip.setToolTip(tr("Begin with the window as it is (Esc); this does not come again"))
        self.skip.clicked.connect(self.leave)
        grid = QGridLayout()
        grid.setSpacing(theme.px(10))
        for number, button in enumerate(self.buttons):
            wide = 2 if number == len(self.buttons) - 1 and number % 2 == 0 else 1
            grid.addWidget(button, number // 2, number % 2, 1, wide)
        column = QVBoxLayout(self)
        column.setContentsMargins(*(theme.px(side) for side in (24, 20, 24, 18)))
        column.setSpacing(theme.px(10))
        column.addWidget(heading)
        column.addWidget(intro)
        column.addLayout(grid, 1)
        column.addWidget(self.skip, 0, Qt.AlignmentFlag.AlignRight)
        self._size = tuple(theme.px(side) for side in SIZE)
        window.installEventFilter(self)
        self._place()

    def _way(self, words: str, about: str, theme: Tokens) -> QPushButton:
        button = QPushButton(f"{tr(words)}\n{tr(about)}", self)
        button.setAccessibleName(tr(words))
        button.setAccessibleDescription(tr(about))
        button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        look = f"text-align: left; padding: {theme.px(10)}px; font-size: {theme.px(13)}px;"
        button.setStyleSheet(f"QPushButton {{ {look} }}")
        return button

    def begin(self) -> None:
        """Show the card, its first way in hand."""
        self.show()
        self.raise_()
        self.buttons[0].setFocus()

    def leave(self) -> None:
        """Put the card away for good."""
        self._window.removeEventFilter(self)
        self.hide()
        self.deleteLater()

    def _begin(self, run: Callable[[], object]) -> None:
        self.leave()
        run()

    def _place(self) -> None:
        room = self._window.size()
        wide, high = min(self._size[0], room.width() - 40), min(self._size[1], room.height() - 40)
        self.setGeometry((room.width() - wide) // 2, (room.height() - high) // 2, wide, high)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Stay in the middle of the window."""
        if event.type() == QEvent.Type.Resize:
            self._place()
        return False

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave with Escape."""
        if event.key() == Qt.Key.Key_Escape:
            self.leave()
        else:
            super().keyPressEvent(event)


def first_start() -> bool:
    """Return whether this person has never seen the start screen, and remember that it has been shown."""
    path = recent.recent_path().with_name("start_shown")
    if path.exists() or path.with_name("lesson_offered").exists():  # which versions up to 0.2 left
        return False
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    except OSError:
        return False
    return True
