"""A picture with depth by the kernel of every single pixel, in every wavelength: no nodes in field, depth or colour.

Layers of depth are taken from `map_depths`, one for each depth of the scene, and what they hide from `Passing`, so that
it is a reference for kernels and not for occlusion, which `tests.support.visibility` is.
"""

import numpy as np

from p2sf.conventions import vergence
from p2sf.image.layers import map_depths
from p2sf.image.pupil_moments import MOMENTS, Passing, kernel_moments, pupil_landings
from p2sf.scene.planning.plan import Plan

TOGETHER = 400  # pixels whose kernels are computed at once

Region = tuple[slice, slice]
"""Rows and columns of a picture."""


def widest_half(planned: Plan, vergences: np.ndarray) -> int:
    """Return the half width of the widest kernel in the corner, pixels."""
    x, y = ([end[-1]] for end in planned.scene.sensor.ends_mm())
    middle = len(planned.colours) // 2
    return max(int(planned.kernels(middle, float(v)).points(x, y).half_widths()[0]) for v in vergences[[0, -1]])


def per_pixel_picture(
    planned: Plan, values: np.ndarray, depth_mm: np.ndarray, region: Region, channel: int
) -> np.ndarray:
    """Return a region of one channel of the formed picture, (rows, columns), without distortion and illumination.

    ``values``: that channel, (rows, columns). The region is farther from the picture's edge than kernels reach.
    """
    levels = np.unique(vergence(depth_mm))
    half = widest_half(planned, levels)
    shape = (*(part.stop - part.start for part in region), 1)
    light, covered, passing = 0.0, 0.0, Passing(shape)
    for layer in map_depths(depth_mm, levels, values.shape, half).layers(values[..., None]):
        planes = np.stack([layer.colours[..., 0] * layer.opacity, layer.opacity, layer.hiding], axis=-1)
        every = _spread(planned, float(levels[layer.number]), channel, planes, region, half)
        shown = np.clip(np.sum(passing.values * every[..., :2], axis=0), 0, every[0, ..., :2])
        light, covered = light + shown[..., 0], covered + shown[..., 1]
        passing.hide(np.s_[:, :], every[..., 2:])
    found: np.ndarray = light / covered
    return found


def _spread(planned: Plan, vergence: float, channel: int, planes: np.ndarray, region: Region, half: int) -> np.ndarray:
    """Return what a layer's pixels send into a region, each by its own kernel and then by that kernel's moments.

    (1 + MOMENTS, rows, columns, planes).
    """
    (top, bottom), (left, right) = ((part.start - half, part.stop + half) for part in region)
    rows, columns = np.nonzero(planes[top:bottom, left:right, 1])
    rows, columns = rows + top, columns + left
    canvas = np.zeros((1 + MOMENTS, bottom - top + 2 * half, right - left + 2 * half, planes.shape[-1]))
    sensor, kernels = planned.scene.sensor, planned.kernels(channel, vergence)
    landings = pupil_landings(planned, vergence)
    for start in range(0, len(rows), TOGETHER):
        row, column = rows[start : start + TOGETHER], columns[start : start + TOGETHER]
        points = kernels.points(sensor.x_mm(column), sensor.y_mm(row))
        halves = np.minimum(points.half_widths(), half)
        for r, c, h, kernel in zip(row, column, halves, points.kernels(halves), strict=True):
            r0, c0 = r - top + half - h, c - left + half - h
            means, reach = (each[0, 0] for each in landings.at(np.array([r]), np.array([c])))
            moments = kernel_moments(kernel[None], means, reach)
            every = np.concatenate([kernel[None], moments[:, 0]])
            canvas[:, r0 : r0 + 2 * h + 1, c0 : c0 + 2 * h + 1] += every[..., None] * planes[r, c]
    return canvas[:, 2 * half : -2 * half, 2 * half : -2 * half]
