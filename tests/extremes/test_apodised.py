"""Pupils of uneven amplitude: the plain sums take any, so they are held to closed forms and to each other.

The methods fill a pupil evenly, or up to its rims; whoever brings an amplitude gives it to the sums with the weights.
"""

from math import factorial

import numpy as np
import pytest
from scipy.special import jv

from p2sf.conventions import centred_axis
from p2sf.disc.quadrature import chord_rows, disc_nodes
from p2sf.disc.transform import matrix_dft, padded_fft, sum_plane_waves
from p2sf.pupil.plane_waves import pupil_amplitude

SCALE = 0.3  # cycles per µm at the rim
AXIS = centred_axis(33, 0.4)
RADIUS = np.hypot(*np.meshgrid(AXIS, AXIS))
ROUND_OFF = 1e-13  # of the peak: some thousand terms of size 1/thousand
APODISED = {
    "even": lambda xi, eta: np.ones_like(xi),
    "gaussian": lambda xi, eta: np.exp(-2 * (xi**2 + eta**2)),
    "oblique": lambda xi, eta: np.sqrt(np.clip(1 - 0.6 * eta, 0, None)),  # cos⁴ falls off across a wide pencil
    "cat's eye": lambda xi, eta: (np.hypot(xi, eta - 0.7) < 1.0).astype(float),
}


def field_of(amplitude, phase=None, counts=(48, 96)) -> np.ndarray:
    """Return the field of an apodised disc on the axis' grid, in units of the even one's peak."""
    nodes = disc_nodes(*counts)
    waves = np.zeros_like(nodes.xi) if phase is None else phase(nodes.xi, nodes.eta)
    weighted = pupil_amplitude(nodes.weight * amplitude(nodes.xi, nodes.eta), waves)
    return sum_plane_waves(weighted, SCALE * nodes.xi, SCALE * nodes.eta, AXIS, AXIS)


@pytest.mark.parametrize("power", [0, 1, 2, 5])
def test_a_pupil_that_fades_as_a_power_has_its_bessel_function(power):
    """The mean of (1 − ρ²)^k·exp(iv·ξ) over the disc is 2^(k+1)·k!·J_(k+1)(v)/v^(k+1) (Sonine's first integral)."""
    v = 2 * np.pi * SCALE * RADIUS
    safe = np.where(v > 0, v, 1.0)
    bessel = 2 ** (power + 1) * factorial(power) * jv(power + 1, safe) / safe ** (power + 1)
    found = field_of(lambda xi, eta: (1 - xi**2 - eta**2) ** power)
    np.testing.assert_allclose(found, np.where(v > 0, bessel, 1 / (power + 1)), rtol=0, atol=ROUND_OFF)


def test_a_gaussian_beam_stays_one():
    """exp(−aρ²), e⁻²⁰ at the rim, transforms to exp(−v²/4a)/a: the tail that is cut off is all the error."""
    a = 20.0
    expected = np.exp(-((2 * np.pi * SCALE * RADIUS) ** 2) / (4 * a)) / a
    found = field_of(lambda xi, eta: np.exp(-a * (xi**2 + eta**2)))
    np.testing.assert_allclose(found, expected, rtol=0, atol=np.exp(-a))


@pytest.mark.parametrize("name", APODISED)
@pytest.mark.parametrize("waves", [0.0, 3.0, 100.0])
def test_all_the_light_of_an_apodised_pupil_is_somewhere(name, waves):
    """Parseval over a whole period: Σ|field|² = period²·Σ|amplitude|², whatever the phase; to 1e-10."""
    pupil, period = pupil_grid(name, waves), 160
    plane = padded_fft(pupil, 2 * period, period)
    axis = np.arange(2 * period) - period
    whole = np.abs(matrix_dft(pupil, *[frequencies(pupil, 2 * period)] * 2, axis, axis)) ** 2
    light = (2 * period) ** 2 * (np.abs(pupil) ** 2).sum()
    inside = slice(period // 2, -(period // 2))
    outside = whole.sum() - whole[inside, inside].sum()
    assert abs(((np.abs(plane) ** 2).sum() + outside) / light - 1) < 1e-10


@pytest.mark.parametrize("name", APODISED)
def test_fft_and_matrix_dft_of_an_apodised_pupil_are_one(name):
    """On one grid they are one sum: they agree to rounding, which a sampled rim's 5e-3 would hide."""
    pupil = pupil_grid(name, 20.0)
    k, axis = frequencies(pupil, 256), np.arange(48) - 24
    by_fft, by_matrix = padded_fft(pupil, 256, 48), matrix_dft(pupil, k, k, axis, axis)
    plain = sum_plane_waves(pupil.ravel(), np.tile(k, k.size), np.repeat(k, k.size), axis, axis, even=False)
    light = np.abs(pupil).sum()
    for other in (by_matrix, plain):
        np.testing.assert_allclose(by_fft, other, rtol=0, atol=ROUND_OFF * light)


@pytest.mark.parametrize("name", ["even", "gaussian", "oblique"])
def test_rows_and_radii_agree_on_an_apodised_pupil(name):
    """Two rules without a node in common; a smooth amplitude leaves both as exact as an even one."""
    rows = chord_rows(96, 96)
    eta = np.concatenate([rows.eta, -rows.eta])
    xi, weight = np.tile(rows.xi, (2, 1)), np.tile(rows.weight, (2, 1)) / 2
    eta = np.broadcast_to(eta[:, None], xi.shape)
    amplitude = pupil_amplitude(weight * APODISED[name](xi, eta), coma(xi, eta)).ravel()
    axis = centred_axis(33, 0.4)
    by_rows = sum_plane_waves(amplitude, SCALE * xi.ravel(), SCALE * eta.ravel(), axis, axis)
    np.testing.assert_allclose(by_rows, field_of(APODISED[name], coma), rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", APODISED)
def test_an_apodised_picture_is_as_symmetric_as_its_pupil(name):
    """Every amplitude here is even in ξ; those even in η too, under an even phase, give a picture even in both."""
    found = np.abs(field_of(APODISED[name], lambda xi, eta: 5 * (xi**2 + eta**2) ** 2 + 3 * eta**2)) ** 2
    np.testing.assert_allclose(found, found[:, ::-1], rtol=0, atol=1e-13)
    if name in ("even", "gaussian"):
        np.testing.assert_allclose(found, found[::-1], rtol=0, atol=1e-13)
    else:
        real = np.abs(field_of(APODISED[name])) ** 2  # of a real pupil the picture is even whatever its shape
        np.testing.assert_allclose(real, real[::-1, ::-1], rtol=0, atol=1e-13)
        assert np.abs(found - found[::-1]).max() > 1e-3 * found.max()


def coma(xi, eta):
    return 2 * (xi**2 + eta**2) * eta + (xi**2 + eta**2) ** 2


def pupil_grid(name: str, waves: float) -> np.ndarray:
    """Return an apodised pupil of a steep phase on 64² cells of a square."""
    axis = (np.arange(64) - 32) / 32
    xi, eta = np.meshgrid(axis, axis)
    return np.where(np.hypot(xi, eta) < 1, APODISED[name](xi, eta), 0) * np.exp(2j * np.pi * waves * coma(xi, eta))


def frequencies(pupil: np.ndarray, samples: int) -> np.ndarray:
    """Return the cycles per sample of the columns of a pupil among so many."""
    return (np.arange(pupil.shape[-1]) - pupil.shape[-1] // 2) / samples
