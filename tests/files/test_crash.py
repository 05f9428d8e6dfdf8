"""No file is lost or left half written: writers killed at any moment or on a full disk, in their own process."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def crashed(kind: str, folder: Path, *more: str) -> str:
    command = [sys.executable, "-m", "tests.long.crash", kind, str(folder), *more]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return run.stdout


@pytest.mark.slow
def test_kill_9_at_any_moment_leaves_every_file_whole(tmp_path):
    """Lens, state, snapshot, photo, database and the list of recent files; 60 deaths of a process that writes them."""
    assert "60 kills" in crashed("kill", tmp_path)


def test_a_disk_that_is_full_is_a_sentence_and_keeps_the_old_file(tmp_path):
    told = crashed("full", tmp_path).splitlines()
    assert len(told) == 5  # the list of recent files is not worth a sentence: only the memory is lost
    assert all("cannot be written" in line and "; choose " in line for line in told)


@pytest.mark.slow
def test_kill_9_of_a_window_in_use_costs_a_second_at_most(tmp_path):
    """Twice; ``python -m tests.long.crash window`` kills fifty. It has to open the windows it kills."""
    assert "2 windows killed" in crashed("window", tmp_path, "2")
