"""From slider to painted window: ``python -m tests.benchmarks.slider [--split] [--quick] [--misaligned]``.

A slider is dragged back and forth with the PSF on the stage, at 1440×900 and at 3840×2160, by the method *seidel* and
by the one that *auto* chooses, for several lenses; then with the 3 × 3 matrix of PSFs on the stage. Printed are the
median and the 95th percentile of a frame in CPU time: of the window's own thread, which is how long a person waits on
an idle machine, and of the whole process. CPU time depends little on what else the machine does; its speed does, so
that versions are compared in turns (``tests.benchmarks.versions``). ``--misaligned`` drags a
misaligned Double Gauss, and errors of its build. ``--split`` drags a second time with a clock in
every part, which costs some 0.3 ms itself, and prints what each part takes on average.
"""

import argparse
import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")  # before Qt is imported

import sys
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from importlib import import_module
from math import pi, sin
from statistics import median, quantiles
from time import perf_counter, process_time, sleep, thread_time
from typing import Any

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QApplication, QWidget
from threadpoolctl import threadpool_limits

from p2sf_explorer.charts.theme import screen_scale
from p2sf_explorer.compute.quantities import RING_QUANTITIES
from p2sf_explorer.compute.setup import prescription, ranges, with_lens
from p2sf_explorer.state.build_errors import with_error
from p2sf_explorer.state.state import State, change, new_state
from p2sf_explorer.state.workspaces import WORKSPACES, with_workspace
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.window import window as shell
from p2sf_explorer.window.window import MainWindow

SIZES = (1440, 900), (3840, 2160)
METHODS = "seidel", "auto"
LENSES = "double_gauss_28", "cooke_triplet", "achromat_f6", "wide_angle_35", "eye_navarro"
SLIDERS = "field_deg", "depth_mm", "wavelength_nm", "sensor_shift_um", "f_number"
ASKED = {(1440, 900): (10, 16), (3840, 2160): (16, 25)}  # ms: median, 95th percentile
MISALIGNED = (("tilt_x", 1, 2, 0.1), ("decentre_y", 3, 5, 0.1), ("decentre_x", 7, 9, 0.05))
ASKED_MISALIGNED = 16  # ms
MATRIX_MS, MATRIX_SLIDERS = 33, ("f_number", "sensor_shift_um")
LEAST_MS = 0.02  # of a part that is printed
LONGEST_S = 10.0  # for which a settled picture is waited for
FIRST, FRAMES, SWING = 10, 100, 37  # frames that do not count, frames that do, frames to and fro
PARTS = {  # what is timed by ``--split``: the name that calls it, and what it is
    "p2sf_explorer.compute.live:paraxial_setup": "compute: first order",
    "p2sf_explorer.compute.live:layout_of": "compute: layout's rays",
    "p2sf_explorer.compute.live:render_state": "compute: method and window",
    "p2sf.psf.geometric:pencil": "compute: aiming and tracing",
    "p2sf.psf.geometric:main_reach_um": "compute: ray density",
    "p2sf.psf.geometric:geometric_psf": "compute: ray density",
    "p2sf_explorer.compute.method:choice_for_state": "compute: choice",
    "p2sf_explorer.compute.preview:pencil": "compute: aiming and tracing",
    "p2sf_explorer.compute.preview:best_fit": "compute: fit",
    "p2sf_explorer.compute.method:best_fit": "compute: fit",
    "p2sf_explorer.compute.preview:psf_of_pupil": "compute: sum of waves",
    "p2sf_explorer.compute.preview:seidel_psf": "compute: sum of waves",
    "p2sf_explorer.compute.method:preview_pupil": "compute: pupil",
    "p2sf_explorer.compute.live:pupil_of": "compute: pupil",
    "p2sf_explorer.compute.live:dominant": "compute: headline",
    "p2sf_explorer.compute.live:warnings": "compute: warnings",
    "p2sf_explorer.compute.matrix.pictures:pencil": "compute: aiming and tracing",
    "p2sf_explorer.compute.matrix.pictures:preview_psf": "matrix: sum of waves",
    "p2sf_explorer.compute.matrix.pictures:too_coarse": "matrix: fit",
    "p2sf_explorer.compute.matrix.pictures:radius_figure": "matrix: figures",
    "p2sf_explorer.compute.matrix.pictures:paraxial_setup": "compute: first order",
}


