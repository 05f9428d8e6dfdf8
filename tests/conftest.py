"""What many tests ask of the command line: that it succeeds, that it answers in JSON, that it refuses in a sentence."""

import json

import pytest

from p2sf.cli import main


@pytest.fixture
def said(capsys):
    """Return a function that runs a command line which must succeed, and returns what it printed."""

    def run(*arguments) -> str:
        assert main([str(x) for x in arguments]) == 0, capsys.readouterr().err
        return capsys.readouterr().out

    return run


@pytest.fixture
def answer(said):
    """Return a function that runs a command line with --json and returns the one object it printed."""

    def run(*arguments) -> dict:
        text = said(*arguments, "--json")
        assert text.count("\n") == 1
        return json.loads(text, parse_constant=pytest.fail)  # NaN and Infinity are not JSON

    return run


@pytest.fixture
def refused(capsys):
    """Return a function that runs a command line which must fail with code 2, and returns its one sentence."""

    def run(*arguments) -> str:
        assert main([str(x) for x in arguments]) == 2
        output, error = capsys.readouterr()
        assert output == ""
        return sentence(error)

    return run


def sentence(error: str) -> str:
    """Return the one line on standard error, checked to be a sentence that ends with a remedy."""
    assert "Traceback" not in error
    assert error.count("\n") == 1 and error.startswith("p2sf: ") and error.endswith((".\n", "?\n"))
    assert "; " in error  # what is wrong; what to do
    return error
