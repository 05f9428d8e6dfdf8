"""Columns in lens files: each reads as the plain file of that column would, and what is written is read back equal."""

import tomllib
from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.errors import LensFileError
from p2sf.glass.media import ConstantIndex, parse_medium
from p2sf.lens.lens import Aperture, Lens, with_sensor
from p2sf.lens.positions import PARAMETER, Axis, with_positions
from p2sf.lens.shapes import RadialPolynomial
from p2sf.lensfile.library import find_lens, lenses_folder
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml, read_toml, write_toml
from p2sf.paraxial.first_order import abcd
from p2sf.paraxial.positions import lens_at
from tests.support.lenses.zooms import focusing_zoom, two_group_zoom, zoom_lens_at

# Numbers with as many digits as a patent prints, in centimetres to see the unit at work.
ZOOM = """\
unit = "cm"
stop_surface = 3
fields_deg = [[0, 20], [0, 12.5], [0, 7]]
wavelengths_nm = [587.5618]

[zoom]
columns = ["wide", "normal", "tele"]
at = [28, 45, 82]
unit = "mm"

[aperture]
f_number = [3.5, 4, 4.5]

[[surface]]
radius = -5.12
thickness = 0.15
glass = 1.62

[[surface]]
radius = 4.417
thickness = [2.345, 1.203, 0.1]

[[surface]]
radius = 3.1
thickness = 0.45
glass = 1.58

[[surface]]
radius = -4.4
thickness = [4.5, 5.25, 6.75]
conic = [0, -0.5, -0.6]
"""


def matrix_of_column(text: str, column: int) -> np.ndarray:
    """Return the ABCD matrix of one column, mm, read by nothing but TOML and numpy."""
    table, matrix, before = tomllib.loads(text), np.eye(2), 1.0
    for row in table["surface"]:
        after = row.get("glass", 1.0)
        gap = row["thickness"][column] if isinstance(row["thickness"], list) else row["thickness"]
        matrix = np.array([[1.0, 0.0], [-(after - before) / (10 * row["radius"]), 1.0]]) @ matrix
        if row is not table["surface"][-1]:
            matrix = np.array([[1.0, 10 * gap / after], [0.0, 1.0]]) @ matrix
        before = after
    return matrix


@pytest.mark.parametrize(("name", "column"), [("wide", 0), ("normal", 1), ("tele", 2)])
def test_each_column_has_the_first_order_data_of_its_own_file(name, column):
    found = lens_at(parse_toml(ZOOM), zoom=name)
    # Two surfaces and two spaces are a dozen roundings of numbers near 1.
    np.testing.assert_allclose(abcd(found, 0.5876), matrix_of_column(ZOOM, column), rtol=1e-13)
    assert found.surfaces[-1].conic == (0, -0.5, -0.6)[column]
    assert found.aperture == Aperture("f_number", (3.5, 4, 4.5)[column])
    assert found.fields_deg == ((0, 20), (0, 12.5), (0, 7))[column]
    assert found.sensor_mm == pytest.approx((45, 52.5, 67.5)[column])


@pytest.mark.parametrize("name", ["zoom_3x", "macro_floating"])
def test_shipped_lenses_have_in_each_column_the_first_order_data_of_their_numbers(name):
    text, lens = (lenses_folder() / f"{name}.toml").read_text(encoding="utf-8"), find_lens(name)
    (axis,) = lens.positions.axes
    for column, place in enumerate(axis.at):
        found, expected, before = lens_at(lens, **{PARAMETER[axis.kind]: place}), np.eye(2), 1.0
        rows = tomllib.loads(text)["surface"]
        for number, row in enumerate(rows):
            radius, gap = (x[column] if isinstance(x, list) else x for x in (row["radius"], row["thickness"]))
            after = float(parse_medium(row.get("glass", "air")).index(0.5876))
            expected = np.array([[1.0, 0.0], [-(after - before) / radius, 1.0]]) @ expected
            if number < len(rows) - 1:
                expected = np.array([[1.0, gap / after], [0.0, 1.0]]) @ expected
            before = after
        # The difference of two products of some dozen factors near 1, in units of C.
        np.testing.assert_allclose(abcd(found, 0.5876), expected, rtol=1e-12, atol=1e-14)
        assert found.sensor_mm == gap


@pytest.mark.parametrize("lens", [two_group_zoom(), focusing_zoom()])
def test_what_is_written_is_read_back_equal(lens, tmp_path):
    write_toml(lens, tmp_path / "lens.toml")
    again = read_toml(tmp_path / "lens.toml")
    assert again == lens
    assert lens_to_toml(again) == lens_to_toml(lens)
    last = lens.positions.axes[-1]
    moved = lens_at(lens, **{{"zoom": "zoom", "focus": "focus_position"}[last.kind]: last.high})
    assert lens_to_toml(moved) == lens_to_toml(lens)


def test_glasses_and_rims_have_columns_too():
    first, *rest = zoom_lens_at(30.0).surfaces
    wet = replace(
        zoom_lens_at(30.0),
        surfaces=(replace(first, medium=ConstantIndex(1.6), semi_diameter=inf), *rest),
        fields_deg=(1.0,),
    )
    lens = with_positions([Axis("focus", ("dry", "wet"), (0.0, 1.0))], [zoom_lens_at(30.0), wet])
    assert parse_toml(lens_to_toml(lens)) == lens


