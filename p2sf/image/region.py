"""Rectangles of pixels, of which a picture is formed one after the other."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from p2sf.errors import RequestError


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


def check_region(region: Region, every: Region) -> Region:
    """Return a region; RequestError unless it is a part of the picture."""
    if region.empty or region.meet(every) != region:
        raise RequestError(
            "{parameter} has the rows {top} to {bottom} and the columns {left} to {right}, but the picture {rows} rows "
            "and {columns} columns; give a part of it",
            parameter="region",
            rows=every.bottom,
            columns=every.right,
            **vars(region),
        )
    return region


def tiles(area: Region, side: int) -> Iterator[Region]:
    """Yield regions of nearly equal size, at most ``side`` pixels a side, that cover an area row by row."""
    ends = (area.top, area.bottom), (area.left, area.right)
    rows, columns = (np.linspace(*end, -(-(end[1] - end[0]) // side) + 1).round().astype(int).tolist() for end in ends)
    for top, bottom in pairwise(rows):
        for left, right in pairwise(columns):
            yield Region(top, bottom, left, right)
