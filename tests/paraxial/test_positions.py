"""Positions of a lens: exact in every column, monotone and smooth between them, and focused by the ring inside."""

import pickle
from dataclasses import fields, replace
from math import inf

import numpy as np
import pytest

from p2sf.disc.mask import PupilMask
from p2sf.errors import GeometryError, RequestError
from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface, with_sensor
from p2sf.lens.positions import Axis, Positions, interpolate_lens, steps_between, with_positions
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml
from p2sf.paraxial.first_order import cardinal_points, image_distance
from p2sf.paraxial.lens_checks import lens_checks
from p2sf.paraxial.positions import edit_columns, focused_vergence, lens_at, matches_columns
from p2sf.setting import Request, set_up
from tests.support.lenses.zooms import FOCAL, FRONT, REAR, focusing_zoom, spaces, two_group_zoom, zoom_lens_at

ZOOM = two_group_zoom()


def efl(lens: Lens) -> float:
    return float(cardinal_points(lens, lens.reference_wavelength_um).effective_focal_length)


@pytest.mark.parametrize(("column", "focal"), [("wide", 30.0), ("40 mm", 40.0), ("TELE", 60.0)])
def test_a_column_is_the_lens_of_its_own_to_the_last_bit(column, focal):
    for asked in (column, focal, f"{focal:g} mm"):
        found = lens_at(ZOOM, zoom=asked)
        assert replace(found, positions=None) == zoom_lens_at(focal)
        assert found.positions.words.text() == f"zoom {column.lower()}"
    # Eight roundings of numbers of at most 1 lie between the focal length and its spaces.
    assert efl(found) == pytest.approx(focal, rel=1e-14)


def fritsch_butland(x, y, at):
    """Return a monotone cubic (Fritsch & Butland 1984) at one inner place of three nodes, written out by hand."""
    h, s = np.diff(x), np.diff(y) / np.diff(x)
    inner = 3 * (h[0] + h[1]) / ((2 * h[1] + h[0]) / s[0] + (h[1] + 2 * h[0]) / s[1]) if s[0] * s[1] > 0 else 0.0
    ends = []
    for near, far in ((0, 1), (1, 0)):
        slope = ((2 * h[near] + h[far]) * s[near] - h[near] * s[far]) / (h[0] + h[1])
        if slope * s[near] <= 0:
            slope = 0.0
        elif s[0] * s[1] < 0 and abs(slope) > 3 * abs(s[near]):
            slope = 3 * s[near]
        ends.append(slope)
    d = (ends[0], inner, ends[1])
    k = 0 if at < x[1] else 1
    t = (at - x[k]) / h[k]
    hermite = ((1 + 2 * t) * (1 - t) ** 2, t * (1 - t) ** 2, t**2 * (3 - 2 * t), t**2 * (t - 1))
    return hermite @ np.array([y[k], h[k] * d[k], y[k + 1], h[k] * d[k + 1]])


@pytest.mark.parametrize("focal", [30.1, 34.0, 39.9, 47.0, 59.0])
def test_between_columns_lie_monotone_cubics(focal):
    found = interpolate_lens(ZOOM.positions, (focal,))
    for number, index in ((2, 0), (4, 1)):
        nodes = [spaces(at)[index] for at in FOCAL]
        expected = fritsch_butland(np.array(FOCAL), np.array(nodes), focal)
        assert found.surfaces[number - 1].thickness == pytest.approx(expected, rel=1e-13)  # rounding of a cubic


def test_spaces_and_fields_are_monotone_between_columns_and_pass_through_them():
    places = np.linspace(30, 60, 601)
    lenses = [lens_at(ZOOM, zoom=place) for place in places]
    for curve in (
        [lens.surfaces[1].thickness for lens in lenses],
        [-lens.surfaces[3].thickness for lens in lenses],
        [lens.fields_deg[1] for lens in lenses],
    ):
        steps = np.diff(curve)
        assert (steps < 0).all()
        assert np.abs(np.diff(steps)).max() < 0.1 * np.abs(steps).max()  # no jump, no bend: slopes join
    assert {lens.fields_deg[0] for lens in lenses} == {0.0}
    assert {lens.surfaces[0] for lens in lenses} == {ZOOM.surfaces[0]}


