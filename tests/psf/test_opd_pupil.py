"""Figures of a wavefront on a grid against closed forms and integrals over the continuous pupil."""

from math import pi

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import j0, j1

import p2sf
from p2sf.disc.quadrature import cell_areas
from p2sf.disc.zernike_terms import zernike_terms, zernike_values
from p2sf.errors import P2SFError, RequestError
from p2sf.figures.energy import POINTS_AT_ONCE

NA, NM = 0.1, 500.0
PER_UM = NA / (NM / 1000)  # cycles per µm at the rim
SIZE = 128
AT = (2 * np.arange(SIZE) + 1 - SIZE) / SIZE
X, Y = np.meshgrid(AT, AT)
RADII = np.array([0.5, 2.0, 3.05, 6.0, 12.0])


def spherical(x, y):
    return 0.35 * (x * x + y * y) ** 2 - 0.3 * (x * x + y * y)


def coma(x, y):
    return 0.4 * (x * x + y * y) * y + 0.25 * x * x - 0.3 * y


def contrast(wave, nu: float, along_y: bool) -> float:
    """Return |OTF| at a share of the cut-off by Gauss–Legendre sums over the overlap of two discs."""
    node, weight = np.polynomial.legendre.leggauss(80)
    across = np.sqrt(1 - nu * nu) * node
    half = np.sqrt(1 - across**2) - nu
    along = half[:, None] * node
    area = np.sqrt(1 - nu * nu) * weight[:, None] * half[:, None] * weight
    shifted = [(across[:, None], along + part) if along_y else (along + part, across[:, None]) for part in (nu, -nu)]
    first, second = (wave(*place) for place in shifted)
    return abs((area * np.exp(2j * pi * (first - second))).sum()) / pi


def energy(radius_um: float) -> float:
    """Return the share of the light of `spherical` within a radius, by its Hankel transform."""

    def light(v: float) -> float:
        parts = (quad(lambda r: f(2 * pi * spherical(r, 0.0)) * j0(v * r) * r, 0, 1)[0] for f in (np.cos, np.sin))  # noqa: B023
        return v * sum((2 * part) ** 2 for part in parts) / 2

    return quad(light, 0, 2 * pi * PER_UM * radius_um, limit=200)[0]


def test_an_ideal_pupil_has_the_contrast_and_the_energy_of_airy():
    pupil = p2sf.Pupil.from_opd(np.zeros((SIZE, SIZE)), NA, NM)
    nu = np.linspace(0, 1, 41)
    exact = 2 / pi * (np.arccos(nu) - nu * np.sqrt(1 - nu * nu))
    found = pupil.mtf(nu * 2000 * PER_UM)
    for curve in (found.tangential, found.sagittal, found.perfect_tangential, found.clear_sagittal):
        np.testing.assert_allclose(curve, exact, atol=1e-12)
    v = 2 * pi * PER_UM * RADII
    light = pupil.encircled_energy(RADII)
    assert light.predicted_error < 1e-3
    np.testing.assert_allclose(light.fraction, 1 - j0(v) ** 2 - j1(v) ** 2, atol=light.predicted_error)
    assert pupil.strehl == pytest.approx(1, abs=1e-9) and pupil.zernike().marechal == 1


@pytest.mark.parametrize("wave", [spherical, coma])
def test_contrast_is_the_overlap_of_two_pupils(wave):
    pupil = p2sf.Pupil.from_opd(wave(X, Y), NA, NM)
    nu = np.array([0.05, 0.2, 0.5, 0.8])
    found = pupil.mtf(nu * 2000 * PER_UM)
    for curve, along_y in ((found.tangential, True), (found.sagittal, False)):
        np.testing.assert_allclose(curve, [contrast(wave, one, along_y) for one in nu], atol=found.predicted_error)


