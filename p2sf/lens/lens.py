"""The lens as plain frozen data. Nothing here computes optics."""

from dataclasses import dataclass, fields, replace
from functools import cached_property
from math import inf, isfinite
from typing import Literal

import numpy as np

from p2sf.conventions import NM_PER_UM
from p2sf.errors import GeometryError
from p2sf.glass.media import AIR, Medium

# Far below any atom, and far above where the cube of a curvature overflows.
SMALLEST_RADIUS_MM = 1e-30

ApertureKind = Literal["stop_semi_diameter", "entrance_pupil_diameter", "f_number"]


@dataclass(frozen=True)
class Surface:
    """One refracting surface, or a bare plane such as a stop, and what follows it.

    ``radius`` and ``thickness`` (to the next vertex) in mm; ``aspheric`` holds A4, A6, … in
    mm^-3, mm^-5, …; ``semi_diameter`` is the clear rim in mm.
    """

    radius: float = inf
    thickness: float = 0.0
    medium: Medium = AIR
    conic: float = 0.0
    aspheric: tuple[float, ...] = ()
    semi_diameter: float = inf

    @property
    def curvature(self) -> float:
        """1/radius, per mm."""
        return 1.0 / self.radius


@dataclass(frozen=True)
class Aperture:
    """How wide the lens is open: a stop rim or pupil diameter in mm, or EFL/EPD at the reference wavelength."""

    kind: ApertureKind
    value: float


@dataclass(frozen=True)
class Lens:
    """A rotationally symmetric refracting lens; the last thickness is where the sensor sits.

    ``stop_surface`` counts from 1; None lets the rims decide. ``character`` is what a list of lenses
    says about this one, in a line.
    """

    surfaces: tuple[Surface, ...]
    aperture: Aperture
    stop_surface: int | None = None
    name: str = "lens"
    title: str = ""
    source: str = ""
    comment: str = ""
    character: str = ""
    fields_deg: tuple[float, ...] = (0.0,)
    wavelengths_nm: tuple[float, ...] = (587.5618,)
    object_medium: Medium = AIR

    def __post_init__(self):
        _check_surfaces(self.surfaces)
        _check_stop(self.stop_surface, len(self.surfaces))
        if not (isfinite(self.aperture.value) and self.aperture.value > 0):
            raise GeometryError(f"aperture {self.aperture.kind} is {self.aperture.value}; give a positive number")
        if not self.wavelengths_nm or min(self.wavelengths_nm) <= 0:
            raise GeometryError(f"wavelengths are {self.wavelengths_nm} nm; give at least one positive number")

    def __hash__(self):
        return self._hash

    def __getstate__(self) -> dict:
        # Texts hash otherwise in each process, so the hash of this one must not travel into another.
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @cached_property
    def _hash(self) -> int:
        # Every slider step looks a lens up a dozen times, and there are a hundred numbers to hash.
        return hash(tuple(getattr(self, field.name) for field in fields(self)))

    @property
    def reference_wavelength_um(self) -> float:
        """Return the middle wavelength of the file: the default, and where pupil diameter and f-number hold."""
        return sorted(self.wavelengths_nm)[len(self.wavelengths_nm) // 2] / NM_PER_UM

    @property
    def sensor_mm(self) -> float:
        """Return sensor position from the last vertex."""
        return self.surfaces[-1].thickness

    @cached_property
    def curvatures(self) -> tuple[float, ...]:
        """Return the curvature of every surface, per mm."""
        return tuple(surface.curvature for surface in self.surfaces)

    @cached_property
    def media(self) -> tuple[Medium, ...]:
        """Return the media in the order light meets them, one more than there are surfaces."""
        return (self.object_medium, *(surface.medium for surface in self.surfaces))


def with_sensor(lens: Lens, sensor_mm: float) -> Lens:
    """Return the same lens with its sensor ``sensor_mm`` behind the last vertex."""
    last = replace(lens.surfaces[-1], thickness=float(sensor_mm))
    return replace(lens, surfaces=(*lens.surfaces[:-1], last))


def with_f_number(lens: Lens, f_number: float) -> Lens:
    """Return the same lens with its stop set so that EFL/EPD is ``f_number`` at the reference wavelength."""
    return replace(lens, aperture=Aperture("f_number", float(f_number)))


def indices(lens: Lens, wavelength_um) -> np.ndarray:
    """Return refractive indices, shape (surfaces + 1, *wavelength_um.shape); GlassError outside a glass's range."""
    wavelength, media = np.asarray(wavelength_um, dtype=float), lens.media
    known = {id(medium): medium.index(wavelength) for medium in {id(medium): medium for medium in media}.values()}
    rows = np.empty((len(media), *wavelength.shape))
    for number, medium in enumerate(media):  # np.stack takes 50 µs for the scalars of a dozen surfaces, this 4
        rows[number] = known[id(medium)]
    return rows


def lens_range_um(lens: Lens) -> tuple[float, float] | None:
    """Return the wavelengths in µm at which every medium has an index; None where nothing limits them."""
    ranges = [medium.range_um for medium in lens.media if medium.range_um]
    if not ranges:
        return None
    return max(low for low, _ in ranges), min(high for _, high in ranges)


def _check_surfaces(surfaces: tuple[Surface, ...]) -> None:
    if not surfaces:
        raise GeometryError("the lens has no surfaces; give at least one")
    for number, surface in enumerate(surfaces, 1):
        if not abs(surface.radius) >= SMALLEST_RADIUS_MM:
            raise GeometryError(f"surface {number}: radius {surface.radius} mm; write inf for a plane")
        if not isfinite(surface.thickness):
            raise GeometryError(f"surface {number}: thickness {surface.thickness} mm; give a finite number")
        if not surface.semi_diameter > 0:
            raise GeometryError(f"surface {number}: semi-diameter {surface.semi_diameter} mm; give a positive number")
        if not all(isfinite(x) for x in (surface.conic, *surface.aspheric)):
            raise GeometryError(f"surface {number}: conic or aspheric coefficient is not finite; correct it")


def _check_stop(stop: int | None, count: int) -> None:
    if stop is not None and not 1 <= stop <= count:
        raise GeometryError(f"stop surface {stop} does not exist; the lens has surfaces 1 to {count}")
