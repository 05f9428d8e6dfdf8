"""Tools that are seen while the pointer or the focus is near them, so that at rest there is the picture alone."""

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication, QGraphicsOpacityEffect, QWidget


class QuietTools(QObject):
    """Tools of a part of the window, transparent while neither pointer nor focus is in that ``part``.

    They keep their room, their place in the order of Tab, and what a screen reader says of them.
    """

    def __init__(self, part: QWidget) -> None:
        super().__init__(part)
        self._part = part
        self._tools: list[QWidget] = []
        self._shown = True
        part.installEventFilter(self)
        if isinstance(application := QApplication.instance(), QApplication):
            application.focusChanged.connect(self._follow)

    def add(self, *tools: QWidget) -> None:
        """Have more tools."""
        for tool in tools:
            effect = QGraphicsOpacityEffect(tool)
            effect.setOpacity(0.0)
            tool.setGraphicsEffect(effect)
            self._tools.append(tool)
        self._shown = True
        self._show(self._near())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the pointer."""
        if event.type() in (QEvent.Type.Enter, QEvent.Type.Leave):
            self._show(event.type() == QEvent.Type.Enter or self._near())
        return False

    def _follow(self) -> None:
        self._show(self._near())

    def _near(self) -> bool:
        """Return whether the pointer, the focus, or a list that a tool has opened is in the part."""
        focused, opened = QApplication.focusWidget(), QApplication.activePopupWidget()
        held = any(each and self._part.isAncestorOf(each) for each in (focused, opened))
        return held or self._part.underMouse()

    def _show(self, shown: bool) -> None:
        if shown != self._shown:
            self._shown = shown
            for tool in self._tools:
                if effect := tool.graphicsEffect():
                    effect.setEnabled(not shown)


def is_seen(widget: QWidget) -> bool:
    """Return whether a widget is on show and not a quiet tool at rest, nor in one."""
    part: QWidget | None = widget
    while part is not None and not part.isWindow():
        effect = part.graphicsEffect()
        if isinstance(effect, QGraphicsOpacityEffect) and effect.isEnabled():
            return False
        part = part.parentWidget()
    return widget.isVisible() and not widget.visibleRegion().isEmpty()
