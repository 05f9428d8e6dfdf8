"""The layout under a hand: source, sensor, stop and glass stay under the pointer, undo as one step, Escape gives up."""

from dataclasses import replace
from math import inf, isinf

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPixmap, QPolygonF
from PySide6.QtWidgets import QApplication

from p2sf.glass.media import MIRROR
from p2sf.lens.lens import Surface, with_sensor
from p2sf.lens.misalignment import folding
from p2sf.lens.placement import Placement
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.paraxial.bending import shape_factor, thin_power
from p2sf.paraxial.pupils import f_number
from p2sf.paraxial.seidel import coefficients
from p2sf_explorer.charts.theme import DARK
from p2sf_explorer.compute.glass_outlines import vertices
from p2sf_explorer.compute.layout import layout
from p2sf_explorer.compute.setup import load, paraxial_setup, prescription, ranges, with_lens
from p2sf_explorer.panels.layout import source_point
from p2sf_explorer.panels.layout.grips import drag, glass_runs, group_of, sensor_grip, stop_grips, surface_grips
from p2sf_explorer.panels.layout.object_space import object_space
from p2sf_explorer.panels.layout.panel import LayoutPanel, paint_mirror
from p2sf_explorer.panels.layout.source_point import space_of
from p2sf_explorer.state.state import change
from p2sf_explorer.store.store import Store
from p2sf_explorer.window.no_answer import draw_setup
from tests.explorer.conftest import FIRST
from tests.support.lenses.mirrors import mangin
from tests.support.tiers import in_tiers

LENSES = ("double_gauss_28", "cooke_triplet", "reverse_telephoto", "eye_navarro", "relay", "plano_convex")
FEW_DRAGS = ("double_gauss_28", 50), ("relay", 50)
NONE, ALT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.AltModifier
PRESS, MOVE, RELEASE = QEvent.Type.MouseButtonPress, QEvent.Type.MouseMove, QEvent.Type.MouseButtonRelease


@pytest.fixture
def chart(window):
    made = window.panels["layout"].chart
    yield made
    window.store.select(None)


def send(chart, kind, point, modifiers=NONE):
    left, none = Qt.MouseButton.LeftButton, Qt.MouseButton.NoButton
    at = QPointF(point)
    held = none if kind == RELEASE else left
    button = none if kind == MOVE else left
    QApplication.sendEvent(chart, QMouseEvent(kind, at, chart.mapToGlobal(at), button, held, modifiers))


def pull(chart, start, end, modifiers=NONE, steps=3, release=True):
    """Drag with the mouse from one pixel to another."""
    send(chart, PRESS, start, modifiers)
    for k in range(1, steps + 1):
        send(chart, MOVE, start + (end - start) * (k / steps), modifiers)
    if release:
        send(chart, RELEASE, end, modifiers)


def apart(one, two):
    return float(np.hypot(one.x() - two.x(), one.y() - two.y()))


def targets(chart, chance):
    """Yield random pixels where a source can be: from the glass to infinity, as high as its fields go."""
    space = space_of(chart, chart.live)
    right = space.origin + space.nearest_z * space.scale
    while True:
        x = chance.choice([space.end, chance.uniform(space.end, space.broken), chance.uniform(space.end, right - 4)])
        depth = space.depth(x)
        highest = space.place(depth, space.widest)[1]
        lowest = space.place(depth, -space.widest)[1]
        yield QPointF(x, chance.uniform(*sorted((lowest, highest))))


@pytest.fixture
def alone(qtbot):
    """Return a function that makes the layout of a lens in a window of its own: a drag then computes no PSF."""

    def make(name):
        store = Store(with_lens(FIRST, name))
        panel = LayoutPanel(store)
        store.changed.connect(lambda state: panel.show(draw_setup(state)))
        qtbot.addWidget(panel.widget)
        panel.widget.resize(960, 190)
        panel.widget.show()
        panel.show(draw_setup(store.state))
        return store, panel

    return make


