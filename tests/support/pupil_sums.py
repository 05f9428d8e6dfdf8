"""OTF and encircled energy of a lens by dense sums over rays: the referee of `p2sf`'s measures.

Two roads that share only the rays of `tests.support.rays.skew_rays`.

`sums`: the pupil P = A·exp(i2πw) is laid on a uniform square grid over spatial frequency f = n′K/λ, cells at its rim by
the part of them that lies inside; OTF = autocorrelation of P by a padded FFT, energy from the whole OTF. The functions
over f are Chebyshev polynomials through the referee's own rays, and other rays say how good they are. What is left is
the grid: the result is that of N cells across, its error |N − N/2|.

`ray_sum`: no polynomial and no frequency grid, the field at given places as the plain sum over rays from a dense square
grid in the pupil, each with the area it enters by.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.fft
from numpy.polynomial import chebyshev
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq
from scipy.special import j1

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from tests.support.rays.skew_rays import Rays, System, system_of, through_paraxial_pupil, through_stop

RADII, ANGLES = 44, 96
DEGREES = (12, 18, 24, 32, 40)
FITTED = 2e-5  # waves: the largest phase error at rays that took no part in the fit
RIM = 720
MARGIN = 1.001
BINS = 8  # of |f| per cell, for the mean over directions
FEWEST, MOST = 512, 4096  # cells across the pupil
STEPS = 4  # of them per wave of phase at the steepest place, as long as there may be more


class LostRays(Exception):
    """Some ray of the pupil does not reach the sensor, so there is no smooth pupil to sum over."""


@dataclass(frozen=True)
class Sums:
    """What the referee found.

    ``frequency``: cycles/mm; ``x``, ``y``: complex OTF along the axes; ``energy``: of a radius in µm.
    ``error``: the largest change of the OTF from half as many cells. ``slope``: waves per pupil radius, steepest.
    ``fitted``: waves, the largest error of the phase at rays that took no part in the fit. ``centroid_um``: of the
    light, along y from the chief ray.
    """

    frequency: np.ndarray
    x: np.ndarray
    y: np.ndarray
    energy: Callable[[float], float]
    cells: int
    error: float
    slope: float
    fitted: float
    centroid_um: float

    def radius(self, share: float) -> float:
        """Return the radius in µm that holds this share of all light."""
        high = 1e-3
        while self.energy(high) < share:
            high *= 1.5
            if high > 1e6:
                raise LostRays("the grid is too coarse for this blur")
        return float(brentq(lambda r: self.energy(r) - share, high / 1.5, high, xtol=1e-7 * high))


@dataclass(frozen=True)
class Pupil:
    """Polynomials over the box ``centre`` ± ``half`` (cycles/mm) of f: phase in waves, entrance-pupil point, density.

    ``rim``: distance of the rim from the centre over the angle from +fx, in units of ``half``; ``hole``: of the edge of
    the obscuration in the stop, if there is one.
    """

    half: float
    phase: np.ndarray
    x: np.ndarray
    y: np.ndarray
    density: np.ndarray
    rim: CubicSpline
    slope: float
    error: float
    hole: CubicSpline | None = None


def sums(lens: Lens, source: Source, aim: str = "stop", perfect: bool = False, cells: int | None = None) -> Sums:
    """Return OTF and energy about the centroid of one source at one wavelength; LostRays where rays are lost."""
    return sums_of(pupil_of(lens, source, aim), perfect, cells)


def sums_of(pupil: Pupil, perfect: bool = False, cells: int | None = None) -> Sums:
    """Return OTF and energy about the centroid of a pupil."""
    cells = cells or cells_for(pupil.slope)
    coarse, fine = (on_grid(pupil, n, perfect) for n in (cells // 2, cells))
    count = len(coarse.x)
    error = max(np.abs(fine.x[: 2 * count : 2] - coarse.x).max(), np.abs(fine.y[: 2 * count : 2] - coarse.y).max())
    return Sums(
        fine.frequency, fine.x, fine.y, fine.energy, cells, float(error), pupil.slope, pupil.error, fine.centroid_um
    )


def cells_for(slope: float) -> int:
    """Return the number of cells across the pupil for a slope in waves per radius."""
    return int(2 ** np.ceil(np.log2(np.clip(3 * STEPS * slope, FEWEST, MOST))))


def pupil_of(lens: Lens, source: Source, aim: str) -> Pupil:
    """Return the pupil over spatial frequency, from the referee's own rays."""
    system = system_of(lens, source.wavelength_um)
    fill = {"stop": through_stop, "paraxial": through_paraxial_pupil}[aim]
    xi, eta = _rays(RADII, ANGLES)
    turn = np.linspace(0, 2 * np.pi, RIM, endpoint=False)
    chief, rays, edge = (
        fill(system, source, *points)
        for points in ((np.zeros(1), np.zeros(1)), (xi, eta), (np.sin(turn), np.cos(turn)))
    )
    phase, f = phase_and_frequency(system, rays, chief)
    rim = phase_and_frequency(system, edge, chief)[1]
    if not (np.isfinite(phase).all() and np.isfinite(rim).all()):
        raise LostRays(f"{np.isnan(phase).sum()} of {phase.size} rays are lost")
    slope = float(np.hypot(rays.x - chief.x, rays.y - chief.y).max())
    dark = lens.mask.obscuration
    hole = phase_and_frequency(system, fill(system, source, dark * np.sin(turn), dark * np.cos(turn)), chief)[1]
    return pupil_through(f, phase, (rays.pupil_x, rays.pupil_y, rays.density), rim, slope, hole if dark else None)


