"""Lenses by the path of any lens file, and the shipped ones by name, from a checkout or an installed wheel."""

import os
from collections.abc import Iterable
from pathlib import Path

from p2sf.errors import LensFileError
from p2sf.lens.lens import Lens
from p2sf.lensfile.toml.lens import read_toml
from p2sf.messages import Alternatives

SUFFIX = ".toml"


def load_lens(
    path: str | os.PathLike, accept_substitutes: bool = False, catalogues: Iterable[str | os.PathLike] = ()
) -> Lens:
    """Return the lens of a file of any known format, recognised by its content; LensFileError says where and why not.

    ``catalogues`` are paths of AGF glass catalogues. `p2sf.lensfile.importing.import_lens` gives the
    report on the reading as well.
    """
    if str(path).lower().endswith(SUFFIX):
        return read_toml(path)
    from p2sf.lensfile.importing import import_lens  # the readers of other programs' files load on first use

    return import_lens(path, accept_substitutes, catalogues).lens


def lenses_folder(package: Path = Path(__file__).parents[1]) -> Path:
    """Return the folder of shipped lenses: inside an installed package, beside it in a checkout. LensFileError."""
    for folder in (package / "lenses", package.parent / "lenses"):
        if any(folder.glob(f"*{SUFFIX}")):
            return folder
    raise LensFileError("the shipped lenses are missing; install p2sf again", package / "lenses")


def shipped_lenses() -> tuple[str, ...]:
    """Return the names of the shipped lenses, sorted."""
    return tuple(sorted(path.stem for path in lenses_folder().glob(f"*{SUFFIX}")))


def find_lens(name_or_path: str | os.PathLike) -> Lens:
    """Return a shipped lens by its name or any lens file by its path; LensFileError ("did you mean")."""
    text = os.fspath(name_or_path)
    if text in shipped_lenses():
        return load_lens(lenses_folder() / f"{text}{SUFFIX}")
    if text.endswith(SUFFIX) or "/" in text or os.sep in text or _exists(text):
        return load_lens(text)
    from difflib import get_close_matches

    close = get_close_matches(text.lower(), shipped_lenses(), 3, 0.5)
    if close:
        raise LensFileError(
            'lens "{name}" is neither shipped nor a file; did you mean {lenses}?', name=text, lenses=Alternatives(close)
        )
    raise LensFileError(
        'lens "{name}" is neither shipped nor a file; shipped are {lenses}', name=text, lenses=shipped_lenses()
    )


def _exists(text: str) -> bool:
    """Return whether a file of this name exists; False for a name that no file can have."""
    try:
        return bool(text) and Path(text).exists()
    except (OSError, ValueError):
        return False
