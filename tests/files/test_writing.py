"""What a file is besides its contents outlives its being written again: mode, owner, links; what is no file stays."""

import json
import os
import stat
import subprocess
import sys
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from p2sf.cli import main
from p2sf.errors import ExportError, FileWarning, P2SFError
from p2sf.files.writing import check_own, check_place, write_beside, write_json
from p2sf.io.dng import RawLevels, write_dng
from p2sf.io.photo_files import write_photo
from p2sf.io.psf_files import write_psf
from p2sf.lensfile.agf import FormulaGlass
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.lensfile.writing import write_lens
from p2sf.psf.seidel import seidel_psf
from p2sf_explorer.files.snapshot import write_state
from p2sf_explorer.playback.film import FilmFrame, write_film
from p2sf_explorer.state.state import State
from tests.support.waves import waves

ROOT = Path(__file__).parents[2]
PICTURE = np.full((4, 6, 3), 0.5, np.float32)
FRAME = FilmFrame(4, 2, bytes(24))


def psf_to(path):
    return write_psf(seidel_psf(waves(), 16), path)


def film_to(path):
    return write_film(iter((FRAME, FRAME)), path, 40)


WRITERS = {
    "lens.toml": lambda path: write_lens(find_lens("tessar"), path),
    "lens.zmx": lambda path: write_lens(find_lens("tessar"), path),
    "figures.json": lambda path: write_json(path, {"a": 1.0}),
    "state.json": lambda path: write_state(State(), path),
    "psf.npz": psf_to,
    "psf.tiff": psf_to,
    "psf.csv": psf_to,
    "photo.png": lambda path: write_photo(path, PICTURE),
    "photo.tif": lambda path: write_photo(path, PICTURE),
    "raw.dng": lambda path: write_dng(path, np.ones((4, 4), np.uint16), RawLevels(0, 4095, "rggb", (1.0, 0.0))),
    "film.gif": film_to,
}


def write_bytes(path, data=b"new"):
    return write_beside(path, lambda handle: handle.write(data))


@pytest.mark.parametrize("name", WRITERS)
def test_every_writer_keeps_mode_and_link(tmp_path, name):
    target, link = tmp_path / "kept" / name, tmp_path / name
    target.parent.mkdir()
    WRITERS[name](target)
    target.chmod(0o600)
    link.symlink_to(Path("kept") / name)
    before = target.stat().st_ino
    WRITERS[name](link)
    assert link.is_symlink() and os.readlink(link) == f"kept/{name}"
    assert stat.S_IMODE(target.stat().st_mode) == 0o600
    assert target.stat().st_ino != before, "another file has taken its place"
    assert {item.name for item in tmp_path.iterdir()} == {"kept", name}
    assert {item.name for item in target.parent.iterdir()} == {name}


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o664, 0o755])
def test_the_mode_does_not_follow_the_umask(tmp_path, mode):
    path = tmp_path / "file"
    path.write_bytes(b"old")
    path.chmod(mode)
    before = os.umask(0o027)
    try:
        write_bytes(path)
        write_bytes(tmp_path / "fresh")
    finally:
        os.umask(before)
    assert stat.S_IMODE(path.stat().st_mode) == mode and path.read_bytes() == b"new"
    assert stat.S_IMODE((tmp_path / "fresh").stat().st_mode) == 0o640, "one that is new does follow it"


def test_a_file_of_another_owner_stays_theirs(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"old")
    try:
        os.chown(path, 12345, 23456)
    except PermissionError:
        pytest.skip("only root gives files away")
    write_bytes(path)
    assert (path.stat().st_uid, path.stat().st_gid) == (12345, 23456)


def test_a_link_to_nothing_yet_makes_the_file_and_one_in_a_circle_is_a_sentence(tmp_path):
    (tmp_path / "link").symlink_to("there")
    write_bytes(tmp_path / "link")
    assert (tmp_path / "there").read_bytes() == b"new" and (tmp_path / "link").is_symlink()
    (tmp_path / "round").symlink_to("about")
    (tmp_path / "about").symlink_to("round")
    for attempt in (write_bytes, check_place):
        with pytest.raises(ExportError, match="cannot be written"):
            attempt(tmp_path / "round")
    assert (tmp_path / "round").is_symlink()


def test_a_hard_link_is_cut_with_a_warning_and_the_other_name_keeps_the_old_contents(tmp_path):
    path, other = tmp_path / "file", tmp_path / "other"
    path.write_bytes(b"old")
    path.chmod(0o600)
    other.hardlink_to(path)
    with pytest.warns(FileWarning, match="hard link"):
        write_bytes(path)
    assert (path.read_bytes(), other.read_bytes()) == (b"new", b"old")
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    with warnings.catch_warnings(action="error"):
        write_bytes(path)  # which now has one name


def test_the_command_line_says_that_a_hard_link_was_cut(tmp_path, capsys):
    (tmp_path / "lens.toml").write_text(lens_to_toml(find_lens("tessar")))
    (tmp_path / "out.toml").write_text("old")
    (tmp_path / "other.toml").hardlink_to(tmp_path / "out.toml")
    assert main(["import", str(tmp_path / "lens.toml"), "-o", str(tmp_path / "out.toml")]) == 0
    assert capsys.readouterr().err.startswith("warning: ")
    assert (tmp_path / "other.toml").read_text() == "old"


