"""What a screen reader finds: Qt's accessibility tree of a widget, and the words for each of its nodes."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from PySide6.QtCore import QObject
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QWidget

ROLE, TEXT = QAccessible.Role, QAccessible.Text
TAGS = re.compile(r"<[^>]*>|&nbsp;")
SPOKEN = {  # of the roles, as Orca and NVDA say them
    ROLE.Button: "button",
    ROLE.ButtonMenu: "menu button",
    ROLE.CheckBox: "check box",
    ROLE.ComboBox: "combo box",
    ROLE.EditableText: "entry",
    ROLE.Slider: "slider",
    ROLE.PageTab: "tab",
    ROLE.PageTabList: "tab list",
    ROLE.List: "list",
    ROLE.Table: "table",
    ROLE.Chart: "chart",
    ROLE.Graphic: "picture",
    ROLE.Grouping: "panel",
    ROLE.StaticText: "",
}
EMPTY = {ROLE.NoRole, ROLE.Client, ROLE.Pane, ROLE.Border, ROLE.LayeredPane}


@dataclass(frozen=True)
class Node:
    """A node that is on screen: its role, its texts, and whether a key or mouse does something to it."""

    role: QAccessible.Role
    name: str
    value: str
    description: str
    focusable: bool
    widget: QObject | None

    def words(self) -> str:
        """Return what is said of it: name, role, value."""
        value = self.value if self.value != self.name else ""
        return ", ".join(part for part in (self.name, SPOKEN.get(self.role, self.role.name.lower()), value) if part)


def nodes(widget: QWidget) -> Iterator[Node]:
    """Yield the visible nodes of a widget's tree, each before those inside it."""
    yield from _below(QAccessible.queryAccessibleInterface(widget))


def _below(found) -> Iterator[Node]:
    if found is None or not found.isValid() or found.state().invisible:
        return
    texts = [" ".join(TAGS.sub(" ", found.text(kind)).split()) for kind in (TEXT.Name, TEXT.Value, TEXT.Description)]
    yield Node(found.role(), *texts, bool(found.state().focusable), found.object())
    if found.role() != ROLE.ComboBox:  # its list is hidden and read when it opens
        for k in range(found.childCount()):
            yield from _below(found.child(k))


def transcript(widget: QWidget) -> list[str]:
    """Return line by line what a screen reader says when it reads a widget through."""
    return [words for node in nodes(widget) if (words := node.words()) and node.role not in EMPTY]
