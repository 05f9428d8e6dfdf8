"""Maps of the wavefront over pupils with holes, against the rays of a fine grid; more in tests/explorer/compute."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.lens.lens import with_mask
from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.wavefront_map import map_of, wavefront_of_rays
from p2sf.raytrace.pencil import displayed_opd, pencil, pupil_grid
from tests.support.waves import rms_about_plane

POINT = Source(field_deg=10.0)


@pytest.mark.parametrize("mask", [PupilMask(), PupilMask(blades=6)], ids=["clear", "iris"])
@pytest.mark.parametrize("off", [False, True], ids=["aligned", "off"])
def test_what_a_surface_shadows_counts_nowhere(off, mask):
    lens = find_lens("tessar")
    first, *others = lens.surfaces
    lens = with_mask(replace(lens, surfaces=(replace(first, inner_radius=0.3 * first.semi_diameter), *others)), mask)
    lens = displaced(lens, 3, 4, Placement(0.02, 0.05, 0.0, 0.05, 0.02)) if off else lens
    waves, clear = wavefront_of_rays(lens, POINT, "settled", clip=True)
    found = map_of(lens, POINT, waves, "settled", clear)
    xi, eta, inside = pupil_grid(300)
    inside = inside & mask.opens(xi, eta)
    xi, eta = xi[inside], eta[inside]
    passed = pencil(lens, POINT, xi, eta, clip=True).passed
    assert 0.3 < passed.mean() < 0.9
    xi, eta = xi[passed], eta[passed]
    waves = displayed_opd(lens, POINT, xi, eta)
    assert found.clear == pytest.approx(xi.size * 4 / 300**2 / np.pi, abs=1e-3)
    assert found.rms == pytest.approx(rms_about_plane(waves, xi, eta), rel=2e-3)  # by the edges of the grid


@pytest.mark.parametrize("quality", ["preview", "settled"])
@pytest.mark.parametrize(
    ("name", "field_deg", "mask", "clip"),
    [
        ("double_gauss_28", 14.0, {"obscuration": 0.6}, True),
        ("cooke_triplet", 20.0, {"obscuration": 0.8}, True),
        ("petzval", 3.64, {"vanes": 7, "vane_width": 0.3}, False),
        ("double_gauss_28", 4.0, {"obscuration": 0.3, "obscuration_x": 0.2}, False),
    ],
)
def test_little_that_is_open_has_an_rms_as_well(name, field_deg, mask, clip, quality):
    """To 3 %: by the edges of the grid, and of a preview, whose nodes are few."""
    lens, source = with_mask(find_lens(name), PupilMask(**mask)), Source(field_deg=field_deg)
    waves, clear = wavefront_of_rays(lens, source, quality, clip)
    found = map_of(lens, source, waves, quality, clear)
    xi, eta, inside = pupil_grid(400)
    inside = inside & mask_seen(lens, source).opens(xi, eta)
    xi, eta = xi[inside], eta[inside]
    waves = displayed_opd(lens, source, xi, eta)
    passed = pencil(lens, source, xi, eta, clip=clip).passed & np.isfinite(waves)
    assert passed.mean() > 0.1
    assert found.rms == pytest.approx(rms_about_plane(waves[passed], xi[passed], eta[passed]), rel=0.03)
