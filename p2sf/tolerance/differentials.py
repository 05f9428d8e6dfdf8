"""Derivatives of a wavefront with respect to manufacturing errors, to second order, from exact rays.

At fixed points of the stop the phase of `raytrace.pencil` is W(p) = W + Σ pᵢ∂ᵢW + ½Σ pᵢpⱼ∂ᵢⱼW. The derivatives by one
error are differences of rays through lenses with that error, both ways. Those by two errors are differences, by one of
them, of the derivative by the other from Fermat's principle: where a surface moves by δ, the optical path of a ray
changes by −(n′K′ − nK)·δ. So two lenses are traced per error, and not one for every pair. With the landing points I of
a ray and C of the chief ray, and W = V − n′K·(I − C) for paths V, the change at fixed points of the stop is

    ∂ᵢW = gᵢ − n′∂ᵢK·(I − C) + n′(K − K chief)·∂ᵢC,

gᵢ by Fermat; of its derivative by another error only −n′∂ᵢⱼK·(I − C), an aberration times a second-order change of
direction, is neglected. The displayed wavefront, to which the RMS refers (handbook 3.4), is on the reference sphere of
radius R: it lacks the n′((K·(I − C))² − |I − C|²)/2R of the phase, whose derivative by two errors is, to the same
accuracy, n′(K·∂ᵢI K·∂ⱼI − ∂ᵢI·∂ⱼI)/R with I relative to C. By one error the phase is about the image instead of C
(`image_um`). Also neglected are the products of an irregularity, of some waves, with all errors except the back focus,
which compensates for it and is large: only the sensor moves, and C and I by the slopes of the rays there.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.disc.mask_nodes import mask_nodes
from p2sf.disc.quadrature import whole_disc
from p2sf.errors import Cancelled, GeometryError
from p2sf.lens.lens import Lens, with_sensor
from p2sf.lens.placement import Motion, Placement, along_z
from p2sf.lens.source import Source
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.pencil import (
    Crossings,
    Rays,
    all_reaching,
    exit_radius,
    opd_on_sphere,
    rays_through,
    reaching_by_surfaces,
    tangent_axes,
)
from p2sf.threads import one_blas_thread
from p2sf.tolerance.errors_of_build import IRREGULAR, MOVES, Tolerance, build, placement_of, source_of_build

NODES = 6, 12  # radii and directions of the rays
FINE = 16, 40  # those of the lens without errors, which resolve exp(2πiW) if the lens itself has waves of aberration
FINEST = 40, 96  # behind a filter or a phase, which may be anything
FIELDS = 0.0, 0.7, 1.0  # of the largest field of a lens
STEP = 0.6  # of a tolerance: the RMS of a uniformly distributed error within it
LEAST_STEP = 1e-5
UNMOVED = Placement()


@dataclass(frozen=True, eq=False)
class OpenRays:
    """Rays of one source through the open part of the stop, of the lens or of a build, all (rays,).

    ``share``: of the open area, ``weight``: of the field at the focus, some of both negative where a mask has vanes or
    blades. ``phase``: waves, including that of a mask, and ``wavefront`` the same on the reference sphere, as in
    `wavefront_of`; of a build without piston and tilt, the phase at the focus.
    """

    rays: Rays
    share: np.ndarray
    weight: np.ndarray
    phase: np.ndarray
    wavefront: np.ndarray

    @property
    def frequencies(self) -> np.ndarray:
        """Return the frequencies in which the phase of a shifted image is linear, (2, rays)."""
        return np.stack([self.rays.fx, self.rays.fy])

    @property
    def axes(self) -> np.ndarray:
        """Return the coordinates in which a tilt of the wavefront is linear, (2, rays)."""
        return np.stack([self.rays.xi, self.rays.eta])


_COLUMNS = {
    **dict.fromkeys(("weight", "phase", "fx", "fy"), 0),
    **{"first": 1, "second": 2, "first_of_wavefront": 1, "second_of_wavefront": 2, "chief_um": 1, "stretch": 1},
}
"""The results of `_of_source`, and the axis of the fields in each."""


@dataclass(frozen=True, eq=False)
class Differentials:
    """Waves at the rays of every field, (fields, rays), and their derivatives by errors, whose axes come first.

    They refer to the clear stop. ``weight``: shares of the light of each ray. ``fx``, ``fy``: its frequencies, cycles
    per µm. ``first``: (errors, fields, rays) waves of phase per unit, ``second``: (errors, errors, fields, rays).
    ``first_of_wavefront``, ``second_of_wavefront``: the same of the displayed wavefront (`wavefront_of`). ``chief_um``:
    (errors, fields, 2), shift of the chief ray on the sensor, µm per unit. ``stretch``: (errors, fields, 2), the share
    by which frequencies grow along x and y, per unit. ``fine``: for every field more rays through the lens without
    errors, over the open part of its pupil mask.
    """

    lens: Lens
    sources: tuple[Source, ...]
    tolerances: tuple[Tolerance, ...]
    weight: np.ndarray
    phase: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    first: np.ndarray
    second: np.ndarray
    first_of_wavefront: np.ndarray
    second_of_wavefront: np.ndarray
    chief_um: np.ndarray
    stretch: np.ndarray
    fine: tuple[OpenRays, ...]

    @property
    def amounts(self) -> np.ndarray:
        """Return the tolerances, (errors,), each in its unit."""
        return np.array([tolerance.amount for tolerance in self.tolerances])


@one_blas_thread
def differentials(
    lens: Lens,
    sources: Sequence[Source],
    tolerances: Sequence[Tolerance],
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> Differentials:
    """Return the wavefront differentials of a lens for some sources, all of one wavelength.

    Raises GeometryError if a ray does not reach the sensor, also in a lens with one of the errors, and Cancelled.
    """
    if len({source.wavelength_um for source in sources}) != 1:
        raise GeometryError("the fields of tolerances have several wavelengths; give them one")
    known = tuple(tolerances)
    steps = np.array([max(STEP * tolerance.amount, LEAST_STEP) for tolerance in known])
    total, done = max(len(sources) * len(known), 1), 0

    def one_more() -> None:
        nonlocal done
        done += 1
        if cancelled and cancelled():
            raise Cancelled("the sensitivities were cancelled before they were known")
        if progress:
            progress(done / total)

    parts = [_of_source(lens, source, known, steps, one_more) for source in sources]
    columns = dict(zip(_COLUMNS, zip(*parts, strict=True), strict=True))
    stacked = {name: np.stack(rows, axis=_COLUMNS[name]) for name, rows in columns.items()}
    fine = tuple(open_rays(lens, source) for source in sources)
    return Differentials(lens, tuple(sources), known, fine=fine, **stacked)


def usual_sources(lens: Lens, source: Source) -> tuple[Source, ...]:
    """Return sources at 0, 0.7 and 1 of the lens's field, otherwise as ``source``; ``source`` if there is no field."""
    x, y = lens.field_places_deg[-1]
    if not (x or y):
        return (source,)
    depth, wavelength = source.depth_mm, source.wavelength_um
    return tuple(Source(depth, field_deg=(part * x, part * y), wavelength_um=wavelength) for part in FIELDS)


