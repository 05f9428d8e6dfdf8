"""What commands print: tables with units for people, one JSON object for programs, warnings on standard error."""

import json
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import zip_longest
from math import inf, isinf
from shutil import get_terminal_size
from time import perf_counter
from typing import Any
from unicodedata import combining, east_asian_width

from p2sf.files.writing import plain
from p2sf.image.progress import seconds_left
from p2sf.lens.source import Source
from p2sf.messages import Message, printable
from p2sf.parameters import COMMAND_LINE
from p2sf.setting import Setup

Row = tuple[object, ...]
FILLED = {"stop": "the real stop", "paraxial": "the paraxial entrance pupil"}  # by exact rays, `Lens.aim`
LINE = 30  # columns of a line of progress
EVERY = 10.0  # seconds between lines of progress in a log
NARROWEST = 12  # columns of a cell that goes on in further lines


def print_json(value: Mapping[str, Any]) -> None:
    """Print one JSON object; infinite numbers become null."""
    print(json.dumps(plain(value), allow_nan=False))


def print_table(title: str, columns: tuple[str, ...], rows: Sequence[Row]) -> None:
    """Print a table, with a rule and bold type only on a terminal; numbers to six digits, columns of them to the right.

    Where a terminal is too narrow for it, heads and columns of text go on in further lines.
    """
    terminal = sys.stdout.isatty()
    gap = "   " if terminal else "  "
    numeric = [any(isinstance(row[number], int | float) for row in rows) for number in range(len(columns))]
    table = [columns, *(tuple(map(text, row)) for row in rows)]
    room = get_terminal_size().columns - len(gap) * (len(columns) - 1) if terminal else inf
    widths = _widths(table, numeric, room)
    head, *body = (_row_lines(row, widths, numeric, gap) for row in table)
    bold, plain = ("\033[1m", "\033[0m") if terminal and _shows_bold() else ("", "")
    rule = ["─" * text_width(head[0])] if terminal else []
    page = [f"{bold}{line}{plain}" for line in (*printable(title).split("\n"), *head)] + rule
    sys.stdout.write("\n".join([*page, *(line for lines in body for line in lines), ""]))


def _widths(table: Sequence[tuple[str, ...]], numeric: Sequence[bool], room: float) -> list[int]:
    """Return the widths of the columns of a table, its head the first row, shrunk to fit where that is possible.

    Heads break at their words first, then columns of text, the widest first, but none below NARROWEST.
    """
    widths = [max(map(text_width, column)) for column in zip(*table, strict=True)]
    if sum(widths) <= room:
        return widths
    widths = [max(map(text_width, (*head.split(), *cells))) for head, *cells in zip(*table, strict=True)]
    while sum(widths) > room:
        wide = [number for number, width in enumerate(widths) if width > NARROWEST and not numeric[number]]
        if not wide:
            break
        widths[max(wide, key=widths.__getitem__)] -= 1
    return widths


def _wrapped(cell: str, width: int) -> list[str]:
    """Return a cell in lines of at most so many columns, broken at spaces, or within a word that is longer."""
    lines = [""]
    for word in cell.split():
        longer = f"{lines[-1]} {word}".lstrip()
        if text_width(longer) <= width:
            lines[-1] = longer
            continue
        if lines[-1]:
            lines.append("")
        for letter in word:
            if text_width(lines[-1] + letter) > width:
                lines.append("")
            lines[-1] += letter
    return lines


def _row_lines(cells: Sequence[str], widths: Sequence[int], numeric: Sequence[bool], gap: str) -> list[str]:
    """Return the lines of a row of a table, numbers to the right: several where a cell is wider than its column."""
    wrapped = [
        _wrapped(cell, width) if text_width(cell) > width else [cell] for cell, width in zip(cells, widths, strict=True)
    ]
    lines = []
    for parts in zip_longest(*wrapped, fillvalue=""):
        spaces = [" " * (width - text_width(part)) for part, width in zip(parts, widths, strict=True)]
        columns = zip(parts, spaces, numeric, strict=True)
        lines.append(gap.join(space + part if right else part + space for part, space, right in columns))
    return lines


def text_width(shown: str) -> int:
    """Return how many columns of a terminal a text takes: two for a wide letter, none for an accent of its own."""
    if shown.isascii():
        return len(shown)
    return sum(0 if combining(letter) else 1 + (east_asian_width(letter) in "WF") for letter in shown)


def _shows_bold() -> bool:
    """Return whether the terminal can be expected to know the code for bold type (ECMA-48, 8.3.117)."""
    return sys.platform != "win32" and os.environ.get("TERM") not in (None, "", "dumb", "unknown")


def text(value: object) -> str:
    """Return a message in words, a number to six significant digits, ∞ for an infinite one, a dash for None."""
    if value is None:
        return "–"
    if isinstance(value, float):
        return ("−∞" if value < 0 else "∞") if isinf(value) else f"{value + 0.0:.6g}"
    return value.text(COMMAND_LINE) if isinstance(value, Message) else printable(str(value))


def warn(message: Message | None) -> None:
    """Print a warning on standard error, apart from the results."""
    if message:
        print(f"warning: {text(message)}", file=sys.stderr)


@contextmanager
def percent_line() -> Iterator[Callable[[float], None]]:
    """Give what is told the share done, from 0 to 1, and shows it on a terminal in one line, which goes at last.

    It is on standard error: per cent, and the seconds left once the pace is known. Elsewhere, as in a log, it is
    another line every EVERY seconds.
    """
    terminal, begun = sys.stderr.isatty(), perf_counter()
    last = begun

    def tell(share: float) -> None:
        nonlocal last
        now = perf_counter()
        left = seconds_left(share, now - begun)
        line = f"{100 * share:3.0f} %" + ("" if left is None else f", {left} s left")
        if terminal:
            print(f"\r{line:{LINE}}", end="", file=sys.stderr, flush=True)
        elif now - last > EVERY:
            last = now
            print(line.strip(), file=sys.stderr, flush=True)

    try:
        yield tell
    finally:
        if terminal:
            print(f"\r{'':{LINE}}\r", end="", file=sys.stderr, flush=True)


def field_text(source: Source) -> str:
    """Return the angle of a field, or both of one beside the plane of x = 0, in degrees."""
    if not source.azimuth_deg:
        return f"{source.field_deg:.6g}°"
    x, y = source.field_xy_deg
    return f"({x:.6g}°, {y:.6g}°)"


def heading(setup: Setup) -> str:
    """Return one line that says which lens and which source a table is about."""
    lens, source = setup.prescription, setup.source
    depth = f"{text(source.depth_mm)} mm" if not isinf(source.depth_mm) else "∞"
    place = f"object at {depth}, field {field_text(source)}, {source.wavelength_um * 1000:.7g} nm"
    turned = f", {text(lens.positions.words)}" if lens.positions else ""
    moved = ", tilted, decentred or not of revolution" if setup.lens.misaligned else ""
    return f"{lens.title or lens.name}{turned}{moved}: {place}"
