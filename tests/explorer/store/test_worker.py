"""LatestWins: one runs, one waits, what finishes is shown."""

from threading import Event

import pytest

from p2sf.errors import Cancelled, GeometryError
from p2sf.messages import Message
from p2sf_explorer.store.worker import LatestWins


@pytest.fixture
def worker(qtbot):
    made = LatestWins()
    yield made
    made.stop()


def test_one_runs_one_waits_and_the_latest_waiting_wins(qtbot, worker):
    gate, seen = Event(), []
    worker.finished.connect(lambda key, result: seen.append((key, result)))
    worker.submit("first", lambda cancelled, progress: gate.wait(5))
    for key in ("second", "third"):
        worker.submit(key, lambda cancelled, progress, key=key: key)
    gate.set()
    qtbot.waitUntil(lambda: len(seen) == 2)
    assert seen == [("first", True), ("third", "third")]


def test_a_refusal_comes_as_its_message_and_the_next_job_runs(qtbot, worker):
    def refuse(cancelled, progress):
        raise GeometryError("no such {what}", what="lens")

    with qtbot.waitSignal(worker.failed) as told:
        worker.submit("key", refuse)
    assert told.args == ["key", Message("no such {what}", what="lens")]
    with qtbot.waitSignal(worker.finished):
        worker.submit("next", lambda cancelled, progress: 1)


def test_cancel_reaches_the_running_job(qtbot, worker):
    with qtbot.waitSignal(worker.finished) as told:
        worker.submit("key", lambda cancelled, progress: cancelled.wait(5))
        worker.cancel()
    assert told.args[1] is True


def test_work_that_was_given_up_is_no_failure(qtbot, worker):
    """A receiver that has asked the same again could not tell it from the failure of what it waits for."""
    gate, told = Event(), []

    def give_up(cancelled, progress):
        gate.wait(5)
        raise Cancelled("stopped")

    worker.failed.connect(lambda key, message: told.append(message))
    worker.submit("key", give_up)
    worker.cancel()
    with qtbot.waitSignal(worker.finished):
        worker.submit("key", lambda cancelled, progress: 1)
        gate.set()
    assert told == []


def test_progress_is_told(qtbot, worker):
    with qtbot.waitSignal(worker.progressed) as told:
        worker.submit("key", lambda cancelled, progress: progress(0.5))
    assert told.args == ["key", 0.5]


def test_after_the_end_nothing_begins(qtbot, worker):
    """A result still in the queue when a window closes may ask for more work; that must not start a thread again."""
    with qtbot.waitSignal(worker.finished):
        worker.submit("one", lambda cancelled, progress: 1)
    worker.stop()
    worker.submit("late", lambda cancelled, progress: 2)
    assert not worker.busy and not worker._thread.isRunning()
