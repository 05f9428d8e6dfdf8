"""Lenses written as a few numbers: single elements, afocal pairs, a telecentric relay, two ideal lenses."""

from math import inf

from p2sf.glass.media import AIR, MIRROR, ConstantIndex
from p2sf.lens.irregularity import Irregularity
from p2sf.lens.lens import Aperture, Lens, Surface

FIRST, SECOND, GAP = 50.0, -80.0, 25.0  # of the two thin lenses, mm


def simple(rows, stop=1, rim=5.0, before=1.0) -> Lens:
    """Return a lens from rows (radius, thickness, index behind)."""
    surfaces = tuple(Surface(r, t, ConstantIndex(n)) for r, t, n in rows)
    return Lens(surfaces, Aperture("stop_semi_diameter", rim), stop, object_medium=ConstantIndex(before))


def telescope(second: float, thickness: float) -> Lens:
    """Return an afocal pair: a plano-convex lens of f = 100 mm and one of f = ``second``, with a common focus.

    ``thickness`` is the centre thickness of the first lens, mm.
    """
    first = 50.0  # radius for f = 100 at n = 1.5
    gap = 100.0 + second - thickness / 1.5
    return simple([(first, thickness, 1.5), (inf, gap, 1.0), (inf, 0.0, 1.5), (-second / 2, 30.0, 1.0)], 1, 4.0)


def twice_telecentric() -> Lens:
    """Return a relay of two plano-convex lenses with the stop in their common focus: telecentric on both sides."""
    rows = [(inf, 3.0, 1.5), (-50.0, 100.0, 1.0), (inf, 100.0, 1.0), (50.0, 3.0, 1.5), (inf, 98.0, 1.0)]
    return simple(rows, 3, 4.0)


def two_thin_lenses(sensor: float = 40.0, aim: str = "stop") -> Lens:
    """Return a thin lens, a stop 20 mm behind it, and another thin lens."""
    rows = (
        Surface(thickness=GAP - 5.0, ideal_focal_length=FIRST, semi_diameter=9.0),
        Surface(thickness=5.0),
        Surface(thickness=sensor, ideal_focal_length=SECOND, semi_diameter=8.0),
    )
    return Lens(rows, Aperture("stop_semi_diameter", 4.0), 2, aim=aim)


def in_the_stop(medium, irregularity: Irregularity | None) -> Lens:
    """Return a plane in the stop, of radius 5 mm, and far behind it an ideal lens that focuses what comes."""
    back = -1.0 if medium == MIRROR else 1.0
    plane = Surface(inf, back * 10.0, medium, semi_diameter=5.0, irregularity=irregularity)
    ideal = Surface(inf, back * 200.0, AIR, ideal_focal_length=200.0)
    return Lens((plane, ideal), Aperture("stop_semi_diameter", 5.0), 1)
