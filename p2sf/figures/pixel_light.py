"""The light on square pixels from samples of an intensity between them (handbook 6.6).

An incoherent image holds no frequency above 2NA/λ (Goodman 2005, §6.3), so that samples closer than λ/(4 NA) determine
it between them too: by a sinc, here times a Kaiser window so that ten samples on either side suffice. What is
interpolated is integrated over each pixel, along rows and columns one after the other; pixels and samples need have no
common measure.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, floor

import numpy as np

from p2sf.conventions import write_protect
from p2sf.disc.quadrature import gauss_legendre
from p2sf.figures.enlarge import windowed_sinc

ROUNDING = 1e-9
LARGEST = 2048  # fine samples a side: beyond, sums take minutes, and pixels average what diffraction adds
CLOSER = 1.2  # samples than λ/(4 NA): the window blurs the sinc's edge by a sixth of its width
# Of the Kaiser window: the light of a clear pupil then errs by 1e-5 to 4e-5, relative L2, of a thin ring by up to 1e-3.
HALF_WIDTH, BETA = 10, 8.5
STEPS = 64  # per sample, of the table of integrals
GAUSS = 8  # nodes in one step
AT_ONCE = 16  # pixels whose weights are one matrix; those of samples far from them are zero


def critical_pixel_um(wavelength_um: float | np.ndarray, na: float | np.ndarray) -> np.ndarray:
    """Return λ/(4 NA), µm, the largest pitch at which samples determine a PSF."""
    critical: np.ndarray = np.asarray(wavelength_um) / (4 * np.asarray(na))
    return critical


@dataclass(frozen=True)
class FineGrid:
    """Samples for the light on ``pixels`` a side, ``per_pixel`` of them along each; sample side//2 is the chief ray."""

    pixels: int
    pixel_um: float
    per_pixel: float

    @property
    def side(self) -> int:
        """Return the samples a side, those beyond the outermost pixels included that tell of them."""
        # Pixel N//2 is the chief ray's: of an even number the first reaches as far down as of one more.
        return 2 * ceil((self.pixels // 2 + 0.5) * self.per_pixel + HALF_WIDTH) + 1

    @property
    def pitch_um(self) -> float:
        """Return the distance of samples, µm."""
        return self.pixel_um / self.per_pixel

    def light(self, fine: np.ndarray) -> np.ndarray:
        """Return the light per pixel, (…, pixels, pixels), in units of a sample, none of it negative.

        ``fine``: (…, side, side).
        """
        rows = _products(self, fine).swapaxes(-1, -2)
        light: np.ndarray = np.maximum(_products(self, rows).swapaxes(-1, -2), 0)
        return light


def fine_grid(pixels: int, pixel_um: float, finest_um: float, narrow_too: bool = False) -> FineGrid | None:
    """Return the samples for the light on pixels, where ``finest_um`` is λ/(4 NA); None where points must do.

    That is where pixels are at most as wide, unless ``narrow_too``, and where it takes more than LARGEST a side. In the
    widest windows samples are less close than CLOSER: just λ/(4 NA) apart, the light errs by up to 4e-3 of relative L2,
    and by 7e-3 behind an obscuration of half the pupil.
    """
    ratio = pixel_um / finest_um
    if ratio <= 1 + ROUNDING and not narrow_too:
        return None
    found = FineGrid(pixels, pixel_um, _rounded_up(CLOSER * ratio))
    if found.side > LARGEST:
        fits = ((LARGEST - 1) // 2 - HALF_WIDTH) / (pixels // 2 + 0.5)
        return FineGrid(pixels, pixel_um, fits) if fits >= ratio else None
    return found


def _rounded_up(count: float) -> float:
    """Return the next number of five significant bits, so that neighbouring requests share their weights."""
    step = 2.0 ** (np.floor(np.log2(count)) - 4)
    return float(step * np.ceil(count / step))


def _products(grid: FineGrid, values: np.ndarray) -> np.ndarray:
    """Return the sums over rows that the weights of each pixel make, (…, pixels, columns)."""
    dtype = np.result_type(values.dtype, np.float32)
    blocks = _weights(grid.pixels, grid.per_pixel)
    middle = grid.side // 2
    return np.concatenate(
        [own.astype(dtype) @ values[..., middle + first : middle + first + own.shape[1], :] for first, own in blocks],
        axis=-2,
    )


@lru_cache(maxsize=16)
def _weights(pixels: int, per_pixel: float) -> list[tuple[int, np.ndarray]]:
    """Return the weights of samples for the light on AT_ONCE pixels after another, (pixels, samples).

    Before each stands the place of its first sample, counted from the chief ray's.
    """
    edges, blocks = (np.arange(pixels + 1) - pixels // 2 - 0.5) * per_pixel, []
    for begin in range(0, pixels, AT_ONCE):
        own = edges[begin : begin + AT_ONCE + 1]
        samples = np.arange(ceil(own[0] - HALF_WIDTH), floor(own[-1] + HALF_WIDTH) + 1)
        blocks.append((int(samples[0]), write_protect(np.diff(_integral(own[:, None] - samples), axis=0))))
    return blocks


def _integral(place: np.ndarray) -> np.ndarray:
    """Return the integral of the windowed sinc from the middle of a sample to places, in samples; beyond, ± 1/2.

    Cubic between the steps of a table, whose slopes are known too: errors below 1e-9.
    """
    known, slopes = _table()
    at = np.minimum(np.abs(place), HALF_WIDTH) * STEPS
    step = np.minimum(at.astype(int), HALF_WIDTH * STEPS - 1)
    t, rise = at - step, known[step + 1] - known[step]
    low, high = slopes[step], slopes[step + 1]
    found: np.ndarray = known[step] + t * (low + t * (3 * rise - 2 * low - high + t * (low + high - 2 * rise)))
    integral: np.ndarray = np.copysign(found, place)
    return integral


@lru_cache(maxsize=1)
def _table() -> tuple[np.ndarray, np.ndarray]:
    """Return the integral up to every step of its half width, and its slopes there per step.

    Both are scaled so that the integral ends at 1/2, and no light is lost.
    """
    node, weight = gauss_legendre(GAUSS)
    start = np.arange(HALF_WIDTH * STEPS)[:, None]
    parts = windowed_sinc((start + (1 + node) / 2) / STEPS, HALF_WIDTH, BETA) @ weight / (2 * STEPS)
    total = np.append(0.0, np.cumsum(parts))
    slopes = windowed_sinc(np.arange(total.size) / STEPS, HALF_WIDTH, BETA) / STEPS
    return write_protect(total / (2 * total[-1])), write_protect(slopes / (2 * total[-1]))
