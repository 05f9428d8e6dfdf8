"""Every command by name and key: palette, help, and the choices of stop, clip, colours and theme."""

import re

import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QApplication, QWidget

from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf_explorer.compute.setup import shipped_names, title, with_lens
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.what_if import PRESETS
from p2sf_explorer.widgets.command import Command
from p2sf_explorer.window.commands.command_palette import Palette, full_name, rank, score
from p2sf_explorer.window.commands.help import HelpPage
from tests.support.lenses.zooms import focusing_zoom
from tests.support.windows.events import choose


@pytest.mark.parametrize(
    ("sought", "texts", "first"),
    [
        ("psf", ["Spot diagram of fields", "Panel: PSF"], 1),
        ("fm", ["Film…", "Field map"], 1),
        ("cook", ["Copy the look", "Lens: Cooke triplet"], 1),
        ("UNDO", ["Steps: Undo"], 0),
        ("spr", ["Vorgabe: Sphärisch, Randfokus", "Sprache: Deutsch"], 1),
        ("casse", ["Lens: Maksutov-Cassegrain", "Lens: Cassegrain telescope f/10, 200 mm"], 1),
        ("", ["first", "second"], 0),
    ],
)
def test_a_few_letters_find_what_is_meant(sought, texts, first):
    assert rank(sought, texts)[0] == first


def test_scattered_letters_are_no_hit_where_a_whole_word_is():
    scattered = "Lens: Microscope, telephoto, fisheye"
    assert rank("mtf", [scattered, "Panel: MTF", "Panel: MTFs of fields"]) == [1, 2]
    assert rank("mtf", [scattered]) == [0], "without a whole word letters in their order do"


def test_letters_that_are_not_there_in_their_order_find_nothing():
    assert score("fsp", "PSF") is None and rank("xyz", ["PSF"]) == []


def test_no_two_commands_answer_to_the_same_key(window):
    keys = [QKeySequence(key).toString() for command in window.commands.commands for key in command.keys]
    assert len(keys) == len(set(keys)) and all(keys)


def test_the_palette_lists_every_panel_lens_and_preset(window):
    listed = {command.title for command in window.commands.everything()}
    assert listed >= {entry.title for entry in REGISTRY}
    assert listed >= {title(name) for name in shipped_names()} | {preset.title for preset in PRESETS}


def test_no_command_says_its_group_twice(window):
    names = [full_name(command) for command in window.commands.everything()]
    assert not [name for name in names if name.split(": ")[1].startswith(name.split(": ")[0])]


def test_typing_and_enter_do_what_is_found(window, qtbot):
    qtbot.keyClick(window, Qt.Key.Key_K, Qt.KeyboardModifier.ControlModifier)
    palette = window.commands.palette
    assert palette.isVisible()
    qtbot.keyClicks(palette.sought, "cooke")
    assert "Cooke triplet" in palette.found.item(0).text()
    qtbot.keyClick(palette.sought, Qt.Key.Key_Return)
    assert window.store.state.optics.lens == "cooke_triplet" and not palette.isVisible()
    window.commands.find()
    qtbot.keyClicks(palette.sought, "panel mtf")
    qtbot.keyClick(palette.sought, Qt.Key.Key_Return)
    assert window.store.state.display.tab == "mtf"


def test_the_first_word_of_a_lens_s_title_finds_that_lens(window):
    window.commands.find()
    palette, words = window.commands.palette, [title(name) for name in shipped_names()]
    first = [re.match(r"\w+", text)[0] for text in words]
    for word, text in zip(first, words, strict=True):
        if first.count(word) == 1:
            palette.sought.setText(f"lens {word}")
            assert text in palette.found.item(0).text()
    palette.hide()


def test_arrows_choose_and_escape_goes_back(window, qtbot):
    before = window.store.state
    window.commands.find()
    palette = window.commands.palette
    qtbot.keyClicks(palette.sought, "theme")
    qtbot.keyClick(palette.sought, Qt.Key.Key_Down)
    assert palette.found.currentRow() == 1
    qtbot.keyClick(palette.sought, Qt.Key.Key_Escape)
    assert not palette.isVisible() and window.store.state == before
    window.commands.find()
    qtbot.keyClicks(palette.sought, "qqqq")
    qtbot.keyClick(palette.sought, Qt.Key.Key_Return)
    assert window.store.state == before
    palette.hide()


