"""What a medium absorbs: the internal transmittances of its catalogue, between wavelengths and for any length."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from p2sf.errors import GlassError

DARK = 1e-30  # stands for a transmittance listed as 0, of which no logarithm can be taken


@dataclass(frozen=True)
class InternalTransmittance:
    """What passes a piece of a medium, but for the reflections at its ends, at some wavelengths.

    Parameters
    ----------
    records : tuple of (float, float, float)
        Wavelength, µm, the share of light that passes, and the thickness that it passes, mm, as in the IT lines of a
        catalogue in the AGF format. Of several for one wavelength the first counts.

    Raises
    ------
    GlassError
        Where there is none, for a wavelength or a thickness that is not positive, and a share beyond 0 to 1.
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
        return hash(self.records)  # of a hundred numbers, asked for per surface and slider step

    @cached_property
    def _table(self) -> tuple[float, np.ndarray, np.ndarray]:
        """Return the thickness of the first record, mm, ascending wavelengths, µm, and what that thickness passes."""
        first: dict[float, float] = {}
        _, _, common = self.records[0]
        for wavelength, share, thickness in self.records:
            first.setdefault(wavelength, share ** (common / thickness))
        waves = np.array(sorted(first))
        return common, waves, np.array([first[wave] for wave in waves])

    def absorption(self, wavelength_um: ArrayLike) -> np.ndarray:
        """Return α, per mm, of the share exp(−α·length) that passes, in the shape of ``wavelength_um``.

        Source: Schott, technical information TIE-35, eq. 1.1. Between the wavelengths of a catalogue the share that
        passes is interpolated by straight lines, and beyond them is that of the nearest, as in OpticSim.jl (Microsoft,
        GlassCat, ``absorption``): a share of 0, where a glass ends to be clear, has no logarithm to interpolate.
        """
        thickness, waves, shares = self._table
        share = np.interp(np.asarray(wavelength_um, dtype=float), waves, shares)
        return np.asarray(-np.log(np.maximum(share, DARK)) / thickness)
