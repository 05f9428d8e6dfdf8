"""The whole (depth, field, wavelength) space of a lens as polynomials, exact to round-off (handbook 7.1).

At a fixed stop, with field as the slope at the entrance pupil and s = 1/(distance from object to
entrance pupil), the marginal ray is linear in s: it is the ray of the infinite object plus s·(pupil
radius)·(chief ray of unit slope). So every Seidel sum is a polynomial in s, with no singular depth.
In wavelength everything is as smooth as the glasses, hence a Chebyshev series.

Per wavelength: W40 5, W31 4, W22 3, Petzval 1, W11 2, u' 2, last height 2, chief ray 2, and 1 each for the place of
the entrance pupil and the index of image space: 23 numbers, from which the coefficients at any depth follow.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from math import acos, inf

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import vergence
from p2sf.database.parts import Numbers, Parts, assemble
from p2sf.database.space import Space
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.errors import DatabaseError
from p2sf.lens.lens import Lens
from p2sf.paraxial.pupils import ParaxialRays, Stop, paraxial_rays
from p2sf.paraxial.seidel import Coefficients, seidel_sums, sensor_sums

# Numbers per wavelength of each part: a polynomial's degree in s, plus one.
LENGTHS = {
    "w40": 5,
    "w31": 4,
    "w22": 3,
    "petzval": 1,
    "w11": 2,
    "nu": 2,
    "y": 2,
    "chief_y": 1,
    "chief_nu": 1,
    "pupil": 1,
    "image_index": 1,
}
NUMBERS = sum(LENGTHS.values())
PUPIL = NUMBERS - 2
T_NODES = np.cos(np.pi * (np.arange(5) + 0.5) / 5)


@dataclass(frozen=True, eq=False)
class ExactDatabase:
    """Twenty-three numbers per wavelength, as Chebyshev series in wavelength over ``space``.

    ``series``: (terms, 23), mm and mm of path, polynomial coefficients in t = (s − ``middle``)/``half``. ``sensor_mm``:
    position of the sensor; at any other position the coefficients are equally exact. ``sensor_curvature``: its, per mm.
    ``errors``: the largest departure
    of each coefficient from direct evaluation at points between the nodes, in waves. ``mask``: the pupil mask in the
    coordinates of a source whose chief ray lands at +y; the coefficients do not depend on it.
    """

    space: Space
    series: np.ndarray
    middle: float
    half: float
    sensor_mm: float
    errors: dict[str, float]
    interpolant: str = "exact"
    method: str = "seidel"
    mask: PupilMask = CLEAR
    sensor_curvature: float = 0.0

    def with_sensor(self, sensor_mm: float) -> "ExactDatabase":
        """Return the same database with the sensor ``sensor_mm`` behind the last vertex; nothing is traced."""
        return replace(self, sensor_mm=float(sensor_mm))

    def coefficients(self, depth_mm: ArrayLike, field_slope: ArrayLike, wavelength_um: ArrayLike) -> Coefficients:
        """Return the six coefficients at one point or over broadcast arrays; DatabaseError outside the space."""
        if isinstance(depth_mm, float) and isinstance(field_slope, float) and isinstance(wavelength_um, float):
            self.space.check_one(depth_mm, field_slope, wavelength_um)
            angle = acos(min(1.0, max(-1.0, self._reduce(wavelength_um))))
            numbers = (np.cos(self._orders * angle) @ self.series).tolist()
            return self._evaluate(numbers, 1.0 / depth_mm, field_slope, wavelength_um)
        self.space.check(depth_mm, field_slope, wavelength_um)
        wavelength = np.asarray(wavelength_um, dtype=float)
        numbers = self.series.T @ chebyshev_terms(self._reduce(wavelength.ravel()), len(self.series))
        numbers = numbers.reshape(NUMBERS, *wavelength.shape)
        return self._evaluate(numbers, vergence(depth_mm), np.asarray(field_slope, dtype=float), wavelength)

    def pupil_mm(self, wavelength_um: float) -> float:
        """Return the position of the entrance pupil, mm from the first vertex."""
        terms = chebyshev_terms(np.asarray(self._reduce(wavelength_um)), len(self.series))
        return float(terms @ self.series[:, PUPIL])

    @cached_property
    def _orders(self) -> np.ndarray:
        return np.arange(len(self.series))

    @cached_property
    def _mapping(self) -> tuple[float, float]:
        low, high = float(self.space.wavelengths_um[0]), float(self.space.wavelengths_um[-1])
        return (low + high) / 2, 2 / (high - low) if high > low else 0.0

    def _reduce(self, wavelength: Numbers) -> Numbers:
        middle, slope = self._mapping
        return (wavelength - middle) * slope

    def _evaluate(self, numbers: Numbers, near: Numbers, slope: Numbers, wavelength: Numbers) -> Coefficients:
        """Sum the polynomials in s by Horner's rule, from the 23 numbers at each wavelength."""
        a0, a1, a2, a3, a4, b0, b1, b2, b3, c0, c1, c2, petzval, d0, d1, nu0, nu1, y0, y1, *last = numbers
        chief_y, chief_nu, pupil, index = last
        t = (near / (1.0 + pupil * near) - self.middle) / self.half
        astigmatism = c0 + t * (c1 + t * c2)
        nu, y = nu0 + t * nu1, y0 + t * y1
        chief = chief_y + chief_nu / index * self.sensor_mm
        distortion = d0 + t * d1
        if self.sensor_curvature:
            more = sensor_sums(self.sensor_curvature, nu, chief, chief_nu, index)
            petzval, distortion = petzval + more[0] / 4, distortion + more[1] / 2
        parts = Parts(
            w40=a0 + t * (a1 + t * (a2 + t * (a3 + t * a4))),
            w31=b0 + t * (b1 + t * (b2 + t * b3)),
            w22=astigmatism,
            w20=astigmatism / 2 + petzval,
            w11=distortion,
            wd=nu * (nu / index * self.sensor_mm + y) / 2,
            nu=nu,
            y=y,
            chief=chief,
            image_index=index,
        )
        return assemble(parts, (slope, slope * slope, slope * slope * slope), wavelength)


