"""From a frame to a measurement: its points, the wavefront of each, and what explains all of them (handbook 11.3).

Measurements are kept in files, and two of them compared.
"""

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import Cancelled, P2SFError, RequestError
from p2sf.figures.record import versions
from p2sf.files.atomic import DAMAGED
from p2sf.files.reading import parse_json, read_arrays
from p2sf.files.writing import write_arrays, write_beside
from p2sf.lens.lens import Lens
from p2sf.measure.fitting.frame_fit import FrameFit, Tell, fit_frame, share_of
from p2sf.measure.fitting.frame_terms import (
    F_NUMBER,
    F_NUMBER_ERROR,
    FIELD,
    FOCUS,
    FrameModel,
    FramePoint,
    six_of_unknowns,
)
from p2sf.measure.fitting.lens_pupil import designed_pupil
from p2sf.measure.fitting.point_fit import PointFit, chi2_warning, fit_point, no_numbers
from p2sf.measure.fitting.point_model import PictureOptics
from p2sf.measure.fitting.point_problem import PointPicture
from p2sf.measure.fitting.pupil_model import SIX, pupil_model
from p2sf.measure.fitting.starting_values import locate
from p2sf.measure.frame import Frame
from p2sf.measure.points import STRANGE, FoundPoint, find_points, in_grid, window_half, window_of
from p2sf.measure.target import Target, TargetMatch, expected_places, match_target
from p2sf.messages import Message
from p2sf.parameters import check_finite
from p2sf.raytrace.focusing import object_distance
from p2sf.threads import for_each

FEWEST = 5  # points of a frame whose field is fitted too
STRAIGHT = 0.017  # radians off +y within which the fast rows of a map are taken
LEAST_HEIGHT_MM = 1e-3  # of the farthest point
LEAST_CHI2 = 0.5  # that noise as stated leaves: the windows have hundreds of pixels
PASSES, SETTLED = 4, 0.98  # fits about the errors and the f-number found before, while χ² falls by more than this
WHOLE, FIRST = 0.5, 0.5  # of the time, as progress is told: the frame, and of it the first fit
NEAR_MM = 0.05  # points of two measurements that lie as near are the same


@dataclass(frozen=True, eq=False)
class Measurement:
    """What frames of points tell.

    Attributes
    ----------
    frames : tuple of Frame
        The pictures; points are those of the first.
    optics : Optics
        The scale of their PSFs.
    points : tuple of FoundPoint
        All that were found, the brightest first, with what speaks against using them.
    half : int
        Half the width of the points' windows, pixels.
    fits : tuple of PointFit or None
        Of every point; None for those not used.
    failures : tuple of Message or None
        Why a point that was used could not be fitted.
    whole : FrameFit or None
        What explains all points together; None for too few of them.
    target : TargetMatch or None
        How the known target lies in the picture, if one was given.
    """

    frames: tuple[Frame, ...]
    optics: PictureOptics
    points: tuple[FoundPoint, ...]
    half: int
    fits: tuple[PointFit | None, ...]
    failures: tuple[Message | None, ...]
    whole: FrameFit | None = None
    target: TargetMatch | None = None

    @property
    def used(self) -> int:
        """Return how many points were fitted."""
        return sum(found is not None for found in self.fits)

    @property
    def warnings(self) -> tuple[Message, ...]:
        """Return what a reader has to know of the pictures, beside the warnings of each point and of the frame."""
        out = tuple(note for frame in self.frames for note in (*frame.notes, frame.clipped) if note)
        chi2 = [one.chi2 for one in self.fits if one is not None] or [self.whole.chi2 if self.whole else 1.0]
        if not self.frames[0].psf and (low := float(np.median(chi2))) < LEAST_CHI2:
            why = Message(
                "what is left is {chi2:.2g} times the variance of the noise, so the noise is less than taken and the "
                "errors are too large; check the read noise and the gain, and that the picture was not smoothed",
                chi2=low,
            )
            out = (*out, why)
        return out