def pupil_through(
    f: np.ndarray,
    phase: np.ndarray,
    entering: tuple[np.ndarray, np.ndarray, np.ndarray],
    rim: np.ndarray,
    spot: float,
    hole: np.ndarray | None = None,
) -> Pupil:
    """Return the pupil through points of it: their f (2, ray), phase, (x, y, density) and, as f, its rim and its hole.

    ``spot``: how far from the chief ray the farthest ray lands, mm.
    """
    centre = (rim[1].max() + rim[1].min()) / 2
    half = MARGIN * max(rim[0].max(), rim[1].max() - centre)
    u, v = f[0] / half, (f[1] - centre) / half
    fits, error = _fits(u, v, ((phase, 0), (entering[0], 1), (entering[1], 0), (entering[2], 0)))
    outer, *inner = (_rim_curve(e[0] / half, (e[1] - centre) / half) for e in (rim, hole) if e is not None)
    return Pupil(half, *fits, outer, spot * half, error, *inner)


def _rays(radii: int, angles: int) -> tuple[np.ndarray, np.ndarray]:
    """Return points of half the unit disc, denser towards its rim."""
    rho = np.sqrt((1 - np.cos(np.pi * (np.arange(radii) + 0.5) / radii)) / 2)[:, None]
    angle = np.pi * (np.arange(angles) + 0.5) / angles
    return (rho * np.sin(angle)).ravel(), (rho * np.cos(angle)).ravel()


def best_shift_mm(lens: Lens, source: Source, aim: str) -> float:
    """Return how far behind its sensor the phase of a lens has its smallest RMS, tilt and piston set aside."""
    system = system_of(lens, source.wavelength_um)
    fill = {"stop": through_stop, "paraxial": through_paraxial_pupil}[aim]
    xi, eta = _rays(12, 24)
    chief, rays = (fill(system, source, *points) for points in ((np.zeros(1), np.zeros(1)), (xi, eta)))
    phase, f = phase_and_frequency(system, rays, chief)
    seen = np.isfinite(phase)
    terms = np.stack([np.ones_like(xi), f[1], system.last * rays.k[2] / system.wavelength])
    return -float(np.linalg.lstsq(terms[:, seen].T, phase[seen], rcond=None)[0][2])


def phase_and_frequency(system: System, rays: Rays, chief: Rays) -> tuple[np.ndarray, np.ndarray]:
    """Return the phase in waves (ray,) and f = n'K/λ in cycles/mm (2, ray) of plane waves at the sensor.

    The field at the distance X from the chief ray is Σ exp(i2π(phase + f·X)).
    """
    away = np.stack([rays.x - chief.x, rays.y - chief.y])
    path = rays.path - chief.path - system.last * (rays.k[:2] * away).sum(0)
    return path / system.wavelength, system.last * rays.k[:2] / system.wavelength


def _fits(u: np.ndarray, v: np.ndarray, values: tuple) -> tuple[list[np.ndarray], float]:
    """Return Chebyshev coefficients (u, v) of values that are even or odd in u, and the largest error of the first.

    The degree grows until rays that take no part in the fit agree.
    """
    judge = np.arange(u.size) % 5 == 3
    for degree in DEGREES:
        fits = [_fit(u, v, value, degree, odd, ~judge) for value, odd in values]
        error = float(np.abs(chebyshev.chebval2d(u, v, fits[0]) - values[0][0])[judge].max())
        if error < FITTED:
            break
    return fits, error


