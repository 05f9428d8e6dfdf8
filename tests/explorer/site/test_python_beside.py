"""The line of Python beside a command runs, and the page of the command line shows it."""

import matplotlib as mpl
import numpy as np
import pytest

import p2sf
from p2sf.cli import COMMANDS
from p2sf_explorer.site.python_beside import PYTHON, with_python

SHOWN = {"explore"}  # a widget, which tests/explorer/test_notebook_widget.py shows


def test_a_line_stands_below_the_heading_of_its_command():
    page = "".join(f"## p2sf {command}\n\ntext\n\n" for command in COMMANDS)
    assert set(PYTHON) <= set(COMMANDS)
    for command, line in PYTHON.items():
        assert line in with_python(page).split(f"## p2sf {command}\n")[1].split("## ")[0]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::p2sf.P2SFWarning")
@pytest.mark.parametrize("command", sorted(set(PYTHON) - SHOWN))
def test_a_line_of_python_runs(command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    mpl.use("agg")
    array = np.asarray(p2sf.psf_of_opd(np.zeros((64, 64)), 0.1, 550, pixels=33, pixel_um=0.5))
    eval(PYTHON[command], {"p2sf": p2sf, "np": np, "array": array})
