"""Points behind masks: their light against plain sums over a fine grid, twins, and fits of noisy pictures."""

import numpy as np
import pytest

from p2sf.conventions import centred_axis
from p2sf.disc.mask import PupilMask
from p2sf.lens.lens import with_f_number, with_mask
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.measure.fitting.frame_terms import lens_optics
from p2sf.measure.fitting.lens_pupil import clear_part
from p2sf.measure.fitting.point_fit import fit_point
from p2sf.measure.fitting.point_model import PictureOptics, PixelSum
from p2sf.measure.fitting.point_problem import PointPicture, Problem
from p2sf.measure.fitting.pupil_model import pupil_model
from p2sf.measure.fitting.pupil_nodes import PupilNodes, has_twin, lens_nodes, mapped_nodes, open_nodes, paraxial_nodes
from p2sf.measure.frame import FrameGeometry
from p2sf.measure.measurement import FrameRequest, measure_frame
from p2sf.measure.simulation import Exposure, grid_of_points, simulated_frame
from p2sf.pupil.fit import fit
from tests.support.masked_sum import masked_sum

NA, WAVE, PIXEL = 0.125, 0.55, 1.5
SIX = np.array([1.2, -0.9, 0.7, -1.4])
RING = PupilMask(obscuration=0.45)
SPIDER = PupilMask(obscuration=0.3, vanes=3, vane_width=0.03, vane_angle_deg=20)
IRIS = PupilMask(blades=5, blade_angle_deg=10)
FILTER = PupilMask(apodisation=0.9, cubic_um=0.4)
MASKS = pytest.mark.parametrize("mask", [RING, SPIDER, IRIS, FILTER], ids=["ring", "spider", "iris", "filter"])


def plain_sum(waves_at, frequencies_at, mask, side=700, pixels=11):
    """Return the intensity at points, unit sum, from a square grid over the disc, dark cells left out: side^−1.5."""
    axis, field = centred_axis(pixels, PIXEL), np.zeros((pixels, pixels), complex)
    centre = (2 * np.arange(side) + 1 - side) / side
    for rows in np.array_split(centre, 4):
        xi, eta = (part.ravel() for part in np.meshgrid(centre, rows))
        inside = (xi * xi + eta * eta < 1) & mask.opens(xi, eta)
        xi, eta = xi[inside], eta[inside]
        fx, fy = frequencies_at(xi, eta)
        light = mask.amplitude(xi, eta) * np.exp(2j * np.pi * (waves_at(xi, eta) - mask.path_um(xi, eta) / WAVE))
        across = np.exp(2j * np.pi * np.outer(fx, axis))
        field += (light[:, None] * np.exp(2j * np.pi * np.outer(fy, axis))).T @ across
    intensity = np.abs(field) ** 2
    return intensity / intensity.sum()


def test_scattered_nodes_are_summed_as_one_by_one():
    """2e-6 of the peak: the grid's 7e-7, and single precision; weights of both signs, frequencies off the middle."""
    rng, count = np.random.default_rng(0), 3000
    radius, angle = np.sqrt(rng.uniform(0, 1, count)), rng.uniform(0, 2 * np.pi, count)
    xi, eta, weight = radius * np.cos(angle), radius * np.sin(angle), rng.uniform(-0.3, 0.7, count)
    fx, fy, waves = NA / WAVE * xi, NA / WAVE * eta + 0.05, 2 * eta**3 + xi**2
    nodes = PupilNodes(fx, fy, xi, eta, weight / weight.sum(), np.zeros(count))
    made = PixelSum(nodes, (21, 31), PictureOptics(NA, WAVE, PIXEL))
    found = made.fields(waves, xi[None].astype(np.float32))
    one = nodes.weight * np.exp(2j * np.pi * (waves + np.multiply.outer(made.y, fy)))
    across = np.exp(2j * np.pi * np.multiply.outer(fx, made.x))
    for k, plain in enumerate((one @ across, (one * xi) @ across)):
        assert np.abs(found[:, k] - plain).max() < 2e-6 * np.abs(plain).max()


