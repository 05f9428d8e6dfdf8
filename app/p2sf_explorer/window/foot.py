"""The line under the stage: the button that plays a slider, and a sentence on what the picture shows."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QToolButton, QWidget

from p2sf_explorer.charts.theme import SPACE, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr, unbroken
from p2sf_explorer.widgets.readout import Sentence

PLAY = "Play the slider that moved last (Ctrl+Space; Space on a slider plays that one)"
LINES = 2  # kept free, so that another sentence moves nothing


class Foot(QWidget):
    """Says what blurs most, or at the first start what there is to see (`tell`)."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.sentence = Sentence(self)
        self.sentence.setObjectName("sentence")
        self.sentence.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._dominant, self._story = "", ""
        self.play = QToolButton(self)
        self.play.setObjectName("play")
        self.play.setToolTip(tr(PLAY))
        self.play.setAccessibleName(tr(PLAY))
        kept = self.play.sizePolicy()
        kept.setRetainSizeWhenHidden(True)  # so that the sentence stays where it is
        self.play.setSizePolicy(kept)
        self.show_playing(False)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, SPACE, 0)
        row.addWidget(self.play)
        row.addWidget(self.sentence, 1)

    def show_playing(self, on: bool) -> None:
        """Show whether a slider plays."""
        self.play.setText("❚❚" if on else "▶")

    def tell(self, story: str) -> None:
        """Say this, as it is, in place of what blurs most; "" ends it."""
        self._story = story
        self._say()

    def show_live(self, live: Live) -> None:
        """Say what blurs most; while B is on screen too, that it is of A."""
        dominant = said(live.dominant)
        self._dominant = dominant if live.state.compare.shown == "a" else f"A: {dominant}"
        self._say()

    def show_none(self) -> None:
        """Say nothing, where a state has no answer."""
        self._dominant = ""
        self._say()

    def _say(self) -> None:
        self.sentence.setText(unbroken(self._story or self._dominant))

    def restyle(self, theme: Tokens) -> None:
        """Take the scale of a theme."""
        self.setFixedHeight(LINES * self.sentence.fontMetrics().lineSpacing() + theme.px(SPACE))
