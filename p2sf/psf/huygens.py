"""The `huygens` method, the reference: each traced ray is a plane wave at the sensor, and all are summed directly.

The nodes are Gauss–Legendre radii times uniform directions, so that no pixelated edge slows the convergence; their
count rises until two successive PSFs agree. Clear apertures (`vignetting`) end each radius at the rim it meets.

See handbook 5.5.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from math import inf, sqrt
from time import perf_counter
from typing import Any

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.disc.domain import ClearNodes
from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.errors import Cancelled, GeometryError, SamplingError
from p2sf.figures.compare import r_squared
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.peak import peak_of
from p2sf.psf.picture import Window, psf_of_intensity, resolved
from p2sf.psf.prediction import CAUTION, EDGE_ERROR, TRACED_ERROR
from p2sf.psf.result import Psf
from p2sf.pupil.cost import LAST_PASS, RAY_SECONDS
from p2sf.pupil.fit import FittedPencil
from p2sf.pupil.plane_waves import Counts, Waves, counts_for, disc_words, pupil_amplitude, window_reach_um
from p2sf.pupil.seen_mask import with_slopes
from p2sf.pupil.smooth_pupil import (
    PROBE,
    RayWaves,
    all_reach,
    coarse_pencil,
    coarse_points,
    coarse_slopes,
    interpolated_waves,
)
from p2sf.pupil.spherical_waves import SphericalWaves, waves_from
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.raytrace.exit_sphere import ExitSphere
from p2sf.raytrace.pencil import Rays, pencil, rays_through
from p2sf.raytrace.ray_field import MapSlopes, Steepness, steepness
from p2sf.threads import for_each, one_blas_thread

BLUR_NODES = 16, 40  # carry weight and area of rays, which are smooth
STEP = 1e-4  # of the pupil's radius, for differences: errors of 1e-8, of aiming 1e-6
BLOCK = 8192  # rays traced at a time: few enough for a second-level cache and to check for cancellation every few ms
GROWTH = 1.3
MOST_NODES = 2**22
OF_FIELD = 3.0  # times what is left of a field, of its intensity: twice that, and more where the pivots of QR are rough
FRINGES_OF_SPHERES = 1.05  # finer than those of rays are beyond a focus; so near their end contrast is next to none
MOST_FOR_PEAK = 2**17  # for the peak alone, which is otherwise sought only in the window


@dataclass(frozen=True, eq=False)
class RayPupil:
    """The rays of a source that are summed as plane waves, and what each is given.

    ``clip``: whether rims end them. ``areas``: the fit that gives areas over direction cosines, for the `radiometric`
    amplitude: each ray has the root of its cell's area in the entrance pupil times that over direction cosines, which
    conserves the energy of each cell. Without it a ray has the field of its cell's area, as in other programs.
    ``sphere``: from which rays send spherical waves; without it they are plane waves. ``method``: what sums them.
    """

    lens: Lens
    source: Source
    clip: bool = False
    areas: FittedPencil | None = None
    sphere: ExitSphere | None = None
    method: str = "huygens"

    @property
    def whole(self) -> bool:
        """Return whether they fill the pupil and are given its area."""
        return not self.clip and self.areas is None

    def first_counts(self, window: Window) -> Counts:
        """Return the node counts to begin with."""
        return first_counts(self.lens, self.source, window_reach_um(*window), self.clip, MOST_NODES, self.sphere)

    def nodes(self, counts: Counts) -> ClearNodes:
        """Return nodes up to where rays end: at the pupil's rim, at clear apertures, or where they miss a surface."""
        return _nodes_of(self.lens, self.source, counts, self.clip)

    def fields(self, rays: Rays) -> np.ndarray:
        """Return the field of each ray."""
        light = rays.amplitude if self.areas is None else rays.radiometric(self.areas.jacobian(rays.xi, rays.eta))
        return rays.share * light


def huygens_psf(
    lens: Lens,
    source: Source,
    pixels: int,
    pixel_um: float,
    rtol: float | None = SETTLED_TOLERANCE,
    clip: bool = False,
    watch: "Watch | None" = None,
) -> Psf:
    """Return the reference PSF, as `sum_rays` makes it of all rays of a source."""
    return sum_rays(RayPupil(lens, source, clip), (pixels, pixel_um), rtol, watch)


