"""What is in view at once on a small screen, and tools that are seen while a hand is near."""

import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QEnterEvent
from PySide6.QtWidgets import QApplication

from p2sf_explorer.compute.setup import first_state
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.state.state import change
from p2sf_explorer.widgets.quiet import is_seen
from p2sf_explorer.window.window import MainWindow
from tests.support.windows import in_view
from tests.support.windows.windows import at_rest

CONTROLS, WORDS = 22, 70  # a person can take in


@pytest.fixture(params=["en", "de"])
def first_look(request, qtbot):
    """Return the first window at 1280 × 800 after a first touch."""
    set_language(request.param)
    try:
        made = MainWindow(change(first_state(), language=request.param), measured=False)
        made.resize(1280, 800)
        made.show()
        made.store.update(field_deg=13.0)
        at_rest(made, qtbot)
        yield made
        made.close()
    finally:
        set_language("en")


def test_few_controls_and_words_are_in_view_at_first(first_look):
    assert len(in_view.controls(first_look)) <= CONTROLS
    assert len(in_view.words(first_look)) <= WORDS


def come_and_go(widget, kind: QEvent.Type) -> None:
    """Have the pointer come over a widget, or leave it."""
    middle = QPointF(widget.rect().center())
    event = QEnterEvent(middle, middle, middle) if kind == QEvent.Type.Enter else QEvent(kind)
    widget.setAttribute(Qt.WidgetAttribute.WA_UnderMouse, kind == QEvent.Type.Enter)  # as Qt does before it tells
    QApplication.sendEvent(widget, event)


def test_tools_are_seen_under_the_pointer_and_keep_their_room(window):
    panel = window.panels["psf"]
    place = panel.scale.geometry()
    assert not is_seen(panel.scale) and panel.scale.isVisible()
    come_and_go(panel.widget, QEvent.Type.Enter)
    assert is_seen(panel.scale) and is_seen(panel.widget.apart)
    come_and_go(panel.widget, QEvent.Type.Leave)
    assert not is_seen(panel.scale) and panel.scale.geometry() == place


def test_tools_are_seen_while_the_focus_is_among_them(window, qtbot):
    row = window.controls.rows["f_number"]
    [button] = row.buttons
    assert not is_seen(button)
    row.edit.setFocus(Qt.FocusReason.TabFocusReason)
    assert is_seen(button)
    window.controls.rows["depth_mm"].slider.setFocus()
    assert not is_seen(button)


def test_the_mixer_shows_its_sliders_where_they_are_in_use(window, qtbot):
    mixer = window.panels["coefficients"].bars
    at_rest_picture = mixer.grab().toImage()
    assert not mixer.tools_shown
    come_and_go(mixer, QEvent.Type.Enter)
    assert mixer.tools_shown and mixer.grab().toImage() != at_rest_picture
    come_and_go(mixer, QEvent.Type.Leave)
    assert mixer.grab().toImage() == at_rest_picture
    window.store.update(solo=("w31",))
    assert mixer.tools_shown


def test_the_button_under_the_picture_plays_the_slider_moved_last(window, qtbot, drag):
    drag(window.controls.rows["wavelength_nm"].slider, 0.3)
    qtbot.mouseClick(window.foot.play, Qt.MouseButton.LeftButton)
    assert window.play.player.playing and window.store.state.playback.slider == "wavelength_nm"
    assert not window.foot.play.isVisible(), "the player's own button stands in its bar"
    window.play.put_away()
    assert window.foot.play.isVisible() and not window.play.player.playing
