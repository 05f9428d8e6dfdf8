"""Pictures too slow for a frame: summed in the background, while another stands in and says so."""

from contextlib import contextmanager
from dataclasses import replace
from threading import Event, get_ident

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication

from p2sf.errors import Cancelled, GeometryError
from p2sf.figures.compare import r_squared
from p2sf.lensfile.library import shipped_lenses
from p2sf.messages import Message
from p2sf.psf import methods
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import METHODS, PsfRequest
from p2sf_explorer.compute.deferred_sums import AT_ONCE_SECONDS, KEPT, SumCache
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.setup import with_lens
from p2sf_explorer.state.pinning import optics
from p2sf_explorer.state.state import State, change, new_state
from tests.explorer.conftest import FIRST

CORNER = change(with_lens(new_state(theme="light"), "double_gauss_28"), method="traced", field_deg=14.0, clip=True)
WIDE = change(CORNER, clip=False, method="huygens", f_number=2.8, sensor_shift_um=60.0)


@pytest.fixture
def window(window):
    window.sums = SumCache()
    return window


@contextmanager
def noted(patch, gate: Event | None = None):
    """Note in which threads waves are summed one by one; each sum waits at the gate, and gives any picture."""
    found, ready = [], live(new_state(method="seidel")).psf

    def call(pixel_um):
        found.append(get_ident())
        if gate:
            gate.wait(20)
        return replace(ready, method="traced", pixel_um=pixel_um)

    with patch.context() as inner:
        inner.setattr(methods, "psf_of_pupil", lambda pupil, window, *_: call(window[1]))
        yield found


@pytest.mark.parametrize("state", [CORNER, WIDE], ids=["clipped", "wide blur"])
def test_a_slow_sum_is_never_made_by_the_thread_that_paints(window, qtbot, monkeypatch, state):
    """The picture that stands in says what follows."""
    with noted(monkeypatch) as threads:
        window.store.replace(state)
        assert window.live.pending and window.live.psf.method != state.optics.method
        assert str(window.live.why) == f"{state.optics.method} follows: its sum of waves takes a moment"
        qtbot.waitUntil(lambda: window.live.pending is None)
        assert threads and get_ident() not in threads
    assert window.live.psf.method == "traced"


def test_what_follows_is_what_waiting_would_have_given(window, qtbot):
    window.store.replace(WIDE)
    qtbot.waitUntil(lambda: window.live.pending is None)
    waited = live(WIDE).psf
    assert window.live.psf.method == waited.method
    np.testing.assert_array_equal(window.live.psf.values, waited.values)


def test_what_stands_in_has_the_size_of_what_follows():
    """So that A − B finds the same samples."""
    stand_in = live(CORNER, cache=SumCache())
    assert stand_in.pending.window == (stand_in.psf.values.shape[-1], stand_in.psf.pixel_um)


def test_a_sum_nobody_waits_for_any_more_is_not_shown(window, qtbot, monkeypatch):
    gate = Event()
    with noted(monkeypatch, gate):
        window.store.replace(change(WIDE, field_deg=12.0))
        first = window.live.pending
        window.store.update(field_deg=13.0)
        second = window.live.pending
        gate.set()
        qtbot.waitUntil(lambda: window.live.pending is None)
        assert first != second and window.sums.get(second)
        with noted(monkeypatch) as threads:
            window.store.update(psf_scale="log")
            QApplication.processEvents()
        assert window.live.pending is None and not threads, "what is done is not summed again"


def test_a_sum_that_fails_says_so_and_nobody_waits_for_it(window, qtbot, monkeypatch):
    """The banner goes with the next answer; the column beside the picture says from then on why it stands in."""

    def fail(pending, cancelled):
        raise GeometryError("no ray passes; stop down.")

    monkeypatch.setattr("p2sf_explorer.window.window.answer_to", fail)
    window.store.replace(WIDE)
    with qtbot.waitSignal(window.late_sums.failed):
        assert window.live.pending
    assert window.banner.isVisible() and "stop down" in window.banner.text.text()
    monkeypatch.undo()
    window.store.update(psf_scale="log")
    assert window.live.pending is None and not window.late_sums.busy, "it would fail again"
    assert window.live.psf.method != "huygens" and window.live.why == Message("no ray passes; stop down.")


def test_a_failure_nobody_waits_for_is_not_told(window):
    window.late_sums._runner.failed.emit(live(CORNER, cache=SumCache()).pending, Message("nothing to say."))
    assert not window.banner.isVisible()


