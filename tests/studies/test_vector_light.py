"""Vector light: the sum over rays against the integrals of an aplanatic lens, and where scalar light ends."""

import numpy as np
import pytest

from p2sf.conventions import centred_axis
from p2sf.disc.quadrature import disc_nodes
from p2sf.figures.compare import r_squared
from p2sf.lens.lens import Aperture, Lens, Surface, with_f_number
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.methods import render
from p2sf.psf.prediction import VECTOR_NA
from p2sf.studies.vector_light import (
    aplanatic_field,
    boundary_na,
    polarisations,
    scalar_error,
    vector_intensity,
    vector_psf,
)


@pytest.mark.parametrize("na", [0.3, 0.5, 0.7, 0.85, 0.95])
def test_the_sum_over_rays_is_the_aplanatic_integrals(na):
    """Amplitude 1/√cos θ over the sines; the nodes resolve a few λ/NA to rounding, 1e-6 is asked."""
    nodes = disc_nodes(120, 160)
    kx, ky = (na * np.concatenate(pair) for pair in ((nodes.xi, -nodes.xi), (nodes.eta, nodes.eta)))
    cosines = np.stack([kx, ky, np.sqrt(1 - kx**2 - ky**2)])
    light = np.tile(nodes.weight, 2) / np.sqrt(cosines[2])
    axis = centred_axis(9, 0.4 / na)
    found = vector_intensity(light, (kx, ky), polarisations(cosines, np.array([0.0, 0.0, 1.0])), axis)
    wanted = aplanatic_field(na, np.hypot(axis, axis[:, None]).ravel()).unpolarised.reshape(found.shape)
    # 1/√cos θ has a steep end at the rim, where Gauss–Legendre in the sine squared converges last.
    assert np.abs(found / found.max() - wanted / wanted.max()).max() < 1e-6


def test_polarisations_stay_at_right_angles_to_each_other_and_to_the_ray():
    rng = np.random.default_rng(3)
    cosines = rng.normal(size=(3, 20))
    cosines[2] = np.abs(cosines[2]) + 1
    cosines /= np.linalg.norm(cosines, axis=0)
    chief = np.array([0.1, 0.3, np.sqrt(0.9)])
    one, other = polarisations(cosines, chief)
    for product in (one * other, one * cosines, other * cosines):
        assert np.abs(product.sum(0)).max() < 1e-14
    assert (one * one).sum(0) == pytest.approx(1) == (other * other).sum(0)


def test_scalar_light_ends_at_the_stated_aperture():
    """1 − R² rises as the fourth power of the aperture, so that 5 % of it are a fifth of 1 − R²."""
    assert boundary_na() == pytest.approx(VECTOR_NA, rel=0.01)
    assert scalar_error(0.95 * VECTOR_NA) < 1e-3 < scalar_error(1.05 * VECTOR_NA)
    assert scalar_error(0.2) / scalar_error(0.1) == pytest.approx(16, rel=0.1)


@pytest.mark.slow
def test_a_slow_lens_needs_no_vectors_and_an_aberrated_fast_one_does():
    source = Source(field_deg=5)
    slow = find_lens("cooke_triplet")
    vector, scalar = vector_psf(slow, source, 32, 1.0), render(slow, source, "huygens", 32, 1.0)
    assert vector.method == "vector" and 1 - r_squared(scalar.values, vector.values) < 1e-3
    thin = Surface(thickness=20.0, ideal_focal_length=20.0)
    fast = with_f_number(Lens((thin,), Aperture("f_number", 1.0), 1), 0.7)
    vector, scalar = vector_psf(fast, Source(), 32, 0.2), render(fast, Source(), "huygens", 32, 0.2)
    assert 1 - r_squared(scalar.values, vector.values) > 1e-3
