"""Claims of a lesson: a named measure of the window's state, compared with a number. No Qt in here.

``strehl is 0.8 ± 0.02``, ``w40_waves [f_number 6] below 0.5``, ``w31_waves [f_number 3] / [f_number 6] is 8 ± 0.01``,
``w31_waves within ± 0.1``; of a slider also ``field_deg is 10``.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from math import inf

from p2sf.errors import P2SFError
from p2sf_explorer.compute.quantities import QUANTITIES, Quantity
from p2sf_explorer.compute.setup import state_ranges
from p2sf_explorer.lessons.changes import Changes, apply_changes
from p2sf_explorer.state.state import State

NUMBER = r"[-−+]?(?:\d[\d.]*(?:e[-+]?\d+)?|inf)"
LEFT = r"(?P<measure>\w+)(?:\s*+\[(?P<first>[^]]*)\])?(?:\s*+(?P<how>[/−-])\s*+\[(?P<second>[^]]*)\])?"
FORM = re.compile(
    rf"{LEFT}\s++(?:(?P<relation>is|above|below)\s++(?P<number>{NUMBER})|within)(?:\s*+±\s*+(?P<tolerance>{NUMBER}))?"
)
EXAMPLE = "airy_radius_um [f_number 6] / [f_number 3] is 2 ± 0.001"
SLIDER_SHARE = 0.01  # of a slider's value, or of one unit: as near as a hand sets it


@dataclass(frozen=True)
class Claim:
    """A measure at the step's state changed by ``first``, over or minus the one at ``second`` where ``how`` says so.

    ``relation`` is "is" (within ``tolerance``), "above" or "below".
    """

    text: str
    measure: str
    first: Changes
    how: str
    second: Changes
    relation: str
    number: float
    tolerance: float


def parse_claim(text: str, changes: Callable[[str], Changes]) -> Claim:
    """Return the claim of a line; ``changes`` reads the text in brackets. P2SFError for a line that is no claim."""
    found = FORM.fullmatch(text.strip())
    if not found:
        raise P2SFError('"{text}" is not a claim; write one such as {example}', text=text, example=EXAMPLE)
    tolerance = found["tolerance"]
    if found["relation"] == "is" and found["measure"] in SLIDERS_BY_KEY:
        tolerance = tolerance or str(SLIDER_SHARE * max(1.0, min(abs(_number(found["number"])), 1e9)))
    if (found["relation"] in ("is", None)) != (tolerance is not None):
        raise P2SFError('"{text}": "is" needs a tolerance such as ± 0.01, and "above" and "below" take none', text=text)
    relation, number = found["relation"] or "is", _number(found["number"] or "0")
    left = _measure_of(found, changes)
    return Claim(text.strip(), *left, relation, number, _number(tolerance or "0"))


def parse_measure(text: str, changes: Callable[[str], Changes]) -> Claim:
    """Return what a line measures, as a claim that any value fulfils; P2SFError where the measure is unknown."""
    found = re.fullmatch(LEFT, text.strip())
    if not found:
        raise P2SFError('"{text}" is not a claim; write one such as {example}', text=text, example=EXAMPLE)
    return Claim(text.strip(), *_measure_of(found, changes), "above", -inf, 0.0)


def _measure_of(found: re.Match[str], changes: Callable[[str], Changes]) -> tuple[str, Changes, str, Changes]:
    """Return measure, first changes, how and second changes."""
    find_measure(found["measure"])
    how = {"/": "/", "-": "-", "−": "-", None: ""}[found["how"]]
    first, second = (changes(found[name] or "") for name in ("first", "second"))
    return found["measure"], first, how, second


SLIDERS_BY_KEY: dict[str, Quantity] = {quantity.key: quantity for quantity in QUANTITIES}


def find_measure(name: str) -> Callable[[State], float]:
    """Return the measure, or the value of the slider, of this name; P2SFError where there is none."""
    from p2sf_explorer.lessons.measures import MEASURES

    if slider := SLIDERS_BY_KEY.get(name):
        return lambda state: float(slider.shown(state, state_ranges(state)))
    if name not in MEASURES:
        raise P2SFError(
            'measure "{measure}" is unknown; choose one of {choices}', measure=name, choices=tuple(MEASURES)
        )
    return MEASURES[name]


def _number(text: str) -> float:
    try:
        return float(text.replace("−", "-"))
    except ValueError:
        raise P2SFError('"{text}" in a claim is not a number; write one such as 0.25 or 1e-3', text=text) from None


def measure_claim(claim: Claim, state: State) -> float:
    """Return the value of a claim's left side at a state; P2SFError where it cannot be measured."""
    measure = find_measure(claim.measure)
    value = measure(apply_changes(state, claim.first))
    if not claim.how:
        return value
    other = measure(apply_changes(state, claim.second))
    return value / other if claim.how == "/" else value - other


def holds(claim: Claim, value: float) -> bool:
    """Return whether a measured value fulfils the claim."""
    if claim.relation == "is":
        return value == claim.number or abs(value - claim.number) <= claim.tolerance  # ∞ is ∞
    return value > claim.number if claim.relation == "above" else value < claim.number
