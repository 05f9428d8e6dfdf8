"""The point spread function on the sensor, in µm about the chief ray."""

import numpy as np

from p2sf.messages import Message
from p2sf.psf.result import Psf
from p2sf_explorer.charts.brightness import DECADES, stretched
from p2sf_explorer.charts.plots import BRIGHTNESS, HeatMap
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import significant, written_r_squared
from p2sf_explorer.state.state import State
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, chooser, select
from p2sf_explorer.widgets.differences import show_signed
from p2sf_explorer.widgets.readout import Readout

PSF_MAP = BRIGHTNESS
METHOD_WORDS = {"geometric": "geometric: ray density, no diffraction"}
SHORT_WORDS = {"geometric": "ray density"}
QUALITIES = ("preview", "settled")
WHITE = "#ffffff"  # on the dark ground of the map in both themes
ARROW = np.array([[0.86, 0.86, 0.83, 0.86, 0.89], [0.74, 0.92, 0.84, 0.92, 0.84]])
Y_LABELS = {1: "y, µm (towards the field)", -1: "y, µm (towards the axis)"}  # by the sign of the image height
TIP = "Point spread function: the light of one point source on the sensor, |FT{P}|² of the pupil P = A·exp(i2πW)."
SCALES = (("linear", "linear"), ("sqrt", "square root"), ("log", "log"))
UNITS = (("peak", "peak = 1"), ("sum", "sum = 1"), ("strehl", "Strehl"))


