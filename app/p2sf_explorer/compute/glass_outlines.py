"""The glass of a lens as closed outlines in mm, z from the first vertex, which no slider moves. No Qt in here."""

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from math import isfinite

import numpy as np

from p2sf.disc.mask import CLEAR
from p2sf.lens.lens import Aperture, Lens, Surface, indices, with_mask, with_sensor
from p2sf.lens.misalignment import straighten
from p2sf.lens.placement import Motion
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import needed_radii
from p2sf.raytrace.aiming import pupil_rays
from p2sf.raytrace.surface import Status
from p2sf.raytrace.trace import trace

PROFILE_POINTS = 33
GLASS_INDEX = 1.0001  # less than this is air
SAME_PLACE_MM = 1e-6
FLANGE = 1.1  # how much wider than its neighbour's edge a cemented element is drawn


Profile = tuple[np.ndarray, np.ndarray]
"""z and y of a line, mm."""


@dataclass(frozen=True)
class GlassOutline:
    """One closed region of glass: z and y in mm, its index, and the surfaces (from 1) before and behind it."""

    z: np.ndarray
    y: np.ndarray
    index: float
    surfaces: tuple[int, int]


@dataclass(frozen=True)
class Glass:
    """Outlines of the elements, mirrors, ideal lenses, the last surface's profile, the index behind it, the extent."""

    outlines: tuple[GlassOutline, ...]
    mirrors: tuple["MirrorProfile", ...]
    ideal: tuple["IdealProfile", ...]
    last: Profile
    image_index: float
    half_height: float
    left: float
    right: float


@dataclass(frozen=True)
class MirrorProfile:
    """The section of a mirror: z and y in mm; ``behind`` is 1 where its back lies to the right, else −1."""

    z: np.ndarray
    y: np.ndarray
    behind: int


@dataclass(frozen=True)
class IdealProfile:
    """An ideal lens: its place and half its height in mm; ``gathers`` where its focal length is positive."""

    z: float
    half: float
    gathers: bool


@lru_cache(maxsize=8)
def still(lens: Lens) -> Lens:
    """Return the lens without what sliders change: sensor at 1 mm, no mask, and one aperture where rims are known."""
    placed = with_mask(with_sensor(lens, 1.0), CLEAR)
    if not all(isfinite(surface.semi_diameter) for surface in lens.surfaces):
        return placed
    return replace(placed, aperture=Aperture("stop_semi_diameter", 1.0))


@dataclass(frozen=True)
class Section:
    """The plane x = 0 of some axes, as it is drawn: the place of their origin, mm, and z and y of their z and y."""

    z: float = 0.0
    y: float = 0.0
    along_z: tuple[float, float] = (1.0, 0.0)
    along_y: tuple[float, float] = (0.0, 1.0)

    @classmethod
    def of(cls, frame: Motion) -> "Section":
        """Return that of axes in those of the lens, seen along x."""
        turn, (_, y, z) = frame.rotation, frame.origin.tolist()
        return cls(z, y, (float(turn[2, 2]), float(turn[1, 2])), (float(turn[2, 1]), float(turn[1, 1])))

    def placed(self, z: np.ndarray | float, y: np.ndarray | float) -> Profile:
        """Return z and y in the drawing of points of the plane."""
        (zz, yz), (zy, yy) = self.along_z, self.along_y
        return np.asarray(self.z + zz * z + zy * y), np.asarray(self.y + yz * z + yy * y)


UPRIGHT = Section()
PLANE = Surface()


@lru_cache(maxsize=64)
def sections(lens: Lens) -> tuple[Section, ...]:
    """Return where every surface and the sensor stand in the drawing."""
    return tuple(Section.of(frame) for frame in lens.frames)


def _own_profile(surface: Surface, rim: float) -> Profile:
    """Return the section of a surface in its own axes; of a mirror with a decentred rim between the ends of that."""
    if surface.rim is None or not surface.reflects:
        return profile(surface, 0.0, rim)
    half = min(surface.rim.half_widths[1] if surface.rim.half_widths else rim, rim)
    y = surface.rim.decentre[1] + np.linspace(-half, half, PROFILE_POINTS)
    return sag(surface, y), y


