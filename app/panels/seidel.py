"""What each surface adds to each coefficient, as bars beside one another."""

import numpy as np
import pyqtgraph as pg

from app.card import Card, chooser
from app.compute import Live
from app.plots import plot_widget, restyle_plot
from app.pupil import WORDS
from app.scales import nice, signed
from app.store import Store
from app.theme import Tokens

TIP = "Seidel contributions: what each surface adds to a coefficient, in waves; large ones of opposite sign cancel."
TERMS = ("w40", "w31", "w22", "w20", "w11")


class SeidelPanel:
    """One bar per surface for the chosen coefficient, and their sum at the right."""

    def __init__(self, store: Store):
        self.widget = Card("Seidel per surface", TIP)
        self.term = chooser(tuple((t, f"W{t[1:]} {WORDS[t]}") for t in TERMS), "Which coefficient", self.widget)
        self.term.activated.connect(self._again)
        self.widget.add_tool(self.term)
        self.plot = plot_widget("surface", "waves")
        self.bars = pg.BarGraphItem(x=[0], height=[0], width=0.6)
        self.zero = pg.InfiniteLine(0, angle=0)
        self.plot.addItem(self.zero)
        self.plot.addItem(self.bars)
        self.widget.set_body(self.plot)
        self._live: Live | None = None
        self._theme: Tokens | None = None

    def show(self, live: Live) -> None:
        """Paint the bars of the chosen coefficient."""
        self._live = live
        view, term = live.views["seidel"], self.term.currentData()
        heights = np.append(view.waves[term], view.waves[term].sum())
        places = np.append(np.arange(1, heights.size), heights.size + 0.5)
        colours = [self._theme.positive if h >= 0 else self._theme.negative for h in heights]
        self.bars.setOpts(x=places, height=heights, width=0.62, brushes=colours, pen=None)
        names = [(k, f"{k} stop" if k == view.stop_surface else str(k)) for k in range(1, heights.size)]
        self.plot.getPlotItem().getAxis("bottom").setTicks([[*names, (places[-1], "sum")]])
        limit = nice(max(0.1, float(np.abs(heights).max())))
        self.plot.setRange(xRange=(0.3, places[-1] + 0.7), yRange=(-limit, limit), padding=0)
        self.widget.set_readout(f"sum {signed(float(heights[-1]), 3)} λ")

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        restyle_plot(self.plot, theme)
        self.zero.setPen(pg.mkPen(theme.line))
        self._again()

    def _again(self) -> None:
        if self._live:
            self.show(self._live)
