"""Frames: simulated through lenses, read from files, their points found, and one model fitted to all of them."""

from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from p2sf.database.files.npz import load_database
from p2sf.errors import Cancelled, P2SFError, RequestError
from p2sf.files.writing import write_beside
from p2sf.io.photo_files import write_photo
from p2sf.io.psf_files import write_psf
from p2sf.lens.lens import with_f_number
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import read_toml
from p2sf.measure.as_built import left_out, lens_as_built, write_as_built
from p2sf.measure.fitting import frame_fit
from p2sf.measure.fitting.frame_fit import FrameFit, PointSum, fit_frame
from p2sf.measure.fitting.frame_terms import FOCUS, FrameModel, FramePoint, lens_optics
from p2sf.measure.fitting.point_model import PictureOptics, PixelSum
from p2sf.measure.fitting.point_problem import PointPicture
from p2sf.measure.fitting.pupil_nodes import lens_nodes
from p2sf.measure.fitting.starting_values import locate
from p2sf.measure.frame import Frame, FrameGeometry, Noise, calibrate
from p2sf.measure.listings import listing_of, read_listing
from p2sf.measure.measurement import FrameRequest, measure_frame, read_measurement, write_measurement
from p2sf.measure.points import FoundPoint, _steps, find_points, in_grid, window_half, window_of
from p2sf.measure.reading import read_frame
from p2sf.measure.simulation import Exposure, grid_of_points, lens_light, simulated_frame
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels.frequency_grid import pupil_map
from p2sf.pixel_kernels.pixels import PixelWindow, half_width, pixel_kernel, samples_across
from p2sf.psf.fitted import fitted_intensity
from p2sf.psf.pixel_integrals import render_integrated
from p2sf.pupil.fit import fit
from tests.support.reference import DATA
from tests.support.tiers import in_tiers

PITCH = 3.45
LISTED = DATA / "opticstudio"


@pytest.fixture(scope="module")
def triplet():
    return with_f_number(find_lens("cooke_triplet"), 4.0)


@pytest.fixture(scope="module")
def frame(triplet):
    """Return 5 × 3 points with a sensor too far by 25 µm and tilted by 0.1° and −0.05°."""
    exposure = Exposure(sensor_shift_um=25.0, tilt_deg=(0.1, -0.05))
    return simulated_frame(triplet, grid_of_points(5, 3, 4.0, 2.0), FrameGeometry(680, 1260, PITCH), exposure)


@pytest.mark.parametrize("azimuth", in_tiers([0.0, 0.7, 2.5, -1.9], [0.7]))
def test_nodes_of_a_lens_give_its_pixel_kernels_at_every_azimuth(triplet, azimuth):
    """Kernels of plans settle for fewer samples: with four times the window and fine ones they converge to the sum.

    0.3 % of the peak with a kernel's own window and samples, which plans count as error; 3e-4 here.
    """
    source, shift = Source(field_deg=14.0), (0.7, -0.4)
    found = fit(triplet, source)
    nodes = lens_nodes(found, azimuth, (40, 160))
    waves = -found.function.at(nodes.xi, nodes.eta)[0]
    optics = lens_optics(triplet, np.inf, source.wavelength_um, PITCH)
    light = PixelSum(nodes, (25, 25), optics).light(waves - nodes.fx * shift[0] - nodes.fy * shift[1])
    pupil = pupil_map(triplet, source, "fitted", None)
    window = PixelWindow(4 * half_width(pupil, PITCH), PITCH, samples_across(pupil, PITCH, 4.0))
    cut = slice(window.half - 12, window.half + 13)
    kernel = pixel_kernel(pupil, azimuth, window, shift)[::-1][cut, cut].astype(float)
    assert light / light.sum() == pytest.approx(kernel / kernel.sum(), abs=1e-3 * kernel.max() / kernel.sum())


def test_simulated_light_is_that_of_the_fitted_method_added_up(triplet):
    """Other nodes, and 15² points a pixel, whose midpoints overstate the finest contrast by (π/15)²/6·1.6² = 2 %."""
    found = fit(triplet, Source(field_deg=5.0), residual_waves=1e-4)
    light = lens_light(found, (0.0, 4.0), 10, PITCH, (0.0, 4.0))
    fine = fitted_intensity(found, (48, 96), 21 * 15, PITCH / 15).reshape(21, 15, 21, 15).mean((1, 3))
    assert light / light.sum() == pytest.approx(fine / fine.sum(), abs=2e-3 * fine.max() / fine.sum())


