"""The choice of the cheapest that suffices: of methods, fits, samples, wavelengths, nodes and places."""

from collections.abc import Callable, Iterable, Sequence
from math import sqrt
from typing import TypeVar

Candidate = TypeVar("Candidate")
Tries = Sequence[tuple[int, int]]
NEGLIGIBLE = 0.3  # of the largest error of a choice: places with less are not tried again


def first_within(candidates: Iterable[tuple[Candidate, float]], allowed: float) -> tuple[Candidate, float]:
    """Return the first of several candidates whose figure is at most what is allowed, else the last; and its figure.

    ``candidates``: with the error of each, the cheapest first, or with its cost, the best first, at least one. A
    generator works out only those figures that are asked for.
    """
    for found in candidates:
        if found[1] <= allowed:
            break
    return found


def first_allowed(
    sizes: Sequence[float], measure: Callable[[Tries], Sequence[float]], places: int, allowed: float, start: int = 0
) -> tuple[int, float]:
    """Return what `first_within` would of several choices, each tried at all places, with fewer tries.

    ``measure`` gives the errors of (choice, index of a point), which decrease from choice to choice, about as the
    square of 1/``sizes``. By that law the next choice is found from the error of the last one; only measured errors
    decide. The first choice, ``start``, is tried at the first place, where the error is probably largest; what holds
    there is tried at all places, and if not all hold, the next ones where the error was largest, and so on.
    """
    errors: dict[tuple[int, int], float] = {}

    def worst(choice: int, where: Iterable[int]) -> float:
        tries = [(choice, k) for k in where]
        missing = [one for one in tries if one not in errors]
        errors.update(zip(missing, measure(missing) if missing else (), strict=True))
        return max(errors[one] for one in tries)

    last, low, choice = len(sizes) - 1, 0, start
    hardest, likely = 0, list(range(places))
    while True:
        error = worst(choice, [hardest])
        enough = sizes[choice] * sqrt(error / allowed)
        by_law = max(low, next((k for k, size in enumerate(sizes) if size >= enough), last))
        if error > allowed and choice < last:
            low = choice + 1
            choice = max(by_law, low)
        elif by_law < choice:
            choice = by_law
        else:
            error = worst(choice, likely)
            if error <= allowed or choice == last:
                return choice, error
            hardest = max(likely, key=lambda k: errors[choice, k])
            likely = [k for k in likely if errors[choice, k] >= NEGLIGIBLE * error]
