"""Longitudinal colour: the focus of each wavelength on the axis."""

from math import inf

from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.quantities import C_NM, D_NM, F_NM
from p2sf_explorer.compute.views.chromatic import Chromatic
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import with_sign
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.chart_card import NotedChart, legend, reach

TIP = (
    "Longitudinal chromatic shift: how far behind the sensor rays of each colour cross the axis: paraxial rays, and "
    "exact rays from 0.7 and from the rim of the pupil. Within the band, ±n′λ/(2NA²), diffraction hides it."
)
LOOKS = {"paraxial": "text", "0.7 of the pupil": "marginal", "rim": "chief"}
LINES = ((F_NM, "F"), (D_NM, "d"), (C_NM, "C"))


class ChromaticPanel:
    """Three curves over the spectrum, the depth of focus, and the present wavelength."""

    def __init__(self, store: Store):
        self.widget = Card("Chromatic shift", TIP)
        self.chart = NotedChart("wavelength, nm", "focus, µm")
        self.band = [self.chart.add_curve("line") for _ in range(2)]
        self.curves = {name: self.chart.add_curve(token, 1 if token == "text" else 2) for name, token in LOOKS.items()}
        for name, curve in self.curves.items():
            curve.name = tr(name)
        self.widget.set_body(self.chart)
        self._theme = LIGHT

    def show(self, live: Live) -> None:
        """Paint the curves."""
        view: Chromatic = live.views["chromatic"].found
        for curve, shift in zip(self.curves.values(), view.shift_um, strict=True):
            curve.set_data(view.wavelength_nm, shift)
        ends = view.wavelength_nm[[0, -1]]
        for side, curve in zip((-1, 1), self.band, strict=True):
            curve.set_data(ends, (side * view.depth_of_focus_um,) * 2)
        low, high = reach(view.shift_um, least=1.0)
        self.chart.set_range((float(ends[0]), float(ends[1])), (low, high), steady="y")
        here = live.state.optics.wavelength_nm
        names = [(nm, inf, name, "muted", 0) for nm, name in LINES if ends[0] <= nm <= ends[1]]
        self.chart.show_notes(names, ((here, "muted"),))
        self._say(view)

    def _say(self, view: Chromatic) -> None:
        paraxial = view.shift_um[0]
        spread = with_sign(float(paraxial.max() - paraxial.min()), 1)
        shift = tr("{shift} µm over the spectrum", shift=spread)
        depth = tr("±{half} µm depth of focus", half=f"{view.depth_of_focus_um:.3g}")
        self.widget.set_readout(f"{legend(LOOKS, self._theme)} &nbsp; {shift} · {depth}")

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.chart.restyle(theme)
