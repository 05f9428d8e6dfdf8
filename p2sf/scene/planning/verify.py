"""Verification of a plan at random points against exact rays, summed without its approximations."""

from dataclasses import dataclass
from time import thread_time

import numpy as np

from p2sf.pixel_kernels.nodes import hats, nodes_along
from p2sf.scene.planning.plan import Plan
from p2sf.scene.planning.reference import reference_kernel
from p2sf.scene.planning.study import distance, weighted_sum
from p2sf.threads import map_threads, one_blas_thread


@dataclass(frozen=True, eq=False)
class Verdict:
    """Measured relative errors at random points, (points,), and where: (x mm, y mm, vergence per mm, channel).

    ``reference_seconds``: CPU time of one reference kernel of one wavelength, on average.
    """

    errors: np.ndarray
    places: tuple[tuple[float, float, float, int], ...]
    tolerance: float
    reference_seconds: float

    @property
    def worst(self) -> float:
        """Return the largest error."""
        return float(self.errors.max())

    @property
    def kept(self) -> bool:
        """Return whether every point is within the tolerance."""
        return self.worst <= self.tolerance


@one_blas_thread
def verify(planned: Plan, points: int = 5, seed: int = 0) -> Verdict:
    """Return the errors of a plan's kernels against the reference at random points, depths and channels."""
    random = np.random.default_rng(seed)
    places = tuple(_place(planned, random) for _ in range(points))
    found = map_threads(lambda place: error_at(planned, *place), places)
    waves = sum(len(planned.scene.channels[channel].wavelengths_nm) for *_, channel in places)
    seconds = sum(spent for _, spent in found) / max(waves, 1)
    return Verdict(np.array([error for error, _ in found]), places, planned.allowed_error, seconds)


def _place(planned: Plan, random: np.random.Generator) -> tuple[float, float, float, int]:
    scene = planned.scene
    row, column = random.uniform(0, scene.sensor.rows - 1), random.uniform(0, scene.sensor.columns - 1)
    channel = int(random.integers(len(scene.channels)))
    near, far = scene.vergences(2)[::-1]
    depth = float(scene.occupied(random.uniform(far, near, 1))[0])
    return float(scene.sensor.x_mm(column)), float(scene.sensor.y_mm(row)), depth, channel


def error_at(planned: Plan, x_mm: float, y_mm: float, vergence: float, channel: int) -> tuple[float, float]:
    """Return the relative L2 error of the plan's kernel at one point, and the CPU seconds of the reference."""
    kernel = planned_kernel(planned, x_mm, y_mm, vergence, channel)
    own = int(planned.kernels(channel, vergence).points([x_mm], [y_mm]).half_widths()[0])
    half = max(own, kernel.shape[-1] // 2)
    sensor, channels = planned.scene.sensor, planned.scene.channels
    started = thread_time()
    reference = reference_kernel(planned.sensor_map(vergence), channels[channel], x_mm, y_mm, half, sensor.pixel_um)
    return distance(kernel, reference), thread_time() - started


def planned_kernel(planned: Plan, x_mm: float, y_mm: float, vergence: float, channel: int) -> np.ndarray:
    """Return the kernel used in image formation for a point: interpolated between nodes of field and depth."""
    sensor = planned.scene.sensor
    row = (sensor.rows - 1) / 2 - (y_mm - sensor.centre_mm[1]) / sensor.pixel_mm
    column = (sensor.columns - 1) / 2 + (x_mm - sensor.centre_mm[0]) / sensor.pixel_mm
    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), planned.counts, strict=True))
    weights = (hats(nodes, np.array([at]))[:, 0] for nodes, at in ((rows, row), (columns, column)))
    depth = hats(np.array(planned.vergences), np.array([vergence]))[:, 0]
    table = np.multiply.outer(depth, np.multiply.outer(*weights))
    kernels = [
        planned.kernels(channel, planned.vergences[k]).at(float(sensor.x_mm(columns[b])), float(sensor.y_mm(rows[a])))
        for k, a, b in zip(*np.nonzero(table), strict=True)
    ]
    return weighted_sum(kernels, list(table[np.nonzero(table)]))
