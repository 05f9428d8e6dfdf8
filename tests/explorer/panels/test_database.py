"""The database panel: maps against direct evaluation, the present point, the atlas under a person's hands."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtWidgets import QApplication

from p2sf.conventions import slope_from_degrees
from p2sf.database.parts import KINDS
from p2sf.errors import Cancelled
from p2sf.messages import Message
from p2sf.paraxial.seidel import coefficients
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.setup import paraxial_setup, shipped_names
from p2sf_explorer.compute.views.database import ATLAS_DEFOCUS, answer, question
from p2sf_explorer.state.state import new_state
from p2sf_explorer.state.workspaces import on_stage
from tests.support.windows.events import choose


def asked(**changes):
    return question(compute.live(new_state(method="seidel", **changes))).question


@pytest.fixture
def panel(window, qtbot):
    window.open_panel("database")
    made = window.panels["database"]
    qtbot.waitUntil(lambda: made._answer is not None and not made._stale())
    return made


@pytest.mark.parametrize("lens", ["double_gauss_28", "eye_navarro", "wide_angle_35"])
def test_the_map_is_the_direct_evaluation(lens):
    found = answer(asked(lens=lens))
    made = paraxial_setup(new_state(lens=lens, depth_mm=inf))
    with np.errstate(divide="ignore"):
        depths = np.minimum(1 / found.near, found.nodes.depths_mm[-1])
    slopes = slope_from_degrees(found.fields_deg)[:, None]
    direct = coefficients(made.lens, depths, slopes, made.source.wavelength_um, made.stop)
    for kind in KINDS:
        truth = getattr(direct, kind)
        # the exact database's own promise: 1e-11 of the largest of its kind
        assert np.abs(found.maps[kind] - truth).max() <= 1e-11 * max(1.0, np.abs(truth).max())


def test_table1_has_no_error_where_it_has_no_rule_and_none_at_its_nodes():
    found = answer(asked())
    errors, near = found.errors["table1"]["w40"], found.near
    last = found.nodes.depths_mm[-2]
    gap = (near > 0) & (near < 1 / last * (1 - 1e-9))
    assert np.isnan(errors[:, gap]).all()
    assert not np.isnan(errors[:, ~gap]).any()
    assert np.isfinite(found.errors["linear"]["w40"]).all()
    assert 0 < found.largest["exact"]["w40"] < 1e-9 < found.largest["table1"]["w40"]


@pytest.mark.slow
@pytest.mark.parametrize("lens", shipped_names())
def test_every_shipped_lens_has_maps_and_an_atlas(lens):
    found = answer(asked(lens=lens))
    assert found.atlas is not None, found.why_no_atlas
    peaks = found.atlas.psfs.max((-2, -1))
    assert np.isfinite(peaks[0]).any()  # on axis not everything is only blur
    assert np.allclose(peaks[np.isfinite(peaks)], 1)


@pytest.mark.slow
def test_the_atlas_stands_around_the_depth_in_focus():
    found = answer(asked(focus_mm=2000.0))
    depths = found.atlas.depths_mm
    made = paraxial_setup(new_state(focus_mm=2000.0, depth_mm=2000.0))
    wd = coefficients(made.lens, depths, 0.0, made.source.wavelength_um, made.stop).wd
    assert depths[len(depths) // 2] == pytest.approx(2000, rel=1e-3)  # Wd runs straight to that over the columns
    assert np.abs(wd).max() == pytest.approx(ATLAS_DEFOCUS, rel=0.05)


def test_a_moved_source_asks_nothing_new_and_a_moved_sensor_does():
    first = asked()
    assert asked(depth_mm=3000.0, field_deg=4.0) == first
    assert asked(sensor_shift_um=10.0) != first
    assert asked(wavelength_nm=486.0) != first


def test_a_stopped_answer_is_cancelled():
    with pytest.raises(Cancelled):
        answer(asked(), lambda: True)


def test_the_point_follows_at_once_and_the_maps_stay(window, panel):
    before = panel._answer
    window.store.update(depth_mm=500.0, field_deg=7.0)
    assert panel.map.point == panel.error.point == (2.0, 7.0)
    assert panel._answer is before
    assert not panel._stale()


def test_another_wavelength_brings_other_maps_by_itself(window, panel, qtbot):
    before = panel._answer
    window.store.update(wavelength_nm=450.0)
    assert "working" in panel.widget.readout.text()
    qtbot.waitUntil(lambda: panel._answer is not before and not panel._stale())
    assert panel.widget.readout.text() == "at 450.0 nm"
    assert not np.array_equal(panel._answer.maps["w40"], before.maps["w40"])


def test_clicking_a_cell_of_the_atlas_sets_depth_and_field(window, panel, qtbot):
    first, atlas = window.store.state, panel.atlas
    place = atlas.cell_rect(2, 5).center().toPoint()
    qtbot.mouseClick(atlas, Qt.MouseButton.LeftButton, pos=place)
    assert window.store.state.optics.depth_mm == panel._answer.atlas.depths_mm[5]
    assert window.store.state.optics.field_deg == panel._answer.atlas.fields_deg[2]
    assert atlas.cell == (2, 5)
    window.store.undo()
    assert window.store.state == first


def test_dragging_over_the_atlas_is_one_undo(window, panel, qtbot):
    first, atlas = window.store.state, panel.atlas
    cells = [atlas.cell_rect(row, column).center().toPoint() for row, column in ((0, 1), (1, 3), (3, 8))]
    qtbot.mousePress(atlas, Qt.MouseButton.LeftButton, pos=cells[0])
    for place in cells[1:]:
        qtbot.mouseMove(atlas, place)
    qtbot.mouseRelease(atlas, Qt.MouseButton.LeftButton, pos=cells[-1])
    assert atlas.cell == (3, 8)
    window.store.undo()
    assert window.store.state == first


def test_arrow_keys_walk_over_the_atlas(window, panel, qtbot):
    window.store.update(depth_mm=inf, field_deg=0.0)
    panel.atlas.setFocus()
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Up):
        qtbot.keyClick(panel.atlas, key)
    assert panel.atlas.cell == (1, 2)


def test_arrow_keys_start_from_the_atlass_rim_where_the_source_lies_beyond_it(panel, qtbot, monkeypatch):
    atlas, chosen = panel.atlas, []
    monkeypatch.setattr(atlas, "_source", (1.0, 80.0))  # nearer and farther out than any cell
    monkeypatch.setattr(atlas, "cell", None)
    monkeypatch.setattr(atlas, "_choose", lambda row, column: chosen.append((row, column)))
    qtbot.keyClick(atlas, Qt.Key.Key_Left)
    fields, depths = atlas.atlas.psfs.shape[:2]
    assert chosen == [(fields - 1, depths - 2)]


def test_dragging_on_the_map_sets_the_point_under_the_pointer(window, panel, qtbot):
    chart = panel.map
    x, y = chart.to_pixels(4.0, 6.0)  # 250 mm, 6°
    qtbot.mouseClick(chart, Qt.MouseButton.LeftButton, pos=QPointF(float(x), float(y)).toPoint())
    pixel = chart.per_pixel()
    assert 1000 / window.store.state.optics.depth_mm == pytest.approx(4.0, abs=pixel)
    assert window.store.state.optics.field_deg == pytest.approx(6.0, abs=1.0)
    qtbot.mouseClick(chart, Qt.MouseButton.LeftButton, pos=QPointF(0.0, float(y)).toPoint())
    assert window.store.state.optics.depth_mm == inf


def test_arrow_keys_choose_a_node_of_the_map_and_enter_sets_the_source_on_it(window, panel, qtbot):
    chart, (near, fields) = panel.map, panel.map.nodes
    window.store.update(depth_mm=inf, field_deg=0.0)
    chart.setFocus()
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Up):
        qtbot.keyClick(chart, key)
    assert window.store.state.optics.field_deg == 0.0
    qtbot.keyClick(chart, Qt.Key.Key_Return)
    assert window.store.state.optics.field_deg == pytest.approx(float(np.sort(fields)[2]), abs=1e-6)
    assert 1000 / window.store.state.optics.depth_mm == pytest.approx(float(np.sort(near)[1]), rel=1e-6)


def test_arrow_keys_start_from_where_a_slider_has_put_the_source(window, panel, qtbot):
    chart, fields = panel.map, panel.map.nodes[1]
    window.store.update(depth_mm=inf, field_deg=0.0)
    chart.setFocus()
    qtbot.keyClick(chart, Qt.Key.Key_Up)
    window.store.update(field_deg=float(fields.max()))
    qtbot.keyClick(chart, Qt.Key.Key_Down)
    qtbot.keyClick(chart, Qt.Key.Key_Return)
    assert window.store.state.optics.field_deg == pytest.approx(float(np.sort(fields)[-2]), abs=1e-6)


def test_the_choosers_repaint_and_undo_takes_them_back(window, panel):
    def drawn():
        head, *_, values = panel.error.grids[0]
        return panel.map.grids[0][-1], values, head

    def check(term, rule):
        found = panel._answer
        assert np.array_equal(drawn()[0], found.maps[term])
        assert np.array_equal(drawn()[1], found.errors[rule][term], equal_nan=True) and term.upper() in drawn()[2]
        assert (panel.term.currentData(), panel.rule.currentData()) == (term, rule)

    check("w22", "table1")
    before = panel.map.grab().toImage(), panel.error.grab().toImage()
    choose(panel.term, "w40")
    check("w40", "table1")
    assert panel.map.grab().toImage() != before[0] and panel.error.grab().toImage() != before[1]
    choose(panel.rule, "linear")
    check("w40", "linear")
    window.store.undo()
    check("w40", "table1")
    window.store.undo()
    check("w22", "table1")


def test_an_edited_lens_has_its_own_maps(window, panel, qtbot):
    from p2sf_explorer.compute.editing import edited_state, with_value
    from p2sf_explorer.compute.setup import prescription

    before, state = panel._answer, window.store.state
    window.store.replace(edited_state(state, with_value(prescription(state), 1, "radius", "57")))
    qtbot.waitUntil(lambda: panel._answer is not before and not panel._stale())
    assert panel._answer.question.lens == replace(window.live.setup.lens)


def test_maps_beside_the_stage_can_be_read(window, panel):
    """At 1280 × 800 three maps stood side by side there, of some pixels each."""
    window.resize(1280, 800)
    QApplication.processEvents()
    shown = [chart for chart in (panel.map, panel.error, panel.atlas) if chart.isVisible()]
    assert shown and all(min(chart.area.width(), chart.area.height()) >= 45 for chart in shown)
    assert panel.rule.isVisible() == panel.error.isVisible()
    state = window.store.state
    window.store.update(**on_stage(state.display, "database"))
    QApplication.processEvents()
    assert all(part.isVisible() for part in (panel.map, panel.error, panel.atlas, panel.note, panel.rule))
    window.store.replace(state)


def test_a_lens_without_maps_says_why_and_offers_one_with_maps(window, panel, qtbot):
    panel.late._runner.failed.emit(panel.late.asked, Message("no ray of this lens arrives"))
    assert panel.empty.isVisible() and not panel.body.isVisible()
    assert "no ray of this lens arrives" in panel.empty.words.text().lower()
    panel._show_sample()
    assert window.store.state.optics.lens == "cooke_triplet"
    qtbot.waitUntil(lambda: panel.body.isVisible() and not panel._stale())
    window.store.undo()
    panel.late._runner.failed.emit(replace(panel.late.asked, field_deg=0.123), Message("of an earlier question"))
    assert not panel.empty.isVisible()
