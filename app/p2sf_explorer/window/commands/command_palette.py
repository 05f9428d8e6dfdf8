"""The command palette: every action, panel, lens and preset by a few letters of its name."""

from collections.abc import Iterable, Iterator

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QLabel, QLineEdit, QListWidget, QListWidgetItem, QVBoxLayout, QWidget

from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.widgets.command import Command

START, NEXT, GAP = 8.0, 6.0, 0.3  # scores of a letter at a word's start and right behind the last; cost of a gap
LATE, LONG = 0.05, 0.01  # costs of every letter before the first that fits, and of every letter of the text


def score(sought: str, text: str) -> float | None:
    """Return how well letters in their order fit a text, None where they do not; case and spaces do not count."""
    letters, words = sought.casefold().replace(" ", ""), text.casefold()
    if not letters:
        return 0.0
    starts = (at for at, letter in enumerate(words) if letter == letters[0])
    return max((worth for at in starts for worth in _from(letters, words, at)), default=None)


def _from(letters: str, words: str, at: int) -> Iterator[float]:
    """Yield the score of the letters with the first one at a place and each other one at its next occurrence."""
    worth, last = 0.0, at - 1
    for letter in letters:
        found = _start(words, letter, last + 1)
        if found < 0:
            return
        worth += START if _begins(words, found) else NEXT if found == last + 1 else 0.0
        worth -= GAP * (found - last - 1)
        last = found
    yield worth - LATE * at - LONG * len(words)


def _start(words: str, letter: str, after: int) -> int:
    """Return where a letter comes next: right there, else at a word's start, else anywhere."""
    if words[after : after + 1] == letter:
        return after
    starts = [k for k in range(after, len(words)) if words[k] == letter and _begins(words, k)]
    return starts[0] if starts else words.find(letter, after)


def _begins(words: str, at: int) -> bool:
    return at == 0 or not words[at - 1].isalnum()


def rank(sought: str, texts: Iterable[str]) -> list[int]:
    """Return the numbers of the texts that fit, the best first, equals in their order."""
    found = [(-worth, number) for number, text in enumerate(texts) if (worth := score(sought, text)) is not None]
    return [number for _, number in sorted(found)]


WIDE, MOST = 520, 60
HINT = "Type a few letters, choose with ↑ ↓, run with Enter, leave with Escape."
STEPS = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)


class Palette(QFrame):
    """A line to type into and what fits it, the best first."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self._window = parent
        self.setObjectName("card")
        self.sought, self.found = QLineEdit(self), QListWidget(self)
        self.sought.setPlaceholderText(tr("What do you want to do?"))
        self.sought.setAccessibleName(tr("Find a command, a panel, a lens or a preset"))
        self.sought.textChanged.connect(self._find)
        self.sought.installEventFilter(self)
        self.found.setFrameShape(QListWidget.Shape.NoFrame)
        self.found.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.found.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.found.itemClicked.connect(lambda _: self.take())
        hint = QLabel(tr(HINT), self)
        hint.setObjectName("muted")
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        for widget in (self.sought, self.found, hint):
            column.addWidget(widget)
        self._commands: tuple[Command, ...] = ()

    def open_with(self, commands: tuple[Command, ...]) -> None:
        """Show all commands, ready to type."""
        self._commands = commands
        parent = self._window
        self.resize(min(WIDE, parent.width() - 40), min(460, parent.height() - 120))
        corner = parent.mapToGlobal(parent.rect().topLeft())
        self.move(corner.x() + (parent.width() - self.width()) // 2, corner.y() + 70)
        self.sought.clear()
        self._find("")
        self.show()
        self.sought.setFocus()

    def _find(self, sought: str) -> None:
        names = [full_name(command) for command in self._commands]
        english = [f"{command.group}: {command.title}" for command in self._commands]  # whatever language was left on
        fitting = dict.fromkeys(number % len(names) for number in rank(sought, [*names, *english]))
        self.found.clear()
        for number in list(fitting)[:MOST]:
            keys = self._commands[number].keys
            item = QListWidgetItem(names[number] + (f"    {keys[0]}" if keys else ""))
            item.setData(Qt.ItemDataRole.UserRole, number)
            self.found.addItem(item)
        if self.found.count():
            self.found.setCurrentRow(0)
        else:
            nothing = QListWidgetItem(tr("Nothing fits; try fewer letters."), self.found)
            nothing.setFlags(Qt.ItemFlag.NoItemFlags)

    def take(self) -> None:
        """Do what is chosen."""
        item = self.found.currentItem()
        number = item.data(Qt.ItemDataRole.UserRole) if item else None
        if number is not None:
            self.hide()
            self._commands[number].run()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Hand the keys that choose on to the list."""
        if not isinstance(event, QKeyEvent) or event.type() != QEvent.Type.KeyPress:
            return False
        if event.key() in STEPS:
            self.found.event(event)
            return True
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.take()
            return True
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
            return True
        return False


def full_name(command: Command) -> str:
    """Return a command's name with its group, in the present language."""
    return f"{tr(command.group)}: {tr(command.title)}"
