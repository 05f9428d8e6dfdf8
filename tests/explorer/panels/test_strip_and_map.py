"""The through-focus strip and the field map: what fills in behind the slider, against the physics."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt

from p2sf.conventions import degrees_from_slope
from p2sf.disc.domain import HALF
from p2sf.raytrace.pencil import pencil
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.sampled import in_window, optics
from p2sf_explorer.compute.setup import paraxial_setup, with_lens
from p2sf_explorer.compute.views import field_map, through_focus
from p2sf_explorer.panels.field_map import FieldMapPanel
from p2sf_explorer.panels.through_focus import StripChart
from p2sf_explorer.state.state import change, new_state
from p2sf_explorer.state.what_if import UNTOUCHED
from p2sf_explorer.widgets.tiles import tile
from tests.support.windows.windows import settled

FIRST = new_state(method="seidel", theme="light")
PURE = change(FIRST, free_pupil=True)


@pytest.fixture
def strip(window, qtbot):
    """Return the strip's panel once it is filled."""
    window.store.update(tab="through_focus", f_number=8.0)
    panel = window.panels["through_focus"]
    filled(panel, qtbot)
    return panel


def filled(panel, qtbot):
    settled(panel, qtbot)
    assert panel.found[0] == panel.late.asked


def worked(question, module):
    told = []
    return module.answer(question, lambda: False, lambda share, found: told.append(share)), told


def test_the_brightest_picture_is_at_the_medial_focus(strip):
    asked, found = strip.found
    peaks = found.light.max((1, 2))
    shifts = np.array(asked.shifts_um)
    assert abs(shifts[peaks.argmax()] - found.best) <= (shifts[1] - shifts[0])
    c = paraxial_setup(asked.state).coefficients
    unit = float(c.wavelength_um) / float(c.na) ** 2
    # Best focus Wd = −(W40 + W20 + W22/2) (Mahajan 1991), Δz = 2λWd/NA².
    assert found.best == pytest.approx(-2 * unit * float(c.w40 + c.w20 + c.w22 / 2 + c.wd), abs=0.01)
    assert found.tangential - found.sagittal == pytest.approx(-2 * unit * float(c.w22))


def test_lines_stand_across_each_other_at_the_two_foci():
    """At the tangential focus the light is a line along x, at the sagittal one along y (Welford 1986, §8.4)."""
    state = change(FIRST, f_number=11.0, field_deg=14.0)
    first = live(state)
    c = paraxial_setup(state).own
    places = through_focus.seidel_foci(c)
    shapes = []
    for place in (places.tangential, places.sagittal):
        psf = in_window(change(optics(state), sensor_shift_um=1e3 * float(place)), (64, 1.0), True)
        x, y = psf.values.sum(0), psf.values.sum(1)
        shapes.append((x @ psf.x_um**2) / (y @ psf.y_um**2))
    assert first.method == "seidel" and shapes[0] > 1 > shapes[1]


def test_pictures_and_marks_stand_at_their_sensor_positions(strip):
    asked, found = strip.found
    assert [tile.x for tile in strip.chart.tiles] == pytest.approx(asked.shifts_um)
    notes = {words[2:]: x for x, _, words, _, _ in strip.chart.notes}
    assert notes == pytest.approx({"S": found.sagittal, "T": found.tangential, "best": found.best})


def test_dragging_the_sensor_moves_the_slider_and_leaves_the_strip(window, strip, qtbot):
    chart, asked = strip.chart, strip.late.asked
    chart.grab()
    start = QPointF(float(chart.to_pixels(0.0, 0.0)[0]), chart.area.bottom() - 6)
    goal = QPointF(float(chart.to_pixels(asked.shifts_um[3], 0.0)[0]), start.y())
    qtbot.mousePress(chart, Qt.MouseButton.LeftButton, pos=start.toPoint())
    qtbot.mouseMove(chart, goal.toPoint())
    assert window.live.quality == "preview"
    qtbot.mouseRelease(chart, Qt.MouseButton.LeftButton, pos=goal.toPoint())
    assert window.store.state.optics.sensor_shift_um == pytest.approx(asked.shifts_um[3], abs=2 * chart.per_pixel())
    assert strip.chart.sensor_um == window.store.state.optics.sensor_shift_um
    assert window.live.quality == "settled" and window.store.can_undo
    filled(strip, qtbot)
    assert strip.late.asked == asked, "the strip does not move with the sensor"


