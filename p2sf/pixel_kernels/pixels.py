"""From a pupil to the light that each pixel of a small window receives from one point."""

from dataclasses import dataclass
from functools import lru_cache
from math import ceil

import numpy as np

from p2sf.errors import SamplingError
from p2sf.pixel_kernels.frequency_grid import FrequencyPupil, Turned, turned
from p2sf.pixel_kernels.ray_spread import RaySpread
from p2sf.pupil.binning import binned

TAIL = 8.0  # of λ/NA: the width of the diffraction wings kept beyond where rays land
LARGEST_WINDOW = 4096
BLOCK = 32768  # samples of the pupil in one block


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


def half_width(pupil: FrequencyPupil | RaySpread, pixel_um: float, shift_um: float = 0.0) -> int:
    """Return how many pixels on either side of the centre hold the rays and the nearest rings around them."""
    return max(1, ceil((pupil.reach_um + abs(shift_um) + TAIL / pupil.radius) / pixel_um - 0.5))


def samples_across(pupil: FrequencyPupil | RaySpread, pixel_um: float, finest: float = 1.0) -> int:
    """Return samples a pixel for a pitch of λ/(2NA)/``finest``: at 1 the energy is exact (Parseval), at 2 every fringe.

    At least three, so that pixel edges are resolved well enough.
    """
    return max(3, ceil(2 * pupil.radius * pixel_um * finest))


def pixel_kernel(
    pupil: FrequencyPupil, angle: float, window: PixelWindow, shift_um: tuple[float, float] = (0.0, 0.0)
) -> np.ndarray:
    """Return the share of a point's light per pixel, (size, size) float32 of unit sum, row 0 at the top.

    The field lies ``angle`` radians from +y towards +x. ``shift_um``: where the point's chief ray
    lands, x and y (up) from the centre of the middle pixel. Raises SamplingError for a window too large.
    """
    pixels = binned(sampled_light(pupil, angle, window, shift_um), window.size, window.samples)
    kernel: np.ndarray = np.ascontiguousarray(pixels[::-1]) / pixels.sum(dtype=float).astype(np.float32)
    return kernel


