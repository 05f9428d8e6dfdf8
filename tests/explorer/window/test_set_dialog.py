"""Exporting a set of PSFs from the window: what is offered, asked for, refused, written and cancelled."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from PySide6.QtCore import Qt

from p2sf.errors import P2SFError
from p2sf.lensfile.library import shipped_lenses
from p2sf.messages import Message
from p2sf_explorer.compute.setup import default_state, with_lens
from p2sf_explorer.files.embedded_state import state_inside
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.state.state import change, new_state
from p2sf_explorer.window.commands.set_dialog import SetDialog
from p2sf_explorer.window.commands.set_request import SetTexts, first_texts, read_axes, read_request
from tests.support.tiers import in_tiers

TEXTS = SetTexts("2 m; ∞", "0; 7,5°", "486.1; 587,6 nm", "5 µm", "80 %", "21")


@pytest.fixture
def dialog(window):
    window.commands.ask_set()
    yield window.commands.set_dialog
    window.commands.set_dialog.close()


def fill(dialog: SetDialog, texts: SetTexts) -> None:
    for key, edit in dialog.edits.items():
        edit.setText(getattr(texts, key))


@pytest.mark.parametrize("name", in_tiers(shipped_lenses()))
@pytest.mark.parametrize("language", ["en", "de"])
def test_what_is_offered_first_can_be_made(qapp, name, language):
    set_language(language)
    try:
        state = default_state(name)
        texts = first_texts(state)
        request = read_request(state, texts, "set.npz")
        assert np.prod(request.axes.shape) == np.prod(read_axes(texts).shape)
        assert request.grid.pixels == 65 and request.grid.fill_factor == 1.0
    finally:
        set_language("en")


def test_a_photographic_lens_is_offered_five_of_each_from_infinity_on():
    request = read_request(new_state(), first_texts(new_state()), "set.npz")
    assert request.axes.shape == (5, 5, 3) and request.axes.depths_mm[-1] == inf
    closeness = 1 / np.array(request.axes.depths_mm)
    assert np.diff(closeness) == pytest.approx(np.full(4, -closeness[0] / 4), rel=1e-3), "evenly in 1/distance"


def test_texts_are_read_in_the_units_and_with_either_decimal_sign():
    request = read_request(new_state(), TEXTS, "a.mat")
    assert request.axes.depths_mm == (2000.0, inf) and request.axes.fields_deg == (0.0, 7.5)
    assert request.axes.wavelengths_nm == (486.1, 587.6)
    assert (request.grid.pixel_um, request.grid.fill_factor, request.grid.pixels) == (5.0, pytest.approx(0.8), 21)
    assert read_request(new_state(), SetTexts("1 m", "0", "550", "4", "0.5", "auto"), "a.csv").grid.pixels is None


@pytest.mark.parametrize(
    ("key", "text", "why"),
    [
        ("depths", "soon", "distance"),
        ("depths", " ; ", "one or more"),
        ("depths", "1 m:2 m", "LOW:HIGH:COUNT"),
        ("fields", "0:∞:3", "field angle"),
        ("fields", "95", "field angle"),
        ("wavelengths", "5 mm", "unit"),
        ("pixel", "0", "positive"),
        ("fill", "120 %", "fill factor"),
        ("pixels", "5000", "1 to 1024"),
    ],
)
def test_what_cannot_be_is_said_under_the_fields(dialog, tmp_path, key, text, why):
    fill(dialog, TEXTS)
    dialog.edits[key].setText(text)
    assert not dialog.write(str(tmp_path / "set.npz"))
    assert why in dialog.note.text().lower() or why in dialog.note.text()
    assert not list(tmp_path.iterdir())
    with pytest.raises(P2SFError):
        read_request(new_state(), dialog.texts(), "set.npz")


def test_a_field_is_read_when_it_is_left(dialog, qtbot):
    fill(dialog, TEXTS)
    for text, why in (("soon", "distance"), ("2 m", "")):
        dialog.edits["depths"].setFocus()
        dialog.edits["depths"].setText(text)
        qtbot.keyClick(dialog.edits["depths"], Qt.Key.Key_Tab)
        assert (why in dialog.note.text()) if why else not dialog.note.text()


def test_a_set_is_written_with_its_state_while_the_window_goes_on(window, dialog, qtbot, tmp_path):
    window.store.update(f_number=8.0)
    fill(dialog, TEXTS)
    assert "8" in dialog.count.text()
    path = tmp_path / "set.npz"
    with qtbot.waitSignal(dialog.ended):
        assert dialog.write(str(path))
        assert dialog.bar.isVisible() and not dialog.export.isEnabled()
    with np.load(path) as file:
        assert file["psf"].shape == (2, 2, 2, 21, 21) and float(file["pixel_um"]) == 5.0
    assert state_inside(path).optics.f_number == 8.0 and list(tmp_path.iterdir()) == [path]
    assert "set.npz" in dialog.note.text() and dialog.export.isEnabled() and not dialog.bar.isVisible()


def test_a_cancelled_set_writes_nothing(window, dialog, qtbot, tmp_path):
    fill(dialog, SetTexts("1 m; 2 m; 3 m; 4 m; ∞", "0; 4; 8; 12; 14", "486; 587; 656", "4", "100 %", "65"))
    assert dialog.write(str(tmp_path / "set.npz"))
    dialog.stop_button.click()
    qtbot.waitUntil(lambda: not dialog.worker.busy)
    assert not list(tmp_path.iterdir())
    assert "nothing was written" in dialog.note.text() and dialog.export.isEnabled()


def test_ranges_are_those_of_the_command_line(dialog):
    """Between 1 m and infinity evenly in dioptres: 1, 2/3, 1/3 and 0."""
    fill(dialog, replace(TEXTS, depths="1 m:∞:4", fields="0:14:5; 0,5°", wavelengths="400:700:4"))
    assert [dialog.count.text().count(part) for part in ("4", "6", "96")] == [2, 2, 1]
    axes = read_axes(dialog.texts())
    assert axes.depths_mm == pytest.approx((1000, 1500, 3000, inf))
    assert axes.fields_deg == (0.0, 0.5, 3.5, 7.0, 10.5, 14.0) and axes.wavelengths_nm == (400, 500, 600, 700)


@pytest.mark.parametrize("wrong", ["0:14", "soon", "7;"])
def test_a_list_that_is_wrong_is_not_counted(dialog, wrong):
    fill(dialog, TEXTS)
    assert "8" in dialog.count.text()
    dialog.edits["fields"].setText(wrong)
    assert dialog.count.text() == "" if wrong != "7;" else "4" in dialog.count.text()


def test_what_was_said_is_gone_once_a_field_is_typed_in(dialog):
    fill(dialog, TEXTS)
    dialog.note.setText("old")
    dialog.edits["fields"].setText("0")
    assert not dialog.note.text()


def test_the_end_of_a_cancelled_set_does_not_end_the_next(window, dialog, qtbot, tmp_path):
    fill(dialog, TEXTS)
    first, second = (read_request(window.store.state, TEXTS, str(tmp_path / name)) for name in ("a.npz", "b.npz"))
    dialog._show_running(second)
    dialog._on_failed(first, Message("old"))
    dialog._on_progress(first, 0.7)
    assert dialog.bar.isVisible() and not dialog.export.isEnabled() and not dialog.note.text()
    assert dialog.bar.value() == 0
    dialog._show_running(None)


def test_the_fields_follow_a_lens_that_comes_while_the_dialog_is_open(window, dialog):
    """What nobody typed follows edits too, as of the pixel; what was typed stays for the same lens."""
    window.store.replace(with_lens(window.store.state, "cooke_triplet"))
    dialog.edits["fields"].setText("0; 3")
    window.store.update(pixel_um=6.5)
    assert dialog.texts().pixel.startswith("6.5") and dialog.texts().fields == "0; 3"
    window.store.replace(with_lens(window.store.state, "tessar"))
    assert dialog.texts() == first_texts(window.store.state)


def test_a_set_of_a_misaligned_lens_is_written(window, dialog, qtbot, tmp_path):
    window.store.update(errors=(("decentre_x", 3, 5, 0.1), ("tilt_x", 1, 2, 0.05)))
    fill(dialog, TEXTS)
    with qtbot.waitSignal(dialog.ended):
        assert dialog.write(str(tmp_path / "set.npz"))
    with np.load(tmp_path / "set.npz") as file:
        assert file["psf"].shape == (2, 2, 2, 21, 21) and (file["chief_x_mm"] != 0).all()


def test_the_fields_keep_what_was_typed_until_another_lens_comes(window, dialog):
    fill(dialog, TEXTS)
    window.commands.ask_set()
    assert dialog.texts() == TEXTS
    window.store.replace(change(window.store.state, lens="tessar"))
    window.commands.ask_set()
    assert dialog.texts() != TEXTS


@pytest.mark.parametrize(("key", "text"), [("pixel", "0"), ("fields", "95"), ("pixels", "5000")])
def test_what_is_refused_is_not_counted(dialog, key, text):
    fill(dialog, TEXTS)
    assert "8" in dialog.count.text()
    dialog.edits[key].setText(text)
    assert dialog.count.text() == ""


def test_commas_between_numbers_are_told_what_separates_them():
    with pytest.raises(P2SFError) as caught:
        read_axes(replace(TEXTS, fields="0, 7, 14"))
    assert caught.value.message.values["parameter"] == "fields_deg"
    assert read_axes(replace(TEXTS, fields="0,7")).fields_deg == (0.7,)


def test_a_long_note_is_shown_whole(dialog):
    dialog._say("\n".join(["what was saved, beside what, and what is to be said of it"] * 6))
    assert dialog.note.height() >= dialog.note.heightForWidth(dialog.note.width())
