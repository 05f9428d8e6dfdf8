"""The controls of what stands in the stop, under a person's hands."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication

from p2sf.disc.mask import CLEAR
from p2sf_explorer.state.limits import CLEAR_PUPIL, MASK
from p2sf_explorer.state.state import State
from p2sf_explorer.window.quantity_rows import PupilShape, parts_of, wanted_rows
from tests.disc.test_mask_table import SAMPLES


@pytest.fixture
def shape(window) -> PupilShape:
    window.store.update(show_pupil_shape=True)
    return window.controls.shape


def shown(shape: PupilShape) -> set[str]:
    return {key for key, row in shape.rows.items() if row.isVisible()}


def test_folded_away_it_takes_one_line_and_a_click_unfolds_it(window, qtbot):
    shape = window.controls.shape
    assert not shown(shape) and shape.height() < 30
    qtbot.mouseClick(shape.heading, Qt.MouseButton.LeftButton)
    assert shown(shape) == set(CLEAR_PUPIL)
    qtbot.keyClick(window, Qt.Key.Key_F8, Qt.KeyboardModifier.ShiftModifier)
    assert not shown(shape)


def test_rows_that_could_change_nothing_are_left_out(window, shape):
    window.store.update(blades=6, vanes=3, apodisation=0.8)
    assert shown(shape) == set(MASK) == set(wanted_rows(window.controls.shape.in_stop))


@pytest.mark.parametrize("name", SAMPLES)
def test_every_mask_is_told_in_a_word_and_taken_out_by_the_command(name):
    assert parts_of(SAMPLES[name]) and not parts_of(CLEAR)
    if name in MASK:
        assert replace(SAMPLES[name], **CLEAR_PUPIL).clear


def test_dragging_the_obscuration_is_one_step_of_undo(window, shape, drag):
    row = shape.rows["obscuration"]
    drag(row.slider, 0.5)
    assert window.store.state.optics.obscuration == pytest.approx(0.99 / 2, abs=0.01)  # a pixel of the slider
    assert row.edit.text() == f"{window.store.state.optics.obscuration:.2f}"
    assert shape.summary.text() == f"ε {window.store.state.optics.obscuration:.2f}"
    window.store.undo()
    assert window.store.state.optics.obscuration is None and row.edit.text() == "0.00"


def test_a_count_steps_from_number_to_number(window, shape, drag, qtbot):
    row = shape.rows["blades"]
    drag(row.slider, 0.13)
    blades = window.store.state.optics.blades
    assert type(blades) is int and blades in (3, 4, 5)
    assert row.slider.value() == round(1000 * row.quantity.scale(None).travel(blades))
    row.slider.setFocus()
    qtbot.keyClick(row.slider, Qt.Key.Key_Right)
    assert window.store.state.optics.blades == blades + 1
    qtbot.keyClick(row.slider, Qt.Key.Key_Space)  # would play any other slider
    assert not window.store.state.playback.slider


@pytest.mark.parametrize(("text", "words"), [("2", "from 3 to 32"), ("5.5", "whole number"), ("6 mm", "unit")])
def test_a_number_of_blades_that_cannot_be_is_a_sentence(window, shape, qtbot, text, words):
    edit = shape.rows["blades"].edit
    edit.setFocus()
    edit.selectAll()
    qtbot.keyClicks(edit, text)
    qtbot.keyClick(edit, Qt.Key.Key_Return)
    assert words in window.banner.text.text() and window.store.state.optics.blades is None
    assert edit.text() == "0"


def test_file_takes_everything_back(window, shape, qtbot):
    assert not shape.reset.isVisible() and shape.summary.text() == "clear"
    window.store.update(obscuration=0.3, blades=6, cubic_um=1.0)
    assert shape.summary.text() == "ε 0.30, 6 blades, phase"
    qtbot.mouseClick(shape.reset, Qt.MouseButton.LeftButton)
    assert window.store.state.optics == State(optics=window.store.state.optics).optics
    assert not window.store.state.optics.mask and not shape.reset.isVisible()


def test_unfolded_it_cuts_no_sentence_below(window, shape):
    window.store.update(method="auto", blades=6, vanes=3, apodisation=0.8)
    QApplication.processEvents()
    for part in (window.foot.sentence, window.controls.detail):
        assert part.text() and part.height() >= part.heightForWidth(part.width())
