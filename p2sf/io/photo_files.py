"""Readers and writers of pictures; everywhere else a picture is linear light in float32."""

import io
import json
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import reduce
from pathlib import Path
from tempfile import TemporaryDirectory
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from p2sf.arguments import first_place
from p2sf.errors import ExportError, RequestError
from p2sf.files.atomic import DAMAGED
from p2sf.files.picture_parts import open_picture
from p2sf.files.reading import check_samples, first_page, open_file, size_of
from p2sf.files.reasons import OversizedError, reason
from p2sf.files.writing import write_beside
from p2sf.io.png16 import deep_colours, read_deep, write_deep
from p2sf.io.png_text import with_text
from p2sf.io.transfer import check_encoding, linear_from_srgb, srgb_from_linear
from p2sf.messages import Alternatives, Message

if TYPE_CHECKING:
    from PIL.Image import Image

EXR = ".exr"
WRITABLE = (".png", ".tif", ".tiff", EXR)
ROWS = 64  # of a picture at once
HEAD = 32  # bytes that tell the kinds apart
EXR_MARK = b"v/1\x01"  # first of any OpenEXR file
DEPTH_CHANNELS = "Y", "Z"  # of grey pictures and of depths, the names that renderers use
HEIF = (".heic", ".heif")
READABLE = (*WRITABLE, ".jpg", ".jpeg", *HEIF)
DEPTHS = ("8", "16", "half", "float")
ORIENTATION, SIDEWAYS = 274, (5, 6, 7, 8)  # the tag of Exif, and its values for a picture lying on its side


@dataclass(frozen=True, eq=False)
class Photo:
    """A picture in linear light, (rows, columns, channels) float32, white at 1; row 0 is the top.

    ``encoding``: what its file's numbers meant, one of `transfer.ENCODINGS`; ``depth``: their bits, one of DEPTHS.
    ``transparent``: the share of its pixels that were not opaque.
    """

    values: np.ndarray
    encoding: str
    depth: str
    transparent: float = 0.0

    @property
    def caution(self) -> Message | None:
        """Return that transparency is left out; None where all of the picture is opaque."""
        if not self.transparent:
            return None
        return Message(
            "{share:.3g} % of the picture is transparent, which is left out: its colours count as opaque; put it on a "
            "background first if that is not meant",
            share=100 * self.transparent,
        )


def read_photo(path: str | os.PathLike[str], encoding: str | None = None) -> Photo:
    """Return the picture of a PNG, TIFF, OpenEXR, JPEG or HEIF file, without transparency, upright by its Exif data.

    ``encoding``: what the file's numbers mean, "srgb" or "linear"; by default whole numbers are sRGB and floats
    linear, in which light above white is kept. HEIF needs pillow-heif, OpenEXR its own library. Raises RequestError for
    a file of another kind, or without 1 or 3 channels.
    """
    return photo_of(read_samples(Path(path)), path, encoding)


def photo_of(raw: np.ndarray, path: str | os.PathLike[str], encoding: str | None = None) -> Photo:
    """Return the picture that the samples of a file are, see `read_photo`."""
    depth = {"u1": "8", "u2": "16"}.get(raw.dtype.str[1:], "float")
    encoding = encoding or ("linear" if depth == "float" else "srgb")
    check_encoding(encoding)
    values, alpha = _channels(raw, path)
    white = 1 if depth == "float" else int(np.iinfo(raw.dtype).max)
    transparent = float((alpha < white).mean()) if alpha.size else 0.0
    if depth == "float":
        known = np.isfinite(values)
        if not known.all():
            raise RequestError(
                "{path} holds values that are not finite, {count} of them, the first at row {row}, column {column} "
                "(from 0); replace them first",
                path=str(path),
                **first_place(~known),
            )
        linear = by_rows(linear_from_srgb, values) if encoding == "srgb" else values.astype(np.float32, copy=False)
        return Photo(linear, encoding, depth, transparent)
    codes = np.arange(white + 1, dtype=np.float32) / np.float32(white)
    light = linear_from_srgb(codes) if encoding == "srgb" else codes
    return Photo(by_rows(light.__getitem__, values), encoding, depth, transparent)


def by_rows(change: Callable[[np.ndarray], np.ndarray], values: np.ndarray) -> np.ndarray:
    """Return ``change(values)`` in float32, made of a few rows at a time, so that what it needs meanwhile is small."""
    found = np.empty(values.shape, np.float32)
    for start in range(0, len(values), ROWS):
        found[start : start + ROWS] = change(values[start : start + ROWS])
    return found


