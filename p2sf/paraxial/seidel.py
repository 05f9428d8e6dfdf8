"""Seidel sums and the six wavefront coefficients: the spatially variant features (SVF) (handbook 3.2).

The sums are computed for a chief ray of unit field slope and multiplied by powers of the slope afterwards. So the work
depends on (depth, wavelength) only, and a zero field gives exactly zero.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import nan
from operator import add
from typing import Literal, cast

import numpy as np

from p2sf.arguments import same_values
from p2sf.conventions import UM_PER_MM, FloatOrArray
from p2sf.errors import GeometryError
from p2sf.lens.grating import Phase
from p2sf.lens.lens import Lens, Surface, indices, message_if_misaligned
from p2sf.lens.properties import PROPERTIES
from p2sf.messages import Message, ParameterName
from p2sf.paraxial.first_order import crossing
from p2sf.paraxial.pupils import ParaxialRays, Stop, paraxial_rays


@dataclass(frozen=True)
class SeidelSums:
    """S_I … S_V per surface in mm at one field, surface axis first, then of a curved sensor; ``.total()`` sums them."""

    __eq__ = same_values

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
    """The six coefficients in waves, peak values at this field, and the quantities that scale the PSF.

    Arrays broadcast over (depth, field, wavelength). ``reduced_slope`` is the signed n'u' of the marginal
    ray; ``image_distance`` and ``image_height`` (paraxial chief ray on the sensor) are mm.
    """

    __eq__ = same_values

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
        from p2sf.html import cell

        waves = (f"{name} {cell(getattr(self, name))}" for name in ("w40", "w31", "w22", "w20", "w11", "wd"))
        return f"<Coefficients in waves: {', '.join(waves)}; NA {cell(self.na)}>"

    def _repr_html_(self) -> str:
        from p2sf.html import html_table

        names = ("w40", "w31", "w22", "w20", "w11", "wd")
        return html_table("Wavefront coefficients", ("", "waves"), [(n.capitalize(), getattr(self, n)) for n in names])

    @property
    def na(self) -> np.ndarray:
        """Image-space numerical aperture n'|u'|."""
        na: np.ndarray = np.abs(self.reduced_slope)
        return na


def seidel_sums(lens: Lens, rays: ParaxialRays, field_slope: FloatOrArray = 1.0) -> SeidelSums:
    """Return the five sums per surface at these field slopes (Welford 1986, eqs 8.24 and 8.40 ff.).

    ``field_slope`` broadcasts against the rays' (depth, wavelength); the surface remains the first axis. Raises
    GeometryError for a surface with a term in r or r³.
    """
    check_seidel(lens)
    missing = (1,) * max(0, np.ndim(field_slope) + 1 - rays.y.ndim)
    unit = SeidelSums(*(x.reshape(len(x), *missing, *x.shape[1:]) for x in _unit_sums(lens, rays).columns()))
    powers = (1.0, field_slope, np.square(field_slope), np.square(field_slope), np.power(field_slope, 3))
    return SeidelSums(*(column * power for column, power in zip(unit.columns(), powers, strict=True)))


@dataclass(frozen=True)
class ChromaticSums:
    """C_I and C_II per surface in mm between two wavelengths at one field, surface axis first.

    ``axial``/2 is the difference of defocus at the rim of the pupil, shorter minus longer wavelength, as path, and
    ``lateral`` that of tilt.
    """

    __eq__ = same_values

    axial: np.ndarray
    lateral: np.ndarray


def chromatic_sums(
    lens: Lens, rays: ParaxialRays, shorter_um: float, longer_um: float, field_slope: FloatOrArray = 1.0
) -> ChromaticSums:
    """Return both sums per surface for the rays of one source, C_I = ΣAyΔ(δn/n) and C_II = ΣĀyΔ(δn/n), mm.

    δn is the index at ``shorter_um`` minus that at ``longer_um``, both vacuum wavelengths; everything else is at the
    wavelength of the rays. Exact to first order in δn. Raises GlassError. Source: Welford 1986, §10.3. A diffractive
    surface has different A before and behind it, and adds −2yδ(path of r²)·y: the limit of a thin lens of infinite
    index that is proportional to the wavelength (Sweatt 1977).
    """
    c, _ = _shape_terms(lens)
    n, after, nu, nu_after, y, chief_nu, chief_y = _layers(rays)
    relative = (indices(lens, shorter_um) - indices(lens, longer_um)) / rays.index
    bend = y * np.diff(relative, axis=0)  # yΔ(δn/n)
    snell, chief_snell = nu + n * y * c, chief_nu + n * chief_y * c  # A and Ā
    axial, lateral = snell * bend, chief_snell * bend
    axial[list(_ideal(lens))] = lateral[list(_ideal(lens))] = 0.0
    for at, diffraction in _diffractive(lens):
        jump = -2 * diffraction.path_terms(shorter_um - longer_um)[0] * y[at] * y[at]
        behind = nu_after[at] + after[at] * y[at] * c[at], rays.chief_nu[at + 1] + after[at] * chief_y[at] * c[at]
        axial[at] = y[at] * (behind[0] * relative[at + 1] - snell[at] * relative[at]) + jump
        chief_jump = -2 * diffraction.path_terms(shorter_um - longer_um)[0] * y[at] * chief_y[at]
        lateral[at] = y[at] * (behind[1] * relative[at + 1] - chief_snell[at] * relative[at]) + chief_jump
    return ChromaticSums(axial, lateral * field_slope)


def check_seidel(lens: Lens) -> None:
    """Raise GeometryError for a lens that no fourth-order wavefront describes."""
    if reason := reason_against_coefficients(lens):
        raise GeometryError(reason)


ALIGNED = Message(
    "parts of the lens are tilted, decentred or not of revolution; all paraxial figures and the six coefficients are "
    "those of the aligned lens, and leave out what that adds: coma on the axis, a tilted field"
)


def of_aligned_lens(lens: Lens) -> Message | None:
    """Return a warning that paraxial quantities leave out what of a lens is not symmetric, None where all is."""
    return message_if_misaligned(lens, ALIGNED)


@lru_cache(maxsize=64)
def reason_against_coefficients(lens: Lens) -> Message | None:
    """Return why a fourth-order wavefront cannot describe a lens, such as odd terms or a freeform; None if it can.

    The methods of the six coefficients refuse such a lens, and "auto" does not choose them for it.
    """
    for number, surface in enumerate(lens.surfaces, 1):
        for each in PROPERTIES:
            if reason := each.unseen(getattr(surface, each.name)):
                return Message(
                    "surface {surface} {reason}, for which there are no Seidel sums and no six coefficients; choose "
                    "the method fitted, traced or huygens",
                    surface=number,
                    reason=reason,
                )
    if lens.shading:
        return Message(
            "{shading}, for which there are no six coefficients; choose the method fitted, traced or huygens, or leave "
            "{parameter} off",
            shading=lens.shading,
            parameter=ParameterName("absorption"),
        )
    return None


def _unit_sums(lens: Lens, rays: ParaxialRays) -> SeidelSums:
    c, figure = (_per_surface(x, rays.y.ndim) for x in _shape_terms(lens))
    layers = _layers(rays)
    sums = surface_sums(rays.invariant, c, figure if np.count_nonzero(figure) else 0.0, layers)
    for at, diffraction in _diffractive(lens):
        sides, chief_behind = [column[at] for column in layers], rays.chief_nu[at + 1]
        paths = diffraction.path_terms(rays.wavelength_um)
        shape = float(c.flat[at]), float(figure.flat[at])
        here = diffractive_sums(rays.invariant, shape, paths, sides, chief_behind)
        sums = tuple(_with_row(column, at, value) for column, value in zip(sums, here, strict=True))
    for at in _ideal(lens):
        sums = tuple(_with_row(column, at, 0.0) for column in sums)
    if lens.sensor_surface.curvature:
        petzval, distortion = _sums_of_sensor(lens, rays)
        rows = (0.0, 0.0, 0.0, petzval, distortion)
        sums = tuple(
            np.concatenate([column, np.broadcast_to(row, column[:1].shape)])
            for column, row in zip(np.broadcast_arrays(*sums), rows, strict=True)
        )
    return SeidelSums(*sums)


def _sums_of_sensor(lens: Lens, rays: ParaxialRays) -> tuple[FloatOrArray, FloatOrArray]:
    height = rays.chief_y[-1] + rays.chief_nu[-1] / rays.index[-1] * lens.sensor_mm
    return sensor_sums(lens.sensor_surface.curvature, rays.nu[-1], height, rays.chief_nu[-1], rays.index[-1])


def sensor_sums(
    curvature: FloatOrArray, nu: FloatOrArray, height: FloatOrArray, chief_nu: FloatOrArray, index: FloatOrArray
) -> tuple[FloatOrArray, FloatOrArray]:
    """Return S_IV and S_V of a curved sensor, for numbers or arrays; the other three sums are 0.

    At the chief ray's ``height`` h the sensor lies z = ch²/2 behind its vertex. So W20 gains the defocus (n'u')²z/(2n')
    and the chief ray lands zū' farther out, of which W11/(n'u') is the shift (Welford 1986, §7.7).
    """
    bend = curvature * height * height * nu / index
    return bend * nu, bend * chief_nu


def _with_row(column: np.ndarray, at: int, value: FloatOrArray) -> np.ndarray:
    """Return a column of sums with the value of one surface replaced."""
    changed = column.copy()
    changed[at] = value
    return changed


@lru_cache(maxsize=64)
def _cached_totals(
    lens: Lens, depth_mm: float, wavelength_um: float, field: Literal["slope", "height"]
) -> tuple[ParaxialRays, tuple]:
    """Return the paraxial rays of one depth and wavelength and their `_unit_totals`, which apply to every field."""
    rays = paraxial_rays(lens, depth_mm, wavelength_um, None, field)
    return rays, _unit_totals(lens, rays)


def _unit_totals(lens: Lens, rays: ParaxialRays) -> tuple:
    """Return the five sums over all surfaces; for one source in plain numbers, which is three times faster."""
    if rays.y.ndim > 1 or _diffractive(lens) or _ideal(lens) or lens.sensor_surface.curvature:
        return tuple(map(np.add.reduce, _unit_sums(lens, rays).columns()))
    columns = (column.tolist() for column in (*_shape_terms(lens), *_layers(rays)))
    invariant = float(rays.invariant)
    rows = [surface_sums(invariant, c, figure, row) for c, figure, *row in zip(*columns, strict=True)]
    return tuple(map(sum, zip(*rows, strict=True)))


def _layers(rays: ParaxialRays) -> tuple[np.ndarray, ...]:
    """Return indices and both rays at every surface: n and n', nu and n'u', y, n·ū and ȳ."""
    index, nu = rays.index, rays.nu
    return index[:-1], index[1:], nu[:-1], nu[1:], rays.y, rays.chief_nu[:-1], rays.chief_y