@pytest.mark.parametrize("lens", [two_group_zoom(), focusing_zoom()])
def test_entries_that_are_tables_have_columns_in_tables(lens):
    axes, columns = lens.positions.axes, lens.positions.lenses

    def shaped(number: int) -> Lens:
        first, *rest = columns[number].surfaces
        return replace(columns[number], surfaces=(replace(first, shape=RadialPolynomial((0.0, 1e-6 * number))), *rest))

    made = with_positions(axes, [shaped(number) for number in range(len(columns))])
    assert parse_toml(lens_to_toml(made)) == made
    with pytest.raises(LensFileError, match="only some columns of the lens have shape"):
        lens_to_toml(with_positions(axes, [columns[0], *map(shaped, range(1, len(columns)))]))


def test_a_lens_that_was_focused_or_opened_is_written_as_it_is():
    there = with_sensor(lens_at(two_group_zoom(), zoom="tele"), 81.0)
    assert parse_toml(lens_to_toml(there)) == replace(there, positions=None)


TWO_RINGS = """\
[zoom]
columns = ["wide", "tele"]
[focus]
columns = ["far", "near"]
at = [0, 2.5]
unit = "dpt"
[aperture]
f_number = {{ zoom = [2, 4] }}
[[surface]]
radius = 50
thickness = {thickness}
glass = 1.5
[[surface]]
radius = -50
thickness = {{ focus = [40, 60] }}
"""


def test_a_list_of_lists_and_tables_of_lists_say_what_follows_which_ring():
    lens = parse_toml(TWO_RINGS.format(thickness="[[1, 2], [3, 4]]"))
    for zoom, focus, thickness in (("wide", "far", 1), ("wide", "near", 2), ("tele", "far", 3), ("tele", "near", 4)):
        there = lens_at(lens, zoom, focus)
        assert there.surfaces[0].thickness == thickness
        assert there.aperture.value == (2 if zoom == "wide" else 4)
        assert there.sensor_mm == (40 if focus == "far" else 60)
    assert [axis.at for axis in lens.positions.axes] == [(0.0, 1.0), (0.0, 2.5)]
    nested = "{ zoom = [{ focus = [1, 2] }, { focus = [3, 4] }] }"
    assert parse_toml(TWO_RINGS.format(thickness=nested)) == lens


@pytest.mark.parametrize(
    ("change", "line", "said"),
    [
        (("thickness = [2.345, 1.203, 0.1]", "thickness = [2.345, 1.203]"), 21, "surface 2: thickness is .* 3 columns"),
        (("thickness = [2.345, 1.203, 0.1]", 'thickness = [2.345, "x", 0.1]'), 21, 'surface 2: thickness is "x"'),
        (("f_number = [3.5, 4, 4.5]", "f_number = [3.5, 4, 0]"), 12, "f_number is 0"),
        (("at = [28, 45, 82]", "at = [28, 45]"), 8, "3 columns at 2 places"),
        (("at = [28, 45, 82]", "at = [28, 82, 45]"), 8, "ascend"),
        (('columns = ["wide", "normal", "tele"]', "columns = 3"), 7, "write at least two names"),
        (('unit = "mm"', 'units = "mm"'), 9, 'did you mean "unit"'),
        (("conic = [0, -0.5, -0.6]", "conic = { focus = [0, 1] }"), 31, r"add \[focus\]"),
        (("fields_deg = [[0, 20], [0, 12.5], [0, 7]]", "fields_deg = [[0, 20], [0, 7]]"), 3, "3 columns"),
    ],
)
def test_a_mistake_is_told_with_its_line(change, line, said):
    assert change[0] in ZOOM
    with pytest.raises(LensFileError, match=said) as caught:
        parse_toml(ZOOM.replace(*change))
    assert caught.value.line == line


def test_one_list_for_two_rings_is_refused():
    with pytest.raises(LensFileError, match=r"surface 1: thickness has one list, .* write \{ zoom"):
        parse_toml(TWO_RINGS.format(thickness="[1, 2]"))


def test_columns_of_which_nothing_varies_are_refused():
    text = lens_to_toml(zoom_lens_at(30.0)).replace("[aperture]", '[zoom]\ncolumns = ["a", "b"]\n[aperture]')
    with pytest.raises(LensFileError, match="nothing varies"):
        parse_toml(text)


def test_lists_without_columns_are_refused_as_before():
    with pytest.raises(LensFileError, match="thickness is"):
        parse_toml(lens_to_toml(zoom_lens_at(30.0)).replace("thickness = 2.0", "thickness = [2.0, 3.0]"))


def test_columns_with_different_stops_cannot_be_written():
    other = replace(zoom_lens_at(30.0), stop_surface=1)
    lens = with_positions([Axis("zoom", ("a", "b"), (0.0, 1.0))], [zoom_lens_at(30.0), other])
    with pytest.raises(LensFileError, match="different stops, 3, 1"):
        lens_to_toml(lens)
