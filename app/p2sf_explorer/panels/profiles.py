"""Sections of the PSF along x and y through the chief ray, and its encircled energy."""

import numpy as np

from p2sf.messages import Message
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.views.profiles import ProfileCurves, answer
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.chart_card import TurningRow
from p2sf_explorer.widgets.curves import CLEAR_PUPIL, SAME_PUPIL, CurvesPanel
from p2sf_explorer.widgets.differences import signed_range

TIP = (
    "Sections of the PSF through the chief ray, relative to its peak; grey: the Airy pattern (2J₁(v)/v)². Beside or "
    "below: encircled energy, the share of all light within a radius of the centroid; grey: a perfect lens. If "
    "something stands in the stop, the perfect lens has the same pupil, and a thin curve is for the clear one. The "
    "RMS radius is that of the rays, since that of diffracted light is infinite."
)
LOOKS = {"Airy": ("muted", 1), "along x": ("marginal", 2), "along y": ("chief", 2)}

DETAILS = "R50 {half} µm; both of all light about its centroid; RMS of the rays {rms} µm; {method}"


class ProfilesPanel(CurvesPanel):
    """Two sections and the Airy pattern; beside them the energy within a radius."""

    def __init__(self, store: Store):
        super().__init__("Profiles", TIP, ("distance from the chief ray, µm", "share of the peak"), LOOKS)
        self.energy = Chart("radius, µm", "energy within")
        self.clear, self.perfect = self.energy.add_curve("muted"), self.energy.add_curve("muted", 2)
        self.within = self.energy.add_curve("third", 2)
        self.clear.name, self.perfect.name, self.within.name = tr(CLEAR_PUPIL), tr("perfect lens"), tr("this lens")
        self.widget.set_body(TurningRow((self.chart, self.energy), (5, 3), self.widget))
        self.late = LateAnswers(self.widget, answer, self._paint, self._say)
        self._live: Live | None = None
        self._legend = self._details = ""

    def show(self, live: Live) -> None:
        """Paint the sections and the energy, which a worker computes where it is too slow for a frame."""
        self._live = live
        view: View[ProfileCurves] = live.views["profiles"]
        self._show_sections(live, view.found)
        self.within.set_data((), ())
        self.energy.update()
        if view.question and live.pending:  # behind the picture, which comes first: each takes half a gigabyte
            self.late.forget()
            self._say(tr("working"))
            return
        self.late.follow(view)
        if view.question is None:
            self._say(said(self._paint(view.found, view.found)))

    def _say(self, text: str) -> None:
        whose = "A: " if self._live and self._live.difference else ""
        self.widget.set_readout(f"{self._legend} &nbsp; {whose}{text}", self._details)

    def _show_sections(self, live: Live, view: ProfileCurves) -> None:
        curves = {"Airy": view.airy, "along x": view.along_x, "along y": view.along_y}
        self.show_curves(view.position_um, curves)
        half = -float(view.position_um[0])
        steady = "xy" if live.difference else "x"
        self.set_range((-half, half), signed_range(live, curves, (0.0, 1.04)), steady)
        masked = not live.setup.lens.mask.clear
        self.perfect.name = tr(SAME_PUPIL if masked else "perfect lens")
        outward = view.position_um >= 0
        self.perfect.set_data(view.position_um[outward], view.perfect_energy[outward])
        self.clear.set_data(*(x[outward] if masked else () for x in (view.position_um, view.clear_energy)))

    def _paint(self, asked: ProfileCurves, view: ProfileCurves) -> Message:
        """Paint the energy, and sections that were rough, and return what it is a share of."""
        if self._live and asked.rough and not view.rough and not self._live.difference:
            self._show_sections(self._live, view)
        if self._live is None or not np.isfinite(view.energy).all():
            return view.method
        outward = view.position_um >= 0
        self.within.set_data(view.position_um[outward], view.energy[outward])
        self.perfect.set_data(view.position_um[outward], view.perfect_energy[outward])
        half = -float(view.position_um[0])
        steady = "xy" if self._live.difference else "x"
        self.energy.set_range((0.0, half), signed_range(self._live, {"energy": view.energy}, (0.0, 1.04)), steady)
        self.energy.update()
        half_light, most, rms = (f"{radius:.3g}" for radius in view.radii_um)
        self._details = said(Message(DETAILS, half=half_light, rms=rms, method=view.method))
        return Message("R80 {most} µm", most=most)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._legend = self.legend(theme)
        self.energy.restyle(theme)
        super().restyle(theme)
