"""Colours of a sensor from the curves of its filters."""

import csv
import os
from math import ceil
from pathlib import Path

import numpy as np

from p2sf.colour.spectrum import NM, relative_power, spectrum_of
from p2sf.conventions import NM_PER_UM
from p2sf.errors import RequestError
from p2sf.files.reading import read_text
from p2sf.files.reasons import reason
from p2sf.scene.scene import Channel
from p2sf.scene.spectrum import reduce_spectrum

NODES = 8  # wavelengths of a channel: polynomials of wavelength up to the 15th degree have the curve's mean
STEP_NM = 1.0  # at most, of the bands in whose middles curve and light are multiplied


def filter_channels(path: str | os.PathLike[str], light: str = "equal") -> tuple[Channel, ...]:
    """Return a channel for every curve of a CSV file in this light.

    Its first line names the channels behind a first column of wavelengths in nm, which increase down the file; the
    others hold responses to unit power, on any scale, between which they are linear. ``light``: a spectrum as
    `p2sf.colour.spectrum.spectrum_of` has it, such as "d65". Raises RequestError.
    """
    names, rows = _table(Path(path))
    first, last = rows[[0, -1], 0]
    count = ceil((last - first) / STEP_NM)
    nm = first + (np.arange(count) + 0.5) * (last - first) / count
    power = relative_power(spectrum_of(light), nm / NM_PER_UM)
    return tuple(
        _channel(name, nm, power * np.interp(nm, rows[:, 0], response), path)
        for name, response in zip(names, rows[:, 1:].T, strict=True)
    )


def _channel(name: str, nm: np.ndarray, response: np.ndarray, path: str | os.PathLike[str]) -> Channel:
    seen = response > 0
    if not seen.any():
        raise RequestError("{path}: the curve of {name} has no light; correct it", path=str(path), name=name)
    whole = Channel(name, tuple(nm[seen].tolist()), tuple(response[seen].tolist()))
    few = reduce_spectrum(whole, NODES)
    return Channel(name, tuple(NM_PER_UM * wave for wave in few.wavelengths_um), few.weights)


def _table(path: Path) -> tuple[list[str], np.ndarray]:
    """Return the names of the channels, and rows of wavelength and responses; RequestError."""
    try:
        head, *body = [row for row in csv.reader(read_text(path).splitlines()) if row]
        rows = np.array([[float(cell) for cell in row] for row in body])
    except OSError as error:
        raise RequestError(
            "{path} cannot be read, {reason}; give the path of a CSV file", path=str(path), reason=reason(error)
        ) from error
    except (ValueError, csv.Error) as error:
        raise RequestError(
            "{path} is not a table of numbers ({reason}); give nm and a column for each channel, names in the first "
            "line",
            path=str(path),
            reason=str(error),
        ) from error
    names = [name.strip() for name in head[1:]]
    usable = rows.ndim == 2 and rows.shape[1] == len(head) > 1 and len(rows) > 1 and np.isfinite(rows).all()
    inside = usable and NM[0] <= rows[0, 0] and rows[-1, 0] <= NM[1]
    if not inside or (np.diff(rows[:, 0]) <= 0).any() or (rows[:, 1:] < 0).any():
        raise RequestError(
            "{path}: give wavelengths that increase, from {low:g} to {high:g} nm, and behind each a response of 0 or "
            "more for every channel",
            path=str(path),
            low=NM[0],
            high=NM[1],
        )
    return names, rows