def open_rays(lens: Lens, source: Source, counts: tuple[int, int] = FINE) -> OpenRays:
    """Return many rays through the lens without errors and its pupil mask, at least ``counts`` radii × directions."""
    mask = mask_seen(lens, source)
    if mask.shaded or mask.phased:
        counts = max(counts[0], FINEST[0]), max(counts[1], FINEST[1])
    nodes = mask_nodes(mask, *counts).unfolded()
    rays = all_reaching(rays_through(lens, source, nodes))
    weight, share = rays.share * rays.amplitude, np.asarray(rays.share)
    wavefront = wavefront_of(lens, source, rays) + rays.mask_path_um / source.wavelength_um
    return OpenRays(rays, share / share.sum(), weight / weight.sum(), rays.phase, wavefront)


def wavefront_of(lens: Lens, source: Source, rays: Rays) -> np.ndarray:
    """Return the displayed wavefront of rays, waves, with the sign of a phase and without the mask's path."""
    return -opd_on_sphere(rays, exit_radius(lens, source, rays))


@dataclass(frozen=True, eq=False)
class _Differences:
    """Differences of rays through lenses with one error either way, per unit of it, the errors first.

    ``first``, ``pure``: (2, errors, rays), derivatives of the phase about the image and of the displayed wavefront,
    ``pure`` the second by one error, 0 of irregularities.
    ``chief_um``: (errors, 2). ``turn``: (errors, 2, rays + 1) of the cosines along x and y, ``shift``: (errors, 2,
    rays) of the landing points from the chief ray's, mm. ``paths``: (errors, errors, rays), by the first of the change
    of path that the second makes, waves.
    """

    first: np.ndarray
    pure: np.ndarray
    chief_um: np.ndarray
    turn: np.ndarray
    shift: np.ndarray
    paths: np.ndarray


