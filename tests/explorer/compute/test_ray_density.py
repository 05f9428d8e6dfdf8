from time import process_time

import numpy as np
import pytest

from p2sf.conventions import UM_PER_MM, centred_axis
from p2sf.disc.domain import HALF
from p2sf.disc.mask import CLEAR
from p2sf.disc.quadrature import disc_nodes
from p2sf.errors import GeometryError
from p2sf.figures.window import radius_of_energy
from p2sf.psf.geometric import RayBlur, density, geometric_psf, over_unaberrated, polar, ray_blur
from p2sf.psf.methods import psf_of
from p2sf.raytrace.pencil import pencil
from p2sf_explorer.compute.deferred_sums import SumCache
from p2sf_explorer.compute.live import live
from p2sf_explorer.compute.measured import MeasureRequest, measure_request
from p2sf_explorer.compute.setup import default_state, paraxial_setup, with_lens
from p2sf_explorer.compute.views.mtf import Contrast, contrast
from p2sf_explorer.compute.views.profiles import answer as finished
from p2sf_explorer.compute.views.profiles import profiles
from p2sf_explorer.compute.warnings import TOGETHER
from p2sf_explorer.state.limits import CHOICES
from p2sf_explorer.state.state import State, change, new_state
from tests.support.tiers import in_tiers

BLURRED = new_state(depth_mm=300.0, focus_mm=None, field_deg=8.0, method="auto")
TOO_BLURRED = change(BLURRED, depth_mm=10.0)  # for a sum of waves


def ray_density(setup, exact, window, quality="settled"):
    return geometric_psf(setup.lens, setup.source, window, quality, six=None if exact else setup.coefficients)


def moments(psf) -> np.ndarray:
    """Return mean y and the variances of x and y, µm and µm², each pixel a square of even light."""
    axis = centred_axis(psf.values.shape[0], psf.pixel_um)
    across, along = psf.values.sum(0), psf.values.sum(1)
    mean = along @ axis
    return np.array([mean, across @ axis**2, along @ (axis - mean) ** 2])


UNEVEN = [  # light over the pupil differs by some ten per cent and more
    new_state(field_deg=14.0, sensor_shift_um=800.0),
    change(default_state("tessar"), field_deg=20.0, sensor_shift_um=800.0),
    change(default_state("wide_angle_35"), field_deg=30.0, sensor_shift_um=400.0),
]


@pytest.mark.parametrize("state", [BLURRED, *UNEVEN], ids=["defocus", "double_gauss", "tessar", "wide_angle"])
@pytest.mark.parametrize("quality", ["settled", "preview"])
def test_the_density_has_the_moments_of_the_light(state, quality):
    """Against a dense sum over rays, each by the light that it carries."""
    setup, nodes = paraxial_setup(state), disc_nodes(24, 48)
    rays = pencil(setup.lens, setup.source, nodes.xi, nodes.eta)
    x, y = UM_PER_MM * rays.dx, UM_PER_MM * rays.dy
    light = nodes.weight * rays.light
    light /= light.sum()
    mean = light @ y
    exact = np.array([mean, light @ x**2, light @ (y - mean) ** 2])
    pixel = 2.2 * max(np.abs(x).max(), np.abs(y).max()) / 128
    psf = ray_density(setup, True, (128, pixel), quality)
    assert psf.values.sum() == pytest.approx(1)
    assert psf.energy == pytest.approx(1)
    found = moments(psf)
    # Sharing a ray among pixels, each by its nearness, keeps the mean and adds f(1 − f)·pixel² to a variance: 1/6 of it
    # on the average over places f in a pixel. Straight lines between traced rays cost some thousandths.
    coarse = 1 if quality == "settled" else 4  # (12 × 24) rays for (20 × 48)
    assert found[0] == pytest.approx(exact[0], abs=0.02 * coarse * pixel)
    assert found[1:] == pytest.approx(exact[1:] + pixel**2 / 6, rel=5e-3 * coarse)


