"""The pages of refractiveindex.info that the package ships: a formula with its coefficients, or a table, per material.

One compressed text file contains them in decimal, as the database does, so that coefficients have double precision. It
is read on the first look-up; a page is parsed when it is requested. `collect` creates the file.
"""

import gzip
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from pathlib import Path

DATA = Path(__file__).with_name("refractiveindex_info.tsv.gz")
LONGEST_TABLE = 200  # points; a longer table of a supplier is thinned evenly, one from research omitted
SUPPLIERS = "specs"  # the shelf of the makers' data sheets


class Kind(StrEnum):
    """Kinds of pages besides the formulas "1" to "9" of refractiveindex.info."""

    TABLE = "table"
    ABSORPTION = "absorption"
    LEFT_OUT = "left out"


@dataclass(frozen=True)
class Page:
    """The index of one material: ``kind`` is a formula's number or a `Kind`.

    ``numbers`` are the coefficients of a formula in the order of refractiveindex.info, or the indices of a table at
    ``wavelengths_um``, ascending; for an omitted table, its number of points.
    """

    kind: str
    wavelengths_um: tuple[float, ...] = ()  # for a formula: the ends of its range
    numbers: tuple[float, ...] = ()

    @property
    def range_um(self) -> tuple[float, float]:
        """Return the shortest and the longest wavelength of the data, µm."""
        return self.wavelengths_um[0], self.wavelengths_um[-1]


@cache
def _lines() -> tuple[str, dict[str, bytes]]:
    """Return the first line of the file, and shelf/book/page → the rest of its line, not yet decoded."""
    head, *lines = gzip.decompress(DATA.read_bytes()).splitlines()
    return head.decode(), {name.decode(): rest for name, _, rest in (line.partition(b"\t") for line in lines)}


def page_names() -> tuple[str, ...]:
    """Return "shelf/book/page" of every page, sorted."""
    return tuple(_lines()[1])


def page(name: str) -> Page:
    """Return the page "shelf/book/page"; KeyError if there is none."""
    kind, *lists = _lines()[1][name].decode().split("\t")
    return Page(kind, *(tuple(map(float, numbers.split())) for numbers in lists))


def data_version() -> str:
    """Return the release of the database from which the file was created, and its licence."""
    return _lines()[0]
