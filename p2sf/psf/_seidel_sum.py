"""The live path: the plain sum of `psf.plain_intensity`, arranged so that almost nothing is left to compute.

What makes it fast, in the order of gain:

* **Both folds.** With the field along y the pupil is even in ξ. Let P± be it at (ξ, ±η), η > 0, where W differs by
  the sign of coma alone; a node and its three mirror images, each of weight w, then add up to

      2w·cos(kξx)·[(P₊ + P₋)·cos(kηy) + i(P₊ − P₋)·sin(kηy)],   k = −2πn'u'/λ,

  so all kernels are real and belong to a quarter of the pupil and a quarter of the picture.
* **Rows.** Nodes of equal η share their kernel in y (`quadrature.RowNodes`): the sum is two small products.
* **Sine and cosine of the reduced phase.** exp of a complex array costs ten times as much as `turns.cosine_sine`.
* **Batches and kept kernels.** PSFs of one n'u'/λ share kernels and products.

Nothing is written after it is cached, and work arrays belong to one call: any number of threads may render.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import shape_coefficients, spread
from p2sf.pupil.phasors import TURN, cosine_sine, cosine_sine_of_radians
from p2sf.pupil.quadrature import RowNodes

BATCH = 10  # PSFs at a time: their 128² pupils of float32 just fit a second-level cache
KERNEL_BYTES = 2**22  # most that one kernel may take; more rows than that are summed block by block
SINGLE_COLUMNS = 128  # that half a chord may have for phases of float32: they reach 60 waves, rounded by 4e-6 of one


@dataclass(frozen=True)
class DftKernels:
    """Real kernels at offsets 0, 1, … samples: ``across`` (rows or 1, columns, x); cos and sin, ``up`` (y, rows)."""

    across: np.ndarray
    up_even: np.ndarray
    up_odd: np.ndarray


@dataclass(frozen=True)
class Monomials:
    """What multiplies W40, W31, W22 and W20 + Wd at η, then at −η, (4, 2·nodes); half the weights, (rows, columns).

    The phases come in waves as float64, or where there are few of them, and in float32 all is done, in radians.
    """

    phases: np.ndarray
    weight: np.ndarray


def intensities(coefficients: Coefficients, pixels: int, pixel_um: float, rows: RowNodes, dtype=np.float32):
    """Return the PSFs of all coefficients, (…, pixels, pixels), in units of the unaberrated peak.

    The coefficients broadcast over (depth, field, wavelength); rows of the PSF are +y, sample pixels//2 is the
    chief ray. ``dtype``, float32 or float64, is the precision of everything behind the reduced phase.
    """
    terms = shape_terms(coefficients)
    shape, terms = terms.shape[:-1], terms.reshape(-1, 5)
    out = np.empty((len(terms), pixels, pixels), dtype)
    for members in groups(terms[:, 4]):
        for start in range(0, len(members), BATCH):
            some = members[start : start + BATCH]
            out[some] = batch_intensities(terms[some], pixels, pixel_um, rows, out.dtype)
    return out.reshape(*shape, pixels, pixels)


def shape_terms(coefficients: Coefficients) -> np.ndarray:
    """Return W40, W31, W22, W20 + Wd in waves and n'u'/λ as `wave_number` has it, broadcast, (…, 5)."""
    return spread(*shape_coefficients(coefficients)[:4], wave_number(coefficients))


def batch_intensities(terms: np.ndarray, pixels: int, pixel_um: float, rows: RowNodes, dtype) -> np.ndarray:
    """Return the PSFs (batch, pixels, pixels) of `shape_terms` (batch, 5) that all have the same last one."""
    setting = float(terms[0, 4]) * pixel_um, pixels, np.dtype(dtype)
    return unfolded(*_fields(terms[:, :4], rows, setting), pixels)


def wave_number(coefficients: Coefficients) -> np.ndarray:
    """Return cycles per µm on the sensor at unit pupil radius, −n'u'/λ, signed; its size is NA/λ."""
    return -np.asarray(coefficients.reduced_slope) / coefficients.wavelength_um


def groups(scale: np.ndarray) -> list[np.ndarray]:
    """Return the indices of equal scales together; they share their kernels."""
    if scale.size <= 1:
        return [np.zeros(1, dtype=int)] * scale.size
    _, group = np.unique(scale, return_inverse=True)
    order = np.argsort(group, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(group[order])) + 1)


def _fields(shape, rows: RowNodes, setting):
    """Return the parts of the fields even and odd in y, (2, batch, y, x) each, axis 0 real and imaginary."""
    blocks = _blocks(rows, setting[1], setting[2])
    even, odd = _block_fields(shape, blocks[0], setting)
    for block in blocks[1:]:
        more_even, more_odd = _block_fields(shape, block, setting)
        even += more_even
        odd += more_odd
    return even, odd


def _block_fields(shape, rows: RowNodes, setting):
    # A single PSF is likely to be asked for again, a batch of a stack is not and would only fill the cache.
    kernels = (kernels_for if len(shape) == 1 else kernels_for.__wrapped__)(rows, *setting)
    half = _across(half_pupils(shape, rows, setting[2]), kernels.across)
    upper, lower = half[:, :, 0], half[:, :, 1]
    even, odd = kernels.up_even @ (upper + lower), kernels.up_odd @ (upper - lower)[::-1]
    np.negative(odd[0], out=odd[0])  # i times the difference
    return even, odd


def half_pupils(shape: np.ndarray, rows: RowNodes, dtype) -> np.ndarray:
    """Return w/2·exp(i2πW) at η, then at −η, shape (2, batch, 2, rows, columns), axis 0 real and imaginary.

    ``shape``: (batch, 4) of W40, W31, W22, W20 + Wd in waves.
    """
    monomials = _monomials(rows, dtype)
    phases = shape.astype(monomials.phases.dtype) @ monomials.phases
    pupils = cosine_sine(phases, dtype) if phases.dtype == np.float64 else cosine_sine_of_radians(phases)
    pupils = pupils.reshape(2, len(shape), 2, *monomials.weight.shape)
    pupils *= monomials.weight
    return pupils


def _across(pupil: np.ndarray, across: np.ndarray) -> np.ndarray:
    """Return the product along ξ, (…, rows, x): one product for a shared kernel, else one per row."""
    *parts, rows, columns = pupil.shape
    if len(across) == 1:
        return (pupil.reshape(-1, columns) @ across[0]).reshape(*parts, rows, -1)
    by_row = pupil.reshape(-1, rows, columns).transpose(1, 0, 2)  # a view serves, here and behind
    return (by_row @ across).transpose(1, 0, 2).reshape(*parts, rows, -1)


def unfolded(even: np.ndarray, odd: np.ndarray, pixels: int) -> np.ndarray:
    """Return |even ± odd|² on the whole picture from offsets ≥ 0: plus above the chief ray, even in x.

    ``even`` and ``odd`` in y: (2, batch, y, x), real and imaginary, used up; (batch, pixels, pixels).
    """
    batch, low = even.shape[1], pixels // 2
    high = pixels - low
    right = np.empty((batch, pixels, low + 1), even.dtype)
    _modulus(even + odd, slice(0, high), right[:, low:])
    _modulus(np.subtract(even, odd, out=even), slice(low, 0, -1), right[:, :low])
    out = np.empty((batch, pixels, pixels), even.dtype)
    out[..., low:] = right[..., :high]
    out[..., :low] = right[..., low:0:-1]
    return out


def _modulus(field: np.ndarray, rows: slice, out: np.ndarray) -> None:
    """Write the squared modulus of these rows of a field (2, batch, y, x), which is used up, to (batch, y, x)."""
    field *= field
    np.add(field[0, :, rows], field[1, :, rows], out=out)


@lru_cache(maxsize=8)
def kernels_for(rows: RowNodes, cycles: float, pixels: int, dtype) -> DftKernels:
    """Return the kernels of a picture whose samples are ``cycles`` per unit pupil radius apart."""
    step = np.arange(pixels // 2 + 1) * (TURN * cycles)
    up = (step[:, None] * rows.eta).astype(dtype)
    return DftKernels(_multiples(rows.xi * (TURN * cycles), len(step), dtype), np.cos(up), np.sin(up))


def _multiples(angle: np.ndarray, count: int, dtype) -> np.ndarray:
    """Return cos(m·angle), m = 0 … count − 1 last; float64 by Chebyshev's recurrence, ten times faster than cos.

    In float32 the upper half follows from the lower: cos(h + j)θ = 2·cos hθ·cos jθ − cos(h − j)θ.
    """
    out = np.ones((count, *angle.shape), dtype)
    if dtype == np.float32:
        half = count // 2
        low, high = out[: half + 1], out[half + 1 :]
        np.multiply(np.arange(half + 1, dtype=dtype).reshape(-1, *[1] * angle.ndim), angle.astype(dtype), out=low)
        np.cos(low, out=low)
        np.multiply(low[1 : len(high) + 1], 2 * low[half], out=high)
        high -= low[half - len(high) : half][::-1]
        return np.moveaxis(out, 0, -1)
    out[1:2] = np.cos(angle)
    twice = 2 * np.cos(angle)
    for m in range(2, count):
        np.multiply(twice, out[m - 1], out=out[m])
        out[m] -= out[m - 2]
    return np.moveaxis(out, 0, -1)


@lru_cache(maxsize=32)
def _monomials(rows: RowNodes, dtype) -> Monomials:
    eta = rows.eta[:, None]
    square = rows.xi**2 + eta**2
    upper = np.stack([square**2, square * eta, np.broadcast_to(eta**2, square.shape), square]).reshape(4, -1)
    both = np.concatenate([upper, upper * [[1], [-1], [1], [1]]], axis=1)
    single = dtype == np.float32 and rows.weight.shape[1] <= SINGLE_COLUMNS
    return Monomials((both * TURN).astype(dtype) if single else both, (rows.weight / 2).astype(dtype))


@lru_cache(maxsize=16)
def _blocks(rows: RowNodes, pixels: int, dtype) -> tuple[RowNodes, ...]:
    """Return the rows in blocks whose kernels stay within KERNEL_BYTES."""
    per_row = rows.weight.shape[1] * (pixels // 2 + 1) * dtype.itemsize
    size = max(1, KERNEL_BYTES // per_row)
    if size >= len(rows.eta):
        return (rows,)
    return tuple(rows.part(slice(start, start + size)) for start in range(0, len(rows.eta), size))
