"""Encircled energy from the pupil, of all light and without a window (handbook 6.3).

The light within a radius R of a point is that of the field on circles about it,

    E(R) = ∫₀ᴿ I(r) dr,  I(r) = r·∫|Σ area·D·exp(2πi(w + f·X(r, θ)))|² dθ / Σ area·D²,

which by Parseval's theorem is a share of all light, wherever the rest of it lands. The sums are over Gauss nodes of the
pupil, so that no edge is laid on a grid and nothing repeats itself, at the points of the circles by a non-uniform FFT
(Barnett, Magland and af Klinteberg 2019); I is a Chebyshev series in r, and its integral another.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from math import ceil, pi

import numpy as np
from numpy.polynomial.chebyshev import chebint, chebvander

from p2sf.conventions import write_protect
from p2sf.disc.domain import PupilDomain
from p2sf.disc.phasors import cosine_sine
from p2sf.disc.quadrature import MOST_KEPT, even_count, gauss_legendre
from p2sf.errors import SamplingError
from p2sf.figures.mask_edges import box_edges, slope_waves
from p2sf.figures.transfer import columns_of
from p2sf.pupil.frequency_pupil import FrequencyPupil, landing_um, reach_of

RADII = 128  # of a tabulated curve
BEYOND = 6.0  # λ/NA beyond the outermost ray up to which light is summed; farther out there are the wings of an edge
FARTHEST = 48.0  # the same, where radii are asked for that are so large
MOST_WAVES = 640.0  # of slope: 2 s and 0.5 GB; beyond, the landing points of rays are as exact
NODES, NODES_LEAST = (
    0.7,
    9,
)  # per harmonic of the phase over half the pupil, and more; see `landing_energy` for the margins
FEWEST_LINES = 48  # of a pupil without edges inside, at Gauss–Chebyshev points
FEWEST_EDGED, LINE_EXCESS = 96, 1.5  # behind a mask, between whose edges lines stand as Gauss nodes in an angle
CIRCLES, DIRECTIONS = 0.8, 0.75  # of those that interference of opposite edges would need
SINGLE, FINE_GRID = 3e-5, 1.25  # relative error and oversampling of the FFT
DOUBLE = 1e-12  # relative error of the FFT of cells
GEOMETRIC = 400  # rows and columns of landing points
DIVIDED, DIVISIONS = 2, 64  # times, into parts: a step of 1/4096, over which the curve is a line to 1e-8
JUDGED = 180.0  # waves of slope, to which a pupil is scaled where both roads are compared
COMPARED = 64  # radii
AT_ONCE = 2**14  # cosines, so that a block stays in the cache
POINTS_AT_ONCE = 2**22  # of circles, each block with an FFT of its own


@dataclass(frozen=True, eq=False)
class EncircledLight:
    """The share of all light within a radius of a point: a Chebyshev series in 2·radius/``top_um`` − 1."""

    series: np.ndarray
    top_um: float

    def within(self, radius_um: np.ndarray) -> np.ndarray:
        """Return the share of all light within each radius, (n,).

        Beyond ``top_um`` there are only the wings of a hard edge, with light outside R that falls as 1/R (Lommel 1885).
        """
        inside = np.minimum(radius_um, self.top_um)
        angle = np.arccos(np.clip(2 * inside / self.top_um - 1, -1, 1))  # Tₖ(cos φ) = cos kφ
        found = _cosine_series(self.series, angle)
        outside = (1 - found) * (self.top_um / np.maximum(radius_um, self.top_um))
        return np.where(inside > 0, np.clip(1 - outside, 0.0, 1.0), 0.0)

    def table(self) -> tuple[np.ndarray, np.ndarray]:
        """Return RADII + 1 even radii from 0 to beyond the blur, µm, and the share within each."""
        radius = np.linspace(0, self.top_um, RADII + 1)
        # Energy rises, to 1 at most: held to that, the sum can only come closer to it.
        return radius, np.clip(np.maximum.accumulate(self.within(radius)), 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class LandingPoints:
    """Where rays land about a point, ascending in µm, and the light up to each: energy where diffraction is nothing.

    ``departure``: how far it lies at most from a sum of waves, as measured on the same pupil with a JUDGED slope.
    """

    radius_um: np.ndarray
    light: np.ndarray
    departure: float = float("nan")

    def within(self, radius_um: np.ndarray) -> np.ndarray:
        """Return the share of all light within each radius, (n,)."""
        within: np.ndarray = np.interp(radius_um, self.radius_um, self.light)
        return within

    def table(self) -> tuple[np.ndarray, np.ndarray]:
        """Return RADII + 1 even radii from 0 to the outermost ray, µm, and the share within each."""
        radius = np.linspace(0, float(self.radius_um[-1]), RADII + 1)
        return radius, self.within(radius)


def energy_of(
    pupil: FrequencyPupil, centre_um: float | None = None, aside_um: float | None = None, radius_um: float = 0.0
) -> "EncircledLight | LandingPoints":
    """Return the energy of a pupil about (``aside_um``, ``centre_um``), its centroid if not given.

    ``radius_um``: the largest that is asked for. Of a pupil of which one half is known, and the other mirrored, the
    light is mirrored too, and the point lies on its axis.
    """
    centre = pupil.centroid_um if centre_um is None else centre_um
    aside = pupil.centroid_x_um if aside_um is None else aside_um
    waves = blur_waves(pupil, centre, aside)
    if waves <= MOST_WAVES:
        return landing_energy(pupil, centre, aside, radius_um)
    if not pupil.plain:
        raise SamplingError(
            "a blur of {waves:.0f} waves per pupil radius behind a mask; bring the sensor nearer to the image or "
            "stop down",
            waves=waves,
        )
    return replace(landing_points(pupil, centre, aside), departure=departure_of_rays(pupil, centre, aside))


def radius_of(
    share: float, within: Callable[[np.ndarray], np.ndarray], radius: np.ndarray, fraction: np.ndarray
) -> float:
    """Return the smallest radius that holds a share of the light; NaN where a table of radii and fractions ends before.

    The step of the table that reaches it is divided again and again, each time at once.
    """
    above = np.flatnonzero(fraction >= share)
    if not above.size:
        return float("nan")
    at = int(above[0])
    low, high = radius[max(at - 1, 0)], radius[at]
    for _ in range(DIVIDED):
        radius = np.linspace(low, high, DIVISIONS + 1)
        fraction = within(radius)
        at = max(int(np.argmax(fraction >= share)), 1) if fraction[-1] >= share else DIVISIONS
        low, high = radius[at - 1], radius[at]
    return float(np.interp(share, fraction[at - 1 : at + 1], radius[at - 1 : at + 1]))


def departure_of_rays(pupil: FrequencyPupil, centre_um: float, aside_um: float = 0.0) -> float:
    """Return the largest difference between energy by waves and by landing points, of a pupil with a JUDGED slope.

    With the phase all distances scale, but diffraction does not: in the pupil itself it matters less than there.
    """
    reach = reach_of(pupil)
    scale = JUDGED / max(reach.x, reach.y)
    centroid = scale * pupil.centroid_um, scale * pupil.centroid_x_um
    smaller = replace(pupil, phase=scale * pupil.phase, centroid_um=centroid[0], centroid_x_um=centroid[1])
    centre, aside = scale * centre_um, scale * aside_um
    waves, rays = landing_energy(smaller, centre, aside), landing_points(smaller, centre, aside)
    radius = np.linspace(0, float(rays.radius_um[-1]), COMPARED)
    return float(np.abs(waves.within(radius) - rays.within(radius)).max())


def blur_waves(pupil: FrequencyPupil, centre_um: float, aside_um: float = 0.0) -> float:
    """Return how far from a point rays land at most along x or y, as waves over the pupil's larger radius."""
    reach = reach_of(pupil)
    across = reach.x / pupil.half_x + abs(aside_um - pupil.centroid_x_um)
    up = reach.y / pupil.half_y + abs(centre_um - pupil.centroid_um)
    return max(across, up) * max(pupil.half_x, pupil.half_y) + slope_waves(pupil)


