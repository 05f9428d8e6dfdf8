"""Open any file a person gives: a state, a snapshot, a lens; or say why it is none of these. No Qt in here."""

import os
from dataclasses import dataclass

from p2sf.errors import LensFileError, P2SFError
from p2sf.lensfile.importing import Import
from p2sf.lensfile.toml.lens import lens_to_toml
from p2sf.messages import Message
from p2sf_explorer.compute.lens_files import import_of
from p2sf_explorer.compute.setup import with_lens
from p2sf_explorer.files.embedded_state import foreign, state_inside
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.state_files import is_state, read_state

SNAPSHOTS = "*.png *.npz *.tif *.tiff *.fits *.csv *.exr"
KINDS = (
    f"Lenses, states, snapshots (*.toml *.zmx *.zar *.zip *.seq *.len *.roa *.fx *.json *.dat *.txt {SNAPSHOTS});;"
    "P2SF lens (*.toml);;Zemax (*.zmx *.zar *.zip);;CODE V (*.seq);;OSLO (*.len);;ray-optics (*.roa);;"
    "ISET, Optiland, DeepLens or patent lens, or a state (*.json *.dat);;"
    "Renderer's lens (*.fx);;Optical Bench or table (*.txt *.csv);;"
    f"Snapshot ({SNAPSHOTS});;All files (*)"
)
OWN_FORMAT = "P2SF lens (TOML)"
REPORT_TAB = "import"


@dataclass(frozen=True)
class Refusal:
    """A file that is not opened, and why; ``substituted`` is its lens with substitute glasses, None without one."""

    path: str
    message: Message
    substituted: Import | None


def open_file(state: State, path: str) -> State:
    """Return the state after opening a file; its content decides what it is. A foreign lens comes with its report.

    Raises P2SFError where the file is neither a state nor a lens.
    """
    path = os.path.abspath(path)
    if is_state(path):
        return read_state(path)
    inside = state_inside(path)
    if inside:
        return inside
    reason = foreign(path)
    if reason:
        raise LensFileError(reason, path)
    fresh = with_lens(state, path)
    return fresh if import_of(path).report.format == OWN_FORMAT else change(fresh, tab=REPORT_TAB)


def refusal(path: str, error: P2SFError) -> Refusal:
    """Return why a file is refused, and its lens with substitute glasses, if these would do."""
    try:
        return Refusal(path, error.message, import_of(os.path.abspath(path), True))
    except P2SFError:
        return Refusal(path, error.message, None)


def with_substitutes(state: State, path: str) -> State:
    """Return the state with the lens of a file and its substitute glasses; the lens then counts as edited."""
    path = os.path.abspath(path)
    return with_lens(state, path, lens_to_toml(import_of(path, True).lens))
