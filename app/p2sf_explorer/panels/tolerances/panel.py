"""Tolerances: which error hurts, what share of ten thousand built lenses is good enough, and the worst of them."""

from functools import partial
from math import inf

from PySide6.QtCore import QSignalBlocker
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QDoubleSpinBox,
    QHBoxLayout,
    QMenu,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens
from p2sf.messages import Message
from p2sf.tolerance.criteria import of_worst_field
from p2sf.tolerance.errors_of_build import GRADES, Kind, Tolerance
from p2sf_explorer.charts.overlay import Overlay
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.tolerances import (
    Analyst,
    Figures,
    ToleranceQuestion,
    ToleranceRequest,
    ToleranceResult,
    figures,
    opened_build,
    with_build,
    with_own,
    without_build,
)
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.panels.tolerances.arrangement import OF_KINDS, KindRow, TolerancesBody
from p2sf_explorer.panels.tolerances.histogram import Histogram
from p2sf_explorer.panels.tolerances.tables import BuildList, ErrorTable, error_words
from p2sf_explorer.state.build_errors import Compensator
from p2sf_explorer.state.state import ToleranceView
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, chooser, select
from p2sf_explorer.widgets.chart_card import NOTE_PX, NotedChart
from p2sf_explorer.widgets.plan_note import small_button
from p2sf_explorer.widgets.value_edit import NumberBox

SENSOR_TILTS: tuple[Kind, ...] = ("tilt_x", "tilt_y")
TIP = (
    "Tolerances: every radius, thickness, glass, tilt, decentre and irregularity is off by what a workshop leaves, "
    "anywhere within its tolerance. Which error hurts most, and what share of 10 000 such lenses is good enough; "
    "each is focused again."
)
GRADE_TIP = "The tolerances that workshops offer under this name; you can change the ± values below."
CRITERION_TIP = (
    "How a lens is judged, in the worst of three fields: axis, seven tenths and edge. The Strehl ratio is that of the "
    "peak, as in the other panels."
)
LIMIT_TIP = "The limit that a good lens meets in every field; at first, the one that four lenses of five meet."
AIR_PX = 4
WORDS_SHARE = 0.3  # of a chart's width, that a line's name takes
FILM_TIP = "Save a film of the first forty of these builds: layout, PSF, and where each stands in the yield"
COMPENSATOR_TIP = (
    "What is adjusted in every lens at assembly so that the mean square of the wavefronts of all fields is smallest."
)
GRADE_WORDS = (("commercial", "commercial grade"), ("precision", "precision grade"), ("high", "high precision grade"))
CRITERION_WORDS = (
    ("rms_waves", "RMS wavefront"),
    ("strehl", "Strehl ratio"),
    ("mtf", "contrast (MTF)"),
    ("boresight_um", "shift of the image"),
)
SET_WORDS: dict[Kind, str] = {
    "thickness": "back focus",
    "tilt_x": "tilt x of the sensor",
    "tilt_y": "tilt y of the sensor",
}
AXES = {
    "rms_waves": "RMS wavefront, waves",
    "strehl": "Strehl ratio",
    "mtf": "contrast",
    "boresight_um": "shift of the image, µm",
}
SIGNS = {
    "rms_waves": "RMS ≤ {limit} λ",
    "strehl": "Strehl ratio ≥ {limit}",
    "mtf": "contrast ≥ {limit}",
} | {"boresight_um": "shift ≤ {limit} µm"}
SUFFIXES = {"rms_waves": " λ", "strehl": "", "mtf": "", "boresight_um": " µm"}


