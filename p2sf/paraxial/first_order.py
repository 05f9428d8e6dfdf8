"""First-order optics: the shift-invariant features (SIF) of a lens (handbook 2.1).

Everything follows from two basis rays, (y, nu) = (1, 0) and (0, 1) at the first vertex: their
heights and reduced angles at every surface are the running system matrices.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.arguments import same_values
from p2sf.conventions import FloatOrArray, anywhere, is_number, vergence, write_protect
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, indices, surface_power


@dataclass(frozen=True, eq=False)
class BasisRays:
    """Running system matrices, surface axis first: height at each surface, reduced angle after it.

    A ray (y1, nu1) has height a·y1 + b·nu1 at surface j and reduced angle c·y1 + d·nu1 behind it. ``a``, ``b``, ``c``,
    ``d``: (surfaces, *wavelength.shape), mm where they carry a unit; ``index``: (surfaces + 1, *wavelength.shape), at
    ``wavelength_um``. ``power`` of every surface (1/mm) and ``gap``, the reduced thickness behind it (mm), are those
    used in the trace: numbers for one wavelength, else arrays.
    """

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray
    index: np.ndarray
    power: tuple
    gap: tuple
    wavelength_um: FloatOrArray

    @property
    def object_index(self) -> np.ndarray:
        """Return the index of object space."""
        index: np.ndarray = self.index[0]
        return index

    @property
    def image_index(self) -> np.ndarray:
        """Return the index of image space."""
        index: np.ndarray = self.index[-1]
        return index


@dataclass(frozen=True)
class CardinalPoints:
    """Focal length −1/C and cardinal points, mm, positive to the right of the named vertex."""

    __eq__ = same_values

    effective_focal_length: np.ndarray
    back_focal_distance: np.ndarray
    front_focal_distance: np.ndarray
    front_principal_from_first: np.ndarray
    rear_principal_from_last: np.ndarray
    front_nodal_from_first: np.ndarray
    rear_nodal_from_last: np.ndarray


def basis_rays(lens: Lens, wavelength_um: FloatOrArray, beside: tuple[FloatOrArray, ...] = ()) -> BasisRays:
    """Trace the two basis rays; arrays of shape (surfaces, *wavelength_um.shape).

    ``beside``: arrays that the result will be combined with; the wavelength is given as many axes as they have (of
    length one, in front, as numpy broadcasts), so that the surface axis remains the first.
    """
    if all([is_number(x) for x in (wavelength_um, *beside)]):
        return _basis_at(lens, float(wavelength_um))
    wavelength = np.asarray(wavelength_um, dtype=float)
    missing = max(map(np.ndim, beside), default=0) - wavelength.ndim
    return _basis(lens, wavelength.reshape((1,) * missing + wavelength.shape) if missing > 0 else wavelength)


@lru_cache(maxsize=64)
def _basis_at(lens: Lens, wavelength_um: float) -> BasisRays:
    """Return the basis rays of one wavelength, cached while depth and field change; write-protected."""
    rays = _basis(lens, np.asarray(wavelength_um))
    _ = [write_protect(values) for values in (rays.a, rays.b, rays.c, rays.d, rays.index)]
    return rays


def _basis(lens: Lens, wavelength: np.ndarray) -> BasisRays:
    index = indices(lens, wavelength)
    layers = index.tolist() if index.ndim == 1 else list(index)  # for one wavelength plain floats are ten times faster
    wave = wavelength if index.ndim > 1 else float(wavelength)
    steps = zip(lens.surfaces, lens.gaps, layers, layers[1:], strict=False)
    power, gap = zip(*((surface_power(s, n, after, wave), mm / after) for s, mm, n, after in steps), strict=True)
    rows = zip(march(power, gap, 1.0, 0.0), march(power, gap, 0.0, 1.0), strict=True)
    a, b, c, d = columns_of([(a, b, c, d) for (a, c), (b, d) in rows], index.shape[1:])
    return BasisRays(a, b, c, d, index, power, gap, wave)


def march(power: Iterable, gap: Iterable, y: FloatOrArray, nu: FloatOrArray) -> list[tuple]:
    """Return (height, reduced angle behind) at every surface for the ray (y, nu) at the first."""
    rows = []
    for strength, reduced in zip(power, gap, strict=False):
        nu = nu - strength * y
        rows.append((y, nu))
        y = y + reduced * nu
    return rows


def columns_of(rows: Sequence[tuple], shape: tuple[int, ...]) -> np.ndarray:
    """Return rows of numbers or arrays as arrays (surfaces, *shape), one per column."""
    if not shape:
        return np.array(rows, dtype=float).T
    columns = np.empty((len(rows[0]), len(rows), *shape))
    for number, row in enumerate(rows):  # assignment broadcasts a number in a tenth of the time of np.broadcast_to
        for column, values in zip(columns, row, strict=True):
            column[number] = values
    return columns


# An angle below this many roundings of the powers and gaps it depends on counts as zero: 32 allows for a focal length,
# and a gap derived from it, computed by a user in double precision.
ROUNDING = 32 * np.finfo(float).eps
SUSPICIOUS = 1e-9


def settled_angle(power: Iterable, gap: Iterable, y: np.ndarray, nu: np.ndarray) -> np.ndarray:
    """Return the last reduced angle of a ray, exactly 0 if it is only rounding of the inputs.

    ``y``, ``nu``: heights at, and reduced angles behind, the surfaces of ``power`` and ``gap``. A change of power
    changes the angle by −δ·y, a change of gap the height by δ·nu. By the Lagrange invariant of the ray and its change,
    the last angle of a ray that ends parallel to the axis moves by Σ(|δpower|y² + |δgap|nu²)/y_last.
    """
    last: np.ndarray = nu[-1]
    # Plain numbers are much faster in the usual case of one source.
    largest = max(map(abs, nu.tolist())) if nu.ndim == 1 else np.abs(nu).max(0)
    parallel = abs(last) <= SUSPICIOUS * largest
    if not anywhere(parallel):
        return last
    noise: FloatOrArray = sum(np.abs(p) * h * h for p, h in zip(power, y, strict=False))
    noise = noise + sum(np.abs(g) * v * v for g, v in zip(gap, nu[:-1], strict=False))
    return np.where(parallel & (np.abs(last * y[-1]) <= ROUNDING * noise), 0.0, last)


def chief_ray(rays: BasisRays, stop_surface: FloatOrArray) -> tuple[np.ndarray, np.ndarray]:
    """Return heights (surfaces, …) and reduced angles (surfaces + 1, …) of the ray (0, 1) at the stop's centre.

    It is traced outwards from the stop: computed from the basis rays at the first vertex, its height just behind the
    stop would be the difference of two large numbers. The reduced angle at either end is exactly zero if it is only
    rounding, that is, if that pupil is at infinity.
    """
    first, *others = (stop_surface,) if is_number(stop_surface) else np.unique(stop_surface)
    at = int(first) - 1
    y, nu = _cached_from_stop(rays, at) if rays.index.ndim == 1 else _from_stop(rays, at)
    for surface in others:
        here = np.asarray(stop_surface) == surface
        y, nu = (np.where(here, new, old) for new, old in zip(_from_stop(rays, int(surface) - 1), (y, nu), strict=True))
    return y, nu


def _from_stop(rays: BasisRays, at: int) -> tuple[np.ndarray, np.ndarray]:
    y, nu = _trace_branch(rays, rays.power[at:], rays.gap[at:])
    # mirrored: light runs left
    back_y, back_nu = _trace_branch(rays, (0.0, *rays.power[:at][::-1]), rays.gap[:at][::-1])
    return np.concatenate([-back_y[:0:-1], y]), np.concatenate([back_nu[::-1], nu])


@lru_cache(maxsize=64)
def _cached_from_stop(rays: BasisRays, at: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the chief ray of one wavelength, cached while depth and field change; write-protected."""
    y, nu = _from_stop(rays, at)
    return write_protect(y), write_protect(nu)


