"""Which points a matrix shows: fields, colours, depths and sensor shifts, and how they are written."""

from math import inf

import numpy as np
import pytest

from p2sf_explorer.compare.comparison import answers
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.matrix.pictures import matrix
from p2sf_explorer.compute.matrix.points import (
    LISTS,
    heading_texts,
    matrix_request,
    nearest,
    point_entries,
    stated_fields,
    usual_wavelengths,
)
from p2sf_explorer.compute.setup import default_state, load
from p2sf_explorer.state.state import change, new_state

GAUSS = default_state("double_gauss_28")


def request_of(state):
    return matrix_request(live(state, "preview"))


def test_fields_are_those_of_the_file_or_parts_of_its_largest():
    lens = load("double_gauss_28")
    assert stated_fields(lens, 3) == lens.fields_deg == (0.0, 10.0, 14.0)
    assert stated_fields(lens, 2) == (0.0, 14.0)
    parts = np.array(stated_fields(lens, 5)) / 14.0
    assert parts == pytest.approx([0, 0.5, 0.7, 0.9, 1.0])  # √(k/4), to a tenth


@pytest.mark.parametrize("count", range(2, 13))
def test_any_number_of_fields_are_all_different(count):
    assert len(set(stated_fields(load("cooke_triplet"), count))) == count


def test_three_colours_are_f_d_c_or_the_lines_of_the_spectrum():
    lens = load("achromat_f6")
    f_d_c = usual_wavelengths(lens, (), 3)
    assert f_d_c == pytest.approx((486.13, 587.56, 656.27), abs=0.01)
    assert usual_wavelengths(lens, (546.07, 435.83), 2) == (435.83, 546.07)
    assert usual_wavelengths(lens, (1000.0, 2000.0), 2) != (1000.0, 2000.0), "the window's wavelengths are visible"
    five = np.diff(usual_wavelengths(lens, (), 5))
    assert five == pytest.approx(five[0], abs=0.11) and five[0] > 0


@pytest.mark.parametrize("depth_mm", [inf, 5000.0, 700.0])
@pytest.mark.parametrize("count", [2, 3, 5])
def test_depths_stand_evenly_in_dioptres_about_a_wave_apart(depth_mm, count):
    """One step is one to three waves of defocus: Δz of the image by Newton's formula, Wd = NA²Δz/2λ."""
    state = change(GAUSS, depth_mm=depth_mm, focus_mm=depth_mm, matrix_across="depth_mm", matrix_columns=count)
    found = live(state, "preview")
    depths = matrix_request(found).columns
    assert len(depths) == count and depth_mm in depths
    steps = -np.diff(1 / np.array(depths))
    assert np.all(steps < 0) and steps == pytest.approx(steps[0], rel=1e-3)  # six digits of each distance
    setup = found.setup
    focal, na = setup.focal_length_mm, float(setup.own.na)
    front = float(setup.cardinal.front_focal_distance)
    images = [0.0 if d == inf else focal**2 / (d + front) for d in depths]  # behind F′, Newton: x·x′ = −f²
    waves = np.abs(np.diff(images)) * na**2 / (2 * setup.source.wavelength_um / 1000)
    assert np.all(waves > 0.9) and np.all(waves < 3.2)  # 1, 2, 5 … dioptres from one wave on; NA changes by some %


def test_shifts_stand_about_the_present_one_a_depth_of_focus_apart():
    state = change(GAUSS, sensor_shift_um=37.0, matrix_across="sensor_shift_um", matrix_columns=5)
    found = live(state, "preview")
    shifts = np.array(matrix_request(found).columns)
    assert shifts.mean() == pytest.approx(37.0) and shifts[2] == 37.0
    depth = found.setup.source.wavelength_um / float(found.setup.own.na) ** 2
    assert np.all(np.diff(shifts) >= depth) and np.all(np.diff(shifts) <= 2.5 * depth)


def test_values_that_were_typed_stand_in_place_of_the_windows():
    state = change(GAUSS, matrix_fields_deg=(1.0, 2.5), matrix_wavelengths_nm=(500.0, 510.0, 520.0, 530.0))
    request = request_of(state)
    assert request.rows == (1.0, 2.5) and request.columns == (500.0, 510.0, 520.0, 530.0)
    assert heading_texts(request) == (("1°", "2.5°"), ("500.0 nm", "510.0 nm", "520.0 nm", "530.0 nm"))
    point = request.states[1][3].optics
    assert (point.field_deg, point.wavelength_nm) == (2.5, 530.0)


def test_a_path_added_by_hand_is_more_waves_of_a_shorter_wavelength():
    state = change(GAUSS, added_waves=(1.0, 0.0, 0.0, 0.0, 0.0, 0.0), matrix_wavelengths_nm=(293.7809, 587.5618))
    half, whole = request_of(state).states[0]
    assert half.what_if.added_waves[0] == pytest.approx(2.0) and whole.what_if.added_waves[0] == 1.0


@pytest.mark.parametrize("across", [*LISTS][1:])
def test_a_pictures_entries_lead_to_its_point(across):
    """Taking a picture's point makes it the present one, and the frame goes there: rows and columns are not mixed."""
    state = change(GAUSS, matrix_across=across, depth_mm=2000.0)
    request = request_of(state)
    for row in range(3):
        for column in range(3):
            there = change(state, **point_entries(request, row, column))
            assert nearest(request, there) == (row, column, True)
            assert request.states[row][column].optics == there.optics


def test_between_the_pictures_the_nearest_is_marked_as_near():
    request = request_of(GAUSS)
    assert nearest(request, GAUSS) == (1, 1, True)
    assert nearest(request, change(GAUSS, field_deg=12.5)) == (2, 1, False)
    assert nearest(request, change(GAUSS, wavelength_nm=500.0)) == (1, 0, False)


def test_sides_are_those_that_are_compared():
    state = change(GAUSS, matrix_across="side", pinned=new_state(f_number=8.0))
    for shown in ("a", "b", "difference"):
        seen = answers(change(state, shown=shown), "preview", {"matrix": matrix}).seen
        request = seen.views["matrix"].found.request
        assert request.columns == ("A", "B")
        assert [point.optics.f_number for point in request.states[0]] == [None, 8.0]
        assert [row[1].optics.field_deg for row in request.states] == list(request.rows)
    assert request_of(change(GAUSS, matrix_across="side")).columns == ("A",)
