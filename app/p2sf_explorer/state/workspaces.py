"""The layout of panels: named workspaces, and moving a panel. Uses no Qt.

A panel has one place: the stage, the rail beside it, or the tabs that end the rail, whatever windows of their own there
are. Functions that move a panel return the changed entries of the state, for `Store.update`.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

from p2sf_explorer.state.state import Display, State, change


@dataclass(frozen=True)
class Workspace:
    """An arrangement of the window; its entries are those of `Display` by the same names."""

    stage: str
    rail: tuple[str, ...]
    tab: str
    stage_share: float
    rail_shares: tuple[float, ...] = ()
    rail_side: str = "right"
    show_rail: bool = True
    show_controls: bool = True


FIRST = Display()
TEACH = "teach"
WORKSPACES = {
    "explore": Workspace(FIRST.stage, FIRST.rail, FIRST.tab, FIRST.stage_share),
    "inspect": Workspace("matrix", ("psf",), "mtf", 0.7),
    "lens": Workspace("layout", ("psf",), "lens", 0.56, (0.34, 0.66), rail_side="bottom"),
    "image": Workspace("image", ("psf",), "mtf", 0.64, (0.36, 0.64), rail_side="bottom"),
    TEACH: Workspace("psf", ("coefficients",), "profiles", 0.62, show_rail=False),
}


def arrangement(display: Display) -> Workspace:
    """Return the positions of all panels."""
    return Workspace(**{part.name: getattr(display, part.name) for part in fields(Workspace)})


def with_workspace(state: State, name: str, workspace: Workspace) -> State:
    """Return the state arranged as a workspace; panels in windows of their own stay there."""
    return change(state, workspace=name, **{part.name: getattr(workspace, part.name) for part in fields(Workspace)})


def place_panels(display: Display, panels: Sequence[str]) -> Display:
    """Return the display with each of the known ``panels`` at most once, whatever a file states."""
    stage = display.stage if display.stage in panels else FIRST.stage
    rail = tuple(key for key in dict.fromkeys(display.rail) if key in panels and key != stage)
    free = [key for key in (display.tab, FIRST.tab, *panels) if key in panels and key not in (stage, *rail)]
    return replace(display, stage=stage, rail=rail, tab=free[0])


def on_show(display: Display) -> tuple[str, ...]:
    """Return the panels on show: on the stage, beside it, and in windows of their own."""
    beside = (*display.rail, display.tab) if display.show_rail else ()
    return tuple(dict.fromkeys((display.stage, *beside, *display.windows)))


def exchange(display: Display, panel: str, other: str) -> dict[str, Any]:
    """Return the changes by which a panel takes the place of ``other``, which goes where the panel was.

    A panel from behind the tabs, or out of a window of its own, leaves the other one in front of the tabs.
    """
    if panel == other:
        return {}
    swap = {panel: other, other: panel}
    made: dict[str, Any] = {
        "stage": swap.get(display.stage, display.stage),
        "rail": tuple(swap.get(key, key) for key in display.rail),
        "tab": swap.get(display.tab, display.tab),
        "windows": tuple(key for key in display.windows if key != panel),
    }
    if panel not in (display.stage, *display.rail):
        made["tab"] = panel if other == display.tab else other
    return made


def on_stage(display: Display, panel: str) -> dict[str, Any]:
    """Return the changes that move a panel to the stage."""
    return exchange(display, panel, display.stage)


def kept_in_rail(display: Display, panel: str) -> dict[str, Any]:
    """Return the changes that move a panel from the tabs to the rail."""
    if panel in (display.stage, *display.rail):
        return {}
    return {"rail": (*display.rail, panel), "rail_shares": (), "show_rail": True}


def put_to_tabs(display: Display, panel: str) -> dict[str, Any]:
    """Return the changes that move a panel from the rail to the front of the tabs."""
    if panel not in display.rail:
        return {}
    return {"rail": tuple(key for key in display.rail if key != panel), "rail_shares": (), "tab": panel}
