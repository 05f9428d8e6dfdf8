"""The PSF of the six coefficients over a uniform circular pupil: the `seidel` method (handbook 4.1)."""

from functools import partial
from time import perf_counter

import numpy as np
from numpy.typing import DTypeLike

from p2sf.conventions import FloatOrArray, anywhere, centred_axis
from p2sf.disc.mask import CLEAR, PupilMask
from p2sf.disc.mask_nodes import throughput
from p2sf.disc.quadrature import SETTLED_TOLERANCE, cell_areas, disc_nodes, even_count, nodes_for
from p2sf.disc.transform import check_fft, padded_fft, sum_plane_waves
from p2sf.errors import GeometryError, SamplingError
from p2sf.figures.psf_data import Later, PsfFigures
from p2sf.messages import Message
from p2sf.parameters import LARGEST_SIDE, check_samples
from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import steepest_polar, steepest_slope, wavefront
from p2sf.psf.peak import peak_of, top_in_window
from p2sf.psf.result import Psf
from p2sf.psf.seidel_stack import SummedStack, as_fit, corner_reach, each_of, stack_of
from p2sf.psf.seidel_sum import wave_number
from p2sf.pupil.plane_waves import window_reach_um
from p2sf.raytrace.ray_field import AIRY_RADIUS
from p2sf.threads import one_blas_thread

WINDOW_AIRY_RADII = 5
LARGEST_SAMPLES = 2**28  # of all PSFs of a call: 2 GiB of float64
FFT_RADIUS = {"preview": 64, "settled": 256}  # pupil radius in FFT samples: its rim is only second-order accurate
MOST_SEARCHED = 16  # PSFs of a stack whose peaks are sought everywhere; for more, only near the brightest sample


@one_blas_thread
def seidel_psf(
    coefficients: Coefficients,
    pixels: int = 64,
    pixel_um: float | None = None,
    quality: str = "settled",
    sampling: str = "mdft",
    dtype: DTypeLike | None = None,
    mask: PupilMask = CLEAR,
) -> Psf:
    """Return the PSF of the six coefficients over a uniform circular pupil, |FT{exp(i2πW)}|² (Pieroni et al. 2015).

    ``mask``: the pupil mask in the coordinates of the source (`raytrace.seen_mask`); ``sampling`` "fft" supports none.

    Coefficients of any shape give a stack (…, pixels, pixels) at one pitch; by default the one that shows the widest of
    them. ``quality``: "settled" keeps a relative L2 error of 1e-4, "preview" is a 128² grid for interactive use.
    ``sampling``: "mdft" takes any size and pitch, "fft" is the paper's padded FFT for even sizes. ``dtype``: float32 or
    float64, by default float64 settled and float32 preview. Threads (`p2sf.threads`) share a large stack, whose values
    do not depend on their number. Raises GeometryError for an image at infinity, SamplingError for a grid that cannot
    be computed.
    """
    start = perf_counter()
    _check_options(quality, sampling)
    check_image(coefficients)
    pixel_um = check_window(coefficients, pixels, pixel_um)
    if sampling == "fft":
        if not mask.clear:
            raise SamplingError("an FFT of square samples does not resolve the edges of a mask; use mdft")
        stack = _by_fft(coefficients, pixels, pixel_um, quality)
    else:
        dtype = dtype or (np.float32 if quality == "preview" else np.float64)
        stack = stack_of(coefficients, pixels, pixel_um, quality, dtype, mask=mask)
    tolerance = SETTLED_TOLERANCE if (quality, sampling) == ("settled", "mdft") else None
    return _result(coefficients, stack, pixel_um, tolerance, start, mask, quality)


def plain_intensity(coefficients: Coefficients, pixels: int, pixel_um: float) -> np.ndarray:
    """Return |mean over the disc of exp(i2πW)·exp(−i2πn'u'(ξx + ηy)/λ)|², the definition, of one PSF.

    The formula against which `_seidel_sum` is tested: polar nodes, one plane wave each, float64; (pixels, pixels).
    """
    slope, twist = (float(x) for x in steepest_polar(coefficients))
    scale = wave_number(coefficients)
    nodes = disc_nodes(*nodes_for(slope, corner_reach(abs(float(scale)), pixels, pixel_um), twist))
    pupil = nodes.weight * np.exp(2j * np.pi * wavefront(coefficients, nodes.xi, nodes.eta))
    axis = centred_axis(pixels, pixel_um)
    intensity: np.ndarray = np.abs(sum_plane_waves(pupil, scale * nodes.xi, scale * nodes.eta, axis, axis)) ** 2
    return intensity


