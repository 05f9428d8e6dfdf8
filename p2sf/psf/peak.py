"""The peak of a continuous picture between its samples, and so the Strehl ratio for any pixel and window.

The intensity holds no frequency above 2s, s being the highest of the pupil's. Samples up to 1/(4s) apart determine it,
and it is interpolated about each of their maxima (`_tops`); Newton's method on the sum itself goes on from the highest.
Where the window does not hold the whole blur, or samples are farther apart, those of a coarse sum over the blur serve.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from math import ceil, hypot, sqrt

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.figures.enlarge import windowed_sinc
from p2sf.pupil.plane_waves import Waves
from p2sf.threads import one_blas_thread

FINE = 5  # samples per period of the pupil's highest frequency on a separate grid for the search
ENOUGH_SAMPLES = 4  # of them that determine the picture
MOST_SAMPLES = 1024  # along a side of that grid
BORDER = 1.5  # periods around the farthest ray where the peak may be
DARK = 0.02  # of the brightest sample: a window with so dark a border contains the blur
TAPS, WINDOWING = 8, 6.0  # samples to either side that interpolate, and the shape of the Kaiser window over them
OFFSETS = np.linspace(-0.75, 0.75, 13)  # of a sample's spacing about each maximum of the samples
LOWEST = 0.5  # of the brightest sample: the lowest maximum of samples that can belong to the peak (cos² of π/4)
MOST_MAXIMA = 256  # that are interpolated
TOO_CLOSE = 2e-3  # of the highest: maxima that interpolation, good to 5e-4, and rounding do not tell apart
ROUGHLY = 0.1  # the same of waves that only resemble those of the picture
MOST_CLIMBS = 4  # from those
MOST_IN_PREVIEW = 2**12  # most waves for a climb in a preview; with more it takes the top by interpolation
CLIMB_STEPS = 12  # of Newton's method
MOST_WHILE_CLIMBING = 2**22  # waves times steps, beyond which fewer steps have to do: a second for all
MANY_WAVES = 2**14  # from which on plane ones say where to climb: of a small Fresnel number there are fewer
SEARCH_SECONDS = 1.0  # estimated, that a sum of fewer spherical ones may take to say so
ENOUGH = {"preview": 1e-3, "settled": 1e-4}  # of the peak: the next step gains about the square of it
ROUNDING = 1e-9
MIRRORED = 4e-6  # of the brightest sample, by which mirror images in float32 differ


@dataclass(frozen=True)
class Peak:
    """The largest intensity of a continuous picture, and where it is, µm from the chief ray.

    ``other_peaks``: how many maxima are as high to TOO_CLOSE, of which one might be the higher, at another distance
    from the chief ray, since mirror images and points of one ring are alike.
    """

    value: float
    x_um: float
    y_um: float
    other_peaks: int = 0


@one_blas_thread
def peak_of(
    intensity: np.ndarray,
    pixel_um: float,
    waves: Waves,
    reaching: Callable[[float], Waves | None],
    quality: str = "settled",
) -> Peak:
    """Return the peak of a picture with samples ``intensity`` (y, x) in a window, by the sum over the pupil.

    ``waves``: what was sampled. ``reaching`` returns waves that resolve the phase up to a distance from the chief ray,
    µm, or None if these are too many. The peak is sought wherever rays land, also outside the window, unless the window
    has a dark border or too many waves are needed. A "preview" climbs from the best place in the window only.
    """
    axis, brightest = centred_axis(intensity.shape[-1], pixel_um), sampled_peak(intensity, pixel_um)
    if not waves.spread:  # a single wave has uniform intensity
        return brightest
    if quality == "preview":
        top = top_in_window(intensity, pixel_um, waves.spread)
        return climb(waves, top.x_um, top.y_um, quality) if waves.fx.size <= MOST_IN_PREVIEW else top
    half = waves.blur_um + BORDER / waves.spread
    held = half <= -axis[0] or _border(intensity) < DARK * intensity.max()
    if held and _determined(pixel_um, waves.spread):
        return _highest(waves, _tops(intensity, axis, waves.spread), TOO_CLOSE)
    wide = waves if hypot(half, half) <= waves.reach_um else reaching(hypot(half, half))
    if wide is None:
        wide, half = waves, waves.reach_um / sqrt(2)
    if not half:  # one sample, and too many waves for any place beside it
        return brightest
    side = min(MOST_SAMPLES, ceil(2 * half * FINE * waves.spread))
    grid = centred_axis(side, 2 * half / side)
    where = wide.plane if wide.fx.size > MANY_WAVES else wide.within(SEARCH_SECONDS)
    tops = _tops(where.intensity(grid, grid, np.float32), grid, waves.spread)
    found = _highest(wide, tops, TOO_CLOSE if where is wide else ROUGHLY)
    if found.value >= brightest.value:
        return found
    return climb(wide, brightest.x_um, brightest.y_um)


def _determined(pitch_um: float, spread: float) -> bool:
    """Return whether samples so far apart determine the picture."""
    return pitch_um * spread * ENOUGH_SAMPLES <= 1 + ROUNDING


def top_in_window(intensity: np.ndarray, pixel_um: float, spread: float) -> Peak:
    """Return the highest place of a window, (y, x), to some 5e-4, where samples determine it; else the brightest one.

    ``spread``: the highest frequency of the pupil, cycles per µm.
    """
    if not _determined(pixel_um, spread):
        return sampled_peak(intensity, pixel_um)
    return _tops(intensity, centred_axis(intensity.shape[-1], pixel_um), spread)[0]


def sampled_peak(intensity: np.ndarray, pixel_um: float) -> Peak:
    """Return the brightest of the samples (y, x) of a window."""
    axis = centred_axis(intensity.shape[-1], pixel_um)
    row, column = divmod(int(np.argmax(intensity)), intensity.shape[-1])
    return Peak(float(intensity.max()), float(axis[column]), float(axis[row]))


def _tops(intensity: np.ndarray, axis: np.ndarray, spread: float) -> list[Peak]:
    """Return the picture's maxima near those of its samples (y, x), highest first, to some 5e-4 of the highest.

    Where samples do not determine the picture they are those of the samples. One of two mirror images is left out.
    """
    row, column = _maxima(intensity)
    value, x, y = intensity[row, column].astype(float), axis[column], axis[row]
    if axis.size > 1 and _determined(axis[1] - axis[0], spread):
        value, aside, up = _interpolated(intensity, row, column)
        x, y = x + (axis[1] - axis[0]) * aside, y + (axis[1] - axis[0]) * up
    order = np.argsort(value)[::-1]
    return [Peak(float(value[i]), float(x[i]), float(y[i])) for i in order]


def _maxima(intensity: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return rows and columns of the samples that no neighbour exceeds, of those that may be near the peak."""
    flat = np.flatnonzero((intensity == _brightest_about(intensity)) & (intensity >= LOWEST * intensity.max()))
    flat = flat[np.argsort(intensity.ravel()[flat])[::-1][:MOST_MAXIMA]]
    row, column = np.divmod(flat, intensity.shape[-1])
    across = 2 * (intensity.shape[-1] // 2) - column
    there = np.minimum(across, intensity.shape[-1] - 1)
    twin = np.abs(intensity[row, there] - intensity[row, column]) <= MIRRORED * intensity.max()
    kept = ~(twin & (there == across) & (column < across))
    return row[kept], column[kept]


def _brightest_about(intensity: np.ndarray) -> np.ndarray:
    """Return the largest value among each sample and its eight neighbours: along rows, then along columns."""
    brightest = intensity
    for _ in range(2):
        before, brightest = brightest.T, brightest.T.copy(order="K")
        np.maximum(brightest[1:], before[:-1], out=brightest[1:])
        np.maximum(brightest[:-1], before[1:], out=brightest[:-1])
    return brightest


def _border(intensity: np.ndarray) -> float:
    """Return the brightest sample on the border of a window."""
    return max(float(line.max()) for line in (intensity[0], intensity[-1], intensity[:, 0], intensity[:, -1]))


def _interpolated(
    intensity: np.ndarray, row: np.ndarray, column: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the tops of the picture about samples, and their offsets in x and y, in spacings of the samples."""
    near = np.arange(-TAPS, TAPS + 1)
    wide = np.pad(intensity, TAPS, "symmetric" if min(intensity.shape) > TAPS else "edge")  # light may go on beyond
    patches = wide[(row[:, None] + TAPS + near)[:, :, None], (column[:, None] + TAPS + near)[:, None, :]]
    fine = _kernel() @ patches @ _kernel().T
    count, number = np.arange(row.size), OFFSETS.size
    at = fine[:, 1:-1, 1:-1].reshape(row.size, -1).argmax(1)
    up, aside = (k + 1 for k in np.divmod(at, number - 2))
    value = middle = fine[count, up, aside]
    step, places = OFFSETS[1] - OFFSETS[0], []
    for before, after in (
        (fine[count, up, aside - 1], fine[count, up, aside + 1]),
        (fine[count, up - 1, aside], fine[count, up + 1, aside]),
    ):
        bend = np.minimum(before + after - 2 * middle, -ROUNDING * float(intensity.max()))
        part = np.clip((before - after) / (2 * bend), -0.5, 0.5)
        value = value - (before - after) * part / 4
        places.append(step * part)
    return value, OFFSETS[aside] + places[0], OFFSETS[up] + places[1]


@lru_cache(maxsize=1)
def _kernel() -> np.ndarray:
    """Return the weights of samples for a band-limited function at offsets, (offsets, 2·TAPS + 1)."""
    return windowed_sinc(OFFSETS[:, None] - np.arange(-TAPS, TAPS + 1), TAPS + 1, WINDOWING)


def _highest(waves: Waves, tops: list[Peak], told: float) -> Peak:
    """Return the highest peak by climbing from the highest top, and from others that may be as high.

    ``told``: the share of the highest by which tops have to differ to be told apart.
    """
    close = [top for top in tops if top.value >= tops[0].value * (1 - told)]
    most = max(1, min(MOST_CLIMBS, MOST_WHILE_CLIMBING // (2 * waves.fx.size)))
    found = [climb(waves, top.x_um, top.y_um) for top in close[:most]]
    highest = max(found, key=lambda peak: peak.value)
    alike = [one for one in found + close[most:] if one.value >= highest.value * (1 - TOO_CLOSE)]
    radius, other_peaks = [hypot(highest.x_um, highest.y_um)], 0
    for one in alike:
        away = hypot(one.x_um, one.y_um)
        if all(abs(away - other) > 1 / (8 * waves.spread) for other in radius):
            radius.append(away)
            other_peaks += 1
    return replace(highest, other_peaks=other_peaks)


def climb(waves: Waves, x: float, y: float, quality: str = "settled") -> Peak:
    """Return the maximum near a point; no step exceeds half of the resolution of the pupil."""
    most = 1 / (8 * waves.spread)
    for _ in range(max(2, min(CLIMB_STEPS, MOST_WHILE_CLIMBING // waves.fx.size))):
        value, step_x, step_y, gain = waves.near(x, y)
        part = min(1.0, most / max(hypot(step_x, step_y), 1e-300))
        x, y = x + part * step_x, y + part * step_y
        if part == 1 and gain < ENOUGH[quality] * value:
            return Peak(float(value + gain), float(x), float(y))
    return Peak(float(waves.near(x, y)[0]), float(x), float(y))