def _of_source(
    lens: Lens, source: Source, tolerances: tuple[Tolerance, ...], steps: np.ndarray, after_each: Callable[[], None]
) -> tuple[np.ndarray, ...]:
    """Return weight, phase, fx, fy, first and second derivatives, the chief ray's, and stretch, of one source."""
    nodes = whole_disc(*NODES)
    still = reaching_by_surfaces(lens, source, *nodes[:2])
    weight = nodes[2] * still.amplitude
    weight = weight / weight.sum()
    found = _differences(lens, source, (still, image_um(still, weight)), tolerances, steps, after_each)
    of_phase, of_wavefront = _second(lens, tolerances, found, source, still)
    stretch = _stretch(_cosines(still)[:, :-1], found.turn[:, :, :-1], weight)
    waves = found.first[0], of_phase, found.first[1], of_wavefront
    return weight, still.phase, still.fx, still.fy, *waves, found.chief_um, stretch


def through_build(designed: Lens, built: Lens, source: Source, xi: np.ndarray, eta: np.ndarray) -> Rays:
    """Return the rays of a source, positioned as for ``designed``, through points of the stop of a build."""
    return reaching_by_surfaces(built, source_of_build(designed, built, source), xi, eta)


def image_um(still: Rays, weight: np.ndarray) -> np.ndarray:
    """Return the point about which the phase is smallest, x and y in µm from the chief ray's landing point.

    About it little tilt remains in a perturbed lens. A tilt is X·f with the frequencies of that lens, and their
    differences from those of the lens without errors, times a large X, would remain as aberrations.
    """
    flat = np.stack([np.ones_like(weight), still.fx, still.fy])
    amounts: np.ndarray = np.linalg.lstsq(flat * weight @ flat.T, flat @ (weight * still.phase), rcond=None)[0]
    return -amounts[1:]


def _differences(
    lens: Lens,
    source: Source,
    designed: tuple[Rays, np.ndarray],
    tolerances: tuple[Tolerance, ...],
    steps: np.ndarray,
    after_each: Callable[[], None],
) -> _Differences:
    """Return differences of the rays of ``designed``, whose phases are about a place near the image."""
    (still, (x, y)), nodes = designed, whole_disc(*NODES)[:2]
    count, rays, wavelength = len(tolerances), still.phase.size, source.wavelength_um
    first, pure, paths = np.empty((2, count, rays)), np.zeros((2, count, rays)), np.empty((count, count, rays))
    chief, turn, shift = np.empty((count, 2)), np.empty((count, 2, rays + 1)), np.empty((count, 2, rays))

    def both(built: Lens, one: Rays) -> np.ndarray:
        return np.stack([one.phase + x * one.fx + y * one.fy, wavefront_of(built, source, one)])

    waves_still = both(lens, still)
    for place, step in enumerate(steps):
        builds = [build(lens, tolerances[place : place + 1], [error]) for error in (step, -step)]
        more, less = (through_build(lens, built, source, *nodes) for built in builds)
        waves = both(builds[0], more), waves_still, both(builds[1], less)
        first[:, place] = (waves[0] - waves[2]) / (2 * step)
        chief[place] = (more.chief_um - less.chief_um) / (2 * step)
        after_each()
        turn[place] = (_cosines(more) - _cosines(less)) / (2 * step)
        there = _gradient(more.on_surfaces, tolerances, wavelength, place, step)
        paths[place] = (there - _gradient(less.on_surfaces, tolerances, wavelength, place, -step)) / (2 * step)
        shift[place] = np.stack([more.dx - less.dx, more.dy - less.dy]) / (2 * step)
        if tolerances[place].kind not in IRREGULAR:
            pure[:, place] = (waves[0] - 2 * waves[1] + waves[2]) / step**2
    return _Differences(first, pure, chief, turn, shift, paths)


def _second(
    lens: Lens, tolerances: tuple[Tolerance, ...], found: _Differences, source: Source, still: Rays
) -> tuple[np.ndarray, np.ndarray]:
    """Return the second derivatives of phase and displayed wavefront, (errors, errors, rays) waves per unit of both."""
    turn, waves = found.turn, UM_PER_MM / source.wavelength_um
    uneven = [place for place, one in enumerate(tolerances) if one.kind in IRREGULAR]
    shift = found.shift.copy()
    shift[uneven] = 0.0
    second = found.paths - waves * np.einsum("ixr,jxr->jir", turn[:, :, :-1], shift)
    second += np.einsum("jxr,ix->jir", turn[:, :, :-1] - turn[:, :, -1:], found.chief_um) / source.wavelength_um
    along = np.einsum("xr,ixr->ir", np.stack([still.kx, still.ky]), found.shift)
    back = along[:, None] * along - np.einsum("ixr,jxr->ijr", found.shift, found.shift)
    on_sphere = second - back * (waves * still.index / exit_radius(lens, source, still))
    focus = _back_focus(lens, tolerances)
    of_phase, of_wavefront = (
        _symmetric(values, pure, uneven, focus) for values, pure in zip((second, on_sphere), found.pure, strict=True)
    )
    return of_phase, of_wavefront


