"""Every text has German; a German window refuses with German numbers and names, the command line with its flags."""

import re

import pytest

from p2sf.cli import main
from p2sf_explorer.i18n.extract import missing, obsolete_texts, required_texts
from p2sf_explorer.i18n.language import set_language

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
