"""Small lens files written for the import tests, and how to read changed copies of them."""

from pathlib import Path

import pytest

from p2sf.errors import LensFileError
from p2sf.lensfile.glass_lookup import GlassSources
from p2sf.lensfile.importing import Import, import_lens, import_text
from p2sf.lensfile.source_text import LensText

FOLDER = Path(__file__).parents[2] / "data" / "import"
FILES = tuple(sorted(path.name for path in FOLDER.iterdir() if path.suffix != ".agf"))


def text_of(name: str) -> str:
    return (FOLDER / name).read_text(encoding="utf-8")


def read(name: str, *changes: tuple[str, str], accept: bool = False, catalogues=()) -> Import:
    """Return a test file read after replacements, each of which must find its text once or more."""
    text = text_of(name)
    for old, new in changes:
        assert old in text, f"{old!r} is not in {name}"
        text = text.replace(old, new)
    return import_text(LensText(name, "utf-8", text), GlassSources(tuple(catalogues), {}, accept))


def refused_at(name: str, change: tuple[str, str], said: str) -> None:
    """Check that a file with this change is refused in these words, with its name and a line."""
    with pytest.raises(LensFileError, match=said) as caught:
        read(name, change)
    assert caught.value.path == name and caught.value.line


def read_file(path, **options) -> Import:
    return import_lens(path, **options)
