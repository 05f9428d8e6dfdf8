"""One surface at a time: where a skew ray meets it, and how it leaves.

Rays have *optical* direction cosines (P, Q, R) = n·(L, M, N) and the ray parameter τ is length
per index, so that a step τ moves a point by τ(P, Q, R) and adds n²τ to the optical path: nothing is
divided by the index. Behind an odd number of mirrors the index is negative and so is R; (P, Q, R) is then
|n|·(L, M, N) of the ray as it travels, and a mirror is refraction into n' = −n. The functions change a `Beam` in
place, which is what makes thousands of rays fast; none leaves this folder.
"""

from enum import IntEnum
from math import inf
from typing import NamedTuple

import numpy as np

from p2sf.conventions import FloatOrArray
from p2sf.lens.grating import Phase
from p2sf.lens.lens import Surface
from p2sf.lens.placement import Motion
from p2sf.lens.rim import Rim
from p2sf.lens.shapes import WAVES_MM
from p2sf.lens.transmission import Transmission

NEWTON_STEPS = 40
# A root is found when the sag differs from the ray's height by no more than the rounding of their sum.
ROUNDING = 16 * np.finfo(float).eps
SHARES = tuple(share * side for share in (0.02, 0.05, 0.1, 0.2, 0.35, 0.6, 1.0) for side in (1, -1))


class Status(IntEnum):
    """Why a ray ended, or that it did not."""

    PASSED = 0
    MISSED = 1
    REFLECTED = 2
    CLIPPED = 3
    REFUSED = 4
    UNAIMED = 5
    EVANESCENT = 6
    CLIPPED_BESIDE = 7  # on the left or right of a rectangle: apart, since the clear part has a corner where they meet
    OPAQUE = 8


AT_RIM = Status.CLIPPED, Status.CLIPPED_BESIDE


def ended_at(status: np.ndarray, failed_surface: np.ndarray) -> np.ndarray:
    """Return a number that tells apart what ends rays: the surface, and of it a side of a rectangle and its coating."""
    number: np.ndarray = (
        failed_surface + BESIDE * (status == Status.CLIPPED_BESIDE) + 2 * BESIDE * (status == Status.OPAQUE)
    )
    return number


BESIDE = 10_000  # more than a file has surfaces


class Beam:
    """Rays being traced: position from the current vertex (mm), optical cosines, optical path (mm), status.

    ``place`` and ``ray``: (3, …, ray), with x, y, z and p, q, r as views of their rows, so that an operation on all
    components is one call. The last ``exempt`` rays pass every rim. ``wavelength_um`` broadcasts against (…, ray).
    ``transmission``: the share of energy that surfaces have passed, below 0 where one passes none, and ``dimmed`` the
    last surface that may pass none. ``clearance``: the least room that rays have had
    inside rims, as `rooms` has it, below 0 where one stopped them.
    ``source``: the point (X, Y, Z, W) at (X, Y, Z)/W in the axes of the lens, mm, where all rays come from, if known.
    """

    def __init__(self, place: np.ndarray, ray: np.ndarray, wavelength_um: FloatOrArray):
        self.place, self.ray = place, ray
        self.x, self.y, self.z = place
        self.p, self.q, self.r = ray
        self.path = np.zeros(place.shape[1:])
        self.transmission: FloatOrArray = 1.0
        self.dimmed = 0
        self.status = np.zeros(place.shape[1:], np.int8)
        self.failed_surface = np.zeros(place.shape[1:], np.int16)
        self.exempt = 0
        self.clearance: FloatOrArray = inf
        self.source: tuple[FloatOrArray, FloatOrArray, FloatOrArray, FloatOrArray] | None = None
        self.wavelength_um = wavelength_um

    def advance(self, step: np.ndarray, index: FloatOrArray) -> None:
        """Move every ray by the ray parameter ``step`` in a medium of this index."""
        self.place += step * self.ray
        self.path += step * (index * index)

    def fail(self, bad: np.ndarray, why: Status, number: int) -> None:
        """Record why and where rays fail and make them NaN; a ray keeps its first reason."""
        fresh = bad & (self.status == Status.PASSED)
        if not fresh.any():
            return
        self.status[fresh], self.failed_surface[fresh] = why, number
        self.p[fresh] = self.path[fresh] = np.nan


class Normal(NamedTuple):
    """Surface normal (−slope·x, −slope·y, axial), not normalised, where the rays meet the surface.

    ``axial`` None stands for 1 − slope·z, a sphere's. ``square`` is the normal's squared length, None for 1.
    ``along`` = ray·normal = n·cosI·length, and ``along_square`` its square. ``uneven``: (2, …) what parts
    that are not of revolution add to ∂z/∂x and ∂z/∂y, to be taken from the normal as well.
    """

    slope: np.ndarray | float
    axial: np.ndarray | float | None
    square: np.ndarray | None
    along: np.ndarray
    along_square: np.ndarray
    uneven: np.ndarray | None = None


