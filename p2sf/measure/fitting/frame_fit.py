"""One set of numbers that explains all points of a frame, or of several at known focus (handbook 11.3).

Each point has its own place, light and background, which are eliminated from the normal equations (a Schur complement),
so that the few numbers of the frame are solved for alone, by Levenberg's and Marquardt's method (Moré 1978).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from math import ceil
from typing import TypeAlias

import numpy as np

from p2sf.errors import Cancelled, RequestError
from p2sf.measure.fitting.frame_terms import F_NUMBER, FOCUS, FrameModel, FramePoint, PointPupil, six_of_unknowns
from p2sf.measure.fitting.point_fit import MOST_CHI2, chi2_warning, fit_point, most_chi2
from p2sf.measure.fitting.point_model import PictureOptics, PixelSum
from p2sf.measure.fitting.point_problem import PointPicture
from p2sf.measure.fitting.pupil_nodes import has_twin
from p2sf.measure.fitting.starting_values import blur, frame_starts, landings, locate, ray_moments, significant
from p2sf.messages import Message
from p2sf.threads import for_each, map_threads, one_blas_thread

STEPS = 30
RTOL = 1e-5  # of the sum of squares in one step
FIRST_DAMPING, WEAKER, STRONGER, MOST_DAMPING = 1e-3, 0.2, 5.0, 1e8
KEPT_STOPS = 2  # of which a point's sums are kept: of the last values, and of those tried
MOST_INFLATION = 30.0  # of an error by what else is unknown
LEAST_SINGULAR = 1e-10  # of the information of unknowns in units of what each alone is known to
SHIFT, FOCUS_STEP, TRIED_POINTS = FOCUS[0], 0.25, 4  # waves of Wd from one shift tried to the next; points
START_WAVES = 0.5  # RMS, of a step of each unknown in the search
ROUNDS, TRIED, NEIGHBOURS = 3, 8, 64  # starts that are compared with the pictures: of each round, and around the best
FOLLOWED = 6  # of these, the likest, from which fits descend
SUGGESTING = 9  # points that decide where a fit starts

SET_UP, NEAR, SEARCHED = 0.4, 0.5, 0.9  # of the time: pupils are there, the first fit is done, and the search
USUAL_STEPS = 4  # in which half of a fit is done

Tell: TypeAlias = Callable[[float], None] | None
"""Told the share that is done, from 0 to 1."""

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
    def known_stop(self) -> FrameModel:
        """Return the model with lens and scale at the f-number found."""
        return self.model.at(self.values)

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
    def reliable(self) -> bool:
        """Return whether enough is explained for the values to mean anything: beyond, they may be of any minimum."""
        return self.chi2 <= MOST_CHI2

    @property
    def warnings(self) -> tuple[Message, ...]:
        """Return what a reader has to know before using the values, or why there are none."""
        if not self.reliable:
            return (
                Message(
                    "no numbers of the whole frame: what they leave is {chi2:.3g} times the variance of the noise, "
                    "and {most:g} is the most. Check f-number, wavelength, pixel, distance, focus and stated noise, "
                    "and that the picture is linear, not cropped, and of points much smaller than a pixel; or name "
                    "what else may be wrong with the lens as unknowns",
                    chi2=self.chi2,
                    most=MOST_CHI2,
                ),
            )
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
    """One point's sum over its pupil in one colour, of a stop ``ratio`` times as large as the pupil's."""

    def __init__(self, pupil: PointPupil, focus_um: float, shape: tuple[int, ...], optics: PictureOptics, ratio: float):
        self.pupil, self.ratio, self.focus_um = pupil.stopped(ratio), ratio, focus_um
        nodes = self.pupil.nodes
        self.phase = self.pupil.phase + focus_um * self.pupil.focus
        columns = [self.pupil.terms, -nodes.fx[None], -nodes.fy[None]]
        if pupil.series is not None:
            by_stop = pupil.by_stop(ratio)
            self.by_stop = by_stop[0] + focus_um * by_stop[1], by_stop[2:]
            columns += [np.zeros_like(self.phase)[None], pupil.nodes.fx[None], pupil.nodes.fy[None]]
        self.columns = np.concatenate(columns).astype(np.float32)
        scaled = replace(optics, na=ratio * optics.na)
        self.sum = PixelSum(nodes, (shape[0], shape[1]), scaled, optics.parts)

    def phase_at(self, values: np.ndarray, x: float, y: float) -> np.ndarray:
        """Return W at the nodes, waves, with the tilt that puts the chief ray at x and y."""
        nodes = self.pupil.nodes
        phase: np.ndarray = self.phase + values @ self.pupil.terms - (nodes.fx * x + nodes.fy * y)
        return phase

    def light(self, values: np.ndarray, x: float, y: float) -> np.ndarray:
        """Return the share of all light on each pixel, (y, x)."""
        return self.sum.light(self.phase_at(values, x, y))

    def light_and_slopes(self, values: np.ndarray, x: float, y: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the light, its derivatives by unknowns, x and y, (unknowns + 2, y, x), and by the stop's ratio.

        A wider stop changes the phase at its nodes, and directions: a map's number, times how far light lands.
        """
        if self.pupil.series is None:
            return *self.sum.light_and_slopes(self.phase_at(values, x, y), self.columns), np.zeros(())
        phase, terms = self.by_stop
        self.columns[-3] = phase + values @ terms
        light, slopes = self.sum.light_and_slopes(self.phase_at(values, x, y), self.columns, (1, 1), (x, y))
        return light, slopes[:-3], slopes[-3:].sum(0) + 2 / self.ratio * light