@pytest.mark.parametrize("focal", [31.0, 35.0, 39.0, 50.0])
def test_a_zoom_keeps_its_focus_between_columns(focal):
    """The cubics alone leave the image up to 0.7 mm from the sensor; its columns are focused at infinity."""
    found = lens_at(ZOOM, zoom=focal)
    assert found.surfaces[:-1] == interpolate_lens(ZOOM.positions, (focal,)).surfaces[:-1]
    # Images of the columns are on their sensors to some roundings of 80 mm.
    assert found.sensor_mm == pytest.approx(float(image_distance(found, inf, 0.5875618)), abs=1e-11)
    # By hand: two thin groups this far apart.
    apart = found.surfaces[1].thickness + 2.0 / 1.5
    assert found.sensor_mm == pytest.approx(REAR * (FRONT - apart) / (FRONT + REAR - apart), rel=1e-13)


def test_a_zoom_focused_nearer_in_its_columns_is_so_between_them():
    near = with_positions(
        ZOOM.positions.axes, [with_sensor(lens, lens.sensor_mm + 0.5) for lens in ZOOM.positions.lenses]
    )
    vergences = [focused_vergence(lens_at(near, zoom=place)) for place in np.linspace(30, 60, 61)]
    assert (np.diff(vergences) < 0).all()  # half a millimetre behind a longer lens is farther away
    assert vergences[-1] == pytest.approx(0.5 / 60.0**2, rel=0.02)  # Newton's x x' = f², and x is from the front focus


def test_numbers_that_are_equal_in_two_columns_do_not_move_between_them():
    columns = [zoom_lens_at(30.0), zoom_lens_at(30.0), zoom_lens_at(60.0)]
    lens = with_positions([Axis("zoom", ("a", "b", "c"), (0.0, 1.0, 2.0))], columns)
    assert lens_at(lens, zoom=0.6).surfaces == columns[0].surfaces
    assert lens_at(lens, zoom=1.6).surfaces != columns[0].surfaces


def test_a_radius_passes_through_the_plane():
    axis = Axis("focus", ("far", "near"), (0.0, 1.0))
    columns = [Lens((Surface(radius, 50.0, conic=radius),), Aperture("f_number", 8.0)) for radius in (100.0, -100.0)]
    middle = lens_at(with_positions([axis], columns), focus_position=0.5).surfaces[0]
    assert middle.radius == inf
    assert middle.conic == 0.0
    quarter = lens_at(with_positions([axis], columns), focus_position=0.25).surfaces[0]
    assert quarter.radius == pytest.approx(200.0, rel=1e-15)


def test_glass_is_that_of_the_nearest_column_and_this_is_said():
    def filled(index: float) -> Lens:
        first, *rest = zoom_lens_at(30.0).surfaces
        return replace(zoom_lens_at(30.0), surfaces=(replace(first, medium=ConstantIndex(index)), *rest))

    lens = with_positions([Axis("zoom", ("dry", "wet"), (0.0, 1.0))], [filled(1.5), filled(1.6)])
    for place, index, said in ((0.0, 1.5, 0), (0.4, 1.5, 1), (0.6, 1.6, 1), (1.0, 1.6, 0)):
        there = lens_at(lens, zoom=place)
        assert there.surfaces[0].medium == ConstantIndex(index)
        assert len(steps_between(there)) == said
        assert set(steps_between(there)) <= set(lens_checks(there))
    assert "column wet" in str(steps_between(lens_at(lens, zoom=0.6))[0])


def test_two_rings_turn_independently():
    lens = focusing_zoom()
    near = lens_at(lens, "tele", "near")
    assert near.surfaces[1].thickness == spaces(60.0)[0] + 3.0
    assert lens_at(near, focus_position="far").surfaces == zoom_lens_at(60.0).surfaces
    # In a column of the zoom the ring moves its group by its own scale: straight lines are their own cubics.
    between = lens_at(lens, "wide", 2.0)
    assert between.surfaces[1].thickness == pytest.approx(spaces(30.0)[0] + 2.0, rel=1e-14)
    assert between.positions.words.text() == "zoom wide, focus 2"


