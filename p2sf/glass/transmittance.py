"""Absorption of a medium from the internal transmittances of its catalogue, for any wavelength and length."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from p2sf.errors import GlassError

DARK = 1e-30  # replaces a transmittance listed as 0, whose logarithm does not exist


@dataclass(frozen=True)
class InternalTransmittance:
    """Internal transmittance of a medium, without the reflections at its ends, at some wavelengths.

    Parameters
    ----------
    records : tuple of (float, float, float)
        Wavelength, µm, transmitted share, and thickness, mm, as in the IT lines of a catalogue in the AGF format. If a
        wavelength occurs several times, the first record counts.

    Raises
    ------
    GlassError
        Without records, for a wavelength or thickness that is not positive, and for a share outside 0 to 1.
    """

    records: tuple[tuple[float, float, float], ...]

    def __post_init__(self) -> None:
        for wavelength, share, thickness in self.records or ((0.0, 0.0, 0.0),):
            if not (0 < wavelength < np.inf and 0 <= share <= 1 and 0 < thickness < np.inf):
                raise GlassError(
                    "internal transmittance {share:g} of {thickness:g} mm at {wavelength:g} µm; give a share from 0 "
                    "to 1, a positive thickness and a positive wavelength",
                    share=share,
                    thickness=thickness,
                    wavelength=wavelength,
                )

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash(self.records)  # of a hundred numbers, needed for each surface and slider step

    @cached_property
    def _table(self) -> tuple[float, np.ndarray, np.ndarray]:
        """Return the thickness of the first record, mm, and its transmittance at ascending wavelengths, µm."""
        first: dict[float, float] = {}
        _, _, common = self.records[0]
        for wavelength, share, thickness in self.records:
            first.setdefault(wavelength, share ** (common / thickness))
        waves = np.array(sorted(first))
        return common, waves, np.array([first[wave] for wave in waves])

    def absorption(self, wavelength_um: ArrayLike) -> np.ndarray:
        """Return α, per mm, of the transmitted share exp(−α·length), in the shape of ``wavelength_um``.

        Source: Schott, technical information TIE-35, eq. 1.1. Between the wavelengths of a catalogue the transmitted
        share is interpolated linearly, and beyond them it is that of the nearest, as in OpticSim.jl (Microsoft,
        GlassCat, ``absorption``): a share of 0, at the edge of the transparent range, has no logarithm to interpolate.
        """
        thickness, waves, shares = self._table
        share = np.interp(np.asarray(wavelength_um, dtype=float), waves, shares)
        return np.asarray(-np.log(np.maximum(share, DARK)) / thickness)