def write_photo(
    path: str | os.PathLike[str],
    values: np.ndarray,
    encoding: str = "srgb",
    depth: str | None = None,
    texts: Mapping[str, str] | None = None,
) -> Path:
    """Write linear light (rows, columns[, channels]) as .png (8, 16 bits), .tif (any depth) or .exr (half or float).

    ``depth``: bits of whole numbers, or "half" and "float" for floats of 16 and 32 bits; 8 by default, float for a
    linear TIFF and for OpenEXR, which is always linear. Values beyond 0…1 are clipped in whole numbers.
    ``texts``, by names of letters and "-", are stored in the file: as text chunks of a PNG, as attributes of an
    OpenEXR, and as JSON in the description of a TIFF. Raises ExportError and RequestError.
    """
    check_encoding(encoding)
    ending = check_ending(path)
    encoding, depth = stored_as(path, encoding), depth or ("float" if keeps_light(path, encoding) else "8")
    floats = depth in ("half", "float")
    if depth not in DEPTHS or (floats and ending == ".png") or (ending == EXR and not floats):
        raise RequestError(
            "a {ending} of depth {depth} cannot be written; choose {choices}",
            ending=ending,
            depth=depth,
            choices=Alternatives({".png": DEPTHS[:2], EXR: DEPTHS[2:]}.get(ending, DEPTHS)),
        )
    values = np.squeeze(np.asarray(values, np.float32))
    values = srgb_from_linear(values) if encoding == "srgb" else values
    stored = values.astype(np.float16 if depth == "half" else np.float32) if floats else _whole(values, int(depth))
    if ending == EXR:
        return write_beside(path, lambda handle: handle.write(_exr(path, stored, texts or {})))
    return write_beside(path, lambda handle: handle.write(_encode(stored, ending, texts or {})))


def stored_as(path: str | os.PathLike[str], encoding: str) -> str:
    """Return what the numbers of a written file mean: OpenEXR is linear, others are as asked."""
    return "linear" if Path(path).suffix.lower() == EXR else encoding


def keeps_light(path: str | os.PathLike[str], encoding: str) -> bool:
    """Return whether a file holds floats by default, so that light above white is kept."""
    return Path(path).suffix.lower() != ".png" and stored_as(path, encoding) == "linear"


def kept_depth(path: str | os.PathLike[str], photo: Photo) -> str:
    """Return the depth at which a file holds what was made of a photo: light above white, or its bits."""
    if keeps_light(path, photo.encoding):
        return "float"
    return "16" if Path(path).suffix.lower() == ".png" and photo.depth != "8" else photo.depth


def check_ending(path: str | os.PathLike[str]) -> str:
    """Return the ending of a picture file; ExportError for others, RequestError where its library is missing."""
    ending = Path(path).suffix.lower()
    if ending not in WRITABLE:
        raise ExportError(
            '{path} has the ending "{ending}", which is not a picture format here; choose {choices}',
            path=str(path),
            ending=ending,
            choices=WRITABLE,
        )
    if ending == EXR:
        exr_library(path)
    return ending


def _whole(values: np.ndarray, bits: int) -> np.ndarray:
    top = 2**bits - 1
    whole: np.ndarray = np.rint(np.clip(values, 0, 1) * top)
    return whole.astype(np.uint8 if bits == 8 else np.uint16)


def _encode(stored: np.ndarray, ending: str, texts: Mapping[str, str]) -> bytes:
    if ending == ".png":
        return reduce(lambda png, item: with_text(png, *item), texts.items(), _png(stored))
    import tifffile

    buffer, photometric = io.BytesIO(), "rgb" if stored.ndim == 3 else "minisblack"
    about: dict[str, Any] = {"description": json.dumps(dict(texts)), "metadata": None} if texts else {}
    tifffile.imwrite(buffer, stored, photometric=photometric, **about)
    return buffer.getvalue()


def _png(stored: np.ndarray) -> bytes:
    if stored.dtype == np.uint16:
        return write_deep(stored)
    from PIL import Image

    buffer = io.BytesIO()
    Image.fromarray(stored).save(buffer, format="PNG")
    return buffer.getvalue()


def photo_shape(path: str | os.PathLike[str]) -> tuple[int, int]:
    """Return the rows and columns of a picture as `read_photo` returns it, from the head of its file; RequestError."""
    from PIL import Image, UnidentifiedImageError

    if Path(path).suffix.lower() in HEIF:
        _let_pillow_open_heif(path)
    try:
        with open_file(path) as stream, Image.open(stream) as picture:
            turned = picture.getexif().get(ORIENTATION, 1) in SIDEWAYS and picture.format != "TIFF"
            columns, rows = picture.size[::-1] if turned else picture.size
            return rows, columns
    except (UnidentifiedImageError, Image.DecompressionBombError, OSError, ValueError, *DAMAGED):
        # Pillow does not know every TIFF; what is wrong with another file is said where it is read.
        return read_photo(path).values.shape[:2]


