"""Freed memory goes back to the system when the window rests."""

import numpy as np
import pytest

from p2sf_explorer.window import memory_trim
from p2sf_explorer.window.memory_trim import MemoryTrim, trimming
from tests.long.stress import resident_mb


def freed_between_kept(megabytes: int = 60) -> list[np.ndarray]:
    """Return every second of many arrays too small for pages of their own, the others freed: a heap full of holes."""
    made = [np.ones(10_000) for _ in range(megabytes * 100_000 // 8_000)]
    return made[::2]


@pytest.mark.filterwarnings("error")
def test_holes_are_given_back():
    """Half of 60 MB; the pages at both edges of a hole of 80 kB cannot go, a tenth at most."""
    kept = freed_between_kept()
    full = resident_mb()
    trim = trimming()
    assert trim is None or trim(0) == 1
    assert trim is None or full - resident_mb() > 0.8 * 30
    assert all(array[0] == 1 for array in kept), "nothing in use was touched"


@pytest.fixture
def trimmed(qapp, monkeypatch, qtbot):
    """Return a MemoryTrim with short pauses, and the calls of trimming."""
    given = []
    monkeypatch.setattr(memory_trim, "trimming", lambda: lambda pad: given.append(pad))
    made = MemoryTrim()
    made._rest.setInterval(20)
    made._latest.setInterval(60)
    yield made, given
    made.stop()


def test_once_for_a_burst_that_rests(trimmed, qtbot):
    made, given = trimmed
    for _ in range(5):
        made.touch()
    qtbot.waitUntil(lambda: len(given) == 1)
    assert not made._rest.isActive() and not made._latest.isActive(), "nothing more until something changes"


def test_a_hand_that_never_rests_is_served_too(trimmed, qtbot):
    made, given = trimmed
    made._rest.setInterval(10**6)

    def still_moving():
        made.touch()
        return bool(given)

    qtbot.waitUntil(still_moving)


def test_the_window_gives_back_after_a_change(window):
    window.memory_trim.stop()
    window.store.update(field_deg=3.0)
    assert window.memory_trim._rest.isActive() and window.memory_trim._latest.isActive()
    window.memory_trim.stop()
    assert not window.memory_trim._rest.isActive() and not window.memory_trim._latest.isActive()
