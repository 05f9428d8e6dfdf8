"""A picture with depth through a lens that is being set: coarse many times a second, and all of it at rest.

What does not depend on the lens is kept from one setting to the next (`KeptPicture`): the picture's slabs of depth in
coarse pixels, and the octaves finer than these. A setting makes a few components of its kernels (`components`), blurs
the slabs, adds each octave times the mean response of the kernels there, and puts the slabs before one another.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from p2sf.conventions import vergence
from p2sf.image.components import KernelComponents, KernelNodes, blur, components, over_levels, over_picture
from p2sf.image.geometry import illumination, resample, source_places
from p2sf.image.kernel_octaves import Effort, Setting, octave_kernels
from p2sf.image.octaves import enlarge
from p2sf.image.region import whole
from p2sf.image.slabs import DepthEdge, Slab, cut_into_slabs, depth_levels, octave_powers
from p2sf.threads import map_threads, one_blas_thread

LIGHT_HEIGHTS = 3
MARGIN, LEAST_ERROR = 1.6, 2e-3  # of what is expected; rounding
ROWS_AT_ONCE = 16  # coarse rows, of which enlarged planes stay in the processor's cache
MOVING = Effort(2, 0.5, 0.6, 20, (3, 3), 1, 0.03, 8)


@dataclass(frozen=True, eq=False)
class KeptPicture:
    """What of a picture with depth does not depend on the setting of the lens: its slabs, from far to near.

    ``shape`` is the picture's own; slabs have whole coarse pixels. ``powers``: the mean square of each octave by level
    of depth, (LEVELS,); ``contrast``: the standard deviation of the picture; ``gradient``: the RMS step from pixel to
    pixel.
    """

    shape: tuple[int, int]
    slabs: list[Slab]
    edges: list[DepthEdge]
    powers: list[np.ndarray]
    contrast: float
    gradient: float


def keep(values: np.ndarray, depth_mm: np.ndarray | None, made: Setting) -> KeptPicture:
    """Return what is kept of a picture, (rows, columns, channels), and of its depths, (rows, columns) mm.

    It is distorted as a lens has it that is set so. Without depths all of it is at the far end.
    """
    scene, halvings, shape = made.study.scene, made.effort.halvings, values.shape[:2]
    far, near = (float(v) for v in scene.vergences(2))
    levels = np.zeros(shape, np.int16)
    if depth_mm is not None and near > far:
        levels = depth_levels(vergence(depth_mm), far, near)
    places = source_places(made.seen, scene.sensor, whole(shape))
    if places is not None:
        values = resample(values, places, 3, whole(shape))
        levels = resample(levels[..., None].astype(np.float32), places, 0, whole(shape))[..., 0].astype(np.int16)
    placed = np.moveaxis(values, -1, 0)
    more = [(0, count - own) for count, own in zip((scene.sensor.rows, scene.sensor.columns), shape, strict=True)]
    placed, levels = np.pad(placed, [(0, 0), *more], mode="edge"), np.pad(levels, more, mode="edge")
    cut, edges = cut_into_slabs(placed, levels, halvings)
    by_slab = [np.sum([octave_powers(slab, number) for slab in cut], axis=0) for number in range(halvings)]
    powers = [4.0**number * power / levels.size for number, power in enumerate(by_slab)]
    return KeptPicture(shape, cut, edges, powers, float(placed.std()), _gradient(placed))


def _gradient(planes: np.ndarray) -> float:
    """Return the RMS step from pixel to pixel, down and across together."""
    return float(np.sqrt(sum(np.mean(np.square(np.diff(planes, axis=axis))) for axis in (-1, -2))))


class FocusedPicture(NamedTuple):
    """Linear light, (rows, columns, channels) float32, the RMS error expected of it, of white, and its ``kernels``.

    These are of two pixels' pitch where the picture was halved before the blur.
    """

    values: np.ndarray
    error: float
    kernels: KernelNodes


@one_blas_thread
def focused_picture(kept: KeptPicture, made: Setting, moved_px: float = 0.0) -> FocusedPicture:
    """Return the picture through a lens as it is set; its distortion moves pixels so far from where they are kept."""
    kernels = octave_kernels(made)
    gains, spreads = (
        [over_levels(each, made.depths) for each in octaves] for octaves in (kernels.gains, kernels.spreads)
    )
    parts = [_slab_components(slab, kernels.nodes, made.effort) for slab in kept.slabs]
    left = max(part.left for part in parts)
    error = expected_error(kept, spreads, left, moved_px, edge_band(kept.edges, made))
    shade = illumination(made.seen, made.coarse, LIGHT_HEIGHTS)
    border = max(part.kernels.shape[-1] // 2 for part in parts)
    sensor = made.study.scene.sensor
    out = np.zeros((len(made.colours), sensor.rows, sensor.columns), np.float32)
    for slab, part in zip(kept.slabs, parts, strict=True):
        # What is nearer spreads over its own edge by a border, and what is seen there comes from another one beside it.
        (down, across), planes = _blurred(slab.about_seen(2 * border), part, gains, shade)
        behind = out[:, down, across]
        if len(planes) > len(behind):
            behind *= 1 - planes[len(behind) :]
        behind += planes[: len(behind)]
    return FocusedPicture(np.moveaxis(out[:, : kept.shape[0], : kept.shape[1]], 0, -1), error, kernels.finer)


def _slab_components(slab: Slab, nodes: KernelNodes, effort: Effort) -> KernelComponents:
    """Return the components of the kernels between which the depths of a slab lie."""
    first = np.searchsorted(nodes.depths, slab.level.min(), "right") - 1
    last = np.searchsorted(nodes.depths, slab.level.max())
    its = slice(max(0, int(first)), int(last) + 1)
    return components(
        replace(nodes, kernels=nodes.kernels[:, its], depths=nodes.depths[its]), effort.tolerance, effort.rank
    )


def expected_error(kept: KeptPicture, spreads: list[np.ndarray], left: float, moved_px: float, band: float) -> float:
    """Return the RMS error expected of a picture, of white, times a margin.

    An octave is off by what the kernels' response varies within it (``spreads``, its variance, as `over_levels` has
    it); the coarse picture by what is ``left`` of the kernels by their components, of its contrast; all of it where it
    has moved; the ``band`` along edges of depth by half of the contrast, since slabs do not cut the pupil.
    """
    moved = (moved_px * kept.gradient) ** 2
    octaves = sum(float(power @ spread.mean((0, 1, 2))) for power, spread in zip(kept.powers, spreads, strict=True))
    contrast = (left**2 + band / 4) * kept.contrast**2
    return float(MARGIN * np.sqrt(octaves + contrast + moved + LEAST_ERROR**2))


def edge_band(edges: list[DepthEdge], made: Setting) -> float:
    """Return the share of pixels beside edges of depth that are nearer to these than the blur on either side reaches.

    With the focus on one side the picture is right: a sharp edge cuts no pupil, and blurs over what is sharp.
    """
    pixel = made.study.scene.sensor.pixel_um
    return sum(
        edge.share * 2 * float(np.interp([edge.behind, edge.before], made.depths, made.radii_um).min()) / pixel
        for edge in edges
    )


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
    gain = over_picture(np.concatenate(gains), (part.row_nodes, part.column_nodes), slab.level, _corner(slab))
    gain = gain.reshape(len(gains), channels, *slab.level.shape)
    gain = np.concatenate([gain * shade[slab.box], gain], axis=1)
    for number in range(len(gains) - 1, -1, -1):
        planes = _with_octave(planes, inside, slab.octaves[number], gain[number])
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


def _corner(slab: Slab) -> tuple[int, int]:
    return slab.box[0].start, slab.box[1].start


def _with_octave(planes: np.ndarray, inside: list[slice], octave: np.ndarray, gain: np.ndarray) -> np.ndarray:
    """Return planes of twice as many pixels, with an octave times its gain, which some pixels share, where it lies.

    A few rows at a time, so that what is between stays in the processor's cache.
    """
    out = np.empty((len(planes), *(2 * n for n in planes.shape[1:])), np.float32)
    (top, bottom), (left, right) = ((2 * side.start, 2 * side.stop) for side in inside)
    share, step = octave.shape[1] // gain.shape[1], 2 * ROWS_AT_ONCE

    def fill(k: int) -> None:
        for start in range(0, out.shape[1], step):
            first, last = max(0, start // 2 - 1), start // 2 + ROWS_AT_ONCE + 1
            rows = out[k, start : start + step]
            rows[:] = enlarge(planes[k, first:last])[start - 2 * first :][: len(rows)]
        own, fine = out[k, top:bottom, left:right], octave[min(k, len(octave) - 1)]
        for start in range(0, len(own), step):
            row = slice(start, start + step)
            times = gain[k, start // share : (start + step) // share].repeat(share, 1)
            added = fine[row].reshape(-1, share, fine.shape[1]) * times[:, None]
            own[row] += added.reshape(-1, fine.shape[1])

    map_threads(fill, range(len(planes)))
    return out
