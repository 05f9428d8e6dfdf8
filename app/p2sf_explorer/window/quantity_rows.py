"""A row for each quantity, a name, an editable number and a slider, and the rows of what stands in the stop."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QToolButton, QVBoxLayout, QWidget

from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.errors import P2SFError
from p2sf.parameters import PARAMETERS
from p2sf_explorer.charts.theme import SPACE, Tokens
from p2sf_explorer.compute.quantities import FIELD, MASK_QUANTITIES, WAVELENGTH, Quantity, Scale, visible_colour
from p2sf_explorer.compute.setup import Ranges, default_state, prescription, with_state_mask
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.limits import COUNTS, MASK
from p2sf_explorer.state.scales import Stepped
from p2sf_explorer.state.state import State, entry
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.quiet import QuietTools
from p2sf_explorer.widgets.readout import Readout
from p2sf_explorer.widgets.slider import STEPS, Slider
from p2sf_explorer.widgets.typed import typed
from p2sf_explorer.widgets.value_edit import ValueEdit


class QuantityRow(QWidget):
    """One quantity: name and number above, slider below; it updates the store and follows the state."""

    swept, grasped = Signal(str), Signal(str)

    def __init__(self, quantity: Quantity, store: Store, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.quantity, self._store = quantity, store
        self.setToolTip(tr(quantity.tip))
        self.slider, self.edit, self.note = Slider(self), ValueEdit(self), Readout(self)
        self.slider.setAccessibleName(tr(quantity.title))
        self.edit.setAccessibleName(tr(quantity.title))
        self.buttons = [self._button(*button) for button in quantity.buttons]
        self.quiet = QuietTools(self)
        self.quiet.add(*self.buttons)
        self._scale: Scale | None = None
        self._limits: Ranges | None = None
        self._shown: tuple[float, Scale] | None = None
        self._before = 0.0
        self.counts = quantity.key in COUNTS  # whole numbers jump: nothing to play
        self._lay_out()
        self._connect()

    def _lay_out(self) -> None:
        head = QHBoxLayout()
        head.setSpacing(SPACE // 2)
        head.addWidget(QLabel(tr(self.quantity.title)))
        head.addStretch(1)
        for button in self.buttons:
            head.addWidget(button)
        head.addWidget(self.edit)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(head)
        column.addWidget(self.slider)
        column.addWidget(self.note)
        self.note.setVisible(self.quantity is FIELD or self.quantity.ring is not None)

    def _connect(self) -> None:
        self.slider.sliderPressed.connect(lambda: self.grasped.emit(self.quantity.key))  # first: it may end a drag
        self.slider.sliderPressed.connect(self._store.begin)
        self.slider.sliderReleased.connect(self._store.end)
        self.slider.valueChanged.connect(self._on_slider)
        self.slider.reset.connect(self.reset)
        if not self.counts:
            self.slider.swept.connect(lambda: self.swept.emit(self.quantity.key))
        self.edit.committed.connect(self._on_text)
        self.edit.reset.connect(self.reset)
        self.slider.cancelled.connect(self._store.cancel)
        scrub = self.edit.let_scrub()
        scrub.begun.connect(self._grasp)
        scrub.moved.connect(self._on_scrub)
        scrub.ended.connect(self._store.end)
        scrub.cancelled.connect(self._store.cancel)

    def _grasp(self) -> None:
        self.grasped.emit(self.quantity.key)  # first: it may end a drag
        self._store.begin()
        self._before = self._shown[0] if self._shown else 0.0

    def _on_scrub(self, by: float) -> None:
        """Move the value from where it was when the hand took hold of the number."""
        if self._scale:
            self._store.update(**self.quantity.entries(self._scale.moved(self._before, by)))

    def _button(self, label: str, value: float | None, tip: str) -> QPushButton:
        button = QPushButton(tr(label), self)
        button.setObjectName("small")
        button.setToolTip(tr(tip))
        button.setAccessibleName(tr(tip))
        button.clicked.connect(lambda: self._store.update(**self.quantity.entries(value)))
        return button

    def reset(self) -> None:
        """Go back to the lens's own value."""
        fresh = default_state(self._store.state.optics.lens, self._store.state.optics.lens_text)
        self._store.update(**self.quantity.entries(entry(fresh, self.quantity.key)))

    def show_state(self, state: State, limits: Ranges) -> None:
        """Follow a state: slider, number, ticks; no signal goes back."""
        if limits is not self._limits or self._scale is None:
            self._limits, before, self._scale = limits, self._scale, self.quantity.scale(limits)
            if self._scale != before:
                self._set_ticks(self._scale, limits)
        scale = self._scale
        self.slider.fine_arrows = self.edit.fine_arrows = not state.lesson.name
        marks = self.quantity.marks(state, limits)
        self.slider.set_marks(tuple(scale.travel(value) for value in marks if scale.low <= value <= scale.high))
        value = self.quantity.shown(state, limits)
        if (value, scale) == self._shown and self.edit.text() == self.edit.last:
            return
        self._shown = value, scale
        self.slider.blockSignals(True)
        self.slider.setValue(round(STEPS * scale.travel(value)))
        self.slider.blockSignals(False)
        text = self.quantity.text(value, limits)
        self.edit.set_text(tr(text) if value < 0 else text)

    def _set_ticks(self, scale: Scale, limits: Ranges) -> None:
        inside = [(v, name) for v, name in self.quantity.ticks(limits) if scale.low <= v <= scale.high]
        self.slider.set_ticks(tuple((scale.travel(v), name) for v, name in inside))
        if isinstance(scale, Stepped):
            step = STEPS / (len(scale.values) - 1)
            self.slider.setSingleStep(round(step))
            self.slider.setPageStep(round(2 * step))
        if self.quantity is WAVELENGTH:
            steps = [k / 24 for k in range(25)]
            self.slider.set_spectrum(tuple((t, visible_colour(scale.value(t))) for t in steps))

    def show_note(self, text: str) -> None:
        """Show what follows from the value, in a line under the slider."""
        self.note.set_text(text)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.slider.restyle(theme)
        self.note.restyle(theme)

    def _on_slider(self, step: int) -> None:
        if not self._scale:
            return
        value = self._scale.value(step / STEPS)
        self._store.update(**self.quantity.entries(value))
        if isinstance(self._scale, Stepped):  # the handle stands at a number, also where it has stayed the same
            self.slider.blockSignals(True)
            self.slider.setValue(round(STEPS * self._scale.travel(value)))
            self.slider.blockSignals(False)

    def _on_text(self, text: str) -> None:
        try:
            value = self.quantity.typed(typed(text), self._limits) if self._limits else self.quantity.read(typed(text))
        except P2SFError as error:
            self._store.refused.emit(error)
            self.edit.set_text(self.edit.last)
        else:
            self._store.update(**self.quantity.entries(value))
            if entry(self._store.state, self.quantity.key) != value:
                self.edit.set_text(self.edit.last)  # refused: the number stays that of the picture


