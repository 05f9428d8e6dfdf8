"""The Strehl ratio: the peak of the continuous picture, whatever samples show, against dense sums over the pupil."""

import pickle
import tracemalloc
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

import p2sf
from p2sf.disc.domain import WHOLE
from p2sf.figures.psf_data import PsfFigures
from p2sf.lens.lens import with_f_number
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf import peak
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.methods import render, whole_pixel_um
from p2sf.psf.picture import psf_of_pupil
from p2sf.psf.pixel_integrals import render_integrated
from p2sf.psf.result import Psf
from p2sf.psf.seidel import seidel_psf
from p2sf.psf.spherical import spherical_pupil
from p2sf.pupil.plane_waves import BLOCK, Waves
from p2sf.raytrace.pencil import pencil
from p2sf.setting import Request, set_up
from tests.support.waves import waves

SHARP = [("double_gauss_28", 11.0, 7.0), ("cooke_triplet", 16.0, 0.0), ("petzval", 11.0, 3.0)]  # f-number, field


def setup_of(name: str, f_number: float, field_deg: float):
    setup = set_up(find_lens(name), Request(f_number=f_number, field_deg=field_deg))
    return setup.lens, setup.source


def disc(radii: int = 40, directions: int = 96) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    node, weight = leggauss(radii)
    radius, angle = np.meshgrid(
        np.sqrt((1 + node) / 2), (np.arange(directions) + 0.5) * (2 * np.pi / directions), indexing="ij"
    )
    return (
        (radius * np.sin(angle)).ravel(),
        (radius * np.cos(angle)).ravel(),
        np.repeat(weight / 2 / directions, directions),
    )


def brightest(amplitude, fx, fy, around, step) -> float:
    """Return the largest |Σ amplitude·exp(2πi f·x)|² over a grid of 41 × 41 points about a place."""
    aside = step * np.arange(-20, 21)
    x, y = (np.exp(2j * np.pi * np.outer(place + aside, f)) for place, f in zip(around, (fx, fy), strict=True))
    return float((np.abs((y * amplitude) @ x.T) ** 2).max())


@pytest.mark.parametrize("place", SHARP, ids=str)
@pytest.mark.parametrize("method", ["seidel", "fitted", "traced", "huygens"])
def test_it_does_not_depend_on_the_pixel(place, method):
    lens, source = setup_of(*place)
    found = [render(lens, source, method, pixels, pixel_um) for pixels, pixel_um in ((64, 0.25), (32, 0.9), (17, 3.1))]
    for psf in found[1:]:
        assert psf.strehl == pytest.approx(found[0].strehl, rel=2e-4)  # traced: a fit to 1e-3 waves between samples
        assert psf.peak_um == pytest.approx(found[0].peak_um, abs=0.02)


@pytest.mark.parametrize("place", SHARP, ids=str)
@pytest.mark.parametrize("method", ["fitted", "traced", "huygens"])
def test_it_is_the_largest_value_of_a_dense_sum_of_exact_rays(place, method):
    lens, source = setup_of(*place)
    xi, eta, share = disc()
    rays = pencil(lens, source, xi, eta)
    weight, wavelength = share * rays.amplitude, float(source.wavelength_um)
    amplitude = weight / weight.sum() * np.exp(2j * np.pi * rays.phase)
    fx, fy = (np.asarray(rays.index) * k / wavelength for k in (rays.kx, rays.ky - rays.chief_ky))
    psf = render(lens, source, method, 32, 0.9)
    truth = brightest(amplitude, fx, fy, psf.peak_um, 0.02)  # µm: what a grid misses of a peak is below 1e-4
    assert psf.strehl == pytest.approx(truth, rel=2e-3 if method == "fitted" else 2e-4)


