"""The cards of the lens gallery: title, first-order figures, one line of character, a drawing. No Qt in here."""

from dataclasses import dataclass
from functools import lru_cache
from math import isfinite

from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import f_number, find_stop
from p2sf_explorer.compute.layout import Drawing, drawing
from p2sf_explorer.compute.lens_files import stamp
from p2sf_explorer.compute.setup import load, prescription, title
from p2sf_explorer.state.scales import significant
from p2sf_explorer.state.state import State, new_state


@dataclass(frozen=True, eq=False)
class LensCard:
    """One lens of the gallery; ``drawing`` is None where the lens cannot be drawn, and ``problem`` then says why."""

    name: str
    title: str
    facts: str
    character: str
    problem: P2SFError | None = None
    drawing: Drawing | None = None


@lru_cache(maxsize=64)
def lens_card(name: str) -> LensCard:
    """Return the card of a lens, with the ``problem`` of one that cannot be read."""
    try:
        lens = load(name)
        stop = find_stop(lens)
        drawn = drawing(lens, float(stop.surface), float(stop.semi_diameter))
        return LensCard(name, lens.title or lens.name, facts(lens), lens.character, drawing=drawn)
    except P2SFError as error:
        return LensCard(name, title(name), "", "", error)


def shown_title(state: State) -> str:
    """Return the title of the state's lens for the top bar, cached since every frame asks for it."""
    return _shown_title(state.optics.lens, state.optics.lens_text, stamp(state.optics.lens))


@lru_cache(maxsize=128)
def _shown_title(name: str, lens_text: str | None, _stamp: tuple[int, int]) -> str:
    """Return a lens's title, without looking up the glasses of a shipped one."""
    found = title(name)
    if lens_text is None and found != name:
        return found
    try:
        lens = prescription(new_state(lens=name, lens_text=lens_text))
    except P2SFError:  # the picture on show is of an earlier lens; the banner says why
        return found
    return lens.title or lens.name


def facts(lens: Lens) -> str:
    """Return focal length, f-number and half field in one line."""
    wavelength = lens.reference_wavelength_um
    focal = float(cardinal_points(lens, wavelength).effective_focal_length)
    speed = float(f_number(lens, wavelength))
    widest = lens.widest_field_deg
    parts = [f"f′ {significant(focal, 3)} mm" if isfinite(focal) else "afocal"]
    if isfinite(speed):
        parts.append(f"f/{speed:.2g}")
    return " · ".join([*parts, f"±{widest:.3g}°"])
