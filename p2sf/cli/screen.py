"""What commands print: tables with units for people, one JSON object for programs, warnings on standard error."""

import json
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from math import isinf
from time import perf_counter
from typing import Any

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
WIDE = 240  # columns of a page that no terminal limits


def print_json(value: Mapping[str, Any]) -> None:
    """Print one JSON object; infinite numbers become null."""
    print(json.dumps(plain(value), allow_nan=False))


def print_table(title: str, columns: tuple[str, ...], rows: Sequence[Row]) -> None:
    """Print a table, with rules and colours only on a terminal; numbers to six digits, columns of them to the right."""
    from rich import box
    from rich.console import Console
    from rich.table import Table

    terminal = sys.stdout.isatty()
    console = Console(file=sys.stdout, width=None if terminal else WIDE, highlight=False)
    style = box.SIMPLE_HEAD if terminal else None
    table = Table(box=style, pad_edge=False)
    for number, name in enumerate(columns):
        numeric = any(isinstance(row[number], int | float) for row in rows)
        table.add_column(name, justify="right" if numeric else "left")
    for row in rows:
        table.add_row(*map(text, row))
    with console.capture() as page:
        console.print(printable(title), style="bold", markup=False)
        console.print(table)
    sys.stdout.write(page.get())  # printed by the console itself, a closed pipe would exit with a code of rich's choice


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
