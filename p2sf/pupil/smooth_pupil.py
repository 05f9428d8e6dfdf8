"""A whole pupil interpolated from some hundred rays: their data are smooth over it, although the field is not.

A coarse pencil gives the steepness of the phase and shows whether all rays arrive. If they do, and no mask has edges,
phase, direction and light at any nodes are interpolated from it; held-out rays on the rim give the accuracy.
"""

from functools import lru_cache

import numpy as np

from p2sf.conventions import write_protect
from p2sf.disc.disc_function import BY_ANGLE, BY_RADIUS, DiscFunction
from p2sf.disc.domain import PupilDomain
from p2sf.disc.quadrature import disc_axes, disc_nodes
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pupil.plane_waves import Counts, Waves, pupil_amplitude
from p2sf.pupil.pupil import PupilWaves
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.spherical_waves import waves_from
from p2sf.raytrace.exit_sphere import ExitSphere
from p2sf.raytrace.pencil import Rays, pencil
from p2sf.raytrace.ray_field import MapSlopes

PROBE = 12, 36
COARSE = PROBE, (20, 64)  # radii and directions of the pencils used for interpolation
# Waves at the rim, where the error of interpolation is largest: 1 − R² below 1e-6. One of the amplitude acts as a phase
# of 1/2π of it.
CLOSE = 2e-4
ODD = False, True, False, False, False  # in ξ, by symmetry: phase, fx, fy, amplitude and distance


@lru_cache(maxsize=4)
def coarse_points(domain: PupilDomain, counts: Counts = PROBE) -> tuple[np.ndarray, np.ndarray]:
    """Return pupil points (ξ, η) of the coarse pencil; they include the rim, where phases are steepest."""
    nodes, angle = disc_nodes(*counts), rim_angles(counts)
    return domain.points(np.append(nodes.xi, np.sin(angle)), np.append(nodes.eta, np.cos(angle)))


@lru_cache(maxsize=4)
def coarse_weights(domain: PupilDomain) -> np.ndarray:
    """Return the area weights of the rays of the coarse pencil, (ray,), of unit sum; those on the rim have none."""
    half = np.append(disc_nodes(*PROBE).weight, np.zeros(PROBE[1]))
    return write_protect(np.tile(half, len(domain.halves)) / (len(domain.halves) * half.sum()))


def rim_angles(counts: Counts) -> np.ndarray:
    """Return the angles from +η of the rays on the rim of a coarse pencil, over half a turn."""
    return np.linspace(0, np.pi, counts[1])


@lru_cache(maxsize=16)
def all_reach(lens: Lens, source: Source) -> bool:
    """Return whether rays over the whole pupil and its rim reach the sensor, disregarding clear apertures."""
    return bool(coarse_pencil(lens, source, PROBE).passed.all())


@lru_cache(maxsize=4)
def coarse_pencil(lens: Lens, source: Source, counts: Counts) -> Rays:
    """Return the coarse pencil, which gives the steepness of the phase and shows whether all rays arrive."""
    return pencil(lens, source, *coarse_points(lens.pupil_domain, counts))


@lru_cache(maxsize=4)
def coarse_slopes(lens: Lens, source: Source, sphere: ExitSphere | None = None) -> MapSlopes:
    """Return how the frequencies of the coarse pencil change over the pupil, those on the rim included.

    All its rays must arrive. They are seen from a ``sphere``, if given.
    """
    rays, domain = coarse_pencil(lens, source, PROBE), lens.pupil_domain
    seen = rays if sphere is None else sphere.seen_from(rays)[0]
    inside, _ = _inside_and_rim(np.stack([seen.fx, seen.fy]), domain, PROBE, (True, False))
    parts = [_polar_slopes(inside, *place) for place in (disc_axes(*PROBE), (np.ones(1), rim_angles(PROBE)))]
    return MapSlopes(*(np.concatenate(part, axis=-1).reshape(2, -1) for part in zip(*parts, strict=True)))


def _polar_slopes(frequencies: DiscFunction, radius: np.ndarray, theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return ∂f/∂ρ·√(1 − ρ²) and ∂f/∂θ at radii × angles, (2, halves, points) each."""
    by_radius, by_angle = (
        frequencies.on_polar(radius, theta, what).reshape(2, len(frequencies.domain.halves), -1)
        for what in (BY_RADIUS, BY_ANGLE)
    )
    return by_radius * np.repeat(np.sqrt(1 - radius * radius), theta.size), by_angle


def _inside_and_rim(
    values: np.ndarray, domain: PupilDomain, coarse: Counts, odd: tuple[bool, ...]
) -> tuple[DiscFunction, np.ndarray]:
    """Return functions through a coarse pencil's nodes, of values at its rays, (columns, rays), and those on its rim.

    Both stand half by half. ``odd`` as `DiscFunction` has it.
    """
    halves = values.reshape(len(values), len(domain.halves), -1)
    inside, rim = (part.reshape(len(values), -1) for part in np.split(halves, [coarse[0] * coarse[1] // 2], axis=-1))
    return DiscFunction(inside, coarse, odd, domain), rim


def interpolated_waves(
    lens: Lens, source: Source, counts: Counts, reach_um: float, sphere: ExitSphere | None = None
) -> PupilWaves | None:
    """Return the waves of nodes over the whole pupil, interpolated from a coarse pencil of exact rays.

    They are plane, or spherical from a ``sphere``. None behind a mask, if rays are lost, and if no such pencil is
    accurate enough.
    """
    found = smooth_rays(lens, source, reach_um, sphere)
    if found is None:
        return None
    phase, fx, fy, field, *length = found.on(counts)
    nodes = lens.pupil_domain.nodes(counts)
    amplitude = pupil_amplitude(nodes.weight * field / (nodes.weight @ field), phase)
    fx, fy = fx.copy(), fy.copy()  # so that phase and field, in the same array, need no memory during the sum
    rays = coarse_pencil(lens, source, found.counts)
    waves = Waves(amplitude, fx, fy, nodes.domain, _farthest_um(rays), reach_um)
    return PupilWaves(waves_from(waves, sphere, *length), counts, rays.phase.size)


def smooth_rays(lens: Lens, source: Source, reach_um: float, sphere: ExitSphere | None = None) -> DiscFunction | None:
    """Return phase, fx, fy and amplitude through the first sufficient pencil; None where none is.

    Seen from a ``sphere`` these are of the rays that it has, with their distances behind.
    """
    if not mask_seen(lens, source).clear:
        return None
    domain = lens.pupil_domain
    for coarse in COARSE:
        rays = coarse_pencil(lens, source, coarse)
        if not rays.passed.all():
            return None
        seen, *length = (rays,) if sphere is None else sphere.seen_from(rays)
        values = np.stack([seen.phase, seen.fx, seen.fy, rays.amplitude, *length])
        inside, rim = _inside_and_rim(values, domain, coarse, ODD[: len(values)])
        missed = np.abs(inside.on_polar(np.ones(1), rim_angles(coarse)) - rim).max(1)
        uneven = missed[3] / (2 * np.pi * np.abs(rays.amplitude).mean())
        if missed[0] + uneven + (missed[1] + missed[2]) * max(_farthest_um(rays), reach_um) <= CLOSE:
            return inside
    return None


def _farthest_um(rays: Rays) -> float:
    return float(np.hypot(rays.x_um, rays.y_um).max())
