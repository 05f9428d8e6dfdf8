"""Values under a hand that does not type: dragged numbers, the wheel, arrows, and sliders for photographers."""

from math import inf

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QApplication

from p2sf_explorer.compute.setup import load, ranges
from p2sf_explorer.state.scales import Vergence, distance_ticks
from p2sf_explorer.state.terms import TERMS
from p2sf_explorer.widgets.slider import MARGIN, MIDDLE

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
SHIFT, ALT = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.AltModifier


def turn(widget, count, modifiers=NONE):
    """Turn the wheel over a widget; with Alt as Qt does, sideways."""
    angle = QPoint(120 * count, 0) if modifiers & ALT else QPoint(0, 120 * count)
    at = QPointF(widget.rect().center())
    event = QWheelEvent(
        at, QPointF(widget.mapToGlobal(at.toPoint())), QPoint(), angle, Qt.MouseButton.NoButton, modifiers,
        Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(widget, event)


def pull(qtbot, edit, px, modifiers=NONE, release=True):
    """Drag on a number by so many pixels, in steps of ten."""
    start = edit.rect().center()
    qtbot.mousePress(edit, LEFT, modifiers, start)
    for k in range(10, abs(px) + 1, 10):
        move(edit, start + QPoint(k if px > 0 else -k, 0), modifiers)
    if release:
        qtbot.mouseRelease(edit, LEFT, modifiers, start + QPoint(px, 0))


def move(widget, point, modifiers):
    """Move the held mouse, with modifiers, which QTest does not pass on."""
    at = QPointF(point)
    QApplication.sendEvent(
        widget, QMouseEvent(QEvent.Type.MouseMove, at, widget.mapToGlobal(at), LEFT, LEFT, modifiers)
    )


def test_from_1_m_to_infinity_is_half_of_the_depth_slider_of_a_100_mm_lens(window, qtbot):
    """In pixels, as a hand meets it; the issue asks for half of the travel, and a pixel is 0.5 % of it."""
    slider = window.controls.rows["depth_mm"].slider
    end = slider.width() - MARGIN
    half = QPoint(round((MARGIN + end) / 2), int(MIDDLE))
    qtbot.mousePress(slider, LEFT, pos=half)
    assert window.store.state.optics.depth_mm == pytest.approx(1000, rel=0.02)
    move(slider, QPoint(round(end), int(MIDDLE)), NONE)
    assert window.store.state.optics.depth_mm == inf
    qtbot.mouseRelease(slider, LEFT, pos=QPoint(round(end), int(MIDDLE)))


def test_the_slider_of_distance_is_even_in_dioptres_far_away():
    """Between 20 m and ∞ equal steps of 1/distance take equal travels, to offset/distance = 4 %."""
    scale = Vergence(60.0, 1000.0)
    travels = [scale.travel(1 / v) for v in (5e-5, 2.5e-5)] + [scale.travel(inf)]
    assert travels[1] - travels[0] == pytest.approx(travels[2] - travels[1], rel=0.05)
    assert [scale.travel(mm) for mm in (10.0, 60.0, 1000.0, -3.0, inf)] == pytest.approx([0, 0, 0.5, 1, 1])


def test_a_relay_is_fine_beside_its_own_focus():
    limits = ranges(load("relay"))
    scale = Vergence(limits.closest_mm, limits.middle_mm)
    assert scale.travel(limits.focused_mm) == pytest.approx(0.5)


def test_ticks_are_round_distances_within_the_slider():
    values = [mm for mm, _ in distance_ticks(60.0)]
    assert values[0] == inf and {1000.0, 100.0, 2000.0, 500.0} <= set(values) and min(values) >= 60
    assert dict(distance_ticks(60.0))[1000.0] == "1 m"


def test_the_stated_fields_are_marked_on_the_slider(window):
    row = window.controls.rows["field_deg"]
    assert row.slider._marks == pytest.approx((0.0, 0.5, 0.7)), "0°, 10° and 14° of 20°"
    focus = window.controls.rows["depth_mm"].slider
    window.store.update(focus_mm=1000.0)
    assert focus._marks == pytest.approx((0.5,), abs=1e-4), "the focal length is 100.004 mm"


@pytest.mark.parametrize(("modifiers", "factor"), [(NONE, 1.0), (SHIFT, 10.0), (ALT, 0.1)])
def test_a_number_is_dragged_as_one_step_of_undo(window, qtbot, modifiers, factor):
    """The slider has 20°, a drag of 400 px all of it; −20 px are one degree, ten with Shift, a tenth with Alt."""
    edit, first = window.controls.rows["field_deg"].edit, window.store.state
    pull(qtbot, edit, -20, modifiers, release=False)
    assert window.live.quality == "preview"
    qtbot.mouseRelease(edit, LEFT, modifiers, QPoint(0, 0))
    assert window.store.state.optics.field_deg == pytest.approx(10 - factor)
    assert window.live.quality == "settled" and not window.store.moving
    window.store.undo()
    assert window.store.state == first


def test_escape_gives_a_dragged_number_back(window, qtbot):
    edit, first = window.controls.rows["field_deg"].edit, window.store.state
    can_undo = window.store.can_undo
    pull(qtbot, edit, 40, release=False)
    assert window.store.state != first
    qtbot.keyClick(edit, Qt.Key.Key_Escape)
    assert window.store.state == first and window.store.can_undo == can_undo and not window.store.moving
    move(edit, QPoint(90, 5), NONE)
    assert window.store.state == first, "the hand has let go"
    qtbot.mouseRelease(edit, LEFT)


def test_escape_gives_a_dragged_slider_back(window, drag, qtbot):
    slider, first = window.controls.rows["f_number"].slider, window.store.state
    drag(slider, 0.8, release=False)
    assert window.store.state != first
    qtbot.keyClick(slider, Qt.Key.Key_Escape)
    assert window.store.state == first and not window.store.moving
    qtbot.mouseRelease(slider, LEFT)


def test_a_click_on_a_number_still_lets_one_type(window, qtbot):
    edit = window.controls.rows["depth_mm"].edit
    qtbot.mouseClick(edit, LEFT)
    assert edit.selectedText() == edit.text()
    qtbot.keyClicks(edit, "2 m")
    qtbot.keyClick(edit, Qt.Key.Key_Return)
    assert window.store.state.optics.depth_mm == 2000


@pytest.mark.slow
@pytest.mark.parametrize(("modifiers", "by"), [(NONE, 0.1), (SHIFT, 1.0), (ALT, 0.01)])
def test_wheel_and_arrows_move_a_number_and_a_turn_is_one_step(window, qtbot, modifiers, by):
    edit, first = window.controls.rows["field_deg"].edit, window.store.state
    for _ in range(3):
        turn(edit, 1, modifiers)
    assert window.store.state.optics.field_deg == pytest.approx(10 + 3 * by)
    edit.setFocus()
    qtbot.keyClick(edit, Qt.Key.Key_Down, modifiers)
    assert window.store.state.optics.field_deg == pytest.approx(10 + 2 * by)
    edit.scrub.end()  # as it does by itself half a second later
    window.store.undo()
    assert window.store.state == first


def test_infinity_is_left_and_reached_by_dragging_the_number(window, qtbot):
    edit = window.controls.rows["depth_mm"].edit
    pull(qtbot, edit, -200)
    assert window.store.state.optics.depth_mm == pytest.approx(1000, rel=1e-4), "half of the travel"
    pull(qtbot, edit, 220)
    assert window.store.state.optics.depth_mm == inf


@pytest.mark.parametrize(("modifiers", "steps"), [(NONE, 5), (SHIFT, 50), (ALT, 1)])
def test_arrows_and_wheel_of_a_slider_are_coarse_and_fine(window, qtbot, modifiers, steps):
    slider = window.controls.rows["field_deg"].slider
    before = slider.value()
    slider.setFocus()
    qtbot.keyClick(slider, Qt.Key.Key_Right, modifiers)
    assert slider.value() - before == steps
    turn(slider, -1, modifiers)
    assert slider.value() == before
    slider.setSliderDown(False)


def test_in_a_lesson_alt_and_arrows_turn_its_pages(window, qtbot):
    window.teaching.begin(next(iter(window.teaching.lessons())))
    slider = window.controls.rows["field_deg"].slider
    slider.setFocus()
    qtbot.keyClick(slider, Qt.Key.Key_Right, ALT)
    assert window.store.state.lesson.step == 1
    window.teaching.leave()


def test_a_tolerated_length_follows_the_hand(window, qtbot):
    window.open_panel("depth_of_field")
    edit = window.panels["depth_of_field"].blur.edit
    pull(qtbot, edit, 100)
    assert window.store.state.display.blur_um == pytest.approx(300), "a quarter of four decades: ten times"


def stray(window, qtbot):
    """Click on the groove of the first coefficient, right of its handle."""
    mixer = window.panels["coefficients"].bars
    point = mixer.places.handle(TERMS.index("w40"), 0.35).toPoint()
    qtbot.mouseClick(mixer, LEFT, pos=point)


def test_a_stray_click_on_a_coefficient_says_what_it_did_and_takes_it_back(window, qtbot):
    card, first = window.panels["coefficients"].widget, window.store.state
    stray(window, qtbot)
    waves = window.store.state.what_if.added_waves[0]
    assert waves and f"W40 +{waves:.2f} λ" in card.readout.text() and "Undo" in card.readout.text()
    card.readout.linkActivated.emit("undo")
    assert window.store.state == first
    assert "Undo" not in card.readout.text()


def test_after_other_moves_the_link_takes_only_the_what_if_away(window, qtbot):
    card = window.panels["coefficients"].widget
    stray(window, qtbot)
    window.store.update(field_deg=5.0, muted=("w22",))
    window.store.update(field_deg=4.0)
    assert "Reset" in card.readout.text()
    card.readout.linkActivated.emit("undo")
    assert window.store.state.what_if.added_waves[0] == 0 and window.store.state.optics.field_deg == 4.0


def test_a_cancelled_drag_that_moved_nothing_changes_nothing(window):
    first, can_undo = window.store.state, window.store.can_undo
    window.store.begin()
    window.store.cancel()
    assert window.store.state is first and window.store.can_undo == can_undo
