"""Sums of waves: how they are made, which are too slow for a frame or too large for any, and a cache. No Qt here."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.messages import Message
from p2sf.paraxial.seidel import Coefficients
from p2sf.paraxial.wavefront import steepest_chords, steepest_polar
from p2sf.psf.disc_rows import takes_rows
from p2sf.psf.fitted import MOST_NODES as MOST_FITTED
from p2sf.psf.huygens import MOST_NODES as MOST_RAYS
from p2sf.psf.huygens import all_reach, huygens_psf
from p2sf.psf.plane_waves import counts_for
from p2sf.psf.result import Psf
from p2sf.psf.seidel import seidel_psf
from p2sf.psf.seidel_stack import LARGEST_NODES, corner_reach
from p2sf.psf.separable_sum import MOST_NODES as MOST_IN_ROWS
from p2sf.psf.separable_sum import row_counts
from p2sf.psf.traced import in_rows, traced_psf
from p2sf.pupil.mask import EDGE_HARMONICS, PupilMask, mask_slopes
from p2sf.pupil.mask_nodes import vane_nodes
from p2sf.pupil.quadrature import chords_for, nodes_for
from p2sf.raytrace.fit import FittedPencil
from p2sf.raytrace.seen_mask import mask_seen
from p2sf_explorer.compute.setup import ParaxialSetup
from p2sf_explorer.state.state import State

# As many nodes as are summed in some 40 ms, and on a busy machine in a few times that, over so many samples a side.
MOST_NODES = {"seidel": 100_000, "fitted": 60_000, "traced": 30_000, "huygens": 12_000}
FEW_SAMPLES = 128
MOST_IN_PRODUCTS = 2**31  # nodes × samples a side of a sum in rows: some seconds
MOST_ONE_BY_ONE = 2**32  # nodes × samples of a sum ray by ray: some ten seconds
ONE_BY_ONE = 0.012  # of a product in rows: what a product of a sum node by node takes, which is of large matrices
BOTH_SIDES = 3  # what a pupil costs whose halves differ, in pupils that are even
FEW_NODES = 16, 48  # radii and directions over the disc at which the nodes over vanes are counted
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
        return huygens_psf(lens, source, *window, None, cancelled=cancelled, clip=request.clip)
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


@dataclass(frozen=True)
class Size:
    """How many ``nodes`` a sum has, the mirror half not counted; 0 where that is not known beforehand.

    ``in_rows``: it separates into products; ``most``: the largest number of nodes that is summed at all; ``edges``:
    nodes over what vanes cover, which a sum in rows takes away one by one.
    """

    nodes: float
    in_rows: bool
    most: float
    edges: float = 0.0

    def products(self, samples: int) -> float:
        """Return the cost of a picture of so many samples a side."""
        return self.nodes * (samples if self.in_rows else samples**2) + self.edges * samples**2 * ONE_BY_ONE


def size(request: SumRequest, fitted: FittedPencil | None) -> Size:
    """Return the size of a settled sum. ``fitted``: a coarse fit to exact rays; None where rays are lost."""
    mask = mask_seen(request.lens, request.source)
    if request.six is not None:
        return coefficient_size(request.six, request.window, mask)
    if fitted is None:
        return Size(0.0, request.method == "fitted", MOST_RAYS)
    one_by_one = request.clip or (request.method == "traced" and not in_rows(request.lens, request.source))
    if request.method == "huygens" or (request.method == "traced" and one_by_one):
        radii, directions = counts_for(fitted.steepness, *request.window)
        return Size(radii * directions / 2, False, MOST_RAYS)
    counts = counts_for(fitted.steepness, *request.window)
    if not takes_rows(mask) or (request.lens.misaligned and not mask.clear):
        return Size(counts[0] * counts[1] / (1 + mask.even), False, MOST_FITTED)
    nodes = row_nodes(fitted, request.window) * (1 + mask.obscuration) * (1 if mask.even else BOTH_SIDES)
    return Size(nodes, True, MOST_IN_ROWS / 2, covered_nodes(mask, counts))


def coefficient_size(six: Coefficients, window: tuple[int, float], mask: PupilMask) -> Size:
    """Return the size of a settled sum of six coefficients behind a mask: larger where its quarters differ."""
    if mask.clear:
        return Size(coefficient_nodes(six, window), True, LARGEST_NODES)
    counts = coefficient_counts(six, window, mask)
    if not takes_rows(mask):
        return Size(counts[0] * counts[1] / (1 + mask.even), False, MOST_FITTED)
    if not mask.in_quarters:
        return Size(counts[0] * counts[1] / BOTH_SIDES, True, MOST_IN_ROWS / 2, covered_nodes(mask, counts))
    return Size(
        coefficient_nodes(six, window) * (1 + mask.obscuration), True, LARGEST_NODES, covered_nodes(mask, counts)
    )


def coefficient_counts(six: Coefficients, window: tuple[int, float], mask: PupilMask) -> tuple[int, int]:
    """Return the radii and directions that carry the phase of six coefficients behind a mask over a window."""
    slopes, wavelength = mask_slopes(mask), float(six.wavelength_um)
    slope, twist = (float(steep) + EDGE_HARMONICS * slopes.amplitude for steep in steepest_polar(six))
    reach = corner_reach(float(six.na) / wavelength, *window)
    return nodes_for(slope + slopes.path_radial_um / wavelength, reach, twist + slopes.path_angular_um / wavelength)


def covered_nodes(mask: PupilMask, counts: tuple[int, int]) -> float:
    """Return about how many nodes cover the vanes of a mask, as dense as ``counts`` are over the disc."""
    few = vane_nodes(mask, *FEW_NODES)
    return 0.0 if few is None else few.xi.size * max(1.0, counts[0] * counts[1] / (FEW_NODES[0] * FEW_NODES[1]))


def impossible(request: SumRequest, fitted: FittedPencil | None) -> float:
    """Return how many pupil samples a sum would need that has too many; 0 for one that can be made."""
    found = size(request, fitted)
    return found.nodes if found.nodes > found.most else 0.0


def most_samples(request: SumRequest, fitted: FittedPencil | None) -> int:
    """Return the most samples a side that are summed within some seconds, at least those of a small picture."""
    found, samples = size(request, fitted), request.window[0]
    if not found.nodes:
        return FEW_SAMPLES
    most = MOST_IN_PRODUCTS if found.in_rows else MOST_ONE_BY_ONE
    while samples > FEW_SAMPLES and found.products(samples) > most:
        samples //= 2
    return samples


def slow(request: SumRequest, fitted: FittedPencil | None) -> bool:
    """Return whether a settled sum would block the window. ``fitted``: a coarse fit; None where rays are lost.

    The cost of rims and lost rays is not known beforehand: following an outline takes a thousand pencils.
    """
    found = size(request, fitted)
    if not found.nodes or (request.clip and request.method != "fitted"):
        return request.method != "fitted"
    if found.products(max(FEW_SAMPLES, request.window[0])) > MOST_NODES[request.method] * (
        FEW_SAMPLES if found.in_rows else FEW_SAMPLES**2
    ):
        return True
    if request.method == "huygens":
        return not all_reach(request.lens, request.source)
    return request.method == "traced" and not found.in_rows


def coefficient_nodes(six: Coefficients, window: tuple[int, float]) -> float:
    """Return how many nodes of a quarter pupil carry the phase of six coefficients over a window."""
    reach = corner_reach(float(six.na) / float(six.wavelength_um), *window)
    rows, columns = chords_for(*steepest_chords(six), reach, reach / 2**0.5)
    return rows * columns / 4


def moving_nodes(fitted: FittedPencil, window: tuple[int, float]) -> float:
    """Return the cost of a preview behind the fit's mask, in nodes of rows."""
    if fitted.mask.clear:
        return row_nodes(fitted, window, "preview")
    counts, worth = counts_for(fitted.steepness, *window), window[0] * ONE_BY_ONE
    if not takes_rows(fitted.mask):
        return worth * counts[0] * counts[1] / (1 + fitted.mask.even)
    sides = 1 if fitted.mask.even else BOTH_SIDES
    rows = row_nodes(fitted, window, "preview") * (1 + fitted.mask.obscuration) * sides
    return rows + worth * covered_nodes(fitted.mask, counts)


def row_nodes(fitted: FittedPencil, window: tuple[int, float], quality: str = "settled") -> float:
    """Return how many nodes in rows sample the phase of a fit over a window, the mirror half not counted."""
    rows, columns = row_counts(fitted, *window, quality)
    return rows * columns / 2
