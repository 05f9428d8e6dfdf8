"""The point spread function on the sensor, in µm about the chief ray."""

import numpy as np
from PySide6.QtCore import QTimer

from p2sf.messages import Message
from p2sf.psf.methods import REFERENCE, PsfRequest
from p2sf.psf.prediction import VECTOR_NA
from p2sf.psf.result import Psf
from p2sf_explorer.charts.colour_scale import ColourScale
from p2sf_explorer.charts.plots import BRIGHTNESS, HeatMap
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.brightness import SCALES, UNITS
from p2sf_explorer.compute.deferred_sums import SumCache
from p2sf_explorer.compute.finer import SettledSum, ShownArea, answer, covers, fade, finer, smooth
from p2sf_explorer.compute.framing import ShownSquare, frame_of, light_circle
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.method import at_least
from p2sf_explorer.i18n.messages import WINDOW, said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import significant, written_r_squared
from p2sf_explorer.state.state import State
from p2sf_explorer.state.terms import FILLED
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, chooser
from p2sf_explorer.widgets.differences import show_signed
from p2sf_explorer.widgets.readout import Readout

PSF_MAP = BRIGHTNESS
RESIZED_MS = 200  # after the last change of the panel's size, the picture is summed for its new pixels
NOTHING_FINER = Message("")
METHOD_WORDS = {"geometric": "geometric: ray density, no diffraction"}
SHORT_WORDS = {"geometric": "ray density"}
QUALITIES = ("preview", "settled")
WITHIN = 0.5**0.5  # of a circle's radius: half the side of the square in it
WHITE = "#ffffff"  # on the dark ground of the map in both themes
ARROW = np.array([[0.86, 0.86, 0.83, 0.86, 0.89], [0.74, 0.92, 0.84, 0.92, 0.84]])
Y_LABELS = {1: "y, µm (outwards)", -1: "y, µm (inwards)"}  # by the sign of the image height
R_SQUARED_TIP = (
    "R² compares with the Huygens sum of exact rays, or with spherical waves from the exit pupil where plane ones miss "
    "those by more than 0.001; it is predicted until that sum is done, then measured."
)
VECTOR_TIP = (
    "Above NA {na} light is a vector, and sums of scalar waves miss unpolarised light by more than 1 − R² = 0.001."
)
TIP = "Point spread function: the light of one point source on the sensor, |FT{P}|² of the pupil P = A·exp(i2πW)."


