"""Parameters that a user may set, each declared once: name, unit and range, flag and control, and wording."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, isfinite
from typing import Any

import numpy as np

from p2sf.arguments import first_place
from p2sf.conventions import FARTHEST_MM, NM_PER_UM, UM_PER_MM
from p2sf.errors import P2SFError, RequestError, SamplingError
from p2sf.messages import Message, Style

LARGEST_OBSCURATION = 0.99
MOST_VANES, WIDEST_VANE = 12, 0.5
FEWEST_BLADES, MOST_BLADES = 3, 32
NARROWEST_APODISATION, MOST_POWER = 0.1, 20
FASTEST, SLOWEST = 0.01, 1e6  # f-numbers: wide of every lens, and of pinholes of a wavelength
LARGEST_SIDE = 2**12  # samples along each side of a PSF or a transform: 128 MiB, and several times that in a sum
LONGEST_PATH_UM = 1e6  # a metre: steeper than any real phase plate, and far below the overflow of slopes
INFINITE = "{parameter} is {value:g}{unit}; give a positive number, inf allowed"
FINITE = "{parameter} is {value:g}{unit}; give a positive finite number"
FARTHER = "{parameter} is {value:g}{unit}, but rays from beyond {most:g} mm are in effect parallel; give inf"


def flag(name: str) -> str:
    """Return the option of the command line that sets a parameter: ``--field-deg`` for ``field_deg``."""
    return f"--{name.replace('_', '-')}"


COMMAND_LINE = Style(parameter=flag)
"""How every command puts messages into words."""


def control(name: str) -> str:
    """Return the English label of a parameter's control; without a control, the parameter's name in words."""
    found = PARAMETERS.get(name)
    return found.control if found else name.replace("_", " ")


def unit_behind(name: str) -> str:
    """Return the unit of a parameter as written after a number: "°", " mm" or an empty string."""
    unit = PARAMETERS[name].unit if name in PARAMETERS else ""
    return f" {unit}" if unit not in ("", "°") else unit


def check_positive(name: str, value: float | None, infinite: bool = False) -> None:
    """Raise RequestError unless a parameter is positive and, where ``infinite`` is not allowed, finite; None passes."""
    if value is None or (value > 0 and (infinite or value < inf)):
        return
    told = INFINITE if infinite else FINITE
    raise RequestError(told, parameter=name, value=value, unit=unit_behind(name))


LEAST_NM = 5.0  # below the shortest that lenses are made for (6.7 nm), and the longest in µm that glass passes


def check_wavelength_nm(name: str, value: float | None) -> None:
    """Raise RequestError for a wavelength in nm that is not positive and finite, or can only be in µm; None passes."""
    check_positive(name, value)
    if value is not None and value < LEAST_NM:
        raise RequestError(
            "{parameter} is {value:g} nm; if these are µm, give nanometres, {nm:g}",
            parameter=name,
            value=value,
            nm=value * NM_PER_UM,
        )


def check_distance(name: str, value: float | None) -> None:
    """Raise RequestError for a distance in mm that is not positive, or beyond FARTHEST_MM but not inf; None passes."""
    check_positive(name, value, infinite=True)
    check_reach(name, value)


def check_reach(name: str, value: float | None) -> None:
    """Raise RequestError for a distance in mm beyond FARTHEST_MM that is not inf; None passes."""
    if value is not None and FARTHEST_MM < value < inf:
        raise RequestError(FARTHER, parameter=name, value=value, unit=unit_behind(name), most=FARTHEST_MM)


def check_depth_map(depth_mm: np.ndarray) -> None:
    """Raise RequestError, which says where, for depths of a map, (rows, columns) mm, that are 0, negative or NaN."""
    wrong = ~(depth_mm > 0)
    if wrong.any():
        raise RequestError(
            "the depth map holds depths that are not positive, {count} of them, the first {value:g} mm at row {row}, "
            "column {column} (from 0); give mm from the first vertex, inf allowed",
            value=float(depth_mm[wrong][0]),
            **first_place(wrong),
        )


def check_finite(name: str, value: float | None) -> None:
    """Raise RequestError for a parameter that is infinite or not a number; None passes."""
    if value is not None and not isfinite(value):
        raise RequestError(
            "{parameter} is {value:g}{unit}; give a finite number", parameter=name, value=value, unit=unit_behind(name)
        )


def check_shift(name: str, value: float | None) -> None:
    """Raise RequestError for a shift in µm that is not finite, or beyond FARTHEST_MM; None passes."""
    check_finite(name, value)
    if value is not None:
        check_between(name, value, -FARTHEST_MM * UM_PER_MM, FARTHEST_MM * UM_PER_MM)


def check_f_number(name: str, value: float | None) -> None:
    """Raise RequestError for an f-number that is not positive, or that no lens has; None passes."""
    check_positive(name, value)
    check_between(name, value, FASTEST, SLOWEST)


def check_angle(name: str, value: float | None) -> None:
    """Raise RequestError unless an angle is between −90° and 90°; None passes."""
    check_finite(name, value)
    if value is not None and not abs(value) < 90:
        raise RequestError(
            "{parameter} is {value:g}°, but no ray at 90° or more from the axis enters a lens; give an angle above "
            "−90° and below 90°",
            parameter=name,
            value=value,
        )


def check_between(name: str, value: float | None, low: float, high: float) -> None:
    """Raise RequestError for a parameter outside a range; None passes."""
    if value is not None and not low <= value <= high:
        raise RequestError(
            "{parameter} is {value:g}; give a number from {low:g} to {high:g}",
            parameter=name,
            value=value,
            low=low,
            high=high,
        )


def check_count(name: str, value: int | None, low: int, most: int) -> None:
    """Raise RequestError unless a count is 0 or an integer within a range; None passes."""
    if value is not None and not (_is_whole(value) and (value == 0 or low <= value <= most)):
        raise RequestError(
            "{parameter} is {value}; give 0 for none, or a whole number from {low} to {high}",
            parameter=name,
            value=value,
            low=low,
            high=most,
        )


def check_whole(
    name: str, value: int | None, low: int, most: int, error: Callable[..., P2SFError] = RequestError
) -> None:
    """Raise an error, RequestError, unless a number is whole and within a range; None passes."""
    if value is not None and not (_is_whole(value) and low <= value <= most):
        raise error(
            "{parameter} is {value}; give a whole number from {low} to {high}",
            parameter=name,
            value=value,
            low=low,
            high=most,
        )


def check_samples(pixels: int | None, pixel_um: float | None, least: int = 1, most: int = LARGEST_SIDE) -> None:
    """Raise SamplingError for samples along each side, or a pitch in µm, that no PSF can have; None passes.

    One sample is a PSF, whose figures take two at ``least``.
    """
    check_whole("pixels", pixels, least, most, SamplingError)
    if pixel_um is not None and not 0 < pixel_um < inf:
        raise SamplingError(FINITE, parameter="pixel_um", value=pixel_um, unit=" µm")


def check_apodisation(name: str, value: float | None) -> None:
    """Raise RequestError for an apodisation that is too narrow; None passes."""
    if value is not None and not value >= NARROWEST_APODISATION:
        raise RequestError(
            "{parameter} is {value:g}; give a radius of at least {low:g}, inf for none",
            parameter=name,
            value=value,
            low=NARROWEST_APODISATION,
        )


def check_power(name: str, value: int | None) -> None:
    """Raise RequestError for a power of an apodisation that is odd or outside its range; None passes."""
    if value is not None and not (_is_whole(value) and value % 2 == 0 and 2 <= value <= MOST_POWER):
        raise RequestError(
            "{parameter} is {value}; give an even number from {low} to {high}",
            parameter=name,
            value=value,
            low=2,
            high=MOST_POWER,
        )


def _is_whole(value: object) -> bool:
    return isinstance(value, int | np.integer) and not isinstance(value, bool)


def check_stop(name: str, value: str | None) -> None:
    """Raise RequestError for an unknown choice of the stop."""
    if value not in ("file", "auto"):
        raise RequestError('{parameter} is "{value}"; choose file or auto', parameter=name, value=value)


def check_aim(name: str, value: str | None) -> None:
    """Raise RequestError for an unknown aim; None passes."""
    if value not in (None, "stop", "paraxial", "real"):
        raise RequestError('{parameter} is "{value}"; choose stop or paraxial', parameter=name, value=value)


def accept_any(name: str, value: object) -> None:
    """Accept every value: the lens checks it, or its annotation suffices."""


@dataclass(frozen=True)
class Parameter:
    """One quantity or choice.

    ``name``: the Python name, from which the command-line ``flag`` is formed; ``control``: the English label of its
    control in the window; ``check``: raises RequestError for impossible values. For numbers of the window, ``typed`` is
    the range that may be typed and ``words`` the name in a sentence. For those of the mask, ``tip`` is the tooltip of
    the slider, ``travel`` its range where that is less than ``typed``, ``labels`` the values named along it, the most
    important first, and ``needs`` the number without which this one has no effect.
    """

    name: str
    control: str
    unit: str = ""
    check: Callable[[str, Any], None] = accept_any
    typed: tuple[float, float] | None = None
    words: Message | None = None
    tip: str = ""
    travel: tuple[float, float] | None = None
    labels: tuple[float, ...] = ()
    needs: str = ""

    @property
    def flag(self) -> str:
        """Return the option of the command line."""
        return flag(self.name)


def _share(low: float, high: float) -> Callable[[str, Any], None]:
    return lambda name, value: check_between(name, value, low, high)


def _count(low: int, most: int) -> Callable[[str, Any], None]:
    return lambda name, value: check_count(name, value, low, most)


RING, ANGLE, TURN, AWAY = (-1e6, 1e6), (-89.0, 89.0), (-360.0, 360.0), (1e-3, inf)
SOURCE_PARAMETERS = (
    Parameter("depth_mm", "Depth", "mm", check_distance, AWAY, Message("source depth")),
    Parameter("field_deg", "Field", "°", check_angle, ANGLE, Message("field angle")),
    Parameter("field_x_deg", "Field in x", "°", check_angle, ANGLE, Message("field angle along x")),
    Parameter("object_height_mm", "the object height", "mm", check_finite),
    Parameter("image_height_mm", "the image height", "mm", check_finite),
    Parameter("wavelength_nm", "Wavelength", "nm", check_wavelength_nm, (100.0, 20000.0), Message("wavelength")),
)
"""Parameters of a point source, the fields of `p2sf.setting.PointSource`."""
CAMERA_PARAMETERS = (
    Parameter("zoom", "Zoom", "", accept_any, RING, Message("zoom")),
    Parameter("focus_position", "Focus", "", accept_any, RING, Message("focus")),
    Parameter("focus_mm", "Focus distance", "mm", check_distance, AWAY, Message("focus distance")),
    Parameter("sensor_shift_um", "Sensor shift", "µm", check_shift, (-1e6, 1e6), Message("sensor shift")),
    Parameter("f_number", "f-number", "", check_f_number, (0.2, 1000.0), Message("f-number")),
    Parameter("stop", "Stop", "", check_stop),
    Parameter("aim", "Rays fill", "", check_aim),
    Parameter("absorption", "Absorption"),
)
"""Parameters of a camera without those of the pupil mask, fields of `p2sf.camera.Camera`."""
MASK_PARAMETERS = (
    Parameter(
        "obscuration",
        "Obscuration",
        check=_share(0, LARGEST_OBSCURATION),
        typed=(0.0, LARGEST_OBSCURATION),
        words=Message("obscuration"),
        tip="Obscuration ε: radius of the dark disc in the middle of the stop, as a share of the rim's. It blocks ε² "
        "of the light, narrows the core and brightens the rings.",
        labels=(0, 0.5, 0.25, 0.75),
    ),
    Parameter("obscuration_x", "Obscuration in x", check=check_finite, needs="obscuration"),
    Parameter("obscuration_y", "Obscuration in y", check=check_finite, needs="obscuration"),
    Parameter(
        "vanes",
        "Vanes",
        check=_count(1, MOST_VANES),
        typed=(0, MOST_VANES),
        words=Message("number of vanes"),
        tip="Vanes of the spider that holds the obscuration, from the middle to the rim, evenly spaced; 0: none. Each "
        "makes a spike at right angles to itself.",
        labels=(0, 3, 6, 12),
    ),
    Parameter(
        "vane_width",
        "Vane width",
        check=_share(0, WIDEST_VANE),
        typed=(0.0, WIDEST_VANE),
        words=Message("vane width"),
        tip="Vane width, as a share of the rim's diameter.",
        travel=(0.0, 0.2),
        labels=(0, 0.1, 0.2),
        needs="vanes",
    ),
    Parameter(
        "vane_angle_deg",
        "Vane angle",
        "°",
        check_finite,
        TURN,
        Message("vane angle"),
        tip="Vane angle: direction of the first vane, from the direction of the field (+η) towards +ξ.",
        travel=(-180.0, 180.0),
        labels=(0, -180, 180, -90, 90),
        needs="vanes",
    ),
    Parameter(
        "blades",
        "Blades",
        check=_count(FEWEST_BLADES, MOST_BLADES),
        typed=(0, MOST_BLADES),
        words=Message("number of blades"),
        tip="Blades of the iris, their corners on the rim's circle; 0: round. An even number of blades gives as many "
        "spikes in the PSF, an odd number twice as many.",
        travel=(0, 16),
        labels=(0, 5, 10, 16),
    ),
    Parameter(
        "roundness",
        "Roundness",
        check=_share(0, 1),
        typed=(0.0, 1.0),
        words=Message("roundness"),
        tip="Roundness of the blades' edges: their curvature times the rim's radius, 0 straight, 1 a circle.",
        labels=(0, 1, 0.5),
        needs="blades",
    ),
    Parameter(
        "blade_angle_deg",
        "Blade angle",
        "°",
        check_finite,
        TURN,
        Message("blade angle"),
        tip="Blade angle: direction of the first corner, from the direction of the field (+η) towards +ξ.",
        travel=(-60.0, 60.0),
        labels=(0, -60, 60, -30, 30),
        needs="blades",
    ),
    Parameter(
        "apodisation",
        "Apodisation",
        check=check_apodisation,
        typed=(NARROWEST_APODISATION, inf),
        words=Message("apodisation"),
        tip="Apodisation: the radius, as a share of the rim's, where the amplitude has fallen to 1/e and the intensity "
        "to 1/e²; ∞: uniform light. It dims the rings and widens the core.",
    ),
    Parameter(
        "apodisation_power",
        "Apodisation power",
        check=check_power,
        typed=(2, MOST_POWER),
        words=Message("apodisation power"),
        tip="Apodisation power p of the amplitude exp(−(ρ/width)ᵖ): 2 is a Gaussian, a larger even number a "
        "super-Gaussian.",
        labels=(2, 20, 10),
        needs="apodisation",
    ),
    Parameter(
        "cubic_um",
        "Cubic phase",
        "µm",
        _share(-LONGEST_PATH_UM, LONGEST_PATH_UM),
        (-1000.0, 1000.0),
        Message("cubic phase"),
        tip="Cubic phase plate: α of the optical path α(ξ³ + η³) that it adds. It blurs every depth nearly alike, so "
        "one deconvolution can remove the blur.",
        travel=(-10.0, 10.0),
        labels=(0, -10, 10),
    ),
)
"""Parameters of the pupil mask, fields of both `p2sf.disc.mask.PupilMask` and `p2sf.camera.Camera`."""
ELSEWHERE = (
    Parameter("depths_mm", "Depths", "mm"),
    Parameter("fields_deg", "Fields", "°"),
    Parameter("fields_x_deg", "Fields in x", "°"),
    Parameter("wavelengths_nm", "Wavelengths", "nm"),
    Parameter("field_slope", "Field"),
    Parameter("azimuth_deg", "Azimuth", "°"),
    Parameter("wavelength_um", "Wavelength", "µm"),
    Parameter("method", "Method"),
    Parameter("tolerance", "the tolerance"),
    Parameter("clip", "Clip at rims"),
    Parameter("pixels", "Pixels a side"),
    Parameter("pixel_um", "Pixel pitch", "µm"),
)
PARAMETERS = {each.name: each for each in (*SOURCE_PARAMETERS, *CAMERA_PARAMETERS, *MASK_PARAMETERS, *ELSEWHERE)}


def check_values(instance: Any, parameters: tuple[Parameter, ...]) -> None:
    """Check the fields of an instance; raises RequestError for an impossible value."""
    for parameter in parameters:
        value = getattr(instance, parameter.name)
        if value is not None:
            parameter.check(parameter.name, value)
