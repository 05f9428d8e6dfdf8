"""Shapes of surfaces: their polynomials by definition, slopes and power series, and the surfaces that cannot be."""

from dataclasses import replace
from math import inf, nan

import numpy as np
import pytest
from mpmath import mp, mpf, taylor
from scipy.special import eval_jacobi

from p2sf.errors import GeometryError
from p2sf.lens.even_terms import even_asphere
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.shapes import Diffraction, Qbfs, Qcon, RadialPolynomial

SHAPES = {
    "odd": RadialPolynomial((1e-3, -2e-4, 3e-5, 0.0, 1e-6)),
    "extended": RadialPolynomial((0.0, 0.02, 0.0, -0.01, 0.0, 0.003), 9.0),
    "extended odd": RadialPolynomial((0.01, 0.02, -0.03, -0.01, 0.02), 9.0),
    "Qcon": Qcon((0.05, -0.02, 0.01, 3e-3), 9.0),
    "Qbfs": Qbfs((0.05, -0.02, 0.01, 3e-3), 9.0),
}
CURVATURE = 1 / 30


def unit(make, m: int):
    return make((*[0.0] * m, 1.0), 1.0)


def sag(shape, r, curvature: float = 0.0) -> np.ndarray:
    return np.asarray(shape.sag_and_slope(np.square(r), curvature)[0])


@pytest.mark.parametrize("m", [0, 1, 2, 5, 12, 30])
def test_qcon_is_jacobis_polynomial(m):
    """Forbes 2007: u⁴ times P⁽⁰⁴⁾ₘ(2u² − 1), here by scipy."""
    u = np.linspace(0, 1, 21)
    # Both round by some 1e-16 of the largest value, C(m + 4, m) at u = 0.
    assert sag(unit(Qcon, m), u) == pytest.approx(u**4 * eval_jacobi(m, 0, 4, 2 * u**2 - 1), abs=1e-12)


def test_slopes_of_qbfs_are_orthonormal():
    """Forbes 2007: the mean of SₘSₙ over 0 ≤ u ≤ 1 with weight 1/√(1 − u²) is δₘₙ, S the derivative by u.

    With u = sin t the weighted mean is the plain one over t, here by Gauss's rule; the slope is by central differences
    of the sag of a departure from a plane: their error is step²/6 of a third derivative of up to 1e5.
    """
    t, weight = np.polynomial.legendre.leggauss(80)
    u, step, count = np.sin((t + 1) * np.pi / 4), 1e-6, 16
    slopes = [(sag(unit(Qbfs, m), u + step) - sag(unit(Qbfs, m), u - step)) / (2 * step) for m in range(count)]
    gram = np.array([[weight / 2 @ (a * b) for b in slopes] for a in slopes])
    assert gram == pytest.approx(np.eye(count), abs=3e-8)


def test_qbfs_departs_along_the_normal_and_neither_at_the_vertex_nor_at_the_edge():
    shape, r = SHAPES["Qbfs"], np.linspace(0, 9, 19)
    cosine = np.sqrt(1 - (CURVATURE * r) ** 2)
    assert sag(shape, r, CURVATURE) == pytest.approx(sag(shape, r) / cosine, rel=1e-14, abs=1e-16)
    assert sag(shape, r, CURVATURE)[[0, -1]] == pytest.approx(0, abs=1e-15)
    with np.errstate(invalid="ignore"):
        assert np.isnan(shape.sag_and_slope(31.0**2, CURVATURE)[0]), "beyond the edge of the sphere"


@pytest.mark.parametrize("conic", [-2.0, -0.7, 0.4])
def test_qbfs_departs_along_the_normal_of_a_conic_too(conic):
    """At the angle of the normal that differences of the conic's own sag have: off by step²/6 of a third derivative."""
    shape, r, step = SHAPES["Qbfs"], np.linspace(0.5, 8.5, 17), 1e-5
    plain = Surface(1 / CURVATURE, conic=conic)
    slope = (plain.sag(0.0, r + step) - plain.sag(0.0, r - step)) / (2 * step)
    departure, _ = shape.sag_and_slope(r * r, CURVATURE, conic)
    assert departure == pytest.approx(sag(shape, r) * np.hypot(1, slope), rel=1e-9)


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
def test_the_slope_is_the_derivative_of_the_sag(shape):
    square, step = np.linspace(0.5, 80, 40), 1e-4
    above, below = (np.asarray(shape.sag_and_slope(square + way * step, CURVATURE)[0]) for way in (1, -1))
    # The sag, up to 0.2 mm, rounds by 3e-17; over twice the step that is 2e-13, and the third derivative adds 1e-10.
    assert shape.sag_and_slope(square, CURVATURE)[1] == pytest.approx((above - below) / (2 * step), abs=1e-9)
    above, below = (np.asarray(shape.sag_and_slope(square + way * step, CURVATURE, -0.6)[0]) for way in (1, -1))
    assert shape.sag_and_slope(square, CURVATURE, -0.6)[1] == pytest.approx((above - below) / (2 * step), abs=1e-9)


