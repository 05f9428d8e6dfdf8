"""Sliders of what may be off in a built lens: decentres and tilts of its pieces, radii, thicknesses, indices."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QGridLayout, QPushButton, QScrollArea, QWidget

from p2sf.lens.lens import Lens
from p2sf.tolerance.errors_of_build import IRREGULAR, Kind
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.views.lens_table import Misalignment, fringes, misalignment_of, of_piece
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels.lens_table.sliders import LensSlider
from p2sf_explorer.state.build_errors import BuildErrors, amount_of, with_error, without_piece
from p2sf_explorer.state.built import Adjustment, Piece
from p2sf_explorer.state.pinning import with_links
from p2sf_explorer.state.scales import Linear, significant, with_sign
from p2sf_explorer.state.state import State, change
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card, Chooser

TIP = (
    "Misalign: what may be wrong with a built lens, in addition to what its file has. The sensor stays where it is. "
    "Choose a piece here, or click it in the layout or the lens table. Decentres are in mm; tilts in degrees, about "
    "the piece's first vertex, right-handed. A double-click resets a value."
)
PIECE_TIP = "The piece that the sliders move: an element, a group, the whole lens or the sensor"
FIELD_X_TIP = "Show a slider for the field along x even if the lens is symmetric"
RESET_TIP = "Reset this error"
WORDS: dict[Kind, str] = {
    "decentre_x": "Decentre x",
    "decentre_y": "Decentre y",
    "tilt_x": "Tilt about x",
    "tilt_y": "Tilt about y",
    "radius": "Radius {surface}",
    "thickness": "Thickness {surface}",
    "index": "Index behind {surface}",
    "irregularity": "Irregularity {surface}",
    "irregularity_45": "Irregularity {surface}, 45°",
}
TIPS: dict[Kind, str] = {
    "decentre_x": "Decentre x: the piece is moved sideways, out of the layout's plane.",
    "decentre_y": "Decentre y: the piece is moved up.",
    "tilt_x": "Tilt about x: right-handed; a positive one turns y towards z, the piece's top away from the object.",
    "tilt_y": "Tilt about y: right-handed; a positive one turns z towards x.",
    "radius": "Radius: its error in percent; fringes (fr.) are those of a test plate of the right radius.",
    "thickness": "Thickness: its error behind this surface; what follows moves with it.",
    "index": "Index: the error of the glass behind this surface, the same at every wavelength.",
    "irregularity": (
        "Irregularity: a cylinder ground into this surface, in fringes (fr.) of 273 nm from the highest to the lowest "
        "points of its clear rim. A positive one raises it towards +z along y."
    ),
    "irregularity_45": (
        "Irregularity at 45°: the same, raised where x and y are of one sign. Both together are a cylinder in any "
        "direction."
    ),
}
UNITS: dict[Kind, str] = {
    "decentre_x": " mm",
    "decentre_y": " mm",
    "tilt_x": "°",
    "tilt_y": "°",
    "radius": " %",
    "thickness": " mm",
}
DIGITS: dict[Kind, int] = {"index": 5}
GRAIN = 500  # of the reach: the step to which a slider rounds
WIDE_PX = 760  # at scale 1: from this width on there are two columns of sliders
COLUMNS = 2


def _unit(kind: Kind) -> str:
    return f" {tr('fr.')}" if kind in IRREGULAR else UNITS.get(kind, "")


class ErrorRow(QWidget):
    """One number that may be off: its slider, and a button that sets it right."""

    def __init__(self, kind: Kind, store: Store, parent: QWidget):
        super().__init__(parent)  # without one it would be a window for a moment, and take the focus
        self.kind, self.adjustment, self._store = kind, Adjustment(kind, (1, 1), 1.0), store
        self.slider = LensSlider(WORDS[kind], TIPS[kind], _unit(kind), store, self._with, DIGITS.get(kind, 3))
        self.back = QPushButton("↺", self)
        self.back.setObjectName("small")
        self.back.setToolTip(tr(RESET_TIP))
        self.back.setAccessibleName(tr(RESET_TIP))
        kept = self.back.sizePolicy()
        kept.setRetainSizeWhenHidden(True)  # so that all sliders are of one length
        self.back.setSizePolicy(kept)
        row = QGridLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.slider, 0, 0)
        row.addWidget(self.back, 0, 1)
        for asked in (self.back.clicked, self.slider.slider.reset, self.slider.number.reset):
            asked.connect(self.reset)

    def reset(self) -> None:
        """Set the number right again."""
        self._store.update(errors=self._errors(self._store.state, 0.0))

    def _errors(self, state: State, amount: float) -> BuildErrors:
        return with_error(state.optics.errors, self.kind, self.adjustment.span, amount)

    def _with(self, state: State, amount: float) -> State:
        grain = self.adjustment.reach / GRAIN
        held = round(round(amount / grain) * grain, 9) if self._store.moving else amount
        return change(state, **with_links(state, {"errors": self._errors(state, held)}))

    def show_adjustment(self, one: Adjustment, amount: float, lens: Lens) -> None:
        """Follow the lens."""
        self.adjustment = one
        words = tr(WORDS[self.kind], surface=one.span[0])
        shown = fringes(lens, one.span[0], amount) if self.kind == "radius" and amount else None
        if shown is not None:
            words += tr(" ({count} fr.)", count=significant(shown, 3))
        if self.slider.label.text() != words:
            self.slider.label.setText(words)
            self.slider.slider.setAccessibleName(words)
            self.slider.number.setAccessibleName(words)
        reach = max(one.reach, abs(amount))
        self.slider.show_value(amount, Linear(-reach, reach))
        self.back.setVisible(bool(amount))

    def set_label_width(self, width: int) -> None:
        """Give the name so many pixels, so that the sliders stand in line."""
        self.slider.label.setFixedWidth(width)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self.slider.restyle(theme)


class MisalignPanel:
    """A chooser of pieces, and under it the sliders of the piece that is selected."""

    def __init__(self, store: Store):
        self._store, self._theme = store, LIGHT
        self.widget = Card("Misalign", TIP)
        self.piece = Chooser(self.widget)
        self.piece.setObjectName("small")
        self.piece.setToolTip(tr(PIECE_TIP))
        self.piece.setAccessibleName(tr(PIECE_TIP))
        self.piece.activated.connect(lambda: store.select(self.piece.currentData()))
        self.reset_piece = self._button("Reset piece", "Reset all errors of this piece", self._reset_piece)
        self.reset_all = self._button("Reset all", "Reset all errors of the lens", self._reset_all)
        self.field_x = QCheckBox(tr("Field along x"), self.widget)
        self.field_x.setToolTip(tr(FIELD_X_TIP))
        self.field_x.clicked.connect(lambda on: store.update(show_field_x=bool(on)))
        for tool in (self.piece, self.reset_piece, self.reset_all):
            self.widget.add_tool(tool)
        self.rows: dict[Kind, list[ErrorRow]] = {kind: [] for kind in WORDS}
        self._page, self._area = QWidget(), QScrollArea(self.widget)
        self._grid = QGridLayout(self._page)
        self._lay_out()
        self._shown: Misalignment | None = None
        self._placed: tuple[tuple[tuple[str, int, int], ...], int] = ((), 0)
        self._pieces: tuple[Piece, ...] = ()
        store.selected.connect(self._on_selected)

    def _lay_out(self) -> None:
        area = self._area
        area.setAccessibleName(tr("Misalign"))
        area.setWidgetResizable(True)
        area.setFrameShape(QScrollArea.Shape.NoFrame)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        area.setWidget(self._page)
        for part in (area, area.viewport(), self._page):
            part.setAutoFillBackground(False)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setAlignment(Qt.AlignmentFlag.AlignTop)
        self._grid.setColumnStretch(0, 1)
        self.widget.set_body(area)
        self.widget.add_footer(self.field_x)

    def _button(self, text: str, tip: str, do: object) -> QPushButton:
        button = QPushButton(tr(text), self.widget)
        button.setObjectName("small")
        button.setToolTip(tr(tip))
        button.clicked.connect(do)
        return button

    def _reset_piece(self) -> None:
        if self._shown:
            self._store.update(
                errors=without_piece(self._store.state.optics.errors, self._selected_piece(self._shown).span)
            )

    def _reset_all(self) -> None:
        self._store.update(errors=())

    def _on_selected(self, _: object) -> None:
        if self._shown:
            self._show(self._shown)

    def _selected_piece(self, shown: Misalignment) -> Piece:
        """Return the piece that is selected; of another selection the piece that it lies in, else the first."""
        found = self._store.selection or self.piece.currentData() or (0, 0)
        known = [piece for piece in shown.pieces if piece.span == tuple(found)]
        around = [p for p in shown.pieces if p.span[0] <= found[0] and found[1] <= p.span[1]]
        return (*known, *around, *shown.pieces)[0]

    def show(self, live: Live) -> None:
        """Follow the lens and its errors."""
        self._show(live.views["misalign"].found)

    def follow(self, state: State) -> None:
        """Follow a state that has no picture, so that what is wrong can be set right."""
        self._show(misalignment_of(state))

    def _show(self, shown: Misalignment) -> None:
        self._shown = shown
        if shown.pieces != self._pieces:
            self._pieces = shown.pieces
            self.piece.clear()
            for each in shown.pieces:
                self.piece.addItem(said(each.name), each.span)
        piece = self._selected_piece(shown)
        self.piece.setCurrentIndex(shown.pieces.index(piece))
        wanted = of_piece(shown.lens, piece)
        self._place(wanted)
        taken = dict.fromkeys(WORDS, 0)
        for one in wanted:
            row = self.rows[one.kind][taken[one.kind]]
            taken[one.kind] += 1
            row.show_adjustment(one, amount_of(shown.errors, one.kind, one.span), shown.lens)
        if self.field_x.isChecked() != shown.show_field_x:
            self.field_x.setChecked(shown.show_field_x)
        self.reset_all.setEnabled(bool(shown.errors))
        self.reset_piece.setEnabled(without_piece(shown.errors, piece.span) != shown.errors)
        self.widget.set_readout(self._summary(shown))

    def _summary(self, shown: Misalignment) -> str:
        """Return how much is off, and whether the file itself has tilts."""
        count = len(shown.errors)
        words = tr("nothing is off") if not count else tr("{count} numbers are off", count=count)
        if count == 1:
            kind, first, _, amount = shown.errors[0]
            value = f"{with_sign(amount, DIGITS.get(kind, 3))}{_unit(kind)}"
            words = f"{tr(WORDS[kind], surface=first)} {value}"
        return f"{words} · {tr('on top of the tilts of its file')}" if shown.file_tilted else words

    def _place(self, wanted: tuple[Adjustment, ...]) -> None:
        """Put the rows of these numbers into the grid, in two columns where there is room."""
        columns = COLUMNS if self._area.width() >= self._theme.px(WIDE_PX) else 1
        asked = tuple(one.key for one in wanted), columns
        if asked == self._placed:
            return
        self._placed, taken, placed = asked, dict.fromkeys(WORDS, 0), []
        for one in wanted:
            kind = self.rows[one.kind]
            if taken[one.kind] == len(kind):
                kind.append(ErrorRow(one.kind, self._store, self._page))
                kind[-1].restyle(self._theme)
            placed.append(kind[taken[one.kind]])
            taken[one.kind] += 1
        for rows in self.rows.values():
            for row in rows:
                self._grid.removeWidget(row)
                row.setVisible(row in placed)
        high = -(-len(placed) // columns)
        self._grid.setColumnStretch(1, int(columns > 1))
        for number, row in enumerate(placed):
            row.set_label_width(self._theme.px(LABEL_PX))
            self._grid.addWidget(row, number % high, number // high)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme, self._placed = theme, ((), 0)
        for rows in self.rows.values():
            for row in rows:
                row.restyle(theme)
        if self._shown:
            self._show(self._shown)


LABEL_PX = 118  # of a name, at scale 1
