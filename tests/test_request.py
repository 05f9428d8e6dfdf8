"""A request means the same lens, sensor, stop and source to the library, the command line and the window."""

from math import inf, nan

import numpy as np
import pytest

from p2sf.conventions import FARTHEST_MM, depth_of
from p2sf.errors import P2SFError
from p2sf.lens.lens import AIMS, with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import cardinal_points, image_distance
from p2sf.paraxial.pupils import f_number, find_stop, pupils
from p2sf.paraxial.seidel import coefficients
from p2sf.pupil.zernike_fit import pupil_opd
from p2sf.raytrace.pencil import displayed_opd
from p2sf.setting import Request, set_up
from p2sf_explorer.state.scales import Vergence
from tests.support.lenses.mirrors import mirror
from tests.support.reference import prescription_lens

ROUND_OFF = 1e-12  # a few operations in float64


def lens():
    return prescription_lens("double_gauss_28", 587.5618)


def asked(**values):
    return set_up(lens(), Request(**values))


def numbers(setup):
    return coefficients(setup.lens, setup.source.depth_mm, setup.source.field_slope, setup.source.wavelength_um)


def test_nothing_asked_is_the_file():
    setup = asked()
    assert setup.lens == setup.prescription == lens()
    assert (setup.source.depth_mm, setup.source.field_slope) == (inf, 0)
    assert setup.source.wavelength_um == pytest.approx(0.5875618, rel=ROUND_OFF)


@pytest.mark.parametrize("focus", [500.0, 2000.0, inf])
def test_the_sensor_stands_at_the_image_of_the_focus_distance(focus):
    setup = asked(focus_mm=focus, depth_mm=focus)
    assert setup.lens.sensor_mm == pytest.approx(float(image_distance(lens(), focus, 0.5875618)), rel=ROUND_OFF)
    assert abs(float(numbers(setup).wd)) < 1e-9  # round-off of 60 mm against a 0.1 µm wave


@pytest.mark.parametrize("focus", [150.0, 300.0, inf])
def test_the_sensor_of_a_mirror_stands_in_front_of_it(focus):
    """1/s + 1/s' = 2/R: a radius of -200 mm focuses infinity 100 mm to the left."""
    setup = set_up(mirror(-200.0, -100.0), Request(focus_mm=focus, depth_mm=focus))
    assert setup.lens.sensor_mm == pytest.approx(-1 / (1 / 100 - 1 / focus), rel=ROUND_OFF)
    with pytest.raises(P2SFError, match="sensor_shift_um"):
        set_up(mirror(-200.0, -100.0), Request(sensor_shift_um=200_000.0))


def test_a_shift_comes_on_top_of_focus():
    still, moved = asked(focus_mm=800), asked(focus_mm=800, sensor_shift_um=250)
    assert moved.lens.sensor_mm - still.lens.sensor_mm == pytest.approx(0.25, abs=ROUND_OFF * 100)


@pytest.mark.parametrize("depth", [700.0, inf])
@pytest.mark.parametrize("height", [-12.0, 0.0, 17.5])
def test_an_image_height_is_where_the_chief_ray_lands(depth, height):
    setup = asked(depth_mm=depth, image_height_mm=height, focus_mm=depth)
    assert float(numbers(setup).image_height) == pytest.approx(height, rel=ROUND_OFF, abs=ROUND_OFF)


def test_an_object_height_is_seen_from_the_entrance_pupil():
    setup = asked(depth_mm=1000, object_height_mm=105.8)
    reach = 1000 + float(pupils(lens(), 0.5875618).entrance_from_first)
    assert setup.source.field_slope == pytest.approx(105.8 / reach, rel=ROUND_OFF)
    assert float(numbers(setup).image_height) > 0  # a positive object height lies at −y and lands at +y


def test_an_angle_is_an_angle_at_finite_depth_too():
    assert asked(depth_mm=600, field_deg=9.5).field_deg == pytest.approx(9.5, rel=ROUND_OFF)


def test_two_angles_are_a_slope_and_the_direction_it_runs_in():
    setup = asked(field_deg=4.0, field_x_deg=-3.0)
    across, along = np.tan(np.deg2rad([-3.0, 4.0]))
    assert setup.source.field_slope == pytest.approx(np.hypot(across, along), rel=ROUND_OFF)
    assert np.tan(np.deg2rad(setup.source.azimuth_deg)) == pytest.approx(across / along, rel=ROUND_OFF)
    assert setup.source.field_xy_deg == pytest.approx((-3.0, 4.0), rel=ROUND_OFF)
    for across in (5.0, -5.0):
        assert asked(field_x_deg=across).source.field_xy_deg == (pytest.approx(across, rel=ROUND_OFF), 0.0)
    assert Source(field_deg=5.0, azimuth_deg=180.0).field_xy_deg == (0.0, pytest.approx(-5.0, rel=ROUND_OFF))
    assert asked(field_deg=-4.0, field_x_deg=0.0).source == asked(field_deg=-4.0).source


