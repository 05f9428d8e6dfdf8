"""Create the file of the glasses that refractiveindex.info lacks, from catalogues of their makers.

``python -m tests.long.collect_agf MAKER=PATH …``, where PATH is an AGF catalogue, or a folder of pages of an earlier
release of refractiveindex.info. Of two entries of one name the first counts; what the database has is left out, but for
the glasses in `REPLACED`. A catalogue is a list of measured numbers; its words are not taken over.
"""

import gzip
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from p2sf.glass.pages import CATALOGUES, DATA, MORE_DATA, SUPPLIERS, GlassPage
from p2sf.lensfile.agf import FormulaGlass, read_agf, refractive_index
from p2sf.lensfile.glass_lookup import DAMAGED_ND, key, nd_of
from tests.long.collect_pages import page_fields

# Glasses whose page is a short table, or an edition before the maker's present one.
REPLACED = {("SCHOTT", "B270"), ("SUMITA", "KGIR79")}
# Misprints, which break the smooth course of their tables: of a maker's table without them the rest is right.
MISPRINTS_UM = {"CTK8": (1.5296,), "TK9": (0.8521,), "F8": (0.514, 0.5208, 0.53)}
# The database ends this formula at 0.7 µm, the catalogue of its maker at 1.06 µm.
RANGES_UM = {("SCHOTT", "LF7"): (0.334, 1.06)}
LEAST_INDEX = 0.99  # of vacuum relative to air, and less than that of any solid
HEAD = "catalogues of glass makers (AGF), and earlier releases of refractiveindex.info (CC0 1.0)"
POLYNOMIALS = {1: (2, -2, -4, -6, -8), 10: (2, -2, -4, -6, -8, -10, -12), 12: (2, -2, -4, -6, -8, 4, 6)}
POLYNOMIALS[13] = (2, 4, -2, -4, -6, -8, -10, -12)
RESONANCES = {2: 3, 6: 4, 11: 5}


def read_lines(path: Path) -> tuple[str, dict[str, bytes]]:
    """Return the first line of a file of pages, and shelf/book/page → the rest of its line, not yet decoded."""
    head, *lines = gzip.decompress(path.read_bytes()).splitlines()
    return head.decode(), {name.decode(): rest for name, _, rest in (line.partition(b"\t") for line in lines)}


def page_of(formula: int, c: Sequence[float]) -> tuple[str, tuple[float, ...]]:
    """Return kind and numbers of the page that gives the index of an AGF formula (`agf`); ValueError for others."""
    c = (*c, *[0.0] * (12 - len(c)))
    if formula in POLYNOMIALS:
        return "3", _pairs(c[0], zip(c[1:], POLYNOMIALS[formula], strict=False))
    if formula in RESONANCES:
        return "2", _pairs(0.0, zip(c[: 2 * RESONANCES[formula] : 2], c[1::2], strict=False))
    match formula:
        case 3:
            return "7", c[:6]
        case 4:
            return "4", (1 + c[0], c[1], 2.0, c[2], 2.0, c[3], 0.0, c[4], 2.0)
        case 5:
            return "5", (c[0], c[1], -1.0, c[2], -3.5)
        case 7 | 8:
            return "4", (c[0], c[1], 0.0 if formula == 7 else 2.0, c[2], 1.0, 0.0, 0.0, 0.0, 1.0, -c[3], 2.0)
        case 9:
            return "2", (c[0] - 1, *c[1:5])
    raise ValueError(f"formula {formula} is none of AGF's")


def _pairs(first: float, pairs: Iterator[tuple[float, float]]) -> tuple[float, ...]:
    return (first, *(number for pair in pairs if pair[0] for number in pair))


def _agf_line(maker: str, glass: FormulaGlass) -> str:
    kind, numbers = page_of(glass.formula, glass.coefficients)
    return _line(f"{CATALOGUES}/{maker}/{glass.name}", GlassPage(kind, glass.range_um, numbers))


def _line(name: str, page: GlassPage) -> str:
    lists = (" ".join(f"{number:.12g}" for number in numbers) for numbers in (page.wavelengths_um, page.numbers))
    return "\t".join((name, page.kind, *lists))


def _found(maker: str, path: Path) -> Iterator[tuple[str, str]]:
    """Yield the name and the line of every glass of a catalogue or a folder of pages."""
    if path.is_dir():
        for each in sorted(path.glob("*.yml")):
            yield each.stem, "\t".join((f"{CATALOGUES}/{maker}/{each.stem}", *page_fields(each.stem, each)))
    else:
        for glass in filter(_plausible, read_agf(path).glasses.values()):
            yield glass.name, _agf_line(maker, glass)


def _plausible(glass: FormulaGlass) -> bool:
    """Return whether an entry has an index all over its range, and at d that which it lists."""
    index = refractive_index(glass.formula, glass.coefficients, np.linspace(*glass.range_um, 50))
    nd = nd_of(glass)
    listed = glass.listed_nd or 1.0  # 1 where the catalogue has none
    return bool(index.min() > LEAST_INDEX) and (nd is None or listed == 1 or abs(nd - listed) < DAMAGED_ND)


def _without_misprints(known: dict[str, bytes]) -> Iterator[str]:
    """Yield the tables of LZOS that have misprints, without them."""
    for name, wrong in MISPRINTS_UM.items():
        kind, *lists = known[f"{SUPPLIERS}/LZOS-optical/{name}"].decode().split("\t")
        waves, values = (tuple(map(float, each.split())) for each in lists)
        kept = [pair for pair in zip(waves, values, strict=True) if pair[0] not in wrong]
        columns = zip(*kept, strict=True)
        yield _line(f"{CATALOGUES}/LZOS/{name}", GlassPage(kind, *columns))


def _with_whole_ranges(known: dict[str, bytes]) -> Iterator[str]:
    """Yield the formulas whose range in the database is too short."""
    for (maker, name), ends in RANGES_UM.items():
        kind, _, numbers = known[f"{SUPPLIERS}/{maker}-optical/{name}"].decode().split("\t")
        yield _line(f"{CATALOGUES}/{maker}/{name}", GlassPage(kind, ends, tuple(map(float, numbers.split()))))


def lines(arguments: Sequence[str]) -> Iterator[str]:
    """Yield the line of every glass that the database lacks."""
    known = read_lines(DATA)[1]
    sold = {(book.split("-")[0].upper(), key(name)) for _, book, name in (each.split("/") for each in known)}
    sold -= REPLACED
    yield from _without_misprints(known)
    yield from _with_whole_ranges(known)
    for maker, path in (argument.split("=", 1) for argument in arguments):
        for name, line in _found(maker, Path(path)):
            if (maker, key(name)) not in sold:
                sold.add((maker, key(name)))
                yield line


def main(arguments: Sequence[str]) -> None:
    """Write the file beside that of the database; the same catalogues give the same bytes."""
    found = sorted(dict.fromkeys(lines(arguments)))
    MORE_DATA.write_bytes(gzip.compress(("\n".join((HEAD, *found)) + "\n").encode(), compresslevel=9, mtime=0))
    print(f"{len(found)} pages, {MORE_DATA.stat().st_size} bytes in {MORE_DATA}")


if __name__ == "__main__":
    main(sys.argv[1:])
