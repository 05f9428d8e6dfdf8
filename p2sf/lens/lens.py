"""A lens as plain frozen data: surfaces, media, aperture, sensor."""

from dataclasses import dataclass, fields, replace
from functools import cached_property, lru_cache, reduce
from itertools import accumulate
from math import inf, isfinite, isnan
from operator import mul
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments, check_fields
from p2sf.conventions import NM_PER_UM, FloatOrArray
from p2sf.errors import GeometryError
from p2sf.glass.media import AIR, MIRROR, Medium, transmittance_of
from p2sf.html import html_table
from p2sf.lens.irregularity import Irregularity
from p2sf.lens.placement import Motion, Placement, along_z
from p2sf.lens.properties import BY_NAME, PROPERTIES, turned_breaks
from p2sf.lens.rim import Rim
from p2sf.lens.shapes import Conic, Diffraction, EvenTerms, Part, RadialPart, SagAndSlope, Shape
from p2sf.lens.transmission import Transmission
from p2sf.messages import Message
from p2sf.pupil.basis import HALF, WHOLE, PupilDomain
from p2sf.pupil.mask import CLEAR, PupilMask

if TYPE_CHECKING:
    from p2sf.lens.positions import Positions

# Far below any atom, and far above where the cube of a curvature overflows.
SMALLEST_RADIUS_MM = 1e-30
NORMALISATIONS_MM = 1e-6, 1e6  # radii whose powers, up to the 50th, are still numbers

ApertureKind = Literal["stop_semi_diameter", "entrance_pupil_diameter", "f_number"]
Aim = Literal["stop", "paraxial"]
AIMS: tuple[Aim, ...] = ("stop", "paraxial")
USUAL_AIM: Aim = "stop"


