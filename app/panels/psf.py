"""The point spread function on the sensor, in µm about the chief ray."""

import numpy as np
import pyqtgraph as pg
from PySide6.QtGui import QColor

from app.card import Card, chooser, select
from app.compute import Live
from app.plots import HeatMap
from app.readout import Readout
from app.scales import significant, written_r_squared
from app.store import Store
from app.theme import Tokens

PSF_MAP = "inferno"
DECADES = 5  # what the logarithmic scale shows below the peak
TIP = "Point spread function: the light of one point source on the sensor, |FT{P}|² of the pupil P = A·exp(i2πW)."
SCALES = (("linear", "linear"), ("sqrt", "square root"), ("log", "log"))
UNITS = (("peak", "peak = 1"), ("sum", "sum = 1"), ("strehl", "Strehl"))


class PsfPanel:
    """A heat map with the Airy circle, an arrow towards the field, and a badge that names method and time."""

    def __init__(self, store: Store):
        self.widget = Card("PSF", TIP)
        self.scale = chooser(SCALES, "Brightness scale", self.widget)
        self.units = chooser(UNITS, "Units of the colour bar", self.widget)
        self.scale.activated.connect(lambda: store.update(psf_scale=self.scale.currentData()))
        self.units.activated.connect(lambda: store.update(psf_units=self.units.currentData()))
        self.widget.add_tool(self.scale)
        self.widget.add_tool(self.units)
        self.map = HeatMap("x, µm", "y, µm (towards the field)", self.widget)
        self.map.set_map(PSF_MAP)
        self.airy = pg.PlotCurveItem()
        self.arrow = pg.ArrowItem(angle=90, headLen=12, tipAngle=40, tailLen=14, tailWidth=2, pen=None)
        self.map.plot.addItem(self.airy)
        self.map.plot.addItem(self.arrow)
        self.badge = Readout(self.widget, pill=True, colour="text")
        self.widget.set_body(self.map)
        self.widget.add_footer(self.badge)
        self._half = self._airy = 0.0
        self._r_squared: float | None = None

    def show(self, live: Live) -> None:
        """Paint the PSF."""
        psf, state = live.psf, live.state
        select(self.scale, state.psf_scale)
        select(self.units, state.psf_units)
        count, step = psf.values.shape[-1], psf.pixel_um
        start = -(count // 2 + 0.5) * step
        peak = float(psf.values.max()) or 1.0
        self.map.show_values(
            stretched(psf.values / peak, state.psf_scale), (0.0, 1.0), (start, start, count * step, count * step)
        )
        self.map.bar.show_scale(PSF_MAP, UNIT_WORDS[state.psf_units], labels(state, psf, peak))
        self._frame(count * step / 2, live)
        self.show_badge(live, self._r_squared, True)

    def _frame(self, half: float, live: Live) -> None:
        if half != self._half:
            self._half = half
            self.map.set_extent(half)
        if live.airy_radius_um != self._airy:
            self._airy = live.airy_radius_um
            turn = np.linspace(0, 2 * np.pi, 73)
            self.airy.setData(self._airy * np.cos(turn), self._airy * np.sin(turn))
        slope = live.setting.source.field_slope
        self.arrow.setVisible(slope != 0)
        self.arrow.setPos(0.86 * half, 0.9 * half)

    def show_badge(self, live: Live, r_squared: float | None, stale: bool) -> None:
        """Name method, time and measured R² against the Huygens sum; grey while that is of an earlier picture."""
        self._r_squared = r_squared
        psf = live.psf
        parts = [psf.method, f"{significant(1e3 * psf.seconds, 2)} ms", live.quality]
        if r_squared is not None:
            parts.append(f"R² {written_r_squared(r_squared)} vs Huygens")
        self.badge.set_text(" · ".join(parts), "muted" if stale else "text")
        self.badge.setToolTip(f"{psf.numbers} numbers, {psf.rays} rays; sampling: {psf.sampling}")

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.map.restyle(theme)
        self.badge.restyle(theme)
        self.airy.setPen(pg.mkPen(QColor(255, 255, 255, 200), width=1))
        self.arrow.setStyle(brush=QColor("#ffffff"), pen=None)


UNIT_WORDS = {"peak": "peak = 1", "sum": "per pixel", "strehl": "Strehl"}


def stretched(values: np.ndarray, scale: str) -> np.ndarray:
    """Return brightness 0 to 1 of values 0 to 1 on a scale."""
    if scale == "linear":
        return values
    if scale == "sqrt":
        return np.sqrt(np.maximum(values, 0.0))
    return 1 + np.log10(np.maximum(values, 10.0**-DECADES)) / DECADES


def decade(top: float, decades: int) -> str:
    """Return ``top``·10^−decades as people write it."""
    if top == 1.0 and decades:
        return "10⁻" + "⁰¹²³⁴⁵⁶⁷⁸⁹"[decades]
    return f"{top * 10.0**-decades:.2g}".replace("e-0", "e−")


def labels(state, psf, peak: float) -> tuple[tuple[float, str], ...]:
    """Return the colour bar's labels: parts of the bar and the value there in the chosen units."""
    top = {"peak": 1.0, "sum": peak, "strehl": float(psf.strehl)}[state.psf_units]
    if state.psf_scale == "log":
        return tuple((1 - k / DECADES, decade(top, k)) for k in range(DECADES + 1))
    power = 2 if state.psf_scale == "sqrt" else 1
    return tuple((part, f"{top * part**power:.2g}") for part in (0.0, 0.25, 0.5, 0.75, 1.0))
