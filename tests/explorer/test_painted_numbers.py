"""Numbers that people read off the window, from what is painted and written, against laws of their own."""

import re
from dataclasses import replace
from itertools import product
from math import inf

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QImage, QKeyEvent

from p2sf.lens.lens import indices
from p2sf.lensfile.library import find_lens
from p2sf_explorer.charts.colour_scale import ColourScale
from p2sf_explorer.charts.crosshair import box_place
from p2sf_explorer.charts.plots import lookup
from p2sf_explorer.charts.surface_plot import DARKEST, Viewpoint, light_up, slice_map
from p2sf_explorer.charts.theme import tokens
from p2sf_explorer.compute.finer import LARGEST, smooth
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.matrix.points import depths_around
from p2sf_explorer.compute.quantities import QUANTITIES
from p2sf_explorer.compute.setup import paraxial_setup, ranges, with_lens
from p2sf_explorer.compute.views import field_map, through_focus
from p2sf_explorer.compute.views.photos import frame_box
from p2sf_explorer.panels.field_map import NODE_COLOURS, NODE_PX, FieldMapPanel
from p2sf_explorer.panels.image.split_view import SplitView, close_up
from p2sf_explorer.playback.sweep import sweep
from p2sf_explorer.scene3d.renderer import direction
from p2sf_explorer.scene3d.scene import scene
from p2sf_explorer.state.camera import SceneCamera
from p2sf_explorer.state.scales import written_r_squared
from p2sf_explorer.state.state import change, new_state
from p2sf_explorer.widgets.scrub import claimed
from p2sf_explorer.widgets.slider import ARROWS
from p2sf_explorer.widgets.tiles import tile

FIRST = new_state(method="seidel", theme="light")


def painted(widget) -> np.ndarray:
    """Return how bright every pixel of a widget is, 0 to 255, rows downwards."""
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : image.width()].astype(float)


@pytest.mark.parametrize(("lens", "f_number"), [("double_gauss_28", 8.0), ("achromat_f6", 11.0)])
def test_the_band_of_the_chromatic_shift_is_the_depth_of_focus(window, lens, f_number):
    """±λ/(2·NA²) = ±2λN² for small apertures; 0.5 % is what sin and tan differ by at f/8."""
    window.store.replace(change(with_lens(FIRST, lens), f_number=f_number, tab="chromatic", field_deg=0.0))
    panel, half = window.panels["chromatic"], 2 * 0.5875618 * f_number**2
    below, above = (curve.data()[1] for curve in panel.band)
    assert list(above) == pytest.approx([half] * 2, rel=5e-3) and list(below) == list(-np.asarray(above))
    said = float(re.search(r"±([\d.]+) µm", panel.widget.readout.text())[1])
    assert said == pytest.approx(half, rel=1e-2)  # three digits


def test_coma_on_the_painted_map_points_away_from_the_middle_as_its_sign_says(window, qtbot):
    """Rays land at −λ∇W/NA from the chief ray: those of ρ = 1 on the mean at −2λW31/NA along the field.

    A W31 < 0 (Welford 1986, §7.4) has its flare on the far side from the middle of the map, which is the sensor seen
    with +y up and +x to the right.
    """
    state = change(FIRST, solo=("w31",), f_number=2.0)
    asked = replace(field_map.field_map(live(state, "preview")).question, window=(64, 0.75))
    assert float(paraxial_setup(change(asked.state, field_deg=10.0)).coefficients.w31) < -3
    panel = FieldMapPanel(window.store)
    qtbot.addWidget(panel.widget)
    panel.restyle(tokens("light", "grey"))
    panel.widget.resize(1000, 700)
    panel.widget.grab()  # lays it out
    panel._scale = "linear"
    panel._paint(asked, field_map.answer(asked, lambda: False, lambda share, found: None))
    chart, light = panel.chart, painted(panel.chart)
    for x, y in ((0.0, 1.0), (0.0, -1.0), (1.0, 0.0), (-1.0, 0.0)):
        room = next(room for room in map(chart.room, chart.tiles) if is_towards(chart, room.center(), x, -y))
        part = light[int(room.top()) + 4 : int(room.bottom()) - 4, int(room.left()) + 4 : int(room.right()) - 4]
        part = np.maximum(part - part.max() / 10, 0)
        rows, columns = part.sum(1) / part.sum(), part.sum(0) / part.sum()
        assert third_moment(columns) * x - third_moment(rows) * y > 0.3


