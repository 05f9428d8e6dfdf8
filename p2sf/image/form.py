"""A picture through a lens by a plan: distortion, illumination, blur over field, colour and depth, pixels.

See handbook 10.1.
"""

from collections.abc import Callable, Iterator
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby, product
from math import inf
from threading import Lock
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import first_place, real_array
from p2sf.cluster import checked_client, in_order, keep_freed_memory
from p2sf.errors import RequestError
from p2sf.image.blur_operator import BlurOperator
from p2sf.image.geometry import illumination, region_of, resample, source_places
from p2sf.image.highlights import (
    BrightLight,
    FullKernels,
    add_halo,
    dimmest,
    gather,
    groups_of,
    has_halos,
)
from p2sf.image.lattice import Lattice, NodeKernels, choose_step, known_kernels, pad_to_largest
from p2sf.image.layers import CONTINUED, DepthMap, LayerStack, least_fold, map_depths, stack_layers
from p2sf.image.lowrank import LowRank, decompose, low_rank_blur
from p2sf.image.progress import Progress
from p2sf.image.pupil_moments import MOMENTS, Passing, PupilLandings, moments_of, pupil_landings
from p2sf.image.region import Region, check_region, tiles, whole
from p2sf.image.structure import FLAT, centroid_px, change_of_shade, structured_parts
from p2sf.messages import Alternatives, ParameterName
from p2sf.parameters import LARGEST_SIDE
from p2sf.pixel_kernels.nodes import nodes_along
from p2sf.scene.planning.cost import BYTES, MOST_KERNELS, TILE
from p2sf.scene.planning.plan import Plan
from p2sf.scene.scene import Scene
from p2sf.threads import for_each, map_threads, one_blas_thread, using_threads

METHODS = ("patches", "lowrank")
SURROUNDS = ("black", "edge")
LIGHT_HEIGHTS = 4, 9  # heights at which illumination is computed, for a preview and for the final picture
LAYERS_NDIM = 4  # of layers, rows, columns and channels
ROUNDING = 1e-6  # of float32
LEAST_COVERAGE = 1e-6  # keeps the quotient finite where the surround is black
RANK_TOLERANCE = 0.1  # of the scene's tolerance: the allowed error of a low rank
HEIGHTS = 3  # at which the width of blur is measured: of a curved field the corner may be the sharpest
TILE_STEPS = 64  # of progress
BETWEEN = 0.2  # of the scene's tolerance: the allowed error of kernels between computed nodes
RETRIES = 2  # of a row of tiles whose worker fails
KEPT_BYTES = BYTES * MOST_KERNELS  # of depth nodes; those least recently used are computed again when needed


FormedTile = tuple[Region, np.ndarray, BrightLight]
"""A tile, its light without halos, and what has some."""


@dataclass(frozen=True)
class Forming:
    """Options for the formation of a picture.

    ``method``: "patches" (overlap-add) or "lowrank". ``surround``: the light beyond the picture, none ("black") or that
    of its outermost pixels ("edge"). ``geometry``: whether distortion and illumination are included; ``spline``: order
    of the distortion's interpolation. ``scheduler``: the address or client of a cluster whose workers form rows of
    tiles; None for this process. Raises RequestError for another method or surround.
    """

    method: str = "patches"
    surround: str = "edge"
    geometry: bool = True
    spline: int = 3
    scheduler: Any = None

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
    region: Region | None = None,
) -> np.ndarray:
    """Return the image of a picture on the sensor in linear light, (rows, columns, channels) float32.

    ``values``: the paraxial image, (rows, columns, channels) on the scene's sensor, one channel for each of the
    scene's; ``depth_mm``: (rows, columns), by default the scene's far end, whose ``lattice`` may be given if it is
    known. Or layers: (layers, rows, columns, channels + 1), colours premultiplied by the alpha behind them, and the
    depth of each, (layers,). Threads (`p2sf.threads`) share tiles of the picture, which bound the memory. ``region``:
    the part of the image that is returned, by the kernels and the light that reach it. Raises RequestError for shapes
    that do not fit, depths outside the scene's and whole numbers, Cancelled when ``watch`` is cancelled.
    """
    watch = watch or Progress()
    layered = np.ndim(values) == LAYERS_NDIM
    _check_halos(planned, how, layered)
    depths: DepthMap | LayerStack | None = None
    if layered:
        depths = _check_layers(planned.scene, values, depth_mm)
        planned = replace(planned, vergences=depths.vergences)
        picture: np.ndarray = depths.colours[0]
        for colours in depths.colours:
            _check_light(planned.scene, colours)
    else:
        picture = check_picture(planned.scene, values)
        _check_light(planned.scene, picture)
    known = lattice if depth_mm is None and how.scheduler is None else None
    kernels = DepthKernels(planned, watch, known)
    if depth_mm is None:
        halves = [kernels.over(0, whole(picture.shape)).half]
    else:
        halves = _largest_halves(planned)
    if depth_mm is not None and depths is None:
        planned.scene.check_depths(np.asarray(depth_mm))
        nodes = np.array(planned.vergences)
        depths = map_depths(np.asarray(depth_mm), nodes, picture.shape[:2], max(halves), least_fold(halves))
    least = _dimmest(planned, picture, kernels)
    every = whole(picture.shape)
    former = _Former(planned, picture, depths, how, max(halves), kernels, watch, least)
    return _form_tiles(former, check_region(region, every) if region else every)


