"""The setting of a lens and the position of a point source as a user states them, and what they make of a lens.

The library, the command line, the window and files all come through `set_up` or `set_up_source`, so that the same
numbers mean the same everywhere. `p2sf.parameters` declares every parameter once.
"""

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cache, lru_cache, wraps
from inspect import signature
from math import inf, isfinite, isinf
from typing import Any, Literal, Self, TypeVar, cast

import numpy as np

from p2sf.arguments import check_fields
from p2sf.conventions import NM_PER_UM, UM_PER_MM, degrees_from_slope
from p2sf.disc.mask import CLEAR, MaskSettings, PupilMask
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
from p2sf.parameters import (
    CAMERA_PARAMETERS,
    MASK_PARAMETERS,
    SOURCE_PARAMETERS,
    check_angle,
    check_positive,
    check_values,
    unit_behind,
)
from p2sf.paraxial.positions import focused_inside, lens_at
from p2sf.paraxial.pupils import (
    Stop,
    field_from_image_height,
    field_from_object_height,
    find_stop,
    paraxial_rays,
    rim_radii,
)

StopChoice = Literal["file", "auto"]
AimChoice = Literal["stop", "paraxial", "real"]
"""As `Lens.aim`; "real" is the former name of "stop"."""
FIELDS = ("field_deg", "object_height_mm", "image_height_mm")
MASK = tuple(parameter.name for parameter in MASK_PARAMETERS)
"""The parameters of the pupil mask that a camera may set."""
Function = TypeVar("Function", bound=Callable[..., Any])


@dataclass(frozen=True, kw_only=True)
class LensSettings:
    """The settings of a lens; None means the value of the lens file.

    Attributes
    ----------
    zoom : float or str, optional
        Position of the zoom ring: a number on the lens's own scale, or the name of a column of its file.
    focus_position : float or str, optional
        Position of the focus ring of a lens that focuses inside, given as for zoom.
    focus_mm : float, optional
        Distance of the plane in focus from the first vertex, mm; inf is allowed. The sensor moves to the paraxial
        image of that plane at the lens's middle wavelength. A lens that focuses inside turns its ring instead, and
        moves its sensor only for planes beyond an end of the ring.
    sensor_shift_um : float
        Additional shift of the sensor away from the lens, µm.
    f_number : float, optional
        Focal length over entrance-pupil diameter, instead of the file's aperture.
    stop : {"file", "auto"}
        Which surface is the stop: that of the file, or the rim that limits the cone of light at the depth of the source
        (auto).
    aim : {"stop", "paraxial"}, optional
        What exact rays fill evenly, whichever surface the stop is: the real stop up to its rim, or the paraxial
        entrance pupil. By default as the lens has it.
    absorption : bool, optional
        Account for absorption in those media whose catalogue (AGF) states their internal transmittance.
    """

    zoom: float | str | None = None
    focus_position: float | str | None = None
    focus_mm: float | None = None
    sensor_shift_um: float = 0.0
    f_number: float | None = None
    stop: StopChoice = "file"
    aim: AimChoice | None = None
    absorption: bool | None = None


@dataclass(frozen=True, kw_only=True)
class Settings(MaskSettings, LensSettings):
    """The settings of a camera: of its lens, and of the mask in its stop; None means the value of the lens file.

    Attributes
    ----------
    obscuration_x : float, optional
        Centre of the dark disc in x, as a share of the rim's radius; the whole disc must lie within the rim.
    obscuration_y : float, optional
        Centre of the dark disc in y.

    Raises
    ------
    RequestError
        For an impossible value, and for a focus stated twice.
    """

    obscuration_x: float | None = None
    obscuration_y: float | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        check_values(self, (*CAMERA_PARAMETERS, *MASK_PARAMETERS))
        if self.focus_mm is not None and self.focus_position is not None:
            raise RequestError(
                "the focus is stated twice, by {first} and {second}; keep one",
                first=ParameterName("focus_mm"),
                second=ParameterName("focus_position"),
            )

    def __repr__(self) -> str:
        return _call_text(type(self).__name__, [], explicit_values(self))


