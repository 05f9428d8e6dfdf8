"""The import report: what was read, substituted, ignored, and why that matters or does not."""

from dataclasses import dataclass, field
from typing import Literal

Kind = Literal["read", "substituted", "ignored", "caution"]
MOST_NOTES = 500
TITLES = {
    "read": "read",
    "substituted": "substituted",
    "ignored": "ignored, without effect on the picture",
    "caution": "taken differently from the file",
}


@dataclass(frozen=True)
class Note:
    """One sentence of the report; ``surface`` and ``line`` count from 1, None where neither is meant."""

    kind: Kind
    text: str
    surface: int | None = None
    line: int | None = None

    @property
    def sentence(self) -> str:
        """Return the note with its surface and line in front."""
        where = [f"surface {self.surface}"] * bool(self.surface) + [f"line {self.line}"] * bool(self.line)
        return f"{', '.join(where)}: {self.text}" if where else self.text


@dataclass(frozen=True)
class ImportReport:
    """Everything a user should know of one import, in the order of the file."""

    path: str
    format: str
    encoding: str
    notes: tuple[Note, ...] = ()

    def of(self, kind: Kind) -> tuple[Note, ...]:
        """Return the notes of one kind."""
        return tuple(note for note in self.notes if note.kind == kind)

    @property
    def text(self) -> str:
        """Return the whole report as lines a person reads."""
        lines = [f"{self.path}: {self.format}, {self.encoding}"]
        for kind, title in TITLES.items():
            notes = self.of(kind)
            lines += [f"{title}:"] * bool(notes) + [f"  - {note.sentence}" for note in notes]
        return "\n".join(lines)


@dataclass
class Notebook:
    """Collects notes while a file is being read; a file of nonsense does not fill the memory."""

    seen: dict[Note, None] = field(default_factory=dict)

    @property
    def notes(self) -> list[Note]:
        """Return the notes in the order they came."""
        return list(self.seen)

    def add(self, kind: Kind, text: str, surface: int | None = None, line: int | None = None) -> None:
        """Add a note once; the same sentence about the same surface is not repeated."""
        if len(self.seen) < MOST_NOTES:
            self.seen[Note(kind, text, surface, line)] = None


def note_vignetting(notes: Notebook, factors) -> None:
    """Note vignetting factors: without effect where all are 0, else the pupil stays full unless rims cut it."""
    if all(word.strip("+-0.").upper() in ("", "E") for word in factors):
        notes.add("ignored", "vignetting factors, all of them 0")
    else:
        notes.add("caution", "vignetting factors are not applied; the pupil is full unless the rims cut it")
