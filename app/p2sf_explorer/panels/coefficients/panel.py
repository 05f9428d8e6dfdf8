"""The six coefficients as numbers and bars, in waves, with sliders that change them."""

from functools import partial

from PySide6.QtWidgets import QMenu, QSizePolicy, QToolButton

from p2sf.errors import P2SFError
from p2sf.paraxial.wavefront import Coefficients
from p2sf_explorer.charts.painting import width_of
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.live import Live
from p2sf_explorer.i18n.messages import said
from p2sf_explorer.i18n.tr import local, tr
from p2sf_explorer.panels.coefficients.mixer import Mixer
from p2sf_explorer.state.scales import read_number
from p2sf_explorer.state.state import State, entry
from p2sf_explorer.state.terms import NAMES, TERMS
from p2sf_explorer.state.what_if import PRESETS, UNTOUCHED, Preset, alterations, of_preset, toggle, with_added
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import Card
from p2sf_explorer.widgets.typed import typed

TIP = "Wavefront coefficients: the peak value of each term of W(ρ, θ) at this field, in waves."
FREE_TIP = "Free pupil: only the six sliders make the wavefront, without the lens's own coefficients."
PRESETS_TIP = "Textbook wavefronts, in a free pupil"
SMALLEST = 250, 186  # pixels: names, numbers and buttons, some forty for the bars, and three buttons below
NOTE_PX = 12  # size of the card's readout
RESET_TIP = "Back to the lens's own coefficients: nothing added, muted or solo"


class CoefficientsPanel:
    """Six rows of bars and sliders; below, free pupil, presets and reset."""

    def __init__(self, store: Store):
        self._store, self._theme, self._note = store, LIGHT, ""
        self.widget = Card("Coefficients", TIP)
        self.bars = Mixer(self.widget)
        self.widget.smallest = SMALLEST
        self.widget.rescale(1.0)
        self.widget.set_body(self.bars)
        self.free = self._button("Free pupil", FREE_TIP)
        self.free.setCheckable(True)
        self.free.clicked.connect(lambda on: store.update(free_pupil=on))
        self.presets = self._button("Presets", PRESETS_TIP)
        self.presets.setMenu(self._preset_menu())
        self.presets.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.reset = self._button("Reset", RESET_TIP)
        self.reset.clicked.connect(lambda: store.update(**UNTOUCHED))
        self.widget.add_footer(self.free, self.presets, self.reset)
        self.widget.quiet.add(self.free, self.presets, self.reset)
        self.widget.readout.linkActivated.connect(self._take_back)
        self._connect()

    def _take_back(self) -> None:
        """Take back the latest change by hand; where something else has changed since, all of them."""
        before = self._store.previous
        if before and before.what_if != self._store.state.what_if:
            self._store.undo()
        else:
            self._store.update(**UNTOUCHED)

    def _connect(self) -> None:
        store, bars = self._store, self.bars
        bars.pressed.connect(store.begin)
        bars.released.connect(store.end)
        bars.added.connect(lambda term, waves: store.update(added_waves=with_added(store.state, term, waves)))
        bars.typed.connect(self._type)
        bars.toggled.connect(lambda kind, term: store.update(**{kind: toggle(entry(store.state, kind), term)}))

    def _type(self, term: str, text: str) -> None:
        """Set a coefficient to a typed number of waves, by adding the rest."""
        try:
            waves = read_number(typed(text), NAMES[term], {"": 1.0, "λ": 1.0})
        except P2SFError as error:
            self._store.refused.emit(error)
            return
        added = round(waves - self.bars.own[term], 6)
        self._store.update(added_waves=with_added(self._store.state, term, added))

    def _button(self, text: str, tip: str) -> QToolButton:
        button = QToolButton(self.widget)
        button.setObjectName("small")
        button.setText(tr(text))
        button.setToolTip(tr(tip))
        button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        button.setProperty("tight", True)  # three of them fit into a card that is narrow beside a lesson
        return button

    def _preset_menu(self) -> QMenu:
        menu = QMenu(self.widget)
        menu.setToolTipsVisible(True)
        for preset in PRESETS:
            action = menu.addAction(tr(preset.title))
            action.triggered.connect(partial(self._apply, preset))
            action.setToolTip(tr(preset.shows))
        return menu

    def _apply(self, preset: Preset, _checked: bool = False) -> None:
        self._store.update(**of_preset(preset))

    def show(self, live: Live) -> None:
        """Paint the coefficients."""
        state, altered = live.state, live.setup.altered
        values, own = as_numbers(live.setup.coefficients), as_numbers(live.setup.own)
        own = dict.fromkeys(TERMS, 0.0) if state.what_if.free_pupil else own
        if live.difference:
            values = own = dict(live.difference.coefficients)
        self.bars.show_values(
            values,
            own,
            dict(zip(TERMS, state.what_if.added_waves, strict=True)),
            muted=state.what_if.muted,
            solo=state.what_if.solo,
        )
        self.bars.setEnabled(live.side != "B")  # the sliders move A
        self.free.setChecked(state.what_if.free_pupil)
        self.reset.setEnabled(altered)
        self._note = self._alteration_text(state, live.side) if altered else ""
        self.widget.set_readout(self._colour_key())

    def _alteration_text(self, state: State, side: str) -> str:
        """Return what is altered, as much of it as there is room for beside the title, and the link that undoes it.

        On B's side there is no link, since undo moves A.
        """
        every = [local(said(message)) for message in alterations(state)]
        first = every[0] + (" …" if len(every) > 1 else "")
        before = self._store.previous
        undo = tr("Undo") if before and before.what_if != state.what_if else tr("Reset")
        room = self.widget.readout.width() - (0 if side == "B" else width_of(f" · {undo}", NOTE_PX))
        long = (tr("what-if: {alterations}", alterations=words) for words in (", ".join(every), first))
        words = next((text for text in long if width_of(text, NOTE_PX) <= room), first)
        if side == "B":
            return words
        return f'{words} · <a href="undo" style="color:{{accent}}">{undo}</a>'

    def _colour_key(self) -> str:
        note = self._note.format(accent=self._theme.accent)
        return note and f'<span style="color:{self._theme.warning}">{note}</span>'

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.bars.restyle(theme)
        if self._note:
            self.widget.set_readout(self._colour_key())


def as_numbers(coefficients: Coefficients) -> dict[str, float]:
    """Return the six coefficients by name, in waves."""
    return {name: float(getattr(coefficients, name)) for name in TERMS}
