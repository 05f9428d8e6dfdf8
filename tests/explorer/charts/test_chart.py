from itertools import pairwise
from math import inf

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRect
from PySide6.QtGui import QColor, QImage

from p2sf_explorer.charts.axes import bottom_ticks, left_ticks
from p2sf_explorer.charts.chart import Chart, strips
from p2sf_explorer.charts.colour_scale import ColourScale
from p2sf_explorer.charts.painting import polylines, set_text
from p2sf_explorer.charts.plots import EMPTY, HeatMap, as_indices
from p2sf_explorer.charts.theme import LIGHT
from p2sf_explorer.panels.layout.marks import free_room
from p2sf_explorer.state.scales import ticks
from p2sf_explorer.widgets.chart_card import NotedChart
from tests.explorer.accessibility.test_looks import contrast


@pytest.fixture
def chart(qtbot):
    made = Chart("x", "y", aspect=True)
    qtbot.addWidget(made)
    made.resize(400, 300)
    made.set_range((-2.0, 3.0), (-1.0, 1.0))
    return made


def test_pixels_and_data_are_each_others_inverse_and_circles_are_round(chart):
    x, y = chart.to_pixels(0.7, -0.3)
    assert chart.from_pixels(QPointF(x, y)) == pytest.approx((0.7, -0.3))
    right, up = (
        chart.to_pixels(1.0, 0.0)[0] - chart.to_pixels(0.0, 0.0)[0],
        np.diff(chart.to_pixels(0, np.arange(2))[1]),
    )
    assert right == pytest.approx(-float(up[0]))


def test_what_was_asked_for_is_in_sight(chart):
    (left, right), (low, high) = chart.ranges()
    assert left <= -2 and right >= 3 and low <= -1 and high >= 1


def test_notes_at_the_upper_edge_stand_below_each_other_where_they_would_overlap(qtbot):
    noted = NotedChart("x", "y")
    qtbot.addWidget(noted)
    noted.resize(400, 120)
    noted.set_range((0.0, 10.0), (0.0, 1.0))
    noted.show_notes(
        ((5.0, inf, "as designed", "text", -1), (5.2, inf, "build 7", "text", -1), (9.9, inf, "far", "text", 1))
    )
    first, second, far = noted.note_rooms()
    assert not first.intersects(second) and second.top() == first.bottom() and far.top() == first.top()


def test_a_square_is_shown_whole_wherever_it_is(chart):
    chart.set_view((3.0, -40.0), 7.0)
    (left, right), (low, high) = chart.ranges()
    assert (low, high) == (-47.0, -33.0) and (left + right) / 2 == 3.0 and right - left > 14.0


@pytest.mark.parametrize(("low", "high"), [(-1.0, 1.0), (0.0, 1.04), (-147.0, 147.0), (-3e-4, 2e-3), (0.0, 1e6)])
def test_ticks_are_few_round_inside_and_written_as_they_are(low, high):
    found = list(ticks(low, high, 6))
    assert 3 <= len(found) <= 7
    for value, text in found:
        assert low - 1e-9 <= value <= high * (1 + 1e-9)
        assert float(text.replace("−", "-")) == pytest.approx(value, abs=1e-9 * (high - low))


@pytest.mark.parametrize("half", [101.0, 147.0, 199.0, 260.0, 499.0, 1040.0, 0.35])
@pytest.mark.parametrize("most", [1.2, 1.9, 2.5])
def test_an_axis_with_little_room_says_its_scale_all_the_same(half, most):
    found = [value for value, _ in ticks(-half, half, most)]
    assert len(found) == 3 and found[1] == 0 and found[2] == -found[0] > 0.4 * half


@pytest.mark.parametrize("half", [104.0, 4680.0, 832.0])
def test_ticks_below_a_round_picture_are_at_least_three_and_do_not_touch(chart, half):
    chart.set_range((-half, half), (-half, half))
    for width in (100, 120, 160, 200, 260, 400):
        chart.resize(width + 69, 250)
        chart.forget_background()  # no resize event reaches a chart that is not on screen
        below = [
            (float(chart.to_pixels(value, 0.0)[0]), set_text(text).size().width())
            for value, text in bottom_ticks(chart)
        ]
        assert len(below) >= 3
        assert all(b - a > (one + other) / 2 for (a, one), (b, other) in pairwise(below))


@pytest.mark.parametrize("half", [104.0, 190.0, 205.0, 4680.0])
def test_a_large_chart_has_no_more_ticks_than_can_be_read_at_a_glance(chart, half):
    """Round steps are 1, 2 or 5: no longer than what makes ten of them, so eleven ticks are the most."""
    chart.set_range((-half, half), (-half, half))
    chart.resize(3000, 1700)
    chart.forget_background()
    assert all(4 <= len(made(chart)) <= 11 for made in (left_ticks, bottom_ticks))


def test_a_line_breaks_where_a_value_is_missing():
    x = np.array([0.0, 1, 2, 3, 4])
    parts = list(polylines(x, np.array([0.0, 1, np.nan, 3, 4])))
    assert [part.count() for part in parts] == [2, 2]


