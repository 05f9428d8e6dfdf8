"""Largest radii at which rays pass, from few rays: the clearance at a rim is a smooth function with a root."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

BISECTIONS = 36  # the outer radius to 2e-11
GUESSED = 5e-4  # of the outer radius
PATIENCE = 18  # steps after which brackets are halved, since rounding may make interpolation steps short

Clearance: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Whether rays pass, their clearance at the edge (NaN if unknown), and what blocks those that do not."""
Ends: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Ends of brackets: radii, the clearance of rays there, and whether they pass."""


def clear_radius(
    clearance: Callable[[np.ndarray, np.ndarray], Clearance], outer: np.ndarray, guess: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest radii up to ``outer`` at which rays pass along directions, and what blocks them (0: none).

    ``clearance(radius, some)`` returns the `Clearance` of rays at radii along ``some`` directions, by indices; the
    clearance is 0 at the edge and continuous about it. Rays at 0 pass. ``guess``: estimates of the radii, which save
    steps if they are good to GUESSED; by default half the outer ones. At each returned radius a ray passed; within
    2e-11 of the outer radius beyond it, one did not.
    """
    near = np.zeros_like(outer) if guess is None else np.maximum(guess - GUESSED * outer, 0)
    far = outer if guess is None else np.minimum(guess + GUESSED * outer, outer)
    tried = np.stack([outer, far, near, np.zeros_like(outer)])
    every = np.tile(np.arange(outer.size), len(tried))
    passed, room, label = (column.reshape(tried.shape) for column in clearance(tried.ravel(), every))
    radius, ended = outer.copy(), np.where(passed[0], 0, label[0])
    some = np.flatnonzero(~passed[0])
    bracketed = ~passed[1] & passed[2]
    enough = outer[some] * 2.0**-BISECTIONS
    # The latest point, the other end of its bracket, and the previous point.
    first, second = np.where(bracketed, 1, 0)[some], np.where(bracketed, 2, 3)[some]
    new, other, before = (
        (tried[row, some], room[row, some], passed[row, some]) for row in (first, second, np.zeros_like(first))
    )
    part, steps = _part(new, other, before, enough), 0
    while some.size:
        at = new[0] + part * (other[0] - new[0])
        passed, room, label = clearance(at, some)
        ended[some] = np.where(passed, ended[some], label)
        same = passed == new[2]
        before, other = _where(new, other, ~same), _where(new, other, same)
        new = at, room, passed
        radius[some] = np.where(passed, at, other[0])
        left, steps = np.abs(other[0] - at) > enough, steps + 1
        some, enough = some[left], enough[left]
        new, other, before = ((at[left], room[left], passed[left]) for at, room, passed in (new, other, before))
        part = _part(new, other, before, enough) if steps < PATIENCE else np.full(some.size, 0.5)
    return radius, ended


def _where(one: Ends, other: Ends, where: np.ndarray) -> Ends:
    """Return the first of two points, the second ``where``."""
    at, room, passed = (np.where(where, b, a) for a, b in zip(one, other, strict=True))
    return at, room, passed


def _part(new: Ends, other: Ends, before: Ends, enough: np.ndarray) -> np.ndarray:
    """Return the share of the bracket for the next step, by inverse quadratic interpolation if that is safe, else half.

    Source: Chandrupatla 1997, Advances in Engineering Software 28, 145.
    """
    (x1, f1, _), (x2, f2, _), (x3, f3, _) = new, other, before
    with np.errstate(invalid="ignore", divide="ignore"):
        place, height = (x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2)
        safe = (height**2 < place) & ((1 - height) ** 2 < 1 - place)
        part = f1 / (f1 - f2) * f3 / (f3 - f2) - (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f2 - f3)
        least = enough / 2 / np.abs(x2 - x1)
    bounded: np.ndarray = np.clip(np.where(safe, part, 0.5), least, 1 - least)
    return bounded
