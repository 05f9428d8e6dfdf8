"""What a person may set, each named once: its Python name, its flag on the command line, its control in a window."""

from dataclasses import dataclass
from math import inf, isfinite

from p2sf.conventions import FARTHEST_MM
from p2sf.errors import RequestError

FARTHER = "{parameter} is {value:g}{unit}, and beyond {most:g} mm rays cannot be told from parallel ones; give inf"


@dataclass(frozen=True)
class Parameter:
    """One quantity or choice: its ``name`` in Python, the English label of its ``control``, the ``unit``."""

    name: str
    control: str
    unit: str = ""

    @property
    def flag(self) -> str:
        """Return the option of the command line."""
        return flag(self.name)


PARAMETERS = {
    parameter.name: parameter
    for parameter in (
        Parameter("depth_mm", "Depth", "mm"),
        Parameter("depths_mm", "Depths", "mm"),
        Parameter("fields_deg", "Fields", "°"),
        Parameter("wavelengths_nm", "Wavelengths", "nm"),
        Parameter("zoom", "Zoom"),
        Parameter("focus_position", "Focus"),
        Parameter("focus_mm", "Focus distance", "mm"),
        Parameter("sensor_shift_um", "Sensor shift", "µm"),
        Parameter("field_deg", "Field", "°"),
        Parameter("field_x_deg", "Field in x", "°"),
        Parameter("field_slope", "Field"),
        Parameter("azimuth_deg", "Azimuth", "°"),
        Parameter("object_height_mm", "the object height", "mm"),
        Parameter("image_height_mm", "the image height", "mm"),
        Parameter("wavelength_nm", "Wavelength", "nm"),
        Parameter("wavelength_um", "Wavelength", "µm"),
        Parameter("f_number", "f-number"),
        Parameter("stop", "Stop"),
        Parameter("aim", "Rays fill"),
        Parameter("absorption", "Absorption"),
        Parameter("method", "Method"),
        Parameter("tolerance", "the tolerance"),
        Parameter("clip", "Clip at rims"),
        Parameter("obscuration", "Obscuration"),
        Parameter("obscuration_x", "Obscuration in x"),
        Parameter("obscuration_y", "Obscuration in y"),
        Parameter("vanes", "Vanes"),
        Parameter("vane_width", "Vane width"),
        Parameter("vane_angle_deg", "Vane angle", "°"),
        Parameter("blades", "Blades"),
        Parameter("roundness", "Roundness"),
        Parameter("blade_angle_deg", "Blade angle", "°"),
        Parameter("apodisation", "Apodisation"),
        Parameter("apodisation_power", "Apodisation power"),
        Parameter("cubic_um", "Cubic phase", "µm"),
    )
}


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
