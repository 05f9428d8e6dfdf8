"""Contrast and energy where rims end a pupil behind a mask, against sums over a grid of frequencies."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.lens.lens import with_mask
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.measures import energy_in, mtf_of, parts_of, spread_of
from tests.support.grid_sums import GridSums
from tests.support.tiers import in_tiers

TILTED = Placement(0.02, 0.05, 0.0, 0.05, 0.02)
RING, SPIDER = PupilMask(obscuration=0.3), PupilMask(vanes=3, vane_width=0.04, vane_angle_deg=20)
BESIDE = replace(SPIDER, obscuration=0.2, obscuration_x=0.3, obscuration_y=0.6)  # partly beyond the rims
PLATE = PupilMask(blades=5, blade_angle_deg=10, cubic_um=0.2, apodisation=0.8)
STATES = {
    "ring": ("double_gauss_28", 14.0, RING),
    "beside": ("double_gauss_28", 14.0, BESIDE),
    "plate": ("cooke_triplet", 20.0, PLATE),
    "tilted": ("tilted", 20.0, BESIDE),
    "hole": ("hole", 10.0, PupilMask()),
    "tilted hole": ("tilted hole", 10.0, PLATE),
}
TURN_DEG = 30.0
CELLS = 512  # the sum of 256 departs by some 5e-4 from it, with the roughness of edges


@lru_cache(maxsize=1)
def state_of(name):
    """Return a lens that rims or a hole clip, a source, and the sums over the grid."""
    which, field, mask = STATES[name]
    lens = find_lens({"tilted": "cooke_triplet", "hole": "tessar", "tilted hole": "tessar"}.get(which, which))
    if "hole" in which:
        first, *others = lens.surfaces
        lens = replace(lens, surfaces=(replace(first, inner_radius=0.3 * first.semi_diameter), *others))
    lens = with_mask(displaced(lens, 3, 4, TILTED) if "tilted" in which else lens, mask)
    source = Source(field_deg=field)
    return lens, source, GridSums(lens, source, True, CELLS)


@pytest.mark.parametrize("method", ["traced", "fitted"])
@pytest.mark.parametrize("name", in_tiers(STATES, ("beside", "tilted hole")))
def test_contrast_and_energy_are_those_of_a_grid(name, method):
    lens, source, grid = state_of(name)
    some = [8, 25, 60, 120, 200, 300]
    parts, _ = parts_of(lens, source, method, clip=True)
    found = mtf_of(parts, method, grid.frequency[some] * 1000)
    allowed = 6e-4 + found.predicted_error * (method == "fitted")
    assert np.abs(found.sagittal - grid.along_x[some]).max() < allowed
    assert np.abs(found.tangential - grid.along_y[some]).max() < allowed
    whole, _ = parts_of(lens, source, method)
    open_ = mtf_of(whole, method, grid.frequency[some] * 1000)
    assert np.abs(found.tangential - open_.tangential).max() > 4 * 6e-4  # which rims change
    energy = energy_in(parts, method)
    radii = [energy.radius_50_um, energy.radius_80_um]
    assert [grid.energy(energy.centroid_x_um, energy.centroid_um, radius) for radius in radii] == pytest.approx(
        [0.5, 0.8],
        abs=2e-3 + energy.predicted_error,
    )


def test_a_line_is_the_transform_of_the_contrast_and_axes_may_turn():
    lens, source, grid = state_of("beside")
    parts, _ = parts_of(lens, source, clip=True)
    found = spread_of(parts, "traced")
    step = found.position_um[1] - found.position_um[0]
    assert found.line_y.sum() * step == pytest.approx(1, abs=0.01)
    at = grid.frequency[25]
    wave = np.abs((found.line_y * np.exp(-2j * np.pi * at * found.position_um)).sum() * step)
    assert wave == pytest.approx(grid.along_y[25], abs=0.01)  # of the tails beyond what is shown
    turned, _ = parts_of(lens, source, clip=True, turn_deg=90.0)
    across, plain = mtf_of(turned, "traced", [30.0, 90.0]), mtf_of(parts, "traced", [30.0, 90.0])
    assert across.tangential == pytest.approx(plain.sagittal, abs=5e-4)


def test_six_coefficients_know_where_rims_are():
    """A lens whose light fits them: the same pupil as that of rays, which are dark where rims are."""
    lens = find_lens("double_gauss_28")
    lens, source = with_mask(replace(lens, aperture=replace(lens.aperture, value=16.0)), RING), Source(field_deg=14)
    first, *others = lens.surfaces
    lens = replace(lens, surfaces=(replace(first, semi_diameter=0.62 * first.semi_diameter), *others))
    frequency = np.array([5.0, 20.0, 50.0])
    rays, six, whole = (
        mtf_of(parts_of(lens, source, method, clip)[0], method, frequency)
        for method, clip in (("traced", True), ("seidel", True), ("seidel", False))
    )
    assert np.abs(rays.perfect_tangential - whole.perfect_tangential).max() > 0.02
    assert rays.perfect_tangential == pytest.approx(six.perfect_tangential, abs=0.02)  # of its distorted pupil
