"""Where rims, holes, shadows and lost rays end the pupil of a source, as closed curves over the stop.

A rim lies on a surface and moves over the pupil with the field. How far inside it rays land is a smooth function over
the stop, known from one trace where no ray is lost and polynomials describe it: its curve is then found on these, its
corners by Newton's method. Elsewhere bisection on real rays finds both. The clear part must be star-shaped about its
centre, as every overlap of rims seen through a lens is.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from p2sf.disc.clear_radius import Clearance, clear_radius
from p2sf.disc.disc_function import DiscFunction
from p2sf.disc.mask import WHOLE_STOP
from p2sf.disc.star_curve import StarCurve, changes_of, curve_between
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, Surface, seen_from
from p2sf.lens.source import Source
from p2sf.raytrace.aiming import Sources, pupil_rays, start
from p2sf.raytrace.pencil import hexapolar
from p2sf.raytrace.surface import BESIDE, Beam, Status, circle_room, ended_at, rooms, stop_in_the_dark
from p2sf.raytrace.trace import lens_rims, run

SEARCH_RINGS = 12
HOLE_RINGS = 24
SCAN = 192  # directions to half a turn between which corners are sought: a shorter arc may be missed
CORNER_STEPS = 7  # a corner's direction to 6e-11
CROSSING_STEPS = 5  # of Newton's method from 1/192 of half a turn or less
CROSSING_DIFFERENCE = 1e-5  # of the pupil's radius
CROSSING_FARTHEST = 1.1  # in the pupil's radius
CROSSING_ENOUGH = 1e-9  # of the last step, which leaves a hundred-thousandth of itself
COUNTS = 16, 48  # of the nodes through which rooms are laid: 1e-12 in most lenses, far beyond their rims too
TESTED = 24  # directions in which rays on the pupil's rim test that
SMOOTH = 1e-10  # what they may depart by, a share of a rim's radius squared
NEVER = 0.01  # room at all nodes: such a rim ends nothing
AXIS_POINTS, SECANTS = 65, 6
PUPIL_RIM = 0  # denotes it among the surfaces
HOLE = 1_000_000  # and what a hole or a shadow adds to its surface
CLIPPED = "the rims clip every ray of this field; leave {parameter} off or reduce the field"
LOST = "no ray but the chief ray reaches the sensor; stop the lens down or reduce the field"


@dataclass(frozen=True)
class ClearRegion:
    """The part of the pupil whose rays reach the sensor, with ``clip`` within rims, and within one ``hole`` if any.

    ``lens``: as the source sees it; its holes stop no rays here.
    """

    lens: Lens
    source: Source
    clip: bool
    hole: int = 0

    def holds(self, xi: np.ndarray, eta: np.ndarray) -> Clearance:
        """Return which points lie in the region, how far as `clear_radius` has it, and what ends others, by rays."""
        rays = pupil_rays(self.lens, self.source, xi, eta)
        beam, inside = start(rays), np.full(np.shape(xi), np.inf)
        beam.exempt = 0
        rims = lens_rims(self.lens, keep_stop=False) if self.clip else None

        def visit(number: int) -> None:
            if number == self.hole:
                surface = self.lens.surfaces[number - 1]
                inside[:] = circle_room(beam, surface.inner_radius, surface.rim)

        run(without_holes(self.lens), beam, rays.index, rims, visit=visit if self.hole else None)
        stop_in_the_dark(beam)
        passed, label = beam.status == Status.PASSED, ended_at(beam.status, beam.failed_surface)
        label = np.where(passed & ~(inside > 0), HOLE + self.hole, label)
        passed, room = passed & (inside > 0), np.fmin(beam.clearance, inside)
        return passed, np.where(passed == (room >= 0), room, np.nan), label

    def rooms(self, xi: np.ndarray, eta: np.ndarray) -> "Rooms":
        """Return the rooms of rays through pupil points."""
        return trace_rooms(self.lens, self.source, xi, eta).of(self.hole)


@dataclass(frozen=True, eq=False)
class Rooms:
    """How far inside rims and holes rays land, at the points ``xi`` and ``eta`` of them, (labels, points).

    ``labels``: of each, as `ended_at` has them. ``whole``: none of the rays is lost elsewhere.
    """

    labels: tuple[int, ...]
    room: np.ndarray
    whole: bool

    def of(self, hole: int) -> "Rooms":
        """Return those of the rims alone, or of them and of the inside of a hole."""
        used = [k for k, label in enumerate(self.labels) if label < HOLE or label == HOLE + hole]
        labels = np.array(self.labels, int)[used]
        room = np.where(labels < HOLE, 1.0, -1.0)[:, None] * self.room[used]
        return Rooms(tuple(labels.tolist()), room, self.whole)


@dataclass(frozen=True, eq=False)
class SmoothRooms:
    """Rooms as functions over the stop, (labels,)."""

    labels: tuple[int, ...]
    functions: DiscFunction

    def at(self, xi: np.ndarray, eta: np.ndarray) -> Rooms:
        """Return the rooms at points."""
        return Rooms(self.labels, self.functions.at(xi, eta), True)

    def holds(self, xi: np.ndarray, eta: np.ndarray) -> Clearance:
        """Return the `Clearance` of points of the disc."""
        if not self.labels:
            return np.ones(xi.shape, bool), np.ones(xi.shape), np.zeros(xi.shape, int)
        room = self.functions.at(xi, eta)
        least = room.min(0)
        return least >= 0, least, np.array(self.labels)[room.argmin(0)]


def clear_curve(lens: Lens, source: Source, clip: bool = True) -> StarCurve:
    """Return where the clear part of the pupil ends, holes and shadows left out of account.

    Without ``clip`` that is where rays miss a surface or are totally reflected, not at rims. Raises GeometryError when
    no part is clear.
    """
    found = curve_of(ClearRegion(seen_from(lens, source.azimuth_deg), source, clip))
    if found is None:
        raise GeometryError(CLIPPED if clip else LOST, parameter="clip")
    return found


def hole_curves(lens: Lens, source: Source) -> tuple[StarCurve, ...]:
    """Return where the holes and shadows that end rays lie in the clear part of the pupil."""
    whole = ClearRegion(seen_from(lens, source.azimuth_deg), source, True)
    curves = (curve_of(replace(whole, hole=number)) for number in holes_of(lens))
    return tuple(curve for curve in curves if curve is not None)


def holes_of(lens: Lens) -> tuple[int, ...]:
    """Return the surfaces with a hole or a shadow, from 1."""
    return tuple(number for number, surface in enumerate(lens.surfaces, 1) if surface.inner_radius > 0)


def without_holes(lens: Lens) -> Lens:
    """Return the lens with its holes closed, and without what casts a shadow."""
    return (
        replace(lens, surfaces=tuple(replace(s, inner_radius=0.0) for s in lens.surfaces)) if holes_of(lens) else lens
    )


@lru_cache(maxsize=64)
def curve_of(region: ClearRegion) -> StarCurve | None:
    """Return where a region ends; None if it is empty. Raises GeometryError if its middle is not in it."""
    smooth = smooth_rooms(region) if region.clip else None
    holds, domain = smooth.holds if smooth else region.holds, region.lens.pupil_domain
    middle = _middle(region, holds)
    if middle is None:
        return None

    def edge(theta: np.ndarray, guess: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
        return _edge(holds, middle, theta, guess)

    theta = domain.neighbours(domain.directions(SCAN))
    radius, label = edge(theta)
    corners = _crossings(smooth.at if smooth else region.rooms, middle, theta, radius, label) if region.clip else None
    if corners is None:
        corners = changes_of(lambda angle: edge(angle)[1], theta, label, CORNER_STEPS)

    def near(angle: np.ndarray) -> np.ndarray:
        return edge(angle, np.interp(angle, theta, radius, period=None if domain.symmetric else 2 * np.pi))[0]

    return curve_between(near, middle, domain.between(corners.tolist()), domain)


def _middle(region: ClearRegion, holds: Callable[[np.ndarray, np.ndarray], Clearance]) -> tuple[float, float] | None:
    """Return a point well inside a region: the image of the axis of its hole, else the mean of its points."""
    axial = _axis_of(region) if region.hole else None
    if axial is not None and holds(*np.array(axial)[:, None])[0].all():
        return axial
    xi, eta = hexapolar(HOLE_RINGS if region.hole else SEARCH_RINGS)
    passed = holds(xi, eta)[0]
    if not passed.any():
        return None
    middle = region.lens.pupil_domain.middle(xi[passed], eta[passed])
    if not holds(*np.array(middle)[:, None])[0].all():
        raise GeometryError(
            "the clear part of the pupil has no clear centre; leave {parameter} off or reduce the field",
            parameter="clip",
        )
    return middle


def _axis_of(region: ClearRegion) -> tuple[float, float] | None:
    """Return the pupil point on ξ = 0 whose ray meets the axis on the surface of the hole; None if there is none."""

    def height(eta: np.ndarray) -> np.ndarray:
        rays = pupil_rays(region.lens, region.source, 0 * eta, eta)
        y: np.ndarray = run(region.lens, start(rays), rays.index, last=region.hole).y
        return y

    eta = np.linspace(-1, 1, AXIS_POINTS)
    y = height(eta)
    change = np.flatnonzero(np.diff(np.sign(y)) != 0)
    if not change.size:
        return None
    low, high = eta[change[0]], eta[change[0] + 1]
    for _ in range(SECANTS):
        ends = height(np.array([low, high]))
        if ends[0] == ends[1]:
            break
        low, high = high, float(np.clip(low - ends[0] * (high - low) / (ends[1] - ends[0]), -1, 1))
    return 0.0, float(high)


def _edge(
    holds: Callable[[np.ndarray, np.ndarray], Clearance],
    middle: tuple[float, float],
    theta: np.ndarray,
    guess: np.ndarray | None,
) -> tuple[np.ndarray, np.ndarray]:
    """Return how far a region reaches from its middle at angles, and what ends it, `PUPIL_RIM` at the disc's own.

    ``guess``: as `clear_radius` has it.
    """
    sine, cosine, (aside, up) = np.sin(theta), np.cos(theta), middle
    outer = WHOLE_STOP.distance(np.array(aside), np.array(up), sine, cosine)

    def clearance(radius: np.ndarray, some: np.ndarray) -> Clearance:
        return holds(aside + radius * sine[some], up + radius * cosine[some])

    return clear_radius(clearance, outer, guess)


def smooth_rooms(region: ClearRegion) -> SmoothRooms | None:
    """Return the rooms that end anything; None where rays are lost or polynomials do not describe them."""
    domain = region.lens.pupil_domain
    nodes, turn = domain.nodes(COUNTS), domain.directions(TESTED)
    rim = np.sin(turn), np.cos(turn)
    found = region.rooms(np.append(nodes.xi, rim[0]), np.append(nodes.eta, rim[1]))
    if not found.whole:
        return None
    some = np.flatnonzero(found.room.min(1) < NEVER)
    values, tested = np.split(found.room[some], [nodes.xi.size], axis=1)
    functions = DiscFunction(values, COUNTS, (False,) * some.size, domain)
    if some.size and not np.abs(functions.at(*rim) - tested).max() < SMOOTH:
        return None
    return SmoothRooms(tuple(found.labels[k] for k in some), functions)


def trace_rooms(lens: Lens, source: Source | Sources, xi: np.ndarray, eta: np.ndarray) -> Rooms:
    """Return the rooms of rays through pupil points that no rim stops, of holes outside them.

    The axes of `Sources` come first: (…, labels, points). Raises GeometryError for a lens without rims.
    """
    rays, limits = pupil_rays(lens, source, xi, eta), lens_rims(lens, keep_stop=False)
    beam, found, labels = start(rays), list[np.ndarray](), list[int]()

    def visit(number: int) -> None:
        if number <= len(lens.surfaces):
            for label, room in _rooms_of(lens.surfaces[number - 1], float(limits[number - 1]), beam):
                labels.append(number + label)
                found.append(room)

    run(lens, beam, rays.index, visit=visit)
    shape = *np.shape(beam.x)[:-1], 0, np.shape(beam.x)[-1]
    whole = not beam.dimmed and bool((beam.status == Status.PASSED).all())
    return Rooms(tuple(labels), np.stack(found, axis=-2) if found else np.empty(shape), whole)


def _rooms_of(surface: Surface, limit: float, beam: Beam) -> list[tuple[int, np.ndarray]]:
    """Return the rooms of a surface, its hole's last, and by how much what they end differs from its number."""
    found = []
    if np.isfinite(limit) or (surface.rim and surface.rim.half_widths):
        found += [(BESIDE * (why == Status.CLIPPED_BESIDE), room) for why, room in rooms(beam, limit, surface.rim)]
    if surface.inner_radius:
        found.append((HOLE, -circle_room(beam, surface.inner_radius, surface.rim)))
    return found


