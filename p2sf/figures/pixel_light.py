"""The light on square pixels from samples of an intensity between them (handbook 6.6).

An incoherent image holds no frequency above 2NA/λ (Goodman 2005, §6.3), so that samples closer than λ/(4 NA) determine
it between them too: by a sinc, here times a Kaiser window so that some ten samples on either side suffice (Kaiser 1974;
Oppenheim & Schafer 2010, §7.5.3). What is interpolated is integrated over each pixel, along rows and columns one after
the other; pixels and samples need have no common measure.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import ceil

import numpy as np

from p2sf.conventions import write_protect
from p2sf.disc.quadrature import gauss_legendre

ROUNDING = 1e-9
LARGEST = 2048  # fine samples a side: beyond, sums take minutes
CLOSER = 1.2  # samples than λ/(4 NA): the window blurs the sinc's edge by a sixth of its width
HALF_WIDTH, BETA = 10, 8.5  # of the Kaiser window: the light on pixels then errs by 1e-5 to 4e-5, relative L2
STEPS = 64  # per sample, of the table of integrals
GAUSS = 8  # nodes in one step
AT_ONCE = 16  # pixels whose rows of weights are multiplied together: the weights between them are zero


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
        weights = _weights(self.pixels, self.per_pixel, self.side).astype(fine.dtype, copy=False)
        rows = _products(weights, fine).swapaxes(-1, -2)
        light: np.ndarray = np.maximum(_products(weights, rows).swapaxes(-1, -2), 0)
        return light


def fine_grid(pixels: int, pixel_um: float, finest_um: float, narrow_too: bool = False) -> FineGrid | None:
    """Return the samples for the light on pixels, where ``finest_um`` is λ/(4 NA); None where points must do.

    That is where pixels are at most as wide, unless ``narrow_too``, and where it takes more than LARGEST a side. For
    the widest windows samples are as far apart as λ/(4 NA), whose light errs by up to 1e-3.
    """
    ratio = pixel_um / finest_um
    if ratio <= 1 + ROUNDING and not narrow_too:
        return None
    grids = (FineGrid(pixels, pixel_um, _rounded_up(closer * ratio)) for closer in (CLOSER, 1.0))
    return next((grid for grid in grids if grid.side <= LARGEST), None)


def _rounded_up(count: float) -> float:
    """Return the next number of five significant bits, so that neighbouring requests share their weights."""
    step = 2.0 ** (np.floor(np.log2(count)) - 4)
    return float(step * np.ceil(count / step))


def _products(weights: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return weights @ values, (…, pixels, columns), of weights that are zero away from their pixels."""
    blocks = []
    for begin in range(0, len(weights), AT_ONCE):
        own = weights[begin : begin + AT_ONCE]
        used = np.flatnonzero(own.any(0))
        some = slice(used[0], used[-1] + 1)
        blocks.append(own[:, some] @ values[..., some, :])
    return np.concatenate(blocks, axis=-2)


@lru_cache(maxsize=16)
def _weights(pixels: int, per_pixel: float, side: int) -> np.ndarray:
    """Return what each sample counts for the light between two edges of each pixel, (pixels, side)."""
    edges = (np.arange(pixels + 1) - pixels // 2 - 0.5) * per_pixel
    to_edges = _integral(edges[:, None] - (np.arange(side) - side // 2))
    return write_protect(np.diff(to_edges, axis=0))


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
    parts = _windowed_sinc((start + (1 + node) / 2) / STEPS) @ weight / (2 * STEPS)
    total = np.append(0.0, np.cumsum(parts))
    slopes = _windowed_sinc(np.arange(total.size) / STEPS) / STEPS
    return write_protect(total / (2 * total[-1])), write_protect(slopes / (2 * total[-1]))


def _windowed_sinc(place: np.ndarray) -> np.ndarray:
    """Return the sinc times a Kaiser window, I₀(β√(1 − t²))/I₀(β)."""
    root = np.sqrt(np.maximum(1 - np.square(place / HALF_WIDTH), 0))
    found: np.ndarray = np.sinc(place) * np.i0(BETA * root) / np.i0(BETA)
    return found
