"""Kirchhoff's sum over the reference sphere, node by node and sample by sample: every distance as it is in space.

It shares rays with the program and nothing else: the pupil's centre and the focus are the points nearest to lines in
space, the sphere is met by bisection, nodes are even in angle and Gauss–Legendre in the radius, and each wavelet is
exp(ik|x − s|)/|x − s| of the whole distance.
"""

import numpy as np

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source, source_at
from p2sf.raytrace.pencil import pencil

STEP = 1e-3  # slope of neighbouring fields
BESIDE = 0.02  # of the pupil's radius
AT_ONCE = 2**20  # wavelets at places


def meeting_point(points: np.ndarray, ways: np.ndarray, axis: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Return the point of an axis (point, way) where lines, (n, 3) each, have the least sum of squared distances.

    The distances are in planes across the axis, as the wavefront's curvature is.
    """
    origin, way = axis
    crossings = points + ((origin - points) @ way / (ways @ way))[:, None] * ways
    tilts = ways / (ways @ way)[:, None] - way
    along = -((crossings - origin) * tilts).sum() / (tilts * tilts).sum()
    return origin + along * way


def lines(rays) -> tuple[np.ndarray, np.ndarray]:
    """Return where rays meet the sensor and their ways, (n, 3) each, mm from the chief ray's point there."""
    return np.stack([rays.dx, rays.dy, 0 * rays.dx], -1), np.stack([rays.kx, rays.ky, rays.kz], -1)


def pupil_and_focus(lens: Lens, source: Source) -> tuple[np.ndarray, np.ndarray]:
    """Return the centre of the exit pupil and the focus of the chief ray, mm from where it meets the sensor."""
    beside = pencil(lens, source, [BESIDE, -BESIDE, 0, 0], [0, 0, BESIDE, -BESIDE])
    chief = np.array([np.ravel(k)[0] for k in (beside.chief_kx, beside.chief_ky, beside.chief_kz)])
    axis, points, ways = (np.zeros(3), chief), [], []
    home = beside.chief_um / 1000
    for x, y in ((STEP, 0), (-STEP, 0), (0, STEP), (0, -STEP)):
        near = source_at(source.depth_mm, source.slopes_xy[0] + x, source.slopes_xy[1] + y, source.wavelength_um)
        ray = pencil(lens, near, [0.0], [0.0])
        turn = np.deg2rad(source.azimuth_deg - near.azimuth_deg)
        spin = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
        points.append(spin @ np.append(ray.chief_um / 1000, 0) - np.append(home, 0))
        ways.append(spin @ [np.ravel(k)[0] for k in (ray.chief_kx, ray.chief_ky, ray.chief_kz)])
    return meeting_point(np.array(points), np.array(ways), axis), meeting_point(*lines(beside), axis)


def double_sum(lens: Lens, source: Source, axis_um: np.ndarray, counts: tuple[int, int]) -> np.ndarray:
    """Return the intensity over a square of samples, (y, x), up to a factor."""
    x, y = np.meshgrid(axis_um, axis_um)
    return kirchhoff(lens, source, x.ravel(), y.ravel(), counts).reshape(x.shape)


def kirchhoff(lens: Lens, source: Source, x_um: np.ndarray, y_um: np.ndarray, counts: tuple[int, int]) -> np.ndarray:
    """Return the intensity at places on the sensor, (place,), up to a factor."""
    place, weight = np.polynomial.legendre.leggauss(counts[0])
    rho, theta = (1 + place) / 2, (np.arange(counts[1]) + 0.37) * (2 * np.pi / counts[1])
    xi, eta = (np.outer(rho, turn).ravel() for turn in (np.sin(theta), np.cos(theta)))
    share = np.repeat(weight * rho, counts[1])
    rays = pencil(lens, source, xi, eta)
    pupil, focus = pupil_and_focus(lens, source)
    radius, (there, ways) = np.linalg.norm(focus - pupil), lines(rays)
    # By bisection about the plane through the pupil's centre: half a radius each way holds one crossing.
    middle = (there - pupil) @ (focus - pupil) / (ways @ (focus - pupil))
    low, high = middle - radius / 2, middle + radius / 2
    outside_low = np.linalg.norm(there - low[:, None] * ways - focus, axis=-1) > radius
    for _ in range(60):
        half = (low + high) / 2
        outside = np.linalg.norm(there - half[:, None] * ways - focus, axis=-1) > radius
        low, high = np.where(outside == outside_low, half, low), np.where(outside == outside_low, high, half)
    wavelets = there - low[:, None] * ways
    path, k = rays.path - rays.index * low, 2 * np.pi / (source.wavelength_um / 1000)
    field, nodes = np.zeros(x_um.size, complex), max(1, AT_ONCE // x_um.size)
    places = np.stack([x_um / 1000, y_um / 1000, 0 * x_um], -1)
    for some in (slice(first, first + nodes) for first in range(0, rho.size * theta.size, nodes)):
        far = np.linalg.norm(places - wavelets[some, None], axis=-1) * np.sign(low[some, None])
        turn = np.exp(1j * k * (path[some, None] + rays.index * far))
        field += ((share * rays.amplitude)[some, None] / far * turn).sum(0)
    return np.abs(field) ** 2
