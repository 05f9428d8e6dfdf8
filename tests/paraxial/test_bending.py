"""Bending keeps an element's thin-lens power; its aberrations follow the textbook."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from p2sf.errors import GeometryError
from p2sf.glass.media import AIR, ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.bending import bend, element_of, elements, shape_factor, thin_power, with_shape_factor
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.seidel import coefficients

INDEX = 1.5


def thin(shape: float, focal: float = 100.0) -> Lens:
    """Return a thin lens in air of this shape factor, from c₁ − c₂ = 1/((n − 1)f) and the definition of X."""
    difference = 1 / ((INDEX - 1) * focal)
    front, back = (shape + 1) * difference / 2, (shape - 1) * difference / 2
    surfaces = (
        Surface(1 / front if front else inf, 0.0, ConstantIndex(INDEX)),
        Surface(1 / back if back else inf, focal, AIR),
    )
    return Lens(surfaces, Aperture("entrance_pupil_diameter", 5.0), stop_surface=1)


def test_elements_of_the_double_gauss_are_four_singlets_and_doublets():
    lens = find_lens("double_gauss_28")
    assert elements(lens) == ((1, 2), (3, 5), (7, 9), (10, 11))
    assert element_of(lens, 4) == (3, 5) and element_of(lens, 6) is None


def test_the_eye_has_its_vitreous_behind_and_no_element_in_air():
    assert elements(find_lens("eye_navarro")) == ()
    with pytest.raises(GeometryError, match="not an element"):
        bend(find_lens("eye_navarro"), 1, 2, 1e-3)


LONG = {"cassegrain_f10", "maksutov", "microscope_10x", "telecentric_relay", "zoom_3x"}  # seconds, and like others here


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(set(shipped_lenses()) - LONG))
@given(by=st.floats(-0.02, 0.02))
def test_bending_keeps_the_thin_power_at_every_wavelength(name, by):
    lens = find_lens(name)
    wavelengths = np.array([0.5, 0.5876, 0.65])
    for first, last in elements(lens):
        made = bend(lens, first, last, by)
        scale = sum(abs(lens.curvatures[k - 1]) + abs(by) for k in range(first, last + 1))
        # 1e-12 of the summed curvatures: the rounding of a dozen sums and reciprocals
        assert thin_power(made, first, last, wavelengths) == pytest.approx(
            thin_power(lens, first, last, wavelengths), abs=1e-12 * scale
        )
        others = [k for k in range(len(lens.surfaces)) if not first <= k + 1 <= last]
        assert all(made.surfaces[k] == lens.surfaces[k] for k in others)


@given(shape=st.floats(-8, 8))
def test_a_thin_lens_keeps_its_focal_length_and_has_the_shape_asked_for(shape):
    made = with_shape_factor(thin(0.3), 1, 2, shape)
    assert shape_factor(made, 1, 2) == pytest.approx(shape, abs=1e-9)
    assert float(cardinal_points(made, 0.5876).effective_focal_length) == pytest.approx(100, rel=1e-12)


def test_the_shapes_of_the_textbook():
    assert shape_factor(thin(0.0), 1, 2) == pytest.approx(0)
    plano = thin(1.0)
    assert plano.surfaces[1].radius == inf and shape_factor(plano, 1, 2) == 1
    lens = replace(plano, surfaces=(plano.surfaces[0], replace(plano.surfaces[1], radius=plano.surfaces[0].radius)))
    assert shape_factor(lens, 1, 2) == inf
    with pytest.raises(GeometryError, match="equally curved"):
        with_shape_factor(lens, 1, 2, 1.0)


def test_spherical_aberration_is_least_where_the_textbook_bends_the_lens():
    """For an object at infinity at X = 2(n² − 1)/(n + 2) (Hecht 2017, eq. 6.44 and 6.45; Jenkins and White §9.5)."""
    shapes = np.linspace(-1.0, 2.5, 141)
    w40 = [float(coefficients(with_shape_factor(thin(0.0), 1, 2, x), inf, 0.0, 0.5876).w40) for x in shapes]
    fit = np.polynomial.Polynomial.fit(shapes, w40, 2)  # W40 of a thin lens is a parabola in X
    assert fit.deriv().roots()[0] == pytest.approx(2 * (INDEX**2 - 1) / (INDEX + 2), abs=1e-6)
    assert fit(shapes) == pytest.approx(w40, abs=1e-9 * max(w40))


def test_bent_to_a_plane_and_back():
    lens = thin(0.4)
    plane = bend(lens, 1, 2, -lens.curvatures[0])
    assert plane.surfaces[0].radius == inf
    assert bend(plane, 1, 2, lens.curvatures[0]).curvatures == pytest.approx(lens.curvatures, rel=1e-12)
