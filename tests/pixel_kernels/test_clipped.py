"""Kernels of pupils that rims clip and of pupils that fill the stop, against sums over exact rays."""

import numpy as np
import pytest

from p2sf.errors import GeometryError
from p2sf.lens.lens import with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.channel import Recipe, own_light
from p2sf.pixel_kernels.frequency_grid import fits_of, pupil_map, pupils_of
from p2sf.pixel_kernels.pixels import PixelWindow, half_width, pixel_kernel, samples_across
from p2sf.pixel_kernels.pupil_stack import cutting_rims, stack_pupils
from p2sf.pixel_kernels.pupil_table import chebyshev, pupil_table
from p2sf.pixel_kernels.sensor_points import sensor_map
from p2sf.pupil.fit import levels
from p2sf.scene.planning.reference import exact_pixels
from tests.support.tiers import in_tiers

WAVE, ANGLE = 0.5876, 0.4


def source(degrees: float) -> Source:
    return Source(np.inf, float(np.tan(np.deg2rad(degrees))), WAVE)


def relative(kernel, good) -> float:
    return float(np.linalg.norm(kernel - good) / np.linalg.norm(good))


def kernel_of(pupil, pixel_um: float, half: int) -> np.ndarray:
    """Return the kernel from a transform half as wide again, so that nothing wraps round."""
    wide = 3 * half // 2
    kernel = pixel_kernel(pupil, ANGLE, PixelWindow(wide, pixel_um, samples_across(pupil, pixel_um, 2.0)))
    middle = kernel[wide - half : wide + half + 1, wide - half : wide + half + 1]
    return middle / middle.sum()


@pytest.mark.parametrize("aim", ["paraxial", "stop"])
@pytest.mark.parametrize(
    ("name", "degrees", "pixel"),
    in_tiers([("double_gauss_28", 14.0, 8.0), ("cooke_triplet", 20.0, 4.0)], [("cooke_triplet", 20.0, 4.0)]),
)
def test_a_clipped_kernel_is_the_sum_of_the_rays_that_pass(name, degrees, pixel, aim):
    """3e-3 waves of the fit are 4πσ = 3.6e-2 at worst and 1e-2 here; the whole pupil is 8 to 17 % beside it."""
    lens, at = with_aim(find_lens(name), aim), source(degrees)
    pupil = pupil_map(lens, at, "fitted", clip=True)
    half = half_width(pupil, pixel)
    good = exact_pixels(lens, at, ANGLE, half, pixel, clip=True)
    assert relative(kernel_of(pupil, pixel, half), good) < 0.015
    assert relative(kernel_of(pupil_map(lens, at, "fitted"), pixel, half), good) > 0.05


def test_a_pupil_through_the_stop_has_the_weights_of_its_rays():
    """The Cooke triplet at 20°, where the weight falls by a third across the pupil."""
    lens, at = with_aim(find_lens("cooke_triplet"), "stop"), source(20.0)
    pupil = pupil_map(lens, at, "fitted")
    assert np.ptp(pupil.weight[:, 1:]) > 0.02
    half = half_width(pupil, 4.0)
    good = exact_pixels(lens, at, ANGLE, half, 4.0)
    assert relative(kernel_of(pupil, 4.0, half), good) < 0.01
    paraxial = pupil_map(with_aim(lens, "paraxial"), at, "fitted")
    assert not paraxial.weight.size
    assert relative(kernel_of(paraxial, 4.0, half), good) > 0.1


def test_rims_that_clip_nothing_leave_the_kernel_alone():
    lens, at = find_lens("double_gauss_28"), source(3.0)
    clipped, whole = (pupil_map(lens, at, "fitted", clip=clip) for clip in (True, False))
    assert clipped.rims.size and not cutting_rims(clipped).any()
    window = PixelWindow(half_width(whole, 6.0), 6.0, 5)
    # Both describe the same rays to PHASE_RESIDUAL, 4πσ = 2.5e-3 of a kernel, on nodes of their own.
    assert relative(*(pixel_kernel(pupil, ANGLE, window) for pupil in (clipped, whole))) < 2.5e-3


def test_a_field_beyond_all_rims_is_refused():
    with pytest.raises(GeometryError, match="rims clip every ray"):
        pupil_map(find_lens("periskop"), source(55.0), "fitted", clip=True)


def test_clipped_weighted_pupils_between_fitted_ones_are_those_of_rays():
    lens, recipe = with_aim(find_lens("double_gauss_28"), "stop"), Recipe("fitted")
    seen = sensor_map(lens, np.inf, WAVE, 25.0, clip=True)
    heights = chebyshev(18.0, 25.0, 5)
    pupils, landings = zip(*(own_light(seen, 0.0, h, WAVE, recipe) for h in heights), strict=True)
    table = pupil_table(([0.0], heights, [0.0], [WAVE]), stack_pupils(pupils), np.array(landings)[:, 1:])
    made, own = table.at(0.0, 22.3, 0.0, WAVE)[0], own_light(seen, 0.0, 22.3, WAVE, recipe)[0]
    assert made.rims.shape[0] == own.rims.shape[0] and made.energy == pytest.approx(own.energy, rel=0.02)
    window = PixelWindow(20, 8.0, 8)
    one, two = (pixel_kernel(pupil, ANGLE, window) for pupil in (made, own))
    assert relative(one, two) < 5e-3


def test_clipped_pupils_fitted_together_are_those_fitted_alone():
    lens = find_lens("double_gauss_28")
    slopes, level = np.tan(np.deg2rad([3.0, 13.0, 14.0])), levels(lens.aim)[1]
    sources = [Source(np.inf, slope, WAVE) for slope in slopes.tolist()]
    forms, _ = fits_of(lens, sources, level)
    together = pupils_of(lens, sources, forms, level, clip=True)
    for k, slope in enumerate(slopes):
        alone = pupil_map(lens, Source(np.inf, float(slope), WAVE), "fitted", level.numbers, clip=True)
        one = alone.of_order(together.order)
        assert together.energy[k] == pytest.approx(alone.energy, rel=1e-6)  # weights of aimed rays are differences
        # Whatever the order, both describe the same rays to PHASE_RESIDUAL, 4πσ = 2.5e-3 of a kernel, and the rims.
        window = PixelWindow(20, 8.0, 8)
        assert relative(*(pixel_kernel(pupil, ANGLE, window) for pupil in (together.some([k]), one))) < 5e-3
