"""Charts of the window beside pyqtgraph's with the same content: ``python -m tests.benchmarks.charts [--rounds 200]``.

Printed are medians of the CPU time of a frame, new data set and painted, in a window of 1440×900 pixels: a picture of
256² samples with a colour bar, four curves of 200 points, and a hundred polylines of 14 points to scale, as the layout
of a lens has. Axes stay, as while a slider moves, or move with every frame. pyqtgraph is timed as it is and with
antialiasing, which the window's charts have.
"""

import argparse
import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")  # before Qt is imported

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import QApplication, QWidget

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.colour_scale import ColourScale
from p2sf_explorer.charts.plots import HeatMap
from p2sf_explorer.charts.theme import tokens
from tests.benchmarks.timing import timed

SIZE = 1440, 900
SAMPLES, CURVES, POINTS, POLYLINES, CORNERS = 256, 4, 200, 100, 14
FRAMES = 16  # of other data, one after the other
MAP = "CET-L4"
PENS = "#0072b2", "#d55e00", "#009e73", "#444444"


@dataclass(frozen=True)
class Drawn:
    """A widget, and what shows the data of a frame in it with the ends of its axes times a factor."""

    widget: QWidget
    show: Callable[[int, float], None]


def pictures() -> np.ndarray:
    """Return PSF-like pictures, (frame, y, x)."""
    axis = np.linspace(-12.0, 12.0, SAMPLES)
    radius = np.hypot(axis, axis[:, None])
    return np.array([np.sinc(radius / (1 + 0.02 * k)) ** 2 for k in range(FRAMES)])


def curves() -> tuple[np.ndarray, np.ndarray]:
    """Return positions and the values of MTF-like curves, (frame, curve, point)."""
    x = np.linspace(0.0, 1.0, POINTS)
    return x, np.array([[np.sinc(x * (1 + n + 0.05 * k)) for n in range(CURVES)] for k in range(FRAMES)])


def polylines() -> tuple[np.ndarray, np.ndarray]:
    """Return z of the corners, and their heights, (frame, line, corner)."""
    z = np.linspace(0.0, 160.0, CORNERS)
    lines = np.linspace(-40.0, 40.0, POLYLINES)[:, None] * np.cos(z / 60)
    return z, np.array([lines * (1 + 0.002 * k) for k in range(FRAMES)])


