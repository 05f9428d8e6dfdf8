"""The pages of refractiveindex.info that the package ships: a formula with its coefficients, or a table, per material.

One compressed text file contains them in decimal, as the database does, so that coefficients have double precision. It
is read on the first look-up; a page is parsed when it is requested. A second one has former and moulded glasses
that the database lacks, from catalogues of their makers. `tests.long.collect_pages` and `collect_agf` create them.
"""

import gzip
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from pathlib import Path

DATA = Path(__file__).with_name("refractiveindex_info.tsv.gz")
MORE_DATA = Path(__file__).with_name("makers_catalogues.tsv.gz")
LONGEST_TABLE = 200  # points; a longer table of a supplier is thinned evenly, one from research omitted
SUPPLIERS = "specs"  # the shelf of the makers' data sheets
CATALOGUES = "catalogues"  # the shelf of what is in their catalogues and not in the database


class Kind(StrEnum):
    """Kinds of pages besides the formulas "1" to "9" of refractiveindex.info."""

    TABLE = "table"
    ABSORPTION = "absorption"
    LEFT_OUT = "left out"


@dataclass(frozen=True)
class GlassPage:
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


def read_lines(path: Path) -> tuple[str, dict[str, bytes]]:
    """Return the first line of a file of pages, and shelf/book/page → the rest of its line, not yet decoded."""
    head, *lines = gzip.decompress(path.read_bytes()).splitlines()
    return head.decode(), {name.decode(): rest for name, _, rest in (line.partition(b"\t") for line in lines)}


@cache
def _lines() -> tuple[str, dict[str, bytes]]:
    """Return what `read_lines` does for both files together."""
    (head, database), (more, catalogues) = map(read_lines, (DATA, MORE_DATA))
    return f"{head}; {more}", database | catalogues


def page_names() -> tuple[str, ...]:
    """Return "shelf/book/page" of every page, those of the database first, each sorted."""
    return tuple(_lines()[1])


def page(name: str) -> GlassPage:
    """Return the page "shelf/book/page"; KeyError if there is none."""
    kind, *lists = _lines()[1][name].decode().split("\t")
    return GlassPage(kind, *(tuple(map(float, numbers.split())) for numbers in lists))


def data_version() -> str:
    """Return the sources of the pages: the release of the database with its licence, and the catalogues."""
    return _lines()[0]
