"""Which part of the pupil a layer is seen through: means over it, and moments (handbook 10.1).

Through a point p of the pupil, a pixel sees T(p)·L(p): the light L of a layer, times what nearer layers let through.
The mean of that product is not the product of the means where both change over the pupil, as beside a silhouette. With
functions φ_j that are orthonormal over the pupil it is Σ_j ⟨T·φ_j⟩⟨L·φ_j⟩ (Parseval). These are Zernike's up to the
second degree, in Noll's order, φ_0 = 1 the first (J. Opt. Soc. Am. 66, 207, 1976); the sum is exact where T or L is
such a polynomial. A blurred layer's ⟨L·φ_j⟩ is the layer blurred by the kernel times the mean of φ_j over those rays
that land at each pixel of it. They are orthonormal over a disc: behind a ring, or rims that clip, terms of the
first degree and above come out too weak.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.disc.quadrature import whole_disc
from p2sf.image.lattice import Lattice
from p2sf.image.region import Region
from p2sf.pixel_kernels.nodes import hats, nodes_along
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.raytrace.pencil import rays_through
from p2sf.scene.planning.plan import Plan

NODES = 4, 12  # over the pupil, for moments of the second order, which are means of smooth functions
PLACES = 3  # along each axis of the sensor, between which moments are linear
WITHIN_PIXEL = 0.02  # square pixels, a fourth of a pixel's own variance: a kernel of one pixel tells no parts
MOMENTS = 5  # functions besides φ_0
NEGLIGIBLE = 5e-4  # of the light that passes; moments fade in from there, so that tiles of the picture join


class PupilLandings(NamedTuple):
    """Means over the rays of φ_1 … times `powers` of where they land, over places on a sensor.

    ``means``: (row nodes, column nodes, MOMENTS, 6), landing in units of ``reach``, (row nodes, column nodes) pixels:
    how far from their centroid rays land, and a pixel.
    """

    row_nodes: np.ndarray
    column_nodes: np.ndarray
    means: np.ndarray
    reach: np.ndarray

    def at(self, rows: np.ndarray, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return means and reaches at rows and columns of a grid, (rows, columns, …) each."""
        down, right = hats(self.row_nodes, rows), hats(self.column_nodes, columns)
        found = np.einsum("ar,bc,ab...->rc...", down, right, self.means)
        reach: np.ndarray = np.einsum("ar,bc,ab->rc", down, right, self.reach)
        return found, reach


def pupil_landings(planned: Plan, vergence: float) -> PupilLandings:
    """Return where rays through the parts of the pupil land from one depth, in the reference wavelength."""
    sensor, seen = planned.scene.sensor, planned.sensor_map(vergence)
    rows, columns = (nodes_along(n, PLACES) for n in (sensor.rows, sensor.columns))

    def at(x_mm: float, y_mm: float) -> tuple[np.ndarray, float]:
        source = seen.source(x_mm, y_mm, planned.reference_um)
        nodes = pupil_nodes(seen.lens, source, NODES).unfolded()
        rays = rays_through(seen.lens, source, nodes, seen.clip).along_axis(seen.lens).turned(source.azimuth_deg)
        light = np.where(rays.passed, rays.share * rays.light, 0.0)
        light /= light.sum()
        points = np.stack([rays.xi, rays.eta, -rays.dy, rays.dx])  # row 0 is the top
        points = np.where(rays.passed, points, 0.0)
        points -= (points @ light)[:, None]
        pupil, landing = points[:2], points[2:] * (UM_PER_MM / sensor.pixel_um)
        functions = zernike(*np.linalg.solve(np.linalg.cholesky((pupil * light) @ pupil.T), pupil))[1:]
        functions -= (functions @ light)[:, None]
        reach = float(np.hypot(*landing).max()) + 1
        return (functions * light) @ powers(landing / reach).T, reach

    places = [[at(x, y) for x in sensor.x_mm(columns).tolist()] for y in sensor.y_mm(rows).tolist()]
    means, reach = (np.array([[place[k] for place in row] for row in places]) for k in (0, 1))
    return PupilLandings(rows, columns, means, reach)


def powers(place: np.ndarray) -> np.ndarray:
    """Return 1, x, y, x², xy and y² of places, (2, …), as (6, …)."""
    x, y = place
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y])


