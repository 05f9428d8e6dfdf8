"""Where panels stand: whatever is moved, every panel has one place and nobody is lost."""

import random

import pytest

from p2sf.errors import P2SFError
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.state import State, change, new_state
from p2sf_explorer.state.state_files import state_from_json, state_to_json
from p2sf_explorer.state.workspaces import (
    WORKSPACES,
    arrangement,
    exchange,
    kept_in_rail,
    on_stage,
    place_panels,
    put_to_tabs,
    with_workspace,
)

PANELS = tuple(entry.key for entry in REGISTRY)


def shown(display) -> tuple[str, ...]:
    """Return the panels in their places: stage, rail, tab."""
    return (display.stage, *display.rail, display.tab)


@pytest.mark.parametrize("name", WORKSPACES)
def test_a_workspace_names_panels_there_are_and_survives_file_and_link(name):
    state = with_workspace(new_state(field_deg=3.0, windows=("spot",)), name, WORKSPACES[name])
    assert place_panels(state.display, PANELS) == state.display, "each in one place already"
    assert state.display.windows == ("spot",) and state.display.workspace == name
    for again in (state_from_json(state_to_json(state)), state_of_link(link(state))):
        assert again == state and arrangement(again.display) == WORKSPACES[name]


def test_the_first_state_is_the_first_workspace():
    """What a file of an older version leaves out is that of `State`."""
    assert arrangement(State().display) == WORKSPACES[State().display.workspace]


@pytest.mark.parametrize("seed", range(40))
def test_random_moves_lose_no_panel_and_show_none_twice(seed):
    chance, display = random.Random(seed), place_panels(State().display, PANELS)
    for _ in range(40):
        move = chance.choice([exchange, on_stage, kept_in_rail, put_to_tabs])
        panel, other = chance.choice(PANELS), chance.choice(shown(display))
        made = move(display, panel, other) if move is exchange else move(display, panel)
        before, display = display, place_panels(change(State(display=display), **made).display, PANELS)
        assert len(set(shown(display))) == len(shown(display)), (move, panel, other, before)
        if move is on_stage:
            assert display.stage == panel
            assert before.stage in shown(display), "what it displaced is still on show"
        if move is exchange:
            assert len(display.rail) == len(before.rail) and panel in shown(display)


def test_a_panel_and_the_stage_change_places():
    display = place_panels(new_state(rail=("layout", "pupil"), tab="mtf").display, PANELS)
    assert on_stage(display, "pupil") == {"stage": "pupil", "rail": ("layout", "psf"), "tab": "mtf", "windows": ()}
    assert on_stage(display, "mtf")["tab"] == "psf" and on_stage(display, "mtf")["rail"] == display.rail
    behind = on_stage(display, "spot")
    assert (behind["stage"], behind["tab"]) == ("spot", "psf"), "no place was free but the front of the tabs"
    assert exchange(display, "layout", "pupil")["rail"] == ("pupil", "layout")
    assert on_stage(display, "psf") == {}


def test_the_stage_takes_a_panel_back_from_its_window():
    display = place_panels(new_state(windows=("mtf", "spot")).display, PANELS)
    assert on_stage(display, "mtf")["windows"] == ("spot",)


@pytest.mark.parametrize(
    "odd",
    [
        {"stage": "nothing", "rail": ("psf", "psf", "gone", "mtf"), "tab": "mtf"},
        {"stage": "profiles", "tab": "profiles"},
        {"rail": PANELS[:-1]},
    ],
)
def test_a_file_may_say_anything_of_panels(odd):
    display = place_panels(new_state(**odd).display, PANELS)
    assert set(shown(display)) <= set(PANELS) and len(set(shown(display))) == len(shown(display))
    assert place_panels(display, PANELS) == display


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"rail": "psf"}, "rail must be a list"),
        ({"rail": (1,)}, "rail must be a list"),
        ({"rail_shares": 0.5}, "rail_shares"),
        ({"rail_shares": (0.5, 2.0)}, "share of a panel beside the stage is 2"),
        ({"rail_shares": (float("nan"),)}, "nan"),
        ({"stage_share": 0.0}, "share of the stage"),
        ({"rail_side": "left"}, "rail_side"),
        ({"scale_percent": 10.0}, "size of type is 10%|size of type is 10 %"),
        ({"show_rail": 1}, "show_rail"),
        ({"stage": 3}, "stage"),
    ],
)
def test_what_cannot_be_is_a_sentence(wrong, words):
    with pytest.raises(P2SFError, match=words):
        new_state(**wrong)
