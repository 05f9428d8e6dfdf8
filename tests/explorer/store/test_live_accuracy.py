"""The background measure: R² against the Huygens sum arrives by itself, and every method's is in order."""

from time import sleep
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QObject, QSizeF

from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.reference import Accuracy, measure
from p2sf_explorer.lessons.measures import MEASURES
from p2sf_explorer.panels.accuracy import anchors
from p2sf_explorer.state.scales import written_r_squared
from p2sf_explorer.state.state import change, new_state
from p2sf_explorer.store import live_accuracy
from p2sf_explorer.store.live_accuracy import REST_MS, LiveAccuracy, fits
from p2sf_explorer.window.window import MainWindow
from tests.support.windows.windows import at_rest


@pytest.fixture
def measured(qapp, qtbot):
    made = MainWindow(new_state(method="seidel", theme="light", field_deg=0.0, f_number=8.0, tab="accuracy"))
    made.show()
    yield made
    made.close()


def test_the_badge_and_every_method_arrive_by_themselves(measured, qtbot):
    badge = measured.panels["psf"].badge
    at_rest(measured, qtbot)
    assert "vs Huygens" in badge.text()
    known = measured.measuring._last
    results = {method.method: method for method in known.results}
    assert set(results) == {"gaussian", "seidel", "fitted", "traced", "huygens", "spherical"}
    assert results["fitted"].r_squared >= 0.998  # the method's promise on every row
    assert results["traced"].r_squared >= 0.9999
    assert known.r_squared == pytest.approx(results["seidel"].r_squared, abs=1e-4)  # settled against its own repeat
    assert "vs Huygens" in measured.panels["accuracy"].message.text()


def test_the_panel_in_a_window_of_its_own_is_told_whatever_tab_is_in_front(measured, qtbot):
    measured.store.update(tab="mtf", windows=("accuracy",), field_deg=1.0)
    message = measured.panels["accuracy"].message
    at_rest(measured, qtbot)
    assert "vs Huygens" in message.text() and "earlier" not in message.text()
    assert measured.measuring._last.live.state.optics.field_deg == 1.0 and measured.measuring._last.results


def test_a_method_has_one_r_squared_at_a_point_whatever_is_shown():
    """The six coefficients ask for a wider window than the rays do; measured there they would have another figure."""
    found = {}
    for method in ("seidel", "fitted"):
        shown = live(new_state(method=method, field_deg=10.0, wavelength_nm=656.3, f_number=4.0))
        accuracy = measure(shown, True, lambda: False, lambda part: None)
        results = {method.method: method.r_squared for method in accuracy.results}
        assert accuracy.r_squared == pytest.approx(results[method], abs=1e-12)
        found[method] = shown.psf.pixel_um, results
    assert found["seidel"][0] != found["fitted"][0], "the state no longer tells one window from two"
    assert found["seidel"][1] == pytest.approx(found["fitted"][1], abs=1e-12)


def test_no_figure_of_an_earlier_picture_stands_beside_the_next(measured, qtbot):
    badge, message = measured.panels["psf"].badge, measured.panels["accuracy"].message
    at_rest(measured, qtbot)
    assert "vs Huygens" in badge.text() and "vs Huygens" in message.text()
    with measured.store.drag():
        measured.store.update(field_deg=3.0)
        assert "vs Huygens" not in badge.text() and "R²" not in message.text()
        assert not measured.panels["accuracy"].methods.labelled
    known, live = measured.measuring._last, measured.live
    measured.measuring._on_finished(None, known)  # comes late
    assert known.live.state != live.state and "vs Huygens" not in badge.text() and "R²" not in message.text()


def test_a_resized_panel_keeps_the_measured_figure(measured, qtbot):
    panel = measured.panels["psf"]
    at_rest(measured, qtbot)
    assert "vs Huygens" in panel.badge.text()
    panel._settled.timeout.emit()
    assert "vs Huygens" in panel.badge.text()


def test_a_lesson_claims_what_the_panel_says(measured, qtbot):
    badge = measured.panels["psf"].badge
    at_rest(measured, qtbot)
    assert "vs Huygens" in badge.text()
    said = written_r_squared(MEASURES["r_squared"](measured.store.state))
    assert f"R² {said} " in measured.panels["accuracy"].message.text()


