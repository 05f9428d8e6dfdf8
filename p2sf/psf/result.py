"""The point spread function as a result: samples, scale, and how they were computed."""

from dataclasses import dataclass

import numpy as np

from p2sf.conventions import NM_PER_UM, centred_axis
from p2sf.messages import Message

UNSTATED = Message("")


@dataclass(frozen=True, eq=False)
class Psf:
    """A point spread function, or a stack of them, and how it was computed.

    A notebook shows it as a picture.

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
        Peak over the unaberrated peak of the same pupil; None if the method has no pupil.
    energy : float or numpy.ndarray or None
        Share of all light that falls into the window; None if the samples are too far apart to tell.
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
    """

    values: np.ndarray
    pixel_um: float
    wavelength_um: float | np.ndarray
    method: str
    strehl: float | np.ndarray | None
    energy: float | np.ndarray | None = None
    numbers: int = 0
    rays: int = 0
    sampling: Message = UNSTATED
    seconds: float = 0.0
    tolerance: float | None = None
    azimuth_deg: float = 0.0
    predicted_error: float | None = None
    integrated: bool = False

    @property
    def x_um(self) -> np.ndarray:
        """Return the positions of the columns, shape (x,), µm from the chief ray."""
        return centred_axis(self.values.shape[-1], self.pixel_um)

    @property
    def y_um(self) -> np.ndarray:
        """Return the positions of the rows, shape (y,), µm from the chief ray, towards the field."""
        return centred_axis(self.values.shape[-2], self.pixel_um)

    def __repr__(self) -> str:
        parts = [f"{self.method}, {' × '.join(map(str, self.values.shape))} samples of {self.pixel_um:.4g} µm"]
        if isinstance(self.wavelength_um, float):
            parts.append(f"{self.wavelength_um * NM_PER_UM:.5g} nm")
        if isinstance(self.strehl, float):
            parts.append(f"Strehl ratio {self.strehl:.3g}")
        return f"<Psf: {', '.join(parts)}>"

    def _repr_png_(self) -> bytes | None:
        if self.values.ndim != 2:
            return None
        from io import BytesIO

        from p2sf import draw_psf

        picture = BytesIO()
        draw_psf(picture, self)
        return picture.getvalue()
