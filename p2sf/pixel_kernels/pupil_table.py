"""Pupils of a whole field and depth from few: Zernike coefficients interpolated over height and vergence.

The sensor's points at one distance from the axis share one pupil, turned (`pupilmap.turned`); along that line and with
1/depth its coefficients are smooth, so that a polynomial through a few Chebyshev nodes has them all.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from math import prod

import numpy as np

from p2sf.pixel_kernels.frequency_grid import FrequencyPupil, reach_of

FORMS = "phase", "eta", "xi"
SAME = 1e-9  # of the farthest node: places as near as this are one
Made = tuple[FrequencyPupil, float]  # and its lateral colour in mm


@dataclass(frozen=True, eq=False)
class PupilTable:
    """Pupils of one wavelength between those fitted at heights × vergences, and their lateral colour.

    ``rows``, (heights · vergences, numbers): of each pupil phase, η and ξ, radius, light and lateral colour in mm.
    ``like`` is a pupil of the highest order, with the worst residual of all.
    """

    heights_mm: tuple[float, ...]
    vergences: tuple[float, ...]
    rows: np.ndarray
    like: FrequencyPupil

    def at(self, height_mm: float, vergence: float) -> Made | None:
        """Return pupil and lateral colour in mm anywhere between the nodes, None beyond them."""
        if not (_within(height_mm, self.heights_mm) and _within(vergence, self.vergences)):
            return None
        weights = np.outer(lagrange(self.heights_mm, height_mm), lagrange(self.vergences, vergence)).ravel()
        row, like = weights @ self.rows, self.like
        even = like.phase.size
        phase, eta, xi = row[:even], row[even : 2 * even], row[2 * even : -3]
        radius, light, shift = row[-3:].tolist()
        forms = {"phase": phase, "eta": eta, "xi": xi, "reach_um": reach_of(like.order, phase, radius)}
        return replace(like, **forms, radius=radius, light=light), shift


def pupil_table(make: Callable[[float, float], Made], heights_mm, vergences) -> PupilTable:
    """Return the table of ``make(height_mm, vergence)`` at these nodes."""
    made = [make(float(h), float(v)) for h in heights_mm for v in vergences]
    pupils = [pupil for pupil, _ in made]
    like = replace(max(pupils, key=lambda p: p.order), residual_waves=max(p.residual_waves for p in pupils))
    rows = np.array([_row(pupil, shift, like) for pupil, shift in made])
    return PupilTable(tuple(map(float, heights_mm)), tuple(map(float, vergences)), rows, like)


def _row(pupil: FrequencyPupil, shift_mm: float, like: FrequencyPupil) -> np.ndarray:
    """Return all numbers of a pupil; the terms of higher degree that it lacks come last in each form and are zero."""
    forms = (np.pad(getattr(pupil, n), (0, getattr(like, n).size - getattr(pupil, n).size)) for n in FORMS)
    return np.concatenate([*forms, (pupil.radius, pupil.light, shift_mm)])


@lru_cache(maxsize=1024)
def lagrange(nodes: tuple[float, ...], place: float) -> np.ndarray:
    """Return the weights of Lagrange's interpolation at a place; they sum to 1.

    A place that is a node but for rounding is that node: polynomials of high degree would tell them apart by miles.
    """
    away = np.abs(np.array(nodes) - place)
    if away.min() <= SAME * max(abs(nodes[0]), abs(nodes[-1])):
        return np.eye(len(nodes))[away.argmin()]
    return np.array([prod((place - other) / (node - other) for other in nodes if other != node) for node in nodes])


def chebyshev(least: float, most: float, count: int) -> np.ndarray:
    """Return ``count`` nodes of Chebyshev's second kind with both ends, increasing; the middle for one."""
    middle, half = (least + most) / 2, (most - least) / 2
    return np.array([middle]) if count == 1 else middle - half * np.cos(np.pi * np.arange(count) / (count - 1))


def few_nodes(values, count: int) -> np.ndarray:
    """Return the values themselves where they are no more than ``count``, else so many nodes over them."""
    return np.asarray(values) if len(values) <= count else chebyshev(values[0], values[-1], count)


def _within(value: float, nodes) -> bool:
    slack = SAME * max(abs(nodes[0]), abs(nodes[-1]))
    return nodes[0] - slack <= value <= nodes[-1] + slack
