"""Transfer function, line spread and edge spread from the pupil, without a window (handbook 6.3).

The transfer function is the autocorrelation of the pupil over spatial frequency (Goodman 2005, eq. 6-28). Along x it is
the sum over rows of constant fy of each row's own autocorrelation, along y that over columns of constant fx: sums over
even samples by FFT, with weights that end each line between two samples.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import pi

import numpy as np
from scipy import fft

from p2sf.conventions import protected
from p2sf.errors import SamplingError
from p2sf.metrics.frequency_pupil import FrequencyPupil, reach_of, uniform_disc
from p2sf.metrics.perfect import circle_contrast
from p2sf.pupil.phasors import cosine_sine
from p2sf.pupil.quadrature import even_count

FEWEST_LINES, LINES_PER_WAVE, LINES_PER_END = 48, 3.0, 1.0
FEWEST_SAMPLES, SAMPLES_PER_WAVE = 128, 8.0
MOST_SAMPLES = 2**25  # of all lines: slopes of some 1500 waves, seconds of work
AT_ONCE = 2**14  # samples of the lines in one block, so that a block stays in the cache
END = 3  # samples at the end of a line whose weights differ from 1
GREGORY = np.array([1 / 2, 1 / 12, 0.0])  # −B₁, B₂/2, B₃/3: see `end_weights`
SMALLEST = 1e-6  # of a calibrating contrast: below, both are nothing

LineSum = Callable[[FrequencyPupil, "Counts"], np.ndarray]
Counts = tuple[int, int]
"""Lines, and samples along each."""


@dataclass(frozen=True, eq=False)
class OtfSlice:
    """The optical transfer function along one axis.

    ``values``: complex, about the light's centroid, at even ``step``s of frequency from 0 on, cycles per µm; 1 at zero,
    the last at the cut-off.
    """

    step: float
    values: np.ndarray
    along_y: bool

    @property
    def cut_off(self) -> float:
        """Return the frequency from which on nothing is transferred, cycles per µm."""
        return self.step * (self.values.size - 1)

    def at(self, frequency: np.ndarray) -> np.ndarray:
        """Return the transfer function about its centre at any frequencies, cycles per µm; 0 beyond the cut-off."""
        from scipy.interpolate import make_interp_spline

        inside = frequency <= self.cut_off
        spline = make_interp_spline(self.step * np.arange(self.values.size), self.values, 5)
        found: np.ndarray = np.where(inside, spline(np.where(inside, frequency, 0.0)), 0.0)
        return found


def otf_slices(pupil: FrequencyPupil) -> tuple[OtfSlice, OtfSlice]:
    """Return the transfer function along x and along y. Raises SamplingError where that takes too many samples."""
    reach = reach_of(pupil)
    across, along = _counts(reach.in_row, reach.x), _counts(reach.in_column, reach.y)
    by_rows, by_columns = _row_sum(pupil, across) * _calibration(across, _row_sum), _column_sum(pupil, along)
    by_columns = by_columns * _calibration(along, _column_sum)
    return (
        OtfSlice(2 * pupil.half_x / across[1], by_rows / by_rows[0].real, False),
        OtfSlice(2 * pupil.half_y / along[1], by_columns / by_columns[0].real, True),
    )


def line_spread(transfer: np.ndarray, step: float, position_um: np.ndarray) -> np.ndarray:
    """Return the image of a line, per µm, at positions about the centre: ∫OTF·exp(2πiνx)dν over all frequencies."""
    wave = _waves(transfer, step, position_um).real
    wave[:, 0] /= 2  # the trapezoid; the other end is 0
    spread: np.ndarray = 2 * step * wave.sum(1)
    return spread


def edge_spread(transfer: np.ndarray, step: float, position_um: np.ndarray) -> np.ndarray:
    """Return the image of an edge that is dark below 0: ½ + (1/π)∫Im(OTF·exp(2πiνx))/ν dν over ν > 0, rising to 1.

    The integrand begins at 2πx and falls off with the transfer function, which is a straight line near 0: the slope
    there corrects the trapezoid (Euler–Maclaurin).
    """
    frequency = step * np.arange(1, transfer.size)
    wave = _waves(transfer[1:], step, position_um, 1).imag / frequency
    start = 2 * pi * position_um
    fall = start * (1 - transfer[1].real) / step
    spread: np.ndarray = 0.5 + (step * (start / 2 + wave.sum(1)) - step**2 / 12 * fall) / pi
    return spread


def _waves(transfer: np.ndarray, step: float, position_um: np.ndarray, first: int = 0) -> np.ndarray:
    cycles = np.outer(position_um, step * np.arange(first, first + transfer.size))
    wave: np.ndarray = transfer * np.exp(2j * pi * cycles)
    return wave


def otf_samples(pupil: FrequencyPupil) -> int:
    """Return how many samples both slices of the transfer function take together."""
    reach = reach_of(pupil)
    across, along = _counts(reach.in_row, reach.x), _counts(reach.in_column, reach.y)
    return across[0] * across[1] + along[0] * along[1]


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


def _row_sum(pupil: FrequencyPupil, counts: Counts) -> np.ndarray:
    """Return the sum over rows of their autocorrelations at the lags 0 … counts[1], up to a factor."""
    lines, samples = counts
    angle, step = np.arange(1, lines + 1) * (pi / (lines + 1)), 2 / samples  # rows at Gauss–Chebyshev points
    x, rows_y = (np.arange(samples // 2 + 2) + 0.5) * step, np.cos(angle)
    length = _even_length(4 * x.size + 2)
    power = np.zeros(length // 2 + 1, complex)
    for some in _blocks(lines, x.size):
        y = rows_y[some]
        last, weight = end_weights(pupil.chords(y) / step - 0.5)
        half = _wave(pupil, x, y) * (np.arange(x.size) <= last[:, None])
        line = np.concatenate([half[:, ::-1], half], axis=1)
        line[np.arange(y.size), x.size + last - np.arange(END)[:, None]] *= weight
        # A row is even: its mirror image, weighted at the other end, has the same spectrum at the opposite frequency.
        spectrum = fft.fft(line, length)
        turned = np.concatenate([spectrum[:, :1], spectrum[:, : length // 2 - 1 : -1]], axis=1)
        power += np.einsum("j,jq,jq->q", np.sin(angle[some]), spectrum[:, : length // 2 + 1], turned.conj())
    sums: np.ndarray = fft.irfft(power, length)[2 * x.size - 1 + np.arange(samples + 1)]
    return sums


def _column_sum(pupil: FrequencyPupil, counts: Counts) -> np.ndarray:
    """Return the sum over columns of their autocorrelations about the centroid, as `_row_sum` does over rows."""
    lines, samples = counts[0] // 2, counts[1]  # those at fx < 0 are the same
    angle, step, count = (np.arange(lines) + 0.5) * (pi / (2 * lines)), 2 / samples, samples + 4
    columns_x, y, place = np.cos(angle), (np.arange(count) - (count - 1) / 2) * step, np.arange(count)
    length = fft.next_fast_len(2 * count)
    power = np.zeros(length, complex)
    for some in _blocks(lines, count):
        x = columns_x[some]
        low, high = pupil.columns(x)
        (top, top_weight), (under, under_weight) = end_weights((high - y[0]) / step), end_weights((y[-1] - low) / step)
        bottom = count - 1 - under
        upper = _wave(pupil, x, y).T * ((place <= top[:, None]) & (place >= bottom[:, None]))
        lower, lines_at, end = upper.copy(), np.arange(x.size), np.arange(END)[:, None]
        upper[lines_at, top - end] *= top_weight
        lower[lines_at, bottom + end] *= under_weight
        spectra = fft.fft(upper, length), fft.fft(lower, length).conj()
        power += np.einsum("j,jq,jq->q", np.sin(angle[some]), *spectra)
    sums: np.ndarray = fft.ifft(power)[: samples + 1]
    return sums


def _even_length(least: int) -> int:
    length: int = 2 * fft.next_fast_len(-(-least // 2))
    return length


def _blocks(lines: int, samples: int) -> Iterator[slice]:
    size = max(1, AT_ONCE // samples)
    return (slice(start, start + size) for start in range(0, lines, size))


def _wave(pupil: FrequencyPupil, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the pupil function (y, x) about the centroid, complex64: its errors of 1e-7 are far below the rule's."""
    phase, density = pupil.on_grid(x, y)
    phase += pupil.centroid_um * pupil.half_y * y[:, None]
    wave = np.empty(phase.shape, np.complex64)
    wave.real, wave.imag = cosine_sine(phase, np.float32)
    wave *= density.astype(np.float32)
    return wave