def part_filled_kernel(pupil: FrequencyPupil, window: PixelWindow, fill_factor: float) -> np.ndarray:
    """Return the share of a point's light that each pixel's sensitive square receives, (size, size) float32, row 0 top.

    The square, ``fill_factor`` of the pixel's area, lies in its middle; the field is along +y, the chief ray in the
    middle pixel's centre. The light is convolved with the square by its transform, sinc·sinc, which is exact for
    samples finer than λ/4NA, where every spatial frequency of the light is below theirs: ``window.samples`` from
    `samples_across` at a fineness of 2, and odd, so that one lies in each pixel's centre. Raises SamplingError.
    """
    import scipy.fft

    light = sampled_light(pupil, 0.0, window)
    wide = window.samples * fill_factor**0.5  # of the square, in samples
    count = len(light)
    down, across = (np.sinc(wide * f).astype(np.float32) for f in (np.fft.fftfreq(count), np.fft.rfftfreq(count)))
    spectrum = scipy.fft.rfft2(light)
    spectrum *= down[:, None] * across
    spread = scipy.fft.irfft2(spectrum, light.shape, overwrite_x=True)
    centres = slice(window.samples // 2, None, window.samples)
    kernel: np.ndarray = spread[centres, centres][::-1] * np.float32(wide**2 / light.sum(dtype=float))
    return kernel


def sampled_light(
    pupil: FrequencyPupil, angle: float, window: PixelWindow, shift_um: tuple[float, float] = (0.0, 0.0)
) -> np.ndarray:
    """Return the light at ``window.samples``² points of every pixel, (size·samples,)² float32, row 0 at the bottom.

    As in `pixel_kernel`. Raises SamplingError for a window too large.
    """
    import scipy.fft

    count, pitch = window.size * window.samples, window.pixel_um / window.samples
    side = scipy.fft.next_fast_len(count)
    if side > LARGEST_WINDOW:
        raise SamplingError(
            "a blur of {size} pixels with {samples} samples each needs a {side}² transform; "
            "bring the depths nearer to focus, stop down, or ask for larger pixels",
            size=window.size,
            samples=window.samples,
            side=side,
        )
    # Sample 0 of the transform is the window's lower left one; the samples of a pixel lie symmetrically in it.
    corner = -(count - 1) / 2 * pitch
    origin = corner - shift_um[0], corner - shift_um[1]
    field = _field(turned(pupil, angle), side, 1 / (side * pitch), origin)
    plane = scipy.fft.ifft2(field, overwrite_x=True)[:count, :count]
    light: np.ndarray = plane.real**2 + plane.imag**2
    return light


def _field(pupil: Turned, side: int, step: float, origin: tuple[float, float]) -> np.ndarray:
    """Return the pupil's complex amplitude on ``side``² frequencies, complex64, in the order of an inverse FFT.

    Computed a few rows at a time, so that the intermediate results stay in the processor's cache.
    """
    half = int(pupil.radius / step) + 1
    phase = pupil.phase.copy()
    phase[1, 0] += pupil.radius * origin[0]
    phase[0, 1] += pupil.radius * origin[1]
    cell = step / pupil.radius
    axis = np.arange(-half, half + 1) * cell
    table = np.vander(axis, len(phase), increasing=True)
    slopes = np.zeros_like(table)
    slopes[:, 1:] = table[:, :-1] * np.arange(1, len(phase))
    across, maps = phase.T @ table.T, _maps_across(pupil, table, slopes)
    single, steep = table.astype(np.float32), slopes.astype(np.float32)
    field = np.empty((axis.size, axis.size), np.complex64)
    rows_at_once = max(8, BLOCK // axis.size)
    for start in range(0, axis.size, rows_at_once):
        rows = slice(start, start + rows_at_once)
        turns = table[rows] @ across
        turns -= np.rint(turns)
        turns = (2 * np.pi * turns).astype(np.float32)
        (xi, xi_u), (eta, eta_u), *others = single[rows] @ maps
        xi_v, eta_v, *others_v = steep[rows] @ maps[:, 0]
        amplitude = _amplitude((xi, eta), np.abs(xi_u * eta_v - xi_v * eta_u), axis, rows)
        if pupil.weight is not None:
            amplitude *= others.pop()[0]
        for (rim, rim_u), rim_v in zip(others, others_v, strict=False):
            amplitude *= _share_inside(rim, np.hypot(rim_u, rim_v) * np.float32(cell))
        np.multiply(amplitude, np.cos(turns), out=field[rows].real)
        np.multiply(amplitude, np.sin(turns), out=field[rows].imag)
    return _wrapped(field, half, side)


def _maps_across(pupil: Turned, table: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """Return (ξ, η, rims, weight) × (value, slope by u) summed over powers of u, (2, powers of v, columns) float32."""
    last = () if pupil.weight is None else (pupil.weight,)
    forms = np.stack([form.T for form in (pupil.xi, pupil.eta, *pupil.rims, *last)])[:, None]
    maps: np.ndarray = (forms @ np.stack([table.T, slopes.T])).astype(np.float32)
    return maps


def _amplitude(point: tuple[np.ndarray, np.ndarray], area: np.ndarray, axis: np.ndarray, rows: slice) -> np.ndarray:
    """Return ``area``, |∂(ξ, η)/∂u|, times each cell's share inside the pupil, float32, for some rows.

    A cell's width in the pupil is the root of its area there.
    """
    (xi, eta), cell = point, axis[1] - axis[0]
    inside = _share_inside(1 - np.sqrt(xi * xi + eta * eta), np.sqrt(area) * np.float32(cell))
    inside *= axis[rows, None] ** 2 + axis**2 <= (1 + cell) ** 2  # beyond, the polynomials are not valid
    np.multiply(area, inside, out=area)
    return area


def _share_inside(within: np.ndarray, cell: np.ndarray) -> np.ndarray:
    """Return the share of each cell where ``within`` is positive, if it changes by ``cell`` across: linear at a rim."""
    share = within / (cell + np.float32(1e-30)) + 0.5
    return np.clip(share, 0, 1, out=share)


def _wrapped(field: np.ndarray, half: int, side: int) -> np.ndarray:
    """Return the centred grid with frequency 0 at index 0, folded onto itself where it is wider than ``side``."""
    plane = np.zeros((side, side), field.dtype)
    pieces = _pieces(half, side)
    for to_row, from_row in pieces:
        for to_column, from_column in pieces:
            plane[to_row, to_column] += field[from_row, from_column]
    return plane


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
