"""Interpolation from few nodes of the disc to others: polynomials in ρ² times harmonics of the angle.

f(ρ, θ) = Σ_m f_m(ρ)·cos(mθ), or with sin(mθ) if it is odd in ξ; f_m is even in ρ for even m and odd for odd m, so that
f_m(ρ)/ρ^(m mod 2) is a polynomial in ρ². Gauss–Legendre nodes in ρ² and evenly spaced angles determine as many of both
as there are nodes, and converge geometrically (Boyd 2001, §18.5).
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial.legendre import legvander

from p2sf.conventions import write_protect
from p2sf.pupil.domain import PupilDomain
from p2sf.pupil.quadrature import disc_axes, gauss_legendre

ODD = (False, True, False, False, False)  # phase, fx, fy, amplitude and distance in ξ, by symmetry


def interpolate(
    values: np.ndarray, counts: tuple[int, int], rho: np.ndarray, theta: np.ndarray, odd: bool = False
) -> np.ndarray:
    """Return a function known at the nodes of `disc_nodes(*counts)` at radii × angles, (…, radii·angles).

    ``values``: (…, nodes) over the half disc, even in ξ or ``odd``; ``rho``: (radii,); ``theta``: (angles,), from +η.
    """
    up, across = _matrices(counts, rho.tobytes(), theta.tobytes(), odd)
    grid = values.reshape(*values.shape[:-1], counts[0], counts[1] // 2)
    # Even and odd harmonics separately, side by side in ``across`` and in ``up``.
    even, odd_ones = np.split(grid @ across, 2, axis=-1)
    found: np.ndarray = up @ np.concatenate([even, odd_ones], axis=-2)
    return found.reshape(*values.shape[:-1], -1)


def interpolate_pupil(
    domain: PupilDomain, values: np.ndarray, coarse: tuple[int, int], radius: np.ndarray, theta: np.ndarray
) -> np.ndarray:
    """Return phase, fx, fy, amplitude and what follows, (…, points), at radii × angles from those at coarse nodes.

    ``values``: (4 or 5, nodes), in the order of ODD. The nodes are those of a domain, half after half; the points are
    on the half ξ > 0 and are mirrored for the other.
    """
    sides = values.reshape(len(values), len(domain.halves), -1)
    found = np.zeros((*sides.shape[:2], radius.size * theta.size))
    for odd in (False, True):
        signs = np.array(domain.halves)[:, None] if odd else 1
        for number, own in enumerate(ODD[: len(values)]):  # one by one: of millions of points each takes 50 MB
            if odd in domain.parities(own):
                part = (signs * sides[number]).sum(0) / len(domain.halves)
                found[number] += signs * interpolate(part, coarse, radius, theta, odd)
    return found.reshape(len(values), -1)


def on_disc(domain: PupilDomain, values: np.ndarray, coarse: tuple[int, int], counts: tuple[int, int]) -> np.ndarray:
    """Return `interpolate_pupil` at the nodes of ``counts``, (…, nodes)."""
    return interpolate_pupil(domain, values, coarse, *disc_axes(*counts))


@lru_cache(maxsize=32)
def _matrices(counts: tuple[int, int], radii: bytes, angles: bytes, odd: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return the matrices (radii, 2·radial) and (angular/2, 2·angles) between which `interpolate` takes values.

    ``radii`` and ``angles``: arrays as bytes. The first halves are for even harmonics, the others for odd ones.
    """
    rho, theta = np.frombuffer(radii), np.frombuffer(angles)
    analysis, harmonics = _harmonics(counts[1], odd)
    polynomial, (here, _) = _polynomials(counts[0], rho).T, disc_axes(*counts)
    wave = (np.sin if odd else np.cos)(np.outer(harmonics, theta))
    at_odd = harmonics % 2 == 1
    across = np.concatenate([analysis[:, some] @ wave[some] for some in (~at_odd, at_odd)], axis=1)
    up = np.concatenate([polynomial, rho[:, None] * polynomial / here], axis=1)
    return write_protect(up), write_protect(across)


@lru_cache(maxsize=8)
def _harmonics(angular: int, odd: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return the matrix (angles, harmonics) from values over half a turn to their harmonics, and the harmonics."""
    half = angular // 2
    theta = (np.arange(half) + 0.5) * (np.pi / half)
    number = np.arange(1, half + 1) if odd else np.arange(half)
    matrix = (np.sin if odd else np.cos)(np.outer(theta, number)) * (2 / half)
    matrix[:, number % half == 0] /= 2  # of the constant, and of the sine that alternates
    return write_protect(matrix), write_protect(number)


def _polynomials(radial: int, rho: np.ndarray) -> np.ndarray:
    """Return the matrix (radial, radii) from a polynomial's values at the Gauss nodes in ρ² to those at other radii.

    f = Σ (2n + 1)/2·⟨f, Pₙ⟩·Pₙ, which the rule integrates exactly (A&S 22.2.10).
    """
    place, weight = gauss_legendre(radial)
    here, there = legvander(place, radial - 1), legvander(2 * np.square(rho) - 1, radial - 1)
    matrix: np.ndarray = (here * weight[:, None] * (np.arange(radial) + 0.5)) @ there.T
    return matrix
