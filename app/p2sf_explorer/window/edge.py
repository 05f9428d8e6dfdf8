"""What floats over the line under the stage, so that nothing moves when it comes: messages and offers."""

from PySide6.QtCore import QEvent, QObject, QPoint
from PySide6.QtWidgets import QGraphicsDropShadowEffect, QSizePolicy, QVBoxLayout, QWidget

from p2sf_explorer.charts.theme import SPACE


class StageEdge(QWidget):
    """Holds bars one above the other over a stage; those that are hidden take no room."""

    def __init__(self, stage: QWidget, bars: tuple[QWidget, ...], parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("edge")
        self._stage, self._scale = stage, 1.0
        self._bars: list[QWidget] = []
        self._column = column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(SPACE // 2)
        for bar in bars:
            self.add(bar)
        stage.installEventFilter(self)

    def add(self, bar: QWidget) -> None:
        """Have another bar, above those that are there."""
        self._bars.append(bar)
        self._column.insertWidget(0, bar)
        bar.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        shadow = QGraphicsDropShadowEffect(bar)
        shadow.setBlurRadius(14)
        shadow.setOffset(0, 2)
        bar.setGraphicsEffect(shadow)
        bar.installEventFilter(self)
        bar.destroyed.connect(lambda: self._bars.remove(bar))

    def rescale(self, scale: float) -> None:
        """Take a scale of type."""
        self._scale = scale
        self.place()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the stage, and make room for bars that come and go."""
        changes = QEvent.Type.Resize, QEvent.Type.Move, QEvent.Type.ShowToParent, QEvent.Type.HideToParent
        if event.type() in changes or (watched is not self._stage and event.type() == QEvent.Type.LayoutRequest):
            self.place()
        return False

    def place(self) -> None:
        """Stand over the stage, as wide as it, or as the bars need where it is narrow."""
        shown = [bar for bar in self._bars if not bar.isHidden()]
        self.setVisible(bool(shown))
        parent = self.parentWidget()
        if not shown or parent is None:
            return
        gap = round(SPACE * self._scale)
        corner = self._stage.mapTo(parent, QPoint(gap, self._stage.height()))
        needed = max(bar.minimumSizeHint().width() for bar in shown)
        wide = min(max(self._stage.width() - 2 * gap, needed), parent.width() - 2 * gap)
        left = max(gap, min(corner.x(), parent.width() - gap - wide))
        self._column.invalidate()
        tall = self._column.totalHeightForWidth(wide) if self._column.hasHeightForWidth() else self.sizeHint().height()
        self.setGeometry(left, corner.y() - tall, wide, tall)
        self.raise_()
