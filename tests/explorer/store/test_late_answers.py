"""LateAnswers: one runs, one waits, what finishes is shown."""

from threading import Event
from time import sleep

import pytest

from p2sf.errors import Cancelled, GeometryError
from p2sf.messages import Message
from p2sf_explorer.store.late_answers import HELD_MS, LateAnswers


@pytest.fixture
def worker(qtbot):
    made = LateAnswers()
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


@pytest.fixture
def asked(qtbot):
    """Return late answers, the gate at which each waits, and what was asked, painted and said."""
    gate, runs, painted, said = Event(), [], [], []

    def answer(question, stopped, tell):
        runs.append(question)
        tell(0.5, f"half of {question}")
        assert gate.wait(5)
        if question == "bad":
            raise GeometryError("no such lens")
        return f"all of {question}"

    def paint(question, found):
        painted.append((question, found))
        return f"painted {found}"

    made = LateAnswers(answer=answer, paint=paint, say=said.append)
    yield made, gate, runs, painted, said
    gate.set()
    made.stop()


def test_equal_questions_are_answered_once(qtbot, asked):
    late, gate, runs, painted, _ = asked
    gate.set()
    for _ in range(2):
        late.ask((1, "a"))
        late.ask((1, "a"))
        qtbot.waitUntil(lambda: not late.busy)
    assert runs == [(1, "a")] and painted[-1] == ((1, "a"), "all of (1, 'a')")


def test_what_is_there_so_far_is_painted_of_the_latest_question_only(qtbot, asked):
    """A whole answer to an earlier one is better than none, and is marked as such."""
    late, gate, _, painted, said = asked
    late.ask("one")
    qtbot.waitUntil(lambda: painted == [("one", "half of one")])
    assert said[-1] == "painted half of one"
    late.ask("two")
    assert said[-1] == "painted half of one · earlier picture"
    gate.set()
    qtbot.waitUntil(lambda: not late.busy)
    assert painted[1:] == [("one", "all of one"), ("two", "half of two"), ("two", "all of two")]
    assert said[-1] == "painted all of two"


def test_why_there_is_no_answer_is_said_until_something_else_is_asked(qtbot, asked):
    late, gate, _, _, said = asked
    gate.set()
    with qtbot.waitSignal(late.failed):
        late.ask("bad")
    assert said[-1] == "No such lens"
    late.ask("good")
    assert "no such lens" not in said[-1].lower()
    qtbot.waitUntil(lambda: not late.busy)
    late.refuse(Message("nothing to show"))
    assert said[-1] == "Nothing to show" and late.asked is None


def test_a_failure_of_an_earlier_question_is_not_told(qtbot, asked):
    late, gate, runs, _, said = asked
    told = []
    late.failed.connect(lambda question, message: told.append(question))
    late.ask("bad")
    qtbot.waitUntil(lambda: runs == ["bad"])
    late.ask("good")
    gate.set()
    qtbot.waitUntil(lambda: not late.busy)
    assert told == [] and said[-1] == "painted all of good"


def test_what_is_forgotten_is_not_painted_and_may_be_asked_again(qtbot, asked):
    late, gate, runs, painted, _ = asked
    late.ask("one")
    qtbot.waitUntil(lambda: len(painted) == 1)
    late.forget()
    gate.set()
    qtbot.waitUntil(lambda: not late.busy)
    assert painted == [("one", "half of one")]
    late.ask("one")
    qtbot.waitUntil(lambda: not late.busy)
    assert runs == ["one", "one"] and painted[-1] == ("one", "all of one")


def test_a_question_of_a_slider_that_moves_waits_until_it_is_held(qtbot, asked):
    late, gate, runs, _, _ = asked
    gate.set()
    for number in range(5):
        late.ask_when_held(number + 1)
        assert late.asked is None and late.busy and not runs
    qtbot.waitUntil(lambda: not late.busy)
    assert runs == [5]
    late.ask_when_held(6)
    late.stop()
    qtbot.wait(2 * HELD_MS)
    assert runs == [5], "nothing begins after the end"


def test_the_picture_on_screen_is_marked_while_the_next_question_is_held(qtbot, asked):
    late, gate, _, painted, said = asked
    gate.set()
    late.ask_when_held("one")
    assert said == ["working"]
    qtbot.waitUntil(lambda: not late.busy)
    late.ask_when_held("two")
    assert said[-1] == "painted all of one · earlier picture"
    qtbot.waitUntil(lambda: not late.busy)
    assert said[-1] == "painted all of two" and painted[-1] == ("two", "all of two")


