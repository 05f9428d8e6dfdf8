"""The PSF of a measured or imported wavefront map."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from math import sqrt
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments, real_array
from p2sf.conventions import NM_PER_UM, centred_axis
from p2sf.disc.domain import WHOLE
from p2sf.disc.quadrature import cell_areas
from p2sf.disc.transform import matrix_dft
from p2sf.errors import SamplingError
from p2sf.files.writing import plain
from p2sf.messages import Message
from p2sf.parameters import check_positive, check_samples
from p2sf.psf import pixel_integrals
from p2sf.psf.opd_array import opd_intensity
from p2sf.psf.peak import Peak, peak_of
from p2sf.psf.picture import psf_of_intensity, resolved
from p2sf.psf.result import Psf, warn_of_window
from p2sf.pupil.plane_waves import Waves
from p2sf.threads import one_blas_thread

STEEPEST_STEP = 0.5  # waves between neighbouring cells: a steeper phase is aliased


@check_arguments
@one_blas_thread
def psf_of_opd(
    opd_waves: ArrayLike,
    na: float,
    wavelength_nm: float,
    *,
    amplitude: ArrayLike | None = None,
    pixels: int = 64,
    pixel_um: float | None = None,
    integrated: bool | None = None,
) -> Psf:
    """Compute the PSF of a wavefront that is given as an array over the pupil, |FT{A·exp(i2πW)}|².

    Parameters
    ----------
    opd_waves : array_like
        W in waves on the cells of a square grid over the pupil, shape (size, size): cell centres at
        (2k + 1 − size)/size of the pupil's radius, rows towards +η, columns towards +ξ. W = (optical path of the chief
        ray − that of the ray)/λ, positive for undercorrected spherical aberration. A cell that is NaN, or
        masked, is opaque.
    na : float
        Numerical aperture n'·sin u' of the image at the pupil's rim.
    wavelength_nm : float
        Wavelength, nm.
    amplitude : array_like, optional
        Amplitude transmitted by each cell, 0 to 1, same shape; by default the share of the cell inside the unit disc.
    pixels : int
        Samples along each side.
    pixel_um : float, optional
        Distance between samples, µm; by default λ/(4·na), which loses nothing.
    integrated : bool, optional
        Whether a sample is the light on the square pixel around it, or the intensity at its centre; by default light if
        pixels are wider than λ/(4·na).

    Returns
    -------
    Psf
        Samples with unit sum, and in ``energy`` their share of all light; below 0.9 a ``P2SFWarning`` says so. A
        wavefront with a tilt towards −η (W falls with η) lands at +y.

    Raises
    ------
    RequestError
        For a numerical aperture, wavelength or distance that is not positive, and for complex numbers.
    SamplingError
        For arrays that are not equal squares, a grid too coarse for the wavefront or the window, or an opaque pupil.

    Examples
    --------
    >>> import numpy as np, p2sf
    >>> p2sf.psf_of_opd(np.zeros((128, 128)), na=0.1, wavelength_nm=550)
    <Psf: opd, 64 × 64 samples of 1.375 µm, 550 nm, Strehl ratio 1, 98.8 % of the light in the window>
    """
    check_positive("pixel_um", pixel_um)
    cells = cells_of(opd_waves, na, wavelength_nm, amplitude)
    return warn_of_window(psf_of_cells(cells, pixels, pixel_um, integrated), 5)


@dataclass(frozen=True, eq=False)
class Cells:
    """A wavefront on the cells of a square grid over the pupil, (size, size) each, as `psf_of_opd` has it.

    ``opd``: in waves, 0 where nothing passes. ``clear``: the amplitude that passes. ``light``: how much light does; of
    a cell that the rim cuts, its covered part.
    """

    opd: np.ndarray
    clear: np.ndarray
    light: np.ndarray
    na: float
    wavelength_nm: float

    @property
    def wavelength_um(self) -> float:
        """Return the wavelength, µm."""
        return self.wavelength_nm / NM_PER_UM

    @property
    def spread(self) -> float:
        """Return the frequency of the pupil's rim, cycles per µm."""
        return self.na / self.wavelength_um

    @property
    def step(self) -> float:
        """Return the frequency from one cell to the next, cycles per µm."""
        return 2 * self.spread / len(self.opd)

    def psf(self, pixels: int, pixel_um: float) -> Psf:
        """Return the PSF at points."""
        start, size, spread = perf_counter(), len(self.opd), self.spread
        cycles, opd, clear = spread * pixel_um, self.opd, self.clear
        if size % 2 == 0 and np.array_equal(opd, opd[:, ::-1]) and np.array_equal(clear, clear[:, ::-1]):
            intensity = opd_intensity(opd, clear, cycles, pixels, np.float64)
        else:
            frequency, axis = cycles * centres(size), centred_axis(pixels)
            field = matrix_dft(clear * np.exp(2j * np.pi * opd), frequency, frequency, axis, axis)
            intensity = np.abs(field / clear.sum()) ** 2
        light = self.light_um2 if resolved(spread, pixel_um) else None
        psf = psf_of_intensity(intensity, pixel_um, self.wavelength_um, "opd", light, self._peak(intensity, pixel_um))
        return replace(
            psf,
            numbers=int(np.count_nonzero(clear)),
            sampling=Message("{size} × {size} cells", size=size),
            seconds=perf_counter() - start,
        )

    def light_um2(self) -> float:
        """Return ∫|field|²dx over the plane in µm² at unit unaberrated peak, by Parseval."""
        return float(self.light.sum() / self.clear.sum() ** 2 / self.step**2)

    def _peak(self, intensity: np.ndarray, pixel_um: float) -> Callable[[], Peak]:
        return lambda: peak_of(intensity, pixel_um, self.waves, lambda _: None)

    @cached_property
    def waves(self) -> Waves:
        """Return the plane waves of the cells that transmit light, valid up to where their PSF repeats."""
        size, spread = len(self.opd), self.spread
        along, lit = spread * centres(size), self.clear > 0
        fy, fx = np.meshgrid(along, along, indexing="ij")
        amplitude = (self.clear * np.exp(2j * np.pi * self.opd))[lit] / self.clear.sum()
        blur = sqrt(2) * _steepest_step(self.opd, self.clear) * size / 2 / spread
        return Waves(amplitude, fx[lit], fy[lit], WHOLE, blur, reach_um=size / (2 * spread) / sqrt(2))