def test_pure_defocus_is_an_even_disc_of_the_known_size():
    setup = paraxial_setup(new_state(depth_mm=1500.0, field_deg=0.0, f_number=22.0, method="seidel"))
    c = setup.coefficients
    radius = abs(2 * float(c.wd + c.w40) * setup.source.wavelength_um / float(c.reduced_slope))
    psf = ray_density(setup, False, (64, 2.4 * radius / 64))
    assert moments(psf)[1] == pytest.approx(radius**2 / 4, rel=0.01)  # W40 is a thousandth of Wd here
    lit = psf.values[psf.values > 0.5 * psf.values.max()]
    assert lit.size == pytest.approx(np.pi * radius**2 / psf.pixel_um**2, rel=0.03)


@pytest.mark.parametrize(
    ("exact", "quality", "pixels"), [(True, "settled", 128), (False, "settled", 128), (True, "preview", 64)]
)
def test_an_even_blur_has_neither_a_hole_nor_rings(exact, quality, pixels):
    setup = paraxial_setup(new_state(depth_mm=1500.0, field_deg=0.0, f_number=22.0, method="seidel"))
    c = setup.coefficients
    radius = abs(2 * float(c.wd + c.w40) * setup.source.wavelength_um / float(c.reduced_slope))
    psf = ray_density(setup, exact, (pixels, 2.4 * radius / pixels), quality)
    axis = centred_axis(pixels, psf.pixel_um)
    inner = psf.values[np.hypot(*np.meshgrid(axis, axis)) < 0.85 * radius] / np.median(psf.values[psf.values > 0])
    # Each ray is shared by four pixels, so a pattern of rays some two to a pixel leaves a few per cent, and no more.
    assert inner.min() > 0.9 and inner.max() < 1.1


@pytest.mark.parametrize("pixels", [8, 9])
def test_each_ray_is_shared_by_the_pixels_about_it_and_its_mirror_image(pixels):
    """One ray a quarter of a pixel right of and above the chief ray's pixel; beyond the window nothing comes back."""
    middle, one = pixels // 2, np.array([[0.5]])
    found = density(RayBlur(0.5 * one, 0.5 * one, 2 * one, HALF), pixels, 1.0)
    right, level = np.array([0.0, 0.75, 0.25]) / 2, np.array([0.75, 0.25])
    assert found[middle : middle + 2, middle - 1 : middle + 2] == pytest.approx(np.outer(level, right + right[::-1]))
    assert found.sum() == pytest.approx(1)
    for place in (middle + 1.0, np.inf, -middle - 1.0):
        assert density(RayBlur(place * one * 2, 0 * one, 2 * one, HALF), pixels, 1.0).sum() == 0
        assert density(RayBlur(0 * one, place * one * 2, 2 * one, HALF), pixels, 1.0).sum() == 0


def test_interpolated_rays_land_where_traced_ones_do():
    setup = paraxial_setup(BLURRED)
    blur = ray_blur(setup.lens, setup.source)
    x, y = blur.x_um, blur.y_um
    xi, eta, _ = polar(*x.shape)
    some = slice(None, None, 997)
    rays = pencil(setup.lens, setup.source, xi.ravel()[some], eta.ravel()[some])
    reach = UM_PER_MM * np.abs(rays.dy).max()
    assert blur.domain is HALF and blur.light.sum() == pytest.approx(1)
    # Straight lines between 20 × 48 rays: the curvature of a blur of aberrations leaves some thousandths of its reach.
    assert np.abs(x.ravel()[some] - UM_PER_MM * rays.dx).max() < 5e-3 * reach
    assert np.abs(y.ravel()[some] - UM_PER_MM * rays.dy).max() < 5e-3 * reach


def test_the_window_says_that_it_shows_rays_only():
    answer = live(TOO_BLURRED)
    assert answer.psf.method == "geometric"
    assert "ray density, no diffraction" in str(answer.why)
    assert any("ray density, no diffraction" in str(sentence) for sentence in answer.warnings)
    assert not any("ray density" in str(sentence) for sentence in live(new_state(method="fitted")).warnings)


@pytest.mark.parametrize("name", in_tiers(["wide_angle_35", "fast_gauss_f14"], ("wide_angle_35",)))
def test_a_few_far_rays_do_not_shrink_the_picture_to_a_dot(name):
    """Neither of waves nor, while they are summed, of ray density."""
    state = change(default_state(name), method="auto", field_deg=15.0, aim="paraxial")
    stand_in = live(state, cache=SumCache())
    answer = live(state)
    half = answer.psf.pixel_um * answer.psf.values.shape[0] / 2
    assert (stand_in.psf.method, answer.psf.method) == ("geometric", "traced")
    assert radius_of_energy(answer.psf, 0.8) > half / 4
    assert 0.85 < stand_in.psf.energy < 0.995  # nine tenths at least but for what diffraction and round widths change
    assert stand_in.psf.values.shape[0] * stand_in.psf.pixel_um == pytest.approx(2 * half)


