"""A table of rows that are chosen whole, in the look of the theme."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.i18n.tr import tr

ROW_PX = 22


class PlainTable(QTableWidget):
    """A table without a grid, its columns as wide as their contents; ``heads`` and ``name`` are English."""

    def __init__(self, heads: tuple[str, ...], name: str):
        super().__init__(0, len(heads))
        self.setHorizontalHeaderLabels([tr(head) for head in heads])
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setTabKeyNavigation(False)
        self.setShowGrid(False)
        self.verticalHeader().hide()
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        if heads:
            header.setSectionResizeMode(len(heads) - 1, QHeaderView.ResizeMode.Stretch)
        self.setAccessibleName(tr(name))
        self.setMinimumHeight(60)

    def restyle(self, theme: Tokens) -> None:
        """Take the scale of a theme."""
        self.verticalHeader().setDefaultSectionSize(theme.px(ROW_PX))
        self.viewport().update()

    def put(self, row: int, column: int, text: str, right: bool = False) -> QTableWidgetItem:
        """Write a cell."""
        item = QTableWidgetItem(text)
        side = Qt.AlignmentFlag.AlignRight if right else Qt.AlignmentFlag.AlignLeft
        item.setTextAlignment(side | Qt.AlignmentFlag.AlignVCenter)
        item.setFlags(item.flags() & ~Qt.ItemFlag.ItemIsEditable)
        self.setItem(row, column, item)
        return item
