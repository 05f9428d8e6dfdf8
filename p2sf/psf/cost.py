"""The cost of a PSF that is asked for: its nodes, and by `pupil.cost` its seconds."""

from math import inf, prod

from p2sf.disc.mask import PupilMask
from p2sf.paraxial.seidel import Coefficients
from p2sf.psf.methods import PsfRequest, method_of
from p2sf.psf.seidel_stack import as_fit
from p2sf.pupil.fit import FittedPencil
from p2sf.pupil.plane_waves import counts_for, window_reach_um
from p2sf.pupil.seen_mask import mask_seen
from p2sf.pupil.smooth_pupil import all_reach


def fit_node_count(fitted: FittedPencil, window: tuple[int, float]) -> float:
    """Return the number of nodes that resolve the phase of a fit over a window, without the mirror half."""
    return prod(counts_for(fitted.steepness, window_reach_um(*window))) / (1 + fitted.mask.even)


def coefficient_node_count(six: Coefficients, window: tuple[int, float], mask: PupilMask) -> float:
    """Return the number of nodes that resolve the phase of six coefficients behind a mask over a window."""
    return fit_node_count(as_fit(six, mask), window)


def node_count(request: PsfRequest, fitted: FittedPencil | None) -> float:
    """Return the number of nodes of a settled sum, without the mirror half; 0 if it is not known in advance.

    ``fitted``: a coarse fit to exact rays; None where rays are lost.
    """
    own = method_of(request.method).nodes
    if own is not None:
        return own(request)
    if request.six is not None:
        return coefficient_node_count(request.six, request.window, mask_seen(request.lens, request.source))
    return 0.0 if fitted is None else fit_node_count(fitted, request.window)


def nodes_beyond(request: PsfRequest, fitted: FittedPencil | None) -> float:
    """Return the number of pupil samples of a sum that needs too many; 0 for a feasible sum."""
    nodes = node_count(request, fitted)
    most = method_of(request.method).most_nodes(mask_seen(request.lens, request.source))
    return nodes if nodes > most else 0.0


def predicted_seconds(request: PsfRequest, fitted: FittedPencil | None) -> float:
    """Return the estimated seconds of a settled sum; infinite if rims or lost rays make it unpredictable.

    Following an outline takes a thousand pencils. ``fitted`` as for `node_count`.
    """
    method, nodes = method_of(request.method), node_count(request, fitted)
    rays_tell = nodes and not request.options.clip and all_reach(request.lens, request.source)
    if not (method.nodes or method.whole or rays_tell):
        return inf
    return method.seconds(nodes, request.window[0])