def is_towards(chart, point, x: float, y: float) -> bool:
    """Return whether a point of the widget is right, left, below or above the middle of its area, at the last tile."""
    away = point - chart.area.center()
    along, across = away.x() * x + away.y() * y, away.x() * y + away.y() * x
    half = chart.area.width() / 2 if x else chart.area.height() / 2
    return abs(across) < 2 and along > 0.5 * half


def third_moment(light: np.ndarray) -> float:
    """Return the skewness of light along an axis: positive where it trails off towards larger places."""
    at = np.arange(light.size) - light @ np.arange(light.size)
    return (light @ at**3) / (light @ at**2) ** 1.5


@pytest.mark.parametrize(("lens", "f_number"), [("landscape", 8.0), ("double_gauss_28", 2.8)])
def test_the_strip_reaches_the_focus_that_balances_spherical_aberration(lens, f_number):
    """Wd = −W40 at the paraxial focus: Δz = −2λW40/NA² (Mahajan 1991, §8.3)."""
    state = change(with_lens(FIRST, lens), field_deg=0.0, f_number=f_number)
    strip, c = through_focus.strip(live(state, "preview")).question, paraxial_setup(state).coefficients
    depth = float(c.wavelength_um) / float(c.na) ** 2
    balanced = -2 * depth * float(c.w40 + c.w20 + c.wd)
    assert abs(float(c.w40)) > 1 and strip.shifts_um[0] <= balanced - depth < balanced + depth <= strip.shifts_um[-1]


VALUES = np.array([1.0, 0.1, 1e-2, 1e-3, 1e-4])


@pytest.mark.parametrize(
    ("scale", "bright"),
    [
        ("linear", VALUES),
        ("sqrt", np.sqrt(VALUES)),
        ("log", 1 + np.log10(VALUES) / 5),
        ("log8", 1 + np.log10(VALUES) / 8),
    ],
)
def test_light_has_the_colour_that_stands_beside_its_number_on_the_bar(window, scale, bright):
    """The picture's colours are the bar's at the height where the bar names the value, on every scale."""
    heat = window.panels["psf"].map
    window.store.update(psf_scale=scale)
    shown = ColourScale("CET-L4", 0.0, 1.0, stretch=scale)
    heat.show_map(VALUES[None, :].repeat(5, 0), (-2.5, -2.5, 5.0, 5.0), shown)
    assert heat.indices[0] == pytest.approx(254 * np.maximum(bright, 0), abs=1)
    for part, text in shown.labels():
        power = re.fullmatch(r"10⁻([⁰¹²³⁴-⁹])", text)
        value = 10.0 ** -"⁰¹²³⁴⁵⁶⁷⁸⁹".index(power[1]) if power else float(text)
        assert float(shown.parts(np.array(value))) == pytest.approx(part, abs=0.02)


@pytest.mark.parametrize("stretch", ["linear", "sqrt"])
def test_what_is_more_than_zero_has_the_upper_colours_of_a_signed_bar(window, stretch):
    """A − B: as far above the middle as −(A − B) is below, at the height where the bar writes the number."""
    heat, values = window.panels["psf"].map, np.array([-0.4, -0.1, 0.0, 0.1, 0.4])
    shown = ColourScale("CET-D1A", -0.4, 0.4, stretch=stretch)
    heat.show_map(values[None, :].repeat(5, 0), (-2.5, -2.5, 5.0, 5.0), shown)
    share = values / 0.4 if stretch == "linear" else np.sign(values) * np.sqrt(np.abs(values) / 0.4)
    assert heat.indices[0] == pytest.approx(127 * (1 + share), abs=1)
    blue, red = (lookup("CET-D1A")[at] & 0xFF > lookup("CET-D1A")[at] >> 16 & 0xFF for at in (20, 234))
    assert blue and not red, "less is blue and more is red"
    for part, text in shown.labels():
        value = float(text.replace("−", "-"))
        assert float(shown.parts(np.array(value))) == pytest.approx(part, abs=0.01)


