"""Everything that ever broke a reader, and a few hundred fresh injuries per target; no guided fuzzing here."""

import random
from pathlib import Path
from subprocess import CompletedProcess
from time import process_time

import pytest

from tests.fuzz import run
from tests.fuzz.seeds import seeds
from tests.fuzz.targets import LAST, SECONDS, TARGETS
from tests.long.damaged_files import damaged

CORPUS = sorted(path for path in (Path(__file__).parent / "corpus").iterdir() if path.name[0] != ".")
COUNT = {"command_line": 60, "lens_file": 150}


def answered(name: str, data: bytes) -> str:
    """Return what became of an input, which must not take longer than its target allows (CPU time)."""
    start = process_time()
    found = TARGETS[name](data)
    assert process_time() - start < SECONDS[name], data[:500]
    return found


def test_what_broke_once_is_answered():
    for path in CORPUS:
        assert answered(path.name.rsplit("-", 1)[0], path.read_bytes()) in ("accepted", "refused"), path.name


@pytest.mark.slow
@pytest.mark.parametrize("name", TARGETS)
def test_damage_is_accepted_or_refused(name):
    found = set()
    for number in range(COUNT.get(name, 200)):
        chance = random.Random(f"{name} {number}")
        found.add(answered(name, damaged(chance.choice(seeds(name)), chance)))
    assert "refused" in found


@pytest.mark.parametrize("name", TARGETS)
def test_the_seeds_are_accepted(name):
    """Otherwise the fuzzing would start from nothing and try nothing."""
    assert "accepted" in {TARGETS[name](data) for data in seeds(name)}


@pytest.mark.parametrize(("code", "left"), [(77, b"artifact"), (-9, None)])
def test_a_process_that_breaks_leaves_its_words_and_its_last_input(tmp_path, monkeypatch, capsys, code, left):
    """One killed from outside writes no artifact; what it was given last is then all there is to go by."""

    def broken(command, **_):
        folder = Path(command[4]).parent
        (folder / LAST).write_bytes(b"the last")
        if left:
            (folder / "found-crash-1").write_bytes(left)
        return CompletedProcess(command, code, "", "#12 NEW cov: 34\n === Uncaught Python exception: ===\nhere\n")

    monkeypatch.setattr(run, "CORPUS", tmp_path / "corpus")
    monkeypatch.setattr(run, "BROKEN", tmp_path / "broken")
    monkeypatch.setattr(run.subprocess, "run", broken)
    assert not run.fuzz("toml", 1.0)
    assert [path.read_bytes() for path in (tmp_path / "corpus").glob("toml-*")] == ([left] if left else [])
    (log,) = (tmp_path / "broken").glob("toml-*.log")
    assert log.with_suffix("").read_bytes() == b"the last" and "Uncaught Python exception" in log.read_text()
    assert "12 inputs, 34 edges, BROKE" in capsys.readouterr().out
