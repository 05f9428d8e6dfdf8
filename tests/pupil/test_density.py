"""The density of rays over spatial frequency against differences of exact rays, and what its error says."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.disc.quadrature import disc_nodes
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.pixel_kernels.frequency_grid import pupil_map
from p2sf.psf.measures import energy_in, mtf_of, parts_of
from p2sf.pupil import frequency_pupil
from p2sf.pupil.clear_curves import clear_curve
from p2sf.pupil.frequency_pupil import FrequencyPupil, pupil_of_rays
from p2sf.raytrace.pencil import pencil
from tests.support.tiers import in_tiers

POINT = Source(field_deg=17.1)
STEP = 1e-4  # of the pupil: central differences are then good to 1e-6, with rays aimed to 1e-10
FINE_STEP = 1e-5  # where frequencies go like a root: good to 1e-5, and 1e-4 would be good to 5e-4 only


def built(seed: int, apart: float = 0.12) -> Lens:
    """Return a Tessar whose radii and thicknesses are off by so much, which spoils the map from stop to frequency."""
    lens, draw = find_lens("tessar"), np.random.default_rng(seed).normal
    surfaces = (
        replace(s, radius=s.radius * (1 + apart * draw()), thickness=s.thickness * (1 + apart * draw()))
        for s in lens.surfaces
    )
    return replace(lens, surfaces=tuple(surfaces))


def crowding(
    lens: Lens, xi: np.ndarray, eta: np.ndarray, source: Source = POINT, step: float = STEP
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return fx, fy, and weight over ∂(fx, fy)/∂(ξ, η) by differences of exact rays."""
    here, left, right, below, above = (
        pencil(lens, source, xi + a * step, eta + b * step) for a, b in ((0, 0), (-1, 0), (1, 0), (0, -1), (0, 1))
    )
    across, along = ((one.fx - two.fx, one.fy - two.fy) for one, two in ((right, left), (above, below)))
    area = (across[0] * along[1] - across[1] * along[0]) / (2 * step) ** 2
    return here.fx, here.fy, here.amplitude / area


def density_error(pupil: FrequencyPupil, weight: np.ndarray, rays: tuple[np.ndarray, ...]) -> float:
    """Return the RMS error of the amplitude over the light of the waves, up to a common factor.

    ``rays``: as `crowding` gives them at nodes of these weights.
    """
    fx, fy, true = rays
    x, y = np.abs(fx) / pupil.half_x, (fy - pupil.middle_y) / pupil.half_y
    given = np.polynomial.chebyshev.chebval2d(y, x, pupil.density)
    light = weight * np.abs(true)  # D²df = D·weight·dξdη
    ratio = given / np.abs(true)
    ratio /= (light @ ratio) / light.sum()
    return float(np.sqrt(light @ (ratio - 1) ** 2 / light.sum()))


@pytest.mark.parametrize("seed", [8, 39, 66])
def test_the_residual_knows_how_far_the_density_is_off(seed):
    """Where the pupil nearly folds, rays crowd so that a polynomial that follows the phase misses the density."""
    lens = built(seed)
    pupil, nodes = pupil_of_rays(lens, POINT), disc_nodes(16, 40)
    assert (
        density_error(pupil, nodes.weight, crowding(lens, nodes.xi, nodes.eta))
        < 2 * 2 * np.pi * pupil.residual_waves + 1e-5
    )


@pytest.mark.parametrize(
    ("name", "degrees", "clip"),
    in_tiers(
        [("petzval", 12.0, True), ("petzval", 10.0, False), ("cooke_triplet", 28.0, False), ("tessar", 32.0, False)],
        [("petzval", 12.0, True)],
    ),
)
def test_rays_that_graze_a_surface_have_their_density(name, degrees, clip):
    """Where rays are lost the frequencies go like a root over the stop: contrast was off by 0.15 to 0.4 there.

    An amplitude off by δ RMS changes contrast by √2·δ at most, and contrast is asked to be good to 2e-3.
    """
    lens, source = find_lens(name), Source(field_deg=degrees)
    nodes = clear_curve(lens, source, clip).nodes((60, 90))
    rays = crowding(lens, nodes.xi, nodes.eta, source, FINE_STEP)
    assert density_error(pupil_of_rays(lens, source, clip), nodes.weight, rays) < 2e-3 / np.sqrt(2)


def test_a_pupil_that_folds_is_refused():
    lens, nodes = built(33), disc_nodes(60, 120)
    area = crowding(lens, 0.999 * nodes.xi, 0.999 * nodes.eta)[2]
    assert area.min() < 0 < area.max()
    with pytest.raises(GeometryError):
        pupil_of_rays(lens, POINT)


@pytest.mark.parametrize(("degrees", "folds"), [(25.0, False), (29.0, True)])
def test_kernels_refuse_a_pupil_that_folds(degrees, folds):
    """At 29° rays of 0.3 % of the phone's pupil turn back, and its kernel was off by half from sums of exact rays."""
    lens, source, nodes = find_lens("phone_f28"), Source(field_deg=degrees), disc_nodes(30, 60)
    area = crowding(lens, nodes.xi, nodes.eta, source)[2]
    assert (area.min() < 0 < area.max()) == folds
    if not folds:
        assert len(pupil_map(lens, source, "fitted")) == 1
        return
    with pytest.raises(GeometryError, match="arrive in one direction"):
        pupil_map(lens, source, "fitted")


def test_a_pupil_that_folds_is_refused_before_the_higher_orders(monkeypatch):
    tried = []

    def through(nodes, order, *more, own=frequency_pupil._through):
        tried.append(order)
        return own(nodes, order, *more)

    monkeypatch.setattr(frequency_pupil, "_through", through)
    with pytest.raises(GeometryError):
        pupil_of_rays(built(33), POINT)
    assert max(tried) == frequency_pupil.JUDGED_AT


@pytest.mark.parametrize("method", ["fitted", "seidel"])
def test_the_predicted_error_bounds_that_of_contrast_and_energy(method):
    lens, source = find_lens("double_gauss_28"), Source(field_deg=10.0)
    exact, told = parts_of(lens, source, "traced"), parts_of(lens, source, method)
    contrast, light = mtf_of(*exact), energy_in(*exact)
    assert contrast.note is None and light.note is None and "error" not in repr(contrast) + repr(light)
    other, energy = mtf_of(*told, contrast.frequency_per_mm), energy_in(*told, light.radius_um)
    off = np.abs(other.tangential - contrast.tangential).max(), np.abs(energy.fraction - light.fraction).max()
    assert 1e-4 < max(off) <= other.predicted_error == energy.predicted_error
    for found in (other, energy):
        assert found.note.values["error"] == found.predicted_error and "error" in repr(found)