class TolerancesPanel:
    """Settings in two rows; below them errors by their harm, histogram and yield, and the worst builds."""

    def __init__(self, store: Store):
        self._store = store
        self.widget = Card("Tolerances", TIP)
        self.grade = chooser(GRADE_WORDS, GRADE_TIP, self.widget)
        self.criterion = chooser(CRITERION_WORDS, CRITERION_TIP, self.widget)
        self.stop_button = small_button("Cancel", "Stop the computation", self._stop)
        self.again = small_button("Draw again", "Build ten thousand other lenses", self._draw_again)
        self.film = small_button("Film…", FILM_TIP)
        self.back = small_button("As designed", "Close the build, and show the lens as designed", self._close_build)
        self.as_grade = small_button("As the grade", "Discard all your own values", self._drop_own)
        self.limit, self.frequency = _number_box(LIMIT_TIP, 4, 1e6), _number_box("Frequency on the sensor", 1, 1e5)
        self.compensate = QToolButton()
        self.kinds = {
            name: _number_box("Tolerance of all errors of this kind", 4 if kinds == ("index",) else 3, 999.0)
            for name, kinds in OF_KINDS
        }
        self.errors, self.worst = ErrorTable(), BuildList()
        self.histogram, self.yields = Histogram(), NotedChart("", "yield, %")
        self.share = self.yields.add_curve("chief", 2)
        self.band = [self.yields.add_curve("line") for _ in range(2)]
        self.share.name = tr("yield, %")
        self._theme = LIGHT
        self._lay_out()
        self.overlay = Overlay(self.body)
        self._asked: ToleranceQuestion | None = None
        self._found: ToleranceResult | None = None
        self._stopped: object = None  # the request that is not asked again by itself
        self._refusal, self._state = "", store.state
        self.late = LateAnswers(self.widget, Analyst().answer)
        self._connect()

    def _lay_out(self) -> None:
        self.back.hide()
        self.widget.add_tool(self.grade)
        self.widget.add_tool(self.criterion)
        self.compensate.setObjectName("small")
        self.compensate.setText(tr("Compensators"))
        self.compensate.setToolTip(tr(COMPENSATOR_TIP))
        self.compensate.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.compensate.setMenu(QMenu(self.compensate))
        self.frequency.setSuffix(" /mm")
        whole = QWidget()
        column = QVBoxLayout(whole)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        first = (self.limit, self.frequency, self.compensate, self.again, self.stop_button, self.film, self.back)
        column.addWidget(_row(first))
        self.kind_row = KindRow(self.kinds, self.as_grade)
        self.body = TolerancesBody(self.errors, (self.histogram, self.yields), self.worst, self.kind_row)
        column.addWidget(self.body, 1)
        self.widget.set_body(whole)

    def _connect(self) -> None:
        store = self._store
        self.widget.bind(store, tolerances_grade=self.grade)
        self.criterion.activated.connect(
            lambda: store.update(tolerances_criterion=self.criterion.currentData(), tolerances_limit=None)
        )
        self.limit.valueChanged.connect(lambda value: store.update(tolerances_limit=value))
        self.frequency.valueChanged.connect(
            lambda value: store.update(tolerances_frequency_per_mm=value, tolerances_limit=None)
        )
        for (_, kinds), box in zip(OF_KINDS, self.kinds.values(), strict=True):
            box.valueChanged.connect(partial(self._set_own, kinds, 0, 0))
        self.errors.typed.connect(lambda one, value: self._set_own((one.kind,), one.piece[0], one.piece[1], value))
        self.errors.refused.connect(store.refused)
        self.worst.opened.connect(self._open_build)
        self.late.finished.connect(self._on_answer)
        self.late.failed.connect(self._on_failure)
        self.late.progressed.connect(self._on_progress)

    def show(self, live: Live) -> None:
        """Follow settings and lens; the builds are drawn anew where these have changed and nothing is dragged."""
        asked: ToleranceQuestion = live.views["tolerances"].question
        self._asked, self._state = asked, live.sides[0] if live.sides else live.state
        self._show_settings(asked.view, asked.request.lens)
        if asked.request not in (self.late.asked, self._stopped) and live.quality == "settled":
            self._refusal, self._stopped = "", None
            self.late.ask(asked.request)
        self._paint()

    def _show_settings(self, view: ToleranceView, lens: Lens) -> None:
        select(self.criterion, view.criterion)
        self.frequency.setVisible(view.criterion == "mtf")
        self.as_grade.setEnabled(bool(view.own))
        _put(self.frequency, view.frequency_per_mm)
        self.limit.setSuffix(SUFFIXES[view.criterion])
        for (_, kinds), box in zip(OF_KINDS, self.kinds.values(), strict=True):
            own = [amount for kind, first, _, amount in view.own if not first and kind == kinds[0]]
            _put(box, own[-1] if own else GRADES[view.grade][kinds[0]])
        self._fill_compensators(view, lens)

    def _fill_compensators(self, view: ToleranceView, lens: Lens) -> None:
        """Offer the back focus, every other distance, and the sensor's tilts."""
        menu, last = self.compensate.menu(), len(lens.surfaces)
        menu.clear()
        rows: list[Compensator] = [("thickness", k, 0) for k in range(last)]  # 0 is the back focus
        rows += [(kind, k, 0) for k in sorted({0, 1, last}) for kind in SENSOR_TILTS]  # 0 is the sensor
        for row in rows:
            action = QAction(_compensator_words(row), menu)
            action.setCheckable(True)
            action.setChecked(row in view.compensators)
            action.triggered.connect(lambda _=False, row=row: self._turn_compensator(row))
            menu.addAction(action)
        self.compensate.setText(tr("Compensators: {count}", count=len(view.compensators)))

    def _turn_compensator(self, row: Compensator) -> None:
        have = self._store.state.tolerances.compensators
        kept = tuple(one for one in have if one != row)
        self._store.update(tolerances_compensators=kept if row in have else (*have, row))

    def _set_own(self, kinds: tuple[Kind, ...], first: int, last: int, value: float) -> None:
        made = with_own(self._store.state.tolerances, kinds, first, last, value)
        self._store.update(tolerances_own=made.own)

    def _drop_own(self) -> None:
        self._store.update(tolerances_own=())

    def _draw_again(self) -> None:
        self.late.forget()
        self._store.update(tolerances_draw=self._store.state.tolerances.draw + 1)

    def _open_build(self, number: int) -> None:
        try:
            self._store.replace(with_build(*self.drawn(), number))
        except P2SFError as error:
            self._store.refused.emit(error)

    def _close_build(self) -> None:
        self._store.replace(without_build(self._store.state))

    def drawn(self) -> tuple[ToleranceQuestion, ToleranceResult]:
        """Return the question on screen and its builds; P2SFError where these are not drawn yet."""
        if self._asked is None or self._found is None or self._stale():
            raise P2SFError("there are no builds of this lens yet; wait until Tolerances shows its histogram")
        return self._asked, self._found

    def _stop(self) -> None:
        self._stopped = self.late.asked
        self.late.forget()
        self._refusal = tr("Stopped. Draw again to start over.")
        self._paint()

    def _stale(self) -> bool:
        return self._found is None or self._asked is None or self._found.request != self._asked.request

    def _on_progress(self, key: ToleranceRequest, share: float) -> None:
        if key == self.late.asked and not self._refusal:
            self.widget.set_readout(local(tr("computing, {percent} %", percent=f"{100 * share:.0f}")))

    def _on_answer(self, key: ToleranceRequest, found: ToleranceResult) -> None:
        if key == self.late.asked:
            self._found, self._refusal = found, ""
            self._paint()

    def _on_failure(self, key: ToleranceRequest, why: Message) -> None:
        self._found, self._refusal = None, said(why)
        self._paint()

    def _paint(self) -> None:
        """Paint the figures of the last result, if it is of these settings."""
        stale = self._stale()
        working = self.late.busy and self._stopped is None
        self.stop_button.setVisible(working)
        self.again.setVisible(not working)
        waiting = tr("The sensitivities are computed from exact rays.")
        self.film.setEnabled(not stale)
        self.overlay.say(self._refusal or (waiting if self._found is None else ""), 0)
        self.limit.setEnabled(self._found is not None)
        self.limit.setSpecialValueText("" if self._found else "–")  # which stands in place of 0
        if self._asked is None or self._found is None:
            _put(self.limit, 0.0)
            return
        if stale:
            self.widget.set_readout(tr("computing"))
            return
        view = figures(self._found, self._asked.view)
        self.errors.show_errors(view, self._asked.view)
        opened = opened_build(self._state, self._found)
        self.back.setVisible(bool(opened))
        self.worst.show_builds(view, opened)
        self._paint_charts(view, opened)
        _put(self.limit, view.limit, view.places)
        self.widget.set_readout(_sentence(view, bool(self._asked.view.compensators)))

    def _paint_charts(self, view: Figures, opened: int) -> None:
        limits, share, error = view.yields
        self.share.set_data(limits, 100 * share)
        for sign, curve in zip((-1, 1), self.band, strict=True):
            curve.set_data(limits, 100 * (share + sign * error))
        ends = float(view.edges[0]), float(view.edges[-1])
        self.histogram.show_counts(view)
        self.histogram.name_axes(AXES[view.criterion], "builds")
        self.yields.name_axes(AXES[view.criterion], "yield, %")
        most = float(view.counts.max())
        self.yields.set_range(ends, (0.0, 104.0))
        noted = [(view.nominal, inf, tr("as designed"), "muted")]
        if opened and self._found:
            value = float(of_worst_field(self._found.builds, view.criterion)[opened - 1])
            noted.append((value, inf, tr("build {number}", number=opened), "text"))
        inside = [note for note in noted if ends[0] <= note[0] <= ends[1]]
        tall = self.histogram.area.height()
        above = min(tall / 2, self._theme.px(NOTE_PX) * len(inside) + AIR_PX)  # the bars, for the names of the lines
        self.histogram.set_range(ends, (0.0, most * tall / (tall - above)))
        marks = ((view.limit, "accent"), *((value, token) for value, _, _, token in inside))
        turn = ends[0] + WORDS_SHARE * (ends[1] - ends[0])  # right of here there is room for words before the line
        notes = ((x, y, f" {words} ", token, -1 if x < turn else 1) for x, y, words, token in inside)
        self.histogram.show_notes(notes, marks)
        self.yields.show_notes((), marks)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        for part in (self.histogram, self.yields, self.errors, self.worst, self.body):
            part.restyle(theme)


