"""How a camera is set and where a point source is, as a person states them, and the lens, source and stop they mean.

The library, the command line, the window and files all come through `set_up` or `set_up_source`, so that the same
numbers mean the same everywhere. `p2sf.parameters` declares every number once.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from functools import cache, lru_cache, wraps
from inspect import signature
from math import inf, isfinite, isinf
from typing import Any, Literal, TypeVar, cast

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
from p2sf.parameters import OF_THE_CAMERA, OF_THE_MASK, OF_THE_SOURCE, check_angle, check_values, unit_behind
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
MASK = tuple(parameter.name for parameter in OF_THE_MASK)
"""What of the mask in the stop a camera may state."""
Function = TypeVar("Function", bound=Callable[..., Any])


@dataclass(frozen=True)
class Camera:
    """How a camera is set; None means: as the lens file has it.

    Attributes
    ----------
    zoom : float or str, optional
        Position of the zoom ring: a number on the lens's own scale, or the name of a column of its file.
    focus_position : float or str, optional
        Position of the focus ring of a lens that focuses inside, given as for zoom.
    focus_mm : float, optional
        Focus on the plane this far in front of the first vertex, mm; inf is allowed. The sensor moves to the paraxial
        image of that plane at the lens's middle wavelength. A lens that focuses inside turns its ring instead, and
        moves its sensor only for planes beyond an end of the ring.
    sensor_shift_um : float
        Then move the sensor by this much away from the lens, µm.
    f_number : float, optional
        Focal length over entrance-pupil diameter, instead of the file's aperture.
    stop : {"file", "auto"}
        Take the stop from the file, or let the narrowest rim at the depth of the source decide (auto).
    aim : {"stop", "paraxial"}, optional
        Fill the rim of the real stop with exact rays, or the paraxial entrance pupil; "real" is the former name of
        "stop".
    absorption : bool, optional
        Take from the rays what the media absorb whose catalogue (AGF) states their internal transmittance.
    obscuration : float, optional
        Radius of a dark disc in the stop, as a share of the rim's, 0 to 0.99.
    obscuration_x : float, optional
        Where the middle of the dark disc stands in x, as a share of the rim's radius; all of it lies within the rim.
    obscuration_y : float, optional
        Where it stands in y.
    vanes : int, optional
        Number of vanes that run from the middle of the stop to its rim.
    vane_width : float, optional
        Width of a vane, as a share of the stop's diameter.
    vane_angle_deg : float, optional
        Direction of the first vane, degrees from +y towards +x.
    blades : int, optional
        Number of blades of the iris; 0 for a round one.
    roundness : float, optional
        Curvature of the blades' edges, as a share of the rim's: 0 straight, 1 a circle.
    blade_angle_deg : float, optional
        Direction of the iris's first corner, degrees from +y towards +x.
    apodisation : float, optional
        Radius where the amplitude has fallen to 1/e, as a share of the rim's; inf for none.
    apodisation_power : int, optional
        2 for a Gaussian, a larger even number for a super-Gaussian.
    cubic_um : float, optional
        α of the path α(ξ³ + η³) that a cubic phase plate adds, µm.

    Raises
    ------
    RequestError
        For a value that no camera can have, and for a focus stated twice.

    Examples
    --------
    >>> import p2sf
    >>> camera = p2sf.Camera(f_number=5.6, focus_mm=3000, blades=7)
    >>> camera
    Camera(focus_mm=3000, f_number=5.6, blades=7)
    >>> p2sf.render(p2sf.load_lens("double_gauss_28"), p2sf.Source(3000), camera=camera).method
    'seidel'
    """

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
        check_values(self, (*OF_THE_CAMERA, *OF_THE_MASK))
        if self.focus_mm is not None and self.focus_position is not None:
            raise RequestError(
                "the focus is stated twice, by {first} and {second}; keep one",
                first=ParameterName("focus_mm"),
                second=ParameterName("focus_position"),
            )

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in stated(self).items())})"


@dataclass(frozen=True)
class PointSource:
    """Where a point source is; None for the field: on the axis.

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
    """

    depth_mm: float = inf
    field_deg: float | None = None
    field_x_deg: float | None = None
    object_height_mm: float | None = None
    image_height_mm: float | None = None
    wavelength_nm: float | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        check_values(self, OF_THE_SOURCE)
        _check_one_field(self)


@dataclass(frozen=True, repr=False)
class Request(Camera, PointSource):
    """One point source and how the camera is set, as a command line states both."""

    def __post_init__(self) -> None:
        PointSource.__post_init__(self)
        Camera.__post_init__(self)


AS_IN_FILE = Camera()


def stated(camera: Camera) -> dict[str, Any]:
    """Return what a camera, or a request, states otherwise than by default, plain numbers for those of numpy."""
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
    """Return a function whose keywords by the names of a camera's numbers reach it as one ``camera``.

    RequestError where a keyword and the camera state the same number, and for a `Request`, whose source is another.
    """
    usual = {name: default for name, default in _defaults(Camera) if name in signature(function).parameters}

    @wraps(function)
    def called(*args: Any, camera: Camera = AS_IN_FILE, **kwargs: Any) -> Any:
        if isinstance(camera, PointSource):
            raise RequestError(
                "{parameter} is {value}; give {wanted}",
                parameter="camera",
                value=f"{camera!r:.60}",
                wanted="a p2sf.Camera",
            )
        own = {name: kwargs.pop(name) for name in usual.keys() & kwargs.keys()}
        return function(*args, camera=_together(camera, own) if own else camera, **kwargs)

    return cast("Function", called)


def _together(camera: Camera, keywords: Mapping[str, Any]) -> Camera:
    """Return a camera with what keywords state besides; None states nothing."""
    defaults = dict(_defaults(Camera))
    given = {name: value for name, value in keywords.items() if value is not None or defaults[name] is not None}
    twice = next((name for name in given if getattr(camera, name) != defaults[name]), None)
    if twice:
        raise RequestError(
            "{parameter} and {other} are both given; keep one of them", parameter=twice, other=f"camera.{twice}"
        )
    return replace(camera, **given) if given else camera


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
    source = Source(request.depth_mm, 0.0, wavelength_um(lens, request))
    return with_field(_with_stop(lens, request, source, request.wavelength_nm is not None), request)


def set_up_source(lens: Lens, source: Source, camera: Camera = AS_IN_FILE) -> Setup:
    """Return the setup of a source that is known already; raises as `set_up` does."""
    check_one(source)
    check_angle("field_deg", source.field_deg)
    setup = _with_stop(at_position(lens, camera), camera, source, True)
    _check_chief_ray(setup)
    return setup


def _with_stop(lens: Lens, camera: Camera, source: Source, named: bool) -> Setup:
    """Return the setup of a lens whose rings stand as asked; ``named``: the wavelength was stated by a parameter."""
    try:
        indices(lens, source.wavelength_um)
    except GlassError as error:
        raise (_with_parameter(error) if named else error) from None
    lens, focused = _opened_and_focused(lens, camera)
    used, stop = _lens_and_stop(focused, camera.stop, source)
    return Setup(used, source, stop, lens)


@lru_cache(maxsize=64)
def _opened_and_focused(lens: Lens, camera: Camera) -> tuple[Lens, Lens]:
    """Return the lens with the mask and the absorption asked for, and the same with aperture, aim and sensor as asked.

    Kept, so that sources one after the other find the very same lens, of which much is known already.
    """
    lens = with_mask(lens, mask_of(lens, camera))
    lens = lens if camera.absorption is None else with_absorption(lens, camera.absorption)
    opened = aimed(_with_f_number(lens, camera.f_number), camera.aim)
    return lens, with_sensor(opened, sensor_position(lens, camera))


def mask_of(lens: Lens | None, camera: Camera) -> PupilMask:
    """Return the lens's mask, or a clear one, with what a camera states; RequestError for what no mask can have."""
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
    """Return a setup with its source at the field of a request that is the setup's own but for the field.

    Raises as `set_up` does.
    """
    slope = field_slope(setup, request)
    azimuth = _direction(request).azimuth_deg
    return replace(setup, source=replace(setup.source, field_slope=slope, azimuth_deg=azimuth))