def focal_points(name: str) -> tuple[float, float]:
    """Return the focal length and how far the front focus lies before the first vertex, mm, by 2 × 2 matrices."""
    lens = find_lens(name)
    index, system = indices(lens, lens.reference_wavelength_um), np.eye(2)
    for number, surface in enumerate(lens.surfaces):
        bent = np.array([[1, 0], [-(index[number + 1] - index[number]) * surface.vertex_curvature, 1]])
        gap = lens.gaps[number] if number < len(lens.surfaces) - 1 else 0.0
        system = np.array([[1, gap / index[number + 1]], [0, 1]]) @ bent @ system
    return -1 / float(system[1, 0]), -float(system[1, 1] / system[1, 0])


@pytest.mark.parametrize("name", ["double_gauss_28", "achromat_f6", "petzval", "cooke_triplet"])
def test_the_sliders_of_distance_begin_a_fifth_of_the_focal_length_before_the_front_focus(window, name):
    """Or half a focal length from the lens, whichever is farther, and up to a third more, to be a round number."""
    focal, front = focal_points(name)
    least = max(front + focal / 5, focal / 2)
    window.store.replace(with_lens(FIRST, name))
    for key in ("depth_mm", "focus_mm"):
        row = window.controls.rows[key]
        row.slider.setValue(0)
        found = getattr(window.store.state.optics, key)
        assert least * (1 - 1e-9) <= found <= least * 4 / 3 * (1 + 1e-9)
        window.store.update(**{key: inf if key == "depth_mm" else None})


@pytest.mark.parametrize("errors", [(), (("tilt_x", 1, 2, 0.05),)])
def test_the_slider_of_the_field_begins_on_the_axis_unless_both_sides_differ(window, errors):
    window.store.replace(change(with_lens(FIRST, "cooke_triplet"), errors=errors))
    row = window.controls.rows["field_deg"]
    row.slider.setValue(row.slider.maximum())
    farthest = window.store.state.optics.field_deg
    row.slider.setValue(0)
    assert farthest > 5 and window.store.state.optics.field_deg == (-farthest if errors else 0.0)


@pytest.mark.parametrize("key", ["field_deg", "f_number", "depth_mm", "added_wd"])
def test_a_sweep_turns_without_a_jump(key):
    """Over three ways it never moves more in a frame than the way there does, and turns at both ends."""
    way = sweep(new_state(playback_slider=key, playback_seconds=2.0))
    moments = np.linspace(0, 6, 601)
    parts = np.array([way.part(way.at(float(moment))) for moment in moments])
    assert np.abs(np.diff(parts)) == pytest.approx(np.full(600, 0.005), abs=1e-9)
    assert parts[[0, 200, 400, 600]] == pytest.approx([0, 1, 0, 1])


@pytest.mark.parametrize(("name", "depth_mm"), [*product(["double_gauss_28"], [inf, 5000.0, 60.0]), ("maksutov", inf)])
def test_rays_in_space_start_at_a_near_object_and_before_the_lens_for_a_far_one(name, depth_mm):
    """All from one point of a near object; from 45 % of the drawing's length before the lens where that is nearer.

    The rim of the telescope's concave front stands before its vertex, and there the drawing begins.
    """
    gauss = {"field_deg": 5.0, "f_number": 8.0, "focus_mm": 2000.0} if name == "double_gauss_28" else {"field_deg": 0.5}
    answer = live(change(with_lens(FIRST, name), depth_mm=depth_mm, **gauss), "preview")
    shown, drawn = scene(answer).found, answer.layout.drawing
    starts, next_ = shown.rays[:, 0], shown.rays[:, 1]
    before = min(depth_mm, 0.45 * (drawn.right - drawn.left) - drawn.left)
    assert starts[:, 2] == pytest.approx(np.full(len(starts), -before)) and before > 0
    ways = (next_ - starts) / (next_ - starts)[:, 2:]
    if depth_mm == inf:
        assert ways[:, 1] == pytest.approx(np.full(len(ways), np.tan(np.deg2rad(gauss["field_deg"]))))
    else:  # back to the object
        assert np.ptp((starts + ways * (before - depth_mm))[:, :2], axis=0) == pytest.approx([0, 0], abs=1e-6)