@pytest.mark.parametrize(("name", "drags"), in_tiers([*FEW_DRAGS, *((name, 200) for name in LENSES)], FEW_DRAGS))
def test_the_dragged_source_stays_under_the_pointer(alone, name, drags):
    """Within 2 px at every move of every drag, infinity included; fractions of a pixel are all that is lost."""
    store, panel = alone(name)
    chart = panel.chart
    chance, seen = np.random.default_rng(7), []
    found = targets(chart, chance)
    for _, target in zip(range(drags), found, strict=False):
        start = chart.handle.pixel(chart.live)
        send(chart, PRESS, start)
        for part in (0.4, 1.0):
            point = start + (target - start) * part
            send(chart, MOVE, point)
            assert apart(chart.handle.pixel(chart.live), point) < 2, store.state.optics
        before = chart.ranges()
        send(chart, RELEASE, target)
        assert chart.ranges() == before, "the scale is the same with and without a hand"
        assert apart(chart.handle.pixel(chart.live), target) < 2
        seen.append(store.state.optics.depth_mm)
    assert sum(map(isinf, seen)) > drags / 10 and len({depth < 1e3 for depth in seen}) == 2


def test_a_drag_from_infinity_to_near_and_back_is_one_step_and_ends_at_infinity(window, chart):
    first, start = window.store.state, chart.handle.pixel(chart.live)
    space = space_of(chart, chart.live)
    near = QPointF(space.origin - 90, start.y())
    send(chart, PRESS, start)
    depths = []
    for part in (*np.linspace(0, 1, 12), *np.linspace(1, 0, 12)):
        send(chart, MOVE, start + (near - start) * part)
        depths.append(window.store.state.optics.depth_mm)
    send(chart, RELEASE, start)
    assert depths[0] == depths[-1] == inf and min(depths) < 300
    assert depths[:12] == sorted(depths[:12], reverse=True) and depths[12:] == sorted(depths[12:])
    window.store.undo()
    assert window.store.state == first


def test_escape_gives_a_drag_up(window, chart, qtbot):
    first, can_undo, start = window.store.state, window.store.can_undo, chart.handle.pixel(chart.live)
    pull(chart, start, start + QPointF(60, 5), release=False)
    assert window.store.state != first
    qtbot.keyClick(chart, Qt.Key.Key_Escape)
    assert window.store.state == first and window.store.can_undo == can_undo
    send(chart, MOVE, start + QPointF(80, 0))
    assert window.store.state == first
    send(chart, RELEASE, start)


def test_near_the_lens_the_ring_is_the_source_to_scale(window, chart):
    window.store.update(depth_mm=60.0, field_deg=4.0)
    z, y = chart.live.layout.source
    assert apart(chart.handle.pixel(chart.live), QPointF(*map(float, chart.to_pixels(z, y)))) < 1e-6


def test_places_and_sources_invert_one_another():
    space = object_space((500.0, 90.0, 1.3), (960.0, 180.0), (-2.0, 30.0), 57.0, 1000.0, 20.0)
    for depth in (3.0, 80.0, 400.0, 1000.0, 2e4, inf):
        for slope in (-0.3, 0.0, 0.02, 0.35):
            found, field = space.source(*space.place(depth, slope))
            assert found == pytest.approx(depth, rel=1e-9)
            assert np.tan(np.radians(field)) == pytest.approx(slope, abs=1e-9)


def grip_of(chart, window, kind, number=0):
    live = chart.live
    every = (*stop_grips(live.setup, live.layout), sensor_grip(live.layout))
    every += surface_grips(live.setup.lens, window.store.selection)
    return next(grip for grip in every if grip.kind == kind and (not number or grip.surfaces == (number, number)))


def hold(chart, grip):
    """Return the pixel at which a grip is held: the stop's bar beyond its rim."""
    at = chart.drag.pixel(grip)
    return at - QPointF(0, 9) if grip.kind == "stop" else at


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "by"), [("sensor", (14, 0)), ("rim", (0, 4)), ("stop", (-6, 0)), ("edge", (-4, 0)), ("vertex", (6, 0))]
)
def test_what_is_held_stays_under_the_pointer_and_is_one_step(window, chart, kind, by):
    window.store.select((3, 5))
    first, grip, by = window.store.state, grip_of(chart, window, kind), QPointF(*by)
    at = hold(chart, grip)
    pull(chart, at, at + by, release=False)
    moved = grip_of(chart, window, kind)
    assert apart(hold(chart, moved), at + by) < 1.5, "a stated rim has no more than six digits"
    assert window.live.quality == "preview"
    send(chart, RELEASE, at + by)
    assert window.live.quality == "settled" and window.store.state != first
    window.store.undo()
    assert window.store.state == first


