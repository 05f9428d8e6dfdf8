"""A lens as plain frozen data: surfaces, media, aperture, sensor."""

from dataclasses import dataclass, fields, replace
from functools import cached_property, lru_cache, reduce
from itertools import accumulate
from math import inf, isfinite, isnan
from operator import mul
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import NUMBERS, check_arguments, check_fields
from p2sf.conventions import FARTHEST_MM, NM_PER_UM, FloatOrArray, angle_from_axis
from p2sf.disc.domain import PupilDomain, domain_of
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.errors import GeometryError, RequestError
from p2sf.glass.media import AIR, MIRROR, Medium, parse_medium, transmittance_of
from p2sf.lens.grating import Phase
from p2sf.lens.irregularity import Irregularity
from p2sf.lens.placement import Motion, Placement, along_z
from p2sf.lens.properties import PROPERTIES, turned_breaks
from p2sf.lens.rim import Rim
from p2sf.lens.shapes import Conic, EvenTerms, Part, RadialPart, SagAndSlope, Shape
from p2sf.lens.transmission import Transmission
from p2sf.messages import Alternatives, Message
from p2sf.parameters import FASTEST, SLOWEST

if TYPE_CHECKING:
    from p2sf.lens.positions import Positions

# Far below any atom, and far above where the cube of a curvature overflows.
SMALLEST_RADIUS_MM = 1e-30
NORMALISATIONS_MM = 1e-6, 1e6  # radii whose powers up to the 50th neither overflow nor underflow

D_NM = 587.5618

ApertureKind = Literal["stop_semi_diameter", "entrance_pupil_diameter", "f_number"]
Aim = Literal["stop", "paraxial"]
AIMS: tuple[Aim, ...] = ("stop", "paraxial")
USUAL_AIM: Aim = "stop"


@dataclass(frozen=True)
class Surface:
    """One refracting or reflecting surface, or a dummy plane such as a stop, with the thickness and medium behind it.

    Parameters
    ----------
    radius : float
        Radius of curvature, mm, positive where the centre lies to the right; inf for a plane.
    thickness : float
        Distance to the next vertex, or from the last surface to the sensor, mm; negative where light travels to −z.
    medium : Medium or str or float
        The medium behind the surface, by default air: a glass by its name, an index, or what `p2sf.medium` returns;
        "mirror" for a reflecting surface.
    conic : float
        Conic constant K; 0 is a sphere, −1 a paraboloid.
    aspheric : tuple of float
        A4, A6, …, in mm⁻³, mm⁻⁵, …
    semi_diameter : float
        Radius of the clear aperture, mm.
    shape : Shape, optional
        A shape added to the sag of the conic and its aspheric terms.
    diffraction : Diffraction or Grating, optional
        The phase that a diffractive surface adds, or the lines of a grating.
    before, after : tuple of Placement
        Coordinate breaks, applied in order, from the axes before the surface to its own, and from its own to those
        behind it, along whose z the thickness is measured.
    inner_radius : float
        Radius, mm, within which rays are lost where rims clip: the hole of a mirror, or an obscuration.
    ideal_focal_length : float
        The focal length, mm, of an ideal lens in this plane; inf for a real surface.
    rim : Rim, optional
        The clear aperture, if it is decentred or a rectangle.
    irregularity : Irregularity, optional
        An astigmatic figure error added to the sag.
    transmission : Transmission, optional
        The share of energy that the surface transmits, or a mirror reflects; by default all.
    """

    radius: float = inf
    thickness: float = 0.0
    medium: Medium = AIR
    conic: float = 0.0
    aspheric: tuple[float, ...] = ()
    semi_diameter: float = inf
    shape: Shape | None = None
    diffraction: Phase | None = None
    before: tuple[Placement, ...] = ()
    after: tuple[Placement, ...] = ()
    inner_radius: float = 0.0
    ideal_focal_length: float = inf
    rim: Rim | None = None
    irregularity: Irregularity | None = None
    transmission: Transmission | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        if not hasattr(self.medium, "range_um"):
            object.__setattr__(self, "medium", parse_medium(self.medium))

    def __getstate__(self) -> dict:
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @property
    def curvature(self) -> float:
        """Return 1/radius, per mm."""
        return 1.0 / self.radius

    @cached_property
    def base(self) -> Conic:
        """Return the conic to which all other parts are added."""
        return Conic(self.curvature, self.conic)

    @cached_property
    def parts(self) -> tuple[Part, ...]:
        """Return the parts whose sum is the sag: the conic first, then even terms, a shape and an irregularity."""
        terms = EvenTerms(self.aspheric) if any(self.aspheric) else None
        return self.base, *(part for part in (terms, self.shape, self.irregularity) if part is not None)

    @cached_property
    def radial_parts(self) -> tuple[RadialPart, ...]:
        """Return the parts of revolution except the conic."""
        return tuple(part for part in self.parts[1:] if isinstance(part, RadialPart))

    @cached_property
    def uneven_parts(self) -> tuple[Part, ...]:
        """Return the parts that are not of revolution."""
        return tuple(part for part in self.parts if not part.radial)

    @cached_property
    def addends_mm(self) -> float:
        """Return the magnitude of the addends of the sag, mm, as far as it exceeds the sag itself."""
        return sum(part.addends_mm for part in self.parts)

    def sag(self, x: FloatOrArray, y: FloatOrArray) -> FloatOrArray:
        """Return the sag at a point, mm; NaN beyond the edge of the conic."""
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

    @cached_property
    def bare(self) -> bool:
        """Return whether the surface is a plane without effect on light between equal media."""
        return not any(each.acts(getattr(self, each.name)) for each in PROPERTIES)

    @cached_property
    def symmetric(self) -> bool:
        """Return whether the surface is neither tilted nor decentred, and is of revolution, as its rim is."""
        return all(each.symmetric(getattr(self, each.name)) for each in PROPERTIES)

    @property
    def ideal(self) -> bool:
        """Return whether this is an ideal lens, which images every point sharply onto its paraxial image point."""
        return isfinite(self.ideal_focal_length)

    @property
    def reflects(self) -> bool:
        """Return whether this is a mirror."""
        return self.medium == MIRROR


