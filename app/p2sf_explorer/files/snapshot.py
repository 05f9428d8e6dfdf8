"""What a snapshot writes: the PSF's data or a picture, the state that made it inside and beside. No Qt in here."""

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from p2sf.errors import ExportError
from p2sf.files.writing import write_beside
from p2sf.io.psf_files import write_psf
from p2sf.io.record import describe
from p2sf.psf.methods import psf_of
from p2sf.psf.pixel_integrals import critical_pixel_um, fine_side, integrate, samples_across
from p2sf.psf.record import versions
from p2sf.psf.result import Psf
from p2sf_explorer.compute.live import Live
from p2sf_explorer.compute.setup import request_setup
from p2sf_explorer.files.embedded_state import with_state
from p2sf_explorer.state.state import State, change
from p2sf_explorer.state.state_files import state_to_json

PathLike = str | os.PathLike[str]
DATA_ENDINGS = (".npz", ".tiff", ".fits", ".csv")


def side_car(path: PathLike) -> Path:
    """Return where the state of a snapshot lies: beside it, the same name with .json."""
    return Path(path).with_suffix(".json")


def write_state(state: State, path: PathLike, **extra: object) -> Path:
    """Write a state file that ``p2sf explore`` opens again; a lens given by a relative path is made absolute."""
    text = state_to_json(_portable(state), versions=versions(), **extra)
    return write_beside(path, lambda handle: handle.write(text.encode()))


def write_data(live: Live | None, path: PathLike, state: State | None = None) -> tuple[Path, Path]:
    """Write the PSF on screen as .npz, .tiff, .fits or .csv and its state beside; return both paths. ExportError.

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
    meta = {**describe(request_setup(live.state)), "state": _entries(state)}
    written = _writer(path)(light_of(live), path, meta)
    return written, write_state(state, side_car(path), exported=Path(path).name)


def light_of(live: Live) -> Psf:
    """Return the PSF on screen; where its samples are farther apart than λ/(4 NA), as the light around each.

    Where that takes more samples than the window would sum, it stays as it is.
    """
    request, psf, own = live.request, live.psf, live.setup.cone
    if request is None or psf.method == "geometric" or psf.values.shape[0] != psf.values.shape[1]:
        return psf
    finest = float(critical_pixel_um(psf.wavelength_um, max(own.na_x, own.na_y)))
    pixels = psf.values.shape[0]
    across = samples_across(pixels, psf.pixel_um, finest)
    if across == 1 or fine_side(pixels, across) > live.finest:
        return psf
    light = integrate(
        lambda count, pitch: psf_of(replace(request, window=(count, pitch))), pixels, psf.pixel_um, finest
    )
    return replace(light, azimuth_deg=psf.azimuth_deg)


def _writer(path: PathLike) -> Callable[[Psf, PathLike, dict[str, Any]], Path]:
    """Return the function that writes a PSF to a file of this name."""
    if Path(path).suffix.lower() != ".fits":
        return write_psf
    from p2sf.io.fits_psf import write_psf_fits  # it imports databases, which the start of the window need not wait for

    return write_psf_fits


def write_picture(state: State, png: bytes, path: PathLike) -> tuple[Path, Path]:
    """Write a picture already encoded as PNG and its state beside; return both paths. ExportError."""
    if Path(path).suffix.lower() != ".png":
        raise ExportError(
            '{path}: a picture of the window ends in ".png", not "{ending}"; change the ending',
            path=str(path),
            ending=Path(path).suffix,
        )
    whole = with_state(png, _entries(state))
    written = write_beside(path, lambda handle: handle.write(whole))
    return written, write_state(state, side_car(path), exported=Path(path).name)


def _entries(state: State) -> str:
    return state_to_json(_portable(state))


def _portable(state: State) -> State:
    path = Path(state.optics.lens)
    return change(state, lens=str(path.resolve())) if path.is_file() else state
