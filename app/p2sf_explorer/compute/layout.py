"""The lens drawn to scale: outlines, rays and marks in mm, z from the first vertex. No Qt in here."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from math import cos, inf, isfinite, radians, sin

import numpy as np

from p2sf.conventions import NM_PER_UM, degrees_from_slope, slope_from_degrees
from p2sf.disc.mask_outline import dark_heights
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, Surface, indices, message_if_misaligned, seen_from, with_sensor
from p2sf.lens.meridians import meridians
from p2sf.lens.misalignment import straighten
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.pupils import RIM_TIE, default_stop, pupils, rim_radii
from p2sf.raytrace.aiming import entrance, pupil_rays
from p2sf.raytrace.surface import AT_RIM, Status
from p2sf.raytrace.trace import trace
from p2sf.tolerance.errors_of_build import source_of_build
from p2sf_explorer.compute.glass_outlines import (
    PLANE,
    UPRIGHT,
    Glass,
    GlassOutline,
    Profile,
    Section,
    filling,
    glass_of,
    profile,
    sections,
    still,
    vertices,
    widest_exit,
)
from p2sf_explorer.compute.meridional import aim_ray, path
from p2sf_explorer.compute.setup import ParaxialSetup, prescription
from p2sf_explorer.state.scales import nice
from p2sf_explorer.state.state import State

HEIGHTS = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8)
AIM_MOVE = 1e-5  # of the stop's rim: a last step of the secant method that leaves far less than can be drawn
DRAWN_AIM = 1e-2  # of the pupil's radius, where rays are drawn only: the one step it mostly takes leaves up to 5e-4
STRAIGHT = 0.99  # cosine of the angle up to which the marks of the aligned axis are drawn
SAME_FIELD_DEG = 1e-6  # of one field and another
REACH = 3.0  # rays from infinity begin this many lens lengths before the lens, outside any window


@dataclass(frozen=True)
class Drawing:
    """The glass, which only another lens changes, and stop and sensor; mm.

    ``dark``: from which to which y the mask in the stop covers it, vanes left out. ``stop`` and ``sensor``: how these
    stand in the drawing, ``surfaces``: how every surface does; ``sensor_surface``: the shape of the sensor.
    ``outlines``: of the elements, and of a medium that fills the space up to the sensor, as in the eye. ``left`` and
    ``right``: the ends of glass, mirrors and the way to the sensor.
    """

    glass: Glass
    outlines: tuple[GlassOutline, ...]
    stop_z: float
    stop_rim: float
    sensor_z: float
    half_height: float
    left: float
    right: float
    dark: tuple[tuple[float, float], ...] = ()
    stop: Section = UPRIGHT
    sensor: Section = UPRIGHT
    surfaces: tuple[Section, ...] = ()
    sensor_surface: Surface = PLANE

    def sensor_line(self, half: float) -> Profile:
        """Return z and y, mm, of the sensor from −half to half: two points of a plane, more of a curved one."""
        return self.sensor.placed(*profile(self.sensor_surface, 0.0, half))


@dataclass(frozen=True)
class RayPath:
    """One ray: z and y in mm; ``kind`` is "marginal", "chief" or "rim", ``group`` its number among `Layout.groups`.

    ``passed`` False where it does not reach the sensor; ``clipped`` where that is because a rim stops it;
    ``on_sensor`` mm along a sensor that may be tilted.
    """

    kind: str
    z: np.ndarray
    y: np.ndarray
    passed: bool = True
    clipped: bool = False
    group: int = 0
    on_sensor: float | None = None

    @property
    def height(self) -> float:
        """Return how high a ray that passed meets the sensor, mm along this."""
        return float(self.y[-1]) if self.on_sensor is None else self.on_sensor

    @property
    def lost(self) -> bool:
        """Return whether the ray misses a surface or is totally reflected."""
        return not (self.passed or self.clipped)


@dataclass(frozen=True)
class Mark:
    """A named point or pupil on the axis; ``radius`` 0 for a point."""

    name: str
    z: float
    radius: float = 0.0


@dataclass(frozen=True)
class LayoutRays:
    """The rays of one field and wavelength, which have a colour of their own."""

    field_deg: float
    wavelength_nm: float


@dataclass(frozen=True)
class Layout:
    """The drawing, the rays of the present source, and the marks; ``source`` (z, y) is None at infinity.

    ``sensor_half``: half the height of the drawn sensor, mm; it holds the chief ray of every field of the lens file.
    ``groups`` are the fans of rays "by field" and "by wavelength", none for those of the present source by their kind.
    ``note``: says of a lens that is not symmetric how its parts and rays are seen; ``exaggerated``: by what its tilts
    and decentres are enlarged, rays being those of the lens as it is; ``file_tilted``: the lens file has others, which
    are not enlarged.
    """

    drawing: Drawing
    rays: tuple[RayPath, ...]
    marks: tuple[Mark, ...]
    source: tuple[float, float] | None
    image: tuple[float, float] | None
    entrance_z: float
    slope: float
    sensor_half: float
    groups: tuple[LayoutRays, ...] = ()
    note: Message | None = None
    exaggerated: int = 1
    file_tilted: bool = False


def layout_of(state: State, setup: ParaxialSetup) -> Layout:
    """Return the `layout` as a state wants it drawn."""
    from p2sf_explorer.state.built import exaggerate

    display, factor = state.display, 1
    if state.optics.errors and display.exaggerated > 1:
        _, factor = exaggerate(state.optics.errors, display.exaggerated)
    shown = shown_lens(state, setup) if factor > 1 else None
    made = layout(setup, state.optics.clip, display.rays_coloured, display.rays_count, shown)
    return replace(made, exaggerated=factor, file_tilted=prescription(state).misaligned) if factor > 1 else made


def shown_lens(state: State, setup: ParaxialSetup) -> Lens:
    """Return the lens whose glass, stop and sensor are drawn: with its tilts and decentres enlarged as a state says."""
    from p2sf_explorer.state.built import exaggerate, with_errors

    larger, factor = exaggerate(state.optics.errors, state.display.exaggerated)
    if factor == 1 or not state.optics.errors:
        return setup.lens
    return with_sensor(with_errors(prescription(state), larger), setup.lens.sensor_mm)


def layout(
    setup: ParaxialSetup, clip: bool = False, coloured: str = "kind", count: int = 3, shown: Lens | None = None
) -> Layout:
    """Return everything the layout panel draws; with ``clip`` rays end at the rims that stop them.

    ``shown``: the lens whose glass, stop and sensor are drawn, where it is not the setup's own.

    ``coloured`` "kind" draws rays of the axial point and of the source, "field" those of every field that the lens
    states, "wavelength" those of the source at every wavelength that it states; ``count`` (odd) from each point.
    """
    drawn = drawing(shown or setup.lens, int(setup.stop.surface), float(setup.stop.semi_diameter))
    depth, y, upright = setup.source.depth_mm, setup.object_y_mm, upright_part(setup.source)
    groups = fans(setup, coloured)
    rays = tuple(fan_paths(setup, drawn, groups, clip, count) if groups else ray_paths(setup, drawn, clip, count))
    return Layout(
        drawing=drawn,
        rays=rays,
        marks=tuple(marks(setup)) if nearly_straight(setup.lens) else (),
        source=None if y is None else (-depth, upright * y),
        image=_image_point(setup, drawn),
        entrance_z=float(setup.pupils.entrance_from_first),
        slope=upright * setup.source.field_slope,
        sensor_half=sensor_half(setup.lens, rays),
        groups=groups,
        note=message_if_misaligned(setup.lens, Message("not symmetric: sections seen along x")),
    )


def upright_part(source: Source) -> float:
    """Return what part of a source's field lies along y: the drawing is seen along x."""
    return cos(radians(source.azimuth_deg)) if source.azimuth_deg else 1.0


