"""Refractive media: anything with ``index(wavelength_um)`` and a ``label``, over arrays."""

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from p2sf.errors import GlassError


@runtime_checkable
class Medium(Protocol):
    """What the rest of the program asks of a medium."""

    @property
    def label(self) -> str:
        """Return how a lens file writes this medium."""

    def index(self, wavelength_um) -> np.ndarray:
        """Return refractive index, same shape as ``wavelength_um``; GlassError outside the data's range."""


@dataclass(frozen=True)
class ConstantIndex:
    """A medium of one index at every wavelength."""

    value: float

    @property
    def label(self) -> str:
        """Return the index as a lens file writes it."""
        return repr(self.value)

    def index(self, wavelength_um) -> np.ndarray:
        """Return the one index, in the shape of ``wavelength_um``."""
        return np.full(np.shape(wavelength_um), self.value)


@dataclass(frozen=True)
class TabulatedIndex:
    """An index known at a few wavelengths, ascending; straight lines between them."""

    wavelengths_um: tuple[float, ...]
    values: tuple[float, ...]
    label: str = "table"

    def index(self, wavelength_um) -> np.ndarray:
        """Return the interpolated index; GlassError outside the table."""
        wavelength = np.asarray(wavelength_um, dtype=float)
        low, high = self.wavelengths_um[0], self.wavelengths_um[-1]
        if wavelength.size and not (low <= wavelength.min() and wavelength.max() <= high):
            raise GlassError(
                f"wavelength {1000 * wavelength.min():g} to {1000 * wavelength.max():g} nm is outside the data of "
                f"{self.label}, {1000 * low:g} to {1000 * high:g} nm; ask for a wavelength inside"
            )
        return np.interp(wavelength, self.wavelengths_um, self.values)


AIR = ConstantIndex(1.0)
