"""Lens files: the shipped lenses, TOML, and other programs' formats, read and written.

`importing.import_lens` gives the report on the reading of a file as well, `writing.write_lens` writes a lens in the
format of its ending, `agf.read_agf` reads a glass catalogue; these modules load on first use.
"""

from p2sf.lensfile.library import find_lens, lenses_folder, load_lens, shipped_lenses
from p2sf.lensfile.toml.lens import lens_to_toml, parse_toml, read_toml, write_toml

__all__ = [
    "find_lens",
    "lens_to_toml",
    "lenses_folder",
    "load_lens",
    "parse_toml",
    "read_toml",
    "shipped_lenses",
    "write_toml",
]
