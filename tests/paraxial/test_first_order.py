"""First-order optics against the witness and against the laws it has to obey."""

from dataclasses import asdict, replace
from math import inf

import numpy as np
import pytest

from p2sf.errors import GeometryError
from p2sf.glass.media import AIR, ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.paraxial.first_order import abcd, basis_rays, cardinal_points, image_distance, magnification
from tests.support.reference import LENSES, prescription_lens, reference

# The figure; float64 reaches 2e-14 on every lens, the witness has 60 digits.
FIRST_ORDER = 1e-10


def rows(name):
    return [(float(key), value) for key, value in reference(name)["first_order"].items()]


@pytest.mark.parametrize("name", LENSES)
def test_cardinal_points_are_the_witnesses(name):
    for wavelength_nm, row in rows(name):
        lens = prescription_lens(name, wavelength_nm)
        found = asdict(cardinal_points(lens, wavelength_nm / 1000))
        for key, value in found.items():
            assert value == pytest.approx(row[key], rel=FIRST_ORDER), key


@pytest.mark.parametrize("name", LENSES)
def test_system_matrix_is_the_witnesses_and_has_determinant_one(name):
    for wavelength_nm, row in rows(name):
        matrix = abcd(prescription_lens(name, wavelength_nm), wavelength_nm / 1000)
        np.testing.assert_allclose(matrix.ravel(), row["abcd"], rtol=FIRST_ORDER)
        # det = AD − BC of two products near 1: rounding of a dozen surfaces, and BC up to 250 for the relay.
        assert np.linalg.det(matrix) == pytest.approx(1, abs=1e-12)


def test_the_papers_authors_find_the_same_matrix():
    """Their Double Gauss has a last radius of −79.45081 and is traced at 656.3000 nm."""
    lens = prescription_lens("double_gauss_28", 656.2725)
    theirs = replace(lens, surfaces=(*lens.surfaces[:-1], replace(lens.surfaces[-1], radius=-79.45081)))
    expected = [0.6153504663927666, 81.89894773187979, -0.009991288783699055, 0.29531782627060393]
    # 656.3000 against 656.2725 nm moves the indices by 1e-6, hence the matrix by a few 1e-6.
    np.testing.assert_allclose(abcd(theirs, 0.6562725).ravel(), expected, rtol=5e-6)


def test_arrays_equal_the_loop_over_their_elements():
    lens = prescription_lens("double_gauss_28", 587.5618)
    depth = np.array([[300.0], [2000.0], [inf]])
    wavelength = np.array([0.5, 0.6])
    table = image_distance(lens, depth, wavelength)
    assert table.shape == (3, 2)
    for i, j in np.ndindex(table.shape):
        assert table[i, j] == image_distance(lens, depth[i, 0], wavelength[j])


@pytest.mark.parametrize("depth_mm", [200.0, 1e3, 1e9, inf])
def test_newton_equation_links_object_and_image(depth_mm):
    """x·x' = n·n'·f·f/(n·n') in air: (object from F)(image from F') = −f² (Newton)."""
    lens = prescription_lens("tessar", 587.5618)
    points = cardinal_points(lens, 0.5875618)
    from_front = -depth_mm - points.front_focal_distance
    from_back = image_distance(lens, depth_mm, 0.5875618) - points.back_focal_distance
    if depth_mm == inf:
        assert from_back == pytest.approx(0, abs=1e-12)
    else:
        f = points.effective_focal_length
        # 1e-9: at 1e9 mm the image stands 1e-8 mm behind F', a difference of numbers near 3.4
        assert from_front * from_back == pytest.approx(-(f**2), rel=1e-12 if depth_mm < 1e6 else 1e-6)


def test_magnification_is_the_ratio_of_principal_distances():
    lens = prescription_lens("cooke_triplet", 550)
    points = cardinal_points(lens, 0.55)
    depth = 400.0
    to_image = image_distance(lens, depth, 0.55) - points.rear_principal_from_last
    to_object = depth + points.front_principal_from_first
    assert magnification(lens, depth, 0.55) == pytest.approx(-to_image / to_object, rel=1e-13)
    assert magnification(lens, inf, 0.55) == 0


def afocal():
    """Galilean telescope of two thin surfaces' worth of glass: powers chosen so that C is exactly zero."""
    glass = ConstantIndex(1.5)
    front = Surface(radius=10.0, thickness=15.0, medium=glass)
    return Lens((front, Surface(radius=5.0, medium=AIR)), Aperture("stop_semi_diameter", 1.0), 1)


def test_afocal_lens_has_infinite_focal_length_and_finite_magnification():
    lens = afocal()
    assert basis_rays(lens, 0.5).c[-1] == 0
    points = cardinal_points(lens, 0.5)
    assert all(np.isinf(value) for value in asdict(points).values())
    assert np.isinf(image_distance(lens, inf, 0.5))
    assert magnification(lens, 100.0, 0.5) == pytest.approx(0.5, rel=1e-15)


@pytest.mark.parametrize("depth_mm", [0.0, -5.0, np.nan])
def test_depth_must_be_positive(depth_mm):
    with pytest.raises(GeometryError, match=r"depth is .* mm"):
        image_distance(prescription_lens("tessar", 587.5618), depth_mm, 0.5875618)


def test_object_in_the_front_focal_plane_has_its_image_at_infinity():
    lens = Lens(
        (Surface(radius=inf, medium=ConstantIndex(2.0)), Surface(radius=-8.0)), Aperture("stop_semi_diameter", 1), 1
    )
    # C = −1/8 exactly, D = 1: F stands 8 mm before the first vertex, without rounding
    assert np.isinf(image_distance(lens, 8.0, 0.5))
