"""Errors of a known lens as unknowns of a frame: decentres, tilts, spacings, told by pictures through that lens."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.lens.lens import with_f_number, with_sensor
from p2sf.lensfile.library import find_lens
from p2sf.measure.as_built import lens_as_built
from p2sf.measure.frame import FrameGeometry
from p2sf.measure.frame_fit import fit_frame
from p2sf.measure.frame_terms import FrameModel, lens_optics
from p2sf.measure.measurement import measured
from p2sf.tolerance.errors_of_build import Tolerance, build
from tests.measure.test_frames import model_points
from tests.support.huygens_frames import cross_of_points, huygens_frame

PITCH = 3.45


@pytest.fixture(scope="module")
def triplet():
    return with_f_number(find_lens("cooke_triplet"), 4.0)


def test_a_decentred_element_is_told_by_a_picture_of_huygens_sums(triplet):
    """By other rays, nodes and pixels than the fit's. Five standard deviations, of 0.4 µm here."""
    errors = [Tolerance("decentre_x", 3, 0.1, 4), Tolerance("decentre_y", 3, 0.1, 4)]
    built = with_sensor(build(triplet, errors, [0.012, -0.02]), triplet.sensor_mm + 0.010)
    slopes = cross_of_points(2.5) / 50
    frame = huygens_frame(built, slopes, FrameGeometry(1800, 1800, PITCH))
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    unknowns = ("sensor_shift_um", "decentre_x:3-4", "decentre_y:3-4")
    whole = measured([frame], optics, lens=triplet, unknowns=unknowns, singly=False).whole
    assert np.abs((whole.values - [10.0, 0.012, -0.02]) / whole.errors).max() < 5
    assert (whole.errors < [0.5, 5e-4, 5e-4]).all() and not whole.warnings
    assert [whole.model.unit(name) for name in unknowns] == ["µm", "mm", "mm"]
    found = lens_as_built(whole)
    assert found.surfaces[2].before[0].decentre[:2] == pytest.approx(whole.values[1:])
    assert found.sensor_mm - triplet.sensor_mm == pytest.approx(whole.values[0] / 1000)


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
    whole = measured([frame], optics, lens=triplet, unknowns=unknowns, singly=False).whole
    assert whole.explains and np.abs((whole.values - [20.0, -0.05]) / whole.errors).max() < 5


def test_a_fit_far_from_the_lens_as_designed_starts_again_elsewhere(triplet):
    """From the design itself the fit ends in another minimum. Five standard deviations."""
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    model = FrameModel(optics, 5.0, ("sensor_shift_um", "decentre_x:3-4", "tilt_x:1-2"), triplet)
    truth = np.array([-30.0, 0.05, 0.2])
    points = model_points(model, truth, 10.0, [(0.0, 0.0), (3.0, 0.0), (0.0, -3.0)], pixels=25)
    stuck = fit_frame(points, model, start=np.zeros(3))
    assert not stuck.explains
    found = fit_frame(points, model)
    assert found.explains and np.abs((found.values - truth) / found.bounds).max() < 5


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
