"""The shipped lenses by name, from a checkout and from an installed wheel alike."""

import os
from difflib import get_close_matches
from pathlib import Path

from p2sf.errors import LensFileError
from p2sf.lens.lens import Lens
from p2sf.lensfile import load_lens

SUFFIX = ".toml"


def lenses_folder(package: Path = Path(__file__).parents[1]) -> Path:
    """Return the folder of shipped lenses: inside an installed package, beside it in a checkout. LensFileError."""
    for folder in (package / "lenses", package.parent / "lenses"):
        if any(folder.glob(f"*{SUFFIX}")):
            return folder
    raise LensFileError("the shipped lenses are missing; install p2sf again", str(package / "lenses"))


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
    close = get_close_matches(text.lower(), shipped_lenses(), 3, 0.5)
    hint = f"did you mean {' or '.join(close)}?" if close else f"shipped are {', '.join(shipped_lenses())}"
    raise LensFileError(f'lens "{text}" is neither shipped nor a file; {hint}')


def _exists(text: str) -> bool:
    """Return whether a file of this name is there; a name no file can have is not."""
    try:
        return bool(text) and Path(text).exists()
    except (OSError, ValueError):
        return False
