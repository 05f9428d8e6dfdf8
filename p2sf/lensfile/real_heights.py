"""Fields that a file states as real image heights: where their real chief rays land on the sensor."""

from collections.abc import Sequence
from math import hypot, isfinite

import numpy as np

from p2sf.errors import GeometryError, P2SFError
from p2sf.lens.lens import Lens, seen_from
from p2sf.lens.source import source_at
from p2sf.raytrace.aiming import pupil_rays, start
from p2sf.raytrace.surface import Status
from p2sf.raytrace.trace import run

STEP, MOST_STEPS = 1.02, 150  # by which slopes grow until chief rays land beyond the height: up to twenty times
FOUND = 1e-12  # of a slope
NEAR = 1e-6  # of a height, by which one counts as met: far above the rounding of rays


def real_slopes(
    lens: Lens, heights_mm: Sequence[tuple[float, float]], slopes: Sequence[tuple[float, float]], depth_mm: float
) -> list[tuple[float, float]]:
    """Return the slopes (x, y) of the chief rays that land at these places of the sensor, mm.

    ``slopes``: those by first order, from which they are looked for. Raises GeometryError where no ray lands there.
    """
    find = _of_any_lens if lens.misaligned else _along_the_height
    found = []
    for height, slope in zip(heights_mm, slopes, strict=True):
        found.append(find(lens, height, slope, depth_mm) if any(height) else (0.0, 0.0))
    return found


def landing(lens: Lens, slope: tuple[float, float], depth_mm: float) -> np.ndarray:
    """Return where the chief ray of a field lands on the sensor, (x, y) in mm; NaN where it is lost."""
    source = source_at(depth_mm, *slope, lens.reference_wavelength_um)
    turned = seen_from(lens, source.azimuth_deg)
    try:
        rays = pupil_rays(turned, source, np.zeros(1), np.zeros(1))
    except P2SFError:
        return np.full(2, np.nan)
    beam = run(turned, start(rays), rays.index)
    if beam.status[0] != Status.PASSED:
        return np.full(2, np.nan)
    turn = np.deg2rad(source.azimuth_deg)
    x, y = float(beam.x[0]), float(beam.y[0])
    return np.array([x * np.cos(turn) + y * np.sin(turn), y * np.cos(turn) - x * np.sin(turn)])


def _along_the_height(
    lens: Lens, height: tuple[float, float], slope: tuple[float, float], depth_mm: float
) -> tuple[float, float]:
    """Return the slope of a lens of revolution: chief rays of one azimuth land in one direction from the axis."""
    from scipy.optimize import brentq

    goal, size = hypot(*height), hypot(*slope)

    def short_of(part: float) -> float:
        return float(landing(lens, (0.0, part * size), depth_mm)[1]) * side - goal

    side = float(np.sign(landing(lens, (0.0, size * STEP**-MOST_STEPS), depth_mm)[1]))
    below = above = 1.0
    with np.errstate(invalid="ignore"):
        steps = range(MOST_STEPS)
        below = next((below / STEP**k for k in steps if short_of(below / STEP**k) <= 0), np.nan)
        above = next((below * STEP**k for k in steps if not short_of(below * STEP**k) < 0), np.nan)
    if not (isfinite(below) and isfinite(above) and isfinite(short_of(above))):
        raise _no_ray(height)
    part = brentq(short_of, below, above, xtol=FOUND) if above > below else below
    return part * slope[0], part * slope[1]


def _of_any_lens(
    lens: Lens, height: tuple[float, float], slope: tuple[float, float], depth_mm: float
) -> tuple[float, float]:
    """Return the slope of a misaligned lens, in both directions at once."""
    from scipy.optimize import root

    goal, size = np.array(height), hypot(*height)

    def missed(found: np.ndarray) -> np.ndarray:
        away: np.ndarray = np.nan_to_num(landing(lens, (float(found[0]), float(found[1])), depth_mm) - goal, nan=size)
        return away

    found = root(missed, np.array(slope), tol=FOUND)
    if not np.hypot(*missed(found.x)) <= NEAR * size:
        raise _no_ray(height)
    return float(found.x[0]), float(found.x[1])


def _no_ray(height: tuple[float, float]) -> GeometryError:
    return GeometryError(
        "no chief ray lands {height:g} mm from the axis of the sensor, where the file has a field; state it "
        "as an angle",
        height=hypot(*height),
    )
