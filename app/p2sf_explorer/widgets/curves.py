"""The base of the panels of curves: a chart, coloured curves, a legend, axes that stay."""

import numpy as np

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.chart_card import NotedChart, legend

ENDLESS = (-1e9, 1e9)
SAME_PUPIL, CLEAR_PUPIL = "perfect, same pupil", "perfect, clear pupil"  # names of curves behind a mask


class CurvesPanel:
    """A card with named curves; ``curves`` maps an English name to (colour token, line width)."""

    def __init__(self, title: str, tip: str, axes: tuple[str, str], curves: dict[str, tuple[str, int]]):
        self.widget = Card(title, tip)
        self.chart = NotedChart(*axes)
        self.zero = self.chart.add_curve("line")
        self.curves = {name: self.chart.add_curve(token, width) for name, (token, width) in curves.items()}
        for name, curve in self.curves.items():
            curve.name = tr(name)
        self._looks = curves
        self.widget.set_body(self.chart)

    def show_curves(self, x: np.ndarray, curves: dict[str, np.ndarray]) -> None:
        """Show curves over common positions."""
        for name, values in curves.items():
            self.curves[name].set_data(x, values)
        self.chart.update()

    def set_range(self, x: tuple[float, float], y: tuple[float, float], steady: str = "") -> None:
        """Show these ranges, those of ``steady`` axes in coarse steps, with a line at zero."""
        self.chart.set_range(x, y, steady)
        self.zero.set_data(ENDLESS, (0.0, 0.0))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)
        self.widget.set_readout(self.legend(theme))

    def legend(self, theme: Tokens) -> str:
        """Return the curves' names in their colours."""
        return legend({name: token for name, (token, _) in self._looks.items()}, theme)
