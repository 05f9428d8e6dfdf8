"""A picture with depth through a lens that is being set: coarse many times a second, and all of it at rest.

What does not depend on the lens is kept from one setting to the next (`KeptPicture`): the picture's slabs of depth in
coarse pixels, and the octaves finer than these. A setting makes a few components of its kernels (`components`), blurs
the slabs, adds each octave times the mean response of the kernels there, and puts the slabs before one another.
"""

from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

import numpy as np

from p2sf.conventions import UM_PER_MM, vergence
from p2sf.image.components import (
    KernelComponents,
    KernelNodes,
    blur,
    components,
    octave_responses,
    over_levels,
    over_picture,
)
from p2sf.image.geometry import distort, illumination
from p2sf.image.octaves import enlarge
from p2sf.image.slabs import LEVELS, Slab, cut_into_slabs, depth_levels, octave_powers
from p2sf.lens.lens import Lens
from p2sf.pixel_kernels import Recipe, SensorMap
from p2sf.pixel_kernels.channel import Colour, PointLights
from p2sf.pixel_kernels.landing_light import landing_kernels
from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.pixel_kernels.pixels import samples_each
from p2sf.pixel_kernels.pupil_table import PupilTable, chebyshev, pupil_table
from p2sf.scene.planning.adaptive_table import PupilAt
from p2sf.scene.planning.pricing import computed_counts, mirrored
from p2sf.scene.planning.study import Study, pad_kernel
from p2sf.scene.scene import Scene
from p2sf.scene.sensor import Sensor
from p2sf.scene.spectrum import reduce_spectrum
from p2sf.threads import map_threads, one_blas_thread

FITS = 5, 3, 3  # along a side of the field, depths, and colours, from which the pupils of all others follow
SCAN = 65  # depths at which the blur's width is found
SHARP_PX = 4.0  # a blur of a larger radius leaves nothing of the finest octave
LIGHT_HEIGHTS = 4
MOST_SAMPLES = 8  # of λ/2NA across a pixel: it hides what diffraction adds to more
MARGIN, LEAST_ERROR = 1.6, 2e-3  # of what is expected; edges of depth, rounding


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


MOVING = Effort(2, 0.5, 0.6, 20, (3, 3), 1, 0.03, 8)


@dataclass(frozen=True, eq=False)
class KeptPicture:
    """What of a picture with depth does not depend on the setting of the lens: its slabs, from far to near.

    ``scene`` has the sensor, grown to whole coarse pixels; ``shape`` is the picture's own. ``powers``: the mean square
    of each octave by level of depth, (LEVELS,); ``contrast``: the standard deviation of the picture; ``gradient``: the
    RMS step from pixel to pixel. ``moved_px``: how far the distortion of the lens is from that of the picture.
    """

    scene: Scene
    shape: tuple[int, int]
    slabs: list[Slab]
    effort: Effort
    powers: list[np.ndarray]
    contrast: float
    gradient: float
    moved_px: float = 0.0

    def in_scene(self, scene: Scene, moved_px: float) -> "KeptPicture":
        """Return the same for another setting of the lens, whose distortion moves pixels so far from where they are."""
        rows, columns = (n - own for n, own in zip(self.whole_shape, self.shape, strict=True))
        return replace(self, scene=replace(scene, sensor=_grown(scene.sensor, rows, columns)), moved_px=moved_px)

    @property
    def whole_shape(self) -> tuple[int, int]:
        """Return the rows and columns of whole coarse pixels."""
        return self.scene.sensor.rows, self.scene.sensor.columns

    @property
    def times(self) -> int:
        """Return how many pixels a coarse one is wide."""
        return int(2**self.effort.halvings)

    @property
    def coarse(self) -> Sensor:
        """Return the sensor of coarse pixels."""
        return coarser(self.scene.sensor, self.times)