@dataclass(frozen=True)
class PointSource:
    """Position and wavelength of a point source; without a field it lies on the axis.

    Attributes
    ----------
    depth_mm
        Object distance from the first vertex, mm, up to 1e16; inf is allowed. By default that of the file, see
        `p2sf.raytrace.focusing.object_distance`.
    field_deg
        Chief-ray angle at the entrance pupil, degrees, also at finite depth; the angle in y if ``field_x_deg`` is
        given.
    field_x_deg
        Chief-ray angle in x, degrees, for sources outside the plane x = 0; it matters for misaligned lenses.
    object_height_mm
        Object height instead of an angle, mm. A positive one stands for a positive field: the object lies at −y.
    image_height_mm
        Height of the paraxial chief ray on the sensor instead of an angle, mm.
    wavelength_nm
        Wavelength, nm; by default the primary one of the file, or its middle one.
    """

    depth_mm: float | None = None
    field_deg: float | None = None
    field_x_deg: float | None = None
    object_height_mm: float | None = None
    image_height_mm: float | None = None
    wavelength_nm: float | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        check_values(self, SOURCE_PARAMETERS)
        _check_one_field(self)


@dataclass(frozen=True, repr=False)
class Request(Settings, PointSource):
    """One point source together with the settings of the camera, as on the command line."""

    def __post_init__(self) -> None:
        PointSource.__post_init__(self)
        Settings.__post_init__(self)


@dataclass(frozen=True, repr=False)
class CameraData(Settings):
    """A lens on a sensor and how both are set, as data; `p2sf.Camera` adds what can be asked of it.

    Attributes
    ----------
    lens : Lens, optional
        The lens.
    pixel_um : float, optional
        Distance between the sensor's pixels, µm.
    """

    lens: Lens | None = None
    pixel_um: float | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        check_positive("pixel_um", self.pixel_um)

    def __repr__(self) -> str:
        given = explicit_values(self)
        lens = given.pop("lens", None)
        return _call_text("Camera", ([] if lens is None else [repr(lens.name)]), given)

    @property
    def settings(self) -> Self:
        """Return how the camera is set, without its lens and its pixels."""
        return type(self)(**{name: getattr(self, name) for name, _ in _defaults(Settings)})

    @property
    def its_lens(self) -> Lens:
        """Return the lens as its file has it; RequestError for a camera without one."""
        if self.lens is None:
            raise RequestError(
                "this camera has no lens; give its name, a file or what p2sf.load_lens returns as the first argument"
            )
        return self.lens

    def source(
        self,
        depth_mm: float | None = None,
        field_deg: float | tuple[float, float] = 0.0,
        wavelength_nm: float | None = None,
    ) -> Source:
        """Return a point source, by default at the distance in focus, on the axis, of the lens's reference wavelength.

        Where `focus_mm` is not stated that distance is the lens's own, see `p2sf.raytrace.focusing.object_distance`.

        ``field_deg``: the angle of its chief ray, degrees, or the angles (x, y). RequestError for what cannot be.
        """
        if wavelength_nm is None:
            wavelength_nm = self.its_lens.reference_wavelength_nm
        if depth_mm is None:
            depth_mm = self.usual_depth_mm
        return Source(depth_mm, field_deg=field_deg, wavelength_nm=wavelength_nm)

    @property
    def usual_depth_mm(self) -> float:
        """Return the distance in focus; where it is not stated, that at which the lens's object stands."""
        return _object_distance(self.its_lens, self) if self.focus_mm is None else self.focus_mm


AS_IN_FILE = CameraData()


def _call_text(name: str, first: list[str], given: Mapping[str, Any]) -> str:
    return f"{name}({', '.join([*first, *(f'{key}={value!r}' for key, value in given.items())])})"


