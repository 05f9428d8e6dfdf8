"""A picture at the resolution of the screen that shows it: so many pixels joined to one, and then formed.

The kernels are those of the larger pixels. What they do not tell is where in such a pixel the light comes from: they
take it to come from its middle, so that the result is a little sharper than the joined pixels of the formed picture.
"""

from dataclasses import replace

import numpy as np

from p2sf.image.form import check_picture
from p2sf.image.layers import check_map_shape
from p2sf.scene.scene import Scene
from p2sf.scene.sensor import Sensor

Picture = tuple[Scene, np.ndarray, np.ndarray | None]


def fit_screen(scene: Scene, values: np.ndarray, depth_mm: np.ndarray | None, longest: int) -> Picture:
    """Return scene, picture and depths (rows, columns) with whole numbers of pixels joined to one along each side.

    As few as leave ``longest`` pixels along the longer side at most; none where there are no more. Colours are means of
    their pixels, and depths are those in the middle of these, since no depth lies between two. RequestError as
    `form_image`, and for a mosaic.
    """
    values, sensor = check_picture(scene, values), scene.sensor
    times = times_to_fit(sensor, longest)
    if times == 1:
        return scene, values, depth_mm
    if depth_mm is not None:
        check_map_shape(depth_mm, values.shape[:2])
        depth_mm = _whole_blocks(depth_mm, times)[times // 2 :: times, times // 2 :: times]
    return replace(scene, sensor=sensor.bin_pixels(times)), block_means(values, times), depth_mm


def times_to_fit(sensor: Sensor, longest: int) -> int:
    """Return how many pixels are joined along each side, so that the longer one has ``longest`` at most.

    No more than the shorter side has, of which a pixel is left.
    """
    times = -(-max(sensor.rows, sensor.columns) // longest)
    return min(times, sensor.rows, sensor.columns)


def block_means(values: np.ndarray, times: int) -> np.ndarray:
    """Return a picture averaged over blocks of ``times``² pixels, float32; what fills none is cut off at both ends."""
    cut = _whole_blocks(np.asarray(values, np.float32), times)
    total: np.ndarray = np.zeros_like(cut[::times, ::times])
    for i in range(times):
        for j in range(times):
            total += cut[i::times, j::times]
    return total / np.float32(times * times)


def _whole_blocks(values: np.ndarray, times: int) -> np.ndarray:
    """Return the middle of an array, as much of it as blocks fill."""
    starts = [n % times // 2 for n in values.shape[:2]]
    rows, columns = (slice(start, start + n // times * times) for start, n in zip(starts, values.shape, strict=False))
    return values[rows, columns]
