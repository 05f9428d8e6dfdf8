"""A mask over spatial frequency: its edges, curves over the stop, and the slope of its phase (handbook 6.3)."""

from functools import lru_cache
from math import hypot

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebvander

from p2sf.disc.mask import mask_slopes
from p2sf.errors import GeometryError
from p2sf.pupil.frequency_pupil import UNFOLLOWED, FrequencyPupil

NEWTON_STEPS, NEWTON_ENOUGH = 12, 1e-10  # of the rim's radius
NEWTON_LEAST = 1e-5  # and above which contrast is less accurate than the handbook states
FARTHEST = 1.05  # in the box's coordinates: farther out its polynomials are of no use


@lru_cache(maxsize=4)  # contrast and energy of one pupil share them, a quarter of the time of either behind vanes
def box_edges(pupil: FrequencyPupil) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Return the closed curves in the box, (2, points), whose insides are open, and those whose insides are dark."""
    inner, dark = pupil.edges.behind(pupil.mask).edges()
    return [pupil.edge, *(to_box(pupil, *edge) for edge in inner)], [to_box(pupil, *edge) for edge in dark]


def slope_waves(pupil: FrequencyPupil) -> float:
    """Return how far the phase of the mask sends light at most, as waves over the pupil's radius."""
    if not pupil.mask.phased:
        return 0.0
    slopes = mask_slopes(pupil.mask)
    return hypot(slopes.path_radial_um, slopes.path_angular_um) / abs(pupil.wavelength_um)


def to_box(pupil: FrequencyPupil, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return the points of the box whose rays pass (ξ, η) of the pupil, (2, points), by Newton's method."""
    # The first guess is by the secants along the box's axes.
    three = np.array([-1.0, 0.0, 1.0])
    at = np.stack(pupil.stop_on_grid(three, three))
    left, right, low, high = at[:, 1, 0], at[:, 1, 2], at[:, 0, 1], at[:, 2, 1]
    secants, centre = np.stack([right - left, high - low], axis=1) / 2, (left + right + low + high) / 4
    x, y = np.clip(np.linalg.solve(secants, np.stack([xi, eta]) - centre[:, None]), -1, 1)
    for _ in range(NEWTON_STEPS):
        across, a, b = _with_slopes(pupil.xi, x, y)
        up, c, d = _with_slopes(pupil.eta, x, y)
        miss_x, miss_y, area = xi - across, eta - up, a * d - b * c
        miss = max(np.abs(miss_x).max(), np.abs(miss_y).max())
        if miss < NEWTON_ENOUGH:
            break
        x = np.clip(x + (d * miss_x - b * miss_y) / area, -FARTHEST, FARTHEST)
        y = np.clip(y + (a * miss_y - c * miss_x) / area, -FARTHEST, FARTHEST)
    if not miss < NEWTON_LEAST:  # NaN too
        raise GeometryError(UNFOLLOWED)
    return np.stack([x, y])


def _with_slopes(table: np.ndarray, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return Σ table[b, a]·T_b(y)·T_a(x) at points, and its derivatives with x and with y."""
    order = len(table) - 1
    along, across = chebvander(y, order), chebvander(x, order)
    derivative = chebder(np.eye(order + 1))
    rows = along @ table
    return (
        np.einsum("na,na->n", rows, across),
        np.einsum("na,na->n", rows @ derivative.T, across[:, :-1]),
        np.einsum("na,na->n", along[:, :-1] @ (derivative @ table), across),
    )
