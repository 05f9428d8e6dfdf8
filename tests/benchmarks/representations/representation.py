"""What every representation offers, and the exact PSFs from which some are made and by which all are judged."""

from collections.abc import Callable
from dataclasses import dataclass, field
from time import process_time

import numpy as np

from p2sf.disc.quadrature import SETTLED_TOLERANCE
from p2sf.lens.source import Source
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.traced import traced_psf
from tests.benchmarks.representations.space import LensSpace, SpacePoints

KEY_DIGITS = 9  # of a place's coordinates, by which a PSF is remembered


@dataclass(frozen=True, eq=False)
class Representation:
    """All PSFs of a space in one form.

    ``family``: what it is; ``settings``: how it was made, in words; ``numbers``: how many it keeps for the whole
    space; ``nbytes``: how much memory they take; ``seconds``: CPU time to make it; ``psf``: Points (n) to unit-sum
    pictures (n, pixels, pixels).
    """

    family: str
    settings: str
    numbers: int
    nbytes: int
    seconds: float
    psf: Callable[[SpacePoints], np.ndarray]


@dataclass(eq=False)
class ExactPsfs:
    """Exact PSFs of a space by the `traced` method, each computed once; ``seconds`` counts the CPU time of each."""

    space: LensSpace
    _pictures: dict[tuple[float, ...], np.ndarray] = field(default_factory=dict)
    _spent: float = 0.0

    def at(self, points: SpacePoints) -> np.ndarray:
        """Return unit-sum pictures, (n, pixels, pixels)."""
        keys = [tuple(place) for place in np.round(points.cube, KEY_DIGITS).tolist()]
        for key, source in zip(keys, points.sources(), strict=True):
            if key not in self._pictures:
                started = process_time()
                self._pictures[key] = traced_picture(self.space, source).astype(np.float32)
                self._spent += process_time() - started
        return np.stack([self._pictures[key] for key in keys])

    @property
    def seconds(self) -> float:
        """Return the mean CPU time of one exact PSF."""
        return self._spent / max(1, len(self._pictures))


def traced_picture(space: LensSpace, source: Source) -> np.ndarray:
    """Return one picture by exact rays, (pixels, pixels)."""
    return space.window.light(traced_psf(space.lens, source, *space.window.fine).values)


def huygens_picture(space: LensSpace, source: Source, rtol: float = SETTLED_TOLERANCE) -> np.ndarray:
    """Return one picture by the Huygens sum whose two last node counts agree to ``rtol``, (pixels, pixels)."""
    return space.window.light(huygens_psf(space.lens, source, *space.window.fine, rtol=rtol).values)


def clipped_to_unit_sum(values: np.ndarray) -> np.ndarray:
    """Return pictures (n, y, x) without negative light and of unit sum: an interpolation may undershoot."""
    light = np.maximum(values, 0.0)
    unit: np.ndarray = light / np.maximum(light.sum((-2, -1), keepdims=True), np.finfo(float).tiny)
    return unit


def right_half(pictures: np.ndarray) -> np.ndarray:
    """Return the columns from x = 0 on, (n, y, pixels − pixels//2), flat per picture, and the outermost at −x.

    A PSF of a field along y is even in x, so half of it is all.
    """
    half = np.roll(pictures, -(pictures.shape[-1] // 2), axis=-1)[..., : pictures.shape[-1] // 2 + 1]
    return np.ascontiguousarray(half).reshape(len(pictures), -1)


def mirror_halves(halves: np.ndarray, pixels: int) -> np.ndarray:
    """Return pictures (n, pixels, pixels) from what `right_half` keeps of them."""
    half = halves.reshape(len(halves), pixels, pixels // 2 + 1)
    column = np.abs(np.arange(pixels) - pixels // 2)
    return half[..., column]
