"""FITS: samples as the image, all facts about them as JSON in its header; and pictures and facts from such files."""

import io
import json
import os
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import islice
from types import MappingProxyType
from typing import Any, BinaryIO

import numpy as np

from p2sf.errors import ExportError
from p2sf.files.reading import LONGEST_TEXT, check_samples, open_file, parse_json, size_of
from p2sf.version import program_version

FITS = ".fits", ".fit", ".fts"  # endings
META = "P2SFMETA"
SIMPLE, END = b"SIMPLE", b"END     "  # begin and end the head of every FITS file
MOST_UNITS = 64  # looked through for a picture
NO_TABLES: Mapping[str, Any] = MappingProxyType({})


Card = tuple[str, object, str]
"""Keyword, value and comment."""
Column = tuple[str, np.ndarray, str]
"""Name, values and unit, "" for none."""


def write_image(
    handle: BinaryIO,
    values: np.ndarray,
    header: Iterable[Card],
    meta: Mapping[str, Any],
    tables: Mapping[str, Sequence[Column]] = NO_TABLES,
) -> None:
    """Write samples as the image of a FITS file, with a header, ``meta`` as JSON in it, and tables behind it.

    The JSON goes over CONTINUE cards (FITS 4.0, 4.2.1.2). Raises ExportError without astropy.
    """
    fits = astropy_fits()
    image = fits.PrimaryHDU(values)
    program = ("CREATOR", f"p2sf {program_version()}", "software")
    for keyword, value, comment in (*header, program, (META, json.dumps(meta), "facts as JSON")):
        image.header[keyword] = (value, comment)
    content = io.BytesIO()  # astropy refuses a handle that was opened to create a file
    fits.HDUList([image, *(_table(fits, name, columns) for name, columns in tables.items())]).writeto(content)
    handle.write(content.getbuffer())


def _table(fits: Any, name: str, columns: Sequence[Column]) -> Any:
    made = [fits.Column(key, _form(values), unit or None, array=values) for key, values, unit in columns]
    return fits.BinTableHDU.from_columns(made, name=name)


def _form(values: np.ndarray) -> str:
    """Return the FITS format of a column: double, or text as wide as its longest."""
    return "D" if values.dtype.kind == "f" else f"{values.dtype.itemsize // 4}A"


def axis_cards(shape: tuple[int, ...], pixel_um: float) -> Iterator[Card]:
    """Yield where the chief ray lies in (…, y, x): sample N//2 counted from 0, that is N//2 + 1 from 1."""
    for axis, name in ((1, "X"), (2, "Y")):
        yield f"CTYPE{axis}", f"{name} (field along +Y)" if axis == 2 else name, "sensor axis"
        yield f"CRPIX{axis}", shape[-axis] // 2 + 1, "chief ray"
        yield f"CRVAL{axis}", 0.0, "chief ray"
        yield f"CDELT{axis}", pixel_um, "pitch"
        yield f"CUNIT{axis}", "um", ""


def first_picture(path: str | os.PathLike[str]) -> tuple[np.ndarray, Any]:
    """Return the samples and the header of a FITS file's first picture, rows up.

    Raises ExportError without astropy; OSError, ValueError, KeyError and TypeError for what cannot be read.
    """
    fits = astropy_fits()
    with open_file(path) as stream, _damage(fits):
        size = size_of(stream)
        head = stream.read(LONGEST_TEXT)
        if not head.startswith(SIMPLE) or END not in head:  # astropy would unpack it, or look for its end for ever
            raise ValueError("no FITS file")
        stream.seek(0)
        with fits.open(stream, memmap=False) as file:
            for unit in islice(file, MOST_UNITS):
                if unit.is_image and len(unit.shape) >= 2:
                    check_samples(unit.shape, size, abs(unit.header["BITPIX"]) // 8)
                    return unit.data, unit.header
    raise ValueError("no picture in it")


def picture_and_meta(path: str | os.PathLike[str]) -> tuple[np.ndarray, Any]:
    """Return the samples of a FITS file that this program wrote, and the facts in its header, as JSON has them.

    Raises as `first_picture`, and KeyError for another file.
    """
    values, header = first_picture(path)
    with _damage(astropy_fits()):
        return values, parse_json(header[META])


@contextmanager
def _damage(fits: Any) -> Iterator[None]:
    """Raise ValueError for a card that astropy cannot read, whose own error is neither that nor an OSError."""
    try:
        with warnings.catch_warnings(action="ignore"):
            yield
    except fits.VerifyError as error:
        raise ValueError(str(error)) from error


def astropy_fits() -> Any:
    """Return `astropy.io.fits`; ExportError where it is not installed."""
    try:
        from astropy.io import fits
    except ImportError as error:
        raise ExportError("FITS files need astropy, which is not installed; pip install 'p2sf[fits]'") from error
    return fits