def _form_tiles(former: "_Former", wanted: Region) -> np.ndarray:
    """Return a region of the formed picture, tile by tile, with its halos."""
    shape = former.picture.shape
    area = whole(shape) if has_halos(former.planned) else wanted  # light beyond the region has halos in it
    out, parts, bright = np.empty((*area.shape, shape[-1]), np.float32), list(tiles(area, TILE)), []
    former.watch.expect(TILE_STEPS * len(parts))

    def take(formed: FormedTile) -> None:
        part, light, highlights = formed
        out[part.within(area)] = light
        bright.append(highlights)
        former.watch.advance(TILE_STEPS)

    if former.how.scheduler is None:
        for_each(lambda part: (part, *former.form(part)), parts, take)
    else:
        _form_rows(former, parts, take)
    _add_halos(out, gather(bright), former)
    return out[wanted.within(area)]


def _form_rows(former: "_Former", parts: list[Region], take: Callable[[FormedTile], None]) -> None:
    """Take tiles, row by row, that the workers of a cluster form; each keeps the kernels of its rows."""
    with checked_client(former.how.scheduler) as client:
        sent = client.scatter(replace(former, how=replace(former.how, scheduler=None)), broadcast=True, hash=False)
        rows = [list(row) for _, row in groupby(parts, key=lambda part: part.top)]
        futures = [client.submit(_form_row, sent, row, pure=False, retries=RETRIES) for row in rows]
        for row in in_order(client, futures, former.watch.check):
            for formed in row:
                take(formed)


def _form_row(former: "_Former", row: list[Region]) -> list[FormedTile]:
    """Return the tiles of a row, formed by one thread of a worker."""
    keep_freed_memory()
    with one_blas_thread, using_threads(1):
        return [(part, *former.form(part)) for part in row]


