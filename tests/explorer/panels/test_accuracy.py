"""The accuracy panel: a figure of an earlier picture is marked, in every language."""

import pytest

from p2sf_explorer.compute.live import live
from p2sf_explorer.i18n.language import set_language
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels.accuracy import AccuracyPanel
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