class PsfPanel:
    """A heat map with the Airy circle, an arrow towards the field, and a badge with method and time."""

    def __init__(self, store: Store):
        self.widget = Card("PSF", TIP)
        self.scale = chooser(SCALES, "Brightness scale", self.widget)
        self.units = chooser(UNITS, "Units of the colour bar", self.widget)
        self.scale.activated.connect(lambda: store.update(psf_scale=self.scale.currentData()))
        self.units.activated.connect(lambda: store.update(psf_units=self.units.currentData()))
        self.widget.add_tool(self.scale)
        self.widget.add_tool(self.units)
        self.map = HeatMap("x, µm", Y_LABELS[1], self.widget)
        self.map.set_map(PSF_MAP)
        self.airy, self.arrow = (self.map.chart.add_curve(WHITE, width, 210) for width in (1, 2))
        self.badge = Readout(self.widget, pill=True, colour="text")
        self.widget.set_body(self.map)
        self.widget.add_footer(self.badge)
        self._half = self._airy = 0.0
        self._r_squared: float | None = None
        self._times: dict[str, str] = {}

    def show(self, live: Live) -> None:
        """Paint the PSF."""
        psf, state = live.psf, live.state
        select(self.scale, state.display.psf_scale)
        select(self.units, state.display.psf_units)
        count, step = psf.values.shape[-1], psf.pixel_um
        start = -(count // 2 + 0.5) * step
        peak = float(psf.values.max()) or 1.0
        rect = (start, start, count * step, count * step)
        if live.difference:
            show_signed(self.map, live.difference.psf, rect, state.display.psf_scale, "of peak")
        else:
            self.map.set_map(PSF_MAP)
            self.map.show_values(stretched(psf.values / peak, state.display.psf_scale), (0.0, 1.0), rect)
            self.map.means(psf.values * (top_value(state, psf, peak) / peak), QUANTITIES[state.display.psf_units])
            self.map.bar.show_scale(PSF_MAP, UNIT_WORDS[state.display.psf_units], labels(state, psf, peak))
        self.airy.token = self.arrow.token = "muted" if live.difference else WHITE
        self._frame(count * step / 2, live)
        self.show_badge(live, self._r_squared, not live.setup.altered)

    def _frame(self, half: float, live: Live) -> None:
        if half != self._half:
            self._half = half
            self.map.set_extent(half)
        if live.airy_radius_um != self._airy:
            self._airy = live.airy_radius_um
            turn = np.linspace(0, 2 * np.pi, 73)
            self.airy.set_data(self._airy * np.cos(turn), self._airy * np.sin(turn))
        side = int(np.sign(live.setup.coefficients.image_height))
        self.map.chart.name_axes("x, µm", Y_LABELS[side or 1])
        shown = half if side else np.nan
        self.arrow.set_data(shown * ARROW[0], shown * side * ARROW[1])

    def show_badge(self, live: Live, r_squared: float | None, stale: bool) -> None:
        """Show method, times and measured R² against the Huygens sum; grey while that is of an earlier picture.

        The times are the last ones of a preview, while a slider moves, and of a settled picture.
        """
        self._r_squared = r_squared
        psf = live.psf
        if live.difference:
            largest = significant(100 * float(np.abs(live.difference.psf).max()), 3)
            self.badge.set_text(tr("A − B · at most {share} % of the higher peak", share=largest), "text")
            return
        self._times[live.quality] = significant(1e3 * psf.seconds, 2)
        measured = None if live.setup.altered or psf.method == "geometric" else r_squared
        times = {name: self._times[name] for name in QUALITIES if name in self._times}
        whole, short = badge_words(live, times, measured)
        self.badge.set_text(whole, "muted" if stale else "text", short)
        values = {"numbers": psf.numbers, "rays": psf.rays, "words": psf.sampling}
        sampling = said(Message("{numbers} numbers, {rays} rays; sampling: {words}", **values))
        self.badge.setToolTip(f"{whole}\n{sampling}")

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.map.restyle(theme)
        self.badge.restyle(theme)


def badge_words(live: Live, times: dict[str, str], r_squared: float | None) -> tuple[str, str]:
    """Return how the picture was made, whole, and short where there is little room."""
    before = tuple(filter(None, (live.side, tr("what-if") if live.setup.altered else "")))
    method, r2 = live.psf.method, "" if r_squared is None else written_r_squared(r_squared)
    whole = (*before, tr(METHOD_WORDS.get(method, method)), times_words(times))
    short = (*before, tr(SHORT_WORDS.get(method, method)), f"{'/'.join(times.values())} ms")
    if r2:
        whole, short = (*whole, tr("R² {r} vs Huygens", r=r2)), (*short, f"R² {r2}")
    return " · ".join(whole), " · ".join(short)


def times_words(times: dict[str, str]) -> str:
    """Return the milliseconds of preview and settled picture, of which there is at least one."""
    if len(times) == len(QUALITIES):
        return tr("preview {fast} / settled {ms} ms", fast=times["preview"], ms=times["settled"])
    if "preview" in times:
        return tr("preview {ms} ms", ms=times["preview"])
    return tr("settled {ms} ms", ms=times["settled"])


UNIT_WORDS = {"peak": "peak = 1", "sum": "per pixel", "strehl": "Strehl"}
QUANTITIES = {"peak": "PSF, peak = 1", "sum": "PSF, sum = 1", "strehl": "PSF, perfect peak = 1"}


def decade(top: float, decades: int) -> str:
    """Return ``top``·10^−decades as it is usually written."""
    if top == 1.0 and decades:
        return "10⁻" + "⁰¹²³⁴⁵⁶⁷⁸⁹"[decades]
    return f"{top * 10.0**-decades:.2g}".replace("e-0", "e−")


def top_value(state: State, psf: Psf, peak: float) -> float:
    """Return the brightest sample in the chosen units."""
    return {"peak": 1.0, "sum": peak, "strehl": float(np.asarray(psf.strehl))}[state.display.psf_units]


def labels(state: State, psf: Psf, peak: float) -> tuple[tuple[float, str], ...]:
    """Return the colour bar's labels: parts of the bar and the value there in the chosen units."""
    top = top_value(state, psf, peak)
    if state.display.psf_scale == "log":
        return tuple((1 - k / DECADES, decade(top, k)) for k in range(DECADES + 1))
    power = 2 if state.display.psf_scale == "sqrt" else 1
    return tuple((part, f"{top * part**power:.2g}") for part in (0.0, 0.25, 0.5, 0.75, 1.0))
