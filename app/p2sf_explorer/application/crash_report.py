"""An unexpected error as text for the authors: versions and the place in the program, no paths. No Qt in here."""

import re
from pathlib import PurePath
from traceback import StackSummary, TracebackException

from p2sf.lensfile.library import shipped_lenses
from p2sf.version import version_text
from p2sf_explorer.state.state import State

OWN_PARTS = "p2sf", "p2sf_explorer"
# In quotes anything with a slash or backslash; else a word that has one after its beginning, as in C:\Users or /home.
QUOTED = re.compile(r"(['\"])[^'\"\n]*[/\\][^'\"\n]*\1")
BARE = re.compile(r"(?<![\w<'\"])(?:[A-Za-z]:)?[/\\~][^\s'\"<>]*[\w)]|\b[\w.-]+(?:[/\\][\w.-]+)*[/\\][\w.-]+\.\w+")
HIDDEN = "<path>"
OWN_LENS = "a lens of the person's own"


def report(error: TracebackException, state: State) -> str:
    """Return the report: versions, what the window showed, the error with every error before it."""
    optics, display = state.optics, state.display
    lens = optics.lens if optics.lens in shipped_lenses() and not optics.lens_text else OWN_LENS
    shown = f"{lens}; method {optics.method}; stage {display.stage}; tab {display.tab}; language {display.language}"
    return f"{version_text()}\n\n{shown}\n\n{traceback_text(error)}"


def traceback_text(error: TracebackException) -> str:
    """Return an error as Python would print it, with the packages' own paths in place of the machine's."""
    before = error.__cause__ or (None if error.__suppress_context__ else error.__context__)
    lines = "".join(place_lines(error.stack)) + without_paths("".join(error.format_exception_only()))
    return f"{traceback_text(before)}\nthen\n{lines}" if before else lines


def place_lines(stack: StackSummary) -> list[str]:
    """Return where an error came through, outermost first, with the line of code where the sources are there."""
    places = [f"  {inside(frame.filename)}:{frame.lineno} in {frame.name}\n" for frame in stack]
    return [f"{place}    {f.line}\n" if f.line else place for place, f in zip(places, stack, strict=True)]


def inside(filename: str) -> str:
    """Return a source file's path from its package on, as it is the same on every machine; its name for others."""
    parts = PurePath(filename.replace("\\", "/")).parts
    for start in ("site-packages", "_internal"):
        if start in parts:
            return "/".join(parts[parts.index(start) + 1 :])
    own = [k for k, part in enumerate(parts[:-1]) if part in OWN_PARTS]
    return "/".join(parts[own[-1] if own else -1 :])


def without_paths(text: str) -> str:
    """Return a text with every path in it hidden: of files and folders, on any system."""
    return BARE.sub(HIDDEN, QUOTED.sub(HIDDEN, text))
