"""Parts of the window that share its room, and handles between them."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSplitter, QWidget

from p2sf_explorer.charts.theme import SPACE


def splitter(orientation: Qt.Orientation, widgets: list[QWidget], shares: tuple[int, ...]) -> QSplitter:
    """Return a splitter whose parts keep these shares of the room."""
    made = QSplitter(orientation)
    made.setHandleWidth(SPACE)
    made.setChildrenCollapsible(False)
    for k, (widget, share) in enumerate(zip(widgets, shares, strict=True)):
        made.addWidget(widget)
        made.setStretchFactor(k, share)
    made.setSizes([100 * share for share in shares])
    return made
