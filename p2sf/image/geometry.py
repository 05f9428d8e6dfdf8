"""Distortion and relative illumination of a picture, before any blur."""

import numpy as np

from p2sf.image.region import Region, whole
from p2sf.pixel_kernels.illumination import relative_illumination
from p2sf.pixel_kernels.sensor_points import SensorMap
from p2sf.scene.sensor import Sensor
from p2sf.threads import map_threads

TRIED = 33  # points along each axis at which distortion is evaluated
MORE = 4  # heights, or places along each axis, where rims clip, whose vignetting begins and ends suddenly
SPLINE_REACH = 16  # pixels: a cubic spline's dependence on its samples falls by 3.7 from one to the next
EVERY_PX = 8  # pixels between places at which distortion is evaluated: between them it bends by some 1e-3 of a pixel
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
    places = source_places(seen, sensor, whole(values.shape))
    return values if places is None else resample(values, places, order, whole(values.shape))


def resample(values: np.ndarray, places: np.ndarray, order: int, given: Region) -> np.ndarray:
    """Return a picture at ``places`` of it, (2, rows, columns), by a spline of this order, (rows, columns, channels).

    ``values`` are those of the region ``given``, beyond which its outermost pixels are repeated.
    """
    from scipy.ndimage import map_coordinates

    needed = region_of(places, given, SPLINE_REACH if order > 1 else 1)
    places = places - np.array([needed.top, needed.left], np.float32)[:, None, None]
    part = values[needed.within(given)]

    def moved(plane: np.ndarray) -> np.ndarray:
        found: np.ndarray = map_coordinates(plane, places, np.float32, order=order, mode="nearest")
        return found

    return np.stack(map_threads(moved, np.moveaxis(part, -1, 0)), axis=-1)


def source_places(seen: SensorMap, sensor: Sensor, region: Region) -> np.ndarray | None:
    """Return row and column of the undistorted picture that land on pixels, (2, rows, columns) float32.

    None where distortion moves no pixel of the sensor visibly.
    """
    if distortion_px(seen, sensor) <= VISIBLE_PX:
        return None
    # Places are the same for every region, so that those of two tiles join.
    rows, columns = (
        EVERY_PX * np.arange(n[0] // EVERY_PX, -(-n[-1] // EVERY_PX) + 1) for n in (region.rows, region.columns)
    )
    across, up = seen.ideal_mm(sensor.x_mm(columns), sensor.y_mm(rows)[:, None])
    column = (across - sensor.centre_mm[0]) / sensor.pixel_mm + (sensor.columns - 1) / 2
    row = (sensor.rows - 1) / 2 - (up - sensor.centre_mm[1]) / sensor.pixel_mm
    inside = region.within(Region(int(rows[0]), int(rows[-1]) + 1, int(columns[0]), int(columns[-1]) + 1))
    return np.stack([_between(each.astype(np.float32))[inside] for each in (row, column)])


def _between(grid: np.ndarray) -> np.ndarray:
    """Return values on a grid of every EVERY_PX-th pixel at all pixels, linear between."""
    return _lines_between(np.ascontiguousarray(_lines_between(grid.T).T))


def _lines_between(lines: np.ndarray) -> np.ndarray:
    """Return EVERY_PX lines for each that is given, linear to the next, and the last."""
    place = np.arange(EVERY_PX * (len(lines) - 1) + 1, dtype=np.float32) / EVERY_PX
    first = np.minimum(place.astype(int), max(len(lines) - 2, 0))
    found: np.ndarray = np.diff(lines, axis=0, append=lines[-1:])[first]
    found *= (place - first)[:, None]
    found += lines[first]
    return found


def region_of(places: np.ndarray, given: Region, more: int = 1) -> Region:
    """Return the pixels around places, (2, …), and ``more`` on every side, as far as they are given."""
    first, last = (np.array([end(plane) for plane in places]) for end in (np.min, np.max))
    top, left = np.floor(first).astype(int).tolist()
    bottom, right = (np.ceil(last).astype(int) + 1).tolist()
    top, left = min(max(top, given.top), given.bottom - 1), min(max(left, given.left), given.right - 1)
    return Region(top, max(bottom, top + 1), left, max(right, left + 1)).grown(more).meet(given)


def illumination(seen: SensorMap, sensor: Sensor, count: int = 9, region: Region | None = None) -> np.ndarray:
    """Return the irradiance of a uniform object relative to that at the field's centre, (rows, columns) float32.

    Over the whole sensor or a ``region`` of it. From ``count``² places, between which it is interpolated by a cubic
    spline, or where rims clip, which makes it bend suddenly, from more and linearly. That of a round pupil about an
    axis of symmetry depends on the height alone.
    """
    from scipy.interpolate import RectBivariateSpline

    region = region or whole((sensor.rows, sensor.columns))
    count, degree = count + MORE * seen.clip, 1 if seen.clip else min(3, count - 1)
    if seen.about_axis:
        return _about_axis(seen, sensor, count, region)
    rows, columns = (np.linspace(0, max(n - 1, 1), count) for n in (sensor.rows, sensor.columns))
    light = relative_illumination(seen, *np.meshgrid(sensor.x_mm(columns), sensor.y_mm(rows)))
    spline = RectBivariateSpline(rows, columns, light, kx=degree, ky=degree)
    light_at: np.ndarray = spline(region.rows, region.columns)
    return light_at.astype(np.float32)


def _about_axis(seen: SensorMap, sensor: Sensor, count: int, region: Region) -> np.ndarray:
    """Return the illumination from heights: a polynomial of h², or where rims clip a monotone cubic."""
    heights = np.linspace(*sensor.corners_mm(), count)
    light = relative_illumination(seen, 0.0, heights)
    x, y = sensor.x_mm(region.columns), sensor.y_mm(region.rows)
    square = x * x + (y * y)[:, None]
    if seen.clip:
        from scipy.interpolate import PchipInterpolator

        fit = PchipInterpolator(heights**2, light)
    else:
        fit = np.polynomial.Polynomial.fit(heights**2, light, min(4, count - 1))
    light_at: np.ndarray = fit(square)
    return light_at.astype(np.float32)
