"""The lens as a table to edit; the picture follows every value typed."""

from collections.abc import Callable

from PySide6.QtCore import QModelIndex, Qt
from PySide6.QtGui import QBrush, QColor, QKeySequence, QShortcut
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QPushButton, QTableView

from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens
from p2sf.paraxial.bending import element_of
from p2sf_explorer.charts.painting import metrics
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.editing import (
    check_surface,
    delete_surface,
    edited_state,
    insert_surface,
    with_scrubbed,
    with_stop,
    with_value,
)
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.setup import prescription
from p2sf_explorer.compute.views.lens_table import Rows
from p2sf_explorer.files.saving import ask_save_lens
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels.lens_table.glass_completion import GlassDelegate
from p2sf_explorer.panels.lens_table.sliders import bending_slider, show_bending, show_stop, stop_slider
from p2sf_explorer.panels.lens_table.surface_table import KEYS, STOP, LocalNumbers, SurfaceModel, SurfaceTableView
from p2sf_explorer.state.build_errors import renumber
from p2sf_explorer.state.state import State, change
from p2sf_explorer.store.panel_store import PanelStore
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, chooser
from p2sf_explorer.widgets.typed import typed

TIP = "Lens: one row per surface, in the order in which light meets them. Type into a cell; Ctrl+Z undoes it."
LENGTHS = "radius", "thickness", "semi_diameter"
FOCUS = (("off", "sensor stays"), ("paraxial", "keep paraxial focus"), ("rms", "keep best focus"))
FOCUS_TIP = (
    "Keep in focus: while you edit the lens, the sensor follows its paraxial image, or goes to the smallest RMS of "
    "the present point, so that you see the aberrations and not the defocus."
)
ROW, TYPE = 22, 13  # pixels at scale 1
WIDTHS = {"radius": 108, "thickness": 108, "medium": 170, "semi_diameter": 140, "conic": 80, "stop": 52}
TOOLS = (
    (
        "Insert after",
        "Insert a plane behind this surface; nothing changes until you edit it (Insert)",
        "_insert",
    ),
    ("Delete", "Remove this surface; the others stay where they are (Delete)", "_delete"),
    ("Back to file", "Discard all edits and return to the lens in the file", "_revert"),
    ("Save lens as…", "Save the lens as .toml, .zmx, .seq or ISET .json (Ctrl+Shift+S)", "_save"),
)

STEPS_OF_ROWS: dict[Callable[..., Lens], int] = {insert_surface: 1, delete_surface: -1}
"""By how many the surfaces behind an edited one are renumbered."""


