"""Whether a lens file of some format has a line for all that the surfaces of a lens are."""

from p2sf.errors import LensFileError
from p2sf.lens.lens import Lens, Surface
from p2sf.lens.properties import PROPERTIES


def check_endings(lens: Lens, ending: str) -> None:
    """Raise LensFileError for the first property of a surface that a file with this ending cannot express."""
    plain = Surface()
    for number, surface in enumerate(lens.surfaces, 1):
        for each in PROPERTIES:
            value = getattr(surface, each.name)
            if value != getattr(plain, each.name) and ending not in each.endings(value):
                raise LensFileError(
                    "surface {surface}: a file that ends in {ending} cannot express {what}; save as TOML",
                    surface=number,
                    what=each.label,
                    ending=ending,
                )
