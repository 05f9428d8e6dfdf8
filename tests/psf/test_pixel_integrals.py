"""Light per pixel against plain sums over rays at many points of a pixel."""

import numpy as np
import pytest
from scipy.special import j1

import p2sf
from p2sf.database.build import build_database
from p2sf.database.fitted_build import build_fitted
from p2sf.database.render import Sampling, critical_pixel_um, pixels_psf, render_source, rendered_light
from p2sf.database.space import Space
from p2sf.errors import GeometryError, SamplingError
from p2sf.figures import pixel_light
from p2sf.figures.pixel_light import FineGrid
from p2sf.figures.psf_data import Later
from p2sf.lens.lens import with_aim, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.methods import render
from p2sf.psf.pixel_integrals import render_integrated
from p2sf.psf.result import IN_WINDOW, LEAST_LIGHT
from tests.support.pupil_sums import ray_sum


def light_by_rays(lens, source: Source, count: int, pixel_um: float, points: int) -> np.ndarray:
    """Return the light in the chief ray's pixel and those beside it, over their sum: Gauss points in each pixel."""
    node, weight = np.polynomial.legendre.leggauss(points)
    x = (np.arange(count)[:, None] * pixel_um + node * pixel_um / 2).ravel()
    field = ray_sum(lens, source, lens.aim, x, node * pixel_um / 2, 300).field
    light = np.einsum("i,ijk,k->j", weight, (np.abs(field) ** 2).reshape(points, count, points), weight)
    return light / light.sum()


@pytest.mark.parametrize(("name", "share"), [("fast_gauss_f14", 0.164), ("petzval", 0.090)])
def test_a_wide_pixel_receives_the_light_between_its_samples(name, share):
    """4 µm pixels at f/1.4: of the points of 65² pixels the middle one has 0.66 and 0.53."""
    lens, source = with_aim(find_lens(name), "paraxial"), Source()
    psf = render_integrated(lens, source, "traced", 65, 4.0)
    assert psf.integrated and psf.values.sum() == pytest.approx(1, abs=1e-12)
    middle = psf.values[32, 32:37]
    np.testing.assert_allclose(middle / middle.sum(), light_by_rays(lens, source, 5, 4.0, 20), atol=2e-3)
    assert psf.values[32, 32] == pytest.approx(share, abs=1e-3)
    assert render(lens, source, "traced", 65, 4.0).values[32, 32] > 3 * share


@pytest.mark.parametrize("pixels", [16, 17])
def test_the_chief_rays_pixel_is_the_middle_one_of_any_size(pixels):
    """An Airy pattern on the axis: even about its pixel, row and column."""
    psf = render_integrated(find_lens("achromat_f6"), Source(), "traced", pixels, 6.0)
    middle = pixels // 2
    line = psf.values[middle, middle - 6 : middle + 7]
    np.testing.assert_allclose(line, line[::-1], atol=1e-6)
    np.testing.assert_allclose(line, psf.values[middle - 6 : middle + 7, middle], atol=1e-6)
    assert line.argmax() == 6


def test_pixels_that_resolve_it_all_are_left_alone():
    lens, source = find_lens("achromat_f6"), Source()
    fine = render_integrated(lens, source, "traced", 32, 1.0)
    assert not fine.integrated
    np.testing.assert_array_equal(fine.values, render(lens, source, "traced", 32, 1.0).values)


def test_the_light_of_wide_pixels_is_that_of_the_narrow_ones_inside():
    """3 × 3 of a third of the width, each integrated itself; and as much of all light."""
    lens, source = find_lens("cooke_triplet"), Source(field_deg=14)
    wide, narrow = (render_integrated(lens, source, "traced", n, um) for n, um in ((15, 9.0), (45, 3.0)))
    sums = narrow.values.reshape(15, 3, 15, 3).sum((1, 3))
    np.testing.assert_allclose(wide.values, sums, atol=3e-4 * sums.max())
    assert wide.energy == pytest.approx(narrow.energy, abs=1e-4)


