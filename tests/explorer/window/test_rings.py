"""The sliders of a lens that zooms and focuses inside, under a person's hands."""

import pytest
from PySide6.QtCore import Qt

from p2sf.lens.positions import with_positions
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.paraxial.first_order import cardinal_points, image_distance
from p2sf_explorer.compute.setup import paraxial_setup, prescription, with_lens
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.state_files import state_from_json, state_to_json
from p2sf_explorer.window.commands.choices import choices
from tests.support.lenses.zooms import focusing_zoom, two_group_zoom, zoom_lens_at

ZOOM, BOTH = lens_to_toml(two_group_zoom()), lens_to_toml(focusing_zoom())


def take(window, text: str | None) -> None:
    """Open a lens, stopped down, so that the wide blurs of a ring's ends are painted at once."""
    window.store.replace(change(with_lens(window.store.state, "double_gauss_28", text), f_number=16.0))


@pytest.fixture
def rows(window):
    take(window, ZOOM)
    return window.controls.rows


def type_into(qtbot, edit, text: str) -> None:
    edit.setFocus()
    edit.selectAll()
    qtbot.keyClicks(edit, text)
    qtbot.keyClick(edit, Qt.Key.Key_Return)


def test_only_lenses_that_have_rings_show_their_sliders(window):
    shown = {}
    for name, text in (("none", None), ("zoom", ZOOM), ("both", BOTH)):
        take(window, text)
        shown[name] = tuple(window.controls.rows[key].isVisible() for key in ("zoom", "focus_position"))
    assert shown == {"none": (False, False), "zoom": (True, False), "both": (True, True)}


def test_dragging_the_zoom_turns_the_lens_and_is_one_step_of_undo(window, rows, drag):
    row = rows["zoom"]
    assert row.edit.text() == "30.0 mm" and len(row.slider._marks) == 3
    drag(row.slider, 0.5)
    zoom = window.store.state.optics.zoom
    assert zoom == pytest.approx(45, abs=0.3)  # a pixel of the slider
    lens = prescription(window.store.state)
    focal = float(cardinal_points(lens, 0.5875618).effective_focal_length)
    assert row.edit.text() == f"{zoom:.1f} mm" and f"{focal:.1f} mm" in row.note.text()
    assert "between two positions" in row.note.text()
    window.store.undo()
    assert window.store.state.optics.zoom is None and row.edit.text() == "30.0 mm"


@pytest.mark.slow
@pytest.mark.parametrize(("text", "zoom"), [("tele", 60.0), ("40 mm", 40.0), ("52,5", 52.5), ("33.3 mm", 33.3)])
def test_a_column_or_a_number_may_be_typed(window, rows, qtbot, text, zoom):
    type_into(qtbot, rows["zoom"].edit, text)
    assert window.store.state.optics.zoom == zoom


@pytest.mark.parametrize(("text", "said"), [("85", "from 30 to 60"), ("near", "not a number")])
def test_what_is_not_on_the_ring_is_refused(window, rows, qtbot, text, said):
    type_into(qtbot, rows["zoom"].edit, text)
    assert said in window.banner.text.text()
    assert window.store.state.optics.zoom is None and rows["zoom"].edit.text() == "30.0 mm"


def test_keys_and_the_palette_turn_the_ring(window, rows, qtbot):
    rows["zoom"].slider.setFocus()
    qtbot.keyClick(rows["zoom"].slider, Qt.Key.Key_End)
    assert window.store.state.optics.zoom == 60.0
    named = {(c.group, c.title): c for c in choices(window.store, lambda _: None, lambda _: None, lambda _: None)}
    named["Zoom", "40 mm"].run()
    assert window.store.state.optics.zoom == 40.0
    assert paraxial_setup(window.store.state).lens.surfaces == zoom_lens_at(40.0).surfaces


def test_a_focus_distance_turns_the_ring_of_focus_and_the_ring_takes_over(window, drag):
    take(window, BOTH)
    row = window.controls.rows["focus_position"]
    window.store.update(focus_mm=4000.0, zoom=60.0)
    setup = paraxial_setup(window.store.state)
    assert setup.lens.surfaces[-1].thickness == pytest.approx(80.0)  # the sensor stays, the front group moves
    assert float(image_distance(setup.lens, 4000.0, 0.5875618)) == pytest.approx(80.0)
    assert row.edit.text() == f"{setup.lens.positions.at('focus'):.2f}"
    assert "4.000 m" in row.note.text()
    drag(row.slider, 1.0)
    optics = window.store.state.optics
    assert (optics.focus_position, optics.focus_mm) == (3.0, None)


def test_states_and_links_carry_the_position(window, rows):
    window.store.update(zoom=47.0)
    state = window.store.state
    assert state_of_link(link(state)).optics == state.optics
    assert state_from_json(state_to_json(state)).optics == state.optics


def test_another_lens_begins_at_its_own_place(window, rows):
    window.store.update(zoom=47.0)
    assert with_lens(window.store.state, "singlet_f6").optics.zoom is None


def test_a_place_of_another_lens_is_held_at_the_end(window, rows):
    window.store.update(zoom=470.0)
    assert prescription(window.store.state).positions.place == (60.0,)
    assert rows["zoom"].edit.text() == "60.0 mm"
    single = with_positions(focusing_zoom().positions.axes[:1], [zoom_lens_at(30.0), zoom_lens_at(60.0)])
    window.store.replace(with_lens(State(), "double_gauss_28", lens_to_toml(single)))
    window.store.update(focus_position=2.0)  # of which this lens has no ring
    assert prescription(window.store.state).positions.place == (30.0,)
