"""The spot diagram: where exact rays meet the sensor."""

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPainter, QPen, QResizeEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from p2sf.figures.spot import Spot
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.painting import polygon
from p2sf_explorer.charts.reading import Reading, closest, point_reading
from p2sf_explorer.charts.theme import SPACE, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.rays import figures, landing_points
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.terms import FILLED
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.chart_card import TurningRow
from p2sf_explorer.widgets.readout import FactTable

TIP = "Spot diagram: where exact rays, evenly spread over the pupil, meet the sensor; no diffraction."
SPOT_AXES = ("x, µm", "y, µm")
AXIS_PX = 60  # pixels of the axis and its label beside the square


class SpotChart(Chart):
    """Points over a square, about as wide as high."""

    def __init__(self) -> None:
        super().__init__("x, µm from the chief ray", "y, µm", aspect=True)
        self.airy = self.add_curve("chief", 2)
        self.points = np.zeros((0, 2))

    def show_points(self, points: np.ndarray) -> None:
        """Show (rays, 2) x and y in µm."""
        self.points = points
        self.update()

    def rows_of_data(self) -> list[list[str]]:
        """Return the points as rows: x and y in µm."""
        return [[*self.labels], *([f"{x:.9g}", f"{y:.9g}"] for x, y in self.points)] if len(self.points) else []

    def read(self, x: float, y: float, snap: bool = True) -> Reading | None:
        """Return the ray that lands nearest."""
        number = closest(self.points, np.array([x, y]), self.pixel_size())
        if number is None:
            return None
        landed_x, landed_y = self.points[number].tolist()
        return point_reading(landed_x, landed_y, SPOT_AXES, "marginal", tr("ray"))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the chart about square."""
        self.setMaximumWidth(max(200, event.size().height() + self.theme.px(AXIS_PX)))
        super().resizeEvent(event)

    def paint_over(self, painter: QPainter) -> None:
        """Paint the points."""
        pen = QPen(QColor(self.theme.marginal), 3 * self.theme.scale)
        pen.setCapStyle(Qt.PenCapStyle.RoundCap)
        painter.setPen(pen)
        painter.drawPoints(polygon(*self.to_pixels(*self.points.T)))


class SpotPanel:
    """Points with the Airy circle for scale, and figures beside them."""

    def __init__(self, store: Store):
        self.widget = Card("Spot", TIP)
        self.chart, self.facts = SpotChart(), FactTable()
        figures, column = QWidget(self.widget), QVBoxLayout()
        figures.setLayout(column)
        column.setContentsMargins(SPACE, 0, SPACE, 0)
        column.addWidget(self.facts)
        column.addStretch(1)
        self.widget.set_body(TurningRow((self.chart, figures), (5, 2), self.widget))

    def show(self, live: Live) -> None:
        """Paint the points."""
        spot: Spot = live.views["spot"].found
        points = landing_points(spot)
        self.chart.show_points(points)
        turn = np.linspace(0, 2 * np.pi, 73)
        self.chart.airy.set_data(live.airy_radius_um * np.cos(turn), live.airy_radius_um * np.sin(turn))
        farthest = max(float(np.abs(points).max()), 2 * live.airy_radius_um)
        self.chart.set_range((-farthest, farthest), (-farthest, farthest), steady="xy")
        self.facts.show_rows(figures(spot, live.airy_radius_um, live.state.optics.clip))
        self.widget.set_readout(tr(FILLED[live.setup.lens.aim]))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)
        self.facts.restyle(theme)
