"""Energy within a radius from a transfer function on a grid: E(R) = R ∫ OTF(ν)·J₁(2πR|ν|)/|ν| d²ν, without rings."""

from dataclasses import dataclass

import numpy as np

AT_ONCE = 2**22  # Bessel functions


@dataclass(frozen=True, eq=False)
class HankelEnergy:
    """A transfer function of unit light, its real part about a point summed over frequencies of one length each.

    ``frequency``: these lengths, (n,), ascending from 0, cycles per µm; ``sums``: (n,); ``step``: of the grid.
    """

    frequency: np.ndarray
    sums: np.ndarray
    step: float

    def within(self, radius_um: np.ndarray) -> np.ndarray:
        """Return the share of the light within each radius of the point, (n,)."""
        from scipy.special import j1

        beyond, parts = self.frequency[1:], []
        for radius in np.array_split(radius_um, max(1, radius_um.size * beyond.size // AT_ONCE)):
            kernel = radius[:, None] * j1(2 * np.pi * radius[:, None] * beyond) / beyond
            parts.append(kernel @ self.sums[1:] + np.pi * radius**2 * self.sums[0])
        found: np.ndarray = np.concatenate(parts) * self.step**2
        return found

    def radius_of(self, part: float, table_um: np.ndarray) -> float:
        """Return the smallest radius that holds a part of the light, NaN beyond those of an ascending table."""
        from scipy.optimize import brentq

        within = np.maximum.accumulate(self.within(table_um))
        above = int(np.searchsorted(within, part))
        if above == table_um.size:
            return float("nan")
        low, high = table_um[max(above - 1, 0)], table_um[above]
        return float(brentq(lambda radius: float(self.within(np.array([radius]))[0]) - part, low, high, rtol=1e-6))


def hankel_energy(table: np.ndarray, step: float, x_um: float, y_um: float) -> HankelEnergy:
    """Return the energy about a point of a transfer function on a grid in FFT order, (size, size) with [0, 0] no zero.

    ``step``: cycles per µm from one frequency to the next; the light lies about x = y = 0 where all phases are 0.
    """
    from scipy import fft

    lag = fft.fftfreq(len(table), 1 / len(table))
    along_x, along_y = (np.exp(2j * np.pi * step * place * lag) for place in (x_um, y_um))
    values = (table * along_x * along_y[:, None]).real / table[0, 0].real
    square = np.rint(lag[:, None] ** 2 + lag**2).astype(int).ravel()
    there = np.flatnonzero(np.bincount(square))
    return HankelEnergy(step * np.sqrt(there), np.bincount(square, values.ravel())[there], step)
