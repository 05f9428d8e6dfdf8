"""Create the file of dispersion data from a copy of the refractiveindex.info database.

``python -m tests.long.collect_pages DATABASE RELEASE``, where DATABASE is the folder with ``catalog-nk.yml`` and
``data`` (of the database's repository, or of the package ``refractiveindex``) and RELEASE its name, such as
v2026-05-24. The database is in the public domain (CC0 1.0). Needs PyYAML.
"""

import gzip
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from p2sf.glass.pages import DATA, LONGEST_TABLE, SUPPLIERS, Kind

PAIRED = "1", "2", "3", "4", "5", "6"  # formulas with a constant and pairs of coefficients


def lines(database: Path) -> Iterator[str]:
    """Yield the line of every complete page: name, kind, wavelengths in µm and numbers, as in `pages.Page`."""
    for name, path in sorted(catalogue(database).items()):
        fields = page_fields(name, database / "data" / path)
        if fields[0] in PAIRED and len(fields[2].split()) % 2 == 0:
            print(f"{name} is skipped: a resonance or a power lacks its second coefficient", file=sys.stderr)
        else:
            yield "\t".join((name, *fields))


def catalogue(database: Path) -> dict[str, str]:
    """Return shelf/book/page → the path of its data; dividers, which have no such keys, are skipped."""
    return {
        f"{shelf['SHELF']}/{book['BOOK']}/{page['PAGE']}": page["data"]
        for shelf in _yaml(database / "catalog-nk.yml")
        for book in shelf.get("content", ())
        for page in book.get("content", ())
        if "PAGE" in page
    }


def page_fields(name: str, path: Path) -> tuple[str, ...]:
    """Return kind, wavelengths and numbers of a page in its file, in the digits of the database."""
    indices = [part for part in _yaml(path)["DATA"] if part["type"] != "tabulated k"]
    return _fields(name, indices[0]) if indices else (Kind.ABSORPTION,)


def _fields(name: str, part: dict[str, str]) -> tuple[str, ...]:
    """Return what `page_fields` does for one part of a page."""
    if part["type"].startswith("formula"):
        ends = part.get("wavelength_range") or part["range"]  # before 2023
        return part["type"].split()[1], ends, part["coefficients"]
    by_wavelength: dict[float, tuple[str, str]] = {}
    for wavelength, index, *_ in map(str.split, part["data"].strip().splitlines()):
        by_wavelength.setdefault(float(wavelength), (wavelength, index))  # some tables repeat a row
    points = [point for _, point in sorted(by_wavelength.items())]  # and some are not in order
    if len(points) > LONGEST_TABLE and not name.startswith(f"{SUPPLIERS}/"):
        return Kind.LEFT_OUT, "", str(len(points))
    step = max(1.0, (len(points) - 1) / (LONGEST_TABLE - 1))  # colour filters have 1801, with noise in the last digits
    kept = [points[round(k * step)] for k in range(min(len(points), LONGEST_TABLE))]
    return Kind.TABLE, *(" ".join(column) for column in zip(*kept, strict=True))


def _yaml(path: Path) -> Any:
    import yaml  # type: ignore[import-untyped]  # PyYAML has no annotations

    with open(path, encoding="utf-8") as handle:
        return yaml.load(handle, Loader=yaml.CBaseLoader)  # keeps every value as text


def main(database: str, release: str) -> None:
    """Write the file that the package ships; the same database gives the same bytes."""
    head = f"refractiveindex.info {release}, public domain (CC0 1.0)"
    text = "\n".join((head, *lines(Path(database)))) + "\n"
    DATA.write_bytes(gzip.compress(text.encode(), compresslevel=9, mtime=0))
    print(f"{text.count(chr(10)) - 1} pages, {len(text)} characters, {DATA.stat().st_size} bytes in {DATA}")


if __name__ == "__main__":
    main(*sys.argv[1:])