def turned_as(photo: str | os.PathLike[str], values: np.ndarray) -> np.ndarray:
    """Return a map of a photo, (rows, columns), turned as the photo is where it lies on its side and the photo not.

    Its proportions tell: programs store maps like the photo's own pixels, or upright. One that is square stays.
    Raises RequestError where there is no photo.
    """
    rows, columns = photo_shape(photo)
    tall, wide = values.shape
    if (rows < columns) == (tall < wide) or rows == columns or tall == wide:
        return values
    found = _orientation(photo)
    return TURNS[found](values) if found in SIDEWAYS else values


TURNS: dict[int, Callable[[np.ndarray], np.ndarray]] = {  # rows and columns, by the tag of Exif
    2: lambda values: values[:, ::-1],
    3: lambda values: values[::-1, ::-1],
    4: lambda values: values[::-1],
    5: lambda values: values.swapaxes(0, 1),
    6: lambda values: np.rot90(values, -1),
    7: lambda values: values[::-1, ::-1].swapaxes(0, 1),
    8: np.rot90,
}


def _orientation(path: str | os.PathLike[str]) -> int:
    """Return how a picture's pixels are to be turned, as Exif says it; 1 where they are upright."""
    from PIL import Image

    with Image.open(path) as picture:
        if picture.format == "TIFF":  # which is read as it is stored
            return 1
        found: int = picture.info.get("original_orientation") or picture.getexif().get(ORIENTATION, 1)
        return found


def read_samples(path: Path) -> np.ndarray:
    """Return the samples of a picture file as they are stored, upright; RequestError where it cannot be read."""
    try:
        with open_file(path) as stream:
            head, size = stream.read(HEAD), size_of(stream)
    except OSError as error:
        raise RequestError(
            "{path} cannot be read, {reason}; give the path of a PNG, TIFF, OpenEXR, JPEG or HEIF",
            path=str(path),
            reason=reason(error),
        ) from error
    if head[:4] in (b"II*\x00", b"MM\x00*", b"II+\x00", b"MM\x00+"):
        return _from_tiff(path)
    if head[:4] == EXR_MARK:
        return _from_exr(path, size)
    if head[4:8] == b"ftyp":
        _let_pillow_open_heif(path)
        return _by_pillow(path, head, "HEIF")
    return _by_pillow(path, head, "JPEG" if head[:3] == b"\xff\xd8\xff" else "PNG")


def pillow_heif(path: str | os.PathLike[str]) -> Any:
    """Return the library that reads HEIF; RequestError where it is not installed."""
    try:
        import pillow_heif
    except ImportError as error:
        raise RequestError(
            "{path}: HEIF photos need pillow-heif, which is not installed; pip install 'p2sf[heif]', or save a JPEG",
            path=str(path),
        ) from error
    return pillow_heif


def heif_depth_image(path: str | os.PathLike[str]) -> tuple[np.ndarray, dict[str, Any]] | None:
    """Return the samples of a HEIF file's first depth image and what is stated of them; None where it has none.

    Raises RequestError for what is no HEIF, or damaged.
    """
    library = pillow_heif(path)
    try:
        with open_file(path) as stream:
            images = library.open_heif(stream).info.get("depth_images", [])
        return (np.asarray(images[0]), images[0].info.get("metadata", {})) if images else None
    except (OSError, ValueError, *DAMAGED) as error:
        raise RequestError(
            "{path} is a HEIF that cannot be read ({why}); save it again", path=str(path), why=reason(error)
        ) from error


def _let_pillow_open_heif(path: str | os.PathLike[str]) -> None:
    """Let Pillow open HEIF; RequestError where pillow-heif is not installed."""
    pillow_heif(path).register_heif_opener()


def exr_library(path: str | os.PathLike[str]) -> ModuleType:
    """Return the library of OpenEXR; RequestError where it is not installed."""
    try:
        import OpenEXR
    except ImportError as error:
        raise RequestError(
            "{path}: OpenEXR files need its library, which is not installed; pip install 'p2sf[exr]', or use a TIFF of "
            "floats",
            path=str(path),
        ) from error
    library: ModuleType = OpenEXR
    return library


def _from_exr(path: Path, size: int) -> np.ndarray:
    """Return the colours of an OpenEXR file, or its grey values or depths, (rows, columns[, 3]) float16 or float32."""
    library = exr_library(path)
    try:
        with library.File(str(path), header_only=True) as head:
            first, last = (np.asarray(end, int) for end in head.header()["dataWindow"])
            count = len(head.header()["channels"])
        check_samples((*(last - first + 1)[::-1].tolist(), count), size, 4)
        with library.File(str(path), separate_channels=True) as file:
            planes = {name: channel.pixels for name, channel in file.channels().items()}
    except (OSError, RuntimeError, ValueError, *DAMAGED) as error:
        raise RequestError(
            "{path} is a damaged {kind} ({why}); save the picture again",
            path=str(path),
            kind="OpenEXR",
            why=reason(error),
        ) from error
    if all(name in planes for name in "RGB"):
        return np.stack([planes[name] for name in "RGBA" if name in planes], axis=-1)
    grey = [planes[name] for name in (*DEPTH_CHANNELS, *planes) if name in planes]
    if len(planes) != 1 and not any(name in planes for name in DEPTH_CHANNELS):
        raise RequestError(
            "{path} has the channels {channels}; give one with R, G and B, or with Y or Z alone",
            path=str(path),
            channels=tuple(planes),
        )
    return np.asarray(grey[0])


