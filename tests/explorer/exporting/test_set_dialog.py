"""Exporting a set of PSFs from the window: what is offered, asked for, refused, written and cancelled."""

from math import inf

import numpy as np
import pytest
from PySide6.QtCore import Qt

from p2sf.errors import P2SFError
from p2sf.lensfile.library import shipped_lenses
from p2sf_explorer.compute.setup import default_state
from p2sf_explorer.exporting.set_dialog import SetDialog
from p2sf_explorer.exporting.set_request import SetTexts, count_of, first_texts, read_request
from p2sf_explorer.files.snapshot import side_car
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.state.state import changed, new_state
from p2sf_explorer.state.state_files import read_state

TEXTS = SetTexts("2 m; ∞", "0; 7,5°", "486.1; 587,6 nm", "5 µm", "80 %", "21")


@pytest.fixture
def dialog(window):
    window.commands.ask_set()
    yield window.commands.set_dialog
    window.commands.set_dialog.close()


def fill(dialog: SetDialog, texts: SetTexts) -> None:
    for key, edit in dialog.edits.items():
        edit.setText(getattr(texts, key))


@pytest.mark.parametrize("name", shipped_lenses())
@pytest.mark.parametrize("language", ["en", "de"])
def test_what_is_offered_first_can_be_made(qapp, name, language):
    set_language(language)
    try:
        state = default_state(name)
        texts = first_texts(state)
        request = read_request(state, texts, "set.npz")
        assert np.prod(request.axes.shape) == count_of(texts)
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
        ("depths", " ; ", "at least"),
        ("fields", "95", "field angle"),
        ("wavelengths", "5 mm", "unit"),
        ("pixel", "0", "pitch"),
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
    with qtbot.waitSignal(dialog.ended, timeout=60000):
        assert dialog.write(str(path))
        assert dialog.bar.isVisible() and not dialog.export.isEnabled()
    with np.load(path) as file:
        assert file["psf"].shape == (2, 2, 2, 21, 21) and float(file["pixel_um"]) == 5.0
    assert read_state(str(side_car(path))).optics.f_number == 8.0
    assert "set.npz" in dialog.note.text() and dialog.export.isEnabled() and not dialog.bar.isVisible()


def test_a_cancelled_set_writes_nothing(window, dialog, qtbot, tmp_path):
    fill(dialog, SetTexts("1 m; 2 m; 3 m; 4 m; ∞", "0; 4; 8; 12; 14", "486; 587; 656", "4", "100 %", "65"))
    assert dialog.write(str(tmp_path / "set.npz"))
    dialog.stop_button.click()
    qtbot.waitUntil(lambda: not dialog.worker.busy, timeout=60000)
    assert not list(tmp_path.iterdir())
    assert "nothing was written" in dialog.note.text() and dialog.export.isEnabled()


def test_the_fields_keep_what_was_typed_until_another_lens_comes(window, dialog):
    fill(dialog, TEXTS)
    window.commands.ask_set()
    assert dialog.texts() == TEXTS
    window.store.replace(changed(window.store.state, lens="tessar"))
    window.commands.ask_set()
    assert dialog.texts() != TEXTS
