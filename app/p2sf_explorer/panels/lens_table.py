"""The lens as a table to edit; the picture follows every value typed."""

from collections.abc import Callable

from PySide6.QtCore import QModelIndex, Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QPushButton, QTableView

from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.editing import check_surface, deleted, edited_state, inserted, with_stop, with_value
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.setup import prescription
from p2sf_explorer.files.saving import ask_save_lens
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.results.lens_table import Rows
from p2sf_explorer.store.panel_store import PanelStore
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.surface_table import KEYS, STOP, LocalNumbers, SurfaceModel

TIP = "Lens: one row per surface in the order light meets them; type into a cell, Ctrl+Z takes it back."
ROW = 22  # pixels
WIDTHS = {"radius": 108, "thickness": 108, "medium": 170, "semi_diameter": 140, "conic": 80, "stop": 52}
TOOLS = (
    (
        "Insert after",
        "Split what follows this surface by a plane; nothing changes until it is edited (Insert)",
        "_insert",
    ),
    ("Delete", "Take this surface out; the others stay where they are (Delete)", "_delete"),
    ("Back to file", "Drop every edit and take the lens as its file has it", "_revert"),
    ("Save lens as…", "Save the lens as .toml, .zmx or ISET .json (Ctrl+Shift+S)", "_save"),
)


class LensTablePanel:
    """Surfaces as rows to type into; every edit is one step of undo."""

    def __init__(self, store: Store):
        self._store = store
        self.widget = Card("Lens", TIP)
        self.model, self.view = SurfaceModel(self.widget), QTableView(self.widget)
        self.view.setModel(self.model)
        self.buttons = {method: self._button(text, tip, method) for text, tip, method in TOOLS}
        self._prepare()
        self.widget.set_body(self.view)
        self.model.typed.connect(self._typed)
        self.view.clicked.connect(self._choose_stop)
        self.view.activated.connect(self._choose_stop)
        for keys, action in (("Ins", self._insert), ("Del", self._delete)):
            QShortcut(QKeySequence(keys), self.view, context=Qt.ShortcutContext.WidgetShortcut).activated.connect(
                action
            )

    def _button(self, text: str, tip: str, method: str) -> QPushButton:
        button = QPushButton(tr(text), self.widget)
        button.setObjectName("small")
        button.setToolTip(tr(tip))
        button.clicked.connect(getattr(self, method))
        self.widget.add_tool(button)
        return button

    def _prepare(self) -> None:
        triggers = QAbstractItemView.EditTrigger
        self.view.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed | triggers.AnyKeyPressed)
        self.view.setItemDelegate(LocalNumbers(self.view))
        self.view.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.view.setAccessibleName(tr("Surfaces of the lens"))
        self.view.setFrameShape(QTableView.Shape.NoFrame)
        self.view.setShowGrid(False)
        self.view.setAlternatingRowColors(True)
        self.view.setTabKeyNavigation(False)  # Tab leaves the table, the arrow keys move in it
        rows, columns = self.view.verticalHeader(), self.view.horizontalHeader()
        rows.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        rows.setDefaultSectionSize(ROW)
        rows.setFixedWidth(self.view.fontMetrics().horizontalAdvance("000") + 20)  # a lens may have a hundred surfaces
        rows.setDefaultAlignment(Qt.AlignmentFlag.AlignCenter)
        columns.setHighlightSections(False)
        columns.setStretchLastSection(True)
        for column, key in enumerate(KEYS):
            self.view.setColumnWidth(column, max(WIDTHS.get(key, 160), columns.sectionSizeHint(column)))

    def show(self, live: Live) -> None:
        """Follow the lens."""
        rows: Rows = live.views["lens"]
        self.model.show_rows(rows)
        self.buttons["_revert"].setEnabled(rows.edited)
        count = len(rows.texts)
        surfaces = tr("{count} surfaces", count=count) if count > 1 else tr("1 surface")
        self.widget.set_readout(f"{surfaces} · {tr('edited')}" if rows.edited else surfaces)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.view.setStyleSheet(
            f"QTableView {{ background: {theme.card}; alternate-background-color: {theme.raised};"
            f" selection-background-color: {theme.accent}; selection-color: {theme.accent_text}; outline: none; }}"
            f"QTableView::item {{ padding: 0 6px; border: none; }}"
            f"QTableView QLineEdit {{ background: {theme.card}; border: 1px solid {theme.accent}; border-radius: 0;"
            f" padding: 0 2px; min-height: 0; }}"
            f"QHeaderView, QHeaderView::section, QTableCornerButton::section {{ background: {theme.card};"
            f" color: {theme.muted}; border: none; padding: 0 6px; font-size: 12px; }}"
        )

    def _typed(self, number: int, column: str, text: str) -> None:
        self._edit(with_value, number, column, text)

    def _choose_stop(self, index: QModelIndex) -> None:
        if index.column() == STOP:
            self._edit(with_stop, index.row() + 1)

    def _insert(self) -> None:
        self._edit_row(inserted, 1)

    def _delete(self) -> None:
        self._edit_row(deleted, 0)

    def _edit_row(self, edit: Callable[..., Lens], step: int) -> None:
        """Insert or delete at the present row, and select the row after it or in its place."""
        index = self.view.currentIndex()
        row, column = (index.row(), index.column()) if index.isValid() else (self.model.rowCount() - 1, 0)
        if self._edit(edit, row + 1):
            self.view.setCurrentIndex(self.model.index(min(row + step, self.model.rowCount() - 1), column))

    def _edit(self, edit: Callable[..., Lens], number: int, *arguments: object) -> bool:
        """Try an edit of a surface; refuse one that gives no lens, or a lens without a picture."""
        state = self._store.state
        if isinstance(self._store, PanelStore) and self._store.refused_for_b():
            return False
        try:
            lens = prescription(state)
            check_surface(lens, number)
            self._store.replace(edited_state(state, edit(lens, number, *arguments)))
        except P2SFError as error:
            self._store.refused.emit(error)
            return False
        return True

    def _revert(self) -> None:
        self._store.update(lens_text=None)

    def _save(self) -> None:
        ask_save_lens(self.widget, self._store)
