"""Transfer function, line spread and edge spread from the pupil, without a window (handbook 6.3).

The transfer function is the autocorrelation of the pupil over spatial frequency (Goodman 2005, eq. 6-28). Along y it is
the sum over columns of constant fx of each column's own autocorrelation, along x the same of the pupil transposed: sums
over even samples by FFT, with weights that end each column between two samples.

The same sums over the modulus of the pupil are those of the perfect lens. All weights are positive, so the triangle
inequality |Σ w·P·P′*| ≤ Σ w·|P|·|P′| bounds the one by the other at every lag, whatever error the sums have.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import pi

import numpy as np
from numpy.polynomial.chebyshev import chebvander

from p2sf.conventions import write_protect
from p2sf.disc.phasors import cosine_sine
from p2sf.disc.quadrature import even_count
from p2sf.errors import Cancelled, SamplingError
from p2sf.metrics.frequency_pupil import FrequencyPupil, Reach, reach_of, uniform_disc
from p2sf.metrics.line_ends import ENDS, end_weights
from p2sf.metrics.masked_transfer import MaskedLines, masked_lines, masked_sum
from p2sf.metrics.perfect import circle_contrast
from p2sf.threads import never

FEWEST_LINES, LINES_PER_WAVE, LINES_PER_END = 48, 2.5, 0.75
FEWEST_SAMPLES, SAMPLES_PER_WAVE = 128, 8.0
MOST_SAMPLES = 2**25  # of all lines: slopes of some 1500 waves, seconds of work
AT_ONCE = 2**14  # samples of the lines in one block, so that a block stays in the cache
CALIBRATED = 512  # lines: with more, what a calibration mends is below 1e-6
SMALLEST = 1e-6  # of a calibrating contrast: below, both are negligible

Counts = tuple[int, int]
"""Lines, and samples along each."""
Sums = tuple[np.ndarray, np.ndarray]
"""Autocorrelations at even lags, complex, and those of the modulus, real."""
Stop = Callable[[], bool]


@dataclass(frozen=True, eq=False)
class OtfSlice:
    """The optical transfer function along one axis.

    ``values``: complex, about the light's centroid, at even ``step``s of frequency from 0 on, cycles per µm; 1 at zero,
    the last at the cut-off. ``perfect``: of the same pupil without phase, by the same sums, which nothing exceeds.
    """

    step: float
    values: np.ndarray
    perfect: np.ndarray
    along_y: bool

    @property
    def cut_off(self) -> float:
        """Return the cut-off frequency, cycles per µm."""
        return self.step * (self.values.size - 1)

    def at(self, frequency: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return ``values`` and ``perfect`` at any frequencies, cycles per µm; 0 beyond the cut-off.

        Between lags a spline follows their ratio to the contrast of a disc, which is smooth, and from the last before
        the cut-off on it stays: there both ratios are those of two vanishing numbers.
        """
        from scipy.interpolate import make_interp_spline

        relative, lag = np.minimum(frequency / self.cut_off, 1.0), np.linspace(0, 1, self.values.size)[:-1]
        table = np.stack([self.values.real, self.values.imag, self.perfect], axis=1)[:-1]
        spline = make_interp_spline(lag, table / circle_contrast(lag)[:, None], 5)
        real, imaginary, perfect = (spline(np.minimum(relative, lag[-1])) * circle_contrast(relative)[:, None]).T
        return real + 1j * imaginary, perfect


def otf_slices(pupil: FrequencyPupil, cancelled: Stop = never) -> tuple[OtfSlice, OtfSlice]:
    """Return the transfer function along x and along y. Raises SamplingError where that takes too many samples.

    ``cancelled`` is polled between blocks of lines and ends the work with `Cancelled`.
    """
    if not pupil.plain:
        lines = masked_lines(pupil)
        return _masked_slice(pupil, lines[0], cancelled), _masked_slice(pupil, lines[1], cancelled)
    across, along = line_counts(reach_of(pupil))
    return _slice(pupil.transposed, across, False, cancelled), _slice(pupil, along, True, cancelled)


def check_contrast(pupil: FrequencyPupil) -> None:
    """Raise the SamplingError of `otf_slices` for a pupil that takes too many samples."""
    _ = line_counts(reach_of(pupil)) if pupil.plain else masked_lines(pupil)


