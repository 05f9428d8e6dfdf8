"""PSF stacks, in a folder or at a URL: a Zarr v3 group with its axes and the database it was rendered from."""

import json
import os
import shutil
import warnings
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal

import numpy as np

from p2sf.conventions import NM_PER_UM, centred_axis, degrees_from_slope
from p2sf.database.files.npz import database_from_bytes
from p2sf.database.files.place import Place, chunk_names, exists, place_of, send, translate_errors
from p2sf.database.files.provenance import Stored
from p2sf.database.render import Sampling, critical_pixel_um, grid_of
from p2sf.errors import DatabaseError
from p2sf.figures.pixel_light import FineGrid
from p2sf.files.writing import plain
from p2sf.named_arrays import unit_of

SCHEMA = 1
CHUNK_BYTES = 1 << 20  # a chunk is lost if a writer is killed, and is the least that a reader loads
AXES = ("depth_mm", "field_deg", "wavelength_nm", "y_um", "x_um")
RECTANGLE_AXES = ("depth_mm", "field_y_deg", "field_x_deg", *AXES[2:])
TEMPORARY = ".part"

Chunk = tuple[int, ...]
"""The indices of a chunk along depth, field (or field y, then field x) and wavelength."""


@dataclass(frozen=True, eq=False)
class Stack:
    """An open PSF stack: ``psf`` (depth, field, wavelength, y, x) is indexed like an array and loads only what is read.

    Over a rectangle of fields, field y and field x replace field, as in `Space.nodes`.
    ``complete``: whether every chunk exists; a missing one reads as NaN. ``raw``: the file of its database.
    ``integrated``: whether a sample is the light of a whole pixel and not the intensity at its place.
    """

    path: Place
    psf: Any  # a zarr.Array
    raw: bytes
    stored: Stored
    pixel_um: float
    integrated: bool

    @property
    def chunks(self) -> list[Chunk]:
        """Return the indices of all chunks."""
        counts = (-(-n // c) for n, c in zip(self.psf.shape[:-2], self.psf.chunks[:-2], strict=True))
        return list(product(*map(range, counts)))

    @property
    def missing(self) -> list[Chunk]:
        """Return the chunks not written yet; each is written atomically."""
        if isinstance(self.path, str):
            written = chunk_names(self.path)
            return [chunk for chunk in self.chunks if _name(chunk) not in written]
        folder = self.path / "psf" / "c"
        return [chunk for chunk in self.chunks if not (folder / _name(chunk)).exists()]

    @property
    def complete(self) -> bool:
        """Return whether every PSF exists."""
        return not self.missing

    @property
    def sampling(self) -> Sampling:
        """Return the samples of each PSF."""
        return Sampling(self.psf.shape[-1], self.pixel_um)

    @cached_property
    def grid(self) -> FineGrid | None:
        """Return the samples that the light on its pixels takes; None for points."""
        return grid_of(self.stored.database, self.sampling) if self.integrated else None

    def region(self, chunk: Chunk) -> tuple[slice, ...]:
        """Return the part of the array that a chunk covers."""
        return tuple(
            slice(k * c, min((k + 1) * c, n))
            for k, c, n in zip(chunk, self.psf.chunks[:-2], self.psf.shape[:-2], strict=True)
        )


def _name(chunk: Chunk) -> str:
    """Return the name of a chunk of the PSFs, whose last two axes are not divided."""
    return "/".join(map(str, (*chunk, 0, 0)))


def import_optional(name: str) -> Any:
    """Return the module of an optional library; if it is missing, DatabaseError states how to install it."""
    from importlib import import_module

    try:
        return import_module(name)
    except ImportError as error:
        raise DatabaseError(
            "PSF stacks need {library}, which is not installed; pip install 'p2sf[dask]'", library=error.name or name
        ) from error


def create(path: str | PathLike[str], raw: bytes, sampling: Sampling) -> None:
    """Create an empty stack for the nodes of a database, given as the bytes of its file; OSError leaves nothing."""
    target, stored = place_of(path), database_from_bytes(raw, path)
    if isinstance(target, str):
        with TemporaryDirectory() as folder:
            _create_arrays(Path(folder), stored, raw, sampling)
            return send(Path(folder), target)
    draft = target.with_name(f".{target.name}{TEMPORARY}")
    shutil.rmtree(draft, ignore_errors=True)
    try:
        _create_arrays(draft, stored, raw, sampling)
        os.replace(draft, target)
    except OSError:
        shutil.rmtree(draft, ignore_errors=True)
        raise


def _create_arrays(draft: Path, stored: Stored, raw: bytes, sampling: Sampling) -> None:
    zarr, shape, pixels = import_optional("zarr"), stored.database.space.shape, sampling.pixels
    names = AXES if len(shape) == 3 else RECTANGLE_AXES
    pixel_um = sampling.pixel_um or critical_pixel_um(stored.database)
    integrated = grid_of(stored.database, sampling) is not None
    attributes = {**_attributes(stored, pixel_um), "integrated": integrated}
    group = zarr.create_group(draft, zarr_format=3, attributes=attributes)
    group.create_array(
        "psf",
        shape=(*shape, pixels, pixels),
        chunks=(*chunk_shape(shape, pixels), pixels, pixels),
        dtype="float32",
        fill_value=np.nan,
        compressors=[zarr.codecs.ZstdCodec(level=1), zarr.codecs.Crc32cCodec()],
        dimension_names=names,
        attributes={"long_name": "share of the window's light", "units": "1"},
    )
    for name, values in zip(names, _axes(stored, pixels, pixel_um), strict=True):
        group.create_array(name, data=values, dimension_names=(name,), attributes=unit_of(name))
    group.create_array("database", data=np.frombuffer(raw, dtype=np.uint8), dimension_names=("byte",))
    with warnings.catch_warnings():  # xarray looks for it first, although the standard does not have it yet
        warnings.simplefilter("ignore")
        zarr.consolidate_metadata(draft)


def _attributes(stored: Stored, pixel_um: float) -> dict[str, Any]:
    known = {
        key: stored.meta[key] for key in ("method", "interpolant", "aim", "lens", "glasses", "conventions", "versions")
    }
    known["predicted_error"] = plain(stored.accuracy.record)
    units = {"psf": "fraction of the window's light per sample", "depth_mm": "mm, from the first vertex"}
    return {"p2sf_stack_schema": SCHEMA, "pixel_um": pixel_um, "units": units, **known}


def _axes(stored: Stored, pixels: int, pixel_um: float) -> tuple[np.ndarray, ...]:
    (depths, *slopes, waves), across = stored.database.space.nodes, centred_axis(pixels, pixel_um)
    return depths, *map(degrees_from_slope, slopes), waves * NM_PER_UM, across, across


def chunk_shape(shape: tuple[int, ...], pixels: int) -> tuple[int, ...]:
    """Return how many depths, fields and wavelengths make a chunk of about a mebibyte.

    One depth, and fields before wavelengths, since they share kernels.
    """
    room, chunk = max(1, CHUNK_BYTES // (4 * pixels * pixels)), [1]
    for count in shape[1:]:
        chunk.append(min(count, max(1, room)))
        room //= chunk[-1]
    return tuple(chunk)


def open_stack(path: str | PathLike[str], mode: Literal["r", "r+"] = "r") -> Stack:
    """Return a stack on disk; DatabaseError for a foreign, damaged or newer one, or one that is not there."""
    zarr = import_optional("zarr")
    place = place_of(path)
    if not exists(place):
        raise DatabaseError(
            "{path} is not there; build it with {command}", path=str(path), command="p2sf database build --stack"
        )
    try:
        with translate_errors(place):
            group = zarr.open_group(place, mode=mode, zarr_format=3, use_consolidated=False)
            psf, raw, attributes = group["psf"], group["database"][:].tobytes(), dict(group.attrs)
        if attributes["p2sf_stack_schema"] > SCHEMA:
            raise DatabaseError(
                "{path} has stack schema {schema}, newer than {newest}; update P2SF",
                path=str(path),
                schema=attributes["p2sf_stack_schema"],
                newest=SCHEMA,
            )
        stored = database_from_bytes(raw, path)
        integrated = bool(attributes.get("integrated", False))
        stack = Stack(place, psf, raw, stored, float(attributes["pixel_um"]), integrated)
        if psf.shape[:-2] != stored.database.space.shape or psf.dtype != np.float32 or psf.shape[-2] != psf.shape[-1]:
            raise DatabaseError("{path} is damaged, its PSFs do not fit its database; build it again", path=str(path))
    except DatabaseError:
        raise
    except (KeyError, TypeError, ValueError, OSError, RuntimeError, AttributeError, json.JSONDecodeError) as error:
        raise DatabaseError(
            "{path} is not a P2SF stack, or its header is damaged ({reason}); build it again",
            path=str(path),
            reason=type(error).__name__,
        ) from error
    return stack


def read_psfs(stack: Stack, where: Any) -> np.ndarray:
    """Return stored PSFs at an index or slice of (depth, field, wavelength).

    Raises DatabaseError for a chunk whose checksum is wrong, and for PSFs not written yet.
    """
    try:
        with translate_errors(stack.path):
            values: np.ndarray = stack.psf[where]
    except DatabaseError:
        raise
    except (RuntimeError, ValueError, OSError) as error:
        raise DatabaseError(
            "{path} has a damaged chunk; delete it and build the stack again, it resumes", path=str(stack.path)
        ) from error
    if np.isnan(values).any():
        raise DatabaseError(
            "{path} is not complete; build it again with the same command, it resumes", path=str(stack.path)
        )
    return values
