"""Frames of counts from files: PNG, TIFF, JPEG, FITS, npy, npz, and OpticStudio's listings of PSFs."""

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from p2sf.conventions import UM_PER_MM
from p2sf.errors import ExportError, RequestError
from p2sf.files.atomic import DAMAGED
from p2sf.files.reading import check_samples, read_array, read_arrays
from p2sf.files.reasons import ContentRefusedError, OversizedError, reason
from p2sf.io.fits import FITS, first_picture
from p2sf.io.photo_files import READABLE, photo_of, read_samples
from p2sf.measure.frame import Frame, FrameGeometry, Noise, calibrate
from p2sf.measure.listings import read_listing
from p2sf.messages import Message
from p2sf.parameters import check_positive
from p2sf.psf.reading import read_psf

ENDINGS = (*READABLE, *FITS, ".npy", ".npz", ".txt")
CHANNELS = {"red": 0, "green": 1, "blue": 2}
FULL = {"8": 255.0, "16": 65535.0}
PSF_NOISE = 1e-3  # of the peak: what residuals of a computed PSF, which has no noise, are measured by


@dataclass(frozen=True, eq=False)
class Counts:
    """What a file holds: counts (rows, columns), row 0 the top, and what it says of them.

    ``pixel_um``: None where it does not say. ``full``: the largest count. ``psf``: intensity of one point, at points
    unless ``integrated`` over pixels; ``chief_mm``: where its chief ray lands; ``field_deg``: of its field.
    ``encoding``: as which whole numbers were read.
    """

    values: np.ndarray
    pixel_um: float | None = None
    full: float = np.inf
    psf: bool = False
    integrated: bool = True
    chief_mm: tuple[float, float] | None = None
    field_deg: float | None = None
    encoding: str = ""
    notes: tuple[Message, ...] = ()


def read_frame(
    path: str | os.PathLike[str],
    pixel_um: float | None = None,
    *,
    dark: str | os.PathLike[str] | None = None,
    flat: str | os.PathLike[str] | None = None,
    noise: Noise | None = None,
    channel: str = "green",
    encoding: str | None = None,
) -> Frame:
    """Return the frame of a picture, its dark field subtracted and divided by its flat field.

    ``pixel_um`` is needed where the file does not say it: listings and this program's own PSFs do. Whole numbers are
    counts, and saturate at their largest value unless ``noise`` says so; of a colour picture one ``channel`` is taken.
    ``encoding``: "srgb" or "linear"; 8 bits of a PNG or TIFF, JPEG and HEIF are sRGB when not given, and made linear.
    Raises RequestError for a file that cannot be read, and for fields of another size.
    """
    found = read_counts(path, channel, encoding)
    pitch = pixel_um or found.pixel_um
    if pitch is None:
        raise RequestError(
            "{path} does not state the size of its pixels; give {parameter}", path=str(path), parameter="pixel_um"
        )
    check_positive("pixel_um", pitch)
    saturated = found.values >= min(found.full, noise.full_scale if noise else np.inf)
    fields = [None if other is None else read_counts(other, channel, encoding).values for other in (dark, flat)]
    counts = calibrate(found.values, *fields)
    kept = noise or Noise()
    read_noise = kept.read_noise
    if found.psf and read_noise is None and counts.max() > 0:
        read_noise = PSF_NOISE * float(counts.max())
    rows, columns = counts.shape
    axis = None
    if found.psf:
        x, y = (mm * UM_PER_MM / pitch for mm in found.chief_mm or (0.0, 0.0))
        axis = (rows - 1) // 2 + y, columns // 2 - x
    geometry, known = FrameGeometry(rows, columns, pitch, axis), Noise(kept.gain, read_noise)
    about = {name: getattr(found, name) for name in ("psf", "integrated", "field_deg", "encoding", "notes")}
    return Frame(counts, geometry, known, saturated, **about)


def read_counts(path: str | os.PathLike[str], channel: str = "green", encoding: str | None = None) -> Counts:
    """Return what a file holds. Raises RequestError."""
    ending = Path(path).suffix.lower()
    if ending not in ENDINGS:
        raise RequestError(
            '{path}: the ending "{ending}" is not a picture format here; choose {choices}',
            path=str(path),
            ending=ending,
            choices=ENDINGS,
        )
    if ending == ".txt":
        listing = read_listing(path)
        if listing.kind != "psf":
            raise RequestError("{path} lists a wavefront, not a PSF; list the PSF of the same point", path=str(path))
        return Counts(listing.values[::-1], listing.pitch_um, psf=True, integrated=False, chief_mm=listing.chief_mm)
    own = _own_psf(path)
    if own is not None:
        return own
    if ending in (".npy", ".npz"):
        values, pitch = _arrays(path, ending)
        return Counts(_plane(values, path, channel), pitch)
    if ending in FITS:
        return Counts(_plane(_from_fits(path), path, channel))
    return _from_photo(path, channel, encoding)