def test_jitter_widens_points_by_its_own_square(triplet):
    """Variances add: 3 µm RMS in x, to what the pixel grid and the window leave out."""
    geometry, place = FrameGeometry(101, 101, PITCH), np.array([[0.0, 0.0]])
    x = (np.arange(101) - 50) * PITCH

    def variance(jitter):
        exposure = Exposure(read_noise=0.0, background=0.0, jitter_um=jitter)
        light = simulated_frame(triplet, place, geometry, exposure).values[40:61, 40:61]
        return light.sum(0) @ x[40:61] ** 2 / light.sum()

    assert variance(3.0) - variance(0.0) == pytest.approx(9.0, rel=0.1)


def test_points_are_found_where_they_were_put_and_in_their_order(frame):
    points = in_grid(find_points(frame))
    assert len(points) == 15 and all(point.good for point in points)
    places = {point.place: (point.x_mm, point.y_mm) for point in points}
    assert set(places) == {(i, j) for i in range(-2, 3) for j in range(-1, 2)}
    for (i, j), place in places.items():
        assert place == pytest.approx((i, j), abs=0.006)  # coma moves centroids by a pixel or so


def test_a_grid_may_be_turned_and_distorted():
    geometry = FrameGeometry(400, 400, 10.0)
    values = np.zeros((400, 400))
    places = {}
    for i in range(-3, 4):
        for j in range(-3, 4):
            x, y = i * 45.0, j * 45.0
            grow = 1 + 2e-6 * (x * x + y * y)
            turned = (x * np.cos(0.25) - y * np.sin(0.25)) * grow, (x * np.sin(0.25) + y * np.cos(0.25)) * grow
            row, column = round(199.5 - turned[1]), round(199.5 + turned[0])
            values[row - 1 : row + 2, column - 1 : column + 2] = 1000
            places[row, column] = (i, j)
    points = in_grid(find_points(Frame(values + np.random.default_rng(0).normal(0, 5, values.shape), geometry)))
    assert {(round(p.row), round(p.column)): p.place for p in points} == places


def test_what_cannot_be_used_is_flagged():
    rng, values = np.random.default_rng(1), np.zeros((120, 160))
    blob = np.exp(-0.5 * (np.hypot(*np.mgrid[-6:7, -6:7]) / 1.6) ** 2)

    def put(row, column, peak):
        values[row - 6 : row + 7, column - 6 : column + 7] += peak * blob

    for column in (30, 60, 90):
        put(30, column, 1000)
    put(80, 30, 6000)  # saturates
    put(80, 80, 1000)
    put(80, 93, 1000)  # touches its neighbour
    put(113, 150, 1000)
    values[60, 140] = 3000  # a hot pixel is no point
    counts = np.minimum(values + 50 + rng.normal(0, 5, values.shape), 4000)[:116]
    points = find_points(Frame(counts, FrameGeometry(116, 160, 5.0), Noise(full_scale=4000)))
    flagged = {(round(p.row, -1), round(p.column, -1)): [str(f) for f in p.flags] for p in points}
    assert flagged[30, 30] == flagged[30, 60] == flagged[30, 90] == []
    assert "saturated" in flagged[80, 30]
    assert "two points" in flagged[80, 90][0] and "edge" in flagged[110, 150][0]
    assert not any(abs(p.row - 60) < 3 and abs(p.column - 140) < 3 for p in points)


def test_light_of_a_neighbour_in_the_window_does_not_count(triplet):
    """Points 17 pixels apart that do not touch, in windows as wide as others of the frame may need."""
    places = np.array([(-0.5 * 17 * PITCH / 1000, 0.0), (0.5 * 17 * PITCH / 1000, 0.0)])
    frame = simulated_frame(triplet, places, FrameGeometry(100, 120, PITCH), Exposure(sensor_shift_um=25.0))
    points = find_points(frame)
    assert len(points) == 2 and all(point.good for point in points)
    alone, beside = (window_of(frame, points[0], 18, others=others) for others in ((), points))
    assert beside.values[~beside.good].max() > 0.9 * points[1].peak
    assert beside.values[beside.good & ~np.pad(np.ones((13, 13), bool), 12)].max() < 50 + 6 * 10
    assert beside.good[12:25, 12:25].all() and alone.good.all()