@one_blas_thread
def sum_rays(
    pupil: RayPupil,
    window: Window,
    rtol: float | None = SETTLED_TOLERANCE,
    watch: "Watch | None" = None,
    quality: str = "settled",
) -> Psf:
    """Return the PSF of a pupil's rays, their count raised until two successive ones agree to ``rtol``.

    The agreement reached (relative L2 in the window) is reported as the PSF's ``error``, also where more nodes than
    are allowed would be needed; ``sampling`` says so. ``rtol=None`` sums once, in float32, as many rays as
    the blur needs, for a preview of no guaranteed accuracy. ``quality``: of the search for the peak (`peak_of`).
    Threads (`p2sf.threads`) share the rays, and the sum does not depend on their number. Raises GeometryError where the
    chief ray, or every ray, fails; where other rays fail, the pupil ends there, and the radiometric amplitude is
    refused. `Cancelled` where the watch says so.
    """
    started, watch = perf_counter(), watch or Watch()
    agreed: Message | None
    if rtol is None:
        found, intensity, own, error = _sum_once(pupil, window, watch, quality)
        rays = found.traced
        single, double = Message("one pass in float32"), Message("one pass in float64")
        agreed = double if intensity.dtype == np.float64 else single
    else:
        found, intensity, own, rays = _settle(pupil, window, rtol, watch)
        error = own**2
        agreed = None if own <= rtol else Message("not converged: agrees to {reached:.1e} only", reached=own)
    own, error = _with_waves_error(own, error, found.waves, intensity, centred_axis(*window))
    finest = found.waves.spread / (1 if pupil.sphere is None else FRINGES_OF_SPHERES)
    light = partial(blur_um2, pupil) if resolved(finest, window[1]) else None
    peak = partial(peak_of, intensity, window[1], found.waves, partial(waves_reaching, pupil), quality)
    psf = psf_of_intensity(intensity, window[1], pupil.source.wavelength_um, pupil.method, light, peak)
    return replace(
        psf.with_figures(predicted_error=error),
        rays=rays,
        sampling=sampling_of(pupil, found, agreed),
        error=own,
        seconds=perf_counter() - started,
    )


def _sum_once(
    pupil: RayPupil, window: Window, watch: "Watch", quality: str
) -> tuple[RayWaves, np.ndarray, float | None, float]:
    """Return (waves, their intensity, its relative L2 error if promised, predicted 1 − R²) of one pass."""
    found, axis = one_pass(pupil, window, watch), centred_axis(*window)
    double = bool(pupil.sphere) and quality == "settled"
    intensity = found.waves.intensity(axis, axis, np.float64 if double else np.float32)
    whole = TRACED_ERROR if pupil.sphere else SETTLED_TOLERANCE**2
    error = EDGE_ERROR if pupil.clip or not all_reach(pupil.lens, pupil.source) else whole
    return found, intensity, SETTLED_TOLERANCE if double else None, error


def _with_waves_error(
    own: float | None, error: float, waves: Waves, intensity: np.ndarray, axis: np.ndarray
) -> tuple[float | None, float]:
    """Return relative L2 and 1 − R² of a sum with what spherical waves left out of it, and scalar waves leave open.

    Kirchhoff's integral with and without its obliquity, the cosine of the angle to the chief ray, differ by more than
    other errors where the window is as wide as the pupil is far.
    """
    if not isinstance(waves, SphericalWaves):
        return own, error
    missed = OF_FIELD * (waves.skeleton(axis, axis, intensity.dtype).missed or 0.0)
    other = intensity * waves.obliquity(axis, axis) ** 2
    oblique = max(0.0, *(1 - r_squared(*pair) for pair in ((intensity, other), (other, intensity))))
    if own is not None:
        own = float(np.hypot(own, missed + np.sqrt(oblique) * (oblique > CAUTION)))
    return own, error + missed**2 + oblique