def moments_of(lattice: Lattice, region: Region, landings: PupilLandings) -> Lattice:
    """Return the lattice over a region with the moments of each kernel in place of it.

    Its channels are all those of the kernels for the first moment, then for the next.
    """
    means, reaches = landings.at(lattice.row_nodes + region.top, lattice.column_nodes + region.left)
    kernels = [
        [kernel_moments(*each).reshape(-1, *each[0].shape[1:]) for each in zip(line, *about, strict=True)]
        for line, *about in zip(lattice.kernels, means, reaches, strict=True)
    ]
    return Lattice(lattice.row_nodes, lattice.column_nodes, kernels)


def kernel_moments(kernel: np.ndarray, means: np.ndarray, reach: float) -> np.ndarray:
    """Return a kernel times the means of φ_1 … over the rays that land at each pixel, (MOMENTS, channels, size, size).

    These are polynomials of second degree in the pixel's place, as far as rays reach, and constant beyond, where only
    the rim sends light: the regression that gives the rays' own ``means``, as `PupilLandings` has them.
    """
    half = kernel.shape[-1] // 2
    place = np.indices(kernel.shape[1:]) - half
    functions = []
    for light in kernel:
        centred = (place - np.einsum("ij,aij->a", light, place)[:, None, None]) / reach
        terms = powers(centred / np.maximum(np.hypot(*centred), 1))
        gram = np.einsum("ij,aij,bij->ab", light, terms, terms, optimize=True)
        gram[range(1, 6), range(1, 6)] += WITHIN_PIXEL / reach**2
        functions.append(light * np.tensordot(np.linalg.solve(gram, means.T), terms, (0, 0)))
    found: np.ndarray = np.stack(functions, axis=1)
    even: np.ndarray = (found - kernel * found.sum((2, 3), keepdims=True)).astype(np.float32)
    return even


def zernike(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return φ_0 … from φ_1 = 2ξ and φ_2 = 2η, (1 + MOMENTS, …)."""
    square = first * first, second * second
    twisted, upright = 6**0.5 / 2 * first * second, 6**0.5 / 4 * (square[0] - square[1])
    return np.stack([np.ones_like(first), first, second, 3**0.5 * ((square[0] + square[1]) / 2 - 1), twisted, upright])


@lru_cache(maxsize=1)
def triple_products() -> tuple[tuple[int, int, int, float], ...]:
    """Return i, j, k and ⟨φ_i·φ_j·φ_k⟩ over the pupil, of all that are not 0."""
    xi, eta, weight = whole_disc(4, 12)  # exact to degree 7
    values = zernike(2 * xi, 2 * eta)
    table = np.einsum("in,jn,kn,n->ijk", values, values, values, weight / weight.sum())
    return tuple((*at, float(table[at])) for at in zip(*np.nonzero(abs(table) > 1e-9), strict=True))


class Passing:
    """What nearer layers let through: ``values``, (1 + MOMENTS, rows, columns, channels), the mean and the moments.

    ``cut``: whether any of the moments is not 0.
    """

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.values = np.zeros((1 + MOMENTS, *shape), np.float32)
        self.values[0] = 1
        self.cut = False

    def hide(self, at: tuple[slice, slice], hidden: Sequence[np.ndarray]) -> None:
        """Let a layer that hides this share, with these moments behind it, stand before what follows.

        Of T·(1 − α) those moments are kept that T has: T_k − Σ_ij ⟨φ_i·φ_j·φ_k⟩·T_i·α_j.
        """
        here, share = self.values[:, *at], np.clip(hidden[0], 0, 1)
        near = here[1:].any((0, 3))
        for moment in hidden[1:]:
            near |= (np.abs(moment) > NEGLIGIBLE).any(2)
        before, alpha = here[:, near], [share[near], *(moment[near] for moment in hidden[1:])]
        after = before.copy()
        for i, j, k, product in triple_products():
            after[k] -= product * before[i] * alpha[j]
        after[0] = np.clip(after[0], 0, before[0])  # as any mean of a part of it
        after[1:] -= np.clip(after[1:], -NEGLIGIBLE, NEGLIGIBLE)
        here[0] *= 1 - share
        here[:, near] = after
        self.cut = bool(self.values[1:].any())

    def near_moments(self, reach: int) -> np.ndarray:
        """Return which pixels are within ``reach`` of moments, on pixels as many more on every side, bool."""
        from scipy.ndimage import maximum_filter

        counts = np.pad(self.values[1:].any((0, 3)), reach)
        near: np.ndarray = maximum_filter(counts, 2 * reach + 1)
        return near
