"""Polynomials over the stop for the points where aimed rays enter, and for their weights."""

from dataclasses import dataclass

import numpy as np

from p2sf.pupil.zernike import powers, rising_powers


@dataclass(frozen=True, eq=False)
class StopMap:
    """Polynomials over the stop: ``table`` holds c[b, a] of ξ²ᵃ·ηᵇ for entrance points x/ξ and y (mm), and weights.

    The axes of `Sources` stand between the first axis, which tells these apart, and the powers.
    """

    table: np.ndarray

    @classmethod
    def of(cls, order: int, x: np.ndarray, *even: np.ndarray) -> "StopMap":
        """Return the map of coefficients of `zernike`: of x those of the odd terms, of y and weights of the even."""
        return cls(_tables(order, (x, *even), (True, *(False for _ in even))))

    def at(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return entrance points x and y, and weights where the map has them, at points of the stop."""
        values = _values(self.table, xi, eta)
        values[0] *= xi
        return values


@dataclass(frozen=True, eq=False)
class SkewStopMap:
    """As `StopMap`, without symmetry: every quantity has a part even in ξ, and one odd, ξ times its table's."""

    even: np.ndarray
    odd: np.ndarray

    @classmethod
    def of(cls, order: int, *coefficients: np.ndarray) -> "SkewStopMap":
        """Return the map of coefficients of `zernike`, of each quantity the even terms and behind them the odd."""
        first = len(powers(order))
        even = _tables(order, tuple(part[..., :first] for part in coefficients), (False,) * len(coefficients))
        odd = _tables(order, tuple(part[..., first:] for part in coefficients), (True,) * len(coefficients))
        return cls(even, odd)

    def at(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return entrance points x and y, and weights where the map has them, at points of the stop."""
        values = _values(self.odd, xi, eta)
        values *= xi
        values += _values(self.even, xi, eta)
        return values


def _tables(order: int, parts: tuple[np.ndarray, ...], odd: tuple[bool, ...]) -> np.ndarray:
    """Return c[b, a] of ξ²ᵃ·ηᵇ for coefficients of even or odd terms."""
    forms = [powers(order, flag) for flag in odd]
    flat = [part @ form.reshape(len(form), -1) for part, form in zip(parts, forms, strict=True)]
    return np.stack(flat).reshape(len(flat), *parts[0].shape[:-1], *forms[0].shape[1:]).swapaxes(-1, -2)


def _values(table: np.ndarray, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    along, across = table.shape[-2:]
    values: np.ndarray = np.einsum("...bn,bn->...n", table @ rising_powers(xi * xi, across), rising_powers(eta, along))
    return values
