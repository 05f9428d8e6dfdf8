"""Fans: behind a mask they have gaps where that covers the line, said in plain geometry, and nowhere else."""

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.errors import GeometryError
from p2sf.figures.fans import opd_fan, ray_fan
from p2sf.lens.lens import with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens

LENS, SOURCE = find_lens("double_gauss_28"), Source(field_deg=5)


@pytest.mark.parametrize("fan", [ray_fan, opd_fan])
@pytest.mark.parametrize("azimuth_deg", [0.0, 90.0])
def test_a_shadow_beside_the_middle_covers_each_line_where_geometry_says(fan, azimuth_deg):
    """A disc of radius 0.3 about (0.2, −0.1): a field along +x sees it turned, its own y being the lens's x."""
    mask = PupilMask(obscuration=0.3, obscuration_x=0.2, obscuration_y=-0.1, vanes=4, vane_width=0.2)
    source = Source(field_deg=5, azimuth_deg=azimuth_deg)
    found, bare = fan(with_mask(LENS, mask), source, 101), fan(LENS, source, 101)
    x, y = (0.2, -0.1) if not azimuth_deg else (0.1, 0.2)
    line = found.pupil
    for values, whole, centre, aside in (
        (found.tangential, bare.tangential, y, x),
        (found.sagittal, bare.sagittal, x, y),
    ):
        dark = (line - centre) ** 2 + aside**2 < 0.3**2
        assert 10 < dark.sum() < 40 and np.array_equal(np.isnan(values), dark), "the vanes along the lines left out"
        assert np.array_equal(values[~dark], whole[~dark])


def test_blades_end_a_line_at_the_edge_of_their_polygon():
    """A hexagon with a corner on +η reaches to 1 along it, and to cos 30° across, where an edge stands square."""
    blades = with_mask(LENS, PupilMask(blades=6))
    found = ray_fan(blades, SOURCE, 401)
    ends = [np.abs(found.pupil[np.isfinite(values)]).max() for values in (found.tangential, found.sagittal)]
    assert sorted(ends) == pytest.approx([np.cos(np.pi / 6), 1.0], abs=0.005)


def test_a_mask_that_bends_rays_is_refused():
    with pytest.raises(GeometryError):
        ray_fan(with_mask(LENS, PupilMask(cubic_um=1.0)), SOURCE)
