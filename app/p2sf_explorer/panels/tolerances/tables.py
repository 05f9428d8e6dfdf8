"""Tables of the Tolerances panel: errors by their harm, whose ± values are typed over, and the worst builds."""

from math import isfinite

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRectF, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QColor, QPainter
from PySide6.QtWidgets import (
    QAbstractItemView,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableWidget,
    QTableWidgetItem,
)

from p2sf.errors import P2SFError
from p2sf.tolerance.errors_of_build import IRREGULAR, UNITS, Kind, Tolerance
from p2sf.tolerance.single import INVALID
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.views.tolerances import Figures
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.state.build_errors import LARGEST
from p2sf_explorer.state.scales import read_number, significant
from p2sf_explorer.state.state import ToleranceView
from p2sf_explorer.widgets.plain_table import PlainTable
from p2sf_explorer.widgets.typed import typed

WORST_TIP = "Worst builds: click to see one as A beside the lens as designed, B"
HARMS = {"rms_waves": "adds, λ", "strehl": "takes", "mtf": "takes", "boresight_um": "shifts, µm"}
LOST = "rays are lost"
LOST_TIP = "At ± this tolerance rays are lost: there is no figure, and the builds are not to be trusted."
FORM_TIP = (
    "By exact rays. The quadratic form by which builds are drawn says {value}: it does not describe so large an error."
)
NOTICED = 0.01  # of the largest harm: errors of the form below that are not told
SHORT = {"rms_waves": "RMS, λ", "strehl": "Strehl", "mtf": "contrast", "boresight_um": "shift, µm"}
ERROR_WORDS: dict[Kind, str] = {
    "decentre_x": "decentre x, surface {where}",
    "decentre_y": "decentre y, surface {where}",
    "tilt_x": "tilt x, surface {where}",
    "tilt_y": "tilt y, surface {where}",
    "radius": "radius, surface {where}",
    "thickness": "thickness behind surface {where}",
    "index": "index behind surface {where}",
    "irregularity": "irregularity, surface {where}",
    "irregularity_45": "irregularity at 45°, surface {where}",
}


def error_words(one: Tolerance) -> str:
    """Return how an error is named."""
    first, last = one.piece
    return tr(ERROR_WORDS[one.kind], where=str(first) if first == last else f"{first}–{last}")


def unit_words(kind: Kind) -> str:
    """Return the unit of a kind, as the window writes it."""
    return tr("fr.") if kind in IRREGULAR else UNITS[kind]


SHARE_ROLE = Qt.ItemDataRole.UserRole


class BarDelegate(QStyledItemDelegate):
    """Paints a bar behind a number, as long as its share of the largest."""

    def __init__(self, table: QTableWidget):
        super().__init__(table)
        self.colour = QColor(LIGHT.marginal)

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        """Paint bar and number."""
        share = index.data(SHARE_ROLE) or 0.0
        room = QRectF(option.rect).adjusted(2, 3, -2, -3)
        painter.fillRect(QRectF(room.left(), room.top(), room.width() * min(share, 1.0), room.height()), self.colour)
        super().paint(painter, option, index)