def _slice(pupil: FrequencyPupil, counts: Counts, along_y: bool, cancelled: Stop = never) -> OtfSlice:
    """Return the transfer function along y of a pupil, which for that along x is transposed."""
    own, perfect = column_sum(pupil, counts, cancelled)
    factor = _calibration(counts) if counts[0] <= CALIBRATED else np.ones(own.size)
    step = 2 * pupil.half_y / counts[1]
    return OtfSlice(step, own * (factor / own[0].real), perfect * (factor / perfect[0]), along_y)


def _masked_slice(pupil: FrequencyPupil, lines: MaskedLines, cancelled: Stop) -> OtfSlice:
    own, perfect = masked_sum(pupil, lines, cancelled)
    cut_off = pupil.cut_off_per_um[1 if lines.along_y else 0]
    return OtfSlice(cut_off / lines.samples, own / own[0].real, perfect / perfect[0], lines.along_y)


def line_spread(transfer: np.ndarray, step: float, position_um: np.ndarray) -> np.ndarray:
    """Return the image of a line, per µm, at positions about the centre: ∫OTF·exp(2πiνx)dν over all frequencies."""
    wave = _waves(transfer, step, position_um).real
    wave[:, 0] /= 2  # the trapezoid; the other end is 0
    spread: np.ndarray = 2 * step * wave.sum(1)
    return spread


def edge_spread(transfer: np.ndarray, perfect: np.ndarray, step: float, position_um: np.ndarray) -> np.ndarray:
    """Return the image of an edge that is dark below 0: ½ + (1/π)∫Im(OTF·exp(2πiνx))/ν dν over ν > 0, rising to 1.

    The integrand begins at 2πx and falls off with the transfer function, whose slope at 0 corrects the trapezoid
    (Euler–Maclaurin). That slope is due to the edge of the pupil alone: ``perfect``, the transfer function without
    phase, has it over a whole step, where a wide blur already bends the other.
    """
    frequency = step * np.arange(1, transfer.size)
    wave = _waves(transfer[1:], step, position_um, 1).imag / frequency
    start = 2 * pi * position_um
    fall = start * (1 - perfect[1]) / step
    spread: np.ndarray = 0.5 + (step * (start / 2 + wave.sum(1)) - step**2 / 12 * fall) / pi
    return spread


def _waves(transfer: np.ndarray, step: float, position_um: np.ndarray, first: int = 0) -> np.ndarray:
    cycles = np.outer(position_um, step * np.arange(first, first + transfer.size))
    wave: np.ndarray = transfer * np.exp(2j * pi * cycles)
    return wave


def otf_samples(pupil: FrequencyPupil) -> int:
    """Return how many samples both slices of the transfer function take together, behind no mask."""
    return sum(lines * samples for lines, samples in line_counts(reach_of(pupil)))


def line_counts(reach: Reach) -> tuple[Counts, Counts]:
    """Return the counts of rows and of columns."""
    return _counts(reach.in_row, reach.x), _counts(reach.in_column, reach.y)


def _counts(across: float, along: float) -> Counts:
    """Return the counts for rays that land so many waves per pupil radius apart, on a line and along it."""
    lines = even_count(FEWEST_LINES + LINES_PER_WAVE * across + LINES_PER_END * along)
    samples = even_count(FEWEST_SAMPLES + SAMPLES_PER_WAVE * along)
    if lines * samples > MOST_SAMPLES:
        raise SamplingError(
            "a blur of {waves:.0f} waves per pupil radius needs {lines} × {samples} pupil samples; bring the sensor "
            "nearer to the image or stop down",
            waves=along,
            lines=lines,
            samples=samples,
        )
    return lines, samples


def column_sum(pupil: FrequencyPupil, counts: Counts, cancelled: Stop = never) -> Sums:
    """Return the sums over columns of their autocorrelations about the centroid at the lags 0 … counts[1].

    Up to a factor: of a symmetric pupil over half of the columns, those at Gauss–Chebyshev points with fx > 0.
    """
    from scipy import fft

    columns, samples = counts
    lines = columns // len(pupil.domain.images)
    angle, step, size = (np.arange(lines) + 0.5) * (pi / columns), 2 / samples, samples + 4
    columns_x, place = np.cos(angle), np.arange(size)
    y = (place - (size - 1) / 2) * step
    low, high = pupil.columns(columns_x)
    (top, at_top), (under, at_bottom) = end_weights((high - y[0]) / step), end_weights((y[-1] - low) / step)
    bottom = size - 1 - under
    lines_of = _Lines(pupil, columns_x, y, np.sin(angle))
    length = fft.next_fast_len(2 * size)
    total = np.zeros((2, length), complex)
    for some, upper in _blocks(lines, size, length, cancelled):
        inside = (place <= top[some, None]) & (place >= bottom[some, None])
        lines_of.pack(some, inside, upper[:, :size])
        upper[:, size:] = 0
        lower = upper.copy()
        _weigh(upper, top[some] - ENDS, at_top[:, some])
        _weigh(lower, bottom[some] + ENDS, at_bottom[:, some])
        upper, lower = fft.fft(upper, overwrite_x=True), fft.fft(lower, overwrite_x=True)
        _add_power(total, upper, lower, some.stop - some.start)
    own, perfect = fft.ifft(total)[:, : samples + 1]
    return own, perfect.real


