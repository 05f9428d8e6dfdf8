"""PSFs of misaligned lenses: laws of symmetry, folds, and rays of a tracer in space."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from p2sf.disc.zernike import basis
from p2sf.glass.media import MIRROR
from p2sf.lens.lens import Surface, seen_from
from p2sf.lens.misalignment import displaced, folding, with_tilted_sensor
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.fitted import fitted_psf
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import render
from p2sf.psf.traced import traced_psf
from p2sf.pupil.fit import NOT_SYMMETRIC, SLOPE_WEIGHT, fit, fit_rays, level_rays
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.raytrace.aiming import pupil_rays
from p2sf.raytrace.pencil import hexapolar, pencil
from tests.long.misaligned_methods import ASKED_OF_TRACED, outcomes
from tests.support.rays.made_rays import made_rays
from tests.support.rays.space_rays import fly, poses

WINDOW = 33, 1.0  # an odd count is its own mirror image
FOLD = 1e-9  # relative L2: what two routes to one pupil map leave


@pytest.fixture(scope="module")
def gauss():
    return find_lens("double_gauss_28")


@pytest.fixture(scope="module")
def bad(gauss):
    tilted = displaced(gauss, 3, 5, Placement(0.1, 0.2, 0.02, 0.3, 0.2))
    return with_tilted_sensor(tilted, Placement(tilt_x_deg=0.1, tilt_y_deg=0.2))


def distance(one, two) -> float:
    return float(np.linalg.norm(one.values - two.values) / np.linalg.norm(two.values))


def test_a_fold_leaves_the_psf_unchanged(gauss):
    before = 0.4 * gauss.sensor_mm
    last, source = replace(gauss.surfaces[-1], thickness=before), Source(field_deg=10)
    straight = huygens_psf(gauss, source, *WINDOW)
    for tilt in (Placement(tilt_x_deg=45.0), Placement(tilt_x_deg=-20.0, tilt_y_deg=30.0, tilt_z_deg=15.0)):
        mirror = Surface(inf, before - gauss.sensor_mm, MIRROR, **folding(tilt))
        folded = replace(gauss, surfaces=(*gauss.surfaces[:-1], last, mirror))
        assert distance(huygens_psf(folded, source, *WINDOW), straight) < FOLD


def test_phase_and_direction_are_those_of_a_tracer_in_space(bad):
    """The phase is (OPL ray − OPL chief − n′K·(I − C))/λ by points and directions in space."""
    source, (xi, eta) = Source(field_deg=(6, 8)), hexapolar(2)
    azimuth = np.deg2rad(source.azimuth_deg)
    back = np.array([[np.cos(azimuth), np.sin(azimuth), 0], [-np.sin(azimuth), np.cos(azimuth), 0], [0, 0, 1]])
    rays = pupil_rays(seen_from(bad, source.azimuth_deg), source, np.append(xi, 0.0), np.append(eta, 0.0))
    origins, along = rays.origins @ back.T, rays.directions @ back.T
    flights = [fly(bad, *ray, source.wavelength_um) for ray in zip(origins, along, strict=True)]
    chief = flights[-1]
    # From the wavefront of the source to the point of launch, the rest that `fly` does not know.
    start = (origins - origins[-1]) @ along[-1]
    wave_mm = source.wavelength_um / 1000
    expected = [
        (f.path + s - chief.path - f.direction @ (f.points[-1] - chief.points[-1])) / wave_mm
        for f, s in zip(flights[:-1], start, strict=False)
    ]
    found = pencil(bad, source, xi, eta)
    assert found.phase == pytest.approx(expected, abs=1e-8)
    axes = poses(bad)[-1].turn.inv()
    local = np.array([back.T @ axes.apply(f.direction) for f in flights])
    assert found.kx == pytest.approx(local[:-1, 0], abs=1e-13) and found.chief_kx == pytest.approx(local[-1, 0])
    assert found.ky == pytest.approx(local[:-1, 1], abs=1e-13)
    landed = np.array([back.T @ axes.apply(f.points[-1] - chief.points[-1]) for f in flights])
    assert found.dx == pytest.approx(landed[:-1, 0], abs=1e-12)
    assert found.dy == pytest.approx(landed[:-1, 1], abs=1e-12)


def test_a_decentre_to_the_other_side_mirrors_the_psf(gauss):
    left, right = (displaced(gauss, 3, 5, Placement(x, 0.1, 0, 0.2, y)) for x, y in ((-0.2, -0.3), (0.2, 0.3)))
    one, two = (huygens_psf(lens, Source(field_deg=10), *WINDOW).values for lens in (left, right))
    assert np.linalg.norm(one - two[:, ::-1]) < 1e-7 * np.linalg.norm(two)
    assert np.linalg.norm(two - two[:, ::-1]) > 0.05 * np.linalg.norm(two), "the PSF has no symmetry"


def test_what_a_decentre_in_y_does_to_a_field_in_y_one_in_x_does_to_a_field_in_x(gauss):
    up, aside = (displaced(gauss, 3, 5, Placement(*shift)) for shift in ((0.0, 0.2), (0.2, 0.0)))
    one = huygens_psf(up, Source(field_deg=10), *WINDOW)
    two = huygens_psf(aside, Source(field_deg=(10, 0)), *WINDOW)
    assert distance(two, one) < 1e-8


def test_traced_is_the_reference_to_a_part_in_ten_thousand(bad):
    source = Source(field_deg=(6, 8))
    reference, traced = huygens_psf(bad, source, *WINDOW), traced_psf(bad, source, *WINDOW)
    spread = np.square(reference.values - reference.values.mean()).sum()
    assert 1 - np.square(reference.values - traced.values).sum() / spread > 0.9999


def test_rims_end_a_pupil_that_is_not_even(gauss):
    """The clear share, and its middle, are those of many rays."""
    source, tilted = Source(field_deg=14), displaced(gauss, 1, 3, Placement(1.5, 0.5))
    xi, eta = hexapolar(50)
    passed = pencil(tilted, source, xi, eta, clip=True).passed
    nodes = pupil_nodes(tilted, source, (24, 60), clip=True)
    assert not nodes.domain.symmetric and 0.2 < nodes.share < 0.95
    assert nodes.share == pytest.approx(passed.mean(), abs=0.005)
    assert nodes.weight @ nodes.xi == pytest.approx(xi[passed].mean(), abs=0.005)


def test_seidel_is_the_lens_set_straight_and_says_so(gauss, bad):
    moved = displaced(gauss, 3, 5, Placement(decentre_z=0.02))  # along the axis, which keeps it straight
    straight, tilted = (render(lens, Source(field_deg=5), "seidel") for lens in (moved, bad))
    assert tilted.values == pytest.approx(straight.values, abs=1e-15)
    assert "aligned lens, without its tilts" in str(tilted.sampling)


def test_methods_keep_their_promises_on_random_misalignments():
    """300 points are tried by ``python -m tests.long.misaligned_methods``."""
    for point in outcomes(4, seed=5):
        assert not point.broken and point.traced > ASKED_OF_TRACED, point
        assert point.fitted > 1 - point.predicted, point


def test_a_fit_without_symmetry_is_that_of_symmetry_where_there_is_one(gauss, bad):
    """A sphere turned about its own centre has no terms that symmetry forbids."""
    turned = displaced(
        gauss, 1, 1, Placement(tilt_x_deg=2.0, tilt_y_deg=1.0, pivot=(0.0, 0.0, gauss.surfaces[0].radius))
    )
    assert turned.misaligned
    found, level = fit(turned, Source(field_deg=10), NOT_SYMMETRIC[1].numbers), NOT_SYMMETRIC[1]
    phase, fx, fy = (some.counts[0] for some in (level.basis.phase, level.basis.fx, level.basis.fy))
    of_phase, of_fx, of_fy, _ = level.coefficients(found.function)
    largest = np.abs(of_phase).max()
    assert np.abs(of_phase[phase:]).max() < 1e-4 * largest
    assert np.abs(of_fx[fx:]).max() + np.abs(of_fy[fy:]).max() < 1e-5 * np.abs(of_fx).max()
    real, *_ = level.coefficients(fit(bad, Source(field_deg=10), level.numbers).function)
    assert np.abs(real[phase:]).max() > 1e-2 * largest


def test_the_area_over_frequencies_of_a_fit_without_symmetry(bad):
    """∂(fx, fy)/∂(ξ, η) by central differences of the fit itself: a second-order error of 1e-4²."""
    found = fit(bad, Source(field_deg=10), NOT_SYMMETRIC[1].numbers)
    xi, eta, step = np.array([0.3, -0.5, 0.1]), np.array([0.2, 0.6, -0.7]), 1e-4
    at = found.function.at
    _, *across, _ = at(xi + step, eta) - at(xi - step, eta)
    _, *along, _ = at(xi, eta + step) - at(xi, eta - step)
    expected = (across[0] * along[1] - across[1] * along[0]) / (2 * step) ** 2
    assert found.jacobian(xi, eta) == pytest.approx(expected, rel=1e-6)


def test_traced_by_a_few_rays_is_the_reference(bad):
    source = Source(field_deg=(3, 4))
    traced = traced_psf(bad, source, *WINDOW)
    assert traced.rays < 1500
    assert distance(traced, huygens_psf(bad, source, *WINDOW)) < 1e-3


def test_the_rays_of_every_fit_without_symmetry_tell_all_its_terms_apart():
    """With as many rays on every ring the least singular value was rounding, 1e-16 of the largest."""
    for level in NOT_SYMMETRIC:
        xi, eta, weight = level_rays(level)
        used = slice(0, weight.size)
        rows = [basis(level.basis.wave_order, xi[used], eta[used], flag) for flag in (False, True)]
        stacked = np.concatenate(rows)
        if level.by_slopes:  # by central differences, weighted as in the fit; they grow with the degree
            stacked = np.concatenate([stacked, *(SLOPE_WEIGHT * part for part in slopes_of_all_terms(level))], axis=1)
        counted = np.tile(weight, stacked.shape[1] // weight.size)
        assert np.linalg.cond(stacked * np.sqrt(counted)) < (12 if level.by_slopes else 4)
        assert weight.size == level.radii * level.directions
        assert weight.sum() == pytest.approx(1.0) and weight @ (xi[used] ** 2 + eta[used] ** 2) == pytest.approx(0.5)


def slopes_of_all_terms(level, step=1e-5):
    """Return ∂/∂ξ and ∂/∂η of all terms of a level's phase at its rays, (2, terms, rays)."""
    xi, eta, weight = level_rays(level)
    at = np.stack([xi, eta])[:, : weight.size]

    def terms(points):
        return np.concatenate([basis(level.basis.wave_order, *points, odd) for odd in (False, True)])

    return [(terms(at + move) - terms(at - move)) / (2 * step) for move in step * np.eye(2)[..., None]]


