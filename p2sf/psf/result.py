"""The point spread function as a result: samples, scale, and how they came about."""

from dataclasses import dataclass

import numpy as np

from p2sf.conventions import centred_axis


@dataclass(frozen=True)
class Psf:
    """One PSF, or a stack of them, and how it was made.

    ``values``: (…, y, x), unit sum in the window, rows +y (the field's direction), sample N//2 the chief ray.
    ``strehl``: peak over the unaberrated peak of the same pupil, None where no pupil is behind it. ``energy``: fraction
    of all light that falls into the window. ``numbers``: how many coefficients describe it; ``rays``: how many traced.
    ``sampling`` says in words what grid was used; ``seconds`` how long it took; ``tolerance`` what the method
    itself promises (relative L2 in the window), None where it promises nothing.
    """

    values: np.ndarray
    pixel_um: float
    wavelength_um: float
    method: str
    strehl: float | np.ndarray | None
    energy: float | np.ndarray | None = None
    numbers: int = 0
    rays: int = 0
    sampling: str = ""
    seconds: float = 0.0
    tolerance: float | None = None

    @property
    def x_um(self) -> np.ndarray:
        """Column positions, µm from the chief ray."""
        return centred_axis(self.values.shape[-1], self.pixel_um)

    @property
    def y_um(self) -> np.ndarray:
        """Row positions, µm from the chief ray, towards the field."""
        return centred_axis(self.values.shape[-2], self.pixel_um)
