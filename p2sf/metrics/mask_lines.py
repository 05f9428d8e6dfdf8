"""The lines of a pupil behind a mask, each open in several intervals (handbook 6.3).

The edges of the mask, curves over the stop, are mapped to spatial frequency, where those of the pupil itself are known.
"""

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebvander

from p2sf.errors import GeometryError
from p2sf.metrics.frequency_pupil import UNFOLLOWED, FrequencyPupil

NEWTON_STEPS, NEWTON_ENOUGH = 12, 1e-10  # of the rim's radius
NEWTON_LEAST = 1e-5  # and above which contrast is less accurate than the handbook states
FARTHEST = 1.05  # in the box's coordinates: farther out its polynomials are of no use


def box_edges(pupil: FrequencyPupil) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Return the closed curves in the box, (2, points), whose insides are open, and those whose insides are dark."""
    inner, dark = pupil.edges.behind(pupil.mask)
    return [pupil.edge, *(to_box(pupil, *edge) for edge in inner)], [to_box(pupil, *edge) for edge in dark]


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


def light_on_grid(
    pupil: FrequencyPupil, x: np.ndarray, y: np.ndarray, wanted: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return modulus and phase in waves, (y, x), behind a mask without its edges; the modulus 0 if not ``wanted``."""
    mask, (phase, density) = pupil.mask, pupil.on_grid(x, y)
    if mask.shaded or mask.phased:
        xi, eta = (wanted * values for values in pupil.stop_on_grid(x, y))
        density = density * mask.amplitude(xi, eta)
        if mask.phased:
            phase = phase + mask.path_um(xi, eta) / pupil.wavelength_um
    return np.where(wanted, np.abs(density), 0.0), phase
