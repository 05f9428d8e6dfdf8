"""The y–ȳ diagram."""

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter

from p2sf.paraxial.ybar import YBar
from p2sf_explorer.charts.painting import write
from p2sf_explorer.charts.reading import Reading, closest, point_reading
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import with_sign
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.chart_card import NotedChart

TIP = (
    "y–ȳ diagram (Delano 1963): marginal ray height against chief ray height at every surface. Where the line crosses "
    "ȳ = 0 is the stop or a pupil, where it crosses y = 0 an image."
)
FAR_LINE = (-1e9, 1e9)  # the axes have no end
FAR = 3.0  # times the largest of the other heights


class YBarChart(NotedChart):
    """A polygon through the surfaces, each with a dot and its number."""

    def __init__(self) -> None:
        super().__init__("chief ray ȳ, mm", "marginal ray y, mm")
        self.over = "path"
        self.axes = [self.add_curve("line") for _ in range(2)]
        self.path = self.add_curve("marginal", 2, name="surfaces in the order of the light")
        self.names: tuple[str, ...] = ()

    def read(self, x: float, y: float, snap: bool = True) -> Reading | None:
        """Return the nearest point, under the name of its surface."""
        points = np.stack([self.path.x, self.path.y], axis=-1)
        number = closest(points, np.array([x, y]), self.pixel_size())
        if number is None:
            return None
        return point_reading(
            float(points[number, 0]), float(points[number, 1]), self.labels, "marginal", self.names[number]
        )

    def paint_over(self, painter: QPainter) -> None:
        """Paint the dots and, above or under them, the names: of neighbours that are close one above, one under."""
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(self.theme.chief))
        px, last, tall = self.theme.px, -np.inf, self.theme.px(16)
        for x, y, name in zip(*self.to_pixels(self.path.x, self.path.y), self.names, strict=True):
            painter.setPen(Qt.PenStyle.NoPen)
            painter.drawEllipse(QPointF(x, y), px(3), px(3))
            under = abs(x - last) < px(24)
            last = -np.inf if under else x
            painter.setPen(QColor(self.theme.muted))
            room = QRectF(x - px(60), y + px(4) if under else y - px(4) - tall, px(120), tall)
            write(painter, room, name, 0, self.theme.tick)


class YBarPanel:
    """The polygon, and a mark at the stop."""

    def __init__(self, store: Store):
        self.widget = Card("y–ȳ", TIP)
        self.chart = YBarChart()
        self.axes, self.path = self.chart.axes, self.chart.path
        self.widget.set_body(self.chart)

    def show(self, live: Live) -> None:
        """Paint the diagram of the present source."""
        view: YBar = live.views["ybar"].found
        self.path.set_data(view.chief_y, view.y)
        self.chart.names = tuple(f"▪{tr(name)}" if k == view.stop else tr(name) for k, name in enumerate(view.names))
        near = slice(int(view.names[0] == "object" and far_off(view)), None)
        self.chart.set_range(span(view.chief_y[near]), span(view.y[near]), steady="xy")
        self.axes[0].set_data(FAR_LINE, (0, 0))
        self.axes[1].set_data((0, 0), FAR_LINE)
        self.chart.update()
        invariant = float(live.setup.rays.invariant) * live.setup.source.field_slope
        if view.axial:
            self.widget.set_readout(tr("the source is on the axis: no chief ray, so the diagram is a line"))
            return
        self.widget.set_readout(f"{tr('Lagrange invariant H = {h} mm', h=with_sign(invariant, 4))} · {tr('stop ▪')}")

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)


def span(values: np.ndarray) -> tuple[float, float]:
    """Return a range with a margin around the values, zero within it."""
    low, high = min(0.0, float(values.min())), max(0.0, float(values.max()))
    air = 0.14 * max(high - low, 1e-6)
    return low - air, high + air


def far_off(view: YBar) -> bool:
    """Return whether the object is so far away that the lens would be small beside it; the line to it is then cut."""
    return bool(abs(view.chief_y[0]) > FAR * np.abs(view.chief_y[1:]).max())
