"""The lens drawn to scale: outlines, rays and marks in mm, z from the first vertex. No Qt in here."""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import isfinite

import numpy as np

from app.meridional import path
from app.scales import nice
from app.setting import Setting
from p2sf.lens import Lens, Surface, indices
from p2sf.pupils import find_stop, paraxial_rays
from p2sf.raytrace import pupil_rays
from p2sf.source import Source

PROFILE_POINTS = 33
HEIGHTS = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8)
REACH = 3.0  # rays from afar begin so many lens lengths before the lens, outside any window


@dataclass(frozen=True)
class Outline:
    """One closed region of glass: z and y in mm, its index, and the surfaces (from 1) before and behind it."""

    z: np.ndarray
    y: np.ndarray
    index: float
    surfaces: tuple[int, int]


@dataclass(frozen=True)
class Drawing:
    """What stays while the source moves: glass, surface lines, stop wedges, sensor, and the extent in mm."""

    outlines: tuple[Outline, ...]
    profiles: tuple[tuple[np.ndarray, np.ndarray], ...]
    stop_z: float
    stop_rim: float
    sensor_z: float
    half_height: float
    left: float
    right: float


@dataclass(frozen=True)
class RayPath:
    """One ray: z and y in mm; ``kind`` is "marginal", "chief" or "rim"; ``passed`` False where it was lost."""

    kind: str
    z: np.ndarray
    y: np.ndarray
    passed: bool = True


@dataclass(frozen=True)
class Mark:
    """A named point or pupil on the axis; ``radius`` 0 for a point."""

    name: str
    z: float
    radius: float = 0.0


@dataclass(frozen=True)
class Layout:
    """The drawing, the rays of the present source, and the marks; ``source`` (z, y) is None at infinity.

    ``sensor_half``: half the height of the drawn sensor, mm; it holds the chief ray of every field of the lens file.
    """

    drawing: Drawing
    rays: tuple[RayPath, ...]
    marks: tuple[Mark, ...]
    source: tuple[float, float] | None
    image: tuple[float, float] | None
    entrance_z: float
    slope: float
    sensor_half: float


def layout(setting: Setting) -> Layout:
    """Return everything the layout panel draws."""
    drawn = drawing(setting.lens, float(setting.stop.surface), float(setting.stop.semi_diameter))
    depth, height = setting.source.depth_mm, setting.object_height_mm
    rays = tuple(ray_paths(setting, drawn))
    return Layout(
        drawing=drawn,
        rays=rays,
        marks=tuple(marks(setting)),
        source=None if height is None else (-depth, -height),
        image=_image_point(setting),
        entrance_z=float(setting.pupils.entrance_from_first),
        slope=setting.source.field_slope,
        sensor_half=sensor_half(setting.lens, rays),
    )


def sensor_half(lens: Lens, rays: tuple[RayPath, ...]) -> float:
    """Return half the sensor's height, mm: a round number that holds this chief ray and the widest field's."""
    now = max((abs(float(ray.y[-1])) for ray in rays if ray.kind == "chief" and ray.passed), default=0.0)
    return nice(1.04 * max(now, widest_image(lens), 1e-3), HEIGHTS)


@lru_cache(maxsize=32)
def widest_image(lens: Lens) -> float:
    """Return how high the chief ray of the file's widest field meets the sensor, mm; 0 where it does not."""
    slope = float(np.tan(np.deg2rad(max(abs(angle) for angle in lens.fields_deg))))
    source = Source(np.inf, slope, lens.reference_wavelength_um)
    rays = pupil_rays(lens, source, np.zeros(1), np.zeros(1))
    start, direction = (a.reshape(-1, 3)[0, :0:-1].tolist() for a in (rays.origins, rays.directions))
    _, y, passed = path(lens, indices(lens, source.wavelength_um).tolist(), start, direction)
    return abs(y[-1]) if passed else 0.0


def _image_point(setting: Setting) -> tuple[float, float] | None:
    distance = float(setting.coefficients.image_distance)
    if not isfinite(distance):
        return None
    rays = setting.rays
    unit = rays.chief_y[-1] + rays.chief_nu[-1] / rays.index[-1] * distance
    return vertices(setting.lens)[-2] + distance, float(unit) * setting.source.field_slope


@lru_cache(maxsize=32)
def drawing(lens: Lens, stop_surface: float, stop_rim: float) -> Drawing:
    """Return the outlines of a lens; real sag, to the clear rims."""
    z, rims = vertices(lens), clear_rims(lens)
    index = indices(lens, lens.reference_wavelength_um)
    profiles = tuple(profile(surface, at, rim) for surface, at, rim in zip(lens.surfaces, z, rims, strict=False))
    sensor_z = z[-1]
    outlines = [
        element_outline(profiles[i], profiles[i + 1], float(index[i + 1]), (i + 1, i + 2))
        for i in range(len(profiles) - 1)
        if index[i + 1] > 1.0001 and rims[i] > 0
    ]
    if index[-1] > 1.0001:
        rim = float(max(rims))
        wall = (np.full(2, sensor_z), np.array([-rim, rim]))
        outlines.append(element_outline(profiles[-1], wall, float(index[-1]), (len(profiles), len(profiles))))
    half = float(max(*rims, stop_rim))
    front = min(float(p[0].min()) for p in profiles)
    return Drawing(
        tuple(outlines), profiles, z[int(stop_surface) - 1], stop_rim, sensor_z, half, front, max(sensor_z, z[-2])
    )


