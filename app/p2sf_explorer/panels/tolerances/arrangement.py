"""How the Tolerances panel is arranged in the room it has: one value for each kind, charts, and tables."""

from collections.abc import Mapping

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QDoubleSpinBox, QGridLayout, QLabel, QWidget

from p2sf.tolerance.errors_of_build import IRREGULAR, Kind
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels.tolerances.tables import unit_words

# What one value of a grade is for: name and kinds.
OF_KINDS: tuple[tuple[str, tuple[Kind, ...]], ...] = (
    ("decentre", ("decentre_x", "decentre_y")),
    ("tilt", ("tilt_x", "tilt_y")),
    ("radius", ("radius",)),
    ("thickness", ("thickness",)),
    ("refractive index", ("index",)),
    ("irregularity", IRREGULAR),
)
# Pixels at scale 1: from where parts stand side by side, below which errors are alone, and the least size.
WIDE, LOW, LEAST = 720, 320, (120, 90)
GAP = 8  # pixels between a value and the next name


class KindRow(QWidget):
    """One value for all errors of a kind, each behind its name, on as many lines as the width asks for."""

    def __init__(self, boxes: Mapping[str, QDoubleSpinBox], end: QWidget):
        super().__init__()
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(4)
        self._pairs: list[tuple[QWidget, QWidget]] = []
        for (name, kinds), box in zip(OF_KINDS, boxes.values(), strict=True):
            unit = unit_words(kinds[0])
            box.setPrefix("± ")
            box.setSuffix(f" {unit}" if unit not in ("", "°") else unit)
            label = QLabel(tr(name))
            label.setObjectName("muted")
            self._pairs.append((label, box))
        self._end, self._columns = end, 0
        self._arrange(len(self._pairs))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Take as many columns as fit."""
        super().resizeEvent(event)
        widest = sum(max(part.sizeHint().width() for part in parts) for parts in zip(*self._pairs, strict=True))
        self._arrange(max(1, min(len(self._pairs), self.width() // (widest + 3 * self._grid.horizontalSpacing()))))

    def _arrange(self, columns: int) -> None:
        if columns == self._columns:
            return
        self._columns = columns
        for number, pair in enumerate(self._pairs):
            for half, part in enumerate(pair):
                self._grid.addWidget(part, number // columns, 3 * (number % columns) + half)
        number = len(self._pairs)
        left = Qt.AlignmentFlag.AlignLeft
        self._grid.addWidget(self._end, number // columns, 3 * (number % columns), 1, 2, left)
        for column in range(3 * len(self._pairs) + 3):
            self._grid.setColumnStretch(column, 0)
            self._grid.setColumnMinimumWidth(column, GAP if column % 3 == 2 and column < 3 * columns - 1 else 0)
        self._grid.setColumnStretch(3 * (columns + 1) - 1, 1)


class TolerancesBody(QWidget):
    """Values of ``kinds``, and below them errors, charts and builds side by side, or where that is too narrow stacked.

    Where it is too low, the errors alone. Its least size does not depend on which, or it would turn to and fro.
    """

    def __init__(self, errors: QWidget, charts: tuple[QWidget, QWidget], worst: QWidget, kinds: QWidget):
        super().__init__()
        self._errors, self._charts, self._worst, self._kinds = errors, QWidget(), worst, kinds
        self._chart_box = QGridLayout(self._charts)
        self._grid = QGridLayout(self)
        for grid in (self._grid, self._chart_box):
            grid.setContentsMargins(0, 0, 0, 0)
            grid.setSpacing(6)
            grid.setSizeConstraint(QGridLayout.SizeConstraint.SetNoConstraint)
        self._both, self._scale, self._arranged = charts, 1.0, ""
        self._arrange("wide")

    def minimumSizeHint(self) -> QSize:
        """Return the least size."""
        return QSize(*(round(side * self._scale) for side in LEAST))

    def restyle(self, theme: Tokens) -> None:
        """Take the scale of a theme."""
        self._scale = theme.scale

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Turn to where there is room."""
        super().resizeEvent(event)
        if self.height() < LOW * self._scale:
            self._arrange("low")
        else:
            self._arrange("wide" if self.width() >= WIDE * self._scale else "tall")

    def _arrange(self, how: str) -> None:
        if how == self._arranged:
            return
        self._arranged = how
        wide, low = how == "wide", how == "low"
        for number, chart in enumerate(self._both):
            self._chart_box.addWidget(chart, number if wide else 0, 0 if wide else number)
        places = ((2, 0), (1, 0), (3, 0)) if how == "tall" else ((1, 0), (1, 1), (1, 2))
        self._grid.addWidget(self._kinds, 0, 0, 1, 3)
        for part, place in zip((self._errors, self._charts, self._worst), places, strict=True):
            self._grid.addWidget(part, *place)
        for column, stretch in enumerate((6, 5, 3) if wide else (1, 0, 0)):
            self._grid.setColumnStretch(column, stretch)
        for row, stretch in enumerate((0, 4, 5, 3) if how == "tall" else (0, 1, 0, 0)):
            self._grid.setRowStretch(row, stretch)
        for part in (self._kinds, self._charts, self._worst):
            part.setVisible(not low)
