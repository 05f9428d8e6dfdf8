"""What many tests ask of the command line: that it succeeds, answers in JSON, refuses in a sentence."""

import json
import os
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from p2sf.cli import main
from p2sf.glass.media import catalogue_glass
from p2sf.glass.pages import GlassPage, page
from p2sf_explorer.compute import setup

os.environ["P2SF_CACHE"] = ""  # tests neither read nor fill the user's cache

# A busy machine takes longer than hypothesis allows, and every run tries the same examples: 25 of each law with every
# commit, 100 with a release (`--hypothesis-profile release`).
settings.register_profile(
    "release", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow], max_examples=100
)
settings.register_profile("commit", settings.get_profile("release"), max_examples=25)
settings.load_profile("commit")


class FailureNames:
    """Prints the name of a test as soon as it fails."""

    def __init__(self, terminal):
        self.terminal = terminal

    def pytest_runtest_logreport(self, report):
        if report.failed:
            self.terminal.write_line(f"\nFAILED {report.nodeid}", red=True)


@pytest.hookimpl(trylast=True)  # when the terminal is there
def pytest_configure(config):
    terminal = config.pluginmanager.get_plugin("terminalreporter")
    if terminal is not None:  # workers have none
        config.pluginmanager.register(FailureNames(terminal), "failure-names")


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


@pytest.fixture
def glasses_of_version_0_1(monkeypatch):
    """Round the glasses' coefficients to 32 bits, as version 0.1 had them, for files that it wrote."""

    def rounded(name: str) -> GlassPage:
        found = page(name)
        return replace(found, numbers=tuple(float(np.float32(number)) for number in found.numbers))

    _forget_glasses()
    monkeypatch.setattr("p2sf.glass.catalogue.page", rounded)
    yield
    _forget_glasses()


def _forget_glasses() -> None:
    for cached in (catalogue_glass, setup._load, setup._read_edited):
        cached.cache_clear()
