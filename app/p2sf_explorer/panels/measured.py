"""A picture of points, measured: its points, picture beside model, coefficients with errors beside the lens's own."""

from collections.abc import Sequence
from pathlib import Path
from time import perf_counter

import numpy as np
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QBoxLayout,
    QCheckBox,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QVBoxLayout,
    QWidget,
)

from p2sf.errors import P2SFError
from p2sf.image.progress import seconds_left
from p2sf.measure.as_built import left_out, write_as_built
from p2sf.measure.measurement import Measurement, write_measurement
from p2sf.messages import Message
from p2sf_explorer.charts.overlay import Overlay
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.measured import (
    MeasurementRequest,
    PointLine,
    PointPictures,
    answer,
    as_free_pupil,
    encoding_words,
    has_lens_as_built,
    into_image,
    own_six,
    point_lines,
    point_pictures,
    point_rows,
    whole_rows,
    with_file_date,
    write_sample,
)
from p2sf_explorer.files.asking import ask_path
from p2sf_explorer.files.recent import recent_path
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, chooser
from p2sf_explorer.widgets.drop import MeasuredDrop
from p2sf_explorer.widgets.empty_state import EmptyState
from p2sf_explorer.widgets.plain_table import PlainTable
from p2sf_explorer.widgets.plan_note import small_button
from p2sf_explorer.widgets.readout import FactTable, in_scroll_area
from p2sf_explorer.widgets.tiles import TilesChart, tile
from p2sf_explorer.widgets.value_edit import NumberBox

TIP = (
    "Measured: the points of a photograph, the wavefront that explains each of them, with errors, and what all "
    "together say about the lens and the position of its sensor. Pictures show the root of brightness relative to "
    "the picture's peak, all on one scale."
)
PICTURES = "Pictures of points (*.png *.tif *.tiff *.jpg *.jpeg *.fits *.fit *.npy *.npz *.txt)"
BUILT = "P2SF lens (*.toml);;PSF database (*.npz)"
EMPTY = "Drop a picture of points here"
EMPTY_WORDS = "A screen of bright points, stars, or a PSF: the panel finds the wavefront behind each of them."
SAMPLE_TIP = "Measure six points through this lens whose sensor stands 60 µm too far; the panel finds that"
HEADS = ("x, mm", "y, mm", "R²", "χ²", "not used because")
STOPPED = "stopped; choose the picture again to measure it"
ENCODINGS = (("automatic", "automatic"), ("srgb", "sRGB"), ("linear", "linear"))
PARTS = ("measured", "model", "difference")
LOW = 300  # pixels of the body's height below which there is no room for a list


