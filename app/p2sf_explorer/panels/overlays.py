"""Curves laid over each other: contrast of fields, colours and sensor positions; colour and light over the field."""

from math import inf

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel

from p2sf.conventions import UM_PER_MM
from p2sf_explorer.charts.theme import LIGHT, Tokens
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.matrix.overlays import (
    PLAIN,
    USUAL_PER_MM,
    CurveOverlay,
    OverlayRequest,
    answer,
    compared_fields,
)
from p2sf_explorer.i18n.messages import WINDOW, said
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.limits import MOST_FIELDS
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.card import SideCard, chooser
from p2sf_explorer.widgets.chart_card import NotedChart, curve_sign, reach
from p2sf_explorer.widgets.compared_lists import FieldList, FrequencyList
from p2sf_explorer.widgets.curves import ENDLESS
from p2sf_explorer.widgets.readout import Readout

TIP = (
    "Overlays: one curve for each field, wavelength or spatial frequency. Contrast is tangential (thick) and "
    "sagittal (fine). Type any fields, or choose how many; wavelengths are those of Matrix. A vertical line marks the "
    "present point."
)
OF = (
    ("fields", "MTF of all fields"),
    ("colours", "MTF of colours and spectrum"),
    ("field", "MTF over the field"),
    ("focus", "MTF through focus"),
    ("lateral", "lateral colour"),
    ("distortion", "distortion of colours"),
    ("illumination", "relative illumination"),
    ("transmission", "transmission over the field"),
    ("transmission_of_colours", "transmission of colours"),
)
FURTHER = "#cc79a7", "#a6761d", "#56b4e9", "#7570b3", "#009e73", "#e6ab02", "#e7298a", "#66a61e", "#999999"
HUES = ("text", "marginal", "chief", "third", *FURTHER)  # the first of what belongs to none
MOST = 2 * MOST_FIELDS
LEGEND_BESIDE = (3, 5), (2, 9)  # so many names on a line of the legend, if none has more letters
FROM_ZERO = {
    "contrast": 1.04,
    "relative illumination, %": 104.0,
    "transmission, %": 104.0,
}  # axes that begin there, and where they end
HINTS = {"contrast": "thick tangential, fine sagittal", "distortion, %": "thick exact rays, fine third order"}


