"""Distortion and relative illumination of a picture, before any blur."""

import numpy as np

from p2sf.lens.source import Source
from p2sf.pixel_kernels import SensorMap
from p2sf.pixel_kernels.illumination import light_collected, relative_illumination
from p2sf.scene.field_points import FieldMap, landing_mm
from p2sf.scene.sensor import Sensor
from p2sf.threads import mapped

LIGHT = 5  # places along each axis of a misaligned lens's sensor
MORE = 4  # heights where rims clip, whose vignetting begins and ends suddenly
VISIBLE_PX = 0.05  # distortion that moves no pixel farther than this is ignored


def distortion_px(seen: SensorMap, sensor: Sensor) -> float:
    """Return how far distortion moves the farthest displaced point, pixels."""
    heights = np.linspace(0, sensor.corners_mm()[1], 65)
    return float(np.abs(seen.ideal_height(heights) - heights).max() / sensor.pixel_mm)


def distorted(values: np.ndarray, seen: SensorMap | FieldMap, sensor: Sensor, order: int = 3) -> np.ndarray:
    """Return the picture as real chief rays place it, (rows, columns, channels) float32.

    ``values`` is the undistorted (paraxial) image on the same pixels; each pixel takes what lands on it, by a spline of
    this ``order``. Beyond the picture its outermost pixels are repeated.
    """
    from scipy.ndimage import map_coordinates

    x, y = sensor.x_mm(np.arange(sensor.columns)), sensor.y_mm(np.arange(sensor.rows))[:, None]
    if isinstance(seen, FieldMap):
        across, up = (seen.scale_mm * slope for slope in seen.slopes(*np.broadcast_arrays(x, y)))
    elif distortion_px(seen, sensor) <= VISIBLE_PX:
        return values
    else:
        height = np.hypot(x, y)
        ratio = seen.ideal_height(height) / np.maximum(height, 1e-12)
        ratio[height < 1e-9] = 1.0
        across, up = ratio * x, ratio * y
    column = (across - sensor.centre_mm[0]) / sensor.pixel_mm + (sensor.columns - 1) / 2
    row = (sensor.rows - 1) / 2 - (up - sensor.centre_mm[1]) / sensor.pixel_mm
    places = np.stack([row, column]).astype(np.float32)

    def moved(plane: np.ndarray) -> np.ndarray:
        found: np.ndarray = map_coordinates(plane, places, order=order, mode="nearest")
        return found

    return np.stack(mapped(moved, np.moveaxis(values, -1, 0)), axis=-1).astype(np.float32)


def illumination(seen: SensorMap | FieldMap, sensor: Sensor, count: int = 9) -> np.ndarray:
    """Return the irradiance of an even object over that on the axis, (rows, columns) float32, from ``count`` heights.

    Between these it is a polynomial of h², or where rims clip, which makes it bend, a monotone cubic. Behind a mask
    that is not round, which lights the azimuths unevenly, it is interpolated between ``count``² places, and through a
    misaligned lens between LIGHT².
    """
    if isinstance(seen, FieldMap):
        return _shading(seen, sensor)
    if not seen.lens.mask.round:
        return _illumination_on_grid(seen, sensor, count + MORE * seen.clip)
    heights = np.linspace(*sensor.corners_mm(), count + MORE * seen.clip)
    light = relative_illumination(seen, heights)
    x, y = sensor.x_mm(np.arange(sensor.columns)), sensor.y_mm(np.arange(sensor.rows))
    square = x * x + (y * y)[:, None]
    if seen.clip:
        from scipy.interpolate import PchipInterpolator

        fit = PchipInterpolator(heights**2, light)
    else:
        fit = np.polynomial.Polynomial.fit(heights**2, light, min(4, count - 1))
    light_at: np.ndarray = fit(square)
    return light_at.astype(np.float32)


def _illumination_on_grid(seen: SensorMap, sensor: Sensor, count: int) -> np.ndarray:
    """Return the illumination by splines through places on a grid: cubic, or linear where rims make it bend."""
    from scipy.interpolate import RectBivariateSpline

    rows, columns = (np.linspace(0, max(n - 1, 1), count) for n in (sensor.rows, sensor.columns))
    x, y = np.meshgrid(sensor.x_mm(columns), sensor.y_mm(rows))
    light = relative_illumination(seen, np.hypot(x, y), np.arctan2(x, y))
    degree = 1 if seen.clip else 3
    spline = RectBivariateSpline(rows, columns, light, kx=degree, ky=degree)
    light_at: np.ndarray = spline(np.arange(sensor.rows), np.arange(sensor.columns))
    return light_at.astype(np.float32)


def _shading(seen: FieldMap, sensor: Sensor) -> np.ndarray:
    """Return the irradiance of an even object over that of the field's centre, (rows, columns) float32."""
    from scipy.interpolate import RectBivariateSpline

    degree = 1 if seen.clip else 3
    rows, columns = (np.linspace(0, max(n - 1, 1), LIGHT) for n in (sensor.rows, sensor.columns))
    x, y = np.meshgrid(sensor.x_mm(columns), sensor.y_mm(rows))

    def irradiance(x_mm: float, y_mm: float) -> float:
        collected = light_collected(seen.lens, seen.source(x_mm, y_mm, seen.wavelength_um), seen.clip)
        return collected * float(seen.thinning(np.asarray(x_mm), np.asarray(y_mm)))

    light = np.array(mapped(lambda place: irradiance(*place), zip(x.ravel().tolist(), y.ravel().tolist(), strict=True)))
    centre = irradiance(*landing_mm(seen.lens, Source(seen.depth_mm, 0.0, seen.wavelength_um)))
    spline = RectBivariateSpline(rows, columns, light.reshape(x.shape) / centre, kx=degree, ky=degree)
    shade: np.ndarray = spline(np.arange(sensor.rows), np.arange(sensor.columns))
    return shade.astype(np.float32)
