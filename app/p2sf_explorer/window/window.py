"""The window: from slider to picture in three steps, store → live → panels."""

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import (
    QCloseEvent,
    QDragEnterEvent,
    QDragLeaveEvent,
    QDropEvent,
    QGuiApplication,
    QKeyEvent,
    QShowEvent,
)
from PySide6.QtWidgets import QApplication, QHBoxLayout, QLineEdit, QMainWindow, QSizePolicy, QVBoxLayout, QWidget

from p2sf.errors import P2SFError
from p2sf.lens.lens import message_if_misaligned
from p2sf.messages import Message
from p2sf_explorer.charts.chart import Chart
from p2sf_explorer.charts.theme import SPACE, Tokens, palette, screen_scale, stylesheet, tokens
from p2sf_explorer.compare.compare_bar import CompareBar
from p2sf_explorer.compare.comparison import Answers, answers
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.caption import caption, without_figures
from p2sf_explorer.compute.deferred_sums import Found, Request, SumCache, answer_to
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.setup import first_state
from p2sf_explorer.compute.warnings import without_alterations
from p2sf_explorer.course.course import Course
from p2sf_explorer.files.file_watcher import FileWatcher
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.lessons.controller import LessonController, LessonRoom
from p2sf_explorer.lessons.hall import Hall
from p2sf_explorer.panels import FilmedPanel, Panel, PreparingPanel, build, end_work
from p2sf_explorer.panels.coefficients.panel import CoefficientsPanel
from p2sf_explorer.panels.psf import PsfPanel
from p2sf_explorer.playback.filming import Filming
from p2sf_explorer.playback.play_bar import PlayBar
from p2sf_explorer.state.limits import ADDED, HOLDABLE
from p2sf_explorer.state.link import is_link
from p2sf_explorer.state.panels import PANELS, REGISTRY, view_of
from p2sf_explorer.state.state import Display, State
from p2sf_explorer.state.workspaces import (
    WORKSPACES,
    exchange,
    kept_in_rail,
    on_show,
    on_stage,
    place_panels,
    put_to_tabs,
    with_workspace,
)
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.live_accuracy import AccuracyDisplay, LiveAccuracy
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.caption import Caption
from p2sf_explorer.widgets.command import Command
from p2sf_explorer.widgets.drop import DropFrame, dropped_path, is_photo
from p2sf_explorer.widgets.roles import install_roles
from p2sf_explorer.window.bars import Banner, StatusLine, TopBar
from p2sf_explorer.window.commands.actions import BEGIN, Actions, PanelAccess
from p2sf_explorer.window.commands.sharing import Sharing
from p2sf_explorer.window.controls import WIDTH, Controls
from p2sf_explorer.window.edge import StageEdge
from p2sf_explorer.window.floating_panels import FloatingPanels, Home
from p2sf_explorer.window.foot import Foot
from p2sf_explorer.window.memory_trim import MemoryTrim
from p2sf_explorer.window.no_answer import NO_ANSWER, draw_setup
from p2sf_explorer.window.presentation import LARGER, LARGER_BESIDE, Presentation
from p2sf_explorer.window.second_side import SecondSide
from p2sf_explorer.window.stage import PanelRoom, ShareSplitter
from p2sf_explorer.window.tabs import Tabs
from p2sf_explorer.window.view import View, next_stop
from p2sf_explorer.window.workspace_bar import WorkspaceBar, Workspaces

if TYPE_CHECKING:
    from p2sf_explorer.compute.views.tolerances import ToleranceQuestion, ToleranceResult
    from p2sf_explorer.files.opening import Refusal
    from p2sf_explorer.lessons.lesson import Lesson
    from p2sf_explorer.window.start_screen import StartScreen

T = TypeVar("T")


DIGIT_MODIFIERS = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.KeypadModifier
FIRST_SIZE, FRAME_PX = (1440, 900), 40  # of the window at the first start, and what a desktop adds above it
ALWAYS = "layout", "psf", "coefficients"  # panels that other parts of the window speak to


