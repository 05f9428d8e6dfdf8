"""A picture through a lens by a plan: distortion, illumination, blur over field, colour and depth, pixels.

See handbook 10.1.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import real_array
from p2sf.errors import RequestError
from p2sf.image.geometry import distort, illumination
from p2sf.image.lattice import Lattice, build_lattice
from p2sf.image.layers import DepthLayer, depth_layers
from p2sf.image.lowrank import decompose, low_rank_blur
from p2sf.image.overlap import overlap_add
from p2sf.image.progress import Progress
from p2sf.messages import Alternatives
from p2sf.pixel_kernels.pixels import LARGEST_WINDOW
from p2sf.scene.planning.plan import Plan
from p2sf.scene.scene import Scene
from p2sf.threads import map_threads, one_blas_thread

METHODS = ("patches", "lowrank")
SURROUNDS = ("black", "edge")
LIGHT_HEIGHTS = 4, 9  # heights at which illumination is computed, for a preview and for the final picture
SAME_DEPTH = 1e-6  # a relative difference due to float32
LEAST_COVERAGE = 1e-6  # keeps the quotient finite where the surround is black
RANK_TOLERANCE = 0.1  # of the scene's tolerance: the allowed error of a low rank


@dataclass(frozen=True)
class Forming:
    """Options for the formation of a picture.

    ``method``: "patches" (overlap-add) or "lowrank". ``surround``: the light beyond the picture, none ("black") or that
    of its outermost pixels ("edge"). ``geometry``: whether distortion and illumination are included; ``spline``: order
    of the distortion's interpolation. Raises RequestError for another method or surround.
    """

    method: str = "patches"
    surround: str = "edge"
    geometry: bool = True
    spline: int = 3

    def __post_init__(self) -> None:
        if self.method not in METHODS:
            raise RequestError(
                'image method "{method}" is unknown; choose {choices}',
                method=self.method,
                choices=Alternatives(METHODS),
            )
        if self.surround not in SURROUNDS:
            raise RequestError(
                'surround "{surround}" is unknown; choose {choices}',
                surround=self.surround,
                choices=Alternatives(SURROUNDS),
            )


DEFAULT = Forming()


@one_blas_thread
def form_image(
    planned: Plan,
    values: ArrayLike,
    depth_mm: np.ndarray | None = None,
    how: Forming = DEFAULT,
    watch: Progress | None = None,
    lattice: Lattice | None = None,
) -> np.ndarray:
    """Return the image of a picture on the sensor in linear light, (rows, columns, channels) float32.

    ``values``: the paraxial image, (rows, columns, channels) on the scene's sensor, one channel for each of the
    scene's; ``depth_mm``: (rows, columns), by default the scene's far end, whose ``lattice`` may be given if it is
    known. Raises RequestError for shapes that do not fit, depths outside the scene's and whole numbers, Cancelled when
    ``watch`` is cancelled.
    """
    picture, watch = check_picture(planned.scene, values), watch or Progress()
    if depth_mm is None:
        placed, lattice = _placed_and_lattice(planned, picture, how, watch, lattice)
        return _cropped_blur(planned, placed, lattice, how, watch)
    _check_depths(planned.scene, depth_mm)
    light, covered, passing = np.zeros_like(picture), np.zeros_like(picture[..., :1]), np.ones_like(picture[..., :1])
    for layer in depth_layers(picture, np.asarray(depth_mm), np.array(planned.vergences), _largest_half(planned)):
        lattice = _with_middle_twice(plan_lattice(planned, planned.vergences[layer.number], watch))
        blurred = _cropped_blur(planned, _placed_layer(planned, layer, how), lattice, how, watch)
        light += passing * blurred[..., :-2]
        covered += passing * blurred[..., -2:-1]
        passing *= np.clip(1 - blurred[..., -1:], 0, 1)
    found: np.ndarray = light / np.maximum(covered, LEAST_COVERAGE)
    return found


def _largest_half(planned: Plan) -> int:
    """Return the half width of the widest kernel, pixels: that of one end of the depths in the corner."""
    corner = [0.0], [planned.scene.sensor.corners_mm()[1]]
    ends = (planned.vergences[0], planned.vergences[-1])
    return max(int(planned.kernels(len(planned.colours) // 2, v).points(*corner).half_widths()[0]) for v in ends)


def _placed_layer(planned: Plan, layer: DepthLayer, how: Forming) -> np.ndarray:
    """Return the light of a layer with distortion and illumination, and behind the colours its opacity, twice.

    The second is that part of it which hides.
    """
    both, vergence = np.stack([layer.opacity, layer.hiding], axis=-1), planned.vergences[0]
    lit = _distort_and_shade(planned, layer.colours, vergence, how)
    if how.geometry:
        both = distort(both, planned.sensor_map(vergence), planned.scene.sensor, order=1)
    return np.concatenate([lit * both[..., :1], both], axis=-1)


def _placed_and_lattice(
    planned: Plan, values: np.ndarray, how: Forming, watch: Progress, lattice: Lattice | None
) -> tuple[np.ndarray, Lattice]:
    """Return the picture with distortion and illumination, and in parallel the kernels of the scene's far end."""
    vergence = planned.vergences[0]
    if lattice is not None:
        return _distort_and_shade(planned, values, vergence, how), lattice
    placed = []
    found = plan_lattice(
        planned, vergence, watch, beside=lambda: placed.append(_distort_and_shade(planned, values, vergence, how))
    )
    return placed[0], found