@pytest.mark.parametrize("changes", [{"free_pupil": True}, {"muted": ("wd",)}, {"solo": ("w40",)}])
def test_where_the_sensor_does_not_focus_there_is_a_sentence_and_no_strip(window, strip, qtbot, changes):
    """With Wd set aside every picture is the same wherever the sensor stands: foci would be marks of nothing."""
    window.store.update(**changes)
    overlay = strip.widget.overlay
    assert overlay.isVisible() and "moving the sensor does not focus" in overlay.text
    window.store.update(psf_scale="linear")
    assert overlay.isVisible()
    window.store.update(**UNTOUCHED)
    filled(strip, qtbot)
    assert not overlay.isVisible()
    assert len(strip.chart.tiles) == len(strip.late.asked.shifts_um)


def test_arrow_keys_move_the_sensor(window, strip, qtbot):
    strip.chart.setFocus()
    qtbot.keyClick(strip.chart, Qt.Key.Key_Left)
    assert window.store.state.optics.sensor_shift_um < 0


def test_defocus_alone_is_symmetric_about_focus():
    """Pure defocus: the picture at +Δz is that at −Δz (the kernel depends on Wd²)."""
    lens = change(with_lens(FIRST, "achromat_f6"), method="seidel", field_deg=0.0, muted=("w40",), f_number=12.0)
    question = through_focus.strip(live(lens)).question
    found, told = worked(question, through_focus)
    shifts = np.array(question.shifts_um)
    centre = float(through_focus.seidel_foci(paraxial_setup(question.state).coefficients).sagittal) * 1e3
    pair = [in_window(change(question.state, sensor_shift_um=centre + d), (32, 1.0), True).values for d in (60, -60)]
    assert pair[0] == pytest.approx(pair[1], abs=1e-6)  # the preview's float32
    assert shifts[0] < centre < shifts[-1] and told[-1] <= 1 and np.isfinite(found.light).all()


def test_the_map_is_the_psf_turned_towards_each_field(window, qtbot):
    window.store.update(tab="field_map", f_number=5.6)
    panel = window.panels["field_map"]
    filled(panel, qtbot)
    asked, found = panel.found
    middle = found[2, 3]
    assert middle == pytest.approx(middle.T, abs=1e-4), "round on the axis"
    top, bottom = found[0, 3], found[4, 3]
    assert bottom[1:, 1:] == pytest.approx(top[1:, 1:][::-1, ::-1], abs=1e-4), "turned by 180°"
    right = found[2, 6]
    own, inverted = field_map.picture_at(asked, asked.field_of(field_map.places()[2, 6]))
    assert not inverted and right[1:, 1:] == pytest.approx(own.T[1:, 1:], abs=1e-4), "+y points to the right"
    assert (found.max((2, 3)) > 0.5).all()


def test_an_upright_panel_has_an_upright_map_and_high_tiles(window, qtbot):
    """The room is used: a map of 7 rows and 5 columns, a strip in as many rows as make its pictures largest."""
    sides = []
    for upright in (False, True):
        asked = replace(field_map.field_map(window.live).question, upright=upright)
        rows, columns = asked.places.shape[:2]
        assert (rows, columns) == ((7, 5) if upright else (5, 7))
        corners = np.hypot(*asked.places[[0, 0, -1, -1], [0, -1, 0, -1]].T)
        assert corners == pytest.approx(np.ones(4)), "the corner is the edge of the field"
        panel = FieldMapPanel(window.store)
        qtbot.addWidget(panel.widget)
        panel.chart.resize(400, 560)
        panel._paint(asked, np.ones((rows, columns, 8, 8)))
        sides.append(panel.chart.side_px())
    assert sides[1] > 1.25 * sides[0]
    chart, tiles = StripChart(window.store), [tile(np.ones((8, 8)), 0.0, 0.5, "sqrt")] * 11
    qtbot.addWidget(chart)
    chart.resize(520, 600)
    chart.show_strip(tiles, np.linspace(-5.0, 5.0, 11))
    covered = chart.rows * chart.side_px()
    assert covered > 0.85 * chart.area.height()


def test_a_click_on_the_map_goes_to_that_field(window, qtbot):
    window.store.update(tab="field_map")
    panel = window.panels["field_map"]
    filled(panel, qtbot)
    panel.chart.grab()
    corner = panel.chart.tiles[-1]
    qtbot.mouseClick(panel.chart, Qt.MouseButton.LeftButton, pos=panel.chart.room(corner).center().toPoint())
    assert window.store.state.optics.field_deg == pytest.approx(14.0, abs=1e-3), "the corner is the field's edge"
    assert panel.late.asked == panel.found[0], "and the map stays as it is"


