"""Text listings of OpticStudio: PSFs and wavefront maps, as UTF-16 or UTF-8, whatever lines their heads have."""

import os
import re
from dataclasses import dataclass

import numpy as np

from p2sf.errors import RequestError
from p2sf.files.reading import read_bytes
from p2sf.files.reasons import reason

NUMBER = r"[-+]?\d++(?:\.\d*+)?(?:[Ee][-+]?\d++)?"  # which gives back no digit, so that a long one costs no time
UNITS_UM = {"µm": 1.0, "um": 1.0, "microns": 1.0, "μm": 1.0, "mm": 1000.0, "nm": 1e-3}


@dataclass(frozen=True, eq=False)
class Listing:
    """A table that OpticStudio listed, rows towards +y, and what its head says.

    ``kind``: "psf", relative intensity at points, or "wavefront", waves over a square about the pupil, 0 outside.
    ``pitch_um``: between samples of a PSF. ``centre``: row and column of the chief ray or the pupil's centre.
    ``chief_mm``: x and y on the sensor where the chief ray of a PSF lands. ``strehl``, ``peak_to_valley`` and
    ``rms_with_tilt``, waves, as listed; None where the head does not say so.
    """

    kind: str
    values: np.ndarray
    wavelength_um: float
    field: tuple[float, float]
    pitch_um: float | None
    centre: tuple[int, int]
    chief_mm: tuple[float, float] | None = None
    strehl: float | None = None
    peak_to_valley: float | None = None
    rms_with_tilt: float | None = None

    @property
    def inside(self) -> np.ndarray:
        """Return which cells of a wavefront lie in the pupil: blocked ones are listed as exactly 0."""
        clear: np.ndarray = np.not_equal(self.values, 0.0)
        return clear

    @property
    def statistics(self) -> tuple[float, float]:
        """Return peak-to-valley and RMS about the mean, tilt included, of a wavefront's cells in the pupil, waves."""
        waves = self.values[self.inside]
        return float(np.ptp(waves)), float(waves.std())


def read_listing(path: str | os.PathLike[str]) -> Listing:
    """Return the listing in a text file. Raises RequestError, with the file's name, for anything else."""
    try:
        data = read_bytes(path)
    except OSError as error:
        raise RequestError(
            "{path} cannot be read, {reason}; check the name", path=str(path), reason=reason(error)
        ) from error
    return listing_of(_decode(data), str(path))


def listing_of(text: str, path: str) -> Listing:
    """Return the listing in a text, from ``path``. Raises RequestError."""
    head, table = _split_table(text)
    kind = "wavefront" if "Wavefront" in head else "psf" if "PSF" in head else ""
    if not kind or table.size == 0:
        raise _damage_error(path)
    place = re.search(rf"(?<!\d)({NUMBER})\s*+([^\W\d]\w*+)\s++at\s++({NUMBER})\s*+,\s*+({NUMBER})", head)
    if place is None or place[2] not in UNITS_UM:
        raise _damage_error(path)
    wavelength = float(place[1]) * UNITS_UM[place[2]]
    rows, columns = table.shape
    size = re.search(rf"{'Pupil' if kind == 'wavefront' else 'Image'} grid size:\s*(\d+)\s*by\s*(\d+)", head)
    if size is not None and (int(size[2]), int(size[1])) != table.shape:
        raise RequestError(
            "{path} has a table of {rows} × {columns} values, and its head says {said}; list it again",
            path=path,
            rows=rows,
            columns=columns,
            said=f"{size[2]} × {size[1]}",
        )
    spacing = re.search(rf"Data spacing is\s+({NUMBER})\s*(\S+?)\.?\s*$", head, re.MULTILINE)
    pitch = float(spacing[1]) * UNITS_UM.get(spacing[2], 1.0) if spacing else None
    if (kind == "psf" and not pitch) or not np.isfinite(table).all() or wavelength <= 0:
        raise _damage_error(path)
    return Listing(
        kind,
        table[::-1],  # the first row of a listing is the highest
        wavelength,
        (float(place[3]), float(place[4])),
        pitch,
        (rows // 2, columns // 2),
        _chief(head),
        _number_before(head, r"Strehl ratio:\s*"),
        _number_before(head, r"Peak to valley =\s*"),
        _number_before(head, r"RMS =\s*"),
    )


def _decode(data: bytes) -> str:
    """Return a text in UTF-16 or UTF-8 by its byte-order mark, in UTF-8 or Latin-1 without one."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", errors="replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _split_table(text: str) -> tuple[str, np.ndarray]:
    """Return the head of a listing, and its table, (rows, columns); an empty one where rows differ in length."""
    head: list[str] = []
    rows: list[list[float]] = []
    for line in text.splitlines():
        words = line.replace(",", " ").split() if rows or not re.search("[A-Za-z:]{2}", line) else []
        numbers = [word for word in words if re.fullmatch(NUMBER, word)]
        if len(words) > 2 and len(numbers) == len(words):
            rows.append([float(word) for word in words])
        elif rows and line.strip():
            return "\n".join(head), np.empty((0, 0))
        else:
            head.append(line)
    same = len({len(row) for row in rows}) == 1
    return "\n".join(head), np.array(rows) if same else np.empty((0, 0))


def _number_before(head: str, before: str) -> float | None:
    found = re.search(rf"{before}({NUMBER})", head)
    return float(found[1]) if found else None


def _chief(head: str) -> tuple[float, float] | None:
    """Return where a head says that the middle of a PSF's grid lies on the sensor, mm."""
    found = re.search(rf"Center coordinates\s*:\s*({NUMBER}),\s*({NUMBER})\s*Millimeters", head)
    return (float(found[1]), float(found[2])) if found else None


def _damage_error(path: str) -> RequestError:
    return RequestError(
        "{path} is not a listing of a PSF or a wavefront map that can be read; write it as text from OpticStudio",
        path=path,
    )
