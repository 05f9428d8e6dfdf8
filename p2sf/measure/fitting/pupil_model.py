"""The pupil that a measured point is explained by: named wavefront terms, and the map to spatial frequencies.

A model is linear in its numbers: W = Σ cₖbₖ(ξ, η) in waves and, where the pupil map is fitted too, (fx, fy) in units of
NA/λ as polynomials. A field along an azimuth turns the terms, so that each is even about the meridional plane.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.disc.quadrature import disc_nodes
from p2sf.disc.zernike import basis, terms
from p2sf.errors import RequestError

SIX = "seidel"
MODELS = {SIX: (4, 1), "26": (6, 3), "46": (8, 5)}  # orders of the wavefront and of the pupil map, as those of a fit


@dataclass(frozen=True)
class PupilModel:
    """Terms of a wavefront and of a pupil map.

    ``name``: "seidel", whose map is the paraxial one, "26" or "46", the counts of a fit to traced rays. Piston, and the
    mean frequency, leave no trace in a picture, and tilts are shifts: a model of "26" has 14 + 9 numbers beside them.
    """

    name: str
    wave_order: int
    map_order: int

    @property
    def mapped(self) -> bool:
        """Return whether the pupil map is fitted."""
        return self.map_order > 1

    @property
    def six(self) -> bool:
        """Return whether the wavefront is that of the paper's coefficients, not of Zernike's terms."""
        return self.name == SIX

    @property
    def wave_names(self) -> tuple[str, ...]:
        """Return the names of the wavefront's terms."""
        if self.six:
            return ("W40", "W31", "W22", "W20 + Wd")
        return tuple(f"W({n}, {m})" for n, m in _wave_terms(self.wave_order))

    @property
    def map_names(self) -> tuple[str, ...]:
        """Return the names of the map's terms, those across the field first."""
        if not self.mapped:
            return ()
        across, along = (
            (*(f"{axis}({n}, {m})" for n, m in part),) for axis, part in zip("xy", self._maps, strict=True)
        )
        return across + along

    @property
    def _maps(self) -> tuple[tuple[tuple[int, int], ...], tuple[tuple[int, int], ...]]:
        return terms(self.map_order, True), terms(self.map_order)[1:]

    @property
    def even(self) -> np.ndarray:
        """Return which terms of the wavefront and then of the map are even under (ξ, η) → (−ξ, −η), (numbers,)."""
        if self.six:
            return np.array([True, False, True, True])
        maps = sum(self._maps, ()) if self.mapped else ()
        return np.array([n % 2 == 0 for n, _ in (*_wave_terms(self.wave_order), *maps)])

    @property
    def paraxial_map(self) -> np.ndarray:
        """Return the map's numbers of the paraxial pupil, (fx, fy) = (ξ, η)."""
        if not self.mapped:
            return np.empty(0)
        return np.array([0.5 if term == (1, 1) else 0.0 for part in self._maps for term in part])

    def waves(self, xi: np.ndarray, eta: np.ndarray, azimuth: float = 0.0) -> np.ndarray:
        """Return the wavefront's terms at pupil points, (terms, *points); the field lies along ``azimuth``, radians.

        The azimuth counts from +η towards +ξ. Those of "seidel" are ρ⁴, ρ³cos θ, ρ²cos² θ and ρ² (Pieroni et al. 2015),
        the others Zernike's of unit mean square (Noll 1976, eq. 1).
        """
        u, v = rotate(xi, eta, azimuth)
        if self.six:
            square = u * u + v * v
            return np.stack([square * square, square * v, v * v, square])
        shape = np.shape(xi)
        every = basis(self.wave_order, u.ravel(), v.ravel())
        found: np.ndarray = every[_blurring(self.wave_order)].reshape(-1, *shape)
        return found

    def maps(self, xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the map's terms across and along the field, each (terms, *points)."""
        shape = np.shape(xi)
        across = basis(self.map_order, xi.ravel(), eta.ravel(), True)
        along = basis(self.map_order, xi.ravel(), eta.ravel())[1:]
        return across.reshape(-1, *shape), along.reshape(-1, *shape)

    def of_six(self, six: np.ndarray) -> tuple[np.ndarray, float]:
        """Return the terms of a wavefront of W40, W31, W22 and W20 + Wd, and the tilt in waves that they lack."""
        if self.six:
            return six.copy(), 0.0
        nodes = disc_nodes(8, 24)
        wave = six @ PupilModel(SIX, *MODELS[SIX]).waves(nodes.xi, nodes.eta)
        found = basis(self.wave_order, nodes.xi, nodes.eta) @ (nodes.weight * wave)
        return found[_blurring(self.wave_order)], float(2 * found[1])  # Z(1, 1) = 2η

    def twin(self, numbers: np.ndarray, defocus_waves: float = 0.0) -> np.ndarray:
        """Return the numbers of −W(−ξ, −η) and of the map turned by it, which give the same PSF.

        ``defocus_waves``: known, and part of W beside the numbers.
        """
        known = np.zeros(numbers.size)
        known[: len(self.wave_names)], _ = self.of_six(np.array([0.0, 0.0, 0.0, defocus_waves]))
        return np.where(self.even, -(numbers + known), numbers + known) - known

    def split(self, numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the numbers of the wavefront, of the map across and of the map along the field."""
        waves = len(self.wave_names)
        across = waves + len(self._maps[0]) * self.mapped
        return numbers[:waves], numbers[waves:across], numbers[across:]


def pupil_model(name: str) -> PupilModel:
    """Return the model of this name. Raises RequestError."""
    if name not in MODELS:
        raise RequestError(
            '{parameter} is "{value}"; choose {choices}', parameter="model", value=name, choices=(*MODELS,)
        )
    return PupilModel(name, *MODELS[name])


def rotate(xi: np.ndarray, eta: np.ndarray, azimuth: float) -> tuple[np.ndarray, np.ndarray]:
    """Return pupil coordinates across and along a field at ``azimuth``, radians from +η towards +ξ."""
    if not azimuth:
        return xi, eta
    sine, cosine = np.sin(azimuth), np.cos(azimuth)
    return xi * cosine - eta * sine, xi * sine + eta * cosine


@lru_cache(maxsize=8)
def _wave_terms(order: int) -> tuple[tuple[int, int], ...]:
    return tuple(term for term in terms(order) if term[0] > 1)


@lru_cache(maxsize=8)
def _blurring(order: int) -> np.ndarray:
    """Return the places of the terms that blur, without piston and tilt."""
    return np.array([place for place, (n, _) in enumerate(terms(order)) if n > 1])
