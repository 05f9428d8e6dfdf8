"""Coefficient databases (npz) and PSF stacks (Zarr) on disk, with a record of how they were made."""

from p2sf.database.files.npz import (
    database_bytes,
    database_from_bytes,
    load_database,
    same_database,
    save_database,
)
from p2sf.database.files.provenance import Stored, provenance

__all__ = [
    "Stored",
    "database_bytes",
    "database_from_bytes",
    "load_database",
    "provenance",
    "same_database",
    "save_database",
]
