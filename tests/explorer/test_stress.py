"""A hundred random events on the window; ``python -m tests.long.stress`` goes on for an hour."""

import pytest

from tests.long.stress import stress

pytestmark = pytest.mark.slow


def test_random_hands_find_no_error(qapp, monkeypatch):
    """Memory and stalls are for the long run: here the caches still fill and every panel opens for the first time."""
    monkeypatch.setattr("tests.long.stress.PAUSE_MS", 0)
    told = []
    found = stress(seconds=4.0, events=100, seed=4, tell=told.append)
    assert not found.errors, told
    assert len(found.ledger.cost) > 10 and found.ledger.done
    assert "events in" in found.words()