def end_weights(ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the last sample of lines that end at ``ends`` steps, and the weights of the last END, (END, lines).

    Σ weight·f is then ∫f to the end, exact for polynomials of degree END − 1: Gregory's rule (Davis & Rabinowitz 1984,
    §2.9) for an end up to half a step on either side of the last sample. The moments of the weights are ∫uᵐdu from 0 to
    the end, and those of plain samples (Euler–Maclaurin) −Bₘ₊₁(1)·(−1)ᵐ/(m + 1).
    """
    last = np.floor(ends + 0.5).astype(int)
    powers = np.arange(1, END + 1)[:, None]
    moments = (ends - last) ** powers / powers - GREGORY[:, None]
    return last, 1 + np.linalg.solve(np.vander(-np.arange(float(END)), END, increasing=True).T, moments)


@lru_cache(maxsize=64)
def _calibration(counts: Counts, line_sum: LineSum) -> np.ndarray:
    """Return what a rule's sums over a uniform disc lack of the closed form, at every lag.

    The rows that a lag leaves no longer than nothing end a sum too abruptly, by 1e-4 with few rows, and by as much for
    any pupil near an ellipse. The factor takes that away, to 1e-6 where nothing aberrates.
    """
    found = np.abs(line_sum(uniform_disc(), counts))
    found /= found[0]
    exact = circle_contrast(np.arange(counts[1] + 1) / counts[1])
    return protected(np.divide(exact, found, out=np.ones_like(found), where=found > SMALLEST))
