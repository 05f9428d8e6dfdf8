"""Glass catalogues in the AGF format: the user's own data, which take precedence over the built-in table."""

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import inf
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from p2sf.errors import GlassError
from p2sf.glass.dispersion import LINES_UM
from p2sf.glass.media import Medium, checked_wavelength
from p2sf.glass.transmittance import InternalTransmittance
from p2sf.lensfile.source_text import LensText, number, read_source, whole
from p2sf.messages import Message

COEFFICIENTS = 12
MOST_PASSED = 1.01  # of the light: what measurements of a clear glass may state, and is taken for all of it
ONCE, REPEATED = ("NM", "CD", "LD"), "IT"
Entry = dict[str, list[tuple[int, list[str]]]]  # these of a glass: every line and its words


def schott(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n² of formula 1, a power series."""
    return c[0] + c[1] * w**2 + c[2] * w**-2 + c[3] * w**-4 + c[4] * w**-6 + c[5] * w**-8


def resonances(c: Sequence[float], w: np.ndarray, count: int) -> np.ndarray:
    """Return Σ K λ²/(λ² − L) over ``count`` pairs (K, L); pairs with K = 0 are skipped, and their poles with them."""
    pairs = zip(c[: 2 * count : 2], c[1 : 2 * count : 2], strict=True)
    return np.asarray(sum(k * w**2 / (w**2 - pole) for k, pole in pairs if k))


def sellmeier_1(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n² of formula 2, three resonances (W. Sellmeier 1871)."""
    return 1 + resonances(c, w, 3)


def herzberger(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n of formula 3 (M. Herzberger, Opt. Acta 6, 197, 1959)."""
    pole = 1 / (w**2 - 0.028)
    return c[0] + c[1] * pole + c[2] * pole**2 + c[3] * w**2 + c[4] * w**4 + c[5] * w**6


def sellmeier_2(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n² of formula 4: two resonances at wavelengths L₁, L₂, the second without λ² in its numerator."""
    return 1 + c[0] + c[1] * w**2 / (w**2 - c[2] ** 2) + c[3] / (w**2 - c[4] ** 2)


def conrady(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n of formula 5 (A. E. Conrady, Applied Optics and Optical Design, 1960, §126)."""
    return c[0] + c[1] / w + c[2] / w**3.5


def sellmeier_3(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n² of formula 6, four resonances."""
    return 1 + resonances(c, w, 4)


def handbook_1(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n² of formula 7 (Handbook of Optics)."""
    return c[0] + c[1] / (w**2 - c[2]) - c[3] * w**2


def handbook_2(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n² of formula 8 (Handbook of Optics)."""
    return c[0] + c[1] * w**2 / (w**2 - c[2]) - c[3] * w**2


def sellmeier_4(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n² of formula 9, a constant and two resonances."""
    return c[0] + resonances(c[1:], w, 2)


def extended_1(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n² of formula 10, the power series with λ⁻¹⁰ and λ⁻¹² in addition."""
    return schott(c, w) + c[6] * w**-10 + c[7] * w**-12


def sellmeier_5(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n² of formula 11, five resonances."""
    return 1 + resonances(c, w, 5)


def extended_2(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n² of formula 12, the power series with λ⁴ and λ⁶ in addition."""
    return schott(c, w) + c[6] * w**4 + c[7] * w**6


def extended_3(c: Sequence[float], w: np.ndarray) -> np.ndarray:
    """Return n² of formula 13, λ⁴ down to λ⁻¹²."""
    powers = (0, 2, 4, -2, -4, -6, -8, -10, -12)
    return np.asarray(sum(a * w**p for a, p in zip(c, powers, strict=False)))


Formula = Callable[[Sequence[float], np.ndarray], np.ndarray]
DIRECT: dict[int, Formula] = {3: herzberger, 5: conrady}
SQUARED: dict[int, Formula] = {
    1: schott,
    2: sellmeier_1,
    4: sellmeier_2,
    6: sellmeier_3,
    7: handbook_1,
    8: handbook_2,
    9: sellmeier_4,
    10: extended_1,
    11: sellmeier_5,
    12: extended_2,
    13: extended_3,
}


def refractive_index(formula: int, coefficients: Sequence[float], wavelength_um: ArrayLike) -> np.ndarray:
    """Return n(λ) in the shape of ``wavelength_um`` (µm); NaN where the formula gives no real index."""
    wavelength = np.asarray(wavelength_um, dtype=float)
    c = (*coefficients, *[0.0] * (COEFFICIENTS - len(coefficients)))
    with np.errstate(all="ignore"):
        if formula in DIRECT:
            return np.asarray(DIRECT[formula](c, wavelength) + 0 * wavelength)
        return np.asarray(np.sqrt(SQUARED[formula](c, wavelength) + 0 * wavelength))


@dataclass(frozen=True)
class FormulaGlass:
    """A glass by AGF formula number and coefficients (λ in µm), valid inside ``range_um``.

    ``listed_nd`` is the index the catalogue prints beside them, a check on the coefficients. ``transmittance``: what
    it passes, where the catalogue has IT lines.
    """

    name: str
    formula: int
    coefficients: tuple[float, ...]
    range_um: tuple[float, float]
    listed_nd: float | None = field(default=None, compare=False)
    transmittance: InternalTransmittance | None = None

    @property
    def label(self) -> str:
        """Return the maker's name of the glass."""
        return self.name

    def index(self, wavelength_um: ArrayLike) -> np.ndarray:
        """Return the index; GlassError outside the glass's range or where its formula gives no real number."""
        wavelength = checked_wavelength(self, wavelength_um)
        index = refractive_index(self.formula, self.coefficients, wavelength)
        if not np.all((index > 0) & (index < 1e3)):
            raise GlassError(
                "formula {formula} of {name} gives no real index there; check its coefficients",
                formula=self.formula,
                name=self.name,
            )
        return index


@dataclass(frozen=True)
class Catalogue:
    """One AGF file: its name (the file's stem) and its glasses by upper-case name."""

    name: str
    path: str
    glasses: dict[str, FormulaGlass] = field(default_factory=dict)


def read_agf(path: str | os.PathLike) -> Catalogue:
    """Return the catalogue in an AGF file; LensFileError names the line that cannot be read."""
    return read_agf_text(read_source(path))


def read_agf_text(source: LensText) -> Catalogue:
    """Return the catalogue in an AGF text, named by its path's stem; LensFileError with line."""
    glasses: dict[str, FormulaGlass] = {}
    entry: Entry = {}
    last = ""
    for line, text in enumerate(source.lines, 1):
        words = text.split()
        if words and words[0] == "NM":
            _store(glasses, entry, source)
            entry = {}
        if words and words[0] in ONCE:
            entry[words[0]] = [(line, words[1:])]
        elif words and words[0] == REPEATED:
            entry.setdefault(REPEATED, []).append((line, words[1:]))
        elif words and last == "CD" and _looks_like_a_number(words[0]):
            entry["CD"][0][1].extend(words)  # some makers' files wrap the coefficients
            continue
        last = words[0] if words else ""
    _store(glasses, entry, source)
    if not glasses:
        raise source.error("no glass (NM and CD lines) is in this file; give an AGF catalogue", len(source.lines))
    return Catalogue(Path(source.path).stem.upper(), source.path, glasses)


def _store(glasses: dict[str, FormulaGlass], entry: Entry, source: LensText) -> None:
    """Add the glass whose lines have been collected; of several entries of one name the first counts."""
    if "NM" not in entry:
        return
    line, words = entry["NM"][0]
    if len(words) < 2:
        raise source.error("a glass needs a name and a formula number (NM name formula …); complete it", line)
    formula = whole(words[1], Message("formula number"), source, line)
    if formula not in DIRECT and formula not in SQUARED:
        raise source.error(
            "{name} uses dispersion formula {formula}; only 1 to 13 exist, correct it",
            line,
            name=words[0],
            formula=formula,
        )
    listed = number(words[3], Message("listed nd"), source, line) if len(words) > 3 else None
    coefficients, limits = _coefficients(entry, source, line), _range(entry, source, line)
    glass = FormulaGlass(words[0], formula, coefficients, limits, listed, _transmittance(entry, source))
    glasses.setdefault(words[0].upper(), glass)


def _looks_like_a_number(word: str) -> bool:
    return word[0] in "+-.0123456789"


def _coefficients(entry: Entry, source: LensText, name_line: int) -> tuple[float, ...]:
    line, words = entry.get("CD", [(name_line, [])])[0]
    if not words:
        raise source.error("the glass has no coefficients (CD line); complete it", line)
    return tuple(number(word, Message("coefficient"), source, line) for word in words[:COEFFICIENTS])


def _range(entry: Entry, source: LensText, name_line: int) -> tuple[float, float]:
    line, words = entry.get("LD", [(name_line, [])])[0]
    if len(words) < 2:
        raise source.error("the glass has no wavelength range (LD line); complete it", line)
    low, high = (number(word, Message("wavelength"), source, line) for word in words[:2])
    if not 0 < low < high:
        raise source.error(
            "the glass's range is {low:g} to {high:g} µm; give the smaller first, both positive",
            line,
            low=low,
            high=high,
        )
    return low, high


def _transmittance(entry: Entry, source: LensText) -> InternalTransmittance | None:
    """Return what the IT lines of a glass state; one that is not complete states nothing.

    A share, a thickness or a wavelength that cannot be, such as −999 for no measurement, leaves the glass without any.
    """
    records = []
    for line, words in entry.get(REPEATED, ()):
        if len(words) < 3:
            continue
        what = Message("wavelength"), Message("internal transmittance"), Message("thickness")
        wave, share, thickness = (number(*pair, source, line) for pair in zip(words, what, strict=False))
        record = wave, min(share, 1.0) if share <= MOST_PASSED else share, thickness
        records.append(record)
    try:
        return InternalTransmittance(tuple(records)) if records else None
    except GlassError:
        return None


def nd_and_vd(glass: Medium) -> tuple[float, float]:
    """Return nd and the Abbe number vd as a catalogue prints them; 0 where the glass has no data at F, d and C."""
    low, high = glass.range_um or (0.0, inf)
    if not (low <= LINES_UM["F"] and LINES_UM["C"] <= high):
        return 0.0, 0.0
    n_f, n_d, n_c = (float(glass.index(LINES_UM[line])) for line in "FdC")
    return n_d, (n_d - 1) / (n_f - n_c) if n_f != n_c else 0.0