def coarser(sensor: Sensor, times: int) -> Sensor:
    """Return a sensor of pixels ``times`` as wide."""
    return replace(sensor, rows=sensor.rows // times, columns=sensor.columns // times, pixel_um=sensor.pixel_um * times)


def keep(values: np.ndarray, depth_mm: np.ndarray | None, scene: Scene, seen: SensorMap, effort: Effort) -> KeptPicture:
    """Return what is kept of a picture, (rows, columns, channels), and of its depths, (rows, columns) mm.

    It is distorted as ``seen`` has it, the lens as it was set then. Without depths all of it is at the far end.
    """
    far, near = (float(v) for v in scene.vergences(2))
    shape = values.shape[:2]
    levels = np.zeros(shape, np.int16)
    if depth_mm is not None and near > far:
        levels = depth_levels(vergence(depth_mm), far, near)
        levels = distort(levels[..., None].astype(np.float32), seen, scene.sensor, 0)[..., 0].astype(np.int16)
    placed = np.moveaxis(distort(values, seen, scene.sensor), -1, 0)
    more = [(0, -n % 2**effort.halvings) for n in shape]
    placed, levels = np.pad(placed, [(0, 0), *more], mode="edge"), np.pad(levels, more, mode="edge")
    grown = replace(scene, sensor=_grown(scene.sensor, more[0][1], more[1][1]))
    cut = cut_into_slabs(placed, levels, effort.halvings)
    by_slab = [np.sum([octave_powers(slab, number) for slab in cut], axis=0) for number in range(effort.halvings)]
    powers = [4.0**number * power / levels.size for number, power in enumerate(by_slab)]
    return KeptPicture(grown, shape, cut, effort, powers, float(placed.std()), _gradient(placed))


def _gradient(planes: np.ndarray) -> float:
    """Return the RMS step from pixel to pixel, down and across together."""
    return float(np.sqrt(sum(np.mean(np.square(np.diff(planes, axis=axis))) for axis in (-1, -2))))


def _grown(sensor: Sensor, rows: int, columns: int) -> Sensor:
    """Return a sensor with more rows below and columns at the right."""
    if not rows and not columns:
        return sensor
    x, y = sensor.centre_mm
    centre = x + columns * sensor.pixel_mm / 2, y - rows * sensor.pixel_mm / 2
    return Sensor(sensor.rows + rows, sensor.columns + columns, sensor.pixel_um, centre)


class Setting(NamedTuple):
    """The pupils of a lens as it is set, and the depths of its kernels, in levels, with the radii of their blur."""

    study: Study
    table: PupilTable
    colours: tuple[Colour, ...]
    depths: np.ndarray
    radii_um: np.ndarray


def setting(camera: Lens, kept: KeptPicture) -> Setting:
    """Return the pupils of a lens over field, depths and colours, and the depths at which kernels are made.

    Raises GeometryError where rays of the field do not reach the sensor.
    """
    scene, effort = kept.scene, kept.effort
    study = Study(camera, scene)
    colours = tuple(reduce_spectrum(channel, effort.waves) for channel in scene.channels)
    waves = sorted({wave for colour in colours for wave in colour.wavelengths_um})
    area, (along, depths, count) = study.area, FITS
    far, near = (float(v) for v in scene.vergences(2))
    axes = (
        _axis(*area.x_mm, 3),
        _axis(*area.y_mm, along),
        _axis(far, near, depths),
        waves if len(waves) <= count else _axis(waves[0], waves[-1], count),
    )
    table = pupil_table(axes, *study.fitted([PupilAt(*at) for at in product(*axes)]))
    scan = np.linspace(0, 1, SCAN if near > far else 1)
    middle = colours[len(colours) // 2].wavelengths_um[0]
    reach = [table.at(*point, far + scan * (near - far), middle)[0].reach_um for point in (area.near, area.far)]
    radii = np.min(reach, axis=0)
    nodes = _depth_nodes(radii / scene.sensor.pixel_um, effort)
    return Setting(study, table, colours, nodes * (LEVELS - 1), np.interp(nodes, scan, radii))


def _axis(low: float, high: float, count: int) -> list[float]:
    return [float(v) for v in chebyshev(low, high, count if high > low else 1)]


def _depth_nodes(radii: np.ndarray, effort: Effort) -> np.ndarray:
    """Return the depths of kernels, 0 to 1, between which blur of these radii, pixels, changes by equal steps."""
    if len(radii) == 1:
        return np.zeros(1)
    middles = (radii[1:] + radii[:-1]) / 2
    steps = np.abs(np.diff(radii)) / np.maximum(effort.step, effort.growth * middles)
    along = np.append(0, np.cumsum(steps + 1e-9))
    count = int(np.clip(np.ceil(along[-1]) + 1, 2, effort.nodes))
    found: np.ndarray = np.interp(np.linspace(0, along[-1], count), along, np.linspace(0, 1, len(radii)))
    return found


def kernel_nodes(made: Setting, pitch_um: float, kept: KeptPicture) -> KernelNodes:
    """Return the kernels of every channel at depths and places, with this pitch; places in coarse pixels."""
    scene, sensor = made.study.scene, kept.coarse
    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), kept.effort.places, strict=True))
    down, across = computed_counts((len(rows), len(columns)), mirrored(made.study.lens, scene))
    far, near = scene.vergences(2)
    depths = far + made.depths / (LEVELS - 1) * (near - far)
    grid = np.array(list(product(depths, sensor.y_mm(rows[:down]), sensor.x_mm(columns[:across]))))
    of_colours = map_threads(lambda colour: _mixed(made, grid, colour, pitch_um), made.colours)
    size = max(len(kernel) for kernels in of_colours for kernel in kernels)
    quarter = np.stack([pad_kernel(kernel, size) for kernels in of_colours for kernel in kernels])
    quarter = quarter.reshape(len(of_colours), len(depths), down, across, size, size)
    return KernelNodes(_with_mirror_images(quarter, len(rows), len(columns)), made.depths, rows, columns)


