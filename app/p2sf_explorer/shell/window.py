"""The window: from slider to picture in three hops, store → live → panels."""

from pathlib import Path
from time import perf_counter

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QHBoxLayout, QMainWindow, QSplitter, QVBoxLayout, QWidget

from p2sf.errors import P2SFError
from p2sf_explorer.charts.theme import SPACE, palette, stylesheet, tokens
from p2sf_explorer.compare.compare_bar import CompareBar
from p2sf_explorer.compare.comparison import Answers, answers
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.live import Live
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.lessons.controller import LessonController
from p2sf_explorer.panels import REGISTRY, Panel, build, view_of
from p2sf_explorer.playback.play_bar import PlayBar
from p2sf_explorer.shell.actions import Actions
from p2sf_explorer.shell.bars import Banner, StatusLine, TopBar
from p2sf_explorer.shell.controls import Controls
from p2sf_explorer.shell.floating_panels import Floating
from p2sf_explorer.shell.memory_trim import MemoryTrim
from p2sf_explorer.shell.sharing import Sharing
from p2sf_explorer.shell.show import WHY, drawn, paint
from p2sf_explorer.shell.tabs import Tabs, page
from p2sf_explorer.state.limits import ADDED
from p2sf_explorer.state.link import is_link
from p2sf_explorer.state.state import State
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.drop import dropped, is_photo
from p2sf_explorer.workers.deferred import DeferredWorker
from p2sf_explorer.workers.live_accuracy import LiveAccuracy


def splitter(orientation: Qt.Orientation, widgets: list[QWidget], shares: tuple[int, ...]) -> QSplitter:
    """Return a splitter whose parts keep these shares of the room."""
    made = QSplitter(orientation)
    made.setHandleWidth(SPACE)
    made.setChildrenCollapsible(False)
    for k, (widget, share) in enumerate(zip(widgets, shares, strict=True)):
        made.addWidget(widget)
        made.setStretchFactor(k, share)
    made.setSizes([100 * share for share in shares])
    return made


ENTRIES = {entry.key: entry for entry in REGISTRY}
MAIN = tuple(entry.key for entry in REGISTRY if entry.place == "main")
TABS = tuple(entry for entry in REGISTRY if entry.place != "main")


