"""Rectangles of pixels, of which a picture is formed one after the other."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np


@dataclass(frozen=True)
class Region:
    """The pixels of rows from ``top`` to before ``bottom`` and columns from ``left`` to before ``right``.

    It may reach beyond the picture, to negative rows and columns.
    """

    top: int
    bottom: int
    left: int
    right: int

    @property
    def shape(self) -> tuple[int, int]:
        """Return the numbers of rows and columns."""
        return self.bottom - self.top, self.right - self.left

    @property
    def empty(self) -> bool:
        """Return whether there is no pixel."""
        return self.bottom <= self.top or self.right <= self.left

    @property
    def rows(self) -> np.ndarray:
        """Return the rows."""
        return np.arange(self.top, self.bottom)

    @property
    def columns(self) -> np.ndarray:
        """Return the columns."""
        return np.arange(self.left, self.right)

    def grown(self, pixels: int) -> "Region":
        """Return the region with ``pixels`` more on every side."""
        return Region(self.top - pixels, self.bottom + pixels, self.left - pixels, self.right + pixels)

    def meet(self, other: "Region") -> "Region":
        """Return what both hold."""
        return Region(
            max(self.top, other.top),
            min(self.bottom, other.bottom),
            max(self.left, other.left),
            min(self.right, other.right),
        )

    def within(self, other: "Region") -> tuple[slice, slice]:
        """Return where this region lies in an array over another that holds it."""
        down, right = self.top - other.top, self.left - other.left
        return slice(down, down + self.shape[0]), slice(right, right + self.shape[1])


def whole(shape: tuple[int, ...]) -> Region:
    """Return the region of a picture of this shape, (rows, columns, …)."""
    return Region(0, shape[0], 0, shape[1])


def tiles(shape: tuple[int, ...], side: int) -> Iterator[Region]:
    """Yield regions of nearly equal size, at most ``side`` pixels a side, that cover a picture row by row."""
    rows, columns = (np.linspace(0, n, -(-n // side) + 1).round().astype(int).tolist() for n in shape[:2])
    for top, bottom in pairwise(rows):
        for left, right in pairwise(columns):
            yield Region(top, bottom, left, right)
