"""Maps from fields to points of the sensor at every depth of a scene, by chief rays."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import pi

import numpy as np
from numpy.polynomial.chebyshev import chebvander2d

from p2sf.conventions import depth_of
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.misalignment import average_azimuths
from p2sf.lens.source import Source, source_at
from p2sf.paraxial.seidel import coefficients
from p2sf.pixel_kernels.pupil_table import chebyshev, lagrange
from p2sf.pixel_kernels.sensor_points import PlaneFields, SensorMap, landing_mm, landings_mm, sensor_maps
from p2sf.scene.scene import Scene
from p2sf.scene.sensor import Sensor
from p2sf.threads import map_threads

ORDER, REACH = 9, 1.12  # of the polynomial for fields; how far beyond the sensor they are traced
AZIMUTHS, ALONG = 24, 9  # of the fields traced, and how many in each
DEPTHS = 3  # at which they are traced: chief rays of one slope hardly change with the depth
MOST_MISS_PX = 0.1  # allowed error of that polynomial


def scene_maps(lens: Lens, scene: Scene, vergences: Sequence[float], wavelength_um: float) -> list[SensorMap]:
    """Return the maps of a scene's sensor at several vergences, 1/mm, within its depths.

    With rotational symmetry they follow from one line of chief rays. Raises GeometryError unless chief rays
    reach all of the sensor monotonically.
    """
    depths, sensor, clip = [depth_of(v) for v in vergences], scene.sensor, scene.clip
    if not lens.misaligned:
        return sensor_maps(lens, depths, wavelength_um, sensor.corners_mm()[1], clip)
    far, near = scene.vergences(2).tolist()
    series, scale = _series(lens, sensor, (far, near), wavelength_um), _scale_mm(lens, depth_of(far), wavelength_um)
    pairs = zip(depths, vergences, strict=True)
    return [SensorMap(lens, depth, wavelength_um, series.at(v), scale, clip) for depth, v in pairs]


@dataclass(frozen=True, eq=False)
class _FieldSeries:
    """The tables of `PlaneFields` at several vergences, (vergences, 2, y, x)."""

    vergences: tuple[float, ...]
    tables: np.ndarray
    middle_mm: tuple[float, float]
    half_mm: tuple[float, float]

    def at(self, vergence: float) -> PlaneFields:
        """Return the fields at a vergence."""
        across, up = np.tensordot(lagrange(self.vergences, vergence), self.tables, 1)
        return PlaneFields(across, up, self.middle_mm, self.half_mm)


@lru_cache(maxsize=16)
def _series(lens: Lens, sensor: Sensor, ends: tuple[float, float], wavelength_um: float) -> _FieldSeries:
    nodes = chebyshev(min(ends), max(ends), DEPTHS if ends[0] != ends[1] else 1)
    depths, (x, y) = [depth_of(v) for v in nodes.tolist()], sensor.ends_mm()
    scale = _scale_mm(lens, depths[0], wavelength_um)
    # A misaligned lens may shift the whole picture by more than the width of a small sensor.
    middle = float(x.mean()), float(y.mean())
    landed = landing_mm(lens, source_at(depths[0], middle[0] / scale, middle[1] / scale, wavelength_um))
    wide, high = (
        np.sort(_wider(side - (there - wanted)) / scale)
        for side, there, wanted in zip((x, y), landed, middle, strict=True)
    )
    lines = [
        [Source(d, s, wavelength_um, azimuth_deg=a) for s in line for d in depths] for a, line in _lines(wide, high)
    ]
    slopes = [source.slopes_xy for line in lines for source in line]
    places = np.concatenate(map_threads(lambda line: _places(lens, line), lines))
    many = len(depths)
    return _fit_pupils(np.array(slopes)[::many], places.reshape(-1, many, 2), sensor, abs(scale), tuple(nodes.tolist()))


def _lines(x: np.ndarray, y: np.ndarray) -> Iterator[tuple[float, list[float]]]:
    """Yield azimuths, degrees, and slopes along them that fill a rectangle of fields: those of one are traced together.

    All azimuths if the rectangle contains the origin, else those that it spans.
    """
    corners = np.array([complex(up, across) for across in x for up in y])
    inside = x[0] < 0 < x[1] and y[0] < 0 < y[1]
    towards = np.angle(corners.mean())
    about = np.angle(corners * np.exp(-1j * towards))
    angles = np.linspace(-pi, pi, AZIMUTHS + 1)[1:] if inside else np.linspace(about.min(), about.max(), AZIMUTHS)
    for angle in (towards + angles).tolist():
        crossings = np.sort([side / part for side, part in ((x, np.sin(angle)), (y, np.cos(angle))) if part], axis=1)
        first, last = sorted((max(float(crossings[:, 0].max()), 0.0), float(crossings[:, 1].min())))
        yield float(np.rad2deg(angle)), np.linspace(first, last, ALONG).tolist()


def _places(lens: Lens, sources: Sequence[Source]) -> np.ndarray:
    """Return the landing points of chief rays of one azimuth, (source, 2) mm; NaN beyond the field of the lens."""
    try:
        return landings_mm(lens, sources)
    except GeometryError:
        if len(sources) == 1:
            return np.full((1, 2), np.nan)
        half = len(sources) // 2
        return np.concatenate([_places(lens, sources[:half]), _places(lens, sources[half:])])


def _fit_pupils(
    slopes: np.ndarray, places: np.ndarray, sensor: Sensor, scale_mm: float, vergences: tuple[float, ...]
) -> _FieldSeries:
    """Return the polynomials through fields, (n, 2), and their points at each depth, (n, depths, 2) mm or NaN."""
    landed = np.isfinite(places).all((1, 2))
    slopes, places = slopes[landed], places[landed]
    ends = np.stack(sensor.ends_mm())
    if not (len(places) and ((places.min(0) <= ends[:, 0]) & (places.max(0) >= ends[:, 1])).all()):
        raise GeometryError("chief rays do not reach all of the sensor; take a smaller sensor")
    low, high = places.min((0, 1)), places.max((0, 1))
    middle, half = (low + high) / 2, (high - low) / 2
    terms = [a * (ORDER + 1) + b for a in range(ORDER + 1) for b in range(ORDER + 1 - a)]
    tables, worst = np.zeros((len(vergences), 2, (ORDER + 1) ** 2)), 0.0
    for table, reduced in zip(tables, np.moveaxis((places - middle) / half, 1, 0), strict=True):
        columns = chebvander2d(reduced[:, 1], reduced[:, 0], (ORDER, ORDER))[:, terms]
        solved = np.linalg.lstsq(columns, slopes, rcond=1e-12)[0]
        worst = max(worst, float(np.abs(columns @ solved - slopes).max()) * scale_mm / sensor.pixel_mm)
        table[:, terms] = solved.T
    if not worst < MOST_MISS_PX:
        raise GeometryError(
            "chief rays do not land in a smooth order on the sensor, by {miss:.2g} pixels; take a smaller "
            "sensor or align "
            "the lens better",
            miss=worst,
        )
    shape = len(vergences), 2, ORDER + 1, ORDER + 1
    ends_mm = (float(middle[0]), float(middle[1])), (float(half[0]), float(half[1]))
    return _FieldSeries(vergences, tables.reshape(shape), *ends_mm)


def _scale_mm(lens: Lens, depth_mm: float, wavelength_um: float) -> float:
    return float(coefficients(average_azimuths(lens), depth_mm, 1.0, wavelength_um).image_height)


def _wider(ends: np.ndarray) -> np.ndarray:
    middle, half = float(ends.mean()), float(np.ptp(ends)) / 2
    room = (REACH - 1) * float(np.abs(ends).max())
    return np.array([middle - half - room, middle + half + room])
