"""The rays of a source, traced anew at any nodes or interpolated where they are smooth (handbook 5.4, 5.5).

The nodes are Gauss–Legendre radii times uniform directions, so that no pixelated edge slows the convergence. Clear
apertures (`vignetting`) end each radius at the rim it meets.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf, prod, sqrt

import numpy as np

from p2sf.disc.domain import ClearNodes
from p2sf.errors import GeometryError, SamplingError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.pupil.fit import AMPLITUDE, MAP, FittedPencil, area_of
from p2sf.pupil.plane_waves import Counts, Waves, counts_for, pupil_amplitude
from p2sf.pupil.pupil import Pupil, PupilWaves
from p2sf.pupil.seen_mask import with_slopes
from p2sf.pupil.smooth_pupil import (
    PROBE,
    all_reach,
    coarse_pencil,
    coarse_points,
    coarse_slopes,
    interpolated_waves,
    smooth_rays,
)
from p2sf.pupil.spherical_waves import SphericalWaves, waves_from
from p2sf.pupil.vignetting import pupil_nodes
from p2sf.pupil.watch import MOST_RAYS, Watch
from p2sf.raytrace.exit_sphere import ExitSphere
from p2sf.raytrace.pencil import Rays, pencil, rays_through
from p2sf.raytrace.ray_field import MapSlopes, Steepness, steepness
from p2sf.threads import for_each

BLUR_NODES = 16, 40  # carry weight and area of rays, which are smooth
STEP = 1e-4  # of the pupil's radius, for differences: errors of 1e-8, of aiming 1e-6
BLOCK = 8192  # rays traced at a time: few enough for a second-level cache and to check for cancellation every few ms
MOST_INTERPOLATED = 2**23  # of one sum: some seconds of work


@dataclass(frozen=True, eq=False)
class RayPupil(Pupil):
    """The rays of a source that are summed as plane waves, and what each is given.

    ``clip``: whether rims end them. ``areas``: the fit that gives areas over direction cosines, for the `radiometric`
    amplitude: each ray has the root of its cell's area in the entrance pupil times that over direction cosines, which
    conserves the energy of each cell. Without it a ray has the field of its cell's area, as in other programs.
    ``sphere``: from which rays send spherical waves; without it they are plane waves. ``interpolated``: whether they
    are interpolated from some hundreds where they are smooth. ``most``: nodes of one sum; more are refused.
    """

    lens: Lens
    source: Source
    clip: bool = False
    areas: FittedPencil | None = None
    sphere: ExitSphere | None = None
    method: str = "huygens"
    interpolated: bool = False
    most: int = MOST_RAYS

    @property
    def wavelength_um(self) -> float:
        """Return the wavelength of its light, µm."""
        return float(self.source.wavelength_um)

    @property
    def edges(self) -> bool:
        """Return whether rims or lost rays end it."""
        return self.clip or not all_reach(self.lens, self.source)

    @property
    def resolved(self) -> bool:
        """Return whether one sum suffices: not along an outline, nor for the reference, which proves it."""
        return self.interpolated and not self.edges

    @property
    def remarks(self) -> tuple[Message, ...]:
        """Return that rims clip it and that rays fill the real stop, where they do."""
        clipped = (Message("clipped by the clear semi-diameters"),) if self.clip else ()
        return (*clipped, Message("aimed at the real stop")) if self.lens.aim == "stop" else clipped

    def counts(self, reach_um: float, quality: str = "settled") -> Counts:
        """Return node counts that should carry the phase of a coarse pencil up to a distance from the chief ray, µm.

        Raises GeometryError where no ray passes, SamplingError where more nodes would be needed than ``most``, or than
        rays can be traced where they are not smooth.
        """
        steep = _steepness(self.lens, self.source, reach_um, self.clip, self.sphere)
        counts = counts_for(with_slopes(steep, self.lens.mask, self.wavelength_um), reach_um)
        nodes = prod(counts) // 2
        if nodes > self.most or (nodes > MOST_RAYS and not self.smooth(reach_um)):
            raise SamplingError(
                "this blur over a window {width:.3g} µm wide needs {rays} rays; bring the sensor nearer to the image, "
                "stop down, or show a smaller window",
                width=reach_um * sqrt(2),
                rays=nodes,
            )
        return counts

    def smooth(self, reach_um: float) -> bool:
        """Return whether rays are to be interpolated and some hundreds suffice for it."""
        if not self.interpolated or self.clip or self.areas:
            return False
        return smooth_rays(self.lens, self.source, reach_um, self.sphere) is not None

    def nodes(self, counts: Counts) -> ClearNodes:
        """Return nodes up to where rays end: at the pupil's rim, at clear apertures, or where they miss a surface."""
        return _nodes_of(self.lens, self.source, counts, self.clip)

    def fields(self, rays: Rays) -> np.ndarray:
        """Return the field of each ray."""
        light = rays.amplitude if self.areas is None else rays.radiometric(self.areas.jacobian(rays.xi, rays.eta))
        return rays.share * light

    def sample(self, counts: Counts, reach_um: float = inf, watch: Watch | None = None) -> PupilWaves:
        """Return the waves of these nodes, valid up to a distance from the chief ray; `Cancelled` by the watch."""
        found = None
        if self.interpolated and not self.clip and not self.areas:
            found = interpolated_waves(self.lens, self.source, counts, reach_um, self.sphere)
        found = found or _trace(self, counts, reach_um, watch)
        if watch and isinstance(found.waves, SphericalWaves):
            return replace(found, waves=replace(found.waves, **watch.limits))
        return found

    def waves_reaching(self, reach_um: float) -> Waves | None:
        """Return `Pupil.waves_reaching`, interpolated where that is exact enough for a peak."""
        return Pupil.waves_reaching(replace(self, interpolated=True), reach_um)

    def light_um2(self) -> float | None:
        """Return ∫|field|²dx over the plane in µm² at unit unaberrated peak; None where no area of the rays gives it.

        By Parseval: the energy of unit area of the pupil spreads over |∂f/∂(ξ, η)|. Where that changes its sign, rays
        from different parts of the pupil arrive in one direction, and their fields add. Rays that are smooth over the
        pupil give it without others (to 1e-6, `tests/psf/test_share_of_light.py`), which spares a traced preview a
        fifth of its time (`python -m tests.benchmarks.dft_units traced`).
        """
        nodes = self.nodes(BLUR_NODES)
        found = self._areas_of_smooth() or self._areas_between_rays(nodes)
        if found is None or not found[0].min() * found[0].max() > 0:
            return None
        area, field = found
        field = field / (nodes.weight @ field)
        return float(nodes.weight @ (field * field / np.abs(area)) / (np.pi * nodes.share))

    def _areas_of_smooth(self) -> tuple[np.ndarray, np.ndarray] | None:
        """Return ∂f/∂(ξ, η) and the field per area at BLUR_NODES of the whole pupil; None unless it is smooth."""
        found = None if self.clip or self.areas else smooth_rays(self.lens, self.source, 0.0, self.sphere)
        if found is None:
            return None
        return area_of(found.channels(MAP).gradient(BLUR_NODES)), found.channels(AMPLITUDE).on(BLUR_NODES)[0]

    def _areas_between_rays(self, nodes: ClearNodes) -> tuple[np.ndarray, np.ndarray] | None:
        """Return the same by differences of rays beside each node; None where one of them is lost."""
        beside = STEP * np.array([[0, 1, -1, 0, 0], [0, 0, 0, 1, -1]])
        xi, eta = (np.add.outer(step, at).ravel() for step, at in zip(beside, (nodes.xi, nodes.eta), strict=True))
        rays = pencil(self.lens, self.source, xi, eta)
        if not rays.passed.all():
            return None
        seen = rays if self.sphere is None else self.sphere.seen_from(rays)[0]
        (_, *fx), (_, *fy) = (f.reshape(5, -1) for f in (seen.fx, seen.fy))
        area = ((fx[0] - fx[1]) * (fy[2] - fy[3]) - (fx[2] - fx[3]) * (fy[0] - fy[1])) / (2 * STEP) ** 2
        own = rays.part(slice(nodes.xi.size))
        return area, self.fields(replace(own, share=nodes.weight, mask=nodes.amplitude)) / nodes.weight


def _trace(pupil: RayPupil, counts: Counts, reach_um: float, watch: Watch | None = None) -> PupilWaves:
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
    return PupilWaves(waves, counts, nodes.xi.size, lost=nodes.xi.size - share.size)


def nodes_from(lens: Lens, source: Source, reach_um: float, sphere: ExitSphere | None = None) -> int:
    """Return about how many nodes the waves from a sphere, or plane ones, take, without following any rim.

    The mirror half is not counted.
    """
    rays, points = coarse_pencil(lens, source, PROBE), coarse_points(lens.pupil_domain)
    steep = _in_window(rays if sphere is None else sphere.seen_from(rays)[0], *points, reach_um)
    return prod(counts_for(with_slopes(steep, lens.mask, source.wavelength_um), reach_um)) // 2


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


def _nodes_of(lens: Lens, source: Source, counts: Counts, clip: bool) -> ClearNodes:
    """Return nodes up to where rays end: at the pupil's rim, at clear apertures, or where they miss a surface."""
    return pupil_nodes(lens, source, counts, clip, whole=clip or all_reach(lens, source))
