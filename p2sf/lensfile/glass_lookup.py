"""From the name of a glass in a file to its dispersion data, in this order, exact glasses before substitutes.

Exact, taken without asking:
1. a private glass that the file itself defines;
2. the user's AGF catalogues that the file names, in the file's order; all of them if it names none;
3. the built-in makers' table, for the makers the file names, in the file's order;
   hyphens, spaces and case do not count ("NBK7" is "N-BK7");
4. fused silica by its common names (I. H. Malitson, J. Opt. Soc. Am. 55, 1205, 1965), and a crystal by the page of
   refractiveindex.info that stands in the maker's place ("CAF2_DAIMON-20" is main/CaF2/Daimon-20);
5. where the file names no known maker: the glass of that name, by the first of `USUAL_MAKERS` that sells it; the report
   says so where another maker's of that name has other indices.

Substitutes, offered in the error and taken when the user accepts them:
6. its successor (N-, S-, …) from a named maker, then from any;
7. nd and vd that the file has beside the name.
"""

import re
from dataclasses import dataclass, field
from functools import cache
from math import nan

from p2sf.errors import GlassError
from p2sf.glass.catalogue import SAME_INDEX, find_entry, glasses_by_maker
from p2sf.glass.dispersion import LINES_UM
from p2sf.glass.media import CatalogueGlass, Medium, catalogue_glass, constant_index, model_glass
from p2sf.glass.pages import page_names
from p2sf.lensfile.agf import Catalogue, FormulaGlass
from p2sf.lensfile.raw import RawGlass
from p2sf.messages import Message

# A catalogue whose coefficients miss its own listed nd by more than this is damaged (sound ones: 4e-5).
DAMAGED_ND = 1e-3
# The makers that prescriptions mean most often come first; an index-matching liquid is not a lens glass.
USUAL_MAKERS = ("SCHOTT", "OHARA", "HOYA", "HIKARI", "SUMITA", "CDGM", "CORNING", "LZOS")
OTHER_NAMES = {"NIKON": "HIKARI"}  # of a maker, as catalogues call it
NO_GLASS = ("CARGILLE",)
SILICA = ("SILICA", "FSILICA", "FUSEDSILICA", "SIO2", "F_SILICA")


@dataclass(frozen=True)
class GlassSources:
    """Where glasses come from: the user's catalogues, the file's private glasses, and substitutes if accepted."""

    catalogues: tuple[Catalogue, ...] = ()
    private: dict[str, Medium] = field(default_factory=dict)
    accept_substitutes: bool = False


@dataclass(frozen=True)
class Resolution:
    """A medium, and a sentence for the report where it is not exactly what the file names.

    ``choice``: where several makers sell the name with different indices, whose is taken, and how far others are off.
    """

    medium: Medium
    substitution: Message | None = None
    choice: Message | None = None


def resolve(glass: RawGlass, sources: GlassSources) -> Resolution:
    """Return the medium of a glass; GlassError, naming substitutes, for one that is not found exactly."""
    if glass.medium is not None:
        return Resolution(glass.medium)
    if glass.index is not None:
        return Resolution(constant_index(glass.index))
    if glass.model is not None:
        return Resolution(model_glass(*glass.model))
    exact = _exact(glass, sources)
    if exact is not None:
        return Resolution(exact)
    sold = None if _builtin_makers(glass.makers) else _sold_by_anyone(glass)
    return sold or _substitute(glass, sources)


def key(name: str) -> str:
    """Return a glass name without hyphens, spaces, underscores and case, in which spellings differ."""
    return re.sub(r"[^A-Z0-9+()]", "", name.upper())


def stem(name: str) -> str:
    """Return a glass name without its maker's prefix ("N-SF11" → "SF11") and without a suffix after "_"."""
    return key(re.sub(r"^[A-Z]{1,2}-", "", name.upper().split("_")[0]))


def _exact(glass: RawGlass, sources: GlassSources) -> Medium | None:
    private = {key(name): medium for name, medium in sources.private.items()}
    if key(glass.name) in private:
        return private[key(glass.name)]
    return (
        _from_catalogues(glass, sources.catalogues)
        or _from_makers(glass.name, glass.makers)
        or _silica(glass.name)
        or _from_pages(glass)
    )


