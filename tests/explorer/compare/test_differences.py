"""A − B in every panel: what it is, checked against the two, or a sentence on why there is none."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from pytest import approx

from p2sf.messages import Message
from p2sf.paraxial.pupils import Stop
from p2sf_explorer.compare.comparison import answers
from p2sf_explorer.compare.differences import minus, subtract
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.live import View
from p2sf_explorer.compute.views.first_order import aperture, distance, length, pupil, stop
from p2sf_explorer.compute.views.through_focus import answer
from p2sf_explorer.i18n import language as languages
from p2sf_explorer.i18n.messages import WINDOW
from p2sf_explorer.state.panels import PANELS, difference_of, view_of
from p2sf_explorer.state.pinning import side_b
from p2sf_explorer.state.state import change, new_state

PAIR = new_state(
    method="seidel", f_number=4.0, field_deg=5.0, theme="light", pinned=new_state(method="seidel", f_number=8.0)
)
STOP = Stop(np.asarray(6), np.asarray(9.0), np.asarray(6), "file")
FROM_ANSWERS = {"psf", "pupil", "coefficients"}  # what `p2sf_explorer.compare.comparison.difference` holds
WHY = {key: entry.minus for key, entry in PANELS.items() if isinstance(entry.minus, Message)}
SUBTRACTED = [key for key in PANELS if key not in WHY and key not in FROM_ANSWERS]
STILL = ("solid", "image", "database", "accuracy", "colour")  # OpenGL, or seconds of work; their sentences are the same


@pytest.fixture(scope="module")
def views():
    wanted = {key: view_of(PANELS[key]) for key in SUBTRACTED}
    a, b = (compute.live(side, "preview", wanted).views for side in (change(PAIR, pinned=None), side_b(PAIR)))
    return a, b, answers(change(PAIR, shown="difference"), "preview", wanted).seen.views


def test_every_panel_either_differs_or_says_why():
    found = {key: difference_of(entry) for key, entry in PANELS.items()}
    assert {key for key, minus in found.items() if minus is None} == FROM_ANSWERS
    assert set(WHY) | set(SUBTRACTED) | FROM_ANSWERS == set(PANELS)
    assert all(str(why).startswith("This is A: ") and str(why).endswith(".") for why in WHY.values())
    german = (languages.FOLDER / "de.ts").read_text(encoding="utf-8")
    assert all(f"<source>{why}</source>" in german for why in WHY.values())


def test_in_the_window_every_panel_names_its_side_and_says_why(window):
    window.store.replace(change(PAIR, shown="difference"))
    for key in (key for key in PANELS if key not in STILL):
        window.open_panel(key)
        card = window.panels[key].widget
        assert card.note.isVisible() == (key in WHY)
        assert card.note.text() == str(WHY.get(key, ""))
        assert card.title.text().endswith(" · A" if key in WHY else " · A − B")
    window.store.update(shown="b", tab="profiles")
    assert window.panels["layout"].widget.title.text() == "Layout · B"
    assert not window.panels["layout"].widget.note.isVisible()
    window.store.replace(change(PAIR, pinned=None))
    assert window.panels["layout"].widget.title.text() == "Layout"


def test_fans_and_sums_per_surface_are_taken_from_each_other(views):
    a, b, d = views
    for fan in ("ray_fan", "opd_fan"):
        for line in ("sagittal", "tangential"):
            mine, other, less = (getattr(side[fan].found, line) for side in views)
            assert np.allclose(mine - other, less, equal_nan=True)
    for term, waves in d["seidel"].found.waves.items():
        assert waves == approx(a["seidel"].found.waves[term] - b["seidel"].found.waves[term])
    # third order: W40 goes as the fourth power of the aperture, so that f/4 less f/8 is 15/16 of f/4
    assert d["seidel"].found.waves["w40"].sum() == approx(15 / 16 * a["seidel"].found.waves["w40"].sum(), rel=1e-6)


def test_a_difference_has_the_sign_of_the_side_that_has_more():
    """f/4 has sixteen times the spherical aberration of f/8, and in the middle of its axial picture more light."""
    wanted = {key: view_of(PANELS[key]) for key in ("zernike", "profiles")}
    axial = change(PAIR, field_deg=0.0, method="fitted", sensor_shift_um=0.0)
    own = compute.live(change(axial, pinned=None), "settled", wanted)
    seen = answers(change(axial, shown="difference"), "settled", wanted).seen
    assert seen.difference.coefficients["w40"] == approx(15 / 16 * float(own.setup.coefficients.w40), rel=1e-6)
    middle = len(seen.difference.psf) // 2
    assert seen.difference.psf[middle, middle] > 0
    profiles = seen.views["profiles"].found
    assert profiles.along_x[int(np.abs(profiles.position_um).argmin())] > 0
    for order, fit in own.views["zernike"].found.fits.items():
        place = next(k for k, term in enumerate(fit.terms) if (term.n, term.m) == (4, 0))
        assert seen.views["zernike"].found.fits[order].waves[place] / fit.waves[place] == approx(15 / 16, abs=0.03)
    at = middle_row(seen.difference.pupil.waves)
    assert seen.difference.pupil.waves[at] / own.pupil.waves[at] > 0


def middle_row(waves):
    """Return the place of the last sample inside the rim, on the line through the middle."""
    row = len(waves) // 2
    return row, int(np.flatnonzero(np.isfinite(waves[row]))[-1])


def test_a_lens_with_other_surfaces_has_no_sums_to_take_away(views):
    other = compute.live(
        new_state(lens="cooke_triplet", method="seidel"), "preview", {"seidel": view_of(PANELS["seidel"])}
    )
    shown, why = subtract("seidel", views[0]["seidel"], other.views["seidel"])
    assert shown is views[0]["seidel"] and why.values == {"a": 11, "b": 6}


def test_field_curves_differ_by_focus_and_by_share_of_height(views):
    a, b, d = (side["field"].found for side in views)
    # both have the axis and, by the same lens file, the same fields; the stop moves the real foci alone
    assert d.real.tangential == approx(a.real.tangential - b.real.tangential, nan_ok=True)
    assert d.third.sagittal == approx(a.third.sagittal - b.third.sagittal)
    assert d.heights.distortion == approx(a.heights.distortion - b.heights.distortion, abs=1e-12)


def test_a_colour_b_cannot_show_has_no_difference(views):
    a, b, d = (side["chromatic"].found for side in views)
    assert d.shift_um == approx(a.shift_um - b.shift_um)
    assert d.shift_um[0] == approx(0, abs=1e-9)  # paraxial rays do not know the stop
    short = replace(b, wavelength_nm=b.wavelength_nm[5:], shift_um=b.shift_um[:, 5:])
    assert np.isnan(subtract("chromatic", View(a), View(short))[0].found.shift_um[:, :5]).all()


def test_the_strip_is_light_less_light_at_the_same_places(views):
    a, _, d = (side["through_focus"].question for side in views)
    assert d.less.shifts_um == a.shifts_um and d.less.window == a.window
    few = replace(a, shifts_um=a.shifts_um[:1])
    found = answer(replace(few, less=replace(d.less, shifts_um=few.shifts_um)), lambda: False, lambda *_: None)
    parts = [answer(part, lambda: False, lambda *_: None) for part in (few, replace(d.less, shifts_um=few.shifts_um))]
    assert np.allclose(found.light, parts[0].light - parts[1].light) and found.light.any()
    shown, why = subtract("through_focus", View(None, a), View(None, why=Message("no")))
    assert shown.question == a and str(why) == "This is A; B has none: no"


@pytest.mark.parametrize(
    ("a", "b", "shown"),
    [
        (length(100.004), length(99.5), "0.504 mm"),
        (length(-1.25), length(2.0), "−3.250 mm"),
        (length(1.00049), length(1.0), "0.000 mm"),
        (aperture(4.0), aperture(8.0), "−4.00"),
        (aperture(5.6), aperture(16.0), "−10.40"),
        (pupil(57.91, 25.0), pupil(57.91, 12.5), "⌀ 12.50 at 0.00 mm"),
        (distance(inf), distance(inf), "–"),
        (distance(inf), distance(900.0), "∞ | 900.0 mm"),
        (distance(2500.0), distance(900.0), "2.500 m | 900.0 mm"),
        (stop(STOP), stop(STOP), "–"),
        (stop(STOP), stop(replace(STOP, surface=5)), "surface 6 (file) | surface 5 (file)"),
        (stop(STOP), stop(replace(STOP, chosen_by="auto")), "surface 6 (file) | surface 6 (auto)"),
    ],
)
def test_values_of_the_table_are_taken_from_each_other(a, b, shown):
    assert minus(a, b).text(WINDOW) == shown