class _Lines:
    """The lines of a pupil at even places, complex64: errors of 1e-7 are far below the rule's.

    Two lines of the modulus are packed as one, the real and the imaginary part: (a + ib)·(a′ + ib′)* has the real part
    aa′ + bb′, which is their sum.
    """

    def __init__(self, pupil: FrequencyPupil, lines: np.ndarray, places: np.ndarray, share: np.ndarray):
        phase, density = pupil.phase.T.copy(), pupil.density.T
        phase[0, 1] += pupil.centroid_um * pupil.half_y  # about the centroid
        across, along = (chebvander(at, max(len(phase), len(density)) - 1) for at in (lines, places))
        self._across, self._phase = across[:, : len(phase)], phase @ along[:, : len(phase)].T
        # In double precision: coefficients of a pupil that fills its box in part reach 1e10 and cancel.
        self._weighted = across[:, : len(density)] * np.sqrt(share)[:, None]
        self._density = density @ along[:, : len(density)].T

    def pack(self, some: slice, inside: np.ndarray, packed: np.ndarray) -> None:
        """Write lines, and below them half as many with two lines' moduli each; nothing where not ``inside``."""
        modulus = np.abs(self._weighted[some] @ self._density).astype(np.float32)
        modulus *= inside
        own = cosine_sine(self._across[some] @ self._phase, np.float32)
        own *= modulus
        count, pairs = len(modulus), len(modulus) // 2
        packed.real[:count], packed.imag[:count] = own
        packed.real[count:], packed.imag[count:] = modulus[:pairs], modulus[pairs:]


def _weigh(packed: np.ndarray, ends: np.ndarray, weight: np.ndarray) -> None:
    """Multiply the samples at the ends, (END, lines), of packed lines by their weights."""
    count, pairs = weight.shape[1], np.arange(weight.shape[1] // 2)
    packed[np.arange(count), ends] *= weight
    packed.real[count + pairs, ends[:, : pairs.size]] *= weight[:, : pairs.size]
    packed.imag[count + pairs, ends[:, pairs.size :]] *= weight[:, pairs.size :]


def _add_power(total: np.ndarray, spectrum: np.ndarray, other: np.ndarray, count: int) -> None:
    """Add Σ spectrum·other* of the first ``count`` lines and of the packed ones; ``other`` is overwritten."""
    np.conjugate(other, out=other)
    other *= spectrum
    total[0] += other[:count].sum(0, dtype=complex)
    total[1] += other[count:].sum(0, dtype=complex)


def _blocks(lines: int, samples: int, length: int, cancelled: Stop) -> Iterator[tuple[slice, np.ndarray]]:
    """Yield an even number of lines at a time, and room for their spectra and for those of their moduli."""
    size = max(2, AT_ONCE // samples // 2 * 2)
    room = np.empty((size + size // 2, length), np.complex64)
    for start in range(0, lines, size):
        if cancelled():
            raise Cancelled("the transfer function was stopped")
        stop = min(start + size, lines)
        yield slice(start, stop), room[: 3 * (stop - start) // 2]


@lru_cache(maxsize=64)
def _calibration(counts: Counts) -> np.ndarray:
    """Return what the sums over a uniform disc lack of the closed form, at every lag.

    The lines that a lag leaves no longer than nothing end a sum too abruptly, by 1e-4 where lines are few, and by as
    much for any pupil near an ellipse. The factor takes that away, to 1e-6 for such a pupil.
    """
    found = column_sum(uniform_disc(), counts)[1]
    found /= found[0]
    exact = circle_contrast(np.linspace(0, 1, counts[1] + 1))
    return write_protect(np.divide(exact, found, out=np.ones_like(found), where=found > SMALLEST))
