"""How far single pictures are from the least they can take: ``python -m tests.benchmarks.lower_bound``.

The lower bound of a call is the time of its formula alone: the numpy operations on its arrays, or the plain numbers,
one after the other, with everything else prepared: nodes, kernels and weights, indices and basis rays, the entrance
points of aimed rays. What lies above it is finding these in caches, checking arguments, aiming, and labelling the
result. Both take turns in one process, on CPU time, and both must give the same values.
"""

import argparse
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import count
from statistics import median
from time import process_time

import numpy as np
from threadpoolctl import threadpool_limits

from p2sf.conventions import UM_PER_MM
from p2sf.disc.quadrature import disc_nodes, grid_rows
from p2sf.lens.lens import indices
from p2sf.lens.source import Source
from p2sf.lensfile.library import find_lens
from p2sf.paraxial.first_order import basis_rays
from p2sf.paraxial.pupils import paraxial_rays
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.seidel import seidel_psf
from p2sf.psf.seidel_sum import kernels_for, shape_terms
from p2sf.pupil.plane_waves import window_reach_um
from p2sf.pupil.rays import RayPupil
from p2sf.raytrace.aiming import PupilRays, pupil_rays
from p2sf.threads import using_threads

LENS = find_lens("double_gauss_28")
SOURCE = Source(np.inf, float(np.tan(np.deg2rad(10.0))), 0.5875618)
PIXELS, PIXEL_UM = 64, 0.88  # λ/(4 NA)
CALLS, TURNS = 20, 15
Work = Callable[[], np.ndarray]


def seidel_picture() -> tuple[Work, Work]:
    """Return a preview of the six coefficients, and its phases, cosines, sines and products alone."""
    six = coefficients(LENS, SOURCE.depth_mm, SOURCE.field_slope, SOURCE.wavelength_um)
    rows, single = grid_rows(128), np.dtype(np.float32)
    terms = shape_terms(six).reshape(5)
    kernels = kernels_for(rows, float(terms[4]) * PIXEL_UM, PIXELS, single)
    across, up_even, up_odd = kernels.across[0], kernels.up_even, kernels.up_odd
    xi, eta = rows.xi[0], rows.eta[:, None]
    square = xi * xi + eta * eta
    even_terms = (2 * np.pi * np.stack([square**2, eta**2 + 0 * xi, square])).reshape(3, -1).astype(single)
    odd_term, weight = (2 * np.pi * square * eta).ravel().astype(single), (rows.weight / 2).astype(single)
    even_waves, odd_waves = terms[[0, 2, 3]].astype(single), single.type(terms[1])

    def bare() -> np.ndarray:
        even, odd = even_waves @ even_terms, odd_waves * odd_term
        phases = np.stack([even + odd, even - odd])
        pupils = np.stack([np.cos(phases), np.sin(phases)]).reshape(2, 2, *weight.shape)
        pupils *= weight
        sums = pupils.reshape(-1, pupils.shape[-1]) @ across
        upper, lower = sums.reshape(2, 2, len(eta), -1).swapaxes(0, 1)
        return whole(up_even @ (upper + lower), up_odd @ (upper - lower))

    return lambda: seidel_psf(six, PIXELS, PIXEL_UM, "preview").values, bare


def whole(even: np.ndarray, odd: np.ndarray) -> np.ndarray:
    """Return the PSF of unit sum from a field's parts even and odd in y, real and imaginary, at x ≥ 0 and y ≥ 0."""
    above = (even[0] - odd[1]) ** 2 + (even[1] + odd[0]) ** 2
    below = (even[0] + odd[1]) ** 2 + (even[1] - odd[0]) ** 2
    half = PIXELS // 2
    right = np.concatenate([below[:0:-1], above[:half]])
    values: np.ndarray = np.concatenate([right[:, :0:-1], right[:, :half]], axis=1)
    values /= values.sum()
    return values


def six_coefficients() -> tuple[Work, Work]:
    """Return the coefficients of one source, and the marginal ray and the sums over surfaces alone.

    What only the wavelength changes is prepared: indices, basis rays, chief ray.
    """
    rays = paraxial_rays(LENS, SOURCE.depth_mm, SOURCE.wavelength_um)
    basis = basis_rays(LENS, SOURCE.wavelength_um)
    columns = (rays.index, rays.index[1:], basis.a, basis.b, basis.c, basis.d, rays.chief_nu, rays.chief_y)
    curvature = [surface.curvature for surface in LENS.surfaces]
    surfaces = list(zip(curvature, *(column.tolist() for column in columns), strict=False))
    start, angle, invariant, image_index = (
        float(value) for value in (rays.y[0], rays.nu[0], rays.invariant, rays.index[-1])
    )
    slope, waves, sensor = SOURCE.field_slope, UM_PER_MM / SOURCE.wavelength_um, LENS.sensor_mm

    def bare() -> np.ndarray:
        spherical = coma = astigmatism = petzval = distortion = 0.0
        u = angle
        for curve, n, after, a, b, c, d, chief_u, chief in surfaces:
            y, u_after = a * start + b * angle, c * start + d * angle
            snell, chief_snell = u + n * y * curve, chief_u + n * chief * curve
            bend, strength = y * (u / n**2 - u_after / after**2), curve * (1 / after - 1 / n)
            spherical += snell * snell * bend
            coma += snell * chief_snell * bend
            astigmatism += chief_snell * chief_snell * bend
            petzval -= invariant * invariant * strength
            lift = (invariant + chief_snell * y) * chief * strength
            distortion += chief_snell * (lift - chief_snell**2 * y * (1 / after**2 - 1 / n**2))
            u = u_after
        defocus = u * (u / image_index * sensor + y) / 2
        w22, w31 = astigmatism * waves / 2 * slope**2, coma * waves / 2 * slope
        w20, w11 = (astigmatism + petzval) * waves / 4 * slope**2, distortion * waves / 2 * slope**3
        return np.array([spherical * waves / 8, w31, w22, w20, w11, defocus * waves])

    def call() -> np.ndarray:
        six = coefficients(LENS, SOURCE.depth_mm, SOURCE.field_slope, SOURCE.wavelength_um)
        return np.array([six.w40, six.w31, six.w22, six.w20, six.w11, six.wd])

    return call, bare


