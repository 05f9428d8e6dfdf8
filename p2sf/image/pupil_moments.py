"""Which part of the pupil a layer is seen through: means over it, and first moments (handbook 10.1).

Through a point p of the pupil, a pixel sees T(p)·L(p): the light L of a layer, times what nearer layers let through.
The mean of that product is not the product of the means where both change over the pupil, as beside a silhouette. With
functions φ_j that are orthonormal over the pupil it is Σ_j ⟨T·φ_j⟩⟨L·φ_j⟩ (Parseval). Here φ_0 = 1, and φ_1 and φ_2 are
linear in p, which is exact where one of the two is. A blurred layer's ⟨L·φ_j⟩ is the layer blurred by the kernel times
the mean of φ_j over those rays that land at each pixel of it.
"""

from typing import NamedTuple

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.image.lattice import Lattice
from p2sf.image.region import Region
from p2sf.pixel_kernels.nodes import hats, nodes_along
from p2sf.raytrace.pencil import rays_through
from p2sf.raytrace.vignetting import pupil_nodes
from p2sf.scene.planning.plan import Plan

NODES = 4, 12  # over the pupil, for moments of the second order, which are means of smooth functions
PLACES = 3  # along each axis of the sensor, between which moments are linear
RIM = 2.0  # of a disc, in units of the standard deviation along an axis
NEGLIGIBLE = 5e-4  # of the light that passes; moments fade in from there, so that tiles of the picture join


class PupilLandings(NamedTuple):
    """Covariances of φ_1 and φ_2, along ξ and η, with the rows and columns where rays land, pixels, over a sensor.

    ``covariances``: (row nodes, column nodes, 2, 2), φ first.
    """

    row_nodes: np.ndarray
    column_nodes: np.ndarray
    covariances: np.ndarray

    def at(self, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
        """Return the covariances at rows and columns of a grid, (rows, columns, 2, 2)."""
        down, right = hats(self.row_nodes, rows), hats(self.column_nodes, columns)
        found: np.ndarray = np.einsum("ar,bc,abij->rcij", down, right, self.covariances)
        return found


def pupil_landings(planned: Plan, vergence: float) -> PupilLandings:
    """Return where rays through the parts of the pupil land from one depth, in the reference wavelength."""
    sensor, seen = planned.scene.sensor, planned.sensor_map(vergence)
    rows, columns = (nodes_along(n, PLACES) for n in (sensor.rows, sensor.columns))

    def covariance(x_mm: float, y_mm: float) -> np.ndarray:
        source = seen.source(x_mm, y_mm, planned.reference_um)
        nodes = pupil_nodes(seen.lens, source, NODES).unfolded()
        rays = rays_through(seen.lens, source, nodes, seen.clip).along_axis(seen.lens).turned(source.azimuth_deg)
        light = np.where(rays.passed, rays.share * rays.light, 0.0)
        points = np.stack([rays.xi, rays.eta, -rays.dy, rays.dx])  # row 0 is the top
        points = np.where(rays.passed, points, 0.0)
        points -= (points @ light / light.sum())[:, None]
        second = (points * light) @ points.T / light.sum()
        found: np.ndarray = np.linalg.solve(np.linalg.cholesky(second[:2, :2]), second[:2, 2:])
        return found * (UM_PER_MM / sensor.pixel_um)

    places = [[covariance(x, y) for x in sensor.x_mm(columns).tolist()] for y in sensor.y_mm(rows).tolist()]
    return PupilLandings(rows, columns, np.array(places))


def first_moments(lattice: Lattice, region: Region, landings: PupilLandings) -> Lattice:
    """Return the lattice over a region with each kernel's first moments over the pupil in place of it.

    Channels are doubled: those of φ_1, then those of φ_2.
    """
    at = landings.at(lattice.row_nodes + region.top, lattice.column_nodes + region.left)
    kernels = [
        [kernel_moments(kernel, covariance) for kernel, covariance in zip(line, row, strict=True)]
        for line, row in zip(lattice.kernels, at, strict=True)
    ]
    return Lattice(lattice.row_nodes, lattice.column_nodes, kernels)


def kernel_moments(kernel: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """Return a kernel times the means of φ_1 and φ_2 over the rays that land at each pixel, (2·channels, size, size).

    These are linear in the pixel's distance from the centroid, as far as rays reach, and constant beyond, where only
    the rim sends light. Their slope gives the covariance that the rays have, which diffraction does not change.
    """
    half = kernel.shape[-1] // 2
    place = np.indices(kernel.shape[1:]) - half
    centred = place - _means(kernel, np.broadcast_to(place, (len(kernel), *place.shape)))
    reach = RIM * np.linalg.norm(covariance, 2) + 1
    within = centred * np.minimum(1, reach / np.maximum(np.hypot(centred[:, 0], centred[:, 1]), 1))[:, None]
    within -= _means(kernel, within)
    spread = np.einsum("cij,caij,cbij->cba", kernel, within, centred) + 1e-6 * np.eye(2)
    slopes = np.linalg.solve(spread, np.broadcast_to(covariance.T, spread.shape)).swapaxes(1, 2)
    found: np.ndarray = np.einsum("cij,cka,caij->kcij", kernel, slopes, within)
    return found.reshape(-1, *kernel.shape[1:]).astype(np.float32)


def _means(kernel: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the means of values, (channels, 2, size, size), by each channel's kernel, (channels, 2, 1, 1)."""
    means: np.ndarray = np.einsum("cij,caij->ca", kernel, values)[..., None, None]
    return means


class Passing:
    """What nearer layers let through: ``mean`` (rows, columns, channels), ``tilts`` (2, …) its first moments.

    ``tilted``: whether any of these is not 0.
    """

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.mean, self.tilts = np.ones(shape, np.float32), np.zeros((2, *shape), np.float32)
        self.tilted = False

    def seen(self, at: tuple[slice, slice], light: np.ndarray, tilts: np.ndarray) -> np.ndarray:
        """Return what is seen there of a layer, from its light and the moments of this, (2, …)."""
        through: np.ndarray = self.mean[at] * light
        if not self.tilted:
            return through
        through += (self.tilts[:, *at] * tilts).sum(0)
        return np.clip(through, 0, light, out=through)  # as any mean of a part of it

    def hide(self, at: tuple[slice, slice], hidden: np.ndarray, tilts: np.ndarray) -> None:
        """Let a layer that hides this share, with these moments, stand before what follows.

        Of T·(1 − α) moments of first order are kept: those of products of two are odd on a pupil that is centred.
        """
        mean, own = self.mean[at], self.tilts[:, *at]
        hidden = np.clip(hidden, 0, 1)
        left = mean * (1 - hidden) - (own * tilts).sum(0)
        tilts = own * (1 - hidden) - mean * tilts
        self.tilts[:, *at] = tilts - np.clip(tilts, -NEGLIGIBLE, NEGLIGIBLE)
        self.mean[at] = np.clip(left, 0, mean)
        self.tilted = bool(self.tilts.any())

    def near_moments(self, reach: int) -> np.ndarray:
        """Return which pixels are within ``reach`` of moments, on pixels as many more on every side, bool."""
        from scipy.ndimage import maximum_filter

        counts = np.pad(self.tilts.any((0, 3)), reach)
        near: np.ndarray = maximum_filter(counts, 2 * reach + 1)
        return near