def vertices(lens: Lens) -> list[float]:
    """Return z of every vertex in mm, the first at 0, then the sensor's."""
    return [0.0, *np.cumsum([surface.thickness for surface in lens.surfaces]).tolist()]


@lru_cache(maxsize=32)
def clear_rims(lens: Lens) -> tuple[float, ...]:
    """Return a half-height to draw for each surface: its clear rim, or what the widest field's rays need."""
    stop = find_stop(lens)
    rays = paraxial_rays(lens, np.inf, lens.reference_wavelength_um, stop)
    slope = np.tan(np.deg2rad(max(abs(angle) for angle in lens.fields_deg)))
    needed = np.abs(rays.y) + np.abs(rays.chief_y) * slope
    rims = [
        s.semi_diameter if isfinite(s.semi_diameter) else 1.05 * n for s, n in zip(lens.surfaces, needed, strict=True)
    ]
    return tuple(float(_inside_surface(s, r)) for s, r in zip(lens.surfaces, rims, strict=True))


def _inside_surface(surface: Surface, rim: float) -> float:
    """Return the rim, held inside the height where a closed conic ends: (1 + K)c²r² = 1."""
    closing = (1 + surface.conic) * surface.curvature**2
    return rim if closing <= 0 else min(rim, 0.999 / np.sqrt(closing))


def profile(surface: Surface, vertex: float, rim: float) -> tuple[np.ndarray, np.ndarray]:
    """Return z and y of a surface's meridional section from −rim to rim."""
    flat = surface.curvature == 0 and not surface.aspheric
    y = np.linspace(-rim, rim, 2 if flat else PROFILE_POINTS)
    return vertex + sag(surface, y), y


def sag(surface: Surface, y):
    """Sag of a conic with even polynomial terms (ISO 10110-12), mm."""
    square = np.square(y)
    c = surface.curvature
    root = np.sqrt(np.maximum(0.0, 1 - (1 + surface.conic) * c * c * square))
    depth = c * square / (1 + root)
    for power, term in enumerate(surface.aspheric, 2):
        depth = depth + term * square**power
    return depth


def element_outline(front, back, index: float, surfaces: tuple[int, int]) -> Outline:
    """Return the closed outline between two profiles; the narrower one gets a flat rim up to the wider."""
    (z1, y1), (z2, y2) = front, back
    rim = max(y1[-1], y2[-1])
    z = np.concatenate([z1, [z1[-1], z2[-1]], z2[::-1], [z2[0], z1[0], z1[0]]])
    y = np.concatenate([y1, [rim, rim], y2[::-1], [-rim, -rim, y1[0]]])
    return Outline(z, y, index, surfaces)


RAYS = (("marginal", 0, 1.0), ("marginal", 0, -1.0), ("rim", 1, 1.0), ("rim", 1, -1.0), ("chief", 1, 0.0))
"""The drawn rays: kind, which source (0 the axial point, 1 the field point), and η in the entrance pupil."""


def ray_paths(setting: Setting, drawn: Drawing):
    """Yield the exact meridional rays of `RAYS`."""
    source, etas = setting.source, np.array([1.0, -1.0, 0.0])
    both = replace(source, field_slope=np.array([0.0, source.field_slope]))
    rays = pupil_rays(setting.lens, both, np.zeros(3), etas, stop=setting.stop)
    origins, directions = np.broadcast_arrays(rays.origins, rays.directions)
    starts = _start(origins, directions, min(source.depth_mm, REACH * (drawn.right - drawn.left)))
    index = indices(setting.lens, source.wavelength_um).tolist()
    for kind, row, eta in RAYS:
        at = row, etas.tolist().index(eta)
        start, direction = (a[at][:0:-1].tolist() for a in (starts, directions))  # z, y
        z, y, passed = path(setting.lens, index, start, direction)
        yield RayPath(kind, np.array([start[0], *z]), np.array([start[1], *y]), passed)


def _start(origins: np.ndarray, directions: np.ndarray, reach: float) -> np.ndarray:
    """Return the points of the rays in the plane ``reach`` mm before the first vertex."""
    return origins - directions * ((origins[..., 2:] + reach) / directions[..., 2:])


def marks(setting: Setting):
    """Yield the pupils and the principal and focal points that lie at a finite place."""
    last = vertices(setting.lens)[-2]
    c, p = setting.cardinal, setting.pupils
    places = (
        ("EnP", p.entrance_from_first, p.entrance_diameter / 2),
        ("ExP", last + p.exit_from_last, p.exit_diameter / 2),
        ("H", c.front_principal_from_first, 0.0),
        ("H′", last + c.rear_principal_from_last, 0.0),
        ("F", c.front_focal_distance, 0.0),
        ("F′", last + c.back_focal_distance, 0.0),
    )
    for name, z, radius in places:
        if isfinite(float(z)) and isfinite(float(radius)):
            yield Mark(name, float(z), float(radius))
