"""What a user asks for, in a user's terms, and the lens, source and stop that it means.

The library, the command line and the window all come through `set_up`, so that a request means the same everywhere.
"""

from dataclasses import dataclass, fields, replace
from math import inf, isfinite, isinf
from typing import Literal

import numpy as np

from p2sf.arguments import check_fields
from p2sf.conventions import NM_PER_UM, UM_PER_MM, degrees_from_slope
from p2sf.errors import GlassError, RequestError
from p2sf.lens.lens import (
    Aperture,
    Lens,
    indices,
    with_absorption,
    with_aim,
    with_f_number,
    with_mask,
    with_sensor,
)
from p2sf.lens.source import Source, check_one
from p2sf.messages import Message, ParameterName
from p2sf.parameters import check_angle, check_distance, check_finite, check_positive, unit_behind
from p2sf.paraxial.first_order import image_distance
from p2sf.paraxial.positions import focused_inside, lens_at
from p2sf.paraxial.pupils import (
    Stop,
    field_from_image_height,
    field_from_object_height,
    find_stop,
    paraxial_rays,
    rim_radii,
)
from p2sf.pupil.mask import CLEAR, PupilMask

StopChoice = Literal["file", "auto"]
AimChoice = Literal["stop", "paraxial", "real"]
"""As `Lens.aim`; "real" is the former name of "stop"."""
FIELDS = ("field_deg", "object_height_mm", "image_height_mm")


@dataclass(frozen=True)
class Request:
    """One point source and how the camera is set; None means: as the lens file has it.

    Attributes
    ----------
    depth_mm
        Object distance from the first vertex, mm, up to 1e16; inf is allowed.
    field_deg
        Chief-ray angle at the entrance pupil, degrees, at finite depth too; in y where there is one in x as well.
    field_x_deg
        Chief-ray angle in x, degrees, for sources beside the plane of x = 0, which a misaligned lens tells apart.
    object_height_mm
        Object height instead of an angle, mm. A positive one stands for a positive field: the object lies at −y.
    image_height_mm
        Height of the paraxial chief ray on the sensor instead of an angle, mm.
    wavelength_nm
        Wavelength, nm; the file's middle one when not given.
    zoom
        Position of the zoom ring: a number on the lens's own scale, or the name of a column of its file.
    focus_position
        Position of the focus ring of a lens that focuses inside, given as for zoom.
    focus_mm
        Focus on the plane this far in front of the first vertex, mm; inf is allowed. The sensor moves to the paraxial
        image of that plane at the lens's middle wavelength. A lens that focuses inside turns its ring instead, and
        moves its sensor only for planes beyond an end of the ring.
    sensor_shift_um
        Then move the sensor by this much away from the lens, µm.
    f_number
        Focal length over entrance-pupil diameter, instead of the file's aperture.
    stop
        Take the stop from the file, or let the narrowest rim decide (auto).
    aim
        Fill the rim of the real stop with exact rays, or the paraxial entrance pupil.
    absorption
        Take from the rays what the media absorb whose catalogue (AGF) states their internal transmittance.
    obscuration
        Radius of a dark disc in the stop, as a share of the rim's, 0 to 0.99.
    obscuration_x, obscuration_y
        Where the middle of the dark disc stands, as shares of the rim's radius; all of it lies within the rim.
    vanes
        Number of vanes that run from the middle of the stop to its rim.
    vane_width
        Width of a vane, as a share of the stop's diameter.
    vane_angle_deg
        Direction of the first vane, degrees from +y towards +x.
    blades
        Number of blades of the iris; 0 for a round one.
    roundness
        Curvature of the blades' edges, as a share of the rim's: 0 straight, 1 a circle.
    blade_angle_deg
        Direction of the iris's first corner, degrees from +y towards +x.
    apodisation
        Radius where the amplitude has fallen to 1/e, as a share of the rim's; inf for none.
    apodisation_power
        2 for a Gaussian, a larger even number for a super-Gaussian.
    cubic_um
        α of the path α(ξ³ + η³) that a cubic phase plate adds, µm.
    """

    depth_mm: float = inf
    field_deg: float | None = None
    field_x_deg: float | None = None
    object_height_mm: float | None = None
    image_height_mm: float | None = None
    wavelength_nm: float | None = None
    zoom: float | str | None = None
    focus_position: float | str | None = None
    focus_mm: float | None = None
    sensor_shift_um: float = 0.0
    f_number: float | None = None
    stop: StopChoice = "file"
    aim: AimChoice | None = None
    absorption: bool | None = None
    obscuration: float | None = None
    obscuration_x: float | None = None
    obscuration_y: float | None = None
    vanes: int | None = None
    vane_width: float | None = None
    vane_angle_deg: float | None = None
    blades: int | None = None
    roundness: float | None = None
    blade_angle_deg: float | None = None
    apodisation: float | None = None
    apodisation_power: int | None = None
    cubic_um: float | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("depth_mm", "focus_mm"):
            check_distance(name, getattr(self, name))
        for name in ("wavelength_nm", "f_number"):
            check_positive(name, getattr(self, name))
        for name in ("object_height_mm", "image_height_mm", "sensor_shift_um"):
            check_finite(name, getattr(self, name))
        check_angle("field_deg", self.field_deg)
        check_angle("field_x_deg", self.field_x_deg)
        _check_one_field(self)
        _check_one_focus(self)
        _check_stop(self.stop)
        check_aim(self.aim)


