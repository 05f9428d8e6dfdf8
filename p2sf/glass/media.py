"""Refractive media of every kind, with one interface: ``index(wavelength_um)``, ``label`` and ``range_um``."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import inf, isfinite
from numbers import Real
from typing import TYPE_CHECKING, Any, Protocol, TypeGuard, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from p2sf.conventions import NM_PER_UM
from p2sf.errors import GlassError
from p2sf.glass.catalogue import CatalogueEntry, find_entry
from p2sf.glass.dispersion import LINES_UM, Values, refractive_index
from p2sf.messages import Message

if TYPE_CHECKING:
    from p2sf.glass.transmittance import InternalTransmittance

Range = tuple[float, float] | None


@runtime_checkable
class Medium(Protocol):
    """Interface of all refractive media."""

    @property
    def label(self) -> str:
        """Return the name of this medium, as written in a lens file if possible."""

    @property
    def range_um(self) -> Range:
        """Return the shortest and longest wavelength in µm, or None where every wavelength has an index."""

    def index(self, wavelength_um: ArrayLike) -> np.ndarray:
        """Return the refractive index in the shape of ``wavelength_um``; GlassError outside the data's range."""


def transmittance_of(medium: Medium) -> "InternalTransmittance | None":
    """Return the ``transmittance`` of a medium; None if its absorption is unknown."""
    found: InternalTransmittance | None = getattr(medium, "transmittance", None)
    return found


@dataclass(frozen=True)
class ConstantIndex:
    """A medium with the same index at every wavelength."""

    value: float

    @property
    def label(self) -> str:
        """Return the index as written in a lens file."""
        return repr(self.value)

    @property
    def range_um(self) -> Range:
        """Return None: every wavelength has this index."""
        return None

    def index(self, wavelength_um: ArrayLike) -> np.ndarray:
        """Return the index in the shape of ``wavelength_um``."""
        return np.full(np.shape(wavelength_um), self.value)


@dataclass(frozen=True)
class TabulatedIndex:
    """An index known at a few wavelengths in ascending order, interpolated linearly."""

    wavelengths_um: tuple[float, ...]
    values: tuple[float, ...]
    label: str = "table"

    @property
    def range_um(self) -> Range:
        """Return the first and the last wavelength of the table, µm."""
        return self.wavelengths_um[0], self.wavelengths_um[-1]

    def index(self, wavelength_um: ArrayLike) -> np.ndarray:
        """Return the interpolated index; GlassError outside the table."""
        return np.asarray(np.interp(checked_wavelength(self, wavelength_um), self.wavelengths_um, self.values))


@dataclass(frozen=True)
class CatalogueGlass:
    """A glass by its maker's dispersion formula, in the digits of the data sheet."""

    entry: CatalogueEntry

    @property
    def label(self) -> str:
        """Return maker and name, as written in a lens file."""
        return self.entry.label

    @property
    def range_um(self) -> Range:
        """Return the range of the maker's data, µm."""
        return self.entry.range_um

    def __hash__(self) -> int:
        return hash(self.entry.label)  # hashed for each surface and slider step, and coefficients are slow to hash

    def index(self, wavelength_um: ArrayLike) -> np.ndarray:
        """Return the maker's formula at ``wavelength_um``; GlassError outside its range."""
        return refractive_index(self.entry.page, checked_wavelength(self, wavelength_um))


@dataclass(frozen=True)
class ModelGlass:
    """A glass known only by its index nd and Abbe number vd, on the normal line of optical glasses.

    n = a + bλ² + c/λ² + e/λ⁴, exact in nd and in nF − nC; the partial dispersions are those of
    `normal_dispersion`. Against Schott's catalogue the median error is 2e-4 from 400 to 700 nm.
    """

    nd: float
    vd: float

    @property
    def label(self) -> str:
        """Return nd and vd."""
        return f"nd {self.nd!r} vd {self.vd!r}"

    @property
    def range_um(self) -> Range:
        """Return the i line to the t line, where the normal lines are anchored."""
        return 0.3650, 1.0140

    def index(self, wavelength_um: ArrayLike) -> np.ndarray:
        """Return n at ``wavelength_um``; GlassError outside 365 to 1014 nm."""
        square = np.square(checked_wavelength(self, wavelength_um))
        a, b, c, e = normal_dispersion(self.nd, self.vd)
        return a + b * square + (c + e / square) / square


