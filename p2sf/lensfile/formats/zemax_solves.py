"""Pickups and solves of a .zmx, evaluated in the order of surfaces in every configuration.

A file holds the values of the configuration that was shown when it was saved; in all others they follow from these
lines. Solves for paraxial rays and powers are left to `paraxial_solves`, which knows the media; those for real rays and
for a clear edge beyond conics keep the stored value.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Literal

from p2sf.lens.shapes import Conic
from p2sf.lensfile.raw import ParaxialSolve, RawSurface
from p2sf.lensfile.report import Notebook
from p2sf.lensfile.source_text import LensText, number, whole
from p2sf.messages import Message

CURVATURE_PICKUP = "4"  # the kind of solve in a CURV line
FIXED = ("0", "1")  # and of a value or a variable
F_NUMBER = "11"
CURVATURE_SOLVES: dict[str, tuple[str, Literal["marginal", "chief"]]] = {
    "2": ("angle", "marginal"),
    "3": ("angle", "chief"),
    "5": ("incidence", "marginal"),
    "6": ("incidence", "chief"),
    "7": ("aplanatic", "marginal"),
    "8": ("power", "marginal"),
}


@dataclass(frozen=True)
class Solve:
    """One line below a surface that gives its curvature, its thickness or a parameter: keyword and what follows it."""

    name: str
    surface: int
    words: tuple[str, ...]
    line: int


@dataclass
class SolvedSurfaces:
    """The surfaces of a configuration with their parameters; ``configurations``: how many the file has.

    ``stated`` are the numbers of surfaces whose thickness an operand states, which no solve changes.
    """

    surfaces: list[RawSurface]
    parameters: dict[int, dict[int, float]]
    stated: set[int]
    configurations: int
    source: LensText
    notes: Notebook

    def value(self, solve: Solve, place: int, usual: float = 0.0) -> float:
        """Return the number at a place of a line, ``usual`` where it is missing."""
        if place >= len(solve.words):
            return usual
        return number(solve.words[place], Message("number of a solve"), self.source, solve.line)

    def picked(self, solve: Solve, place: int) -> RawSurface | None:
        """Return the surface that a pickup names, which stands before its own; None for another."""
        found = self.value(solve, place)
        return self.surfaces[int(found)] if 0 < found < solve.surface and found == int(found) else None

    def keep(self, solve: Solve) -> None:
        """Note a solve that is not evaluated, where that matters."""
        if self.configurations > 1:
            told = (
                "its thickness or curvature follows from others ({keyword}), and is here the same in all configurations"
            )
            self.notes.add("caution", told, solve.surface, solve.line, keyword=solve.name)


def apply_solves(solves: Sequence[Solve], lens: SolvedSurfaces) -> None:
    """Set all that follows from other numbers, in the order of surfaces; LensFileError for what is no number."""
    for solve in sorted(solves, key=lambda each: each.surface):
        if solve.name == "CURV" or solve.name == "PPAR" or solve.surface not in lens.stated:
            SOLVES[solve.name](solve, lens)


def _follow(lens: SolvedSurfaces, solve: Solve, found: ParaxialSolve) -> None:
    """Let a curvature or a thickness follow from a ray, in place of the value of the configuration that was shown."""
    surface = lens.surfaces[solve.surface]
    surface.solve(found)
    if lens.configurations > 1:
        setattr(surface, found.of, 0.0)


def _curvature(solve: Solve, lens: SolvedSurfaces) -> None:
    """Evaluate CURV value 4 surface scale: a curvature that is a multiple of another."""
    kind, *_ = solve.words[1:2] or ("0",)
    if kind in FIXED:
        return
    if kind in CURVATURE_SOLVES:
        of, ray = CURVATURE_SOLVES[kind]
        value = lens.value(solve, 2) if of in ("angle", "power") else 0.0
        _follow(lens, solve, ParaxialSolve("curvature", of, value, ray, name=f"CURV {kind}"))
        return
    if kind == F_NUMBER:
        stated = lens.value(solve, 2)
        angle = -1 / (2 * stated) if stated else 0.0
        _follow(lens, solve, ParaxialSolve("curvature", "angle", angle, name=f"CURV {kind}"))
        return
    other = lens.picked(solve, 2) if kind == CURVATURE_PICKUP else None
    if other is None:
        lens.keep(solve)
        return
    lens.surfaces[solve.surface].curvature = lens.value(solve, 3, 1.0) * other.curvature


def _thickness(solve: Solve, lens: SolvedSurfaces) -> None:
    """Evaluate PZUP surface scale offset."""
    other = lens.picked(solve, 0)
    if other is None:
        lens.keep(solve)
        return
    lens.surfaces[solve.surface].thickness = lens.value(solve, 1, 1.0) * other.thickness + lens.value(solve, 2)


def _parameter(solve: Solve, lens: SolvedSurfaces) -> None:
    """Evaluate PPAR place surface scale offset: the parameter of the same place of another surface."""
    place = whole(solve.words[0] if solve.words else "", Message("parameter number"), lens.source, solve.line)
    other = lens.picked(solve, 1)
    if other is None or lens.value(solve, 4):  # of another column
        lens.keep(solve)
        return
    value = lens.parameters.get(other.number, {}).get(place, 0.0)
    own = lens.parameters.setdefault(solve.surface, {})
    own[place] = lens.value(solve, 2, 1.0) * value + lens.value(solve, 3)


def _sum(solve: Solve, lens: SolvedSurfaces) -> None:
    """Evaluate TCOM n s, which keeps the sum with the thickness of surface n, and TOLE n s, that of all from n on."""
    if lens.configurations == 1:
        return
    first = int(lens.value(solve, 0))
    if not 0 < first < solve.surface or len(solve.words) < 2:
        lens.keep(solve)
        return
    last = first + 1 if solve.name == "TCOM" else solve.surface
    others = sum(surface.thickness for surface in lens.surfaces[first:last])
    lens.surfaces[solve.surface].thickness = lens.value(solve, 1) - others


def _edge(solve: Solve, lens: SolvedSurfaces) -> None:
    """Evaluate EDGE thickness height between conics; a height of 0 is the larger of both semi-diameters."""
    if lens.configurations == 1 or solve.surface + 1 >= len(lens.surfaces):
        return
    pair = lens.surfaces[solve.surface : solve.surface + 2]
    height = lens.value(solve, 1) or max(one.semi_diameter for one in pair)
    plain = not any(any(lens.parameters.get(one.number, {}).values()) for one in pair)
    sags = [float(Conic(one.curvature, one.conic).sag_and_slope(height * height)[0]) for one in pair if plain]
    if not sags or not all(map(isfinite, sags)):
        lens.keep(solve)
        return
    lens.surfaces[solve.surface].thickness = lens.value(solve, 0) + sags[0] - sags[1]


def _marginal_height(solve: Solve, lens: SolvedSurfaces) -> None:
    """Evaluate MAZH height zone: the height of paraxial rays, zone 0, at the next surface."""
    if not solve.words or lens.value(solve, 1):
        lens.keep(solve)
        return
    _follow(lens, solve, ParaxialSolve("thickness", "height", lens.value(solve, 0), name=solve.name))


SOLVES: dict[str, Callable[[Solve, SolvedSurfaces], None]] = {
    "CURV": _curvature,
    "PZUP": _thickness,
    "PPAR": _parameter,
    **dict.fromkeys(("TCOM", "TOLE"), _sum),
    "EDGE": _edge,
    "MAZH": _marginal_height,
}
