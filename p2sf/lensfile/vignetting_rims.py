"""Vignetting factors of other programs as clear rims, which stop the rays that the factors leave out.

A factor is the part of the pupil's radius that one end of it loses at one field; the pupil of the field is the ellipse
through these ends. What takes the rays in a lens are rims: of each surface whose highest ray, over all fields and all
around their ellipses, is one at the edge of a vignetted pupil, the rim is at that height. So programs size
semi-diameters that are left free.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import isfinite

import numpy as np

from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, check_aligned
from p2sf.lens.source import Source
from p2sf.lensfile.raw import PupilEnds, VignettingFactors
from p2sf.lensfile.report import Notebook
from p2sf.messages import Message
from p2sf.raytrace.aiming import pupil_rays
from p2sf.raytrace.pencil import pencil
from p2sf.raytrace.trace import trace

STEPS = 401  # across the pupil, among which the ends of what rims leave are found
SAME_EDGE = 0.05  # of the pupil's radius: half the width that a pencil's lens-shaped pupil differs from an ellipse by
WITHIN = 1e-3  # of the pupil's radius, by which a point lies inside the disc


def with_vignetting(
    lens: Lens, factors: VignettingFactors, slopes: Sequence[tuple[float, float]], depth_mm: float, notes: Notebook
) -> Lens:
    """Return the lens with rims for the factors where no surface but the stop states one.

    ``slopes``: (x, y) of the chief ray of every field, in the order of the factors. Notes how far rims and factors
    agree, or why the factors are left out.
    """
    if not factors.largest:
        notes.add("ignored", "vignetting factors, all of them 0")
        return lens
    values: dict[str, object] = {"value": factors.largest}
    try:
        _check(lens, factors, slopes)
        sources = [Source(depth_mm, slope, lens.reference_wavelength_um) for _, slope in slopes]
        pairs = list(zip(sources, factors.ends, strict=False))
        stated = any(isfinite(s.semi_diameter) for n, s in enumerate(lens.surfaces, 1) if n != lens.stop_surface)
        made = lens if stated else _with_rims(lens, pairs)
        missed = max(_missed(made, source, ends) for source, ends in pairs)
    except GeometryError as failure:
        told = "vignetting factors (up to {value:g}) are not applied, since {reason}; only rims clip"
        notes.add("caution", told, None, factors.line, **values, reason=failure)
        return lens
    if stated:
        told = (
            "where rims clip, those of the file end the pupil within {missed:.2g} of its radius of where its "
            "vignetting factors (up to {value:g}) end it"
        )
    else:
        told = (
            "vignetting factors (up to {value:g}) become clear rims of the surfaces {surfaces}; where rims clip, the "
            "pupil ends within {missed:.2g} of its radius of where the factors end it"
        )
        changed = zip(made.surfaces, lens.surfaces, strict=True)
        values["surfaces"] = tuple(number for number, (a, b) in enumerate(changed, 1) if a != b)
    notes.add("caution" if missed > SAME_EDGE else "read", told, None, factors.line, **values, missed=missed)
    return made


def _check(lens: Lens, factors: VignettingFactors, slopes: Sequence[tuple[float, float]]) -> None:
    """Raise GeometryError where rims about the axis cannot do what the factors say."""
    check_aligned(lens, Message("a rim for vignetting factors"))
    if factors.along_x or any(across for across, _ in slopes):
        raise GeometryError("some are of fields along x, or turn or shift the pupil along x")
    if not slopes:
        raise GeometryError("the file states no fields")
    if any(max(ends.upper, ends.lower, ends.side, (ends.upper + ends.lower) / 2) >= 1 for ends in factors.ends):
        raise GeometryError("a factor of 1 or more leaves no pupil")


def _with_rims(lens: Lens, pairs: Sequence[tuple[Source, PupilEnds]]) -> Lens:
    """Return the lens with rims where its highest rays are at the edge of a vignetted pupil."""
    highest, cut = np.zeros(len(lens.surfaces)), np.zeros(len(lens.surfaces), bool)
    for source, ends in pairs:
        xi, eta = ends.edge()
        rays = pupil_rays(lens, source, xi, eta)
        points = trace(lens, rays.origins, rays.directions, source.wavelength_um).points[1:-1]
        height = np.hypot(points[..., 0], points[..., 1])
        if not np.isfinite(height).all():
            raise GeometryError("rays at the edge of a vignetted pupil miss a surface")
        inside = (np.hypot(xi, eta) < 1 - WITHIN)[height.argmax(1)]
        higher = height.max(1) > highest
        cut, highest = np.where(higher, inside, cut), np.maximum(highest, height.max(1))
    rims = ((n, float(h)) for n, (h, inside) in enumerate(zip(highest, cut, strict=True), 1) if inside)
    found = {number: rim for number, rim in rims if number != lens.stop_surface}
    if not found:
        raise GeometryError("no rim about the axis stops these rays and none of another field")
    surfaces = (replace(s, semi_diameter=found.get(n, s.semi_diameter)) for n, s in enumerate(lens.surfaces, 1))
    return replace(lens, surfaces=tuple(surfaces))


def _missed(lens: Lens, source: Source, ends: PupilEnds) -> float:
    """Return how far the ends of what rims leave of a pupil lie from those of the factors, in its radius."""
    along, aside = np.linspace(-1, 1, STEPS), np.linspace(0, 1, STEPS)
    up = pencil(lens, source, 0 * along, along, clip=True).passed
    across = pencil(lens, source, aside, np.full(STEPS, ends.middle), clip=True).passed
    if not (up.any() and across.any()):
        return 1.0
    found = along[up].max(), -along[up].min(), aside[across].max()
    wanted = (1 - ends.upper, 1 - ends.lower, min(1 - ends.side, float(np.sqrt(1 - ends.middle**2))))
    return float(max(abs(one - min(other, 1.0)) for one, other in zip(found, wanted, strict=True)))
