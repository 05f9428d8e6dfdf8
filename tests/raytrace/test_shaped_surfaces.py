"""Exact rays through shaped and diffractive surfaces: Fermat's principle, perfect foci, the limit that Seidel sums are.

No formula of the tracer is used: optical paths are added up from points, with a sag and a phase written out here.
"""

from dataclasses import replace
from functools import partial
from math import pi, sqrt

import numpy as np
import pytest
from mpmath import mp, mpf, taylor

from p2sf.glass.media import MIRROR, ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface, with_aim, with_sensor
from p2sf.lens.shapes import Diffraction, Qbfs, Qcon, RadialPolynomial
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.seidel import coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.raytrace.aiming import Sources
from p2sf.raytrace.pencil import displayed_opd, pencil
from p2sf.raytrace.surface import Status
from p2sf.raytrace.trace import status_message, trace
from tests.support.lenses.shaped_lenses import (
    CONE,
    EXTENDED,
    ODD,
    OTHER_PHASE,
    PARTS,
    PHASE,
    QBFS,
    QCON,
    UNSEEN_BY_SEIDEL,
    hybrid,
    singlet,
    two_shaped_mirrors,
)

UM = 0.55
mp.dps = 40


def height(surface: Surface, x, y):
    """Return the sag by its definition, in as many digits as mpmath has."""
    square = x * x + y * y
    c = mpf(1) / surface.radius
    z = c * square / (1 + mp.sqrt(1 - (1 + mpf(surface.conic)) * c * c * square))
    z += sum(a * square**k for k, a in enumerate(surface.aspheric, 2))
    shape = surface.shape
    if shape is None:
        return z
    r, u = mp.sqrt(square), mp.sqrt(square) / shape.normalisation_mm
    if isinstance(shape, RadialPolynomial):
        return z + sum(a * u**k for k, a in enumerate(shape.coefficients, 1))
    if isinstance(shape, Qcon):
        return z + u**4 * sum(a * mp.jacobi(m, 0, 4, 2 * u * u - 1) for m, a in enumerate(shape.coefficients))
    assert isinstance(shape, Qbfs)
    # The first three by Forbes 2007, table 1.
    known = 1, (13 - 16 * u**2) / mp.sqrt(19), mp.sqrt(mpf(2) / 95) * (29 - 4 * u**2 * (25 - 19 * u**2))
    bumps = sum(a * q for a, q in zip(shape.coefficients, known, strict=True))
    return z + u**2 * (1 - u**2) / mp.sqrt(1 - (c * r) ** 2) * bumps


def optical_path(surface: Surface, n, after, wavelength_um, one, other, at) -> mpf:
    """Return the path from point ``one`` by a point (x, y) of the surface to ``other``, mm."""
    x, y = at
    on = mpf(x), mpf(y), height(surface, mpf(x), mpf(y))
    legs = [mp.sqrt(sum((mpf(a) - b) ** 2 for a, b in zip(end, on, strict=True))) for end in (one, other)]
    path = n * legs[0] + after * legs[1]
    if surface.diffraction is None:
        return path
    d = surface.diffraction
    rho = (on[0] ** 2 + on[1] ** 2) / mpf(d.normalisation_mm) ** 2
    phase = d.order * sum(a * rho**j for j, a in enumerate(d.coefficients, 1))
    return path + phase * mpf(wavelength_um) / 1000 / (2 * mp.pi)


SURFACES = {
    "odd": {"shape": ODD},
    "cone": {"shape": CONE, "conic": -1.0},
    "extended": {"shape": EXTENDED, "conic": 0.3},
    "Qcon": {"shape": QCON, "conic": -0.7},
    "Qbfs": {"shape": QBFS},
    "phase": {"diffraction": PHASE},
    "everything": {"shape": QBFS, "aspheric": (1e-5,), "diffraction": OTHER_PHASE},
}


@pytest.mark.parametrize("values", SURFACES.values(), ids=SURFACES)
@pytest.mark.parametrize("reflects", [False, True])
def test_the_path_of_a_skew_ray_is_stationary(values, reflects):
    """Fermat: with the ends held, moving the point on the surface changes the path in second order only."""
    before, after = (1.33, MIRROR) if reflects else (1.33, ConstantIndex(1.62))
    surface = Surface(35.0, -20.0 if reflects else 20.0, after, **values)
    lens = Lens((surface,), Aperture("stop_semi_diameter", 5.0), 1, object_medium=ConstantIndex(before))
    found = trace(lens, [[1.0, -2.0, -8.0]], [[0.1, 0.25, 1.0]], UM)
    assert found.status[0] == Status.PASSED
    one, on, other = found.points[:, 0]
    n, behind = mpf(before), mpf(before if reflects else 1.62)
    walk = partial(optical_path, surface, n, behind, UM, one, other)
    assert on[2] == pytest.approx(float(height(surface, mpf(on[0]), mpf(on[1]))), abs=1e-15)
    assert found.path[0] == pytest.approx(float(walk(on[:2])), rel=1e-15)
    step = 1e-6  # mm; the central difference errs by its square, the traced point by 1e-15 times a curvature of 0.1/mm
    for turn in ((step, 0), (0, step)):
        slope = (walk(on[:2] + turn) - walk(on[:2] - np.array(turn))) / (2 * step)
        assert abs(slope) < 2e-14


