"""One point: the model against the library's own PSFs, its derivatives and symmetries, and fits of noisy pictures."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.lens.lens import with_aim
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.measure.fitting import point_fit
from p2sf.measure.fitting.point_fit import fit_point
from p2sf.measure.fitting.point_model import PictureOptics, PixelSum
from p2sf.measure.fitting.point_problem import PointPicture, Problem
from p2sf.measure.fitting.pupil_model import pupil_model
from p2sf.measure.fitting.pupil_nodes import paraxial_nodes
from p2sf.measure.fitting.starting_values import starts
from p2sf.measure.frame import Frame, FrameGeometry
from p2sf.measure.points import find_points
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.fitted import fit, sum_fit
from p2sf.psf.pixel_integrals import render_integrated
from tests.support.tiers import in_tiers

OPTICS = PictureOptics(0.125, 0.55, 2.2)  # pixels of λ/2NA
SIX = np.array([1.2, -0.9, 0.7, -1.4])


def unknowns(numbers, places=((0.0, 0.0),), flux=1.0, background=0.0):
    return np.concatenate([numbers, *[[x, y, flux, background] for x, y in places]])


def problem(model, numbers, pixels=24, optics=OPTICS, foci=(0.0,), azimuth=0.0, place=(0.0, 0.0)):
    """Return a problem on empty pictures, prepared for these numbers, and its unknowns."""
    empty = [PointPicture(np.zeros((pixels, pixels)), 1.0, waves) for waves in foci]
    made, at = Problem(empty, optics, pupil_model(model), azimuth), unknowns(numbers, [place] * len(foci))
    made.prepare(at)
    made.evaluate(at)
    return made, at


def picture_of(light, rng, waves=0.0, noise=0.01):
    peak = 1000 / light.max()
    values = light * peak + 100 + rng.normal(0, 1000 * noise, light.shape)
    return PointPicture(values, (1000 * noise) ** 2, waves)


def with_map(seed, spread=0.01):
    """Return random numbers of the model "26" near the paraxial map, RMS of W some 0.2 waves, less in high orders."""
    model, rng = pupil_model("26"), np.random.default_rng(seed)
    orders = np.array([int(name[2]) for name in model.wave_names])
    waves = rng.normal(0, 0.12 / (orders - 1))
    return np.concatenate([waves, model.paraxial_map + rng.normal(0, spread, len(model.map_names))])


@pytest.mark.parametrize("field_deg", [0.0, 6.0])
def test_light_of_a_lens_is_that_of_its_seidel_psf(field_deg):
    """The Seidel method sums other nodes and adds up finer samples; both bounds on pixels are below 1e-3."""
    lens, pixel = find_lens("cooke_triplet"), 1.5
    source = Source(field_deg=field_deg)
    c = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    psf = render_integrated(lens, source, "seidel", 33, pixel)
    optics = PictureOptics(abs(float(c.reduced_slope)), source.wavelength_um, pixel)
    made, at = problem("seidel", np.array([c.w40, c.w31, c.w22, c.w20 + c.wd], float), 33, optics)
    light, _ = made.light(at, 0)
    assert light == pytest.approx(psf.values * psf.energy, abs=1e-3 * light.max())


def test_light_of_26_numbers_is_that_of_the_fitted_method():
    """The phase of a fit has the other sign than W, and its frequencies run the other way: the same light."""
    lens, source = with_aim(find_lens("double_gauss_28"), "paraxial"), Source(field_deg=8.0)
    found = fit(lens, source, 26)
    phase, *maps = found.level.coefficients(found.function)
    phase[1] = 0.0  # without tilt, which moves the point
    found = replace(found, function=found.level.function(phase, *maps))
    na = abs(float(coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um).reduced_slope))
    optics = PictureOptics(na, source.wavelength_um, 1.0, fill=0.0)
    numbers = np.concatenate([-phase[2:], -maps[0] / optics.cycles, -maps[1][1:] / optics.cycles])
    made, at = problem("26", numbers, 33, optics)
    intensity, _ = sum_fit(found, 33, 1.0)
    assert made.light(at, 0)[0] / made.sums[0].sums[0].scale == pytest.approx(intensity, abs=1e-4 * intensity.max())


@pytest.mark.parametrize(("model", "numbers"), [("seidel", SIX), ("26", with_map(1))])
def test_derivatives_are_those_of_differences(model, numbers):
    """Terms reach 3.7 at the rim: differences err by (2π·3.7·step)²/6 = 4e-4, single precision by 3e-4."""
    made, at = problem(model, numbers, foci=(0.0, 1.5), place=(0.3, -0.5))
    slopes = made.evaluate(at)[1].copy()
    step = 2e-3
    for k in range(at.size):
        move = np.zeros(at.size)
        move[k] = step
        change = (made.evaluate(at + move)[0] - made.evaluate(at - move)[0]) / (2 * step)
        assert slopes[:, k] == pytest.approx(change, abs=2e-3 * np.abs(slopes[:, k]).max())


@pytest.mark.parametrize(("model", "numbers"), [("seidel", SIX), ("26", with_map(2))])
def test_twin_has_the_same_picture_at_one_focus_and_another_at_a_second(model, numbers):
    made, at = problem(model, numbers, foci=(0.0, 1.0))
    other = unknowns(pupil_model(model).twin(numbers), [(0.0, 0.0)] * 2)
    here = [made.light(at, k)[0] for k in (0, 1)]
    made.evaluate(other)
    there = [made.light(other, k)[0] for k in (0, 1)]
    assert there[0] == pytest.approx(here[0], abs=1e-5 * here[0].max())
    assert np.abs(there[1] - here[1]).max() > 0.1 * here[1].max()


def test_twin_counts_the_known_defocus():
    made, at = problem("seidel", SIX, foci=(0.8,))
    here = made.light(at, 0)[0]
    other = unknowns(pupil_model("seidel").twin(SIX, 0.8))
    assert made.light(other, 0)[0] == pytest.approx(here, abs=1e-5 * here.max())


def test_all_light_is_one():
    """What misses a window of 120 pixels of λ/2NA is the diffraction of the rim, some 1/(π²·NA/λ·radius) of it."""
    made, at = problem("seidel", 0.3 * SIX, 120)
    assert made.light(at, 0)[0].sum() == pytest.approx(1.0, abs=4e-3)


def test_a_field_along_x_turns_the_picture():
    up, at = problem("seidel", SIX, 25)
    across, _ = problem("seidel", SIX, 25, azimuth=np.pi / 2)
    light = up.light(at, 0)[0]
    assert across.light(at, 0)[0] == pytest.approx(light.T, abs=1e-5 * light.max())


def test_pixels_average_what_points_sample():
    """Against 15 × 15 points in every pixel, whose midpoint sum errs by 1e-3 of the curvature."""
    nodes = paraxial_nodes((32, 88), OPTICS.cycles)
    phase = SIX @ pupil_model("seidel").waves(nodes.xi, nodes.eta)
    light = PixelSum(nodes, (9, 9), OPTICS).light(phase)
    fine = PixelSum(nodes, (135, 135), PictureOptics(0.125, 0.55, 2.2 / 15, fill=0.0)).light(phase)
    assert light == pytest.approx(fine.reshape(9, 15, 9, 15).sum((1, 3)), abs=2e-3 * light.max())


@pytest.mark.parametrize("seed", in_tiers(range(3), (0,)))
def test_two_foci_give_the_coefficients_with_their_signs(seed):
    """Five standard deviations, of some 0.01 waves each."""
    rng = np.random.default_rng(seed)
    six, place = rng.uniform(-1.5, 1.5, 4), tuple(rng.uniform(-1, 1, 2))
    made, at = problem("seidel", six, 32, foci=(0.0, 1.5), azimuth=0.4, place=place)
    pictures = [picture_of(made.light(at, k)[0], rng, waves) for k, waves in enumerate((0.0, 1.5))]
    found = fit_point(pictures, OPTICS, azimuth_deg=np.rad2deg(0.4))
    assert np.abs((found.numbers - six) / found.bounds).max() < 5
    assert found.bounds.max() < 0.05
    assert found.frames[:, :2] == pytest.approx(np.array([place, place]), abs=0.1)
    assert found.chi2 == pytest.approx(1.0, abs=5 * (2 / 2048) ** 0.5)
    assert found.r2.min() > 0.9 and not found.others and not found.warnings


@pytest.mark.slow
def test_what_explains_each_of_two_pictures_is_tried_where_nothing_explains_both():
    """Starts from both together end in a minimum of 2.5 times the noise; a search of all kinds takes 2 s."""
    six, rng, foci = np.array([1.658, 0.091, -0.226, -2.541]), np.random.default_rng(1), (0.0, 1.5)
    nodes = paraxial_nodes((40, 112), OPTICS.cycles)
    waves, square = six @ pupil_model("seidel").waves(nodes.xi, nodes.eta), nodes.xi**2 + nodes.eta**2
    light = PixelSum(nodes, (40, 40), OPTICS).light
    found = fit_point([picture_of(light(waves + focus * square), rng, focus) for focus in foci], OPTICS)
    assert np.abs((found.numbers - six) / found.bounds).max() < 5 and found.chi2 < 1.2


@pytest.mark.slow
def test_light_of_two_wavelengths_is_the_sum_of_both_by_the_same_path():
    """W is a path: 1 wave at 0.55 µm is 1.1 at 0.5. Each colour by itself has its own NA/λ and its own waves.

    Fitted with light of both, five standard deviations; as of one wavelength, it misses by more.
    """
    light = ((0.45, 1.0), (0.65, 1.0))
    both = replace(OPTICS, light=light)
    made, at = problem("seidel", SIX, 32, both, (0.0, 1.5), place=(0.4, -0.3))
    wanted = 0.0
    for wave, share in light:
        ratio = 0.55 / wave
        numbers = SIX * ratio
        own, there = problem(
            "seidel", numbers, 32, replace(OPTICS, wavelength_um=wave), (0.0, 1.5 * ratio), 0.0, (0.4, -0.3)
        )
        wanted = wanted + share / 2 * np.array([own.light(there, k)[0] for k in (0, 1)])
    here = np.array([made.light(at, k)[0] for k in (0, 1)])
    assert here == pytest.approx(wanted, abs=1e-3 * wanted.max())
    rng = np.random.default_rng(0)
    pictures = [picture_of(part, rng, waves) for part, waves in zip(wanted, (0.0, 1.5), strict=True)]
    found = fit_point(pictures, both)
    assert np.abs((found.numbers - SIX) / found.bounds).max() < 5 and not found.warnings
    other = fit_point(pictures, OPTICS)
    assert np.abs((other.numbers - SIX) / other.bounds).max() > 5


@pytest.mark.slow
def test_derivatives_of_a_turned_map_are_those_of_differences():
    """As above."""
    made, at = problem("26", with_map(3), 20, azimuth=2.2, place=(0.3, -0.5))
    slopes = made.evaluate(at)[1].copy()
    for k in range(at.size):
        move = np.where(np.arange(at.size) == k, 2e-3, 0.0)
        change = (made.evaluate(at + move)[0] - made.evaluate(at - move)[0]) / 4e-3
        assert slopes[:, k] == pytest.approx(change, abs=2e-3 * np.abs(slopes[:, k]).max())


def test_a_map_for_a_field_along_x_turns_the_picture():
    """By rows of the other axis. Of a picture that is even about its field, a quarter turn is the transpose."""
    up, at = problem("26", with_map(4), 25)
    across, there = problem("26", with_map(4), 25, azimuth=np.pi / 2)
    light = up.light(at, 0)[0]
    assert across.light(there, 0)[0] == pytest.approx(light.T, abs=1e-4 * light.max())


@pytest.mark.slow
def test_26_numbers_are_fitted_at_any_azimuth():
    """Near a wave the map's numbers hardly show; W over the pupil is within a few standard deviations."""
    rng, numbers = np.random.default_rng(12), with_map(12)
    made, at = problem("26", numbers, 22, foci=(0.0, 1.5), azimuth=np.deg2rad(-128))
    pictures = [picture_of(made.light(at, k)[0], rng, waves) for k, waves in enumerate((0.0, 1.5))]
    found = fit_point(pictures, OPTICS, "26", azimuth_deg=-128)
    assert found.chi2 == pytest.approx(1.0, abs=5 * (2 / 968) ** 0.5)
    waves = slice(0, len(found.model.wave_names))
    assert np.abs((found.numbers - numbers) / found.bounds)[waves].max() < 5


