"""Focal surfaces, distortion and the distortion grid over the field, by exact rays and by the third order."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from p2sf.conventions import degrees_from_slope, slope_from_degrees
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import Stop
from p2sf.paraxial.seidel import coefficients
from p2sf.raytrace.field_curves import Foci, Heights, heights, real_foci, seidel_foci
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.state.scales import nice

FIELDS = {"preview": 13, "settled": 25}
GRID = 9  # lines each way over the square inside the field's circle
AT_LEAST_DEG = 0.05
SEEN = 0.04  # a shift of a grid's corner by this share can be seen


@dataclass(frozen=True)
class FieldView:
    """Fields from the axis to ``field_deg[-1]``, their foci (mm behind the sensor) and heights (mm).

    ``straight`` and ``bent``: (points, 2) x and y of a square grid inside the field's circle, 1 at its edge, as it is
    and as the lens draws it with its distortion ``exaggerated`` so many times; NaN between lines.
    """

    field_deg: np.ndarray
    real: Foci
    third: Foci
    heights: Heights
    straight: np.ndarray
    bent: np.ndarray
    exaggerated: int


def field_curves(live: Live) -> View[FieldView]:
    """Return the curves of the lens at this depth and wavelength; the same object while only the field moves."""
    s = live.setup
    rim = int(s.stop.surface), float(s.stop.semi_diameter)
    return View(curves_of(s.lens, replace(s.source, field_slope=0.0), rim, widest_slope(live), FIELDS[live.quality]))


@lru_cache(maxsize=4)
def curves_of(lens: Lens, source: Source, rim: tuple[int, float], widest: float, count: int) -> FieldView:
    """Return the curves of ``count`` fields up to a slope; ``rim``: the stop's surface (from 1) and radius in mm."""
    stop = Stop(np.asarray(rim[0]), np.asarray(rim[1]), np.asarray(rim[0]), "file")
    slopes = np.linspace(0.0, widest, count)
    c = coefficients(lens, source.depth_mm, slopes, source.wavelength_um, stop)
    landed = heights(lens, source, slopes, stop)
    foci = real_foci(lens, source, slopes, stop), seidel_foci(c)
    times = exaggeration(landed.distortion)
    ideal = landed.paraxial - landed.middle
    lines = grid(ideal, 0 * landed.distortion), grid(ideal, times * landed.distortion)
    return FieldView(degrees_from_slope(slopes), *foci, landed, *lines, times)


def exaggeration(distortion: np.ndarray) -> int:
    """Return how many times a distortion is drawn, so that it can be seen: 1, 2, 5, 10 …, up to a thousand."""
    most = np.abs(distortion[np.isfinite(distortion)]).max(initial=0.0)
    return 1 if most >= SEEN else round(min(1000.0, nice(SEEN / max(most, 1e-9))))


def widest_slope(live: Live) -> float:
    """Return the field's edge: that of the lens's file, or the present field where it lies beyond."""
    degrees = (AT_LEAST_DEG, live.setup.lens.widest_field_deg, abs(live.state.optics.field_deg))
    return float(slope_from_degrees(max(degrees)))


def grid(paraxial: np.ndarray, distortion: np.ndarray) -> np.ndarray:
    """Return the lines of a square grid whose corners lie at the field's edge, moved along their radii."""
    edge = paraxial[-1] or 1.0
    line, along = np.linspace(-1, 1, GRID) / np.sqrt(2), np.linspace(-1, 1, 2 * GRID + 1) / np.sqrt(2)
    x, y = np.meshgrid(np.append(along, np.nan), line)
    points = np.stack([np.concatenate([x, y]).ravel(), np.concatenate([y, x]).ravel()], axis=-1)
    radius, known = np.hypot(*points.T), np.isfinite(distortion)
    moved = np.interp(radius, (paraxial / edge)[known], distortion[known], right=np.nan)
    return points * (1 + moved)[:, None]
