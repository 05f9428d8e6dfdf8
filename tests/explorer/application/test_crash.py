"""An unexpected error is told once, loses nothing, and is reported without anything personal; so is a kill."""

import os
import signal
import subprocess
import sys
import threading
from pathlib import Path
from traceback import TracebackException

import pytest
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from p2sf_explorer.application.crash_dialog import KEPT, NOT_KEPT, UnexpectedErrors
from p2sf_explorer.application.crash_report import OWN_LENS, report, without_paths
from p2sf_explorer.application.recovery import offer_rescued, session_to_open
from p2sf_explorer.compute.setup import first_state
from p2sf_explorer.files.session import keep_session, last_session, rescued_sessions, session_path
from p2sf_explorer.files.session_keeper import RunMark, SessionKeeper
from p2sf_explorer.state.state import State, new_state
from p2sf_explorer.store.late_answers import LateAnswers

ROOT = Path(__file__).parents[3]
HIS_FILE = "secret.zmx"


@pytest.fixture
def errors(window, monkeypatch):
    """Return what takes the errors of the window, installed for one test; `kept` says whether saving works."""
    monkeypatch.setattr(sys, "excepthook", sys.excepthook)
    monkeypatch.setattr(threading, "excepthook", threading.excepthook)
    monkeypatch.setattr(sys, "__excepthook__", lambda *told: None)  # pytest-qt and the log need no traceback
    made = UnexpectedErrors(lambda: window, lambda: window.store.state, lambda: made.kept, window)
    made.kept = True
    made.install()
    yield made
    if made.dialog:
        made.dialog.close()
    made.deleteLater()


def raised(error: Exception) -> tuple:
    try:
        raise error
    except type(error) as caught:
        return type(caught), caught, caught.__traceback__


def words(dialog) -> str:
    return " ".join(label.text() for label in dialog.findChildren(type(dialog.parent().banner.text)))


def test_one_dialog_tells_what_was_lost_and_copies_the_report(window, errors):
    for _ in range(3):  # as an error does that comes with every frame
        sys.excepthook(*raised(KeyError("ν")))
    QApplication.processEvents()
    first = errors.dialog
    assert first.isVisible() and KEPT in words(first)
    assert first.text.toPlainText().count("KeyError: 'ν'") == 1
    first.copy.click()
    copied = QGuiApplication.clipboard().text()
    assert "p2sf" in copied and "numpy" in copied and "test_crash.py" in copied
    assert str(ROOT) not in copied and str(Path.home()) not in copied


def test_an_error_after_the_dialog_was_closed_opens_another(window, errors):
    sys.excepthook(*raised(KeyError(1)))
    QApplication.processEvents()
    errors.dialog.accept()
    try:
        {}["elsewhere"]
    except KeyError as error:
        sys.excepthook(KeyError, error, error.__traceback__)
    QApplication.processEvents()
    assert errors.dialog.isVisible() and "elsewhere" in errors.dialog.text.toPlainText()


def test_a_window_that_cannot_be_saved_says_so(window, errors):
    errors.kept = False
    sys.excepthook(*raised(KeyError("ν")))
    QApplication.processEvents()
    assert NOT_KEPT in words(errors.dialog)


def test_an_error_in_a_worker_is_told_and_the_next_job_runs(window, errors, qtbot):
    worker, heard = LateAnswers(window), []
    worker.finished.connect(lambda key, result: heard.append(result))
    worker.submit(1, lambda cancelled, tell: {}["worker"])
    qtbot.waitUntil(lambda: errors.dialog is not None)
    assert "KeyError: 'worker'" in errors.dialog.text.toPlainText()
    worker.submit(2, lambda cancelled, tell: "done")
    qtbot.waitUntil(lambda: heard == ["done"])
    worker.stop()


