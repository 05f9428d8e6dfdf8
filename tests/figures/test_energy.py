"""Encircled energy of all light, against Rayleigh's closed form, geometry, and the light in windows of known share."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from numpy.polynomial.chebyshev import chebval
from numpy.polynomial.legendre import Legendre, leggauss
from scipy.fft import dct
from scipy.optimize import brentq
from scipy.special import j0

import p2sf
from p2sf.disc.domain import WHOLE
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.errors import GeometryError
from p2sf.figures import energy
from p2sf.figures.energy import energy_of, landing_energy, landing_points
from p2sf.lens.lens import with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.measures import PupilPart, energy_in
from p2sf.psf.traced import traced_psf
from p2sf.pupil.frequency_pupil import pupil_of_coefficients, pupil_of_rays
from tests.support.airy import circle_energy
from tests.support.rays.ray_figures import ray_figures
from tests.support.waves import NA, WAVELENGTH_UM, waves

UNIT = WAVELENGTH_UM / NA


def test_a_perfect_lens_has_rayleighs_energy():
    radius = UNIT * np.linspace(0, 8, 161)
    found = energy_in([PupilPart(pupil_of_coefficients(waves()))], "seidel", radius).fraction
    np.testing.assert_allclose(found, circle_energy(radius / UNIT), atol=2e-5)


def test_wings_that_are_not_summed_fall_with_the_radius():
    """As Rayleigh's mean does: J₀² + J₁² is 2/πv with ripples of 1/4v of it (DLMF 10.17.3); a sum ends at v = 38."""
    radius = UNIT * np.array([8.0, 16.0, 40.0])
    pupil = PupilPart(pupil_of_coefficients(waves()))
    outside = 1 - energy_in([pupil], "seidel", radius, wings=True).fraction
    assert outside * radius == pytest.approx([outside[0] * radius[0]] * 3, rel=1e-9)
    assert outside == pytest.approx(1 - circle_energy(radius / UNIT), rel=0.02)


@pytest.mark.parametrize("w40", [0.5, 700.0], ids=["waves", "landing points"])
def test_the_energy_about_a_point_beside_a_round_picture_is_that_about_one_above_it(w40):
    """Turned, since the half of a pupil that is mirrored in η knows no point beside its plane of symmetry."""
    pupil = pupil_of_coefficients(waves(w40=w40), turn_deg=45.0)
    radius, far = UNIT * np.linspace(1.0, 4.0, 7) * max(1.0, w40), 2 * UNIT * max(1.0, w40)
    beside, above = (energy_of(pupil, *at).within(radius) for at in ((0.0, far), (far, 0.0)))
    np.testing.assert_allclose(beside, above, atol=2e-4)
    if w40 < 1:
        assert beside[0] < energy_of(pupil).within(radius[:1])[0] - 0.3


def axial_radius_um(figures, share: float) -> float:
    """Return the radius that holds a share on the axis of a round lens: plain Hankel sums over radii of the rays."""
    rays = figures.rays.denser(int(3 * figures.rays.slope) + 60, 8)
    area, frequency = rays.share.sum(1) * np.pi, np.hypot(rays.fx, rays.fy)[:, 0]
    wave = area * rays.light[:, 0] * np.exp(2j * np.pi * rays.waves[:, 0])
    jacobian = Legendre.fit(rays.square, frequency**2, 12).deriv()(rays.square)
    light = float((area * rays.light[:, 0] ** 2 / jacobian).sum())
    node, weight = leggauss(int(8 * figures.rays.slope) + 60)

    def within(radius: float) -> float:
        r = radius * (1 + node) / 2
        field = j0(2 * np.pi * np.outer(r, frequency)) @ wave
        return float(np.pi * radius * (weight * r) @ np.abs(field) ** 2 / light)

    return brentq(lambda r: within(r) - share, 1e-3, 1.2 * float(np.hypot(rays.x, rays.y).max()) + 20)


@pytest.mark.parametrize("name", ["petzval", "asphere", "tessar"])
def test_on_the_axis_it_is_a_hankel_sum_over_rays(name):
    """Petzval's R80 was 1e-3 larger, since the wings of its blur came around the period of a grid."""
    lens, source = find_lens(name), Source(wavelength_um=find_lens(name).reference_wavelength_um)
    figures, found = ray_figures(lens, source), energy_in([PupilPart(pupil_of_rays(lens, source))], "traced")
    for radius, share in ((found.radius_50_um, 0.5), (found.radius_80_um, 0.8)):
        plain = axial_radius_um(figures, share)
        assert figures.radius_um(share) == pytest.approx(plain, rel=1e-5)
        assert radius == pytest.approx(plain, rel=1e-4)