def test_an_f_number_opens_the_lens():
    assert float(f_number(asked(f_number=4.5).lens, 0.5875618)) == pytest.approx(4.5, rel=ROUND_OFF)


def test_the_lens_says_how_rays_fill_its_pupil_unless_asked_otherwise():
    for aim in AIMS:
        own = with_aim(lens(), aim)
        assert set_up(own, Request()).lens == own
        for asked_for in AIMS:
            assert set_up(own, Request(aim=asked_for)).lens == with_aim(own, asked_for)
        assert set_up(own, Request(aim="real")).lens.aim == "stop"  # its former name


def test_stop_auto_hands_on_a_lens_that_names_the_narrowest_rim():
    petzval = prescription_lens("petzval", 587.5618)
    near = next(d for d in (100.0, 200.0, 300.0, 500.0) if find_stop(petzval, d).warning)
    setup = set_up(petzval, Request(depth_mm=near, stop="auto"))
    assert setup.lens.stop_surface == int(find_stop(petzval, near).limiting_surface)
    assert find_stop(setup.lens, near).warning is None
    assert set_up(petzval, Request(depth_mm=near)).stop.warning


BAD = [
    ({"depth_mm": 0}, "depth_mm is 0 mm"),
    ({"depth_mm": -5}, "depth_mm is -5 mm"),
    ({"depth_mm": 1e99}, "beyond 1e+16 mm"),
    ({"focus_mm": 1.1e16}, "beyond 1e+16 mm"),
    ({"depth_mm": nan}, "depth_mm is nan mm"),
    ({"focus_mm": nan}, "focus_mm is nan mm"),
    ({"focus_mm": 20}, "focus_mm is 20 mm"),
    ({"wavelength_nm": 0}, "wavelength_nm is 0 nm"),
    ({"wavelength_nm": inf}, "wavelength_nm is inf nm"),
    ({"f_number": -1}, "f_number is -1"),
    ({"sensor_shift_um": inf}, "sensor_shift_um is inf µm"),
    ({"sensor_shift_um": -70e3}, "sensor_shift_um is -70000 µm"),
    ({"field_deg": 90}, "field_deg is 90°"),
    ({"field_deg": -120}, "field_deg is -120°"),
    ({"field_deg": nan}, "field_deg is nan°"),
    ({"field_x_deg": -90}, "field_x_deg is -90°"),
    ({"field_x_deg": 3, "image_height_mm": 2}, "field_x_deg is given with image_height_mm"),
    ({"field_deg": 3, "image_height_mm": 2}, "field_deg and image_height_mm"),
    ({"object_height_mm": 3}, "object_height_mm is 3 mm"),
    ({"stop": "open"}, 'stop is "open"'),
    ({"aim": "high"}, 'aim is "high"; choose stop or paraxial'),
    ({"aim": ""}, 'aim is ""'),
]


@pytest.mark.parametrize(("values", "words"), BAD, ids=[words for _, words in BAD])
def test_what_cannot_be_is_one_sentence_with_place_value_and_remedy(values, words):
    with pytest.raises(P2SFError) as caught:
        asked(**values)
    message = str(caught.value)
    assert words in message
    assert "; " in message and "\n" not in message  # the remedy follows the semicolon


def test_focusing_into_the_front_focal_plane_is_named():
    simple = prescription_lens("plano_convex", 587.5618)
    front = -float(cardinal_points(simple, 0.5875618).front_focal_distance)
    with pytest.raises(P2SFError, match="focus_mm"):
        set_up(simple, Request(focus_mm=front * (1 - 1e-9)))
    assert np.isfinite(set_up(simple, Request(focus_mm=front * 1.01)).lens.sensor_mm)


def test_the_farthest_depth_is_infinity_to_rays():
    """Just below the limit the wavefront is that of infinity, even of the lens with the longest focal length."""
    for name, field in (("double_gauss_28", 10), ("hubble", 0.1)):
        found = find_lens(name)
        nodes, far = pupil_opd(found, Source(field_deg=field))
        near = displayed_opd(found, Source(FARTHEST_MM, field_deg=field), nodes.xi, nodes.eta)
        assert np.abs(near - far).max() < 1e-6
    with pytest.raises(P2SFError, match="inf"):
        Source(np.nextafter(FARTHEST_MM, inf))


def test_what_rounding_leaves_of_a_vergence_is_infinity():
    assert depth_of(1e-20) == inf and depth_of(1e-3) == 1e3
    scale = Vergence(300.0, 1000.0)
    assert scale.value(1 - 2**-53) == inf and scale.value(0.5) == pytest.approx(1000)