class ErrorTable(PlainTable):
    """Errors, the most harmful first; a ± value may be typed over.

    ``typed``: which one, and its new amount; ``refused``: why a text is none.
    """

    typed = Signal(object, float)
    refused = Signal(object)

    def __init__(self) -> None:
        super().__init__(("error", "±", HARMS["rms_waves"]), "Errors by their harm")
        self.setEditTriggers(
            QAbstractItemView.EditTrigger.DoubleClicked
            | QAbstractItemView.EditTrigger.EditKeyPressed
            | QAbstractItemView.EditTrigger.AnyKeyPressed
        )
        self._bars = BarDelegate(self)
        self.setItemDelegateForColumn(2, self._bars)
        self._rows: tuple[Tolerance, ...] = ()
        self.itemChanged.connect(self._on_typed)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._bars.colour = QColor(theme.marginal)
        self._bars.colour.setAlpha(90)
        super().restyle(theme)

    def show_errors(self, view: Figures, settings: ToleranceView) -> None:
        """Show a row for each error; own values are in bold."""
        own = {(kind, first, max(first, last)) for kind, first, last, _ in settings.own}
        most = max((abs(harm) for _, _, harm in view.errors if isfinite(harm)), default=0.0) or 1.0
        with QSignalBlocker(self):
            self.setHorizontalHeaderItem(2, QTableWidgetItem(tr(HARMS[view.criterion])))
            self.setRowCount(len(view.errors))
            self._rows = tuple(one for one, _, _ in view.errors)
            for row, (one, _, harm) in enumerate(view.errors):
                self.put(row, 0, error_words(one))
                amount = self.put(row, 1, local(_written_amount(one)), right=True)
                amount.setFlags(amount.flags() | Qt.ItemFlag.ItemIsEditable)
                font = amount.font()
                font.setBold((one.kind, *one.piece) in own or (one.kind, 0, 0) in own)
                amount.setFont(font)
                digits = significant(harm, 2) if abs(harm) >= 1e-3 * most else "0"
                cell = self.put(row, 2, local(digits) if isfinite(harm) else tr(LOST), right=True)
                cell.setData(SHARE_ROLE, max(harm, 0.0) / most if isfinite(harm) else 1.0)
                cell.setToolTip(_doubt(harm, view.form_errors[row], most))

    def _on_typed(self, item: QTableWidgetItem) -> None:
        one = self._rows[item.row()]
        try:
            unit = unit_words(one.kind)
            value = read_number(typed(item.text()), "tolerance", {"": 1.0, unit: 1.0})
            if not 0 <= value <= LARGEST[one.kind]:
                raise P2SFError(
                    "the tolerance of {error} is {value:g}{unit}; give a number from 0 to {high:g}",
                    error=error_words(one),
                    value=value,
                    unit=unit if unit in ("", "°") else f" {unit}",
                    high=LARGEST[one.kind],
                )
        except P2SFError as error:
            with QSignalBlocker(self):
                item.setText(local(_written_amount(one)))
            self.refused.emit(error)
        else:
            self.typed.emit(one, value)


def _written_amount(one: Tolerance) -> str:
    unit = unit_words(one.kind)
    return f"{one.amount:g}{unit}" if unit in ("", "°") else f"{one.amount:g} {unit}"


def _doubt(harm: float, form_error: float, most: float) -> str:
    """Return what is to be said of a harm: rays that are lost, and builds that are drawn by another figure."""
    if not isfinite(harm):
        return tr(LOST_TIP)
    if abs(form_error) <= max(INVALID * abs(harm), NOTICED * most):
        return ""
    return local(tr(FORM_TIP, value=significant(harm + form_error, 2)))


class BuildList(PlainTable):
    """The worst builds; a click, or Enter, opens one (``opened``: its number from 0)."""

    opened = Signal(int)

    def __init__(self) -> None:
        super().__init__(("build", SHORT["rms_waves"]), WORST_TIP)
        self.setToolTip(tr(WORST_TIP))
        self._numbers: tuple[int, ...] = ()
        self.cellClicked.connect(lambda row, _: self._open(row))
        self.cellActivated.connect(lambda row, _: self._open(row))

    def show_builds(self, view: Figures, opened: int) -> None:
        """List builds, the one on screen chosen."""
        with QSignalBlocker(self):
            self.setHorizontalHeaderItem(1, QTableWidgetItem(tr(SHORT[view.criterion])))
            self._numbers = tuple(number for number, _ in view.worst)
            self.setRowCount(len(view.worst))
            for row, (number, value) in enumerate(view.worst):
                self.put(row, 0, str(number + 1), right=True)
                self.put(row, 1, local(f"{value:.{view.places}f}"), right=True)
            if opened - 1 in self._numbers:
                self.selectRow(self._numbers.index(opened - 1))
            else:
                self.clearSelection()

    def _open(self, row: int) -> None:
        if row < len(self._numbers):
            self.opened.emit(self._numbers[row])
