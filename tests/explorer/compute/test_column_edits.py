"""Edits of a lens with positions: in the present column where it varies, in all of them where it does not."""

import pytest

from p2sf.errors import GeometryError
from p2sf.lens.lens import with_absorption
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.positions import lens_at, matches_columns
from p2sf_explorer.compute.editing import delete_surface, edited_state, insert_surface, with_stop, with_value
from p2sf_explorer.compute.setup import prescription, with_lens
from p2sf_explorer.state.state import State, change
from tests.support.lenses.zooms import two_group_zoom

ZOOM = two_group_zoom()


def at(zoom: float, **entries) -> State:
    return change(with_lens(State(), "double_gauss_28", lens_to_toml(ZOOM)), zoom=zoom, keep_focus="off", **entries)


def typed(state: State, number: int, column: str, text: str) -> State:
    return edited_state(state, with_value(prescription(state), number, column, text))


def columns(state: State):
    return prescription(state).positions.lenses


def test_absorption_is_of_the_lens_and_not_of_a_column():
    """Between columns too, and once more it is as in the file."""
    lens = prescription(at(40.0))
    state = edited_state(at(40.0), with_absorption(lens))
    assert prescription(state).absorption and prescription(change(state, zoom=35.0)).absorption
    assert not prescription(edited_state(state, with_absorption(prescription(state), False))).absorption


def test_a_space_that_varies_is_edited_in_its_column():
    state = typed(at(40.0), 2, "thickness", "39")
    found = columns(state)
    assert [lens.surfaces[1].thickness for lens in found] == [
        ZOOM.positions.lenses[0].surfaces[1].thickness,
        39.0,
        ZOOM.positions.lenses[2].surfaces[1].thickness,
    ]
    assert prescription(state).surfaces[1].thickness == 39.0
    assert matches_columns(prescription(state))


@pytest.mark.parametrize("zoom", [30.0, 45.0])
def test_a_radius_that_does_not_vary_is_edited_in_all_of_them(zoom):
    state = typed(at(zoom), 4, "radius", "-21")
    assert [lens.surfaces[3].radius for lens in columns(state)] == [-21.0] * 3
    assert prescription(state).surfaces[3].radius == -21.0 and state.optics.zoom == zoom


def test_between_columns_what_varies_is_refused_by_name():
    state = at(45.0)
    with pytest.raises(GeometryError, match=r"surface 2: this is not the same in all columns, and zoom 45 mm lies"):
        typed(state, 2, "thickness", "39")


@pytest.mark.parametrize("zoom", [30.0, 40.0, 45.0])
def test_every_column_keeps_its_focus(zoom):
    state = change(at(zoom), keep_focus="paraxial")
    for lens in columns(typed(state, 4, "radius", "-21")):
        # As sharp as before: its image was on the sensor to some roundings of 80 mm.
        assert lens.sensor_mm == pytest.approx(float(image_distance(lens, float("inf"), 0.5875618)), abs=1e-10)


def test_surfaces_come_and_go_in_all_columns():
    state = at(45.0)
    more = edited_state(state, insert_surface(prescription(state), 2))
    assert {len(lens.surfaces) for lens in columns(more)} == {5}
    halves = [lens.surfaces[1].thickness for lens in columns(more)]
    assert halves == [lens.surfaces[1].thickness / 2 for lens in ZOOM.positions.lenses]
    fewer = edited_state(more, delete_surface(prescription(more), 3))
    assert [lens.surfaces[1].thickness for lens in columns(fewer)] == pytest.approx([2 * half for half in halves])
    moved = edited_state(state, with_stop(prescription(state), 4))
    assert {lens.stop_surface for lens in columns(moved)} == {4}


def test_an_edit_taken_back_is_the_file_again(tmp_path):
    path = tmp_path / "zoom.toml"
    path.write_text(lens_to_toml(ZOOM))
    state = change(with_lens(State(), str(path)), zoom=45.0, keep_focus="off")
    edited = typed(state, 4, "radius", "-21")
    assert edited.optics.lens_text is not None
    assert typed(edited, 4, "radius", "-20").optics.lens_text is None
    assert prescription(edited).positions.place == (45.0,)
    assert lens_at(prescription(edited), zoom="wide").surfaces[0] == ZOOM.surfaces[0]
