"""Zemax's archives and zip archives: the lens in them, and the glass catalogues that lie with it."""

import random
import zipfile

import pytest

from p2sf.errors import LensFileError
from p2sf.lensfile.archives import decompress_lzw, unpack
from p2sf.lensfile.library import load_lens
from tests.support.lenses.lens_files import FOLDER, read_file, text_of

GLASS = "NM OWNGLASS 2 0 1.56261 50\nCD 1.4 0.01 0 0 0 0\nLD 0.35 2.0\n"


def lzw(data: bytes) -> bytes:
    """Return data as LZW codes, the first bit first: written from Welch's paper, for the tests alone."""
    words = {bytes([value]): value for value in range(256)}
    bits, here = "", b""
    for byte in data:
        longer = here + bytes([byte])
        if longer in words:
            here = longer
            continue
        # A reader knows each word one code later than the writer, hence one fewer.
        bits += format(words[here], f"0{max(9, (len(words) - 1).bit_length())}b")
        words[longer] = len(words)
        here = bytes([byte])
    if here:
        bits += format(words[here], f"0{max(9, (len(words) - 1).bit_length())}b")
    bits += "0" * (-len(bits) % 8)
    return bytes(int(bits[k : k + 8], 2) for k in range(0, len(bits), 8))


def record(name: str, data: bytes, later: bool) -> bytes:
    """Return a record of a .zar, of the later or the earlier version."""
    head = bytearray(0x288 if later else 0x14C)
    head[:2] = b"\xec\x03" if later else b"\xea\x00"
    written = name.encode("utf-16-le" if later else "utf-8")
    place, size = (0x30, slice(0x10, 0x18)) if later else (0x20, slice(0x0C, 0x10))
    head[place : place + len(written)] = written
    head[size] = len(data).to_bytes(size.stop - size.start, "little")
    return bytes(head) + data


def lens_text() -> str:
    return text_of("doublet.zmx").replace("GCAT ", "GCAT OWNCAT ").replace("GLAS N-BK7", "GLAS OWNGLASS")


@pytest.mark.parametrize("later", [True, False])
@pytest.mark.parametrize("packed", [True, False])
def test_an_archive_of_zemax_is_its_lens_with_its_catalogue(later, packed, tmp_path):
    members = (("OWNCAT.AGF", GLASS.encode()), ("notes.ses", b"\0\1"), ("A lens.zmx", lens_text().encode("utf-16")))
    rows = [record(f"{name}.LZW" if packed else name, lzw(d) if packed else d, later) for name, d in members]
    (tmp_path / "lens.zar").write_bytes(b"".join(rows))
    found = read_file(tmp_path / "lens.zar")
    assert found.report.format == "Zemax" and found.lens.surfaces[0].medium.name == "OWNGLASS"
    assert found.lens.surfaces[0].medium.index(0.5876) == pytest.approx(
        (1 + 1.4 * 0.5876**2 / (0.5876**2 - 0.01)) ** 0.5
    )
    plain = load_lens(FOLDER / "doublet.zmx")
    assert [s.radius for s in found.lens.surfaces] == [s.radius for s in plain.surfaces]


def test_a_zip_archive_may_hold_the_catalogue_too(tmp_path):
    with zipfile.ZipFile(tmp_path / "lens.zip", "w") as archive:
        archive.writestr("owncat.agf", GLASS)
        archive.writestr("lens.zmx", lens_text())
    assert load_lens(tmp_path / "lens.zip").surfaces[0].medium.name == "OWNGLASS"


@pytest.mark.parametrize("length", [0, 1, 2, 255, 513, 1023, 5000, 40_000])
def test_lzw_comes_back(length):
    """At every width of the codes: repeated letters, which name words not yet known, and random ones."""
    rng = random.Random(length)
    for data in (b"a" * length, bytes(rng.randrange(4) for _ in range(length)), rng.randbytes(length)):
        assert decompress_lzw(lzw(data)) == data


def test_damaged_archives_are_one_sentence():
    good = record("A lens.zmx.LZW", lzw(lens_text().encode()), True)
    for wrong in (good[:-5], good[:0x100], good + b"\xec", good[:0x288] + b"\xff" * len(good[0x288:]), good[:2]):
        with pytest.raises(LensFileError):
            unpack(wrong, "lens.zar")