class OverlaysPanel:
    """A chart of curves with a chooser, the frequencies where there are any, and a legend beside it."""

    def __init__(self, store: Store):
        self._store = store
        self.widget = SideCard("Overlays", TIP)
        self.of = chooser(OF, "Which curves are shown", self.widget)
        self.fields, self.frequencies = FieldList(store, self.widget), FrequencyList(store, self.widget)
        self.legend, self.note = QLabel(self.widget), Readout(self.widget)
        self.legend.setTextFormat(Qt.TextFormat.RichText)
        self.chart = NotedChart("frequency on the sensor, 1/mm", "contrast")
        self.zero = self.chart.add_curve("line")
        self.curves = [self.chart.add_curve("text") for _ in range(MOST)]
        self.widget.add_line(self.of)
        self.widget.add_line(self.fields)
        self.widget.add_line(self.frequencies)
        self.widget.add_line(self.legend)
        self.widget.add_line(self.note)
        self.widget.side.addStretch(1)
        self.widget.set_body(self.chart)
        self.late = LateAnswers(self.widget, answer, self._take, self._say)
        self.found: tuple[OverlayRequest | None, CurveOverlay] | None = None
        self._live: Live | None = None
        self._theme = LIGHT
        self.widget.bind(store, curves_of=self.of)

    def show(self, live: Live) -> None:
        """Paint curves that fit a frame, or have them made in the background."""
        self._live = live
        view: View[CurveOverlay | None] = live.views["curves"]
        self.frequencies.setVisible(live.state.curves.of in ("field", "focus"))
        self.frequencies.show_frequencies(live.state.curves.frequencies_per_mm or USUAL_PER_MM)
        self.fields.setVisible(live.state.curves.of in ("fields", "transmission_of_colours"))
        self.fields.show_fields(compared_fields(live.state))
        self.late.follow(view)
        if view.found:
            self._paint(None, view.found)
            self._say("")
        elif self.found and self.found[0] and self.found[0].of == live.state.curves.of:
            self._mark()

    def _take(self, request: OverlayRequest, found: CurveOverlay) -> str:
        if self._live and request.of == self._live.state.curves.of:
            self._paint(request, found)
        return " "

    def _say(self, text: str) -> None:
        self.note.set_text(text.strip(" ·"))

    def _paint(self, request: OverlayRequest | None, found: CurveOverlay) -> None:
        self.found = request, found
        for curve, line in zip(self.curves, found.lines, strict=False):
            curve.token, curve.width, curve.name = HUES[line.hue % len(HUES)], line.width, line.name.text(WINDOW)
            curve.set_data(found.x, line.values)
        for curve in self.curves[len(found.lines) :]:
            curve.set_data([], [])
        self.chart.name_axes(*found.axes)
        across = float(found.x[0]), float(found.x[-1])
        self.chart.set_range(across, up_range(found), steady="" if found.axes[1] in FROM_ZERO else "y")
        self.zero.set_data(ENDLESS, (0.0, 0.0))
        self._show_legend(found)
        self._mark()

    def _mark(self) -> None:
        """Mark the present field or sensor position, or the sensor's Nyquist frequency."""
        if self._live is None or self.found is None:
            return
        optics, bottom = self._live.state.optics, self.found[1].axes[0]
        place = {"field, °": abs(optics.field_deg), "sensor shift, µm": optics.sensor_shift_um}.get(bottom)
        if bottom == "wavelength, nm":
            place = optics.wavelength_nm
        if place is None:
            place = UM_PER_MM / (2 * self._live.state.display.pixel_um)
            text = " " + tr("Nyquist {f}", f=f"{place:.3g}")
            self.chart.show_notes(((place, inf, text, "text", -1),), ((place, "muted"),))
        else:
            self.chart.show_notes((), ((place, "muted"),))

    def _show_legend(self, found: CurveOverlay) -> None:
        hues = {line.hue for line in found.lines}
        names = list(found.names)
        order = [*range(1, len(names) + 1)] if PLAIN not in hues else [*range(1, len(names)), PLAIN]
        tokens = [HUES[hue % len(HUES)] for hue in order]
        marks = [curve_sign(token, self._theme) for token in tokens]
        signs = [f"{mark} {name.text(WINDOW)}" for mark, name in zip(marks, names, strict=True)]
        longest = max((len(name.text(WINDOW)) for name in names), default=0)
        beside = next((count for count, letters in LEGEND_BESIDE if longest <= letters), 1)
        lines = [" &nbsp; ".join(signs[k : k + beside]) for k in range(0, len(signs), beside)]
        if hint := HINTS.get(found.axes[1]):
            lines.append(tr(hint))
        if found.missing:
            lines.append(said(found.missing))
        self.legend.setWordWrap(bool(found.missing))
        text = "<br>".join(lines)
        if text != self.legend.text():
            self.legend.setText(text)

    def restyle(self, theme: Tokens) -> None:
        """Take the colours of a theme."""
        self._theme = theme
        self.chart.restyle(theme)
        self.note.restyle(theme)
        if self.found:
            self._show_legend(self.found[1])


def up_range(found: CurveOverlay) -> tuple[float, float]:
    """Return the range of the left axis: contrast and light from 0, else around all curves."""
    if found.axes[1] in FROM_ZERO:
        return 0.0, FROM_ZERO[found.axes[1]]
    exact = [line.values for line in found.lines if np.isfinite(line.values).any()]
    return reach(*exact, least=1e-3) if exact else (-1.0, 1.0)