class Clock:
    """CPU time by part, each without the parts within it, ms."""

    def __init__(self) -> None:
        self.running = self.watching = False
        self.spent: dict[str, float] = defaultdict(float)
        self._inside: list[float] = []

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        """Lay the time of a block to a part."""
        begun = thread_time()
        self._inside.append(0.0)
        try:
            yield
        finally:
            whole = 1e3 * (thread_time() - begun)
            own = whole - self._inside.pop()
            self.spent[name] += own if self.running else 0.0
            if self._inside:
                self._inside[-1] += whole

    def timed(self, work: Callable[..., Any], name: Callable[..., str]) -> Callable[..., Any]:
        """Return a function with its time laid to a part, whose name follows from its arguments."""

        @wraps(work)
        def clocked(*arguments: Any, **named: Any) -> Any:
            with self.part(name(*arguments)):
                return work(*arguments, **named)

        return clocked

    def watch(self) -> None:
        """Put the clock into the parts of the program, for good; before the first window, whose methods Qt keeps."""
        self.watching = True
        for place, name in PARTS.items():
            module, _, function = place.partition(":")
            owner = import_module(module)
            setattr(owner, function, self.timed(getattr(owner, function), lambda *_, name=name: name))
        live = import_module("p2sf_explorer.compute.live")
        live.try_view = self.timed(live.try_view, lambda view, answer: f"results: {view.__module__.split('.')[-1]}")
        shell.paint = self.timed(shell.paint, lambda panel, key, answer: f"panels: {key}")
        for kind in set(kinds(QWidget)):
            if "paintEvent" in vars(kind) and kind.__module__.startswith("p2sf_explorer"):
                kind.paintEvent = self.timed(kind.paintEvent, lambda widget, event: f"painting: {owner_of(widget)}")


def kinds(base: type) -> Iterator[type]:
    """Yield the classes derived from one."""
    for kind in base.__subclasses__():
        yield kind
        yield from kinds(kind)


def owner_of(widget: QWidget) -> str:
    """Return the panel that a widget belongs to, or what it is."""
    part: QWidget | None = widget
    while part is not None:
        if isinstance(part, Card) and part.key:
            return part.key
        part = part.parentWidget()
    return type(widget).__name__.lower()


def dragged(window: MainWindow, key: str, clock: Clock) -> list[tuple[float, float]]:
    """Return the CPU times of frames of a drag, ms: of the window's thread, of the whole process."""
    slider, store, spent = window.controls.rows[key].slider, window.store, []
    low, high = slider.minimum(), slider.maximum()
    store.begin()
    for number in range(FIRST + FRAMES):
        place = 0.5 + 0.45 * sin(2 * pi * number / SWING)
        clock.running = number >= FIRST
        begun = thread_time(), process_time()
        with clock.part("Qt: layouts, other widgets, composing"):
            with clock.part("window: store, bars, sliders"):
                slider.setValue(round(low + place * (high - low)))
            QApplication.processEvents()
        spent.append((1e3 * (thread_time() - begun[0]), 1e3 * (process_time() - begun[1])))
    clock.running = False
    store.end()
    wait(window)
    return spent[FIRST:]


def wait(window: MainWindow) -> None:
    """Wait for what is computed in the background once a slider rests: it is no part of the next frames."""
    until = perf_counter() + LONGEST_S
    while window.is_busy() and perf_counter() < until:
        QApplication.processEvents()
        sleep(0.01)


def opened(state: State, size: tuple[int, int]) -> MainWindow:
    """Return a window of a size, its first pictures painted."""
    window = MainWindow(change(state, scale_percent=100 * screen_scale(QSize(*size))), measured=False)
    window.resize(*size)
    window.show()
    for _ in range(5):
        QApplication.processEvents()
    return window


def summary(frames: list[tuple[float, float]]) -> tuple[float, float, float]:
    """Return median and 95th percentile of the window's thread, and the median of the process, ms."""
    own, whole = zip(*frames, strict=True)
    return median(own), quantiles(own, n=20)[-1], median(whole)


def measure(title: str, state: State, size: tuple[int, int], keys: tuple[str, ...], clock: Clock) -> list[float]:
    """Print the frames of each slider, and the parts of all; return the times of the window's thread."""
    window, gathered = opened(state, size), []
    clock.spent.clear()
    for key in keys:
        frames = dragged(window, key, clock)
        gathered += frames
        middle, late, whole = summary(frames)
        print(f"{title} {key:16} median {middle:5.1f}  95 % {late:5.1f}  process {whole:5.1f} ms", flush=True)
    window.close()
    if clock.watching:
        show_parts(clock, len(gathered))
    return [own for own, _ in gathered]


