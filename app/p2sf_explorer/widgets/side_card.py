"""A card whose controls stand in a column at its left: a low and wide panel keeps all its height for its picture."""

from PySide6.QtWidgets import QComboBox, QHBoxLayout, QSizePolicy, QVBoxLayout, QWidget

from p2sf_explorer.widgets.card import Card

SIDE_PX = 196


class SideCard(Card):
    """A card with title, readout and controls in a column of ``SIDE_PX`` pixels, and the picture beside it."""

    def __init__(self, title: str, tip: str = "", parent=None):
        super().__init__(title, tip, parent)
        self.side, self.whole = QVBoxLayout(), QHBoxLayout()
        self.side.addStrut(SIDE_PX)
        self.side.setSpacing(4)
        self.column.removeItem(self.head)
        self.head.setParent(None)
        self.side.addLayout(self.head)
        self.whole.setSpacing(10)
        self.whole.addLayout(self.side)
        self.column.addLayout(self.whole, 1)

    def add_line(self, *widgets: QWidget) -> None:
        """Put small controls that share a line under those before; they are as wide as the column lets them be."""
        line = QHBoxLayout()
        line.setSpacing(4)
        for widget in widgets:
            choice = isinstance(widget, QComboBox)
            widget.setSizePolicy(_WIDE if choice else _OWN, QSizePolicy.Policy.Fixed)
            line.addWidget(widget, 1 if choice else 0)
        self.side.addLayout(line)

    def add_rest(self, widget: QWidget) -> None:
        """Let a widget have what is left of the column's height."""
        widget.setSizePolicy(_WIDE, QSizePolicy.Policy.Ignored)
        self.side.addWidget(widget, 1)
        self.side.addStretch()  # where the widget is hidden

    def set_body(self, widget: QWidget) -> None:
        """Put the picture beside the column."""
        self.whole.addWidget(widget, 1)


_WIDE, _OWN = QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Expanding
