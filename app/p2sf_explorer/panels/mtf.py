"""The modulation transfer function of the picture's pupil."""

from math import inf

from p2sf.conventions import UM_PER_MM
from p2sf.messages import Message
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.measured import MeasureRequest
from p2sf_explorer.compute.views.mtf import Contrast, answer
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.chart_card import legend
from p2sf_explorer.widgets.curves import CLEAR_PUPIL, SAME_PUPIL, CurvesPanel
from p2sf_explorer.widgets.differences import signed_range
from p2sf_explorer.widgets.value_edit import MicronEdit

TIP = (
    "MTF: the contrast that remains of a sine pattern, computed by autocorrelation of the pupil, from all light. "
    "Grey: the same pupil without aberration. Thin, if something stands in the stop: the clear pupil without "
    "aberration."
)
PIXEL_TIP = "Pixel pitch of the sensor; its Nyquist frequency is 1/(2 pitch)."
LOOKS = {
    "perfect lens": ("muted", 2),
    CLEAR_PUPIL: ("third", 1),
    "sagittal": ("marginal", 2),
    "tangential": ("chief", 2),
}


class MtfPanel(CurvesPanel):
    """Tangential and sagittal contrast and the diffraction limit."""

    def __init__(self, store: Store):
        super().__init__("MTF", TIP, ("frequency on the sensor, 1/mm", "contrast"), LOOKS)
        self.pixel = MicronEdit(store, "pixel_um", "Pixel", PIXEL_TIP, self.widget)
        self.widget.add_tool(self.pixel)
        self.late = LateAnswers(self.widget, answer, self._paint, self._say)
        self._live: Live | None = None
        self._theme: Tokens | None = None
        self._masked = False

    def show(self, live: Live) -> None:
        """Paint the contrasts, or have them computed in the background where they are too slow for a frame."""
        self._live = live
        self._masked = not live.setup.lens.mask.clear
        self.curves["perfect lens"].name = tr(SAME_PUPIL if self._masked else "perfect lens")
        view: View[Contrast | None] = live.views["mtf"]
        self.late.follow(view)
        if view.found:
            self._say(said(self._paint(None, view.found)))

    def _say(self, text: str) -> None:
        marks = self.legend(self._theme) if self._theme else ""
        self.widget.set_readout(f"{marks} &nbsp; {text}")

    def _paint(self, asked: MeasureRequest | None, view: Contrast) -> Message:
        live = self._live
        if live is None:
            return view.method
        curves = {"perfect lens": view.perfect, "sagittal": view.sagittal, "tangential": view.tangential}
        self.curves[CLEAR_PUPIL].set_data(*((view.frequency_per_mm, view.clear) if view.masked else ((), ())))
        self.show_curves(view.frequency_per_mm, curves)
        usual, steady = (0.0, 1.04), "xy" if live.difference else "x"
        self.set_range((0.0, float(view.frequency_per_mm[-1])), signed_range(live, curves, usual), steady)
        self._mark(live.state.display.pixel_um)
        return view.method

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        super().restyle(theme)

    def legend(self, theme: Tokens) -> str:
        """Return the curves' names in their colours: behind a mask the perfect ones say of which pupil they are."""
        looks = {name: token for name, (token, _) in LOOKS.items() if name != CLEAR_PUPIL or self._masked}
        perfect = SAME_PUPIL if self._masked else "perfect lens"
        return legend({perfect if name == "perfect lens" else name: token for name, token in looks.items()}, theme)

    def _mark(self, pixel_um: float) -> None:
        """Mark the sensor's Nyquist frequency, with its name at the upper edge."""
        self.pixel.show_value(pixel_um)
        nyquist = nyquist_per_mm(pixel_um)
        text = " " + tr("Nyquist {f}", f=f"{nyquist:.3g}")
        self.chart.show_notes(((nyquist, inf, text, "text", -1),), ((nyquist, "text"),))


def nyquist_per_mm(pixel_um: float) -> float:
    """Return the highest frequency that pixels of this pitch resolve, 1/(2 pitch), in cycles per mm."""
    return UM_PER_MM / (2 * pixel_um)
