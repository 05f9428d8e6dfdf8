"""A photo or chart through the present lens: coarse at once, planned when the sliders rest; why, when asked."""

from html import escape
from pathlib import Path

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QLabel, QMenu, QSizePolicy, QToolButton, QWidgetAction

from app.card import Card, chooser, select
from app.compute import Live
from app.dropping import PhotoDrop
from app.scenery import CHART_WORDS
from app.snapshot import side_car, write_state
from app.store import Store
from app.theme import Tokens
from app.views.image import Answer, Question, coarse, fine_enough, local_psf, pixels, planned, save_picture, work
from app.wipe import Wipe
from app.words import tr
from app.worker import LatestWins
from p2sf.errors import P2SFError

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
WORDS_PX = 480
WORKING = "earlier picture, working"


class ImagePanel:
    """The picture with its split, details and loupe; one line under it, and the plan in words behind "Why…"."""

    def __init__(self, store: Store):
        self._store = store
        self.widget = Card("Image", TIP)
        self.photo = chooser(tuple(CHART_WORDS.items()), "What stands before the lens", self.widget)
        self.pixel = chooser(tuple(PIXELS.items()), "Pixels at the field point, or the field", self.widget)
        self.show_box = chooser(tuple((k, v[0]) for k, v in SHOWS.items()), "Which picture is made", self.widget)
        self.open = small_button("Photo…", "Choose a PNG or TIFF to photograph", self._ask_photo)
        self.why = small_button(
            "Why…", "Why the picture is computed in this way: the plan's decisions, each with its error"
        )
        self.save = small_button("Save…", "Save the picture as PNG or TIFF, the state beside it", self._ask_save)
        self.wipe, self.headline, self.words = Wipe(), QLabel(), QLabel()
        self._lay_out()
        self._connect()
        self._asked: Question | None = None
        self._answer: Answer | None = None
        self._unplanned: Question | None = None  # what no plan could be made for, so that none is tried again
        self._settled, self._place = True, (0.5, 0.5)
        self.quick, self.fine = LatestWins(self.widget), LatestWins(self.widget)
        for worker in (self.quick, self.fine):
            worker.finished.connect(self._on_answer)
            worker.failed.connect(self._on_failure)

    def _lay_out(self) -> None:
        for tool in (self.photo, self.open, self.pixel, self.show_box, self.why, self.save):
            self.widget.add_tool(tool)
        self.headline.setObjectName("muted")
        self.headline.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.words.setObjectName("fact")
        self.words.setTextFormat(Qt.TextFormat.RichText)
        self.words.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.words.setWordWrap(True)
        self.words.setFixedWidth(WORDS_PX)
        self.words.setMargin(10)
        fold, shown = QMenu(self.why), QWidgetAction(self.why)
        shown.setDefaultWidget(self.words)
        fold.addAction(shown)
        self.why.setMenu(fold)
        self.why.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.widget.set_body(self.wipe)
        self.widget.add_footer(self.headline)

    def _connect(self) -> None:
        store = self._store
        self.photo.activated.connect(lambda: store.update(photo=self.photo.currentData()))
        self.show_box.activated.connect(lambda: store.update(photo_show=self.show_box.currentData()))
        self.pixel.activated.connect(self._choose_pixel)
        self.wipe.taken.connect(store.begin)
        self.wipe.released.connect(store.end)
        self.wipe.moved.connect(lambda part: store.update(photo_split=part))
        self.wipe.looked.connect(self._look)
        self.drop = PhotoDrop(self.widget)
        self.drop.photo.connect(lambda path: store.update(photo=path))
        self.drop.refused.connect(store.refused)

    def show(self, live: Live) -> None:
        """Follow the state; ask the worker for a picture when anything it depends on has changed."""
        asked, state = live.views["image"], live.state
        self._settled = live.quality == "settled"
        self._show_choices(state)
        self.wipe.show_split(state.photo_split)
        if asked != self._asked:
            self._asked = asked
            self.fine.cancel()
            self.quick.submit(asked, work(coarse, asked))
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

    def _stale(self) -> bool:
        return self._answer is None or self._answer.question != self._asked

    def _refine(self) -> None:
        """Have the planned picture made, once, where the coarse one is there and a plan is affordable."""
        if self._stale() or self._asked == self._unplanned or self.fine.busy:
            return
        if self._answer.quality == "coarse" and fine_enough(self._answer):
            self.fine.submit(self._asked, work(planned, self._asked))

    def _show_readout(self) -> None:
        if self._answer is None:
            self.widget.set_readout("working")
            return
        doing = " · planning" if self.fine.busy else ""
        self.widget.set_readout(WORKING if self._stale() else f"{self._answer.quality}{doing}")

    def _on_answer(self, key: Question, found: Answer) -> None:
        if key == self._asked or self._stale():  # a plan of before, late to stop, must not cover the present picture
            self._answer = found
            self._paint()
        if self._settled:
            self._refine()
        self._show_readout()

    def _on_failure(self, key: Question, sentence: str) -> None:
        if key == self._asked:
            self._say(sentence[0].upper() + sentence[1:])
            if self._stale():
                self.widget.set_readout("no picture")
            else:  # the coarse picture is there, and stays
                self._unplanned = key
                self._show_readout()

    def _say(self, words: str) -> None:
        """Show one line under the picture; the whole of it as a tooltip, should it not fit."""
        self.headline.setText(tr(words))
        self.headline.setToolTip(tr(words))

    def _paint(self) -> None:
        found = self._answer
        self.wipe.show_pictures(pixels(found.before), pixels(found.after), SHOWS[found.question.show][1])
        sensor = found.plan.scene.sensor
        wide = f"{sensor.columns} × {sensor.rows} pixels of {sensor.pixel_um:.3g} µm"
        self._say(f"{found.headline} · {found.seconds:.2g} s · {wide}")
        lines = (
            f"<p><b>{escape(what, quote=False)}</b> {escape(sentence, quote=False)}</p>"
            for what, sentence in found.words
        )
        self.words.setText(tr("".join(lines)))
        self.words.adjustSize()
        rows, columns = found.after.shape[:2]
        self._look(self._place[0] * (rows - 1), self._place[1] * (columns - 1))

    def _look(self, row: float, column: float) -> None:
        """Show the PSF under the pointer."""
        if self._answer:
            rows, columns = self._answer.after.shape[:2]
            self._place = row / (rows - 1), column / (columns - 1)
            self.wipe.show_loupe(pixels(np.sqrt(local_psf(self._answer, row, column))), (row, column))

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
        if self._answer is None:
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
        self.wipe.restyle(theme)

    def stop(self) -> None:
        """End the workers' threads."""
        for worker in (self.quick, self.fine):
            worker.stop()


def small_button(text: str, tip: str, action=None) -> QToolButton:
    """Return a small button; without an action it opens a menu."""
    made = QToolButton()
    made.setObjectName("small")
    made.setText(tr(text))
    made.setToolTip(tr(tip))
    made.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    if action:
        made.clicked.connect(action)
    return made