@dataclass(frozen=True)
class Surface:
    """One refracting or reflecting surface, or a bare plane such as a stop, and what follows it.

    Parameters
    ----------
    radius : float
        Radius of curvature, mm, positive where the centre lies to the right; inf for a plane.
    thickness : float
        Distance to the next vertex, or of the last surface to the sensor, mm; negative where light runs back.
    medium : Medium
        What the light enters behind the surface; MIRROR for a surface that reflects it.
    conic : float
        Conic constant K; 0 is a sphere, −1 a paraboloid.
    aspheric : tuple of float
        A4, A6, …, in mm⁻³, mm⁻⁵, …
    semi_diameter : float
        Radius of the clear aperture, mm.
    shape : RadialPolynomial, Qcon or Qbfs, optional
        What is added to the sag of the conic and its aspheric terms.
    diffraction : Diffraction, optional
        The phase that a diffractive surface adds.
    before, after : tuple of Placement
        How the axes of the surface stand in those before it, and how those behind it, along whose z the thickness
        runs, stand in the surface's own: one break of the coordinates after the other.
    inner_radius : float
        Radius, mm, within which rays are lost where rims clip: a mirror's hole, or the shadow of what stands there.
    ideal_focal_length : float
        The focal length, mm, of an ideal lens in this plane, whose power is its inverse; inf for a real surface.
    rim : Rim, optional
        Where the clear aperture stands, if it is decentred or a rectangle.
    irregularity : Irregularity, optional
        What was ground into the surface by mistake, and is added to its sag.
    transmission : Transmission, optional
        The share of energy that it passes, or a mirror reflects; all of it if not given.
    """

    radius: float = inf
    thickness: float = 0.0
    medium: Medium = AIR
    conic: float = 0.0
    aspheric: tuple[float, ...] = ()
    semi_diameter: float = inf
    shape: Shape | None = None
    diffraction: Diffraction | None = None
    before: tuple[Placement, ...] = ()
    after: tuple[Placement, ...] = ()
    inner_radius: float = 0.0
    ideal_focal_length: float = inf
    rim: Rim | None = None
    irregularity: Irregularity | None = None
    transmission: Transmission | None = None

    def __post_init__(self) -> None:
        check_fields(self)

    def __getstate__(self) -> dict:
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @property
    def curvature(self) -> float:
        """Return 1/radius, per mm."""
        return 1.0 / self.radius

    @cached_property
    def base(self) -> Conic:
        """Return the sphere or the other conic that all other parts stand on."""
        return Conic(self.curvature, self.conic)

    @cached_property
    def parts(self) -> tuple[Part, ...]:
        """Return what adds up to the sag: the conic first, then even terms, a shape and an irregularity."""
        terms = EvenTerms(self.aspheric) if any(self.aspheric) else None
        return self.base, *(part for part in (terms, self.shape, self.irregularity) if part is not None)

    @cached_property
    def radial_parts(self) -> tuple[RadialPart, ...]:
        """Return the parts of revolution beside the conic."""
        return tuple(part for part in self.parts[1:] if isinstance(part, RadialPart))

    @cached_property
    def uneven_parts(self) -> tuple[Part, ...]:
        """Return the parts that are not of revolution."""
        return tuple(part for part in self.parts if not part.radial)

    @cached_property
    def addends_mm(self) -> float:
        """Return how large the numbers are whose sum is the sag, mm, beyond the sag itself."""
        return sum(part.addends_mm for part in self.parts)

    def sag(self, x: FloatOrArray, y: FloatOrArray) -> FloatOrArray:
        """Return the sag at a place, mm; NaN beyond the edge of the conic."""
        with np.errstate(invalid="ignore"):
            depth, _ = self.sag_and_slope(x * x + y * y)
            for part in self.uneven_parts:
                depth = depth + part.sag_and_gradient(x, y, self.curvature, self.conic)[0]
        return depth

    def sag_and_slope(self, square: FloatOrArray) -> SagAndSlope:
        """Return the sag, mm, and dz/d(r²) of the parts of revolution at squared radii, mm²; NaN beyond the edge."""
        base = self.base
        sag, slope = base.sag_and_slope(square)
        for part in self.radial_parts:
            more, steeper = part.sag_and_slope(square, base.curvature, base.constant)
            sag, slope = sag + more, slope + steeper
        return sag, slope

    @property
    def vertex_curvature(self) -> float:
        """Return the curvature at the vertex, per mm: 1/radius, and twice the r² term of a shape."""
        if self.shape is None:
            return self.curvature
        return self.curvature + 2 * self.shape.series(self.curvature)[1]

    @property
    def flat(self) -> bool:
        """Return whether the surface is a plane."""
        return not self.curvature and len(self.parts) == 1

    @property
    def bare(self) -> bool:
        """Return whether the surface is a plane that does nothing to light between equal media."""
        return self.flat and self.diffraction is None and not self.ideal and self.transmission is None

    @property
    def ideal(self) -> bool:
        """Return whether this is an ideal lens, which images every point sharply where first order has it."""
        return isfinite(self.ideal_focal_length)

    @property
    def reflects(self) -> bool:
        """Return whether this is a mirror."""
        return self.medium == MIRROR


