"""The column of controls: one row per quantity, each a name, an editable number, a slider."""

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from p2sf.messages import Message
from p2sf_explorer.charts.theme import SPACE, Tokens
from p2sf_explorer.compare.contrasts import AIM_WORDS
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.quantities import FIELD_X, RING_QUANTITIES, SHIFT, SOURCE_QUANTITIES
from p2sf_explorer.compute.setup import Ranges, state_ranges
from p2sf_explorer.compute.views.first_order import OF_A, ring_note, rows
from p2sf_explorer.i18n.messages import WINDOW, said
from p2sf_explorer.i18n.tr import tr, unbroken
from p2sf_explorer.state.limits import RINGS
from p2sf_explorer.state.pinning import b_alone
from p2sf_explorer.state.scales import with_sign
from p2sf_explorer.state.state import State
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import chooser, select
from p2sf_explorer.widgets.readout import FactTable, Sentence, in_scroll_area
from p2sf_explorer.window import fold
from p2sf_explorer.window.no_answer import UNKNOWN
from p2sf_explorer.window.quantity_rows import PupilShape, QuantityRow

STOP_TIP = "Stop: the surface whose rim limits the light, as named by the lens file or found as the smallest |rim/y|."
AIM_TIP = (
    "Rays fill: the real stop, as light does, or the paraxial entrance pupil, as in the paper and by default in most "
    "programs. The two differ off axis and in fast lenses."
)
CLIP_TIP = "Clip: rays beyond a clear semi-diameter are lost, which vignettes the pupil off axis."
CHOICES = (("file", "as in the file"), ("auto", "found"))


class StopRow(QWidget):
    """Chooser of the stop and check box of clipping; they update the store and follow the state."""

    def __init__(self, store: Store, parent: QWidget | None = None) -> None:
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

    def show_state(self, state: State) -> None:
        """Follow a state; no signal goes back."""
        select(self.stop, state.optics.stop)
        if self.clip.isChecked() != state.optics.clip:
            self.clip.blockSignals(True)
            self.clip.setChecked(state.optics.clip)
            self.clip.blockSignals(False)


