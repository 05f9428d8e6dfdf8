"""The accuracy panel: a figure of an earlier picture is marked, in every language."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtWidgets import QApplication

from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.reference import MethodResult
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels.accuracy import AccuracyPanel, common_limit
from p2sf_explorer.state.state import State, new_state
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


def painted_rects(panel: AccuracyPanel) -> list[QRectF]:
    """Return where the labels' letters are painted, px of the scene, without the margin of a text document."""
    return [label.mapRectToScene(label.boundingRect()).adjusted(4, 5, -4, -5) for label in panel.labels]


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
    panel._show_methods((*near, MethodResult("huygens", 1.0, 0.0, 3000.0, 1, 1)), "fitted")
    QApplication.processEvents()
    panel.widget.grab()  # labels are placed where they are painted
    rects = painted_rects(panel)
    for k, rect in enumerate(rects):
        assert not any(rect.intersects(other) for other in rects[k + 1 :]), panel.labels[k].toPlainText()
    view = panel.methods.getPlotItem().getViewBox()
    dots = [view.mapViewToScene(QPointF(*place)) for place in panel._places]
    assert not any(rect.contains(dot) for rect in rects for dot in dots)
    assert all(view.sceneBoundingRect().adjusted(-6, -6, 6, 6).contains(rect) for rect in rects)
    assert all(abs(rect.center().y() - dot.y()) < 26 for rect, dot in zip(rects, dots, strict=True)), "beside its dot"
    panel.widget.hide()


@pytest.mark.parametrize(("largest", "limit"), [(0.05, 0.1), (0.011, 0.1), (0.009, 0.01), (0.0, 1e-6), (0.7, 1.0)])
def test_differences_share_few_scales(largest, limit):
    assert common_limit(np.array([[-largest, 0.0]])) == pytest.approx(limit)