def _back(place: Section, direction: int) -> int:
    """Return 1 where the back of a mirror lies to the right in the drawing, else −1."""
    return direction if place.along_z[0] >= 0 else -direction


@lru_cache(maxsize=32)
def glass_of(lens: Lens) -> Glass:
    """Return the outlines of a `still` lens, seen along x; real sag, to the clear rims."""
    rims, places = drawn_rims(lens), sections(lens)
    index = np.abs(indices(lens, lens.reference_wavelength_um))
    own = [_own_profile(surface, rim) for surface, rim in zip(lens.surfaces, rims, strict=False)]
    outlines = []
    for i, (front, back) in enumerate(pairwise(own)):
        if index[i + 1] > GLASS_INDEX and rims[i] > 0 and not crossed_before(lens, i):
            behind = Section.of(lens.motions[i + 1]).placed(*back)
            made = element_outline(front, behind, float(index[i + 1]), (i + 1, i + 2))
            outlines.append(GlassOutline(*places[i].placed(made.z, made.y), made.index, made.surfaces))
    profiles = [place.placed(*line) for place, line in zip(places, own, strict=False)]
    mirrors = tuple(
        MirrorProfile(*line, _back(place, direction))
        for line, surface, direction, place in zip(profiles, lens.surfaces, lens.directions, places, strict=False)
        if surface.reflects
    )
    ideal = tuple(
        IdealProfile(place.z, rim, surface.ideal_focal_length > 0)
        for surface, place, rim in zip(lens.surfaces, places, rims, strict=False)
        if surface.ideal
    )
    every = [*profiles, *((outline.z, outline.y) for outline in outlines)]
    ends = float(min(z.min() for z, _ in every)), float(max(z.max() for z, _ in every))
    high = max(float(abs(y).max()) for _, y in every)
    return Glass(tuple(outlines), mirrors, ideal, profiles[-1], float(index[-1]), high, *ends)


def last_end(lens: Lens) -> float:
    """Return how far behind its vertex, mm, the last surface ends."""
    return float(profile(lens.surfaces[-1], 0.0, drawn_rims(still(lens))[-1])[0].max())


def crossed_before(lens: Lens, at: int) -> bool:
    """Return whether light crosses the glass behind surface ``at``, from 0, on its way back through an element."""
    return any(
        _same_place(lens, at, other + 1)
        and _same_place(lens, at + 1, other)
        and lens.media[other + 1] == lens.media[at + 1]
        for other in range(at)
    )


def _same_place(lens: Lens, one: int, other: int) -> bool:
    return bool(np.abs(lens.frames[one].origin - lens.frames[other].origin).max() <= SAME_PLACE_MM)


def filling(glass: Glass, sensor: Section, shape: Surface) -> tuple[GlassOutline, ...]:
    """Return the outline of what fills the space between lens and sensor, none for air."""
    if glass.image_index <= GLASS_INDEX:
        return ()
    wall = sensor.placed(*profile(shape, 0.0, glass.half_height))
    return (element_outline(glass.last, wall, glass.image_index, (len(glass.outlines) + 1,) * 2),)


@lru_cache(maxsize=32)
def widest_exit(lens: Lens) -> tuple[float, float]:
    """Return height and slope behind the last surface of the file's widest field's chief ray; zeros where it fails."""
    slope = float(np.tan(np.deg2rad(lens.widest_field_deg)))
    rays = pupil_rays(lens, Source(np.inf, slope, lens.reference_wavelength_um), np.zeros(1), np.zeros(1))
    found = trace(lens, rays.origins, rays.directions, lens.reference_wavelength_um)
    if found.status.item() != Status.PASSED:
        return 0.0, 0.0
    _, y, z = found.points[-2].reshape(3).tolist()
    _, along_y, along_z = found.cosines.reshape(3).tolist()
    turned = along_y / along_z
    return y - turned * (z - vertices(lens)[-2]), turned


