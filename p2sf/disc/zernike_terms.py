"""Zernike terms by number in Noll's order and the Fringe order, with their names and values.

The angle θ runs from the +ξ axis towards +η, as in Noll's paper and in most programs; for a field along η only the
terms even in ξ remain, cos mθ with even m and sin mθ with odd m.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import isqrt, sqrt
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from p2sf.disc.domain import ClearNodes
from p2sf.disc.zernike import jacobi
from p2sf.errors import RequestError

ZernikeOrder = Literal["noll", "fringe"]
ORDERS: tuple[ZernikeOrder, ...] = get_args(ZernikeOrder)
SAME = 1e-9  # of the mean square of a polynomial: what is left of a term that nodes cannot tell from those before it
MOST_TERMS = {"noll": 231, "fringe": 37}  # Noll's up to degree 20
LOWEST = {(0, 0): "piston", (1, 1): "tilt", (2, 0): "defocus"}
FAMILIES = {  # by azimuthal order, then by ascending degree
    0: (
        "spherical aberration",
        "secondary spherical aberration",
        "tertiary spherical aberration",
        "quaternary spherical aberration",
    ),
    1: ("coma", "secondary coma", "tertiary coma", "quaternary coma"),
    2: ("astigmatism", "secondary astigmatism", "tertiary astigmatism", "quaternary astigmatism"),
    3: ("trefoil", "secondary trefoil", "tertiary trefoil", "quaternary trefoil"),
    4: ("tetrafoil", "secondary tetrafoil", "tertiary tetrafoil", "quaternary tetrafoil"),
    5: ("pentafoil", "secondary pentafoil", "tertiary pentafoil", "quaternary pentafoil"),
}


@dataclass(frozen=True)
class ZernikeTerm:
    """One term: its ``number`` in its order, degree ``n``, and ``m``, negative for sin |m|θ."""

    number: int
    n: int
    m: int

    @property
    def name(self) -> str:
        """Return the aberration's name without its direction, such as "secondary coma"."""
        return family(self.n, abs(self.m))

    @property
    def norm(self) -> float:
        """Return the factor that gives the term unit mean square over the disc (Noll 1976, eq. 1)."""
        return sqrt((self.n + 1) * (2 if self.m else 1))

    @property
    def even(self) -> bool:
        """Return whether the term is even in ξ, as the wavefront of a symmetric lens is for a field along η."""
        return (self.m % 2 == 0) == (self.m >= 0)

    @property
    def odd(self) -> bool:
        """Return whether the term is odd in ξ."""
        return not self.even


def family(n: int, m: int) -> str:
    """Return the name of the aberration of degree n and azimuthal order m ≥ 0."""
    if (n, m) in LOWEST:
        return LOWEST[n, m]
    first = max(m, 4 - m)  # coma starts at degree 3, spherical aberration at 4, the others at their m
    rank = (n - first) // 2
    names = FAMILIES.get(m, ())
    return names[rank] if rank < len(names) else f"n = {n}, m = {m}"


@lru_cache(maxsize=64)
def zernike_terms(order: ZernikeOrder, count: int) -> tuple[ZernikeTerm, ...]:
    """Return the first ``count`` terms of an order. Raises RequestError."""
    if order not in ORDERS:
        raise RequestError('{parameter} is "{value}"; choose noll or fringe', parameter="basis", value=str(order))
    if not 1 <= count <= MOST_TERMS[order] or count % 1:
        raise RequestError(
            "{parameter} is {value}; give a whole number from {low} to {high}",
            parameter="terms",
            value=count,
            low=1,
            high=MOST_TERMS[order],
        )
    return tuple((_noll if order == "noll" else _fringe)(number) for number in range(1, int(count) + 1))


def _noll(number: int) -> ZernikeTerm:
    """Return the term of Noll's single index: by degree, then by |m|; cos has the even number (Noll 1976, table I)."""
    n = (isqrt(8 * number - 7) - 1) // 2
    place = number - 1 - n * (n + 1) // 2  # within the degree, from 0
    m = 2 * ((place + 1 - n % 2) // 2) + n % 2
    return ZernikeTerm(number, n, m if number % 2 == 0 else -m)


def _fringe(number: int) -> ZernikeTerm:
    """Return the term of the University of Arizona's order: by (n + m)/2, then from m down to 0, cos before sin.

    Term 37 is the one of degree 12 that follows the first 36 (Wyant & Creath 1992, table III).
    """
    if number == 37:
        return ZernikeTerm(37, 12, 0)
    half = isqrt(number - 1)
    place = number - 1 - half * half
    m = half - place // 2
    return ZernikeTerm(number, 2 * half - m, m if place % 2 == 0 else -m)


def zernike_values(terms: tuple[ZernikeTerm, ...], xi: ArrayLike, eta: ArrayLike) -> np.ndarray:
    """Return every term at pupil points, shape (terms, points); unit mean square over the disc (Noll 1976, eq. 1)."""
    xi, eta = np.asarray(xi, float), np.asarray(eta, float)
    s = 2 * (xi * xi + eta * eta) - 1
    turn = np.stack([(xi + 1j * eta) ** m for m in range(max(abs(term.m) for term in terms) + 1)])
    return np.stack([_value(term, s, turn[abs(term.m)]) for term in terms])


def _value(term: ZernikeTerm, s: np.ndarray, harmonic: np.ndarray) -> np.ndarray:
    m = abs(term.m)
    part = harmonic.imag if term.m < 0 else harmonic.real
    value: np.ndarray = term.norm * jacobi((term.n - m) // 2, 0, m, s) * part
    return value


def orthonormal_terms(terms: tuple[ZernikeTerm, ...], nodes: ClearNodes) -> np.ndarray:
    """Return terms made orthonormal in order over nodes, (nodes, terms) (Mahajan & Dai 2007, eq. 11).

    Those that the nodes cannot tell from the terms before them, as of a very thin ring, are 0. Weights may be negative:
    Gram–Schmidt with these follows a QR decomposition by their sizes, which leaves it well conditioned.
    """
    root, sign = np.sqrt(np.abs(nodes.weight)), np.sign(nodes.weight)
    columns, lengths = np.linalg.qr((zernike_values(terms, nodes.xi, nodes.eta) * root).T)
    columns *= np.sign(np.diag(lengths))
    square, mixing = (columns.T * sign) @ columns, np.eye(len(terms))
    for k in range(len(terms)):
        earlier = mixing[:, :k]
        own = mixing[:, k] - earlier @ (earlier.T @ square[:, k])
        length = float(own @ square @ own)
        mixing[:, k] = own / np.sqrt(length) if length > SAME else 0.0
    orthonormal: np.ndarray = columns @ mixing / root[:, None]
    return orthonormal
