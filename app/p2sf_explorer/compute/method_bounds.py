"""What each method costs and promises at a state's point, and which keeps a time. No Qt in here."""

from dataclasses import dataclass, replace
from math import inf

from p2sf.errors import P2SFError, SamplingError
from p2sf.figures.tails import tail_error
from p2sf.psf.cost import nodes_beyond
from p2sf.psf.methods import METHODS, psf_of
from p2sf.psf.result import Psf
from p2sf_explorer.compute.deferred_sums import psf_request, slow
from p2sf_explorer.compute.method import ALONE, NO_REASON, Task
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.state.state import State, change

NAMES = tuple(method.name for method in METHODS if method.over_frequency)  # from fast to exact
EXACTEST, COARSEST = 1e-5, 0.3  # 1 − R² at the ends of the slider
REPEATS = 3


AIRY = 0.61  # radius of the first dark ring, λ/NA


@dataclass(frozen=True)
class PredictedCost:
    """One method at this point: its time, inf where a frame cannot wait for it, and its predicted 1 − R².

    ``tails``: the error of its faint light against that of the most exact method here (`p2sf.figures.tails`).
    """

    method: str
    milliseconds: float
    error: float
    tails: float = inf


def costs(state: State) -> tuple[PredictedCost, ...]:
    """Return what each method costs at a state's point, in the window that it shows, fast ones first."""
    found = [_cost(change(state, method=method)) for method in NAMES]
    exact = next((psf for _, psf in reversed(found) if psf is not None), None)
    return tuple(replace(cost, tails=_tails(state, psf, exact)) for cost, psf in found)


def _cost(state: State) -> tuple[PredictedCost, Psf | None]:
    method = state.optics.method
    try:
        setup = paraxial_setup(state)
        task = Task(state, setup, method, NO_REASON, ALONE, None)
        request = psf_request(state, setup, method, task.window("settled"))
        fitted = task.first_fit if task.exact else None
        if nodes_beyond(request, fitted) or slow(request, fitted):
            return PredictedCost(method, inf, inf), None
        psfs = [psf_of(request) for _ in range(REPEATS)]
    except P2SFError:  # this method has no picture here
        return PredictedCost(method, inf, inf), None
    error = psfs[-1].predicted_error
    return PredictedCost(method, 1e3 * min(psf.seconds for psf in psfs), inf if error is None else float(error)), psfs[
        -1
    ]


def _tails(state: State, psf: Psf | None, exact: Psf | None) -> float:
    """Return the error of a PSF's faint light, inf where it has none or its window is another."""
    if psf is None or exact is None:
        return inf
    na = paraxial_setup(state).cone.na
    try:
        return tail_error(psf, exact, AIRY * float(psf.wavelength_um) / na).mean
    except SamplingError:
        return inf


def within(found: tuple[PredictedCost, ...], milliseconds: float) -> PredictedCost:
    """Return the most exact method that keeps a time, or the fastest where none does."""
    kept = [cost for cost in found if cost.milliseconds <= milliseconds]
    return min(kept, key=lambda cost: cost.error) if kept else min(found, key=lambda cost: cost.milliseconds)