def to_plane(beam: Beam, index: FloatOrArray) -> None:
    """Carry every ray to the plane z = 0 of the current vertex."""
    back = beam.z / beam.r
    beam.place[:2] -= back * beam.ray[:2]
    beam.z[...] = 0.0
    back *= index * index
    beam.path -= back


def _to_nearest(beam: Beam, index: FloatOrArray) -> None:
    """Carry every ray to its point nearest to the current vertex."""
    beam.advance(-_products(beam.place, beam.ray) / (index * index), index)


def move(beam: Beam, motion: Motion, index: FloatOrArray, number: int) -> None:
    """Give a beam in the axes of ``motion``, those of surface ``number``; a ray that runs away from it misses it."""
    ahead = (3, *(1,) * (beam.place.ndim - 1))
    beam.place -= motion.origin.reshape(ahead)
    if not motion.turns:
        return
    back = motion.rotation.T
    for vectors in (beam.place, beam.ray):
        vectors[...] = (back @ vectors.reshape(3, -1)).reshape(vectors.shape)
    away = beam.r * index <= 0
    if away.any():
        beam.fail(away, Status.MISSED, number)


def meet(beam: Beam, surface: Surface, index: FloatOrArray, number: int) -> Normal | None:
    """Carry every ray to the surface and return its normal there; None for a plane."""
    if len(surface.parts) > 1:
        return _meet_asphere(beam, surface, index, number)
    if surface.curvature:
        return _meet_conic(beam, surface, index, number)
    to_plane(beam, index)
    return None


