"""The picture of the PSF panel on as many samples as the panel has pixels. No Qt in here."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from p2sf.errors import SamplingError
from p2sf.psf.methods import PsfRequest, psf_of
from p2sf.psf.result import Psf
from p2sf_explorer.compute.live import Live

STEP = 128  # between the numbers of samples that a panel may ask for, so that resizing it asks rarely


@dataclass(frozen=True)
class SettledSum:
    """The sum of waves that made a settled picture, and the most samples a side it is made with in some seconds."""

    request: PsfRequest
    most: int


def source(live: Live) -> SettledSum | None:
    """Return what the picture on screen is a sum of; None for ray density, what moves, and what stands in.

    Raises SamplingError where the method that a person chose has no picture here.
    """
    if live.refused:
        raise SamplingError("{why}", why=live.refused)
    if live.request is None or live.quality != "settled":
        return None
    return SettledSum(live.request, live.finest)


def finer(found: SettledSum, pixels: float) -> PsfRequest | None:
    """Return the same sum with a sample for each pixel of a panel; None where the picture has as many already."""
    have, pitch = found.request.window
    samples = min(STEP * -(-int(pixels) // STEP), found.most)
    return replace(found.request, window=(samples, pitch * have / samples)) if samples > have else None


def answer(request: PsfRequest, stopped: Callable[[], bool], tell: Callable[[float, object], None]) -> Psf:
    """Return the PSF of a request in float32, since it is only looked at."""
    psf = psf_of(request, stopped)
    return replace(psf, values=psf.values.astype(np.float32))