def _own_psf(path: str | os.PathLike[str]) -> Counts | None:
    """Return the PSF in a file that this program wrote, None for other files."""
    try:
        psf, meta = read_psf(path)
        field = meta.get("setup", {}).get("field_deg")
    except (ExportError, AttributeError):
        return None
    field = float(field) if isinstance(field, int | float) else None
    return Counts(psf.values[::-1], psf.pixel_um, psf=True, integrated=psf.integrated, field_deg=field)


def _from_photo(path: str | os.PathLike[str], channel: str, encoding: str | None) -> Counts:
    """Return the counts of a PNG, TIFF, JPEG or HEIF file: its numbers, or the light they encode."""
    raw = read_samples(Path(path))
    _check_room(tuple(sorted(raw.shape)[-2:]), path)
    guessed = encoding is None and raw.dtype == np.uint8
    read_as = encoding or ("srgb" if guessed else "linear")
    photo = photo_of(raw, path, read_as)
    notes: tuple[Message, ...] = ()
    if guessed:
        notes = (
            Message(
                "{path}: numbers of 8 bits are taken for sRGB and made linear; if they are counts, {parameter} linear "
                "says so",
                path=str(path),
                parameter="encoding",
            ),
        )
    full = FULL.get(photo.depth, np.inf)
    scale = full if np.isfinite(full) else 1.0
    values = _plane(photo.values, path, channel)
    values *= scale
    return Counts(values, full=full, encoding=read_as if np.isfinite(full) else "", notes=notes)


def _arrays(path: str | os.PathLike[str], ending: str) -> tuple[np.ndarray, float | None]:
    """Return the picture in an array file, and its pixel in µm where it says it."""
    try:
        if ending == ".npy":
            return read_array(path), None
        found = read_arrays(path)
    except (OSError, ValueError, *DAMAGED) as error:
        raise _unreadable(path) from error
    planes = [values for name, values in found.items() if values.ndim >= 2]
    if not planes:
        raise _unreadable(path)
    pitch = found.get("pixel_um")
    return found.get("values", planes[0]), None if pitch is None or pitch.size != 1 else float(pitch)


def _from_fits(path: str | os.PathLike[str]) -> np.ndarray:
    """Return the first picture of a FITS file, whose rows go up."""
    try:
        return first_picture(path)[0][..., ::-1, :]
    except ExportError as error:  # astropy is not installed
        raise RequestError(error.message) from error
    except (OSError, ValueError, *DAMAGED) as error:
        raise _unreadable(path) from error


def _plane(values: np.ndarray, path: str | os.PathLike[str], channel: str) -> np.ndarray:
    """Return one plane of counts as float64. Raises RequestError."""
    if channel not in CHANNELS:
        raise RequestError(
            '{parameter} is "{value}"; choose {choices}', parameter="channel", value=channel, choices=(*CHANNELS,)
        )
    plane = np.squeeze(values)
    if plane.ndim == 3 and plane.shape[-1] in (3, 4):
        plane = plane[..., CHANNELS[channel]]
    if plane.ndim != 2 or min(plane.shape) < 2 or plane.dtype.kind not in "iuf":
        raise RequestError(
            "{path} holds an array of shape {shape}; give rows and columns of counts",
            path=str(path),
            shape=str(values.shape),
        )
    _check_room(plane.shape, path)
    return np.array(plane, float)  # no view of the file, which another program may write anew


def _check_room(shape: tuple[int, ...], path: str | os.PathLike[str]) -> None:
    """Raise RequestError where counts would take more room than a file of this size may ask for."""
    try:
        check_samples(shape, os.path.getsize(path), np.dtype(float).itemsize)
    except OversizedError as error:
        raise RequestError("{path} is too large: {reason}; cut it", path=str(path), reason=reason(error)) from error
    except ContentRefusedError as error:
        raise _unreadable(path) from error


def _unreadable(path: str | os.PathLike[str]) -> RequestError:
    return RequestError(
        "{path} cannot be read as a picture; it is damaged, or of another kind than its ending says", path=str(path)
    )