def nearly_straight(lens: Lens) -> bool:
    """Return whether the axis behind the last surface still is about that before the first, as paraxial marks are."""
    behind = lens.frames[-1].rotation @ lens.motions[-1].rotation.T
    return bool(behind[2, 2] > STRAIGHT)


def sensor_half(lens: Lens, rays: tuple[RayPath, ...]) -> float:
    """Return half the sensor's height, mm: a round number that holds this chief ray and the widest field's."""
    now = max((abs(ray.height) for ray in rays if ray.kind == "chief" and ray.passed), default=0.0)
    return nice(1.04 * max(now, widest_image(lens), 1e-3), HEIGHTS)


def drawing(lens: Lens, stop_surface: float, stop_rim: float) -> Drawing:
    """Return glass, stop and sensor of a lens."""
    glass, places = glass_of(still(lens)), sections(lens)
    z = [place.z for place in places]
    return Drawing(
        glass=glass,
        outlines=glass.outlines + filling(glass, places[-1], lens.sensor_surface),
        stop_z=z[int(stop_surface) - 1],
        stop_rim=stop_rim,
        sensor_z=z[-1],
        half_height=max(glass.half_height, stop_rim, abs(places[-1].y)),
        left=min(glass.left, z[-1]),
        right=max(*z, glass.right),
        dark=tuple((low * stop_rim, high * stop_rim) for low, high in dark_heights(lens.mask)),
        stop=places[int(stop_surface) - 1],
        sensor=places[-1],
        surfaces=places[:-1],
        sensor_surface=lens.sensor_surface,
    )


