"""What the image panel says of its plan: how far it is, with a button that stops it, and why it is as it is."""

from html import escape

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QMenu, QProgressBar, QSizePolicy, QToolButton, QWidget, QWidgetAction

from p2sf.messages import Message
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.i18n.tr import tr, unbroken

WORDS_PX = 480
TURNS = (
    ("Cancel", "Make no plan; the coarse picture stays"),
    ("Plan it after all", "Make the plan that was cancelled, and the picture by it"),
)


class PlanLine(QWidget):
    """A bar in per cent with its button; ``turned`` says that the button was pressed."""

    turned = Signal()

    def __init__(self, parent=None):
        super().__init__(parent)
        self.bar, self.turn = QProgressBar(self), small_button("Cancel", "", lambda: self.turned.emit())
        self.bar.setFormat(f"{tr('planning')} %p\u00a0%")
        line = QHBoxLayout(self)
        line.setContentsMargins(0, 0, 0, 0)
        line.setSpacing(4)
        line.addWidget(self.bar, 1)
        line.addWidget(self.turn)
        self.turn.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)  # alone it has all of the line
        self.hide()

    def begin(self) -> None:
        """Put the bar back to its start."""
        self.bar.setValue(0)

    def tell(self, share: float) -> None:
        """Show a share of the work, 0 to 1; a bar never goes back."""
        self.bar.setValue(max(self.bar.value(), int(100 * share)))

    def show_stage(self, doing: bool, stopped: bool) -> None:
        """Show the bar while a plan is made, the button also where one was stopped, nothing where there is none."""
        words, tip = TURNS[stopped]
        self.turn.setText(tr(words))
        self.turn.setToolTip(tr(tip))
        self.bar.setVisible(doing)
        self.setVisible(doing or stopped)


class Why(QLabel):
    """The decisions in words, behind a ``button``."""

    def __init__(self):
        super().__init__()
        self.button = small_button(
            "Why…", "Why the picture is computed in this way: the plan's decisions, each with its error"
        )
        self.setObjectName("fact")
        self.setTextFormat(Qt.TextFormat.RichText)
        self.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.setWordWrap(True)
        self.setFixedWidth(WORDS_PX)
        self.setMargin(10)
        fold, shown = QMenu(self.button), QWidgetAction(self.button)
        shown.setDefaultWidget(self)
        fold.addAction(shown)
        self.button.setMenu(fold)
        self.button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)

    def tell(self, notes: tuple[tuple[Message, Message], ...]) -> None:
        """Show (what, sentence) a line each."""
        lines = (
            f"<p><b>{escape(a.text(WINDOW), quote=False)}</b> {escape(b.text(WINDOW), quote=False)}</p>"
            for a, b in notes
        )
        self.setText(unbroken("".join(lines)))
        self.adjustSize()


def small_button(text: str, tip: str, action=None) -> QToolButton:
    """Return a small button; without an action it opens a menu."""
    made = QToolButton()
    made.setObjectName("small")
    made.setText(tr(text))
    made.setToolTip(tr(tip))
    made.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    if action:
        made.clicked.connect(action)
    return made
