"""Triangle meshes: elements of revolution with a quarter cut away, stop, sensor. No Qt and no pyvista in here."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise

import numpy as np

from p2sf.disc.mask import PupilMask
from p2sf.disc.mask_nodes import outline_radius
from p2sf.disc.mask_outline import vane
from p2sf.lens.lens import Lens, Surface, indices
from p2sf.lens.placement import Motion, along_z
from p2sf_explorer.compute.glass_outlines import GLASS_INDEX, crossed_before, drawn_rims, sag, still

CUT = (np.pi, 2.5 * np.pi)  # the sweep that remains, from −x over −y and +x to +y: a quarter is cut away
STEPS = 48  # of the sweep
IRIS_STEPS = 270  # of the sweep along an iris's edge: one a degree
RINGS = 12  # of a surface, from axis to rim
PLATE_POINTS = 25  # along a side of a curved sensor

SHELL, SHELL_INDEX = 0.04, 2.0  # of its rim: the thickness of a mirror; its look, that of a dense glass


@dataclass(frozen=True)
class Mesh:
    """Triangles: ``points`` (point, 3) x, y, z in mm; ``faces`` (face, 3) point numbers, counter-clockwise outside."""

    points: np.ndarray
    faces: np.ndarray


@dataclass(frozen=True)
class Element:
    """One piece of glass and its index."""

    mesh: Mesh
    index: float


@lru_cache(maxsize=16)
def elements(lens: Lens) -> tuple[Element, ...]:
    """Return the glass of a lens of `glass_outlines.still` where it stands, a quarter cut away.

    It has its real sag to the clear rims; an element of tilted surfaces is a wedge. A mirror is a thin shell on its
    back, and so is an ideal lens.
    """
    rims, index = drawn_rims(lens), np.abs(indices(lens, lens.reference_wavelength_um))
    found = []
    for i, (front, back) in enumerate(pairwise(lens.surfaces)):
        if index[i + 1] > GLASS_INDEX and rims[i] > 0 and not crossed_before(lens, i):
            found.append(_between(lens, i, (front, rims[i]), (back, rims[i + 1]), float(index[i + 1])))
    for i, surface in enumerate(lens.surfaces):
        if surface.reflects or surface.ideal:
            sides = (surface, 0.0, rims[i]), (surface, lens.directions[i] * SHELL * rims[i], rims[i])
            found.append(Element(place_mesh(element(*sides), lens.frames[i]), SHELL_INDEX))
    return tuple(found)


def filling(lens: Lens) -> tuple[Element, ...]:
    """Return the medium between a lens's last surface and the sensor where it is not air, else nothing."""
    index = abs(float(indices(lens, lens.reference_wavelength_um)[-1]))
    if index <= GLASS_INDEX:
        return ()
    rims = drawn_rims(still(lens))
    return (_between(lens, len(rims) - 1, (lens.surfaces[-1], rims[-1]), (lens.sensor_surface, max(rims)), index),)


def _between(lens: Lens, at: int, front: tuple[Surface, float], back: tuple[Surface, float], index: float) -> Element:
    """Return what lies behind surface ``at``, from 0: both of its sides with the rims they are drawn with."""
    thickness = lens.gaps[at]
    made = element((front[0], 0.0, front[1]), (back[0], thickness, back[1]))
    behind = lens.frames[at + 1].then(along_z(-thickness))
    return Element(wedge(made, lens.frames[at], behind), index)


def place_mesh(mesh: Mesh, frame: Motion) -> Mesh:
    """Return a mesh given in some axes in those of the lens."""
    return Mesh(mesh.points @ frame.rotation.T + frame.origin, mesh.faces)


def wedge(mesh: Mesh, front: Motion, back: Motion) -> Mesh:
    """Return an `element`, whose points are those of its front and then those of its back, each in its own axes."""
    half = len(mesh.points) // 2
    sides = zip((mesh.points[:half], mesh.points[half:]), (front, back), strict=True)
    return Mesh(np.concatenate([points @ frame.rotation.T + frame.origin for points, frame in sides]), mesh.faces)


Side = tuple[Surface, float, float]
"""A surface, its vertex's z and its rim, mm."""


def element(front: Side, back: Side) -> Mesh:
    """Return the solid between two sides; the narrower one is continued flat to the rim of the wider."""
    wide = max(front[2], back[2])
    radii = np.union1d(np.linspace(0, wide, RINGS), [min(front[2], back[2])])
    z = np.stack(np.broadcast_arrays(_heights(front, radii), _heights(back, radii)))
    # A drawn rim may reach beyond the edge where the two sides meet.
    crossed = np.flatnonzero(np.atleast_2d(z[0] >= z[1]).any(axis=0))
    kept = slice(0, max(2, crossed[0]) if crossed.size else None)
    return revolve(radii[kept], *z[..., kept])


def _heights(side: Side, radii: np.ndarray) -> np.ndarray:
    """Return z at radii, (r,), or along the whole sweep, (steps + 1, r), of a side that is not of revolution."""
    surface, vertex, rim = side
    held = np.minimum(radii, rim)
    if not surface.uneven_parts:
        return vertex + sag(surface, held)
    turn = np.linspace(*CUT, STEPS + 1)[:, None]
    return vertex + sag(surface, held * np.sin(turn), held * np.cos(turn))