def _symmetric(second: np.ndarray, pure: np.ndarray, uneven: list[int], focuses: list[int]) -> np.ndarray:
    """Return second derivatives by two errors, symmetrised, and by one; irregularities mix only with the back focus."""
    every = np.arange(len(second))
    both: np.ndarray = (second + second.swapaxes(0, 1)) / 2
    both[every, every] = pure
    both[uneven] = both[:, uneven] = 0.0
    for focus in focuses:
        both[uneven, focus] = both[focus, uneven] = second[uneven, focus]
    return both


def _cosines(rays: Rays) -> np.ndarray:
    """Return optical cosines along the sensor's x and y, (2, ray), the chief ray last."""
    pairs = (rays.kx, rays.chief_kx), (rays.ky, rays.chief_ky)
    cosines: np.ndarray = np.stack([np.append(*pair) for pair in pairs]) * rays.index
    return cosines


def _back_focus(lens: Lens, tolerances: tuple[Tolerance, ...]) -> list[int]:
    """Return which errors only move the sensor along the axis."""
    last = "thickness", len(lens.surfaces)
    return [place for place, one in enumerate(tolerances) if (one.kind, one.first) == last]


def with_moved_sensor(lens: Lens, rays: Rays, by_mm: float) -> tuple[Lens, Rays]:
    """Return the lens with its sensor farther behind its last surface, and its rays there."""
    moved = with_sensor(lens, lens.sensor_mm + by_mm)
    axis = lens.frames[-1][0].T @ _axes_behind(lens, len(lens.surfaces) - 1).rotation[:, 2]
    if lens.sensor_surface.curvature:
        axis = tangent_axes(lens, *(float(np.ravel(place)[0]) for place in (rays.chief_x, rays.chief_y))).T @ axis
    way, chief = by_mm * axis[2] / rays.kz, by_mm * axis[2] / rays.chief_kz
    dx, dy = rays.dx + rays.kx * way - rays.chief_kx * chief, rays.dy + rays.ky * way - rays.chief_ky * chief
    return moved, replace(rays, dx=dx, dy=dy, path=rays.path + rays.index * (way - chief), crossings=None)


