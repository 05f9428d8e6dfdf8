"""Rays through the real stop: they meet it, they weigh what they should, and a symmetric lens does not distort."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

import p2sf
from p2sf.disc.quadrature import disc_nodes
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface, with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens, shipped_lenses
from p2sf.paraxial.first_order import image_distance, magnification
from p2sf.pupil.fit import fit, levels
from p2sf.raytrace import aiming
from p2sf.raytrace.aiming import Sources, entrance, pupil_rays
from p2sf.raytrace.field_curves import heights
from p2sf.raytrace.pencil import Status, hexapolar, pencil, trace
from tests.support.lenses.rewritten import folded
from tests.support.rays.pencils import disc

# They image near objects only, and the pupil of the first is so far off that 1° of field lies outside its glass.
RELAYS = {"relay": ((150.0,), (0.0, 0.1)), "telecentric_relay": ((90.9,), (0.0, 0.015, 0.0285))}
NEAR = {"eye_navarro": 100.0}  # mm; other lenses at 1 m
SHIPPED = shipped_lenses()


def places(name):
    """Yield lens, aimed at its stop, and sources at infinity and nearby, at its three fields."""
    lens = with_aim(find_lens(name), "stop")
    depths, fields = (inf, NEAR.get(name, 1000.0)), lens.fields_deg
    if name in RELAYS:
        depths, fields = RELAYS[name]
    for depth in depths:
        for angle in fields:
            yield lens, Source(depth, np.tan(np.deg2rad(angle)), lens.reference_wavelength_um)


@pytest.mark.parametrize("count", [60, 1600])
@pytest.mark.parametrize("name", SHIPPED)
def test_every_ray_meets_the_stop_where_it_should(name, count):
    """Few rays are aimed one by one, many by a map; the rim, where a polynomial is worst, is among them."""
    turn = np.linspace(0, 2 * np.pi, 40)
    inner = disc(count)
    xi, eta = np.append(inner[0], np.sin(turn)), np.append(inner[1], np.cos(turn))
    for lens, source in places(name):
        enter = entrance(lens, source)
        rim, side = float(enter.stop.semi_diameter), float(enter.upright[0])
        rays = pupil_rays(lens, source, xi, eta)
        at_stop = trace(lens, rays.origins, rays.directions, source.wavelength_um).points[int(enter.stop.surface)]
        off = np.hypot(at_stop[:, 0] - side * rim * xi, at_stop[:, 1] - side * rim * eta)
        assert np.max(off) < 1e-9 * rim, (source, np.max(off) / rim)


@pytest.mark.parametrize("name", SHIPPED)
def test_the_map_and_the_search_weigh_alike(name):
    nodes = disc_nodes(40, 80)
    for lens, source in places(name):
        mapped, sought = (
            pupil_rays(lens, source, nodes.xi, nodes.eta),
            pencil(lens, source, nodes.xi[:60], nodes.eta[:60]),
        )
        # The map is taken where it agrees to 1e-5 on the rim.
        np.testing.assert_allclose(mapped.launch[:60], sought.launch, rtol=1e-5)


def shoelace(x, y):
    """Return the area of the polygon through these points."""
    return abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2


@pytest.mark.parametrize(("name", "angle"), [("cooke_triplet", 20), ("reverse_telephoto", 30), ("petzval", 7)])
def test_the_weights_add_up_to_the_area_of_the_beam(name, angle):
    """The rim's rays enclose the beam's cross-section: a polygon of 4000 corners is right to (2π/4000)²/6 = 4e-7."""
    lens = with_aim(find_lens(name), "stop")
    source = Source(inf, np.tan(np.deg2rad(angle)), lens.reference_wavelength_um)
    turn = 2 * np.pi * np.arange(4000) / 4000
    rim = pupil_rays(lens, source, np.sin(turn), np.cos(turn))
    radius = float(entrance(lens, source).radius[0])
    nodes = disc_nodes(16, 48)
    light = nodes.weight @ pupil_rays(lens, source, nodes.xi, nodes.eta).launch
    assert light == pytest.approx(shoelace(rim.x, rim.y) / (np.pi * radius**2), rel=2e-6)
    assert abs(light - 1) > 0.01  # not the paraxial pupil's


@pytest.mark.parametrize("name", ["cooke_triplet", "wide_angle_35"])
def test_the_weights_of_a_near_point_add_up_to_its_solid_angle(name):
    """The cone's solid angle by the spherical excess of thin triangles about the chief ray (Van Oosterom 1983)."""
    lens = with_aim(find_lens(name), "stop")
    depth, slope = 60.0, np.tan(np.deg2rad(lens.fields_deg[1]))
    source = Source(depth, slope, lens.reference_wavelength_um)
    enter = entrance(lens, source)
    turn = 2 * np.pi * np.arange(4001) / 4000
    rays = pupil_rays(lens, source, np.append(0.0, np.sin(turn)), np.append(0.0, np.cos(turn)))
    unit = rays.directions
    middle, a, b = unit[0], unit[1:-1], unit[2:]
    triple = np.cross(a, b) @ middle
    excess = 2 * np.arctan2(np.abs(triple), 1 + a @ middle + b @ middle + np.sum(a * b, -1))
    distance = 1 / float(enter.reach[0])
    # Over that of the paraxial pupil seen from as far, at the chief ray of the paraxial pupil: cos³/distance².
    paraxial = np.pi * float(enter.radius[0]) ** 2 / distance**2 / (1 + slope**2) ** 1.5
    nodes = disc_nodes(16, 48)
    light = nodes.weight @ pupil_rays(lens, source, nodes.xi, nodes.eta).launch
    assert light == pytest.approx(excess.sum() / paraxial, rel=2e-6)


