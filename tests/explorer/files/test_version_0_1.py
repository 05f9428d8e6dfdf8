"""States, snapshots, links and sessions that version 0.1 wrote open as they were (written by that version itself)."""

import json
from math import inf

import numpy as np
import pytest

from p2sf_explorer.compute.live import live
from p2sf_explorer.files import session
from p2sf_explorer.files.opening import opened
from p2sf_explorer.state.link import state_of_link
from p2sf_explorer.state.state import ENTRIES, State, entry
from p2sf_explorer.state.state_files import RENAMED, read_state
from tests.support.reference import DATA

FILES = DATA / "version_0_1"
EXPECTED = json.loads((FILES / "expected.json").read_text(encoding="utf-8"))
LINKS = json.loads((FILES / "links.json").read_text(encoding="utf-8"))
SNAPSHOTS = sorted(FILES.glob("snapshot_*.*"))


def entries(state: State) -> dict:
    """Return a state's entries under the names, and as the plain values, that version 0.1 gave them."""
    old = {new: name for name, new in RENAMED.items()}
    return {old.get(name, name): plain(entry(state, name)) for name in ENTRIES}


def plain(value):
    if isinstance(value, State):
        return entries(value)
    if isinstance(value, tuple):
        return [plain(item) for item in value]
    return "inf" if value == inf else value


@pytest.mark.parametrize("name", EXPECTED)
def test_a_state_file_and_a_link_are_the_state_they_were(name):
    for state in (read_state(FILES / f"{name}.json"), state_of_link(LINKS[name])):
        assert entries(state) == EXPECTED[name]


def test_every_entry_of_the_old_state_is_tried_away_from_its_default():
    usual = EXPECTED["plain"] | {"method": "auto"}
    tried = {name for state in EXPECTED.values() for name, value in state.items() if value != usual[name]}
    assert tried == set(usual)


@pytest.mark.parametrize("path", SNAPSHOTS, ids=lambda path: path.name)
def test_a_snapshot_opens_as_its_state(path):
    assert entries(opened(State(), str(path))) == EXPECTED[path.stem.removeprefix("snapshot_")]


@pytest.mark.parametrize("name", ["moved", "by_hand"])
def test_the_picture_of_an_old_snapshot_is_the_same(name):
    """To rounding: sums are ordered otherwise by other linear-algebra libraries."""
    path = FILES / f"snapshot_{name}.npz"
    with np.load(path) as arrays:
        stored = arrays["psf"]
    assert np.allclose(live(opened(State(), str(path))).psf.values, stored, rtol=0, atol=1e-12 * stored.max())


def test_the_last_session_comes_back(monkeypatch):
    monkeypatch.setattr(session, "session_path", lambda: FILES / "window.json")
    state, geometry = session.last_session()
    assert entries(state) == EXPECTED["moved"]
    assert geometry == {"window": "AAAA", "stack": "BBBB"}


def test_infinity_is_written_as_a_word():
    assert EXPECTED["plain"]["depth_mm"] == "inf" and read_state(FILES / "plain.json") is not None
    assert inf not in EXPECTED["plain"].values()
