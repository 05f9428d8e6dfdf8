"""Undo and redo over whatever is done."""

import random

import pytest

from app.state import State
from app.store import Store


def test_a_drag_is_one_step(qtbot):
    store = Store(State())
    with store.drag():
        for angle in range(1, 6):
            store.update(field_deg=float(angle))
    assert store.state.field_deg == 5.0
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
    assert "source depth is -5 mm" in told.args[0]
    assert store.state == State()


@pytest.mark.parametrize("seed", range(5))
def test_any_500_actions_undone_give_the_first_state_and_redone_the_last(qtbot, seed):
    chance, store = random.Random(seed), Store(State())
    for _ in range(500):
        chance.choice([_update, _update, _drag, lambda s, c: s.undo(), lambda s, c: s.redo()])(store, chance)
    while store.can_redo:
        store.redo()
    last = store.state
    while store.can_undo:
        store.undo()
    assert store.state == State()
    while store.can_redo:
        store.redo()
    assert store.state == last


def _update(store, chance):
    store.update(
        **chance.choice([{"field_deg": chance.uniform(0, 20)}, {"phase": chance.choice(["waves", "wrapped"])}])
    )


def _drag(store, chance):
    with store.drag():
        for _ in range(chance.randrange(4)):
            store.update(wavelength_nm=chance.uniform(400, 700))
