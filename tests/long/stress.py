"""Stress test of the explorer: random Qt events by the thousand, and their cost in memory, time and errors.

``python -m tests.long.stress [minutes] [events] [seed]`` (60 minutes or 200 000 events unless told, whichever ends
first) prints a line a minute, a verdict and how many events there were of each kind (`tests.support.windows.monkey`);
exit code 1 when something broke, memory grew by 5 % or more, or one event held the window for 250 ms of CPU. CI runs
two minutes of it, in which memory and time are printed and not judged (`JUDGED`).
"""

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import random
import sys
import tempfile
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from itertools import cycle
from pathlib import Path
from time import perf_counter
from traceback import format_exception
from unittest.mock import patch

import numpy as np
from PySide6.QtCore import QtMsgType, qInstallMessageHandler
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog
from threadpoolctl import threadpool_limits

from p2sf_explorer.state.state import new_state
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.window.memory_trim import REST_MS
from p2sf_explorer.window.window import MainWindow
from tests.support.lenses.lens_files import FILES, FOLDER
from tests.support.windows.monkey import STALL_MS, Ledger, Person

RECENT = "p2sf_explorer.files.recent.recent_path"
GROWTH = 0.05
PAUSE_MS = 2 * REST_MS
WARM = 0.5  # the first part opens every panel and lens and fills the caches: not counted as growth
JUDGED = 20.0  # minutes: before, caches fill and panels open for the first time, and CI's machine has its own speed
FIRST = new_state(method="seidel", theme="light")


@dataclass(frozen=True)
class Verdict:
    """What a run found: MB and probe milliseconds after warming up and at the end, errors in words."""

    ledger: Ledger
    seconds: float
    memory: tuple[float, float]
    probe: tuple[float, float]
    errors: tuple[str, ...]

    @property
    def growth(self) -> float:
        return self.memory[1] / self.memory[0] - 1

    def words(self) -> str:
        cost, (worst, name) = np.array(self.ledger.cost), self.ledger.worst
        return (
            f"{cost.size} events in {self.seconds:.0f} s, {len(self.errors)} errors; memory {self.memory[0]:.0f} → "
            f"{self.memory[1]:.0f} MB ({100 * self.growth:+.1f} %); GUI-thread CPU per event: median "
            f"{np.median(cost):.1f}, 99 % {np.percentile(cost, 99):.1f}, worst {worst:.0f} ms ({name}), "
            f"{len(self.ledger.slow)} over {STALL_MS:.0f} ms {self.ledger.slow}; "
            f"first opening of 3D {self.ledger.first_3d:.0f} ms, not counted; "
            f"one and the same drag: {self.probe[0]:.2f} → {self.probe[1]:.2f} ms"
        )


def stress(seconds: float, events: int, seed: int = 0, tell=lambda line: None) -> Verdict:
    """Use a window at random for so many seconds or events, whichever ends first."""
    with tempfile.TemporaryDirectory() as folder, own_files(Path(folder), seed), overheard(tell) as errors:
        window = MainWindow(FIRST)
        window.show()
        person, begun = Person(window, random.Random(seed)), perf_counter()
        warm, minute = None, 0
        while (passed := perf_counter() - begun) < seconds and len(person.ledger.cost) < events:
            if warm is None and max(passed / seconds, len(person.ledger.cost) / events) > WARM:
                warm = look(person)
            if passed // 60 > minute:
                minute = int(passed // 60)
                tell(f"{minute} min, {len(person.ledger.cost)} events, {resident_mb():.0f} MB, {len(errors)} errors")
            person.act()
        last = look(person)
        seconds = perf_counter() - begun
        window.close()
        return Verdict(person.ledger, seconds, *zip(warm or last, last, strict=True), tuple(errors))


def look(person: Person) -> tuple[float, float]:
    """Return the memory, MB, and the probe, ms, with the first lens on show and the window at rest.

    A Huygens sum on show holds 100 MB of rays or more while it is there: two looks compare only with the same on show.
    """
    probe = person.probe()
    person.quiet()
    QTest.qWait(PAUSE_MS)
    return resident_mb(), probe


@contextmanager
def own_files(folder: Path, seed: int):
    """Answer the file dialogs with files of the tests, and keep everything written inside a folder."""
    chance = random.Random(seed)
    saved = cycle(folder / f"shot.{ending}" for ending in ("npz", "png", "json", "tiff", "csv", "toml", "zmx"))

    def open_name(*_):
        known = [FOLDER / name for name in FILES] + [path for path in folder.iterdir() if path.is_file()]
        return str(chance.choice(known)), ""

    with ExitStack() as patches:
        patches.enter_context(patch(RECENT, lambda: folder / "memory" / "recent.json"))
        patches.enter_context(patch.object(QFileDialog, "getOpenFileName", open_name))
        patches.enter_context(patch.object(QFileDialog, "getSaveFileName", lambda *_: (str(next(saved)), "")))
        patches.enter_context(patch.object(Card, "drag_title", lambda card: None))  # it waits for a real drop
        yield


@contextmanager
def overheard(tell):
    """Collect what no caller sees: exceptions in slots, paint events and threads, and Qt's complaints."""
    heard: list[str] = []

    def hear(words: str) -> None:
        if words not in heard:
            tell(words)
        heard.append(words)

    def exception(kind, error, trace):
        hear("".join(format_exception(kind, error, trace)))

    def complaint(kind, context, message):
        # The offscreen platform says of every popup what it cannot do.
        if kind not in (QtMsgType.QtDebugMsg, QtMsgType.QtInfoMsg) and "plugin does not support" not in message:
            hear(f"Qt: {message}")

    before = qInstallMessageHandler(complaint)
    with patch("sys.excepthook", exception), patch("threading.excepthook", lambda told: exception(*told[:3])):
        yield heard
    qInstallMessageHandler(before)


def resident_mb() -> float:
    """Return the memory this process holds, MB."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def main(minutes: float = 60.0, events: int = 200_000, seed: int = 0) -> int:
    application = QApplication(sys.argv[:1])
    application.setStyle("Fusion")
    with threadpool_limits(limits=1):
        found = stress(60 * minutes, events, seed, lambda line: print(line, flush=True))
    print(found.words())
    print(", ".join(f"{name} {count}" for name, count in found.ledger.done.most_common()))
    judged = minutes >= JUDGED and (found.growth >= GROWTH or bool(found.ledger.slow))
    return int(bool(found.errors) or judged)


if __name__ == "__main__":
    sys.exit(main(*(kind(word) for kind, word in zip((float, int, int), sys.argv[1:], strict=False))))