def huygens_picture(apart: float = 0.0) -> tuple[Work, Work]:
    """Return one pass of the Huygens sum, and tracing and adding its rays alone, their entrance points known.

    Call after call the field's slope is ``apart`` larger, so that nothing is known of the source if that is not 0.
    """
    steps_aside = count()
    wave = SOURCE.wavelength_um
    nodes = disc_nodes(*RayPupil(LENS, SOURCE).counts(window_reach_um(PIXELS, PIXEL_UM)))
    rays = pupil_rays(LENS, SOURCE, np.append(nodes.xi, 0.0), np.append(nodes.eta, 0.0))
    weight, index = nodes.weight * np.asarray(rays.launch)[:-1], indices(LENS, wave).tolist()
    weight = (weight / weight.sum()).astype(np.float32)
    steps = np.arange(PIXELS // 2 + 1, dtype=np.float32) * np.float32(2 * np.pi * PIXEL_UM)

    def bare() -> np.ndarray:
        x, y, p, q, path = traced(index, rays)
        fx, fy = p[:-1] / wave, (q[:-1] - q[-1]) / wave
        phase = path[:-1] - path[-1] - p[:-1] * x[:-1] - q[:-1] * (y[:-1] - y[-1])
        phase *= UM_PER_MM / wave
        phase -= np.rint(phase)
        radians = (2 * np.pi * phase).astype(np.float32)
        across, up = np.cos(np.outer(fx.astype(np.float32), steps)), np.outer(steps, fy.astype(np.float32))
        real, imaginary = weight * np.cos(radians), weight * np.sin(radians)
        parts = np.concatenate([real[:, None] * across, imaginary[:, None] * across], 1)
        even, odd = ((kernel @ parts).reshape(-1, 2, steps.size).swapaxes(0, 1) for kernel in (np.cos(up), np.sin(up)))
        return whole(even, odd)

    def call() -> np.ndarray:
        source = replace(SOURCE, field_slope=SOURCE.field_slope + next(steps_aside) * apart)
        return huygens_psf(LENS, source, PIXELS, PIXEL_UM, None).values

    return call, bare


def traced(index: list[float], rays: PupilRays) -> tuple[np.ndarray, ...]:
    """Return x, y, two optical cosines and paths at the sensor, through spheres and planes (Welford 1986, §4.3)."""
    r = index[0] / np.sqrt(1 + rays.slope_x * rays.slope_x + rays.slope_y * rays.slope_y)
    p, q, x, y, z, path = rays.slope_x * r, rays.slope_y * r, rays.x, rays.y, rays.plane, rays.path
    for surface, n, after in zip(LENS.surfaces, index, index[1:], strict=False):
        c, step = surface.curvature, -z / r
        x, y = x + step * p, y + step * q
        f, g = c * (x * x + y * y), r - c * (x * p + y * q)
        cosine = np.sqrt(g * g - f * (c * n * n))
        bend = f / (g + cosine)
        x, y, z = x + bend * p, y + bend * q, bend * r
        path = path + (step + bend) * (n * n)
        push = np.sqrt(cosine * cosine + (after * after - n * n)) - cosine
        slant = c * push
        p, q, r = p - slant * x, q - slant * y, r + push - slant * z
        z = z - surface.thickness
    step = -z / r
    return x + step * p, y + step * q, p, q, path + step * (index[-1] * index[-1])


def check(values: np.ndarray, wanted: np.ndarray) -> float:
    """Return by how much the values of two ways differ at most, over the largest; float32 leaves some 1e-5."""
    return float(np.abs(values - wanted).max() / np.abs(wanted).max())


def milliseconds(work: Work) -> float:
    """Return the CPU time of one call, on average over some."""
    begun = process_time()
    for _ in range(CALLS):
        work()
    return 1e3 * (process_time() - begun) / CALLS


PICTURES = {
    "seidel, preview 64²": seidel_picture,
    "coefficients of one source": six_coefficients,
    "huygens 64², same source": huygens_picture,
    "huygens 64², new sources": partial(huygens_picture, 1e-10),
}
LARGEST = 1e-4  # difference of both ways


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--turns", type=int, default=TURNS)
    turns = parser.parse_args().turns
    np.ones(1 << 20)  # once a process has freed megabytes it keeps them
    with threadpool_limits(1), using_threads(1):
        for name, made in PICTURES.items():
            call, bare = made()
            apart = check(bare(), call())
            assert apart < LARGEST, (name, apart)
            both = [(milliseconds(call), milliseconds(bare)) for _ in range(turns)]
            ours, least = (median(turn[k] for turn in both) for k in (0, 1))
            ratio = median(turn[0] / turn[1] for turn in both)
            print(f"{name:28} {ours:7.3f} ms, bound {least:7.3f} ms, ratio {ratio:.2f}; they differ by {apart:.0e}")


if __name__ == "__main__":
    main()
