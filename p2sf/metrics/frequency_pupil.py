"""The pupil of one method as a function of spatial frequency: phase and density as polynomials, and its outline.

The field at the sensor is a Fourier integral over the frequencies f = n'K/λ of the plane waves that arrive,

    E(x, y) = ∫∫ D(fx, fy)·exp(2πi(w(fx, fy) + fx·x + fy·y)) dfx dfy,

D the density of the rays, weight·|∂(ξ, η)/∂(fx, fy)|. Everything a PSF is judged by, its transfer function and its
energy, is an integral over this pupil (Goodman 2005, eq. 6-28), which needs no window. Phase and density are smooth,
so a polynomial through some hundreds of rays gives them at all frequencies of a grid by two small products.

See handbook 6.3.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import lru_cache
from math import inf, nan, sqrt

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebvander
from scipy.fft import dct, dst, irfft, rfft
from scipy.linalg import qr, solve_triangular

from p2sf.conventions import protected
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens, check_unmasked
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.psf.smooth_pupil import all_reach
from p2sf.pupil.mask import CLEAR, PupilMask
from p2sf.raytrace.fit import FittedPencil
from p2sf.raytrace.pencil import hexapolar, pencil
from p2sf.raytrace.seen_mask import mask_seen
from p2sf.raytrace.spot import Landing, landing
from p2sf.raytrace.vignetting import clear_nodes, clear_outline, whole_nodes

# RMS error of phase and density from which a higher order is tried: the transfer function's is at most 2π√2 times it.
RESIDUAL_WAVES = 5e-5
MOST_RESIDUAL = 2e-3  # and above which no polynomial describes the pupil
JUDGED_AT = 18  # the order from which on a fold that the one before sees too is no error of either
HOPELESS = 0.1  # waves at that order, which the highest does not bring down to MOST_RESIDUAL
REACH_RINGS = 8  # of rays that show how much of the pupil reaches the sensor
LEAST_REACHING = 0.05
RIM = 64  # intervals of the rim's right half that are traced
OUTLINE = 2048  # intervals of the outline: chords between them depart from it by 3e-7 of the radius
CENTROID_CELLS = 256  # along each side, for the centroid of the light that a mask lets through: 1e-3 of its radius
PROBE = 33  # points along each axis where slopes are looked for

UNFOLLOWED = "no polynomial fits the rays of this pupil; stop the lens down or reduce the field"


@dataclass(frozen=True)
class RayCounts:
    """How many radii × directions of rays carry polynomials of an order."""

    order: int
    radii: int
    directions: int


ORDERS = (
    RayCounts(8, 10, 16),
    RayCounts(10, 10, 16),
    RayCounts(14, 14, 24),
    RayCounts(18, 14, 24),
    RayCounts(24, 20, 36),
    RayCounts(32, 28, 48),
    RayCounts(44, 40, 70),
)
STOP_ORDERS = 4  # more over the stop, which the same rays carry
EXACT = RayCounts(4, 6, 10)  # the six coefficients are a polynomial of fourth order


@dataclass(frozen=True)
class PupilSamples:
    """Rays over half the pupil, (nodes,): the last ``rim`` of them on its edge, from the top to the bottom.

    ``share``: the area that each stands for, 0 on the edge; ``weight``: of its field; phase in waves, fx and fy in
    cycles per µm.
    """

    xi: np.ndarray
    eta: np.ndarray
    share: np.ndarray
    weight: np.ndarray
    phase: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    rim: int


@dataclass(frozen=True)
class RayMoments:
    """Where the light of rays lands on the mean, and its RMS distance from there, µm from the chief ray."""

    x_um: float = 0.0
    y_um: float = 0.0
    rms_um: float = 0.0


ONE_POINT = RayMoments()


@dataclass(frozen=True, eq=False)
class FrequencyPupil:
    """The pupil over spatial frequencies (fx, fy), even in fx, its mask too, unless ``even`` is False.

    Attributes
    ----------
    half_x, half_y, middle_y : float
        The box around the pupil: |fx| ≤ half_x, |fy − middle_y| ≤ half_y, cycles per µm.
    phase, density : numpy.ndarray
        Coefficients of T_b(y)·T_a(x), (order + 1, order + 1), in the box's own coordinates; phase in waves, the density
        positive and up to a factor.
    outline_x, outline_y : numpy.ndarray
        The edge's right half from the largest to the smallest fy, in the box's coordinates; the whole, once around,
        where the pupil is not even.
    centroid_um : float
        The light's centroid along y, µm from the chief ray: the mean landing point, weighted by the energy of the
        waves, the square of their amplitude.
    spot : RayMoments
        Centroid of the exact rays and their RMS distance from it, weighted by the light that each carries, µm; those of
        the description alone where there is no lens to trace, or a phase in the stop.
    residual_waves : float
        RMS error of the phase, also of the method's description of it; that of the density counts as a phase of 1/2π
        of it.
    rays : int
        How many rays were traced.
    mask : PupilMask
        What stands in the pupil, as the source sees it; ``density`` and ``phase`` are those of the whole disc.
    wavelength_um : float
        By which the mask's path is waves.
    xi, eta : numpy.ndarray
        ξ and η of the ray at a point of the box, as ``phase`` is.
    even : bool
        Whether fx and −fx are alike, as they are in the plane of symmetry of a lens that has one.
    centroid_x_um : float
        The light's centroid along x, 0 where the pupil is even.
    """

    half_x: float
    half_y: float
    middle_y: float
    phase: np.ndarray
    density: np.ndarray
    outline_x: np.ndarray
    outline_y: np.ndarray
    centroid_um: float
    spot: RayMoments
    residual_waves: float
    rays: int
    mask: PupilMask = CLEAR
    wavelength_um: float = nan
    xi: np.ndarray = field(default_factory=lambda: np.array([[0.0, 1.0], [0.0, 0.0]]))
    eta: np.ndarray = field(default_factory=lambda: np.array([[0.0, 0.0], [1.0, 0.0]]))
    even: bool = True
    centroid_x_um: float = 0.0

    @property
    def predicted_error(self) -> float:
        """Return the most that contrast and energy are predicted to be off: 2π√2 of the RMS error of the phase.

        By Schwarz's inequality the product of two fields whose phases are off by δ each changes by 2π·√(2⟨δ²⟩) at most.
        """
        return min(2 * np.pi * sqrt(2) * self.residual_waves, 1.0)

    @property
    def cut_off_per_um(self) -> tuple[float, float]:
        """Return the frequencies along x and along y from which on nothing is transferred, cycles per µm."""
        return 2 * self.half_x, 2 * self.half_y

    def without_phase(self) -> "FrequencyPupil":
        """Return the same pupil of a perfect lens, whose light lands in one point but for diffraction."""
        mask = self.mask.without_phase()
        return replace(self, phase=np.zeros((2, 2)), centroid_um=0.0, centroid_x_um=0.0, spot=ONE_POINT, mask=mask)

    @property
    def transposed(self) -> "FrequencyPupil":
        """Return a pupil that is not even with x and y exchanged; its middle and its map to the stop are left out."""
        return replace(
            self,
            half_x=self.half_y,
            half_y=self.half_x,
            phase=self.phase.T,
            density=self.density.T,
            outline_x=self.outline_y,
            outline_y=self.outline_x,
            centroid_um=self.centroid_x_um,
            centroid_x_um=self.centroid_um,
        )

    @property
    def edge(self) -> np.ndarray:
        """Return the whole edge, once around, (2, points), in the box's coordinates."""
        outline = np.stack([self.outline_x, self.outline_y])
        if not self.even:
            return outline
        return np.concatenate([outline, outline[:, -2:0:-1] * [[-1.0], [1.0]]], axis=1)

    @property
    def unfolded(self) -> "FrequencyPupil":
        """Return the same pupil described as one that is not even, which it need not be behind a mask."""
        outline_x, outline_y = self.edge
        return replace(self, outline_x=outline_x, outline_y=outline_y, even=False)

    def chords(self, y: np.ndarray) -> np.ndarray:
        """Return the half length of the row at each y, in the box's coordinates; 0 outside the pupil."""
        half: np.ndarray = np.interp(-y, -self.outline_y, self.outline_x, left=0.0, right=0.0)
        return half

    def columns(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the lower and the upper end of the column at each x of the box, ≥ 0 of an even pupil."""
        if not self.even:
            return _ends(self.outline_x, self.outline_y, x)
        widest = int(self.outline_x.argmax())
        upper = np.interp(x, self.outline_x[: widest + 1], self.outline_y[: widest + 1])
        lower = np.interp(x, self.outline_x[: widest - 1 : -1], self.outline_y[: widest - 1 : -1])
        return lower, upper

    def on_grid(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return phase and density at the points (y, x) of a grid in the box's coordinates."""
        return _on_grid(self.phase, x, y), _on_grid(self.density, x, y)

    def stop_on_grid(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return ξ and η at the points (y, x) of a grid in the box's coordinates."""
        return _on_grid(self.xi, x, y), _on_grid(self.eta, x, y)


def _ends(edge_x: np.ndarray, edge_y: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the lower and the upper end, at each x, of what a closed curve goes around once; one point beside it."""
    edge_x, edge_y = (np.roll(edge, -int(edge_x.argmin())) for edge in (edge_x, edge_y))
    farthest = int(edge_x.argmax())
    there = edge_x[: farthest + 1], edge_y[: farthest + 1]
    back = np.append(edge_x[farthest:], edge_x[0])[::-1], np.append(edge_y[farthest:], edge_y[0])[::-1]
    one, two = (np.interp(x, np.maximum.accumulate(side), height) for side, height in (there, back))
    return np.minimum(one, two), np.maximum(one, two)


def _on_grid(table: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    order = len(table) - 1
    values: np.ndarray = chebvander(y, order) @ table @ chebvander(x, order).T
    return values


@dataclass(frozen=True)
class Reach:
    """How far apart rays land, as waves over the pupil's radius: what sums over the pupil must resolve.

    ``x``, ``y``: the largest distance from the centroid along each axis times half_x, half_y. ``in_row``: the largest
    difference of y between rays of one row, times half_y; ``in_column``: of x between rays of one column, times half_x.
    """

    x: float
    y: float
    in_row: float
    in_column: float


def reach_of(pupil: FrequencyPupil) -> Reach:
    """Return how far apart rays land: over f, the phase has the gradient −(x, y) (Hamilton)."""
    x, y = np.linspace(0, 1, PROBE), np.cos(np.linspace(0, np.pi, PROBE))
    if pupil.even:
        outside = x > pupil.chords(y)[:, None] + 1 / PROBE
    else:
        x = np.linspace(-1, 1, 2 * PROBE - 1)
        low, high = pupil.columns(x)
        margin = 2 / PROBE  # so that no column, however short, is without a point
        outside = (y[:, None] > high + margin) | (y[:, None] < low - margin)
    along, across = (chebvander(points, len(pupil.phase) - 1) for points in (y, x))
    by_x, by_y = _derivatives(pupil.phase)
    landing_x = np.where(outside, np.nan, along @ by_x @ across[:, :-1].T)
    landing_y = np.where(outside, np.nan, along[:, :-1] @ by_y @ across.T)
    landing_x += pupil.centroid_x_um * pupil.half_x
    landing_y += pupil.centroid_um * pupil.half_y
    x_range, y_range = (
        np.nanmax(landing_x, 0) - np.nanmin(landing_x, 0),
        np.nanmax(landing_y, 1) - np.nanmin(landing_y, 1),
    )
    farthest_x, farthest_y = (float(np.nanmax(np.abs(landing))) for landing in (landing_x, landing_y))
    return Reach(farthest_x, farthest_y, float(y_range.max()), float(x_range.max()))


def landing_um(pupil: FrequencyPupil, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return where rays land, x and y in µm from the chief ray, and the light of each, up to a factor."""
    if not pupil.even:
        return _landing_by_columns(pupil, count)
    angle = np.arange(1, count + 1) * (np.pi / (count + 1))
    y = np.cos(angle)[:, None]
    chord = pupil.chords(y[:, 0])[:, None]
    x = chord * (np.arange(count) + 0.5) / count
    along, across = (chebvander(points, len(pupil.phase) - 1) for points in (y[:, 0], x))
    by_x, by_y = _derivatives(pupil.phase)
    landing_x, landing_y, density = (
        (across[..., : table.shape[1]] @ (along[:, : len(table)] @ table)[..., None])[..., 0]
        for table in (by_x, by_y, pupil.density)
    )
    light: np.ndarray = density**2 * chord * np.sin(angle)[:, None]
    return -landing_x / pupil.half_x, -landing_y / pupil.half_y, light


def _landing_by_columns(pupil: FrequencyPupil, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    angle = np.arange(1, count + 1) * (np.pi / (count + 1))
    x = np.cos(angle)[:, None]
    low, high = (end[:, None] for end in pupil.columns(x[:, 0]))
    y = low + (high - low) * (np.arange(count) + 0.5) / count
    across, along = (chebvander(points, len(pupil.phase) - 1) for points in (x[:, 0], y))
    by_x, by_y = _derivatives(pupil.phase)
    landing_x, landing_y, density = (
        np.einsum("xyb,ba,xa->xy", along[..., : len(table)], table, across[:, : table.shape[1]], optimize=True)
        for table in (by_x, by_y, pupil.density)
    )
    light: np.ndarray = density**2 * (high - low) * np.sin(angle)[:, None]
    return -landing_x / pupil.half_x, -landing_y / pupil.half_y, light


def _derivatives(table: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the coefficients of ∂/∂x and of ∂/∂y of Σ table[b, a]·T_b(y)·T_a(x)."""
    derivative = _derivative(len(table) - 1)
    return table @ derivative.T, derivative @ table


@lru_cache(maxsize=16)
def _derivative(order: int) -> np.ndarray:
    """Return the matrix (order, order + 1) from coefficients of Chebyshev polynomials to those of the derivative."""
    return protected(chebder(np.eye(order + 1)))


def uniform_disc(half: float = 1.0, even: bool = True) -> FrequencyPupil:
    """Return the pupil of a perfect lens whose cut-off is 2·half cycles per µm."""
    x, y = _rim(OUTLINE, even)
    return FrequencyPupil(half, half, 0.0, np.zeros((2, 2)), np.ones((1, 1)), x, y, 0.0, ONE_POINT, 0.0, 0, even=even)


def pupil_of_rays(lens: Lens, source: Source, clip: bool = False, turn_deg: float = 0.0) -> FrequencyPupil:
    """Return the pupil of exact rays; where rims clip or rays are lost, it ends there.

    ``turn_deg``: by how much its axes are turned from those of the source's image, from +y towards +x.
    Raises GeometryError where the chief ray does not reach the sensor, or no polynomial describes the pupil, as where
    rays of different parts of it arrive in one direction.
    """
    mask = mask_seen(lens, source)
    whole, even = not clip and all_reach(lens, source), not (lens.misaligned or turn_deg)
    if not (whole or mask.clear):
        check_unmasked(lens, Message("a transfer function of a pupil that ends at rims or where rays are lost"))
    if not (whole or clip):
        _check_reach(lens, source)
    edge = _rim(RIM, even) if whole else clear_outline(lens, source, OUTLINE // 4, clip, even)

    def traced(sampling: RayCounts) -> PupilSamples:
        counts = sampling.radii, 2 * sampling.directions
        inside = whole_nodes(counts) if whole else clear_nodes(lens, source, counts, clip)
        inside = inside if even else inside.unfolded()
        xi, eta = np.append(inside.xi, edge[0]), np.append(inside.eta, edge[1])
        rays = pencil(lens, source, xi, eta)
        passed = rays.passed  # where light is lost, an outline by directions misses a few rays
        if whole and not passed.all():
            raise GeometryError(UNFOLLOWED)
        across, up = turned(rays.fx, rays.fy, turn_deg)
        columns = xi, eta, _shares(inside.weight, edge), rays.amplitude, rays.phase, across, up
        xi, eta, share, weight, phase, fx, fy = (column[passed] for column in columns)
        return PupilSamples(xi, eta, share, weight, phase, fx, fy, int(passed[-edge[0].size :].sum()))

    found = behind_mask(_settled(traced, ORDERS, whole, even), mask, float(source.wavelength_um))
    return with_spot(found, lens, source, clip, turn_deg)


def _check_reach(lens: Lens, source: Source) -> None:
    """Raise GeometryError where so few rays reach the sensor that to find their outline is long and tells nothing."""
    share = float(pencil(lens, source, *hexapolar(REACH_RINGS)).passed.mean())
    if share < LEAST_REACHING:
        raise GeometryError(
            "{percent:.1f} % of the rays that fill the pupil reach the sensor, too few for its contrast and energy; "
            "move the source to a distance the lens is made for, or stop the lens down",
            percent=100 * share,
        )


def with_spot(
    pupil: FrequencyPupil, lens: Lens, source: Source, clip: bool = False, turn_deg: float = 0.0
) -> FrequencyPupil:
    """Return the pupil with the figures of the spot diagram; its own behind a phase, which bends rays."""
    if pupil.mask.phased:
        return pupil
    return replace(pupil, spot=_spot_of(landing(lens, source, clip), turn_deg))


def _spot_of(found: Landing, turn_deg: float) -> RayMoments:
    """Return the figures of the spot diagram, its centroid along turned axes."""
    x, y = turned(*found.centroid_um, turn_deg)
    return RayMoments(float(x), float(y), float(np.hypot(*found.rms_um)))


def turned(fx: np.ndarray, fy: np.ndarray, turn_deg: float) -> tuple[np.ndarray, np.ndarray]:
    """Return frequencies along axes that are turned from +y towards +x."""
    if not turn_deg:
        return fx, fy
    sine, cosine = np.sin(np.deg2rad(turn_deg)), np.cos(np.deg2rad(turn_deg))
    return cosine * fx - sine * fy, sine * fx + cosine * fy


def pupil_of_fit(found: FittedPencil, turn_deg: float = 0.0) -> FrequencyPupil:
    """Return the pupil that a fit describes, axes as `pupil_of_rays`. Raises GeometryError where its map folds."""
    even = not (found.level.skew or turn_deg)
    edge = _rim(RIM, even)

    def evaluated(sampling: RayCounts) -> PupilSamples:
        xi, eta, share = _over_disc(sampling, edge, even)
        phase, fx, fy = found.at(xi, eta)
        return PupilSamples(xi, eta, share, found.amplitude_at(xi, eta), phase, *turned(fx, fy, turn_deg), edge[0].size)

    known = _settled(evaluated, ORDERS, True, even)
    known = replace(known, rays=found.rays, residual_waves=float(np.hypot(known.residual_waves, found.error_waves)))
    return behind_mask(known, found.mask, found.wavelength_um)


def _over_disc(
    sampling: RayCounts, edge: tuple[np.ndarray, np.ndarray], even: bool
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return ξ, η and shares of the area of nodes over the disc, half of it for an even pupil, and on its edge."""
    inside = whole_nodes((sampling.radii, 2 * sampling.directions))
    inside = inside if even else inside.unfolded()
    return np.append(inside.xi, edge[0]), np.append(inside.eta, edge[1]), _shares(inside.weight, edge)


def pupil_of_coefficients(six: Coefficients, mask: PupilMask = CLEAR, turn_deg: float = 0.0) -> FrequencyPupil:
    """Return the pupil of the six coefficients: the unit circle, frequencies −n'u'(ξ, η)/λ, uniform density.

    ``mask``: what else stands in it, as the source sees it. W counts the other way round than the mask's path.
    """
    even, scale = not turn_deg, -float(six.reduced_slope) / float(six.wavelength_um)
    edge = _rim(RIM, even)

    def evaluated(sampling: RayCounts) -> PupilSamples:
        xi, eta, share = _over_disc(sampling, edge, even)
        phase, one = np.asarray(wavefront(six, xi, eta)), np.ones(xi.size)
        across, up = turned(scale * xi, scale * eta, turn_deg)
        return PupilSamples(xi, eta, share, one, phase, across, up, edge[0].size)

    found = replace(_settled(evaluated, (EXACT,), True, even), rays=2)
    return behind_mask(found, mask, -float(six.wavelength_um))


def behind_mask(pupil: FrequencyPupil, mask: PupilMask, wavelength_um: float) -> FrequencyPupil:
    """Return the pupil behind a mask: centroid and RMS distance are those of the light that passes."""
    if mask.clear:
        return pupil
    pupil = replace(pupil if mask.even else pupil.unfolded, mask=mask, wavelength_um=wavelength_um)
    axis = (np.arange(CENTROID_CELLS) + 0.5) * (2 / CENTROID_CELLS) - 1
    xi, eta = pupil.stop_on_grid(axis, axis)
    inside = mask.opens(xi, eta) & (xi * xi + eta * eta <= 1)
    phase, density = pupil.on_grid(axis, axis)
    if mask.phased:
        phase = phase + np.where(inside, mask.path_um(xi * inside, eta * inside), 0.0) / wavelength_um
    slope_y, slope_x = np.gradient(phase, axis[1] - axis[0])
    # Differences across an edge of a phase that ends there are none.
    whole = inside if not mask.phased else inside & ~_beside(~inside)
    # Of rays the density is the light, of waves the amplitude.
    light = np.where(whole, density * np.square(mask.amplitude(xi * inside, eta * inside)), 0.0)
    landing_x, landing_y = -slope_x / pupil.half_x, -slope_y / pupil.half_y
    spot, waves = (_moments(landing_x, landing_y, part, pupil.even) for part in (light, light * density))
    return replace(pupil, centroid_um=waves.y_um, centroid_x_um=waves.x_um, spot=spot)


def _moments(x: np.ndarray, y: np.ndarray, light: np.ndarray, even: bool) -> RayMoments:
    """Return the moments of light that lands at x and y; where it is ``even`` the mean x is 0."""
    share = light / light.sum()
    aside, centre = 0.0 if even else float((share * x).sum()), float((share * y).sum())
    square = float((share * ((x - aside) ** 2 + (y - centre) ** 2)).sum())
    return RayMoments(aside, centre, float(np.sqrt(square)))


def _beside(cells: np.ndarray) -> np.ndarray:
    """Return the cells that have one of these beside them."""
    beside: np.ndarray = np.logical_or.reduce([np.roll(cells, s, axis) for axis in (0, 1) for s in (-1, 1)])
    return beside


def _shares(weight: np.ndarray, edge: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    return np.append(weight, np.zeros(edge[0].size))


@lru_cache(maxsize=4)
def _rim(intervals: int, even: bool = True) -> tuple[np.ndarray, np.ndarray]:
    """Return the right half of the unit circle from (0, 1) to (0, −1), or once around, ``intervals`` to the half."""
    angle = np.linspace(0, np.pi, intervals + 1) if even else np.arange(2 * intervals) * (np.pi / intervals)
    return protected(np.sin(angle)), protected(np.cos(angle))


def _settled(
    nodes_of: Callable[[RayCounts], PupilSamples], orders: tuple[RayCounts, ...], smooth: bool, even: bool = True
) -> FrequencyPupil:
    """Return the pupil through nodes, of the first order whose residual is small enough."""
    counts, traced, before = (0, 0), 0, 0.0
    for sampling in orders:
        if counts != (sampling.radii, sampling.directions):
            nodes, counts = nodes_of(sampling), (sampling.radii, sampling.directions)
            traced += nodes.xi.size
        found = _through(nodes, sampling.order, smooth, even)
        hopeless = sampling.order >= JUDGED_AT and min(before, found.residual_waves) > HOPELESS
        if hopeless or found.residual_waves < RESIDUAL_WAVES:
            break
        before = found.residual_waves
    if found.residual_waves == inf:
        raise GeometryError(
            "rays of different parts of the pupil arrive in one direction, and the sum of their light has no limit; "
            "stop the lens down or reduce the field"
        )
    if not found.residual_waves < MOST_RESIDUAL:
        raise GeometryError(UNFOLLOWED)
    return replace(found, rays=traced)


def _through(nodes: PupilSamples, order: int, smooth: bool, even: bool) -> FrequencyPupil:
    """Return the polynomials through nodes by least squares, and what else follows from the rays."""
    fx, fy = np.abs(nodes.fx) if even else nodes.fx, nodes.fy  # of a pupil that is even in fx, either half will do
    edge_x, edge_y = (_outline if even else _whole_outline)(fx[-nodes.rim :], fy[-nodes.rim :], smooth)
    (left, right), (low, high) = ((float(edge.min()), float(edge.max())) for edge in (edge_x, edge_y))
    half_x, centre = (right, 0.0) if even else ((right - left) / 2, (right + left) / 2)
    half_y, middle = (high - low) / 2, (high + low) / 2
    x, y = (fx - centre) / half_x, (fy - middle) / half_y
    used = nodes.xi > 0 if even else np.ones(x.size, bool)
    least = LeastSquares(order, x[used], y[used], nodes.share[used], even)
    phase = least.solve(nodes.phase[used])
    miss = least.values(phase) - nodes.phase[used]
    freedom = max(1 - least.unknowns / miss.size, 1e-3)
    share = nodes.share[used]
    area = _area(nodes, (x, y), used, order + STOP_ORDERS, even)
    true = nodes.weight[used] / np.abs(area)
    density = least.solve(true)
    light = share * nodes.weight[used]
    landing_x, landing_y = (-slope / half for slope, half in zip(least.slopes(phase), (half_x, half_y), strict=True))
    # Of rays weight·dξdη is the light, of waves D²df = D·weight·dξdη.
    spot, waves = (_moments(landing_x, landing_y, part, even) for part in (light, light * true))
    thin = light * true @ (least.values(density) / true - 1) ** 2 / (light @ true)
    # An error of the amplitude changes the field as a phase of 1/2π of it does.
    residual = float(np.sqrt((share @ miss**2 / share.sum() + thin / (2 * np.pi) ** 2) / freedom))
    xi = least.solve(nodes.xi[used] / x[used] if even else nodes.xi[used])
    xi = _times_x(xi) if even else xi
    return FrequencyPupil(
        half_x,
        half_y,
        middle,
        phase,
        density,
        (edge_x - centre) / half_x,
        (edge_y - middle) / half_y,
        waves.y_um,
        spot,
        residual if area.min() * area.max() > 0 else inf,
        0,
        xi=-xi if even and nodes.xi @ nodes.fx < 0 else xi,
        eta=least.solve(nodes.eta[used]),
        even=even,
        centroid_x_um=waves.x_um,
    )


class LeastSquares:
    """Polynomials T_a(x)·T_b(y), a + b ≤ order, through values at points of the box, by one QR; ``even``: a even."""

    def __init__(self, order: int, x: np.ndarray, y: np.ndarray, share: np.ndarray, even: bool = True):
        self._x, self._y, self._order, self._even = x, y, order, even
        self._at = np.array([(b, a) for a in range(0, order + 1, 1 + even) for b in range(order + 1 - a)]).T
        self._across, self._along = chebvander(x, order), chebvander(y, order)
        self._design = self._along[:, self._at[0]] * self._across[:, self._at[1]]
        self._root = np.sqrt(share + share[share > 0].min())  # the edge counts too, where polynomials deviate first
        self._factor, self._upper = qr(self._design * self._root[:, None], mode="economic", check_finite=False)
        self.unknowns = self._at.shape[1]

    def solve(self, values: np.ndarray) -> np.ndarray:
        """Return the coefficients, (order + 1, order + 1) for (b, a)."""
        table = np.zeros((self._order + 1, self._order + 1))
        table[tuple(self._at)] = solve_triangular(self._upper, self._factor.T @ (values * self._root))
        return table

    def values(self, table: np.ndarray) -> np.ndarray:
        """Return the polynomial at the points."""
        values: np.ndarray = self._design @ table[tuple(self._at)]
        return values

    def slopes(self, table: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return ∂/∂x and ∂/∂y of the polynomial at the points."""
        by_x, by_y = _derivatives(table)
        across = np.einsum("na,na->n", self._along @ by_x, self._across[:, :-1])
        along = np.einsum("na,na->n", self._along[:, :-1] @ by_y, self._across)
        return across, along

    def area(self, across: np.ndarray, along: np.ndarray) -> np.ndarray:
        """Return ∂(across, along)/∂(x, y) at the points, of two functions of them; ``across`` odd in x if even."""
        # Of an even pupil across is odd in x, and across/x even.
        stretch, up = self.solve(across / self._x if self._even else across), self.solve(along)
        (stretch_x, stretch_y), (up_x, up_y) = self.slopes(stretch), self.slopes(up)
        if self._even:
            stretch_x, stretch_y = self.values(stretch) + self._x * stretch_x, self._x * stretch_y
        area: np.ndarray = stretch_x * up_y - stretch_y * up_x
        return area


def _area(
    nodes: PupilSamples, box: tuple[np.ndarray, np.ndarray], used: np.ndarray, order: int, even: bool
) -> np.ndarray:
    """Return ∂(x, y)/∂(ξ, η) at the used nodes, (x, y) in the box: over the stop it is smooth however rays crowd."""
    stop = LeastSquares(order, nodes.xi[used], nodes.eta[used], nodes.share[used], even)
    return stop.area(box[0][used], box[1][used])


def _times_x(table: np.ndarray) -> np.ndarray:
    """Return the coefficients of x·Σ table[b, a]·T_b(y)·T_a(x): x·T_a = (T_a₊₁ + T_|a₋₁|)/2."""
    size = len(table)
    product = np.zeros((size + 1, size + 1))
    product[:size, 1:] = table / 2
    product[:size, : size - 1] += table[:, 1:] / 2
    product[:size, 1] += table[:, 0] / 2
    return product


def _outline(x: np.ndarray, y: np.ndarray, smooth: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return the edge's right half from the largest to the smallest y; a smooth one refined by its Fourier series."""
    if y[0] < y[-1]:
        x, y = x[::-1], y[::-1]
    if smooth:
        x, y = _refined(x, y)
    return np.maximum(x, 0.0), np.minimum.accumulate(y)


def _whole_outline(x: np.ndarray, y: np.ndarray, smooth: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return the whole edge, once around; a smooth one at 2·OUTLINE equal steps, where its Fourier series goes on."""
    if not smooth:
        return x, y
    finer = 2 * OUTLINE
    one, two = (irfft(rfft(edge), finer) * (finer / edge.size) for edge in (x, y))
    return one, two


def _refined(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return x, odd, and y, even about both ends, at OUTLINE equal steps: their sine and cosine series go on."""
    more = (0, OUTLINE + 1 - y.size)
    sines, cosines = np.pad(dst(x[1:-1], 1), more), np.pad(dct(y, 1), more)
    cosines[y.size - 1] /= 2  # the last of a cosine series counts once, in a longer one twice
    scale = 1 / (2 * (y.size - 1))
    return np.concatenate([[0.0], dst(sines, 1) * scale, [0.0]]), dct(cosines, 1) * scale
