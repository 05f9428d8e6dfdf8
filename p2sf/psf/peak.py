"""The peak of a continuous picture between its samples, and so the Strehl ratio for any pixel and window.

The intensity holds no frequency above 2s, s being the highest of the pupil's, and is not negative. If M is its maximum,
it is at least M·cos²(2πs·d) at a distance d from there, d ≤ 1/(4s), since a function bounded by 1 follows a cosine at
the fastest (Duffin & Schaeffer 1938, of 2I/M − 1). So a sample bounds the picture around it, and Newton's method starts
from the local maxima of the samples, highest first, until no other can lead higher. The search is complete except for
four savings: it stays inside a window with a dark border (DARK), tries at most MOST_CLIMBS maxima, and fewer if a
climb is expensive (MOST_TERMS), or none of very many waves (MANY_WAVES).
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cache, partial
from math import ceil, cos, hypot, pi, sqrt

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.psf.sums.plane_waves import Waves
from p2sf.threads import one_blas_thread

FINE = 6  # samples per period of the pupil's highest frequency on a separate grid for the search
ENOUGH_SAMPLES = 4  # of them that suffice if the samples of the picture are used instead
MOST_SAMPLES = 512  # along a side of that grid
BORDER = 1.5  # periods around the farthest ray where the peak may be
DARK = 0.02  # of the brightest sample: a window with so dark a border contains the blur
MOST_CLIMBS = 16
MOST_TERMS = 2**17  # waves times climbs, after the first: some tens of milliseconds
MOST_IN_PREVIEW = 2**12  # most waves for a climb in a preview, which otherwise takes its best sample
CLIMB_STEPS = 12  # of Newton's method
MOST_WHILE_CLIMBING = 2**22  # waves times steps, beyond which fewer steps have to do: a second for all
MANY_WAVES = 2**14  # from which on plane ones say where to climb: of a small Fresnel number there are fewer
SEARCH_SECONDS = 1.0  # estimated, that a sum of fewer spherical ones may take to say so
ENOUGH = {"preview": 1e-3, "settled": 1e-6}  # of the peak: the next step gains about the square of it
ROUNDING = 1e-9
_later: ContextVar[bool] = ContextVar("later", default=False)


@contextmanager
def peaks_on_demand() -> Iterator[None]:
    """Defer the search for the peaks of PSFs made within until they are read: it takes half of their time."""
    before = _later.set(True)
    try:
        yield
    finally:
        _later.reset(before)


def look_later() -> bool:
    """Return whether this is within `peaks_on_demand`."""
    return _later.get()


@dataclass(frozen=True)
class Peak:
    """The largest intensity of a continuous picture, and where it is, µm from the chief ray."""

    value: float
    x_um: float
    y_um: float


def peak_on_demand(
    intensity: np.ndarray,
    pixel_um: float,
    waves: Waves,
    reaching: Callable[[float], Waves | None],
    quality: str = "settled",
) -> Callable[[], Peak]:
    """Return a function that returns `peak_of`; for a "preview", or if `look_later`, it searches when called."""
    find = partial(peak_of, intensity, pixel_um, waves, reaching, quality)
    if look_later() or (quality == "preview" and waves.fx.size <= MOST_IN_PREVIEW):
        return cache(find)
    found = find()
    return lambda: found


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
    has a dark border or too many waves are needed. A "preview" climbs from the best sample only.
    """
    axis, brightest = centred_axis(intensity.shape[-1], pixel_um), sampled_peak(intensity, pixel_um)
    if not waves.spread:  # a single wave has uniform intensity
        return brightest
    if quality == "preview":
        few = waves.fx.size <= MOST_IN_PREVIEW
        return climb(waves, brightest.x_um, brightest.y_um, quality) if few else brightest
    half = waves.blur_um + BORDER / waves.spread
    held = half <= -axis[0] or _border(intensity) < DARK * intensity.max()
    if held and pixel_um * waves.spread * ENOUGH_SAMPLES <= 1 + ROUNDING:
        return _highest(waves, _candidates(intensity, axis, waves.spread))
    wide = waves if hypot(half, half) <= waves.reach_um else reaching(hypot(half, half))
    if wide is None:
        wide, half = waves, waves.reach_um / sqrt(2)
    if not half:  # one sample, and too many waves for any place beside it
        return brightest
    side = min(MOST_SAMPLES, ceil(2 * half * FINE * waves.spread))
    grid = centred_axis(side, 2 * half / side)
    where = wide.plane if wide.fx.size > MANY_WAVES else wide.within(SEARCH_SECONDS)
    starts = _candidates(where.intensity(grid, grid, np.float32), grid, waves.spread)
    own = brightest.value, brightest.x_um, brightest.y_um
    return _highest(wide, [own, *starts] if own[0] > starts[0][0] else starts)


def sampled_peak(intensity: np.ndarray, pixel_um: float) -> Peak:
    """Return the brightest of the samples (y, x) of a window."""
    index = int(np.argmax(intensity))
    return Peak(float(intensity.max()), *_place(intensity, centred_axis(intensity.shape[-1], pixel_um), index))


def _place(intensity: np.ndarray, axis: np.ndarray, index: int) -> tuple[float, float]:
    row, column = divmod(index, intensity.shape[-1])
    return float(axis[column]), float(axis[row])


def _candidates(intensity: np.ndarray, axis: np.ndarray, spread: float) -> list[tuple[float, float, float]]:
    """Return the bound of a maximum about a sample, x and y, of the samples near which the highest one can be."""
    away = min((axis[1] - axis[0]) / sqrt(2), 1 / (8 * spread)) if axis.size > 1 else 0.0
    least = cos(2 * pi * spread * away) ** 2
    indices = np.flatnonzero((intensity == _brightest_about(intensity)) & (intensity >= least * intensity.max()))
    indices = indices[np.argsort(_parabola_tops(intensity, indices))[::-1]]
    return [(float(intensity.ravel()[i]) / least, *_place(intensity, axis, int(i))) for i in indices[:MOST_CLIMBS]]


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


def _parabola_tops(intensity: np.ndarray, indices: np.ndarray) -> np.ndarray:
    """Return the tops of parabolas through samples and their neighbours; samples on the border are unchanged.

    ``indices``: (n,) flat ones.
    """
    values, (rows, columns) = intensity.ravel(), intensity.shape
    row, column = np.divmod(indices, columns)
    inside = (0 < row) & (row < rows - 1) & (0 < column) & (column < columns - 1)
    tops: np.ndarray = values[indices].astype(float)
    inner, flat = indices[inside], -ROUNDING * float(intensity.max())
    middle = tops[inside]
    for step in (columns, 1):
        before, after = values[inner - step].astype(float), values[inner + step].astype(float)
        bend = np.minimum(before + after - 2 * middle, flat)
        tops[inside] -= (after - before) ** 2 / (8 * bend)
    return tops


def _highest(waves: Waves, starts: list[tuple[float, float, float]]) -> Peak:
    """Return the highest peak by climbing from each point that can lead higher, the most promising first.

    With many waves only the most promising few points are tried.
    """
    highest = climb(waves, *starts[0][1:])
    for bound, x, y in starts[1 : max(1, MOST_TERMS // waves.fx.size)]:
        if bound <= highest.value:
            continue
        found = climb(waves, x, y)
        highest = max(highest, found, key=lambda peak: peak.value)
    return highest


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
