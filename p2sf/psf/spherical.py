"""The `spherical` method: rays send spherical waves from the exit pupil, true at any Fresnel number (handbook 5.9).

The other methods give each ray a plane wave, the limit of a distant exit pupil. With the Fresnel number N = n'a²/(λz)
of a pupil of radius a at a distance z from the sensor, W waves of defocus act as W/(1 + 2W/N), to first order in W/N,
for spherical waves (Li & Wolf 1984).

By theory a ray has the root of its light and of the area dS of the sphere that it spreads over: the field u on the
sphere conserves energy, |u|²·dS = light·share, and Kirchhoff's integral adds up u·dS. That is the `radiometric`
amplitude, since dS/L² is a solid angle. The sum has the weights of `huygens` all the same, so that the two differ by
the shape of the waves alone; both take the radiometric ones (`RayPupil.areas`).
"""

from dataclasses import replace
from functools import lru_cache
from math import hypot, inf, pi, prod

import numpy as np

from p2sf.conventions import UM_PER_MM, centred_axis
from p2sf.disc.domain import PupilDomain
from p2sf.errors import P2SFError, SamplingError
from p2sf.figures.compare import r_squared
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.psf.prediction import CAUTION
from p2sf.pupil.fit import level_rays, levels_for
from p2sf.pupil.rays import RayPupil
from p2sf.pupil.smooth_pupil import PROBE, all_reach, coarse_pencil, coarse_points
from p2sf.raytrace.exit_sphere import exit_sphere
from p2sf.raytrace.pencil import Rays, exit_radius, pencil
from p2sf.raytrace.ray_field import AIRY_RADIUS, Steepness, steepness
from p2sf.threads import one_blas_thread

# Of (2π)² times the variance, less by FALL of the slope of the phase in waves: where it is steep, few rays interfere.
BOUND, FALL = 0.4, 2 / 3  # held by 500 random states (python -m tests.long.spherical_prediction)
MOST_INSIDE = 0.9  # of the rays in a window, from which on its R² is that of the whole picture
SAMPLES = 64  # a side of the window in which the two sums are compared, where no other is asked for
MOST_SAMPLES = 128  # of a window that is asked for: more of them differ as SAMPLES do
ROOM = 1.1, 2.0  # of that window: of the landing points, and Airy radii
FEW_NODES = 2**14  # of that comparison: some 10 ms
MOST_NODES = 2**21  # of that comparison, beyond which it is not made: a second, where spherical waves take ten


def spherical_pupil(lens: Lens, source: Source, clip: bool = False) -> RayPupil:
    """Return the rays of a source as spherical waves; plane ones where the exit pupil is at infinity."""
    sphere = exit_sphere(lens, source)
    return RayPupil(lens, source, clip, sphere=sphere, method="spherical", interpolated=sphere is not None)


@lru_cache(maxsize=64)
def fresnel_number(lens: Lens, source: Source) -> float:
    """Return n'a²/(λz) of the exit pupil of a source: a its RMS radius times √2, z its distance from the sensor.

    Infinite of a pupil at infinity. Raises GeometryError where rays of the coarse pencil do not arrive.
    """
    sphere = exit_sphere(lens, source)
    if sphere is None:
        return inf
    xi, eta, weight = level_rays(levels_for(lens)[0])
    rays = pencil(lens, source, xi[: weight.size], eta[: weight.size])
    share = np.where(rays.passed, weight, 0.0)
    radius = sphere.radius(rays.arrived, share[rays.passed]) * UM_PER_MM
    return float(radius**2 * abs(sphere.waves_per_um / (sphere.distance * UM_PER_MM)))


def plane_wave_bound(
    lens: Lens, source: Source, rays: Rays, weight: np.ndarray, steep: Steepness, half_um: float = inf
) -> float:
    """Return an upper bound of 1 − R² between plane and spherical waves in a window of ±``half_um``, by landing points.

    At X, a distance D from where a ray lands, the waves differ by n'D²/(2λz), to second order. Of this, without its
    mean over the rays, the variance over rays and over X is (n'/2λz)²·(⟨r⁴⟩ − ⟨r²⟩² + 4 tr C² + 8s² tr C), with r from
    the centroid, C the covariance of the landing points, and s the `Steepness.light_um`, twice which diffraction
    spreads each. Of it, BOUND/(1 + slope)^FALL counts in a window that shows the light, where few rays interfere. In
    one that leaves out some of it all rays may interfere, as in the centre of a blur on the axis: there X is anywhere
    in the window, and the whole variance counts. Light that spreads by as much as z falls elsewhere than by small
    angles (`_wide_angle`). Infinite where rays tell nothing.
    """
    own, domain = slice(weight.size), lens.pupil_domain
    share = np.where(rays.passed[own], weight, 0.0)
    distance = float(np.ravel(exit_radius(lens, source, rays))[0]) * UM_PER_MM
    if not share.sum() or not distance:
        return inf
    share = share / share.sum()
    x, y = (np.where(rays.passed[own], place[own], 0.0) for place in (rays.x_um, rays.y_um))
    scale = float(rays.index / np.ravel(rays.wavelength_um)[0]) * pi / distance
    wide = _wide_angle(rays, steep, distance)
    if float(share @ ((np.abs(x) <= half_um) & (np.abs(y) <= half_um))) < MOST_INSIDE:
        return float(np.nan_to_num(scale * scale * _spread_anywhere(domain, share, x, y, half_um) + wide, nan=inf))
    x, y = x - domain.mean_across(share, x), y - share @ y
    xx, yy, xy = x * x, y * y, float(domain.mean_across(share, x * y))
    square = xx + yy
    cxx, cyy = float(share @ xx), float(share @ yy)
    spread = float(share @ (square * square)) - (cxx + cyy) ** 2
    spread += 4 * (cxx**2 + cyy**2 + 2 * xy**2) + 8 * steep.light_um**2 * (cxx + cyy)
    bound = BOUND * float((1 + steep.radial) ** -FALL) * scale * scale * spread
    return float(np.nan_to_num(bound + wide, nan=inf))