@MASKS
def test_light_behind_a_mask_is_that_of_a_plain_sum(mask):
    six = pupil_model("seidel")
    nodes = paraxial_nodes((24, 64), NA / WAVE, mask, WAVE)
    light = PixelSum(nodes, (11, 11), PictureOptics(NA, WAVE, PIXEL, 0.0, mask)).light(
        SIX @ six.waves(nodes.xi, nodes.eta) + nodes.waves
    )
    plain = plain_sum(lambda *at: SIX @ six.waves(*at), lambda *at: (NA / WAVE * at[0], NA / WAVE * at[1]), mask)
    assert light / light.sum() == pytest.approx(plain, abs=1e-3 * plain.max())


@MASKS
def test_light_of_a_pupil_map_behind_a_mask_is_that_of_a_plain_sum(mask):
    model, rng = pupil_model("26"), np.random.default_rng(4)
    waves = rng.normal(0, 0.1, len(model.wave_names))
    maps = model.paraxial_map + rng.normal(0, 0.01, len(model.map_names))
    numbers = np.concatenate([waves, maps])
    nodes = mapped_nodes(model, numbers, open_nodes(mask, (24, 64), None, 0.0), NA / WAVE, WAVE)
    light = PixelSum(nodes, (11, 11), PictureOptics(NA, WAVE, PIXEL, 0.0, mask)).light(
        waves @ model.waves(nodes.xi, nodes.eta) + nodes.waves
    )
    _, across, along = model.split(numbers)

    def frequencies(xi, eta):
        odd, even = model.maps(xi, eta)
        return NA / WAVE * (across @ odd), NA / WAVE * (along @ even)

    plain = plain_sum(lambda *at: waves @ model.waves(*at), frequencies, mask)
    assert light / light.sum() == pytest.approx(plain, abs=1e-3 * plain.max())


def light_along_the_field(nodes, found, azimuth):
    """Return the intensity at points of a lens's nodes, unit sum, with the field turned back to +y."""
    waves = nodes.waves - found.function.at(nodes.xi, nodes.eta)[0]
    fx = nodes.fx * np.cos(azimuth) - nodes.fy * np.sin(azimuth)
    fy = nodes.fx * np.sin(azimuth) + nodes.fy * np.cos(azimuth)
    axis = centred_axis(11, PIXEL)
    amplitude = nodes.weight * np.exp(2j * np.pi * waves)
    light = np.abs(amplitude * np.exp(2j * np.pi * np.outer(axis, fy)) @ np.exp(2j * np.pi * np.outer(fx, axis))) ** 2
    return light / light.sum()


@pytest.mark.slow
@pytest.mark.parametrize("azimuth_deg", [0.0, 50.0])
@MASKS
def test_light_of_a_lens_behind_a_mask_is_that_of_its_rays(mask, azimuth_deg):
    """A mask stays where it is while the field turns: rays of a field along +y meet it turned the other way."""
    lens = with_mask(with_f_number(find_lens("cooke_triplet"), 5.0), mask)
    source, azimuth = Source(field_deg=8.0), np.deg2rad(azimuth_deg)
    found = fit(lens, source)
    light = light_along_the_field(lens_nodes(found, azimuth, (24, 64)), found, azimuth)
    plain = masked_sum(lens, source, mask.turned(-azimuth_deg), 11, PIXEL, 600)
    assert light == pytest.approx(plain, abs=2e-3 * plain.max())


@pytest.mark.parametrize(("mask", "azimuth_deg"), [(PupilMask(), 0.0), (SPIDER, 50.0)], ids=["clear", "spider"])
def test_rims_end_the_pupil_in_the_field_s_direction(mask, azimuth_deg):
    """A twelfth of the pupil is lost, and a point is another one without that."""
    lens, azimuth = with_mask(find_lens("cooke_triplet"), mask), np.deg2rad(azimuth_deg)
    source = Source(field_deg=20.0, azimuth_deg=azimuth_deg)
    found = fit(lens, Source(field_deg=20.0))
    clear = clear_part(lens, source, (32, 88))
    light = light_along_the_field(lens_nodes(found, azimuth, (32, 88), clear), found, azimuth)
    plain = masked_sum(lens, Source(field_deg=20.0), mask.turned(-azimuth_deg), 11, PIXEL, 400, clip=True)
    assert light == pytest.approx(plain, abs=5e-3 * plain.max())
    whole = light_along_the_field(lens_nodes(found, azimuth, (32, 88)), found, azimuth)
    assert np.abs(whole - plain).max() > 0.05 * plain.max()


