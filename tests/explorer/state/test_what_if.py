"""What if a coefficient were another: laws of the altered six, textbook pictures, the desk under a person's hands."""

import pickle

import numpy as np
import pytest
from PySide6.QtCore import Qt

from p2sf.errors import GeometryError, SamplingError
from p2sf.psf.seidel import seidel_psf
from p2sf_explorer.charts.painting import set_text
from p2sf_explorer.compute import live as compute
from p2sf_explorer.compute.autofocus import best_shift_um
from p2sf_explorer.compute.reference import measure
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.panels.coefficients.mixer import NUMBER, waves
from p2sf_explorer.scene3d.scene import scene
from p2sf_explorer.state.panels import FOLLOWS, REGISTRY, REMAINS, view_of
from p2sf_explorer.state.state import State, change, entry, new_state
from p2sf_explorer.state.terms import TERMS
from p2sf_explorer.state.what_if import PRESETS, UNTOUCHED, is_altered, of_preset, toggle, with_added
from tests.support.waves import rms

FIELD = new_state(method="fitted", field_deg=7.0)


def six(state) -> dict[str, float]:
    found = paraxial_setup(state).coefficients
    return {term: float(getattr(found, term)) for term in TERMS}


@pytest.mark.parametrize("term", TERMS)
def test_added_waves_go_on_top_of_one_coefficient_and_no_other(term):
    own, added = six(FIELD), six(change(FIELD, added_waves=with_added(FIELD, term, 1.25)))
    assert added == pytest.approx(own | {term: own[term] + 1.25}, abs=1e-12)


def test_a_muted_term_is_zero_and_a_solo_one_alone():
    own = six(FIELD)
    assert six(change(FIELD, muted=("w22",))) == own | {"w22": 0.0}
    assert six(change(FIELD, solo=("w31", "w22"))) == dict.fromkeys(TERMS, 0.0) | {k: own[k] for k in ("w31", "w22")}
    assert set(six(change(FIELD, solo=("w31",), muted=("w31",))).values()) == {0.0}


def test_a_free_pupil_knows_no_lens():
    state = change(FIELD, free_pupil=True, added_waves=(1.0, 0.5, 0.0, 0.0, -1.0, 0.0))
    assert tuple(six(state).values()) == state.what_if.added_waves
    assert six(change(state, field_deg=2.0, lens="cooke_triplet")) == six(state)


@pytest.mark.parametrize("changes", [{"added_waves": (0.0, 0.5, 0.0, 0.0, 0.0, 0.0)}, {"muted": ("w40",)}])
def test_the_picture_is_of_the_altered_six_whatever_the_method(changes):
    live = compute.live(change(FIELD, **changes))
    expected = seidel_psf(live.setup.coefficients, *live.psf.values.shape[:1], live.psf.pixel_um, "settled")
    assert live.psf.method == "seidel"
    assert np.array_equal(live.psf.values, expected.values)
    # The terms of a wavefront of degree four are exact.
    assert live.pupil.rms == pytest.approx(float(rms(live.setup.coefficients)), rel=1e-9)
    assert "coefficients altered by hand" in str(live.warnings[0])
    with pytest.raises(SamplingError, match="does not apply"):
        measure(live, False, None, None)


def test_the_warning_names_every_tab_that_does_not_follow():
    own, other = (compute.live(new_state(method="seidel", added_waves=(w, w, 0.0, 0.0, w, 0.0))) for w in (0.0, 0.5))
    views = {entry.key: view_of(entry) for entry in REGISTRY if view_of(entry)}
    still = {key for key, view in views.items() if pickle.dumps(view(own)) == pickle.dumps(view(other))}
    assert still == {entry.key for entry in REGISTRY if entry.view and entry.by_hand != FOLLOWS}
    named = [str(title) for title in other.warnings[0].values["panels"]]
    assert named == [entry.title for entry in REGISTRY if entry.by_hand == REMAINS]


