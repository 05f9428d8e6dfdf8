"""What the window says blurs most: shares of the wavefront's variance, and advice that fits them."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.messages import Message
from p2sf.paraxial.balance import strongest, variance_parts
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.wavefront_map import WavefrontMap, disc, map_of, wavefront_of_coefficients
from p2sf.raytrace.pencil import displayed_opd, pencil, pupil_grid
from p2sf_explorer.compute.caption import caption
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.pupil import dominant, pupil_of
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.compute.warnings import NEARER, TOGETHER, remedy
from p2sf_explorer.state.state import State, change, new_state
from tests.support.waves import rms_about_plane

ZERO = replace(paraxial_setup(State()).coefficients, w40=0.0, w31=0.0, w22=0.0, w20=0.0, wd=0.0, w11=0.0)


@pytest.mark.parametrize("f_number", [16.0, 32.0])
def test_a_diffraction_limited_lens_has_one_rms_in_sentence_and_caption(f_number):
    found = live(new_state(f_number=f_number, field_deg=0.0))
    sentence, said = str(found.dominant), caption(found)["rms"]
    assert sentence == f"Diffraction-limited: {said}"
    assert float(said.split()[1]) == pytest.approx(found.pupil.rms, rel=0.05)  # two digits


@pytest.mark.parametrize("seed", range(4))
def test_the_shares_add_up_to_the_variance_of_the_wavefront(seed):
    six = np.random.default_rng(seed).normal(size=5) * 3
    coefficients = replace(ZERO, **dict(zip(("w40", "w31", "w22", "w20", "wd"), map(float, six), strict=True)))
    xi, eta, inside = disc(400)
    waves = np.asarray(wavefront(coefficients, xi, eta))[inside]
    tilt = (waves @ eta[inside]) / (
        eta[inside] @ eta[inside]
    )  # coma counts beyond its tilt, which only moves the image
    rest = waves - tilt * eta[inside]
    # A grid of squares misses the disc's edge by a share of 1/400 or so.
    assert sum(variance_parts(coefficients).values()) == pytest.approx(rest.var(), rel=0.01)


@pytest.mark.parametrize(
    ("waves", "term"),
    [
        ({"w40": 3.0}, "w40"),
        ({"w31": 1.0}, "w31"),
        ({"w22": 2.0, "w20": -1.0}, "w22"),
        ({"w20": 2.0}, "w20"),
        ({"wd": -2.0}, "wd"),
        ({"w40": 5.0, "wd": -2.9}, "w40"),  # a focus that undoes part of the blur is not its cause
        ({"w40": 1.0, "wd": 4.0}, "wd"),
    ],
)
def test_the_term_named_is_the_one_that_blurs(waves, term):
    assert strongest(replace(ZERO, **waves)) == term


def test_what_pulls_against_the_blur_has_no_share_of_it():
    parts = variance_parts(replace(ZERO, w40=5.0, wd=-2.9))
    assert parts["wd"] == 0 and parts["w40"] == pytest.approx(5**2 / 180 + 2.1**2 / 12)


@pytest.mark.parametrize(
    ("state", "words", "advice"),
    [
        (new_state(lens="wide_angle_35"), Message("coma"), NEARER),
        (new_state(depth_mm=1500.0), None, TOGETHER),
    ],
)
def test_the_advice_fits_what_is_said_to_blur_most(state, words, advice):
    setup = paraxial_setup(state)
    blur = dominant(pupil_of(setup, True, "settled"), setup.coefficients)
    assert blur.values.get("term") == words
    assert remedy(paraxial_setup(state)) == advice


@pytest.mark.parametrize(
    ("state", "causes"),
    [
        (new_state(field_deg=0.0), ("W40",)),
        (new_state(field_deg=14.0), ("W20", "W40")),
        pytest.param(new_state(depth_mm=1500.0, field_deg=0.0), ("Wd",), marks=pytest.mark.slow),
        (new_state(lens="telephoto", field_deg=7.0, aim="paraxial"), None),
        (new_state(free_pupil=True, added_waves=(2.0, 0.0, 0.0, -2.0, 1.0, 0.0)), ("W40", "Wd")),
    ],
)
def test_what_refocusing_would_remove_has_causes_that_need_not_be_defocus(state, causes):
    """The Double Gauss is in focus on its axis, Wd = 0, and yet a shift of the sensor would take 94 % away."""
    answer = live(state)
    assert answer.dominant.values["percent"] > 25 and answer.dominant.values.get("causes") == causes


TELEPHOTO = {"defocus": 30, "secondary spherical aberration": 28, "coma": 23, "trefoil": 14, "spherical aberration": 0}


@pytest.mark.parametrize("quality", ["preview", "settled"])
def test_the_headline_is_made_of_the_wavefront_that_makes_the_picture(quality):
    """The telephoto at 7°: shares of a dense grid of rays (tests/raytrace/test_zernike_fit.py)."""
    state = new_state(lens="telephoto", field_deg=7.0, aim="paraxial")
    answer = live(state, quality)
    pupil = answer.pupil
    total = sum(pupil.parts.values()) + pupil.rest
    for name, percent in TELEPHOTO.items():
        assert 100 * pupil.parts[name] / total == pytest.approx(percent, abs=0.6), name  # rounded to whole percents
    assert "term" not in answer.dominant.values, "it is what refocusing would remove"
    assert answer.dominant.values["percent"] == pytest.approx(30, abs=1)
    seidel = live(change(state, method="seidel"), quality)
    assert seidel.dominant.values["percent"] > 80  # the six coefficients make another picture here


@pytest.mark.parametrize("method", ["seidel", "fitted"])
@pytest.mark.parametrize("quality", ["preview", "settled"])
def test_the_shares_add_up_to_the_rms_without_tilt(method, quality):
    answer = live(new_state(field_deg=9.0, method=method), quality)
    _, eta, inside = disc(len(answer.pupil.waves))
    waves, eta = answer.pupil.waves[inside], eta[inside]
    waves = waves - waves.mean()
    without_tilt = waves - (waves @ eta) / (eta @ eta) * eta
    # A grid of squares misses the disc's edge by a share of 1/128 or so.
    assert sum(answer.pupil.parts.values()) == pytest.approx(without_tilt.var(), rel=0.01)
    assert answer.pupil.rms == pytest.approx(without_tilt.std(), rel=0.01)


@pytest.mark.parametrize(("lens", "field"), [("petzval", 7.0), ("fast_gauss_f14", 22.0), ("double_gauss_28", 14.0)])
@pytest.mark.parametrize(("quality", "error"), [("preview", 0.02), ("settled", 0.006)])
def test_with_clip_the_pupil_and_its_figures_end_at_the_rims(lens, field, quality, error):
    """Against rays on a grid of 300², kept where they pass; its all-or-nothing edge is wrong by half a cell."""
    state = new_state(lens=lens, field_deg=field, clip=True)
    setup = paraxial_setup(state)
    pupil = pupil_of(setup, True, quality, clip=True)
    xi, eta, inside = pupil_grid(300)
    passed = pencil(setup.lens, setup.source, xi[inside], eta[inside], clip=True).passed
    xi, eta = xi[inside][passed], eta[inside][passed]
    waves = displayed_opd(setup.lens, setup.source, xi, eta)
    assert pupil.clear == pytest.approx(passed.mean(), abs=0.006)
    assert pupil.rms == pytest.approx(rms_about_plane(waves, xi, eta), rel=error)
    assert pupil.peak_to_valley == pytest.approx(np.ptp(waves), rel=4 * error)  # at a corner of the outline
    x, y, _ = disc(len(pupil.waves))
    known = np.isfinite(pupil.waves)
    assert known.mean() == pytest.approx(np.pi / 4 * passed.mean(), abs=0.06)  # and a pixel beyond
    assert np.abs(np.hypot(*pupil.outline)).max() <= 1 + 1e-9
    assert (
        not pencil(setup.lens, setup.source, x[~known], y[~known], clip=True).passed[np.hypot(x, y)[~known] < 1].any()
    )


def test_the_outline_is_where_rays_begin_to_be_stopped():
    state = new_state(lens="fast_gauss_f14", field_deg=22.0, clip=True)
    setup = paraxial_setup(state)
    outline = pupil_of(setup, True, "settled", clip=True).outline
    inner, outer = (pencil(setup.lens, setup.source, *(outline * part), clip=True).passed for part in (0.998, 1.002))
    within = np.hypot(*(1.002 * outline)) < 1
    # Scaled about the pupil's centre, which lies inside; near a corner the rim is as steep as the scaling.
    assert inner.mean() > 0.98 and not outer[within].any()


def test_the_six_coefficients_know_no_rims():
    state = new_state(lens="fast_gauss_f14", field_deg=22.0, clip=True, method="seidel")
    pupil = live(state, "preview").pupil
    assert pupil.clear == 1 and pupil.kind == "six coefficients"


def test_lost_rays_leave_a_pupil_of_the_others():
    state = new_state(field_deg=35.0, aim="paraxial")  # whose rays miss; those of the stop arrive
    setup = paraxial_setup(state)
    xi, eta, inside = pupil_grid(200)
    passed = pencil(setup.lens, setup.source, xi[inside], eta[inside]).passed
    assert not passed.all()
    pupil = pupil_of(setup, True, "settled")
    waves = displayed_opd(setup.lens, setup.source, xi[inside], eta[inside])[passed]
    assert pupil.clear == pytest.approx(passed.mean(), abs=0.01) and pupil.clear < 1
    assert pupil.rms == pytest.approx(
        rms_about_plane(waves, xi[inside][passed], eta[inside][passed]), rel=0.01
    )  # a grid of 200 squares and an all-or-nothing edge


@pytest.mark.parametrize(("rms", "limited"), [(0.0396, True), (0.0713, True), (0.0715, False)])
def test_below_marechals_limit_nothing_is_to_be_removed(rms, limited):
    """λ/14, a Strehl ratio of 0.8; 0.0396 λ has 0.94."""
    waves = WavefrontMap(np.zeros((2, 2)), rms, 0.2, "exact rays", parts={"defocus": rms**2})
    values = dominant(waves, live(new_state(method="seidel")).setup.coefficients).values
    assert ("rms" in values) == limited and ("percent" in values) != limited


@pytest.mark.parametrize("sign", [1, -1])
def test_astigmatism_alone_is_said_to_be_a_third_defocus(sign):
    """W22·η² is W22/2·ρ² and W22/2·(η² − ξ²): variances W22²/48 and W22²/24 (Mahajan 1991, table 2-1)."""
    setup = live(new_state(method="seidel")).setup
    alone = replace(ZERO, w22=float(sign))
    waves = map_of(setup.lens, setup.source, wavefront_of_coefficients(alone, "settled"), "settled")
    values = dominant(waves, alone).values
    assert str(values["term"]) == "astigmatism" and values["percent"] == pytest.approx(200 / 3, abs=0.5)
    assert str(values["other"]) == "defocus by W22" and values["more"] == pytest.approx(100 / 3, abs=0.5)