def _trace_branch(rays: BasisRays, power: tuple, gap: tuple) -> tuple[np.ndarray, np.ndarray]:
    """Return heights and reduced angles of the ray (0, 1) from the stop in one direction of travel."""
    y, nu = columns_of(march(power, (*gap, 0.0), 0.0, 1.0), rays.index.shape[1:])
    nu[-1] = settled_angle(power, gap, y, nu)
    return y, nu


def abcd(lens: Lens, wavelength_um: FloatOrArray) -> np.ndarray:
    """Return the system matrix from first to last vertex in reduced angles, shape (*wavelength_um.shape, 2, 2)."""
    rays = basis_rays(lens, wavelength_um)
    return np.stack([rays.a[-1], rays.b[-1], rays.c[-1], rays.d[-1]], axis=-1).reshape(*rays.a.shape[1:], 2, 2)


def cardinal_points(lens: Lens, wavelength_um: FloatOrArray) -> CardinalPoints:
    """Return focal, principal and nodal points (Welford 1986, §3); infinite for a lens afocal to rounding."""
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


def _lift(rays: BasisRays) -> np.ndarray:
    """Return A − 1, summed gap by gap: the difference itself loses all digits if the powers are weak."""
    return sum((gap * c for gap, c in zip(rays.gap[:-1], rays.c, strict=False)), np.zeros(rays.a.shape[1:]))


