"""Lens files: one function reads whatever this version knows."""

import os
from collections.abc import Iterable

from p2sf.lens.lens import Lens
from p2sf.lensfile.storage import read_text
from p2sf.lensfile.toml import parse_toml


def load_lens(path: str | os.PathLike, accept_substitutes: bool = False, catalogues: Iterable = ()) -> Lens:
    """Return the lens of a file of any known format, told by its content; LensFileError says where and why not.

    ``catalogues`` are paths of AGF glass catalogues. `p2sf.lensfile.importing.import_lens` gives the
    report on the reading as well.
    """
    if str(path).lower().endswith(".toml"):
        return parse_toml(read_text(path), path)
    from p2sf.lensfile.importing import import_lens  # the readers of other programs' files load on first use

    return import_lens(path, accept_substitutes, catalogues).lens
