"""The controls of the depths of a photo: where they come from, and what the numbers of a map mean."""

from pathlib import Path

from PySide6.QtWidgets import QFileDialog, QWidget

from p2sf.io.depth_files import UNITS
from p2sf_explorer.compute.views.depths import DEPTH_WORDS, FLAT, OWN, SLOPE, STEPS, WITH_DEPTHS
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.state import State
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import chooser, select
from p2sf_explorer.widgets.value_edit import NumberBox

MEANING_WORDS = {"near_white": "white is near", "near_black": "black is near", "mm": "in mm", "m": "in m"}
TIP = "How far away the parts of the picture are: one distance, nearer towards the bottom, three steps to the right …"
ONE_ONLY = "What is shown has the PSFs of one distance; show through the lens, or sharpened by its PSFs, to use depths"
MAPS = "Maps of depths (*.png *.tif *.tiff)"
MM_PER_M = 1000.0
ANOTHER = "another"  # among the choices: asks for a file
NEAREST_M, FARTHEST_M = 0.001, 1e6


class DepthRow:
    """A chooser of depths, ``source``, and what the numbers of a map mean, ``scale``, where that matters."""

    def __init__(self, store: Store, parent: QWidget) -> None:
        self._store, self._parent = store, parent
        self.source = chooser((*DEPTH_WORDS.items(), (ANOTHER, "map…")), TIP, parent)
        self.meaning = chooser(tuple(MEANING_WORDS.items()), "What the numbers of the map mean", parent)
        self.near, self.far = (_distance(*words) for words in (("near", "Nearest depth"), ("far", "Farthest depth")))
        self.scale = self.meaning, self.near, self.far
        self.source.activated.connect(self._choose)
        self.meaning.activated.connect(lambda: store.update(photo_depth_meaning=self.meaning.currentData()))
        self.near.valueChanged.connect(lambda value: store.update(photo_near_mm=MM_PER_M * value))
        self.far.valueChanged.connect(lambda value: store.update(photo_far_mm=MM_PER_M * value))

    def show(self, state: State) -> None:
        """Follow a state; what has no meaning there is hidden."""
        photo = state.photo
        if self.source.findData(photo.depths) < 0:
            self.source.addItem(Path(photo.depths).name, photo.depths)
        select(self.source, photo.depths)
        select(self.meaning, photo.depth_meaning)
        usable = photo.show in WITH_DEPTHS
        self.source.setToolTip(tr(TIP) if usable else tr(ONE_ONLY))
        for control in (self.source, *self.scale):
            control.setEnabled(usable)
        for box, value in ((self.near, photo.near_mm), (self.far, photo.far_mm)):
            box.blockSignals(True)
            box.setValue(value / MM_PER_M)
            box.blockSignals(False)
        of_file = photo.depths not in (FLAT, OWN, SLOPE, STEPS)
        self.meaning.setVisible(of_file)
        spans = photo.depths in (SLOPE, STEPS) or (of_file and photo.depth_meaning not in UNITS)
        for box in (self.near, self.far):
            box.setVisible(spans)

    def _choose(self) -> None:
        chosen = self.source.currentData()
        if chosen != ANOTHER:
            self._store.update(photo_depths=chosen)
            return
        self.show(self._store.state)
        path, _ = QFileDialog.getOpenFileName(self._parent, tr("Choose a map of depths"), "", tr(MAPS))
        if path:
            self._store.update(photo_depths=path)


def _distance(name: str, words: str) -> NumberBox:
    """Return a box of metres with its name before the number."""
    box = NumberBox()
    box.setRange(NEAREST_M, FARTHEST_M)
    box.setDecimals(3)
    box.setPrefix(f"{tr(name)} ")
    box.setSuffix(" m")
    box.setToolTip(tr(words))
    box.setAccessibleName(tr(words))
    return box
