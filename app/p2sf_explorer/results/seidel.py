"""How much each surface adds to each coefficient."""

from dataclasses import dataclass

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.paraxial.seidel import seidel_sums
from p2sf_explorer.compute.live import Live


@dataclass(frozen=True)
class PerSurface:
    """Contribution to each coefficient in waves, (surfaces,) each; the sum over surfaces is the coefficient."""

    waves: dict[str, np.ndarray]
    stop_surface: int


def per_surface(live: Live) -> PerSurface:
    """Return W40, W31, W22, W20 and W11 split over the surfaces (handbook 3.2)."""
    setup = live.setup
    sums = seidel_sums(setup.lens, setup.rays, setup.source.field_slope)
    waves = UM_PER_MM / setup.source.wavelength_um
    split = {
        "w40": sums.spherical / 8,
        "w31": sums.coma / 2,
        "w22": sums.astigmatism / 2,
        "w20": (sums.astigmatism + sums.petzval) / 4,
        "w11": sums.distortion / 2,
    }
    return PerSurface({name: column * waves for name, column in split.items()}, int(setup.stop.surface))
