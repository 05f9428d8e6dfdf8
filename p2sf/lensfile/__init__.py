"""Lens files: one function reads whatever this version knows."""

import os

from p2sf.lens import Lens
from p2sf.lensfile.storage import read_text
from p2sf.lensfile.toml import parse_toml


def load_lens(path: str | os.PathLike) -> Lens:
    """Return the lens of a file; LensFileError says where and why it cannot be read."""
    return parse_toml(read_text(path), path)