@dataclass(frozen=True)
class Aperture:
    """How wide the lens is open: the stop's radius or the pupil's diameter in mm, or the f-number.

    The pupil's diameter and the f-number (focal length/pupil diameter) hold at the lens's reference wavelength, and for
    the lens as it is: if `dataclasses.replace` changes a surface, the stop's radius follows from the new surfaces.
    `p2sf.paraxial.pupils.with_fixed_stop` keeps the radius.
    """

    kind: ApertureKind
    value: float

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class Lens:
    """A system of lenses and mirrors and its sensor; `p2sf.load_lens` reads one.

    It is rotationally symmetric unless surfaces are irregular, or these or the sensor tilted or decentred.

    Parameters
    ----------
    surfaces : tuple of Surface
        In the order light meets them; the thickness of the last is the distance to the sensor, mm.
    aperture : Aperture
        How wide the lens is open.
    stop_surface : int, optional
        Number of the aperture stop, from 1; by default the narrowest rim for an object at infinity.
    name, title, source, comment : str
        A short name, a title, where the numbers come from, and anything else.
    character : str
        One line about the lens, for lists of lenses.
    fields_deg, wavelengths_nm : tuple of float
        Field angles, degrees, and wavelengths, nm, for which the lens is meant; the middle wavelength is its reference.
    object_medium : Medium
        The medium of object space.
    aim : str
        How exact rays fill the pupil: "stop", evenly up to the rim of the real stop; "paraxial", evenly over the
        paraxial entrance pupil.
    mask : PupilMask
        What stands in the stop: obscuration, vanes, blades, apodisation, phase; by default nothing.
    positions : Positions, optional
        For a lens that zooms or focuses inside: all of its columns, and the present position between them
        (see `p2sf.lens_at`).
    sensor_before : tuple of Placement
        Tilt and decentre of the sensor, relative to its place behind the last surface.
    absorption : bool
        Whether rays lose the light that media absorb behind the first surface, as far as their catalogues say.

    Raises
    ------
    GeometryError
        If a surface, the stop, the aperture, a wavelength or the aim is invalid.
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
    aim: Aim = USUAL_AIM
    mask: PupilMask = CLEAR
    positions: "Positions | None" = None
    sensor_before: tuple[Placement, ...] = ()
    absorption: bool = False

    def __post_init__(self) -> None:
        check_fields(self)
        _check_surfaces(self.surfaces)
        for placement in self.sensor_before:
            placement.check(len(self.surfaces) + 1)
        _check_stop(self.stop_surface, len(self.surfaces))
        if not (isfinite(self.aperture.value) and self.aperture.value > 0):
            raise GeometryError(
                "aperture {kind} is {value}; give a positive number", kind=self.aperture.kind, value=self.aperture.value
            )
        if not self.wavelengths_nm:
            raise GeometryError("the lens has no wavelengths; give at least one")
        if min(self.wavelengths_nm) <= 0:
            raise GeometryError(
                "wavelengths are {wavelengths} nm; give positive numbers", wavelengths=self.wavelengths_nm
            )
        if self.aim not in AIMS:
            raise GeometryError('aim "{aim}" is unknown; choose "stop" or "paraxial"', aim=self.aim)

    def __hash__(self) -> int:
        return self._hash

    def __repr__(self) -> str:
        opened = f"{self.aperture.kind} {self.aperture.value:g}"
        moved = f", {self.positions.words}" if self.positions else ""
        return f"<Lens {self.name}: {len(self.surfaces)} surfaces, {opened}, aim {self.aim}{moved}>"

    def _repr_html_(self) -> str:
        columns = ("surface", "radius, mm", "thickness, mm", "medium", "conic", "semi-diameter, mm")
        rows = (
            (number, s.radius, s.thickness, s.medium.label, s.conic, s.semi_diameter)
            for number, s in enumerate(self.surfaces, 1)
        )
        return html_table(self.title or self.name, columns, rows)

    def __getstate__(self) -> dict:
        # The hash of a str differs from process to process, so the hash kept here must not be pickled.
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @cached_property
    def _hash(self) -> int:
        # A slider step looks up the lens in a dozen caches, and hashing its hundred numbers takes a while.
        return hash(tuple(getattr(self, field.name) for field in fields(self)))

    @property
    def reference_wavelength_um(self) -> float:
        """Return the middle wavelength of the file: the default, and where pupil diameter and f-number hold."""
        return sorted(self.wavelengths_nm)[len(self.wavelengths_nm) // 2] / NM_PER_UM

    @property
    def sensor_mm(self) -> float:
        """Return the position of the sensor, mm behind the last vertex."""
        return self.surfaces[-1].thickness

    @cached_property
    def curvatures(self) -> tuple[float, ...]:
        """Return the curvature of every surface, per mm."""
        return tuple(surface.curvature for surface in self.surfaces)

    @cached_property
    def media(self) -> tuple[Medium, ...]:
        """Return the media in the order light meets them, one more than there are surfaces."""
        media = [self.object_medium]
        for surface in self.surfaces:
            media.append(media[-1] if surface.reflects else surface.medium)
        return tuple(media)

    @cached_property
    def directions(self) -> tuple[int, ...]:
        """Return for every medium 1 if light runs to the right in it, −1 after an odd number of mirrors."""
        return tuple(accumulate((-1 if surface.reflects else 1 for surface in self.surfaces), mul, initial=1))

    @cached_property
    def misaligned(self) -> bool:
        """Return whether anything is tilted, decentred or not of revolution, mirrors and clear rims included."""
        if any(surface.rim or surface.uneven_parts for surface in self.surfaces):
            return True
        placements = *(p for s in self.surfaces for p in (*s.before, *s.after)), *self.sensor_before
        return not all(placement.idle for placement in placements)

    @cached_property
    def pupil_domain(self) -> PupilDomain:
        """Return which part of the pupil tells everything: half of it, or all where the lens is misaligned."""
        return WHOLE if self.misaligned else HALF

    @cached_property
    def absorbs(self) -> tuple[bool, ...]:
        """Return for every medium whether light is lost in it; that of the object does not belong to the lens."""
        known = (self.absorption and transmittance_of(medium) is not None for medium in self.media[1:])
        return False, *known

    @cached_property
    def shading(self) -> Message | None:
        """Return what takes more light from some parts of the pupil than from others; None where nothing does."""
        for number, surface in enumerate(self.surfaces, 1):
            if reason := BY_NAME["transmission"].unseen(surface.transmission):
                return Message("surface {surface} {reason}", surface=number, reason=reason)
        if any(self.absorbs):
            return Message(
                "the medium behind surface {surface} absorbs light along paths of different lengths",
                surface=self.absorbs.index(True),
            )
        return None

    @cached_property
    def motions(self) -> tuple[Motion, ...]:
        """Return the axes of each surface, and of the sensor, relative to those before; the first to the lens's."""
        found = []
        onward = along_z(0.0)
        for surface in self.surfaces:
            found.append(_chain(onward, surface.before))
            onward = _chain(along_z(0.0), surface.after).then(along_z(surface.thickness))
        return *found, _chain(onward, self.sensor_before)

    @cached_property
    def steps(self) -> tuple[float | None, ...]:
        """Return for each of the ``motions`` the distance along z, mm, or None if it is more than a shift along z."""
        if not self.sensor_before and not any(surface.before or surface.after for surface in self.surfaces):
            return 0.0, *(surface.thickness for surface in self.surfaces)
        plain = (not motion.turns and not motion.origin[:2].any() for motion in self.motions)
        return tuple(float(m.origin[2]) if along else None for m, along in zip(self.motions, plain, strict=True))

    @cached_property
    def frames(self) -> tuple[Motion, ...]:
        """Return the axes of every surface and of the sensor in those of the lens, z from the first vertex, mm."""
        return tuple(accumulate(self.motions, Motion.then))


