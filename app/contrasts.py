"""In what A and B differ, in words. No Qt in here."""

from app.quantities import QUANTITIES
from app.setting import prescription, ranges, title
from app.state import State
from app.whatif import UNTOUCHED, is_altered
from app.words import tr

LINK_WORDS = {quantity.key: quantity.title for quantity in QUANTITIES}
LINK_WORDS |= {"method": "Method", "added_waves": "Added waves"}


def contrasts(state: State) -> tuple[tuple[str, str, str], ...]:
    """Return (name, A, B) of everything in which A and the pinned B differ."""
    a, b = state, state.pinned
    found = [("Lens", lens_words(a), lens_words(b))] if (a.lens, a.lens_text) != (b.lens, b.lens_text) else []
    limits = [ranges(prescription(side)) for side in (a, b)]
    for quantity in QUANTITIES:
        words = [quantity.write(quantity.shown(side, limit)) for side, limit in zip((a, b), limits, strict=True)]
        if words[0] != words[1]:
            found.append((quantity.title, *words))
    found += [("Method", a.method, b.method)] if a.method != b.method else []
    if any(getattr(a, name) != getattr(b, name) for name in UNTOUCHED):
        found.append(("Coefficients", coefficient_words(a), coefficient_words(b)))
    return tuple(found)


def lens_words(state: State) -> str:
    """Return how a lens is named."""
    return tr(title(state.lens)) + ("" if state.lens_text is None else f" ({tr('edited')})")


def coefficient_words(state: State) -> str:
    """Return whose the coefficients are."""
    if state.free_pupil:
        return tr("free pupil")
    return tr("by hand") if is_altered(state) else tr("the lens's own")