@pytest.mark.parametrize("key", ["f_number", "depth_mm", "field_deg", "wavelength_nm", "blades"])
def test_a_scrubbed_number_goes_as_far_as_its_handle_would(key):
    quantity = next(quantity for quantity in QUANTITIES if quantity.key == key)
    scale = quantity.scale(ranges(find_lens("double_gauss_28")))
    for start, by in ((0.2, 0.3), (0.9, -0.5), (0.0, 1.0 - 1e-9), (0.5, 0.0)):
        assert scale.moved(scale.value(start), by) == pytest.approx(scale.value(start + by), rel=1e-6)


@pytest.mark.parametrize(
    ("turn", "tilt", "seen_from"),
    [
        (0, 0, (-1, 0, 0)),
        (90, 0, (0, 0, -1)),
        (180, 0, (1, 0, 0)),
        (37, 90, (0, 1, 0)),
        (0, -30, (-(0.75**0.5), -0.5, 0)),
    ],
)
def test_the_camera_of_the_space_stands_where_its_angles_say(turn, tilt, seen_from):
    assert direction(SceneCamera(turn=turn, tilt=tilt)) == pytest.approx(seen_from, abs=1e-12)


@pytest.mark.parametrize("place", [(60.0, 80.0), (0.0, 0.0), (119.0, 159.0), (60.0, 0.0)])
def test_a_detail_has_its_place_in_the_middle_unless_the_picture_ends_there(place):
    shape, room = (120, 160), QRectF(0, 0, 300, 200)
    part = close_up(place, shape, room)
    assert part.width() / part.height() == pytest.approx(1.5)
    for middle, low, size, most in (
        (place[0] + 0.5, part.top(), part.height(), shape[0]),
        (place[1] + 0.5, part.left(), part.width(), shape[1]),
    ):
        assert low == pytest.approx(min(max(middle, size / 2), most - size / 2) - size / 2)


@pytest.mark.parametrize("key", [Qt.Key.Key_Escape, Qt.Key.Key_A, Qt.Key.Key_Left])
@pytest.mark.parametrize("alt", [False, True])
@pytest.mark.parametrize("moving", [False, True])
@pytest.mark.parametrize("fine", [False, True])
def test_a_moving_value_keeps_only_escape_and_fine_arrows_from_the_window(key, alt, moving, fine):
    modifier = Qt.KeyboardModifier.AltModifier if alt else Qt.KeyboardModifier.NoModifier
    event = QKeyEvent(QEvent.Type.ShortcutOverride, key, modifier)
    arrow = key == Qt.Key.Key_Left
    assert claimed(event, ARROWS, moving, fine) == ((key == Qt.Key.Key_Escape and moving) or (arrow and alt and fine))


def test_a_surface_is_never_brighter_than_its_colour_and_never_black():
    """A face turned to the light has all of it, and a steep one away from it the least."""
    grid = slice_map(np.ones((33, 33), bool).tobytes(), 33, Viewpoint(30.0, 40.0, 48))
    height = np.random.default_rng(2).normal(0, 3, grid.depth.shape)
    light = light_up(height, grid)[~grid.lines]
    assert light.min() == DARKEST and light.max() == 1.0


