"""Transfer function, line spread and edge spread from the pupil, without a window (handbook 6.3).

The transfer function is the autocorrelation of the pupil over spatial frequency (Goodman 2005, eq. 6-28). Along y it is
the sum over columns of constant fx of each column's own autocorrelation, along x the same of the pupil transposed: sums
over even samples by FFT (`line_sums`), with weights that end each open interval of a column between two samples.

The same sums over the modulus of the pupil are those of the perfect lens. All weights are positive, so the triangle
inequality |Σ w·P·P′*| ≤ Σ w·|P|·|P′| bounds the one by the other at every lag, whatever error the sums have.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import pi

import numpy as np

from p2sf.conventions import write_protect
from p2sf.disc.open_part import open_intervals, places_between
from p2sf.disc.phasors import phasor_powers
from p2sf.disc.quadrature import even_count
from p2sf.errors import SamplingError
from p2sf.figures.line_sums import Lines, Stop, line_sums
from p2sf.figures.mask_edges import box_edges, slope_waves
from p2sf.figures.perfect import circle_contrast
from p2sf.pupil.frequency_pupil import FrequencyPupil, reach_of, uniform_disc
from p2sf.threads import never

MOST_SAMPLES = 2**25  # of all lines: slopes of some 1500 waves, seconds of work
CALIBRATED = 512  # lines: with more, what a calibration mends is below 1e-6
SMALLEST = 1e-6  # of a calibrating contrast: below, both are negligible

Counts = tuple[int, int]
"""Lines, and samples along each."""
Curves = list[np.ndarray]
"""Closed curves, (2, points) each."""


@dataclass(frozen=True)
class CountRule:
    """The fewest lines and samples, and how many lines more for rays that land a wave apart on a line and along it."""

    lines: float
    lines_per_wave: float
    lines_per_end: float
    samples: float


PLAIN = CountRule(48, 2.5, 0.75, 128)
EDGED = CountRule(320, 3.0, 0.0, 256)  # behind a mask, whose sums are not calibrated
LINES_OF_RING, NARROW = 160, 0.35  # of a narrow ring, and the power of its width with which they grow
SAMPLES_PER_WAVE, SAMPLES_PER_WIDTH = 8.0, 12.0


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
    (across, along), other = line_counts(pupil), pupil.transposed
    light, dark = ([], []) if pupil.plain else box_edges(pupil)
    rows = columns_of(other, across, [edge[::-1] for edge in light], [edge[::-1] for edge in dark])
    columns = columns_of(pupil, along, light, dark)
    return slice_along_y(other, rows, False, cancelled), slice_along_y(pupil, columns, True, cancelled)


def slice_along_y(pupil: FrequencyPupil, columns: Lines, along_y: bool, cancelled: Stop = never) -> OtfSlice:
    """Return the transfer function along y of a pupil, which for that along x is transposed."""
    own, perfect = line_sums(pupil, columns, cancelled)
    counts = len(columns.places) * len(pupil.domain.images), columns.samples
    factor = _calibration(counts) if pupil.plain and counts[0] <= CALIBRATED else np.ones(own.size)
    step = 2 * pupil.half_y / columns.samples
    return OtfSlice(step, own * (factor / own[0].real), perfect * (factor / perfect[0]), along_y)


def columns_of(pupil: FrequencyPupil, counts: Counts, light: Curves, dark: Curves) -> Lines:
    """Return columns of a pupil, of a symmetric one those with fx > 0, and their parts within edges.

    They stand at Gauss–Chebyshev points, or where edges are given close at the ends of each, where the parts change as
    a root does.
    """
    lines, samples = counts
    if light:
        places, weights = pupil.domain.of_lines(*places_between([*light, *dark], lines))
        return Lines(samples, places, weights, *open_intervals(light, dark, places))
    angle = (np.arange(lines // len(pupil.domain.images)) + 0.5) * (pi / lines)
    places = np.cos(angle)
    low, high = pupil.columns(places)
    return Lines(samples, places, np.sin(angle) * (pi / places.size), low[None], high[None])


def spreads(
    transfer: np.ndarray, perfect: np.ndarray, step: float, position_um: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the images of a line, per µm, and of an edge that is dark below 0, at positions about the centre.

    They are ∫OTF·exp(2πiνx)dν over all frequencies, and ½ + (1/π)∫Im(OTF·exp(2πiνx))/ν dν over ν > 0, rising to 1. The
    latter's integrand begins at 2πx and falls off with the transfer function, whose slope at 0 corrects the trapezoid
    (Euler–Maclaurin). That slope is due to the edge of the pupil alone: ``perfect``, the transfer function without
    phase, has it over a whole step, where a wide blur already bends the other.
    """
    waves = phasor_powers(np.exp(2j * pi * step * position_um), transfer.size)
    line: np.ndarray = 2 * step * ((transfer @ waves).real - transfer[0].real / 2)  # the other end is 0
    slope, start = (1 - perfect[1]) / step, 2 * pi * position_um
    bright = (transfer[1:] / np.arange(1, transfer.size) @ waves[1:]).imag + step * start / 2
    edge: np.ndarray = 0.5 + (bright - step**2 / 12 * start * slope) / pi
    return line, edge


def otf_samples(pupil: FrequencyPupil) -> int:
    """Return how many samples both slices of the transfer function take together."""
    return sum(lines * samples for lines, samples in line_counts(pupil))


def line_counts(pupil: FrequencyPupil) -> tuple[Counts, Counts]:
    """Return the counts of rows and of columns. Raises SamplingError where they are too many."""
    reach, width, more = reach_of(pupil), 1 - pupil.mask.obscuration, slope_waves(pupil)
    if pupil.plain:
        return _counts(PLAIN, reach.in_row, reach.x), _counts(PLAIN, reach.in_column, reach.y)
    edged = replace(
        EDGED,
        lines=max(EDGED.lines, LINES_OF_RING / width**NARROW),
        samples=max(EDGED.samples, SAMPLES_PER_WIDTH / width),
    )
    rows = _counts(edged, reach.in_row + more, reach.x + more)
    return rows, _counts(edged, reach.in_column + more, reach.y + more)


def _counts(rule: CountRule, across: float, along: float) -> Counts:
    """Return the counts for rays that land so many waves per pupil radius apart, on a line and along it."""
    lines = even_count(rule.lines + rule.lines_per_wave * across + rule.lines_per_end * along)
    samples = even_count(rule.samples + SAMPLES_PER_WAVE * along)
    if lines * samples > MOST_SAMPLES:
        raise SamplingError(
            "a blur of {waves:.0f} waves per pupil radius needs {lines} × {samples} pupil samples; bring the sensor "
            "nearer to the image or stop down",
            waves=along,
            lines=lines,
            samples=samples,
        )
    return lines, samples


@lru_cache(maxsize=64)
def _calibration(counts: Counts) -> np.ndarray:
    """Return what the sums over a uniform disc lack of the closed form, at every lag.

    The lines that a lag leaves no longer than nothing end a sum too abruptly, by 1e-4 where lines are few, and by as
    much for any pupil near an ellipse. The factor takes that away, to 1e-6 for such a pupil.
    """
    disc = uniform_disc()
    found = line_sums(disc, columns_of(disc, counts, [], []))[1]
    found /= found[0]
    exact = circle_contrast(np.linspace(0, 1, counts[1] + 1))
    return write_protect(np.divide(exact, found, out=np.ones_like(found), where=found > SMALLEST))
