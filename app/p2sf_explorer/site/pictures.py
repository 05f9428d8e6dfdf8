"""Pictures that the site shows: those that the examples on its pages write, and those of the window."""

import re
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from PySide6.QtWidgets import QApplication

from p2sf_explorer.compute.setup import first_state
from p2sf_explorer.i18n.language import ENGLISH, set_language
from p2sf_explorer.lessons.lesson import shipped_lessons
from p2sf_explorer.site.examples import run_examples
from p2sf_explorer.site.gallery import settle
from p2sf_explorer.state.pinning import pin
from p2sf_explorer.state.state import State, change
from p2sf_explorer.window.window import MainWindow

SIZE = 1280, 800
MADE = re.compile(r"\]\(made/([\w.]+)\)")
FIRST = change(first_state(), theme="light")
CORNER = change(FIRST, field_deg=20.0)
STOPPED = change(CORNER, f_number=8.0)
AXIS = change(FIRST, field_deg=0.0)
WINDOW = {
    "window_first.png": FIRST,
    "window_field.png": CORNER,
    "window_stopped.png": STOPPED,
    "window_compared.png": change(pin(STOPPED), f_number=5.0, shown="difference"),
    "window_misaligned.png": change(AXIS, f_number=5.6, errors=(("decentre_y", 3, 4, 0.2),), tab="misalign"),
    "window_tolerances.png": change(AXIS, stage="tolerances", show_rail=False),
}


def example_pictures(text: str, page: str) -> Iterator[tuple[str, bytes]]:
    """Run a page's examples, and yield the name and content of each picture that they write and the page shows."""
    with TemporaryDirectory() as folder:
        run_examples(text, Path(folder), page)
        for name in MADE.findall(text):
            if name not in WINDOW:
                yield name, (Path(folder) / name).read_bytes()


def lesson_states() -> dict[str, State]:
    """Return the state of each step of each lesson by the name of its picture."""
    return {
        f"{lesson.name}_{number + 1}.png": lesson.state(number, FIRST)
        for lesson in shipped_lessons()
        for number in range(len(lesson.steps))
    }


def window_pictures(states: dict[str, State]) -> Iterator[tuple[str, bytes]]:
    """Yield the name and PNG of the window in each state."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "window.png"
        for name, window in shown_windows(states):
            window.grab().save(str(path))
            yield name, path.read_bytes()


def shown_windows(states: dict[str, State]) -> Iterator[tuple[str, MainWindow]]:
    """Yield each name with the window that shows its state, in English and at rest."""
    _application = QApplication.instance() or QApplication(sys.argv[:1])  # kept: without a reference it would end
    QApplication.setStyle("Fusion")
    set_language(ENGLISH)
    window = MainWindow(FIRST)
    window.resize(*SIZE)
    window.show()
    for name, state in states.items():
        window.store.replace(state)
        settle(window)
        yield name, window
    window.close()
