"""Stop, pupils, and the two paraxial rays."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.errors import GeometryError
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface, with_f_number
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import (
    default_stop,
    f_number,
    field_from_image_height,
    field_from_object_height,
    find_stop,
    numerical_aperture,
    paraxial_rays,
    pupils,
    rim_radii,
    stop_rim,
    working_f_number,
)
from tests.support.lenses.dispersive_lenses import dispersive_lens
from tests.support.reference import LENSES, prescription_lens, prescriptions, reference

FIRST_ORDER = 1e-10  # the figure
MIDDLE = {"cooke_triplet": 550.0, "eye_navarro": 543.0}


def middle_lens(name):
    return prescription_lens(name, MIDDLE.get(name, 587.5618))


@pytest.mark.parametrize("name", LENSES)
def test_pupils_are_the_witnesses(name):
    for key, row in reference(name)["first_order"].items():
        lens = prescription_lens(name, float(key))
        found = pupils(lens, float(key) / 1000)
        assert found.entrance_from_first == pytest.approx(row["entrance_pupil"]["from_first"], rel=FIRST_ORDER)
        assert found.entrance_diameter == pytest.approx(row["entrance_pupil"]["diameter"], rel=FIRST_ORDER)
        assert found.exit_from_last == pytest.approx(row["exit_pupil"]["from_last"], rel=FIRST_ORDER)
        assert found.exit_diameter == pytest.approx(row["exit_pupil"]["diameter"], rel=FIRST_ORDER)


@pytest.mark.parametrize("name", [n for n in LENSES if "STOP" not in prescriptions()[n]["published_aperture"]])
def test_published_aperture_gives_the_witnesses_stop_rim(name):
    data = prescriptions()[name]
    kind, value = next(iter(data["published_aperture"].items()))
    names = {"EPD": "entrance_pupil_diameter", "FNO": "f_number"}
    lens = replace(middle_lens(name), aperture=Aperture(names[kind], value))
    # published numbers and the witness's rim agree to the rounding of its own computation
    assert stop_rim(lens) == pytest.approx(data["stop_semi_diameter"], rel=1e-9)


# The narrowest rims for a near object, by hand from the prescriptions.
@pytest.mark.parametrize(("name", "rim"), [("petzval", 9), ("achromat_f6", 3), ("plano_convex", 2)])
def test_another_rim_limits_the_cone_up_close(name, rim):
    lens = middle_lens(name)
    close = 0.4 * cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length
    named = find_stop(lens, close)
    assert (named.surface, named.limiting_surface, named.chosen_by) == (lens.stop_surface, rim, "file")
    assert named.warning.values == {"rim": rim, "stop": named.surface}
    auto = find_stop(lens, close, mode="auto")
    assert auto.surface == rim and auto.chosen_by == "auto" and auto.warning is None


@pytest.mark.parametrize("name", [n for n in LENSES if n != "relay"])
def test_the_files_stop_limits_at_infinity_and_a_tie_is_no_warning(name):
    stop = find_stop(middle_lens(name))
    assert stop.warning is None and stop.limiting_surface == stop.surface


@pytest.mark.parametrize(("first_rim", "limiting"), [(5.0, 2), (5.0 - 1e-3, 1)])
def test_of_two_rims_as_wide_as_the_cone_the_files_is_the_stop(first_rim, limiting):
    front = Surface(semi_diameter=first_rim, thickness=1.0)  # a bare plane in collimated light: the same height
    back = Surface(radius=-50.0, semi_diameter=5.0, thickness=100.0, medium=ConstantIndex(1.5))
    lens = Lens((front, back), Aperture("stop_semi_diameter", 5.0), 2)
    auto = find_stop(lens, mode="auto")
    assert find_stop(lens).limiting_surface == auto.surface == limiting
    assert auto.semi_diameter == lens.surfaces[limiting - 1].semi_diameter
    assert (find_stop(lens).warning is None) == (limiting == 2)


def test_stop_search_over_arrays_equals_the_loop():
    lens = middle_lens("petzval")
    depth, wavelength = np.array([[40.0], [100.0], [400.0], [inf]]), np.array([0.5, 0.6])
    table = find_stop(lens, depth, wavelength, mode="auto")
    loop = [[find_stop(lens, d, w, mode="auto").surface for w in wavelength] for d in depth[:, 0]]
    np.testing.assert_array_equal(table.surface, loop)
    rays = paraxial_rays(lens, depth, wavelength, table)
    one = paraxial_rays(lens, 40.0, 0.6, find_stop(lens, 40.0, 0.6, mode="auto"))
    np.testing.assert_allclose(rays.y[:, 0, 1], one.y, rtol=1e-14)


@pytest.mark.parametrize("name", LENSES)
@pytest.mark.parametrize("depth_mm", [150.0, 1e4, inf])
def test_lagrange_invariant_is_the_same_at_every_surface(name, depth_mm):
    rays = paraxial_rays(middle_lens(name), depth_mm, middle_lens(name).reference_wavelength_um)
    before = rays.chief_nu[:-1] * rays.y - rays.nu[:-1] * rays.chief_y
    after = rays.chief_nu[1:] * rays.y - rays.nu[1:] * rays.chief_y
    size = np.abs(rays.chief_nu[:-1] * rays.y) + np.abs(rays.nu[:-1] * rays.chief_y)
    # a difference of two products: rounding of the products, a few times over the surfaces
    np.testing.assert_allclose(before, rays.invariant, rtol=0, atol=1e-13 * size.max())
    np.testing.assert_allclose(after, rays.invariant, rtol=0, atol=1e-13 * size.max())


@pytest.mark.parametrize("name", LENSES)
def test_marginal_ray_meets_the_stops_rim_and_chief_ray_its_centre(name):
    lens = middle_lens(name)
    rays = paraxial_rays(lens, 500.0, lens.reference_wavelength_um)
    row = lens.stop_surface - 1
    assert abs(rays.y[row]) == pytest.approx(stop_rim(lens), rel=1e-13)
    assert abs(rays.chief_y[row]) < 1e-12 * np.abs(rays.chief_y).max()


def test_marginal_ray_is_positive_at_the_entrance_pupil_of_an_upright_and_an_inverted_pupil():
    for name in ("relay", "double_gauss_28"):
        lens = middle_lens(name)
        wavelength = lens.reference_wavelength_um
        rays, pupil = paraxial_rays(lens, 300.0, wavelength), pupils(lens, wavelength)
        at_pupil = rays.y[0] + rays.nu[0] * pupil.entrance_from_first
        assert at_pupil == pytest.approx(pupil.entrance_diameter / 2, rel=1e-12)


def test_f_number_is_set_at_the_reference_wavelength():
    lens = replace(dispersive_lens("double_gauss_28"), wavelengths_nm=(486.1, 587.6, 656.3))
    lens = with_f_number(lens, 5.6)
    assert f_number(lens, lens.reference_wavelength_um) == pytest.approx(5.6, rel=1e-14)
    # The rim is one at all wavelengths, so where the focal length differs the f-number does, here by 1.6 %.
    assert f_number(lens, 0.4861) != pytest.approx(5.6, rel=1e-3)


def test_working_f_number_grows_up_close_and_meets_the_na_at_infinity():
    lens = middle_lens("cooke_triplet")
    near, far = working_f_number(lens, np.array([200.0, inf]), 0.55)
    assert near > far == pytest.approx(float(f_number(lens, 0.55)), rel=1e-12)
    assert numerical_aperture(lens, inf, 0.55) == pytest.approx(0.5 / far, rel=1e-14)


def test_fields_from_heights():
    lens = middle_lens("double_gauss_28")
    wavelength = lens.reference_wavelength_um
    slope = np.tan(np.deg2rad(10))
    pupil = pupils(lens, wavelength).entrance_from_first
    assert field_from_object_height(lens, 1000.0, wavelength, slope * (1000 + pupil)) == pytest.approx(slope, rel=1e-14)
    height = next(
        c["image_height"]
        for c in reference("double_gauss_28")["cases"]
        if c["wavelength_nm"] == 587.5618 and c["depth_mm"] is None and c["field_deg"] == 10
    )
    assert field_from_image_height(lens, wavelength, height) == pytest.approx(slope, rel=FIRST_ORDER)
    with pytest.raises(GeometryError, match=r"^an object at infinity has no height; .* height$"):
        field_from_object_height(lens, inf, wavelength, 5.0)


def telecentric():
    """Stop in the rear focal plane of a thin plano-convex front: the entrance pupil is at infinity."""
    front = Surface(radius=inf, medium=ConstantIndex(2.0))
    return Lens((front, Surface(radius=-8.0, thickness=8.0), Surface()), Aperture("stop_semi_diameter", 1.0), 3)


def test_entrance_pupil_at_infinity_is_said_or_named():
    assert np.isinf(pupils(telecentric(), 0.5).entrance_from_first)
    with pytest.raises(GeometryError, match="entrance pupil is at infinity"):
        paraxial_rays(telecentric(), 100.0, 0.5)
    with pytest.raises(GeometryError, match=r"^the entrance pupil is at infinity, .* state the stop's semi-diameter$"):
        stop_rim(replace(telecentric(), aperture=Aperture("entrance_pupil_diameter", 2.0)))


def test_object_in_the_entrance_pupil_is_refused():
    """A stop 4 mm behind a plane window: the pupil stands before the lens only when the stop is virtual."""
    lens = Lens((Surface(thickness=-4.0), Surface()), Aperture("stop_semi_diameter", 1.0), 2)
    rounding = np.finfo(float).eps
    for near in (-8, 0, 8):  # the cone of light is known to some roundings of the distance, no better
        with pytest.raises(GeometryError, match=r"^the object lies in the entrance pupil, .* move the object$"):
            paraxial_rays(lens, 4.0 * (1 + near * rounding), 0.5)
    assert np.isfinite(paraxial_rays(lens, 4.0 * (1 + 12 * rounding), 0.5).nu).all()


def test_a_lens_without_named_stop_lets_the_rims_decide():
    lens = replace(middle_lens("double_gauss_28"), stop_surface=None)
    assert default_stop(lens) == 6
    named = replace(lens, stop_surface=6)
    np.testing.assert_array_equal(paraxial_rays(lens, 300.0, 0.5).y, paraxial_rays(named, 300.0, 0.5).y)
    bare = replace(lens, surfaces=tuple(replace(s, semi_diameter=inf) for s in lens.surfaces))
    with pytest.raises(
        GeometryError, match=r"^the lens names no stop surface and no semi-diameters; state one of them$"
    ):
        find_stop(bare)


def test_unknown_stop_mode_is_named():
    with pytest.raises(GeometryError, match='"middle" is unknown'):
        find_stop(middle_lens("tessar"), mode="middle")


def test_the_relay_inverts_its_object_and_both_pupils_are_inverted_as_its_title_says():
    """An object 1 mm below the axis lands 1 mm above it: unit magnification, upside down."""
    lens = find_lens("relay")
    rays = paraxial_rays(lens, 95.0, lens.reference_wavelength_um, field="height")
    assert float(rays.chief_y[-1] + rays.chief_nu[-1] * lens.sensor_mm) == pytest.approx(1.0, abs=1e-12)
    assert pupils(lens, lens.reference_wavelength_um).upright == -1
    assert "inverted pupils" in lens.title and "image inverted" in lens.character


def test_rims_of_whole_numbers_take_an_infinite_stop():
    lens = Lens(
        (Surface(50.0, 5.0, ConstantIndex(1.5), semi_diameter=10), Surface(semi_diameter=9)), Aperture("f_number", 8)
    )
    assert rim_radii(lens, 1, inf).tolist() == [inf, 9.0]
