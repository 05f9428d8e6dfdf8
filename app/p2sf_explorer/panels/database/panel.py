"""The depth-and-field space of the lens: a coefficient's map, the error of interpolation, an atlas of PSFs."""

import numpy as np
from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from p2sf.conventions import NM_PER_UM, degrees_from_slope
from p2sf.database.parts import KINDS
from p2sf.messages import Message
from p2sf_explorer.charts.chart import Grid
from p2sf_explorer.charts.colour_scale import ColourScale
from p2sf_explorer.charts.plots import ColourBar
from p2sf_explorer.charts.theme import Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.setup import with_lens
from p2sf_explorer.compute.views.database import LOSSY, NODES, Atlas, DatabaseRequest, DatabaseResult, answer
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr, unbroken
from p2sf_explorer.panels.database.depth_field_chart import PER_METRE, AtlasView, DepthFieldMap, Ends
from p2sf_explorer.state.terms import WORDS
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, chooser
from p2sf_explorer.widgets.chart_card import TurningRow
from p2sf_explorer.widgets.empty_state import EmptyState
from p2sf_explorer.widgets.plan_note import small_button

TIP = (
    "Database: every coefficient over depth and field at this wavelength, as polynomials that are exact to "
    "round-off. Drag on a map or the atlas, or use the arrow keys and Enter, to choose the source."
)
VALUE_MAP, ERROR_MAP = "CET-D1A", "viridis"
SAMPLE = "cooke_triplet"
RULES = {"table1": "table 1 of the paper", "linear": "linear"}
# Pixels at scale 1: what a map needs to be read, from where the note has room below and its height, the least size.
PART_WIDE, PART_HIGH, NOTED, NOTE_HIGH, LEAST = 230, 130, 260, 55, (120, 90)
ERRORS = {"table1": "error of table 1 of the paper", "linear": "error of linear interpolation"}


