"""The stored pictures of README and handbook show what the window shows, and each is used."""

import re
from pathlib import Path

import pytest

from p2sf_explorer.handbook.pages import FOLDER
from p2sf_explorer.site.handbook_pictures import PICTURES, PLOTS, WINDOWS, differing, of_plot

ROOT = Path(__file__).parents[3]

BY_BENCHMARKS = {"price_of_a_default.png"}  # of other programs too; `tests.benchmarks.image_simulation` draws it


def test_every_stored_picture_is_on_a_page_and_is_made_by_the_command():
    pages = [ROOT / "README.md", *FOLDER.rglob("*.md")]
    shown = {name for page in pages for name in re.findall(r"pictures/([\w.]+)\)", page.read_text(encoding="utf-8"))}
    assert {path.name for path in PICTURES.iterdir()} == shown == {*WINDOWS, *PLOTS, *BY_BENCHMARKS}


def test_a_plot_of_another_lens_or_command_has_another_hash(monkeypatch):
    before = {name: of_plot(name) for name in PLOTS}
    assert len(set(before.values())) == len(PLOTS)
    monkeypatch.setattr("p2sf_explorer.site.handbook_pictures.LENS", "tessar")
    assert of_plot("sampling.png") != before["sampling.png"]


@pytest.mark.slow
def test_stored_pictures_show_what_the_window_shows_now(only_window):
    assert differing() == []


@pytest.mark.slow
def test_a_window_without_a_panel_differs(only_window, monkeypatch):
    from p2sf_explorer.site import handbook_pictures
    from p2sf_explorer.state.state import change

    fewer = {name: change(state, show_rail=False) for name, state in WINDOWS.items()}
    monkeypatch.setattr(handbook_pictures, "WINDOWS", fewer)
    assert differing() == list(WINDOWS)
