"""What every file and dataset of PSFs states beside its numbers and what they are of: units, conventions, versions."""

import platform
from typing import Any

import numpy as np

from p2sf.glass.pages import data_version
from p2sf.version import program_version

CONVENTIONS = (
    "unit sum in the window; rows +y up the sensor, row 0 the lowest y, columns +x; a positive field's chief ray "
    "lands at +y; sample N//2 (from 0) is the chief ray; infinite values are null"
)
UNITS = {"x_um": "µm", "y_um": "µm", "psf": "fraction of the window's light per sample"}


def true_of_all() -> dict[str, Any]:
    """Return the units, conventions and versions of PSFs."""
    return {"units": UNITS, "conventions": CONVENTIONS, "versions": versions()}


def versions() -> dict[str, str]:
    """Return the versions that a result depends on."""
    return {
        "p2sf": program_version(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "glass data": data_version(),
    }