class MainWindow(QMainWindow):
    """Top bar, controls, panels, status line; ``refresh`` is the whole live path.

    ``measured`` False leaves the accuracy of the picture unmeasured: no background work.
    """

    def __init__(self, state: State | None = None, measured: bool = True):
        super().__init__()
        self.setWindowTitle("P2SF Explorer")
        self.setAcceptDrops(True)
        self.store = Store(state or State(), self)
        self.top, self.controls = TopBar(self.store, self), Controls(self.store, self)
        self.status, self.banner, self.tabs = StatusLine(self), Banner(self), Tabs(TABS, self)
        self.compare, self.play = CompareBar(self, self.store), PlayBar(self)
        self.homes = {key: page(key) for key in MAIN} | self.tabs.pages()
        self.floating = Floating(self, self.store, self.homes, REGISTRY)
        self.tabs.detach_asked.connect(self.floating.toggle)
        self.panels: dict[str, Panel] = {}
        for key in MAIN:
            self._build(key)
        self.live: Live | None = None
        self._answers: Answers | None = None
        self.frame_ms: float | None = None
        self._theme, self._styled = None, {}
        self._lay_out()
        self.actions, self.measuring = Actions(self), LiveAccuracy(self, measured)
        self.sharing, self.settling, self.memory_trim = Sharing(self), DeferredWorker(self), MemoryTrim(self)
        self.teaching = LessonController(self)
        for command in (*self.compare.commands(), *self.play.commands(), *self.teaching.commands()):
            self.actions.add(command)
        self.top.pin.clicked.connect(self.compare.turn)
        self.top.lessons.clicked.connect(self.teaching.toggle)
        self.controls.swept.connect(self.play.player.toggle)
        self.controls.grasped.connect(self.play.player.pause_on)
        self.panels["coefficients"].bars.swept.connect(lambda term: self.play.player.toggle(ADDED + term))
        self.store.changed.connect(self.refresh)
        self.store.refused.connect(self.refuse)
        self.tabs.currentChanged.connect(self._on_tab)
        self.tabs.chosen.connect(self.open_panel)
        QGuiApplication.styleHints().colorSchemeChanged.connect(self._on_scheme)
        self.refresh(self.store.state)

    def _lay_out(self) -> None:
        row = splitter(Qt.Orientation.Horizontal, [self.homes[key] for key in MAIN[1:]], (19, 19, 17))
        self.stack = splitter(Qt.Orientation.Vertical, [self.homes[MAIN[0]], row, self.tabs], (27, 41, 32))
        self.middle = middle = QHBoxLayout()
        middle.setSpacing(SPACE)
        middle.addWidget(self.controls)
        right = QVBoxLayout()
        right.setSpacing(SPACE)
        right.addWidget(self.compare)
        right.addWidget(self.play)
        right.addWidget(self.stack, 1)
        middle.addLayout(right, 1)
        body = QWidget(self)
        body.setObjectName("window")
        column = QVBoxLayout(body)
        column.setContentsMargins(SPACE, SPACE, SPACE, SPACE // 2)
        column.setSpacing(SPACE)
        column.addWidget(self.top)
        column.addWidget(self.banner)
        column.addLayout(middle, 1)
        column.addWidget(self.status)
        self.setCentralWidget(body)
        self.resize(1440, 900)

    def refresh(self, state: State) -> None:
        """Compute an answer and paint it; where there is none, say so over what is of another set-up."""
        begun = perf_counter()
        self.memory_trim.touch()
        self._restyle(state)
        self._bring_up(state)
        try:
            self.controls.show_state(state)
            self.compare.show_state(state)
            self.play.show_state(state)
            self._answers = self._answer(state)
        except P2SFError as error:
            self._show_none(state, error.message)
            return
        self.live = live = self._answers.seen
        self.banner.hide()
        self.top.show_state(state, self._theme.dark)
        self.controls.show_live(self._answers.a)
        for key in self._visible():
            paint(self.panels[key], key, live)
        self.status.show_live(live, self.frame_ms)
        self.settling.watch(state, self._answers.pending)
        self.measuring.watch(live)
        QTimer.singleShot(0, lambda: self._painted(begun))

    def _show_none(self, state: State, sentence: str) -> None:
        """Say why there is no answer; nothing on screen may pass for one but the lens, where it can be drawn."""
        self.refuse(sentence)
        if self.live and self._answers.a.state == state:
            return  # only its file has changed, and is half written perhaps: the picture stays
        self.live = None
        self.settling.watch(state, None)
        self.controls.show_none()
        self.status.show_none(sentence)
        for panel in self.panels.values():
            panel.widget.show_overlay(tr(WHY))
        if lens := drawn(state):
            self.panels["layout"].show(lens)
            self.panels["layout"].widget.show_overlay("")

    def _answer(self, state: State) -> Answers:
        """Return the settled answers, or while a slider moves previews by the methods that ``auto`` had chosen."""
        quality = "preview" if self.store.moving else "settled"
        return answers(state, quality, self._wanted(), self._answers, self.settling.cache)

    def refuse(self, sentence: str) -> None:
        """Say in the banner why something cannot be; the last good picture stays."""
        self.banner.say(sentence)
        self.top.show_state(self.store.state, self._theme.dark)

    def open_panel(self, key: str) -> None:
        """Bring a panel to the front."""
        if key not in MAIN:
            self.store.update(tab=key)

    def _painted(self, begun: float) -> None:
        self.frame_ms = 1e3 * (perf_counter() - begun)

    def _visible(self) -> tuple[str, ...]:
        """Return the panels on show: the main ones, the open tab, and those in windows of their own."""
        return tuple(dict.fromkeys((*MAIN, self.tabs.current(), *self.floating.open)))

    def _wanted(self) -> dict[str, compute.ResultFunction]:
        views = {key: view_of(ENTRIES[key]) for key in self._visible()}
        return {key: view for key, view in views.items() if view}

    def _bring_up(self, state: State) -> None:
        """Bring the state's tab to the front and its panels into their own windows, building each the first time."""
        pages = self.tabs.pages()
        key = state.tab if state.tab in pages else next(iter(pages))
        apart = tuple(name for name in state.windows if name in self.homes)
        for name in {key, *apart} - set(self.panels):
            self._build(name)
        self.floating.follow(apart, self.panels)
        self.floating.bring_up(key, self.panels, self.tabs.bring_up)
        self.tabs.show_apart(apart)
        for name in self._visible():
            self._style(name)

    def _build(self, key: str) -> None:
        self.panels[key] = made = build(ENTRIES[key], self.store)
        made.widget.apart_asked.connect(lambda: self.floating.toggle(key))
        self.floating.place(key, made.widget)

    def _on_tab(self) -> None:
        self.store.update(tab=self.tabs.current())

    def _on_scheme(self) -> None:
        if self.store.state.theme == "system":
            self.refresh(self.store.state)

    def _restyle(self, state: State) -> None:
        theme = tokens(state.theme, state.colours)
        if theme == self._theme:
            return
        self._theme = theme
        QApplication.instance().setPalette(palette(theme))
        self.setStyleSheet(stylesheet(theme))
        for part in (self.controls, self.status):
            part.restyle(theme)

    def _style(self, key: str) -> None:
        """Paint a panel in the present theme, the first time it is on show since that changed."""
        if self._styled.get(key) != self._theme:
            self._styled[key] = self._theme
            self.panels[key].restyle(self._theme)

    def closeEvent(self, event) -> None:
        """End the background work with the window."""
        self.play.stop()
        self.measuring.stop()
        self.settling.stop()
        self.memory_trim.stop()
        self.floating.stop()
        for panel in self.panels.values():
            getattr(panel, "stop", lambda: None)()
        super().closeEvent(event)

    def dragEnterEvent(self, event) -> None:
        """Welcome a lens file, a saved state, a snapshot, or a link."""
        if dropped(event.mimeData()):
            event.acceptProposedAction()

    def dropEvent(self, event) -> None:
        """Open what was dropped."""
        event.acceptProposedAction()
        found = dropped(event.mimeData())
        if found and "image" in self._visible() and is_photo(found):
            self.panels["image"].drop.take(Path(found))
            return
        (self.sharing.open if is_link(found) else self.actions.open_path)(found)
