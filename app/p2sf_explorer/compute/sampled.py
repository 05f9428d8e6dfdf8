"""Small PSFs of the present setup with something changed, for panels that show many of them."""

from p2sf.psf.methods import FITTED, SEIDEL, TRACED, by_six, psf_of
from p2sf.psf.result import Psf
from p2sf_explorer.compute.deferred_sums import psf_request
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.method import ALONE, NO_REASON, Task, too_coarse
from p2sf_explorer.compute.preview import preview, preview_of_coefficients, preview_psf
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.state.state import State


def optics(state: State) -> State:
    """Return a state with the optics of this one and everything else at its default."""
    return State(optics=state.optics, what_if=state.what_if)


def by_coefficients(live: Live) -> bool:
    """Return whether the present point is shown by the six coefficients."""
    return by_six(live.method) or live.setup.altered


def in_window(state: State, window: tuple[int, float], six: bool) -> Psf:
    """Return the PSF of a setup over (pixels, µm per pixel): of ``six`` coefficients, else of a fit to exact rays.

    Where rays are lost they are summed one by one; where blur dwarfs diffraction their density is shown. Raises
    P2SFError's kinds where there is no PSF.
    """
    from p2sf.psf.geometric import geometric_psf

    setup = paraxial_setup(state)
    task = Task(state, setup, (SEIDEL if six or setup.altered else FITTED).name, NO_REASON, ALONE, None)
    if too_coarse(task, window):
        return geometric_psf(setup.lens, setup.source, window, "preview", state.optics.clip, task.six)
    if not task.exact:
        return preview_of_coefficients(setup, window)
    traced = preview(setup, True) if state.optics.clip else task.traced
    if traced:
        return preview_psf(traced, *window, task.fitted)
    return psf_of(psf_request(state, setup, TRACED.name, window, "preview"))