def show_parts(clock: Clock, frames: int) -> None:
    """Print what each part takes of a frame."""
    for name, spent in sorted(clock.spent.items(), key=lambda item: -item[1]):
        if spent > LEAST_MS * frames:
            print(f"    {spent / frames:6.2f} ms  {name}")


def stages(options: argparse.Namespace, lenses: tuple[str, ...], clock: Clock) -> None:
    """Drag with the PSF on the stage."""
    for size in SIZES[:1] if options.quick else SIZES:
        for method in options.method or METHODS:
            together: list[float] = []
            for lens in lenses:
                state = with_lens(new_state(theme="light", method=method), lens)
                title = f"{size[0]}×{size[1]} {method:6} {lens:16}"
                rings = tuple(q.key for q in RING_QUANTITIES if q.there(ranges(prescription(state))))
                keys = (*rings, *SLIDERS)
                together += measure(title, state, size, keys[:1] if options.quick else keys, clock)
            found, asked = (median(together), quantiles(together, n=20)[-1]), ASKED[size]
            print(f"{size[0]}×{size[1]} {method}: median and 95 % {found[0]:.1f} and {found[1]:.1f} ms, asked {asked}")


def misaligned(clock: Clock) -> None:
    """Drag a misaligned Double Gauss: the sliders of the source, then the decentre of an element."""
    state = with_lens(new_state(theme="light", errors=MISALIGNED), LENSES[0])
    state, size, found = change(state, errors=MISALIGNED), SIZES[0], []
    found += measure("misaligned", state, size, ("field_deg", "field_x_deg", "depth_mm", "f_number"), clock)
    window, spent = opened(state, size), []
    clock.spent.clear()
    window.store.begin()
    for number in range(FIRST + FRAMES):
        clock.running = number >= FIRST
        amount = 0.1 * sin(2 * pi * number / SWING) + 1e-3
        errors = with_error(MISALIGNED, "decentre_y", (3, 5), amount)
        begun = thread_time(), process_time()
        with clock.part("Qt: layouts, other widgets, composing"):
            with clock.part("window: store, bars, sliders"):
                window.store.update(errors=errors)
            QApplication.processEvents()
        spent.append((1e3 * (thread_time() - begun[0]), 1e3 * (process_time() - begun[1])))
    window.store.end()
    wait(window)
    window.close()
    middle, late, whole = summary(spent[FIRST:])
    print(f"misaligned decentre_y       median {middle:5.1f}  95 % {late:5.1f}  process {whole:5.1f} ms")
    if clock.watching:
        show_parts(clock, FRAMES)
    print(f"misaligned sliders of the source: median {median(found):.1f} ms, asked {ASKED_MISALIGNED}", flush=True)


def matrices(lenses: tuple[str, ...], clock: Clock) -> None:
    """Drag with the 3 × 3 matrix of PSFs of 128² on the stage, as the workspace *Inspect* has it."""
    for lens in lenses:
        state = with_workspace(new_state(theme="light", method="auto"), "inspect", WORKSPACES["inspect"])
        found = measure(f"matrix {lens:16}", with_lens(state, lens), SIZES[0], MATRIX_SLIDERS, clock)
        print(f"matrix {lens}: median {median(found):.1f} ms, asked {MATRIX_MS}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--split", action="store_true", help="print what each part takes")
    parser.add_argument("--quick", action="store_true", help="one lens, one slider, the small window")
    parser.add_argument("--misaligned", action="store_true", help="a misaligned Double Gauss alone")
    parser.add_argument("--lens", action="append", help="this lens alone; may be given several times")
    parser.add_argument("--method", choices=METHODS, action="append", help="this method alone")
    parser.add_argument("--only", choices=("stage", "matrix"), help="the PSF on the stage, or the matrix, alone")
    options = parser.parse_args()
    application = QApplication([])
    application.setStyle("Fusion")
    clock = Clock()
    lenses = tuple(options.lens or (LENSES[:1] if options.quick else LENSES))
    with threadpool_limits(1):
        if options.split:
            MainWindow(new_state(), measured=False).close()  # imports what paints
            clock.watch()
        if options.misaligned:
            misaligned(clock)
            return
        if options.only != "matrix":
            stages(options, lenses, clock)
        if options.only != "stage":
            matrices(lenses, clock)


if __name__ == "__main__":
    main()
    sys.stdout.flush()
    os._exit(0)  # Qt's own end takes seconds