@dataclass(frozen=True, eq=False)
class FrameRequest:
    """What is to be found of frames, and what is known of the lens that made them.

    ``focus_um``: how much farther from the lens the sensor was at each frame, 0 if not given. ``model``: of single
    points, each fitted by itself where ``singly``. ``lens``: as designed, from which the whole frame departs by
    ``unknowns``, and every point by four coefficients, which are added to the lens's own; a model with a map starts
    from the lens's. ``depth_mm``: of the points, by default that of the lens's object. ``clip``: the lens's rims end
    pupils. ``target``: tells where points belong and where the axis meets the sensor, which is the frame's otherwise.
    ``f_number_error``: one standard deviation of the f-number as stated, percent; unless 0, the f-number is the last
    unknown of the frame, and single points are fitted with the one found.
    """

    focus_um: Sequence[float] = (0.0,)
    model: str = SIX
    lens: Lens | None = None
    depth_mm: float | None = None
    unknowns: Sequence[str] = (*FOCUS, *FIELD)
    singly: bool = True
    clip: bool = False
    target: Target | None = None
    f_number_error: float = F_NUMBER_ERROR


def measure_frame(
    frames: Sequence[Frame],
    optics: PictureOptics,
    asked: FrameRequest | None = None,
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> Measurement:
    """Return what one frame, or several of the same points at known focus, tell of the lens that made them.

    A frame of fewer than five usable points is fitted point by point only. Raises RequestError where no point can be
    used.
    """
    if asked and asked.lens and asked.lens.sensor_surface.curvature and not frames[0].psf:
        raise RequestError(
            "the sensor of the lens is curved, and pictures of points are measured on plane ones; measure single PSFs, "
            "or give the lens a plane sensor"
        )
    asked = asked or FrameRequest()
    lens, depth_mm, singly, f_number_error = asked.lens, asked.depth_mm, asked.singly, asked.f_number_error
    if depth_mm is None:
        depth_mm = inf if lens is None else object_distance(lens)
    _check(frames, asked.focus_um, asked.model, f_number_error)
    points = in_grid(find_points(frames[0], optics))
    half = window_half(points)
    if frames[0].psf:
        points, half = [_at_field(points[0], frames[0], lens, depth_mm, optics.wavelength_um)], points[0].half
        optics = optics if frames[0].integrated else replace(optics, fill=0.0)
    match = None
    if asked.target is not None:
        points, match = _on_target(points, asked.target, lens, depth_mm, optics.wavelength_um)
    taken = [_Taken(frames, point, points, half, asked.focus_um, optics) for point in points]
    height = max([one.height_mm for one in taken if one.pictures] + [LEAST_HEIGHT_MM])
    names = tuple(name for name in asked.unknowns if name != F_NUMBER) + (F_NUMBER,) * (f_number_error > 0)
    design = FrameModel(optics, height, names, lens, depth_mm, clip=asked.clip, f_number_error=f_number_error or 1.0)
    whole = _whole(taken, design, share_of(progress, 0.0, WHOLE if singly else 1.0), cancelled)
    fits, failures = _singly(
        taken if singly else [], whole, design, asked.model, share_of(progress, WHOLE, 1.0), cancelled
    )
    if not singly:
        fits, failures = [None] * len(points), [one.failure for one in taken]
    return Measurement(tuple(frames), optics, tuple(points), half, tuple(fits), tuple(failures), whole, match)


def _check(frames: Sequence[Frame], focus_um: Sequence[float], model: str, f_number_error: float) -> None:
    if len(frames) != len(focus_um):
        raise RequestError(
            "{frames} frames and {focus} focus positions; give one for each", frames=len(frames), focus=len(focus_um)
        )
    for moved_um in focus_um:
        check_finite("focus_um", moved_um)
    check_finite("f_number_error", f_number_error)
    if f_number_error < 0:
        raise RequestError(
            "{parameter} is {value:g} %; give 0 or more, 0 where the f-number is known exactly",
            parameter="f_number_error",
            value=f_number_error,
        )
    pupil_model(model)  # refuses a name that is none


def _at_field(point: FoundPoint, frame: Frame, lens: Lens | None, depth_mm: float, wavelength_um: float) -> FoundPoint:
    """Return the point of a PSF where the chief ray of its field lands, if lens and field are known."""
    if lens is None or frame.field_deg is None:
        return point
    target = Target(np.array([1]), np.array([[0.0, frame.field_deg]]), "deg")
    ((x, y),) = expected_places(target, lens, depth_mm, wavelength_um).tolist()
    return replace(point, x_mm=x, y_mm=y)


def _on_target(
    points: Sequence[FoundPoint], target: Target, lens: Lens | None, depth_mm: float, wavelength_um: float
) -> tuple[list[FoundPoint], TargetMatch]:
    """Return points with their numbers and places on a target, measured from its origin; others are flagged."""
    good = [k for k, point in enumerate(points) if point.good]
    expected = expected_places(target, lens, depth_mm, wavelength_um)
    found = np.array([(points[k].x_mm, points[k].y_mm) for k in good]).reshape(-1, 2)
    match = match_target(found, target, expected, lens is not None)
    x, y = match.axis_mm
    out = [replace(point, x_mm=point.x_mm - x, y_mm=point.y_mm - y) for point in points]
    for k, which in zip(good, match.which.tolist(), strict=True):
        if which < 0:
            out[k] = replace(out[k], flags=(STRANGE,))
        else:
            known_mm = tuple(match.places_mm[which].tolist())
            out[k] = replace(out[k], number=int(match.numbers[which]), known_mm=known_mm)
    return out, match


class _Taken:
    """A point with its windows in all frames; none where it cannot be used in one of them.

    ``place``: the middle of the windows, or where a target says that the point belongs, x and y in mm from the axis.
    """

    def __init__(
        self,
        frames: Sequence[Frame],
        point: FoundPoint,
        others: Sequence[FoundPoint],
        half: int,
        focus_um: Sequence[float],
        optics: PictureOptics,
    ):
        self.point, self.focus_um, self.na = point, focus_um, optics.na
        pitch = frames[0].geometry.pixel_um / UM_PER_MM
        right, down = (place - round(place) for place in (point.column, point.row))
        self.place = point.known_mm or (point.x_mm - right * pitch, point.y_mm + down * pitch)
        waves = [shift * optics.na**2 / (2 * optics.wavelength_um) for shift in focus_um]
        found = [window_of(frame, point, half, wave, others) for frame, wave in zip(frames, waves, strict=True)]
        self.pictures = [one for one in found if one is not None]
        self.failure: Message | None = None
        if not point.good or None in found:
            self.pictures = []
        try:
            for one in self.pictures:
                locate(one, optics)
        except RequestError as error:
            self.pictures, self.failure = [], error.message

    @property
    def height_mm(self) -> float:
        """Return how far from the axis the point lies."""
        return float(np.hypot(*self.place))

    @property
    def azimuth(self) -> float:
        """Return the point's direction from the axis, radians from +y towards +x."""
        return float(np.arctan2(*self.place))

    def at(self, na: float) -> list[PointPicture]:
        """Return the pictures, what is known of their focus in waves at this numerical aperture."""
        ratio = (na / self.na) ** 2
        return [replace(picture, defocus_waves=ratio * picture.defocus_waves) for picture in self.pictures]

    @property
    def placed(self) -> list[FramePoint]:
        """Return the pictures as a frame's fit takes them."""
        pairs = zip(self.pictures, self.focus_um, strict=False)
        return [FramePoint(replace(picture, defocus_waves=0.0), *self.place, focus) for picture, focus in pairs]


def _whole(
    taken: Sequence[_Taken],
    design: FrameModel,
    progress: Tell,
    cancelled: Callable[[], bool] | None,
) -> FrameFit | None:
    """Return what explains all points together; None for too few of them."""
    if sum(bool(one.pictures) for one in taken) < FEWEST:
        return None
    placed = [point for one in taken for point in one.placed]
    found = fit_frame(placed, design, None, share_of(progress, 0.0, done := FIRST), cancelled)
    known = any(one.point.known_mm for one in taken)
    nonlinear = bool(design.errors) or F_NUMBER in design.unknowns
    if design.lens is None or (known and not nonlinear):
        return found
    for _ in range(PASSES if nonlinear else 1):
        # Centroids lie a pixel or so from where chief rays land, which coma moves them by.
        about = replace(design, about=tuple(found.values.tolist())) if nonlinear else design
        before = found
        told = share_of(progress, done, done := (1 + done) / 2)  # how many will follow is not known
        found = fit_frame(placed if known else _at_chief_rays(before), about, before.values, told, cancelled)
        if found.explains or found.chi2 > SETTLED * before.chi2:
            break
    return found


def _singly(
    taken: Sequence[_Taken],
    whole: FrameFit | None,
    design: FrameModel,
    model: str,
    progress: Tell,
    cancelled: Callable[[], bool] | None,
) -> tuple[list[PointFit | None], list[Message | None]]:
    """Return the fit of every point, None for those that cannot be used, and why there is none. Raises Cancelled."""
    found: list[tuple[PointFit | None, Message | None]] = []

    def fitted(one: _Taken) -> tuple[PointFit | None, Message | None]:
        if cancelled and cancelled():
            raise Cancelled("the measurement was cancelled before it was done")
        try:
            return (_single(one, whole, design, model) if one.pictures else None), one.failure
        except Cancelled:
            raise
        except P2SFError as error:
            return None, error.message

    def take(pair: tuple[PointFit | None, Message | None]) -> None:
        found.append(pair)
        if progress:
            progress(len(found) / len(taken))

    for_each(fitted, taken, take)
    return [fit for fit, _ in found], [why for _, why in found]


def _single(one: _Taken, whole: FrameFit | None, design: FrameModel, model: str) -> PointFit:
    """Return the fit of a point."""
    if whole is not None and not whole.reliable:
        whole = None
    design = design if whole is None else whole.known_stop
    if whole is not None and design.lens is not None and model == SIX:
        return _departure(whole, one)
    optics, own = design.optics, None
    pictures = one.at(optics.na)
    if model != SIX and design.lens is not None:
        half_um = max(pictures[0].values.shape) / 2 * optics.pixel_um
        source = design.source(one.height_mm, one.azimuth)
        own = designed_pupil(design.lens, source, pupil_model(model), optics.cycles, half_um, design.clip)
    near = _expected_coefficients(whole, one, design) if model == SIX else None
    azimuth = 0.0 if model != SIX and abs(one.azimuth) < STRAIGHT else float(np.rad2deg(one.azimuth))
    return fit_point(pictures, optics, model, azimuth, near=near, design=own)


def _at_chief_rays(whole: FrameFit) -> list[FramePoint]:
    """Return the points of a fit where their chief rays would land, as it found, if the lens had no errors."""
    pairs = zip(whole.points, (whole.frames[:, :2] - whole.landed_um) / UM_PER_MM, strict=True)
    return [replace(point, x_mm=point.x_mm + x, y_mm=point.y_mm + y) for point, (x, y) in pairs]


def _departure(whole: FrameFit, one: _Taken) -> PointFit:
    """Return what a point tells beyond the lens's exact wavefront, added to the lens's own coefficients."""
    model = replace(whole.known_stop, unknowns=("w40", "w31", "w22", "w20"), alone=True)
    own = model.six_of_lens(one.height_mm)
    found = fit_frame(one.placed, model, six_of_unknowns(*one.place, whole.model) @ whole.values)
    left = max(1, sum(int(part.usable.sum()) for part in one.pictures) - found.values.size - found.frames.size)
    return PointFit(
        model=pupil_model(SIX),
        optics=model.optics,
        azimuth=one.azimuth,
        numbers=own + found.values,
        covariance=found.covariance,
        frames=found.frames,
        modelled=found.modelled,
        r2=found.r2,
        chi2=found.chi2,
        warnings=chi2_warning(found.chi2, left) if found.reliable else (no_numbers(found.chi2),),
    )


def _expected_coefficients(whole: FrameFit | None, one: _Taken, design: FrameModel) -> np.ndarray | None:
    """Return W40, W31, W22 and W20 + Wd that frame and lens suggest for a point: all points then take the same twin."""
    if whole is None:
        return design.six_of_lens(one.height_mm) if design.lens is not None else None
    of_frame = six_of_unknowns(*one.place, whole.model) @ whole.values
    expected: np.ndarray = design.six_of_lens(one.height_mm) + of_frame
    return expected


def write_measurement(found: Measurement, path: str | os.PathLike[str]) -> Path:
    """Write the numbers of a measurement as .npz and return the path. Raises ExportError.

    ``places_mm`` (points, 2), ``numbers``, ``errors`` and ``bounds`` (points, numbers), ``twins``, ``r2``, ``chi2``
    and, on a target, ``target_numbers`` of every point used, numbers NaN where the model leaves too much;
    ``whole``, ``whole_errors``, ``whole_bounds`` of the frame; ``meta`` names them.
    """
    used = [(point, one) for point, one in zip(found.points, found.fits, strict=True) if one is not None]
    arrays: dict[str, np.ndarray] = {
        "places_mm": np.array([(point.x_mm, point.y_mm) for point, _ in used]).reshape(-1, 2),
        "r2": np.array([one.r2 for _, one in used]),
        "chi2": np.array([one.chi2 for _, one in used]),
    }
    if found.target is not None:
        arrays["target_numbers"] = np.array([point.number for point, _ in used], int)
    scale = {name: value for name, value in vars(found.optics).items() if name != "mask"}
    meta: dict[str, object] = {"optics": scale, "points_found": len(found.points)}
    if used:
        none = np.full(used[0][1].numbers.size, np.nan)
        arrays["numbers"], arrays["errors"], arrays["bounds"] = (
            np.array([getattr(one, name) if one.reliable else none for _, one in used])
            for name in ("numbers", "errors", "bounds")
        )
        arrays["twins"] = np.array([one.others[0] if one.others and one.reliable else none for _, one in used])
        meta |= {"model": used[0][1].model.name, "names": used[0][1].names}
    if found.whole is not None and found.whole.reliable:
        whole = found.whole
        arrays |= {"whole": whole.values, "whole_errors": whole.errors, "whole_bounds": whole.bounds}
        model = whole.model
        meta["unknowns"] = {name: model.unit(name) for name in model.unknowns}
        meta["height_mm"] = model.height_mm
        meta["lens"] = model.lens.name if model.lens is not None else None
    return write_beside(path, lambda handle: write_arrays(handle, arrays, meta | {"versions": versions()}))


def read_measurement(path: str | os.PathLike[str]) -> tuple[dict[str, np.ndarray], dict]:
    """Return the arrays and the meta of a file of `write_measurement`. Raises RequestError."""
    try:
        arrays = read_arrays(path)
        meta = parse_json(str(arrays.pop("meta")))
        if "places_mm" not in arrays or not isinstance(meta, dict):
            raise ValueError("no measurement")
    except (OSError, ValueError, *DAMAGED) as error:
        raise RequestError(
            "{path} is not a measurement that this program wrote; make it with p2sf measure -o", path=str(path)
        ) from error
    return arrays, meta


@dataclass(frozen=True)
class ComparedNumber:
    """One number in both, of the frame or as the mean over common points; ``sigmas``: by which it differs."""

    name: str
    first: float
    second: float
    sigmas: float


@dataclass(frozen=True)
class MeasurementComparison:
    """Two measurements: how many points they have in common, and their numbers."""

    points: int
    rows: tuple[ComparedNumber, ...]


def compare_measurements(first: str | os.PathLike[str], second: str | os.PathLike[str]) -> MeasurementComparison:
    """Return two files of `write_measurement` beside each other; of points' numbers the means, and the RMS of sigmas.

    Raises RequestError for other files, and where they have no number in common.
    """
    (one, named), (two, also) = (read_measurement(path) for path in (first, second))
    pairs = _pairs(one["places_mm"], two["places_mm"])
    if "numbers" in one and "numbers" in two:
        pairs = [(a, b) for a, b in pairs if np.isfinite([one["numbers"][a, 0], two["numbers"][b, 0]]).all()]
    rows = []
    if pairs and named.get("names") == also.get("names") and "numbers" in one and "numbers" in two:
        here, there = (np.array(k) for k in zip(*pairs, strict=True))
        for k, name in enumerate(named["names"]):
            a, b = one["numbers"][here, k], two["numbers"][there, k]
            error = np.hypot(one["errors"][here, k], two["errors"][there, k])
            rows.append(ComparedNumber(str(name), float(a.mean()), float(b.mean()), _rms((b - a) / error)))
    both = [name for name in named.get("unknowns", ()) if name in also.get("unknowns", ())]
    for name in both:
        i, j = list(named["unknowns"]).index(name), list(also["unknowns"]).index(name)
        a, b = float(one["whole"][i]), float(two["whole"][j])
        error = float(np.hypot(one["whole_errors"][i], two["whole_errors"][j]))
        rows.append(ComparedNumber(str(name), a, b, abs(b - a) / error))
    if not rows:
        raise RequestError(
            "{first} and {second} have no number in common; measure the same points by the same model",
            first=str(first),
            second=str(second),
        )
    return MeasurementComparison(len(pairs), tuple(rows))


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _pairs(one: np.ndarray, two: np.ndarray) -> list[tuple[int, int]]:
    """Return the numbers of points that lie near each other, (in the first, in the second)."""
    if not len(one) or not len(two):
        return []
    away = np.hypot(*(one[:, None] - two[None]).transpose(2, 0, 1))
    return [(k, int(np.argmin(row))) for k, row in enumerate(away) if row.min() < NEAR_MM]
