"""Errors of a known lens as unknowns of a frame: decentres, tilts, spacings, told by pictures through that lens."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.cli.measuring import record
from p2sf.errors import RequestError
from p2sf.lens.lens import Aperture, with_f_number, with_sensor
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.measure.as_built import lens_as_built
from p2sf.measure.fitting.frame_fit import FrameFit, fit_frame
from p2sf.measure.fitting.frame_terms import FrameModel, lens_optics
from p2sf.measure.fitting.perturbation import perturb, perturbation
from p2sf.measure.fitting.pupil_nodes import paraxial_nodes
from p2sf.measure.fitting.starting_values import landings, ray_moments
from p2sf.measure.frame import FrameGeometry
from p2sf.measure.measurement import FrameRequest, measure_frame, read_measurement, write_measurement
from p2sf.measure.simulation import Exposure, grid_of_points, simulated_frame
from p2sf.paraxial.pupils import stop_rim
from p2sf.tolerance.errors_of_build import Tolerance, build
from p2sf_explorer.compute.views.measured import has_lens_as_built, point_rows, whole_rows
from tests.measure.test_frames import model_points
from tests.support.depths import RELAYS_MM
from tests.support.huygens_frames import cross_of_points, huygens_frame
from tests.support.rays import perturbed_rays as reference

PITCH = 3.45


@pytest.fixture(scope="module")
def triplet():
    return with_f_number(find_lens("cooke_triplet"), 4.0)


@pytest.mark.slow
def test_a_decentred_element_is_told_by_a_picture_of_huygens_sums(triplet):
    """By other rays, nodes and pixels than the fit's. Five standard deviations, of 0.4 µm here."""
    errors = [Tolerance("decentre_x", 3, 0.1, 4), Tolerance("decentre_y", 3, 0.1, 4)]
    built = with_sensor(build(triplet, errors, [0.012, -0.02]), triplet.sensor_mm + 0.010)
    slopes = cross_of_points(2.5) / 50
    frame = huygens_frame(built, slopes, FrameGeometry(1800, 1800, PITCH))
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    unknowns = ("sensor_shift_um", "decentre_x:3-4", "decentre_y:3-4")
    whole = measure_frame([frame], optics, FrameRequest(lens=triplet, unknowns=unknowns, singly=False)).whole
    assert np.abs((whole.values - [10.0, 0.012, -0.02, 0.0]) / whole.errors).max() < 5
    assert (whole.errors < [0.5, 5e-4, 5e-4, 0.3]).all() and not whole.warnings
    assert [whole.model.unit(name) for name in unknowns] == ["µm", "mm", "mm"]
    found = lens_as_built(whole)
    assert found.surfaces[2].before[0].decentre[:2] == pytest.approx(whole.values[1:3])
    assert found.sensor_mm - triplet.sensor_mm == pytest.approx(whole.values[0] / 1000)


@pytest.mark.slow
def test_light_of_two_wavelengths_is_that_of_huygens_sums_in_each(triplet):
    """The lens itself focuses each elsewhere, and lands points elsewhere; its flint, 50 µm off, adds a pixel to that.

    Five standard deviations.
    """
    light = ((0.48, 1.0), (0.60, 2.0))
    built = build(triplet, [Tolerance("decentre_y", 3, 0.1, 4)], [-0.05])
    built = with_sensor(built, triplet.sensor_mm + 0.020)
    frame = huygens_frame(built, cross_of_points(4.0) / 50, FrameGeometry(2600, 2600, PITCH), light=light)
    optics = replace(lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH), light=light)
    unknowns = ("sensor_shift_um", "decentre_y:3-4")
    whole = measure_frame([frame], optics, FrameRequest(lens=triplet, unknowns=unknowns, singly=False)).whole
    assert whole.explains and np.abs((whole.values - [20.0, -0.05, 0.0]) / whole.errors).max() < 5


