"""One point source: the place in (depth, field, wavelength) that a PSF belongs to."""

from dataclasses import dataclass
from math import inf


@dataclass(frozen=True)
class Source:
    """Depth in mm from the first vertex, chief-ray slope at the entrance pupil, wavelength in µm."""

    depth_mm: float = inf
    field_slope: float = 0.0
    wavelength_um: float = 0.5875618
