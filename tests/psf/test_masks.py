"""PSFs behind masks: closed forms, laws of diffraction, the definition as a sum over a grid, method against method."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.ndimage import map_coordinates
from scipy.special import j1

from p2sf.conventions import centred_axis
from p2sf.disc.mask import PupilMap, PupilMask
from p2sf.disc.mask_nodes import mask_nodes, throughput
from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.disc.transform import sum_plane_waves
from p2sf.errors import GeometryError, SamplingError
from p2sf.lens.lens import with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf.choosing import choose
from p2sf.psf.fitted import fitted_psf
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import PsfOptions, reference_pupil, render
from p2sf.psf.picture import psf_of_pupil
from p2sf.psf.polychromatic import estimated_share
from p2sf.psf.seidel import seidel_psf
from p2sf.psf.spherical import spherical_pupil
from p2sf.psf.traced import traced_psf
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.pencil import pupil_rays, trace
from tests.support.masked_sum import masked_sum
from tests.support.tiers import in_tiers
from tests.support.waves import NA, WAVELENGTH_UM, r_squared, relative_l2, waves

EVEN = (
    PupilMask(obscuration=0.4),
    PupilMask(obscuration=0.99),
    PupilMask(blades=6),
    PupilMask(obscuration=0.3, vanes=4, vane_width=0.03),
    PupilMask(obscuration=0.3, apodisation=0.5, apodisation_power=6),
    PupilMask(zernike_um=(0, 0, 0.1, 0.2, 0, 0.1)),
)
UNEVEN = (
    PupilMask(blades=5, roundness=0.3, blade_angle_deg=10),
    PupilMask(obscuration=0.2, vanes=3, vane_width=0.03, vane_angle_deg=20),
    PupilMask(cubic_um=1.0),
    PupilMask(amplitude_map=PupilMap.sampled(lambda xi, eta: 0.6 + 0.4 * np.sin(2 * xi + eta))),
)
CROSSED = (PupilMask(obscuration=0.95, blades=6), PupilMask(obscuration=0.3, vanes=4, blades=6, apodisation=0.8))


def besinc(v: np.ndarray) -> np.ndarray:
    return np.divide(2 * j1(v), v, out=np.ones_like(v), where=v > 0)


@pytest.mark.parametrize("ratio", [0.01, 0.1, 0.5, 0.9, 0.99])
@pytest.mark.parametrize(("quality", "rounding"), [("settled", 1e-9), ("preview", 1e-4)])
def test_the_annular_airy_pattern(ratio, quality, rounding):
    """Of a perfect lens: [2J₁(v)/v − ε²·2J₁(εv)/(εv)]²/(1 − ε²)² (Born & Wolf 1999, ch. 8)."""
    psf = seidel_psf(waves(), 65, 0.9, quality, mask=PupilMask(obscuration=ratio))
    axis = centred_axis(65, 0.9)
    v = 2 * np.pi * NA / WAVELENGTH_UM * np.hypot(axis, axis[:, None])
    wanted = ((besinc(v) - ratio**2 * besinc(ratio * v)) / (1 - ratio**2)) ** 2
    # Settled nodes end at the harmonics m = z + 7∛z of the corner, where J_m(z) is 2e-9 (z = 51; A&S 9.3.23) beside
    # amplitudes below 0.05. In float32 the two discs of a narrow ring, equal to 2 %, lose two digits.
    assert psf.values / psf.values.max() == pytest.approx(wanted, abs=rounding)
    assert psf.strehl == pytest.approx(1, abs=rounding)


@pytest.mark.parametrize("mask", (*EVEN[:5], *UNEVEN[:2]), ids=repr)
def test_all_the_light_of_a_perfect_lens_is_in_the_plane(mask):
    """The share in a wide window is that of the definition: Parseval, which no method of summing enters."""
    psf = seidel_psf(waves(), 513, 1.2, mask=mask)
    # What is outside of a radius R falls as the length of the edges over R: some per cent for a spider or a ring.
    assert (psf.strehl == pytest.approx(1, abs=1e-9) and 0.9 < psf.energy < 1.0 + 1e-6) or mask.obscuration == 0.99


@pytest.mark.parametrize(("blades", "spikes"), [(5, 10), (6, 6), (7, 14), (8, 8)])
def test_an_iris_of_n_blades_has_2n_spikes_where_n_is_odd_and_n_where_it_is_even(blades, spikes):
    psf = seidel_psf(waves(), 257, 0.6, mask=PupilMask(blades=blades, blade_angle_deg=13))
    angle, radius = np.linspace(0, 2 * np.pi, 720, endpoint=False), np.linspace(45, 75, 60)[:, None]
    place = np.array([128 + radius * np.cos(angle) / 0.6, 128 + radius * np.sin(angle) / 0.6])
    along = (map_coordinates(psf.values, place, order=3) * radius**2).mean(0)  # rings average out, spikes do not
    higher = (along > np.roll(along, 1)) & (along >= np.roll(along, -1)) & (along > 0.4 * along.max())
    assert higher.sum() == spikes
    # Each spike is perpendicular to an edge: the middles of the edges lie half a turn over n from the corners.
    wanted = np.deg2rad(13) + np.pi / blades * (1 + np.arange(2 * blades) * (1 if blades % 2 else 2))
    miss = np.abs(np.exp(1j * angle[higher])[:, None] - np.exp(1j * wanted)).min(1)
    assert miss.max() < np.deg2rad(1)


@pytest.mark.parametrize("mask", EVEN + UNEVEN, ids=repr)
def test_every_method_makes_the_same_picture(mask):
    lens, source = with_mask(find_lens("double_gauss_28"), mask), Source(field_deg=10)
    reference = huygens_psf(lens, source, 32, 1.4)
    for quality in ("settled", "preview"):
        exact, fitted = (method(lens, source, 32, 1.4, quality=quality) for method in (traced_psf, fitted_psf))
        assert r_squared(exact.values, reference.values) > 0.9999
        assert r_squared(fitted.values, reference.values) > 0.998
        assert exact.over_unaberrated.max() == pytest.approx(reference.over_unaberrated.max(), rel=1e-3)
    assert fitted.predicted_error > 1 - r_squared(fitted.values, reference.values)
    assert fitted.energy == pytest.approx(reference.energy, rel=0.02)


@pytest.mark.parametrize("mask", in_tiers([EVEN[0], EVEN[3], *UNEVEN[:3]], [UNEVEN[0]]), ids=repr)
def test_the_reference_is_the_sum_over_a_grid(mask):
    """The grid of 1.8e5 points is good to some 3e-4, by its edges; tests.long.pupil_masks takes 1e7."""
    lens, source = find_lens("double_gauss_28"), Source(field_deg=10)
    reference = huygens_psf(with_mask(lens, mask), source, 32, 1.4)
    assert r_squared(masked_sum(lens, source, mask, 32, 1.4, 480), reference.values) > 0.9995


@pytest.mark.parametrize("mask", UNEVEN, ids=repr)
def test_the_azimuth_turns_the_mask_the_other_way(mask):
    lens = find_lens("double_gauss_28")
    seen = huygens_psf(with_mask(lens, mask), Source(field_deg=10, azimuth_deg=30), 24, 1.8)
    turned = huygens_psf(with_mask(lens, mask.turned(-30)), Source(field_deg=10), 24, 1.8)
    assert seen.values == pytest.approx(turned.values, abs=1e-12)


@pytest.mark.parametrize("name", ["double_gauss_28", "relay", "eye_navarro"])
@pytest.mark.parametrize("stop", [1, -1])
def test_a_mask_stands_upright_in_the_stop(name, stop):
    """Where the entrance pupil is an inverted image of the stop, its mask is seen turned by half a turn."""
    lens = find_lens(name)
    lens = lens if stop == 1 else replace(lens, stop_surface=len(lens.surfaces))
    seen = mask_seen(with_mask(lens, PupilMask(blades=5)), Source(depth_mm=1000.0)).turn_deg
    rays = pupil_rays(lens, Source(depth_mm=1000.0), [0.0], [0.1])
    at = trace(lens, rays.origins, rays.directions, 0.5876).points[lens.stop_surface, 0, 1]
    assert (seen == 180) == (at < 0) and (seen == 0) == (at > 0)


def test_on_the_axis_the_picture_turns_with_the_mask():
    lens = find_lens("double_gauss_28")
    upright, turned = (
        huygens_psf(with_mask(lens, mask), Source(), 33, 1.4).values
        for mask in (PupilMask(blades=5, cubic_um=0.5), PupilMask(blades=5, cubic_um=0.5, turn_deg=90))
    )
    assert turned == pytest.approx(np.rot90(upright), abs=1e-7)  # rows run towards +y: from +y to +x


def test_a_path_is_so_many_waves_as_the_wavelength_makes_it():
    """A quarter of a wave of defocus at one wavelength is an eighth at twice that."""
    six = waves()
    for times in (1, 2):
        wave = times * WAVELENGTH_UM
        # Noll's defocus has the value √3(2ρ² − 1): 2√3 from the centre to the rim.
        mask = PupilMask(zernike_um=(0, 0, 0, 0.25 * WAVELENGTH_UM / (2 * np.sqrt(3))))
        scaled = replace(six, wavelength_um=np.asarray(wave))
        plain = seidel_psf(replace(scaled, wd=np.asarray(-0.25 / times)), 32, 1.0)
        assert seidel_psf(scaled, 32, 1.0, mask=mask).values == pytest.approx(plain.values, abs=1e-9)


def plain_sum(six, mask, pixels, pixel_um, counts=(60, 160)):
    """Return |Σ A·exp(2πi(path/λ − W) + …)|² over nodes of the open part, one plane wave each, of unit sum."""
    nodes, axis = mask_nodes(mask, *counts), centred_axis(pixels, pixel_um)
    amplitude = nodes.weight * nodes.amplitude
    waves = nodes.path_um / WAVELENGTH_UM - wavefront(six, nodes.xi, nodes.eta)
    scale = float(six.reduced_slope) / WAVELENGTH_UM
    pupil = amplitude * np.exp(2j * np.pi * waves)
    field = sum_plane_waves(pupil, scale * nodes.xi, scale * nodes.eta, axis, axis, nodes.domain.symmetric)
    return np.abs(field) ** 2 / (np.abs(field) ** 2).sum()


@pytest.mark.parametrize("mask", EVEN + UNEVEN + CROSSED, ids=repr)
@pytest.mark.parametrize("quality", ["settled", "preview"])
def test_six_coefficients_behind_a_mask_are_the_plain_sum(mask, quality):
    six = waves(w40=1.2, w31=-0.8, w22=0.7, wd=-0.9)
    found = seidel_psf(six, 48, 1.1, quality, mask=mask)
    # Settled sums promise 1e-4, previews 1 − R² of 1e-5.
    allowed = 1e-4 if quality == "settled" else 3e-3
    assert relative_l2(found.values, plain_sum(six, mask, 48, 1.1)) < allowed


@pytest.mark.parametrize("mask", EVEN + UNEVEN, ids=repr)
def test_nodes_integrate_over_what_is_open(mask):
    """Against points of a grid, turned so that no edge runs along it: 2000 along a side err by 2000^−1.5 an edge."""
    nodes = mask_nodes(mask, 24, 60)
    at = [(nodes.xi, nodes.eta), (-nodes.xi, nodes.eta)] if nodes.domain.symmetric else [(nodes.xi, nodes.eta)]
    found = nodes.share * float(nodes.weight @ np.mean([smooth_light(*point) for point in at], axis=0))
    xi, eta, light = turned_grid()
    assert found == pytest.approx(light @ mask.opens(xi, eta) * (2 / 2000) ** 2 / np.pi, abs=3e-5)


@cache
def turned_grid() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ξ and η of the grid's points on the disc, and the light there."""
    line = (2 * np.arange(2000) - 1999) / 2000
    across, up = np.meshgrid(line, line)
    xi, eta = across * np.cos(0.37) - up * np.sin(0.37), across * np.sin(0.37) + up * np.cos(0.37)
    inside = xi * xi + eta * eta < 1
    xi, eta = xi[inside], eta[inside]
    return xi, eta, smooth_light(xi, eta)


