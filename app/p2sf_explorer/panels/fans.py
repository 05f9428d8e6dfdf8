"""Ray fan and OPD fan: exact rays along the two axes of the pupil."""

import numpy as np

from p2sf.figures.fans import Fan
from p2sf_explorer.compute.live import Live
from p2sf_explorer.state.terms import PLACES
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.curves import CurvesPanel

LOOKS = {"sagittal, along ξ": ("marginal", 2), "tangential, along η": ("chief", 2)}
SMALLEST = 1e-3  # µm or waves at the end of the axis
RAY_TIP = "Ray fan: how far an exact ray lands from the chief ray, against its place in the pupil."
OPD_TIP = "OPD fan: (optical path of the chief ray − that of the ray)/λ for exact rays, including tilt."


class FanPanel(CurvesPanel):
    """A quantity along the two axes of the pupil, about zero; the axis names the pupil that the rays fill."""

    def __init__(self, key: str, title: str, tip: str, unit: str):
        super().__init__(title, tip, (PLACES["paraxial"], unit), LOOKS)
        self._key, self._unit = key, unit

    def show(self, live: Live) -> None:
        """Paint the fan; lost and clipped rays leave gaps."""
        fan: Fan = live.views[self._key].found
        lines = (np.asarray(fan.sagittal), np.asarray(fan.tangential))
        self.chart.name_axes(PLACES[live.setup.lens.aim], self._unit)
        self.show_curves(fan.pupil, dict(zip(LOOKS, lines, strict=True)))
        both = np.abs(np.concatenate(lines))
        peak = float(np.nanmax(both)) if np.isfinite(both).any() else 0.0
        limit = max(peak, SMALLEST)
        self.set_range((-1.02, 1.02), (-limit, limit), steady="y")


class RayFanPanel(FanPanel):
    """Transverse ray errors in µm."""

    def __init__(self, store: Store):
        super().__init__("ray_fan", "Ray fan", RAY_TIP, "landing point, µm")


class OpdFanPanel(FanPanel):
    """Optical path differences in waves."""

    def __init__(self, store: Store):
        super().__init__("opd_fan", "OPD fan", OPD_TIP, "OPD, waves")
