"""What a file says of its lens as a whole beside what the surfaces give: focal length, f-number, back focus, track."""

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from math import isfinite
from typing import Literal

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.meridians import meridians
from p2sf.lensfile.report import ImportReport, Notebook
from p2sf.lensfile.source_text import LensText
from p2sf.messages import Message
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import f_number

StatedKind = Literal["focal_length", "f_number", "back_focal_length", "track", "half_field"]
WORDS: dict[StatedKind, Message] = {
    "focal_length": Message("focal length, mm"),
    "f_number": Message("f-number"),
    "back_focal_length": Message("back focal length, mm"),
    "track": Message("track from the first surface to the sensor, mm"),
    "half_field": Message("half field, °"),
}
SAME = 0.005  # a share; rounding in titles is smaller
NUMBER = r"(\d+(?:\.\d+)?)"
# Lines of titles and comments in the formats that are read.
REMARK = re.compile(
    r"^\s*(?:!|#|//|;|(?:NOTE|NAME|TIT|TITLE|DES|COMM|LEN)\b|\"?(?:title|name|info|description)\"?\s*[:=\t])", re.I
)
MOST_REMARKS = 100
PATTERNS: tuple[tuple[StatedKind, str], ...] = (
    ("focal_length", rf"\b(?:efl|(?<!back )focal length|f'? ?(?==))\s*(?:of|[=:]|)\s*{NUMBER}\s*(?:mm\b|[,;)]|$)"),
    (
        "back_focal_length",
        rf"\b(?:bfl|bfd|back focal (?:length|distance))\s*(?:of|[=:]|)\s*{NUMBER}\s*(?:mm\b|[,;)]|$)",
    ),
    ("f_number", rf"\bf(?:\s*/\s*#?|no)\s*[=:]?\s*{NUMBER}(?!\.?\d)"),  # also "f/2.8E"
    ("half_field", rf"\b(?:hfov|half (?:field|angle)(?: of view)?)\s*(?:of|[=:]|)\s*{NUMBER}\s*(?:°|deg)"),
)


@dataclass(frozen=True)
class Stated:
    """One number that a file states of the whole lens, in mm or degrees, with its line."""

    kind: StatedKind
    value: float
    line: int | None = None


def in_remarks(source: LensText) -> Iterator[Stated]:
    """Yield what titles and comments of a file state, such as "EFL = 50 mm", "f/2" or "HFOV 20°", each kind once."""
    remarks = [(n, text) for n, text in enumerate(source.lines, 1) if REMARK.match(text)][:MOST_REMARKS]
    for kind, pattern in PATTERNS:
        found = ((n, re.search(pattern, text[:1000], re.IGNORECASE)) for n, text in remarks)
        line, match = next(((n, match) for n, match in found if match and float(match[1])), (0, None))
        if match:
            yield Stated(kind, float(match[1]), line)


def compare(stated: list[Stated], lens: Lens, notes: Notebook) -> None:
    """Note each stated number beside that of the lens; one that is more than `SAME` off is a caution."""
    for each in stated:
        found = _nearest(each, lens)
        if found is None or not isfinite(found) or not each.value:
            continue
        off = abs(found) / abs(each.value) - 1
        told = "{what}: the file states {stated:.6g}, its surfaces give {found:.6g} ({off:+.2%})"
        what = WORDS[each.kind]
        notes.add(
            "caution" if abs(off) > SAME else "read",
            told,
            None,
            each.line,
            what=what,
            stated=abs(each.value),
            found=abs(found),
            off=off,
        )


def stated_in(report: ImportReport, kind: StatedKind) -> float | None:
    """Return the number that the file of a report states, None where it states none."""
    found = (note.message.values for note in report.notes if note.message.values.get("what") == WORDS[kind])
    value = next((values["stated"] for values in found), None)
    return value if isinstance(value, float) else None


def _nearest(stated: Stated, lens: Lens) -> float | None:
    """Return what the lens has of a kind, in that of its meridians which is nearer to what is stated."""
    both = [_of_lens(stated.kind, each) for each in meridians(lens)]
    known = [each for each in both if each is not None]
    return min(known, key=lambda each: abs(abs(each) - abs(stated.value)), default=None)


def _of_lens(kind: StatedKind, lens: Lens) -> float | None:
    """Return what the lens itself has of a kind, at its reference wavelength; None where it has none."""
    wave = lens.reference_wavelength_um
    with np.errstate(all="ignore"), suppress(GeometryError):  # an absurd lens has none
        match kind:
            case "focal_length":
                return float(cardinal_points(lens, wave).effective_focal_length)
            case "f_number":
                return float(f_number(lens, wave))
            case "back_focal_length":
                return float(cardinal_points(lens, wave).back_focal_distance)
            case "track":
                return lens.vertices[-1]
            case "half_field":
                return max(map(abs, (*lens.fields_deg, *lens.fields_x_deg)))
    return None
