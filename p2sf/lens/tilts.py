"""Tilts and decentres of other programs: OpticStudio's coordinate breaks, CODE V's decentred surfaces."""

from dataclasses import replace

from p2sf.errors import GeometryError
from p2sf.lens.placement import Placement

COORDINATE_BREAK = 6  # number of parameters: decentre x and y, tilt about x, y and z, order


def coordinate_break(parameters: dict[int, float]) -> Placement:
    """Return a break from the parameters of OpticStudio: angles right-handed; a flag other than 0 tilts first."""
    x, y, a, b, c, order = (parameters.get(place, 0.0) for place in range(1, COORDINATE_BREAK + 1))
    return Placement(x, y, 0.0, a, b, c, bool(order))


Row = tuple[float, float, float, float, float, float, float]
"""Decentre x and y, tilt about x, y and z, order, and the thickness behind."""


def break_rows(placement: Placement, thickness: float) -> list[Row]:
    """Return OpticStudio's coordinate breaks for a placement and a shift by ``thickness`` along z behind it.

    A decentre in z becomes the thickness of a break, and a pivot a shift there and back.
    """
    (x, y, z), (a, b, c), (px, py, pz) = placement.decentre, placement.tilt_deg, placement.pivot
    rows: list[Row]
    if placement.tilt_first:
        rows = [(px, py, 0, 0, 0, 0, pz), (x - px, y - py, a, b, c, 1, z - pz + thickness)]
    elif z or any(placement.pivot):
        rows = [(x + px, y + py, 0, 0, 0, 0, z + pz), (0, 0, a, b, c, 0, 0), (-px, -py, 0, 0, 0, 0, thickness - pz)]
    else:
        rows = [(x, y, a, b, c, 0, thickness)]
    return [*(row for row in rows[:-1] if any(row)), rows[-1]]


def decentred_surface(kind: str, decentre: tuple[float, ...], angles_deg: tuple[float, ...]) -> "Breaks":
    """Return the breaks before and after a surface of CODE V or ray-optics: XDE YDE ZDE and ADE BDE CDE.

    ADE and BDE are left-handed, CDE is right-handed. ``kind``: "" basic, the axes stay with the surface; "DAR" decentre
    and return; "REV" reverse, the axes behind it are moved by the reverse decentre; "BEN" bend, the axes follow the
    axis that a mirror reflects. Raises GeometryError for a bend about more than one axis.
    """
    (x, y, z), (alpha, beta, gamma) = decentre, angles_deg
    placement = Placement(x, y, z, -alpha, -beta, gamma)
    if placement.idle:
        return (), ()
    if kind == "DAR":
        return (placement,), (placement.inverse,)
    if kind == "REV":
        return (), (placement.inverse,)
    if kind == "BEN":
        if sum(map(bool, angles_deg)) > 1:
            raise GeometryError("a bend (BEN) about more than one axis is not read; write the tilt behind it by itself")
        return (placement,), (replace(placement.followed, decentre_x=0.0, decentre_y=0.0, decentre_z=0.0),)
    return (placement,), ()


Breaks = tuple[tuple[Placement, ...], tuple[Placement, ...]]
"""Before and after a surface."""
