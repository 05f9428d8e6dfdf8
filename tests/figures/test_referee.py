"""The referee of MTF, energy and aiming judged by closed forms, by the stored witness and by its own second road."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.interpolate import CubicSpline
from scipy.special import j0

from p2sf.glass.media import ConstantIndex
from p2sf.lens.lens import Aperture, Lens, Surface
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from tests.support.pupil_sums import Pupil, field_at, on_grid, phase_and_frequency, pupil_of, ray_sum
from tests.support.rays.skew_rays import system_of, through_paraxial_pupil, through_stop
from tests.support.reference import case, huygens_rows
from tests.support.waves import relative_l2

CELLS = 512
CLOSED_FORM = 3e-4  # of 512 cells across the pupil; it falls with the square of their number
CUT_OFF = 200.0  # cycles per mm


def disc(waves: float) -> Pupil:
    """Return a uniform disc with a defocus of so many waves at its rim."""
    half = CUT_OFF / 2 * 1.001
    phase, across, density = np.zeros((3, 3)), np.zeros((3, 3)), np.zeros((3, 3))
    rho2 = waves * 1.001**2  # u² = (T0 + T2)/2 in units of the box, which is a little wider than the rim
    phase[0, 0], phase[2, 0], phase[0, 2] = rho2, rho2 / 2, rho2 / 2
    across[1, 0], density[0, 0] = 1.0, 1.0
    turn = np.linspace(-np.pi, np.pi, 9)
    rim = CubicSpline(turn, np.full(9, 1 / 1.001), bc_type="periodic")
    return Pupil(half, phase, across, across.T.copy(), density, rim, 2 * waves, 0.0)


def defocused_energy(waves: float, radius_um: np.ndarray) -> np.ndarray:
    """Return the energy within each radius by a Hankel sum: U(v) = 2∫exp(i2πWρ²)J0(vρ)ρdρ, E = ∫|U|²v dv/2."""
    node, weight = leggauss(400)
    rho, share = (node + 1) / 2, weight / 2
    pupil = 2 * np.exp(2j * np.pi * waves * rho**2) * rho * share
    high = 2 * np.pi * CUT_OFF / 2 / 1000 * radius_um
    v = high[:, None] * rho
    intensity = np.abs(j0(v[..., None] * rho) @ pupil) ** 2
    return (intensity * v * share).sum(-1) * high / 2


@pytest.mark.parametrize("waves", [0.0, 1.5, 8.0])
def test_energy_and_contrast_of_a_disc(waves):
    """Energy against a Hankel sum, contrast against Hopkins's integral (1955); Goodman 2005, eq. 6-31, in focus."""
    found = on_grid(disc(waves), CELLS, False)
    radius = np.array([1.0, 4.0, 10.0, 40.0])
    np.testing.assert_allclose([found.energy(r) for r in radius], defocused_energy(waves, radius), atol=CLOSED_FORM)
    nu = found.frequency[:: CELLS // 16] / CUT_OFF
    # the overlap of two discs a distance 2ν apart: ∫ chord·exp(i2πW·4νx) dx, over half the discs' common width
    node, weight = leggauss(200)
    x = (1 - nu[:, None]) * node
    chord = np.sqrt(np.maximum(1 - (np.abs(x) + nu[:, None]) ** 2, 0))
    hopkins = ((1 - nu[:, None]) * weight * 2 * chord * np.cos(2 * np.pi * waves * 4 * nu[:, None] * x)).sum(-1) / np.pi
    for along in (found.x, found.y):
        np.testing.assert_allclose(np.abs(along[:: CELLS // 16]), np.abs(hopkins), atol=CLOSED_FORM)


def test_energy_is_about_the_centroid():
    """Of a pupil with coma, whose light lies aside, against the plain sum over a picture around its centroid."""
    pupil, waves = disc(0.0), 1.5
    phase = np.zeros((4, 4))
    # v(u² + v²) = v/2·(2 + T2(u) + T2(v)), v·T2(v) = (T3 + T1)/2, in units of the box
    phase[0, 1], phase[2, 1], phase[0, 3] = 1.25, 0.5, 0.25
    pupil = replace(pupil, phase=waves * 1.001**3 * phase)
    found, pitch = on_grid(pupil, CELLS, False), 0.5
    axis = (np.arange(160) - 79.5) * pitch
    # minus the mean slope of the phase over the disc, ⟨∂(ρ³cos θ)/∂η⟩ = ⟨ρ² + 2η²⟩ = 1
    assert found.centroid_um == pytest.approx(-waves / (CUT_OFF / 2) * 1000, rel=1e-3)
    picture = np.abs(field_at(pupil, axis, axis + found.centroid_um, CELLS)) ** 2
    flat = np.abs(field_at(replace(pupil, phase=np.zeros((1, 1))), np.zeros(1), np.zeros(1), CELLS)).item() ** 2
    share = picture / flat * pitch**2 * np.pi * (CUT_OFF / 2 / 1000) ** 2  # peak of a perfect disc: area/λ²f²
    distance = np.hypot(axis, axis[:, None])
    for radius in (10.0, 20.0, 35.0):
        assert found.energy(radius) == pytest.approx(
            share[distance <= radius].sum(), abs=3e-3
        )  # the circle's jagged rim


@pytest.mark.parametrize("name", ["asphere", "cooke_triplet", "eye_navarro", "relay"])
def test_its_rays_are_those_of_the_witness(name):
    """The witness's PSFs were converged by two tracers of their own; 600 cells across the pupil are to 1e-3."""
    for row, stored, _ in huygens_rows(name)[:2]:
        lens, source = case(name, row)
        axis = (np.arange(32) - 16) * row["pixel_um"]
        found = np.abs(field_at(pupil_of(lens, source, "paraxial"), axis, axis, 600)) ** 2
        assert relative_l2(found / found.sum(), stored / stored.sum()) < 1e-3


def test_a_stigmatic_surface_has_no_phase():
    """A conicoid with K = −(n/n′)² sends collimated light to one point exactly (Descartes 1637)."""
    index, radius = 1.5, 20.0
    lens = Lens(
        (Surface(radius, radius * index / (index - 1), ConstantIndex(index), -1 / index**2),),
        Aperture("stop_semi_diameter", 8.0),
        1,
    )
    system = system_of(lens, 0.5)
    for fill in (through_paraxial_pupil, through_stop):
        rays = fill(system, Source(inf, 0.0, 0.5), np.linspace(0, 0.9, 7), np.linspace(-0.4, 0.4, 7))
        chief = fill(system, Source(inf, 0.0, 0.5), np.zeros(1), np.zeros(1))
        phase, _ = phase_and_frequency(system, rays, chief)
        assert np.abs(phase).max() < 1e-9 and np.hypot(rays.x, rays.y).max() < 1e-13


@pytest.mark.parametrize(
    ("name", "field", "depth", "aim"),
    [("cooke_triplet", 20, inf, "stop"), ("periskop", 30, 1000.0, "stop"), ("telephoto", 10, inf, "paraxial")],
)
def test_its_two_roads_are_one(name, field, depth, aim):
    """Polynomials over frequency against the plain sum over rays: some 1e-3 with 500 cells; it falls as 1/cells²."""
    lens = find_lens(name)
    source = Source(depth, float(np.tan(np.deg2rad(field))), lens.reference_wavelength_um)
    axis = np.linspace(-12, 12, 25)
    by_rays = np.abs(ray_sum(lens, source, aim, axis, axis, 500).field) ** 2
    by_grid = np.abs(field_at(pupil_of(lens, source, aim), axis, axis, 500)) ** 2
    assert relative_l2(by_grid / by_grid.sum(), by_rays / by_rays.sum()) < 2e-3
