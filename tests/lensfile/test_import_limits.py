"""Limits of an import: files that are too large, archives that unpack to too much, endless lines and lists."""

import zipfile

import pytest

from p2sf.errors import LensFileError
from p2sf.lensfile.library import load_lens
from tests.support.lenses.lens_files import read, text_of

DOUBLET = "doublet.zmx"
HUGE = {
    "a file over 4 MB": (b"SURF 0\n" * 600_000, "over 4 MB"),
    "a million lines": (b"1\n" * 300_000, "over 100000 lines"),
    "an endless line": (b"S " + b"1" * 400_000, "line 1: the line has over 300000 characters"),
    "lists without end": (b'{"surfaces":' + b"[" * 100_000, "nested too deep"),
}


@pytest.mark.parametrize("case", HUGE)
def test_what_is_no_lens_is_refused_before_it_costs_anything(case, tmp_path):
    content, said = HUGE[case]
    (tmp_path / "huge.json").write_bytes(content)
    with pytest.raises(LensFileError, match=said):
        load_lens(tmp_path / "huge.json")


def test_an_archive_that_unpacks_to_too_much_is_refused(tmp_path):
    with zipfile.ZipFile(tmp_path / "bomb.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("bomb.zmx", b"\0" * 9_000_000)
    with pytest.raises(LensFileError, match="over 4 MB"):
        load_lens(tmp_path / "bomb.zip")


def test_a_thousand_surfaces_are_read_and_one_more_refused():
    def rows(count):
        return (
            "SURF 0\n  DISZ INFINITY\n"
            + "".join(f"SURF {n}\n  DISZ 1\n  DIAM 5\n" for n in range(1, count + 1))
            + f"SURF {count + 1}\n"
        )

    everything = (text_of(DOUBLET), rows(1000))
    assert len(read(DOUBLET, everything).lens.surfaces) == 1000
    with pytest.raises(LensFileError, match="line 3003: the file holds 1001 surfaces; at most 1000 are read"):
        read(DOUBLET, (text_of(DOUBLET), rows(1001)))
