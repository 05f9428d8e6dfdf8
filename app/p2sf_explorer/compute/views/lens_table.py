"""The lens surface by surface, as its file or an edit has it, and what of its build is off."""

from dataclasses import dataclass
from math import isfinite
from typing import NamedTuple

from p2sf.conventions import UM_PER_MM
from p2sf.lens.lens import Lens
from p2sf.lens.properties import short_words_of, words_of
from p2sf.messages import Message
from p2sf_explorer.compute.editing import cell_text
from p2sf_explorer.compute.glass_outlines import clear_rims, still
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.setup import prescription
from p2sf_explorer.state.build_errors import BuildErrors
from p2sf_explorer.state.built import Adjustment, Piece, adjustments, pieces
from p2sf_explorer.state.state import State

FRINGE_UM = 0.54607 / 2  # between fringes of a test plate in the green line of mercury
COLUMNS = ("radius", "thickness", "medium", "semi_diameter", "conic", "aspheric")


class CellNote(NamedTuple):
    """What a surface has that no number of a column shows, such as a shape: in a word or two, and with numbers."""

    short: tuple[Message, ...]
    words: tuple[Message, ...]


@dataclass(frozen=True)
class Rows:
    """The lens, its entries as text, one row per surface in the order of ``COLUMNS``, and its stop, 0 if none.

    ``beside``: of every surface what a column says beside its number.
    """

    lens: Lens
    texts: tuple[tuple[str, ...], ...]
    stop: int
    edited: bool
    beside: tuple[dict[str, CellNote], ...] = ()


def rows(live: Live) -> View[Rows]:
    """Return what the table shows: the lens before the focus and f-number controls change it."""
    lens = prescription(live.state)
    texts = tuple(tuple(cell_text(surface, column) for column in COLUMNS) for surface in lens.surfaces)
    beside = tuple(
        {column: CellNote(short_words_of(surface, column), words_of(surface, column)) for column in COLUMNS}
        for surface in lens.surfaces
    )
    return View(Rows(lens, texts, lens.stop_surface or 0, live.state.optics.lens_text is not None, beside))


@dataclass(frozen=True)
class Misalignment:
    """The lens without the errors of its build, its pieces, and the errors; ``file_tilted``: its file has tilts too."""

    lens: Lens
    pieces: tuple[Piece, ...]
    errors: BuildErrors
    file_tilted: bool
    show_field_x: bool


def misalignment(live: Live) -> View[Misalignment]:
    """Return what the panel of sliders shows."""
    return View(misalignment_of(live.state))


def misalignment_of(state: State) -> Misalignment:
    """Return what the panel of sliders shows for a state, which need not have a picture."""
    lens = prescription(state)
    errors, field_x = state.optics.errors, state.display.show_field_x
    return Misalignment(lens, pieces(lens), errors, lens.misaligned, field_x)


def of_piece(lens: Lens, piece: Piece) -> tuple[Adjustment, ...]:
    """Return what of a piece may be off: of groups their place alone, else every table would be as long as the lens."""
    single = not any(other is not piece and _holds(piece, other) for other in pieces(lens))
    found = adjustments(lens, piece.span)
    return found if single else tuple(one for one in found if one.span == piece.span)


def _holds(piece: Piece, other: Piece) -> bool:
    return piece.span[0] <= other.span[0] and other.span[1] <= piece.span[1]


def fringes(lens: Lens, surface: int, percent: float) -> float | None:
    """Return how many fringes a test plate of the right radius shows on a surface; None for a plane.

    Half a wave of sag at the clear rim is one: N = 2Δs/λ with Δs = (r²/2)·Δ(1/R), to second order in r.
    """
    radius, rim = lens.surfaces[surface - 1].radius, clear_rims(still(lens))[surface - 1]
    if not isfinite(radius):
        return None
    sag_mm = rim**2 / 2 * abs(1 / (radius * (1 + percent / 100)) - 1 / radius)
    return UM_PER_MM * sag_mm / FRINGE_UM
