"""Focus along the spectrum: where each colour and each zone of the pupil crosses the axis."""

from dataclasses import dataclass

import numpy as np

from p2sf.conventions import NM_PER_UM
from p2sf.paraxial.balance import depth_of_focus_um
from p2sf.raytrace.field_curves import colour_shift
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.ranges import wavelength_range
from p2sf_explorer.compute.setup import prescription

WAVELENGTHS = {"preview": 21, "settled": 41}
ZONES = (0.0, 0.7, 1.0)  # of the pupil's radius


@dataclass(frozen=True)
class Chromatic:
    """Wavelengths in nm and, per zone of `ZONES`, the crossing of the axis, µm behind the sensor, (zones, n).

    ``depth_of_focus_um``: ±λ/(2·NA²)·n′ at the present wavelength, within which diffraction hides a shift.
    """

    wavelength_nm: np.ndarray
    shift_um: np.ndarray
    depth_of_focus_um: float


def chromatic(live: Live) -> View[Chromatic]:
    """Return the focal shift of every colour at this depth."""
    setup = live.setup
    nm = np.linspace(*wavelength_range(prescription(live.state)), WAVELENGTHS[live.quality])
    shift = 1e3 * colour_shift(setup.lens, setup.source.depth_mm, nm / NM_PER_UM, ZONES, setup.stop)
    index, na = float(setup.own.image_index), setup.cone.na
    half = abs(depth_of_focus_um(index, setup.source.wavelength_um, na)) / 2 if na else np.inf
    return View(Chromatic(nm, shift, half))