def test_derivatives_in_light_of_two_wavelengths_are_those_of_differences():
    """As above."""
    made, at = problem("26", with_map(3), 20, replace(OPTICS, light=((0.5, 1.0), (0.6, 2.0))), place=(0.3, -0.5))
    slopes = made.evaluate(at)[1].copy()
    for k in range(at.size):
        move = np.where(np.arange(at.size) == k, 2e-3, 0.0)
        change = (made.evaluate(at + move)[0] - made.evaluate(at - move)[0]) / 4e-3
        assert slopes[:, k] == pytest.approx(change, abs=2e-3 * np.abs(slopes[:, k]).max())


def test_light_that_cannot_be_is_refused():
    for light in (((0.5, 0.0),), ((-0.5, 1.0),), ((np.inf, 1.0),)):
        with pytest.raises(RequestError, match="two positive numbers"):
            replace(OPTICS, light=light)


def test_one_focus_names_the_twin():
    rng = np.random.default_rng(5)
    made, at = problem("seidel", SIX, 32)
    found = fit_point([picture_of(made.light(at, 0)[0], rng)], OPTICS)
    both = np.array([found.numbers, found.others[0]])
    assert found.others[0] == pytest.approx([-1, 1, -1, -1] * found.numbers)
    assert np.abs(both - SIX).max(1).min() < 0.1
    assert "one focus" in str(found.warnings[0])


