"""The wavefront that explains pictures of one point, by least squares from several starting values (handbook 11.2)."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from p2sf.errors import RequestError
from p2sf.measure.fitting.lens_pupil import DesignedPupil
from p2sf.measure.fitting.point_model import PictureOptics
from p2sf.measure.fitting.point_problem import PER_FRAME, PointPicture, Problem
from p2sf.measure.fitting.pupil_model import SIX, PupilModel, pupil_model, rotate
from p2sf.measure.fitting.pupil_nodes import has_twin
from p2sf.measure.fitting.starting_values import Start, starts
from p2sf.messages import Message
from p2sf.threads import one_blas_thread

Loss = Literal["linear", "soft_l1", "huber", "cauchy"]
LOSSES = ("linear", "soft_l1", "huber", "cauchy")
TRIED = 6, 48  # starts; the second count where the first may not have explained the pictures
FALSE_SHARE = 0.02  # of the pictures' squares about their mean: the best false minima of random points miss more
KEPT = 5  # coarse fits that are followed to their end
COARSE_STEPS, FINE_STEPS = 12, 60
COARSE_RTOL, FINE_RTOL = 1e-2, 1e-6  # of the sum of squares in one step
FAINT_R2 = 0.8  # below, some of a hundred fits to random points end in a false minimum (tests.long.measure faint)
UNKNOWN_WAVES = 0.25  # one standard deviation of a number that the pictures do not determine
WIDE = 10, 40  # starts of a model with a map
WAVES_STEPS = 20
FOLLOWED = 3  # wavefronts with the paraxial map to which a map is fitted
MAP_RTOL = 1e-4
COARSE_WAVES = 0.1  # by which coarse minima differ that are worth following
SAME_WAVES = 0.02  # by which numbers of one solution may differ
LEAST_SINGULAR = 1e-9
LEAST_LIGHT = 0.75
AS_GOOD = 9.0  # in χ²: three standard deviations
MOST_CHI2 = 3.0  # from which a point, or a frame, has no numbers
UNLIKELY = 5.0  # standard deviations of χ² above its mean that noise alone does not reach


@dataclass(frozen=True, eq=False)
class PointFit:
    """What explains the pictures of one point.

    Attributes
    ----------
    model, optics, azimuth
        What was fitted, at which scale, and the field's direction in radians from +y towards +x.
    numbers : numpy.ndarray
        Of the model: those of the wavefront in waves, then those of the pupil map.
    covariance : numpy.ndarray
        For the stated noise (the inverse of Fisher's information), of the numbers, then of x and y in µm, light and
        background of every picture.
    frames : numpy.ndarray
        x and y in µm from the window's middle pixel, all light and background of every picture, (pictures, 4).
    modelled : tuple of numpy.ndarray
        The windows as fitted.
    r2 : numpy.ndarray
        1 − Σ(picture − model)²/Σ(picture − mean)² of every picture.
    chi2 : float
        Sum of squares over the noise, by degrees of freedom: 1 where the stated noise explains what is left.
    others : tuple of numpy.ndarray
        Numbers of other solutions that explain the pictures as well, the twin W(ξ, η) → −W(−ξ, −η) of a single
        focus first.
    warnings : tuple of Message
        What a reader has to know before using the numbers, or why there are none.
    computed : bool
        Whether the pictures are of a computed PSF, whose noise is assumed: χ² says nothing of the numbers then.
    """

    model: PupilModel
    optics: PictureOptics
    azimuth: float
    numbers: np.ndarray
    covariance: np.ndarray
    frames: np.ndarray
    modelled: tuple[np.ndarray, ...]
    r2: np.ndarray
    chi2: float
    others: tuple[np.ndarray, ...] = ()
    warnings: tuple[Message, ...] = ()
    computed: bool = False

    def __repr__(self) -> str:
        rows = zip(self.names, self.numbers, self.errors, strict=False)
        found = ", ".join(f"{name} {value:.4g} ± {error:.1g}" for name, value, error in rows)
        return f"<PointFit: {found}; R² {np.min(self.r2):.5g}>"

    @property
    def reliable(self) -> bool:
        """Return whether enough is explained for the numbers to mean anything: beyond, they may be of any minimum."""
        return self.computed or self.chi2 <= MOST_CHI2

    @property
    def names(self) -> tuple[str, ...]:
        """Return the names of the numbers."""
        return self.model.wave_names + self.model.map_names

    @property
    def bounds(self) -> np.ndarray:
        """Return the Cramér–Rao bound of each number's standard deviation for the stated noise, (numbers,)."""
        deviation: np.ndarray = np.sqrt(np.diag(self.covariance)[: self.numbers.size])
        return deviation

    @property
    def errors(self) -> np.ndarray:
        """Return one standard deviation of each number: the bound, enlarged where more than the noise is left."""
        enlarged: np.ndarray = self.bounds * max(1.0, self.chi2) ** 0.5
        return enlarged

    def waves(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the wavefront at points of the pupil, waves, on the sphere about the window's middle pixel.

        Tilts are those by which the point lies beside it, in the first picture.
        """
        waves, across, along = self.model.split(self.numbers)
        fx, fy = xi, eta
        if self.model.mapped:
            odd, even = self.model.maps(*rotate(xi, eta, self.azimuth))
            fx, fy = rotate(across @ odd, along @ even, -self.azimuth)  # back to the sensor's axes
        x, y = self.frames[0, :2] * self.optics.cycles
        found: np.ndarray = waves @ self.model.waves(xi, eta, self.azimuth) - fx * x - fy * y
        return found


@dataclass(frozen=True, eq=False)
class _Minimum:
    """Half the sum of squares (robust if a loss is), and where it is."""

    cost: float
    unknowns: np.ndarray


@one_blas_thread
def fit_point(
    pictures: Sequence[PointPicture],
    optics: PictureOptics,
    model: str = SIX,
    azimuth_deg: float = 0.0,
    loss: Loss = "linear",
    near: np.ndarray | None = None,
    design: DesignedPupil | None = None,
) -> PointFit:
    """Return the wavefront that explains one or several pictures of one point, taken at known differences of focus.

    ``model``: "seidel" (W40, W31, W22, W20 + Wd), "26" or "46" numbers, which fit the pupil map too. ``azimuth_deg``:
    the field's direction on the sensor from +y towards +x, about which wavefront and map are even.
    ``loss``: other than "linear", outliers count less (`scipy.optimize.least_squares`). ``near``: W40, W31, W22 and
    W20 + Wd expected, such as those of the lens as designed: tried too, and of solutions that explain the pictures as
    well the nearest is taken. ``design``: where the fit of a model with a map starts, and where rims end the pupil.
    One focus leaves the twin open (`PointFit.others`). Raises RequestError for pictures in which no point is, or too
    few pixels.
    """
    azimuth = float(np.deg2rad(azimuth_deg))
    wanted = pupil_model(model)
    _check(pictures, wanted, loss)
    if wanted.six:
        return _result(Problem(pictures, optics, wanted, azimuth), _six(pictures, optics, azimuth, loss, near), near)
    problem = Problem(pictures, optics, wanted, azimuth, clear=design.clear if design else None)
    return _result(problem, _with_map(problem, loss, design), design.numbers if design else None)


def _check(pictures: Sequence[PointPicture], model: PupilModel, loss: str) -> None:
    if not pictures:
        raise RequestError("there is no picture to fit; give at least one")
    if loss not in LOSSES:
        raise RequestError('{parameter} is "{value}"; choose {choices}', parameter="loss", value=loss, choices=LOSSES)
    unknowns = model.even.size + PER_FRAME * len(pictures)
    pixels = sum(int(picture.usable.sum()) for picture in pictures)
    if pixels <= unknowns:
        raise RequestError(
            "{pixels} usable pixels for {unknowns} unknowns; take a larger window, or fit fewer numbers",
            pixels=pixels,
            unknowns=unknowns,
        )


def _six(
    pictures: Sequence[PointPicture], optics: PictureOptics, azimuth: float, loss: Loss, near: np.ndarray | None
) -> list[_Minimum]:
    """Return minima of the six model, the deepest first; more starts are tried where none explains the pictures."""
    coarse, fine = (Problem(pictures, optics, pupil_model(SIX), azimuth, part) for part in (True, False))
    every = starts(pictures, optics, azimuth, TRIED[-1])
    minima: list[_Minimum] = []
    if near is not None:
        expected = np.concatenate([near, every[0].frames.ravel()])
        expected[5::PER_FRAME] += (near[1] - every[0].waves[1]) * np.cos(azimuth) / optics.cycles
        expected[4::PER_FRAME] += (near[1] - every[0].waves[1]) * np.sin(azimuth) / optics.cycles
        minima.append(_descend(fine, expected, loss))
    for some in (slice(0, TRIED[0]), slice(*TRIED)):
        rough = [_descend(coarse, _unknowns(start), loss, COARSE_STEPS, COARSE_RTOL) for start in every[some]]
        rough.sort(key=_cost)
        minima += [_descend(fine, minimum.unknowns, loss) for minimum in _distinct(rough, 4)[:KEPT]]
        minima.sort(key=_cost)
        if explains(fine, minima[0]):
            break
    else:
        if len(pictures) > 1 and 2 * minima[0].cost > fine.freedom * most_chi2(fine.freedom):
            minima += [_descend(fine, start, loss) for start in _from_each(pictures, optics, azimuth, loss, every[0])]
            minima.sort(key=_cost)
    return _distinct(minima, 4, SAME_WAVES)


def _from_each(
    pictures: Sequence[PointPicture], optics: PictureOptics, azimuth: float, loss: Loss, first: Start
) -> list[np.ndarray]:
    """Return unknowns that explain one picture alone, and their twins: it has fewer minima than all together."""
    out = []
    for k, picture in enumerate(pictures):
        alone = _six([picture], optics, azimuth, loss, None)[0].unknowns
        frames = first.frames.copy()
        frames[:, :2] = alone[4:6]
        frames[k] = alone[4:]
        for waves in (alone[:4], pupil_model(SIX).twin(alone[:4], picture.defocus_waves)):
            out.append(np.concatenate([waves, frames.ravel()]))
    return out


def explains(problem: Problem, minimum: _Minimum) -> bool:
    """Return whether a minimum leaves only noise, and too little for a false minimum, which misses `FALSE_SHARE`.

    χ² alone does not tell: noise that is high, or taken for too high, hides what a false one misses.
    """
    noise = problem.freedom * most_chi2(problem.freedom)
    return 2 * minimum.cost < min(noise, FALSE_SHARE * problem.squares(minimum.unknowns))


def most_chi2(freedom: int) -> float:
    """Return the reduced χ² that noise alone hardly exceeds: its standard deviation is √(2/freedom)."""
    return float(1 + UNLIKELY * (2 / freedom) ** 0.5)


def _unknowns(start: Start) -> np.ndarray:
    return np.concatenate([start.waves, start.frames.ravel()])


def _distinct(minima: Sequence[_Minimum], waves: int, apart: float = COARSE_WAVES) -> list[_Minimum]:
    """Return those minima whose first numbers, ``waves`` of them, lie ``apart``, in their order."""
    out: list[_Minimum] = []
    for minimum in minima:
        if all(np.abs(minimum.unknowns - other.unknowns)[:waves].max() > apart for other in out):
            out.append(minimum)
    return out


def _descend(
    problem: Problem, unknowns: np.ndarray, loss: Loss, steps: int = FINE_STEPS, rtol: float = FINE_RTOL
) -> _Minimum:
    """Return the minimum that Levenberg's and Marquardt's method in a trust region reaches (Moré 1978)."""
    from scipy.optimize import least_squares

    for _ in range(2):  # once more with more nodes, should the wavefront have become steeper
        problem.prepare(unknowns)
        found = least_squares(
            problem.residuals,
            unknowns,
            problem.slopes,
            x_scale=problem.scales(unknowns),
            loss=loss,
            max_nfev=steps,
            ftol=rtol,
        )
        unknowns = found.x
        if not problem.needs_more(unknowns):
            break
    return _Minimum(float(found.cost), unknowns)


def _with_map(problem: Problem, loss: Loss, design: DesignedPupil | None) -> list[_Minimum]:
    """Return minima of a model with a map: its wavefront is fitted first, with the paraxial map, unless designed."""
    pictures, optics, model, azimuth = problem.pictures, problem.optics, problem.model, problem.azimuth
    waves, count = replace(model, map_order=1), len(model.wave_names)
    six, free = (Problem(pictures, optics, part, azimuth, True, problem.clear) for part in (pupil_model(SIX), waves))
    every = starts(pictures, optics, azimuth, 1 if design else WIDE[-1])
    if design is not None:
        frames = every[0].frames.copy()
        frames[:, :2] = _along(azimuth, -design.tilt / optics.cycles)
        return [_descend(problem, np.concatenate([design.numbers, frames.ravel()]), loss, rtol=MAP_RTOL)]
    out: list[_Minimum] = []
    for some in (slice(0, WIDE[0]), slice(*WIDE)):
        near = [_descend(six, _unknowns(start), loss, COARSE_STEPS, COARSE_RTOL) for start in every[some]]
        began = [_with_waves(m, optics.cycles, waves, azimuth) for m in _distinct(sorted(near, key=_cost), 4)]
        near = [_descend(free, start, loss, WAVES_STEPS, COARSE_RTOL) for start in began]
        for minimum in _distinct(sorted(near, key=_cost), count)[:FOLLOWED]:
            start = np.concatenate([minimum.unknowns[:count], model.paraxial_map, minimum.unknowns[count:]])
            out.append(_descend(problem, start, loss, rtol=MAP_RTOL))
            if 2 * out[-1].cost < problem.freedom * most_chi2(problem.freedom):
                return sorted(out, key=_cost)
    return sorted(out, key=_cost)


def _along(azimuth: float, distance: float) -> tuple[float, float]:
    """Return x and y of a distance along a field's direction."""
    return distance * float(np.sin(azimuth)), distance * float(np.cos(azimuth))


def _cost(minimum: _Minimum) -> float:
    return minimum.cost


def _with_waves(minimum: _Minimum, cycles: float, model: PupilModel, azimuth: float) -> np.ndarray:
    """Return unknowns of Zernike's terms that describe the same light as those of the six model."""
    waves, tilt = model.of_six(minimum.unknowns[:4])
    frames = minimum.unknowns[4:].reshape(-1, PER_FRAME).copy()
    frames[:, :2] -= _along(azimuth, tilt / cycles)  # its terms have no tilt, that of the six's coma is a shift
    return np.concatenate([waves, frames.ravel()])


def _result(problem: Problem, minima: Sequence[_Minimum], near: np.ndarray | None) -> PointFit:
    if near is not None:
        minima = _nearest_first(problem, minima, near)
    best = minima[0]
    unknowns, numbers = best.unknowns, problem.numbers
    problem.prepare(unknowns)
    rest, slopes = problem.evaluate(unknowns)
    covariance = _inverse(slopes, problem.scales(unknowns))
    frames = unknowns[numbers:].reshape(-1, PER_FRAME)
    modelled = problem.modelled(unknowns)
    chi2 = float(rest @ rest) / problem.freedom
    others = [m.unknowns[:numbers] for m in minima[1:] if 2 * (m.cost - best.cost) < AS_GOOD * max(1.0, chi2)]
    if _open_sign(problem):
        twin = problem.model.twin(unknowns[:numbers], problem.pictures[0].defocus_waves)
        others = [twin, *(other for other in others if np.abs(other - twin).max() > SAME_WAVES)]
    fit = PointFit(
        model=problem.model,
        optics=problem.optics,
        azimuth=problem.azimuth,
        numbers=unknowns[:numbers].copy(),
        covariance=covariance,
        frames=frames,
        modelled=modelled,
        r2=problem.r2(modelled),
        chi2=chi2,
        others=tuple(others),
        computed=any(picture.computed for picture in problem.pictures),
    )
    return replace(fit, warnings=_warnings(fit, problem))


def _open_sign(problem: Problem) -> bool:
    """Return whether the pictures leave the common sign of all even terms open."""
    return len(problem.pictures) == 1 and has_twin(problem.optics.mask)


def _nearest_first(problem: Problem, minima: Sequence[_Minimum], near: np.ndarray) -> list[_Minimum]:
    """Return minima, first the nearest of those that explain the pictures as well as the deepest, twins included."""
    least = minima[0].cost
    most = least + 0.5 * AS_GOOD * max(1.0, 2 * least / problem.freedom)
    as_good = [minimum for minimum in minima if minimum.cost < most]
    if _open_sign(problem):
        known = problem.pictures[0].defocus_waves
        for minimum in list(as_good):
            unknowns = minimum.unknowns.copy()
            unknowns[: problem.numbers] = problem.model.twin(unknowns[: problem.numbers], known)
            as_good.append(_Minimum(minimum.cost, unknowns))
    first = min(as_good, key=lambda minimum: float(np.abs(minimum.unknowns[: problem.numbers] - near).max()))
    return [first, *(minimum for minimum in minima if minimum is not first)]


def _inverse(slopes: np.ndarray, scales: np.ndarray) -> np.ndarray:
    """Return (JᵀJ)⁻¹ from the singular values of J in units of ``scales``; what is not determined at all is huge."""
    _, values, turns = np.linalg.svd(slopes * scales, full_matrices=False)
    inverse = turns.T / np.maximum(values, values[0] * LEAST_SINGULAR)
    scaled = inverse * scales[:, None]
    covariance: np.ndarray = scaled @ scaled.T
    return covariance


def no_numbers(chi2: float) -> Message:
    """Return why a point has no numbers."""
    return Message(
        "no numbers: what the model leaves is {chi2:.3g} times the variance of the noise, and {most:g} is the most. "
        "Try more numbers; check f-number, wavelength, pixel and stated noise, state the gain of bright points, and "
        "see that the picture is linear and sharp, and the points much smaller than a pixel",
        chi2=chi2,
        most=MOST_CHI2,
    )


def chi2_warning(chi2: float, freedom: int) -> tuple[Message, ...]:
    """Return a warning where a model leaves more than the noise; none where it does not."""
    if chi2 <= most_chi2(freedom):
        return ()
    return (
        Message(
            "what the model does not explain is {ratio:.2g} times the noise, and the errors are enlarged by that; "
            "try more numbers, and check the numerical aperture, the pixel and the noise",
            ratio=chi2**0.5,
        ),
    )


def _warnings(fit: PointFit, problem: Problem) -> tuple[Message, ...]:
    """Return what a reader has to know before using the numbers, or why there are none."""
    if not fit.reliable:
        return (no_numbers(fit.chi2),)
    out = list(chi2_warning(fit.chi2, problem.freedom))
    one_sign = _open_sign(problem)
    if one_sign:
        out.append(
            Message(
                "one focus does not determine the common sign of all even terms; add a second focus at a known distance"
            )
        )
    further = len(fit.others) - one_sign
    if further:
        out.append(Message("other wavefronts explain the pictures as well: {count}; add a focus", count=further))
    waves = fit.errors[: len(fit.model.wave_names)]
    blind = tuple(name for name, error in zip(fit.names, waves, strict=False) if error > UNKNOWN_WAVES)
    if blind:
        out.append(
            Message(
                "{names}: not determined, one standard deviation exceeds {most} waves", names=blind, most=UNKNOWN_WAVES
            )
        )
    explained = float(np.min(fit.r2))
    if explained < FAINT_R2:
        out.append(
            Message(
                "noise is {share:.0%} of what the picture shows, and a wavefront farther from the true one than these "
                "errors may hide in it; expose longer, average pictures, or add a focus",
                share=1 - explained,
            )
        )
    shares = (float(np.sum(model - frame[3]) / frame[2]) for model, frame in zip(fit.modelled, fit.frames, strict=True))
    least = min(shares)
    if least < LEAST_LIGHT:
        out.append(Message("only {share:.0%} of the light lies in the window; take a larger one", share=least))
    return tuple(out)
