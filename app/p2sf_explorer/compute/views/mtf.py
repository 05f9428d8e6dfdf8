"""Contrast against spatial frequency, from the pupil of the picture."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from p2sf.messages import Message
from p2sf.psf.measures import mtf_of
from p2sf.threads import never
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.measured import MeasureRequest, measure_request, measured_parts, mtf_is_live

INTERVALS = 512


@dataclass(frozen=True)
class Contrast:
    """Cycles per mm on the sensor; contrast of patterns along y and along x, and of the same pupil without aberration.

    ``clear``: that of the pupil without aberration and without what stands in it; ``masked``: whether something does.
    ``method``: what described the pupil, and what error that is predicted to leave.
    """

    frequency_per_mm: np.ndarray
    tangential: np.ndarray
    sagittal: np.ndarray
    perfect: np.ndarray
    clear: np.ndarray
    masked: bool
    method: Message


def contrast(live: Live) -> View[Contrast | None]:
    """Return the MTF up to the cut-off, or the request for it where it is too slow for a frame."""
    request = measure_request(live)
    return View(contrast_of(request)) if mtf_is_live(live, request) else View(None, request)


def contrast_of(request: MeasureRequest, stopped: Callable[[], bool] = never) -> Contrast:
    """Return the MTF of a request. Raises P2SFError where its pupil has none, Cancelled when stopped."""
    parts = measured_parts(request)
    cut_off = 1000 * max(parts[0].pupil.cut_off_per_um)
    found = mtf_of(parts, "", np.linspace(0, cut_off, INTERVALS + 1), stopped)
    perfect = np.maximum(found.perfect_tangential, found.perfect_sagittal)
    clear = np.maximum(found.clear_tangential, found.clear_sagittal)
    masked = not request.lens.mask.clear
    said = Message("{method}; {note}", method=request.method, note=found.note) if found.note else request.method
    return Contrast(found.frequency_per_mm, found.tangential, found.sagittal, perfect, clear, masked, said)


def answer(request: MeasureRequest, stopped: Callable[[], bool], tell: Callable[[float, object], None]) -> Contrast:
    """Return the MTF of a request, for a worker; Cancelled when stopped."""
    return contrast_of(request, stopped)
