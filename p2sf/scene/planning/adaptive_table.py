"""Tables of pupils with as many nodes along every axis as interpolation between them requires."""

from collections.abc import Callable, Sequence
from itertools import product
from math import inf
from typing import NamedTuple, TypeAlias

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.disc.basis import at_nodes
from p2sf.errors import GeometryError
from p2sf.pixel_kernels.frequency_grid import ORDERS, basis_kinds
from p2sf.pixel_kernels.pupil_stack import PupilStack, stack_pupils
from p2sf.pixel_kernels.pupil_table import Axes, PupilTable, chebyshev, pupil_table

# Numbers of fits along a side of the field, the depths or the colours: each node set contains the previous one.
COUNTS = (2, 3, 5, 9, 17, 33)
FIRST = 1, 1, 0, 0  # of these: aberrations grow with powers of the height, and are nearly linear in depth and colour
LARGEST_ERROR = 3e-2  # of a kernel by interpolation along one axis
NODES = 10, 24  # at which pupils are compared
EDGE = 4.0  # relative error of a kernel per error of places in the pupil, of its radius
ROUNDS, STEP = 4, 1e-4  # of a search, and the step of its differences
DIGITS = 12  # of places, so that a point has one pupil however it was computed

Ends: TypeAlias = tuple[tuple[float, float], tuple[float, float], tuple[float, float], tuple[float, float]]
"""The ends of x, y, vergences and wavelengths."""


class PupilAt(NamedTuple):
    """A point of a field, x and y, one vergence and one wavelength, µm."""

    x_mm: float
    y_mm: float
    vergence: float
    wave_um: float


Fit: TypeAlias = Callable[[Sequence[PupilAt]], tuple[PupilStack, np.ndarray]]
"""From pupils to what describes them, and to points on the sensor, (pupils, 2) mm, as `PupilTable` has them."""


class KnownPupils:
    """Pupils that are known, in one stack, and their points on the sensor."""

    def __init__(self) -> None:
        self._numbers: dict[PupilAt, int] = {}
        self._pupils: PupilStack | None = None
        self._points_mm = np.empty((0, 2))

    @property
    def order(self) -> int:
        """Return the order of their terms, the least if there are none."""
        return self._pupils.order if self._pupils else ORDERS[0]

    def missing(self, pupils: Sequence[PupilAt]) -> list[PupilAt]:
        """Return which are not known, each once."""
        return [at for at in dict.fromkeys(pupils) if at not in self._numbers]

    def add(self, pupils: Sequence[PupilAt], found: PupilStack, points_mm: np.ndarray) -> None:
        """Keep pupils, and their points, (pupils, 2) mm."""
        self._numbers.update((at, len(self._numbers)) for at in pupils)
        self._pupils = stack_pupils([self._pupils, found]) if self._pupils else found
        self._points_mm = np.concatenate([self._points_mm, points_mm])

    def of(self, pupils: Sequence[PupilAt]) -> tuple[PupilStack, np.ndarray]:
        """Return known pupils and their points."""
        assert self._pupils is not None
        chosen = np.array([self._numbers[at] for at in pupils])
        return self._pupils.some(chosen), self._points_mm[chosen]


def adaptive_table(ends: Ends, fit: Fit, target: float) -> tuple[PupilTable | None, float]:
    """Return the table of fitted pupils, and the relative error that it adds to kernels.

    Along each axis nodes are added until pupils midway between them change no kernel by more than ``target``. None if
    more than LARGEST_ERROR is left.
    """
    counts = [start if low < high else -1 for start, (low, high) in zip(FIRST, ends, strict=True)]
    errors, tried = [0.0] * len(ends), [axis for axis, count in enumerate(counts) if count >= 0]
    while True:
        x, y, depths, waves = (_nodes(*end, count).tolist() for end, count in zip(ends, counts, strict=True))
        axes = x, y, depths, waves
        between = {axis: _between(ends, axis, counts[axis] + 1) for axis in tried}
        fit([*grid_of(axes), *(at for several in between.values() for at in several)])  # together; kept for below
        table = pupil_table(axes, *fit(grid_of(axes)))
        for axis, pupils in between.items():
            errors[axis] = _error(table, fit, pupils)
        tried = [axis for axis in tried if errors[axis] > target and counts[axis] < len(COUNTS) - 2]
        if not tried:
            return (table, sum(errors)) if max(errors) <= LARGEST_ERROR else (None, 0.0)
        for axis in tried:
            counts[axis] += 1


def grid_of(axes: Axes) -> list[PupilAt]:
    """Return the pupils at the nodes of a table."""
    return [PupilAt(round(x, DIGITS), round(y, DIGITS), v, wave) for x, y, v, wave in product(*axes)]


