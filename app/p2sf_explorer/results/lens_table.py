"""The lens surface by surface, as its file or an edit has it."""

from dataclasses import dataclass

from p2sf.lens.lens import Lens
from p2sf_explorer.compute.editing import written
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.setup import prescription

COLUMNS = ("radius", "thickness", "medium", "semi_diameter", "conic", "aspheric")


@dataclass(frozen=True)
class Rows:
    """The lens, its entries as text, one row per surface in the order of ``COLUMNS``, and its stop, 0 if none."""

    lens: Lens
    texts: tuple[tuple[str, ...], ...]
    stop: int
    edited: bool


def rows(live: Live) -> Rows:
    """Return what the table shows: the lens before the focus and f-number controls change it."""
    lens = prescription(live.state)
    texts = tuple(tuple(written(surface, column) for column in COLUMNS) for surface in lens.surfaces)
    return Rows(lens, texts, lens.stop_surface or 0, live.state.optics.lens_text is not None)
