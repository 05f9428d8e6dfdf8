"""The same optics written in other ways: travel in breaks, folds, a tilt of the whole, all but the stop decentred."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf

from p2sf.lens.lens import Lens, Surface
from p2sf.lens.misalignment import displaced, folding
from p2sf.lens.placement import Placement

SHARE = 0.4  # of a space that stands in its thickness; of the way to the sensor that lies before a fold
FOLD_DEG = 35.0
TILT_DEG = 6.0
DECENTRE_MM = 0.3


@dataclass(frozen=True)
class Written:
    """One way to write a lens: ``turned_deg`` is what its fields, along y, have to be turned by.

    ``same``: the way that it is the same as, the plain lens without.
    """

    name: str
    write: Callable[[Lens], Lens]
    turned_deg: float = 0.0
    same: Callable[[Lens], Lens] = lambda lens: lens


def split(lens: Lens) -> Lens:
    """Return the lens with part of every space in breaks, behind surfaces and before the sensor."""
    surfaces = []
    for number, surface in enumerate(lens.surfaces, 1):
        kept = SHARE * surface.thickness
        moved = (Placement(decentre_z=surface.thickness - kept),)
        last = number == len(lens.surfaces)
        surfaces.append(replace(surface, thickness=kept, after=() if last else moved))
    return replace(lens, surfaces=tuple(surfaces), sensor_before=moved)


def in_one_break(lens: Lens) -> Lens:
    """Return the lens with the whole way to its sensor in a break."""
    *front, last = lens.surfaces
    return replace(
        lens, surfaces=(*front, replace(last, thickness=0.0)), sensor_before=(Placement(decentre_z=last.thickness),)
    )


def folded(lens: Lens, by_deg: float = FOLD_DEG) -> Lens:
    """Return the lens with a plane mirror on its way to the sensor."""
    *front, last = lens.surfaces
    way = SHARE * last.thickness
    mirror = Surface(inf, way - last.thickness, "mirror", **folding(Placement(tilt_x_deg=by_deg)))
    return replace(lens, surfaces=(*front, replace(last, thickness=way), mirror))


def folded_by_breaks(lens: Lens) -> Lens:
    """Return the folded lens, its way behind the mirror in the break that turns the axes."""
    made = folded(lens)
    *front, mirror = made.surfaces
    onward = Placement(decentre_z=mirror.thickness)
    return replace(made, surfaces=(*front, replace(mirror, thickness=0.0, after=(*mirror.after, onward))))


def twice_folded(lens: Lens) -> Lens:
    """Return the lens folded a second time, out of the plane of the first mirror."""
    made = folded(lens)
    *front, mirror = made.surfaces
    way = SHARE * mirror.thickness
    second = Surface(inf, way - mirror.thickness, "mirror", **folding(Placement(tilt_x_deg=-20.0, tilt_y_deg=25.0)))
    return replace(made, surfaces=(*front, replace(mirror, thickness=way), second))


def tilted(lens: Lens) -> Lens:
    """Return the lens turned as a whole about its first vertex, the sensor with it."""
    first, *rest = lens.surfaces
    return replace(lens, surfaces=(replace(first, before=(Placement(tilt_x_deg=TILT_DEG),)), *rest))


def with_decentred_stop(lens: Lens) -> Lens:
    """Return the lens with its stop decentred."""
    stop = lens.stop_surface or 1
    return displaced(lens, stop, stop, Placement(decentre_y=DECENTRE_MM))


def decentred_about_the_stop(lens: Lens) -> Lens:
    """Return the lens with all but its stop decentred the other way."""
    stop, count, back = lens.stop_surface or 1, len(lens.surfaces), Placement(decentre_y=-DECENTRE_MM)
    for first, last in ((1, stop - 1), (stop + 1, count)):
        lens = displaced(lens, first, last, back) if first <= last else lens
    return replace(lens, sensor_before=(back,))


WAYS = (
    Written("travel in breaks", split),
    Written("travel in one break", in_one_break),
    Written("folded", folded),
    Written("folded by breaks", folded_by_breaks),
    Written("folded twice", twice_folded),
    Written("tilted as a whole", tilted, -TILT_DEG),
    Written("decentred about the stop", decentred_about_the_stop, same=with_decentred_stop),
)