def test_a_map_given_up_before_its_first_picture_is_an_empty_one(window):
    panel = FieldMapPanel(window.store)
    panel._paint(field_map.field_map(window.live).question, np.full((*field_map.SHAPE, 8, 8), np.nan))
    assert not panel.chart.tiles


def test_arrow_keys_choose_a_picture_of_the_map_and_enter_goes_to_its_field(window, qtbot):
    window.store.update(tab="field_map", field_deg=0.0)
    chart = window.panels["field_map"].chart
    filled(window.panels["field_map"], qtbot)
    chart.setFocus()
    for _ in range(9):  # from the middle to the rim, and no farther
        qtbot.keyClick(chart, Qt.Key.Key_Right)
    assert chart.fields_deg[chart.choice.number] == pytest.approx(chart.fields_deg[20]), "the end of the middle row"
    assert window.store.state.optics.field_deg == 0.0, "choosing alone moves nothing"
    before = chart.grab().toImage()
    qtbot.keyClick(chart, Qt.Key.Key_Down)
    qtbot.keyClick(chart, Qt.Key.Key_Down)
    assert chart.grab().toImage() != before, "the frame is seen to move"
    qtbot.keyClick(chart, Qt.Key.Key_Return)
    assert window.store.state.optics.field_deg == pytest.approx(14.0, abs=1e-3), "the corner is the field's edge"


def test_coma_points_away_from_the_axis_at_every_place():
    question = field_map.field_map(live(change(FIRST, solo=("w31",), f_number=4.0))).question
    found, told = worked(question, field_map)
    where = field_map.places()
    axis = np.arange(question.window[0]) - question.window[0] // 2
    sides = []
    for at in ((0, 3), (2, 6), (4, 0), (0, 6)):
        light = found[at] / found[at].sum()
        centroid = np.array([light.sum(0) @ axis, light.sum(1) @ axis])
        sides.append(centroid @ where[at] / np.linalg.norm(where[at]) / np.linalg.norm(centroid))
    assert np.abs(sides) == pytest.approx(np.ones(4), abs=0.02), "along the field's direction"
    assert len({side > 0 for side in sides}) == 1 and told == sorted(told), "and all the same way"


MAPPED = [{"vanes": 2, "vane_width": 0.2, "vane_angle_deg": 30.0}, {"errors": (("tilt_y", 3, 5, 0.2),)}]


@pytest.mark.parametrize("changes", MAPPED, ids=["vanes", "tilted"])
@pytest.mark.parametrize("at", [(0, 3), (4, 3), (2, 6)], ids=["top", "bottom", "right"])
def test_a_place_of_a_map_without_symmetry_shows_its_own_field_as_it_lies_on_the_sensor(changes, at):
    """Vanes stay where they are while the field turns. Of fields along y the picture needs no turning at all."""
    state = change(FIRST, method="auto", f_number=5.6, **changes)
    question = field_map.field_map(live(state, "preview")).question
    found, _ = worked(question, field_map)
    field_x, field_y = question.field_of(field_map.places()[at])
    values = in_window(change(question.state, field_deg=field_y, field_x_deg=field_x), question.window, False).values
    sensor = field_map.rotate_picture(values, np.deg2rad(90.0)) if field_x else values
    assert found[at] == pytest.approx(sensor / values.max(), abs=1e-6)
    symmetric = replace(question, domain=HALF)
    assert np.abs(worked(symmetric, field_map)[0][2, 6] - found[2, 6]).max() > 1e-2, "and no other field's"


@pytest.mark.parametrize("key", ["through_focus", "field_map", "colour"])
def test_an_earlier_picture_is_marked_until_its_own_is_there(window, qtbot, key):
    window.store.update(tab=key, f_number=8.0)
    panel = window.panels[key]
    filled(panel, qtbot)
    words = panel.widget.readout.text()
    window.store.update(f_number=11.0)
    assert panel.widget.readout.text() == f"{words} · earlier picture"
    filled(panel, qtbot)
    assert "earlier" not in panel.widget.readout.text()


def test_the_top_of_the_map_is_the_field_that_lands_there():
    """A relay's entrance pupil lies beyond its object: fields of the other sign than a camera's land above the axis."""
    state = change(with_lens(FIRST, "relay"), method="seidel", solo=("w31",), depth_mm=96.0, focus_mm=96.0)
    first = live(state, "preview")
    question = replace(field_map.field_map(first).question, window=(24, first.airy_radius_um / 3))
    lands = {}
    for side in (1, -1):
        one = change(question.state, field_deg=side * float(degrees_from_slope(question.corner_slope)))
        values = in_window(one, question.window, True).values
        lands[float(paraxial_setup(one).coefficients.image_height) > 0] = values / values.max()
    values, inverted = field_map.picture_at(question, question.field_of(np.array([0.0, 1.0])))
    shown = field_map.rotate_picture(values, np.pi if inverted else 0.0)
    assert shown[1:, 1:] == pytest.approx(lands[True][1:, 1:], abs=1e-4)
    assert np.abs(shown - lands[False]).max() > 0.1, "coma tells the two apart"


