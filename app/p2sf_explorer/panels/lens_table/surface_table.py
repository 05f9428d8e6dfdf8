"""The surfaces of a lens as a Qt table model, which shows their entries and passes on what is typed."""

from PySide6.QtCore import QAbstractTableModel, QEvent, QLocale, QModelIndex, QObject, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QBrush, QHideEvent, QKeyEvent, QMouseEvent, QPainter
from PySide6.QtWidgets import QStyledItemDelegate, QStyleOptionViewItem, QTableView, QWidget

from p2sf_explorer.compute.editing import cell_text
from p2sf_explorer.compute.views.lens_table import COLUMNS, Rows
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.widgets.scrub import Scrub, claimed

STOP = COLUMNS.index("conic") + 1
HEADS = {
    "radius": ("Radius, mm", "Radius of curvature, mm: positive when the centre lies to the right; ∞ is a plane."),
    "thickness": ("Thickness, mm", "Distance to the next vertex, mm; the last one to the sensor."),
    "medium": (
        "Glass or index",
        'The medium behind the surface: a name such as "SCHOTT N-BK7", an index, or "nd 1.5168 vd 64.17".',
    ),
    "semi_diameter": ("Semi-diameter, mm", "Clear rim, mm; ∞ is unlimited. On the stop it is the aperture."),
    "conic": ("Conic K", "Conic constant K = −e²: 0 a sphere, −1 a paraboloid."),
    "stop": ("Stop", "Click or press Enter to make this surface the stop; the f-number does not change."),
    "aspheric": ("A4 A6 … (mm⁻³ mm⁻⁵ …)", "Aspheric terms A4·r⁴ + A6·r⁶ + …, separated by spaces."),
}
KEYS = (*COLUMNS[:STOP], "stop", *COLUMNS[STOP:])
NUMBERS = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
WORDS = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
HEAD_PARTS: dict[int, int] = {Qt.ItemDataRole.DisplayRole: 0, Qt.ItemDataRole.ToolTipRole: 1}
Index = QModelIndex | QPersistentModelIndex


SCRUBBED = ("radius", "thickness", "semi_diameter", "conic")
UP_DOWN: dict[int, int] = {Qt.Key.Key_Up: 1, Qt.Key.Key_Down: -1}


class SurfaceTableView(QTableView):
    """The table, whose numbers follow a horizontal drag, and with Alt ↑ and ↓; ``cell`` is what moves.

    ``left``: the pointer is on no row any more.
    """

    left = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.scrub = Scrub(self)
        self.cell: tuple[int, str] | None = None  # surface from 1, and column
        self.setMouseTracking(True)

    def leaveEvent(self, event: QEvent) -> None:
        """Tell that the pointer has gone."""
        super().leaveEvent(event)
        self.left.emit()

    def hideEvent(self, event: QHideEvent) -> None:
        """Tell that there is nothing to point at."""
        super().hideEvent(event)
        self.left.emit()

    def _take(self, index: QModelIndex) -> bool:
        """Choose the cell to move; return whether it has a number."""
        key = KEYS[index.column()] if index.isValid() else ""
        self.cell = (index.row() + 1, key) if key in SCRUBBED else None
        return self.cell is not None

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Choose a cell, and get ready to move its number."""
        super().mousePressEvent(event)
        if event.button() == Qt.MouseButton.LeftButton and self._take(self.indexAt(event.position().toPoint())):
            self.scrub.press(event.position().x())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Move the number while held."""
        if self.scrub.pressed:
            self.scrub.drag(event.position().x(), event.modifiers())
        else:
            super().mouseMoveEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End the move; without one it was a click."""
        moved = self.scrub.end()
        super().mouseReleaseEvent(event)
        if moved:
            self.setState(QTableView.State.NoState)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Give up a move with Escape; move a number with Alt and the arrows."""
        if event.key() == Qt.Key.Key_Escape and self.scrub.cancel():
            return
        alt, held = Qt.KeyboardModifier.AltModifier, event.modifiers()
        if event.key() in UP_DOWN and held & alt and self._take(self.currentIndex()):
            self.scrub.step(UP_DOWN[event.key()], held & ~alt)
            return
        super().keyPressEvent(event)

    def event(self, event: QEvent) -> bool:
        """Keep the keys that move a number from the window's shortcuts."""
        asked = event.type() == QEvent.Type.ShortcutOverride  # other events come before there is a scrub
        return (asked and claimed(event, UP_DOWN, self.scrub.active, True)) or super().event(event)


