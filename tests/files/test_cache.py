"""What is kept between runs is whole or missing, and stays within its limit."""

import os
import threading

import numpy as np
import pytest

from p2sf.files import cache

ROWS = {"rows": np.arange(2000.0)}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_what_is_kept_comes_back(folder):
    assert cache.read_cached("one") is None
    cache.write_cached("one", ROWS)
    np.testing.assert_array_equal(cache.read_cached("one")["rows"], ROWS["rows"])


def test_an_empty_variable_switches_it_off(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv(cache.VARIABLE, "")
    cache.write_cached("one", ROWS)
    assert cache.read_cached("one") is None and not list(tmp_path.iterdir())


@pytest.mark.parametrize("damage", ["cut", "flipped", "foreign", "folder"])
def test_what_is_damaged_counts_as_missing_and_is_replaced(folder, damage):
    cache.write_cached("one", ROWS)
    path = folder / "one.npz"
    whole = bytearray(path.read_bytes())
    if damage == "folder":
        path.unlink()
        path.mkdir()
        assert cache.read_cached("one") is None
        return
    middle = len(whole) // 2
    if damage == "flipped":
        whole[middle] ^= 0xFF
    path.write_bytes({"cut": whole[:middle], "flipped": whole, "foreign": b"no archive"}[damage])
    assert cache.read_cached("one") is None
    cache.write_cached("one", ROWS)
    assert cache.read_cached("one") is not None


def test_a_folder_that_cannot_be_written_to_is_no_error(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "file"))
    cache.write_cached("one", ROWS)
    assert cache.read_cached("one") is None


def test_those_not_used_for_longest_go_first(folder, monkeypatch):
    for age, name in enumerate(("new", "old", "oldest")):
        cache.write_cached(name, ROWS)
        os.utime(folder / f"{name}.npz", (1e9 - age, 1e9 - age))
    cache.read_cached("oldest")  # which is then the newest
    monkeypatch.setattr(cache, "LARGEST", 3.5 * (folder / "new.npz").stat().st_size)
    cache.write_cached("newest", ROWS)
    assert {path.stem for path in folder.iterdir()} == {"new", "oldest", "newest"}


def test_readers_see_whole_files_while_others_write(folder):
    """Each file holds one number throughout: a mixture of two would show."""
    found, stop = [], threading.Event()

    def write(value):
        while not stop.is_set():
            cache.write_cached("one", {"rows": np.full(5000, value)})

    threads = [threading.Thread(target=write, args=(value,)) for value in (1.0, 2.0)]
    for thread in threads:
        thread.start()
    try:
        while len(found) < 30:
            kept = cache.read_cached("one")
            if kept is not None:
                found.append(np.ptp(kept["rows"]))
    finally:
        stop.set()
        for thread in threads:
            thread.join()
    assert set(found) == {0.0}
