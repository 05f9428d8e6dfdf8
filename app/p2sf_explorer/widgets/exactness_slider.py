"""The slider of the top bar from fast to exact, by R², MTF, R80 or time, with what it costs and gives beside it."""

from math import inf, isfinite, log
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QHideEvent, QPaintEvent
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from p2sf_explorer.charts.theme import SPACE, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.state.scales import significant
from p2sf_explorer.state.state import State
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import chooser, paint_chevron, select
from p2sf_explorer.widgets.slider import STEPS, Slider
from p2sf_explorer.widgets.trade_chart import TradeChart, TradeDot

if TYPE_CHECKING:
    from p2sf_explorer.compute.method_bounds import PredictedCost
    from p2sf_explorer.compute.trade import TradeCurve

TIP = "From fast to exact: how large an error auto may make, or how long a picture may take. Now: {asked}"
MEASURES = {
    "r2": "by R²",
    "mtf": "by the MTF",
    "r80": "by the radius R80",
    "hdr": "by faint light",
    "time": "by time",
}
BY_METHOD = "hdr", "time"  # measures that choose a method, since no R² bounds them
QUICKEST_MS, SLOWEST_MS = 1.0, 1000.0
SERIES = (1.0, 2.0, 5.0)
PANEL_PX, CHART_PX = 340, 150
TOKENS = {"seidel": "marginal", "fitted": "chief", "traced": "text", "huygens": "muted", "spherical": "muted"}


