"""Kernels of a lens as it is set, in few depths, places and colours: of each octave of a picture, and in coarse pixels.

Their pupils follow from few fits to rays, which are made for this setting alone: what is kept of a lens for plans costs
ten times as much, and a lens that moves is another in every picture.
"""

from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.image.components import KernelNodes, octave_responses
from p2sf.image.slabs import LEVELS
from p2sf.lens.lens import Lens
from p2sf.pixel_kernels.channel import Colour, PointLights, Recipe
from p2sf.pixel_kernels.landing_light import landing_kernels
from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.pixel_kernels.pupil_stack import PupilStack
from p2sf.pixel_kernels.pupil_table import PupilTable, chebyshev, pupil_table
from p2sf.pixel_kernels.sensor_points import SensorMap
from p2sf.scene.planning.adaptive_table import PupilAt
from p2sf.scene.planning.cost import computed_counts, mirrored
from p2sf.scene.planning.study import Study, pad_kernel
from p2sf.scene.scene import Scene
from p2sf.scene.sensor import Sensor
from p2sf.scene.spectrum import reduce_spectrum
from p2sf.threads import map_threads, one_blas_thread

# Along the height or either side of the field, depths, and colours, from which the pupils of all others follow.
FITS, SIDES = (5, 3, 3), 3
SCAN = 65  # depths at which the blur's width is found
SHARP_PX = 4.0  # a blur of a larger radius leaves nothing of the finest octave
# Of λ/2NA: across pixels that hide what diffraction adds to more, across those that hide its fringes, and in the radius
# of a blur to which it adds nothing else. There rays land as waves do.
MOST_SAMPLES, FEWEST_SAMPLES, WIDE = 8, 2, 24
FEWER_NODES = 1.25  # times so much blur from one depth node to the next, until they are not too many


@dataclass(frozen=True)
class Effort:
    """How finely a picture is made: ``halvings`` of its pixels before the blur; kernels at ``places``, and at depths.

    From one depth node to the next, ``nodes`` at most, the radius of the blur changes by ``step`` pixels, or by a
    ``growth`` of itself. ``waves``: wavelengths a channel. ``tolerance``: what is left of the kernels by their
    components, ``rank`` at most.
    """

    halvings: int
    step: float
    growth: float
    nodes: int
    places: tuple[int, int]
    waves: int
    tolerance: float
    rank: int


def _whole(sensor: Sensor, times: int) -> Sensor:
    """Return a sensor with more rows below and columns at the right, to whole pixels ``times`` as wide."""
    rows, columns = -sensor.rows % times, -sensor.columns % times
    if not rows and not columns:
        return sensor
    x, y = sensor.centre_mm
    centre = x + columns * sensor.pixel_mm / 2, y - rows * sensor.pixel_mm / 2
    return Sensor(sensor.rows + rows, sensor.columns + columns, sensor.pixel_um, centre)


