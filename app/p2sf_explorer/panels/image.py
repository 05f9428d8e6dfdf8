"""A photo or chart through the present lens: coarse at once, planned when the sliders rest; why, when asked."""

from functools import partial
from pathlib import Path

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QLabel

from p2sf.errors import P2SFError
from p2sf_explorer.charts.overlay import Overlay
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.files.snapshot import side_car, write_state
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr, unbroken
from p2sf_explorer.results.image import (
    ImageRequest,
    ImageResult,
    coarse,
    fine_enough,
    local_psf,
    pixels,
    planned,
    same_optics,
    save_picture,
    work,
)
from p2sf_explorer.results.photos import CHART_WORDS
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import SideCard, chooser, select
from p2sf_explorer.widgets.drop import PhotoDrop
from p2sf_explorer.widgets.plan_note import PlanLine, Why, small_button
from p2sf_explorer.widgets.split_view import SplitView
from p2sf_explorer.workers.worker import LatestWins

TIP = (
    "Image: Σ over the scene's points of brightness × PSF at that point, for red, green and blue; "
    "distortion and falling light included."
)
PIXELS = {"4.0": "4 µm pixels", "8.0": "8 µm pixels", "16.0": "16 µm pixels", "32.0": "32 µm pixels", "": "whole field"}
SHOWS = {
    "lens": ("through the lens", ("scene", "image")),
    "sharpened": ("sharpened by its PSFs", ("image", "sharpened")),
    "axis": ("by the axis's PSF", ("image", "sharpened wrongly")),
}
PHOTOS = "Pictures (*.png *.tif *.tiff)"
WORKING, NONE = "earlier picture, working", "no picture"