class LensTablePanel:
    """Surfaces as rows to type into; every edit is one step of undo."""

    def __init__(self, store: Store):
        self._store = store
        self.widget = Card("Table", TIP)
        self.model, self.view = SurfaceModel(self.widget), SurfaceTableView(self.widget)
        self.view.setModel(self.model)
        self.view.setItemDelegateForColumn(KEYS.index("medium"), GlassDelegate(self.view))
        self.bending, self.stop_place = bending_slider(store), stop_slider(store)
        self.focus = chooser(FOCUS, FOCUS_TIP, self.widget)
        self._start: State = store.state
        self._lens: Lens | None = None  # as shown; its file may be spoilt by now
        self.buttons = {method: self._button(text, tip, method) for text, tip, method in TOOLS}
        self._prepare()
        self.widget.set_body(self.view)
        self.widget.add_footer(self.bending, self.stop_place)
        self.widget.add_footer(self.focus)
        self.model.typed.connect(self._on_typed)
        self.view.clicked.connect(self._choose_stop)
        self.view.activated.connect(self._choose_stop)
        self.widget.bind(store, keep_focus=self.focus)
        self._connect(store)
        for keys, action in (("Ins", self._insert), ("Del", self._delete)):
            QShortcut(QKeySequence(keys), self.view, context=Qt.ShortcutContext.WidgetShortcut).activated.connect(
                action
            )

    def _connect(self, store: Store) -> None:
        """Link selection and scrubbing with the store."""
        self.view.clicked.connect(self._select)
        self.view.entered.connect(lambda index: store.point_at(index.row() + 1))
        self.view.left.connect(lambda: store.point_at(0))
        store.selected.connect(self._mark)
        store.pointed.connect(self._mark)
        scrub = self.view.scrub
        scrub.begun.connect(self._begin_scrub)
        scrub.moved.connect(self._scrub)
        scrub.ended.connect(store.end)
        scrub.cancelled.connect(store.cancel)

    def _select(self, index: QModelIndex) -> None:
        """Select the element that the clicked surface belongs to."""
        if self._lens:
            self._store.select(element_of(self._lens, index.row() + 1))

    def _mark(self, _: object = None) -> None:
        self.model.mark(self._store.selection, self._store.pointed_at)
        if self._lens:
            show_bending(self.bending, self._lens, self._store.selection)

    def _begin_scrub(self) -> None:
        self._start = self._store.state
        self._store.begin()

    def _scrub(self, travel: float) -> None:
        """Move the number in the cell from where it was when the hand took it."""
        if self.view.cell:
            self._edit(with_scrubbed, *self.view.cell, travel, start=self._start)

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
        rows.setDefaultAlignment(Qt.AlignmentFlag.AlignCenter)
        columns.setHighlightSections(False)
        columns.setStretchLastSection(True)
        self._size(LIGHT)

    def _size(self, theme: Tokens) -> None:
        """Give rows and columns room for the theme's type."""
        rows, columns = self.view.verticalHeader(), self.view.horizontalHeader()
        rows.setDefaultSectionSize(theme.px(ROW))
        wide = metrics(theme.px(TYPE)).horizontalAdvance("000")  # a lens may have a hundred surfaces
        rows.setFixedWidth(round(wide) + theme.px(20))
        for column, key in enumerate(KEYS):
            wide = max(theme.px(WIDTHS.get(key, 160)), columns.sectionSizeHint(column))
            self.view.setColumnWidth(column, wide)

    def show(self, live: Live) -> None:
        """Follow the lens."""
        rows: Rows = live.views["lens"].found
        self.model.show_rows(rows)
        self.buttons["_revert"].setEnabled(rows.edited)
        self._lens = rows.lens
        show_stop(self.stop_place, rows.lens)
        self._mark()
        count = len(rows.texts)
        surfaces = tr("{count} surfaces", count=count) if count > 1 else tr("1 surface")
        parts = [surfaces, *([said(rows.lens.positions.words)] if rows.lens.positions else ())]
        self.widget.set_readout(" · ".join([*parts, tr("edited")] if rows.edited else parts))

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        px, chosen, pointed = theme.px, QColor(theme.accent), QColor(theme.accent)
        chosen.setAlpha(60)
        pointed.setAlpha(30)
        self.model.colours = QBrush(chosen), QBrush(pointed)
        self.bending.restyle(theme)
        self.stop_place.restyle(theme)
        self.view.setStyleSheet(
            f"QTableView {{ background: {theme.card}; alternate-background-color: {theme.raised};"
            f" selection-background-color: {theme.accent}; selection-color: {theme.accent_text}; outline: none; }}"
            f"QTableView::item {{ padding: 0 {px(6)}px; border: none; }}"
            f"QTableView QLineEdit {{ background: {theme.card}; border: 1px solid {theme.accent}; border-radius: 0;"
            f" padding: 0 {px(2)}px; min-height: 0; }}"
            f"QHeaderView, QHeaderView::section, QTableCornerButton::section {{ background: {theme.card};"
            f" color: {theme.muted}; border: none; padding: 0 {px(6)}px; font-size: {px(12)}px; }}"
        )
        self._size(theme)

    def _on_typed(self, number: int, column: str, text: str) -> None:
        try:
            if column in LENGTHS:
                typed(text)
        except P2SFError as error:
            self._store.refused.emit(error)
            return
        self._edit(with_value, number, column, text)

    def _choose_stop(self, index: QModelIndex) -> None:
        if index.column() == STOP:
            self._edit(with_stop, index.row() + 1)

    def _insert(self) -> None:
        self._edit_row(insert_surface, 1)

    def _delete(self) -> None:
        self._edit_row(delete_surface, 0)

    def _edit_row(self, edit: Callable[..., Lens], step: int) -> None:
        """Insert or delete at the present row, and select the row after it or in its place."""
        index = self.view.currentIndex()
        row, column = (index.row(), index.column()) if index.isValid() else (self.model.rowCount() - 1, 0)
        if self._edit(edit, row + 1):
            self.view.setCurrentIndex(self.model.index(min(row + step, self.model.rowCount() - 1), column))

    def _edit(self, edit: Callable[..., Lens], number: int, *arguments: object, start: State | None = None) -> bool:
        """Try an edit of a surface, of the lens as in ``start``; refuse one without a lens or without a picture."""
        state = start or self._store.state
        if isinstance(self._store, PanelStore) and self._store.refused_for_b():
            return False
        try:
            lens = prescription(state)
            check_surface(lens, number)
            if edit in STEPS_OF_ROWS and state.optics.errors:
                errors = renumber(state.optics.errors, number, STEPS_OF_ROWS[edit])
                state = change(state, errors=errors)
            self._store.replace(edited_state(state, edit(lens, number, *arguments)))
        except P2SFError as error:
            self._store.refused.emit(error)
            return False
        return True

    def _revert(self) -> None:
        self._store.update(lens_text=None)

    def _save(self) -> None:
        ask_save_lens(self.widget, self._store)