def _from_catalogues(glass: RawGlass, catalogues: tuple[Catalogue, ...]) -> FormulaGlass | None:
    """Return the glass from the user's AGF files: those that the file names, in its order, or all."""
    ordered = [c for maker in glass.makers for c in catalogues if _same_maker(maker, c.name)]
    if not ordered and not _builtin_makers(glass.makers):
        ordered = list(catalogues)
    for catalogue in ordered:
        found = catalogue.glasses.get(glass.name.upper()) or _by_key(catalogue).get(key(glass.name))
        if found is not None:
            return _sound(found, catalogue)
    return None


def _by_key(catalogue: Catalogue) -> dict[str, FormulaGlass]:
    return {key(name): glass for name, glass in reversed(catalogue.glasses.items())}


def _sound(glass: FormulaGlass, catalogue: Catalogue) -> FormulaGlass:
    """Return the glass if its coefficients give the nd listed beside them, else raise GlassError."""
    nd = nd_of(glass)
    if glass.listed_nd and glass.listed_nd > 1.01 and nd and abs(nd - glass.listed_nd) > DAMAGED_ND:
        raise GlassError(
            "glass {name} of {path} has nd {nd:.5f} by its coefficients and {listed:.5f} by its name line; "
            "the catalogue is damaged, replace it",
            name=glass.name,
            path=catalogue.path,
            nd=nd,
            listed=glass.listed_nd,
        )
    return glass


def _same_maker(named: str, maker: str) -> bool:
    """Return whether a catalogue name such as SUMITA_AUG2011, SCHOTT-1 or OLD_SCHO means this maker."""
    first, *others = re.split(r"[^A-Z]", named.upper())
    known = re.split(r"[^A-Z]", maker.upper())[0]
    if first == "OLD" and others and len(others[0]) > 3:
        return known.startswith(others[0])
    return first != "" and known in (first, OTHER_NAMES.get(first))


@cache
def _shelf() -> dict[str, dict[str, str]]:
    """Return maker → (key of the name → label) of the built-in table."""
    table: dict[str, dict[str, str]] = {}
    for maker, labels in glasses_by_maker().items():
        names = table.setdefault(maker, {})
        for label in labels:
            names.setdefault(key(label.removeprefix(f"{maker} ")), label)
    return table


def _builtin_makers(makers: tuple[str, ...]) -> list[str]:
    """Return the makers of the built-in table among those that a file names, in its order."""
    return [maker for named in makers for maker in _shelf() if _same_maker(named, maker)]


def _from_makers(name: str, makers: tuple[str, ...]) -> Medium | None:
    for maker in _builtin_makers(makers):
        label = _shelf()[maker].get(key(name))
        if label:
            return _refractive(label)
    return None


def _refractive(label: str) -> Medium | None:
    """Return a catalogue glass, None where the table lists its absorption only."""
    try:
        return catalogue_glass(label)
    except GlassError:
        return None


def _silica(name: str) -> Medium | None:
    return CatalogueGlass(find_entry("main/SiO2/Malitson")) if key(name) in map(key, SILICA) else None


def _from_pages(glass: RawGlass) -> Medium | None:
    """Return the glass of a page "main/name/maker" of refractiveindex.info; None where there is none."""
    for maker in glass.makers:
        wanted = f"main/{glass.name}/{maker}".lower()
        found = next((name for name in page_names() if name.lower() == wanted), None)
        if found:
            return _refractive(found)
    return None