class ImagePanel:
    """The picture with its split, details and loupe; controls beside it, and the plan in words behind "Why…"."""

    def __init__(self, store: Store):
        self._store = store
        self.widget = SideCard("Image", TIP)
        self.photo = chooser(tuple(CHART_WORDS.items()), "What stands before the lens", self.widget)
        self.pixel = chooser(tuple(PIXELS.items()), "Pixels at the field point, or the field", self.widget)
        self.show_box = chooser(tuple((k, v[0]) for k, v in SHOWS.items()), "Which picture is made", self.widget)
        self.open = small_button("Photo…", "Choose a PNG or TIFF to photograph", self._ask_photo)
        self.save = small_button("Save…", "Save the picture as PNG or TIFF, the state beside it", self._ask_save)
        self.split_view, self.headline, self.plan_line, self.words = SplitView(), QLabel(), PlanLine(), Why()
        self.overlay = Overlay(self.split_view)
        self._lay_out()
        self._connect()
        self._asked: ImageRequest | None = None
        self._answer: ImageResult | None = None
        self._planned: ImageResult | None = None  # the last one by a plan
        self._ordered: ImageRequest | None = None  # what a plan is being made for,
        self._stopped: ImageRequest | None = None  # what it was cancelled for,
        self._unplanned: ImageRequest | None = None  # and what none could be made for, so that none is tried again
        self._refusal = ""
        self._settled, self._place = True, (0.5, 0.5)
        self.quick, self.fine = LatestWins(self.widget), LatestWins(self.widget)
        for worker in (self.quick, self.fine):
            worker.finished.connect(self._on_answer)
            worker.failed.connect(self._on_failure)
        self.fine.progressed.connect(lambda key, share: key == self._ordered and self.plan_line.tell(share))

    def _lay_out(self) -> None:
        for line in ((self.photo, self.open), (self.pixel,), (self.show_box,), (self.words.button, self.save)):
            self.widget.add_line(*line)
        self.headline.setObjectName("muted")
        self.headline.setWordWrap(True)
        self.headline.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.widget.add_line(self.plan_line)
        self.widget.add_rest(self.headline)
        self.widget.set_body(self.split_view)

    def _connect(self) -> None:
        store = self._store
        self.photo.activated.connect(lambda: store.update(photo=self.photo.currentData()))
        self.show_box.activated.connect(lambda: store.update(photo_show=self.show_box.currentData()))
        self.pixel.activated.connect(self._choose_pixel)
        self.plan_line.turned.connect(self._turn)
        self.split_view.taken.connect(store.begin)
        self.split_view.released.connect(store.end)
        self.split_view.moved.connect(lambda part: store.update(photo_split=part))
        self.split_view.looked.connect(self._look)
        self.drop = PhotoDrop(self.widget)
        self.drop.photo.connect(lambda path: store.update(photo=path))
        self.drop.refused.connect(store.refused)

    def show(self, live: Live) -> None:
        """Follow the state; ask the worker for a picture when anything it depends on has changed."""
        asked, state = live.views["image"], live.state
        self._settled = live.quality == "settled"
        self._show_choices(state)
        self.split_view.show_split(state.photo_split)
        if asked != self._asked:
            self._asked = asked
            self._call_off()
            self.quick.submit(asked, work(self._quickest(asked), asked))
        elif self._settled:
            self._refine()
        self._show_readout()

    def _show_choices(self, state) -> None:
        if self.photo.findData(state.photo) < 0:
            self.photo.addItem(Path(state.photo).name, state.photo)
        size = "" if state.photo_pixel_um is None else str(float(state.photo_pixel_um))
        if self.pixel.findData(size) < 0:
            self.pixel.addItem(f"{state.photo_pixel_um:g} µm pixels", size)
        for box, value in ((self.photo, state.photo), (self.pixel, size), (self.show_box, state.photo_show)):
            select(box, value)

    def _quickest(self, asked: ImageRequest):
        """Return what makes a picture at once: the plan there is, where only the photo or what is shown is another."""
        known = self._planned
        return partial(planned, known=known) if known and same_optics(known.question, asked) else coarse

    def _stale(self) -> bool:
        return self._answer is None or self._answer.question != self._asked

    def _refine(self) -> None:
        """Have the planned picture made, once, where the coarse one is there and a plan is affordable."""
        if self._stale() or self._asked in (self._ordered, self._stopped, self._unplanned):
            return
        if self._answer.quality == "coarse" and fine_enough(self._answer):
            self._ordered = self._asked
            self.plan_line.begin()
            self.fine.submit(self._asked, work(planned, self._asked))

    def _turn(self) -> None:
        """Stop the plan on its way; where one was stopped, have it made after all."""
        if self._ordered:
            self._stopped = self._asked
            self._call_off()
        else:
            self._stopped = None
            self._refine()
        self._show_readout()

    def _call_off(self) -> None:
        self._ordered = None
        self.fine.cancel()

    def _show_readout(self) -> None:
        doing, stopped = self._ordered is not None, self._stopped == self._asked
        self.widget.set_readout(self._quality())
        for button in (self.words.button, self.save):  # in a drag the earlier picture keeps them, and the keys on them
            button.setEnabled(self._quality() not in ("working", NONE))
        self.overlay.say(self._refusal if self._stale() and self._unplanned == self._asked else "", 0)
        self.plan_line.show_stage(doing, stopped)
        self.headline.setHidden(doing or stopped or bool(self.overlay.text))

    def _quality(self) -> str:
        if not self._stale():
            return self._answer.quality
        return NONE if self._unplanned == self._asked else WORKING if self._answer else "working"

    def _on_answer(self, key: ImageRequest, found: ImageResult) -> None:
        if found.quality == "planned":
            self._planned = found if found.plan.decisions else None
            self._ordered = None if key == self._ordered else self._ordered
            self._stopped = None if key == self._stopped else self._stopped  # it came all the same
        if key == self._asked or self._stale():  # a plan of before, late to stop, must not cover the present picture
            self._answer = found
            self._paint()
        if self._settled:
            self._refine()
        self._show_readout()

    def _on_failure(self, key: ImageRequest, sentence: str) -> None:
        if key != self._asked:
            return
        self._ordered, self._unplanned, self._refusal = None, key, said(sentence)
        if not self._stale():  # the coarse picture is there, and stays
            self._say(self._refusal)
        self._show_readout()

    def _say(self, words: str) -> None:
        """Show a few words under the controls; the whole of them as a tooltip, should they not fit."""
        self.headline.setText(unbroken(tr(words)))
        self.headline.setToolTip(tr(words))

    def _paint(self) -> None:
        found = self._answer
        self.split_view.show_pictures(pixels(found.before), pixels(found.after), SHOWS[found.question.show][1])
        sensor = found.plan.scene.sensor
        wide = f"{sensor.columns} × {sensor.rows} pixels of {sensor.pixel_um:.3g} µm"
        many = f"{said(found.headline)} · {found.seconds:.2g} s"
        reasons = (said(reason) for reason in (found.cut, found.no_plan) if reason)
        self._say("\n".join((*reasons, many, wide)))
        self.words.tell(found.notes)
        rows, columns = found.after.shape[:2]
        self._look(self._place[0] * (rows - 1), self._place[1] * (columns - 1))

    def _look(self, row: float, column: float) -> None:
        """Show the PSF under the pointer."""
        if self._answer:
            rows, columns = self._answer.after.shape[:2]
            self._place = row / (rows - 1), column / (columns - 1)
            self.split_view.show_loupe(pixels(np.sqrt(local_psf(self._answer, row, column))), (row, column))

    def _choose_pixel(self) -> None:
        size = self.pixel.currentData()
        self._store.update(photo_pixel_um=float(size) if size else None)

    def _ask_photo(self) -> None:
        path, _ = QFileDialog.getOpenFileName(self.widget, "Choose a photo", "", PHOTOS)
        if path:
            self._store.update(photo=path)

    def _ask_save(self) -> None:
        path, _ = QFileDialog.getSaveFileName(self.widget, "Save the picture", "image.png", PHOTOS)
        if path:
            self.save_as(path if Path(path).suffix else f"{path}.png")

    def save_as(self, path: str) -> None:
        """Save the picture and beside it the state; a refusal is one sentence."""
        if self._stale():  # the picture on screen is none of the state that would lie beside it
            self._store.refused.emit("there is no picture yet; save it when it is on screen")
            return
        try:
            save_picture(self._answer, path)
            write_state(self._store.state, side_car(path), exported=Path(path).name)
        except P2SFError as error:
            self._store.refused.emit(str(error))
        else:
            self._store.said.emit(f"Saved {Path(path).name}, and its state as {side_car(path).name}")

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.split_view.restyle(theme)

    def stop(self) -> None:
        """End the workers' threads."""
        for worker in (self.quick, self.fine):
            worker.stop()