@pytest.mark.slow
@pytest.mark.parametrize(
    ("f_number", "away", "pixels", "unknowns", "truth"),
    [
        (4.0, 3.0, 25, ("sensor_shift_um", "decentre_x:3-4", "tilt_x:1-2"), [-30.0, 0.05, 0.2]),
        (2.8, 4.0, 31, ("sensor_shift_um", "decentre_x:5-6", "decentre_y:5-6"), [15.0, 0.040, -0.060]),
    ],
)
def test_a_fit_far_from_the_lens_as_designed_starts_from_the_width_of_its_points(
    f_number, away, pixels, unknowns, truth
):
    """From the design itself the fit ends in another minimum. Five standard deviations."""
    lens = with_f_number(find_lens("cooke_triplet"), f_number)
    model = FrameModel(lens_optics(lens, np.inf, lens.reference_wavelength_um, PITCH), 5.0, unknowns, lens)
    points = model_points(model, np.array(truth), 10.0, [(0.0, 0.0), (away, 0.0), (0.0, -away)], pixels=pixels)
    stuck = fit_frame(points, model, start=np.zeros(3))
    assert not stuck.explains
    found = fit_frame(points, model)
    assert found.explains and np.abs((found.values - truth) / found.bounds).max() < 5


def test_moments_of_rays_are_those_of_a_wavefront_s_slopes():
    """W40 ρ⁴ + Wd ρ² + W31 ρ²η lands rays at ∇W: by calculus ⟨x²⟩ is the mean of (4W40ρ³ + 2Wdρ)²/2 and so on."""
    nodes = paraxial_nodes((16, 44), 0.25)
    square = nodes.xi**2 + nodes.eta**2
    waves = np.stack([np.zeros_like(square), square**2, square, square * nodes.eta])
    rays = landings(waves, nodes.fx, nodes.fy, nodes.weight)
    values = np.array([1.0, 0.7, -1.2, 0.4])  # one, W40, Wd, W31
    xx, xy, yy = np.einsum("cij,i,j->c", ray_moments(rays, nodes.weight), values, values)
    even = (16 * 0.7**2 / 4 + 16 * 0.7 * -1.2 / 3 + 4 * 1.2**2 / 2) / 2
    # Of coma ⟨(2ξη)²⟩ = 4/24 across, ⟨(ξ² + 3η²)²⟩ − 1 along, with ⟨ξ⁴⟩ = 1/8 and ⟨ξ²η²⟩ = 1/24.
    assert 0.25**2 * xx == pytest.approx(even + 0.4**2 / 6, rel=1e-5)
    assert 0.25**2 * yy == pytest.approx(even + 0.4**2 * (10 / 8 + 6 / 24 - 1), rel=1e-5) and abs(xy) < 1e-5 * xx


def test_a_frame_that_nothing_explains_has_reasons_and_no_numbers(triplet, tmp_path):
    """Pictures at f/4, taken for f/5, which is said to be exact."""
    taken = simulated_frame(triplet, grid_of_points(3, 2, 1.2, 0.6), FrameGeometry(300, 480, PITCH), Exposure())
    other = with_f_number(triplet, 5.0)
    found = measure_frame(
        [taken],
        lens_optics(other, np.inf, 0.55, PITCH),
        FrameRequest(lens=other, unknowns=("tilt_x_deg",), singly=False, f_number_error=0),
    )
    assert not found.whole.reliable and found.whole.chi2 > 3
    (why,) = found.whole.warnings
    assert why.values["chi2"] == found.whole.chi2 and record(found)["frame"]["unknowns"] is None
    with pytest.raises(RequestError):
        lens_as_built(found.whole)
    write_measurement(found, tmp_path / "found.npz")
    assert "whole" not in read_measurement(tmp_path / "found.npz")[0]
    assert not has_lens_as_built(found) and not whole_rows(found)