@pytest.mark.parametrize(("down", "right"), [(-9, -10), (-9, 3), (4, -10), (9, 10), (0, 11), (-13, 0)])
def test_light_of_a_point_across_an_edge_of_the_window_does_not_count(down, right):
    """Every pixel as near to the other point as its light reaches, and none else, rows of the window towards +y."""
    frame = Frame(np.arange(3600.0).reshape(60, 60), FrameGeometry(60, 60, PITCH))
    own, other = (FoundPoint(30.0 + y, 30.0 + x, 0.0, 0.0, 1.0, 1.0, 2) for y, x in ((0, 0), (down, right)))
    steps = np.arange(-8, 9)
    near = (np.abs(steps - down)[:, None] <= 3) & (np.abs(steps - right) <= 3)
    assert np.array_equal(window_of(frame, own, 8, others=[own, other]).good, ~near[::-1])


def test_light_beside_the_middle_of_a_window_has_its_own_place_and_moments():
    """A Gaussian on samples: its mean and covariance, to the light that is lost in the noise and at the edge."""
    y, x = np.mgrid[-20:21, -20:21] * 2.0
    covariance = np.array([[60.0, 25.0], [25.0, 40.0]])
    place = np.stack([x - 6.0, y + 9.0])
    light = 1e4 * np.exp(-np.einsum("iab,ij,jab->ab", place, np.linalg.inv(covariance), place) / 2)
    found = locate(PointPicture(light, 1e-4), PictureOptics(0.125, 0.55, 2.0))
    assert (found.x, found.y) == pytest.approx((6.0, -9.0), abs=0.01)
    assert found.moments_um2 == pytest.approx((60.0, 25.0, 40.0), rel=0.01)


def test_the_variance_of_counts_is_that_of_their_electrons():
    """Poisson's variance is the mean: light/gain in counts², above the background where that is in the estimate."""
    values, light = np.random.default_rng(1).normal(100.0, 4.0, (60, 60)), np.array([0.0, 100.0, 500.0])
    geometry = FrameGeometry(60, 60, PITCH)
    stated, estimated = (Frame(values, geometry, noise) for noise in (Noise(2.0, 3.0), Noise(2.0)))
    assert stated.variance(light) == pytest.approx(9.0 + light / 2)
    assert estimated.variance(light) == pytest.approx(16.0 + np.array([0.0, 0.0, 200.0]), rel=0.1, abs=0.5)


def test_the_steps_of_a_turned_grid_are_its_two_sides():
    turn = np.deg2rad(10.0)
    sides = np.array([[np.cos(turn), np.sin(turn)], [-1.3 * np.sin(turn), 1.3 * np.cos(turn)]])
    xy = np.stack(np.meshgrid(np.arange(5.0), np.arange(4.0)), axis=-1).reshape(-1, 2) @ sides
    assert _steps(xy) == pytest.approx(sides)


@pytest.mark.slow
def test_points_that_overlap_are_flagged_and_not_used(triplet):
    """Two defocused points 11 pixels apart are one group of pixels, wider than the others."""
    places = np.append(grid_of_points(3, 2, 1.5, 0.9), [(0.375 - 11 * PITCH / 1000, 0.0), (0.375, 0.0)], axis=0)
    frame = simulated_frame(triplet, places, FrameGeometry(380, 560, PITCH), Exposure(sensor_shift_um=60.0))
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    found = measure_frame([frame], optics, FrameRequest(lens=triplet, unknowns=("sensor_shift_um",), singly=False))
    overlapping = [point for point in found.points if abs(point.y_mm) < 0.1]
    assert overlapping and all(point.flags for point in overlapping)
    assert len(found.whole.points) == 6 and min(abs(point.y_mm) for point in found.whole.points) > 0.4


def test_a_frame_gives_back_how_the_sensor_stands(triplet, frame):
    """Five standard deviations, of some 0.2 µm and 0.01°."""
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    found = measure_frame([frame], optics, FrameRequest(lens=triplet, unknowns=FOCUS, singly=False)).whole
    assert found.model.unknowns == (*FOCUS, "f_number")
    assert np.abs((found.values - [25.0, 0.1, -0.05, 0.0]) / found.errors).max() < 5
    assert (found.errors < [0.5, 0.01, 0.02, 0.3]).all()
    assert found.chi2 == pytest.approx(1.0, abs=0.15) and found.r2.min() > 0.95


