"""Points in a frame: where they are, whether they can be used, and their order in a grid (handbook 11.3).

Detection is a threshold above the noise of the smoothed frame and labels of connected pixels, `scipy.ndimage` both.
Libraries for stars (photutils) bring astropy along and look for round Gaussian ones, which points far off the axis of a
lens are not.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from p2sf.errors import RequestError
from p2sf.measure.fitting.point_model import PictureOptics, PixelSum
from p2sf.measure.fitting.point_problem import PointPicture
from p2sf.measure.fitting.pupil_nodes import counts_for, paraxial_nodes
from p2sf.measure.frame import Frame
from p2sf.messages import Message

SMOOTH_PIXELS = 1.0
SIGNIFICANT = 5.0  # standard deviations of the smoothed noise
LEAST_PIXELS = 4  # of a point: fewer are hot pixels and cosmic rays
LONE = 0.85  # of the light in one pixel: the sharpest point centred on a large pixel leaves a tenth in its rings
PAIR_PIXELS = 9  # of the window over which the sharpest point is summed
BRIDGE = 3  # pixels between parts of one point, such as the rings of its diffraction
WIDE = 1.7  # times the median extent: two points in one
FAINT = 0.05  # of the median light
NEAR = 0.35  # of a grid's step within which the next point is looked for
MARGIN_PIXELS = 4
LARGEST_HALF = 48

SATURATED, CUT, CLOSE, WIDE_POINT, DIM, STRANGE = (
    Message("saturated"),
    Message("cut by the frame's edge"),
    Message("overlaps another point"),
    Message("wider than the others, perhaps two points"),
    Message("much fainter than the others"),
    Message("no point of the target"),
)


@dataclass(frozen=True)
class FoundPoint:
    """A point of light: its centroid (row and column, and mm from the axis), all light and peak in counts.

    ``half``: pixels from the centroid to the farthest of its pixels above the noise. ``flags``: why it is not used,
    empty if it is. ``place``: (column, row) in a grid of points, None outside one. ``number``: of a known target, on
    which the point belongs at ``known_mm`` from the axis.
    """

    row: float
    column: float
    x_mm: float
    y_mm: float
    flux: float
    peak: float
    half: int
    flags: tuple[Message, ...] = ()
    place: tuple[int, int] | None = None
    number: int | None = None
    known_mm: tuple[float, float] | None = None

    @property
    def good(self) -> bool:
        """Return whether nothing speaks against using it."""
        return not self.flags


def find_points(frame: Frame, optics: PictureOptics | None = None) -> list[FoundPoint]:
    """Return the points of a frame, the brightest first, those that cannot be used flagged.

    Of a PSF, its one point, wherever its light lies. ``optics``: what has more light in one pixel, or in two, than
    a point without aberrations is made by hot pixels. Raises RequestError where nothing stands out of the noise.
    """
    from scipy import ndimage

    if frame.psf:
        return [_of_psf(frame)]
    labels, _ = _labels(frame)
    boxes = ndimage.find_objects(labels)
    most = (LONE,) if optics is None else _most_light(optics)
    measured = (_measure_point(frame, box, labels[box] == k, most) for k, box in enumerate(boxes, 1) if box is not None)
    points = [point for point in measured if point is not None]
    if not points:
        raise RequestError(
            "no point rises above the noise of {noise:.3g} counts; expose longer, or check the dark field",
            noise=frame.background_noise,
        )
    points.sort(key=lambda point: -point.flux)
    return _flag(frame, points)


def _of_psf(frame: Frame) -> FoundPoint:
    rows, columns = frame.values.shape
    row, column = (rows - 1) // 2, columns // 2
    half = min(row, rows - 1 - row, column, columns - 1 - column)
    total, peak = float(np.nansum(frame.values)), float(np.nanmax(frame.values))
    return FoundPoint(row, column, *frame.geometry.place_of(row, column), total, peak, half)


def _labels(frame: Frame) -> tuple[np.ndarray, int]:
    """Return a number for each point's pixels, 0 elsewhere, and how many points there are."""
    from scipy import ndimage

    known = np.isfinite(frame.values)
    light = np.where(known, frame.values - frame.background, 0.0)
    if frame.bad is not None:
        light[frame.bad] = 0.0
    smooth = ndimage.gaussian_filter(light, SMOOTH_PIXELS)
    # Averaging over a Gaussian leaves 1/(2√π·width) of white noise.
    bright = smooth > SIGNIFICANT * frame.background_noise / (2 * np.sqrt(np.pi) * SMOOTH_PIXELS)
    joined = ndimage.binary_fill_holes(ndimage.binary_dilation(bright, iterations=BRIDGE))  # over a blur's dark rings
    labels, count = ndimage.label(joined, np.ones((3, 3)))
    return np.where(bright, labels, 0), int(count)