def test_26_numbers_leave_only_the_noise():
    """Near a wave the map's numbers hardly show; W over the pupil is within a few standard deviations."""
    rng, numbers = np.random.default_rng(11), with_map(11)
    made, at = problem("26", numbers, 32, foci=(0.0, 1.5))
    pictures = [picture_of(made.light(at, k)[0], rng, waves) for k, waves in enumerate((0.0, 1.5))]
    found = fit_point(pictures, OPTICS, "26")
    assert found.chi2 == pytest.approx(1.0, abs=5 * (2 / 2048) ** 0.5)
    waves = slice(0, len(found.model.wave_names))
    assert np.abs((found.numbers - numbers) / found.bounds)[waves].max() < 5


def test_a_hot_pixel_counts_little_with_a_robust_loss_and_not_at_all_masked():
    rng = np.random.default_rng(3)
    made, at = problem("seidel", SIX, 28, foci=(0.0, 1.5))
    pictures = [picture_of(made.light(at, k)[0], rng, waves) for k, waves in enumerate((0.0, 1.5))]
    hot = pictures[0].values.copy()
    hot[4, 5] = 5000
    good = hot < 4000
    for picture, loss in (
        (PointPicture(hot, pictures[0].variance), "cauchy"),
        (PointPicture(hot, pictures[0].variance, good=good), "linear"),
    ):
        found = fit_point([picture, pictures[1]], OPTICS, loss=loss)
        assert np.abs((found.numbers - SIX) / found.bounds).max() < 5


