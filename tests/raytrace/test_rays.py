"""The two numbers of each ray, pupil area and light, and the fields that follow, against sums of their own."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.disc.domain import ClearNodes
from p2sf.disc.mask import PupilMask
from p2sf.disc.mask_nodes import mask_nodes
from p2sf.lens.lens import with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pupil.vignetting import pupil_nodes, whole_nodes
from p2sf.raytrace.pencil import hexapolar, pencil, rays_through

STEP = 1e-4  # of the pupil's radius


def off_axis(name: str, field_deg: float) -> tuple:
    lens = find_lens(name)
    return lens, Source(inf, float(np.tan(np.deg2rad(field_deg))), lens.reference_wavelength_um)


def test_energy_behind_a_filter_is_that_of_a_grid_over_the_stop():
    """∫launch·A² over the open disc, by nodes and by half a million yes-or-no cells with bilinear launch weights."""
    lens, source = off_axis("double_gauss_28", 14)
    mask = PupilMask(obscuration=0.3, apodisation=0.8)
    nodes = mask_nodes(mask, 24, 48)
    rays = rays_through(with_mask(lens, mask), source, nodes)
    found = nodes.share * float((rays.share * rays.light).sum())
    axis = (np.arange(800) + 0.5) / 400 - 1
    xi, eta = (part.ravel() for part in np.meshgrid(axis, axis))
    square = xi**2 + eta**2
    open_ = (square < 1) & (square > 0.3**2)
    xi, eta, square = xi[open_][::7], eta[open_][::7], square[open_][::7]  # every seventh, evenly spread
    launch = pencil(lens, source, xi, eta).launch
    grid = (launch * np.exp(-2 * square / 0.8**2)).mean() * open_.sum() * (axis[1] - axis[0]) ** 2 / np.pi
    assert found == pytest.approx(grid, rel=2e-4)
    assert np.ptp(rays.launch) > 0.1


def test_rays_that_rims_stop_have_no_light_and_no_field():
    """What is left is the light of nodes that end at the rims, to the jagged edge of yes-or-no nodes."""
    lens, source = off_axis("double_gauss_28", 14)
    rays = rays_through(lens, source, whole_nodes((60, 240)), clip=True)
    assert 0.05 < (~rays.passed).mean() < 0.6
    assert (rays.light[~rays.passed] == 0).all() and (rays.amplitude[~rays.passed] == 0).all()
    inside = pupil_nodes(lens, source, (24, 60), clip=True)
    clear = rays_through(lens, source, inside)
    assert (rays.share * rays.light).sum() == pytest.approx(inside.share * (clear.share * clear.light).sum(), rel=3e-3)
    assert rays.arrived.xi.size == rays.passed.sum()


def test_a_transmission_takes_its_root_off_the_field_and_itself_off_the_energy():
    """Shares are areas: half of the nodes at twice their area change neither."""
    lens, source = off_axis("cooke_triplet", 12)
    rays = replace(rays_through(lens, source, whole_nodes((6, 12))), transmission=0.81)
    bare = pencil(lens, source, rays.xi, rays.eta)
    np.testing.assert_allclose(rays.light, 0.81 * bare.launch, rtol=1e-14)
    np.testing.assert_allclose(rays.amplitude, 0.9 * bare.launch, rtol=1e-14)
    jacobian = np.linspace(1, 3, rays.xi.size)
    np.testing.assert_allclose(rays.radiometric(jacobian) ** 2, 0.81 * bare.launch * jacobian, rtol=1e-14)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_radiometric_field_keeps_the_sign_of_the_mask(sign):
    lens, source = off_axis("cooke_triplet", 12)
    nodes = whole_nodes((6, 12))
    nodes = ClearNodes(nodes.xi, nodes.eta, nodes.weight, 1.0, np.full(nodes.xi.size, sign * 0.5))
    rays = rays_through(lens, source, nodes)
    assert (np.sign(rays.amplitude) == sign).all() and (np.sign(rays.radiometric(rays.launch)) == sign).all()
    assert (rays.light > 0).all()


def test_the_path_of_a_mask_is_phase_and_bends_no_ray():
    lens, source = off_axis("cooke_triplet", 12)
    mask = PupilMask(cubic_um=1.5)
    nodes = mask_nodes(mask, 8, 16)
    rays, bare = rays_through(lens, source, nodes), pencil(lens, source, nodes.xi, nodes.eta)
    longer = 1.5 * (nodes.xi**3 + nodes.eta**3) / float(source.wavelength_um)
    np.testing.assert_allclose(rays.phase - bare.phase, longer, atol=1e-12)
    np.testing.assert_array_equal(rays.x_um, bare.x_um)


def test_frequencies_and_phase_of_turned_rays_fall_by_where_they_land():
    """Hamilton's dw = −x·df in axes turned by 33°, along both."""
    lens, source = off_axis("double_gauss_28", 10)
    xi, eta = hexapolar(4)
    sides = [
        pencil(lens, source, xi + a * STEP, eta + b * STEP).turned(33.0) for a, b in ((1, 0), (-1, 0), (0, 1), (0, -1))
    ]
    at = pencil(lens, source, xi, eta).turned(33.0)
    for more, less in (sides[:2], sides[2:]):
        fall = at.x_um * (more.fx - less.fx) + at.y_um * (more.fy - less.fy)
        np.testing.assert_allclose(more.phase - less.phase, -fall, atol=1e-7)
