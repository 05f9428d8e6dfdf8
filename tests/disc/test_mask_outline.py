"""The drawn outlines of a mask part what it leaves open from what it covers."""

from math import pi

import numpy as np
import pytest

from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.disc.mask_outline import dark_heights, obstructions, opening, vane

STEP = 1e-6  # beside a line; the lines are exact to rounding
IRISES = [
    PupilMask(blades=5),
    PupilMask(blades=6, blade_angle_deg=17.0, roundness=0.4),
    PupilMask(blades=3, turn_deg=50.0),
]


def area(outline: np.ndarray) -> float:
    """Return the area within a closed line, by the shoelace formula."""
    (x, y), (next_x, next_y) = outline[:, :-1], outline[:, 1:]
    return abs(float((x * next_y - next_x * y).sum())) / 2


@pytest.mark.parametrize("mask", IRISES, ids=str)
def test_just_inside_the_opening_light_passes_and_just_outside_none(mask):
    outline = opening(mask)
    assert np.allclose(outline[:, 0], outline[:, -1], atol=1e-12)
    assert mask.opens(*(outline * (1 - STEP))).all()
    assert not mask.opens(*(outline * (1 + STEP))).any()


@pytest.mark.parametrize("blades", [3, 4, 7])
def test_straight_blades_leave_the_area_of_the_inscribed_polygon(blades):
    assert area(opening(PupilMask(blades=blades))) == pytest.approx(blades / 2 * np.sin(2 * pi / blades), rel=1e-12)


def test_without_blades_the_opening_is_the_rim():
    assert np.allclose(np.hypot(*opening(CLEAR)), 1.0, atol=1e-15)
    assert obstructions(CLEAR) == () == dark_heights(CLEAR)


def test_vanes_and_obscuration_cover_what_lies_within_their_outlines():
    mask = PupilMask(obscuration=0.3, vanes=3, vane_width=0.05, vane_angle_deg=20.0)
    disc, *vanes = obstructions(mask)
    assert not mask.opens(*(disc * (1 - STEP))).any() and len(vanes) == 3
    for corners in vanes:
        middle = corners[:, :4].mean(axis=1, keepdims=True)
        assert not mask.opens(*(middle + (corners[:, 1:3] - middle) * (1 - STEP))).any()
        across = corners[:, 2:3] - corners[:, 1:2]
        beside = (corners[:, 1:2] * (1 - STEP) - STEP * across, corners[:, 2:3] * (1 - STEP) + STEP * across)
        assert all(mask.opens(*point).all() for point in beside)
    assert area(vane(0.7, 0.05)) == pytest.approx(0.1, rel=1e-12)


@pytest.mark.parametrize("mask", [*IRISES, PupilMask(obscuration=0.4), PupilMask(obscuration=0.6, blades=4)], ids=str)
def test_dark_heights_are_those_that_the_mask_covers(mask):
    eta = np.linspace(-0.9995, 0.9995, 2000)
    dark = np.zeros(eta.size, bool)
    for low, high in dark_heights(mask):
        dark |= (eta > low) & (eta < high)
    assert np.array_equal(dark, ~mask.opens(np.zeros_like(eta), eta))