@pytest.mark.parametrize("six", [(0.3, 0.5, -0.2, 0.1, 0.0, -0.3), (0.0, 0.9, 0.0, 0.0, 0.0, 0.0)])
def test_of_six_coefficients_it_is_that_of_the_definition(six):
    c = waves(*six)
    psf, (xi, eta, share) = seidel_psf(c, 33, 1.7), disc()
    scale = -float(c.reduced_slope) / float(c.wavelength_um)  # the field is ΣP·exp(−i2πn′u′(ξx + ηy)/λ)
    amplitude = share * np.exp(2j * np.pi * np.asarray(wavefront(c, xi, eta)))
    assert psf.strehl == pytest.approx(brightest(amplitude, scale * xi, scale * eta, psf.peak_um, 0.02), rel=2e-4)
    several = seidel_psf(waves(*(np.array([value, 0.5 * value]) for value in six)), 33, 1.7)
    assert several.strehl[0] == pytest.approx(psf.strehl, rel=1e-6) and several.peak_um.shape == (2, 2)


@pytest.mark.parametrize("part", [0.76, 0.92, 0.94, 0.96])
def test_of_two_lobes_it_is_the_higher_one_though_samples_meet_the_lower_one_better(part):
    """Samples up to λ/4NA apart show the lower lobe brighter; the peak was 7 % too low."""
    c, (xi, eta, share) = waves(0.682, 0.610, -1.947, 0.0, 0.0, 0.891), disc()
    scale = -float(c.reduced_slope) / float(c.wavelength_um)
    amplitude = share * np.exp(2j * np.pi * np.asarray(wavefront(c, xi, eta)))
    dense = np.linspace(-15, 15, 301)
    x, y = (np.exp(2j * np.pi * np.outer(dense, scale * k)) for k in (xi, eta))
    truth = float((np.abs((y * amplitude) @ x.T) ** 2).max())
    assert seidel_psf(c, 75, part / (4 * abs(scale))).strehl == pytest.approx(truth, rel=3e-3)


def test_one_pass_of_huygens_has_the_peak_of_the_converged_one():
    """At 14 and 20 degrees the brightest sample stands on another ring than the peak, which is up to 12 % higher."""
    lens = find_lens("cooke_triplet")
    for field in (14.0, 20.0):
        once, converged = (huygens_psf(lens, Source(field_deg=field), 40, 1.7, tolerance) for tolerance in (None, 1e-4))
        assert once.strehl == pytest.approx(converged.strehl, rel=1e-4)


def test_pixels_that_gather_light_have_the_same_one():
    lens, source = setup_of(*SHARP[0])
    sampled, gathered = render(lens, source, "traced", 32, 0.5), render_integrated(lens, source, "traced", 16, 4.0)
    assert gathered.integrated and not sampled.integrated
    assert gathered.strehl == pytest.approx(sampled.strehl, rel=2e-4)
    assert gathered.over_unaberrated.max() < 0.9 * gathered.strehl  # the mean over a pixel


def test_of_a_wavefront_on_a_grid_it_is_that_of_a_perfect_pupil_beside_the_samples():
    """A tilt moves the peak between samples and takes nothing from it: half a wave over the radius, 0.61 Airy radii."""
    axis = (2 * np.arange(256) + 1 - 256) / 256
    psf = p2sf.psf_of_opd(0.13 * axis[:, None] * np.ones(256), na=0.1, wavelength_nm=550)
    assert psf.strehl == pytest.approx(1, abs=1e-6)
    assert np.hypot(*psf.peak_um) == pytest.approx(0.13 * 0.55 / 0.1, rel=1e-3)
    assert psf.values.max() * psf.sum_over_peak < 0.999


@pytest.mark.parametrize(("defocus", "piston"), [(3.0, 0.0), (2.0, 30.0)])
def test_of_a_wavefront_on_a_grid_it_is_within_one_period_of_its_picture(defocus, piston):
    """What is opaque has no slope: its zeros beside a wave at the rim once sent the search thousands of µm aside."""
    axis = (2 * np.arange(128) + 1 - 128) / 128
    opd = defocus * (axis**2 + axis[:, None] ** 2) + piston
    opd[np.hypot(axis, axis[:, None]) > 1] = np.nan
    psf = p2sf.psf_of_opd(opd, na=0.1, wavelength_nm=500, pixels=64)
    lit = np.isfinite(opd)
    eta, xi = (k[lit] for k in np.meshgrid(axis, axis, indexing="ij"))
    dense = np.linspace(-20, 20, 201)
    x, y = (np.exp(2j * np.pi * np.outer(dense, 0.2 * k)) for k in (xi, eta))
    truth = (np.abs((y * np.exp(2j * np.pi * opd[lit])) @ x.T) ** 2).max() / lit.sum() ** 2
    assert psf.strehl == pytest.approx(truth, rel=0.03)  # whose rim has no parts of cells
    assert psf.strehl >= psf.over_unaberrated.max() * (1 - 1e-9)
    assert np.hypot(*psf.peak_um) < 20


