"""First-order optics: the shift-invariant features (SIF) of a lens.

Everything follows from two basis rays, (y, nu) = (1, 0) and (0, 1) at the first vertex: their
heights and reduced angles at every surface are the running system matrices.
"""

from dataclasses import dataclass

import numpy as np

from p2sf.conventions import vergence
from p2sf.errors import GeometryError
from p2sf.lens import Lens, indices


@dataclass(frozen=True)
class BasisRays:
    """Running system matrices, surface axis first: height at each surface, reduced angle after it.

    A ray (y1, nu1) has height a·y1 + b·nu1 at surface j and reduced angle c·y1 + d·nu1 behind it.
    ``a``, ``b``, ``c``, ``d``: (surfaces, *wavelength.shape), mm where they carry a unit;
    ``index``: (surfaces + 1, *wavelength.shape).
    """

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray
    index: np.ndarray

    @property
    def object_index(self):
        """Return the index of object space."""
        return self.index[0]

    @property
    def image_index(self):
        """Return the index of image space."""
        return self.index[-1]


@dataclass(frozen=True)
class CardinalPoints:
    """Focal length −1/C and cardinal points, mm, positive to the right of the named vertex."""

    effective_focal_length: np.ndarray
    back_focal_distance: np.ndarray
    front_focal_distance: np.ndarray
    front_principal_from_first: np.ndarray
    rear_principal_from_last: np.ndarray
    front_nodal_from_first: np.ndarray
    rear_nodal_from_last: np.ndarray


def basis_rays(lens: Lens, wavelength_um, beside=()) -> BasisRays:
    """Trace the two basis rays; arrays of shape (surfaces, *wavelength_um.shape).

    ``beside``: arrays the result will be combined with; the wavelength is given their number of axes
    (ones in front, as numpy broadcasts), so that the surface axis stays the first of all.
    """
    wavelength = np.asarray(wavelength_um, dtype=float)
    missing = max((np.ndim(x) for x in beside), default=0) - wavelength.ndim
    index = indices(lens, wavelength.reshape((1,) * missing + wavelength.shape) if missing > 0 else wavelength)
    layers = index.tolist() if index.ndim == 1 else list(index)  # plain floats make one wavelength 10× faster
    a, b, c, d = 1.0, 0.0, 0.0, 1.0
    rows = []
    for surface, before, after in zip(lens.surfaces, layers, layers[1:], strict=False):
        power = surface.curvature * (after - before)
        c, d = c - power * a, d - power * b
        rows.append((a, b, c, d))
        reduced = surface.thickness / after
        a, b = a + reduced * c, b + reduced * d
    return BasisRays(*_columns(rows, index.shape[1:]), index)


def _columns(rows, shape):
    """Return rows of (a, b, c, d), numbers or arrays, as four arrays (surfaces, *shape)."""
    if not shape:
        return np.array(rows).T
    full = [
        [x if np.shape(x) == shape else np.broadcast_to(x, shape) for x in column] for column in zip(*rows, strict=True)
    ]
    return [np.stack(column) for column in full]


def abcd(lens: Lens, wavelength_um) -> np.ndarray:
    """System matrix from first to last vertex in reduced angles, shape (*wavelength_um.shape, 2, 2)."""
    rays = basis_rays(lens, wavelength_um)
    rows = np.stack([rays.a[-1], rays.b[-1], rays.c[-1], rays.d[-1]], axis=-1)
    return rows.reshape(*rows.shape[:-1], 2, 2)


def cardinal_points(lens: Lens, wavelength_um) -> CardinalPoints:
    """Focal, principal and nodal points (Welford 1986, §3); infinite for an afocal lens."""
    rays = basis_rays(lens, wavelength_um)
    n, n_image = rays.object_index, rays.image_index
    a, c, d = rays.a[-1], rays.c[-1], rays.d[-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        return CardinalPoints(
            effective_focal_length=-1 / c,
            back_focal_distance=_ratio(-n_image * a, c),
            front_focal_distance=_ratio(n * d, c),
            front_principal_from_first=_ratio(n * (d - 1), c),
            rear_principal_from_last=_ratio(n_image * (1 - a), c),
            front_nodal_from_first=_ratio(n * d - n_image, c),
            rear_nodal_from_last=_ratio(n - n_image * a, c),
        )


def _ratio(numerator, power):
    """Return numerator/power, infinite wherever the power is exactly zero (0/0 included: no such point)."""
    return np.where(power == 0, np.inf, np.divide(numerator, power))


def image_distance(lens: Lens, depth_mm, wavelength_um) -> np.ndarray:
    """Return paraxial image position from the last vertex, mm; infinite for an object in the front focal plane."""
    rays = basis_rays(lens, wavelength_um, (depth_mm,))
    height, angle = axial_ray(rays, depth_mm)
    with np.errstate(divide="ignore"):
        return -rays.image_index * height[-1] / angle[-1]


def magnification(lens: Lens, depth_mm, wavelength_um) -> np.ndarray:
    """Return transverse magnification nu/(n'u') of the axial ray; 0 for an object at infinity."""
    rays = basis_rays(lens, wavelength_um, (depth_mm,))
    _, angle = axial_ray(rays, depth_mm)
    with np.errstate(divide="ignore"):
        return rays.object_index * vergence(depth_mm) / angle[-1]


def axial_ray(rays: BasisRays, depth_mm):
    """Return heights at, reduced angles behind every surface of the axial ray of height 1 at the first vertex."""
    check_depth(depth_mm)
    start = rays.object_index * vergence(depth_mm)
    return rays.a + rays.b * start, rays.c + rays.d * start


def check_depth(depth_mm) -> None:
    """Raise GeometryError unless every depth is positive; infinity is allowed."""
    depth = np.asarray(depth_mm, dtype=float)
    if not np.all(depth > 0):
        bad = depth.ravel()[~(depth.ravel() > 0)][0]
        raise GeometryError(f"depth is {bad:g} mm; the object must stand a positive distance before the first vertex")
