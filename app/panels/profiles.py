"""Sections of the PSF along x and y through the chief ray."""

from app.compute import Live
from app.panels.curves import CurvesPanel
from app.panels.differences import signed_range
from app.store import Store

TIP = "Sections of the PSF through the chief ray, over its own peak; grey: the Airy pattern (2J₁(v)/v)²."
LOOKS = {"Airy": ("muted", 1), "along x": ("marginal", 2), "along y": ("chief", 2)}


class ProfilesPanel(CurvesPanel):
    """Two curves and the Airy pattern."""

    def __init__(self, store: Store):
        super().__init__("PSF profiles", TIP, ("distance from the chief ray, µm", "share of the peak"), LOOKS)

    def show(self, live: Live) -> None:
        """Paint the sections."""
        view = live.views["profiles"]
        curves = {"Airy": view.airy, "along x": view.along_x, "along y": view.along_y}
        self.show_curves(view.position_um, curves)
        half = -float(view.position_um[0])
        self.set_range((-half, half), signed_range(live, curves, (0.0, 1.04)))
        self.show_side(live.side)