def landing_energy(
    pupil: FrequencyPupil, centre_um: float, aside_um: float = 0.0, radius_um: float = 0.0
) -> EncircledLight:
    """Return the energy about a point by waves, up to a radius or beyond the blur.

    The counts of nodes, circles and directions are less than the harmonics of |field|² would need: those at which
    opposite edges of the pupil interfere are there only where rays of both land. Sums of all give the same to 2e-5
    (`tests/figures/test_energy.py`).
    """
    half = max(pupil.half_x, pupil.half_y)
    blur = blur_waves(pupil, centre_um, aside_um)
    waves = float(np.clip(radius_um * half, blur + BEYOND, blur + FARTHEST))
    x, y, wave, light = _nodes(pupil, (aside_um, centre_um), 2 * waves)
    top = waves / half
    x, y = (_turns(place * side * top) for place, side in ((x, pupil.half_x), (y, pupil.half_y)))
    circles = circles_of(even_count(waves), pupil.domain, (CIRCLES, DIRECTIONS))
    square = _square(_field_of_nodes(x, y, wave, circles))
    return energy_on_circles(square, circles, top, pupil.half_x * pupil.half_y / light)


def energy_on_circles(
    square: np.ndarray, circles: "Circles", top_um: float, scale: float, even: float = 0.0
) -> EncircledLight:
    """Return the energy about 0 of (``square`` + ``even``)·scale per µm², up to the radius ``top_um``.

    ``square``: of the field at the points of circles, (points,); ``even``: the same everywhere.
    """
    mean = np.add.reduceat(square, circles.starts, dtype=float) / circles.directions
    flux = (mean + even) * circles.radius * (2 * pi * top_um**2 * scale)
    series = _cosine_sums(flux) / flux.size
    series[0] /= 2
    return EncircledLight(chebint(series, lbnd=-1) / 2, top_um)