def chebyshev_terms(x: np.ndarray, count: int) -> np.ndarray:
    """Return T_0 … T_{count−1} at x, shape (count, *x.shape), by the recurrence T_{k+1} = 2x·T_k − T_{k−1}."""
    terms = np.empty((count, *x.shape))
    terms[0] = 1
    terms[1:2] = x
    for k in range(2, count):
        np.multiply(2 * x, terms[k - 1], out=terms[k, ...])
        terms[k] -= terms[k - 2]
    return terms


def exact_series(lens: Lens, space: Space, stop: Stop, terms: int) -> tuple[np.ndarray, float, float]:
    """Return the Chebyshev series (terms, 23), and the middle and half-width of the range of s, per mm."""
    points = np.cos(np.pi * (np.arange(terms) + 0.5) / terms)
    low, high = space.wavelengths_um[0], space.wavelengths_um[-1]
    base = paraxial_rays(lens, np.inf, (low + high) / 2 + (high - low) / 2 * points, stop)
    middle, half = _range_of_s(-base.chief_y[0], space)
    rows = _polynomials(lens, base, middle, half)
    kernel = np.cos(np.outer(np.arange(terms), np.arccos(points))) * (2 / terms)
    kernel[0] /= 2
    return kernel @ rows.T, middle, half


def _range_of_s(pupil: np.ndarray, space: Space) -> tuple[float, float]:
    """Return middle and half-width of s over the requested depths; DatabaseError if the pupil lies among them.

    A range starting at 0 would lose digits for a lens with a distant pupil.
    """
    near = vergence(space.depths_mm[[0, -1], None])
    reach = 1 + pupil * near
    if reach.min() <= 0 <= reach.max():
        raise DatabaseError(
            "the entrance pupil, {pupil:.6g} mm before the first vertex, lies among the depths, {near:g} to {far:g} "
            "mm; build one database on either side of it",
            pupil=-float(pupil.flat[0]),
            near=float(space.depths_mm[0]),
            far=float(space.depths_mm[-1]),
        )
    s = near / reach
    middle = float(s.max() + s.min()) / 2
    return middle, float(np.ptp(s)) / 2 or abs(middle) / 2 or 1e-6  # one depth: any width that keeps digits


def _polynomials(lens: Lens, base: ParaxialRays, middle: float, half: float) -> np.ndarray:
    """Return the 23 numbers at each wavelength of ``base``, shape (23, wavelengths)."""
    flat = replace(lens, sensor_radius=inf) if lens.sensor_surface.curvature else lens
    sums = seidel_sums(flat, rays_at(base, middle + half * T_NODES[:, None])).total()
    centre, step = rays_at(base, middle), half * base.invariant / base.index[0]
    quartic = np.linalg.inv(np.vander(T_NODES, increasing=True))
    columns = {
        "w40": quartic @ sums.spherical / 8,
        "w31": quartic @ sums.coma / 2,
        "w22": quartic @ sums.astigmatism / 2,
        "petzval": np.atleast_2d(sums.petzval)[:1] / 4,
        "w11": quartic @ sums.distortion / 2,
        "nu": np.stack([centre.nu[-1, 0], step * base.chief_nu[-1]]),
        "y": np.stack([centre.y[-1, 0], step * base.chief_y[-1]]),
        "chief_y": base.chief_y[-1:],
        "chief_nu": base.chief_nu[-1:],
        "pupil": -base.chief_y[:1],
        "image_index": base.index[-1:],
    }
    return np.concatenate([columns[name][:length] for name, length in LENGTHS.items()])


def rays_at(base: ParaxialRays, s: float | np.ndarray) -> ParaxialRays:
    """Return the rays for an object 1/s before the entrance pupil, from those for one at infinity.

    The marginal ray gains s·(pupil radius)·(chief ray of unit slope): the two meet the pupil at its rim and
    at its centre, so their sum still passes the rim. ``s``: (…, 1) or a number, per mm.
    """
    lift = s * base.invariant / base.index[0]
    y, nu, chief_y, chief_nu, index = (x[:, None] for x in (base.y, base.nu, base.chief_y, base.chief_nu, base.index))
    moved = y + lift * chief_y, nu + lift * chief_nu
    return replace(base, y=moved[0], nu=moved[1], chief_y=chief_y, chief_nu=chief_nu, index=index)
