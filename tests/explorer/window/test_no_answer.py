"""A setup without an answer: nothing of the one before may pass for it."""

from math import inf

import pytest

from p2sf.errors import SamplingError
from p2sf.messages import Message
from p2sf_explorer.compare.comparison import answers
from p2sf_explorer.compute.setup import paraxial_setup, with_lens
from p2sf_explorer.compute.views.mtf import contrast
from p2sf_explorer.state.state import change, new_state
from p2sf_explorer.store.late_answers import LateAnswers
from p2sf_explorer.widgets.copying import data_of
from p2sf_explorer.window.no_answer import NO_ANSWER, UNKNOWN

TOO_FAR = change(
    with_lens(new_state(theme="light", aim="paraxial", rail=("layout", "pupil", "coefficients")), "relay"),
    depth_mm=inf,
    field_deg=1.0,
)


@pytest.fixture
def without(window):
    window.store.replace(change(with_lens(window.store.state, "double_gauss_28"), free_pupil=True))
    assert window.live.setup.focal_length_mm == pytest.approx(100, rel=0.02)
    window.store.replace(TOO_FAR)
    return window


def test_no_picture_and_no_figure_of_the_lens_before_is_left(without):
    for key in ("pupil", "psf", "coefficients", without.tabs.current()):
        overlay = without.panels[key].widget.overlay
        assert overlay.isVisible() and overlay.text == str(NO_ANSWER)
        assert overlay.geometry().contains(without.panels[key].widget.rect().center())
        assert not data_of(without.panels[key].widget), "nor copied"
    assert {str(value) for _, value, _ in without.controls.facts.rows} == {UNKNOWN}
    assert not without.foot.sentence.text() and without.controls.rows["field_deg"].note.text() == UNKNOWN
    assert not without.caption.text


def test_the_new_lens_is_drawn_with_its_own_source(without):
    layout = without.panels["layout"]
    assert not layout.widget.overlay.isVisible()
    assert layout.chart.live.setup.lens == paraxial_setup(TOO_FAR).lens and layout.chart.live.layout.source is None


def test_the_reason_names_what_helps_and_outlasts_the_banner(without):
    assert "choose a nearer depth" in without.banner.text.text() and "clip" not in without.banner.text.text()
    without.banner.hide()
    assert "choose a nearer depth" in without.status.warning.text()


def test_a_theme_is_taken_up_without_an_answer(without):
    without.store.update(theme="dark")
    assert without._theme.dark and without._theme.warning in without.panels["coefficients"].widget.readout.text()


def test_the_psf_before_is_not_saved_under_the_new_name(without, tmp_path):
    assert not without.commands.save(str(tmp_path / "psf.npz"))
    assert "no PSF" in without.banner.text.text() and not list(tmp_path.iterdir())


def test_the_next_answer_uncovers_every_panel(without):
    without.store.update(depth_mm=94.412)
    assert not without.banner.isVisible()
    assert not any(without.panels[key].widget.overlay.isVisible() for key in without._visible())
    known = {name: str(value) for name, value, _ in without.controls.facts.rows}
    assert {name for name, value in known.items() if value == UNKNOWN} <= {"Strehl ratio"}


REASON = Message("the blur is too wide for a table; stop down")


def refusing(live):
    raise SamplingError(REASON)


@pytest.fixture
def one_refusing(window, monkeypatch):
    """Return the window with a tab in front whose own view has nothing to show."""
    monkeypatch.setattr("p2sf_explorer.window.window.view_of", lambda entry: refusing if entry.key == "mtf" else None)
    window.store.update(tab="mtf", field_deg=7.0)
    yield window
    monkeypatch.undo()
    window.store.update(tab="profiles")


def test_a_tab_that_has_nothing_to_show_covers_itself_alone(one_refusing):
    window, overlay = one_refusing, one_refusing.panels["mtf"].widget.overlay
    assert overlay.isVisible() and overlay.text == "The blur is too wide for a table; stop down"
    assert not any(window.panels[key].widget.overlay.isVisible() for key in window._visible() if key != "mtf")
    assert window.live.state.optics.field_deg == 7.0 and not window.banner.isVisible()
    assert UNKNOWN not in {str(value) for _, value, _ in window.controls.facts.rows}


def test_its_overlay_goes_with_the_next_answer(one_refusing, monkeypatch):
    monkeypatch.undo()
    one_refusing.store.update(field_deg=5.0)
    assert not one_refusing.panels["mtf"].widget.overlay.isVisible() and data_of(one_refusing.panels["mtf"].widget)


def test_a_difference_is_as_it_was_where_a_side_has_nothing(window):
    asked = change(window.store.state, shown="difference", pinned=new_state(f_number=8.0, method="seidel"))
    b_refuses = {"mtf": lambda live: refusing(live) if live.state.optics.f_number == 8.0 else contrast(live)}
    seen = answers(asked, "preview", b_refuses).seen
    assert str(seen.difference.why["mtf"]) == "This is A; B has none: the blur is too wide for a table; stop down"
    assert answers(asked, "preview", {"mtf": refusing}).seen.views["mtf"].why == REASON


def test_no_panel_goes_on_with_what_it_asked_before(window):
    """A question that is held: nobody would see its answer, and films would wait for it."""
    late = LateAnswers(window.panels["psf"].widget, lambda question, stopped, tell: question, held_ms=10_000)
    late.ask_when_held("of the lens before")
    assert late.busy
    window.store.replace(TOO_FAR)
    assert not late.busy and late.asked is None
