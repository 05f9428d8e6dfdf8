"""Light as a vector: the integral of Richards and Wolf for unpolarised light through an aberrated pupil.

A converging ray has its electric field at right angles to itself. Fields of steep rays are not parallel, do not
interfere as numbers do, and partly point along the axis (Richards & Wolf 1959, Proc. R. Soc. A 253, eq. 2.30 to 2.32).
Both polarisations of the chief ray are carried to every ray by the rotation that takes one direction into the other,
which is what surfaces without coatings do to first order; of unpolarised light half of the energy has each.

A plane wave per unit of f carries |a|²·cos θ through the sensor, so that a ray of light L has the amplitude
√(L·|∂f/∂(ξ, η)|/cos θ). That of `huygens` is the light alone.
"""

from dataclasses import dataclass
from functools import lru_cache
from time import perf_counter

import numpy as np

from p2sf.conventions import centred_axis
from p2sf.disc.quadrature import gauss_legendre
from p2sf.disc.transform import sum_plane_waves
from p2sf.figures.compare import r_squared
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.prediction import CAUTION
from p2sf.psf.result import Psf
from p2sf.pupil.fit import fit
from p2sf.pupil.plane_waves import disc_words, pupil_amplitude, window_reach_um
from p2sf.pupil.rays import RayPupil
from p2sf.raytrace.pencil import rays_through
from p2sf.threads import one_blas_thread

POLAR_NODES = 200  # of the analytic integrals
WINDOW = 6.0, 129  # λ/NA on either side of the middle, and samples, where vector and scalar light are compared
STEPS = 24  # of bisection: to 5e-8


@one_blas_thread
def vector_psf(lens: Lens, source: Source, pixels: int, pixel_um: float, clip: bool = False) -> Psf:
    """Return the PSF of unpolarised light as a vector, of as many exact rays as blur and window need.

    Its samples are the electric energy. Raises GeometryError where rays do not reach the sensor, SamplingError where
    too many are needed.
    """
    started, pupil = perf_counter(), RayPupil(lens, source, clip, areas=fit(lens, source))
    counts = pupil.counts(window_reach_um(pixels, pixel_um))
    rays = rays_through(lens, source, pupil.nodes(counts).unfolded()).arrived
    chief = np.array([float(np.ravel(k)[0]) for k in (rays.chief_kx, rays.chief_ky, rays.chief_kz)])
    cosines = np.stack([rays.kx, rays.ky, rays.kz])
    amplitude = pupil_amplitude(pupil.fields(rays) / np.sqrt(np.abs(rays.kz)), rays.phase)
    axis = centred_axis(pixels, pixel_um)
    values = vector_intensity(amplitude, (rays.fx, rays.fy), polarisations(cosines, chief), axis)
    return Psf(
        values=values / values.sum(),
        pixel_um=pixel_um,
        wavelength_um=float(source.wavelength_um),
        method="vector",
        rays=rays.kx.size,
        sampling=Message("{nodes}, unpolarised", nodes=disc_words(counts)),
        seconds=perf_counter() - started,
    )


def polarisations(cosines: np.ndarray, chief: np.ndarray) -> np.ndarray:
    """Return the two electric directions of every ray, (2, 3, ray), of ``cosines`` (3, ray) beside a ``chief``, (3,).

    They are a pair across the chief ray, turned as that turns into the ray (Rodrigues 1840).
    """
    first = np.cross([0.0, 1.0, 0.0], chief)
    first /= np.linalg.norm(first)
    pair = np.stack([first, np.cross(chief, first)])
    axis = np.cross(chief, cosines.T)
    turned = np.cross(axis, pair[:, None])
    found = pair[:, None] + turned + np.cross(axis, turned) / (1 + cosines.T @ chief)[:, None]
    return np.moveaxis(found, -1, 1)


def vector_intensity(
    amplitude: np.ndarray, frequencies: tuple[np.ndarray, np.ndarray], electric: np.ndarray, axis: np.ndarray
) -> np.ndarray:
    """Return the intensity of unpolarised light over a square, (y, x): the mean over both polarisations of |E|²."""
    field = sum_plane_waves(amplitude * electric, *frequencies, axis, axis, even=False)
    intensity: np.ndarray = (field.real**2 + field.imag**2).sum((0, 1)) / 2
    return intensity


@dataclass(frozen=True, eq=False)
class AplanaticField:
    """I0, I1 and I2 of a perfect lens that keeps the sine condition, and its field as a scalar, all (radius,)."""

    i0: np.ndarray
    i1: np.ndarray
    i2: np.ndarray
    scalar: np.ndarray

    @property
    def unpolarised(self) -> np.ndarray:
        """Return |I0|² + 2|I1|² + |I2|², the electric energy of unpolarised light."""
        energy: np.ndarray = self.i0**2 + 2 * self.i1**2 + self.i2**2
        return energy


def aplanatic_field(na: float, radius: np.ndarray) -> AplanaticField:
    """Return the field in the focus of an aplanatic lens in air at radii in wavelengths (Richards & Wolf 1959)."""
    from scipy.special import j0, j1, jv

    place, weight = gauss_legendre(POLAR_NODES)
    theta = np.arcsin(na) * (1 + place) / 2
    sine, cosine = np.sin(theta), np.cos(theta)
    v, share = 2 * np.pi * np.outer(radius, sine), weight * np.sqrt(cosine) * sine
    return AplanaticField(
        j0(v) @ (share * (1 + cosine)),
        j1(v) @ (share * sine),
        jv(2, v) @ (share * (1 - cosine)),
        j0(v) @ (weight * sine * cosine),
    )


@lru_cache(maxsize=64)
def scalar_error(na: float) -> float:
    """Return 1 − R² of a scalar sum over an even pupil against unpolarised light, both of a perfect lens in air."""
    axis = centred_axis(WINDOW[1], 2 * WINDOW[0] / na / WINDOW[1])
    radii, place = np.unique(np.hypot(axis, axis[:, None]), return_inverse=True)
    found = aplanatic_field(na, radii)
    pictures = (picture[place].reshape(axis.size, -1) for picture in (found.scalar**2, found.unpolarised))
    return 1 - r_squared(*pictures)


def boundary_na(error: float = CAUTION) -> float:
    """Return the numerical aperture in air above which scalar light leaves more than this 1 − R² in focus."""
    low, high = 0.1, 0.95
    for _ in range(STEPS):
        middle = (low + high) / 2
        low, high = (middle, high) if scalar_error(middle) < error else (low, middle)
    return low