def check_picture(scene: Scene, values: ArrayLike) -> np.ndarray:
    """Return the picture as float32; RequestError unless it fits the scene."""
    sensor, channels = scene.sensor, len(scene.channels)
    if np.ma.asarray(values).dtype.kind in "iu":
        raise RequestError(
            "the picture holds whole numbers, as codes of sRGB are; convert it to linear light, in floats with white 1"
        )
    values = real_array("values", values).astype(np.float32)
    if values.shape != (sensor.rows, sensor.columns, channels):
        raise RequestError(
            "the picture has the shape ({shape}), but the scene's sensor needs {rows} rows, {columns} columns and "
            "{channels} channels; resize it or change the scene",
            shape=values.shape,
            rows=sensor.rows,
            columns=sensor.columns,
            channels=channels,
        )
    if not np.isfinite(values).all():
        raise RequestError("the picture holds values that are not finite; replace them first")
    return values


def _check_depths(scene: Scene, depth_mm: np.ndarray) -> None:
    """Raise RequestError for a depth without kernels in the plan."""
    near, far = scene.near_mm * (1 - SAME_DEPTH), scene.far_mm * (1 + SAME_DEPTH)
    if ((depth_mm > 0) & ((depth_mm < near) | (depth_mm > far))).any():
        raise RequestError(
            "the depth map reaches from {low:g} mm to {high:g} mm, and the scene from {near:g} mm to {far:g} mm; give "
            "depths in mm from the first vertex, and the scene a range that holds them",
            low=float(np.min(depth_mm)),
            high=float(np.max(depth_mm)),
            near=scene.near_mm,
            far=scene.far_mm,
        )


def _distort_and_shade(planned: Plan, values: np.ndarray, vergence: float, how: Forming) -> np.ndarray:
    """Return the picture with distortion and illumination."""
    if not how.geometry:
        return values
    sensor, seen = planned.scene.sensor, planned.sensor_map(vergence)
    shade = illumination(seen, sensor, LIGHT_HEIGHTS[how.spline > 1])
    lit: np.ndarray = distort(values, seen, sensor, how.spline) * shade[..., None]
    return lit


def plan_lattice(
    planned: Plan,
    vergence: float,
    watch: Progress | None = None,
    most_half: int = LARGEST_WINDOW,
    beside: Callable[[], object] | None = None,
) -> Lattice:
    """Return the kernels of every channel on the plan's nodes at one depth.

    No kernel extends beyond ``most_half`` pixels: light beyond is dropped, and the rest has unit sum. ``beside`` as in
    `build_lattice`.
    """
    sensor = planned.scene.sensor
    channels = [planned.kernels(number, vergence) for number in range(len(planned.colours))]

    def kernels_at(rows: np.ndarray, columns: np.ndarray) -> list[np.ndarray]:
        x, y = sensor.x_mm(columns), sensor.y_mm(rows)
        lights = [kernels.points(x, y) for kernels in channels]
        halves = np.minimum(np.max([light.half_widths() for light in lights], axis=0), most_half)
        of_channels = (light.kernels(halves) for light in lights)
        return [np.stack(several) for several in zip(*of_channels, strict=True)]

    shape = sensor.rows, sensor.columns
    return build_lattice(kernels_at, shape, planned.counts, planned.mirrored, watch, beside)


def _with_middle_twice(lattice: Lattice) -> Lattice:
    """Return a lattice with the middle channel twice more at the end, for what a layer covers and hides."""
    middle = lattice.channels // 2
    lines = [[np.concatenate([k, k[[middle, middle]]]) for k in line] for line in lattice.kernels]
    return Lattice(lattice.row_nodes, lattice.column_nodes, lines)


def _cropped_blur(planned: Plan, values: np.ndarray, lattice: Lattice, how: Forming, watch: Progress) -> np.ndarray:
    """Return the blurred picture on its own pixels."""
    border = lattice.half if how.surround == "edge" else 0
    if border:
        values = np.pad(values, ((border, border), (border, border), (0, 0)), mode="edge")
    whole = blur(values, lattice, how.method, RANK_TOLERANCE * planned.allowed_error, watch, border)
    cut = lattice.half + border
    return whole[cut : whole.shape[0] - cut, cut : whole.shape[1] - cut]


def blur(
    values: np.ndarray, lattice: Lattice, method: str, tolerance: float, watch: Progress | None = None, border: int = 0
) -> np.ndarray:
    """Return the blurred picture with all light that leaves it, by patches or by low rank."""
    if method == "patches":
        return overlap_add(values, lattice, watch, border)
    parts = map_threads(lambda channel: decompose(lattice, channel, tolerance), range(lattice.channels))
    return low_rank_blur(values, parts, watch, border)
