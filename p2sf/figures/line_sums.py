"""The autocorrelation of a pupil along lines, each open in several intervals (handbook 6.3).

A line is sampled at even steps. The weights at the ends of an interval make a sum over the samples the integral between
ends that lie anywhere between them: U at its upper end, L at its lower one, W = U·L. In an autocorrelation by FFT the
samples of one interval meet with W·W′. What one interval shares with itself, moved by a lag, is integrated by U·L′, the
same but at lags below END, where the difference is added.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.chebyshev import chebvander

from p2sf.disc.phasors import cosine_sine
from p2sf.errors import Cancelled
from p2sf.pupil.frequency_pupil import FrequencyPupil
from p2sf.threads import never

AT_ONCE = 2**14  # samples of the lines in one block, so that a block stays in the cache
MARGIN = 2  # samples beyond the box at either end
END = 3  # samples at the end of an interval whose weights differ from 1
ENDS = np.arange(END)[:, None]
GREGORY = np.array([[1 / 2], [1 / 12], [0.0]])  # −B₁, B₂/2, B₃/3: see `end_weights`
BY_MOMENTS = np.linalg.inv(np.vander(-np.arange(float(END)), END, increasing=True).T)
POWERS = np.arange(1, END + 1)[:, None]

Stop = Callable[[], bool]


@dataclass(frozen=True, eq=False)
class Lines:
    """Columns of a pupil in the box's coordinates, and their open intervals.

    ``places``, ``weights``: of the columns, (lines,). ``low``, ``high``: the ends of their intervals, (intervals,
    lines), the same where there are fewer. ``samples``: steps along the box.
    """

    samples: int
    places: np.ndarray
    weights: np.ndarray
    low: np.ndarray
    high: np.ndarray


def line_sums(pupil: FrequencyPupil, lines: Lines, cancelled: Stop = never) -> tuple[np.ndarray, np.ndarray]:
    """Return the sums over columns of their autocorrelations about the centroid at the lags 0 … samples, complex.

    Up to a factor; and those of the modulus, real. In single precision: its errors of 1e-7 are far below the rule's.
    Two lines of the modulus are packed as one, the real and the imaginary part: (a + ib)·(a′ + ib′)* has the real part
    aa′ + bb′, which is their sum. ``cancelled`` is polled between blocks of lines and ends the work with `Cancelled`.
    """
    step, size = 2 / lines.samples, lines.samples + 2 * MARGIN
    along = (np.arange(size) - (size - 1) / 2) * step
    low, high = ((ends - along[0]) / step for ends in (lines.low, lines.high))
    light = _Light(pupil, lines, along)
    own, perfect = (LagSums(size) for _ in range(2))
    near = np.zeros((2, END), complex)
    count = max(2, AT_ONCE // size // 2 * 2)
    for start in range(0, lines.places.size, count):
        if cancelled():
            raise Cancelled("the transfer function was stopped")
        some = slice(start, start + count)
        held = _Samples(low[:, some], high[:, some], size)
        modulus, wave = light.on(some, held.weight > 0)
        near += held.lacking(wave)
        wave *= held.weight
        modulus *= held.weight
        own.add(wave)
        pairs = len(modulus) // 2
        packed = modulus[:pairs] + 1j * modulus[pairs : 2 * pairs]
        perfect.add(packed if 2 * pairs == len(modulus) else np.append(packed, modulus[2 * pairs :], axis=0))
    found = [sums.at_lags(lines.samples) for sums in (own, perfect)]
    for values, more in zip(found, near, strict=True):
        values[:END] += more
    return found[0], found[1].real


class LagSums:
    """Σ line(j + k)·line(j)* over lines of ``size`` samples, by the power of their spectra (Wiener & Khinchin)."""

    def __init__(self, size: int):
        from scipy.fft import next_fast_len

        self._length = next_fast_len(2 * size)
        self._power = np.zeros(self._length)

    def add(self, lines: np.ndarray) -> None:
        """Add lines, (lines, size)."""
        from scipy.fft import fft

        spectrum = fft(lines, self._length)
        self._power += (np.square(spectrum.real) + np.square(spectrum.imag)).sum(0, dtype=float)

    def at_lags(self, last: int) -> np.ndarray:
        """Return the sums at the lags k = 0 … last, up to ``size``, complex."""
        from scipy.fft import ifft

        found: np.ndarray = ifft(self._power)[: last + 1]
        return found


class _Light:
    """Modulus and phase of a pupil's columns at even places, by the root of the columns' weights."""

    def __init__(self, pupil: FrequencyPupil, lines: Lines, along: np.ndarray):
        phase, self._mask, self._wavelength_um = pupil.phase.T.copy(), pupil.mask, pupil.wavelength_um
        phase[0, 1] += pupil.centroid_um * pupil.half_y  # about the centroid
        tables = [phase, pupil.density.T]
        if self._mask.shaded or self._mask.phased:
            tables += [pupil.xi.T, pupil.eta.T]
        order = max(map(len, tables)) - 1
        across, up = chebvander(lines.places, order), chebvander(along, order)
        # In double precision: coefficients of a pupil that fills its box in part reach 1e10 and cancel.
        self._series = [(across[:, : len(table)], table @ up[:, : len(table)].T) for table in tables]
        self._root = np.sqrt(lines.weights)[:, None]

    def on(self, some: slice, wanted: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the modulus, float32, and the pupil function, complex64, (lines, samples); 0 if not ``wanted``."""
        phase, density, *stop = (across[some] @ values for across, values in self._series)
        if stop:
            xi, eta = (wanted * place for place in stop)
            density *= self._mask.amplitude(xi, eta)
            if self._mask.phased:
                phase += self._mask.path_um(xi, eta) / self._wavelength_um
        density *= self._root[some]
        modulus = (np.abs(density, out=density) * wanted).astype(np.float32)
        wave = np.empty(phase.shape, np.complex64)
        wave.real, wave.imag = cosine_sine(phase, np.float32)
        wave *= modulus
        return modulus, wave


