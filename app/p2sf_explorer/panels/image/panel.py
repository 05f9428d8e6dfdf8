"""A photo or chart through the present lens: coarse at once, planned when the sliders rest, with the reasons."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QFileDialog, QLabel, QVBoxLayout, QWidget

from p2sf.errors import P2SFError
from p2sf.image.progress import Progress
from p2sf.messages import Message
from p2sf_explorer.charts.overlay import Overlay
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.depths import OWN, has_own_depths
from p2sf_explorer.compute.views.image import (
    TAKEN,
    ImageRequest,
    ImageResult,
    coarse,
    fine_enough,
    local_psf,
    on_stage,
    pixels,
    planned_picture,
    same_optics,
    save_picture,
    work,
)
from p2sf_explorer.compute.views.moving_image import Keeper, moving
from p2sf_explorer.compute.views.photos import CHART_WORDS
from p2sf_explorer.files.asking import ask_path
from p2sf_explorer.files.embedded_state import KEYWORD
from p2sf_explorer.files.snapshot import check_snapshot, saved, state_text
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr, unbroken
from p2sf_explorer.panels.image.depth_row import DepthRow
from p2sf_explorer.panels.image.split_view import SplitView
from p2sf_explorer.state.state import State
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import TurningCard, chooser, select
from p2sf_explorer.widgets.drop import PhotoDrop
from p2sf_explorer.widgets.empty_state import EmptyState
from p2sf_explorer.widgets.plan_note import PlanLine, Why, small_button

TIP = (
    "Image: Σ over the scene's points of brightness × PSF at that point, for red, green and blue; "
    "distortion and falling light included."
)
PIXELS = {"4.0": "4 µm pixels", "8.0": "8 µm pixels", "16.0": "16 µm pixels", "32.0": "32 µm pixels", "": "whole field"}
RESIZED_MS = 300  # after the last change of the panel's size, the picture is made for its new pixels
FULL = "full"  # the choice of every pixel of the photo
LOOKS = {"split": "split", "side": "side by side", "blink": "blink"}
SHOWS: dict[str, tuple[str, tuple[str, str]]] = {
    "lens": ("through the lens", ("scene", "image")),
    "sharpened": ("sharpened by its PSFs", ("image", "sharpened")),
    "axis": ("by the axis's PSF", ("image", "sharpened wrongly")),
    "taken": ("photo it took, sharpened", ("photo", "sharpened")),
    "psfs": ("its PSFs, as a map", ("image", "PSFs, √")),
}
PHOTOS = "Pictures (*.png *.tif *.tiff *.exr *.jpg *.jpeg *.heic *.heif)"
SAVED = "Pictures (*.png *.tif *.tiff)"
SAMPLE = {"photo_source": "landscape", "photo_depths": "slope", "photo_near_mm": 1000.0, "photo_far_mm": 10000.0}
SAMPLE_TIP = "A landscape that reaches from 1 m to 10 m: move the focus through it"
EARLIER, WORKING, NONE = "earlier picture, working", "working", "no picture"


class ImagePanel:
    """The picture with its split, details and PSF; beside or above it controls, and the plan in words behind "Why…"."""

    def __init__(self, store: Store):
        self._store = store
        self.widget = TurningCard("Image", TIP)
        self.photo = chooser(tuple(CHART_WORDS.items()), "What stands in front of the lens", self.widget)
        sizes = (*PIXELS.items(), (FULL, "every pixel"))
        self.pixel = chooser(sizes, "Pixels at the field point, or the field", self.widget)
        self.look = chooser(tuple(LOOKS.items()), "How the two pictures are compared", self.widget)
        self.show_box = chooser(tuple((k, v[0]) for k, v in SHOWS.items()), "Which picture is made", self.widget)
        self.open = small_button(
            "Photo…", "Choose a PNG, TIFF, OpenEXR, JPEG or HEIF to photograph, up to 12 megapixels", self._ask_photo
        )
        self.save = small_button("Save…", "Save the picture as PNG or TIFF, with the state in it", self._ask_save)
        self.depth_row = DepthRow(store, self.widget)
        self.split_view, self.headline, self.plan_line, self.words = SplitView(), QLabel(), PlanLine(), Why()
        self.overlay = Overlay(self.split_view)
        buttons = (
            small_button("Photo…", "Choose another photo", self._ask_photo),
            small_button("Try a sample", SAMPLE_TIP, lambda: store.update(**SAMPLE)),
        )
        self.empty = EmptyState(tr("Drop a photo here"), "", buttons)
        self._lay_out()
        self._connect()
        self._live: Live | None = None
        self._asked: ImageRequest | None = None
        self._answer: ImageResult | None = None
        self._planned: ImageResult | None = None  # the last that was made by a plan
        self._ordered: ImageRequest | None = None  # for which a plan is being made,
        self._stopped: ImageRequest | None = None  # for which one was cancelled,
        self._unplanned: ImageRequest | None = None  # and for which none can be made, so that none is tried again
        self._refusal = ""
        self._settled, self._place = True, (0.5, 0.5)
        self._before, self._before_pixels = np.empty(0), np.empty(0)
        self._keeper = Keeper()
        self.quick, self.fine = LateAnswers(self.widget), LateAnswers(self.widget)
        for worker in (self.quick, self.fine):
            worker.finished.connect(self._on_answer)
            worker.failed.connect(self._on_failure)
        self.fine.progressed.connect(self._on_progress)

    def _lay_out(self) -> None:
        looking = (self.look, self.words.button, self.save)
        sensor = self.pixel, self.depth_row.source
        for group in ((self.photo, self.open), sensor, (self.show_box,), looking, self.depth_row.scale):
            self.widget.add_group(*group)
        self.headline.setObjectName("muted")
        self.headline.setWordWrap(True)
        self.headline.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.widget.add_line(self.plan_line)
        self.widget.add_rest(self.headline)
        body = QWidget()
        column = QVBoxLayout(body)
        column.setContentsMargins(0, 0, 0, 0)
        for part in (self.split_view, self.empty):
            column.addWidget(part, 1)
        self.widget.set_body(body)

    def _connect(self) -> None:
        store = self._store
        self.photo.activated.connect(lambda: store.update(photo_source=self.photo.currentData()))
        self.pixel.activated.connect(self._choose_pixel)
        self.widget.bind(store, photo_show=self.show_box, photo_look=self.look)
        self.plan_line.turned.connect(self._turn)
        self.split_view.taken.connect(store.begin)
        self.split_view.released.connect(store.end)
        self.split_view.moved.connect(lambda part: store.update(photo_split=part))
        self.split_view.looked.connect(self._look)
        self._resized = QTimer(self.widget, singleShot=True, interval=RESIZED_MS)
        self._resized.timeout.connect(self._on_resized)
        self.split_view.resized.connect(self._resized.start)
        self.drop = PhotoDrop(self.widget)
        self.drop.photo.connect(self.take_photo)
        self.drop.refused.connect(store.refused)

    def show(self, live: Live) -> None:
        """Follow the state; ask the worker for a picture when anything it depends on has changed."""
        self._live = live
        asked = on_stage(live.views["image"].question, self.split_view.room())
        state = live.state
        self._settled = live.quality == "settled"
        self._show_choices(state)
        self.split_view.show_split(state.photo.split)
        self.split_view.show_look(state.photo.look)
        if asked != self.quick.asked:
            self._asked = asked
            self._call_off()
            self.quick.submit(asked, work(self._quickest(asked), asked))
        elif self._settled:
            self._refine()
        self._show_readout()

    def _on_resized(self) -> None:
        if self._live and self._live.quality == "settled":
            self.show(self._live)

    def _show_choices(self, state: State) -> None:
        if self.photo.findData(state.photo.source) < 0:
            self.photo.addItem(Path(state.photo.source).name, state.photo.source)
        pitch = state.photo.pixel_um
        all_of_it = state.photo.full and (pitch is None or state.photo.show == TAKEN)
        size = FULL if all_of_it else "" if pitch is None else str(float(pitch))
        if self.pixel.findData(size) < 0:
            self.pixel.addItem(tr("{pitch} µm pixels", pitch=f"{pitch:g}"), size)
        select(self.photo, state.photo.source)
        self.depth_row.show(state)
        select(self.pixel, size)

    def _quickest(self, asked: ImageRequest) -> Callable[[ImageRequest, Progress], ImageResult]:
        """Return what makes a picture at once: the known plan, where only the photo or what is shown has changed."""
        known = self._planned
        if known and same_optics(known.question, asked):
            return partial(planned_picture, known=known)
        return partial(moving, keeper=self._keeper) if asked.show == "lens" else coarse

    def _present(self) -> ImageResult | None:
        """Return the picture on screen where it is the present question's."""
        return self._answer if self._answer and self._answer.question == self._asked else None

    def _stale(self) -> bool:
        return self._present() is None

    def _refine(self) -> None:
        """Have the planned picture made, once, where the coarse one is there and a plan is affordable."""
        asked, answer = self._asked, self._present()
        if asked is None or answer is None or asked in (self._ordered, self._stopped, self._unplanned):
            return
        if answer.quality == "coarse" and fine_enough(answer):
            self._ordered = asked
            self.plan_line.begin()
            self.fine.submit(asked, work(planned_picture, asked))

    def _turn(self) -> None:
        """Stop the plan that is being made, or make the one that was stopped."""
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
        planning, stopped, quality = self._ordered is not None, self._stopped == self._asked, self._quality()
        self.widget.set_readout(self._badge(quality))
        for button in (self.words.button, self.save):  # enabled in a drag too, so that they keep the focus
            button.setEnabled(quality not in (WORKING, NONE))
        self.overlay.say(tr("The first picture is being made …") if quality == WORKING else "", 0)
        self.split_view.setVisible(quality != NONE)
        self.empty.setVisible(quality == NONE)
        self.empty.words.setText(self._refusal)
        self.plan_line.show_plan(planning, stopped)
        self.headline.setHidden(planning or stopped or quality in (WORKING, NONE))

    def _badge(self, quality: str) -> str:
        """Return what the picture on screen is, and the error expected of it where that is known."""
        if self._answer is None or self._answer.error is None or quality in (WORKING, NONE):
            return tr(quality)
        off = tr("error up to {percent} % of white", percent=f"{100 * self._answer.error:.2g}")
        return f"{tr(quality)} · {off}"

    def _quality(self) -> str:
        """Return what the picture on screen is, in English."""
        if answer := self._present():
            return answer.quality
        return NONE if self._unplanned == self._asked else EARLIER if self._answer else WORKING

    def _on_answer(self, key: ImageRequest, found: ImageResult) -> None:
        if found.quality == "planned":
            self._planned = found if found.plan.decisions else None
            self._ordered = None if key == self._ordered else self._ordered
            self._stopped = None if key == self._stopped else self._stopped  # it was made all the same
        if self._answer and found.psfs is None and key == self._answer.question:
            found = replace(found, psfs=self._answer.psfs)
        if key == self._asked or self._stale():  # an earlier plan, late to stop, must not cover the present picture
            self._answer = found
            self._paint(found)
        if self._settled:
            self._refine()
        self._show_readout()

    def _on_failure(self, key: ImageRequest, why: Message) -> None:
        if key != self._asked:
            return
        self._ordered, self._unplanned, self._refusal = None, key, said(why)
        if not self._stale():  # the coarse picture is there, and stays
            self._say(self._refusal)
        self._show_readout()

    def _on_progress(self, key: ImageRequest, share: float) -> None:
        if key == self._ordered:
            self.plan_line.show_progress(share)

    def _say(self, text: str) -> None:
        """Show a text under the controls; its tooltip has the whole of it where it does not fit."""
        self.headline.setText(unbroken(text))
        self.headline.setToolTip(text)

    def _paint(self, found: ImageResult) -> None:
        before, after = SHOWS[found.question.show][1]
        if found.before is not self._before:  # which stays the same in a drag
            self._before, self._before_pixels = found.before, pixels(found.before)
        self.split_view.show_pictures(self._before_pixels, found.painted, (tr(before), tr(after)))
        sensor = found.plan.scene.sensor
        pitch = f"{sensor.pixel_um:.3g}"
        size = tr("{columns} × {rows} pixels of {pitch} µm", columns=sensor.columns, rows=sensor.rows, pitch=pitch)
        count = f"{said(found.headline)} · {found.seconds:.2g} s"
        reasons = (said(why) for why in (found.cut, found.no_plan, *found.alike) if why)
        self._say(local("\n".join((*reasons, count, size))))
        self.words.show_notes(found.notes)
        rows, columns = found.after.shape[:2]
        self._look(self._place[0] * (rows - 1), self._place[1] * (columns - 1))

    def _look(self, row: float, column: float) -> None:
        """Show the PSF under the pointer."""
        if self._answer:
            rows, columns = self._answer.after.shape[:2]
            self._place = row / (rows - 1), column / (columns - 1)
            self.split_view.show_psf(pixels(np.sqrt(local_psf(self._answer, row, column))), (row, column))

    def _choose_pixel(self) -> None:
        size = self.pixel.currentData()
        full = size == FULL
        if full and self._store.state.photo.show == TAKEN:  # whose pixels are as large as before
            self._store.update(photo_full=True)
            return
        self._store.update(photo_pixel_um=float(size) if size and not full else None, photo_full=full)

    def _ask_photo(self) -> None:
        path, _ = QFileDialog.getOpenFileName(self.widget, tr("Choose a photo"), "", tr(PHOTOS))
        if path:
            self.take_photo(path)

    def take_photo(self, path: str) -> None:
        """Show a photo, with the depths that it brings with it."""
        depths = self._store.state.photo.depths
        self._store.update(
            photo_source=path, photo_depths=OWN if has_own_depths(path) else "" if depths == OWN else depths
        )

    def _ask_save(self) -> None:
        if path := ask_path(self.widget, tr("Save the picture"), "image.png", tr(SAVED)):
            self.save_as(path)

    def save_as(self, path: str) -> None:
        """Save the picture with the state in it, or say why not."""
        answer = self._present()
        if answer is None:  # the picture on screen belongs to another state than the one that would be saved
            self._store.refused.emit(Message("there is no picture yet; save it when it is on screen"))
            return
        try:
            check_snapshot(self._store.state, path)
            save_picture(answer, path, {KEYWORD: state_text(self._store.state)})
        except P2SFError as error:
            self._store.refused.emit(error)
        else:
            self._store.said.emit(saved(path))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.split_view.restyle(theme)