@pytest.mark.slow
def test_a_sensor_far_from_where_the_design_has_it_is_found(triplet):
    """0.9 waves of defocus: from the lens as designed, the nearest minimum is another one, of 4 times the noise."""
    exposure = Exposure(sensor_shift_um=-60.0)
    taken = simulated_frame(triplet, grid_of_points(3, 2, 1.2, 0.6), FrameGeometry(300, 480, PITCH), exposure)
    whole = measure_frame(
        [taken], lens_optics(triplet, np.inf, 0.55, PITCH), FrameRequest(lens=triplet, singly=False)
    ).whole
    assert abs(whole.values[0] + 60) < 4 * whole.errors[0] < 4 and whole.chi2 < 1.2


def model_points(model, truth, noise, places, focus=(0.0,), pixels=25, seed=0):
    rng, points = np.random.default_rng(seed), []
    for x, y in places:
        for shift in focus:
            empty = FramePoint(PointPicture(np.zeros((pixels, pixels))), x, y, shift)
            light = PointSum(empty, model).light(truth, 0.3, 0.2)
            counts = light * (1000 / light.max()) + 50 + rng.normal(0, noise, light.shape)
            points.append(FramePoint(PointPicture(counts, noise**2), x, y, shift))
    return points


def test_a_frame_without_a_lens_starts_from_its_points_and_names_the_twin():
    """Five standard deviations; the sign of all even terms together is open."""
    model = FrameModel(PictureOptics(0.125, 0.55, 2.2), 5.0)
    truth = np.array([20.0, 0.1, -0.06, 0.5, 0.9, -0.8, 0.6])
    points = model_points(model, truth, 10.0, grid_of_points(3, 3, 8.0, 6.0))
    found = fit_frame(points, model)
    near = min((found.values, found.twin), key=lambda values: np.abs(values - truth).sum())
    assert np.abs((near - truth) / found.bounds).max() < 5


def test_unknowns_that_no_picture_tells_apart_have_huge_errors_and_a_warning():
    """On one circle about the axis a shift of the sensor is W20 h²: one combination of the two is known, none alone."""
    optics = PictureOptics(0.125, 0.55, 2.2)
    places = [(4.0, 0.0), (0.0, 4.0), (-4.0, 0.0)]
    model = FrameModel(optics, 4.0, ("sensor_shift_um", "w20", "w31"))
    points = model_points(model, np.array([20.0, 0.3, 0.5]), 10.0, places)
    found = fit_frame(points, model, start=np.array([15.0, 0.2, 0.4]))
    assert (found.bounds[:2] * [model.focus_waves_per_um, 1.0] > 100 * found.bounds[2]).all()
    assert found.values @ [model.focus_waves_per_um, 1.0, 0.0] == pytest.approx(
        20 * model.focus_waves_per_um + 0.3, abs=0.05
    )
    assert [warning.values["names"] for warning in found.warnings] == [("sensor_shift_um", "w20")]
    known = fit_frame(points, replace(model, unknowns=("sensor_shift_um", "w31")), start=np.array([15.0, 0.4]))
    assert not known.warnings and known.bounds[0] < 1.0


def test_a_spacing_is_told_from_a_shift_by_its_field(triplet):
    """A point model of the lens with its third space longer by 40 µm, fitted by one without."""
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    model = FrameModel(optics, 8.0, ("sensor_shift_um", "thickness:2"), triplet)
    truth = np.array([5.0, 0.040])
    points = model_points(model, truth, 5.0, [(0.0, 0.0), (0.0, 7.5), (-5.0, 3.0)], pixels=21)
    found = fit_frame(points, model)
    assert np.abs((found.values - truth) / found.bounds).max() < 5