@pytest.mark.parametrize("name", ["double_gauss_28", "reverse_telephoto", "landscape"])
def test_weights_do_not_notice_where_infinity_begins(name):
    lens, points = with_aim(find_lens(name), "stop"), disc(40)
    slope = np.tan(np.deg2rad(lens.fields_deg[1]))
    far, beyond = (pencil(lens, Source(d, slope, 0.55), *points).launch for d in (1e9, inf))
    assert np.max(np.abs(far - beyond)) < 1e-6  # mm over 10⁹ mm


def test_weights_are_one_for_the_paraxial_pupil():
    lens, points = find_lens("cooke_triplet"), disc(40)
    rays = pencil(with_aim(lens, "paraxial"), Source(inf, 0.3, 0.55), *points)
    assert rays.launch.shape == points[0].shape and (rays.launch == 1).all()


def mirrored(surfaces, gap):
    """Return a lens of these (radius, thickness, index) before a stop, ``gap`` mm behind them, and of their image."""
    glass = [Surface(r, t, ConstantIndex(n)) for r, t, n in surfaces]
    back = [Surface(-r, 0.0) for r, _, _ in reversed(surfaces)]
    media = [ConstantIndex(n) for _, _, n in reversed(surfaces)][1:]
    thicknesses = [t for _, t, _ in reversed(surfaces)][1:]
    front = [*glass[:-1], replace(glass[-1], thickness=gap), Surface(inf, gap)]
    behind = [
        replace(surface, thickness=t, medium=m)
        for surface, t, m in zip(back, [*thicknesses, 0.0], [*media, ConstantIndex(1.0)], strict=True)
    ]
    return Lens((*front, *behind), Aperture("stop_semi_diameter", 2.0), len(surfaces) + 1)


def symmetric_lens():
    """Return two thick menisci, mirror images about the stop between them, at unit magnification and its depth."""
    lens = mirrored([(20.0, 4.0, 1.6), (30.0, 3.0, 1.0)], 3.0)
    low, high = 60.0, 400.0
    for _ in range(200):  # the depth at which the magnification is −1
        depth = (low + high) / 2
        low, high = (depth, high) if float(magnification(lens, depth, 0.55)) < -1 else (low, depth)
    sensor = float(image_distance(lens, depth, 0.55))
    last = replace(lens.surfaces[-1], thickness=sensor)
    return replace(lens, surfaces=(*lens.surfaces[:-1], last)), depth


def test_a_symmetric_lens_does_not_distort():
    """A chief ray through the stop's centre leaves as it came, mirrored, so at 1:1 it lands at the object's height."""
    lens, depth = symmetric_lens()
    assert lens.sensor_mm == pytest.approx(depth, rel=1e-9)
    source, slopes = Source(depth, 0.0, 0.55), np.tan(np.deg2rad([5.0, 10.0, 15.0, 20.0]))
    found, paraxial = (heights(with_aim(lens, aim), source, slopes) for aim in ("stop", "paraxial"))
    assert np.max(np.abs(found.real - found.paraxial)) <= 1e-12
    assert np.max(np.abs(paraxial.real - paraxial.paraxial)) > 1e-4


def test_many_sources_are_aimed_at_once():
    lens, (xi, eta) = with_aim(find_lens("wide_angle_35"), "stop"), disc(40)
    slopes = np.tan(np.deg2rad([[0.0], [15.0], [31.5]]))
    depths = np.array([inf, 2000.0])
    together = pencil(lens, Sources(depths, slopes, 0.55), xi, eta)
    for i, j in np.ndindex(3, 2):
        alone = pencil(lens, Source(float(depths[j]), float(slopes[i, 0]), 0.55), xi, eta)
        # Two searches from different starts meet to 1e-6² of the pupil; the weight's difference quotient to 1e-6.
        np.testing.assert_allclose(together.path[i, j], alone.path, atol=1e-9)
        np.testing.assert_allclose(together.launch[i, j], alone.launch, rtol=1e-5)