def _nodes(low: float, high: float, entry: int) -> np.ndarray:
    return chebyshev(low, high, COUNTS[entry] if entry >= 0 else 1)


def _between(ends: Ends, axis: int, entry: int) -> list[PupilAt]:
    """Return pupils midway between the nodes along one axis, at the ends of the others.

    Of wavelengths only the shortest; between wavelengths, only at the place farthest out.
    """
    sides = [list(dict.fromkeys(end)) for end in ends]
    if axis == len(ends) - 1:
        sides[:2] = ([max(side, key=abs)] for side in sides[:2])
    else:
        del sides[-1][1:]
    sides[axis] = _nodes(*ends[axis], entry)[1::2].tolist()
    x, y, depths, waves = sides
    return grid_of((x, y, depths, waves))


def _error(table: PupilTable, fit: Fit, pupils: Sequence[PupilAt]) -> float:
    """Return the worst error of kernels from a table against those from their own fits."""
    true, landed = fit(pupils)
    try:
        between, there = table.between(*zip(*pupils, strict=True))
        return float(kernel_errors(between, true, UM_PER_MM * (there - landed)).max())
    except GeometryError:  # so inaccurate that they lose light
        return inf


def from_phase(residual_waves: float) -> float:
    """Return the relative L2 error of a PSF whose phase has an RMS error of σ waves: twice the field's own, 2πσ."""
    return 4 * np.pi * residual_waves


def kernel_errors(pupils: PupilStack, true: PupilStack, shifts_um: np.ndarray) -> np.ndarray:
    """Return the relative errors of the kernels of pupils, at most, (pupils,), from what describes them.

    ``shifts_um``: how far they land from the true ones, (pupils, 2). A phase error of σ waves RMS counts as
    `from_phase` has it; of edges and places in the pupil that are off by a part of the radius, the light of a
    ring is missing, twice that part at either side of the field.
    """
    at, ratio = at_nodes(true.basis, NODES), (true.radius / pupils.radius)[:, None]
    across, along = _same_ray(pupils, true)
    of_even, of_odd = _terms_at(pupils, across + ratio * at.nodes.xi, along + ratio * at.nodes.eta)

    def apart(form: np.ndarray, rows: np.ndarray, true_form: np.ndarray, true_rows: np.ndarray) -> np.ndarray:
        found: np.ndarray = (form[:, None] @ rows)[:, 0] - true_form @ true_rows
        return found

    waves = apart(pupils.phase, of_even, true.phase, at.values.fy)
    waves -= true.radius[:, None] * (shifts_um[:, :1] * at.nodes.xi + shifts_um[:, 1:] * at.nodes.eta)
    across = apart(pupils.xi, of_odd, true.xi, at.values.fx)
    along = apart(pupils.eta, of_even, true.eta, at.values.fy)
    inside = (true.xi @ at.values.fx) ** 2 + (true.eta @ at.values.fy) ** 2 <= 1
    area = inside * at.nodes.weight
    area /= area.sum(1, keepdims=True)
    waves -= (area * waves).sum(1, keepdims=True)
    sigma, off = (np.sqrt((area * square).sum(1)) for square in (waves**2, across**2 + along**2))
    found: np.ndarray = np.hypot(from_phase(1.0) * sigma, EDGE * off)
    return found


def _same_ray(pupils: PupilStack, true: PupilStack) -> tuple[np.ndarray, np.ndarray]:
    """Return where in each pupil the ray is that is in the middle of the true one, (pupils, 1) each, by Newton's rule.

    Frequencies are counted from the middle of a pupil, which differs with the stop.
    """
    centre = at_nodes(true.basis, NODES).basis.values(np.zeros(1), np.zeros(1))
    wanted = np.stack([true.xi @ centre.fx, true.eta @ centre.fy], 1)[..., 0]
    place = np.zeros((len(pupils), 2))
    for _ in range(ROUNDS):
        beside = place[:, :, None] + STEP * np.array([[0, 1, 0], [0, 0, 1]])
        of_even, of_odd = _terms_at(pupils, *beside.swapaxes(0, 1))
        found = np.concatenate([pupils.xi[:, None] @ of_odd, pupils.eta[:, None] @ of_even], 1)
        slopes = (found[..., 1:] - found[..., :1]) / STEP
        step = np.linalg.solve(slopes, (wanted - found[..., 0])[..., None])[..., 0]
        place += step
        if np.abs(step).max() < STEP:
            break
    return place[:, :1], place[:, 1:]


def _terms_at(pupils: PupilStack, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the terms of η and of ξ at points of each pupil, (pupils, terms, points) each."""
    kinds = basis_kinds(pupils.order, u, v)
    return pupils.basis.fy.of(kinds), pupils.basis.fx.of(kinds)
