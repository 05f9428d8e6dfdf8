"""What a snapshot writes: the PSF's data or a picture, the state that made it inside and beside. No Qt in here."""

from dataclasses import replace
from pathlib import Path

from p2sf.errors import ExportError
from p2sf.files.writing import write_beside
from p2sf.io.psf_files import write_psf
from p2sf.io.record import describe, versions
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.setup import request_setup
from p2sf_explorer.files.embedded_state import with_state
from p2sf_explorer.state.state import State, state_to_json

DATA_ENDINGS = (".npz", ".tiff", ".fits", ".csv")


def side_car(path) -> Path:
    """Return where the state of a snapshot lies: beside it, the same name with .json."""
    return Path(path).with_suffix(".json")


def write_state(state: State, path, **extra) -> Path:
    """Write a state file that ``p2sf explore`` opens again; a lens given by a relative path is made absolute."""
    text = state_to_json(_portable(state), versions=versions(), **extra)
    return write_beside(path, lambda handle: handle.write(text.encode()))


def write_data(live: Live | None, path, state: State | None = None) -> tuple[Path, Path]:
    """Write the PSF on screen as .npz, .tiff, .fits or .csv and its state beside; return both paths. ExportError.

    ``state`` is the window's where that is more than the picture's own: B may be pinned beside it.
    """
    if live is None:
        raise ExportError(f"{path}: this set-up has no PSF; change it until there is a picture")
    state = state or live.state
    if Path(path).suffix.lower() not in DATA_ENDINGS:
        ending = Path(path).suffix
        raise ExportError(f'{path}: PSF data has no ending "{ending}"; choose {", ".join(DATA_ENDINGS)}')
    meta = {**describe(request_setup(live.state)), "state": _entries(state)}
    written = _writer(path)(live.psf, path, meta)
    return written, write_state(state, side_car(path), exported=Path(path).name)


def _writer(path):
    """Return what writes a PSF under this name."""
    if Path(path).suffix.lower() != ".fits":
        return write_psf
    from p2sf.io.fits_psf import write_psf_fits  # with it come databases, which a start can do without

    return write_psf_fits


def write_picture(state: State, png: bytes, path) -> tuple[Path, Path]:
    """Write a picture already encoded as PNG and its state beside; return both paths. ExportError."""
    if Path(path).suffix.lower() != ".png":
        raise ExportError(
            f'{path}: a picture of the window ends in ".png", not "{Path(path).suffix}"; change the ending'
        )
    whole = with_state(png, _entries(state))
    written = write_beside(path, lambda handle: handle.write(whole))
    return written, write_state(state, side_car(path), exported=Path(path).name)


def _entries(state: State) -> str:
    return state_to_json(_portable(state))


def _portable(state: State) -> State:
    path = Path(state.lens)
    return replace(state, lens=str(path.resolve())) if path.is_file() else state