def test_the_image_lies_where_it_is_said_to_and_the_first_row_is_lowest(chart):
    chart.restyle(LIGHT)
    chart.show_pixels(np.array([[0xFF0000FF], [0xFFFF0000]], np.uint32), (0.0, -1.0, 1.0, 2.0))
    shown = chart.grab().toImage()
    colours = [shown.pixelColor(QPointF(*chart.to_pixels(0.5, y)).toPoint()).name() for y in (-0.5, 0.5)]
    assert colours == ["#0000ff", "#ff0000"]


def test_a_missing_value_has_an_index_of_its_own():
    assert as_indices(np.array([-9.0, 0.0, 1.0, 9.0, np.nan]), 0.0, 1.0).tolist() == [0, 0, 254, 254, EMPTY]


def test_names_at_one_place_do_not_touch_and_one_without_room_is_left_out(qapp):
    taken, rooms = [], []
    for name in ("EnP", "ExP", "H", "H′", "F′"):
        rooms.append(free_room(name, 100.0, 50.0, taken, 200.0))
        assert not any(rooms[-1] and rooms[-1].intersects(other) for other in taken)
        taken += filter(None, rooms[-1:])
    assert rooms[0] and rooms[1] and rooms[-1] is None
    assert free_room("EnP", 199.0, 50.0, [], 200.0).right() <= 200.0


@pytest.mark.parametrize("inner", [QRect(3, 4, 5, 6), QRect(0, 0, 20, 15), QRect(0, 3, 20, 2), QRect()])
def test_strips_and_what_they_lie_around_are_the_whole_and_no_pixel_twice(inner):
    outer = QRect(0, 0, 20, 15)
    count = np.zeros((15, 20), int)
    for room in (*strips(outer, inner), inner):
        count[room.top() : room.top() + room.height(), room.left() : room.left() + room.width()] += 1
    assert (count == 1).all()


def test_a_frame_painted_over_another_is_that_of_a_new_chart(qtbot, chart):
    """Every pixel is painted anew each time: nothing of an earlier picture, ground or curve shows through."""
    chart.restyle(LIGHT)
    curve, ground = chart.add_curve("chief", 2), 0xFF102030
    for rect in ((-1.0, -0.5, 2.0, 1.0), (-5.0, -5.0, 10.0, 10.0), (0.5, 0.2, 0.1, 0.1)):
        for chart.ground in (None, ground):
            chart.show_pixels(np.full((4, 4), 0xFFFF0000, np.uint32), rect)
            curve.set_data([-2, 3], [-1, 1])
            canvas = QImage(chart.size(), QImage.Format.Format_RGB32)
            canvas.fill(QColor("#00ff00"))
            chart.render(canvas)
            assert canvas == chart.grab().toImage().convertToFormat(QImage.Format.Format_RGB32)
            assert not (pixels_of(canvas) == 0xFF00FF00).any()


def pixels_of(image):
    return np.frombuffer(image.constBits(), np.uint32)


def test_a_polygon_of_no_points_is_empty():
    """As before the first picture of a set-up that has none."""
    from p2sf_explorer.charts.painting import polygon

    assert polygon(np.array([]), np.array([])).isEmpty()


def test_a_picture_runs_to_the_edges_under_its_axes(qapp):
    """Axes over it stand on dark bands, of which text keeps 7:1 even from the brightest yellow (WCAG 2.1)."""
    shown = HeatMap("x, µm", "y, µm")
    shown.resize(400, 300)
    shown.show_map(np.ones((8, 8)), (-4.0, -4.0, 8.0, 8.0), ColourScale("inferno", 0.0, 1.0, grounded=True))
    shown.chart.set_view((0.0, 0.0), 4.0)
    shown.grab()  # lays it out
    within = shown.chart.area
    shown.chart.bleed(True)
    assert shown.chart.area == shown.chart.rect().toRectF() and within.width() < shown.chart.area.width()
    picture = shown.chart.grab().toImage()
    veiled = picture.pixelColor(3, 3).name()
    assert contrast(shown.chart.axes_theme.text, veiled) >= 7
    shown.chart.bleed(False)
    assert shown.chart.area == within


@pytest.mark.parametrize("width", [1.0, 3.0, 5.0])
def test_a_line_of_any_width_has_its_points_in_its_middle(chart, width):
    chart.restyle(LIGHT)
    bare = painted_rows(chart)
    chart.add_curve("chief", width).set_data([-2.0, 3.0], [0.3, 0.3])
    ink = np.abs(painted_rows(chart) - bare)
    assert (np.arange(ink.size) + 0.5) @ ink / ink.sum() == pytest.approx(float(chart.to_pixels(0.0, 0.3)[1]), abs=0.6)


def painted_rows(chart) -> np.ndarray:
    """Return how bright the column is that stands over x = 1.3, downwards."""
    image = chart.grab().toImage()
    column = round(float(chart.to_pixels(1.3, 0.0)[0]))
    return np.array([image.pixelColor(column, row).lightnessF() for row in range(image.height())])
