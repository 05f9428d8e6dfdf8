"""Two setups in one window: what is pinned stays, what is linked moves along, and A − B is the difference."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytest import approx

from p2sf.lens.lens import AIMS
from p2sf.lensfile.library import lenses_folder
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.messages import Message
from p2sf_explorer.compare.comparison import answers, resample, window_of
from p2sf_explorer.compare.contrasts import contrasts
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.setup import with_lens
from p2sf_explorer.compute.views.mtf import contrast
from p2sf_explorer.compute.views.profiles import profiles
from p2sf_explorer.state.limits import RINGS
from p2sf_explorer.state.pinning import OPTICS, optics, pin, side_b, swap, unpin, with_links
from p2sf_explorer.state.state import ENTRIES, change, entry, new_state
from p2sf_explorer.state.terms import TERMS
from tests.support.lenses.zooms import focusing_zoom
from tests.support.windows.events import choose

VIEWS = {"profiles": profiles, "mtf": contrast}
A = new_state(method="seidel", f_number=4.0, field_deg=5.0, theme="light")
PAIR = change(A, pinned=new_state(method="seidel", f_number=8.0, field_deg=5.0))


def test_pinning_and_taking_away_leave_the_state_as_it_was():
    assert unpin(pin(A)) == A
    assert optics(side_b(PAIR)) == optics(PAIR.compare.pinned)
    unlike = {name for name in ENTRIES if entry(side_b(PAIR), name) != entry(A, name)}
    assert unlike <= set(OPTICS)


def test_exchanging_twice_is_nothing():
    assert swap(swap(PAIR)) == PAIR
    assert optics(swap(PAIR)) == optics(PAIR.compare.pinned)


def test_only_what_is_linked_moves_both():
    linked = change(PAIR, linked=("field_deg",))
    assert with_links(linked, {"field_deg": 9.0})["pinned"].optics.field_deg == 9.0
    assert with_links(linked, {"f_number": 2.0}) == {"f_number": 2.0}
    assert with_links(PAIR, {"field_deg": 9.0}) == {"field_deg": 9.0}


@pytest.mark.parametrize("quality", ["settled", "preview"])
def test_both_stand_in_one_window_and_each_is_its_own_picture(quality):
    found = answers(PAIR, quality, {})
    assert found.a.psf.pixel_um == found.b.psf.pixel_um
    assert found.a.psf.values.shape == found.b.psf.values.shape
    alone = compute.live(side_b(PAIR), quality, least=window_of(found.a))
    assert np.array_equal(found.b.psf.values, alone.psf.values)


def test_the_window_holds_the_wider_of_the_two_whichever_is_a():
    one, other = answers(PAIR, "settled", {}), answers(swap(PAIR), "settled", {})
    assert one.a.psf.pixel_um == other.a.psf.pixel_um
    assert np.array_equal(one.a.psf.values, other.b.psf.values)


def test_what_is_on_screen_is_a_or_b_or_their_difference():
    a, b, d = (answers(change(PAIR, shown=side), "settled", VIEWS).seen for side in ("a", "b", "difference"))
    peak = max(a.psf.values.max(), b.psf.values.max())
    assert np.array_equal(d.difference.psf, (a.psf.values - b.psf.values) / peak)
    assert d.difference.psf.sum() == approx(0, abs=1e-5 / peak)  # both of unit sum in float32
    for name in TERMS:
        six = [float(getattr(side.setup.coefficients, name)) for side in (a, b)]
        assert d.difference.coefficients[name] == approx(six[0] - six[1], abs=1e-12)
    assert np.allclose(d.difference.pupil.waves, a.pupil.waves - b.pupil.waves, equal_nan=True)
    for name in ("along_x", "along_y"):
        parts = [getattr(side.views["profiles"].found, name) for side in (a, b, d)]
        assert np.allclose(parts[0] - parts[1], parts[2], atol=1e-12)


def test_stopped_down_the_difference_of_contrast_ends_where_the_wider_one_does():
    sides = (change(PAIR, shown=side) for side in ("a", "b", "difference"))
    a, b, d = (answers(state, "settled", VIEWS).seen.views["mtf"].found for state in sides)
    assert b.frequency_per_mm[-1] < a.frequency_per_mm[-1]  # the cut-off 2NA/λ halves from f/4 to f/8
    beyond = a.frequency_per_mm > b.frequency_per_mm[-1]
    assert np.array_equal(d.tangential[beyond], a.tangential[beyond])
    assert d.tangential[0] == approx(0, abs=1e-6)


def test_equal_setups_differ_nowhere():
    found = answers(change(pin(A), shown="difference"), "settled", VIEWS).seen.difference
    assert not found.psf.any()
    assert not np.nan_to_num(found.pupil.waves).any()
    assert contrasts(pin(A)) == ()


UNLIKE = {
    **{"lens": "achromat_f6", "lens_text": "as it is", "depth_mm": 900.0, "focus_mm": 900.0, "sensor_shift_um": 7.0},
    **{"field_deg": 5.0001, "wavelength_nm": 500.0, "f_number": 8.0, "stop": "auto", "clip": True, "method": "traced"},
    **{"aim": next(aim for aim in AIMS if aim != A.optics.aim)},
    **{"tolerance": 0.9, "added_waves": (0.5, *(0.0,) * 5), "muted": ("w40",), "solo": ("w31",), "free_pupil": True},
    **{"obscuration": 0.3, "vanes": 4, "vane_width": 0.01, "vane_angle_deg": 45.0, "blades": 6, "roundness": 0.5},
    **{"blade_angle_deg": 10.0, "apodisation": 0.8, "apodisation_power": 4, "cubic_um": 1.0},
    **{"field_x_deg": 2.0, "errors": (("decentre_y", 3, 5, 0.1),)},
}


@pytest.mark.parametrize("name", [name for name in OPTICS if name not in RINGS])
def test_whatever_makes_another_picture_is_named(name):
    """B differs from A in one entry of what makes a picture: the strip must not call the two the same."""
    value = (lenses_folder() / f"{A.optics.lens}.toml").read_text("utf-8") if name == "lens_text" else UNLIKE[name]
    title, a, b = contrasts(change(pin(A), **{name: value}))[0]
    assert title and a != b


@pytest.mark.parametrize(("name", "title"), [("zoom", "Zoom"), ("focus_position", "Focus")])
def test_a_turned_ring_is_named(name, title):
    place, words = {"zoom": (47.5, "47.5 mm"), "focus_position": (2.5, "2.50")}[name]
    pinned = pin(with_lens(A, A.optics.lens, lens_to_toml(focusing_zoom())))
    ((found, a, b), *_) = contrasts(change(pinned, **{name: place}))
    assert found == title and str(a) == words and a != b


def test_two_methods_are_put_on_one_grid():
    state = change(pin(change(A, method="traced")), method="seidel", shown="difference")
    found = answers(state, "settled", {}).seen.difference
    # On axis-like 5° at f/4 the fourth-order wavefront and the exact one agree to a wave over most of the pupil.
    assert np.isfinite(found.pupil.waves).mean() > 0.6
    assert ("Method", Message("seidel"), Message("traced")) in contrasts(state)


def test_resampling_keeps_a_plane():
    axis = (np.arange(64) + 0.5) / 64
    plane = 2 * axis[:, None] - 3 * axis
    other = (np.arange(96) + 0.5) / 96
    assert np.allclose(resample(plane, 96)[1:-1, 1:-1], (2 * other[:, None] - 3 * other)[1:-1, 1:-1])


@pytest.fixture
def both(window, qtbot):
    window.store.update(f_number=8.0)
    qtbot.waitUntil(window.isActiveWindow)
    qtbot.keyClick(window, Qt.Key.Key_B, Qt.KeyboardModifier.ControlModifier)
    window.store.update(f_number=4.0)
    return window


def test_ctrl_b_pins_and_every_panel_shows_the_side_asked_for(both, qtbot):
    bar, panels = both.compare, both.panels
    assert bar.isVisible()
    assert "f/4.00" in bar.words.text() and "f/8.00" in bar.words.text()
    shown = {}
    for side, button in bar.sides.items():
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
        assert both.store.state.compare.shown == side
        shown[side] = {
            "psf": panels["psf"].map.indices.copy(),
            "pupil": panels["pupil"].map.indices.copy(),
            "profiles": panels["profiles"].curves["along y"].data()[1].copy(),
            "coefficients": np.array(list(panels["coefficients"].bars.values.values())),
        }
        assert {"a": "A", "b": "B", "difference": "A − B", "both": "A"}[side] in panels["psf"].badge.text()
        named = both.foot.sentence.text().startswith("A: "), both.controls.facts.rows[0][0] == "A"
        assert named == (side != "a",) * 2, "the column at the left is A's, whatever is on screen"
    for name in shown["a"]:
        assert not np.array_equal(shown["a"][name], shown["b"][name])
    for name in ("profiles", "coefficients"):
        assert np.allclose(shown["a"][name] - shown["b"][name], shown["difference"][name], atol=1e-6)
    qtbot.mouseClick(bar.unpin, Qt.MouseButton.LeftButton)
    assert not bar.isVisible()
    assert both.live.side == ""


def test_a_linked_slider_moves_both_and_is_one_undo(both, drag):
    both.compare.links["field_deg"].trigger()
    before = both.store.state
    drag(both.controls.rows["field_deg"].slider, 0.3)
    state = both.store.state
    assert state.optics.field_deg == state.compare.pinned.optics.field_deg != before.optics.field_deg
    assert (state.optics.f_number, state.compare.pinned.optics.f_number) == (4.0, 8.0)
    both.store.undo()
    assert both.store.state == before


def test_swap_gives_the_controls_the_other_one(both, qtbot):
    qtbot.mouseClick(both.compare.swap, Qt.MouseButton.LeftButton)
    assert both.controls.rows["f_number"].edit.text() == "f/8.00"
    assert both.live.state.optics.f_number == 8.0


def test_only_links_move_b_where_it_is_on_screen_alone_and_swap_keeps_it_there(both, qtbot):
    bar, rows = both.compare, both.controls.rows
    bar.links["field_deg"].trigger()
    assert rows["f_number"].isEnabled() and not bar.words.text().startswith("B is pinned")
    qtbot.mouseClick(bar.sides["b"], Qt.MouseButton.LeftButton)
    assert bar.words.text().startswith("B is pinned; the controls move A · Swap")
    assert not rows["f_number"].isEnabled() and not both.controls.focus_button.isEnabled()
    assert rows["field_deg"].isEnabled(), "what is linked moves B too"
    seen = both.live.psf.values
    qtbot.mouseClick(bar.swap, Qt.MouseButton.LeftButton)
    assert both.store.state.compare.shown == "a" and rows["f_number"].isEnabled()
    assert both.live.state.optics.f_number == 8.0 and np.array_equal(both.live.psf.values, seen)
    assert not bar.words.text().startswith("B is pinned")


def test_what_a_panel_shows_of_b_is_not_put_into_a(both, qtbot):
    """The strip's arrow keys step from the sensor on screen, which is B's; A keeps its own, and a sentence says why."""
    both.store.update(tab="through_focus", sensor_shift_um=30.0, shown="b")
    chart, before = both.panels["through_focus"].chart, both.store.state
    assert chart.sensor_um == 0.0
    for side in (Qt.Key.Key_Left, Qt.Key.Key_Right):
        qtbot.keyClick(chart, side)
        assert both.store.state == before and both.banner.isVisible()
    choose(both.panels["psf"].scale, "linear")
    assert both.store.state.display.psf_scale == "linear", "looks are common to both"
    both.controls.rows["sensor_shift_um"].edit.committed.emit("40")
    assert both.store.state.optics.sensor_shift_um == 40.0, "the controls show A and move it"
    both.store.update(shown="a")
    qtbot.keyClick(chart, Qt.Key.Key_Right)
    assert both.store.state.optics.sensor_shift_um > 40.0


def test_b_stands_still_while_a_is_dragged(both):
    with both.store.drag():
        both.store.update(field_deg=3.0)
        first = both._answers.b
        both.store.update(field_deg=4.0)
        assert both._answers.b is first
