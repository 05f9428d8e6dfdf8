"""First-order optics: the shift-invariant features (SIF) of a lens.

Everything follows from two basis rays, (y, nu) = (1, 0) and (0, 1) at the first vertex: their
heights and reduced angles at every surface are the running system matrices.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.conventions import anywhere, is_number, protected, vergence
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, indices


@dataclass(frozen=True, eq=False)
class BasisRays:
    """Running system matrices, surface axis first: height at each surface, reduced angle after it.

    A ray (y1, nu1) has height a·y1 + b·nu1 at surface j and reduced angle c·y1 + d·nu1 behind it.
    ``a``, ``b``, ``c``, ``d``: (surfaces, *wavelength.shape), mm where they carry a unit;
    ``index``: (surfaces + 1, *wavelength.shape). ``power`` of every surface (1/mm) and ``gap``, the reduced
    thickness behind it (mm), are what the rays were traced with: numbers for one wavelength, else arrays.
    """

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray
    index: np.ndarray
    power: list
    gap: list

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
    if all([is_number(x) for x in (wavelength_um, *beside)]):
        return _basis_at(lens, float(wavelength_um))
    wavelength = np.asarray(wavelength_um, dtype=float)
    missing = max(map(np.ndim, beside), default=0) - wavelength.ndim
    return _basis(lens, wavelength.reshape((1,) * missing + wavelength.shape) if missing > 0 else wavelength)


@lru_cache(maxsize=64)
def _basis_at(lens: Lens, wavelength_um: float) -> BasisRays:
    """Return the basis rays of one wavelength, which stay while depth and field are dragged; write-protected."""
    rays = _basis(lens, np.asarray(wavelength_um))
    _ = [protected(values) for values in (rays.a, rays.b, rays.c, rays.d, rays.index)]
    return rays


def _basis(lens: Lens, wavelength: np.ndarray) -> BasisRays:
    index = indices(lens, wavelength)
    layers = index.tolist() if index.ndim == 1 else list(index)  # plain floats make one wavelength 10× faster
    steps = zip(lens.surfaces, layers, layers[1:], strict=False)
    power, gap = zip(*((s.curvature * (after - n), s.thickness / after) for s, n, after in steps), strict=True)
    rows = zip(march(power, gap, 1.0, 0.0), march(power, gap, 0.0, 1.0), strict=True)
    return BasisRays(*columns_of([(a, b, c, d) for (a, c), (b, d) in rows], index.shape[1:]), index, power, gap)


def march(power, gap, y, nu) -> list:
    """Return (height, reduced angle behind) at every surface of the ray that arrives as (y, nu) at the first."""
    rows = []
    for strength, reduced in zip(power, gap, strict=False):
        nu = nu - strength * y
        rows.append((y, nu))
        y = y + reduced * nu
    return rows


def columns_of(rows, shape):
    """Return rows of numbers or arrays as arrays (surfaces, *shape), one per column."""
    if not shape:
        return np.array(rows, dtype=float).T
    columns = np.empty((len(rows[0]), len(rows), *shape))
    for number, row in enumerate(rows):  # assigning spreads a number at a tenth of np.broadcast_to's price
        for column, values in zip(columns, row, strict=True):
            column[number] = values
    return columns


# An angle below this many roundings of the powers and gaps it comes from is none: 32 leaves room for a focal
# length, and from it a gap, that someone computed in double precision.
ROUNDING = 32 * np.finfo(float).eps
SUSPICIOUS = 1e-9


def settled_angle(power, gap, y, nu):
    """Return the last reduced angle of a ray, exactly 0 where it is nothing but the rounding of the inputs.

    ``y``, ``nu``: heights at, reduced angles behind the surfaces that ``power`` and ``gap`` belong to. A
    change of power bends by −δ·y, a change of gap lifts by δ·nu; a ray that ends parallel to the axis shares
    its Lagrange invariant with what they cause, so its last angle moves by Σ(|δpower|y² + |δgap|nu²)/y_last.
    """
    last = nu[-1]
    # Plain numbers settle the usual case of one source a good deal faster.
    largest = max(map(abs, nu.tolist())) if nu.ndim == 1 else np.abs(nu).max(0)
    parallel = abs(last) <= SUSPICIOUS * largest
    if not anywhere(parallel):
        return last
    noise = sum(np.abs(p) * h * h for p, h in zip(power, y, strict=False))
    noise = noise + sum(np.abs(g) * v * v for g, v in zip(gap, nu[:-1], strict=False))
    return np.where(parallel & (np.abs(last * y[-1]) <= ROUNDING * noise), 0.0, last)


def chief_ray(rays: BasisRays, stop_surface):
    """Return heights (surfaces, …) and reduced angles (surfaces + 1, …) of the ray (0, 1) at the stop's centre.

    It is traced outwards from the stop: taken from the basis rays at the first vertex, a chief ray a hair
    behind the stop would be the difference of two large heights. The reduced angles at both ends are exactly
    zero where only rounding is left, that is where a pupil is at infinity.
    """
    first, *others = (stop_surface,) if is_number(stop_surface) else np.unique(stop_surface)
    y, nu = (_kept_from_stop if rays.index.ndim == 1 else _from_stop)(rays, int(first) - 1)
    for surface in others:
        here = np.asarray(stop_surface) == surface
        y, nu = (np.where(here, new, old) for new, old in zip(_from_stop(rays, int(surface) - 1), (y, nu), strict=True))
    return y, nu


def _from_stop(rays: BasisRays, at: int):
    y, nu = _branch(rays, rays.power[at:], rays.gap[at:])
    back_y, back_nu = _branch(rays, (0.0, *rays.power[:at][::-1]), rays.gap[:at][::-1])  # mirrored: light runs left
    return np.concatenate([-back_y[:0:-1], y]), np.concatenate([back_nu[::-1], nu])


@lru_cache(maxsize=64)
def _kept_from_stop(rays: BasisRays, at: int):
    """Return the chief ray of one wavelength, which stays while depth and field are dragged; write-protected."""
    return tuple(map(protected, _from_stop(rays, at)))


def _branch(rays: BasisRays, power, gap):
    """Return heights, reduced angles of the ray (0, 1) from the stop on, along one direction of travel."""
    y, nu = columns_of(march(power, (*gap, 0.0), 0.0, 1.0), rays.index.shape[1:])
    nu[-1] = settled_angle(power, gap, y, nu)
    return y, nu


def abcd(lens: Lens, wavelength_um) -> np.ndarray:
    """System matrix from first to last vertex in reduced angles, shape (*wavelength_um.shape, 2, 2)."""
    rays = basis_rays(lens, wavelength_um)
    return np.stack([rays.a[-1], rays.b[-1], rays.c[-1], rays.d[-1]], axis=-1).reshape(*rays.a.shape[1:], 2, 2)


def cardinal_points(lens: Lens, wavelength_um) -> CardinalPoints:
    """Focal, principal and nodal points (Welford 1986, §3); infinite for a lens that is afocal to rounding."""
    rays = basis_rays(lens, wavelength_um)
    n, n_image = rays.object_index, rays.image_index
    a, c, d = rays.a[-1], settled_angle(rays.power, rays.gap, rays.a, rays.c), rays.d[-1]
    lift, turn = _lift(rays), _turn(rays)
    with np.errstate(divide="ignore", invalid="ignore"):
        return CardinalPoints(
            effective_focal_length=_ratio(-1.0, c),
            back_focal_distance=_ratio(-n_image * a, c),
            front_focal_distance=_ratio(n * d, c),
            front_principal_from_first=_ratio(n * turn, c),
            rear_principal_from_last=_ratio(-n_image * lift, c),
            front_nodal_from_first=_ratio(n * turn + (n - n_image), c),
            rear_nodal_from_last=_ratio((n - n_image) - n_image * lift, c),
        )


def _lift(rays: BasisRays):
    """Return A − 1, summed gap by gap: the difference itself loses every digit when the powers are weak."""
    return sum((gap * c for gap, c in zip(rays.gap[:-1], rays.c, strict=False)), np.zeros(rays.a.shape[1:]))


def _turn(rays: BasisRays):
    """Return D − 1, summed power by power."""
    return -sum(power * b for power, b in zip(rays.power, rays.b, strict=True))


def _ratio(numerator, power):
    """Return numerator/power, infinite wherever the power is exactly zero (0/0 included: no such point)."""
    return np.where(power == 0, np.inf, np.divide(numerator, power))


def image_distance(lens: Lens, depth_mm, wavelength_um) -> np.ndarray:
    """Return paraxial image position from the last vertex, mm; infinite for an object in the front focal plane."""
    rays = basis_rays(lens, wavelength_um, (depth_mm,))
    height, angle = axial_ray(rays, depth_mm)
    return crossing(rays.image_index, height[-1], settled_angle(rays.power, rays.gap, height, angle))


def crossing(index, height, reduced_angle):
    """Return where a ray meets the axis, mm behind the plane of its height; +inf if it runs parallel."""
    if np.ndim(reduced_angle) == 0 and reduced_angle:  # the usual case of one source, ten times faster
        return -index * height / reduced_angle
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(reduced_angle == 0, np.inf, -index * height / reduced_angle)[()]


def magnification(lens: Lens, depth_mm, wavelength_um) -> np.ndarray:
    """Return transverse magnification nu/(n'u') of the axial ray; 0 for an object at infinity.

    Infinite for an image at infinity, but for an afocal lens, which magnifies every object alike.
    """
    rays = basis_rays(lens, wavelength_um, (depth_mm,))
    height, angle = axial_ray(rays, depth_mm)
    start = rays.object_index * vergence(depth_mm)
    last = settled_angle(rays.power, rays.gap, height, angle)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where((start == 0) & (last == 0), 1 / rays.d[-1], start / last)[()]


def axial_ray(rays: BasisRays, depth_mm):
    """Return heights at, reduced angles behind every surface of the axial ray of height 1 at the first vertex."""
    check_depth(depth_mm)
    start = rays.object_index * vergence(depth_mm)
    return rays.a + rays.b * start, rays.c + rays.d * start


def check_depth(depth_mm) -> None:
    """Raise GeometryError unless every depth is positive; infinity is allowed."""
    if isinstance(depth_mm, float) and depth_mm > 0:
        return
    depth = np.asarray(depth_mm, dtype=float)
    if not (depth > 0).all():
        bad = depth.ravel()[~(depth.ravel() > 0)][0]
        raise GeometryError(
            "depth is {depth:g} mm; the object must stand a positive distance before the first vertex", depth=float(bad)
        )