def cells_of(opd_waves: ArrayLike, na: float, wavelength_nm: float, amplitude: ArrayLike | None) -> Cells:
    """Return the cells of arrays; RequestError and SamplingError as `psf_of_opd`."""
    check_positive("na", na)
    check_positive("wavelength_nm", wavelength_nm)
    opd, clear = pupil_of_cells(opd_waves, amplitude)
    return Cells(opd, clear, clear if amplitude is None else clear**2, na, wavelength_nm)


def psf_of_cells(cells: Cells, pixels: int, pixel_um: float | None, integrated: bool | None) -> Psf:
    """Return the PSF of cells at points or as light per pixel; SamplingError as `psf_of_opd`."""
    critical_um = cells.wavelength_um / (4 * cells.na)
    pitch = critical_um if pixel_um is None else float(pixel_um)
    _check_window(len(cells.opd), cells.spread, pixels, pitch)
    psf = pixel_integrals.integrate(cells.psf, pixels, pitch, critical_um, integrated)
    given = {"cells": len(cells.opd), "na": cells.na, "wavelength_nm": cells.wavelength_nm}
    return psf.with_figures(provenance={"wavefront": plain(given)})


def centres(size: int) -> np.ndarray:
    """Return the centres of the cells along one side of a grid over −1…1, shape (size,)."""
    return (2 * np.arange(size) + 1 - size) / size


def pupil_of_cells(opd_waves: ArrayLike, amplitude: ArrayLike | None) -> tuple[np.ndarray, np.ndarray]:
    """Return the wavefront, 0 in opaque cells, and the amplitude; SamplingError as `psf_of_opd`."""
    opd = real_array("opd_waves", opd_waves)
    if opd.ndim != 2 or opd.shape[0] != opd.shape[1] or not opd.size:
        raise SamplingError("the wavefront has the shape {shape}; give a square array", shape=str(opd.shape))
    cells = centres(len(opd))
    clear = cell_areas(cells, cells, 2 / len(opd)) if amplitude is None else real_array("amplitude", amplitude, 0.0)
    if clear.shape != opd.shape:
        raise SamplingError(
            "the amplitude has the shape {shape} and the wavefront {wavefront}; give both on the same cells",
            shape=str(clear.shape),
            wavefront=str(opd.shape),
        )
    clear = np.where(np.isfinite(opd), clear, 0.0)
    if not (np.isfinite(clear).all() and (clear >= 0).all() and clear.any()):
        raise SamplingError("the amplitude is not finite, negative, or 0 everywhere; give one that lets light through")
    opd[clear == 0] = 0.0
    _check_steps(opd, clear)
    return opd, clear


def _check_steps(opd: np.ndarray, clear: np.ndarray) -> None:
    """Raise SamplingError if the wavefront changes too fast from cell to cell for its grid."""
    step = _steepest_step(opd, clear)
    if step > STEEPEST_STEP:
        raise SamplingError(
            "the wavefront changes by {step:.3g} waves from one cell to the next, and more than {most:g} is ambiguous; "
            "give it on a finer grid, without jumps of whole waves",
            step=step,
            most=STEEPEST_STEP,
        )


def _steepest_step(opd: np.ndarray, clear: np.ndarray) -> float:
    """Return the largest change of the wavefront between neighbouring cells that both transmit light, waves."""
    return max(float(np.abs(np.diff(opd, axis=k))[np.minimum(*_pairs(clear, k)) > 0].max(initial=0.0)) for k in (0, 1))


def _pairs(values: np.ndarray, axis: int) -> tuple[np.ndarray, np.ndarray]:
    """Return every value but the last along an axis, and its neighbour."""
    moved = np.moveaxis(values, axis, 0)
    return np.moveaxis(moved[:-1], 0, axis), np.moveaxis(moved[1:], 0, axis)


def _check_window(size: int, spread: float, pixels: int, pixel_um: float) -> None:
    """Raise SamplingError for a window in which the PSF of a grid would repeat."""
    check_samples(pixels, pixel_um)
    period, window = size / (2 * spread), pixels * pixel_um
    if window > period * (1 + 1e-9):
        raise SamplingError(
            "a wavefront on {size} cells repeats its PSF every {period:.4g} µm, and the window is {window:.4g} µm "
            "wide; give a finer grid or a smaller window",
            size=size,
            period=period,
            window=window,
        )
