"""Sections of the PSF along x and y through the chief ray, and its encircled energy."""

from PySide6.QtWidgets import QHBoxLayout, QWidget

from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.theme import SPACE, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.results.profiles import ProfileCurves
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.curves import CurvesPanel
from p2sf_explorer.widgets.differences import signed_range

TIP = (
    "Left: sections of the PSF through the chief ray, over its own peak; grey: the Airy pattern (2J₁(v)/v)². Right: "
    "encircled energy, the share of the window's light within a radius of its centroid; grey: a perfect lens."
)
LOOKS = {"Airy": ("muted", 1), "along x": ("marginal", 2), "along y": ("chief", 2)}


class ProfilesPanel(CurvesPanel):
    """Two sections and the Airy pattern; beside them the energy within a radius."""

    def __init__(self, store: Store):
        super().__init__("PSF profiles", TIP, ("distance from the chief ray, µm", "share of the peak"), LOOKS)
        self.energy = Chart("radius, µm", "energy within")
        self.perfect, self.within = self.energy.add_curve("muted"), self.energy.add_curve("third", 2)
        both = QWidget(self.widget)
        row = QHBoxLayout(both)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(2 * SPACE)
        row.addWidget(self.chart, 5)
        row.addWidget(self.energy, 3)
        self.widget.set_body(both)

    def show(self, live: Live) -> None:
        """Paint the sections and the energy."""
        view: ProfileCurves = live.views["profiles"]
        curves = {"Airy": view.airy, "along x": view.along_x, "along y": view.along_y}
        self.show_curves(view.position_um, curves)
        half = -float(view.position_um[0])
        self.set_range((-half, half), signed_range(live, curves, (0.0, 1.04)))
        outward = view.position_um >= 0
        self.perfect.set_data(view.position_um[outward], view.perfect_energy[outward])
        self.within.set_data(view.position_um[outward], view.energy[outward])
        self.energy.set_range((0.0, half), signed_range(live, {"energy": view.energy}, (0.0, 1.04)))
        self.energy.update()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.energy.restyle(theme)
        super().restyle(theme)