def _sold_by_anyone(glass: RawGlass) -> Resolution | None:
    """Return the glass of this name by the first of its sellers, None where nobody sells it."""
    order = dict.fromkeys([*USUAL_MAKERS, *_shelf()])
    labels = [_shelf()[maker][key(glass.name)] for maker in order if key(glass.name) in _shelf()[maker]]
    found = [medium for label in labels if (medium := _refractive(label))]
    if not found:
        return None
    first, *others = found
    differences = [_differences(each, first) for each in others]
    place = max(range(len(others)), key=lambda k: max(map(abs, differences[k])), default=0)
    if not others or max(map(abs, differences[place])) <= SAME_INDEX:
        return Resolution(first)
    f_line, d_line, c_line = differences[place]
    told = (
        "glass {name} is sold with different indices, and the file does not say by whom; {taken} is taken, from which "
        "{other} differs by {f_line:+.5f}, {d_line:+.5f}, {c_line:+.5f} at F, d and C"
    )
    names = {"name": glass.name, "taken": first.label, "other": others[place].label}
    return Resolution(first, choice=Message(told, **names, f_line=f_line, d_line=d_line, c_line=c_line))


def _differences(medium: Medium, other: Medium) -> tuple[float, float, float]:
    """Return the differences in index at F, d and C, 0 where one of the two has no data."""
    at = [(index_at(medium, line), index_at(other, line)) for line in "FdC"]
    f_line, d_line, c_line = (one - two if one and two else 0.0 for one, two in at)
    return f_line, d_line, c_line


def _substitute(glass: RawGlass, sources: GlassSources) -> Resolution:
    offers = _offers(glass)
    asked = (
        Message('glass "{name}" of {makers}', name=glass.name, makers=glass.makers)
        if glass.makers
        else Message('glass "{name}"', name=glass.name)
    )
    if not offers and glass.beside:
        nd, vd = glass.beside
        if sources.accept_substitutes:
            told = "{glass} is not known; nd {nd:g} and vd {vd:g}, which the file has beside its name, are taken"
            return Resolution(model_glass(nd, vd), Message(told, glass=asked, nd=nd, vd=vd))
        told = "{glass} is in no catalogue; accept nd {nd:g} and vd {vd:g} of the same line, or give its AGF catalogue"
        raise GlassError(told, glass=asked, nd=nd, vd=vd)
    if not offers:
        raise GlassError("{glass} is in no catalogue; give its AGF catalogue, or its index as nd and vd", glass=asked)
    if not sources.accept_substitutes:
        raise GlassError(
            "{glass} is in no catalogue given; accept a substitute ({offers}) or give its AGF catalogue",
            glass=asked,
            offers=tuple(map(_with_index, offers)),
        )
    told = "{glass} replaced by {substitute}; the file does not tell the index it wants"
    return Resolution(offers[0], Message(told, glass=asked, substitute=_with_index(offers[0])))


def _with_index(medium: Medium) -> Message:
    return Message("{glass} (nd {nd:.5f})", glass=medium.label, nd=nd_of(medium) or nan)


def _offers(glass: RawGlass) -> list[Medium]:
    """Return up to four substitutes that have an index at the d line."""
    found = [medium for label in _equivalents(glass) if (medium := _refractive(label))]
    return [medium for medium in found if nd_of(medium)][:4]


def _equivalents(glass: RawGlass) -> list[str]:
    """Return the labels of glasses of the same name, then of the same stem; named makers come first."""
    makers = [m for m in dict.fromkeys([*_builtin_makers(glass.makers), *USUAL_MAKERS, *_shelf()]) if m not in NO_GLASS]
    same = [_shelf()[maker][key(glass.name)] for maker in makers if key(glass.name) in _shelf()[maker]]
    follows = [label for maker in makers for label in _stems(maker).get(stem(glass.name), ())]
    return list(dict.fromkeys([*same, *follows]))


@cache
def _stems(maker: str) -> dict[str, tuple[str, ...]]:
    """Return stem → labels of one maker."""
    table: dict[str, tuple[str, ...]] = {}
    for label in _shelf()[maker].values():
        table[stem(label.split()[1])] = (*table.get(stem(label.split()[1]), ()), label)
    return table


def index_at(medium: Medium, line: str) -> float | None:
    """Return the index at a line of `LINES_UM`, None where the data do not reach it."""
    try:
        return float(medium.index(LINES_UM[line]))
    except GlassError:
        return None


def nd_of(medium: Medium) -> float | None:
    """Return the index at the d line, None where the data do not reach it."""
    return index_at(medium, "d")