class PointSum:
    """One point's residuals over the noise and their derivatives by the frame's unknowns and by its own four."""

    def __init__(self, point: FramePoint, model: FrameModel):
        picture = point.picture
        self.good = picture.usable
        self.data = np.where(self.good, picture.values, 0.0)
        self.root = np.where(self.good, 1 / np.sqrt(np.broadcast_to(picture.variance, self.data.shape)), 0.0)
        self.half_um = max(self.data.shape) / 2 * model.optics.pixel_um
        self.focus_um, self.model = point.focus_um, model
        self.pupils = model.pupils(point.x_mm, point.y_mm, self.half_um)
        self.pupil, self._stopped = self.pupils[0], dict[float, list[_Colour]]()

    def colours(self, values: np.ndarray) -> list[_Colour]:
        """Return the sums in every colour for the stop of these values; the last ones are kept."""
        ratio = self.model.stop_radius(values)
        if ratio not in self._stopped:
            while len(self._stopped) >= KEPT_STOPS:
                del self._stopped[next(iter(self._stopped))]
            shape = self.data.shape
            self._stopped[ratio] = [
                _Colour(pupil, self.focus_um, shape, optics, ratio)
                for pupil, optics in zip(self.pupils, self.model.near_optics.colours, strict=True)
            ]
        return self._stopped[ratio]

    def light(self, values: np.ndarray, x: float, y: float) -> np.ndarray:
        """Return the share of all light on each pixel, (y, x)."""
        pairs = zip(self.model.optics.shares, self.colours(values), strict=True)
        light: np.ndarray = sum((share * one.light(values, x, y) for share, one in pairs), np.zeros(()))
        return light

    def light_and_slopes(self, values: np.ndarray, x: float, y: float) -> tuple[np.ndarray, np.ndarray]:
        """Return the light and its derivatives by the unknowns, x and y, (unknowns + 2, y, x)."""
        light, slopes, widened = np.zeros(()), np.zeros(()), np.zeros(())
        for share, one in zip(self.model.optics.shares, self.colours(values), strict=True):
            found, moved, wider = one.light_and_slopes(values, x, y)
            light, slopes, widened = light + share * found, slopes + share * moved, widened + share * wider
        if F_NUMBER in self.model.unknowns:
            slopes[self.model.unknowns.index(F_NUMBER)] = widened * self.model.stop_slope(values)
        return light, slopes

    def landed_um(self, values: np.ndarray) -> np.ndarray:
        """Return how far the chief ray is moved by errors of the lens, (2,)."""
        still, slopes = self.pupil.landing_um
        landed: np.ndarray = still + values @ slopes
        return landed

    def start(self, point: FramePoint, model: FrameModel, values: np.ndarray) -> np.ndarray:
        """Return x, y, light and background to start from: where the centroids of picture and model agree."""
        found = locate(point.picture, model.optics)
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

    @cached_property
    def rays(self) -> tuple[np.ndarray, np.ndarray]:
        """Return where rays of all colours land (`landings`), and the weight of each one's light."""
        every, weights = [], []
        none = np.zeros(len(self.model.unknowns))
        for share, one in zip(self.model.optics.shares, self.colours(none), strict=True):
            nodes, waves = one.pupil.nodes, np.concatenate([one.phase[None], one.pupil.terms])
            every.append(landings(waves, nodes.fx, nodes.fy, nodes.weight))
            weights.append(share * nodes.weight)
        return np.concatenate(every, axis=1), np.concatenate(weights)

    def moments(self, flux: float, model: FrameModel, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the moments of rays as forms (`ray_moments`), and those of light less those of rays, (3,) µm².

        Of light and rays under ``values`` where light of so much ``flux`` exceeds the noise: what is fainter is no part
        of the moments seen.
        """
        light, (rays, weight), whole = flux * self.light(values, 0.0, 0.0), self.rays, np.append(1.0, values)
        columns, rows = (
            np.rint(place / model.optics.pixel_um).astype(int) + n // 2
            for place, n in zip(rays @ whole, light.shape[::-1], strict=True)
        )
        inside = (rows >= 0) & (rows < light.shape[0]) & (columns >= 0) & (columns < light.shape[1])
        bright = significant(light, 1 / np.maximum(self.root, self.root.max() * 1e-3))
        kept = inside & bright[rows * inside, columns * inside]
        forms = ray_moments(rays, np.where(kept if kept.any() else True, weight, 0.0))
        variance = np.where(self.good, self.root, np.inf) ** -2.0
        found = locate(PointPicture(light, variance, good=self.good), model.optics)
        return forms, found.moments_um2 - np.einsum("cij,i,j->c", forms, whole, whole)

    def unlikeness(self, point: FramePoint, model: FrameModel, values: np.ndarray) -> float:
        """Return the sum of squares over the noise, light a little blurred, with place, light and background fitted."""
        light = self.light(values, *self.start(point, model, values)[:2])
        columns = np.stack([blur(light * self.root).ravel(), blur(self.root).ravel()], 1)
        wanted = blur(self.data * self.root).ravel()
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


def share_of(progress: Tell, low: float, high: float) -> Tell:
    """Return what tells ``progress`` of a part of the work, from ``low`` to ``high`` of the whole."""
    return None if progress is None else lambda done: progress(low + (high - low) * done)


@one_blas_thread
def fit_frame(
    points: Sequence[FramePoint],
    model: FrameModel,
    start: np.ndarray | None = None,
    progress: Tell = None,
    cancelled: Callable[[], bool] | None = None,
) -> FrameFit:
    """Return the numbers of the model that explain all points together.

    ``start``: of the unknowns; when not given, those of the lens as designed at the sensor's most likely place and, if
    these lead to nothing that explains the points, those under which points are as wide as seen; without a lens those
    that fits of single points suggest. Raises RequestError for no points.
    """
    if not points:
        raise RequestError("there is no usable point in the frame; look at what its points are flagged for")
    sums = _set_up(points, model, share_of(progress, 0.0, SET_UP), cancelled)
    if start is not None or model.lens is None:
        guess = _start_from_points(points, model) if start is None else start
        return _descend(points, model, sums, guess, STEPS, share_of(progress, SET_UP, 1.0), cancelled)
    first = _start_in_focus(sums, points, model)
    near = _descend(points, model, sums, first, STEPS, share_of(progress, SET_UP, NEAR), cancelled)
    if near.explains:
        return near
    found = _search(points, model, sums, share_of(progress, NEAR, 1.0), cancelled)
    return min(near, found, key=lambda one: one.chi2)


def _set_up(
    points: Sequence[FramePoint], model: FrameModel, progress: Tell, cancelled: Callable[[], bool] | None
) -> list[PointSum]:
    """Return the sums of every point. Raises Cancelled."""
    sums: list[PointSum] = []

    def take(one: PointSum) -> None:
        sums.append(one)
        _go_on(cancelled)
        if progress:
            progress(len(sums) / len(points))

    for_each(lambda point: PointSum(point, model), points, take)
    return sums


def _go_on(cancelled: Callable[[], bool] | None) -> None:
    if cancelled and cancelled():
        raise Cancelled("the fit was cancelled before it was done")


def _parts(sums: Sequence[PointSum], values: np.ndarray, own: np.ndarray) -> list[Part]:
    return map_threads(lambda pair: pair[0].residuals(values, pair[1]), zip(sums, own, strict=True))


def _descend(
    points: Sequence[FramePoint],
    model: FrameModel,
    sums: Sequence[PointSum],
    start: np.ndarray,
    steps: int,
    progress: Tell,
    cancelled: Callable[[], bool] | None,
) -> FrameFit:
    """Return the minimum that is reached from these values in so many steps at most."""
    values = np.array(start, float)
    own = np.array([one.start(point, model, values) for one, point in zip(sums, points, strict=True)])
    parts = _parts(sums, values, own)
    cost, damping = _cost(parts, model.prior, values), FIRST_DAMPING
    for step in range(steps):
        _go_on(cancelled)
        if progress:
            progress(step / (step + USUAL_STEPS))
        while damping < MOST_DAMPING:
            change, moves = _step(parts, damping, model.prior, values)
            new_values, new_own = values + change, own + moves
            tried = _parts(sums, new_values, new_own)
            lower = _cost(tried, model.prior, new_values)
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


def _start_in_focus(sums: Sequence[PointSum], points: Sequence[FramePoint], model: FrameModel) -> np.ndarray:
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
    left = map_threads(lambda pair: [pair[0].unlikeness(pair[1], model, trial) for trial in trials], some)
    best: np.ndarray = trials[int(np.argmin(np.sum(left, axis=0)))]
    return best


class _Search:
    """Where fits of a frame start: values under which points are as wide as seen, and the neighbours of these."""

    def __init__(
        self,
        sums: Sequence[PointSum],
        points: Sequence[FramePoint],
        model: FrameModel,
        cancelled: Callable[[], bool] | None,
    ):
        self.sums, self.points, self.model, self.cancelled = sums, points, model, cancelled
        self.seen = [locate(point.picture, model.optics) for point in points]
        blur = np.maximum(np.max([one.blur_per_unit for one in sums], axis=0), 1e-12)
        self.scale = np.where(model.prior > 0, 1 / np.sqrt(np.maximum(model.prior, 1e-12)), START_WAVES / blur)
        self.tried: list[tuple[float, np.ndarray]] = []

    def add(self, every: np.ndarray) -> None:
        """Compare the pictures under some values with those seen. Raises Cancelled."""

        def unlikeness(pair: tuple[PointSum, FramePoint]) -> list[float]:
            _go_on(self.cancelled)
            return [pair[0].unlikeness(pair[1], self.model, values) for values in every]

        left = np.sum(map_threads(unlikeness, zip(self.sums, self.points, strict=True)), axis=0)
        self.tried += zip(left.tolist(), every, strict=True)
        self.tried.sort(key=lambda pair: pair[0])

    def by_moments(self) -> None:
        """Try values under which points are as wide as seen, in rounds: how light and rays differ depends on them."""
        best, wide = np.zeros(self.scale.size), np.array([one.moments_um2 for one in self.seen])
        for _ in range(ROUNDS):
            pairs = zip(self.sums, self.seen, strict=True)
            forms, beyond = zip(*(one.moments(found.flux, self.model, best) for one, found in pairs), strict=True)
            self.add(frame_starts(np.array(forms), wide, np.array(beyond), self.scale)[:TRIED])
            best = self.tried[0][1]

    def by_neighbours(self, around: np.ndarray) -> None:
        """Try values that differ from these by about a step of each unknown."""
        self.add(around + np.random.default_rng(0).normal(size=(NEIGHBOURS, self.scale.size)) * self.scale)

    def taken(self, count: int) -> list[np.ndarray]:
        """Return the likest values, and forget all."""
        best, self.tried = self.tried[:count], []
        return [values for _, values in best]


def _search(
    points: Sequence[FramePoint],
    model: FrameModel,
    sums: Sequence[PointSum],
    progress: Tell,
    cancelled: Callable[[], bool] | None,
) -> FrameFit:
    """Return the deepest minimum found from starts of a model with a lens; some points far apart decide which it is."""
    places = {(points[k].x_mm, points[k].y_mm) for k in _far_apart(points)}
    some = [k for k, point in enumerate(points) if (point.x_mm, point.y_mm) in places]
    chosen, few = [points[k] for k in some], [sums[k] for k in some]
    search = _Search(few, chosen, model, cancelled)
    search.by_moments()
    half = SEARCHED / 2
    best = _deepest(search, None, share_of(progress, 0.0, half))
    if not (best.explains or (best.reliable and model.errors)):  # errors of the lens are linear only near what is found
        search.by_neighbours(best.values)
        best = _deepest(search, best, share_of(progress, half, SEARCHED))
    if len(some) == len(points):
        return best
    return _descend(points, model, sums, best.values, STEPS, share_of(progress, SEARCHED, 1.0), cancelled)


def _deepest(search: _Search, best: FrameFit | None, progress: Tell) -> FrameFit:
    """Return the deepest of minima that the likest starts lead to and ``best``, the first that explains the points."""
    for count, start in enumerate(search.taken(FOLLOWED)):
        if progress:
            progress(count / FOLLOWED)
        found = _descend(search.points, search.model, search.sums, start, STEPS, None, search.cancelled)
        if best is None or found.chi2 < best.chi2:
            best = found
        if best.explains or (best.reliable and search.model.errors):
            break
    assert best is not None
    return best


def _start_from_points(points: Sequence[FramePoint], model: FrameModel) -> np.ndarray:
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


def _cost(parts: Sequence[Part], prior: np.ndarray, values: np.ndarray) -> float:
    """Return the sum of squares over the noise, and over the variance of what is known beforehand."""
    return float(sum(rest @ rest for rest, _, _ in parts) + prior @ values**2)


def _normal(part: Part, damping: float) -> tuple[np.ndarray, ...]:
    """Return (shared, mixed, own inverse, shared gradient, own gradient) of one point's normal equations."""
    rest, shared, own = part
    inside = own.T @ own
    inside[np.diag_indices(4)] *= 1 + damping
    return shared.T @ shared, shared.T @ own, np.linalg.inv(inside), shared.T @ rest, own.T @ rest


def _step(
    parts: Sequence[Part], damping: float, prior: np.ndarray, values: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the change of the frame's values and of every point's own, (points, 4)."""
    normals = [_normal(part, damping) for part in parts]
    reduced = sum((a - b @ c @ b.T for a, b, c, _, _ in normals), np.diag(prior))
    gradient = sum((g - b @ c @ h for _, b, c, g, h in normals), prior * values)
    matrix = reduced + damping * np.diag(np.diag(sum((a for a, *_ in normals), np.diag(prior))))
    scale = 1 / np.sqrt(np.maximum(np.diag(matrix), 1e-300))
    change = -scale * np.linalg.lstsq(scale[:, None] * matrix * scale, scale * gradient, rcond=1e-12)[0]
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
    information = sum((a - b @ c @ b.T for a, b, c, _, _ in normals), np.diag(model.prior))
    modelled = tuple(
        mine[2] * one.light(values, mine[0], mine[1]) + mine[3] for one, mine in zip(sums, own, strict=True)
    )
    landed = np.array([one.landed_um(values) for one in sums])
    freedom = [max(1, int(one.good.sum()) - 4) for one in sums]
    squares = np.array([rest @ rest for rest, _, _ in parts])
    r2 = np.array([_r2(one, light) for one, light in zip(sums, modelled, strict=True)])
    all_chi2 = float(squares.sum()) / max(1, sum(freedom) - values.size)
    one_focus = model.lens is None and not any(point.focus_um for point in points) and has_twin(model.optics.mask)
    odd = np.array([name in ("w31", F_NUMBER) for name in model.unknowns])
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
