"""CODE V text cut into commands: ';' between them, '&' to go on, '!' before a remark, quotes respected."""

import re
from dataclasses import dataclass

from p2sf.lensfile.source_text import LensText


@dataclass(frozen=True)
class Command:
    """One command: its name in capitals, its words (quotes taken off), and the line it starts on."""

    name: str
    words: tuple[str, ...]
    line: int


def commands(source: LensText):
    """Yield the commands of a file; remarks are dropped, continued lines joined, quotes respected."""
    pending, start = "", 0
    for line, text in enumerate(source.lines, 1):
        code, goes_on = _without_remark(text)
        start = start or line
        pending += code
        if goes_on and len(pending) < 100_000:
            pending += " "
            continue
        for part in re.findall(r"(?:'[^']*'|\"[^\"]*\"|[^;'\"]|['\"])+", pending):
            found = re.findall(r"'[^']*'|\"[^\"]*\"|\S+", part)
            if found:
                yield Command(
                    found[0].upper(),
                    tuple(word.strip("'\"") if word[0] in "'\"" else word for word in found[1:]),
                    start,
                )
        pending, start = "", 0


def _without_remark(text: str) -> tuple[str, bool]:
    """Return a line without its remark, and whether it goes on with the next line."""
    code = re.match(r"(?:'[^']*'|\"[^\"]*\"|[^!])*", text)[0].rstrip()
    return (code[:-1], True) if code.endswith("&") else (code, False)
