"""The density of rays through any pupil, against sums over rays of their own."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.conventions import centred_axis
from p2sf.disc.mask import PupilMask
from p2sf.errors import GeometryError
from p2sf.lens.lens import with_mask, with_sensor
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.geometric import geometric_psf, main_reach_um
from p2sf.raytrace.pencil import pencil

FILTER = PupilMask(obscuration=0.4, apodisation=0.9)
CASES = {
    "aligned": {},
    "filter": {"mask": FILTER},
    "decentred": {"place": Placement(decentre_x=0.2, decentre_y=-0.1)},
    "decentred, filter": {"place": Placement(decentre_x=0.2, decentre_y=-0.1), "mask": FILTER},
}


def defocused(place: Placement | None = None, mask: PupilMask | None = None):
    lens = find_lens("double_gauss_28")
    lens = with_sensor(lens, lens.sensor_mm + 0.8)
    lens = lens if place is None else displaced(lens, 1, 2, place)
    return lens if mask is None else with_mask(lens, mask)


@pytest.mark.parametrize("case", CASES)
def test_light_lies_where_a_grid_of_rays_over_the_stop_sends_it(case):
    """Rays on a square grid, each with its launch weight and what the mask lets pass; means and variances, µm."""
    lens, source = defocused(**CASES[case]), Source(field_deg=10.0)
    axis = (np.arange(160) + 0.5) / 80 - 1
    xi, eta = (part.ravel() for part in np.meshgrid(axis, axis))
    inside = (xi**2 + eta**2 < 1) & lens.mask.opens(xi, eta)
    rays = pencil(lens, source, xi[inside], eta[inside])
    light = rays.launch * lens.mask.amplitude(rays.xi, rays.eta) ** 2
    light /= light.sum()
    places = rays.dx * 1000, rays.dy * 1000
    means = [light @ place for place in places]
    variances = [light @ (place - mean) ** 2 for place, mean in zip(places, means, strict=True)]
    pixel = 2.2 * max(np.abs(place).max() for place in places) / 128
    psf = geometric_psf(lens, source, (128, pixel))
    assert psf.energy == pytest.approx(1, abs=1e-6)
    along = centred_axis(128, pixel)
    for number, (mean, variance) in enumerate(zip(means, variances, strict=True)):
        line = psf.values.sum(number)  # columns for x, rows for y
        found = line @ along
        assert found == pytest.approx(mean, abs=0.04 * pixel)
        # Sharing a ray among pixels adds a sixth of a pixel² on the average.
        assert line @ (along - found) ** 2 == pytest.approx(variance + pixel**2 / 6, rel=6e-3)


def test_what_rims_stop_is_missing_from_the_energy():
    """The share of a dense disc of rays that arrive, by their launch weights."""
    lens, source = defocused(), Source(field_deg=14.0)
    axis = (np.arange(300) + 0.5) / 150 - 1
    xi, eta = (part.ravel() for part in np.meshgrid(axis, axis))
    inside = xi**2 + eta**2 < 1
    rays = pencil(lens, source, xi[inside], eta[inside], clip=True)
    arriving = rays.launch[rays.passed].sum() / rays.launch.sum()
    reach = np.nanmax(np.abs([rays.x_um, rays.y_um]))
    psf = geometric_psf(lens, source, (64, 2.2 * reach / 64), clip=True)
    assert 0.5 < arriving < 0.97
    assert psf.energy == pytest.approx(arriving, abs=5e-3)


def test_nine_tenths_of_the_light_lie_within_the_reach():
    lens, source = defocused(), Source(field_deg=10.0)
    reach = main_reach_um(lens, source)
    assert 0.9 < geometric_psf(lens, source, (128, 2 * reach / 128)).energy <= 1
    assert geometric_psf(lens, source, (128, 2 * reach / 1.25 / 128)).energy == pytest.approx(0.9, abs=0.03)


def test_a_source_too_far_for_a_relay_asks_for_a_nearer_one():
    lens = find_lens("relay")
    with pytest.raises(GeometryError) as refused:
        geometric_psf(lens, replace(Source(field_deg=0.0), depth_mm=1e6), (8, 1e-6))
    assert "nearer" in str(refused.value)