def surface_sums(
    invariant: FloatOrArray,
    c: FloatOrArray,
    figure: FloatOrArray,
    layers: Sequence[FloatOrArray],
) -> tuple:
    """Return the five sums of a surface of curvature ``c`` and fourth-order ``figure``, for numbers or arrays.

    ``layers``: indices and both rays there, as returned by `_layers`.
    """
    n, after, nu, nu_after, y, chief_nu, chief = layers
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


def diffractive_sums(
    invariant: FloatOrArray,
    shape: tuple[float, float],
    paths: tuple[FloatOrArray, FloatOrArray],
    layers: Sequence[FloatOrArray],
    chief_nu_after: FloatOrArray,
) -> tuple:
    """Return the five sums of a diffractive surface that adds the ``paths`` (p, q): p·r² + q·r⁴.

    ``shape``: its curvature and its fourth-order figure; ``chief_nu_after``: n'·ū' behind it. It is a thin lens of
    index N → ∞ whose thickness is the added path divided by N (Sweatt 1977). The sums of its two surfaces in
    `surface_sums` tend to those of either side, with u/n = 0 inside, and the figuring of the second tends to −(8q −
    2pc²)y⁴: along the normal the path is p·r², along the axis p·r²(1 + c²r²/2), and the sphere of its curvature, c +
    2p/N, accounts for 3c²p·r⁴/4 of that.
    """
    (c, figure), (n, after, nu, nu_after, y, chief_nu, chief) = shape, layers
    before = _side_sums(invariant, c, n, nu, y, chief_nu, chief)
    behind = _side_sums(invariant, c, after, nu_after, y, chief_nu_after, chief)
    second, fourth = paths
    figured = _figuring(figure * (after - n) - (8 * fourth - 2 * second * c * c), y, chief)
    return tuple(out - into + more for into, out, more in zip(before, behind, figured, strict=True))


