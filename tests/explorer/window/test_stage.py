"""One stage and its satellites: taken by mouse, keys, drag and menu; what is not on show is not computed."""

import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt
from PySide6.QtGui import QContextMenuEvent, QDragEnterEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QComboBox, QLineEdit, QMenu

from p2sf.messages import Message
from p2sf_explorer.charts.theme import tokens
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.lessons.lesson import shipped_lessons
from p2sf_explorer.state.pinning import pin
from p2sf_explorer.state.state import new_state
from p2sf_explorer.state.state_files import state_from_json, state_to_json
from p2sf_explorer.state.workspaces import WORKSPACES, with_workspace
from p2sf_explorer.widgets.card import PANEL_MIME
from p2sf_explorer.widgets.slider import Slider
from tests.explorer.accessibility.test_looks import contrast
from tests.support.windows.windows import at_rest

TITLE = QPoint(30, 14)


def where(window) -> tuple[str, ...]:
    """Return the panels whose cards stand on the stage, in the rail and in front of the tabs, as painted."""
    keys = {panel.widget: key for key, panel in window.panels.items()}
    places = [window.room.stage, *(place for place in window.room.satellites if place.isVisible())]
    places.append(window.tabs.currentWidget())
    return tuple(keys[card] for place in places for card in keys if card.parentWidget() is place and card.isVisible())


def drop(place, key: str) -> None:
    """Drop a panel's title in the middle of a place, as Qt tells of it."""
    data = QMimeData()
    data.setData(PANEL_MIME, key.encode())
    middle, move = place.rect().center(), Qt.DropAction.MoveAction
    buttons, keys = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    QApplication.sendEvent(place, QDragEnterEvent(middle, move, data, buttons, keys))
    assert place.property("target")
    QApplication.sendEvent(place, QDropEvent(QPointF(middle), move, data, buttons, keys))
    assert not place.property("target")


def test_a_double_click_on_a_title_takes_the_stage_and_on_the_stages_own_hides_the_rail(window):
    assert where(window) == ("psf", "layout", "pupil", "coefficients", "profiles")
    QTest.mouseDClick(window.panels["pupil"].widget, Qt.MouseButton.LeftButton, pos=TITLE)
    assert where(window) == ("pupil", "layout", "psf", "coefficients", "profiles")
    assert not window.store.state.display.windows
    QTest.mouseDClick(window.panels["pupil"].widget, Qt.MouseButton.LeftButton, pos=TITLE)
    assert window.room.stage.isVisible() and not window.room.rail.isVisible()
    QTest.mouseDClick(window.panels["pupil"].widget, Qt.MouseButton.LeftButton, pos=TITLE)
    assert window.room.rail.isVisible()
    window.store.undo()
    window.store.undo()
    window.store.undo()
    assert where(window) == ("psf", "layout", "pupil", "coefficients", "profiles")


