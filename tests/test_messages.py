"""Messages: one template, the names and numbers of whoever shows it, and no way back from words to data."""

import copy
import pickle

import numpy as np
import pytest

from p2sf.errors import GeometryError, LensFileError, P2SFError
from p2sf.messages import Alternatives, Message, Number, ParameterName, Style

GERMAN = {
    "{parameter} is {value:g} mm; give {remedy}": "{parameter} ist {value:g} mm; {remedy} angeben",
    "a positive number": "eine positive Zahl",
    "or": "oder",
}
WINDOW = Style(
    translate=lambda text: GERMAN.get(text, text),
    parameter={"depth_mm": "Abstand"}.__getitem__,
    number=lambda said: said.replace(".", ",").replace("-", "−").replace("inf", "∞"),
)
DEPTH = P2SFError(
    "{parameter} is {value:g} mm; give {remedy}",
    parameter="depth_mm",
    value=-0.5,
    remedy=Message("a positive number"),
)


def test_a_script_reads_plain_english_with_python_names():
    assert str(DEPTH) == "depth_mm is -0.5 mm; give a positive number"


def test_a_window_reads_its_language_its_control_and_its_numbers():
    assert DEPTH.message.text(WINDOW) == "Abstand ist −0,5 mm; eine positive Zahl angeben"


def test_only_numbers_are_written_as_numbers():
    said = Message(
        "{path}: version {version}, {count:d} of {share:.1f} %",
        path="a-1.5.toml",
        version="0.1",
        count=2,
        share=np.float32(7.5),
    )
    assert said.text(WINDOW) == "a-1.5.toml: version 0.1, 2 of 7,5 %"


def test_a_number_in_digits_is_written_as_a_number_where_it_is_shown():
    said = Message("f/{aperture}, {name}", aperture=Number("4.00"), name="4.00")
    assert said.text(WINDOW) == "f/4,00, 4.00" and str(said) == "f/4.00, 4.00"


def test_choices_and_lists_are_joined():
    said = Message("choose {names}; known: {known}", names=Alternatives(("a", "b", "c")), known=("x", 1.5))
    assert said.text(WINDOW) == "choose a, b oder c; known: x, 1,5"
    assert str(Message("choose {names}", names=Alternatives(("a",)))) == "choose a"


def test_a_message_holds_errors_and_parameters():
    said = Message("channel {name}: {error} ({other})", name="R", error=DEPTH, other=ParameterName("depth_mm"))
    assert said.text(WINDOW) == "channel R: Abstand ist −0,5 mm; eine positive Zahl angeben (Abstand)"


def test_braces_in_values_and_in_plain_texts_stay():
    assert str(P2SFError("{path} is none", path="{0}")) == "{0} is none"
    assert str(P2SFError("a {brace}")) == "a {brace}"


def test_a_lens_files_error_says_where():
    error = LensFileError("radius {text} is no number", "a.zmx", 7, text="1O")
    assert str(error) == "a.zmx, line 7: radius 1O is no number" and (error.path, error.line) == ("a.zmx", 7)
    assert str(LensFileError("nothing in it", "a.zmx")) == "a.zmx: nothing in it"


@pytest.mark.parametrize(
    "error", [DEPTH, LensFileError("radius {r:g}", "a", 3, r=1.0), GeometryError("none")], ids=repr
)
def test_errors_travel_between_processes(error):
    for came in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
        assert type(came) is type(error) and str(came) == str(error) and came.message == error.message
        assert came.message.text(WINDOW) == error.message.text(WINDOW)
        assert vars(came).keys() == vars(error).keys()


def test_equal_messages_are_one_key():
    assert len({Message("a {b:g}", b=1.0), Message("a {b:g}", b=1.0), Message("a {b:g}", b=2.0)}) == 2


def test_messages_of_equal_values_are_one_key_however_they_read():
    whole, real = Message("{a}", a=1), Message("{a}", a=1.0)
    assert whole == real and hash(whole) == hash(real) and str(whole) != str(real)