def test_64_rays_tell_a_phase_of_order_ten_by_where_they_land():
    """Rays of a made-up pupil, phase and map polynomials in plain powers: dw = −x·df gives the places."""
    level, rng = NOT_SYMMETRIC[1], np.random.default_rng(4)
    powers = [(a, b) for a in range(11) for b in range(11 - a)]
    share = rng.normal(size=len(powers)) / [1 + a + b for a, b in powers]

    def phase(xi, eta):
        return sum(c * xi**a * eta**b for c, (a, b) in zip(share, powers, strict=True))

    xi, eta, _ = level_rays(level)
    across = sum(c * a * xi ** max(a - 1, 0) * eta**b for c, (a, b) in zip(share, powers, strict=True))
    along = sum(c * b * xi**a * eta ** max(b - 1, 0) for c, (a, b) in zip(share, powers, strict=True))
    fx, fy = 0.2 * xi + 0.01 * eta + 0.03 * xi * eta**2, 0.19 * eta - 0.02 * xi**2
    turn = np.array([[0.2 + 0.03 * eta**2, -0.04 * xi], [0.01 + 0.06 * xi * eta, np.full_like(xi, 0.19)]])
    x, y = np.linalg.solve(np.moveaxis(turn, -1, 0), -np.stack([across, along], -1)[..., None])[..., 0].T
    found = fit_rays(made_rays(phase(xi, eta), fx, fy, x, y), level, 64)
    at = hexapolar(6)
    assert xi.size == 64 and found.function.at(*at)[0] == pytest.approx(phase(*at), abs=1e-9)
    assert found.error_waves < 1e-9


def test_64_rays_describe_a_wide_field_of_a_misaligned_lens():
    """With as many rays on every ring, and order 5 of the terms that symmetry forbids, R² was 0.982."""
    lens = displaced(find_lens("double_gauss_28"), 3, 5, Placement(0.2, -0.15, 0, 0.4, 0.5))
    source = Source(field_deg=(6.0, 11.0))
    found = fitted_psf(lens, source, 48, 2.0, NOT_SYMMETRIC[1].numbers)
    reference = huygens_psf(lens, source, 48, 2.0, 1e-3)
    assert found.rays == 64
    spread = np.square(reference.values - reference.values.mean()).sum()
    assert 1 - np.square(reference.values - found.values).sum() / spread > 0.994