def test_a_power_of_the_radius_is_that_power():
    r = np.linspace(0, 3, 7)
    terms = (0.3, -0.2, 0.1, 0.05, -0.01)
    assert sag(RadialPolynomial(terms), r) == pytest.approx(sum(a * r**k for k, a in enumerate(terms, 1)), rel=1e-14)
    scaled = RadialPolynomial(terms, 2.0)
    assert sag(scaled, r) == pytest.approx(sum(a * (r / 2) ** k for k, a in enumerate(terms, 1)), rel=1e-14)
    assert np.asarray(scaled.sag_and_slope(0.0, 0.0)).tolist() == [0.0, -0.2 / 4], "the mean slope of a cone's vertex"


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
def test_the_power_series_at_the_vertex(shape):
    """Its four terms leave r⁵ or r⁶: halving a small radius takes 1/32 of the rest or less."""
    series = shape.series(CURVATURE)
    rest = [abs(float(sag(shape, r, CURVATURE)) - sum(a * r**k for k, a in enumerate(series, 1))) for r in (0.4, 0.2)]
    assert rest[1] <= rest[0] / 31 + 1e-17


def test_the_fourth_order_of_qbfs_on_a_sphere_in_50_digits():
    """The definition with Q₀ = 1 and Q₁ = (13 − 16x)/√19 (Forbes 2007), expanded by mpmath."""
    mp.dps, (a, b), c, edge = 50, (mpf("0.05"), mpf("-0.02")), mpf(1) / 30, mpf(9)

    def departure(r):
        x = (r / edge) ** 2
        return x * (1 - x) / mp.sqrt(1 - (c * r) ** 2) * (a + b * (13 - 16 * x) / mp.sqrt(19))

    true = [float(term) for term in taylor(departure, 0, 4)[1:]]
    assert Qbfs((0.05, -0.02), 9.0).series(1 / 30) == pytest.approx(true, rel=1e-13, abs=1e-18)


@pytest.mark.parametrize("count", [1, 4, 10, 14])
def test_qcon_is_an_even_asphere_exactly(count):
    shape = Qcon(tuple(0.01 * (-1) ** m / (m + 1) for m in range(count)), 8.0)
    r = np.linspace(0, 8, 41)
    # Cancellation: the largest power's coefficient, C(2m + 4, m) < 10^(0.6·2m + 1), times the rounding.
    close = 1e-18 * 10 ** (1.3 * count)
    assert sag(shape, r) == pytest.approx(
        sum(a * r ** (4 + 2 * k) for k, a in enumerate(shape.even_terms())), abs=close
    )


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
def test_a_shape_grows_with_its_lens(shape):
    r = np.linspace(0, 8, 9)
    assert sag(shape.scaled(3.0), 3 * r, CURVATURE / 3) == pytest.approx(3 * sag(shape, r, CURVATURE), rel=1e-13)


@pytest.mark.parametrize(("radius", "conic"), [(30.0, 0.0), (-25.0, -0.8), (inf, 0.0)])
def test_shapes_as_even_terms(radius, conic):
    r = np.linspace(0, 9, 91)
    plain = Surface(radius, conic=conic, aspheric=(1e-6, -1e-8))
    for shape in (SHAPES["Qcon"], RadialPolynomial((0.0, 0.0, 0.0, 0.01, 0.0, 0.02), 9.0)):
        made = even_asphere(replace(plain, shape=shape))
        assert made.residual_mm == 0 and made.surface.shape is None
        assert made.surface.sag(0.0, r) == pytest.approx(replace(plain, shape=shape).sag(0.0, r), abs=1e-15)
    square = replace(plain, shape=SHAPES["extended"], semi_diameter=9.0)
    made = even_asphere(square)
    assert made.surface.curvature == pytest.approx(square.vertex_curvature, rel=1e-15)
    assert made.residual_mm < 1e-9


def test_qbfs_as_even_terms_says_what_it_leaves():
    """More terms leave less; what is left is the largest difference of sag found elsewhere too."""
    surface, r = Surface(30.0, shape=SHAPES["Qbfs"]), np.linspace(0, 9, 777)
    left = [even_asphere(surface, terms) for terms in (4, 8, 12)]
    for made in left:
        found = np.abs(made.surface.sag(0.0, r) - surface.sag(0.0, r)).max()
        assert made.residual_mm == pytest.approx(found, rel=0.02, abs=2e-15)
        assert made.surface.curvature == surface.vertex_curvature
    assert left[0].residual_mm > 1e3 * left[1].residual_mm and left[2].residual_mm < 1e-9
    with pytest.raises(GeometryError, match="odd powers of the radius"):
        even_asphere(Surface(shape=SHAPES["odd"]))


def lens(**values) -> Lens:
    return Lens((replace(Surface(30.0, 5.0), **values),), Aperture("stop_semi_diameter", 1.0), 1)


@pytest.mark.parametrize(
    ("values", "part"),
    [
        ({"shape": Qcon((1.0,), 0.0)}, "normalisation radius 0.0 mm"),
        ({"shape": Qbfs((1.0,), inf)}, "normalisation radius inf mm"),
        ({"shape": RadialPolynomial((1.0,), 1e160)}, r"normalisation radius 1e\+160 mm; give .* from 1e-06 to 1e\+06"),
        ({"diffraction": Diffraction((1.0,), 1e-160)}, "normalisation radius 1e-160 mm"),
        ({"shape": RadialPolynomial((1.0, nan))}, "not finite"),
        ({"diffraction": Diffraction((1.0,), 5.0, inf)}, "not finite"),
    ],
)
def test_a_surface_that_cannot_be_is_refused_with_its_number_and_value(values, part):
    with pytest.raises(GeometryError, match="surface 1: .*" + part):
        lens(**values)


def test_what_a_plane_is():
    assert Surface().flat and Surface().bare
    assert not Surface(shape=Qcon((1e-3,), 5.0)).flat
    assert Surface(diffraction=Diffraction((1.0,), 5.0)).flat and not Surface(diffraction=Diffraction((1.0,), 5.0)).bare
