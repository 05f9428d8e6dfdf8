"""The settings that differ between A and B. No Qt in here."""

from collections.abc import Callable
from functools import partial
from math import isclose
from typing import Any

from p2sf.messages import Message, Number
from p2sf_explorer.compute.quantities import BEYOND, QUANTITIES
from p2sf_explorer.compute.setup import prescription, ranges, title
from p2sf_explorer.state.state import State, entry
from p2sf_explorer.state.what_if import is_altered

LINK_WORDS = {quantity.key: quantity.title for quantity in QUANTITIES}
LINK_WORDS |= {"method": "Method", "added_waves": "Added waves", "errors": "Misalignment"}
AIM_WORDS = {"stop": "the real stop", "paraxial": "the paraxial pupil"}
SAME = 1e-9  # relative: below, two values differ by rounding
OTHERS: tuple[tuple[str, str, Callable[[Any], Message]], ...] = (
    ("method", "Method", Message),
    ("tolerance", "Tolerance", lambda value: Message("R² ≥ {value:g}", value=value)),
    ("stop", "Stop", lambda value: Message("as in the file") if value == "file" else Message("found")),
    ("aim", "Rays fill", lambda value: Message(AIM_WORDS[value])),
    ("clip", "Clip at rims", lambda value: Message("on") if value else Message("off")),
)

Contrast = tuple[str, Message, Message]
"""The English name of what differs, and its values for A and for B."""


def contrasts(state: State) -> tuple[Contrast, ...]:
    """Return everything in which A and the pinned B differ; nothing without a B."""
    a, b = state, state.compare.pinned
    if b is None:
        return ()
    found: list[Contrast] = []
    if (a.optics.lens, a.optics.lens_text) != (b.optics.lens, b.optics.lens_text):
        found.append(("Lens", lens_name(a), lens_name(b)))
    limits = [ranges(prescription(side)) for side in (a, b)]
    for quantity in QUANTITIES:
        first, second = (quantity.shown(side, limit) for side, limit in zip((a, b), limits, strict=True))
        if not isclose(first, second, rel_tol=SAME):
            found.append((quantity.title, *distinct(partial(quantity.text, ranges=limits[0]), first, second)))
    for name, label, described in OTHERS:
        mine, other = entry(a, name), entry(b, name)
        if mine != other:
            found.append((label, described(mine), described(other)))
    if a.optics.errors != b.optics.errors:
        found.append(("Misalignment", errors_of(a), errors_of(b)))
    if a.what_if != b.what_if:
        found.append(("Coefficients", coefficients_of(a), coefficients_of(b)))
    return tuple(found)


def distinct(write: Callable[[float], str], first: float, second: float) -> tuple[Message, Message]:
    """Return how two values are written, with more digits where the usual ones hide what differs."""
    a, b = write(first), write(second)
    return (
        (value_message(a), value_message(b))
        if a != b
        else (value_message(f"{first:.9g}"), value_message(f"{second:.9g}"))
    )


def value_message(value: str) -> Message:
    """Return a value as a control writes it."""
    return Message(BEYOND) if value == BEYOND else Message("{value}", value=Number(value))


def lens_name(state: State) -> Message:
    """Return how a lens is named."""
    name = Message(title(state.optics.lens))
    return name if state.optics.lens_text is None else Message("{lens} ({note})", lens=name, note=Message("edited"))


def errors_of(state: State) -> Message:
    """Return how many numbers of the build are off."""
    count = len(state.optics.errors)
    return Message("{count} errors of the build", count=count) if count else Message("none")


def coefficients_of(state: State) -> Message:
    """Return whose the coefficients are."""
    if state.what_if.free_pupil:
        return Message("free pupil")
    return Message("by hand") if is_altered(state) else Message("the lens's own")
