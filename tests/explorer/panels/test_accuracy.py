"""The accuracy panel: a figure of an earlier picture is marked, in every language."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QPointF
from PySide6.QtWidgets import QApplication

from p2sf.studies.complete_trade import shipped_trades
from p2sf_explorer.charts.theme import LIGHT
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.reference import MethodResult
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels.accuracy import AccuracyPanel, common_limit
from p2sf_explorer.state.state import State, change, new_state
from p2sf_explorer.store.store import Store


@pytest.mark.parametrize("language", ["en", "de"])
def test_a_figure_is_marked_once_as_of_an_earlier_picture(qapp, language):
    set_language(language)
    try:
        panel, answer = AccuracyPanel(Store(State())), live(new_state(method="seidel"))
        panel.show(answer)
        assert tr("earlier picture") not in panel.message.text(), "there is no figure yet"
        panel._figure = "R² 0.99"
        panel.show(answer)
        panel.show(answer)
        assert panel.message.text() == tr("earlier picture"), "its R² is not that of the picture beside it"
    finally:
        set_language("en")


@pytest.mark.parametrize("size", [(820, 200), (960, 230), (1800, 700)])
@pytest.mark.parametrize("close", [0.0, 0.15, 0.6])
def test_labels_of_methods_cover_neither_each_other_nor_a_dot(qapp, size, close):
    """Methods whose dots are ``close`` decades apart, and the reference in its corner; looked at where Qt puts them."""
    panel = AccuracyPanel(Store(State()))
    panel.body.setVisible(True)
    panel.empty.setVisible(False)
    panel.widget.resize(*size)
    panel.widget.show()
    QApplication.processEvents()
    names = ("seidel", "fitted", "traced", "gaussian")
    near = tuple(
        MethodResult(n, 0.9, 10.0 ** (-1 - 2 * k), 10.0 ** (1 + close * k), 32, 64) for k, n in enumerate(names)
    )
    chart = panel.methods
    chart.show_methods((*near, MethodResult("huygens", 1.0, 0.0, 3000.0, 1, 1)), "fitted")
    QApplication.processEvents()
    panel.widget.grab()  # labels are placed where they are painted
    rects = [rect.adjusted(0, 2, 0, -2) for rect in chart.rects]  # letters leave air above and below
    for k, rect in enumerate(rects):
        assert not any(rect.intersects(other) for other in rects[k + 1 :]), chart.results[k].method
    dots = [QPointF(*chart.to_pixels(*place)) for place in chart.places]
    assert not any(rect.contains(dot) for rect in rects for dot in dots)
    assert all(chart.area.adjusted(-6, -6, 6, 6).contains(rect) for rect in rects)
    assert all(abs(rect.center().y() - dot.y()) < 26 for rect, dot in zip(rects, dots, strict=True)), "beside its dot"
    panel.widget.hide()


@pytest.mark.parametrize(("largest", "limit"), [(5.0, 10.0), (1.1, 10.0), (0.9, 1.0), (0.0, 1e-4), (70.0, 100.0)])
def test_differences_share_few_scales(largest, limit):
    assert common_limit(np.array([[-largest, 0.0]])) == pytest.approx(limit)


def test_the_complete_trade_of_a_shipped_lens_takes_the_plot_s_place(qapp):
    """Every dot is a row of the shipped table, the front is lower the dearer it is, and a changed lens has none."""
    panel, answer = AccuracyPanel(Store(State())), live(new_state(method="seidel", lens="tessar"))
    panel.restyle(LIGHT)
    trade = shipped_trades()["tessar"]
    for cost, of in (("bytes", "nbytes"), ("time", "batch_us")):
        panel.show(replace(answer, state=change(answer.state, accuracy_plot=cost)))
        assert [dot.cost for dot in panel.trade.dots] == [getattr(row, of) for row in trade.rows]
        line = panel.trade.front
        assert all(a.cost < b.cost and a.error > b.error for a, b in pairwise(line))
        assert not panel.trade.isHidden() and panel.methods.isHidden() and "PCA" in panel.widget.readout.text()
    dot = panel.trade.dots[0]
    found = panel.trade.read(*panel.trade.place(dot))
    assert dot.settings in found.head and len(panel.trade.rows_of_data()) == len(trade.rows) + 1
    panel.show(answer)
    assert panel.trade.isHidden() and not panel.methods.isHidden()
