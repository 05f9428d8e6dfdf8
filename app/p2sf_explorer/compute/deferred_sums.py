"""Sums of waves over real rays: the work, which of it is too slow for a frame, what is done. No Qt in here."""

from collections.abc import Callable
from dataclasses import dataclass

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.psf.huygens import Filling, all_reach, huygens_psf
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
    """The latest PSFs that were too slow for a frame, by what was asked; ``version`` rises with each.

    Of a sum that failed the sentence that says why is kept, so that nobody waits for it.
    """

    def __init__(self):
        self._found: dict[SumRequest, Psf | str] = {}
        self.version = 0

    def get(self, sum_request: SumRequest) -> Psf | str | None:
        """Return the PSF, or why there is none; None where it is not there."""
        return self._found.get(sum_request)

    def keep(self, sum_request: SumRequest, found: Psf | str) -> None:
        """Keep a PSF or why there is none, and forget the oldest of too many."""
        self._found[sum_request] = found
        self.version += 1
        for oldest in list(self._found)[:-KEPT]:
            del self._found[oldest]


def sum_request(state: State, setup: ParaxialSetup, method: str, window: tuple[int, float]) -> SumRequest:
    """Return what a state asks of one method in a window."""
    return SumRequest(setup.lens, setup.source, method, window, state.tolerance, state.clip)


def by_rays(wanted: SumRequest, quality: str = "settled", cancelled: Callable[[], bool] | None = None) -> Psf:
    """Return the PSF of a method that traces rays; huygens in one pass, its converged sum is the accuracy worker's.

    ``cancelled`` is asked between blocks of rays and ends the work with `Cancelled`. Raises P2SFError's kinds.
    """
    lens, source, window, filling = wanted.lens, wanted.source, wanted.window, Filling(clip=wanted.clip)
    if wanted.method == "huygens":
        return huygens_psf(lens, source, *window, None, cancelled=cancelled, filling=filling)
    if wanted.method == "traced":
        return traced_psf(lens, source, *window, quality, filling, cancelled)
    from p2sf.psf.methods import render

    return render(lens, source, wanted.method, *window, quality, wanted.tolerance, wanted.clip)


def slow(wanted: SumRequest, found: FittedPencil | None) -> bool:
    """Return whether a settled sum would hold the window up, by a coarse fit to its rays; None where rays are lost.

    Nobody knows beforehand what rims and lost rays cost: following an outline takes a thousand pencils.
    """
    most = MOST_NODES[wanted.method]
    if wanted.method == "fitted":
        return found is not None and row_nodes(found, wanted.window) > most
    if wanted.clip or found is None:
        return True
    if wanted.method == "huygens":
        radii, directions = counts_for(found.steepness, *wanted.window)
        return radii * directions / 2 > most or not all_reach(wanted.lens, wanted.source)
    return row_nodes(found, wanted.window) > most or not in_rows(wanted.lens, wanted.source)


def row_nodes(found: FittedPencil, window: tuple[int, float], quality: str = "settled") -> float:
    """Return how many nodes in rows carry the phase of a fit over a window, mirror half not counted."""
    rows, columns = row_counts(found, *window, quality)
    return rows * columns / 2
