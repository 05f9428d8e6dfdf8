"""The f-number is what a maker engraved: an unknown of a frame, of which only so much is known beforehand."""

from dataclasses import replace

import numpy as np
import pytest

from p2sf.errors import RequestError
from p2sf.lens.lens import with_f_number
from p2sf.lensfile.library import find_lens
from p2sf.measure.as_built import lens_as_built
from p2sf.measure.fitting.frame_fit import PointSum, fit_frame
from p2sf.measure.fitting.frame_terms import FIELD, FOCUS, FrameModel, FramePoint, lens_optics
from p2sf.measure.fitting.point_model import PictureOptics
from p2sf.measure.fitting.point_problem import PointPicture
from p2sf.measure.frame import FrameGeometry
from p2sf.measure.measurement import FrameRequest, measure_frame
from p2sf.measure.simulation import Exposure, grid_of_points, simulated_frame
from p2sf.paraxial.pupils import stop_rim
from tests.measure.test_frames import model_points

PITCH = 3.45
UNKNOWNS = (*FOCUS, *FIELD, "f_number")


@pytest.fixture(scope="module")
def triplet():
    return with_f_number(find_lens("cooke_triplet"), 4.0)


@pytest.mark.parametrize("beside", [True, False])
def test_light_through_another_stop_and_its_derivative(triplet, beside):
    """A stop 2 % smaller, from the pupil of the nominal one and set up anew: 0.3 % of the peak, of which it changes 6.

    The derivative by differences of the light.
    """
    lens = triplet if beside else None
    optics = lens_optics(triplet, np.inf, triplet.reference_wavelength_um, PITCH)
    values, place = np.array([30.0, 0.1, -0.05, 0.2, 0.3, 0.1, 0.1, 2.0]), (1.0, -0.7)
    model, point = FrameModel(optics, 7.5, UNKNOWNS, lens), FramePoint(PointPicture(np.zeros((25, 25))), 3.0, 4.5)
    found = PointSum(point, model)
    light, slopes = found.light_and_slopes(values, *place)
    step = 0.05 * np.eye(8)[7]
    difference = (found.light(values + step, *place) - found.light(values - step, *place)) / 0.1
    assert slopes[7] == pytest.approx(difference, abs=5e-4 * np.abs(difference).max())
    stopped = with_f_number(triplet, 4.08) if beside else None
    anew = FrameModel(replace(optics, na=optics.na / 1.02), 7.5, UNKNOWNS[:-1], stopped)
    direct = PointSum(point, anew).light(values[:-1], *place)
    assert light == pytest.approx(direct, abs=3e-3 * direct.max())
    nominal = found.light(values * (np.arange(8) < 7), *place)
    assert np.abs(nominal - direct).max() > 0.015 * direct.max()


@pytest.mark.slow
def test_an_f_number_that_is_3_per_cent_wrong_moves_nothing(triplet):
    """Pictures at f/4, taken for f/4.12: W40 was 29 standard deviations off, and χ² 0.99; now all are within 4."""
    exposure = Exposure(sensor_shift_um=25.0, tilt_deg=(0.1, -0.05))
    frame = simulated_frame(triplet, grid_of_points(3, 3, 4.0, 2.0), FrameGeometry(680, 1260, PITCH), exposure)
    wrong = with_f_number(triplet, 4.12)
    optics, truth = lens_optics(wrong, np.inf, 0.55, PITCH), np.array([25.0, 0.1, -0.05, 0.0, 0.0, 0.0, 0.0])
    believed, free = (
        measure_frame([frame], optics, FrameRequest(lens=wrong, singly=False, f_number_error=error)).whole
        for error in (0.0, 3.0)
    )
    assert np.abs((believed.values - truth) / believed.errors).max() > 20 and believed.chi2 < 1.1
    miss = (free.values - np.append(truth, 100 * (4.0 / 4.12 - 1))) / free.errors
    assert np.abs(miss).max() < 4 and free.errors[-1] < 0.5
    assert stop_rim(lens_as_built(free)) == pytest.approx(stop_rim(triplet), rel=4 * free.errors[-1] / 100)


def test_an_f_number_is_found_without_a_lens():
    """By the width of points alone: a prior of 3 % and a truth 4 % away. Five standard deviations."""
    model = FrameModel(PictureOptics(0.125, 0.55, 2.2), 5.0, ("sensor_shift_um", "w40", "w31", "f_number"))
    truth = np.array([20.0, 0.1, 0.6, 4.0])
    points = model_points(model, truth, 3.0, grid_of_points(3, 2, 8.0, 6.0), focus=(0.0, 60.0))
    found = fit_frame(points, model, start=np.zeros(4))
    assert np.abs((found.values - truth) / found.bounds).max() < 5 and found.bounds[-1] < 1.0 and found.explains


@pytest.mark.slow
def test_what_no_picture_tells_is_known_to_the_prior_at_least():
    """Points far apart but all alike, and so faint that they tell next to nothing of the f-number."""
    model = FrameModel(PictureOptics(0.125, 0.55, 2.2), 5.0, ("sensor_shift_um", "f_number"))
    points = model_points(model, np.array([20.0, 0.0]), 150.0, [(0.0, 0.0), (4.0, 0.0)])
    found = fit_frame(points, model, start=np.array([20.0, 0.0]))
    assert 1.5 < found.bounds[1] <= 3.0 and abs(found.values[1]) < 10
    narrow = fit_frame(points, replace(model, f_number_error=0.1), start=np.array([20.0, 0.0]))
    assert narrow.bounds[1] < 0.1 and abs(narrow.values[1]) < 0.3


def test_an_error_of_the_f_number_is_a_number(triplet):
    frame = simulated_frame(triplet, np.array([[0.0, 0.0]]), FrameGeometry(120, 120, PITCH), Exposure())
    for wrong in (-1.0, float("nan"), float("inf")):
        with pytest.raises(RequestError) as caught:
            measure_frame([frame], lens_optics(triplet, np.inf, 0.55, PITCH), FrameRequest(f_number_error=wrong))
        assert caught.value.message.values["parameter"] == "f_number_error"
