"""Four pictures with depth, made from random numbers and in linear light: posts, stairs, lamps and leaves.

Each has few depths, so that a sum over single pixels has an exact layer for every one of them.
"""

from collections.abc import Callable

import numpy as np
from scipy.ndimage import gaussian_filter

LAMP = 50.0  # of white

RgbAndPlace = tuple[np.ndarray, np.ndarray]
"""Colours (rows, columns, 3) float32, and places (rows, columns) from 0, the far end in 1/depth, to 1, the near one."""


def _texture(shape: tuple[int, int], random: np.random.Generator, grain: float) -> np.ndarray:
    """Return noise with a spectrum like that of pictures, mean 0 and standard deviation 1, (rows, columns, 3)."""
    noise = random.normal(size=(*shape, 3))
    found: np.ndarray = sum(grain * k * gaussian_filter(noise, (grain * k, grain * k, 0)) for k in (1, 3, 9))
    return found / found.std()


def _painted(base: np.ndarray, texture: np.ndarray) -> np.ndarray:
    return np.clip(base * np.exp(0.35 * texture), 0, 1).astype(np.float32)


def posts(shape: tuple[int, int], seed: int = 0) -> RgbAndPlace:
    """Return five posts at several depths in front of a wall, and a fence of thin wires."""
    random = np.random.default_rng(seed)
    column = np.arange(shape[1])
    place, base = np.full(shape, 0.08), np.full((*shape, 3), 0.4)
    for number, (near, left) in enumerate(
        zip((0.37, 0.61, 0.93, 0.61, 0.93), (0.1, 0.25, 0.45, 0.66, 0.85), strict=True)
    ):
        inside = (column >= left * shape[1]) & (column < (left + 0.06) * shape[1])
        place[:, inside], base[:, inside] = near, random.uniform(0.05, 0.9, 3) * (1 if number % 2 else 0.4)
    wires = np.zeros(shape, bool)
    wires[shape[0] // 3 : shape[0] // 2 : 9] = True
    wires &= place < 0.5
    place[wires], base[wires] = 0.77, (0.03, 0.03, 0.03)
    return _painted(base, _texture(shape, random, 0.8)), place


def stairs(shape: tuple[int, int], seed: int = 0) -> RgbAndPlace:
    """Return twelve steps of a stair from near, at the bottom, to far, with tiles on them."""
    random = np.random.default_rng(seed)
    row, column = np.indices(shape)
    step = np.minimum(12 * row // shape[0], 11)
    tiles = ((column // 7 + row // 5) % 2)[..., None] * np.array([0.5, 0.35, 0.25]) + 0.2
    return _painted(tiles, 0.5 * _texture(shape, random, 0.8)), 0.04 + 0.92 * step / 11


def lamps(shape: tuple[int, int], seed: int = 0) -> RgbAndPlace:
    """Return a dark street with forty lamps of one pixel, far brighter than white, at four depths."""
    random = np.random.default_rng(seed)
    place = np.full(shape, 0.05)
    place[2 * shape[0] // 3 :] = 0.55
    values = _painted(np.full((*shape, 3), 0.03), _texture(shape, random, 1.5))
    rows, columns = (random.integers(2, count - 2, 40) for count in shape)
    values[rows, columns] = LAMP * random.uniform(0.3, 1, (40, 3))
    for number, depth in enumerate((0.05, 0.3, 0.7, 0.95)):
        place[rows[number::4], columns[number::4]] = depth
    return values, place


def leaves(shape: tuple[int, int], seed: int = 0) -> RgbAndPlace:
    """Return discs of random size and colour at ten depths, the nearer ones in front (Lee, Mumford and Huang 2001)."""
    random = np.random.default_rng(seed)
    row, column = np.indices(shape)
    place, base = np.full(shape, 0.03), np.full((*shape, 3), 0.3)
    for near in np.linspace(0.08, 0.97, 9):
        for _ in range(14):
            radius = min(shape) * 0.02 / random.uniform(0.12, 1.0)
            y, x = random.uniform(0, shape[0]), random.uniform(0, shape[1])
            inside = np.hypot(row - y, column - x) < radius
            place[inside], base[inside] = near, random.uniform(0.05, 0.9, 3)
    return _painted(base, _texture(shape, random, 0.8)), place


SCENES: dict[str, Callable[[tuple[int, int], int], RgbAndPlace]] = {
    "posts": posts,
    "stairs": stairs,
    "lamps": lamps,
    "leaves": leaves,
}
