"""Whether a lens file of some format has a line for all that the surfaces of a lens are."""

from dataclasses import replace

from p2sf.errors import LensFileError
from p2sf.lens.lens import Lens, Surface
from p2sf.lens.placement import Placement
from p2sf.lens.properties import CODE_V, PROPERTIES, TOML, ZEMAX
from p2sf.lens.shapes import Shape
from p2sf.messages import Message

CURVED_SENSORS = TOML, ZEMAX, CODE_V


def check_endings(lens: Lens, ending: str) -> None:
    """Raise LensFileError for the first property of a surface or of the sensor that such a file cannot express."""
    if lens.sensor_surface.curvature and ending not in CURVED_SENSORS:
        raise LensFileError(
            "the sensor is curved, which a file that ends in {ending} cannot express; save as TOML", ending=ending
        )
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


def in_own_axes(surface: Surface) -> Surface:
    """Return the same surface with breaks about z in place of the turn of its shape or grating, for files without one.

    Rims turn with the axes and are turned back.
    """
    turn = getattr(surface.diffraction or surface.shape, "turn_deg", 0.0)
    if not turn:
        return surface
    upright = {each.name: each.turned(getattr(surface, each.name), -turn) for each in PROPERTIES}
    into, back = Placement(tilt_z_deg=turn), Placement(tilt_z_deg=-turn)
    return replace(surface, **upright | {"before": (*surface.before, into), "after": (back, *surface.after)})


def check_plain(surface: Surface, what: Message, number: int) -> None:
    """Raise LensFileError for a conic or terms beside a shape or grating whose line in a file has no room for them."""
    alone = replace(surface, shape=None) if surface.shape else surface
    if any(alone.aspheric) or alone.shape or (surface.shape and (alone.curvature or alone.conic or alone.diffraction)):
        raise LensFileError(
            "surface {surface} has a curvature, terms or diffraction beside its {kind}, for which the file has no "
            "line; save as TOML",
            surface=number,
            kind=what,
        )


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