def _chain(motion: Motion, placements: tuple[Placement, ...]) -> Motion:
    return reduce(Motion.then, (placement.motion for placement in placements), motion)


def with_sensor(lens: Lens, sensor_mm: float) -> Lens:
    """Return the same lens with its sensor ``sensor_mm`` behind the last vertex."""
    if lens.sensor_mm == sensor_mm:
        return lens  # caches find the very same object without comparing a hundred numbers
    last = replace(lens.surfaces[-1], thickness=float(sensor_mm))
    return replace(lens, surfaces=(*lens.surfaces[:-1], last))


def with_f_number(lens: Lens, f_number: float) -> Lens:
    """Return the same lens with its stop set so that EFL/EPD is ``f_number`` at the reference wavelength."""
    return replace(lens, aperture=Aperture("f_number", float(f_number)))


def with_aim(lens: Lens, aim: Aim) -> Lens:
    """Return the same lens with its pupil filled as ``aim`` says; GeometryError for an unknown one."""
    return lens if lens.aim == aim else replace(lens, aim=aim)


@check_arguments
def with_absorption(lens: Lens, absorption: bool = True) -> Lens:
    """Return the same lens with the light that its media absorb taken from its rays, or left to them."""
    return lens if lens.absorption == absorption else replace(lens, absorption=absorption)