def widest_image(lens: Lens) -> float:
    """Return how high the chief ray of the file's widest field meets the sensor, mm; 0 where it does not.

    That of a misaligned lens is taken of the lens set straight: what is drawn keeps its scale while a part is moved.
    """
    y, slope = widest_exit(straighten(still(lens)))
    return abs(y + slope * lens.sensor_mm)


def _image_point(setup: ParaxialSetup, drawn: Drawing) -> tuple[float, float] | None:
    """Return z and y of the paraxial image or, of a misaligned lens, of where the chief ray lands; None without one."""
    if setup.lens.misaligned:
        chief = next(_paths(setup, drawn, setup.source, [0.0], clip=False), None)
        return (float(chief.z[-1]), float(chief.y[-1])) if chief and chief.passed else None
    distance = float(setup.coefficients.image_distance)
    if not isfinite(distance):
        return None
    rays = setup.rays
    unit = rays.chief_y[-1] + rays.chief_nu[-1] / rays.index[-1] * distance
    return vertices(setup.lens)[-2] + distance, float(unit) * setup.source.field_slope


def fans(setup: ParaxialSetup, coloured: str) -> tuple[LayoutRays, ...]:
    """Return the fans of rays that are drawn by their colour, in the order of field or wavelength."""
    source, lens = setup.source, setup.lens
    here = float(degrees_from_slope(source.field_slope)), source.wavelength_um * NM_PER_UM
    if coloured == "field":
        stated = {y for _, y in lens.field_places_deg if abs(y - here[0]) > SAME_FIELD_DEG}
        return tuple(LayoutRays(angle, here[1]) for angle in sorted({*stated, here[0]}, key=abs))
    if coloured == "wavelength":
        return tuple(LayoutRays(here[0], nm) for nm in sorted({*lens.wavelengths_nm, round(here[1], 4)}))
    return ()


def ray_paths(setup: ParaxialSetup, drawn: Drawing, clip: bool = False, count: int = 3) -> Iterator[RayPath]:
    """Yield exact meridional rays of the axial point, all but that along the axis, and of the source."""
    etas = pupil_points(count)
    axial = replace(setup.source, field_slope=0.0, azimuth_deg=0.0)
    for ray in _paths(setup, drawn, axial, etas[:-1], clip):
        yield replace(ray, kind="marginal")
    yield from _paths(setup, drawn, setup.source, etas, clip)


def fan_paths(
    setup: ParaxialSetup, drawn: Drawing, groups: tuple[LayoutRays, ...], clip: bool, count: int
) -> Iterator[RayPath]:
    """Yield exact meridional rays of every fan."""
    etas = pupil_points(count)
    for number, fan in enumerate(groups):
        slope = float(slope_from_degrees(fan.field_deg))
        azimuth = setup.source.azimuth_deg
        source = Source(setup.source.depth_mm, slope, fan.wavelength_nm / NM_PER_UM, azimuth_deg=azimuth)
        source = source_of_build(setup.designed, setup.lens, source)
        for ray in _paths(setup, drawn, source, etas, clip):
            yield replace(ray, group=number)