def blur_um2(pupil: RayPupil) -> float | None:
    """Return ∫|field|²dx over the plane in µm² at unit unaberrated peak; None where no area of the rays gives it.

    By Parseval: the energy of unit area of the pupil spreads over |∂f/∂(ξ, η)|, a difference of rays beside each node.
    Where that changes its sign, rays from different parts of the pupil arrive in one direction, and their fields add.
    """
    nodes = pupil.nodes(BLUR_NODES)
    beside = STEP * np.array([[0, 1, -1, 0, 0], [0, 0, 0, 1, -1]])
    xi, eta = (np.add.outer(step, at).ravel() for step, at in zip(beside, (nodes.xi, nodes.eta), strict=True))
    rays = pencil(pupil.lens, pupil.source, xi, eta)
    if not rays.passed.all():
        return None
    seen = rays if pupil.sphere is None else pupil.sphere.seen_from(rays)[0]
    (_, *fx), (_, *fy) = (f.reshape(5, -1) for f in (seen.fx, seen.fy))
    area = ((fx[0] - fx[1]) * (fy[2] - fy[3]) - (fx[2] - fx[3]) * (fy[0] - fy[1])) / (2 * STEP) ** 2
    if not area.min() * area.max() > 0:
        return None
    own = rays.part(slice(nodes.xi.size))
    field = pupil.fields(replace(own, share=nodes.weight, mask=nodes.amplitude)) / nodes.weight
    field /= nodes.weight @ field
    return float(nodes.weight @ (field * field / np.abs(area)) / (np.pi * nodes.share))


def waves_reaching(pupil: RayPupil, reach_um: float) -> Waves | None:
    """Return the plane waves of rays that carry the phase up to a distance from the chief ray; None of too many."""
    try:
        counts = first_counts(pupil.lens, pupil.source, reach_um, pupil.clip, MOST_NODES, pupil.sphere)
    except SamplingError:
        return None
    if _nodes(counts) > MOST_FOR_PEAK:
        return None
    if pupil.whole:
        found = interpolated_waves(pupil.lens, pupil.source, counts, reach_um, pupil.sphere)
        if found is not None:
            return found.waves
    return ray_waves(pupil, counts, reach_um).waves


def one_pass(pupil: RayPupil, window: Window, watch: "Watch | None" = None) -> RayWaves:
    """Return the waves of as many rays as the blur and the window need; `Cancelled` where the watch says so."""
    return waves_through(pupil, pupil.first_counts(window), window_reach_um(*window), watch)


def waves_through(pupil: RayPupil, counts: Counts, reach_um: float, watch: "Watch | None" = None) -> RayWaves:
    """Return the waves of rays through nodes; spherical ones are interpolated where the pupil is smooth."""
    smooth = None
    if pupil.sphere and pupil.whole:
        smooth = interpolated_waves(pupil.lens, pupil.source, counts, reach_um, pupil.sphere)
    found = smooth or ray_waves(pupil, counts, reach_um, watch)
    if watch and isinstance(found.waves, SphericalWaves):
        return replace(found, waves=replace(found.waves, **watch.limits))
    return found


def _settle(pupil: RayPupil, window: Window, rtol: float, watch: "Watch") -> tuple[RayWaves, np.ndarray, float, int]:
    """Return (plane waves, their intensity, agreement, rays traced) once two successive node counts agree."""
    axis, reach = centred_axis(*window), window_reach_um(*window)
    counts = _affordable(pupil.first_counts(window), watch.most)
    watch.expect(_nodes(counts) + _nodes(_raise_counts(counts)))
    before = waves_through(pupil, counts, reach, watch).waves.intensity(axis, axis)
    rays = _nodes(counts)
    while True:
        counts = _raise_counts(counts)
        found = waves_through(pupil, counts, reach, watch)
        after = found.waves.intensity(axis, axis)
        rays += _nodes(counts)
        reached = float(np.linalg.norm(after - before) / np.linalg.norm(after))
        if reached <= rtol or _nodes(_raise_counts(counts)) > watch.most:
            watch.finish()
            return found, after, reached, rays
        before = after
        watch.expect(_nodes(_raise_counts(counts)))


def _affordable(counts: Counts, most: int) -> Counts:
    """Return node counts of which those to compare with are not more than ``most``."""
    least = 2, 4
    while _nodes(_raise_counts(counts)) > most and counts > least:
        counts = 2 * max(1, round(counts[0] / GROWTH / 2)), 2 * max(2, round(counts[1] / GROWTH / 2))
    return counts


def _raise_counts(counts: Counts) -> Counts:
    radial, angular = (2 * round(GROWTH * count / 2) for count in counts)
    return radial, angular


