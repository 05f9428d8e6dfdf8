"""Distortion and relative illumination of a picture, before any blur."""

import numpy as np

from p2sf.pixel_kernels import SensorMap
from p2sf.pixel_kernels.illumination import relative_illumination
from p2sf.scene.sensor import Sensor
from p2sf.threads import map_threads

TRIED = 33  # points along each axis at which distortion is evaluated
MORE = 4  # heights, or places along each axis, where rims clip, whose vignetting begins and ends suddenly
VISIBLE_PX = 0.05  # distortion is ignored if it moves no pixel farther than this


def distortion_px(seen: SensorMap, sensor: Sensor) -> float:
    """Return the largest displacement by distortion, pixels."""
    (top, left), (bottom, right) = (-0.5, -0.5), (sensor.rows - 0.5, sensor.columns - 0.5)
    x, y = np.meshgrid(sensor.x_mm(np.linspace(left, right, TRIED)), sensor.y_mm(np.linspace(top, bottom, TRIED)))
    across, up = seen.ideal_mm(x, y)
    return float(np.hypot(across - x, up - y).max() / sensor.pixel_mm)


def distort(values: np.ndarray, seen: SensorMap, sensor: Sensor, order: int = 3) -> np.ndarray:
    """Return the picture distorted according to real chief rays, (rows, columns, channels) float32.

    ``values`` is the undistorted (paraxial) image on the same pixels; each pixel is interpolated by a spline of this
    ``order``. Beyond the picture its outermost pixels are repeated.
    """
    from scipy.ndimage import map_coordinates

    if distortion_px(seen, sensor) <= VISIBLE_PX:
        return values
    x, y = sensor.x_mm(np.arange(sensor.columns)), sensor.y_mm(np.arange(sensor.rows))[:, None]
    across, up = seen.ideal_mm(x, y)
    column = (across - sensor.centre_mm[0]) / sensor.pixel_mm + (sensor.columns - 1) / 2
    row = (sensor.rows - 1) / 2 - (up - sensor.centre_mm[1]) / sensor.pixel_mm
    places = np.stack([row, column]).astype(np.float32)

    def moved(plane: np.ndarray) -> np.ndarray:
        found: np.ndarray = map_coordinates(plane, places, order=order, mode="nearest")
        return found

    return np.stack(map_threads(moved, np.moveaxis(values, -1, 0)), axis=-1).astype(np.float32)


def illumination(seen: SensorMap, sensor: Sensor, count: int = 9) -> np.ndarray:
    """Return the irradiance of a uniform object relative to that at the field's centre, (rows, columns) float32.

    From ``count``² places, between which it is interpolated by a cubic spline, or where rims clip, which makes it bend
    suddenly, from more and linearly. That of a round pupil about an axis of symmetry depends on the height alone.
    """
    from scipy.interpolate import RectBivariateSpline

    count, degree = count + MORE * seen.clip, 1 if seen.clip else min(3, count - 1)
    if seen.about_axis:
        return _about_axis(seen, sensor, count)
    rows, columns = (np.linspace(0, max(n - 1, 1), count) for n in (sensor.rows, sensor.columns))
    light = relative_illumination(seen, *np.meshgrid(sensor.x_mm(columns), sensor.y_mm(rows)))
    spline = RectBivariateSpline(rows, columns, light, kx=degree, ky=degree)
    light_at: np.ndarray = spline(np.arange(sensor.rows), np.arange(sensor.columns))
    return light_at.astype(np.float32)


def _about_axis(seen: SensorMap, sensor: Sensor, count: int) -> np.ndarray:
    """Return the illumination from heights: a polynomial of h², or where rims clip a monotone cubic."""
    heights = np.linspace(*sensor.corners_mm(), count)
    light = relative_illumination(seen, 0.0, heights)
    x, y = sensor.x_mm(np.arange(sensor.columns)), sensor.y_mm(np.arange(sensor.rows))
    square = x * x + (y * y)[:, None]
    if seen.clip:
        from scipy.interpolate import PchipInterpolator

        fit = PchipInterpolator(heights**2, light)
    else:
        fit = np.polynomial.Polynomial.fit(heights**2, light, min(4, count - 1))
    light_at: np.ndarray = fit(square)
    return light_at.astype(np.float32)
