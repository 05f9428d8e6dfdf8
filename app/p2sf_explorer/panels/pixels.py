"""The real PSF, that of a perfect lens, and the light on the sensor's pixels, side by side."""

import numpy as np

from p2sf_explorer.charts.colour_scale import ColourScale
from p2sf_explorer.charts.plots import BRIGHTNESS, HeatMap
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.finer import smooth
from p2sf_explorer.compute.framing import frame_of, light_circle
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.pixels import SampledLight
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import significant
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.chart_card import ChartsCard
from p2sf_explorer.widgets.value_edit import MicronEdit

TIP = (
    "The PSF, the Airy pattern of a perfect lens of this aperture (each relative to its own peak), and the PSF "
    "integrated over square pixels, the middle one centred on the chief ray."
)
NAMES = ("this lens, µm", "perfect lens, µm", "on the pixels, µm")
MEANINGS = (("PSF, peak = 1", "peak"), ("PSF, peak = 1", "peak"), ("share of the light in a pixel", "of light"))
PIXEL_TIP = "Pixel pitch of the sensor."


class BesidePanel:
    """Three maps on the same scale of lengths."""

    def __init__(self, store: Store):
        self.maps = tuple(HeatMap(words, "y, µm") for words in NAMES)
        for heat in self.maps:
            heat.set_map(BRIGHTNESS)
            heat.chart.smooth = heat is not self.maps[-1]  # the light on pixels is squares
            heat.chart.columns = "x, µm", "y, µm"
        self.widget = ChartsCard("Perfect lens", TIP, self.maps, (1, 1, 1))
        self.pixel = MicronEdit(store, "pixel_um", "Pixel", PIXEL_TIP, self.widget)
        self.widget.add_tool(self.pixel)

    def show(self, live: Live) -> None:
        """Paint the three maps."""
        view: SampledLight = live.views["beside"].found
        self.pixel.show_value(view.pixel_um)
        frame = frame_of(light_circle(view.real, view.sample_um, live.airy_radius_um))
        shown = ((view.real, view.sample_um), (view.perfect, view.sample_um), (view.pixels, view.pixel_um))
        for heat, (values, step), (means, unit) in zip(self.maps, shown, MEANINGS, strict=True):
            start = -(values.shape[0] // 2 + 0.5) * step
            rect = (start, start, values.shape[0] * step, values.shape[0] * step)
            top = 1.0 if unit == "peak" else float(view.pixels.max()) or 1.0
            scale = ColourScale(
                BRIGHTNESS, 0.0, top, unit, means, live.state.display.psf_scale, measure=means, grounded=True
            )
            heat.show_map(np.asarray(values, float), rect, scale, smooth(values) if unit == "peak" else None)
            heat.chart.set_view((frame.x_um, frame.y_um), frame.half_um)
        self._say(live, view)

    def _say(self, live: Live, view: SampledLight) -> None:
        middle = 100 * float(view.pixels[view.pixels.shape[0] // 2, view.pixels.shape[1] // 2])
        shares = "the middle pixel holds {real} % of the light, of a perfect lens's {perfect} %"
        real, perfect = f"{middle:.3g}", f"{100 * view.perfect_share:.3g}"
        words = tr(shares, real=real, perfect=perfect)
        if live.psf.strehl is not None:
            words = f"{tr('Strehl {strehl}', strehl=significant(float(live.psf.strehl), 2))} · {words}"
        self.widget.set_readout(words)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        for heat in self.maps:
            heat.restyle(theme)
