"""What one small picture of a matrix shows, and the scales that pictures share or have of their own."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from p2sf.figures.enlarge import enlarge
from p2sf.messages import Message
from p2sf_explorer.compute.framing import Circle, frame_of
from p2sf_explorer.state.scales import nice

PAINTED = 256  # samples a side of a small picture of light
STEPS = (1, 1.5, 2, 3, 4, 5, 6, 8)
SIGNED_STEPS = (1, 1.5, 2, 3, 5, 7)
LEAST = {"spot": 0.1, "ray_fan": 1e-3, "opd_fan": 1e-3, "pupil": 0.05}  # of a scale, µm or waves
NO_WORDS = Message("")


@dataclass(frozen=True, eq=False)
class Light:
    """Light per sample, (y, x), over a square window ``width_um`` wide about the chief ray, rows +y, and its circle."""

    values: np.ndarray
    width_um: float
    airy_um: float
    circle: Circle

    @cached_property
    def painted(self) -> np.ndarray:
        """Return the light on finer samples."""
        return enlarge(self.values, PAINTED)


@dataclass(frozen=True, eq=False)
class WavefrontTile:
    """W in waves over the square about the pupil, (y, x), and the ``outline`` of what passes light, (2, points)."""

    values: np.ndarray
    outline: np.ndarray


@dataclass(frozen=True, eq=False)
class SpotTile:
    """Where rays land, (rays, 2) in µm from the chief ray, and the Airy radius."""

    points: np.ndarray
    airy_um: float


@dataclass(frozen=True, eq=False)
class Lines:
    """Curves over common positions, by their English names."""

    x: np.ndarray
    curves: Mapping[str, np.ndarray]


@dataclass(frozen=True, eq=False)
class MatrixTile:
    """One picture: what it shows, or ``why`` there is nothing to show.

    ``figure`` is its main figure, ``strehl`` the ratio of a sharp PSF (`figures` chooses for all pictures alike);
    ``method`` made it, ``settled`` or as a preview, and is predicted to miss ``error`` (1 − R²), None where nothing is
    predicted.
    """

    content: Light | WavefrontTile | SpotTile | Lines | None
    figure: Message = NO_WORDS
    method: str = ""
    error: float | None = None
    settled: bool = True
    why: Message | None = None
    strehl: Message | None = None


Tiles = tuple[tuple[MatrixTile, ...], ...]
"""Rows of columns."""


def refused_tile(why: Message) -> MatrixTile:
    """Return the place of a picture that cannot be."""
    return MatrixTile(None, why=why)


def scale_of(what: str, tile: MatrixTile) -> float:
    """Return the extent that shows a picture whole: width µm, half width µm, largest error, or highest frequency."""
    content = tile.content
    if isinstance(content, Light):
        return 2 * frame_of(content.circle).half_um
    if isinstance(content, SpotTile):
        apart = np.abs(content.points)
        return nice(1.1 * max(float(apart.max(initial=0.0)), 2 * content.airy_um, LEAST[what]), STEPS)
    if isinstance(content, WavefrontTile):
        return nice(max(_peak((content.values,)), LEAST[what]), SIGNED_STEPS)
    if isinstance(content, Lines):
        if what == "mtf":
            return float(content.x[-1])
        return nice(max(_peak(content.curves.values()), LEAST[what]), SIGNED_STEPS)
    return 0.0


def _peak(parts: Iterable[np.ndarray]) -> float:
    return max((float(np.nanmax(np.abs(part))) for part in parts if np.isfinite(part).any()), default=0.0)


def scales(what: str, tiles: Tiles, shared: bool) -> tuple[tuple[float, ...], ...]:
    """Return the scale of every picture, the largest of all where it is ``shared``; 0 where there is no picture."""
    own = tuple(tuple(scale_of(what, tile) for tile in row) for row in tiles)
    largest = max((scale for row in own for scale in row), default=0.0)
    return tuple(tuple(largest if scale else 0.0 for scale in row) for row in own) if shared else own


def peaks(tiles: Tiles, shared: bool) -> tuple[tuple[float, ...], ...]:
    """Return what the brightest sample of every picture is measured by: its own, or the brightest of all."""
    own = tuple(
        tuple(float(tile.content.painted.max()) if isinstance(tile.content, Light) else 0.0 for tile in row)
        for row in tiles
    )
    largest = max((peak for row in own for peak in row), default=0.0)
    return tuple(tuple(largest for _ in row) for row in own) if shared else own


def figures(tiles: Tiles) -> tuple[tuple[Message, ...], ...]:
    """Return a figure of every picture, of one quantity: the Strehl ratio where all are sharp, else the main figure."""
    known = all(tile.strehl is not None for row in tiles for tile in row if tile.content is not None)
    return tuple(tuple((known and tile.strehl) or tile.figure for tile in row) for row in tiles)


def worst(tiles: Tiles) -> float | None:
    """Return the largest predicted error of all pictures that have one."""
    return max((tile.error for row in tiles for tile in row if tile.error is not None), default=None)


def methods(tiles: Tiles) -> tuple[str, ...]:
    """Return which methods made the pictures, each once, in their order."""
    return tuple(dict.fromkeys(tile.method for row in tiles for tile in row if tile.method))
