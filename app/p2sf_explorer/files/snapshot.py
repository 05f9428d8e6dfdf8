"""What a snapshot writes: the PSF's data or a picture, with the state that made it inside. No Qt in here."""

import os
from dataclasses import replace
from pathlib import Path

from p2sf.errors import ExportError
from p2sf.figures.pixel_light import critical_pixel_um, fine_grid
from p2sf.figures.record import versions
from p2sf.files.writing import write_beside
from p2sf.io.png_text import with_text
from p2sf.io.psf_files import write_psf
from p2sf.io.record import describe
from p2sf.messages import Message
from p2sf.psf.methods import psf_of
from p2sf.psf.pixel_integrals import integrate
from p2sf.psf.result import Psf
from p2sf_explorer.compute.lens_files import is_file
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.setup import request_setup
from p2sf_explorer.files.embedded_state import ENTRY, KEYWORD, MOST
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.state_files import is_state, state_to_json

PathLike = str | os.PathLike[str]
DATA_ENDINGS = (".npz", ".tiff", ".fits", ".csv")


def write_state(state: State, path: PathLike, **extra: object) -> Path:
    """Write a state file that ``p2sf explore`` opens again; a lens given by a relative path is made absolute.

    Raises ExportError where it cannot be written, and for the place of a file that is no state.
    """
    check_state_place(path)
    text = state_text(state, **extra)
    return write_beside(path, lambda handle: handle.write(text.encode()))


def state_text(state: State, **extra: object) -> str:
    """Return the text of a state for a file of its own or within another; ExportError for more than can be read."""
    path = Path(state.optics.lens)
    portable = change(state, lens=str(path.resolve())) if path.is_file() else state
    text = state_to_json(portable, versions=versions(), **extra)
    if len(text) > MOST:
        raise ExportError(
            "the lens takes {size:.3g} MB of text, of which {most:g} MB can be kept with what is on screen; save the "
            "lens as a file (Ctrl+Shift+S) and open that",
            size=len(text) / 1e6,
            most=MOST / 1e6,
        )
    return text


def check_state_place(path: PathLike) -> None:
    """Raise ExportError where a state would take the place of a file that is none, such as a lens."""
    if os.path.lexists(path) and not is_state(path):
        raise ExportError(
            "{path} is there already and is no state of the explorer; choose another name, or move that file",
            path=str(path),
        )


def state_beside(path: PathLike) -> Path:
    """Return where the state of a file lies that cannot hold it."""
    return Path(f"{os.fspath(path)}.state.json")


def saved(path: PathLike, holds: bool = True) -> Message:
    """Return that a file was saved, and where its state is: in it, where it ``holds`` one, or beside it."""
    name = Path(path).name
    if holds:
        return Message("Saved {name}, with the state in it", name=name)
    return Message("Saved {name}, and its state as {beside}", name=name, beside=state_beside(path).name)


def check_snapshot(state: State, path: PathLike) -> None:
    """Raise ExportError where a file would take the place of one that the state names: its lens, a photo, a map."""
    names = [state.optics.lens, state.photo.source, state.photo.depths, state.measured.picture]
    if state.compare.pinned:
        names.append(state.compare.pinned.optics.lens)
    if any(is_file(name) and os.path.exists(path) and os.path.samefile(name, path) for name in names):
        raise ExportError(
            "{path} is open, and what is on screen would be lost with it; choose another name", path=str(path)
        )


def write_data(live: Live | None, path: PathLike, state: State | None = None) -> Path:
    """Write the PSF on screen as .npz, .tiff, .fits or .csv with its state; return the path. ExportError.

    ``state`` is the window's where that is more than the picture's own: B may be pinned beside it.
    """
    if live is None:
        raise ExportError("{path}: this set-up has no PSF; change it until there is a picture", path=str(path))
    state = state or live.state
    if Path(path).suffix.lower() not in DATA_ENDINGS:
        raise ExportError(
            '{path}: PSF data has no ending "{ending}"; choose {endings}',
            path=str(path),
            ending=Path(path).suffix,
            endings=DATA_ENDINGS,
        )
    check_snapshot(state, path)
    meta = {**describe(request_setup(live.state)), ENTRY: state_text(state)}
    return write_psf(light_of(live), path, meta)


def light_of(live: Live) -> Psf:
    """Return the PSF on screen; where its samples are farther apart than λ/(4 NA), as the light around each.

    Where that takes more samples than the window would sum, it stays as it is.
    """
    request, psf, own = live.request, live.psf, live.setup.cone
    if request is None or psf.method == "geometric" or psf.values.shape[0] != psf.values.shape[1]:
        return psf
    finest = float(critical_pixel_um(psf.wavelength_um, max(own.na_x, own.na_y)))
    pixels = psf.values.shape[0]
    grid = fine_grid(pixels, psf.pixel_um, finest)
    if grid is None or grid.side > live.finest:
        return psf
    light = integrate(
        lambda count, pitch: psf_of(replace(request, window=(count, pitch))), pixels, psf.pixel_um, finest
    )
    return replace(light, azimuth_deg=psf.azimuth_deg)


def write_picture(state: State, png: bytes, path: PathLike) -> Path:
    """Write a picture already encoded as PNG with its state; return the path. ExportError."""
    if Path(path).suffix.lower() != ".png":
        raise ExportError(
            '{path}: a picture of the window ends in ".png", not "{ending}"; change the ending',
            path=str(path),
            ending=Path(path).suffix,
        )
    check_snapshot(state, path)
    whole = with_text(png, KEYWORD, state_text(state))
    return write_beside(path, lambda handle: handle.write(whole))
