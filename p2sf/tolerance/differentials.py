"""How a wavefront changes with every error of a build, to second order, from exact rays.

At fixed points of the stop the phase of `raytrace.pencil` is W(p) = W + Σ pᵢ∂ᵢW + ½Σ pᵢpⱼ∂ᵢⱼW. The derivatives by one
error are differences of rays through lenses with that error, either way. Those by two are differences, by one, of what
Fermat's principle gives for the other: where a surface moves by δ, the optical path of a ray changes by −(n′K′ − nK)·δ.
So as many lenses are traced as there are errors, twice, and not one for every pair. With I where a ray lands, C where
the chief ray does, and W = V − n′K·(I − C) of paths V, the change at fixed points of the stop is

    ∂ᵢW = gᵢ − n′∂ᵢK·(I − C) + n′(K − K chief)·∂ᵢC,

gᵢ by Fermat; of its derivative by another error only −n′∂ᵢⱼK·(I − C), an aberration times a second-order change of
direction, is left out. So is all that an irregularity, of waves, does together with another error.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import Cancelled, GeometryError
from p2sf.lens.lens import Lens, seen_from
from p2sf.lens.placement import Motion, Placement, along_z
from p2sf.lens.source import Source
from p2sf.pupil.mask_nodes import mask_nodes
from p2sf.pupil.quadrature import whole_disc
from p2sf.raytrace.aiming import pupil_rays, start
from p2sf.raytrace.seen_mask import mask_seen
from p2sf.raytrace.surface import Status
from p2sf.raytrace.trace import run
from p2sf.threads import one_blas_thread
from p2sf.tolerance.errors_of_build import IRREGULAR, MOVES, Tolerance, build, placed

NODES = 6, 12  # radii and directions of the rays
FINE = 16, 40  # those of the lens without errors, which carry exp(2πiW) where the lens itself has waves of aberration
FINEST = 40, 96  # behind a filter or a phase, which may be anything
FIELDS = 0.0, 0.7, 1.0  # of the largest field of a lens
STEP = 0.6  # of a tolerance: the root mean square of an error that is anywhere within it
LEAST_STEP = 1e-5


@dataclass(frozen=True, eq=False)
class OpenRays:
    """Rays of one source through what the stop leaves open, all (rays,), at points (ξ, η) of it.

    ``weight``: shares of the field at the focus, some of them negative where a mask has vanes or blades. ``phase``:
    waves, that of a mask included. ``fx``, ``fy``: frequencies, cycles per µm.
    """

    xi: np.ndarray
    eta: np.ndarray
    weight: np.ndarray
    phase: np.ndarray
    fx: np.ndarray
    fy: np.ndarray


@dataclass(frozen=True, eq=False)
class Differentials:
    """Waves at the rays of every field: (fields, rays), and what errors add, the axes of these first.

    They are those of the clear stop. ``weight``: shares of the light of each ray. ``fx``, ``fy``: its frequencies,
    cycles per µm. ``first``: (errors, fields, rays) waves per unit, ``second``: (errors, errors, fields, rays).
    ``chief_um``: (errors, fields, 2), how far the chief ray moves on the sensor, µm per unit. ``fine``: for every field
    more rays through the lens without errors, over what a mask in its stop leaves open.
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
    chief_um: np.ndarray
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

    Raises GeometryError where a ray does not reach the sensor, also of a lens with one of the errors, and Cancelled.
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
            raise Cancelled("the sensitivities were stopped before they were known")
        if progress:
            progress(done / total)

    parts = [_of_source(lens, source, known, steps, one_more) for source in sources]
    weight, phase, fx, fy, first, second, chief = (np.stack(column, axis) for column, axis in _columns(parts))
    fine = tuple(_open_rays(lens, source) for source in sources)
    return Differentials(lens, tuple(sources), known, weight, phase, fx, fy, first, second, chief, fine)


def usual_sources(lens: Lens, source: Source) -> tuple[Source, ...]:
    """Return the axis, seven tenths and the edge of the lens's field, else as ``source``; that one without a field."""
    top = max(lens.fields_deg, key=abs)
    if not top:
        return (source,)
    depth, wavelength = source.depth_mm, source.wavelength_um
    return tuple(Source(depth, field_deg=part * top, wavelength_um=wavelength) for part in FIELDS)


def _open_rays(lens: Lens, source: Source) -> OpenRays:
    """Return many rays through the lens without errors and the mask in its stop."""
    mask = mask_seen(lens, source)
    nodes = mask_nodes(mask, *(FINEST if mask.shaded or mask.phased else FINE)).unfolded()
    found = fly(lens, source, nodes.xi, nodes.eta)
    weight = nodes.weight * nodes.amplitude * found.weight
    phase = found.phase + nodes.path_um / source.wavelength_um
    return OpenRays(nodes.xi, nodes.eta, weight / weight.sum(), phase, found.fx, found.fy)