def _conic_step(
    beam: Beam, curvature: float, conic: float, index: FloatOrArray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Carry every ray near the vertex; return the step to a conicoid, n·cosI·|normal|, its square.

    Of the two intersections, the one where light crosses the sheet through the vertex from front to back; written
    as F/(G + root) it needs no special case for a plane (Welford 1986, §4.3, with optical cosines). Rays at grazing
    incidence meet the plane of the vertex so far away that G² and F would cancel: they start where they are nearest to
    the vertex.
    """
    to_plane(beam, index)
    f = _products(beam.place, beam.place)
    if not curvature * curvature * f.max() <= 1:
        _to_nearest(beam, index)
        f = _products(beam.place, beam.place)
    g = _products(beam.place, beam.ray)
    squeezed = index * index
    if conic:
        f += conic * beam.z * beam.z
        g += conic * beam.z * beam.r
        squeezed = squeezed + conic * beam.r * beam.r
    f *= curvature
    f -= 2 * beam.z
    g *= curvature
    np.subtract(beam.r, g, out=g)
    square = g * g
    square -= f * (curvature * squeezed)
    along = _along_light(np.sqrt(square), index)
    g += along
    f /= g
    return f, along, square


def _products(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the scalar products of vectors, each (3, …)."""
    found: np.ndarray = np.einsum("i...,i...", a, b)
    return found


def _meet_conic(beam: Beam, surface: Surface, index: FloatOrArray, number: int) -> Normal:
    curvature, conic = surface.curvature, surface.conic
    step, along, along_square = _conic_step(beam, curvature, conic, index)
    beam.advance(step, index)
    # Past its equator the sheet through the vertex ends; NaN, a miss, fails this test too.
    depth = beam.z.max() if curvature > 0 else beam.z.min()
    if not curvature * (1 + conic) * depth < 1:
        beam.fail(~(curvature * (1 + conic) * beam.z < 1), Status.MISSED, number)
    if not conic:
        return Normal(curvature, None, None, along, along_square)
    bulge = curvature * beam.z
    # |normal|² on the conicoid, by c²r² = 2cz − c²(1 + K)z².
    return Normal(
        curvature, 1 - (1 + conic) * bulge, 1 - conic * bulge * (2 - (1 + conic) * bulge), along, along_square
    )


class SagMiss(NamedTuple):
    """How far a surface is above rays in z, ray·normal, and what `Normal` takes of its slopes, where rays stand."""

    miss: np.ndarray
    along: np.ndarray
    slope: FloatOrArray
    uneven: np.ndarray | None


def _sag_miss(beam: Beam, surface: Surface) -> SagMiss:
    """Return how far rays are from a surface of several parts; NaN beyond its edge."""
    sag, slope = surface.sag_and_slope(beam.x * beam.x + beam.y * beam.y)
    along = beam.r - 2 * slope * (beam.x * beam.p + beam.y * beam.q)
    uneven = None
    for part in surface.uneven_parts:
        more, gradient = part.sag_and_gradient(beam.x, beam.y, surface.curvature, surface.conic)
        sag, uneven = sag + more, gradient if uneven is None else uneven + gradient
        along = along - (gradient * beam.ray[:2]).sum(0)
    return SagMiss(sag - beam.z, along, slope, uneven)


def _meet_asphere(beam: Beam, surface: Surface, index: FloatOrArray, number: int) -> Normal:
    """Carry rays to a surface of several parts by Newton's method, from the conicoid or, if that is missed, the plane.

    A step beyond the edge is halved. A ray for which it does not converge is refused.
    """
    start, *_ = _conic_step(beam, surface.curvature, surface.conic, index)
    beam.advance(np.where(np.isfinite(start), start, -beam.z / beam.r), index)
    if surface.uneven_parts:
        _within_edge(beam, surface, index)
    step = np.zeros(beam.x.shape)
    for _ in range(NEWTON_STEPS):
        at = _sag_miss(beam, surface)
        size = np.abs(beam.x) + np.abs(beam.y) + np.abs(beam.z)
        if surface.addends_mm:
            size += surface.addends_mm
        open_, beyond = ~(np.abs(at.miss) <= ROUNDING * size), np.isnan(at.miss)
        if not (open_ & ~(beyond & (step == 0))).any():
            break
        onward = np.where(beyond, -step / 2, np.where(open_, at.miss / at.along, 0.0))
        beam.advance(onward, index)
        step = np.where(beyond, step / 2, onward)
    beam.fail(~np.isfinite(at.miss), Status.MISSED, number)
    beam.fail(open_ | ~(at.along > 0 if _forwards(index) else at.along < 0), Status.REFUSED, number)
    slope, uneven = 2 * at.slope, at.uneven
    square = 1 + slope * slope * (beam.x * beam.x + beam.y * beam.y)
    if uneven is not None:
        square = 1 + np.square(slope * beam.place[:2] + uneven).sum(0)
    return Normal(slope, 1.0, square, at.along, at.along * at.along, uneven)


def _beyond_edge(beam: Beam, surface: Surface) -> np.ndarray:
    """Return which rays, of those that have not failed, are where the surface has no sag."""
    beyond: np.ndarray = np.isnan(_sag_miss(beam, surface).miss) & (beam.status == Status.PASSED)
    return beyond


def _within_edge(beam: Beam, surface: Surface, index: FloatOrArray) -> None:
    """Carry rays that meet the plane of the vertex beyond the edge of the surface to where it has a sag, if anywhere.

    A steep ray meets a deep cylinder inside its edge although it crosses that plane outside. Places are tried up to the
    ray's height from the plane, and the nearest is taken.
    """
    if not _beyond_edge(beam, surface).any():
        return
    reach = (np.abs(beam.x) + np.abs(beam.y)) / np.abs(beam.r)
    home, moved = beam.place.copy(), np.zeros(beam.x.shape)
    for share in SHARES:
        lost = _beyond_edge(beam, surface)
        if not lost.any():
            break
        moved = np.where(lost, share * reach, moved)
        beam.place[...] = home + moved * beam.ray
    moved = np.where(_beyond_edge(beam, surface), 0.0, moved)
    beam.place[...] = home
    beam.advance(moved, index)


def refract(beam: Beam, normal: Normal | None, before: FloatOrArray, after: FloatOrArray, number: int) -> None:
    """Bend every ray by Snell's law, n'K' = nK + (n'cosI' − n·cosI)·unit normal (Welford 1986, eq. 4.36)."""
    gain = (after - before) * (after + before)
    if normal is None:
        _along_light(_root(beam, beam.r * beam.r, gain, number, out=beam.r), after)
        return
    if normal.square is None:
        push = _along_light(_root(beam, normal.along_square, gain, number), after)
        push -= normal.along
    else:
        length = np.sqrt(normal.square)
        push = _along_light(_root(beam, normal.along_square / normal.square, gain, number), after)
        push = (push - normal.along / length) / length
    if normal.axial is None:
        beam.r += push
        push *= normal.slope
        beam.ray -= push * beam.place
    else:
        beam.r += push * normal.axial
        if normal.uneven is not None:
            beam.ray[:2] -= push * normal.uneven
        push *= normal.slope
        beam.ray[:2] -= push * beam.place[:2]


def diffract(beam: Beam, normal: Normal | None, diffraction: Phase, after: FloatOrArray, number: int) -> None:
    """Bend every ray by n'K' = nK + (λ/2π)∇φ + Γ·normal, and add λφ/2π to its path (Welford 1975).

    φ is a function of x and y. The normal's multiple Γ follows from |n'K'| = n'; where there is none, the order is
    evanescent.
    """
    phase, gradient = diffraction.phase_and_gradient(beam.x, beam.y)
    unit = WAVES_MM * beam.wavelength_um
    beam.path += unit * phase
    beam.ray[:2] += unit * gradient
    steep, axial, length_square = _complete_normal(beam, normal)
    along = beam.r * axial - (steep * beam.ray[:2]).sum(0)
    gain = after * after - (beam.ray * beam.ray).sum(0)
    length = np.sqrt(length_square)
    root = _root(beam, along * along / length_square, gain, number, why=Status.EVANESCENT)
    push = (_along_light(root, after) - along / length) / length
    beam.r += push * axial
    beam.ray[:2] -= push * steep


def _complete_normal(beam: Beam, normal: Normal | None) -> tuple[np.ndarray, FloatOrArray, FloatOrArray]:
    """Return a normal's −x and −y, (2, …), its axial part and squared length, with what plane and sphere leave out."""
    if normal is None:
        return np.zeros_like(beam.place[:2]), 1.0, 1.0
    axial = 1 - normal.slope * beam.z if normal.axial is None else normal.axial
    steep = normal.slope * beam.place[:2]
    if normal.uneven is not None:
        steep = steep + normal.uneven
    return steep, axial, 1.0 if normal.square is None else normal.square


def _along_light(values: np.ndarray, index: FloatOrArray) -> np.ndarray:
    """Return ``values``, changed in sign in place where light runs to the left."""
    return values if _forwards(index) else np.negative(values, out=values)


def _forwards(index: FloatOrArray) -> bool:
    return index > 0 if isinstance(index, float) else bool(np.all(index > 0))


def _root(
    beam: Beam,
    cosine_square: np.ndarray,
    gain: FloatOrArray,
    number: int,
    out: np.ndarray | None = None,
    why: Status = Status.REFLECTED,
) -> np.ndarray:
    """Return n'cosI' = √(n²cos²I + n'² − n²); where that is not real the ray fails, and ``why`` says how."""
    square: np.ndarray = cosine_square + gain
    if not square.min() >= 0:
        beam.fail(square < 0, why, number)
    root: np.ndarray = np.sqrt(square, out=square if out is None else out)
    return root


def clip(beam: Beam, radius: float, rim: Rim | None, number: int) -> None:
    """Stop every ray that lands outside the rim of a surface: a circle of ``radius`` mm, or the rectangle it is."""
    for why, room in rooms(beam, radius, rim):
        _keep_inside(beam, room, why, number)


def clip_inside(beam: Beam, radius: float, rim: Rim | None, number: int) -> None:
    """Stop every ray that lands in a hole or a shadow."""
    _keep_inside(beam, -circle_room(beam, radius, rim), Status.CLIPPED, number)


def transmit(beam: Beam, transmission: Transmission, number: int) -> None:
    """Take from every ray what a surface does not transmit; below 0 where one has transmitted nothing."""
    share = transmission.at(beam.x * beam.x + beam.y * beam.y)
    beam.transmission = np.minimum(share, share * beam.transmission)
    if transmission.per_mm2 < 0:
        beam.dimmed = number


def stop_in_the_dark(beam: Beam) -> None:
    """Stop every ray at the sensor that a surface has not transmitted, as a rim does."""
    if beam.dimmed:
        room = np.asarray(beam.transmission)
        _keep_inside(beam, room, Status.OPAQUE, beam.dimmed)
        beam.transmission = np.maximum(room, 0.0)


def rooms(beam: Beam, radius: float, rim: Rim | None) -> tuple[tuple[Status, np.ndarray], ...]:
    """Return how far inside a rim rays land, a share of its radius or half-width squared, and what stops others."""
    if not (rim and rim.half_widths):
        return ((Status.CLIPPED, circle_room(beam, radius, rim)),)
    (x, y), (wide, high) = rim.about_centre(beam.x, beam.y), rim.half_widths
    return (Status.CLIPPED_BESIDE, 1 - np.square(x / wide)), (Status.CLIPPED, 1 - np.square(y / high))


def circle_room(beam: Beam, radius: float, rim: Rim | None) -> np.ndarray:
    """Return how far inside a circle of ``radius`` mm about the centre of a rim rays land, a share of its square."""
    x, y = rim.about_centre(beam.x, beam.y) if rim else (beam.x, beam.y)
    room: np.ndarray = 1 - (x * x + y * y) / (radius * radius)
    return room


def _keep_inside(beam: Beam, room: np.ndarray, why: Status, number: int) -> None:
    """Stop every ray that has no room at a rim, and note the least that the others have."""
    beam.clearance = np.fmin(beam.clearance, room)
    lost = room < 0
    lost[..., lost.shape[-1] - beam.exempt :] = False
    if lost.any():
        beam.fail(lost, why, number)
