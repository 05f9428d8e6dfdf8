"""The strip that names what differs between A and B, which is on screen, and what moves both."""

from html import escape

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QButtonGroup, QFrame, QHBoxLayout, QLabel, QMenu, QSizePolicy, QToolButton, QWidget

from p2sf.messages import Message
from p2sf_explorer.compare.contrasts import LINK_WORDS, contrasts
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.limits import CHOICES, LINKABLE
from p2sf_explorer.state.pinning import link_toggled, pin, swap, unpin
from p2sf_explorer.state.state import State
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.command import Command

SIDES = (
    ("a", "A", "Show A, which the controls move"),
    ("b", "B", "Show B, as it was pinned"),
    ("difference", "A − B", "Show A − B; a panel in which a difference means nothing shows A and says why"),
)
SWAP_TIP = "Exchange A and B: the controls then move the other one"
LINK_TIP = "What moves A and B together"
SAME = "A and B are the same: move a control, or choose another lens or method"


class CompareBar(QFrame):
    """Visible while something is pinned as B."""

    def __init__(self, window: QWidget, store: Store):
        super().__init__(window)
        self.setObjectName("bar")
        self._store = store
        self.words = QLabel(self)
        self.words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.sides = {key: self._button(text, tip) for key, text, tip in SIDES}
        self.swap, self.link = self._button("Swap", SWAP_TIP), self._button("Link", LINK_TIP)
        self.unpin = self._button("Unpin", "Take B away (Ctrl+B)")
        self._lay_out()
        self._connect()
        self.hide()

    def _button(self, text: str, tip: str) -> QToolButton:
        button = QToolButton(self)
        button.setObjectName("small")
        button.setText(tr(text))
        button.setToolTip(tr(tip))
        return button

    def _lay_out(self) -> None:
        row = QHBoxLayout(self)
        row.setContentsMargins(10, 4, 10, 4)
        row.setSpacing(6)
        group = QButtonGroup(self)
        for button in self.sides.values():
            button.setCheckable(True)
            group.addButton(button)
            row.addWidget(button)
        row.addSpacing(8)
        row.addWidget(self.words, 1)
        for button in (self.link, self.swap, self.unpin):
            row.addWidget(button)

    def _connect(self) -> None:
        store = self._store
        for key, button in self.sides.items():
            button.clicked.connect(lambda _=False, key=key: store.update(shown=key))
        self.swap.clicked.connect(self.exchange)
        self.unpin.clicked.connect(lambda: store.replace(unpin(store.state)))
        menu = self._menu = QMenu(self)
        self.links = {key: QAction(tr(LINK_WORDS[key]), self) for key in LINKABLE}  # not the menu's
        menu.addActions(list(self.links.values()))
        for key, action in self.links.items():
            action.setCheckable(True)
            action.triggered.connect(lambda _=False, key=key: store.update(linked=link_toggled(store.state, key)))
        menu.addSeparator()
        menu.addAction(tr("Link all"), lambda: store.update(linked=LINKABLE))
        menu.addAction(tr("Link none"), lambda: store.update(linked=()))
        self.link.setMenu(menu)
        self.link.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)

    def commands(self) -> tuple[Command, ...]:
        """Return what can be done by name or key."""
        return (
            Command("Pin what is on screen as B, or take B away", self.turn, ("Ctrl+B",), "Compare"),
            Command("Show A, B, A − B in turn", self.next_side, ("Ctrl+Shift+B",), "Compare"),
            Command("Exchange A and B", self.exchange, (), "Compare"),
        )

    def turn(self) -> None:
        """Pin B, or take it away."""
        state = self._store.state
        self._store.replace(unpin(state) if state.compare.pinned else pin(state))

    def exchange(self) -> None:
        """Exchange A and B, if there is a B."""
        if self._store.state.compare.pinned:
            self._store.replace(swap(self._store.state))

    def next_side(self) -> None:
        """Show the next of A, B, A − B; pins B first."""
        if not self._store.state.compare.pinned:
            self.turn()
        sides = CHOICES["shown"]
        self._store.update(shown=sides[(sides.index(self._store.state.compare.shown) + 1) % len(sides)])

    def show_state(self, state: State) -> None:
        """Follow a state."""
        self.setVisible(state.compare.pinned is not None)
        if not state.compare.pinned:
            return
        self.sides[state.compare.shown].setChecked(True)
        for key, action in self.links.items():
            action.setChecked(key in state.compare.linked)
        self.link.setText(tr("Link: {count}", count=len(state.compare.linked)) if state.compare.linked else tr("Link"))
        parts = [
            f"<b>{tr(name)}</b>&nbsp; A {marked_up(a)} &nbsp;|&nbsp; B {marked_up(b)}"
            for name, a, b in contrasts(state)
        ]
        words = " &nbsp;·&nbsp; ".join(parts) or tr(SAME)
        if self.words.text() != words:
            self.words.setText(words)
            self.words.setToolTip("<br>".join(parts))


def marked_up(value: Message) -> str:
    """Return a value in the window's language as rich text."""
    return escape(value.text(WINDOW), quote=False)
