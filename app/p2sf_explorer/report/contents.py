"""What a report says of a lens as it is set: every number and curve of it, computed before anything is drawn."""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import date
from typing import TypeVar

from p2sf.conventions import NM_PER_UM
from p2sf.errors import Cancelled, P2SFError
from p2sf.figures.record import versions
from p2sf.lens.lens import Lens
from p2sf.lens.misalignment import misalignments
from p2sf.lensfile.library import find_lens
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.messages import Message
from p2sf.paraxial.pupils import f_number
from p2sf.performance import PerformanceTable
from p2sf.setting import Request, explicit_values, set_up
from p2sf_explorer.compute.caption import field_text
from p2sf_explorer.compute.layout import Layout, layout
from p2sf_explorer.compute.live import Live, live
from p2sf_explorer.compute.matrix import pictures
from p2sf_explorer.compute.matrix.overlays import CurveOverlay, OverlayRequest, compared_fields, overlay_request
from p2sf_explorer.compute.matrix.overlays import answer as curves_of
from p2sf_explorer.compute.matrix.points import MatrixRequest, matrix_request, stated_fields
from p2sf_explorer.compute.matrix.tiles import Tiles
from p2sf_explorer.compute.setup import default_state, prescription, shipped_names
from p2sf_explorer.compute.views import first_order, lens_table
from p2sf_explorer.compute.views.field import FieldView, field_curves
from p2sf_explorer.compute.views.performance import answer as table_of
from p2sf_explorer.compute.views.performance import performance_request
from p2sf_explorer.state.limits import MOST_LISTED
from p2sf_explorer.state.link import link
from p2sf_explorer.state.state import ENTRIES, State, change

T = TypeVar("T")
OF_THE_SOURCE = "depth_mm", "field_deg", "field_x_deg", "wavelength_nm"
EVERY = 2  # of the sensor positions that the window draws contrast at


@dataclass(frozen=True, eq=False)
class LensReport:
    """Everything on the pages of a report; a part that cannot be has the reason in its place."""

    state: State
    lens: Lens
    source: Message
    written: date
    versions: dict[str, str]
    link: str
    misalignment: tuple[Message, ...]
    prescription: lens_table.Rows
    first_order: tuple[tuple[first_order.Row, ...], ...]
    layout: Layout
    performance: PerformanceTable
    contrast: CurveOverlay | Message
    through_focus: CurveOverlay | Message
    field_curves: FieldView | Message
    spots: "tuple[MatrixRequest, Tiles] | Message"
    psfs: "tuple[MatrixRequest, Tiles] | Message"

    @property
    def title(self) -> str:
        """Return the title of the lens."""
        return self.lens.title or self.lens.name


def report_of(
    state: State, tell: Callable[[float], object] = lambda _: None, stopped: Callable[[], bool] = lambda: False
) -> LensReport:
    """Return the report on a state; ``tell`` is called with the share that is done, ``stopped`` polled between parts.

    Raises P2SFError where the lens has no picture, Cancelled after ``stopped`` has said so.
    """
    found = live(state)
    steps = _Steps(tell, stopped)
    table = steps.take(lambda: table_of(performance_request(state), stopped, steps.part))
    return LensReport(
        state=state,
        lens=found.setup.lens,
        source=source_words(found),
        written=date.today(),
        versions=versions(),
        link=link(portable(state)),
        misalignment=misalignments(found.setup.lens),
        prescription=lens_table.rows(found).found,
        first_order=first_order.first_order(found).found,
        layout=layout(found.setup, state.optics.clip, "field", 3),
        performance=table,
        contrast=steps.attempt(lambda: _curves(found, "fields", steps)),
        through_focus=steps.attempt(lambda: _curves(found, "focus", steps)),
        field_curves=steps.attempt(lambda: field_curves(found).found),
        spots=steps.attempt(lambda: _matrix(found, "spot", steps)),
        psfs=steps.attempt(lambda: _matrix(found, "psf", steps)),
    )


STEPS = 6  # parts of a report that take time


class _Steps:
    """The share of a report that is done, told while its parts are made one after the other."""

    def __init__(self, tell: Callable[[float], object], stopped: Callable[[], bool]):
        self._tell, self.stopped, self._done = tell, stopped, 0

    def part(self, share: float, _so_far: object = None) -> None:
        """Tell the share of the present part."""
        self._tell((self._done + share) / STEPS)

    def take(self, make: Callable[[], T]) -> T:
        """Return a part; Cancelled where nobody wants the report any more."""
        made = make()
        if self.stopped():
            raise Cancelled("the report was stopped")
        self._done += 1
        self.part(0.0)
        return made

    def attempt(self, make: Callable[[], T]) -> T | Message:
        """Return a part, or why there is none."""
        try:
            return self.take(make)
        except Cancelled:
            raise
        except P2SFError as error:
            self._done += 1
            return error.message


def _curves(found: Live, of: str, steps: _Steps) -> CurveOverlay:
    request = _request(change(found.state, curves_of=of))
    return curves_of(request, steps.stopped, steps.part)


def _request(state: State) -> OverlayRequest:
    request = overlay_request(live(state))
    if not request.shifts:
        return request
    shifts = request.shifts[::EVERY]
    return OverlayRequest(
        request.of, request.state, request.lens, len(shifts), frequencies=request.frequencies, shifts=shifts
    )


def _matrix(found: Live, what: str, steps: _Steps) -> tuple[MatrixRequest, Tiles]:
    fields = compared_fields(found.state)
    if len(fields) > MOST_LISTED or len(fields) < 2:
        fields = stated_fields(prescription(found.state), MOST_LISTED)
    state = change(found.state, matrix_what=what, matrix_across="wavelength_nm", matrix_fields_deg=fields)
    request = matrix_request(live(state))
    return request, pictures.settle(request, steps.stopped, steps.part)


def source_words(found: Live) -> Message:
    """Return depth, field, wavelength and f-number in one line."""
    speed = first_order.aperture(float(f_number(found.setup.lens, found.setup.source.wavelength_um)))
    return Message(
        "{depth}, field {field}, {wavelength:.1f} nm, {speed}",
        depth=first_order.described_depth(found.state.optics.depth_mm),
        field=field_text(found.state),
        wavelength=found.state.optics.wavelength_nm,
        speed=speed,
    )


def portable(state: State) -> State:
    """Return a state whose link opens anywhere: it carries a lens that is not shipped as text."""
    if state.optics.lens_text is not None or state.optics.lens in shipped_names():
        return state
    return change(state, lens_text=lens_to_toml(prescription(state)))


def requested_state(name: str, request: Request) -> State:
    """Return the state of the explorer that shows a lens as a request of the command line sets it.

    What the explorer has no control for becomes part of its lens. Raises P2SFError as `p2sf.setting.set_up` does.
    """
    lens, first = find_lens(name), default_state(name)
    given = explicit_values(request)
    setup = set_up(lens, request)
    given |= {"depth_mm": setup.source.depth_mm, "wavelength_nm": NM_PER_UM * setup.source.wavelength_um}
    if given.keys() & {"field_deg", "object_height_mm", "image_height_mm"}:
        given["field_deg"] = setup.field_deg
    given = {key: value for key, value in given.items() if not key.endswith("_height_mm")}
    if all(key in ENTRIES and not (key in ("zoom", "focus_position") and isinstance(given[key], str)) for key in given):
        return change(first, **given)
    kept = {key: given[key] for key in (*OF_THE_SOURCE, "aim") if key in given}
    return change(first, lens_text=lens_to_toml(setup.lens), **kept)
