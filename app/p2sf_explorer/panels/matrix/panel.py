"""The matrix: small pictures of one kind at several fields, and at several colours, depths, shifts or for A and B."""

import re
from collections.abc import Callable

from PySide6.QtWidgets import QCheckBox

from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.brightness import SCALES, UNITS
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.matrix.pictures import Matrix, settle
from p2sf_explorer.compute.matrix.points import LISTS, SIDE, MatrixRequest, heading_texts, nearest, point_entries
from p2sf_explorer.compute.matrix.tiles import (
    Light,
    Lines,
    MatrixTile,
    SpotTile,
    Tiles,
    WavefrontTile,
    figures,
    methods,
    peaks,
    scales,
    worst,
)
from p2sf_explorer.compute.method import at_least
from p2sf_explorer.compute.quantities import QUANTITIES
from p2sf_explorer.i18n.messages import WINDOW, said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels.matrix.tile_charts import (
    LOOKS,
    LightChart,
    LinesChart,
    PointsChart,
    TileChart,
    TileGrid,
    WavesChart,
    Words,
)
from p2sf_explorer.state.state import change
from p2sf_explorer.state.terms import PLACES, PUPIL_AXES
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import TurningCard, chooser
from p2sf_explorer.widgets.chart_card import legend
from p2sf_explorer.widgets.readout import Readout
from p2sf_explorer.widgets.value_edit import ValueList

TIP = (
    "Matrix: the same picture at several fields, and at several wavelengths, depths or sensor shifts, or for A and "
    "B. Click a picture, or press Enter, to go to its point. A frame marks the present point; a dashed one the "
    "nearest to it."
)
SHARED_TIP = "All pictures share one scale; otherwise each has its own"
UNITS_TIP = "Brightness: each picture relative to its own peak, or with One scale all relative to the brightest"
WHATS = (
    ("psf", "PSF"),
    ("spot", "Spot"),
    ("ray_fan", "Ray fan"),
    ("opd_fan", "OPD fan"),
    ("mtf", "MTF"),
    ("pupil", "Pupil"),
)
ACROSS = (
    ("wavelength_nm", "× wavelengths"),
    ("depth_mm", "× depths"),
    ("sensor_shift_um", "× sensor shifts"),
    (SIDE, "× A | B"),
)
NAMES = {"field_deg": "Fields", "wavelength_nm": "Colours", "depth_mm": "Depths", "sensor_shift_um": "Shifts"}
COUNTS = (2, 3, 4, 5)
READERS = {quantity.key: quantity.read for quantity in QUANTITIES}
KINDS: dict[str, type[TileChart]] = {
    "psf": LightChart,
    "pupil": WavesChart,
    "spot": PointsChart,
    "ray_fan": LinesChart,
    "opd_fan": LinesChart,
    "mtf": LinesChart,
}
FREQUENCY = "frequency on the sensor, 1/mm"
LEFT_AXES = {"ray_fan": "landing point, µm", "opd_fan": "OPD, waves", "mtf": "contrast"}
SHORT = {"geometric": "ray density"}
PREVIEW = "preview"