def test_a_source_whose_rays_are_lost_leaves_the_others_their_aim():
    """At 1° the relay's pupil lies outside its glass; the sources on and near the axis are aimed as they are alone."""
    lens, (xi, eta) = with_aim(find_lens("relay"), "stop"), disc(40)
    slopes = np.tan(np.deg2rad([0.0, 0.1, 1.0]))
    together = pupil_rays(lens, Sources(150.0, slopes, 0.5875618), xi, eta)
    assert np.isnan(together.x[2]).any()
    for number in (0, 1):
        alone = pupil_rays(lens, Source(150.0, float(slopes[number]), 0.5875618), xi, eta)
        # Aimed to 1e-10 of the pupil's radius each.
        off = np.hypot(together.x[number] - alone.x, together.y[number] - alone.y)
        assert off.max() < 1e-9 * float(entrance(lens, Source(150.0, 0.0, 0.5875618)).radius[0])


def test_a_map_that_the_rim_disproves_is_not_used():
    lens = with_aim(find_lens("petzval"), "stop")
    steep = Source(inf, np.tan(np.deg2rad(7.0)), 0.5875618)
    assert aiming._stop_map(lens, steep, aiming.AIM_ERROR) is None
    cooke = with_aim(find_lens("cooke_triplet"), "stop")
    assert aiming._stop_map(cooke, Source(inf, 0.3, 0.5875618), aiming.AIM_ERROR) is not None


def test_a_map_of_higher_order_aims_where_the_first_does_not():
    """The wide-angle lens at the edge of its field: many rays by the map, few by Newton's method."""
    lens = find_lens("wide_angle_35")
    source, nodes, some = Source(inf, np.tan(np.deg2rad(31.5)), 0.5875618), disc_nodes(30, 60), slice(0, None, 7)
    assert aiming._stop_map(lens, source, aiming.AIM_ERROR) is not None
    many = pupil_rays(lens, source, nodes.xi, nodes.eta)
    few = pupil_rays(lens, source, nodes.xi[some], nodes.eta[some])
    assert few.x.size < aiming.MANY < many.x.size
    off = np.hypot(many.x[some] - few.x, many.y[some] - few.y)
    assert off.max() < 2 * aiming.AIM_ERROR * float(entrance(lens, source).radius[0])
    assert np.asarray(many.launch)[some] == pytest.approx(np.asarray(few.launch), abs=aiming.WEIGHT_ERROR)


@pytest.mark.parametrize(("name", "angle"), [("petzval", 7.0), ("fast_gauss_f14", 22.0)])
def test_many_rays_beyond_any_map_take_one_step(name, angle):
    """Where no map stands for aiming, the guess of rays within 0.9 of the rim needs no second step, and few agree."""
    lens, nodes = find_lens(name), disc_nodes(40, 90)
    source, inside = Source(inf, np.tan(np.deg2rad(angle)), 0.5875618), np.hypot(nodes.xi, nodes.eta) < 0.9
    xi, eta = nodes.xi[inside], nodes.eta[inside]
    assert xi.size >= aiming.VERY_MANY and aiming._stop_map(lens, source, aiming.AIM_ERROR) is None
    enter, some = entrance(lens, source), slice(0, None, 7)
    many, few = pupil_rays(lens, source, xi, eta), pupil_rays(lens, source, xi[some], eta[some])
    guess = aiming._guess(lens, source, enter, None, xi, eta)
    enough = aiming._move_mm(enter, aiming.AIM_ERROR)
    assert np.hypot(guess[0] - many.x, guess[1] - many.y).max() < enough
    off = np.hypot(many.x[some] - few.x, many.y[some] - few.y)
    assert off.max() < 2 * aiming.AIM_ERROR * float(enter.radius[0])
    assert np.asarray(many.launch)[some] == pytest.approx(np.asarray(few.launch), abs=aiming.WEIGHT_ERROR)


def test_a_pupil_of_a_millionth_of_a_millimetre_is_aimed():
    lens = replace(find_lens("double_gauss_28"), aperture=Aperture("stop_semi_diameter", 1e-6), aim="stop")
    rays = pencil(lens, Source(inf, 0.1, 0.55), *disc(20))
    assert (rays.status == Status.PASSED).all()
    # So narrow a pencil fills its pupil evenly, to the rounding of differences of 1e-6 mm between points 10 mm away.
    np.testing.assert_allclose(rays.launch, rays.launch[0], rtol=1e-5)