def test_many_samples_show_blocks_of_rays_and_not_single_ones():
    setup = paraxial_setup(BLURRED)
    few, many = (ray_density(setup, True, (count, 8000.0 / count)) for count in (128, 512))
    np.testing.assert_allclose(many.values, np.kron(few.values, np.full((4, 4), 1 / 16)), rtol=1e-12)


def test_ray_density_quotes_no_strehl_ratio():
    answer = live(TOO_BLURRED)
    assert answer.psf.method == "geometric" and answer.psf.strehl is None and answer.psf.predicted_error is None
    assert over_unaberrated(answer.psf, float(answer.setup.coefficients.na), CLEAR).sum() > 0


def test_a_blur_of_defocus_is_seen_to_its_rim_and_asks_for_focus():
    answer = live(TOO_BLURRED)
    assert answer.psf.energy == pytest.approx(1)
    assert TOGETHER in [sentence.values.get("remedy") for sentence in answer.warnings]


FRONT_FOCUS_MM = 29.320641615228546  # the depth whose image the default lens puts at infinity, to the last bit


@pytest.mark.slow
@pytest.mark.parametrize("quality", ["settled", "preview"])
@pytest.mark.parametrize("method", CHOICES["method"])
def test_an_object_in_the_front_focal_plane_is_the_same_sentence_by_every_method(method, quality):
    with pytest.raises(GeometryError, match=r"lies at infinity .*; move the object or refocus"):
        live(new_state(depth_mm=FRONT_FOCUS_MM, method=method), quality)
    assert live(new_state(depth_mm=FRONT_FOCUS_MM * (1 + 1e-12), method=method), quality).psf.values.sum() > 0.5


def test_what_needs_the_pupil_of_many_waves_waits_for_a_worker():
    """Of a fast lens at full field it takes seconds to find: 16 s in each of these frames, where one has 50 ms.

    The bound leaves room for a busy machine; without the pupil both views take some milliseconds.
    """
    state = with_lens(State(), "fast_gauss_f14")
    for field in (12.0, 28.0):
        for quality in ("preview", "settled"):
            answer = live(change(state, field_deg=field), quality, cache=SumCache())
            assert answer.psf.method == "geometric"
            before = process_time()
            assert isinstance(contrast(answer).question, MeasureRequest)
            curves = profiles(answer).found
            assert process_time() - before < 0.5
            assert curves.pending == measure_request(answer) or quality == "preview"


@pytest.mark.parametrize(("lens", "field", "method"), [("fast_gauss_f14", 12.0, "auto"), ("petzval", 3.0, "huygens")])
def test_sections_and_measures_of_a_picture_that_came_late_wait_too(lens, field, method):
    """They took up to a second of the window's thread when the sum of waves came, after each step of the slider."""
    state, cache = change(with_lens(State(), lens), field_deg=field, method=method), SumCache()
    request = live(state, cache=cache).pending
    cache.keep(request, psf_of(request))
    late = live(state, cache=cache)
    assert late.psf.method != "geometric" and isinstance(contrast(late).question, MeasureRequest)
    rough = profiles(late).found
    whole = finished(rough, lambda: False, lambda share, found: None)
    assert rough.rough and rough.pending and not whole.rough and whole.pending is None
    assert np.isnan(rough.energy).all() and np.isfinite(whole.energy).all()
    middle = late.psf.values.shape[0] // 2
    for section, samples in ((whole.along_x, late.psf.values[middle]), (whole.along_y, late.psf.values[:, middle])):
        assert np.corrcoef(section, np.interp(whole.position_um, late.psf.x_um, samples))[0, 1] > 0.99


def test_what_is_found_within_a_frame_does_not_wait():
    answer = live(with_lens(State(), "cooke_triplet"))
    assert isinstance(contrast(answer).found, Contrast) and profiles(answer).found.pending is None