@pytest.mark.filterwarnings("ignore::p2sf.P2SFWarning")
def test_a_single_lit_cell_is_equally_bright_everywhere():
    for lit in (np.ones((1, 1)), np.arange(9).reshape(3, 3) == 4):
        psf = p2sf.psf_of_opd(0 * lit, na=0.1, wavelength_nm=500, amplitude=1.0 * lit, pixels=1)
        assert psf.strehl == pytest.approx(1) and psf.peak_um == (0, 0)


def test_figures_given_as_functions_are_asked_for_once_and_travel_as_numbers():
    calls = []

    def strehl() -> float:
        calls.append(1)
        return 0.25

    psf = Psf(np.full((4, 4), 1 / 16), 1.0, 0.5, "seidel", PsfFigures(strehl, energy=0.5))
    assert not calls
    copy = pickle.loads(pickle.dumps(psf))
    assert (psf.strehl, copy.strehl, copy.energy, copy.peak_um, len(calls)) == (0.25, 0.25, 0.5, None, 1)
    with pytest.raises(FrozenInstanceError):
        psf.strehl = 1.0


def test_a_rendered_preview_looks_for_its_peak_when_that_is_read():
    source = Source(field_deg=(0.6, 0.8))  # which is given its azimuth, after its method its error
    psf = p2sf.render(find_lens("achromat_f6"), source, "seidel", quality="preview")
    assert callable(psf.figures.peak_um) and psf.azimuth_deg and psf.predicted_error is not None
    again = replace(psf, seconds=0.0)
    assert again.strehl == psf.strehl and again.peak_um == psf.peak_um and again.values is psf.values


def test_a_preview_takes_the_highest_place_between_samples_not_the_brightest_sample():
    """Where these differ: two lobes of one blur, of which samples meet the lower one better."""
    lens, source = find_lens("phone_f28"), p2sf.Source(field_deg=30)
    preview, settled = (p2sf.render(lens, source, "seidel", quality=quality) for quality in ("preview", "settled"))
    assert preview.strehl == pytest.approx(settled.strehl, rel=5e-3)  # the other lobe has 4 % less
    assert preview.peak_um[1] == pytest.approx(settled.peak_um[1], abs=0.05)


@pytest.mark.parametrize("call", ["look up", "render", "points"])
def test_nobody_pays_for_a_peak_that_is_not_read(call, monkeypatch):
    lens = find_lens("achromat_f6")
    database = p2sf.build_database(lens, [3000, 5000], [0, 1], [550, 600])
    monkeypatch.setattr(peak, "climb", lambda *given: pytest.fail("a peak is sought"))
    calls = {
        "look up": lambda: database.psf(p2sf.Source(4000, field_deg=0.5), 32),
        "render": lambda: p2sf.render(lens, p2sf.Source(field_deg=1), "huygens", pixels=32),
        "points": lambda: p2sf.Camera(lens).at(field_deg=[0.0, 1.0]).psf("traced", pixels=16, pixel_um=2.0),
    }
    assert calls[call]() is not None