class DatabasePanel:
    """Map, error map and atlas, filled by a worker; the present point follows at once."""

    def __init__(self, store: Store):
        self._store = store
        self.widget = Card("Database", TIP)
        names = tuple((k, "Wd defocus" if k == "wd" else f"W{k[1:]} {WORDS[k]}") for k in KINDS)
        self.term = chooser(names, "Which coefficient", self.widget)
        self.rule = chooser(tuple((r, RULES[r]) for r in LOSSY), "The interpolation whose error is shown", self.widget)
        self.bars = ColourBar(), ColourBar()
        self.map, self.error, self.atlas = DepthFieldMap(self.bars[0]), DepthFieldMap(self.bars[1]), AtlasView()
        self.note = QLabel()
        self._lay_out()
        self._choices = store.state.choices
        self.widget.bind(store, database_coefficient=self.term, database_rule=self.rule)
        for chart in (self.map, self.error, self.atlas):
            chart.taken.connect(store.begin)
            chart.released.connect(store.end)
            chart.picked.connect(lambda depth, angle: store.update(depth_mm=depth, field_deg=angle))
        self._answer: DatabaseResult | None = None
        self.late = LateAnswers(self.widget, lambda asked, stopped, _: answer(asked, stopped))
        self.late.finished.connect(self._on_answer)
        self.late.failed.connect(self._on_failure)

    def _lay_out(self) -> None:
        self.widget.add_tool(self.term)
        self.widget.add_tool(self.rule)
        self.note.setObjectName("muted")
        self.note.setWordWrap(True)
        self.heads = [QLabel() for _ in range(3)]
        parts = ((self.map, self.bars[0]), (self.error, self.bars[1]), (self.atlas,))
        headings = tuple(with_heading(head, part) for head, part in zip(self.heads, parts, strict=True))
        self.body = DatabaseBody(headings, self.note)
        self.body.counted.connect(lambda count: self.rule.setVisible(count > 1))
        sample = small_button("Show the Cooke triplet", "Undo brings this lens back", self._show_sample)
        self.empty = EmptyState(tr("No maps of this lens"), "", (sample,))
        self.empty.hide()
        whole = QWidget()
        column = QVBoxLayout(whole)
        column.setContentsMargins(0, 0, 0, 0)
        for part in (self.body, self.empty):
            column.addWidget(part, 1)
        self.widget.set_body(whole)

    def _show_sample(self) -> None:
        self._store.replace(with_lens(self._store.state, SAMPLE))

    def _show_empty(self, why: str) -> None:
        """Say why there are no maps and what to do, in their place; show them for ""."""
        words = tr("{why}. Drop a lens file on the window, or take one with maps.", why=why.rstrip("."))
        self.empty.words.setText(unbroken(words))
        self.empty.setVisible(bool(why))
        self.body.setHidden(bool(why))

    def show(self, live: Live) -> None:
        """Mark the present point, and ask the worker when more than the point has changed."""
        asked: DatabaseRequest = live.views["database"].question
        state = live.state
        if state.choices != self._choices:
            self._choices = state.choices
            self._paint()
        for chart in (self.map, self.error, self.atlas):
            chart.show_point(state.optics.depth_mm, state.optics.field_deg)
        self.late.ask(asked)
        self._show_wavelength(state.optics.wavelength_nm)

    def _show_wavelength(self, wavelength_nm: float) -> None:
        at = tr("at {wavelength} nm", wavelength=f"{wavelength_nm:.1f}")
        self.widget.set_readout(f"{at} · {tr('working')}" if self._stale() else at)

    def _stale(self) -> bool:
        return self._answer is None or self._answer.question != self.late.asked

    def _on_answer(self, key: DatabaseRequest, found: DatabaseResult) -> None:
        self._answer = found
        self._show_empty("")
        self._paint()
        if not self._stale():
            self._show_wavelength(NM_PER_UM * key.wavelength_um)

    def _on_failure(self, key: DatabaseRequest, why: Message) -> None:
        self._show_empty(said(why))
        self.widget.set_readout(tr("no maps"))

    def _paint(self) -> None:
        if not self._answer:
            return
        found, term, rule = self._answer, self._choices.database_coefficient, self._choices.database_rule
        self._paint_map(found, term)
        self._paint_error(found, term, rule)
        self.atlas.show_atlas(found.atlas)
        for head, text in zip(self.heads, (name(term), tr(ERRORS[rule]), atlas_head(found.atlas)), strict=True):
            head.setText(text)
        reasons = tuple(said(reason) for reason in (found.accuracy, found.why_no_atlas) if reason)
        self.note.setText(" · ".join((*error_words(found, term), *reasons)))
        self.note.setToolTip(self.note.text())

    def _paint_map(self, found: DatabaseResult, term: str) -> None:
        """Paint signed square roots: near and far differ by a thousand waves."""
        values, head = found.maps[term], f"{name(term)}, λ"
        top = max(1e-6, float(np.nanmax(np.abs(values))))
        scale = ColourScale(VALUE_MAP, -top, top, "λ", head, "sqrt", measure="waves", steady=True)
        self.map.show_map(values, scale, *places(found))
        self.map.grids = (grid_of(found, head, values),)

    def _paint_error(self, found: DatabaseResult, term: str, rule: str) -> None:
        """Paint decades of the error."""
        values, head = found.errors[rule][term], f"{tr(ERRORS[rule])}, {name(term)}, λ"
        top = max(1e-9, float(np.nanmax(values)))
        scale = ColourScale(ERROR_MAP, 0.0, top, "λ", f"{tr('error')}, λ", "log", measure="error", steady=True)
        self.error.show_map(values, scale, *places(found))
        self.error.grids = (grid_of(found, head, values),)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        for part in (self.map, self.error, self.atlas, *self.bars, self.body):
            part.restyle(theme)
        self._paint()


