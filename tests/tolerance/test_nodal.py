"""Nodes of coma and astigmatism: laws of symmetry, and Seidel's sums against exact rays."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.errors import GeometryError
from p2sf.lens.lens import with_f_number
from p2sf.lens.misalignment import displaced, with_tilted_sensor
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.bending import elements
from p2sf.paraxial.seidel import coefficients
from p2sf.tolerance.errors_of_build import IRREGULAR, Tolerance, build
from p2sf.tolerance.nodal import exact_aberrations, field_aberrations, nodal_sensitivities, third_order

WAVE = 0.5875618
SMALL = Placement(0.05, 0.1, 0, 0.05, -0.03)


@pytest.fixture(scope="module")
def gauss():
    return find_lens("double_gauss_28")


def field(x_deg, y_deg):
    return complex(np.tan(np.deg2rad(y_deg)), np.tan(np.deg2rad(x_deg)))


@pytest.mark.parametrize("depth", [inf, 800.0])
def test_without_misalignment_they_are_the_coefficients_about_the_centre(gauss, depth):
    found, six = third_order(gauss, depth, WAVE), coefficients(gauss, depth, abs(field(3, 4)), WAVE)
    coma, astigmatism = found.at(np.array([field(3, 4)]))
    along = field(3, 4) / abs(field(3, 4))
    assert coma[0] == pytest.approx(complex(six.w31) * along, rel=1e-12)
    assert astigmatism[0] == pytest.approx(complex(six.w22) * along**2, rel=1e-12)
    assert found.coma_node == 0 and not found.astigmatism_nodes.any()
    every = field_aberrations(gauss, depth, WAVE, np.array([-2.0, 0.0, 2.0]), np.array([-2.0, 0.0, 2.0]))
    for nodes in (every.coma_nodes_deg, every.astigmatism_nodes_deg):
        assert nodes == pytest.approx(np.zeros((1, 2)), abs=1e-9)
    # Symmetry: the grid turned by 90° is the field turned by 90°.
    assert every.coma == pytest.approx(np.rot90(every.coma, -1) * -1j, abs=1e-9)
    assert every.astigmatism == pytest.approx(-np.rot90(every.astigmatism), abs=1e-9)


def test_a_sensor_that_is_moved_moves_no_node(gauss):
    bad = displaced(gauss, 3, 5, SMALL)
    moved = with_tilted_sensor(bad, Placement(1.0, -2.0, 0, 2.0, 1.0))
    assert third_order(moved, inf, WAVE).coma == pytest.approx(third_order(bad, inf, WAVE).coma, rel=1e-12)


def test_a_lens_that_is_moved_as_a_whole_takes_its_nodes_along(gauss):
    """Beside the object at infinity nothing changes; turned, its axis points at another field. Errors: tilt²."""
    last, turn = len(gauss.surfaces), Placement(0.3, -0.2, 0, 0.4, -0.25)
    rotation = turn.motion.rotation
    axis = complex(rotation[1, 2], rotation[0, 2]) / rotation[2, 2]
    found = third_order(displaced(gauss, 1, last, turn), inf, WAVE)
    assert found.coma_node == pytest.approx(axis, abs=abs(axis) ** 2)
    assert found.astigmatism_nodes == pytest.approx([axis, axis], abs=abs(axis) ** 1.5)
    exact = field_aberrations(displaced(gauss, 1, last, turn), inf, WAVE, np.linspace(-1, 1, 3), np.linspace(-1, 1, 3))
    assert field(*exact.coma_nodes_deg[0]) == pytest.approx(axis, rel=1e-6)
    aside = third_order(displaced(gauss, 1, last, Placement(0.5, 0.7)), inf, WAVE)
    assert abs(aside.coma_node) < 1e-12


def test_a_sphere_tilted_about_its_vertex_is_one_decentred(gauss):
    """Its centre moves by R·sin of the tilt."""
    found = nodal_sensitivities(gauss, inf, WAVE, [(2, 2), (5, 5), (6, 6), (9, 9)])
    for number, (x, y, a, b) in zip((2, 5, 6, 9), found.coma.reshape(4, 4), strict=True):
        lever = np.deg2rad(gauss.surfaces[number - 1].radius)
        if np.isfinite(lever):
            assert (a, b) == pytest.approx((-lever * y, lever * x), rel=1e-6)
        else:  # the stop, a plane in air, whose centre the chief ray goes through
            assert max(abs(a), abs(b)) < 1e-12 < abs(y)


def test_exact_rays_of_a_small_aperture_agree_with_the_sums(gauss):
    """What is left is of fifth order: half the aperture leaves a quarter of it."""
    misses = []
    for f_number in (12.0, 24.0):
        small = with_f_number(gauss, f_number)
        bad = displaced(small, 3, 5, SMALL)
        known = third_order(bad, inf, WAVE)
        sources = [Source(field_deg=place) for place in ((0.0, 0.0), (0.3, 0.4), (-0.5, 0.2))]
        exact = np.array([exact_aberrations(bad, source)[:2] for source in sources])
        expected = np.stack(known.at(np.array([field(*source.field_xy_deg) for source in sources])), -1)
        misses.append(np.abs(exact - expected).max(0) / np.abs(expected).max(0))
        assert (misses[-1] < 0.02).all()
    assert misses[1][0] < 0.3 * misses[0][0]


def test_sensitivities_are_what_small_misalignments_add(gauss):
    """The rest falls as the square of the misalignment, or faster."""
    spans = elements(gauss)
    known = nodal_sensitivities(gauss, inf, WAVE, spans)
    weights = np.array([[0.04, -0.05, 0.02, 0.03], [0.03, 0.02, -0.01, 0.04]])
    misses = []
    for part in (1.0, 0.5):
        bad = gauss
        for (first, last), amounts in zip(spans[1:3], part * weights, strict=True):
            bad = displaced(bad, first, last, Placement(*amounts[:2].tolist(), 0, *amounts[2:].tolist()))
        amounts = np.concatenate([np.zeros(4), part * weights.ravel(), np.zeros(4)])
        found, still = third_order(bad, inf, WAVE), third_order(gauss, inf, WAVE)
        misses.append(
            [abs(found.coma[0] - amounts @ known.coma), abs(found.astigmatism[1] - amounts @ known.astigmatism)]
        )
        assert misses[-1][0] < 1e-3 * abs(found.coma[0])
        assert found.coma_node == pytest.approx(amounts @ known.coma_node, rel=0.01)
        assert found.coma[1] == pytest.approx(still.coma[1], rel=1e-3)
    assert (np.array(misses[1]) < np.array(misses[0]) / 4).all()


def test_a_mirror_turned_about_its_neutral_point_makes_no_coma():
    """The point is where a tilt moves the vertex by what cancels the tilt's own coma."""
    lens = find_lens("cassegrain_f10")
    x, y, a, _ = nodal_sensitivities(lens, inf, WAVE, [(2, 2)]).coma
    assert x == pytest.approx(y * 1j, rel=1e-6)
    behind = float((a / y).real) / np.deg2rad(1)  # a tilt about x moves the vertex by +pivot·tilt along y
    centre = Source(wavelength_um=WAVE)
    turned, about_vertex = (
        exact_aberrations(displaced(lens, 2, 2, Placement(tilt_x_deg=0.02, pivot=(0, 0, z))), centre)[0]
        for z in (-behind, 0.0)
    )
    assert abs(turned) < 0.01 * abs(about_vertex)


