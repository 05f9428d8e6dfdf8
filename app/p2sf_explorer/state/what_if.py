"""What-if changes of the coefficients: waves added by hand, terms muted or soloed, a pupil without a lens. No Qt."""

from dataclasses import dataclass, replace
from typing import Any

from p2sf.errors import GeometryError
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients
from p2sf_explorer.state.scales import with_sign
from p2sf_explorer.state.state import State, WhatIf
from p2sf_explorer.state.terms import NAMES, TERMS

NOTE = "what-if: coefficients altered by hand"
NO_REFERENCE = (
    "what-if: coefficients altered by hand, so the lens's Huygens reference does not apply; reset them to measure again"
)
UNTOUCHED: dict[str, Any] = {"added_waves": (0.0,) * len(TERMS), "muted": (), "solo": (), "free_pupil": False}


@dataclass(frozen=True)
class Preset:
    """A textbook wavefront: its name, what it shows, and the waves of its terms."""

    title: str
    shows: str
    waves: dict[str, float]


# Balancing after Mahajan 1991, tables 2-1 and 3-1 (best focus Wd = −W40, medial focus Wd = −W22/2).
PRESETS = (
    Preset("No aberration", "the Airy pattern", {}),
    Preset("Defocus, 1 λ", "a dark centre: Wd of a whole wave cancels on the axis", {"wd": 1.0}),
    Preset("Spherical, 1 λ, paraxial focus", "a sharp core in a wide halo", {"w40": 1.0}),
    Preset("Spherical, 1 λ, best focus", "Wd = −W40 leaves a sixteenth of the variance", {"w40": 1.0, "wd": -1.0}),
    Preset("Spherical, 1 λ, marginal focus", "Wd = −2 W40: rim rays meet on the axis", {"w40": 1.0, "wd": -2.0}),
    Preset("Coma, ½ λ", "one-sided rings and a moved peak", {"w31": 0.5}),
    Preset("Coma, 3 λ", "the comet: rays fill a cone of 60°", {"w31": 3.0}),
    Preset("Astigmatism, 1 λ, medial focus", "Wd = −W22/2: a cross", {"w22": 1.0, "wd": -0.5}),
    Preset("Astigmatism, 2 λ, sagittal focus", "Wd = 0: a line towards the field", {"w22": 2.0}),
    Preset("Astigmatism, 2 λ, tangential focus", "Wd = −W22: a line across the field", {"w22": 2.0, "wd": -2.0}),
    Preset("All at once", "what no single term shows", {"w40": 0.5, "w31": 1.0, "w22": 0.7, "wd": -0.6}),
)


def is_altered(state: State) -> bool:
    """Return whether any coefficient differs from that of the lens."""
    return state.what_if != WhatIf()


def is_heard(state: State, term: str) -> bool:
    """Return whether a term counts: not muted, and among the solo terms if there are any."""
    return term not in state.what_if.muted and (not state.what_if.solo or term in state.what_if.solo)


def alter(own: Coefficients, state: State) -> Coefficients:
    """Return the altered coefficients of the lens's ``own``: own + added if the term counts, else 0."""
    if not is_altered(state):
        return own
    added = dict(zip(TERMS, state.what_if.added_waves, strict=True))
    free = state.what_if.free_pupil
    made: dict[str, Any] = {t: (0.0 if free else getattr(own, t)) + added[t] for t in TERMS}
    return replace(own, **{t: value * is_heard(state, t) for t, value in made.items()})


def with_added(state: State, term: str, waves: float) -> tuple[float, ...]:
    """Return the added waves with one term changed."""
    return tuple(waves if name == term else old for name, old in zip(TERMS, state.what_if.added_waves, strict=True))


def toggle(names: tuple[str, ...], term: str) -> tuple[str, ...]:
    """Return the names with one put in or taken out, in the order of `TERMS`."""
    return tuple(name for name in TERMS if (name in names) != (name == term))


def alterations(state: State) -> tuple[Message, ...]:
    """Return the manual changes, one short message each, the most relevant first."""
    made = state.what_if
    added = zip(TERMS, made.added_waves, strict=True)
    return (
        *(Message("{term} {waves} λ", term=NAMES[t], waves=written_waves(w)) for t, w in added if w),
        *(Message("{term} muted", term=NAMES[term]) for term in made.muted),
        *(Message("{term} solo", term=NAMES[term]) for term in made.solo),
        *((Message("free pupil"),) if made.free_pupil else ()),
    )


def written_waves(value: float) -> str:
    """Return added waves with their sign, as short as they tell the value."""
    return ("+" if value > 0 else "") + with_sign(value, 2 if abs(value) < 10 else 1)


def of_preset(preset: Preset) -> dict[str, Any]:
    """Return the entries of the State that show a preset."""
    return UNTOUCHED | {"added_waves": tuple(preset.waves.get(term, 0.0) for term in TERMS), "free_pupil": True}


def check_focusable(state: State) -> None:
    """Raise GeometryError if moving the sensor does not change the wavefront, since Wd is not that of the lens."""
    if state.what_if.free_pupil or not is_heard(state, "wd"):
        raise GeometryError(
            "{why}, so moving the sensor does not focus; set Wd by its slider, or reset the what-if",
            why=Message("the free pupil has no lens") if state.what_if.free_pupil else Message("Wd is muted"),
        )
