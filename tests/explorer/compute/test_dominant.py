"""What the window says blurs most: shares of the wavefront's variance, and advice that fits them."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.messages import Message
from p2sf.paraxial.wavefront import wavefront
from p2sf_explorer.compute.pupil import disc, dominant, strongest, variance_parts
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.compute.warnings import NEARER, TOGETHER, remedy
from p2sf_explorer.state.state import State, new_state

ZERO = replace(paraxial_setup(State()).coefficients, w40=0.0, w31=0.0, w22=0.0, w20=0.0, wd=0.0, w11=0.0)


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
        (new_state(lens="wide_angle_35"), "spherical aberration", NEARER),
        (new_state(depth_mm=1500.0), "defocus", TOGETHER),
    ],
)
def test_the_advice_fits_what_is_said_to_blur_most(state, words, advice):
    made = paraxial_setup(state)
    blur = dominant(made.coefficients)
    assert blur.template.startswith("Mostly {term}: ") and blur.values["term"] == Message(words)
    assert remedy(made) == advice
