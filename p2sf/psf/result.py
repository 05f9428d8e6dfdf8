"""The point spread function as a result: samples, scale, and how they were computed."""

import warnings
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from p2sf.conventions import NM_PER_UM
from p2sf.errors import P2SFWarning
from p2sf.figures.compare import flatness_of
from p2sf.figures.psf_data import Figure, Later, PsfData
from p2sf.messages import Message, ParameterName

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

    from p2sf.figures.measures import Energy, LineSpread, Mtf

LEAST_LIGHT = 0.9  # share of all light below which a warning says that the window cuts off the PSF
HALF_OF_LIGHT = 0.5  # below which a window's relative L2 error is stated too
IN_WINDOW = "light in the window"  # name of `Psf.energy` wherever it is shown, also as the reference of other figures


@dataclass(frozen=True, eq=False)
class Psf(PsfData):
    """A point spread function, or a stack of them, and how it was computed.

    A notebook shows it as a picture. Its ``figures``, the attributes from ``strehl`` on, are read off the pupil that
    it was made from when they are first asked for. Until then it holds that pupil, some 40 bytes for each of its waves.

    Attributes
    ----------
    values : numpy.ndarray
        Samples of the intensity, shape (…, y, x), with unit sum in the window. Rows run towards +y, the direction of
        the field; sample N//2 along either axis is the chief ray.
    pixel_um : float
        Distance between samples, µm.
    wavelength_um : float or numpy.ndarray
        Wavelength, µm.
    method : str
        The method that computed it.
    numbers : int
        Number of coefficients that describe it.
    rays : int
        Number of rays traced.
    sampling : Message
        The grid used.
    seconds : float
        Computing time.
    error : float or None
        Bound on the relative L2 error of the method's own sum in the window; None if it promises none.
    azimuth_deg : float
        Direction on the sensor of the picture's +y axis, degrees from the sensor's +y towards its +x.
    integrated : bool
        Whether a sample is the light on a whole pixel; if not, it is the intensity at a point.
    sum_over_peak : float or numpy.ndarray or None
        Sum of the samples in units of the unaberrated peak.
    asked_error : float or None
        The 1 − R² that "auto" was asked to keep. Where ``predicted_error`` is above it, no method keeps it within some
        seconds, and ``error`` bounds the relative L2 error of the picture, not of its sum alone.
    strehl : float or numpy.ndarray or None
        Peak of the continuous picture, also between samples and not integrated over pixels, divided by the unaberrated
        peak of the same pupil; None if the method has no pupil. It is sought wherever rays land, also outside the
        window, unless that takes too many pupil samples: for a very wide blur only in the window.
    energy : float or numpy.ndarray or None
        Share of all light that falls into the window, although ``values`` have unit sum; None if unknown.
    peak_um : tuple or numpy.ndarray or None
        Position of that peak: x and y from the chief ray, µm; (…, 2) for a stack.
    other_peaks : int or numpy.ndarray
        Number of other maxima within 0.2 % of that peak at another distance from the chief ray, since mirror images
        and points of one ring are alike; where there are several, one of them may be higher by some 1e-4.
    predicted_error : float or None
        Predicted 1 − R² of the method against the reference, at these settings: due to its description of the pupil,
        which ``error`` does not include. None if no rays were traced to predict it.
    fresnel_number : float or None
        n'a²/(λz) of the exit pupil, of radius a at a distance z from the sensor; infinite of a pupil at infinity.
    plane_wave_error : float or None
        Predicted 1 − R² of plane waves, which every method but `spherical` sums, against spherical ones; None if not
        known. It is part of ``predicted_error`` only where "auto" chose the method.
    provenance : dict or None
        What it is of, as JSON has it: the lens with a hash, depth, field, wavelength, sensor, focus, f-number and mask.
    """

    @property
    def over_unaberrated(self) -> np.ndarray | None:
        """Return the samples in units of the unaberrated peak; None if the method has no pupil."""
        if self.sum_over_peak is not None:
            scale = np.asarray(self.sum_over_peak)[..., None, None]
        elif self.strehl is not None:  # from a file that does not state the sum
            peak = self.values.max((-2, -1), keepdims=True)
            scale = np.asarray(self.strehl)[..., None, None] / np.where(peak > 0, peak, 1.0)
        else:
            return None
        samples: np.ndarray = self.values * scale
        return samples

    @property
    def caution(self) -> Message | None:
        """Return a warning if the window misses much of the light, or "auto" could not keep its promise; else None."""
        found = [message for message in (self._cut_off, self.shortfall) if message]
        if len(found) < 2:
            return found[0] if found else None
        return Message("{first}. {second}", first=found[0], second=found[1])

    @property
    def shortfall(self) -> Message | None:
        """Return that "auto" could not keep the R² that it was asked for within some seconds; None where it does."""
        missed = None if self.asked_error is None else self.predicted_error
        if self.asked_error is None or missed is None or missed <= self.asked_error:
            return None
        if missed >= 1:
            return Message(
                "this blur takes more than some seconds to the accuracy asked for, 1 − R² ≤ {asked:.1e}; this picture "
                "of {method} may be wrong throughout; stop down, refocus, or choose a method by its name",
                asked=self.asked_error,
                method=self.method,
            )
        return Message(
            "this blur takes more than some seconds to the accuracy asked for, 1 − R² ≤ {asked:.1e}; {method} keeps "
            "1 − R² ≤ {error:.1e}, a relative L2 error of {l2:.1e}",
            asked=self.asked_error,
            method=self.method,
            error=missed,
            l2=float(np.sqrt(missed / flatness_of(self.values))),
        )

    @property
    def l2_error(self) -> float | None:
        """Return a bound on the relative L2 error of the picture in its window; None where none is known.

        Of its sum, ``error``, and of what describes the pupil, ``predicted_error``, which "auto" states of the window.
        """
        if self.error is None or self.predicted_error is None:
            return None
        flatness = 1.0 if self.asked_error is None else flatness_of(self.values)
        return float(np.hypot(self.error, np.sqrt(self.predicted_error / flatness)))

    @property
    def _energy_roughly(self) -> Figure:
        """Return the share of light, or an estimate while that costs as much as the picture."""
        found = self.figures.energy
        return found.roughly() if isinstance(found, Later) else self.energy

    @property
    def _cut_off(self) -> Message | None:
        energy = self._energy_roughly
        least = 1.0 if energy is None or not np.size(energy) else float(np.min(energy))
        if least >= LEAST_LIGHT:
            return None
        return Message(
            "the window of {width:.4g} µm holds {share:.3g} % of the light, and the PSF has unit sum within it; "
            "give more {pixels} or a larger {pixel}",
            width=self.values.shape[-1] * self.pixel_um,
            share=100 * least,
            pixels=ParameterName("pixels"),
            pixel=ParameterName("pixel_um"),
        )

    def __repr__(self) -> str:
        samples = "integrated pixels" if self.integrated else "samples"
        parts = [f"{self.method}, {' × '.join(map(str, self.values.shape))} {samples} of {self.pixel_um:.4g} µm"]
        if isinstance(self.wavelength_um, float):
            parts.append(f"{self.wavelength_um * NM_PER_UM:.5g} nm")
        if isinstance(self.strehl, float):
            parts.append(f"Strehl ratio {self.strehl:.3g}")
        energy = self._energy_roughly
        if isinstance(energy, float):
            parts.append(f"{100 * energy:.3g} % of the {IN_WINDOW}")
        if self.shortfall:
            parts.append(f"1 − R² up to {min(float(self.predicted_error or 0.0), 1.0):.1e}")
        if isinstance(energy, float) and energy < HALF_OF_LIGHT and self.l2_error:
            # R² compares with what little the light varies in such a window.
            parts.append(f"relative L2 error up to {min(self.l2_error, 1.0):.1e}")
        return f"<Psf: {', '.join(parts)}>"

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> np.ndarray:
        return np.array(self.values, dtype, copy=copy)

    def flipud(self) -> np.ndarray:
        """Return the samples with row 0 at the top, as pictures have it: turn a PSF so before it meets a picture.

        Of an odd number of rows the chief ray stays on the middle one.
        """
        return np.flip(self.values, -2)

    def mtf(self, frequency_per_mm: ArrayLike | None = None) -> "Mtf":
        """Return the contrast at frequencies, cycles per mm, by the samples; see `p2sf.mtf_of_psf`."""
        from p2sf.figures.samples import mtf_of_psf

        return mtf_of_psf(self, frequency_per_mm)

    def encircled_energy(self, radius_um: ArrayLike | None = None) -> "Energy":
        """Return the share of all light within radii of the centroid, µm, by the samples; see `p2sf.energy_of_psf`."""
        from p2sf.figures.samples import energy_of_psf

        return energy_of_psf(self, radius_um)

    def line_spread(self, position_um: ArrayLike | None = None) -> "LineSpread":
        """Return the images of a line and an edge at distances, µm, by the samples; see `p2sf.line_spread_of_psf`."""
        from p2sf.figures.samples import line_spread_of_psf

        return line_spread_of_psf(self, position_um)

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw the PSF on axes of matplotlib, new ones by default, and return them; see `p2sf.draw_psf`."""
        from p2sf.io.psf_plot import draw_psf

        if axes is None:
            from matplotlib import pyplot

            axes = pyplot.subplots(layout="constrained")[1]
        draw_psf(axes, self)
        return axes

    def to_xarray(self) -> "xarray.Dataset":
        """Return ``psf`` over ``y_um`` and ``x_um``, and ``energy``, with wavelength and pixel, as a dataset of xarray.

        Its attributes are those of `record`. The axes of a stack before these two are ``axis_0``, ``axis_1`` and so on.
        ExportError without xarray.
        """
        from p2sf.named_arrays import NamedArrays, along

        before = tuple(f"axis_{k}" for k in range(self.values.ndim - 2))
        wavelength = np.asarray(self.wavelength_um, dtype=float) * NM_PER_UM
        own = {"wavelength_nm": (before[len(before) - wavelength.ndim :], wavelength)}
        energy = np.asarray(np.nan if self.energy is None else self.energy, dtype=float)
        places = along("y_um", self.y_um) | along("x_um", self.x_um) | along("pixel_um", np.asarray(self.pixel_um))
        light = {"energy": (before[len(before) - energy.ndim :], energy)}
        arrays = {"psf": ((*before, "y_um", "x_um"), self.values)} | light
        return NamedArrays(arrays, places | own, self.record).to_xarray()

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the PSF to a file, .npz, .tiff, .csv, .fits, .nc or .png by its ending; see `p2sf.write_psf`."""
        from p2sf.io.psf_files import write_psf

        return write_psf(self, path)

    def _repr_png_(self) -> bytes | None:
        if self.values.ndim != 2:
            return None
        from io import BytesIO

        from p2sf.io.psf_plot import draw_psf

        picture = BytesIO()
        draw_psf(picture, self)
        return picture.getvalue()


def warn_of_window(psf: Psf, stacklevel: int = 3) -> Psf:
    """Return a PSF for a script, after a `P2SFWarning` if its window cuts it off."""
    if psf.caution:
        warnings.warn(str(psf.caution), P2SFWarning, stacklevel=stacklevel)
    return psf