@dataclass(frozen=True)
class ShiftedIndex:
    """A medium whose index differs by the same amount at every wavelength, as that of a melt does."""

    medium: Medium
    shift: float

    @property
    def label(self) -> str:
        """Return the name of the medium and the shift."""
        return f"{self.medium.label} {self.shift:+g}"

    @property
    def range_um(self) -> Range:
        """Return the range of the medium, µm."""
        return self.medium.range_um

    def index(self, wavelength_um: ArrayLike) -> np.ndarray:
        """Return the shifted index; GlassError outside the medium's range."""
        return np.asarray(self.medium.index(wavelength_um) + self.shift)

    @property
    def transmittance(self) -> "InternalTransmittance | None":
        """Return that of the medium."""
        return transmittance_of(self.medium)


@lru_cache(maxsize=256)
def normal_dispersion(nd: float, vd: float) -> tuple[float, ...]:
    """Return a, b, c, e of n = a + bλ² + c/λ² + e/λ⁴ for a glass on Schott's normal line.

    Four conditions: nd; (nd − 1)/(nF − nC) = vd; and the normal lines through K7 and F2 (Schott,
    technical information TIE-29), (ng − nF)/(nF − nC) = 0.6438 − 0.001682 vd and (nC − nt)/(nF − nC)
    = 0.5450 + 0.004743 vd.
    """
    at = {line: np.array([1, w**2, w**-2, w**-4]) for line, w in LINES_UM.items()}
    conditions = [at["d"], at["F"] - at["C"], at["g"] - at["F"], at["C"] - at["t"]]
    spread = (nd - 1) / vd
    values = [nd, spread, spread * (0.6438 - 0.001682 * vd), spread * (0.5450 + 0.004743 * vd)]
    return tuple(float(x) for x in np.linalg.solve(conditions, values))


def checked_wavelength(medium: Medium, wavelength_um: ArrayLike) -> Values:
    """Return ``wavelength_um`` as a float or an array of floats; GlassError where the medium has no data."""
    low, high = medium.range_um or (0.0, inf)
    array = np.asarray(wavelength_um, dtype=float)
    wavelength: Values = array
    if array.ndim == 0:  # plain floats are several times faster, and a slider needs one wavelength
        wavelength = shortest = longest = float(array)
    elif array.size == 0:
        return wavelength
    else:
        shortest, longest = float(array.min()), float(array.max())
    if low <= shortest and longest <= high:
        return wavelength
    worst = longest if low <= shortest else shortest
    raise GlassError(
        "{quantity} {wavelength:.7g} nm is outside the data of {glass}, {low:.7g} to {high:.7g} nm; choose a "
        "wavelength inside, or change the glass",
        quantity=Message("wavelength"),
        wavelength=NM_PER_UM * worst,
        glass=medium.label,
        low=NM_PER_UM * low,
        high=NM_PER_UM * high,
    )


@dataclass(frozen=True)
class Mirror:
    """Placeholder for the medium behind a mirror: light returns into the medium it came from."""

    label: str = "mirror"

    @property
    def range_um(self) -> Range:
        """Return None: a mirror reflects every wavelength."""
        return None

    def index(self, wavelength_um: ArrayLike) -> np.ndarray:
        """Raise GlassError: `Lens.media` replaces it by the medium in front of the mirror."""
        raise GlassError("a mirror has no refractive index; ask for that of the medium in front of it")


AIR, MIRROR = ConstantIndex(1.0), Mirror()


@lru_cache(maxsize=4096)
def catalogue_glass(name: str) -> CatalogueGlass:
    """Return the glass a maker sells under a name such as "SCHOTT N-BK7"; see `catalogue.find_entry` for errors."""
    return CatalogueGlass(find_entry(name))


