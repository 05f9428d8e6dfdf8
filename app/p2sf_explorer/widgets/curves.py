"""What the panels of curves have in common: a plot, coloured curves, a legend, still axes."""

import numpy as np

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.chart_card import NotedChart


class CurvesPanel:
    """A card with named curves; ``curves`` maps a name to (colour token, line width)."""

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

    def set_range(self, x: tuple[float, float], y: tuple[float, float]) -> None:
        """Show these ranges; nothing is laid out again while they stay."""
        self.chart.set_range(x, y)
        self.zero.set_data(x, (0.0, 0.0))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)
        self.widget.set_readout(self.legend(theme))

    def legend(self, theme: Tokens) -> str:
        """Return the curves' names in their colours."""
        marks = ((getattr(theme, token), tr(name)) for name, (token, _) in self._looks.items())
        return " &nbsp; ".join(f'<span style="color:{colour}">━</span> {name}' for colour, name in marks)
