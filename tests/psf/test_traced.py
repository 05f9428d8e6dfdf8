"""The traced method: exact rays, interpolated over the pupil, against stored witnesses and the reference."""

from pathlib import Path

import numpy as np
import pytest

from p2sf.errors import Cancelled, SamplingError
from p2sf.figures.compare import r_squared
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.fitted import fitted_psf
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.traced import traced_psf
from p2sf.pupil.rays import RayPupil
from p2sf.pupil.smooth_pupil import interpolated_waves
from p2sf.pupil.watch import Watch
from p2sf.raytrace.pencil import pencil
from tests.support.reference import LENSES, cases

STEEP_RIM = Path(__file__).parents[1] / "data" / "steep_rim.toml"


@pytest.mark.parametrize("name", LENSES)
def test_traced_equals_the_witness(name):
    for lens, source, pixel, stored in cases(name):
        settled, preview = (traced_psf(lens, source, 32, pixel, quality) for quality in ("settled", "preview"))
        assert r_squared(settled.values, stored) >= 0.9999
        assert r_squared(preview.values, stored) >= 0.999


def test_clipped_rays_take_the_references_nodes():
    lens, source, pixel, _ = list(cases("double_gauss_28"))[2]
    clip = True
    traced, reference = (
        traced_psf(lens, source, 32, pixel, "settled", clip),
        huygens_psf(lens, source, 32, pixel, clip=clip),
    )
    assert r_squared(traced.values, reference.values) > 0.9999


@pytest.mark.parametrize("quality", ["settled", "preview"])
def test_rays_one_by_one_can_be_stopped(quality):
    lens, source, pixel, _ = list(cases("double_gauss_28"))[2]
    with pytest.raises(Cancelled):
        traced_psf(lens, source, 32, pixel, quality, True, Watch(cancelled=lambda: True))


@pytest.mark.parametrize("name", LENSES)
def test_a_few_rays_tell_what_all_would(name):
    """Phase, direction and light at every node, interpolated and traced: within the bound seen on the rim."""
    for lens, source, pixel, _ in cases(name):
        reach = 23 * pixel
        counts = RayPupil(lens, source).counts(reach)
        few = interpolated_waves(lens, source, counts, reach)
        if few is None:
            continue
        every = RayPupil(lens, source).sample(counts, reach).waves
        spread = np.abs(every.amplitude).max()
        assert np.abs(few.waves.amplitude - every.amplitude).max() < 2 * np.pi * 2e-4 * spread
        assert np.abs(few.waves.fx - every.fx).max() * reach < 2e-4


@pytest.mark.parametrize("method", [fitted_psf, traced_psf])
def test_a_blur_beyond_all_nodes_is_refused_in_words(method):
    lens, source, _, _ = next(cases("double_gauss_28"))
    with pytest.raises(SamplingError) as refused:
        method(lens, source, 64, 1e4)
    assert refused.value.message.values["width"] == pytest.approx(64e4)


def test_some_hundred_rays_do():
    lens, source, pixel, _ = list(cases("double_gauss_28"))[1]
    assert traced_psf(lens, source, 32, pixel).rays < 300


@pytest.mark.parametrize("name", ["cooke_triplet", "double_gauss_28", "eye_navarro"])
def test_all_light_is_the_sum_of_a_picture_that_holds_it(name):
    """The share of the light in a window so wide that what is outside is small: it tends to 1 as 1/width."""
    lens, source, pixel, _ = next(cases(name))
    shares = [traced_psf(lens, source, count, pixel).energy for count in (64, 128, 256, 512)]
    outside = 1 - np.array(shares)
    assert (outside > 0).all() and (np.diff(outside) < 0).all()
    # The wings behind a sharp edge fall as the cube of the distance, so that twice the width leaves half of the light.
    assert 2 * shares[3] - shares[2] == pytest.approx(1, abs=2e-3)


def plane_waves_of_rays(lens, source, axis_um):
    """Return the intensity of unit sum, (y, x): Gauss–Legendre in ρ, not in ρ², 140 radii × 320 directions of rays."""
    place, weight = np.polynomial.legendre.leggauss(140)
    rho, theta = (1 + place) / 2, np.arange(320) * (2 * np.pi / 320)
    xi, eta = (np.outer(rho, turn).ravel() for turn in (np.sin(theta), np.cos(theta)))
    rays, light = pencil(lens, source, xi, eta), np.repeat(weight * rho, 320)
    across, up = (np.exp(2j * np.pi * np.outer(f, axis_um)) for f in (rays.fx, rays.fy))
    wave = light * rays.amplitude * np.exp(2j * np.pi * rays.phase)
    intensity = np.abs((wave[:, None] * up).T @ across) ** 2
    return intensity / intensity.sum()


@pytest.mark.parametrize("psf_of", [traced_psf, fitted_psf])
def test_a_rim_steeper_than_its_directions_tell_is_resolved(psf_of):
    """Aspheres bend the map at the rim, where ∂f/∂ρ is nine times f/ρ: by f/ρ there were too few nodes, L2 4.6e-2."""
    lens, source = find_lens(STEEP_RIM), Source(7.71415511, float(np.tan(np.deg2rad(10.36758145))), 0.8990575157)
    found = psf_of(lens, source, 32, 7.045)
    exact = plane_waves_of_rays(lens, source, found.x_um)
    missed = np.linalg.norm(found.values - exact) / np.linalg.norm(exact)
    # The picture misses what its sum does, at most `error`, and what the pupil does, which is little for rays.
    assert missed < found.error + np.sqrt(found.predicted_error)
    assert psf_of is fitted_psf or missed < found.error