@pytest.mark.parametrize("seed", range(6))
def test_fewer_circles_and_nodes_than_all_harmonics_are_enough(monkeypatch, seed):
    """Of any third-order blur, also at caustics, where opposite edges of the pupil meet."""
    rng = np.random.default_rng(seed)
    names = ("w40", "w31", "w22", "w20", "wd")
    chosen = rng.normal(size=5) * rng.choice([0.0, 1.0, 6.0, 20.0], 5)
    pupil = pupil_of_coefficients(waves(**dict(zip(names, chosen, strict=True))))
    found = landing_energy(pupil, pupil.centroid_um)
    for name in ("NODES", "CIRCLES", "DIRECTIONS"):
        monkeypatch.setattr(energy, name, 1.3)
    radius = np.linspace(0, found.top_um, 80)
    np.testing.assert_allclose(found.within(radius), landing_energy(pupil, pupil.centroid_um).within(radius), atol=2e-5)


@pytest.mark.parametrize("clear", [True, False])
def test_half_of_the_columns_give_what_all_do(clear):
    """With a faint filter too, which lets all light through."""
    pupil = pupil_of_coefficients(waves(w40=2.0, w31=3.0, wd=-1.5))
    mask = CLEAR if clear else PupilMask(apodisation=1e4)
    half, other = (landing_energy(one, pupil.centroid_um) for one in (pupil, replace(pupil, domain=WHOLE, mask=mask)))
    radius = np.linspace(0, min(half.top_um, other.top_um), 60)
    np.testing.assert_allclose(half.within(radius), other.within(radius), atol=2e-5)


def test_known_radii_of_the_airy_pattern():
    """0.26741 and 0.44847 λ/NA hold half and 80 %: where 1 − J0² − J1² does."""
    found = energy_in([PupilPart(pupil_of_coefficients(waves()))], "seidel")
    for radius, share in ((found.radius_50_um, 0.5), (found.radius_80_um, 0.8)):
        assert circle_energy(radius / UNIT) == pytest.approx(share, abs=2e-5)


@pytest.mark.parametrize("w", [{"wd": 40.0}, {"w31": 30.0}, {"w40": 40.0, "wd": -20.0}])
def test_a_large_blur_tends_to_the_density_of_rays(w):
    pupil = pupil_of_coefficients(waves(**w))
    waves_sum, rays = (
        landing_energy(pupil, pupil.centroid_um),
        landing_points(pupil, pupil.centroid_um),
    )
    radius = np.linspace(0, 1.2 * pupil.spot.rms_um, 40)
    assert np.abs(waves_sum.within(radius) - rays.within(radius)).max() < 0.04


@pytest.mark.parametrize(("name", "field"), [("double_gauss_28", 10.0), ("cooke_triplet", 20.0), ("telephoto", 7.0)])
def test_it_is_the_light_in_a_window_whose_share_is_known(name, field):
    """A wide window of the traced PSF, another road altogether: its circles of samples, and its share of all light."""
    lens, source = find_lens(name), Source(field_deg=field)
    pupil = pupil_of_rays(lens, source)
    found = energy_in([PupilPart(pupil)], "traced")
    pitch = 1 / (8 * max(pupil.half_x, pupil.half_y))
    psf = traced_psf(lens, source, 768, pitch)
    distance = np.hypot(psf.x_um, (psf.y_um - found.centroid_um)[:, None])
    for radius, share in ((found.radius_50_um, 0.5), (found.radius_80_um, 0.8)):
        inside = np.clip((radius - distance) / pitch + 0.5, 0, 1)  # a sample on the circle counts in part
        assert psf.energy * (psf.values * inside).sum() == pytest.approx(share, abs=2e-3)


def test_the_curve_rises_to_all_the_light():
    found = energy_in([PupilPart(pupil_of_coefficients(waves(w31=3.0, w22=2.0)))], "seidel")
    assert found.fraction[0] == pytest.approx(0, abs=1e-9)
    assert np.diff(found.fraction).min() > -2e-4
    assert 0.95 < found.fraction[-1] < 1


@pytest.mark.parametrize(("aim", "radius_80_um"), [("paraxial", 41.4), ("stop", 16.3)])
def test_the_fast_petzval_spreads_what_the_paraxial_rim_lets_in(aim, radius_80_um):
    """By sums over rays of a program of its own, to the three digits it printed; a window said 5.6."""
    lens = with_aim(find_lens("petzval"), aim)
    found = energy_in([PupilPart(pupil_of_rays(lens, Source()))], "traced")
    assert found.radius_80_um == pytest.approx(radius_80_um, abs=0.1)


def test_two_colours_beside_each_other_are_about_their_common_centroid():
    """Two Airy patterns far apart: half of the light lies on each side, so hardly any near the centroid."""
    pupil = pupil_of_coefficients(waves())
    apart = [PupilPart(pupil, 0.5, -20.0), PupilPart(pupil, 0.5, 20.0)]
    found = energy_in(apart, "seidel", np.array([15.0, 40.0]))
    assert found.centroid_um == pytest.approx(0, abs=1e-9)
    assert found.fraction[0] < 0.02 < 0.95 < found.fraction[1]
    assert found.radius_50_um == pytest.approx(20, rel=0.02)
    assert found.rms_um == pytest.approx(20, rel=1e-6)