def _turn(rays: BasisRays) -> np.ndarray:
    """Return D − 1, summed power by power."""
    turn: np.ndarray = -sum(power * b for power, b in zip(rays.power, rays.b, strict=True))
    return turn


def _ratio(numerator: FloatOrArray, power: np.ndarray) -> np.ndarray:
    """Return numerator/power, infinite where the power is exactly zero (also for 0/0: there is no such point)."""
    return np.where(power == 0, np.inf, np.divide(numerator, power))


def image_distance(lens: Lens, depth_mm: FloatOrArray, wavelength_um: FloatOrArray) -> np.ndarray:
    """Return the paraxial image position from the last vertex, mm; infinite for an object in the front focal plane."""
    rays = basis_rays(lens, wavelength_um, (depth_mm,))
    height, angle = axial_ray(rays, depth_mm)
    return crossing(rays.image_index, height[-1], settled_angle(rays.power, rays.gap, height, angle))


def crossing(index: np.ndarray, height: np.ndarray, reduced_angle: np.ndarray) -> np.ndarray:
    """Return where a ray meets the axis, mm behind the plane of its height; +inf for a parallel ray."""
    if np.ndim(reduced_angle) == 0 and reduced_angle:  # ten times faster in the usual case of one source
        distance: np.ndarray = -index * height / reduced_angle
        return distance
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = np.where(reduced_angle == 0, np.inf, -index * height / reduced_angle)[()]
    return distance


def magnification(lens: Lens, depth_mm: FloatOrArray, wavelength_um: FloatOrArray) -> np.ndarray:
    """Return the transverse magnification nu/(n'u') of the axial ray; 0 for an object at infinity.

    Infinite for an image at infinity, except for an afocal lens, whose magnification is the same for every object.
    """
    rays = basis_rays(lens, wavelength_um, (depth_mm,))
    height, angle = axial_ray(rays, depth_mm)
    start = rays.object_index * vergence(depth_mm)
    last = settled_angle(rays.power, rays.gap, height, angle)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio: np.ndarray = np.where((start == 0) & (last == 0), 1 / rays.d[-1], start / last)[()]
    return ratio


def axial_ray(rays: BasisRays, depth_mm: FloatOrArray) -> tuple[np.ndarray, np.ndarray]:
    """Return heights at, and reduced angles behind, every surface of the axial ray of height 1 at the first vertex."""
    check_depth(depth_mm)
    start = rays.object_index * vergence(depth_mm)
    return rays.a + rays.b * start, rays.c + rays.d * start


def check_depth(depth_mm: FloatOrArray) -> None:
    """Raise GeometryError unless every depth is positive; infinity is allowed."""
    if isinstance(depth_mm, float) and depth_mm > 0:
        return
    depth = np.asarray(depth_mm, dtype=float)
    if not (depth > 0).all():
        bad = depth.ravel()[~(depth.ravel() > 0)][0]
        raise GeometryError(
            "depth is {depth:g} mm; the object must be a positive distance in front of the first vertex",
            depth=float(bad),
        )