def test_energy_is_that_of_the_hankel_transform():
    found = p2sf.Pupil.from_opd(spherical(X, Y), NA, NM).encircled_energy(RADII)
    np.testing.assert_allclose(found.fraction, [energy(radius) for radius in RADII], atol=found.predicted_error)
    assert energy(found.radius_50_um) == pytest.approx(0.5, abs=found.predicted_error)
    assert energy(found.radius_80_um) == pytest.approx(0.8, abs=found.predicted_error)
    rays = quad(lambda r: ((1.4 * r**3 - 0.6 * r) / PER_UM) ** 2 * 2 * r, 0, 1)[0] ** 0.5
    assert found.rms_um == pytest.approx(rays, rel=0.02)  # slopes between cells end up to 1/64 before the rim


def test_energy_and_lines_are_those_of_fine_samples():
    """Sums of a PSF in a wide window share neither the autocorrelation nor Bessel functions."""
    pupil = p2sf.Pupil.from_opd(coma(X, Y), NA, NM)
    fine = pupil.psf(512, 0.2)
    assert fine.energy > 0.98
    light, lines = pupil.encircled_energy([2.0, 5.0, 9.0]), pupil.line_spread([-3.0, 0.0, 1.5, 4.0])
    x, y = fine.x_um - light.centroid_x_um, fine.y_um - light.centroid_um
    distance = np.hypot(x, y[:, None])
    counted = [(fine.values * np.clip((radius - distance) / 0.2 + 0.5, 0, 1)).sum() for radius in (2.0, 5.0, 9.0)]
    np.testing.assert_allclose(light.fraction, fine.energy * np.array(counted), atol=2e-3)
    for own, edge, axis, at in ((lines.line_x, lines.edge_x, 0, x), (lines.line_y, lines.edge_y, 1, y)):
        line = fine.energy * fine.values.sum(axis) / 0.2
        np.testing.assert_allclose(own, np.interp(lines.position_um, at, line), atol=0.02 * own.max())
        assert (np.diff(edge) > 0).all()


def test_a_tilt_moves_the_centroid_and_nothing_else():
    still, moved = (p2sf.Pupil.from_opd(spherical(X, Y) + tilt, NA, NM) for tilt in (0.0, 0.8 * X - 0.5 * Y))
    one, other = (pupil.encircled_energy(RADII) for pupil in (still, moved))
    assert other.centroid_x_um == pytest.approx(-0.8 / PER_UM) and other.centroid_um == pytest.approx(0.5 / PER_UM)
    np.testing.assert_allclose(one.fraction, other.fraction, atol=1e-9)
    np.testing.assert_allclose(still.mtf([50, 150]).tangential, moved.mtf([50, 150]).tangential, atol=1e-9)


def test_cells_with_an_amplitude_are_summed_one_by_one():
    rng = np.random.default_rng(3)
    opd, amplitude = 0.1 * rng.normal(size=(12, 12)), rng.uniform(0, 1, (12, 12))
    opd[4, 5] = np.nan
    field = np.where(np.isnan(opd), 0, amplitude * np.exp(2j * pi * np.nan_to_num(opd)))
    found = p2sf.Pupil.from_opd(opd, NA, NM, amplitude).mtf(np.array([0, 1, 5]) * 2000 * PER_UM / 12)
    sums = [sum(np.vdot(row[: 12 - lag], row[lag:]) for row in field) for lag in (0, 1, 5)]
    np.testing.assert_allclose(found.sagittal, np.abs(sums) / abs(sums[0]), atol=1e-12)


@pytest.mark.parametrize("points", [2_001, POINTS_AT_ONCE])
def test_energy_of_cells_is_the_sum_over_all_pairs(monkeypatch, points):
    """Each pair of cells ν apart brings R·J₁(2πR|ν|)/|ν| of its light within R; cells beyond the disc count too."""
    monkeypatch.setattr("p2sf.figures.energy.POINTS_AT_ONCE", points)
    rng, size = np.random.default_rng(3), 40
    light, wave = np.zeros((size, size)), rng.uniform(-0.2, 0.2, (size, size))
    light[rng.integers(0, size, (2, 60)).tolist()] = 1
    light[[0, 0, -1, -1], [0, -1, 0, -1]] = 1
    pupil, open_, step = p2sf.Pupil.from_opd(wave, NA, NM, light), light > 0, 2 * PER_UM / size
    found = pupil.encircled_energy(1 / (2 * step) * np.array([0.05, 0.3, 0.7, 1.0]))
    at = (2 * np.arange(size) - size + 1) / size
    x, y = (PER_UM * part[open_] for part in np.meshgrid(at, at))
    field = np.exp(2j * pi * (wave[open_] + x * found.centroid_x_um + y * found.centroid_um))
    apart = np.hypot(x[:, None] - x, y[:, None] - y) + 1e-12
    for radius, share in zip(found.radius_um, found.fraction, strict=True):
        within = (field @ (j1(2 * pi * radius * apart) / apart) @ field.conj()).real * radius * step**2
        assert share == pytest.approx(within / light.sum(), abs=1e-9)