def test_what_takes_too_many_samples_stays_at_points_and_says_so(monkeypatch):
    monkeypatch.setattr(pixel_light, "LARGEST", 100)
    psf = render_integrated(find_lens("fast_gauss_f14"), Source(), "traced", 33, 4.0)
    assert not psf.integrated
    assert psf.values.shape == (33, 33)
    with pytest.raises(SamplingError) as raised:
        render_integrated(find_lens("fast_gauss_f14"), Source(), "traced", 33, 4.0, wanted=True)
    assert raised.value.message.values["parameter"] == "integrated"


def test_a_window_too_wide_for_waves_holds_the_share_of_rays(monkeypatch):
    """Far from focus an evenly filled stop throws an even disc: the share is the window's part of its area."""
    monkeypatch.setattr(pixel_light, "LARGEST", 100)
    lens = find_lens("achromat_f6")
    lens, width_mm = with_aim(with_sensor(lens, lens.sensor_mm + 20), "paraxial"), 64 * 0.02
    psf = render_integrated(lens, Source(), "fitted", 64, 20.0)
    radius_mm = 20 * float(coefficients(lens, np.inf, 0.0, Source().wavelength_um).na)
    # 2 %: rays are a few tenths of a percent apart at the window's edges, and sines no tangents.
    assert psf.energy == pytest.approx(width_mm**2 / (np.pi * radius_mm**2), rel=0.02)


def airy_light(na: float, wavelength_um: float, half_um: float) -> float:
    """Return the share of an Airy pattern's light in a square (Born & Wolf 1999, 8.5.2), by Gauss points."""
    node, weight = np.polynomial.legendre.leggauss(200)
    radius = np.hypot(*np.meshgrid(half_um * node, half_um * node))
    v = 2 * np.pi * na / wavelength_um * radius
    intensity = (2 * j1(v) / v) ** 2 * np.pi * (na / wavelength_um) ** 2
    return float(half_um**2 * weight @ intensity @ weight)