class PsfPanel:
    """A heat map with the Airy circle, an arrow towards the field, and a badge with method and R²."""

    def __init__(self, store: Store):
        self.widget = Card("PSF", TIP)
        self.scale = chooser(SCALES, "Brightness scale", self.widget)
        self.units = chooser(UNITS, "Units of the colour bar", self.widget)
        self.widget.bind(store, psf_scale=self.scale, psf_units=self.units)
        self.widget.add_tool(self.scale)
        self.widget.add_tool(self.units)
        self.widget.quiet.add(self.scale, self.units)
        self.map = HeatMap("x, µm", Y_LABELS[1], self.widget)
        self.map.set_map(PSF_MAP)
        self.airy, self.arrow = (self.map.chart.add_curve(WHITE, width, 210) for width in (1, 2))
        self.badge = Readout(self.widget, pill=True, colour="text")
        self.widget.set_body(self.map)
        self.widget.add_footer(self.badge)
        self.map.chart.smooth = True
        self._airy = 0.0
        self._frame: ShownSquare | None = None
        self._times: dict[str, str] = {}
        self._live: Live | None = None
        self._finer = SumCache()
        self.late = LateAnswers(self.widget, answer, self._take, lambda text: None)
        self._settled = QTimer(self.widget, singleShot=True, interval=RESIZED_MS)
        self._settled.timeout.connect(self._on_resized)
        self.map.resized.connect(self._settled.start)

    @property
    def half_um(self) -> float:
        """Return half the side of the square that is shown whole, µm; 1 before the first picture."""
        return self._frame.half_um if self._frame else 1.0

    def show(self, live: Live) -> None:
        """Paint the PSF about its light, and have it summed again where it is too coarse or does not fill the view."""
        self._live = live
        self.map.chart.bleed(live.state.display.full_bleed)
        self._frame_light(live)
        self.show_badge(live, None)
        self._refine(live)

    def _refine(self, live: Live) -> None:
        """Paint what fits the panel; until that is summed, the samples that are there."""
        wanted = self._finer_request(live)
        self._paint(live, self.psf_shown(live))
        if wanted is None:
            self.late.refuse(NOTHING_FINER)
        elif self._finer.get(wanted) is not None:
            self.late.forget()
        else:
            if wanted != self.late.asked:
                self.late.cancel()  # an earlier lens's sum would keep the panel busy for seconds, and is not painted
            self.late.ask(wanted)

    def psf_shown(self, live: Live) -> Psf:
        """Return the PSF as it is painted: summed again where the first one is too coarse or ends within the view."""
        wanted = self._finer_request(live)
        found = self._finer.get(wanted) if wanted else None
        return found if isinstance(found, Psf) else live.psf

    def _finer_request(self, live: Live) -> PsfRequest | None:
        """Return the sum with a sample for each pixel of the panel; None where the picture is as fine as that."""
        found: SettledSum | None = None if live.difference or "psf" not in live.views else live.views["psf"].found
        return finer(found, self._view, live.airy_radius_um) if found else None

    def _take(self, request: PsfRequest, psf: Psf) -> str:
        """Keep a finer picture, which is not asked for again, and show it if it is that of the present answer."""
        self._finer.keep(request, psf)
        if self._live and request == self._finer_request(self._live):
            self._paint(self._live, psf)
        return ""

    def _on_resized(self) -> None:
        if self._live and self._live.quality == "settled":
            self._refine(self._live)  # the badge keeps the R² that is measured

    def _paint(self, live: Live, psf: Psf) -> None:
        state = live.state
        count, step = psf.values.shape[-1], psf.pixel_um
        start = -(count // 2 + 0.5) * step
        rect = (start, start, count * step, count * step)
        shown = live.difference.psf if live.difference else psf.values
        painted = smooth(shown)
        if not covers(count * step, self._view):
            painted = fade(painted)
        if live.difference:
            show_signed(self.map, shown, rect, state.display.psf_scale, "of peak", painted)
        else:
            peak = float(psf.values.max()) or 1.0
            top = top_value(state, psf, peak)
            # No light between two samples is lost in white. Not in place: fine samples are painted themselves.
            painted = painted * (top / (float(painted.max()) or 1.0))
            self.map.show_map(shown * (top / peak), rect, colour_scale(state, psf, peak), painted)
        self.airy.token = self.arrow.token = "muted" if live.difference else WHITE

    @property
    def _view(self) -> ShownArea:
        return ShownArea(self.map.reach, self.map.device_pixel)

    def _frame_light(self, live: Live) -> None:
        """Show the light large, with the Airy circle and the arrow."""
        light = light_circle(live.psf.values, live.psf.pixel_um, live.airy_radius_um)
        self._frame = frame = frame_of(light, self._frame if live.quality == "preview" else None)
        self.map.chart.kept_clear = light.x_um, light.y_um, light.radius_um * WITHIN
        side = int(np.sign(live.setup.coefficients.image_height))
        self.map.chart.set_view((frame.x_um, frame.y_um), frame.half_um)
        if live.airy_radius_um != self._airy:
            self._airy = live.airy_radius_um
            turn = np.linspace(0, 2 * np.pi, 73)
            self.airy.set_data(self._airy * np.cos(turn), self._airy * np.sin(turn))
        self.map.chart.name_axes("x, µm", Y_LABELS[side or 1])
        (left, right), (low, high) = self.map.chart.x_axis.home, self.map.chart.y_axis.home  # perhaps locked
        shown = (right - left) / 2 if side else np.nan
        self.arrow.set_data((left + right) / 2 + shown * ARROW[0], (low + high) / 2 + shown * side * ARROW[1])

    def show_badge(self, live: Live, r_squared: float | None, reference: str = REFERENCE) -> None:
        """Show method and R² against the ``reference``: measured where it is known, else predicted.

        The tooltip has the last times of a preview, while a slider moves, and of a settled picture. A prediction below
        the R² asked for is a caution.
        """
        psf = live.psf
        if live.difference:
            largest = significant(100 * float(np.abs(live.difference.psf).max()), 3)
            self.badge.set_text(tr("A − B · at most {share} % of the higher peak", share=largest), "text")
            return
        self._times[live.quality] = significant(1e3 * psf.seconds, 2)
        measured = None if live.setup.altered or psf.method == "geometric" else r_squared
        times = {name: self._times[name] for name in QUALITIES if name in self._times}
        whole, short = badge_words(live, measured, reference)
        allowed = 1 - live.state.optics.tolerance
        unsure = (measured is None and (psf.predicted_error or 0.0) > allowed) or vectors_count(live)
        self.badge.set_text(whole, "warning" if unsure else "text", short)
        self.badge.setToolTip("\n".join((f"{whole} · {times_words(times)}", live.why.text(WINDOW), *tip_words(live))))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.map.restyle(theme)
        self.badge.restyle(theme)


def badge_words(live: Live, r_squared: float | None, reference: str = REFERENCE) -> tuple[str, str]:
    """Return how the picture was made, whole, and short where there is little room."""
    before = tuple(filter(None, (live.side, tr("what-if") if live.setup.altered else "")))
    method, r2 = live.psf.method, "" if r_squared is None else written_r_squared(r_squared)
    whole, short = (*before, tr(METHOD_WORDS.get(method, method))), (*before, tr(SHORT_WORDS.get(method, method)))
    if r2:
        plane = reference == REFERENCE
        against = tr("R² {r} vs Huygens", r=r2) if plane else tr("R² {r} vs spherical waves", r=r2)
        whole, short = (*whole, against), (*short, f"R² {r2}")
    elif live.psf.predicted_error is not None:
        words = predicted_words(live.psf.predicted_error)
        whole, short = (*whole, words), (*short, words)
    return " · ".join(whole), " · ".join(short)


def vectors_count(live: Live) -> bool:
    """Return whether rays are so steep that scalar light is not enough."""
    tangent = live.setup.cone.na / abs(float(live.setup.coefficients.image_index))
    return bool(tangent / np.hypot(1, tangent) > VECTOR_NA)


def predicted_words(error: float) -> str:
    """Return the least R² that is predicted, in words."""
    return tr("predicted R² ≥ {r}", r=at_least(1 - error)) if error < 1 else tr("no R² predicted")


def tip_words(live: Live) -> tuple[str, ...]:
    """Return what the badge says under the pointer: prediction, numbers and rays, and how they fill the pupil."""
    psf = live.psf
    values = {"numbers": psf.numbers, "rays": psf.rays, "words": psf.sampling}
    lines = (
        said(Message("{numbers} numbers, {rays} rays; sampling: {words}", **values)),
        tr(R_SQUARED_TIP),
        tr(FILLED[live.setup.lens.aim]),
    )
    known = () if psf.predicted_error is None else (predicted_words(psf.predicted_error),)
    beyond = (tr(VECTOR_TIP, na=f"{VECTOR_NA:.2f}"),) if vectors_count(live) else ()
    return *known, *lines, *beyond


def times_words(times: dict[str, str]) -> str:
    """Return the milliseconds of preview and settled picture, of which there is at least one."""
    if len(times) == len(QUALITIES):
        return tr("preview {fast} / settled {ms} ms", fast=times["preview"], ms=times["settled"])
    if "preview" in times:
        return tr("preview {ms} ms", ms=times["preview"])
    return tr("settled {ms} ms", ms=times["settled"])


UNIT_WORDS = {"peak": "peak = 1", "sum": "per pixel", "strehl": "Strehl"}
QUANTITIES = {"peak": "PSF, peak = 1", "sum": "PSF, sum = 1", "strehl": "PSF, perfect peak = 1"}


def top_value(state: State, psf: Psf, peak: float) -> float:
    """Return the brightest sample in the chosen units."""
    units = unit_of(state, psf)
    if units == "strehl" and (samples := psf.over_unaberrated) is not None:
        return float(samples.max())
    return peak if units == "sum" else 1.0


def unit_of(state: State, psf: Psf) -> str:
    """Return the units of the colour bar: a picture without a Strehl ratio is shown over its peak in its place."""
    units = state.display.psf_units
    return "peak" if units == "strehl" and psf.strehl is None else units


def colour_scale(state: State, psf: Psf, peak: float) -> ColourScale:
    """Return how the picture is coloured: up to its peak, in the chosen units.

    Pictures whose pixels differ are compared by their light per µm², or by their Strehl ratios.
    """
    unit, top = unit_of(state, psf), top_value(state, psf, peak)
    per_area = {"peak": peak, "sum": 1.0, "strehl": psf.pixel_um**2}[unit] / psf.pixel_um**2
    return ColourScale(
        PSF_MAP,
        0.0,
        top,
        unit=UNIT_WORDS[unit],
        quantity=QUANTITIES[unit],
        stretch=state.display.psf_scale,
        measure="strehl" if unit == "strehl" else "light per area",
        absolute=per_area,
        relative=unit == "peak",
        grounded=True,
    )
