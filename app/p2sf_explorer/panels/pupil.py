"""The wavefront over the pupil: W in waves as a map, contours or a surface, or its phase modulo one wave."""

import numpy as np
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPainterPath

from p2sf.pupil.wavefront_map import CIRCLE
from p2sf_explorer.charts.chart import Chart, Curve
from p2sf_explorer.charts.colour_scale import ColourScale
from p2sf_explorer.charts.contour import contours, interval
from p2sf_explorer.charts.painting import polygon
from p2sf_explorer.charts.plots import HeatMap
from p2sf_explorer.charts.surface_plot import SurfaceView
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.camera import SceneCamera
from p2sf_explorer.state.scales import significant
from p2sf_explorer.state.terms import PUPIL_AXES
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, chooser, select
from p2sf_explorer.widgets.readout import Readout

WAVES_MAP, WRAPPED_MAP = "CET-D1A", "CET-CBC1"
MODES = (("waves", "W, waves"), ("contour", "contours"), ("surface", "surface"), ("wrapped", "wrapped"))
SIGNED = ("waves", "contour", "surface")  # which can show a difference
TIP = (
    "Wavefront W over the pupil: by how many waves the optical path of a ray is shorter than that of the chief ray. "
    "What the stop hides is left out, and a filter shades the picture."
)


class Outside(Curve):
    """The square about the pupil less a closed outline, filled: what remains of the picture has a smooth rim."""

    def paint(self, painter: QPainter, chart: Chart) -> None:
        """Fill what lies outside."""
        (left, bottom), (right, top) = chart.to_pixels(-1.0, -1.0), chart.to_pixels(1.0, 1.0)
        path = QPainterPath()
        path.addRect(QRectF(left - 1, top - 1, right - left + 2, bottom - top + 2))
        path.addPolygon(polygon(*chart.to_pixels(self.x, self.y)))
        painter.fillPath(path, QColor(getattr(chart.theme, self.token)))


class Obstructions(Curve):
    """What stands in the pupil, closed outlines that are filled."""

    def __init__(self, token: str) -> None:
        super().__init__(token)
        self.outlines: tuple[np.ndarray, ...] = ()

    def paint(self, painter: QPainter, chart: Chart) -> None:
        """Fill the outlines."""
        path = QPainterPath()
        path.setFillRule(Qt.FillRule.WindingFill)  # where two overlap, both are dark
        for outline in self.outlines:
            path.addPolygon(polygon(*chart.to_pixels(*outline)))
        painter.fillPath(path, QColor(getattr(chart.theme, self.token)))


class Shade(Curve):
    """A filter in the pupil: what it takes of the amplitude covers the picture, in the colour of what lies outside."""

    def __init__(self, token: str) -> None:
        super().__init__(token)
        self.amplitude: np.ndarray | None = None

    def paint(self, painter: QPainter, chart: Chart) -> None:
        """Cover the square about the pupil by what does not pass."""
        if self.amplitude is None:
            return
        taken = np.ascontiguousarray(255 * (1 - self.amplitude[::-1])).round().astype(np.uint8)
        rows, columns = taken.shape
        cover = QImage(taken.data, columns, rows, columns, QImage.Format.Format_Alpha8)
        image = QImage(cover.size(), QImage.Format.Format_ARGB32_Premultiplied)
        image.fill(QColor(getattr(chart.theme, self.token)))
        image.setAlphaChannel(cover)
        (left, bottom), (right, top) = chart.to_pixels(-1.0, -1.0), chart.to_pixels(1.0, 1.0)
        painter.drawImage(QRectF(left, top, right - left, bottom - top), image)


