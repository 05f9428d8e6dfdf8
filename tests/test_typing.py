"""What is public has types: a script that uses all of it is clean under `mypy --strict`, and wrong names are found."""

import runpy
import subprocess
import sys
from pathlib import Path

import pytest

import p2sf

pytestmark = pytest.mark.slow
ROOT = Path(__file__).parents[1]
SCRIPT = ROOT / "tests" / "support" / "typed_script.py"
WRONG = "import p2sf\n\np2sf.rendr\np2sf.render(p2sf.load_lens('tessar'), tolerance=0.9)\n"


def type_report(path: Path) -> str:
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", path], cwd=ROOT, capture_output=True, text=True)
    return done.stdout


def test_a_script_that_uses_what_is_public_is_clean():
    assert "no issues" in type_report(SCRIPT)


def test_a_checker_finds_names_that_there_are_not(tmp_path):
    (tmp_path / "wrong.py").write_text(WRONG)
    found = type_report(tmp_path / "wrong.py")
    assert '"rendr"' in found and '"tolerance"' in found


@pytest.mark.filterwarnings("ignore::p2sf.P2SFWarning")
def test_the_script_runs(tmp_path, capsys):
    runpy.run_path(str(SCRIPT))["main"](tmp_path)
    assert "<Lens" in capsys.readouterr().out and (tmp_path / "lens.toml").exists()
    assert {"Medium", "Choice", "Plan", "ObjectPoints", "NamedArrays"} <= set(p2sf.__all__)
