"""Find a glass in the makers' catalogues by its name; an ambiguous name is an error that lists candidates.

The data are those of refractiveindex.info (`pages`), read on the first look-up.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache

from p2sf.errors import GlassError
from p2sf.glass.dispersion import LINES_UM, refractive_index
from p2sf.glass.pages import CATALOGUES, SUPPLIERS, GlassPage, Kind, page, page_names, pages_named
from p2sf.messages import Alternatives, Message

# Glasses of two makers with one name are the same glass if their indices agree to the last digit of a data sheet.
SAME_INDEX = 1e-5
PROBES_UM = (LINES_UM["F"], LINES_UM["d"], LINES_UM["C"])


@dataclass(frozen=True)
class CatalogueEntry:
    """One glass of one maker: how a lens file writes it, and its page for `dispersion.refractive_index`."""

    label: str
    page: GlassPage

    @property
    def range_um(self) -> tuple[float, float]:
        """Return the shortest and the longest wavelength of the data, µm."""
        return self.page.range_um


def find_entry(text: str) -> CatalogueEntry:
    """Return the glass named "MAKER NAME", "NAME", or "shelf/book/page" of refractiveindex.info.

    Case does not matter, and a name without its maker means a former glass only where nobody sells it now. Raises
    GlassError, naming candidates, for a name in no catalogue or one that several makers use for glasses of different
    indices.
    """
    words = text.split()
    if text.count("/") == 2:
        return _entry(text, text)
    if len(words) == 2 and (found := _of_maker(words[0].upper(), words[1], text)):
        return found
    name = "".join(words).upper()
    sold = {} if "/" in name else _by_key(pages_named(name))
    if not sold:
        raise GlassError(
            'glass "{name}" is in no catalogue; {suggestion}', name=text, suggestion=_suggestion(name, _labels())
        )
    current = {key: place for key, place in sold.items() if place.startswith(f"{SUPPLIERS}/")}
    return _unambiguous(text, [_entry(_label(*entry), entry[1]) for entry in (current or sold).items()])


def _of_maker(maker: str, name: str, text: str) -> CatalogueEntry | None:
    """Return a maker's glass; None where nobody of this name makes glass."""
    key = (maker, name.upper())
    place = _by_key(pages_named(name.upper())).get(key)
    if place is None and maker not in _makers():
        return None
    if place is None:
        of_maker = {label: k for label, k in _labels().items() if k[0] == maker}
        raise GlassError(
            'glass "{name}" is not in the catalogue of {maker}; {suggestion}',
            name=text,
            maker=maker,
            suggestion=_suggestion(name.upper(), of_maker),
        )
    return _entry(_label(key, place), place)


def _unambiguous(text: str, entries: list[CatalogueEntry]) -> CatalogueEntry:
    """Return the first of several glasses of one name if all are the same glass, else raise GlassError."""
    if len({_fingerprint(entry) for entry in entries}) > 1:
        raise GlassError(
            'glass "{name}" is sold with different indices as {glasses}; write the one you mean',
            name=text,
            glasses=tuple(map(_label_with_index, entries)),
        )
    return entries[0]


def _fingerprint(entry: CatalogueEntry) -> str | tuple[int, ...]:
    """Return rounded indices at F, d, C, or the label itself if the data do not include these lines."""
    low, high = entry.range_um
    if low > PROBES_UM[0] or high < PROBES_UM[-1]:
        return entry.label
    return tuple(round(float(refractive_index(entry.page, probe)) / SAME_INDEX) for probe in PROBES_UM)


def _label_with_index(entry: CatalogueEntry) -> Message:
    """Return a glass's label in quotation marks, with its nd if the data include the d line."""
    low, high = entry.range_um
    if not low <= LINES_UM["d"] <= high:
        return Message('"{glass}"', glass=entry.label)
    nd = float(refractive_index(entry.page, LINES_UM["d"]))
    return Message('"{glass}" (nd {nd:.6f})', glass=entry.label, nd=nd)


def _suggestion(name: str, labels: dict[str, tuple[str, str]]) -> Message:
    """Return "did you mean …?" with the labels whose name without the maker is similar to ``name``, in capitals."""
    from difflib import get_close_matches

    by_name: dict[str, list[str]] = {}
    for label, key in labels.items():
        by_name.setdefault(key[1], []).append(label)
    close = [name, *(f"{letters}{name}" for letters in ("N-", "S-", "K-", "H-"))]
    found = [n for n in close if n in by_name] or get_close_matches(name, by_name, 3, 0.6)
    choices = [label for n in found for label in by_name[n]][:4]
    if not choices:
        return Message('write maker and name as in "SCHOTT N-BK7", an index, or { nd = 1.5168, vd = 64.17 }')
    return Message("did you mean {glasses}?", glasses=Alternatives(choices))


@cache
def _shelf() -> dict[tuple[str, str], str]:
    """Return `_by_key` of all pages."""
    return _by_key(page_names())


def _by_key(names: Iterable[str]) -> dict[tuple[str, str], str]:
    """Return (MAKER, NAME) in capitals → shelf/book/page of the makers' glasses among pages, in their order.

    A glass of a maker's catalogue replaces that of the same name in the database.
    """
    sold = (name for name in names if name.startswith((f"{SUPPLIERS}/", f"{CATALOGUES}/")))
    return {(_maker(book), glass.upper()): f"{shelf}/{book}/{glass}" for shelf, book, glass in map(_parts, sold)}


def _parts(name: str) -> list[str]:
    return name.split("/")


def _maker(book: str) -> str:
    return book.split("-")[0].upper()


@cache
def _makers() -> frozenset[str]:
    return frozenset(maker for maker, _ in _shelf())


@cache
def _labels() -> dict[str, tuple[str, str]]:
    """Return "MAKER Name" as written in a lens file → (MAKER, NAME)."""
    return {_label(key, place): key for key, place in _shelf().items()}


def _label(key: tuple[str, str], place: str) -> str:
    return f"{key[0]} {_parts(place)[-1]}"


def glasses_by_maker() -> dict[str, list[str]]:
    """Return MAKER → the labels of its glasses, "MAKER Name", in the order of the catalogue."""
    table: dict[str, list[str]] = {}
    for label, (maker, _) in _labels().items():
        table.setdefault(maker, []).append(label)
    return table


def _entry(label: str, name: str) -> CatalogueEntry:
    """Return the page "shelf/book/page" under a label; GlassError if it has no index."""
    try:
        found = page(name)
    except KeyError:
        raise GlassError(
            'glass "{name}" is not among the shipped pages of refractiveindex.info; check shelf/book/page', name=label
        ) from None
    if found.kind == Kind.ABSORPTION:
        raise GlassError('glass "{name}" is listed with its absorption only; give its index or nd and vd', name=label)
    if found.kind == Kind.LEFT_OUT:
        raise GlassError(
            'glass "{name}" is a table of {count:d} points, too long to be shipped; '
            "write the points you need as {{ wavelengths_um = […], n = […] }}",
            name=label,
            count=int(found.numbers[0]),
        )
    return CatalogueEntry(label, found)
