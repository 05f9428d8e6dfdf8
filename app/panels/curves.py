"""What the panels of curves have in common: a plot, coloured curves, a legend, still axes."""

import numpy as np
import pyqtgraph as pg

from app.card import Card
from app.plots import plot_widget, restyle_plot
from app.theme import Tokens


class CurvesPanel:
    """A card with named curves; ``curves`` maps a name to (colour token, line width)."""

    def __init__(self, title: str, tip: str, axes: tuple[str, str], curves: dict[str, tuple[str, int]]):
        self.widget = Card(title, tip)
        self.plot = plot_widget(*axes)
        self.zero = pg.InfiniteLine(0, angle=0)
        self.plot.addItem(self.zero)
        self.curves = {name: pg.PlotCurveItem() for name in curves}
        self._looks, self._range = curves, None
        for curve in self.curves.values():
            curve.setSegmentedLineMode("on")
            self.plot.addItem(curve)
        self.widget.set_body(self.plot)

    def show_curves(self, x: np.ndarray, curves: dict[str, np.ndarray]) -> None:
        """Show curves over common positions."""
        for name, values in curves.items():
            self.curves[name].setData(x, values)

    def set_range(self, x: tuple[float, float], y: tuple[float, float]) -> None:
        """Show these ranges; nothing is laid out again while they stay."""
        if (x, y) != self._range:
            self._range = (x, y)
            self.plot.setRange(xRange=x, yRange=y, padding=0)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        restyle_plot(self.plot, theme)
        self.zero.setPen(pg.mkPen(theme.line, width=1))
        for name, (token, width) in self._looks.items():
            self.curves[name].setPen(pg.mkPen(getattr(theme, token), width=width))
        self.widget.set_readout(self.legend(theme))

    def legend(self, theme: Tokens) -> str:
        """Return the curves' names in their colours."""
        marks = (
            f'<span style="color:{getattr(theme, token)}">━</span> {name}' for name, (token, _) in self._looks.items()
        )
        return " &nbsp; ".join(marks)