def explicit_values(camera: Settings) -> dict[str, Any]:
    """Return the values of a camera or request that differ from their defaults; numpy scalars become plain numbers."""
    values = ((name, usual, getattr(camera, name)) for name, usual in _defaults(cast("Any", type(camera))))
    return {
        name: value.item() if isinstance(value, np.generic) else value
        for name, usual, value in values
        if value != usual
    }


@cache
def _defaults(kind: Any) -> tuple[tuple[str, Any], ...]:
    return tuple((field.name, field.default) for field in fields(kind))


def with_camera(function: Function) -> Function:
    """Decorate a function so that keywords named after fields of `Settings` reach it as one ``camera`` without a lens.

    The pixels of the camera are used unless the call gives its own. The decorated function raises RequestError if a
    keyword and the camera set the same field, and if the camera has another lens than the call.
    """
    parameters = signature(function).parameters
    usual = {name: default for name, default in _defaults(Settings) if name in parameters}

    @wraps(function)
    def wrapper(*args: Any, camera: CameraData = AS_IN_FILE, **kwargs: Any) -> Any:
        own = {name: kwargs.pop(name) for name in usual.keys() & kwargs.keys()}
        if camera.lens is not None:
            _check_lens(camera.lens, args[0] if args else kwargs.get("lens"))
        if camera.pixel_um is not None and "pixel_um" in parameters and kwargs.get("pixel_um") is None:
            kwargs["pixel_um"] = camera.pixel_um
        if camera is not AS_IN_FILE:
            camera = camera.settings
        return function(*args, camera=_merge(camera, own) if own else camera, **kwargs)

    return cast("Function", wrapper)


def _check_lens(own: Lens, other: object) -> None:
    """Raise RequestError unless the lens of a camera is that of the call."""
    if other is not own and other != own:
        raise RequestError(
            "{parameter} and {other} are both given; keep one of them", parameter="lens", other="camera.lens"
        )


def _merge(camera: CameraData, keywords: Mapping[str, Any]) -> CameraData:
    """Return a camera with the fields that keywords set in addition; None sets nothing."""
    defaults = dict(_defaults(Settings))
    given = {name: value for name, value in keywords.items() if value is not None or defaults[name] is not None}
    twice = next((name for name in given if getattr(camera, name) != defaults[name]), None)
    if twice:
        raise RequestError(
            "{parameter} and {other} are both given; keep one of them", parameter=twice, other=f"camera.{twice}"
        )
    return replace(camera, **given) if given else camera