def test_a_sharp_point_in_the_middle_of_a_pixel_is_no_hot_pixel():
    """Its neighbours lie in the first dark ring, 30 times darker. Five standard deviations."""
    rng, optics = np.random.default_rng(1), replace(OPTICS, pixel_um=3.45)
    made, at = problem("seidel", np.zeros(4), 32, optics, (0.0, 1.5))
    pictures = [picture_of(made.light(at, k)[0], rng, waves) for k, waves in enumerate((0.0, 1.5))]
    values = pictures[0].values
    assert values[16, 16] - 100 > 15 * (values[16, 17] - 100)
    (point,) = find_points(Frame(values, FrameGeometry(32, 32, 3.45)))
    assert point.good and (round(point.row), round(point.column)) == (16, 16)
    found = fit_point(pictures, optics)
    assert np.abs(found.numbers / found.bounds).max() < 5
    assert found.chi2 == pytest.approx(1.0, abs=5 * (2 / 2048) ** 0.5)


def test_what_cannot_be_fitted_is_refused():
    rng = np.random.default_rng(0)
    empty = PointPicture(100 + rng.normal(0, 10, (24, 24)), 100.0)
    with pytest.raises(RequestError, match="no point rises above"):
        fit_point([empty], OPTICS)
    with pytest.raises(RequestError, match="there is no picture"):
        fit_point([], OPTICS)
    with pytest.raises(RequestError, match="4 usable pixels for 8 unknowns"):
        fit_point([PointPicture(np.ones((2, 2)))], OPTICS)
    with pytest.raises(RequestError, match="choose seidel"):
        fit_point([empty], OPTICS, "27")
    with pytest.raises(RequestError, match="linear"):
        fit_point([empty], OPTICS, loss="quadratic")


def test_starts_from_each_of_two_pictures_explain_it_alone_in_both_ways(monkeypatch):
    """By the numbers that are found of it, here those that it was made of, and by their twin of the other sign."""
    rng, foci, six = np.random.default_rng(1), (0.0, 1.0), np.array([0.5, 0.4, -0.3, 0.6])
    nodes = paraxial_nodes((24, 64), OPTICS.cycles)
    waves, square = six @ pupil_model("seidel").waves(nodes.xi, nodes.eta), nodes.xi**2 + nodes.eta**2
    lights = [PixelSum(nodes, (14, 14), OPTICS).light(waves + focus * square) for focus in foci]
    made = [picture_of(light, rng, focus) for light, focus in zip(lights, foci, strict=True)]
    alone = [SimpleNamespace(unknowns=unknowns(six, flux=1000 / light.max(), background=100.0)) for light in lights]
    monkeypatch.setattr(point_fit, "_six", lambda pictures, *_: [alone[made.index(pictures[0])]])
    found = point_fit._from_each(made, OPTICS, 0.0, "linear", starts(made, OPTICS, 0.0, 6)[0])
    assert len(found) == 4
    for number, start in enumerate(found):
        frames, picture = start[4:].reshape(2, -1), number // 2
        one = Problem([made[picture]], OPTICS, pupil_model("seidel"), 0.0)
        own = np.concatenate([start[:4], frames[picture]])
        one.prepare(own)
        assert np.square(one.residuals(own)).sum() < 1.3 * one.freedom
        assert frames[0, :2] == pytest.approx(frames[1, :2]) and np.sign(start[0]) == (1, -1)[number % 2]