def test_the_lens_as_built_has_what_differs(triplet, tmp_path):
    """A sensor that recedes towards +x and +y: where its points lie, from its axes; and a database without the tilt."""
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    model = FrameModel(optics, 8.0, ("sensor_shift_um", "tilt_x_deg", "tilt_y_deg", "w40", "thickness:2"), triplet)
    values = np.array([25.0, 0.2, -0.1, 0.3, 0.040])
    none = np.empty((0, 4))
    whole = FrameFit(model, (), values, np.diag(0.01 * values**2), none, none, (), none[0:0], none[0:0], 1.0)
    built = lens_as_built(whole)
    assert built.surfaces[1].thickness == pytest.approx(triplet.surfaces[1].thickness + 0.040, abs=1e-12)
    *_, sensor = built.frames
    middle = sum(surface.thickness for surface in triplet.surfaces) + 0.040 + 0.025
    for x, y in ((5.0, 0.0), (0.0, 5.0)):
        z = (sensor.origin + sensor.rotation @ [x, y, 0.0])[2]
        assert z - middle == pytest.approx(x * np.sin(np.deg2rad(0.2)) - y * np.sin(np.deg2rad(0.1)), abs=1e-6)
    write_as_built(whole, tmp_path / "built.toml")
    assert read_toml(tmp_path / "built.toml").surfaces == built.surfaces
    write_as_built(whole, tmp_path / "built.npz")
    found = load_database(tmp_path / "built.npz").database
    straight = lens_as_built(whole, tilted=False)
    direct = coefficients(straight, np.inf, np.tan(np.deg2rad(10)), 0.55)
    read = found.coefficients(np.inf, np.tan(np.deg2rad(10)), 0.55)
    assert [float(getattr(read, name)) for name in ("w40", "wd")] == pytest.approx(
        [float(direct.w40), float(direct.wd)], abs=1e-6
    )
    assert len(left_out(whole, "a.npz")) == 2 and len(left_out(whole, "a.toml")) == 1
    with pytest.raises(RequestError, match="relative to the lens"):
        lens_as_built(replace(whole, model=FrameModel(optics, 8.0)))


def test_a_frame_at_two_focus_positions_has_no_twin():
    model = FrameModel(PictureOptics(0.125, 0.55, 2.2), 5.0, ("sensor_shift_um", "w40", "w31"))
    truth = np.array([20.0, 0.5, 0.9])
    points = model_points(model, truth, 10.0, [(0.0, 0.0), (4.0, 0.0)], focus=(0.0, 60.0))
    found = fit_frame(points, model, start=truth * 0.8)
    assert found.twin is None and np.abs((found.values - truth) / found.bounds).max() < 5


@pytest.mark.slow
def test_a_measurement_is_cancelled_reported_and_written(triplet, frame, tmp_path):
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    with pytest.raises(Cancelled):
        measure_frame([frame], optics, cancelled=lambda: True)
    shares = []
    cut = Frame(frame.values[:, 420:840], FrameGeometry(680, 420, PITCH))
    found = measure_frame([cut], optics, progress=shares.append)
    assert found.used == 3 and found.whole is None and shares == sorted(shares)
    arrays, meta = read_measurement(write_measurement(found, tmp_path / "coefficients.npz"))
    assert meta["names"] == ["W40", "W31", "W22", "W20 + Wd"] and arrays["numbers"].shape == (3, 4)
    assert arrays["numbers"] == pytest.approx(np.array([one.numbers for one in found.fits if one]))
    (tmp_path / "other.npz").write_bytes(b"PK nothing")
    with pytest.raises(RequestError, match="not a measurement"):
        read_measurement(tmp_path / "other.npz")


def test_dark_and_flat_fields_leave_the_light():
    rng = np.random.default_rng(0)
    light, dark, gain = rng.uniform(100, 200, (8, 9)), rng.uniform(5, 9, (8, 9)), rng.uniform(0.8, 1.2, (8, 9))
    gain /= gain.mean()
    assert calibrate(light * gain + dark, dark, 5000 * gain + dark) == pytest.approx(light)
    with pytest.raises(RequestError, match="flat field has shape"):
        calibrate(light, dark[1:])
    with pytest.raises(RequestError, match="not brighter"):
        calibrate(light, dark, dark - 1)


def test_noise_is_estimated_beside_points(frame):
    """Few pixels hold points: the estimate is the 10 counts of the exposure, to the 1 % of its own noise."""
    assert frame.read_noise == pytest.approx(10.0, rel=0.03) and frame.background == pytest.approx(50.0, abs=0.5)