def _exr(path: str | os.PathLike[str], stored: np.ndarray, texts: Mapping[str, str]) -> bytes:
    """Return an OpenEXR file of (rows, columns[, 3]) float16 or float32, compressed without loss."""
    library = exr_library(path)
    header = {**texts, "compression": library.ZIP_COMPRESSION, "type": library.scanlineimage}
    channels = {"RGB" if stored.ndim == 3 else "Y": np.ascontiguousarray(stored)}
    try:
        with TemporaryDirectory() as folder:  # the library writes to paths only
            draft = Path(folder) / "picture.exr"
            with library.File(header, channels) as file:
                file.write(str(draft))
            return draft.read_bytes()
    except (OSError, RuntimeError) as error:
        raise ExportError(
            "{path} cannot be written, there is no room for it in the folder of temporary files ({reason}); free some "
            "space there, or name another folder in TMPDIR",
            path=str(path),
            reason=reason(error),
        ) from error


def _from_tiff(path: Path) -> np.ndarray:
    try:
        return np.asarray(first_page(path)[0])
    except (OSError, ValueError, *DAMAGED) as error:
        raise RequestError(
            "{path} is a TIFF that cannot be read ({why}); save it again, uncompressed",
            path=str(path),
            why=reason(error),
        ) from error


def _by_pillow(path: Path, head: bytes, kind: str) -> np.ndarray:
    """Return the samples of a PNG, JPEG or HEIF, of 8 or 16 bits, turned upright."""
    from PIL import UnidentifiedImageError

    deep = deep_colours(head)
    try:
        with open_picture(path, (kind,)) as picture:
            check_samples((picture.height, picture.width, len(picture.getbands())), os.path.getsize(path))
            values = _samples(picture) if deep is None else read_deep(picture, deep)
            turn = TURNS.get(picture.getexif().get(ORIENTATION, 1))  # last, since it may stand behind the picture
        return turn(values) if turn else values
    except UnidentifiedImageError as error:
        raise RequestError(
            "{path} is not a PNG, TIFF, OpenEXR, JPEG or HEIF that can be read; convert it to one", path=str(path)
        ) from error
    except OversizedError as error:
        raise RequestError(
            "{path} is too large a {kind} ({why}); save it smaller", path=str(path), kind=kind, why=reason(error)
        ) from error
    except (OSError, ValueError, *DAMAGED) as error:
        raise RequestError(
            "{path} is a damaged {kind} ({why}); save the picture again",
            path=str(path),
            kind=kind,
            why=reason(error),
        ) from error


def _samples(picture: "Image") -> np.ndarray:
    """Return the samples of an open picture: grey or colours, with alpha where it has transparency, or 16 bits."""
    if picture.mode.startswith("I"):  # "I" before Pillow 10.3, "I;16" since
        return np.asarray(picture).astype(np.uint16, copy=False)
    mode = ("L" if picture.mode in ("1", "L", "LA") else "RGB") + "A" * picture.has_transparency_data
    return np.asarray(picture if picture.mode == mode else picture.convert(mode))


def _channels(raw: np.ndarray, path: str | os.PathLike[str]) -> tuple[np.ndarray, np.ndarray]:
    """Return (rows, columns, 1 or 3), the channels of planar files moved last, and the alpha, (…, 0 or 1)."""
    if raw.dtype.kind not in "uf" or (raw.dtype.kind == "u" and raw.dtype.itemsize > 2):
        raise RequestError(
            "{path} holds {kind} samples; save it with 8 or 16 bits or as float", path=str(path), kind=str(raw.dtype)
        )
    if raw.ndim == 3 and raw.shape[0] in (3, 4) and raw.shape[2] not in (1, 2, 3, 4):
        raw = np.moveaxis(raw, 0, -1)
    raw = raw[..., None] if raw.ndim == 2 else raw
    if raw.ndim != 3 or raw.shape[2] not in (1, 2, 3, 4) or not raw.size:
        raise RequestError(
            "{path} has the shape ({shape}); give one picture of 1 or 3 channels", path=str(path), shape=raw.shape
        )
    colours = 1 if raw.shape[2] < 3 else 3
    return raw[..., :colours], raw[..., colours:]
