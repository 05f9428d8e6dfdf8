"""The example notebooks run from top to bottom, and what they assert holds."""

import json
import re

import pytest

from p2sf_explorer.handbook.pages import FOLDER
from p2sf_explorer.site.notebooks import SHOWN, notebook_page

pytestmark = pytest.mark.slow

NOTEBOOKS = sorted((FOLDER / "notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, tmp_path, monkeypatch):
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    monkeypatch.setenv("MPLBACKEND", "agg")
    nbclient.NotebookClient(
        nbformat.read(path, as_version=4), timeout=60, resources={"metadata": {"path": str(tmp_path)}}
    ).execute()


def test_a_notebook_is_a_page_with_what_it_draws(monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "agg")
    for name in SHOWN:
        text, pictures = notebook_page(name)
        assert len(pictures) >= 4 and all(picture.startswith(b"\x89PNG") for picture in pictures.values())
        assert set(re.findall(r"\.\./made/([\w.]+)", text)) == set(pictures) and "```text" in text


def test_there_are_four_and_none_holds_results():
    assert {path.stem for path in NOTEBOOKS} == {"as_built", "camera", "own_picture", "paper"}
    for path in NOTEBOOKS:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        assert not any(cell.get("outputs") or cell.get("execution_count") for cell in cells), path.name