MASK = tuple(field.name for field in fields(Request) if field.name in {part.name for part in fields(PupilMask)})
"""What of the mask in the stop a request may state."""


@dataclass(frozen=True)
class Setup:
    """A request made concrete: the lens with its sensor, aperture, stop and aim as asked, and the source.

    ``prescription`` is the lens as its file has it, with its rings where it stands.
    """

    lens: Lens
    source: Source
    stop: Stop
    prescription: Lens

    @property
    def field_deg(self) -> float:
        """Return the chief-ray angle at the entrance pupil in degrees."""
        return float(degrees_from_slope(self.source.field_slope))


def set_up(lens: Lens, request: Request) -> Setup:
    """Return the setup that a request means for this lens.

    Raises RequestError for a value that cannot be, GeometryError for one this lens cannot take, and
    GlassError for a wavelength outside its glasses.
    """
    lens = at_position(lens, request)
    wavelength = wavelength_um(lens, request)
    try:
        indices(lens, wavelength)
    except GlassError as error:
        raise _of_the_request(error, request) from None
    lens = with_mask(lens, mask_of(lens, request))
    lens = lens if request.absorption is None else with_absorption(lens, request.absorption)
    placed = with_sensor(aimed(_opened(lens, request.f_number), request.aim), sensor_position(lens, request))
    used, stop = _stopped(placed, request, wavelength)
    return with_field(Setup(used, Source(request.depth_mm, 0.0, wavelength), stop, lens), request)


def mask_of(lens: Lens | None, request: Request) -> PupilMask:
    """Return the lens's mask, or a clear one, with what a request states; RequestError for what no mask can have."""
    own = CLEAR if lens is None else lens.mask
    stated = {name: getattr(request, name) for name in MASK if getattr(request, name) is not None}
    return replace(own, **stated) if stated else own


def _of_the_request(error: GlassError, request: Request) -> GlassError:
    """Return the error with the parameter's name where the request itself states the wavelength."""
    message = error.message
    if request.wavelength_nm is None or "quantity" not in message.values:
        return error
    return GlassError(Message(message.template, **message.values | {"quantity": ParameterName("wavelength_nm")}))


def with_field(setup: Setup, request: Request) -> Setup:
    """Return a setup with its source at the field of a request that is the setup's own but for the field.

    Raises as `set_up` does.
    """
    slope = field_slope(setup.lens, request, setup.source.wavelength_um, setup.stop)
    azimuth = _direction(request).azimuth_deg
    return replace(setup, source=replace(setup.source, field_slope=slope, azimuth_deg=azimuth))


def _direction(request: Request) -> Source:
    """Return a source at the two angles of a request."""
    return Source(field_deg=(request.field_x_deg or 0.0, request.field_deg or 0.0))


def set_up_source(
    lens: Lens,
    source: Source,
    *,
    focus_mm: float | None = None,
    sensor_shift_um: float = 0.0,
    f_number: float | None = None,
    stop: StopChoice = "file",
    aim: AimChoice | None = None,
) -> Setup:
    """Return the setup of a source that is known already; parameters of the camera and errors as `Request` has them."""
    check_one(source)
    request = Request(
        depth_mm=source.depth_mm,
        field_deg=source.field_deg,
        wavelength_nm=source.wavelength_um * NM_PER_UM,
        focus_mm=focus_mm,
        sensor_shift_um=sensor_shift_um,
        f_number=f_number,
        stop=stop,
        aim=aim,
    )
    return replace(set_up(lens, request), source=source)  # to the last digit, which degrees and nanometres may round


def wavelength_um(lens: Lens, request: Request) -> float:
    """Return the asked wavelength in µm, the lens's middle one when none is asked."""
    if request.wavelength_nm is None:
        return lens.reference_wavelength_um
    return request.wavelength_nm / NM_PER_UM


def at_position(lens: Lens, request: Request) -> Lens:
    """Return the lens with its rings turned as asked; RequestError for a ring it lacks, or a place not on one."""
    if lens.positions is None and request.zoom is None and request.focus_position is None:
        return lens
    turned = lens_at(lens, request.zoom, request.focus_position)
    return turned if request.focus_mm is None else focused_inside(turned, request.focus_mm)


def sensor_position(lens: Lens, request: Request) -> float:
    """Return where the sensor stands, mm behind the last vertex.

    It does not depend on the wavelength of the source: with ``focus_mm`` the sensor is at the paraxial image for the
    lens's middle wavelength. Raises RequestError when that image is not a real one at a finite place.
    """
    place = _focused(lens, request.focus_mm)
    shifted = place + request.sensor_shift_um / UM_PER_MM
    if shifted * lens.directions[-1] <= 0 < place * lens.directions[-1]:
        raise RequestError(
            "{parameter} is {value:g} µm, which moves the sensor from {place:g} mm behind the lens into it; "
            "give a smaller shift",
            parameter="sensor_shift_um",
            value=request.sensor_shift_um,
            place=place,
        )
    return shifted


