"""Exact skew rays through a whole lens (handbook 8.1)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import FloatOrArray
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, absorptions, indices
from p2sf.messages import Message
from p2sf.paraxial.pupils import RIM_TIE, default_stop, rim_radii, stop_rim
from p2sf.raytrace.ideal import object_point, refract_ideal
from p2sf.raytrace.surface import Beam, Status, clip, clip_inside, diffract, meet, move, refract, transmit

Index: TypeAlias = np.ndarray | list[float]  # per medium, object space first; floats for one wavelength

_OUTCOMES = {
    Status.PASSED: "passes",
    Status.MISSED: "misses surface {surface}",
    Status.REFLECTED: "is totally reflected at surface {surface}",
    Status.CLIPPED: "is stopped by the rim of surface {surface}",
    Status.CLIPPED_BESIDE: "is stopped by the rim of surface {surface}",
    Status.REFUSED: "meets the asphere on surface {surface} where no reliable intersection was found",
    Status.EVANESCENT: "has no diffracted direction behind surface {surface}, whose phase is too steep there",
    Status.OPAQUE: "meets surface {surface} where that transmits no light",
    Status.UNAIMED: "could not be aimed at its place in the stop, surface {surface}",
}


@dataclass(frozen=True, eq=False)
class Trace:
    """Rays traced from their origins to the sensor.

    ``points``: (surfaces + 2, …, ray, 3) mm from the first vertex: the origin, every surface, the sensor; NaN from
    where the ray failed; in the axes of the lens, even if parts of it are tilted. ``cosines``: (…, ray, 3) in image
    space, in the same axes, in the direction of travel. ``path``: optical path from the origin to the sensor, mm; NaN
    through an ideal lens, whose path depends on the position of the source (known to `pencil`). ``status``: `Status`
    per ray; ``failed_surface`` counts from 1, 0 where the ray passed.
    """

    points: np.ndarray
    cosines: np.ndarray
    path: np.ndarray
    status: np.ndarray
    failed_surface: np.ndarray


def status_message(lens: Lens, status: int, surface: int) -> Message:
    """Return the fate of a ray as the end of a sentence that begins with "the ray"; behind the lens is the sensor."""
    if surface > len(lens.surfaces):
        return Message("misses the sensor, which is curved or tilted")
    return Message(_OUTCOMES[Status(status)], surface=surface)


def trace(
    lens: Lens,
    origins: ArrayLike,
    directions: ArrayLike,
    wavelength_um: FloatOrArray,
    clip: bool = False,
    stop_clips: bool = True,
) -> Trace:
    """Trace skew rays; ``origins`` in mm from the first vertex and ``directions`` of any length, each (…, ray, 3).

    An origin may lie anywhere on its ray in object space. ``wavelength_um`` broadcasts against the leading axes.
    ``clip`` applies every clear semi-diameter and, with ``stop_clips``, the rim of the stop, which the outermost rays
    of the pupil touch. A ray that fails becomes NaN and keeps the reason and the surface. Raises GlassError. Source:
    Welford 1986, ch. 4.
    """
    origins, directions = np.broadcast_arrays(np.asarray(origins, float), np.asarray(directions, float))
    with np.errstate(invalid="ignore", divide="ignore"):
        unit = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    index = per_ray(indices(lens, wavelength_um))
    waves = wavelength_um if np.ndim(wavelength_um) == 0 else np.asarray(wavelength_um)[..., None]
    beam = launch(index[0], waves, np.moveaxis(origins, -1, 0), np.moveaxis(unit, -1, 0))
    beam.fail(~np.isfinite(origins + unit).all(-1), Status.MISSED, 1)  # origin or direction not finite
    places: list[np.ndarray] = []
    lost: list[np.ndarray] = []

    def visit(_: int) -> None:
        places.append(beam.place.copy())
        lost.append(beam.status != Status.PASSED)

    run(lens, beam, index, lens_rims(lens, stop_clips) if clip else None, visit=visit)
    cosines = np.stack([beam.p, beam.q, beam.r], -1) / np.abs(np.asarray(index[-1]))[..., None]
    points, cosines = _in_axes_of_lens(lens, np.array(places), cosines)
    points[np.array(lost)] = np.nan
    cosines[beam.status != Status.PASSED] = np.nan
    return Trace(np.concatenate([origins[None], points]), cosines, beam.path, beam.status, beam.failed_surface)


def out_of_order(lens: Lens, z: np.ndarray) -> Message | None:
    """Return a warning if a ray meets a surface before the one in front of it.

    ``z``: (surfaces, …) mm from the first vertex, NaN where the ray failed. That happens beyond the edge of the glass,
    where surfaces have crossed; a negative thickness puts them in that order on purpose. A lens with tilted or
    decentred parts, in which light may travel anywhere along z, is not checked.
    """
    if not len(z) or None in lens.steps:
        return None
    along = lens.directions[1 : len(z)]
    behind = np.array([gap * sign >= 0 for gap, sign in zip(lens.gaps, along, strict=False)], bool)
    forwards = np.diff(z, axis=0) * np.reshape(along, (-1, *[1] * (z.ndim - 1)))
    back = (forwards < 0).any(tuple(range(1, z.ndim))) & behind
    if not back.any():
        return None
    before = int(np.argmax(back)) + 1
    return Message(
        "rays meet surface {surface} before surface {before}, beyond the edge of the glass, which is impossible; "
        "choose a smaller field or aperture",
        surface=before + 1,
        before=before,
    )


def launch(
    index: FloatOrArray,
    wavelength_um: FloatOrArray,
    position: np.ndarray | Sequence[FloatOrArray],
    direction: np.ndarray | Sequence[FloatOrArray],
) -> Beam:
    """Return a new beam of rays in a medium of this index.

    ``position``: x, y and z from the first vertex, mm; ``direction``: the cosines with the axes.
    """
    shape = np.broadcast(*position, *direction, index).shape
    place, ray = np.empty((3, *shape)), np.empty((3, *shape))
    for row, value in zip((*place, *ray), (*position, *direction), strict=True):
        row[...] = value
    ray *= index
    return Beam(place, ray, wavelength_um)


def run(
    lens: Lens,
    beam: Beam,
    index: Index,
    rims: np.ndarray | None = None,
    last: int | None = None,
    visit: Callable[[int], None] | None = None,
    first: int = 1,
) -> Beam:
    """Carry a beam through the lens to the sensor, or onto and through surface ``last``, and return it.

    ``first`` > 1 continues a beam whose last surface was the one before it. ``rims``, one per surface, mm, clip the
    beam. ``visit(number)`` is called on every surface and on the sensor, which counts as the surface behind the last;
    without it, planes between equal media are skipped. Absorption reduces `Beam.transmission`. The beam is given in the
    axes of the lens and ends in those of its last surface or the sensor; ``visit`` sees it in the axes of the surface.
    """
    absorbed = absorptions(lens, beam.wavelength_um)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        _to_next_axes(beam, lens, first - 1, index)
        for number, surface in enumerate(lens.surfaces[first - 1 : last], first):
            idle = surface.bare and rims is None and visit is None and absorbed is None
            if number == last or not (idle and _same(index[number - 1], index[number])):
                _cross(beam, lens, index, number, rims, visit, absorbed)
            if number != last:
                _to_next_axes(beam, lens, number, index)
        if last is None:
            path = beam.path.copy() if absorbed else beam.path
            meet(beam, lens.sensor_surface, index[-1], len(lens.surfaces) + 1)
            if absorbed:
                _absorb(beam, absorbed[-1], path, index[-1])
            if visit:
                visit(len(lens.surfaces) + 1)
    return beam


def _to_next_axes(beam: Beam, lens: Lens, number: int, index: Index) -> None:
    """Convert a beam from the axes of surface ``number`` (0: of the lens) to those of the next, or of the sensor."""
    step = lens.steps[number]
    if step is None:
        move(beam, lens.motions[number], index[number], number + 1)
    elif step:
        beam.z -= step


def _cross(
    beam: Beam,
    lens: Lens,
    index: Index,
    number: int,
    rims: np.ndarray | None,
    visit: Callable[[int], None] | None,
    absorbed: list[FloatOrArray] | None,
) -> None:
    """Carry a beam to a surface, clip it there, and refract it."""
    surface, before, after = lens.surfaces[number - 1], index[number - 1], index[number]
    path = beam.path.copy() if absorbed else beam.path
    normal = meet(beam, surface, before, number)
    if absorbed:
        _absorb(beam, absorbed[number - 1], path, before)
    if visit:
        visit(number)
    if rims is not None:
        clip(beam, rims[number - 1], surface.rim, number)
        if surface.inner_radius:
            clip_inside(beam, surface.inner_radius, surface.rim, number)
    if surface.transmission is not None:
        transmit(beam, surface.transmission, number)
    if surface.ideal:
        refract_ideal(beam, surface.ideal_focal_length, before, after, object_point(lens, beam, index, number))
    elif surface.diffraction is not None:
        diffract(beam, normal, surface.diffraction, after, number)
    elif not _same(before, after):
        refract(beam, normal, before, after, number)


def _absorb(beam: Beam, absorption: FloatOrArray, path: np.ndarray, index: FloatOrArray) -> None:
    """Apply the absorption of a medium, per mm, to a beam since its optical paths were ``path`` (Beer–Lambert).

    Lengths have the sign of paths, so that going forth and back in the medium to a dummy plane cancels.
    """
    if np.any(absorption):
        beam.transmission = beam.transmission * np.exp(absorption * (path - beam.path) / np.abs(index))


def _same(before: FloatOrArray, after: FloatOrArray) -> bool:
    equal = before == after
    return equal if isinstance(equal, bool) else bool(equal.all())


def _in_axes_of_lens(lens: Lens, places: np.ndarray, cosines: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return points (surfaces + 1, …, ray, 3) and cosines (…, ray, 3) in the axes of the lens.

    ``places``: (surfaces + 1, 3, …, ray) in the axes of each surface and the sensor, ``cosines`` in the sensor's.
    """
    if None in lens.steps:
        rotation, origin = (np.array(part) for part in zip(*lens.frames, strict=True))
        flat = rotation @ places.reshape(*places.shape[:2], -1) + origin[..., None]
        return np.moveaxis(flat.reshape(places.shape), 1, -1), cosines @ rotation[-1].T
    places[:, 2] += np.cumsum([step or 0.0 for step in lens.steps]).reshape(-1, *[1] * (places.ndim - 2))
    return np.moveaxis(places, 1, -1), cosines


def per_ray(index: np.ndarray) -> Index:
    """Return indices with a ray axis behind the wavelength's axes; plain floats for one wavelength."""
    with_axis: Index = index.tolist() if index.ndim == 1 else index[..., None]
    return with_axis


def lens_rims(lens: Lens, keep_stop: bool = True) -> np.ndarray:
    """Return the rims that clip, mm, wider by a rounding error; without ``keep_stop`` that of the stop is infinite.

    A pencil that fills the stop needs no rim there, except a decentred or rectangular one. Raises GeometryError for a
    lens that states no rims.
    """
    stop = lens.stop_surface or default_stop(lens)
    rims = rim_radii(lens, stop, stop_rim(lens) if keep_stop else np.inf) * (1 + RIM_TIE)
    if lens.surfaces[stop - 1].rim:
        rims[stop - 1] = lens.surfaces[stop - 1].semi_diameter * (1 + RIM_TIE)
    if not np.isfinite(rims).any() and not any(surface.inner_radius or surface.rim for surface in lens.surfaces):
        raise GeometryError(
            "the lens states no semi-diameters, so nothing can be clipped; add them or leave {parameter} off",
            parameter="clip",
        )
    return rims