class MatrixPanel:
    """The pictures, and beside them what they show, over which values, and on which scale."""

    def __init__(self, store: Store):
        self._store = store
        self.widget = TurningCard("Matrix", TIP)
        self.what = chooser(WHATS, "What the pictures show", self.widget)
        self.across = chooser(ACROSS, "What changes from column to column", self.widget)
        self.fields, self.values = ValueList(COUNTS, self.widget), ValueList(COUNTS, self.widget)
        self.shared = QCheckBox(tr("One scale"), self.widget)
        self.shared.setToolTip(tr(SHARED_TIP))
        self.scale = chooser(SCALES, "Brightness scale", self.widget)
        self.units = chooser(UNITS, UNITS_TIP, self.widget)
        self.badge = Readout(self.widget, pill=True, colour="text")
        self.grid = TileGrid(self.widget)
        pairs = (self.what, self.across), (self.fields,), (self.values,), (self.shared,), (self.scale, self.units)
        for group in (*pairs, (self.badge,)):
            self.widget.add_group(*group)
        self.widget.set_body(self.grid)
        self.late = LateAnswers(self.widget, settle, self._take)
        self.shown: tuple[MatrixRequest, Tiles] | None = None
        self.settled: tuple[MatrixRequest, Tiles] | None = None
        self._live: Live | None = None
        self._filled: dict[TileChart, tuple[object, ...]] = {}
        self._theme = LIGHT
        self._connect()

    def _connect(self) -> None:
        store = self._store
        self.late.failed.connect(lambda _, why: self.badge.set_text(said(why), "warning"))
        choosers = {"matrix_what": self.what, "matrix_across": self.across}
        self.widget.bind(store, psf_scale=self.scale, psf_units=self.units, **choosers)
        self.shared.clicked.connect(lambda on: store.update(matrix_shared=on))
        self.fields.counted.connect(lambda count: store.update(matrix_rows=count, matrix_fields_deg=()))
        self.fields.listed.connect(lambda values: store.update(matrix_fields_deg=values))
        self.values.counted.connect(lambda count: store.update(matrix_columns=count, **{self._list(): ()}))
        self.values.listed.connect(lambda values: store.update(**{self._list(): values}))
        for values in (self.fields, self.values):
            values.refused.connect(store.refused.emit)
        self.grid.taken.connect(self._go)

    def _list(self) -> str:
        """Return the entry that lists the columns' values."""
        return f"matrix_{LISTS[self._store.state.matrix.across]}"

    def show(self, live: Live) -> None:
        """Paint what fits a frame; have the rest made in the background once it rests."""
        self._live = live
        view: Matrix = live.views["matrix"].found
        self.late.follow(live.views["matrix"])
        self._show_choices(live, view.request)
        self.grid.build(KINDS[view.request.what], (len(view.request.rows), len(view.request.columns)))
        self._filled = {chart: shown for chart, shown in self._filled.items() if chart in self.grid.charts}
        if self.settled and self.settled[0] == view.request:
            self._paint(*self.settled)
        elif view.tiles:
            self._paint(view.request, view.tiles)
        elif self.shown and self.shown[0].what == view.request.what:
            self._paint(*self.shown)

    def _show_choices(self, live: Live, request: MatrixRequest) -> None:
        view = live.state.matrix
        self.shared.setChecked(view.shared)
        for box in (self.scale, self.units):
            box.setVisible(view.what == "psf")
        rows, columns = heading_texts(request)
        self.fields.name(tr(NAMES["field_deg"]), READERS["field_deg"])
        self.fields.show_values(list_values(rows))
        self.values.setVisible(view.across != SIDE)
        if view.across != SIDE:
            self.values.name(tr(NAMES[view.across]), READERS[view.across])
            self.values.show_values(columns if view.across == "depth_mm" else list_values(columns))

    def _take(self, request: MatrixRequest, tiles: Tiles) -> str:
        """Show what the worker has made so far."""
        if self._live and request == self._live.views["matrix"].found.request:
            if all(tile.settled for row in tiles for tile in row):
                self.settled = request, tiles
            self._paint(request, tiles)
        return ""

    def _paint(self, request: MatrixRequest, tiles: Tiles) -> None:
        if self._live is None or (len(tiles), len(tiles[0])) != self.grid.shape:
            return
        self.shown = request, tiles
        self.widget.set_readout(self._legend(tiles))
        self.grid.linked = request.shared
        rows, columns = heading_texts(request)
        one_brightness = request.shared and self._live.state.display.psf_units != "peak"
        sizes, brightest = scales(request.what, tiles, request.shared), peaks(tiles, one_brightness)
        numbers = figures(tiles)
        row, column, exact = nearest(request, self._live.state, self._live.side)
        for r, line in enumerate(tiles):
            for c, tile in enumerate(line):
                chart = self.grid.chart(r, c)
                here = ("exact" if exact else "near") if (r, c) == (row, column) else ""
                why = said(tile.why) if tile.why else ""
                extent, figure = extent_words(request.what, sizes[r][c]), numbers[r][c].text(WINDOW)
                self._fill(chart, request.what, tile, sizes[r][c], brightest[r][c])
                chart.tell(Words((rows[r], columns[c]), made_words(tile), figure, extent, why, here))
        self._show_badge(request, tiles)

    def _legend(self, tiles: Tiles) -> str:
        """Return the names of the curves in their colours, "" for other pictures."""
        lines = (tile.content for row in tiles for tile in row if isinstance(tile.content, Lines))
        named = {name for content in lines for name in content.curves}
        return legend({name: token for name, (token, _) in LOOKS.items() if name in named}, self._theme)

    def _fill(self, chart: TileChart, what: str, tile: MatrixTile, size: float, peak: float) -> None:
        """Show a picture, unless it is the one that is there."""
        content, state = tile.content, self._live.state if self._live else None
        shown = content, what, size, peak, state and (state.display.psf_scale, state.optics.aim), self._theme
        if self._filled.get(chart) == shown:
            return
        self._filled[chart] = shown
        aim = self._live.setup.lens.aim if self._live else "stop"
        if isinstance(chart, LightChart) and isinstance(content, Light):
            chart.show_airy(content.airy_um)
            scale = self._live.state.display.psf_scale if self._live else "sqrt"
            chart.show_light(content, size, peak, scale)
        elif isinstance(chart, WavesChart) and isinstance(content, WavefrontTile):
            chart.name_axes(*PUPIL_AXES[aim])
            chart.show_waves(content.values, content.outline, size)
        elif isinstance(chart, PointsChart) and isinstance(content, SpotTile):
            chart.show_points(content.points, content.airy_um, size)
        elif isinstance(chart, LinesChart) and isinstance(content, Lines):
            ranges = ((0.0, size), (0.0, 1.04)) if what == "mtf" else ((-1.02, 1.02), (-size, size))
            chart.above = what == "mtf"
            chart.name_axes(FREQUENCY if what == "mtf" else PLACES[aim], LEFT_AXES[what])
            chart.show_lines(content.x, content.curves, *ranges)
        else:
            chart.clear()

    def _show_badge(self, request: MatrixRequest, tiles: Tiles) -> None:
        """Say by which methods the pictures are made, the worst predicted R², and how many are still to be settled."""
        flat = [tile for row in tiles for tile in row]
        words = [" + ".join(tr(SHORT.get(name, name)) for name in methods(tiles))]
        error = worst(tiles)
        if error is not None:
            words.append(tr("worst R² ≥ {r}", r=at_least(1 - error)) if error < 1 else tr("no R² predicted"))
        if waiting := sum(not tile.settled for tile in flat):
            words.append(tr("{done} of {all} settled", done=len(flat) - waiting, all=len(flat)))
        if request.across == SIDE and len(request.columns) == 1:
            words.append(tr("nothing is pinned as B (Ctrl+B)"))
        text = " · ".join(filter(None, words))
        self.badge.set_text(text, "text", short=(" · ".join(words[1:]), words[-1]))
        self.badge.setToolTip(text)

    def _go(self, row: int, column: int) -> None:
        """Make a picture's point the present one; that of B in B."""
        if self.shown is None:
            return
        request, store = self.shown[0], self._store
        entries = point_entries(request, row, column)
        if request.across != SIDE or len(request.columns) == 1:
            store.update(**entries)
        elif column == 0:
            with store.drag():
                store.update(shown="a")
                store.update(**entries)
        elif (pinned := store.state.compare.pinned) is not None:
            store.update(pinned=change(pinned, **entries), shown="b")

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.grid.restyle(theme)
        self.badge.restyle(theme)
        if self.shown:
            self._paint(*self.shown)