def test_nothing_is_said_of_what_was_forgotten(qtbot, asked):
    """Something else has been on screen since: the figures of the last answer would be those of neither."""
    late, gate, _, _, said = asked
    gate.set()
    late.ask("one")
    qtbot.waitUntil(lambda: not late.busy)
    late.forget()
    gate.clear()
    said.clear()
    late.ask("two")
    assert said == ["working"]


def test_a_question_that_is_held_is_not_held_anew(qtbot, asked):
    """A preview asks the same with every frame; begun anew by each it would never be asked."""
    late, gate, runs, _, _ = asked
    gate.set()
    held_since = 0
    late.ask_when_held("same")
    while not runs and held_since < 20 * HELD_MS:
        late.ask_when_held("same")
        qtbot.wait(HELD_MS // 4)
        held_since += HELD_MS // 4
    assert runs == ["same"]


def test_what_is_held_gives_way_to_what_is_submitted(qtbot, asked):
    late, gate, runs, _, _ = asked
    gate.set()
    late.ask_when_held("held")
    late.submit("at once", lambda cancelled, tell: "done")
    qtbot.wait(2 * HELD_MS)
    qtbot.waitUntil(lambda: not late.busy)
    assert runs == [] and late.asked == "at once"


def test_what_is_held_can_be_let_go_while_what_runs_goes_on(qtbot, asked):
    late, gate, runs, painted, _ = asked
    late.ask("one")
    qtbot.waitUntil(lambda: runs == ["one"])
    late.let_go()
    gate.set()
    qtbot.waitUntil(lambda: not late.busy)
    assert painted[-1] == ("one", "all of one")
    late.ask_when_held("two")
    late.let_go()
    qtbot.wait(2 * HELD_MS)
    assert runs == ["one"] and not late.busy


def test_what_is_forgotten_is_not_painted_when_something_else_is_asked(qtbot, asked):
    late, gate, runs, painted, _ = asked
    late.ask("one")
    qtbot.waitUntil(lambda: len(painted) == 1)
    late.forget()
    late.ask("two")
    gate.set()
    qtbot.waitUntil(lambda: not late.busy)
    assert runs == ["one", "two"] and [question for question, _ in painted] == ["one", "two", "two"]


@pytest.mark.parametrize("at_once", [True, False], ids=["while the job still runs", "after its end"])
def test_what_was_cancelled_may_be_asked_again(qtbot, asked, at_once):
    late, gate, runs, painted, said = asked
    late.ask("one")
    qtbot.waitUntil(lambda: len(painted) == 1)
    late.cancel()
    if at_once:
        late.ask("one")
    gate.set()
    qtbot.waitUntil(lambda: not late.busy)
    late.ask("one")
    qtbot.waitUntil(lambda: not late.busy)
    assert runs == ["one", "one"] and painted[-1] == ("one", "all of one") and said[-1] == "painted all of one"


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_after_an_unexpected_error_the_same_may_be_asked_again(qtbot):
    said, runs = [], []

    def answer(question, stopped, tell):
        runs.append(question)
        if len(runs) == 1:
            raise KeyError("unexpected")
        return "done"

    late = LateAnswers(answer=answer, paint=lambda question, found: found, say=said.append)
    with qtbot.capture_exceptions() as errors:
        late.ask("one")
        qtbot.waitUntil(lambda: not late.busy)
    assert len(errors) == 1 and said == ["working", ""]
    late.ask("one")
    qtbot.waitUntil(lambda: not late.busy)
    assert runs == ["one", "one"] and said[-1] == "done"
    late.stop()


def test_nothing_is_painted_or_told_after_the_end(qtbot, asked):
    """What has ended stands in the queue while the window closes."""
    late, gate, runs, painted, said = asked
    told = []
    for signal in (late.finished, late.progressed):
        signal.connect(lambda *words: told.append(words))
    late.ask("one")
    while not runs:
        sleep(0.001)  # in which no event is handled
    gate.set()
    late._thread.quit()
    late._thread.wait()
    late.stop()
    qtbot.wait(20)
    assert painted == [] and told == [] and said == ["working"] and not late.busy


def test_a_job_that_never_began_leaves_nothing_busy(qtbot, asked):
    late, gate, *_ = asked
    gate.set()  # where its thread was quicker, it ends at once
    late.ask("one")
    late.stop()
    assert not late.busy
