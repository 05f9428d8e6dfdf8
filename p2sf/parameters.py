"""What a person may set, each declared once: its name, unit and range, its flag and its control, and its words."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, isfinite
from typing import Any

import numpy as np

from p2sf.conventions import FARTHEST_MM
from p2sf.errors import RequestError
from p2sf.messages import Message

LARGEST_OBSCURATION = 0.99
MOST_VANES, WIDEST_VANE = 12, 0.5
FEWEST_BLADES, MOST_BLADES = 3, 32
NARROWEST_APODISATION, MOST_POWER = 0.1, 20
LONGEST_PATH_UM = 1e6  # a metre: a steeper phase than any, and far from where slopes overflow
FARTHER = "{parameter} is {value:g}{unit}, and beyond {most:g} mm rays cannot be told from parallel ones; give inf"


def flag(name: str) -> str:
    """Return the option of the command line that sets a parameter: ``--field-deg`` for ``field_deg``."""
    return f"--{name.replace('_', '-')}"


def control(name: str) -> str:
    """Return the English name of the control that sets a parameter; of one without a control its own, in words."""
    found = PARAMETERS.get(name)
    return found.control if found else name.replace("_", " ")


def unit_behind(name: str) -> str:
    """Return the unit of a parameter as it is written behind a number: "°", " mm", or nothing."""
    unit = PARAMETERS[name].unit if name in PARAMETERS else ""
    return f" {unit}" if unit not in ("", "°") else unit


def check_positive(name: str, value: float | None, infinite: bool = False) -> None:
    """Raise RequestError unless a parameter is positive and, where ``infinite`` is not allowed, finite; None passes."""
    if value is None or (value > 0 and (infinite or value < inf)):
        return
    if infinite:
        raise RequestError(
            "{parameter} is {value:g}{unit}; give a positive number, inf allowed",
            parameter=name,
            value=value,
            unit=unit_behind(name),
        )
    raise RequestError(
        "{parameter} is {value:g}{unit}; give a positive finite number",
        parameter=name,
        value=value,
        unit=unit_behind(name),
    )


def check_distance(name: str, value: float | None) -> None:
    """Raise RequestError for a distance in mm that is not positive, or beyond FARTHEST_MM but not inf; None passes."""
    check_positive(name, value, infinite=True)
    check_reach(name, value)


def check_reach(name: str, value: float | None) -> None:
    """Raise RequestError for a distance in mm beyond FARTHEST_MM that is not inf; None passes."""
    if value is not None and FARTHEST_MM < value < inf:
        raise RequestError(FARTHER, parameter=name, value=value, unit=unit_behind(name), most=FARTHEST_MM)


def check_finite(name: str, value: float | None) -> None:
    """Raise RequestError for a parameter that is infinite or not a number; None passes."""
    if value is not None and not isfinite(value):
        raise RequestError(
            "{parameter} is {value:g}{unit}; give a finite number", parameter=name, value=value, unit=unit_behind(name)
        )


def check_angle(name: str, value: float | None) -> None:
    """Raise RequestError for an angle in degrees at which no ray enters a lens; None passes."""
    check_finite(name, value)
    if value is not None and not abs(value) < 90:
        raise RequestError(
            "{parameter} is {value:g}°, and no ray at 90° or more from the axis enters a lens; "
            "give an angle between −90 and 90°, both ends left out",
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
    """Raise RequestError for a number of parts that is not 0 and not a whole number within a range; None passes."""
    if value is not None and not (_is_whole(value) and (value == 0 or low <= value <= most)):
        raise RequestError(
            "{parameter} is {value}; give 0 for none, or a whole number from {low} to {high}",
            parameter=name,
            value=value,
            low=low,
            high=most,
        )


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
    """Raise RequestError for a choice of the stop that is not offered."""
    if value not in ("file", "auto"):
        raise RequestError('{parameter} is "{value}"; choose file or auto', parameter=name, value=value)


def check_aim(name: str, value: str | None) -> None:
    """Raise RequestError for a way to fill the pupil that is not offered; None passes."""
    if value not in (None, "stop", "paraxial", "real"):
        raise RequestError('{parameter} is "{value}"; choose stop or paraxial', parameter=name, value=value)


def unchecked(name: str, value: object) -> None:
    """Let every value pass: the lens decides, or the annotation has said all."""


@dataclass(frozen=True)
class Parameter:
    """One quantity or choice.

    ``name`` in Python, of which the ``flag`` of the command line is made; ``control``: the English label of its control
    in a window; ``check``: raises RequestError for what no lens can have. Of those that a window has as a number,
    ``typed`` is the range that may be typed there and ``words`` its name in a sentence.
    """

    name: str
    control: str
    unit: str = ""
    check: Callable[[str, Any], None] = unchecked
    typed: tuple[float, float] | None = None
    words: Message | None = None

    @property
    def flag(self) -> str:
        """Return the option of the command line."""
        return flag(self.name)


def _share(low: float, high: float) -> Callable[[str, Any], None]:
    return lambda name, value: check_between(name, value, low, high)


def _count(low: int, most: int) -> Callable[[str, Any], None]:
    return lambda name, value: check_count(name, value, low, most)


RING, ANGLE, TURN, AWAY = (-1e6, 1e6), (-89.0, 89.0), (-360.0, 360.0), (1e-3, inf)
OF_THE_SOURCE = (
    Parameter("depth_mm", "Depth", "mm", check_distance, AWAY, Message("source depth")),
    Parameter("field_deg", "Field", "°", check_angle, ANGLE, Message("field angle")),
    Parameter("field_x_deg", "Field in x", "°", check_angle, ANGLE, Message("field angle along x")),
    Parameter("object_height_mm", "the object height", "mm", check_finite),
    Parameter("image_height_mm", "the image height", "mm", check_finite),
    Parameter("wavelength_nm", "Wavelength", "nm", check_positive, (100.0, 20000.0), Message("wavelength")),
)
"""Where a point source is, as `p2sf.camera.PointSource` has it."""
OF_THE_CAMERA = (
    Parameter("zoom", "Zoom", "", unchecked, RING, Message("zoom")),
    Parameter("focus_position", "Focus", "", unchecked, RING, Message("focus")),
    Parameter("focus_mm", "Focus distance", "mm", check_distance, AWAY, Message("focus distance")),
    Parameter("sensor_shift_um", "Sensor shift", "µm", check_finite, (-1e6, 1e6), Message("sensor shift")),
    Parameter("f_number", "f-number", "", check_positive, (0.2, 1000.0), Message("f-number")),
    Parameter("stop", "Stop", "", check_stop),
    Parameter("aim", "Rays fill", "", check_aim),
    Parameter("absorption", "Absorption"),
)
"""How a camera is set beside what stands in its stop, as `p2sf.camera.Camera` has it."""
OF_THE_MASK = (
    Parameter(
        "obscuration",
        "Obscuration",
        check=_share(0, LARGEST_OBSCURATION),
        typed=(0.0, LARGEST_OBSCURATION),
        words=Message("obscuration"),
    ),
    Parameter("obscuration_x", "Obscuration in x", "", check_finite),
    Parameter("obscuration_y", "Obscuration in y", "", check_finite),
    Parameter("vanes", "Vanes", "", _count(1, MOST_VANES), (0, MOST_VANES), Message("number of vanes")),
    Parameter("vane_width", "Vane width", "", _share(0, WIDEST_VANE), (0.0, WIDEST_VANE), Message("vane width")),
    Parameter("vane_angle_deg", "Vane angle", "°", check_finite, TURN, Message("vane angle")),
    Parameter(
        "blades", "Blades", "", _count(FEWEST_BLADES, MOST_BLADES), (0, MOST_BLADES), Message("number of blades")
    ),
    Parameter("roundness", "Roundness", "", _share(0, 1), (0.0, 1.0), Message("roundness")),
    Parameter("blade_angle_deg", "Blade angle", "°", check_finite, TURN, Message("blade angle")),
    Parameter(
        "apodisation",
        "Apodisation",
        check=check_apodisation,
        typed=(NARROWEST_APODISATION, inf),
        words=Message("apodisation"),
    ),
    Parameter(
        "apodisation_power",
        "Apodisation power",
        check=check_power,
        typed=(2, MOST_POWER),
        words=Message("apodisation power"),
    ),
    Parameter(
        "cubic_um",
        "Cubic phase",
        "µm",
        _share(-LONGEST_PATH_UM, LONGEST_PATH_UM),
        (-1000.0, 1000.0),
        Message("cubic phase"),
    ),
)
"""What stands in the stop, by the fields of `p2sf.pupil.mask.PupilMask`, as `p2sf.camera.Camera` has it too."""
ELSEWHERE = (
    Parameter("depths_mm", "Depths", "mm"),
    Parameter("fields_deg", "Fields", "°"),
    Parameter("wavelengths_nm", "Wavelengths", "nm"),
    Parameter("field_slope", "Field"),
    Parameter("azimuth_deg", "Azimuth", "°"),
    Parameter("wavelength_um", "Wavelength", "µm"),
    Parameter("method", "Method"),
    Parameter("tolerance", "the tolerance"),
    Parameter("clip", "Clip at rims"),
)
PARAMETERS = {each.name: each for each in (*OF_THE_SOURCE, *OF_THE_CAMERA, *OF_THE_MASK, *ELSEWHERE)}


def check_values(instance: Any, parameters: tuple[Parameter, ...]) -> None:
    """Raise RequestError for a field of these names that no lens can have."""
    for parameter in parameters:
        value = getattr(instance, parameter.name)
        if value is not None:
            parameter.check(parameter.name, value)
