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
from functools import cached_property, lru_cache
from math import hypot, inf, nan, sqrt

import numpy as np
from numpy.fft import irfft, rfft
from numpy.polynomial.chebyshev import chebder, chebvander

from p2sf.conventions import write_protect
from p2sf.disc.domain import HALF, WHOLE, ClearNodes, PupilDomain
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.disc.open_part import WHOLE_DISC, OpenPart
from p2sf.errors import GeometryError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import wavefront
from p2sf.pupil.clear_curves import clear_curve
from p2sf.pupil.fit import FittedPencil
from p2sf.pupil.landing import Landing, landing
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.smooth_pupil import all_reach
from p2sf.pupil.spherical_waves import beyond_plane_waves
from p2sf.pupil.vignetting import open_part, whole_nodes
from p2sf.raytrace.exit_sphere import ExitSphere
from p2sf.raytrace.pencil import hexapolar, pencil
from p2sf.raytrace.ray_field import COLLIMATED, ONE_DIRECTION

# RMS error of phase and density from which a higher order is tried: the transfer function's is at most 2π√2 times it.
RESIDUAL_WAVES = 5e-5
MOST_RESIDUAL = 2e-3  # and above which no polynomial describes the pupil
JUDGED_AT = 18  # the order from which on a fold that the one before sees too is no error of either
HOPELESS = 0.1  # waves at that order, which the highest does not bring down to MOST_RESIDUAL
REACH_RINGS = 8  # of rays that show how much of the pupil reaches the sensor
LEAST_REACHING = 0.05
RIM = 64  # intervals of half the rim that are traced
OUTLINE = 4096  # intervals of the edge: chords between them depart from it by 3e-7 of the radius
CENTROID_CELLS = 256  # along each side, for the centroid of the light that a mask lets through: 1e-3 of its radius
PROBE = 33  # points along each axis where slopes are looked for

FOLDS = (
    "rays of different parts of the pupil arrive in one direction, and the sum of their light has no limit; "
    "stop the lens down or reduce the field"
)
UNFOLLOWED = "no polynomial fits the rays of this pupil; stop the lens down or reduce the field"


@dataclass(frozen=True)
class RayCounts:
    """How many radii × directions of rays carry polynomials of an order."""

    order: int
    radii: int
    directions: int

    @property
    def counts(self) -> tuple[int, int]:
        """Return the radii and the directions around the whole disc."""
        return self.radii, 2 * self.directions