@pytest.mark.parametrize("name", ["cooke_triplet", "reverse_telephoto"])
def test_a_fit_counts_and_knows_its_weights(name):
    lens = with_aim(find_lens(name), "stop")
    source = Source(inf, np.tan(np.deg2rad(lens.fields_deg[-1])), lens.reference_wavelength_um)
    assert [level.numbers for level in levels("stop")[:2]] == [32, 58]  # 6 and 12 more than of an even pupil
    found, points = fit(lens, source, 58), disc(50)
    assert found.numbers == 58 == sum(part.size for part in found.level.coefficients(found.function))
    rays = pencil(lens, source, *points)
    off = found.function.at(*points)[-1] / rays.launch - 1
    assert np.max(np.abs(off)) < 30 * found.amplitude_residual < 1e-2


@pytest.mark.parametrize("rings", [4, 8, 40])
def test_hexapolar_points_stand_for_equal_areas(rings):
    """Of n points of equal area the mean of ρ² is 1/2 but for the centre's, which is (ρ²)/2 = 1/2n of its share 1/n."""
    xi, eta = hexapolar(rings)
    count = 1 + 3 * rings * (rings + 1)
    assert xi.size == count
    square = xi * xi + eta * eta
    assert np.mean(square) == pytest.approx(0.5 - 0.5 / count**2, rel=1e-12)
    # Within each ring's outer edge lies the share of the area that its points and those inside have.
    edges = np.array([1 + 3 * k * (k + 1) for k in range(rings)]) / count
    assert [np.sum(square < edge) for edge in edges] == [1 + 3 * k * (k + 1) for k in range(rings)]


@pytest.mark.parametrize(("name", "angle"), [("petzval", 0.0), ("petzval", 7.0), ("fast_gauss_f14", 10.0)])
@pytest.mark.parametrize("write", [lambda lens: lens, folded], ids=["plain", "folded"])
def test_weights_do_not_depend_on_the_rays_that_are_asked_for_together(name, angle, write):
    lens = write(p2sf.load_lens(name))
    source = Source(field_deg=angle, wavelength_um=lens.reference_wavelength_um)
    random = np.random.default_rng(44)
    radius, turn = np.sqrt(random.random(1200)), 2 * np.pi * random.random(1200)
    xi, eta = radius * np.cos(turn), radius * np.sin(turn)
    together = pupil_rays(lens, source, xi, eta).launch[:100]
    for block in (1, 20, 60, 600):  # without a map, by a rough one, by one of higher order
        parts = [pupil_rays(lens, source, xi[k : k + block], eta[k : k + block]).launch for k in range(0, 100, block)]
        np.testing.assert_allclose(np.concatenate(parts)[:100], together, rtol=5e-8)  # of a map half WEIGHT_ERROR


def test_weights_are_ratios_of_areas_however_strongly_the_map_bends():
    lens = p2sf.load_lens("petzval")
    source = Source(field_deg=7.0, wavelength_um=lens.reference_wavelength_um)
    turn = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    for radius in (0.5, 0.98):
        middle = np.array([0.0, radius])  # of a circle about a point towards the rim
        ring = 0.01 * np.array([np.cos(turn), np.sin(turn)]) + middle[:, None]
        rays, centre = (pupil_rays(lens, source, *points) for points in (ring, middle[:, None]))
        # The area of a curve by its Fourier series: of 40 points it is that of a smooth curve to rounding.
        x, y = (np.fft.fft(each) / turn.size for each in (rays.x, rays.y))
        order = np.fft.fftfreq(turn.size, 1 / turn.size)
        area = 2 * np.pi * float((order * np.imag(x * np.conj(y))).sum())
        enter = entrance(lens, source)
        share = area / (np.pi * 0.01**2 * float(enter.radius.item()) ** 2)
        # The mean over a disc of radius r is the middle's plus r²/8 of the Laplacian, taken from weights on its rim.
        mean = float(centre.launch.item() + rays.launch.mean()) / 2
        assert share == pytest.approx(mean, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "angle"), [("cooke_triplet", 20.0), ("wide_angle_35", 25.0), ("double_gauss_28", 14.0)]
)
def test_the_guess_of_some_rays_is_a_step_from_where_they_enter(name, angle):
    """By a map of a few rays: what Newton's method finds is a thousandth of what first order misses away, or less."""
    lens, (xi, eta) = find_lens(name), disc(100)
    source = Source(inf, np.tan(np.deg2rad(angle)), 0.5875618)
    enter, found = entrance(lens, source), pupil_rays(lens, source, xi, eta)
    guess, first = aiming._guess(lens, source, enter, None, xi, eta), (enter.radius * xi, enter.radius * eta)
    missed, apart = (np.hypot(x - found.x, y - found.y).max() for x, y in (guess, first))
    assert aiming.FEW <= xi.size < aiming.MANY and missed < 1e-3 * apart
