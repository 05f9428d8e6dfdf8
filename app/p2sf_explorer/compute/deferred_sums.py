"""Sums of waves: which are too slow for a frame or take too many samples, and a cache. No Qt here."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.choosing import AUTO_SECONDS, Choice
from p2sf.psf.cost import node_count, predicted_seconds
from p2sf.psf.methods import PsfOptions, PsfRequest, by_six, method_of, psf_of
from p2sf.psf.result import Psf
from p2sf.psf.spherical import plane_wave_error
from p2sf.pupil.fit import FittedPencil
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.state.state import State

AT_ONCE_SECONDS = 0.04  # on a busy machine a few times that
SOME_SECONDS = 3.0
FEW_SAMPLES = 128
SHOWN = ("strehl", "energy")  # of the figures of a PSF, whose search the worker spares the window
KEPT = 8
KEPT_BYTES = 2**25  # of all samples that are kept, 32 MB: four of the largest pictures in float64


@dataclass(frozen=True)
class ComparisonRequest:
    """The comparison of plane and spherical waves on which the choice of a method waits."""

    lens: Lens
    source: Source
    clip: bool


Request = PsfRequest | ComparisonRequest
Found = Psf | Message | float
"""A PSF, why there is none, or what plane waves miss."""


class SumCache:
    """The latest sums that were too slow for a frame, by request; ``version`` rises with each.

    Of a sum that failed the reason is kept, so that nobody waits for it.
    """

    def __init__(self) -> None:
        self._found: dict[Request, Found] = {}
        self.version = 0

    def get(self, request: Request) -> Found | None:
        """Return what was found, or why nothing was; None where neither is known."""
        return self._found.get(request)

    def keep(self, request: Request, found: Found) -> None:
        """Keep what was found or why nothing was, and forget the oldest of too many."""
        self._found[request] = found
        self.version += 1
        for oldest in list(self._found)[:-1]:
            if len(self._found) <= KEPT and self._bytes() <= KEPT_BYTES:
                return
            del self._found[oldest]

    def _bytes(self) -> int:
        return sum(found.values.nbytes for found in self._found.values() if isinstance(found, Psf))


def answer_to(request: Request, cancelled: Callable[[], bool] | None = None) -> Psf | float:
    """Return what a request asks for, for a worker. Raises P2SFError where there is no PSF."""
    if isinstance(request, PsfRequest):
        psf = psf_of(request, cancelled)
        for name in SHOWN:
            psf.figures.value(name)
        return psf
    try:
        return plane_wave_error(request.lens, request.source, request.clip)
    except P2SFError:  # a choice does without
        return inf


def psf_request(
    state: State,
    setup: ParaxialSetup,
    method: str,
    window: tuple[int, float],
    quality: str = "settled",
    choice: Choice | None = None,
) -> PsfRequest:
    """Return what a state asks of one method in a window: of six coefficients without rims, which they do not know.

    Huygens is summed once; the accuracy worker makes it converge. ``choice``: why ``auto`` takes the method.
    """
    six = setup.coefficients if by_six(method) else None
    return PsfRequest(
        setup.lens,
        setup.source,
        method,
        window,
        PsfOptions(quality, state.optics.tolerance, state.optics.clip and six is None),
        converged=False,
        most_seconds=AUTO_SECONDS if choice else inf,
        choice=choice,
        six=six,
        by_hand=setup.altered,
    )


def most_samples(request: PsfRequest, fitted: FittedPencil | None) -> int:
    """Return the most samples a side that are summed within some seconds, at least those of a small picture."""
    nodes, samples = node_count(request, fitted), request.window[0]
    if not nodes:
        return FEW_SAMPLES
    while samples > FEW_SAMPLES and method_of(request.method).seconds(nodes, samples) > SOME_SECONDS:
        samples //= 2
    return samples


def slow(request: PsfRequest, fitted: FittedPencil | None) -> bool:
    """Return whether a settled sum would block the window. ``fitted``: a coarse fit; None where rays are lost."""
    return predicted_seconds(request, fitted) > AT_ONCE_SECONDS
