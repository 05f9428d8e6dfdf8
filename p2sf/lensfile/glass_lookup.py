"""From the name of a glass in a file to its dispersion data, in this order, exact glasses before substitutes.

Exact, taken without asking:
1. a private glass that the file itself defines;
2. the user's AGF catalogues that the file names, in the file's order; all of them if it names none;
3. the built-in makers' table, for the makers the file names, in the file's order;
   hyphens, spaces and case do not count ("NBK7" is "N-BK7");
4. fused silica by its common names (I. H. Malitson, J. Opt. Soc. Am. 55, 1205, 1965), and a crystal by the page of
   refractiveindex.info that stands in the maker's place ("CAF2_DAIMON-20" is main/CaF2/Daimon-20);
5. where the file names no known maker: the glass of that name, if the indices of all its sellers agree.

Substitutes, offered in the error and taken when the user accepts them:
6. its successor (N-, S-, …) from a named maker, then from any.
"""

import re
from dataclasses import dataclass, field
from functools import cache

from p2sf.errors import GlassError
from p2sf.glass.catalogue import find_entry, glasses_by_maker
from p2sf.glass.dispersion import LINES_UM
from p2sf.glass.media import CatalogueGlass, Medium, catalogue_glass, constant_index, model_glass
from p2sf.glass.pages import page_names
from p2sf.lensfile.agf import Catalogue, FormulaGlass
from p2sf.lensfile.raw import RawGlass
from p2sf.messages import Message

# nd and vd of Schott's former glasses, from old data sheets.
OBSOLETE: dict[str, tuple[float, float]] = {
    "BAF3": (1.58267, 46.47),
    "BAF4": (1.60562, 43.93),
    "BAF51": (1.65224, 44.93),
    "BAF52": (1.60859, 46.44),
    "BAF8": (1.62374, 47.0),
    "BAK1": (1.5725, 57.55),
    "BAK2": (1.53996, 59.71),
    "BAK4": (1.56883, 56.13),
    "BAK5": (1.55671, 58.65),
    "BALF4": (1.57957, 53.71),
    "BALF5": (1.54739, 53.63),
    "BASF12": (1.66998, 39.2),
    "BASF2": (1.66446, 35.83),
    "BASF6": (1.66755, 41.93),
    "BK10": (1.49782, 66.95),
    "BK6": (1.53113, 62.15),
    "BK7": (1.5168, 64.17),
    "BK8": (1.52015, 63.69),
    "F1": (1.62588, 35.7),
    "F13": (1.62237, 36.04),
    "F3": (1.61293, 37.04),
    "F4": (1.61659, 36.63),
    "F6": (1.63636, 35.34),
    "F7": (1.62536, 35.56),
    "F8": (1.59551, 39.18),
    "FK5": (1.48749, 70.41),
    "FK51": (1.48656, 84.47),
    "K11": (1.50013, 61.44),
    "K3": (1.51823, 58.98),
    "K5": (1.52249, 59.48),
    "K50": (1.52257, 60.18),
    "KF6": (1.51742, 52.2),
    "KF9": (1.52341, 51.49),
    "KZFS8": (1.72047, 34.61),
    "LAF2": (1.744, 44.72),
    "LAF3": (1.717, 47.96),
    "LAF9": (1.79504, 28.39),
    "LAK10": (1.72, 50.41),
    "LAK11": (1.6583, 57.26),
    "LAK21": (1.6405, 60.1),
    "LAK8": (1.713, 53.83),
    "LAK9": (1.691, 54.71),
    "LLF2": (1.54072, 47.17),
    "LLF6": (1.53172, 48.76),
    "PK1": (1.50378, 66.92),
    "PK2": (1.51821, 65.05),
    "PK3": (1.52542, 64.66),
    "PSK3": (1.55232, 63.46),
    "PSK53A": (1.62014, 63.48),
    "SF12": (1.64831, 33.84),
    "SF13": (1.74077, 27.6),
    "SF19": (1.6668, 33.01),
    "SF8": (1.68893, 31.18),
    "SF9": (1.65446, 33.65),
    "SK10": (1.6228, 56.9),
    "SK11": (1.56384, 60.8),
    "SK12": (1.58313, 59.45),
    "SK14": (1.60311, 60.6),
    "SK15": (1.62299, 58.06),
    "SK16": (1.62041, 60.32),
    "SK2": (1.60738, 56.65),
    "SK4": (1.61272, 58.63),
    "SK5": (1.58913, 61.27),
    "SK7": (1.60729, 59.46),
    "SSK1": (1.6172, 53.91),
    "SSK2": (1.6223, 53.15),
    "SSK3": (1.61484, 51.16),
    "ZK1": (1.53315, 57.98),
}