def _fit(u: np.ndarray, v: np.ndarray, value: np.ndarray, degree: int, odd: int, used: np.ndarray) -> np.ndarray:
    a, b = np.array([(a, b) for a in range(odd, degree + 1, 2) for b in range(degree + 1 - a)]).T
    basis = chebyshev.chebvander(u, degree)[:, a] * chebyshev.chebvander(v, degree)[:, b]
    coefficients = np.zeros((degree + 1, degree + 1))
    coefficients[a, b] = np.linalg.lstsq(basis[used], value[used], rcond=None)[0]
    return coefficients


def _rim_curve(u: np.ndarray, v: np.ndarray) -> CubicSpline:
    angle, radius = np.arctan2(v, u), np.hypot(u, v)
    order = np.argsort(angle)
    angle, radius = angle[order], radius[order]
    return CubicSpline(np.append(angle, angle[0] + 2 * np.pi), np.append(radius, radius[0]), bc_type="periodic")


@dataclass(frozen=True)
class OnGrid:
    frequency: np.ndarray
    x: np.ndarray
    y: np.ndarray
    energy: Callable[[float], float]
    centroid_um: float


def on_grid(pupil: Pupil, cells: int, perfect: bool) -> OnGrid:
    """Return OTF slices at every cell's width and energy on a grid of so many cells across the box."""
    axis = (np.arange(cells) + 0.5) * (2 / cells) - 1
    step = 2 * pupil.half / cells
    amplitude, phase, (slope_x, slope_y) = _fields(pupil, axis)
    covered = _open_cells(pupil, axis)
    light = float((covered * amplitude**2).sum())
    centroid = (
        np.zeros(2) if perfect else -np.array([(covered * amplitude**2 * s).sum() for s in (slope_x, slope_y)]) / light
    )
    waves = 0.0 if perfect else phase
    field = np.where(covered > 0, covered * amplitude, 0) * np.exp(2j * np.pi * waves)
    dtype = np.complex64 if cells > 2048 else np.complex128
    plane = scipy.fft.fft2(field.astype(dtype), (2 * cells, 2 * cells), overwrite_x=True)
    otf = scipy.fft.ifft2(np.square(plane.real) + np.square(plane.imag), overwrite_x=True)
    otf *= 1 / light
    otf[0, 0] = 1.0  # of itself a cell at the rim keeps its part, not its part squared
    return OnGrid(
        np.arange(cells) * step,
        otf[0, :cells].copy(),
        otf[:cells, 0].copy(),
        _energy(otf, step, centroid),
        1000 * float(centroid[1]),
    )


