"""Sliders under the lens table: bending of the selected element, and the stop's place in its air gap."""

from collections.abc import Callable

from PySide6.QtWidgets import QHBoxLayout, QLabel, QWidget

from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens
from p2sf.paraxial.bending import element_of, shape_factor, with_shape_factor
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.editing import edited_state, stop_gap, with_stop_shift
from p2sf_explorer.compute.setup import prescription
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import Linear, nice, read_number, with_sign
from p2sf_explorer.state.state import State
from p2sf_explorer.store.panel_store import PanelStore
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.slider import STEPS, Slider
from p2sf_explorer.widgets.typed import typed
from p2sf_explorer.widgets.value_edit import ValueEdit

BENDING_TIP = (
    "Bending: the shape factor X = (c₁ + c₂)/(c₁ − c₂) of the selected element; its thin-lens power does not change. "
    "0 is equiconvex or equiconcave, ±1 has one plane side. Select an element in the layout or in the table."
)
STOP_TIP = (
    "Stop shift: distance of the stop behind the surface before it, within its air gap; the f-number does not change."
)
WIDEST = 6.0  # shape factor at the slider's end, unless the element has more
UNITS = {" mm": {"": 1.0, "mm": 1.0, "µm": 1e-3, "um": 1e-3}, "°": {"": 1.0, "°": 1.0, "deg": 1.0, "'": 1 / 60}}
PLAIN = {"": 1.0}
Edit = Callable[[State, float], State]
"""From the state that a drag began with, and a value, to the state with it; P2SFError where there is none."""


class LensSlider(QWidget):
    """A name, a slider and a number that edit the lens: one step of undo for a drag.

    ``unit`` is written behind the number, which has so many ``digits`` behind the point.
    """

    def __init__(self, title: str, tip: str, unit: str, store: Store, edit: Edit, digits: int = 3):
        super().__init__()
        self._store, self._edit, self._unit, self._title, self._digits = store, edit, unit, title, digits
        self._scale, self._value, self._grasped = Linear(0.0, 1.0), 0.0, 0.0
        self._start, self._shown = store.state, ""
        self.slider, self.number = Slider(self), ValueEdit(self)
        for part in (self.slider, self.number):
            part.setAccessibleName(tr(title))
        self.setToolTip(tr(tip))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(4)
        self.label = QLabel(tr(title), self)
        row.addWidget(self.label)
        row.addWidget(self.slider, 1)
        row.addWidget(self.number)
        self._connect()

    def _connect(self) -> None:
        scrub = self.number.let_scrub()
        for begun in (self.slider.sliderPressed, scrub.begun):
            begun.connect(self._grasp)
        for ended in (self.slider.sliderReleased, scrub.ended):
            ended.connect(self._store.end)
        for cancelled in (self.slider.cancelled, scrub.cancelled):
            cancelled.connect(self._store.cancel)
        self.slider.valueChanged.connect(lambda step: self._set(self._scale.value(step / STEPS)))
        scrub.moved.connect(lambda by: self._set(self._scale.moved(self._grasped, by)))
        self.number.committed.connect(self._type)

    def _grasp(self) -> None:
        self._start, self._grasped = self._store.state, self._value
        self._store.begin()

    def _type(self, text: str) -> None:
        self._start = self._store.state
        try:
            self._set(read_number(typed(text), self._title.lower(), UNITS.get(self._unit, PLAIN)))
        except P2SFError as error:
            self._store.refused.emit(error)
        self.number.set_text(self._shown)

    def _set(self, value: float) -> None:
        """Give the lens of the drag's beginning a value; a refused one leaves the picture."""
        if isinstance(self._store, PanelStore) and self._store.refused_for_b():
            return
        state = self._start if self._store.moving else self._store.state
        try:
            self._store.replace(self._edit(state, value))
        except P2SFError as error:
            self._store.refused.emit(error)

    def show_value(self, value: float | None, scale: Linear) -> None:
        """Follow the lens; None where there is nothing to move. The scale stays while it is dragged."""
        self.setEnabled(value is not None)
        if not self._store.moving:
            self._scale = scale
        self._value = value or 0.0
        self.slider.blockSignals(True)
        self.slider.setValue(round(STEPS * self._scale.travel(self._value)))
        self.slider.blockSignals(False)
        self._shown = "" if value is None else f"{with_sign(value, self._digits)}{self._unit}"
        self.number.set_text(self._shown)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.slider.restyle(theme)


def bending_slider(store: Store) -> LensSlider:
    """Return the slider that bends the selected element."""

    def bend(state: State, shape: float) -> State:
        return edited_state(state, with_shape_factor(prescription(state), *(store.selection or (0, 0)), shape))

    return LensSlider("Bending X", BENDING_TIP, "", store, bend)


def show_bending(slider: LensSlider, lens: Lens, selection: tuple[int, int] | None) -> None:
    """Show the shape factor of the selection, if it is one element in air with different radii."""
    shape = None
    if selection and selection[1] <= len(lens.surfaces) and element_of(lens, selection[0]) == selection:
        found = shape_factor(lens, *selection)
        shape = found if abs(found) < float("inf") else None
    end = max(WIDEST, nice(1.5 * abs(shape))) if shape else WIDEST
    slider.show_value(shape, Linear(-end, end))


def stop_slider(store: Store) -> LensSlider:
    """Return the slider that moves the stop within its air gap."""

    def shift(state: State, place: float) -> State:
        lens = prescription(state)
        gap = stop_gap(lens)
        return edited_state(state, with_stop_shift(lens, place - gap[0]) if gap else lens)

    return LensSlider("Stop", STOP_TIP, " mm", store, shift)


def show_stop(slider: LensSlider, lens: Lens) -> None:
    """Show the stop's place, if it can move between two surfaces."""
    gap = stop_gap(lens)
    movable = gap is not None and (lens.stop_surface or 0) > 1 and sum(gap) > 0
    slider.show_value(gap[0] if gap and movable else None, Linear(0.0, sum(gap) if gap and movable else 1.0))