def _by_fft(coefficients: Coefficients, pixels: int, pixel_um: float, quality: str) -> SummedStack:
    """Return the PSFs of broadcast coefficients by the paper's FFT, one at a time."""
    shape = np.broadcast_shapes(*(np.shape(x) for x in vars(coefficients).values()))
    samples = fft_samples(coefficients, pixels, pixel_um, quality) if 0 not in shape else 0
    planes = [fft_intensity(one, pixels, pixel_um, samples) for one in each_of(coefficients)]
    values = np.reshape(planes, (*shape, pixels, pixels))
    total = values.sum((-2, -1))
    sampling = Message("FFT of {samples} × {samples} pupil samples", samples=samples)
    return SummedStack(values / total[..., None, None], total, sampling)


def fft_samples(coefficients: Coefficients, pixels: int, pixel_um: float, quality: str = "preview") -> int:
    """Return the paper's NPUPIL: at least 2·NPSF, its period holds blur and window, and the rim is fine enough.

    Raises SamplingError if that exceeds LARGEST_SIDE.
    """
    scale = np.abs(wave_number(coefficients)) * pixel_um
    blur = float(np.max(steepest_slope(coefficients) / scale))
    rim = min(LARGEST_SIDE, FFT_RADIUS[quality] / float(np.min(scale)))
    samples = even_count(max(2 * pixels, 2 * blur + pixels, rim))
    if samples > LARGEST_SIDE or 2 * samples * float(np.max(scale)) > LARGEST_SIDE:  # a wide pixel has a wide pupil
        raise SamplingError(
            "an FFT of {samples} × {samples} pupil samples is too large; use mdft or change the pixel", samples=samples
        )
    return samples


def fft_intensity(coefficients: Coefficients, pixels: int, pixel_um: float, pupil_samples: int) -> np.ndarray:
    """Return one PSF by the paper's FFT, (pixels, pixels); pupil step λ/(NA·NPUPIL·pitch) in units of ρ.

    Raises SamplingError unless NPSF is even and NPUPIL an even number of at least 2·NPSF.
    """
    check_fft(pupil_samples, pixels)
    step = 1 / (float(wave_number(coefficients)) * pupil_samples * pixel_um)
    half = int(1 / abs(step)) + 2
    axis = np.arange(-half, half) * step
    area = cell_areas(axis, axis, abs(step))
    pupil = area / area.sum() * np.exp(2j * np.pi * wavefront(coefficients, axis, axis[:, None]))
    intensity: np.ndarray = np.abs(padded_fft(pupil, pupil_samples, pixels)) ** 2
    return intensity


def _result(
    coefficients: Coefficients,
    stack: SummedStack,
    pixel_um: float,
    tolerance: float | None,
    start: float,
    mask: PupilMask,
    quality: str,
) -> Psf:
    wavelength, single = coefficients.wavelength_um, stack.values.ndim == 2

    def energy() -> float | np.ndarray | None:
        share = energy_fraction(coefficients, stack.total, pixel_um, throughput(mask).spreading)
        return float(share) if single and share is not None else share

    peaks = Later(partial(_peaks, coefficients, stack, pixel_um, mask, quality))
    figures = PsfFigures(
        strehl=lambda: float(peaks()[0]) if single else peaks()[0],
        peak_um=lambda: (float(peaks()[1][0]), float(peaks()[1][1])) if single else peaks()[1],
        other_peaks=lambda: int(peaks()[2]) if single else peaks()[2],
        energy=None if energy_fraction(coefficients, 1.0, pixel_um) is None else energy,
    )
    return Psf(
        values=stack.values,
        pixel_um=pixel_um,
        wavelength_um=float(wavelength) if np.ndim(wavelength) == 0 else wavelength,
        method="seidel",
        figures=figures,
        numbers=6,
        rays=2,
        sampling=stack.sampling,
        seconds=perf_counter() - start,
        error=tolerance,
        sum_over_peak=float(stack.total) if single else stack.total,
    )


