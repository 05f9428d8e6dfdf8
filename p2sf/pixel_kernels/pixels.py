"""From pupils to the light that each pixel of a small window receives from one point."""

from dataclasses import dataclass
from functools import lru_cache
from math import sqrt

import numpy as np

from p2sf.conventions import FloatOrArray
from p2sf.disc.mask_cells import inside_share, open_share, turned_back, wings
from p2sf.errors import SamplingError
from p2sf.parameters import LARGEST_SIDE
from p2sf.pixel_kernels.pupil_stack import PupilStack, turned_powers
from p2sf.pixel_kernels.ray_spread import RaySpread

TAIL = 8.0  # of λ/NA: the width of the diffraction wings kept beyond where rays land, times `wings` behind a mask
SINC = np.float32(1 - np.pi**2 / 6), np.float32(np.pi**4 / 120 + 1 - np.pi**2 / 6)  # of sinc(t)/(1 − t²), in t²
BLOCK = 32768  # samples of pupils in one block
TOGETHER = 65536  # samples of the light that are transformed together

Light = PupilStack | RaySpread


@dataclass(frozen=True)
class PixelWindow:
    """Pixels from the centre to the edge, their pitch in µm, and PSF samples across each pixel."""

    half: int
    pixel_um: float
    samples: int

    @property
    def size(self) -> int:
        """Return the odd number of pixels along each side."""
        return 2 * self.half + 1


def half_width(pupil: Light, pixel_um: float, shift_um: float = 0.0) -> int:
    """Return how many pixels on either side of the centre hold a pupil's rays and the nearest rings around them."""
    return int(half_widths(pupil, pixel_um, shift_um).item())


def half_widths(pupils: Light, pixel_um: float, shifts_um: FloatOrArray = 0.0) -> np.ndarray:
    """Return `half_width` of pupils whose light is shifted by µm, (pupils,)."""
    tail = TAIL if pupils.mask.clear else TAIL * wings(pupils.mask)
    reach = pupils.reach_um + np.abs(shifts_um) + tail / pupils.radius
    return np.maximum(1, np.ceil(reach / pixel_um - 0.5)).astype(int)


def samples_across(pupil: Light, pixel_um: float, finest: float = 1.0) -> int:
    """Return samples a pixel for a pitch of λ/(2NA)/``finest``: at 1 the energy is exact (Parseval), at 2 all detail.

    At least three, unless fewer hold all detail.
    """
    return int(samples_each(pupil, pixel_um, finest).item())


def samples_each(pupils: Light, pixel_um: float, finest: float = 1.0) -> np.ndarray:
    """Return `samples_across` of pupils, (pupils,)."""
    lines = 2 * pupils.radius * pixel_um
    return np.maximum(np.ceil(lines * finest), np.minimum(3, np.ceil(2 * lines))).astype(int)


def pixel_kernel(
    pupil: PupilStack, angle: float, window: PixelWindow, shift_um: tuple[float, float] = (0.0, 0.0)
) -> np.ndarray:
    """Return the share of a point's light per pixel, (size, size) float32 of unit sum, row 0 at the top.

    The field lies ``angle`` radians from +y towards +x. ``shift_um``: where the point's chief ray
    lands, x and y (up) from the centre of the middle pixel. Raises SamplingError for a window too large.
    """
    kernel: np.ndarray = pixel_kernels(pupil, np.array([angle]), window, np.array([shift_um]))[0]
    return kernel


