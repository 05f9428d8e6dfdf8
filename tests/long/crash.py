"""Writers and windows that are killed, or run out of disk: ``python -m tests.long.crash kill|full|window FOLDER [N]``.

``kill``: children write every kind of file without end and are ended by SIGKILL at random moments; after each death
every file must be readable and one of the versions ever written, and nothing else may lie about. ``full``: no file may
grow beyond 2 kB; every writer must refuse in a sentence and leave the old file as it was. ``window``: a window under
random hands is killed N times (50 unless told); what the next start finds must be whole, have an answer, and be as the
window stood a second before its end or later. Prints what was tried.
"""

import os
import random
import resource
import shutil
import signal
import sys
import tempfile
import time
from contextlib import contextmanager, suppress
from itertools import count
from pathlib import Path

import numpy as np

from p2sf.database.build import build_database
from p2sf.database.files.npz import load_database, save_database
from p2sf.database.space import Space
from p2sf.errors import P2SFError
from p2sf.figures.psf_data import PsfFigures
from p2sf.io.photo_files import read_photo, write_photo
from p2sf.io.psf_files import write_psf
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import read_toml
from p2sf.lensfile.writing import write_lens
from p2sf.psf.reading import read_psf
from p2sf.psf.result import Psf
from p2sf_explorer.compute.live import live
from p2sf_explorer.files import recent
from p2sf_explorer.files.recent import remember
from p2sf_explorer.files.session import last_session
from p2sf_explorer.files.snapshot import write_state
from p2sf_explorer.state.link import link
from p2sf_explorer.state.state import State, new_state
from p2sf_explorer.state.state_files import read_state

LENS = find_lens("tessar")
NOISE = np.random.default_rng(1).random((64, 64))
DATABASE = build_database(LENS, Space((500.0, np.inf), (0.0, 0.1), (0.5, 0.6)), "exact")
LIMIT = 2000
MOST_LOST = 1.0  # s, of what was done before a kill
OLD = b'{"schema": "p2sf-explorer-state", "why": "only a state may take the place of a state"}'


def writers(folder: Path, version: int) -> dict:
    """Return for each file a function that writes it again."""
    psf = Psf(NOISE / NOISE.sum(), 1.0 + version, 0.5, "seidel", PsfFigures(strehl=1.0))
    many = {f"{name}-{version}": "x" * 40 for name in range(60)}
    return {
        "lens.toml": lambda: write_lens(LENS, folder / "lens.toml"),
        "state.json": lambda: write_state(new_state(field_deg=version % 60), folder / "state.json", **many),
        "snapshot.npz": lambda: write_psf(psf, folder / "snapshot.npz", {}),
        "picture.png": lambda: write_photo(folder / "picture.png", NOISE),
        "database.npz": lambda: save_database(DATABASE, LENS, folder / "database.npz"),
        "recent.json": lambda: remember(str(folder / f"{version % 7}.toml")),
    }


READERS = {
    "lens.toml": read_toml,
    "state.json": read_state,
    "snapshot.npz": read_psf,
    "picture.png": read_photo,
    "database.npz": load_database,
    "recent.json": lambda path: path.read_text().rstrip().endswith("]") or 1 / 0,
}


def kill(folder: Path, deaths: int = 60) -> str:
    """Kill a writing child again and again; return how often, and how many files were read."""
    chance, checked, seen = random.Random(0), 0, set()
    for number in range(deaths):
        child = os.fork()
        if child == 0:
            write_for_ever(folder, number)
        time.sleep(chance.uniform(0.001, 0.05))
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        names = set(os.listdir(folder))
        assert seen <= names, "a file is lost"
        seen = names & set(READERS)
        for name in seen:
            READERS[name](folder / name)
            checked += 1
        for name in names - seen:
            assert is_whole(folder / name), f"{name} is half a file, left behind"
            (folder / name).unlink()
    return f"{deaths} kills, {checked} files read, none torn, none lost, no half file left behind"


def is_whole(path: Path) -> bool:
    """Return whether a file left without its final name is whole: it can then be read as one of those written."""
    for name, reader in READERS.items():
        with tempfile.TemporaryDirectory() as folder, suppress(P2SFError, ZeroDivisionError, ValueError):
            reader(Path(shutil.copy(path, Path(folder) / name)))
            return True
    return False