def test_nodes_of_the_map_are_an_upright_and_a_diagonal_cross_about_their_places(window, qtbot):
    asked = replace(field_map.field_map(live(FIRST, "preview")).question, window=(16, 5.0))
    places = {"coma": (-0.35, 0.25), "astigmatism": (0.35, -0.25)}  # between the tiles of pictures that are dark
    asked = replace(asked, nodes=tuple((name, *place) for name, place in places.items()))
    panel = FieldMapPanel(window.store)
    qtbot.addWidget(panel.widget)
    panel.widget.resize(1000, 700)
    panel.widget.grab()  # lays it out
    panel._paint(asked, np.zeros((*field_map.SHAPE, 16, 16)))
    picture, half = panel.chart.grab().toImage(), panel.chart.theme.px(NODE_PX)
    for name, place in places.items():
        colour = QColor(getattr(panel.chart.theme, NODE_COLOURS[name])).name()
        x, y = (round(float(value)) for value in panel.chart.to_pixels(*place))
        ends = {  # whether the two kinds of cross have an end there
            **{(dx, dy): name == "coma" for dx in (-1, 1) for dy in (-1, 1)},
            **{(dx, dy): name == "astigmatism" for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1))},
        }
        for (dx, dy), there in ends.items():
            at = x + dx * (half - 1), y + dy * (half - 1)
            near = {picture.pixelColor(at[0] + i, at[1] + j).name() for i in (-1, 0, 1) for j in (-1, 0, 1)}
            assert (colour in near) == there


@pytest.mark.parametrize(
    ("value", "text"),
    [(1 - 1e-7, "> 0.9999"), (0.99994, "> 0.9999"), (0.9986, "0.9986"), (0.954, "0.954"), (-0.25, "−0.250")],
)
def test_an_r_squared_is_never_rounded_to_one(value, text):
    assert written_r_squared(value) == text


@pytest.mark.parametrize("own", [(300, 1000), (900, 700)])
def test_the_frame_cut_from_a_photo_is_its_middle_in_the_proportions_asked(own):
    top, left, tall, wide = frame_box(own, (200, 300))
    assert wide / tall == pytest.approx(1.5) and max(tall / own[0], wide / own[1]) == pytest.approx(1.0)
    assert (2 * top + tall, 2 * left + wide) == pytest.approx(own)


@pytest.mark.parametrize("size", [(900, 300), (300, 900), (500, 500)])
def test_two_pictures_beside_each_other_fill_the_middle_of_their_room(qtbot, size):
    view = SplitView()
    qtbot.addWidget(view)
    view.resize(*size)
    view.after = np.zeros((60, 90), np.uint32)
    one, other = view.halves()
    both = one.united(other)
    assert both.center().toTuple() == pytest.approx((size[0] / 2, size[1] / 2))
    assert one.size() == other.size() and not one.intersects(other)
    assert max(both.width() / size[0], both.height() / size[1]) == pytest.approx(1.0)


ROOM = QRectF(0, 0, 400, 300)


@pytest.mark.parametrize("mark", [(200, 150), (5, 5), (395, 295), (5, 295), (395, 5)])
def test_the_box_of_a_reading_stands_beside_its_mark_within_the_chart(mark):
    """At its own height where the chart has room for that, at the right if it can."""
    box = box_place([QPointF(*mark)], QSizeF(120, 60), ROOM, 10.0)
    assert ROOM.contains(box) and not box.contains(QPointF(*mark))
    assert box.top() == min(max(mark[1] - 40, 0), 240)
    assert box.left() == (mark[0] + 10 if mark[0] + 130 <= 400 else mark[0] - 130)


def test_depths_around_one_stand_a_wave_of_defocus_or_a_little_more_apart():
    """1/depth in steps of one wave, 2λ/(D/2)² for the diameter D of the entrance pupil, up to the next of 1, 2, 5."""
    answer = live(change(FIRST, depth_mm=5000.0, focus_mm=5000.0, f_number=8.0), "preview")
    steps = np.abs(np.diff([1 / depth for depth in depths_around(answer, 5)]))
    wave = 2 * 0.5875618e-3 / (focal_points("double_gauss_28")[0] / 16) ** 2
    assert steps == pytest.approx(np.full(4, steps[0]), rel=0.02) and wave * 0.95 <= steps[0] <= 2.6 * wave


def test_a_small_picture_is_smoothed_to_a_size_that_is_painted_at_once_and_is_none_where_light_is_unknown():
    assert smooth(np.ones((16, 16))).shape[-1] > 16 and smooth(np.ones((LARGEST, LARGEST))).shape[-1] == LARGEST
    assert tile(np.ones((16, 16)), 0.0, 0.0, "linear") is not None
    assert tile(np.where(np.eye(16), np.nan, 1.0), 0.0, 0.0, "linear") is None
