"""The colour PSF: the image of a point of a chosen spectrum, in the colours of a screen."""

from dataclasses import replace

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QPainter

from p2sf.conventions import NM_PER_UM
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.reading import Reading, Samples, value_of
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.finer import is_coarse
from p2sf_explorer.compute.framing import frame_of, light_circle
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.colour import CHOICES, ColourQuestion, Colours, answer, pixels, smooth_colours
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import with_sign
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import chooser, select
from p2sf_explorer.widgets.chart_card import ChartsCard
from p2sf_explorer.widgets.value_edit import ValueEdit

TIP = (
    "Colour PSF: one PSF for each wavelength, where its own chief ray lands, weighted by the spectrum and the CIE "
    "1931 observer, as linear sRGB. Beside or below: the luminance of the spectrum, and where each colour's chief "
    "ray lands."
)
SPECTRUM_TIP = "The point's spectrum; or type planck:4300 (kelvin) or lines:486,656 (nm)"


class SpectrumChart(Chart):
    """Bars of luminance in their colours, and a curve of lateral colour over the same wavelengths."""

    def __init__(self) -> None:
        super().__init__("wavelength, nm", "chief ray, µm")
        self.shift = self.add_curve("text", 2, name="chief ray")
        self.colours: Colours | None = None

    def show_colours(self, colours: Colours) -> None:
        """Show the spectrum of an answer."""
        self.colours = colours
        nm, shift = NM_PER_UM * colours.psf.wavelengths_um, colours.psf.shift_um
        order = np.argsort(nm)
        self.shift.set_data(nm[order], shift[order])
        largest = max(1.0, float(np.abs(shift).max()))
        low, high = min(400.0, float(colours.wavelength_nm.min())), max(700.0, float(colours.wavelength_nm.max()))
        self.set_range((low, high), (-1.15 * largest, 1.15 * largest), steady="y")
        self.update()

    def read(self, x: float, y: float, snap: bool = True) -> Reading | None:
        """Return where the chief ray lands, and the luminance of the spectrum's nearest part."""
        reading, shown = super().read(x, y, snap), self.colours
        if reading is None or shown is None:
            return reading
        number = int(np.abs(shown.wavelength_nm - x).argmin())
        named = value_of(
            tr("luminance"), float(shown.luminance[number] / shown.luminance.max()), tr("luminance, peak = 1")
        )
        at = tr("at {wavelength} nm", wavelength=f"{shown.wavelength_nm[number]:.1f}")
        return replace(reading, values=(*reading.values, replace(named, text=f"{named.text} {at}")))

    def paint_over(self, painter: QPainter) -> None:
        """Paint the bars along the bottom."""
        if not self.colours:
            return
        shown = self.colours
        top = float(shown.luminance.max())
        wide = self.area.width() / 58
        for nm, light, hue in zip(shown.wavelength_nm, shown.luminance, shown.hues, strict=True):
            x, tall = float(self.to_pixels(nm, 0.0)[0]), 0.4 * self.area.height() * light / top
            box = QRectF(x - wide / 2, self.area.bottom() - tall, wide, tall)
            painter.fillRect(box, QColor.fromRgbF(*map(float, hue)))


BLACK = 0xFF000000
EMPTY_NM = (400.0, 700.0)  # the range of the axis before there is a spectrum


class ColourPanel:
    """The picture and its spectrum; filled in the background."""

    def __init__(self, store: Store):
        self._store = store
        self.picture = Chart("x, µm", "y, µm", aspect=True)
        self.picture.ground, self.picture.smooth = BLACK, True
        self._airy_um = 0.0
        self.spectrum = SpectrumChart()
        self.airy = self.picture.add_curve("#ffffff", 1, 150)
        self.spectrum.set_range(EMPTY_NM, (-1.0, 1.0))
        self.widget = ChartsCard("Colour", TIP, (self.picture, self.spectrum), (3, 4))
        self.choice = chooser((*CHOICES, ("", "typed")), SPECTRUM_TIP, self.widget)
        self.typed = ValueEdit(self.widget)
        self.typed.setProperty("wide", True)
        self.typed.setToolTip(tr(SPECTRUM_TIP))
        self.typed.setAccessibleName(tr("Spectrum"))
        self.widget.add_tool(self.choice)
        self.widget.add_tool(self.typed)
        self.choice.activated.connect(self._choose)
        self.typed.committed.connect(self._type)
        self.late = LateAnswers(self.widget, answer, self._paint, self.widget.set_readout)
        self.found: tuple[ColourQuestion, Colours] | None = None
        self._scale = "sqrt"

    def show(self, live: Live) -> None:
        """Ask for the picture of the present point."""
        name, scale = live.state.display.spectrum, live.state.display.psf_scale
        select(self.choice, name if self.choice.findData(name) >= 0 else "")
        self.typed.set_text(name)
        turn = np.linspace(0, 2 * np.pi, 73)
        self.airy.set_data(live.airy_radius_um * np.cos(turn), live.airy_radius_um * np.sin(turn))
        changed, self._scale = scale != self._scale, scale
        self._airy_um = live.airy_radius_um
        self.late.follow(live.views["colour"])
        if changed:
            self.late.again()

    def _paint(self, asked: ColourQuestion, found: Colours) -> str:
        self.found = asked, found
        count, step = asked.window
        start = -(count // 2 + 0.5) * step
        rect, luminance = (start, start, count * step, count * step), found.psf.xyz[..., 1]
        seen = Samples(luminance / (float(luminance.max()) or 1.0), rect, tr("luminance, peak = 1"))
        self.picture.show_pixels(
            pixels(smooth_colours(found.psf, is_coarse(step, self._airy_um)), self._scale), rect, seen
        )
        frame = frame_of(light_circle(luminance, step, self._airy_um))
        self.picture.set_view((frame.x_um, frame.y_um), frame.half_um)
        self.spectrum.show_colours(found)
        spread = float(np.ptp(found.psf.shift_um))
        count_said = tr("{count} wavelengths", count=len(found.psf.wavelengths_um))
        lateral = tr("lateral colour {shift} µm", shift=with_sign(spread, 2))
        return f"{count_said} · {lateral} · {1e3 * found.psf.seconds:.0f} ms"

    def _choose(self) -> None:
        if self.choice.currentData():
            self._store.update(spectrum=self.choice.currentData())

    def _type(self, text: str) -> None:
        self._store.update(spectrum=text.strip().lower())
        self.typed.set_text(self._store.state.display.spectrum)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        for chart in (self.picture, self.spectrum):
            chart.restyle(theme)