def test_the_question_mark_lists_every_key(window, qtbot):
    qtbot.keyClick(window, Qt.Key.Key_Question)
    page = window.findChild(HelpPage)
    lines = page.text.toPlainText()
    for command in window.commands.commands:
        assert not command.keys or (command.title in lines and all(key in lines for key in command.keys))
    assert page.height() <= page.screen().availableGeometry().height()
    window.commands.help()
    assert window.findChildren(HelpPage) == [page], "asked again, the one page comes to the front"
    qtbot.keyClick(page, Qt.Key.Key_Escape)
    assert not page.isVisible()


def test_stop_aim_and_clip_tell_the_store_and_follow_it(window, qtbot):
    row, filled = window.controls.stopping, window.controls.aiming.aim
    usual = window.store.state.optics.aim
    filled.setCurrentIndex(1 - filled.currentIndex())
    filled.activated.emit(filled.currentIndex())
    assert window.store.state.optics.aim == window.live.setup.lens.aim == filled.currentData() != usual
    window.store.undo()
    assert filled.currentData() == window.live.setup.lens.aim == usual
    choose(row.stop, "auto")
    assert window.store.state.optics.stop == "auto"
    qtbot.mouseClick(row.clip, Qt.MouseButton.LeftButton, pos=QPoint(8, row.clip.height() // 2))
    assert window.store.state.optics.clip
    window.store.undo()
    window.store.undo()
    assert not row.clip.isChecked() and row.stop.currentData() == "file"


def test_a_held_arrow_key_is_one_step_of_undo(window, qtbot):
    first, slider = window.store.state, window.controls.rows["field_deg"].slider
    slider.setFocus()
    qtbot.keyPress(slider, Qt.Key.Key_Right)
    for _ in range(9):  # what a keyboard sends while the key is down
        event = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_Right, Qt.KeyboardModifier.NoModifier, "", True)
        QApplication.sendEvent(slider, event)
    assert window.live.quality == "preview"
    qtbot.keyRelease(slider, Qt.Key.Key_Right)
    assert window.live.quality == "settled"
    assert window.store.state.optics.field_deg > first.optics.field_deg + 0.5
    window.store.undo()
    assert window.store.state == first


def reachable(window) -> list:
    """Return every widget that Tab comes by, in its order."""
    found, at = [], window.nextInFocusChain()
    while at is not window:
        if at.focusPolicy() & Qt.FocusPolicy.TabFocus and at.isVisibleTo(window) and at.isEnabled():
            found.append(at)
        at = at.nextInFocusChain()
    return found


def test_every_control_is_reached_by_tab_and_shows_its_focus(window):
    window.store.replace(with_lens(window.store.state, "double_gauss_28", lens_to_toml(focusing_zoom())))
    # For these every row is shown.
    window.store.update(show_pupil_shape=True, blades=6, vanes=3, apodisation=0.8, show_field_x=True)
    window.store.update(field_deg=11.0)
    window.store.undo()  # so that Redo is enabled
    chain = reachable(window)
    for row in window.controls.rows.values():
        assert row.slider in chain and row.edit in chain
    for button in (window.top.lens, window.top.method, window.top.more, window.controls.stopping.clip):
        assert button in chain
    for widget in (window.controls.rows["field_deg"].slider, window.top.more, window.controls.stopping.clip):
        widget.clearFocus()
        before = widget.grab().toImage()
        widget.setFocus(Qt.FocusReason.TabFocusReason)
        QApplication.processEvents()
        assert widget.grab().toImage() != before, type(widget).__name__
        widget.clearFocus()


def test_a_command_is_found_by_its_english_name_in_any_language(qapp):
    ran = []
    set_language("de")
    try:
        parent = QWidget()
        parent.resize(800, 700)
        palette = Palette(parent)
        commands = tuple(Command(title, lambda title=title: ran.append(title), (), "Language") for title in ("A", "B"))
        palette.open_with(commands)
        shown = [palette.found.item(k).text() for k in range(palette.found.count())]
        assert shown == ["Sprache: A", "Sprache: B"], "each once, in the language of the window"
        palette.sought.setText("language b")
        assert palette.found.item(0).text() == "Sprache: B"
        palette.take()
        assert ran == ["B"]
        palette.sought.setText("xyzzy")
        palette.take()
        assert ran == ["B"] and not palette.found.item(0).flags(), "the sentence that nothing fits is no command"
    finally:
        set_language("en")
        palette.close()
