"""Autocorrelation of a pupil behind a mask, whose lines are several intervals (handbook 6.3).

Each line is sampled at even steps, with weights at the ends of every interval, and its autocorrelation is by FFT. The
weights at both ends of an interval meet where it is moved by less than END steps: there its own sum is taken again with
the weights of what it shares with itself. Lines stand close at the ends of every edge, where the intervals change as a
root does.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil, hypot

import numpy as np

from p2sf.disc.domain import WHOLE
from p2sf.disc.mask import mask_slopes
from p2sf.disc.open_part import open_intervals, places_between
from p2sf.disc.phasors import cosine_sine
from p2sf.disc.quadrature import even_count
from p2sf.errors import Cancelled, SamplingError
from p2sf.metrics.frequency_pupil import FrequencyPupil, reach_of
from p2sf.metrics.line_ends import END, interval_weights
from p2sf.metrics.mask_lines import box_edges, light_on_grid

FEWEST_ROWS, ROWS_PER_WAVE, ROWS_OF_RING = 320, 3.0, 160
NARROW = 0.35  # power of a ring's width with which the number of lines grows
FEWEST_SAMPLES, SAMPLES_PER_WAVE, SAMPLES_PER_WIDTH = 256, 8.0, 12.0
MOST_SAMPLES = 2**25  # of all lines, seconds of work
MARGIN = 4  # samples beyond the box at either end, more than END
AT_ONCE = 2**15  # samples of the lines in one block


@dataclass(frozen=True, eq=False)
class MaskedLines:
    """The lines of a pupil along one axis, in the box's coordinates, and their open intervals.

    ``places``, ``weights``: of the lines, (lines,). ``low``, ``high``: the ends of their intervals, (intervals, lines).
    ``samples``: steps along the box.
    """

    along_y: bool
    samples: int
    places: np.ndarray
    weights: np.ndarray
    low: np.ndarray
    high: np.ndarray


def masked_lines(pupil: FrequencyPupil) -> tuple[MaskedLines, MaskedLines]:
    """Return the rows and the columns of a pupil behind a mask. Raises SamplingError for too large a blur."""
    mask, reach, slopes = pupil.mask, reach_of(pupil), mask_slopes(pupil.mask)
    more = hypot(slopes.path_radial_um, slopes.path_angular_um) / abs(pupil.wavelength_um) if mask.phased else 0.0
    light, dark = box_edges(pupil)
    found = []
    for along_y, along, across in ((False, reach.x, reach.in_row), (True, reach.y, reach.in_column)):
        samples = even_count(
            max(FEWEST_SAMPLES, SAMPLES_PER_WIDTH / (1 - mask.obscuration)) + SAMPLES_PER_WAVE * (along + more)
        )
        fewest = max(FEWEST_ROWS, ROWS_OF_RING / (1 - mask.obscuration) ** NARROW)
        rows = ceil(fewest + ROWS_PER_WAVE * (across + more))
        if rows * samples > MOST_SAMPLES:
            raise SamplingError(
                "a blur of {waves:.0f} waves per pupil radius behind a mask; bring the sensor nearer to the image or "
                "stop down",
                waves=along + more,
            )
        inner, outer = ([curve if along_y else curve[::-1] for curve in curves] for curves in (light, dark))
        domain = pupil.domain if along_y else WHOLE
        places, weights = domain.of_lines(*places_between([*inner, *outer], rows))
        found.append(MaskedLines(along_y, samples, places, weights, *open_intervals(inner, outer, places)))
    return found[0], found[1]


def masked_sum(
    pupil: FrequencyPupil, lines: MaskedLines, cancelled: Callable[[], bool]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the autocorrelations of the pupil about its centroid and of its modulus at the lags 0 … samples."""
    from scipy import fft

    step, size = 2 / lines.samples, lines.samples + 2 * MARGIN
    along = np.arange(size) * step - 1 - (MARGIN - 0.5) * step
    length = fft.next_fast_len(2 * size)
    own, perfect = np.zeros(length), np.zeros(length // 2 + 1)
    near = np.zeros((2, END), complex)
    for start in range(0, lines.places.size, AT_ONCE // size + 1):
        if cancelled():
            raise Cancelled("the transfer function was stopped")
        some = slice(start, start + AT_ONCE // size + 1)
        low, high = ((end[:, some] - along[0]) / step for end in (lines.low, lines.high))
        each = [interval_weights(*ends, size) for ends in zip(low, high, strict=True)]
        total = np.sum(each, axis=0)
        modulus, wave = _line_values(pupil, lines, some, along, total > 0)
        own += _power(fft.fft(total * wave, length))
        perfect += _power(fft.rfft(total * modulus, length))
        for lag in range(END):
            shared = _lacking(low, high, each, lag, size)
            for k, values in enumerate((wave, modulus)):
                near[k, lag] += np.sum(shared * values[:, lag:] * values[:, : size - lag].conj())
    both = fft.ifft(own)[: lines.samples + 1], fft.irfft(perfect, length)[: lines.samples + 1].astype(complex)
    for values, more in zip(both, near, strict=True):
        values[:END] += more
    return both[0], both[1].real


def _line_values(
    pupil: FrequencyPupil, lines: MaskedLines, some: slice, along: np.ndarray, wanted: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the modulus and the pupil function about the centroid on some lines, (lines, samples).

    Both by the root of the lines' weights.
    """
    places, weights = lines.places[some], lines.weights[some]
    if lines.along_y:
        modulus, phase = (values.T for values in light_on_grid(pupil, places, along, wanted.T))
        phase = phase + pupil.centroid_um * pupil.half_y * along
    else:
        modulus, phase = light_on_grid(pupil, along, places, wanted)
        phase = phase + pupil.centroid_x_um * pupil.half_x * along
    modulus = modulus * np.sqrt(weights)[:, None]
    cosine, sine = cosine_sine(phase, np.float64)
    return modulus, modulus * (cosine + 1j * sine)


def _power(spectrum: np.ndarray) -> np.ndarray:
    power: np.ndarray = (spectrum.real**2 + spectrum.imag**2).sum(0)
    return power


def _lacking(low: np.ndarray, high: np.ndarray, each: list[np.ndarray], lag: int, size: int) -> np.ndarray:
    """Return what the products of the weights at a lag lack of those of the shared interval, (lines, samples − lag)."""
    lack = np.zeros((low.shape[1], size - lag))
    for bottom, top, weight in zip(low, high, each, strict=True):
        lack += interval_weights(bottom + lag, top, size)[:, lag:] - weight[:, lag:] * weight[:, : size - lag]
    return lack
