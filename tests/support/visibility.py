"""A picture of a few depths by what each part of the pupil sees: the nearest that its ray meets."""

import numpy as np

from p2sf.pixel_kernels.ray_spread import ray_spread
from p2sf.scene.planning.plan import Plan

EVERY = np.s_[4::8, 6::12]  # of the cells of the pupil: those in the middle of as many


def seen_through_pupil(planned: Plan, near: np.ndarray, picture: np.ndarray) -> np.ndarray:
    """Return the light on every pixel, (rows, columns), without field: ``near`` where the nearer depth is.

    Behind it the farther one goes on as the nearest pixel of the row or column, as no depth map can know.
    """
    behind = np.ones_like(picture), _continued(picture, near)
    return seen_through_layers(planned, [(near.astype(float), picture), behind])


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


def seen_through_layers(planned: Plan, layers: list[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """Return the light on every pixel, (rows, columns), without field, of layers from near to far: alpha and colour.

    Their depths are those of the plan. A ray that meets a layer where its alpha is α has α of its light, and 1 − α of
    what is behind.
    """
    shape, pixel_um = layers[0][0].shape, planned.scene.sensor.pixel_um
    total, shares = np.zeros(shape), 0.0
    wave = planned.colours[0].wavelengths_um[0]
    spreads = []
    for vergence in planned.vergences[::-1]:
        seen = planned.sensor_map(vergence)
        spreads.append(ray_spread(seen.lens, seen.source(0.0, 0.0, wave)))
    for side in spreads[0].sides:
        moves = [(side * spread.x_um[EVERY] / pixel_um, spread.y_um[EVERY] / pixel_um) for spread in spreads]
        for light, *landed in zip(
            spreads[0].light[EVERY].flat, *(part.flat for pair in moves for part in pair), strict=True
        ):
            left = np.full(shape, light)
            for (alpha, colour), right, up in zip(layers, landed[::2], landed[1::2], strict=True):
                meets = left * _shifted(alpha, right, up)
                total += meets * _shifted(colour, right, up)
                left = left - meets
            shares += light
    return total / shares


def _shifted(values: np.ndarray, right: float, up: float) -> np.ndarray:
    """Return the values that rays carry ``right`` and ``up`` by pixels; beyond the edge its own."""
    rows, columns = np.indices(values.shape)
    row, column = (np.rint(at).astype(int) for at in (rows + up, columns - right))
    return values[np.clip(row, 0, len(values) - 1), np.clip(column, 0, values.shape[1] - 1)]
