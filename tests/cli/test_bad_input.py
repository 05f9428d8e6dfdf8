"""Whatever is wrong with an input: exit code 2 and one sentence with place, value and remedy, no traceback."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from p2sf.cli import COMMANDS
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.lensfile.writing import write_lens
from tests.conftest import sentence

ROOT = Path(__file__).parents[2]


@pytest.fixture
def broken(tmp_path):
    """Return a function that writes the Double Gauss with one piece of its text exchanged."""

    def write(old: str, new: str) -> Path:
        text = lens_to_toml(find_lens("double_gauss_28"))
        assert old in text
        path = tmp_path / "broken.toml"
        path.write_text(text.replace(old, new, 1), encoding="utf-8")
        return path

    return write


def test_a_missing_file(refused):
    assert "nowhere.toml" in refused("info", "nowhere.toml")


def test_a_misspelt_lens_is_answered_with_names(refused):
    assert "double_gauss_28" in refused("info", "double_gaus_28")


def test_a_glass_nobody_sells(refused, broken):
    message = refused("info", broken("N-SSK2", "N-SSK99"))
    assert "N-SSK99" in message and "surface 1" in message


def test_a_thickness_that_is_a_word(refused, broken):
    message = refused("coefficients", broken("thickness = 8.75", 'thickness = "abc"'))
    assert all(word in message for word in ("thickness", "abc", "surface 1"))


def test_a_stop_index_beyond_the_last_surface(refused, broken):
    message = refused("info", broken("stop_surface = 6", "stop_surface = 99"))
    assert "99" in message and "11" in message


OPTIONS = [
    ("psf", "--pixels 63 --sampling fft", ("--pixels is 63", "even", "64")),
    ("psf", "--pixels 0", ("--pixels is 0",)),
    ("psf", "--pixels 2.5", ("--pixels", "2.5")),
    ("spot", "--rings 2.5", ("--rings", "2.5")),
    ("psf", "--pixels 1000000", ("--pixels is 1000000", "4096")),
    ("psf", "--pixel-um 0", ("--pixel-um is 0 µm",)),
    ("psf", "--pixel-um nan", ("--pixel-um is nan µm",)),
    ("psf", "--min-r2 1.5", ("--min-r2 is 1.5",)),
    ("psf", "--sampling fft --method fitted", ("--sampling is fft", "--method fitted")),
    ("psf", "--method magic", ("magic", "--method", "huygens")),
    ("psf", "-o nowhere/a.npz", ("nowhere/a.npz", "make the folder first")),
    ("spot", "-o nowhere/a.csv", ("nowhere/a.csv", "make the folder first")),
    ("tradeoff", "-o nowhere/a.json", ("nowhere/a.json", "make the folder first")),
    ("database build", "-o nowhere/a.npz", ("nowhere/a.npz", "make the folder first")),
    ("psf", "-o spot.jpg", (".jpg", ".npz")),
    ("info", "--wavelength-nm 200000", ("200000 nm", "outside")),
    ("info", "--wavelength-nm 0", ("--wavelength-nm is 0 nm",)),
    ("info", "--wavelength-nm nan", ("--wavelength-nm is nan nm",)),
    ("coefficients", "--field-deg 90", ("--field-deg is 90°",)),
    ("coefficients", "--field-deg -90", ("--field-deg is -90°",)),
    ("coefficients", "--field-deg nan", ("--field-deg is nan°",)),
    ("coefficients", "--field-deg 3 --image-height-mm 4", ("--field-deg and --image-height-mm",)),
    ("coefficients", "--object-height-mm 4", ("--object-height-mm is 4 mm", "--depth-mm")),
    ("coefficients", "--image-height-mm 1e308", ("--image-height-mm is 1e+308 mm", "90°")),
    ("coefficients", "--object-height-mm -1e308 --depth-mm 9", ("--object-height-mm is -1e+308 mm", "90°")),
    ("info", "--depth-mm abc", ("--depth-mm", "abc")),
    ("info", "--depth-mm 0", ("--depth-mm is 0 mm",)),
    ("info", "--depth-mm -100", ("--depth-mm is -100 mm",)),
    ("info", "--depth-mm", ("--depth-mm", "requires an argument")),
    ("info", "--focus-mm 10", ("--focus-mm is 10 mm",)),
    ("info", "--f-number 0", ("--f-number is 0",)),
    ("info", "--stop open", ("open", "--stop", "auto")),
    ("info", "--magic", ("--magic", "--help")),
    ("info", "extra", ("extra", "--help")),
]


@pytest.mark.parametrize(("command", "options", "words"), OPTIONS, ids=[f"{c} {o}" for c, o, _ in OPTIONS])
def test_an_option_that_cannot_be(refused, command, options, words):
    message = refused(*command.split(), "double_gauss_28", *options.split())
    assert all(word in message for word in words), message


def test_a_command_that_is_none(refused):
    assert "coefficients" in refused("coeficients", "double_gauss_28")


def test_a_command_that_is_like_none(refused):
    message = refused("frobnicate")
    assert f"available commands: {', '.join(COMMANDS)}; p2sf --help" in message, "all of them, not eight"
    assert "available commands: build, info; p2sf database --help" in refused("database", "frobnicate")


def test_a_lens_left_out(refused):
    assert "LENS" in refused("info")


def test_text_that_is_no_lens_file(refused, tmp_path):
    (tmp_path / "a.toml").write_bytes(b"\xff\xfe not a lens = [")
    assert "a.toml" in refused("info", tmp_path / "a.toml")


def test_a_folder_is_no_lens(refused, tmp_path):
    assert tmp_path.name in refused("info", tmp_path)


def whole_process(*arguments, **environment) -> subprocess.CompletedProcess:
    kept = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
    call = "import sys; from p2sf.cli import main; sys.exit(main())"
    command = [sys.executable, "-c", call, *arguments]
    return subprocess.run(command, cwd=ROOT, env={**kept, **environment}, capture_output=True, text=True, check=False)


def test_a_failing_process_has_code_2_and_one_line():
    run = whole_process("info", "double_gauss_28", "--field-deg", "90")
    assert run.returncode == 2 and "--field-deg is 90°" in sentence(run.stderr)


def test_no_display_is_one_sentence_and_no_abort():
    run = whole_process("explore")
    assert run.returncode == 2 and "display" in sentence(run.stderr)


def test_a_full_disk_behind_standard_output_is_one_sentence():
    call = "import sys; from p2sf.cli import main; sys.exit(main())"
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-c", call, "info", "double_gauss_28", "--json"]
        run = subprocess.run(command, cwd=ROOT, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert run.returncode == 2 and "No space left" in sentence(run.stderr)


def test_a_reader_that_leaves_early_is_no_failure():
    call = "import sys; from p2sf.cli import main; sys.exit(main())"
    command = [sys.executable, "-c", call, "lenses"]
    read, write = os.pipe()
    os.close(read)
    with os.fdopen(write, "w") as closed:
        run = subprocess.run(command, cwd=ROOT, stdout=closed, stderr=subprocess.PIPE, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")


@pytest.mark.parametrize(("command", "name"), [("report", "lens.json"), ("import", "lens.toml"), ("spot", "lens.json")])
def test_a_lens_is_not_overwritten_by_what_is_made_of_it(refused, tmp_path, command, name):
    path = tmp_path / name
    write_lens(find_lens("landscape"), path)
    before = path.read_bytes()
    assert f"would overwrite the input {path}" in refused(command, path, "-o", path)
    assert path.read_bytes() == before
