"""The figure of merit of faint tails: what it sees where R² sees nothing."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import j1

from p2sf.conventions import centred_axis
from p2sf.disc.mask import PupilMask
from p2sf.errors import SamplingError
from p2sf.figures.compare import r_squared
from p2sf.figures.tails import tail_error
from p2sf.lens.lens import with_f_number, with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.methods import render
from p2sf.psf.result import Psf

AIRY_UM = 2.0


def airy(pixels: int) -> Psf:
    axis = centred_axis(pixels, AIRY_UM / 4)
    v = np.maximum(np.hypot(axis, axis[:, None]) * (3.8317 / AIRY_UM), 1e-9)
    values = (2 * j1(v) / v) ** 2
    return Psf(values / values.sum(), AIRY_UM / 4, 0.55, "exact")


def test_a_clear_disc_reaches_28_airy_radii():
    """Its mean is 4/(π·v³) far out, 1e-6 of the peak at v = 108: 28 first zeros, to a ring."""
    exact = airy(400)
    found, reach = tail_error(exact, exact, AIRY_UM), (4e6 / np.pi) ** (1 / 3) / 3.8317
    assert found.mean == 0 and found.radius_um / AIRY_UM == pytest.approx(reach, abs=1)


def test_a_tenth_more_light_far_out_is_seen_where_r2_is_blind():
    exact = airy(200)
    far = np.hypot(exact.x_um, exact.y_um[:, None]) > 10 * AIRY_UM
    off = replace(exact, values=np.where(far, 1.1 * exact.values, exact.values))
    found = tail_error(off, exact, AIRY_UM)
    assert found.mean == pytest.approx(0.1, abs=1e-12) and 0 < found.encircled < 0.01
    assert 1 - r_squared(off.values, exact.values) < 1e-5
    with pytest.raises(SamplingError, match="two different windows"):
        tail_error(off, airy(100), AIRY_UM)


@pytest.mark.slow
@pytest.mark.parametrize("f_number", [4.0, 16.0])
@pytest.mark.parametrize("mask", [PupilMask(), PupilMask(blades=6), PupilMask(vanes=4)], ids=repr)
def test_fitted_tails_are_those_of_every_ray(f_number, mask):
    """Far out the light is that of the edge, which nodes follow: a tenth is asked, a hundredth is kept."""
    lens = with_mask(with_f_number(find_lens("double_gauss_28"), f_number), mask)
    source, radius = Source(field_deg=7), 1.22 * 0.5876 * f_number
    quick, exact = (render(lens, source, method, 512, radius / 3) for method in ("fitted", "huygens"))
    assert tail_error(quick, exact, radius).mean < 0.01