@dataclass(frozen=True)
class Aperture:
    """The aperture: the radius of the stop or the diameter of the entrance pupil in mm, or the f-number.

    The pupil's diameter and the f-number (focal length/pupil diameter) hold at the lens's reference wavelength, and for
    the lens as it is: if `dataclasses.replace` changes a surface, the stop's radius follows from the new surfaces.
    `p2sf.paraxial.pupils.with_fixed_stop` keeps the radius.
    """

    kind: ApertureKind
    value: float

    def __post_init__(self) -> None:
        check_fields(self)
        if self.kind not in get_args(ApertureKind):
            raise RequestError(
                '{parameter} is "{value}"; choose {choices}',
                parameter="kind",
                value=str(self.kind),
                choices=Alternatives(get_args(ApertureKind)),
            )


@dataclass(frozen=True)
class Lens:
    """A system of lenses and mirrors and its sensor; `p2sf.load_lens` reads one.

    It is rotationally symmetric unless surfaces are irregular, or surfaces or the sensor are tilted or decentred.

    Parameters
    ----------
    surfaces : tuple of Surface
        In the order in which light meets them; the thickness of the last is the distance to the sensor, mm.
    aperture : Aperture or float
        The aperture; a plain number is the f-number.
    stop_surface : int, optional
        Number of the aperture stop, from 1; by default the narrowest rim for an object at infinity.
    name, title, source, comment : str
        A short name, a title, the source of the data, and a comment.
    character : str
        One line about the lens, for lists of lenses.
    fields_deg, fields_x_deg : tuple of float
        Field angles of the design along y and along x, degrees, as those of a camera; without angles along x they are
        0.
    wavelengths_nm : tuple of float
        Wavelengths of the design, nm.
    wavelength_weights : tuple of float
        Their shares of the light, in any unit; none means that all have the same.
    reference_nm : float, optional
        That of the wavelengths at which pupil diameter and f-number hold; the middle one where none is given.
    object_medium : Medium or str or float
        The medium of object space, given as that of a surface.
    aim : str
        How exact rays fill the pupil: "stop", evenly up to the rim of the real stop; "paraxial", evenly over the
        paraxial entrance pupil.
    mask : PupilMask
        The pupil mask in the stop: obscuration, vanes, blades, apodisation, phase; by default none.
    positions : Positions, optional
        For a lens that zooms or focuses internally: all its columns, and the current position between them (see
        `p2sf.lens_at`).
    sensor_before : tuple of Placement
        Tilt and decentre of the sensor, relative to its nominal position behind the last surface.
    sensor_radius, sensor_conic : float
        Radius of curvature, mm, and conic constant of the sensor; by default it is a plane. Pictures of points lie in
        the plane that touches it where their chief ray lands.
    absorption : bool
        Whether rays lose the light that the media behind the first surface absorb, if their catalogues state it.
    object_distance : float, optional
        Distance, mm, of the design's object from the first vertex, where a source stands unless it is placed elsewhere
        (see `p2sf.raytrace.focusing.object_distance`); inf is allowed. None if it is not known.

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
    wavelengths_nm: tuple[float, ...] = (D_NM,)
    object_medium: Medium = AIR
    aim: Aim = USUAL_AIM
    mask: PupilMask = CLEAR
    positions: "Positions | None" = None
    sensor_before: tuple[Placement, ...] = ()
    absorption: bool = False
    fields_x_deg: tuple[float, ...] = ()
    wavelength_weights: tuple[float, ...] = ()
    reference_nm: float | None = None
    sensor_radius: float = inf
    sensor_conic: float = 0.0
    object_distance: float | None = None

    def __post_init__(self) -> None:
        if isinstance(self.aperture, NUMBERS) and not isinstance(self.aperture, bool):
            object.__setattr__(self, "aperture", Aperture("f_number", float(self.aperture)))
        if not hasattr(self.object_medium, "range_um"):
            object.__setattr__(self, "object_medium", parse_medium(self.object_medium))
        check_fields(self)
        _check_surfaces(self.surfaces)
        _check_sensor(self.sensor_radius, self.sensor_conic)
        for placement in self.sensor_before:
            placement.check(len(self.surfaces) + 1)
        _check_stop(self.stop_surface, len(self.surfaces))
        if not (isfinite(self.aperture.value) and self.aperture.value > 0):
            raise GeometryError(
                "aperture {kind} is {value}; give a positive number", kind=self.aperture.kind, value=self.aperture.value
            )
        _check_size(self.aperture)
        if len(self.fields_x_deg) not in (0, len(self.fields_deg)):
            raise GeometryError(
                "the lens has {across} field angles along x for {count} along y; give as many, or none",
                across=len(self.fields_x_deg),
                count=len(self.fields_deg),
            )
        if not self.wavelengths_nm:
            raise GeometryError("the lens has no wavelengths; give at least one")
        if min(self.wavelengths_nm) <= 0:
            raise GeometryError(
                "wavelengths are {wavelengths} nm; give positive numbers", wavelengths=self.wavelengths_nm
            )
        _check_weights(self)
        _check_object(self.object_distance)
        if self.aim not in AIMS:
            raise GeometryError('aim "{aim}" is unknown; choose "stop" or "paraxial"', aim=self.aim)

    def __hash__(self) -> int:
        return self._hash

    def __repr__(self) -> str:
        opened = f"{self.aperture.kind} {self.aperture.value:g}"
        moved = f", {self.positions.words}" if self.positions else ""
        return f"<Lens {self.name}: {len(self.surfaces)} surfaces, {opened}, aim {self.aim}{moved}>"

    def _repr_html_(self) -> str:
        from p2sf.html import html_table

        columns = ("surface", "radius, mm", "thickness, mm", "medium", "conic", "semi-diameter, mm")
        rows = (
            (number, s.radius, s.thickness, s.medium.label, s.conic, s.semi_diameter)
            for number, s in enumerate(self.surfaces, 1)
        )
        return html_table(self.title or self.name, columns, rows)

    def __getstate__(self) -> dict:
        # The hash of a str differs between processes, so the cached hash must not be pickled.
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @cached_property
    def _hash(self) -> int:
        # A slider step looks up the lens in a dozen caches, and hashing its hundred numbers is slow.
        return hash(tuple(getattr(self, field.name) for field in fields(self)))

    @property
    def reference_wavelength_um(self) -> float:
        """Return the reference wavelength: the default, and where pupil diameter and f-number hold."""
        return self.reference_wavelength_nm / NM_PER_UM

    @property
    def reference_wavelength_nm(self) -> float:
        """Return the reference wavelength, nm."""
        return self.reference_nm or sorted(self.wavelengths_nm)[len(self.wavelengths_nm) // 2]

    @property
    def spectrum(self) -> str:
        """Return the wavelengths with their weights as `p2sf.colour.spectrum.spectrum_of` reads them."""
        weights = self.wavelength_weights or (1.0,) * len(self.wavelengths_nm)
        return "lines:" + ",".join(f"{wave:g}@{w:g}" for wave, w in zip(self.wavelengths_nm, weights, strict=True))

    @cached_property
    def field_places_deg(self) -> tuple[tuple[float, float], ...]:
        """Return the distinct fields as angles (x, y) in degrees, the nearest to the axis first."""
        across = self.fields_x_deg or (0.0,) * len(self.fields_deg)
        places = (self.pupil_domain.field(x, y) for x, y in zip(across, self.fields_deg, strict=True))
        return tuple(sorted(dict.fromkeys(places), key=lambda place: angle_from_axis(*place)))

    @property
    def widest_field_deg(self) -> float:
        """Return the largest angle of the fields from the axis, degrees."""
        return angle_from_axis(*self.field_places_deg[-1]) if self.fields_deg else 0.0

    @property
    def sensor_mm(self) -> float:
        """Return the position of the sensor along the axis, mm behind the last vertex."""
        return self.gaps[-1]

    @cached_property
    def gaps(self) -> tuple[float, ...]:
        """Return the distance along the axis from each vertex to the next, the last to the sensor, mm.

        It is the thickness and what coordinate breaks shift along z; their tilts and decentres do not count.
        """
        behind = *(surface.before for surface in self.surfaces[1:]), self.sensor_before
        return tuple(
            surface.thickness + sum(placement.decentre_z for placement in (*surface.after, *before))
            for surface, before in zip(self.surfaces, behind, strict=True)
        )

    @cached_property
    def vertices(self) -> tuple[float, ...]:
        """Return where each vertex and the sensor lie on the axis, mm behind the first vertex."""
        return tuple(accumulate(self.gaps, initial=0.0))

    @cached_property
    def sensor_surface(self) -> Surface:
        """Return the sensor as a surface, which rays meet behind the last one of the lens."""
        return Surface(self.sensor_radius, conic=self.sensor_conic)

    @cached_property
    def curvatures(self) -> tuple[float, ...]:
        """Return the curvature of every surface, per mm."""
        return tuple(surface.curvature for surface in self.surfaces)

    @cached_property
    def media(self) -> tuple[Medium, ...]:
        """Return the media in the order in which light meets them, one more than there are surfaces."""
        media = [self.object_medium]
        for surface in self.surfaces:
            media.append(media[-1] if surface.reflects else surface.medium)
        return tuple(media)

    @cached_property
    def directions(self) -> tuple[int, ...]:
        """Return 1 for every medium in which light travels to the right, −1 after an odd number of mirrors."""
        return tuple(accumulate((-1 if surface.reflects else 1 for surface in self.surfaces), mul, initial=1))

    @cached_property
    def misaligned(self) -> bool:
        """Return whether anything is tilted, decentred or not of revolution, including mirrors and clear rims."""
        return self.first_misaligned is not None

    @cached_property
    def first_misaligned(self) -> int | None:
        """Return the first surface, from 1, that is not symmetric or has a coordinate break beside it, or None.

        The sensor counts as the surface behind the last. A break that only shifts along the axis is a distance, except
        in front of the first surface, from whose vertex sources are measured.
        """
        on_axis = all(placement.along_axis for placement in self.sensor_before)
        if not all(placement.idle for placement in self.surfaces[0].before):
            return 1
        found = (number for number, surface in enumerate(self.surfaces, 1) if not surface.symmetric)
        return next(found, None if on_axis else len(self.surfaces) + 1)

    @cached_property
    def tilted(self) -> bool:
        """Return whether a part or the sensor is tilted or decentred, so that the axis is not straight."""
        breaks = (one for surface in self.surfaces for one in (*surface.before, *surface.after))
        return any(any((*one.decentre[:2], *one.tilt_deg[:2])) for one in (*breaks, *self.sensor_before))

    @cached_property
    def pupil_domain(self) -> PupilDomain:
        """Return the part of the pupil that determines the rest: half of it, or all if the lens is misaligned."""
        return domain_of(not self.misaligned)

    @cached_property
    def absorbs(self) -> tuple[bool, ...]:
        """Return for every medium whether it absorbs light; that of object space does not count."""
        known = (self.absorption and transmittance_of(medium) is not None for medium in self.media[1:])
        return False, *known

    @cached_property
    def shading(self) -> Message | None:
        """Return the cause of non-uniform transmission over the pupil; None if there is none."""
        for number, surface in enumerate(self.surfaces, 1):
            for each in PROPERTIES:
                if reason := each.shades(getattr(surface, each.name)):
                    return Message("surface {surface} {reason}", surface=number, reason=reason)
        if any(self.absorbs):
            return Message(
                "the medium behind surface {surface} absorbs light along paths of different lengths",
                surface=self.absorbs.index(True),
            )
        return None

    @cached_property
    def motions(self) -> tuple[Motion, ...]:
        """Return the axes of each surface and of the sensor relative to the previous axes, first those of the lens."""
        found = []
        onward = along_z(0.0)
        for surface in self.surfaces:
            found.append(_chain(onward, surface.before))
            onward = _chain(along_z(0.0), surface.after).then(along_z(surface.thickness))
        return *found, _chain(onward, self.sensor_before)

    @cached_property
    def steps(self) -> tuple[float | None, ...]:
        """Return the distance along z, mm, of each of the ``motions``, None for those other than a shift along z."""
        if not self.sensor_before and not any(surface.before or surface.after for surface in self.surfaces):
            return 0.0, *(surface.thickness for surface in self.surfaces)
        plain = (not motion.turns and not motion.origin[:2].any() for motion in self.motions)
        return tuple(float(m.origin[2]) if along else None for m, along in zip(self.motions, plain, strict=True))

    @cached_property
    def frames(self) -> tuple[Motion, ...]:
        """Return the axes of every surface and of the sensor in those of the lens, z from the first vertex, mm."""
        return tuple(accumulate(self.motions, Motion.then))


def _check_size(aperture: Aperture) -> None:
    """Raise GeometryError for an aperture that no lens has."""
    low, high = (FASTEST, SLOWEST) if aperture.kind == "f_number" else (SMALLEST_RADIUS_MM, FARTHEST_MM)
    if not low <= aperture.value <= high:
        raise GeometryError(
            "aperture {kind} is {value:g}; give a number from {low:g} to {high:g}",
            kind=aperture.kind,
            value=aperture.value,
            low=low,
            high=high,
        )


def _check_object(distance: float | None) -> None:
    if distance is not None and not (0 < distance <= FARTHEST_MM or distance == inf):
        raise GeometryError(
            "the object distance is {distance} mm; give a positive number up to {most:g}, or inf",
            distance=distance,
            most=FARTHEST_MM,
        )


def _check_weights(lens: Lens) -> None:
    weights = lens.wavelength_weights
    if len(weights) not in (0, len(lens.wavelengths_nm)) or (weights and not (min(weights) >= 0 < max(weights) < inf)):
        raise GeometryError(
            "the weights of {count} wavelengths are {weights}; give one that is not negative for each, or none",
            count=len(lens.wavelengths_nm),
            weights=weights,
        )
    if lens.reference_nm not in (None, *lens.wavelengths_nm):
        raise GeometryError(
            "the reference wavelength {reference:g} nm is none of the lens's, {wavelengths:g} nm; choose one of these",
            reference=lens.reference_nm,
            wavelengths=lens.wavelengths_nm,
        )


def _chain(motion: Motion, placements: tuple[Placement, ...]) -> Motion:
    return reduce(Motion.then, (placement.motion for placement in placements), motion)


def with_sensor(lens: Lens, sensor_mm: float) -> Lens:
    """Return the same lens with its sensor ``sensor_mm`` behind the last vertex."""
    if lens.sensor_mm == sensor_mm:
        return lens  # caches find the identical object without comparing a hundred numbers
    last = lens.surfaces[-1]
    shifted = lens.sensor_mm - last.thickness  # by breaks
    last = replace(last, thickness=float(sensor_mm) - shifted)
    return replace(lens, surfaces=(*lens.surfaces[:-1], last))


def with_f_number(lens: Lens, f_number: float) -> Lens:
    """Return the same lens with its stop set so that EFL/EPD is ``f_number`` at the reference wavelength."""
    return replace(lens, aperture=Aperture("f_number", float(f_number)))


def with_aim(lens: Lens, aim: Aim) -> Lens:
    """Return the same lens with this ``aim``; GeometryError for an unknown one."""
    return lens if lens.aim == aim else replace(lens, aim=aim)


@check_arguments
def with_absorption(lens: Lens, absorption: bool = True) -> Lens:
    """Return the same lens with or without the absorption of its media."""
    return lens if lens.absorption == absorption else replace(lens, absorption=absorption)


@check_arguments
def with_mask(lens: Lens, mask: PupilMask) -> Lens:
    """Return the same lens with this mask in its stop."""
    return lens if lens.mask == mask else replace(lens, mask=mask)


def without_rays(lens: Lens) -> Message | None:
    """Return why the places where rays land do not show where the light goes; None where they do."""
    if not lens.mask.phased:
        return None
    return Message("the phase in the stop bends light by diffraction, which rays alone do not show; remove the phase")


def check_rays(lens: Lens) -> None:
    """Raise GeometryError where rays alone do not show where the light goes."""
    why = without_rays(lens)
    if why is not None:
        raise GeometryError("{reason}", reason=why)


@lru_cache(maxsize=64)
def seen_from(lens: Lens, azimuth_deg: float) -> Lens:
    """Return a lens rotated about its axis, so that a source at this azimuth lies in the plane x = 0.

    Every coordinate break is given in axes rotated with the source, so that the axes of stop and sensor are rotated as
    well. An aligned lens is returned unchanged.
    """
    if not azimuth_deg or not lens.misaligned:
        return lens
    surfaces = tuple(
        replace(s, **{each.name: each.turned(getattr(s, each.name), azimuth_deg) for each in PROPERTIES})
        for s in lens.surfaces
    )
    return replace(lens, surfaces=surfaces, sensor_before=turned_breaks(lens.sensor_before, azimuth_deg))


def scale_surface(surface: Surface, factor: float) -> Surface:
    """Return a surface scaled from lengths in units of ``factor`` mm to mm."""
    if factor == 1:
        return surface
    return replace(surface, **{each.name: each.scaled(getattr(surface, each.name), factor) for each in PROPERTIES})


SET_STRAIGHT = Message("align it")


def message_if_misaligned(lens: Lens, message: Message | None) -> Message | None:
    """Return a message if the lens is tilted, decentred or not of revolution, else None."""
    return message if lens.misaligned else None


def check_aligned(lens: Lens, what: Message, remedy: Message = SET_STRAIGHT) -> None:
    """Raise GeometryError unless the lens is rotationally symmetric, which ``what`` requires."""
    refusal = Message(
        "surface {surface} is tilted, decentred or not of revolution, and {what} supports only rotational symmetry; "
        "{remedy}",
        surface=lens.first_misaligned,
        what=what,
        remedy=remedy,
    )
    if reason := message_if_misaligned(lens, refusal):
        raise GeometryError(reason)


def indices(lens: Lens, wavelength_um: ArrayLike) -> np.ndarray:
    """Return the refractive index of every medium, shape (surfaces + 1, *wavelength_um.shape).

    It is negative where light travels to the left: a mirror is then a surface with n' = −n, for which all equations of
    refraction hold (Welford 1986, ch. 4). Raises GlassError for a wavelength, µm, outside the data of a glass.
    """
    wavelength, media = np.asarray(wavelength_um, dtype=float), lens.media
    known = {id(medium): medium.index(wavelength) for medium in {id(medium): medium for medium in media}.values()}
    rows = np.empty((len(media), *wavelength.shape))
    # np.stack takes 50 µs for the scalars of a dozen surfaces, this 4.
    for number, (medium, direction) in enumerate(zip(media, lens.directions, strict=True)):
        rows[number] = known[id(medium)] if direction > 0 else -known[id(medium)]
    return rows


def absorptions(lens: Lens, wavelength_um: FloatOrArray) -> list[FloatOrArray] | None:
    """Return the absorption coefficients of the media, per mm, in the shape of ``wavelength_um``; None if all are 0.

    The share transmitted over a length is exp(−absorption·length).
    """
    if not any(lens.absorbs):
        return None
    known = [transmittance_of(medium) if lost else None for medium, lost in zip(lens.media, lens.absorbs, strict=True)]
    return [0.0 if one is None else one.absorption(wavelength_um) for one in known]


def surface_power(
    surface: Surface, before: FloatOrArray, after: FloatOrArray, wavelength_um: FloatOrArray
) -> FloatOrArray:
    """Return the power (n′ − n)c of a surface, minus twice the r² term of the path that its diffraction adds, per mm.

    That of an ideal lens is 1/f in any media. ``before``, ``after``: the signed indices. Source: Welford 1986, ch. 3;
    Sweatt 1977.
    """
    power = surface.vertex_curvature * (after - before) + 1 / surface.ideal_focal_length
    if surface.diffraction is None:
        return power
    return power - 2 * surface.diffraction.path_terms(wavelength_um)[0]


def lens_range_um(lens: Lens) -> tuple[float, float] | None:
    """Return the range of wavelengths in µm at which every medium has an index; None if it is unlimited."""
    ranges = [medium.range_um for medium in lens.media if medium.range_um]
    if not ranges:
        return None
    return max(low for low, _ in ranges), min(high for _, high in ranges)


def _check_sensor(radius: float, conic: float) -> None:
    if not abs(radius) >= SMALLEST_RADIUS_MM:
        raise GeometryError("the sensor's radius is {radius} mm; write inf for a plane", radius=radius)
    if not isfinite(conic):
        raise GeometryError("the sensor's conic constant is {conic}; give a finite number", conic=conic)


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
        if not abs(surface.thickness) <= FARTHEST_MM:
            raise GeometryError(
                "surface {surface}: thickness {thickness} mm; give a number from {low:g} to {high:g}",
                surface=number,
                thickness=surface.thickness,
                low=-FARTHEST_MM,
                high=FARTHEST_MM,
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
    """Raise GeometryError for invalid numbers of a shape, a diffraction or an irregularity."""
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
    if passed and passed.opaque:
        raise GeometryError("surface {surface} transmits no light; give a share above 0", surface=number)
    focal = surface.ideal_focal_length
    plain = surface.flat and surface.diffraction is None
    if isnan(focal) or (surface.ideal and not (plain and focal)):
        raise GeometryError(
            "surface {surface} is an ideal lens of focal length {focal:g} mm; it must be a plane without diffraction, "
            "and its focal length must not be 0",
            surface=number,
            focal=focal,
        )


def _check_stop(stop: int | None, count: int) -> None:
    if stop is not None and not 1 <= stop <= count:
        raise GeometryError(
            "stop surface {stop} does not exist; the lens has surfaces 1 to {count}", stop=stop, count=count
        )