def _side_sums(
    invariant: FloatOrArray,
    c: float,
    n: FloatOrArray,
    nu: FloatOrArray,
    y: FloatOrArray,
    chief_nu: FloatOrArray,
    chief: FloatOrArray,
) -> tuple[FloatOrArray, ...]:
    """Return the terms on one side of a surface whose differences across it are the five sums (Welford 1986, ch. 8)."""
    inverse = 1 / n
    square = inverse * inverse
    snell, chief_snell = nu + n * y * c, chief_nu + n * chief * c
    bend, petzval = -y * nu * square, c * inverse
    distortion = (invariant + chief_snell * y) * chief * petzval - chief_snell * chief_snell * y * square
    return (
        snell * snell * bend,
        snell * chief_snell * bend,
        chief_snell * chief_snell * bend,
        -(invariant * invariant) * petzval,
        chief_snell * distortion,
    )


def _figuring(figure: FloatOrArray, y: FloatOrArray, chief: FloatOrArray) -> tuple[FloatOrArray, ...]:
    """Return the terms of an asphere, (Kc³ + 8A₄)Δn, in the five sums, without division by y (Welford 1986, ch. 8)."""
    square, cross = figure * y * y, chief * chief
    return square * y * y, square * y * chief, square * cross, 0.0, figure * y * chief * cross


