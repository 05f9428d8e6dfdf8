"""Commands by name, from which shortcuts, the command palette and the list of keys are made. No Qt in here."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Command:
    """A command: its English name, what it runs, its keys (Qt's spelling, the first is shown), and its group.

    ``further``: words that it is also found by, such as the description of a lens, in any language.
    ``worded``: the title is in the words of a person or a lesson, and not translated.
    """

    title: str
    run: Callable[[], object]
    keys: tuple[str, ...] = ()
    group: str = "Window"
    further: str = ""
    worded: bool = False