@pytest.mark.parametrize("kind", ["png8", "png16", "tiff", "npy", "npz", "fits"])
def test_counts_come_from_files_as_they_are(kind, tmp_path):
    """8 bits of a PNG only where they are said to be counts."""
    counts = np.random.default_rng(2).integers(0, 250, (20, 30))
    path = tmp_path / f"frame.{kind.rstrip('0123456789')}"
    if kind == "png8":
        Image.fromarray(counts.astype(np.uint8)).save(path)
    elif kind == "png16":
        Image.fromarray((counts * 200).astype(np.uint16)).save(path)
    elif kind == "tiff":
        write_photo(path, counts / 1000, "linear", "float")
    elif kind == "npy":
        np.save(path, counts)
    elif kind == "npz":
        np.savez(path, values=counts, pixel_um=4.0)
    else:
        fits = pytest.importorskip("astropy.io.fits")
        fits.PrimaryHDU(counts[::-1].astype(np.int16)).writeto(path)
    scale = {"png16": 200.0, "tiff": 1e-3}.get(kind, 1.0)
    found = read_frame(path, None if kind == "npz" else 4.0, encoding="linear" if kind == "png8" else None)
    assert (
        not found.notes and found.values == pytest.approx(counts * scale, rel=1e-6) and found.geometry.pixel_um == 4.0
    )


@pytest.mark.parametrize("ending", ["png", "jpg"])
def test_eight_bits_are_made_linear_and_that_is_said(ending, tmp_path):
    """By the curve of IEC 61966-2-1, of 255 counts; JPEG rounds even a plain area by up to a count."""
    Image.fromarray(np.full((16, 16), 188, np.uint8)).save(tmp_path / f"frame.{ending}")
    found = read_frame(tmp_path / f"frame.{ending}", 4.0)
    linear = 255 * ((188 / 255 + 0.055) / 1.055) ** 2.4
    assert found.values == pytest.approx(np.full((16, 16), linear), rel=0.015) and found.values.max() < 140
    assert [note.values["parameter"] for note in found.notes] == ["encoding"]


@pytest.mark.parametrize("ending", in_tiers(["npz", "tiff"], ["npz"]))
def test_pixels_of_a_psf_are_read_as_pixels(ending, tmp_path, triplet):
    """The PSF is one of the six coefficients, on pixels of 1.6 λ·N: taken for points, W40 misses by 0.3 waves."""
    made = render_integrated(triplet, Source(wavelength_nm=550.0), "seidel", 41, PITCH)
    frame = read_frame(write_psf(made, tmp_path / f"psf.{ending}", {}))
    assert frame.psf and frame.integrated and frame.geometry.pixel_um == pytest.approx(PITCH)
    assert frame.variance(made.values) == pytest.approx((1e-3 * made.values.max()) ** 2)  # which is assumed
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    own = coefficients(triplet, np.inf, 0.0, triplet.reference_wavelength_um)

    (fit,) = measure_frame([frame], optics).fits
    assert min(abs(numbers[0] - own.w40) for numbers in (fit.numbers, *fit.others)) < 0.03
    if ending != "npz":  # once is enough for what would go wrong
        (fit,) = measure_frame([replace(frame, integrated=False)], optics).fits
        assert min(abs(numbers[0] - own.w40) for numbers in (fit.numbers, *fit.others)) > 0.1


def test_a_psf_lies_where_its_field_lands(triplet):
    """50 mm times the tangent of 10°, and 0.4 % of distortion."""
    made = render_integrated(triplet, Source(field_deg=10.0, wavelength_nm=550.0), "fitted", 41, PITCH)
    frame = Frame(made.values[::-1], FrameGeometry(41, 41, PITCH), Noise(read_noise=1e-5), psf=True, field_deg=10.0)
    (point,) = measure_frame(
        [frame], lens_optics(triplet, np.inf, 0.55, PITCH), FrameRequest(lens=triplet, singly=False)
    ).points
    assert point.x_mm == 0.0 and point.y_mm == pytest.approx(50 * np.tan(np.deg2rad(10.0)), rel=0.01)


