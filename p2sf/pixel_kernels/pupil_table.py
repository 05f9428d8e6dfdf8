"""Pupils over field and depth from a few fits: Zernike coefficients interpolated over height and vergence.

All points at one distance from the axis share one pupil, rotated (`frequency_grid.turned`). Its coefficients are
smooth functions of that distance and of 1/depth, so that a polynomial through a few Chebyshev nodes gives them all.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import prod
from typing import TypeAlias

import numpy as np

from p2sf.pixel_kernels.frequency_grid import FrequencyPupil, reach_of

FORMS = "phase", "eta", "xi", "weight", "rims"
SAME = 1e-9  # of the farthest node: positions closer than this are the same
PupilShift: TypeAlias = tuple[FrequencyPupil, float]  # a pupil, and its lateral colour in mm


@dataclass(frozen=True, eq=False)
class PupilTable:
    """Pupils of one wavelength between those fitted at heights × vergences, and their lateral colour.

    ``rows``, (heights · vergences, numbers): of each pupil all FORMS, radius, energy and lateral colour in mm.
    ``like`` is a pupil of the highest order, with the largest residual of all.
    """

    heights_mm: tuple[float, ...]
    vergences: tuple[float, ...]
    rows: np.ndarray
    like: FrequencyPupil

    def at(self, height_mm: float, vergence: float) -> PupilShift | None:
        """Return pupil and lateral colour in mm anywhere between the nodes, None outside them."""
        if not (_within(height_mm, self.heights_mm) and _within(vergence, self.vergences)):
            return None
        weights = np.outer(lagrange(self.heights_mm, height_mm), lagrange(self.vergences, vergence)).ravel()
        row, like = weights @ self.rows, self.like
        sizes = [getattr(like, name).size for name in FORMS]
        phase, eta, xi, weight, rims, (radius, energy, shift) = np.split(row, np.cumsum(sizes))
        rims, radius, energy = rims.reshape(like.rims.shape), float(radius), float(energy)
        made = replace(like, phase=phase, eta=eta, xi=xi, weight=weight, rims=rims, radius=radius, energy=energy)
        return replace(made, reach_um=reach_of(made)), float(shift)


def pupil_table(
    make: Callable[[float, float], PupilShift], heights_mm: Iterable[float], vergences: Iterable[float]
) -> PupilTable:
    """Return the table of ``make(height_mm, vergence)`` at these nodes."""
    heights_mm, vergences = tuple(map(float, heights_mm)), tuple(map(float, vergences))
    made = [make(h, v) for h in heights_mm for v in vergences]
    pupils = [pupil for pupil, _ in made]
    like = replace(max(pupils, key=lambda p: p.order), residual_waves=max(p.residual_waves for p in pupils))
    rows = np.array([_row(pupil, shift, like) for pupil, shift in made])
    return PupilTable(heights_mm, vergences, rows, like)


def _row(pupil: FrequencyPupil, shift_mm: float, like: FrequencyPupil) -> np.ndarray:
    """Return all numbers of a pupil; zeros stand for terms of higher degree, the last of each form, that it lacks."""
    forms = (_widened(getattr(pupil, name), getattr(like, name).shape[-1]) for name in FORMS)
    return np.concatenate([*forms, (pupil.radius, pupil.energy, shift_mm)])


def _widened(form: np.ndarray, terms: int) -> np.ndarray:
    """Return coefficients with zeros behind them, flat."""
    lacking = [(0, 0)] * (form.ndim - 1) + [(0, terms - form.shape[-1])]
    return np.pad(form, lacking).ravel()


@lru_cache(maxsize=1024)
def lagrange(nodes: tuple[float, ...], place: float) -> np.ndarray:
    """Return the weights of Lagrange interpolation at a position; they sum to 1.

    A position that differs from a node by rounding only is that node: polynomials of high degree would amplify it.
    """
    away = np.abs(np.array(nodes) - place)
    if away.min() <= SAME * max(abs(nodes[0]), abs(nodes[-1])):
        weights: np.ndarray = np.eye(len(nodes))[away.argmin()]
        return weights
    return np.array([prod((place - other) / (node - other) for other in nodes if other != node) for node in nodes])


def chebyshev(least: float, most: float, count: int) -> np.ndarray:
    """Return ``count`` Chebyshev nodes of the second kind, both ends included, increasing; for one node the middle."""
    middle, half = (least + most) / 2, (most - least) / 2
    return np.array([middle]) if count == 1 else middle - half * np.cos(np.pi * np.arange(count) / (count - 1))


def few_nodes(values: Sequence[float], count: int) -> np.ndarray:
    """Return the values themselves if there are at most ``count``, else ``count`` Chebyshev nodes over their range."""
    return np.asarray(values) if len(values) <= count else chebyshev(values[0], values[-1], count)


def _within(value: float, nodes: tuple[float, ...]) -> bool:
    slack = SAME * max(abs(nodes[0]), abs(nodes[-1]))
    return nodes[0] - slack <= value <= nodes[-1] + slack