@pytest.mark.parametrize("focal", [30.0, 60.0])
@pytest.mark.parametrize("out", [0.25, 1.0, 2.7])
def test_the_ring_of_focus_finds_the_place_of_a_distance(focal, out):
    """Two thin groups by hand: the object whose image by the front group is where that of infinity was."""
    image = 1 / (1 / FRONT)  # of infinity, behind the front group, which has moved out by ``out``
    image += out  # what the rear group needs
    distance = -1 / (1 / image - 1 / FRONT)  # before the group, whose principal plane is THICK/INDEX behind its plane
    lens = focusing_zoom()
    setup = set_up(lens, Request(focus_mm=distance - 2.0 / 1.5, zoom=focal))
    # The image's slope in the ring is about (b/a)², and brentq ends within 1e-12 of the travel.
    assert setup.lens.positions.at("focus") == pytest.approx(out, abs=1e-9)
    assert setup.lens.sensor_mm == pytest.approx(spaces(focal)[1], rel=1e-11)
    assert float(image_distance(setup.lens, distance - 2 / 1.5, 0.5875618)) == pytest.approx(setup.lens.sensor_mm)


def test_beyond_the_ring_the_sensor_moves():
    setup = set_up(focusing_zoom(), Request(focus_mm=500.0, zoom="tele"))
    assert setup.lens.positions.at("focus") == 3.0
    assert setup.lens.sensor_mm > 81
    assert float(image_distance(setup.lens, 500.0, 0.5875618)) == setup.lens.sensor_mm


def test_a_lens_without_rings_is_focused_by_its_sensor():
    lens = zoom_lens_at(40.0)
    assert set_up(lens, Request(focus_mm=1000.0)).lens.surfaces[:-1] == lens.surfaces[:-1]


@pytest.mark.parametrize(
    ("lens", "asked", "said"),
    [
        (
            ZOOM,
            {"zoom": 61.0},
            "zoom is 61; give a number from 30 to 60 mm, or a column of the lens: wide, 40 mm, tele",
        ),
        (ZOOM, {"zoom": "normal"}, "zoom is normal"),
        (ZOOM, {"zoom": float("nan")}, "zoom is nan"),
        (ZOOM, {"focus_position": 0.0}, "focus_position is 0, but the lens has no such ring"),
        (zoom_lens_at(30.0), {"zoom": 30.0}, "zoom is 30, but the lens has no such ring"),
    ],
)
def test_places_that_are_not_on_a_ring_are_refused(lens, asked, said):
    with pytest.raises(RequestError, match=said):
        lens_at(lens, **asked)
    with pytest.raises(RequestError, match=said):
        set_up(lens, Request(**asked))


def test_a_focus_is_stated_once():
    with pytest.raises(RequestError, match="twice"):
        Request(focus_mm=1000.0, focus_position=1.0)


def test_columns_that_make_no_lens_are_refused():
    with pytest.raises(GeometryError, match="ascend"):
        Axis("zoom", ("a", "b"), (1.0, 1.0))
    with pytest.raises(GeometryError, match="two columns"):
        Axis("zoom", ("a", "a"), (1.0, 2.0))
    with pytest.raises(GeometryError, match="at least two"):
        Axis("zoom", ("a",), (1.0,))
    axis = Axis("zoom", ("a", "b"), (0.0, 1.0))
    with pytest.raises(GeometryError, match="3 lenses for 2"):
        Positions((axis,), (zoom_lens_at(30.0),) * 3, (0.0,))
    short = replace(zoom_lens_at(30.0), surfaces=zoom_lens_at(30.0).surfaces[1:], stop_surface=2)
    with pytest.raises(GeometryError, match="3, 4 surfaces"):
        with_positions([axis], [short, zoom_lens_at(30.0)])


def test_what_does_not_depend_on_the_position_goes_along():
    lens = replace(ZOOM, name="mine", aim="paraxial", mask=PupilMask(obscuration=0.3))
    there = lens_at(lens, zoom=50.0)
    assert (there.name, there.aim, there.mask) == ("mine", "paraxial", PupilMask(obscuration=0.3))
    assert parse_toml(lens_to_toml(lens)) == lens
    assert {field.name for field in fields(Lens)} - {"positions"} <= set(there.__getstate__())


def test_an_edit_of_each_column_keeps_the_place():
    there = lens_at(ZOOM, zoom=50.0)
    doubled = edit_columns(there, lambda lens: replace(lens, aperture=Aperture("f_number", 4.0)))
    assert doubled.positions.place == (50.0,)
    assert doubled.aperture == Aperture("f_number", 4.0)
    assert lens_at(doubled, zoom="wide").aperture == Aperture("f_number", 4.0)
    assert matches_columns(doubled)
    assert not matches_columns(replace(doubled, aperture=Aperture("f_number", 5.6)))


def test_a_zoom_survives_pickling():
    there = lens_at(ZOOM, zoom=50.0)
    assert pickle.loads(pickle.dumps(there)) == there
