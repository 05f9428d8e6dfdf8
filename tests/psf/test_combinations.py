"""Some of the random states of ``python -m tests.long.combinations``, and laws that its sums by brute force obey."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import j1

from p2sf.disc.mask import PupilMask
from tests.long import combinations
from tests.long.combinations import rendered, state_of, table, verdict
from tests.long.method_choice import random_mask
from tests.support.brute_force import brute_force, mask_light, mask_opens, of_six
from tests.support.tiers import in_tiers
from tests.support.waves import NA, WAVELENGTH_UM, mirrored, waves

pytestmark = pytest.mark.filterwarnings("ignore::p2sf.errors.P2SFWarning")  # of light beyond the window
QUICK = 2, 3, 13, 16, 19, 32  # one of each method but gaussian, clipped, misaligned, freeform and refused ones


@pytest.mark.parametrize("number", in_tiers(range(36), QUICK))
def test_a_random_state_gives_the_sum_of_its_pupil_or_a_sentence(number):
    found = verdict(state_of(1, number))
    assert found.good and not found.unjudged, found


@pytest.mark.parametrize("spoilt", [mirrored, lambda values: np.roll(values, 1, axis=1), lambda values: values**1.2])
def test_a_wrong_picture_is_found(monkeypatch, spoilt):
    state, psf = state_of(1, 3), rendered(state_of(1, 3))
    monkeypatch.setattr(combinations, "rendered", lambda state: replace(psf, values=spoilt(psf.values)))
    found = verdict(state)
    assert not found.good and found.own > combinations.ALLOWED
    assert table([found]).count("\n") == len(combinations.METHODS)


@pytest.mark.parametrize("dark", [0.0, 0.6])
def test_brute_force_gives_the_pattern_of_a_ring(dark):
    """That of a disc less that of a smaller one, 2J₁(v)/v each (Born & Wolf 1999, §8.6.2)."""
    pixels, pixel_um = 24, 0.6
    axis = (np.arange(pixels) - pixels // 2) * pixel_um
    v = 2 * np.pi * NA / WAVELENGTH_UM * np.hypot(axis, axis[:, None]) + 1e-9
    pattern = (j1(v) - (dark * j1(dark * v))) ** 2 / v**2
    mask = PupilMask(obscuration=dark)
    sums, sure = brute_force(of_six(waves(), mask), mask, pattern / pattern.sum(), pixel_um)
    assert sure and np.abs(sums / sums.max() - pattern / pattern.max()).max() < 2e-3  # of fields that are known to 1e-3


def test_masks_are_what_their_numbers_say():
    rng = np.random.default_rng(5)
    xi, eta = rng.uniform(-0.7, 0.7, (2, 2000))
    for _ in range(30):
        mask = random_mask(rng)
        light = mask.amplitude(xi, eta) * np.exp(2j * np.pi * mask.path_um(xi, eta) / 0.55)
        assert np.abs(light - mask_light(mask, xi, eta, 0.55)).max() < 1e-9
        assert np.array_equal(mask.opens(xi, eta), mask_opens(mask, xi, eta))