def in_one(x: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the same lines as one, with gaps between them, (frame, 1, point)."""
    gaps = np.full((*values.shape[:-1], 1), np.nan)
    return np.tile(np.append(x, np.nan), values.shape[1]), np.concatenate([values, gaps], -1).reshape(FRAMES, 1, -1)


def own_picture() -> Drawn:
    """Return a heat map of the window."""
    data, made = pictures(), HeatMap("x, µm", "y, µm")
    made.restyle(tokens("light"))
    made.chart.smooth = True

    def show(frame: int, wide: float) -> None:
        made.chart.set_range((-12.0 * wide, 12.0 * wide), (-12.0 * wide, 12.0 * wide))
        scale = ColourScale(MAP, 0.0, 1.0, "peak = 1", "PSF", "sqrt", measure="peak", grounded=True)
        made.show_map(data[frame], (-12.0, -12.0, 24.0, 24.0), scale)

    return Drawn(made, show)


def own_lines(x: np.ndarray, values: np.ndarray, x_end: float, y_end: float, aspect: bool) -> Drawn:
    """Return a chart of the window with curves."""
    made = Chart("position", "value", aspect=aspect)
    made.restyle(tokens("light"))
    shown = [made.add_curve(PENS[n % len(PENS)], 1 if aspect else 2) for n in range(values.shape[1])]

    def show(frame: int, wide: float) -> None:
        made.set_range((0.0, x_end * wide), (-y_end * wide, y_end * wide))
        for curve, line in zip(shown, values[frame], strict=True):
            curve.set_data(x, line)
        made.update()

    return Drawn(made, show)


def their_picture() -> Drawn:
    """Return a plot of pyqtgraph with an image and a colour bar."""
    data, made, image = pictures(), pg.PlotWidget(background="w"), pg.ImageItem(axisOrder="row-major")
    made.addItem(image)
    made.setLabels(bottom="x, µm", left="y, µm")
    made.setAspectLocked(True)
    image.setColorMap(pg.colormap.get(MAP))
    image.setImage(data[0], levels=(0.0, 1.0))
    image.setRect(-12.0, -12.0, 24.0, 24.0)
    made.getPlotItem().layout.addItem(pg.ColorBarItem((0.0, 1.0), colorMap=MAP), 2, 5)

    def show(frame: int, wide: float) -> None:
        made.setRange(xRange=(-12.0 * wide, 12.0 * wide), yRange=(-12.0 * wide, 12.0 * wide), padding=0)
        image.setImage(np.sqrt(data[frame]), autoLevels=False)

    return Drawn(made, show)


def their_lines(x: np.ndarray, values: np.ndarray, x_end: float, y_end: float, aspect: bool) -> Drawn:
    """Return a plot of pyqtgraph with curves."""
    made = pg.PlotWidget(background="w")
    made.setLabels(bottom="position", left="value")
    made.setAspectLocked(aspect)
    pens = [pg.mkPen(colour, width=1 if aspect else 2) for colour in PENS]
    shown = [made.plot(pen=pens[n % len(PENS)]) for n in range(values.shape[1])]

    def show(frame: int, wide: float) -> None:
        made.setRange(xRange=(0.0, x_end * wide), yRange=(-y_end * wide, y_end * wide), padding=0)
        for curve, line in zip(shown, values[frame], strict=True):
            curve.setData(x, line, connect="finite")

    return Drawn(made, show)


CONTENTS: dict[str, tuple[Callable[[], Drawn], Callable[[], Drawn]]] = {
    f"picture of {SAMPLES}²": (own_picture, their_picture),
    f"{CURVES} curves of {POINTS}": (
        lambda: own_lines(*curves(), 1.0, 1.0, aspect=False),
        lambda: their_lines(*curves(), 1.0, 1.0, aspect=False),
    ),
    f"{POLYLINES} polylines": (
        lambda: own_lines(*polylines(), 160.0, 45.0, aspect=True),
        lambda: their_lines(*polylines(), 160.0, 45.0, aspect=True),
    ),
    f"{POLYLINES} polylines as one": (
        lambda: own_lines(*in_one(*polylines()), 160.0, 45.0, aspect=True),
        lambda: their_lines(*in_one(*polylines()), 160.0, 45.0, aspect=True),
    ),
}


def frame_ms(app: QApplication, make: Callable[[], Drawn], moving: bool, rounds: int) -> float:
    """Return the median CPU time of a frame, ms."""
    drawn, number = make(), 0
    drawn.widget.resize(*SIZE)
    drawn.widget.show()
    app.processEvents()

    def frame() -> None:
        nonlocal number
        number += 1
        drawn.show(number % FRAMES, 1 + 0.01 * (number % FRAMES) if moving else 1.0)
        app.processEvents()

    found = timed(frame, rounds).cpu_ms
    drawn.widget.close()
    drawn.widget.deleteLater()
    app.processEvents()
    return found


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=200)
    rounds = parser.parse_args().rounds
    app = QApplication([])
    print(f"{'CPU ms of a frame':36}{'ours':>8}{'pyqtgraph':>12}{'antialiased':>13}")
    for name, (own, theirs) in CONTENTS.items():
        for moving in (False, True):
            ours = frame_ms(app, own, moving, rounds)
            pg.setConfigOptions(antialias=False)
            plain = frame_ms(app, theirs, moving, rounds)
            pg.setConfigOptions(antialias=True)
            fine = frame_ms(app, theirs, moving, rounds)
            label = f"{name}, {'axes move' if moving else 'axes stay'}"
            print(f"{label:36}{ours:8.2f}{plain:12.2f}{fine:13.2f}", flush=True)


if __name__ == "__main__":
    main()
