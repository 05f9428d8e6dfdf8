"""An exact ray tracer of its own, written from the prescription alone: the referee of aiming, MTF and energy.

It takes numbers from a `Lens` (radii, conics, aspheric terms, thicknesses, indices, stop, aperture) and shares no
formula's code with `p2sf`: vectors of direction instead of optical cosines, an object-space ray that is found by
tracing *backwards* from a point of the stop, and a paraxial entrance pupil from a paraxial ray of its own.
Lengths in mm, the first vertex at the origin, light along +z; behind an odd number of mirrors indices are negative.
"""

from dataclasses import dataclass
from math import inf, isinf

import numpy as np

from p2sf.lens.lens import Lens, Surface
from p2sf.lens.source import Source

NEWTON = 30
CONTINUATION = 12
SOLVED = 1e-14  # of a slope: some roundings


@dataclass(frozen=True)
class Shape:
    """A surface of revolution: curvature, conic constant, and the terms A4, A6 and so on.

    ``grating``: the terms of r², r⁴ and so on, mm⁻¹, mm⁻³, of the path that diffraction adds, the same either way.
    """

    curvature: float
    conic: float
    aspheric: tuple[float, ...]
    grating: tuple[float, ...] = ()

    def mirrored(self) -> "Shape":
        return Shape(-self.curvature, self.conic, tuple(-a for a in self.aspheric), self.grating)

    def power(self, before: float, after: float) -> float:
        return (after - before) * self.curvature - 2 * sum(self.grating[:1])

    def added_path(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        square = x * x + y * y
        return sum((a * square ** (1 + j) for j, a in enumerate(self.grating)), 0.0 * square)

    def added_gradient(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return 2·d(path)/d(r²)."""
        square = x * x + y * y
        return sum((2 * (1 + j) * a * square**j for j, a in enumerate(self.grating)), 0.0 * square)

    def sag(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        square = x * x + y * y
        conic = self.curvature * square / (1 + np.sqrt(1 - (1 + self.conic) * self.curvature**2 * square))
        return conic + sum(a * square ** (2 + j) for j, a in enumerate(self.aspheric))

    def gradient(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return 2·dz/d(r²)."""
        square = x * x + y * y
        conic = self.curvature / np.sqrt(1 - (1 + self.conic) * self.curvature**2 * square)
        return conic + sum(2 * (2 + j) * a * square ** (1 + j) for j, a in enumerate(self.aspheric))


@dataclass(frozen=True)
class System:
    """A lens at one wavelength; ``stop`` counts from 0, ``rim`` is the stop's radius."""

    shapes: tuple[Shape, ...]
    thickness: tuple[float, ...]
    index: tuple[float, ...]
    stop: int
    rim: float
    wavelength: float

    @property
    def last(self) -> float:
        return self.index[-1]


@dataclass(frozen=True)
class Rays:
    """Rays at the sensor: points ``x``, ``y``, cosines ``k`` (3, ray), ``path`` from the source less a constant.

    ``pupil_x``, ``pupil_y``: where they crossed the plane of the paraxial entrance pupil. ``density``: the field they
    carry per area of that plane, 1 on the axis; of a near object 1/distance³, which with the area makes solid angle.
    ``stop_x``, ``stop_y``: where they met the stop.
    """

    x: np.ndarray
    y: np.ndarray
    k: np.ndarray
    path: np.ndarray
    pupil_x: np.ndarray
    pupil_y: np.ndarray
    density: np.ndarray
    stop_x: np.ndarray
    stop_y: np.ndarray


def system_of(lens: Lens, wavelength_um: float) -> System:
    """Return the numbers of a lens that names its stop, at a wavelength; the rim follows from its aperture."""
    assert not any(s.shape or s.irregularity or s.ideal or s.before or s.after for s in lens.surfaces)
    gaps = tuple(s.thickness for s in lens.surfaces)

    def at(wavelength: float, rim: float) -> System:
        index = [float(lens.object_medium.index(wavelength))]
        for s in lens.surfaces:  # a mirror is n' = −n, with every direction written so that it points along +z
            here = -index[-1] if s.reflects else np.sign(index[-1]) * float(s.medium.index(wavelength))
            index.append(here)
        shapes = tuple(
            Shape(0.0 if isinf(s.radius) else 1 / s.radius, s.conic, tuple(s.aspheric), _grating(s, wavelength))
            for s in lens.surfaces
        )
        return System(shapes, gaps, tuple(index), lens.stop_surface - 1, rim, wavelength / 1000)

    return at(wavelength_um, _rim(lens, at(lens.reference_wavelength_um, 1.0)))


def _grating(surface: Surface, wavelength_um: float) -> tuple[float, ...]:
    """Return the terms of the path that a diffractive surface adds: mλ/2π of its radians."""
    if surface.diffraction is None:
        return ()
    one, waves = surface.diffraction, surface.diffraction.order * wavelength_um / 1000 / (2 * np.pi)
    return tuple(waves * a / one.normalisation_mm ** (2 + 2 * j) for j, a in enumerate(one.coefficients))


def _rim(lens: Lens, unit: System) -> float:
    """Return the radius of the stop, from a system whose own is 1 mm at the wavelength where the aperture holds."""
    kind, value = lens.aperture.kind, lens.aperture.value
    if kind == "stop_semi_diameter":
        return value
    diameter = value if kind == "entrance_pupil_diameter" else 1 / (abs(_power(unit)) * value)
    return diameter / 2 / entrance_pupil(unit)[1]


def _power(system: System) -> float:
    """Return −n′u′ of a paraxial ray that enters parallel at height 1."""
    y, u = 1.0, 0.0
    for j, shape in enumerate(system.shapes):
        before, after = system.index[j], system.index[j + 1]
        u = (before * u - y * shape.power(before, after)) / after
        if j < len(system.shapes) - 1:
            y += u * system.thickness[j]
    return -system.last * u


def entrance_pupil(system: System) -> tuple[float, float]:
    """Return place (from the first vertex) and radius of the paraxial image of the stop in object space."""
    y, u = 0.0, 1.0
    before_stop = system.index[system.stop]
    for shape, gap, before, after in _towards_object(system):
        y += u * gap
        u = (before * u - y * shape.power(before, after)) / after
    return y / u, abs(system.rim * before_stop / (system.index[0] * u))


def exit_pupil_mm(system: System) -> float:
    """Return the place of the paraxial image of the stop in image space, behind the last surface."""
    y, u = 0.0, 1.0
    for j in range(system.stop, len(system.shapes)):
        before, after = system.index[j], system.index[j + 1]
        u = (before * u - y * system.shapes[j].power(before, after)) / after
        if j < len(system.shapes) - 1:
            y += u * system.thickness[j]
    return -y / u


def back_to_sphere(along: np.ndarray, square: np.ndarray, radius: float) -> np.ndarray:
    """Return how much farther than the chief ray a ray goes back from the sensor to the reference sphere, mm.

    The sphere has its centre where the chief ray meets the sensor, ``radius`` behind the exit pupil. Of the vector from
    there to the ray's own place ``along`` is the part along the ray and ``square`` the square of the length.
    """
    return along + np.sign(radius) * np.sqrt(along**2 + radius**2 - square) - radius


def _towards_object(system: System):
    """Yield (mirrored surface, gap before it, index before it, index behind it) from the stop to the object."""
    for j in range(system.stop - 1, -1, -1):
        yield system.shapes[j].mirrored(), system.thickness[j], system.index[j + 1], system.index[j]


def meet(shape: Shape, point: np.ndarray, ray: np.ndarray) -> np.ndarray:
    """Return the distance along rays to a surface with its vertex at the origin; NaN where there is no crossing."""
    to_plane = -point[2] / ray[2]
    x, y = (point[a] + to_plane * ray[a] for a in (0, 1))
    c, k = shape.curvature, 1 + shape.conic
    a = c * (ray[0] ** 2 + ray[1] ** 2 + k * ray[2] ** 2)
    b = ray[2] - c * (x * ray[0] + y * ray[1])
    step = to_plane + c * (x * x + y * y) / (b + np.sqrt(b * b - a * c * (x * x + y * y)))
    if any(shape.aspheric):  # a ray may miss the conic and meet the surface
        step = np.where(np.isfinite(step), step, to_plane)
    for _ in range(NEWTON if any(shape.aspheric) else 0):
        x, y, z = (point[a] + step * ray[a] for a in (0, 1, 2))
        steep = shape.gradient(x, y)
        step = step - (z - shape.sag(x, y)) / (ray[2] - steep * (x * ray[0] + y * ray[1]))
    return step


def bend(
    shape: Shape, point: np.ndarray, ray: np.ndarray, before: float, after: float, pull: np.ndarray | None = None
) -> np.ndarray:
    """Return unit directions behind a surface, n'K' = nK + ∇(path added) + Γ·normal; NaN for total reflection.

    ``pull`` (2, ray) is added to the gradient of the path.
    """
    steep = shape.gradient(point[0], point[1])
    normal = np.stack([-steep * point[0], -steep * point[1], np.ones_like(steep * point[0])])
    normal /= np.sqrt((normal**2).sum(0))
    onward = before / after * ray
    if shape.grating:
        onward[:2] += shape.added_gradient(point[0], point[1]) * point[:2] / after
    if pull is not None:
        onward[:2] += pull / after
    along = (onward * normal).sum(0)
    return onward + (np.sqrt(1 - (onward**2).sum(0) + along**2) - along) * normal


def _backwards(system: System, start: np.ndarray, slope: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return point (from the first vertex) and direction of light, in object space, of rays seen from the stop.

    ``start``: (2, ray) heights on the stop surface; ``slope``: (2, ray), dx/dz and dy/dz against the light.
    """
    z = -system.shapes[system.stop].sag(*start)
    point = np.stack([*start, z + 0 * start[0]])
    ray = np.stack([*slope, np.ones_like(slope[0])])
    ray = ray / np.sqrt((ray**2).sum(0))
    for shape, gap, before, after in _towards_object(system):
        point = point - np.array([[0.0], [0.0], [gap]])
        point = point + meet(shape, point, ray) * ray
        ray = bend(shape, point, ray, before, after)
    return point * np.array([[1], [1], [-1]]), ray * np.array([[-1], [-1], [1]])


def object_point(system: System, source: Source) -> np.ndarray | None:
    """Return the source's place (3, 1), or None at infinity."""
    if isinf(source.depth_mm):
        return None
    height = -source.field_slope * (source.depth_mm + entrance_pupil(system)[0])
    return np.array([[0.0], [height], [-source.depth_mm]])


def _miss(system: System, start: np.ndarray, slope: np.ndarray, where: np.ndarray | None, field: float) -> np.ndarray:
    """Return by how much (2, ray) the slope of the emerging ray differs from that of light from the source."""
    point, ray = _backwards(system, start, slope)
    found = ray[:2] / ray[2]
    if where is None:
        return found - np.array([[0.0], [field]])
    return found - (point - where)[:2] / (point - where)[2]


def through_stop(system: System, source: Source, xi: np.ndarray, eta: np.ndarray) -> Rays:
    """Return the rays that meet the stop at (ξ, η) of its rim, found backwards from there; NaN where there is none."""
    start = system.rim * np.stack([xi, eta])
    with np.errstate(invalid="ignore", divide="ignore"):
        slope = _solved_slopes(system, source, start)
        point, ray = _backwards(system, start, slope)
        return forwards(system, source, point, ray)


def _solved_slopes(system: System, source: Source, start: np.ndarray) -> np.ndarray:
    where, field = object_point(system, source), float(source.field_slope)
    slope, lost = _newton(system, start, _paraxial_slopes(system, start, where, field), where, field)
    if lost.any():  # grow field and pupil together from the axis
        part = start[:, lost]
        guess = 0 * part
        for scale in np.arange(1, CONTINUATION + 1) / CONTINUATION:
            place = None if where is None else where * np.array([[1], [scale], [1]])
            guess = guess * scale / max(scale - 1 / CONTINUATION, 1 / CONTINUATION)
            guess, _ = _newton(system, part * scale, guess, place, field * scale)
        slope[:, lost] = guess
    return slope


def _paraxial_slopes(system: System, start: np.ndarray, where: np.ndarray | None, field: float) -> np.ndarray:
    """Return the slopes that rays close to the axis would need, by differences of rays close to the axis."""
    tiny = 1e-4
    axis = None if where is None else where * np.array([[1], [0], [1]])
    zero = np.zeros((2, 1))
    up = np.array([[0.0], [tiny]])
    by_height = _miss(system, up * system.rim, zero, axis, 0.0)[1, 0] / (tiny * system.rim)
    by_slope = _miss(system, zero, up, axis, 0.0)[1, 0] / tiny
    offset = 0.0 if where is None else float(-_miss(system, zero, zero, where, 0.0)[1, 0])
    wanted = np.array([[0.0], [field if where is None else offset]])
    return (wanted - by_height * start) / by_slope


def _newton(
    system: System, start: np.ndarray, slope: np.ndarray, where: np.ndarray | None, field: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return slopes at the stop that lead to the source, and which were not found."""
    step, best = 1e-6, np.full(start.shape[1], inf)
    found = slope.copy()
    for _ in range(NEWTON):
        here, right, up = (
            _miss(system, start, slope + np.array(d)[:, None], where, field) for d in ((0, 0), (step, 0), (0, step))
        )
        size = np.hypot(*here)
        better = size < best
        found[:, better], best[better] = slope[:, better], size[better]
        if not (best > SOLVED).any() or not (better & (best > SOLVED)).any():
            break
        (a, c), (b, d) = (right - here) / step, (up - here) / step
        slope = slope - np.stack([d * here[0] - b * here[1], a * here[1] - c * here[0]]) / (a * d - b * c)
    return found, ~(best <= 1e-11)


def through_paraxial_pupil(system: System, source: Source, xi: np.ndarray, eta: np.ndarray) -> Rays:
    """Return the rays that cross the plane of the paraxial entrance pupil at (ξ, η) of its radius."""
    plane, radius = entrance_pupil(system)
    point = np.stack([radius * xi, radius * eta, plane + 0 * xi])
    where = object_point(system, source)
    ray = point - where if where is not None else np.array([[0.0], [source.field_slope], [1.0]]) + 0 * point
    ray = ray / np.sqrt((ray**2).sum(0)) * np.sign(ray[2])
    with np.errstate(invalid="ignore", divide="ignore"):
        rays = forwards(system, source, point, ray)
    return Rays(**(vars(rays) | {"density": np.ones_like(xi)}))


def forwards(system: System, source: Source, point: np.ndarray, ray: np.ndarray) -> Rays:
    """Return object-space rays (a point of each and its direction) at the sensor."""
    plane, _ = entrance_pupil(system)
    pupil = point[:2] + (plane - point[2]) * ray[:2] / ray[2]
    where = object_point(system, source)
    path, density = _path_and_density(system.index[0], where, point, ray, np.stack([*pupil, plane + 0 * pupil[0]]))
    stop = None
    for j, shape in enumerate(system.shapes):
        step = meet(shape, point, ray)
        point = point + step * ray
        path = path + system.index[j] * step + shape.added_path(point[0], point[1])
        stop = point[:2] if j == system.stop else stop
        ray = bend(shape, point, ray, system.index[j], system.index[j + 1])
        point = point - np.array([[0.0], [0.0], [system.thickness[j]]])
    step = -point[2] / ray[2]
    point, path = point + step * ray, path + system.last * step
    return Rays(point[0], point[1], ray, path, *pupil, density, *stop)


def _path_and_density(
    index: float, where: np.ndarray | None, point: np.ndarray, ray: np.ndarray, pupil: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the path from the source to the point less that to the first vertex, and the field per pupil area."""
    if where is None:
        return index * (point * ray).sum(0), np.ones_like(point[0])
    # |p − o| − |o| without the subtraction of two long paths; negative where the point lies before the object
    away = np.sqrt(((point - where) ** 2).sum(0)) * np.sign((point - where)[2])
    whole = np.sqrt((where**2).sum(0)) * np.sign(-where[2])
    path = index * ((point**2).sum(0) - 2 * (point * where).sum(0)) / (away + whole)
    middle = np.array([[0.0], [0.0], [pupil[2, 0]]])
    near, mean = (np.sqrt(((p - where) ** 2).sum(0)) for p in (pupil, middle))
    return path, (mean / near) ** 3