def _columns(parts: list[tuple[np.ndarray, ...]]) -> list[tuple[list[np.ndarray], int]]:
    """Return each quantity of all fields, and which axis the fields take in it."""
    return [(list(column), axis) for column, axis in zip(zip(*parts, strict=True), (0, 0, 0, 0, 1, 2, 1), strict=True)]


@dataclass(frozen=True, eq=False)
class Flight:
    """Rays of one source through one lens, the chief ray last, in the axes of the lens.

    ``points``: (surfaces + 1, 3, ray) on every surface and the sensor, mm. ``rays``: optical cosines as they arrive
    there. ``phase``: waves, without the chief ray. ``chief_um``: where that lands. ``cosines``: (2, ray) optical ones
    along the sensor's x and y. ``landing``: (2, ray), mm from the chief ray.
    """

    lens: Lens
    points: np.ndarray
    rays: np.ndarray
    phase: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    weight: np.ndarray
    chief_um: np.ndarray
    cosines: np.ndarray
    landing: np.ndarray


def fly(lens: Lens, source: Source, xi: np.ndarray, eta: np.ndarray) -> Flight:
    """Return the rays through points of the stop; GeometryError where one does not reach the sensor."""
    lens = seen_from(lens, source.azimuth_deg)
    rays = pupil_rays(lens, source, np.append(xi, 0.0), np.append(eta, 0.0))
    beam, points, along = start(rays), [], []

    def visit(number: int) -> None:
        rotation, origin = lens.frames[number - 1]
        points.append(rotation @ beam.place + origin[:, None])
        along.append(rotation @ beam.ray)

    run(lens, beam, rays.index, visit=visit)
    lost = beam.status != Status.PASSED
    if lost.any():
        raise GeometryError(
            "{lost} of {total} rays do not reach the sensor; stop the lens down or reduce the field",
            lost=int(lost.sum()),
            total=xi.size,
        )
    path = beam.path + rays.path
    (dx, dy), (p, q) = (values[:2, :-1] - values[:2, -1:] for values in (beam.place, beam.ray))
    phase = path[:-1] - path[-1] - beam.p[:-1] * dx - beam.q[:-1] * dy
    waves = UM_PER_MM / source.wavelength_um
    light = np.broadcast_to(rays.weight, xi.shape[0] + 1)[:-1]
    chief = UM_PER_MM * beam.place[:2, -1]
    scale = 1 / source.wavelength_um
    made = lens, np.stack(points), np.stack(along), phase * waves, p * scale, q * scale, light, chief
    return Flight(*made, beam.ray[:2].copy(), np.stack([dx, dy]))


def _of_source(
    lens: Lens, source: Source, tolerances: tuple[Tolerance, ...], steps: np.ndarray, after_each: Callable[[], None]
) -> tuple[np.ndarray, ...]:
    """Return weight, phase, fx, fy, first and second derivatives, and the chief ray's, of one source."""
    nodes, wavelength = whole_disc(*NODES)[:2], source.wavelength_um
    still = fly(lens, source, *nodes)
    count, rays = len(tolerances), still.phase.size
    first, second, chief = np.empty((count, rays)), np.zeros((count, count, rays)), np.empty((count, 2))
    pure = np.zeros((count, rays))
    turn, shift = np.zeros((count, 2, rays + 1)), np.zeros((count, 2, rays))
    for place, step in enumerate(steps):
        one = tolerances[place : place + 1]
        more, less = (fly(build(lens, one, [error]), source, *nodes) for error in (step, -step))
        first[place] = (more.phase - less.phase) / (2 * step)
        chief[place] = (more.chief_um - less.chief_um) / (2 * step)
        after_each()
        if tolerances[place].kind in IRREGULAR:
            continue
        turn[place] = (more.cosines - less.cosines) / (2 * step)
        shift[place] = (more.landing - less.landing) / (2 * step)
        there = _gradient(more, tolerances, wavelength, place, step)
        second[place] = (there - _gradient(less, tolerances, wavelength, place, -step)) / (2 * step)
        pure[place] = (more.phase - 2 * still.phase + less.phase) / step**2
    # second[j, i] = ∂ⱼgᵢ so far
    waves = UM_PER_MM / wavelength
    second -= waves * np.einsum("ixr,jxr->jir", turn[:, :, :-1], shift)
    second += np.einsum("jxr,ix->jir", turn[:, :, :-1] - turn[:, :, -1:], chief) / wavelength
    second = (second + second.swapaxes(0, 1)) / 2
    second[np.arange(count), np.arange(count)] = pure
    slight = [place for place, one in enumerate(tolerances) if one.kind in IRREGULAR]
    second[slight] = second[:, slight] = 0.0
    weight = whole_disc(*NODES)[2] * still.weight
    return weight / weight.sum(), still.phase, still.fx, still.fy, first, second, chief


