"""Polynomials over the stop for the entrance points of aimed rays and their weights."""

from dataclasses import dataclass

import numpy as np

from p2sf.pupil.domain import PupilDomain
from p2sf.pupil.zernike import powers, rising_powers


@dataclass(frozen=True, eq=False)
class StopMap:
    """Polynomials over the stop for entrance points x and y (mm) and, if the map has them, weights.

    ``tables`` hold c[b, a] of ξ²ᵃ·ηᵇ: the first of x/ξ, y and weights, by symmetry; the
    second, without symmetry, of the other: of x, y/ξ and weights/ξ. The axes of `Sources` stand between the first axis
    of a table, which tells these apart, and the powers.
    """

    tables: tuple[np.ndarray, ...]

    @classmethod
    def of(cls, order: int, domain: PupilDomain, x: np.ndarray, *others: np.ndarray) -> "StopMap":
        """Return the map of coefficients of `zernike`: terms of the parities that a domain has for each, in turn."""
        parts, tables = (x, *others), []
        for kinds in zip(domain.parities(True), *(domain.parities(False) for _ in others), strict=True):
            forms = [powers(order, odd) for odd in kinds]
            sizes = [len(form) for form in forms]
            own = [part[..., :size] for part, size in zip(parts, sizes, strict=True)]
            parts = tuple(part[..., size:] for part, size in zip(parts, sizes, strict=True))
            tables.append(_table(own, forms))
        return cls(tuple(tables))

    def at(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return entrance points x and y and, if the map has them, weights at points of the stop."""
        values = _values(self.tables[0], xi, eta)
        values[0] *= xi
        for table in self.tables[1:]:
            others = _values(table, xi, eta)
            others[1:] *= xi
            values += others
        return values


def _table(parts: list[np.ndarray], forms: list[np.ndarray]) -> np.ndarray:
    """Return c[b, a] of ξ²ᵃ·ηᵇ for coefficients of terms with these powers."""
    flat = [part @ form.reshape(len(form), -1) for part, form in zip(parts, forms, strict=True)]
    return np.stack(flat).reshape(len(flat), *parts[0].shape[:-1], *forms[0].shape[1:]).swapaxes(-1, -2)


def _values(table: np.ndarray, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    along, across = table.shape[-2:]
    values: np.ndarray = np.einsum("...bn,bn->...n", table @ rising_powers(xi * xi, across), rising_powers(eta, along))
    return values
