"""The y–ȳ diagram."""

import numpy as np

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.results.ybar import YBar, field_free
from p2sf_explorer.state.scales import nice, signed
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.chart_card import NotedChart

TIP = (
    "y–ȳ diagram (Delano 1963): marginal ray height against chief ray height at every surface. Where the line crosses "
    "ȳ = 0 is the stop or a pupil, where it crosses y = 0 an image."
)
FAR = 3.0  # times the largest of the other heights


class YBarPanel:
    """A polygon through the surfaces, each with its number, and a mark at the stop."""

    def __init__(self, store: Store):
        self.widget = Card("y–ȳ diagram", TIP)
        self.chart = NotedChart("chief ray ȳ, mm", "marginal ray y, mm")
        self.axes = [self.chart.add_curve("line") for _ in range(2)]
        self.path = self.chart.add_curve("marginal", 2)
        self.path.name = tr("surfaces in the order of the light")
        self.points = self.chart.add_curve("chief", 2)
        self.widget.set_body(self.chart)

    def show(self, live: Live) -> None:
        """Paint the diagram of the present source."""
        view: YBar = live.views["ybar"]
        self.path.set_data(view.chief_y, view.y)
        near = slice(int(view.names[0] == "object" and far_off(view)), None)
        (left, right), (low, high) = (span(values[near]) for values in (view.chief_y, view.y))
        self.chart.set_range((left, right), (low, high))
        self.axes[0].set_data((left, right), (0, 0))
        self.axes[1].set_data((0, 0), (low, high))
        self._mark(view, (right - left) / 90, (high - low) / 30)
        invariant = float(live.setup.rays.invariant) * live.setup.source.field_slope
        if field_free(view):
            self.widget.set_readout(tr("the source is on the axis: no chief ray, so the diagram is a line"))
            return
        self.widget.set_readout(f"{tr('Lagrange invariant H = {h} mm', h=signed(invariant, 4))} · {tr('stop ▪')}")

    def _mark(self, view: YBar, wide: float, tall: float) -> None:
        notes, last = [], -np.inf
        for k, (x, y, name) in enumerate(zip(view.chief_y, view.y, view.names, strict=True)):
            under = abs(x - last) < 2 * wide  # where the neighbour's name is above
            last = -np.inf if under else x
            text = f"▪{tr(name)}" if k == view.stop else tr(name)
            notes.append((x, y - 2.4 * tall if under else y + 2.4 * tall, text, "muted", 0))
        crosses = [
            np.array([[x - wide / 4, x + wide / 4, np.nan], [y, y, np.nan]])
            for x, y in zip(view.chief_y, view.y, strict=True)
        ]
        self.points.set_data(*np.concatenate(crosses, axis=1))
        self.chart.show_notes(notes)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)


def span(values: np.ndarray) -> tuple[float, float]:
    """Return a range with round ends and a margin around the values, zero within it."""
    low, high = min(0.0, float(values.min())), max(0.0, float(values.max()))
    step = nice(max(high - low, 1e-6) / 8)
    return float(step * np.floor(low / step - 0.3)), float(step * np.ceil(high / step + 0.7))


def far_off(view: YBar) -> bool:
    """Return whether the object is so far away that the lens would be small beside it; the line to it is then cut."""
    return bool(abs(view.chief_y[0]) > FAR * np.abs(view.chief_y[1:]).max())
