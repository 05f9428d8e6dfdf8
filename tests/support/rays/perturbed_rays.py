"""The wavefront of a lens with one manufacturing error, by exact rays through its real stop: the referee of tolerances.

The iris is a piece of metal: its rim has the radius that it has in the lens as designed, and moves with the surface it
stands on. The source stays where it is. Wavefronts are those over the sphere about where the chief ray lands, through
the exit pupil's plane, which is at right angles to the chief ray of the axis, and every part of the stop counts alike.
What is set at assembly is the back focus alone: rays go on to the sensor where it then stands. Shares with `p2sf` the
numbers of a prescription only.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from scipy.spatial.transform import Rotation

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.tolerance.errors_of_build import Tolerance, clear_radius
from tests.support.pupil_sums import LostRays
from tests.support.rays.ray_figures import directions, disc_rule
from tests.support.rays.skew_rays import (
    System,
    back_to_sphere,
    bend,
    entrance_pupil,
    exit_pupil_mm,
    meet,
    object_point,
    system_of,
)

SIZES = (10, 24), (20, 48), (36, 88), (56, 136)  # radii and directions, until two agree
AGREE = 3e-6  # of the RMS
NEWTON, NEARLY, AIMED = 16, 1e-4, 1e-11  # of the stop's radius
OUTWARDS = 0.0, 0.3, 0.5, 0.7, 0.85, 0.95, 1.0  # of it, from the chief ray: near the rim the map may fold
ROUNDS, STEP_MM = 4, 1e-3  # of Gauss and Newton's method for the back focus
HALVINGS = 12  # of a step that ends where no ray meets the stop
STEP = 1e-5
NEIGHBOUR = 1e-4  # slope of the fields beside the axis
HALF_FRINGE_MM = 0.54607e-3 / 4  # a fringe is half a wave of the green line of mercury, from peak to valley


@dataclass(frozen=True)
class Perturbed:
    """A system with its source, and surfaces that stand elsewhere: number → rotation and origin of its vertex, mm.

    ``uneven``: number → height (mm) and clear radius of an irregularity, height·ρ² cos 2θ.
    """

    system: System
    where: np.ndarray | None
    slope: float
    plane: float
    radius: float
    moved: dict[int, tuple[Rotation, np.ndarray]]
    uneven: dict[int, tuple[float, float]]

    def launched(self, entered: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return point, direction and path so far of rays through points (2, ray) of the entrance pupil, in radii."""
        point = np.stack([*(self.radius * entered), np.full(entered.shape[1], self.plane)])
        if self.where is None:
            way = np.array([[0.0], [self.slope], [1.0]]) + 0 * point
        else:
            way = (point - self.where) * np.sign(self.plane - self.where[2])
        way = way / np.sqrt((way**2).sum(0))
        if self.where is None:
            path = (point * way).sum(0)
        else:
            away, whole = np.sqrt(((point - self.where) ** 2).sum(0)), np.sqrt((self.where**2).sum(0))
            path = ((point**2).sum(0) - 2 * (point * self.where).sum(0)) / (away + whole)
            path = path * np.sign(self.plane - self.where[2])
        return point, way, self.system.index[0] * path

    def traced(self, entered: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return landing points (2, ray), directions (3, ray), paths, and the places in the stop, in its radii."""
        system, stop = self.system, np.zeros_like(entered)
        point, way, path = self.launched(entered)
        for j, shape in enumerate(system.shapes):
            turn, origin = self.moved.get(j, (None, np.zeros(3)))
            if turn is not None:
                point, way = turn.inv().apply(point.T - origin).T, turn.inv().apply(way.T).T
            step = meet(shape, point, way)
            point = point + step * way
            path = path + system.index[j] * step + shape.added_path(point[0], point[1])
            if j == system.stop:
                stop = point[:2] / system.rim
            onward = bend(shape, point, way, system.index[j], system.index[j + 1])
            if j in self.uneven:
                height, slope = self._bump(j, point)
                change = system.index[j] * way[2] - system.index[j + 1] * onward[2]
                path = path + height * change
                onward = bend(shape, point, way, system.index[j], system.index[j + 1], slope * change)
            way = onward
            if turn is not None:
                point, way = turn.apply(point.T).T + origin[:, None], turn.apply(way.T).T
            point = point - np.array([[0.0], [0.0], [system.thickness[j]]])
        step = -point[2] / way[2]
        point, path = point + step * way, path + system.last * step
        return point[:2], way, path, stop

    def _bump(self, j: int, point: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return how much higher an irregular surface is, and the gradient (2, ray) of that.

        The path changes by height·(nK − n'K')z, to first order in fractions of a wave.
        """
        height, clear = self.uneven[j]
        x, y = point[0] / clear, point[1] / clear
        return height * (y * y - x * x), 2 * height / clear * np.stack([-x, y])

    def aimed(self, xi: np.ndarray, eta: np.ndarray) -> np.ndarray:
        """Return where rays enter that meet the stop at (ξ, η); LostRays where they cannot be found."""
        wanted = np.stack([xi, eta])
        try:
            return self._newton(wanted, self._arriving(wanted, 0 * wanted), AIMED)
        except LostRays:  # near the rim, where the map may fold, other points are nearer
            entered = 0 * wanted
        for part in OUTWARDS:
            entered = self._newton(part * wanted, entered, AIMED if part == 1 else NEARLY)
        return entered

    def _newton(self, wanted: np.ndarray, entered: np.ndarray, enough: float) -> np.ndarray:
        """Return where rays enter, found from points nearby; LostRays where they cross before the stop as well."""
        for _ in range(NEWTON):
            miss = self.traced(entered)[3] - wanted
            (a, c), (b, d) = (
                (self.traced(entered + STEP * np.array(e)[:, None])[3] - wanted - miss) / STEP for e in ((1, 0), (0, 1))
            )
            if np.abs(miss).max() < enough:
                break
            step = np.stack([d * miss[0] - b * miss[1], a * miss[1] - c * miss[0]]) / (a * d - b * c)
            entered = self._arriving(entered - step, entered)
        if not np.abs(miss).max() < max(enough, 1e-7):
            raise LostRays("no rays fill the stop")
        area = a * d - b * c
        if not (area * area[-1] > 0).all():
            raise LostRays("rays cross before the stop")
        return entered

    def _arriving(self, entered: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Return points whose rays arrive at the stop, on the way to ``other`` ones from where they do not."""
        for _ in range(HALVINGS):
            lost = np.isnan(self.traced(entered)[3]).any(0)
            if not lost.any():
                break
            entered = np.where(lost, (entered + other) / 2, entered)
        return entered


def perturbed(lens: Lens, source: Source, one: Tolerance | None, error: float) -> Perturbed:
    """Return a lens with one error, and its source where it stands for the lens as designed."""
    system = system_of(lens, source.wavelength_um)
    plane, radius = entrance_pupil(system)
    still = Perturbed(system, object_point(system, source), float(source.field_slope), plane, radius, {}, {})
    if one is None:
        return still
    j = one.first - 1
    if one.kind == "thickness":
        gaps = list(system.thickness)
        gaps[j] += error
        return replace(still, system=replace(system, thickness=tuple(gaps)))
    if one.kind == "index":
        index = list(system.index)
        index[j + 1] += np.sign(index[j + 1]) * error
        return replace(still, system=replace(system, index=tuple(index)))
    if one.kind == "radius":
        shapes = list(system.shapes)
        shapes[j] = replace(shapes[j], curvature=shapes[j].curvature / (1 + error / 100))
        return replace(still, system=replace(system, shapes=tuple(shapes)))
    if one.kind == "irregularity":
        clear = clear_radius(lens, one.first)
        return replace(still, uneven={j: (HALF_FRINGE_MM * error, clear)})
    assert one.piece[0] == one.piece[1], "pieces of one surface"
    along = {"x": np.array([1.0, 0.0, 0.0]), "y": np.array([0.0, 1.0, 0.0])}[one.kind[-1]]
    if one.kind.startswith("decentre"):
        return replace(still, moved={j: (Rotation.identity(), error * along)})
    return replace(still, moved={j: (Rotation.from_rotvec(np.deg2rad(error) * along), np.zeros(3))})


@dataclass(frozen=True)
class Landed:
    """Rays at the sensor, the chief ray last: places (2, ray), directions (3, ray), paths; ``flat`` times √share.

    ``flat``: (ray, 3), piston and tilt over the stop. ``pupil``: the ray along the axis, where it meets the sensor, its
    direction, and how far before the sensor the exit pupil is.
    """

    place: np.ndarray
    way: np.ndarray
    path: np.ndarray
    index: float
    wavelength: float
    pupil: tuple[np.ndarray, np.ndarray, float]
    root: np.ndarray
    flat: np.ndarray

    def wavefront(self, shift: float) -> np.ndarray:
        """Return waves without piston and tilt times √share, the sensor ``shift`` mm farther away."""
        onward = shift / self.way[2]
        place, path = self.place + onward * self.way[:2], self.path + self.index * onward
        away = place - place[:, -1:]
        along, square = (self.way[:2] * away).sum(0), (away**2).sum(0)
        (point, axis, distance), chief = self.pupil, self.way[:, -1]
        beyond = axis[:2] @ (self.place[:, -1] - point) + shift * (axis @ chief) / chief[2]
        radius = (distance + beyond) / (axis @ chief)
        back = back_to_sphere(along, square, radius)
        waves = ((path - path[-1] - self.index * back) / self.wavelength)[:-1] * self.root
        found: np.ndarray = waves - self.flat @ np.linalg.lstsq(self.flat, waves, rcond=None)[0]
        return found


@lru_cache(maxsize=32)
def landed(lens: Lens, source: Source, one: Tolerance | None, error: float, size: tuple[int, int]) -> Landed:
    """Return rays of a lens with one error through nodes of its stop."""
    built = perturbed(lens, source, one, error)
    square, share = disc_rule(*size, lens.mask.obscuration)
    rho, theta = np.sqrt(square)[:, None], directions(size[1])
    xi, eta = (rho * np.sin(theta)).ravel(), (rho * np.cos(theta)).ravel()
    place, way, path, _ = built.traced(built.aimed(np.append(xi, 0.0), np.append(eta, 0.0)))
    if not (np.isfinite(path).all() and np.isfinite(way).all()):
        raise LostRays("rays of the lens with this error are lost")
    root = np.sqrt((share / share.sum()).ravel())
    flat = np.stack([np.ones(root.size), xi, eta], 1) * root[:, None]
    system = built.system
    return Landed(place, way, path, system.last, system.wavelength, exit_pupil(built), root, flat)


def exit_pupil(built: Perturbed) -> tuple[np.ndarray, np.ndarray, float]:
    """Return the ray along the axis, place and direction, and how far behind the exit pupil it meets the sensor.

    Of moved surfaces the pupil is where chief rays of fields beside the axis come closest to that ray; by first order
    of others.
    """
    system = built.system
    if not built.moved:
        return np.zeros(2), np.array([0.0, 0.0, 1.0]), system.thickness[-1] - exit_pupil_mm(system)
    middle = np.zeros(1)
    rays = []
    for slope in (0.0, NEIGHBOUR, -NEIGHBOUR):
        beside = replace(built, where=None, slope=slope)
        place, way, *_ = beside.traced(beside.aimed(middle, middle))
        rays.append((np.append(place[:, 0], 0.0), way[:, 0]))
    (point, axis), *others = rays
    apart, away = (np.concatenate(part) for part in zip(*(_beside(point, axis, *ray) for ray in others), strict=True))
    return point[:2], axis, float(apart @ away / (away @ away))


def _beside(point: np.ndarray, axis: np.ndarray, place: np.ndarray, way: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return how far from an axis a ray is beside its point, and how much farther each mm onwards along it."""
    onward = way / (axis @ way) - axis
    offset = place - point
    return offset - (axis @ offset) * (axis + onward), onward


def worst_rms(lens: Lens, sources: tuple[Source, ...], one: Tolerance | None, error: float) -> float:
    """Return the RMS of the worst field, waves, with the back focus set so that the mean square of all is least."""
    last = np.inf
    for size in SIZES:
        fields = [landed(lens, source, one, error, size) for source in sources]
        shift = 0.0
        for _ in range(ROUNDS):
            waves, more, less = (
                np.concatenate([field.wavefront(shift + step) for field in fields]) for step in (0.0, STEP_MM, -STEP_MM)
            )
            slope = (more - less) / (2 * STEP_MM)
            shift -= (slope @ waves) / (slope @ slope)
        rms = max(float(np.linalg.norm(field.wavefront(shift))) for field in fields)
        if abs(rms - last) <= AGREE * rms:
            break
        last = rms
    return rms


def harm(lens: Lens, sources: tuple[Source, ...], one: Tolerance) -> float:
    """Return by how much an error at its limit raises the RMS of the worst field, of both signs the larger, waves."""
    still = worst_rms(lens, sources, None, 0.0)
    return max(worst_rms(lens, sources, one, sign * one.amount) for sign in (1, -1)) - still
