"""How other programs sample a pupil, written from what their listings show: to see what their defaults cost.

Each takes the exact rays of this program; what differs is where in the pupil they lie and how they are summed.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import sqrt
from time import perf_counter

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.errors import RequestError
from p2sf.figures.psf_data import PsfFigures
from p2sf.lens.lens import Lens, with_aim
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.pupils import pupils
from p2sf.paraxial.seidel import coefficients
from p2sf.psf.result import Psf
from p2sf.psf.seidel import fft_intensity as six_fft
from p2sf.raytrace.pencil import Rays, displayed_opd, in_azimuth, on_sensor, pencil

AIRY = 1.22  # of λF: the width by which the listings fall off, a first zero of Airy's disc
BLOCK = 4096  # rays whose wavelets are summed at once
FFT_BASE = 32  # the sampling whose pupil fills its grid


@dataclass(frozen=True, eq=False)
class PupilGrid:
    """Points of a square grid in the pupil, (points,): ``across`` and ``up`` whole numbers of steps from the centre.

    ``steps``: the pupil's radius in steps.
    """

    across: np.ndarray
    up: np.ndarray
    steps: float

    @property
    def points(self) -> tuple[np.ndarray, np.ndarray]:
        """Return ξ and η of the points."""
        return self.across / self.steps, self.up / self.steps


@lru_cache(maxsize=16)
def pupil_grid(sampling: int, radius: float | None = None) -> PupilGrid:
    """Return the points i/(N/2 − 1), i = −N/2 … N/2 − 1, along both axes within ``radius`` steps, or N/2 − 1."""
    steps = sampling // 2 - 1
    count = np.arange(-sampling // 2, sampling // 2)
    across, up = (part.ravel() for part in np.meshgrid(count, count))
    inside = across**2 + up**2 <= (steps if radius is None else radius) ** 2
    return PupilGrid(across[inside], up[inside], steps)


def grid_rays(lens: Lens, source: Source, grid: PupilGrid) -> Rays:
    """Return the rays through a grid over the paraxial entrance pupil, in the axes of the sensor."""
    return on_sensor(with_aim(lens, "paraxial"), [source], *grid.points).of_source(0)


def huygens_amplitude(lens: Lens, source: Source, sampling: int, pixels: int, pixel_um: float) -> np.ndarray:
    """Return the amplitude of OpticStudio's Huygens PSF, (pixels, pixels), over the unaberrated peak.

    Rays lie on `pupil_grid` within N/2 − 1.5 steps with equal weights; each is a plane wavelet about the chief ray, at
    sample pixels/2, and the sum falls off as sinc(x/(na))·sinc(y/(na)), n = N/2 − 1, a = 1.22 λF with F the distance of
    the exit pupil over its diameter: what squares of a grid in the pupil would diffract.
    """
    grid = pupil_grid(sampling, sampling / 2 - 1.5)
    rays = grid_rays(lens, source, grid)
    axis = centred_axis(pixels, pixel_um)
    fx, fy, phase = (np.ravel(part) for part in (rays.fx, rays.fy, rays.phase))
    field = np.zeros((pixels, pixels), complex)
    for first in range(0, fx.size, BLOCK):
        some = slice(first, first + BLOCK)
        wavelets = np.exp(2j * np.pi * (phase[some] + np.outer(axis, fy[some])))
        field += wavelets @ np.exp(2j * np.pi * np.outer(fx[some], axis)) / fx.size
    fall = np.sinc(axis / (grid.steps * AIRY * exit_pupil_width_um(lens, source)))
    amplitude: np.ndarray = field * fall * fall[:, None]
    return amplitude


def exit_pupil_width_um(lens: Lens, source: Source) -> float:
    """Return λF, µm, with F the distance of the exit pupil from the sensor over its diameter."""
    pupil = pupils(lens, source.wavelength_um)
    distance = abs(float(pupil.exit_from_last) - lens.sensor_mm)
    return source.wavelength_um * distance / float(pupil.exit_diameter)


def fft_intensity(lens: Lens, source: Source, sampling: int) -> tuple[np.ndarray, float]:
    """Return the intensity of a plain FFT of the pupil over the unaberrated peak, (2N, 2N), and its spacing, µm.

    The grid is N² with the pupil's radius N/2 − 1 steps for N = 32, a factor √2 fewer for every doubling of N, and
    zeros fill 2N. So the spacing is λF(N − 2)/(2N)·√(32/N), with the F of the rim's rays (a grid over the entrance
    pupil taken for one over direction cosines). Sample [N, N] is the chief ray.
    """
    radius = (sampling / 2 - 1) * sqrt(FFT_BASE / sampling)
    grid = pupil_grid(2 * sampling, radius)
    points = grid.across / radius, grid.up / radius
    seen, turned = in_azimuth(with_aim(lens, "paraxial"), source.azimuth_deg, *points)
    pupil = np.zeros((2 * sampling, 2 * sampling), complex)
    pupil[grid.up + sampling, grid.across + sampling] = np.exp(2j * np.pi * displayed_opd(seen, source, *turned))
    field = np.fft.fftshift(np.fft.fft2(np.fft.ifftshift(pupil))) / grid.across.size
    rim = pencil(seen, source, [0.0, 0.0], [1.0, -1.0])
    width = float(abs(np.diff(np.ravel(rim.ky))[0]))  # twice the sine of the cone
    return np.abs(field) ** 2, source.wavelength_um / width * 2 * radius / (2 * sampling)


SMALLEST, LARGEST = 16, 1024  # points along a side of a grid
Window = tuple[int, float]


def _huygens_grid(lens: Lens, source: Source, sampling: int, window: Window) -> np.ndarray:
    intensity: np.ndarray = np.abs(huygens_amplitude(lens, source, sampling, *window)) ** 2
    return intensity


def _plain_fft(lens: Lens, source: Source, sampling: int, window: Window) -> np.ndarray:
    """Return the FFT's picture at the samples of a window by a cubic spline, 0 beyond what it covers."""
    from scipy.interpolate import RectBivariateSpline

    made, pitch = fft_intensity(lens, source, sampling)
    own, wanted = centred_axis(len(made), pitch), centred_axis(*window)
    covered = (own[0] <= wanted) & (wanted <= own[-1])
    values = np.maximum(RectBivariateSpline(own, own, made)(wanted, wanted), 0.0)
    return np.where(covered & covered[:, None], values, 0.0)