@lru_cache(maxsize=64)
def _shape_terms(lens: Lens) -> tuple[np.ndarray, np.ndarray]:
    """Return the curvature c at the vertex and the fourth-order figure Kc³ + 8A₄ of every surface, each (surfaces,).

    The figure is NaN where `check_seidel` refuses the surface.
    """
    c, figure = zip(*map(_shape_of, lens.surfaces), strict=True)
    return np.array(c), np.array(figure)


def _shape_of(surface: Surface) -> tuple[float, float]:
    """Return the curvature c at the vertex, and 8 times the excess of the r⁴ term over c³/8, that of its sphere."""
    c, a4 = surface.curvature, surface.aspheric[0] if surface.aspheric else 0.0
    figure = surface.conic * c**3 + 8 * a4
    if surface.shape is None:
        return c, figure
    first, second, third, fourth = surface.shape.series(c)
    if first or third or not surface.shape.radial:
        return c + 2 * second, nan
    # (c + 2s)³ − c³ without the difference of large numbers
    return c + 2 * second, figure + 8 * fourth - 2 * second * (3 * c * c + 6 * c * second + 4 * second * second)


@lru_cache(maxsize=64)
def _diffractive(lens: Lens) -> tuple[tuple[int, Phase], ...]:
    """Return the diffractive surfaces: their indices from 0, and their diffraction."""
    return tuple((at, s.diffraction) for at, s in enumerate(lens.surfaces) if s.diffraction is not None)


@lru_cache(maxsize=64)
def _ideal(lens: Lens) -> tuple[int, ...]:
    """Return the indices of ideal lenses from 0: they contribute nothing to any sum."""
    return tuple(at for at, surface in enumerate(lens.surfaces) if surface.ideal)


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

    ``depth_mm`` from the first vertex, ``inf`` allowed; ``field_slope`` the tangent at the entrance pupil, or with
    ``field="height"`` the distance of the object below the axis in mm; the sensor is that of the lens (`with_sensor`
    moves it). W40 to W11 are NaN for a surface with a term in r or r³ (`check_seidel`). Raises GeometryError and
    GlassError. Source: Pieroni et al. 2015; Welford 1986, ch. 8.
    """
    # [()] converts 0-d arrays to scalars, on which numpy is five times faster.
    wavelength_um, field_slope = (np.asarray(x, dtype=float)[()] for x in (wavelength_um, field_slope))
    if stop is None and np.ndim(depth_mm) == 0 and np.ndim(wavelength_um) == 0:
        rays, totals = _cached_totals(lens, float(cast(float, depth_mm)), float(wavelength_um), field)
    else:
        rays = paraxial_rays(lens, depth_mm, wavelength_um, stop, field)
        totals = _unit_totals(lens, rays)
    spherical, coma, astigmatism, petzval, distortion = totals
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
