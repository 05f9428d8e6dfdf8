"""The row of controls that says which surface is the stop and whether rims clip."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QWidget

from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import chooser, select

STOP_TIP = "Stop: the surface whose rim limits the light; named by the lens file, or found as the smallest |rim/y|."
CLIP_TIP = "Clip: rays beyond a clear semi-diameter are lost, which vignettes the pupil off axis."
CHOICES = (("file", "as in the file"), ("auto", "found"))


class StopRow(QWidget):
    """Chooser and check box; they tell the store and follow the state."""

    def __init__(self, store: Store, parent=None):
        super().__init__(parent)
        name = QLabel(tr("Stop"), self)
        name.setToolTip(tr(STOP_TIP))
        self.stop = chooser(CHOICES, STOP_TIP, self)
        self.clip = QCheckBox(tr("Clip at rims"), self)
        self.clip.setToolTip(tr(CLIP_TIP))
        self.stop.activated.connect(lambda: store.update(stop=self.stop.currentData()))
        self.clip.toggled.connect(lambda on: store.update(clip=on))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(name)
        row.addWidget(self.stop)
        row.addStretch(1)
        row.addWidget(self.clip, 0, Qt.AlignmentFlag.AlignRight)

    def show_state(self, state) -> None:
        """Follow a state; no signal goes back."""
        select(self.stop, state.stop)
        if self.clip.isChecked() != state.clip:
            self.clip.blockSignals(True)
            self.clip.setChecked(state.clip)
            self.clip.blockSignals(False)
