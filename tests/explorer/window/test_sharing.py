"""A link and the last session: any state there and back, and nothing else gets in."""

import json
import zlib
from base64 import urlsafe_b64encode

import pytest
from hypothesis import given, settings
from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent, QGuiApplication

from p2sf.errors import P2SFError
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf_explorer.application.main import starting_state
from p2sf_explorer.compute.setup import first_state
from p2sf_explorer.files.session import (
    forget_rescued,
    keep_session,
    last_session,
    rescued_sessions,
    session_path,
)
from p2sf_explorer.files.session_keeper import SessionKeeper
from p2sf_explorer.state.link import PREFIX, link, state_of_link
from p2sf_explorer.state.state import new_state
from tests.explorer.state.test_state import STATES


@pytest.mark.slow
@given(STATES)
@settings(max_examples=50)
def test_a_link_and_back_is_identical_and_url_safe(state):
    text = link(state)
    assert state_of_link(text) == state
    assert all(letter.isascii() and (letter.isalnum() or letter in "-_") for letter in text.removeprefix(PREFIX))


def test_a_link_is_short_and_survives_the_line_breaks_of_a_letter():
    state = new_state(field_deg=7.5, muted=("w22",))
    text = link(state)
    aim = 4 * len('"aim":"paraxial",') / 3  # which every link states, in base 64
    assert len(text) < 120 + aim
    assert len(link(new_state(field_deg=7.5, pinned=new_state(f_number=8.0)))) < 160 + aim
    assert state_of_link(f" {text[:20]}\n  {text[20:]}\n") == state
    assert starting_state([text]) == state


def packed(document) -> str:
    return deflated(json.dumps(document).encode())


def deflated(text: bytes) -> str:
    return PREFIX + urlsafe_b64encode(zlib.compress(text)).decode()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (link(new_state(field_deg=3.0))[:-6], "cut off or changed"),
        (PREFIX, "cut off or changed"),
        (PREFIX + "§§§", "cut off or changed"),
        (packed([]), "contains no state"),
        (packed({"version": 99, "state": {}}), "version 99"),
        (packed({"version": 1, "state": {"magic": 1}}), 'unknown entry "magic"'),
        (packed({"version": 1, "state": {"lens_text": "x" * 5_000_000}}), "cut off or changed"),
        (deflated(b'{"version": 1, "state": ' + b'{"pinned": ' * 300 + b"{}" + b"}" * 301), "nothing pinned in it"),
        (deflated(b"[" * 100_000), "cut off or changed"),
    ],
)
def test_a_bad_link_is_a_sentence(text, words):
    with pytest.raises(P2SFError, match=words):
        state_of_link(text)


def test_copy_and_paste_by_keys(window, qtbot):
    window.store.update(field_deg=4.0, solo=("w31",))
    both = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    window.setFocus()
    qtbot.waitUntil(window.isActiveWindow)
    qtbot.keyClick(window, Qt.Key.Key_C, both)
    text, state = QGuiApplication.clipboard().text(), window.store.state
    assert state_of_link(text) == state
    window.store.update(field_deg=1.0, solo=())
    qtbot.keyClick(window, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
    assert window.store.state == state
    QGuiApplication.clipboard().setText("something else")
    qtbot.keyClick(window, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
    assert window.store.state == state
    assert "no link" in window.banner.text.text().lower()


def test_the_next_start_finds_the_last_window(window):
    keeping = SessionKeeper(window, window.store, lambda: window.floating.open, {})
    window.store.update(field_deg=2.5, method="fitted", tab="mtf")
    kept = window.store.state
    keeping.eventFilter(window, QCloseEvent())
    state, geometry = last_session()
    assert state == kept
    again = SessionKeeper(window, window.store, lambda: window.floating.open, geometry)
    for keeper in (keeping, again):
        window.removeEventFilter(keeper)
        keeper.stop()  # or its thread would write what the next test changes
    window.resize(1440, 900)  # no screen here is that large, so Qt brings the window back inside


GONE = '{"schema": "p2sf-explorer-state", "version": 1, "state": {"lens": "gone"}}'


DEEP = GONE.replace('"gone"', "[" * 980 + "]" * 980)


def test_a_session_whose_lens_is_gone_is_kept_until_it_comes_back(tmp_path):
    """It was written over by the first change in the window that opened without it."""
    lens = tmp_path / "mine.toml"
    lens.write_text(lens_to_toml(find_lens("tessar")))
    state = new_state(lens=str(lens), field_deg=2.0)
    keep_session(state, {})
    lens.rename(tmp_path / "away.toml")
    assert last_session() == (first_state(), {}) and not rescued_sessions()
    keep_session(new_state(), {})
    (tmp_path / "away.toml").rename(lens)
    ((path, kept),) = rescued_sessions().items()
    assert kept == (state, {})
    forget_rescued(path)
    session_path().unlink()


@pytest.mark.parametrize("text", ["", "{", "[]", DEEP, "[" * 100_000])
def test_a_torn_session_costs_only_the_memory(window, text):
    session_path().parent.mkdir(parents=True, exist_ok=True)
    session_path().write_text(text)
    assert last_session() == (first_state(), {})
    session_path().unlink()