# A catalogue whose coefficients miss its own listed nd by more than this is damaged (sound ones: 4e-5).
DAMAGED_ND = 1e-3
# The makers that old prescriptions mean most often come first; an index-matching liquid is not a lens glass.
USUAL_MAKERS = ("SCHOTT", "OHARA", "HOYA", "HIKARI", "SUMITA", "CDGM")
NO_GLASS = ("CARGILLE",)
# A glass whose nd differs by more than this is no substitute, whatever its name.
FARTHEST_OFFER = 0.01
SILICA = ("SILICA", "FSILICA", "FUSEDSILICA", "SIO2", "F_SILICA")


@dataclass(frozen=True)
class GlassSources:
    """Where glasses come from: the user's catalogues, the file's private glasses, and substitutes if accepted."""

    catalogues: tuple[Catalogue, ...] = ()
    private: dict[str, Medium] = field(default_factory=dict)
    accept_substitutes: bool = False


@dataclass(frozen=True)
class Resolution:
    """A medium, and a sentence for the report where it is not exactly what the file names."""

    medium: Medium
    substitution: Message | None = None


@dataclass(frozen=True)
class Substitute:
    """A glass that could stand in for another: how to name it, and its difference in index at the d line."""

    label: str
    medium: Medium
    difference: Message


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
    return _substitute(glass, sources)


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
        or (None if _builtin_makers(glass.makers) else _sold_by_anyone(glass))
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
    """Return whether a catalogue name such as SUMITA_AUG2011 or SCHOTT-1 means this maker."""
    return re.split(r"[^A-Z]", named.upper())[0] == re.split(r"[^A-Z]", maker.upper())[0] != ""


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


def _sellers(name: str) -> list[str]:
    return [labels[key(name)] for labels in _shelf().values() if key(name) in labels]


def _sold_by_anyone(glass: RawGlass) -> Medium | None:
    """Return the glass of this name if the indices of all its sellers agree, else None."""
    sellers = _sellers(glass.name)
    indices = {round(nd_of(medium) or 0.0, 5) for label in sellers if (medium := _refractive(label))}
    return _refractive(sellers[0]) if len(indices) == 1 else None


def _substitute(glass: RawGlass, sources: GlassSources) -> Resolution:
    offers = _offers(glass)
    asked = (
        Message('glass "{name}" of {makers}', name=glass.name, makers=glass.makers)
        if glass.makers
        else Message('glass "{name}"', name=glass.name)
    )
    if not offers:
        raise GlassError("{glass} is in no catalogue; give its AGF catalogue, or its index as nd and vd", glass=asked)
    if not sources.accept_substitutes:
        raise GlassError(
            "{glass} is in no catalogue given; accept a substitute ({offers}) or give its AGF catalogue",
            glass=asked,
            offers=tuple(
                Message("{glass}: {difference}", glass=offer.label, difference=offer.difference) for offer in offers
            ),
        )
    best = offers[0]
    replaced = Message(
        "{glass} replaced by {substitute}, {difference}", glass=asked, substitute=best.label, difference=best.difference
    )
    return Resolution(best.medium, replaced)


def _offers(glass: RawGlass) -> list[Substitute]:
    """Return up to four substitutes, the nearest in nd first."""
    found = [(label, _refractive(label)) for label in _equivalents(glass)]
    wanted = _nominal_nd(glass)
    away = [
        (abs((nd_of(medium) or 9.0) - wanted) if wanted else 0.0, label, medium) for label, medium in found if medium
    ]
    near = [item for item in sorted(away, key=lambda item: round(item[0], 4)) if item[0] <= FARTHEST_OFFER]
    return [Substitute(label, medium, _difference(medium, wanted)) for _, label, medium in near[:4]]


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


def _nominal_nd(glass: RawGlass) -> float | None:
    """Return nd of the glass that was asked for, where an old data sheet states it."""
    known = not glass.makers or any(_same_maker(maker, "SCHOTT") for maker in glass.makers)
    return OBSOLETE.get(key(glass.name), (None,))[0] if known else None


def nd_of(medium: Medium) -> float | None:
    """Return the index at the d line, None where the data do not reach it."""
    try:
        return float(medium.index(LINES_UM["d"]))
    except GlassError:
        return None


def _difference(medium: Medium, wanted: float | None) -> Message:
    nd = nd_of(medium)
    if wanted is None or nd is None:
        return Message("Δn at d unknown, the file does not tell the index it wants")
    return Message("Δn at d {value:+.5f}", value=round(nd - wanted, 5) + 0.0)  # + 0.0 turns −0 into 0
