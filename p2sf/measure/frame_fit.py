"""One set of numbers that explains all points of a frame, or of several at known focus (handbook 11.3).

Each point has its own place, light and background, which are eliminated from the normal equations (a Schur complement),
so that the few numbers of the frame are solved for alone, by Levenberg's and Marquardt's method (Moré 1978).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import ceil
from typing import TypeAlias

import numpy as np

from p2sf.errors import Cancelled, RequestError
from p2sf.measure.frame_terms import FOCUS, FrameModel, FramePoint, PointPupil, six_of_unknowns
from p2sf.measure.point_fit import chi2_warning, fit_point, most_chi2
from p2sf.measure.point_model import Optics, PixelSum
from p2sf.measure.pupil_nodes import has_twin
from p2sf.measure.starting_values import seen
from p2sf.messages import Message
from p2sf.threads import one_blas_thread

STEPS = 30
RTOL = 1e-5  # of the sum of squares in one step
FIRST_DAMPING, WEAKER, STRONGER, MOST_DAMPING = 1e-3, 0.2, 5.0, 1e8
MOST_INFLATION = 30.0  # of an error by what else is unknown
LEAST_SINGULAR = 1e-10  # of the information of unknowns in units of what each alone is known to
SHIFT, FOCUS_STEP, TRIED_POINTS = FOCUS[0], 0.25, 4  # waves of Wd from one shift tried to the next; points
TRIED, TRIED_WAVES = 64, 0.5  # starts, where the lens as designed is too far away
FOLLOWED, FEW_STEPS = 4, 8
SUGGESTING = 8  # points whose single fits suggest where a fit without a lens starts

Part: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Residuals of a point, their derivatives by the frame's unknowns, and by the point's own."""


@dataclass(frozen=True, eq=False)
class FrameFit:
    """What explains a frame.

    Attributes
    ----------
    model : FrameModel
        Its unknowns and the lens.
    values, covariance
        Of the model's unknowns, for the stated noise.
    frames : numpy.ndarray
        x and y in µm from the window's middle pixel, light and background of every point, (points, 4).
    landed_um : numpy.ndarray
        How far errors of the lens move every point's chief ray, x and y in µm, (points, 2).
    modelled : tuple of numpy.ndarray
        The windows as fitted.
    r2, chi2s : numpy.ndarray
        Of every point, (points,); chi2 is reduced.
    chi2 : float
        Of all points together.
    twin : numpy.ndarray or None
        Values that explain the frame as well; None with a lens, or frames at several focus positions.
    """

    model: FrameModel
    points: tuple[FramePoint, ...]
    values: np.ndarray
    covariance: np.ndarray
    frames: np.ndarray
    landed_um: np.ndarray
    modelled: tuple[np.ndarray, ...]
    r2: np.ndarray
    chi2s: np.ndarray
    chi2: float
    twin: np.ndarray | None = None

    @property
    def bounds(self) -> np.ndarray:
        """Return the Cramér–Rao bound of each value for the stated noise."""
        deviation: np.ndarray = np.sqrt(np.diag(self.covariance))
        return deviation

    @property
    def inflation(self) -> np.ndarray:
        """Return by how much each error exceeds what it would be if all other unknowns were known, (unknowns,)."""
        alone = np.diag(np.linalg.inv(self.covariance))
        ratio: np.ndarray = np.sqrt(np.maximum(np.diag(self.covariance) * alone, 1.0))
        return ratio

    @property
    def freedom(self) -> int:
        """Return how many more pixels count than there are unknowns."""
        usable = sum(int(point.picture.usable.sum()) for point in self.points)
        return max(1, usable - self.frames.size - self.values.size)

    @property
    def explains(self) -> bool:
        """Return whether the model leaves no more than the noise."""
        return self.chi2 <= most_chi2(self.freedom)

    @property
    def warnings(self) -> tuple[Message, ...]:
        """Return what a reader has to know before using the values."""
        out = chi2_warning(self.chi2, self.freedom)
        alike = tuple(
            name for name, ratio in zip(self.model.unknowns, self.inflation, strict=True) if ratio > MOST_INFLATION
        )
        if alike:
            told = Message(
                "{names}: the picture determines only a combination of these, hardly each of them; leave one out",
                names=alike,
            )
            out = (*out, told)
        return out

    @property
    def errors(self) -> np.ndarray:
        """Return one standard deviation of each value: the bound, enlarged where the rest exceeds the noise."""
        enlarged: np.ndarray = self.bounds * max(1.0, self.chi2) ** 0.5
        return enlarged