@pytest.mark.slow
def test_a_single_point_that_nothing_explains_has_reasons_and_no_numbers(triplet, tmp_path):
    """A point taken twice, the sensor moved by 5 pixels between: no wavefront of four coefficients makes two points."""
    once = simulated_frame(triplet, np.array([[0.0, 0.0]]), FrameGeometry(44, 44, PITCH), Exposure(read_noise=2.0))
    twice = replace(once, values=once.values + np.roll(once.values, 5, axis=1))
    found = measure_frame([twice], lens_optics(triplet, np.inf, 0.55, PITCH))
    (fit,) = found.fits
    assert fit.chi2 > 3 and not fit.reliable and [why.values["chi2"] for why in fit.warnings] == [fit.chi2]
    (point,) = record(found)["points"]
    assert point["numbers"] is None and point["warnings"] and not point_rows(found, 0, None)
    arrays, _ = read_measurement(write_measurement(found, tmp_path / "found.npz"))
    assert np.isnan(arrays["numbers"]).all() and arrays["chi2"] == [fit.chi2]
    (exact,) = measure_frame([replace(twice, psf=True)], lens_optics(triplet, np.inf, 0.55, PITCH)).fits
    assert exact.chi2 > 3 and exact.reliable  # of a computed PSF, whose noise is assumed, it says nothing


def test_a_single_sphere_cannot_tell_a_tilt_from_a_decentre(triplet):
    """A sphere tilted about its vertex is one decentred by radius × angle: a law of geometry, and all the rays know."""
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    model = FrameModel(optics, 5.0, ("decentre_x:1", "tilt_y:1"), triplet)
    points = model_points(model, np.array([0.01, 0.0]), 10.0, [(0.0, 0.0), (2.0, 0.0)], pixels=21)
    found = fit_frame(points, model)
    radius = triplet.surfaces[0].radius
    per_degree = radius * np.deg2rad(1)  # a positive tilt about y takes the surface's centre towards +x
    both = np.array([1.0, per_degree])
    error = (both @ found.covariance @ both) ** 0.5
    assert abs(found.values @ both - 0.01) < 5 * error and error < 0.004 and found.bounds[0] > 25 * error
    assert [warning.values["names"] for warning in found.warnings] == [("decentre_x:1", "tilt_y:1")]


@pytest.mark.parametrize("name", ["decentre_x:7", "tilt_x:4-3", "radius:1-2", "thickness:6", "index:0"])
def test_surfaces_that_are_none_are_refused(triplet, name):
    optics = lens_optics(triplet, np.inf, 0.55, PITCH)
    with pytest.raises(RequestError, match="surfaces 1 to 6"):
        FrameModel(optics, 5.0, (name,), triplet)
    with pytest.raises(RequestError, match="choose from"):
        FrameModel(optics, 5.0, (name,))


@pytest.mark.parametrize("name", ["thickness:2", "radius:3", "index:3"])
def test_an_error_means_the_same_at_an_f_number_as_at_the_radius_of_its_stop(triplet, name):
    """What an error does to a point's wavefront, and the lens as built, whose stop keeps its radius."""
    error = perturbation(name, len(triplet.surfaces))
    stopped = replace(triplet, aperture=Aperture("stop_semi_diameter", float(stop_rim(triplet))))
    at_number, at_radius = (perturb(each, Source(field_deg=10), (error,), (0.05,)) for each in (triplet, stopped))
    for part in (lambda made: made.change.values, lambda made: made.landing_um, lambda made: made.landing_slopes):
        largest = np.abs(part(at_radius)).max()
        assert part(at_number) == pytest.approx(part(at_radius), abs=1e-9 * largest + 1e-12)
    model = FrameModel(lens_optics(triplet, np.inf, 0.5876, PITCH), 1.0, (name,), triplet)
    none = np.zeros(0)
    whole = FrameFit(model, (), np.array([0.05]), none, none, none, (), none, none, 1.0)
    assert lens_as_built(whole).aperture == stopped.aperture


def test_a_point_at_a_finite_depth_lands_where_rays_from_that_place_do():
    """By the referee's own rays: the thickness moves the entrance pupil, to which field angles refer, and no point."""
    lens, error = find_lens("telecentric_relay"), Tolerance("thickness", 6, 0.01)
    source, centre = Source(RELAYS_MM["telecentric_relay"], field_deg=max(lens.fields_deg)), np.zeros(1)
    seen = (reference.perturbed(lens, source, error, amount) for amount in (0.0, 0.2))
    still, moved = (one.traced(one.aimed(centre, centre))[0][:, 0] for one in seen)
    found = perturb(lens, source, (error,), (0.2,)).landing_um
    assert found == pytest.approx(1000 * (moved - still), abs=1e-4)