def hankel_energy(v: float, w40: float, wd: float) -> float:
    """Return ½∫|U|²v dv with U(v) = 2∫exp(i2πW(ρ))J₀(vρ)ρ dρ, both by Gauss nodes: the light within v of the axis."""
    (rho, weight), (at, share) = (((node + 1) / 2, weight / 2) for node, weight in (leggauss(300), leggauss(200)))
    field = 2 * (weight * rho * np.exp(2j * np.pi * (w40 * rho**4 + wd * rho**2))) @ j0(v * np.outer(rho, at))
    return float(0.5 * v**2 * (share * at) @ np.abs(field) ** 2)


def test_energy_may_exceed_that_of_a_perfect_lens_between_its_dark_rings():
    """ρ⁴ − 1.75ρ² waves at v = 13.59 by 5.6e-3, as a direct Hankel sum has it: there is no bound as of the MTF."""
    v = 13.59
    found = energy_in(
        [PupilPart(pupil_of_coefficients(waves(w40=1.0, wd=-1.75)))], "seidel", np.array([v / (2 * np.pi)]) * UNIT
    )
    perfect, exact = (hankel_energy(v, *w) for w in ((0.0, 0.0), (1.0, -1.75)))
    assert perfect == pytest.approx(circle_energy(v / (2 * np.pi)), abs=1e-12)
    assert exact - perfect == pytest.approx(5.6e-3, abs=1e-4)
    assert found.fraction[0] == pytest.approx(exact, abs=1e-4)


def test_a_blur_beyond_any_sum_of_waves_says_so_and_how_far_it_is_to_be_trusted():
    """900 waves of defocus: the energy of an even disc, R². At 180 waves a sum of waves departs by over 1e-3."""
    pupil = pupil_of_coefficients(waves(wd=450.0))
    found = energy_in([PupilPart(pupil)], "seidel")
    radius = 900.0 * UNIT
    assert found.note and 1e-3 < found.departure < 0.02
    assert "not to be trusted" in str(found.note)
    assert found.radius_50_um == pytest.approx(radius * np.sqrt(0.5), rel=0.01)
    assert energy_in([PupilPart(pupil_of_coefficients(waves(wd=5.0)))], "seidel").note is None


@pytest.mark.parametrize(("name", "field"), [("cooke_triplet", 20.0), ("tessar", 20.5)])
def test_of_a_clipped_pupil_it_is_the_light_in_a_window_of_the_reference(name, field):
    """Rims take rays away; the reference sums the rest one by one, and knows nothing of the pupil's polynomials."""
    lens, source = find_lens(name), Source(field_deg=field)
    pupil, whole = pupil_of_rays(lens, source, clip=True), pupil_of_rays(lens, source)
    assert pupil.half_y < 0.99 * whole.half_y
    found = energy_in([PupilPart(pupil)], "traced")
    pitch = 1 / (24 * max(pupil.half_x, pupil.half_y))
    psf = huygens_psf(lens, source, 320, pitch, clip=True)
    distance = np.hypot(psf.x_um, (psf.y_um - found.centroid_um)[:, None])
    for radius, share in ((found.radius_50_um, 0.5), (found.radius_80_um, 0.8)):
        inside = np.clip((radius - distance) / pitch + 0.5, 0, 1)
        assert psf.energy * (psf.values * inside).sum() == pytest.approx(share, abs=3e-3)


@pytest.mark.parametrize("name", ["relay", "telecentric_relay"])
def test_a_relay_at_infinity_is_refused_before_its_outline_is_sought(name, monkeypatch):
    def sought(*_):
        raise AssertionError("the outline of what few rays pass was sought")

    monkeypatch.setattr("p2sf.pupil.clear_curves._edge", sought)
    with pytest.raises(GeometryError) as caught:
        p2sf.Camera(find_lens(name)).at(Source()).energy()
    assert 0 < caught.value.message.values["percent"] < 5


@pytest.mark.parametrize("field", [0.0, 10.0])
def test_the_quoted_radii_hold_their_shares(field):
    """Within those radii lies what the curve itself says, to the line that its smallest steps are taken for."""
    lens, source = find_lens("double_gauss_28"), Source(field_deg=field, wavelength_um=0.55)
    found = p2sf.Camera(lens).at(source).energy(method="fitted")
    held = p2sf.Camera(lens).at(source).energy([found.radius_50_um, found.radius_80_um], method="fitted").fraction
    np.testing.assert_allclose(held, [0.5, 0.8], atol=1e-8)


def test_sums_of_cosines_are_those_of_scipy():
    values = np.random.default_rng(4).normal(size=41)
    np.testing.assert_allclose(energy._cosine_sums(values), dct(values, type=2), atol=1e-13)


def test_a_series_at_many_angles_is_numpys_and_takes_little_memory():
    """All terms at all radii would be 400 MB. Rounding: k·φ reaches 700 radians, of terms whose sizes add up to 3."""
    series = np.random.default_rng(5).normal(size=232) / np.arange(1, 233) ** 1.5
    angle = np.linspace(0, np.pi, 200_000)
    tracemalloc.start()
    try:
        found = energy.EncircledLight(series, 50.0).within(25 * (1 + np.cos(angle)))
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert found.size == angle.size and most < 50e6
    np.testing.assert_allclose(energy._cosine_series(series, angle), chebval(np.cos(angle), series), atol=1e-12)
