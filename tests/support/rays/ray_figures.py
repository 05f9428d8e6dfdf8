"""Spot RMS, Strehl ratio, PSF, MTF and energy of a source by dense sums over the referee's own rays.

The pupil is sampled by Gauss–Legendre in ρ² times even angles over the disc, or the ring, of the stop, or of the
paraxial entrance pupil, as the lens's ``aim`` says. What rays carry is a polynomial in ρ² for every harmonic of the
angle, so that denser nodes need no more rays; other rays say how good that is. Every ray stands for the light that
enters by its share of the pupil: the Jacobian of the entrance pupil over the nodes. Energy is that of the field on
circles, by a non-uniform FFT in double precision (`tests/figures/test_energy.py` holds it against plain sums on the
axis). The MTF is that of `tests.support.pupil_sums`, whose error falls with the square of the number of cells, and is
extrapolated from two.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.polynomial.chebyshev import chebint, chebval
from numpy.polynomial.legendre import leggauss
from scipy.fft import dct
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from tests.support.pupil_sums import (
    LostRays,
    OnGrid,
    Pupil,
    cells_for,
    on_grid,
    phase_and_frequency,
    pupil_of,
)
from tests.support.rays.skew_rays import system_of, through_paraxial_pupil, through_stop

COUNTS = (16, 32), (28, 64), (48, 128)  # radii and angles of traced rays: the first that the others agree with
GOOD = 2e-6  # waves, of those
SCANNED = 0.8  # of the highest sample: which of them are looked at closely
FINEST, LEAST_GRID = 4096, 64  # samples a side of the scan
NEWTON = 12
WINGS = 6.0  # λ/NA beyond the outermost ray, to which energy is summed


@dataclass(frozen=True)
class TracedDisc:
    """What rays carry at radii × angles of the pupil, (radii, angles).

    ``square``: ρ² of the radii, ``share``: of the pupil's area per node. ``waves``: phase of plane waves at the sensor.
    ``fx``, ``fy``: cycles per µm, from those of the chief ray; ``x``, ``y``: µm from where that lands. ``light``: what
    enters per unit of pupil area. ``error``: of the phase at rays between the nodes, waves.
    """

    square: np.ndarray
    share: np.ndarray
    waves: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    x: np.ndarray
    y: np.ndarray
    light: np.ndarray
    hole: float
    error: float

    @property
    def weight(self) -> np.ndarray:
        """Return the light of each node, of sum 1."""
        found = self.share * self.light
        return found / found.sum()

    @property
    def slope(self) -> float:
        """Return the waves per pupil radius at the ray that lands farthest."""
        return float(np.hypot(self.x, self.y).max() * np.hypot(self.fx, self.fy).max())

    def denser(self, radii: int, angles: int) -> "TracedDisc":
        """Return the same on more nodes."""
        square, share = disc_rule(radii, angles, self.hole)
        names = ("waves", "fx", "fy", "x", "y", "light")
        values = {name: resampled(getattr(self, name), self.square, square, angles) for name in names}
        return TracedDisc(square=square, share=share, hole=self.hole, error=self.error, **values)


def disc_rule(radii: int, angles: int, hole: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Return ρ² of radii, and the share of the area, (radii, angles), of nodes in `directions`."""
    node, weight = leggauss(radii)
    square = hole**2 + (1 - hole**2) * (1 + node) / 2
    return square, np.repeat(weight[:, None] / 2 / angles, angles, 1)


def directions(angles: int) -> np.ndarray:
    """Return angles from +η towards +ξ."""
    return 2 * np.pi * (np.arange(angles) + 0.5) / angles