class MeasuredPanel:
    """Controls in two rows; below them three pictures of the point chosen, the list of points, and the numbers."""

    def __init__(self, store: Store):
        self._store = store
        self.widget = Card("Measured", TIP)
        self.open = small_button("Picture…", "Choose a picture of points to measure", self._ask_picture)
        self.stop_button = small_button("Stop", "Stop measuring", self._stop)
        self.save = small_button("Save…", "Save the numbers and their errors as .npz", self._ask_save)
        self.take = small_button(
            "To pupil",
            "Show the fitted pupil of this point in the window, as a free pupil; undo returns to the lens",
        )
        self.built = small_button(
            "As built…",
            "Save this lens with the sensor where the picture shows it to be, or its PSF database",
            self._ask_built,
        )
        self.sharpen = small_button(
            "To Image",
            "Take the lens as measured into the window and sharpen photos that it took; undo brings the lens back",
            self._sharpen,
        )
        self.pixel = NumberBox()
        self.beside = QCheckBox(tr("this lens"))
        self.encoding = chooser(ENCODINGS, "What whole numbers of the picture mean; automatic takes 8 bits for sRGB")
        self.note = QLabel()
        self.chart, self.list = TilesChart(framed=False), PointList()
        self.table = FactTable()
        self._lay_out()
        self.overlay = Overlay(self.body)
        self._asked: MeasurementRequest | None = None
        self._request: MeasurementRequest | None = None
        self._found: Measurement | None = None
        self._refusal, self._stopped, self._begun = "", False, 0.0
        self.worker = LateAnswers(self.widget)
        self._connect()
        self._show_readout()

    def _lay_out(self) -> None:
        self.pixel.setRange(0.05, 1000.0)
        self.pixel.setDecimals(3)
        self.pixel.setSuffix(" µm")
        self.pixel.setToolTip(tr("Pixel pitch of the picture; listings and PSFs of this program state theirs"))
        self.pixel.setAccessibleName(tr("Pixel pitch"))
        self.beside.setToolTip(tr("Fit departures from the lens on screen; otherwise the lens only sets the scale"))
        self.body = MeasuredBody(self.chart, self.list, self.table)
        whole = QWidget()
        column = QVBoxLayout(whole)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        # In one row they are wider than the panel of a small window.
        for parts in (
            (self.open, self.stop_button, self.save, self.built, self.take),
            (self.pixel, self.encoding, self.beside, self.sharpen),
        ):
            column.addLayout(_row(parts))
        self.choose = small_button("Picture…", "Choose a picture of points to measure", self._ask_picture)
        self.sample = small_button("Try a sample", SAMPLE_TIP, self.try_sample)
        self.empty = EmptyState(tr(EMPTY), tr(EMPTY_WORDS), (self.choose, self.sample))
        column.addWidget(self.body, 1)
        column.addWidget(self.empty, 1)
        self.widget.set_body(whole)
        self.note.setObjectName("muted")
        self.note.setWordWrap(True)
        self.widget.add_footer(self.note)

    def _connect(self) -> None:
        self.worker.finished.connect(self._on_answer)
        self.worker.failed.connect(self._on_failure)
        self.worker.progressed.connect(self._on_progress)
        self.list.itemSelectionChanged.connect(self._paint_point)
        self.pixel.valueChanged.connect(lambda pitch: self._store.update(measured_pixel_um=pitch))
        self.beside.clicked.connect(lambda on: self._store.update(measured_beside=bool(on)))
        self.widget.bind(self._store, measured_encoding=self.encoding)
        self.take.clicked.connect(self._take)
        self.drop = MeasuredDrop(self.widget)
        self.drop.photo.connect(self.open_picture)
        self.drop.refused.connect(self._store.refused)

    def show(self, live: Live) -> None:
        """Follow the state; a picture is measured again where anything has changed and nothing is dragged."""
        self._asked = asked = live.views["measured"].question
        for control, follow in ((self.pixel, self.pixel.setValue), (self.beside, self.beside.setChecked)):
            control.blockSignals(True)
            follow(asked.pixel_um if control is self.pixel else asked.beside)
            control.blockSignals(False)
        if live.quality == "settled":
            self._measure()

    def open_picture(self, path: str) -> None:
        """Measure a picture, the present one once more."""
        self._request = None
        self._store.update(measured_picture=path)
        self._measure()

    def try_sample(self) -> None:
        """Measure points through the lens on screen, or say why it has no such picture."""
        path = recent_path().with_name("sample_points.npy")
        if self._asked is None:
            return
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            write_sample(self._asked, path)
        except P2SFError as error:
            self._store.refused.emit(error)
            return
        self.open_picture(str(path))

    def _measure(self) -> None:
        asked = with_file_date(self._asked) if self._asked else None
        if asked is None:
            return
        if asked == self._request and (self._stopped or not asked.picture or self.worker.asked == asked):
            return
        if self._request is None or asked.picture != self._request.picture:
            self._found = None
        self._request, self._refusal, self._stopped = asked, "", False
        self.worker.cancel()
        self._begun = perf_counter()
        if asked.picture:
            self.worker.submit(asked, lambda cancelled, progress: answer(asked, cancelled.is_set, progress))
        self._show_readout()

    def _stop(self) -> None:
        self._stopped = True
        self.worker.cancel()
        self._show_readout()

    def _on_progress(self, key: MeasurementRequest, share: float) -> None:
        if key != self._request:
            return
        percent, left = f"{100 * share:.0f}", seconds_left(share, perf_counter() - self._begun)
        if left is None:
            self._show_readout(local(tr("measuring, {percent} %", percent=percent)))
        else:
            self._show_readout(local(tr("measuring, {percent} %, {left} s left", percent=percent, left=left)))

    def _on_answer(self, key: MeasurementRequest, found: Measurement) -> None:
        if key != self._request:
            return
        self._found, self._refusal = found, ""
        self.list.show_lines(point_lines(found))
        self._show_readout()
        self._paint_point()

    def _on_failure(self, key: MeasurementRequest, why: Message) -> None:
        if key == self._request:
            self._refusal, self._found = said(why), None
            self._show_readout()

    def _show_readout(self, progress: str = "") -> None:
        found, name = self._found, Path(self._request.picture).name if self._request else ""
        working = self.worker.busy and bool(name) and not self._stopped
        self.stop_button.setVisible(working)
        self.save.setVisible(not working)
        for button in (self.save, self.take):
            button.setEnabled(found is not None and found.used > 0)
        for button in (self.built, self.sharpen):
            button.setEnabled(found is not None and has_lens_as_built(found))
        self.empty.setVisible(not name)
        self.body.setVisible(bool(name))
        instead = STOPPED if self._stopped else "measuring"
        self.overlay.say(self._refusal or ("" if found or not name else tr(instead)), 0)
        if working:
            name = progress or tr("measuring")
        elif found is not None:
            name = f"{name} · {tr('{used} of {all} points', used=found.used, all=len(found.points))}"
            if words := encoding_words(found):
                name = f"{name} · {tr(words)}"
        self.widget.set_readout(name)

    def _paint_point(self) -> None:
        found, number = self._found, self.list.chosen()
        if found is None or number is None:
            return
        self.table.show_rows((*point_rows(found, number, own_six(found, number)), *whole_rows(found)))
        fit = found.fits[number]
        self.take.setEnabled(fit is not None and fit.reliable)
        parts = point_pictures(found, number)
        if parts is None:
            self.chart.show_tiles((), 1.0)
            return
        self._paint_pictures(parts)
        warnings = dict.fromkeys(
            (*found.warnings, *(fit.warnings if fit else ()), *(found.whole.warnings if found.whole else ()))
        )
        self.note.setText("\n".join(said(warning) for warning in warnings))

    def _paint_pictures(self, parts: PointPictures) -> None:
        pictures = [np.clip(values, 0.0, 1.0) for values in (parts.measured, parts.modelled, abs(parts.difference))]
        self.chart.set_range((-0.5, 2.5), (-0.5, 0.5))
        self.chart.show_tiles([tile(values, float(k), 0.0, "sqrt") for k, values in enumerate(pictures)], 0.95)
        heads = (tr(name) for name in PARTS)
        signed = parts.measured, parts.modelled, parts.difference
        self.chart.means(zip(heads, signed, strict=True), parts.pixel_um)
        most = local(tr("± {percent} %", percent=f"{100 * parts.largest:.1f}"))
        names = [tr("data"), tr("model"), most]  # short: the pictures are as wide as they
        self.chart.show_notes([(float(k), float("inf"), name, "muted", 0) for k, name in enumerate(names)])

    def _take(self) -> None:
        number = self.list.chosen()
        fit = self._found.fits[number] if self._found is not None and number is not None else None
        if fit is not None and fit.reliable:
            self._store.update(**as_free_pupil(fit))

    def _sharpen(self) -> None:
        found = self._found
        if found is None or found.whole is None:
            return
        self._store.update(**into_image(found.whole, found.optics.pixel_um, self._store.state))
        for message in left_out(found.whole, "built.toml"):
            self._store.said.emit(message)

    def _ask_picture(self) -> None:
        path, _ = QFileDialog.getOpenFileName(self.widget, tr("Choose a picture of points"), "", tr(PICTURES))
        if path:
            self.open_picture(path)

    def _ask_save(self) -> None:
        if path := ask_path(self.widget, tr("Save the measurement"), "coefficients.npz", "npz (*.npz)"):
            self.save_as(path)

    def save_as(self, path: str) -> None:
        """Write the measurement; say why it cannot be written."""
        if self._found is None:
            return
        try:
            write_measurement(self._found, path)
        except P2SFError as error:
            self._store.refused.emit(error.message)

    def _ask_built(self) -> None:
        if path := ask_path(self.widget, tr("Save the lens as built"), "built.toml", tr(BUILT)):
            self.save_built(path)

    def save_built(self, path: str) -> None:
        """Write the lens as built; say what it leaves out, or why it cannot be written."""
        if self._found is None or self._found.whole is None:
            return
        try:
            write_as_built(self._found.whole, path)
        except P2SFError as error:
            self._store.refused.emit(error.message)
            return
        for message in (Message("Saved {name}", name=Path(path).name), *left_out(self._found.whole, path)):
            self._store.said.emit(message)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        for part in (self.chart, self.list, self.table):
            part.restyle(theme)


