"""Sums of waves over real rays: how they are made, which are too slow for a frame, and a cache of those. No Qt here."""

from collections.abc import Callable
from dataclasses import dataclass

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.psf.huygens import all_reach, huygens_psf
from p2sf.psf.plane_waves import counts_for
from p2sf.psf.result import Psf
from p2sf.psf.separable_sum import row_counts
from p2sf.psf.traced import in_rows, traced_psf
from p2sf.raytrace.fit import FittedPencil
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.state.state import State

# As many nodes as are summed in some 40 ms, and on a busy machine in a few times that.
MOST_NODES = {"fitted": 60_000, "traced": 30_000, "huygens": 12_000}
KEPT = 8


@dataclass(frozen=True)
class SumRequest:
    """Everything a PSF over real rays depends on; ``window`` is (pixels, µm per pixel)."""

    lens: Lens
    source: Source
    method: str
    window: tuple[int, float]
    tolerance: float
    clip: bool


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
        for oldest in list(self._found)[:-KEPT]:
            del self._found[oldest]


def sum_request(state: State, setup: ParaxialSetup, method: str, window: tuple[int, float]) -> SumRequest:
    """Return what a state asks of one method in a window."""
    return SumRequest(setup.lens, setup.source, method, window, state.optics.tolerance, state.optics.clip)


def by_rays(request: SumRequest, quality: str = "settled", cancelled: Callable[[], bool] | None = None) -> Psf:
    """Return the PSF of a method that traces rays. Huygens is summed once; the accuracy worker makes it converge.

    ``cancelled`` is polled between blocks of rays and ends the work with `Cancelled`. Raises P2SFError's kinds.
    """
    lens, source, window = request.lens, request.source, request.window
    if request.method == "huygens":
        return huygens_psf(lens, source, *window, None, cancelled=cancelled, clip=request.clip)
    if request.method == "traced":
        return traced_psf(lens, source, *window, quality, cancelled=cancelled, clip=request.clip)
    from p2sf.psf.methods import render

    return render(lens, source, request.method, *window, quality, request.tolerance, request.clip)


def slow(request: SumRequest, fitted: FittedPencil | None) -> bool:
    """Return whether a settled sum would block the window. ``fitted``: a coarse fit; None where rays are lost.

    The cost of rims and lost rays is not known beforehand: following an outline takes a thousand pencils.
    """
    most = MOST_NODES[request.method]
    if request.method == "fitted":
        return fitted is not None and row_nodes(fitted, request.window) > most
    if request.clip or fitted is None:
        return True
    if request.method == "huygens":
        radii, directions = counts_for(fitted.steepness, *request.window)
        return radii * directions / 2 > most or not all_reach(request.lens, request.source)
    return row_nodes(fitted, request.window) > most or not in_rows(request.lens, request.source)


def row_nodes(fitted: FittedPencil, window: tuple[int, float], quality: str = "settled") -> float:
    """Return how many nodes in rows sample the phase of a fit over a window, the mirror half not counted."""
    rows, columns = row_counts(fitted, *window, quality)
    return rows * columns / 2
