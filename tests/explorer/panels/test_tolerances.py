"""The Tolerances panel: what hurts, the yield, own values, and builds beside the lens as designed."""

from dataclasses import replace
from threading import Event

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication, QWidget

from p2sf.errors import Cancelled, P2SFError
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pupil.zernike_fit import zernike_fit
from p2sf.tolerance.errors_of_build import Tolerance, usual_tolerances
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.compute.views import tolerances as analysis
from p2sf_explorer.panels import end_work
from p2sf_explorer.panels.tolerances.arrangement import TolerancesBody
from p2sf_explorer.panels.tolerances.panel import TolerancesPanel
from p2sf_explorer.panels.tolerances.tables import LOST, ErrorTable
from p2sf_explorer.state.scales import significant
from p2sf_explorer.state.state import ToleranceView, change, new_state
from p2sf_explorer.widgets.copying import data_of
from tests.explorer.conftest import FEW_BUILDS
from tests.support.tolerances import exact_quality

LENS = "achromat_f6"


@pytest.fixture
def panel(window, qtbot):
    window.store.update(lens=LENS, lens_text=None, field_deg=0.0, tab="tolerances")
    made = window.panels["tolerances"]
    qtbot.waitUntil(lambda: not made._stale())
    yield made
    window.store.update(tab="profiles")


def wait(panel, qtbot):
    qtbot.waitUntil(lambda: not panel._stale() and not panel.late.busy)


def test_no_limit_is_shown_before_there_are_builds(window, monkeypatch):
    monkeypatch.setattr(analysis.Analyst, "answer", lambda *_: (_ for _ in ()).throw(P2SFError("no builds")))
    made = TolerancesPanel(window.store)
    made.show(live(new_state(lens="tessar"), "settled", {"tolerances": analysis.question}))
    assert not made.limit.isEnabled() and not made.limit.text().strip("– ")
    end_work(made)


def test_errors_yield_and_worst_builds_are_shown(panel):
    state = new_state(lens=LENS)
    assert panel.limit.isEnabled() and panel.limit.value() > 0
    assert panel.errors.rowCount() == len(usual_tolerances(find_lens(LENS)))
    view = analysis.figures(panel._found, state.tolerances)
    assert view.counts.sum() >= 0.99 * FEW_BUILDS, "all but the worst are in the histogram"
    assert view.share == pytest.approx(0.8, abs=0.01), "four lenses of five keep the limit"
    assert (np.diff(view.yields[1]) >= 0).all()
    strehl = analysis.figures(panel._found, replace(state.tolerances, criterion="strehl"))
    assert strehl.share == pytest.approx(0.8, abs=0.03) and (np.diff(strehl.yields[1]) <= 0).all()
    values = [value for _, value in view.worst]
    assert values == sorted(values, reverse=True)
    assert values[0] == panel._found.builds.rms_waves.max()
    harms = [harm for _, _, harm in view.errors]
    assert harms == sorted(harms, reverse=True) and harms[0] > 0
    data = data_of(panel.widget)
    assert "decentre y, surface 1" in data and "build" in data and "yield, %" in data


@pytest.mark.slow
def test_a_criterion_or_a_limit_is_another_look_at_the_same_builds(panel, window, qtbot):
    found = panel._found
    window.store.update(tolerances_criterion="strehl", tolerances_limit=0.5)
    assert panel._found is found and "Strehl ratio ≥ 0.50" in panel.widget.readout.text()
    kept = (found.builds.strehl.min(1) >= 0.5).mean()
    assert panel.widget.readout.text().startswith(f"{100 * kept:.1f} %")
    window.store.update(tolerances_criterion="mtf", tolerances_limit=None)
    wait(panel, qtbot)
    assert panel._found is not found and np.isfinite(panel._found.builds.mtf).all()


def test_an_own_value_is_typed_and_undone(panel, window, qtbot):
    row = next(k for k, one in enumerate(panel.errors._rows) if one.kind == "radius")
    one = panel.errors._rows[row]
    panel.errors.item(row, 1).setText("0.7")
    assert window.store.state.tolerances.own == (("radius", one.first, one.first, 0.7),)
    wait(panel, qtbot)
    assert (
        panel.errors._rows[[r.kind == "radius" and r.first == one.first for r in panel.errors._rows].index(True)].amount
        == 0.7
    )
    window.store.undo()
    assert window.store.state.tolerances.own == ()
    panel.kinds["tilt"].setValue(0.2)
    assert {row[0] for row in window.store.state.tolerances.own} == {"tilt_x", "tilt_y"}


