"""Polynomials over the stop for the points where aimed rays enter, and for their weights."""

from dataclasses import dataclass

import numpy as np

from p2sf.pupil.zernike import powers, rising_powers


@dataclass(frozen=True, eq=False)
class StopMap:
    """Polynomials over the stop for entrance points x and y (mm), and weights where the map has them.

    ``table`` holds c[b, a] of ξ²ᵃ·ηᵇ of x/ξ, y and weights; without symmetry of the part even in ξ of each, and ``odd``
    of the other over ξ. The axes of `Sources` stand between the first axis, which tells these apart, and the powers.
    """

    table: np.ndarray
    odd: np.ndarray | None = None

    @classmethod
    def of(cls, order: int, x: np.ndarray, *others: np.ndarray, symmetric: bool) -> "StopMap":
        """Return the map of coefficients of `zernike`: of x those of the odd terms, of y and weights of the even.

        Without symmetry each has coefficients of the even terms and behind them of the odd.
        """
        parts = (x, *others)
        if symmetric:
            return cls(_tables(order, parts, (True, *(False for _ in others))))
        first = len(powers(order))
        even = _tables(order, tuple(part[..., :first] for part in parts), (False,) * len(parts))
        return cls(even, _tables(order, tuple(part[..., first:] for part in parts), (True,) * len(parts)))

    def at(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return entrance points x and y, and weights where the map has them, at points of the stop."""
        values = _values(self.table, xi, eta)
        if self.odd is None:
            values[0] *= xi
        else:
            values += _values(self.odd, xi, eta) * xi
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
