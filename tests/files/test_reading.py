"""Limits to what a file may cost: pipes, devices, bombs, and texts that patterns would choke on."""

import io
import os
import re
import signal
import tracemalloc
import zipfile
from contextlib import contextmanager
from time import process_time

import numpy as np
import pytest
import tifffile
from PIL import Image

from p2sf import load_lens
from p2sf.cli import main
from p2sf.database.files.npz import load_database
from p2sf.errors import LensFileError, P2SFError
from p2sf.files.reading import LARGEST, MOST_MEMBERS, read_array, read_arrays, toml_table
from p2sf.io.depth_files import read_scene_depths
from p2sf.io.photo_files import photo_shape, read_photo, read_samples, write_photo
from p2sf.io.png16 import write_deep
from p2sf.lensfile.importing import FORMATS, import_lens
from p2sf.lensfile.library import lenses_folder
from p2sf.measure.reading import read_counts
from p2sf.measure.target import read_target
from p2sf.psf.reading import read_psf
from p2sf.scene.files import read_scene
from p2sf.scene.filters import filter_channels
from p2sf.studies.complete_trade import load_trades
from p2sf_explorer.lessons.lesson import read_lesson
from p2sf_explorer.lessons.task_record import read_result
from p2sf_explorer.state.state_files import read_state

READERS = {
    "a lens": (load_lens, ".zmx"),
    "a lens of this program": (load_lens, ".toml"),
    "a photo": (read_photo, ".png"),
    "a photo's size": (photo_shape, ".png"),
    "a map of depths": (lambda path: scene_depths(path), ".heic"),
    "a PSF as npz": (read_psf, ".npz"),
    "a PSF as csv": (read_psf, ".csv"),
    "a PSF as tiff": (read_psf, ".tiff"),
    "a database": (load_database, ".npz"),
    "counts as FITS": (read_counts, ".fits"),
    "counts as npy": (read_counts, ".npy"),
    "a listing": (read_counts, ".txt"),
    "a target": (read_target, ".txt"),
    "a scene": (read_scene, ".toml"),
    "curves of filters": (lambda path: filter_channels(path, "d65"), ".csv"),
    "trades": (load_trades, ".json"),
    "a state": (read_state, ".json"),
    "a lesson": (read_lesson, ".md"),
    "results": (read_result, ".json"),
}


@contextmanager
def at_most(seconds):
    """Break off what waits for ever."""

    def late(*_):
        raise TimeoutError

    usual = signal.signal(signal.SIGALRM, late)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, usual)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no pipes with names")
@pytest.mark.parametrize("name", READERS)
def test_a_pipe_is_refused_at_once(name, tmp_path):
    read, ending = READERS[name]
    path = tmp_path / f"pipe{ending}"
    os.mkfifo(path)
    with at_most(20), pytest.raises(P2SFError):
        read(path)


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="the system has no such device")
@pytest.mark.parametrize("name", READERS)
def test_a_device_without_an_end_is_refused_before_it_is_read(name, tmp_path):
    read, ending = READERS[name]
    path = tmp_path / f"device{ending}"
    path.symlink_to("/dev/zero")
    before = process_time()
    with at_most(20), peak_below(20_000_000), pytest.raises(P2SFError):
        read(path)
    assert process_time() - before < 5  # libraries load on first use; without a limit it has no end


@contextmanager
def peak_below(most):
    """Assert that a block allocates less than so many bytes at once; numpy's arrays count."""
    tracemalloc.start()
    try:
        yield
        assert tracemalloc.get_traced_memory()[1] < most
    finally:
        tracemalloc.stop()


def archive(count, members=1):
    """Return an .npz with arrays of so many zeros each."""
    head = io.BytesIO()
    np.lib.format.write_array_header_1_0(head, {"descr": "|u1", "fortran_order": False, "shape": (count,)})
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as found:
        for n in range(members):
            with found.open(f"{n}.npy", "w") as stream:
                stream.write(head.getvalue())
                stream.write(bytes(count))
    return made.getvalue()