def test_hot_pixels_are_no_points(triplet, frame):
    """Five pairs of hot pixels, as bright as the 15 points; a point without aberrations has more light beside them."""
    optics, values, rng = lens_optics(triplet, np.inf, 0.55, PITCH), frame.values.copy(), np.random.default_rng(0)
    for _ in range(5):
        row, column = rng.integers(20, 60), rng.integers(20, 1200)  # above all points
        values[row, column : column + 2] += 1000.0
    hot = Frame(values, frame.geometry)
    assert len(find_points(hot)) > 15 and len(find_points(hot, optics)) == len(find_points(frame, optics)) == 15


@pytest.mark.slow
def test_a_point_that_one_focus_has_lost_is_left_out(triplet):
    places, geometry = grid_of_points(3, 2, 1.2, 0.6), FrameGeometry(300, 480, PITCH)
    first, second = (
        simulated_frame(triplet, places, geometry, Exposure(sensor_shift_um=shift, seed=int(shift)))
        for shift in (0.0, 20.0)
    )
    row, column = geometry.pixel_at(*places[0])
    second.values[row - 30 : row + 31, column - 30 : column + 31] = 50.0
    optics = lens_optics(triplet, np.inf, 0.55, PITCH)
    found = measure_frame(
        [first, second], optics, FrameRequest(focus_um=(0.0, 20.0), lens=triplet, unknowns=FOCUS[:1], singly=False)
    )
    assert sum(why is not None for why in found.failures) == 1 and len(found.whole.points) == 10
    assert abs(found.whole.values[0]) < 5 * found.whole.errors[0] < 5


def test_points_are_found_above_the_noise_there_is(frame):
    """A stated read noise, here a tenth of the background's, weighs pixels; it finds no points in noise."""
    low = replace(frame, noise=Noise(read_noise=1.0))
    assert len(find_points(low)) == len(find_points(frame)) == 15 and low.read_noise == 1.0


@pytest.mark.slow
def test_noise_that_is_less_than_stated_is_said(triplet, frame):
    optics = lens_optics(triplet, np.inf, 0.55, PITCH)
    stated = replace(frame, noise=Noise(read_noise=20.0))
    (why,) = measure_frame([stated], optics, FrameRequest(lens=triplet, unknowns=FOCUS[:1], singly=False)).warnings
    assert why.values["chi2"] == pytest.approx(0.25 * 1.2, rel=0.2)  # (10/20)², and what the tilt leaves


def test_listings_of_opticstudio_are_read_in_either_encoding(tmp_path):
    psf, waves = (read_listing(LISTED / name) for name in ("huygens_psf_0_1.75.txt", "wavefront_0_1.75.txt"))
    assert (psf.kind, psf.values.shape, psf.pitch_um, psf.wavelength_um) == ("psf", (64, 64), 0.289, 0.5)
    assert psf.field == (0.0, 1.75) and psf.values.max() == pytest.approx(psf.strehl, abs=5e-4)
    assert waves.statistics == pytest.approx((waves.peak_to_valley, waves.rms_with_tilt), rel=2e-4)
    text = (LISTED / "wavefront_0_1.75.txt").read_text("utf-16")
    (tmp_path / "again.txt").write_text(
        text.replace("Wavefront Function", "Wavefront Function\nOne more line"), "utf-8"
    )
    again = read_listing(tmp_path / "again.txt")
    assert np.array_equal(again.values, waves.values) and again.rms_with_tilt == waves.rms_with_tilt
    assert read_frame(LISTED / "huygens_psf_0_1.75.txt").geometry.pixel_um == 0.289


def test_a_listed_psf_is_one_point_where_its_chief_ray_lands():
    """Its light reaches the window's edge, at which points of a photograph would be cut."""
    frame = read_frame(LISTED / "huygens_psf_0_1.75.txt")
    (point,) = find_points(frame)
    assert point.good and (point.x_mm, point.y_mm) == pytest.approx((0.0, 315.173136), abs=1e-9)
    window = window_of(frame, point, point.half)
    assert window.values.shape == (63, 63)
    assert window.values[31, 31] == read_listing(LISTED / "huygens_psf_0_1.75.txt").values[32, 32]


def test_the_centroid_of_a_listed_psf_lies_where_its_head_says():
    """Light beyond the window counts in neither: 0.05 µm. A table upside down would miss by 3 µm."""
    psf = read_listing(LISTED / "huygens_psf_0_1.75.txt")
    y = (np.arange(64) - psf.centre[0]) * psf.pitch_um
    assert psf.values.sum(1) @ y / psf.values.sum() == pytest.approx(1.67881506, abs=0.05)