class PupilPanel:
    """A heat map or a surface of W with RMS and peak-to-valley; the chooser switches between them."""

    def __init__(self, store: Store):
        self.widget = Card("Pupil", TIP)
        self.mode = chooser(MODES, "How the phase is shown", self.widget)
        self.mode.activated.connect(lambda: store.update(phase=self.mode.currentData()))
        self.widget.add_tool(self.mode)
        self.map = HeatMap(*PUPIL_AXES["paraxial"], self.widget)
        self.shade, self.dark = Shade("card"), Obstructions("card")
        self.outside, self.beyond_iris = Outside("card"), Outside("card")
        self.map.chart.curves += [self.shade, self.dark, self.beyond_iris, self.outside]
        self.map.chart.add_curve("line").set_data(*CIRCLE)
        self.rim = self.map.chart.add_curve("muted")
        self.map.chart.set_view((0.0, 0.0), RIM)
        self.surface = SurfaceView(self.map)
        self.surface.turned.connect(
            lambda turn, tilt: store.update(camera_surface_turn_deg=turn, camera_surface_tilt_deg=tilt)
        )
        self.surface.taken.connect(store.begin)
        self.surface.released.connect(store.end)
        self.map.row.insertWidget(0, self.surface, 1)
        self.numbers = Readout(self.widget, pill=True, colour="text")
        self.widget.set_body(self.map)
        self.widget.add_footer(self.numbers)

    def show(self, live: Live) -> None:
        """Paint the wavefront."""
        pupil = live.difference.pupil if live.difference else live.pupil
        self.outside.set_data(*pupil.outline)
        self.rim.set_data(*pupil.outline)
        self.beyond_iris.set_data(*pupil.iris)
        self.dark.outlines, self.shade.amplitude = pupil.obstructions, pupil.shade
        self.map.chart.name_axes(*PUPIL_AXES[live.setup.lens.aim])
        mode = live.state.display.phase if live.state.display.phase in SIGNED or not live.difference else "waves"
        select(self.mode, mode)
        self.surface.setVisible(mode == "surface")
        self.map.chart.setVisible(mode != "surface")
        if mode == "wrapped":
            self.map.show_map(np.mod(pupil.waves, 1.0), DISC, WRAPPED)
        else:
            step = interval(pupil.peak_to_valley)
            bands = contours(pupil.waves, step) if mode == "contour" else None
            self.map.show_map(pupil.waves, DISC, waves_scale(pupil.waves), bands)
            if mode == "surface":
                camera = SceneCamera(live.state.camera.surface_turn_deg, live.state.camera.surface_tilt_deg)
                self.surface.show_waves(pupil.waves, self.map.bar.top, live.quality, camera)
        rms, peak_to_valley = (significant(value, 3) for value in (pupil.rms, pupil.peak_to_valley))
        numbers = tr("RMS {r} λ · PV {p} λ", r=rms, p=peak_to_valley)
        if pupil.clear < 1:
            numbers += " · " + tr("{percent} % of the pupil", percent=f"{100 * pupil.clear:.0f}")
        lines = tr("line every {step} λ", step=f"{step:g}") if mode == "contour" else tr(pupil.kind)
        self.numbers.set_text(f"{numbers} · {lines}", short=numbers)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.map.restyle(theme)
        self.surface.restyle(theme)
        self.numbers.restyle(theme)


def waves_scale(waves: np.ndarray) -> ColourScale:
    """Return how a wavefront is coloured: about zero, as far as it reaches, in coarse steps."""
    peak = float(np.nanmax(np.abs(waves))) if np.isfinite(waves).any() else 0.0
    top = max(peak, LEAST_WAVES)
    return ColourScale(WAVES_MAP, -top, top, "λ", "W, waves", measure="waves", steady=True)


RIM = 1.04  # pupil radii that are shown
LEAST_WAVES = 0.05  # of a full bar
DISC = (-1.0, -1.0, 2.0, 2.0)  # the square about the pupil: x, y, width, height in its radii
WRAPPED = ColourScale(WRAPPED_MAP, 0.0, 1.0, "λ", "W modulo 1, waves", measure="wrapped")
