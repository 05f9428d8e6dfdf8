"""The modulation transfer function of the PSF on screen."""

from app.compute import Live
from app.panels.curves import CurvesPanel
from app.panels.differences import signed_range
from app.scales import nice
from app.store import Store

TIP = "MTF: contrast left of a sine pattern, |FT of the PSF|; grey: a perfect lens, (2/π)(acos ν − ν√(1−ν²))."
LOOKS = {"perfect lens": ("muted", 1), "sagittal": ("marginal", 2), "tangential": ("chief", 2)}


class MtfPanel(CurvesPanel):
    """Tangential and sagittal contrast and the diffraction limit."""

    def __init__(self, store: Store):
        super().__init__("MTF", TIP, ("cycles per mm on the sensor", "contrast"), LOOKS)

    def show(self, live: Live) -> None:
        """Paint the contrasts."""
        view = live.views["mtf"]
        curves = {"perfect lens": view.perfect, "sagittal": view.sagittal, "tangential": view.tangential}
        self.show_curves(view.frequency_per_mm, curves)
        last = nice(float(view.frequency_per_mm[-1]), (1, 1.5, 2, 3, 4, 5, 6, 8))
        self.set_range((0.0, last), signed_range(live, curves, (0.0, 1.04)))
        self.show_side(live.side)
