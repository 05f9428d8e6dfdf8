"""The lens surface by surface, as its file or an edit has it."""

from dataclasses import dataclass

from p2sf.lens.lens import Lens, Surface
from p2sf.lens.shape_words import kind_of, shape_words
from p2sf.messages import Message
from p2sf_explorer.compute.editing import written
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.setup import prescription

DIFFRACTIVE, IDEAL = Message("diffractive"), Message("ideal lens")
COLUMNS = ("radius", "thickness", "medium", "semi_diameter", "conic", "aspheric")


@dataclass(frozen=True)
class Rows:
    """The lens, its entries as text, one row per surface in the order of ``COLUMNS``, and its stop, 0 if none.

    ``shapes``: of every surface what it is besides a conic with even terms: in a word or two, and with numbers.
    """

    lens: Lens
    texts: tuple[tuple[str, ...], ...]
    stop: int
    edited: bool
    shapes: tuple[tuple[tuple[Message, ...], tuple[Message, ...]], ...] = ()


def rows(live: Live) -> Rows:
    """Return what the table shows: the lens before the focus and f-number controls change it."""
    lens = prescription(live.state)
    texts = tuple(tuple(written(surface, column) for column in COLUMNS) for surface in lens.surfaces)
    shapes = tuple((names(surface), shape_words(surface)) for surface in lens.surfaces)
    return Rows(lens, texts, lens.stop_surface or 0, live.state.optics.lens_text is not None, shapes)


def names(surface: Surface) -> tuple[Message, ...]:
    """Return the names of a surface's shape and of diffraction, where it has them, and of an ideal lens."""
    if surface.ideal:
        return (IDEAL,)
    found = (kind_of(surface.shape),) if surface.shape else ()
    return (*found, DIFFRACTIVE) if surface.diffraction else found
