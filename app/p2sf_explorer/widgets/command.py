"""What a person can do, by name: shortcuts, the command palette and the list of keys are made from this. No Qt."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Command:
    """One thing to do: its English name, its keys (Qt's spelling, the first is shown), what runs, and its group."""

    title: str
    run: Callable[[], object]
    keys: tuple[str, ...] = ()
    group: str = "Window"
