"""Seidel coefficients against the witness and against the laws of third-order theory."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.conventions import slope_from_degrees
from p2sf.glass.media import AIR, ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface, with_sensor
from p2sf.paraxial.pupils import paraxial_rays
from p2sf.paraxial.seidel import coefficients, seidel_sums
from tests.support.reference import LENSES, prescription_lens, reference

# The figures: 1e-10 relative, 1e-12 waves absolute near zero.
RELATIVE, NEAR_ZERO = 1e-10, 1e-12
WAVES = ("w40", "w31", "w22", "w20", "w11", "wd")


@pytest.mark.parametrize("name", LENSES)
def test_every_coefficient_case_is_the_witnesses(name):
    cases = reference(name)["cases"]
    assert len(cases) >= 9
    for case in cases:
        lens = prescription_lens(name, case["wavelength_nm"])
        depth = inf if case["depth_mm"] is None else case["depth_mm"]
        found = coefficients(lens, depth, slope_from_degrees(case["field_deg"]), case["wavelength_nm"] / 1000)
        for key in (*WAVES, "na", "image_distance", "image_height"):
            assert getattr(found, key) == pytest.approx(case[key], rel=RELATIVE, abs=NEAR_ZERO), key


@pytest.mark.parametrize("name", LENSES)
def test_sums_per_surface_are_the_witnesses(name):
    case = reference(name)["seidel_sums_per_surface"]
    lens = prescription_lens(name, case["wavelength_nm"])
    depth = inf if case["depth_mm"] is None else case["depth_mm"]
    rays = paraxial_rays(lens, depth, case["wavelength_nm"] / 1000)
    sums = seidel_sums(lens, rays, slope_from_degrees(case["field_deg"]))
    # 1e-15 mm is 2e-9 waves·1e-3: the flat surfaces' exact zeros
    np.testing.assert_allclose(np.stack(sums.columns(), -1), case["rows"], rtol=RELATIVE, atol=1e-15)


def test_grid_of_depth_field_wavelength_equals_the_loop():
    lens = prescription_lens("double_gauss_28", 587.5618)
    depth, slope, wavelength = np.array([500.0, 3e3, inf]), np.array([0.0, 0.1, 0.2, 0.25]), np.array([0.48, 0.65])
    grid = coefficients(lens, depth[:, None, None], slope[None, :, None], wavelength)
    for i, j, k in np.ndindex(3, 4, 2):
        one = coefficients(lens, depth[i], slope[j], wavelength[k])
        for key in WAVES:
            value = np.broadcast_to(getattr(grid, key), (3, 4, 2))[i, j, k]
            assert value == pytest.approx(getattr(one, key), rel=1e-13, abs=1e-12), key


@pytest.mark.parametrize("wavelength", [0.55, np.array([0.48, 0.55, 0.65])], ids=["one colour", "three colours"])
def test_sums_per_surface_take_as_many_fields_as_there_are_surfaces(wavelength):
    """Eleven fields beside eleven surfaces would pair up, one field per surface, were the surface axis not kept."""
    lens = prescription_lens("double_gauss_28", 587.5618)
    slopes = np.linspace(0.0, 0.25, len(lens.surfaces)).reshape(-1, *[1] * np.ndim(wavelength))
    rays = paraxial_rays(lens, inf, wavelength)
    grid = seidel_sums(lens, rays, slopes)
    for number, slope in enumerate(slopes.ravel()):
        one = seidel_sums(lens, rays, slope)
        for many, single in zip(grid.columns(), one.columns(), strict=True):
            found = np.broadcast_to(many, (len(lens.surfaces), len(slopes), *np.shape(wavelength)))[:, number]
            np.testing.assert_allclose(found, single, rtol=1e-15, atol=0)  # the same products in the same order


def test_zero_field_has_exactly_no_field_aberration():
    c = coefficients(prescription_lens("tessar", 587.5618), 100.0, 0.0, 0.5875618)
    assert (c.w31, c.w22, c.w20, c.w11, c.image_height) == (0, 0, 0, 0, 0)


def test_heights_in_small_integers_do_not_wrap_around():
    """300 mm as int16, whose square is 90 000 and whose largest number is 32 767."""
    lens = prescription_lens("tessar", 587.5618)
    small, full = (coefficients(lens, 5e3, x, 1, field="height") for x in (np.array([300], np.int16), 300.0))
    for key in WAVES:
        assert getattr(small, key) == pytest.approx(getattr(full, key), rel=1e-14), key  # rounding of the order


@pytest.mark.parametrize("conic_index", [1.5, 1.8])
def test_cartesian_oval_images_collimated_light_without_spherical(conic_index):
    """A single surface with K = −(n/n')² focuses collimated light perfectly (Descartes)."""
    surface = Surface(radius=20.0, thickness=60.0, medium=ConstantIndex(conic_index), conic=-((1 / conic_index) ** 2))
    lens = Lens((surface,), Aperture("stop_semi_diameter", 5.0), 1)
    sphere = replace(lens, surfaces=(replace(surface, conic=0.0),))
    # cancellation of two equal terms: rounding of the spherical one
    assert abs(coefficients(lens, inf, 0.0, 0.5).w40) < 1e-14 * abs(coefficients(sphere, inf, 0.0, 0.5).w40)


def test_shifting_the_stop_leaves_spherical_and_petzval_alone():
    """Seidel's stop-shift law: with the same cone, W40 and S_IV do not know where the stop is."""
    lens = prescription_lens("landscape", 587.5618)
    rays = paraxial_rays(lens, inf, 0.5875618)
    shifted = replace(lens, stop_surface=1, aperture=Aperture("stop_semi_diameter", abs(float(rays.y[0]))))
    moved = paraxial_rays(shifted, inf, 0.5875618)
    first, second = seidel_sums(lens, rays).total(), seidel_sums(shifted, moved).total()
    assert second.spherical == pytest.approx(first.spherical, rel=1e-13)
    assert second.petzval == pytest.approx(first.petzval, rel=1e-13)
    # S_II* = S_II + Q·S_I with Q = δȳ/y at any surface (Welford 1986, eq. 8.37)
    shift = (moved.chief_y[0] - rays.chief_y[0]) / rays.y[0]
    assert second.coma == pytest.approx(first.coma + shift * first.spherical, rel=1e-12)
    expected = first.astigmatism + 2 * shift * first.coma + shift**2 * first.spherical
    assert second.astigmatism == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("factor", [1e-6, 0.01, 1e6])
def test_scaling_lens_and_wavelength_leaves_the_wavefront_alone(factor):
    lens = prescription_lens("asphere", 587.5618)
    scaled_surfaces = tuple(
        replace(
            s,
            radius=s.radius * factor,
            thickness=s.thickness * factor,
            semi_diameter=s.semi_diameter * factor,
            aspheric=tuple(a * factor ** -(3 + 2 * i) for i, a in enumerate(s.aspheric)),
        )
        for s in lens.surfaces
    )
    scaled = replace(
        lens, surfaces=scaled_surfaces, aperture=Aperture("stop_semi_diameter", lens.aperture.value * factor)
    )
    here, there = coefficients(lens, 300.0, 0.1, 0.5), coefficients(scaled, 300.0 * factor, 0.1, 0.5 * factor)
    for key in WAVES:
        assert getattr(there, key) == pytest.approx(getattr(here, key), rel=1e-12), key


def test_defocus_is_zero_at_the_image_and_follows_na_squared_off_it():
    lens = prescription_lens("eye_navarro", 543.0)
    c = coefficients(lens, 400.0, 0.1, 0.543)
    at_image = coefficients(with_sensor(lens, float(c.image_distance)), 400.0, 0.1, 0.543)
    assert abs(at_image.wd) < 1e-12
    away = coefficients(with_sensor(lens, float(c.image_distance) + 0.01), 400.0, 0.1, 0.543)
    assert away.wd == pytest.approx(c.na**2 * 0.01 / (2 * 1.3377 * 0.543e-3), rel=1e-10)


def test_powers_of_field_and_of_pupil():
    """W40, W31, W22, W20, W11 go with field to the 0, 1, 2, 2, 3 and with aperture to the 4, 3, 2, 2, 1."""
    lens = prescription_lens("cooke_triplet", 550.0)
    half = replace(lens, aperture=Aperture("stop_semi_diameter", lens.aperture.value / 2))
    near, far = coefficients(lens, inf, 0.1, 0.55), coefficients(lens, inf, 0.2, 0.55)
    stopped = coefficients(half, inf, 0.1, 0.55)
    for key, field_power, pupil_power in zip(WAVES, (0, 1, 2, 2, 3, 0), (4, 3, 2, 2, 1, 2), strict=True):
        assert getattr(far, key) == pytest.approx(2**field_power * getattr(near, key), rel=1e-13)
        assert getattr(stopped, key) == pytest.approx(getattr(near, key) / 2**pupil_power, rel=1e-13)


def test_a_plane_window_of_no_thickness_changes_nothing():
    lens = prescription_lens("tessar", 587.5618)
    window = (Surface(medium=ConstantIndex(1.6)), Surface(medium=AIR))
    more = replace(lens, surfaces=(*window, *lens.surfaces), stop_surface=lens.stop_surface + 2)
    before, after = coefficients(lens, 90.0, 0.2, 0.55), coefficients(more, 90.0, 0.2, 0.55)
    for key in WAVES:
        assert getattr(after, key) == pytest.approx(getattr(before, key), rel=1e-11), key


def test_image_at_infinity_keeps_the_coefficients_finite():
    lens = Lens((Surface(medium=ConstantIndex(2.0)), Surface(radius=-8.0)), Aperture("stop_semi_diameter", 1.0), 1)
    c = coefficients(lens, 8.0, 0.1, 0.5)
    assert np.isinf(c.image_distance) and c.na == 0
    assert all(np.isfinite(getattr(c, key)) for key in WAVES)
