"""A missing screen is said before Qt would abort on it."""

import socket

import pytest

from p2sf_explorer.application import display
from p2sf_explorer.application.display import display_problem


@pytest.fixture
def server():
    """Return the DISPLAY of something that listens where an X server would."""
    for number in range(7300, 7400):
        listening = socket.socket(socket.AF_UNIX)
        try:
            listening.bind(f"\0/tmp/.X11-unix/X{number}")
        except OSError:
            listening.close()
            continue
        listening.listen()
        with listening:
            yield f":{number}"
        return


def test_a_display_that_answers_is_taken(server):
    assert display_problem({"DISPLAY": server}, "linux") is None
    assert display_problem({"DISPLAY": f"unix{server}.0"}, "linux") is None


@pytest.mark.parametrize("name", [":7299", ":7299.0", "localhost:59000", "localhost:99999999", "nonsense", ":"])
def test_a_display_that_nobody_serves_is_named(name):
    assert display_problem({"DISPLAY": name}, "linux").values == {"display": name}


def test_a_missing_library_is_named_with_its_package(server, monkeypatch):
    def missing(_):
        raise OSError("cannot open shared object file")

    monkeypatch.setattr(display, "CDLL", missing)
    assert display_problem({"DISPLAY": server}, "linux") == display.NO_LIBRARY
