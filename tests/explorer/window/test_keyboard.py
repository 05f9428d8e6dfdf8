"""The keyboard reaches everything: Tab walks through the window, panel by panel, and comes round again."""

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractScrollArea, QApplication, QLineEdit, QWidget

from p2sf_explorer.state.panels import REGISTRY
from tests.explorer.panels.test_strip_and_map import filled
from tests.support.tiers import in_tiers

TABS = [entry.key for entry in REGISTRY if entry.key != "solid"]
DIFFERENT = ("lens", "matrix")  # a table, and choosers
MOST = 200


def wanted(window) -> set[QWidget]:
    """Return every widget on show that takes the focus by Tab."""
    able = (part for part in window.findChildren(QWidget) if part.isVisible() and part.isEnabled())
    return {part for part in able if part.focusPolicy() & Qt.FocusPolicy.TabFocus and not part.focusProxy()}


def walked(window, key: Qt.Key) -> set[QWidget]:
    """Return what has had the focus after as many presses of a key as it takes to come round."""
    window.top.lens.setFocus()
    met: list[QWidget] = []
    for _ in range(MOST):
        part = QApplication.focusWidget()
        if part in met[:1]:
            return set(met)
        met.append(part)
        QTest.keyClick(part, key)
    raise AssertionError(f"the focus stays with {QApplication.focusWidget()}")


def named(parts) -> str:
    return "\n".join(f"{type(part).__name__} {part.accessibleName() or part.objectName()}" for part in parts)


@pytest.mark.parametrize("key", in_tiers(TABS, DIFFERENT))
def test_tab_reaches_everything_of_a_panel_and_comes_round(window, key, qtbot):
    window.open_panel(key)
    if key == "image":  # its buttons are for a picture
        qtbot.waitUntil(window.panels[key].save.isEnabled)
    window.store.update(playback_slider="field_deg")
    QApplication.processEvents()
    met, hoped = walked(window, Qt.Key.Key_Tab), wanted(window)
    assert len(hoped) > 40
    assert met >= hoped, named(hoped - met)
    assert not (unnamed := [part for part in hoped if not said(part)]), named(unnamed)


def said(part: QWidget) -> str:
    """Return what a screen reader would say of a widget."""
    text = getattr(part, "text", None)
    return part.accessibleName() or (text() if text and not isinstance(part, QLineEdit) else "")


def test_shift_tab_goes_the_same_way_back(window):
    window.open_panel("profiles")
    assert walked(window, Qt.Key.Key_Backtab) == walked(window, Qt.Key.Key_Tab)


def test_the_focus_can_be_seen(window):
    """Whatever has the focus is painted otherwise than without it."""
    window.open_panel("through_focus")
    blind = []
    for part in wanted(window):
        if isinstance(part, QAbstractScrollArea) or not part.width():
            continue
        window.top.lens.setFocus() if part is not window.top.lens else window.top.open.setFocus()
        QApplication.processEvents()
        before = part.grab().toImage()
        part.setFocus(Qt.FocusReason.TabFocusReason)
        QApplication.processEvents()
        if part.grab().toImage() == before:
            blind.append(part)
    assert not blind, named(blind)


def test_the_maps_frame_follows_the_field_and_the_keys_start_from_it(window, qtbot):
    window.store.update(tab="field_map", field_deg=0.0)
    panel = window.panels["field_map"]
    filled(panel, qtbot)
    chart = panel.chart
    chart.setFocus()
    qtbot.keyClick(chart, Qt.Key.Key_Right)
    before = chart.grab().toImage()
    assert (chart.present(), chart.choice.number) == (17, 18), "the fourth of seven in the third row, and the next"
    qtbot.mouseClick(chart, Qt.MouseButton.LeftButton, pos=chart.room(chart.tiles[34]).center().toPoint())
    qtbot.keyClick(chart, Qt.Key.Key_Left)
    assert (chart.present(), chart.choice.number) == (34, 33), "of four corners as far out the one that was clicked"
    window.store.update(field_deg=0.0)  # as by the slider
    qtbot.keyClick(chart, Qt.Key.Key_Right)
    assert chart.choice.number == 18 and chart.grab().toImage() == before, "the frame is back too"


@pytest.mark.parametrize("shortcut", ["Ctrl+E", "Ctrl+K", "Ctrl+D", "Ctrl+F"])
def test_a_field_to_type_in_leaves_the_window_its_shortcuts(window, qtbot, shortcut):
    """Qt asks the field with the focus first; on X11 a line edit would take Ctrl+E and Ctrl+K for itself."""
    edit = window.controls.rows["field_deg"].findChild(QLineEdit)
    edit.setFocus()
    combination = QKeySequence(shortcut)[0]
    event = QKeyEvent(QEvent.Type.ShortcutOverride, combination.key(), combination.keyboardModifiers())
    event.ignore()
    QApplication.sendEvent(edit, event)
    assert not event.isAccepted()


@pytest.mark.parametrize("shortcut", ["Ctrl+C", "Ctrl+V", "Ctrl+A"])
def test_a_field_to_type_in_keeps_copying_and_pasting(window, shortcut):
    edit = window.controls.rows["field_deg"].findChild(QLineEdit)
    combination = QKeySequence(shortcut)[0]
    event = QKeyEvent(QEvent.Type.ShortcutOverride, combination.key(), combination.keyboardModifiers())
    event.ignore()
    QApplication.sendEvent(edit, event)
    assert event.isAccepted()