def interpolation(known: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return the matrix (at, known) that evaluates the polynomial through values at Gauss–Legendre nodes."""
    scaled = (2 * known - known[0] - known[-1]) / (known[-1] - known[0])
    nodes, weight = leggauss(known.size)
    factor = (-1.0) ** np.arange(known.size) * np.sqrt((1 - nodes**2) * weight)
    away = (2 * at[:, None] - known[0] - known[-1]) / (known[-1] - known[0]) - scaled
    same = away == 0
    part = factor / np.where(same, 1.0, away)
    part = np.where(same.any(1, keepdims=True), same.astype(float), part)
    return part / part.sum(1, keepdims=True)


def harmonics(values: np.ndarray, square: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return polynomials in ρ², at the radii, of every harmonic of the angle, (radii, harmonics), and their parity.

    A harmonic of odd order is ρ times one.
    """
    count = values.shape[1]
    orders = np.fft.fftfreq(count, 1 / count)
    found = np.fft.fft(values, axis=1) / count * np.exp(-1j * orders * np.pi / count)  # from the first node to +η
    odd = np.abs(orders) % 2 == 1
    return np.where(odd, found / np.sqrt(square)[:, None], found), odd


def resampled(values: np.ndarray, square: np.ndarray, to: np.ndarray, angles: int) -> np.ndarray:
    """Return values, (radii, angles), at other radii and angles."""
    found, odd = harmonics(values, square)
    found = interpolation(square, to) @ found * np.where(odd, np.sqrt(to)[:, None], 1.0)
    count = values.shape[1]
    orders = np.fft.fftfreq(count, 1 / count).astype(int)
    padded = np.zeros((to.size, angles), complex)
    kept = np.abs(orders) < min(count, angles) // 2  # two directions share the highest
    padded[:, orders[kept] % angles] = (found * np.exp(1j * orders * np.pi / angles))[:, kept]
    return np.fft.ifft(padded * angles, axis=1).real


def gradient(values: np.ndarray, square: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return ∂/∂ρ and ∂/(ρ∂θ) of values at their own nodes."""
    count = values.shape[1]
    orders, rho = np.fft.fftfreq(count, 1 / count), np.sqrt(square)[:, None]
    found, odd = harmonics(values, square)
    slope = _differences(square) @ found
    along = 2 * rho * slope
    whole = np.where(odd, found * rho, found)
    outward = np.where(odd, found + rho * along, along)
    around = 1j * orders * whole / rho
    turn = np.exp(1j * orders * np.pi / count) * count
    return tuple(np.fft.ifft(each * turn, axis=1).real for each in (outward, around))


def _differences(known: np.ndarray) -> np.ndarray:
    """Return the matrix of derivatives at the nodes themselves."""
    nodes, weight = leggauss(known.size)
    factor = (-1.0) ** np.arange(known.size) * np.sqrt((1 - nodes**2) * weight)
    apart = known[:, None] - known + np.eye(known.size)
    found = factor / factor[:, None] / apart
    np.fill_diagonal(found, 0.0)
    return found - np.diag(found.sum(1))


@lru_cache(maxsize=16)
def traced_disc(lens: Lens, source: Source) -> TracedDisc:
    """Return the rays of a source; LostRays where some do not arrive."""
    for counts in COUNTS:
        found = _traced(lens, source, *counts)
        if found.error < GOOD:
            break
    return found


def _traced(lens: Lens, source: Source, radii: int, angles: int) -> TracedDisc:
    hole = lens.mask.obscuration
    square, share = disc_rule(radii, angles, hole)
    half = directions(angles)[: angles // 2]
    rho = np.sqrt(square)[:, None]
    nodes = _carried(lens, source, (rho * np.sin(half)).ravel(), (rho * np.cos(half)).ravel())
    if not all(np.isfinite(each).all() for each in nodes):
        raise LostRays(f"{np.isnan(nodes[0]).sum()} of {nodes[0].size} rays are lost")
    waves, fx, fy, x, y, pupil_x, pupil_y, density = (
        _mirrored(each.reshape(radii, -1), sign) for each, sign in zip(nodes, (1, -1, 1, -1, 1, -1, 1, 1), strict=True)
    )
    (xr, xt), (yr, yt) = gradient(pupil_x, square), gradient(pupil_y, square)
    light = np.abs(xr * yt - xt * yr) * density
    rng = np.random.default_rng(1)
    some_rho, some = np.sqrt(rng.uniform(hole**2, 1.0, 24)), rng.integers(0, 4 * angles, 24)
    others = _carried(lens, source, some_rho * np.sin(d := directions(4 * angles)[some]), some_rho * np.cos(d))[0]
    expected = np.array(
        [resampled(waves, square, np.array([r * r]), 4 * angles)[0, k] for r, k in zip(some_rho, some, strict=True)]
    )
    error = float(np.abs(others - expected).max())
    return TracedDisc(square, share, waves, fx, fy, x, y, light, hole, error)


def _mirrored(half: np.ndarray, sign: int) -> np.ndarray:
    return np.concatenate([half, sign * half[:, ::-1]], axis=1)


def _carried(lens: Lens, source: Source, xi: np.ndarray, eta: np.ndarray) -> tuple[np.ndarray, ...]:
    system = system_of(lens, source.wavelength_um)
    fill = {"stop": through_stop, "paraxial": through_paraxial_pupil}[lens.aim]
    chief, rays = (fill(system, source, *points) for points in ((np.zeros(1), np.zeros(1)), (xi, eta)))
    waves, f = phase_and_frequency(system, rays, chief)
    f = (f - phase_and_frequency(system, chief, chief)[1]) / 1000
    return (
        *(waves, *f, 1000 * (rays.x - chief.x), 1000 * (rays.y - chief.y)),
        *(rays.pupil_x, rays.pupil_y, rays.density),
    )


@dataclass(frozen=True)
class RayFigures:
    """The figures of one source. ``rays``: as traced. ``pupil``: over spatial frequency, None where it folds."""

    rays: TracedDisc
    pupil: Pupil

    @property
    def folds(self) -> bool:
        """Return whether rays from different parts of the pupil arrive in one direction."""
        (a, b), (c, d) = (gradient(f, self.rays.square) for f in (self.rays.fx, self.rays.fy))
        area = a * d - b * c
        return bool(area.min() * area.max() <= 0)

    @cached_property
    def spot_rms_um(self) -> float:
        """Return the RMS distance of the light of rays from its centroid, µm."""
        r = self.rays
        x, y = (r.weight * r.x).sum(), (r.weight * r.y).sum()
        return float(np.sqrt((r.weight * ((r.x - x) ** 2 + (r.y - y) ** 2)).sum()))

    @cached_property
    def rms_waves(self) -> float:
        """Return the RMS of the phase without piston and tilt, weighted with the light that enters."""
        r = self.rays
        root = np.sqrt(r.weight).ravel()
        terms = np.stack([np.ones(root.size), r.fx.ravel(), r.fy.ravel()], 1) * root[:, None]
        waves = r.waves.ravel() * root
        return float(np.linalg.norm(waves - terms @ np.linalg.lstsq(terms, waves, rcond=None)[0]))

    @cached_property
    def dense(self) -> TracedDisc:
        """Return nodes that carry exp(2πi·phase) to every place where rays land."""
        slope = self.rays.slope
        return self.rays.denser(int(2.5 * slope) + 32, 4 * int(2 * slope) + 64)

    @cached_property
    def peak(self) -> tuple[float, float, float]:
        """Return the Strehl ratio, the highest |Σ light·exp(2πi(phase + f·X))|², and where it is, x and y in µm."""
        found = [self._climbed(start) for start in self._highest_samples()]
        return max(found)

    @property
    def strehl(self) -> float:
        """Return the Strehl ratio."""
        return self.peak[0]

    def field(self, x_um: np.ndarray, y_um: np.ndarray) -> np.ndarray:
        """Return the field (y, x) at places, 1 at the peak of the same pupil without aberration."""
        nodes = self._nodes_for(max(np.abs(x_um).max(), np.abs(y_um).max()))
        amplitude = (nodes.weight * np.exp(2j * np.pi * nodes.waves)).ravel()
        found = np.zeros((y_um.size, x_um.size), complex)
        for some in np.array_split(np.arange(amplitude.size), 1 + amplitude.size // 20000):
            up = np.exp(2j * np.pi * np.outer(y_um, nodes.fy.ravel()[some])) * amplitude[some]
            found += up @ np.exp(2j * np.pi * np.outer(nodes.fx.ravel()[some], x_um))
        return found

    def _nodes_for(self, reach_um: float) -> TracedDisc:
        slope = self.rays.slope + 1.5 * reach_um * float(np.hypot(self.rays.fx, self.rays.fy).max())
        return self.rays.denser(int(2.5 * slope) + 32, 4 * int(2 * slope) + 64)

    def _highest_samples(self) -> list[tuple[float, float]]:
        """Return where the intensity is largest, by a transform of the light that nodes leave on a square grid."""
        nodes, most = self.dense, 1.02 * float(max(np.abs(self.rays.fx).max(), np.abs(self.rays.fy).max()))
        count = int(2 ** np.ceil(np.log2(max(LEAST_GRID, 8 * self.rays.slope))))
        size = min(4 * count, max(FINEST, 2 * count))
        amplitude = (nodes.weight * np.exp(2j * np.pi * nodes.waves)).ravel()
        across, up = ((f.ravel() / most + 1) / 2 * (count - 2) for f in (nodes.fx, nodes.fy))
        grid = np.zeros(count * count, complex)
        for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)):
            part = np.abs(1 - i - across % 1) * np.abs(1 - j - up % 1) * amplitude
            place = (up.astype(int) + j) * count + across.astype(int) + i
            grid += np.bincount(place, part.real, count * count) + 1j * np.bincount(place, part.imag, count * count)
        values = np.abs(np.fft.fftshift(np.fft.fft2(grid.reshape(count, count), (size, size)))) ** 2
        pitch = (count - 2) / (2 * most * size)
        axis = -(np.arange(size) - size // 2) * pitch  # fft2 has the other sign of the exponent
        reach = 1.5 * float(np.hypot(self.rays.x, self.rays.y).max()) + 3 / most
        kept = np.flatnonzero(np.abs(axis) <= reach)
        values, axis = values[np.ix_(kept, kept)], axis[kept]
        centre = values[1:-1, 1:-1]
        rows, columns = values.shape
        shifts = [(i, j) for i in (0, 1, 2) for j in (0, 1, 2)]
        around = [values[i : rows - 2 + i, j : columns - 2 + j] for i, j in shifts]
        peaks = (centre >= np.max(around, axis=0)) & (centre > SCANNED * centre.max())
        rows, columns = np.nonzero(peaks & (axis[1:-1] >= -pitch))
        order = np.argsort(-centre[rows, columns])[:24]
        return [(float(axis[1 + columns[k]]), float(axis[1 + rows[k]])) for k in order]

    def _climbed(self, start: tuple[float, float]) -> tuple[float, float, float]:
        """Return the intensity and place of the maximum near a place, by Newton's method on sums over the nodes."""
        nodes = self.dense
        fx, fy = (2j * np.pi * f.ravel() for f in (nodes.fx, nodes.fy))
        amplitude = (nodes.weight * np.exp(2j * np.pi * nodes.waves)).ravel()
        place, best = np.array(start), (0.0, *start)
        step = np.inf
        for _ in range(NEWTON):
            wave = amplitude * np.exp(fx * place[0] + fy * place[1])
            u, ux, uy = wave.sum(), wave @ fx, wave @ fy
            uxx, uxy, uyy = wave @ fx**2, wave @ (fx * fy), wave @ fy**2
            value = abs(u) ** 2
            if value > best[0]:
                best = (float(value), *place.tolist())
            slope = 2 * np.array([(u.conj() * ux).real, (u.conj() * uy).real])
            bend = 2 * np.array(
                [
                    [(u.conj() * uxx).real + abs(ux) ** 2, (u.conj() * uxy + ux.conj() * uy).real],
                    [(u.conj() * uxy + ux.conj() * uy).real, (u.conj() * uyy).real + abs(uy) ** 2],
                ]
            )
            turned, axes = np.linalg.eigh(bend)
            move = axes @ (axes.T @ slope / np.maximum(np.abs(turned), 1e-12 * np.abs(turned).max()))
            most = 0.1 / float(np.abs(nodes.fx).max())
            move *= min(1.0, most / max(float(np.hypot(*move)), 1e-300))
            step = float(np.hypot(*move))
            if step < 1e-9:
                break
            place = place + move
        return best

    @cached_property
    def _grids(self) -> tuple[OnGrid, OnGrid]:
        cells = max(1024, cells_for(self.pupil.slope))
        return on_grid(self.pupil, cells // 2, False), on_grid(self.pupil, cells, False)

    def contrast(self, frequency_per_mm: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the MTF of patterns along x (sagittal) and along y (tangential)."""
        both = []
        for axis in "xy":
            coarse, fine = (np.abs(self._otf(grid, axis, frequency_per_mm)) for grid in self._grids)
            both.append(fine + (fine - coarse) / 3)
        return both[0], both[1]

    def _otf(self, grid: OnGrid, axis: str, frequency: np.ndarray) -> np.ndarray:
        shift = 2e-3 * np.pi * grid.centroid_um * (axis == "y")  # so that little turns between samples
        smooth = getattr(grid, axis) * np.exp(1j * shift * grid.frequency)
        return CubicSpline(grid.frequency, smooth)(frequency)

    def radius_um(self, share: float) -> float:
        """Return the radius about the centroid that holds a share of the light, µm."""
        energy, top = self._energy
        return float(brentq(lambda r: chebval(2 * r / top - 1, energy) - share, 0.0, top, xtol=1e-9 * top))

    @cached_property
    def _energy(self) -> tuple[np.ndarray, float]:
        """Return the Chebyshev series of the energy in 2R/top − 1, and top in µm.

        By Parseval's theorem from the field on circles about the centroid of the waves' energy, in double precision and
        with all harmonics of the intensity. `tests/support/test_ray_figures.py` holds it against plain sums.
        """
        import finufft

        nodes, light, (x, y) = self._energies
        half = float(np.hypot(nodes.fx, nodes.fy).max())
        top = float(np.hypot(nodes.x - x, nodes.y - y).max()) + WINGS / half
        order = 2 * np.pi * half * top
        radii, angles = int(1.2 * order) + 60, 4 * int(0.55 * order) + 60
        reach, turn = top * (1 + np.cos(np.pi * (np.arange(radii) + 0.5) / radii)) / 2, directions(angles)
        places = (x + np.outer(reach, np.sin(turn))).ravel(), (y + np.outer(reach, np.cos(turn))).ravel()
        wave = self._areas(nodes) * nodes.light * np.exp(2j * np.pi * nodes.waves)
        turns = (2 * np.pi * f.ravel() for f in (nodes.fx, nodes.fy))
        field = finufft.nufft2d3(*turns, wave.ravel(), *places, eps=1e-10, isign=1, nthreads=1)
        flux = (np.abs(field) ** 2).reshape(radii, angles).mean(1) * 2 * np.pi * reach / light
        series = dct(flux, 2) / radii
        series[0] /= 2
        return chebint(series, lbnd=-1) * top / 2, top

    @cached_property
    def _energies(self) -> tuple[TracedDisc, float, tuple[float, float]]:
        """Return dense nodes, the energy of all waves, ∫|light per frequency|² over frequency, and its centroid, µm."""
        slope, square = 2.2 * self.rays.slope + WINGS, self.rays.square
        nodes = self.rays.denser(int(2.5 * slope) + 48, 4 * int(2 * slope) + 96)
        (a, b), (c, d) = (gradient(f, square) for f in (self.rays.fx, self.rays.fy))
        jacobian = resampled(np.abs(a * d - b * c), square, nodes.square, nodes.waves.shape[1])
        energy = self._areas(nodes) * nodes.light**2 / jacobian
        light = energy.sum()
        return nodes, float(light), (float((energy * nodes.x).sum() / light), float((energy * nodes.y).sum() / light))

    @staticmethod
    def _areas(nodes: TracedDisc) -> np.ndarray:
        return nodes.share * np.pi * (1 - nodes.hole**2)

    @property
    def grid_error(self) -> float:
        """Return the largest change of the contrast from half as many cells."""
        coarse, fine = self._grids
        some = slice(0, coarse.frequency.size // 2)
        fine_x, fine_y = (getattr(fine, axis)[::2][: coarse.frequency.size] for axis in "xy")
        return float(max(np.abs(fine_x - coarse.x)[some].max(), np.abs(fine_y - coarse.y)[some].max()))


def ray_figures(lens: Lens, source: Source) -> RayFigures:
    """Return the referee's figures of a source; LostRays where rays do not arrive."""
    return RayFigures(traced_disc(lens, source), pupil_of(lens, source, lens.aim))
