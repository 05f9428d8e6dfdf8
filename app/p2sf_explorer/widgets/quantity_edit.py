"""A small labelled number with a unit, for a panel's title line."""

from collections.abc import Callable

from PySide6.QtWidgets import QHBoxLayout, QLabel, QWidget

from p2sf.errors import P2SFError
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.scales import read_number, significant
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.value_edit import ValueEdit

MICRONS = {"": 1.0, "µm": 1.0, "um": 1.0, "mm": 1e3}


class MicronEdit(QWidget):
    """A length in µm of the state; typing is refused in a sentence where it cannot be."""

    def __init__(self, store: Store, key: str, words: str, tip: str, parent=None):
        super().__init__(parent)
        self._store, self._key, self._words = store, key, words
        self.edit = ValueEdit(self)
        self.edit.setFixedWidth(78)
        self.edit.setAccessibleName(tr(words))
        self.setToolTip(tr(tip))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(QLabel(tr(words), self))
        row.addWidget(self.edit)
        self.edit.committed.connect(self._commit)
        self._write: Callable[[float], str] = lambda value: f"{significant(value, 3)} µm"

    def show_value(self, value: float) -> None:
        """Show the state's value."""
        self.edit.set_text(self._write(value))

    def _commit(self, text: str) -> None:
        try:
            self._store.update(**{self._key: read_number(text, self._words.lower(), MICRONS)})
        except P2SFError as error:
            self._store.refused.emit(str(error))
        self.show_value(getattr(self._store.state, self._key))
