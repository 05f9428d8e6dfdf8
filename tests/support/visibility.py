"""A picture of two depths by what each part of the pupil sees: the nearer where its ray meets it, else the farther."""

import numpy as np

from p2sf.pixel_kernels.ray_spread import ray_spread
from p2sf.scene import Plan

EVERY = np.s_[4::8, 6::12]  # of the cells of the pupil: those in the middle of as many


def seen_through_pupil(planned: Plan, near: np.ndarray, picture: np.ndarray) -> np.ndarray:
    """Return the light on every pixel, (rows, columns), without field: ``near`` where the nearer depth is.

    Behind it the farther one goes on as the nearest pixel of the row or column, as no depth map can know.
    """
    return seen_through_layers(planned, near.astype(float), picture, _continued(picture, near))


def _continued(picture: np.ndarray, near: np.ndarray) -> np.ndarray:
    """Return the picture with every pixel of the nearer depth replaced, found by trying every pixel in line with it.

    First from pixels of the farther depth; then what has none of them in line, from those already replaced.
    """
    far, open_now = picture.copy(), ~near
    for _ in range(2):
        given, known = far.copy(), open_now.copy()
        for row, column in zip(*np.nonzero(~known), strict=True):
            beside, above = np.flatnonzero(known[row]), np.flatnonzero(known[:, column])
            tried = [(abs(int(k) - column), row, int(k)) for k in beside] + [
                (abs(int(k) - row), int(k), column) for k in above
            ]
            if tried:
                _, *place = min(tried, key=lambda each: each[0])
                far[row, column], open_now[row, column] = given[tuple(place)], True
    return far


def seen_through_layers(planned: Plan, alpha: np.ndarray, front: np.ndarray, behind: np.ndarray) -> np.ndarray:
    """Return the light on every pixel, (rows, columns), without field, of a layer ``front`` and what is behind it.

    A ray that meets the front where its ``alpha`` is α has α of its light and 1 − α of the light behind.
    """
    total, shares, pixel_um = np.zeros(front.shape), 0.0, planned.scene.sensor.pixel_um
    wave = planned.colours[0].wavelengths_um[0]
    spreads = []
    for vergence in planned.vergences:
        seen = planned.sensor_map(vergence)
        spreads.append(ray_spread(seen.lens, seen.source(0.0, 0.0, wave)))
    far, near = spreads
    for side in near.sides:
        places = [(side * spread.x_um[EVERY] / pixel_um, spread.y_um[EVERY] / pixel_um) for spread in (near, far)]
        (x, y), (far_x, far_y) = places
        for light, *moves in zip(*(part.flat for part in (near.light[EVERY], x, y, far_x, far_y)), strict=True):
            meets = _shifted(alpha, *moves[:2])
            total += light * (meets * _shifted(front, *moves[:2]) + (1 - meets) * _shifted(behind, *moves[2:]))
            shares += light
    return total / shares


def _shifted(values: np.ndarray, right: float, up: float) -> np.ndarray:
    """Return the values that rays carry ``right`` and ``up`` by pixels; beyond the edge its own."""
    rows, columns = np.indices(values.shape)
    row, column = (np.rint(at).astype(int) for at in (rows + up, columns - right))
    return values[np.clip(row, 0, len(values) - 1), np.clip(column, 0, values.shape[1] - 1)]
