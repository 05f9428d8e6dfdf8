"""Laws of optics as properties of random lenses, without golden numbers.

Each tolerance is a multiple of what the quantity is made of: the sizes that cancel in it, times the rounding of
a handful of surfaces (1e-13 ≈ 450 roundings).
"""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from p2sf.errors import P2SFError
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.paraxial.first_order import abcd, basis_rays, cardinal_points, image_distance, magnification
from p2sf.paraxial.pupils import find_stop, paraxial_rays, pupils
from p2sf.paraxial.seidel import coefficients, seidel_sums
from tests.support.lenses.random_lenses import between, depths, lenses, rays_or_skip, slopes, wavelengths

ROUNDING = 1e-13
SHAPES = ("w40", "w31", "w22", "w20", "w11", "wd")


@given(lenses(), wavelengths)
def test_the_system_matrix_has_determinant_one(lens, wavelength):
    rays = basis_rays(lens, wavelength)
    sizes = np.abs(rays.a * rays.d) + np.abs(rays.b * rays.c)
    assert np.all(np.abs(rays.a * rays.d - rays.b * rays.c - 1) <= ROUNDING * (1 + sizes.max()))


@given(lenses(), depths, wavelengths)
def test_the_lagrange_invariant_is_the_same_at_every_surface(lens, depth, wavelength):
    rays = rays_or_skip(lens, depth, wavelength)
    before = rays.chief_nu[:-1] * rays.y - rays.nu[:-1] * rays.chief_y
    behind = rays.chief_nu[1:] * rays.y - rays.nu[1:] * rays.chief_y
    sizes = np.abs(rays.chief_nu).max() * np.abs(rays.y).max() + np.abs(rays.nu).max() * np.abs(rays.chief_y).max()
    for values in (before, behind):
        np.testing.assert_allclose(values, rays.invariant, rtol=0, atol=10 * ROUNDING * sizes)


@given(lenses(), depths, wavelengths)
def test_the_chief_ray_crosses_the_stop_and_the_marginal_ray_touches_its_rim(lens, depth, wavelength):
    rays = rays_or_skip(lens, depth, wavelength)
    at = lens.stop_surface - 1
    assert rays.chief_y[at] == 0
    # a·y1 + b·nu1 at the stop: two terms that cancel when the object is close to the entrance pupil
    terms = np.abs(rays.y[0] * basis_rays(lens, wavelength).a[at]) + abs(
        rays.nu[0] * basis_rays(lens, wavelength).b[at]
    )
    assert abs(abs(rays.y[at]) - lens.aperture.value) <= ROUNDING * terms


def reversed_lens(lens: Lens) -> Lens:
    """Return the lens turned round, light entering where it left; the last gap is kept as sensor distance."""
    media = lens.media
    rows = []
    for j in range(len(lens.surfaces) - 1, -1, -1):
        surface = lens.surfaces[j]
        gap = lens.surfaces[j - 1].thickness if j else lens.sensor_mm
        rows.append(Surface(-surface.radius, gap, media[j], surface.conic, tuple(-a for a in surface.aspheric)))
    stop = len(rows) + 1 - lens.stop_surface
    return replace(lens, surfaces=tuple(rows), object_medium=media[-1], stop_surface=stop)