def test_alt_moves_a_tenth(window, chart):
    at = hold(chart, grip_of(chart, window, "sensor"))
    pull(chart, at, at + QPointF(40, 0), ALT)
    assert window.store.state.optics.sensor_shift_um == pytest.approx(4000 * chart.per_pixel(), rel=1e-9)


def click(chart, point):
    send(chart, PRESS, point)
    send(chart, RELEASE, point)


def middle(chart, number):
    """Return a pixel within the glass behind a surface."""
    outline = next(o for o in chart.live.layout.drawing.outlines if o.surfaces[0] == number)
    z = vertices(chart.live.setup.lens)
    return QPointF(*map(float, chart.to_pixels((z[number - 1] + z[number]) / 2, 0.5 * outline.y.max())))


def test_clicks_on_glass_select_its_element_its_group_and_nothing(window, chart):
    state, point = window.store.state, middle(chart, 3)
    for expected in ((3, 5), (1, 5), None):
        click(chart, point)
        assert window.store.selection == expected
    assert window.store.state is state, "no step of undo"


def test_a_selected_element_is_bent_at_constant_power_under_the_hand(window, chart):
    before, point = load("double_gauss_28"), middle(chart, 1)
    click(chart, point)
    edge = chart.drag.pixel(grip_of(chart, window, "edge", 1))
    pull(chart, point, point + QPointF(8, 0), release=False)
    assert apart(chart.drag.pixel(grip_of(chart, window, "edge", 1)), edge + QPointF(8, 0)) < 1.5
    send(chart, RELEASE, point + QPointF(8, 0))
    after = prescription(window.store.state)
    assert shape_factor(after, 1, 2) != pytest.approx(shape_factor(before, 1, 2), rel=0.05)
    assert float(thin_power(after, 1, 2)) == pytest.approx(float(thin_power(before, 1, 2)), rel=1e-12)


def test_glass_is_decentred_up_and_down_under_the_hand(window, chart):
    first, point = window.store.state, middle(chart, 7)
    click(chart, point)
    outline = next(o for o in chart.live.layout.drawing.outlines if o.surfaces[0] == 7)
    pull(chart, point, point + QPointF(1, -10), release=False)
    by = 10 * chart.per_pixel()
    ((kind, first_surface, last, amount),) = window.store.state.optics.errors
    assert (kind, first_surface, last) == ("decentre_y", 7, 9) and amount == pytest.approx(by, abs=5e-4)
    assert window.live.quality == "preview" and window.live.setup.lens.misaligned
    moved = next(o for o in chart.live.layout.drawing.outlines if o.surfaces[0] == 7)
    assert moved.y == pytest.approx(outline.y + by, abs=1e-3), "mm: what is drawn follows the hand"
    send(chart, RELEASE, point + QPointF(1, -10))
    window.store.undo()
    assert window.store.state == first


def test_where_decentres_are_enlarged_the_hand_moves_the_enlarged_glass(window, chart):
    window.store.update(exaggerated=10, errors=(("decentre_y", 7, 9, 0.1),))
    point = middle(chart, 7)
    click(chart, point)
    outline = next(o for o in chart.live.layout.drawing.outlines if o.surfaces[0] == 7)
    pull(chart, point, point + QPointF(0, -10), release=False)
    by = 10 * chart.per_pixel()
    assert window.store.state.optics.errors[0][3] == pytest.approx(0.1 + by / 10, abs=5e-4)
    moved = next(o for o in chart.live.layout.drawing.outlines if o.surfaces[0] == 7)
    assert moved.y == pytest.approx(outline.y + by, abs=6e-3)
    send(chart, RELEASE, point + QPointF(0, -10))


