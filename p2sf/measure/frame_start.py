"""Where the fit of a frame starts when no lens is known: what fits of a few single points suggest (handbook 11.3)."""

from collections.abc import Sequence
from itertools import product

import numpy as np

from p2sf.measure.frame_terms import UM_PER_DEGREE_MM, FrameModel, FramePoint
from p2sf.measure.point_fit import fit_point

SUGGESTING = 8  # points


def suggested(points: Sequence[FramePoint], model: FrameModel) -> np.ndarray:
    """Return values of a model without a lens that fits of a few single points, far apart, suggest.

    Each point's even terms may have the other sign (`PointFit.others`): those signs are taken that agree best.
    """
    chosen = _far_apart(points)
    wanted, known = [], []
    for point in chosen:
        azimuth = float(np.rad2deg(np.arctan2(point.x_mm, point.y_mm)))
        wanted.append(fit_point([point.picture], model.optics, azimuth_deg=azimuth).numbers)
        known.append(np.array([0.0, 0.0, 0.0, point.focus_um * model.focus_waves_per_um]))
    matrix = np.concatenate([_six_of_unknowns(point, model) for point in chosen])
    least, best = np.inf, np.zeros(len(model.unknowns))
    for signs in product((1.0, -1.0), repeat=len(chosen)):
        flipped = [numbers * [s, 1.0, s, s] - one for s, numbers, one in zip(signs, wanted, known, strict=True)]
        right = np.concatenate(flipped)
        values, *_ = np.linalg.lstsq(matrix, right, rcond=1e-9)
        left = float(np.linalg.norm(matrix @ values - right))
        if left < least:
            least, best = left, values
    return best


def _six_of_unknowns(point: FramePoint, model: FrameModel) -> np.ndarray:
    """Return W40, W31, W22 and W20 + Wd of a point per unit of every unknown, (4, unknowns)."""
    h = float(np.hypot(point.x_mm, point.y_mm)) / model.height_mm
    focus = model.focus_waves_per_um
    tilt = focus * UM_PER_DEGREE_MM
    made = {
        "w40": (1, 0, 0, 0),
        "w31": (0, h, 0, 0),
        "w22": (0, 0, h * h, 0),
        "w20": (0, 0, 0, h * h),
        "sensor_shift_um": (0, 0, 0, focus),
        "tilt_x_deg": (0, 0, 0, tilt * point.x_mm),
        "tilt_y_deg": (0, 0, 0, tilt * point.y_mm),
    }
    return np.array([made[name] for name in model.unknowns], float).T


def _far_apart(points: Sequence[FramePoint]) -> list[FramePoint]:
    """Return some points, each the farthest from those before it, the first nearest the axis."""
    places = np.array([(point.x_mm, point.y_mm) for point in points])
    order = [int(np.argmin(np.hypot(*places.T)))]
    away = np.hypot(*(places - places[order[0]]).T)
    while len(order) < min(SUGGESTING, len(points)):
        order.append(int(np.argmax(away)))
        away = np.minimum(away, np.hypot(*(places - places[order[-1]]).T))
    return [points[k] for k in order]
