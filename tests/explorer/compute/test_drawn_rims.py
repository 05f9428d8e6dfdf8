"""Mirrors with decentred rims are drawn where their glass is."""

from dataclasses import replace

import pytest

from p2sf.lens.rim import Rim
from p2sf_explorer.compute.glass_outlines import glass_of
from tests.support.lenses.mirrors import mirror


@pytest.mark.parametrize(("rim", "ends"), [(Rim((0.0, 60.0)), (50, 70)), (Rim((0.0, -30.0), (20.0, 5.0)), (-35, -25))])
def test_a_mirror_off_the_axis_is_drawn_between_the_ends_of_its_rim(rim, ends):
    whole = mirror(-400.0, -200.0, -1.0, rim=10.0)
    lens = replace(whole, surfaces=(replace(whole.surfaces[0], rim=rim),))
    (drawn,) = glass_of(lens).mirrors
    assert (drawn.y[0], drawn.y[-1]) == pytest.approx(ends)
    assert drawn.z == pytest.approx(-(drawn.y**2) / 800.0)
