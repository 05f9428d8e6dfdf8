"""A picture of two depths by what each part of the pupil sees: the nearer where its ray meets it, else the farther."""

import numpy as np

from p2sf.pixel_kernels.ray_spread import ray_spread
from p2sf.scene import Plan

EVERY = np.s_[::8, ::12]  # of the cells of the pupil


def seen_through_pupil(planned: Plan, near: np.ndarray, picture: np.ndarray) -> np.ndarray:
    """Return the light on every pixel, (rows, columns), without field: ``near`` where the nearer depth is.

    Behind it the farther one goes on as the nearest pixel of the row, as no depth map can know.
    """
    far = picture.copy()
    for row, hidden in zip(far, near, strict=True):
        open_ = np.flatnonzero(~hidden)
        row[:] = row[open_[np.abs(open_ - np.arange(row.size)[:, None]).argmin(1)]]
    total, shares, pixel_um = np.zeros(picture.shape), 0.0, planned.scene.sensor.pixel_um
    wave = planned.colours[0].wavelengths_um[0]
    spreads = []
    for vergence in planned.vergences:
        seen = planned.sensor_map(vergence)
        spreads.append(ray_spread(seen.lens, seen.source(0.0, 0.0, wave)))
    behind, before = spreads
    for side in before.sides:
        places = [(side * spread.x_um[EVERY] / pixel_um, spread.y_um[EVERY] / pixel_um) for spread in (before, behind)]
        (x, y), (far_x, far_y) = places
        for light, *moves in zip(*(part.flat for part in (before.light[EVERY], x, y, far_x, far_y)), strict=True):
            meets = _shifted(near, *moves[:2])
            total += light * np.where(meets, _shifted(picture, *moves[:2]), _shifted(far, *moves[2:]))
            shares += light
    return total / shares


def _shifted(values: np.ndarray, right: float, up: float) -> np.ndarray:
    """Return the values that rays carry ``right`` and ``up`` by pixels; beyond the edge its own."""
    rows, columns = np.indices(values.shape)
    row, column = (np.rint(at).astype(int) for at in (rows + up, columns - right))
    return values[np.clip(row, 0, len(values) - 1), np.clip(column, 0, values.shape[1] - 1)]
