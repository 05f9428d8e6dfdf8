"""Roles of widgets that the explorer paints itself: Qt takes them for empty areas, and says so to screen readers.

A class states its own as ``accessible_role = QAccessible.Role.Chart``; its name is the widget's `accessibleName`.
"""

from functools import cache

from PySide6.QtCore import QObject
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QAccessibleWidget, QWidget


@cache
def install_roles() -> None:
    """Have Qt ask the widgets' classes for their roles from now on."""
    QAccessible.installFactory(_interface)


def _interface(key: str, described: QObject) -> QAccessibleInterface | None:
    role = getattr(described, "accessible_role", None)
    return QAccessibleWidget(described, role) if role is not None and isinstance(described, QWidget) else None