OFF = (("tilt_x", 3, 5, 1.0), ("decentre_y", 3, 5, 0.5), ("decentre_y", 7, 11, -0.8))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "by"), [("sensor", (14, 0)), ("rim", (0, 4)), ("stop", (-6, 0)), ("edge", (-4, 0)), ("vertex", (6, 0))]
)
def test_parts_that_stand_askew_are_held_where_they_are_drawn(window, chart, kind, by):
    """A tilt of 1° turns the hand's way by as much: 2 % of the pixels."""
    window.store.update(errors=OFF, exaggerated=3)
    window.store.select((3, 5))
    first, by = window.store.state, QPointF(*by)

    def held():
        return next(grip for grip in chart.drag.grips(chart.live) if grip.kind == kind)

    at = hold(chart, held())
    assert chart.drag.find(chart.live, at).kind == kind
    pull(chart, at, at + by, release=False)
    assert apart(hold(chart, held()), at + by) < 1.5
    send(chart, RELEASE, at + by)
    assert window.store.state.optics.errors == OFF
    window.store.undo()
    assert window.store.state == first


def test_an_edge_that_stands_askew_lies_on_its_outline(window, chart):
    window.store.update(errors=OFF, exaggerated=5)
    window.store.select((3, 5))
    outline = next(o for o in chart.live.layout.drawing.outlines if o.surfaces[0] == 3)
    edges = [grip for grip in chart.drag.grips(chart.live) if grip.kind == "edge" and grip.surfaces == (3, 3)]
    assert len(edges) == 2
    for grip in edges:
        z, y = grip.place
        assert np.hypot(outline.z - z, outline.y - y).min() < 1e-6, "mm"
        assert abs(y - grip.y) > 1.0


def test_behind_a_fold_glass_is_not_moved_and_that_is_said(window, chart):
    window.store.update(lens_text=lens_to_toml(folded_behind_glass()), field_deg=0.0)
    assert not list(chart.drag.grips(chart.live))
    outline = chart.live.layout.drawing.glass.outlines[0]
    point = QPointF(*map(float, chart.to_pixels(outline.z.mean(), outline.y.mean())))
    click(chart, point)
    state = window.store.state
    pull(chart, point, point + QPointF(0, -20))
    assert window.store.state == state and "Misalign" in window.banner.text.text()
    window.banner.hide()


def folded_behind_glass():
    """Return a lens whose axis is folded by 90° half-way between its last surface and the sensor."""
    lens = load("plano_convex")
    half, last = lens.sensor_mm / 2, lens.surfaces[-1]
    mirror = Surface(inf, -half, MIRROR, **folding(Placement(tilt_x_deg=45.0)))
    return with_sensor(replace(lens, surfaces=(*lens.surfaces[:-1], replace(last, thickness=half), mirror)), -half)


def test_glass_that_is_not_selected_is_not_bent_by_a_stray_drag(window, chart):
    state, point = window.store.state, middle(chart, 1)
    pull(chart, point, point + QPointF(30, 0))
    assert window.store.state is state


def test_a_group_moves_between_its_neighbours(window, chart):
    point, before = middle(chart, 10), load("double_gauss_28")
    click(chart, point)
    click(chart, point)
    assert window.store.selection == (7, 11)
    pull(chart, point, point + QPointF(4, 0))
    after, by = prescription(window.store.state), 4 * chart.per_pixel()
    assert after.surfaces[5].thickness == pytest.approx(before.surfaces[5].thickness + by, rel=1e-9)
    assert after.surfaces[:5] == before.surfaces[:5]


def test_the_group_is_what_stands_on_the_same_side_of_the_stop():
    lens = load("cooke_triplet")
    runs = glass_runs(layout(paraxial_setup(with_lens(FIRST, "cooke_triplet"))).drawing.outlines)
    groups = {group_of(lens, runs, run) for run in runs}
    assert len(groups) == 2 and sorted(run for group in groups for run in group)[0] == 1


