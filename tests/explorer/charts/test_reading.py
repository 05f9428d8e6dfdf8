"""Numbers as they are read: digits, powers of ten, and what lies between samples."""

import numpy as np
import pytest

from p2sf_explorer.charts.reading import (
    Samples,
    between,
    certain_digits,
    curves_at,
    format_number,
    split_label,
    with_unit,
)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (1.23456, "1.235"),
        (-0.001234, "−0.001234"),
        (-0.00012345, "−1.234·10⁻⁴"),
        (9.99996e-5, "1.000·10⁻⁴"),
        (1234567.0, "1.235·10⁶"),
        (float("nan"), "–"),
    ],
)
def test_a_number_has_four_digits_and_a_power_of_ten_where_zeros_would_hide_it(value, text):
    assert format_number(value) == text


@pytest.mark.parametrize(("value", "error", "digits"), [(0.5, 0.0, 4), (0.5, 1e-3, 3), (0.5, 2e-3, 2), (0.5, 0.4, 1)])
def test_no_digit_is_written_that_counts_for_less_than_the_error(value, error, digits):
    assert certain_digits(value, error) == digits


def test_between_samples_the_error_is_within_what_is_stated():
    at = np.linspace(0, 2 * np.pi, 40)
    for place in np.linspace(0.3, 5.9, 57):
        value, error = between(at, np.sin(at), place)
        assert value == pytest.approx(np.sin(place), abs=max(error, 1e-12))
        assert error < 4e-3
    assert between(at, np.sin(at), at[7]) == (np.sin(at[7]), 0.0)
    assert np.isnan(between(at, np.sin(at), -1.0)[0]), "beyond the ends there is nothing"


def test_a_gap_has_no_value():
    at, values = np.arange(6.0), np.array([0.0, 1.0, np.nan, np.nan, 4.0, 5.0])
    assert np.isnan(between(at, values, 2.5)[0])


@pytest.mark.parametrize(
    ("label", "name", "unit"),
    [("field, °", "field", "°"), ("y, µm (towards the field)", "y", "µm"), ("contrast", "contrast", "")],
)
def test_an_axis_is_a_name_and_a_unit(label, name, unit):
    assert split_label(label) == (name, unit)
    assert with_unit("1", label) == f"1{'' if unit in ('°', '') else ' '}{unit}"


class Line:
    def __init__(self, name, x, y):
        self.name, self.token, self.x, self.y = name, "text", np.asarray(x, float), np.asarray(y, float)


def test_curves_are_read_at_the_nearest_sample_of_any_and_where_asked_between_them():
    first, second = Line("a", [0, 1, 2], [0, 1, 4]), Line("b", [0, 0.9, 2], [5, 6, 7])
    snapped = curves_at([first, second], ("x, mm", "y, µm"), 0.93)
    assert snapped.x == 0.9 and snapped.values[1].text == "6.000 µm" and snapped.head == "x 0.9000 mm"
    free = curves_at([first], ("x, mm", "y, µm"), 1.5, snap=False)
    assert free.x == 1.5 and free.values[0].number == pytest.approx(2.25)


def test_every_sample_covers_its_own_middle_and_half_of_the_way_to_the_next():
    samples = Samples(np.zeros((3, 4)), (-2.0, 1.0, 8.0, 3.0))
    for row, column in np.ndindex(3, 4):
        x, y = samples.centre(row, column)
        assert samples.nearest(x - 0.99, y - 0.49) == samples.nearest(x + 0.99, y + 0.49) == (row, column)
