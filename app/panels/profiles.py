"""Sections of the PSF along x and y through the chief ray."""

import pyqtgraph as pg

from app.card import Card
from app.compute import Live
from app.plots import plot_widget, restyle_plot
from app.store import Store
from app.theme import Tokens

TIP = "Sections of the PSF through the chief ray, over its own peak; grey: the Airy pattern (2J₁(v)/v)²."


class ProfilesPanel:
    """Two curves and the Airy pattern."""

    def __init__(self, store: Store):
        self.widget = Card("PSF profiles", TIP)
        self.plot = plot_widget("distance from the chief ray, µm", "of the peak")
        self.airy, self.x, self.y = (pg.PlotCurveItem() for _ in range(3))
        for curve in (self.airy, self.x, self.y):
            curve.setSegmentedLineMode("on")
            self.plot.addItem(curve)
        self.plot.setYRange(0, 1.03, padding=0)
        self.widget.set_body(self.plot)
        self._half = 0.0

    def show(self, live: Live) -> None:
        """Paint the sections."""
        view = live.views["profiles"]
        for curve, values in ((self.airy, view.airy), (self.x, view.along_x), (self.y, view.along_y)):
            curve.setData(view.position_um, values)
        half = -float(view.position_um[0])
        if half != self._half:
            self._half = half
            self.plot.setXRange(-half, half, padding=0)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        restyle_plot(self.plot, theme)
        self.airy.setPen(pg.mkPen(theme.muted, width=1))
        self.x.setPen(pg.mkPen(theme.marginal, width=2))
        self.y.setPen(pg.mkPen(theme.chief, width=2))
        self.widget.set_readout(legend(theme))


def legend(theme: Tokens) -> str:
    """Return the curves' names in their colours."""
    names = ((theme.marginal, "along x"), (theme.chief, "along y"), (theme.muted, "Airy"))
    return " &nbsp; ".join(f'<span style="color:{colour}">━</span> {name}' for colour, name in names)
