"""An error that the sensor's noise hides is allowed: a third of the noise, whatever the picture."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import fftconvolve

from p2sf.errors import RequestError
from p2sf.image.form import form_image
from p2sf.lensfile.library import find_lens
from p2sf.scene.planning.plan import plan
from p2sf.scene.scene import NOISE_PART, Channel, Scene
from p2sf.scene.sensor import Sensor

GREEN = (Channel("green", (530.0, 560.0), (1.0, 1.0)),)
DIM = Sensor(48, 64, 12.0, full_well=200.0, read_noise=3.0, bits=12)
TIGHT = Scene(DIM, GREEN, 25000.0, rtol=0.005, f_number=5.6)
LENS = find_lens("double_gauss_28")


@pytest.fixture(scope="module")
def plans():
    """Return the plan of a sensor that counts light, and that of ideal pixels."""
    return plan(LENS, TIGHT), plan(LENS, replace(TIGHT, sensor=Sensor(48, 64, 12.0)))


@pytest.mark.parametrize("mean", [0.03, 0.3, 0.5, 0.9])
@pytest.mark.parametrize("sensor", [DIM, replace(DIM, read_noise=0.0, bits=None), Sensor(48, 64, 12.0, bits=5)])
@pytest.mark.parametrize("light", [1.0, 0.1])
def test_the_error_of_independent_pixels_is_at_most_a_third_of_their_noise(sensor, mean, light):
    """Black and white pixels, which vary most of all with their mean, by kernels with the error that is allowed."""
    random = np.random.default_rng(4)
    picture = light * (random.random((300, 300)) < mean)
    kernel, off = random.random((5, 5)), random.normal(size=(5, 5))
    kernel /= kernel.sum()
    scene = replace(TIGHT, sensor=sensor, brightest=light)
    off *= scene.noise_floor * np.linalg.norm(kernel) / np.linalg.norm(off - off.mean())
    error = fftconvolve(picture, off - off.mean() * np.ones_like(off), mode="valid")
    noise = sensor.noise(fftconvolve(picture, kernel, mode="valid"))
    assert np.sqrt(np.mean(error**2)) <= NOISE_PART * np.sqrt(np.mean(noise**2)) * 1.03  # of 90 000 random pixels


def test_a_sensor_that_counts_light_allows_more_and_the_plan_says_so(plans):
    dim, ideal = plans
    assert dim.allowed_error == pytest.approx(NOISE_PART * float(DIM.noise(1.0)))
    assert ideal.allowed_error == 0.005
    kinds = [[decision.kind for decision in each.decisions] for each in plans]
    assert "noise" in kinds[0] and "noise" not in kinds[1]
    assert len(dim.vergences) < len(ideal.vergences) and dim.cost.kernel_seconds < ideal.cost.kernel_seconds
    assert dim.predicted_error <= dim.allowed_error


def test_a_picture_by_the_looser_plan_differs_by_less_than_a_third_of_the_noise(plans):
    values = (np.random.default_rng(1).random((48, 64, 1)) < 0.4).astype(np.float32)
    loose, tight = (form_image(each, values) for each in plans)
    noise = np.sqrt(np.mean(DIM.noise(tight) ** 2))
    assert 0 < np.sqrt(np.mean((loose - tight) ** 2)) < NOISE_PART * noise


def test_less_light_has_more_noise_and_errors_of_kernels_have_none():
    floors = [replace(TIGHT, brightest=light).noise_floor for light in (0.01, 0.1, 1.0, 10.0)]
    assert floors == sorted(floors, reverse=True)
    assert replace(TIGHT, sensor=Sensor(48, 64, 12.0)).noise_floor == 0
    assert replace(TIGHT, rtol=None, min_r2=0.9999).relative_tolerance == TIGHT.noise_floor
    assert replace(TIGHT, rtol=None, tail_error=0.005).relative_tolerance == 0.005
    assert replace(TIGHT, rtol=None, mtf_error=0.005).relative_tolerance == 0.005
    assert replace(TIGHT, rtol=0.2).relative_tolerance == 0.2


@pytest.mark.parametrize("light", [0.0, -1.0, np.nan, np.inf, 1e10])
def test_the_brightest_light_is_a_positive_number(light):
    with pytest.raises(RequestError) as refused:
        replace(TIGHT, brightest=light)
    assert refused.value.message.values["parameter"] == "brightest"


def test_light_beyond_what_was_planned_for_is_refused_where_noise_decides(plans):
    dim, ideal = plans
    values = np.full((48, 64, 1), 2.0, np.float32)
    with pytest.raises(RequestError) as refused:
        form_image(dim, values)
    assert refused.value.message.values["most"] == 2.0
    assert form_image(ideal, values).max() > 1