def pupil_points(count: int) -> list[float]:
    """Return evenly spaced η of an odd number of rays, the chief ray's 0 at the end, so that it is drawn on top."""
    etas = np.linspace(1.0, -1.0, count).tolist()
    return [*(eta for number, eta in enumerate(etas) if number != count // 2), 0.0]


def _paths(setup: ParaxialSetup, drawn: Drawing, source: Source, etas: list[float], clip: bool) -> Iterator[RayPath]:
    """Yield a source's rays through points of the pupil; the chief ray, where the pupil begins, is not clipped."""
    if setup.lens.misaligned:
        front = -min(source.depth_mm, REACH * (drawn.right - drawn.left))
        yield from skew_paths(setup.lens, source, tuple(etas), clip, front)
        return
    rims, lens = pencil_rims(setup.lens) if clip else None, setup.lens
    index = tuple(indices(lens, source.wavelength_um).tolist())
    front = -min(source.depth_mm, REACH * (drawn.right - drawn.left))
    entry = _Entry.of(lens, source, index)
    for eta in etas:
        kind = "rim" if eta else "chief"
        height = entry.height(eta) if source.field_slope else _axial_height(entry, eta)
        start, direction = entry.ray(height, front)
        z, y, passed = path(lens, index, source.wavelength_um, start, direction, rims if eta else None)
        clipped = bool(rims and y and not passed and abs(y[-1]) > rims[len(y) - 1])
        places = np.array([[start[0], *z], [start[1], *y]])
        if clipped:
            end_at_rim(places, lens, len(z), rims[len(y) - 1] if rims else 0.0)
        yield RayPath(kind, places[0], places[1], passed, clipped)


@lru_cache(maxsize=16)
def skew_paths(lens: Lens, source: Source, etas: tuple[float, ...], clip: bool, front: float) -> tuple[RayPath, ...]:
    """Return a source's rays through a misaligned lens, seen along x, from z = ``front`` mm; none if the chief is lost.

    Kept, since those of the point on the axis are the same for every field.
    """
    seen = seen_from(lens, source.azimuth_deg)
    try:
        rays = pupil_rays(seen, source, np.zeros(len(etas)), np.array(etas), aim_error=DRAWN_AIM)
    except GeometryError:  # of the point on the axis: that of the source has its own picture, or its own sentence
        return ()
    origins, directions = np.broadcast_arrays(rays.origins, rays.directions)
    starts = origins + directions * ((front - origins[..., 2:]) / directions[..., 2:])
    found = trace(seen, starts, directions, source.wavelength_um, clip, stop_clips=False)
    y, z = upright_part(source) * found.points[..., 1], found.points[..., 2]
    if source.azimuth_deg:
        y = y - sin(radians(source.azimuth_deg)) * found.points[..., 0]
    on_sensor = (found.points[-1] - lens.frames[-1].origin) @ lens.frames[-1].rotation[:, 1]
    reached = np.isfinite(z).sum(0).tolist()
    return tuple(
        RayPath(
            "rim" if eta else "chief",
            z[: reached[number], number],
            y[: reached[number], number],
            bool(status == Status.PASSED),
            status in AT_RIM,
            on_sensor=float(on_sensor[number]),
        )
        for number, (eta, status) in enumerate(zip(etas, found.status.tolist(), strict=True))
    )


@dataclass(frozen=True)
class _Entry:
    """How meridional rays of a source enter a lens.

    ``plane`` and ``radius``: of the paraxial entrance pupil, mm; ``near`` = 1/(object to pupil) per mm; ``slope`` of
    the chief ray; ``stop``: the surface; ``rim``: its radius, mm, below 0 where the pupil is its inverted image.
    """

    lens: Lens
    source: Source
    index: tuple[float, ...]
    plane: float
    radius: float
    near: float
    slope: float
    stop: int
    rim: float

    @classmethod
    def of(cls, lens: Lens, source: Source, index: tuple[float, ...]) -> "_Entry":
        """Return how a source's rays enter a lens."""
        enter = entrance(lens, source)
        plane, radius, near, side = (float(a.item()) for a in (enter.plane, enter.radius, enter.reach, enter.upright))
        rim = side * float(enter.stop.semi_diameter)
        return cls(lens, source, index, plane, radius, near, source.field_slope, int(enter.stop.surface), rim)

    def ray(self, y: float, front: float) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return z and y of the ray's point in the plane ``front``, and its direction, if it meets the pupil's at y."""
        slope = self.slope + self.near * y
        return (front, y + slope * (front - self.plane)), (1.0, slope)

    def height(self, eta: float) -> float:
        """Return the height in the pupil's plane of the ray through η; NaN where no ray gets there."""
        guess = eta * self.radius
        if self.lens.aim == "paraxial":
            return guess
        found = aim_ray(self._landing, eta * self.rim, guess, self.rim / self.radius, AIM_MOVE * abs(self.rim))
        if found is not None:
            return found
        return float(pupil_rays(self.lens, self.source, np.zeros(1), np.array([eta])).y.item())

    def _landing(self, y: float) -> float | None:
        start, direction = self.ray(y, self.plane)
        _, heights, met = path(self.lens, self.index, self.source.wavelength_um, start, direction, last=self.stop)
        return heights[-1] if met else None


@lru_cache(maxsize=64)
def _axial_height(axial: _Entry, eta: float) -> float:
    """Return the height in the pupil's plane of a ray of the point on the axis, which is the same for every field."""
    return axial.height(eta)


@lru_cache(maxsize=32)
def pencil_rims(lens: Lens) -> tuple[float, ...]:
    """Return the rim of each surface as a pencil meets it, mm, inf where none is stated; the stop's is the pupil's."""
    return tuple((rim_radii(lens, lens.stop_surface or default_stop(lens), inf) * (1 + RIM_TIE)).tolist())


def end_at_rim(places: np.ndarray, lens: Lens, surface: int, rim: float) -> None:
    """Move the end of a clipped ray, (2, points) z and y, into the plane of the rim that stops it."""
    sag = float(lens.surfaces[surface - 1].sag(0.0, rim))
    (z, y), (end_z, end_y) = places[:, -2], places[:, -1]
    at = vertices(lens)[surface - 1] + sag
    if isfinite(sag) and (at - z) * (end_z - z) > 0:
        places[:, -1] = at, y + (at - z) * (end_y - y) / (end_z - z)


def marks(setup: ParaxialSetup) -> Iterator[Mark]:
    """Yield the pupils and the principal and focal points that lie at a finite place."""
    last = vertices(setup.lens)[-2]
    c, p = setup.cardinal, pupils(meridians(setup.lens).y, setup.source.wavelength_um, setup.stop)
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
