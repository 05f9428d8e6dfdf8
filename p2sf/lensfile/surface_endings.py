"""Whether a lens file of some format has a line for all that the surfaces of a lens are."""

from p2sf.errors import LensFileError
from p2sf.lens.lens import Lens, Surface
from p2sf.lens.properties import PROPERTIES, TOML
from p2sf.lens.shapes import Shape
from p2sf.messages import Message


def check_endings(lens: Lens, ending: str) -> None:
    """Raise LensFileError for the first property of a surface that a file with this ending cannot express."""
    plain = Surface()
    for number, surface in enumerate(lens.surfaces, 1):
        for each in PROPERTIES:
            value = getattr(surface, each.name)
            if value != getattr(plain, each.name) and ending not in (known := each.endings(value)):
                raise _refusal(number, each.label, ending, TOML in known)


def type_in_file(types: dict[type[Shape], str], shape: Shape, number: int, ending: str) -> str:
    """Return what a file calls a shape of surface ``number``; LensFileError for a class that is not in its table."""
    if type(shape) not in types:
        raise _refusal(number, shape.name, ending, TOML in shape.endings)
    return types[type(shape)]


def _refusal(number: int, what: Message, ending: str, elsewhere: bool) -> LensFileError:
    if not elsewhere:
        return LensFileError(
            "surface {surface}: no lens file can express {what}; leave it out", surface=number, what=what
        )
    return LensFileError(
        "surface {surface}: a file that ends in {ending} cannot express {what}; save as TOML",
        surface=number,
        what=what,
        ending=ending,
    )
