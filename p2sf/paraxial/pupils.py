"""Aperture stop, entrance and exit pupil, marginal and chief ray: the quasi-invariant features (qSIF).

See handbook 2.2.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Literal

import numpy as np

from p2sf.arguments import same_values
from p2sf.conventions import FloatOrArray, anywhere, slope_from_degrees, vergence
from p2sf.errors import GeometryError
from p2sf.lens.lens import Aperture, Lens
from p2sf.messages import Message
from p2sf.paraxial.first_order import (
    BasisRays,
    axial_ray,
    basis_rays,
    check_depth,
    chief_ray,
    crossing,
    settled_angle,
)

# Rims whose cones differ by less than the rounding of a prescription to six digits are a tie, without a warning.
RIM_TIE = 2e-6
# Closer to the entrance pupil than a few roundings of its distance, the cone of light is rounding noise.
OBJECT_IN_PUPIL = 8 * np.finfo(float).eps


@dataclass(frozen=True)
class Stop:
    """The stop in use: its surface (from 1), its rim in mm, how it was chosen, and which rim limits the axial cone.

    ``surface``, ``semi_diameter`` and ``limiting_surface`` are numbers or arrays over (depth, wavelength).
    """

    __eq__ = same_values

    surface: np.ndarray
    semi_diameter: np.ndarray
    limiting_surface: np.ndarray
    chosen_by: str

    @property
    def warning(self) -> Message | None:
        """Return a warning if another rim limits the axial cone for some depth or wavelength, else None."""
        clash = np.asarray(self.limiting_surface != self.surface)
        if not clash.any():
            return None
        rim = int(np.broadcast_to(self.limiting_surface, clash.shape)[clash].ravel()[0])
        stop = int(np.broadcast_to(self.surface, clash.shape)[clash].ravel()[0])
        return Message(
            "the rim of surface {rim} is narrower for this object than the stop on surface {stop}; the stop is kept, "
            "choose stop auto to use the narrowest rim",
            rim=rim,
            stop=stop,
        )


@dataclass(frozen=True)
class Pupils:
    """Positions of entrance and exit pupil, mm, positive to the right of the named vertex; infinite if telecentric.

    ``upright``: −1 if the entrance pupil is an inverted image of the stop, as in a relay, else 1.
    """

    __eq__ = same_values

    entrance_from_first: np.ndarray
    entrance_diameter: np.ndarray
    exit_from_last: np.ndarray
    exit_diameter: np.ndarray
    upright: np.ndarray


@dataclass(frozen=True)
class ParaxialRays:
    """Marginal ray, and the chief ray of unit field slope, at every surface; surface axis first.

    ``y``, ``chief_y``: heights (surfaces, …), mm. ``nu``, ``chief_nu``: reduced angles (surfaces + 1, …).
    ``invariant``: the Lagrange invariant, n·(entrance-pupil radius) for a chief ray of unit slope.
    ``wavelength_um``: in the shape of one row of ``index``.
    """

    __eq__ = same_values

    y: np.ndarray
    nu: np.ndarray
    chief_y: np.ndarray
    chief_nu: np.ndarray
    index: np.ndarray
    invariant: np.ndarray
    wavelength_um: FloatOrArray


def find_stop(
    lens: Lens, depth_mm: FloatOrArray = np.inf, wavelength_um: FloatOrArray | None = None, mode: str = "file"
) -> Stop:
    """Return the aperture stop per (depth, wavelength): the file's (``mode="file"``) or the limiting rim (``"auto"``).

    The search follows Pieroni et al. 2015 (qSIF): of all rims, the one that the axial ray meets at the greatest
    fraction of its radius limits the cone. In a tie the file's stop is kept. Raises GeometryError if no stop can be
    found.
    """
    wavelength = lens.reference_wavelength_um if wavelength_um is None else wavelength_um
    rays = basis_rays(lens, wavelength, (depth_mm,))
    named = lens.stop_surface or default_stop(lens)
    rim = stop_rim(lens)
    limiting = _limiting_surface(lens, rays, depth_mm, named, rim)
    if mode == "file":
        return Stop(np.asarray(named), np.asarray(rim), limiting, "file" if lens.stop_surface else "auto")
    if mode != "auto":
        raise GeometryError('stop "{mode}" is unknown; choose "file" or "auto"', mode=mode)
    rims = rim_radii(lens, named, rim)
    return Stop(limiting, rims[limiting - 1], limiting, "auto")


def file_stop(lens: Lens) -> tuple[int, float]:
    """Return the file's stop surface (from 1), or the limiting rim if it names none, and its rim in mm."""
    return lens.stop_surface or default_stop(lens), stop_rim(lens)