def test_what_was_given_up_and_asked_for_again_comes(window, qtbot, monkeypatch):
    """There and back at once: the first sum is stopped while its like waits behind it."""
    gate, ready, sums = Event(), live(new_state(method="seidel")).psf, []

    def stoppable(pending, cancelled):
        gate.wait(20)
        sums.append(cancelled())
        if cancelled():
            raise Cancelled("stopped")
        return replace(ready, method="huygens", pixel_um=pending.window[1])

    said = []
    monkeypatch.setattr("p2sf_explorer.window.window.answer_to", stoppable)
    monkeypatch.setattr(window, "refuse", said.append)
    window.store.replace(WIDE)
    window.store.update(field_deg=13.0)
    window.store.undo()
    gate.set()
    qtbot.waitUntil(lambda: window.live.pending is None)
    assert sums == [True, False] and said == []


def test_of_two_pinned_b_is_summed_once(window, qtbot, monkeypatch):
    """B's answer is kept while A moves, yet not the one that stood in for it."""
    ready, sums = live(new_state(method="seidel")).psf, []

    def counted(pending, cancelled):
        sums.append(pending)
        assert len(sums) < 4, "round and round"
        values = np.full((pending.window[0],) * 2, pending.window[0] ** -2.0, np.float32)
        return replace(ready, method="huygens", values=values, pixel_um=pending.window[1])

    monkeypatch.setattr("p2sf_explorer.window.window.answer_to", counted)
    window.store.replace(change(FIRST, pinned=optics(WIDE)))
    assert window._answers.pending == window._answers.b.pending is not None
    qtbot.waitUntil(lambda: not (window.late_sums.busy or window._answers.pending))
    assert window._answers.b.psf.method == "huygens" and len(sums) == 1


@pytest.mark.parametrize(
    "method", [method for method in METHODS if method.over_frequency], ids=lambda method: method.name
)
def test_what_is_summed_at_once_is_small(method):
    """The estimate of nodes before any is traced keeps what it promises, to a factor of 2 in a corner's slope."""
    for name in ("fast_gauss_f14", "telephoto", "landscape"):
        for shift in (0.0, 100.0, 300.0, 900.0):
            state = change(with_lens(State(), name), method=method.name, sensor_shift_um=shift)
            answer = live(state, cache=SumCache())
            assert answer.pending or answer.psf.rays * method.node_seconds <= 2 * AT_ONCE_SECONDS


def test_the_latest_sums_are_kept_and_no_more():
    cache, psf = SumCache(), live(new_state(method="seidel"), "preview").psf
    asks = [PsfRequest(None, None, "traced", (8, float(number))) for number in range(KEPT + 2)]
    for each in asks:
        cache.keep(each, psf)
    assert [each for each in asks if cache.get(each)] == asks[2:]
    assert cache.version == KEPT + 2


def test_what_moves_where_rims_clip_resembles_the_exact_picture():
    """A yes or no at each node leaves a ragged edge; without the rims R² is far lower."""
    seen = live(CORNER, "preview", cache=SumCache())
    assert seen.psf.method == "fitted" and "rims" in str(seen.psf.sampling)
    lens, source, window = seen.setup.lens, seen.setup.source, (64, seen.psf.pixel_um)
    exact, whole = (huygens_psf(lens, source, *window, None, clip=clip) for clip in (True, False))
    alike, unlike = (r_squared(seen.psf.values, x.values) for x in (exact, whole))
    assert alike > 0.97 > unlike


def test_a_slow_method_of_every_lens_has_something_that_stands_in():
    for name in shipped_lenses():
        state = change(with_lens(State(), name), method="traced", clip=True)
        answer = live(state, cache=SumCache())
        assert answer.pending or answer.psf.method == "geometric"
        assert np.isfinite(answer.psf.values).all() and answer.psf.values.sum() == pytest.approx(1.0)


def test_a_window_for_a_wide_picture_shows_a_small_one_as_rays():
    """Beside a B that is blurred over millimetres a sum of waves would be of thousands of rows."""
    sharp = change(FIRST, field_deg=0.0)
    assert live(sharp, least=(0, 100.0)).psf.method == "seidel"
    for quality in ("preview", "settled"):
        wide = live(sharp, quality, least=(0, 20_000.0)).psf
        assert wide.method == "geometric" and wide.values.sum() == pytest.approx(1.0)
        assert wide.values.shape[-1] * wide.pixel_um == pytest.approx(20_000.0)
