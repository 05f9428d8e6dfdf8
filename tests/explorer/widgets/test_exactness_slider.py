"""The slider from fast to exact: one scale of R² in several measures, or a time; shown where the hand is."""

import pytest
from PySide6.QtCore import Qt

from p2sf.studies.complete_trade import shipped_trades
from p2sf_explorer.compute.method_bounds import PredictedCost
from p2sf_explorer.widgets.exactness_slider import MEASURES, round_to_series
from p2sf_explorer.widgets.slider import STEPS
from tests.support.windows.events import choose

FOUND = (PredictedCost("seidel", 1.0, 0.2), PredictedCost("fitted", 5.0, 1e-3), PredictedCost("traced", 40.0, 5e-5))


@pytest.fixture
def panel(window, qtbot):
    window.store.update(method="auto", tolerance=0.99)
    window.top.tolerance.click()
    found = window.top.tolerance.panel
    take(found, "r2")
    qtbot.waitUntil(lambda: not found.worker.busy)
    yield found
    found.hide()


def take(panel, measure: str) -> None:
    choose(panel.measure, measure)


def test_the_handle_stands_where_the_state_is_and_the_button_says_it(window, panel):
    assert panel.isVisible() and "0.99" in window.top.tolerance.text()
    assert panel.one_less_r2() == pytest.approx(0.01)
    assert "R² ≥ 0.99" in panel.asked.text()


@pytest.mark.parametrize("measure", MEASURES)
def test_costs_and_what_is_on_screen_are_told_in_every_measure(panel, measure):
    take(panel, measure)
    assert "ms" in panel.costing.text() and "ms" in panel.given.text()
    assert "predicted" in panel.given.text()


def test_letting_go_takes_the_error_as_one_step_of_undo(window, panel, qtbot):
    before = window.store.state
    panel.slider.setSliderDown(True)
    panel.slider.setValue(STEPS)
    assert window.store.state == before, "nothing is computed while the handle moves"
    assert "R² ≥ 0.99999" in panel.asked.text()
    panel.slider.setSliderDown(False)
    assert window.store.state.optics.tolerance == pytest.approx(1 - 1e-5)
    assert window.live.method in ("traced", "huygens", "spherical", "fitted")
    window.store.undo()
    assert window.store.state == before


def test_the_keys_move_it_too(window, panel, qtbot):
    qtbot.keyClick(panel.slider, Qt.Key.Key_PageUp)
    assert window.store.state.optics.tolerance > 0.99


def test_a_measure_changes_the_words_and_not_the_error(window, panel):
    take(panel, "mtf")
    assert "10 %" in panel.asked.text()  # √0.01
    assert panel.one_less_r2() == pytest.approx(0.01)
    take(panel, "r80")
    assert "R80" in panel.asked.text() and "%" in panel.asked.text()
    assert window.store.state.optics.tolerance == 0.99


def test_a_time_takes_a_method(window, panel):
    panel._costs = FOUND
    take(panel, "time")
    panel.slider.setValue(0)
    assert "≤ 1 ms" in panel.asked.text() and "seidel" in panel.costing.text()
    panel.commit()
    assert window.store.state.optics.method == "seidel" and "seidel" in window.top.tolerance.toolTip()
    panel.slider.setValue(STEPS)
    assert "traced here: 40 ms" in panel.costing.text()
    panel.commit()
    assert window.store.state.optics.method == "traced"
    take(panel, "r2")
    panel.commit()
    assert window.store.state.optics.method == "auto"


def test_faint_light_takes_the_fastest_method_whose_rings_are_right(window, panel):
    """Nothing bounds them by R²: a method with the better R² may have the worse tails, and is not taken."""
    found = PredictedCost("seidel", 1.0, 0.2, 0.4), PredictedCost("fitted", 5.0, 1e-3, 0.04)
    panel._costs = (*found, PredictedCost("traced", 40.0, 5e-5, 0.0))
    take(panel, "hdr")
    panel.slider.setValue(0)
    assert "45 %" in panel.asked.text() and panel.choice().method == "seidel"  # √0.2
    panel.slider.setValue(STEPS // 3)
    assert panel.choice().method == "fitted" and "4.0 %" in panel.costing.text()
    panel.commit()
    assert window.store.state.optics.method == "fitted"
    panel.slider.setValue(STEPS)
    assert panel.choice().method == "traced"
    panel._costs = ()
    panel.commit()
    assert window.store.state.optics.method == "fitted", "nothing is taken that has not been measured"
    take(panel, "r2")
    panel.commit()


def test_the_complete_trade_of_the_lens_is_shown_and_serves_until_costs_are_known_here(window, panel):
    """Its figures are those of the shipped table; a lens that it does not have has none."""
    trade = shipped_trades()["double_gauss_28"]
    best = min((r for r in trade.rows if r.family == "fitted 26"), key=lambda row: row.relative_l2.median)
    dot = next(dot for dot in panel.chart.dots if dot.name == "fitted 26")
    assert (dot.cost, dot.error) == (best.single_us / 1e3, best.one_less_r2.median)
    assert panel.chart.asked == (None, pytest.approx(0.01))
    assert f"{best.one_less_r2.most:.1g}" in panel.typical.text()
    take(panel, "r80")
    dot = next(dot for dot in panel.chart.dots if dot.name == "fitted 26")
    assert (dot.error, dot.most) == (best.r80.median, best.r80.most) and panel.chart.asked == (None, None)
    take(panel, "r2")
    panel._costs = ()
    assert panel.choice().method == "fitted" and panel.choice().milliseconds == best.single_us / 1e3
    panel._curves = ()
    panel._tell()
    assert panel.choice() is None and panel.chart.isHidden() and panel.typical.isHidden()


@pytest.mark.parametrize(("value", "member"), [(0.0099, 0.01), (0.0034, 0.005), (3.0, 2.0), (900.0, 1000.0)])
def test_values_are_of_a_round_series(value, member):
    assert round_to_series(value) == pytest.approx(member)