def _crossings(
    rooms_at: Callable[[np.ndarray, np.ndarray], Rooms],
    middle: tuple[float, float],
    theta: np.ndarray,
    radius: np.ndarray,
    label: np.ndarray,
) -> np.ndarray | None:
    """Return the directions of the points that have no room at either rim that ends a neighbour of theirs.

    ``radius``, ``label``: as `_edge` returns them at ``theta``. By Newton's method from midway; None where that leads
    to no such point, as where rays are lost at one of the two.
    """
    change = np.flatnonzero(np.diff(label))
    if not change.size:
        return np.empty(0)
    labels, (low, high) = np.stack([label[change], label[change + 1]]), (theta[change], theta[change + 1])
    far, angle = (radius[change] + radius[change + 1]) / 2, (low + high) / 2
    xi, eta = middle[0] + far * np.sin(angle), middle[1] + far * np.cos(angle)
    step = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])[:, :, None] * CROSSING_DIFFERENCE
    for _ in range(CROSSING_STEPS):
        if not (np.hypot(xi, eta) < CROSSING_FARTHEST).all():
            return None
        beside = (xi + step[0]).ravel(), (eta + step[1]).ravel()
        rooms = rooms_at(*beside)
        known = PUPIL_RIM, *rooms.labels
        if not np.isin(labels, known).all():
            return None
        rows = np.array([[known.index(one) for one in some] for some in labels.tolist()])
        room = np.concatenate([(1 - beside[0] ** 2 - beside[1] ** 2)[None], rooms.room]).reshape(-1, 3, change.size)
        here, right, up = (np.take_along_axis(part, rows, axis=0) for part in room.swapaxes(0, 1))
        (a, c), (b, d) = (right - here) / CROSSING_DIFFERENCE, (up - here) / CROSSING_DIFFERENCE
        area, before = a * d - b * c, (xi, eta)
        with np.errstate(invalid="ignore", divide="ignore"):
            xi, eta = xi - (d * here[0] - b * here[1]) / area, eta - (a * here[1] - c * here[0]) / area
    moved = np.hypot(xi - before[0], eta - before[1])
    found = np.arctan2(xi - middle[0], eta - middle[1])
    found += 2 * np.pi * np.round((angle - found) / (2 * np.pi))
    good = (moved < CROSSING_ENOUGH) & (room[:, 0].min(0) > -CROSSING_ENOUGH) & (low <= found) & (found <= high)
    return found if good.all() else None
