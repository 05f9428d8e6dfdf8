"""The panel of overlaid curves in the window."""

import numpy as np
import pytest
from PySide6.QtCore import Qt

from p2sf_explorer.compute.matrix.overlays import coarse_first
from p2sf_explorer.state.limits import CHOICES
from p2sf_explorer.state.link import link, state_of_link
from p2sf_explorer.state.state import new_state
from tests.support.windows.events import choose
from tests.support.windows.windows import settled


@pytest.fixture
def panel(window, qtbot):
    """Return the panel once its first curves are there."""
    window.store.update(tab="curves", f_number=8.0)
    made = window.panels["curves"]
    settled(made, qtbot)
    return made


@pytest.mark.parametrize("of", CHOICES["curves_of"])
def test_every_kind_has_its_curves_and_a_legend(window, panel, qtbot, of):
    choose(panel.of, of)
    settled(panel, qtbot)
    found = panel.found[1]
    assert window.store.state.curves.of == of and panel.chart.labels == found.axes
    drawn = [curve for curve in panel.curves if curve.x.size]
    assert [curve.name for curve in drawn] == [str(line.name) for line in found.lines]
    assert all(str(name) in panel.legend.text() for name in found.names)
    assert panel.frequencies.isVisibleTo(panel.widget) == (of in ("field", "focus"))
    colours = {curve.token for curve in drawn if curve.width > 1}
    assert len(colours) >= min(3, len(found.names)) - (of == "illumination")


def test_frequencies_are_typed(window, panel, qtbot):
    window.store.update(curves_of="field")
    panel.frequencies.edit.setFocus()
    panel.frequencies.edit.selectAll()
    qtbot.keyClicks(panel.frequencies.edit, "5; 12,5/mm")
    qtbot.keyClick(panel.frequencies.edit, Qt.Key.Key_Return)
    settled(panel, qtbot)
    assert window.store.state.curves.frequencies_per_mm == (5.0, 12.5)
    assert [str(name) for name in panel.found[1].names] == ["5/mm", "12.5/mm"]


def test_the_present_place_is_marked(window, panel, qtbot):
    window.store.update(curves_of="lateral", field_deg=7.0)
    assert panel.chart.uprights == ((7.0, "muted"),)
    window.store.update(field_deg=3.0)
    assert panel.chart.uprights == ((3.0, "muted"),)


def test_a_value_read_is_the_curves_own(window, panel):
    window.store.update(curves_of="distortion")
    found = panel.found[1]
    reading = panel.chart.read(float(found.x[10]), 0.0)
    exact = {str(line.name): line.values[10] for line in found.lines}
    assert {value.name: value.number for value in reading.values} == pytest.approx(exact)


def test_it_is_part_of_the_state(window):
    state = new_state(curves_of="focus", curves_frequencies_per_mm=(25.0,))
    assert state_of_link(link(state)) == state
    window.store.update(curves_of="field", curves_frequencies_per_mm=(), tab="curves")
    assert window.panels["curves"].frequencies.edit.text() == "10; 20; 40/mm"
    before = window.store.state
    window.store.update(curves_frequencies_per_mm=(-1.0,))
    window.store.update(curves_of="psf")
    assert window.banner.isVisible() and window.store.state == before


def test_while_a_slider_moves_slow_curves_wait_until_it_is_held(window, panel, qtbot):
    window.store.update(curves_of="focus")
    settled(panel, qtbot)
    with window.store.drag():
        for f_number in (5.6, 6.0):
            window.store.update(f_number=f_number)
            assert panel.late.asked != window.live.views["curves"].question, "frames come first"
        qtbot.waitUntil(lambda: panel.late.asked == window.live.views["curves"].question)


@pytest.mark.parametrize("count", [1, 2, 15, 61])
def test_curves_over_places_are_known_coarsely_first(count):
    order = coarse_first(count)
    assert sorted(order) == list(range(count))
    first = sorted(order[: count // 4 + 1])
    assert first[0] == 0 and first[-1] >= count - 4 and np.diff(first).max(initial=0) <= 4
