"""Every text has German; a German window refuses with German numbers and names, the command line with its flags."""

import os
import re
from pathlib import Path

import pytest

from p2sf.cli import main
from p2sf.errors import P2SFError
from p2sf.io.photo_files import read_photo
from p2sf.lensfile.library import find_lens
from p2sf.tolerance.files import read_tolerances
from p2sf_explorer.i18n.extract import missing, obsolete_texts, required_texts
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.i18n.messages import said
from tests.fuzz.hostile import jpeg, png, tiff

ENGLISH = re.compile(r"\b(the|is|are|give|write|of|and|with|not|has|holds|choose|to|it|or|from|which|that)\b")
BROKEN = "SURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV abc\n"


@pytest.mark.parametrize(
    "text",
    [
        "source depth",  # a message in a table of limits
        'the {quantity} "{text}" is not a number; write one such as 12.5',  # an error
        "field angle",  # handed on by two functions
        "Play or pause (Space on a slider)",  # the tip of a button made by a method
        "the PSF",  # the words of a choice
        "Film of the sweep…",  # a command
        "coma",  # of a loop over a constant
        "Lens",  # a group of panels
        "a radius of 0 with an index is a plane",  # a method of another object, its name used elsewhere
        "Azimuth",  # the control of a parameter
        "Front-stop landscape singlet",  # a lesson's lens
    ],
)
def test_texts_are_found_however_they_are_handed_on(text):
    assert text in required_texts()


def test_what_a_function_of_a_library_is_given_needs_no_german():
    assert "cut off or too large" not in required_texts()  # of zlib.error


def test_every_text_of_the_sources_has_german_and_no_other():
    assert len(required_texts()) > 500 and missing("de") == () and obsolete_texts("de") == ()


@pytest.fixture
def german_window(window):
    set_language("de")
    yield window
    set_language("en")


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"wavelength_nm": 150.5}, "150,5 nm"),
        ({"wavelength_nm": 99.5}, "Wellenlänge ist 99,5 nm"),
        ({"focus_mm": 10.5}, "10,5 mm"),
        ({"depth_mm": -3.5}, "−3,5 mm; eine Zahl von 0,001 bis ∞ mm"),
    ],
)
def test_a_german_window_refuses_in_german_with_a_decimal_comma(german_window, changes, words):
    german_window.store.update(**changes)
    said = german_window.banner.text.text().replace("\u00a0", " ")
    assert german_window.banner.isVisible() and words in said
    assert not ENGLISH.search(said) and not re.search(r"\d\.\d", said) and "--" not in said


def test_a_broken_lens_file_is_refused_in_german(german_window, tmp_path):
    path = tmp_path / "kaputt.zmx"
    path.write_text(BROKEN)
    assert not german_window.commands.open_path(str(path))
    said = german_window.banner.text.text().replace("\u00a0", " ")
    assert "kaputt.zmx, Zeile 5:" in said and not ENGLISH.search(said.partition("kaputt.zmx")[2])
    german_window.store.update(tab="profiles")


REFUSED = {
    "a pipe": (os.mkfifo, ".png"),
    "nothing": (lambda path: None, ".png"),
    "a folder": (Path.mkdir, ".toml"),
    "a bomb": (lambda path: path.write_bytes(png(60_000, 60_000, 8, 2)), ".png"),
    "chunks": (lambda path: path.write_bytes(png(9, 9, 8, 2, *[(b"abCd", bytes(10**7))] * 7)), ".png"),
    "scans": (lambda path: path.write_bytes(jpeg(90, 90, 100)), ".jpg"),
    "strips": (lambda path: path.write_bytes(tiff(9, 60_000, 8, (273, 4, 10**9, 8), (279, 4, 10**9, 8))), ".tif"),
    "a key of many parts": (lambda path: path.write_text("a." * 1000 + "a = 1"), ".toml"),
    "nested lists": (lambda path: path.write_text("a = " + "[" * 10_000), ".toml"),
}


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no pipes with names")
@pytest.mark.parametrize("kind", REFUSED)
def test_why_a_file_is_refused_is_said_in_german(kind, tmp_path):
    """The words of the system and of the limits too, which are handed from reader to reader."""
    make, ending = REFUSED[kind]
    path = tmp_path / f"x{ending}"
    make(path)
    with pytest.raises(P2SFError) as refused:
        (read_tolerances_of if ending == ".toml" else read_photo)(path)
    set_language("de")
    try:
        words = said(refused.value).replace(str(path), "")
    finally:
        set_language("en")
    assert words != str(refused.value).replace(str(path), "") and not ENGLISH.search(words)


def read_tolerances_of(path):
    return read_tolerances(path, find_lens("tessar"))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("psf double_gauss_28 --wavelength-nm 150.5", "--wavelength-nm 150.5 nm is outside"),
        ("psf double_gauss_28 --field-deg 95.5", "--field-deg is 95.5°"),
        ("spot landscape --field-deg 30 --clip", "leave --clip off"),
        ("psf double_gauss_28 --focus-mm 10.5", "--focus-mm is 10.5 mm"),
        ("psf double_gauss_28 --depth-mm -3.5", "--depth-mm is -3.5 mm"),
    ],
)
def test_the_command_line_refuses_with_its_flags(arguments, words, capsys):
    assert main(arguments.split()) == 2
    assert words in capsys.readouterr().err


def test_the_command_line_names_file_and_line(tmp_path, capsys):
    path = tmp_path / "broken.zmx"
    path.write_text(BROKEN)
    assert main(["info", str(path)]) == 2
    assert "broken.zmx, line 5:" in capsys.readouterr().err
