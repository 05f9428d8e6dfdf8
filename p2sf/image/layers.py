"""Depth in layers: what each shows and hides, far from edges of depth and beside them (handbook 10.1).

The kernels of a surface that slopes from one depth node to the next are interpolated: its layers add up. At an edge a
nearer layer hides what lies behind it, and where it is blurred, that part of the pupil which looks past it sees on. So
beside edges a layer reaches on behind the nearer ones. No depth map can tell how: across a jump in depth a hidden
pixel takes colour and depth of the nearest pixel in its row or column that is not hidden, and where these are hidden
throughout, those of the nearest pixel in line that has taken some.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil
from typing import NamedTuple

import numpy as np

from p2sf.conventions import vergence
from p2sf.errors import RequestError
from p2sf.image.region import Region, whole
from p2sf.parameters import check_depth_map

FAR = 2**28  # pixels, more than any picture has
TINY = 1e-300  # 1/mm: keeps the quotient finite in a scene of one depth
JUMP = 0.5  # of the distance between depth nodes, from one pixel to the next; of less, the layers do not tell
CONTINUED, HIDING = 2, 4  # half widths of kernels about an edge: beyond the first nothing is seen of what goes on there


class DepthLayer(NamedTuple):
    """A layer's number among the depth nodes, its colours (rows, columns, channels), its opacity (rows, columns).

    ``hiding``: what hides farther layers, beside jumps in depth; elsewhere layers only add up.
    """

    number: int
    colours: np.ndarray
    opacity: np.ndarray
    hiding: np.ndarray


@dataclass(frozen=True, eq=False)
class DepthMap:
    """Where pixels lie among the depth nodes, counted from 0, (rows, columns) float32, and which are beside jumps.

    ``continued``: those about which hidden surfaces go on; ``hiding``: those where nearer layers hide farther ones.
    """

    place: np.ndarray
    continued: np.ndarray
    hiding: np.ndarray

    def over(self, region: Region) -> "DepthMap":
        """Return the map of a part of the picture."""
        at = region.within(whole(self.place.shape))
        return DepthMap(self.place[at], self.continued[at], self.hiding[at])

    def layers(self, values: np.ndarray) -> Iterator[DepthLayer]:
        """Yield the layers of a picture, (rows, columns, channels), from near to far, but for those that show nothing.

        Between two nodes opacity is linear in 1/depth.
        """
        place, colours, hides = self.place, values, bool(self.hiding.any())
        for number in range(ceil(place.max()), int(place.min()) - 1, -1):
            beyond = np.where(self.continued, place, self.place) - number
            opacity = np.clip(1 - np.abs(beyond), 0, 1)
            if not hides:
                yield DepthLayer(number, colours, opacity, np.zeros_like(opacity))
                continue
            if opacity.any():
                yield DepthLayer(number, colours, opacity, self.hiding * _hides(beyond, opacity))
            hidden = place >= number
            if (hidden & self.continued).any():  # elsewhere nothing is seen of what goes on
                nearest = nearest_open(hidden)
                jumps = hidden & (place[nearest] <= number - 1)  # a surface that only slopes on goes on as it is
                place = np.where(jumps, place[nearest], place)
                colours = np.where(jumps[..., None], colours[nearest], colours)
            place = np.where(hidden, np.minimum(place, number - 1), place)


@dataclass(frozen=True, eq=False)
class LayerStack:
    """Layers from far to near: ``colours``, (layers, rows, columns, channels), premultiplied by ``alpha``, and 1/depth.

    What is behind a layer is known, and its alpha is the share of the light that it keeps from there (Porter and Duff
    1984, *over*); colours may exceed it, as those of a flame do.
    """

    colours: np.ndarray
    alpha: np.ndarray
    vergences: tuple[float, ...]


def stack_layers(colours: list[np.ndarray], alpha: np.ndarray, depth_mm: np.ndarray) -> LayerStack:
    """Return layers in any order as a stack; of two at one depth the first one given is in front.

    Raises RequestError for alpha beyond 0…1 and depths that are not positive.
    """
    if not ((alpha >= 0) & (alpha <= 1)).all():
        raise RequestError(
            "alpha reaches from {low:g} to {high:g}; give the share of light that a layer hides, from 0 to 1",
            low=float(np.min(alpha)),
            high=float(np.max(alpha)),
        )
    if not (depth_mm > 0).all():
        raise RequestError("a layer has a depth that is not positive; give mm from the first vertex, inf allowed")
    order = np.argsort(vergence(depth_mm[::-1]), kind="stable")
    far_to_near = (len(depth_mm) - 1 - order).tolist()
    nodes = tuple(float(vergence(depth_mm[number])) for number in far_to_near)
    return LayerStack(np.stack([colours[n] for n in far_to_near]), alpha[far_to_near].astype(np.float32), nodes)


def map_depths(
    depth_mm: np.ndarray, vergences: np.ndarray, shape: tuple[int, ...], half: int, fold: float = 0.0
) -> DepthMap:
    """Return the places of a picture's depths, (rows, columns) mm, among nodes.

    ``vergences`` increase: the farthest node is number 0, and beyond the ends depths count as these. ``half``: the
    largest half width of a kernel, pixels. Depth has an edge where it changes by more than JUMP nodes from one pixel to
    the next, and by more than ``fold``, see `least_fold`. Raises RequestError for a map that does not fit.
    """
    place = _places(depth_mm, vergences, shape)
    part = (vergences - vergences[0]) / max(vergences[-1] - vergences[0], TINY)
    jumps = _jumps(place, JUMP) & _jumps(np.interp(place, np.arange(len(part)), part), fold)
    near, hiding = (_beside(jumps, reach * half) for reach in (CONTINUED, HIDING))
    return DepthMap(place, near, hiding)


def least_fold(halves: Sequence[int]) -> float:
    """Return the least jump in depth, in parts of the range of depths, from half widths of the kernels of each, pixels.

    A slope hides nothing unless the radius of its blur, which is linear in 1/depth, changes by more than a pixel from
    one pixel to the next: only then does the blurred surface fold over itself. The ends may lie on both sides of the
    focus, so that the radius changes by the sum of theirs at most.
    """
    return 1 / max(halves[0] + halves[-1], 1)


def _hides(beyond: np.ndarray, opacity: np.ndarray) -> np.ndarray:
    """Return what hides farther layers: of two that share a pixel the farther one, for both, as they add up."""
    return np.where((beyond > 0) & (beyond < 1), 1.0, np.where((beyond > -1) & (beyond < 0), 0.0, opacity))


def _jumps(place: np.ndarray, least: float) -> np.ndarray:
    """Return beside which pixels, (rows, columns), the next one differs by more than ``least``."""
    jumps = np.zeros(place.shape, bool)
    for axis in (0, 1):
        found = np.abs(np.diff(place, axis=axis)) > least
        jumps |= np.pad(found, [(0, int(axis == other)) for other in (0, 1)])
    return jumps


def _beside(jumps: np.ndarray, reach: int) -> np.ndarray:
    """Return which pixels are within ``reach`` rows and columns of a jump in depth, (rows, columns)."""
    from scipy.ndimage import maximum_filter

    near: np.ndarray = maximum_filter(jumps, 2 * reach + 1) if jumps.any() else jumps
    return near


def _places(depth_mm: np.ndarray, vergences: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """Return where pixels lie among the depth nodes, counted from 0, (rows, columns) float32."""
    check_map_shape(depth_mm, shape)
    check_depth_map(depth_mm)
    place: np.ndarray = np.interp(vergence(depth_mm), vergences, np.arange(len(vergences)))
    return place.astype(np.float32)


def check_map_shape(depth_mm: np.ndarray, shape: tuple[int, ...]) -> None:
    """Raise RequestError unless a map of depths has the shape of its picture, (rows, columns)."""
    if depth_mm.shape != tuple(shape):
        raise RequestError(
            "the depth map has the shape ({shape}), but the picture ({picture}); resize it",
            shape=depth_mm.shape,
            picture=tuple(shape),
        )


def nearest_open(hidden: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return row and column of the nearest pixel along row or column that is not hidden.

    Where all of both are hidden, those of the nearest pixel in line that has one; of itself where everything is.
    """
    rows, columns, found = _nearest_in_line(hidden)
    if found.any() and not found.all():
        by_row, by_column, _ = _nearest_in_line(~found)
        rows, columns = rows[by_row, by_column], columns[by_row, by_column]
    return rows, columns


def _nearest_in_line(hidden: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return row and column of the nearest pixel along row or column that is not hidden, and whether there is one.

    Where there is none, those of the pixel itself.
    """
    rows, columns = np.ogrid[: hidden.shape[0], : hidden.shape[1]]
    column, across = _nearest_in_row(hidden)
    row, down = (found.T for found in _nearest_in_row(hidden.T))
    none, sideways = np.minimum(across, down) == FAR, across <= down
    return np.where(sideways | none, rows, row), np.where(sideways & ~none, column, columns), ~none


def _nearest_in_row(hidden: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the column of the nearest pixel of the same row that is not hidden, and how far it is; FAR for none."""
    count = hidden.shape[1]
    own = np.arange(count, dtype=np.int32)
    left = np.maximum.accumulate(np.where(hidden, -2 * FAR, own), 1)
    right = np.minimum.accumulate(np.where(hidden, 2 * FAR, own)[:, ::-1], 1)[:, ::-1]
    distances = np.minimum(own - left, FAR), np.minimum(right - own, FAR)
    return np.where(distances[0] <= distances[1], left, right), np.minimum(*distances)
