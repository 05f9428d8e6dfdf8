"""The first-order data table."""

from PySide6.QtWidgets import QHBoxLayout, QScrollArea, QVBoxLayout, QWidget

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.results.first_order import Row
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.readout import FactTable

TIP = "First-order data: everything that follows from paraxial rays alone; hover over a row for its definition."
GAP = 28


class FirstOrderPanel:
    """Three columns of names and values: lens, pupils, source."""

    def __init__(self, store: Store):
        self.widget = Card("First-order data", TIP)
        self.tables = tuple(FactTable(self.widget) for _ in range(3))
        body = QWidget()
        row = QHBoxLayout(body)
        row.setContentsMargins(0, 0, 10, 0)
        row.setSpacing(GAP)
        for table in self.tables:
            column = QVBoxLayout()
            column.addWidget(table)
            column.addStretch(1)
            row.addLayout(column, 1)
        area = QScrollArea(self.widget)
        area.setAccessibleName(tr("First-order data"))
        area.setWidgetResizable(True)
        area.setFrameShape(QScrollArea.Shape.NoFrame)
        area.setWidget(body)
        for part in (area, area.viewport(), body):
            part.setAutoFillBackground(False)
        self.widget.set_body(area)

    def show(self, live: Live) -> None:
        """Show the figures."""
        columns: tuple[tuple[Row, ...], ...] = live.views["first_order"]
        for table, rows in zip(self.tables, columns, strict=True):
            table.show_rows(rows)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        for table in self.tables:
            table.restyle(theme)
