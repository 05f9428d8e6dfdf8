"""The kernels of a picture by exact rays, each place by itself: no pupils, no polynomials and no symmetry."""

import numpy as np

from p2sf.image.lattice import KernelsAt, Lattice, NodeKernels
from p2sf.image.progress import Progress
from p2sf.image.region import whole
from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.scene.planning.plan import Plan
from p2sf.scene.planning.reference import reference_kernel


def exact_lattice(planned: Plan, count: int, half: int, vergence: float | None = None) -> Lattice:
    """Return the kernels of a plan's scene at ``count``² places, each (2·half + 1)², at its far end or one vergence."""
    sensor, channels = planned.scene.sensor, planned.scene.channels
    seen = planned.sensor_map(planned.vergences[0] if vergence is None else vergence)

    def kernels_at(rows: np.ndarray, columns: np.ndarray) -> list[np.ndarray]:
        places = zip(sensor.x_mm(columns).tolist(), sensor.y_mm(rows).tolist(), strict=True)
        return [
            np.stack([reference_kernel(seen, channel, *place, half, sensor.pixel_um) for channel in channels]).astype(
                np.float32
            )
            for place in places
        ]

    return build_lattice(kernels_at, (sensor.rows, sensor.columns), (count, count))


def build_lattice(
    kernels_at: KernelsAt,
    shape: tuple[int, int],
    counts: tuple[int, int],
    mirrored: bool = False,
    watch: Progress | None = None,
) -> Lattice:
    """Return the lattice of ``kernels_at(rows, columns)`` over a picture of this shape."""
    rows, columns = (nodes_along(n, c) for n, c in zip(shape, counts, strict=True))
    return NodeKernels(kernels_at, rows, columns, mirrored).over(whole(shape), watch)