@check_arguments
def with_mask(lens: Lens, mask: PupilMask) -> Lens:
    """Return the same lens with this mask in its stop."""
    return lens if lens.mask == mask else replace(lens, mask=mask)


def check_unmasked(lens: Lens, what: Message) -> None:
    """Raise GeometryError for ``what`` knows the clear disc of the stop only, where the lens has a mask in it."""
    if not lens.mask.clear:
        raise GeometryError(
            "a mask stands in the stop, and {what} supports only a clear round stop; remove the mask", what=what
        )


@lru_cache(maxsize=64)
def seen_from(lens: Lens, azimuth_deg: float) -> Lens:
    """Return a lens as a source in this azimuth sees it that is described in the plane x = 0: turned about its axis.

    Every break of the coordinates stands in axes that are turned with the source, so that the stop's and the sensor's
    own are as well. A lens that is not misaligned is returned.
    """
    if not azimuth_deg or not lens.misaligned:
        return lens
    surfaces = tuple(
        replace(s, **{each.name: each.turned(getattr(s, each.name), azimuth_deg) for each in PROPERTIES})
        for s in lens.surfaces
    )
    return replace(lens, surfaces=surfaces, sensor_before=turned_breaks(lens.sensor_before, azimuth_deg))


def scale_surface(surface: Surface, factor: float) -> Surface:
    """Return a surface whose lengths are in units ``factor`` mm long, in mm."""
    if factor == 1:
        return surface
    return replace(surface, **{each.name: each.scaled(getattr(surface, each.name), factor) for each in PROPERTIES})


SET_STRAIGHT = Message("align it")


def check_aligned(lens: Lens, what: Message, remedy: Message = SET_STRAIGHT) -> None:
    """Raise GeometryError for ``what`` takes a lens of rotational symmetry, where parts are not symmetric."""
    if lens.misaligned:
        raise GeometryError(
            "surface {surface} is tilted, decentred or not of revolution, and {what} supports only rotational "
            "symmetry; {remedy}",
            surface=_first_misaligned(lens),
            what=what,
            remedy=remedy,
        )


def _first_misaligned(lens: Lens) -> int:
    """Return the first surface, from 1, that is not symmetric or that a break stands before or behind.

    The sensor is that behind the last.
    """
    placed = (
        s.rim is not None or s.uneven_parts or any(not p.idle for p in (*s.before, *s.after)) for s in lens.surfaces
    )
    return next((number for number, found in enumerate(placed, 1) if found), len(lens.surfaces) + 1)


def indices(lens: Lens, wavelength_um: ArrayLike) -> np.ndarray:
    """Return the refractive index of every medium, shape (surfaces + 1, *wavelength_um.shape).

    It is negative where light runs to the left: a mirror is then a surface with n' = −n, and every equation of
    refraction holds for it (Welford 1986, ch. 4). Raises GlassError for a wavelength, µm, outside a glass's data.
    """
    wavelength, media = np.asarray(wavelength_um, dtype=float), lens.media
    known = {id(medium): medium.index(wavelength) for medium in {id(medium): medium for medium in media}.values()}
    rows = np.empty((len(media), *wavelength.shape))
    # np.stack takes 50 µs for the scalars of a dozen surfaces, this 4.
    for number, (medium, direction) in enumerate(zip(media, lens.directions, strict=True)):
        rows[number] = known[id(medium)] if direction > 0 else -known[id(medium)]
    return rows


def absorptions(lens: Lens, wavelength_um: FloatOrArray) -> list[FloatOrArray] | None:
    """Return what every medium absorbs, per mm, in the shape of ``wavelength_um``; None for a lens that absorbs none.

    The share that passes a length is exp(−absorption·length).
    """
    if not any(lens.absorbs):
        return None
    known = [transmittance_of(medium) if lost else None for medium, lost in zip(lens.media, lens.absorbs, strict=True)]
    return [0.0 if one is None else one.absorption(wavelength_um) for one in known]