def test_a_double_click_below_the_title_takes_nothing(window):
    card = window.panels["profiles"].widget
    QTest.mouseDClick(card, Qt.MouseButton.LeftButton, pos=QPoint(card.width() // 2, card.height() - 3))
    assert window.store.state.display.stage == "psf"


@pytest.mark.parametrize(("digit", "key"), [("1", "layout"), ("2", "pupil"), ("3", "coefficients"), ("4", "profiles")])
def test_a_digit_puts_that_satellite_on_the_stage_and_again_puts_it_back(window, qtbot, digit, key):
    before = where(window)
    qtbot.keyClick(window.controls.rows["field_deg"].slider, digit)
    assert where(window)[0] == key and where(window)[int(digit)] == "psf"
    qtbot.keyClick(window, digit)
    assert where(window) == before


def test_digits_go_to_the_stage_from_a_chooser_too(window, qtbot):
    """Qt would choose the next item that begins with one, such as another number of rays."""
    box, before = window.panels["layout"].count, window.store.state
    box.setFocus()
    qtbot.keyClick(box, "1")
    assert where(window)[0] == "layout" and window.store.state.display.rays_count == before.display.rays_count


def test_digits_typed_into_a_value_or_a_table_stay_there(window, qtbot):
    edit = window.controls.rows["depth_mm"].edit
    edit.setFocus()
    edit.selectAll()
    qtbot.keyClicks(edit, "12")
    assert edit.text() == "12" and window.store.state.display.stage == "psf"
    qtbot.keyClick(edit, Qt.Key.Key_Escape)
    window.open_panel("lens")
    view = window.panels["lens"].view
    view.setCurrentIndex(view.model().index(0, 1))
    view.setFocus()
    qtbot.keyClick(view, "1")
    assert window.store.state.display.stage == "psf"
    qtbot.keyClick(QApplication.focusWidget(), Qt.Key.Key_Escape)


def test_a_title_dropped_on_the_stage_or_a_satellite_changes_places(window):
    drop(window.room.stage, "layout")
    assert where(window) == ("layout", "psf", "pupil", "coefficients", "profiles")
    drop(window.room.satellites[2], "psf")
    assert where(window) == ("layout", "coefficients", "pupil", "psf", "profiles")
    drop(window.tabs.currentWidget(), "layout")
    assert where(window) == ("profiles", "coefficients", "pupil", "psf", "layout")
    drop(window.room.stage, "mtf")
    assert where(window) == ("mtf", "coefficients", "pupil", "psf", "profiles"), "from behind the tabs"
    drop(window.room.stage, "of another program")
    assert where(window)[0] == "mtf"


def test_the_title_carries_its_panel(window):
    assert bytes(window.panels["pupil"].widget.mime_data().data(PANEL_MIME).data()) == b"pupil"


def test_a_drag_of_the_title_begins_and_one_of_the_picture_does_not(window, monkeypatch):
    card, begun = window.panels["pupil"].widget, []
    monkeypatch.setattr(type(card), "drag_title", lambda card: begun.append(card.key))
    for start in (QPoint(60, card.height() - 4), TITLE):
        QTest.mousePress(card, Qt.MouseButton.LeftButton, pos=start)
        for step in (4, 40, 80):
            QTest.mouseMove(card, start + QPoint(step, step // 4))
        QTest.mouseRelease(card, Qt.MouseButton.LeftButton, pos=start)
    assert begun == ["pupil"]


def entries_of(window, key: str, text: str) -> list:
    card = window.panels[key].widget
    QApplication.sendEvent(card, QContextMenuEvent(QContextMenuEvent.Reason.Mouse, TITLE, card.mapToGlobal(TITLE)))
    menu = card.findChildren(QMenu)[-1]
    found = [action for action in menu.actions() if action.text() == text]
    menu.hide()
    return found


def test_the_menu_of_a_card_knows_its_places(window):
    assert not entries_of(window, "psf", "On the stage")
    entries_of(window, "profiles", "Keep beside the stage")[0].trigger()
    assert where(window)[:5] == ("psf", "layout", "pupil", "coefficients", "profiles") and len(where(window)) == 6
    entries_of(window, "layout", "Back to the tabs")[0].trigger()
    assert where(window) == ("psf", "pupil", "coefficients", "profiles", "layout")
    entries_of(window, "coefficients", "On the stage")[0].trigger()
    assert where(window)[0] == "coefficients"


def test_the_palette_puts_any_panel_on_the_stage(window):
    command = next(c for c in window.commands.everything() if (c.group, c.title) == ("On the stage", "Spot"))
    command.run()
    assert where(window)[0] == "spot" and where(window)[-1] == "psf"


def test_only_what_is_on_show_is_computed(window):
    window.store.update(show_rail=False)
    assert set(window.live.views) == {"psf"} and window._visible() == ("psf",)
    window.store.update(stage="mtf", show_rail=True, rail=(), tab="spot")
    assert set(window.live.views) == {"mtf", "spot"}
    window.store.update(windows=("seidel",))
    assert set(window.live.views) == {"mtf", "spot", "seidel"}


def test_a_tab_of_a_panel_on_the_stage_is_not_offered(window):
    window.take_stage("mtf")
    tabs = window.tabs
    assert not tabs.isTabVisible(tabs.indexOf(tabs.pages()["mtf"])) and tabs.current() == "psf"
    window.open_panel("mtf")
    assert where(window)[0] == "mtf" and where(window)[-1] == "psf"


def test_keys_stay_with_the_widget_that_had_them_when_its_panel_moves(window, qtbot):
    box = window.panels["psf"].widget.tools[0]
    box.setFocus()
    qtbot.keyClick(window, "2")
    assert QApplication.focusWidget() is box and where(window)[0] == "pupil"


def test_handles_go_into_the_state_and_survive_a_resize(window, qtbot):
    room = window.room
    QTest.mousePress(room.handle(1), Qt.MouseButton.LeftButton, pos=QPoint(3, 100))
    QTest.mouseMove(room.handle(1), QPoint(-97, 100))
    QTest.mouseRelease(room.handle(1), Qt.MouseButton.LeftButton, pos=QPoint(3, 100))
    before = window.store.state.display.stage_share
    qtbot.waitUntil(lambda: window.store.state.display.stage_share != before)
    share = window.store.state.display.stage_share
    assert share == pytest.approx(before - 100 / (sum(room.sizes())), abs=0.01)
    for size in ((1100, 720), (1440, 900)):
        window.resize(*size)
        QApplication.processEvents()
    assert room.sizes()[0] / sum(room.sizes()) == pytest.approx(share, abs=0.005)
    window.store.undo()
    assert room.sizes()[0] / sum(room.sizes()) == pytest.approx(before, abs=0.005)


def test_the_rail_may_stand_at_the_bottom(window):
    window.store.update(rail_side="bottom", rail=("layout",), rail_shares=(0.3, 0.7))
    QApplication.processEvents()
    stage, first = window.room.stage, window.room.satellites[0]
    assert first.mapTo(window, QPoint()).y() > stage.mapTo(window, QPoint(0, stage.height())).y() - 1
    assert first.width() / window.room.parts.width() == pytest.approx(0.3, abs=0.03)  # of whole pixels and a handle


def test_the_first_lesson_gives_the_psf_three_fifths_of_the_window(window):
    window.resize(1280, 800)
    window.store.replace(shipped_lessons()[0].state(0, new_state(method="seidel", theme="light")))
    QApplication.processEvents()
    card = window.panels["psf"].widget
    try:
        assert (window.width(), window.height()) == (1280, 800)
        assert card.visibleRegion().boundingRect() == card.rect() and window.teaching.panel.isVisible()
        assert card.width() * card.height() >= 0.6 * 1280 * 800
    finally:
        window.resize(1440, 900)
        window.store.undo()


def places(window) -> dict[int, tuple[int, int, int, int]]:
    """Return where every control on show is in the window, but for those that float over the stage."""
    found = {}
    controls = QAbstractButton, QComboBox, QLineEdit, Slider
    for widget in (each for kind in controls for each in window.findChildren(kind)):
        if widget.isVisible() and not window.edge.isAncestorOf(widget) and widget is not window.edge:
            at = widget.mapTo(window, QPoint(0, 0))
            found[id(widget)] = at.x(), at.y(), widget.width(), widget.height()
    return found


@pytest.mark.parametrize("size", [(1280, 800), (1920, 1080)])
def test_a_message_moves_nothing_and_bars_stand_outside_the_panels(window, qtbot, size):
    """An error floats over the line under the stage; A and B and the player stand below stage and rail."""
    window.resize(*size)
    window.store.replace(with_workspace(window.store.state, "explore", WORKSPACES["explore"]))
    at_rest(window, qtbot)
    before, first = places(window), window.store.state
    window.refuse(Message("a depth of {depth}", depth="-5 mm"))
    at_rest(window, qtbot)
    stage, edge = window.room.stage, window.edge
    left = (edge.mapTo(window, QPoint()) - stage.mapTo(window, QPoint())).x()
    assert left >= 0 and left + edge.width() <= stage.width(), "over the stage alone"
    chart = window.panels["psf"].map.chart
    floor = chart.mapTo(window, QPoint(0, chart.height())).y()
    assert edge.mapTo(window, QPoint()).y() >= floor, "and below the picture with its axis"
    after = places(window)
    assert {key: at for key, at in before.items() if key in after and after[key] != at} == {}
    window.store.replace(pin(first))
    window.store.update(playback_slider="field_deg")
    at_rest(window, qtbot)
    for bar in (window.compare, window.play):
        assert bar.isVisible() and bar.height() >= bar.minimumSizeHint().height()
        assert window.rect().contains(bar.mapTo(window, bar.rect().bottomRight()))
        assert bar.mapTo(window, QPoint()).y() >= window.room.mapTo(window, QPoint(0, window.room.height())).y()
    window.store.replace(first)
    at_rest(window, qtbot)
    assert not window.edge.isVisible() and places(window) == before
    window.resize(1440, 900)


def test_the_caption_says_the_state_and_what_moves(window):
    window.store.update(field_deg=9.0, f_number=5.6, wavelength_nm=550.0)
    text = window.caption.text
    live = window.live
    for part in ("9°", "f/5.60", "550 nm", f"RMS {live.pupil.rms:.2g} λ", f"Strehl {float(live.psf.strehl):.2g}"):
        assert part in text
    rest = window.caption._rest
    with window.store.drag():
        window.store.update(field_deg=8.0)
        moved = {name for name, words in window.caption._parts.items() if rest[name] != words}
        assert "field" in moved and not moved & {"lens", "depth", "f_number", "wavelength"}
    assert window.caption._rest == window.caption._parts


def test_the_parts_of_the_caption_are_chosen_and_kept(window):
    menu = window.caption.menu()
    actions = {action.text(): action for action in menu.actions()}
    actions["Wavelength"].trigger()
    assert "wavelength" not in window.store.state.display.caption and "nm" not in window.caption.text
    kept = state_from_json(state_to_json(window.store.state))
    assert kept.display.caption == window.store.state.display.caption


def test_the_caption_is_read_from_the_last_row(window):
    """2.2 % of the screen's height are asked, of its type; and 7:1 between type and ground, WCAG 2.1."""
    least = 0.022 * window.screen().size().height()
    window.presentation.start()
    try:
        for lens in ("cooke_triplet", "telecentric_relay"):
            window.store.replace(default_state(lens))
            QApplication.processEvents()
            parts, size = window.caption.fitted()
            assert size >= least and {"lens", "field", "f_number"} <= set(parts)
    finally:
        window.presentation.stop()
    for theme in ("light", "dark"):
        shades = tokens(theme)
        assert contrast(shades.text, shades.window) >= 7
