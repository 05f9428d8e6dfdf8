"""One PSF from a .npz, .tiff, .csv, .fits or .nc file that this program wrote."""

import os

import numpy as np

from p2sf.errors import ExportError
from p2sf.figures.psf_data import FIGURES, OWN, PsfFigures
from p2sf.files.atomic import DAMAGED
from p2sf.files.reasons import reason
from p2sf.files.writing import by_ending
from p2sf.io.psf_files import READERS
from p2sf.messages import Message
from p2sf.psf.result import Psf

FORMER = {"tolerance": "error"}
"""Fields of files before 0.3 by their names today."""
OF_THE_FILE = ("psf", "state")
"""What a file of a PSF states besides its provenance: what the PSF says about itself, and the window's state."""


def read_psf(path: str | os.PathLike[str]) -> tuple[Psf, dict]:
    """Return the PSF in a .npz, .tiff, .csv, .fits or .nc that this program wrote, and its meta.

    Exact but for the float32 of .tiff. Raises ExportError for a file that is missing or of another kind.
    """
    read = by_ending(path, READERS)
    try:
        values, meta = read(path)
        return psf_of_file(values, meta), meta
    except ExportError:  # a ValueError, such as that astropy is not installed
        raise
    except OSError as error:
        raise ExportError(
            "{path} cannot be read, {reason}; check the name",
            path=str(path),
            reason=reason(error),
        ) from error
    except (ValueError, *DAMAGED) as error:
        raise ExportError(
            "{path} is not a PSF that this program wrote; export it again with p2sf psf -o", path=str(path)
        ) from error


def psf_of_file(values: np.ndarray, meta: dict) -> Psf:
    """Return the PSF of a file's samples and record; KeyError or TypeError where that is not of a PSF."""
    provenance = {name: value for name, value in meta.items() if name not in OF_THE_FILE}
    return psf_from(values, meta["psf"]).with_figures(provenance=provenance)


def psf_from(values: np.ndarray, known: dict) -> Psf:
    """Return a PSF of its samples and its `facts`; TypeError where these are not a PSF's."""
    peak = known.get("peak_um")
    read = {"sampling": Message(str(known.get("sampling", ""))), "peak_um": peak and tuple(peak)}
    known = {FORMER.get(name, name): value for name, value in known.items()}
    known |= read
    figures = PsfFigures(**{name: known[name] for name in FIGURES if name in known})
    return Psf(values, figures=figures, **{name: known[name] for name in OWN if name in known})
