"""What a person may set, each named once: its Python name, its flag on the command line, its control in a window."""

from dataclasses import dataclass


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
        Parameter("focus_mm", "Focus distance", "mm"),
        Parameter("sensor_shift_um", "Sensor shift", "µm"),
        Parameter("field_deg", "Field", "°"),
        Parameter("object_height_mm", "the object height", "mm"),
        Parameter("image_height_mm", "the image height", "mm"),
        Parameter("wavelength_nm", "Wavelength", "nm"),
        Parameter("f_number", "f-number"),
        Parameter("stop", "Stop"),
        Parameter("method", "Method"),
        Parameter("tolerance", "the tolerance"),
        Parameter("clip", "Clip at rims"),
    )
}


def flag(name: str) -> str:
    """Return the option of the command line that sets a parameter: ``--field-deg`` for ``field_deg``."""
    return f"--{name.replace('_', '-')}"


def control(name: str) -> str:
    """Return the English name of the control that sets a parameter; of one without a control its own, in words."""
    found = PARAMETERS.get(name)
    return found.control if found else name.replace("_", " ")
