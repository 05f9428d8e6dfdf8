"""Slider scales invert themselves; what people type is read, and refused in sentences."""

from math import inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from p2sf.errors import P2SFError
from p2sf_explorer.compute.quantities import QUANTITIES
from p2sf_explorer.state.scales import (
    Linear,
    Logarithmic,
    Stepped,
    Vergence,
    nice,
    one_reading,
    read_distance,
    read_number,
    ticks,
    written_distance,
)


@pytest.mark.parametrize("scale", [Linear(-2.0, 5.0), Logarithmic(1.4, 32.0), Vergence(60.0)])
@given(travel=st.floats(0, 1))
def test_travel_and_value_invert_each_other(scale, travel):
    assert scale.travel(scale.value(travel)) == pytest.approx(travel, abs=1e-12)  # round-off of two divisions


def test_whole_numbers_stand_evenly_along_the_travel_and_nothing_stands_between():
    scale = Stepped((0, 3, 4, 5, 6))
    assert [scale.value(scale.travel(number)) for number in scale.values] == list(scale.values)
    assert [scale.travel(number) for number in scale.values] == [0, 0.25, 0.5, 0.75, 1]
    assert (scale.value(0.3), scale.value(0.4), scale.travel(9)) == (3, 4, 1)
    assert (scale.moved(5, 0.3), scale.moved(5, -2), scale.moved(5, 2)) == (6, 0, 6)


READERS = {quantity.key: quantity.read for quantity in QUANTITIES}


def test_vergence_ends_at_infinity_and_is_even_in_dioptres():
    scale = Vergence(100.0)
    assert scale.value(1.0) == inf
    assert 1 / scale.value(0.5) == pytest.approx(0.5 / 100, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "mm"),
    [("2 m", 2000), ("2m", 2000), ("350", 350), ("12,5 cm", 125), ("∞", inf), ("inf", inf), ("3 km", 3e6)],
)
def test_distances_as_people_type_them(text, mm):
    assert read_distance(text) == mm


@pytest.mark.parametrize("mm", [12.5, 350.0, 999.0, 2000.0, inf])
def test_what_is_written_can_be_read(mm):
    assert read_distance(written_distance(mm)) == pytest.approx(mm, rel=1e-3)  # four digits are written


@pytest.mark.parametrize(
    ("key", "text", "value"),
    [
        *(("f_number", text, 5.6) for text in ("5.6", "5,6", "f/5.6", "F5.6", "f 5,6", "F/5.6", "f / 5.6", "1:5.6")),
        ("field_deg", "−10°", -10),
        ("wavelength_nm", "0.55 µm", 550),
        ("field_deg", "1e1", 10),
        ("field_deg", "12 deg", 12),
        ("field_deg", "12deg", 12),
        ("field_deg", "1.2e1 deg", 12),
        ("obscuration", "0,3", 0.3),
        ("obscuration", "30 %", 0.3),
        ("blades", "6", 6),
        ("apodisation", "∞", inf),
        ("apodisation", "0.8", 0.8),
        ("cubic_um", "−0.002 mm", -2),
        ("vane_angle_deg", "45°", 45),
    ],
)
def test_numbers_with_units(key, text, value):
    assert READERS[key](text) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    ("key", "text"),
    [
        ("sensor_shift_um", "2 m"),
        ("f_number", "1:5.6 mm"),
        ("field_deg", "2 m"),
        ("f_number", "550 nm"),
        ("depth_mm", "10°"),
        ("blades", "6 mm"),
        ("obscuration", "3 mm"),
    ],
)
def test_a_foreign_unit_is_refused_and_never_dropped(key, text):
    with pytest.raises(P2SFError, match="unit"):
        READERS[key](text)


@pytest.mark.parametrize("text", ["", "abc", "1 parsec", "nan"])
def test_what_is_no_distance_is_a_sentence(text):
    with pytest.raises(P2SFError, match="distance"):
        read_distance(text)


def test_nice_is_the_next_round_number():
    assert [nice(x) for x in (0.9, 1.0, 1.1, 3.0, 7.0)] == [1, 1, 2, 5, 10]


@pytest.mark.parametrize("decade", range(-12, 7))
@pytest.mark.parametrize("span", [1.0, 1.7, 3.0, 7.0])
def test_ticks_are_short_and_say_their_values(decade, span):
    half = span * 10.0**decade
    for value, text in ticks(-half, half, 5):
        assert float(text.replace("−", "-")) == pytest.approx(value, rel=1e-9, abs=1e-12 * half)
        assert len(text) <= 8, "an axis has room for no more"


@pytest.mark.parametrize("mm", [9.99e9, 1e10, 3.844e11, 1e99, 1.7e308])
def test_a_distance_is_never_longer_than_a_dozen_letters(mm):
    assert len(written_distance(mm)) <= 13 and read_distance(written_distance(mm)) == pytest.approx(mm, rel=1e-3)


@pytest.mark.parametrize(
    ("point", "text", "both"), [(",", "1.500 mm", ("1500", "1,500")), (".", "1,500", ("1500", "1.500"))]
)
def test_a_number_with_two_readings_is_refused_and_both_are_written(point, text, both):
    """By the rule of both languages: one separates thousands by what the other has before decimals."""
    with pytest.raises(P2SFError, match="two numbers") as said:
        one_reading(text, point)
    assert all(one in str(said.value) for one in both)
    assert [read_distance(one_reading(one, point)) for one in both] == [1500.0, 1.5]
    for plain in ("0.500", "0,500", "1.50", "1,5", "1500.25", "12.5000", f"1{point}500", "∞"):
        assert one_reading(plain, point) == plain


@pytest.mark.parametrize(
    ("point", "text", "both"),
    [(",", "1.500 m", ("1500 m", "1,500 m")), (".", "−1,500e3", ("−1500e3", "−1.500e3"))],
)
def test_what_stands_behind_a_number_with_two_readings_stays(point, text, both):
    with pytest.raises(P2SFError, match="write {} or {}".format(*both)):
        one_reading(text, point)


@pytest.mark.parametrize("text", ["1,234.5", "1.234,5", "1,234,567", "1.234.567"])
@pytest.mark.parametrize("point", [".", ","])
def test_a_number_in_groups_has_one_reading_which_is_refused_as_no_number(text, point):
    """To offer 1234 or 1.234 in place of 1,234,567 would be wrong either way."""
    with pytest.raises(P2SFError, match="is not a number"):
        read_number(one_reading(text, point), "radius")
