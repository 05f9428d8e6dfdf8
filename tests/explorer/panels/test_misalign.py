"""The sliders of the Misalign panel, with events of Qt."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from p2sf.lens.misalignment import displaced
from p2sf.lens.placement import Placement
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.state_files import state_from_json, state_to_json
from tests.support.windows.windows import settled


@pytest.fixture
def panel(window, qtbot):
    window.store.update(tab="misalign", field_deg=0.0, method="auto")
    made = window.panels["misalign"]
    window.store.select((3, 5))
    return made


def row(panel, kind, number=0):
    return panel.rows[kind][number]


def type_into(row, text):
    edit = row.slider.number
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, text)
    QTest.keyClick(edit, Qt.Key.Key_Return)


def test_a_typed_decentre_is_in_the_picture_and_its_button_sets_it_right(window, panel):
    before = window._answers.seen.psf.values.copy()
    type_into(row(panel, "decentre_y"), "0.2")
    assert window.store.state.optics.errors == (("decentre_y", 3, 5, 0.2),)
    assert not np.array_equal(window._answers.seen.psf.values, before)
    assert row(panel, "decentre_y").slider.number.text() == "0.200 mm"
    QTest.mouseClick(row(panel, "decentre_y").back, Qt.MouseButton.LeftButton)
    assert window.store.state.optics.errors == ()
    assert np.array_equal(window._answers.seen.psf.values, before)


def test_microns_and_minutes_may_be_typed(window, panel):
    type_into(row(panel, "decentre_x"), "50 µm")
    type_into(row(panel, "tilt_y"), "6'")
    found = {kind: amount for kind, *_, amount in window.store.state.optics.errors}
    assert found == {"decentre_x": pytest.approx(0.05), "tilt_y": pytest.approx(0.1)}


def test_a_drag_is_one_step_of_undo(window, panel):
    slider, left = row(panel, "tilt_x").slider.slider, Qt.MouseButton.LeftButton
    before, middle = window.store.state, slider.height() // 2
    QTest.mousePress(slider, left, pos=QPoint(slider.width() // 2, middle))
    for part in (0.55, 0.6, 0.7):
        QTest.mouseMove(slider, QPoint(round(part * slider.width()), middle))
    QTest.mouseRelease(slider, left, pos=QPoint(round(0.7 * slider.width()), middle))
    ((kind, first, last, amount),) = window.store.state.optics.errors
    assert (kind, first, last) == ("tilt_x", 3, 5) and 0.2 < amount < 0.6
    window.store.undo()
    assert window.store.state == before


def test_what_cannot_be_is_one_sentence_over_the_old_picture(window, panel):
    type_into(row(panel, "tilt_x"), "95")
    assert "urface 3: a tilt of 95°" in window.banner.text.text()
    assert window.panels["psf"].widget.overlay.text
    window.grab()  # painting raises nothing
    assert not panel.widget.overlay.text  # or nobody could set it right
    assert row(panel, "tilt_x").slider.number.text() == "95.000°"
    QTest.mouseClick(panel.reset_all, Qt.MouseButton.LeftButton)
    assert window.store.state.optics.errors == ()
    assert not window.panels["psf"].widget.overlay.text


def test_a_selection_of_the_layout_shows_its_piece(window, panel):
    window.store.select((7, 9))
    assert panel.piece.currentData() == (7, 9)
    assert row(panel, "decentre_y").adjustment.span == (7, 9)
    panel.piece.setCurrentIndex(panel.piece.count() - 1)  # the sensor
    panel.piece.activated.emit(panel.piece.currentIndex())
    shown = [each for rows in panel.rows.values() for each in rows if not each.isHidden()]
    assert [each.kind for each in shown] == ["tilt_x", "tilt_y"]


def test_sessions_and_links_hold_the_errors(window, panel):
    type_into(row(panel, "radius"), "0.5")
    state = window.store.state
    assert state.optics.errors == (("radius", 3, 3, 0.5),)
    assert state_of_link(link(state)).optics == state.optics
    assert state_from_json(state_to_json(state)) == state


def test_the_field_along_x_has_a_slider_without_symmetry_or_on_request(window, panel):
    field_x = window.controls.rows["field_x_deg"]
    assert field_x.isHidden()
    window.store.update(errors=(("tilt_y", 3, 5, 0.1),))
    assert not field_x.isHidden()
    window.store.update(errors=())
    assert field_x.isHidden()
    panel.field_x.click()
    assert not field_x.isHidden() and window.store.state.display.show_field_x


def test_panels_of_paraxial_figures_say_what_they_leave_out(window, panel):
    window.store.update(tab="first_order", errors=(("tilt_y", 3, 5, 0.1),))
    note = window.panels["first_order"].widget.note
    assert "aligned" in note.text() and not note.isHidden()
    window.store.update(errors=())
    assert note.isHidden()


def test_a_point_of_the_field_map_is_dragged_to_any_field(window, panel, qtbot):
    window.store.update(tab="field_map", errors=(("tilt_y", 3, 5, 0.1),), f_number=8.0)
    chart = window.panels["field_map"].chart
    settled(window.panels["field_map"], qtbot)
    assert chart.tiles and chart.free
    at = QPoint(*(round(float(v)) for v in chart.to_pixels(-0.5, -0.25)))
    QTest.mousePress(chart, Qt.MouseButton.LeftButton, pos=at)
    QTest.mouseRelease(chart, Qt.MouseButton.LeftButton, pos=at)
    optics = window.store.state.optics
    slopes = np.tan(np.deg2rad([optics.field_x_deg, optics.field_deg]))
    assert slopes / chart.asked.corner_slope == pytest.approx([-0.5, -0.25], abs=0.01)  # a pixel of the map


def test_the_layout_says_that_it_is_seen_along_x_and_by_what_it_exaggerates(window, panel):
    window.store.update(errors=(("tilt_y", 3, 5, 0.1),), exaggerated=30)
    legend = window.panels["layout"].widget.readout
    assert "not symmetric: sections seen along x" in legend.text() and "×30" in legend.text()
    assert "of Misalign ×30" not in legend.text(), "the file has no tilts that stay as they are"
    tilted = displaced(find_lens("double_gauss_28"), 7, 9, Placement(tilt_x_deg=0.2))
    window.store.update(lens_text=lens_to_toml(tilted))
    assert "of Misalign ×30, rays and those of the file" in legend.text()
    window.store.update(errors=(), lens_text=None)
    assert "×30" not in legend.text() and "seen along x" not in legend.text()


def test_an_exaggeration_from_a_link_is_among_those_to_choose(window, panel):
    larger = window.panels["layout"].larger
    for factor, words in ((20, "tilts ×20"), (100, "tilts ×100"), (1, "tilts as they are")):
        window.store.update(errors=(("tilt_y", 3, 5, 0.1),), exaggerated=factor)
        assert larger.currentText() == words and not larger.isHidden()