@pytest.mark.parametrize("name", WRITERS)
def test_no_writer_replaces_a_pipe_or_a_device(tmp_path, name):
    path = tmp_path / name
    os.mkfifo(path)
    with pytest.raises(P2SFError):
        WRITERS[name](path)
    assert stat.S_ISFIFO(path.stat().st_mode)
    path.unlink()
    try:
        os.mknod(path, stat.S_IFCHR | 0o600, os.makedev(1, 3))  # one of the test's own, which root could lose
    except PermissionError:
        path.symlink_to(os.devnull)
    with pytest.raises(P2SFError):
        WRITERS[name](path)
    assert stat.S_ISCHR(path.stat().st_mode)
    assert [item.name for item in tmp_path.iterdir()] == [name]


def test_what_is_no_file_is_refused_before_the_work(tmp_path, capsys):
    os.mkfifo(tmp_path / "psf.npz")
    assert main(["psf", "tessar", "-o", str(tmp_path / "psf.npz")]) == 2
    assert "pipe or a device" in capsys.readouterr().err
    for place in (os.devnull, tmp_path, tmp_path / "no" / "file"):
        with pytest.raises(ExportError, match="cannot be written"):
            check_place(place)


def test_a_write_protected_file_stays(tmp_path, monkeypatch):
    path = tmp_path / "file"
    path.write_bytes(b"old")
    monkeypatch.setattr(os, "access", lambda *_: False)  # root may write to every file
    with pytest.raises(ExportError, match="write-protected"):
        write_bytes(path)
    assert path.read_bytes() == b"old"


def test_names_that_nobody_typed_take_the_place_of_files_of_the_program_alone(tmp_path):
    path = tmp_path / "beside"
    check_own(path, b"mark")
    path.write_bytes(b"with a mark in it")
    check_own(path, b"mark")
    path.write_bytes(b"mine")
    with pytest.raises(ExportError, match="not of this program"):
        check_own(path, b"mark")


def test_a_glass_catalogue_and_frames_of_a_film_leave_the_files_of_their_names(tmp_path):
    """They lie beside what was named: lens.agf beside lens.zmx, film_0001.png where film.png was asked for."""
    tessar = find_lens("tessar")
    first = replace(tessar.surfaces[0], medium=FormulaGlass("HOUSE1", 5, (1.6, 0.0), (0.3, 2.0)))
    lens = replace(tessar, surfaces=(first, *tessar.surfaces[1:]))
    write_lens(lens, tmp_path / "lens.zmx")
    catalogue = (tmp_path / "lens.agf").read_text()
    write_lens(lens, tmp_path / "lens.zmx")
    assert (tmp_path / "lens.agf").read_text() == catalogue
    (tmp_path / "lens.agf").write_text("NM MINE 2 0 1.5 60 0 0\n")
    whole = (tmp_path / "lens.zmx").read_bytes()
    with pytest.raises(ExportError, match=r"lens\.agf is there already"):
        write_lens(lens, tmp_path / "lens.zmx")
    assert (tmp_path / "lens.agf").read_text() == "NM MINE 2 0 1.5 60 0 0\n"
    assert (tmp_path / "lens.zmx").read_bytes() == whole
    for _ in range(2):
        film_to(tmp_path / "film.png")
    write_photo(tmp_path / "film_0002.png", PICTURE)
    mine = (tmp_path / "film_0002.png").read_bytes()
    with pytest.raises(ExportError, match=r"film_0002\.png is there already"):
        film_to(tmp_path / "film.png")
    assert (tmp_path / "film_0002.png").read_bytes() == mine


def run_closed(redirection: str) -> subprocess.CompletedProcess:
    command = f'"{sys.executable}" -m p2sf info tessar {redirection}'
    return subprocess.run(command, shell=True, capture_output=True, text=True, cwd=ROOT)


@pytest.mark.parametrize("redirection", [">&-", ">&- 2>&-"])
def test_a_closed_output_is_no_traceback(redirection):
    found = run_closed(redirection)
    assert (found.returncode, found.stdout, found.stderr) == (0, "", "")


def test_a_film_or_an_exr_that_its_temporary_folder_cannot_take_is_a_sentence(tmp_path):
    """The folder of temporary files takes 100 kB a file; OpenEXR raised RuntimeError, ffmpeg wrote half a film."""
    code = f"""
import json, resource, signal
import numpy as np
from p2sf.errors import ExportError
from p2sf.io.photo_files import write_photo
from p2sf_explorer.playback.film import FilmFrame, write_film

signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, resource.RLIM_INFINITY))
noise = np.random.default_rng(1).random((240, 320, 3))
frames = [FilmFrame(320, 240, (255 * np.roll(noise, n)).astype(np.uint8).tobytes()) for n in range(8)]
told = []
for name, write in (
    ("picture.exr", lambda path: write_photo(path, noise)),
    ("film.mp4", lambda path: write_film(iter(frames), path, 40)),
):
    try:
        write({str(tmp_path)!r} + "/" + name)
    except ExportError as error:
        told.append(str(error))
print(json.dumps(told))
"""
    pytest.importorskip("OpenEXR")
    pytest.importorskip("imageio_ffmpeg")
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    told = json.loads(run.stdout.splitlines()[-1])
    assert len(told) == 2 and all("temporary files" in line for line in told)
    assert not list(tmp_path.iterdir())
