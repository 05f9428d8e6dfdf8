"""The bar above (lens, method, undo, snapshot, theme), the line below (warnings), the banner for refusals."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QMenu, QToolButton, QWidget

from p2sf.errors import P2SFError
from p2sf.messages import Message
from p2sf.psf.methods import AUTO, METHODS
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr, unbroken
from p2sf_explorer.state.limits import CHOICES
from p2sf_explorer.state.state import State
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import combo_of, select
from p2sf_explorer.widgets.exactness_slider import ExactnessButton
from p2sf_explorer.widgets.readout import Readout
from p2sf_explorer.window import fold
from p2sf_explorer.window.lens_cards import shown_title
from p2sf_explorer.window.lens_chooser import LensChooser
from p2sf_explorer.window.workspace_bar import WorkspaceBar

GAP = 6  # pixels at scale 1 between two parts of the bar
METHOD_WORDS = {AUTO: AUTO} | {method.name: str(method.words) for method in METHODS if method.name in CHOICES["method"]}
METHOD_TIP = (
    "Method: what describes the PSF. auto takes the cheapest method whose predicted R² against Huygens is good enough."
)


class TopBar(QFrame):
    """Everything that is chosen rather than dragged."""

    open_file = Signal()
    lens_chosen = Signal(str)
    recent_chosen = Signal(str)
    help_asked = Signal()

    def __init__(self, store: Store, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("bar")
        self._store = store
        self.workspaces: WorkspaceBar | None = None
        self._shown: tuple[object, ...] = ()
        self._folded, self._trade = fold.Fold(), False  # whether the choice between speed and accuracy is unfolded
        self._gap = GAP
        self.lens = LensChooser(self)
        self.lens.chosen.connect(self.lens_chosen)
        self.open = self._tool("Open", "Open a lens file or a saved state (Ctrl+O), or a recent one", None)
        self.open.setMenu(QMenu(self))
        self.open.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.edited = QLabel(tr("edited"), self)
        self.edited.setObjectName("badge")
        self.edited.setToolTip(tr("The lens differs from its file; save it from the lens table (Ctrl+Shift+S)"))
        self.method = combo_of(METHOD_WORDS, METHOD_TIP, self)
        self.tolerance = ExactnessButton(store, self)
        self.method.setObjectName("")
        self.named = QLabel(tr("Method"), self)
        self.method.activated.connect(lambda: store.update(method=self.method.currentData()))
        self.undo = self._tool("↶", "Undo: take back one step (Ctrl+Z)", store.undo)
        self.redo = self._tool("↷", "Redo: take the step again (Ctrl+Shift+Z)", store.redo)
        self.pin = self._tool("A | B", "Pin what is on screen as B, to compare with it, or unpin it (Ctrl+B)", None)
        self.pin.setCheckable(True)
        self.snapshot = self._tool("Snapshot", "Save a picture that opens as it is here (Ctrl+E), or data", None)
        self.more = self._tool("More", "Report, command palette, colours, theme, language", None)
        self.more.setMenu(QMenu(self))
        self.more.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.help = self._tool("?", "Shortcuts and mouse (Shift+F1 or ?)", self.help_asked.emit)
        self._lay_out()
        for button, words in ((self.undo, "Undo"), (self.redo, "Redo"), (self.help, "Help")):
            button.setAccessibleName(tr(words))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show less in a narrow window."""
        super().resizeEvent(event)
        self.fit()

    def rescale(self, scale: float) -> None:
        """Take a scale of type, which margins and gaps follow."""
        self._row.setContentsMargins(*(round(scale * margin) for margin in (10, 6, 10, 6)))
        self._gap = round(GAP * scale)
        self.method.setMinimumWidth(round(92 * scale))  # a narrow window cuts its words rather than grow
        self.fit()

    def minimumSizeHint(self) -> QSize:
        """Return a width at which hardly anything is left out of the bar."""
        return QSize(0, super().minimumSizeHint().height())

    def fit(self) -> None:
        """Leave out as much as it takes: air, the word before the methods, buttons of workspaces, at last other tools.

        What is left out stays in the menus, under its keys, and in the command palette.
        """
        margins = self._row.contentsMargins()
        room = self.width() - margins.left() - margins.right()
        for less in range(5):
            self._row.setSpacing(self._gap if less < 1 else self._gap // 2)
            self.named.setVisible(less < 2 and self._trade)
            if self.workspaces:
                self.workspaces.make_narrow(less > 2)
            for tool in (self.undo, self.redo, self.pin, self.snapshot, self.help):
                tool.setVisible(less < 4)
            items = [item for k in range(self._row.count()) if (item := self._row.itemAt(k))]
            parts = [part for item in items if (part := item.widget())]
            # Not from the layout, which learns of other sizes later.
            least = [max(part.minimumWidth(), part.minimumSizeHint().width()) for part in parts if not part.isHidden()]
            needed = sum(least) + self._row.spacing() * len(least)
            title = self.lens.sizeHint().width() - self.lens.minimumSizeHint().width()
            read = (title // 9, title // 16, title // 9, 0, 0)[less]  # as much as can be read
            if needed + read <= room:
                break
        self._row.activate()  # at once: parts that came and went may leave the layout at its first answer

    def _lay_out(self) -> None:
        self._row = row = QHBoxLayout(self)
        row.setContentsMargins(10, 6, 10, 6)
        row.setSizeConstraint(QHBoxLayout.SizeConstraint.SetNoConstraint)  # see `fit`
        row.setSpacing(self._gap)
        row.addWidget(self.lens)
        row.addWidget(self.open)
        row.addWidget(self.edited)
        row.addSpacing(6)
        row.addWidget(self.named)
        row.addWidget(self.method)
        row.addWidget(self.tolerance)
        row.addStretch(1)
        for tool in (self.undo, self.redo, self.pin, self.snapshot, self.more, self.help):
            row.addWidget(tool)

    def put_workspaces(self, bar: WorkspaceBar) -> None:
        """Put the workspaces into the middle of the bar."""
        self.workspaces = bar
        at = self._row.indexOf(self.undo)
        self._row.insertWidget(at, bar)
        self._row.insertStretch(at + 1, 1)
        self.fit()

    def _tool(self, text: str, tip: str, action: Callable[[], object] | None) -> QToolButton:
        button = QToolButton(self)
        button.setText(tr(text))
        button.setToolTip(tr(tip))
        button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        if action:
            button.clicked.connect(action)
        return button

    def set_snapshot_menu(self, menu: QMenu) -> None:
        """Give the snapshot button its choices."""
        self.snapshot.setMenu(menu)
        self.snapshot.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)

    def show_recent(self, paths: tuple[str, ...]) -> None:
        """List the dialog that opens a file, and the files opened lately."""
        menu = self.open.menu()
        menu.clear()
        menu.addAction(tr("Open a file…") + "\tCtrl+O", self.open_file.emit)
        menu.addSeparator()
        for number, path in enumerate(paths, 1):
            action = menu.addAction(f"&{number % 10}  {Path(path).name}", partial(self.recent_chosen.emit, path))
            action.setToolTip(path)
        menu.setToolTipsVisible(True)

    def show_state(self, state: State, theme: Tokens) -> None:
        """Follow a state."""
        self.lens.show_lens(state.optics.lens, shown_title(state), theme)
        self.edited.setVisible(state.optics.lens_text is not None)
        select(self.method, state.optics.method)
        self._trade = fold.METHOD in self._folded.shown(state)
        self.method.setVisible(self._trade)
        self.tolerance.setVisible(self._trade)
        self.tolerance.show_state(state)
        if self.workspaces:
            self.workspaces.mark(state.display.workspace)
        self.undo.setEnabled(self._store.can_undo)
        self.redo.setEnabled(self._store.can_redo)
        self.pin.setChecked(state.compare.pinned is not None)
        shown = state.optics.lens_text is None, state.optics.method, self._trade
        if shown != self._shown:  # a slider moves none of these
            self._shown = shown
            self.fit()


class StatusLine(QWidget):
    """Warnings, and what was done."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.warning = Readout(self, colour="warning")
        self.warning.ground = "window"
        row = QHBoxLayout(self)
        row.setContentsMargins(4, 0, 4, 0)
        row.addWidget(self.warning, 1)

    def show_warnings(self, warnings: tuple[Message, ...]) -> None:
        """Show the warnings of an answer."""
        sentences = [said(warning) for warning in warnings]
        text = "   ".join(f"⚠ {sentence}" for sentence in sentences)
        if self.warning.text() != text:
            self.warning.set_text(text, "warning", shorten(sentences))
            self.warning.setToolTip("\n".join(sentences))

    def show_none(self, why: Message | P2SFError) -> None:
        """Show why there is no answer, for longer than the banner does."""
        words = said(why)
        self.warning.set_text(f"⚠ {words}", "warning")
        self.warning.setToolTip(words)

    def say(self, message: Message | P2SFError) -> None:
        """Show a message until the next answer; only what went wrong is in the colour of warnings."""
        self.warning.set_text(said(message), "warning" if isinstance(message, P2SFError) else "text")

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.warning.restyle(theme)


def shorten(sentences: Sequence[str]) -> tuple[str, ...]:
    """Return ever shorter lines: the last warning loses what follows its semicolon first, the first warning last."""
    short, lines = list(sentences), []
    for number in reversed(range(len(short))):
        head, semicolon, _ = short[number].partition("; ")
        if semicolon:
            short[number] = f"{head} …"
            lines.append("   ".join(f"⚠ {words}" for words in short))
    return tuple(lines)


class Banner(QFrame):
    """Says why something cannot be done; it hides with the next answer, or by its button.

    A remedy that takes one click stands beside it as another button, `remedy`.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("banner")
        self.text = QLabel(self)
        self.text.setWordWrap(True)
        close = QToolButton(self)
        close.setText(tr("Dismiss"))
        close.clicked.connect(self.hide)
        self.remedy = QToolButton(self)
        self._run: Callable[[], object] = self.hide
        self.remedy.clicked.connect(lambda: self._run())
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 6, 8, 6)
        row.addWidget(self.text, 1)
        row.addWidget(self.remedy)
        row.addWidget(close)
        self.hide()

    def say(self, message: Message | P2SFError) -> None:
        """Show a message."""
        self.text.setText(unbroken(said(message)))
        self.remedy.hide()
        self.show()

    def offer(self, words: str, tip: str, run: Callable[[], object]) -> None:
        """Offer a remedy beside the message that stands here; words and tip are translated already."""
        self._run = run
        self.remedy.setText(words)
        self.remedy.setToolTip(tip)
        self.remedy.show()