class AimRow(QWidget):
    """Chooser of how exact rays fill the pupil; it updates the store and follows the state."""

    def __init__(self, store: Store, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        name = QLabel(tr("Rays fill"), self)
        name.setToolTip(tr(AIM_TIP))
        self.aim = chooser(tuple(AIM_WORDS.items()), AIM_TIP, self)
        self.aim.activated.connect(lambda: store.update(aim=self.aim.currentData()))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(name)
        row.addWidget(self.aim)
        row.addStretch(1)

    def show_state(self, state: State) -> None:
        """Follow a state; no signal goes back."""
        select(self.aim, state.optics.aim)


def asked(state: State, limits: Ranges) -> bool:
    """Return whether the field along x has a slider: the lens is not symmetric, or a person wants it."""
    return limits.both_sides or state.display.show_field_x or bool(state.optics.field_x_deg)


# The quantities above the fold, by their keys.
ABOVE = {each.key: each for each in (*RING_QUANTITIES, *SOURCE_QUANTITIES) if each is not SHIFT}
MORE_TIP = (
    "Sensor shift, pupil shape, stop, rims, how rays fill the pupil, method and accuracy. What differs from the lens "
    "file, or from the usual method, is always shown."
)
WIDTH = 292  # pixels of the column at scale 1


class Controls(QWidget):
    """All rows, the autofocus button, why the method was taken, and figures."""

    autofocus = Signal()
    swept, grasped = Signal(str), Signal(str)

    def __init__(self, store: Store, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("controls")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.rows = {key: QuantityRow(quantity, store, self) for key, quantity in ABOVE.items()}
        self.more = self._fold(store)
        self.rows[SHIFT.key] = QuantityRow(SHIFT, store, self)
        self.shape = PupilShape(store, self)
        self.rows |= self.shape.rows
        for row in self.rows.values():
            row.swept.connect(self.swept)
            row.grasped.connect(self.grasped)
        self.stopping, self.aiming = StopRow(store, self), AimRow(store, self)
        self.focus_button = QPushButton(tr("Autofocus: best RMS wavefront"), self)
        self.focus_button.setToolTip(tr("Move the sensor to where the RMS of W over the pupil is smallest (Ctrl+F)."))
        self.focus_button.clicked.connect(self.autofocus)
        self._slim, self._state, self._folded = False, store.state, fold.Fold()
        self._wanted, self._scroll = "", QTimer(self, singleShot=True, interval=0)
        self._scroll.timeout.connect(self._scroll_to_wanted)
        self.detail, self.facts = Sentence(self), FactTable(self)
        self._lay_out()

    def _fold(self, store: Store) -> QToolButton:
        """Return the heading that unfolds what a first look does not need."""
        made = QToolButton(self)
        made.setObjectName("heading")
        made.setAccessibleName(tr("More controls"))
        made.setToolTip(tr(MORE_TIP))
        made.clicked.connect(lambda: store.update(show_more=not store.state.display.show_more))
        return made

    def _lay_out(self) -> None:
        self.detail.setObjectName("muted")
        column = self._column()
        for key in ABOVE:
            column.addWidget(self.rows[key])
        column.addWidget(self.more)
        column.addWidget(self.rows[SHIFT.key])
        column.addWidget(self.shape)
        column.addWidget(self.stopping)
        column.addWidget(self.aiming)
        column.addWidget(self.focus_button)
        column.addSpacing(4)
        column.addWidget(self.detail)
        self.figures = in_scroll_area(self.facts)
        column.addWidget(self.figures, 1)
        self._below = QWidget()  # takes the room of the figures where only the sliders are shown
        column.addWidget(self._below, 1)
        self._below.hide()

    def _column(self) -> QVBoxLayout:
        """Return the column of everything, which scrolls where a screen is too low for it."""
        self.area = area = QScrollArea(self)
        page, whole = QWidget(), QVBoxLayout(self)
        column = QVBoxLayout(page)
        self._rows = column
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(area)
        area.setWidgetResizable(True)
        area.setFrameShape(QScrollArea.Shape.NoFrame)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        area.setWidget(page)
        for part in (area, area.viewport(), page):
            part.setAutoFillBackground(False)
        return column

    def make_slim(self, slim: bool) -> None:
        """Show the sliders alone, or everything."""
        self._slim = slim
        for part in (self.more, self.figures):
            part.setVisible(not slim)
        self._below.setVisible(slim)
        self._unfold(self._state)
        if pointed := [key for key, row in self.rows.items() if row.property("pointed")]:
            self.reveal(pointed[0])

    def _unfold(self, state: State) -> None:
        """Show what a first look does not need where a person asks for it, a lesson points there, or it is set."""
        self._state = state
        more, full, shift = state.display.show_more, not self._slim, self.rows[SHIFT.key]
        pointed = {fold.SHIFT} if shift.property("pointed") else set()
        if any(row.property("pointed") for row in self.shape.rows.values()):
            pointed.add(fold.SHAPE)
        parts = self._folded.shown(state, pointed)
        self.more.setText(tr("▾ More controls") if more else tr("▸ More controls"))
        shift.setVisible(fold.SHIFT in parts)
        self.shape.setVisible(fold.SHAPE in parts)
        self.stopping.setVisible(full and fold.STOP in parts)
        self.aiming.setVisible(full and fold.AIM in parts)
        self.focus_button.setVisible(full and fold.FOCUS in parts)
        self.detail.setVisible(full and (more or bool(state.lesson.name)))

    def reveal(self, key: str) -> None:
        """Show the row of a quantity, and scroll to it where the column is too low for all."""
        self._unfold(self._state)
        self._wanted = key
        self._scroll.start()

    def _scroll_to_wanted(self) -> None:
        """Scroll to the row that was wanted last, once the column is laid out with it."""
        row = self.rows[self._wanted]
        self.area.ensureWidgetVisible(row, 0, row.height())

    def show_state(self, state: State) -> None:
        """Follow a state."""
        limits = state_ranges(state)
        for key, quantity in ABOVE.items():
            self.rows[key].setVisible(quantity.there(limits) and (quantity is not FIELD_X or asked(state, limits)))
        for key in (*ABOVE, SHIFT.key):
            self.rows[key].show_state(state, limits)
        self.shape.show_state(state, limits)
        self.stopping.show_state(state)
        self.aiming.show_state(state)
        self._enable(state)
        self._unfold(state)

    def _enable(self, state: State) -> None:
        """Let move only what is seen to move: where B is on screen alone, what is linked."""
        still = b_alone(state)
        for key, row in self.rows.items():
            row.setEnabled(not still or key in state.compare.linked)
        for part in (self.stopping, self.aiming, self.focus_button):
            part.setEnabled(not still)

    def show_live(self, live: Live) -> None:
        """Show what follows from the state: heights, sensor position, figures."""
        height = live.setup.object_y_mm
        image = float(live.setup.coefficients.image_height)
        object_text = () if height is None else (tr("object {h} mm", h=with_sign(height, 2)),)
        self.rows["field_deg"].show_note(" · ".join((*object_text, tr("image {h} mm", h=with_sign(image, 3)))))
        for quantity in RING_QUANTITIES:
            self.rows[quantity.key].show_note(said(ring_note(live, quantity.ring or "zoom")))
        apart = live.state.compare.shown != "a"  # B is on screen too, and this column stays A's
        self.detail.setText(unbroken(live.why.text(WINDOW)))
        self.facts.show_rows((OF_A, *rows(live)) if apart else rows(live))

    def show_none(self) -> None:
        """Show no figures, where a state has no answer."""
        for key in ("field_deg", *RINGS):
            self.rows[key].show_note(UNKNOWN)
        self.detail.clear()
        self.facts.show_rows(tuple((name, Message(UNKNOWN), tip) for name, _, tip in self.facts.rows))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours and the scale of a theme."""
        self._rows.setContentsMargins(*(theme.px(margin) for margin in (12, 10, 12, 12)))
        self._rows.setSpacing(theme.px(SPACE - 1))
        self.facts.restyle(theme)
        for key in (*ABOVE, SHIFT.key):
            self.rows[key].restyle(theme)
        self.shape.restyle(theme)