class Setting(NamedTuple):
    """The pupils of a lens as it is set, and the depths of its kernels, in levels, with the radii of their blur."""

    study: Study
    effort: Effort
    table: PupilTable
    colours: tuple[Colour, ...]
    depths: np.ndarray
    radii_um: np.ndarray

    @property
    def places(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the rows and columns of the kernels, in coarse pixels."""
        sensor = self.coarse
        rows, columns = (
            nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), self.effort.places, strict=True)
        )
        return rows, columns

    @property
    def times(self) -> int:
        """Return how many pixels a coarse one is wide."""
        return int(2**self.effort.halvings)

    @property
    def coarse(self) -> Sensor:
        """Return the sensor of coarse pixels."""
        sensor, times = self.study.scene.sensor, self.times
        return replace(
            sensor, rows=sensor.rows // times, columns=sensor.columns // times, pixel_um=sensor.pixel_um * times
        )

    @property
    def seen(self) -> SensorMap:
        """Return the map from fields to the sensor at the farthest depth."""
        return self.study.sensor_map(self.study.ends[0])


@one_blas_thread
def setting(camera: Lens, scene: Scene, effort: Effort) -> Setting:
    """Return the pupils of a lens over field, depths and colours, and the depths at which kernels are made.

    The sensor grows below and at the right to whole coarse pixels. Raises GeometryError where rays of the field do not
    reach it.
    """
    scene = replace(scene, sensor=_whole(scene.sensor, 2**effort.halvings))
    study = Study(camera, scene)
    colours = tuple(reduce_spectrum(channel, effort.waves) for channel in scene.channels)
    waves = sorted({wave for colour in colours for wave in colour.wavelengths_um})
    area, (along, depths, count) = study.area, FITS
    far, near = (float(v) for v in scene.vergences(2))
    axes = (
        _axis(*area.x_mm, SIDES),
        _axis(*area.y_mm, SIDES if area.x_mm[0] < area.x_mm[1] else along),
        _axis(far, near, depths),
        waves if len(waves) <= count else _axis(waves[0], waves[-1], count),
    )
    fits = [PupilAt(*at) for at in product(*axes)]
    pupils, landed = study.from_rays(fits)
    table = pupil_table(axes, pupils, landed - np.array(fits)[:, :2])
    parts = scene.depth_parts(SCAN)
    scan, middle = np.concatenate(parts), colours[len(colours) // 2].wavelengths_um[0]
    radii = np.min([table.at(*point, scan, middle)[0].reach_um for point in (area.near, area.far)], axis=0)
    nodes = _depth_nodes(parts, radii / scene.sensor.pixel_um, effort)
    levels = (nodes - far) / (near - far) * (LEVELS - 1) if near > far else np.zeros(1)
    return Setting(study, effort, table, colours, levels, np.interp(nodes, scan, radii))


def _axis(low: float, high: float, count: int) -> list[float]:
    return [float(v) for v in chebyshev(low, high, count if high > low else 1)]


def _depth_nodes(parts: list[np.ndarray], radii: np.ndarray, effort: Effort) -> np.ndarray:
    """Return the depths of kernels in parts of the depths: blur of these radii, pixels, changes by equal steps."""
    middles = (radii[1:] + radii[:-1]) / 2
    steps = np.abs(np.diff(radii)) / np.maximum(effort.step, effort.growth * middles)
    along = np.split(np.append(0, np.cumsum(steps + 1e-9)), np.cumsum([len(part) for part in parts])[:-1])
    allowed = 1.0
    while (counts := [_count(each, allowed) for each in along]) and sum(counts) > max(effort.nodes, 2 * len(parts)):
        allowed *= FEWER_NODES
    found: np.ndarray = np.concatenate(
        [
            np.interp(np.linspace(each[0], each[-1], count), each, part)
            for each, part, count in zip(along, parts, counts, strict=True)
        ]
    )
    return found


def _count(along: np.ndarray, allowed: float) -> int:
    """Return how many nodes part ``along`` needs for steps of what is allowed."""
    return 1 if len(along) == 1 else max(2, int(np.ceil((along[-1] - along[0]) / allowed)) + 1)


class OctaveKernels(NamedTuple):
    """Kernels of the coarse pixels (``nodes``) and of those half as wide (``finer``), by depths and places.

    ``gains`` and ``spreads`` of each octave, the finest first: `octave_responses`, 0 where it is blurred away.
    """

    nodes: KernelNodes
    finer: KernelNodes
    gains: list[np.ndarray]
    spreads: list[np.ndarray]


def octave_kernels(made: Setting) -> OctaveKernels:
    """Return kernels for coarse pixels, and the responses of octaves by those for the pixels of each."""
    pixel, halvings = made.study.scene.sensor.pixel_um, made.effort.halvings
    rows, columns = made.places
    kernels, gains, spreads = np.empty(0), [], []
    for number in range(max(1, halvings)):
        pitch = pixel * 2**number
        needed = (made.radii_um < SHARP_PX * pitch) | (number >= halvings - 1)
        kernels = _kernels(made, needed, pitch)
        if halvings:
            gain, spread = np.zeros((2, len(made.colours), len(needed), *kernels.shape[2:4]))
            if needed.any():
                gain[:, needed], spread[:, needed] = octave_responses(kernels)
            gains.append(_everywhere(gain, len(rows), len(columns)))
            spreads.append(_everywhere(spread, len(rows), len(columns)))
    finer, coarse = (
        KernelNodes(_with_mirror_images(each, len(rows), len(columns)), made.depths, rows, columns)
        for each in (kernels, halved(kernels) if halvings else kernels)
    )
    return OctaveKernels(coarse, finer, gains, spreads)


def _kernels(made: Setting, chosen: np.ndarray, pitch_um: float) -> np.ndarray:
    """Return the kernels of some depths with this pitch, (channels, depths, rows, columns, size, size).

    Of places that mirror one another, the first.
    """
    scene, sensor, (rows, columns) = made.study.scene, made.coarse, made.places
    down, across = computed_counts((len(rows), len(columns)), mirrored(made.study.lens, scene))
    count = int(chosen.sum())
    if not count:
        return np.empty((len(made.colours), 0, down, across, 1, 1), np.float32)
    far, near = scene.vergences(2)
    depths = far + made.depths[chosen] / (LEVELS - 1) * (near - far)
    grid = np.array(list(product(depths, sensor.y_mm(rows[:down]), sensor.x_mm(columns[:across]))))
    of_colours = map_threads(lambda colour: _mixed(made, grid, colour, pitch_um), made.colours)
    size = max(len(kernel) for kernels in of_colours for kernel in kernels)
    padded = np.stack([pad_kernel(kernel, size) for kernels in of_colours for kernel in kernels])
    return padded.reshape(len(of_colours), count, down, across, size, size)


def _mixed(made: Setting, grid: np.ndarray, colour: Colour, pitch_um: float) -> list[np.ndarray]:
    """Return the kernels of a channel at vergences, y and x, (points, 3)."""
    depths, y, x = grid.T
    across, up, angles = made.study.area.fields.orient(x, y)
    waves = len(colour.wavelengths_um)
    across, up, depths, angles = (np.tile(v, waves) for v in (across, up, depths, angles))
    pupils, shifts = made.table.at(across, up, depths, np.repeat(colour.wavelengths_um, len(grid)))
    lights = PointLights(pupils, 0 * angles, shifts * UM_PER_MM).turned(angles)
    halves = np.tile(lights.half_widths(pitch_um).reshape(waves, -1).max(0), waves)
    across, reach = (2 * pupils.radius * length for length in (pitch_um, pupils.reach_um))
    by_rays = pupils.mask.clear & ((across > MOST_SAMPLES) | ((across > FEWEST_SAMPLES) & (reach > WIDE)))
    kernels = [np.empty(0)] * len(pupils)
    for chosen, how in ((by_rays, _by_rays), (~by_rays, _by_waves)):
        at = np.flatnonzero(chosen)
        some = PointLights(pupils.some(at), lights.angles[at], lights.shifts_um[at])
        for number, kernel in zip(at.tolist(), how(some, halves[at], pitch_um) if at.size else (), strict=True):
            kernels[number] = kernel
    totals = [np.zeros_like(kernel) for kernel in kernels[: len(grid)]]
    for k, kernel in enumerate(kernels):
        totals[k % len(grid)] += np.float32(colour.weights[k // len(grid)]) * kernel
    return totals


def _by_rays(lights: PointLights, halves: np.ndarray, pitch_um: float) -> list[np.ndarray]:
    assert isinstance(lights.lights, PupilStack)
    return landing_kernels(lights.lights, lights.angles, lights.shifts_um, halves, pitch_um)


def _by_waves(lights: PointLights, halves: np.ndarray, pitch_um: float) -> list[np.ndarray]:
    return lights.kernels(halves, pitch_um, Recipe())


def _everywhere(values: np.ndarray, rows: int, columns: int) -> np.ndarray:
    """Return what mirror images have in common at all places, (…, rows, columns), from a quarter of these."""
    down, across = (
        np.minimum(np.arange(count), count - 1 - np.arange(count)) if given < count else np.arange(count)
        for count, given in zip((rows, columns), values.shape[-2:], strict=True)
    )
    found: np.ndarray = values[..., down[:, None], across]
    return found


def _with_mirror_images(quarter: np.ndarray, rows: int, columns: int) -> np.ndarray:
    """Return kernels at all places, (channels, depths, rows, columns, size, size), from a quarter of these."""
    down, across = quarter.shape[2:4]
    if down < rows:
        quarter = np.concatenate([quarter, quarter[:, :, : rows - down][:, :, ::-1, :, ::-1]], axis=2)
    if across < columns:
        quarter = np.concatenate([quarter, quarter[:, :, :, : columns - across][:, :, :, ::-1, :, ::-1]], axis=3)
    return quarter


def halved(kernels: np.ndarray) -> np.ndarray:
    """Return kernels, (…, size, size), for pixels of twice the width: the lower half of their spatial frequencies."""
    import scipy.fft

    size = kernels.shape[-1]
    side = (size // 2 + 4) // 2 * 2 + 1
    start, low = side - size // 2, side - side // 2
    wide = np.zeros((*kernels.shape[:-2], 2 * side, 2 * side), np.float32)
    wide[..., start : start + size, start : start + size] = kernels
    spectra = scipy.fft.fftshift(scipy.fft.fft2(scipy.fft.ifftshift(wide, (-2, -1))), (-2, -1))
    inner = spectra[..., low : low + side, low : low + side]
    few = scipy.fft.fftshift(scipy.fft.ifft2(scipy.fft.ifftshift(inner, (-2, -1))).real, (-2, -1))
    return np.ascontiguousarray(few, np.float32)