def _nodes(counts: Counts) -> int:
    return counts[0] * counts[1] // 2


def first_counts(
    lens: Lens,
    source: Source,
    reach_um: float,
    clip: bool,
    most: int = MOST_NODES,
    sphere: ExitSphere | None = None,
) -> Counts:
    """Return node counts that should carry the phase of a coarse pencil up to a distance from the chief ray, µm.

    ``sphere``: from which its rays are seen. Raises GeometryError where no ray passes, SamplingError where more than
    ``most`` nodes would be needed.
    """
    steep = _steepness(lens, source, reach_um, clip, sphere)
    counts = counts_for(with_slopes(steep, lens.mask, source.wavelength_um), reach_um)
    if _nodes(counts) > most:
        raise SamplingError(
            "this blur over a window {width:.3g} µm wide needs {rays} rays; bring the sensor nearer to the image, stop "
            "down, or show a smaller window",
            width=reach_um * sqrt(2),
            rays=_nodes(counts),
        )
    return counts


def nodes_from(lens: Lens, source: Source, reach_um: float, sphere: ExitSphere | None = None) -> int:
    """Return about how many nodes the waves from a sphere, or plane ones, take, without following any rim.

    The mirror half is not counted.
    """
    rays, points = coarse_pencil(lens, source, PROBE), coarse_points(lens.pupil_domain)
    steep = _in_window(rays if sphere is None else sphere.seen_from(rays)[0], *points, reach_um)
    return _nodes(counts_for(with_slopes(steep, lens.mask, source.wavelength_um), reach_um))


def _steepness(lens: Lens, source: Source, reach_um: float, clip: bool, sphere: ExitSphere | None = None) -> Steepness:
    """Return how steep the phase is over the part of the pupil that is summed; where rays end, about its middle.

    Raises GeometryError where no ray of the coarse pencil passes.
    """
    if not coarse_pencil(lens, source, PROBE).passed.any():
        raise GeometryError("no ray but the chief ray reaches the sensor; stop the lens down or reduce the field")
    if not clip and all_reach(lens, source):
        rays = coarse_pencil(lens, source, PROBE)
        seen, slopes = rays if sphere is None else sphere.seen_from(rays)[0], coarse_slopes(lens, source, sphere)
        return _in_window(seen, *coarse_points(lens.pupil_domain), reach_um, slopes)
    nodes, rays = _outlined_pencil(lens, source, clip)
    weight = np.where(rays.passed, nodes.weight, 0.0)
    share = np.maximum(weight, 0.0) / np.maximum(weight, 0.0).sum()  # without holes, which have weights below 0
    aside, up = float(nodes.domain.mean_across(share, nodes.xi)), float(share @ nodes.eta)
    middle = pencil(lens, source, [aside], [up])
    if sphere is not None:
        rays, middle = (sphere.seen_from(some)[0] for some in (rays, middle))
    xi, eta = nodes.xi - aside, nodes.eta - up
    size = np.hypot(xi, eta)[rays.passed].max()
    return _in_window(replace(rays, chief_kx=middle.kx, chief_ky=middle.ky), xi / size, eta / size, reach_um)


@lru_cache(maxsize=4)
def _outlined_pencil(lens: Lens, source: Source, clip: bool) -> tuple[ClearNodes, Rays]:
    """Return coarse nodes up to where rays end, and their rays: a second of work where much is lost."""
    nodes = _nodes_of(lens, source, PROBE, clip)
    return nodes, rays_through(lens, source, nodes)


def _in_window(
    rays: Rays, xi: np.ndarray, eta: np.ndarray, reach_um: float, slopes: MapSlopes | None = None
) -> Steepness:
    """Return how steep the phase is so that with the reach of the window it is that at the farthest corner of each ray.

    The phase of a ray at a point X is w + f·X, with the slopes (X − x)·df where the ray lands at x (`steepness`).
    ``slopes``: of f at these rays, if known; otherwise f is taken as proportional to (ξ, η).
    """
    steep, half = steepness(rays, xi, eta), reach_um / sqrt(2)
    x, y = (np.array([[half], [half], [-half], [-half]]) - rays.x_um, np.array([[half], [-half]] * 2) - rays.y_um)
    radial = np.fmax.reduce(np.abs(x * rays.fx + y * rays.fy) / np.hypot(xi, eta), axis=None)
    angular = np.fmax.reduce(np.abs(x * rays.fy - y * rays.fx), axis=None)
    if slopes is not None:
        radial, angular = np.maximum((radial, angular), slopes.steepest(x, y))
    reach = steep.spread * reach_um
    return replace(steep, radial=float(radial) - reach, angular=float(angular) - reach)