def test_a_share_that_comes_late_does_not_say_that_stopped_builds_are_drawn(panel):
    for refusal, words in (("", "computing, 50 %"), ("Stopped", "as before")):
        panel.widget.set_readout("as before")
        panel._refusal = refusal
        panel._on_progress(panel.late.asked, 0.5)
        assert panel.widget.readout.text() == words


@pytest.mark.parametrize(
    ("text", "value"), [("abc", "text"), ("-1", "high"), ("1e9", "high"), ("", "text"), ("1 furlong", "unit")]
)
def test_a_cell_that_is_no_tolerance_keeps_its_value_and_says_why(panel, window, text, value):
    before, cell, told = window.store.state, panel.errors.item(0, 1), []
    written = cell.text()
    window.store.refused.connect(told.append)
    cell.setText(text)
    window.store.refused.disconnect(told.append)
    assert window.store.state == before and cell.text() == written
    assert len(told) == 1 and value in told[0].message.values and window.banner.isVisible()
    assert value != "high" or told[0].message.values["error"] == panel.errors.item(0, 0).text()


def test_a_tolerance_may_be_zero(panel, window, qtbot):
    one = panel.errors._rows[0]
    panel.errors.item(0, 1).setText("0")
    wait(panel, qtbot)
    row = panel.errors._rows.index(replace(one, amount=0.0))
    assert panel.errors.item(row, 2).text() == "0" and not window.banner.isVisible()


def test_a_click_opens_a_build_beside_the_lens_as_designed(panel, window, qtbot):
    found, number = panel._found, panel.worst._numbers[0]
    panel.worst.cellClicked.emit(0, 0)
    state = window.store.state
    assert state.compare.pinned.optics.errors == () and state.tolerances.build == number + 1
    assert not panel._stale() and panel._found is found, "the yield is that of the lens as designed"
    assert panel.back.isVisibleTo(panel.widget) and panel.worst.selectionModel().selectedRows()[0].row() == 0
    built, known = paraxial_setup(state).lens, found.known
    rms = exact_quality(built, known.sources)[0]
    assert found.builds.rms_waves[number] == pytest.approx(rms, rel=0.02), "exact rays through the lens on screen"
    window.store.undo()
    assert window.store.state.compare.pinned is None and window.store.state.optics.errors == ()
    window.store.redo()
    panel.back.click()
    assert window.store.state.compare.pinned is None and window.store.state.optics.errors == ()
    assert not panel.back.isVisibleTo(panel.widget)


def test_own_values_stand_in_place_of_the_grade():
    lens = find_lens(LENS)
    view = ToleranceView(own=(("radius", 0, 0, 0.3), ("radius", 2, 2, 0.4), ("decentre_y", 1, 2, 0.05)))
    found = analysis.chosen_tolerances(lens, view)
    assert {one.first: one.amount for one in found if one.kind == "radius"} == {1: 0.3, 2: 0.4, 3: 0.3}
    assert found[-1] == Tolerance("decentre_y", 1, 0.05, 2)
    again = analysis.with_own(view, ("radius",), 0, 0, 0.1)
    assert [row for row in again.own if row[0] == "radius"] == [("radius", 0, 0, 0.1)], "it is of all of them"


def test_the_sensor_can_be_tilted_at_assembly(panel, window, qtbot):
    """A build opens with its tilted sensor, and exact rays through it have the wavefront that the panel says."""
    tilt = next(action for action in panel.compensate.menu().actions() if "sensor" in action.text())
    tilt.trigger()
    assert window.store.state.tolerances.compensators == (("thickness", 0, 0), ("tilt_x", 0, 0))
    wait(panel, qtbot)
    found, last = panel._found.request, len(find_lens(LENS).surfaces)
    assert [(found.tolerances[at].kind, found.tolerances[at].first) for at in found.places] == [
        ("thickness", last),
        ("tilt_x", last + 1),
    ]
    panel.worst.cellClicked.emit(0, 0)
    built, number = paraxial_setup(window.store.state).lens, panel.worst._numbers[0]
    assert built.sensor_before[-1].tilt_x_deg == panel._found.builds.errors[number, found.places[1]]
    rms = exact_quality(built, panel._found.known.sources)[0]
    assert panel._found.builds.rms_waves[number] == pytest.approx(rms, rel=0.02)


def test_the_field_on_screen_does_not_matter(window):
    states = [new_state(lens=LENS, field_deg=field) for field in (0.0, 1.0)]
    one, two = (analysis.question(live(state, "settled", {})).question.request for state in states)
    assert one == two


