"""Sums of waves: how they are made, which are too slow for a frame or too large for any, and a cache. No Qt here."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import prod

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients
from p2sf.psf.fitted import MOST_NODES as MOST_FITTED
from p2sf.psf.huygens import MOST_NODES as MOST_RAYS
from p2sf.psf.huygens import huygens_psf
from p2sf.psf.plane_waves import counts_for, window_reach_um
from p2sf.psf.result import Psf
from p2sf.psf.seidel import seidel_psf
from p2sf.psf.seidel_stack import LARGEST_NODES, as_fit
from p2sf.psf.smooth_pupil import all_reach
from p2sf.psf.traced import MOST_NODES as MOST_TRACED
from p2sf.psf.traced import traced_psf
from p2sf.pupil.mask import PupilMask
from p2sf.raytrace.fit import FittedPencil
from p2sf.raytrace.seen_mask import mask_seen
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.state.state import State

# Of one core, the peak included: tables of polynomials, rays through a dozen surfaces, a Fourier transform.
NODE_SECONDS = {"seidel": 4e-7, "fitted": 4e-7, "traced": 4e-7, "huygens": 4e-6}
SAMPLE_SECONDS = 1.5e-7
AT_ONCE_SECONDS = 0.04  # on a busy machine a few times that
SOME_SECONDS = 3.0
FEW_SAMPLES = 128
KEPT = 8
KEPT_BYTES = 2**25  # of all samples that are kept, 32 MB: four of the largest pictures in float64


@dataclass(frozen=True)
class SumRequest:
    """Everything a PSF that is a sum of waves depends on; ``window`` is (samples a side, µm between samples).

    ``six``: the coefficients that make it in place of rays; ``by_hand``: they are not the lens's own.
    """

    lens: Lens
    source: Source
    method: str
    window: tuple[int, float]
    tolerance: float
    clip: bool
    six: Coefficients | None = None
    by_hand: bool = False


class SumCache:
    """The latest PSFs that were too slow for a frame, by request; ``version`` rises with each.

    Of a sum that failed the reason is kept, so that nobody waits for it.
    """

    def __init__(self) -> None:
        self._found: dict[SumRequest, Psf | Message] = {}
        self.version = 0

    def get(self, sum_request: SumRequest) -> Psf | Message | None:
        """Return the PSF, or why there is none; None where neither is known."""
        return self._found.get(sum_request)

    def keep(self, sum_request: SumRequest, found: Psf | Message) -> None:
        """Keep a PSF or why there is none, and forget the oldest of too many."""
        self._found[sum_request] = found
        self.version += 1
        for oldest in list(self._found)[:-1]:
            if len(self._found) <= KEPT and self._bytes() <= KEPT_BYTES:
                return
            del self._found[oldest]

    def _bytes(self) -> int:
        return sum(found.values.nbytes for found in self._found.values() if isinstance(found, Psf))


def sum_request(state: State, setup: ParaxialSetup, method: str, window: tuple[int, float]) -> SumRequest:
    """Return what a state asks of one method in a window."""
    six = setup.coefficients if method == "seidel" else None
    known = setup.lens, setup.source, method, window, state.optics.tolerance, state.optics.clip
    return SumRequest(*known, six, setup.altered)


def by_rays(request: SumRequest, quality: str = "settled", cancelled: Callable[[], bool] | None = None) -> Psf:
    """Return the PSF of a request. Huygens is summed once; the accuracy worker makes it converge.

    ``cancelled`` is polled between blocks of rays and ends the work with `Cancelled`. Raises P2SFError's kinds.
    """
    lens, source, window = request.lens, request.source, request.window
    if request.six is not None:
        return by_coefficients(request, request.six, quality)
    if request.method == "huygens":
        return huygens_psf(lens, source, *window, None, cancelled=cancelled, clip=request.clip, quality=quality)
    if request.method == "traced":
        return traced_psf(lens, source, *window, quality, cancelled=cancelled, clip=request.clip)
    from p2sf.psf.methods import render

    return render(lens, source, request.method, *window, quality, request.tolerance, request.clip)


def by_coefficients(request: SumRequest, six: Coefficients, quality: str) -> Psf:
    """Return the PSF of six coefficients; what they are predicted to miss is known of the lens's own only."""
    psf = seidel_psf(six, *request.window, quality, mask=mask_seen(request.lens, request.source))
    if request.by_hand:
        return psf
    from p2sf.psf.methods import seidel_error

    return replace(psf, predicted_error=seidel_error(request.lens, request.source, six))


def node_count(request: SumRequest, fitted: FittedPencil | None) -> float:
    """Return how many nodes a settled sum has, the mirror half not counted; 0 where that is not known beforehand.

    ``fitted``: a coarse fit to exact rays; None where rays are lost.
    """
    if request.six is not None:
        return coefficient_nodes(request.six, request.window, mask_seen(request.lens, request.source))
    return 0.0 if fitted is None else fit_node_count(fitted, request.window)


def fit_node_count(fitted: FittedPencil, window: tuple[int, float]) -> float:
    """Return how many nodes carry the phase of a fit over a window, the mirror half not counted."""
    return prod(counts_for(fitted.steepness, window_reach_um(*window))) / (1 + fitted.mask.even)


def coefficient_nodes(six: Coefficients, window: tuple[int, float], mask: PupilMask) -> float:
    """Return how many nodes carry the phase of six coefficients behind a mask over a window."""
    return fit_node_count(as_fit(six, mask), window)


def seconds(method: str, nodes: float, samples: int) -> float:
    """Return about how long a sum takes: that of its nodes, and a Fourier transform of its samples."""
    return NODE_SECONDS[method] * nodes + SAMPLE_SECONDS * samples**2


def impossible(request: SumRequest, fitted: FittedPencil | None) -> float:
    """Return how many pupil samples a sum would need that has too many; 0 for one that can be made."""
    nodes = node_count(request, fitted)
    most = {"traced": MOST_TRACED, "huygens": MOST_RAYS}.get(request.method, MOST_FITTED / 2)
    if request.six is not None and mask_seen(request.lens, request.source).clear:
        most = 2 * LARGEST_NODES  # in rows, a quarter of the pupil
    return nodes if nodes > most else 0.0


def most_samples(request: SumRequest, fitted: FittedPencil | None) -> int:
    """Return the most samples a side that are summed within some seconds, at least those of a small picture."""
    nodes, samples = node_count(request, fitted), request.window[0]
    if not nodes:
        return FEW_SAMPLES
    while samples > FEW_SAMPLES and seconds(request.method, nodes, samples) > SOME_SECONDS:
        samples //= 2
    return samples


def slow(request: SumRequest, fitted: FittedPencil | None) -> bool:
    """Return whether a settled sum would block the window. ``fitted``: a coarse fit; None where rays are lost.

    The cost of rims and lost rays is not known beforehand: following an outline takes a thousand pencils.
    """
    nodes = node_count(request, fitted)
    if not nodes or (request.clip and request.method != "fitted"):
        return request.method != "fitted"
    if seconds(request.method, nodes, max(FEW_SAMPLES, request.window[0])) > AT_ONCE_SECONDS:
        return True
    return request.method in ("traced", "huygens") and not all_reach(request.lens, request.source)
