"""Databases and PSF stacks as files."""

from p2sf.databasefile.npz import load_database, save_database
from p2sf.databasefile.provenance import Stored, provenance

__all__ = ["Stored", "load_database", "provenance", "save_database"]