def _fields(pupil: Pupil, axis: np.ndarray) -> tuple[np.ndarray, np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """Return amplitude |∂(entrance pupil)/∂f|·density, phase and its gradient (mm) on a grid (v, u); 0 far outside."""
    near = np.hypot(axis, axis[:, None]) < 1.5 * float(pupil.rim(np.linspace(-np.pi, np.pi, 400)).max())

    def on(c: np.ndarray, along: int | None = None) -> np.ndarray:
        c = c if along is None else chebyshev.chebder(c, axis=along) / pupil.half
        u, v = (chebyshev.chebvander(axis, n - 1) for n in c.shape)
        return np.where(near, v @ c.T @ u.T, 0.0)

    jacobian = on(pupil.x, 0) * on(pupil.y, 1) - on(pupil.x, 1) * on(pupil.y, 0)
    amplitude = np.abs(jacobian) * on(pupil.density)
    amplitude /= amplitude[len(axis) // 2, len(axis) // 2]
    return amplitude, on(pupil.phase), (on(pupil.phase, 0), on(pupil.phase, 1))


def _open_cells(pupil: Pupil, axis: np.ndarray) -> np.ndarray:
    """Return the part of every cell (v, u) inside the rim and outside the hole."""
    inside = _coverage(pupil.rim, axis)
    return inside if pupil.hole is None else inside - _coverage(pupil.hole, axis)


def _coverage(rim: CubicSpline, axis: np.ndarray) -> np.ndarray:
    """Return the part of every cell (v, u) inside the rim."""
    angle = np.arctan2(axis[:, None], axis + 0 * axis[:, None])
    edge = rim(angle)
    lean = np.arctan2(rim(angle, 1), edge)  # of the rim's normal from the radius
    inside = (edge - np.hypot(axis, axis[:, None])) * np.cos(lean) / (axis[1] - axis[0])
    return part_inside(inside, angle - lean)


def part_inside(inside: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Return the part of unit cells inside a straight edge that lies ``inside`` cells beyond their centres."""
    c, s = np.abs(np.cos(normal)), np.abs(np.sin(normal))
    long, short = np.maximum(c, s), np.minimum(c, s)
    flat, reach = (long - short) / 2, (long + short) / 2
    middle = 0.5 + inside / long
    corner = np.maximum(reach - np.abs(inside), 0) ** 2 / (2 * long * np.maximum(short, 1e-300))
    return np.where(np.abs(inside) <= flat, middle, np.where(inside > 0, 1 - corner, corner))


def _energy(otf: np.ndarray, step: float, centroid: np.ndarray) -> Callable[[float], float]:
    """Return E(R) = Σ OTF(f)·R·J1(2πRf)/f·df² about the centroid (mm), of R in µm; f is gathered in narrow rings."""
    count = len(otf)
    f = scipy.fft.fftfreq(count, 1 / count) * step
    shift = np.exp(2j * np.pi * f * centroid[0]), np.exp(2j * np.pi * f * centroid[1])
    turned = ((otf * shift[0]) * shift[1][:, None]).real.ravel()
    distance = np.hypot(f, f[:, None]).ravel()
    ring = (distance * (BINS / step)).astype(int)
    seen = np.bincount(ring)
    place = np.bincount(ring, distance) / np.maximum(seen, 1)
    total = np.bincount(ring, turned)
    place, total = place[1:][seen[1:] > 0], total[1:][seen[1:] > 0]

    def energy(radius_um: float) -> float:
        r = radius_um / 1000
        return float((np.pi * r**2 + (total * r * j1(2 * np.pi * r * place) / place).sum()) * step**2)

    return energy


@dataclass(frozen=True)
class RaySum:
    """The field (y, x) at places in µm from the chief ray.

    ``light``: the sum of all weights, mm² of the entrance pupil. ``stop_miss``: the largest distance between a ray and
    its place in the stop, of the rim.
    """

    field: np.ndarray
    light: float
    stop_miss: float


def ray_sum(lens: Lens, source: Source, aim: str, x_um: np.ndarray, y_um: np.ndarray, cells: int = 1000) -> RaySum:
    """Return Σ area·density·exp(i2π(w + f·X)) over rays through a square grid of ``cells`` across the pupil."""
    system = system_of(lens, source.wavelength_um)
    fill = {"stop": through_stop, "paraxial": through_paraxial_pupil}[aim]
    width = 2 / cells
    half, whole = (np.arange(cells // 2 + 3) - 1.5) * width, (np.arange(-cells // 2 - 2, cells // 2 + 2) + 0.5) * width
    xi, eta = np.meshgrid(half, whole)
    rho = np.hypot(xi, eta)
    near = rho < 1 + 3 * width
    rays = fill(system, source, xi[near], eta[near])
    chief = fill(system, source, np.zeros(1), np.zeros(1))
    across, along = np.full(xi.shape, np.nan), np.full(xi.shape, np.nan)
    across[near], along[near] = rays.pupil_x, rays.pupil_y
    (across_eta, across_xi), (along_eta, along_xi) = np.gradient(across), np.gradient(along)
    area = np.abs(across_xi * along_eta - across_eta * along_xi)
    covered = part_inside((1 - rho) / width, np.arctan2(eta, xi)) * (xi > 0)
    weight = (area * covered)[near] * rays.density
    used = covered[near] > 0
    weight, (phase, f) = weight[used], (a[..., used] for a in phase_and_frequency(system, rays, chief))
    f = (f - phase_and_frequency(system, chief, chief)[1]) / 1000
    field = np.zeros((y_um.size, x_um.size), complex)
    for some in np.array_split(np.arange(weight.size), max(1, weight.size // 20000)):
        up = np.exp(2j * np.pi * np.outer(y_um, f[1, some])) * (weight[some] * np.exp(2j * np.pi * phase[some]))
        field += up @ (2 * np.cos(2 * np.pi * np.outer(f[0, some], x_um)))
    miss = np.hypot(rays.stop_x - system.rim * xi[near], rays.stop_y - system.rim * eta[near])[used].max() / system.rim
    return RaySum(field, 2 * float(weight.sum()), float(miss))


def field_at(pupil: Pupil, x_um: np.ndarray, y_um: np.ndarray, cells: int) -> np.ndarray:
    """Return the field (y, x) at places in µm from the chief ray, from the polynomials, up to a constant phase."""
    axis = (np.arange(cells) + 0.5) * (2 / cells) - 1
    amplitude, phase, _ = _fields(pupil, axis)
    grid = _open_cells(pupil, axis) * amplitude * np.exp(2j * np.pi * phase)
    along, across = (np.exp(2j * np.pi * pupil.half / 1000 * np.outer(places, axis)) for places in (y_um, x_um))
    return along @ grid @ across.T
