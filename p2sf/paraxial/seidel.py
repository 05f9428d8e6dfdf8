"""Seidel sums and the six wavefront coefficients: the spatially variant features (SVF) (handbook 3.2).

The chief ray enters with unit field slope; its powers multiply the sums afterwards. That keeps the
work on (depth, wavelength) only and gives exactly zero for a zero field.
"""

from dataclasses import dataclass
from functools import lru_cache
from operator import add
from typing import Literal

import numpy as np

from p2sf.conventions import UM_PER_MM, FloatOrArray
from p2sf.lens.lens import Lens, indices
from p2sf.notebook import cell, html_table
from p2sf.paraxial.first_order import crossing
from p2sf.paraxial.pupils import ParaxialRays, Stop, paraxial_rays


@dataclass(frozen=True)
class SeidelSums:
    """S_I … S_V per surface in mm at one field, surface axis first; ``.total()`` sums them."""

    spherical: np.ndarray
    coma: np.ndarray
    astigmatism: np.ndarray
    petzval: np.ndarray
    distortion: np.ndarray

    def total(self) -> "SeidelSums":
        """Return the sums over all surfaces."""
        return SeidelSums(*[np.add.reduce(column) for column in self.columns()])

    def columns(self) -> tuple[np.ndarray, ...]:
        """Return S_I, S_II, S_III, S_IV, S_V in this order."""
        return self.spherical, self.coma, self.astigmatism, self.petzval, self.distortion


@dataclass(frozen=True)
class Coefficients:
    """The six coefficients in waves, peak values at this field, and what scales the PSF.

    Arrays broadcast over (depth, field, wavelength). ``reduced_slope`` is the signed n'u' of the marginal
    ray; ``image_distance`` and ``image_height`` (paraxial chief ray on the sensor) are mm.
    """

    w40: np.ndarray
    w31: np.ndarray
    w22: np.ndarray
    w20: np.ndarray
    w11: np.ndarray
    wd: np.ndarray
    reduced_slope: np.ndarray
    image_index: np.ndarray
    image_distance: np.ndarray
    image_height: np.ndarray
    wavelength_um: np.ndarray

    def __repr__(self) -> str:
        waves = (f"{name} {cell(getattr(self, name))}" for name in ("w40", "w31", "w22", "w20", "w11", "wd"))
        return f"<Coefficients in waves: {', '.join(waves)}; NA {cell(self.na)}>"

    def _repr_html_(self) -> str:
        names = ("w40", "w31", "w22", "w20", "w11", "wd")
        return html_table("Wavefront coefficients", ("", "waves"), [(n.capitalize(), getattr(self, n)) for n in names])

    @property
    def na(self) -> np.ndarray:
        """Image-space numerical aperture n'|u'|."""
        na: np.ndarray = np.abs(self.reduced_slope)
        return na


def seidel_sums(lens: Lens, rays: ParaxialRays, field_slope: FloatOrArray = 1.0) -> SeidelSums:
    """Return the five sums per surface at these field slopes (Welford 1986, eqs 8.24 and 8.40 ff.).

    ``field_slope`` broadcasts against the rays' (depth, wavelength); the surface stays the first axis.
    """
    missing = (1,) * max(0, np.ndim(field_slope) + 1 - rays.y.ndim)
    unit = SeidelSums(*(x.reshape(len(x), *missing, *x.shape[1:]) for x in _unit_sums(lens, rays).columns()))
    powers = (1.0, field_slope, np.square(field_slope), np.square(field_slope), np.power(field_slope, 3))
    return SeidelSums(*(column * power for column, power in zip(unit.columns(), powers, strict=True)))


@dataclass(frozen=True)
class ChromaticSums:
    """C_I and C_II per surface in mm between two wavelengths at one field, surface axis first.

    ``axial``/2 is what the shorter wavelength's defocus at the pupil's rim exceeds the longer one's by, as path, and
    ``lateral`` what its tilt does.
    """

    axial: np.ndarray
    lateral: np.ndarray


def chromatic_sums(
    lens: Lens, rays: ParaxialRays, shorter_um: float, longer_um: float, field_slope: FloatOrArray = 1.0
) -> ChromaticSums:
    """Return both sums per surface for the rays of one source, C_I = ΣAyΔ(δn/n) and C_II = ΣĀyΔ(δn/n), mm.

    δn is the index at ``shorter_um`` less that at ``longer_um``, both in vacuum; everything else is of the rays' own
    wavelength. Exact to first order in δn. Raises GlassError. Source: Welford 1986, §10.3.
    """
    c, _ = _shape_terms(lens)
    n, _, nu, _, y, chief_nu, chief_y = _layers(rays)
    relative = (indices(lens, shorter_um) - indices(lens, longer_um)) / rays.index
    bend = y * np.diff(relative, axis=0)  # yΔ(δn/n)
    snell, chief_snell = nu + n * y * c, chief_nu + n * chief_y * c  # A and Ā
    return ChromaticSums(snell * bend, chief_snell * bend * field_slope)


def _unit_sums(lens: Lens, rays: ParaxialRays) -> SeidelSums:
    c, figure = (_per_surface(x, rays.y.ndim) for x in _shape_terms(lens))
    return SeidelSums(*surface_sums(rays.invariant, c, figure if np.count_nonzero(figure) else 0.0, *_layers(rays)))


