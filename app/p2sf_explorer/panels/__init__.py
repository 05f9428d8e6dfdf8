"""The panels: one file each and one entry each in `p2sf_explorer.state.panels`, imported when first opened.

A panel is a `Panel`: it paints an answer and computes nothing. What it shows beyond the answer, its view, is a function
``view(live)`` without Qt in `p2sf_explorer.compute.views`, whose `View` arrives as ``live.views[key]``.
"""

from typing import Protocol, runtime_checkable

from PySide6.QtWidgets import QToolButton

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.state.panels import PanelEntry, resolve
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.panel_store import PanelStore
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card


@runtime_checkable
class Panel(Protocol):
    """What the window asks of every panel.

    Through the panel's card the window covers it with a sentence where it has nothing to show (``show_overlay``), names
    the side of a comparison (``show_side``), and hears that the panel is wanted in a window of its own
    (``apart_asked``).
    """

    @property
    def widget(self) -> Card:
        """The card that the panel stands in."""

    def show(self, live: Live) -> None:
        """Paint an answer."""

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""


@runtime_checkable
class BackgroundPanel(Panel, Protocol):
    """A panel with processes or graphics memory of its own, which it gives up with the window."""

    def stop(self) -> None:
        """End the background work for good."""


@runtime_checkable
class PreparingPanel(Panel, Protocol):
    """A panel that needs some time before it can show its first picture."""

    @property
    def busy(self) -> bool:
        """Whether it is still being prepared."""


@runtime_checkable
class FilmedPanel(Panel, Protocol):
    """A panel whose builds can be filmed."""

    film: QToolButton
    """The button that asks for the film."""


def build(entry: PanelEntry, store: Store, side: str = "") -> Panel:
    """Return a new panel of a registry entry, whose store puts no values of B into A; ``side`` "b" shows only B."""
    own = PanelStore(store, side)
    made: Panel = resolve(f"panels.{entry.panel}")(own)
    own.setParent(made.widget)
    return made


def end_work(panel: Panel) -> None:
    """End the background work of a panel for good."""
    if isinstance(panel, BackgroundPanel):
        panel.stop()
    for late in panel.widget.findChildren(LateAnswers):
        late.stop()
