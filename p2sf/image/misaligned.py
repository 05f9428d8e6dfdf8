"""A picture through a misaligned lens, which has no symmetry that would make the kernels of two places alike.

Every place of the sensor has the kernel of the object point whose chief ray lands there, by exact rays. Kernels stand
at the nodes of a lattice and are interpolated between them, as in other pictures (handbook 10.1); a lattice is made
finer until kernels computed in the middle of its cells keep the scene's tolerance.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil

import numpy as np

from p2sf.errors import RequestError
from p2sf.image.form import Forming, checked
from p2sf.image.geometry import distorted, illumination
from p2sf.image.lattice import Lattice, build_lattice
from p2sf.image.overlap import overlap_add
from p2sf.image.progress import Progress
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.pixel_kernels.pixels import LARGEST_WINDOW, TAIL
from p2sf.raytrace.pencil import pencil, to_the_rim
from p2sf.scene.field_points import FieldMap, field_map
from p2sf.scene.reference import landed_pixels, landed_point
from p2sf.scene.scene import Channel, Scene
from p2sf.threads import one_blas_thread

FEWEST, MOST = 3, 17  # nodes of a lattice along each axis
RINGS = 8  # of rays that find how far a kernel reaches


@dataclass(frozen=True, eq=False)
class MisalignedPicture:
    """What the sensor receives, (rows, columns, channels) float32, and the lattice of kernels it was made with.

    ``error``: the largest relative L2 error of kernels in the middle of some cells; ``allowed``: what the scene allows.
    """

    values: np.ndarray
    lattice: Lattice
    error: float
    allowed: float


@one_blas_thread
def form_misaligned(
    lens: Lens, scene: Scene, values: np.ndarray, how: Forming | None = None, watch: Progress | None = None
) -> MisalignedPicture:
    """Return the picture of a scene at one depth through a misaligned lens, ``values`` as `form_image` has them.

    Raises RequestError for several depths and for shapes that do not fit, GeometryError where chief rays do not reach
    the sensor, Cancelled when ``watch`` is cancelled.
    """
    if scene.near_mm != scene.far_mm or scene.depth_map is not None:
        raise RequestError(
            "the scene has several depths, but a picture through a misaligned lens has one; give near_mm and far_mm "
            "the same value and leave depth_map out"
        )
    how, watch, values = how or Forming(), watch or Progress(), checked(scene, values)
    camera, middle = scene.camera(lens), scene.channels[len(scene.channels) // 2]
    reference = float(middle.shares @ middle.wavelengths_um)
    seen = field_map(camera, scene.far_mm, reference, scene.sensor, scene.clip)
    lattice, error, allowed = settled_lattice(seen, scene, watch)
    if how.geometry:
        values = distorted(values, seen, scene.sensor, how.spline) * illumination(seen, scene.sensor)[..., None]
    border = lattice.half if how.surround == "edge" else 0
    if border:
        values = np.pad(values, ((border, border), (border, border), (0, 0)), mode="edge")
    whole = overlap_add(values, lattice, watch, border)
    cut = lattice.half + border
    formed = whole[cut : whole.shape[0] - cut, cut : whole.shape[1] - cut]
    return MisalignedPicture(formed, lattice, error, allowed)


def settled_lattice(seen: FieldMap, scene: Scene, watch: Progress) -> tuple[Lattice, float, float]:
    """Return kernels whose interpolation keeps the tolerance, their largest error where tried, and what is allowed.

    With MOST nodes along an axis the error may be more than allowed.
    """
    sensor, known = scene.sensor, dict[tuple[float, float], np.ndarray]()

    def kernel_at(row: float, column: float) -> np.ndarray:
        if (row, column) not in known:
            known[row, column] = channel_kernels(seen, scene, row, column)
        return known[row, column]

    def kernels_at(rows: np.ndarray, columns: np.ndarray) -> list[np.ndarray]:
        return [kernel_at(*place) for place in zip(rows.tolist(), columns.tolist(), strict=True)]

    count = FEWEST
    while True:
        lattice = build_lattice(kernels_at, (sensor.rows, sensor.columns), (count, count), watch=watch)
        middle = kernel_at((sensor.rows - 1) / 2, (sensor.columns - 1) / 2)
        allowed = scene.relative_error(float(np.sqrt(np.square(middle).sum((1, 2)).max())))
        error = _worst_between(lattice, kernel_at)
        if error <= allowed or count >= MOST:
            return lattice, error, allowed
        count = 2 * count - 1  # the nodes there are stay nodes


def _worst_between(lattice: Lattice, kernel_at: Callable[[float, float], np.ndarray]) -> float:
    """Return the largest relative L2 error of interpolated kernels in the middle of cells, the corners' among them."""
    rows, columns = len(lattice.row_nodes) - 1, len(lattice.column_nodes) - 1
    if rows < 1 or columns < 1:
        return 0.0
    cells = [(0, 0), (0, columns - 1), (rows - 1, 0), (rows - 1, columns - 1), (rows // 2, columns // 2)]
    worst = 0.0
    for a, b in cells:
        exact = kernel_at(float(lattice.row_nodes[a : a + 2].mean()), float(lattice.column_nodes[b : b + 2].mean()))
        around = [lattice.kernels[a + i][b + j] for i in (0, 1) for j in (0, 1)]
        size = max(kernel.shape[-1] for kernel in (exact, *around))
        mean = np.mean([_padded(kernel, size) for kernel in around], axis=0)
        miss = np.square(mean - _padded(exact, size)).sum((1, 2)) / np.square(exact).sum((1, 2))
        worst = max(worst, float(np.sqrt(miss.max())))
    return worst


def _padded(kernel: np.ndarray, size: int) -> np.ndarray:
    edge = (size - kernel.shape[-1]) // 2
    return np.pad(kernel, ((0, 0), (edge, edge), (edge, edge)))


def channel_kernels(seen: FieldMap, scene: Scene, row: float, column: float) -> np.ndarray:
    """Return the light per pixel of the point that lands at a place, (channels, size, size), unit sum each."""
    x, y = float(scene.sensor.x_mm(column)), float(scene.sensor.y_mm(row))
    pixel = scene.sensor.pixel_um
    points = (landed_point(seen, x, y, wave) for channel in scene.channels for wave, _ in _waves(channel))
    reach = max(_reach_um(seen.lens, source) + np.hypot(aside, shift) for source, aside, shift in points)
    half = min(max(1, ceil(reach / pixel - 0.5)), LARGEST_WINDOW)
    found = [
        sum(share * landed_pixels(seen, x, y, wave, half, pixel) for wave, share in _waves(channel))
        for channel in scene.channels
    ]
    return np.stack(found).astype(np.float32)


def _waves(channel: Channel) -> list[tuple[float, float]]:
    return list(zip(channel.wavelengths_um.tolist(), channel.shares.tolist(), strict=True))


def _reach_um(lens: Lens, source: Source) -> float:
    """Return how far from the chief ray light lands, rays and the nearest rings around them, µm."""
    data = pencil(lens, source, *to_the_rim(RINGS))
    radius = float(np.nanmax(np.hypot(data.fx, data.fy)))
    return float(np.nanmax(np.hypot(data.x_um, data.y_um))) + TAIL / radius