@pytest.mark.parametrize("radius", [np.inf, 80.0, -120.0])
@pytest.mark.parametrize("order", [1.0, 2.0])
@pytest.mark.parametrize("reflects", [False, True])
def test_a_phase_that_makes_all_paths_equal_focuses_perfectly(radius, order, reflects):
    """A kinoform on a curved surface; the phase's power series to r²⁰ leaves less than 1e-12 waves at f/5."""
    f, index, away = mpf(100), mpf("1.5"), -1 if reflects else 1
    n, end = (index, index) if reflects else (index, mpf(1))

    def phase(r):
        c = mpf(1) / radius
        sag = c * r * r / (1 + mp.sqrt(1 - c * c * r * r))
        path = n * sag + end * mp.sqrt((away * f - sag) ** 2 + r * r) - end * f
        return -path / (mpf(UM) / 1000) * 2 * mp.pi / order

    terms = tuple(float(a) * 10.0 ** (2 * k) for k, a in enumerate(taylor(phase, 0, 20)[2::2], 1))
    medium = MIRROR if reflects else ConstantIndex(1.0)
    surface = Surface(radius, float(away * f), medium, diffraction=Diffraction(terms, 10.0, order))
    lens = Lens((surface,), Aperture("stop_semi_diameter", 10.0), 1, object_medium=ConstantIndex(1.5))
    rim = np.linspace(-1, 1, 9)
    assert float(image_distance(lens, np.inf, UM)) == pytest.approx(float(away * f), rel=1e-13)
    rays = pencil(lens, Source(wavelength_um=UM), 0 * rim, rim)
    assert np.abs(rays.dy).max() < 1e-13 and np.abs(rays.path).max() < 1e-12
    assert abs(float(coefficients(lens, np.inf, 0.0, UM).w40)) < 1e-10, "and so has no S_I"
    assert np.abs(pencil(lens, Source(wavelength_um=1.2 * UM), 0 * rim, rim).path).max() > 1e-3


@pytest.mark.parametrize("make", [singlet, two_shaped_mirrors])
@pytest.mark.parametrize("parts", PARTS.values(), ids=PARTS)
def test_exact_path_differences_tend_to_those_of_seidel(make, parts):
    """Aperture and field halved together: W falls by 16 and the sixth order by 64, so that their ratio falls by 4."""
    angle = np.linspace(0, np.pi, 9)
    xi, eta = (np.concatenate([r * f(angle) for r in (0.4, 0.7, 1.0)]) for f in (np.sin, np.cos))
    rest = []
    for part in (0.25, 0.125, 0.0625):
        lens = with_aim(make(*parts, rim=4.0 * part), "paraxial")
        lens = with_sensor(lens, float(image_distance(lens, 400.0, UM)))
        six = coefficients(lens, 400.0, 0.1 * part, UM)
        w = wavefront(six, xi, eta)
        exact = displayed_opd(lens, Source(400.0, 0.1 * part, UM), xi, eta)
        rest.append(np.abs(exact - w).max() / np.abs(w).max())
    assert rest[-1] < 0.03 and rest[1] / rest[2] == pytest.approx(4, rel=0.05), rest


def test_a_qcon_surface_and_its_even_terms_bend_rays_alike():
    plain = replace(Surface(30.0, 4.0, ConstantIndex(1.6)), conic=-0.4)
    shape = Qcon((0.3, -0.1, 0.05, 0.02, -0.01), 10.0)
    pair = replace(plain, shape=shape), replace(plain, aspheric=shape.even_terms())
    rng = np.random.default_rng(1)
    start = np.column_stack([rng.uniform(-6, 6, (200, 2)), np.full(200, -5.0)])
    along = np.column_stack([rng.uniform(-0.3, 0.3, (200, 2)), np.ones(200)])
    lenses = [Lens((surface,), Aperture("stop_semi_diameter", 5.0), 1) for surface in pair]
    one, two = (trace(lens, start, along, UM) for lens in lenses)
    assert (one.status == Status.PASSED).all()
    np.testing.assert_allclose(one.points, two.points, rtol=0, atol=2e-14)  # rounding of some 10 mm
    np.testing.assert_allclose(one.cosines, two.cosines, rtol=0, atol=5e-15)
    for name in ("w40", "w31", "w22", "w20", "w11", "wd"):
        values = [getattr(coefficients(lens, 300.0, 0.1, UM), name) for lens in lenses]
        assert values[0] == pytest.approx(values[1], rel=1e-12)


