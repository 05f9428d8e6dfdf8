"""A snapshot reopened is the same state, and its data the PSF that was on screen."""

import numpy as np
import pytest

from app.__main__ import starting_state
from app.display import display_problem
from app.state import read_state
from p2sf.export import read_psf


@pytest.fixture
def busy(window):
    window.store.update(depth_mm=3000.0, focus_mm=3000.0, field_deg=7.25, psf_scale="log", f_number=5.6, theme="dark")
    return window


@pytest.mark.parametrize("ending", [".npz", ".tiff", ".csv", ".png", ".json"])
def test_the_state_beside_a_snapshot_reopens_identically(busy, tmp_path, ending):
    path = tmp_path / f"shot{ending}"
    assert busy.actions.save(str(path))
    assert path.stat().st_size > 0
    assert starting_state([str(tmp_path / "shot.json")]) == busy.store.state
    before = busy.store.state
    busy.store.update(field_deg=1.0)
    assert busy.actions.open_path(str(tmp_path / "shot.json"))
    assert busy.store.state == before


@pytest.mark.parametrize("ending", [".npz", ".csv"])
def test_the_data_is_the_psf_on_screen(busy, tmp_path, ending):
    busy.actions.save(str(tmp_path / f"shot{ending}"))
    psf, _ = read_psf(tmp_path / f"shot{ending}")
    assert np.array_equal(psf.values, busy.live.psf.values)
    assert psf.pixel_um == busy.live.psf.pixel_um


def test_the_side_car_names_the_versions(busy, tmp_path):
    busy.actions.save(str(tmp_path / "shot.png"))
    assert '"versions"' in (tmp_path / "shot.json").read_text()
    assert read_state(tmp_path / "shot.json") == busy.store.state


def test_a_place_that_cannot_be_written_is_a_sentence(busy, tmp_path):
    assert not busy.actions.save(str(tmp_path / "no" / "shot.npz"))
    assert busy.banner.isVisible()


def test_no_display_is_a_sentence_and_a_display_is_none():
    assert "no display" in display_problem({}, "linux")
    assert display_problem({"WAYLAND_DISPLAY": "wayland-0"}, "linux") is None
    assert display_problem({"QT_QPA_PLATFORM": "offscreen"}, "linux") is None
    assert display_problem({}, "darwin") is None