@pytest.mark.parametrize(
    "text",
    [
        "[Errno 2] No such file or directory: '/home/ann/lenses/secret design.zmx'",
        'cannot read "C:\\Users\\Ann Lee\\secret.toml"',
        "bad file /home/ann/secret.toml, line 3",
        "bad file C:\\Users\\ann\\secret.toml",
        "in ~/secret/lens.toml",
        "in secret/lens.toml",
        r"\\server\ann\secret.zmx is gone",
    ],
)
def test_no_path_is_in_a_report(text):
    hidden = without_paths(text)
    assert "ann" not in hidden.lower().replace("cannot", "") and "secret" not in hidden and "<path>" in hidden


@pytest.mark.parametrize("text", ["shapes (3, 4) and (2,)", "W20/2 + Wd", "n'u'/λ", "division by zero", "a/b"])
def test_what_is_no_path_stays(text):
    assert without_paths(text) == text


def test_a_report_tells_the_whole_chain_and_no_lens_of_ones_own(tmp_path):
    try:
        try:
            open(tmp_path / HIS_FILE)
        except OSError as error:
            raise KeyError("after") from error
    except KeyError as error:
        told = TracebackException.from_exception(error)
    text = report(told, new_state(lens="tessar"))
    assert "FileNotFoundError" in text and "KeyError: 'after'" in text and "tessar" in text
    assert "secret" not in text and str(tmp_path) not in text
    own = State(optics=type(State().optics)(lens="/home/ann/secret.toml"))
    assert OWN_LENS in report(told, own) and "ann/" not in report(told, own)


def test_the_session_is_kept_while_a_slider_goes_on_moving(window):
    """A change every tenth of a second put the writing off for ever, while it was started again by each."""
    keeper = SessionKeeper(window, window.store, lambda: window.floating.open, {})
    session_path().unlink(missing_ok=True)
    window.store.begin()
    for k in range(10):
        window.store.update(field_deg=1.0 + 0.1 * k)
        QTest.qWait(100)
    kept = last_session()[0].optics.field_deg
    window.store.end()
    window.removeEventFilter(keeper)
    window.store.changed.disconnect(keeper._on_change)
    keeper.stop()
    assert 1.3 < kept < 2.0


@pytest.mark.slow
def test_a_run_that_is_killed_leaves_its_mark_and_one_that_ends_does_not():
    """The mark of a run that goes on is no crash: a second window opens beside the first."""
    code = "import sys, time; from p2sf_explorer.files import recent; from pathlib import Path; "
    code += f"recent.recent_path = lambda: Path({str(session_path().with_name('recent.json'))!r}); "
    code += (
        "from p2sf_explorer.files.session_keeper import RunMark; mark = RunMark(); print(mark.begin(), flush=True); "
    )
    code += "sys.stdin.readline(); mark.end()"
    session_path().parent.mkdir(parents=True, exist_ok=True)

    def run() -> subprocess.Popen:
        made = subprocess.Popen([sys.executable, "-c", code], stdin=-1, stdout=-1, cwd=ROOT, text=True)
        made.told = made.stdout.readline().strip()
        return made

    first = run()
    second = run()
    assert (first.told, second.told) == ("False", "False")
    second.communicate("\n")
    os.kill(first.pid, signal.SIGKILL)
    first.communicate()
    third = run()
    assert third.told == "True"
    third.communicate("\n")
    fourth = run()
    assert fourth.told == "False"
    fourth.communicate("\n")
    mark = RunMark()
    assert not mark.begin()
    mark.end()


@pytest.fixture
def memory(tmp_path, monkeypatch) -> Path:
    """Return a folder of the test's own in which sessions are kept; it is not there yet, as at the first start."""
    monkeypatch.setattr("p2sf_explorer.files.recent.recent_path", lambda: tmp_path / "memory" / "recent.json")
    return tmp_path / "memory"


def rescued_lenses() -> list[str]:
    return [state.optics.lens for state, _ in rescued_sessions().values()]


