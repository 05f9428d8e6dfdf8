"""The pages of refractiveindex.info that the package ships: a formula with its coefficients, or a table, per material.

One compressed text file contains them in decimal, as the database does, so that coefficients have double precision. It
is read on the first look-up; a page is parsed when it is requested. A second one has former and moulded glasses
that the database lacks, from catalogues of their makers. `tests.long.collect_pages` and `collect_agf` create them.
"""

import gzip
import re
from collections.abc import Iterator
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


@cache
def _heads_and_text() -> tuple[str, bytes]:
    """Return the first lines of both files, and all others as one text, each between line feeds."""
    parts = [gzip.decompress(path.read_bytes()).partition(b"\n") for path in (DATA, MORE_DATA)]
    return "; ".join(head.decode() for head, _, _ in parts), b"\n" + b"".join(lines for _, _, lines in parts)


@cache
def _names() -> bytes:
    """Return "shelf/book/page" of every page in their order, each between line feeds."""
    return b"\n".join([b"", *re.findall(rb"\n([^\t]+)\t", _heads_and_text()[1]), b""])


@cache
def _in_capitals() -> bytes:
    """Return the names in capitals; they are in ASCII, so that every letter keeps its place."""
    return _names().upper()


def pages_named(name: str) -> Iterator[str]:
    """Yield every "shelf/book/page" with this page, in capitals, without a list of all 4000."""
    mark, at = f"/{name}\n".encode(), -1
    while (at := _in_capitals().find(mark, at + 1)) >= 0:
        yield _names()[_names().rfind(b"\n", 0, at) + 1 : at + len(mark) - 1].decode()


def page_names() -> tuple[str, ...]:
    """Return "shelf/book/page" of every page, those of the database first, each sorted."""
    return tuple(dict.fromkeys(_names().decode().split("\n")[1:-1]))


def page(name: str) -> GlassPage:
    """Return the page "shelf/book/page"; KeyError if there is none."""
    text, mark = _heads_and_text()[1], f"\n{name}\t".encode()
    at = text.rfind(mark)
    if at < 0:
        raise KeyError(name)
    begin = at + len(mark)
    kind, *lists = text[begin : text.index(b"\n", begin)].decode().split("\t")
    return GlassPage(kind, *(tuple(map(float, numbers.split())) for numbers in lists))


def data_version() -> str:
    """Return the sources of the pages: the release of the database with its licence, and the catalogues."""
    return _heads_and_text()[0]