def _direction(request: PointSource) -> Source:
    """Return a source at the two angles of a request."""
    return Source(field_deg=(request.field_x_deg or 0.0, request.field_deg or 0.0))


def wavelength_um(lens: Lens, request: PointSource) -> float:
    """Return the asked wavelength in µm, the lens's middle one when none is asked."""
    if request.wavelength_nm is None:
        return lens.reference_wavelength_um
    return request.wavelength_nm / NM_PER_UM


def at_position(lens: Lens, camera: Camera) -> Lens:
    """Return the lens with its rings turned as asked; RequestError for a ring it lacks, or a place not on one."""
    if lens.positions is None and camera.zoom is None and camera.focus_position is None:
        return lens
    turned = lens_at(lens, camera.zoom, camera.focus_position)
    return turned if camera.focus_mm is None else focused_inside(turned, camera.focus_mm)


def sensor_position(lens: Lens, camera: Camera) -> float:
    """Return where the sensor stands, mm behind the last vertex.

    It does not depend on the wavelength of the source: with ``focus_mm`` the sensor is at the paraxial image for the
    lens's middle wavelength. Raises RequestError when that image is not a real one at a finite place.
    """
    place = _sensor_in_focus(lens, camera.focus_mm)
    shifted = place + camera.sensor_shift_um / UM_PER_MM
    if shifted * lens.directions[-1] <= 0 < place * lens.directions[-1]:
        raise RequestError(
            "{parameter} is {value:g} µm, which moves the sensor from {place:g} mm behind the lens into it; "
            "give a smaller shift",
            parameter="sensor_shift_um",
            value=camera.sensor_shift_um,
            place=place,
        )
    return shifted


def _sensor_in_focus(lens: Lens, focus_mm: float | None) -> float:
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


def field_slope(setup: Setup, request: PointSource) -> float:
    """Return the field slope that the one stated field means; 0 when none is stated."""
    lens, wavelength, stop = setup.lens, setup.source.wavelength_um, setup.stop
    if request.object_height_mm is not None:
        slope = field_from_object_height(lens, request.depth_mm, wavelength, request.object_height_mm, stop)
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


def aimed(lens: Lens, aim: AimChoice | None) -> Lens:
    """Return the lens with its pupil filled as asked, as the lens says where nothing is."""
    return lens if aim is None else with_aim(lens, "stop" if aim == "real" else aim)


def _lens_and_stop(lens: Lens, choice: StopChoice, source: Source) -> tuple[Lens, Stop]:
    """Return the stop in use, and the lens naming it, so that every later step agrees on it."""
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
    if request.object_height_mm is not None and isinf(request.depth_mm):
        raise RequestError(
            "{parameter} is {value:g} mm, but an object at infinity has no height; "
            "give {depth} as well, or the field as an angle or an image height",
            parameter="object_height_mm",
            value=request.object_height_mm,
            depth=ParameterName("depth_mm"),
        )
