"""Runs the code blocks of a page of Markdown, one after the other, as a reader would. No Qt in here.

A Python block is executed, with the names that those before it left; of a block of the shell every ``p2sf`` line. A
comment ``<!-- file: NAME -->`` before a block has it written to a file instead, and ``<!-- not run: REASON -->`` says
why it cannot be run.
"""

import os
import re
import shlex
import tomllib
from collections.abc import Iterator
from contextlib import chdir, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Any

from p2sf.cli import main

BLOCK = re.compile(r"(?:^<!-- (file|not run): (.+?) -->\n+)?^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class ExampleError(Exception):
    """A block that failed, or that nothing runs: which page and line, and why."""


@dataclass(frozen=True)
class Block:
    """A code block: its language, its code, the line of its first fence, and the mark before it with what that says."""

    language: str
    code: str
    line: int
    mark: str
    about: str


def blocks(text: str) -> Iterator[Block]:
    """Yield the code blocks of a page in their order."""
    for found in BLOCK.finditer(text):
        mark, about, language, code = found.groups(default="")
        yield Block(language, code, text.count("\n", 0, found.start(3)) + 1, mark, about)


def run_examples(text: str, folder: Path, page: str) -> str:
    """Run a page's blocks in a folder and return what they print; ExampleError names the page and the line."""
    names: dict[str, Any] = {"__name__": page}
    printed = StringIO()
    with chdir(folder), redirect_stdout(printed):
        for block in blocks(text):
            try:
                _run(block, names, f"{page}, line {block.line}")
            except Exception as error:  # whatever the example raises is reported with its place
                raise ExampleError(f"{page}, line {block.line}: {type(error).__name__}: {error}") from error
    return printed.getvalue()


def _run(block: Block, names: dict[str, Any], place: str) -> None:
    if block.mark == "not run":
        return
    if block.mark == "file":
        Path(block.about).write_text(block.code, encoding="utf-8")
    elif block.language == "python":
        exec(compile(block.code, place, "exec"), names)
    elif block.language == "sh":
        for line in block.code.replace("\\\n", " ").splitlines():
            run_line(line)
    elif block.language == "toml":
        tomllib.loads(block.code)
    else:
        raise ValueError(f'nothing runs a block of "{block.language}"; say before it why it is not run')


def run_line(line: str) -> None:
    """Run one line of the shell, ``p2sf …``; ValueError where it fails or is another command."""
    words = shlex.split(line, comments=True)
    if not words:
        return
    if words[0] != "p2sf":
        raise ValueError(f'"{words[0]}" is no command of ours; say before the block why it is not run')
    os.environ.setdefault("COLUMNS", "120")
    if code := main(words[1:]):
        raise ValueError(f"{line} ends with code {code}")