class _Colour:
    """One point's sum over its pupil in one colour."""

    def __init__(self, pupil: PointPupil, focus_um: float, shape: tuple[int, ...], optics: Optics):
        self.pupil, nodes = pupil, pupil.nodes
        self.phase = pupil.phase + focus_um * pupil.focus
        self.columns = np.concatenate([pupil.terms, -nodes.fx[None], -nodes.fy[None]]).astype(np.float32)
        self.sum = PixelSum(nodes, (shape[0], shape[1]), optics)

    def phase_at(self, values: np.ndarray, x: float, y: float) -> np.ndarray:
        """Return W at the nodes, waves, with the tilt that puts the chief ray at x and y."""
        nodes = self.pupil.nodes
        phase: np.ndarray = self.phase + values @ self.pupil.terms - (nodes.fx * x + nodes.fy * y)
        return phase


class PointSum:
    """One point's residuals over the noise and their derivatives by the frame's unknowns and by its own four."""

    def __init__(self, point: FramePoint, model: FrameModel):
        picture = point.picture
        self.good = picture.usable
        self.data = np.where(self.good, picture.values, 0.0)
        self.root = np.where(self.good, 1 / np.sqrt(np.broadcast_to(picture.variance, self.data.shape)), 0.0)
        self.half_um = max(self.data.shape) / 2 * model.optics.pixel_um
        self.colours = [
            (share, _Colour(pupil, point.focus_um, self.data.shape, optics))
            for share, pupil, optics in zip(
                model.optics.shares,
                model.pupils(point.x_mm, point.y_mm, self.half_um),
                model.optics.colours,
                strict=True,
            )
        ]
        self.pupil = self.colours[0][1].pupil

    def light(self, values: np.ndarray, x: float, y: float) -> np.ndarray:
        """Return the share of all light on each pixel, (y, x)."""
        light: np.ndarray = sum(
            (share * one.sum.light(one.phase_at(values, x, y)) for share, one in self.colours), np.zeros(())
        )
        return light

    def light_and_slopes(self, values: np.ndarray, x: float, y: float) -> tuple[np.ndarray, np.ndarray]:
        """Return the light and its derivatives by the unknowns, x and y, (unknowns + 2, y, x)."""
        light: np.ndarray | float = 0.0
        slopes: np.ndarray | float = 0.0
        for share, one in self.colours:
            found, moved = one.sum.light_and_slopes(one.phase_at(values, x, y), one.columns)
            light, slopes = light + share * found, slopes + share * moved
        return np.asarray(light), np.asarray(slopes)

    def landed_um(self, values: np.ndarray) -> np.ndarray:
        """Return how far the chief ray is moved by errors of the lens, (2,)."""
        still, slopes = self.pupil.landing_um
        landed: np.ndarray = still + values @ slopes
        return landed

    def start(self, point: FramePoint, model: FrameModel, values: np.ndarray) -> np.ndarray:
        """Return x, y, light and background to start from: where the centroids of picture and model agree."""
        found = seen(point.picture, model.optics)
        light = self.light(values, 0.0, 0.0)
        across, up = ((np.arange(n) - n // 2) * model.optics.pixel_um for n in light.shape[::-1])
        total = light.sum()
        x, y = found.x - light.sum(0) @ across / total, found.y - light.sum(1) @ up / total
        return np.array([x, y, found.flux, found.background])

    @property
    def blur_per_unit(self) -> np.ndarray:
        """Return the RMS wavefront, waves, that each unknown adds per unit, beside piston and tilts, (unknowns,)."""
        nodes = self.pupil.nodes
        root = np.sqrt(np.abs(nodes.weight))
        planes = np.stack([np.ones_like(nodes.fx), nodes.fx, nodes.fy]) * root
        terms = (self.pupil.terms * root).T
        rest = terms - planes.T @ np.linalg.lstsq(planes.T, terms, rcond=None)[0]
        blur: np.ndarray = np.sqrt(np.sum(rest**2, axis=0))
        return blur

    def unlikeness(self, point: FramePoint, model: FrameModel, values: np.ndarray) -> float:
        """Return the sum of squares over the noise that these values leave, place, light and background fitted."""
        light = self.light(values, *self.start(point, model, values)[:2])
        columns = np.stack([(light * self.root).ravel(), self.root.ravel()], 1)
        wanted = (self.data * self.root).ravel()
        rest = wanted - columns @ np.linalg.lstsq(columns, wanted, rcond=None)[0]
        return float(rest @ rest)

    def residuals(self, values: np.ndarray, own: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return residuals (pixels,), and their derivatives by the frame's unknowns and by x, y, light, background."""
        x, y, flux, background = own
        light, slopes = self.light_and_slopes(values, x, y)
        rest = ((flux * light + background - self.data) * self.root).ravel()
        moved = (flux * slopes * self.root).reshape(len(slopes), -1).T
        count = values.size
        local = np.column_stack([moved[:, count:], (light * self.root).ravel(), self.root.ravel()])
        return rest, moved[:, :count], local


@one_blas_thread
def fit_frame(
    points: Sequence[FramePoint],
    model: FrameModel,
    start: np.ndarray | None = None,
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> FrameFit:
    """Return the numbers of the model that explain all points together.

    ``start``: of the unknowns; when not given, those of the lens as designed at the sensor's most likely place, or
    without a lens those that fits of single points suggest. Raises RequestError for no points.
    """
    if not points:
        raise RequestError("there is no usable point in the frame; look at what its points are flagged for")
    sums = [PointSum(point, model) for point in points]
    guess = start
    if guess is None:
        guess = _focused(sums, points, model) if model.lens is not None else _suggested(points, model)
    found = _descended(points, model, sums, guess, STEPS, progress, cancelled)
    if start is not None or model.lens is None or found.explains:
        return found
    other = _elsewhere(sums, points, model, guess, cancelled)
    again = _descended(points, model, sums, other, STEPS, None, cancelled)
    return min(found, again, key=lambda one: one.chi2)


def _descended(
    points: Sequence[FramePoint],
    model: FrameModel,
    sums: Sequence[PointSum],
    start: np.ndarray,
    steps: int,
    progress: Callable[[float], None] | None,
    cancelled: Callable[[], bool] | None,
) -> FrameFit:
    """Return the minimum that is reached from these values in so many steps at most."""
    values = np.array(start, float)
    own = np.array([one.start(point, model, values) for one, point in zip(sums, points, strict=True)])
    parts = [one.residuals(values, mine) for one, mine in zip(sums, own, strict=True)]
    cost, damping = _cost(parts), FIRST_DAMPING
    for step in range(steps):
        if cancelled and cancelled():
            raise Cancelled("the fit was cancelled before it was done")
        if progress:
            progress(min(0.95, step / 8))
        while damping < MOST_DAMPING:
            change, moves = _step(parts, damping)
            new_values, new_own = values + change, own + moves
            tried = [one.residuals(new_values, mine) for one, mine in zip(sums, new_own, strict=True)]
            lower = _cost(tried)
            if lower < cost:
                break
            damping *= STRONGER
        else:
            break
        gain, values, own, parts, cost = cost - lower, new_values, new_own, tried, lower
        damping *= WEAKER
        if gain < RTOL * cost:
            break
    return _result(points, model, sums, values, own, parts)


def _focused(sums: Sequence[PointSum], points: Sequence[FramePoint], model: FrameModel) -> np.ndarray:
    """Return values of a model with a lens: 0, but for the sensor's shift that makes some points most alike.

    From the lens as designed, the least sum of squares is a mere half wave of defocus away from another minimum.
    """
    values = np.zeros(len(model.unknowns))
    if SHIFT not in model.unknowns:
        return values
    place, waves = model.unknowns.index(SHIFT), 1 / model.focus_waves_per_um
    # Beyond, light of a point without aberrations lands outside its window, 2·Wd·λ/NA from the middle.
    most = min(one.half_um for one in sums) * model.optics.cycles / 2
    shifts = FOCUS_STEP * waves * np.arange(-ceil(most / FOCUS_STEP), ceil(most / FOCUS_STEP) + 1)
    some = [(sums[k], points[k]) for k in _far_apart(points)[:TRIED_POINTS]]
    trials = np.repeat(values[None], shifts.size, 0)
    trials[:, place] = shifts
    left = [sum(one.unlikeness(point, model, trial) for one, point in some) for trial in trials]
    best: np.ndarray = trials[int(np.argmin(left))]
    return best


def _elsewhere(
    sums: Sequence[PointSum],
    points: Sequence[FramePoint],
    model: FrameModel,
    near: np.ndarray,
    cancelled: Callable[[], bool] | None,
) -> np.ndarray:
    """Return values to start from where those ``near`` the answer are not near enough: of many, what explains most.

    They are drawn so that each unknown changes the wavefront by `TRIED_WAVES` RMS. Some points far apart decide.
    """
    places = {(points[k].x_mm, points[k].y_mm) for k in _far_apart(points)}
    some = [k for k, point in enumerate(points) if (point.x_mm, point.y_mm) in places]
    chosen, few = [points[k] for k in some], [sums[k] for k in some]
    scale = TRIED_WAVES / np.maximum(np.max([one.blur_per_unit for one in few], axis=0), 1e-12)
    tried = near + np.random.default_rng(0).normal(size=(TRIED, scale.size)) * scale
    costs = []
    for values in tried:
        if cancelled and cancelled():
            raise Cancelled("the fit was cancelled before it was done")
        costs.append(sum(one.unlikeness(point, model, values) for one, point in zip(few, chosen, strict=True)))
    best = np.argsort(costs)[:FOLLOWED]
    ends = [_descended(chosen, model, few, tried[k], FEW_STEPS, None, cancelled) for k in best]
    return min(ends, key=lambda one: one.chi2).values


def _suggested(points: Sequence[FramePoint], model: FrameModel) -> np.ndarray:
    """Return values of a model without a lens that fits of a few single points, far apart, suggest.

    Pictures of one point at several focus positions are fitted together. At one focus, each point's even terms may have
    the other sign (`PointFit.others`): those signs are taken that agree best.
    """
    places: dict[tuple[float, float], list[FramePoint]] = {}
    for point in points:
        places.setdefault((point.x_mm, point.y_mm), []).append(point)
    firsts = [group[0] for group in places.values()]
    chosen = [firsts[k] for k in _far_apart(firsts)]
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


def _far_apart(points: Sequence[FramePoint]) -> list[int]:
    """Return which points are far apart: each the farthest from those before it, the first nearest the axis."""
    places = np.array([(point.x_mm, point.y_mm) for point in points])
    order = [int(np.argmin(np.hypot(*places.T)))]
    away = np.hypot(*(places - places[order[0]]).T)
    while len(order) < min(SUGGESTING, len(points)):
        order.append(int(np.argmax(away)))
        away = np.minimum(away, np.hypot(*(places - places[order[-1]]).T))
    return order


def _cost(parts: Sequence[Part]) -> float:
    return float(sum(rest @ rest for rest, _, _ in parts))


def _normal(part: Part, damping: float) -> tuple[np.ndarray, ...]:
    """Return (shared, mixed, own inverse, shared gradient, own gradient) of one point's normal equations."""
    rest, shared, own = part
    inside = own.T @ own
    inside[np.diag_indices(4)] *= 1 + damping
    return shared.T @ shared, shared.T @ own, np.linalg.inv(inside), shared.T @ rest, own.T @ rest


def _step(parts: Sequence[Part], damping: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the change of the frame's values and of every point's own, (points, 4)."""
    normals = [_normal(part, damping) for part in parts]
    reduced = sum(a - b @ c @ b.T for a, b, c, _, _ in normals)
    gradient = sum(g - b @ c @ h for _, b, c, g, h in normals)
    matrix = np.asarray(reduced) + damping * np.diag(np.diag(np.asarray(sum(a for a, *_ in normals))))
    scale = 1 / np.sqrt(np.maximum(np.diag(matrix), 1e-300))
    change = -scale * np.linalg.lstsq(scale[:, None] * matrix * scale, scale * np.asarray(gradient), rcond=1e-12)[0]
    moves = np.array([-c @ (h + b.T @ change) for _, b, c, _, h in normals])
    return change, moves


def _result(
    points: Sequence[FramePoint],
    model: FrameModel,
    sums: Sequence[PointSum],
    values: np.ndarray,
    own: np.ndarray,
    parts: Sequence[Part],
) -> FrameFit:
    normals = [_normal(part, 0.0) for part in parts]
    information = np.asarray(sum(a - b @ c @ b.T for a, b, c, _, _ in normals))
    modelled = tuple(
        mine[2] * one.light(values, mine[0], mine[1]) + mine[3] for one, mine in zip(sums, own, strict=True)
    )
    landed = np.array([one.landed_um(values) for one in sums])
    freedom = [max(1, int(one.good.sum()) - 4) for one in sums]
    squares = np.array([rest @ rest for rest, _, _ in parts])
    r2 = np.array([_r2(one, light) for one, light in zip(sums, modelled, strict=True)])
    all_chi2 = float(squares.sum()) / max(1, sum(freedom) - values.size)
    one_focus = model.lens is None and not any(point.focus_um for point in points) and has_twin(model.optics.mask)
    odd = np.array([name == "w31" for name in model.unknowns])
    twin = np.where(odd, values, -values) if one_focus else None
    chi2s = squares / np.array(freedom)
    return FrameFit(
        model, tuple(points), values, _inverse(information), own, landed, modelled, r2, chi2s, all_chi2, twin
    )


def _inverse(information: np.ndarray) -> np.ndarray:
    """Return the covariance of what has this information; what is not determined at all gets a huge variance."""
    scale = 1 / np.sqrt(np.maximum(np.diag(information), 1e-300))
    values, axes = np.linalg.eigh(scale[:, None] * information * scale)
    inverse = axes / np.sqrt(np.maximum(values, LEAST_SINGULAR))
    covariance: np.ndarray = scale[:, None] * (inverse @ inverse.T) * scale
    return covariance


def _r2(one: PointSum, light: np.ndarray) -> float:
    inside = one.data[one.good]
    return float(1 - np.sum((inside - light[one.good]) ** 2) / np.sum((inside - inside.mean()) ** 2))
