"""The rim of the clear part of the pupil, computed quickly for pictures and shares of the variance.

`vignetting.clear_nodes` finds each corner of that rim and is exact to 1e-10; a picture of some hundred pixels needs
1e-3, which a few traces of rays along fixed directions provide.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.disc.domain import WHOLE, ClearNodes, PupilDomain
from p2sf.disc.quadrature import gauss_legendre
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pupil.clear_pieces import CLIPPED, LOST, check_without_holes
from p2sf.raytrace.pencil import hexapolar, pencil

SEARCH_RINGS = 8
SECTIONS = 16  # rays in each direction in each round: one trace of many rays costs less than many of few


@dataclass(frozen=True, eq=False)
class ClearRim:
    """The clear part of the pupil, star-shaped about (``aside``, ``centre``).

    ``theta``: (directions,) angles from +η towards +ξ once around, the first half a step behind 0; ``radius`` of the
    rim along them. ``domain``: what of it tells everything.
    """

    centre: float
    theta: np.ndarray
    radius: np.ndarray
    aside: float
    domain: PupilDomain

    @property
    def points(self) -> tuple[np.ndarray, np.ndarray]:
        """Return ξ and η of the rim in each direction."""
        return self.aside + self.radius * np.sin(self.theta), self.centre + self.radius * np.cos(self.theta)

    def outline(self) -> np.ndarray:
        """Return ξ and η of the closed rim, (2, directions + 1)."""
        return np.stack([np.append(one, one[:1]) for one in self.points])

    def excess(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return the distance of points beyond the rim in pupil radii along directions; negative inside."""
        across, away = xi - self.aside, eta - self.centre
        place = (np.arctan2(across, away) / (2 * np.pi) % 1) * self.theta.size + 0.5
        left = np.minimum(place.astype(np.intp), self.theta.size)
        ends = np.concatenate([self.radius[-1:], self.radius, self.radius[:1]])
        excess: np.ndarray = np.hypot(across, away) - ends[left] - (place - left) * (ends[1:] - ends[:-1])[left]
        return excess

    def nodes(self, radii: int) -> ClearNodes:
        """Return Gauss–Legendre nodes in ρ² up to the rim along each direction of the domain."""
        used = slice(self.theta.size // len(self.domain.images))
        radius, theta = self.radius[used], self.theta[used]
        square, weight = gauss_legendre(radii)
        rho = np.sqrt((1 + square) / 2)[:, None] * radius
        area = (weight[:, None] / 2 * radius**2 / radius.size).ravel()
        xi, eta = self.aside + rho * np.sin(theta), self.centre + rho * np.cos(theta)
        return ClearNodes(xi.ravel(), eta.ravel(), area / area.sum(), min(float(area.sum()), 1.0), domain=self.domain)


@lru_cache(maxsize=32)
def clear_rim(lens: Lens, source: Source, clip: bool, directions: int, rounds: int) -> ClearRim:
    """Return the rim of the clear part, radii to 16^−rounds of the pupil's; without ``clip`` only lost rays bound it.

    ``directions``: over half a turn. Raises GeometryError if no part is clear.
    """
    check_without_holes(lens, clip)
    xi, eta = hexapolar(SEARCH_RINGS)
    passed = pencil(lens, source, xi, eta, clip).passed
    if not passed.any():
        raise GeometryError(CLIPPED if clip else LOST, parameter="clip")
    domain = lens.pupil_domain
    (aside, centre), theta = domain.middle(xi[passed], eta[passed]), domain.directions(directions)
    sine, cosine = np.sin(theta), np.cos(theta)
    # The unit circle seen from the centre.
    high = np.sqrt(1 - (centre * sine - aside * cosine) ** 2) - (centre * cosine + aside * sine)
    low = np.zeros(theta.size)
    steps = np.arange(1, SECTIONS + 1)[:, None] / SECTIONS
    for _ in range(rounds):
        radii = low + (high - low) * steps
        rays = pencil(lens, source, (aside + radii * sine).ravel(), (centre + radii * cosine).ravel(), clip)
        inside = np.logical_and.accumulate(rays.passed.reshape(radii.shape)).sum(axis=0)
        part = (high - low) / SECTIONS
        low, high = low + inside * part, low + np.minimum(inside + 1, SECTIONS) * part
    radius = np.concatenate([((low + high) / 2)[::side] for side in domain.images])
    return ClearRim(centre, WHOLE.directions(directions), radius, aside, domain)
