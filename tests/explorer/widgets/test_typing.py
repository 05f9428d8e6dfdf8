"""What the boxes beside the sliders read: the focus of a file, and a number typed anew."""

import pytest
from PySide6.QtCore import Qt

from p2sf.paraxial.first_order import image_distance
from p2sf_explorer.compute.quantities import BEYOND, FOCUS
from p2sf_explorer.compute.ranges import file_focus
from p2sf_explorer.compute.setup import load, paraxial_setup, ranges
from p2sf_explorer.state.state import State, new_state


def shown(state: State) -> str:
    return FOCUS.write(FOCUS.shown(state, ranges(load(state.optics.lens))))


def test_a_sensor_nearer_than_the_image_of_infinity_does_not_read_as_focused_there():
    own, far = new_state(lens="cooke_triplet"), new_state(lens="cooke_triplet", focus_mm=float("inf"))
    assert paraxial_setup(own).lens.sensor_mm < paraxial_setup(far).lens.sensor_mm - 0.1
    assert (shown(own), shown(far)) == (BEYOND, "∞")
    assert shown(new_state(lens="double_gauss_28")) == "∞"  # its sensor is 1 µm off, as six digits have it


def test_the_virtual_object_of_such_a_sensor_is_imaged_on_it():
    lens = load("cooke_triplet")
    depth, wavelength = file_focus(lens), lens.reference_wavelength_um
    assert depth < 0
    far, near = (float(image_distance(lens, d, wavelength)) for d in (1e9, -depth))  # an object as far before it
    assert far - lens.sensor_mm == pytest.approx(near - far, rel=0.02)  # to first order in 1/depth


CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier


def type_into(qtbot, edit, text: str) -> None:
    edit.setFocus()
    edit.selectAll()
    qtbot.keyClicks(edit, text)


def test_undo_after_a_typed_value_is_the_window_s_and_while_typing_the_text_s(window, qtbot):
    first, edit = window.store.state, window.controls.rows["field_deg"].edit
    before = edit.text()
    type_into(qtbot, edit, "4")
    qtbot.keyClick(edit, Qt.Key.Key_Return)
    assert window.store.state.optics.field_deg == 4.0 and edit.hasFocus()
    qtbot.keyClick(edit, Qt.Key.Key_Z, CTRL)
    assert window.store.state == first and edit.text() == before
    qtbot.keyClick(edit, Qt.Key.Key_Z, CTRL | SHIFT)
    assert window.store.state.optics.field_deg == 4.0
    type_into(qtbot, edit, "7")
    qtbot.keyClick(edit, Qt.Key.Key_Z, CTRL)
    assert window.store.state.optics.field_deg == 4.0 and edit.text() != "7", "what is being typed is taken back first"
    qtbot.keyClick(edit, Qt.Key.Key_Z, CTRL)
    assert window.store.state == first


def test_undo_after_a_number_box_is_the_window_s_too(window, qtbot):
    window.open_panel("measured")
    box, first = window.panels["measured"].pixel, window.store.state
    type_into(qtbot, box, "5")
    qtbot.keyClick(box, Qt.Key.Key_Return)
    assert window.store.state.measured.pixel_um == 5.0
    qtbot.keyClick(box, Qt.Key.Key_Z, CTRL)
    assert window.store.state == first and box.value() == first.measured.pixel_um


def test_a_value_typed_as_it_was_follows_the_state_again(window, qtbot):
    edit = window.controls.rows["field_deg"].edit
    type_into(qtbot, edit, "x")
    edit.setText("")
    edit.insert(edit.last)  # as typed
    assert edit.isModified()
    qtbot.keyClick(edit, Qt.Key.Key_Return)
    window.store.update(field_deg=3.0)
    assert edit.text() == edit.last and "3" in edit.text()


@pytest.mark.parametrize(("key", "text"), [("wavelength_nm", "587.5618"), ("depth_mm", "inf"), ("field_deg", "10")])
def test_a_number_typed_that_is_there_already_is_written_as_numbers_are(window, qtbot, key, text):
    edit = window.controls.rows[key].edit
    before = edit.text()
    edit.setFocus()
    edit.selectAll()
    qtbot.keyClicks(edit, text)
    assert edit.text() == text
    qtbot.keyClick(edit, Qt.Key.Key_Return)
    assert edit.text() == before and not window.banner.isVisible()


@pytest.mark.parametrize("clicks", [2, 3])
def test_what_is_typed_after_a_double_or_triple_click_replaces_the_number(window, qtbot, clicks):
    window.store.update(f_number=8.0)
    edit = window.controls.rows["f_number"].edit
    left = Qt.MouseButton.LeftButton
    qtbot.mouseClick(edit, left)
    qtbot.mouseDClick(edit, left)
    if clicks == 3:
        qtbot.mouseClick(edit, left)
    assert window.store.state.optics.f_number != 8.0, "a double click resets"
    qtbot.keyClicks(edit, "3")
    assert edit.text() == "3"