def vertices(lens: Lens) -> list[float]:
    """Return z of every vertex in mm, the first at 0, then the sensor's."""
    return [*lens.vertices]


def drawn_rims(lens: Lens) -> tuple[float, ...]:
    """Return the half-heights to draw the surfaces of a lens with: those of the lens set straight."""
    return clear_rims(straighten(lens))


@lru_cache(maxsize=32)
def clear_rims(lens: Lens) -> tuple[float, ...]:
    """Return a half-height to draw for each surface: its clear rim, or what the widest field's rays need."""
    rims = [
        s.semi_diameter if isfinite(s.semi_diameter) else 1.05 * n
        for s, n in zip(lens.surfaces, needed_radii(lens), strict=True)
    ]
    kept = [float(_inside_surface(s, r)) for s, r in zip(lens.surfaces, rims, strict=True)]
    return tuple(with_edges(lens, kept))


def with_edges(lens: Lens, rims: list[float]) -> list[float]:
    """Return the rims, lower where an element would have no edge left; what is cemented to it is lowered with it."""
    index = indices(lens, lens.reference_wavelength_um)[1:-1]
    elements = [at for at, n in enumerate(index) if abs(n) > GLASS_INDEX]
    kept = list(rims)
    for at in elements:
        edge = sharp_edge(lens.surfaces[at], lens.gaps[at], lens.surfaces[at + 1], max(kept[at : at + 2]))
        kept[at : at + 2] = (min(rim, edge) for rim in kept[at : at + 2])
    for at in (*elements, *elements[::-1]):
        for low, other in ((at, at + 1), (at + 1, at)):
            if kept[low] < rims[low]:
                kept[other] = min(kept[other], FLANGE * kept[low])
    return kept


def sharp_edge(front: Surface, gap: float, back: Surface, rim: float) -> float:
    """Return the height where an element of stated rims would have no thickness left; the rim if it has some there.

    A file may state rims that no glass could have: drawn to them, its surfaces would cross.
    """
    y = np.linspace(0.0, rim, 4 * PROFILE_POINTS)
    reach = [np.minimum(y, _inside_surface(surface, rim)) for surface in (front, back)]
    along = -1 if gap < 0 else 1  # on the way back from a mirror the back surface lies to the left
    gone = np.flatnonzero(along * (gap + sag(back, reach[1]) - sag(front, reach[0])) < 0)
    return float(y[gone[0]]) if gone.size else rim


def _inside_surface(surface: Surface, rim: float) -> float:
    """Return the rim, kept inside the height where a closed conic ends: (1 + K)c²r² = 1."""
    closing = (1 + surface.conic) * surface.curvature**2
    return rim if closing <= 0 else min(rim, 0.999 / np.sqrt(closing))


def profile(surface: Surface, vertex: float, rim: float) -> Profile:
    """Return z and y of a surface's meridional section from −rim to rim."""
    y = np.linspace(-rim, rim, 2 if surface.flat else PROFILE_POINTS)
    return vertex + sag(surface, y), y


def sag(surface: Surface, y: np.ndarray, x: np.ndarray | float = 0.0) -> np.ndarray:
    """Return the sag of a surface, mm; beyond the edge of its conic, where there is none, that of the edge."""
    inside = _inside_surface(surface, np.inf)
    if np.isfinite(inside):
        held = np.minimum(1.0, inside / np.maximum(np.hypot(x, y), inside))
        x, y = x * held, y * held
    return np.asarray(surface.sag(x, y))


def element_outline(front: Profile, back: Profile, index: float, surfaces: tuple[int, int]) -> GlassOutline:
    """Return the closed outline between two profiles; the narrower one gets a flat rim up to the wider."""
    (z1, y1), (z2, y2) = front, back
    rim = max(y1[-1], y2[-1])
    z = np.concatenate([z1, [z1[-1], z2[-1]], z2[::-1], [z2[0], z1[0], z1[0]]])
    y = np.concatenate([y1, [rim, rim], y2[::-1], [-rim, -rim, y1[0]]])
    return GlassOutline(z, y, index, surfaces)