@lru_cache(maxsize=16)
def _most_light(optics: PictureOptics) -> tuple[float, ...]:
    """Return shares of light that no point has in its brightest pixel, its brightest two, three and four.

    They lie halfway from those of a point without aberrations, in the middle of as many pixels, to all of the light.
    """
    counts = counts_for(0.0, optics.cycles, PAIR_PIXELS * optics.pixel_um)
    nodes, half = paraxial_nodes(counts, optics.cycles, optics.mask, optics.wavelength_um), optics.pixel_um / 2
    sharp = PixelSum(nodes, (PAIR_PIXELS, PAIR_PIXELS), optics)
    shares = []
    for pixels, (x, y) in ((1, (0.0, 0.0)), (2, (half, 0.0)), (4, (half, half))):
        light = sharp.light(nodes.waves - nodes.fx * x - nodes.fy * y)
        shares.append((1 + float(np.sort(light.ravel())[-pixels:].sum())) / 2)
    return shares[0], shares[1], shares[2], shares[2]


def _measure_point(
    frame: Frame, box: tuple[slice, slice], pixels: np.ndarray, most: Sequence[float]
) -> FoundPoint | None:
    """Return one point from its pixels in a box of the frame; None for too few of them.

    ``most``: the shares of light that no point has in one pixel, in two and so on.
    """
    rows, columns = (part.start + inside for part, inside in zip(box, np.nonzero(pixels), strict=True))
    light = np.nan_to_num(frame.values[rows, columns] - frame.background)
    if rows.size < LEAST_PIXELS or not light.sum() > 0:
        return None
    brightest = np.cumsum(np.sort(light)[::-1][: len(most)])
    if (brightest > np.multiply(most, light.sum())).any():
        return None
    row, column = (float(axis @ light / light.sum()) for axis in (rows, columns))
    x, y = frame.geometry.place_of(row, column)
    half = int(np.ceil(max(np.abs(rows - row).max(), np.abs(columns - column).max())))
    flags = (SATURATED,) if frame.saturated_pixels[rows, columns].any() else ()
    return FoundPoint(row, column, x, y, float(light.sum()), float(light.max()), half, flags)


def _flag(frame: Frame, points: Sequence[FoundPoint]) -> list[FoundPoint]:
    """Return points with what speaks against them; those far fainter than the others are flagged too."""
    light, half = (float(np.median([getattr(point, name) for point in points])) for name in ("flux", "half"))
    places = np.array([(point.row, point.column) for point in points])
    out = []
    for k, point in enumerate(points):
        flags = list(point.flags)
        need = point.half + 1
        if not (
            need <= point.row < frame.geometry.rows - need and need <= point.column < frame.geometry.columns - need
        ):
            flags.append(CUT)
        away = np.abs(np.delete(places, k, axis=0) - places[k]).max(1, initial=0.0) if len(points) > 1 else np.empty(0)
        reach = point.half + np.delete([other.half for other in points], k)
        if (away < reach).any():
            flags.append(CLOSE)
        if len(points) > 2 and point.half > WIDE * half + 1:
            flags.append(WIDE_POINT)
        if point.flux < FAINT * light:
            flags.append(DIM)
        out.append(replace(point, flags=tuple(flags)))
    return out


