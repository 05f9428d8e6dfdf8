"""Ranges of axes: laws of zoom and pan, coarse steps with hysteresis, locks."""

from itertools import pairwise

import numpy as np
import pytest

from p2sf_explorer.charts.view import DEEPEST, AxisView, keep_or_grow, pan, width, zoom

SPANS = [(0.0, 1.0), (-3.0, 5.0), (1e-6, 2e-6), (400.0, 700.0), (-1e4, -9.99e3)]


@pytest.mark.parametrize("span", SPANS)
@pytest.mark.parametrize("factor", [0.1, 0.8, 1.25, 4.0])
def test_what_lies_under_the_pointer_stays_there_and_zooming_back_restores(span, factor):
    about = span[0] + 0.3 * width(span)
    found = zoom(span, about, factor)
    assert width(found) == pytest.approx(factor * width(span))
    assert (about - found[0]) / width(found) == pytest.approx(0.3)
    assert zoom(found, about, 1 / factor) == pytest.approx(span, rel=1e-9)


@pytest.mark.parametrize("span", SPANS)
def test_panning_keeps_the_width_and_back_is_home(span):
    by = 0.37 * width(span)
    found = pan(span, by)
    assert width(found) == pytest.approx(width(span)) and pan(found, -by) == pytest.approx(span)


def test_zoom_ends_before_floats_do():
    axis = AxisView((0.0, 1.0))
    for _ in range(500):
        axis = axis.moved_to(zoom(axis.shown, 0.3, 0.8))
    assert DEEPEST <= width(axis.shown) < 2 * DEEPEST
    for _ in range(500):
        axis = axis.moved_to(zoom(axis.shown, 0.3, 1.25))
    assert 10 < width(axis.shown) <= 20
    assert axis.at_home().shown == (0.0, 1.0)


SHAPES = [lambda v: (-v, v), lambda v: (0.0, v), lambda v: (-v, 0.0), lambda v: (-v, 2 * v)]


@pytest.mark.parametrize("shape", SHAPES)
def test_a_growing_and_shrinking_peak_changes_the_scale_rarely_and_by_steps_that_are_seen(shape):
    there = np.geomspace(1.0, 1000.0, 400)
    for values in (there, there[::-1]):
        kept, seen = shape(values[0]), []
        for value in values:
            kept = keep_or_grow(kept, shape(value))
            assert kept[0] <= shape(value)[0] and shape(value)[1] <= kept[1]
            assert width(shape(value)) >= 0.38 * width(kept), "the data fill the axis"
            seen += [kept] if kept not in seen[-1:] else []
        most = 20 if shape is not SHAPES[-1] else 40  # six steps a decade, and as many moves where both ends are free
        assert len(seen) <= most
        ratios = [max(width(a), width(b)) / min(width(a), width(b)) for a, b in pairwise(seen[1:])]
        assert min(ratios) > (1.3 if shape is not SHAPES[-1] else 1.0)


def test_a_peak_that_trembles_about_a_step_does_not_change_the_scale():
    kept, seen = (-1.0, 1.0), set()
    for k in range(100):
        kept = keep_or_grow(kept, (-2.0 - 0.1 * (-1) ** k, 2.0 + 0.1 * (-1) ** k))
        seen.add(kept)
    assert seen == {(-3.0, 3.0)}


def test_a_scale_about_zero_is_given_up_for_one_from_zero():
    assert keep_or_grow((-2.0, 2.0), (0.0, 1.9)) == (0.0, 2.0)


def test_far_from_zero_the_range_is_as_wide_as_the_data_and_not_as_far():
    low, high = keep_or_grow((0.0, 1.0), (1234.0, 1234.5))
    assert low <= 1234.0 and high >= 1234.5 and high - low <= 1.2


def test_a_locked_axis_ignores_the_data_and_home_is_where_it_is_locked():
    axis = AxisView((0.0, 1.0)).with_lock(True).fitted((0.0, 9.0), steady=True)
    assert axis.shown == (0.0, 1.0)
    axis = axis.moved_to((0.2, 0.4))
    assert axis.shown == (0.2, 0.4) and axis.at_home().shown == (0.0, 1.0)
    assert axis.at_home().with_lock(False).shown == (0.0, 10.0)


def test_a_zoomed_axis_is_locked_as_it_is_seen():
    axis = AxisView((0.0, 1.0)).moved_to((0.2, 0.4)).with_lock(True)
    assert axis.at_home().shown == (0.2, 0.4)


def test_a_zoomed_axis_stays_while_the_data_change():
    assert AxisView((0.0, 1.0)).moved_to((0.2, 0.4)).fitted((0.0, 3.0)).shown == (0.2, 0.4)
