"""The cards of the lens gallery: title, first-order figures, one line of character, a drawing. No Qt in here."""

from dataclasses import dataclass
from functools import lru_cache
from math import isfinite, isinf

from p2sf.conventions import slope_from_degrees
from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens
from p2sf.lens.meridians import meridians
from p2sf.lens.source import Source
from p2sf.paraxial.first_order import cardinal_points
from p2sf.paraxial.pupils import f_number, find_stop
from p2sf_explorer.compute.layout import Drawing, drawing
from p2sf_explorer.compute.lens_files import stamp
from p2sf_explorer.compute.setup import default_state, load, prescription, title
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


FILTERS = {
    "coma": "Shows coma",
    "zoom": "Zooms",
    "mirror": "Mirrors",
    "telephoto": "Telephoto",
    "phone": "Phone",
}
"""Tags of lenses by which the gallery is filtered, and their names."""
FIELD_PARTS = (0.25, 0.5, 0.75, 1.0)  # of the widest field, where coma is looked for
EVIDENT = 0.5  # of the largest other aberration
VISIBLE = 1 / 14  # waves RMS: Maréchal's limit
SHORT_MM, ASPHERES = 8.0, 4  # a lens of a phone is shorter, and has at least as many aspheric surfaces


@lru_cache(maxsize=64)
def lens_tags(name: str) -> frozenset[str]:
    """Return the tags of `FILTERS` that a lens has; none for one that cannot be read."""
    try:
        lens = load(name)
        focal = float(cardinal_points(meridians(lens).y, lens.reference_wavelength_um).effective_focal_length)
        track = lens.vertices[-1]
        mirrors = any(surface.reflects for surface in lens.surfaces)
        aspheres = sum(1 for surface in lens.surfaces if surface.radial_parts)
        found = {
            "coma": shows_coma(lens),
            "zoom": lens.positions is not None and lens.positions.axis("zoom") is not None,
            "mirror": mirrors,
            "telephoto": not mirrors
            and isfinite(focal)
            and isinf(default_state(name).optics.depth_mm)
            and 0 < track < focal,
            "phone": 0 < track < SHORT_MM and aspheres >= ASPHERES,
        }
    except P2SFError:
        return frozenset()
    return frozenset(tag for tag, has in found.items() if has)


def shows_coma(lens: Lens) -> bool:
    """Return whether at some field coma is visible and more than half of any other aberration, by RMS of exact rays.

    Defocus does not count.
    """
    from p2sf.pupil.zernike_fit import zernike_fit

    depth, wave = default_state(lens.name).optics.depth_mm, lens.reference_wavelength_um
    for part in FIELD_PARTS:
        source = Source(depth, float(slope_from_degrees(part * lens.widest_field_deg)), wave)
        found = zernike_fit(lens, source)
        square: dict[int, float] = {}
        for term, rms in zip(found.terms, found.rms_waves.tolist(), strict=True):
            if term.n > 2 or abs(term.m) == 2:
                square[abs(term.m)] = square.get(abs(term.m), 0.0) + rms**2
        coma = square.pop(1, 0.0)
        if coma > VISIBLE**2 and coma > EVIDENT**2 * max(square.values(), default=0.0):
            return True
    return False


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
    """Return focal length, f-number and half field in one line, the former in y × in x where the meridians differ."""
    wavelength, (along_y, along_x) = lens.reference_wavelength_um, meridians(lens)
    parts, seen = [], (along_y,) if along_x == along_y else (along_y, along_x)
    focal = [float(cardinal_points(each, wavelength).effective_focal_length) for each in seen]
    speed = [float(f_number(each, wavelength)) for each in seen]
    parts.append(f"f′ {' × '.join(map(_length, focal))} mm" if any(map(isfinite, focal)) else "afocal")
    if any(map(isfinite, speed)):
        parts.append(" × ".join(f"f/{each:.2g}" if isfinite(each) else "∞" for each in speed))
    return " · ".join([*parts, f"±{lens.widest_field_deg:.3g}°"])


def _length(mm: float) -> str:
    return significant(mm, 3) if isfinite(mm) else "∞"
