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