@dataclass(frozen=True)
class Setup:
    """A request applied to a lens: the lens with its sensor, aperture, stop and aim set, and the source.

    ``prescription`` is the lens of the file at its zoom and focus position.
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
    """Return the setup of a request for this lens.

    Raises RequestError for an impossible value, GeometryError for one this lens does not allow, and GlassError for a
    wavelength outside the data of its glasses.
    """
    depth = _object_distance(lens, request) if request.depth_mm is None else request.depth_mm
    lens = at_position(lens, request)
    source = Source(depth, 0.0, wavelength_um(lens, request))
    return with_field(_with_stop(lens, request, source, request.wavelength_nm is not None), request)


def _object_distance(lens: Lens, camera: Settings) -> float:
    """Return where the object of a lens stands with its rings turned by hand, mm; what is in focus does not move it."""
    from p2sf.raytrace.focusing import object_distance

    turned = lens if lens.positions is None else lens_at(lens, camera.zoom, camera.focus_position)
    return object_distance(turned)


def usual_depths(own_mm: float, near_mm: float, focused: bool = False) -> list[float]:
    """Return the depths, mm, that a database covers unless others are asked for.

    From half of the distance in focus, or ``near_mm``, to infinity; of a lens made for a near object, within ten per
    cent of its distance.
    """
    if not isfinite(own_mm):
        return [near_mm, inf]
    return [own_mm / 2, inf] if focused else [0.9 * own_mm, 1.1 * own_mm]


def set_up_source(lens: Lens, source: Source | None, camera: Settings = AS_IN_FILE) -> Setup:
    """Return the setup of a given source, by default the one that `set_up` takes, whose errors it raises."""
    if source is None:
        return set_up(lens, Request(**explicit_values(camera)))
    check_one(source)
    check_angle("field_deg", source.field_deg)
    setup = _with_stop(at_position(lens, camera), camera, source, True)
    _check_chief_ray(setup)
    return setup


def _with_stop(lens: Lens, camera: Settings, source: Source, named: bool) -> Setup:
    """Return the setup of a lens at its position; ``named``: the wavelength was given by a parameter."""
    try:
        indices(lens, source.wavelength_um)
    except GlassError as error:
        raise (_with_parameter(error) if named else error) from None
    lens, focused = _apply_camera(lens, camera)
    used, stop = _apply_stop(focused, camera.stop, source)
    return Setup(used, source, stop, lens)


@lru_cache(maxsize=64)
def _apply_camera(lens: Lens, camera: Settings) -> tuple[Lens, Lens]:
    """Return the lens with the camera's mask and absorption, and the same with its aperture, aim and sensor as well.

    Cached, so that successive sources get the identical object, for which other caches hold results.
    """
    lens = with_mask(lens, mask_of(lens, camera))
    lens = lens if camera.absorption is None else with_absorption(lens, camera.absorption)
    opened = with_chosen_aim(_with_f_number(lens, camera.f_number), camera.aim)
    return lens, with_sensor(opened, sensor_position(lens, camera))


def mask_of(lens: Lens | None, camera: Settings) -> PupilMask:
    """Return the lens's mask, or a clear one, with the camera's values; raises RequestError for impossible ones."""
    own = CLEAR if lens is None else lens.mask
    asked = {name: value for name in MASK if (value := getattr(camera, name)) is not None}
    return replace(own, **asked) if asked else own


def _with_parameter(error: GlassError) -> GlassError:
    """Return the error with the parameter's name for the wavelength."""
    message = error.message
    if "quantity" not in message.values:
        return error
    return GlassError(Message(message.template, **message.values | {"quantity": ParameterName("wavelength_nm")}))


def with_field(setup: Setup, request: PointSource) -> Setup:
    """Return a setup with its source moved to the field of a request that otherwise equals that of the setup.

    Raises as `set_up` does.
    """
    slope = field_slope(setup, request)
    azimuth = _direction(request).azimuth_deg
    return replace(setup, source=replace(setup.source, field_slope=slope, azimuth_deg=azimuth))


def _direction(request: PointSource) -> Source:
    """Return the source at the two field angles of a request."""
    return Source(field_deg=(request.field_x_deg or 0.0, request.field_deg or 0.0))


def wavelength_um(lens: Lens, request: PointSource) -> float:
    """Return the wavelength of a request in µm, by default the reference wavelength of the lens."""
    if request.wavelength_nm is None:
        return lens.reference_wavelength_um
    return request.wavelength_nm / NM_PER_UM


def at_position(lens: Lens, camera: Settings) -> Lens:
    """Return the lens at the camera's zoom and focus; RequestError for a missing ring or an impossible position."""
    if lens.positions is None and camera.zoom is None and camera.focus_position is None:
        return lens
    turned = lens_at(lens, camera.zoom, camera.focus_position)
    return turned if camera.focus_mm is None else focused_inside(turned, camera.focus_mm)


def sensor_position(lens: Lens, camera: Settings) -> float:
    """Return the position of the sensor, mm behind the last vertex.

    It does not depend on the wavelength of the source: with ``focus_mm`` the sensor is at the paraxial image for the
    lens's middle wavelength. Raises RequestError unless that image is real and at a finite distance.
    """
    place = _sensor_in_focus(lens, camera.focus_mm)
    shifted = place + camera.sensor_shift_um / UM_PER_MM
    if shifted * lens.directions[-1] <= 0 < place * lens.directions[-1]:
        raise RequestError(
            "{parameter} is {value:g} µm, which moves the sensor from {place:g} mm behind the lens into the lens; "
            "give a smaller shift",
            parameter="sensor_shift_um",
            value=camera.sensor_shift_um,
            place=place,
        )
    return shifted