def _focused(lens: Lens, focus_mm: float | None) -> float:
    if focus_mm is None:
        return lens.sensor_mm
    place = float(image_distance(lens, focus_mm, lens.reference_wavelength_um))
    if not (isfinite(place) and place * lens.directions[-1] > 0):
        finite = Message("{place:g} mm from the last vertex", place=place)
        raise RequestError(
            "{parameter} is {value:g} mm, but the image of that distance lies {where} and not on a sensor behind "
            "the lens; give a distance whose image is real, usually a longer one",
            parameter="focus_mm",
            value=focus_mm,
            where=finite if isfinite(place) else Message("at infinity"),
        )
    return place


def field_slope(lens: Lens, request: Request, wavelength_um: float, stop: Stop) -> float:
    """Return the field slope that the one stated field means; 0 when none is stated."""
    if request.object_height_mm is not None:
        slope = field_from_object_height(lens, request.depth_mm, wavelength_um, request.object_height_mm, stop)
    elif request.image_height_mm is not None:
        slope = field_from_image_height(lens, wavelength_um, request.image_height_mm, stop)
    else:
        slope = np.asarray(_direction(request).field_slope)
    paraxial_rays(lens, request.depth_mm, wavelength_um, stop)  # names the depths and stops that have no chief ray
    _check_slope(request, float(slope))
    return float(slope)


def _check_slope(request: Request, slope: float) -> None:
    """Raise RequestError for a height so large that its chief ray is at right angles to the axis, to rounding."""
    if abs(degrees_from_slope(slope)) < 90:
        return
    name = next(name for name in FIELDS if getattr(request, name) is not None)
    raise RequestError(
        "{parameter} is {value:g}{unit}, which needs a chief ray at 90° to the axis; give a smaller one",
        parameter=name,
        value=getattr(request, name),
        unit=unit_behind(name),
    )


def _opened(lens: Lens, f_number: float | None) -> Lens:
    return lens if f_number is None else with_f_number(lens, f_number)


def aimed(lens: Lens, aim: AimChoice | None) -> Lens:
    """Return the lens with its pupil filled as asked, as the lens says where nothing is."""
    return lens if aim is None else with_aim(lens, "stop" if aim == "real" else aim)


def _stopped(lens: Lens, request: Request, wavelength_um: float) -> tuple[Lens, Stop]:
    """Return the stop in use, and the lens naming it, so that every later step agrees on it."""
    stop = find_stop(lens, request.depth_mm, wavelength_um, request.stop)
    if request.stop == "file":
        return lens, stop
    named = find_stop(lens, request.depth_mm, wavelength_um)
    rims = rim_radii(lens, int(named.surface), float(named.semi_diameter))
    surfaces = tuple(replace(s, semi_diameter=float(rim)) for s, rim in zip(lens.surfaces, rims, strict=True))
    aperture = Aperture("stop_semi_diameter", float(stop.semi_diameter))
    return replace(lens, surfaces=surfaces, stop_surface=int(stop.surface), aperture=aperture), stop


def _check_one_field(request: Request) -> None:
    stated = [ParameterName(name) for name in FIELDS if getattr(request, name) is not None]
    if len(stated) > 1:
        *others, last = stated
        raise RequestError(
            "the field is stated {count} times, by {names}; keep one",
            count=len(stated),
            names=Message("{others} and {last}", others=tuple(others), last=last),
        )
    height = next((name for name in FIELDS[1:] if getattr(request, name) is not None), None)
    if height and request.field_x_deg is not None:
        raise RequestError(
            "{parameter} is given with {height}; give {angle} with it, or leave it out",
            parameter="field_x_deg",
            height=ParameterName(height),
            angle=ParameterName("field_deg"),
        )
    if request.object_height_mm is not None and isinf(request.depth_mm):
        raise RequestError(
            "{parameter} is {value:g} mm, but an object at infinity has no height; "
            "give {depth} as well, or the field as an angle or an image height",
            parameter="object_height_mm",
            value=request.object_height_mm,
            depth=ParameterName("depth_mm"),
        )


def _check_one_focus(request: Request) -> None:
    if request.focus_mm is not None and request.focus_position is not None:
        raise RequestError(
            "the focus is stated twice, by {first} and {second}; keep one",
            first=ParameterName("focus_mm"),
            second=ParameterName("focus_position"),
        )


def _check_stop(stop: str) -> None:
    if stop not in ("file", "auto"):
        raise RequestError('{parameter} is "{value}"; choose file or auto', parameter="stop", value=stop)


def check_aim(aim: str | None) -> None:
    """Raise RequestError for a way to fill the pupil that there is not; None passes."""
    if aim not in (None, "stop", "paraxial", "real"):
        raise RequestError('{parameter} is "{value}"; choose stop or paraxial', parameter="aim", value=aim)