class DatabaseBody(QWidget):
    """Map, error map and atlas, as many of them as can be read, and the note where there is height for it.

    They stand side by side or one above the other; ``counted`` tells how many are shown. The least size does not depend
    on that, or they would come and go.
    """

    counted = Signal(int)

    def __init__(self, parts: tuple[QWidget, ...], note: QLabel):
        super().__init__()
        self._parts, self._note, self._scale = parts, note, 1.0
        self._row = TurningRow(parts, (5, 5, 6), self)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSizeConstraint(QVBoxLayout.SizeConstraint.SetNoConstraint)
        column.addWidget(self._row, 1)
        column.addWidget(note)

    def minimumSizeHint(self) -> QSize:
        """Return the least size."""
        return QSize(*(round(side * self._scale) for side in LEAST))

    def restyle(self, theme: Tokens) -> None:
        """Take the scale of a theme."""
        self._scale = theme.scale
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show what there is room for."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        wide, high = self.width() / self._scale, self.height() / self._scale
        self._note.setVisible(high >= NOTED)
        tall = high - (NOTE_HIGH if high >= NOTED else 0)
        room = tall / PART_HIGH if tall > wide else wide / PART_WIDE
        count = max(1, min(len(self._parts), int(room)))
        for number, part in enumerate(self._parts):
            part.setVisible(number < count)
        self.counted.emit(count)


def with_heading(head: QLabel, parts: tuple[QWidget, ...]) -> QWidget:
    """Return widgets beside one another under a heading."""
    head.setObjectName("muted")
    head.setWordWrap(True)
    body, row = QWidget(), QHBoxLayout()
    column = QVBoxLayout(body)
    for layout in (row, column):
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
    for k, part in enumerate(parts):
        row.addWidget(part, 0 if k else 1)
    column.addWidget(head)
    column.addLayout(row, 1)
    return body


def short(value: float, sign: str = "-") -> str:
    """Return a number as short as a colour bar needs it."""
    return f"{value:{sign}.3g}".replace("e+0", "e").replace("e-0", "e−").replace("-", "−")


def name(term: str) -> str:
    """Return a coefficient's symbol."""
    return "Wd" if term == "wd" else f"W{term[1:]}"


def atlas_head(atlas: Atlas | None) -> str:
    """Return the heading of the atlas."""
    if atlas is None:
        return tr("PSFs, √ of peak = 1")
    return tr("PSFs, {wide} µm wide, √ of peak = 1", wide=short(atlas.psfs.shape[-1] * atlas.pixel_um))


def error_words(found: DatabaseResult, term: str) -> tuple[str, ...]:
    """Return the largest error of every interpolation in words."""
    exact, table, linear = (f"{found.largest[rule][term]:.2g}" for rule in ("exact", *LOSSY))
    depths, fields, waves = NODES
    last = "linear {error} λ, on {depths} depths × {fields} fields × {waves} wavelengths"
    return (
        tr("largest error in {name}: exact {error} λ", name=name(term), error=exact),
        tr("table1 {error} λ", error=table),
        tr(last, error=linear, depths=depths, fields=fields, waves=waves),
    )


def grid_of(found: DatabaseResult, head: str, values: np.ndarray) -> Grid:
    """Return a map as it is copied: its head, 1/depth in 1/m, fields in degrees, and values."""
    return (
        f"{head}: {tr('field, °')} \\ {tr('1/depth, 1/m (0 is ∞)')}",
        PER_METRE * found.near,
        found.fields_deg,
        values,
    )


def places(found: DatabaseResult) -> tuple[Ends, tuple[np.ndarray, np.ndarray]]:
    """Return the map's ends and its nodes, 1/depth in 1/m and field in degrees."""
    near, fields = PER_METRE * found.near, found.fields_deg
    nodes = PER_METRE / found.nodes.depths_mm, degrees_from_slope(found.nodes.field_slopes)
    return ((float(near[0]), float(near[-1])), (float(fields[0]), float(fields[-1]))), nodes
