"""The import report: what was read, substituted, ignored or taken differently from the file."""

from dataclasses import dataclass, field
from typing import Literal

from p2sf.messages import Message

Kind = Literal["read", "substituted", "ignored", "unknown", "caution"]
MOST_NOTES = 500
TITLES: dict[Kind, str] = {
    "read": "read",
    "substituted": "substituted",
    "ignored": "ignored, without effect on the picture",
    "unknown": "unknown here, and not read",
    "caution": "taken differently from the file",
}


@dataclass(frozen=True)
class Note:
    """One sentence of the report; ``surface`` and ``line`` count from 1, None where neither is meant."""

    kind: Kind
    message: Message
    surface: int | None = None
    line: int | None = None

    @property
    def sentence(self) -> Message:
        """Return the note with its surface and line in front."""
        if self.surface and self.line:
            return Message(
                "surface {surface}, line {line}: {message}",
                surface=self.surface,
                line=self.line,
                message=self.message,
            )
        if self.surface:
            return Message("surface {surface}: {message}", surface=self.surface, message=self.message)
        if self.line:
            return Message("line {line}: {message}", line=self.line, message=self.message)
        return self.message


@dataclass(frozen=True)
class ImportReport:
    """Notes on one imported file, in file order."""

    path: str
    format: str
    encoding: str
    notes: tuple[Note, ...] = ()

    def of(self, kind: Kind) -> tuple[Note, ...]:
        """Return the notes of one kind."""
        return tuple(note for note in self.notes if note.kind == kind)

    def lines(self) -> tuple[Message, ...]:
        """Return the whole report line by line: the file, then each kind of note under its title."""
        lines = [Message("{path}: {format}, {encoding}", path=self.path, format=self.format, encoding=self.encoding)]
        for kind, title in TITLES.items():
            notes = self.of(kind)
            if notes:
                lines.append(Message("{title}:", title=Message(title)))
            lines += [Message("  - {note}", note=note.sentence) for note in notes]
        return tuple(lines)

    @property
    def text(self) -> str:
        """Return the whole report in plain English."""
        return "\n".join(map(str, self.lines()))


@dataclass
class Notebook:
    """Collects notes while a file is being read, at most `MOST_NOTES` of them."""

    seen: dict[Note, None] = field(default_factory=dict)
    unknown: dict[str, list[int]] = field(default_factory=dict)

    @property
    def notes(self) -> list[Note]:
        """Return the notes in the order in which they were added, then one for each unknown word of the file."""
        words = [
            Note("unknown", Message("{name} ({count}×)", name=word, count=len(lines)), None, lines[0])
            for word, lines in self.unknown.items()
        ]
        return [*self.seen, *words[:MOST_NOTES]]

    def add_unknown(self, name: str, line: int) -> None:
        """Count a word of the file, in one of its lines, of which the reader knows nothing."""
        self.unknown.setdefault(name[:40], []).append(line)

    def add(
        self,
        kind: Kind,
        template: str | Message,
        /,
        surface: int | None = None,
        line: int | None = None,
        **values: object,
    ) -> None:
        """Add a note with the values its template names; an equal note is not repeated."""
        if len(self.seen) < MOST_NOTES:
            message = template if isinstance(template, Message) else Message(template, **values)
            self.seen[Note(kind, message, surface, line)] = None
