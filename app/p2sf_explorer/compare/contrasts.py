"""In what A and B differ, in words. No Qt in here."""

from collections.abc import Callable
from math import isclose

from p2sf_explorer.compute.quantities import QUANTITIES
from p2sf_explorer.compute.setup import prescription, ranges, title
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.state import State
from p2sf_explorer.state.what_if import UNTOUCHED, is_altered

LINK_WORDS = {quantity.key: quantity.title for quantity in QUANTITIES}
SAME = 1e-9  # relative: below, two values differ by rounding
OTHERS = (
    ("method", "Method", str),
    ("tolerance", "Tolerance", lambda value: f"R² ≥ {value:g}"),
    ("stop", "Stop", lambda value: tr("as in the file" if value == "file" else "found")),
    ("clip", "Clip at rims", lambda value: tr("on") if value else tr("off")),
)
LINK_WORDS |= {"method": "Method", "added_waves": "Added waves"}


def contrasts(state: State) -> tuple[tuple[str, str, str], ...]:
    """Return (name, A, B) of everything in which A and the pinned B differ."""
    a, b = state, state.pinned
    found = [("Lens", lens_words(a), lens_words(b))] if (a.lens, a.lens_text) != (b.lens, b.lens_text) else []
    limits = [ranges(prescription(side)) for side in (a, b)]
    for quantity in QUANTITIES:
        values = [quantity.shown(side, limit) for side, limit in zip((a, b), limits, strict=True)]
        if not isclose(*values, rel_tol=SAME):
            found.append((quantity.title, *distinct(quantity.write, *values)))
    for name, title_of_it, words in OTHERS:
        sides = [getattr(side, name) for side in (a, b)]
        found += [(title_of_it, *map(words, sides))] if sides[0] != sides[1] else []
    if any(getattr(a, name) != getattr(b, name) for name in UNTOUCHED):
        found.append(("Coefficients", coefficient_words(a), coefficient_words(b)))
    return tuple(found)


def distinct(write: Callable[[float], str], first: float, second: float) -> tuple[str, str]:
    """Return how two values are written, with more digits where the usual ones hide what differs."""
    words = write(first), write(second)
    return words if words[0] != words[1] else (f"{first:.9g}", f"{second:.9g}")


def lens_words(state: State) -> str:
    """Return how a lens is named."""
    return tr(title(state.lens)) + ("" if state.lens_text is None else f" ({tr('edited')})")


def coefficient_words(state: State) -> str:
    """Return whose the coefficients are."""
    if state.free_pupil:
        return tr("free pupil")
    return tr("by hand") if is_altered(state) else tr("the lens's own")