TITLE = "Pupil shape"
SHAPE_TIP = (
    "What stands in the stop: an obscuration, the blades of an iris, the vanes of a spider, a filter, a phase plate; "
    "phases and amplitudes of a lens file stay."
)
AS_FILE_TIP = "Restore the pupil of the lens file"


class PupilShape(QWidget):
    """The rows of what stands in the stop under a heading that unfolds them, and what of it there is beside it."""

    def __init__(self, store: Store, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._store, self.in_stop = store, CLEAR
        self.heading, self.summary, self.reset = QToolButton(self), Readout(self), QPushButton(tr("file"), self)
        self.heading.setObjectName("heading")
        self.heading.setAccessibleName(tr(TITLE))
        self.heading.setToolTip(tr(SHAPE_TIP))
        self.heading.clicked.connect(self._turn)
        self.reset.setObjectName("small")
        self.reset.setToolTip(tr(AS_FILE_TIP))
        self.reset.clicked.connect(lambda: store.update(**dict.fromkeys(MASK)))
        self.rows = {quantity.key: QuantityRow(quantity, store, self) for quantity in MASK_QUANTITIES}
        self._lay_out()

    def _lay_out(self) -> None:
        head = QHBoxLayout()
        head.setSpacing(SPACE // 2)
        head.addWidget(self.heading)
        head.addWidget(self.summary, 1)
        head.addWidget(self.reset)
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.addLayout(head)
        for row in self.rows.values():
            self._column.addWidget(row)

    def _turn(self) -> None:
        self._store.update(show_pupil_shape=not self._store.state.display.show_pupil_shape)

    def show_state(self, state: State, limits: Ranges) -> None:
        """Follow a state: what there is, and where it is unfolded the rows of it; no signal goes back."""
        unfolded = state.display.show_pupil_shape
        self.in_stop = mask = with_state_mask(prescription(state), state).mask
        self.heading.setText(
            tr("▾ Pupil shape") if unfolded else tr("▸ Pupil shape")
        )  # these arrows grow with the type
        self.summary.set_text(", ".join(parts_of(mask)) or tr("clear"))
        self.reset.setVisible(bool(state.optics.mask))
        wanted = wanted_rows(mask) if unfolded else ()
        for key, row in self.rows.items():
            row.setVisible(key in wanted)
            if key in wanted:
                row.show_state(state, limits)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours and the scale of a theme."""
        self._column.setSpacing(theme.px(SPACE - 1))
        self.summary.restyle(theme)
        for row in self.rows.values():
            row.restyle(theme)


def parts_of(mask: PupilMask) -> list[str]:
    """Return what stands in the stop, in words."""
    found = []
    if mask.obscuration:
        found.append(f"ε {mask.obscuration:.2f}")
    if mask.iris:
        found.append(tr("{count} blades", count=mask.blades))
    if mask.spider:
        found.append(tr("{count} vanes", count=mask.vanes))
    if mask.shaded:
        found.append(tr("apodised"))
    return [*found, tr("phase")] if mask.phased else found


def wanted_rows(mask: PupilMask) -> tuple[str, ...]:
    """Return the rows that can change something: a roundness needs blades, a width vanes."""
    needs = {name: PARAMETERS[name].needs for name in MASK}
    return tuple(name for name, other in needs.items() if not other or getattr(mask, other) != getattr(CLEAR, other))
