"""From a state to everything the panels show, one frozen answer. No Qt in here, and panels compute nothing."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from time import perf_counter
from typing import Any, Generic, TypeVar

from p2sf.errors import P2SFError
from p2sf.figures.perfect import airy_radius_um
from p2sf.messages import Message
from p2sf.psf.methods import PsfRequest
from p2sf.psf.result import Psf
from p2sf.pupil.wavefront_map import WavefrontMap
from p2sf_explorer.compute.deferred_sums import Request, SumCache
from p2sf_explorer.compute.layout import Layout, layout_of
from p2sf_explorer.compute.method import ALONE, Least, Rendered, render_state
from p2sf_explorer.compute.pupil import dominant, pupil_of
from p2sf_explorer.compute.setup import ParaxialSetup, paraxial_setup
from p2sf_explorer.compute.warnings import warnings
from p2sf_explorer.state.state import State


@dataclass(frozen=True)
class Live:
    """One answer: setup, drawing, pupil, PSF, messages, and what the open panels show, in ``views``.

    ``method`` is the method chosen, by a person or by ``auto``; ``milliseconds`` of each part of the work; ``quality``
    is "preview" while a slider moves, else "settled"; ``pending`` is the sum of waves that the PSF stands in for,
    ``request`` the one that made it, with up to ``finest`` samples a side, ``slow`` whether that sum takes longer than
    a frame, and ``refused`` says why the chosen method has none here. ``before``: the views of the frame before, while
    a slider moves. With a B pinned, ``side`` names what is on screen, ``sides`` are the states of A and B, and
    ``difference`` is what A − B shows in place of this answer.
    """

    state: State
    setup: ParaxialSetup
    layout: Layout
    pupil: WavefrontMap
    psf: Psf
    quality: str
    airy_radius_um: float
    dominant: Message
    warnings: tuple[Message, ...]
    why: Message
    method: str
    milliseconds: Mapping[str, float]
    views: Mapping[str, "View[Any]"] = field(default_factory=dict)
    before: Mapping[str, "View[Any]"] = field(default_factory=dict)
    side: str = ""
    sides: tuple[State, ...] = ()
    pending: Request | None = None
    request: PsfRequest | None = None
    finest: int = 0
    refused: Message | None = None
    slow: bool = False
    difference: Any = None


Found = TypeVar("Found")


@dataclass(frozen=True, eq=False)
class View(Generic[Found]):
    """What one panel shows of an answer: what is ``found`` within the frame, and what is left to be asked.

    ``question``: what a worker is to answer, None where nothing is missing, or where it need not be asked again; it is
    asked at once, or where ``held`` when the slider rests for a moment. ``why``: why there is nothing to show.
    """

    found: Found
    question: Any = None
    held: bool = False
    why: Message | None = None


ViewFunction = Callable[["Live"], View[Any]]
"""A function from the answer so far to what one panel shows, without Qt."""


def live(
    state: State,
    quality: str = "settled",
    views: Mapping[str, ViewFunction] | None = None,
    kept_method: str = "",
    least: Least = ALONE,
    cache: SumCache | None = None,
    before: Mapping[str, "View[Any]"] | None = None,
) -> Live:
    """Return the answer for a state; P2SFError where there is none. ``views`` are computed after the rest.

    ``kept_method`` names the method that ``auto`` keeps while a slider moves; the PSF's window has at least
    the samples and the width in µm of ``least``.
    ``before``: the views of the frame before, for those that follow in turns.
    With ``cache``, a sum of waves too slow for a frame is taken from there or left pending; without, waited for.
    """
    begun = perf_counter()
    setup = paraxial_setup(state)
    drawing = layout_of(state, setup)
    placed = perf_counter()
    picture = render_state(state, setup, quality, kept_method, least, cache)
    psf, finished = picture.psf, perf_counter()
    pupil = picture.pupil or pupil_of(setup, picture.exact, quality, state.optics.clip)
    answer = Live(
        state=state,
        setup=setup,
        layout=drawing,
        pupil=pupil,
        psf=psf,
        quality=quality,
        airy_radius_um=float(airy_radius_um(setup.source.wavelength_um, setup.cone.na)),
        dominant=dominant(pupil, setup.coefficients),
        warnings=warnings(setup, pupil if picture.exact else None, drawing.rays, shows_density(picture, quality)),
        why=picture.why,
        method=picture.method,
        pending=picture.pending,
        request=picture.request,
        finest=picture.finest,
        refused=picture.refused,
        slow=picture.slow,
        before=before or {},
        milliseconds={"layout": 1e3 * (placed - begun), "psf": 1e3 * (finished - placed)},
    )
    return with_views(answer, views or {}, begun)


def with_views(answer: Live, views: Mapping[str, ViewFunction], begun: float) -> Live:
    """Return the answer with the open panels' views and the total time."""
    results = {name: try_view(view, answer) for name, view in views.items()}
    total = 1e3 * (perf_counter() - begun)
    return replace(answer, views=results, milliseconds={**answer.milliseconds, "all": total})


def try_view(view: ViewFunction, answer: Live) -> View[Any]:
    """Return what one panel shows, or why it shows nothing: the other panels have their pictures all the same."""
    try:
        return view(answer)
    except P2SFError as error:
        return View(None, why=error.message)


def shows_density(picture: Rendered, quality: str) -> bool:
    """Return whether ray density is shown and nothing better follows."""
    follows = quality != "settled" or picture.pending or picture.refused
    return picture.psf.method == "geometric" and not follows