@pytest.mark.parametrize(
    ("six", "maxima", "alike"),
    [
        ((0.0, 0.0, 2.0, 0.0, 0.0, -1.0), 8, 0),  # astigmatism at medial focus: all at one distance
        ((0.682, 0.610, -1.947, 0.0, 0.0, 0.8368), 2, 1),
        ((0.0, 0.4, 0.0, 0.0, 0.0, 0.0), 1, 0),
    ],
)
def test_it_says_how_many_maxima_are_as_high_at_other_distances_from_the_chief_ray(six, maxima, alike):
    c, (xi, eta, share) = waves(*six), disc()
    scale = -float(c.reduced_slope) / float(c.wavelength_um)
    amplitude = share * np.exp(2j * np.pi * np.asarray(wavefront(c, xi, eta)))
    dense = np.linspace(-12, 12, 481)
    x, y = (np.exp(2j * np.pi * np.outer(dense, scale * k)) for k in (xi, eta))
    light = np.abs((y * amplitude) @ x.T) ** 2
    inner = light[1:-1, 1:-1]
    about = np.max([light[1 + i : 480 + i, 1 + k : 480 + k] for i in (-1, 0, 1) for k in (-1, 0, 1) if i or k], axis=0)
    row, column = np.nonzero((inner > about) & (inner > 0.998 * light.max()))
    distances = np.hypot(dense[1:-1][column], dense[1:-1][row])
    assert distances.size == maxima and np.unique(distances.round(1)).size == alike + 1
    assert seidel_psf(c, 33, 1.7).other_peaks == alike


def test_it_is_never_below_a_sample_of_the_picture():
    """A law, in blurs much wider than the window, whose waves beyond are too many to be searched whole."""
    rng = np.random.default_rng(7)
    for _ in range(8):
        lens = with_f_number(find_lens("landscape"), float(rng.uniform(4, 8)))
        source = Source(float(rng.uniform(800, 3000)), field_deg=float(rng.uniform(2, 9)))
        psf = render(lens, source, "huygens", 16, 0.7)
        assert psf.strehl >= psf.over_unaberrated.max() * (1 - 1e-9)


def test_of_spherical_waves_it_is_not_below_a_sample_either():
    """Where plane waves say where to look, their maxima are not those of the picture."""
    psf = render(find_lens("double_gauss_28"), Source(3000, field_deg=10), "spherical", 32, 0.7)
    assert psf.strehl >= psf.over_unaberrated.max() * (1 - 1e-9)


def test_the_light_near_a_point_of_millions_of_waves_takes_little_memory():
    """In blocks; all at once took 200 bytes a wave. The sums beside it are the test's own, of some of the waves."""
    rng = np.random.default_rng(3)
    count = 3 * BLOCK + 17
    fx, fy = 0.2 * rng.random((2, count)) - 0.1
    amplitude = np.exp(2j * np.pi * rng.random(count)) / count
    tracemalloc.start()
    value, step_x, step_y, gain = Waves(amplitude, fx, fy, WHOLE, 1.0).near(0.3, -0.7)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 200 * BLOCK

    def light(x, y):
        return abs((amplitude * np.exp(2j * np.pi * (fx * x + fy * y))).sum()) ** 2

    h = 0.05  # µm: third differences leave (2π·0.1·h)² = 1e-3 of a slope
    across = (light(0.3 + h, -0.7) - light(0.3 - h, -0.7)) / (2 * h)
    up = (light(0.3, -0.7 + h) - light(0.3, -0.7 - h)) / (2 * h)
    assert value == pytest.approx(light(0.3, -0.7), rel=1e-9)
    assert across * step_x + up * step_y == pytest.approx(2 * gain, rel=1e-2) and gain > 0


@pytest.mark.parametrize(("name", "field_deg", "f_number"), [("landscape", 9.8, 9.7), ("double_gauss_28", 14.0, 4.0)])
def test_plane_waves_lead_to_the_peak_of_many_spherical_ones(name, field_deg, f_number, monkeypatch):
    """As many as these are still searched by their own sum, which of a million took minutes."""
    lens, source = with_f_number(find_lens(name), f_number), Source(field_deg=field_deg)
    window = 24, whole_pixel_um(lens, source, 24)
    found = []
    for most in (0, 2**30):
        monkeypatch.setattr(peak, "MANY_WAVES", most)
        found.append(psf_of_pupil(spherical_pupil(lens, source), window).strehl)
    assert found[0] == pytest.approx(found[1], rel=1e-6)


@pytest.mark.filterwarnings("error::RuntimeWarning")
@pytest.mark.parametrize("method", ["huygens", "spherical"])
def test_of_one_sample_within_too_wide_a_blur_it_is_that_sample(method):
    psf = render(find_lens("landscape"), Source(50.0), method, 1, 0.1)
    assert psf.peak_um == (0.0, 0.0) and 0 < psf.strehl < 1e-4
