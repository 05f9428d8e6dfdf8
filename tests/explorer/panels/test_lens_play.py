"""The lens table to play with: numbers under the hand, bending, stop shift, focus that follows, glass by name."""

from math import inf

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication, QLineEdit

from p2sf.paraxial.bending import shape_factor, thin_power
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.pupils import f_number
from p2sf_explorer.compute.editing import edited_state, radius_through, with_scrubbed, with_stop_shift, with_surface
from p2sf_explorer.compute.glass_outlines import vertices
from p2sf_explorer.compute.setup import load, prescription
from p2sf_explorer.panels.lens_table.glass_completion import completer, written_indices
from p2sf_explorer.panels.lens_table.surface_table import KEYS
from p2sf_explorer.state.state import change, new_state
from tests.support.windows.events import choose

LENS = "double_gauss_28"
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def table(window):
    window.open_panel("lens")
    yield window.panels["lens"]
    window.store.select(None)


def pull(table, row, key, px, release=True):
    """Drag on a cell of the table."""
    place = table.view.visualRect(table.model.index(row, KEYS.index(key))).center()
    view = table.view.viewport()

    def send(kind, point):
        at = QPointF(point)
        button = Qt.MouseButton.NoButton if kind == QEvent.Type.MouseMove else LEFT
        held = Qt.MouseButton.NoButton if kind == QEvent.Type.MouseButtonRelease else LEFT
        keys = Qt.KeyboardModifier.NoModifier
        QApplication.sendEvent(view, QMouseEvent(kind, at, view.mapToGlobal(at), button, held, keys))

    send(QEvent.Type.MouseButtonPress, place)
    for k in (1, 2, 3, 4):
        send(QEvent.Type.MouseMove, place + QPoint(px * k // 4, 0))
    if release:
        send(QEvent.Type.MouseButtonRelease, place + QPoint(px, 0))


@pytest.mark.parametrize(("key", "value"), [("radius", 56.20238 / 1.1), ("thickness", 8.75 * 1.1), ("conic", 0.1)])
def test_a_dragged_number_is_live_and_one_step_of_undo(window, table, key, value):
    first = window.store.state
    pull(table, 0, key, 40, release=False)
    assert window.live.quality == "preview"
    assert getattr(prescription(window.store.state).surfaces[0], key) == pytest.approx(value, rel=1e-9)
    pull(table, 0, key, 0)
    window.store.undo()
    assert window.store.state == first


def test_escape_gives_a_dragged_number_back(window, table, qtbot):
    first = window.store.state
    pull(table, 0, "radius", 40, release=False)
    qtbot.keyClick(table.view, Qt.Key.Key_Escape)
    assert window.store.state == first


def test_a_radius_passes_through_the_plane():
    lens = load("plano_convex")
    flat = next(k for k, s in enumerate(lens.surfaces, 1) if s.radius == inf)
    made = with_scrubbed(lens, flat, "radius", 0.1).surfaces[flat - 1].radius
    assert made > 0 and with_scrubbed(lens, flat, "radius", -0.1).surfaces[flat - 1].radius == -made


def test_selection_is_one_in_layout_and_table(window, table, qtbot):
    place = table.view.visualRect(table.model.index(3, KEYS.index("stop"))).center()
    qtbot.mouseClick(table.view.viewport(), LEFT, pos=place)
    assert window.store.selection == (3, 5), "the cemented doublet"
    window.store.select((1, 2))
    ground = [table.model.data(table.model.index(row, 0), Qt.ItemDataRole.BackgroundRole) for row in range(4)]
    assert ground[0] is not None and ground[0] == ground[1] and ground[2] is None
    window.store.point_at(3)
    assert table.model.data(table.model.index(2, 0), Qt.ItemDataRole.BackgroundRole) is not None
    window.store.point_at(0)


def test_the_bending_slider_keeps_the_thin_power(window, table, drag, qtbot):
    assert not table.bending.isEnabled()
    window.store.select((1, 2))
    before, first = load(LENS), window.store.state
    assert table.bending.number.text() == f"{shape_factor(before, 1, 2):.3f}"
    drag(table.bending.slider, 0.6)
    after = prescription(window.store.state)
    assert shape_factor(after, 1, 2) == pytest.approx(-6 + 12 * table.bending.slider.value() / 1000)
    assert float(thin_power(after, 1, 2)) == pytest.approx(float(thin_power(before, 1, 2)), rel=1e-12)
    window.store.undo()
    assert window.store.state == first


def test_a_typed_shape_makes_the_element_plano_convex(window, table, qtbot):
    window.store.select((1, 2))
    edit = table.bending.number
    edit.setFocus()
    edit.selectAll()
    qtbot.keyClicks(edit, "1")
    qtbot.keyClick(edit, Qt.Key.Key_Return)
    assert abs(prescription(window.store.state).surfaces[1].curvature) < 1e-12


def test_the_stop_slider_moves_the_stop_alone_and_keeps_the_f_number(window, table, drag):
    before = load(LENS)
    drag(table.stop_place.slider, 0.25)
    after = prescription(window.store.state)
    assert vertices(after)[5] != pytest.approx(vertices(before)[5], abs=0.1)
    assert [z for k, z in enumerate(vertices(after)[:-1]) if k != 5] == pytest.approx(
        [z for k, z in enumerate(vertices(before)[:-1]) if k != 5]
    )
    speeds = [float(f_number(lens, lens.reference_wavelength_um)) for lens in (before, after)]
    assert speeds[1] == pytest.approx(speeds[0], rel=1e-12)


def test_a_stop_on_glass_cannot_be_moved_alone():
    lens = load(LENS)
    from dataclasses import replace

    with pytest.raises(Exception, match="no plane in an air gap"):
        with_stop_shift(replace(lens, stop_surface=3), 1.0)


@pytest.mark.parametrize(("keep", "near"), [("off", False), ("paraxial", True), ("rms", False)])
def test_the_sensor_follows_the_paraxial_image_or_not(keep, near):
    start, lens = new_state(lens=LENS, keep_focus=keep, field_deg=0.0, method="seidel"), load(LENS)
    made = prescription(edited_state(start, with_surface(lens, 1, radius=60.0)))
    image, before = (float(image_distance(x, inf, x.reference_wavelength_um)) for x in (made, lens))
    assert abs(image - before) > 1, "the edit moves the image by millimetres"
    apart, earlier = made.sensor_mm - image, lens.sensor_mm - before
    assert (abs(apart - earlier) < 1e-9) == near
    assert keep != "off" or made.sensor_mm == lens.sensor_mm


def test_best_focus_after_an_edit_is_that_of_autofocus():
    """Of the axial point W40 ρ⁴ + Wd ρ² is best at Wd = −W40 (Mahajan 1991, table 2-1)."""
    from p2sf_explorer.compute.setup import paraxial_setup

    start, lens = new_state(lens=LENS, keep_focus="rms", field_deg=0.0, method="seidel"), load(LENS)
    c = paraxial_setup(edited_state(start, with_surface(lens, 1, radius=60.0))).coefficients
    assert float(c.wd) == pytest.approx(-float(c.w40), abs=0.01)  # a shift is rounded to a nanometre


def test_a_sensor_edited_by_itself_stays_where_it_is_put():
    start, lens = new_state(lens=LENS), load(LENS)
    made = edited_state(start, with_surface(lens, 11, thickness=70.0))
    assert prescription(made).sensor_mm == 70.0


def test_the_chooser_changes_what_the_sensor_follows(window, table):
    choose(table.focus, "off")
    assert window.store.state.display.keep_focus == "off"


@pytest.mark.parametrize("radius", [-80.0, 15.0, 1e6])
def test_the_radius_through_an_edge_is_that_of_its_sphere(radius):
    surface = with_surface(load(LENS), 1, radius=radius, conic=0.0).surfaces[0]
    sag = radius - (1 if radius > 0 else -1) * (radius**2 - 100) ** 0.5
    assert radius_through(surface, 10.0, sag) == pytest.approx(radius, rel=1e-6)  # a sag of 50 nm has lost digits


def test_a_glass_is_completed_with_its_indices(window, table, qtbot):
    """n_d and ν_d of N-BK7 are SCHOTT's data sheet's."""
    assert written_indices("SCHOTT N-BK7") == ("1.51680", "64.17")
    index = table.model.index(0, KEYS.index("medium"))
    table.view.setCurrentIndex(index)
    table.view.edit(index)
    editor = next(e for e in table.view.findChildren(QLineEdit) if e.isVisible())
    made = editor.completer() or completer(editor)
    made.setCompletionPrefix("bk7")
    model = made.completionModel()
    found = {model.data(model.index(row, 0)): model.data(model.index(row, 1)) for row in range(model.rowCount())}
    assert found["SCHOTT N-BK7"] == "1.51680"
    qtbot.keyClick(editor, Qt.Key.Key_Escape)


def test_states_keep_these_choices():
    from p2sf_explorer.state.state_files import state_from_json, state_to_json

    state = change(new_state(), keep_focus="rms", rays_coloured="field", rays_count=7)
    assert state_from_json(state_to_json(state)) == state
