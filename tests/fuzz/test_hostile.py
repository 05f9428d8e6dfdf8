"""Files made to cost much end in a sentence, on every road; ``python -m tests.fuzz.hostile`` reads many more."""

import subprocess
import sys

import pytest

SOME = "pipe that nobody writes into.zmx", "/dev/zero.png", "20 GB of nothing.jpg", "GB of", "fifty", "dotted key.toml"


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="devices and sparse files as Linux has them")
def test_hostile_files_end_in_a_sentence_within_two_seconds_and_half_a_gigabyte():
    """In processes of their own, so that time and memory are those of one reader."""
    command = [sys.executable, "-m", "tests.fuzz.hostile", *SOME]
    found = subprocess.run(command, capture_output=True, text=True, errors="replace")
    assert found.returncode == 0, found.stdout[-5000:]
    assert found.stdout.count(" exit 2 ") > 20
