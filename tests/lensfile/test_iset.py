"""ISET lens files: when a radius of 0 is the stop, spectral indices, and the older four columns."""

from math import inf

import pytest

from p2sf.errors import LensFileError
from p2sf.lensfile.library import load_lens
from p2sf.paraxial.first_order import cardinal_points
from tests.support.lenses.lens_files import FOLDER, read, refused_at

TRIPLET, GAUSS = "triplet.json", "gauss.dat"


def test_the_prescription_is_read_as_it_stands():
    lens = load_lens(FOLDER / TRIPLET)
    assert (lens.name, lens.title, lens.source) == ("triplet", "triplet", "Written for these tests")
    assert lens.surfaces[0].radius == 23.713 and lens.surfaces[0].semi_diameter == 8.0
    assert lens.surfaces[7].conic == -0.3 and lens.surfaces[7].aspheric == (1e-6, -2e-9)
    assert (lens.aperture.kind, lens.aperture.value) == ("stop_semi_diameter", 4.0)


def test_radius_0_is_the_stop_only_where_the_index_is_0():
    lens = load_lens(FOLDER / TRIPLET)
    assert lens.stop_surface == 5
    assert [s.radius for s in lens.surfaces[4:7]] == [inf, inf, inf]
    assert [s.medium.label for s in lens.surfaces[4:7]] == ["1.0", "1.5", "1.0"]


def test_radius_0_is_the_stop_where_its_name_says_so():
    named = read(TRIPLET, ('"ior": 0, "semi_aperture": 4.0', '"ior": 1, "semi_aperture": 4.0, "name": "diaphragm"'))
    assert named.lens.stop_surface == 5


def test_a_stop_in_a_medium_does_not_end_it():
    """An eye's pupil has aqueous humour on both sides, whatever index 0 says."""
    wet = read(TRIPLET, ('"thickness": 4.822, "ior": 1.0', '"thickness": 4.822, "ior": 1.336'))
    assert [s.medium.label for s in wet.lens.surfaces[3:5]] == ["1.336", "1.336"]


def test_index_0_behind_a_curved_surface_is_air_and_said():
    found = read(
        TRIPLET,
        ('"radius": 7331.288, "thickness": 5.86, "ior": 1.0', '"radius": 7331.288, "thickness": 5.86, "ior": 0'),
    )
    assert found.lens.stop_surface == 5 and found.lens.surfaces[1].medium.label == "1.0"
    assert "index 0 behind a curved surface" in found.report.text


def test_spectral_indices_are_a_table():
    medium = load_lens(FOLDER / TRIPLET).surfaces[2].medium
    assert medium.range_um == (0.4, 0.7) and float(medium.index(0.55)) == pytest.approx(1.675, abs=1e-12)


def test_a_sensor_that_is_not_stated_is_put_at_the_focus_and_said():
    found = read(TRIPLET)
    focus = cardinal_points(found.lens, found.lens.reference_wavelength_um).back_focal_distance
    assert found.lens.sensor_mm == pytest.approx(float(focus), rel=1e-12)
    assert "does not say where the sensor is" in found.report.text
    stated = read(TRIPLET, ('-20.4942, "thickness": 0.0', '-20.4942, "thickness": 41.0')).lens
    assert stated.sensor_mm == 41.0


def test_the_older_columns_end_in_a_diameter():
    lens = load_lens(FOLDER / GAUSS)
    assert lens.title == "gauss 50" and lens.stop_surface == 6
    assert [s.semi_diameter for s in lens.surfaces[:2]] == [12.6, 12.6] and lens.aperture.value == 8.55
    efl = float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length)
    assert efl == pytest.approx(50, rel=0.01)  # the file's own round figure


def test_a_plane_inside_glass_is_no_stop():
    """2el lenses list a plane of index 1.65 between two radii: the rims decide, which is said."""
    found = read(GAUSS, ("0.000000	4.500000	0.000000", "0.000000	4.500000	1.000000"))
    assert found.lens.stop_surface is None and "the narrowest rim" in found.report.text


REFUSED = {
    "not JSON": ((' "ior": 1.691, "semi', ' "ior": [1.691 2], "semi'), "this is not JSON"),
    "no surfaces": (('"surfaces": [', '"surfaces": {}, "faces": ['), "no list of surfaces"),
    "no radius": (('"radius": 86.759, ', ""), "surface 8: radius is None"),
    "a text": (('"radius": 86.759', '"radius": "big"'), "surface 8: radius is big"),
    "two radii": (('"radius": 86.759', '"radius": [86, 87]'), "surface 8: radius differs between x and y"),
    "a tilt": (('"conic_constant": -0.3', '"transform": [[1,0,0],[0,1,0],[0,0,1],[0,2,0]]'), "surface 8 is tilted"),
    "two stops": (('"ior": 1.5, ', '"ior": 0, '), "surfaces 5 and 6 both are the stop"),
    "uneven lists": (("[1.70, 1.68, 1.67, 1.665]", "[1.70, 1.68]"), "surface 3: ior is neither"),
    "an impossible index": (('"ior": 1.5, ', '"ior": 15, '), "surface 6 .*refractive index is 15"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused_says_where_and_why(case):
    refused_at(TRIPLET, *REFUSED[case])


def test_a_row_of_five_columns_is_refused_at_its_line():
    with pytest.raises(LensFileError, match="line 8: a row has 5 columns"):
        read(GAUSS, ("1.670000	23.000000", "1.670000	23.000000	1"))
