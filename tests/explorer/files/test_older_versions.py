"""States, snapshots, links and sessions of older versions open as they were; those versions wrote them.

``tests/data/older_versions/write.py`` says which versions these are, and by which commands they wrote the files.
"""

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

FILES = DATA / "older_versions"
OLDEST = FILES / "0.1"
OLD = {new: name for name, new in RENAMED.items()}  # the names that version 0.1 gave the entries it knew
TOLD = {version: json.loads((FILES / version / "expected.json").read_text("utf-8")) for version in ("0.2.1", "0.3.0")}


def of_groups(groups: dict) -> dict:
    """Return the entries of a state's groups, as versions since 0.2 write them, in one table by their names today."""
    entries = {name: groups[group][part] for name, (group, part) in ENTRIES.items() if part in groups.get(group, {})}
    assert len(entries) == sum(map(len, groups.values()))
    return entries | {"pinned": entries["pinned"] and of_groups(entries["pinned"])}


def of_the_first(entries: dict) -> dict:
    """Return the entries of a state of version 0.1 by their names today; rays always filled the paraxial pupil."""
    named = {RENAMED.get(name, name): value for name, value in entries.items()} | {"aim": "paraxial"}
    return named | {"pinned": named["pinned"] and of_the_first(named["pinned"])}


EXPECTED = {
    "0.1": {
        name: of_the_first(entries)
        for name, entries in json.loads((OLDEST / "expected.json").read_text(encoding="utf-8")).items()
    }
} | {version: {name: of_groups(groups) for name, groups in told["states"].items()} for version, told in TOLD.items()}
LINKS = {version: json.loads((FILES / version / "links.json").read_text("utf-8")) for version in EXPECTED}
STATES = [(version, name) for version, states in EXPECTED.items() for name in states]
SNAPSHOTS = sorted(path for path in FILES.glob("*/snapshot_*.*") if path.suffix != ".json")
PICTURES = [(version, name) for version, told in TOLD.items() for name in told["pictures"]]
each_version = pytest.mark.parametrize("version", EXPECTED)


def version_of(path):
    return path.parent.name


def newer(version: str) -> set:
    """Return the entries that a version did not know."""
    return set(ENTRIES) - set(EXPECTED[version]["plain"])


def entries(state: State, version: str) -> dict:
    """Return a state's entries that a version knew, as plain values.

    What it did not know, such as a stage, is as at the first start.
    """
    assert all(entry(state, name) == entry(State(), name) for name in newer(version))
    return {name: plain(entry(state, name), version) for name in EXPECTED[version]["plain"]}


def plain(value, version):
    if isinstance(value, State):
        return entries(value, version)
    if isinstance(value, tuple):
        return [plain(item, version) for item in value]
    return "inf" if value == inf else value


def test_the_stage_is_among_what_the_first_version_did_not_know():
    assert {"stage", "rail", "workspace", "scale_percent"} <= newer("0.1") and "tab" not in newer("0.1")
    assert "caption" in newer("0.2.1") - newer("0.3.0")


@pytest.mark.parametrize(("version", "name"), STATES)
def test_a_state_file_and_a_link_are_the_state_they_were(version, name):
    for state in (read_state(FILES / version / f"{name}.json"), state_of_link(LINKS[version][name])):
        assert entries(state, version) == EXPECTED[version][name]


@each_version
def test_every_entry_of_the_old_state_is_tried_away_from_its_default(version):
    usual = EXPECTED[version]["plain"] | {"method": "auto"}
    tried = {name for state in EXPECTED[version].values() for name, value in state.items() if value != usual[name]}
    assert tried == set(usual) - ({"aim"} if version == "0.1" else set())  # which it did not know


@pytest.mark.parametrize("path", SNAPSHOTS, ids=lambda path: f"{version_of(path)}-{path.name}")
def test_a_snapshot_opens_as_its_state(path):
    state = entries(open_file(State(), str(path)), version_of(path))
    assert state == EXPECTED[version_of(path)][path.stem.removeprefix("snapshot_")]


@pytest.mark.parametrize(("version", "name"), PICTURES)
def test_the_picture_of_an_old_state_is_the_same(version, name):
    """To what settled sums promise, 1e-4 of the picture in the mean square: other nodes carry the same pupil."""
    told = TOLD[version]["pictures"][name]
    psf = live(as_then(read_state(FILES / version / f"{name}.json"))).psf
    middle = psf.values.shape[0] // 2
    found, stored = psf.values[middle - 4 : middle + 4, middle - 4 : middle + 4], np.array(told["middle"])
    assert psf.pixel_um == pytest.approx(told["pixel_um"], rel=1e-12)
    assert np.linalg.norm(found - stored) < 1e-4 * np.linalg.norm(stored)


@pytest.mark.parametrize("name", ["moved", "by_hand"])
def test_the_picture_of_the_oldest_snapshot_is_the_same(name, glasses_of_version_0_1):
    """To what settled sums promise, 1e-4 of the picture in the mean square: other nodes carry the same pupil."""
    found, stored = picture(name)
    assert np.linalg.norm(found - stored) < 1e-4 * np.linalg.norm(stored)


@pytest.mark.parametrize("name", ["moved", "by_hand"])
def test_better_glass_data_change_the_picture_of_an_old_snapshot_little(name):
    """By 1e-8 in the index; a few 1e-6 of the peak (measured 2.3e-6)."""
    found, stored = picture(name)
    assert np.allclose(found, stored, rtol=0, atol=1e-5 * stored.max())


def picture(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the PSF of a snapshot of version 0.1 as it opens now, and as it was stored."""
    path = OLDEST / f"snapshot_{name}.npz"
    with np.load(path) as arrays:
        stored = arrays["psf"]
    return live(as_then(open_file(State(), str(path)))).psf.values, stored


def as_then(state: State) -> State:
    """Return a state with the fit that `auto` took; exact rays, which it may take now, are 1.4e-4 of a picture off."""
    return change(state, method="fitted") if entry(state, "method") == "auto" else state


@pytest.mark.parametrize("path", sorted(OLDEST.glob("snapshot_*.*")), ids=lambda path: path.name)
def test_rays_fill_the_paraxial_pupil_of_an_old_snapshot(path):
    state = open_file(State(), str(path))
    assert paraxial_setup(state).lens.aim == "paraxial"
    assert state.compare.pinned is None or paraxial_setup(state.compare.pinned).lens.aim == "paraxial"


def test_the_exact_picture_of_an_old_state_is_that_of_the_paraxial_pupil():
    """To rounding; the real stop makes another picture of the same state."""
    state = change(read_state(OLDEST / "moved.json"), method="traced")
    pictures = {aim: live(change(state, aim=aim)).psf.values for aim in AIMS}
    peak = pictures["paraxial"].max()
    assert np.array_equal(live(state).psf.values, pictures["paraxial"])
    assert np.abs(pictures["stop"] - pictures["paraxial"]).max() > 1e-4 * peak


def test_the_last_session_comes_back(monkeypatch):
    monkeypatch.setattr(session, "session_path", lambda: OLDEST / "window.json")
    state, geometry = session.last_session()
    assert entries(state, "0.1") == EXPECTED["0.1"]["moved"]
    assert geometry == {"window": "AAAA", "stack": "BBBB"}


def test_infinity_is_written_as_a_word():
    assert EXPECTED["0.1"]["plain"]["depth_mm"] == "inf" and read_state(OLDEST / "plain.json") is not None
    assert inf not in EXPECTED["0.1"]["plain"].values()