def rim_radii(lens: Lens, named: int, rim: float) -> np.ndarray:
    """Return clear semi-diameters in mm, shape (surfaces,), with that of the stop replaced by its rim."""
    rims = np.array([surface.semi_diameter for surface in lens.surfaces], float)
    rims[named - 1] = rim
    return rims


def default_stop(lens: Lens) -> int:
    """Return the stop of a lens that states none: the limiting rim for infinity at the reference wavelength."""
    rims = np.array([np.inf if surface.rim else surface.semi_diameter for surface in lens.surfaces])
    if not np.isfinite(rims).any():
        raise GeometryError("the lens names no stop surface and no semi-diameters; state one of them")
    rays = basis_rays(lens, lens.reference_wavelength_um)
    return int(np.argmax(np.abs(rays.a) / rims)) + 1


def _limiting_surface(lens: Lens, rays: BasisRays, depth_mm: FloatOrArray, named: int, rim: float) -> np.ndarray:
    height, _ = axial_ray(rays, depth_mm)
    rims = rim_radii(lens, named, rim)
    rims[[number != named and s.rim is not None for number, s in enumerate(lens.surfaces, 1)]] = np.inf
    fraction = np.abs(height) / rims.reshape(-1, *[1] * (height.ndim - 1))
    fraction[named - 1] *= 1 + RIM_TIE
    limiting: np.ndarray = np.argmax(fraction, axis=0) + 1
    return limiting


def stop_rim(lens: Lens) -> float:
    """Return the semi-diameter of the stop in mm, however the aperture is stated.

    Raises GeometryError for an f-number of an afocal lens, or a pupil diameter when the pupil is at infinity.
    """
    if lens.aperture.kind == "stop_semi_diameter":
        return lens.aperture.value
    rays = basis_rays(lens, lens.reference_wavelength_um)
    _, nu = chief_ray(rays, lens.stop_surface or default_stop(lens))
    scale = abs(float(nu[0]))
    if scale == 0:
        raise GeometryError("the entrance pupil is at infinity, so it has no diameter; state the stop's semi-diameter")
    if lens.aperture.kind == "entrance_pupil_diameter":
        return lens.aperture.value / 2 * scale
    power = abs(float(settled_angle(rays.power, rays.gap, rays.a, rays.c)))
    if power == 0:
        raise GeometryError("an afocal lens has no f-number; state the stop's semi-diameter or the pupil's diameter")
    return scale / (2 * power * lens.aperture.value)


@lru_cache(maxsize=64)
def with_fixed_stop(lens: Lens) -> Lens:
    """Return the same lens with its aperture stated as the stop and the radius of its rim.

    An f-number or a pupil diameter is a specification, which every edit of a surface meets with another rim. The iris
    of a lens that has been built does not change: fix it before applying manufacturing errors. Raises GeometryError as
    `stop_rim` does.
    """
    surface, rim = file_stop(lens)
    return replace(lens, stop_surface=surface, aperture=Aperture("stop_semi_diameter", float(rim)))


def pupils(lens: Lens, wavelength_um: FloatOrArray, stop: Stop | None = None) -> Pupils:
    """Return entrance and exit pupil, mm, over the wavelength and the (depth, wavelength) axes of ``stop``."""
    stop = stop or find_stop(lens)
    rays = basis_rays(lens, wavelength_um, (stop.surface,))
    y, nu = chief_ray(rays, stop.surface)
    with np.errstate(divide="ignore"):
        return Pupils(
            entrance_from_first=crossing(rays.object_index, y[0], nu[0]),
            entrance_diameter=2 * stop.semi_diameter / np.abs(nu[0]),
            exit_from_last=crossing(rays.image_index, y[-1], nu[-1]),
            exit_diameter=2 * stop.semi_diameter / np.abs(nu[-1]),
            upright=1.0 - 2.0 * (nu[0] < 0),
        )


def paraxial_rays(
    lens: Lens,
    depth_mm: FloatOrArray,
    wavelength_um: FloatOrArray,
    stop: Stop | None = None,
    field: Literal["slope", "height"] = "slope",
) -> ParaxialRays:
    """Return marginal and unit-field chief ray over broadcast (depth, wavelength).

    ``field="slope"``: the chief ray has slope 1 at the entrance pupil; ``"height"``: it comes from an object
    1 mm below the axis, which a telecentric object space needs. The height of the marginal ray is positive at
    the entrance pupil (at the stop, if that pupil is at infinity). Raises GeometryError for an object in the
    entrance pupil, for a slope when the entrance pupil is at infinity, and for a height when the object is.
    """
    check_depth(depth_mm)
    surface, rim = (stop.surface, stop.semi_diameter) if stop else file_stop(lens)
    rays = basis_rays(lens, wavelength_um, (depth_mm, surface))
    centre_y, centre_nu = chief_ray(rays, surface)
    n, a, close = rays.object_index, centre_nu[0], vergence(depth_mm)
    reach = a - n * close * centre_y[0]
    _check_field(field, a, close)
    if anywhere(abs(reach) <= OBJECT_IN_PUPIL * abs(a)):
        raise GeometryError("the object lies in the entrance pupil, so no cone of light is defined; move the object")
    side = 1.0 - 2.0 * (a < 0)
    y, nu = _combine(rays, side * rim / reach, n * close * side * rim / reach)
    nu[-1] = settled_angle(rays.power, rays.gap, y, nu[1:])
    scale = n / a if field == "slope" else n * close / reach
    return ParaxialRays(y, nu, centre_y * scale, centre_nu * scale, rays.index, side * rim * scale, rays.wavelength_um)


