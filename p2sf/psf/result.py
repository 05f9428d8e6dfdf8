"""The point spread function as a result: samples, scale, and how they were computed."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, Generic, TypeVar, overload

import numpy as np

from p2sf.conventions import NM_PER_UM, centred_axis
from p2sf.errors import P2SFWarning
from p2sf.messages import Message, ParameterName

UNSTATED = Message("")
LEAST_LIGHT = 0.9  # share of all light below which a window cuts a PSF off, and this is said
IN_WINDOW = "light in the window"  # what `Psf.energy` is called wherever it is shown, and that figures may be shares of

Value = TypeVar("Value")
Figure = float | np.ndarray | None


class OnDemand(Generic[Value]):
    """A field of `Psf`, None by default, that may be given as a function without arguments: its first reader calls it.

    A picture that is dragged shows few of its figures, and some take as long as the picture.
    """

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = f"_{name}"

    @overload
    def __get__(self, psf: None, owner: type) -> None: ...

    @overload
    def __get__(self, psf: object, owner: type) -> Value: ...

    def __get__(self, psf: object | None, owner: type) -> Value | None:
        if psf is None:
            return None
        value = vars(psf)[self.name]
        if callable(value):
            value = vars(psf)[self.name] = value()
        found: Value = value
        return found

    def __set__(self, psf: object, value: Value | Callable[[], Value]) -> None:
        vars(psf)[self.name] = value


@dataclass(frozen=True, eq=False)
class Psf:
    """A point spread function, or a stack of them, and how it was computed.

    A notebook shows it as a picture. ``strehl``, ``energy`` and ``peak_um`` may be given as functions without
    arguments, which are called when the values are first read.

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
        The method that made it.
    strehl : float or numpy.ndarray or None
        Peak of the continuous picture, between samples too and of no pixel's width, over the unaberrated peak of the
        same pupil; None if the method has no pupil. It is looked for wherever rays land, outside the window too,
        unless that takes too many pupil samples: of a very wide blur only in the window.
    energy : float or numpy.ndarray or None
        Share of all light that falls into the window, though ``values`` have unit sum; None if it is not known.
    numbers : int
        How many coefficients describe it.
    rays : int
        How many rays were traced.
    sampling : Message
        Which grid was used.
    seconds : float
        How long it took.
    tolerance : float or None
        Bound on the relative L2 error of the method's own sum in the window; None if it promises none.
    predicted_error : float or None
        Predicted 1 − R² of the method against the reference, at these settings: what its description of the pupil
        misses, which ``tolerance`` does not include. None if no rays were traced from which to tell.
    azimuth_deg : float
        Direction on the sensor of the picture's +y axis, degrees from the sensor's +y towards its +x.
    integrated : bool
        Whether a sample is the light on a whole pixel; if not, it is the intensity at a point.
    peak_um : tuple or numpy.ndarray or None
        Where that peak is: x and y from the chief ray, µm, of a stack (…, 2).
    sum_over_peak : float or numpy.ndarray or None
        Sum of the samples in units of the unaberrated peak.
    """

    values: np.ndarray
    pixel_um: float
    wavelength_um: float | np.ndarray
    method: str
    strehl: OnDemand[Figure] = OnDemand()
    energy: OnDemand[Figure] = OnDemand()
    numbers: int = 0
    rays: int = 0
    sampling: Message = UNSTATED
    seconds: float = 0.0
    tolerance: float | None = None
    azimuth_deg: float = 0.0
    predicted_error: float | None = None
    integrated: bool = False
    peak_um: OnDemand[tuple[float, float] | np.ndarray | None] = OnDemand()
    sum_over_peak: float | np.ndarray | None = None

    def with_fields(self, **values: Any) -> "Psf":
        """Return the same PSF but for these fields; figures not worked out yet stay so, unlike with `replace`."""
        own = {name.removeprefix("_"): value for name, value in vars(self).items()}
        return Psf(**own | values)

    def __reduce__(self) -> tuple[Any, ...]:
        return Psf, tuple(getattr(self, field.name) for field in fields(self))

    @property
    def over_unaberrated(self) -> np.ndarray | None:
        """Return the samples in units of the unaberrated peak; None if the method has no pupil."""
        if self.sum_over_peak is not None:
            scale = np.asarray(self.sum_over_peak)[..., None, None]
        elif self.strehl is not None:  # of a file that does not state the sum
            peak = self.values.max((-2, -1), keepdims=True)
            scale = np.asarray(self.strehl)[..., None, None] / np.where(peak > 0, peak, 1.0)
        else:
            return None
        samples: np.ndarray = self.values * scale
        return samples

    @property
    def caution(self) -> Message | None:
        """Return a warning where the window leaves out much of the light, None where it does not."""
        least = 1.0 if self.energy is None or not np.size(self.energy) else float(np.min(self.energy))
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

    @property
    def x_um(self) -> np.ndarray:
        """Return the positions of the columns, shape (x,), µm from the chief ray."""
        return centred_axis(self.values.shape[-1], self.pixel_um)

    @property
    def y_um(self) -> np.ndarray:
        """Return the positions of the rows, shape (y,), µm from the chief ray, towards the field."""
        return centred_axis(self.values.shape[-2], self.pixel_um)

    def __repr__(self) -> str:
        samples = "integrated pixels" if self.integrated else "samples"
        parts = [f"{self.method}, {' × '.join(map(str, self.values.shape))} {samples} of {self.pixel_um:.4g} µm"]
        if isinstance(self.wavelength_um, float):
            parts.append(f"{self.wavelength_um * NM_PER_UM:.5g} nm")
        if isinstance(self.strehl, float):
            parts.append(f"Strehl ratio {self.strehl:.3g}")
        if isinstance(self.energy, float):
            parts.append(f"{100 * self.energy:.3g} % of the {IN_WINDOW}")
        return f"<Psf: {', '.join(parts)}>"

    def _repr_png_(self) -> bytes | None:
        if self.values.ndim != 2:
            return None
        from io import BytesIO

        from p2sf import draw_psf

        picture = BytesIO()
        draw_psf(picture, self)
        return picture.getvalue()


def warn_of_window(psf: Psf, stacklevel: int = 3) -> Psf:
    """Return a PSF for a script to use, after a `P2SFWarning` where its window cuts it off."""
    if psf.caution:
        warnings.warn(str(psf.caution), P2SFWarning, stacklevel=stacklevel)
    return psf
