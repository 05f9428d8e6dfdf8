"""Biconics, toroids, cylinders and gratings: rays in forty digits, deep edges, waves, methods, paraxial means."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from mpmath import mp, mpf

import p2sf
from p2sf.errors import GeometryError
from p2sf.glass.media import MIRROR, ConstantIndex
from p2sf.lens.anamorphic import Biconic, Toroid
from p2sf.lens.grating import Grating
from p2sf.lens.lens import Aperture, Lens, Surface, with_sensor
from p2sf.lens.misalignment import average_azimuths
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import abcd
from p2sf.raytrace.surface import Status
from p2sf.raytrace.trace import trace
from tests.support.lenses.every_surface import rays, system_of
from tests.support.rays import freeform_rays

GLASS = ConstantIndex(1.52)
SHAPES = {
    "biconic": Biconic(radius_x=30.0, radius_y=-50.0, conic_x=-0.5, conic_y=2.0),
    "toroid": Toroid(radius_x=-40.0, radius_y=25.0, conic_y=-0.3, coefficients=(1e-3, -2e-5), turn_deg=20.0),
    "cylinder": Toroid(radius_y=20.0, turn_deg=90.0),
    "paraboloid": Biconic(radius_x=20.0, conic_x=-1.0),
}


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
def test_the_sag_is_that_of_its_definition_and_its_gradient_is_the_derivative(shape):
    """Rounding of a sag of 2 mm is 4e-16; central differences over 1e-5 mm add 1e-10 of the third derivative."""
    x, y = np.random.default_rng(1).uniform(-6, 6, (2, 30))
    with mp.workdps(freeform_rays.DIGITS):
        known = [float(freeform_rays.shape_sag(shape, mpf(a), mpf(b))) for a, b in zip(x, y, strict=True)]
    sag, (across, up) = shape.sag_and_gradient(x, y)
    assert sag == pytest.approx(known, abs=2e-15)
    step = 1e-5
    for gradient, (dx, dy) in ((across, (step, 0.0)), (up, (0.0, step))):
        ahead, behind = (shape.sag_and_gradient(x + way * dx, y + way * dy)[0] for way in (1, -1))
        assert gradient == pytest.approx((ahead - behind) / (2 * step), abs=1e-9)


@pytest.mark.parametrize("kind", ["biconic, turned", "toroid, turned", "cylinder", "grating", "XY polynomial"])
def test_rays_in_chains_of_breaks_are_those_of_a_tracer_in_forty_digits(kind):
    """Points, directions and paths to 1e-12 mm: a dozen roundings of lengths of 60 mm; seed 0 has a mirror."""
    for seed in (0, 1):
        lens, (origins, ways) = system_of(kind, seed), rays(seed, 2)
        found = trace(lens, origins, ways, 0.55)
        assert not found.status.any()
        for ray, (origin, way) in enumerate(zip(origins, ways, strict=True)):
            points, direction, path = freeform_rays.fly(lens, origin, way, 0.55)
            assert found.points[1:, ray] == pytest.approx(np.array(points, float), abs=1e-12)
            assert found.cosines[ray] == pytest.approx(np.array(direction, float), abs=1e-13)
            assert found.path[ray] == pytest.approx(float(path), abs=1e-12)


@pytest.mark.parametrize("radius", [10.0, -10.0])
def test_steep_rays_meet_a_deep_cylinder_up_to_its_edge(radius):
    """Rays aimed at points of the sheet through the vertex, in closed form: some cross the vertex plane outside."""
    rng, count = np.random.default_rng(0), 400
    x, y = rng.uniform(-15, 15, count), rng.uniform(-9.9, 9.9, count)
    root = np.sqrt(radius**2 - y * y)
    places = np.column_stack([x, y, radius - np.sign(radius) * root])
    ways = np.column_stack([rng.uniform(-0.8, 0.8, (count, 2)), np.ones(count)])
    ahead = ways[:, 2] - np.sign(radius) * y / root * ways[:, 1] > 0.02  # rays that cross the sheet from its front
    lens = Lens((Surface(thickness=30.0, shape=Toroid(radius_y=radius)),), Aperture("stop_semi_diameter", 3.0), 1)
    found = trace(lens, (places - 20 * ways)[ahead], ways[ahead], 0.55)
    assert found.points[1] == pytest.approx(places[ahead], abs=1e-11)
    beside = trace(lens, [[0.0, 10.1, -5.0]], [0.0, 0.0, 1.0], 0.55)
    assert beside.status[0] == Status.MISSED


def test_a_sphere_is_a_biconic_and_a_toroid():
    places = np.array([[0.3, -1.0, -8.0], [-2.5, 1.7, -8.0], [3.3, 2.1, -8.0]])
    shapes = (
        {"radius": 40.0},
        {"shape": Biconic(radius_x=40.0, radius_y=40.0)},
        {"shape": Toroid(radius_x=40.0, radius_y=40.0, turn_deg=33.0)},
    )
    one, *others = (
        trace(
            Lens((Surface(thickness=60.0, medium=GLASS, **own),), Aperture("f_number", 8.0), 1),
            places,
            [0.1, -0.05, 1.0],
            0.55,
        )
        for own in shapes
    )
    for other in others:
        assert other.points == pytest.approx(one.points, abs=1e-13)


def test_a_cylinder_focuses_into_a_line_and_paraxial_rays_see_half_of_its_power():
    """The focal line of a thin plano-cylinder of 26 mm stands R/(n − 1) = 50 mm behind it, at any place along x."""
    cylinder = Toroid(radius_y=26.0)
    lens = Lens(
        (Surface(thickness=0.0, medium=GLASS, shape=cylinder), Surface(thickness=50.0)), Aperture("f_number", 8.0), 1
    )
    origins = np.array([[x, y, -5.0] for x in (-8.0, 0.0, 3.0) for y in (0.01, -0.02)])
    found = trace(lens, origins, [0.0, 0.0, 1.0], 0.55)
    assert found.points[-1][:, 0] == pytest.approx(origins[:, 0], abs=1e-12)
    assert found.points[-1][:, 1] == pytest.approx(0.0, abs=1e-7)  # y³/(2f²), third order
    assert abcd(lens, 0.55)[1, 0] == pytest.approx(-0.5 * 0.52 / 26.0, rel=1e-12)


def test_paraxial_rays_see_nothing_of_a_grating():
    lens = Lens((Surface(60.0, 50.0, GLASS, diffraction=Grating(300.0)),), Aperture("f_number", 8.0), 1)
    plain = replace(lens.surfaces[0], diffraction=None)
    assert average_azimuths(lens).surfaces == (plain,) and lens.misaligned


@pytest.mark.parametrize("mirror", [False, True])
@pytest.mark.parametrize("turn", [0.0, 35.0])
def test_a_plane_grating_follows_the_equation_of_gratings(mirror, turn):
    """n′ sin θ′ = n sin θ + mλg across the lines and n′ sin θ′ = n sin θ along them, in air after reflection too."""
    order, lines, um = -2.0, 120.0, 0.6
    medium, way = (MIRROR, -1.0) if mirror else (GLASS, 1.0)
    surface = Surface(thickness=way * 30.0, medium=medium, diffraction=Grating(lines, order, turn))
    lens = Lens((surface,), Aperture("stop_semi_diameter", 5.0), 1)
    direction = np.array([0.1, 0.2, np.sqrt(1 - 0.05)])
    found = trace(lens, [[1.0, 2.0, -5.0]], direction, um)
    angle, index = np.deg2rad(turn), 1.0 if mirror else 1.52
    kick = order * lines * um * 1e-3 * np.array([-np.sin(angle), np.cos(angle)])
    assert index * found.cosines[0][:2] == pytest.approx(direction[:2] + kick, abs=1e-15)
    assert np.sign(found.cosines[0][2]) == way


def test_an_order_beyond_grazing_is_evanescent():
    lens = Lens((Surface(thickness=30.0, diffraction=Grating(2000.0, 1.0)),), Aperture("f_number", 5.0), 1)
    assert trace(lens, [[0.0, 0.0, -5.0]], [0.0, 0.0, 1.0], 0.6).status[0] == Status.EVANESCENT


def anamorphic_singlet() -> Lens:
    """Return a singlet f/9 with some two waves of astigmatism that a turned toroid adds."""
    shape = Toroid(radius_x=51.0, radius_y=50.5, turn_deg=25.0)
    surfaces = (
        Surface(thickness=2.0),
        Surface(thickness=4.0, medium=GLASS, shape=shape),
        Surface(-50.0, 46.0),
    )
    return Lens(surfaces, Aperture("stop_semi_diameter", 2.5), 1)


GRATING_LENS = Lens(
    (
        Surface(thickness=0.0, diffraction=Grating(20.0, 1.0, 30.0)),
        Surface(50.0, 3.0, GLASS),
        Surface(-50.0, 46.8),
    ),
    Aperture("stop_semi_diameter", 2.0),
    1,
)


@pytest.mark.parametrize("lens", [with_sensor(anamorphic_singlet(), 47.0), GRATING_LENS], ids=["toroid", "grating"])
def test_every_method_but_six_coefficients_forms_the_picture(lens):
    """huygens, traced and fitted agree to the few 1e-5 that fits of two waves leave; seidel names the surface."""
    source = Source(field_deg=(0.7, 0.4), wavelength_um=0.55)
    psfs = {
        name: p2sf.render(lens, source, name, pixels=48, pixel_um=1.5).values
        for name in ("huygens", "traced", "fitted")
    }
    reference = psfs["huygens"]
    for name in ("traced", "fitted"):
        apart = ((psfs[name] - reference) ** 2).sum() / ((reference - reference.mean()) ** 2).sum()
        assert apart < 1e-4, name
    with pytest.raises(GeometryError) as refusal:
        p2sf.render(lens, source, "seidel")
    assert "surface" in refusal.value.message.values
    assert p2sf.render(lens, source, "auto", pixels=48, pixel_um=1.5).method != "seidel"


def test_a_grating_in_the_stop_moves_the_picture_with_the_wavelength():
    """By f·mλg across the lines, seen from the chief ray of order 0, to third order in the angle of 0.7°."""
    plain = replace(GRATING_LENS, surfaces=(Surface(), *GRATING_LENS.surfaces[1:]))
    focal = -1 / abcd(plain, 0.55)[1, 0]
    for um in (0.45, 0.65):
        found = trace(GRATING_LENS, [[0.0, 0.0, -1.0]], [0.0, 0.0, 1.0], um).points[-1, 0]
        place = focal * 20.0 * um * 1e-3 * np.array([-np.sin(np.pi / 6), np.cos(np.pi / 6)])
        assert found[:2] == pytest.approx(place, rel=3e-2)


def test_numbers_that_cannot_be_are_refused():
    for shape in (Biconic(radius_x=0.0), Toroid(radius_y=20.0, coefficients=(inf,))):
        with pytest.raises(GeometryError, match="surface 1: a number of its shape"):
            Lens((Surface(thickness=5.0, shape=shape),), Aperture("f_number", 5.0), 1)
