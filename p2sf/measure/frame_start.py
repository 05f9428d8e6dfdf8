"""Where the fit of a frame starts when no lens is known: what fits of a few single points suggest (handbook 11.3)."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from p2sf.measure.frame_terms import UM_PER_DEGREE_MM, FrameModel, FramePoint
from p2sf.measure.point_fit import fit_point
from p2sf.measure.pupil_nodes import has_twin

SUGGESTING = 8  # points


def suggested(points: Sequence[FramePoint], model: FrameModel) -> np.ndarray:
    """Return values of a model without a lens that fits of a few single points, far apart, suggest.

    Pictures of one point at several focus positions are fitted together. At one focus, each point's even terms may have
    the other sign (`PointFit.others`): those signs are taken that agree best.
    """
    places: dict[tuple[float, float], list[FramePoint]] = {}
    for point in points:
        places.setdefault((point.x_mm, point.y_mm), []).append(point)
    chosen = _far_apart([group[0] for group in places.values()])
    wanted, several = [], False
    for x, y in ((point.x_mm, point.y_mm) for point in chosen):
        pictures = [
            replace(point.picture, defocus_waves=point.focus_um * model.focus_waves_per_um) for point in places[x, y]
        ]
        several = several or len(pictures) > 1
        wanted.append(fit_point(pictures, model.optics, azimuth_deg=float(np.rad2deg(np.arctan2(x, y)))).numbers)
    matrix = np.concatenate([six_of_unknowns(point.x_mm, point.y_mm, model) for point in chosen])
    least, best = np.inf, np.zeros(len(model.unknowns))
    open_sign = not several and has_twin(model.optics.mask)
    for signs in product((1.0, -1.0) if open_sign else (1.0,), repeat=len(chosen)):
        right = np.concatenate([numbers * [s, 1.0, s, s] for s, numbers in zip(signs, wanted, strict=True)])
        values, *_ = np.linalg.lstsq(matrix, right, rcond=1e-9)
        left = float(np.linalg.norm(matrix @ values - right))
        if left < least:
            least, best = left, values
    return best


def six_of_unknowns(x_mm: float, y_mm: float, model: FrameModel) -> np.ndarray:
    """Return W40, W31, W22 and W20 + Wd of a point per unit of every unknown, (4, unknowns); 0 for a spacing."""
    h = float(np.hypot(x_mm, y_mm)) / model.height_mm
    focus = model.focus_waves_per_um
    tilt = focus * UM_PER_DEGREE_MM
    made = {
        "w40": (1, 0, 0, 0),
        "w31": (0, h, 0, 0),
        "w22": (0, 0, h * h, 0),
        "w20": (0, 0, 0, h * h),
        "sensor_shift_um": (0, 0, 0, focus),
        "tilt_x_deg": (0, 0, 0, tilt * x_mm),
        "tilt_y_deg": (0, 0, 0, tilt * y_mm),
    }
    return np.array([made.get(name, (0, 0, 0, 0)) for name in model.unknowns], float).T


def _far_apart(points: Sequence[FramePoint]) -> list[FramePoint]:
    """Return some points, each the farthest from those before it, the first nearest the axis."""
    places = np.array([(point.x_mm, point.y_mm) for point in points])
    order = [int(np.argmin(np.hypot(*places.T)))]
    away = np.hypot(*(places - places[order[0]]).T)
    while len(order) < min(SUGGESTING, len(points)):
        order.append(int(np.argmax(away)))
        away = np.minimum(away, np.hypot(*(places - places[order[-1]]).T))
    return [points[k] for k in order]