def ray_waves(pupil: RayPupil, counts: Counts, reach_um: float, watch: "Watch | None" = None) -> RayWaves:
    """Return the waves of the rays through one set of nodes, which threads share."""
    nodes = pupil.nodes(counts)
    blocks: list[tuple[np.ndarray, ...]] = []

    def traced(some: ClearNodes) -> tuple[np.ndarray, ...]:
        rays = rays_through(pupil.lens, pupil.source, some).arrived
        field, far, length = pupil.fields(rays), np.hypot(rays.x_um, rays.y_um), 0 * rays.dx
        if pupil.sphere:
            rays, length = pupil.sphere.seen_from(rays)
        return pupil_amplitude(field, rays.phase), rays.fx, rays.fy, length, np.asarray(rays.share), field, far

    def take(block: tuple[np.ndarray, ...]) -> None:
        blocks.append(block)
        if watch:
            watch.advance(block[0].size)

    for_each(traced, (nodes.part(slice(first, first + BLOCK)) for first in range(0, nodes.xi.size, BLOCK)), take)
    amplitude, fx, fy, length, share, field, far = (np.concatenate(column) for column in zip(*blocks, strict=True))
    # The field over the area is its mean, exactly 1 for an evenly filled pupil.
    amplitude /= field.sum() / share.sum()
    waves = Waves(amplitude, fx, fy, nodes.domain, float(far.max(initial=0.0)), reach_um)
    waves = waves_from(waves, pupil.sphere, length)
    return RayWaves(waves, counts, nodes.xi.size - share.size, nodes.xi.size)


def _nodes_of(lens: Lens, source: Source, counts: Counts, clip: bool) -> ClearNodes:
    """Return nodes up to where rays end: at the pupil's rim, at clear apertures, or where they miss a surface."""
    return pupil_nodes(lens, source, counts, clip, whole=clip or all_reach(lens, source))


def sampling_of(pupil: RayPupil, found: RayWaves, convergence: Message | None) -> Message:
    """Return a description of the sum and its convergence."""
    parts = [disc_words(found.counts)]
    if pupil.clip:
        parts.append(Message("clipped by the clear semi-diameters"))
    if pupil.lens.aim == "stop":
        parts.append(Message("aimed at the real stop"))
    if found.lost:
        parts.append(Message("{lost} rays lost", lost=found.lost))
    if convergence is not None:
        parts.append(convergence)
    return Message("{parts}", parts=tuple(parts))


class Watch:
    """Reports progress and ends the work if the caller cancels it.

    ``most_seconds``: estimated ones of a sum on one core, which then takes at most ``most`` nodes in its last pass.
    ``allowed``: relative error of the field of spherical waves that may be left.
    """

    def __init__(
        self,
        progress: Callable[[float], None] | None = None,
        cancelled: Callable[[], bool] | None = None,
        most_seconds: float = inf,
        allowed: float = 0.0,
    ) -> None:
        self.progress, self.cancelled = progress, cancelled
        self.limits: dict[str, Any] = {"watch": self.look, "most_seconds": most_seconds, "allowed": allowed}
        self.most = int(min(MOST_NODES, LAST_PASS * most_seconds / RAY_SECONDS))
        self.finished, self.expected = 0, 0

    def expect(self, nodes: int) -> None:
        """Add work to come."""
        self.expected += nodes

    def advance(self, nodes: int) -> None:
        """Add work done; raise Cancelled if the caller has cancelled it."""
        self.finished += nodes
        self.look()
        if self.progress and self.expected:
            self.progress(min(self.finished / self.expected, 0.99))

    def look(self) -> None:
        """Raise Cancelled if the caller has cancelled the work."""
        if self.cancelled and self.cancelled():
            raise Cancelled("the reference was cancelled before it was done")

    def finish(self) -> None:
        """Report that all work is done."""
        if self.progress:
            self.progress(1.0)
