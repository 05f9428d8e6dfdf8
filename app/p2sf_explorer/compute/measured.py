"""The pupil whose transfer function and energy the panels show, and which of these are too slow for a frame. No Qt."""

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from p2sf.figures.energy import blur_waves
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients
from p2sf.pupil.frequency_pupil import pupil_of_coefficients, pupil_of_rays
from p2sf.pupil.seen_mask import mask_seen
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.sampled import by_coefficients

if TYPE_CHECKING:
    from p2sf.psf.measures import PupilPart

LIVE_SAMPLES = 2**18  # of both slices of a transfer function: some 5 ms, and a blur of 64 waves per pupil radius
LIVE_WAVES = 40.0  # per pupil radius, of a blur whose energy is live: some 15 ms
BY_RAYS, BY_COEFFICIENTS = Message("exact rays"), Message("six coefficients")


@dataclass(frozen=True)
class MeasureRequest:
    """Everything a measure depends on. ``six``: the coefficients' values where they make the picture, else empty.

    ``beside_rays``: the picture is the density of rays, and no sum of waves. ``by_hand``: waves were added to the six,
    and exact rays do not judge them.
    """

    lens: Lens
    source: Source
    clip: bool
    six: tuple[float, ...] = ()
    beside_rays: bool = False
    by_hand: bool = False

    @property
    def method(self) -> Message:
        """Return what described the pupil."""
        method = BY_COEFFICIENTS if self.six else BY_RAYS
        if not self.beside_rays:
            return method
        return Message("{method}, by waves of the pupil; the picture is the density of its rays", method=method)


def measure_request(live: Live) -> MeasureRequest:
    """Return what is to be measured: the six coefficients where they make the picture, else exact rays."""
    by_six = by_coefficients(live)
    six = tuple(float(value) for value in vars(live.setup.coefficients).values()) if by_six else ()
    beside_rays = live.psf.method == "geometric" and live.quality == "settled" and live.pending is None
    return MeasureRequest(
        live.setup.lens, live.setup.source, live.state.optics.clip and not by_six, six, beside_rays, live.setup.altered
    )


@lru_cache(maxsize=4)
def measured_parts(request: MeasureRequest) -> "tuple[PupilPart, ...]":
    """Return the pupil of a request; P2SFError where there is none."""
    from p2sf.psf.measures import PupilPart
    from p2sf.psf.over_frequency import pupil_of_six

    if request.six:
        six = Coefficients(*map(np.asarray, request.six))
        if request.by_hand:
            return (PupilPart(pupil_of_coefficients(six, mask_seen(request.lens, request.source))),)
        return (PupilPart(pupil_of_six(request.lens, request.source, six)),)
    return (PupilPart(pupil_of_rays(request.lens, request.source, request.clip)),)


def mtf_is_live(live: Live, request: MeasureRequest) -> bool:
    """Return whether the transfer function is computed within a frame; behind a mask it takes some 15 ms."""
    from p2sf.figures.transfer import otf_samples

    if takes_long(live) or not request.lens.mask.clear:
        return False
    return otf_samples(measured_parts(request)[0].pupil) <= LIVE_SAMPLES


def energy_is_live(live: Live, request: MeasureRequest) -> bool:
    """Return whether the encircled energy is computed within a frame."""
    if takes_long(live):
        return False
    pupil = measured_parts(request)[0].pupil
    return pupil.plain and blur_waves(pupil, pupil.centroid_um) <= LIVE_WAVES


def takes_long(live: Live) -> bool:
    """Return whether a sum of the picture's waves takes longer than a frame, or shows no more than their rays.

    To find the pupil that a measure needs takes longer still: seconds, of a fast lens at full field.
    """
    return live.slow or live.psf.method == "geometric"
