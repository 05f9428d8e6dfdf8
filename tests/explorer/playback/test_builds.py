"""The film of random builds: every frame a lens of the draw, its own words, whole files, and the state as it was."""

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog
from pytest import approx

from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.compute.views import tolerances as analysis
from p2sf_explorer.playback.builds import LARGER, moments_of_builds
from p2sf_explorer.playback.filming import frame_of, picture_of
from p2sf_explorer.state.state import change
from tests.support.tolerances import exact_quality
from tests.support.windows.windows import at_rest


@pytest.fixture
def panel(window, qtbot):
    window.store.update(lens="achromat_f6", lens_text=None, field_deg=0.0, tab="tolerances")
    made = window.panels["tolerances"]
    qtbot.waitUntil(lambda: not made._stale())
    yield made
    window.store.update(tab="profiles")


def test_each_frame_is_a_build_of_the_draw_and_says_its_value(panel):
    """The value is that of exact rays through the lens on show, to the 2 % by which quadratic forms may differ."""
    asked, found = panel.drawn()
    designed, *builds = moments_of_builds(asked, found, count=6)
    assert designed.state.optics == asked.state.optics and "as designed" in str(designed.caption)
    assert len({moment.state.optics.errors for moment in builds}) == 6
    for number, moment in enumerate(builds, 1):
        words = str(moment.caption)
        assert words.startswith(f"build {number}: RMS wavefront ") and f"×{LARGER}" in words
        worst = exact_quality(paraxial_setup(moment.state).lens, found.known.sources)[0].max()
        assert float(words.split()[4]) == approx(worst, rel=0.02)


def test_a_factor_that_was_chosen_is_kept(panel):
    asked, found = panel.drawn()
    chosen = analysis.ToleranceQuestion(asked.request, asked.view, change(asked.state, exaggerated=10))
    assert "×10," in str(moments_of_builds(chosen, found, count=1)[1].caption)


@pytest.mark.slow
def test_layout_psf_and_words_are_in_the_film(panel, window, qtbot, tmp_path):
    """What the window shows of the same build; the sweep's bar stands, so that the room is the same."""
    window.store.update(playback_slider="field_deg")
    moments, before, bar = moments_of_builds(*panel.drawn(), count=2), window.store.state, window.play
    with qtbot.waitSignal(bar.filming.ended) as told:
        assert bar.film_builds(str(tmp_path / "builds.png"), moments)
        assert bar.progress.isVisible() and bar.stop_film.isVisible()
    assert told.args[0].values["count"] == 3
    assert window.store.state == before and window.live.state == before
    frames = [np.asarray(Image.open(path).convert("RGB")) for path in sorted(tmp_path.iterdir())]
    assert len({frame[-12:].tobytes() for frame in frames}) == 3, "each frame has words of its own"
    window.store.replace(moments[2].state)
    at_rest(window, qtbot)
    for chart in (window.panels["layout"].chart, window.panels["psf"].map.chart):
        corner, now = chart.mapTo(window.room, chart.rect().topLeft()), frame_of(picture_of(chart))
        part = frames[2][corner.y() : corner.y() + chart.height(), corner.x() : corner.x() + chart.width()]
        shown = np.frombuffer(now.rgb, np.uint8).reshape(now.height, now.width, 3)
        assert np.abs(part.astype(int) - shown).max() <= 8, "edges are smoothed anew where a part stands elsewhere"


def test_a_film_of_builds_can_be_cancelled(panel, window, qtbot, tmp_path):
    moments = moments_of_builds(*panel.drawn())
    with qtbot.waitSignal(window.play.filming.ended) as told:
        assert window.play.film_builds(str(tmp_path / "builds.gif"), moments)
        with qtbot.waitSignal(window.play.filming.progressed):
            pass
        qtbot.mouseClick(window.play.stop_film, Qt.MouseButton.LeftButton)
    assert "cancelled" in str(told.args[0]) and list(tmp_path.iterdir()) == []
    assert window.live.state == window.store.state and not window.play.isVisible()


def test_a_film_is_asked_for_by_button_or_by_name(panel, window, qtbot, tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *args: (asked.append(args[2]), ("", ""))[1])
    panel.film.click()
    window.store.update(tab="profiles")
    window.play.ask_film_of_builds()
    assert asked == ["achromat_f6_builds.gif"] * 2 and not window.play.filming.busy
    assert window.store.state.display.tab == "tolerances", "the builds that are filmed are on show"


def test_without_builds_it_is_said_what_to_wait_for(window, qtbot, monkeypatch):
    monkeypatch.setattr(analysis.Analyst, "answer", lambda *_: (_ for _ in ()).throw(analysis.GeometryError("no ray")))
    window.store.update(lens="cooke_triplet", tab="profiles")
    window.play.ask_film_of_builds()
    assert window.banner.isVisible() and "histogram" in window.banner.text.text()
    window.store.update(tab="profiles")


@pytest.mark.slow
def test_a_telescope_that_is_refocused_by_metres_is_filmed(panel, window, qtbot):
    """Hubble is f/24, its primary f/2.3: 0.5 % of a radius of 11 m move the focus by (24/2.3)² times 28 mm."""
    window.store.update(lens="hubble", tolerances_grade="commercial")
    qtbot.waitUntil(lambda: not panel._stale())
    moments = moments_of_builds(*panel.drawn())
    shifts = [amount for moment in moments for kind, *_, amount in moment.state.optics.errors if kind == "thickness"]
    assert max(map(abs, shifts)) > 1000 and len(moments) == 41
    assert all(paraxial_setup(moment.state).lens for moment in moments)