def test_an_order_is_a_multiple_of_the_phase():
    many = singlet({"diffraction": replace(PHASE, order=-2.0)})
    plain = singlet({"diffraction": replace(PHASE, coefficients=tuple(-2 * a for a in PHASE.coefficients))})
    args = Source(field_slope=0.05), np.linspace(0, 1, 5), np.linspace(-1, 1, 5)
    assert pencil(many, *args).path == pytest.approx(pencil(plain, *args).path, rel=1e-12)


@pytest.mark.parametrize("aim", ["stop", "paraxial"])
def test_several_wavelengths_at_once_are_those_one_by_one(aim):
    lens, waves = with_aim(hybrid(), aim), np.array([0.45, 0.55, 0.65])
    xi, eta = np.linspace(0, 0.7, 30), np.linspace(-0.7, 0.7, 30)
    depths = np.array([[np.inf], [900.0]])
    together = pencil(lens, Sources(depths, 0.06, waves), xi, eta)
    for i, depth in enumerate(depths[:, 0]):
        for j, wave in enumerate(waves):
            alone = pencil(lens, Source(float(depth), 0.06, float(wave)), xi, eta)
            np.testing.assert_allclose(together.path[i, j], alone.path, rtol=0, atol=1e-9)
            np.testing.assert_allclose(together.dy[i, j], alone.dy, rtol=0, atol=1e-8)


def test_an_order_that_does_not_propagate_is_named():
    """In air the sine cannot exceed 1: λ/2π·dφ/dr = 2·A₁·r·λ/2π reaches 1 at r = π/(λA₁)."""
    lens = Lens(
        (Surface(thickness=5.0, diffraction=Diffraction((-1e4,), 1.0)),), Aperture("stop_semi_diameter", 1.0), 1
    )
    edge = pi / (UM * 1e-3 * 1e4)
    starts = [[0.0, edge * (1 - 1e-6), -1.0], [0.0, edge * (1 + 1e-6), -1.0]]
    found = trace(lens, starts, [[0, 0, 1.0]], UM)
    assert found.status.tolist() == [Status.PASSED, Status.EVANESCENT]
    assert "no diffracted direction behind surface 1" in str(
        status_message(lens, *(int(a[1]) for a in (found.status, found.failed_surface)))
    )


@pytest.mark.parametrize("parts", UNSEEN_BY_SEIDEL.values(), ids=UNSEEN_BY_SEIDEL)
def test_the_ray_through_the_vertex_of_a_cone_or_cusp_goes_on_as_by_symmetry(parts):
    lens = singlet(*parts)
    found = trace(lens, [[0.0, 0.0, -2.0]], [[0, 0, 1.0]], UM)
    assert found.points[-1, 0] == pytest.approx([0, 0, 57.0]) and found.path[0] == pytest.approx(2 + 3 + 4 * 1.52 + 50)


def test_a_cone_turns_every_ray_by_the_angle_of_its_prism():
    """A flat front and a cone of slope t behind it: sin i = t/√(1 + t²), and the ray turns by asin(n·sin i) − i."""
    slope, glass = 0.1, ConstantIndex(1.5)
    surfaces = Surface(thickness=3.0, medium=glass), Surface(thickness=40.0, shape=RadialPolynomial((-slope,)))
    lens = Lens(surfaces, Aperture("stop_semi_diameter", 5.0), 1)
    found = trace(lens, [[0.0, y, -1.0] for y in (1e-3, 1.0, 4.0)], [[0, 0, 1.0]], UM)
    sine = slope / sqrt(1 + slope**2)
    turned = np.arcsin(1.5 * sine) - np.arcsin(sine)
    assert np.arcsin(-found.cosines[:, 1]) == pytest.approx(turned, abs=1e-14)


def test_a_makers_asphere_in_qbfs_over_a_conic_focuses_as_its_file_says():
    """Thorlabs' ASL5040-UV at 405 nm: all rays at NA 0.65 within 0.3 µm, where Qbfs along the axis misses by 100."""
    coefficients = -0.8148370167576, -0.32311, 0.10591, -0.05058, 0.00987, -0.0022
    silica = ConstantIndex(1.4695918037615294)  # Corning 7980 at 405 nm by the maker's formula
    front = Surface(1 / 5.756078762782423e-2, 29.85, silica, -0.67609120640407927, shape=Qbfs(coefficients, 27.0))
    back = Surface(thickness=19.687453064998852)
    lens = Lens((front, back), Aperture("entrance_pupil_diameter", 45.72), 1)
    rays = pencil(lens, Source(wavelength_um=0.405), np.zeros(9), np.linspace(-1, 1, 9))
    assert np.abs(rays.dy).max() < 3e-4 and np.abs(rays.ky).max() > 0.649