@given(lenses(), wavelengths)
def test_a_reversed_lens_swaps_a_and_d_its_foci_and_its_pupils(lens, wavelength):
    turned = reversed_lens(lens)
    (a, b), (c, d) = abcd(lens, wavelength)
    (a2, b2), (c2, d2) = abcd(turned, wavelength)
    size = np.abs([a, b, c, d]).max() + np.abs(basis_rays(lens, wavelength).b).max()
    np.testing.assert_allclose([a2, b2, c2, d2], [d, b, c, a], rtol=0, atol=ROUNDING * (1 + size) * 10)
    one, two = pupils(lens, wavelength), pupils(turned, wavelength)
    assume(all(abs(x) < 1e3 for x in (*vars(one).values(), *vars(two).values())))
    np.testing.assert_allclose(-two.exit_from_last, one.entrance_from_first, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(two.exit_diameter, one.entrance_diameter, rtol=1e-9)


@given(lenses(), between(5.0, 500.0), wavelengths)
def test_light_goes_back_the_way_it_came(lens, depth, wavelength):
    """The image, taken as object of the reversed lens, is imaged onto the object, at 1/m (Helmholtz), in any media.

    A bare plane 10 mm before the image stands in for the last vertex, so that virtual images serve too.
    """
    image, m = float(image_distance(lens, depth, wavelength)), float(magnification(lens, depth, wavelength))
    assume(abs(image) < 1e4 and 1e-3 < abs(m) < 1e3)
    last = replace(lens.surfaces[-1], thickness=image - 10.0)
    plane = Surface(inf, 10.0, last.medium)
    back = reversed_lens(replace(lens, surfaces=(*lens.surfaces[:-1], last, plane)))
    np.testing.assert_allclose(image_distance(back, 10.0, wavelength), depth, rtol=1e-8)
    np.testing.assert_allclose(magnification(back, 10.0, wavelength) * m, 1, rtol=1e-8)


@given(lenses(), depths, slopes, wavelengths, st.integers(-20, 20))
def test_scaling_lens_depth_and_wavelength_by_a_power_of_two_changes_no_bit_of_w(lens, depth, slope, wavelength, power):
    k = 2.0**power
    surfaces = tuple(
        replace(s, radius=s.radius * k, thickness=s.thickness * k, aspheric=tuple(a / k**3 for a in s.aspheric))
        for s in lens.surfaces
    )
    grown = replace(lens, surfaces=surfaces, aperture=replace(lens.aperture, value=lens.aperture.value * k))
    rays_or_skip(lens, depth, wavelength)
    one, two = coefficients(lens, depth, slope, wavelength), coefficients(grown, depth * k, slope, wavelength * k)
    for name in SHAPES:
        np.testing.assert_allclose(getattr(two, name), getattr(one, name), rtol=1e-15, atol=0)


@given(lenses(), depths, slopes, wavelengths, between(5.0, 300.0), st.data())
def test_a_cemented_surface_between_equal_media_is_not_there(lens, depth, slope, wavelength, radius, data):
    """A zero-thickness surface of any shape with Δn = 0 adds exactly nothing, wherever it sits."""
    at = data.draw(st.integers(0, len(lens.surfaces)))
    ghost = Surface(radius, 0.0, lens.media[at], 0.7, (1e-4,))
    stop = lens.stop_surface + (at < lens.stop_surface)
    longer = replace(lens, surfaces=(*lens.surfaces[:at], ghost, *lens.surfaces[at:]), stop_surface=stop)
    if at == len(lens.surfaces):  # the gap to the sensor moves behind the ghost
        body = replace(lens.surfaces[-1], thickness=0.0)
        last = replace(ghost, thickness=lens.sensor_mm)
        longer = replace(longer, surfaces=(*lens.surfaces[:-1], body, last))
    elif at:
        before = replace(lens.surfaces[at - 1], thickness=0.0)
        ghost = replace(ghost, thickness=lens.surfaces[at - 1].thickness)
        longer = replace(longer, surfaces=(*lens.surfaces[: at - 1], before, ghost, *lens.surfaces[at:]))
    rays_or_skip(lens, depth, wavelength)
    one, two = coefficients(lens, depth, slope, wavelength), coefficients(longer, depth, slope, wavelength)
    sums = seidel_sums(lens, paraxial_rays(lens, depth, wavelength), slope)
    scales = (1 / 8, 1 / 2, 1 / 2, 1 / 2, 1 / 2)
    for name, column, share in zip(SHAPES, sums.columns(), scales, strict=False):
        size = np.abs(column).sum() * share * 1000 / wavelength
        extra = np.abs(sums.astigmatism).sum() * 1000 / wavelength if name == "w20" else 0
        np.testing.assert_allclose(getattr(two, name), getattr(one, name), rtol=1e-9, atol=1e-10 * (size + extra))


@given(lenses(most=4), between(20.0, 500.0), wavelengths)
def test_the_order_of_cemented_zero_power_surfaces_does_not_matter(lens, depth, wavelength):
    """Two plane-parallel foils of no thickness between equal media, in either order, are the same lens."""
    foils = (Surface(inf, 0.0, ConstantIndex(1.5)), Surface(inf, 0.0, ConstantIndex(1.8)))
    tail = Surface(inf, lens.sensor_mm, lens.media[-1])
    head = (*lens.surfaces[:-1], replace(lens.surfaces[-1], thickness=0.0))
    one, two = (replace(lens, surfaces=(*head, *pair, tail)) for pair in (foils, foils[::-1]))
    rays_or_skip(lens, depth, wavelength)
    first, second = (abcd(x, wavelength) for x in (one, two))
    np.testing.assert_array_equal(first, second)
    a, b, c = (coefficients(x, depth, 0.1, wavelength) for x in (one, two, lens))
    sums = seidel_sums(one, paraxial_rays(one, depth, wavelength), 0.1)
    sizes = 1000 / wavelength * sum(np.abs(x).sum() for x in sums.columns()) + abs(a.wd)
    for name in SHAPES:
        np.testing.assert_allclose(getattr(a, name), getattr(b, name), rtol=0, atol=ROUNDING * sizes)
        np.testing.assert_allclose(getattr(a, name), getattr(c, name), rtol=0, atol=ROUNDING * sizes)


@given(lenses(), depths, slopes, wavelengths)
def test_every_coefficient_is_its_own_power_of_the_field(lens, depth, slope, wavelength):
    rays_or_skip(lens, depth, wavelength)
    one, two = (coefficients(lens, depth, x, wavelength) for x in (slope, 2 * slope))
    for name, power in zip(SHAPES, (0, 1, 2, 2, 3, 0), strict=True):
        assert getattr(two, name) == 2**power * getattr(one, name)


@given(between(1.05, 2.5), between(5.0, 500.0), between(0.5, 3.0))
def test_a_conic_of_minus_the_square_of_the_index_ratio_focuses_collimated_light(index, radius, rim):
    """Descartes: K = −(n/n')² images infinity perfectly on the axis."""
    surface = Surface(radius, 10.0, ConstantIndex(index), -1 / index**2)
    pair = (Lens((x,), Aperture("stop_semi_diameter", rim), 1) for x in (surface, replace(surface, conic=0.0)))
    exact, plain = (float(coefficients(x, inf, 0.0, 0.5).w40) for x in pair)
    assert abs(exact) <= ROUNDING * abs(plain) * 100


@given(lenses(), st.lists(depths, min_size=2, max_size=4), st.lists(between(0.3, 2.0), min_size=2, max_size=4))
def test_arrays_in_any_order_give_each_its_own_answer(lens, depth, wavelength):
    """Axes need not be sorted: a reversed wavelength axis reverses the answer and changes no bit."""
    for one in depth:
        rays_or_skip(lens, one, 0.5)
    column, row = np.array(depth)[:, None, None], np.array(wavelength)
    table = coefficients(lens, column, np.array([0.0, 0.3])[:, None], row)
    turned = coefficients(lens, column[::-1], np.array([0.0, 0.3])[:, None], row[::-1])
    for name in SHAPES:
        shape = (len(depth), 2, len(wavelength))
        values, again = (np.broadcast_to(getattr(x, name), shape) for x in (table, turned))
        np.testing.assert_array_equal(values, again[::-1, :, ::-1])


@pytest.mark.slow
@settings(max_examples=200, deadline=None, derandomize=True)
@given(lenses(), depths, slopes, wavelengths)
def test_no_public_function_of_the_core_returns_nan(lens, depth, slope, wavelength):
    """A number, an infinity, or an error that says why; never NaN."""
    calls = (
        lambda: vars(cardinal_points(lens, wavelength)) | vars(pupils(lens, wavelength)),
        lambda: {"image": image_distance(lens, depth, wavelength), "m": magnification(lens, depth, wavelength)},
        lambda: {"stop": find_stop(lens, depth, wavelength, "auto").limiting_surface},
        lambda: vars(coefficients(lens, depth, slope, wavelength)),
    )
    for call in calls:
        try:
            found = call()
        except P2SFError:
            continue
        assert not any(np.isnan(value).any() for value in found.values()), found
