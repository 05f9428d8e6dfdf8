"""All PSFs of a file at its nodes, stored or rendered on opening."""

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from p2sf.arguments import check_arguments
from p2sf.database.files.npz import load_database
from p2sf.database.files.place import is_stack
from p2sf.database.files.provenance import Stored
from p2sf.database.files.stack import open_stack, read_psfs
from p2sf.database.render import Sampling, critical_pixel_um, grid_of, light_of
from p2sf.errors import DatabaseError
from p2sf.figures.record import CONVENTIONS, UNITS
from p2sf.files.writing import plain

MOST_BYTES = 1 << 31
DEFAULT = Sampling()


class PsfArray(Protocol):
    """PSFs (depth, field, wavelength, y, x) float32, their pitch, and the values along the first three axes."""

    @property
    def values(self) -> np.ndarray:
        """The PSFs."""

    @property
    def pixel_um(self) -> float:
        """The distance between samples, µm."""

    @property
    def depths_mm(self) -> np.ndarray:
        """The depths, mm."""

    @property
    def fields_deg(self) -> np.ndarray:
        """The field angles, degrees."""

    @property
    def wavelengths_nm(self) -> np.ndarray:
        """The wavelengths, nm."""


@dataclass(frozen=True, eq=False)
class Cube:
    """PSFs (depth, field, wavelength, y, x), float32, unit sum, and the database they belong to.

    ``integrated``: whether a sample is the light of a whole pixel and not the intensity at its place.
    """

    values: np.ndarray
    pixel_um: float
    stored: Stored
    integrated: bool = False

    @property
    def depths_mm(self) -> np.ndarray:
        """Return the depth of each PSF along the first axis, mm."""
        return self.stored.depths_mm

    @property
    def fields_deg(self) -> np.ndarray:
        """Return the field angle along the second axis, degrees."""
        return self.stored.fields_deg

    @property
    def wavelengths_nm(self) -> np.ndarray:
        """Return the wavelength along the third axis, nm."""
        return self.stored.wavelengths_nm

    @property
    def record(self) -> dict[str, Any]:
        """Return what files of other programs state beside the PSFs, as JSON has it."""
        own = {"predicted_error": plain(self.stored.accuracy.record), "integrated": self.integrated}
        return self.stored.record | own | {"units": UNITS, "conventions": CONVENTIONS}


@check_arguments
def open_database(path: str | os.PathLike[str]) -> Stored:
    """Open a PSF database: a .npz file or a stack written by `build_database` or ``p2sf database build``.

    Parameters
    ----------
    path : str or path
        The file, or the folder of a stack (.zarr).

    Returns
    -------
    Stored
        ``.psf(source)`` and ``.coefficients(source)`` look up a source; ``.meta`` says where the numbers come from.

    Raises
    ------
    DatabaseError
        If the file is missing, damaged, cut short, of another kind or of a newer version.

    Examples
    --------
    >>> import p2sf
    >>> p2sf.open_database("dg.npz").psf(p2sf.Source(field_deg=7))  # doctest: +SKIP
    """
    return open_stack(path).stored if is_stack(path) else load_database(path)


def open_cube(
    path: str | os.PathLike[str], sampling: Sampling = DEFAULT, tell: Callable[[float], object] = float
) -> Cube:
    """Return all PSFs of a file; a .npz is rendered with ``sampling``, a stack read unchanged. Raises DatabaseError.

    ``tell`` is told the share rendered, from 0 to 1.
    """
    if is_stack(path):
        stack = open_stack(path)
        check_line(stack.stored)
        _check_size(path, stack.psf.shape)
        return Cube(read_psfs(stack, ...), stack.pixel_um, stack.stored, stack.integrated)
    stored = load_database(path)
    check_line(stored)
    pitch = sampling.pixel_um or critical_pixel_um(stored.database)
    space = stored.database.space
    _check_size(path, (*space.shape, sampling.pixels, sampling.pixels))
    sampling = replace(sampling, pixel_um=pitch)
    grid = grid_of(stored.database, sampling)
    values = np.empty((*space.shape, sampling.pixels, sampling.pixels), np.float32)
    places = np.broadcast_arrays(*space.axes)
    for done, index in enumerate(np.ndindex(space.shape[:2]), 1):  # a depth and a field, in all colours
        values[index] = light_of(stored.database, [place[index] for place in places], sampling, grid)
        tell(done / (space.shape[0] * space.shape[1]))
    return Cube(values, pitch, stored, grid is not None)


def check_line(stored: Stored) -> None:
    """Raise DatabaseError for fields that fill a rectangle, in files that have one axis for them."""
    if stored.database.space.field_x_slopes is not None:
        raise DatabaseError(
            "the database of {lens} has fields along x and along y, and this format one axis of fields; write a stack",
            lens=stored.meta["lens"]["name"],
        )


def _check_size(path: str | os.PathLike[str], shape: tuple[int, ...]) -> None:
    """Raise DatabaseError for more PSFs than one file of these kinds, or the memory, can hold."""
    size = 4 * float(np.prod(shape))
    if size > MOST_BYTES:
        raise DatabaseError(
            "{path} holds {size:.1f} GiB of PSFs, more than the 2 GiB one exported file may have; "
            "use the Zarr stack itself, or build with fewer nodes or pixels",
            path=str(path),
            size=size / (1 << 30),
        )