def surface_power(
    surface: Surface, before: FloatOrArray, after: FloatOrArray, wavelength_um: FloatOrArray
) -> FloatOrArray:
    """Return the power (n′ − n)c of a surface, and −2 times the r² term of the path that its diffraction adds, per mm.

    That of an ideal lens is 1/f in any media. ``before``, ``after``: the signed indices. Source: Welford 1986, ch. 3;
    Sweatt 1977.
    """
    power = surface.vertex_curvature * (after - before) + 1 / surface.ideal_focal_length
    if surface.diffraction is None:
        return power
    return power - 2 * surface.diffraction.path_terms(wavelength_um)[0]


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
            raise GeometryError(
                "surface {surface}: radius {radius} mm; write inf for a plane", surface=number, radius=surface.radius
            )
        if not hasattr(surface.medium, "label"):
            raise GeometryError(
                "surface {surface}: medium {medium}; give one of p2sf.glass.media, such as ConstantIndex(1.5)",
                surface=number,
                medium=repr(surface.medium),
            )
        if not isfinite(surface.thickness):
            raise GeometryError(
                "surface {surface}: thickness {thickness} mm; give a finite number",
                surface=number,
                thickness=surface.thickness,
            )
        if not surface.semi_diameter > 0:
            raise GeometryError(
                "surface {surface}: semi-diameter {semi_diameter} mm; give a positive number",
                surface=number,
                semi_diameter=surface.semi_diameter,
            )
        if not 0 <= surface.inner_radius < surface.semi_diameter:
            raise GeometryError(
                "surface {surface}: inner radius {inner} mm; give a number from 0 to below the semi-diameter",
                surface=number,
                inner=surface.inner_radius,
            )
        if not all(isfinite(x) for x in (surface.conic, *surface.aspheric)):
            raise GeometryError(
                "surface {surface}: conic or aspheric coefficient is not finite; correct it", surface=number
            )
        for placement in (*surface.before, *surface.after):
            placement.check(number)
        if surface.rim:
            surface.rim.check(number)
        _check_shape(surface, number)


def _check_shape(surface: Surface, number: int) -> None:
    """Raise GeometryError for numbers of a shape, of diffraction or of an irregularity that cannot be."""
    for part in (surface.shape, surface.diffraction, surface.irregularity):
        if part is None:
            continue
        low, high = NORMALISATIONS_MM
        if not low <= part.normalisation_mm <= high:
            raise GeometryError(
                "surface {surface}: normalisation radius {radius} mm; give a number from {low:g} to {high:g}",
                surface=number,
                radius=part.normalisation_mm,
                low=low,
                high=high,
            )
        if not all(map(isfinite, part.numbers)):
            raise GeometryError(
                "surface {surface}: a number of its shape, its phase or its irregularity is not finite; correct it",
                surface=number,
            )
    passed = surface.transmission
    if passed and not (0 <= passed.vertex <= 1 and isfinite(passed.per_mm2)):
        raise GeometryError(
            "surface {surface}: transmission {vertex:g} with {slope:g} per mm²; give a share from 0 to 1 and a finite "
            "number",
            surface=number,
            vertex=passed.vertex,
            slope=passed.per_mm2,
        )
    focal = surface.ideal_focal_length
    plain = surface.flat and surface.diffraction is None
    if isnan(focal) or (surface.ideal and not (plain and focal)):
        raise GeometryError(
            "surface {surface} is an ideal lens of focal length {focal:g} mm; it has to be a plane that does not "
            "diffract, and its focal length not 0",
            surface=number,
            focal=focal,
        )


def _check_stop(stop: int | None, count: int) -> None:
    if stop is not None and not 1 <= stop <= count:
        raise GeometryError(
            "stop surface {stop} does not exist; the lens has surfaces 1 to {count}", stop=stop, count=count
        )