def test_beyond_where_cells_repeat_the_psf_is_refused():
    pupil = p2sf.Pupil.from_opd(np.zeros((32, 32)), NA, NM)
    for call in (pupil.encircled_energy, pupil.line_spread):
        with pytest.raises(P2SFError):
            call([100.0])


@pytest.mark.parametrize("basis", ["noll", "fringe"])
@pytest.mark.parametrize("hole", [0.0, 0.5])
def test_terms_that_made_a_wavefront_are_found(basis, hole):
    terms = zernike_terms(basis, 22)
    rng = np.random.default_rng(1)
    numbers = 0.1 * rng.normal(size=22)
    scale = np.array([1 / term.norm if basis == "fringe" else 1.0 for term in terms])
    opd = np.tensordot(numbers * scale, zernike_values(terms, X.ravel(), Y.ravel()), 1).reshape(X.shape)
    opd[(X > 0.6) & (Y > 0.2)] = np.nan
    found = p2sf.fit_zernike(opd, (X * X + Y * Y > hole**2).astype(float), 22, basis)
    np.testing.assert_allclose(found.waves, numbers, atol=1e-9)
    assert found.residual < 1e-9 and found.clear < 1
    assert np.sum(found.rms_waves[1:] ** 2) == pytest.approx(found.rms_with_tilt**2)


def test_rms_and_marechal_are_of_the_disc():
    opd = 0.05 * zernike_values(zernike_terms("noll", 11), X.ravel(), Y.ravel())[10].reshape(X.shape) + 0.7 * X
    found = p2sf.Pupil.from_opd(opd, NA, NM).zernike()
    assert found.rms == pytest.approx(0.05, rel=5e-3) and found.waves[10] == pytest.approx(0.05)
    assert found.marechal == pytest.approx(np.exp(-((2 * pi * found.rms) ** 2)))
    assert p2sf.Pupil.from_opd(opd, NA, NM).strehl == pytest.approx(found.marechal, abs=5e-3)
    area = cell_areas(AT, AT, 2 / SIZE)
    mean = (area * opd).sum() / area.sum()
    assert found.rms_with_tilt == pytest.approx(np.sqrt((area * (opd - mean) ** 2).sum() / area.sum()))


@pytest.mark.parametrize(
    "call",
    [
        lambda: p2sf.Pupil.from_opd(np.zeros((8, 8)), 0.0, NM),
        lambda: p2sf.Pupil.from_opd(np.zeros((8, 9)), NA, NM),
        lambda: p2sf.fit_zernike(np.zeros((8, 9))),
        lambda: p2sf.fit_zernike(np.zeros((4, 4)), terms=37),
        lambda: p2sf.fit_zernike(np.zeros((8, 8)), np.ones((4, 4))),
        lambda: p2sf.fit_zernike(np.zeros((8, 8)), terms=0),
    ],
)
def test_what_is_no_pupil_is_refused(call):
    with pytest.raises(P2SFError):
        call()


def test_a_pupil_made_as_before_says_how_it_is_made_now():
    for made in (lambda: p2sf.Pupil(np.zeros((8, 8)), NA, NM), lambda: p2sf.Pupil(opd_waves=np.zeros((8, 8)), na=NA)):
        with pytest.raises(RequestError, match=r"p2sf\.Pupil\.from_opd\(opd_waves, na, wavelength_nm\)"):
            made()
