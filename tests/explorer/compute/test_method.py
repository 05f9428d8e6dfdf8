"""Which method makes the picture, how it is sampled, and why: from the data, with nothing read out of a sentence."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import RectBivariateSpline

from p2sf.psf import spherical
from p2sf.psf.choosing import choose
from p2sf.psf.methods import psf_of
from p2sf.pupil.rays import RayPupil
from p2sf_explorer.compute.deferred_sums import ComparisonRequest, SumCache, answer_to
from p2sf_explorer.compute.finer import CRITICAL, ShownArea, finer, source
from p2sf_explorer.compute.finer import answer as render_finer
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.method import choice_for_state
from p2sf_explorer.compute.setup import default_state, paraxial_setup, with_lens
from p2sf_explorer.compute.warnings import remedy
from p2sf_explorer.state.state import State, change, new_state
from tests.long import window_states
from tests.long.window_states import against_huygens, outcomes, summary

SHARP = new_state(method="auto", field_deg=0.0, f_number=16.0)
CORNER = change(with_lens(State(), "double_gauss_28"), method="auto", field_deg=14.0, f_number=None, clip=True)


@pytest.mark.parametrize(
    ("state", "method"),
    [
        (SHARP, "seidel"),
        (change(SHARP, field_deg=10.0, f_number=8.0, tolerance=0.998), "traced"),
        (CORNER, "traced"),
    ],
)
def test_the_reason_names_the_method_that_the_library_chose(state, method):
    setup = paraxial_setup(state)
    choice = choose(setup.lens, setup.source, state.optics.tolerance, state.optics.clip)
    answer = live(state)
    assert choice_for_state(state, setup) == choice
    assert answer.method == choice.method == answer.why.values["method"] == method
    assert answer.why.values["reason"] == choice.reason


def test_a_person_who_chose_is_given_no_reason():
    assert str(live(change(SHARP, method="seidel"), "preview").why) == ""


ISSUED = [
    ("fast_gauss_f14", {"field_deg": 0.0}, "auto", "traced"),
    ("fast_gauss_f14", {"field_deg": 0.0}, "huygens", "huygens"),
    ("petzval", {"field_deg": 0.0}, "auto", "traced"),
    ("petzval", {"field_deg": 0.0}, "fitted", "fitted"),
    ("double_gauss_28", {"field_deg": 19.9}, "auto", "traced"),
    ("wide_angle_35", {"field_deg": 21.0}, "auto", "traced"),
]


@pytest.mark.parametrize(("lens", "optics", "method", "shown"), ISSUED)
def test_waves_are_summed_where_seidel_coefficients_are_steep(lens, optics, method, shown):
    """These have up to 250 waves of slope, and hundreds by their six coefficients."""
    answer = live(change(default_state(lens), method=method, **optics))
    assert answer.psf.method == shown and answer.refused is None
    assert against_huygens(answer) > 0.99


def test_samples_are_close_enough_to_add_up_to_the_light():
    """No farther apart than λ/2NA, or the most that there are: then their sum is an integral."""
    for lens, optics, method, _ in ISSUED:
        if method == "auto":
            answer = live(change(default_state(lens), method=method, **optics))
            assert 0.8 < answer.psf.energy <= 1 + 1e-6, lens


@pytest.mark.parametrize("method", ["fitted", "traced", "huygens"])
def test_a_chosen_method_that_is_impossible_says_why_and_what_to_do(method):
    state = change(default_state("double_gauss_28"), depth_mm=10.0, method=method)
    answer = live(state, views={"psf": source}, cache=SumCache())
    said = str(answer.views["psf"].why)
    assert said.startswith(method) and "pupil samples" in said and "to see waves" in said and "auto" in said
    assert not any("ray density" in str(warning) for warning in answer.warnings)
    left = live(change(state, method="auto"), views={"psf": source}, cache=SumCache())
    assert (left.psf.method, left.views["psf"].found, left.refused) == ("geometric", None, None)


def test_six_coefficients_of_many_waves_are_waited_for():
    state = change(default_state("petzval"), field_deg=0.0, method="seidel")
    cache = SumCache()
    answer = live(state, cache=cache)
    assert answer.psf.method == "geometric" and answer.pending.six == answer.setup.coefficients
    cache.keep(answer.pending, psf_of(answer.pending))
    followed = live(state, cache=cache)
    assert followed.psf.method == "seidel" and followed.psf.predicted_error > 0.01


def test_what_is_altered_by_hand_predicts_nothing():
    state = new_state(method="seidel", field_deg=0.0, f_number=8.0)
    assert live(state).psf.predicted_error is not None
    assert live(change(state, added_waves=(1.0, 0.0, 0.0, 0.0, 0.0, 0.0))).psf.predicted_error is None


def test_finer_samples_are_those_of_the_same_picture():
    """A blur whose samples are too coarse for the eye: what is summed in their place passes through them."""
    answer = live(new_state(method="fitted", field_deg=5.0), views={"psf": source})
    found, airy, psf = answer.views["psf"].found, answer.airy_radius_um, answer.psf
    reach = 0.4 * psf.pixel_um * len(psf.values)
    request = finer(found, ShownArea(reach, 0.2), airy)
    samples, pitch = request.window
    assert samples * pitch >= 2 * reach and pitch <= 1.2 * CRITICAL * airy < psf.pixel_um
    fine = render_finer(request, lambda: False, lambda share, so_far: None)
    between = RectBivariateSpline(fine.y_um, fine.x_um, fine.over_unaberrated)
    inside = np.abs(psf.x_um) < fine.x_um[-4]
    seen = between(psf.y_um[inside], psf.x_um[inside])
    true = psf.over_unaberrated[np.ix_(inside, inside)]
    np.testing.assert_allclose(seen, true, atol=5e-3 * true.max())  # of the cubic spline through critical samples


def test_a_finer_picture_is_asked_for_only_where_the_eye_needs_it():
    answer = live(new_state(method="fitted", field_deg=2.0, f_number=8.0), views={"psf": source})
    found, airy, psf = answer.views["psf"].found, answer.airy_radius_um, answer.psf
    half = psf.pixel_um * len(psf.values) / 2
    assert psf.pixel_um < CRITICAL * airy
    assert finer(found, ShownArea(0.9 * half, 0.01 * airy), airy) is None, "cosines through these samples are the light"
    wider = finer(found, ShownArea(1.5 * half, 0.01 * airy), airy).window
    assert wider[0] * wider[1] >= 3 * half, "the square would end within the view"
    coarse = replace(found, most=64)
    assert finer(coarse, ShownArea(100 * half, 0.01 * airy), airy).window[0] == 64


SPHERICAL = replace(paraxial_setup(SHARP).coefficients, w40=np.float64(9.0))


def test_on_the_axis_nobody_is_sent_nearer_to_it():
    state = SHARP
    for field, words in ((0.0, "stop down to see waves"), (10.0, "stop down or go nearer the axis to see waves")):
        coefficients = replace(paraxial_setup(change(state, field_deg=field)), coefficients=SPHERICAL)
        assert str(remedy(coefficients)) == words


def test_waves_of_rays_too_steep_for_paraxial_coefficients_are_explained():
    """Near the front focus the coefficients show some hundred waves and the pupil thousands."""
    answer = live(change(default_state("double_gauss_28"), depth_mm=30.0, method="auto"), cache=SumCache())
    found = [w for w in answer.warnings if "these are paraxial" in str(w)]
    assert len(found) == 1 and answer.pupil.peak_to_valley > 2 * float(str(found[0].values["six"]))
    assert not any("these are paraxial" in str(w) for w in live(SHARP).warnings)


@pytest.mark.slow
def test_random_pictures_of_the_window_are_those_of_huygens_or_say_ray_density(capsys, monkeypatch):
    """The short form of ``python -m tests.long.window_states``, against samples that lie closer where rays are many."""
    monkeypatch.setattr(window_states, "MOST_PRODUCTS", window_states.MOST_PRODUCTS / 16)
    found = list(outcomes(8, seed=3))
    with capsys.disabled():
        print("\n" + summary(found))
    assert not [one for one in found if one.wrong]


def test_a_choice_that_takes_long_waits_for_a_worker_and_is_that_of_the_library():
    """The comparison of two sums of waves that it takes held the window up for a second at every step."""
    state, cache, asked = change(with_lens(State(), "fast_gauss_f14"), field_deg=6.9, method="auto"), SumCache(), []
    answer = live(state, cache=cache)
    while answer.pending:
        asked.append(answer.pending)
        cache.keep(answer.pending, answer_to(answer.pending))
        made = spherical._compare_sums.cache_info().misses
        answer = live(state, cache=cache)
        assert spherical._compare_sums.cache_info().misses == made, "no comparison is made within a frame"
    setup = paraxial_setup(state)
    assert isinstance(asked[0], ComparisonRequest) and asked[0] not in asked[1:]
    assert answer.method == choose(setup.lens, setup.source, state.optics.tolerance).method
    np.testing.assert_array_equal(answer.psf.values, live(state).psf.values)


def test_no_rim_is_followed_within_a_frame(monkeypatch):
    """Where rays are lost it takes 300 pencils to count the nodes of a comparison: 2.7 s of the window's thread."""

    def count(*asked):
        raise AssertionError("the nodes are counted within the frame")

    monkeypatch.setattr(RayPupil, "counts", count)
    answer = live(change(with_lens(State(), "fast_gauss_f14"), field_deg=29.9, method="auto"), cache=SumCache())
    assert isinstance(answer.pending, ComparisonRequest) and answer.psf.values.sum() > 0