def needed_radii(lens: Lens) -> np.ndarray:
    """Return the semi-diameters, mm, that paraxial rays of the widest field require for an object at infinity."""
    rays = paraxial_rays(lens, np.inf, lens.reference_wavelength_um)
    slope = slope_from_degrees(lens.widest_field_deg)
    needed: np.ndarray = np.abs(rays.y) + np.abs(rays.chief_y) * slope
    return needed


def _check_field(field: str, a: np.ndarray, close: np.ndarray) -> None:
    """Raise GeometryError for a slope with the entrance pupil at infinity, or a height with the object at infinity."""
    if field == "slope" and anywhere(a == 0):
        raise GeometryError(
            "the entrance pupil is at infinity, so a field angle has no meaning; move the stop away from that focus, "
            'or in Python state the field as an object height, field="height"'
        )
    if field == "height" and np.any(close == 0):
        raise GeometryError("an object at infinity has no height; give the field as an angle or an image height")


def _combine(rays: BasisRays, y1: np.ndarray, nu1: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return heights at, and reduced angles before and behind, every surface of the ray (y1, nu1)."""
    angle = rays.c * y1 + rays.d * nu1
    nu = np.empty((len(angle) + 1, *angle.shape[1:]))
    nu[0], nu[1:] = nu1, angle
    return rays.a * y1 + rays.b * nu1, nu


def f_number(lens: Lens, wavelength_um: FloatOrArray, stop: Stop | None = None) -> np.ndarray:
    """Return the effective focal length divided by the entrance-pupil diameter; infinite for an afocal lens."""
    rays = basis_rays(lens, wavelength_um)
    power = np.abs(settled_angle(rays.power, rays.gap, rays.a, rays.c))
    with np.errstate(divide="ignore"):
        ratio: np.ndarray = 1 / (power * pupils(lens, wavelength_um, stop).entrance_diameter)
    return ratio


def working_f_number(
    lens: Lens, depth_mm: FloatOrArray, wavelength_um: FloatOrArray, stop: Stop | None = None
) -> np.ndarray:
    """Return 1/(2 NA) at this depth, NA = n'|u'|; infinite for an image at infinity."""
    with np.errstate(divide="ignore"):
        return 0.5 / numerical_aperture(lens, depth_mm, wavelength_um, stop)


def numerical_aperture(
    lens: Lens, depth_mm: FloatOrArray, wavelength_um: FloatOrArray, stop: Stop | None = None
) -> np.ndarray:
    """Return the paraxial image-space numerical aperture n'|u'| at this depth."""
    na: np.ndarray = np.abs(paraxial_rays(lens, depth_mm, wavelength_um, stop).nu[-1])
    return na


def field_from_object_height(
    lens: Lens,
    depth_mm: FloatOrArray,
    wavelength_um: FloatOrArray,
    height_mm: FloatOrArray,
    stop: Stop | None = None,
) -> np.ndarray:
    """Return the field slope of an object ``height_mm`` below the axis; GeometryError for an object at infinity."""
    if np.any(np.isinf(depth_mm)):
        raise GeometryError("an object at infinity has no height; give the field as an angle or an image height")
    return height_mm / (depth_mm + pupils(lens, wavelength_um, stop).entrance_from_first)


def field_from_image_height(
    lens: Lens, wavelength_um: FloatOrArray, height_mm: FloatOrArray, stop: Stop | None = None
) -> np.ndarray:
    """Return the field slope whose paraxial chief ray meets the sensor at ``height_mm``; GeometryError if none does."""
    rays = paraxial_rays(lens, np.inf, wavelength_um, stop)
    unit = rays.chief_y[-1] + rays.chief_nu[-1] / rays.index[-1] * lens.sensor_mm
    if np.any(unit == 0):
        raise GeometryError("every chief ray meets the sensor on the axis; give the field as an angle")
    slope: np.ndarray = height_mm / unit
    return slope
