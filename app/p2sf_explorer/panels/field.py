"""Field curvature, distortion and the distortion grid."""

import numpy as np

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.field import FieldView
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import with_sign
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.chart_card import ChartsCard, NotedChart, legend, reach

TIP = (
    "Field curvature: where sagittal (S) and tangential (T) rays focus. Distortion: (real − paraxial image "
    "height)/paraxial. Thick: exact rays; fine: third order (W22, W20, W11)."
)
NAMES = {
    "S": "sagittal S",
    "T": "tangential T",
    "third S": "sagittal S, third order",
    "third T": "tangential T, third order",
    "real": "distortion",
    "third": "distortion, third order",
}
LOOKS = {"sagittal S": "marginal", "tangential T": "chief", "present field": "muted"}


class FieldPanel:
    """Focus against field, distortion against field, and a square grid as the lens draws it."""

    def __init__(self, store: Store):
        self.focus = Chart("focus behind the sensor, mm", "field, °")
        self.distortion = Chart("distortion, %", "field, °")
        self.focus.over = self.distortion.over = "left"
        self.grid = NotedChart(aspect=True, framed=False)
        self.grid.over, self.grid.columns = "path", ("x, of the edge", "y, of the edge")
        self.curves = {
            name: chart.add_curve(token, width)
            for name, chart, token, width in (
                ("field", self.focus, "muted", 1),
                ("third S", self.focus, "marginal", 1),
                ("third T", self.focus, "chief", 1),
                ("S", self.focus, "marginal", 2),
                ("T", self.focus, "chief", 2),
                ("field again", self.distortion, "muted", 1),
                ("third", self.distortion, "muted", 1),
                ("real", self.distortion, "positive", 2),
            )
        }
        for name, words in NAMES.items():
            self.curves[name].name = tr(words)
        self.zeros = [chart.add_curve("line") for chart in (self.focus, self.distortion)]
        self.straight, self.bent = self.grid.add_curve("line"), self.grid.add_curve("positive")
        self.widget = ChartsCard("Field curves", TIP, (self.focus, self.distortion, self.grid), (4, 4, 3))
        self._drawn: FieldView | None = None

    def show(self, live: Live) -> None:
        """Paint curves and grid."""
        view: FieldView = live.views["field"].found
        at, top = view.field_deg, float(view.field_deg[-1])
        self._show_focus(view, at, top)
        self._show_distortion(view, at, top)
        for name in ("field", "field again"):
            here = abs(live.state.optics.field_deg)
            self.curves[name].set_data((-1e9, 1e9), (here, here))
        if view is not self._drawn:
            self._drawn = view
            self._show_grid(view, bool(live.difference))

    def _show_focus(self, view: FieldView, at: np.ndarray, top: float) -> None:
        shown = {"S": view.real.sagittal, "T": view.real.tangential}
        for name, values in (*shown.items(), ("third S", view.third.sagittal), ("third T", view.third.tangential)):
            self.curves[name].set_data(values, at)
        self.focus.set_range(reach(*shown.values(), least=1e-3), (0.0, top), steady="x")
        self.zeros[0].set_data((0, 0), (0, top))
        self.focus.update()

    def _show_distortion(self, view: FieldView, at: np.ndarray, top: float) -> None:
        real, third = (100 * part for part in (view.heights.distortion, view.heights.third_order_distortion))
        self.curves["real"].set_data(real, at)
        self.curves["third"].set_data(third, at)
        self.distortion.set_range(reach(real, least=1e-3), (0.0, top), steady="x")
        self.zeros[1].set_data((0, 0), (0, top))
        self.distortion.update()

    def _show_grid(self, view: FieldView, difference: bool) -> None:
        for curve, points in ((self.straight, view.straight), (self.bent, view.bent)):
            curve.set_data(*points.T)
        self.grid.set_range((-0.8, 0.8), (-1.3, 0.8))
        scale = tr("as it is") if view.exaggerated == 1 else tr("drawn {times} times", times=view.exaggerated)
        lines = edge(view, difference), scale  # one below the other: a narrow window has no room for both
        self.grid.show_notes([(0.0, y, line, "muted", 0) for y, line in zip((-0.92, -1.2), lines, strict=True)])

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        for chart in (self.focus, self.distortion, self.grid):
            chart.restyle(theme)
        self.widget.set_readout(legend(LOOKS, theme))


def edge(view: FieldView, difference: bool = False) -> str:
    """Return the distortion at the edge of the field in words, or by how much it differs."""
    known = np.flatnonzero(np.isfinite(view.heights.distortion))[-1]
    share = 100 * float(view.heights.distortion[known])
    values = {"part": f"{with_sign(share, 2)} %", "field": f"{view.field_deg[known]:.3g}°"}
    if difference:
        return tr("A − B {part} at {field}", **values)
    return tr("barrel {part} at {field}", **values) if share < 0 else tr("pincushion {part} at {field}", **values)
