"""The PSF at several sensor positions: which of them, how wide a window, and the pictures."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from p2sf.errors import P2SFError
from p2sf.figures.perfect import airy_radius_um
from p2sf.paraxial.balance import depth_of_focus_um
from p2sf.psf.geometric import over_unaberrated
from p2sf.pupil.seen_mask import mask_seen
from p2sf.raytrace.field_curves import real_foci, seidel_foci
from p2sf_explorer.compute.autofocus import best_shift_um
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.method import WINDOWS
from p2sf_explorer.compute.sampled import in_window, optics
from p2sf_explorer.compute.setup import ParaxialSetup, everywhere_by_coefficients, paraxial_setup
from p2sf_explorer.state.scales import nice
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.what_if import check_focusable

COUNT = {"preview": 7, "settled": 11}
PIXELS = {"preview": 24, "settled": 64}
AIR = 3.0  # depths of focus beyond the outermost focus
ROOM = 4.0  # Airy radii around the blur


@dataclass(frozen=True)
class Strip:
    """Everything the strip depends on: ``state`` with the sensor unshifted, shifts in µm, and each picture's window.

    ``less`` is subtracted from it, picture by picture.
    """

    state: State
    shifts_um: tuple[float, ...]
    window: tuple[int, float]
    six: bool
    less: "Strip | None" = None


@dataclass(frozen=True)
class Focused:
    """The strip: light per sample over the unaberrated peak, (count, pixels, pixels); foci as sensor shifts, µm.

    ``light`` is NaN where there is no PSF. ``best``: of smallest RMS wavefront, NaN where there is none.
    """

    light: np.ndarray
    sagittal: float
    tangential: float
    best: float


def strip(live: Live) -> View[None]:
    """Return what to show for the present lens and source. The strip does not depend on the sensor shift.

    Raises GeometryError where moving the sensor does not focus, and every picture would be the same.
    """
    check_focusable(live.state)
    state = change(optics(live.state), sensor_shift_um=0.0)
    setup = paraxial_setup(state)
    low, high, half = shift_range(setup)
    shifts = tuple(np.linspace(low, high, COUNT[live.quality]).tolist())
    pixels = PIXELS[live.quality]
    window = pixels, nice(2 * half, WINDOWS) / pixels
    return View(None, Strip(state, shifts, window, everywhere_by_coefficients(state, live.setup)))


def shift_range(setup: ParaxialSetup) -> tuple[float, float, float]:
    """Return the shifts to show, µm, around sensor and foci, and half the width of a window that holds the blur, µm."""
    c, na = setup.coefficients, setup.cone.na
    index = float(c.image_index)  # negative behind an odd number of mirrors
    unit = depth_of_focus_um(index, setup.source.wavelength_um, na)
    six = not setup.lens.tilted
    foci = seidel_foci(c) if six else real_foci(setup.lens, setup.source, setup.source.field_slope, setup.stop)
    sagittal, tangential = (1e3 * float(place) for place in foci)
    balanced = (sagittal + tangential) / 2 - (2 * unit * float(c.w40) if six else 0.0)
    low, high = (side(0.0, sagittal, tangential, balanced) for side in (min, max))
    air = AIR * abs(unit)
    step = nice((high - low + 2 * air) / 8)
    low, high = step * np.floor((low - air) / step), step * np.ceil((high + air) / step)
    blur = 0.35 * (high - low) * na / abs(index)
    return float(low), float(high), blur + ROOM * float(airy_radius_um(setup.source.wavelength_um, na))


def answer(request: Strip, stopped: Callable[[], bool], tell: Callable[[float, object], None]) -> Focused:
    """Return the strip; ``tell(share done, strip so far)`` is called after every picture."""
    found = Focused(np.full((len(request.shifts_um), request.window[0], request.window[0]), np.nan), *foci(request))
    for number in outwards(len(request.shifts_um)):
        if stopped():
            break
        shift = request.shifts_um[number]
        found.light[number] = light(shift, request) - (light(shift, request.less) if request.less else 0.0)
        tell((number + 1) / len(request.shifts_um), found)
    return found


def light(shift_um: float, request: Strip) -> np.ndarray:
    """Return the light per sample of one position, in units of the unaberrated peak; NaN where there is no PSF."""
    try:
        state = change(request.state, sensor_shift_um=shift_um)
        psf = in_window(state, request.window, request.six)
        setup, units = paraxial_setup(state), psf.over_unaberrated
        if units is not None:
            return units
        return over_unaberrated(psf, setup.cone.na, mask_seen(setup.lens, setup.source))
    except P2SFError:  # a sensor inside the lens, a lost chief ray: a gap in the strip
        return np.full((request.window[0],) * 2, np.nan)


def outwards(count: int) -> list[int]:
    """Return the numbers from the middle outwards, so that what matters most comes first."""
    return sorted(range(count), key=lambda number: abs(number - count // 2))


def foci(request: Strip) -> tuple[float, float, float]:
    """Return sagittal, tangential and best focus as sensor shifts, µm: of the six coefficients or of exact rays."""
    setup = paraxial_setup(request.state)
    if request.six:
        near = seidel_foci(setup.coefficients)
    else:
        near = real_foci(setup.lens, setup.source, setup.source.field_slope, setup.stop)
    try:
        best = best_shift_um(change(request.state, method="seidel" if request.six else "fitted"))
    except P2SFError:
        best = np.nan
    return 1e3 * float(near.sagittal), 1e3 * float(near.tangential), best
