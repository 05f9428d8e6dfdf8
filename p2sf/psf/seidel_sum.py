"""The sum of `seidel.plain_intensity`, arranged for the least computation.

It is fast by, the largest gain first:

* **Symmetry.** With the field along y the pupil is even in ξ. Let P± be its value at (ξ, ±η), η > 0: there W differs
  in the sign of coma alone. A node and its three mirror images, each of weight w, then add up to

      2w·cos(kξx)·[(P₊ + P₋)·cos(kηy) + i(P₊ − P₋)·sin(kηy)],   k = −2πn'u'/λ,

  so that all kernels are real and cover a quarter of the pupil and a quarter of the PSF.
* **Rows.** Nodes of equal η share their kernel in y (`quadrature.RowNodes`): the sum is two small products.
* **Sine and cosine of the reduced phase.** exp of a complex array costs ten times as much as `phasors.cosine_sine`.
* **Batches and cached kernels.** PSFs of one n'u'/λ share kernels and products.

Cached arrays are never written to and work arrays belong to one call, so any number of threads may render.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import DTypeLike

from p2sf.disc.phasors import TURN, cosine_sine, cosine_sine_of_radians
from p2sf.disc.quadrature import RowNodes
from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import shape_coefficients, spread

BATCH = 32  # PSFs at a time: with fewer, threads wait for the interpreter lock
KERNEL_BYTES = 2**22  # largest size of one kernel; more rows are summed block by block
SINGLE_COLUMNS = 128  # most columns of half a chord for float32 phases: they reach 60 waves, rounded to 4e-6 wave

Setting = tuple[float, int, np.dtype]
"""Parameters of kernels besides the nodes: cycles per unit pupil radius and pixel, pixels, precision."""


@dataclass(frozen=True, eq=False)
class DftKernels:
    """Real kernels at offsets 0, 1, … samples: ``across`` (rows or 1, columns, x); cos and sin, ``up`` (y, rows)."""

    across: np.ndarray
    up_even: np.ndarray
    up_odd: np.ndarray


@dataclass(frozen=True, eq=False)
class Monomials:
    """Factors of W40, W31, W22 and W20 + Wd at η, then at −η, (4, 2·nodes); half the weights, (rows, columns).

    They give phases in waves in float64, or in radians in float32 if phases are small enough.
    """

    phases: np.ndarray
    weight: np.ndarray


def intensities(
    coefficients: Coefficients, pixels: int, pixel_um: float, rows: RowNodes, dtype: DTypeLike = np.float32
) -> np.ndarray:
    """Return the PSFs of all coefficients, (…, pixels, pixels), in units of the unaberrated peak.

    The coefficients broadcast over (depth, field, wavelength); rows of the PSF are +y, sample pixels//2 is the
    chief ray. ``dtype``, float32 or float64, is the precision of everything after the reduced phase.
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


def batch_intensities(terms: np.ndarray, pixels: int, pixel_um: float, rows: RowNodes, dtype: DTypeLike) -> np.ndarray:
    """Return the PSFs (batch, pixels, pixels) of `shape_terms` (batch, 5) of one n'u'/λ, the last term."""
    setting = float(terms[0, 4]) * pixel_um, pixels, np.dtype(dtype)
    even, odd = _fields(terms[:, :4], rows, setting)
    return unfold(even, odd, pixels)


def wave_number(coefficients: Coefficients) -> np.ndarray:
    """Return cycles per µm on the sensor at unit pupil radius, −n'u'/λ, signed; its size is NA/λ."""
    number: np.ndarray = -np.asarray(coefficients.reduced_slope) / coefficients.wavelength_um
    return number


def groups(scale: np.ndarray) -> list[np.ndarray]:
    """Return the indices of each set of equal scales: they share their kernels."""
    if scale.size <= 1:
        return [np.zeros(1, dtype=int)] * scale.size
    _, group = np.unique(scale, return_inverse=True)
    order = np.argsort(group, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(group[order])) + 1)