@pytest.mark.parametrize("wanted", [None, True, False])
@pytest.mark.parametrize("pitch", [1.0, 3.0, 5.0])
def test_the_share_of_light_is_known_at_every_pitch(wanted, pitch):
    """On both sides of λ/(4 NA) = 1.25 µm and λ/(2 NA); odd windows stand evenly about the chief ray."""
    pixels = round(45 / pitch) | 1
    psf = p2sf.psf_of_opd(np.zeros((256, 256)), 0.1, 500, pixels=pixels, pixel_um=pitch, integrated=wanted)
    assert psf.integrated == (pitch > 1.25 if wanted is None else wanted)
    # 3e-3: samples at points hold a window's edge to half a sample, and the disc is drawn by square cells.
    assert psf.energy == pytest.approx(airy_light(0.1, 0.5, pixels * pitch / 2), abs=3e-3)
    if psf.integrated:
        middle = psf.values[pixels // 2, pixels // 2] * psf.energy
        assert middle == pytest.approx(airy_light(0.1, 0.5, pitch / 2), rel=5e-3)


def test_a_looked_up_fit_knows_its_share_of_the_light():
    lens, source = find_lens("cooke_triplet"), Source(field_slope=0.2, wavelength_um=0.55)
    space = Space(np.array([np.inf]), np.linspace(0.1, 0.3, 9), np.array([0.5, 0.55, 0.6]))
    for pitch in (0.8, 3.0):
        traced = render_integrated(lens, source, "fitted", 32, pitch)
        assert pixels_psf(build_fitted(lens, space), source, 32, pitch).energy == pytest.approx(traced.energy, rel=1e-3)


def test_a_psf_that_its_window_cuts_off_is_said_to_be():
    lens, source = find_lens("double_gauss_28"), p2sf.Source(field_deg=10)
    with pytest.warns(p2sf.P2SFWarning) as caught:
        cut = p2sf.render(lens, source, "fitted", f_number=2.8, pixel_um=2.0)
    whole = p2sf.render(lens, source, "fitted", f_number=2.8, pixels=192, pixel_um=2.0)
    inside = whole.values[64:128, 64:128].sum()  # both begin 32 pixels below the chief ray's
    assert cut.energy == pytest.approx(inside * whole.energy, rel=1e-3)
    assert cut.caution.values["share"] == pytest.approx(100 * cut.energy) and f"80.4 % of the {IN_WINDOW}" in repr(cut)
    assert len(caught) == 1 and caught[0].filename == __file__
    assert whole.caution is None and "integrated pixels" in repr(whole)
    database = p2sf.build_database(lens, [np.inf], [0, 10], [550], f_number=2.8)
    with pytest.warns(p2sf.P2SFWarning):
        database.psf(p2sf.Source(field_deg=10, wavelength_nm=550), pixel_um=1.0)


def test_a_databases_wide_pixels_hold_the_light_of_narrow_ones():
    lens = find_lens("achromat_f6")
    database = build_database(lens, Space(np.array([1000.0, np.inf]), np.array([0.0, 0.06]), np.array([0.55, 0.6])))
    points = database.space.axes
    pitch = critical_pixel_um(database)
    wide = rendered_light(database, points, Sampling(9, 5 * pitch), np.float64)
    fine = render_source(database, points, Sampling(135, pitch / 3), np.float64)
    sums = fine.reshape(*fine.shape[:-2], 9, 15, 9, 15).sum((-3, -1))
    np.testing.assert_allclose(wide, sums / sums.sum((-2, -1), keepdims=True), atol=5e-4 * sums.max())


@pytest.mark.parametrize("method", ["huygens", "spherical", "auto"])
def test_where_no_ray_arrives_every_sum_says_so(method):
    lens = find_lens("schmidt_camera")
    with pytest.raises(GeometryError, match="no ray but the chief ray"):
        p2sf.render(lens, Source(5.0), method, pixels=2, pixel_um=3.0)


def test_far_samples_of_a_cut_off_blur_warn_by_its_rays_and_sum_no_second_picture(monkeypatch):
    """A disc of light, 40 µm of radius, on 8 pixels of 5 µm: the square holds (40/40)²/π of it, by areas."""
    lens, pixel_um = find_lens("achromat_f6"), 5.0
    lens = with_sensor(lens, lens.sensor_mm + 12 * 0.04)  # at f/6 the rays spread by a twelfth of the way
    with monkeypatch.context() as patch:
        patch.setattr(FineGrid, "light", lambda *given: pytest.fail("a second picture is summed"))
        with pytest.warns(p2sf.P2SFWarning, match="holds 3"):
            psf = p2sf.render(lens, Source(), "traced", pixels=8, pixel_um=pixel_um, integrated=False)
        assert psf.figures.energy.roughly() == pytest.approx(1 / np.pi, abs=0.02)
        assert "% of the light" in repr(psf)
    assert psf.energy == pytest.approx(1 / np.pi, abs=0.03)  # diffraction at the edges of a disc of 40 µm


@pytest.mark.parametrize("method", ["seidel", "fitted", "traced", "huygens", "auto"])
@pytest.mark.filterwarnings("ignore::p2sf.P2SFWarning")
def test_the_light_of_two_far_samples_is_that_of_narrow_ones_between(method):
    """5 µm at f/8: 72 % of the light falls on 2 × 2 pixels, of which the rays, all inside, know nothing."""
    how = {"f_number": 8, "focus_mm": 3000, "integrated": False}
    lens, source = find_lens("tessar"), Source(3000.0)
    psf = p2sf.render(lens, source, method, pixels=2, pixel_um=5.0, **how)
    fine = p2sf.render(lens, source, "huygens", pixels=80, pixel_um=0.25, **how)
    within = np.zeros(80)  # pixels about −5 and 0 µm reach from −7.5 to 2.5
    within[11:50], within[[10, 50]] = 1.0, 0.5
    light = float(within @ fine.values @ within * fine.energy)
    assert light < 0.75
    assert isinstance(psf.figures.energy, Later) and psf.figures.energy.roughly() < LEAST_LIGHT
    assert psf.energy == pytest.approx(light, abs=6e-3)  # six coefficients err by 2e-3


def test_a_wavefront_on_far_samples_is_said_to_be_cut_off():
    """A square of 1.1 λ/NA holds some two thirds of an Airy pattern's light."""
    with pytest.warns(p2sf.P2SFWarning, match="of the light"):
        psf = p2sf.psf_of_opd(np.zeros((128, 128)), na=0.1, wavelength_nm=500, pixels=1, pixel_um=5.5, integrated=False)
    assert psf.energy == pytest.approx(airy_light(0.1, 0.5, 5.5 / 2), abs=3e-3)  # the disc is drawn by square cells
