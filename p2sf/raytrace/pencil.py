"""The pencil of one source through the pupil by exact skew rays: path differences and fans."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property, lru_cache
from math import inf, sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import UM_PER_MM, FloatOrArray, write_protect
from p2sf.disc.domain import ClearNodes
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, seen_from
from p2sf.lens.source import Source
from p2sf.paraxial.pupils import Stop
from p2sf.raytrace.aiming import AIM_ERROR, PupilRays, Sources, arriving, entrance, pupil_rays, start
from p2sf.raytrace.chief_ray import check_chief_ray, chief_ray_error
from p2sf.raytrace.field_geometry import exit_pupil, tangent_axes
from p2sf.raytrace.surface import Beam, Status, stop_in_the_dark, to_plane
from p2sf.raytrace.trace import Trace, lens_rims, run, status_message, trace

__all__ = [
    "PupilRays",
    "Rays",
    "Sources",
    "Status",
    "Trace",
    "displayed_opd",
    "pencil",
    "pupil_rays",
    "rays_through",
    "tangent_axes",
    "trace",
]


@dataclass(frozen=True, eq=False)
class Crossings:
    """Rays on their way, the chief ray last, in the axes of ``lens``, which is as the source sees it.

    ``points``: (surfaces + 1, 3, ray) on every surface and the sensor, mm. ``cosines``: optical ones of the rays as
    they arrive there.
    """

    lens: Lens
    points: np.ndarray
    cosines: np.ndarray


@dataclass(frozen=True, eq=False)
class Rays:
    """The rays of one source at the sensor plane, all relative to its chief ray; leading axes first, (…, ray).

    ``share``: the pupil area that a ray stands for, a weight of quadrature, which never goes under a root.
    ``launch``: the light sent through unit share, as in `PupilRays`. ``transmission``: what surfaces and media pass of
    it. ``mask``, ``mask_path_um``: the amplitude that the mask in the stop passes, and the path that it adds.
    Energies are sums of share·`light`, fields sums of share·`amplitude` or, radiometrically, share·`radiometric`.
    ``dx``, ``dy``: mm from the chief ray's sensor point. ``kx``, ``ky``, ``kz``: direction cosines in image space.
    ``path``: optical path to the sensor less the chief ray's, mm. ``status``, ``failed_surface``: as in `Trace`.
    Of the chief ray: ``chief_x``, ``chief_y`` mm on the sensor, ``chief_kx``, ``chief_ky``, ``chief_kz``. ``index``: of
    image space. Of a misaligned lens all are in the sensor's own axes, turned with the source's azimuth.
    ``clearance``: the least room they have had inside the rims that clip, a share of those, as in `Beam`.
    ``crossings``: where the rays meet surfaces, if asked for (`reaching_by_surfaces`).
    """

    xi: np.ndarray
    eta: np.ndarray
    launch: np.ndarray
    dx: np.ndarray
    dy: np.ndarray
    kx: np.ndarray
    ky: np.ndarray
    kz: np.ndarray
    path: np.ndarray
    status: np.ndarray
    failed_surface: np.ndarray
    chief_y: np.ndarray
    chief_ky: np.ndarray
    chief_kz: np.ndarray
    index: FloatOrArray
    wavelength_um: np.ndarray
    chief_x: FloatOrArray = 0.0
    chief_kx: FloatOrArray = 0.0
    share: FloatOrArray = 1.0
    transmission: FloatOrArray = 1.0
    mask: FloatOrArray = 1.0
    mask_path_um: FloatOrArray = 0.0
    clearance: FloatOrArray = inf
    crossings: Crossings | None = None

    @cached_property
    def passed(self) -> np.ndarray:
        """Return which rays reach the sensor."""
        passed: np.ndarray = self.status == Status.PASSED
        return passed

    @cached_property
    def light(self) -> np.ndarray:
        """Return the energy of unit share, (…, ray): launch·transmission·mask², 0 for rays that do not arrive."""
        return self._arriving(self.launch * self.transmission * np.square(self.mask))

    @cached_property
    def amplitude(self) -> np.ndarray:
        """Return the field of unit share, (…, ray), as other programs have it: launch·√transmission·mask.

        It is linear in the launch weight; see `radiometric` for the field that conserves energy.
        """
        return self._arriving(self.launch * np.sqrt(self.transmission) * self.mask)

    def radiometric(self, jacobian: np.ndarray) -> np.ndarray:
        """Return the field of unit share that conserves energy, √(light·|∂f/∂(ξ, η)|), with the sign of the mask."""
        field: np.ndarray = np.copysign(radiometric(self.light, jacobian), self.mask)
        return field

    def _arriving(self, values: np.ndarray) -> np.ndarray:
        return values if self.passed.all() else np.where(self.passed, values, 0.0)

    @cached_property
    def phase(self) -> np.ndarray:
        """Return w = (OPL ray − OPL chief − n'K·(I − C))/λ in waves over direction cosines (K), the mask's included."""
        shift: np.ndarray = self.kx * self.dx
        shift += self.ky * self.dy
        shift *= self.index
        phase: np.ndarray = (self.path - shift) * (UM_PER_MM / self.wavelength_um)
        phase += self.mask_path_um / self.wavelength_um
        return phase

    @cached_property
    def fx(self) -> np.ndarray:
        """Return n'(K − K chief)/λ along x, cycles per µm."""
        fx: np.ndarray = (self.kx - self.chief_kx) * (self.index / self.wavelength_um)
        return fx

    @cached_property
    def fy(self) -> np.ndarray:
        """Return n'(K − K chief)/λ along y, cycles per µm."""
        fy: np.ndarray = (self.ky - self.chief_ky) * (self.index / self.wavelength_um)
        return fy

    @cached_property
    def x_um(self) -> np.ndarray:
        """Return where rays land, µm from the chief ray along x."""
        x: np.ndarray = self.dx * UM_PER_MM
        return x

    @cached_property
    def y_um(self) -> np.ndarray:
        """Return where rays land, µm from the chief ray along y."""
        y: np.ndarray = self.dy * UM_PER_MM
        return y

    @property
    def arrived(self) -> "Rays":
        """Return only the rays that reach the sensor."""
        return self if self.passed.all() else self.part(self.passed)

    @property
    def chief_um(self) -> np.ndarray:
        """Return where the chief ray of one source lands on the sensor, µm, (2,)."""
        chief: np.ndarray = UM_PER_MM * np.append(self.chief_x, self.chief_y)
        return chief

    @property
    def on_surfaces(self) -> Crossings:
        """Return where the rays of `reaching_by_surfaces` cross the surfaces."""
        assert self.crossings is not None
        return self.crossings

    def part(self, some: slice | np.ndarray) -> "Rays":
        """Return some of the rays, by their last axis."""
        columns = ((name, getattr(self, name)) for name in PER_RAY)
        own: dict[str, Any] = {name: v[..., some] for name, v in columns if isinstance(v, np.ndarray)}
        return replace(self, **own | {"crossings": None})

    def of_source(self, number: int) -> "Rays":
        """Return the rays of one of several sources on one leading axis."""
        columns = ((field.name, getattr(self, field.name)) for field in fields(self))
        own: dict[str, Any] = {name: v[number] for name, v in columns if np.ndim(v) == 2}
        return replace(self, **own)

    def along_axis(self, lens: Lens) -> "Rays":
        """Return the rays of a curved sensor as they lie on pixels, which count along x and y of its own axes.

        What lies in the plane that touches it is foreshortened: X = T·x of places, so that f = T⁻¹·f of frequencies.
        The phase does not change.
        """
        if not lens.sensor_surface.curvature:
            return self
        (a, b), (_, d) = tangent_axes(lens, self.chief_x, self.chief_y)[:2, :2]
        area, new = a * d - b * b, dict[str, Any](crossings=None)
        new |= {"dx": a * self.dx + b * self.dy, "dy": b * self.dx + d * self.dy}
        for x, y in (("kx", "ky"), ("chief_kx", "chief_ky")):
            across, up = getattr(self, x), getattr(self, y)
            new |= {x: (d * across - b * up) / area, y: (a * up - b * across) / area}
        return replace(self, **new)

    def turned(self, angle_deg: float) -> "Rays":
        """Return the rays in pupil and sensor axes from which these are turned, from +y towards +x."""
        sine, cosine = np.sin(np.deg2rad(angle_deg)), np.cos(np.deg2rad(angle_deg))
        pairs = ("xi", "eta"), ("dx", "dy"), ("kx", "ky"), ("chief_x", "chief_y"), ("chief_kx", "chief_ky")
        new: dict[str, Any] = {"crossings": None}
        for pair in pairs:
            across, along = (getattr(self, name) for name in pair)
            new |= zip(pair, (across * cosine + along * sine, along * cosine - across * sine), strict=True)
        return replace(self, **new)


PER_RAY = (
    *("xi", "eta", "share", "launch", "transmission", "mask", "mask_path_um", "clearance"),
    *("dx", "dy", "kx", "ky", "kz", "path", "status", "failed_surface"),
)


def radiometric(light: np.ndarray, jacobian: np.ndarray) -> np.ndarray:
    """Return √(light·|∂f/∂(ξ, η)|), the field of unit pupil area that spreads over f with all the energy sent in."""
    field: np.ndarray = np.sqrt(light * np.abs(jacobian))
    return field


def pencil(
    lens: Lens,
    source: Source | Sources,
    xi: ArrayLike,
    eta: ArrayLike,
    clip: bool = False,
    stop: Stop | None = None,
    aim_error: float = AIM_ERROR,
) -> Rays:
    """Trace a source's rays through pupil points (ξ, η), each (ray,), to the sensor.

    ``clip`` applies the clear semi-diameters of every surface but the stop, whose rim the pupil already represents.
    ``aim_error``: as `pupil_rays` has it.
    The axes of `Sources` come first. Raises GeometryError where the chief ray does not reach the sensor, and for a
    misaligned lens where it runs beyond the rim of a surface.
    """
    lens, xi, eta = _with_chief(lens, source, xi, eta, stop)
    rims = lens_rims(lens, keep_stop=False) if clip else None
    beam, launch, index = arriving(lens, source, xi, eta, stop, rims, aim_error)
    return _relative_to_chief(lens, beam, launch, (xi, eta), index[-1], source.wavelength_um)


def reaching(lens: Lens, source: Source | Sources, xi: ArrayLike, eta: ArrayLike, stop: Stop | None = None) -> Rays:
    """Return the `pencil` through pupil points; GeometryError where one of its rays does not reach the sensor."""
    return all_reaching(pencil(lens, source, xi, eta, stop=stop))


def on_sensor(
    lens: Lens,
    sources: Sequence[Source],
    xi: np.ndarray,
    eta: np.ndarray,
    clip: bool = False,
    stop: Stop | None = None,
) -> Rays:
    """Return the `pencil` of several sources of one azimuth, (source, ray), in the axes of the sensor.

    The pupil points are in those axes too.
    """
    azimuth = sources[0].azimuth_deg
    lens, points = in_azimuth(lens, azimuth, xi, eta)
    return pencil(lens, Sources.of(sources), *points, clip, stop).turned(azimuth)


def in_azimuth(
    lens: Lens, azimuth_deg: float, xi: np.ndarray, eta: np.ndarray
) -> tuple[Lens, tuple[np.ndarray, np.ndarray]]:
    """Return a lens and points of its pupil, in the axes of the sensor, as sources in an azimuth see them."""
    sine, cosine = np.sin(np.deg2rad(azimuth_deg)), np.cos(np.deg2rad(azimuth_deg))
    return seen_from(lens, azimuth_deg), (xi * cosine - eta * sine, xi * sine + eta * cosine)


def reaching_by_surfaces(lens: Lens, source: Source, xi: ArrayLike, eta: ArrayLike) -> Rays:
    """Return the rays of `reaching`, with where they cross the surfaces."""
    lens, xi, eta = _with_chief(seen_from(lens, source.azimuth_deg), source, xi, eta, None)
    entering = pupil_rays(lens, source, xi, eta)
    beam, points, cosines = start(entering), [], []

    def visit(number: int) -> None:
        rotation, origin = lens.frames[number - 1]
        points.append(rotation @ beam.place + origin[:, None])
        cosines.append(rotation @ beam.ray)

    run(lens, beam, entering.index, visit=visit)
    beam.path += entering.path
    rays = _relative_to_chief(lens, beam, entering.launch, (xi, eta), entering.index[-1], source.wavelength_um)
    return replace(all_reaching(rays), crossings=Crossings(lens, np.stack(points), np.stack(cosines)))


def all_reaching(rays: Rays) -> Rays:
    """Return the rays; GeometryError where one of them does not reach the sensor."""
    if rays.passed.all():
        return rays
    raise GeometryError(
        "{lost} of {total} rays do not reach the sensor; stop the lens down or reduce the field",
        lost=int((~rays.passed).sum()),
        total=rays.passed.size,
    )


def _with_chief(
    lens: Lens, source: Source | Sources, xi: ArrayLike, eta: ArrayLike, stop: Stop | None
) -> tuple[Lens, np.ndarray, np.ndarray]:
    """Return a lens as the source sees it, and pupil points with that of the chief ray behind them."""
    lens = seen_from(lens, getattr(source, "azimuth_deg", 0.0))
    check_chief_ray(lens, source, stop)
    return lens, np.append(np.ravel(xi), 0.0), np.append(np.ravel(eta), 0.0)


def rays_through(
    lens: Lens,
    source: Source | Sources,
    nodes: ClearNodes,
    clip: bool = False,
    stop: Stop | None = None,
    aim_error: float = AIM_ERROR,
) -> Rays:
    """Return the `pencil` through quadrature nodes, with their shares, and what the mask in the stop does to it."""
    rays = pencil(lens, source, nodes.xi, nodes.eta, clip, stop, aim_error)
    return replace(rays, share=nodes.weight, mask=nodes.amplitude, mask_path_um=nodes.path_um)


def _relative_to_chief(
    lens: Lens,
    beam: Beam,
    launch: FloatOrArray,
    points: tuple[np.ndarray, np.ndarray],
    index: FloatOrArray,
    wavelength_um: FloatOrArray,
) -> Rays:
    """Return a beam at the sensor as differences from its last ray, the chief ray."""
    beam.exempt = 1
    stop_in_the_dark(beam)
    if beam.status.any():
        _blank(beam, lens)
    chief_x, chief_y = beam.x[..., -1:].copy(), beam.y[..., -1:].copy()
    if lens.sensor_surface.curvature:
        to_tangent_plane(beam, lens, index)
    return Rays(
        xi=points[0][:-1],
        eta=points[1][:-1],
        launch=np.broadcast_to(launch, beam.x.shape)[..., :-1],
        dx=beam.x[..., :-1] - beam.x[..., -1:],
        dy=beam.y[..., :-1] - beam.y[..., -1:],
        kx=beam.p[..., :-1] / index,
        ky=beam.q[..., :-1] / index,
        kz=beam.r[..., :-1] / index,
        path=beam.path[..., :-1] - beam.path[..., -1:],
        status=beam.status[..., :-1],
        failed_surface=beam.failed_surface[..., :-1],
        chief_y=chief_y,
        chief_ky=beam.q[..., -1:] / index,
        chief_kz=beam.r[..., -1:] / index,
        index=index,
        wavelength_um=np.asarray(wavelength_um)[..., None],
        chief_x=chief_x,
        chief_kx=beam.p[..., -1:] / index,
        transmission=_but_last(beam.transmission),
        clearance=_but_last(beam.clearance),
    )


def to_tangent_plane(beam: Beam, lens: Lens, index: FloatOrArray) -> None:
    """Carry a beam from the sensor to the plane that touches it at the last ray, and give it in the axes of that plane.

    The last ray's point becomes their origin; that ray itself stays where it is.
    """
    turn = tangent_axes(lens, beam.x[..., -1:], beam.y[..., -1:])
    beam.place -= beam.place[..., -1:]
    for vectors in (beam.place, beam.ray):
        vectors[...] = np.einsum("ji...,j...->i...", turn, vectors)
    to_plane(beam, index)


def _but_last(values: FloatOrArray) -> FloatOrArray:
    return values[..., :-1] if isinstance(values, np.ndarray) else values


def _blank(beam: Beam, lens: Lens) -> None:
    """Make failed rays NaN throughout, and refuse a pencil whose chief ray failed."""
    bad = beam.status != Status.PASSED
    if bad[..., -1].any():
        status, surface = (int(a[..., -1][bad[..., -1]].ravel()[0]) for a in (beam.status, beam.failed_surface))
        raise chief_ray_error(lens, status_message(lens, status, surface), surface)
    for column in (beam.x, beam.y, beam.p, beam.q, beam.r, beam.path):
        column[bad] = np.nan


def displayed_opd(
    lens: Lens,
    source: Source | Sources,
    xi: ArrayLike,
    eta: ArrayLike,
    stop: Stop | None = None,
) -> np.ndarray:
    """Return (OPL chief − OPL ray)/λ in waves at pupil points, on the sphere about the chief ray's sensor point.

    The sphere passes through the chief ray's point in the paraxial exit-pupil plane; for a telecentric lens it is a
    plane. NaN for failed rays. For display only; diffraction integrals use `Rays.phase`.
    """
    rays = pencil(lens, source, xi, eta, stop=stop)
    return opd_on_sphere(rays, exit_radius(lens, source, rays, stop))


def opd_on_sphere(rays: Rays, radius: FloatOrArray) -> np.ndarray:
    """Return the displayed OPD in waves for a reference sphere of signed radius (mm, positive before the sensor).

    The ray's path back from the sensor to the sphere is written as a difference from the chief ray's, so that no
    digits are lost at any radius: t − t_chief = −b − (b² − d²)/(R(1 + √(1 + (b² − d²)/R²))), b = K·(I − C),
    d = |I − C|. NaN for a ray that does not meet the sphere.
    """
    b = rays.kx * rays.dx + rays.ky * rays.dy
    bend = b * b - rays.dx * rays.dx - rays.dy * rays.dy
    with np.errstate(invalid="ignore"):
        back = bend / (radius * (1 + np.sqrt(1 + bend / radius**2)))
    opd: np.ndarray = (rays.index * (b + back) - rays.path) * (UM_PER_MM / rays.wavelength_um)
    return opd


def exit_radius(lens: Lens, source: Source | Sources, rays: Rays, stop: Stop | None = None) -> np.ndarray:
    """Return the radius of the reference sphere: from the exit pupil's plane to the sensor along the chief ray, mm.

    It has the sign of the way of light, and is infinite for a pupil at infinity. `field_geometry` says where the exit
    pupil of a misaligned lens is.
    """
    chief = np.stack(np.broadcast_arrays(rays.chief_kx, rays.chief_ky, rays.chief_kz))
    place = np.stack(np.broadcast_arrays(rays.chief_x, rays.chief_y, 0.0 * rays.chief_y))
    if lens.sensor_surface.curvature:
        place[2] = lens.sensor_surface.sag(place[0], place[1])
        chief = np.einsum("ij...,j...->i...", tangent_axes(lens, place[0], place[1]), chief)
    if not lens.misaligned:
        radius: np.ndarray = (lens.sensor_mm + place[2] - entrance(lens, source, stop).exit_plane) / chief[2]
        return radius
    waves = np.broadcast_to(rays.wavelength_um, place.shape[1:])
    found = np.empty(waves.shape)
    for wave in np.unique(waves):
        some = waves == wave
        pupil = exit_pupil(lens, _near_axis(source, float(wave)))
        found[some] = pupil.radius_mm(place[:, some], chief[:, some])
    return found


def _near_axis(source: Source | Sources, wavelength_um: float) -> Source:
    """Return a source, or the one nearest to the axis of several, at a wavelength."""
    slopes, depths = np.ravel(source.field_slope), np.ravel(source.depth_mm)
    slope = float(slopes[np.argmin(np.abs(slopes))])
    return Source(float(depths[0]), slope, wavelength_um, azimuth_deg=getattr(source, "azimuth_deg", 0.0))


@lru_cache(maxsize=8)
def pupil_grid(count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return cell-centre coordinates (ξ, η) of a count × count grid over the pupil, and which lie in the disc."""
    axis = (2 * np.arange(count) + 1 - count) / count
    xi, eta = np.meshgrid(axis, axis)
    inside = xi * xi + eta * eta <= 1
    return write_protect(xi), write_protect(eta), write_protect(inside)


def opd_map(lens: Lens, source: Source, count: int = 64) -> np.ndarray:
    """Return the displayed OPD over the pupil, (count, count) waves, row = η, NaN outside.

    Half the disc is traced, of a misaligned lens all of it.
    """
    (xi, eta, inside), domain = pupil_grid(count), lens.pupil_domain
    values = np.full((count, count), np.nan)
    own = inside & (xi >= min(0, *domain.halves))
    waves = displayed_opd(lens, source, xi[own], eta[own])
    for image in domain.images:
        values[:, ::image][own] = waves
    return values


def hexapolar(rings: int) -> tuple[np.ndarray, np.ndarray]:
    """Return pupil points (ξ, η): the centre, then rings of 6, 12, 18 … points, equal area per point.

    Inside ring k there are 1 + 3k(k − 1) of all 1 + 3n(n + 1) points and its own are 6k, so the middle of its share of
    the area lies at ρ² = (1 + 3k²)/(1 + 3n(n + 1)). No point lies on the rim.
    """
    square = [(1 + 3 * k * k) / (1 + 3 * rings * (rings + 1)) for k in range(1, rings + 1)]
    radius = np.concatenate([[0.0], *(np.full(6 * k, sqrt(s)) for k, s in enumerate(square, 1))])
    angle = np.concatenate([[0.0], *(2 * np.pi * np.arange(6 * k) / (6 * k) for k in range(1, rings + 1))])
    return radius * np.sin(angle), radius * np.cos(angle)


def to_the_rim(rings: int) -> tuple[np.ndarray, np.ndarray]:
    """Return `hexapolar` points spread until the outermost ring lies on the rim, whose rays often go farthest."""
    xi, eta = hexapolar(rings)
    outermost = eta.max()
    return xi / outermost, eta / outermost
