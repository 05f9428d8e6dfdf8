"""Check of the chief ray of a misaligned lens, with the reason if it does not reach the sensor."""

from functools import lru_cache

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.placement import Placement
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.pupils import Stop
from p2sf.raytrace.aiming import Sources, chief_rays, start
from p2sf.raytrace.surface import Status
from p2sf.raytrace.trace import run, status_message


def check_chief_ray(lens: Lens, source: Source | Sources, stop: Stop | None = None) -> None:
    """Raise GeometryError where the chief ray of a misaligned lens is lost, or meets a surface beyond its rim."""
    if stop is None and isinstance(source, Source):
        _check_cached(lens, source)
    else:
        _check(lens, source, stop)


@lru_cache(maxsize=256)
def _check_cached(lens: Lens, source: Source) -> None:
    _check(lens, source, None)


def _check(lens: Lens, source: Source | Sources, stop: Stop | None) -> None:
    rays = chief_rays(lens, source, stop)
    if rays is None:
        return
    beam, heights = start(rays), []
    run(lens, beam, rays.index, visit=lambda _: heights.append(np.hypot(beam.x, beam.y)))
    lost = beam.status != Status.PASSED
    if lost.any():
        status, failed = (int(part[lost][0]) for part in (beam.status, beam.failed_surface))
        raise chief_ray_error(lens, status_message(lens, status, failed), failed)
    for number, (surface, height) in enumerate(zip(lens.surfaces, heights, strict=False), 1):
        far = float(np.max(height))
        if surface.rim is None and far > surface.semi_diameter:
            beyond = Message(
                "meets surface {surface} {height:.4g} mm from its vertex, beyond its rim of {rim:g} mm",
                surface=number,
                height=far,
                rim=surface.semi_diameter,
            )
            raise chief_ray_error(lens, beyond, number)


def chief_ray_error(lens: Lens, outcome: Message, surface: int) -> GeometryError:
    """Return the error that states the fate of the chief ray at a surface and the placement that may have caused it."""
    number, placement = _last_placement(lens, surface)
    if placement is None:
        return GeometryError("the chief ray {outcome}; choose a smaller field", outcome=outcome)
    return GeometryError(
        "the chief ray {outcome}; surface {placed} is decentred by ({decentre:g}) mm and tilted by ({tilt:g})°: "
        "make that or the field smaller",
        outcome=outcome,
        placed=number,
        decentre=placement.decentre,
        tilt=placement.tilt_deg,
    )


def _last_placement(lens: Lens, surface: int) -> tuple[int, Placement | None]:
    """Return the last surface up to this one with a break before it, else behind it, and its first break.

    A break behind a piece usually undoes the one before it and would report the opposite numbers.
    """
    for side in ("before", "after"):
        for number in range(min(surface, len(lens.surfaces)) - (side == "after"), 0, -1):
            for placement in getattr(lens.surfaces[number - 1], side):
                if any(placement.decentre) or any(placement.tilt_deg[:2]):
                    return number, placement
    return 0, None
