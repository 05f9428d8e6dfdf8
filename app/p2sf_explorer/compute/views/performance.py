"""The table of figures over the field: what it depends on, and the work for it. No Qt in here."""

from collections.abc import Callable
from dataclasses import dataclass

from p2sf.errors import P2SFError
from p2sf.lens.lens import Lens
from p2sf.lens.source import Source
from p2sf.performance import USUAL_PER_MM, PerformanceTable, growing_table
from p2sf_explorer.compute.live import Live, View
from p2sf_explorer.compute.matrix.overlays import compared_fields
from p2sf_explorer.compute.sampled import optics
from p2sf_explorer.compute.setup import paraxial_setup
from p2sf_explorer.state.state import State, change


@dataclass(frozen=True)
class PerformanceRequest:
    """Everything the table depends on: the lens as it is set, a source for each row, and frequencies per mm.

    ``fields_deg``: the fields of the rows as the window has them; those of ``sources`` are seen by a perturbed lens.
    """

    lens: Lens
    sources: tuple[Source, ...]
    fields_deg: tuple[float, ...]
    frequency_per_mm: tuple[float, ...]
    clip: bool


def performance(live: Live) -> View[None]:
    """Return what the table of the present setup shows, which does not depend on the present field."""
    return View(None, performance_request(live.state))


def performance_request(state: State) -> PerformanceRequest:
    """Return the request for the table of a state. Raises P2SFError where the lens has no image."""
    fields = compared_fields(state)
    setups = [paraxial_setup(change(optics(state), field_deg=angle, field_x_deg=0.0)) for angle in fields]
    frequencies = state.curves.frequencies_per_mm or USUAL_PER_MM
    return PerformanceRequest(
        setups[0].lens, tuple(setup.source for setup in setups), fields, frequencies, state.optics.clip
    )


def answer(
    request: PerformanceRequest, stopped: Callable[[], bool], tell: Callable[[float, object], None]
) -> PerformanceTable:
    """Return the table of a request, for a worker; ``tell(share, so far)`` is called after every row."""
    table: PerformanceTable | None = None
    for table in growing_table(request.lens, request.sources, request.frequency_per_mm, request.clip):
        tell(len(table.found) / len(request.sources), table)
        if stopped():
            break
    if table is None:
        raise P2SFError("there is no field to compute; list at least one")
    return table
