"""A line that offers something once, with a button to take it and one to leave it."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QToolButton, QWidget

from p2sf_explorer.i18n.tr import tr


class Offer(QFrame):
    """The line; ``words`` are translated already, the texts and tips of its buttons are not. Either button hides it."""

    def __init__(
        self, words: str, accept: str, accept_tip: str, dismiss: str, dismiss_tip: str, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setObjectName("bar")
        text = QLabel(words)
        text.setWordWrap(True)
        self.accept, self.dismiss = tool(accept, accept_tip), tool(dismiss, dismiss_tip)
        for button in (self.accept, self.dismiss):
            button.clicked.connect(self.hide)
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 4, 8, 4)
        row.addWidget(text, 1)
        row.addWidget(self.accept)
        row.addWidget(self.dismiss)


def tool(text: str, tip: str) -> QToolButton:
    """Return a small button that takes the keyboard focus."""
    made = QToolButton()
    made.setObjectName("small")
    made.setText(tr(text))
    made.setToolTip(tr(tip))
    made.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    return made