def _sensor_in_focus(lens: Lens, focus_mm: float | None) -> float:
    from p2sf.raytrace.focusing import sensor_in_focus

    if focus_mm is None:
        return lens.sensor_mm
    place = sensor_in_focus(lens, focus_mm)
    if not (isfinite(place) and (lens.tilted or place * lens.directions[-1] > 0)):
        finite = Message("{place:g} mm from the last vertex", place=place)
        raise RequestError(
            "{parameter} is {value:g} mm, but the image of that distance lies {where}, not on a sensor behind the "
            "lens; give a distance with a real image, usually a longer one",
            parameter="focus_mm",
            value=focus_mm,
            where=finite if isfinite(place) else Message("at infinity"),
        )
    return place


def field_slope(setup: Setup, request: PointSource) -> float:
    """Return the field slope of the stated field; 0 when none is stated."""
    lens, wavelength, stop = setup.lens, setup.source.wavelength_um, setup.stop
    if request.object_height_mm is not None:
        _check_height(request, setup.source.depth_mm)
        slope = field_from_object_height(lens, setup.source.depth_mm, wavelength, request.object_height_mm, stop)
    elif request.image_height_mm is not None:
        slope = field_from_image_height(lens, wavelength, request.image_height_mm, stop)
    else:
        slope = np.asarray(_direction(request).field_slope)
    _check_chief_ray(setup)
    _check_slope(request, float(slope))
    return float(slope)


def _check_chief_ray(setup: Setup) -> None:
    """Raise GeometryError for depths and stops that have no chief ray."""
    paraxial_rays(setup.lens, setup.source.depth_mm, setup.source.wavelength_um, setup.stop)


def _check_slope(request: PointSource, slope: float) -> None:
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


def _with_f_number(lens: Lens, f_number: float | None) -> Lens:
    return lens if f_number is None else with_f_number(lens, f_number)


def with_chosen_aim(lens: Lens, aim: AimChoice | None) -> Lens:
    """Return the lens with this aim, or unchanged for None."""
    if aim == "real":
        warnings.warn('aim "real" is "stop" now', DeprecationWarning, stacklevel=2)
    return lens if aim is None else with_aim(lens, "stop" if aim == "real" else aim)


def _apply_stop(lens: Lens, choice: StopChoice, source: Source) -> tuple[Lens, Stop]:
    """Return the lens with the chosen stop stated, so that every later step uses the same one, and the stop."""
    stop = find_stop(lens, source.depth_mm, source.wavelength_um, choice)
    if choice == "file":
        return lens, stop
    named = find_stop(lens, source.depth_mm, source.wavelength_um)
    rims = rim_radii(lens, int(named.surface), float(named.semi_diameter))
    surfaces = tuple(replace(s, semi_diameter=float(rim)) for s, rim in zip(lens.surfaces, rims, strict=True))
    aperture = Aperture("stop_semi_diameter", float(stop.semi_diameter))
    return replace(lens, surfaces=surfaces, stop_surface=int(stop.surface), aperture=aperture), stop


def _check_one_field(request: PointSource) -> None:
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


def _check_height(request: PointSource, depth_mm: float) -> None:
    """Raise RequestError for an object height at infinity."""
    if isinf(depth_mm):
        raise RequestError(
            "{parameter} is {value:g} mm, but an object at infinity has no height; "
            "give {depth} as well, or the field as an angle or an image height",
            parameter="object_height_mm",
            value=request.object_height_mm,
            depth=ParameterName("depth_mm"),
        )
