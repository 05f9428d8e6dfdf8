"""Axes as a person types them: numbers and ranges, spaced evenly, depths by what defocus is linear in."""

from math import inf

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.spans import MOST_NODES, check_ascending, depths, numbers


def test_numbers_and_ranges_may_be_mixed():
    assert numbers("0, 7,10:14:3", "x").tolist() == [0, 7, 10, 12, 14]
    assert numbers("400:700:4", "x").tolist() == [400, 500, 600, 700]
    assert numbers("2 ; 0:1:2", "x", ";", lambda text: 10 * float(text)).tolist() == [20, 0, 10]


def test_a_range_of_depths_is_even_in_dioptres_and_has_the_ends_that_were_typed():
    """1 m, infinity and two between: 1, 2/3, 1/3 and 0 dpt."""
    assert depths("1000:inf:4", "x") == pytest.approx([1000, 1500, 3000, inf], rel=1e-15)
    found = depths("300:7000:9, inf", "x")
    assert (found[0], found[8], found[9]) == (300, 7000, inf)
    assert np.diff(1 / found[:9]) == pytest.approx(np.full(8, (1 / 7000 - 1 / 300) / 8), rel=1e-12)
    assert depths("inf", "x").tolist() == [inf]


@pytest.mark.parametrize("text", ["a", "a:b:3", "1:2", "1:2:3:4", "1:2:2.5", "nan", "1,nan:2:3", "2:1:3", "inf:5:2"])
@pytest.mark.parametrize("read", [numbers, depths])
def test_what_is_no_axis_is_refused_by_name(read, text):
    with pytest.raises(RequestError) as error:
        read(text, "fields_deg")
    assert error.value.message.values["parameter"] == "fields_deg" and error.value.message.values["value"] == text


@pytest.mark.parametrize("count", [0, 1, MOST_NODES + 1])
def test_a_range_has_two_ends_and_an_end(count):
    with pytest.raises(RequestError) as error:
        numbers(f"0:1:{count}", "x")
    assert error.value.message.values["count"] == count


def test_only_distances_reach_infinity_and_they_are_in_front_of_the_lens():
    for read, text in (
        (numbers, " "),
        (numbers, "0:inf:3"),
        (depths, "0:10:3"),
        (depths, "-5:inf:3"),
        (depths, "5,-1"),
    ):
        with pytest.raises(RequestError):
            read(text, "x")
    with pytest.raises(RequestError):
        check_ascending(numbers("0:3:2,2", "x"), "0:3:2,2", "x")
