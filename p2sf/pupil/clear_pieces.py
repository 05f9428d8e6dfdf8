"""Pupil nodes over the open part of a mask bounded by rims, holes of mirrors and shadows, as signed pieces.

A hole or a shadow lies on a surface and moves over the pupil with the field. Its image in the pupil is found like that
of a rim (`vignetting`): by bisection on real rays, along directions from a point inside. The open part is the clear
part without holes, minus its intersection with each hole, plus those with two of them, and so on. Each of these pieces
must be star-shaped about its centre, as overlaps of rims seen through a lens are.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import combinations, pairwise
from math import ceil, cos, pi, sin, tan

import numpy as np

from p2sf.disc.domain import ClearNodes, Piece, PupilDomain
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.disc.mask_nodes import FEWEST_ACROSS, circle_exit, corners_of_disc, join_pieces, ring_count, strip
from p2sf.disc.open_part import StarCurve
from p2sf.disc.quadrature import gauss_legendre
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, seen_from
from p2sf.lens.source import Source
from p2sf.pupil.clear_radius import Clearance, clear_radius
from p2sf.raytrace.aiming import pupil_rays, start
from p2sf.raytrace.pencil import hexapolar
from p2sf.raytrace.surface import Status, circle_room, ended_at, stop_in_the_dark
from p2sf.raytrace.trace import lens_rims, run

SEARCH_RINGS = 24
SCAN = 384  # directions around the whole circle between which corners are sought
SECTIONS = 16  # sections of the interval of a corner in one step: so few rays cost no more than one
CORNER_STEPS = 4  # its direction to 3e-7: the radius is continuous there, and the sum good to the square
FEWEST_PER_ARC = 8
GAUSS_EXCESS = 1.5  # Gauss–Legendre nodes per uniform direction for the same harmonics: some π/2
AXIS_POINTS, SECANTS = 65, 6
TRIED_ALONG = 24  # points of a vane at which crossings with a hole are sought
OBSCURATION = 0  # denotes the mask's own obscuration among the surfaces with holes
LEFT_HOLE, LEFT_OBSCURATION = 1000, -1000  # labels of what ends a radius, in addition to surfaces and blades
CLIPPED = "the rims clip every ray of this field; leave {parameter} off or reduce the field"
LOST = "no ray but the chief ray reaches the sensor; stop the lens down or reduce the field"


@dataclass(frozen=True)
class ClearRegion:
    """The part of the pupil whose rays reach the sensor and pass ``within`` every hole of these surfaces.

    ``lens``, whose holes do not block rays here, and ``mask``: as the source sees them.
    """

    lens: Lens
    source: Source
    clip: bool
    mask: PupilMask
    within: tuple[int, ...] = ()

    @property
    def domain(self) -> PupilDomain:
        """Return the part that determines the rest: half of it if lens and mask are symmetric."""
        return self.lens.pupil_domain.behind(self.mask.domain)

    def holds(self, xi: np.ndarray, eta: np.ndarray) -> Clearance:
        """Return which points of the iris lie in the region, how far as `clear_radius` has it, and what ends others."""
        rays = pupil_rays(self.lens, self.source, xi, eta)
        beam, shaded = start(rays), dict[int, np.ndarray]()
        beam.exempt = 0
        rims = lens_rims(self.lens, keep_stop=False) if self.clip else None

        def visit(number: int) -> None:
            if number in self.within:
                surface = self.lens.surfaces[number - 1]
                shaded[number] = circle_room(beam, surface.inner_radius, surface.rim)

        run(without_holes(self.lens), beam, rays.index, rims, visit=visit)
        stop_in_the_dark(beam)
        passed, label = beam.status == Status.PASSED, ended_at(beam.status, beam.failed_surface)
        room = np.asarray(beam.clearance)
        for number, inside in shaded.items():
            label = np.where(passed & ~(inside > 0), LEFT_HOLE + number, label)
            passed, room = passed & (inside > 0), np.fmin(room, inside)
        return passed, np.where(passed == (room >= 0), room, np.nan), label

    def limit(
        self, xi: np.ndarray, eta: np.ndarray, sine: np.ndarray, cosine: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return how far points lie from the iris and, where it counts, the obscuration, and a label of which."""
        if self.mask.iris:
            each = np.stack([edge.distance(xi, eta, sine, cosine) for edge in self.mask.edges])
            distance, label = each.min(0), -1 - each.argmin(0)
        else:
            distance = circle_exit(1.0, xi, eta, sine, cosine)
            label = np.zeros(distance.shape, int)
        if OBSCURATION in self.within:
            near = self.mask.disc.chord(xi, eta, sine, cosine)[1]
            label = np.where(near < distance, LEFT_OBSCURATION, label)
            distance = np.minimum(near, distance)
        return distance, label

    def edge(
        self, xi: np.ndarray, eta: np.ndarray, sine: np.ndarray, cosine: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the distance of inner points from the edge of the region along directions, and what ends it."""
        outer, label = self.limit(xi, eta, sine, cosine)

        def clearance(radius: np.ndarray, some: np.ndarray) -> Clearance:
            return self.holds(xi[some] + radius * sine[some], eta[some] + radius * cosine[some])

        radius, ended = clear_radius(clearance, outer)
        return radius, np.where(radius == outer, label, ended)


@dataclass(frozen=True)
class Outline:
    """The centre of a region, and the ends of the intervals of direction, from +η towards +ξ, where it is smooth."""

    xi: float
    eta: float
    corners: tuple[float, ...]


def holes_of(lens: Lens) -> tuple[int, ...]:
    """Return the surfaces with a hole or a shadow, from 1."""
    return tuple(number for number, surface in enumerate(lens.surfaces, 1) if surface.inner_radius > 0)


def without_holes(lens: Lens) -> Lens:
    """Return the lens with its holes closed, and without what casts a shadow."""
    return (
        replace(lens, surfaces=tuple(replace(s, inner_radius=0.0) for s in lens.surfaces)) if holes_of(lens) else lens
    )


def hole_curves(lens: Lens, source: Source, clip: bool, points: int) -> tuple[StarCurve, ...]:
    """Return the images in the pupil of the holes and shadows that end rays; some ``points`` to half a turn each."""
    curves = []
    for number in holes_of(lens) if clip else ():
        region = ClearRegion(seen_from(lens, source.azimuth_deg), source, clip, CLEAR, (number,))
        shape = outline_of(region)
        if shape is not None:
            theta = region.domain.edge_directions(shape.corners, points)
            radius, _ = _along(region, (shape.xi, shape.eta), theta)
            xi, eta = shape.xi + radius * np.sin(theta), shape.eta + radius * np.cos(theta)
            curves.append(StarCurve((shape.xi, shape.eta), *region.domain.closed(xi, eta)))
    return tuple(curves)


def check_without_holes(lens: Lens, clip: bool) -> None:
    """Raise GeometryError where rims clip and a surface has a hole, for what takes the clear part to have none."""
    if clip and holes_of(lens):
        raise GeometryError(
            "surface {surface} has a hole, but this needs a clear part without holes; leave {parameter} off, "
            "or treat the hole as an obscuration of the stop",
            parameter="clip",
            surface=holes_of(lens)[0],
        )


def piece_nodes(lens: Lens, source: Source, counts: tuple[int, int], clip: bool, mask: PupilMask) -> ClearNodes:
    """Return nodes over the part left open by mask, rims, holes and lost rays; GeometryError if nothing is open."""
    region = ClearRegion(seen_from(lens, source.azimuth_deg), source, clip, mask)
    holes = holes_of(lens) if clip else ()
    shadows = (*((OBSCURATION,) if mask.obscured else ()), *holes)
    outline = outline_of(region)
    if outline is None:
        raise GeometryError(CLIPPED if clip else LOST, parameter="clip")
    pieces, empty = [_nodes(region, outline, counts, 1)], list[tuple[int, ...]]()
    for size in range(1, len(shadows) + 1):
        for some in combinations(shadows, size):
            if any(set(none) <= set(some) for none in empty):
                continue
            part = replace(region, within=some)
            shape = outline_of(part)
            if shape is None:
                empty.append(some)
            else:
                pieces.append(_nodes(part, shape, counts, (-1) ** size))
    for angle in mask.vane_angles:
        pieces += _vane(region, holes, angle, counts[0])
    return join_pieces(mask, pieces, region.domain)


@lru_cache(maxsize=64)
def outline_of(region: ClearRegion) -> Outline | None:
    """Return the centre and the corners of a region; None if it is empty."""
    found = _centre(region)
    if found is None:
        return None
    theta = region.domain.neighbours(region.domain.directions(SCAN // 2))
    label = _along(region, found, theta)[1]
    corners = changes_of(lambda angle: _along(region, found, angle)[1], theta, label, CORNER_STEPS).tolist()
    return Outline(*found, region.domain.between(corners))


def changes_of(
    label_at: Callable[[np.ndarray], np.ndarray], theta: np.ndarray, label: np.ndarray, steps: int
) -> np.ndarray:
    """Return the angles at which a label changes, to 1/SECTIONS**steps of the distance between neighbours.

    ``label_at`` gives the labels at angles, (n,); ``label`` those at ``theta``.
    """
    change = np.flatnonzero(np.diff(label))
    low, high, first = theta[change], theta[change + 1], label[change]
    for _ in range(steps if change.size else 0):
        angle = low + (high - low) * (np.arange(SECTIONS + 1) / SECTIONS)[:, None]
        same = label_at(angle[1:-1].ravel()).reshape(SECTIONS - 1, -1) == first
        last, place = np.logical_and.accumulate(same).sum(0), np.arange(change.size)
        low, high = angle[last, place], angle[last + 1, place]
    middle: np.ndarray = (low + high) / 2
    return middle


def _along(region: ClearRegion, centre: tuple[float, float], theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    one = np.ones_like(theta)
    return region.edge(centre[0] * one, centre[1] * one, np.sin(theta), np.cos(theta))


def _centre(region: ClearRegion) -> tuple[float, float] | None:
    """Return a point well inside a region: the image of the axis of a hole, else the mean of its points."""
    xi, eta = hexapolar(SEARCH_RINGS)
    tried = [_middle_of(region, number) for number in region.within]
    for place in (place for place in tried if place is not None):
        if _inside(region, *np.array(place)[:, None])[0]:
            return place
    held = _inside(region, xi, eta)
    if not held.any():
        return None
    middle = region.domain.middle(xi[held], eta[held])
    if not _inside(region, np.array(middle[:1]), np.array(middle[1:]))[0]:
        raise GeometryError(
            "the clear part of the pupil has no clear centre; leave {parameter} off or reduce the field",
            parameter="clip",
        )
    return middle


def _inside(region: ClearRegion, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
    """Return which points of the disc lie in the region, taking iris and obscuration into account."""
    held = region.holds(xi, eta)[0]
    for edge in region.mask.edges:
        held = held & edge.lies_inside(xi, eta)
    if OBSCURATION in region.within:
        held = held & (region.mask.disc.depth(xi, eta) > 0)
    return held


def _middle_of(region: ClearRegion, number: int) -> tuple[float, float] | None:
    """Return the centre of the obscuration, or the pupil point on ξ = 0 whose ray meets the axis on a surface.

    None if there is no such point in the pupil.
    """
    if number == OBSCURATION:
        return region.mask.disc.xi, region.mask.disc.eta

    def height(eta: np.ndarray) -> np.ndarray:
        rays = pupil_rays(region.lens, region.source, 0 * eta, eta)
        y: np.ndarray = run(region.lens, start(rays), rays.index, last=number).y
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


def _nodes(region: ClearRegion, outline: Outline, counts: tuple[int, int], sign: int) -> Piece:
    """Return Gauss–Legendre nodes in ρ² up to the edge of a region, in directions between its corners."""
    angles, steps = [], []
    for low, high in pairwise(outline.corners):
        number = max(FEWEST_PER_ARC, ceil(GAUSS_EXCESS * counts[1] * (high - low) / (2 * pi)))
        node, weight = gauss_legendre(number)
        angles.append((low + high + (high - low) * node) / 2)
        steps.append((high - low) / 2 * weight)
    theta, step = np.concatenate(angles), np.concatenate(steps)
    radius, _ = _along(region, (outline.xi, outline.eta), theta)
    square, weight = gauss_legendre(ring_count(counts[0], float(radius.max())))
    rho = np.sqrt((1 + square) / 2)[:, None] * radius
    area = sign * weight[:, None] / 4 * radius**2 * step / pi
    return (outline.xi + rho * np.sin(theta)).ravel(), (outline.eta + rho * np.cos(theta)).ravel(), area.ravel()


def _vane(region: ClearRegion, shadows: tuple[int, ...], angle: float, radial: int) -> list[Piece]:
    """Return nodes of negative area over a vane outside holes and obscuration, up to the edge of the clear part."""
    half, count, disc = region.mask.vane_width, region.mask.vanes, region.mask.disc
    sine, cosine = sin(angle), cos(angle)
    corners = () if disc.centred else corners_of_disc(region.mask, angle)
    breaks = np.unique(np.round([-half, 0.0, half, *(corner for corner in corners if abs(corner) < half)], 14))
    pieces = []
    for low, high in pairwise(breaks.tolist()):
        node, weight = gauss_legendre(FEWEST_ACROSS + ceil(radial * (high - low) / 2))
        aside = (low + high + (high - low) * node) / 2
        begin = np.abs(aside) / tan(pi / count) if count > 2 else np.zeros_like(aside)
        foot = aside * cosine + begin * sine, -aside * sine + begin * cosine
        directions = sine * np.ones_like(aside), cosine * np.ones_like(aside)
        inner = np.zeros_like(aside)
        for number in shadows:
            shadow = replace(region, within=(number,))
            if _inside(shadow, *foot).any():
                inner = np.maximum(inner, np.where(_inside(shadow, *foot), shadow.edge(*foot, *directions)[0], 0))
        if not region.holds(*foot)[0].all():
            raise GeometryError(
                "vanes meet outside the clear part of the pupil; leave {parameter} off or reduce the field",
                parameter="clip",
            )
        outer = np.maximum(region.edge(*foot, *directions)[0], inner)
        _check_open(region, shadows, foot, directions, (inner, outer))
        near, far = (np.clip(end, inner, outer) for end in disc.chord(*foot, sine, cosine))
        across = weight * (high - low) / 2
        for first, last in ((inner, near), (far, outer)):
            if (last > first).any():
                pieces.append(strip(foot, (sine, cosine), (first, last), across, radial))
    return pieces


def _check_open(
    region: ClearRegion,
    shadows: tuple[int, ...],
    foot: tuple[np.ndarray, np.ndarray],
    directions: tuple[np.ndarray, np.ndarray],
    ends: tuple[np.ndarray, np.ndarray],
) -> None:
    """Raise GeometryError if a vane enters a shadow farther out and so is not a single strip."""
    part = (np.arange(TRIED_ALONG) + 0.5)[:, None] / TRIED_ALONG
    along = ends[0] + (ends[1] - ends[0]) * part
    xi, eta = ((a + along * b).ravel() for a, b in zip(foot, directions, strict=True))
    for number in shadows:
        if _inside(replace(region, within=(number,)), xi, eta).any():
            raise GeometryError(
                "a vane crosses the shadow of surface {surface} away from the centre; leave {parameter} off or remove "
                "the vanes",
                parameter="clip",
                surface=number,
            )
