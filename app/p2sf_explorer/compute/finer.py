"""The picture on the PSF panel: smooth, and summed again where samples are too coarse or end. No Qt in here."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from p2sf.errors import SamplingError
from p2sf.figures.enlarge import LARGEST, enlarge
from p2sf.psf.methods import PsfRequest, psf_of
from p2sf.psf.result import Psf
from p2sf.psf.seidel import AIRY_RADIUS
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.state.scales import nice

STEP = 64  # between the numbers of samples that a panel may ask for, so that resizing it asks rarely
WIDTHS = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8)  # times a power of ten: of windows, µm, for the same reason
TIMES = 4  # finer is a picture that moves enlarged: as fine as painting asks for
CRITICAL = 1 / (4 * AIRY_RADIUS)  # Airy radii between samples, λ/(4 NA): intensity has no period below λ/(2 NA)
ROUNDING = 1.02  # of the critical pitch: the cone of a field is narrower than the paraxial one
FADED = 0.08  # of a picture's side that fades out where the computed square would end within the view


@dataclass(frozen=True)
class SettledSum:
    """The sum of waves that made a settled picture, and the most samples a side it is made with in some seconds."""

    request: PsfRequest
    most: int


@dataclass(frozen=True)
class ShownArea:
    """What a panel shows: how far from the chief ray it reaches along x or y, and the width of its pixels, µm."""

    reach_um: float
    pixel_um: float


def source(live: Live) -> View[SettledSum | None]:
    """Return what the picture on screen is a sum of; None for ray density, what moves, and what stands in.

    Raises SamplingError where the method that a person chose has no picture here.
    """
    if live.refused:
        raise SamplingError("{why}", why=live.refused)
    if live.request is None or live.quality != "settled":
        return View(None)
    return View(SettledSum(live.request, live.finest))


def finer(found: SettledSum, view: ShownArea, airy_um: float) -> PsfRequest | None:
    """Return the same sum over all that is in view; None where the picture is there and as fine as the eye needs.

    Samples `CRITICAL` apart, or a pixel of the panel if that is wider, are fine enough: what is between them follows.
    """
    have, pitch = found.request.window
    needed = max(ROUNDING * CRITICAL * airy_um, view.pixel_um)
    if pitch <= needed and covers(have * pitch, view):
        return None
    width = nice(2 * view.reach_um, WIDTHS)
    samples = min(STEP * -(-int(width / needed) // STEP), found.most)
    if samples < have and width >= have * pitch:
        samples = min(have, found.most)
    return replace(found.request, window=(samples, width / samples))


def covers(width_um: float, view: ShownArea) -> bool:
    """Return whether a square about the chief ray reaches as far as the view."""
    return width_um / 2 >= view.reach_um


def answer(request: PsfRequest, stopped: Callable[[], bool], tell: Callable[[float, object], None]) -> Psf:
    """Return the PSF of a request in float32, since it is only looked at."""
    psf = psf_of(request, stopped)
    return replace(psf, values=psf.values.astype(np.float32))


def smooth(values: np.ndarray, times: int = TIMES, coarse: bool = False) -> np.ndarray:
    """Return samples on a finer grid, as they are painted: the light between them; ``coarse`` as for `enlarge`."""
    return enlarge(values, min(times * values.shape[-1], LARGEST), coarse)


def is_coarse(pitch_um: float, airy_um: float) -> bool:
    """Return whether samples are farther apart than λ/(4 NA), of an Airy radius."""
    return pitch_um > ROUNDING * CRITICAL * airy_um


def fade(values: np.ndarray) -> np.ndarray:
    """Return a picture that fades out at its edges, for a view that reaches beyond the computed square."""
    count = len(values)
    inward = np.minimum(np.arange(count), np.arange(count)[::-1]) / (FADED * count)
    line = np.sin(np.pi / 2 * np.minimum(inward, 1.0)).astype(np.float32) ** 2
    faded: np.ndarray = values * line * line[:, None]
    return faded