def test_the_wavefront_in_space_is_the_altered_one():
    """A free pupil with W31 alone: ½ λ ahead at the rim towards the field, ½ λ behind on the other side."""
    state = new_state(free_pupil=True, added_waves=with_added(State(), "w31", 0.5))
    waves = scene(compute.live(state, "preview")).found.front.waves
    assert (waves.max(), waves.min()) == pytest.approx((0.5, -0.5))


def psf_of(words: str):
    preset = next(preset for preset in PRESETS if preset.title.startswith(words))
    return compute.live(new_state(**of_preset(preset))).psf


def test_one_wave_of_defocus_is_dark_on_the_axis():
    values = psf_of("Defocus").values
    assert values[64, 64] < 1e-5 * values.max()  # sinc²(Wd) is 0 at a whole wave; float32 and the nodes leave 1e-6


def test_the_medial_focus_of_astigmatism_is_a_cross():
    values = psf_of("Astigmatism, 1 λ, medial").values[1:, 1:]  # about the centre sample
    assert np.allclose(values, np.rot90(values), atol=1e-5 * values.max())
    assert values[63, 63 + 18] > 3 * values[63 + 13, 63 + 13]  # arms along the axes, as far out as between them


def test_astigmatic_lines_lie_along_and_across_the_field():
    for words, axis in (("Astigmatism, 2 λ, sagittal", 1), ("Astigmatism, 2 λ, tangential", 0)):
        values = psf_of(words).values
        place = np.arange(128) - 64.0
        spread = [float((values.sum(a) * place**2).sum()) for a in (0, 1)]  # variance along x, then along y
        assert spread[axis] > 3 * spread[1 - axis]


def test_coma_moves_the_peak_along_the_field_and_keeps_left_and_right_alike():
    values = psf_of("Coma, ½").values
    row, column = np.unravel_index(values.argmax(), values.shape)
    assert column == 64
    assert row != 64
    assert np.allclose(values[:, 1:], values[:, :0:-1], atol=1e-6 * values.max())


def test_best_focus_of_spherical_has_a_sixteenth_of_the_variance():
    shown = [new_state(**of_preset(p)) for p in PRESETS if p.title.startswith("Spherical, 1 λ")]
    paraxial, best, marginal = (float(rms(paraxial_setup(state).coefficients)) for state in shown)
    assert best == pytest.approx(paraxial / 4)  # 4/45 against 1/180 waves² (Mahajan 1991, table 2-1)
    assert marginal == pytest.approx(paraxial)


@pytest.mark.parametrize("changes", [{"free_pupil": True}, {"muted": ("wd",)}, {"solo": ("w40",)}])
def test_autofocus_refuses_where_the_sensor_moves_nothing(changes):
    with pytest.raises(GeometryError, match="does not focus"):
        best_shift_um(new_state(**changes))


def test_autofocus_of_altered_coefficients_balances_them():
    state = new_state(muted=("w31", "w22", "w20"), field_deg=5.0)
    best = paraxial_setup(change(state, sensor_shift_um=best_shift_um(state))).coefficients
    assert float(best.wd) == pytest.approx(-float(best.w40), abs=0.02)  # the shift is rounded to a nanometre


def test_toggling_keeps_the_order_of_the_terms():
    assert toggle(toggle((), "wd"), "w40") == ("w40", "wd")
    assert toggle(("w40", "wd"), "w40") == ("wd",)


@pytest.fixture
def desk(window):
    return window.panels["coefficients"].bars


def at(desk, term, part):
    return desk.places.handle(TERMS.index(term), part).toPoint()


