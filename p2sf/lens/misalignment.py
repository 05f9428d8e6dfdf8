"""A lens with an element, a group, a mirror or the sensor tilted and decentred."""

from dataclasses import replace
from functools import lru_cache, reduce

import numpy as np

from p2sf.arguments import check_arguments
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.placement import Motion, Placement, along_z, placement_of
from p2sf.lens.properties import PROPERTIES, breaks_words
from p2sf.messages import Message


@check_arguments
def displaced(lens: Lens, first: int, last: int, placement: Placement) -> Lens:
    """Return the lens with surfaces ``first`` to ``last``, from 1, moved as one piece; all others stay.

    ``placement`` is given in the axes before surface ``first``, its pivot in mm from that vertex. Raises GeometryError
    if there are no such surfaces.
    """
    if not 1 <= first <= last <= len(lens.surfaces):
        raise GeometryError(
            "surfaces {first} to {last} do not exist; the lens has surfaces 1 to {count}",
            first=first,
            last=last,
            count=len(lens.surfaces),
        )
    if placement.idle:
        return lens
    surfaces = list(lens.surfaces)
    back = _restoring(lens, first, last, placement)
    front, rear = surfaces[first - 1], surfaces[last - 1]
    surfaces[first - 1] = replace(front, before=(placement, *front.before))
    rear = surfaces[last - 1]
    surfaces[last - 1] = replace(rear, after=(*rear.after, back))
    return replace(lens, surfaces=tuple(surfaces))


def _restoring(lens: Lens, first: int, last: int, placement: Placement) -> Placement:
    """Return the break behind surface ``last`` that restores the axes as they are without ``placement``."""
    inside = along_z(0.0)
    for number, surface in enumerate(lens.surfaces[first - 1 : last], first):
        breaks = (one.motion for one in (*surface.before, *surface.after))
        inside = reduce(Motion.then, breaks, inside).then(along_z(surface.thickness if number < last else 0.0))
    if not inside.turns and not np.any(inside.origin[:2]):
        return placement.inverse.behind(float(inside.origin[2]))
    return placement_of(inside.inverse.then(placement.motion.inverse).then(inside))


def with_tilted_sensor(lens: Lens, placement: Placement) -> Lens:
    """Return the lens with its sensor tilted and decentred, in the axes at its position behind the last surface."""
    return replace(lens, sensor_before=() if placement.idle else (placement,))


@lru_cache(maxsize=16)
def misalignments(lens: Lens) -> tuple[Message, ...]:
    """Return what of a lens is tilted, decentred or not of revolution, a sentence for each place; none if aligned."""
    if not lens.misaligned:
        return ()
    found = []
    for number, surface in enumerate(lens.surfaces, 1):
        for each in PROPERTIES:
            value = getattr(surface, each.name)
            if not each.symmetric(value) and (words := each.words(value)):
                found.append(Message(PLACES.get(each.name, "surface {surface}: {words}"), surface=number, words=words))
    sensor = breaks_words(lens.sensor_before)
    return *found, *([Message("sensor: {words}", words=sensor)] if sensor else [])


PLACES = {"before": "before surface {surface}: {words}", "after": "behind surface {surface}: {words}"}


@lru_cache(maxsize=16)
def straighten(lens: Lens) -> Lens:
    """Return the aligned lens: without tilts, decentres and parts that are not of revolution; its rims stay.

    What breaks shift along the axis is thickness there.
    """
    surfaces = tuple(
        replace(s, **{each.name: each.aligned(getattr(s, each.name)) for each in PROPERTIES} | {"thickness": gap})
        for s, gap in zip(lens.surfaces, lens.gaps, strict=True)
    )
    return replace(lens, surfaces=surfaces, sensor_before=())


@lru_cache(maxsize=16)
def average_azimuths(lens: Lens) -> Lens:
    """Return the lens for paraxial rays: with the azimuthal mean of every shape, and without shading."""
    surfaces = tuple(
        replace(s, **{each.name: each.averaged(getattr(s, each.name)) for each in PROPERTIES}) for s in lens.surfaces
    )
    if lens.shading is None and surfaces == lens.surfaces:
        return lens
    return replace(lens, surfaces=surfaces, absorption=False)


def folding(placement: Placement) -> dict[str, tuple[Placement, ...]]:
    """Return ``before`` and ``after`` of a mirror at ``placement`` that folds the axis: the axes behind it follow."""
    return {"before": (placement,), "after": (placement.followed,)}