def _dimmest(planned: Plan, picture: np.ndarray, kernels: "DepthKernels") -> float:
    """Return the light above which a pixel has a halo that counts."""
    if not has_halos(planned):
        return inf
    row, column = (n // 2 for n in picture.shape[:2])
    full = FullKernels(planned).at(row, column, planned.vergences[0])
    return dimmest(full, kernels.at(0, row, column), float(picture.max()))


def _add_halos(out: np.ndarray, bright: BrightLight, former: "_Former") -> None:
    """Add to a formed picture, in place, what the kernels of its bright light hold beyond their windows."""
    groups, full = list(groups_of(bright, out.shape)), FullKernels(former.planned)
    former.watch.expect(TILE_STEPS * len(groups))

    def difference(group: BrightLight) -> tuple[BrightLight, np.ndarray]:
        share = group.light.sum(1) / group.light.sum()
        row, column, place = (float(share @ each) for each in (group.rows, group.columns, group.places))
        vergences = former.planned.vergences
        wide = full.at(row, column, float(np.interp(place, np.arange(len(vergences)), vergences)))
        near = int(min(place, max(len(vergences) - 2, 0)))
        parts = [(part, n) for n, part in ((near, near + 1 - place), (near + 1, place - near)) if part]
        blurs = [part * former.kernels.at(number, row, column) for part, number in parts]
        wide, *blurs = pad_to_largest([wide, *blurs])  # beside another node or depth a blur may be wider
        return group, wide - sum(blurs)

    def take(found: tuple[BrightLight, np.ndarray]) -> None:
        add_halo(out, *found)
        former.watch.advance(TILE_STEPS)

    for_each(difference, groups, take)


class DepthKernels:
    """The kernels of a plan's depth nodes, computed where they are needed and kept up to KEPT_BYTES."""

    def __init__(self, planned: Plan, watch: Progress, lattice: Lattice | None = None, step: int | None = None) -> None:
        """Take the ``lattice`` of the far end, or the ``step`` of nodes, if known; else measure how many are needed."""
        self._planned, self._watch, self._step = planned, watch, step or 1
        self._lock, self._landings = Lock(), dict[int, PupilLandings]()
        self._decomposing, self._low_ranks = Lock(), dict[tuple[int, int | None], list[LowRank]]()
        if lattice is not None:
            self._nodes = {0: known_kernels(lattice)}
            return
        if step is not None:
            self._nodes = {}
            return
        halves = _largest_halves(planned)
        measured = {0, len(halves) - 1, int(np.argmin(halves))}  # the ends and the sharpest
        self._nodes = {number: node_kernels(planned, planned.vergences[number]) for number in measured}
        self._step = choose_step(list(self._nodes.values()), BETWEEN * planned.allowed_error, watch)

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what another process makes it of: the kernels are computed there."""
        return DepthKernels, (self._planned, self._watch, None, self._step)

    def over(self, number: int, region: Region) -> Lattice:
        """Return the kernels of a depth node over a part of the picture."""
        with self._lock:
            nodes = self._nodes.pop(number, None) or node_kernels(self._planned, self._planned.vergences[number])
            nodes.step = self._step
            self._nodes[number] = nodes  # the last one is the one used most recently
            while len(self._nodes) > 1 and sum(each.bytes for each in self._nodes.values()) > KEPT_BYTES:
                del self._nodes[next(iter(self._nodes))]
        return nodes.over(region, self._watch)

    def at(self, number: int, row: float, column: float) -> np.ndarray:
        """Return the kernels of a pixel at a depth node, (channels, size, size)."""
        top, left = int(row), int(column)
        return self.over(number, Region(top, top + 2, left, left + 2)).at(row - top, column - left)

    def low_rank(self, number: int, moment: int | None = None) -> list[LowRank]:
        """Return the low rank of each channel's kernels over the whole picture, or of one of their moments.

        One thread at a time finds them, since all need the same.
        """
        with self._decomposing:
            if (number, moment) not in self._low_ranks:
                sensor, tolerance = self._planned.scene.sensor, RANK_TOLERANCE * self._planned.allowed_error
                every = whole((sensor.rows, sensor.columns))
                lattice = self.over(number, every) if moment is None else self.moments(number, every)
                first, count = moment or 0, len(self._planned.colours)
                channels = range(count * first, count * (first + 1))
                self._low_ranks[number, moment] = map_threads(
                    lambda channel: decompose(lattice, channel, tolerance), channels
                )
            return self._low_ranks[number, moment]

    def moments(self, number: int, region: Region) -> Lattice:
        """Return the moments over the pupil of these kernels, see `moments_of`."""
        with self._lock:
            if number not in self._landings:
                self._landings[number] = pupil_landings(self._planned, self._planned.vergences[number])
        return moments_of(self.over(number, region), region, self._landings[number])


@dataclass(frozen=True, eq=False)
class _Former:
    """What forms tiles of a picture; ``half``: the largest half width of a kernel, pixels.

    ``dimmest``: the light above which a pixel has a halo that counts.
    """

    planned: Plan
    picture: np.ndarray
    depths: DepthMap | LayerStack | None
    how: Forming
    half: int
    kernels: DepthKernels
    watch: Progress
    dimmest: float

    def form(self, tile: Region) -> tuple[np.ndarray, BrightLight]:
        """Return a tile of the formed picture without halos, and its light that has some.

        Parts without structure remain as they are, see `structure`.
        """
        placed = _Placing(self, self._inside(tile))
        if isinstance(self.depths, LayerStack):
            return self._add_layers(tile, tile.grown(self.half), placed.stack(self.depths))[0], placed.bright(tile)
        parts = self._structured(tile, placed)
        if parts == [tile]:
            return self._blurred(tile, placed), placed.bright(tile)
        light = placed.lit[tile.within(placed.inside)].copy()
        for part in parts:
            light[part.within(tile)] = self._blurred(part, placed.over(self._inside(part)))
        return light, placed.bright(tile)

    def _inside(self, part: Region) -> Region:
        """Return the pixels of the picture from which kernels reach a part."""
        return part.grown(self.half).meet(whole(self.picture.shape))

    @cached_property
    def off_px(self) -> float:
        """Return the farthest centroid of a kernel, pixels: twice that in corners, at the ends of depth."""
        last = tuple(n - 1 for n in self.picture.shape[:2])
        places = product({0, len(self.planned.vergences) - 1}, ((0, 0), last))
        return 2 * max(centroid_px(self.kernels.at(number, *corner)) for number, corner in places)

    def _structured(self, tile: Region, placed: "_Placing") -> list[Region]:
        """Return the parts of a tile that must be blurred: all of it where light is halos or a black surround's."""
        dark = self.how.surround != "edge" and placed.inside != tile.grown(self.half)
        if dark or has_halos(self.planned):
            return [tile]
        allowed = FLAT * self.planned.allowed_error - placed.change_of_shade
        return structured_parts(placed.moved, placed.inside, tile, self.half, allowed) if allowed > 0 else [tile]

    def _blurred(self, part: Region, placed: "_Placing") -> np.ndarray:
        """Return a part of the formed picture without halos, (rows, columns, channels)."""
        reach = part.grown(self.half)
        if self.depths is None:
            planes, box = self._surrounded(placed.lit, placed.inside, reach)
            blurred, spread = self._blur(0, planes, box, tuple(range(planes.shape[-1])))
            return blurred[part.within(spread)]
        assert isinstance(self.depths, DepthMap)
        light, covered = self._add_layers(part, reach, placed.layers(self.depths))
        light /= np.maximum(covered, LEAST_COVERAGE)
        return light

    def _add_layers(
        self, tile: Region, reach: Region, layers: Iterator[tuple[int, np.ndarray, Region]]
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the light of the layers from near to far, each behind those before it, and what they cover."""
        count = self.picture.shape[-1]
        light, covered = (np.zeros((*tile.shape, count), np.float32) for _ in range(2))
        passing = Passing(light.shape)
        for number, planes, box in layers:
            planes, box = self._surrounded(planes, box, reach)
            planes = np.concatenate([planes[..., :count], np.repeat(planes[..., count:], count, -1)], -1)
            colours = tuple(range(count)) * (planes.shape[-1] // count)
            blurred, spread = self._blur(number, planes, box, colours)
            seen = spread.meet(tile)
            if seen.empty:
                continue
            inner, at = seen.within(spread), seen.within(tile)
            part, hides = blurred[inner], planes.shape[-1] > 2 * count
            moments = self._moments(number, box) if passing.cut or hides else None
            near = passing.near_moments(self.half)[box.within(reach)][..., None] if passing.cut else None
            for k, total in ((0, light), (count, covered)):
                own = part[..., k : k + count]
                through = passing.values[0][at] * own
                if moments and near is not None:
                    every = moments(planes[..., k : k + count] * near)[:, *inner]
                    through = np.clip(through + (passing.values[1:, *at] * every).sum(0), 0, own)
                total[at] += through
            if moments and hides:
                passing.hide(at, [part[..., 2 * count :], *moments(planes[..., 2 * count :])[:, *inner]])
        return light, covered

    def _surrounded(self, planes: np.ndarray, box: Region, reach: Region) -> tuple[np.ndarray, Region]:
        """Return pixels of a box with those beyond the picture's edge as far as ``reach``, and the larger box.

        What a map of depths covers goes on there even where it is black, since light is divided by what is covered.
        """
        (rows, columns, count), black = self.picture.shape, self.how.surround != "edge"
        if black and not isinstance(self.depths, DepthMap):
            return planes, box
        wide = Region(
            min(reach.top, 0) if box.top == 0 else box.top,
            max(reach.bottom, rows) if box.bottom == rows else box.bottom,
            min(reach.left, 0) if box.left == 0 else box.left,
            max(reach.right, columns) if box.right == columns else box.right,
        )
        down, right = (box.top - wide.top, wide.bottom - box.bottom), (box.left - wide.left, wide.right - box.right)
        if wide == box:
            return planes, box
        around = (down, right, (0, 0))
        padded = np.pad(planes, around, mode="edge")
        if black:
            padded[..., :count] = np.pad(planes[..., :count], around)
        return padded, wide

    def _blur(
        self, number: int, planes: np.ndarray, box: Region, channels: tuple[int, ...]
    ) -> tuple[np.ndarray, Region]:
        """Return planes of a box blurred by kernels of these channels, with all light, and where that lies."""
        if self.how.method == "lowrank":
            parts = self.kernels.low_rank(number)
            blurred = low_rank_blur(planes, [parts[channel] for channel in channels], self.watch, box)
            return blurred, box.grown(parts[0].mean.shape[0] // 2)
        lattice = self.kernels.over(number, box)
        operator = BlurOperator(lattice, box.shape, channels=channels, kind=self._kind)
        return operator.spread(planes, self.watch), box.grown(lattice.half)

    def _moments(self, number: int, box: Region) -> Callable[[np.ndarray], np.ndarray]:
        """Return the function from planes of a box, one of each colour, to their moments over the pupil.

        These are (MOMENTS, rows, columns, colours), blurred as by `_blur`.
        """
        count = self.picture.shape[-1]
        if self.how.method == "lowrank":
            parts = [self.kernels.low_rank(number, moment) for moment in range(MOMENTS)]
            return lambda planes: np.stack([low_rank_blur(planes, part, self.watch, box) for part in parts])
        every, sources = tuple(range(MOMENTS * count)), tuple(range(count)) * MOMENTS
        lattice = self.kernels.moments(number, box)
        operator = BlurOperator(lattice, box.shape, channels=every, sources=sources, kind=self._kind)

        def of_planes(planes: np.ndarray) -> np.ndarray:
            blurred = operator.spread(planes, self.watch)
            return np.moveaxis(blurred.reshape(*blurred.shape[:2], MOMENTS, count), 2, 0)

        return of_planes

    @property
    def _kind(self) -> type[np.floating]:
        """Return the numbers of sums: halos are far below the rounding of float32 beside very bright light."""
        return np.float64 if has_halos(self.planned) else np.float32


class _Placing:
    """The picture on the pixels of a region ``inside``, with distortion and illumination."""

    def __init__(self, former: _Former, inside: Region) -> None:
        self._former, self.inside, self._all = former, inside, whole(former.picture.shape)
        planned, sensor = former.planned, former.planned.scene.sensor
        self._places: np.ndarray | None = None
        self._shade: np.ndarray | None = None
        if former.how.geometry:
            seen = planned.sensor_map(planned.vergences[0])
            self._places = source_places(seen, sensor, inside)
            self._shade = illumination(seen, sensor, LIGHT_HEIGHTS[former.how.spline > 1], inside)[..., None]

    def over(self, inside: Region) -> "_Placing":
        """Return the picture on the pixels of a part of the region."""
        part, at = copy(self), inside.within(self.inside)
        part.inside, part.lit = inside, self.lit[at]
        part._places = self._places if self._places is None else self._places[:, *at]
        part._shade = self._shade if self._shade is None else self._shade[at]
        return part

    @cached_property
    def moved(self) -> np.ndarray:
        """Return the picture's colours on the pixels of the region, without illumination."""
        return self._moved(self._former.picture, self._all, self.inside, self._former.how.spline)

    @cached_property
    def lit(self) -> np.ndarray:
        """Return the picture's colours on the pixels of the region."""
        return self._shaded(self.moved, self.inside)

    @property
    def change_of_shade(self) -> float:
        """Return the largest relative change of the illumination by any kernel."""
        former = self._former
        return 0.0 if self._shade is None else change_of_shade(self._shade[..., 0], former.half, former.off_px)

    def bright(self, tile: Region) -> BrightLight:
        """Return the light of a tile that has halos."""
        if self._former.dimmest == inf:
            none = np.zeros(0, int)
            return BrightLight(none, none, none, np.zeros((0, self._former.picture.shape[-1])))
        lit, depths = self.lit[tile.within(self.inside)], self._former.depths
        rows, columns = np.nonzero((lit > self._former.dimmest).any(-1))
        light = lit[rows, columns]
        rows, columns = rows + tile.top, columns + tile.left
        source = np.stack([rows, columns])
        if self._places is not None:
            at = self._places[:, rows - self.inside.top, columns - self.inside.left]
            source = np.clip(np.rint(at).astype(int), 0, np.array(self._former.picture.shape[:2])[:, None] - 1)
        places = depths.place[*source] if isinstance(depths, DepthMap) else np.zeros(len(rows))
        return BrightLight(rows, columns, places, light)

    def layers(self, depths: DepthMap) -> Iterator[tuple[int, np.ndarray, Region]]:
        """Yield each layer's number, its colours and behind them its opacity, and the box that holds it.

        Where it hides others, that part of its opacity which does so is the last plane.
        """
        source = self.inside if self._places is None else region_of(self._places, self._all)
        if depths.hiding[source.within(self._all)].any():
            source = source.grown(CONTINUED * self._former.half).meet(self._all)
        picture = self._former.picture[source.within(self._all)]
        for layer in depths.over(source).layers(picture):
            box = self._box(layer.opacity > 0, source)
            if box.empty:
                continue
            planes = [layer.opacity, layer.hiding] if layer.hiding.any() else [layer.opacity]
            opacity = self._moved(np.stack(planes, axis=-1), source, box, 1)
            colours = self.lit[box.within(self.inside)]
            other = (
                Region(0, 0, 0, 0)
                if layer.colours is picture
                else self._box((layer.colours != picture).any(-1), source)
            )
            other = other.meet(box)
            if not other.empty:
                continued = self._moved(layer.colours, source, other, self._former.how.spline)
                colours = colours.copy()
                colours[other.within(box)] = self._shaded(continued, other)
            yield layer.number, np.concatenate([colours * opacity[..., :1], opacity], axis=-1), box

    def stack(self, stack: LayerStack) -> Iterator[tuple[int, np.ndarray, Region]]:
        """Yield each layer's number, its light and behind it its alpha, which covers and hides, and where it lies."""
        inside = self.inside
        for number in range(len(stack.alpha) - 1, -1, -1):
            alpha = self._moved(stack.alpha[number][..., None], self._all, inside, 1)
            colours = self._moved(stack.colours[number], self._all, inside, self._former.how.spline)
            yield number, np.concatenate([self._shaded(colours, inside), alpha, alpha], axis=-1), inside

    def _box(self, seen: np.ndarray, source: Region) -> Region:
        """Return the pixels on which those of ``source`` land that are ``seen``, (rows, columns), as bool."""
        rows, columns = (np.flatnonzero(seen.any(axis)) for axis in (1, 0))
        if not rows.size:
            return Region(0, 0, 0, 0)
        top, left = source.top + int(rows[0]), source.left + int(columns[0])
        found = Region(top, source.top + int(rows[-1]) + 1, left, source.left + int(columns[-1]) + 1)
        if self._places is None:
            return found.meet(self.inside)
        row = np.clip(self._places[0], source.top, source.bottom - 1)  # outermost pixels are repeated
        column = np.clip(self._places[1], source.left, source.right - 1)
        lit = (row > found.top - 1) & (row < found.bottom) & (column > found.left - 1) & (column < found.right)
        down, right = (np.flatnonzero(lit.any(axis)) for axis in (1, 0))
        if not down.size:
            return Region(0, 0, 0, 0)
        first, last = self.inside.top, self.inside.left
        return Region(first + int(down[0]), first + int(down[-1]) + 1, last + int(right[0]), last + int(right[-1]) + 1)

    def _moved(self, values: np.ndarray, given: Region, box: Region, order: int) -> np.ndarray:
        if self._places is None:
            return values[box.within(given)]
        return resample(values, self._places[:, *box.within(self.inside)], order, given)

    def _shaded(self, values: np.ndarray, box: Region) -> np.ndarray:
        return values if self._shade is None else values * self._shade[box.within(self.inside)]


def planned_depths(planned: Plan, depth_mm: np.ndarray, shape: tuple[int, ...]) -> DepthMap:
    """Return the places of a map of depths among a plan's nodes, ``continued`` where a jump mixes the light of two."""
    halves = _largest_halves(planned)
    reach = -(-max(halves) // CONTINUED)
    return map_depths(depth_mm, np.array(planned.vergences), shape, reach, least_fold(halves))


def _largest_halves(planned: Plan) -> list[int]:
    """Return the largest half width of kernels at every depth node, pixels: of all channels, from middle to corner."""
    heights, channels = np.linspace(*planned.scene.sensor.corners_mm(), HEIGHTS), range(len(planned.colours))

    def half(channel: int, node: float) -> int:
        return int(planned.kernels(channel, node).points(0 * heights, heights).half_widths().max())

    return [max(half(channel, node) for channel in channels) for node in planned.vergences]


def _check_halos(planned: Plan, how: Forming, layered: bool) -> None:
    """Raise RequestError where a scene with halos is to be formed as none can be."""
    if how.method != "patches" and has_halos(planned):
        raise RequestError(
            "a scene with {parameter} has halos fainter than the error of a low rank; choose {method} patches",
            parameter="tail_error",
            method=ParameterName("method"),
        )
    if layered and has_halos(planned):
        raise RequestError(
            "halos are those of one picture, not of layers; leave {parameter} out, or give one picture and its depths",
            parameter="tail_error",
        )


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
    known = np.isfinite(values)
    if not known.all():
        raise RequestError(
            "the picture holds values that are not finite, {count} of them, the first at row {row}, column {column} "
            "(from 0); replace them first",
            **first_place(~known),
        )
    return values


def _check_light(scene: Scene, values: np.ndarray) -> None:
    """Raise RequestError for light beyond that for which noise decided the tolerance, and for light below none."""
    most = float(values.max(initial=0.0))
    negative = values < -ROUNDING * most
    if negative.any():
        raise RequestError(
            "the picture has light of {least:g} at row {row}, column {column} (from 0), and below 0 in {count} values; "
            "light is 0 or more, so set these to 0 first",
            least=float(values[negative][0]),
            **first_place(negative),
        )
    if scene.noise_decides and most > scene.brightest * (1 + ROUNDING):
        raise RequestError(
            "the picture has light up to {most:g}, but the noise that the plan allows for is that of light up to "
            "{brightest:g}; plan with {parameter} {most:g}",
            most=most,
            brightest=scene.brightest,
            parameter=ParameterName("brightest"),
        )


def _check_layers(scene: Scene, values: ArrayLike, depth_mm: np.ndarray | None) -> LayerStack:
    """Return the layers of a scene; RequestError unless they fit it."""
    stack = real_array("values", values)
    depths = np.asarray([] if depth_mm is None else depth_mm, float)
    if depths.shape != stack.shape[:1] or not depths.size:
        raise RequestError(
            "there are {layers} layers and depths of shape ({shape}); give the depth of each layer, mm",
            layers=len(stack),
            shape=depths.shape,
        )
    scene.check_depths(depths)
    return stack_layers([check_picture(scene, layer[..., :-1]) for layer in stack], stack[..., -1], depths)


def node_kernels(planned: Plan, vergence: float, most_half: int = LARGEST_SIDE) -> NodeKernels:
    """Return the kernels of every channel on the plan's nodes at one depth, to be computed when needed.

    No kernel extends beyond ``most_half`` pixels: light beyond is dropped, and the rest has unit sum.
    """
    sensor = planned.scene.sensor
    channels = [planned.kernels(number, vergence) for number in range(len(planned.colours))]

    def kernels_at(rows: np.ndarray, columns: np.ndarray) -> list[np.ndarray]:
        x, y = sensor.x_mm(columns), sensor.y_mm(rows)
        lights = [kernels.points(x, y) for kernels in channels]
        halves = np.minimum(np.max([light.half_widths() for light in lights], axis=0), most_half)
        of_channels = (light.kernels(halves) for light in lights)
        return [np.stack(several) for several in zip(*of_channels, strict=True)]

    rows, columns = (nodes_along(n, c) for n, c in zip((sensor.rows, sensor.columns), planned.counts, strict=True))
    return NodeKernels(kernels_at, rows, columns, planned.mirrored)


def plan_lattice(
    planned: Plan, vergence: float, watch: Progress | None = None, most_half: int = LARGEST_SIDE
) -> Lattice:
    """Return the kernels of every channel on the plan's nodes at one depth; ``most_half`` as in `node_kernels`."""
    sensor, nodes = planned.scene.sensor, node_kernels(planned, vergence, most_half)
    nodes.step = choose_step([nodes], BETWEEN * planned.allowed_error, watch)
    return nodes.over(whole((sensor.rows, sensor.columns)), watch)