def _cosine_series(series: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Return Σ series[k]·cos kφ at the angles φ, (n,): by the cosine of a sum, with k = count·m + j and j < count.

    Of n terms that takes 4√n cosines and sines in place of n; Clenshaw's sum takes three times as long of 200 terms at
    a hundred angles.
    """
    count = ceil(series.size**0.5)
    term, table = np.arange(count), np.zeros((count, count))
    table.flat[: series.size] = series
    parts = []
    for some in np.array_split(angle, max(1, angle.size * count // AT_ONCE)):
        fine, coarse = np.outer(some, term), np.outer(some, count * term)
        part = np.cos(fine) @ table.T * np.cos(coarse) - np.sin(fine) @ table.T * np.sin(coarse)
        parts.append(part.sum(1))
    return np.concatenate(parts)


def _cosine_sums(values: np.ndarray) -> np.ndarray:
    """Return 2 Σ values[n]·cos(πk(2n + 1)/2N) for all k < N, by one FFT of the values and their mirror image.

    Makhoul 1980, section II. `scipy.fft.dct` takes as long, and 0.15 s to be imported.
    """
    count = values.size
    both = np.fft.rfft(np.append(values, values[::-1]))[:count]
    sums: np.ndarray = (both * np.exp(-0.5j * pi / count * np.arange(count))).real
    return sums


@dataclass(frozen=True, eq=False)
class Circles:
    """Points of circles about 0, ``x`` and ``y`` (points,), one circle behind the other from ``starts`` (circles,).

    ``radius``: shares of the largest, first Chebyshev points between 0 and 1; ``directions``: points of each circle, on
    the half x > 0 of a symmetric pupil.
    """

    radius: np.ndarray
    directions: np.ndarray
    starts: np.ndarray
    x: np.ndarray
    y: np.ndarray


def circles_of(waves: int, domain: PupilDomain, share: tuple[float, float] = (1.0, 1.0)) -> Circles:
    """Return circles that resolve the light of a pupil up to where its edges' plane waves have turned so often.

    ``share``: how many circles and directions there are of those that resolve their interference everywhere.
    """
    return (_kept_circles if waves**2 <= MOST_KEPT else _kept_circles.__wrapped__)(waves, domain, share)


@lru_cache(maxsize=8)
def _kept_circles(waves: int, domain: PupilDomain, share: tuple[float, float]) -> Circles:
    count = even_count(share[0] * _harmonics(2 * pi * waves))
    radius = (1 + np.cos(pi * (np.arange(count) + 0.5) / count)) / 2
    order = 4 * pi * waves * radius
    half = np.ceil((share[1] * order + 8 * np.cbrt(order) + 8) / 4).astype(int) * 2
    directions = half * len(domain.halves)
    starts = np.cumsum(directions) - directions
    angle = (np.arange(directions.sum()) - np.repeat(starts - 0.5, directions)) * np.repeat(pi / half, directions)
    reach = np.repeat(radius, directions)
    x, y = (write_protect(reach * turn) for turn in (np.sin(angle), np.cos(angle)))
    return Circles(write_protect(radius), write_protect(directions), write_protect(starts), x, y)


def _harmonics(order: float) -> float:
    """Return how many harmonics a wave has that turns so many radians: until its Bessel functions end (A&S 9.3.23)."""
    return order + 8 * float(np.cbrt(order)) + 8


def _turns(waves: np.ndarray) -> np.ndarray:
    """Return so many waves in radians, in single precision: of millions of nodes both would take 100 MB."""
    return (2 * pi * waves).astype(np.float32)


def _field_of_nodes(kx: np.ndarray, ky: np.ndarray, wave: np.ndarray, circles: Circles) -> np.ndarray:
    """Return Σ wave·exp(i(kx·x + ky·y)) at the points of circles, (points,), in single precision."""
    import finufft

    x, y = (place.astype(kx.dtype) for place in (circles.x, circles.y))
    # The relative error of all points together; chosen with the grid, so that the kernel stays within single precision.
    # Nodes of one line are neighbours already, and need not be sorted.
    how = {"eps": SINGLE, "upsampfac": FINE_GRID, "isign": 1, "nthreads": 1, "spread_sort": 0}
    field: np.ndarray = finufft.nufft2d3(kx, ky, wave, x, y, **how)
    return field


def light_of_cells(cells: np.ndarray, circles: Circles) -> np.ndarray:
    """Return |Σ cells[j, i]·exp(iπ(i·x + j·y))|² at the points of circles, (points,)."""
    import finufft

    light = np.empty(circles.x.size)
    for start in range(0, light.size, POINTS_AT_ONCE):
        some = slice(start, start + POINTS_AT_ONCE)
        x, y = np.pi * circles.x[some], np.pi * circles.y[some]
        light[some] = _square(finufft.nufft2d2(y, x, cells, eps=DOUBLE, isign=1, nthreads=1))
    return light


def _square(field: np.ndarray) -> np.ndarray:
    square: np.ndarray = field.real**2 + field.imag**2
    return square


Nodes = tuple[np.ndarray, np.ndarray, np.ndarray, float]
"""x and y in the box's coordinates, area·density·exp(2πi·phase) (nodes,) complex64, and Σ area·density²."""


def _node_count(waves: float) -> int:
    """Return how many even nodes resolve a phase of so many waves per radius over two radii."""
    return even_count(NODES * pi * waves + NODES_LEAST)


def _nodes(pupil: FrequencyPupil, centre_um: tuple[float, float], waves: float) -> Nodes:
    """Return the nodes of a pupil whose phase has such a slope: columns between the ends and corners of its edges.

    Those of a symmetric pupil at fx < 0 mirror the others.
    """
    count = _node_count(waves)
    if pupil.plain:
        columns = columns_of(pupil, (max(FEWEST_LINES, count), count), [], [])
    else:
        columns = columns_of(pupil, (max(FEWEST_EDGED, ceil(LINE_EXCESS * count)), count), *box_edges(pupil))
    parts = []
    for low, high in zip(columns.low, columns.high, strict=True):
        length = (high - low)[:, None] / 2
        node, weight = gauss_legendre(_node_count(waves * float(length.max())))
        y = (low + high)[:, None] / 2 + length * node
        parts.append(_column_nodes(pupil, centre_um, (columns.places, y), columns.weights[:, None] * length * weight))
    x, y, wave = (np.concatenate(column) for column in zip(*(part[:3] for part in parts), strict=True))
    total = sum(part[3] for part in parts)
    images = pupil.domain.images
    count = len(images)
    return np.concatenate([side * x for side in images]), np.tile(y, count), np.tile(wave / count, count), total


def _column_nodes(
    pupil: FrequencyPupil, centre_um: tuple[float, float], at: tuple[np.ndarray, np.ndarray], area: np.ndarray
) -> Nodes:
    """Return nodes (columns, nodes) at x of columns, (columns,), and y, with their areas."""
    x, y = at
    phase, density = (_clenshaw(_lines(table.T, x), y) for table in (pupil.phase, pupil.density))
    if pupil.mask.shaded or pupil.mask.phased:
        xi, eta = (_clenshaw(_lines(table.T, x), y) for table in (pupil.xi, pupil.eta))
        density = density * pupil.mask.amplitude(xi, eta)
        if pupil.mask.phased:
            phase += pupil.mask.path_um(xi, eta) / pupil.wavelength_um
    phase += centre_um[0] * pupil.half_x * x[:, None] + centre_um[1] * pupil.half_y * y
    wave, light = _waves(area * np.abs(density), np.abs(density), phase)
    return np.repeat(x, y.shape[1]), y.ravel(), wave, light


def _lines(table: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Return the coefficients along the other axis of Σ table[b, a]·T_b(place)·T_a, (places, a)."""
    lines: np.ndarray = chebvander(places, len(table) - 1) @ table
    return lines


def _clenshaw(series: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return Chebyshev series, (lines, terms), at points of each line, (lines, points) (Clenshaw 1955)."""
    after, value = np.zeros_like(at), np.zeros_like(at)
    for term in series.T[:0:-1]:
        after, value = value, 2 * at * value - after + term[:, None]
    found: np.ndarray = at * value - after + series[:, :1]
    return found


def _waves(amplitude: np.ndarray, density: np.ndarray, phase: np.ndarray) -> tuple[np.ndarray, float]:
    """Return amplitude·exp(2πi·phase), flat, and Σ amplitude·density."""
    wave = np.empty(phase.shape, np.complex64)
    wave.real, wave.imag = cosine_sine(phase, np.float32)
    wave *= amplitude.astype(np.float32)
    return wave.ravel(), float(np.vdot(amplitude, density))


def landing_points(pupil: FrequencyPupil, centre_um: float, aside_um: float = 0.0) -> LandingPoints:
    """Return where the pupil's rays land about a point."""
    x, y, light = landing_um(pupil, GEOMETRIC)
    radius = np.hypot(x - aside_um, y - centre_um).ravel()
    order = np.argsort(radius)
    share = np.cumsum(light.ravel()[order])
    return LandingPoints(np.append(0.0, radius[order]), np.append(0.0, share / share[-1]))