def _number_box(tip: str, places: int, most: float) -> NumberBox:
    box = NumberBox()
    box.setRange(0.0, most)
    box.setDecimals(places)
    box.setStepType(NumberBox.StepType.AdaptiveDecimalStepType)
    box.setToolTip(tr(tip))
    box.setAccessibleName(tr(tip))
    return box


def _put(box: QDoubleSpinBox, value: float, places: int | None = None) -> None:
    """Show a value, with so many decimals, without telling that it has changed."""
    with QSignalBlocker(box):
        box.setDecimals(box.decimals() if places is None else places)
        box.setValue(value)


def _row(parts: tuple[QWidget, ...]) -> QWidget:
    body = QWidget()
    row = QHBoxLayout(body)
    row.setContentsMargins(0, 0, 0, 0)
    row.setSpacing(4)
    for part in parts:
        row.addWidget(part)
    row.addStretch(1)
    return body


def _compensator_words(row: Compensator) -> str:
    kind, first, _ = row
    return error_words(Tolerance(kind, first, 0.0)) if first else tr(SET_WORDS[kind])


def _sentence(view: Figures, compensated: bool) -> str:
    """Return the yield, and what the lens as designed has, which without compensators is what *Pupil* shows."""
    limit = tr(SIGNS[view.criterion], limit=local(f"{view.limit:.{view.places}f}"))
    share, error = (local(f"{100 * value:.1f}") for value in (view.share, view.error))
    designed = "as designed, compensated, worst field: {value}" if compensated else "as designed, worst field: {value}"
    nominal = tr(designed, value=local(f"{view.nominal:.{view.places}f}"))
    return f"{tr('{share} % ± {error} % keep {limit}', share=share, error=error, limit=limit)} · {nominal}"
