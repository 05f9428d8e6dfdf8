"""Manufacturing errors of a lens as plain numbers of a state. Uses no Qt."""

from math import isfinite

from p2sf.errors import P2SFError
from p2sf.tolerance.errors_of_build import IRREGULAR, MOVES, UNITS, Kind

BuildError = tuple[Kind, int, int, float]
"""Kind, as `p2sf.tolerance.Tolerance` has it, first and last surface from 1, and amount in the unit of the kind.

A first surface behind the last of the lens is the sensor.
"""
BuildErrors = tuple[BuildError, ...]
Compensator = tuple[Kind, int, int]  # kind, first and last surface of a compensator
MOST_ERRORS, MOST_SURFACES = 1000, 1000
KINDS: tuple[Kind, ...] = tuple(UNITS)
# Beyond these no lens could be called built; a sentence about the surface says where less is too much.
LARGEST: dict[Kind, float] = {
    **dict.fromkeys(("decentre_x", "decentre_y"), 1000.0),
    **dict.fromkeys(("tilt_x", "tilt_y"), 360.0),
    "radius": 99.0,
    "thickness": 1e5,  # a telescope refocused by metres is still a telescope
    "index": 1.0,
    **dict.fromkeys(IRREGULAR, 1000.0),
}


def check_errors(found: object) -> None:
    """Raise P2SFError for invalid manufacturing errors."""
    if not isinstance(found, tuple) or len(found) > MOST_ERRORS:
        raise P2SFError(
            "errors is {value}; give a list of kind, first and last surface, and amount", value=f"{found!r:.60}"
        )
    for one in found:
        _check(one)


def _check(found: object) -> None:
    if not (isinstance(found, tuple) and len(found) == 4 and found[0] in KINDS):
        raise P2SFError(
            "an error of the build is {value}; give kind, first and last surface, and amount; kinds are {kinds}",
            value=f"{found!r:.60}",
            kinds=KINDS,
        )
    kind, first, last, amount = found
    whole = all(type(number) is int for number in (first, last))
    if not (whole and 1 <= first <= last <= MOST_SURFACES):
        raise P2SFError(
            "an error of the build is at surfaces {value}; give the first and the last, counted from 1",
            value=f"{first!r:.20}, {last!r:.20}",
        )
    limit, plain = LARGEST[kind], isinstance(amount, int | float) and not isinstance(amount, bool)
    if not (plain and isfinite(amount) and abs(amount) <= limit):
        raise P2SFError(
            "{kind} of surface {surface} is off by {value}; give a number from {low:g} to {high:g}{unit}",
            kind=kind,
            surface=first,
            value=f"{amount!r:.20}",
            low=-limit,
            high=limit,
            unit=f" {UNITS[kind]}".rstrip(),
        )


def amount_of(errors: BuildErrors, kind: Kind, piece: tuple[int, int]) -> float:
    """Return one error of a piece; 0 if it has none."""
    return next((amount for name, *at, amount in errors if name == kind and (at[0], at[1]) == piece), 0.0)


def with_error(errors: BuildErrors, kind: Kind, piece: tuple[int, int], amount: float) -> BuildErrors:
    """Return the errors with one of a piece set, 0 for none; in a fixed order, so that equal sets compare equal."""
    kept = [one for one in errors if one[:3] != (kind, *piece)]
    return order_errors((*kept, (kind, *piece, amount)) if amount else kept)


def without_piece(errors: BuildErrors, piece: tuple[int, int]) -> BuildErrors:
    """Return the errors without those of a piece and of the surfaces, thicknesses and glasses in it."""
    first, last = piece

    def of_it(kind: Kind, low: int, high: int) -> bool:
        return (low, high) == piece or (kind not in MOVES and first <= low and high <= last)

    return tuple(one for one in errors if not of_it(*one[:3]))


def order_errors(errors: list[BuildError] | BuildErrors) -> BuildErrors:
    """Return errors with those of small pieces first: larger pieces are moved with the smaller ones in them."""
    return tuple(sorted(errors, key=lambda one: (one[2] - one[1], one[1], KINDS.index(one[0]))))


def renumber(errors: BuildErrors, at: int, by: int) -> BuildErrors:
    """Return the errors after a surface was inserted behind surface ``at`` (``by`` 1) or surface ``at`` deleted (−1).

    Errors of only the deleted surface are dropped.
    """
    if by > 0:
        return tuple((k, a + (a > at), b + (b > at), x) for k, a, b, x in errors)
    kept = (one for one in errors if one[1:3] != (at, at))
    return order_errors([(k, a - (a > at), b - (b >= at), x) for k, a, b, x in kept])