class ExactnessButton(QPushButton):
    """Says what is asked of ``auto``, or its own name where a method was chosen; clicked, it opens the slider."""

    def __init__(self, store: Store, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._store, self._asked = store, ""
        self.setStyleSheet("QPushButton { text-align: left; padding-right: 1.7em; }")
        self.panel = ExactnessPanel(store, self)
        self.clicked.connect(self._open)

    def show_state(self, state: State) -> None:
        """Follow a state: the error that auto may make; of a method that a person chose the help tells."""
        auto = state.optics.automatic
        asked = local(f"R² ≥ {state.optics.tolerance:g}" if auto else state.optics.method)
        if asked != self._asked:
            self._asked = asked
            self.setText(asked if auto else tr("Accuracy"))  # the method's name stands beside it already
            self.setToolTip(tr(TIP, asked=asked))
            self.setAccessibleName(tr(TIP, asked=asked))
        self.panel.show_state(state)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours and the scale of a theme."""
        self.panel.slider.restyle(theme)
        self.panel.chart.restyle(theme)
        self.panel.chart.setFixedHeight(theme.px(CHART_PX))
        self.panel.setFixedWidth(theme.px(PANEL_PX))

    def stop(self) -> None:
        """End the worker's thread."""
        self.panel.stop()

    def show_live(self, live: Live) -> None:
        """Follow an answer."""
        self.panel.show_live(live)

    def _open(self) -> None:
        self.panel.open_at(self.mapToGlobal(QPoint(0, self.height() + 4)))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the button, then a chevron."""
        super().paintEvent(event)
        paint_chevron(self)


class ExactnessPanel(QFrame):
    """The slider with its measure; under it what is asked, what that costs, and what the picture on screen is."""

    def __init__(self, store: Store, parent: QWidget) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self.setObjectName("card")
        self._store = store
        self._live: Live | None = None
        self._costs: tuple[PredictedCost, ...] = ()
        self._curves: tuple[TradeCurve, ...] = ()  # of the complete trade, none of a lens that it does not have
        self.chart = TradeChart("time of one PSF, ms", "error")
        self.measure = chooser(tuple(MEASURES.items()), "What the slider sets: an error, or the time of a picture")
        self.slider = Slider(self)
        self.slider.setAccessibleName(tr("From fast to exact"))
        self.asked, self.costing, self.given, self.typical = (QLabel(self) for _ in range(4))
        self.worker = LateAnswers(self)
        self.worker.finished.connect(self._on_costs)
        self._lay_out()
        self.measure.activated.connect(lambda: store.update(exactness_measure=self.measure.currentData()))
        self.slider.valueChanged.connect(lambda _: self._tell())
        self.slider.sliderReleased.connect(self.commit)
        self.slider.reset.connect(lambda: self._store.update(method="auto", tolerance=State().optics.tolerance))

    def _lay_out(self) -> None:
        grid = QGridLayout()
        fast, exact = QLabel(tr("fast"), self), QLabel(tr("exact"), self)
        for label in (fast, exact, self.costing, self.given, self.typical):
            label.setObjectName("muted")
            label.setWordWrap(label not in (fast, exact))
        self.asked.setObjectName("title")
        grid.addWidget(self.slider, 0, 0, 1, 2)
        grid.addWidget(fast, 1, 0)
        grid.addWidget(exact, 1, 1, Qt.AlignmentFlag.AlignRight)
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 10, 12, 10)
        column.setSpacing(SPACE)
        column.addWidget(self.measure)
        column.addLayout(grid)
        for part in (self.asked, self.costing, self.given, self.chart, self.typical):
            column.addWidget(part)

    def open_at(self, place: QPoint) -> None:
        """Show the panel at a place of the screen and measure what each method costs here."""
        from p2sf_explorer.compute.method_bounds import costs
        from p2sf_explorer.compute.trade import curves, trade_of

        state = self._store.state
        self._costs = ()
        self._curves = curves(trade) if (trade := trade_of(state)) else ()
        self.worker.submit(state, lambda cancelled, progress: costs(state))
        self._place()
        self.adjustSize()
        self.move(place)
        self.show()
        self.slider.setFocus()

    def show_state(self, state: State) -> None:
        """Follow a state."""
        select(self.measure, state.choices.exactness_measure)
        if self.isVisible() and not self.slider.isSliderDown():
            self._place()

    def show_live(self, live: Live) -> None:
        """Say what the picture on screen costs and gives."""
        self._live = live
        if self.isVisible():
            self._tell_given()

    def _measure(self) -> str:
        return self._store.state.choices.exactness_measure

    def _place(self) -> None:
        """Put the handle where the state is."""
        from p2sf_explorer.compute.method_bounds import COARSEST, EXACTEST

        if self._measure() == "time":
            milliseconds = 1e3 * self._live.psf.seconds if self._live else SLOWEST_MS
            travel = log(max(milliseconds, QUICKEST_MS) / QUICKEST_MS) / log(SLOWEST_MS / QUICKEST_MS)
        else:
            error = min(max(1 - self._store.state.optics.tolerance, EXACTEST), COARSEST)
            travel = log(error / COARSEST) / log(EXACTEST / COARSEST)
        self.slider.blockSignals(True)
        self.slider.setValue(round(STEPS * min(1.0, travel)))
        self.slider.blockSignals(False)
        self._tell()
        self._tell_given()

    def one_less_r2(self) -> float:
        """Return the 1 − R² that the slider allows, a round number."""
        from p2sf_explorer.compute.method_bounds import COARSEST, EXACTEST

        return round_to_series(COARSEST * (EXACTEST / COARSEST) ** (self.slider.value() / STEPS))

    def milliseconds(self) -> float:
        """Return the time that the slider allows, a round number."""
        return round_to_series(QUICKEST_MS * (SLOWEST_MS / QUICKEST_MS) ** (self.slider.value() / STEPS))

    def choice(self) -> "PredictedCost | None":
        """Return the method that would be taken, None while costs are unknown.

        Until they are measured at this point they are those of the lens in the complete trade.
        """
        from p2sf.figures.bounds import mtf_error
        from p2sf_explorer.compute.method_bounds import within
        from p2sf_explorer.compute.trade import typical_costs

        known = self._costs or typical_costs(self._curves)
        if not known:
            return None
        if self._measure() == "time":
            return within(known, self.milliseconds())
        if self._measure() == "hdr":
            return next((cost for cost in self._costs if cost.tails <= mtf_error(self.one_less_r2())), known[-1])
        return next((cost for cost in known if cost.error <= self.one_less_r2()), known[-1])

    def commit(self) -> None:
        """Take what the slider asks for."""
        if self._measure() not in BY_METHOD:
            self._store.update(method="auto", tolerance=round(1 - self.one_less_r2(), 9))
        elif (choice := self.choice()) and (self._costs or self._measure() == "time"):
            self._store.update(method=choice.method)

    def _tell(self) -> None:
        self.asked.setText(local(tr(ASKED[self._measure()], **self._values())))
        choice = self.choice()
        self._tell_typical(choice)
        if choice is None or not self._costs:
            self.costing.setText(tr("measuring what each method takes here"))
        elif self._measure() == "hdr" and isfinite(choice.tails):
            known = {"ms": significant(choice.milliseconds, 2), "percent": significant(100 * choice.tails, 2)}
            words = "{method} here: {ms} ms, faint light within {percent} % of the most exact method's"
            self.costing.setText(tr(words, method=choice.method, **known))
        elif isfinite(choice.milliseconds):
            known = {"ms": significant(choice.milliseconds, 2), "error": prediction_text(choice.error)}
            self.costing.setText(tr("{method} here: {ms} ms, {error}", method=choice.method, **known))
        else:
            self.costing.setText(tr("{method} here: longer than a frame", method=choice.method))

    def _tell_typical(self, choice: "PredictedCost | None") -> None:
        """Show the curves of the complete trade in the slider's measure, and the figures of the method in question."""
        self.chart.setVisible(bool(self._curves))
        self.typical.setVisible(bool(self._curves))
        measure = self._measure()
        self.chart.name_axes("time of one PSF, ms", TRADED[measure])
        self.chart.show_dots(tuple(dot_of(curve, measure) for curve in self._curves))
        by_time, by_r2 = measure == "time", measure == "r2"
        self.chart.ask(self.milliseconds() if by_time else None, self.one_less_r2() if by_r2 else None)
        same = [curve for curve in self._curves if choice and curve.method == choice.method]
        if same:
            errors = same[0].errors(measure)
            known = {"half": f"{errors.median:.1g}", "most": f"{errors.most:.1g}", "what": tr(TRADED[measure])}
            words = "{method} over this whole lens, measured: {what} {half} at 50 % of all points, {most} at 95 %"
            self.typical.setText(tr(words, method=same[0].family, **known))

    def _values(self) -> dict[str, str]:
        from p2sf.figures.bounds import mtf_error, r80_sensitivity

        error = self.one_less_r2()
        measure = self._measure()
        if measure == "time":
            return {"ms": f"{self.milliseconds():g}"}
        if measure in ("mtf", "hdr"):
            return {"percent": f"{100 * mtf_error(error):.2g}"}
        if measure == "r80":
            found = r80_sensitivity(self._live.psf) if self._live else inf
            return {"percent": f"{100 * found * mtf_error(error):.2g}" if isfinite(found) else "–"}
        return {"r2": f"{1 - error:.6g}"}

    def _tell_given(self) -> None:
        if self._live is None:
            return
        psf = self._live.psf
        known = {"ms": significant(1e3 * psf.seconds, 2), "error": prediction_text(psf.predicted_error)}
        self.given.setText(tr("on screen: {method}, {ms} ms, {error}", method=psf.method, **known))

    def _on_costs(self, state: State, found: "tuple[PredictedCost, ...]") -> None:
        self._costs = found
        self._tell()

    def stop(self) -> None:
        """End the worker's thread."""
        self.worker.stop()

    def hideEvent(self, event: QHideEvent) -> None:
        """Measure no longer."""
        self.worker.cancel()
        super().hideEvent(event)


ASKED = {
    "r2": "R² ≥ {r2} against Huygens",
    "mtf": "MTF: RMS error ≤ {percent} % of its own RMS",
    "r80": "R80: error ≤ {percent} % of R80, by a bound",
    "hdr": "mean of every ring within {percent} %, down to 1e-6 of the peak",
    "time": "a picture in ≤ {ms} ms",
}


TRADED = {
    "r2": "1 − R²",
    "mtf": "largest difference of contrast",
    "r80": "relative error of R80",
    "hdr": "1 − R²",
    "time": "1 − R²",
}


def dot_of(curve: "TradeCurve", measure: str) -> TradeDot:
    """Return a method of the complete trade as a dot of the chart."""
    errors, first = curve.errors(measure), curve.family not in ("fitted 46", "fitted adaptive")
    name = curve.family if first else ""
    token = TOKENS.get(curve.method, "text")
    return TradeDot(curve.milliseconds, errors.median, errors.most, token, name or curve.family, curve.settings, first)


def round_to_series(value: float) -> float:
    """Return the member of `SERIES`·10ᵏ nearest in ratio."""
    decade = 10.0 ** int(log(value, 10) // 1)
    return min((step * decade for step in (*SERIES, 10.0)), key=lambda member: abs(log(value / member)))


def prediction_text(error: float | None) -> str:
    """Return a predicted 1 − R² in words."""
    if error is None or not isfinite(error):
        return tr("R² not predicted")
    return tr("predicted 1 − R² ≤ {error}", error=f"{error:.1g}")
