"""First order and chromatic sums of diffractive surfaces and shapes, by closed forms and by rays of two colours."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.database.build import build_database
from p2sf.database.departure import departures, largest
from p2sf.database.parts import KINDS
from p2sf.database.space import Space
from p2sf.errors import GeometryError
from p2sf.glass.media import catalogue_glass, model_glass
from p2sf.lens.lens import Aperture, Lens, Surface, indices
from p2sf.lens.shapes import Diffraction, Qbfs, RadialPolynomial
from p2sf.lens.source import Source
from p2sf.paraxial.bending import thin_power
from p2sf.paraxial.first_order import cardinal_points, image_distance
from p2sf.paraxial.pupils import find_stop, numerical_aperture, paraxial_rays
from p2sf.paraxial.seidel import chromatic_sums, coefficients, seidel_sums
from p2sf.raytrace.pencil import pencil
from p2sf.spans import depth_nodes
from tests.benchmarks.interpolants import points_in
from tests.support.lenses.shaped_lenses import PARTS, PHASE, UNSEEN_BY_SEIDEL, hybrid, singlet, two_shaped_mirrors

F, D, C = 0.4861327, 0.5875618, 0.6562725


def efl(lens: Lens, um: float) -> float:
    return float(cardinal_points(lens, um).effective_focal_length)


def kinoform(power: float, um: float, radius: float = np.inf) -> Surface:
    """Return a phase of −πr²·power/λ."""
    return Surface(radius, 0.0, diffraction=Diffraction((-np.pi * power * 100.0 / (um * 1e-3),), 10.0))


def test_the_focal_length_of_a_kinoform_is_inverse_to_the_wavelength():
    lens = Lens((kinoform(0.01, D),), Aperture("stop_semi_diameter", 5.0), 1)
    for um in (0.2, F, D, C, 10.0):
        assert efl(lens, um) == pytest.approx(100 * D / um, rel=4e-16)
    assert float(numerical_aperture(lens, np.inf, D)) == pytest.approx(0.05, rel=4e-16)


def test_a_hybrid_achromat_holds_its_condition():
    """φ_r/V_r + φ_d/V_d = 0 with V_d = λd/(λF − λC) = −3.45 (Stone and George 1988): F and C focus together."""
    glass, power = catalogue_glass("SCHOTT N-BK7"), 0.02
    n = {um: float(glass.index(um)) for um in (F, D, C)}
    abbe, diffractive = (n[D] - 1) / (n[F] - n[C]), D / (F - C)
    assert diffractive == pytest.approx(-3.453, abs=1e-3)
    share = diffractive / (diffractive - abbe)  # of the power, by the diffractive surface
    front = Surface((n[D] - 1) / (power * (1 - share)), 0.0, glass)
    lens = Lens((front, kinoform(power * share, D)), Aperture("stop_semi_diameter", 5.0), 1)
    assert efl(lens, D) == pytest.approx(50, rel=1e-14) and efl(lens, F) == pytest.approx(efl(lens, C), rel=1e-13)
    sums = chromatic_sums(lens, paraxial_rays(lens, np.inf, D), F, C)
    assert float(sums.axial.sum()) == pytest.approx(0, abs=1e-14 * np.abs(sums.axial).max())
    assert float(thin_power(lens, 1, 2, D)) == pytest.approx(power, rel=1e-14)
    alone = Lens((kinoform(power, D),), Aperture("stop_semi_diameter", 5.0), 1)
    sums = chromatic_sums(alone, paraxial_rays(alone, np.inf, D), F, C)
    assert float(sums.axial[0]) == pytest.approx(25 * power / diffractive, rel=1e-14), "C_I = y²φ/V"


@pytest.mark.parametrize("lens", [hybrid(), singlet(*PARTS["phase"]), two_shaped_mirrors(*PARTS["phase"])], ids=repr)
def test_chromatic_sums_are_the_changes_of_image_place_and_height(lens):
    """δ(defocus path) = n'u'·δ(height of the axial ray in the image plane)/2, δ(tilt) = n'u'·δ(image height)."""
    um, step, slope = 0.55, 1e-4, 0.1
    place = float(image_distance(lens, 1500.0, um))
    rays = paraxial_rays(lens, 1500.0, um, find_stop(lens, 1500.0))
    sums = chromatic_sums(lens, rays, um - step, um + step, slope)
    heights = {"axial": (rays.y[0], rays.nu[0]), "chief": (rays.chief_y[0] * slope, rays.chief_nu[0] * slope)}
    change = {}
    for ray, (y, nu) in heights.items():
        ends = []
        for at in (um - step, um + step):
            n, height, angle = (
                indices(lens, at),
                float(y),
                float(nu) / float(rays.index[0]) * float(indices(lens, at)[0]),
            )
            for k, s in enumerate(lens.surfaces):
                angle -= height * s.vertex_curvature * (n[k + 1] - n[k])
                if s.diffraction:  # λ/2π·dφ/dr of the r² term
                    d = s.diffraction
                    angle += at * 1e-3 / np.pi * d.order * d.coefficients[0] / d.normalisation_mm**2 * height
                gap = s.thickness if k + 1 < len(lens.surfaces) else place
                height += angle / n[k + 1] * gap
            ends.append(height)
        change[ray] = ends[0] - ends[1]
    end = float(rays.nu[-1])
    # The central difference errs by the square of its step, a share of some (1e-4/0.55)².
    assert sums.axial.sum() / 2 == pytest.approx(end * change["axial"] / 2, rel=2e-4, abs=1e-12)
    assert sums.lateral.sum() == pytest.approx(end * change["chief"], rel=2e-4, abs=1e-12)


@pytest.mark.parametrize("parts", PARTS.values(), ids=PARTS)
@pytest.mark.parametrize("make", [singlet, two_shaped_mirrors])
def test_paraxial_rays_are_the_limit_of_exact_ones(make, parts):
    lens = make(*parts, rim=1e-4)
    place = float(image_distance(lens, 700.0, D))
    rays = pencil(lens, Source(700.0, 0.0, D), [0.0], [1.0])
    slope = float(rays.ky[0] / rays.kz[0])
    # Heights of 1e-4 mm: aberrations are 1e-8 of them and less, differences from the chief ray round by 1e-11.
    assert lens.sensor_mm - float(rays.dy[0]) / slope == pytest.approx(place, rel=1e-6)


@pytest.mark.parametrize("lens", [hybrid(), two_shaped_mirrors(*PARTS["phase"]), singlet(*PARTS["Qcon"])], ids=repr)
def test_databases_are_exact_with_shapes_and_diffraction(lens):
    """Their polynomials in s hold unchanged; the promise is that of plain lenses, 1e-11 of the largest coefficient."""
    database = build_database(lens, Space(depth_nodes(1e3), np.linspace(0, 0.1, 11), np.linspace(0.4, 0.7, 9)))
    points = points_in(database, count=1000)
    direct = coefficients(lens, *points)
    lost, top = departures(database.coefficients(*points), direct), largest(direct)
    assert all(lost[kind] <= 1e-11 * top[kind] + 1e-12 for kind in KINDS), lost


def test_the_stop_may_stand_anywhere_without_changing_spherical_aberration():
    values = []
    for at in (1, 2, 3):
        lens = singlet(*PARTS["extended and phase"])
        rays = paraxial_rays(lens, np.inf, D)
        moved = replace(lens, stop_surface=at, aperture=Aperture("stop_semi_diameter", float(rays.y[at - 1])))
        values.append(float(coefficients(moved, np.inf, 0.1, D).w40))
    assert values == pytest.approx([values[0]] * 3, rel=1e-12)


def test_diffraction_has_no_petzval_sum():
    with_phase, without = singlet({"diffraction": PHASE}), singlet({})
    one, two = (seidel_sums(lens, paraxial_rays(lens, np.inf, D)).total().petzval for lens in (with_phase, without))
    # H differs not at all: the stop stands before the lens.
    assert float(one) == pytest.approx(float(two), rel=1e-14)


def test_the_curvature_at_the_vertex_counts():
    glass = model_glass(1.6, 40.0)
    surface = Surface(50.0, 0.0, glass, shape=Qbfs((0.1, 0.0), 10.0))
    assert surface.vertex_curvature == pytest.approx(1 / 50 + 2 * 0.1 / 100, rel=1e-15)
    flat = replace(surface, radius=np.inf, shape=RadialPolynomial((0.0, 0.01)))
    paraboloid = replace(surface, radius=50.0, conic=-1.0, shape=None)
    lenses = [Lens((s, Surface(thickness=80.0)), Aperture("stop_semi_diameter", 5.0), 1) for s in (flat, paraboloid)]
    for name in ("w40", "w31", "w22", "w20", "w11", "wd", "reduced_slope"):
        one, two = (float(getattr(coefficients(lens, 900.0, 0.1, D), name)) for lens in lenses)
        assert one == pytest.approx(two, rel=1e-12), name


@pytest.mark.parametrize(("name", "term"), [("odd", "r³"), ("cone", "r")])
def test_what_seidel_sums_do_not_see_is_refused_by_surface_and_term(name, term):
    lens = singlet(*UNSEEN_BY_SEIDEL[name])
    with pytest.raises(GeometryError, match=f"surface 2 has a term in {term}, for"):
        seidel_sums(lens, paraxial_rays(lens, np.inf, D))
    six = coefficients(lens, np.inf, 0.1, D)
    assert np.isnan([six.w40, six.w31, six.w22, six.w20, six.w11]).all()
    assert np.isfinite([six.wd, six.reduced_slope, six.image_height, six.image_distance]).all()
