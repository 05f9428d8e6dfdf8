"""A few hundred random events on the window; ``python -m tests.soak`` is the hour."""

from tests.soak import soak


def test_random_hands_find_no_error(qapp):
    """Memory and stalls are for the long run: here the caches still fill and every panel opens for the first time."""
    told = []
    found = soak(seconds=6.0, events=250, seed=4, tell=told.append)
    assert not found.errors, told
    assert len(found.ledger.cost) > 10 and found.ledger.done
    assert "events in" in found.words()
