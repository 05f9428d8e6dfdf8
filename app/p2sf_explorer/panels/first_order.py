"""The first-order data table."""

from PySide6.QtWidgets import QScrollArea

from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.first_order import Row
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.readout import Columns, FactTable

TIP = "First-order data: everything that follows from paraxial rays alone. Hover over a row for its definition."


class FirstOrderPanel:
    """Three tables of names and values: lens, pupils, source."""

    def __init__(self, store: Store):
        self.widget = Card("First order", TIP)
        self.tables = tuple(FactTable(self.widget) for _ in range(3))
        self.columns = Columns(self.tables)
        area = QScrollArea(self.widget)
        area.setAccessibleName(tr("First-order data"))
        area.setWidgetResizable(True)
        area.setFrameShape(QScrollArea.Shape.NoFrame)
        area.setWidget(self.columns)
        for part in (area, area.viewport(), self.columns):
            part.setAutoFillBackground(False)
        self.widget.set_body(area)

    def show(self, live: Live) -> None:
        """Show the figures."""
        columns: tuple[tuple[Row, ...], ...] = live.views["first_order"].found
        for table, rows in zip(self.tables, columns, strict=True):
            table.show_rows(rows)
        self.columns.fit()

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.columns.restyle(theme)