def _gradient(
    found: Flight, tolerances: tuple[Tolerance, ...], wavelength_um: float, moved: int, error: float
) -> np.ndarray:
    """Return ∂(path)/∂(error) of every tolerance less the chief ray's, (errors, rays) waves, by Fermat's principle.

    The lens has one error, that of tolerance ``moved``.
    """
    rows = [_path_change(found, tolerances, number, moved, error) for number in range(len(tolerances))]
    change = np.stack(rows)
    out: np.ndarray = (change[:, :-1] - change[:, -1:]) * (UM_PER_MM / wavelength_um)
    return out


def _path_change(found: Flight, tolerances: tuple[Tolerance, ...], number: int, moved: int, error: float) -> np.ndarray:
    """Return how the optical path of every ray changes with one error, mm per unit, (rays,); 0 for irregularities."""
    tolerance, lens = tolerances[number], found.lens
    place = tolerance.first - 1
    if tolerance.kind in IRREGULAR:
        return np.zeros(found.points.shape[-1])
    if tolerance.kind == "thickness":
        behind = found.rays[place + 1]
        turn = _behind(lens, place).rotation[:, 2]
        along: np.ndarray = turn @ behind
        return along
    if tolerance.kind == "index":
        behind = found.rays[place + 1]
        crossed = found.points[place + 1] - found.points[place]
        length: np.ndarray = (crossed * behind).sum(0) / np.sqrt((behind * behind).sum(0))
        return length
    if tolerance.kind == "radius":
        return _push(found, place, _radius_shift(found, place))
    change: np.ndarray = np.zeros(found.points.shape[-1])
    for surface in range(place, tolerance.piece[1]):
        mount, own = _mount(lens, tolerances, number, moved, error, surface)
        change += _push(found, surface, _rigid(found, surface, tolerance, mount, own))
    return change


def _push(found: Flight, place: int, shift: np.ndarray) -> np.ndarray:
    """Return −(n′K′ − nK)·δ of every ray at a surface that moves by δ, (3, rays); behind the sensor there is no K′."""
    onward = found.rays[place + 1] if place + 1 < len(found.rays) else 0.0
    push: np.ndarray = -((onward - found.rays[place]) * shift).sum(0)
    return push


def _radius_shift(found: Flight, place: int) -> np.ndarray:
    """Return by how much the surface moves along its axis where rays meet it, per percent of its radius.

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


def _rigid(found: Flight, place: int, tolerance: Tolerance, mount: Motion, own: Placement) -> np.ndarray:
    """Return the motion of a piece's points for a unit of decentre or tilt, in the axes that it is mounted in."""
    axis = 0 if tolerance.kind.endswith("x") else 1
    if tolerance.kind.startswith("decentre"):
        return np.broadcast_to(mount.rotation[:, axis, None], found.points[place].shape)
    turned = Placement(tilt_x_deg=own.tilt_x_deg).motion.rotation if axis else np.eye(3)
    about = np.deg2rad(1) * (mount.rotation @ turned[:, axis])
    centre = mount.origin + mount.rotation @ np.array(own.decentre)
    x, y, z = about
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])  # np.cross takes four times as long
    shift: np.ndarray = cross @ (found.points[place] - centre[:, None])
    return shift


def _mount(
    lens: Lens, tolerances: tuple[Tolerance, ...], number: int, moved: int, error: float, surface: int
) -> tuple[Motion, Placement]:
    """Return the axes in which a piece is mounted, and how it stands in them, where only error ``moved`` is there.

    As a ``surface`` of it, from 0, sees them: of two pieces that begin together the one named later is moved on top of
    the other, and takes along only what belongs to both.
    """
    tolerance, other = tolerances[number], tolerances[moved]
    here, still = lens.frames[tolerance.first - 1], Placement()
    if other.kind not in MOVES or other.first != tolerance.first:
        return here, still
    there = placed({other.kind: error})
    if other.piece == tolerance.piece:
        return here.then(there.motion.inverse), there
    order = [one.piece for one in tolerances if one.kind in MOVES]
    inner = order.index(other.piece) < order.index(tolerance.piece)
    apart = inner or surface >= other.piece[1]
    return (here.then(there.motion.inverse) if apart else here), still


def _behind(lens: Lens, place: int) -> Motion:
    """Return the axes behind a surface, along whose z its thickness runs."""
    motion = lens.frames[place]
    for placement in lens.surfaces[place].after:
        motion = motion.then(placement.motion)
    return motion.then(along_z(0.0))
