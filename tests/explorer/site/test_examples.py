"""Every code block of the handbook runs, or says why it cannot."""

import re
import warnings
from contextlib import redirect_stderr
from io import StringIO
from pathlib import Path

import pytest

from p2sf_explorer.handbook.pages import PAGES, page
from p2sf_explorer.site.examples import ExampleError, blocks, run_examples
from p2sf_explorer.site.generated import pages
from p2sf_explorer.site.pictures import MADE, WINDOW

WITH_CODE = [name for name in PAGES if "```" in page(name)]


@pytest.mark.slow
@pytest.mark.parametrize("name", WITH_CODE)
def test_the_examples_of_a_page_run_without_a_warning_and_make_its_pictures(name, tmp_path):
    """What a page shows to be copied runs without a caution of the program, but for one that the page announces."""
    errors, announced = StringIO(), "the target fits the picture in 4 ways"
    with redirect_stderr(errors), warnings.catch_warnings():
        warnings.simplefilter("always")
        printed = run_examples(page(name), tmp_path, f"{name}.md")
    said = re.findall(r"^.*(?:warning: |P2SFWarning: |caution: ).*$", printed + errors.getvalue(), re.MULTILINE)
    assert all(name == "measure" and announced in line for line in said), said
    for picture in set(MADE.findall(page(name))) - set(WINDOW):
        assert (tmp_path / picture).read_bytes().startswith(b"\x89PNG"), picture
    if name == "tutorial":  # its sentence is that six coefficients are not enough at 10° and a fit is
        found = dict(re.findall(r"^(\w+) +R² = (-?[\d.]+)$", printed, re.MULTILINE))
        assert float(found["seidel"]) < 0.9 < 0.99 < float(found["fitted"]) <= float(found["traced"]) <= 1


def test_the_pages_of_the_handbook_have_examples_of_every_kind():
    assert set(WITH_CODE) >= {"tutorial", "import", "export", "plans", "theory"}
    kinds = {(block.language, block.mark) for name in PAGES for block in blocks(page(name))}
    assert {("python", ""), ("sh", ""), ("toml", "file")} <= kinds
    assert all(set(MADE.findall(page(name))) <= set(WINDOW) for name in PAGES if name not in WITH_CODE)


def test_the_other_pages_of_the_site_run_or_say_why_not():
    """The README's commands are run by tests/test_readme.py."""
    for name, text in pages().items():
        for block in blocks(text):
            runs = block.mark == "not run" or (name == "index.md" and block.language in ("sh", "python"))
            assert runs or name == "cli.md", f"{name}, line {block.line}"  # which shows how each command is called


def test_every_fence_of_a_page_is_the_beginning_or_the_end_of_a_block():
    for name in PAGES:
        assert len(re.findall(r"^```", page(name), re.MULTILINE)) == 2 * len(list(blocks(page(name)))), name


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("```python\n1 / 0\n```", "line 1: ZeroDivisionError"),
        ("one\n\n```sh\np2sf info no_such_lens\n```", "line 3: ValueError"),
        ("```sh\nrm -r /\n```", "no command of ours"),
        ("```toml\na = \n```", "line 1: TOMLDecodeError"),
        ("```matlab\nx\n```", 'nothing runs a block of "matlab"'),
    ],
)
def test_a_block_that_fails_is_named_with_its_line(tmp_path, text, said):
    with pytest.raises(ExampleError, match=re.escape(said)):
        run_examples(text, tmp_path, "page.md")


def test_a_marked_block_is_not_run_and_a_file_is_written(tmp_path):
    text = "<!-- not run: none -->\n```python\n1 / 0\n```\n\n<!-- file: a.txt -->\n```text\nwords\n```\n"
    assert run_examples(text, tmp_path, "page.md") == ""
    assert Path(tmp_path / "a.txt").read_text() == "words\n"