ORDERS = (
    RayCounts(8, 10, 16),
    RayCounts(10, 10, 16),
    RayCounts(14, 14, 24),
    RayCounts(18, 14, 24),
    RayCounts(24, 20, 36),
    RayCounts(32, 28, 48),
    RayCounts(44, 40, 70),
)
FINER = 2  # times as many radii and directions where rays are lost: those that graze a surface spread twentyfold
STOP_ORDERS = 4  # more over the stop, which the same rays carry
MOST_KEPT_ORDER = 28  # of the polynomials over the stop that are kept: 10 MB
EXACT = RayCounts(4, 6, 10)  # the six coefficients are a polynomial of fourth order
Orders = tuple[RayCounts, ...]
Data = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""At points of the stop the weight of the field, NaN where no ray arrives, phase in waves, fx and fy."""
DataAt = Callable[[np.ndarray, np.ndarray], Data]


@dataclass(frozen=True, eq=False)
class PupilSamples:
    """Rays over the whole pupil, (nodes,): the last ``rim`` of them once around its edge.

    ``traced``: how many of them were; of a symmetric pupil the others mirror these.
    ``share``: the area that each stands for, 0 on the edge; ``weight``: of its field; phase in waves, fx and fy in
    cycles per µm. ``domain``: HALF where rays at −ξ mirror those at ξ. ``disc``: the counts of nodes over the whole
    disc; None where the pupil ends elsewhere.
    """

    xi: np.ndarray
    eta: np.ndarray
    share: np.ndarray
    weight: np.ndarray
    phase: np.ndarray
    fx: np.ndarray
    fy: np.ndarray
    rim: int
    domain: PupilDomain
    disc: tuple[int, int] | None
    traced: int

    @property
    def edge(self) -> tuple[np.ndarray, np.ndarray]:
        """Return fx and fy once around the edge, of the whole disc at OUTLINE steps, by its Fourier series."""
        edge = self.fx[-self.rim :], self.fy[-self.rim :]
        if self.disc is None:
            return edge
        x, y = (irfft(rfft(one), OUTLINE) * (OUTLINE / one.size) for one in edge)
        return x, y


@dataclass(frozen=True)
class RayMoments:
    """Where the light of rays lands on the mean, and its RMS distance from there, µm from the chief ray."""

    x_um: float = 0.0
    y_um: float = 0.0
    rms_um: float = 0.0


ONE_POINT = RayMoments()


@dataclass(frozen=True, eq=False)
class FrequencyPupil:
    """The pupil over spatial frequencies (fx, fy).

    Attributes
    ----------
    half_x, half_y, middle_y : float
        The box around the pupil: |fx| ≤ half_x, |fy − middle_y| ≤ half_y, cycles per µm.
    phase, density : numpy.ndarray
        Coefficients of T_b(y)·T_a(x), (order + 1, order + 1), in the box's own coordinates; phase in waves, the density
        positive and up to a factor.
    edge : numpy.ndarray
        The edge, once around, (2, points), in the box's coordinates.
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
    domain : PupilDomain
        HALF where fx and −fx are alike, the mask included, so that sums take half of the lines.
    centroid_x_um : float
        The light's centroid along x.
    edges : OpenPart
        Where rims and holes end the pupil over the stop; ``edge`` is that rim in the box.
    """

    half_x: float
    half_y: float
    middle_y: float
    phase: np.ndarray
    density: np.ndarray
    edge: np.ndarray
    centroid_um: float
    spot: RayMoments
    residual_waves: float
    rays: int
    mask: PupilMask = CLEAR
    wavelength_um: float = nan
    xi: np.ndarray = field(default_factory=lambda: np.array([[0.0, 1.0], [0.0, 0.0]]))
    eta: np.ndarray = field(default_factory=lambda: np.array([[0.0, 0.0], [1.0, 0.0]]))
    domain: PupilDomain = HALF
    centroid_x_um: float = 0.0
    edges: OpenPart = WHOLE_DISC

    @property
    def plain(self) -> bool:
        """Return whether all within its edge is open, and lets light through alike."""
        return self.mask.clear and not self.edges.shadows

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
        """Return the pupil with x and y exchanged; the middle of its box is left out."""
        return replace(
            self,
            half_x=self.half_y,
            half_y=self.half_x,
            phase=self.phase.T,
            density=self.density.T,
            edge=self.edge[::-1],
            xi=self.xi.T,
            eta=self.eta.T,
            centroid_um=self.centroid_x_um,
            centroid_x_um=self.centroid_um,
            domain=WHOLE,
        )

    def columns(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the lower and the upper end of the column at each x of the box; one point beside the pupil."""
        one, two = (np.interp(x, *side) for side in self._sides)
        return np.minimum(one, two), np.maximum(one, two)

    @cached_property
    def _sides(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the edge from its smallest x to its largest, there and back, each (2, points) with ascending x."""
        closed = np.concatenate([self.edge, self.edge], axis=1)
        first, size = int(self.edge[0].argmin()), self.edge.shape[1]
        farthest = first + int(closed[0, first : first + size].argmax())
        there, back = closed[:, first : farthest + 1].copy(), closed[:, first + size : farthest - 1 : -1].copy()
        for side in (there, back):
            np.maximum.accumulate(side[0], out=side[0])
        return there, back

    def on_grid(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return phase and density at the points (y, x) of a grid in the box's coordinates."""
        return _on_grid(self.phase, x, y), _on_grid(self.density, x, y)

    def stop_on_grid(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return ξ and η at the points (y, x) of a grid in the box's coordinates."""
        return _on_grid(self.xi, x, y), _on_grid(self.eta, x, y)


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
    x, y = np.linspace(-1, 1, 2 * PROBE - 1), np.cos(np.linspace(0, np.pi, PROBE))
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
    return write_protect(chebder(np.eye(order + 1)))


def uniform_disc(half: float = 1.0) -> FrequencyPupil:
    """Return the pupil of a perfect lens whose cut-off is 2·half cycles per µm."""
    angle = np.arange(OUTLINE) * (2 * np.pi / OUTLINE)
    edge = np.stack([np.sin(angle), np.cos(angle)])
    return FrequencyPupil(half, half, 0.0, np.zeros((2, 2)), np.ones((1, 1)), edge, 0.0, ONE_POINT, 0.0, 0)


def pupil_of_rays(
    lens: Lens, source: Source, clip: bool = False, turn_deg: float = 0.0, sphere: ExitSphere | None = None
) -> FrequencyPupil:
    """Return the pupil of exact rays; where rims clip or rays are lost, it ends there.

    ``sphere``: from which they send spherical waves; it has the plane waves that agree with these to second order, and
    counts what is left among its ``residual_waves``.

    ``turn_deg``: by how much its axes are turned from those of the source's image, from +y towards +x.
    Raises GeometryError where the chief ray does not reach the sensor, or no polynomial describes the pupil, as where
    rays of different parts of it arrive in one direction.
    """
    whole = not clip and all_reach(lens, source)
    if not (whole or clip):
        _check_reach(lens, source)
    end = PupilEnd(lens.pupil_domain) if whole else PupilAtRims(lens, source, clip)

    def trace_rays(xi: np.ndarray, eta: np.ndarray) -> Data:
        rays = pencil(lens, source, xi, eta)
        if whole and not rays.passed.all():
            raise GeometryError(UNFOLLOWED)
        # Where light is lost, an outline by directions misses a few rays.
        passed, seen = rays.passed, rays if sphere is None else sphere.seen_from(rays)[0]
        return np.where(passed, rays.amplitude, np.nan), seen.phase, seen.fx, seen.fy

    found = _settle(end, turn_deg, trace_rays)
    if sphere:
        found = replace(found, residual_waves=hypot(found.residual_waves, beyond_plane_waves(lens, source, sphere)))
    found = behind_mask(found, mask_seen(lens, source), float(source.wavelength_um))
    return with_spot(found, lens, source, clip, turn_deg)


class PupilEnd:
    """Where a pupil ends: at the rim of the disc."""

    edges = WHOLE_DISC

    def __init__(self, domain: PupilDomain = HALF):
        self.domain = domain

    def columns(self, counts: tuple[int, int], domain: PupilDomain) -> tuple[np.ndarray, int]:
        """Return ξ, η and shares of the area of nodes over a domain, and on the edge, and how many these are."""
        return _over_disc(counts, domain)

    def disc(self, counts: tuple[int, int]) -> tuple[int, int] | None:
        """Return the counts of nodes over the whole disc; None of other pupils."""
        return counts


class PupilAtRims(PupilEnd):
    """Where the pupil of a lens ends at rims and holes, with ``clip``, or where rays are lost."""

    def __init__(self, lens: Lens, source: Source, clip: bool):
        super().__init__(lens.pupil_domain)
        self.edges = open_part(lens, source, clip)
        self._rim, self._finer = clear_curve(lens, source, clip), 1 if all_reach(lens, source) else FINER

    def columns(self, counts: tuple[int, int], domain: PupilDomain) -> tuple[np.ndarray, int]:
        """Return the same of the clear part without its holes."""
        finer = self._finer * counts[0], self._finer * counts[1]
        return _with_edge(self._rim.nodes(finer), self._rim.points(OUTLINE // 8, domain), domain)

    def disc(self, counts: tuple[int, int]) -> None:
        """Return that these are not over the whole disc."""


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
    x, y = rotate_frequencies(*found.centroid_um, turn_deg)
    return RayMoments(float(x), float(y), float(np.hypot(*found.rms_um)))


def rotate_frequencies(fx: np.ndarray, fy: np.ndarray, turn_deg: float) -> tuple[np.ndarray, np.ndarray]:
    """Return frequencies along axes that are turned from +y towards +x."""
    if not turn_deg:
        return fx, fy
    sine, cosine = np.sin(np.deg2rad(turn_deg)), np.cos(np.deg2rad(turn_deg))
    return cosine * fx - sine * fy, sine * fx + cosine * fy


def pupil_of_fit(found: FittedPencil, turn_deg: float = 0.0, end: PupilEnd | None = None) -> FrequencyPupil:
    """Return the pupil that a fit describes, axes as `pupil_of_rays`. Raises GeometryError where its map folds."""

    def evaluate_fit(xi: np.ndarray, eta: np.ndarray) -> Data:
        phase, fx, fy, weight = found.function.at(xi, eta)
        return weight, phase, fx, fy

    known = _settle(end or PupilEnd(found.level.basis.domain), turn_deg, evaluate_fit)
    known = replace(known, rays=found.rays, residual_waves=hypot(known.residual_waves, found.error_waves))
    return behind_mask(known, found.mask, found.wavelength_um)


def pupil_of_coefficients(
    six: Coefficients, mask: PupilMask = CLEAR, turn_deg: float = 0.0, end: PupilEnd | None = None
) -> FrequencyPupil:
    """Return the pupil of the six coefficients: the unit circle, frequencies −n'u'(ξ, η)/λ, uniform density.

    ``mask``: what else stands in it, as the source sees it. W counts the other way round than the mask's path.
    """
    scale = -float(six.reduced_slope) / float(six.wavelength_um)

    def evaluate_six(xi: np.ndarray, eta: np.ndarray) -> Data:
        return np.ones(xi.size), np.asarray(wavefront(six, xi, eta)), scale * xi, scale * eta

    found = replace(_settle(end or PupilEnd(), turn_deg, evaluate_six, (EXACT,)), rays=2)
    return behind_mask(found, mask, -float(six.wavelength_um))


@lru_cache(maxsize=16)
def _over_disc(counts: tuple[int, int], domain: PupilDomain) -> tuple[np.ndarray, int]:
    """Return ξ, η and shares of the area of nodes over the disc or its half, and on its rim, and how many these are."""
    angle = domain.edge_directions((0.0, domain.turn), RIM)
    columns, rim = _with_edge(whole_nodes(counts), (np.sin(angle), np.cos(angle)), domain)
    return write_protect(columns), rim


def _with_edge(inside: ClearNodes, edge: tuple[np.ndarray, np.ndarray], domain: PupilDomain) -> tuple[np.ndarray, int]:
    """Return ξ, η and shares of the area of nodes and behind them of points on the edge, and how many these are."""
    nodes = domain.over(inside).with_points(*edge)
    return np.stack([nodes.xi, nodes.eta, nodes.weight]), edge[0].size


def _trace(
    end: PupilEnd,
    domain: PupilDomain,
    turn_deg: float,
    data_at: DataAt,
    counts: tuple[int, int],
) -> PupilSamples:
    """Return the rays that arrive of those through nodes and the edge of a pupil, in turned axes."""
    columns, rim = end.columns(counts, domain)
    weight, phase, fx, fy = data_at(*columns[:2])
    passed = np.isfinite(weight)
    table = np.stack([*columns, weight, phase, *rotate_frequencies(fx, fy, turn_deg)])[:, passed]
    return _samples(table, int(passed[-rim:].sum()), domain, end.disc(counts))


def _samples(table: np.ndarray, rim: int, domain: PupilDomain, disc: tuple[int, int] | None) -> PupilSamples:
    """Return samples of (ξ, η, share, weight, phase, fx, fy), given over a domain."""
    inside, edge = [table[:, :-rim]], [table[:, -rim:]]
    for side in domain.images[1:]:
        image = table * np.array([side, 1, 1, 1, 1, side, 1])[:, None]
        inside.append(image[:, :-rim])
        edge.append(image[:, -2:-rim:-1])
    xi, eta, share, weight, phase, fx, fy = np.concatenate([*inside, *edge], axis=1)
    rim = sum(part.shape[1] for part in edge)
    return PupilSamples(xi, eta, share, weight, phase, fx, fy, rim, domain, disc, table.shape[1])


def behind_mask(pupil: FrequencyPupil, mask: PupilMask, wavelength_um: float) -> FrequencyPupil:
    """Return the pupil behind a mask: centroid and RMS distance are those of the light that passes."""
    if mask.clear and pupil.plain:
        return pupil
    pupil = replace(pupil, domain=pupil.domain.behind(mask.domain), mask=mask, wavelength_um=wavelength_um)
    axis = (np.arange(CENTROID_CELLS) + 0.5) * (2 / CENTROID_CELLS) - 1
    xi, eta = pupil.stop_on_grid(axis, axis)
    low, high = pupil.columns(axis)  # beyond the edge its polynomials are of no use
    inside = (
        pupil.edges.behind(mask).opens(xi, eta)
        & (xi * xi + eta * eta <= 1)
        & (axis[:, None] >= low)
        & (axis[:, None] <= high)
    )
    phase, density = pupil.on_grid(axis, axis)
    if mask.phased:
        phase = phase + np.where(inside, mask.path_um(xi * inside, eta * inside), 0.0) / wavelength_um
    slope_y, slope_x = np.gradient(phase, axis[1] - axis[0])
    # Differences across an edge of a phase that ends there are none.
    whole = inside if not mask.phased else inside & ~_beside(~inside)
    # Of rays the density is the light, of waves the amplitude.
    light = np.where(whole, density * np.square(mask.amplitude(xi * inside, eta * inside)), 0.0)
    landing_x, landing_y = -slope_x / pupil.half_x, -slope_y / pupil.half_y
    spot, waves = (_moments(landing_x, landing_y, part, pupil.domain) for part in (light, light * density))
    return replace(pupil, centroid_um=waves.y_um, centroid_x_um=waves.x_um, spot=spot)


def _moments(x: np.ndarray, y: np.ndarray, light: np.ndarray, domain: PupilDomain) -> RayMoments:
    """Return the moments of light that lands at x and y, from a pupil of this domain."""
    x, y, share = x.ravel(), y.ravel(), light.ravel() / light.sum()
    aside, centre = float(domain.mean_across(share, x)), float(share @ y)
    square = float((share * ((x - aside) ** 2 + (y - centre) ** 2)).sum())
    return RayMoments(aside, centre, float(np.sqrt(square)))


def _beside(cells: np.ndarray) -> np.ndarray:
    """Return the cells that have one of these beside them."""
    beside: np.ndarray = np.logical_or.reduce([np.roll(cells, s, axis) for axis in (0, 1) for s in (-1, 1)])
    return beside


def _settle(end: PupilEnd, turn_deg: float, data_at: DataAt, orders: Orders = ORDERS) -> FrequencyPupil:
    """Return the pupil through rays, in turned axes, of the first order whose residual is small enough."""
    domain, counts, traced, before = end.domain.turned(turn_deg), (0, 0), 0, 0.0
    for sampling in orders:
        if counts != sampling.counts:
            nodes, counts = _trace(end, domain, turn_deg, data_at, sampling.counts), sampling.counts
            traced += nodes.traced
        found = _through(nodes, sampling.order)
        judged = sampling.order >= JUDGED_AT + (nodes.disc is None)  # beside lost rays one order later
        hopeless = judged and min(before, found.residual_waves) > HOPELESS
        if hopeless or found.residual_waves < RESIDUAL_WAVES:
            break
        before = found.residual_waves
    if found.residual_waves == inf:
        raise GeometryError(FOLDS)
    if not found.residual_waves < MOST_RESIDUAL:
        raise GeometryError(UNFOLLOWED)
    return replace(found, rays=traced, edges=end.edges)


def _through(nodes: PupilSamples, order: int) -> FrequencyPupil:
    """Return the polynomials through nodes by least squares, and what else follows from the rays."""
    edge = np.stack(nodes.edge)
    low, high = edge.min(1), edge.max(1)
    half_x, half_y = half = (high - low) / 2
    if half.min() <= ONE_DIRECTION:
        raise GeometryError(COLLIMATED)
    middle = (high + low) / 2
    (centre_x, centre_y), share = middle, nodes.share
    x, y = (nodes.fx - centre_x) / half_x, (nodes.fy - centre_y) / half_y
    least = LeastSquares(order, x, y, share, nodes.domain)
    phase = least.solve(nodes.phase)
    miss = least.values(phase) - nodes.phase
    area = _stop_area(nodes, least, x, y)
    true = nodes.weight * np.abs(area)
    density = least.solve(true)
    light = share * nodes.weight
    landing_x, landing_y = (-slope / size for slope, size in zip(least.slopes(phase), half, strict=True))
    # Of rays weight·dξdη is the light, of waves D²df = D·weight·dξdη.
    spot, waves = (_moments(landing_x, landing_y, part, nodes.domain) for part in (light, light * true))
    thin = light * true @ (least.values(density) / true - 1) ** 2 / (light @ true)
    # An error of the amplitude changes the field as a phase of 1/2π of it does.
    residual = float(np.sqrt((share @ miss**2 / share.sum() + thin / (2 * np.pi) ** 2) / least.freedom))
    return FrequencyPupil(
        float(half_x),
        float(half_y),
        float(centre_y),
        phase,
        density,
        (edge - middle[:, None]) / half[:, None],
        waves.y_um,
        spot,
        residual if area.min() * area.max() > 0 else inf,
        0,
        xi=least.solve_across(nodes.xi),
        eta=least.solve(nodes.eta),
        domain=nodes.domain,
        centroid_x_um=waves.x_um,
    )


def _stop_area(nodes: PupilSamples, over_frequency: "LeastSquares", x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return ∂(ξ, η)/∂(x, y) at nodes by polynomials of x and y over the stop, or of ξ and η over the box.

    Those that pass closer to the rays: where rays crowd, as near a fold, the former are smooth and the latter like a
    root; next to rays that are lost since they graze a surface it is the other way round.
    """
    over_stop = _over_stop(nodes, over_frequency.order + STOP_ORDERS)
    if over_frequency.miss(nodes.xi, nodes.eta) < over_stop.miss(x, y):
        return over_frequency.area(nodes.xi, nodes.eta)
    return 1 / over_stop.area(x, y)


class LeastSquares:
    """Polynomials T_a(x)·T_b(y), a + b ≤ order, through values at points of the box, by one QR.

    Of points that x = 0 mirrors it is that of half the points and of even a.
    """

    def __init__(self, order: int, x: np.ndarray, y: np.ndarray, share: np.ndarray, domain: PupilDomain):
        self._x, self.order, self._domain, self._share = x, order, domain, share / share.sum()
        every = range(0, order + 1, len(domain.images))
        self._at = np.array([(b, a) for a in every for b in range(order + 1 - a)]).T
        self._across, self._along = chebvander(x, order + 1), chebvander(y, order + 1)
        self._used = domain.holds(x)
        design = self._along[self._used][:, self._at[0]] * self._across[self._used][:, self._at[1]]
        self._root = np.sqrt(share + share[share > 0].min())  # the edge counts too, where polynomials deviate first
        self._factor, self._upper = np.linalg.qr(design * self._root[self._used, None])
        self.freedom = max(1 - design.shape[1] / design.shape[0], 1e-3)

    def solve(self, values: np.ndarray) -> np.ndarray:
        """Return the coefficients, (order + 1, order + 1) for (b, a), of what x = 0 mirrors alike."""
        table = np.zeros((self.order + 1, self.order + 1))
        table[tuple(self._at)] = np.linalg.solve(self._upper, self._factor.T @ (values * self._root)[self._used])
        return table

    def solve_across(self, values: np.ndarray) -> np.ndarray:
        """Return the coefficients, up to (order + 2, order + 2), of what changes its sign between mirrored points."""
        if not self._domain.symmetric:
            return self.solve(values)
        # Over x it is even.
        return _times_x(self.solve(np.divide(values, self._x, out=np.zeros_like(values), where=self._used)))

    def values(self, table: np.ndarray) -> np.ndarray:
        """Return the polynomial at the points."""
        return self._sum(table)

    def slopes(self, table: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return ∂/∂x and ∂/∂y of the polynomial at the points."""
        by_x, by_y = _derivatives(table)
        return self._sum(by_x), self._sum(by_y)

    def _sum(self, table: np.ndarray) -> np.ndarray:
        rows, columns = table.shape
        found: np.ndarray = np.einsum("na,na->n", self._along[:, :rows] @ table, self._across[:, :columns])
        return found

    def miss(self, across: np.ndarray, along: np.ndarray) -> float:
        """Return the RMS error, corrected for the degrees of freedom, of two functions as `area` has them."""
        off = self.values(self.solve_across(across)) - across, self.values(self.solve(along)) - along
        return float(np.sqrt(self._share @ (off[0] ** 2 + off[1] ** 2) / self.freedom))

    def area(self, across: np.ndarray, along: np.ndarray) -> np.ndarray:
        """Return ∂(across, along)/∂(x, y) at the points, of two functions of them, as `solve_across` and `solve`."""
        (stretch_x, stretch_y), (up_x, up_y) = self.slopes(self.solve_across(across)), self.slopes(self.solve(along))
        area: np.ndarray = stretch_x * up_y - stretch_y * up_x
        return area


def _over_stop(nodes: PupilSamples, order: int) -> LeastSquares:
    """Return polynomials over the stop, where ∂(x, y)/∂(ξ, η) is smooth however rays crowd."""
    if nodes.disc is None:
        return LeastSquares(order, nodes.xi, nodes.eta, nodes.share, nodes.domain)
    return (_over_whole_stop if order <= MOST_KEPT_ORDER else _over_whole_stop.__wrapped__)(
        nodes.disc, nodes.domain, order
    )


@lru_cache(maxsize=8)
def _over_whole_stop(counts: tuple[int, int], domain: PupilDomain, order: int) -> LeastSquares:
    """Return the same of rays over the whole disc, whatever the source and the wavelength."""
    columns, rim = _over_disc(counts, domain)
    nodes = _samples(np.stack([*columns, *columns, columns[0]]), rim, domain, counts)
    return LeastSquares(order, nodes.xi, nodes.eta, nodes.share, domain)


def _times_x(table: np.ndarray) -> np.ndarray:
    """Return the coefficients of x·Σ table[b, a]·T_b(y)·T_a(x): x·T_a = (T_a₊₁ + T_|a₋₁|)/2."""
    size = len(table)
    product = np.zeros((size + 1, size + 1))
    product[:size, 1:] = table / 2
    product[:size, : size - 1] += table[:, 1:] / 2
    product[:size, 1] += table[:, 0] / 2
    return product