def revolve(
    radii: np.ndarray, front: np.ndarray, back: np.ndarray, sweep: tuple[float, float] = CUT, steps: int = STEPS
) -> Mesh:
    """Return the solid swept by the strip between two profiles z(r); ``radii`` rise from 0 or an inner rim.

    All are (r,), or (steps + 1, r) where they change along the sweep.
    """
    count, turns = radii.shape[-1], steps + 1
    front_ids = np.arange(count * turns).reshape(turns, count)
    back_ids = front_ids + count * turns
    parts = [
        _strip(front_ids[:-1], front_ids[1:]),
        _strip(back_ids[1:], back_ids[:-1]),
        _wall(back_ids[:, -1], front_ids[:, -1]),
        _wall(back_ids[0], front_ids[0]),
        _wall(front_ids[-1], back_ids[-1]),
    ]
    if np.min(radii) > 0:
        parts.append(_wall(front_ids[:, 0], back_ids[:, 0]))
    sheets = [_sheet(radii, z, sweep, steps) for z in (front, back)]
    return Mesh(np.concatenate(sheets), np.concatenate(parts))


def _sheet(radii: np.ndarray, z: np.ndarray, sweep: tuple[float, float], steps: int) -> np.ndarray:
    """Return the points of a surface of revolution, profile by profile, turning from +x to +y."""
    turn = np.linspace(*sweep, steps + 1)[:, None]
    return np.stack(np.broadcast_arrays(radii * np.cos(turn), radii * np.sin(turn), z), -1).reshape(-1, 3)


def _strip(low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Return the triangles between two rows of point numbers, (rows, columns) each."""
    a, b, c, d = low[..., :-1], high[..., :-1], high[..., 1:], low[..., 1:]
    return np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])


def _wall(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    return _strip(first[None], second[None])


def ring(inner: float, outer: float, z: float, thick: float) -> Mesh:
    """Return a flat ring about the axis, a quarter cut away: the stop; a disc where ``inner`` is 0."""
    radii = np.array([inner, outer])
    return revolve(radii, np.full(2, z - thick / 2), np.full(2, z + thick / 2))


def masked_stop(mask: PupilMask, rim: float, outer: float, z: float, thick: float) -> Mesh:
    """Return the stop with what stands in it: the blades of an iris, an obscuration, vanes; mm, ``outer`` its edge."""
    if not mask.edged:
        return ring(rim, outer, z, thick)
    steps = IRIS_STEPS if mask.iris else STEPS
    inner = rim * outline_radius(mask, np.pi / 2 - np.linspace(*CUT, steps + 1))  # turns go from +x to +y
    radii = np.stack([inner, np.full(inner.size, outer)], axis=1)
    parts = [revolve(radii, np.full(2, z - thick / 2), np.full(2, z + thick / 2), steps=steps)]
    if mask.obscured:
        disc = ring(0.0, mask.disc.radius * rim, z, thick)
        parts.append(replace(disc, points=disc.points + rim * np.array([mask.disc.xi, mask.disc.eta, 0.0])))
    for angle in mask.vane_angles:
        corners = vane(angle, mask.vane_width)[:, 3::-1].T  # counter-clockwise
        parts.append(slab(rim * corners, z - thick / 2, thick))
    return join_meshes(parts)


def join_meshes(meshes: Sequence[Mesh]) -> Mesh:
    """Return several meshes as one."""
    starts = np.cumsum([0, *(len(mesh.points) for mesh in meshes[:-1])])
    faces = [mesh.faces + start for mesh, start in zip(meshes, starts, strict=True)]
    return Mesh(np.concatenate([mesh.points for mesh in meshes]), np.concatenate(faces))


def plate(half: float, thick: float, surface: Surface) -> Mesh:
    """Return a square plate whose front has the shape of a surface about the origin: the sensor."""
    corners = half * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    if surface.flat:
        return slab(corners, 0.0, thick)
    axis = np.linspace(-half, half, PLATE_POINTS)
    x, y = np.meshgrid(axis, axis)
    front = np.stack([x, y, sag(surface, y, x)], -1).reshape(-1, 3)
    faces, behind = grid_faces(PLATE_POINTS, PLATE_POINTS), len(front)
    rim = _rim_of_grid(PLATE_POINTS)
    walls = np.concatenate([[(a, b, b + behind), (a, b + behind, a + behind)] for a, b in pairwise([*rim, rim[0]])])
    points = np.concatenate([front, front + np.array([0.0, 0.0, thick])])
    return Mesh(points, np.concatenate([faces, faces[:, ::-1] + behind, walls]))


def _rim_of_grid(count: int) -> list[int]:
    """Return the points along the rim of a square grid, counter-clockwise."""
    numbers = np.arange(count * count).reshape(count, count)
    sides = numbers[0, :-1], numbers[:-1, -1], numbers[-1, :0:-1], numbers[:0:-1, 0]
    return [int(number) for side in sides for number in side]


def slab(corners: np.ndarray, z: float, thick: float) -> Mesh:
    """Return a slab over a quadrangle, ``corners`` (4, 2) counter-clockwise, whose front lies at z."""
    points = np.concatenate([np.c_[corners, np.full(4, depth)] for depth in (z, z + thick)])
    sides = [_wall(np.array([k, (k + 1) % 4]), np.array([k + 4, (k + 1) % 4 + 4])) for k in range(4)]
    faces = [np.array([[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]]), *(side[:, ::-1] for side in sides)]
    return Mesh(points, np.concatenate(faces))


def grid_faces(rows: int, columns: int) -> np.ndarray:
    """Return the triangles of a grid of points, row by row."""
    ids = np.arange(rows * columns).reshape(rows, columns)
    return _strip(ids[:-1], ids[1:])


def volume(mesh: Mesh) -> float:
    """Return the volume of a closed mesh, mm³: Σ a·(b × c)/6 over its triangles, by Gauss's theorem."""
    a, b, c = np.moveaxis(mesh.points[mesh.faces], 1, 0)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def area(mesh: Mesh, faces: slice = slice(None)) -> float:
    """Return the area of a mesh's triangles, or of some of them, mm²."""
    a, b, c = np.moveaxis(mesh.points[mesh.faces[faces]], 1, 0)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