@pytest.mark.parametrize(
    ("changes", "wide"),
    [({"clip": True}, 0.0), ({}, 200.0), ({"method": "fitted"}, 0.0), ({"field_deg": 3.0}, 0.0)],
    ids=["clip", "window", "method", "field"],
)
def test_a_figure_answers_for_its_own_picture_only(changes, wide):
    """R² compares two pictures: other rays cut, another window or method or point, and it is another number."""
    state = new_state(method="seidel", field_deg=2.0, f_number=8.0)
    shown = live(state)
    known = Accuracy(shown, shown.psf, shown.psf, 0.9)
    assert fits(known, live(change(state, psf_scale="log", tab="mtf")), False), "looks change nothing"
    assert not fits(known, live(change(state, **changes), least=(0, wide)), False)


def test_the_names_of_the_methods_stay_inside_and_take_different_sides(qapp):
    """Two dots at one height, the second where the first one's name would reach: the names part company."""
    labels = [QSizeF(90, 14), QSizeF(100, 14), QSizeF(60, 14)]
    first, second, last = anchors(labels, [(20, 20), (90, 20), (310, 80)], (330, 95))
    assert first[0] <= 0 and (second[0] <= 0 or second[1] != first[1])
    assert last[0] > 1  # hangs to the left of its dot: at the right it would run out


def answer_of(lens, quality="settled", tab="accuracy"):
    """Return as much of an answer as its accuracy asks for, told apart by the name of its lens."""
    psf = SimpleNamespace(method="seidel", numbers=6, values=np.zeros((2, 2)), pixel_um=1.0)
    setup = SimpleNamespace(lens=lens, source="source", altered=False)
    return SimpleNamespace(setup=setup, psf=psf, state=new_state(tab=tab), quality=quality, pending=None)


@pytest.fixture
def watched(qapp, qtbot, monkeypatch):
    """Return a measuring that takes no time, the lenses that it has measured, and the figures shown."""
    lenses, shown = [], []

    def measured(question, stopped, tell):
        lenses.append(question.live.setup.lens)
        reference = SimpleNamespace(method="huygens")
        return SimpleNamespace(live=question.live, results=(1,), r_squared=0.9, reference=reference)

    monkeypatch.setattr(live_accuracy, "_measured", measured)
    panel = SimpleNamespace(show_accuracy=lambda found, stale: shown.append((found.live.setup.lens, stale)))
    root = QObject()
    made = LiveAccuracy(lambda *_: None, lambda: panel, root)
    yield made, lenses, shown
    made.late.stop()


def test_a_picture_that_was_left_again_is_not_measured(watched, qtbot):
    """The figure of the present picture is known: that of the one between would stand in its place."""
    measuring, lenses, shown = watched
    measuring.watch(answer_of("a"))
    qtbot.waitUntil(lambda: shown == [("a", False)])
    measuring.watch(answer_of("b"))
    measuring.watch(answer_of("a"))
    qtbot.wait(2 * REST_MS)
    assert lenses == ["a"] and shown == [("a", False)] * 2


def test_a_figure_that_comes_when_its_picture_was_left_takes_no_known_ones_place(watched, qtbot):
    measuring, lenses, shown = watched
    measuring.watch(answer_of("a"))
    qtbot.waitUntil(lambda: shown == [("a", False)])
    measuring.film(True)
    measuring.watch(answer_of("b"))
    while len(lenses) < 2:
        sleep(0.001)  # in which no event is handled: what is found stays in the queue
    measuring.watch(answer_of("a"))
    qtbot.waitUntil(lambda: not measuring.late.busy)
    assert lenses == ["a", "b"] and shown == [("a", False)] * 2


@pytest.mark.parametrize("then", ["film", "no answer", "drag"])
def test_a_picture_that_does_not_stand_is_not_measured(watched, qtbot, then):
    measuring, lenses, _ = watched
    measuring.watch(answer_of("a", tab="mtf"))
    if then == "film":
        measuring.film(True)
    else:
        measuring.watch(None if then == "no answer" else answer_of("b", "preview"))
    assert not measuring.late.busy
    qtbot.wait(2 * REST_MS)
    assert lenses == []


@pytest.mark.parametrize(("tab", "lenses"), [("accuracy", ["a"]), ("mtf", [])], ids=["on show", "not on show"])
def test_a_film_measures_at_once_what_it_shows_and_nothing_else(watched, qtbot, tab, lenses):
    measuring, measured, _ = watched
    measuring.film(True)
    measuring.watch(answer_of("a", tab=tab))
    assert not measuring.late._held.isActive() and measuring.late.busy == bool(lenses)
    qtbot.waitUntil(lambda: not measuring.late.busy)
    assert measured == lenses
    measuring.film(False)
    measuring.watch(answer_of("b", tab=tab))
    assert measuring.late._held.isActive()