def _row(parts: Sequence[QWidget]) -> QHBoxLayout:
    """Return controls beside each other, from the left."""
    row = QHBoxLayout()
    row.setSpacing(4)
    for part in parts:
        row.addWidget(part)
    row.addStretch(1)
    return row


class MeasuredBody(QWidget):
    """Pictures above list and numbers; where that is too low, pictures beside the numbers, without the list."""

    def __init__(self, chart: TilesChart, points: "PointList", table: FactTable):
        super().__init__()
        self.list = points
        self._whole = QBoxLayout(QBoxLayout.Direction.TopToBottom, self)
        self._whole.setContentsMargins(0, 0, 0, 0)
        below = QHBoxLayout()
        below.setSpacing(12)
        below.addWidget(points, 1)
        below.addWidget(in_scroll_area(table, at_foot=False), 1)
        self._whole.addWidget(chart, 2)
        self._whole.addLayout(below, 3)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Turn to where there is room."""
        super().resizeEvent(event)
        low = self.height() < LOW
        self.list.setHidden(low)
        direction = QBoxLayout.Direction.LeftToRight if low else QBoxLayout.Direction.TopToBottom
        self._whole.setDirection(direction)


class PointList(PlainTable):
    """The points, one row each, of which one is chosen."""

    def __init__(self) -> None:
        super().__init__(HEADS, "Points")

    def show_lines(self, lines: tuple[PointLine, ...]) -> None:
        """Show a row for each point, and choose the first."""
        self.blockSignals(True)
        self.setRowCount(len(lines))
        for row, (figures, why) in enumerate(lines):
            for column, text in enumerate(figures):
                self.put(row, column, f"  {local(text)}", right=True)  # columns are as wide as their texts
            self.put(row, len(figures), said(why) if why else "")
        self.blockSignals(False)
        self.selectRow(0)

    def chosen(self) -> int | None:
        """Return the number of the chosen point, None without one."""
        rows = self.selectionModel().selectedRows()
        return rows[0].row() if rows else None
