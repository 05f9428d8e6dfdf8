"""The film of random builds: the state and the words of each frame. No Qt in here."""

from p2sf.messages import Message, Number
from p2sf.tolerance.criteria import of_worst_field
from p2sf_explorer.compute.views.tolerances import ToleranceQuestion, ToleranceResult, errors_of, figures
from p2sf_explorer.playback.sweep import Moment
from p2sf_explorer.state.built import exaggerate
from p2sf_explorer.state.pinning import unpin
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.workspaces import Workspace, with_workspace

FILMED = 40  # builds, the first ones of a draw: as random as any
BUILDS_PER_S = 4
LARGER = 30  # by which errors are drawn where the state does not say: a workshop's tilts are too small to be seen
ARRANGEMENT = Workspace("layout", ("psf",), "tolerances", 0.36, (0.42, 0.58), rail_side="bottom")
VALUES = {
    "rms_waves": "RMS wavefront {value} λ",
    "strehl": "Strehl ratio {value}",
    "mtf": "contrast {value} at {frequency:g} /mm",
    "boresight_um": "image shifted by {value} µm",
}


def moments_of_builds(asked: ToleranceQuestion, found: ToleranceResult, count: int = FILMED) -> tuple[Moment, ...]:
    """Return the frames of the lens as designed and of the first builds: their layout, PSF, and place in the yield.

    The words of a frame say which build it is, its value of the criterion in the worst field, and by what factor tilts
    and decentres are drawn.
    """
    view, display = figures(found, asked.view), asked.state.display
    arranged = with_workspace(unpin(asked.state), display.workspace, ARRANGEMENT)
    larger = display.exaggerated if display.exaggerated > 1 else LARGER
    designed = change(arranged, exaggerated=larger, windows=(), tolerances_build=0)

    def value(waves: float) -> Message:
        written = Number(f"{waves:.{view.places}f}")
        return Message(VALUES[view.criterion], value=written, frequency=asked.view.frequency_per_mm)

    made = [Moment(designed, Message("as designed: {value}", value=value(view.nominal)))]
    for number, waves in enumerate(of_worst_field(found.builds, view.criterion)[:count].tolist()):
        state = change(designed, errors=errors_of(found, number), tolerances_build=number + 1)
        made.append(Moment(state, _caption(state, value(waves))))
    return tuple(made)


def _caption(state: State, value: Message) -> Message:
    _, factor = exaggerate(state.optics.errors, state.display.exaggerated)
    return Message(
        "build {number}: {value} · tilts and decentres ×{factor}, rays as they are",
        number=state.tolerances.build,
        value=value,
        factor=factor,
    )
