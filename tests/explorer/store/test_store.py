"""Undo and redo over whatever is done."""

import random

import pytest

from p2sf_explorer.playback.sweep import changes, sweep
from p2sf_explorer.state.limits import CHOICES, LINKABLE, PLAYABLE
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.pinning import link_toggled, pin, swap, unpin
from p2sf_explorer.state.state import State
from p2sf_explorer.state.terms import TERMS
from p2sf_explorer.state.what_if import PRESETS, UNTOUCHED, of_preset, toggle
from p2sf_explorer.store.store import MOST_STEPS, Store


def test_a_drag_is_one_step(qtbot):
    store = Store(State())
    with store.drag():
        for angle in range(1, 6):
            store.update(field_deg=float(angle))
    assert store.state.optics.field_deg == 5.0
    store.undo()
    assert store.state == State()
    assert not store.can_undo


def test_the_end_of_a_drag_asks_for_the_settled_picture(qtbot):
    store, moving = Store(State()), []
    store.changed.connect(lambda state: moving.append(store.moving))
    with store.drag():
        store.update(field_deg=1.0)
    assert moving == [True, False]


def test_a_value_that_cannot_be_is_refused_and_nothing_changes(qtbot):
    store = Store(State())
    with qtbot.waitSignal(store.refused) as told:
        store.update(depth_mm=-5.0)
    assert "source depth is -5 mm" in str(told.args[0])
    assert store.state == State()


@pytest.mark.parametrize("seed", range(5))
def test_any_500_actions_undone_give_the_first_state_and_redone_the_last(qtbot, seed):
    chance, store, told = random.Random(seed), Store(State()), [State()]
    store.changed.connect(told.append)
    for _ in range(500):
        act, before = chance.choice(ACTIONS), store.state
        act(store, chance)
        assert told[-1] == store.state
        if act not in (_undo, _redo) and store.state != before:
            assert not store.can_redo, "a new step leaves nothing to take again"
    while store.can_redo:
        store.redo()
    last = store.state
    while store.can_undo:
        store.undo()
    assert store.state == State()
    while store.can_redo:
        store.redo()
    assert store.state == last


def _what_if(store, chance):
    waves = tuple(chance.uniform(-3, 3) for _ in TERMS)
    term = chance.choice(TERMS)
    kinds = {
        "added_waves": waves,
        "muted": toggle(store.state.what_if.muted, term),
        "solo": toggle(store.state.what_if.solo, term),
    }
    name = chance.choice([*kinds, "free_pupil", "preset", "reset"])
    if name in kinds:
        store.update(**{name: kinds[name]})
    elif name == "free_pupil":
        store.update(free_pupil=not store.state.what_if.free_pupil)
    else:
        store.update(**(of_preset(chance.choice(PRESETS)) if name == "preset" else UNTOUCHED))


def _compare(store, chance):
    state = store.state
    if not state.compare.pinned:
        store.replace(pin(state))
        return
    what = chance.choice(["unpin", "swap", "shown", "link"])
    if what in ("unpin", "swap"):
        store.replace((unpin if what == "unpin" else swap)(state))
    elif what == "shown":
        store.update(shown=chance.choice(CHOICES["shown"]))
    else:
        store.update(linked=link_toggled(state, chance.choice(LINKABLE)))


def _play(store, chance):
    store.update(playback_slider=chance.choice(PLAYABLE), playback_range=None, playback_seconds=chance.uniform(1, 9))
    if store.state.playback.slider:
        with store.drag():
            for part in (0.2, 0.6):
                store.update(**changes(store.state, sweep(store.state).value(part)))


def _link(store, chance):
    store.replace(state_of_link(link(store.state)))


def _update(store, chance):
    store.update(
        **chance.choice([{"field_deg": chance.uniform(0, 20)}, {"phase": chance.choice(["waves", "wrapped"])}])
    )


def _undo(store, chance):
    store.undo()


def _redo(store, chance):
    store.redo()


def _drag(store, chance):
    with store.drag():
        for _ in range(chance.randrange(4)):
            store.update(wavelength_nm=chance.uniform(400, 700))


ACTIONS = (_update, _update, _drag, _what_if, _what_if, _compare, _compare, _play, _link, _undo, _undo, _redo)


def test_after_a_thousand_steps_the_oldest_is_forgotten(qtbot):
    """A day's work must not grow without end; the latest thousand steps come back one by one."""
    store = Store(State())
    for step in range(MOST_STEPS + 7):
        store.update(field_deg=step / 100)
    taken = 0
    while store.can_undo:
        store.undo()
        taken += 1
    assert taken == MOST_STEPS and store.state.optics.field_deg == pytest.approx(0.06)