def _paper_fft(lens: Lens, source: Source, sampling: int, window: Window) -> np.ndarray:
    six = coefficients(lens, source.depth_mm, source.field_slope, source.wavelength_um)
    return six_fft(six, *window, sampling)


PAPER = "the paper's FFT"
SAMPLED: dict[str, Callable[[Lens, Source, int, Window], np.ndarray]] = {
    "OpticStudio's Huygens": _huygens_grid,
    "plain FFT": _plain_fft,
    PAPER: _paper_fft,
}
"""Methods of study, by name: the intensity over a window from so many points along a side of their grid."""


def sampled_ways(samplings: Sequence[int], pixels: int) -> Iterator[tuple[str, str]]:
    """Yield names of `SAMPLED` and counts of points in words; the paper's FFT needs two points a sample."""
    for name in SAMPLED:
        yield from ((name, f"{count}²") for count in samplings if name != PAPER or count >= 2 * pixels)


def check_sampling(sampling: int) -> None:
    """Raise RequestError for a count of points along a side that is odd, too small or too large."""
    if sampling % 2 or not SMALLEST <= sampling <= LARGEST:
        raise RequestError(
            "{parameter} has {value}; give even numbers from {least} to {most}",
            parameter="samplings",
            value=sampling,
            least=SMALLEST,
            most=LARGEST,
        )


def sampled_psf(name: str, sampling: int, lens: Lens, source: Source, window: Window) -> Psf:
    """Return the PSF of one of `SAMPLED`, in the axes of the source's field.

    Raises GeometryError where a ray of the grid does not reach the sensor.
    """
    started = perf_counter()
    intensity = SAMPLED[name](lens, source, sampling, window)
    return Psf(
        values=intensity / intensity.sum(),
        pixel_um=window[1],
        wavelength_um=source.wavelength_um,
        method=name,
        figures=PsfFigures(strehl=float(intensity.max())),
        numbers=6 if name == PAPER else 0,
        rays=0 if name == PAPER else sampling**2,
        sampling=Message("{count} × {count} points", count=sampling),
        seconds=perf_counter() - started,
        error=None,
    )
