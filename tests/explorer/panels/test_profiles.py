"""Sections and encircled energy as they are painted, against the Airy pattern and the picture's own samples."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.views.profiles import profiles
from p2sf_explorer.state.state import change, new_state

FIRST = new_state(method="seidel", theme="light")
PERFECT = change(FIRST, free_pupil=True)


def test_a_perfect_lens_paints_the_airy_pattern_on_both_sections(window):
    window.store.update(free_pupil=True, tab="profiles")
    panel = window.panels["profiles"]
    x, wanted = panel.curves["Airy"].data()
    for name in ("along x", "along y"):
        assert panel.curves[name].data()[1] == pytest.approx(wanted, abs=1e-3)  # settled sums keep 1e-4
    rings = x[1:-1][(wanted[1:-1] < wanted[:-2]) & (wanted[1:-1] < wanted[2:])]
    assert rings[rings > 0][0] == pytest.approx(window.live.airy_radius_um, abs=x[1] - x[0])
    assert x[1] - x[0] < window.live.airy_radius_um / 10, "a core is drawn with more than three points"


def test_four_fifths_of_a_perfect_lens_light_lie_inside_the_first_ring(window):
    window.store.update(free_pupil=True, tab="profiles")
    panel = window.panels["profiles"]
    radius = window.live.airy_radius_um
    assert np.interp(radius, *panel.perfect.data()) == pytest.approx(0.838, abs=2e-3)  # Born and Wolf 1999, §8.5.2
    assert np.interp(radius, *panel.within.data()) == pytest.approx(0.838, abs=2e-3)  # of all light, as of the window


@pytest.mark.parametrize("method", ["seidel", "auto"])
def test_close_to_the_centroid_the_energy_grows_with_the_area(method):
    answer = live(change(FIRST, method=method, lens="tessar", f_number=8.0, field_deg=5.0))
    found = profiles(answer).found
    radius, energy = (line[found.position_um.size // 2 :] for line in (found.position_um, found.energy))
    assert radius[0] == 0 and radius[4] < answer.airy_radius_um / 4, "light changes by a tenth over such distances"
    assert energy[2:5] / energy[1] == pytest.approx(radius[2:5] ** 2 / radius[1] ** 2, rel=0.1)


@pytest.mark.parametrize(("method", "lens"), [("seidel", "double_gauss_28"), ("fitted", "double_gauss_28")])
def test_fine_sections_go_through_the_samples_of_the_picture(method, lens):
    answer = live(change(FIRST, method=method, f_number=8.0, field_deg=7.0, lens=lens))
    view, psf = profiles(answer).found, answer.psf
    assert view.position_um.size > 3 * psf.values.shape[-1]
    rows = psf.values.shape[0] // 2
    scale = float(psf.sum_over_peak)
    top = max(view.along_y.max(), 1e-9)
    found = np.interp(psf.y_um, view.position_um, view.along_y) / top
    own = psf.values[:, rows] * scale
    assert found == pytest.approx(own / own.max(), abs=0.03)  # straight lines between points a quarter sample apart


def test_a_drag_paints_sections_of_the_preview(window):
    with window.store.drag():
        window.store.update(field_deg=9.0)
        assert window.live.quality == "preview"
        x, y = window.panels["profiles"].curves["along x"].data()
        assert x.size == 257 and y.max() == pytest.approx(1.0, abs=0.1)
        assert window.panels["profiles"].within.data()[0].size == 0, "no energy of another picture"
        assert "follows" in window.panels["profiles"].widget.readout.text()
    radius, energy = window.panels["profiles"].within.data()
    assert (np.diff(energy) >= 0).all() and energy[-1] > 0.95 and radius[0] == 0


def test_defocus_spreads_the_energy(window):
    window.store.update(free_pupil=True)
    panel = window.panels["profiles"]
    sharp = np.interp(10.0, *panel.within.data())
    window.store.update(added_waves=(0.0, 0.0, 0.0, 0.0, 3.0, 0.0))
    assert np.interp(10.0, *panel.within.data()) < 0.6 * sharp
    # 3 λ of defocus: rays land up to 2·3·λ/NA from the chief ray.
    edge = 6 * window.live.setup.source.wavelength_um / float(window.live.setup.coefficients.na)
    assert np.interp(1.3 * edge, *panel.within.data()) > 0.9


def test_where_rays_are_clipped_the_samples_are_shown():
    answer = live(change(FIRST, method="traced", field_deg=14.0, f_number=5.6, clip=True), "preview")
    answer = replace(answer, quality="settled")
    view = profiles(answer).found
    middle = answer.psf.values[answer.psf.values.shape[0] // 2]
    assert np.interp(answer.psf.x_um, view.position_um, view.along_x).argmax() == middle.argmax()


def test_beside_a_difference_the_radii_are_said_to_be_those_of_a(window, qtbot):
    window.store.update(pinned=change(window.store.state, f_number=8.0), shown="a", tab="profiles")
    caption = window.panels["profiles"].widget.readout
    qtbot.waitUntil(lambda: "R80" in caption.text())
    assert "A: R80" not in caption.text()
    window.store.update(shown="difference")
    qtbot.waitUntil(lambda: "A: R80" in caption.text())


def test_the_same_question_is_answered_once(window, qtbot, monkeypatch):
    """Energy too slow for a frame, of a state that is shown twice, and then of another."""
    made, module = [], "p2sf_explorer.compute.views.profiles"
    monkeypatch.setattr(f"{module}.energy_is_live", lambda *given: False)
    late, answer = window.panels["profiles"].late, window.panels["profiles"].late._answer
    monkeypatch.setattr(late, "_answer", lambda *given: made.append(given[0]) or answer(*given))
    for field_deg, count in ((4.0, 1), (4.0, 1), (6.0, 2)):
        window.store.update(field_deg=field_deg, tab="profiles", method="seidel")
        window.refresh(window.store.state)
        qtbot.waitUntil(lambda: not late.busy)
        assert len(made) == count
        assert window.panels["profiles"].within.data()[1].max() > 0.9, "the energy is painted, also the second time"
