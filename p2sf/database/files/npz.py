"""Coefficient databases as files: a few kilobytes, from which PSFs are rendered without the lens."""

from os import PathLike
from pathlib import Path

import numpy as np

from p2sf.database.files.packing import MARK, Arrays, Meta, pack, stated_meta, unpack
from p2sf.database.files.provenance import Stored, provenance
from p2sf.database.files.sealed import read_sealed, seal, unseal, write_sealed
from p2sf.database.render import Database
from p2sf.lens.lens import Lens
from p2sf.paraxial.pupils import Stop


def save_database(database: Database, lens: Lens, path: str | PathLike[str], stop: Stop | None = None) -> Path:
    """Write a database and its provenance as .npz atomically; ExportError if that is impossible."""
    return write_sealed(path, pack(database, provenance(database, lens, stop)))


def database_bytes(database: Database, lens: Lens, stop: Stop | None = None) -> bytes:
    """Return the bytes that `save_database` writes."""
    return seal(pack(database, provenance(database, lens, stop)))


def load_database(path: str | PathLike[str]) -> Stored:
    """Return a database and its provenance.

    Raises DatabaseError for a file that is missing, foreign, cut short, damaged, or of a newer schema.
    """
    return Stored(*unpack(read_sealed(path, MARK), path))


def database_from_bytes(raw: bytes, name: str | PathLike[str]) -> Stored:
    """Return the database in the bytes of a file, which errors call ``name``; errors as `load_database`."""
    return Stored(*unpack(unseal(raw, MARK, name), name))


def same_database(one: bytes, other: bytes) -> bool:
    """Return whether two files contain the same database, regardless of the versions of the software."""
    (first, first_meta), (second, second_meta) = _content(one), _content(other)
    same = first.keys() == second.keys() and all(np.array_equal(first[key], second[key]) for key in first)
    return same and first_meta == second_meta


def _content(raw: bytes) -> tuple[Arrays, Meta]:
    arrays = unseal(raw, MARK, "the database")
    meta = stated_meta(arrays.pop(MARK))
    return arrays, {**meta, "versions": None, "predicted_error": None}