@pytest.mark.parametrize(("lens", "field", "up"), [("", 5.0, 1), ("", -5.0, -1), ("relay", 0.2, -1), ("", 0.0, 0)])
def test_the_arrow_points_to_where_farther_fields_land(window, lens, field, up):
    state = with_lens(window.store.state, lens) if lens else window.store.state
    window.store.replace(change(state, field_deg=field))
    near, far = (
        float(paraxial_setup(change(state, field_deg=part * field)).coefficients.image_height) for part in (1, 1.1)
    )
    panel = window.panels["psf"]
    tip = panel.arrow.data()[1][1]
    assert np.sign(far - near) == up == (0 if np.isnan(tip) else np.sign(tip))
    assert ("inwards" in panel.map.chart.labels[1]) == (up < 0)


def test_hidden_strip_and_map_ask_nothing(window, strip, qtbot):
    window.open_panel("profiles")
    asked = strip.late.asked
    window.store.update(field_deg=4.0)
    assert strip.late.asked is asked and not strip.late.busy


@pytest.mark.parametrize(
    ("ask", "points"),
    [
        (field_map.field_map, ({"field_deg": 0.0}, {"field_deg": 14.0})),
        (through_focus.strip, ({"sensor_shift_um": 0.0}, {"sensor_shift_um": 300.0})),
    ],
    ids=["map", "strip"],
)
def test_what_auto_chose_for_one_point_does_not_make_the_pictures_of_all(ask, points):
    """Six coefficients do near the axis and where all is blurred, and miss elsewhere: `auto` changes its mind."""
    state = change(FIRST, method="auto", aim="paraxial", field_deg=2.5, f_number=5.6)
    answers = [live(change(state, **point)) for point in points]
    assert {answer.method for answer in answers} == {"seidel", "traced"}
    first, second = (ask(answer).question for answer in answers)
    assert first == second and not first.six


@pytest.mark.parametrize("lens", ["relay", "eye_navarro", "landscape"])
def test_other_lenses_have_a_strip_with_their_foci_inside(lens):
    state = change(with_lens(FIRST, lens), method="seidel")
    question = through_focus.strip(live(state, "preview")).question
    sagittal, tangential, best = through_focus.foci(question)
    assert question.shifts_um[0] <= min(sagittal, tangential, best)
    assert question.shifts_um[-1] >= max(sagittal, tangential, best)


def test_rays_of_a_misaligned_lens_are_thinnest_at_its_foci():
    """With all errors in the plane x = 0 the foci are where neighbours of the chief ray meet in y, and in x."""
    errors = (("tilt_x", 3, 4, 0.5), ("decentre_y", 7, 8, 0.3))
    state = change(FIRST, errors=errors, method="fitted", field_deg=8.0, f_number=22.0)
    question = through_focus.strip(live(state, "preview")).question
    sagittal, tangential, _ = through_focus.foci(question)
    straight = through_focus.foci(through_focus.strip(live(change(state, errors=()), "preview")).question)
    assert abs(tangential - straight[1]) > 10, "µm: the errors are felt"
    for axis, place in enumerate((sagittal, tangential)):
        widths = []
        for shift in (place - 20, place, place + 20):
            setup = paraxial_setup(change(question.state, sensor_shift_um=shift))
            near = np.array([0.02, -0.02]), np.zeros(2)
            rays = pencil(setup.lens, setup.source, near[axis], near[1 - axis])
            widths.append(abs(np.diff((rays.dx, rays.dy)[axis]))[0])
        assert widths[1] < 0.02 * min(widths[0], widths[2])


def test_what_is_read_in_a_tile_is_what_is_painted_there(strip, qtbot):
    """The brightest sample of a picture is read where the brightest pixel of its tile stands."""
    chart = strip.chart
    chart.grab()
    number = len(chart.tiles) // 2
    tile, room = chart.tiles[number], chart.room(chart.tiles[number])
    row, column = np.unravel_index(int(tile.indices.argmax()), tile.indices.shape)
    count = len(tile.indices)
    at = QPointF(room.left() + (column + 0.5) / count * room.width(), room.top() + (row + 0.5) / count * room.height())
    read = chart.read(*chart.from_pixels(at)).values[0].number
    assert read == pytest.approx(float(chart.grids[number][3].max()))