def test_rims_that_end_nothing_leave_the_disc_as_it_is():
    assert clear_part(find_lens("cooke_triplet"), Source(), (16, 44)) is None


@MASKS
def test_all_light_behind_a_mask_is_one(mask):
    """What misses a window of 100 pixels of λ/2NA is diffracted by the edges; points across a pixel err by 2e-3."""
    nodes = paraxial_nodes((80, 280), NA / WAVE, mask, WAVE)
    light = PixelSum(nodes, (100, 100), PictureOptics(NA, WAVE, 2.2, mask=mask)).light(nodes.waves)
    assert 0.96 < light.sum() < 1.002


def test_only_pupils_alike_on_both_sides_leave_a_twin():
    four, six = PupilMask(vanes=4, vane_angle_deg=7), PupilMask(blades=6, blade_angle_deg=3)
    assert all(map(has_twin, (PupilMask(), RING, four, six, PupilMask(cubic_um=1.0), PupilMask(apodisation=0.5))))
    assert not any(map(has_twin, (SPIDER, IRIS, PupilMask(zernike_um=(0, 0, 0, 0.3)))))


def picture(mask, noise=0.01, defocus=0.0):
    """Return a noisy picture of a point behind a mask, and its optics."""
    optics = PictureOptics(NA, WAVE, 2.2, mask=mask)
    empty = PointPicture(np.zeros((32, 32)), 1.0, defocus)
    made, at = Problem([empty], optics, pupil_model("seidel"), 0.0), np.concatenate([SIX, [0.3, -0.2, 1.0, 0.0]])
    made.prepare(at)
    light = made.light(at, 0)[0]
    counts = light * (1000 / light.max()) + 50 + np.random.default_rng(6).normal(0, 1000 * noise, light.shape)
    return PointPicture(counts, (1000 * noise) ** 2, defocus), optics


def test_an_iris_of_five_blades_tells_the_sign_at_one_focus():
    """Five standard deviations; the picture of the twin is another one, turned by half a turn."""
    one, optics = picture(IRIS)
    found = fit_point([one], optics)
    assert np.abs((found.numbers - SIX) / found.bounds).max() < 5
    assert not found.others and not found.warnings


def test_two_foci_behind_a_ring_give_the_coefficients():
    """Five standard deviations."""
    taken = [picture(RING, defocus=waves)[0] for waves in (0.0, 1.5)]
    found = fit_point(taken, PictureOptics(NA, WAVE, 2.2, mask=RING))
    assert np.abs((found.numbers - SIX) / found.bounds).max() < 5


@pytest.mark.slow
def test_a_frame_through_an_iris_gives_back_how_the_sensor_stands():
    """Five standard deviations. Taken for a round stop of the same rim, χ² tells that the model is wrong."""
    round_ = with_f_number(find_lens("cooke_triplet"), 4.0)
    lens, geometry = with_mask(round_, PupilMask(blades=5, blade_angle_deg=18)), FrameGeometry(120, 640, 3.45)
    exposure, unknowns = Exposure(sensor_shift_um=30.0, tilt_deg=(0.2, 0.0)), ("sensor_shift_um", "tilt_x_deg")
    frame = simulated_frame(lens, grid_of_points(5, 1, 1.8, 0.0), geometry, exposure)
    found, wrong = (
        measure_frame(
            [frame],
            lens_optics(one, np.inf, one.reference_wavelength_um, 3.45),
            FrameRequest(lens=one, unknowns=unknowns, singly=False),
        ).whole
        for one in (lens, round_)
    )
    assert np.abs((found.values - [30.0, 0.2, 0.0]) / found.errors).max() < 5
    assert found.chi2 < 1.1 < 1.3 < wrong.chi2 and not wrong.explains  # another f-number, -8 %, hides some of it
