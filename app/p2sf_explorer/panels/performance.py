"""The table of figures over the field that an engineer reads first."""

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QTableWidgetItem

from p2sf.messages import Message
from p2sf.performance import PerformanceTable
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.performance import PerformanceRequest, answer
from p2sf_explorer.i18n.messages import WINDOW, said
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.compared_lists import FieldList, FrequencyList
from p2sf_explorer.widgets.copying import copy_data
from p2sf_explorer.widgets.plain_table import PlainTable
from p2sf_explorer.widgets.plan_note import small_button

TIP = (
    "Performance: figures over the field by exact rays. RMS: of the wavefront, without piston and tilt. S and T: "
    "sagittal and tangential contrast. R80: the radius that holds 80 % of the light. Illumination: relative to the "
    "middle of the field. Lateral colour: shortest less longest wavelength of the lens. Click a row to go to its field."
)
COPY_TIP = "Copy the table with all its digits as CSV (Ctrl+Shift+D)"
SAME_DEG = 1e-3


class FiguresTable(PlainTable):
    """A row for each field; ``taken``: the number of a row that was clicked, or entered."""

    taken = Signal(int)

    def __init__(self) -> None:
        super().__init__((), "Performance")
        self.table: PerformanceTable | None = None
        self.cellClicked.connect(lambda row, _: self.taken.emit(row))
        self.cellActivated.connect(lambda row, _: self.taken.emit(row))

    def show_table(self, table: PerformanceTable) -> None:
        """Show the rows that are known."""
        self.table = table
        heads, rows = table.headings(WINDOW), table.rows(WINDOW)
        with QSignalBlocker(self):
            self.setColumnCount(len(heads))
            for column, head in enumerate(heads):
                item = QTableWidgetItem("\n".join(head))
                item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                self.setHorizontalHeaderItem(column, item)
            self.setRowCount(len(rows))
            for row, texts in enumerate(rows):
                for column, text in enumerate(texts):
                    self.put(row, column, text, right=True)

    def rows_of_data(self) -> list[list[str]]:
        """Return the table with all digits, heads first."""
        return self.table.rows_of_data() if self.table else []


class PerformancePanel:
    """The table, the fields and frequencies it is for, and a button that copies it."""

    def __init__(self, store: Store):
        self._store = store
        self.widget = Card("Performance", TIP)
        self.fields = FieldList(store, self.widget)
        self.frequencies = FrequencyList(store, self.widget)
        self.copy = small_button("Copy as CSV", COPY_TIP, self._copy)
        self.table = FiguresTable()
        for tool in (self.fields, self.frequencies, self.copy):
            self.widget.add_tool(tool)
        self.widget.set_body(self.table)
        self.late = LateAnswers(self.widget, answer, self._paint, self.widget.set_readout)
        self._live: Live | None = None
        self._shown: PerformanceRequest | None = None
        self.table.taken.connect(self._go)

    def show(self, live: Live) -> None:
        """Show the table of the present setup, or have it computed in the background."""
        self._live = live
        request: PerformanceRequest = live.views["performance"].question
        self.fields.show_fields(request.fields_deg)
        self.frequencies.show_frequencies(request.frequency_per_mm)
        if live.quality == "settled":
            self.late.ask(request)
        self._mark()

    def restyle(self, theme: Tokens) -> None:
        """Take the scale of a theme."""
        self.table.restyle(theme)

    def _paint(self, request: PerformanceRequest, table: PerformanceTable) -> Message | str:
        self._shown = request
        self.table.show_table(table)
        self._mark()
        return said(table.reasons[0]) if table.reasons else " "

    def _mark(self) -> None:
        """Choose the row of the present field."""
        if self._live is None or self._shown is None:
            return
        here = self._live.state.optics.field_deg
        rows = [row for row, angle in enumerate(self._shown.fields_deg) if abs(angle - here) < SAME_DEG]
        with QSignalBlocker(self.table):
            self.table.selectRow(rows[0]) if rows else self.table.clearSelection()

    def _go(self, row: int) -> None:
        if self._shown and row < len(self._shown.fields_deg):
            self._store.update(field_deg=self._shown.fields_deg[row], field_x_deg=0.0)

    def _copy(self) -> None:
        if copy_data(self.widget):
            self._store.said.emit(Message("The panel's data are on the clipboard"))