def _fields(shape: np.ndarray, rows: RowNodes, setting: Setting) -> tuple[np.ndarray, np.ndarray]:
    """Return the parts of the fields even and odd in y, (2, batch, y, x) each, axis 0 real and imaginary."""
    blocks = _blocks(rows, setting[1], setting[2])
    even, odd = _block_fields(shape, blocks[0], setting)
    for block in blocks[1:]:
        more_even, more_odd = _block_fields(shape, block, setting)
        even += more_even
        odd += more_odd
    return even, odd


def _block_fields(shape: np.ndarray, rows: RowNodes, setting: Setting) -> tuple[np.ndarray, np.ndarray]:
    # A single PSF is likely to be requested again; a batch of a stack is not and would only fill the cache.
    kernels = (kernels_for if len(shape) == 1 else kernels_for.__wrapped__)(rows, *setting)
    half = _across(half_pupils(shape, rows, setting[2]), kernels.across)
    upper, lower = half[:, :, 0], half[:, :, 1]
    even, odd = kernels.up_even @ (upper + lower), kernels.up_odd @ (upper - lower)[::-1]
    np.negative(odd[0], out=odd[0])  # with the rows swapped above: i times the difference
    return even, odd


def half_pupils(shape: np.ndarray, rows: RowNodes, dtype: np.dtype) -> np.ndarray:
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
    product: np.ndarray
    if len(across) == 1:
        product = pupil.reshape(-1, columns) @ across[0]
    else:  # both transposes are views
        product = (pupil.reshape(-1, rows, columns).transpose(1, 0, 2) @ across).transpose(1, 0, 2)
    return product.reshape(*parts, rows, -1)


def unfold(even: np.ndarray, odd: np.ndarray, pixels: int) -> np.ndarray:
    """Return |even ± odd|² of the whole PSF from offsets ≥ 0, plus above the chief ray, (batch, pixels, pixels).

    ``even`` and ``odd`` in y, both even in x: (2, batch, y, x), real and imaginary; they are overwritten.
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
    """Write the squared modulus of these rows of a field (2, batch, y, x), which is overwritten, to (batch, y, x)."""
    field *= field
    np.add(field[0, :, rows], field[1, :, rows], out=out)


@lru_cache(maxsize=8)
def kernels_for(rows: RowNodes, cycles: float, pixels: int, dtype: np.dtype) -> DftKernels:
    """Return the kernels of a PSF with ``cycles`` cycles per unit pupil radius from one sample to the next."""
    step = np.arange(pixels // 2 + 1) * (TURN * cycles)
    up = (step[:, None] * rows.eta).astype(dtype)
    return DftKernels(_multiples(rows.xi * (TURN * cycles), len(step), dtype), np.cos(up), np.sin(up))


def _multiples(angle: np.ndarray, count: int, dtype: np.dtype) -> np.ndarray:
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
def _monomials(rows: RowNodes, dtype: np.dtype) -> Monomials:
    eta = rows.eta[:, None]
    square = rows.xi**2 + eta**2
    upper = np.stack([square**2, square * eta, np.broadcast_to(eta**2, square.shape), square]).reshape(4, -1)
    both = np.concatenate([upper, upper * [[1], [-1], [1], [1]]], axis=1)
    single = dtype == np.float32 and rows.weight.shape[1] <= SINGLE_COLUMNS
    return Monomials((both * TURN).astype(dtype) if single else both, (rows.weight / 2).astype(dtype))


@lru_cache(maxsize=16)
def _blocks(rows: RowNodes, pixels: int, dtype: np.dtype) -> tuple[RowNodes, ...]:
    """Return the rows in blocks whose kernels stay within KERNEL_BYTES."""
    per_row = rows.weight.shape[1] * (pixels // 2 + 1) * dtype.itemsize
    size = max(1, KERNEL_BYTES // per_row)
    if size >= len(rows.eta):
        return (rows,)
    return tuple(rows.part(slice(start, start + size)) for start in range(0, len(rows.eta), size))
