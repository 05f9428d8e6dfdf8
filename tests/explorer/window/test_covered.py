"""A panel that a sentence covers: it wants nothing more of what it has asked, and asks again once it is uncovered."""

from dataclasses import replace

import pytest

from p2sf.messages import Message
from p2sf_explorer.compute.live import View, live
from p2sf_explorer.panels import build, end_work
from p2sf_explorer.state.panels import PANELS, view_of
from p2sf_explorer.state.state import new_state
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.store.store import Store
from p2sf_explorer.window.window import paint


@pytest.mark.parametrize("key", ["through_focus", "image", "tolerances"])
def test_a_covered_panel_drops_its_late_work_and_begins_it_anew(qapp, qtbot, key):
    store = Store(new_state(theme="light"))
    panel = build(PANELS[key], store)
    late = panel.widget.findChildren(LateAnswers)
    shown = live(store.state, "settled", {key: view_of(PANELS[key])})
    covered = replace(shown, views={key: View(None, why=Message("nothing to show"))})
    paint(panel, key, shown)
    assert any(answers.busy for answers in late)
    running = [answers._cancelled for answers in late if answers._cancelled]
    paint(panel, key, covered)
    assert all(stopped.is_set() for stopped in running) and all(answers.asked is None for answers in late)
    qtbot.waitUntil(lambda: not any(answers.busy for answers in late))
    paint(panel, key, shown)
    assert any(answers.busy for answers in late), "uncovered, it asks once more"
    end_work(panel)