def _mixed(made: Setting, grid: np.ndarray, colour: Colour, pitch_um: float) -> list[np.ndarray]:
    """Return the kernels of a channel at vergences, y and x, (points, 3)."""
    depths, y, x = grid.T
    across, up, angles = made.study.area.fields.orient(x, y)
    waves = len(colour.wavelengths_um)
    across, up, depths, angles = (np.tile(v, waves) for v in (across, up, depths, angles))
    pupils, shifts = made.table.at(across, up, depths, np.repeat(colour.wavelengths_um, len(grid)))
    lights = PointLights(pupils, 0 * angles, shifts * UM_PER_MM).turned(angles)
    halves = np.tile(lights.half_widths(pitch_um).reshape(waves, -1).max(0), waves)
    if pupils.mask.clear and samples_each(pupils, pitch_um).max() > MOST_SAMPLES:
        kernels = landing_kernels(pupils, lights.angles, lights.shifts_um, halves, pitch_um)
    else:
        kernels = lights.kernels(halves, pitch_um, Recipe())
    totals = [np.zeros_like(kernel) for kernel in kernels[: len(grid)]]
    for k, kernel in enumerate(kernels):
        totals[k % len(grid)] += np.float32(colour.weights[k // len(grid)]) * kernel
    return totals


def _with_mirror_images(quarter: np.ndarray, rows: int, columns: int) -> np.ndarray:
    """Return kernels at all places, (channels, depths, rows, columns, size, size), of which a quarter may be given."""
    down, across = quarter.shape[2:4]
    if down < rows:
        quarter = np.concatenate([quarter, quarter[:, :, : rows - down][:, :, ::-1, :, ::-1]], axis=2)
    if across < columns:
        quarter = np.concatenate([quarter, quarter[:, :, :, : columns - across][:, :, :, ::-1, :, ::-1]], axis=3)
    return quarter


def halved_kernels(nodes: KernelNodes) -> KernelNodes:
    """Return kernels for pixels of twice the width: the lower half of their spatial frequencies."""
    import scipy.fft

    size = nodes.kernels.shape[-1]
    side = (size // 2 + 4) // 2 * 2 + 1
    start, low = side - size // 2, side - side // 2
    wide = np.zeros((*nodes.kernels.shape[:-2], 2 * side, 2 * side), np.float32)
    wide[..., start : start + size, start : start + size] = nodes.kernels
    spectra = scipy.fft.fftshift(scipy.fft.fft2(scipy.fft.ifftshift(wide, (-2, -1))), (-2, -1))
    inner = spectra[..., low : low + side, low : low + side]
    few = scipy.fft.fftshift(scipy.fft.ifft2(scipy.fft.ifftshift(inner, (-2, -1))).real, (-2, -1))
    return replace(nodes, kernels=np.ascontiguousarray(few, np.float32))


class FocusedPicture(NamedTuple):
    """Linear light, (rows, columns, channels) float32, the RMS error expected of it, of white, and its ``kernels``.

    These are of two pixels' pitch where the picture was halved before the blur.
    """

    values: np.ndarray
    error: float
    kernels: KernelNodes


@one_blas_thread
def focused_picture(kept: KeptPicture, camera: Lens) -> FocusedPicture:
    """Return the picture through a lens as it is set.

    Raises GeometryError where rays of the field do not reach the sensor.
    """
    made, effort, pixel = setting(camera, kept), kept.effort, kept.scene.sensor.pixel_um
    nodes = shown = kernel_nodes(made, pixel * max(1, kept.times // 2), kept)
    responses = [_fine_responses(made, pixel * 2**number, kept) for number in range(effort.halvings - 1)]
    if effort.halvings:
        responses.append(octave_responses(nodes))
        nodes = halved_kernels(nodes)
    gains = [over_levels(gain, nodes.depths) for gain, _ in responses]
    part = components(nodes, effort.tolerance, effort.rank)
    error = expected_error(kept, part, [over_levels(spread, nodes.depths) for _, spread in responses])
    shade = illumination(made.study.sensor_map(made.study.ends[0]), kept.coarse, LIGHT_HEIGHTS)
    out: np.ndarray | None = None
    for slab in kept.slabs:
        (down, across), planes = _blurred(slab, part, gains, shade)
        if out is None:
            out = planes
            continue
        behind = out[:, down, across]
        behind *= 1 - planes[len(behind) :]
        behind += planes[: len(behind)]
    assert out is not None
    return FocusedPicture(np.moveaxis(out[:, : kept.shape[0], : kept.shape[1]], 0, -1), error, shown)


def expected_error(kept: KeptPicture, part: KernelComponents, spreads: list[np.ndarray]) -> float:
    """Return the RMS error expected of a picture, of white, times a margin.

    An octave is off by what the kernels' response varies within it (``spreads``, its variance, as `over_levels` has
    it); the coarse picture by what the components leave of the kernels, of its contrast; all of it where it has moved.
    """
    moved = (kept.moved_px * kept.gradient) ** 2
    octaves = sum(float(power @ spread.mean((0, 1, 2))) for power, spread in zip(kept.powers, spreads, strict=True))
    return float(MARGIN * np.sqrt(octaves + (part.left * kept.contrast) ** 2 + moved + LEAST_ERROR**2))


def _blurred(
    slab: Slab, part: KernelComponents, gains: list[np.ndarray], shade: np.ndarray
) -> tuple[tuple[slice, slice], np.ndarray]:
    """Return the rows and columns of the picture to which a slab spreads, and its planes there."""
    times, channels = 2 ** len(gains), part.kernels.shape[1]
    box, planes, inside = _spread(slab, channels, part.kernels.shape[-1] // 2, shade.shape)
    planes[:channels] *= shade[box]
    level = np.pad(slab.level, [(i.start, n - i.stop) for i, n in zip(inside, planes.shape[1:], strict=True)], "edge")
    sloping = len(planes) == channels and slab.level.max() > slab.level.min()
    if sloping:
        planes = np.append(planes, np.ones_like(planes[:1]), axis=0)
    planes = blur(planes, level, part, (box[0].start, box[1].start))
    if sloping:  # where the blur changes from place to place, points do not lose light to others
        planes = planes[:channels] / planes[channels:]
    light = shade[slab.box]
    for number in range(len(gains) - 1, -1, -1):
        finer = 2 ** (len(gains) - 1 - number)
        nodes = tuple((n + 0.5) * finer - 0.5 for n in (part.row_nodes, part.column_nodes))
        corner = slab.box[0].start * finer, slab.box[1].start * finer
        gain = over_picture(gains[number], nodes, slab.levels[number], corner)
        gain = np.concatenate([gain * light, gain])
        planes, light = _with_octave(planes, inside, slab.octaves[number], gain), enlarge(light)
        inside = [slice(2 * side.start, 2 * side.stop) for side in inside]
    down, across = (slice(side.start * times, side.stop * times) for side in box)
    return (down, across), planes


def _spread(
    slab: Slab, channels: int, border: int, shape: tuple[int, int]
) -> tuple[tuple[slice, slice], np.ndarray, list[slice]]:
    """Return the slab's box grown by a border within a picture, its planes there, and where it lies in them.

    The opacity is there once for each channel, whose kernels blur it.
    """
    starts = [max(0, side.start - border) for side in slab.box]
    stops = [min(count, side.stop + border) for side, count in zip(slab.box, shape, strict=True)]
    inside = [slice(side.start - start, side.stop - start) for side, start in zip(slab.box, starts, strict=True)]
    chosen = np.minimum(np.arange(channels * (1 + (len(slab.planes) > channels))), channels)
    planes = np.zeros((len(chosen), stops[0] - starts[0], stops[1] - starts[1]), np.float32)
    planes[:, *inside] = slab.planes[chosen]
    return (slice(starts[0], stops[0]), slice(starts[1], stops[1])), planes, inside


def _with_octave(planes: np.ndarray, inside: list[slice], octave: np.ndarray, gain: np.ndarray) -> np.ndarray:
    """Return planes of twice as many pixels, with an octave times its gain, which four pixels share, where it lies."""
    top, bottom, left, right = (2 * end for side in inside for end in (side.start, side.stop))
    out = np.empty((len(planes), *(2 * n for n in planes.shape[1:])), np.float32)

    def fill(k: int) -> None:
        out[k] = enlarge(planes[k])
        own, fine = out[k, top:bottom, left:right], octave[min(k, len(octave) - 1)]
        for row in (0, 1):
            for column in (0, 1):
                own[row::2, column::2] += fine[row::2, column::2] * gain[k]

    map_threads(fill, range(len(planes)))
    return out


def _fine_responses(made: Setting, pitch_um: float, kept: KeptPicture) -> tuple[np.ndarray, np.ndarray]:
    """Return `octave_responses` at this pitch of kernels that are narrow enough for its octave, 0 of others."""
    near, sensor = made.radii_um < SHARP_PX * pitch_um, kept.coarse
    shape = [len(nodes_along(n, c)) for n, c in zip((sensor.rows, sensor.columns), kept.effort.places, strict=True)]
    gains, spreads = np.zeros((2, len(made.colours), len(made.depths), *shape))
    if near.any():
        sharp = kernel_nodes(made._replace(depths=made.depths[near]), pitch_um, kept)
        gains[:, near], spreads[:, near] = octave_responses(sharp)
    return gains, spreads