def smooth_light(xi, eta):
    return np.exp(xi * eta + eta**3) * np.cos(xi + eta)


def test_a_mask_that_leaves_nothing_open_is_refused():
    lens = with_mask(find_lens("cooke_triplet"), PupilMask(vanes=12, vane_width=0.5))
    with pytest.raises(GeometryError, match="nothing open"):
        huygens_psf(lens, Source(), 16, 1.0)


def test_an_fft_knows_no_mask():
    with pytest.raises(SamplingError, match="mask"):
        seidel_psf(waves(), 32, 1.0, sampling="fft", mask=EVEN[0])


@pytest.mark.parametrize("mask", [EVEN[0], EVEN[2], UNEVEN[2]], ids=repr)
def test_the_choice_keeps_its_promise(mask):
    lens = with_mask(find_lens("double_gauss_28"), mask)
    for source, tolerance in ((Source(), 0.99), (Source(field_deg=10), 0.999)):
        found = render(lens, source, "auto", 32, 1.4, PsfOptions(min_r2=tolerance))
        made = spherical_pupil if found.method == "spherical" else reference_pupil  # plane waves are the less exact
        reference = psf_of_pupil(made(lens, source), (32, 1.4), rtol=SETTLED_TOLERANCE)
        assert r_squared(found.values, reference.values) >= tolerance
        assert choose(lens, source, tolerance).predicted_error <= 1 - tolerance


def test_throughput_of_a_gaussian():
    """Means over the disc of exp(−ρ²/w²) and of its square: w²(1 − e^(−1/w²)), and w²(1 − e^(−2/w²))/2."""
    found = throughput(PupilMask(apodisation=0.6))
    assert found.amplitude == pytest.approx(0.36 * (1 - np.exp(-1 / 0.36)), abs=1e-12)
    assert found.light == pytest.approx(0.18 * (1 - np.exp(-2 / 0.36)), abs=1e-12)


@pytest.mark.parametrize("mask", [PupilMask(obscuration=0.6), PupilMask(apodisation=0.6)], ids=repr)
def test_light_between_samples_too_far_apart_is_estimated_behind_a_mask(mask):
    """The same window in samples of λ/2NA and less, whose sum is the light (Parseval), and in wider ones."""
    six = waves(wd=2.0)
    fine, wide = seidel_psf(six, 64, 0.75, mask=mask), seidel_psf(six, 16, 3.0, mask=mask)
    assert wide.energy is None and 0.5 < fine.energy < 1
    found = estimated_share(wide, NA, throughput(mask).spreading)
    assert found == pytest.approx(fine.energy, rel=0.03)  # rectangles of 16 samples a side; without the mask 1.5 times
