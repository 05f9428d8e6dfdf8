"""Through focus: PSFs at several sensor positions, and the sensor, which can be dragged."""

from dataclasses import replace
from math import inf

import numpy as np
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPen, QResizeEvent

from p2sf_explorer.charts.plots import BRIGHTNESS
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.framing import crop
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.through_focus import Focused, Strip, answer
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import with_sign
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.chart_card import NOTE_PX
from p2sf_explorer.widgets.differences import DIFFERENCE_MAP
from p2sf_explorer.widgets.tiles import Tile, TilesChart, tile

TIP = (
    "Through focus: the PSF at several sensor positions, brightness over that of the brightest. Drag the line or "
    "click: the sensor follows. S, T: where sagittal and tangential rays come to focus; best: smallest RMS wavefront."
)
STRIP_TIP = "Drag the line or click, or use the left and right arrow keys: the sensor follows."
NEAR_PX = 9.0
MOST_ROWS = 5
ENDS = 0.6  # steps of the strip before its first and behind its last place
SIDES: dict[int, int] = {Qt.Key.Key_Left: -1, Qt.Key.Key_Right: 1}


class StripChart(TilesChart):
    """The strip, and the sensor's line with a handle at its lower end."""

    def __init__(self, store: Store):
        super().__init__("sensor shift, µm", "")
        self.takes_arrows = True
        self._store = store
        self.left_axis = False
        self.sensor_um = 0.0
        self._held = False
        self._strip: tuple[list[Tile | None], np.ndarray] | None = None
        self.setAccessibleName(tr("Sensor position"))
        self.setToolTip(tr(STRIP_TIP))

    def takes(self, point: QPointF) -> bool:
        """Return whether a press moves the sensor."""
        return self.area.contains(point)

    def show_strip(self, tiles: list[Tile | None], shifts: np.ndarray) -> None:
        """Show a tile at every one of even sensor shifts, larger ones staggered in rows where the chart is tall."""
        self._strip = tiles, shifts
        step, area = float(shifts[1] - shifts[0]), self.area
        wide = area.width() / (len(shifts) + 2 * ENDS - 1)  # of a step, in pixels
        tall = max(1.0, area.height() - self.theme.px(NOTE_PX))  # below the line of the notes
        rows = max(range(1, MOST_ROWS + 1), key=lambda count: min(count * wide, tall / count))
        placed = (each and replace(each, y=1 - (k % rows + 0.5) / rows) for k, each in enumerate(tiles))
        air = max(ENDS, rows / 2) * step  # so that the first and the last tile are whole
        self.set_range((float(shifts[0]) - air, float(shifts[-1]) + air), (0.0, area.height() / tall))
        self.show_tiles(placed, rows * step, rows * area.height() / tall)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Choose again how many rows there is room for."""
        super().resizeEvent(event)
        if self._strip:
            self.show_strip(*self._strip)

    def show_sensor(self, shift_um: float) -> None:
        """Show the position of the sensor."""
        self.sensor_um = shift_um
        self.update()

    def paint_over(self, painter: QPainter) -> None:
        """Paint the strip, then the sensor's line and handle."""
        super().paint_over(painter)
        x, bottom = float(self.to_pixels(self.sensor_um, 0.0)[0]), self.area.bottom()
        colour, unit = QColor(self.theme.chief), self.theme.scale
        painter.setPen(QPen(colour, unit))
        painter.drawLine(QPointF(x, self.area.top()), QPointF(x, bottom))
        painter.setBrush(colour)
        painter.drawEllipse(QPointF(x, bottom - 6 * unit), 5 * unit, 5 * unit)
        if self.hasFocus():
            painter.setPen(QPen(QColor(self.theme.accent), 2 * unit))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawEllipse(QPointF(x, bottom - 6 * unit), 8 * unit, 8 * unit)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take hold of the sensor, or bring it under the pointer."""
        if event.button() == Qt.MouseButton.LeftButton and self.area.contains(event.position()):
            self._held = True
            self._store.begin()
            self._follow(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Let the sensor follow while held."""
        if self._held:
            self._follow(event.position())
        over = abs(event.position().x() - float(self.to_pixels(self.sensor_um, 0.0)[0])) < NEAR_PX
        self.setCursor(Qt.CursorShape.SizeHorCursor if over or self._held else Qt.CursorShape.ArrowCursor)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        if self._held:
            self._held = False
            self._store.end()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the sensor by a fiftieth of the strip with the arrow keys."""
        side = SIDES.get(event.key())
        if side is None:
            super().keyPressEvent(event)
            return
        (low, high), _ = self.ranges()
        self._store.update(sensor_shift_um=round(self.sensor_um + side * (high - low) / 50, 3))

    def _follow(self, point: QPointF) -> None:
        (low, high), _ = self.ranges()
        self._store.update(sensor_shift_um=round(float(np.clip(self.from_pixels(point)[0], low, high)), 2))


class ThroughFocusPanel:
    """A strip that a worker fills, while the sensor's line follows at once."""

    def __init__(self, store: Store):
        self.widget = Card("Through focus", TIP)
        self.chart = StripChart(store)
        self.widget.set_body(self.chart)
        self.late = LateAnswers(self.widget, answer, self._paint, self.widget.set_readout)
        self.found: tuple[Strip, Focused] | None = None
        self._scale = "sqrt"

    def show(self, live: Live) -> None:
        """Show the sensor, and ask for the strip when more than the sensor has changed."""
        scale = live.state.display.psf_scale
        if scale != self._scale:
            self._scale = scale
            self.late.again()
        self.chart.show_sensor(live.state.optics.sensor_shift_um)
        self.late.follow(live.views["through_focus"])

    def _paint(self, asked: Strip, found: Focused) -> str:
        self.found = asked, found
        shifts = np.array(asked.shifts_um)
        top = np.nanmax(np.abs(found.light)) if np.isfinite(found.light).any() else 1.0
        shown = crop(found.light)
        pictures = found.light[:, shown, shown]
        light = pictures / (top or 1.0)
        low, self.chart.colours = (-1.0, DIFFERENCE_MAP) if asked.less else (0.0, BRIGHTNESS)
        tiles = [tile(values, float(at), 0.5, self._scale, low) for values, at in zip(light, shifts, strict=True)]
        self.chart.show_strip(tiles, shifts)
        heads = (
            tr("sensor shift {shift} µm: share of the perfect peak", shift=with_sign(float(at), 1)) for at in shifts
        )
        self.chart.means(zip(heads, pictures, strict=True), asked.window[1])
        names = (("S", "marginal"), ("T", "positive"), (tr("best"), "text"))
        foci = zip(names, (found.sagittal, found.tangential, found.best), strict=True)
        self.chart.show_notes((x, inf, f"▾ {name}", token, 0) for (name, token), x in foci if np.isfinite(x))
        wide = light.shape[-1] * asked.window[1]
        best = tr("best {shift} µm", shift=with_sign(found.best, 1))
        width = tr("pictures {wide} µm wide", wide=f"{wide:.3g}")
        return f"S {with_sign(found.sagittal, 1)} · T {with_sign(found.tangential, 1)} · {best} · {width}"

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.chart.restyle(theme)