def test_the_rim_under_the_hand_is_the_f_number():
    """Against the paraxial pupil itself, which the drag does not ask."""
    start = change(FIRST, lens="double_gauss_28")
    setup = paraxial_setup(start)
    grip = stop_grips(setup, layout(setup))[0]
    state = drag(grip, start, grip.z, grip.y / 2)
    lens, before = paraxial_setup(state).lens, load("double_gauss_28")
    own = float(f_number(before, before.reference_wavelength_um))
    assert float(f_number(lens, lens.reference_wavelength_um)) == pytest.approx(2 * own, rel=1e-9)
    widest = drag(grip, start, grip.z, 50.0)
    assert widest.optics.f_number == ranges(load("double_gauss_28")).f_number[0]


def test_a_moved_stop_keeps_speed_and_spherical_aberration():
    """W40 does not change when the stop moves and the axial beam does not (Welford 1986, stop-shift equations)."""
    start = change(FIRST, lens="double_gauss_28", keep_focus="off")
    setup = paraxial_setup(start)
    grip = next(g for g in stop_grips(setup, layout(setup)) if g.kind == "stop")
    lens, moved = prescription(start), prescription(drag(grip, start, grip.z - 3.0, 0.0))
    assert vertices(moved)[5] == pytest.approx(vertices(lens)[5] - 3.0)
    assert vertices(moved)[6:] == pytest.approx(vertices(lens)[6:])
    one, two = (coefficients(x, inf, 0.1, x.reference_wavelength_um) for x in (lens, moved))
    assert float(two.w40) == pytest.approx(float(one.w40), rel=1e-9)
    assert float(two.w31) != pytest.approx(float(one.w31), rel=0.01)


def test_an_edge_dragged_to_its_vertex_is_a_plane_and_back_the_old_radius():
    start = change(FIRST, lens="double_gauss_28", keep_focus="off")
    lens = prescription(start)
    grip = next(g for g in surface_grips(lens, (1, 2)) if g.kind == "edge")
    flat = drag(grip, start, 0.0, grip.y)
    assert prescription(flat).surfaces[0].radius == inf
    back = drag(grip, flat, grip.z, grip.y)
    assert prescription(back).surfaces[0].radius == pytest.approx(lens.surfaces[0].radius, rel=1e-12)


def test_a_dragged_mirror_and_sensor_stay_on_the_side_that_light_runs_to(tmp_path):
    file = tmp_path / "mangin.toml"
    file.write_text(lens_to_toml(mangin()), encoding="utf-8")
    start = change(with_lens(FIRST, str(file)), keep_focus="off")
    grip = next(g for g in surface_grips(prescription(start), (1, 2)) if g.kind == "vertex")
    nearer = prescription(drag(grip, start, grip.z - 2.0, 0.0))
    assert vertices(nearer)[1] == pytest.approx(vertices(prescription(start))[1] - 2.0)
    setup = paraxial_setup(start)
    sensor = sensor_grip(layout(setup))
    moved = paraxial_setup(drag(sensor, start, sensor.z - 3.0, 0.0)).lens
    assert moved.sensor_mm == pytest.approx(setup.lens.sensor_mm - 3.0)
    beyond = paraxial_setup(drag(sensor, start, 50.0, 0.0)).lens
    assert beyond.sensor_mm < 0


def test_the_lens_of_another_file_has_nothing_selected(window, chart):
    window.store.select((1, 2))
    window.commands.open_lens("cooke_triplet")
    assert window.store.selection is None


@pytest.mark.parametrize(("coloured", "groups"), [("field", 3), ("wavelength", 3)])
def test_rays_by_field_and_by_wavelength_end_where_their_chief_rays_do(window, chart, coloured, groups):
    window.store.update(rays_coloured=coloured, rays_count=7, field_deg=10.0)
    shown = chart.live.layout
    assert len(shown.groups) == groups and len(shown.rays) == 7 * groups and len(chart.fans) == groups
    for number, fan in enumerate(shown.groups):
        wanted = change(FIRST, field_deg=fan.field_deg, wavelength_nm=fan.wavelength_nm)
        chief = next(ray for ray in layout(paraxial_setup(wanted)).rays if ray.kind == "chief")
        found = next(ray for ray in shown.rays if ray.group == number and ray.kind == "chief")
        assert found.y[-1] == pytest.approx(chief.y[-1], abs=1e-9)
    window.store.update(rays_coloured="kind", rays_count=3)
    assert len(chart.live.layout.rays) == 5


