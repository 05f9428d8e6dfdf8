"""Contrast, energy and line spread of any PSF by its samples, as the figures of a pupil are given (handbook 6.3).

What lies outside the window is not known: ``predicted_error`` bounds what that may change, by the light that is missing
there. Of pixels that hold the light that falls on them, all figures are those of the pixels too.
"""

import numpy as np
from numpy.typing import ArrayLike

from p2sf.arguments import check_arguments, number_list
from p2sf.errors import SamplingError
from p2sf.figures import window
from p2sf.figures.hankel import HankelEnergy, hankel_energy
from p2sf.figures.measures import PARTS, Energy, LineSpread, Mtf
from p2sf.figures.psf_data import PsfData

RADII = 129


@check_arguments
def mtf_of_psf(psf: PsfData, frequency_per_mm: ArrayLike | None = None) -> Mtf:
    """Compute the contrast of sine patterns from the samples of a PSF.

    Parameters
    ----------
    psf : Psf
        One PSF.
    frequency_per_mm : array_like, optional
        Cycles per mm on the sensor, one or (n,); by default even ones up to the Nyquist frequency, beyond which the
        contrast is NaN.

    Returns
    -------
    Mtf
        Tangential and sagittal contrast; that of a pupil without phase is not known and NaN. ``predicted_error`` is
        2(1 − energy), which no contrast is off by more than: |W/e − (W + O)| ≤ |W|(1/e − 1) + |O|, W being the
        transform of the window's light e and O that of the light outside, |W| ≤ e and |O| ≤ 1 − e.

    Raises
    ------
    SamplingError
        For a stack of PSFs.

    Examples
    --------
    >>> import numpy as np, p2sf
    >>> psf = p2sf.psf_of_opd(np.zeros((128, 128)), na=0.1, wavelength_nm=500, pixels=128)
    >>> psf.mtf([0, 200]).sagittal.round(2)
    array([1.  , 0.39])
    """
    _check_one(psf)
    given = None if frequency_per_mm is None else number_list("frequency_per_mm", frequency_per_mm)
    frequency, tangential, sagittal = window.mtf(psf, given)
    unknown = np.full(frequency.shape, np.nan)
    error = min(2 * _outside(psf), 1.0)
    return Mtf(frequency, tangential, sagittal, unknown, unknown, psf.method, unknown, unknown, predicted_error=error)


@check_arguments
def energy_of_psf(psf: PsfData, radius_um: ArrayLike | None = None) -> Energy:
    """Compute from the samples of a PSF which share of all light lies within a radius of the window's centroid.

    Parameters
    ----------
    psf : Psf
        One PSF.
    radius_um : array_like, optional
        Radii, µm, (n,); by default even ones to the corner of the window.

    Returns
    -------
    Energy
        The share within each radius, of all light as far as ``psf.energy`` says how much the window holds; the radii of
        50 % and 80 % of all light, NaN where the window holds less; ``rms_um`` is not known and NaN.
        ``predicted_error`` is the light outside the window, if a circle reaches beyond it, else 0.

    Raises
    ------
    SamplingError
        For a stack of PSFs.

    Examples
    --------
    >>> import numpy as np, p2sf
    >>> psf = p2sf.psf_of_opd(np.zeros((128, 128)), na=0.1, wavelength_nm=500, pixels=128, pixel_um=0.5)
    >>> psf.encircled_energy([3.05]).fraction.round(2)
    array([0.84])
    """
    _check_one(psf)
    right, up = (float(place) for place in window.centroid(psf))
    corner = psf.pixel_um * float(np.hypot(*psf.values.shape)) / 2
    table = np.linspace(0, corner, RADII)
    radius = table if radius_um is None else np.abs(number_list("radius_um", radius_um))
    energy, held = _energy_about(psf, right, up), 1 - _outside(psf)
    half, most = (energy.radius_of(part / held, table) if part <= held else float("nan") for part in PARTS)
    fraction = held * np.where(radius < corner, np.clip(energy.within(np.minimum(radius, corner)), 0.0, 1.0), 1.0)
    nearest = min(size / 2 * psf.pixel_um - abs(off) for size, off in zip(psf.values.shape, (up, right), strict=True))
    error = _outside(psf) if radius.max(initial=0.0) > nearest else 0.0
    made = radius, fraction, up, half, most, float("nan"), psf.method
    return Energy(*made, centroid_x_um=right, predicted_error=error)


def _energy_about(psf: PsfData, x_um: float, y_um: float) -> HankelEnergy:
    """Return the energy about a point of the picture whose samples these are, dark outside the window.

    Between samples it is the sum of the waves that they hold, which is the picture itself where they are `resolved`.
    """
    from scipy import fft

    rows, columns = psf.values.shape
    size = fft.next_fast_len(3 * max(rows, columns))  # so that a circle of the window's size meets no copy of it
    room = np.zeros((size, size))
    room[:rows, :columns] = psf.values
    return hankel_energy(
        fft.fft2(np.roll(room, (-(rows // 2), -(columns // 2)), (0, 1))), 1 / (size * psf.pixel_um), x_um, y_um
    )


@check_arguments
def line_spread_of_psf(psf: PsfData, position_um: ArrayLike | None = None) -> LineSpread:
    """Compute the images of a line and of an edge from the samples of a PSF, as if all light were in its window.

    Parameters
    ----------
    psf : Psf
        One PSF.
    position_um : array_like, optional
        Distances from the centroid, µm, (n,); by default those of the samples. Beyond the window there is no light.

    Returns
    -------
    LineSpread
        Light per µm across a line along y and a line along x, by a cubic spline through the sums of rows and columns,
        and its integrals across edges.

    Raises
    ------
    SamplingError
        For a stack of PSFs.

    Examples
    --------
    >>> import numpy as np, p2sf
    >>> psf = p2sf.psf_of_opd(np.zeros((128, 128)), na=0.1, wavelength_nm=500, pixels=128)
    >>> psf.line_spread([0.0]).edge_x.round(3)
    array([0.5])
    """
    _check_one(psf)
    right, up = (float(place) for place in window.centroid(psf))
    position = psf.x_um - right if position_um is None else number_list("position_um", position_um)
    line_x, edge_x = _spread(psf.values.sum(-2, dtype=float), psf.x_um - right, position)
    line_y, edge_y = _spread(psf.values.sum(-1, dtype=float), psf.y_um - up, position)
    return LineSpread(position, line_x, line_y, edge_x, edge_y, up, psf.method, right)


def _spread(line: np.ndarray, places: np.ndarray, position: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return light per µm and the light up to positions, of light per sample at places."""
    from scipy.interpolate import make_interp_spline

    spline = make_interp_spline(places, line / (places[1] - places[0]), min(3, places.size - 1))
    inside = np.clip(position, places[0], places[-1])
    integral = spline.antiderivative()
    low, high = (float(integral(end)) for end in (places[0], places[-1]))
    found: np.ndarray = np.where(inside == position, spline(inside), 0.0) / (high - low)
    return found, (integral(inside) - low) / (high - low)


def _outside(psf: PsfData) -> float:
    """Return the share of the light outside the window, 0 if it is not known."""
    return 0.0 if psf.energy is None else max(0.0, 1 - float(psf.energy))


def _check_one(psf: PsfData) -> None:
    if psf.values.ndim != 2 or min(psf.values.shape) < 2:
        raise SamplingError(
            "figures are of one PSF of two samples a side or more, and this one has the shape {shape}; ask for one "
            "after the other",
            shape=str(psf.values.shape),
        )
