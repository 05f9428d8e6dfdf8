"""Pupils over field, depth and colour from a few fits: Zernike coefficients interpolated between them.

All points at one distance from the axis share one pupil, rotated (`pupil_stack.turned`). Its coefficients are
smooth functions of that distance, of 1/depth and of the wavelength, so that polynomials through a few Chebyshev nodes
give them all.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import prod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from p2sf.errors import GeometryError
from p2sf.pixel_kernels.pupil_stack import FORMS, PupilStack, with_reach

SAME = 1e-9  # of the farthest node: positions closer than this are the same


@dataclass(frozen=True, eq=False)
class PupilTable:
    """Pupils between those fitted at heights × vergences × wavelengths, in this order, and their lateral colour, mm.

    ``rows``, (fits, numbers): of each pupil all FORMS, radius, energy and lateral colour. ``like``: the fitted ones.
    """

    heights_mm: tuple[float, ...]
    vergences: tuple[float, ...]
    waves_um: tuple[float, ...]
    rows: np.ndarray
    like: PupilStack

    @property
    def fits(self) -> int:
        """Return how many pupils were fitted."""
        return len(self.rows)

    @property
    def shifts_mm(self) -> np.ndarray:
        """Return the lateral colour of the fitted pupils, mm, (fits,)."""
        shifts: np.ndarray = self.rows[:, -1]
        return shifts

    def covers(self, height_mm: float, vergence: float) -> bool:
        """Return whether a height and a depth lie between the nodes."""
        return _within(height_mm, self.heights_mm) and _within(vergence, self.vergences)

    def at(self, heights_mm: ArrayLike, vergences: ArrayLike, waves_um: ArrayLike) -> tuple[PupilStack, np.ndarray]:
        """Return pupils and lateral colour in mm, (pupils,), between the nodes, from numbers or arrays of each axis.

        Raises GeometryError outside the nodes.
        """
        places = np.broadcast_arrays(*map(np.atleast_1d, (heights_mm, vergences, waves_um)))
        axes = zip((self.heights_mm, self.vergences, self.waves_um), places, strict=True)
        weights = [np.stack([_weights(nodes, place) for place in column.tolist()]) for nodes, column in axes]
        rows = np.einsum("kh,kv,kw->khvw", *weights).reshape(len(weights[0]), -1) @ self.rows
        forms: dict[str, Any] = {}
        like = self.like
        for name in FORMS:
            size = getattr(like, name)[0].size
            forms[name], rows = rows[:, :size].reshape(len(rows), *getattr(like, name).shape[1:]), rows[:, size:]
        radius, energy, shifts = rows.T
        residual = np.full(len(radius), like.residual_waves.max())
        waves = np.sign(like.wavelength_um[0]) * places[2]
        made = replace(like, **forms, radius=radius, energy=energy, residual_waves=residual, wavelength_um=waves)
        return with_reach(made), shifts


def pupil_table(
    nodes: tuple[Sequence[float], Sequence[float], Sequence[float]], pupils: PupilStack, shifts_mm: np.ndarray
) -> PupilTable:
    """Return the table of pupils and lateral colours at heights (mm) × vergences × wavelengths (µm), these fastest."""
    heights, vergences, waves = (tuple(map(float, axis)) for axis in nodes)
    forms = (getattr(pupils, name).reshape(len(pupils), -1) for name in FORMS)
    rows = np.concatenate([*forms, *(column[:, None] for column in (pupils.radius, pupils.energy, shifts_mm))], axis=1)
    return PupilTable(heights, vergences, waves, rows, pupils)


def _weights(nodes: tuple[float, ...], place: float) -> np.ndarray:
    if not _within(place, nodes):
        raise GeometryError(
            "{place:.6g} lies outside the pupils fitted from {low:.6g} to {high:.6g}; plan the scene again",
            place=place,
            low=nodes[0],
            high=nodes[-1],
        )
    return lagrange(nodes, place)


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


def _within(value: float, nodes: tuple[float, ...]) -> bool:
    slack = SAME * max(abs(nodes[0]), abs(nodes[-1]))
    return nodes[0] - slack <= value <= nodes[-1] + slack