def list_values(texts: tuple[str, ...]) -> tuple[str, ...]:
    """Return values of one unit with the unit behind the last alone."""
    return *(re.sub(r"[^\d.−]+$", "", text) for text in texts[:-1]), texts[-1]


def made_words(tile: MatrixTile) -> str:
    """Return how a picture was made: the method, a preview as such, and the least R² that is predicted."""
    if not tile.method:
        return ""
    words = [tr(SHORT.get(tile.method, tile.method))]
    if not tile.settled:
        words.append(tr(PREVIEW))
    if tile.error is not None and tile.error < 1:
        words.append(f"R² ≥ {at_least(1 - tile.error)}")
    return " · ".join(words)


EXTENTS: dict[str, Callable[[float], str]] = {
    "psf": lambda size: f"↔ {size:.3g} µm",
    "spot": lambda size: f"±{size:.3g} µm",
    "ray_fan": lambda size: f"±{size:.3g} µm",
    "opd_fan": lambda size: f"±{size:.3g} λ",
    "mtf": lambda size: f"0…{size:.3g}/mm",
    "pupil": lambda size: f"±{size:.3g} λ",
}


def extent_words(what: str, size: float) -> str:
    """Return the scale of a picture: how wide a PSF's window is, or the ends of an axis."""
    return EXTENTS[what](size) if size else ""
