"""The command palette: every action, panel, lens, lesson and preset by a few letters or words of it."""

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QLabel, QListWidget, QListWidgetItem, QVBoxLayout, QWidget

from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.widgets.command import Command
from p2sf_explorer.widgets.search_line import SearchLine

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


WHOLE, BY_WORDS = 5.0, 8.0  # for a word that is typed whole, and for all words together
FURTHER, MISTYPED = 0.6, 0.5  # parts of the score of words that are not of the name, and of those with a typing error
EARLY = 0.4  # cost of every word of the name before the one that fits
FEWEST = 4  # letters of a word that may have a typing error; two from FEWER_ERRORS on
FEWER_ERRORS = 6
WORD = re.compile(r"[^\W_]+(?:[′'’][^\W_]+)*")


def words_score(sought: str, name: str, further: str = "") -> float | None:
    """Return how well every word that is sought fits a word of the name or the further words; None where one does not.

    A word fits from its start, or within two typing errors (Damerau 1964: a letter more, less, other, or two swapped).
    """
    total, asked = BY_WORDS - LONG * len(name), WORD.findall(sought.casefold())
    for word in asked:
        own = (_word_score(word, each) - EARLY * at for at, each in enumerate(_words(name)))
        best = max(own, default=0.0)
        best = max(best, max((FURTHER * _word_score(word, each) for each in _words(further)), default=0.0))
        if best <= 0:
            return None
        total += best
    return total if asked else None


@lru_cache(maxsize=4096)
def _words(text: str) -> tuple[str, ...]:
    """Return the different words of a text in their order."""
    return tuple(dict.fromkeys(WORD.findall(text.casefold())))


def _word_score(sought: str, word: str) -> float:
    """Return the score of a word, 0 where it does not fit."""
    full = START + NEXT * (len(sought) - 1)
    if word.startswith(sought):
        return full + (WHOLE if word == sought else 0.0)
    if len(sought) >= FEWEST and sought in word:
        return MISTYPED * full
    allowed = 0 if len(sought) < FEWEST else 1 + (len(sought) >= FEWER_ERRORS)
    if not allowed or (sought[0] != word[0] and sought[:2] != word[1::-1]):
        return 0.0
    errors = min(typing_errors(sought, word[: len(sought) + more]) for more in (-1, 0, 1))
    return MISTYPED * (full - NEXT * errors) if errors <= allowed else 0.0


def typing_errors(one: str, other: str) -> int:
    """Return how many letters are missing, too many, other, or swapped with a neighbour (optimal string alignment)."""
    before, last = [0] * (len(other) + 1), list(range(len(other) + 1))
    for row, letter in enumerate(one, 1):
        now = [row]
        for column, against in enumerate(other, 1):
            least = min(last[column] + 1, now[-1] + 1, last[column - 1] + (letter != against))
            if row > 1 and column > 1 and (letter, one[row - 2]) == (other[column - 2], against):
                least = min(least, before[column - 2] + 1)
            now.append(least)
        before, last = last, now
    return last[-1]


def rank(sought: str, texts: Sequence[str], further: Sequence[str] = ()) -> list[int]:
    """Return the numbers of the texts that fit, the best first, equals in their order.

    Where a name has all words that are sought, letters scattered over other texts are no hits.
    """
    found, asked = [], set(WORD.findall(sought.casefold()))
    whole = bool(asked) and any(asked <= set(_words(text)) for text in texts)
    for number, text in enumerate(texts):
        by_words = words_score(sought, text, further[number] if further else "")
        by_letters = None if whole and by_words is None else score(sought, text)
        worths = [worth for worth in (by_letters, by_words) if worth is not None]
        if worths:
            found.append((-max(worths), number))
    return [number for _, number in sorted(found)]


WIDE, MOST = 520, 60
HINT = "Type a few letters, choose with ↑ ↓, run with Enter, leave with Escape."


class Palette(QFrame):
    """A line to type into and what fits it, the best first."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self._window = parent
        self.setObjectName("card")
        self.found = QListWidget(self)
        self.sought = SearchLine(self.found, self)
        self.sought.setPlaceholderText(tr("What do you want to do?"))
        self.sought.setAccessibleName(tr("Find a command, a panel, a lens, a lesson or a preset"))
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
        further = [command.further for command in self._commands]
        ranked = rank(sought, [*names, *english], [*further, *further])
        fitting = dict.fromkeys(number % len(names) for number in ranked)
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
        """Run what is chosen with Return, and leave with Escape."""
        if not isinstance(event, QKeyEvent) or event.type() != QEvent.Type.KeyPress:
            return False
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.take()
            return True
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
            return True
        return False


def full_name(command: Command) -> str:
    """Return a command's name with its group, in the present language."""
    return f"{tr(command.group)}: {command.title if command.worded else tr(command.title)}"