def test_nodes_of_exact_rays_have_no_aberration_to_either_side():
    lens = displaced(find_lens("cassegrain_f10"), 2, 2, Placement(0.2, 0.5))
    grid = np.linspace(-0.4, 0.4, 5)
    found = field_aberrations(lens, inf, WAVE, grid, grid)
    (coma,), nodes = found.coma_nodes_deg, found.astigmatism_nodes_deg
    assert len(nodes) == 2
    # Mean over a small ring about a simple zero is 0, the ring itself winds around it once.
    for place, node in ((0, coma), (1, nodes[0]), (1, nodes[1])):
        ring = [node + 0.01 * np.array([np.sin(t), np.cos(t)]) for t in np.arange(8) * np.pi / 4]
        values = np.array(
            [exact_aberrations(lens, Source(field_deg=tuple(p), wavelength_um=WAVE))[place] for p in ring]
        )
        assert abs(values.mean()) < 0.1 * np.abs(values).min()
        assert np.angle(np.roll(values, -1) / values).sum() == pytest.approx(2 * np.pi, abs=1e-6)
    third = found.third_order
    assert field(*coma) == pytest.approx(third.coma_node, rel=0.05)
    assert sorted(abs(field(*node)) for node in nodes) == pytest.approx(
        sorted(np.abs(third.astigmatism_nodes)), rel=0.05
    )


def test_an_irregular_surface_adds_the_same_astigmatism_to_all_fields(gauss):
    """By exact rays at f/24, whose rest is of fifth order; a cylinder along x = y turns astigmatism by 45°."""
    small = with_f_number(gauss, 24.0)
    bad = build(small, [Tolerance(kind, 3, 90.0) for kind in IRREGULAR], (40.0, 70.0))
    known, still = third_order(bad, inf, WAVE), third_order(small, inf, WAVE)
    added = known.astigmatism - still.astigmatism
    assert abs(added[0]) > 0.1 and added[1:] == pytest.approx([0, 0], abs=1e-12)
    assert known.coma == pytest.approx(still.coma, abs=1e-9)
    for place in ((0.0, 0.0), (0.5, 1.0), (-2.0, 0.3)):
        source = Source(field_deg=place, wavelength_um=WAVE)
        exact = exact_aberrations(bad, source)[1] - exact_aberrations(small, source)[1]
        assert exact == pytest.approx(added[0], rel=0.02)


def test_a_lost_chief_ray_is_refused_with_the_surface(gauss):
    with pytest.raises(GeometryError, match=r"surface 6; surface 3 is decentred by"):
        third_order(displaced(gauss, 3, 5, Placement(decentre_y=40.0)), inf, WAVE)


def test_a_ring_without_astigmatism_has_no_nodes():
    """Astigmatism of this lens vanishes on the axis, and all along a circle of fields of 18.6°."""
    axis = np.linspace(-14.0, 14.0, 5)
    found = field_aberrations(find_lens("double_gauss_28"), np.inf, 0.5875618, axis, axis)
    assert found.astigmatism_nodes_deg == pytest.approx(np.zeros((1, 2)), abs=1e-6)


def test_nodes_do_not_move_with_the_curvature_of_the_sensor():
    """It adds defocus and distortion to every field, and no coma or astigmatism of any order in the tilt of a lens."""
    lens = displaced(find_lens("cooke_triplet"), 3, 4, Placement(decentre_y=0.05))
    angles = np.linspace(-8, 8, 3)
    flat, bent = (field_aberrations(replace(lens, sensor_radius=r), inf, 0.55, angles, angles) for r in (inf, -60.0))
    # In degrees; the sphere of the displayed wavefront is another, which changes it by its square: thousandths.
    assert np.abs(bent.astigmatism_nodes_deg - flat.astigmatism_nodes_deg).max() < 2e-3
    assert bent.third_order.coma_node == flat.third_order.coma_node
    assert np.abs(bent.defocus - flat.defocus).max() > 0.1
