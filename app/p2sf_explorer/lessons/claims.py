"""Claims of a lesson: a named measure of the window's state, compared with a number. No Qt in here.

``strehl is 0.8 ± 0.02``, ``w40_waves [f_number 6] below 0.5``, ``w31_waves [f_number 3] / [f_number 6] is 8 ± 0.01``.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass

from p2sf.errors import P2SFError
from p2sf_explorer.lessons.changes import Changes, apply_changes
from p2sf_explorer.state.state import State

NUMBER = r"[-−+]?\d[\d.]*(?:e[-+]?\d+)?"
FORM = re.compile(
    rf"(?P<measure>\w+)(?:\s*\[(?P<first>[^]]*)\])?(?:\s*(?P<how>[/−-])\s*\[(?P<second>[^]]*)\])?"
    rf"\s+(?P<relation>is|above|below)\s+(?P<number>{NUMBER})(?:\s*±\s*(?P<tolerance>{NUMBER}))?"
)
EXAMPLE = "airy_radius_um [f_number 6] / [f_number 3] is 2 ± 0.001"


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
    from p2sf_explorer.lessons.measures import MEASURES

    found = FORM.fullmatch(text.strip())
    if not found:
        raise P2SFError('"{text}" is not a claim; write one such as {example}', text=text, example=EXAMPLE)
    if found["measure"] not in MEASURES:
        raise P2SFError(
            'measure "{measure}" is unknown; choose one of {choices}', measure=found["measure"], choices=tuple(MEASURES)
        )
    if (found["relation"] == "is") != (found["tolerance"] is not None):
        raise P2SFError('"{text}": "is" needs a tolerance such as ± 0.01, and "above" and "below" take none', text=text)
    how = {"/": "/", "-": "-", "−": "-", None: ""}[found["how"]]
    first, second = (changes(found[name] or "") for name in ("first", "second"))
    number, tolerance = _number(found["number"]), _number(found["tolerance"] or "0")
    return Claim(text.strip(), found["measure"], first, how, second, found["relation"], number, tolerance)


def _number(text: str) -> float:
    try:
        return float(text.replace("−", "-"))
    except ValueError:
        raise P2SFError('"{text}" in a claim is not a number; write one such as 0.25 or 1e-3', text=text) from None


def measure_claim(claim: Claim, state: State) -> float:
    """Return the value of a claim's left side at a state; P2SFError where it cannot be measured."""
    from p2sf_explorer.lessons.measures import MEASURES

    measure = MEASURES[claim.measure]
    value = measure(apply_changes(state, claim.first))
    if not claim.how:
        return value
    other = measure(apply_changes(state, claim.second))
    return value / other if claim.how == "/" else value - other


def holds(claim: Claim, value: float) -> bool:
    """Return whether a measured value fulfils the claim."""
    if claim.relation == "is":
        return abs(value - claim.number) <= claim.tolerance
    return value > claim.number if claim.relation == "above" else value < claim.number