class MainWindow(QMainWindow):
    """Top bar, controls, panels, status line; ``refresh`` is the whole live path.

    ``measured`` False leaves the accuracy of the picture unmeasured: no background work.
    """

    def __init__(self, state: State | None = None, measured: bool = True) -> None:
        super().__init__()
        install_roles()
        self.setWindowTitle("P2SF Explorer")
        self.setAcceptDrops(True)
        self.store = Store(state or State(), self)
        self.live: Live | None = None
        self._asked = False
        self._answers: Answers | None = None
        self.display = place_panels(self.store.state.display, tuple(PANELS))
        self._placed_from: Display | None = None
        self._theme: Tokens = self._tokens(self.store.state)
        self._styled: dict[str, Tokens] = {}
        self._start: StartScreen | None = None
        self.panels: dict[str, Panel] = {}
        self._make_bars()
        for key in ALWAYS:
            self._build(key)
        self._lay_out()
        self._make_helpers(measured)
        self._connect()
        self._apply_theme()
        self.refresh(self.store.state)

    def _make_bars(self) -> None:
        """Make everything around the panels, and the pages that the panels stand on."""
        self.top, self.controls = TopBar(self.store, self), Controls(self.store, self)
        self.status, self.banner, self.tabs = StatusLine(self), Banner(self), Tabs(REGISTRY, self)
        self.room = PanelRoom(self.tabs, self)
        self.caption = Caption(self.room.stage)
        self.foot = Foot(self.room.stage)
        self.room.stage.put_above(self.caption)
        self.room.stage.put_below(self.foot)
        self.second = SecondSide(self.store, self.room.stage)
        self.floating = FloatingPanels(self, self.store, {entry.key: entry.title for entry in REGISTRY})
        self.compare = CompareBar(self, self.store)
        filming = Filming(self.store, self.refresh, self.is_busy, self._pause_accuracy, self)
        self.play = PlayBar(self.store, filming, self._part, self._builds, self)

    def _make_helpers(self, measured: bool) -> None:
        """Make what works for the window in the background, and the commands."""
        self.measuring = LiveAccuracy(self._panel("psf", PsfPanel).show_badge, self._accuracy_panel, self, measured)
        self.sums, self._shown = SumCache(), self.store.state
        self.late_sums = LateAnswers(self, lambda request, stopped, _: answer_to(request, stopped))
        self.late_sums.finished.connect(self._on_sum)
        self.late_sums.failed.connect(self._on_sum)
        self.memory_trim, self.sharing = MemoryTrim(self), Sharing(self.store, self)
        self.drop_frame = DropFrame(self)
        self.file_watcher = FileWatcher(self.store, self._read_again, self)
        self.lesson_room = LessonRoom(self.left_parts, self.controls, self.room.stage, self._tell)
        self.teaching = LessonController(self.store, self, self.lesson_room, lambda: self._theme, _lectures)
        self.hall = Hall(self.teaching, self.room.stage, self)
        self.course = Course(self.store, self.teaching, lambda: self._theme, self)
        access = PanelAccess(
            live=lambda: self.live,
            theme=lambda: self._theme,
            open=self.open_panel,
            stage=self.take_stage,
            card=lambda key: self.panels[key].widget,
            in_front=lambda: self.panels[self.display.stage].widget,
            explain=self._explain,
            detach=self._detach,
        )
        self.presentation = Presentation(
            self, self.left, (self.top, self.status), lambda: self._middle.insertWidget(0, self.left), self._present
        )
        self.view = View(self.store, lambda: self._theme.scale, self._parts, self)
        self.workspaces = Workspaces(self.store, self.teaching, self)
        self.top.put_workspaces(WorkspaceBar(self.workspaces, self.top))
        self.commands = Actions(self, self.store, self.top, access)
        own = self.tabs, self.workspaces, self.view, self.presentation
        for part in (self.sharing, self.compare, self.play, self.teaching, self.hall, self.course, *own):
            for command in part.commands():
                self.commands.add(command)
        self.commands.add(Command(BEGIN, self.begin_again))
        self.commands.sources.append(self.teaching.listed)
        self.commands.fill_menu()
        self.sharing.fill(self.top.snapshot.menu())

    def _connect(self) -> None:
        self.top.pin.clicked.connect(self.compare.turn)
        self.controls.autofocus.connect(self.commands.autofocus)
        self.controls.swept.connect(self.play.player.toggle)
        self.controls.grasped.connect(self.play.grasp)
        self.foot.play.clicked.connect(self.play.toggle)
        self.play.player.turned.connect(self.foot.show_playing)
        mixer = self._panel("coefficients", CoefficientsPanel).bars
        mixer.swept.connect(lambda term: self.play.player.toggle(ADDED + term))
        self.store.changed.connect(self.refresh)
        self.store.refused.connect(self.refuse)
        self.store.said.connect(self.status.say)
        self.tabs.detach_asked.connect(self.floating.toggle)
        self.tabs.stage_asked.connect(lambda key: self._move_to("stage", key))
        self.tabs.dropped.connect(lambda key: self._exchange(key, self.display.tab))
        self.room.dropped.connect(lambda key, number: self._exchange(key, self._places()[number]))
        self.room.resized.connect(lambda entries: self.store.update(**entries))
        self.caption.chosen.connect(lambda names: self.store.update(caption=names))
        self.tabs.currentChanged.connect(self._on_tab)
        self.tabs.chosen.connect(self.open_panel)
        QGuiApplication.styleHints().colorSchemeChanged.connect(self._on_scheme)

    def _lay_out(self) -> None:
        middle = QHBoxLayout()
        middle.setSpacing(SPACE)
        self.left = QWidget(self)  # a splitter sets its own largest size, so that another widget has to have it
        self.left_parts = ShareSplitter(Qt.Orientation.Vertical)
        self.left_parts.addWidget(self.controls)
        column = QVBoxLayout(self.left)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.left_parts)
        middle.addWidget(self.left)
        self._middle = middle
        self._right = right = QVBoxLayout()
        right.setSpacing(SPACE)
        right.addWidget(self.room, 1)
        for bar in (self.compare, self.play):
            bar.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
            right.addWidget(bar)
        middle.addLayout(right, 1)
        body = QWidget(self)
        body.setObjectName("window")
        self.column = QVBoxLayout(body)
        self.column.setContentsMargins(SPACE, SPACE, SPACE, SPACE // 2)
        self.column.setSpacing(SPACE)
        self.column.addWidget(self.top)
        self.column.addLayout(middle, 1)
        self.column.addWidget(self.status)
        self.edge = StageEdge(self.room.stage, (self.banner,), body)
        self.setCentralWidget(body)
        self.resize(*FIRST_SIZE)

    def begin_again(self) -> "StartScreen":
        """Show the first lens in the first workspace, with the ways to begin; undo leads back."""
        state = replace(first_state(), display=self.store.state.display, choices=self.store.state.choices)
        self.presentation.stop()
        self.store.replace(with_workspace(state, "explore", WORKSPACES["explore"]))
        return self.show_start()

    def show_start(self) -> "StartScreen":
        """Show the ways to begin beside the picture, whose field moves once by itself where motion is welcome."""
        from p2sf_explorer.window.reduced_motion import reduced_motion
        from p2sf_explorer.window.start_screen import Beginnings, StartScreen

        ways = Beginnings(
            learn=self.teaching.open_list, photo=lambda: self.workspaces.choose("image"), open=self.commands.ask_open
        )
        if self._start:
            self._start.leave()
        half_um = self._panel("psf", PsfPanel).half_um
        self._start = shown = StartScreen(
            ways, self.store, self.foot, self._theme, self.room.rail, half_um, reduced_motion()
        )
        shown.left.connect(self._on_start_left)
        shown.begin()
        return shown

    def _on_start_left(self) -> None:
        self._start = None

    def fit_screen(self) -> None:
        """Take the first size, at the present scale of type, as far as the screen has room for it and its frame."""
        room = self.screen().availableSize()
        wanted = QSize(*FIRST_SIZE) * self._theme.scale
        self.resize(wanted.boundedTo(QSize(room.width(), room.height() - self._theme.px(FRAME_PX))))

    def refresh(self, state: State) -> None:
        """Compute the answer for a state and paint it; where there is none, cover what belongs to another one."""
        self.memory_trim.touch()
        self._restyle(state)
        self._bring_up(state)
        try:
            self.controls.show_state(state)
            self.compare.show_state(state)
            self.play.show_state(state)
            self.foot.play.setVisible(self.play.isHidden())
            self._answers = self._answer(state)
        except P2SFError as error:
            self._show_none(state, error)
            return
        self.live = live = self._answers.seen
        self.banner.hide()
        self.top.show_state(state, self._theme)
        self.top.tolerance.show_live(live)
        self.controls.show_live(self._answers.a)
        self.foot.show_live(self._answers.a)
        self._show_figures(live)
        for key in self._visible():
            paint(self.panels[key], key, live)
        self._show_second(self._answers.beside)
        self._sum(state, self._answers.pending)
        self.measuring.watch(live)

    def _tell(self, words: str) -> None:
        """Say something under the stage; as long as it is said, nothing else there answers the question it tells of."""
        self._asked = bool(words)
        self.foot.tell(words)
        if self.live:
            self._show_figures(self.live)

    def _show_figures(self, live: Live) -> None:
        """Show the caption and the warnings, while a question is open without what may be its answer."""
        parts, found = caption(live), live.warnings
        if self._asked:
            parts, found = without_figures(parts), without_alterations(found, live.setup)
        self.caption.show_parts(parts, live.state.display.caption, live.quality == "preview")
        self.status.show_warnings(found)

    def _show_second(self, beside: Live | None) -> None:
        """Show B beside A on the stage, or A alone there."""
        key = self.display.stage
        there = beside is not None and key not in self.display.windows
        second = self.second.follow(key, self.panels[key] if there else None)
        if second and beside:
            self.second.restyle(self._styled[key])
            paint(second, key, beside)
            self.second.share_scales()

    def _show_none(self, state: State, why: P2SFError) -> None:
        """Say why there is no answer, and cover every panel; the lens is drawn where it can be."""
        self.refuse(why)
        if self.live and self._answers and self._answers.a.state == state:
            return  # only the lens file has changed, and is perhaps half written: the picture stays
        self.live = None
        self._sum(state, None)
        self.measuring.watch(None)
        self.controls.show_none()
        self.foot.show_none()
        self.caption.show_parts({}, state.display.caption, False)
        self.status.show_none(why)
        self.second.stop()
        for panel in self.panels.values():
            panel.widget.show_state(state)
            cover(panel, NO_ANSWER)
        if lens := draw_setup(state):
            self.panels["layout"].show(lens)  # type: ignore[arg-type]  # which uses no more of an answer than this
            self.panels["layout"].widget.show_overlay("")
        if state.optics.errors and "misalign" in self.panels:
            from p2sf_explorer.panels.misalign import MisalignPanel

            self._panel("misalign", MisalignPanel).follow(state)
            self.panels["misalign"].widget.show_overlay("")

    def _answer(self, state: State) -> Answers:
        """Return the settled answers, or while a slider moves previews by the methods that ``auto`` had chosen."""
        quality = "preview" if self.store.moving else "settled"
        return answers(state, quality, self._wanted_views(), self._answers, self.sums)

    def _sum(self, state: State, pending: Request | None) -> None:
        """Have the sum that a state's picture waits for computed in the background, and no other."""
        self._shown = state
        if pending != self.late_sums.asked:
            self.late_sums.forget()
        if pending:
            self.late_sums.ask(pending)

    def _on_sum(self, request: Request, found: Found) -> None:
        """Keep what was found, or why nothing was, so that it is not asked again, and show the state anew."""
        self.sums.keep(request, found)
        if request == self.late_sums.asked:
            self.refresh(self._shown)
            if isinstance(found, Message):
                self.refuse(found)

    def refuse(self, why: Message | P2SFError) -> None:
        """Say in the banner why something cannot be done; the last picture stays."""
        self.banner.say(why)
        self.top.show_state(self.store.state, self._theme)

    def open_panel(self, key: str) -> None:
        """Bring a panel on show, and to the front of the tabs where it is not on the stage or in the rail."""
        if key in self.floating.open:
            self.floating.open[key].raise_()
        elif key != self.display.stage:
            self.store.update(**({} if key in self.display.rail else {"tab": key}), show_rail=True)

    def take_stage(self, key: str) -> None:
        """Put a panel on the stage; what it displaces takes its place."""
        self.store.update(**on_stage(self.display, key))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Put the satellite of a digit on the stage, unless the digit is typed into a value or a table.

        This goes for hidden ones too, as while presenting. A table passes on even those keys that begin an edit.
        """
        number, typed = event.key() - Qt.Key.Key_0, isinstance(QApplication.focusWidget(), QLineEdit)
        known = 1 <= number < len(self._places())
        if known and event.modifiers() in DIGIT_MODIFIERS and not typed:
            self.take_stage(self._places()[number])
        else:
            super().keyPressEvent(event)

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Go on with Tab, or back with Shift+Tab, in the order of the window's parts, wherever panels stand."""
        stop = next_stop(self, self._parts(), QApplication.focusWidget(), 1 if forward else -1)
        if stop is None:
            return super().focusNextPrevChild(forward)
        reasons = Qt.FocusReason.TabFocusReason, Qt.FocusReason.BacktabFocusReason
        stop.setFocus(reasons[not forward])
        return True

    def _places(self) -> tuple[str, ...]:
        """Return the panels in their order: the stage, the satellites, the tab in front."""
        return (self.display.stage, *self.display.rail, self.display.tab)

    def _exchange(self, key: str, other: str) -> None:
        if key in PANELS:  # a title may come from another program's window
            self.store.update(**exchange(self.display, key, other))

    def _move_to(self, place: str, key: str) -> None:
        """Put a panel where its card asks for; asked for again, the stage takes the room of the rail, or gives it."""
        if place == "stage" and key == self.display.stage:
            self.store.update(show_rail=not self.display.show_rail)
        else:
            moves = {"stage": on_stage, "rail": kept_in_rail, "tabs": put_to_tabs}
            self.store.update(**moves[place](self.display, key))

    def _detach(self) -> None:
        """Give the panel in hand a window of its own, or take it back."""
        from p2sf_explorer.widgets.copying import card_in_hand

        card = card_in_hand(self, self.panels[self.display.stage].widget)
        self.floating.toggle(next(key for key, panel in self.panels.items() if panel.widget is card))

    def is_busy(self) -> bool:
        """Return whether anything is still computed in the background."""
        panels = *self.panels.values(), *filter(None, (self.second.panel,))
        late = [late for panel in panels for late in panel.widget.findChildren(LateAnswers)]
        preparing = any(isinstance(panel, PreparingPanel) and panel.busy for panel in panels)
        return preparing or any(answers.busy for answers in (*late, self.measuring.late, self.late_sums))

    def _panel(self, key: str, kind: type[T]) -> T:
        """Return a panel as its own type."""
        panel = self.panels[key]
        if not isinstance(panel, kind):
            raise TypeError(f"panel {key} is a {type(panel).__name__}, not a {kind.__name__}")
        return panel

    def _accuracy_panel(self) -> AccuracyDisplay | None:
        panel = self.panels.get("accuracy")
        return panel if isinstance(panel, AccuracyDisplay) else None

    def _pause_accuracy(self, on: bool) -> None:
        """Measure no accuracy for a while, unless its panel is on show, or measure again."""
        self.measuring.film(on)

    def _part(self, key: str) -> QWidget:
        """Return the part of the window that a film shows."""
        parts: dict[str, QWidget] = {"stack": self.room, "stage": self.room.stage, "tabs": self.tabs}
        if key not in (*parts, *self._visible()):
            self.open_panel(key)
        return parts.get(key) or self.panels[key].widget

    def _builds(self) -> "tuple[ToleranceQuestion, ToleranceResult]":
        """Return the builds that the Tolerances panel has drawn, and bring it on show; P2SFError where it has none."""
        from p2sf_explorer.panels.tolerances.panel import TolerancesPanel

        self.open_panel("tolerances")
        return self._panel("tolerances", TolerancesPanel).drawn()

    def _explain(self, refused: "Refusal") -> None:
        """Say why a file is not opened, in the import report and in the banner, which offers substitute glasses."""
        from p2sf_explorer.files.opening import REPORT_TAB
        from p2sf_explorer.panels.import_report import ImportReportPanel

        self.open_panel(REPORT_TAB)
        report = self._panel(REPORT_TAB, ImportReportPanel)
        report.show_refusal(refused)
        self.refuse(refused.message)
        if refused.substituted:
            self.banner.offer(report.accept.text(), report.accept.toolTip(), report.accept.click)

    def _read_again(self) -> bool:
        """Show the lens as its file is now; return whether it can be read."""
        self.refresh(self.store.state)
        return not self.banner.isVisible()

    def _visible(self) -> tuple[str, ...]:
        """Return the panels on show."""
        return tuple(key for key in on_show(self.display) if key in self.panels)

    def _wanted_views(self) -> dict[str, compute.ViewFunction]:
        views = {key: view_of(PANELS[key]) for key in self._visible()}
        return {key: view for key, view in views.items() if view}

    def _bring_up(self, state: State) -> None:
        """Put the state's panels where they stand, building each the first time it is on show."""
        if state.display is not self._placed_from:  # a slider changes nothing here
            self._placed_from, self.display = state.display, place_panels(state.display, tuple(PANELS))
            if self.presentation.on:
                self.display = replace(self.display, show_rail=False)
            self._place_panels(self.display)
        self.controls.setVisible(state.display.show_controls)
        self.left.setVisible(state.display.show_controls or self.teaching.active)
        self._style_left()
        for name in self._visible():
            self._style(name)

    def _place_panels(self, display: Display) -> None:
        apart = tuple(key for key in display.windows if key in PANELS)
        homes = self._homes(display)
        for key in {*homes, *apart} - set(self.panels):
            self._build(key)
        self.room.arrange(display)
        elsewhere = display.stage, *display.rail
        self.floating.follow(homes, apart, self.panels, lambda: self.tabs.bring_up(display.tab, elsewhere))

    def _parts(self) -> tuple[QWidget, ...]:
        """Return the parts of the window in the order in which the keyboard goes through them."""
        satellites = self.room.satellites[: len(self.display.rail)]
        beside = (self._start,) if self._start else (*satellites, self.tabs)
        return self.top, self.left, self.room.stage, *beside, self.compare, self.play

    def _present(self) -> None:
        """Begin or end presenting: larger type on the stage, nothing beside it, only sliders in the controls."""
        on = self.presentation.on
        self._style_stage()
        self.controls.make_slim(on)
        self.foot.setVisible(not on)
        self._placed_from = None
        self.refresh(self.store.state)
        self.hall.present(on, self.presentation.beside)

    def _homes(self, display: Display) -> dict[str, Home]:
        """Return where the panels on show stand inside the window."""
        homes = {display.stage: Home(self.room.stage, "stage")}
        if display.show_rail:
            self.room.make_satellites(len(display.rail))
            rail = zip(display.rail, self.room.satellites, strict=False)  # those beyond are hidden
            homes |= {key: Home(place, "rail") for key, place in rail}
            homes[display.tab] = Home(self.tabs.pages()[display.tab], "tabs")
        return homes

    def _build(self, key: str) -> None:
        self.panels[key] = made = build(PANELS[key], self.store)
        made.widget.key = key
        made.widget.apart_asked.connect(partial(self.floating.toggle, key))
        made.widget.place_asked.connect(lambda place: self._move_to(place, key))
        made.widget.theory_asked.connect(lambda: self.commands.theory(key))
        if key in HOLDABLE:
            for chart in made.widget.findChildren(Chart):
                chart.let_go.connect(partial(self._let_go, key))
        if isinstance(made, FilmedPanel):
            made.film.clicked.connect(self.play.ask_film_of_builds)

    def _let_go(self, key: str) -> None:
        """Hold a panel's scale no longer, in the state too."""
        held = self.store.state.display.held_scales
        self.store.update(held_scales=tuple(pair for pair in held if pair[0] != key))

    def _on_tab(self) -> None:
        self.store.update(tab=self.tabs.current())

    def _on_scheme(self) -> None:
        if self.store.state.display.theme == "system":
            self.refresh(self.store.state)

    def _restyle(self, state: State) -> None:
        theme = self._tokens(state)
        if theme != self._theme:
            self._theme = theme
            self._apply_theme()

    def _tokens(self, state: State) -> Tokens:
        """Return the theme of a state, at its scale of type or at that which suits the screen."""
        percent = state.display.scale_percent
        scale = screen_scale(self.screen().size()) if percent is None else percent / 100
        return tokens(state.display.theme, state.display.colours, scale)

    def _apply_theme(self) -> None:
        QApplication.setPalette(palette(self._theme))
        self.setStyleSheet(stylesheet(self._theme))
        self._style_left()
        self.column.setContentsMargins(*(self._theme.px(side) for side in (SPACE, SPACE, SPACE, SPACE // 2)))
        for layout in (self.column, self._middle, self._right):
            layout.setSpacing(self._theme.px(SPACE))
        for parts in (self.room, self.room.parts):
            parts.rescale(self._theme.scale)
        self.top.rescale(self._theme.scale)
        self.edge.rescale(self._theme.scale)
        self.top.tolerance.restyle(self._theme)
        self.status.restyle(self._theme)
        self._style_stage()
        self.foot.restyle(self._theme)

    def _style_stage(self) -> None:
        """Give the stage and its caption the present theme: larger while presenting."""
        on = self.presentation.on
        theme = replace(self._theme, scale=LARGER * self._theme.scale) if on else self._theme
        self.room.stage.setStyleSheet(stylesheet(theme) if on else "")
        self.caption.restyle(theme, self.screen().size().height() if on else 0)

    def _style(self, key: str) -> None:
        """Give a panel the present theme, when it is first shown after a change."""
        theme = self._theme
        if self.presentation.on and key == self.display.stage:
            theme = replace(theme, scale=LARGER * theme.scale)
        if self._styled.get(key) != theme:
            self._styled[key] = theme
            self.panels[key].restyle(theme)
            self.panels[key].widget.rescale(theme.scale)

    def _style_left(self) -> None:
        """Give the column at the left the present theme: larger while presenting."""
        theme, larger = self._theme, self.presentation.on
        if larger:
            theme = replace(theme, scale=LARGER_BESIDE * theme.scale)
        if self._styled.get("left") == theme:
            return
        self._styled["left"] = theme
        own = stylesheet(theme) if larger else ""
        if self.left.styleSheet() != own:
            self.left.setStyleSheet(own)
        self.left.setFixedWidth(theme.px(WIDTH))
        self.left_parts.rescale(theme.scale)
        self.controls.restyle(theme)

    def showEvent(self, event: QShowEvent) -> None:
        """Follow the window to another screen, whose type may be of another size."""
        super().showEvent(event)
        if handle := self.windowHandle():
            handle.screenChanged.connect(self._on_screen, Qt.ConnectionType.UniqueConnection)

    def _on_screen(self) -> None:
        self.refresh(self.store.state)

    def closeEvent(self, event: QCloseEvent) -> None:
        """End the background work with the window."""
        self.presentation.stop()
        self.play.stop()
        self.commands.stop()
        self.teaching.stop()
        self.course.stop()
        self.top.tolerance.stop()
        self.measuring.late.stop()
        self.late_sums.stop()
        self.memory_trim.stop()
        self.floating.stop()
        self.second.stop()
        for panel in self.panels.values():
            end_work(panel)
        super().closeEvent(event)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Accept a lens file, a saved state, a snapshot, or a link."""
        if found := dropped_path(event.mimeData()):
            event.acceptProposedAction()
            self.drop_frame.show_for(found)

    def dragLeaveEvent(self, event: QDragLeaveEvent) -> None:
        """Take back the frame."""
        self.drop_frame.hide()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open what was dropped."""
        event.acceptProposedAction()
        self.drop_frame.hide()
        found = dropped_path(event.mimeData())
        if not found:
            return
        if "measured" in self._visible() and is_photo(found):
            from p2sf_explorer.panels.measured import MeasuredPanel

            self._panel("measured", MeasuredPanel).drop.take(Path(found))
        elif "image" in self._visible() and is_photo(found):
            from p2sf_explorer.panels.image.panel import ImagePanel

            self._panel("image", ImagePanel).drop.take(Path(found))
        elif is_link(found):
            self.sharing.open(found)
        else:
            self.commands.open_path(found)


def _lectures(language: str) -> "tuple[dict[str, Lesson], tuple[P2SFError, ...]]":
    """Return the lectures in a language, and the errors of files that are none."""
    from p2sf_explorer.course.lectures import find_lectures

    return find_lectures(language)


def paint(panel: Panel, key: str, live: Live) -> None:
    """Have a panel show an answer and the side of a comparison that it is of, or say why it has nothing to show."""
    panel.widget.show_state(live.state)
    if (view := live.views.get(key)) and view.why:
        cover(panel, view.why)
        return
    if key in HOLDABLE:
        for chart in panel.widget.findChildren(Chart):
            chart.hold(HOLDABLE[key][0], dict(live.state.display.held_scales).get(key))
    panel.show(live)
    panel.widget.show_overlay("")
    why = live.difference.why.get(key) if live.difference else None
    note = why or message_if_misaligned(live.setup.lens, PANELS[key].aligned)
    panel.widget.show_side("A" if why else live.side, said(note) if note else "")


def cover(panel: Panel, why: Message) -> None:
    """Say in a panel's place why it has nothing to show; it wants nothing more of what it has asked."""
    for late in panel.widget.findChildren(LateAnswers):
        late.forget()
    panel.widget.show_overlay(said(why))
