"""The spot diagram: where exact rays meet the sensor."""

import numpy as np
import pyqtgraph as pg

from app.card import Card
from app.compute import Live
from app.plots import plot_widget, restyle_plot
from app.scales import nice, signed, significant
from app.store import Store
from app.theme import Tokens

TIP = "Spot diagram: where exact rays, evenly spread over the entrance pupil, meet the sensor; no diffraction."


class SpotPanel:
    """Points, the Airy circle for scale, RMS radius and centroid."""

    def __init__(self, store: Store):
        self.widget = Card("Spot diagram", TIP)
        self.plot = plot_widget("x, µm from the chief ray", "y, µm", aspect=True)
        self.points = pg.ScatterPlotItem(size=4, pen=None)
        self.airy = pg.PlotCurveItem()
        self.plot.addItem(self.airy)
        self.plot.addItem(self.points)
        self.widget.set_body(self.plot)
        self._half = 0.0

    def show(self, live: Live) -> None:
        """Paint the points."""
        spot = live.views["spot"]
        kept = np.isfinite(spot.x_um) & np.isfinite(spot.y_um)
        self.points.setData(spot.x_um[kept], spot.y_um[kept])
        turn = np.linspace(0, 2 * np.pi, 73)
        self.airy.setData(live.airy_radius_um * np.cos(turn), live.airy_radius_um * np.sin(turn))
        reach = max(np.abs(spot.x_um[kept]).max(), np.abs(spot.y_um[kept]).max(), 2 * live.airy_radius_um)
        half = nice(1.1 * float(reach), (1, 1.5, 2, 3, 4, 5, 6, 8))
        if half != self._half:
            self._half = half
            self.plot.setRange(xRange=(-half, half), yRange=(-half, half), padding=0)
        rms, centre = significant(float(spot.rms_um), 3), signed(float(spot.centroid_y_um), 2)
        self.widget.set_readout(
            f"RMS radius {rms} µm · centroid y {centre} µm · circle: Airy {live.airy_radius_um:.2f} µm"
        )

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        restyle_plot(self.plot, theme)
        self.points.setBrush(pg.mkBrush(theme.marginal))
        self.airy.setPen(pg.mkPen(theme.chief, width=1.5))