class _Samples:
    """The samples of the intervals of some lines, one behind the other, and the weights at their ends.

    ``weight``: that of all intervals, (lines, size), float32.
    """

    def __init__(self, low: np.ndarray, high: np.ndarray, size: int):
        shape, line = low.shape, np.nonzero(high > low)[1]
        low, high = low[high > low], high[high > low]
        last, top = end_weights(high)
        behind, bottom = end_weights(size - 1 - low)
        first = size - 1 - behind
        count = last - first + 1
        start = np.cumsum(count) - count
        number = np.arange(count.sum())
        self._place = number - np.repeat(start, count)
        self._at = number + np.repeat(line * size + first - start, count)
        # If the ends are closer than the samples they affect, even weights have the sum of the interval's length.
        even = np.where(count < 2 * END, np.sqrt((high - low) / count), 1.0)
        self._upper = np.repeat(even, count)
        self._lower = self._upper.copy()
        some = np.flatnonzero(count >= 2 * END)
        self._upper[(start + count - 1)[some] - ENDS] = top[:, some]
        self._lower[start[some] + ENDS] = bottom[:, some]
        self._near = np.flatnonzero((self._place < END) | (np.repeat(count, count) - self._place <= END))
        weight = np.bincount(self._at, self._upper * self._lower, shape[1] * size)
        self.weight = weight.reshape(shape[1], size).astype(np.float32)

    def lacking(self, wave: np.ndarray) -> np.ndarray:
        """Return what sums of W·W′ lack of those of U·L′ at the lags below END, (2, END): over waves and their moduli.

        ``wave``: (lines, size).
        """
        found = np.empty((2, END), complex)
        values = wave.ravel()
        for lag in range(END):
            first = self._near[self._place[self._near] >= lag]
            second, at = first - lag, self._at[first]
            factor = self._upper[first] * self._lower[second]
            factor *= 1 - self._lower[first] * self._upper[second]
            product = values[at] * values[at - lag].conj()
            found[:, lag] = factor @ product, factor @ np.abs(product)
        return found


def end_weights(ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the last sample of lines that end at ``ends`` steps, and the weights of the last END, (END, lines).

    Σ weight·f is then ∫f to the end, exact for polynomials of degree END − 1: Gregory's rule (Davis & Rabinowitz 1984,
    §2.9) for an end up to half a step on either side of the last sample. The moments of the weights are ∫uᵐdu from 0 to
    the end, and those of plain samples (Euler–Maclaurin) −Bₘ₊₁(1)·(−1)ᵐ/(m + 1).
    """
    last = np.floor(ends + 0.5).astype(int)
    return last, 1 + BY_MOMENTS @ ((ends - last) ** POWERS / POWERS - GREGORY)
