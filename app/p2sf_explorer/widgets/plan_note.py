"""The image panel's plan: its progress, with a button that stops it, and the reasons for its decisions."""

from collections.abc import Callable
from html import escape

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QMenu, QProgressBar, QSizePolicy, QToolButton, QWidget, QWidgetAction

from p2sf.messages import Message
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.i18n.tr import tr, unbroken

TURNS = (
    ("Cancel", "Make no plan; the coarse picture stays"),
    ("Plan it after all", "Resume the plan that was cancelled, and make its picture"),
)


class PlanLine(QWidget):
    """A bar in per cent with its button; ``turned`` is emitted when the button is pressed."""

    turned = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.bar, self.turn = QProgressBar(self), small_button("Cancel", "", lambda: self.turned.emit())
        self.bar.setFormat(f"{tr('planning')} %p\u00a0%")
        line = QHBoxLayout(self)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(4)
        line.addWidget(self.bar, 1)
        line.addWidget(self.turn)
        self.turn.setSizePolicy(
            QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed
        )  # without the bar it has the whole line
        self.hide()

    def begin(self) -> None:
        """Put the bar back to its start."""
        self.bar.setValue(0)

    def show_progress(self, share: float) -> None:
        """Show a share of the work, 0 to 1; the bar never goes back."""
        self.bar.setValue(max(self.bar.value(), int(100 * share)))

    def show_plan(self, running: bool, stopped: bool) -> None:
        """Show the bar while a plan is made, the button also where one was stopped, else nothing."""
        words, tip = TURNS[stopped]
        self.turn.setText(tr(words))
        self.turn.setToolTip(tr(tip))
        self.bar.setVisible(running)
        self.setVisible(running or stopped)


class Why(QLabel):
    """The plan's decisions in words, in a menu of its ``button``."""

    def __init__(self) -> None:
        super().__init__()
        self.button = small_button(
            "Why…", "Why the picture is computed this way: the decisions of the plan, each with its error"
        )
        self.setObjectName("reasons")
        self.setTextFormat(Qt.TextFormat.RichText)
        self.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.setWordWrap(True)
        menu, action = QMenu(self.button), QWidgetAction(self.button)
        action.setDefaultWidget(self)
        menu.addAction(action)
        self.button.setMenu(menu)
        self.button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)

    def show_notes(self, notes: tuple[tuple[Message, Message], ...]) -> None:
        """Show each heading and its sentence on a line."""
        texts = ((escape(part.text(WINDOW), quote=False) for part in note) for note in notes)
        self.setText(unbroken("".join(f"<p><b>{heading}</b> {sentence}</p>" for heading, sentence in texts)))
        self.adjustSize()


def small_button(text: str, tip: str, action: Callable[[], object] | None = None) -> QToolButton:
    """Return a small button; one without an action is for a menu."""
    button = QToolButton()
    button.setObjectName("small")
    button.setText(tr(text))
    button.setToolTip(tr(tip))
    button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    if action:
        button.clicked.connect(action)
    return button