class SurfaceModel(QAbstractTableModel):
    """Shows `Rows`; emits ``typed(surface, column, text)`` for an edit and changes nothing itself."""

    typed = Signal(int, str, str)

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._rows: Rows | None = None
        self.selection: tuple[int, int] | None = None
        self.pointed = 0
        self.colours = QBrush(), QBrush()  # behind the selected element's rows, and behind the one pointed at

    def mark(self, selection: tuple[int, int] | None, pointed: int) -> None:
        """Show which surfaces are selected and which one is pointed at, elsewhere or here."""
        if (selection, pointed) != (self.selection, self.pointed):
            self.selection, self.pointed = selection, pointed
            last = self.index(self.rowCount() - 1, len(KEYS) - 1)
            self.dataChanged.emit(self.index(0, 0), last, [Qt.ItemDataRole.BackgroundRole])

    def _ground(self, surface: int) -> QBrush | None:
        if surface == self.pointed:
            return self.colours[1]
        chosen = self.selection
        return self.colours[0] if chosen and chosen[0] <= surface <= chosen[1] else None

    def show_rows(self, rows: Rows) -> None:
        """Follow a lens; a view keeps its place when the number of surfaces is the same."""
        before = self._rows
        if before is None or len(before.texts) != len(rows.texts):
            self.beginResetModel()
            self._rows = rows
            self.endResetModel()
            return
        self._rows = rows
        for row in range(len(rows.texts)):  # a view is slow at painting cells, and an edit changes one
            for column, (old, new) in enumerate(zip(entries(before, row), entries(rows, row), strict=True)):
                if old != new:
                    self.dataChanged.emit(self.index(row, column), self.index(row, column))

    def rowCount(self, parent: Index | None = None) -> int:
        """Return the number of surfaces."""
        return len(self._rows.texts) if self._rows and not (parent and parent.isValid()) else 0

    def columnCount(self, parent: Index | None = None) -> int:
        """Return the number of columns."""
        return 0 if parent and parent.isValid() else len(KEYS)

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> str | Qt.AlignmentFlag | None:
        """Return headings with units, their definitions, and surface numbers."""
        if orientation == Qt.Orientation.Vertical:
            return str(section + 1) if role == Qt.ItemDataRole.DisplayRole else None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return self._alignment(section)
        part = HEAD_PARTS.get(role)
        return None if part is None else tr(HEADS[KEYS[section]][part])

    def flags(self, index: Index) -> Qt.ItemFlag:
        """Return that every entry but the stop can be edited."""
        plain = super().flags(index)
        return plain if index.column() == STOP else plain | Qt.ItemFlag.ItemIsEditable

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> str | Qt.AlignmentFlag | QBrush | None:
        """Return an entry's text, with every digit where it is edited."""
        if self._rows is None:
            return None
        if role == Qt.ItemDataRole.BackgroundRole:
            return self._ground(index.row() + 1)
        row, key = index.row(), KEYS[index.column()]
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return self._alignment(index.column())
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            return entries(self._rows, row)[index.column()]
        if role == Qt.ItemDataRole.EditRole and key != "stop":
            text = cell_text(self._rows.lens.surfaces[row], key, full=True)
            return text if key == "medium" else local(text)
        return self._tip(row, key) if role == Qt.ItemDataRole.ToolTipRole else None

    def _tip(self, row: int, key: str) -> str:
        """Return what a column means, and what of the surface it does not show, such as a shape beside even terms."""
        beside = self._rows.beside[row].get(key) if self._rows and self._rows.beside else None
        return "\n\n".join([tr(HEADS[key][1]), *map(said, beside.words if beside else ())])

    def setData(self, index: Index, value: str, role: int = Qt.ItemDataRole.EditRole) -> bool:
        """Emit what was typed, unless it is what was there."""
        if value.strip() == self.data(index, Qt.ItemDataRole.EditRole):
            return False
        self.typed.emit(index.row() + 1, KEYS[index.column()], value)
        return True

    @staticmethod
    def _alignment(column: int) -> Qt.AlignmentFlag:
        if KEYS[column] == "stop":
            return Qt.AlignmentFlag.AlignCenter
        return WORDS if KEYS[column] in ("medium", "aspheric") else NUMBERS


class LocalNumbers(QStyledItemDelegate):
    """Shows numbers as the window's language writes them; what is copied keeps the decimal point."""

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint the ground of selected rows, which a style sheet leaves out, and the cell."""
        ground = index.data(Qt.ItemDataRole.BackgroundRole)
        if isinstance(ground, QBrush):
            painter.fillRect(option.rect, ground)
        super().paint(painter, option, index)

    def displayText(self, value: object, locale: QLocale | QLocale.Language) -> str:
        """Return the text of a cell."""
        return local(str(value))


def entries(rows: Rows, row: int) -> tuple[str, ...]:
    """Return a surface's entries in the order of the columns, with a mark for the stop."""
    texts = rows.texts[row]
    shapes = map(said, rows.beside[row]["aspheric"].short) if rows.beside else ()
    terms = "  + ".join(filter(None, (texts[-1], *shapes)))
    return (*texts[:STOP], "●" if row + 1 == rows.stop else "○", *texts[STOP:-1], terms)