def test_dragging_a_slider_adds_waves_and_is_one_undo(window, desk, qtbot):
    before = window.live.psf.values
    qtbot.mousePress(desk, Qt.MouseButton.LeftButton, pos=at(desk, "w31", 0.0))
    for part in (0.1, 0.2, 0.3):
        qtbot.mouseMove(desk, at(desk, "w31", part))
        assert window.live.quality == "preview"
    qtbot.mouseRelease(desk, Qt.MouseButton.LeftButton, pos=at(desk, "w31", 0.3))
    added = window.store.state.what_if.added_waves[TERMS.index("w31")]
    assert added == pytest.approx(0.3 * desk.limit, abs=desk.limit / 40)  # a pixel of some 120 of the travel
    assert desk.values["w31"] == pytest.approx(desk.own["w31"] + added)
    assert window.live.quality == "settled"
    assert not np.array_equal(before, window.live.psf.values)
    assert "what-if" in window.panels["psf"].badge.text()
    assert "what-if" in window.panels["pupil"].numbers.text()
    assert "altered by hand" in window.status.warning.text()
    window.store.undo()
    assert not is_altered(window.store.state)
    assert np.array_equal(before, window.live.psf.values)


@pytest.mark.parametrize("kind", ["muted", "solo"])
def test_the_buttons_mute_and_solo(window, desk, qtbot, kind):
    place = desk.places.button(TERMS.index("w22"), kind).center().toPoint()
    qtbot.mouseClick(desk, Qt.MouseButton.LeftButton, pos=place)
    assert entry(window.store.state, kind) == ("w22",)
    qtbot.mouseClick(desk, Qt.MouseButton.LeftButton, pos=place)
    assert not is_altered(window.store.state)


def test_the_keyboard_reaches_every_row(window, desk, qtbot):
    desk.setFocus()
    desk.choose(0)
    for row, term in enumerate(TERMS):
        qtbot.keyClick(desk, Qt.Key.Key_Right)
        assert window.store.state.what_if.added_waves[row] > 0
        qtbot.keyClick(desk, Qt.Key.Key_Delete)
        qtbot.keyClick(desk, Qt.Key.Key_M)
        assert window.store.state.what_if.muted == (term,)
        qtbot.keyClick(desk, Qt.Key.Key_M)
        qtbot.keyClick(desk, Qt.Key.Key_Down)
    assert not is_altered(window.store.state)


def test_a_coefficient_can_be_typed_and_nonsense_is_a_sentence(window, desk, qtbot):
    qtbot.mouseClick(desk, Qt.MouseButton.LeftButton, pos=desk.places.number(1).center().toPoint())
    assert desk.edit.isVisible()
    qtbot.keyClicks(desk.edit, "-0,5")
    qtbot.keyClick(desk.edit, Qt.Key.Key_Return)
    assert not desk.edit.isVisible()
    assert desk.values["w31"] == pytest.approx(-0.5, abs=1e-6)
    before = window.store.state
    qtbot.keyClick(desk, Qt.Key.Key_Return)
    qtbot.keyClicks(desk.edit, "much")
    qtbot.keyClick(desk.edit, Qt.Key.Key_Return)
    assert window.store.state == before
    assert "much" in window.banner.text.text()


def test_presets_and_reset(window, qtbot):
    panel = window.panels["coefficients"]
    for preset, action in zip(PRESETS, panel.presets.menu().actions(), strict=True):
        action.trigger()
        assert panel.bars.values == pytest.approx(dict.fromkeys(TERMS, 0.0) | preset.waves)
    qtbot.mouseClick(panel.reset, Qt.MouseButton.LeftButton)
    assert {name: entry(window.store.state, name) for name in UNTOUCHED} == UNTOUCHED
    assert not panel.reset.isEnabled()


@pytest.mark.parametrize(
    ("value", "words"), [(-5.5, "−5.50 λ"), (-15.91, "−15.9 λ"), (560.44, "560 λ"), (-5606.4, "−5606 λ")]
)
def test_a_large_coefficient_is_no_longer_than_its_column(qapp, value, words):
    assert waves(value) == words
    assert set_text(words, 13).size().width() <= NUMBER


def test_where_the_warning_has_no_room_it_ends_with_a_clause_and_not_within_a_word(window):
    window.store.update(added_waves=(0.5, 0.0, 0.0, 0.0, 0.0, 0.0))
    line = window.status.warning
    line.resize(500, line.height())
    assert line._cut() == "⚠ What-if: coefficients altered by hand …" and "Depth of field" in line.toolTip()