def _spread_anywhere(domain: PupilDomain, share: np.ndarray, x: np.ndarray, y: np.ndarray, half_um: float) -> float:
    """Return the variance over rays of D², µm⁴, its mean over a window, by three Gauss–Legendre points a side."""
    place, weight = half_um * np.sqrt(0.6) * np.array([-1, 0, 1]), np.array([5, 8, 5]) / 18
    images = domain.images
    across = np.concatenate([image * x for image in images])
    up, part = np.tile(y, len(images)), np.tile(share / len(images), len(images))
    square = (place[:, None, None] - across) ** 2 + (place[:, None] - up) ** 2
    return float(weight @ ((square * square) @ part - (square @ part) ** 2) @ weight)


def _wide_angle(rays: Rays, steep: Steepness, distance_um: float) -> float:
    """Return about what plane waves miss of light that spreads by some of the pupil's distance, as 1 − R².

    Light t times that distance beside a ray is displaced by t·sine and t²/2 of t, with the sine of the chief ray's
    angle to the sensor's normal, and t² fainter.
    """
    sine = float(np.hypot(np.ravel(rays.chief_kx)[0], np.ravel(rays.chief_ky)[0]))
    spread, t = steep.light_um, steep.light_um / abs(distance_um)
    return (pi * steep.spread * spread * (sine * t + t * t / 2)) ** 2 + t**4


def plane_wave_error(
    lens: Lens, source: Source, clip: bool = False, half_um: float = inf, samples: int | None = None
) -> float:
    """Return the predicted 1 − R² of plane waves against spherical ones, both of exact rays.

    It is that of two sums at the ``samples``² places of a window of ±``half_um``, since R² of few samples depends on
    where they fall; without them, or with more than MOST_SAMPLES, at SAMPLES² places of that window or of the one that
    shows the whole PSF, where that is smaller. The spherical one is summed by the plane waves that agree with it at the
    chief ray to second order, and what these miss at wide angles is added (`_wide_angle`); 0 for an exit pupil at
    infinity. Raises GeometryError where rays do not reach the sensor, SamplingError where more than MOST_NODES are
    needed.
    """
    if samples is not None and samples <= MOST_SAMPLES:
        return _compare_sums(lens, source, clip, half_um, samples)
    return _compare_sums(lens, source, clip, min(half_um, half_window_um(lens, source)), SAMPLES)


@lru_cache(maxsize=64)
@one_blas_thread
def _compare_sums(lens: Lens, source: Source, clip: bool, half: float, samples: int) -> float:
    """Return `plane_wave_error`, kept by the window that it is of, however that was asked for."""
    reach = hypot(half, half)
    plane = RayPupil(lens, source, clip, interpolated=True, most=MOST_NODES)
    counts, axis = plane.counts(reach), centred_axis(samples, 2 * half / samples)
    sphere = exit_sphere(lens, source)  # behind the counts, which refuse a wide blur sooner
    if sphere is None:
        return 0.0
    pupils = plane, replace(plane, sphere=sphere)
    counts = max(counts, pupils[1].counts(reach), key=prod)
    flat, own = (pupil.sample(counts, reach).waves.plane.intensity(axis, axis, np.float32) for pupil in pupils)
    rays = coarse_pencil(lens, source, PROBE)
    steep = steepness(rays, *coarse_points(lens.pupil_domain))
    return 1 - r_squared(flat, own) + _wide_angle(rays, steep, sphere.distance * UM_PER_MM)


def is_long_comparison(lens: Lens, source: Source, clip: bool = False, half_um: float = inf) -> bool:
    """Return whether `plane_wave_error` takes longer than a frame: by its nodes, or since it has to follow rims."""
    if clip or not all_reach(lens, source):
        return True
    half = min(half_um, half_window_um(lens, source))
    try:
        return prod(RayPupil(lens, source, clip, most=MOST_NODES).counts(hypot(half, half))) > FEW_NODES
    except P2SFError:  # then no comparison is made
        return False


def worth_spherical(lens: Lens, source: Source, clip: bool) -> bool:
    """Return whether plane waves are predicted to miss by more than CAUTION, or may where that takes too many nodes."""
    try:
        return plane_wave_error(lens, source, clip) > CAUTION
    except SamplingError:
        xi, eta, weight = level_rays(levels_for(lens)[0])
        rays = pencil(lens, source, xi, eta, clip=clip)
        return plane_wave_bound(lens, source, rays, weight, steepness(rays, xi, eta)) > CAUTION
    except P2SFError:
        return False


@lru_cache(maxsize=64)
def half_window_um(lens: Lens, source: Source) -> float:
    """Return half the side of the window about the chief ray in which the two sums are compared, µm."""
    rays = coarse_pencil(lens, source, PROBE)
    airy = AIRY_RADIUS / steepness(rays, *coarse_points(lens.pupil_domain)).spread
    return float(ROOM[0] * np.nanmax(np.hypot(rays.x_um, rays.y_um)) + ROOM[1] * airy)
