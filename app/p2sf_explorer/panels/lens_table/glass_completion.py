"""Completion of glass names in a table, each with its n_d and ν_d."""

from functools import cache

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QStandardItem, QStandardItemModel
from PySide6.QtWidgets import QCompleter, QLineEdit, QStyleOptionViewItem, QTreeView, QWidget

from p2sf.errors import P2SFError
from p2sf.glass.catalogue import glasses_by_maker
from p2sf.glass.dispersion import LINES_UM
from p2sf.glass.media import catalogue_glass
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.panels.lens_table.surface_table import LocalNumbers

MOST = 12  # names in the list at once
WIDE = 46  # letters of the list


@cache
def written_indices(label: str) -> tuple[str, str]:
    """Return n_d and ν_d = (n_d − 1)/(n_F − n_C) of a catalogue's glass as text, "–" where its data do not reach."""
    try:
        n_f, n_d, n_c = (float(catalogue_glass(label).index(LINES_UM[line])) for line in "FdC")
    except P2SFError:
        return "–", "–"
    return f"{n_d:.5f}", f"{(n_d - 1) / (n_f - n_c):.2f}"


class GlassModel(QStandardItemModel):
    """All glasses by name; the indices of a row are looked up when it is shown, since that takes a while for all."""

    def __init__(self) -> None:
        super().__init__()
        self.setHorizontalHeaderLabels([tr("Glass"), "n_d", "ν_d"])
        for labels in glasses_by_maker().values():
            for label in labels:
                self.appendRow([QStandardItem(label), QStandardItem(), QStandardItem()])

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        """Return a name, or an index as text."""
        if role == Qt.ItemDataRole.DisplayRole and index.column() > 0:
            label = super().data(self.index(index.row(), 0), role)
            return local(written_indices(str(label))[index.column() - 1])
        return super().data(index, role)


@cache
def glasses() -> GlassModel:
    """Return the one model of all glasses."""
    return GlassModel()


class GlassDelegate(LocalNumbers):
    """An editor that completes any part of a glass's name."""

    def createEditor(
        self, parent: QWidget, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> QWidget:
        """Return the usual editor, with a list of the glasses that contain what is typed."""
        editor = super().createEditor(parent, option, index)
        if isinstance(editor, QLineEdit):
            editor.setCompleter(completer(editor))
        return editor


def completer(editor: QLineEdit) -> QCompleter:
    """Return a completer whose list has a column for each index."""
    made = QCompleter(glasses(), editor)
    made.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
    made.setFilterMode(Qt.MatchFlag.MatchContains)
    made.setMaxVisibleItems(MOST)
    view = QTreeView()
    view.setRootIsDecorated(False)
    view.setUniformRowHeights(True)
    made.setPopup(view)
    wide = WIDE * editor.fontMetrics().averageCharWidth()
    view.setMinimumWidth(wide)
    view.setColumnWidth(0, wide // 2)
    view.setColumnWidth(1, wide // 4)
    return made