def test_the_declared_sizes_of_an_archive_are_summed_before_any_is_unpacked():
    """Each array alone is within the limit, the sum is beyond it."""
    with peak_below(LARGEST // 20), pytest.raises(ValueError, match="at most 200 MB"):
        read_arrays(io.BytesIO(BOMB))
    assert {name: len(found) for name, found in read_arrays(io.BytesIO(archive(1000, 3))).items()} == dict.fromkeys(
        "012", 1000
    )


def test_a_stream_that_is_read_stays_open_for_its_owner():
    stream = io.BytesIO(archive(1000))
    assert len(read_arrays(stream)["0"]) == 1000 and not stream.closed
    with pytest.raises(ValueError):
        read_arrays(damaged := io.BytesIO(b"PK\3\4 and no more"))
    assert not damaged.closed


BOMB = archive(LARGEST // 4, 5)


def test_an_archive_of_too_many_members_is_refused():
    with pytest.raises(ValueError, match=f"{MOST_MEMBERS + 1} members"):
        read_arrays(io.BytesIO(archive(1, MOST_MEMBERS + 1)))


def test_an_array_may_not_be_larger_than_its_file(tmp_path):
    path = tmp_path / "frame.npy"
    np.save(path, np.arange(6.0))
    assert read_array(path).tolist() == [0, 1, 2, 3, 4, 5]
    path.write_bytes(path.read_bytes()[:-8])
    with pytest.raises(ValueError, match="greater than file size"):
        read_array(path)


@pytest.mark.parametrize("blank", [" ", "\n", "\r", "\t\n", "\x1c", "\u2003", "\n\n "])
def test_a_file_of_blanks_is_refused_in_a_time_that_grows_with_its_length(blank, tmp_path):
    """A tenth of a second for 200 kB; with a cost by the square, as before, 20 kB took up to half a minute."""
    path = tmp_path / "blank.zmx"
    path.write_text(blank * (200_000 // len(blank)), encoding="utf-8")
    before = process_time()
    with at_most(60), pytest.raises(LensFileError):
        import_lens(path)
    assert process_time() - before < 2


LINES = ("1 ", "radius ", "SO\n", "TIT ", "LEN ", '"surfaces" ', "1 1 1 1\n", "[[ ", "SURF ", "-1 1 1 iris", "{")


@pytest.mark.parametrize("known", FORMATS, ids=lambda known: known.name)
def test_marks_of_formats_are_looked_for_in_linear_time(known):
    for before in ("", "1", "radius", "{"):
        for piece in (*LINES, " "):
            start = process_time()
            known.mark.search(before + piece * (40_000 // len(piece)) + "x=")
            assert process_time() - start < 0.5, (before, piece)  # by the square it took 6 s and more


KEYS = {
    "bare": "a." * 20_000 + "a = 1",
    "digits": "1." * 20_000 + "1 = 1",
    "quoted": '"=".' * 20_000 + "a = 1",
    "heading": "[" + "a . " * 20_000 + "a]",
    "inline": "x = [{" + "a." * 20_000 + "a = 1}]",
}


@pytest.mark.parametrize("kind", KEYS)
def test_a_key_of_thousands_of_parts_is_refused_before_it_is_read(kind):
    before = process_time()
    with pytest.raises(ValueError, match="line 2 has a key of more than 500 parts"):
        toml_table("a0 = 1\n" + KEYS[kind])
    assert process_time() - before < 0.5  # 20 000 parts took 5 s


def test_numbers_and_sentences_are_no_parts_of_a_key():
    numbers = [n / 8 for n in range(10_000)]
    text = f"a = {numbers}\nb = '{'A sentence. ' * 40}'\nc.d.e = 1.5\n"
    found = toml_table(text)
    assert found["a"] == numbers and found["c"] == {"d": {"e": 1.5}}


def test_nothing_in_a_file_steers_the_terminal(tmp_path, capsys):
    """Title and key with the escapes that colour a terminal, set its title and ring its bell; C1 has its own."""
    escapes = "\\u001b[31m\\u001b]0;x\\u0007\\u009b2J"
    lens = (lenses_folder() / "plano_convex.toml").read_text().replace('title = "', f'title = "{escapes}')
    path = tmp_path / "lens.toml"
    path.write_text(lens)
    for words in (["info"], ["import"]):
        assert main([words[0], str(path), *words[1:]]) == 0
    path.write_text(f'"{escapes}" = 1\n' + lens)
    assert main(["info", str(path)]) == 2
    written = "".join(capsys.readouterr())
    assert "Plano-convex singlet" in written and not re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f]", written)


def exr(path):
    write_photo(path, np.zeros((200, 300, 3)), "linear")


PICTURES = {
    ".png": lambda path: Image.new("RGB", (300, 200)).save(path),
    ".16.png": lambda path: path.write_bytes(write_deep(np.zeros((200, 300, 3), np.uint16))),
    ".jpg": lambda path: Image.new("RGB", (300, 200)).save(path),
    ".tif": lambda path: tifffile.imwrite(path, np.zeros((200, 300, 3), np.uint8), compression="zlib"),
    ".exr": lambda path: pytest.importorskip("OpenEXR") and exr(path),
    ".npy": lambda path: np.save(path, np.zeros((200, 900))),
    ".fits": lambda path: pytest.importorskip("astropy.io.fits").PrimaryHDU(np.zeros((200, 900))).writeto(path),
}


@pytest.mark.parametrize("ending", PICTURES)
def test_one_limit_in_samples_holds_for_every_reader_of_pictures(ending, tmp_path, monkeypatch):
    """180 000 samples, read until one number of `p2sf.files.reading` allows fewer."""
    path = tmp_path / f"picture{ending}"
    PICTURES[ending](path)
    assert read_counts(path).values.size in (60_000, 180_000)
    monkeypatch.setattr("p2sf.files.reading.MOST_SAMPLES", 179_999)
    readers = [read_counts] if ending in (".npy", ".fits") else [read_counts, read_photo, read_samples, scene_depths]
    for read in readers:
        with pytest.raises(P2SFError):
            read(path)
    monkeypatch.setattr("p2sf.files.reading.MOST_SAMPLES", 180_000)
    assert read_counts(path).values.size in (60_000, 180_000)


def scene_depths(path):
    return read_scene_depths(path, 100.0, 1000.0)