def pixel_kernels(
    pupils: PupilStack, angles: np.ndarray, window: PixelWindow, shifts_um: np.ndarray, fill_factor: float = 1.0
) -> np.ndarray:
    """Return `pixel_kernel` of several pupils, (pupils, size, size), with ``angles`` and ``shifts_um`` (pupils, 2).

    ``fill_factor``: the part of a pixel's area, a square in its middle, that is sensitive; kernels are shares of all
    light in the window then.
    """
    kernels = np.empty((len(pupils), window.size, window.size), np.float32)
    whole, sensitive = (_sums_over_pixels(window, width) for width in (1.0, sqrt(fill_factor)))
    together = max(1, TOGETHER // transform_side(window) ** 2)
    for start in range(0, len(pupils), together):
        part = slice(start, start + together)
        light = sampled_light(pupils.some(part), angles[part], window, shifts_um[part])
        gain = _rim_gains(pupils.some(part), window, shifts_um[part])
        pixels = all_light = np.maximum(whole @ light @ whole.T, 0) * gain
        if fill_factor < 1:
            pixels = np.maximum(sensitive @ light @ sensitive.T, 0) * gain
        total = all_light.sum((1, 2), dtype=float, keepdims=True).astype(np.float32)
        np.divide(pixels[:, ::-1], total, out=kernels[part])
    return kernels


@lru_cache(maxsize=16)
def _sums_over_pixels(window: PixelWindow, width: float) -> np.ndarray:
    """Return the matrix from the samples of a period, `transform_side`, to the light of pixels, (size, samples).

    Frequencies up to half of the samples' own are integrated exactly over the middle of each pixel, ``width`` of it
    wide: a box multiplies the spectrum by a sinc.
    """
    side, across = transform_side(window), width * window.samples
    frequencies = np.fft.fftfreq(side)
    to_the_middle = np.exp(1j * np.pi * (window.samples - 1) * frequencies)
    weights = np.fft.ifft(across * np.sinc(across * frequencies) * to_the_middle).real  # of samples back from the first
    first = np.arange(window.size)[:, None] * window.samples
    sums: np.ndarray = weights[(first - np.arange(side)) % side].astype(np.float32)
    return sums


def part_filled_kernel(pupil: PupilStack, window: PixelWindow, fill_factor: float) -> np.ndarray:
    """Return the share of a point's light that each pixel's sensitive square receives, (size, size) float32, row 0 top.

    The field is along +y, the chief ray in the middle pixel's centre; the rest as in `pixel_kernels`.
    """
    kernel: np.ndarray = pixel_kernels(pupil, np.zeros(1), window, np.zeros((1, 2)), fill_factor)[0]
    return kernel


def sampled_light(pupils: PupilStack, angles: np.ndarray, window: PixelWindow, shifts_um: np.ndarray) -> np.ndarray:
    """Return the light at ``window.samples``² points of every pixel, (pupils, n, n) float32, row 0 at the bottom.

    n is `transform_side`, a period: the pixels are its first size·samples; the rest as in `pixel_kernels`. Raises
    SamplingError for a window too large.
    """
    import scipy.fft

    count, pitch, side = window.size * window.samples, window.pixel_um / window.samples, transform_side(window)
    if side > LARGEST_SIDE:
        raise SamplingError(
            "a blur of {size} pixels with {samples} samples each needs a {side}² transform; "
            "bring the depths nearer to focus, stop down, or ask for larger pixels",
            size=window.size,
            samples=window.samples,
            side=side,
        )
    # Sample 0 of the transform is the window's lower left one; the samples of a pixel lie symmetrically in it.
    origin = -(count - 1) / 2 * pitch - shifts_um
    field = _field(pupils, angles, side, 1 / (side * pitch), origin)
    plane = scipy.fft.ifft2(field, overwrite_x=True)
    light: np.ndarray = plane.real**2
    light += plane.imag**2
    return light


def _rim_gains(pupils: PupilStack, window: PixelWindow, shifts_um: np.ndarray) -> np.ndarray:
    """Return `rim_gain` of the pixels of several pupils, (pupils, size, size)."""
    period = transform_side(window) * window.pixel_um / window.samples
    reach = pupils.reach_um + np.hypot(*shifts_um.T)
    return rim_gain(window.half, window.pixel_um, period, reach[:, None, None])


def transform_side(window: PixelWindow) -> int:
    """Return the samples along a side of the transform that fills a window."""
    import scipy.fft

    return int(scipy.fft.next_fast_len(window.size * window.samples))


def rim_gain(half: int, pitch_um: float, period_um: float, reach_um: FloatOrArray) -> np.ndarray:
    """Return what the light of samples at most ``half`` from the middle is to be multiplied by, (2·half + 1,)² float32.

    A cell that an edge of the pupil cuts counts by its open part, a mean over a cell across the edge. So the waves that
    an edge sends r beyond where its rays land are too weak by sinc(r/``period_um``), that of the transform; rays land
    within ``reach_um``. The gain is 1/sinc², to 1e-3 up to half a period, as (1 − t²)⁻²(1 + at² + bt⁴)⁻² of
    t = r/period; farther out, where the next period is as near, it stays as it is.
    """
    across = np.square(np.arange(-half, half + 1) * np.float32(pitch_um))
    beyond = np.sqrt(across + across[:, None]) - np.asarray(reach_um, np.float32)
    t = np.square(np.clip(beyond / np.float32(period_um), 0, np.float32(0.5)))
    root = (1 - t) * (1 + t * (SINC[0] + t * SINC[1]))
    gain: np.ndarray = 1 / (root * root)
    return gain


def _field(pupils: PupilStack, angles: np.ndarray, side: int, step: float, origin: np.ndarray) -> np.ndarray:
    """Return complex amplitudes on ``side``² frequencies, (pupils, side, side) complex64, in an inverse FFT's order.

    Computed a few rows at a time, so that the intermediate results stay in the processor's cache.
    """
    half, radius = int(pupils.radius.max() / step) + 1, pupils.radius[:, None]
    phase, forms = turned_powers(pupils, angles)
    phase[:, 1, 0] += pupils.radius * origin[:, 0]
    phase[:, 0, 1] += pupils.radius * origin[:, 1]
    cell = step / radius
    axis = np.arange(-half, half + 1) * cell
    table = _powers(axis, phase.shape[-1])
    slopes = np.zeros_like(table)
    slopes[..., 1:] = table[..., :-1] * np.arange(1, phase.shape[-1])
    across, maps = phase.swapaxes(1, 2) @ table.swapaxes(1, 2), _maps_across(forms, table, slopes)
    single, steep, narrow = table.astype(np.float32), slopes.astype(np.float32), cell.astype(np.float32)[..., None]
    field = np.empty((len(axis), 2 * half + 1, 2 * half + 1), np.complex64)
    rows_at_once = max(8, BLOCK // (axis.size or 1))
    for start in range(0, 2 * half + 1, rows_at_once):
        rows = slice(start, start + rows_at_once)
        turns = table[:, rows] @ across
        (xi, xi_u), (eta, eta_u), *others = single[:, rows] @ maps
        xi_v, eta_v, *others_v = steep[:, rows] @ maps[:, 0]
        amplitude = _amplitude((xi, eta), np.abs(xi_u * eta_v - xi_v * eta_u), axis, rows)
        if not pupils.mask.clear:
            width = narrow * np.sqrt(np.abs(xi_u * eta_v - xi_v * eta_u))
            _behind_mask(pupils, angles, amplitude, turns, (xi, eta), width)
        turns -= np.rint(turns)
        turns = (2 * np.pi * turns).astype(np.float32)
        if pupils.weight.size:
            amplitude *= others.pop()[0]
        for (rim, rim_u), rim_v in zip(others, others_v, strict=False):
            amplitude *= inside_share(rim, np.hypot(rim_u, rim_v) * narrow)
        np.multiply(amplitude, np.cos(turns), out=field[:, rows].real)
        np.multiply(amplitude, np.sin(turns), out=field[:, rows].imag)
    return _wrap(field, half, side)


def _powers(axis: np.ndarray, count: int) -> np.ndarray:
    """Return axisᵏ, k = 0 … count − 1, with k last."""
    table = np.empty((*axis.shape, count))
    table[..., 0] = 1.0
    table[..., 1:] = axis[..., None]
    np.multiply.accumulate(table, axis=-1, out=table)
    return table


def _maps_across(forms: np.ndarray, table: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """Return forms × (value, slope by u) × pupils summed over powers of u, (…, powers of v, columns)."""
    across = np.stack([table.swapaxes(1, 2), slopes.swapaxes(1, 2)])
    maps: np.ndarray = (forms.swapaxes(2, 3)[:, None] @ across).astype(np.float32)
    return maps


def _amplitude(point: tuple[np.ndarray, np.ndarray], area: np.ndarray, axis: np.ndarray, rows: slice) -> np.ndarray:
    """Return ``area``, |∂(ξ, η)/∂u|, times each cell's share inside the pupil, float32, for some rows.

    A cell's width in the pupil is the root of its area there.
    """
    (xi, eta), cell = point, (axis[:, 1] - axis[:, 0])[:, None, None]
    inside = inside_share(1 - np.sqrt(xi * xi + eta * eta), np.sqrt(area) * cell.astype(np.float32))
    square = axis * axis
    inside *= square[:, rows, None] + square[:, None] <= (1 + cell) ** 2  # beyond, the polynomials are not valid
    np.multiply(area, inside, out=area)
    return area


def _behind_mask(
    pupils: PupilStack,
    angles: np.ndarray,
    amplitude: np.ndarray,
    turns: np.ndarray,
    point: tuple[np.ndarray, np.ndarray],
    width: np.ndarray,
) -> None:
    """Put the mask at pupil points, (pupils, rows, columns), into amplitudes and phases; ``width`` of each cell there.

    The points are in the axes of each field, the mask in those of the field at +y.
    """
    mask, inside = pupils.mask, amplitude > 0
    xi, eta = (np.where(inside, column, np.float32(0)) for column in point)
    if not mask.round:
        xi, eta = turned_back(xi, eta, angles[:, None, None])
    amplitude *= open_share(mask, xi, eta, width)
    if mask.shaded:
        amplitude *= mask.amplitude(xi, eta).astype(np.float32)
    if mask.phased:
        turns += mask.path_um(xi, eta) / pupils.wavelength_um[:, None, None]


def _wrap(field: np.ndarray, half: int, side: int) -> np.ndarray:
    """Return the centred grids with frequency 0 at index 0, folded onto themselves where wider than ``side``."""
    planes = np.zeros((len(field), side, side), field.dtype)
    pieces = _pieces(half, side)
    for to_row, from_row in pieces:
        for to_column, from_column in pieces:
            planes[:, to_row, to_column] += field[:, from_row, from_column]
    return planes


@lru_cache(maxsize=64)
def _pieces(half: int, side: int) -> tuple[tuple[slice, slice], ...]:
    """Return (place in the plane, part of the centred axis) slices that cover −half…half modulo ``side``."""
    out, start = [], -half
    while start <= half:
        place = start % side
        length = min(side - place, half + 1 - start)
        out.append((slice(place, place + length), slice(start + half, start + half + length)))
        start += length
    return tuple(out)
