"""The strip that names what differs between A and B, which is on screen, and what moves both."""

from html import escape

from PySide6.QtGui import QAction, QFontMetrics, QResizeEvent
from PySide6.QtWidgets import QButtonGroup, QFrame, QHBoxLayout, QLabel, QMenu, QToolButton, QVBoxLayout, QWidget

from p2sf.messages import Message
from p2sf_explorer.compare.contrasts import LINK_WORDS, contrasts
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.limits import CHOICES, LINKABLE
from p2sf_explorer.state.pinning import b_alone, link_toggled, pin, swap, unpin
from p2sf_explorer.state.state import State, change
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.command import Command

SIDES = (
    ("a", "A", "Show A, which the controls move"),
    ("b", "B", "Show B, as it was pinned"),
    ("both", "A | B", "Show A and B side by side on one scale; zoom and crosshair go together"),
    ("difference", "A − B", "Show A − B; a panel in which a difference means nothing shows A and says why"),
)
BESIDE = 100  # times the share of the empty room: the words have the width of their line
AIR_PX = 60  # beside the buttons and the differences: words in bold are wider
SWAP_TIP = "Exchange A and B: the controls then move the other one"
LINK_TIP = "What moves A and B together"
STILL = "B is pinned; the controls move A · Swap to move this one"
SAME = "A and B are the same: move a control, or choose another lens or method"


class CompareBar(QFrame):
    """Visible while something is pinned as B."""

    def __init__(self, window: QWidget, store: Store):
        super().__init__(window)
        self.setObjectName("bar")
        self._store, self._plain = store, ""
        self.words = QLabel(self)
        self.words.setWordWrap(True)
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
        self._column = column = QVBoxLayout(self)
        column.setContentsMargins(10, 4, 10, 4)
        column.setSpacing(2)
        self._row = row = QHBoxLayout()
        row.setSpacing(6)
        column.addLayout(row)
        group = QButtonGroup(self)
        for button in self.sides.values():
            button.setCheckable(True)
            group.addButton(button)
            row.addWidget(button)
        row.addSpacing(8)
        row.addStretch(1)
        column.addWidget(self.words)
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

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Divide the width anew."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Have the differences between the buttons, or below them where they do not fit."""
        buttons = *self.sides.values(), self.link, self.swap, self.unpin  # not the row, which may hold the words
        wide = sum(button.sizeHint().width() + self._row.spacing() for button in buttons)
        needed = QFontMetrics(self.words.font()).horizontalAdvance(self._plain) + wide
        beside, at = needed < self.width() - AIR_PX, self._row.indexOf(self.words)
        if beside == (at >= 0):
            return
        if beside:
            self._column.removeWidget(self.words)
            self._row.insertWidget(len(SIDES) + 1, self.words, BESIDE)
        else:
            self._row.removeWidget(self.words)
            self._column.addWidget(self.words)

    def commands(self) -> tuple[Command, ...]:
        """Return what can be done by name or key."""
        return (
            Command("Pin what is on screen as B, or take B away", self.turn, ("Ctrl+B",), "Compare"),
            Command("Show A, B, A − B, A | B in turn", self.next_side, ("Ctrl+Shift+B",), "Compare"),
            Command("A and B side by side, or A alone", self.turn_both, ("Ctrl+Alt+B",), "Compare"),
            Command("Exchange A and B", self.exchange, (), "Compare"),
        )

    def turn(self) -> None:
        """Pin B, or take it away."""
        state = self._store.state
        self._store.replace(unpin(state) if state.compare.pinned else pin(state))

    def exchange(self) -> None:
        """Exchange A and B, if there is a B; where it is on screen alone, it stays there, as A."""
        state = self._store.state
        if state.compare.pinned:
            self._store.replace(change(swap(state), shown="a") if b_alone(state) else swap(state))

    def next_side(self) -> None:
        """Show the next of A, B, A − B, A | B; pins B first."""
        if not self._store.state.compare.pinned:
            self.turn()
        sides = CHOICES["shown"]
        self._store.update(shown=sides[(sides.index(self._store.state.compare.shown) + 1) % len(sides)])

    def turn_both(self) -> None:
        """Show A and B side by side, or A alone again; pins B first."""
        state = self._store.state
        shown = "a" if state.compare.shown == "both" else "both"
        self._store.replace(change(state if state.compare.pinned else pin(state), shown=shown))

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
        still = [tr(STILL)] if b_alone(state) else []
        words = " &nbsp;·&nbsp; ".join(still + (parts or [tr(SAME)]))
        if self.words.text() != words:
            plain = [f"{tr(name)}  A {a.text(WINDOW)}  |  B {b.text(WINDOW)}" for name, a, b in contrasts(state)]
            self._plain = "  ·  ".join(still + (plain or [tr(SAME)]))
            self.words.setText(words)
            self._fit()
            self.words.setToolTip("<br>".join(parts))


def marked_up(value: Message) -> str:
    """Return a value in the window's language as rich text."""
    return escape(value.text(WINDOW), quote=False)
