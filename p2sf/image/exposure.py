"""What a sensor makes of the light on it: mosaic, electrons and their noise, full well, raw numbers."""

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments, real_array
from p2sf.errors import RequestError
from p2sf.scene.sensor import Sensor

TOGETHER = 2**20  # samples whose electrons are drawn at once, which bounds the memory
LARGEST_SEED = 2**63 - 1
COLOURS = "rgb"
FULL = 1e3  # wells: brighter light than this fills a pixel for certain


@check_arguments
def expose(sensor: Sensor, light: ArrayLike, seed: int = 0) -> np.ndarray:
    """Return what a sensor reads of a picture, a full pixel being 1, (rows, columns, channels or 1) float32.

    ``light``: (rows, columns, channels), of which 1 fills a pixel whose fill factor is 1. A mosaic leaves one channel,
    the colour of each pixel. Electrons are drawn from Poisson's distribution, those beyond the full well are lost, and
    read noise is normal. With ``bits`` the result has their steps and limits; otherwise a dark pixel may be negative.
    The same ``seed`` gives the same noise. Raises RequestError for another shape, a mosaic of other than three
    channels and a seed that is negative or no whole number.
    """
    check_seed(seed)
    light = real_array("light", light).astype(np.float32) * np.float32(sensor.fill_factor)
    if light.ndim != 3:
        raise RequestError("a picture of shape {shape}; give rows, columns and colours", shape=str(light.shape))
    if sensor.mosaic is not None:
        light = _through_mosaic(light, sensor.mosaic)
    if sensor.full_well is not None:
        light = _with_noise(light, sensor.full_well, sensor.read_noise, seed)
    if sensor.steps is None:
        return light
    steps = np.float32(sensor.steps)
    reading: np.ndarray = np.clip(np.rint(light * steps), -sensor.black_level, steps) / steps
    return reading


def check_seed(seed: int) -> None:
    """Raise RequestError for a seed that is negative or no whole number."""
    if not 0 <= seed <= LARGEST_SEED or seed % 1:
        raise RequestError(
            "{parameter} is {value}; give a whole number from {low} to {high}",
            parameter="seed",
            value=seed,
            low=0,
            high=LARGEST_SEED,
        )


@check_arguments
def raw_numbers(sensor: Sensor, reading: ArrayLike) -> np.ndarray:
    """Return the raw numbers of a reading of `expose`, uint16, shape kept; RequestError for a sensor without bits."""
    if sensor.steps is None:
        raise RequestError("the sensor has no bits, and so no raw numbers; state them")
    return np.asarray(np.rint(np.asarray(reading) * sensor.steps) + sensor.black_level, np.uint16)


def _through_mosaic(light: np.ndarray, mosaic: str) -> np.ndarray:
    """Return the channel of every pixel's colour, (rows, columns, 1)."""
    if light.shape[-1] != len(COLOURS):
        raise RequestError(
            "the mosaic {mosaic} needs red, green and blue, but the picture has {count} channels; change one of them",
            mosaic=mosaic,
            count=light.shape[-1],
        )
    block = np.array([COLOURS.index(colour) for colour in mosaic]).reshape(2, 2)
    rows, columns = light.shape[:2]
    number = np.tile(block, (-(-rows // 2), -(-columns // 2)))[:rows, :columns]
    return np.take_along_axis(light, number[..., None], axis=-1)


def _with_noise(light: np.ndarray, well: float, read_noise: float, seed: int) -> np.ndarray:
    random, found = np.random.default_rng(int(seed)), np.empty_like(light)
    step = max(1, TOGETHER // max(1, light[0].size))
    for start in range(0, len(light), step):
        rows = np.s_[start : start + step]
        expected = np.clip(light[rows].astype(float), 0, FULL) * well
        electrons = np.minimum(random.poisson(expected), well)
        found[rows] = (electrons + random.normal(0, read_noise, expected.shape)) / well
    return found