@one_blas_thread
def _peaks(
    coefficients: Coefficients, stack: SummedStack, pixel_um: float, mask: PupilMask, quality: str
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return Strehl ratios, the places of the peaks, (…, 2) µm, and how many other peaks are as high."""
    shape, pixels = stack.values.shape[:-2], stack.values.shape[-1]
    planes, totals = stack.values.reshape(-1, pixels, pixels), np.ravel(stack.total)
    reach_um = window_reach_um(pixels, pixel_um)
    quality = quality if len(planes) <= MOST_SEARCHED else "preview"
    found = []
    for one, plane, total in zip(each_of(coefficients), planes, totals, strict=True):
        pupil = as_fit(one, mask)
        waves = pupil.waves_reaching(reach_um)
        if waves is None:  # with so many, what the window shows
            peak = top_in_window(plane * total, pixel_um, abs(float(wave_number(one))))
        else:
            peak = peak_of(plane * total, pixel_um, waves, pupil.waves_reaching, quality)
        found.append((peak.value, peak.x_um, peak.y_um, peak.other_peaks))
    table = np.reshape(found, (*shape, 4))
    return table[..., 0], table[..., 1:3], table[..., 3].astype(int)


def energy_fraction(
    coefficients: Coefficients, total: float | np.ndarray, pixel_um: float, spreading: float = 1.0
) -> np.ndarray | None:
    """Return the fraction of all light in a window whose samples, in units of the unaberrated peak, sum to ``total``.

    The field is the transform of a disc of radius NA/λ and amplitude 1/(π(NA/λ)²), so by Parseval all the light is
    1/(π(NA/λ)²), whatever W: a sample of 1 is π(NA·pixel/λ)² of it. None if the pitch exceeds λ/(2 NA), since the sum
    of samples is then not an integral. ``spreading``: the factor on all the light due to a mask
    (`mask_nodes.Throughput`).
    """
    cycles = np.abs(wave_number(coefficients)) * pixel_um
    if anywhere(cycles > 0.5):
        return None
    fraction: np.ndarray = total * (np.pi * cycles**2) / spreading
    return fraction


def suitable_pixel_um(coefficients: Coefficients, pixels: int = 64) -> np.ndarray:
    """Return the pitch at which the window shows the whole PSF, µm, shape of the coefficients.

    Half a window contains the farthest ray, at |∇W|λ/NA, and five Airy radii for diffraction.
    """
    check_image(coefficients)
    blur = steepest_slope(coefficients) + WINDOW_AIRY_RADII * AIRY_RADIUS
    pixel: np.ndarray = 2 * blur / (np.abs(wave_number(coefficients)) * max(1, pixels))
    return pixel


def check_image(coefficients: Coefficients) -> None:
    """Raise GeometryError if there is no image at a finite distance, or a coefficient is not a number."""
    c = coefficients
    check_focus(c.reduced_slope)
    if anywhere(~np.isfinite(c.w40 + c.w31 + c.w22 + c.w20 + c.wd + c.reduced_slope)):
        names = ("w40", "w31", "w22", "w20", "wd", "reduced_slope")
        bad = next((name for name in names if not np.isfinite(getattr(c, name)).all()), Message("their sum"))
        raise GeometryError(
            "{coefficient} is not finite, so there is no wavefront; choose a depth, field or lens with one",
            coefficient=bad,
        )


def check_focus(na: FloatOrArray) -> None:
    """Raise GeometryError for a numerical aperture of 0, without an image at a finite distance."""
    if anywhere(np.equal(na, 0)):
        raise GeometryError(
            "the image of this object lies at infinity (NA 0), so the sensor contains no PSF; move the object or "
            "refocus"
        )


def check_window(coefficients: Coefficients, pixels: int, pixel_um: float | None) -> float:
    """Return the pitch in µm, chosen if None; SamplingError for a window that cannot be computed."""
    check_samples(pixels, pixel_um)
    count = np.broadcast(*vars(coefficients).values()).size * int(pixels) ** 2
    if count > LARGEST_SAMPLES:
        raise SamplingError(
            "{count:.3g} PSF samples exceed {most:.3g}; choose fewer pixels or fewer PSFs",
            count=count,
            most=LARGEST_SAMPLES,
        )
    if pixel_um is None:
        if not count:
            raise SamplingError("an empty stack of PSFs has no width of its own; give the pixel in µm")
        return float(np.max(suitable_pixel_um(coefficients, pixels)))
    return float(pixel_um)


def check_quality(quality: str) -> None:
    """Raise SamplingError for an unknown quality."""
    if quality not in ("settled", "preview"):
        raise SamplingError('quality "{quality}" is unknown; choose "settled" or "preview"', quality=quality)


def _check_options(quality: str, sampling: str) -> None:
    check_quality(quality)
    if sampling not in ("mdft", "fft"):
        raise SamplingError('sampling "{sampling}" is unknown; choose "mdft" or "fft"', sampling=sampling)
