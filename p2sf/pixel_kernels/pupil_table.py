"""Pupils over field, depth and colour from a few fits: Zernike coefficients interpolated between them.

The coefficients are smooth functions of the place on the sensor, of 1/depth and of the wavelength, so that polynomials
through a few Chebyshev nodes give them all. All points at one distance from an axis of symmetry share one pupil,
rotated (`turned_powers`), so that there one column of places is enough.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from p2sf.errors import GeometryError
from p2sf.pixel_kernels.pupil_stack import FORMS, PupilStack, with_reach

SAME = 1e-9  # of the farthest node: positions closer than this are the same


@dataclass(frozen=True, eq=False)
class PupilTable:
    """Pupils between those fitted at x × y × vergences × wavelengths, in this order, and where they land.

    ``rows``, (fits, numbers): of each pupil all FORMS, radius, energy and how far from its place it lands, x and y, mm.
    ``like``: the fitted ones.
    """

    x_mm: tuple[float, ...]
    y_mm: tuple[float, ...]
    vergences: tuple[float, ...]
    waves_um: tuple[float, ...]
    rows: np.ndarray
    like: PupilStack

    @property
    def fits(self) -> int:
        """Return how many pupils were fitted."""
        return len(self.rows)

    @property
    def axes(self) -> "Axes":
        """Return the nodes."""
        return self.x_mm, self.y_mm, self.vergences, self.waves_um

    @property
    def shifts_mm(self) -> np.ndarray:
        """Return how far the fitted pupils land from their places, mm, (fits, 2)."""
        shifts: np.ndarray = self.rows[:, -2:]
        return shifts

    def covers(self, x_mm: ArrayLike, y_mm: ArrayLike, vergence: float) -> bool:
        """Return whether places and a depth lie between the nodes."""
        axes = zip(self.axes, (x_mm, y_mm, vergence), strict=False)
        return all(not _outside(nodes, np.asarray(values)).any() for nodes, values in axes)

    def at(
        self, x_mm: ArrayLike, y_mm: ArrayLike, vergences: ArrayLike, waves_um: ArrayLike
    ) -> tuple[PupilStack, np.ndarray]:
        """Return pupils between the nodes, and how far they land from their places, (pupils, 2) mm along x and y.

        Each axis takes a number or an array.

        Raises GeometryError outside the nodes, and for pupils too distorted.
        """
        found, shifts = self.between(x_mm, y_mm, vergences, waves_um)
        return with_reach(found), shifts

    def between(
        self, x_mm: ArrayLike, y_mm: ArrayLike, vergences: ArrayLike, waves_um: ArrayLike
    ) -> tuple[PupilStack, np.ndarray]:
        """Return the pupils of `at`, whose reach is not known."""
        places = np.broadcast_arrays(*map(np.atleast_1d, (x_mm, y_mm, vergences, waves_um)))
        axes = zip(self.axes, places, strict=True)
        weights = [_weights(nodes, column) for nodes, column in axes]
        rows = np.einsum("kx,ky,kv,kw->kxyvw", *weights).reshape(len(weights[0]), -1) @ self.rows
        forms: dict[str, Any] = {}
        like = self.like
        for name in FORMS:
            size = getattr(like, name)[0].size
            forms[name], rows = rows[:, :size].reshape(len(rows), *getattr(like, name).shape[1:]), rows[:, size:]
        radius, energy, *shifts = rows.T
        residual = np.full(len(radius), like.residual_waves.max())
        waves = np.sign(like.wavelength_um[0]) * places[3]
        sizes = {"energy": energy, "reach_um": np.nan * radius, "residual_waves": residual, "wavelength_um": waves}
        return replace(like, **forms, radius=radius, **sizes), np.stack(shifts, axis=1)


Axes = tuple[Sequence[float], Sequence[float], Sequence[float], Sequence[float]]  # x, y, vergences, wavelengths


def pupil_table(nodes: Axes, pupils: PupilStack, shifts_mm: np.ndarray) -> PupilTable:
    """Return the table of pupils, and of how far they land from their places, (pupils, 2) mm.

    At x × y (mm) × vergences × wavelengths (µm), these fastest.
    """
    x, y, vergences, waves = (tuple(map(float, axis)) for axis in nodes)
    forms = (getattr(pupils, name).reshape(len(pupils), -1) for name in FORMS)
    rows = np.concatenate(
        [*forms, *(column[:, None] for column in (pupils.radius, pupils.energy, *shifts_mm.T))], axis=1
    )
    return PupilTable(x, y, vergences, waves, rows, pupils)


def _weights(nodes: Sequence[float], places: np.ndarray) -> np.ndarray:
    """Return `lagrange` at places, (places, nodes); GeometryError outside the nodes."""
    outside = _outside(nodes, places)
    if outside.any():
        raise GeometryError(
            "{place:.6g} lies outside the pupils fitted from {low:.6g} to {high:.6g}; plan the scene again",
            place=float(places[outside][0]),
            low=nodes[0],
            high=nodes[-1],
        )
    return lagrange(nodes, places)


def lagrange(nodes: Sequence[float], places: ArrayLike) -> np.ndarray:
    """Return the weights of Lagrange interpolation at places, (…, nodes); they sum to 1.

    A place that differs from a node by rounding only is that node: polynomials of high degree would amplify it.
    """
    at, (low, high) = np.array(nodes, float), (nodes[0], nodes[-1])
    apart = np.asarray(places, float)[..., None] - at
    same = np.abs(apart) <= SAME * max(abs(low), abs(high))
    spans = at[:, None] - at + np.eye(len(at))
    others = np.where(np.eye(len(at), dtype=bool), 1.0, apart[..., None, :])
    weights: np.ndarray = np.where(same.any(-1, keepdims=True), same, (others / spans).prod(-1))
    return weights


def chebyshev(least: float, most: float, count: int) -> np.ndarray:
    """Return ``count`` Chebyshev nodes of the second kind, both ends included, increasing; for one node the middle."""
    middle, half = (least + most) / 2, (most - least) / 2
    if count == 1:
        return np.array([middle])
    nodes: np.ndarray = middle - half * np.cos(np.pi * np.arange(count) / (count - 1))
    nodes[[0, -1]] = least, most
    return nodes


def _outside(nodes: Sequence[float], places: np.ndarray) -> np.ndarray:
    """Return which places do not lie between the nodes."""
    slack = SAME * max(abs(nodes[0]), abs(nodes[-1]))
    outside: np.ndarray = (places < nodes[0] - slack) | (places > nodes[-1] + slack)
    return outside