def test_the_empty_object_space_takes_a_sixth_of_the_width_at_most(window, chart):
    """For a source at infinity; the lens with its sensor has at least half where the height allows it."""
    for name in LENSES:
        window.store.replace(with_lens(FIRST, name))
        space = space_of(chart, chart.live)
        assert space.broken < chart.width() / 4 and space.end > 0


def test_leads_from_a_far_source_meet_its_rays_over_the_break_of_the_axis(window, chart, monkeypatch):
    window.store.replace(change(FIRST, depth_mm=5000.0, field_deg=6.0))
    leads, line = [], source_point.QLineF
    monkeypatch.setattr(source_point, "QLineF", lambda *ends: leads.append(ends) or line(*ends))
    chart.grab()
    space, ring = space_of(chart, chart.live), chart.handle.pixel(chart.live)
    along = [(ray.z[:2], ray.y[:2]) for ray in chart.live.layout.rays]
    for start, end in leads:
        z, height = chart.from_pixels(end)
        assert z == pytest.approx(space.break_z) and start.x() == pytest.approx(ring.x())
        missed = [abs(y[0] + (z - at[0]) * (y[1] - y[0]) / (at[1] - at[0]) - height) for at, y in along]
        assert min(missed) == pytest.approx(0, abs=1e-6)
    assert len(leads) > 2 and max(abs(chart.from_pixels(end)[1]) for _, end in leads) > 1


@pytest.mark.parametrize("depth", [30.0, 400.0, inf])
@pytest.mark.parametrize("slope", [0.0, 0.3])
def test_a_picture_of_twice_the_size_with_twice_the_type_has_its_sources_twice_as_far(depth, slope):
    plain = object_space((500.0, 90.0, 1.3), (960.0, 180.0), (-2.0, 30.0), 57.0, 1000.0, 20.0)
    large = object_space((1000.0, 180.0, 2.6), (1920.0, 360.0), (-2.0, 30.0), 57.0, 1000.0, 20.0, type_scale=2.0)
    assert large.place(depth, slope) == pytest.approx(tuple(2 * v for v in plain.place(depth, slope)), rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["source", "sensor", "edge"])
@pytest.mark.parametrize("percent", [100.0, 200.0])
def test_large_type_has_large_handles(window, chart, kind, percent):
    window.resize(round(14.4 * percent), round(9 * percent))
    window.store.update(scale_percent=percent)
    window.store.select((3, 5))
    QApplication.processEvents()
    at = chart.handle.pixel(chart.live) if kind == "source" else chart.drag.pixel(grip_of(chart, window, kind))
    reach = {"source": 13.0, "sensor": 7.0, "edge": 7.0}[kind] * percent / 100  # in pixels, see the two NEAR_PX
    for part, held in ((0.9, True), (1.1, False)):
        found = chart.drag.find(chart.live, at - QPointF(part * reach, 0))
        assert (found is not None and found.kind == kind) == held


def test_an_edge_that_is_dragged_lies_under_the_pointer_by_the_surface_s_own_conic(window):
    start = with_lens(FIRST, "asphere")
    lens = prescription(start)
    number = next(k for k, surface in enumerate(lens.surfaces, 1) if surface.conic and surface.curvature)
    grip = next(grip for grip in surface_grips(lens, (number, number)) if grip.kind == "edge")
    away = 0.8 * (grip.z - vertices(lens)[number - 1])
    surface = prescription(drag(grip, start, vertices(lens)[number - 1] + away, grip.y)).surfaces[number - 1]
    assert float(surface.sag(0.0, grip.y)) == pytest.approx(away, rel=1e-3)


def test_a_mirror_far_larger_than_the_view_is_painted(qtbot):
    """Random hands made one of 10¹² pixels, whose hatching took a terabyte."""
    picture = QPixmap(100, 100)
    picture.fill(QColor("black"))
    with QPainter(picture) as painter:
        paint_mirror(painter, QPolygonF([QPointF(50, -1e12), QPointF(50, 1e12)]), 1, DARK)
    assert picture.toImage().pixelColor(50, 50) != QColor("black")