@pytest.mark.parametrize(
    "wrong",
    [
        {"tolerances_own": (("radius", 1, 1),)},
        {"tolerances_own": (("colour", 1, 1, 0.1),)},
        {"tolerances_own": (("radius", 1, 1, float("nan")),)},
        {"tolerances_compensators": "thickness"},
        {"tolerances_limit": -1.0},
        {"tolerances_grade": "best"},
    ],
)
def test_what_cannot_be_is_refused(wrong):
    with pytest.raises(P2SFError):
        change(new_state(), **wrong)


def test_the_panel_turns_to_the_room_it_has(qtbot):
    errors, histogram, yields, worst, kinds = (QWidget() for _ in range(5))
    body = TolerancesBody(errors, (histogram, yields), worst, kinds)
    qtbot.addWidget(body)
    body.show()
    shown = {}
    for size in ((900, 500), (400, 700), (400, 200), (900, 200)):
        body.resize(*size)
        QApplication.processEvents()
        shown[size] = tuple(part.isVisibleTo(body) for part in (errors, yields, worst, kinds))
        assert (body.width(), body.height()) == size, "what is shown leaves the size alone"
        assert body.minimumSizeHint().height() < 200
    assert shown[900, 500] == shown[400, 700] == (True,) * 4
    assert shown[400, 200] == shown[900, 200] == (True, False, False, False)


def test_without_compensators_the_designed_lens_has_the_wavefront_of_its_worst_field():
    """What *Pupil* shows at the edge of the field, by rays of its own; the back focus, set at assembly, lowers it."""
    lens, found = find_lens(LENS), {}
    for compensators in ((("thickness", 0, 0),), ()):
        state = new_state(lens=LENS, tolerances_compensators=compensators)
        asked = live(state, "settled", {"tolerances": analysis.question}).views["tolerances"].question
        result = analysis.Analyst().answer(asked.request, lambda: False, lambda _: None)
        found[bool(compensators)] = analysis.figures(result, state.tolerances).nominal
    edge = zernike_fit(lens, Source(field_deg=5.0, wavelength_um=lens.reference_wavelength_um)).rms
    assert found[False] == pytest.approx(edge, rel=1e-4) and found[True] < 0.7 * edge


def test_a_harm_that_is_none_or_that_the_form_misses_says_so(panel, window):
    view = analysis.figures(panel._found, window.store.state.tolerances)
    (one, place, _), (two, other, harm), *_ = view.errors
    doubtful = replace(view, errors=((one, place, np.nan), (two, other, harm)), form_errors=(np.nan, 0.5 * harm))
    table = ErrorTable()
    table.show_errors(doubtful, window.store.state.tolerances)
    lost, off = (table.item(row, 2) for row in (0, 1))
    assert lost.text() == LOST and lost.toolTip()
    assert significant(1.5 * harm, 2) in off.toolTip()


def test_a_harm_is_written_where_it_is_a_thousandth_of_the_largest(panel, window):
    view = analysis.figures(panel._found, window.store.state.tolerances)
    harms = (0.2, 0.02, 3e-4, 1e-4, -0.003)
    rows = tuple((one, place, harm) for (one, place, _), harm in zip(view.errors, harms, strict=False))
    table = ErrorTable()
    table.show_errors(replace(view, errors=rows, form_errors=(0.0,) * 5), window.store.state.tolerances)
    assert [table.item(row, 2).text() for row in range(5)] == ["0.20", "0.020", "0.00030", "0", "−0.0030"]


def test_cancel_offers_to_draw_again_at_once_and_the_same_is_not_begun_by_itself(window, monkeypatch, qtbot):
    begun, ends = [], Event()

    def answer(_, asked, stopped, tell):
        begun.append(asked)
        ends.wait(5)
        raise Cancelled("stopped")

    monkeypatch.setattr(analysis.Analyst, "answer", answer)
    made = TolerancesPanel(window.store)
    shown = live(new_state(lens=LENS), "settled", {"tolerances": analysis.question})
    made.show(shown)
    assert made.again.isHidden() and not made.stop_button.isHidden()
    qtbot.waitUntil(lambda: len(begun) == 1)
    made.stop_button.click()
    assert not made.again.isHidden() and made.stop_button.isHidden()
    ends.set()
    qtbot.waitUntil(lambda: not made.late.busy)
    made.show(shown)
    assert not made.late.busy and not made.again.isHidden() and made.stop_button.isHidden()
    end_work(made)
