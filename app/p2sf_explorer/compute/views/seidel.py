"""How much each surface adds to each Seidel coefficient and to the two chromatic sums."""

from dataclasses import dataclass

import numpy as np

from p2sf.conventions import NM_PER_UM, UM_PER_MM
from p2sf.paraxial.seidel import Coefficients, check_seidel, chromatic_sums, seidel_sums
from p2sf_explorer.compute.live import Live, View


@dataclass(frozen=True)
class PerSurface:
    """Contributions in waves of the source's wavelength at the pupil's rim, (surfaces,) each; they add up to the whole.

    ``waves``: W40, W31, W22, W20 and W11; of W20 also the part of the Petzval sum; ``c1`` = C_I/2 and ``c2`` = C_II,
    defocus and tilt of the first of ``colours_nm`` less those of the second, the shortest and the longest wavelength of
    the lens.
    """

    waves: dict[str, np.ndarray]
    stop_surface: int
    colours_nm: tuple[float, float]


def six(live: Live) -> View[Coefficients]:
    """Return the coefficients of the picture; GeometryError for a lens that has none, unless its pupil is free."""
    if not live.state.what_if.free_pupil:
        check_seidel(live.setup.lens)
    return View(live.setup.coefficients)


def per_surface(live: Live) -> View[PerSurface]:
    """Return the coefficients and the chromatic sums split over the surfaces (handbook 3.2)."""
    setup = live.setup
    slope, colours = setup.source.field_slope, setup.lens.wavelengths_nm
    sums = seidel_sums(setup.lens, setup.rays, slope)
    shortest, longest = min(colours), max(colours)
    chromatic = chromatic_sums(setup.lens, setup.rays, shortest / NM_PER_UM, longest / NM_PER_UM, slope)
    waves = UM_PER_MM / setup.source.wavelength_um
    split = {
        "w40": sums.spherical / 8,
        "w31": sums.coma / 2,
        "w22": sums.astigmatism / 2,
        "petzval": sums.petzval / 4,
        "w20": (sums.astigmatism + sums.petzval) / 4,
        "w11": sums.distortion / 2,
        "c1": chromatic.axial / 2,
        "c2": chromatic.lateral,
    }
    waved = {name: column * waves for name, column in split.items()}
    return View(PerSurface(waved, int(setup.stop.surface), (shortest, longest)))