def _unit_totals(lens: Lens, rays: ParaxialRays) -> tuple:
    """Return the five sums over all surfaces; for one source in plain numbers, three times faster."""
    if rays.y.ndim > 1:
        return tuple(map(np.add.reduce, _unit_sums(lens, rays).columns()))
    columns = (column.tolist() for column in (*_shape_terms(lens), *_layers(rays)))
    invariant = float(rays.invariant)
    rows = [surface_sums(invariant, *row) for row in zip(*columns, strict=True)]
    return tuple(map(sum, zip(*rows, strict=True)))


def _layers(rays: ParaxialRays) -> tuple[np.ndarray, ...]:
    """Return indices and both rays at every surface: n and n', nu and n'u', y, n·ū and ȳ."""
    index, nu = rays.index, rays.nu
    return index[:-1], index[1:], nu[:-1], nu[1:], rays.y, rays.chief_nu[:-1], rays.chief_y


def surface_sums(
    invariant: FloatOrArray,
    c: FloatOrArray,
    figure: FloatOrArray,
    n: FloatOrArray,
    after: FloatOrArray,
    nu: FloatOrArray,
    nu_after: FloatOrArray,
    y: FloatOrArray,
    chief_nu: FloatOrArray,
    chief: FloatOrArray,
) -> tuple:
    """Return the five sums of a surface of curvature ``c`` and fourth-order ``figure``; numbers or arrays alike."""
    inverse, inverse_after = 1 / n, 1 / after
    square, square_after = inverse * inverse, inverse_after * inverse_after
    snell, chief_snell = nu + n * y * c, chief_nu + n * chief * c  # A and Ā
    bend = y * (nu * square - nu_after * square_after)  # −y Δ(u/n)
    petzval = c * (inverse_after - inverse)
    coma, chief_square = snell * bend, chief_snell * chief_snell
    distortion = (invariant + chief_snell * y) * chief * petzval - chief_square * y * (square_after - square)
    sums = (
        snell * coma,
        chief_snell * coma,
        chief_square * bend,
        -(invariant * invariant) * petzval,
        chief_snell * distortion,
    )
    if isinstance(figure, float) and not figure:
        return sums
    return tuple(map(add, sums, _figuring(figure * (after - n), y, chief)))


def _figuring(figure: FloatOrArray, y: FloatOrArray, chief: FloatOrArray) -> tuple[FloatOrArray, ...]:
    """Return what an asphere, (Kc³ + 8A₄)Δn, adds to the five sums, without division by y (Welford 1986, ch. 8)."""
    square, cross = figure * y * y, chief * chief
    return square * y * y, square * y * chief, square * cross, 0.0, figure * y * chief * cross


@lru_cache(maxsize=64)
def _shape_terms(lens: Lens) -> tuple[np.ndarray, np.ndarray]:
    """Return curvature c and fourth-order figure Kc³ + 8A₄ of every surface, each (surfaces,)."""
    rows = ((s.curvature, s.conic, s.aspheric[0] if s.aspheric else 0.0) for s in lens.surfaces)
    c, figure = zip(*((c, conic * c**3 + 8 * a4) for c, conic, a4 in rows), strict=True)
    return np.array(c), np.array(figure)


def _per_surface(column: np.ndarray, ndim: int) -> np.ndarray:
    return column.reshape(-1, *[1] * (ndim - 1))


def coefficients(
    lens: Lens,
    depth_mm: FloatOrArray,
    field_slope: FloatOrArray,
    wavelength_um: FloatOrArray,
    stop: Stop | None = None,
    field: Literal["slope", "height"] = "slope",
) -> Coefficients:
    """Return the six coefficients over broadcast (depth, field, wavelength) arrays.

    ``depth_mm`` from the first vertex, ``inf`` allowed; ``field_slope`` the tangent at the entrance
    pupil, or with ``field="height"`` the mm the object stands below the axis; the sensor is where the lens
    puts it (`with_sensor` moves it). Raises GeometryError and GlassError.
    Source: Pieroni et al. 2015; Welford 1986, ch. 8.
    """
    # [()] turns arrays without axes into numbers, on which numpy is five times faster.
    wavelength_um, field_slope = (np.asarray(x, dtype=float)[()] for x in (wavelength_um, field_slope))
    rays = paraxial_rays(lens, depth_mm, wavelength_um, stop, field)
    spherical, coma, astigmatism, petzval, distortion = _unit_totals(lens, rays)
    waves = UM_PER_MM / wavelength_um
    index = rays.index[-1]
    square = field_slope * field_slope
    image = crossing(index, rays.y[-1], rays.nu[-1])
    chief = rays.chief_y[-1] + rays.chief_nu[-1] / index * lens.sensor_mm
    return Coefficients(
        w40=spherical * waves / 8,
        w31=coma * waves / 2 * field_slope,
        w22=astigmatism * waves / 2 * square,
        w20=(astigmatism + petzval) * waves / 4 * square,
        w11=distortion * waves / 2 * (field_slope * square),
        wd=defocus(rays, lens.sensor_mm) * waves,
        reduced_slope=rays.nu[-1],
        image_index=index,
        image_distance=image,
        image_height=chief * field_slope,
        wavelength_um=wavelength_um,
    )


def defocus(rays: ParaxialRays, sensor_mm: float) -> np.ndarray:
    """Return the defocus in mm of path, n'u'(u'·sensor + y)/2, which is regular at every depth."""
    slope = rays.nu[-1] / rays.index[-1]
    path: np.ndarray = rays.nu[-1] * (slope * sensor_mm + rays.y[-1]) / 2
    return path