def test_damaged_files_get_a_sentence(tmp_path):
    """Each file is cut, or bytes in it changed; what is still a picture may be read."""
    rng = np.random.default_rng(0)
    counts = rng.integers(0, 200, (16, 16)).astype(np.uint8)
    for name in ("a.png", "a.tif"):
        Image.fromarray(counts).save(tmp_path / name)
    np.save(tmp_path / "a.npy", counts)
    np.savez(tmp_path / "a.npz", values=counts)
    (tmp_path / "a.txt").write_bytes((LISTED / "wavefront_0_1.75.txt").read_bytes()[:3000])
    whole = {path: path.read_bytes() for path in sorted(tmp_path.iterdir())}
    for trial in range(100):
        path, data = list(whole.items())[trial % len(whole)]
        damaged = bytearray(data[: rng.integers(1, len(data))] if trial % 2 else data)
        for place in rng.integers(0, len(damaged), 4):
            damaged[place] = rng.integers(256)
        write_beside(path, lambda handle, content=bytes(damaged): handle.write(content))
        try:
            find_points(read_frame(path, 4.0))
        except P2SFError as error:
            assert str(error)


def test_a_listing_that_contradicts_itself_is_refused():
    text = (LISTED / "wavefront_0_1.75.txt").read_text("utf-16")
    with pytest.raises(RequestError, match="its head says 33 × 32"):
        listing_of(text.replace("32 by 32", "32 by 33"), "x.txt")
    with pytest.raises(RequestError, match="not a listing"):
        listing_of(text.replace("0.5000", "many"), "x.txt")
    with pytest.raises(RequestError, match="not a listing"):
        listing_of("a shopping list\n1 2 3\n", "x.txt")


def test_frames_that_hold_nothing_are_refused(tmp_path):
    geometry = FrameGeometry(40, 50, 4.0)
    with pytest.raises(RequestError, match="no point rises above"):
        find_points(Frame(np.random.default_rng(0).normal(50, 5, (40, 50)), geometry))
    with pytest.raises(RequestError, match="shape"):
        Frame(np.zeros((3, 4)), geometry)
    with pytest.raises(RequestError, match="finite"):
        Frame(np.full((40, 50), np.nan), geometry)
    with pytest.raises(RequestError, match="the size of its pixels"):
        np.save(tmp_path / "a.npy", np.zeros((4, 4)))
        read_frame(tmp_path / "a.npy")
    with pytest.raises(RequestError, match="the ending"):
        read_frame(tmp_path / "a.doc", 4.0)
    values = np.full((40, 50), 50.0) + np.random.default_rng(0).normal(0, 1, (40, 50))
    values[18:23, 20:25] = 4000
    with pytest.raises(RequestError, match="saturated"):
        window_half(find_points(Frame(values, geometry, Noise(full_scale=4000))))
    with pytest.raises(RequestError, match="choose from"):
        FrameModel(PictureOptics(0.1, 0.5, 2.0), 5.0, ("tilt",))


def test_a_frame_keeps_its_counts_though_its_file_is_written_anew(tmp_path):
    path, counts = tmp_path / "a.npy", np.arange(640_000.0).reshape(800, 800)
    np.save(path, counts)
    frame = read_frame(path, 1.0)
    assert not isinstance(frame.values.base, np.memmap) and frame.values.flags.writeable  # before a bus error says so
    np.save(path, counts[:5, :5])
    assert (frame.values == counts).all()


def test_what_a_point_beside_the_axis_suggests_is_of_its_own_azimuth():
    """Of a point along x, 0.8 of the half diagonal away: W40, W31 h and W22 h² within 5 % of what the frame has."""
    model = FrameModel(PictureOptics(0.125, 0.55, 2.2), 5.0)
    truth = np.array([20.0, 0.1, -0.06, 0.5, 0.9, -0.8, 0.6])
    points = model_points(model, truth, 10.0, [(4.0, 0.0)], focus=(0.0, 60.0), pixels=11)
    suggested = dict(zip(model.unknowns, frame_fit._start_from_points(points, model), strict=True))
    assert [suggested[name] for name in ("w40", "w31", "w22")] == pytest.approx([0.5, 0.9, -0.8], rel=0.05)