def write_for_ever(folder: Path, first: int) -> None:
    for version in count(first):
        work = list(writers(folder, version).values())
        random.Random(version).shuffle(work)
        for write in work:
            write()


@contextmanager
def small_disk(most: int):
    """Limit the size of this process's files to ``most`` bytes, which looks like a full disk to a writer."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))


def full(folder: Path) -> str:
    """Run every writer on a disk that takes 2 kB a file; return the errors' sentences."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    told = []
    for name, write in writers(folder, 1).items():
        (folder / name).write_bytes(OLD)
        before = sorted(os.listdir(folder))
        with small_disk(LIMIT if name != "lens.toml" else 200):
            try:
                write()
            except P2SFError as error:
                told.append(f"{name}: {error}")
        kept = name == "recent.json" or (told[-1].startswith(name) and (folder / name).read_bytes() == OLD)
        assert kept and sorted(os.listdir(folder)) == before, (name, told)
    return "\n".join(told)


def window(folder: Path, deaths: int = 50) -> str:
    """Kill a window in use again and again; return how much the next start has lost each time."""
    chance, lost, steps = random.Random(1), [], 0
    for number in range(deaths):
        log = folder / f"states-{number}"
        log.unlink(missing_ok=True)
        child = os.fork()
        if child == 0:
            use_for_ever(folder, log, number)
        while len(read_log(log)) < 2:  # it is open and has been touched
            time.sleep(0.02)
        time.sleep(chance.uniform(0.2, 4.0))
        end = time.monotonic()
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        told = read_log(log)
        state, _ = last_session()
        live(state)  # P2SFError where a reopened state had no answer
        lost.append(seconds_lost(told, link(state), end))
        steps += len(told)
        assert lost[-1] <= MOST_LOST, f"window {number} lost {lost[-1]:.2f} s"
    return (
        f"{deaths} windows killed after {steps} changes: every state whole and with an answer; lost "
        f"{max(lost):.2f} s at most, {np.median(lost):.2f} s in the middle, nothing in {lost.count(0.0)}"
    )


def read_log(path: Path) -> list[tuple[float, str]]:
    """Return when the window's states came, s, and what they were; a line cut off by the kill is no state."""
    lines = path.read_text().splitlines(keepends=True) if path.exists() else []
    return [(float(line.split()[0]), line.split()[1]) for line in lines if line.endswith("\n")]


def seconds_lost(told: list[tuple[float, str]], found: str, end: float) -> float:
    """Return how long before the end the state that was found had been left for another; 0 if it was the last."""
    assert found in [text for _, text in told], "a state that the window never had"
    last = max(k for k, (_, text) in enumerate(told) if text == found)
    return end - told[last + 1][0] if last + 1 < len(told) else 0.0


def use_for_ever(folder: Path, log: Path, seed: int) -> None:
    """Use a window at random and write down when it comes to which state."""
    from PySide6.QtWidgets import QApplication

    from p2sf_explorer.files.session_keeper import SessionKeeper
    from p2sf_explorer.window.window import MainWindow
    from tests.long.stress import overheard, own_files
    from tests.support.windows.monkey import Person

    application = QApplication([])
    application.setStyle("Fusion")
    descriptor = os.open(log, os.O_CREAT | os.O_APPEND | os.O_WRONLY)
    with own_files(folder, seed), overheard(lambda words: None):
        made = MainWindow(new_state(method="seidel", theme="light", field_deg=0.1 * (seed + 1)), measured=False)

        def note(state: State) -> None:
            os.write(descriptor, f"{time.monotonic()} {link(state)}\n".encode())

        made.store.changed.connect(note)
        made.show()
        note(made.store.state)
        keeper = SessionKeeper(made, made.store, lambda: made.floating.open, {})
        person = Person(made, random.Random(seed))
        keeper.keep()
        while True:
            person.act()


if __name__ == "__main__":
    place = Path(sys.argv[2])
    recent.recent_path = lambda: place / "memory" / "recent.json" if sys.argv[1] == "window" else place / "recent.json"
    print({"kill": kill, "full": full, "window": window}[sys.argv[1]](place, *map(int, sys.argv[3:])))
