"""The README keeps its promises: its example runs and its commands exist."""

import re
import shlex
import shutil
import tomllib
from pathlib import Path

import pytest

from p2sf.cli import COMMANDS
from p2sf.image.charts import draw_chart
from p2sf.io.photo_files import write_photo
from p2sf_explorer.site.examples import run_line

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```(\w+)\n(.*?)```", README, re.DOTALL)
LINES = [line for kind, text in BLOCKS if kind == "sh" for line in text.splitlines() if line.startswith("p2sf ")]


def test_the_library_example_runs_as_written(capsys):
    examples = [text for kind, text in BLOCKS if kind == "python"]
    assert len(examples) == 1
    exec(examples[0], {})
    assert re.search(r"\b(seidel|fitted|traced|huygens)\b", capsys.readouterr().out)


@pytest.mark.parametrize("line", LINES)
def test_every_command_shown_exists(line):
    assert shlex.split(line, comments=True)[1] in COMMANDS


def test_one_version_stands_in_the_project_and_the_last_release_in_its_citation():
    """A release is dated in the changelog; what comes after it is a development version of the next."""
    stated = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    number, date = re.search(
        r"^## ([\d.]+) – ([\d-]+)$", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE
    ).groups()
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {number}\ndate-released: {date}\n" in citation
    parts = [tuple(map(int, words.removesuffix(".dev0").split("."))) for words in (stated, number)]
    assert parts[0] == parts[1] if stated == number else stated.endswith(".dev0") and parts[0] > parts[1]


LONG = {"tradeoff", "paper"}  # seconds each, and run by tests/cli/test_tradeoff.py and tests/studies


@pytest.mark.slow
def test_the_commands_run_in_their_order(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shutil.copy(ROOT / "tests/data/import/doublet.zmx", "YOURS.zmx")
    shutil.copy(ROOT / "tests/data/import/own.agf", ".")
    Path("FOLDER").mkdir()
    Path("SCENE.toml").write_text("tolerance = 0.2\n[sensor]\nrows = 16\ncolumns = 24\npixel_um = 60.0\n")
    write_photo("picture.png", draw_chart("text", 16, 24))
    for line in LINES:
        if line.split()[1] not in LONG:
            run_line(line)
    assert {"psf.tiff", "colour.png", "lens.toml", "dg.npz", "one.png", "out.png"} <= {
        path.name for path in tmp_path.iterdir()
    }


def test_every_file_linked_or_named_exists():
    linked = re.findall(r"\]\(([^)#]+)\)", README) + re.findall(r"`((?:p2sf|app|tests|lenses|\.ci)/[\w./]*)`", README)
    assert linked
    for path in linked:
        assert path.startswith("http") or (ROOT / path).exists(), path


def test_ci_runs_the_command_the_readme_shows():
    marked = README.split("<!-- test command -->")[1].split("```")[1]
    assert "pip install -q -e '.[test]'" in marked and marked.strip().endswith("-m pytest -n auto")
    assert "<!-- test command -->" in (ROOT / ".ci" / "run").read_text()