def _stretch(cosines: np.ndarray, change: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return the slope of each change (errors, 2, rays) over the cosines (2, rays), (errors, 2), by least squares."""
    apart = cosines - (cosines @ weight)[:, None]
    slope: np.ndarray = (change * apart) @ weight / (apart**2 @ weight)
    return slope


def _gradient(
    found: Crossings, tolerances: tuple[Tolerance, ...], wavelength_um: float, moved: int, error: float
) -> np.ndarray:
    """Return ∂(path)/∂(error) of every tolerance minus the chief ray's, (errors, rays) waves, by Fermat's principle.

    The lens has one error, that of tolerance ``moved``. Where a surface moves by δ at the points of rays, their paths
    change by −(n′K′ − nK)·δ; behind the sensor there is no K′.
    """
    onward = np.concatenate([found.cosines[1:], np.zeros_like(found.cosines[:1])])
    kicks = onward - found.cosines
    change = _rigid_motions(found, tolerances, moved, error) @ _wrenches(found, kicks)
    for number, tolerance in enumerate(tolerances):
        if tolerance.kind not in MOVES and tolerance.kind not in IRREGULAR:
            change[number] = _path_change(found, kicks, tolerance)
    out: np.ndarray = (change[:, :-1] - change[:, -1:]) * (UM_PER_MM / wavelength_um)
    return out


def _path_change(found: Crossings, kicks: np.ndarray, tolerance: Tolerance) -> np.ndarray:
    """Return the change of the optical path of every ray with a radius, thickness or index, mm per unit, (rays,)."""
    place = tolerance.first - 1
    if tolerance.kind == "radius":
        radius: np.ndarray = -(kicks[place] * _radius_shift(found, place)).sum(0)
        return radius
    behind = found.cosines[place + 1]
    if tolerance.kind == "thickness":
        along: np.ndarray = _axes_behind(found.lens, place).rotation[:, 2] @ behind
        return along
    crossed = found.points[place + 1] - found.points[place]
    length: np.ndarray = (crossed * behind).sum(0) / np.sqrt((behind * behind).sum(0))
    return length


def _wrenches(found: Crossings, kicks: np.ndarray) -> np.ndarray:
    """Return the kicks n′K′ − nK of rays at every surface and their moments about its vertex, (surfaces·6, rays).

    A point of a rigid body moves by v + ω × p, and its product with a kick k is v·k + ω·(p × k).
    """
    vertices = np.array([motion.origin for motion in found.lens.frames])
    x, y, z = (found.points - vertices[..., None]).swapaxes(0, 1)
    p, q, r = kicks.swapaxes(0, 1)
    return np.stack([p, q, r, y * r - z * q, z * p - x * r, x * q - y * p], axis=1).reshape(-1, x.shape[-1])


def _rigid_motions(found: Crossings, tolerances: tuple[Tolerance, ...], moved: int, error: float) -> np.ndarray:
    """Return −v and −ω of every surface for a unit of every decentre or tilt, (errors, surfaces·6); 0 of other errors.

    v is the motion of the vertex, mm, and ω the rotation in radians.
    """
    lens = found.lens
    motions = np.zeros((len(tolerances), len(lens.frames), 6))
    there = placement_of({tolerances[moved].kind: error}) if tolerances[moved].kind in MOVES else UNMOVED
    for number, tolerance in enumerate(tolerances):
        if tolerance.kind not in MOVES:
            continue
        for surface in range(tolerance.first - 1, tolerance.piece[1]):
            mount, own = _mount(lens, tolerances, number, moved, there, surface)
            motions[number, surface] = _rigid(lens.frames[surface].origin, tolerance, mount, own)
    return -motions.reshape(len(tolerances), -1)


def _rigid(vertex: np.ndarray, tolerance: Tolerance, mount: Motion, own: Placement) -> list[float]:
    """Return motion and rotation of a vertex of a piece by a unit of decentre or tilt, in the axes of the lens.

    ``mount``: the axes in which the piece is mounted; ``own``: its placement in them.
    """
    axis = 0 if tolerance.kind.endswith("x") else 1
    if tolerance.kind.startswith("decentre"):
        return [*mount.rotation[:, axis].tolist(), 0.0, 0.0, 0.0]
    tilt = np.deg2rad(own.tilt_x_deg) * axis  # the y axis is rotated about x first
    turned = np.array([1 - axis, axis * np.cos(tilt), axis * np.sin(tilt)])
    a, b, c = (np.deg2rad(1) * (mount.rotation @ turned)).tolist()
    x, y, z = (vertex - mount.origin - mount.rotation @ np.array(own.decentre)).tolist()
    return [b * z - c * y, c * x - a * z, a * y - b * x, a, b, c]


def _radius_shift(found: Crossings, place: int) -> np.ndarray:
    """Return the motion of the surface along its axis at the rays, per percent of its radius.

    From c·r² − 2z + c(1 + K)z² = 0: ∂z/∂c = (r² + (1 + K)z²)/(2(1 − c(1 + K)z)).
    """
    rotation, origin = found.lens.frames[place]
    surface = found.lens.surfaces[place]
    c, k = surface.curvature, 1 + surface.conic
    x, y, _ = rotation.T @ (found.points[place] - origin[:, None])
    square = x * x + y * y
    z = c * square / (1 + np.sqrt(1 - k * c * c * square))
    along = (square + k * z * z) / (2 * (1 - c * k * z)) * (-c / 100)
    shift: np.ndarray = rotation[:, 2:] * along
    return shift


def _mount(
    lens: Lens, tolerances: tuple[Tolerance, ...], number: int, moved: int, there: Placement, surface: int
) -> tuple[Motion, Placement]:
    """Return the axes in which a piece is mounted, and its placement in them, with error ``moved`` alone: ``there``.

    For a ``surface`` of it, from 0: of two pieces that start together the later one is moved in addition to the other,
    and carries only the surfaces that belong to both.
    """
    tolerance, other = tolerances[number], tolerances[moved]
    here = lens.frames[tolerance.first - 1]
    if other.kind not in MOVES or other.first != tolerance.first:
        return here, UNMOVED
    if other.piece == tolerance.piece:
        return here.then(there.motion.inverse), there
    order = [one.piece for one in tolerances if one.kind in MOVES]
    inner = order.index(other.piece) < order.index(tolerance.piece)
    apart = inner or surface >= other.piece[1]
    return (here.then(there.motion.inverse) if apart else here), UNMOVED


def _axes_behind(lens: Lens, place: int) -> Motion:
    """Return the axes behind a surface, along whose z its thickness is measured."""
    motion = lens.frames[place]
    for placement in lens.surfaces[place].after:
        motion = motion.then(placement.motion)
    return motion.then(along_z(0.0))