def in_grid(points: Sequence[FoundPoint]) -> list[FoundPoint]:
    """Return points with their places in a rectangular grid, (0, 0) nearest the axis, columns along +x, rows along +y.

    The grid may be turned by up to 30° and distorted, as long as steps change little from one to the next.
    """
    if len(points) < 3:
        return list(points)
    xy = np.array([(point.x_mm, point.y_mm) for point in points])
    steps = _steps(xy)
    first = int(np.argmin(np.hypot(*xy.T)))
    found: dict[int, tuple[int, int]] = {first: (0, 0)}
    local = {first: steps}
    waiting = [first]
    while waiting:
        k = waiting.pop(0)
        for axis in (0, 1):
            for sign in (1, -1):
                step = local[k][axis]
                other = _nearest(xy, xy[k] + sign * step, NEAR * float(np.hypot(*step)))
                if other is None or other in found:
                    continue
                place = list(found[k])
                place[axis] += sign
                found[other] = place[0], place[1]
                new = local[k].copy()
                new[axis] = sign * (xy[other] - xy[k])
                local[other] = new
                waiting.append(other)
    return [replace(point, place=found.get(k)) for k, point in enumerate(points)]


def _steps(xy: np.ndarray) -> np.ndarray:
    """Return the median steps to the neighbours along +x and along +y, (2, 2)."""
    difference = xy[None] - xy[:, None]
    distance = np.hypot(difference[..., 0], difference[..., 1])
    np.fill_diagonal(distance, np.inf)
    near = difference[distance < 1.5 * np.median(distance.min(1))]
    along = near[near[:, 0] > np.abs(near[:, 1])]
    up = near[near[:, 1] > np.abs(near[:, 0])]
    scale = float(np.median(distance.min(1)))
    one = np.median(along, axis=0) if len(along) else np.array([scale, 0.0])
    two = np.median(up, axis=0) if len(up) else np.array([0.0, scale])
    return np.array([one, two])


def _nearest(xy: np.ndarray, place: np.ndarray, within: float) -> int | None:
    away = np.hypot(*(xy - place).T)
    k = int(np.argmin(away))
    return k if away[k] < within else None


def window_half(points: Sequence[FoundPoint]) -> int:
    """Return a half width of windows, pixels, that holds the light of nine in ten good points."""
    halves = [point.half for point in points if point.good]
    if not halves:
        raise RequestError(
            "no point can be used: {flags}; expose less, or move the points apart",
            flags=tuple(dict.fromkeys(flag for point in points for flag in point.flags)),
        )
    return min(int(np.ceil(np.quantile(halves, 0.9))) + MARGIN_PIXELS, LARGEST_HALF)


def window_of(
    frame: Frame, point: FoundPoint, half: int, defocus_waves: float = 0.0, others: Sequence[FoundPoint] = ()
) -> PointPicture | None:
    """Return the window about a point's pixel, (2·half + 1)², rows towards +y; None where it leaves the frame.

    Pixels with light of ``others`` do not count.
    """
    row, column = round(point.row), round(point.column)
    if not (half <= row < frame.geometry.rows - half and half <= column < frame.geometry.columns - half):
        return None
    part = slice(row - half, row + half + 1), slice(column - half, column + half + 1)
    values = frame.values[part][::-1]
    light = np.where(np.isfinite(values), values, frame.background)
    good = frame.usable[part].copy()
    for other in others:
        down, right = round(other.row) - row + half, round(other.column) - column + half
        reach = other.half + 1
        if other is not point and min(down, right) > -reach and max(down, right) <= 2 * half + reach:
            good[max(down - reach, 0) : down + reach + 1, max(right - reach, 0) : right + reach + 1] = False
    return PointPicture(values, frame.variance(light), defocus_waves, good[::-1], frame.psf)