def model_glass(nd: float, vd: float) -> ModelGlass:
    """Return the glass of index ``nd`` and Abbe number ``vd``; GlassError for numbers outside the range of glasses."""
    if not 1 < nd < 4:
        raise GlassError("nd is {value}; give an index between 1 and 4", value=nd)
    if not 10 <= vd <= 120:
        raise GlassError("vd is {value}; give an Abbe number between 10 and 120", value=vd)
    return ModelGlass(float(nd), float(vd))


def constant_index(value: float) -> ConstantIndex:
    """Return a medium of one index; GlassError for a number that cannot be an index."""
    if not (isfinite(value) and 0.5 <= value <= 6):
        raise GlassError("refractive index is {value}; give a number between 0.5 and 6", value=value)
    return ConstantIndex(float(value))


def medium(glass: str | float | dict[str, Any]) -> Medium:
    """Return a medium for a surface: a glass by its name, an index, nd and vd, or a table of measured indices.

    Parameters
    ----------
    glass : str or float or dict
        A glass of a maker's catalogue, "N-BK7" or "SCHOTT N-BK7", "air" or "mirror"; an index at every wavelength;
        ``{"nd": 1.5168, "vd": 64.17}``; ``{"wavelengths_um": […], "n": […]}``, with a ``"label"`` if wanted; or
        ``{"glass": …, "shift": …}``, whose index differs by the same amount at every wavelength.

    Raises
    ------
    GlassError
        For a name that no catalogue has, or that several makers use, and for what cannot be an index.

    Examples
    --------
    >>> import p2sf
    >>> p2sf.medium("N-BK7").label, p2sf.medium("N-BK7").index(0.5876).round(4).item(), p2sf.medium(1.5).label
    ('SCHOTT N-BK7', 1.5168, '1.5')
    """
    return parse_medium(glass)


def parse_medium(medium: object) -> Medium:
    """Return what `medium` does, for a value of any type."""
    if isinstance(medium, str):
        return _from_text(medium.strip())
    if isinstance(medium, dict):
        return _from_table(medium)
    if isinstance(medium, Real) and not isinstance(medium, bool):
        return constant_index(float(medium))
    raise GlassError(
        'glass is {found}; write a name such as "SCHOTT N-BK7", an index, or nd and vd', found=repr(medium)
    )


def _from_text(text: str) -> Medium:
    if text.lower() in ("air", ""):
        return AIR
    if text.lower() in ("mirror", "reflect"):
        return MIRROR
    try:
        return constant_index(float(text))
    except ValueError as error:
        if isinstance(error, GlassError):
            raise
    return catalogue_glass(text)


def _from_table(table: dict[str, Any]) -> Medium:
    if set(table) == {"nd", "vd"} and all(_is_number(x) for x in table.values()):
        return model_glass(table["nd"], table["vd"])
    if set(table) == {"glass", "shift"} and _is_number(table["shift"]) and isfinite(table["shift"]):
        return ShiftedIndex(parse_medium(table["glass"]), float(table["shift"]))
    if {"wavelengths_um", "n"} <= set(table) <= {"wavelengths_um", "n", "label"}:
        return measured_index(table["wavelengths_um"], table["n"], str(table.get("label", "table")))
    raise GlassError(
        "glass is {found}; write {{ nd = 1.5168, vd = 64.17 }} or {{ wavelengths_um = […], n = […] }}",
        found=str(table),
    )


def measured_index(wavelengths_um: Sequence[float], values: Sequence[float], label: str = "table") -> TabulatedIndex:
    """Return a medium measured at ascending wavelengths in µm; GlassError for lists that do not match."""
    lists = isinstance(wavelengths_um, list | tuple) and isinstance(values, list | tuple)
    if not (lists and len(wavelengths_um) == len(values) > 0 and all(map(_is_number, [*wavelengths_um, *values]))):
        raise GlassError("glass table needs two equally long lists of numbers; give wavelengths_um and n")
    if any(b <= a for a, b in pairwise(wavelengths_um)):
        raise GlassError(
            "glass table's wavelengths are {wavelengths} µm; put them in ascending order",
            wavelengths=str(wavelengths_um),
        )
    return TabulatedIndex(tuple(map(float, wavelengths_um)), tuple(constant_index(n).value for n in values), label)


def _is_number(x: object) -> TypeGuard[float]:
    return isinstance(x, int | float) and not isinstance(x, bool)