def test_after_a_crash_the_window_begins_anew_and_offers_the_last_one(window, memory):
    before = new_state(lens="tessar", field_deg=3.0, method="seidel", theme="dark")
    keep_session(before, {"window": "AA=="})
    state, geometry = session_to_open(None, crashed=True)
    assert state.optics == first_state().optics and state.display.theme == "dark" and geometry == {"window": "AA=="}
    keep_session(window.store.state, {})  # what is done before the offer is taken does not write over it
    offer = offer_rescued(window.store, window.edge.add, window)
    offer.accept.click()
    assert window.store.state == before and not offer.isVisible()
    assert not rescued_sessions() and offer_rescued(window.store, window.edge.add, window) is None
    assert last_session()[0] == before, "a crash at once would find it again"
    window.store.undo()
    assert window.store.state != before
    offer.deleteLater()


def test_an_offer_that_nobody_answered_comes_again(window, memory):
    keep_session(new_state(lens="tessar"), {})
    session_to_open(None, crashed=True)
    assert session_to_open(None, crashed=False) == last_session()
    offer = offer_rescued(window.store, window.edge.add, window)
    offer.dismiss.click()
    assert not rescued_sessions()
    offer.deleteLater()


def test_after_a_crash_what_was_asked_for_opens_and_the_last_window_is_offered(memory):
    keep_session(new_state(lens="tessar"), {})
    asked = new_state(lens="landscape")
    assert session_to_open(asked, crashed=True) == (asked, {})
    assert rescued_lenses() == ["tessar"]


def test_a_second_crash_keeps_what_the_first_left(window, memory):
    """An hour's work, a crash, a fresh window that crashes as well: the work was written over by the fresh window."""
    for lens in ("tessar", "landscape", "petzval"):
        keep_session(new_state(lens=lens), {})
        session_to_open(None, crashed=True)
    assert rescued_lenses() == ["petzval", "landscape", "tessar"]
    shown = []
    offer_rescued(window.store, shown.append, window).dismiss.click()
    assert rescued_lenses() == ["landscape", "tessar"]
    shown[-1].accept.click()
    assert window.store.state.optics.lens == "landscape" and rescued_lenses() == ["tessar"]
    keep_session(new_state(lens="cooke_triplet"), {})
    session_to_open(None, crashed=True)
    assert rescued_lenses() == ["cooke_triplet", "tessar"], "what is left keeps its place"
    for offer in shown:
        offer.deleteLater()


def test_a_session_rescued_by_an_older_version_is_offered(memory):
    keep_session(new_state(lens="tessar"), {})
    (memory / "window.json").rename(memory / "rescued.json")
    assert rescued_lenses() == ["tessar"]
    keep_session(new_state(lens="petzval"), {})
    session_to_open(None, crashed=True)
    assert rescued_lenses() == ["petzval", "tessar"]


def killed_run(memory: Path) -> bool:
    """Kill a run in the middle, and return whether it had found that one before did not end as it should."""
    code = (
        "import os; from pathlib import Path; from p2sf_explorer.files import recent; "
        f"recent.recent_path = lambda: Path({str(memory / 'recent.json')!r}); "
        "from p2sf_explorer.files.session_keeper import RunMark; "
        "mark = RunMark(); print(mark.begin(), flush=True); os.kill(os.getpid(), 9)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT)
    return {"True": True, "False": False}[run.stdout.strip()]


def test_the_very_first_run_makes_the_folder_of_its_mark(memory):
    mark = RunMark()
    assert not mark.begin() and list(memory.glob("running*"))
    mark.end()
    assert not list(memory.glob("running*"))


@pytest.mark.slow
def test_the_very_first_run_leaves_its_mark_and_so_does_a_window_beside_another(memory):
    """The folder of the marks was not there at the first start; a second window had no mark of its own."""
    assert not killed_run(memory)
    first = RunMark()
    assert first.begin(), "the first run of all was killed"
    assert not killed_run(memory), "the first window is there and goes on"
    assert killed_run(memory), "the window beside it was killed"
    first.end()
    last = RunMark()
    assert last.begin()
    last.end()
    assert not list(memory.glob("running*"))
