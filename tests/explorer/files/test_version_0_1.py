"""States, snapshots, links and sessions that version 0.1 wrote open as they were (written by that version itself)."""

import json
from math import inf

import numpy as np
import pytest

from p2sf.lens.lens import AIMS
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.files import session
from p2sf_explorer.files.opening import open_file
from p2sf_explorer.state.link import state_of_link
from p2sf_explorer.state.state import ENTRIES, State, change, entry
from p2sf_explorer.state.state_files import RENAMED, read_state
from tests.support.reference import DATA

FILES = DATA / "version_0_1"
EXPECTED = json.loads((FILES / "expected.json").read_text(encoding="utf-8"))
for state in EXPECTED.values():  # as version 0.1 wrote them, when rays always filled the paraxial pupil
    for side in (state, state["pinned"] or {}):
        side["aim"] = "paraxial"
OLD = {new: name for name, new in RENAMED.items()}  # the names that version 0.1 gave the entries it knew
NEWER = {name for name in ENTRIES if OLD.get(name, name) not in EXPECTED["plain"]}
LINKS = json.loads((FILES / "links.json").read_text(encoding="utf-8"))
SNAPSHOTS = sorted(FILES.glob("snapshot_*.*"))


def entries(state: State) -> dict:
    """Return a state's entries under the names, and as the plain values, that version 0.1 gave them.

    What it did not know, such as a stage, is as at the first start.
    """
    assert all(entry(state, name) == entry(State(), name) for name in NEWER)
    return {OLD.get(name, name): plain(entry(state, name)) for name in ENTRIES if name not in NEWER}


def test_the_stage_is_among_what_it_did_not_know():
    assert {"stage", "rail", "workspace", "scale_percent"} <= NEWER and "tab" not in NEWER


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
    assert tried == set(usual) - {"aim"}  # which it did not know


@pytest.mark.parametrize("path", SNAPSHOTS, ids=lambda path: path.name)
def test_a_snapshot_opens_as_its_state(path):
    assert entries(open_file(State(), str(path))) == EXPECTED[path.stem.removeprefix("snapshot_")]


@pytest.mark.parametrize("name", ["moved", "by_hand"])
def test_the_picture_of_an_old_snapshot_is_the_same(name, glasses_of_version_0_1):
    """To what settled sums promise, 1e-4 of the picture in the mean square: other nodes carry the same pupil."""
    found, stored = picture(name)
    assert np.linalg.norm(found - stored) < 1e-4 * np.linalg.norm(stored)


@pytest.mark.parametrize("name", ["moved", "by_hand"])
def test_better_glass_data_change_the_picture_of_an_old_snapshot_little(name):
    """By 1e-8 in the index; a few 1e-6 of the peak (measured 2.3e-6)."""
    found, stored = picture(name)
    assert np.allclose(found, stored, rtol=0, atol=1e-5 * stored.max())


def picture(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Return a snapshot's PSF as it opens now, and as it was stored."""
    path = FILES / f"snapshot_{name}.npz"
    with np.load(path) as arrays:
        stored = arrays["psf"]
    return live(open_file(State(), str(path))).psf.values, stored


@pytest.mark.parametrize("path", SNAPSHOTS, ids=lambda path: path.name)
def test_rays_fill_the_paraxial_pupil_of_an_old_snapshot(path):
    state = open_file(State(), str(path))
    assert paraxial_setup(state).lens.aim == "paraxial"
    assert state.compare.pinned is None or paraxial_setup(state.compare.pinned).lens.aim == "paraxial"


def test_the_exact_picture_of_an_old_state_is_that_of_the_paraxial_pupil():
    """To rounding; the real stop makes another picture of the same state."""
    state = change(read_state(FILES / "moved.json"), method="traced")
    pictures = {aim: live(change(state, aim=aim)).psf.values for aim in AIMS}
    peak = pictures["paraxial"].max()
    assert np.array_equal(live(state).psf.values, pictures["paraxial"])
    assert np.abs(pictures["stop"] - pictures["paraxial"]).max() > 1e-4 * peak


def test_the_last_session_comes_back(monkeypatch):
    monkeypatch.setattr(session, "session_path", lambda: FILES / "window.json")
    state, geometry = session.last_session()
    assert entries(state) == EXPECTED["moved"]
    assert geometry == {"window": "AAAA", "stack": "BBBB"}


def test_infinity_is_written_as_a_word():
    assert EXPECTED["plain"]["depth_mm"] == "inf" and read_state(FILES / "plain.json") is not None
    assert inf not in EXPECTED["plain"].values()
