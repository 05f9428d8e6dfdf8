"""What the window takes where it has most to do: ``python -m tests.benchmarks.hard_states [steps|lenses]``.

``steps``: the field slider of the fast Double Gauss, by tenths of a degree where its blur is widest, with the first
workspace and with the MTF on the stage; held, and let go after every step. Printed is the CPU time of the window's own
thread: of a step, and of the longest piece of work until all answers have come, during which nothing else is painted.
``lenses``: every shipped lens is opened in turn, and the peak of memory is printed as it grows.
"""

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")  # before Qt is imported

import resource
import sys
from collections.abc import Callable
from functools import partial
from statistics import median
from time import perf_counter, sleep, thread_time

import numpy as np
from PySide6.QtWidgets import QApplication

from p2sf.lensfile.library import shipped_lenses
from p2sf.threads import one_blas_thread
from p2sf_explorer.compute.setup import with_lens
from p2sf_explorer.state.state import State, change, new_state
from p2sf_explorer.state.workspaces import on_stage
from p2sf_explorer.widgets.slider import STEPS
from p2sf_explorer.window.quantity_rows import QuantityRow
from p2sf_explorer.window.window import MainWindow

LENS, RANGES_DEG, STEP_DEG = "fast_gauss_f14", ((12.0, 16.0), (27.0, 30.0)), 0.1
MOST_MS, MOST_MB = 50.0, 1000.0
LONGEST_S = 60.0  # for which answers are waited for
RUSAGE_MB = 2**10 if sys.platform == "linux" else 2**20  # of the peak that the system states


def spent(work: Callable[[], object]) -> float:
    """Return the CPU time of this thread that some work takes, ms."""
    begun = thread_time()
    work()
    return 1e3 * (thread_time() - begun)


def until_idle(window: MainWindow) -> float:
    """Wait until nothing is computed any more; return the longest piece of work of the window's thread, ms."""
    until, longest, idle = perf_counter() + LONGEST_S, 0.0, 0
    while idle < 3 and perf_counter() < until:  # answers may ask for others
        longest = max(longest, spent(QApplication.processEvents))
        idle = 0 if window.is_busy() else idle + 1
        sleep(0.01)
    return longest


def opened(state: State) -> MainWindow:
    """Return the window with its first pictures."""
    window = MainWindow(state)
    window.show()
    until_idle(window)
    return window


def step_to(row: QuantityRow, field_deg: float) -> None:
    """Move the handle, and paint."""
    row.slider.setValue(round(STEPS * row._scale.travel(field_deg)))
    QApplication.processEvents()


def held(row: QuantityRow, fields: np.ndarray) -> list[float]:
    """Return the time of each step of a drag."""
    row.slider.setSliderDown(True)
    times = [spent(partial(step_to, row, field)) for field in fields]
    row.slider.setSliderDown(False)
    return times


def let_go(window: MainWindow, row: QuantityRow, fields: np.ndarray) -> list[float]:
    """Return the longest piece of work of each step after which the handle is let go."""
    times = []
    for field in fields:
        row.slider.setSliderDown(True)
        step_to(row, field)
        times.append(max(spent(partial(row.slider.setSliderDown, False)), until_idle(window)))
    return times


def steps() -> None:
    """Print how long steps of the field take."""
    first = with_lens(new_state(theme="light"), LENS)
    for title, state in (("first workspace", first), ("MTF on stage", change(first, **on_stage(first.display, "mtf")))):
        window = opened(state)
        row = window.controls.rows["field_deg"]
        for low, high in RANGES_DEG:
            fields = np.arange(low, high + STEP_DEG / 2, STEP_DEG)
            show(f"{title}, {low:g} to {high:g}°, held", fields, held(row, fields))
            until_idle(window)
            show(f"{title}, {low:g} to {high:g}°, let go", fields, let_go(window, row, fields - STEP_DEG / 2))
        window.close()


def show(title: str, fields: np.ndarray, times: list[float]) -> None:
    """Print a line on the times of some fields."""
    worst, above = int(np.argmax(times)), sum(time > MOST_MS for time in times)
    where = f"largest {times[worst]:.0f} ms at {fields[worst]:.1f}°"
    print(f"{title}: median {median(times):.0f}, {where}; {above} of {len(times)} above {MOST_MS:g} ms", flush=True)


def lenses() -> None:
    """Print the peak of memory while lenses are opened, one after another."""
    window = opened(new_state(theme="light"))
    for name in shipped_lenses():
        opening = spent(partial(window.store.replace, with_lens(window.store.state, name)))
        longest = max(opening, until_idle(window))
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / RUSAGE_MB
        print(f"{name:22} {longest:6.0f} ms at a time, peak {peak:5.0f} MB", flush=True)
    print(f"peak {peak:.0f} MB, at most {MOST_MB:g}")
    window.close()


def main(names: list[str]) -> None:
    """Run both, or the one that is named."""
    QApplication([]).setStyle("Fusion")
    with one_blas_thread:
        for name, run in (("steps", steps), ("lenses", lenses)):
            if not names or name in names:
                run()


if __name__ == "__main__":
    main(sys.argv[1:])
    sys.stdout.flush()
    os._exit(0)  # Qt's own end takes seconds
