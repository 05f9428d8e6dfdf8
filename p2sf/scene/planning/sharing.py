"""Reduction of the number of fitted pupils: the others, over field, depths and colours, are interpolated."""

from itertools import product
from math import inf

import numpy as np

from p2sf.errors import GeometryError
from p2sf.pixel_kernels.pupil_table import Axes, PupilTable, chebyshev, pupil_table
from p2sf.scene.field_area import DIGITS
from p2sf.scene.planning.study import Place, PupilAt, Study, distance

# Numbers of fits along a side of the field, the depths or the colours: each node set contains the previous one.
COUNTS = (2, 3, 5, 9, 17)
TARGET_ERROR, LARGEST_ERROR = 1e-3, 3e-2  # allowed relative error of a kernel by interpolation along one axis


def share_pupils(study: Study) -> None:
    """Set the table of pupils of a study, unless kernels would change by more than LARGEST_ERROR.

    Along each axis nodes are added until pupils midway between them change no kernel by more than TARGET_ERROR.
    """
    ends = (
        study.area.x_mm,
        study.area.y_mm,
        (study.ends[0], study.ends[-1]),
        (study.waves_um[0], study.waves_um[-1]),
    )
    # Entries of COUNTS: aberrations grow with powers of the height, and are nearly linear in 1/depth and wavelength.
    counts = [start if low < high else -1 for start, (low, high) in zip((1, 1, 0, 0), ends, strict=True)]
    errors, tried = [0.0] * len(ends), [axis for axis, count in enumerate(counts) if count >= 0]
    while True:
        x, y, depths, waves = (_nodes(*end, count).tolist() for end, count in zip(ends, counts, strict=True))
        axes = x, y, depths, waves
        places = {axis: _between(study, axis, _nodes(*ends[axis], counts[axis] + 1)) for axis in tried}
        # Fitted together and cached for the calls below.
        study.fitted([*_grid(axes), *(study.pupil_at(place) for several in places.values() for place in several)])
        table = pupil_table(axes, *study.fitted(_grid(axes)))
        for axis in tried:
            errors[axis] = _error(study, table, places[axis])
        tried = [axis for axis in tried if errors[axis] > TARGET_ERROR and counts[axis] < len(COUNTS) - 2]
        if not tried:
            break
        for axis in tried:
            counts[axis] += 1
    if max(errors) <= LARGEST_ERROR:
        study.table, study.table_error = table, sum(errors)


def seidel_table(study: Study, table: PupilTable) -> PupilTable:
    """Return the table of the pupils by Seidel coefficients at the same nodes."""
    return pupil_table(table.axes, study.by_seidel(_grid(table.axes)), table.shifts_mm)


def _nodes(low: float, high: float, entry: int) -> np.ndarray:
    return chebyshev(low, high, COUNTS[entry] if entry >= 0 else 1)


def _grid(axes: Axes) -> list[PupilAt]:
    return [PupilAt(round(x, DIGITS), round(y, DIGITS), v, wave) for x, y, v, wave in product(*axes)]


def _between(study: Study, axis: int, finer: np.ndarray) -> list[Place]:
    """Return points midway between the nodes along one axis, and at the ends and the sharpest depths of the others.

    Pixels wider than a sharp kernel hide errors that a blurred kernel shows, and vice versa.
    """
    wave, middles, area = study.waves_um[0], finer[1::2].tolist(), study.area
    sharp = study.sharpest(wave)
    depths = list(dict.fromkeys((sharp[-1], *study.ends)))
    if axis < 2:
        across = dict.fromkeys((area.y_mm, area.x_mm)[axis])
        points = [(middle, other)[:: -1 if axis else 1] for middle in middles for other in across]
        return [study.place((x, y), v, wave) for x, y in points for v in depths]
    if axis == 2:
        tried = dict.fromkeys((*middles, *sharp))
        return [study.place(point, v, wave) for point in area.corners for v in tried]
    return [study.place(area.far, v, w) for v in depths for w in middles]


def _error(study: Study, table: PupilTable, places: list[Place]) -> float:
    """Return the worst error of kernels from a table against those from their own rays."""
    pupils = [study.pupil_at(place) for place in places]
    try:
        between = table.at(*zip(*pupils, strict=True))
    except GeometryError:  # so inaccurate that they lose light
        return inf
    return max(map(distance, study.rendered(places, *between), study.rendered(places, *study.fitted(pupils))))
